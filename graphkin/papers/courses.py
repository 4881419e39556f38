"""A course project: its schemes with the readings at all their positions, the scheme and position of each student; the
report of each (cover, task, data, structure, positions, construction, tables, diagrams), and the table of the class."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from graphkin import solver
from graphkin.account.headings import number
from graphkin.checking.readings import read_off, report_on
from graphkin.checking.report import Report
from graphkin.construction import execute
from graphkin.drawing.write.drawing import Drawing
from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean, some_of
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
    said_each,
)
from graphkin.papers.documents import (
    document,
    head_of,
    results_table,
    scene_title,
    solution_blocks,
    task_with_source,
)
from graphkin.papers.lesson import Lesson, positions
from graphkin.papers.paper import Paper, paper_plan
from graphkin.papers.pictures import bare_picture, mechanism_picture
from graphkin.papers.variants import asked_of
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver import solved_here
from graphkin.solver.path.named_positions import named_positions
from graphkin.table import Table, table_of
from graphkin.words import Phrase, word
from graphkin.words.symbols import Words, sign

HEADED = 24.0  # mm of a page for the heading above a figure, and its caption
MOST_VALUES = 7  # columns of values that a table has room for
DIGITS = 5

Figures = tuple[Picture | Plate, ...]

HEADS: Mapping[str, tuple[str, ...]] = {
    "name": ("name", "student", "姓名", "学生"),
    "id": ("id", "number", "no", "学号"),
    "scheme": ("scheme", "variant", "group", "方案", "组", "组别"),
    "place": ("position", "at", "位置"),
}
GROUPS = ("group", "组", "组别")
"""Heads of schemes that may be meant as groups of students who all have the same lengths."""


@dataclass(frozen=True)
class Student:
    """The student of a report, with their scheme and position ("" where the table names none)."""

    name: str = ""
    id: str = ""
    scheme: str = ""
    place: str = ""


@dataclass(frozen=True)
class PlaceValues:
    """The readings at a position: the first driver's value and the readings by symbol, both in scene units (vectors by
    size, rates with sign), and the exact values; no values where it cannot be drawn."""

    name: str
    driver: float
    read: Mapping[Symbol, float] = field(default_factory=dict)
    exact: Mapping[Symbol, float] = field(default_factory=dict)


Placed = tuple[Student, PlaceValues]
"""A line of the table of a class."""


@dataclass(frozen=True)
class Scheme:
    """A mechanism of a course: quantities in the tables, positions (SI values of the first driver), their readings."""

    name: str
    scene: Mechanism
    asked: tuple[Symbol, ...]
    drivers: Mapping[str, float]
    places: Mapping[str, PlaceValues]

    def values(self, place: str) -> dict[str, float]:
        """Driver values (rad, m) at a position."""
        return {self.scene.drivers[0].key: self.drivers[place]}


def scheme_of(name: str, scene: Mechanism, asked: Sequence[Symbol], count: int) -> Scheme:
    """A mechanism with all its positions, each drawn and compared with the solver.

    Parameters
    ----------
    asked : the asked quantities, empty for all
    count : of positions of the driver, where the scene names none
    """
    structure = solver.structure_of(scene)
    key = scene.drivers[0].key
    drivers = dict(named_positions(scene))
    if not drivers:
        drivers = {str(k): row[key] for k, row in enumerate(positions(structure, None, count)[0], 1)}
    shown, places = asked_in_tables(scene, asked), {}
    for place, value in drivers.items():
        try:
            motion = solved_here(structure, {key: value})
            report = report_on(execute(paper_plan(structure, {key: value}, shown)), motion)
            report.must_agree()
            places[place] = read_at(place, value, scene, report, shown)
        except Unsolvable:
            places[place] = PlaceValues(place, scene.unit_of(scene.drivers[0]).of(value))
    return Scheme(name, scene, shown, drivers, places)


def read_at(
    place: str, value: float, scene: Mechanism, report: Report, asked: Sequence[Symbol]
) -> PlaceValues:
    """The readings at a position, with the loads that begin just there too, in scene units; 0 for rounding alone."""
    read, exact = dict[Symbol, float](), dict[Symbol, float]()
    for row in report.rows:
        symbol, unit = row.symbol, row.symbol.unit(scene.units)
        if replace(symbol, plus=False) in asked:
            drawn, true = (abs(v) if symbol.is_vector else float(v.real) for v in (row.reading.value, row.true))
            read[symbol] = float(unit.of(drawn)) if row.true else 0.0
            exact[symbol] = float(unit.of(true))
    return PlaceValues(place, scene.unit_of(scene.drivers[0]).of(value), read, exact)


def scheme_for(who: Student, course: Mapping[str, Scheme]) -> Scheme:
    """The scheme of a student; with a single scheme the table's entry is the name of a group."""
    return course[who.scheme if who.scheme in course else next(iter(course))]


