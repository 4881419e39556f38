"""``graphkin design``: a mechanism for what it shall do; ``graphkin cam``: cams by the law of their follower."""

from __future__ import annotations

from typing import Annotated

import typer

from graphkin.cli.options import (
    FormatOption,
    InstrumentOption,
    JsonOption,
    OutOption,
    QuietOption,
    SceneArgument,
    SeedOption,
    SheetLangOption,
    split_words,
)
from graphkin.cli.output import print_json, print_paths, print_table, tell, unsolvable_as_json
from graphkin.errors import Unsolvable
from graphkin.words import languages

__all__ = ["cam", "design"]


def design(
    file: Annotated[str, typer.Argument(metavar="FILE", help="A design file, or the name of one that comes along.")],
    out: OutOption = None,
    formats: FormatOption = "svg",
    lang: SheetLangOption = None,
    instrument: InstrumentOption = "exact",
    seed: SeedOption = 0,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Find the lengths of a mechanism for what it shall do: drawn, measured, checked; write it as a scene."""
    from graphkin.api.designed import design as designing
    from graphkin.words import say, word

    wanted = split_words(formats)
    with unsolvable_as_json(as_json, _refused):
        designed = designing(file, None, wanted, lang, instrument, seed)
        paths = designed.write(out, wanted)
    if as_json:
        print_json(designed.data)
    elif not quiet:
        language = languages(lang or designed.given.sheet.language)[0]
        print_paths(paths)
        rows = [
            [row.symbol, f"{row.on_paper:.3f}", f"{row.measured:.7g}", f"{row.exact:.7g}", designed.given.units.length,
             "ok" if row.ok else "off"]
            for row in designed.rows
        ]  # fmt: skip
        heads = [word(key, language) for key in ("length found", "on paper", "measured", "exact", "unit")]
        print_table([*heads, ""], rows, right=(1, 2, 3))
        told = [
            [say(one.what, language), f"{one.asked:.7g}", f"{one.found:.7g}", one.unit, "ok" if one.ok else "off"]
            for one in designed.confirmed
        ]
        print_table([word("confirmed", language), word("given wish", language), "", "", ""], told, right=(1, 2))
        for sentence in designed.sentences(language):
            typer.echo(sentence)
    if not designed.ok:
        raise typer.Exit(1)


def _refused(error: Unsolvable) -> dict[str, object]:
    """The answer for a program, where nothing does what is wished."""
    return {"ok": False, "status": error.status, "why": error.why, "lengths": {}, "readings": []}


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
