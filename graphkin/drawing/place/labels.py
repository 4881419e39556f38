"""Labels: the possible places around a mark, ring by ring, the cost of each in looks, the places that the drawing
leaves free, and the conflicts of labels at two places.

All places of all labels are made and judged together as arrays: upright boxes find neighbours, the separating axes of
box and segment contacts.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Run, Segment, Text, page_direction
from graphkin.drawing.place.obstacles import (
    Flags,
    Floats,
    Indices,
    Obstacles,
    Points,
    crosses,
    in_rows,
    near,
    segments_of,
    separated,
    sides,
    sides_around,
    touching,
)
from graphkin.drawing.text import box_about
from graphkin.words.symbols import Words

Mark: TypeAlias = complex | Segment
"""What a label names: a point, or the line between two."""

# Distances of the box from its mark, mm: near ones, and such as want a leader.
NEAR, FAR = (0.7, 1.5, 2.4, 3.6, 5.0), (6.8, 9.0, 11.5, 14.5, 18.0, 22.0, 27.0)
FURTHER = (2.4, 3.6, 5.0, 6.8, 9.0, 11.5, 14.5, 18.0, 22.0, 27.0, 32.0, 38.0)
"""Distances tried for a leader round an obstacle."""
LEADER_LEAST = 2.0  # nearer to its mark a label has no room for a leader
WAYS = np.exp(-2j * np.pi * np.arange(48) / 48)
SQUARE = len(WAYS), len(WAYS) + 1  # the two ways square to a vector, which follow
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9)  # of a vector, where a name stands beside it
FEET = (0.35, 0.65, 0.2, 0.8, 0.08, 0.92, 0.5, 0.14, 0.86, 0.28, 0.72, 0.97, 1.0)  # and where leaders end
OFF_MIDDLE = 2.0  # mm that a place at the end of a vector costs more than one at its middle, twice
# Where nothing is liked, up and to the right reads best (Imhof, Positioning names on maps, 1975).
LIKED = math.radians(40)


def _grid(shares: Sequence[float], gaps: Sequence[float], directions: Sequence[int]) -> Floats:
    """Places with all of some feet (shares of a mark), distances (mm) and directions (indices), shape (3, places)."""
    return np.array([axis.ravel() for axis in np.meshgrid(shares, gaps, directions, indexing="ij")])


_ROUND = (
    _grid((0.5,), [gap for gap in NEAR if gap >= LEADER_LEAST], range(0, 48, 2)),
    _grid((0.5,), FAR[::2], range(0, 48, 4)), _grid((0.5,), FAR[1::2], range(2, 48, 4)),
)
_TIGHT = _grid((0.5,), [gap for gap in NEAR if gap < LEADER_LEAST], range(0, 48, 2))
# Where names of points and of vectors may stand, and where more places with leaders are looked for.
AROUND_POINT = np.hstack((_TIGHT, *_ROUND))
AROUND_VECTOR = np.hstack((*_ROUND, _grid(SHARES, NEAR, SQUARE), _grid(SHARES[:5], FAR, SQUARE)))
LED_FROM_POINT, LED_FROM_VECTOR = _grid((0.5,), FURTHER, range(48)), _grid(FEET, FURTHER, range(0, 48, 2))


@dataclass(frozen=True)
class Label:
    """A text that needs a place.

    Parameters
    ----------
    text : the text; its ``at`` is not used
    mark : the named point, or the two ends of the named segment
    toward : directions (rad, counter-clockwise) from a point in order of preference; for a segment the side with the
        normal nearest to the first is preferred
    rank : a label of rank 0 must be placed, others are given up without room, the highest rank first
    key : the text that may replace it in a crowd, with the label listed elsewhere
    between : the letters of its vector's ends, by which a list names it in a crowd without room for the key; in the
        notation of symbols, empty for ends without letters
    """

    text: Text
    mark: Mark
    toward: tuple[float, ...] = ()
    rank: int = 0
    key: Text | None = None
    between: Words = ""

    @classmethod
    def of(
        cls, runs: tuple[Run, ...], mark: Mark, id: str = "", *, colour: str = "#000000", rank: int = 0,
        toward: tuple[float, ...] = (), classes: tuple[str, ...] = (), step: int | None = None,
        since: int | None = None, key: Text | None = None, between: Words = "",
    ) -> Label:
        """A label of some runs in the class "label" and further ones; ``id``, ``step`` and ``since`` are the text's."""
        text = Text(0j, runs, "start", colour, id, ("label", *classes), step, since)
        return cls(text, mark, toward, rank, key, between)


