"""``graphkin convert``: files of other programs as scenes, and back."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from graphkin.cli.options import JsonOption, QuietOption
from graphkin.cli.output import print_json, print_paths, tell
from graphkin.errors import CallError, Problem

__all__ = ["convert"]


def convert(
    source: Annotated[
        str,
        typer.Argument(
            metavar="FILE", help="A file of Linkage, pyslvs, pylinkage, GeoGebra or PMKS, a link of PMKS+, or a scene."
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option(
            "-o", "--out", metavar="FILE", help="What to write: .toml, .linkage2, .pyslvs, .json; printed if not given."
        ),
    ] = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Make a scene of another program's mechanism, or give a scene to another program."""
    from graphkin.api.converted import convert as converting

    if out is not None and out.exists():
        raise CallError(Problem(str(out), "a file of that name is there already", "name another file"))
    made = converting(source, out)
    if as_json:
        print_json(made.data)
    elif out is None:
        typer.echo(made.text, nl=False)
    elif not quiet:
        print_paths([out])
    for thing in made.left:
        tell(f"graphkin: not carried over: {thing}", err=True)