def dealt_out(students: str | os.PathLike[str], course: Mapping[str, Scheme]) -> Iterator[Student]:
    """Every student with a scheme and a position of it.

    Raises CallError for a table without names, and for all unknown schemes and positions.
    """
    table = table_of(students)
    heads = [head.strip().lower() for head in table.heads]
    named = {role: [i for i, head in enumerate(heads) if head in names] for role, names in HEADS.items()}
    columns = {role: indexes[0] for role, indexes in named.items() if indexes}
    if "name" not in columns and "id" not in columns:
        raise CallError.of(str(students), "no column of names", "write a head name or id",
                           names=some_of(table.heads))
    read = [
        (line, Student(**{role: cells[i] if i < len(cells) else "" for role, i in columns.items()}))
        for line, cells in table.rows
    ]
    head = heads[columns["scheme"]] if "scheme" in columns else ""
    may_be_groups = len(course) == 1 and head in GROUPS
    schemes = [*dict.fromkeys(who.scheme for _, who in read if who.scheme)]
    if schemes and "" in course and not may_be_groups:
        raise CallError.of(f"{students}, {head}", "schemes without their data", "give a row for each rows file.csv",
                           schemes=some_of(schemes))
    problems = list[Problem]()
    for line, who in read:
        where = Phrase("line of students and line", students=students, line=line)
        allowed = [scheme_for(who, course)] if who.scheme or len(course) == 1 else [*course.values()]
        known = {name: values for scheme in allowed for name, values in scheme.places.items()}
        if who.scheme and who.scheme not in course and not may_be_groups:
            problems.append(Problem(where, "there is no scheme", did_you_mean(who.scheme, course), scheme=who.scheme))
        elif who.place and who.place not in known:
            problems.append(Problem(where, "there is no position", did_you_mean(who.place, known), at=who.place))
        elif who.place and len(allowed) == 1 and not known[who.place].read:
            problems.append(Problem(where, "position cannot be drawn", "give another one", place=who.place))
    if problems:
        raise CallError(*problems)
    free = {name: [p for p, v in scheme.places.items() if v.read] for name, scheme in course.items()}
    if not any(free.values()):
        raise CallError.of("positions", "none of them can be drawn", "give others in positions")
    taken: dict[str, list[str]] = {name: [] for name in course}
    for _, who in read:
        if who.place and (who.scheme or len(course) == 1):
            taken[scheme_for(who, course).name].append(who.place)
    for _, who in read:
        if not who.scheme and len(course) > 1:
            # the first scheme with a position left, and when all are dealt out from the start again
            rounds = {n: len(taken[n]) // max(1, len(free[n])) for n in free}
            alike = {n: taken[n].count(who.place) for n in free}
            who = replace(who, scheme=min(free, key=lambda n: (alike[n], rounds[n])))
            if who.place:
                taken[who.scheme].append(who.place)
        if not who.place:
            scheme = scheme_for(who, course).name
            who = replace(who, place=min(free[scheme], key=taken[scheme].count))
            taken[scheme].append(who.place)
        yield who


def asked_in_tables(scene: Mechanism, asked: Iterable[Symbol]) -> tuple[Symbol, ...]:
    """The quantities in the tables: those asked of the position itself, else the motion of the last joint and the rates
    of links about fixed pivots, else every velocity and acceleration that is read."""
    here = (s for s in asked if s.scope in ("motion", "position", "force") and not s.at)
    kept = tuple(here) or asked_of(scene.asking(find=()))
    if kept:
        return kept
    drawn = (reading.symbol for reading in read_off(execute(paper_plan(scene, None, ()))))
    return tuple(s for s in drawn if s.scope == "motion" and s.to is None and s.kind in ("v", "a", "omega", "alpha"))


def class_table(scene: Mechanism, rows: Sequence[Placed], asked: Sequence[Symbol]) -> Table:
    heads = ["name", "id", "variant", "position", "at"]
    heads += [head for s in asked for head in (head_of(s, scene.units), f"{s} exact")]
    lines = [
        (student.name, student.id, student.scheme, student.place, values.driver,
         *(v for s in asked for v in (values.read.get(s), values.exact.get(s))))
        for student, values in rows
    ]
    return Table.of(heads, lines, ("", "", "", "", ".9g", *[".9g"] * (2 * len(asked))))


# the report of a student, and the values of a class


def on_paper(drawing: Drawing, paper: Paper, caption: Said = ()) -> Picture | Plate:
    """A drawn page within a paper's margins: bare and true to scale if that fits, else reduced, with its check bar."""
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
) -> Document:
    """The report of one student.

    Parameters
    ----------
    lesson : the mechanism in the student's position
    stands : value of the first driver there (rad, m)
    data : heads and rows of the data of all schemes, the name of each first; empty without such data
    asked : the quantities in the table of all positions
    figures : "structure", "positions", "loops" and "diagrams", if they could be drawn
    """
    driver = scheme.scene.unit_of(scheme.scene.drivers[0])
    driver_value = lesson.said("course place", value=driver.said(stands))
    task = Heading(lesson.said("course task"), 2, fresh=True)
    blocks: list[Block] = [*_cover(lesson, student, driver_value), task, *task_with_source(lesson)]
    if data:
        blocks.append(Together((Heading(lesson.said("course data")), *_data(lesson, data, student))))
    for name in ("structure", "positions"):
        blocks += _headed(lesson, f"course {name}", figures[name])
    place = lesson.said("course position", position=student.place) if student.place else driver_value
    heads = zip(lesson.said("course drawn"), place, strict=True)
    blocks.append(Heading(tuple((each, text + word("colon", each) + more) for (each, text), (_, more) in heads)))
    blocks += [_lower(block) for block in solution_blocks(lesson)]
    blocks.append(
        Together((
            Heading(lesson.said("course comparison")),
            results_table(lesson, "quantity", "on paper", "measured", "exact", "course difference", "unit", "sense",
                          "tolerance"),
            Paragraph(lesson.said("course comparison words"), small=True),
        ))
    )
    blocks += _headed(lesson, "course loops", figures["loops"])
    places = tuple(scheme.places.values())
    bold = frozenset(i for i, place in enumerate(places) if place.name == student.place)
    first, *others = _value_tables(lesson, (lesson.said("course place head"),), [(p.name,) for p in places],
                                   places, asked, driver.written, bold)
    blocks.append(Together((Heading(lesson.said("course all positions")), first)))
    blocks += [*others, Paragraph(lesson.said("course all words"), small=True)]
    blocks += _headed(lesson, "course diagrams", figures["diagrams"])
    return document(lesson, "course design", blocks)


