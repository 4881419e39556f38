"""The composition of a figure: pieces with their strokes by layer and their labels; pieces joined, moved, measured and
cut; and strokes as obstacles.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import (
    Arc,
    Circle,
    Group,
    Line,
    Polygon,
    Polyline,
    Primitive,
    Segment,
    Text,
    map_tree,
    moved,
    page_direction,
    walk,
)
from graphkin.drawing.place.labels import Label, Mark, mapped
from graphkin.drawing.place.obstacles import Obstacles
from graphkin.drawing.text import text_box

# In the order of drawing.
LAYERS = (
    "background", "construction", "mechanism", "velocity", "acceleration", "forces", "centres", "answers", "labels",
)


@dataclass(frozen=True)
class Piece:
    """A part of a page: primitives by layer, labels that need a place, and further marks for which a label could be
    mistaken."""

    layers: Mapping[str, tuple[Primitive, ...]] = field(default_factory=dict)
    labels: tuple[Label, ...] = ()
    marks: tuple[Mark, ...] = ()

    @property
    def drawn(self) -> tuple[Primitive, ...]:
        return tuple(part for layer in self.layers.values() for part in layer)


def joined(pieces: Iterable[Piece]) -> Piece:
    """Several pieces as one."""
    layers: dict[str, tuple[Primitive, ...]] = {}
    labels: tuple[Label, ...] = ()
    marks: tuple[Mark, ...] = ()
    for piece in pieces:
        for layer, things in piece.layers.items():
            layers[layer] = layers.get(layer, ()) + things
        labels += piece.labels
        marks += piece.marks
    return Piece(layers, labels, marks)


def dated(piece: Piece, since: int | None) -> Piece:
    """The piece with the number of the step from which it is shown, on its parts and names without one."""

    def known(part: Primitive) -> Primitive:
        return part._replace(since=since) if isinstance(part, Group | Text) and part.since is None else part

    layers = {layer: tuple(map(known, things)) for layer, things in piece.layers.items()}
    names = (label.text if label.text.since else label.text._replace(since=since) for label in piece.labels)
    labels = (replace(label, text=name) for label, name in zip(piece.labels, names, strict=True))
    return Piece(layers, tuple(labels), piece.marks)


def layer_groups(piece: Piece) -> tuple[Group, ...]:
    """The layers of a page as groups with names, in the order of drawing."""
    return tuple(Group(piece.layers[name], id=name, layer=name) for name in LAYERS if piece.layers.get(name))


WIDE = 20.0  # mm: an outline as wide as this is the body of a link, no arrowhead or hatching


def cut_to(children: Iterable[Primitive], box: Box, bodies: bool = False) -> tuple[Primitive, ...]:
    """The part of primitives in a box: lines are cut at its edge, other primitives left out if they cross it; with
    ``bodies`` the outlines of wide ones are cut as well."""

    def cut(part: Primitive) -> Primitive | None:
        if isinstance(part, Group):
            return part
        if isinstance(part, Line):
            inside = box.clip(part.start, part.end)
            return None if inside is None or inside[0] == inside[1] else part._replace(start=inside[0], end=inside[1])
        reach = _outermost(part)
        around = Box.around(reach) if reach else None
        if around is None or box.holds(around):
            return part if around else None
        if bodies and isinstance(part, Polygon | Circle) and max(around.width, around.height) > WIDE:
            return _body_in(part, box)
        return None

    return map_tree(children, cut)


def _body_in(body: Polygon | Circle, box: Box) -> Group:
    """The part of an area in a box, and of its outline, which has no line along the edge of the box."""
    import shapely  # few bodies are larger than their panel

    ring = _round(body) if isinstance(body, Circle) else (*body.points, body.points[0])
    corners = [(place.real, place.imag) for place in ring]

    def inside(shape: shapely.Geometry) -> list[tuple[complex, ...]]:
        parts = shapely.get_parts(shapely.clip_by_rect(shape, box.left, box.top, box.right, box.bottom))
        return [tuple(complex(*place) for place in shapely.get_coordinates(part).tolist()) for part in parts]

    filled = [Polygon(area, body.fill) for area in inside(shapely.Polygon(corners)) if body.fill]
    lines = [Polyline(line, body.stroke) for line in inside(shapely.LineString(corners)) if body.stroke]
    return Group((*filled, *lines))


def kept_in(piece: Piece, box: Box) -> int:
    """The number of names of a piece in a box, and of primitives that are left out because they cross its edge."""
    parts = walk(cut_to(piece.drawn, box))
    names = sum(box.distance(middle_of(name.mark)) == 0.0 for name in piece.labels)
    return names + sum(not isinstance(part, Line | Group) for part in parts)


def ink_box(children: Iterable[Primitive]) -> Box | None:
    """The box around all primitives, without line widths; None without primitives."""
    held = [z for part in walk(tuple(children)) for z in _outermost(part)]
    return Box.around(held) if held else None


def _outermost(part: Primitive) -> Sequence[complex]:
    """The extreme points of a primitive; none of a group."""
    if isinstance(part, Line):
        return part.start, part.end
    if isinstance(part, Text):
        if not part.runs:
            return ()
        box = text_box(part)
        return complex(box.left, box.top), complex(box.right, box.bottom)
    if isinstance(part, Polyline | Polygon):
        return part.points
    if isinstance(part, Circle):
        corner = complex(part.radius, part.radius)
        return part.centre - corner, part.centre + corner
    if isinstance(part, Arc):
        steps = [part.start + (part.end - part.start) * i / 12 for i in range(13)]
        return [part.at(angle) for angle in steps]
    return ()


def moved_piece(piece: Piece, by: complex) -> Piece:
    """The piece moved on the page."""
    labels = tuple(replace(label, mark=mapped(label.mark, by.__add__)) for label in piece.labels)
    layers = {layer: moved(things, by) for layer, things in piece.layers.items()}
    return Piece(layers, labels, tuple(mapped(mark, by.__add__) for mark in piece.marks))


def renamed(piece: Piece, suffix: str) -> Piece:
    """The piece with other ids, for a page with others of its kind."""

    def renamed(part: Primitive) -> Primitive:
        return part._replace(id=part.id + suffix) if isinstance(part, Group | Text) and part.id else part

    return replace(piece, layers={layer: map_tree(things, renamed) for layer, things in piece.layers.items()})


def middle_of(mark: Mark) -> complex:
    """The middle of a mark."""
    return (mark[0] + mark[1]) / 2 if isinstance(mark, tuple) else mark


# A filled polygon up to this size (mm) is a block or a corner, which no label may cover; a larger one is the tint of a
# link, on which labels may stand, clear of its edges.  For one no larger than an arrowhead the upright box will do.
SMALL, TINY = 12.0, 3.2
THICK = 0.3  # mm: lines as wide as this are vectors and links
_ARC_STEP, _SAGITTA = math.radians(12), 0.5  # of a chord that is taken for a part of an arc: its angle, its height (mm)


def obstacles_of(children: tuple[Primitive, ...]) -> Obstacles:
    """All primitives as obstacles: strokes and the outlines of blocks as segments; circles, arrowheads and texts as
    areas."""
    solid: list[Segment] = []
    dashed: list[Segment] = []
    areas: list[Box] = []
    writing: list[Box] = []
    thick: list[Segment] = []
    for part in walk(children):
        if isinstance(part, Group):
            continue
        if isinstance(part, Text):
            if part.runs:
                writing.append(text_box(part))
        elif isinstance(part, Line):
            (dashed if part.stroke.dash else solid).append((part.start, part.end))
            if not part.stroke.dash and part.stroke.width >= THICK:
                thick.append((part.start, part.end))
        elif isinstance(part, Circle) and not part.fill and part.stroke and part.radius > SMALL / 2:
            # the outline of a disc: labels may stand inside
            (solid if part.stroke.solid else dashed).extend(pairwise(_round(part)))
        elif isinstance(part, Circle):
            reach = part.radius + (part.stroke.width / 2 if part.stroke else 0.0)
            x, y = part.centre.real, part.centre.imag
            areas.append(Box(x - reach, y - reach, x + reach, y + reach))
        elif isinstance(part, Polygon) and part.fill and _longer_side(box := Box.around(part.points)) <= SMALL:
            if _longer_side(box) <= TINY:
                areas.append(box)
            else:  # its outline, and lines across that leave no label room inside
                count = len(part.points)
                solid.extend(pairwise(_corners(part)))
                solid.extend((part.points[i], part.points[(i + count // 2) % count]) for i in range(count // 2))
        elif isinstance(part, Polyline | Polygon | Arc) and part.stroke is not None:
            course = tuple(pairwise(_corners(part)))
            (solid if part.stroke.solid else dashed).extend(course)
            if part.stroke.solid and part.stroke.width >= THICK:
                thick.extend(course)
    return Obstacles(tuple(solid), tuple(dashed), (*writing, *areas), tuple(writing), tuple(thick))


def _corners(part: Polyline | Polygon | Arc) -> tuple[complex, ...]:
    if isinstance(part, Polyline):
        return part.points
    if isinstance(part, Polygon):
        return *part.points, part.points[0]
    turn = min(_ARC_STEP, 2 * math.sqrt(2 * _SAGITTA / max(part.radius, 1.0)))
    steps = max(1, math.ceil(abs(part.end - part.start) / turn))
    return tuple(part.at(part.start + (part.end - part.start) * i / steps) for i in range(steps + 1))


def _round(circle: Circle) -> tuple[complex, ...]:
    steps = max(24, math.ceil(circle.radius))
    return tuple(circle.centre + circle.radius * page_direction(2 * math.pi * k / steps) for k in range(steps + 1))


def _longer_side(box: Box) -> float:
    return max(box.width, box.height)
