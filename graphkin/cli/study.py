"""``graphkin study``: the methods against each other."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphkin.cli.options import JsonOption, LangOption, QuietOption, SceneArgument, split_words
from graphkin.cli.output import print_json, print_paths

if TYPE_CHECKING:
    from graphkin.api.studied import SpeedAccuracy, Stability

__all__ = ["study"]

study = typer.Typer(no_args_is_help=True, help="The charts of the methods against each other.")


@study.command("speed-accuracy")
def speed_accuracy(
    scene: SceneArgument,
    out: Annotated[
        Path, typer.Option("-o", "--out", metavar="DIR", help="Folder for the chart (SVG, CSV); ./speed-accuracy.")
    ] = Path("speed-accuracy"),
    repeats: Annotated[int, typer.Option("--repeats", metavar="N", help="Runs of each method; the best counts.")] = 5,
    formats: Annotated[str, typer.Option("--format", metavar="svg,pdf,png", help="Formats of the chart.")] = "svg",
    lang: LangOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Cost of a position against the largest error, for all methods, measured on this machine."""
    from graphkin.api.studied import speed_accuracy as racing

    _write(racing(scene, repeats, lang), out, formats, as_json, quiet)


@study.command("stability")
def stability(
    out: Annotated[
        Path, typer.Option("-o", "--out", metavar="DIR", help="Folder for the charts (SVG, CSV); ./stability.")
    ] = Path("stability"),
    formats: Annotated[str, typer.Option("--format", metavar="svg,pdf,png", help="Formats of the charts.")] = "svg",
    lang: LangOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Errors beside every kind of singular position: how fast they grow, where methods stop and how they say so."""
    from graphkin.api.studied import stability as measuring

    _write(measuring(language=lang or "en"), out, formats, as_json, quiet)


def _write(found: SpeedAccuracy | Stability, out: Path, formats: str, as_json: bool, quiet: bool) -> None:
    paths = found.write(out, split_words(formats))
    if as_json:
        print_json(found.data)
    elif not quiet:
        print_paths(paths)
