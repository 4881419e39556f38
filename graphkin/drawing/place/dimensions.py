"""Dimensions, after ISO 129-1, of lengths and angles, and where there is room for them; and the bar that checks the
scale of a print.

A dimension keeps clear of the mechanism and of other dimensions; its extension lines begin beyond the symbols of the
points that they come from.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import islice, pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Arc, Line, Polygon, Run, Segment, Text, page_direction
from graphkin.drawing.ink.symbols import POINTER, arrowhead
from graphkin.drawing.place.obstacles import Flags, Floats, Indices, Obstacles, Points, meets
from graphkin.drawing.text import CAP_HEIGHT, plain, text_box
from graphkin.plane import cross

__all__ = [
    "GAP", "LEAST_EXTENSION", "OVERRUN", "DimensionClearance", "Part", "Parts", "angle_dimension", "check_bar",
    "dimension",
]  # fmt: skip

OVERRUN, GAP = 1.5, 0.8  # extension lines reach past the dimension line and start off the object, mm
SHORT_ARC = 5.0  # mm of an arc that has no room for a number beside its middle
CLEAR = 0.7  # between a number and the line broken for it, mm
Part: TypeAlias = Line | Polygon | Arc | Text
Parts: TypeAlias = tuple[Part, ...]


def dimension(start: complex, end: complex, offset: float, runs: tuple[Run, ...], share: float = 0.5) -> Parts:
    """The distance of two points, its line ``offset`` mm to the right of the way from start to end (negative: left).

    The number stands upright in a gap of the line, at a ``share`` of it, or past its end where the line is too short
    for both.
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
        parts += [Line(a, gap[0], strokes.DIMENSION), Line(gap[1], b, strokes.DIMENSION), *_heads(a, b)]
        return *parts, text
    if length >= 3 * head:
        parts += [Line(a, b, strokes.DIMENSION), *_heads(a, b)]
    else:  # arrowheads from outside
        parts += [Line(a - 2 * head * along, b + 2 * head * along, strokes.DIMENSION)]
        parts += [_head(a, along), _head(b, -along)]
    box = text_box(_centred(runs, 0j))
    reach = abs(along.real) * box.width / 2 + abs(along.imag) * box.height / 2
    past = 2 * CLEAR + (0.0 if length >= 3 * head else 2 * head) + reach
    return *parts, _centred(runs, b + past * along)


def angle_dimension(
    centre: complex, radius: float, start: float, end: float, runs: tuple[Run, ...], share: float = 0.5
) -> Parts:
    """The angle from one direction to another (rad) about a point: an arc with an arrowhead at ``end``, its number
    outside the arc at a ``share`` of it, or outside its beginning where it is short."""
    sense = math.copysign(1.0, end - start)
    turn = min(POINTER.head_length / radius, abs(end - start) * 0.75)
    tip = centre + radius * page_direction(end)
    chord = tip - (centre + radius * page_direction(end - sense * turn))
    short = abs(end - start) * radius < SHORT_ARC
    outward = page_direction(start - sense * SHORT_ARC / radius if short else start + share * (end - start))
    box = text_box(_centred(runs, 0j))
    reach = abs(outward.real) * box.width / 2 + abs(outward.imag) * box.height / 2
    return (
        Arc(centre, radius, start, end - sense * 0.6 * turn, strokes.DIMENSION),
        arrowhead(tip, chord, turn * radius, POINTER.head_width, strokes.BLACK),
        _centred(runs, centre + (radius + CLEAR + reach) * outward),
    )


def check_bar(at: complex, runs: tuple[Run, ...] = (), length: float = 50.0) -> Parts:
    """A bar of 50 mm with a tick each 10 mm, from its left end: lay a ruler on it to see that a print is true to scale.

    The words stand above it; without any, its length.
    """
    ticks = [Line(at, at + length, strokes.OUTLINE)]
    for mm in range(0, round(length) + 1, 10):
        height = 2.0 if mm in (0, round(length)) else 1.2
        ticks.append(Line(at + mm, at + mm - height * 1j, strokes.DIMENSION))
    words = runs or plain(f"{length:g} mm", 2.5)
    return *ticks, Text(at + complex(length / 2, -2.8), words, "middle")


def _centred(runs: tuple[Run, ...], at: complex) -> Text:
    """The text with the middle of its box, from baseline to capitals, at a point."""
    size = max(run.size for run in runs)
    return Text(at + 0.5j * CAP_HEIGHT * size, runs, "middle")


def _heads(a: complex, b: complex) -> tuple[Polygon, Polygon]:
    return _head(a, a - b), _head(b, b - a)