class Places(NamedTuple):
    """Places of boxes, as arrays whose last dimension they are.

    forms : middles, half sizes, feet on the marks, tips of leaders (the feet without a leader), each with x and y in
        rows, shape (4, 2, places) (mm)
    costs : in looks (mm)
    gaps : distances from the marks (mm)
    bad : whether a dashed line runs through the box, or its leader crosses strokes that leaders should avoid
    owners : their requests
    """

    forms: Floats
    costs: Floats
    gaps: Floats
    bad: Flags
    owners: Indices

    def picked(self, some: Indices) -> Places:
        """Some of the places."""
        columns: Any = (column.take(some, axis=-1) for column in self)
        return Places(*columns)


NOWHERE, TOLD = 0, 1  # in place of a place's number: of labels given up, and named in a list
LEADER_SPACE = 0.25  # mm between a leader and the box of any other label


def outlined(forms: Floats, space: tuple[float, float]) -> Floats:
    """Forms of `Places`, followed by the lower and the higher corners of upright boxes, shape (20, 2, places) (mm).

    Four are of the rows of `intersections` (box with a space, across and down, leader, box with `LEADER_SPACE`,
    leader), four of its columns (box, box with `LEADER_SPACE`, leader, leader).  A missing leader is nowhere (nan).
    """
    middles, halves, feet, tips = forms
    led = (feet != tips).any(axis=0)
    outlines = np.empty((20, 2, forms.shape[2]))
    outlines[:4] = forms
    for sign, places in ((-1.0, (4, 12)), (1.0, (8, 16))):
        bound, (rows, columns) = np.minimum if sign < 0 else np.maximum, places
        outlines[rows] = middles + sign * (halves + np.array(space)[:, None])
        outlines[columns] = middles + sign * halves
        outlines[rows + 2] = outlines[columns + 1] = middles + sign * (halves + LEADER_SPACE)
        leader = np.where(led, bound(feet, tips), np.nan)
        outlines[rows + 1] = outlines[rows + 3] = outlines[columns + 2] = outlines[columns + 3] = leader
    return outlines


def intersections(rows: Floats, columns: Floats) -> Flags:
    """Whether labels, in rows, meet others, in columns, both as `outlined`: they come nearer than the space, or the
    leader of one runs over the box of the other, or nearly, or crosses its leader.  Nowhere (nan) is met by none."""
    near = rows[4:8, :, :, None] <= columns[16:20, :, None]
    near &= rows[8:12, :, :, None] >= columns[12:16, :, None]
    near = near[:, 0] & near[:, 1]
    met: Flags = near[0]
    pairs = (near[1:] > met).ravel().nonzero()[0]
    if pairs.size:
        # a row's leader over a column's box, a column's leader over a row's box, and both leaders
        first, last = pairs.searchsorted((met.size, 2 * met.size)).tolist()
        pairs %= met.size
        row = pairs // met.shape[1]
        column = pairs - row * met.shape[1]
        hit = np.empty(len(pairs), dtype=bool)
        if last:
            box_one, box_other = rows[:2].take(row[first:last], axis=2), columns[:2].take(column[:first], axis=2)
            led_one, led_other = rows[2:4].take(row[:first], axis=2), columns[2:4].take(column[first:last], axis=2)
            middles, halves = np.concatenate((box_other, box_one), axis=2)
            feet, tips = np.concatenate((led_one, led_other), axis=2)
            hit[:last] = ~separated(middles - feet, halves + LEADER_SPACE, tips - feet)
        if last < len(pairs):
            hit[last:] = crosses(rows[2:4].take(row[last:], axis=2), columns[2:4].take(column[last:], axis=2))
        met.ravel()[pairs[hit]] = True
    return met


