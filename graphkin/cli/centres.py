"""``graphkin centres``: instant centres, velocities by them, and centrodes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from graphkin.cli.options import (
    AtOption,
    ConventionOption,
    FormatOption,
    JsonOption,
    PositionOption,
    QuietOption,
    SceneArgument,
    SheetLangOption,
    TextOption,
    driver_values,
    split_words,
)
from graphkin.cli.output import print_json, print_paths, print_table, tell, unsolvable_as_json
from graphkin.errors import CallError, Problem, Unsolvable
from graphkin.words import Phrase

__all__ = ["centres"]


def centres(
    scene: SceneArgument,
    out: Annotated[
        Path | None,
        typer.Option("-o", "--out", metavar="DIR", help="Folder for the files; ./NAME if not given, none with --json."),
    ] = None,
    formats: FormatOption = "svg",
    text: TextOption = "glyphs",
    at: AtOption = None,
    position: PositionOption = None,
    centrode: Annotated[
        str | None, typer.Option("--centrode", metavar="LINK", help="The centrodes of a link over a turn instead.")
    ] = None,
    point: Annotated[str, typer.Option("--point", metavar="P", help="With --centrode: the path of this point.")] = "",
    motion: Annotated[
        bool, typer.Option("--motion", help="Centres in motion with their paths too: centres-motion.svg, which plays.")
    ] = False,
    lang: SheetLangOption = None,
    convention: ConventionOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """All instant centres, how each was found, and the velocities by centres."""
    from graphkin.api.arguments import known_words
    from graphkin.api.centred import centres as finding
    from graphkin.api.centred import centres_text

    wanted, values = split_words(formats), driver_values(at, position)
    known_words(wanted, text=text)
    if point and centrode is None:
        raise CallError(Problem("--point", Phrase("without centrode"), Phrase("write centrode link point p")))
    if motion and centrode is not None:
        raise CallError(Problem("--motion", Phrase("stands beside centrode"), Phrase("write one of the two")))
    if centrode is not None:
        _roll(scene, centrode, point, values, out, wanted, text, lang, convention, as_json, quiet)
        return
    with unsolvable_as_json(as_json, _none_found):
        found = finding(scene, values, None, wanted, lang, convention)
    paths = [] if as_json and out is None else found.write(out, wanted, text, motion)
    if as_json:
        print_json(found.data)
    elif not quiet:
        print_paths(paths)
        told = centres_text(found)
        print_table(told.heads, told.rows)
        tell("\n".join(told.sentences))
    if not found.ok:
        raise typer.Exit(1)


def _none_found(error: Unsolvable) -> dict[str, object]:
    return {"links": [], "centres": {}, "ok": False, "status": error.status, "why": error.why}


def _roll(
    scene: str, link: str, point: str, values: float | str | dict[str, float] | None, out: Path | None,
    formats: list[str], text: str, lang: str | None, convention: str | None, as_json: bool, quiet: bool,
) -> None:  # fmt: skip
    from graphkin.api.centroded import centrodes

    rolled = centrodes(scene, link, point, values, None, formats, lang, convention)
    paths = rolled.write(out, formats, text)
    if as_json:
        print_json(rolled.data | {"files": [str(path) for path in paths]})
    elif not quiet:
        print_paths(paths)
    if not rolled.ok:
        raise typer.Exit(1)