def _head(tip: complex, along: complex) -> Polygon:
    return arrowhead(tip, along, POINTER.head_length, POINTER.head_width, strokes.BLACK)


AROUND_POINT = 11.0  # mm around a point in which lines belong to its own symbols
ARROWHEAD = 1.7  # mm: half the diagonal of the box of one, which is smaller than any symbol of a point
ARC_END, ARC_STEP = 1.5, math.radians(12)  # mm of an arc at each end that may touch lines; between points of its course
ON_LINE = 1e-9  # mm²: a smaller area with a line is rounding
TRIM, LEAST_EXTENSION = 0.8, 2.2  # mm between a symbol and an extension line; a shorter one is none


class _Choice(NamedTuple):
    """One of the dimensions that may be taken: its extension lines, its other lines, its arcs, and the boxes of its
    numbers and of its arrowheads."""

    parts: Parts
    extensions: list[Line]
    lines: list[Line]
    arcs: list[Arc]
    numbers: list[Box]
    heads: list[Box]

    @classmethod
    def of(cls, parts: Parts, extensions: int) -> _Choice:
        made = cls(parts, [], [], [], [], [])
        for part in parts:
            if isinstance(part, Line):
                (made.extensions if len(made.extensions) < extensions else made.lines).append(part)
            elif isinstance(part, Polygon):
                made.heads.append(Box.around(part.points))
            elif isinstance(part, Text):
                made.numbers.append(text_box(part))
            else:
                made.arcs.append(part)
        return made

    def courses(self) -> list[list[complex]]:
        """Points of its arcs, but for their ends, which lie on lines."""
        return [[arc.at(arc.start + share * (arc.end - arc.start)) for share in _along(arc)] for arc in self.arcs]

    def own(self) -> list[Segment]:
        """Its lines, and the chords of its arcs."""
        return [*((line.start, line.end) for line in self.lines), *(c for arc in self.courses() for c in pairwise(arc))]

    def with_extensions(self, lines: list[Line]) -> _Choice:
        """The dimension with other extension lines."""
        others = (part for part in self.parts if not any(part is line for line in self.extensions))
        return self._replace(parts=(*lines, *others), extensions=lines)


