"""A polygon with its insets: senses of Coriolis parts, and small parts drawn again larger."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.drafting.sheet import DiagramName, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters
from graphkin.drawing.coriolis import CoriolisTerm, coriolis_inset, coriolis_terms
from graphkin.drawing.detail import detail_inset, details
from graphkin.drawing.layout import Piece, joined, settled
from graphkin.drawing.obstacles import Obstacles, obstacles_of
from graphkin.drawing.polygon import polygon_piece

__all__ = ["INSET", "coriolis_row", "polygon_with_insets", "strip_height"]

INSET = (32.0, 26.0)  # mm
GUTTER = 2.0
MOST_DETAILS = 3
STEP = 6.0  # mm from one place tried to the next along the edge of the panel
CLEAR = 2.0  # mm between an inset and what is drawn


def free_boxes(
    count: int, size: tuple[float, float], panel: Box, obstacles: Obstacles, taken: Sequence[Box] = ()
) -> list[Box]:
    """Up to ``count`` boxes of a size (mm) along the edges of a panel that hold nothing, those in corners first."""
    found: list[Box] = []
    for box in _places(size, panel):
        if len(found) == count:
            break
        wide = box.grown(CLEAR)
        if any(wide.overlaps(other) for other in (*taken, *found, *obstacles.areas)):
            continue
        if any(wide.clip(*segment) for segment in (*obstacles.solid, *obstacles.dashed)):
            continue
        found.append(box)
    return found


def _places(size: tuple[float, float], panel: Box) -> list[Box]:
    width, height = size
    right, low = panel.right - width, panel.bottom - height
    if right < panel.left or low < panel.top:
        return []
    xs = [panel.left + i * STEP for i in range(int((right - panel.left) / STEP) + 1)] + [right]
    ys = [panel.top + i * STEP for i in range(int((low - panel.top) / STEP) + 1)] + [low]
    corners = [(x, y) for y in (low, panel.top) for x in (right, panel.left)]
    edges = [(x, y) for y in (low, panel.top) for x in xs] + [(x, y) for x in (right, panel.left) for y in ys]
    return [Box(x, y, x + width, y + height) for x, y in (*corners, *edges)]


def strip_height(sheet: Sheet, diagram: DiagramName, width: float) -> float:
    """Height (mm) of a strip of a width that holds all insets of a polygon."""
    count = len(_coriolis(sheet, diagram)) + len(details(sheet, diagram)[:MOST_DETAILS])
    per_row = max(1, int((width + GUTTER) // (INSET[0] + GUTTER)))
    return -(-count // per_row) * (INSET[1] + GUTTER)


def _coriolis(sheet: Sheet, diagram: DiagramName) -> list[CoriolisTerm]:
    return coriolis_terms(sheet) if diagram == "acceleration" else []


def polygon_with_insets(
    sheet: Sheet, diagram: DiagramName, letters: Letters, language: str, panel: Box, origin: complex,
    strip: Box | None = None,
) -> tuple[Piece, list[CoriolisTerm]]:  # fmt: skip
    """A polygon with names and insets in their places.

    Parameters
    ----------
    panel : room of the polygon (mm)
    origin : page point of its pole
    strip : where insets stand in rows; None for free corners of the panel

    Returns
    -------
    the piece, and the Coriolis terms for whose insets there was no room
    """
    senses, small = _coriolis(sheet, diagram), details(sheet, diagram)[:MOST_DETAILS]
    count = len(senses) + len(small)
    if strip is not None:
        boxes = _in_rows(strip, count)
    elif count:
        bare = polygon_piece(sheet, diagram, letters, language, panel, origin)
        boxes = free_boxes(count, INSET, panel, obstacles_of(bare.drawn))
    else:
        boxes = []
    shown, enlarged = senses[: len(boxes)], small[: max(0, len(boxes) - len(senses))]
    pieces = [_settled_inset(sheet, one, letters, box) for one, box in zip(shown, boxes, strict=False)]
    for number, (one, box) in enumerate(zip(enlarged, boxes[len(shown) :], strict=False), 1):
        pieces.append(settled(*detail_inset(sheet, diagram, one, letters, language, box, number)))
    own = polygon_piece(sheet, diagram, letters, language, panel, origin, enlarged)
    figure = settled(own, panel, boxes)
    return joined((figure, *pieces)), senses[len(shown) :]


def coriolis_row(sheet: Sheet, terms: Sequence[CoriolisTerm], letters: Letters, row: Box) -> Piece:
    """Insets of Coriolis terms side by side in a row, as many as fit."""
    boxes = _in_rows(row, min(len(terms), int((row.width + GUTTER) // (INSET[0] + GUTTER))))
    return joined(_settled_inset(sheet, one, letters, box) for one, box in zip(terms, boxes, strict=False))


def _settled_inset(sheet: Sheet, one: CoriolisTerm, letters: Letters, box: Box) -> Piece:
    return settled(*coriolis_inset(sheet, one, letters, box))


def _in_rows(strip: Box, count: int) -> list[Box]:
    per_row = max(1, int((strip.width + GUTTER) // (INSET[0] + GUTTER)))
    corners = [(strip.left + (i % per_row) * (INSET[0] + GUTTER), strip.top + (i // per_row) * (INSET[1] + GUTTER))
               for i in range(count)]
    return [Box(x, y, x + INSET[0], y + INSET[1]) for x, y in corners]
