"""The laws drawn: six panels a page, error against distance, slopes on the curves, below each where methods stop."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from graphkin.drawing import Box, Stroke, Text
from graphkin.drawing.chart import (
    NUMBER,
    SOLID_AND_DASHED,
    ChartPage,
    Shape,
    add_labels,
    add_legend,
    add_panel,
    add_words,
    count_powers,
    look,
    marker,
)
from graphkin.drawing.text import rich, wrapped
from graphkin.study.stability.laws import ErrorLaw, Singularity, in_powers
from graphkin.words import Phrase, say, word
from graphkin.words.written import true_minus

if TYPE_CHECKING:
    from graphkin.drawing.chart import Figure

__all__ = ["lessons", "stability_pages"]

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


def stability_pages(found: Sequence[Singularity], language: str = "en") -> dict[str, ChartPage]:
    """The singularities on pages of six, by name: "stability", and "stability-2" for the next."""
    made = {}
    for k in range(0, len(found), PER_PAGE):
        name = "stability" if k == 0 else f"stability-{k // PER_PAGE + 1}"
        made[name] = _page(found[k : k + PER_PAGE], found, language)
    return made


def _page(found: Sequence[Singularity], every: Sequence[Singularity], language: str) -> ChartPage:
    """Some singularities, and what to take from ``every`` one where a place is left."""
    title, facts = word("stability title", language), word("stability facts", language)
    corners = [complex(LEFT + (k % 2) * CELL.real, TOP + (k // 2) * CELL.imag) for k in range(PER_PAGE + 1)]
    marks: tuple[Shape, ...] = (DOTS["Newton"], DOTS["drawing"], DOTS["pencil"], "square")

    def paint(figure: Figure) -> None:
        heads = Text(complex(LEFT, 14.0), rich(title, 5.0, bold=True)), Text(complex(LEFT, 20.0), rich(facts, 3.0))
        add_words(figure, *heads)
        keys = ("newton marks", "drawing marks", "pencil marks", "stop marks")
        told = [(marker(shape), word(key, language)) for shape, key in zip(marks, keys, strict=True)]
        add_legend(figure, complex(LEFT, 25.2), told)
        for one, corner in zip(found, corners, strict=False):
            _draw(figure, one, corner, language)
        if len(found) % 2:
            add_words(figure, *_lesson(corners[len(found)], every, language))

    told = "; ".join(word(t.key, language) for t in found)
    return ChartPage(
        WIDTH, HEIGHT, paint, title=title, desc=f"{facts}: {told}", lang=language,
        metadata={"study": "stability", "singularities": [t.key for t in found]},
    )  # fmt: skip


def _draw(figure: Figure, one: Singularity, corner: complex, language: str) -> None:
    """The curves of one singularity, each with its name, and below them where methods stop."""
    left, top = corner.real + INDENT, corner.imag + 6.0
    box = Box(left, top, left + PLOT.real, top + PLOT.imag)
    axes = add_panel(figure, box, f"singularity-{one.key.replace(' ', '-')}", x_title=word(one.distance, language))
    shown = [e for law in one.laws for e in law.error if math.isfinite(e) and e > 0]
    xs = [x for law in one.laws for x in law.x]
    count_powers(axes, "x", min(xs) * 1.001, max(xs) * 0.999, most=8)
    low, high = count_powers(axes, "y", max(min(shown) / 2, LOW), min(max(shown) * 2, HIGH))
    labels = []
    for k, (law, stroke) in enumerate(zip(one.laws, _strokes(one.laws), strict=True)):
        points = [(x, max(e, low)) for x, e in zip(law.x, law.error, strict=True) if math.isfinite(e)]
        points = [(x, e) for x, e in points if e <= high]
        if stroke is not None and not _repeated(one.laws, law):
            axes.plot([x for x, _ in points], [e for _, e in points], **look(stroke))
        shape = _dot(law)
        if shape is not None:
            some = points[:: 1 if len(points) < 12 else 2]
            axes.plot([x for x, _ in some], [e for _, e in some], **marker(shape))
        if law.refuses_from is not None and points:
            axes.plot(*([value] for value in min(points)), **marker("square"))
        if points:
            labels.append((_words(law, language), _stretch(law, points, k, len(one.laws))))
    add_labels(axes, labels, (NUMBER, 2.3, 2.1, 2.0))
    fates = [runs for fate in one.fates for runs in wrapped(say(fate, language), LETTERS, CELL.real - 4.0)]
    add_words(
        figure,
        Text(complex(corner.real, corner.imag + 2.5), rich(word(one.key, language), 3.2, True)),
        *(Text(complex(corner.real, box.bottom + 14.0 + 3.3 * k), runs) for k, runs in enumerate(fates)),
    )


def _stretch(
    law: ErrorLaw, points: Sequence[tuple[float, float]], k: int, laws: int
) -> tuple[tuple[float, float], tuple[float, float]]:
    """The piece of a curve that bears its name: for the k-th of some curves each at another height, since they may lie
    together."""
    inside = [p for p in points if law.window[0] <= p[0] <= law.window[1] and p[1] < law.lost]
    inside = inside if len(inside) > 1 else list(points)
    middle = len(inside) * (laws - k) // (laws + 1)
    near = inside[max(middle - 3, 0) : middle + 4]
    return near[0], near[-1]


def lessons(found: Sequence[Singularity]) -> tuple[Phrase, ...]:
    """What to take from all that was measured, each number out of it; of what was not measured nothing."""
    by_key = {one.key: one for one in found}
    told = []
    if dead := by_key.get("dead point RRR"):
        lost, given = dead["acceleration closed form"], dead["all from the dead point"]
        told.append(Phrase("lesson place", (in_powers(lost.worst), in_powers(given.worst))))
    if (height := by_key.get("crossing height")) and (angle := by_key.get("angle near zero")):
        laws = (height[f"height by {way}"] for way in ("squares", "Heron"))
        formulas = *laws, *(angle[f"angle by {way}"] for way in ("arccos", "atan2"))
        told.append(Phrase("lesson digits", tuple(in_powers(law.worst) for law in formulas)))
    if dead:
        pencil, doubles = dead["velocity pencil"], dead["velocity closed form"]
        at = next((x for x in pencil.x if x < 0.15), pencil.x[0])
        both = pencil.near(at), doubles.near(at)
        told.append(Phrase("lesson pencil", tuple(map(in_powers, (both[0] / both[1], at, *both)))))
    if lines := by_key.get("parallel lines"):
        place, through = lines["centre place pencil"], lines["centre velocity pencil"]
        told.append(Phrase("lesson centres", (in_powers(place.worst), in_powers(through.worst))))
    silent = {"crossing height": "height by squares", "differences": "acceleration differences"}
    if silent.keys() <= by_key.keys():
        told.append(Phrase("lesson says", tuple(in_powers(by_key[key][law].worst) for key, law in silent.items())))
    return tuple(told)


def _lesson(corner: complex, found: Sequence[Singularity], language: str) -> list[Text]:
    """What to take from all of it, in the place that is left."""
    lines = [Text(complex(corner.real, corner.imag + 2.5), rich(word("lesson", language), 3.2, True))]
    y = corner.imag + 10.0
    for lesson in lessons(found):
        for runs in wrapped(say(lesson, language), 3.0, CELL.real - 10.0):
            lines.append(Text(complex(corner.real, y), runs))
            y += 4.2
        y += 2.2
    return lines


def _strokes(laws: Sequence[ErrorLaw]) -> list[Stroke | None]:
    """Lines for what is computed, each of its own kind; dots alone for what is only compared with these."""
    kinds = iter(SOLID_AND_DASHED)
    found: list[Stroke | None] = []
    by_key: dict[str, Stroke | None] = {}
    for law in laws:
        if law.key not in by_key:
            by_key[law.key] = None if _dot(law) in ("circle", "cross") else next(kinds)
        found.append(by_key[law.key])
    return found


def _dot(law: ErrorLaw) -> Shape | None:
    return next((shape for part, shape in DOTS.items() if part in law.key), None)


def _repeated(laws: Sequence[ErrorLaw], law: ErrorLaw) -> bool:
    """Whether the same curve is drawn for an earlier law already (two branches of one curve)."""
    return next(i for i, other in enumerate(laws) if other.key == law.key) != laws.index(law)


def _words(law: ErrorLaw, language: str) -> str:
    name = word(law.key, language)
    if law.theory is None or math.isnan(law.slope):
        return name
    slope = true_minus(f"{law.slope + 0.0:.2f}".replace("-0.00", "0.00"))
    theory = {-0.5: "−1/2"}.get(law.theory, true_minus(f"{law.theory:g}"))
    return f"{name}  {slope} ({theory})"
