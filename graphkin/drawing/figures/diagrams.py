"""One figure on a page of its own: mechanism, velocity polygon, acceleration polygon, with heading and scale."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from graphkin.account.headings import FIGURE_WORDS, describe, dimensions_in, remarks
from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import GAP, FigurePage, column, prose
from graphkin.drawing.figures import Figure
from graphkin.drawing.parts.insets import mechanism_detail, polygon_with_insets, strip_height
from graphkin.drawing.parts.mechanism import mechanism_piece
from graphkin.drawing.parts.polygon_on_page import extent
from graphkin.drawing.parts.scans import background_piece, scan_piece
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, joined, moved_piece
from graphkin.drawing.write.drawing import Drawing
from graphkin.scene.model import Mechanism
from graphkin.words import languages

__all__ = ["FIGURES", "diagram_figure", "diagram_figures"]

DIAGRAMS: tuple[DiagramName, ...] = ("mechanism", "velocity", "acceleration")
ROOM = 12.0  # mm around the figure, for names


def diagram_figure(
    diagram: DiagramName, sheet: Sheet, *, language: str | None = None, convention: str | None = None
) -> Drawing | None:
    """The mechanism or one of its polygons at its true scale, on a page of its own; None of accelerations that were not
    drawn.

    Parameters
    ----------
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    """
    if diagram == "acceleration" and not sheet.vectors(diagram):
        return None
    page = FigurePage.of(sheet, diagram, language, convention)
    spoken, letters = page.language, page.letters
    piece, content = mechanism_piece(sheet, letters) if diagram == "mechanism" else (Piece(), extent(sheet, diagram))
    page = page.wide_enough(content.width + 2 * ROOM)
    strip = 0.0 if diagram == "mechanism" else strip_height(sheet, diagram, page.width)

    def drawn(room: Box) -> Piece:
        around = Box(room.left, room.top, room.right, room.bottom - strip)
        origin = around.centre - content.centre
        if diagram == "mechanism":
            named = with_labels(moved_piece(piece, origin), around)
            under = background_piece(sheet, origin, around)
            whole = joined((under, named, mechanism_detail(sheet, letters, spoken, around, named.drawn)))
        else:
            insets = Box(room.left, around.bottom, room.right, room.bottom)
            whole, _ = polygon_with_insets(sheet, diagram, letters, spoken, around, origin, insets)
        return joined((scan_piece(sheet, diagram, origin, around), whole)) if sheet.scene.scans else whole

    notes = [note for each in languages(spoken) for note in remarks(sheet, each, letters)]
    told = prose(notes, page.width, 2.5, classes=("remark",))
    title = FIGURE_WORDS[diagram]
    unit = dimensions_in(sheet, spoken) if diagram == "mechanism" else ""
    return page.drawing(
        page.at_drivers(page.term(title)),
        column(told, page.panel(content.height + 2 * ROOM + strip, drawn), gap=GAP),
        ",  ".join(filter(None, (page.scale(diagram), unit))), title=title, said=describe(sheet, (diagram,), spoken),
        note="" if diagram == "mechanism" else page.term("step number"),
    )  # fmt: skip


def diagram_figures(
    sheet: Sheet, language: str | None = None, convention: str | None = None, names: Sequence[DiagramName] = DIAGRAMS
) -> dict[str, Drawing]:
    """Those of the figures of a sheet that were drawn, by name."""
    made = ((name, diagram_figure(name, sheet, language=language, convention=convention)) for name in names)
    return {name: page for name, page in made if page is not None}


def contacts_figure(sheet: Sheet, *, language: str | None = None, convention: str | None = None) -> Drawing:
    """The polygons at the points of contact, a page each."""
    velocity, *further = diagram_figures(sheet, language, convention, DIAGRAMS[1:]).values()
    return replace(velocity, further=tuple(further))


def _touches(scene: Mechanism) -> bool:
    return any(not c.rolling for c in scene.contacts) or bool(scene.cams) or any(not s.block for s in scene.slots)


FIGURES = (
    *(Figure(name, partial(diagram_figure, name), by_itself=lambda scene: True, place=place)
      for place, name in enumerate(DIAGRAMS, 1)),
    Figure("contacts", contacts_figure, "sheet at contacts", _touches, of_all=True, place=10),
)  # fmt: skip
