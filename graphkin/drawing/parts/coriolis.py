"""The sense of a Coriolis acceleration in a small inset: the sliding velocity turned by 90 degrees with the guide.

2 ω v stands square to the sliding velocity v, on the side to which the guide's ω turns it.
"""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Sequence
from typing import TypeAlias

from graphkin.account.end_letters import ZERO
from graphkin.account.notation import Letters
from graphkin.construction.sheet import Sheet
from graphkin.construction.sizes import RateTimes, Size
from graphkin.construction.strokes import Vector
from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import runs_width
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Polygon, Primitive, Text, on_page
from graphkin.drawing.ink.strokes import colour_of_vector
from graphkin.drawing.ink.symbols import COMPONENT, arrow, sense_arc
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, dated, joined
from graphkin.drawing.text import fitted, symbol
from graphkin.plane import cross, unit
from graphkin.scene.symbol import Symbol

__all__ = [
    "GUTTER", "INSET", "CoriolisTerm", "coriolis_row", "coriolis_terms", "inset_boxes", "named_inset", "per_row",
]  # fmt: skip

CoriolisTerm: TypeAlias = tuple[Vector, Vector, Size | None]
"""A Coriolis vector, its sliding velocity, and the rule for its size."""
REACH = 8.0  # mm of the arrows
INSET = 32.0, 26.0  # mm
GUTTER = 2.0  # mm between insets


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
    centre = inner.centre - REACH / 2 * on_page(slip + turned)
    colour = colour_of_vector(sheet, vector.symbol)
    tips = [centre + REACH * on_page(way) for way in (slip, turned)]
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
        _label(letters.arrow(velocity.symbol), f"label-inset-v-{id}", tips[0], phase(slip)),
        _label(letters.arrow(vector.symbol), f"label-inset-{id}", tips[1], phase(turned)),
    ]
    if links:
        middle = centre + 3.6 * on_page(slip + turned) / abs(slip + turned)
        names.append(_label(f"ω_{{{links}}}", f"label-inset-omega-{id}", middle, phase(slip + turned), 1))
    name = f"${letters.vector(vector.symbol)}$"
    caption = fitted(f"{name} = ${letters.size(rule)}$" if rule else name, 2.8, box.width - 1.6)
    if runs_width(caption) > box.width - 1.6:
        caption = fitted(name, 2.8, box.width - 1.6)
    words = Text(complex(box.centre.real, box.bottom - 2.3), caption, "middle", id=f"label-sense-{id}")
    group = Group((frame, *parts), id=f"sense-{id}", classes=("inset",))
    drawn = [step.number for step in sheet.steps if vector in step.strokes]
    return dated(Piece({"acceleration": (group,), "labels": (words,)}, tuple(names)), max(drawn, default=None)), inner


def coriolis_row(sheet: Sheet, terms: Sequence[CoriolisTerm], letters: Letters, row: Box) -> Piece:
    """Insets of Coriolis terms side by side in a row, as many as fit."""
    boxes = inset_boxes(row, min(len(terms), per_row(row.width)))
    return joined(named_inset(sheet, one, letters, box) for one, box in zip(terms, boxes, strict=False))


def named_inset(sheet: Sheet, one: CoriolisTerm, letters: Letters, box: Box) -> Piece:
    """The inset of a Coriolis term in its box, with its names."""
    return with_labels(*coriolis_inset(sheet, one, letters, box))


def per_row(width: float) -> int:
    """How many insets stand side by side in a width (mm), one at least."""
    return max(1, int((width + GUTTER) // (INSET[0] + GUTTER)))


def inset_boxes(strip: Box, count: int) -> list[Box]:
    """So many boxes of insets in rows from the upper left corner of a strip."""
    many = per_row(strip.width)
    corners = [
        (strip.left + (i % many) * (INSET[0] + GUTTER), strip.top + (i // many) * (INSET[1] + GUTTER))
        for i in range(count)
    ]
    return [Box(x, y, x + INSET[0], y + INSET[1]) for x, y in corners]


def _label(markup: str, id: str, at: complex, toward: float, rank: int = 0) -> Label:
    return Label(Text(0j, symbol(markup, 2.8), "start", strokes.BLACK, id, ("label",)), at, (toward,), rank)
