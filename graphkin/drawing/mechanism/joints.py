"""The points: turning pairs, pins, fixed marks, each with its letter."""

from __future__ import annotations

from cmath import phase

from graphkin.drawing import strokes, symbols
from graphkin.drawing.layout import Name, Piece
from graphkin.drawing.mechanism.on_paper import OnPaper, page
from graphkin.drawing.placing import Label
from graphkin.drawing.primitives import Group, Line, Primitive, Text
from graphkin.drawing.typeset import symbol
from graphkin.plane import cross, dot

__all__ = ["joints"]


def joints(here: OnPaper) -> Piece:
    """Every point with its symbol, and the letters that want a place beside them."""
    drawn = tuple(Group(tuple(_joint(here, p)), id=f"point-{p}", classes=("point",)) for p in here.places)
    return Piece({"mechanism": drawn}, tuple(_letter(here, point) for point in here.places))


def _joint(here: OnPaper, point: str) -> list[Primitive]:
    z, moving = here.places[point], here.moving(point)
    held = [n for n in here.scene.holders.get(point, ()) if n in here.sheet.poses or n == here.ground]
    if len(held) > 1 and moving:
        on_block = point in {b.slide.pin for b in here.bearings if not b.slide.slot}
        radius = symbols.JOINT_RADIUS * (0.85 if on_block else 1.0)
        circle = symbols.turning_pair(page(z), radius=radius)
        return [*(_over_block(here, z) if on_block else ()), *circle, *_through(here, z, held)]
    if moving:
        return [*symbols.pin(page(z), here.colour(moving[0]))]
    if any(p.point == point for p in here.scene.pins):
        return [*symbols.pin(page(z), strokes.BLACK)]
    thin = strokes.OUTLINE
    return [Line(page(z - 1.2), page(z + 1.2), thin), Line(page(z - 1.2j), page(z + 1.2j), thin)]


def _letter(here: OnPaper, point: str) -> Name:
    z = here.places[point]
    away = -sum((w / abs(w) for w in here.ways(z)), 0j)
    letter = symbol(here.letters.point(point))
    text = Text(0j, letter, "start", strokes.BLACK, f"label-point-{point}", ("label",))
    return Name(Label(text, page(z), (phase(away),) if abs(away) > 0.1 else ()), 0)


def _over_block(here: OnPaper, z: complex) -> list[Primitive]:
    """Edges of areas that end in the pin of a block, drawn on over it."""
    parts: list[Primitive] = []
    for shape in here.shapes:
        for i, corner in enumerate(shape.corners):
            if abs(corner - z) < 1e-6:
                stroke = strokes.LINK.coloured(here.colour(shape.link))
                for other in (shape.corners[i - 1], shape.corners[(i + 1) % len(shape.corners)]):
                    reach = min(symbols.BLOCK_LENGTH * 0.7, abs(other - z))
                    parts.append(Line(page(z), page(z + reach * (other - z) / abs(other - z)), stroke))
    return parts


def _through(here: OnPaper, z: complex, held: list[str]) -> list[Primitive]:
    """A bar that goes on beyond a joint is drawn through its circle."""
    parts: list[Primitive] = []
    for shape in here.shapes:
        if shape.link not in held:
            continue
        for a, b in shape.bars:
            e = (b - a) / abs(b - a)
            if abs(cross(z - a, e)) < 1e-3 and 2.0 < dot(z - a, e) < abs(b - a) - 2.0:
                r = symbols.JOINT_RADIUS
                stroke = strokes.LINK.coloured(here.colour(shape.link))
                parts.append(Line(page(z - r * e), page(z + r * e), stroke))
    return parts
