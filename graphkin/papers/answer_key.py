"""The answer key: the table alone, with what to accept from a pencil drawing; as CSV; and the table for a class."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from graphkin import table
from graphkin.account.headings import number, written
from graphkin.checking.report import Compared, paper
from graphkin.checking.uncertainty import COVERAGE
from graphkin.papers.blocks import Block, Document, Heading, Paragraph, TableBlock, said, sentences
from graphkin.papers.lesson import Lesson
from graphkin.papers.paper import paper_of
from graphkin.papers.problem import paper_title, reach, scene_title
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Units
from graphkin.words import languages, word
from graphkin.words.written import LEAST, amount, true_minus

__all__ = [
    "KeyRow", "answer_key", "answers_template", "key_rows", "key_table", "length_on_paper", "unsigned", "way",
]  # fmt: skip


@dataclass(frozen=True)
class KeyRow:
    """One line of the key, in scene units: the size of a vector, a rate with its sign.

    ``tolerance`` is three predicted standard deviations of a pencil drawing, None where nothing can be promised.
    """

    symbol: str
    unit: str
    asked: bool
    on_paper: float | None
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
    size = abs(row.true) if symbol.is_vector else float(row.true.real)
    angle = round(math.degrees(math.atan2(complex(row.exact).imag, complex(row.exact).real)), 3) + 0.0
    mm = row.reading.on_paper
    if mm is not None and row.measured == 0.0:  # what a residue has on paper is no length
        mm = 0.0
    has_way = symbol.is_vector and size > 0.0
    return KeyRow(
        symbol=str(symbol),
        unit=lesson.unit(symbol),
        asked=symbol in lesson.questions,
        on_paper=None if mm is None else float(amount(mm, 3)) if mm < LEAST else round(mm, 3),
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
        if line.tolerance:  # what is nought whatever the hand does has none
            low, high = max(0.0, size - line.tolerance), size + line.tolerance
            places = _places(line.tolerance)
            if row.symbol.scope == "position":
                low, high = line.exact - line.tolerance, line.exact + line.tolerance
            within = (f"± {_fixed(line.tolerance, places)}", f"{_fixed(low, places)} … {_fixed(high, places)}")
        name = f"${lesson.letters.vector(row.symbol)}$"
        shown = number(line.exact if row.symbol.scope == "position" else size, 5)
        rows.append((name, length_on_paper(row), shown, *within, line.unit, way(row, language)))
    tools = lesson.sheet.scene.question.sheet.tools
    words = said(
        "key words", language, *(f"{x:g}" for x in (tools.line_width / 2, tools.ruler, tools.compass, tools.set_square))
    )
    blocks: tuple[Block, ...] = (
        Heading(scene_title(lesson), 1),
        Heading(said("answer key", language)),
        *reach(lesson),
        TableBlock(heads, tuple(rows), "lrrrrll", frozenset(bold)),
        Paragraph(sentences(words, said("sense words", language)), small=True),
    )
    return Document(paper_title(lesson, "answer key"), languages(language), blocks, paper_of(lesson.sheet.scene))


def _places(tolerance: float) -> int:
    """Decimal places that show two digits of a tolerance; negative for tens and hundreds."""
    return 1 - math.floor(math.log10(tolerance)) if tolerance > 0.0 else 4


def _fixed(value: float, places: int) -> str:
    return f"{round(value, places):.{max(0, places)}f}"


def key_table(lesson: Lesson) -> table.Table:
    """The key as a table, in scene units."""
    heads = ("symbol", "unit", "asked", "on_paper_mm", "exact", "tolerance", "direction_deg")
    rows = ((r.symbol, r.unit, r.asked, r.on_paper, r.exact, r.tolerance, r.direction) for r in key_rows(lesson))
    return table.Table.of(heads, rows, ("", "", "", "", ".9g", ".3g", ".3f"))


def answers_template(asked: Sequence[Symbol], units: Units, language: str, variants: Iterable[str] = ()) -> table.Table:
    """A table for a class to fill in, as ``audit`` reads it: a column for each quantity asked for, and for a vector its
    direction; with ``variants`` a row for each of them."""
    names = tuple(variants)
    columns = [f"{s} ({s.unit(units).text})" if s.unit(units).text else str(s) for s in asked]
    heads = [word(key, language) for key in ("name in a class", "id in a class", *(["variant"] if names else []))]
    for symbol, column in zip(asked, columns, strict=True):
        heads += [column, f"{symbol} {word('direction of', language)}"] if symbol.is_vector else [column]
    blank = [""] * (len(heads) - 2 - bool(names))
    return table.Table.of(heads, [["", "", name, *blank] for name in names] or [["", "", *blank]])


def length_on_paper(row: Compared) -> str:
    """The length on paper of what is a length there; a rate has none of its own."""
    own = row.symbol.is_vector or row.symbol.measure == "length"
    return written(paper(row.reading, row)) if own else "–"


def unsigned(row: Compared, text: str) -> str:
    """A value whose sense is said in words; the sign of a place says where it lies."""
    placed = row.symbol.scope == "position" or row.symbol.kind in ("h", "arm")
    return text if placed else text.removeprefix("−")


def way(row: Compared, language: str) -> str:
    """Direction of a vector in degrees, or the sense of a rate in words; "" where it is zero."""
    value = row.true
    if value == 0.0 or row.symbol.scope not in ("motion", "force") or row.symbol.kind in ("h", "arm"):
        return ""
    if row.symbol.is_vector:
        angle = round(math.degrees(cmath.phase(complex(value))), 1) + 0.0
        return true_minus(f"{180.0 if angle == -180.0 else angle:.1f}°")
    key = "counter-clockwise" if value.real > 0 else "clockwise"
    return " ".join(word(key, each) for each in languages(language))
