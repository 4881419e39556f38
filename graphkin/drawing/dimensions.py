"""Dimensions, after ISO 129-1, of lengths and angles, and where there is room for them; and the bar that checks the
scale of a print.

A dimension keeps clear of the mechanism and of other dimensions; its extension lines begin beyond the symbols of the
points that they come from.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import CAP_HEIGHT, text_box
from graphkin.drawing.obstacles import Floats, Indices, Obstacles, Points, cross_product, meets
from graphkin.drawing.primitives import Arc, Line, Polygon, Run, Text, page_direction
from graphkin.drawing.symbols import POINTER, arrowhead
from graphkin.drawing.text import plain

__all__ = ["GAP", "OVERRUN", "DimensionClearance", "Part", "Parts", "angle_dimension", "check_bar", "dimension"]

OVERRUN, GAP = 1.5, 0.8  # extension lines reach past the dimension line and start off the object, mm
SHORT_ARC = 5.0  # mm of an arc that has no room for a number beside its middle
CLEAR = 0.7  # between a number and the line broken for it, mm
Part: TypeAlias = Line | Polygon | Arc | Text
Parts: TypeAlias = tuple[Part, ...]


def dimension(start: complex, end: complex, offset: float, runs: tuple[Run, ...]) -> Parts:
    """The distance of two points, its line ``offset`` mm to the right of the way from start to end (negative: left).

    The number stands upright in a gap of the line, or past its end where the line is too short for both.
    """
    along = (end - start) / abs(end - start)
    right = along * 1j
    a, b = start + offset * right, end + offset * right
    parts: list[Part] = []
    if offset:
        away = right * math.copysign(1.0, offset)
        parts += [Line(p + GAP * away, q + OVERRUN * away, strokes.DIMENSION) for p, q in ((start, a), (end, b))]
    length = abs(b - a)
    text = _centred(runs, (a + b) / 2)
    gap = text_box(text).grown(CLEAR).clip_line((a + b) / 2, along)
    head = POINTER.head_length
    if gap is not None and abs(gap[1] - gap[0]) + 2 * head + 1.0 <= length:
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
TRIM, LEAST_EXTENSION = 0.8, 2.2  # mm between a symbol and an extension line; a shorter one is none


class DimensionClearance:
    """What is drawn already, as arrays: segments, and boxes by their middle and half size."""

    def __init__(self, obstacles: Obstacles, panel: Box | None) -> None:
        self.panel = panel
        self.segments = np.array(obstacles.solid, dtype=complex).reshape(-1, 2)
        self.middles, self.halves = _arrays(obstacles.areas)
        self.numbers = _arrays(())  # of dimensions, over which nothing runs
        self.heads = _arrays(())  # arrowheads of dimensions, over which extension lines of others may run
        corners = [z for box in obstacles.areas for z in box.corners] + [z for s in obstacles.solid for z in s]
        self.content = Box.around(corners) if corners else Box(0, 0, 0, 0)

    def take(
        self, parts: Parts, extensions: int = 2, over: bool = False, ends_on_line: bool = False, crossing: bool = False
    ) -> Parts | None:
        """The dimension, added to what is drawn, if it is clear of everything; None if not.

        Its first lines are extension lines: they begin beyond what stands around the point they come from, and run
        over other lines where that is allowed.  The arrowhead of an angle ends on a line that is drawn, and its arc
        may run over what is drawn where it is given leave to (``crossing``), its number not.
        """
        numbers = [text_box(part) for part in parts if isinstance(part, Text)]
        heads = [Box.around(part.points) for part in parts if isinstance(part, Polygon)]
        boxes = numbers if ends_on_line else [*numbers, *heads]
        if self.panel is not None and not all(self.panel.holds(box) for box in (*numbers, *heads)):
            return None
        middles, halves = _arrays(boxes)
        if self._covered(middles, halves):
            return None
        lines = [part for part in parts if isinstance(part, Line)]
        ends = [(line.start, line.end) for line in lines[extensions:]]
        for arc in (part for part in parts if isinstance(part, Arc)):
            course = [arc.at(arc.start + (arc.end - arc.start) * (0.06 + 0.11 * i)) for i in range(9)]
            ends += pairwise(course)
        own = np.array(ends, dtype=complex).reshape(-1, 2)
        if not crossing and (self._over_areas(own) or len(_crossings(own, self.segments)[0])):
            return None
        if not crossing and meets(own[:, None], self.heads[0][None], self.heads[1][None] + 0.4 * (1 + 1j)).any():
            return None
        trimmed = [self._trimmed(line) for line in lines[:extensions]]
        beyond = np.array([(line.start, line.end) for line in trimmed if line is not None], dtype=complex)
        if crossing:
            trimmed = [own_line or line for own_line, line in zip(trimmed, lines, strict=False)]
            beyond = np.array([(line.start, line.end) for line in trimmed if line is not None], dtype=complex)
        elif len(beyond) < extensions or (extensions and self._over_areas(beyond)):
            return None
        if extensions and not over and len(_crossings(beyond, self.segments)[0]):
            return None
        words, sizes = _arrays(numbers)
        lines_of_it = np.concatenate((own, beyond.reshape(-1, 2)))
        if meets(lines_of_it[:, None], words[None], sizes[None]).any():
            return None  # a number past the end of a short dimension stands on the next one
        spots, room = self.numbers[0][None], self.numbers[1][None] + 0.3 * (1 + 1j)
        if crossing and meets(lines_of_it[:, None], spots, room).any():
            return None
        self.numbers = np.concatenate((self.numbers[0], words)), np.concatenate((self.numbers[1], sizes))
        self.segments = np.concatenate((self.segments, lines_of_it))
        self.middles, self.halves = np.concatenate((self.middles, words)), np.concatenate((self.halves, sizes))
        more = _arrays(heads)
        self.heads = np.concatenate((self.heads[0], more[0])), np.concatenate((self.heads[1], more[1]))
        kept = tuple(line for line in trimmed if line is not None)
        return *kept, *(part for part in parts if not any(part is line for line in lines[:extensions]))

    def _covered(self, middles: Points, halves: Points) -> bool:
        """Whether boxes meet anything."""
        grown = halves[:, None] + 0.5 * (1 + 1j)
        taken, sizes = np.concatenate((self.middles, self.heads[0])), np.concatenate((self.halves, self.heads[1]))
        off, reach = middles[:, None] - taken, grown + sizes
        if ((np.abs(off.real) < reach.real) & (np.abs(off.imag) < reach.imag)).any():
            return True
        return bool(meets(self.segments[None], middles[:, None], grown).any())

    def _over_areas(self, segments: Points) -> bool:
        return bool(meets(segments[:, None], self.middles[None], self.halves[None] + 0.4 * (1 + 1j)).any())

    def _trimmed(self, line: Line) -> Line | None:
        """An extension line from where nothing of its own point is in its way; None where too little is left."""
        length = abs(line.end - line.start)
        along = (line.end - line.start) / length
        near = np.array([(line.start, line.start + AROUND_POINT * along)])
        start = max((*_crossings(near, self.segments)[1], *self._left(near)), default=-TRIM)
        start = AROUND_POINT * start + TRIM if start > 0 else 0.0
        return replace(line, start=line.start + start * along) if start < length - LEAST_EXTENSION else None

    def _left(self, near: Points) -> list[float]:
        """Where the way ``near`` from a point leaves the symbols on it, as shares of its length."""
        start, end = complex(near[0, 0]), complex(near[0, 1])
        reach = self.halves + 0.4 * (1 + 1j)
        met = np.flatnonzero(meets(near, self.middles, reach))
        boxes = (
            Box.around((complex(z - half), complex(z + half)))
            for z, half in zip(self.middles[met], reach[met], strict=True)
        )
        chords = (box.clip(start, end) for box in boxes)
        return [abs(chord[1] - start) / AROUND_POINT for chord in chords if chord is not None]


def _arrays(boxes: Sequence[Box]) -> tuple[Points, Points]:
    """Middles and half sizes of boxes."""
    sizes = [complex(box.width, box.height) / 2 for box in boxes]
    return np.array([box.centre for box in boxes], dtype=complex), np.array(sizes, dtype=complex)


def _sign(area: Floats) -> Floats:
    """On which side a point lies: 0 where it is on the line but for rounding."""
    return np.where(np.abs(area) < 1e-9, 0.0, np.sign(area))


def _crossings(own: Points, others: Points) -> tuple[Indices, Floats]:
    """Which of some segments cross others, and at which share of their length."""
    p, d = own[:, None, 0], own[:, None, 1] - own[:, None, 0]
    q, e = others[None, :, 0], others[None, :, 1] - others[None, :, 0]
    one = _sign(cross_product(d, q - p)) * _sign(cross_product(d, q + e - p))
    other = _sign(cross_product(e, p - q)) * _sign(cross_product(e, p + d - q))
    crossing = (one <= 0) & (other <= 0)
    which, what = np.nonzero(crossing)
    turn = cross_product(d[which, 0], e[0, what])
    along = np.abs(turn) < 1e-9  # on one line: no place of their own
    share = cross_product(q[0, what] - p[which, 0], e[0, what]) / np.where(along, 1.0, turn)
    return which, np.where(along, 0.0, share)
