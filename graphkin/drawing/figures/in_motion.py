"""Figures while a hand moves the mechanism: links, vectors and letters at once, without the search for free room.

Dimensions, insets and senses come when the hand rests and the figure is drawn in full.
"""

from __future__ import annotations

from graphkin.account.headings import FIGURE_WORDS, figure_title
from graphkin.account.notation import letters_of
from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import text_box
from graphkin.drawing.ink.primitives import Text, page_direction
from graphkin.drawing.parts.mechanism import bare_mechanism
from graphkin.drawing.parts.polygon import polygon_piece
from graphkin.drawing.parts.polygon_on_page import PolygonOnPage, extent
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.piece import Piece, ink_box, layer_groups, middle_of, moved_piece
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import languages

__all__ = ["figure_in_motion"]

ROOM = 20.0  # mm around what is drawn
ASIDE = 1.6  # mm from a point, or from the middle of a segment, to the box of its name


def figure_in_motion(
    sheet: Sheet, diagram: DiagramName, *, language: str | None = None, convention: str | None = None
) -> Drawing:
    """The mechanism or one of its polygons, every name beside what it names wherever that is; parameters as for
    `graphkin.drawing.figures.diagrams.diagram_figure`."""
    spoken = language or sheet.scene.sheet.language
    letters = letters_of(sheet, convention or sheet.scene.sheet.convention)  # type: ignore[arg-type]
    if diagram == "mechanism":
        piece = bare_mechanism(sheet, letters)
        content = ink_box(piece.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    else:
        content = extent(sheet, diagram)
        panel = content.grown(ROOM)
        piece = polygon_piece(PolygonOnPage(sheet, diagram, letters, languages(spoken)[0], panel, 0j, ()))
    size = complex(content.width + 2 * ROOM, content.height + 2 * ROOM)
    piece = _named_at_once(moved_piece(piece, size / 2 - content.centre))
    title = figure_title(sheet, FIGURE_WORDS[diagram], spoken)
    return Drawing(size.real, size.imag, layer_groups(piece), title, "", languages(spoken)[0])


def _named_at_once(piece: Piece) -> Piece:
    names = tuple(_beside(label) for label in piece.labels if label.rank < 3)
    return Piece({**piece.layers, "labels": (*piece.layers.get("labels", ()), *names)})


def _beside(label: Label) -> Text:
    """A name on the side of its mark that it likes best, right above where it likes none."""
    text = Text(0j, label.text.runs, "start", label.text.colour, label.text.id, label.text.classes, label.text.step)
    box = text_box(text)
    if label.toward:
        away = page_direction(label.toward[0])
    elif isinstance(label.mark, tuple) and label.mark[0] != label.mark[1]:
        along = (label.mark[1] - label.mark[0]) / abs(label.mark[1] - label.mark[0])
        away = along * (-1j if along.real >= 0 else 1j)
    else:
        away = page_direction(0.8)
    half = abs(away.real) * box.width / 2 + abs(away.imag) * box.height / 2
    centre = middle_of(label.mark) + away * (half + ASIDE)
    return Text(
        centre - box.centre, text.runs, "start", text.colour, text.id, text.classes, text.step
    )  # fmt: skip
