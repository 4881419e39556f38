"""The figure of the polygons of several positions beside each other, all at the same scales, a column a position."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

from graphkin.account.headings import (
    FIGURE_WORDS,
    drivers,
    once,
    punctuation,
    written,
)
from graphkin.checking.readings import read_off
from graphkin.checking.report import measured
from graphkin.construction import Room, Scales
from graphkin.construction.room import scales_for
from graphkin.construction.sheet import Sheet
from graphkin.construction.steps import DiagramName
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import Block, FigurePage, column, framed, line, panel, prose, row
from graphkin.drawing.figures import Figure
from graphkin.drawing.parts.insets import polygon_with_insets
from graphkin.drawing.parts.polygon import extent
from graphkin.drawing.place.piece import Piece, renamed
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import Phrase, languages, say

__all__ = ["FIGURES", "polygons_beside"]

GUTTER = 4.0  # mm between panels
PANELS: Mapping[int, tuple[float, float]] = {1: (190.0, 100.0), 2: (93.0, 96.0), 3: (89.67, 92.0)}
"""Width and height (mm) of the panels, by the columns of a page."""
ROOM = 20.0  # of a panel, for names
MOST = 3  # columns of a page


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
    columns = min(MOST, len(sheets))
    wide, tall = PANELS[columns]
    page = FigurePage.of(first, "polygons", language, convention, columns * (wide + GUTTER) - GUTTER)
    room = Room((wide - ROOM, tall - ROOM), (wide - ROOM, tall - ROOM))
    all_scales = [scales_for(sheet, room) for _, sheet in sheets]
    scales = Scales(first.scales.length, max(s.velocity for s in all_scales), max(s.acceleration for s in all_scales))
    drawn = [(name, sheet.at(scales)) for name, sheet in sheets]
    shown: list[DiagramName] = ["velocity"]
    if any(sheet.vectors("acceleration") for _, sheet in sheets):
        shown.append("acceleration")
    pages = [_page(page, drawn[k : k + columns], shown, (wide, tall)) for k in range(0, len(drawn), columns)]
    further = (replace(one, title=f"{one.title} ({number})") for number, one in enumerate(pages[1:], 2))
    return replace(pages[0], further=tuple(further))


def _page(
    page: FigurePage, some: Sequence[tuple[str, Sheet]], shown: Sequence[DiagramName], size: tuple[float, float]
) -> Drawing:
    page = replace(page, sheet=some[0][1])
    colon = punctuation("colon", page.language)
    scales = [page.term(FIGURE_WORDS[diagram]) + colon + page.scale(diagram) for diagram in shown]
    return page.drawing(
        ";  ".join(scales), row(*(_position(page, name, sheet, shown, size) for name, sheet in some), gap=GUTTER), "",
        title="polygons", said=", ".join(name for name, _ in some), metadata={"positions": [name for name, _ in some]},
    )  # fmt: skip


def _position(
    page: FigurePage, name: str, sheet: Sheet, shown: Sequence[DiagramName], size: tuple[float, float]
) -> Block:
    """The polygons of a position below each other, and what the scene asks for, as it is measured there."""
    letters, units = page.letters, sheet.scene.units

    def polygon(diagram: DiagramName, room: Box) -> Piece:
        content = extent(sheet, diagram, room.grown(-3.0))
        origin = room.centre - content.centre
        drawn, _ = polygon_with_insets(sheet, diagram, letters, page.language, room.grown(-0.8), origin)
        return renamed(drawn, f"-at-{_plain(name)}")

    said = once(say(Phrase("position named", (name,)), each) for each in languages(page.language))
    named = sheet.scene.positions is not None and name in sheet.scene.positions.names
    head = (said + punctuation("colon", page.language)) * named + drivers(sheet, letters)
    found = [
        f"${letters.vector(r.symbol)}$ = {written(measured(r, sheet.scales, units))} {r.symbol.unit(units).written}"
        for r in read_off(sheet, [s for s in sheet.scene.find if s.scope == "motion" and not s.at])
    ] if sheet.scene.find else []  # fmt: skip
    panels = (framed(panel(*size, partial(polygon, diagram))) for diagram in shown)
    return column(line(head, size[0], 3.2), column(*panels, prose((";  ".join(found),), size[0]), gap=GUTTER))


def _plain(name: str) -> str:
    """A name as it may stand in an id: a prime becomes p."""
    return "".join(c if c.isalnum() else "p" if c in "'′" else "-" for c in name)


FIGURES = (Figure("polygons", polygons_beside, "sheets beside", of_all=True, place=8),)
