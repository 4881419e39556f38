"""The report of a course design: cover, task, data, structure, positions, construction, tables, diagrams.

The table of a class stands here too.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from graphkin.account.headings import number
from graphkin.checking.report import Compared
from graphkin.drawing.write.drawing import Drawing
from graphkin.papers.answer_key import key_rows, way
from graphkin.papers.blocks import (
    Beside,
    Block,
    Document,
    Fields,
    Heading,
    Paragraph,
    Picture,
    Plate,
    Said,
    TableBlock,
    Together,
    said,
)
from graphkin.papers.lesson import Lesson
from graphkin.papers.paper import Paper, paper_of
from graphkin.papers.pictures import bare_picture, mechanism_picture, parts
from graphkin.papers.problem import given, paper_title, scene_title
from graphkin.papers.solution import solution_blocks
from graphkin.scene.symbol import Symbol
from graphkin.words import languages, word
from graphkin.words.written import in_markup

__all__ = ["ClassRow", "CourseDesign", "PlaceValues", "Student", "class_document", "on_paper", "report"]

HEADED = 24.0  # mm of a page for the heading above a figure, and its caption
MOST_VALUES = 7  # columns of values that a table has room for
DIGITS = 5


@dataclass(frozen=True)
class Student:
    """Who a report is for, and which scheme and position are theirs ("" where nothing is said)."""

    name: str = ""
    id: str = ""
    scheme: str = ""
    place: str = ""


@dataclass(frozen=True)
class PlaceValues:
    """What was read off at one position: the first driver's value and the readings by symbol, both in scene units
    (vectors by size, rates with sign), and the exact values beside them; no values where it cannot be drawn."""

    name: str
    driver: float
    read: Mapping[Symbol, float] = field(default_factory=dict)
    exact: Mapping[Symbol, float] = field(default_factory=dict)


@dataclass(frozen=True)
class CourseDesign:
    """What the report of one student is made of.

    lesson : the mechanism in the student's position
    schemes : heads and rows of the data of all schemes, the name of each first; without any nothing is told of them
    places : all positions of the student's scheme
    asked : what their table shows
    driver_unit : that of the first driver's value
    structure, positions, loops : figures, where they could be drawn
    diagrams : pages of the motion diagrams
    """

    lesson: Lesson
    student: Student
    place_words: str
    schemes: tuple[tuple[str, ...], ...]
    places: tuple[PlaceValues, ...]
    asked: tuple[Symbol, ...]
    driver_unit: str
    structure: tuple[Picture | Plate, ...] = ()
    positions: tuple[Picture | Plate, ...] = ()
    loops: tuple[Picture | Plate, ...] = ()
    diagrams: tuple[Picture | Plate, ...] = ()


@dataclass(frozen=True)
class ClassRow:
    """A line of the table of a class."""

    student: Student
    values: PlaceValues


def on_paper(drawing: Drawing, paper: Paper, caption: Said = ()) -> Picture | Plate:
    """A page that was drawn for itself within the margins of a paper: without its own margins and titles true to scale
    where that fits, else made small, with its check bar."""
    narrow = bare_picture(drawing)
    if narrow.width <= paper.body.width and narrow.height <= paper.body.height - HEADED:
        return Picture(narrow, caption)
    return plate(narrow.content("svg", text="outlines"), (narrow.width, narrow.height), paper, drawing.desc, caption)


def plate(svg: bytes, size: tuple[float, float], paper: Paper, words: str, caption: Said = ()) -> Plate:
    """A page of a figure, made small where it is larger than the body of a paper below a heading."""
    times = min(1.0, paper.body.width / size[0], (paper.body.height - HEADED) / size[1])
    return Plate(svg.decode(), size[0] * times, size[1] * times, words, caption)


def report(made: CourseDesign) -> Document:
    """The report of one student."""
    lesson = made.lesson
    language = lesson.language
    blocks: list[Block] = [*_cover(made), Heading(said("course task", language), 2, fresh=True), *given(lesson)]
    if made.schemes:
        blocks.append(Together((Heading(said("course data", language)), *_data(made))))
    figures = (("course structure", made.structure), ("course positions", made.positions))
    for key, pictures in figures:
        blocks += _headed(key, pictures, language)
    drawn = said("course drawn", language)
    place = said("course position", language, in_markup(made.student.place)) if made.student.place else ()
    blocks.append(Heading(_joined(drawn, place or said("course place", language, made.place_words))))
    blocks += [_lower(block) for block in solution_blocks(lesson)]
    blocks.append(
        Together((
            Heading(said("course comparison", language)),
            _comparison(lesson),
            Paragraph(said("course comparison words", language), small=True),
        ))
    )  # fmt: skip
    blocks += _headed("course loops", made.loops, language)
    rows = [("", place) for place in made.places]
    own = frozenset(i for i, place in enumerate(made.places) if place.name == made.student.place)
    tables = _value_tables(lesson, (said("course place head", language),), [(p.name,) for _, p in rows],
                           made.places, made.asked, made.driver_unit, own)  # fmt: skip
    blocks.append(Together((Heading(said("course all positions", language)), tables[0])))
    blocks += [*tables[1:], Paragraph(said("course all words", language), small=True)]
    blocks += _headed("course diagrams", made.diagrams, language)
    return Document(_title(lesson), languages(language), tuple(blocks), paper_of(lesson.sheet.scene))


def class_document(lesson: Lesson, rows: Sequence[ClassRow], asked: Sequence[Symbol], unit: str) -> Document:
    """The values of a whole class in one table; the lesson lends its letters, units and paper."""
    language = lesson.language
    keys = ["name of student"]
    cells: list[tuple[str, ...]] = [(row.student.name or "–",) for row in rows]
    more = (("course id head", "id"), ("course scheme head", "scheme"), ("course place head", "place"))
    for key, name in more:
        found = [getattr(row.student, name) for row in rows]
        if any(found):
            keys.append(key)
            cells = [(*before, own or "–") for before, own in zip(cells, found, strict=True)]
    heads = tuple(said(key, language) for key in keys)
    plain = [tuple(in_markup(cell) for cell in line) for line in cells]
    tables = _value_tables(lesson, heads, plain, [row.values for row in rows], asked, unit)
    blocks: tuple[Block, ...] = (
        Heading(scene_title(lesson), 1),
        Heading(said("course class", language)),
        *tables,
        Paragraph(said("sign of answers", language), small=True),
    )
    return Document(
        paper_title(lesson, "course class"), languages(language), blocks, paper_of(lesson.sheet.scene)
    )  # fmt: skip


def _title(lesson: Lesson) -> str:
    return paper_title(lesson, "course design")


def _joined(words: Said, more: Said) -> Said:
    return tuple(
        (each, text + word("colon", each) + told) for (each, text), (_, told) in zip(words, more, strict=True)
    )


def _cover(made: CourseDesign) -> Iterable[Block]:
    """Title, whose it is, what is theirs, and the mechanism."""
    lesson, student = made.lesson, made.student
    language = lesson.language
    yield Heading(said("course design", language), 1)
    yield Heading(scene_title(lesson), 2)
    blanks = []
    for key, blank, text in (("course student", "name of student", student.name),
                             ("course id", "class of student", student.id)):  # fmt: skip
        if text:
            yield Paragraph(said(key, language, in_markup(text)))
        else:
            blanks.append(blank)
    if student.scheme:
        yield Paragraph(said("course scheme", language, in_markup(student.scheme)))
    if student.place:
        yield Paragraph(said("course position", language, in_markup(student.place)))
    yield Paragraph(said("course place", language, made.place_words))
    yield Fields(tuple(said(key, language) for key in (*blanks, "course teacher", "date")))
    layers = parts(lesson.sheet, "mechanism", lesson.letters, language)
    yield Picture(mechanism_picture(lesson.sheet, layers, lesson.letters, language))


def _letters(head: str) -> str:
    """The head of a column as markup, a letter with its index set as such.

    >>> _letters("l_O2A (mm)"), _letters("n2 (r/min)"), _letters("driver.angle")
    ('$l_{O2A}$ (mm)', '$n_{2}$ (r/min)', 'driver.angle')
    """
    found = re.match(r"([^\W\d_])(?:_([^\W_]+)|(\d+))(?=\s|$)", head)
    if found is None:
        return in_markup(head)
    return f"${found[1]}_{{{found[2] or found[3]}}}${in_markup(head[found.end():])}"


def _data(made: CourseDesign) -> Iterable[TableBlock]:
    """The data of the schemes, split where they are many, the student's own row in bold."""
    heads, *rows = made.schemes
    own = frozenset(i for i, row in enumerate(rows) if row[0] == made.student.scheme)
    for k in range(1, len(heads), MOST_VALUES):
        part = slice(k, k + MOST_VALUES)
        yield TableBlock(
            tuple((("en", _letters(head)),) if i else said("course scheme head", made.lesson.language)
                  for i, head in enumerate((heads[0], *heads[part]))),
            tuple(tuple(map(in_markup, (row[0], *row[part]))) for row in rows),
            "l" + "r" * len(heads[part]), own,
        )  # fmt: skip


