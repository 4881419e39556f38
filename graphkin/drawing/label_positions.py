"""Which places around marks the drawing leaves free for labels, and which of them other labels leave free.

All places of all labels are judged together as arrays: upright boxes tell what is near, the separating axes of box and
segment what touches.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.label_candidates import (
    LEADER_FROM,
    LEADER_LEAST,
    RINGS,
    Candidates,
    LabelRequest,
    LabelRequests,
    Mark,
    candidates,
    ends,
    led_candidates,
)
from graphkin.drawing.obstacles import (
    Flags,
    Floats,
    Indices,
    Obstacles,
    Points,
    crosses,
    near,
    separated,
    sides,
    sides_around,
)
from graphkin.drawing.primitives import Segment
from graphkin.plane import cross

__all__ = [
    "MANY", "SOME", "TANGLED", "FoundPositions", "HeldPositions", "LabelPanel", "LabelPosition", "LabelPositions",
    "least_cost",
]  # fmt: skip

FEW = 6
"""Places that a label tries one by one, before more of them are judged together."""
SOME, MANY = 48, 240
"""Places judged together, before all the others are."""
LEADER_GAP = 0.4  # mm between the end of a leader and the box of its label
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

    def meets(self, other: LabelPosition, space: float) -> bool:
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
        return self.lies_under(other.leader) or (
            self.leader is not None and _crosses(self.leader, other.leader)
        )

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

    @property
    def first(self) -> Iterator[LabelPosition]:
        """The few cheapest."""
        return map(self.position, range(min(len(self), FEW)))

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

    def met(self, held: HeldPositions, space: float) -> Flags:
        """Which places (rows) meet the positions of which labels (columns), as `LabelPosition.meets` says."""
        off = self.centres[:, None] - held.middles
        room = held.halves + self.half + complex(space, space)
        over: Flags = (np.abs(off.real) < room.real) & (np.abs(off.imag) < room.imag)
        reach = self.half + complex(LEADER_SPACE, LEADER_SPACE)
        theirs = np.flatnonzero(held.led)
        if theirs.size:
            start, end = held.feet[theirs], held.tips[theirs]
            i, j = near(sides(self.centres - reach, self.centres + reach), sides_around(start, end))
            hit = ~separated(self.centres[i], reach, start[j], end[j])
            over[i[hit], theirs[j[hit]]] = True
        own = np.flatnonzero(self.led)
        if own.size:
            start, end = self.feet[own], self.tips[own]
            around, spaces = sides_around(start, end), held.halves + complex(LEADER_SPACE, LEADER_SPACE)
            i, j = near(around, sides(held.middles - spaces, held.middles + spaces))
            hit = ~separated(held.middles[j], spaces[j], start[i], end[i])
            over[own[i[hit]], j[hit]] = True
            i, j = near(around, sides_around(held.feet[theirs], held.tips[theirs]))
            j = theirs[j]
            hit = crosses(start[i], end[i], held.feet[j], held.tips[j])
            over[own[i[hit]], j[hit]] = True
        return over


FoundPositions: TypeAlias = dict[tuple[LabelRequest, int, int], LabelPositions]
"""Positions without a fault by what was asked for and the rings looked at, first and last; rings 0, 0 stand for
`LabelPanel.further`."""


class HeldPositions:
    """The positions that labels hold, as arrays by label: middles and half sizes of boxes (nan of a label that holds
    none), feet and tips of leaders, whether there is one."""

    def __init__(self, count: int) -> None:
        self.middles, self.halves, self.feet, self.tips = np.full((4, count), complex(np.nan, np.nan))
        self.led = np.zeros(count, dtype=bool)

    def take(self, label: int, position: LabelPosition) -> None:
        low, high = complex(position.left, position.top), complex(position.right, position.bottom)
        self.middles[label], self.halves[label] = (low + high) / 2, (high - low) / 2
        self.led[label] = position.leader is not None
        if position.leader is not None:
            self.feet[label], self.tips[label] = position.leader

    def leave(self, label: int) -> None:
        self.middles[label], self.led[label] = complex(np.nan, np.nan), False


CLEARANCE = 0.35  # between a label and any line or area, mm
NEARER = 1.2  # by so much a label is nearer to its own mark than to any other
# What a place costs beside its distance (mm): a leader, whatever the leader crosses, a dashed line under the label, a
# leader to a line that ends nearer than NEAR_END to a point at its end.
LEADER_COST, CROSSED_COST, DASHED_COST, END_COST = 4.0, 12.0, 10.0, 3.0
AREA_WEIGHT, THICK_WEIGHT = 6.0, 3.0  # of what a leader crosses, where a thin line counts 1
FORBIDDEN = 1000.0
TANGLED = LEADER_COST + CROSSED_COST * THICK_WEIGHT  # what a place costs at least whose leader crosses a vector
OUTSIDE = 100  # faults that leaving the panel counts for
# What lies nearer to the foot of a leader is the mark itself: a point with its symbol, or the line of a vector, mm.
POINT_REACH, LINE_REACH = 1.5, 0.4
NEAR_END = 2.0


def least_cost(ring: int) -> float:
    """What the best place of a ring could cost."""
    return RINGS[ring] + (LEADER_COST if RINGS[ring] > LEADER_FROM else 0.0)


def _crosses(one: Segment, other: Segment) -> bool:
    """As `crosses`, for two lines."""
    (a, b), (c, d) = one, other
    apart = cross(b - a, c - a) * cross(b - a, d - a)
    return apart < 0 and cross(d - c, a - c) * cross(d - c, b - c) < 0


class LabelPanel:
    """A panel with what is drawn on it and all marks, which is asked for positions of labels; ``found`` remembers
    those found for the same drawing and marks."""

    def __init__(
        self, panel: Box, obstacles: Obstacles, marks: Sequence[Mark], requests: Sequence[LabelRequest],
        found: FoundPositions,
    ) -> None:  # fmt: skip
        self.panel, self.asked, self.found = panel, requests, found
        self.over: dict[Segment, bool] = {}  # which leaders cross what they are to go round
        writing = set(obstacles.writing)
        areas = [area.grown(LEADER_SPACE) if area in writing else area for area in obstacles.areas]
        diagonals = tuple((area.corners[0], area.corners[2]) for area in areas)
        things = np.array(diagonals + obstacles.solid + obstacles.dashed, dtype=complex).reshape(-1, 2)
        self.start, self.end = things.T.copy()
        self.reach = sides_around(self.start, self.end)
        self.areas = len(diagonals)
        self.solid = len(diagonals) + len(obstacles.solid)
        thick = set(obstacles.thick)
        self.weights = np.array(
            [FORBIDDEN if area in writing else AREA_WEIGHT for area in obstacles.areas]
            + [THICK_WEIGHT if line in thick else 1.0 for line in obstacles.solid]
            + [1.0] * len(obstacles.dashed)
        )
        # Labels at the same place share one mark: coincident points are told apart by their letters.
        distinct = list(dict.fromkeys((*((one.start, one.end) for one in requests), *map(ends, marks))))
        index = {pair: i for i, pair in enumerate(distinct)}
        self.mark_start, self.mark_end = np.array(distinct, dtype=complex).reshape(-1, 2).T.copy()
        self.mark_reach = sides_around(self.mark_start, self.mark_end)
        self.mark_is_point = self.mark_start == self.mark_end
        self.requests = LabelRequests(requests)
        self.own_mark = np.array([index[one.start, one.end] for one in requests], dtype=int)

    def free(self, labels: Sequence[int], first: int, last: int) -> list[LabelPositions]:
        """Places without a fault in the rings from ``first`` up to ``last`` for each of some labels."""
        return self._remembered(labels, first, last, lambda who: candidates(self.requests, who, RINGS[first:last]))

    def further(self, labels: Sequence[int]) -> list[LabelPositions]:
        """Further places without a fault for each of some labels, with leaders."""
        return self._remembered(labels, 0, 0, lambda who: led_candidates(self.requests, who))

    def _remembered(
        self, labels: Sequence[int], first: int, last: int, places: Callable[[Indices], Candidates]
    ) -> list[LabelPositions]:
        keys = [(self.asked[label], first, last) for label in labels]
        new = {key: label for key, label in zip(keys, labels, strict=True) if key not in self.found}
        if new:
            who = np.array(list(new.values()))
            self.found.update(zip(new, self._without_fault(who, places(who)), strict=True))
        return [self.found[key] for key in keys]

    def tangled(self, place: LabelPosition) -> bool:
        """Whether the leader of a place crosses a vector, a link, a joint or an arrowhead."""
        if place.leader is None:
            return False
        if place.leader not in self.over:
            foot, tip = (np.array([z]) for z in place.leader)
            start = foot + (tip - foot) / np.abs(tip - foot) * LINE_REACH
            self.over[place.leader] = bool(self._crossed(foot, start, tip, self.weights * (self.weights > 1.0))[0] > 0)
        return self.over[place.leader]

    def _without_fault(self, who: Indices, places: Candidates) -> list[LabelPositions]:
        half = self.requests.half[who]
        places = places.at(~self._outside(places.centres, half[places.owners]))
        clear = half + complex(CLEARANCE, CLEARANCE)
        # the few areas first: lines are looked at only where these leave room
        for first, last in ((0, self.areas), (self.areas, self.solid)):
            kept = np.ones(len(places.owners), dtype=bool)
            kept[self._touched(places.centres, clear[places.owners], first, last)] = False
            places = places.at(kept)
        dashed = self._touched(places.centres, clear[places.owners], self.solid, len(self.start))
        np.add.at(places.costs, dashed, DASHED_COST)
        led = self._led(who, places)
        kept = ~led | (places.gaps >= LEADER_LEAST)
        return self._positions(who, places.at(kept), led[kept], None)

    def everywhere(self, label: int) -> LabelPositions:
        """All places of all rings for one label, with the number of their faults."""
        who = np.array([label])
        places = candidates(self.requests, who, RINGS)
        half = self.requests.half[who][places.owners]
        faults = OUTSIDE * self._outside(places.centres, half).astype(int)
        np.add.at(faults, self._touched(places.centres, half + complex(CLEARANCE, CLEARANCE), 0, self.solid), 1)
        return self._positions(who, places, self._led(who, places), faults)[0]

    def _positions(self, who: Indices, places: Candidates, led: Flags, faults: Indices | None) -> list[LabelPositions]:
        """The places of each label, cheapest first."""
        tips = places.feet.copy()
        if led.any():
            tips[led] = self._with_leaders(who, places, led)
        wrong = np.zeros(len(led), dtype=np.intp) if faults is None else faults
        if faults is None:
            kept = places.costs < FORBIDDEN
            places, tips, led, wrong = places.at(kept), tips[kept], led[kept], wrong[kept]
        order = np.lexsort((places.costs, places.owners))
        places, tips, led, wrong = places.at(order), tips[order], led[order], wrong[order]
        bounds = np.searchsorted(places.owners, np.arange(len(who) + 1))
        return [
            LabelPositions(
                complex(half), places.centres[a:z], places.costs[a:z], places.feet[a:z], tips[a:z], led[a:z], wrong[a:z]
            )
            for half, a, z in zip(self.requests.half[who], bounds[:-1], bounds[1:], strict=True)
        ]

    def _with_leaders(self, who: Indices, places: Candidates, led: Flags) -> Points:
        """The tips of the leaders of some places, which then cost more."""
        centres, feet, owners = places.centres[led], places.feet[led], who[places.owners[led]]
        off, half = centres - feet, self.requests.half[owners]
        way = _held(off.real, half.real) + 1j * _held(off.imag, half.imag)
        length = np.maximum(np.abs(way), 1e-9)
        tips: Points = feet + way * np.maximum(0.0, 1.0 - LEADER_GAP / length)
        is_point = self.requests.is_point[owners]
        start = feet + way / length * np.where(is_point, POINT_REACH, LINE_REACH)
        places.costs[led] += LEADER_COST + CROSSED_COST * self._crossed(feet, start, tips, self.weights)
        nearest = np.minimum(np.abs(self.requests.start[owners] - feet), np.abs(self.requests.end[owners] - feet))
        places.costs[led] += END_COST * (~is_point & (nearest < NEAR_END))
        return tips

    def _outside(self, centres: Points, half: Points) -> Flags:
        low, high, panel = centres - half, centres + half, self.panel
        return (low.real < panel.left) | (high.real > panel.right) | (low.imag < panel.top) | (high.imag > panel.bottom)

    def _touched(self, centres: Points, half: Points, first: int, last: int) -> Indices:
        """The boxes that meet some of the obstacles, each as often as it meets one; obstacles count areas, solid,
        dashed in turn."""
        left, top, right, bottom = (side[first:last] for side in self.reach)
        which, what = near(sides(centres - half, centres + half), (left, top, right, bottom))
        what += first
        lines = np.flatnonzero(what >= self.areas)  # for what lies around an area its box will do
        i, j = which[lines], what[lines]
        meeting = np.ones(len(what), dtype=bool)
        meeting[lines] = ~separated(centres[i], half[i], self.start[j], self.end[j])
        return which[meeting]

    def _led(self, who: Indices, places: Candidates) -> Flags:
        """Which places need a leader: far ones, and those about as near to another mark of the same kind as to their
        own."""
        centres, gaps = places.centres, places.gaps
        own = self.own_mark[who[places.owners]]
        reach = self.requests.half[who[places.owners]] + (gaps + NEARER) * (1 + 1j)
        which, what = near(sides(centres - reach, centres + reach), self.mark_reach)
        others = (self.mark_is_point[own[which]] == self.mark_is_point[what]) & (own[which] != what)
        which, what = which[others], what[others]
        led: Flags = gaps > LEADER_FROM
        led[which[~separated(centres[which], reach[which], self.mark_start[what], self.mark_end[what])]] = True
        return led

    def _crossed(self, feet: Points, start: Points, to: Points, weights: Floats) -> Floats | Indices:
        """What each leader runs over, by weights: areas are joints and arrowheads, or writing."""
        count = len(start)
        which, what = near(sides_around(start, to), self.reach)
        start, to = start[which], to[which]
        a, b = self.start[what], self.end[what]
        over = crosses(start, to, a, b).astype(float)
        areas = what < self.areas  # a leader over an area crosses one of its diagonals
        a, b = a[areas], b[areas]
        other = a.real + 1j * b.imag, b.real + 1j * a.imag
        foot = feet[which[areas]]
        own = (a.real <= foot.real) & (foot.real <= b.real) & (a.imag <= foot.imag) & (foot.imag <= b.imag)
        written = weights[what[areas]] >= FORBIDDEN  # a foot under writing is no place for it
        over[areas] = np.where(own, written, over[areas] + crosses(start[areas], to[areas], *other))
        return np.bincount(which, over * weights[what], minlength=count)


def _held(off: Floats, half: Floats) -> Floats:
    """From a foot to the nearest of a box along one axis."""
    return np.where(np.abs(off) <= half, 0.0, off - np.sign(off) * half)
