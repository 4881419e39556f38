"""What a label is, the places around its mark where it could stand, ring by ring, what each costs in looks, which of
them the drawing leaves free, and whether labels at two of them are in each other's way.

All places of all labels are made and judged together as arrays: where ink is, cell by cell, tells of most boxes that
they meet it, upright boxes what is near, the separating axes of box and segment what touches.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Line, Run, Segment, Text, page_direction
from graphkin.drawing.place.obstacles import (
    Flags,
    Floats,
    Indices,
    Obstacles,
    Points,
    crosses,
    joined,
    near,
    separated,
    sides,
    sides_around,
    touching,
)
from graphkin.drawing.text import box_about

__all__ = [
    "FORBIDDEN", "RINGS", "TANGLED", "InkRaster", "Label", "LabelPanel", "LabelPosition", "LabelPositions", "Mark",
    "Placed", "least_cost", "meeting",
]  # fmt: skip

LOTS = (0, 40, 120, 240, 720)
"""First places of the lots in which places are judged, the cheapest first."""

LEADER_SPACE = 0.25  # mm between a leader and the box of any other label
Mark: TypeAlias = complex | Segment
"""What a label names: a point, or the line between two."""

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
# What a leader that runs over a vector is tried with further: places of its foot, ways, distances.
_FEET = np.array((0.35, 0.65, 0.2, 0.8, 0.08, 0.92, 0.5, 0.14, 0.86, 0.28, 0.72, 0.97, 1.0))
_MANY_WAYS = np.exp(-2j * np.pi * np.arange(48) / 48)
LED_RINGS = ((2.4, 3.6, 5.0, 6.8), (9.0, 11.5, 14.5, 18.0, 22.0, 27.0, 32.0, 38.0))
"""Distances that are tried for such a leader, mm: the further ones where the nearer give it no place."""
_SIDES = np.array((1.0, -1.0))
# Where nothing is liked, up and to the right reads best (Imhof, Positioning names on maps, 1975).
_LIKED = math.radians(40)


@dataclass(frozen=True)
class Label:
    """A text that wants a place.

    Parameters
    ----------
    text : what to write; its ``at`` is not used
    mark : a point, or the two ends of a segment, that it names
    toward : directions (rad, counter-clockwise) from a point in the order of liking; for a segment the side whose
        normal is nearest to the first of them is liked
    rank : one of rank 0 must stand, others are given up where there is no room, the highest rank first
    key : what may stand in its place in a crowd, the text being listed elsewhere
    between : the letters of the ends of its vector, by which a list can tell it in a crowd where not even the key has
        room; in the notation of symbols, empty where the ends have none
    """

    text: Text
    mark: Mark
    toward: tuple[float, ...] = ()
    rank: int = 0
    key: Text | None = None
    between: str = ""

    @classmethod
    def of(
        cls, runs: tuple[Run, ...], mark: Mark, id: str = "", *, colour: str = "#000000", rank: int = 0,
        toward: tuple[float, ...] = (), classes: tuple[str, ...] = (), step: int | None = None,
        since: int | None = None, key: Text | None = None, between: str = "",
    ) -> Label:  # fmt: skip
        """A label of some runs in the class "label" and further ones; ``id``, ``step`` and ``since`` are the text's."""
        text = Text(0j, runs, "start", colour, id, ("label", *classes), step, since)
        return cls(text, mark, toward, rank, key, between)


class LabelRequests:
    """What some labels ask for, as arrays: ends of marks, half sizes of boxes, whether the mark is a point, for points
    the cost of each direction, for segments the liked one."""

    def __init__(self, asked: Sequence[tuple[Label, Box]]) -> None:
        self.marks = [ends(label.mark) for label, _ in asked]
        self.start, self.end = np.array(self.marks).reshape(-1, 2).T.copy()
        self.half = np.array([complex(box.width, box.height) / 2 for _, box in asked])
        self.is_point = self.start == self.end
        liked = [label.toward for label, _ in asked]
        self.dislikes = np.array(
            [_dislike(toward if point else ()) for toward, point in zip(liked, self.is_point.tolist(), strict=True)]
        )
        self.liked = np.array([page_direction(toward[0] if toward else _LIKED) for toward in liked])


