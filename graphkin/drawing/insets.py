"""The sense of a Coriolis acceleration in a small inset: the sliding velocity turned by 90 degrees with the guide.

A polygon with its insets: senses of Coriolis parts, and small parts drawn again larger.
"""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Sequence

from graphkin.construction.sheet import DiagramName, Sheet, Vector
from graphkin.construction.steps import RateTimes, Size
from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters
from graphkin.drawing.detail import detail_inset, details
from graphkin.drawing.layout import Name, Piece, fitted, joined, settled
from graphkin.drawing.obstacles import Obstacles, obstacles_of
from graphkin.drawing.placing import Label
from graphkin.drawing.polygon import polygon_piece
from graphkin.drawing.primitives import Circle, Group, Polygon, Primitive, Text
from graphkin.drawing.strokes import colour_of_vector
from graphkin.drawing.symbols import COMPONENT, arrow, sense_arc
from graphkin.drawing.text import runs_width, symbol
from graphkin.plane import cross, unit
from graphkin.scene.symbol import Symbol

__all__ = [
    "INSET",
    "CoriolisTerm",
    "coriolis_inset",
    "coriolis_row",
    "coriolis_terms",
    "polygon_with_insets",
    "strip_height",
]

CoriolisTerm = tuple[Vector, Vector, Size | None]
REACH = 8.0  # mm of the arrows
ZERO = 0.02  # mm


def coriolis_terms(sheet: Sheet) -> list[CoriolisTerm]:
    """Each Coriolis vector that is not zero, with its sliding velocity and the rule for its size."""
    velocities = sheet.vectors("velocity")
    rules = {t.symbol: t.size for e in sheet.equations for side in e.sides for t in side}
    found = []
    for vector in sheet.vectors("acceleration").values():
        if vector.role != "coriolis" or abs(vector.span) < ZERO:
            continue
        of, to = vector.symbol.of, vector.symbol.to
        for velocity in (velocities.get(Symbol("v", of, to)), velocities.get(Symbol("v", of))):
            if velocity is not None and abs(velocity.span) > ZERO:
                found.append((vector, velocity, rules.get(vector.symbol)))
                break
    return found


def coriolis_inset(sheet: Sheet, term: CoriolisTerm, letters: Letters, box: Box) -> tuple[Piece, Box]:
    """The inset in a box of the page, and the part of it in which its names may stand."""
    vector, velocity, rule = term
    slip, turned = unit(velocity.span), unit(vector.span)
    sense = 1 if cross(slip, turned) > 0 else -1
    inner = Box(box.left + 0.6, box.top + 0.6, box.right - 0.6, box.bottom - 6.2)
    centre = inner.centre - REACH / 2 * (slip + turned).conjugate()
    colour = colour_of_vector(sheet, vector.symbol)
    tips = [centre + REACH * way.conjugate() for way in (slip, turned)]
    arc = sense_arc(centre, 3.6, phase(slip) + sense * math.pi / 4, sense, math.radians(72))
    parts: tuple[Primitive, ...] = (
        *arrow(centre, tips[0], COMPONENT, strokes.BLACK),
        *arrow(centre, tips[1], COMPONENT, colour),
        *arc,
        Circle(centre, 0.4, fill=strokes.BLACK),
    )
    frame = Polygon(box.corners, "", strokes.DIMENSION)
    id = vector.symbol.id
    links = "".join(rule.links) if isinstance(rule, RateTimes) and rule.rate == "omega" else ""
    names = [
        Name(_label(letters.vector(velocity.symbol), f"label-inset-v-{id}", tips[0], phase(slip))),
        Name(_label(letters.vector(vector.symbol), f"label-inset-{id}", tips[1], phase(turned))),
    ]
    if links:
        middle = centre + 3.6 * (slip + turned).conjugate() / abs(slip + turned)
        names.append(Name(_label(f"ω_{{{links}}}", f"label-inset-omega-{id}", middle, phase(slip + turned)), 1))
    name = f"${letters.vector(vector.symbol)}$"
    caption = fitted(f"{name} = ${letters.size(rule)}$" if rule else name, 2.8, box.width - 1.6)
    if runs_width(caption) > box.width - 1.6:
        caption = fitted(name, 2.8, box.width - 1.6)
    words = Text(complex(box.centre.real, box.bottom - 2.3), caption, "middle", id=f"label-sense-{id}")
    group = Group((frame, *parts), id=f"sense-{id}", classes=("inset",))
    return Piece({"acceleration": (group,), "labels": (words,)}, tuple(names)), inner


def _label(markup: str, id: str, at: complex, toward: float) -> Label:
    return Label(Text(0j, symbol(markup, 2.8), "start", strokes.BLACK, id, ("label",)), at, (toward,))


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
    corners = [
        (strip.left + (i % per_row) * (INSET[0] + GUTTER), strip.top + (i // per_row) * (INSET[1] + GUTTER))
        for i in range(count)
    ]
    return [Box(x, y, x + INSET[0], y + INSET[1]) for x, y in corners]
