"""The command line: every command is a thin call of the public function of the same name."""

from __future__ import annotations

# of the interpreter itself: signal waits for enum, and who interrupts meanwhile would see a traceback
import _signal as signal  # type: ignore[import-not-found]
import gc
import os

__all__ = ["main"]


def main() -> None:
    """Run the command line; see `graphkin.cli.commands`.

    Until the command begins an interruption ends the process at once: no work is lost yet.
    """
    ours = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    try:
        if ours:
            signal.signal(signal.SIGINT, lambda *_: os._exit(130))
    except ValueError:  # in a thread, which no interruption reaches
        ours = False
    # nearly all that a command makes are modules, which stay: looking for garbage among them takes a tenth of its time
    gc.set_threshold(300_000, 50, 100)
    # its sums are short: threads of linear algebra would take longer to begin than they save
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    from graphkin.cli.commands import main as run

    # CPython keeps the frames of calls in pieces of 16 kB, and gives a piece back when the call returns that began it:
    # where many short calls come and go at such an edge, each asks the system for memory.  The first frame, made large,
    # begins a piece with room for all others
    run.__code__ = run.__code__.replace(co_stacksize=16_000)
    run(signal.default_int_handler if ours else None)
