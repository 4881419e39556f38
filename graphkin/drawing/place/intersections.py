"""Whether lines and upright boxes meet, for many at once: arrays of complex numbers, boxes by their middle and half
size, segments with their two ends in the last dimension."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from graphkin.plane import cross

__all__ = [
    "ON_LINE", "Flags", "Floats", "Indices", "Points", "crosses", "joined", "meets", "near", "separated", "sides",
    "sides_around", "touching",
]  # fmt: skip

Points: TypeAlias = NDArray[np.complex128]
Floats: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]
Indices: TypeAlias = NDArray[np.intp]
Sides: TypeAlias = tuple[Floats, Floats, Floats, Floats]
"""Left, top, right, bottom of upright boxes."""

ON_LINE = 1e-9  # mm⁴: so near to a line, but for rounding, lies on it
MOST_PAIRS = 1 << 15  # of boxes compared at a time: what a processor holds near


def sides(low: Points, high: Points) -> Sides:
    """Of boxes with these corners."""
    return low.real.copy(), low.imag.copy(), high.real.copy(), high.imag.copy()


def sides_around(start: Points, end: Points) -> Sides:
    """Of the boxes around segments."""
    left, right, top, bottom = start.real, end.real, start.imag, end.imag
    return np.minimum(left, right), np.minimum(top, bottom), np.maximum(left, right), np.maximum(top, bottom)


def near(boxes: Sides, others: Sides) -> Iterator[tuple[Indices, Indices]]:
    """Pairs of upright boxes that meet, by their indices, in lots; a box of nan meets none."""
    left, top, right, bottom = others
    count = len(left)
    if not count:
        return
    rows = max(1, MOST_PAIRS // count)
    for first in range(0, len(boxes[0]), rows):
        own_left, own_top, own_right, own_bottom = (side[first : first + rows, None] for side in boxes)
        meeting = left <= own_right
        meeting &= right >= own_left
        meeting &= top <= own_bottom
        meeting &= bottom >= own_top
        pairs = meeting.ravel().nonzero()[0]
        which = pairs // count
        pairs -= which * count
        if first:
            which += first
        yield which, pairs


def joined(lots: Sequence[tuple[Indices, Indices]]) -> tuple[Indices, Indices]:
    """All pairs of some lots."""
    if len(lots) == 1:
        return lots[0]
    none = np.empty(0, dtype=np.intp)
    which, what = zip((none, none), *lots, strict=True)
    return np.concatenate(which), np.concatenate(what)


def separated(centres: Points, half: Points | complex, start: Points, end: Points) -> Flags:
    """Whether the normal of a segment separates it from a box (of centre and half size); the axes of the box are the
    caller's to check."""
    along = end - start
    distance = np.abs(cross(along, centres - start))
    apart: Flags = distance > half.real * np.abs(along.imag) + half.imag * np.abs(along.real)
    return apart


def meets(segments: Points, centres: Points, half: Points) -> tuple[Indices, Indices]:
    """Which segments, of shape (n, 2), meet which boxes, by their indices."""
    start, end = segments[:, 0], segments[:, 1]
    middle, reach = (start + end) / 2, (end - start) / 2
    close = _close(middle.real, reach.real, centres.real, half.real)
    close &= _close(middle.imag, reach.imag, centres.imag, half.imag)
    which, what = close.nonzero()
    met = ~separated(centres[what], half[what], start[which], end[which])
    return which[met], what[met]


def _close(middle: Floats, reach: Floats, centre: Floats, half: Floats) -> Flags:
    """Whether the boxes around segments and other boxes meet along an axis."""
    # copies lie side by side in memory, which halves the time
    found: Flags = np.abs(middle[:, None] - centre.copy()) <= np.abs(reach)[:, None] + half.copy()
    return found


def crosses(a: Points, b: Points, c: Points, d: Points) -> Flags:
    """Whether lines from a to b cross lines from c to d between their ends."""
    found: Flags = (_off(a, b, c, d) < 0) & (_off(c, d, a, b) < 0)
    return found


def touching(a: Points, b: Points, c: Points, d: Points) -> Indices:
    """Which lines from a to b cross lines from c to d between their ends, or of which one ends on the other."""
    some = (_off(a, b, c, d) <= ON_LINE).nonzero()[0]  # few: only these are looked at from the other side
    both = _off(c.take(some), d.take(some), a.take(some), b.take(some)) <= ON_LINE
    found: Indices = some[both]
    return found


def _off(a: Points, b: Points, c: Points, d: Points) -> Floats:
    """Negative where points a and b lie on either side of the endless lines through c and d."""
    along = d - c
    found: Floats = cross(along, a - c) * cross(along, b - c)
    return found
