"""The places around a mark where its label could stand, ring by ring, and what each costs in looks.

The places of all labels are made together, as arrays.

Places for one label that the drawing leaves free, and which of them other labels leave free.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.obstacles import Segment
from graphkin.drawing.primitives import page_direction

__all__ = [
    "LEADER_FROM",
    "LEADER_GAP",
    "LEADER_LEAST",
    "LEADER_SPACE",
    "RINGS",
    "Around",
    "Asker",
    "Mark",
    "Seat",
    "Seats",
    "around",
    "cross_product",
    "ends",
    "meets",
    "separated",
]

Mark: TypeAlias = complex | Segment

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
# Without a wish, up and to the right reads best (Imhof, Positioning names on maps, 1975).
_LIKED = math.radians(40)


@dataclass(frozen=True)
class Asker:
    """A label that asks for places: the ends of its mark (equal for a point), half its width and height as a complex
    number, its liked directions (rad)."""

    start: complex
    end: complex
    half: complex
    toward: tuple[float, ...]

    @property
    def is_point(self) -> bool:
        return self.start == self.end


@dataclass(frozen=True)
class Around:
    """Places of several labels, as arrays of one length: centres of boxes, costs (mm), feet on the marks, distances
    from them (mm), and the index of the asker."""

    centres: Any
    costs: Any
    feet: Any
    gaps: Any
    owners: Any

    def at(self, kept: Any) -> Around:
        """Some of the places."""
        return Around(self.centres[kept], self.costs[kept], self.feet[kept], self.gaps[kept], self.owners[kept])


def ends(mark: Mark) -> Segment:
    """Ends of a mark, a point being both, to a thousandth of a millimetre, so that coincident marks are equal."""
    start, end = mark if isinstance(mark, tuple) else (mark, mark)
    return complex(round(start.real, 3), round(start.imag, 3)), complex(round(end.real, 3), round(end.imag, 3))


def around(askers: Sequence[Asker], gaps: Sequence[float]) -> Around:
    """All places of some labels at some distances (mm) from their marks."""
    rings = np.array(gaps)
    points = [i for i, asker in enumerate(askers) if asker.is_point]
    segments = [i for i, asker in enumerate(askers) if not asker.is_point]
    parts = []
    if points:
        likes = np.array([_dislike(askers[i].toward) for i in points])
        parts.append(_off_points(askers, points, [askers[i].start for i in points], likes, rings))
    if segments:
        parts.append(_off_segments(askers, segments, rings))
        far = rings[rings >= LEADER_LEAST]
        if far.size:
            # Far from a vector there is more room all round its middle than square to it.
            middles = [(askers[i].start + askers[i].end) / 2 for i in segments]
            parts.append(_off_points(askers, segments, middles, _dislike(())[None], far))
    return Around(*map(np.concatenate, zip(*parts, strict=True)))


def _off_points(askers: Sequence[Asker], who: list[int], points: list[complex], dislikes: Any, gaps: Any) -> Any:
    """Columns of places all round some points, at an angle each."""
    half = np.array([askers[i].half for i in who])[:, None, None]
    at = np.array(points)[:, None, None]
    centres = at + gaps[:, None] * _WAYS + _HOLDS[0] * half.real + 1j * (_HOLDS[1] * half.imag)
    sparse = _SOME[0] ^ (np.arange(len(gaps)) % 2 == 1)[:, None]
    return _columns(centres, gaps[:, None] + dislikes[:, None, :], at, gaps[:, None], who, sparse)


def _off_segments(askers: Sequence[Asker], who: list[int], gaps: Any) -> Any:
    """Columns of places on both sides of some segments, square to them."""
    start, end, half = (np.array([getattr(askers[i], key) for i in who]) for key in ("start", "end", "half"))
    way = end - start
    normal = 1j * way / np.abs(way)
    liked = np.array([page_direction(askers[i].toward[0] if askers[i].toward else _LIKED) for i in who])
    sides = normal[:, None] * _SIDES
    disliked = 0.4 * (1.0 - (sides * liked.conj()[:, None]).real)
    reach = np.abs(normal.real) * half.real + np.abs(normal.imag) * half.imag
    feet = (start[:, None] + _SHARES * way[:, None])[:, None, None, :]
    off = gaps + reach[:, None]
    centres = feet + (off[:, :, None] * sides[:, None, :])[..., None]
    costs = gaps[:, None, None] + disliked[:, None, :, None] + 2.0 * np.abs(_SHARES - 0.5)
    return _columns(centres, costs, feet, gaps[:, None, None], who, _SOME[1])


def _columns(centres: Any, costs: Any, feet: Any, gaps: Any, who: list[int], sparse: Any) -> Any:
    """Arrays of one length; far from the marks only the ``sparse`` places."""
    shape = centres.shape
    kept = np.broadcast_to((gaps < LEADER_FROM) | sparse, shape[1:]).ravel()
    owners = np.repeat(np.array(who), kept.sum())
    columns = (np.broadcast_to(column, shape).reshape(len(who), -1) for column in (centres, costs, feet, gaps))
    return *(column[:, kept].ravel() for column in columns), owners


@lru_cache(maxsize=512)
def _dislike(toward: tuple[float, ...]) -> Any:
    """What each angle costs for liked directions."""
    if not toward:
        return 0.5 * _apart(_LIKED) / np.pi
    return np.min([3.0 * _apart(wish) / np.pi + 0.3 * rank for rank, wish in enumerate(toward)], axis=0)


def _apart(wish: float) -> Any:
    return np.abs((_ANGLES - wish + np.pi) % (2 * np.pi) - np.pi)


LEADER_GAP = 0.4  # mm between the end of a leader and the box of its label
LEADER_SPACE = 0.25  # mm between a leader and the box of any other label


class Seat(NamedTuple):
    """A place for a label: its box (mm), what it costs in looks (mm), and its leader from mark to box."""

    left: float
    top: float
    right: float
    bottom: float
    cost: float
    leader: Segment | None

    @property
    def box(self) -> Box:
        return Box(self.left, self.top, self.right, self.bottom)

    def meets(self, other: Seat, space: float) -> bool:
        """Whether two labels come nearer than a space (mm), or one's leader crosses the other or its leader."""
        if (
            self.left - space < other.right
            and other.left < self.right + space
            and self.top - space < other.bottom
            and other.top < self.bottom + space
        ):
            return True
        if self.leader is None and other.leader is None:
            return False
        if self.leader is not None and other.lies_under(self.leader):
            return True
        if other.leader is None:
            return False
        return self.lies_under(other.leader) or (self.leader is not None and _cross(self.leader, other.leader))

    def lies_under(self, leader: Segment) -> bool:
        """Whether a leader runs over the box, or nearly."""
        a, b = leader
        space = LEADER_SPACE
        left, top, right, bottom = self.left - space, self.top - space, self.right + space, self.bottom + space
        if max(a.real, b.real) < left or min(a.real, b.real) > right:
            return False
        if max(a.imag, b.imag) < top or min(a.imag, b.imag) > bottom:
            return False
        dx, dy = b.real - a.real, b.imag - a.imag
        off = abs(dx * ((top + bottom) / 2 - a.imag) - dy * ((left + right) / 2 - a.real))
        return off <= (right - left) / 2 * abs(dy) + (bottom - top) / 2 * abs(dx)


