"""``graphkin audit``: printed values, or people's answers, against the exact ones."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from graphkin.cli.options import AtOption, JsonOption, LangOption, QuietOption, SceneArgument, driver_values
from graphkin.cli.output import print_json, print_paths, print_table, tell_unused

__all__ = ["audit"]


def audit(
    scene: SceneArgument,
    answers: Annotated[
        Path | None,
        typer.Option(
            "--answers", metavar="FILE.csv", help="A row for each person, symbols as heads, values in scene units."
        ),
    ] = None,
    at: AtOption = None,
    out: Annotated[Path | None, typer.Option("-o", "--out", metavar="DIR", help="Folder for audit.csv.")] = None,
    lang: LangOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Judge the scene's printed values, or people's answers: right, within drafting accuracy, or wrong and why."""
    from graphkin.api import audit as auditing

    audited = auditing(scene, answers, driver_values(at), lang)
    paths = audited.write(out) if out is not None else []
    if as_json:
        print_json(audited.data)
    elif not quiet:
        first = len(audited.heads) - 6
        print_table(audited.heads, audited.rows, right=(first + 1, first + 2, first + 3))
        if paths:
            print_paths(paths)
    tell_unused(audited.unused)
    if not audited.ok:
        raise typer.Exit(1)
