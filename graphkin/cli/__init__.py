"""The command line: every command is a thin call of the public function of the same name."""

from __future__ import annotations

# of the interpreter itself: signal waits for enum, and who interrupts meanwhile would see a traceback
import _signal as signal  # type: ignore[import-not-found]
import os

__all__ = ["main"]


def main() -> None:
    """Run the command line; see `graphkin.cli.commands`.

    Until the command begins an interruption ends the process at once: there is nothing yet to be finished or told.
    """
    ours = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    try:
        if ours:
            signal.signal(signal.SIGINT, lambda *_: os._exit(130))
    except ValueError:  # in a thread, which no interruption reaches
        ours = False
    # its sums are short: threads of linear algebra would take longer to begin than they save
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    from graphkin.cli.commands import main as run

    run(signal.default_int_handler if ours else None)
