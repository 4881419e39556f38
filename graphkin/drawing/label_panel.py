"""Which places around marks the drawing leaves free for labels.

All places of all labels are judged together as arrays: upright boxes tell what is near, the separating axes of box and
segment what touches.
"""

from __future__ import annotations

from collections.abc import Sequence

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
from graphkin.drawing.label_positions import LEADER_SPACE, LabelPosition, LabelPositions
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
    touches,
)
from graphkin.drawing.primitives import Segment

__all__ = ["FORBIDDEN", "TANGLED", "LabelPanel", "least_cost"]

LEADER_GAP = 0.4  # mm between the end of a leader and the box of its label
CLEARANCE = 0.35  # between a label and any line or area, mm
NEARER = 1.2  # by so much a label is nearer to its own mark than to any other
# What a place costs beside its distance (mm): a leader, whatever the leader crosses, a dashed line under the label, a
# leader to a line that ends nearer than NEAR_END to a point at its end.
LEADER_COST, CROSSED_COST, DASHED_COST, END_COST = 4.0, 12.0, 60.0, 3.0
AREA_WEIGHT, THICK_WEIGHT = 25.0, 10.0  # of what a leader crosses, where a thin line counts 1
FORBIDDEN = 1e5
TANGLED = LEADER_COST + CROSSED_COST * THICK_WEIGHT  # what a place costs at least whose leader crosses a vector
OUTSIDE = 100  # faults that leaving the panel counts for
FOOT_REACH = 0.45  # mm: what lies nearer to the foot of a leader is the mark itself
NEAR_END = 2.0


def least_cost(ring: int) -> float:
    """What the best place of a ring could cost."""
    return RINGS[ring] + (LEADER_COST if RINGS[ring] > LEADER_FROM else 0.0)