class Places(NamedTuple):
    """Places of several labels, as arrays of one length: centres of boxes, costs (mm), feet on the marks, tips of
    leaders (the feet where there is none), distances from the marks (mm), and the requests for which they are."""

    centres: Points
    costs: Floats
    feet: Points
    tips: Points
    gaps: Floats
    owners: Indices

    @classmethod
    def of(cls, centres: Points, costs: Floats, feet: Points, gaps: Floats, owners: Indices) -> Places:
        """Places without leaders from columns of any shapes that go with that of the centres."""
        columns = costs, feet, feet, gaps, owners
        whole: Any = (np.broadcast_to(column, centres.shape).ravel() for column in columns)
        return cls(centres.ravel(), *whole)

    def picked(self, some: Flags | Indices | slice) -> Places:
        """Some of the places."""
        columns: Any = (column[some] for column in self)
        return Places(*columns)


def stacked(tables: Iterable[Places]) -> Places:
    """The places of several tables, one after the other."""
    columns: Any = map(np.concatenate, zip(*tables, strict=True))
    return Places(*columns)


def ends(mark: Mark) -> Segment:
    """Ends of a mark, a point being both, to a thousandth of a millimetre, so that coincident marks are equal."""
    start, end = mark if isinstance(mark, tuple) else (mark, mark)
    return complex(round(start.real, 3), round(start.imag, 3)), complex(round(end.real, 3), round(end.imag, 3))


def candidates(requests: LabelRequests, who: Indices, gaps: tuple[float, ...]) -> Places:
    """All places for some requests at some distances (mm) from their marks."""
    is_point = requests.is_point[who]
    points, segments = who[is_point], who[~is_point]
    parts = []
    if points.size:
        parts.append(_off_points(requests, points, requests.start[points], gaps))
    if segments.size:
        parts.append(_off_segments(requests, segments, gaps))
        far = tuple(gap for gap in gaps if gap >= LEADER_LEAST)
        if far:
            # Far from a vector there is more room all round its middle than square to it.
            middles = (requests.start[segments] + requests.end[segments]) / 2
            parts.append(_off_points(requests, segments, middles, far))
    return stacked(parts)


def led_candidates(requests: LabelRequests, who: Indices, rings: tuple[float, ...]) -> Places:
    """Further places for requests that want leaders, at some distances (mm): at more angles from a point, or from more
    places of a vector."""
    gaps = np.array(rings)[:, None]
    parts = []
    for request in who:
        ways, shares = (_MANY_WAYS, _SHARES[:1]) if requests.is_point[request] else (_WAYS, _FEET)
        start, end, half = requests.start[request], requests.end[request], requests.half[request]
        hold = np.clip(1.6 * ways.real, -1, 1) * half.real + 1j * np.clip(1.6 * ways.imag, -1, 1) * half.imag
        feet = (start + shares * (end - start))[:, None, None]
        costs = gaps + 2.0 * np.abs(shares - 0.5)[:, None, None]
        parts.append(Places.of(feet + gaps * ways + hold, costs, feet, gaps, request))
    return stacked(parts)


def _off_points(requests: LabelRequests, who: Indices, points: Points, gaps: tuple[float, ...]) -> Places:
    """Places all round some points, at an angle each."""
    rings, angles, away, hold_x, hold_y = _around(gaps)
    half, at = requests.half[who][:, None], points[:, None]
    centres = at + away + hold_x * half.real + 1j * (hold_y * half.imag)
    return Places.of(centres, rings + requests.dislikes[who].take(angles, axis=1), at, rings, who[:, None])


def _off_segments(requests: LabelRequests, who: Indices, gaps: tuple[float, ...]) -> Places:
    """Places on both sides of some segments, square to them."""
    rings, side, share, dear = _along(gaps)
    columns = (requests.start, requests.end, requests.half, requests.liked)
    start, end, half, liked = (column[who][:, None] for column in columns)
    way = end - start
    normal = 1j * way / np.abs(way)
    sides = normal * _SIDES
    disliked = 0.4 * (1.0 - (sides * liked.conj()).real)
    reach = np.abs(normal.real) * half.real + np.abs(normal.imag) * half.imag
    feet = (start + _SHARES * way).take(share, axis=1)
    centres = feet + (rings + reach) * sides.take(side, axis=1)
    return Places.of(centres, rings + disliked.take(side, axis=1) + dear, feet, rings, who[:, None])


