"""The places around marks where labels could stand, and which of them the drawing leaves free.

All places of all labels are judged together as arrays: shapely's tree finds what is near, the separating axes of box
and segment tell what touches.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import shapely

from graphkin.drawing.box import Box
from graphkin.drawing.obstacles import Obstacles, Segment
from graphkin.drawing.primitives import page_direction

__all__ = ["RINGS", "Asker", "Candidate", "Field", "Mark", "least_cost"]

Mark: TypeAlias = complex | Segment

# Distance of the box from its mark, mm, ring by ring.
RINGS = (0.7, 1.5, 2.4, 3.6, 5.0, 6.8, 9.0, 11.5, 14.5, 18.0, 22.0, 27.0)
CLEARANCE = 0.35  # between a label and any line or area
NEARER = 0.3  # by so much a label is nearer to its own mark than to any other
LEADER_FROM = 5.0  # a label further off than this has a leader
LEADER_LEAST = 2.0  # a leader shorter than this would not be seen
# What a place costs beside its distance (mm): a leader, whatever the leader crosses, a dashed line under the label.
LEADER_COST, CROSSED_COST, DASHED_COST = 4.0, 3.0, 1.6
AREA_WEIGHT = 3.0
# What lies nearer to the foot of a leader is the mark itself: a point with its symbol, or the line of a vector, mm.
POINT_REACH, LINE_REACH = 1.5, 0.4
_ANGLES = 2 * np.pi * np.arange(24) / 24
_WAYS = np.exp(-1j * _ANGLES)
_HOLDS = np.clip(1.6 * _WAYS.real, -1, 1), np.clip(1.6 * _WAYS.imag, -1, 1)
_SHARES = np.array((0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9))
# Without a wish, up and to the right reads best (Imhof, Positioning names on maps, 1975).
_LIKED = math.radians(40)


@dataclass(frozen=True)
class Asker:
    """A label as the field sees it: its mark, half its width and height as a complex number, its liked directions."""

    mark: Mark
    half: complex
    toward: tuple[float, ...]


@dataclass(frozen=True)
class Candidate:
    """A place for a label: its box, what it costs in looks (mm), its leader from mark to box, the box around both, and
    the number of faults that the drawing finds there."""

    box: Box
    cost: float
    leader: Segment | None
    reach: Box
    faults: int = 0

    def meets(self, other: Candidate, space: float) -> bool:
        """Whether two labels come nearer than a space (mm), or one's leader crosses the other or its leader."""
        if not _near(self.reach, other.reach, space):
            return False
        if _near(self.box, other.box, space):
            return True
        if self.leader is not None and other.box.clip(*self.leader) is not None:
            return True
        if other.leader is None:
            return False
        return self.box.clip(*other.leader) is not None or (
            self.leader is not None and _cross(self.leader, other.leader)
        )


def least_cost(ring: int) -> float:
    """What the best place of a ring could cost."""
    return RINGS[ring] + (LEADER_COST if RINGS[ring] > LEADER_FROM else 0.0)


class Places:
    """Places of one label, cheapest first; made into candidates as they are asked for."""

    def __init__(self, half: complex, centres: Any, costs: Any, feet: Any, led: Any, faults: Any) -> None:
        self.half = half
        order = np.argsort(costs, kind="stable")
        columns = (centres, costs, feet, led, faults)
        self._rows = list(zip(*(column[order].tolist() for column in columns), strict=True))
        self._made: list[Candidate] = []

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[Candidate]:
        for index in range(len(self._rows)):
            if index == len(self._made):
                self._made.append(self._make(*self._rows[index]))
            yield self._made[index]

    def _make(self, centre: complex, cost: float, foot: complex, led: bool, faults: int) -> Candidate:
        corner, other = centre - self.half, centre + self.half
        box = Box(corner.real, corner.imag, other.real, other.imag)
        if not led:
            return Candidate(box, cost, None, box, faults)
        leader = (foot, box.nearest(foot))
        return Candidate(box, cost, leader, box.joined(Box.around(leader)), faults)