@dataclass(frozen=True)
class Seats:
    """Places of one label, cheapest first, as arrays: centres, costs, feet and tips of leaders, whether there is one,
    number of faults."""

    half: complex
    centres: Any
    costs: Any
    feet: Any
    tips: Any
    led: Any
    faults: Any

    def __len__(self) -> int:
        return len(self.costs)

    def seat(self, index: int) -> Seat:
        """The place of an index."""
        centre, half = complex(self.centres[index]), self.half
        leader = (complex(self.feet[index]), complex(self.tips[index])) if self.led[index] else None
        return Seat(
            centre.real - half.real, centre.imag - half.imag, centre.real + half.real, centre.imag + half.imag,
            float(self.costs[index]), leader,
        )  # fmt: skip

    @cached_property
    def first(self) -> tuple[Seat, ...]:
        """The few cheapest."""
        return tuple(self.seat(i) for i in range(min(len(self), 6)))

    def joined(self, other: Seats) -> Seats:
        """These and others, cheapest first."""
        if not len(other):
            return self
        columns = [
            np.concatenate((getattr(self, key), getattr(other, key)))
            for key in ("centres", "costs", "feet", "tips", "led", "faults")
        ]
        order = np.argsort(columns[1], kind="stable")
        return Seats(self.half, *(column[order] for column in columns))

    def met(self, others: Sequence[Seat], space: float) -> Any:
        """Which places (rows) meet which seats of other labels (columns), as `Seat.meets` says."""
        corners = np.array([(s.left, s.top, s.right, s.bottom) for s in others]).reshape(-1, 4)
        low, high = corners[:, 0] + 1j * corners[:, 1], corners[:, 2] + 1j * corners[:, 3]
        middle, size = (low + high) / 2, (high - low) / 2
        off = self.centres[:, None] - middle
        room = size + self.half + complex(space, space)
        over = (np.abs(off.real) < room.real) & (np.abs(off.imag) < room.imag)
        leader_space = complex(LEADER_SPACE, LEADER_SPACE)
        own = np.flatnonzero(self.led)
        lines = np.stack((self.feet[own], self.tips[own]), axis=1)
        theirs = np.array([j for j, s in enumerate(others) if s.leader is not None], dtype=int)
        if own.size:
            over[own] |= meets(lines[:, None], middle[None], size[None] + leader_space)
        if theirs.size:
            leaders = np.array([others[j].leader for j in theirs], dtype=complex)
            half = np.full((1, 1), self.half) + leader_space
            over[:, theirs] |= meets(leaders[None], self.centres[:, None], half)
            if own.size:
                (a, b), (c, d) = lines[:, None].transpose(2, 0, 1), leaders[None].transpose(2, 0, 1)
                apart = cross_product(b - a, c - a) * cross_product(b - a, d - a)
                across = cross_product(d - c, a - c) * cross_product(d - c, b - c)
                over[np.ix_(own, theirs)] |= (apart < 0) & (across < 0)
        return over