LEADER_FROM = 5.0  # mm: a label further off than this has a leader
LEADER_GAP = 0.4  # mm between the end of a leader and the box of its label
CLEARANCE = 0.35  # between a label and any line or area, mm
NEARER = 1.2  # by so much a label is nearer to its own mark than to any other
# What a place costs beside its distance (mm): a leader, whatever the leader crosses, a dashed line under the label, a
# leader to a line that ends nearer than NEAR_END to a point at its end.
LEADER_COST, CROSSED_COST, DASHED_COST, END_COST = 4.0, 12.0, 110.0, 3.0
BESIDE, BEYOND_COST = 1.0, 6.0  # mm off its point, and what it costs there that a vector runs between without a leader
AREA_WEIGHT, THICK_WEIGHT = 25.0, 10.0  # of what a leader crosses, where a thin line counts 1
FORBIDDEN = 1e5
OUTSIDE = 100  # faults that leaving the panel counts for
FOOT_REACH = 0.45  # mm: what lies nearer to the foot of a leader is the mark itself
NEAR_END = 2.0


class LabelPanel:
    """A panel with its strokes and marks, and the places of labels and of their keys.

    A request is the number of a label, or a number after these for a label's key.  ``places`` are all that were found,
    behind two nowhere; ``numbers`` those of a request among them, the cheapest first.
    """

    def __init__(self, labels: Sequence[Label], panel: Box, obstacles: Obstacles, marks: Sequence[Mark]) -> None:
        self.labels, self.panel = labels, panel
        self.texts = [label.text for label in labels]
        self.keys: dict[int, int] = {}  # the request for the key of a label
        nowhere = np.full((4, 2, 2), np.nan), np.zeros(2), np.zeros(2), np.zeros(2, dtype=bool), np.full(2, -1)
        self.places, self.numbers = Places(*nowhere), dict[int, Indices]()
        writing, thick = set(obstacles.writing), set(obstacles.thick)
        areas = [area.grown(LEADER_SPACE) if area in writing else area for area in obstacles.areas]
        diagonals = tuple((complex(area.left, area.top), complex(area.right, area.bottom)) for area in areas)
        self.start, self.end = _ends(diagonals + obstacles.solid + obstacles.dashed)
        self.reach = sides_around(self.start, self.end)
        self.areas, self.solid = len(areas), len(areas) + len(obstacles.solid)
        self.vectors = _ends(obstacles.vectors)
        self.weights = np.array(
            [FORBIDDEN if area in writing else AREA_WEIGHT for area in obstacles.areas]
            + [THICK_WEIGHT if line in thick else 1.0 for line in obstacles.solid]
            + [1.0] * len(obstacles.dashed)
        )
        # Labels at the same place share one mark: coincident points are told apart by their letters.
        index: dict[Segment, int] = {}
        places = [index.setdefault(ends(mark), len(index)) for mark in (*(label.mark for label in labels), *marks)]
        self.marks, distinct = places[: len(labels)], [*index]
        self.mark_start, self.mark_end = _ends(distinct)
        self.mark_is_point = kind = (self.mark_start == self.mark_end).all(axis=0)
        self.mistakable = (kind[:, None] == kind) & ~np.eye(len(kind), dtype=bool)  # marks for each other
        self._ask()
        if labels:
            self._find(range(len(labels)), AROUND_POINT, AROUND_VECTOR)

    def _ask(self) -> None:
        """Add the requests of all texts."""
        labels = [*range(len(self.labels)), *self.keys]
        self.boxes = [box_about(text.runs) for text in self.texts]
        self.own = np.array([self.marks[i] for i in labels], dtype=int)
        self.half = np.array([(box.width, box.height) for box in self.boxes]).T / 2
        x, y = (self.mark_end - self.mark_start)[:, self.own]
        along = x + 1j * y
        square = 1j * along / np.where(self.mark_is_point[self.own], 1.0, np.abs(along))
        directions = np.hstack((np.broadcast_to(WAYS, (len(labels), len(WAYS))), np.outer(square, (1.0, -1.0))))
        self.ways, self.disliked = in_rows(directions), _disliked([self.labels[i].toward for i in labels], directions)

    def ask_for_keys(self) -> Mapping[int, int]:
        """Add requests for the keys of all labels that have one; returns them."""
        some = [i for i, label in enumerate(self.labels) if label.key is not None]
        self.keys = {i: len(self.labels) + k for k, i in enumerate(some)}
        for i in some:
            text, key = self.labels[i].text, self.labels[i].key
            assert key is not None
            self.texts.append(key._replace(id=text.id, classes=("label", *key.classes), since=text.since))
        self._ask()
        if some:
            self._find([*self.keys.values()], AROUND_POINT, AROUND_VECTOR)
        return self.keys

    def look_further(self, some: Sequence[int]) -> None:
        """Find more places for some requests, with leaders around obstacles."""
        if some:
            self._find(some, LED_FROM_POINT, LED_FROM_VECTOR)

    def _find(self, some: Sequence[int], around_points: Floats, around_vectors: Floats) -> None:
        """Add the faultless ones of some places to the known places of some requests."""
        first = len(self.places.costs)
        self.add(self._judged(self._around(some, around_points, around_vectors), keep=False)[0])
        costs, counts = self.places.costs, np.bincount(self.places.owners[first:], minlength=len(self.texts)).tolist()
        for i in sorted(some, key=lambda i: not self.mark_is_point[self.own[i]]):
            numbers = np.arange(first, first + counts[i])  # those of a request lie side by side
            first += counts[i]
            if i in self.numbers:
                numbers = np.concatenate((self.numbers[i], numbers))
            self.numbers[i] = numbers[costs[numbers].argsort(kind="stable")]

    def add(self, places: Places) -> None:
        """Add places to the table."""
        columns: Any = (np.concatenate(both, axis=-1) for both in zip(self.places, places, strict=True))
        self.places = Places(*columns)

    def _around(self, some: Sequence[int], around_points: Floats, around_vectors: Floats) -> Places:
        """Places of some requests around their marks, without leaders and obstacles.

        The corner or edge of a box that faces its foot slides with the direction; a box beside a vector touches a line
        along it.
        """
        requests = np.array(some, dtype=np.intp)
        is_point = self.mark_is_point[self.own[requests]]
        lots = (requests[is_point], around_points), (requests[~is_point], around_vectors)
        owners = np.concatenate([np.repeat(lot, pattern.shape[1]) for lot, pattern in lots])
        shares, gaps, turn = np.hstack([np.tile(pattern, len(lot)) for lot, pattern in lots])
        which = turn.astype(np.intp)
        mark, half = self.own.take(owners), self.half.take(owners, axis=1)
        direction = owners * self.ways.shape[2] + which
        along = self.ways.reshape(2, -1).take(direction, axis=1)
        feet = self.mark_start.take(mark, axis=1) + shares * (self.mark_end - self.mark_start).take(mark, axis=1)
        reach = along * half
        hold = np.minimum(np.maximum(1.6 * reach, -half), half)  # faster than clip
        middles = feet + gaps * along + np.where(which >= len(WAYS), np.abs(reach).sum(axis=0) * along, hold)
        costs = gaps + self.disliked.ravel().take(direction) + OFF_MIDDLE * np.abs(shares - 0.5)
        forms = np.stack((middles, half, feet, feet))
        return Places(forms, costs, gaps, np.zeros(len(gaps), dtype=bool), owners)

    def everywhere(self, request: int) -> Places:
        """All places for a request, each fault at its cost."""
        places, faults = self._judged(self._around([request], AROUND_POINT, AROUND_VECTOR), keep=True)
        return places._replace(costs=places.costs + FORBIDDEN * faults)

    def _judged(self, places: Places, keep: bool) -> tuple[Places, Indices]:
        """Places with costs and leaders, and the number of their faults; those with faults only if they are to be
        kept."""
        faults = OUTSIDE * self._outside(places).astype(int)
        if not keep:
            places = places.picked(np.flatnonzero(faults == 0))
            faults = np.zeros(len(places.costs), dtype=int)
        which, touched = self._touched(places.forms[0], places.forms[1] + CLEARANCE, keep)
        np.add.at(faults, which[touched < self.solid], 1)
        dashed = which[touched >= self.solid]
        np.add.at(places.costs, dashed, DASHED_COST)
        places.bad[dashed] = True
        led = self._needs_leader(places)
        faults[led & (places.gaps < LEADER_LEAST)] += 1
        if not keep:
            kept = np.flatnonzero(faults == 0)
            places, led, faults = places.picked(kept), led[kept], faults[kept]
        self._charge_beyond(places, led)
        self._lead(places, led)
        if not keep:
            kept = np.flatnonzero(places.costs < FORBIDDEN)
            places, faults = places.picked(kept), faults[kept]
        return places, faults

    def _lead(self, places: Places, led: Flags) -> None:
        """Add the leaders of some places, with their cost."""
        some = led.nonzero()[0]
        middles, halves, feet = places.forms[:3].take(some, axis=2)
        owners = self.own.take(places.owners.take(some))
        gap = _gap(middles - feet, halves)
        length = np.maximum(np.hypot(*gap), 1e-9)
        places.forms[3][:, some] = to = feet + gap * np.maximum(0.0, 1.0 - LEADER_GAP / length)
        crossed, heaviest = self._crossed(feet, feet + gap / length * FOOT_REACH, to)
        marks = self.mark_start.take(owners, axis=1), self.mark_end.take(owners, axis=1)
        nearest = np.minimum(*(np.hypot(*(ends - feet)) for ends in marks))
        costs = places.costs.take(some) + (LEADER_COST + CROSSED_COST * crossed)
        places.costs[some] = costs + END_COST * (~self.mark_is_point.take(owners) & (nearest < NEAR_END))
        places.bad[some] |= heaviest > 1.0

    def _charge_beyond(self, places: Places, led: Flags) -> None:
        """Charge places of points without a leader beyond a vector."""
        start, end = self.vectors
        if not start.size:
            return
        some = (~led & (places.gaps > BESIDE) & self.mark_is_point[self.own[places.owners]]).nonzero()[0]
        middles, halves, feet = places.forms[:3].take(some, axis=2)
        gap = _gap(middles - feet, halves)
        first, last = feet + gap / np.maximum(np.hypot(*gap), 1e-9) * FOOT_REACH, feet + gap
        which, crossed = near(sides_around(first, last), sides_around(start, end))
        over = touching(np.stack((first, last)).take(which, axis=2), np.stack((start, end)).take(crossed, axis=2))
        behind = np.zeros(len(some), dtype=bool)
        behind[which[over]] = True
        places.costs[some[behind]] += BEYOND_COST

    def _outside(self, places: Places) -> Flags:
        left, top, right, bottom = sides(*places.forms[:2])
        outside: Flags = (left < self.panel.left) | (right > self.panel.right)
        outside |= (top < self.panel.top) | (bottom > self.panel.bottom)
        return outside

    def _touched(self, middles: Floats, halves: Floats, keep: bool) -> tuple[Indices, Indices]:
        """Pairs of a box and a touched obstacle; obstacles count areas, solid, dashed in turn."""
        boxes = sides(middles, halves)
        covered, areas = near(boxes, [side[: self.areas] for side in self.reach])
        others = np.arange(len(boxes[0]))
        if not keep:
            others = np.delete(others, covered)
            boxes = [side.take(others) for side in boxes]
        box, line = near(boxes, [side[self.areas :] for side in self.reach])
        box, line = others.take(box), line + self.areas
        offset = middles.take(box, axis=1) - self.start.take(line, axis=1)
        along = (self.end - self.start).take(line, axis=1)
        hit = (~separated(offset, halves.take(box, axis=1), along)).nonzero()[0]
        return np.concatenate((covered, box.take(hit))), np.concatenate((areas, line.take(hit)))

    def _needs_leader(self, places: Places) -> Flags:
        """Whether places need a leader: far ones, and those about as near to another mark of the same kind as to their
        own."""
        led: Flags = places.gaps > LEADER_FROM
        close = (~led).nonzero()[0]
        middles, halves = places.forms[:2].take(close, axis=2)
        mark, reach = self.own[places.owners[close]], halves + (places.gaps[close] + NEARER)
        which, other = near(sides(middles, reach), sides_around(self.mark_start, self.mark_end))
        others = self.mistakable.ravel().take(mark.take(which) * len(self.mistakable) + other).nonzero()[0]
        which, other = which.take(others), other.take(others)
        offset = middles.take(which, axis=1) - self.mark_start.take(other, axis=1)
        along = (self.mark_end - self.mark_start).take(other, axis=1)
        hit = ~separated(offset, reach.take(which, axis=1), along)
        led[close[which[hit]]] = True
        return led

    def _crossed(self, feet: Floats, start: Floats, to: Floats) -> tuple[Floats, Floats]:
        """The weight of the strokes that each leader crosses, and the greatest single weight: areas are joints and
        arrowheads, or writing."""
        which, crossed = near(sides_around(start, to), self.reach)
        leader = np.stack((start, to)).take(which, axis=2)
        stroke = np.stack((self.start, self.end)).take(crossed, axis=2)
        over = touching(leader, stroke).astype(float)
        areas = (crossed < self.areas).nonzero()[0]  # a leader over an area crosses one of its diagonals
        low, high = stroke.take(areas, axis=2)
        foot = feet.take(which.take(areas), axis=1)
        at_foot = ((low <= foot) & (foot <= high)).all(axis=0)
        written = self.weights.take(crossed.take(areas)) >= FORBIDDEN  # a foot under writing is no place for it
        other = np.array(((low[0], high[1]), (high[0], low[1])))
        over[areas] = np.where(at_foot, written, over.take(areas) + crosses(leader.take(areas, axis=2), other))
        hit = (over > 0.0).nonzero()[0]  # faster than of numbers
        which, over = which.take(hit), over.take(hit) * self.weights.take(crossed.take(hit))
        heaviest = np.zeros(feet.shape[1])
        np.maximum.at(heaviest, which, over)
        whole: Any = np.bincount(which, over, len(heaviest))
        return whole, heaviest