class Field:
    """A panel with what is drawn on it and all marks, ready to be asked for places."""

    def __init__(self, panel: Box, obstacles: Obstacles, marks: Sequence[Mark]) -> None:
        self.panel = panel
        diagonals = tuple((area.corners[0], area.corners[2]) for area in obstacles.areas)
        self.things = np.array(diagonals + obstacles.solid + obstacles.dashed, dtype=complex).reshape(-1, 2)
        self.areas = len(diagonals)
        self.solid = len(diagonals) + len(obstacles.solid)
        low, high = _reach(self.things)
        self.tree = shapely.STRtree(shapely.box(low.real, low.imag, high.real, high.imag))
        # Labels at the same place share one mark: coincident points are told apart by their letters.
        distinct = list(dict.fromkeys(_ends(mark) for mark in marks))
        self.marks = np.array(distinct, dtype=complex).reshape(-1, 2)
        self.index = {ends: i for i, ends in enumerate(distinct)}
        self.is_point = self.marks[:, 0] == self.marks[:, 1]

    def free(self, askers: Sequence[Asker], first: int, last: int) -> list[Places]:
        """Places without a fault in the rings from ``first`` up to ``last`` for each asker."""
        return self._judged(askers, RINGS[first:last], free=True)

    def everywhere(self, asker: Asker) -> Places:
        """All places of all rings for one asker, with the number of their faults."""
        return self._judged([asker], RINGS, free=False)[0]

    def _judged(self, askers: Sequence[Asker], gaps: Sequence[float], free: bool) -> list[Places]:
        sets = [_around(asker, np.array(gaps)) for asker in askers]
        centres, costs, feet, gap = (np.concatenate(column) for column in zip(*sets, strict=True))
        sizes = [len(each[0]) for each in sets]
        owner = np.repeat(np.arange(len(askers)), sizes)
        half = np.array([asker.half for asker in askers])[owner]
        faults = self._outside(centres, half)
        which, what = self._touched(centres, half + complex(CLEARANCE, CLEARANCE))
        solid = what < self.solid
        np.add.at(faults, which[solid], 1)
        np.add.at(costs, which[~solid], DASHED_COST)
        if free:
            kept = faults == 0
            centres, costs, feet, gap, owner, half, faults = (
                column[kept] for column in (centres, costs, feet, gap, owner, half, faults)
            )
        own = np.array([self.index[_ends(asker.mark)] for asker in askers], dtype=int)[owner]
        reach = np.where(self.is_point[own], POINT_REACH, LINE_REACH)
        led = (gap > LEADER_FROM) | self._doubtful(centres, half, gap, own)
        if free:
            kept = ~led | (gap >= LEADER_LEAST)
            centres, costs, feet, owner, half, faults, led, reach = (
                column[kept] for column in (centres, costs, feet, owner, half, faults, led, reach)
            )
        costs[led] += LEADER_COST + CROSSED_COST * self._crossed(feet[led], centres[led], half[led], reach[led])
        return [
            Places(asker.half, *(column[owner == i] for column in (centres, costs, feet, led, faults)))
            for i, asker in enumerate(askers)
        ]

    def _outside(self, centres: Any, half: Any) -> Any:
        low, high, panel = centres - half, centres + half, self.panel
        out = (low.real < panel.left) | (high.real > panel.right) | (low.imag < panel.top) | (high.imag > panel.bottom)
        return out.astype(int)

    def _touched(self, centres: Any, half: Any) -> tuple[Any, Any]:
        """Pairs of box and obstacle that meet; obstacles count areas, solid, dashed in turn."""
        low, high = centres - half, centres + half
        which, what = self.tree.query(shapely.box(low.real, low.imag, high.real, high.imag))
        meets = (what < self.areas) | ~_separated(centres[which], half[which], self.things[what])
        return which[meets], what[meets]

    def _doubtful(self, centres: Any, half: Any, gap: Any, own: Any) -> Any:
        """Which boxes are about as near to another mark of the same kind as to their own."""
        reach = half + (gap + NEARER) * (1 + 1j)
        shape = len(centres), len(self.marks)
        near = ~_separated(
            np.broadcast_to(centres[:, None], shape), np.broadcast_to(reach[:, None], shape), self.marks[None]
        )
        low, high = _reach(self.marks)
        d = reach[:, None]
        near &= (low.real < (centres[:, None] + d).real) & (high.real > (centres[:, None] - d).real)
        near &= (low.imag < (centres[:, None] + d).imag) & (high.imag > (centres[:, None] - d).imag)
        rivals = (self.is_point[own][:, None] == self.is_point) & (own[:, None] != np.arange(len(self.marks)))
        return (near & rivals).any(axis=1)

    def _crossed(self, feet: Any, centres: Any, half: Any, reach: Any) -> Any:
        """How many obstacles each leader runs over once it has left its own mark; an area, crossed where one of its
        diagonals is, counts for several: it is a number, a joint or an arrowhead."""
        to = feet + _held(centres.real - feet.real, half.real) + 1j * _held(centres.imag - feet.imag, half.imag)
        way = (to - feet)[:, None]
        start = feet[:, None] + way / np.maximum(np.abs(way), 1e-9) * reach[:, None]
        areas = self.things[: self.areas]
        other = areas.real[:, ::-1] + 1j * areas.imag  # the other diagonals
        lines, weights = np.concatenate((self.things, other)), np.ones(len(self.things) + self.areas)
        weights[: self.areas] = weights[len(self.things) :] = AREA_WEIGHT
        a, b = lines[None, :, 0], lines[None, :, 1]
        apart = _turn(way, a - start) * _turn(way, b - start)
        across = _turn(b - a, start - a) * _turn(b - a, to[:, None] - a)
        return ((apart < 0) & (across < 0)) @ weights


