"""The report of a student's course project (cover, task, data, structure, positions, construction, tables, diagrams),
and the table of the class."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from graphkin.account.headings import number
from graphkin.drawing.write.drawing import Drawing
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
    said_each,
)
from graphkin.papers.courses import Placed, PlaceValues, Scheme, Student
from graphkin.papers.documents import paper_title, results_table, scene_title, solution_blocks, task_with_source
from graphkin.papers.lesson import Lesson
from graphkin.papers.paper import Paper, paper_of
from graphkin.papers.pictures import bare_picture, mechanism_picture
from graphkin.scene.symbol import Symbol
from graphkin.words import languages, word
from graphkin.words.symbols import Words, sign

HEADED = 24.0  # mm of a page for the heading above a figure, and its caption
MOST_VALUES = 7  # columns of values that a table has room for
DIGITS = 5

Figures = tuple[Picture | Plate, ...]


def on_paper(drawing: Drawing, paper: Paper, caption: Said = ()) -> Picture | Plate:
    """A drawn page within the margins of a paper: without its own margins and titles true to scale if that fits, else
    reduced, with its check bar."""
    narrow = bare_picture(drawing)
    if narrow.width <= paper.body.width and narrow.height <= paper.body.height - HEADED:
        return Picture(narrow, caption)
    return plate(narrow.content("svg", text="outlines"), (narrow.width, narrow.height), paper, drawing.desc, caption)


def plate(svg: bytes, size: tuple[float, float], paper: Paper, words: str, caption: Said = ()) -> Plate:
    """A page of a figure, reduced if it is larger than the body of a paper below a heading."""
    times = min(1.0, paper.body.width / size[0], (paper.body.height - HEADED) / size[1])
    return Plate(svg.decode(), size[0] * times, size[1] * times, words, caption)


def course_report(
    lesson: Lesson, student: Student, scheme: Scheme, stands: float, data: tuple[tuple[str, ...], ...],
    asked: Sequence[Symbol], figures: Mapping[str, Figures],
) -> Document:  # fmt: skip
    """The report of one student.

    Parameters
    ----------
    lesson : the mechanism in the student's position
    stands : value of the first driver there (rad, m)
    data : heads and rows of the data of all schemes, the name of each first; empty without such data
    asked : the quantities in the table of all positions
    figures : "structure", "positions", "loops" and "diagrams", if they could be drawn
    """
    language, driver = lesson.language, scheme.scene.unit_of(scheme.scene.drivers[0])
    driver_value = said("course place", language, value=driver.said(stands))
    task = Heading(said("course task", language), 2, fresh=True)
    blocks: list[Block] = [*_cover(lesson, student, driver_value), task, *task_with_source(lesson)]
    if data:
        blocks.append(Together((Heading(said("course data", language)), *_data(data, student, language))))
    for name in ("structure", "positions"):
        blocks += _headed(f"course {name}", figures[name], language)
    place = said("course position", language, position=student.place) if student.place else driver_value
    heads = zip(said("course drawn", language), place, strict=True)
    blocks.append(Heading(tuple((each, text + word("colon", each) + more) for (each, text), (_, more) in heads)))
    blocks += [_lower(block) for block in solution_blocks(lesson)]
    blocks.append(
        Together((
            Heading(said("course comparison", language)),
            results_table(lesson, "quantity", "on paper", "measured", "exact", "course difference", "unit", "sense",
                          "tolerance"),
            Paragraph(said("course comparison words", language), small=True),
        ))
    )  # fmt: skip
    blocks += _headed("course loops", figures["loops"], language)
    places = tuple(scheme.places.values())
    bold = frozenset(i for i, place in enumerate(places) if place.name == student.place)
    first, *others = _value_tables(lesson, (said("course place head", language),), [(p.name,) for p in places],
                                   places, asked, driver.written, bold)  # fmt: skip
    blocks.append(Together((Heading(said("course all positions", language)), first)))
    blocks += [*others, Paragraph(said("course all words", language), small=True)]
    blocks += _headed("course diagrams", figures["diagrams"], language)
    title = paper_title(lesson, "course design")
    return Document(title, languages(language), tuple(blocks), paper_of(lesson.sheet.scene))


def class_document(lesson: Lesson, rows: Sequence[Placed], asked: Sequence[Symbol], unit: str) -> Document:
    """The values of a whole class in one table; letters, units and paper are the lesson's."""
    language = lesson.language
    keys = ["name of student"]
    cells: list[tuple[str, ...]] = [(student.name or "–",) for student, _ in rows]
    more = (("course id head", "id"), ("course scheme head", "scheme"), ("course place head", "place"))
    for key, name in more:
        column = [getattr(student, name) for student, _ in rows]
        if any(column):
            keys.append(key)
            cells = [(*before, own or "–") for before, own in zip(cells, column, strict=True)]
    tables = _value_tables(lesson, said_each(language, keys), cells, [values for _, values in rows], asked, unit)
    blocks: tuple[Block, ...] = (
        Heading(scene_title(lesson), 1),
        Heading(said("course class", language)),
        *tables,
        Paragraph(said("sign of answers", language), small=True),
    )
    return Document(
        paper_title(lesson, "course class"), languages(language), blocks, paper_of(lesson.sheet.scene)
    )  # fmt: skip


