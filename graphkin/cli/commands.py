"""All commands by name, and what becomes of a problem: sentences on stderr and an exit status."""

from __future__ import annotations

import atexit
import gc
import os
import sys
from typing import Annotated

import typer

from graphkin import __version__
from graphkin.cli.centres import centres
from graphkin.cli.check import audit, check, draw
from graphkin.cli.handout import handout
from graphkin.cli.solve import scenes, solve
from graphkin.cli.study import study
from graphkin.cli.sweep import sweep
from graphkin.errors import GraphkinError

__all__ = ["app", "main"]

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="Velocity and acceleration polygons of mechanisms: constructed, measured, checked, drawn.",
)
for command in (scenes, draw, check, solve, centres, audit, sweep, handout):
    app.command()(command)
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
    """Run the command line; problems are said on stderr, one a line, and give the exit status."""
    # nearly all that a command makes are modules, which stay: looking for garbage among them takes a tenth of its time
    gc.set_threshold(100_000, 50, 100)
    atexit.register(gc.freeze)
    # and looking through all installed packages for plugins of pydantic another twentieth
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="replace")
    try:
        app()
    except GraphkinError as error:
        for problem in error.problems:
            typer.echo(f"graphkin: {problem}", err=True)
        sys.exit(error.exit_code)
    except BrokenPipeError:
        sys.exit(0)