@lru_cache(maxsize=64)
def _around(gaps: tuple[float, ...]) -> tuple[Floats, Indices, Points, Floats, Floats]:
    """Ring and angle of each place around a point, far from it only every second, in turn; how far off it is, and where
    the box is held."""
    rings = np.array(gaps)
    sparse = _SOME[0] ^ (np.arange(len(gaps)) % 2 == 1)[:, None]
    ring, angle = np.nonzero((rings < LEADER_FROM)[:, None] | sparse)
    return rings[ring], angle, rings[ring] * _WAYS[angle], _HOLDS[0][angle], _HOLDS[1][angle]


@lru_cache(maxsize=64)
def _along(gaps: tuple[float, ...]) -> tuple[Floats, Indices, Indices, Floats]:
    """Ring, side and share of each place beside a segment, and what the share costs."""
    rings = np.array(gaps)
    near = (rings < LEADER_FROM)[:, None, None] | _SOME[1]
    ring, side, share = np.nonzero(np.broadcast_to(near, (len(gaps), 2, len(_SHARES))))
    return rings[ring], side, share, 2.0 * np.abs(_SHARES - 0.5)[share]


@lru_cache(maxsize=512)
def _dislike(toward: tuple[float, ...]) -> Floats:
    """What each angle costs for liked directions."""
    if not toward:
        return 0.5 * _apart(_LIKED) / np.pi
    least: Floats = np.min([3.0 * _apart(liked) / np.pi + 0.3 * rank for rank, liked in enumerate(toward)], axis=0)
    return least


def _apart(liked: float) -> Floats:
    away: Floats = np.abs((_ANGLES - liked + np.pi) % (2 * np.pi) - np.pi)
    return away


class LabelPosition(NamedTuple):
    """A place for a label: the middle of its box and half its size (mm), what it costs in looks (mm), and its leader
    from mark to box."""

    centre: complex
    half: complex
    cost: float
    leader: Segment | None

    @property
    def box(self) -> Box:
        low, high = self.centre - self.half, self.centre + self.half
        return Box(low.real, low.imag, high.real, high.imag)

    @property
    def forms(self) -> tuple[complex, complex, complex, complex]:
        """Middle, half size, foot and tip, which is the foot where there is no leader."""
        return self.centre, self.half, *(self.leader or (0j, 0j))


def meeting(ones: Points, others: Points, space: complex) -> Flags:
    """Which of some positions, in rows, meet which others, in columns: their boxes come nearer than a space (mm, across
    and down), or the leader of one runs over the box of the other, or nearly, or crosses its leader.

    Positions come as arrays of shape (4, n): middles, half sizes, feet and tips of leaders.
    """
    centres, half, feet, tips = ones[:, :, None]
    its_centres, its_half, its_feet, its_tips = others
    its_reach = its_half + space
    # copies lie side by side in memory, which halves the time
    over: Flags = np.abs(centres.real - its_centres.real.copy()) < half.real + its_reach.real.copy()
    over &= np.abs(centres.imag - its_centres.imag.copy()) < half.imag + its_reach.imag.copy()
    rows, columns = np.flatnonzero(feet != tips), np.flatnonzero(its_feet != its_tips)
    if rows.size:
        over[rows] |= _under(feet[rows], tips[rows], its_centres, its_half)
    if columns.size:
        its_feet, its_tips = its_feet[columns], its_tips[columns]
        over[:, columns] |= _under(its_feet, its_tips, centres, half)
        if rows.size:
            over[np.ix_(rows, columns)] |= crosses(feet[rows], tips[rows], its_feet, its_tips)
    return over


def _under(feet: Points, tips: Points, centres: Points, half: Points) -> Flags:
    """Over which boxes leaders run, or nearly."""
    along = tips - feet
    middles, half = feet + along / 2, half + LEADER_SPACE * (1 + 1j)
    x, y = centres.real - middles.real, centres.imag - middles.imag
    along_x, along_y, wide, high = along.real.copy(), along.imag.copy(), half.real.copy(), half.imag.copy()
    under: Flags = np.abs(x) < wide + np.abs(along_x) / 2
    under &= np.abs(y) < high + np.abs(along_y) / 2
    under &= np.abs(along_x * y - along_y * x) < wide * np.abs(along_y) + high * np.abs(along_x)
    return under


@dataclass(frozen=True)
class Placed:
    """A label at its place: the text, its box, and the leader that ties it to its mark where it needs one.

    ``clear`` is False where no place without a fault was found; ``keyed`` says that its key stands for it.
    """

    text: Text
    box: Box
    leader: Line | None = None
    clear: bool = True
    keyed: bool = False