def mapped(mark: Mark, change: Callable[[complex], complex]) -> Mark:
    """A mark with its point, or both of its ends, changed."""
    return (change(mark[0]), change(mark[1])) if isinstance(mark, tuple) else change(mark)


def ends(mark: Mark) -> Segment:
    """The ends of a mark, for a point both the same, to a thousandth of a millimetre, so that coincident marks are
    equal."""
    start, end = mark if isinstance(mark, tuple) else (mark, mark)
    return complex(round(start.real, 3), round(start.imag, 3)), complex(round(end.real, 3), round(end.imag, 3))


def _ends(segments: Sequence[Segment]) -> tuple[Floats, Floats]:
    """Starts and ends of segments, in rows."""
    start, end = segments_of(segments).T
    return in_rows(start), in_rows(end)


def _disliked(toward: Sequence[tuple[float, ...]], directions: Points) -> Floats:
    """The cost of each direction from a mark (columns) for its preferred directions (rows): of a point from all of
    them, of a vector for the side of the last two directions."""
    first = np.array([page_direction((liked or (LIKED,))[0]) for liked in toward]).reshape(-1, 1)
    costs: Floats = 0.4 * (1.0 - (directions * first.conj()).real)
    costs[:, : len(WAYS)] = 0.5 * _apart((LIKED,), WAYS) / np.pi
    rows = np.array([i for i, liked in enumerate(toward) for _ in liked], dtype=np.intp)
    if rows.size:
        ranks, angles = zip(*(pair for liked in toward for pair in enumerate(liked)), strict=True)
        each = 3.0 * _apart(angles, WAYS) / np.pi + 0.3 * np.array(ranks)[:, None]
        costs[rows, : len(WAYS)] = np.inf
        np.minimum.at(costs[:, : len(WAYS)], rows, each)
    return costs


def _apart(liked: Sequence[float], columns: Points) -> Floats:
    """Angles (rad) between directions in columns and in rows."""
    rows = np.array([page_direction(angle) for angle in liked])
    angles: Floats = np.abs(np.angle(columns * rows.conj()[:, None]))
    return angles


def _gap(offset: Floats, half: Floats) -> Floats:
    """The vectors from points to the nearest places of boxes at these offsets."""
    return offset - np.minimum(np.maximum(offset, -half), half)
