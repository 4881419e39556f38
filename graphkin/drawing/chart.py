"""Charts in millimetres of the page: axes with ticks, curves, markers, a legend, labels placed clear of everything.

Everything is told by dash and shape of marker, so that black on white is enough.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.obstacles import Obstacles, obstacles_of
from graphkin.drawing.placing import Label, place
from graphkin.drawing.primitives import Circle, Group, Line, Polygon, Polyline, Primitive, Stroke, Text
from graphkin.drawing.text import rich, runs_width

__all__ = [
    "SOLID_AND_DASHED",
    "Axis",
    "Chart",
    "Curve",
    "Marks",
    "chart_group",
    "degree_axis",
    "legend",
    "linear_axis",
    "log_axis",
    "marker",
]

Shape = Literal["circle", "disc", "up", "down", "square", "diamond", "cross"]

FRAME = Stroke(0.25)
GRID = Stroke(0.1, colour="#b8b8b8")
ZERO = Stroke(0.18)
TICK = 1.2  # mm
NUMBER, TITLE = 2.5, 3.0  # letters, mm
MARKER = 0.85  # half of a marker, mm

# Kinds of curve in the order of use: told apart without colour.
SOLID_AND_DASHED: tuple[Stroke, ...] = (
    Stroke(0.45),
    Stroke(0.45, (3.0, 1.2)),
    Stroke(0.45, (0.9, 0.9)),
    Stroke(0.45, (4.0, 1.0, 0.9, 1.0)),
    Stroke(0.25),
    Stroke(0.25, (3.0, 1.2)),
    Stroke(0.25, (0.9, 0.9)),
    Stroke(0.25, (4.0, 1.0, 0.9, 1.0)),
)


@dataclass(frozen=True)
class Axis:
    """A scale: range, ticks with the words at them, a title (markup of ``typeset.rich``)."""

    low: float
    high: float
    ticks: tuple[tuple[float, str], ...]
    title: str = ""
    log: bool = False

    def share(self, value: float) -> float:
        """Where a value lies, from 0 at the low end to 1 at the high end."""
        if self.log:
            return (math.log10(value) - math.log10(self.low)) / (math.log10(self.high) - math.log10(self.low))
        return (value - self.low) / (self.high - self.low)


@dataclass(frozen=True)
class Curve:
    """Points joined by a line; a point that is not finite breaks it."""

    x: Sequence[float]
    y: Sequence[float]
    stroke: Stroke = SOLID_AND_DASHED[0]


@dataclass(frozen=True)
class Marks:
    """Markers at points, each with a label or "" (markup)."""

    x: Sequence[float]
    y: Sequence[float]
    shape: Shape = "circle"
    labels: Sequence[str] = ()
    colour: str = strokes.BLACK


@dataclass(frozen=True)
class Chart:
    """Curves and markers over one pair of axes; ``panel`` is the area between the axes on the page (mm)."""

    panel: Box
    x: Axis
    y: Axis
    curves: tuple[Curve, ...] = ()
    marks: tuple[Marks, ...] = ()
    x_words: bool = True
    id: str = ""
    title: str = ""

    def at(self, x: float, y: float) -> complex:
        """Where a point lies on the page."""
        return complex(
            self.panel.left + self.x.share(x) * self.panel.width,
            self.panel.bottom - self.y.share(y) * self.panel.height,
        )


def linear_axis(low: float, high: float, title: str = "", most: int = 6, margin: float = 0.08) -> Axis:
    """An axis over a range of values, with a margin, and ticks of the series 1, 2, 2.5, 5."""
    wide = high - low
    if not wide > 1e-12 * max(abs(low), abs(high)):
        wide = abs(high) or 1.0
        low, high = low - wide / 2, high + wide / 2
    low, high = low - margin * wide, high + margin * wide
    step = next_step((high - low) / most)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    if step * 10**decimals % 1 > 1e-9:
        decimals += 1
    ticks = tuple((k * step, written(k * step, decimals, step)) for k in range(first, last + 1))
    return Axis(low, high, ticks, title)


def next_step(least: float) -> float:
    """The next number of the series 1, 2, 2.5, 5 times a power of ten.

    >>> next_step(0.21), next_step(60)
    (0.25, 100.0)
    """
    power = 10.0 ** math.floor(math.log10(least))
    return next(m * power for m in (1.0, 2.0, 2.5, 5.0, 10.0) if m * power >= least * (1 - 1e-9))


def written(value: float, decimals: int, step: float) -> str:
    """A number at a tick: plain where that is short, else with a power of ten."""
    if abs(value) < step * 1e-6:
        return "0"
    if step >= 1e-3 and abs(value) < 1e6:
        return f"{value:.{decimals}f}".replace("-", "−")
    power = math.floor(math.log10(abs(value)) + 1e-12)
    digits = f"{value / 10.0**power:.3g}".replace("-", "−")
    raised = str(power).replace("-", "−")
    return f"{digits}·$10^{{{raised}}}$"


def degree_axis(low: float, high: float, title: str = "", most: int = 13) -> Axis:
    """An axis of angles in degrees, ticks at 30, 45, 60, 90 or at parts of them."""
    wide = high - low
    step = next((s for s in (1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0) if wide / s <= most), 360.0)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    ticks = tuple((k * step, f"{k * step:g}".replace("-", "−")) for k in range(first, last + 1))
    return Axis(low, high, ticks, title)


def log_axis(low: float, high: float, title: str = "", most: int = 9) -> Axis:
    """An axis of powers of ten over a range of positive values."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    last = max(last, first + 1)
    every = max(1, math.ceil((last - first) / most))
    ticks = tuple((10.0**k, f"$10^{{{str(k).replace('-', '−')}}}$") for k in range(first, last + 1, every))
    return Axis(10.0**first, 10.0**last, ticks, title, log=True)


