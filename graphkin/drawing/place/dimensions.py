"""Dimensions, after ISO 129-1, of lengths and angles, and the search for room for them; and the bar that checks the
scale of a print.

A dimension keeps clear of the mechanism and of other dimensions; its extension lines begin beyond the symbols of their
points.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import chain, combinations, pairwise
from typing import NamedTuple, TypeAlias, TypeVar

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Arc, Line, Polygon, Run, Segment, Text, page_direction
from graphkin.drawing.ink.symbols import POINTER, arrowhead
from graphkin.drawing.place.obstacles import (
    Flags,
    Floats,
    Indices,
    Obstacles,
    Points,
    boxes_of,
    cheapest,
    meets,
    segments_of,
    stand_on,
)
from graphkin.drawing.text import CAP_HEIGHT, text_box
from graphkin.plane import cross

OVERRUN, GAP = 1.5, 0.8  # extension lines reach past the dimension line and start off the object, mm
SHORT_ARC = 5.0  # mm of an arc that has no room for a number beside its middle
CLEAR = 0.7  # between a number and the line broken for it, mm
Part: TypeAlias = Line | Polygon | Arc | Text
Parts: TypeAlias = tuple[Part, ...]


def dimension(start: complex, end: complex, offset: float, runs: tuple[Run, ...], share: float = 0.5) -> Parts:
    """The distance of two points, its line ``offset`` mm to the right of the way from start to end (negative: left).

    The number stands upright in a gap of the line, at a ``share`` of it, or past its end if the line is too short.
    """
    along = (end - start) / abs(end - start)
    right = along * 1j
    a, b = start + offset * right, end + offset * right
    parts: list[Part] = []
    if offset:
        away = right * math.copysign(1.0, offset)
        parts += [Line(p + GAP * away, q + OVERRUN * away, strokes.DIMENSION) for p, q in ((start, a), (end, b))]
    length = abs(b - a)
    at = a + share * (b - a)
    text = _centred(runs, at)
    gap = text_box(text).grown(CLEAR).clip_line(at, along)
    head = POINTER.head_length
    if gap is not None and abs(gap[1] - gap[0]) + 2 * head + 1.0 <= 2 * min(share, 1 - share) * length:
        lines = Line(a, gap[0], strokes.DIMENSION), Line(gap[1], b, strokes.DIMENSION)
        return *parts, *lines, _head(a, a - b), _head(b, b - a), text
    outside = 0.0 if length >= 3 * head else 2 * head  # of the ends, where arrowheads stand on a short one
    out = -along if outside else along
    parts.append(Line(a - outside * along, b + outside * along, strokes.DIMENSION))
    parts += [_head(a, -out), _head(b, out)]
    return *parts, _centred(runs, b + (2 * CLEAR + outside + _reach(runs, along)) * along)


def angle_dimension(
    centre: complex, radius: float, start: float, end: float, runs: tuple[Run, ...], share: float = 0.5
) -> Parts:
    """The angle from one direction to another (rad) about a point: an arc with an arrowhead at ``end``, its number
    outside the arc at a ``share`` of it, or outside its beginning if it is short."""
    sense = math.copysign(1.0, end - start)
    turn = min(POINTER.head_length / radius, abs(end - start) * 0.75)
    tip = centre + radius * page_direction(end)
    chord = tip - (centre + radius * page_direction(end - sense * turn))
    short = abs(end - start) * radius < SHORT_ARC
    outward = page_direction(start - sense * SHORT_ARC / radius if short else start + share * (end - start))
    return (
        Arc(centre, radius, start, end - sense * 0.6 * turn, strokes.DIMENSION),
        arrowhead(tip, chord, turn * radius, POINTER.head_width, strokes.BLACK),
        _centred(runs, centre + (radius + CLEAR + _reach(runs, outward)) * outward),
    )


BAR = 50  # mm, length of the check bar


def check_bar(at: complex, words: tuple[Run, ...]) -> tuple[Line | Text, ...]:
    """A bar of 50 mm with a tick each 10 mm, from its left end, and words above it: lay a ruler on it to see that a
    print is true to scale."""
    heights = {mm: 2.0 if mm in (0, BAR) else 1.2 for mm in range(0, BAR + 1, 10)}
    ticks = (Line(at + mm, at + mm - height * 1j, strokes.DIMENSION) for mm, height in heights.items())
    return Line(at, at + BAR, strokes.OUTLINE), *ticks, Text(at + complex(BAR / 2, -2.8), words, "middle")


def _centred(runs: tuple[Run, ...], at: complex) -> Text:
    """The text with the middle of its box, from baseline to capitals, at a point."""
    size = max(run.size for run in runs)
    return Text(at + 0.5j * CAP_HEIGHT * size, runs, "middle")


def _reach(runs: tuple[Run, ...], along: complex) -> float:
    """How far (mm) the box of a text reaches from its middle in a direction."""
    box = text_box(_centred(runs, 0j))
    return abs(along.real) * box.width / 2 + abs(along.imag) * box.height / 2


def _head(tip: complex, along: complex) -> Polygon:
    return arrowhead(tip, along, POINTER.head_length, POINTER.head_width, strokes.BLACK)


AROUND_POINT = 11.0  # mm around a point in which lines belong to its own symbols
SPACE = 0.5 * (1 + 1j)  # mm between a number or an arrowhead and what is drawn
ARROWHEAD = 1.7  # mm: half the diagonal of the box of one, which is smaller than any symbol of a point
ARC_END, ARC_STEP = 1.5, math.radians(12)  # mm of an arc at each end that may touch lines; between points of its course
ON_LINE = 1e-9  # mm²: a smaller area with a line is rounding
OVER = 1e3  # what it costs to run over lines: more than to come last
TRIM, LEAST_EXTENSION = 0.8, 2.2  # mm between a symbol and an extension line; a shorter one is none


class _Choice(NamedTuple):
    """A candidate for a dimension: the boxes of its numbers and of its arrowheads; where these have room, its extension
    lines, its other lines with the chords of its arcs, and the boxes around these arcs."""

    parts: Parts
    numbers: list[Box]
    heads: list[Box]
    extensions: Sequence[Line] = ()
    lines: Sequence[Segment] = ()
    arcs: Sequence[Box] = ()

    @classmethod
    def of(cls, parts: Parts) -> _Choice:
        numbers = [text_box(part) for part in parts if isinstance(part, Text)]
        return cls(parts, numbers, [Box.around(part.points) for part in parts if isinstance(part, Polygon)])

    def whole(self, extensions: int) -> _Choice:
        """The candidate with its lines, of which the first are extension lines."""
        lines = [part for part in self.parts if isinstance(part, Line)]
        courses = [_course(part) for part in self.parts if isinstance(part, Arc)]
        chords = [chord for course in courses for chord in pairwise(course)]
        return self._replace(
            extensions=lines[:extensions], lines=[*_ends(lines[extensions:]), *chords],
            arcs=[Box.around(course).grown(0.5) for course in courses],
        )


class DimensionClearance:
    """The strokes already drawn, as arrays: segments, shape (n, 2), and boxes by their middles and half sizes, shape
    (2, n)."""

    def __init__(self, obstacles: Obstacles, panel: Box | None) -> None:
        self.panel = panel
        self.segments, self.dashed = segments_of(obstacles.solid), segments_of(obstacles.dashed)
        self.areas = boxes_of(obstacles.areas)
        self.numbers = boxes_of(())  # of dimensions, over which nothing runs
        self.heads = boxes_of(())  # arrowheads of dimensions, over which extension lines of others may run
        corners = [z for box in obstacles.areas for z in box.corners] + [z for s in obstacles.solid for z in s]
        self.content = Box.around(corners) if corners else Box(0, 0, 0, 0)

    def take(
        self, choices: Iterable[Parts], extensions: int = 2, *, over: bool = False, ends_on_line: bool = False,
        crossing: bool = False, over_lines: bool = False,
    ) -> Parts | None:
        """The first clear dimension of some, added to the drawn strokes; None where none is clear.

        Its first lines are extension lines: they begin beyond the symbols around their points, and run over other lines
        only if necessary, as its number does over dashed ones, or if that is allowed (``over``).  The arrowhead of an
        angle ends on a drawn line, and its arc may run over strokes if that is allowed (``crossing``), its number not.
        The lines of a distance may run over lines and arrowheads, its own arrowheads end on lines, but none lies over a
        symbol of a point (``over_lines``).
        """
        drawn = [_Choice.of(parts) for parts in choices]

        def charge(some: Sequence[int]) -> Floats:
            costs = np.full(len(drawn), np.inf)
            left = [k for k in some if self._inside(drawn[k].numbers + drawn[k].heads)
                    and not any(number.overlaps(other) for number, other in combinations(drawn[k].numbers, 2))]
            left = _kept(left, self._covered([drawn[k] for k in left], ends_on_line or over_lines, over_lines))
            for k in left:
                drawn[k] = drawn[k].whole(extensions)
            left = [k for k in left if self._inside(drawn[k].arcs)]
            if left and not crossing:
                left = _kept(left, self._over_strokes([drawn[k] for k in left], over_lines))
            left = left and self._trim(drawn, left, crossing)
            if left:
                bad, runs_over = self._crossed([drawn[k] for k in left], crossing, over_lines)
                costs[left] = np.where(bad, np.inf, runs_over * (0.0 if over else OVER))
            return costs[some]

        number = cheapest(enumerate(range(len(drawn))), charge)
        if number is None:
            return None
        chosen = drawn[number]
        self.segments = np.concatenate((self.segments, segments_of([*chosen.lines, *_ends(chosen.extensions)])))
        boxes = boxes_of(chosen.numbers)
        self.areas, self.numbers = np.hstack((self.areas, boxes)), np.hstack((self.numbers, boxes))
        self.heads = np.hstack((self.heads, boxes_of(chosen.heads)))
        return chosen.parts

    def _inside(self, boxes: Iterable[Box]) -> bool:
        """Whether boxes of a dimension stand in the panel; its lines may leave it."""
        return self.panel is None or all(map(self.panel.holds, boxes))

    def _covered(self, choices: Sequence[_Choice], on_lines: bool, over_lines: bool) -> Flags:
        """Whether numbers or arrowheads of dimensions stand on strokes; arrowheads may lie on lines."""
        bad = np.zeros(len(choices), dtype=bool)
        of_numbers, numbers = _owned([choice.numbers for choice in choices], boxes_of)
        of_heads, heads = _owned([choice.heads for choice in choices], boxes_of)
        taken = np.hstack((self.areas, self.heads))
        owners, boxes = (of_numbers, numbers) if on_lines else (
            np.concatenate((of_numbers, of_heads)), np.hstack((numbers, heads)))
        reach = boxes[1] + SPACE
        bad[owners[stand_on(boxes[0], reach, taken).any(axis=1)]] = True
        bad[owners[meets(self.segments, boxes[0], reach)[1]]] = True
        under = taken if over_lines else self.numbers
        bad[of_heads[stand_on(heads[0], heads[1] + SPACE, under).any(axis=1)]] = True
        return bad

    def _over_strokes(self, choices: Sequence[_Choice], over_lines: bool) -> Flags:
        """Whether lines of dimensions run over strokes that they may not cross."""
        bad = np.zeros(len(choices), dtype=bool)
        of_lines, lines = _owned([choice.lines for choice in choices], segments_of)
        bad[of_lines[_run_over(lines, np.hstack((self._symbols(over_lines), self.heads)), 0.4)]] = True
        if not over_lines:
            bad[of_lines[_crossings(lines, self.segments)[0]]] = True
        return bad

    def _trim(self, drawn: list[_Choice], some: Sequence[int], crossing: bool) -> list[int]:
        """Trim the extension lines of some dimensions; those of which enough is left."""
        each, kept = iter(self._trimmed([line for k in some for line in drawn[k].extensions])), list[int]()
        for k in some:
            parts, whole = drawn[k].parts, drawn[k].extensions
            trimmed = [next(each) or (line if crossing else None) for line in whole]
            lines = [line for line in trimmed if line is not None]
            if len(lines) == len(trimmed):
                others = (part for part in parts if not any(part is line for line in whole))
                drawn[k] = drawn[k]._replace(parts=(*lines, *others), extensions=lines)
                kept.append(k)
        return kept

    def _crossed(self, choices: Sequence[_Choice], crossing: bool, over_lines: bool) -> tuple[Flags, Flags]:
        """Whether extension lines run over forbidden strokes, and whether over lines, or numbers have dashed lines
        under them."""
        bad, over = np.zeros((2, len(choices)), dtype=bool)
        of_numbers, numbers = _owned([choice.numbers for choice in choices], boxes_of)
        of_beyond, extensions = _owned([_ends(choice.extensions) for choice in choices], segments_of)
        of_all, lines = _owned([[*choice.lines, *_ends(choice.extensions)] for choice in choices], segments_of)
        line, number = meets(lines, numbers[0], numbers[1])
        bad[of_all[line[of_all[line] == of_numbers[number]]]] = True  # past the end of a short one stands the next
        if crossing:
            bad[of_all[_run_over(lines, self.numbers, 0.3)]] = True
        else:
            bad[of_beyond[_run_over(extensions, self._symbols(over_lines), 0.4)]] = True
        over[of_beyond[_crossings(extensions, self.segments)[0]]] = True
        over[of_numbers[meets(self.dashed, numbers[0], numbers[1] + 0.3 * (1 + 1j))[1]]] = True
        return bad, over

    def _symbols(self, large: bool) -> Points:
        """Areas, or the areas larger than arrowheads."""
        return self.areas[:, np.abs(self.areas[1]) > ARROWHEAD] if large else self.areas

    def _trimmed(self, lines: Sequence[Line]) -> list[Line | None]:
        """Extension lines, each beginning clear of its own point's symbols; None where too little is left."""
        lengths = [abs(line.end - line.start) for line in lines]
        axes = [(line.end - line.start) / length for line, length in zip(lines, lengths, strict=True)]
        ends = [(line.start, line.start + AROUND_POINT * axis) for line, axis in zip(lines, axes, strict=True)]
        near = segments_of(ends)
        starts = np.full(len(lines), -TRIM)
        np.maximum.at(starts, *_crossings(near, self.segments))
        # the symbols on the point end where the line leaves their boxes
        middles, reach = self.areas[0], self.areas[1] + 0.4 * (1 + 1j)
        which, under = meets(near, middles, reach)
        corners = zip((middles[under] - reach[under]).tolist(), (middles[under] + reach[under]).tolist(), strict=True)
        for i, box in zip(which.tolist(), map(Box.around, corners), strict=True):
            chord = box.clip(lines[i].start, lines[i].start + AROUND_POINT * axes[i])
            if chord is not None:
                starts[i] = max(starts[i], abs(chord[1] - lines[i].start) / AROUND_POINT)
        trimmed: list[Line | None] = []
        for line, length, axis, share in zip(lines, lengths, axes, starts.tolist(), strict=True):
            start = AROUND_POINT * share + TRIM if share > 0 else 0.0
            kept = start < length - LEAST_EXTENSION
            trimmed.append(Line(line.start + start * axis, line.end, line.stroke) if kept else None)
        return trimmed