class LabelPositions:
    """Places of one label, whose box has a half size, cheapest first."""

    def __init__(self, half: complex, places: Places) -> None:
        self.half, self.places, self.costs = half, places, places.costs

    def __len__(self) -> int:
        return len(self.costs)

    @cached_property
    def forms(self) -> Points:
        """Middles, half sizes, feet and tips, as `meeting` wants them."""
        half = np.full(len(self), self.half)
        return np.array((self.places.centres, half, self.places.feet, self.places.tips))

    def position(self, index: int) -> LabelPosition:
        """The place of an index."""
        centre, foot, tip = (complex(z[index]) for z in (self.places.centres, self.places.feet, self.places.tips))
        return LabelPosition(centre, self.half, float(self.costs[index]), None if foot == tip else (foot, tip))

    def cheaper(self, cost: float) -> int:
        """How many cost less."""
        return int(np.searchsorted(self.costs, cost))

    def lots(self, count: int) -> Iterator[tuple[int, int]]:
        """First and end of the lots that hold the first ``count``."""
        for first, last in zip(LOTS, (*LOTS[1:], len(self)), strict=True):
            if first < count:
                yield first, min(last, len(self))


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
        lines, step = _stations(height)
        low = start[:areas][lines] + 1j * step * height[lines]
        width = (end - start).real[:areas][lines]
        start, end = np.concatenate((low, start[areas:])), np.concatenate((low + width, end[areas:]))
        lines, step = _stations(end - start)
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


