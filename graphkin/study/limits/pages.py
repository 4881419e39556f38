"""The laws drawn: six panels a page, error against distance, slopes on the curves, below each where methods stop."""

from __future__ import annotations

import math
from collections.abc import Sequence

from graphkin.drawing import Box, Drawing, Group, Primitive, Stroke, Text
from graphkin.drawing.chart import SOLID_AND_DASHED, Chart, Curve, Marks, Shape, chart_group, legend, log_axis
from graphkin.drawing.layout import wrapped
from graphkin.drawing.placing import Label
from graphkin.drawing.text import rich
from graphkin.study.beside import placed_beside
from graphkin.study.limits.law import Law, Trial
from graphkin.words import say, word

__all__ = ["pages"]

WIDTH, HEIGHT = 210.0, 297.0
LEFT, TOP = 10.0, 38.0
CELL = complex(98.0, 85.0)
PLOT = complex(78.0, 54.0)
INDENT = 13.0
PER_PAGE = 6
LETTERS = 2.5
DOTS: dict[str, Shape] = {"Newton": "circle", "drawing": "cross", "drawn": "cross", "pencil": "up"}
"""Methods whose points are marked: by a word of the law's key."""
LOW, HIGH = 1e-17, 1e2


def pages(trials: Sequence[Trial], language: str = "en") -> dict[str, Drawing]:
    """The trials on pages of six, by name: "stability", and "stability-2" for the next."""
    made = {}
    for k in range(0, len(trials), PER_PAGE):
        name = "stability" if k == 0 else f"stability-{k // PER_PAGE + 1}"
        made[name] = _page(trials[k : k + PER_PAGE], language)
    return made


