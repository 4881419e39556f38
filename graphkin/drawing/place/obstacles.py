"""What stands in the way of a label on a figure: solid lines, dashed lines, and areas that no label may cover; and room
along the edges of a panel that nothing drawn or written takes.
"""

from __future__ import annotations

import math
from itertools import pairwise

from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import text_box
from graphkin.drawing.ink.primitives import (
    Arc,
    Circle,
    Line,
    Polygon,
    Polyline,
    Primitive,
    Segment,
    Text,
    page_direction,
    walk,
)
from graphkin.drawing.place.labels import Obstacles

__all__ = ["CLEAR", "free_boxes", "obstacles_of"]

# A filled polygon up to this size (mm) is a block or a corner, which no label may cover; a larger one is the tint of a
# link, on which labels may stand, clear of its edges.  For one no larger than an arrowhead the upright box will do.
SMALL, TINY = 12.0, 3.2
THICK = 0.3  # mm: lines as wide as this are vectors and links
_ARC_STEP = math.radians(12)


def obstacles_of(children: tuple[Primitive, ...]) -> Obstacles:
    """Everything drawn as obstacles: strokes and the outlines of blocks as segments; circles, arrowheads and texts as
    areas."""
    solid: list[Segment] = []
    dashed: list[Segment] = []
    areas: list[Box] = []
    writing: list[Box] = []
    thick: list[Segment] = []
    for thing in walk(children):
        if isinstance(thing, Text):
            if thing.runs:
                writing.append(text_box(thing))
        elif isinstance(thing, Circle) and not thing.fill and thing.stroke and thing.radius > SMALL / 2:
            # the outline of a disc: labels may stand inside
            (solid if thing.stroke.solid else dashed).extend(pairwise(_round(thing)))
        elif isinstance(thing, Circle):
            reach = thing.radius + (thing.stroke.width / 2 if thing.stroke else 0.0)
            x, y = thing.centre.real, thing.centre.imag
            areas.append(Box(x - reach, y - reach, x + reach, y + reach))
        elif isinstance(thing, Polygon) and thing.fill and _size(thing) <= SMALL:
            if _size(thing) <= TINY:
                areas.append(Box.around(thing.points))
            else:  # its outline, and lines across that leave no label room inside
                count = len(thing.points)
                solid.extend(pairwise(_corners(thing)))
                solid.extend((thing.points[i], thing.points[(i + count // 2) % count]) for i in range(count // 2))
        elif isinstance(thing, Line | Polyline | Polygon | Arc) and thing.stroke is not None:
            course = tuple(pairwise(_corners(thing)))
            (solid if thing.stroke.solid else dashed).extend(course)
            if thing.stroke.solid and thing.stroke.width >= THICK:
                thick.extend(course)
    return Obstacles(tuple(solid), tuple(dashed), (*writing, *areas), tuple(writing), tuple(thick))


def _corners(thing: Line | Polyline | Polygon | Arc) -> tuple[complex, ...]:
    if isinstance(thing, Line):
        return thing.start, thing.end
    if isinstance(thing, Polyline):
        return thing.points
    if isinstance(thing, Polygon):
        return *thing.points, thing.points[0]
    steps = max(1, math.ceil(abs(thing.end - thing.start) / _ARC_STEP))
    return tuple(thing.at(thing.start + (thing.end - thing.start) * i / steps) for i in range(steps + 1))


def _round(circle: Circle) -> tuple[complex, ...]:
    steps = max(24, math.ceil(circle.radius))
    return tuple(circle.centre + circle.radius * page_direction(2 * math.pi * k / steps) for k in range(steps + 1))


def _size(polygon: Polygon) -> float:
    box = Box.around(polygon.points)
    return max(box.width, box.height)


STEP = 6.0  # mm from one place tried to the next along the edge of the panel
CLEAR = 2.0  # mm between an inset and what is drawn


def free_boxes(
    count: int, size: tuple[float, float], panel: Box, obstacles: Obstacles, clear: float = CLEAR
) -> list[Box]:
    """Up to ``count`` boxes of a size (mm) along the edges of a panel, ``clear`` (mm) of what is drawn; corners
    first."""
    found: list[Box] = []
    for box in _places(size, panel):
        if len(found) == count:
            break
        wide = box.grown(clear)
        if any(wide.overlaps(other) for other in (*found, *obstacles.areas)):
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
