"""The frame and the moving links: feet and guides, bars, areas, slots, blocks, cylinders."""

from __future__ import annotations

from cmath import phase

from graphkin.drawing import strokes, symbols
from graphkin.drawing.layout import Piece
from graphkin.drawing.mechanism.on_paper import OnPaper, page
from graphkin.drawing.primitives import Group, Line, Polygon, Primitive
from graphkin.drawing.shapes import GUIDE_LENGTH, Bearing, Shape
from graphkin.plane import cross

__all__ = ["links"]


def links(here: OnPaper) -> Piece:
    """All links, areas first, so that feet of pivots stand on them and bars lie over them."""
    areas = [_link(here, shape) for shape in here.shapes if shape.corners]
    bars = sorted((shape for shape in here.shapes if not shape.corners), key=lambda shape: _depth(here, shape))
    return Piece({"mechanism": (*areas, _frame(here), *(_link(here, shape) for shape in bars))})


def _depth(here: OnPaper, shape: Shape) -> int:
    """What carries a block lies under it, what ends in its pin over it."""
    if any(b.slide.b == shape.link for b in here.bearings):
        return 0
    if any(b.slide.a == shape.link for b in here.bearings):
        return 1 + here.nested(shape.link)
    return 9


def _frame(here: OnPaper) -> Group:
    parts: list[Primitive] = []
    for point in here.scene.frame.points:
        if here.moving(point):
            parts += symbols.fixed_pivot(page(here.places[point]), here.foot(point))
    for b in here.bearings:
        if here.ground in (b.slide.a, b.slide.b) and not b.slide.slot:
            parts += symbols.guide(page(b.at), phase(b.along), GUIDE_LENGTH)
    return Group(tuple(parts), id=f"link-{here.ground}", classes=("frame",))


def _link(here: OnPaper, shape: Shape) -> Group:
    colour = here.colour(shape.link)
    parts: list[Primitive] = []
    stroke = (strokes.REDUNDANT if shape.redundant else strokes.LINK).coloured(colour)
    if shape.corners:
        corners = tuple(map(page, shape.corners))
        parts.append(Polygon(corners, "" if shape.redundant else strokes.tint(colour), stroke))
    hidden = {b.slide.b for b in here.bearings if b.slide.key in here.cylinders}
    if shape.link not in hidden:
        parts += [Line(page(start), page(end), stroke) for start, end in shape.bars]
        parts += _welds(here, shape, colour)
    for start, end in shape.slots:
        parts += symbols.slot(page(start), page(end), colour)
    for b in here.bearings:
        if b.slide.b == shape.link and b.slide.key in here.cylinders:
            parts += symbols.cylinder(page(here.pivot(b)), page(b.at), colour)
    for b in here.bearings:
        if b.slide.a == shape.link and not b.slide.slot and b.slide.key not in here.cylinders:
            parts += _block(here, b)
        if b.slide.a == shape.link and b.slide.key in here.cylinders:
            start, end = here.rod(b)
            parts.append(Line(page(start), page(end), strokes.LINK.coloured(colour)))
    return Group(tuple(parts), id=f"link-{shape.link}", classes=("link",))


def _block(here: OnPaper, b: Bearing) -> tuple[Primitive, ...]:
    shrink = 0.72 ** here.nested(b.slide.a)
    return symbols.block(
        page(b.at), phase(b.along), here.colour(b.slide.a), symbols.BLOCK_LENGTH * shrink, symbols.BLOCK_WIDTH * shrink
    )


def _welds(here: OnPaper, shape: Shape, colour: str) -> list[Primitive]:
    """Filled corners where two bars of one link meet at an angle with no joint between them."""
    parts: list[Primitive] = []
    for i, (a, b) in enumerate(shape.bars):
        for p, q in shape.bars[i + 1 :]:
            for corner, far in ((p, q), (q, p)):
                e = (b - a) / abs(b - a)
                if abs(cross(corner - a, e)) > 1e-3 or abs(cross((far - corner) / abs(far - corner), e)) < 0.1:
                    continue
                if any(abs(corner - z) < 1.0 for z in here.places.values()):
                    continue
                along = b if abs(b - corner) > abs(a - corner) else a
                parts += symbols.weld(page(corner), page(far), page(along), colour)
    return parts
