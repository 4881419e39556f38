"""Errors against the distance from a singular position: the power of the distance with which they grow, as a table, as
data for programs, and as charts, six panels a page, with slopes on the curves, and below each the distances where
methods stop."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from graphkin.drawing import Box, Stroke, Text, chart
from graphkin.drawing.text import rich, wrapped
from graphkin.files import Json
from graphkin.table import Table
from graphkin.words import Phrase, rich_text, say, word
from graphkin.words.symbols import Words
from graphkin.words.written import printed, true_minus

LOST = 0.03  # an error beyond this (relative, rad) is no longer of first order and tells no slope
PER_DECADE = 2


# what is measured


@dataclass(frozen=True)
class ErrorLaw:
    """The growth of the error of a method.

    key : word for the method and its quantity
    x : distances from the singular position, falling
    error : the largest error at each, nan where the method gives no answer
    theory : the slope by theory, None without a law
    warns_from : from this distance down the method itself calls its answer uncertain, or refuses (None: never)
    refuses_from : from this distance down it gives no answer (None: it always does)
    bound : the error that the method states itself, at each distance; nan where it states none
    window : least and largest distance over which the slope is fitted
    lost : an error beyond this is no longer of first order and does not count for the slope
    """

    key: str
    x: tuple[float, ...] = ()
    error: tuple[float, ...] = ()
    theory: float | None = None
    warns_from: float | None = None
    refuses_from: float | None = None
    bound: tuple[float, ...] = ()
    window: tuple[float, float] = (0.0, math.inf)
    lost: float = LOST

    @property
    def slope(self) -> float:
        """Slope of log error against log distance by least squares; nan for fewer than three points."""
        low, high = self.window
        points = [
            (math.log10(x), math.log10(e))
            for x, e in zip(self.x, self.error, strict=True)
            if low <= x <= high and 0.0 < e < self.lost
        ]
        if len(points) < 3:
            return math.nan
        a, b = np.array(points).T
        return float(np.polyfit(a, b, 1)[0])

    @property
    def worst(self) -> float:
        """The largest error where there is an answer."""
        return max((e for e in self.error if math.isfinite(e)), default=math.nan)

    @property
    def best(self) -> float:
        """The least error."""
        return min((e for e in self.error if math.isfinite(e)), default=math.nan)

    def near(self, x: float) -> float:
        """The error at the answered distance next to ``x``."""
        answers = [(abs(math.log(at / x)), e) for at, e in zip(self.x, self.error, strict=True) if math.isfinite(e)]
        return min(answers, default=(0.0, math.nan))[1]


@dataclass(frozen=True)
class Singularity:
    """A kind of singularity with the laws of all methods there.

    key : the word for it
    distance : the word for the axis
    laws : the growth of errors
    fates : the distances where methods stop, and their messages
    growth : the growth of the values themselves, if they grow
    """

    key: str
    distance: str
    laws: tuple[ErrorLaw, ...]
    fates: tuple[Phrase, ...] = ()
    growth: tuple[ErrorLaw, ...] = ()

    def __getitem__(self, key: str) -> ErrorLaw:
        return next(law for law in self.laws if law.key == key)


class Answer(NamedTuple):
    """The result of a method at a distance.

    errors : of each of its quantities; nan where it refuses
    warns : whether it calls its answer uncertain
    bounds : its own bound of the error of each, if it states one
    """

    errors: Sequence[float]
    warns: bool = False
    bounds: Sequence[float] = ()


def grid(first: float, last: float, samples: int) -> list[float]:
    """Distances falling from ``first`` to ``last``, with ``samples`` in each half of a decade."""
    count = max(1, round(abs(math.log10(last / first)) * PER_DECADE)) * samples
    return [first * (last / first) ** (k / count) for k in range(count + 1)]


def measured(
    laws: Sequence[ErrorLaw], x: Sequence[float], answers: Iterable[Answer], samples: int | None = None
) -> tuple[ErrorLaw, ...]:
    """The stated laws with the measured errors.

    Parameters
    ----------
    x : distances, falling
    answers : of the method at each of them, an error for every law
    samples : the number of neighbouring distances joined to one, with their largest error; None: each by itself
    """
    by_distance = list(answers)
    errors = zip(*(a.errors for a in by_distance), strict=True)
    bounds = zip(*(a.bounds or (math.nan,) * len(laws) for a in by_distance), strict=True)
    made = []
    for law, error, bound in zip(laws, errors, bounds, strict=True):
        refused = [math.isnan(value) for value in error]
        warned = [a.warns or no_answer for a, no_answer in zip(by_distance, refused, strict=True)]
        xs, es = _binned(x, error, samples)
        stated = _binned(x, bound, samples)[1]
        warns_from, refuses_from = (next((e for e, here in zip(x, at, strict=True) if here), None)
                                    for at in (warned, refused))
        made.append(replace(law, x=xs, error=es, warns_from=warns_from, refuses_from=refuses_from, bound=stated))
    return tuple(made)


def _binned(
    x: Sequence[float], error: Sequence[float], samples: int | None
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The largest error among each ``samples`` neighbouring distances, at their middle; rounding errors scatter."""
    if samples is None:
        return tuple(x), tuple(error)
    xs: list[float] = []
    es: list[float] = []
    for k in range(0, len(x), samples):
        near = x[k : k + samples]
        errors = [e for e in error[k : k + samples] if math.isfinite(e)]
        xs.append(float(np.exp(np.mean(np.log(near)))))
        es.append(max(errors) if len(errors) == len(near) else math.nan)
    return tuple(xs), tuple(es)


