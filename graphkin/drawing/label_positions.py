"""Which places around marks the drawing leaves free for labels, and which of them other labels leave free.

All places of all labels are judged together as arrays: shapely's tree finds what is near, the separating axes of box
and segment tell what touches.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import shapely

from graphkin.drawing.box import Box
from graphkin.drawing.label_candidates import (
    LEADER_FROM,
    LEADER_LEAST,
    RINGS,
    Candidates,
    LabelRequest,
    Mark,
    candidates,
    ends,
)
from graphkin.drawing.obstacles import (
    Flags,
    Floats,
    Indices,
    Obstacles,
    Points,
    crosses,
    meets,
    separated,
)
from graphkin.drawing.primitives import Segment
from graphkin.plane import cross

__all__ = ["LabelPanel", "LabelPosition", "LabelPositions", "least_cost"]

FEW = 6
"""Places that a label tries one by one, before all of them are judged together."""
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
        space = LEADER_SPACE
        left, top, right, bottom = self.left - space, self.top - space, self.right + space, self.bottom + space
        x1, y1, x2, y2 = a.real, a.imag, b.real, b.imag
        if (x1 < left and x2 < left) or (x1 > right and x2 > right):
            return False
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

    def met(self, others: Sequence[LabelPosition], space: float) -> Flags:
        """Which places (rows) meet which positions of other labels (columns), as `LabelPosition.meets` says."""
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
                over[np.ix_(own, theirs)] |= crosses(
                    *lines[:, None].transpose(2, 0, 1), *leaders[None].transpose(2, 0, 1)
                )
        return over


CLEARANCE = 0.35  # between a label and any line or area, mm
NEARER = 1.2  # by so much a label is nearer to its own mark than to any other
# What a place costs beside its distance (mm): a leader, whatever the leader crosses, a dashed line under the label, a
# leader to a line that ends nearer than NEAR_END to a point at its end.
LEADER_COST, CROSSED_COST, DASHED_COST, END_COST = 4.0, 12.0, 10.0, 3.0
AREA_WEIGHT = 3.0
FORBIDDEN = 1000.0
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
    """A panel with what is drawn on it and all marks, which is asked for positions of labels."""

    def __init__(self, panel: Box, obstacles: Obstacles, marks: Sequence[Mark]) -> None:
        self.panel = panel
        writing = set(obstacles.writing)
        areas = [area.grown(LEADER_SPACE) if area in writing else area for area in obstacles.areas]
        diagonals = tuple((area.corners[0], area.corners[2]) for area in areas)
        self.things = np.array(diagonals + obstacles.solid + obstacles.dashed, dtype=complex).reshape(-1, 2)
        self.areas = len(diagonals)
        self.solid = len(diagonals) + len(obstacles.solid)
        self.writing = np.array([*(area in writing for area in obstacles.areas), False])
        self.tree = shapely.STRtree(_lines(self.things[:, 0], self.things[:, 1]))
        # Labels at the same place share one mark: coincident points are told apart by their letters.
        distinct = list(dict.fromkeys(ends(mark) for mark in marks))
        self.marks = np.array(distinct, dtype=complex).reshape(-1, 2)
        self.index = {pair: i for i, pair in enumerate(distinct)}
        self.is_point = self.marks[:, 0] == self.marks[:, 1]

    def free(self, requests: Sequence[LabelRequest], first: int, last: int) -> list[LabelPositions]:
        """Places without a fault in the rings from ``first`` up to ``last`` for each request."""
        places = candidates(requests, RINGS[first:last])
        half = np.array([request.half for request in requests])
        inside = ~self._outside(places.centres, half[places.owners])
        places = places.at(inside)
        which, what = self._touched(places.centres, half[places.owners] + complex(CLEARANCE, CLEARANCE))
        np.add.at(places.costs, which[what >= self.solid], DASHED_COST)
        kept = np.ones(len(places.owners), dtype=bool)
        kept[which[what < self.solid]] = False
        places = places.at(kept)
        led = self._led(requests, places, half)
        kept = ~led | (places.gaps >= LEADER_LEAST)
        return self._positions(requests, places.at(kept), half, led[kept], None)

    def everywhere(self, request: LabelRequest) -> LabelPositions:
        """All places of all rings for one request, with the number of their faults."""
        places = candidates([request], RINGS)
        half = np.array([request.half])
        faults = OUTSIDE * self._outside(places.centres, half[places.owners]).astype(int)
        which, what = self._touched(places.centres, half[places.owners] + complex(CLEARANCE, CLEARANCE))
        np.add.at(faults, which[what < self.solid], 1)
        return self._positions([request], places, half, self._led([request], places, half), faults)[0]

    def _positions(
        self, requests: Sequence[LabelRequest], places: Candidates, half: Points, led: Flags, faults: Indices | None
    ) -> list[LabelPositions]:
        """The places of each request, cheapest first."""
        costs, owners = places.costs, places.owners
        own = half[owners]
        off = places.centres - places.feet
        way = _held(off.real, own.real) + 1j * _held(off.imag, own.imag)
        length = np.maximum(np.abs(way), 1e-9)
        tips = places.feet + way * np.maximum(0.0, 1.0 - LEADER_GAP / length)
        if led.any():
            reach = np.array([POINT_REACH if request.is_point else LINE_REACH for request in requests])[owners[led]]
            start = places.feet[led] + way[led] / length[led] * reach
            costs[led] += LEADER_COST + CROSSED_COST * self._crossed(places.feet[led], start, tips[led])
            ends_of = [(one.start, one.end) if not one.is_point else (np.inf, np.inf) for one in requests]
            near = np.abs(np.array(ends_of)[owners[led]] - places.feet[led][:, None]).min(axis=1) < NEAR_END
            costs[led] += END_COST * near
        wrong = np.zeros(len(costs), dtype=np.intp) if faults is None else faults
        if faults is None:
            kept = costs < FORBIDDEN
            places, tips, led, wrong = places.at(kept), tips[kept], led[kept], wrong[kept]
        order = np.lexsort((places.costs, places.owners))
        places, tips, led, wrong = places.at(order), tips[order], led[order], wrong[order]
        bounds = np.searchsorted(places.owners, np.arange(len(requests) + 1))
        return [
            LabelPositions(
                one.half, places.centres[a:z], places.costs[a:z], places.feet[a:z], tips[a:z], led[a:z], wrong[a:z]
            )
            for one, a, z in zip(requests, bounds[:-1], bounds[1:], strict=True)
        ]

    def _outside(self, centres: Points, half: Points) -> Flags:
        low, high, panel = centres - half, centres + half, self.panel
        return (low.real < panel.left) | (high.real > panel.right) | (low.imag < panel.top) | (high.imag > panel.bottom)

    def _touched(self, centres: Points, half: Points) -> tuple[Indices, Indices]:
        """Pairs of box and obstacle that meet; obstacles count areas, solid, dashed in turn."""
        which, what = self.tree.query(_lines(centres - half, centres + half))
        meets = (what < self.areas) | ~separated(centres[which], half[which], self.things[what])
        return which[meets], what[meets]

    def _led(self, requests: Sequence[LabelRequest], places: Candidates, half: Points) -> Flags:
        """Which places need a leader: far ones, and those about as near to another mark of the same kind as to their
        own."""
        centres, gaps = places.centres, places.gaps
        own = np.array([self.index[request.start, request.end] for request in requests], dtype=int)[places.owners]
        reach = half[places.owners] + (gaps + NEARER) * (1 + 1j)
        low, high = _reach(self.marks)
        near = (low.real < (centres + reach).real[:, None]) & (high.real > (centres - reach).real[:, None])
        near &= (low.imag < (centres + reach).imag[:, None]) & (high.imag > (centres - reach).imag[:, None])
        near &= (self.is_point[own][:, None] == self.is_point) & (own[:, None] != np.arange(len(self.marks)))
        which, what = np.nonzero(near)
        touched = ~separated(centres[which], reach[which], self.marks[what])
        led = gaps > LEADER_FROM
        led[which[touched]] = True
        return led

    def _crossed(self, feet: Points, start: Points, to: Points) -> Floats | Indices:
        """How many obstacles each leader runs over; an area counts for several: it is a joint or an arrowhead; writing
        is not to be run over."""
        count = len(start)
        which, what = self.tree.query(_lines(start, to))
        start, to = start[which], to[which]
        a, b = self.things[what].T
        over = crosses(start, to, a, b).astype(float)
        areas = what < self.areas  # a leader over an area crosses one of its diagonals
        a, b = a[areas], b[areas]
        other = a.real + 1j * b.imag, b.real + 1j * a.imag
        weight = np.where(self.writing[what[areas]], FORBIDDEN, AREA_WEIGHT)
        foot = feet[which[areas]]
        own = (a.real <= foot.real) & (foot.real <= b.real) & (a.imag <= foot.imag) & (foot.imag <= b.imag)
        over[areas] = weight * ~own * (over[areas] + crosses(start[areas], to[areas], *other))
        return np.bincount(which, over, minlength=count)


def _lines(start: Points, end: Points) -> Any:
    """Lines as shapely's tree takes them: for what lies around a box its diagonal will do."""
    return shapely.linestrings(np.stack((start, end), axis=1).view(float).reshape(-1, 2, 2))


def _held(off: Floats, half: Floats) -> Floats:
    """From a foot to the nearest of a box along one axis."""
    return np.where(np.abs(off) <= half, 0.0, off - np.sign(off) * half)


def _reach(segments: Points) -> tuple[Points, Points]:
    """Least and greatest corner of the box around each segment."""
    a, b = segments[:, 0], segments[:, 1]
    return (
        np.minimum(a.real, b.real) + 1j * np.minimum(a.imag, b.imag),
        np.maximum(a.real, b.real) + 1j * np.maximum(a.imag, b.imag),
    )
