"""The command line: every command is a thin call of the public function of the same name."""

from __future__ import annotations

import signal
import sys
import threading
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from graphkin.cli.commands import app

__all__ = ["app", "main"]


def main() -> None:
    """Run the command line; see `graphkin.cli.commands`.

    Until the commands are loaded an interruption ends the process at once, as the system does it: there is nothing yet
    to be finished or told.
    """
    ours = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    ours = ours and threading.current_thread() is threading.main_thread()
    early = ours and "graphkin.cli.commands" not in sys.modules
    if early:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from graphkin.cli.commands import main as run

    if early:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    run()


def __getattr__(name: str) -> Any:
    if name != "app":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from graphkin.cli.commands import app as commands

    return commands