def _headed(key: str, pictures: Sequence[Picture | Plate], language: str) -> Iterable[Block]:
    """Figures under one heading, the first of them on its page."""
    if pictures:
        yield Together((Heading(said(key, language)), pictures[0]))
        yield from pictures[1:]


def _lower(block: Block) -> Block:
    """A block of the solution with its headings below that of the chapter."""
    if isinstance(block, Heading):
        return replace(block, level=3, fresh=False)
    if isinstance(block, Together):
        return replace(block, blocks=tuple(_lower(one) for one in block.blocks))  # type: ignore[misc]
    if isinstance(block, Beside):
        return replace(block, blocks=tuple(_lower(one) for one in block.blocks))  # type: ignore[misc]
    return block


def _comparison(lesson: Lesson) -> TableBlock:
    """Every result as it was read off and as it was computed, and what a pencil may be off."""
    keys = ("quantity", "on paper", "measured", "exact", "course difference", "unit", "sense", "tolerance")
    rows, bold = [], set()
    for i, (line, row) in enumerate(zip(key_rows(lesson), lesson.results, strict=True)):
        if line.asked:
            bold.add(i)
        off = row.relative
        own = row.symbol.is_vector or row.symbol.measure == "length"
        rows.append((
            f"${lesson.letters.vector(row.symbol)}$",
            number(line.on_paper, 4) if own and line.on_paper is not None else "–",
            number(value_read(lesson, row), DIGITS), number(line.exact, DIGITS),
            "–" if off is None else f"{100 * off:.2f}", line.unit, way(row, lesson.language),
            "–" if line.tolerance is None else f"± {number(line.tolerance, 2)}",
        ))  # fmt: skip
    return TableBlock(tuple(said(k, lesson.language) for k in keys), tuple(rows), "lrrrrllr", frozenset(bold))


