"""Places for labels, one, many of one label, and those that labels hold; and whether labels there are in each other's
way.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.meeting import Flags, Floats, Indices, Points, crosses, near, separated, sides, sides_around
from graphkin.drawing.primitives import Segment
from graphkin.plane import cross

__all__ = ["LEADER_SPACE", "Columns", "HeldPositions", "LabelPosition", "LabelPositions"]

LOTS = (0, 48, 240, 720)
"""First places of the lots in which places are judged, the cheapest first."""
LEADER_SPACE = 0.25  # mm between a leader and the box of any other label


class LabelPosition(NamedTuple):
    """A place for a label: its box (mm), what it costs in looks (mm), its leader from mark to box, and left, top, right
    and bottom of what both take."""

    left: float
    top: float
    right: float
    bottom: float
    cost: float
    leader: Segment | None
    reach: tuple[float, float, float, float]

    @property
    def box(self) -> Box:
        return Box(self.left, self.top, self.right, self.bottom)

    def meets(self, other: LabelPosition, space: complex) -> bool:
        """Whether two labels come nearer than a space (mm, across and down), or one's leader crosses the other or its
        leader."""
        left, top, right, bottom, _, leader, reach = self
        its_left, its_top, its_right, its_bottom, _, its_leader, its_reach = other
        if (
            left - space.real < its_right and its_left < right + space.real and top - space.imag < its_bottom
            and its_top < bottom + space.imag
        ):  # fmt: skip
            return True
        if leader is None and its_leader is None:
            return False
        left, top, right, bottom = reach
        its_left, its_top, its_right, its_bottom = its_reach
        if (
            left > its_right + LEADER_SPACE or its_left > right + LEADER_SPACE or top > its_bottom + LEADER_SPACE
            or its_top > bottom + LEADER_SPACE
        ):  # fmt: skip
            return False
        if leader is not None and other.lies_under(leader):
            return True
        if its_leader is None:
            return False
        return self.lies_under(its_leader) or (leader is not None and _crosses(leader, its_leader))

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


class Columns(NamedTuple):
    """Places, of one label or of several, as arrays: centres, costs, feet and tips of leaders, whether there is one."""

    centres: Points
    costs: Floats
    feet: Points
    tips: Points
    led: Flags

    def at(self, some: Flags | Indices | slice) -> Columns:
        """Some of the places."""
        return Columns(self.centres[some], self.costs[some], self.feet[some], self.tips[some], self.led[some])


class LabelPositions:
    """Places of one label, whose box has a half size, cheapest first."""

    def __init__(self, half: complex, columns: Columns) -> None:
        self.half, self.columns = half, columns
        self.centres, self.costs, self.feet, self.tips, self.led = columns
        self._made: dict[int, LabelPosition] = {}
        self._parts: dict[tuple[int, int], LabelPositions] = {}

    def __len__(self) -> int:
        return len(self.costs)

    def position(self, index: int) -> LabelPosition:
        """The place of an index."""
        made = self._made.get(index)
        if made is None:
            centre, half, leader = self.centres[index].item(), self.half, None
            left, top, right, bottom = reach = (
                centre.real - half.real, centre.imag - half.imag, centre.real + half.real, centre.imag + half.imag
            )  # fmt: skip
            if self.led[index]:
                leader = foot, _ = self.feet[index].item(), self.tips[index].item()
                x, y = foot.real, foot.imag
                reach = min(left, x), min(top, y), max(right, x), max(bottom, y)
            made = LabelPosition(left, top, right, bottom, self.costs[index].item(), leader, reach)
            self._made[index] = made
        return made

    def cheaper(self, cost: float) -> int:
        """How many cost less."""
        return int(np.searchsorted(self.costs, cost))

    def lots(self, count: int) -> Iterator[tuple[int, LabelPositions]]:
        """Lots of them that hold the first ``count``, each with the number of its first place."""
        for first, last in zip(LOTS, (*LOTS[1:], len(self)), strict=True):
            if first < count:
                yield first, self.part(first, last)

    def part(self, first: int, last: int) -> LabelPositions:
        """Those of some indices."""
        part = self._parts.get((first, last))
        if part is None:
            part = self._parts[first, last] = LabelPositions(self.half, self.columns.at(slice(first, last)))
        return part


@dataclass
class _Known:
    """Which of some places meet which labels, as it was at a time."""

    over: Flags
    at: int


class HeldPositions:
    """The positions that labels hold, also as arrays by label: middles and half sizes of boxes, feet and tips of
    leaders (nan of a label that has held none)."""

    def __init__(self, count: int) -> None:
        self.middles, self.halves, self.feet, self.tips = np.full((4, count), complex(np.nan, np.nan))
        self.stands = np.zeros(count, dtype=bool)
        self.standing: dict[int, LabelPosition] = {}
        self.leaders: dict[int, LabelPosition] = {}  # those of them that have one
        self.last: dict[int, LabelPosition] = {}  # those that labels hold or have held
        self.time, self.since = 0, np.zeros(count, dtype=np.intp)  # when they took it
        self.known: dict[tuple[LabelPositions, complex], _Known] = {}

    def take(self, label: int, position: LabelPosition) -> None:
        self.standing[label] = position
        self.stands[label] = True
        self.leaders.pop(label, None)
        if position.leader is not None:
            self.leaders[label] = position
        if self.last.get(label) is position:
            return
        self.last[label] = position
        self.time += 1
        self.since[label] = self.time
        low, high = complex(position.left, position.top), complex(position.right, position.bottom)
        self.middles[label], self.halves[label] = (low + high) / 2, (high - low) / 2
        if position.leader is not None:
            self.feet[label], self.tips[label] = position.leader

    def leave(self, label: int) -> None:
        del self.standing[label]
        self.stands[label] = False
        self.leaders.pop(label, None)

    def put_back(self, standing: Mapping[int, LabelPosition]) -> None:
        """Let the labels hold positions that they have held at a time."""
        for label in tuple(self.standing):
            self.leave(label)
        for label, position in standing.items():
            self.take(label, position)

    def met(self, places: LabelPositions, space: complex) -> Flags:
        """Which of some places (rows) meet the positions of which labels (columns), as `LabelPosition.meets` says."""
        known = self.known.get((places, space))
        if known is None:
            over = np.zeros((len(places), len(self.since)), dtype=bool)
            known = self.known[places, space] = _Known(over, 0)
        some = (self.since > known.at).nonzero()[0]
        if some.size:
            known.over[:, some] = self._met(places, space, some)
            known.at = self.time
        return known.over & self.stands

    def _met(self, places: LabelPositions, space: complex, labels: Indices) -> Flags:
        """Which of some places meet the last positions of some labels."""
        middles, halves = self.middles[labels], self.halves[labels]
        over = self._overlapped(places, space, labels)
        theirs = np.array([k for k, j in enumerate(labels.tolist()) if self.last[j].leader is not None], dtype=np.intp)
        if theirs.size:
            start, end = self.feet[labels[theirs]], self.tips[labels[theirs]]
            around = sides_around(start, end)
            reach = places.half + complex(LEADER_SPACE, LEADER_SPACE)
            for i, j in near(sides(places.centres - reach, places.centres + reach), around):
                hit = ~separated(places.centres[i], reach, start[j], end[j])
                over[i[hit], theirs[j[hit]]] = True
        own = places.led.nonzero()[0]
        if own.size:
            feet, tips = places.feet[own], places.tips[own]
            along, spaces = sides_around(feet, tips), halves + complex(LEADER_SPACE, LEADER_SPACE)
            for i, j in near(along, sides(middles - spaces, middles + spaces)):
                hit = ~separated(middles[j], spaces[j], feet[i], tips[i])
                over[own[i[hit]], j[hit]] = True
            if theirs.size:
                for i, j in near(along, around):
                    hit = crosses(feet[i], tips[i], start[j], end[j])
                    over[own[i[hit]], theirs[j[hit]]] = True
        return over

    def _overlapped(self, places: LabelPositions, space: complex, labels: Indices | slice) -> Flags:
        """Which of some places come nearer than a space (mm, across and down) to the last positions of some labels."""
        middles, room = self.middles[labels], self.halves[labels] + places.half + space
        over: Flags = np.abs(places.centres.real[:, None] - middles.real) < room.real
        over &= np.abs(places.centres.imag[:, None] - middles.imag) < room.imag
        return over

    def first_free(self, places: LabelPositions, count: int, space: complex) -> int | None:
        """The index of the cheapest of the first ``count`` places that meets no label; None where all do."""
        for k in self._promising(places, count, space):
            position = places.position(k)
            for other in (self.standing if k == 0 or position.leader is not None else self.leaders).values():
                if position.meets(other, space):
                    break
            else:
                return k
        return None

    def first_known_free(self, places: LabelPositions, count: int, space: complex) -> int | None:
        """As `first_free`, for places of which is asked again what they meet."""
        for first, lot in places.lots(count):
            free = np.flatnonzero(~self.met(lot, space).any(axis=1))
            if free.size:
                found = first + int(free[0])
                return found if found < count else None
        return None

    def _promising(self, places: LabelPositions, count: int, space: complex) -> Iterator[int]:
        """The cheapest of some places, which is mostly free, and those of them whose boxes overlap none."""
        if count:
            yield 0
        for first, lot in places.lots(count):
            over = self._overlapped(lot, space, slice(None)) & self.stands
            yield from (k for k in (first + np.flatnonzero(~over.any(axis=1))).tolist() if 0 < k < count)


def _crosses(one: Segment, other: Segment) -> bool:
    """As `crosses`, for two lines."""
    (a, b), (c, d) = one, other
    apart = cross(b - a, c - a) * cross(b - a, d - a)
    return apart < 0 and cross(d - c, a - c) * cross(d - c, b - c) < 0
