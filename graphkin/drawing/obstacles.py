"""What stands in the way of a label on a figure: solid lines, dashed lines, and areas that no label may cover."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

from graphkin.drawing.box import Box
from graphkin.drawing.primitives import Arc, Circle, Line, Polygon, Polyline, Primitive, Text, walk
from graphkin.drawing.text import text_box

__all__ = ["Obstacles", "obstacles_of"]

Segment = tuple[complex, complex]

# A filled polygon up to this size (mm) is a block or a corner, which no label may cover; a larger one is the tint of a
# link, on which labels may stand, clear of its edges.  For one no larger than an arrowhead the upright box will do.
SMALL, TINY = 12.0, 3.2
_ARC_STEP = math.radians(12)


@dataclass(frozen=True)
class Obstacles:
    """Segments, and areas as upright boxes, on the page in mm; ``writing`` are those of the areas that leaders may not
    run over either."""

    solid: tuple[Segment, ...] = ()
    dashed: tuple[Segment, ...] = ()
    areas: tuple[Box, ...] = ()
    writing: tuple[Box, ...] = ()

    def __add__(self, other: Obstacles) -> Obstacles:
        return Obstacles(
            self.solid + other.solid,
            self.dashed + other.dashed,
            self.areas + other.areas,
            self.writing + other.writing,
        )


def obstacles_of(children: tuple[Primitive, ...]) -> Obstacles:
    """Everything drawn as obstacles: strokes and the outlines of blocks as segments; circles, arrowheads and texts as
    areas."""
    solid: list[Segment] = []
    dashed: list[Segment] = []
    areas: list[Box] = []
    writing: list[Box] = []
    for thing in walk(children):
        if isinstance(thing, Text):
            if thing.runs:
                writing.append(text_box(thing))
        elif isinstance(thing, Circle):
            reach = thing.radius + (thing.stroke.width / 2 if thing.stroke else 0.0)
            areas.append(Box.around((thing.centre,)).grown(reach))
        elif isinstance(thing, Polygon) and thing.fill and _size(thing) <= SMALL:
            if _size(thing) <= TINY:
                areas.append(Box.around(thing.points))
            else:  # its outline, and lines across that leave no label room inside
                count = len(thing.points)
                solid.extend(pairwise(_course(thing)))
                solid.extend((thing.points[i], thing.points[(i + count // 2) % count]) for i in range(count // 2))
        elif isinstance(thing, Line | Polyline | Polygon | Arc) and thing.stroke is not None:
            (solid if thing.stroke.solid else dashed).extend(pairwise(_course(thing)))
    return Obstacles(tuple(solid), tuple(dashed), (*writing, *areas), tuple(writing))


def _course(thing: Line | Polyline | Polygon | Arc) -> tuple[complex, ...]:
    if isinstance(thing, Line):
        return thing.start, thing.end
    if isinstance(thing, Polyline):
        return thing.points
    if isinstance(thing, Polygon):
        return *thing.points, thing.points[0]
    steps = max(1, math.ceil(abs(thing.end - thing.start) / _ARC_STEP))
    return tuple(thing.at(thing.start + (thing.end - thing.start) * i / steps) for i in range(steps + 1))


def _size(polygon: Polygon) -> float:
    box = Box.around(polygon.points)
    return max(box.width, box.height)
