"""``graphkin cam``: cams by the law of their follower."""

from __future__ import annotations

from typing import Annotated

import typer

from graphkin.cli.options import (
    FormatOption,
    JsonOption,
    OutOption,
    QuietOption,
    SceneArgument,
    SheetLangOption,
    split_words,
)
from graphkin.cli.output import print_json, print_paths, tell, unsolvable_as_json
from graphkin.errors import Unsolvable
from graphkin.words import languages

__all__ = ["cam"]


def cam(
    scene: SceneArgument,
    out: OutOption = None,
    formats: FormatOption = "svg",
    lang: SheetLangOption = None,
    step: Annotated[float, typer.Option("--step", metavar="DEG", help="Degrees between two rows of cam.csv.")] = 1.0,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Cams drawn by inversion: pressure angles, curvature, undercutting, profile as CSV and DXF; discs measured."""
    from graphkin.api.cams import cam as looking

    wanted = split_words(formats)
    with unsolvable_as_json(as_json, _none_made):
        found = looking(scene, None, wanted, lang, step)
        paths = found.write(out, wanted)
    if as_json:
        print_json(found.data)
    elif not quiet:
        print_paths(paths)
        language = languages(lang or found.mechanism.sheet.language)[0]
        tell("\n".join(found.sentences(language)))
    if not found.ok:
        raise typer.Exit(1)


def _none_made(error: Unsolvable) -> dict[str, object]:
    return {"ok": False, "status": error.status, "why": error.why, "cams": {}}
