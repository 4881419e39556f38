"""All commands by name, and their problems: sentences on stderr and an exit status; a closed pipe ends no command, a
full disk is a problem."""

from __future__ import annotations

import atexit
import gc
import io
import os
import signal
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from types import FrameType
from typing import TYPE_CHECKING, Annotated, TextIO

import typer

from graphkin import __version__
from graphkin.cli.output import asked_languages, complain, print_failed
from graphkin.errors import GraphkinError, Problem
from graphkin.words import Phrase, from_others

if TYPE_CHECKING:
    from sys import UnraisableHookArgs

    from typing_extensions import Buffer

INTERRUPTED = 130
"""Exit status of what was interrupted, as shells have it."""

_WRONG_CALL = typer.BadParameter.__mro__[1]
"""What is raised where an option or an argument is wrong (click's UsageError, whether typer brings click or not)."""

COMMANDS = (
    "scenes", "draw", "check", "solve", "centres", "audit", "sweep", "handout", "design", "cam", "convert", "explain",
    "open", "study",
)
"""The commands in the order of the help."""


class Unwritable(OSError):
    """The error of output that its file cannot take."""


class _Pipe(io.FileIO):
    """An output file of the system.  Output without a reader is dropped, so that a command does its work, and ends with
    its status, also under ``| head``."""

    def write(self, text: Buffer) -> int:
        try:
            return super().write(text)
        except OSError as error:
            _drop(self.fileno())
            if isinstance(error, BrokenPipeError) or self.fileno() == 2:
                return len(memoryview(text).cast("B"))
            raise Unwritable(error.errno, error.strerror) from None


def _drop(handle: int) -> None:
    """Discard all further output to a file of the system."""
    with suppress(OSError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, handle)
        os.close(nowhere)


def own_streams() -> None:
    """Standard output and error in UTF-8 on every terminal, which drop output without a reader."""
    for name, handle in (("stdout", 1), ("stderr", 2)):
        stream = getattr(sys, name)
        if stream is None:  # closed by who called
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        elif stream is getattr(sys, f"__{name}__") and _is(stream, handle):
            careful = io.BufferedWriter(_Pipe(handle, "wb", closefd=False))
            lines = handle == 2 or stream.isatty()
            setattr(sys, name, io.TextIOWrapper(careful, "utf-8", "replace", line_buffering=lines))
        elif hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="replace")


def _is(stream: TextIO, handle: int) -> bool:
    try:
        return bool(stream.fileno() == handle)
    except (OSError, ValueError, AttributeError):
        return False


def app_of(arguments: Sequence[str] = ()) -> typer.Typer:
    """The command line with only the command that the arguments begin with: a process loads no other.

    All commands where they begin with none: for the help, or to find the nearest name to a misspelt one.
    """
    app = typer.Typer(
        callback=_common,
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
        context_settings={"help_option_names": ["--help", "-h"]},
        help="Velocity and acceleration polygons of mechanisms: constructed, measured, checked, drawn.",
    )
    from graphkin.cli import verbs
    from graphkin.cli.options import with_options

    wanted = [name for name in arguments[:1] if name in COMMANDS]
    for name in wanted or COMMANDS:
        if name == "study":
            study = typer.Typer(no_args_is_help=True, help="The charts of the methods against each other.")
            study.command("speed-accuracy")(with_options(verbs.speed_accuracy))
            study.command("stability")(with_options(verbs.stability))
            app.add_typer(study, name=name)
        else:
            app.command(name)(with_options(getattr(verbs, name if name != "open" else "open_page")))
    return app


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"graphkin {__version__}")
        raise typer.Exit


def _common(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    pass


def main(interrupted: Callable[[int, FrameType | None], object] | None = None) -> None:
    """Run the command line; problems are said on stderr, one a line, and give the exit status.

    A closed pipe changes nothing; a file that cannot take the output is status 2, an interruption 130.

    Parameters
    ----------
    interrupted : the handler of an interruption while the command runs; None: the handler before
    """
    atexit.register(gc.freeze)
    if interrupted is not None:  # who comes after the end comes too late
        atexit.register(signal.signal, signal.SIGINT, signal.SIG_IGN)
        sys.unraisablehook = _not_lost
    # looking through all installed packages for plugins of pydantic takes a twentieth of a command's time
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    own_streams()
    status: str | int | None = 0
    try:
        status = _run(interrupted)
        sys.stdout.flush()
    except Unwritable as error:
        with suppress(OSError):
            complain(Phrase("what is printed cannot be written", reason=from_others(error)))
        status = 2
    except KeyboardInterrupt:  # a second one, while the first was answered, or at the very end
        status = INTERRUPTED
    if status == INTERRUPTED:
        _leave()
    if status:
        sys.exit(status)


def _run(interrupted: Callable[[int, FrameType | None], object] | None) -> str | int | None:
    """The exit status of the command."""
    try:
        app = app_of(sys.argv[1:])
        if interrupted is not None:
            signal.signal(signal.SIGINT, interrupted)
        return int(app(standalone_mode=False) or 0)
    except SystemExit as end:
        return end.code
    except GraphkinError as error:
        complain(*error.problems)
        print_failed(error.status, error.problems, error.answer)
        return error.exit_code
    except typer.Abort:
        return 1
    except Exception as error:
        if not isinstance(error, _WRONG_CALL):
            raise
        said = from_others(str(error.format_message()))  # type: ignore[attr-defined]
        if asked_languages(sys.argv[1:]) == ("en",):
            error.show()  # type: ignore[attr-defined]
        else:
            complain(said)
        called = ["graphkin", *(word for word in sys.argv[1:2] if word in COMMANDS)]
        print_failed("call", [Problem(" ".join(called), said)], {})
        return 2
    return 0


def _not_lost(raised: UnraisableHookArgs) -> None:
    """End at once where an interruption comes while an object is deleted: it is not raised, and would be lost."""
    if raised.exc_type is KeyboardInterrupt:
        _leave()
    sys.__unraisablehook__(raised)


def _leave() -> None:
    """End at once: running work is not awaited, and a further interruption has no effect."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with suppress(OSError):
        sys.stdout.flush()
        sys.stderr.flush()
    os._exit(INTERRUPTED)