def marker(at: complex, shape: Shape, colour: str = strokes.BLACK) -> Primitive:
    """One marker: open circle, disc, triangle up or down, square, diamond, or a cross."""
    r = MARKER
    if shape in ("circle", "disc"):
        line = Stroke(0.25, colour=colour)
        return Circle(at, r, fill=strokes.WHITE if shape == "circle" else colour, stroke=line)
    corners = {
        "up": (-1j * r, r + 0.8j * r, -r + 0.8j * r),
        "down": (1j * r, r - 0.8j * r, -r - 0.8j * r),
        "square": (-r - 1j * r, r - 1j * r, r + 1j * r, -r + 1j * r),
        "diamond": (-1.2j * r, 1.2 * r, 1.2j * r, -1.2 * r),
    }
    if shape == "cross":
        line = Stroke(0.25, colour=colour)
        return Group((Line(at - r - 1j * r, at + r + 1j * r, line), Line(at - r + 1j * r, at + r - 1j * r, line)))
    return Polygon(tuple(complex(at + c) for c in corners[shape]), fill=colour)


def chart_group(chart: Chart) -> Group:
    """A chart as one group: grid, axes, curves, markers, labels."""
    axes = _axes(chart)
    lines: list[Primitive] = []
    for curve in chart.curves:
        lines += [Polyline(part, curve.stroke) for part in _parts(chart, curve)]
    dots: list[Primitive] = []
    wishes: list[Label] = []
    for marks in chart.marks:
        for k, (x, y) in enumerate(zip(marks.x, marks.y, strict=True)):
            at = chart.at(x, y)
            dots.append(marker(at, marks.shape, marks.colour))
            words = marks.labels[k] if k < len(marks.labels) else ""
            if words:
                up = marks.shape != "down"
                text = Text(0j, rich(words, NUMBER), colour=marks.colour)
                wishes.append(Label(text, at, ((math.pi / 2 if up else -math.pi / 2),)))
    in_the_way = obstacles_of((*lines, *dots)) + Obstacles(solid=_edges(chart.panel))
    placed = place(wishes, chart.panel, in_the_way)
    labels: list[Primitive] = []
    for label in placed:
        labels += [label.text] + ([label.leader] if label.leader is not None else [])
    children = (Group(axes, classes=("axes",)), Group((*lines, *dots), classes=("curves",)),
                Group(tuple(labels), classes=("labels",)))
    return Group(children, id=chart.id, title=chart.title)