# in numbers


def in_powers(value: float) -> str:
    """A measured number to two figures.

    >>> in_powers(0.0123), in_powers(1.5e-8), in_powers(math.nan)
    ('0.012', '1.5·10⁻⁸', '–')
    """
    return printed(f"{value:.2g}") if math.isfinite(value) else "–"


def laws_table(singularities: Sequence[Singularity]) -> Table:
    """A row for each point of each law; without an error where the method refuses."""
    heads = ("singularity", "distance", "law", "x", "error", "slope", "theory", "warns_from", "refuses_from")
    rows = [
        (s.key, s.distance, law.key, x, error, law.slope, law.theory, law.warns_from, law.refuses_from)
        for s in singularities for law in (*s.laws, *s.growth) for x, error in zip(law.x, law.error, strict=True)
    ]
    return Table.of(heads, rows, ("", "", "", ".4g", ".3g", ".2f", ".3g", ".3g", ".3g"))


def to_json(singularities: Sequence[Singularity]) -> dict[str, Json]:
    """Slopes, theory, and the distances where each method warns and refuses; without ``nan``."""

    def of_law(law: ErrorLaw) -> dict[str, Json]:
        return {
            "law": law.key,
            "says": say(Phrase(law.key)),
            "slope": None if math.isnan(law.slope) else round(law.slope, 3),
            "theory": law.theory,
            "warns_from": law.warns_from,
            "refuses_from": law.refuses_from,
            "points": [[x, e if math.isfinite(e) else None] for x, e in zip(law.x, law.error, strict=True)],
        }

    return {
        "singularities": [
            {
                "kind": s.key,
                "distance": word(s.distance),
                "laws": [of_law(law) for law in (*s.laws, *s.growth)],
                "notes": [say(fate) for fate in s.fates],
            }
            for s in singularities
        ]
    }


