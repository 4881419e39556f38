"""The answer key: the table alone, with what to accept from a pencil drawing."""

from __future__ import annotations

import csv
import io
import math
from dataclasses import dataclass

from graphkin.checking import COVERAGE, Compared
from graphkin.drawing.headings import number
from graphkin.handout.blocks import Block, Document, Heading, Paragraph, Table, said, sentences
from graphkin.handout.lesson import Lesson
from graphkin.handout.paper import paper_of
from graphkin.handout.problem import paper_title, reach, scene_title
from graphkin.handout.solution import way
from graphkin.words import languages

__all__ = ["KeyRow", "answer_key", "key_csv", "key_rows"]


@dataclass(frozen=True)
class KeyRow:
    """One line of the key, in scene units: the size of a vector, a rate with its sign.

    ``tolerance`` is three predicted standard deviations of a pencil drawing, None where nothing can be promised.
    """

    symbol: str
    unit: str
    asked: bool
    on_paper: float
    exact: float
    tolerance: float | None
    direction: float | None


def key_rows(lesson: Lesson) -> tuple[KeyRow, ...]:
    """The lines of the key."""
    return tuple(_row(lesson, row) for row in lesson.results)


def _row(lesson: Lesson, row: Compared) -> KeyRow:
    symbol = row.symbol
    spread = lesson.tolerance.get(symbol)
    bound = (
        None
        if spread is None or not math.isfinite(spread.deviation)
        else lesson.in_unit(symbol, COVERAGE * spread.deviation)
    )
    size = abs(row.exact) if symbol.is_vector else float(row.exact.real)
    angle = math.degrees(math.atan2(complex(row.exact).imag, complex(row.exact).real)) + 0.0
    has_way = symbol.is_vector and row.reading.on_paper > 1e-6
    return KeyRow(
        symbol=str(symbol),
        unit=lesson.unit(symbol),
        asked=symbol in lesson.questions,
        on_paper=row.reading.on_paper,
        exact=lesson.in_unit(symbol, size),
        tolerance=bound,
        direction=angle if has_way else None,
    )


def answer_key(lesson: Lesson) -> Document:
    """The answer key of a lesson."""
    language = lesson.language
    heads = tuple(said(k, language) for k in ("quantity", "on paper", "value", "tolerance", "accept", "unit", "sense"))
    rows, bold = [], set()
    for i, (line, row) in enumerate(zip(key_rows(lesson), lesson.results, strict=True)):
        if line.asked:
            bold.add(i)
        size = abs(line.exact)
        within = ("–", "–")
        if line.tolerance is not None:
            low, high = max(0.0, size - line.tolerance), size + line.tolerance
            places = _places(line.tolerance)
            within = (f"± {_fixed(line.tolerance, places)}", f"{_fixed(low, places)} … {_fixed(high, places)}")
        name = f"${lesson.letters.vector(row.symbol)}$"
        rows.append((name, f"{line.on_paper:.2f}", number(size, 5), *within, line.unit, way(row, language)))
    tools = lesson.sheet.scene.sheet.tools
    words = said(
        "key words", language, *(f"{x:g}" for x in (tools.line_width / 2, tools.ruler, tools.compass, tools.set_square))
    )
    blocks: tuple[Block, ...] = (
        Heading(scene_title(lesson), 1),
        Heading(said("answer key", language)),
        *reach(lesson),
        Table(heads, tuple(rows), "lrrrrll", frozenset(bold)),
        Paragraph(sentences(words, said("sense words", language)), small=True),
    )
    return Document(paper_title(lesson, "answer key"), languages(language), blocks, paper_of(lesson.sheet.scene))


def _places(tolerance: float) -> int:
    """Decimal places that show two digits of a tolerance; negative for tens and hundreds."""
    return 1 - math.floor(math.log10(tolerance)) if tolerance > 0.0 else 4


def _fixed(value: float, places: int) -> str:
    return f"{round(value, places):.{max(0, places)}f}"


def key_csv(lesson: Lesson) -> str:
    """The key as CSV, in scene units, 9 digits."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["symbol", "unit", "asked", "on_paper_mm", "exact", "tolerance", "direction_deg"])
    for row in key_rows(lesson):
        writer.writerow([
            row.symbol, row.unit, "yes" if row.asked else "no", f"{row.on_paper:.3f}", f"{row.exact:.9g}",
            "" if row.tolerance is None else f"{row.tolerance:.3g}",
            "" if row.direction is None else f"{row.direction:.3f}",
        ])  # fmt: skip
    return out.getvalue()