def legend(at: complex, entries: Sequence[tuple[Stroke | Shape, str]], gap: float = 6.0) -> tuple[Primitive, ...]:
    """A legend in one line: a piece of each curve or a marker, and its words (markup); ``at`` is its left end."""
    made: list[Primitive] = []
    x = at.real
    for kind, words in entries:
        middle = complex(x + 4.0, at.imag)
        if isinstance(kind, Stroke):
            made.append(Line(complex(x, at.imag), complex(x + 8.0, at.imag), kind))
        else:
            middle = complex(x + 1.5, at.imag)
            made.append(marker(middle, kind))
        start = x + (9.5 if isinstance(kind, Stroke) else 4.0)
        runs = rich(words, TITLE)
        made.append(Text(complex(start, at.imag + 0.33 * TITLE), runs))
        x = start + runs_width(runs) + gap
    return tuple(made)


def _edges(box: Box) -> tuple[tuple[complex, complex], ...]:
    a, b, c, d = box.corners
    return (a, b), (b, c), (c, d), (d, a)


def _axes(chart: Chart) -> tuple[Primitive, ...]:
    panel = chart.panel
    made: list[Primitive] = []
    for value, _ in chart.x.ticks:
        x = chart.at(value, chart.y.low).real
        made.append(Line(complex(x, panel.top), complex(x, panel.bottom), GRID))
    for value, _ in chart.y.ticks:
        y = chart.at(chart.x.low, value).imag
        zero = value == 0 and not chart.y.log
        made.append(Line(complex(panel.left, y), complex(panel.right, y), ZERO if zero else GRID))
    made += [Line(start, end, FRAME) for start, end in _edges(panel)]
    for value, words in chart.x.ticks:
        x = chart.at(value, chart.y.low).real
        made.append(Line(complex(x, panel.bottom), complex(x, panel.bottom - TICK), FRAME))
        if chart.x_words:
            below = 1.2 + NUMBER * 0.8 + (0.8 if chart.x.log else 0.0)  # exponents stand clear of the other axis
            made.append(Text(complex(x, panel.bottom + below), rich(words, NUMBER), "middle"))
    for value, words in chart.y.ticks:
        y = chart.at(chart.x.low, value).imag
        made.append(Line(complex(panel.left, y), complex(panel.left + TICK, y), FRAME))
        made.append(Text(complex(panel.left - 1.2, y + 0.33 * NUMBER), rich(words, NUMBER), "end"))
    if chart.y.title:
        made.append(Text(complex(panel.left, panel.top - 1.8), rich(chart.y.title, TITLE)))
    if chart.x.title and chart.x_words:
        made.append(
            Text(complex(panel.right, panel.bottom + 3.0 + NUMBER + TITLE * 0.8), rich(chart.x.title, TITLE), "end")
        )
    return tuple(made)


def _parts(chart: Chart, curve: Curve) -> list[tuple[complex, ...]]:
    """The stretches of a curve between the points where it is broken, cut off at the panel."""
    parts: list[list[complex]] = [[]]
    last: complex | None = None
    for x, y in zip(curve.x, curve.y, strict=True):
        here = chart.at(x, y) if math.isfinite(x) and math.isfinite(y) else None
        seen = chart.panel.grown(1e-6).clip(last, here) if here is not None and last is not None else None
        if seen is None:
            if parts[-1]:
                parts.append([])
        else:
            if not parts[-1] or abs(parts[-1][-1] - seen[0]) > 1e-9:
                parts.append([seen[0]])
            parts[-1].append(seen[1])
        last = here
    return [tuple(part) for part in parts if len(part) > 1]