def cross_product(a: Any, b: Any) -> Any:
    """Of plane vectors as complex numbers or arrays."""
    return a.real * b.imag - a.imag * b.real


def separated(centres: Any, half: Any, segments: Any) -> Any:
    """Whether the normal of a segment separates it from a box (of centre and half size); the axes of the box are the
    caller's to check."""
    start = segments[..., 0]
    along = segments[..., 1] - start
    distance = np.abs(cross_product(along, centres - start))
    return distance > half.real * np.abs(along.imag) + half.imag * np.abs(along.real)


def meets(segments: Any, centres: Any, half: Any) -> Any:
    """Whether segments and boxes meet."""
    start, end = segments[..., 0], segments[..., 1]
    middle, reach = (start + end) / 2 - centres, (end - start) / 2
    near = (np.abs(middle.real) <= np.abs(reach.real) + half.real) & (
        np.abs(middle.imag) <= np.abs(reach.imag) + half.imag
    )
    return near & ~separated(centres, half, segments)


def _cross(one: Segment, other: Segment) -> bool:
    """Whether two segments cross between their ends."""
    (a, b), (c, d) = one, other
    return bool(
        cross_product(b - a, c - a) * cross_product(b - a, d - a) < 0
        and cross_product(d - c, a - c) * cross_product(d - c, b - c) < 0
    )
