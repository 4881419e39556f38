"""All commands by name, and what becomes of a problem: sentences on stderr and an exit status."""

from __future__ import annotations

import atexit
import gc
import os
import signal
import sys
from contextlib import suppress
from typing import Annotated

import typer

from graphkin import __version__
from graphkin.cli.cam import cam
from graphkin.cli.centres import centres
from graphkin.cli.check import audit, check, draw
from graphkin.cli.convert import convert
from graphkin.cli.design import design
from graphkin.cli.explain import explain
from graphkin.cli.handout import handout
from graphkin.cli.open import open_page
from graphkin.cli.output import tell
from graphkin.cli.solve import scenes, solve
from graphkin.cli.streams import Unwritable, own_streams
from graphkin.cli.study import study
from graphkin.cli.sweep import sweep
from graphkin.errors import GraphkinError

__all__ = ["app", "main"]

INTERRUPTED = 130
"""Exit status of what was interrupted, as shells have it."""

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="Velocity and acceleration polygons of mechanisms: constructed, measured, checked, drawn.",
)
for command in (scenes, draw, check, solve, centres, audit, sweep, handout, design, cam, convert, explain):
    app.command()(command)
app.command("open")(open_page)
app.add_typer(study, name="study")


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"graphkin {__version__}")
        raise typer.Exit


@app.callback()
def _common(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    pass


def main() -> None:
    """Run the command line; problems are said on stderr, one a line, and give the exit status.

    A reader of the output that goes away changes nothing; a place that cannot take it is status 2, an interruption 130.
    """
    # nearly all that a command makes are modules, which stay: looking for garbage among them takes a tenth of its time
    gc.set_threshold(100_000, 50, 100)
    atexit.register(gc.freeze)
    # and looking through all installed packages for plugins of pydantic another twentieth
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    own_streams()
    status: str | int | None = 0
    try:
        status = _run()
        sys.stdout.flush()
    except Unwritable as error:
        with suppress(OSError):
            tell(f"graphkin: what is printed cannot be written: {error.strerror}", err=True)
        status = 2
    if status == INTERRUPTED:
        _leave()
    if status:
        sys.exit(status)


def _run() -> str | int | None:
    """The exit status of the command."""
    try:
        app()
    except SystemExit as end:
        return end.code
    except GraphkinError as error:
        tell("\n".join(f"graphkin: {problem}" for problem in error.problems), err=True)
        return error.exit_code
    except KeyboardInterrupt:  # a second one, while the first was answered
        return INTERRUPTED
    return 0


def _leave() -> None:
    """End at once: nothing that runs is waited for, and a further interruption finds nobody."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with suppress(OSError):
        sys.stdout.flush()
        sys.stderr.flush()
    os._exit(INTERRUPTED)
