"""Which places around marks the drawing leaves free.

All places of all labels are judged together as arrays: shapely's tree finds what is near, the separating axes of box
and segment tell what touches.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely

from graphkin.drawing.box import Box
from graphkin.drawing.label_positions import (
    LEADER_FROM,
    LEADER_GAP,
    LEADER_LEAST,
    LEADER_SPACE,
    RINGS,
    Around,
    Asker,
    Mark,
    Seats,
    around,
    cross_product,
    ends,
    separated,
)
from graphkin.drawing.obstacles import Obstacles

__all__ = ["Field", "least_cost"]

CLEARANCE = 0.35  # between a label and any line or area, mm
NEARER = 1.2  # by so much a label is nearer to its own mark than to any other
# What a place costs beside its distance (mm): a leader, whatever the leader crosses, a dashed line under the label, a
# leader to a line that ends nearer than NEAR_END to a point at its end.
LEADER_COST, CROSSED_COST, DASHED_COST, END_COST = 4.0, 3.0, 10.0, 3.0
AREA_WEIGHT = 3.0
FORBIDDEN = 1000.0
OUTSIDE = 100  # faults that leaving the panel counts for
# What lies nearer to the foot of a leader is the mark itself: a point with its symbol, or the line of a vector, mm.
POINT_REACH, LINE_REACH = 1.5, 0.4
NEAR_END = 2.0


def least_cost(ring: int) -> float:
    """What the best place of a ring could cost."""
    return RINGS[ring] + (LEADER_COST if RINGS[ring] > LEADER_FROM else 0.0)


class Field:
    """A panel with what is drawn on it and all marks, ready to be asked for places."""

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

    def free(self, askers: Sequence[Asker], first: int, last: int) -> list[Seats]:
        """Places without a fault in the rings from ``first`` up to ``last`` for each asker."""
        places = around(askers, RINGS[first:last])
        half = np.array([asker.half for asker in askers])
        inside = ~self._outside(places.centres, half[places.owners])
        places = places.at(inside)
        which, what = self._touched(places.centres, half[places.owners] + complex(CLEARANCE, CLEARANCE))
        np.add.at(places.costs, which[what >= self.solid], DASHED_COST)
        kept = np.ones(len(places.owners), dtype=bool)
        kept[which[what < self.solid]] = False
        places = places.at(kept)
        led = self._led(askers, places, half)
        kept = ~led | (places.gaps >= LEADER_LEAST)
        return self._seats(askers, places.at(kept), half, led[kept], None)

    def everywhere(self, asker: Asker) -> Seats:
        """All places of all rings for one asker, with the number of their faults."""
        places = around([asker], RINGS)
        half = np.array([asker.half])
        faults = OUTSIDE * self._outside(places.centres, half[places.owners]).astype(int)
        which, what = self._touched(places.centres, half[places.owners] + complex(CLEARANCE, CLEARANCE))
        np.add.at(faults, which[what < self.solid], 1)
        return self._seats([asker], places, half, self._led([asker], places, half), faults)[0]

    def _seats(self, askers: Sequence[Asker], places: Around, half: Any, led: Any, faults: Any) -> list[Seats]:
        """The places of each asker, cheapest first."""
        costs, owners = places.costs, places.owners
        own = half[owners]
        off = places.centres - places.feet
        way = _held(off.real, own.real) + 1j * _held(off.imag, own.imag)
        length = np.maximum(np.abs(way), 1e-9)
        tips = places.feet + way * np.maximum(0.0, 1.0 - LEADER_GAP / length)
        if led.any():
            reach = np.array([POINT_REACH if asker.is_point else LINE_REACH for asker in askers])[owners[led]]
            start = places.feet[led] + way[led] / length[led] * reach
            costs[led] += LEADER_COST + CROSSED_COST * self._crossed(places.feet[led], start, tips[led])
            ends_of = [(asker.start, asker.end) if not asker.is_point else (np.inf, np.inf) for asker in askers]
            near = np.abs(np.array(ends_of)[owners[led]] - places.feet[led][:, None]).min(axis=1) < NEAR_END
            costs[led] += END_COST * near
        if faults is None:
            kept = costs < FORBIDDEN
            places, owners, costs, tips, led = places.at(kept), owners[kept], costs[kept], tips[kept], led[kept]
        order = np.lexsort((costs, owners))
        bounds = np.searchsorted(owners[order], np.arange(len(askers) + 1))
        centres, costs, feet, tips, led = (c[order] for c in (places.centres, costs, places.feet, tips, led))
        wrong = np.zeros(len(order), dtype=int) if faults is None else faults[order]
        return [
            Seats(asker.half, centres[a:z], costs[a:z], feet[a:z], tips[a:z], led[a:z], wrong[a:z])
            for asker, a, z in zip(askers, bounds[:-1], bounds[1:], strict=True)
        ]

    def _outside(self, centres: Any, half: Any) -> Any:
        low, high, panel = centres - half, centres + half, self.panel
        return (low.real < panel.left) | (high.real > panel.right) | (low.imag < panel.top) | (high.imag > panel.bottom)

    def _touched(self, centres: Any, half: Any) -> tuple[Any, Any]:
        """Pairs of box and obstacle that meet; obstacles count areas, solid, dashed in turn."""
        which, what = self.tree.query(_lines(centres - half, centres + half))
        meets = (what < self.areas) | ~separated(centres[which], half[which], self.things[what])
        return which[meets], what[meets]

    def _led(self, askers: Sequence[Asker], places: Around, half: Any) -> Any:
        """Which places need a leader: far ones, and those about as near to another mark of the same kind as to their
        own."""
        centres, gaps = places.centres, places.gaps
        own = np.array([self.index[asker.start, asker.end] for asker in askers], dtype=int)[places.owners]
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

    def _crossed(self, feet: Any, start: Any, to: Any) -> Any:
        """How many obstacles each leader runs over; an area counts for several: it is a joint or an arrowhead; writing
        is not to be run over."""
        count = len(start)
        which, what = self.tree.query(_lines(start, to))
        start, to = start[which], to[which]
        a, b = self.things[what].T
        over = _crosses(start, to, a, b).astype(float)
        areas = what < self.areas  # a leader over an area crosses one of its diagonals
        a, b = a[areas], b[areas]
        other = a.real + 1j * b.imag, b.real + 1j * a.imag
        weight = np.where(self.writing[what[areas]], FORBIDDEN, AREA_WEIGHT)
        foot = feet[which[areas]]
        own = (a.real <= foot.real) & (foot.real <= b.real) & (a.imag <= foot.imag) & (foot.imag <= b.imag)
        over[areas] = weight * ~own * (over[areas] + _crosses(start[areas], to[areas], *other))
        return np.bincount(which, over, minlength=count)


def _lines(start: Any, end: Any) -> Any:
    """Lines as shapely's tree takes them: for what lies around a box its diagonal will do."""
    return shapely.linestrings(np.stack((start, end), axis=1).view(float).reshape(-1, 2, 2))


def _crosses(a: Any, b: Any, c: Any, d: Any) -> Any:
    """Whether lines from a to b cross lines from c to d between their ends."""
    apart = cross_product(b - a, c - a) * cross_product(b - a, d - a)
    across = cross_product(d - c, a - c) * cross_product(d - c, b - c)
    return (apart < 0) & (across < 0)


def _held(off: Any, half: Any) -> Any:
    """From a foot to the nearest of a box along one axis."""
    return np.where(np.abs(off) <= half, 0.0, off - np.sign(off) * half)


def _reach(segments: Any) -> tuple[Any, Any]:
    """Least and greatest corner of the box around each segment."""
    a, b = segments[:, 0], segments[:, 1]
    return (
        np.minimum(a.real, b.real) + 1j * np.minimum(a.imag, b.imag),
        np.maximum(a.real, b.real) + 1j * np.maximum(a.imag, b.imag),
    )
