"""What stands in the way on a figure: solid lines, dashed lines, and areas that nothing may cover; and what takes the
first free of its places: numbers of steps, insets, lists of names.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate, pairwise

import numpy as np

from graphkin.drawing.box import Box
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
from graphkin.drawing.place.intersections import Flags, Points, meets
from graphkin.drawing.place.labels import Obstacles
from graphkin.drawing.text import text_box

__all__ = ["CLEAR", "first_free", "free_boxes", "obstacles_of"]

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


def first_free(
    choices: Sequence[Points], halves: Sequence[complex], around: Obstacles, clear: float, panel: Box | None = None
) -> list[int | None]:
    """For some boxes, one after the other, the index of the first of its places where it stands clear of everything.

    Parameters
    ----------
    choices : middles (mm) of the places of each box in the order of liking, nan for none
    halves : half the size of each box (mm, across and down)
    around : what is drawn and written
    clear : mm around a box that are free of all that, and of the boxes before it
    panel : no box comes nearer to its edge than that either
    """
    sizes = [len(places) for places in choices]
    middles = np.concatenate(choices)
    half = np.repeat(np.array(halves), sizes)
    reach = half + clear * (1 + 1j)
    free = ~_covered(middles, reach, around)
    if panel is not None:
        low, high = middles - reach, middles + reach
        free &= (low.real >= panel.left) & (high.real <= panel.right)
        free &= (low.imag >= panel.top) & (high.imag <= panel.bottom)
    found: list[int | None] = []
    for first, size, own in zip(accumulate(sizes, initial=0), sizes, halves, strict=False):
        places = middles[first : first + size]
        open_ = (free[first : first + size] & ~np.isnan(places)).nonzero()[0]
        found.append(int(open_[0]) if open_.size else None)
        if open_.size:  # it is in the way of those that come behind it
            off, room = middles - places[open_[0]], reach + own
            free &= (np.abs(off.real) >= room.real) | (np.abs(off.imag) >= room.imag)
    return found


def _covered(middles: Points, reach: Points, around: Obstacles) -> Flags:
    """On which boxes of these middles and half sizes anything stands."""
    lines = np.array((*around.solid, *around.dashed), dtype=complex).reshape(-1, 2)
    covered: Flags = np.zeros(len(middles), dtype=bool)
    covered[meets(lines, middles, reach)[1]] = True
    if around.areas:
        areas = np.array([(box.centre, complex(box.width, box.height) / 2) for box in around.areas])
        off, room = middles[:, None] - areas[:, 0], reach[:, None] + areas[:, 1]
        covered |= ((np.abs(off.real) < room.real) & (np.abs(off.imag) < room.imag)).any(axis=1)
    return covered


def free_boxes(
    count: int, size: tuple[float, float], panel: Box, obstacles: Obstacles, clear: float = CLEAR
) -> list[Box]:
    """Up to ``count`` boxes of a size (mm) along the edges of a panel, ``clear`` (mm) of what is drawn; corners
    first."""
    boxes = _places(size, panel)
    middles = np.array([box.centre for box in boxes], dtype=complex)
    found = first_free([middles] * count, [complex(*size) / 2] * count, obstacles, clear) if count else []
    return [boxes[i] for i in found if i is not None]


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
