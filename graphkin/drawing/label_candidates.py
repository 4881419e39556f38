"""The places around a mark where its label could stand, ring by ring, and what each costs in looks.

The places of all labels are made together, as arrays.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from graphkin.drawing.obstacles import Flags, Floats, Indices, Points
from graphkin.drawing.primitives import Segment, page_direction

__all__ = ["LEADER_FROM", "LEADER_LEAST", "RINGS", "Candidates", "LabelRequest", "Mark", "candidates", "ends"]

Mark: TypeAlias = complex | Segment
"""What a label names: a point, or the line between two."""

# Distance of the box from its mark, mm, ring by ring.
RINGS = (0.7, 1.5, 2.4, 3.6, 5.0, 6.8, 9.0, 11.5, 14.5, 18.0, 22.0, 27.0)
LEADER_FROM = 5.0  # a label further off than this has a leader
LEADER_LEAST = 2.0  # nearer to its mark a label has no room for a leader
_ANGLES = 2 * np.pi * np.arange(24) / 24
_WAYS = np.exp(-1j * _ANGLES)
# The corner or the edge of the box that looks at the point slides with the direction.
_HOLDS = np.clip(1.6 * _WAYS.real, -1, 1), np.clip(1.6 * _WAYS.imag, -1, 1)
_SHARES = np.array((0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9))
# Far from a mark every second angle, and places about the middle of a vector, will do.
_SOME = np.arange(24) % 2 == 0, np.arange(9) < 5
_SIDES = np.array((1.0, -1.0))
# Where nothing is liked, up and to the right reads best (Imhof, Positioning names on maps, 1975).
_LIKED = math.radians(40)


Value = TypeVar("Value", np.float64, np.complex128)
Columns: TypeAlias = tuple[Points, Floats, Points, Floats, Indices]


@dataclass(frozen=True)
class LabelRequest:
    """What a label asks for: places around a mark of these ends (equal for a point), for a box of half this width and
    height (as a complex number), in its liked directions (rad)."""

    start: complex
    end: complex
    half: complex
    toward: tuple[float, ...]

    @property
    def is_point(self) -> bool:
        return self.start == self.end


@dataclass(frozen=True)
class Candidates:
    """Places of several labels, as arrays of one length: centres of boxes, costs (mm), feet on the marks, distances
    from them (mm), and the index of the request."""

    centres: Points
    costs: Floats
    feet: Points
    gaps: Floats
    owners: Indices

    def at(self, kept: Flags | Indices) -> Candidates:
        """Some of the places."""
        return Candidates(self.centres[kept], self.costs[kept], self.feet[kept], self.gaps[kept], self.owners[kept])


def ends(mark: Mark) -> Segment:
    """Ends of a mark, a point being both, to a thousandth of a millimetre, so that coincident marks are equal."""
    start, end = mark if isinstance(mark, tuple) else (mark, mark)
    return complex(round(start.real, 3), round(start.imag, 3)), complex(round(end.real, 3), round(end.imag, 3))


def candidates(requests: Sequence[LabelRequest], gaps: Sequence[float]) -> Candidates:
    """All places of some labels at some distances (mm) from their marks."""
    rings = np.array(gaps)
    points = [i for i, request in enumerate(requests) if request.is_point]
    segments = [i for i, request in enumerate(requests) if not request.is_point]
    parts = []
    if points:
        likes = np.array([_dislike(requests[i].toward) for i in points])
        parts.append(_off_points(requests, points, [requests[i].start for i in points], likes, rings))
    if segments:
        parts.append(_off_segments(requests, segments, rings))
        far = rings[rings >= LEADER_LEAST]
        if far.size:
            # Far from a vector there is more room all round its middle than square to it.
            middles = [(requests[i].start + requests[i].end) / 2 for i in segments]
            parts.append(_off_points(requests, segments, middles, _dislike(())[None], far))
    return Candidates(*map(np.concatenate, zip(*parts, strict=True)))


def _off_points(
    requests: Sequence[LabelRequest], who: list[int], points: list[complex], dislikes: Floats, gaps: Floats
) -> Columns:
    """Columns of places all round some points, at an angle each."""
    half = np.array([requests[i].half for i in who])[:, None, None]
    at = np.array(points)[:, None, None]
    centres = at + gaps[:, None] * _WAYS + _HOLDS[0] * half.real + 1j * (_HOLDS[1] * half.imag)
    sparse = _SOME[0] ^ (np.arange(len(gaps)) % 2 == 1)[:, None]
    return _columns(centres, gaps[:, None] + dislikes[:, None, :], at, gaps[:, None], who, sparse)


def _off_segments(requests: Sequence[LabelRequest], who: list[int], gaps: Floats) -> Columns:
    """Columns of places on both sides of some segments, square to them."""
    start, end, half = (np.array([getattr(requests[i], key) for i in who]) for key in ("start", "end", "half"))
    way = end - start
    normal = 1j * way / np.abs(way)
    liked = np.array([page_direction(requests[i].toward[0] if requests[i].toward else _LIKED) for i in who])
    sides = normal[:, None] * _SIDES
    disliked = 0.4 * (1.0 - (sides * liked.conj()[:, None]).real)
    reach = np.abs(normal.real) * half.real + np.abs(normal.imag) * half.imag
    feet = (start[:, None] + _SHARES * way[:, None])[:, None, None, :]
    off = gaps + reach[:, None]
    centres = feet + (off[:, :, None] * sides[:, None, :])[..., None]
    costs = gaps[:, None, None] + disliked[:, None, :, None] + 2.0 * np.abs(_SHARES - 0.5)
    return _columns(centres, costs, feet, gaps[:, None, None], who, _SOME[1])


def _columns(
    centres: Points, costs: Floats, feet: Points, gaps: Floats, who: list[int], sparse: Flags
) -> Columns:
    """Arrays of one length; far from the marks only the ``sparse`` places."""
    shape = centres.shape
    kept = np.broadcast_to((gaps < LEADER_FROM) | sparse, shape[1:]).ravel()

    def column(values: NDArray[Value]) -> NDArray[Value]:
        return np.broadcast_to(values, shape).reshape(len(who), -1)[:, kept].ravel()

    return column(centres), column(costs), column(feet), column(gaps), np.repeat(np.array(who), kept.sum())


@lru_cache(maxsize=512)
def _dislike(toward: tuple[float, ...]) -> Floats:
    """What each angle costs for liked directions."""
    if not toward:
        return 0.5 * _apart(_LIKED) / np.pi
    least: Floats = np.min([3.0 * _apart(liked) / np.pi + 0.3 * rank for rank, liked in enumerate(toward)], axis=0)
    return least


def _apart(liked: float) -> Floats:
    away: Floats = np.abs((_ANGLES - liked + np.pi) % (2 * np.pi) - np.pi)
    return away
