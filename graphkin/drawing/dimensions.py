"""Given sizes drawn as dimensions, after ISO 129-1, and the bar that checks the scale of a print."""

from __future__ import annotations

import math

from graphkin.drawing import strokes
from graphkin.drawing.arrows import POINTER, arrowhead
from graphkin.drawing.metrics import CAP_HEIGHT, text_box
from graphkin.drawing.primitives import Arc, Line, Polygon, Run, Text, page_direction
from graphkin.drawing.typeset import plain

__all__ = ["GAP", "OVERRUN", "angle_dimension", "check_bar", "dimension"]

OVERRUN, GAP = 1.5, 0.8  # extension lines reach past the dimension line and start off the object, mm
CLEAR = 0.7  # between a number and the line broken for it, mm

Part = Line | Polygon | Arc | Text


def dimension(start: complex, end: complex, offset: float, runs: tuple[Run, ...]) -> tuple[Part, ...]:
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
    centre: complex, radius: float, start: float, end: float, runs: tuple[Run, ...]
) -> tuple[Part, ...]:
    """The angle from one direction to another (rad) about a point: an arc with an arrowhead at ``end``, its number
    outside the middle of the arc."""
    sense = math.copysign(1.0, end - start)
    turn = min(POINTER.head_length / radius, abs(end - start) * 0.75)
    tip = centre + radius * page_direction(end)
    chord = tip - (centre + radius * page_direction(end - sense * turn))
    outward = page_direction((start + end) / 2)
    box = text_box(_centred(runs, 0j))
    reach = abs(outward.real) * box.width / 2 + abs(outward.imag) * box.height / 2
    return (
        Arc(centre, radius, start, end - sense * 0.6 * turn, strokes.DIMENSION),
        arrowhead(tip, chord, turn * radius, POINTER.head_width, strokes.BLACK),
        _centred(runs, centre + (radius + CLEAR + reach) * outward),
    )


def check_bar(at: complex, runs: tuple[Run, ...] = (), length: float = 50.0) -> tuple[Part, ...]:
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