def lessons(singularities: Sequence[Singularity]) -> tuple[Phrase, ...]:
    """The conclusions from the measured errors, each number taken from them; none for errors that were not measured."""
    by_key = {s.key: s for s in singularities}
    phrases = []
    if dead := by_key.get("dead point RRR"):
        lost, given = dead["acceleration closed form"], dead["all from the dead point"]
        phrases.append(Phrase("lesson place", lost=in_powers(lost.worst), given=in_powers(given.worst)))
    if (height := by_key.get("crossing height")) and (angle := by_key.get("angle near zero")):
        phrases.append(Phrase(
            "lesson digits",
            squares=in_powers(height["height by squares"].worst), heron=in_powers(height["height by Heron"].worst),
            arccos=in_powers(angle["angle by arccos"].worst), atan2=in_powers(angle["angle by atan2"].worst),
        ))
    if dead:
        pencil, doubles = dead["velocity pencil"], dead["velocity closed form"]
        at = next((x for x in pencil.x if x < 0.15), pencil.x[0])
        by_pencil, in_doubles = pencil.near(at), doubles.near(at)
        phrases.append(Phrase(
            "lesson pencil", times=in_powers(by_pencil / in_doubles), distance=in_powers(at),
            pencil=in_powers(by_pencil), doubles=in_powers(in_doubles),
        ))
    if lines := by_key.get("parallel lines"):
        place, through = lines["centre place pencil"], lines["centre velocity pencil"]
        phrases.append(Phrase("lesson centres", place=in_powers(place.worst), velocity=in_powers(through.worst)))
    if height and (rates := by_key.get("differences")):
        squares, differences = height["height by squares"].worst, rates["acceleration differences"].worst
        phrases.append(Phrase("lesson says", squares=in_powers(squares), differences=in_powers(differences)))
    return tuple(phrases)


# as charts

WIDTH, HEIGHT = 210.0, 297.0
LEFT, TOP = 10.0, 38.0
CELL = complex(98.0, 85.0)
PLOT = complex(78.0, 51.0)
INDENT = 13.0
PER_PAGE = 6
LETTERS = 2.5
DOTS: dict[str, chart.Shape] = {"Newton": "circle", "drawing": "cross", "drawn": "cross", "pencil": "up"}
"""Methods whose points are marked: by a word of the law's key."""
LOW, HIGH = 1e-17, 1e2


def stability_pages(singularities: Sequence[Singularity], language: str = "en") -> dict[str, chart.ChartPage]:
    """The singularities on pages of six, by name: "stability", and "stability-2" for the next."""
    pages = {}
    for k in range(0, len(singularities), PER_PAGE):
        name = "stability" if k == 0 else f"stability-{k // PER_PAGE + 1}"
        pages[name] = _page(singularities[k : k + PER_PAGE], singularities, language)
    return pages