def value_read(lesson: Lesson, row: Compared) -> float:
    """A reading in the scene's unit: a vector by size, a rate with its sign; zero where it is nothing but rounding."""
    value = row.reading.value
    size = abs(value) if row.symbol.is_vector else float(complex(value).real)
    return lesson.in_unit(row.symbol, size) if row.true != 0.0 else 0.0


def _value_tables(
    lesson: Lesson, heads: tuple[Said, ...], cells: Sequence[tuple[str, ...]], places: Sequence[PlaceValues],
    asked: Sequence[Symbol], unit: str, bold: frozenset[int] = frozenset(),
) -> list[TableBlock]:  # fmt: skip
    """A row for each position behind its names; what one table has no room for stands in a further one."""
    language = lesson.language
    driver = said("course driver head", language, unit)
    tables = []
    for k in range(0, len(asked), MOST_VALUES):
        part = asked[k : k + MOST_VALUES]
        columns = tuple((("en", f"${lesson.letters.vector(s)}$ {lesson.unit(s)}"),) for s in part)
        rows = tuple(
            (*own, number(place.driver, DIGITS),
             *(number(place.read[s], DIGITS) if s in place.read else "–" for s in part))
            for own, place in zip(cells, places, strict=True)
        )  # fmt: skip
        align = "l" * len(heads) + "r" * (1 + len(part))
        tables.append(TableBlock((*heads, driver, *columns), rows, align, bold))
    return tables