class DimensionClearance:
    """What is drawn already, as arrays: segments, and boxes by their middle and half size."""

    def __init__(self, obstacles: Obstacles, panel: Box | None) -> None:
        self.panel = panel
        self.segments = _segments(obstacles.solid)
        self.dashed = _segments(obstacles.dashed)
        self.areas = _arrays(obstacles.areas)
        self.numbers = _arrays(())  # of dimensions, over which nothing runs
        self.heads = _arrays(())  # arrowheads of dimensions, over which extension lines of others may run
        corners = [z for box in obstacles.areas for z in box.corners] + [z for s in obstacles.solid for z in s]
        self.content = Box.around(corners) if corners else Box(0, 0, 0, 0)

    def take(
        self, choices: Iterable[Parts], extensions: int = 2, *, over: bool = False, ends_on_line: bool = False,
        crossing: bool = False, over_lines: bool = False,
    ) -> Parts | None:  # fmt: skip
        """The first of some dimensions that is clear of everything, added to what is drawn; None where none is.

        Its first lines are extension lines: they begin beyond what stands around the point they come from, and run
        over other lines only where they must, as its number does over dashed ones, or where that is allowed at once
        (``over``).  The arrowhead of an angle
        ends on a line that is drawn, and its arc may run over what is drawn where it is given leave to
        (``crossing``), its number not.  The lines of a distance may run over lines and arrowheads, its own arrowheads
        end on lines, but none lies over a symbol of a point (``over_lines``).
        """
        fits = self._fits([_Choice.of(parts, extensions) for parts in choices], ends_on_line, crossing, over_lines)
        if not fits:
            return None
        first = next((fit for fit, runs_over in fits if over or not runs_over), fits[0][0])
        self.segments = np.concatenate((self.segments, _segments([*first.own(), *_ends(first.extensions)])))
        numbers = _arrays(first.numbers)
        self.areas, self.numbers = _joined(self.areas, numbers), _joined(self.numbers, numbers)
        self.heads = _joined(self.heads, _arrays(first.heads))
        return first.parts

    def _fits(
        self, choices: list[_Choice], ends_on_line: bool, crossing: bool, over_lines: bool
    ) -> list[tuple[_Choice, bool]]:
        """Those of some dimensions that are clear of everything they may not run over, with extension lines trimmed,
        and whether these run over other lines, or dashed ones over their numbers.

        Each question is asked of all that are left at once.
        """
        if self.panel is not None:
            choices = [one for one in choices if all(map(self.panel.holds, (*one.numbers, *one.heads)))]
        boxes = [one.numbers if ends_on_line or over_lines else one.numbers + one.heads for one in choices]
        choices = _left(choices, self._covered(boxes))
        if self.panel is not None:
            arcs = [[Box.around(course).grown(0.5) for course in one.courses()] for one in choices]
            choices = [one for one, each in zip(choices, arcs, strict=True) if all(map(self.panel.holds, each))]
        taken = _joined(self.areas, self.heads) if over_lines else self.numbers
        choices = _left(choices, _stand_on([one.heads for one in choices], taken))
        if not choices:
            return []
        middles, halves = self.areas
        large = np.hypot(halves.real, halves.imag) > ARROWHEAD if over_lines else slice(None)
        symbols = middles[large], halves[large]
        if not crossing:
            own = [one.own() for one in choices]
            bad = _over(own, _joined(symbols, self.heads), 0.4)
            choices = _left(choices, bad if over_lines else bad | self._crossed(own))
        trimmed = self._trimmed([one.extensions for one in choices])
        if crossing:
            whole = [one.extensions for one in choices]
            shown = [[k or line for k, line in zip(*both, strict=True)] for both in zip(trimmed, whole, strict=True)]
        else:
            choices = _left(choices, np.array([None in lines for lines in trimmed], dtype=bool))
            shown = [[line for line in lines if line is not None] for lines in trimmed if None not in lines]
        beyond = [_ends(lines) for lines in shown]
        lines = [one.own() + further for one, further in zip(choices, beyond, strict=True)]
        numbers = [one.numbers for one in choices]
        bad = _over_own(lines, numbers)  # a number past the end of a short dimension stands on the next one
        bad |= _over(lines, self.numbers, 0.3) if crossing else _over(beyond, symbols, 0.4)
        over = self._crossed(beyond) | self._dashed_over(numbers)
        judged = zip(choices, shown, bad.tolist(), over.tolist(), strict=True)
        return [(one.with_extensions(own), runs_over) for one, own, no, runs_over in judged if not no]

    def _covered(self, boxes: Sequence[Sequence[Box]]) -> Flags:
        """Which of some dimensions with these boxes stand on anything."""
        middles, halves = _arrays([box for each in boxes for box in each])
        _, on_lines = meets(self.segments, middles, halves + 0.5 * (1 + 1j))
        return _stand_on(boxes, _joined(self.areas, self.heads)) | _any(boxes, on_lines)

    def _crossed(self, lines: Sequence[Sequence[Segment]]) -> Flags:
        """Which of some dimensions with these lines cross lines that are drawn."""
        return _any(lines, _crossings(_segments([line for each in lines for line in each]), self.segments)[0])

    def _dashed_over(self, numbers: Sequence[Sequence[Box]]) -> Flags:
        """Over the numbers of which dimensions dashed lines run."""
        middles, halves = _arrays([box for each in numbers for box in each])
        return _any(numbers, meets(self.dashed, middles, halves + 0.3 * (1 + 1j))[1])

    def _trimmed(self, extensions: Sequence[Sequence[Line]]) -> list[list[Line | None]]:
        """Extension lines, each from where nothing of its own point is in its way; None where too little is left."""
        lines = [line for each in extensions for line in each]
        lengths = [abs(line.end - line.start) for line in lines]
        ways = [(line.end - line.start) / length for line, length in zip(lines, lengths, strict=True)]
        near = _segments([(line.start, line.start + AROUND_POINT * way) for line, way in zip(lines, ways, strict=True)])
        starts = [-TRIM] * len(lines)
        which, shares = _crossings(near, self.segments)
        for i, share in zip(which.tolist(), shares.tolist(), strict=True):
            starts[i] = max(starts[i], share)
        # the symbols on the point end where the line leaves their boxes
        middles, reach = self.areas[0], self.areas[1] + 0.4 * (1 + 1j)
        which, what = meets(near, middles, reach)
        low, high = (middles[what] - reach[what]).tolist(), (middles[what] + reach[what]).tolist()
        for i, corners in zip(which.tolist(), zip(low, high, strict=True), strict=True):
            chord = Box.around(corners).clip(lines[i].start, lines[i].start + AROUND_POINT * ways[i])
            if chord is not None:
                starts[i] = max(starts[i], abs(chord[1] - lines[i].start) / AROUND_POINT)
        found: list[Line | None] = []
        for line, length, way, share in zip(lines, lengths, ways, starts, strict=True):
            start = AROUND_POINT * share + TRIM if share > 0 else 0.0
            kept = start < length - LEAST_EXTENSION
            found.append(Line(line.start + start * way, line.end, line.stroke) if kept else None)
        each_of = iter(found)
        return [list(islice(each_of, len(each))) for each in extensions]


