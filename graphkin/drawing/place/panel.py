"""Which places around marks the drawing leaves free for labels.

All places of all labels are judged together as arrays: where ink is, cell by cell, tells of most boxes that they meet
it, upright boxes what is near, the separating axes of box and segment what touches.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Segment
from graphkin.drawing.place.intersections import (
    Flags,
    Floats,
    Indices,
    Points,
    crosses,
    joined,
    near,
    separated,
    sides,
    sides_around,
    touching,
)
from graphkin.drawing.place.labels import (
    LEADER_FROM,
    LEADER_LEAST,
    LEADER_SPACE,
    LED_RINGS,
    RINGS,
    Candidates,
    Columns,
    LabelForms,
    LabelPosition,
    LabelPositions,
    LabelRequest,
    LabelRequests,
    Mark,
    Obstacles,
    candidates,
    ends,
    led_candidates,
)

__all__ = ["FORBIDDEN", "TANGLED", "InkRaster", "LabelPanel", "least_cost"]

CELL = 1.0  # mm
ROUNDING = 1e-9  # cells


class InkRaster:
    """The cells of a panel that hold points of lines or areas, summed up over rows and columns (Crow, Summed-area
    tables for texture mapping, SIGGRAPH 1984), so that four numbers tell how many lie in a box of cells."""

    def __init__(self, panel: Box, start: Points, end: Points, areas: int) -> None:
        """Lines from ``start`` to ``end``; the first ``areas`` of them are diagonals of filled upright boxes."""
        self.left, self.top = panel.left - 2 * CELL, panel.top - 2 * CELL
        self.columns, rows = int(panel.width / CELL) + 6, int(panel.height / CELL) + 6
        height = (end - start).imag[:areas]
        lines, step = _apart(height)
        low = start[:areas][lines] + 1j * step * height[lines]
        width = (end - start).real[:areas][lines]
        start, end = np.concatenate((low, start[areas:])), np.concatenate((low + width, end[areas:]))
        lines, step = _apart(end - start)
        points = start[lines] + step * (end - start)[lines]
        x, y = (points.real - self.left) / CELL, (points.imag - self.top) / CELL
        inside = (x >= 0) & (x < self.columns - 1) & (y >= 0) & (y < rows - 1)
        held = np.zeros((rows, self.columns), dtype=np.int32)
        held[y[inside].astype(np.intp) + 1, x[inside].astype(np.intp) + 1] = 1
        self.sums = held.cumsum(axis=0, dtype=np.int32).cumsum(axis=1, dtype=np.int32).ravel()

    def meets(self, low: Points, high: Points) -> Flags:
        """Which of some boxes of these corners surely meet ink, since a cell with ink is within; boxes in the panel."""
        grown = 1.0 + ROUNDING
        x, y = (low.real - self.left) / CELL + grown, (low.imag - self.top) / CELL + grown
        left, right = x.astype(np.intp), np.maximum((high.real - self.left) / CELL, x).astype(np.intp)
        top, bottom = y.astype(np.intp), np.maximum((high.imag - self.top) / CELL, y).astype(np.intp)
        top *= self.columns
        bottom *= self.columns
        more: Flags = self._upto(bottom + right) + self._upto(top + left) > (
            self._upto(bottom + left) + self._upto(top + right)
        )
        return more

    def _upto(self, cells: Indices) -> Indices:
        """How many cells hold something up to each of some."""
        return self.sums.take(cells, mode="clip")


def _apart(ways: Points | Floats) -> tuple[Indices, Floats]:
    """Points that lie no further than a cell apart along each of some ways, both ends included: the way of each, and
    its share of it."""
    steps = np.maximum(np.ceil(np.abs(ways) / CELL), 1).astype(np.intp)
    which = np.repeat(np.arange(len(ways)), steps + 1)
    first = np.cumsum(steps + 1) - (steps + 1)
    return which, (np.arange(len(which)) - first[which]) / steps[which]


LEADER_GAP = 0.4  # mm between the end of a leader and the box of its label
CLEARANCE = 0.35  # between a label and any line or area, mm
NEARER = 1.2  # by so much a label is nearer to its own mark than to any other
# What a place costs beside its distance (mm): a leader, whatever the leader crosses, a dashed line under the label, a
# leader to a line that ends nearer than NEAR_END to a point at its end.
LEADER_COST, CROSSED_COST, DASHED_COST, END_COST = 4.0, 12.0, 110.0, 3.0
BESIDE, BEYOND_COST = 1.0, 6.0  # mm off its point, and what it costs there that a vector runs between without a leader
AREA_WEIGHT, THICK_WEIGHT = 25.0, 10.0  # of what a leader crosses, where a thin line counts 1
FORBIDDEN = 1e5
TANGLED = LEADER_COST + CROSSED_COST * THICK_WEIGHT  # what a place costs at least whose leader crosses a vector
OUTSIDE = 100  # faults that leaving the panel counts for
FOOT_REACH = 0.45  # mm: what lies nearer to the foot of a leader is the mark itself
NEAR_END = 2.0
MANY = 1 << 15  # pairs of a box and an obstacle from which a raster of what is drawn is worth its making


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
        diagonals = tuple((complex(area.left, area.top), complex(area.right, area.bottom)) for area in areas)
        things = np.array(diagonals + obstacles.solid + obstacles.dashed, dtype=complex).reshape(-1, 2)
        self.start, self.end = things.T.copy()
        self.reach = sides_around(self.start, self.end)
        self.areas = len(diagonals)
        self.solid = len(diagonals) + len(obstacles.solid)
        thick = set(obstacles.thick)
        self.vectors = np.array(obstacles.vectors, dtype=complex).reshape(-1, 2).T.copy()
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

    def free(
        self, some: Sequence[int], first: int, last: int, known: Sequence[LabelPositions] = ()
    ) -> list[LabelPositions]:
        """Places without a fault in the rings from ``first`` up to ``last`` for each of some requests, with those that
        are known of each."""
        who = np.array(some)
        return self._without_fault(who, candidates(self.requests, who, RINGS[first:last]), known)

    def further(
        self, some: Sequence[int], rings: tuple[float, ...], known: Sequence[LabelPositions]
    ) -> list[LabelPositions]:
        """Further places without a fault in some rings for each of some requests, with leaders, and those that are
        known of each."""
        who = np.array(some)
        return self._without_fault(who, led_candidates(self.requests, who, rings), known)

    def everywhere_free(self, some: Sequence[int]) -> list[LabelPositions]:
        """Places without a fault in all rings, and further ones, for each of some requests."""
        who = np.array(some)
        led = led_candidates(self.requests, who, sum(LED_RINGS, ()))
        return self._without_fault(who, candidates(self.requests, who, RINGS) + led)

    def struck(self, place: LabelPosition) -> bool:
        """Whether a dashed line runs through a place."""
        if place.cost <= DASHED_COST:
            return False
        half = complex(place.right - place.left, place.bottom - place.top) / 2 + complex(CLEARANCE, CLEARANCE)
        _, what = self._touched(np.array([place.box.centre]), np.array([half]), len(self.start))
        return bool((what >= self.solid).any())

    def tangled(self, place: LabelPosition) -> bool:
        """Whether the leader of a place crosses a vector, a link, a joint or an arrowhead."""
        if place.leader is None:
            return False
        if place.leader not in self.over:
            foot, tip = (np.array([z]) for z in place.leader)
            start = foot + (tip - foot) / np.abs(tip - foot) * FOOT_REACH
            self.over[place.leader] = bool(self._crossed(foot, start, tip, self.weights * (self.weights > 1.0))[0] > 0)
        return self.over[place.leader]

    def _without_fault(
        self, who: Indices, places: Candidates, known: Sequence[LabelPositions] = ()
    ) -> list[LabelPositions]:
        half = self.requests.half[who][places.owners]
        clear = half + complex(CLEARANCE, CLEARANCE)
        free = ~self._outside(places.centres, half)
        if len(half) * self.solid > MANY:
            free &= ~self.ink.meets(places.centres - clear, places.centres + clear)
        kept = free.nonzero()[0]
        places, half, clear = places.at(kept), half[kept], clear[kept]
        which, what = self._touched(places.centres, clear, len(self.start))
        np.add.at(places.costs, which[what >= self.solid], DASHED_COST)
        led = self._led(who, places, half)
        free = ~led | (places.gaps >= LEADER_LEAST)
        free[which[what < self.solid]] = False
        kept = free.nonzero()[0]
        places, led = places.at(kept), led[kept]
        self._charge_beyond(who, places, half[kept], led)
        columns = Columns(places.centres, places.costs, places.feet, self._tips(who, places, led), led)
        owners = places.owners
        if known:
            columns = Columns(*map(np.concatenate, zip(*(one.columns for one in known), columns, strict=True)))
            owners = np.concatenate((np.repeat(np.arange(len(known)), [len(one) for one in known]), owners))
        order = np.lexsort((columns.costs, owners))
        order = order[columns.costs[order] < FORBIDDEN]
        columns, owners = columns.at(order), owners[order]
        bounds = np.searchsorted(owners, np.arange(len(who) + 1)).tolist()
        forms = LabelForms(columns)
        return [
            LabelPositions(half, columns.at(slice(first, last)), forms, first)
            for half, first, last in zip(self.requests.half[who].tolist(), bounds[:-1], bounds[1:], strict=True)
        ]

    def everywhere(self, request: int) -> tuple[LabelPositions, Indices]:
        """All places of all rings for one request, and the number of faults of each."""
        who = np.array([request])
        places = candidates(self.requests, who, RINGS)
        half = self.requests.half[who][places.owners]
        faults = OUTSIDE * self._outside(places.centres, half).astype(int)
        np.add.at(faults, self._touched(places.centres, half + complex(CLEARANCE, CLEARANCE), self.solid)[0], 1)
        led = self._led(who, places, half)
        columns = Columns(places.centres, places.costs, places.feet, self._tips(who, places, led), led)
        order = np.argsort(columns.costs, kind="stable")
        return LabelPositions(complex(half[0]), columns.at(order)), faults[order]

    def _tips(self, who: Indices, places: Candidates, led: Flags) -> Points:
        """The tips of the leaders of places that need one, which then cost more; of other places their feet."""
        tips = places.feet.copy()
        some = led.nonzero()[0]
        if not some.size:
            return tips
        centres, feet, owners = places.centres[some], places.feet[some], who[places.owners[some]]
        off, half = centres - feet, self.requests.half[owners]
        way = _held(off.real, half.real) + 1j * _held(off.imag, half.imag)
        length = np.maximum(np.abs(way), 1e-9)
        tips[some] = to = feet + way * np.maximum(0.0, 1.0 - LEADER_GAP / length)
        start = feet + way / length * FOOT_REACH
        nearest = np.minimum(np.abs(self.requests.start[owners] - feet), np.abs(self.requests.end[owners] - feet))
        places.costs[some] += LEADER_COST + CROSSED_COST * self._crossed(feet, start, to, self.weights)
        places.costs[some] += END_COST * (~self.requests.is_point[owners] & (nearest < NEAR_END))
        return tips

    def _charge_beyond(self, who: Indices, places: Candidates, half: Points, led: Flags) -> None:
        """Let places of points cost more that have no leader though a vector runs between."""
        if not len(self.vectors[0]):
            return
        some = (~led & (places.gaps > BESIDE) & self.requests.is_point[who[places.owners]]).nonzero()[0]
        off = places.centres[some] - places.feet[some]
        way = _held(off.real, half[some].real) + 1j * _held(off.imag, half[some].imag)
        feet = places.feet[some]
        start, to = feet + way / np.maximum(np.abs(way), 1e-9) * FOOT_REACH, feet + way
        for which, what in near(sides_around(start, to), sides_around(*self.vectors)):
            over = touching(start.take(which), to.take(which), self.vectors[0].take(what), self.vectors[1].take(what))
            places.costs[some[np.unique(which[over])]] += BEYOND_COST

    def _outside(self, centres: Points, half: Points) -> Flags:
        low, high, panel = centres - half, centres + half, self.panel
        return (low.real < panel.left) | (high.real > panel.right) | (low.imag < panel.top) | (high.imag > panel.bottom)

    @cached_property
    def ink(self) -> InkRaster:
        """All areas and solid lines."""
        return InkRaster(self.panel.grown(CLEARANCE), self.start[: self.solid], self.end[: self.solid], self.areas)

    def _touched(self, centres: Points, half: Points, count: int) -> tuple[Indices, Indices]:
        """Pairs of a box and one of the first obstacles that it meets; obstacles count areas, solid, dashed in turn."""
        found = []
        left, top, right, bottom = (side[:count] for side in self.reach)
        for which, what in near(sides(centres - half, centres + half), (left, top, right, bottom)):
            lines = (what >= self.areas).nonzero()[0]  # for what lies around an area its box will do
            i, j = which.take(lines), what.take(lines)
            meeting = np.ones(len(what), dtype=bool)
            meeting[lines] = ~separated(centres.take(i), half.take(i), self.start.take(j), self.end.take(j))
            found.append((which[meeting], what[meeting]))
        return joined(found)

    def _led(self, who: Indices, places: Candidates, half: Points) -> Flags:
        """Which places need a leader: far ones, and those about as near to another mark of the same kind as to their
        own."""
        led: Flags = places.gaps > LEADER_FROM
        close = (~led).nonzero()[0]
        centres, own = places.centres[close], self.own_mark[who[places.owners[close]]]
        reach = half[close] + (places.gaps[close] + NEARER) * (1 + 1j)
        for which, what in near(sides(centres - reach, centres + reach), self.mark_reach):
            others = (self.mark_is_point[own[which]] == self.mark_is_point[what]) & (own[which] != what)
            i, j = which[others], what[others]
            hit = ~separated(centres[i], reach[i], self.mark_start[j], self.mark_end[j])
            led[close[i[hit]]] = True
        return led

    def _crossed(self, feet: Points, start: Points, to: Points, weights: Floats) -> Floats:
        """What each leader runs over, by weights: areas are joints and arrowheads, or writing."""
        found = np.zeros(len(feet))
        for which, what in near(sides_around(start, to), self.reach):
            a, b, c, d = start.take(which), to.take(which), self.start.take(what), self.end.take(what)
            over = np.zeros(len(what))
            over[touching(a, b, c, d)] = 1.0
            areas = (what < self.areas).nonzero()[0]  # a leader over an area crosses one of its diagonals
            a, b, c, d = a.take(areas), b.take(areas), c.take(areas), d.take(areas)
            foot = feet.take(which.take(areas))
            own = (c.real <= foot.real) & (foot.real <= d.real) & (c.imag <= foot.imag) & (foot.imag <= d.imag)
            written = weights.take(what.take(areas)) >= FORBIDDEN  # a foot under writing is no place for it
            other = c.real + 1j * d.imag, d.real + 1j * c.imag
            over[areas] = np.where(own, written, over.take(areas) + crosses(a, b, *other))
            some = over.nonzero()[0]
            found += np.bincount(which.take(some), over.take(some) * weights.take(what.take(some)), len(feet))
        return found


def _held(off: Floats, half: Floats) -> Floats:
    """From a foot to the nearest of a box along one axis."""
    return np.where(np.abs(off) <= half, 0.0, off - np.sign(off) * half)
