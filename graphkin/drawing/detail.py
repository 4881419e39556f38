"""Parts of a polygon too small for a ruler, drawn again larger in an inset."""

from __future__ import annotations

from dataclasses import dataclass

from graphkin.construction.sheet import DiagramName, Sheet, Vector
from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters
from graphkin.drawing.headings import term
from graphkin.drawing.layout import Name, Piece, fitted
from graphkin.drawing.placing import Label
from graphkin.drawing.primitives import Group, Line, Polygon, Primitive, Text
from graphkin.drawing.strokes import colour_of_vector
from graphkin.drawing.symbols import COMPONENT, RESULTANT, arrow
from graphkin.drawing.text import symbol

__all__ = ["Detail", "detail_inset", "details"]

SMALL, ZERO = 2.0, 0.02  # mm: vectors between these are drawn again larger
TOGETHER = 3.0  # mm: small vectors nearer than this share an inset
FACTORS = (2, 2.5, 5, 10, 20, 50, 100, 200, 500)
LONGEST = 13.0  # mm of the largest part in the inset


@dataclass(frozen=True)
class Detail:
    """A place of a polygon (mm on paper, y up) with its small vectors, and how much larger they are drawn."""

    centre: complex
    radius: float
    vectors: tuple[Vector, ...]
    factor: float


def details(sheet: Sheet, diagram: DiagramName) -> list[Detail]:
    """The places of a polygon that need a larger drawing."""
    small = [v for v in sheet.vectors(diagram).values() if ZERO < abs(v.span) < SMALL]
    groups: list[list[Vector]] = []
    for vector in small:
        near = [g for g in groups if any(_apart(vector, other) < TOGETHER for other in g)]
        merged = [vector, *(v for g in near for v in g)]
        groups = [g for g in groups if g not in near] + [merged]
    found = []
    for group in groups:
        ends = [z for v in group for z in (v.tail, v.tip)]
        box = Box.around(ends)
        size = max(box.width, box.height, 1e-9)
        factor = max((f for f in FACTORS if f * size <= LONGEST), default=0)
        if factor:
            found.append(Detail(box.centre, max(1.2, 0.75 * size), tuple(group), factor))
    return sorted(found, key=lambda d: (-len(d.vectors), d.centre.real, d.centre.imag))


def _apart(a: Vector, b: Vector) -> float:
    return min(abs(p - q) for p in (a.tail, a.tip) for q in (b.tail, b.tip))


def detail_inset(
    sheet: Sheet, diagram: DiagramName, detail: Detail, letters: Letters, language: str, box: Box, number: int
) -> tuple[Piece, Box]:
    """The inset in a box of the page, and the part of it in which its names may stand."""
    inner = Box(box.left + 0.6, box.top + 0.6, box.right - 0.6, box.bottom - 5.0)

    def at(z: complex) -> complex:
        return inner.centre + detail.factor * (z - detail.centre).conjugate()

    parts: list[Primitive] = [Polygon(box.corners, "", strokes.DIMENSION)]
    names = []
    own = {v.symbol for v in detail.vectors}
    for vector in sheet.vectors(diagram).values():
        kind = RESULTANT if vector.role == "resultant" else COMPONENT
        colour = colour_of_vector(sheet, vector.symbol)
        tail, tip = at(vector.tail), at(vector.tip)
        if vector.symbol in own:
            parts += arrow(tail, tip, kind, colour)
            text = Text(0j, symbol(letters.vector(vector.symbol), 2.8), "start", colour,
                        f"label-detail-{vector.symbol.id}", ("label",))
            names.append(Name(Label(text, (tail, tip)), 1))
            continue
        clipped = inner.clip(tail, tip)
        if clipped is None or abs(clipped[1] - clipped[0]) < 0.5:
            continue
        if inner.distance(tip) < 1e-9 and abs(clipped[1] - clipped[0]) > 3.0:
            parts += arrow(clipped[0], tip, kind, colour)
        else:
            parts.append(Line(*clipped, kind.stroke.coloured(colour)))
    words = f"{term('detail', language).replace('{0}', f'{detail.factor:g}')}"
    id = f"detail-{diagram}-{number}"
    runs = fitted(words, 2.6, box.width - 1.6)
    caption = Text(complex(box.centre.real, box.bottom - 1.6), runs, "middle", id=f"label-{id}")
    group = Group(tuple(parts), id=id, classes=("inset", "detail"))
    return Piece({diagram: (group,), "labels": (caption,)}, tuple(names)), inner
