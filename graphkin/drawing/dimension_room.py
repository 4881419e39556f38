"""Whether there is room for a dimension: clear of the mechanism and of other dimensions, its extension lines beginning
beyond the symbols of the points that they come from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.metrics import text_box
from graphkin.drawing.obstacles import Obstacles
from graphkin.drawing.primitives import Arc, Line, Polygon, Text
from graphkin.drawing.seats import cross_product, meets

__all__ = ["Parts", "Room"]

AROUND_POINT = 11.0  # mm around a point in which lines belong to its own symbols
TRIM, LEAST_EXTENSION = 0.8, 2.2  # mm between a symbol and an extension line; a shorter one is none

Parts: TypeAlias = tuple[Line | Polygon | Arc | Text, ...]


class Room:
    """What is drawn already, as arrays: segments, and boxes by their middle and half size."""

    def __init__(self, obstacles: Obstacles, panel: Box | None) -> None:
        self.panel = panel
        self.segments = np.array(obstacles.solid, dtype=complex).reshape(-1, 2)
        self.middles, self.halves = _arrays(obstacles.areas)
        corners = [z for box in obstacles.areas for z in box.corners] + [z for s in obstacles.solid for z in s]
        self.content = Box.around(corners) if corners else Box(0, 0, 0, 0)

    def take(self, parts: Parts, extensions: int = 2, over: bool = False) -> Parts | None:
        """The dimension, added to what is drawn, if it is clear of everything; None if not.

        Its first lines are extension lines: they begin beyond what stands around the point they come from, and run
        over other lines where that is allowed.
        """
        boxes = [text_box(part) if isinstance(part, Text) else Box.around(part.points)
                 for part in parts if isinstance(part, Text | Polygon)]  # fmt: skip
        if self.panel is not None and not all(self.panel.holds(box) for box in boxes):
            return None
        lines = [part for part in parts if isinstance(part, Line)]
        ends = [(line.start, line.end) for line in lines[extensions:]]
        for arc in (part for part in parts if isinstance(part, Arc)):
            course = [arc.at(arc.start + (arc.end - arc.start) * (0.06 + 0.11 * i)) for i in range(9)]
            ends += pairwise(course)
        own = np.array(ends, dtype=complex).reshape(-1, 2)
        middles, halves = _arrays(boxes)
        if self._covered(middles, halves) or self._over_areas(own) or len(_crossings(own, self.segments)[0]):
            return None
        trimmed = [self._trimmed(line) for line in lines[:extensions]]
        beyond = np.array([(line.start, line.end) for line in trimmed if line is not None], dtype=complex)
        if len(beyond) < extensions or (extensions and self._over_areas(beyond)):
            return None
        if extensions and not over and len(_crossings(beyond, self.segments)[0]):
            return None
        words, sizes = _arrays([text_box(part) for part in parts if isinstance(part, Text)])
        lines_of_it = np.concatenate((own, beyond.reshape(-1, 2)))
        if meets(lines_of_it[:, None], words[None], sizes[None]).any():
            return None  # a number past the end of a short dimension stands on the next one
        self.segments = np.concatenate((self.segments, lines_of_it))
        self.middles, self.halves = np.concatenate((self.middles, middles)), np.concatenate((self.halves, halves))
        kept = tuple(line for line in trimmed if line is not None)
        return *kept, *(part for part in parts if not any(part is line for line in lines[:extensions]))

    def _covered(self, middles: Any, halves: Any) -> bool:
        """Whether boxes meet anything."""
        grown = halves[:, None] + 0.5 * (1 + 1j)
        off, reach = middles[:, None] - self.middles, grown + self.halves
        if ((np.abs(off.real) < reach.real) & (np.abs(off.imag) < reach.imag)).any():
            return True
        return bool(meets(self.segments[None], middles[:, None], grown).any())

    def _over_areas(self, segments: Any) -> bool:
        return bool(meets(segments[:, None], self.middles[None], self.halves[None] + 0.4 * (1 + 1j)).any())

    def _trimmed(self, line: Line) -> Line | None:
        """An extension line from where nothing of its own point is in its way; None where too little is left."""
        length = abs(line.end - line.start)
        along = (line.end - line.start) / length
        near = np.array([(line.start, line.start + AROUND_POINT * along)])
        start = max((*_crossings(near, self.segments)[1], *self._left(near)), default=-TRIM)
        start = AROUND_POINT * start + TRIM if start > 0 else 0.0
        return replace(line, start=line.start + start * along) if start < length - LEAST_EXTENSION else None

    def _left(self, near: Any) -> list[float]:
        """Where the way ``near`` from a point leaves the symbols on it, as shares of its length."""
        start, end = complex(near[0, 0]), complex(near[0, 1])
        reach = self.halves + 0.4 * (1 + 1j)
        met = np.flatnonzero(meets(near, self.middles, reach))
        boxes = (
            Box.around((complex(z - half), complex(z + half)))
            for z, half in zip(self.middles[met], reach[met], strict=True)
        )
        chords = (box.clip(start, end) for box in boxes)
        return [abs(chord[1] - start) / AROUND_POINT for chord in chords if chord is not None]


def _arrays(boxes: Sequence[Box]) -> tuple[Any, Any]:
    """Middles and half sizes of boxes."""
    sizes = [complex(box.width, box.height) / 2 for box in boxes]
    return np.array([box.centre for box in boxes], dtype=complex), np.array(sizes, dtype=complex)


def _crossings(own: Any, others: Any) -> tuple[Any, Any]:
    """Which of some segments cross others, and at which share of their length."""
    p, d = own[:, None, 0], own[:, None, 1] - own[:, None, 0]
    q, e = others[None, :, 0], others[None, :, 1] - others[None, :, 0]
    crossing = (cross_product(d, q - p) * cross_product(d, q + e - p) <= 0) & (
        cross_product(e, p - q) * cross_product(e, p + d - q) <= 0
    )
    which, what = np.nonzero(crossing)
    turn = cross_product(d[which, 0], e[0, what])
    with np.errstate(divide="ignore", invalid="ignore"):
        share = cross_product(q[0, what] - p[which, 0], e[0, what]) / turn
    return which, np.where(np.isfinite(share), share, 0.0)
