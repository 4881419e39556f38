"""Obstacles on a figure: solid lines, dashed lines, and areas that no label may cover; the intersection of many lines
and upright boxes at once; the first free of some places, for numbers of steps, insets and lists of names; and the
search for the cheapest: the first clear one for dimensions, the clearest one for arcs of rates and arrows to far
centres.

Many boxes are arrays of complex numbers, by their middle and half size; many segments have their two ends in the last
dimension.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import accumulate, islice, pairwise
from operator import add
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Segment, on_page

Points: TypeAlias = NDArray[np.complex128]
Floats: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]
Indices: TypeAlias = NDArray[np.intp]
Sides: TypeAlias = Sequence[Floats]
"""Left, top, right, bottom of upright boxes."""

ON_LINE = 1e-9  # mm⁴: so near to a line, but for rounding, lies on it
MOST_PAIRS = 1 << 16  # of boxes compared at a time: what a processor holds near
BUFFER = 256  # numbers


@contextmanager
def short_buffers() -> Iterator[None]:
    """Compare short rows with many others faster: NumPy copies rows into its buffer where they fill less than a third
    of it, which takes seven times as long as to compare them."""
    usual = np.setbufsize(BUFFER)
    try:
        yield
    finally:
        np.setbufsize(usual)


def in_rows(points: Points) -> Floats:
    """Points as x and y in two rows, shape (2, ...)."""
    return np.array((points.real, points.imag))


def segments_of(ends: Sequence[Segment]) -> Points:
    """Segments as an array, shape (segments, 2)."""
    return np.array(ends, dtype=complex).reshape(-1, 2)


def boxes_of(boxes: Iterable[Box]) -> Points:
    """Middles and half sizes of boxes, shape (2, boxes)."""
    held = [(box.centre, complex(box.width, box.height) / 2) for box in boxes]
    return np.array(held, dtype=complex).reshape(-1, 2).T


def stand_on(middles: Points, reach: Points, taken: Points) -> Flags:
    """Whether boxes of these middles and half sizes (rows) stand on taken boxes, shape (2, columns); one of nan stands
    on none."""
    offset, room = middles[:, None] - taken[0], reach[:, None] + taken[1]
    met: Flags = (np.abs(offset.real) < room.real) & (np.abs(offset.imag) < room.imag)
    return met


def sides(middles: Floats, halves: Floats) -> Sides:
    """The sides of boxes of these middles and half sizes, in rows."""
    return *(middles - halves), *(middles + halves)


def sides_around(start: Floats, end: Floats) -> Sides:
    """The sides of the boxes around segments with ends in rows."""
    return *np.minimum(start, end), *np.maximum(start, end)


def overlapping(boxes: Sides, others: Sides) -> Flags:
    """Whether upright boxes (columns) meet others (rows); a box of nan meets none."""
    left, top, right, bottom = (side[:, None] for side in others)  # the many lie side by side in memory
    met: Flags = boxes[0] <= right
    met &= boxes[2] >= left
    met &= boxes[1] <= bottom
    met &= boxes[3] >= top
    return met


def near(boxes: Sides, others: Sides) -> tuple[Indices, Indices]:
    """The pairs of upright boxes that meet, by their indices."""
    width = len(boxes[0])
    rows = max(1, MOST_PAIRS // max(1, width))
    pairs = [np.empty(0, dtype=np.intp)]
    for first in range(0, len(others[0]), rows):
        met = overlapping(boxes, [side[first : first + rows] for side in others])
        pairs.append(met.ravel().nonzero()[0] + first * width)
    other, which = np.divmod(np.concatenate(pairs), max(1, width))
    return which, other


def separated(offset: Floats, half: Floats, along: Floats) -> Flags:
    """Whether the normal of a segment separates it from a box; the caller checks the axes of the box.

    Parameters
    ----------
    offset : from the start of each segment to the middle of its box, shape (2, n) (mm), as the others
    half : half the size of the box
    along : from the start of the segment to its end
    """
    distance = np.abs(along[0] * offset[1] - along[1] * offset[0])
    separate: Flags = distance > half[0] * np.abs(along[1]) + half[1] * np.abs(along[0])
    return separate


def meets(segments: Points, centres: Points, half: Points) -> tuple[Indices, Indices]:
    """The pairs of segments, of shape (n, 2), and boxes that meet, by their indices."""
    start, end, middles, halves = map(in_rows, (*segments.T, centres, half))
    which, box = near(sides_around(start, end), sides(middles, halves))
    offset, along = middles.take(box, axis=1) - start.take(which, axis=1), (end - start).take(which, axis=1)
    met = (~separated(offset, halves.take(box, axis=1), along)).nonzero()[0]
    return which.take(met), box.take(met)


def crosses(lines: Floats, others: Floats) -> Flags:
    """Whether lines cross others between their ends, both by starts and ends, each in rows, shape (2, 2, lines)."""
    crossed: Flags = (_off(lines, others) < 0) & (_off(others, lines) < 0)
    return crossed


def touching(lines: Floats, others: Floats) -> Flags:
    """Whether lines cross others between their ends, or one ends on the other; shapes as for `crosses`."""
    touched: Flags = (_off(lines, others) <= ON_LINE) & (_off(others, lines) <= ON_LINE)
    return touched


def _off(ends: Floats, lines: Floats) -> Floats:
    """Negative where two ends lie on either side of an endless line."""
    x, y = lines[1] - lines[0]
    offset = ends - lines[0]
    areas: Floats = x * offset[:, 1] - y * offset[:, 0]
    product: Floats = areas[0] * areas[1]
    return product


@dataclass(frozen=True)
class Obstacles:
    """Segments, and areas as upright boxes, on the page in mm; ``writing`` are areas that leaders may not cross either,
    ``thick`` solid segments that they should avoid: vectors and links, ``vectors`` those beyond which no letter of a
    point may stand without a leader."""

    solid: tuple[Segment, ...] = ()
    dashed: tuple[Segment, ...] = ()
    areas: tuple[Box, ...] = ()
    writing: tuple[Box, ...] = ()
    thick: tuple[Segment, ...] = ()
    vectors: tuple[Segment, ...] = ()

    def __add__(self, other: Obstacles) -> Obstacles:
        return Obstacles(*map(add, vars(self).values(), vars(other).values()))


TRIED = 48  # places at a time
ROUNDING = 1e-6  # of a price


def cheapest(places: Iterable[tuple[float, int]], charge: Callable[[list[int]], Floats]) -> int | None:
    """The cheapest of some places, the first of equals but for rounding; None where none has room.

    Parameters
    ----------
    places : each by its number, with its own price, the cheapest first
    charge : the further cost of some of them for obstacles, infinite where they have no room
    """
    best, least, left = None, math.inf, iter(places)
    while lot := [*islice(left, TRIED)]:
        prices, some = zip(*lot, strict=True)
        costs = prices + charge([*some])
        i = int(np.argmin(np.round(costs / ROUNDING)))
        if costs[i] < least:
            best, least = some[i], float(costs[i]) - ROUNDING
        if prices[-1] >= least:
            break  # nor can those behind it be cheaper
    return best


STEP = 6.0  # mm from one place tried to the next along the edge of the panel
CLEAR = 2.0  # mm between an inset and what is drawn


def first_free(
    choices: Sequence[Points], halves: Sequence[complex], around: Obstacles, clear: float, panel: Box | None = None
) -> list[int | None]:
    """For some boxes in order the index of the first clear place of each.

    Parameters
    ----------
    choices : middles (mm) of the places of each box in order of preference, nan for none
    halves : half the size of each box (mm, across and down)
    around : all strokes and texts
    clear : mm around a box without strokes, texts, and earlier boxes
    panel : no box comes nearer to its edge either
    """
    sizes = [len(places) for places in choices]
    middles = np.concatenate(choices)
    half = np.repeat(np.array(halves), sizes)
    reach = half + clear * (1 + 1j)
    covered: Flags = np.any(stand_on(middles, reach, boxes_of(around.areas)), axis=1)
    covered[meets(segments_of((*around.solid, *around.dashed)), middles, reach)[1]] = True
    free = ~(covered | np.isnan(middles))
    if panel is not None:
        low, high = middles - reach, middles + reach
        free &= (low.real >= panel.left) & (high.real <= panel.right)
        free &= (low.imag >= panel.top) & (high.imag <= panel.bottom)
    chosen: list[int | None] = []
    for first, size, extent in zip(accumulate(sizes, initial=0), sizes, halves, strict=False):
        room = free[first : first + size].nonzero()[0]
        place = int(room[0]) if room.size else None
        chosen.append(place)
        if place is not None:  # it is in the way of those that come behind it
            free &= ~stand_on(middles, reach, np.array([(middles[first + place],), (extent,)]))[:, 0]
    return chosen


def free_boxes(
    count: int, size: tuple[float, float], panel: Box, obstacles: Obstacles, clear: float = CLEAR
) -> list[Box]:
    """Up to ``count`` boxes of a size (mm) along the edges of a panel, ``clear`` (mm) of strokes; corners first."""
    boxes = _places(size, panel)
    middles = np.array([box.centre for box in boxes], dtype=complex)
    places = first_free([middles] * count, [complex(*size) / 2] * count, obstacles, clear) if count else []
    return [boxes[i] for i in places if i is not None]


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


ARC_RADII = (5.5, 8.0, 11.0)  # mm, in the order of liking
HALF_SPAN = math.radians(37)
LABEL_AT = 3.6  # mm beyond the arc: where its name would stand
CLEAR_ARC, CLEAR_LABEL = 1.9, 2.6  # mm
_MIDDLES = np.arange(20) * (2 * math.pi / 20)
_SPREAD = np.linspace(-HALF_SPAN, HALF_SPAN, 5)


def clearest_arc(
    centres: Sequence[complex], radius: float, around: Sequence[Segment]
) -> tuple[tuple[complex, float, float], tuple[Segment, ...]]:
    """The clearest place for an arc with its name about one of some page points.

    Parameters
    ----------
    centres : page points in order of preference
    radius : the least radius (mm)
    around : segments from which it keeps clear

    Returns
    -------
    centre, radius (mm) and middle direction (rad), and the segments from which others keep clear of it
    """
    ends = segments_of(around)
    reach = radius + ARC_RADII[-1] - ARC_RADII[0] + LABEL_AT + CLEAR_LABEL
    near = ends[(distances(np.array(centres, dtype=complex), ends) < reach).any(axis=0)]
    radii = np.array([radius + r - ARC_RADII[0] for r in ARC_RADII])
    directions = on_page(np.exp(1j * (_MIDDLES[:, None] + _SPREAD)))  # middle x sample
    arcs = np.array(centres)[:, None, None, None] + radii[:, None, None] * directions
    names = np.array(centres)[:, None, None] + (radii[:, None] + LABEL_AT) * on_page(np.exp(1j * _MIDDLES))
    prices = 0.35 * (radii - radius)[:, None] + 0.5 * np.arange(len(centres))[:, None, None]
    prices = prices + 0.05 * np.abs(np.angle(np.exp(1j * (_MIDDLES - math.radians(50)))))
    clear = (arcs.reshape(-1, len(_SPREAD)), CLEAR_ARC, 10.0), (names.reshape(-1, 1), CLEAR_LABEL, 2.0)
    c, r, m = np.unravel_index(clearest(prices.ravel(), clear, near), prices.shape)
    name = complex(names[c, r, m])
    taken = (*pairwise(arcs[c, r, m].tolist()), (name - 1.2, name + 1.2))
    return (centres[int(c)], float(radii[r]), float(_MIDDLES[m])), taken


def clearest(prices: Floats, clear: Sequence[tuple[Points, float, float]], around: Points) -> int:
    """The index of the cheapest of some places, of those that cost alike but for rounding the first: each has a price
    of its own, and pays for every point that lies too near to a segment.

    Parameters
    ----------
    prices : of the places, shape (places,)
    clear : points of the places, shape (places, points), the room that they want (mm), and what a mm less costs
    around : segments, shape (segments, 2)
    """

    def charge(some: list[int]) -> Floats:
        costs = np.zeros(len(some))
        for points, room, per_mm in clear:
            nearest = distances(points[some], around).min(axis=-1, initial=np.inf)
            costs += per_mm * np.clip(room - nearest, 0.0, None).sum(axis=-1)
        return costs

    order: list[int] = np.argsort(np.round(prices / ROUNDING), kind="stable").tolist()
    place = cheapest(zip(prices[order].tolist(), order, strict=True), charge)
    assert place is not None, "strokes make a place dearer, they do not take it"
    return place


def distances(points: NDArray[Any], segments: Points) -> Floats:
    """Distance of each point to each of some segments of shape (n, 2): these in a last dimension."""
    # copies lie side by side in memory, which halves the time
    start, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    way_x, way_y = along.real.copy(), along.imag.copy()
    x, y = points.real[..., None] - start.real.copy(), points.imag[..., None] - start.imag.copy()
    share = np.clip((x * way_x + y * way_y) / np.maximum(way_x**2 + way_y**2, 1e-18), 0.0, 1.0)
    x -= share * way_x
    y -= share * way_y
    far: Floats = np.sqrt(x * x + y * y)
    return far
