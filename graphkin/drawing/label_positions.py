"""Places for labels, one, many of one label, and those that labels hold; and whether labels there are in each other's
way.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.obstacles import Flags, Floats, Indices, Points, crosses, near, separated, sides, sides_around
from graphkin.drawing.primitives import Segment
from graphkin.plane import cross

__all__ = ["LEADER_SPACE", "HeldPositions", "LabelPosition", "LabelPositions"]

FEW = 4
"""Places that a label tries one by one, before more of them are judged together."""
LOTS = (0, 48, 240)
"""First places of the lots in which places are judged, the cheapest first."""
LEADER_SPACE = 0.25  # mm between a leader and the box of any other label


class LabelPosition(NamedTuple):
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

    def meets(self, other: LabelPosition, space: complex) -> bool:
        """Whether two labels come nearer than a space (mm, across and down), or one's leader crosses the other or its
        leader."""
        if (
            self.left - space.real < other.right
            and other.left < self.right + space.real
            and self.top - space.imag < other.bottom
            and other.top < self.bottom + space.imag
        ):
            return True
        if self.leader is None and other.leader is None:
            return False
        if self.leader is not None and other.lies_under(self.leader):
            return True
        if other.leader is None:
            return False
        return self.lies_under(other.leader) or (self.leader is not None and _crosses(self.leader, other.leader))

    def lies_under(self, leader: Segment) -> bool:
        """Whether a leader runs over the box, or nearly."""
        a, b = leader
        x1, x2, left, right = a.real, b.real, self.left - LEADER_SPACE, self.right + LEADER_SPACE
        if (x1 < left and x2 < left) or (x1 > right and x2 > right):
            return False
        y1, y2, top, bottom = a.imag, b.imag, self.top - LEADER_SPACE, self.bottom + LEADER_SPACE
        if (y1 < top and y2 < top) or (y1 > bottom and y2 > bottom):
            return False
        dx, dy = x2 - x1, y2 - y1
        off = abs(dx * ((top + bottom) / 2 - y1) - dy * ((left + right) / 2 - x1))
        return off <= (right - left) / 2 * abs(dy) + (bottom - top) / 2 * abs(dx)


@dataclass(frozen=True)
class LabelPositions:
    """Places of one label, cheapest first, as arrays: centres, costs, feet and tips of leaders, whether there is one,
    number of faults."""

    half: complex
    centres: Points
    costs: Floats
    feet: Points
    tips: Points
    led: Flags
    faults: Indices

    def __len__(self) -> int:
        return len(self.costs)

    def position(self, index: int) -> LabelPosition:
        """The place of an index."""
        centre, half = complex(self.centres[index]), self.half
        leader = (complex(self.feet[index]), complex(self.tips[index])) if self.led[index] else None
        return LabelPosition(
            centre.real - half.real, centre.imag - half.imag, centre.real + half.real, centre.imag + half.imag,
            float(self.costs[index]), leader,
        )  # fmt: skip

    def cheaper(self, cost: float) -> int:
        """How many cost less."""
        return int(np.searchsorted(self.costs, cost))

    def lots(self, count: int) -> Iterator[tuple[int, LabelPositions]]:
        """The first of them in lots, each with the number of its first place."""
        for first, last in zip(LOTS, (*LOTS[1:], count), strict=True):
            if first < count:
                yield first, self.part(first, min(last, count))

    def part(self, first: int, last: int) -> LabelPositions:
        """Those of some indices."""
        some = slice(first, last)
        return LabelPositions(
            self.half, self.centres[some], self.costs[some], self.feet[some], self.tips[some], self.led[some],
            self.faults[some],
        )  # fmt: skip

    def joined(self, other: LabelPositions) -> LabelPositions:
        """These and others, cheapest first."""
        if not len(other):
            return self
        columns = [
            np.concatenate((getattr(self, key), getattr(other, key)))
            for key in ("centres", "costs", "feet", "tips", "led", "faults")
        ]
        order = np.argsort(columns[1], kind="stable")
        return LabelPositions(self.half, *(column[order] for column in columns))


class HeldPositions:
    """The positions that labels hold, also as arrays by label: middles and half sizes of boxes (nan of a label that
    holds none), feet and tips of leaders."""

    def __init__(self, count: int) -> None:
        self.middles, self.halves, self.feet, self.tips = np.full((4, count), complex(np.nan, np.nan))
        self.standing: dict[int, LabelPosition] = {}
        self.leaders: dict[int, LabelPosition] = {}  # those of them that have one

    def take(self, label: int, position: LabelPosition) -> None:
        low, high = complex(position.left, position.top), complex(position.right, position.bottom)
        self.middles[label], self.halves[label] = (low + high) / 2, (high - low) / 2
        self.standing[label] = position
        if position.leader is not None:
            self.feet[label], self.tips[label] = position.leader
            self.leaders[label] = position

    def leave(self, label: int) -> None:
        self.middles[label] = complex(np.nan, np.nan)
        del self.standing[label]
        self.leaders.pop(label, None)

    def met(self, places: LabelPositions, space: complex) -> Flags:
        """Which of some places (rows) meet the positions of which labels (columns), as `LabelPosition.meets` says."""
        room = self.halves + places.half + space
        over: Flags = np.abs(places.centres.real[:, None] - self.middles.real) < room.real
        over &= np.abs(places.centres.imag[:, None] - self.middles.imag) < room.imag
        theirs = np.array(list(self.leaders), dtype=np.intp)
        if theirs.size:
            start, end = self.feet[theirs], self.tips[theirs]
            around = sides_around(start, end)
            reach = places.half + complex(LEADER_SPACE, LEADER_SPACE)
            i, j = near(sides(places.centres - reach, places.centres + reach), around)
            hit = ~separated(places.centres[i], reach, start[j], end[j])
            over[i[hit], theirs[j[hit]]] = True
        own = places.led.nonzero()[0]
        if own.size:
            feet, tips = places.feet[own], places.tips[own]
            along, spaces = sides_around(feet, tips), self.halves + complex(LEADER_SPACE, LEADER_SPACE)
            i, j = near(along, sides(self.middles - spaces, self.middles + spaces))
            hit = ~separated(self.middles[j], spaces[j], feet[i], tips[i])
            over[own[i[hit]], j[hit]] = True
            if theirs.size:
                i, j = near(along, around)
                hit = crosses(feet[i], tips[i], start[j], end[j])
                over[own[i[hit]], theirs[j[hit]]] = True
        return over

    def first_free(self, places: LabelPositions, count: int, space: complex) -> int | None:
        """The index of the cheapest of the first ``count`` places that meets no label; None where all do."""
        others = tuple(self.standing.values())
        for k in range(min(count, FEW)):
            position = places.position(k)
            for other in others:
                if position.meets(other, space):
                    break
            else:
                return k
        for first, lot in places.lots(count):
            free = np.flatnonzero(~self.met(lot, space).any(axis=1))
            if free.size:
                return first + int(free[0])
        return None


def _crosses(one: Segment, other: Segment) -> bool:
    """As `crosses`, for two lines."""
    (a, b), (c, d) = one, other
    apart = cross(b - a, c - a) * cross(b - a, d - a)
    return apart < 0 and cross(d - c, a - c) * cross(d - c, b - c) < 0