def _course(arc: Arc) -> list[complex]:
    """Points of an arc, at most a dozen degrees apart, without short pieces at its ends, which lie on lines."""
    turn = arc.end - arc.start
    left_out = min(0.06, ARC_END / (abs(turn) * arc.radius))
    count = max(8, math.ceil(abs(turn) / ARC_STEP))
    shares = (left_out + (1 - 2 * left_out) * i / count for i in range(count + 1))
    return [arc.at(arc.start + share * turn) for share in shares]


def _kept(some: Sequence[int], bad: Flags) -> list[int]:
    """Those of some that are not bad."""
    return [k for k, no in zip(some, bad.tolist(), strict=True) if not no]


_Thing = TypeVar("_Thing")


def _owned(each: Sequence[Sequence[_Thing]], arrays: Callable[[Sequence[_Thing]], Points]) -> tuple[Indices, Points]:
    """Items of several owners as arrays, with the owner of each."""
    return np.repeat(np.arange(len(each)), [len(some) for some in each]), arrays([*chain.from_iterable(each)])


def _run_over(lines: Points, boxes: Points, space: float) -> Indices:
    """Whether lines come nearer to a box than a space (mm), shape (lines,)."""
    return meets(lines, boxes[0], boxes[1] + space * (1 + 1j))[0]


