"""Where the arcs that show a sense of rotation stand: clear of bars, joints, feet and each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

__all__ = ["Clearance"]

RADII = (5.5, 8.0, 11.0)  # mm, in the order of liking
HALF_SPAN = math.radians(37)
LABEL_AT = 3.6  # mm beyond the arc: where its name would stand
CLEAR, CLEAR_LABEL = 1.9, 2.6  # mm
_MIDDLES = np.arange(20) * (2 * math.pi / 20)
_SPREAD = np.linspace(-HALF_SPAN, HALF_SPAN, 5)


class Clearance:
    """Segments (mm) that arcs keep clear of; arcs that were given a place are added to them."""

    def __init__(self, segments: Sequence[tuple[complex, complex]]) -> None:
        self.segments = list(segments)

    def arc(self, centres: Sequence[complex], radius: float) -> tuple[complex, float, float]:
        """Centre, radius (mm) and middle direction (rad) of the arc about one of some centres that is clearest.

        ``radius`` is the least radius; centres are in the order of liking.
        """
        near = self._near(centres, radius + RADII[-1] - RADII[0] + LABEL_AT + CLEAR_LABEL)
        radii = np.array([radius + r - RADII[0] for r in RADII])
        ways = np.exp(1j * (_MIDDLES[:, None] + _SPREAD))  # middle x sample
        arcs = np.array(centres)[:, None, None, None] + radii[:, None, None] * ways
        names = np.array(centres)[:, None, None] + (radii[:, None] + LABEL_AT) * np.exp(1j * _MIDDLES)
        cost = 10.0 * np.clip(CLEAR - _distance(arcs, near), 0.0, None).sum(axis=-1)
        cost += 2.0 * np.clip(CLEAR_LABEL - _distance(names, near), 0.0, None)
        cost += 0.35 * (radii - radius)[:, None] + 0.5 * np.arange(len(centres))[:, None, None]
        cost += 0.05 * np.abs(np.angle(np.exp(1j * (_MIDDLES - math.radians(50)))))
        c, r, m = np.unravel_index(int(np.argmin(np.round(cost, 6))), cost.shape)
        found = centres[int(c)], float(radii[r]), float(_MIDDLES[m])
        course = [complex(z) for z in arcs[c, r, m]]
        self.segments += pairwise(course)
        name = complex(names[c, r, m])
        self.segments.append((name - 1.2, name + 1.2))
        return found

    def _near(self, centres: Sequence[complex], reach: float) -> Any:
        """Start and way of each segment that comes within reach of a centre."""
        ends = np.array(self.segments, dtype=complex).reshape(-1, 2)
        start, along = ends[:, 0], ends[:, 1] - ends[:, 0]
        off = _off(np.array(centres, dtype=complex), start, along)
        close = (off < reach).any(axis=0)
        return start[close], along[close]


def _distance(points: Any, segments: Any) -> Any:
    """Least distance of each point to any segment."""
    if not len(segments[0]):
        return np.full(points.shape, np.inf)
    return _off(points, *segments).min(axis=-1)


def _off(points: Any, start: Any, along: Any) -> Any:
    length2 = np.maximum(np.abs(along) ** 2, 1e-18)
    off = points[..., None] - start
    share = np.clip((off * along.conjugate()).real / length2, 0.0, 1.0)
    return np.abs(off - share * along)