def _cover(lesson: Lesson, student: Student, place: Said) -> Iterable[Block]:
    """Title, the student and their data, and the mechanism."""
    language = lesson.language
    yield Heading(said("course design", language), 1)
    yield Heading(scene_title(lesson), 2)
    blanks = []
    if student.name:
        yield Paragraph(said("course student", language, name=student.name))
    else:
        blanks.append("name of student")
    if student.id:
        yield Paragraph(said("course id", language, id=student.id))
    else:
        blanks.append("class of student")
    if student.scheme:
        yield Paragraph(said("course scheme", language, scheme=student.scheme))
    if student.place:
        yield Paragraph(said("course position", language, position=student.place))
    yield Paragraph(place)
    yield Fields(said_each(language, (*blanks, "course teacher", "date")))
    yield Picture(mechanism_picture(lesson))


def _letters(head: str) -> Words:
    """The head of a column, a letter with its index set as such.

    >>> _letters("l_O2A (mm)"), _letters("n2 (r/min)"), _letters("driver.angle")
    ($l_{O2A}$ (mm), $n_{2}$ (r/min), 'driver.angle')
    """
    parted = re.match(r"([^\W\d_])(?:_([^\W_]+)|(\d+))(?=\s|$)", head)
    if parted is None:
        return head
    return sign(parted[1], parted[2] or parted[3]) + head[parted.end() :]


def _data(data: tuple[tuple[str, ...], ...], student: Student, language: str) -> Iterable[TableBlock]:
    """The data of the schemes, split into tables if they are many, the student's own row in bold."""
    heads, *rows = data
    bold = frozenset(i for i, row in enumerate(rows) if row[0] == student.scheme)
    for k in range(1, len(heads), MOST_VALUES):
        part = slice(k, k + MOST_VALUES)
        names = (said("course scheme head", language), *((("en", _letters(head)),) for head in heads[part]))
        lines = tuple((row[0], *row[part]) for row in rows)
        yield TableBlock(names, lines, "l" + "r" * len(heads[part]), bold)


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
        return replace(block, blocks=tuple(_lower(inner) for inner in block.blocks))  # type: ignore[misc]
    if isinstance(block, Beside):
        return replace(block, blocks=tuple(_lower(inner) for inner in block.blocks))  # type: ignore[misc]
    return block


def _value_tables(
    lesson: Lesson, heads: tuple[Said, ...], cells: Sequence[tuple[str, ...]], places: Sequence[PlaceValues],
    asked: Sequence[Symbol], unit: str, bold: frozenset[int] = frozenset(),
) -> list[TableBlock]:  # fmt: skip
    """A row for each position after its names; columns without room in a table are in a further one."""
    language = lesson.language
    driver = said("course driver head", language, unit=unit)
    tables = []
    for k in range(0, len(asked), MOST_VALUES):
        part = asked[k : k + MOST_VALUES]
        columns = tuple((("en", lesson.letters.vector(s) + f" {lesson.unit(s)}"),) for s in part)
        rows = tuple(
            (*named, number(place.driver, DIGITS),
             *(number(place.read[s], DIGITS) if s in place.read else "–" for s in part))
            for named, place in zip(cells, places, strict=True)
        )  # fmt: skip
        align = "l" * len(heads) + "r" * (1 + len(part))
        tables.append(TableBlock((*heads, driver, *columns), rows, align, bold))
    return tables