def class_document(lesson: Lesson, rows: Sequence[Placed], asked: Sequence[Symbol], unit: str) -> Document:
    """The values of a whole class in one table; letters, units and paper are the lesson's."""
    heads = {"name": "name of student", "id": "course id head", "scheme": "course scheme head",
             "place": "course place head"}
    shown = [name for name in heads if name == "name" or any(getattr(student, name) for student, _ in rows)]
    cells = [tuple(getattr(student, name) or "–" for name in shown) for student, _ in rows]
    keys = said_each(lesson.language, [heads[name] for name in shown])
    tables = _value_tables(lesson, keys, cells, [values for _, values in rows], asked, unit)
    return document(lesson, "course class", (
        Heading(scene_title(lesson), 1),
        Heading(lesson.said("course class")),
        *tables,
        Paragraph(lesson.said("sign of answers"), small=True),
    ))


def _cover(lesson: Lesson, student: Student, place: Said) -> Iterable[Block]:
    """Title, the student and their data, and the mechanism."""
    yield Heading(lesson.said("course design"), 1)
    yield Heading(scene_title(lesson), 2)
    known = (("student", "name", student.name), ("id", "id", student.id), ("scheme", "scheme", student.scheme),
             ("position", "position", student.place))
    for key, gap, value in known:
        if value:
            yield Paragraph(lesson.said(f"course {key}", **{gap: value}))
    yield Paragraph(place)
    asked = ("name of student", student.name), ("class of student", student.id)
    blanks = [key for key, value in asked if not value]
    yield Fields(said_each(lesson.language, (*blanks, "course teacher", "date")))
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


