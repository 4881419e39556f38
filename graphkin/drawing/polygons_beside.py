"""The figure of the polygons of several positions beside each other, all at the same scales, a column a position."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from graphkin.account.headings import (
    FIGURE_WORDS,
    drivers,
    facts,
    figure_title,
    once,
    punctuation,
    term,
    titles,
    written,
)
from graphkin.account.notation import Letters, letters_of, scale_statement
from graphkin.checking.readings import read_off
from graphkin.checking.report import measured
from graphkin.construction import Room, Scales
from graphkin.construction.plan import scales_for
from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Group, Polygon, Primitive, Text
from graphkin.drawing.parts.insets import polygon_with_insets
from graphkin.drawing.parts.polygon_on_page import extent
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.piece import Piece, joined, layer_groups, renamed
from graphkin.drawing.text import fitted, wrapped
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import Phrase, languages, say

__all__ = ["polygons_beside"]

MARGIN, GUTTER = 10.0, 4.0
PANELS: Mapping[int, tuple[float, float]] = {1: (190.0, 100.0), 2: (93.0, 96.0), 3: (89.67, 92.0)}
"""Width and height (mm) of the panels, by the columns of a page."""
ROOM = 20.0  # of a panel, for names
MOST = 3  # columns of a page
LINE = 4.4


def polygons_beside(
    sheets: Sequence[tuple[str, Sheet]], *, language: str | None = None, convention: str | None = None
) -> Drawing:
    """The polygons of positions beside each other, what does not fit a page on further ones.

    Parameters
    ----------
    sheets : the name of each position, and what exact hands have drawn there
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    """
    first = sheets[0][1]
    spoken = language or first.scene.sheet.language
    letters = letters_of(first, convention or first.scene.sheet.convention)  # type: ignore[arg-type]
    columns = min(MOST, len(sheets))
    wide, tall = PANELS[columns]
    room = Room((wide - ROOM, tall - ROOM), (wide - ROOM, tall - ROOM))
    all_scales = [scales_for(sheet, room) for _, sheet in sheets]
    scales = Scales(first.scales.length, max(s.velocity for s in all_scales), max(s.acceleration for s in all_scales))
    drawn = [(name, sheet.at(scales)) for name, sheet in sheets]
    rows = [drawn[k : k + columns] for k in range(0, len(drawn), columns)]
    pages = [_page(row, letters, spoken, (wide, tall), columns, number) for number, row in enumerate(rows, 1)]
    one = pages[0]
    return Drawing(
        one.width, one.height, one.children, one.title, one.desc, one.lang, one.metadata, tuple(pages[1:])
    )  # fmt: skip


def _page(
    row: Sequence[tuple[str, Sheet]], letters: Letters, spoken: str, size: tuple[float, float], columns: int,
    number: int,
) -> Drawing:
    wide, tall = size
    first = row[0][1]
    width = 2 * MARGIN + columns * wide + (columns - 1) * GUTTER
    words: list[Primitive] = []
    y = MARGIN
    for title in titles(first, spoken):
        y += 4.8
        words.append(Text(complex(MARGIN, y), fitted(title, 4.0, width - 2 * MARGIN, bold=True), classes=("heading",)))
    shown: list[DiagramName] = ["velocity"]
    if any(sheet.vectors("acceleration") for _, sheet in row):
        shown.append("acceleration")
    colon = punctuation("colon", spoken)
    parts = [term(FIGURE_WORDS[d], spoken) + colon + scale_statement(first, letters.convention, d) for d in shown]
    y += 5.2
    words.append(Text(complex(MARGIN, y), fitted(";  ".join(parts), 3.2, width - 2 * MARGIN)))
    top = y + 8.0
    pieces: list[Piece] = []
    bottom = top
    for k, (name, sheet) in enumerate(row):
        left = MARGIN + k * (wide + GUTTER)
        said = once(say(Phrase("position named", (name,)), each) for each in languages(spoken)) + colon
        named = sheet.scene.positions is not None and name in sheet.scene.positions.names
        heads = said * named + drivers(sheet, letters)
        words.append(Text(complex(left, top - 1.6), fitted(heads, 3.2, wide)))
        y = top
        for diagram in shown:
            panel = Box(left, y, left + wide, y + tall)
            content = extent(sheet, diagram, panel.grown(-3.0))
            origin = panel.centre - content.centre
            piece, _ = polygon_with_insets(sheet, diagram, letters, spoken, panel.grown(-0.8), origin)
            frame = Group((Polygon(panel.corners, "", strokes.DIMENSION),), classes=("panel",))
            pieces += [Piece({"construction": (frame,)}), renamed(piece, f"-at-{_plain(name)}")]
            y = panel.bottom + GUTTER
        bottom = max(bottom, _values(words, sheet, letters, left, y, wide))
    height = bottom + 14.0
    words += check_bar(complex(width - MARGIN - 50.0, height - 6.0), fitted(term("check bar", spoken), 2.5, 50.0))
    page = joined((*pieces, Piece({"labels": tuple(words)})))
    return Drawing(
        width, height, layer_groups(page), figure_title(first, "polygons", spoken) + f" ({number})" * (number > 1),
        ", ".join(name for name, _ in row), languages(spoken)[0],
        facts(first, "polygons") | {"positions": [name for name, _ in row]},
    )  # fmt: skip


def _plain(name: str) -> str:
    """A name as it may stand in an id: a prime becomes p."""
    return "".join(c if c.isalnum() else "p" if c in "'′" else "-" for c in name)


def _values(words: list[Primitive], sheet: Sheet, letters: Letters, left: float, y: float, wide: float) -> float:
    """What the scene asks for, as it is measured there."""
    units = sheet.scene.units
    said = [
        f"${letters.vector(r.symbol)}$ = {written(measured(r, sheet.scales, units))} {r.symbol.unit(units).written}"
        for r in read_off(sheet, [s for s in sheet.scene.find if s.scope == "motion" and not s.at])
    ] if sheet.scene.find else []  # fmt: skip
    for runs in wrapped(";  ".join(said), 2.8, wide):
        y += LINE
        words.append(Text(complex(left, y), runs))
    return y
