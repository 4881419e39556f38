"""Dimensions, after ISO 129-1, of lengths and angles, and where there is room for them; and the bar that checks the
scale of a print.

A dimension keeps clear of the mechanism and of other dimensions; its extension lines begin beyond the symbols of the
points that they come from.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import CAP_HEIGHT, text_box
from graphkin.drawing.obstacles import Flags, Floats, Indices, Obstacles, Points, cross_product, meets
from graphkin.drawing.primitives import Arc, Line, Polygon, Run, Text, page_direction
from graphkin.drawing.symbols import POINTER, arrowhead
from graphkin.drawing.text import plain

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
ON_LINE = 1e-9  # mm²: a smaller area with a line is rounding
TRIM, LEAST_EXTENSION = 0.8, 2.2  # mm between a symbol and an extension line; a shorter one is none


class _Fit(NamedTuple):
    """A dimension clear of what is drawn: its parts, its lines, the boxes of its numbers and of its arrowheads, and
    whether its extension lines run over other lines."""

    parts: Parts
    lines: Points
    numbers: tuple[Points, Points]
    heads: tuple[Points, Points]
    over: bool


class DimensionClearance:
    """What is drawn already, as arrays: segments, and boxes by their middle and half size."""

    def __init__(self, obstacles: Obstacles, panel: Box | None) -> None:
        self.panel = panel
        self.segments = np.array(obstacles.solid, dtype=complex).reshape(-1, 2)
        self.dashed = np.array(obstacles.dashed, dtype=complex).reshape(-1, 2)
        self.areas = _arrays(obstacles.areas)
        self.numbers = _arrays(())  # of dimensions, over which nothing runs
        self.heads = _arrays(())  # arrowheads of dimensions, over which extension lines of others may run
        self.taken = self.areas  # with all of these
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
        second = None
        for parts in choices:
            fit = self._fit(parts, extensions, ends_on_line, crossing, over_lines)
            if fit is not None and (over or not fit.over):
                return self._added(fit)
            second = second or fit
        return self._added(second) if second is not None else None

    def _added(self, fit: _Fit) -> Parts:
        self.segments = np.concatenate((self.segments, fit.lines))
        self.areas, self.numbers = _joined(self.areas, fit.numbers), _joined(self.numbers, fit.numbers)
        self.heads = _joined(self.heads, fit.heads)
        self.taken = _joined(self.areas, self.heads)
        return fit.parts

    def _fit(
        self, parts: Parts, extensions: int, ends_on_line: bool, crossing: bool, over_lines: bool
    ) -> _Fit | None:
        """The dimension with its extension lines trimmed, if it is clear of everything they may not run over."""
        numbers = [text_box(part) for part in parts if isinstance(part, Text)]
        heads = [Box.around(part.points) for part in parts if isinstance(part, Polygon)]
        if self.panel is not None and not all(self.panel.holds(box) for box in (*numbers, *heads)):
            return None
        words, tips = _arrays(numbers), _arrays(heads)
        if self._covered(*(words if ends_on_line or over_lines else _joined(words, tips))):
            return None
        lines = [part for part in parts if isinstance(part, Line)]
        ends = [(line.start, line.end) for line in lines[extensions:]]
        for arc in (part for part in parts if isinstance(part, Arc)):
            course = [arc.at(arc.start + (arc.end - arc.start) * (0.06 + 0.11 * i)) for i in range(9)]
            if self.panel is not None and not self.panel.holds(Box.around(course).grown(0.5)):
                return None
            ends += pairwise(course)
        own = _segments(ends)
        middles, halves = self.areas
        large = np.hypot(halves.real, halves.imag) > ARROWHEAD if over_lines else slice(None)
        symbols = middles[large], halves[large]
        if not crossing and _over(own, symbols, 0.4):
            return None
        if over_lines and self._on_areas(*tips):
            return None
        if not (crossing or over_lines) and len(_crossings(own, self.segments)[0]):
            return None
        if not crossing and _over(own, self.heads, 0.4):
            return None
        trimmed = self._trimmed(lines[:extensions])
        if crossing:
            trimmed = [kept or line for kept, line in zip(trimmed, lines, strict=False)]
        shown = [line for line in trimmed if line is not None]
        beyond = _segments([(line.start, line.end) for line in shown])
        if not crossing and (len(shown) < extensions or _over(beyond, symbols, 0.4)):
            return None
        lines_of_it = np.concatenate((own, beyond))
        if _over(lines_of_it, words, 0.0):
            return None  # a number past the end of a short dimension stands on the next one
        if crossing and _over(lines_of_it, self.numbers, 0.3):
            return None
        kept_parts = *shown, *(part for part in parts if not any(part is line for line in lines[:extensions]))
        over = len(_crossings(beyond, self.segments)[0]) > 0 or _over(self.dashed, words, 0.3)
        return _Fit(kept_parts, lines_of_it, words, tips, over)

    def _covered(self, middles: Points, halves: Points) -> bool:
        """Whether boxes meet anything."""
        grown = halves[:, None] + 0.5 * (1 + 1j)
        return self._on_areas(middles, halves) or bool(meets(self.segments[None], middles[:, None], grown).any())

    def _on_areas(self, middles: Points, halves: Points) -> bool:
        """Whether boxes meet symbols, numbers or arrowheads."""
        taken, sizes = self.taken
        off, reach = middles[:, None] - taken, halves[:, None] + 0.5 * (1 + 1j) + sizes
        return bool(((np.abs(off.real) < reach.real) & (np.abs(off.imag) < reach.imag)).any())

    def _trimmed(self, lines: Sequence[Line]) -> list[Line | None]:
        """Extension lines, each from where nothing of its own point is in its way; None where too little is left."""
        lengths = [abs(line.end - line.start) for line in lines]
        ways = [(line.end - line.start) / length for line, length in zip(lines, lengths, strict=True)]
        near = _segments([(line.start, line.start + AROUND_POINT * way) for line, way in zip(lines, ways, strict=True)])
        starts = [-TRIM] * len(lines)
        which, shares = _crossings(near, self.segments)
        for i, share in zip(which.tolist(), shares.tolist(), strict=True):
            starts[i] = max(starts[i], share)
        # the symbols on the point end where the line leaves their boxes
        middles, reach = self.areas[0], self.areas[1] + 0.4 * (1 + 1j)
        which, what = meets(near[:, None], middles, reach).nonzero()
        if len(which):
            low, high = (middles[what] - reach[what]).tolist(), (middles[what] + reach[what]).tolist()
            for i, corners in zip(which.tolist(), zip(low, high, strict=True), strict=True):
                chord = Box.around(corners).clip(lines[i].start, lines[i].start + AROUND_POINT * ways[i])
                if chord is not None:
                    starts[i] = max(starts[i], abs(chord[1] - lines[i].start) / AROUND_POINT)
        found: list[Line | None] = []
        for line, length, way, share in zip(lines, lengths, ways, starts, strict=True):
            start = AROUND_POINT * share + TRIM if share > 0 else 0.0
            kept = start < length - LEAST_EXTENSION
            found.append(replace(line, start=line.start + start * way) if kept else None)
        return found


def _over(segments: Points, boxes: tuple[Points, Points], space: float) -> bool:
    """Whether any of some segments comes nearer to a box than a space (mm)."""
    return bool(meets(segments[:, None], boxes[0], boxes[1] + space * (1 + 1j)).any())


def _segments(ends: Sequence[tuple[complex, complex]]) -> Points:
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
    p, d = own[:, None, 0], own[:, None, 1] - own[:, None, 0]
    q, e = others[None, :, 0], others[None, :, 1] - others[None, :, 0]
    away = q - p
    crossing = _either_side(cross_product(d, away), cross_product(d, q + e - p))
    crossing &= _either_side(cross_product(e, -away), cross_product(e, p + d - q))
    which, what = crossing.nonzero()
    if not len(which):
        return which, np.empty(0)
    turn = cross_product(d[which, 0], e[0, what])
    along = np.abs(turn) < ON_LINE  # on one line: no place of their own
    share = cross_product(q[0, what] - p[which, 0], e[0, what]) / np.where(along, 1.0, turn)
    return which, np.where(along, 0.0, share)