def _data(lesson: Lesson, data: tuple[tuple[str, ...], ...], student: Student) -> Iterable[TableBlock]:
    """The data of the schemes, split into tables if they are many, the student's own row in bold."""
    heads, *rows = data
    bold = frozenset(i for i, row in enumerate(rows) if row[0] == student.scheme)
    for k in range(1, len(heads), MOST_VALUES):
        part = slice(k, k + MOST_VALUES)
        names = (lesson.said("course scheme head"), *((("en", _letters(head)),) for head in heads[part]))
        lines = tuple((row[0], *row[part]) for row in rows)
        yield TableBlock(names, lines, "l" + "r" * len(heads[part]), bold)


def _headed(lesson: Lesson, key: str, pictures: Sequence[Picture | Plate]) -> Iterable[Block]:
    """Figures under one heading, the first of them on its page."""
    if pictures:
        yield Together((Heading(lesson.said(key)), pictures[0]))
        yield from pictures[1:]


def _lower(block: Block) -> Block:
    """A block of the solution with its headings below that of the chapter."""
    if isinstance(block, Heading):
        return replace(block, level=3, fresh=False)
    if isinstance(block, Together | Beside):
        return replace(block, blocks=tuple(_lower(inner) for inner in block.blocks))  # type: ignore[misc]
    return block


def _value_tables(
    lesson: Lesson, heads: tuple[Said, ...], cells: Sequence[tuple[str, ...]], places: Sequence[PlaceValues],
    asked: Sequence[Symbol], unit: str, bold: frozenset[int] = frozenset(),
) -> list[TableBlock]:
    """A row for each position after its names; columns without room in a table are in a further one."""
    driver = lesson.said("course driver head", unit=unit)
    tables = []
    for k in range(0, len(asked), MOST_VALUES):
        part = asked[k : k + MOST_VALUES]
        columns = tuple((("en", lesson.letters.vector(s) + f" {lesson.unit(s)}"),) for s in part)
        rows = tuple(
            (*named, number(place.driver, DIGITS),
             *(" / ".join(number(place.read[x], DIGITS) for x in s.both if x in place.read) or "–" for s in part))
            for named, place in zip(cells, places, strict=True)
        )
        align = "l" * len(heads) + "r" * (1 + len(part))
        tables.append(TableBlock((*heads, driver, *columns), rows, align, bold))
    return tables
