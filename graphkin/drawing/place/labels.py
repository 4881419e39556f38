"""What a label is and what stands in its way, the places around its mark where it could stand, ring by ring, what each
costs in looks, and whether labels at two of them are in each other's way.

The places of all labels are made together, as arrays.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple, TypeAlias, TypeVar

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Line, Run, Segment, Text, page_direction
from graphkin.drawing.place.intersections import Flags, Floats, Indices, Points
from graphkin.plane import cross

__all__ = [
    "LEADER_FROM", "LEADER_LEAST", "LEADER_SPACE", "LED_RINGS", "LOTS", "RINGS", "Candidates", "Columns", "Label",
    "LabelForms", "LabelPosition", "LabelPositions", "LabelRequest", "LabelRequests", "Mark", "Obstacles", "Placed",
    "candidates", "ends", "leader_forms", "led_candidates",
]  # fmt: skip

LOTS = (0, 40, 120, 240, 720)
"""First places of the lots in which places are judged, the cheapest first."""
T = TypeVar("T", float, Floats)

LEADER_SPACE = 0.25  # mm between a leader and the box of any other label
Mark: TypeAlias = complex | Segment
"""What a label names: a point, or the line between two."""

_Parts: TypeAlias = tuple[Points, Floats, Points, Floats, Indices]

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
class LabelRequest:
    """What a label asks for: places around a mark of these ends (equal for a point), for a box of half this width and
    height (as a complex number), in its liked directions (rad)."""

    start: complex
    end: complex
    half: complex
    toward: tuple[float, ...]

    @property
    def is_point(self) -> bool:
        return self.start == self.end


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

    def request(self, box: Box) -> LabelRequest:
        """What it asks for with a box of this size."""
        return LabelRequest(*ends(self.mark), complex(box.width, box.height) / 2, self.toward)


@dataclass(frozen=True)
class Obstacles:
    """Segments, and areas as upright boxes, on the page in mm; ``writing`` are those of the areas that leaders may not
    run over either, ``thick`` those of the solid segments that they are to go round: vectors and links, ``vectors``
    those of these beyond which no letter of a point is to stand without a leader."""

    solid: tuple[Segment, ...] = ()
    dashed: tuple[Segment, ...] = ()
    areas: tuple[Box, ...] = ()
    writing: tuple[Box, ...] = ()
    thick: tuple[Segment, ...] = ()
    vectors: tuple[Segment, ...] = ()

    def __add__(self, other: Obstacles) -> Obstacles:
        return Obstacles(
            self.solid + other.solid,
            self.dashed + other.dashed,
            self.areas + other.areas,
            self.writing + other.writing,
            self.thick + other.thick,
            self.vectors + other.vectors,
        )


class LabelRequests:
    """What some labels ask for, as arrays: ends of marks, half sizes of boxes, whether the mark is a point, for points
    the cost of each direction, for segments the liked one."""

    def __init__(self, requests: Sequence[LabelRequest]) -> None:
        self.start = np.array([one.start for one in requests])
        self.end = np.array([one.end for one in requests])
        self.half = np.array([one.half for one in requests])
        self.is_point = self.start == self.end
        self.dislikes = np.array([_dislike(one.toward if one.is_point else ()) for one in requests])
        self.liked = np.array([page_direction(one.toward[0] if one.toward else _LIKED) for one in requests])


@dataclass(frozen=True)
class Candidates:
    """Places of several labels, as arrays of one length: centres of boxes, costs (mm), feet on the marks, distances
    from them (mm), and which of the labels asked for it."""

    centres: Points
    costs: Floats
    feet: Points
    gaps: Floats
    owners: Indices

    def at(self, kept: Flags | Indices) -> Candidates:
        """Some of the places."""
        return Candidates(self.centres[kept], self.costs[kept], self.feet[kept], self.gaps[kept], self.owners[kept])

    def __add__(self, other: Candidates) -> Candidates:
        columns = zip(vars(self).values(), vars(other).values(), strict=True)
        return Candidates(*map(np.concatenate, columns))


def ends(mark: Mark) -> Segment:
    """Ends of a mark, a point being both, to a thousandth of a millimetre, so that coincident marks are equal."""
    start, end = mark if isinstance(mark, tuple) else (mark, mark)
    return complex(round(start.real, 3), round(start.imag, 3)), complex(round(end.real, 3), round(end.imag, 3))


def candidates(requests: LabelRequests, who: Indices, gaps: tuple[float, ...]) -> Candidates:
    """All places of some labels at some distances (mm) from their marks; owners are places in ``who``."""
    is_point = requests.is_point[who]
    points, segments = np.flatnonzero(is_point), np.flatnonzero(~is_point)
    parts = []
    if points.size:
        at = requests.start[who[points]]
        parts.append(_off_points(requests, who, points, at, gaps))
    if segments.size:
        parts.append(_off_segments(requests, who, segments, gaps))
        far = tuple(gap for gap in gaps if gap >= LEADER_LEAST)
        if far:
            # Far from a vector there is more room all round its middle than square to it.
            middles = (requests.start[who[segments]] + requests.end[who[segments]]) / 2
            parts.append(_off_points(requests, who, segments, middles, far))
    return Candidates(*map(np.concatenate, zip(*parts, strict=True)))


def led_candidates(requests: LabelRequests, who: Indices, rings: tuple[float, ...]) -> Candidates:
    """Further places of labels that want leaders, at some distances (mm): at more angles from a point, or from more
    places of a vector."""
    gaps = np.array(rings)[:, None]
    parts = []
    for i, label in enumerate(who):
        ways, shares = (_MANY_WAYS, _SHARES[:1]) if requests.is_point[label] else (_WAYS, _FEET)
        start, end, half = requests.start[label], requests.end[label], requests.half[label]
        hold = np.clip(1.6 * ways.real, -1, 1) * half.real + 1j * np.clip(1.6 * ways.imag, -1, 1) * half.imag
        feet = (start + shares * (end - start))[:, None, None]
        centres = feet + gaps * ways + hold
        costs = gaps + 2.0 * np.abs(shares - 0.5)[:, None, None]
        columns = [np.broadcast_to(column, centres.shape).ravel() for column in (centres, costs, feet, gaps)]
        parts.append((*columns, np.full(centres.size, i)))
    return Candidates(*map(np.concatenate, zip(*parts, strict=True)))


def _off_points(
    requests: LabelRequests, who: Indices, some: Indices, points: Points, gaps: tuple[float, ...]
) -> _Parts:
    """Columns of places all round some points, at an angle each."""
    rings, angles, away, hold_x, hold_y = _around(gaps)
    half, at = requests.half[who[some]][:, None], points[:, None]
    centres = at + away + hold_x * half.real + 1j * (hold_y * half.imag)
    costs = rings + requests.dislikes[who[some]].take(angles, axis=1)
    return centres.ravel(), costs.ravel(), points.repeat(len(rings)), *_rings_of(rings, some)


def _off_segments(requests: LabelRequests, who: Indices, some: Indices, gaps: tuple[float, ...]) -> _Parts:
    """Columns of places on both sides of some segments, square to them."""
    rings, side, share, dear = _along(gaps)
    start, end, half, liked = (
        column[who[some]] for column in (requests.start, requests.end, requests.half, requests.liked)
    )
    way = end - start
    normal = 1j * way / np.abs(way)
    sides = normal[:, None] * _SIDES
    disliked = 0.4 * (1.0 - (sides * liked.conj()[:, None]).real)
    reach = np.abs(normal.real) * half.real + np.abs(normal.imag) * half.imag
    feet = (start[:, None] + _SHARES * way[:, None]).take(share, axis=1)
    centres = feet + (rings + reach[:, None]) * sides.take(side, axis=1)
    costs = rings + disliked.take(side, axis=1) + dear
    return centres.ravel(), costs.ravel(), feet.ravel(), *_rings_of(rings, some)


def _rings_of(rings: Floats, some: Indices) -> tuple[Floats, Indices]:
    """The ring of each place, and who asked for it."""
    return np.broadcast_to(rings, (len(some), len(rings))).ravel(), some.repeat(len(rings))


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


class LabelForms:
    """Linear forms of places, of one label or of several: in columns 1 and the middles of boxes, feet and tips of
    leaders; and of each leader, by factor, form and place, what `leader_forms` says."""

    def __init__(self, columns: Columns) -> None:
        self.columns = columns

    @cached_property
    def middles(self) -> Floats:
        return _points(self.columns.centres)

    @cached_property
    def feet(self) -> Floats:
        return _points(self.columns.feet)

    @cached_property
    def tips(self) -> Floats:
        return _points(self.columns.tips)

    @cached_property
    def leaders(self) -> tuple[Floats, Floats]:
        _, x, y = self.feet
        _, tip_x, tip_y = self.tips
        distances, reaches = np.empty((2, 3, 3, len(x)))
        for forms, found in zip((distances, reaches), leader_forms(x, y, tip_x - x, tip_y - y), strict=True):
            for k, factor in enumerate(found):
                forms[k % 3, k // 3] = factor
        return distances, reaches


def leader_forms(x: T, y: T, along_x: T, along_y: T) -> tuple[tuple[T | float, ...], tuple[T | float, ...]]:
    """For a leader from a foot along a way: the distances of a point from its middle, across and down, and from its
    line, each as factors of 1 and the point, the last times its length; and below what distances it meets a box there,
    as factors of 1, half width and half height.  No way meets none."""
    wide, high, one, none = abs(along_x), abs(along_y), 1.0, 0.0
    distances = (
        -x - along_x / 2, one, none, -y - along_y / 2, none, one, along_y * x - along_x * y, -along_y, along_x
    )  # fmt: skip
    reaches = (
        wide / 2 + LEADER_SPACE, one, none, high / 2 + LEADER_SPACE, none, one, (wide + high) * LEADER_SPACE, high, wide
    )  # fmt: skip
    return distances, reaches


class LabelPositions:
    """Places of one label, whose box has a half size, cheapest first: a part of many places, of which the forms are
    known."""

    def __init__(self, half: complex, columns: Columns, forms: LabelForms | None = None, first: int = 0) -> None:
        self.half, self.columns, self.costs = half, columns, columns.costs
        self.forms, self.first = forms or LabelForms(columns), first
        self._made: dict[int, LabelPosition] = {}

    def __len__(self) -> int:
        return len(self.costs)

    @cached_property
    def _listed(self) -> tuple[list[complex], list[float], list[complex], list[complex], list[bool]]:
        centres, costs, feet, tips, led = self.columns
        return centres.tolist(), costs.tolist(), feet.tolist(), tips.tolist(), led.tolist()

    @cached_property
    def first_led(self) -> int:
        """The index of the first place that has a leader."""
        return int(self.columns.led.argmax()) if self.columns.led.any() else len(self)

    def middles(self, first: int, last: int) -> Floats:
        """1 and the middles of the boxes from ``first`` to ``last``, in columns."""
        return self.forms.middles[:, self.first + first : self.first + last]

    def position(self, index: int) -> LabelPosition:
        """The place of an index."""
        made = self._made.get(index)
        if made is None:
            centres, costs, feet, tips, led = self._listed
            centre, half, leader = centres[index], self.half, None
            left, top, right, bottom = reach = (
                centre.real - half.real, centre.imag - half.imag, centre.real + half.real, centre.imag + half.imag
            )  # fmt: skip
            if led[index]:
                leader = foot, _ = feet[index], tips[index]
                x, y = foot.real, foot.imag
                reach = min(left, x), min(top, y), max(right, x), max(bottom, y)
            made = LabelPosition(left, top, right, bottom, costs[index], leader, reach)
            self._made[index] = made
        return made

    def cheaper(self, cost: float) -> int:
        """How many cost less."""
        return int(np.searchsorted(self.costs, cost))

    def lots(self, count: int) -> Iterator[tuple[int, int]]:
        """First and end of the lots that hold the first ``count``."""
        for first, last in zip(LOTS, (*LOTS[1:], len(self)), strict=True):
            if first < count:
                yield first, min(last, len(self))


def _crosses(one: Segment, other: Segment) -> bool:
    """As `crosses`, for two lines."""
    (a, b), (c, d) = one, other
    apart = cross(b - a, c - a) * cross(b - a, d - a)
    return apart < 0 and cross(d - c, a - c) * cross(d - c, b - c) < 0


def _points(points: Points) -> Floats:
    """1 and the points, across and down, in columns."""
    return np.array((np.ones(len(points)), points.real, points.imag))