class LabelPanel:
    """A panel with what is drawn on it and all marks, which is asked for positions of labels."""

    def __init__(self, panel: Box, obstacles: Obstacles, marks: Sequence[Mark], asked: Sequence[LabelRequest]) -> None:
        self.panel, self.asked = panel, list(asked)
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
        distinct = list(dict.fromkeys((*((one.start, one.end) for one in asked), *map(ends, marks))))
        self.index = {pair: i for i, pair in enumerate(distinct)}
        self.mark_start, self.mark_end = np.array(distinct, dtype=complex).reshape(-1, 2).T.copy()
        self.mark_reach = sides_around(self.mark_start, self.mark_end)
        self.mark_is_point = self.mark_start == self.mark_end
        self._know()

    def _know(self) -> None:
        self.requests = LabelRequests(self.asked)
        self.own_mark = np.array([self.index[one.start, one.end] for one in self.asked], dtype=int)

    def ask(self, more: Sequence[LabelRequest]) -> int:
        """Further requests at marks that are known; returns the number of the first of them."""
        first = len(self.asked)
        self.asked += more
        self._know()
        return first

    def free(self, some: Sequence[int], first: int, last: int) -> list[LabelPositions]:
        """Places without a fault in the rings from ``first`` up to ``last`` for each of some requests."""
        who = np.array(some)
        return self._without_fault(who, candidates(self.requests, who, RINGS[first:last]))

    def further(self, some: Sequence[int]) -> list[LabelPositions]:
        """Further places without a fault for each of some requests, with leaders."""
        who = np.array(some)
        return self._without_fault(who, led_candidates(self.requests, who))

    def everywhere_free(self, some: Sequence[int]) -> list[LabelPositions]:
        """Places without a fault in all rings, and further ones, for each of some requests."""
        who = np.array(some)
        return self._without_fault(who, candidates(self.requests, who, RINGS) + led_candidates(self.requests, who))

    def tangled(self, place: LabelPosition) -> bool:
        """Whether the leader of a place crosses a vector, a link, a joint or an arrowhead."""
        if place.leader is None:
            return False
        if place.leader not in self.over:
            foot, tip = (np.array([z]) for z in place.leader)
            start = foot + (tip - foot) / np.abs(tip - foot) * FOOT_REACH
            self.over[place.leader] = bool(self._crossed(foot, start, tip, self.weights * (self.weights > 1.0))[0] > 0)
        return self.over[place.leader]

    def _without_fault(self, who: Indices, places: Candidates) -> list[LabelPositions]:
        half = self.requests.half[who][places.owners]
        clear = half + complex(CLEARANCE, CLEARANCE)
        kept = np.flatnonzero(~self._outside(places.centres, half))
        # the few areas first: lines are looked at only where these leave room
        for first, last in ((0, self.areas), (self.areas, self.solid)):
            free = np.ones(len(kept), dtype=bool)
            free[self._touched(places.centres[kept], clear[kept], first, last)] = False
            kept = kept[free]
        places, half, clear = places.at(kept), half[kept], clear[kept]
        if len(self.start) > self.solid:
            dashed = self._touched(places.centres, clear, self.solid, len(self.start))
            np.add.at(places.costs, dashed, DASHED_COST)
        led = self._led(who, places, half)
        kept = np.flatnonzero(~led | (places.gaps >= LEADER_LEAST))
        if len(kept) < len(led):
            places, led = places.at(kept), led[kept]
        return self._positions(who, places, led, None)

    def everywhere(self, request: int) -> LabelPositions:
        """All places of all rings for one request, with the number of their faults."""
        who = np.array([request])
        places = candidates(self.requests, who, RINGS)
        half = self.requests.half[who][places.owners]
        faults = OUTSIDE * self._outside(places.centres, half).astype(int)
        np.add.at(faults, self._touched(places.centres, half + complex(CLEARANCE, CLEARANCE), 0, self.solid), 1)
        return self._positions(who, places, self._led(who, places, half), faults)[0]

    def _positions(self, who: Indices, places: Candidates, led: Flags, faults: Indices | None) -> list[LabelPositions]:
        """The places of each request, cheapest first."""
        tips = places.feet.copy()
        if led.any():
            tips[led] = self._with_leaders(who, places, led)
        order = np.lexsort((places.costs, places.owners))
        if faults is None:
            order = order[places.costs[order] < FORBIDDEN]
        wrong = np.zeros(len(led), dtype=np.intp) if faults is None else faults
        places, tips, led, wrong = places.at(order), tips[order], led[order], wrong[order]
        bounds = np.searchsorted(places.owners, np.arange(len(who) + 1)).tolist()
        return [
            LabelPositions(
                half, places.centres[a:z], places.costs[a:z], places.feet[a:z], tips[a:z], led[a:z], wrong[a:z]
            )
            for half, a, z in zip(self.requests.half[who].tolist(), bounds[:-1], bounds[1:], strict=True)
        ]

    def _with_leaders(self, who: Indices, places: Candidates, led: Flags) -> Points:
        """The tips of the leaders of some places, which then cost more."""
        centres, feet, owners = places.centres[led], places.feet[led], who[places.owners[led]]
        off, half = centres - feet, self.requests.half[owners]
        way = _held(off.real, half.real) + 1j * _held(off.imag, half.imag)
        length = np.maximum(np.abs(way), 1e-9)
        tips: Points = feet + way * np.maximum(0.0, 1.0 - LEADER_GAP / length)
        start = feet + way / length * FOOT_REACH
        places.costs[led] += LEADER_COST + CROSSED_COST * self._crossed(feet, start, tips, self.weights)
        nearest = np.minimum(np.abs(self.requests.start[owners] - feet), np.abs(self.requests.end[owners] - feet))
        places.costs[led] += END_COST * (~self.requests.is_point[owners] & (nearest < NEAR_END))
        return tips

    def _outside(self, centres: Points, half: Points) -> Flags:
        low, high, panel = centres - half, centres + half, self.panel
        return (low.real < panel.left) | (high.real > panel.right) | (low.imag < panel.top) | (high.imag > panel.bottom)

    def _touched(self, centres: Points, half: Points, first: int, last: int) -> Indices:
        """The boxes that meet some of the obstacles, each as often as it meets one; obstacles count areas, solid,
        dashed in turn."""
        left, top, right, bottom = (side[first:last] for side in self.reach)
        which, what = near(sides(centres - half, centres + half), (left, top, right, bottom))
        if last <= self.areas:  # for what lies around an area its box will do
            return which
        what += first
        lines = np.flatnonzero(what >= self.areas)
        i, j = which[lines], what[lines]
        meeting = np.ones(len(what), dtype=bool)
        meeting[lines] = ~separated(centres[i], half[i], self.start[j], self.end[j])
        return which[meeting]

    def _led(self, who: Indices, places: Candidates, half: Points) -> Flags:
        """Which places need a leader: far ones, and those about as near to another mark of the same kind as to their
        own."""
        led: Flags = places.gaps > LEADER_FROM
        close = np.flatnonzero(~led)
        centres, own = places.centres[close], self.own_mark[who[places.owners[close]]]
        reach = half[close] + (places.gaps[close] + NEARER) * (1 + 1j)
        which, what = near(sides(centres - reach, centres + reach), self.mark_reach)
        others = (self.mark_is_point[own[which]] == self.mark_is_point[what]) & (own[which] != what)
        which, what = which[others], what[others]
        hit = ~separated(centres[which], reach[which], self.mark_start[what], self.mark_end[what])
        led[close[which[hit]]] = True
        return led

    def _crossed(self, feet: Points, start: Points, to: Points, weights: Floats) -> Floats | Indices:
        """What each leader runs over, by weights: areas are joints and arrowheads, or writing."""
        count = len(start)
        which, what = near(sides_around(start, to), self.reach)
        start, to = start[which], to[which]
        a, b = self.start[what], self.end[what]
        over = touches(start, to, a, b).astype(float)
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