def _around(asker: Asker, gaps: Any) -> tuple[Any, Any, Any, Any]:
    """Centres of boxes, costs, feet on the mark and gaps, for the rings of one label."""
    start, end = _ends(asker.mark)
    if start == end:
        return _off_point(start, asker, gaps)
    # Far from a vector there is more room all round its middle than square to it.
    middle = _off_point((start + end) / 2, Asker(asker.mark, asker.half, ()), gaps[gaps >= LEADER_LEAST])
    return tuple(map(np.concatenate, zip(_off_segment(start, end, asker, gaps), middle, strict=True)))  # type: ignore


def _off_point(point: complex, asker: Asker, gaps: Any) -> tuple[Any, Any, Any, Any]:
    half = asker.half
    # The corner or the edge of the box that looks at the point slides with the direction.
    hold = _HOLDS[0] * half.real + 1j * _HOLDS[1] * half.imag
    centres = point + gaps[:, None] * _WAYS + hold
    if asker.toward:
        dislike = np.min([3.0 * _apart(wish) / np.pi + 0.3 * rank for rank, wish in enumerate(asker.toward)], axis=0)
    else:
        dislike = 0.5 * _apart(_LIKED) / np.pi
    around = np.broadcast_to(gaps[:, None], centres.shape)
    return centres.ravel(), (around + dislike).ravel(), np.full(centres.size, point), around.ravel()


def _off_segment(start: complex, end: complex, asker: Asker, gaps: Any) -> tuple[Any, Any, Any, Any]:
    side = (end - start) / abs(end - start) * 1j
    sides = np.array((side, -side))
    liked = page_direction(asker.toward[0] if asker.toward else _LIKED)
    dislike = 0.4 * (1.0 - (sides * liked.conjugate()).real)[:, None] + 2.0 * np.abs(_SHARES - 0.5)
    off = gaps + abs(side.real) * asker.half.real + abs(side.imag) * asker.half.imag
    foot = start + _SHARES * (end - start)
    centres = foot + off[:, None, None] * sides[:, None]
    around = np.broadcast_to(gaps[:, None, None], centres.shape)
    return centres.ravel(), (around + dislike).ravel(), np.broadcast_to(foot, centres.shape).ravel(), around.ravel()


def _apart(wish: float) -> Any:
    return np.abs(np.angle(np.exp(1j * (_ANGLES - wish))))


def _held(off: Any, half: Any) -> Any:
    """From a foot to the nearest of a box along one axis."""
    return np.where(np.abs(off) <= half, 0.0, off - np.sign(off) * half)


def _turn(a: Any, b: Any) -> Any:
    return a.real * b.imag - a.imag * b.real


def _near(one: Box, other: Box, space: float) -> bool:
    return (
        one.left - space < other.right
        and other.left < one.right + space
        and one.top - space < other.bottom
        and other.top < one.bottom + space
    )


def _cross(one: Segment, other: Segment) -> bool:
    """Whether two segments cross between their ends."""
    (a, b), (c, d) = one, other
    return bool(_turn(b - a, c - a) * _turn(b - a, d - a) < 0 and _turn(d - c, a - c) * _turn(d - c, b - c) < 0)


def _separated(centres: Any, half: Any, segments: Any) -> Any:
    """Whether the normal of a segment separates it from a box (of centre and half size); the axes of the box are the
    caller's to check."""
    start = segments[..., 0]
    along = segments[..., 1] - start
    off = centres - start
    distance = np.abs(_turn(along, off))
    return distance > half.real * np.abs(along.imag) + half.imag * np.abs(along.real)


def _reach(segments: Any) -> tuple[Any, Any]:
    """Least and greatest corner of the box around each segment."""
    a, b = segments[:, 0], segments[:, 1]
    return (
        np.minimum(a.real, b.real) + 1j * np.minimum(a.imag, b.imag),
        np.maximum(a.real, b.real) + 1j * np.maximum(a.imag, b.imag),
    )


def _ends(mark: Mark) -> Segment:
    """Ends of a mark, a point being both, to a thousandth of a millimetre, so that coincident marks are equal."""
    start, end = mark if isinstance(mark, tuple) else (mark, mark)
    return complex(round(start.real, 3), round(start.imag, 3)), complex(round(end.real, 3), round(end.imag, 3))