def _page(trials: Sequence[Trial], language: str) -> Drawing:
    title = word("stability title", language)
    facts = word("stability facts", language)
    head: tuple[Primitive, ...] = (
        Text(complex(LEFT, 14.0), rich(title, 5.0, bold=True)),
        Text(complex(LEFT, 20.0), rich(facts, 3.0)),
        *legend(complex(LEFT, 26.0), [
            (DOTS["Newton"], word("newton marks", language)),
            (DOTS["drawing"], word("drawing marks", language)),
            (DOTS["pencil"], word("pencil marks", language)),
            ("square", word("stop marks", language)),
        ]),
    )  # fmt: skip
    cells: list[Primitive] = []
    for k, trial in enumerate(trials):
        corner = complex(LEFT + (k % 2) * CELL.real, TOP + (k // 2) * CELL.imag)
        cells.append(_cell(trial, corner, language))
    if len(trials) % 2:
        cells.append(_lesson(complex(LEFT + CELL.real, TOP + (len(trials) // 2) * CELL.imag), language))
    told = "; ".join(word(t.key, language) for t in trials)
    return Drawing(
        WIDTH, HEIGHT, (Group(head, id="heading"), *cells), title=title, desc=f"{facts}: {told}", lang=language,
        metadata={"study": "stability", "singularities": [t.key for t in trials]},
    )  # fmt: skip


def _cell(trial: Trial, corner: complex, language: str) -> Group:
    panel = Box(corner.real + INDENT, corner.imag + 6.0, corner.real + INDENT + PLOT.real, corner.imag + 6 + PLOT.imag)
    shown = [e for law in trial.laws for e in law.error if math.isfinite(e) and e > 0]
    y_axis = log_axis(max(min(shown) / 2, LOW), min(max(shown) * 2, HIGH), most=9)
    xs = [x for law in trial.laws for x in law.x]
    x_axis = log_axis(min(xs) * 1.001, max(xs) * 0.999, f"{word(trial.distance, language)}", most=8)
    curves, marks, wishes = [], [], []
    for law, stroke in zip(trial.laws, _strokes(trial.laws), strict=True):
        points = [(x, max(e, y_axis.low)) for x, e in zip(law.x, law.error, strict=True) if math.isfinite(e)]
        points = [(x, e) for x, e in points if e <= y_axis.high]
        if stroke is not None and not _repeated(trial.laws, law):
            curves.append(Curve([x for x, _ in points], [e for _, e in points], stroke))
        shape = _dot(law)
        if shape is not None:
            some = points[:: 1 if len(points) < 12 else 2]
            marks.append(Marks([x for x, _ in some], [e for _, e in some], shape))
        if law.stops is not None and points:
            last = min(points, key=lambda p: p[0])
            marks.append(Marks([last[0]], [last[1]], "square"))
        wishes.append((law, points))
    chart = Chart(panel, x_axis, y_axis, tuple(curves), tuple(marks), id=f"trial-{trial.key.replace(' ', '-')}")
    drawn = chart_group(chart)
    labels = _labels(chart, wishes, drawn, language)
    words: list[Primitive] = [Text(complex(corner.real, corner.imag + 2.5), rich(word(trial.key, language), 3.2, True))]
    y = panel.bottom + 14.0
    for fate in trial.fates:
        for runs in wrapped(say(fate, language), LETTERS, CELL.real - 4.0):
            words.append(Text(complex(corner.real, y), runs))
            y += 3.3
    return Group((drawn, *labels, *words), id=chart.id, title=word(trial.key, language))


def _lesson(corner: complex, language: str) -> Group:
    """What to take from all of it, in the place that is left."""
    lines: list[Primitive] = [Text(complex(corner.real, corner.imag + 2.5), rich(word("lesson", language), 3.2, True))]
    y = corner.imag + 10.0
    for key in ("lesson place", "lesson digits", "lesson pencil", "lesson centres", "lesson says"):
        for runs in wrapped(word(key, language), 3.0, CELL.real - 10.0):
            lines.append(Text(complex(corner.real, y), runs))
            y += 4.2
        y += 2.2
    return Group(tuple(lines), id="lesson")


def _strokes(laws: Sequence[Law]) -> list[Stroke | None]:
    """Lines for what is computed, each of its own kind; dots alone for what is only compared with these."""
    kinds = iter(SOLID_AND_DASHED)
    found: list[Stroke | None] = []
    by_key: dict[str, Stroke | None] = {}
    for law in laws:
        if law.key not in by_key:
            by_key[law.key] = None if _dot(law) in ("circle", "cross") else next(kinds)
        found.append(by_key[law.key])
    return found


def _dot(law: Law) -> Shape | None:
    return next((shape for part, shape in DOTS.items() if part in law.key), None)


def _repeated(laws: Sequence[Law], law: Law) -> bool:
    """Whether the same curve is drawn for an earlier law already (two branches of one curve)."""
    return next(i for i, other in enumerate(laws) if other.key == law.key) != laws.index(law)


def _labels(
    chart: Chart, wishes: Sequence[tuple[Law, Sequence[tuple[float, float]]]], drawn: Group, language: str
) -> list[Primitive]:
    """The name of each curve with its slope beside it."""
    asked: list[Label] = []
    for i, (law, points) in enumerate(wishes):
        inside = [p for p in points if law.window[0] <= p[0] <= law.window[1] and p[1] < law.lost]
        inside = inside if len(inside) > 1 else list(points)
        if not inside:
            continue
        k = len(inside) * (len(wishes) - i) // (len(wishes) + 1)  # each at another height, for those that lie together
        near = inside[max(k - 1, 0) : k + 2]
        ends = chart.at(*near[0]), chart.at(*near[-1])
        asked.append(Label(Text(0j, rich(_words(law, language), LETTERS)), ends))
    return placed_beside(chart, drawn, asked)


def _words(law: Law, language: str) -> str:
    name = word(law.key, language)
    if law.theory is None or math.isnan(law.slope):
        return name
    slope = f"{law.slope + 0.0:.2f}".replace("-0.00", "0.00").replace("-", "−")
    theory = {-0.5: "−1/2"}.get(law.theory, f"{law.theory:g}".replace("-", "−"))
    return f"{name}  {slope} ({theory})"