def _page(shown: Sequence[Singularity], every: Sequence[Singularity], language: str) -> chart.ChartPage:
    """A page of some singularities, with the conclusions from ``every`` one in a free place."""
    title, facts = word("stability title", language), word("stability facts", language)
    corners = [complex(LEFT + (k % 2) * CELL.real, TOP + (k // 2) * CELL.imag) for k in range(PER_PAGE + 1)]
    marks: tuple[chart.Shape, ...] = (DOTS["Newton"], DOTS["drawing"], DOTS["pencil"], "square")

    def paint(figure: chart.Figure) -> None:
        heads = Text(complex(LEFT, 14.0), rich(title, 5.0, bold=True)), Text(complex(LEFT, 20.0), rich(facts, 3.0))
        chart.add_words(figure, *heads)
        keys = ("newton marks", "drawing marks", "pencil marks", "stop marks")
        legend = [(chart.marker(shape), word(key, language)) for shape, key in zip(marks, keys, strict=True)]
        chart.add_legend(figure, complex(LEFT, 25.2), legend)
        for singularity, corner in zip(shown, corners, strict=False):
            _draw(figure, singularity, corner, language)
        if len(shown) % 2:
            chart.add_words(figure, *_lesson(corners[len(shown)], every, language))

    names = word("list semicolon", language).join(word(s.key, language) for s in shown)
    return chart.ChartPage(
        WIDTH, HEIGHT, paint, title=title, desc=f"{facts}: {names}", lang=language,
        metadata={"study": "stability", "singularities": [s.key for s in shown]},
    )


def _draw(figure: chart.Figure, singularity: Singularity, corner: complex, language: str) -> None:
    """Draw the curves of a singularity, each with its name, and below them the distances where methods stop."""
    left, top = corner.real + INDENT, corner.imag + 6.0
    box = Box(left, top, left + PLOT.real, top + PLOT.imag)
    laws, panel = singularity.laws, f"singularity-{singularity.key.replace(' ', '-')}"
    axes = chart.add_panel(figure, box, panel, x_title=word(singularity.distance, language))
    errors = [e for law in laws for e in law.error if math.isfinite(e) and e > 0]
    xs = [x for law in laws for x in law.x]
    chart.count_powers(axes, "x", min(xs) * 1.001, max(xs) * 0.999, most=8)
    low, high = chart.count_powers(axes, "y", max(min(errors) / 2, LOW), min(max(errors) * 2, HIGH))
    labels = []
    first = {law.key: law for law in reversed(laws)}  # two branches of one curve have one line
    for k, (law, stroke) in enumerate(zip(laws, _strokes(laws), strict=True)):
        points = [(x, max(e, low)) for x, e in zip(law.x, law.error, strict=True) if math.isfinite(e)]
        points = [(x, e) for x, e in points if e <= high]
        if stroke is not None and law is first[law.key]:
            axes.plot([x for x, _ in points], [e for _, e in points], **chart.look(stroke))
        shape = _dot(law)
        if shape is not None:
            some = points[:: 1 if len(points) < 12 else 2]
            axes.plot([x for x, _ in some], [e for _, e in some], **chart.marker(shape))
        if law.refuses_from is not None and points:
            axes.plot(*([value] for value in min(points)), **chart.marker("square"))
        if points:
            labels.append((_label(law, language), _stretch(law, points, k, len(laws))))
    chart.add_labels(axes, labels, (chart.NUMBER, 2.3, 2.1, 2.0))
    fates = [runs for fate in singularity.fates for runs in wrapped(say(fate, language), LETTERS, CELL.real - 4.0)]
    chart.add_words(
        figure,
        Text(complex(corner.real, corner.imag + 2.5), rich(word(singularity.key, language), 3.2, True)),
        *(Text(complex(corner.real, box.bottom + 14.0 + 3.3 * k), runs) for k, runs in enumerate(fates)),
    )


def _stretch(
    law: ErrorLaw, points: Sequence[tuple[float, float]], k: int, laws: int
) -> tuple[tuple[float, float], tuple[float, float]]:
    """The piece of a curve with its name: for the k-th of some curves at a height of its own, since curves may lie
    together."""
    inside = [p for p in points if law.window[0] <= p[0] <= law.window[1] and p[1] < law.lost]
    inside = inside if len(inside) > 1 else list(points)
    middle = len(inside) * (laws - k) // (laws + 1)
    near = inside[max(middle - 3, 0) : middle + 4]
    return near[0], near[-1]


def _lesson(corner: complex, singularities: Sequence[Singularity], language: str) -> list[Text]:
    """Write the conclusions in the free place."""
    lines = [Text(complex(corner.real, corner.imag + 2.5), rich(word("lesson", language), 3.2, True))]
    y = corner.imag + 10.0
    for lesson in lessons(singularities):
        for runs in wrapped(say(lesson, language), 3.0, CELL.real - 10.0):
            lines.append(Text(complex(corner.real, y), runs))
            y += 4.2
        y += 2.2
    return lines


def _strokes(laws: Sequence[ErrorLaw]) -> list[Stroke | None]:
    """Lines for computed errors, each of its own kind; dots for errors that are only compared with these."""
    kinds = iter(chart.SOLID_AND_DASHED)
    by_key: dict[str, Stroke | None] = {}
    for law in laws:
        if law.key not in by_key:
            by_key[law.key] = None if _dot(law) in ("circle", "cross") else next(kinds)
    return [by_key[law.key] for law in laws]


def _dot(law: ErrorLaw) -> chart.Shape | None:
    return next((shape for part, shape in DOTS.items() if part in law.key), None)


def _label(law: ErrorLaw, language: str) -> Words:
    """The name of a law with its slope, and in brackets the slope by theory."""
    name = rich_text(Phrase(law.key), language)
    if law.theory is None or math.isnan(law.slope):
        return name
    slope = true_minus(f"{law.slope + 0.0:.2f}".replace("-0.00", "0.00"))
    theory = {-0.5: "−1/2"}.get(law.theory, true_minus(f"{law.theory:g}"))
    return name + f"  {slope} ({theory})"