def _stations(ways: Points | Floats) -> tuple[Indices, Floats]:
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
    """A panel with what is drawn on it and all marks, which is asked for positions of labels, and of keys in their
    place, ring by ring.  A request is the number of a label, or one behind them for the key of one."""

    def __init__(self, labels: Sequence[Label], panel: Box, obstacles: Obstacles, marks: Sequence[Mark]) -> None:
        self.labels, self.panel = labels, panel
        self.texts = [label.text for label in labels]
        self.keys: dict[int, int] = {}  # the request for the key of a label
        self.found: dict[int, LabelPositions] = {}
        self.seen = [0] * len(labels)  # rings looked at
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
        distinct = list(dict.fromkeys(map(ends, (*(label.mark for label in labels), *marks))))
        self.index = {pair: i for i, pair in enumerate(distinct)}
        self.mark_start, self.mark_end = np.array(distinct, dtype=complex).reshape(-1, 2).T.copy()
        self.mark_reach = sides_around(self.mark_start, self.mark_end)
        self.mark_is_point = self.mark_start == self.mark_end
        self._ask()

    def _ask(self) -> None:
        """Take up the requests of all texts that there are."""
        labels = [*self.labels, *(self.labels[i] for i in self.keys)]
        self.boxes = [box_about(text.runs) for text in self.texts]
        self.requests = LabelRequests([*zip(labels, self.boxes, strict=True)])
        self.own_mark = np.array([self.index[mark] for mark in self.requests.marks], dtype=int)

    def ask_for_keys(self, some: Sequence[int]) -> range:
        """Let keys of some labels want places too; returns their requests."""
        requests = range(len(self.texts), len(self.texts) + len(some))
        for i in some:
            text, key = self.labels[i].text, self.labels[i].key
            assert key is not None
            self.texts.append(replace(key, id=text.id, classes=("label", *key.classes), since=text.since))
        self.keys |= zip(some, requests, strict=True)
        self._ask()
        return requests

    def __getitem__(self, request: int) -> LabelPositions:
        """The places of a request; those of a key, which may never be in question, are looked for here."""
        if request not in self.found:
            self._find(candidates(self.requests, np.array([request]), RINGS), [request])
        return self.found[request]

    def look(self, some: Sequence[int], last: int) -> None:
        """Look for places in the rings up to ``last`` that some labels have not yet seen."""
        for first in sorted({self.seen[i] for i in some if self.seen[i] < last}):
            who = [i for i in some if self.seen[i] == first]
            self._find(candidates(self.requests, np.array(who), RINGS[first:last]), who)
            for i in who:
                self.seen[i] = last

    def look_further(self, some: Sequence[int], rings: tuple[float, ...]) -> None:
        """Look for places of some requests with leaders in further rings (mm)."""
        self._find(led_candidates(self.requests, np.array(some), rings), some)

    def look_everywhere(self, some: Sequence[int]) -> None:
        """Look for places of some requests in all rings, and for further ones."""
        if some:
            who = np.array(some)
            led = led_candidates(self.requests, who, sum(LED_RINGS, ()))
            self._find(stacked((candidates(self.requests, who, RINGS), led)), some)

    def struck(self, place: LabelPosition) -> bool:
        """Whether a dashed line runs through a place."""
        if place.cost <= DASHED_COST:
            return False
        half = place.half + complex(CLEARANCE, CLEARANCE)
        _, what = self._touched(np.array([place.centre]), np.array([half]), len(self.start))
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

    def _find(self, places: Places, some: Sequence[int]) -> None:
        """Add those of some places that have no fault to those that are known of the requests."""
        half = self.requests.half[places.owners]
        clear = half + complex(CLEARANCE, CLEARANCE)
        free = ~self._outside(places.centres, half)
        if len(half) * self.solid > MANY:
            free &= ~self.ink.meets(places.centres - clear, places.centres + clear)
        kept = free.nonzero()[0]
        places, half, clear = places.picked(kept), half[kept], clear[kept]
        which, what = self._touched(places.centres, clear, len(self.start))
        np.add.at(places.costs, which[what >= self.solid], DASHED_COST)
        led = self._led(places, half)
        free = ~led | (places.gaps >= LEADER_LEAST)
        free[which[what < self.solid]] = False
        kept = free.nonzero()[0]
        places, led = places.picked(kept), led[kept]
        self._charge_beyond(places, half[kept], led)
        places = stacked((*(self.found[i].places for i in some if i in self.found), self._led_to(places, led)))
        order = np.lexsort((places.costs, places.owners))
        places = places.picked(order[places.costs[order] < FORBIDDEN])
        bounds = (np.searchsorted(places.owners, some, side) for side in ("left", "right"))
        for i, first, last in zip(some, *bounds, strict=True):
            self.found[i] = LabelPositions(complex(self.requests.half[i]), places.picked(slice(first, last)))

    def everywhere(self, request: int) -> tuple[LabelPositions, Indices]:
        """All places of all rings for one request, and the number of faults of each."""
        places = candidates(self.requests, np.array([request]), RINGS)
        half = self.requests.half[places.owners]
        faults = OUTSIDE * self._outside(places.centres, half).astype(int)
        np.add.at(faults, self._touched(places.centres, half + complex(CLEARANCE, CLEARANCE), self.solid)[0], 1)
        places = self._led_to(places, self._led(places, half))
        order = np.argsort(places.costs, kind="stable")
        return LabelPositions(complex(half[0]), places.picked(order)), faults[order]

    def _led_to(self, places: Places, led: Flags) -> Places:
        """Places with the tips of the leaders of those that need one, which then cost more."""
        some = led.nonzero()[0]
        if not some.size:
            return places
        centres, feet, owners = places.centres[some], places.feet[some], places.owners[some]
        off, half = centres - feet, self.requests.half[owners]
        way = _held(off.real, half.real) + 1j * _held(off.imag, half.imag)
        length = np.maximum(np.abs(way), 1e-9)
        tips = places.feet.copy()
        tips[some] = to = feet + way * np.maximum(0.0, 1.0 - LEADER_GAP / length)
        start = feet + way / length * FOOT_REACH
        nearest = np.minimum(np.abs(self.requests.start[owners] - feet), np.abs(self.requests.end[owners] - feet))
        places.costs[some] += LEADER_COST + CROSSED_COST * self._crossed(feet, start, to, self.weights)
        places.costs[some] += END_COST * (~self.requests.is_point[owners] & (nearest < NEAR_END))
        return places._replace(tips=tips)

    def _charge_beyond(self, places: Places, half: Points, led: Flags) -> None:
        """Let places of points cost more that have no leader though a vector runs between."""
        if not len(self.vectors[0]):
            return
        some = (~led & (places.gaps > BESIDE) & self.requests.is_point[places.owners]).nonzero()[0]
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

    def _led(self, places: Places, half: Points) -> Flags:
        """Which places need a leader: far ones, and those about as near to another mark of the same kind as to their
        own."""
        led: Flags = places.gaps > LEADER_FROM
        close = (~led).nonzero()[0]
        centres, own = places.centres[close], self.own_mark[places.owners[close]]
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
