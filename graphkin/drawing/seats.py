"""Places for one label that the drawing leaves free, and which of them other labels leave free."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.obstacles import Segment

__all__ = ["LEADER_GAP", "LEADER_SPACE", "Seat", "Seats", "cross_product", "meets", "separated"]

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