def _along(arc: Arc) -> list[float]:
    """Shares of an arc that leave out a little of its ends, no more than a dozen degrees apart."""
    turn = abs(arc.end - arc.start)
    left_out = min(0.06, ARC_END / (turn * arc.radius))
    count = max(8, math.ceil(turn / ARC_STEP))
    return [left_out + (1 - 2 * left_out) * i / count for i in range(count + 1)]


def _left(choices: Sequence[_Choice], bad: Flags) -> list[_Choice]:
    return [one for one, no in zip(choices, bad.tolist(), strict=True) if not no]


def _owners(things: Sequence[Sequence[object]]) -> Indices:
    return np.repeat(np.arange(len(things)), [len(each) for each in things])


def _any(things: Sequence[Sequence[object]], found: Indices) -> Flags:
    """Which of some groups hold any of the things found, counted through all groups."""
    some = np.zeros(len(things), dtype=bool)
    some[_owners(things)[found]] = True
    return some


def _stand_on(boxes: Sequence[Sequence[Box]], taken: tuple[Points, Points]) -> Flags:
    """Which of some dimensions with these boxes stand on boxes that are taken."""
    middles, halves = _arrays([box for each in boxes for box in each])
    off, reach = middles[:, None] - taken[0], halves[:, None] + 0.5 * (1 + 1j) + taken[1]
    return _any(boxes, ((np.abs(off.real) < reach.real) & (np.abs(off.imag) < reach.imag)).nonzero()[0])


def _over(lines: Sequence[Sequence[Segment]], boxes: tuple[Points, Points], space: float) -> Flags:
    """Of which groups of lines any comes nearer to a box than a space (mm)."""
    own = _segments([line for each in lines for line in each])
    return _any(lines, meets(own, boxes[0], boxes[1] + space * (1 + 1j))[0])


def _over_own(lines: Sequence[Sequence[Segment]], boxes: Sequence[Sequence[Box]]) -> Flags:
    """Which of some dimensions have a line that meets a box of their own."""
    own = _segments([line for each in lines for line in each])
    which, what = meets(own, *_arrays([box for each in boxes for box in each]))
    return _any(lines, which[_owners(lines)[which] == _owners(boxes)[what]])


def _ends(lines: Sequence[Line]) -> list[Segment]:
    return [(line.start, line.end) for line in lines]


def _segments(ends: Sequence[Segment]) -> Points:
    return np.array(ends, dtype=complex).reshape(-1, 2)


def _joined(one: tuple[Points, Points], other: tuple[Points, Points]) -> tuple[Points, Points]:
    return np.concatenate((one[0], other[0])), np.concatenate((one[1], other[1]))


def _arrays(boxes: Sequence[Box]) -> tuple[Points, Points]:
    """Middles and half sizes of boxes."""
    sizes = [complex(box.width, box.height) / 2 for box in boxes]
    return np.array([box.centre for box in boxes], dtype=complex), np.array(sizes, dtype=complex)


def _either_side(one: Floats, other: Floats) -> Flags:
    """Whether points lie on different sides of a line, or on it but for rounding; their areas with it tell."""
    return (np.minimum(one, other) < ON_LINE) & (np.maximum(one, other) > -ON_LINE)


def _crossings(own: Points, others: Points) -> tuple[Indices, Floats]:
    """Which of some segments cross others, and at which share of their length."""
    p, d = own[:, 0], own[:, 1] - own[:, 0]
    q, e = others[:, 0], others[:, 1] - others[:, 0]
    # of the few whose ends lie on different sides the others are asked
    which, what = _either_side(_areas(p, d, q), _areas(p, d, q + e)).nonzero()
    sides = (cross(e[what], end[which] - q[what]) for end in (p, p + d))
    both = _either_side(*sides)
    which, what = which[both], what[both]
    turn = cross(d[which], e[what])
    along = np.abs(turn) < ON_LINE  # on one line: no place of their own
    share = cross(q[what] - p[which], e[what]) / np.where(along, 1.0, turn)
    return which, np.where(along, 0.0, share)


def _areas(start: Points, along: Points, to: Points) -> Floats:
    """Areas of some lines with points, shape (lines, points)."""
    # copies lie side by side in memory, which halves the time
    x, y = to.real.copy() - start.real[:, None], to.imag.copy() - start.imag[:, None]
    found: Floats = along.real[:, None] * y - along.imag[:, None] * x
    return found