def _ends(lines: Sequence[Line]) -> list[Segment]:
    return [(line.start, line.end) for line in lines]


def _either_side(first: Floats, second: Floats) -> Flags:
    """Whether points lie on different sides of a line, or on it within rounding, by their areas with it."""
    return (np.minimum(first, second) < ON_LINE) & (np.maximum(first, second) > -ON_LINE)


def _crossings(segments: Points, others: Points) -> tuple[Indices, Floats]:
    """Whether segments cross others, and the share of their length at the crossing."""
    p, d = segments[:, 0], segments[:, 1] - segments[:, 0]
    q, e = others[:, 0], others[:, 1] - others[:, 0]
    # of the few whose ends lie on different sides the others are asked
    which, crossed = np.divmod(_either_side(_areas(p, d, q), _areas(p, d, q + e)).ravel().nonzero()[0], max(1, len(q)))
    span, start = e.take(crossed), q.take(crossed)
    both = _either_side(*(cross(span, end.take(which) - start) for end in (p, p + d)))
    which, crossed = which[both], crossed[both]
    turn = cross(d[which], e[crossed])
    along = np.abs(turn) < ON_LINE  # on one line: no place of their own
    share = cross(q[crossed] - p[which], e[crossed]) / np.where(along, 1.0, turn)
    return which, np.where(along, 0.0, share)


def _areas(start: Points, along: Points, to: Points) -> Floats:
    """Areas of some lines with points, shape (lines, points)."""
    # copies lie side by side in memory, which halves the time
    x, y = to.real.copy() - start.real[:, None], to.imag.copy() - start.imag[:, None]
    areas: Floats = along.real[:, None] * y - along.imag[:, None] * x
    return areas
