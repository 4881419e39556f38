"""``graphkin handout --template course-design``: the schemes of a course with all their positions, which of them each
student draws, the reports of a course project (cover, task, data, structure, positions, construction, tables,
diagrams), and the table of the class."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from graphkin import solver
from graphkin.account.headings import number
from graphkin.api.arguments import (
    ON_SHEETS,
    At,
    as_scene,
    asked_symbols,
    driver_values,
    for_paper,
    known_words,
    require_callable,
    whole_number,
)
from graphkin.api.checked import solved_here
from graphkin.api.drawn import draw
from graphkin.api.problem_sets import drawn_schemes, schemes_of
from graphkin.api.results import OfScene, Result
from graphkin.api.sweep import sweep
from graphkin.checking.readings import read_off
from graphkin.checking.report import Compared
from graphkin.construction import execute
from graphkin.drawing.chart import ChartPage
from graphkin.drawing.write.drawing import Drawing
from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean
from graphkin.files import Json, path_of
from graphkin.jobs import Progress
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
from graphkin.papers.documents import (
    answers_template,
    head_of,
    paper_title,
    results_table,
    scene_title,
    solution_blocks,
)
from graphkin.papers.documents import given as given_words
from graphkin.papers.lesson import Lesson, compared, lesson_of, positions
from graphkin.papers.paper import Paper, paper_of, paper_plan
from graphkin.papers.pdf import FORMATS, can_join, can_typeset, one_after_another, papers_as
from graphkin.papers.pictures import bare_picture, mechanism_picture
from graphkin.papers.variants import asked_of
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike, safe_name
from graphkin.scene.symbol import Symbol
from graphkin.solver.named_positions import named_positions
from graphkin.table import Table, table_of
from graphkin.words import Phrase, languages, word
from graphkin.words.written import in_markup

HEADED = 24.0  # mm of a page for the heading above a figure, and its caption
MOST_VALUES = 7  # columns of values that a table has room for
DIGITS = 5
HEADS: Mapping[str, tuple[str, ...]] = {
    "name": ("name", "student", "姓名", "学生"),
    "id": ("id", "number", "no", "学号"),
    "scheme": ("scheme", "variant", "group", "方案", "组", "组别"),
    "place": ("position", "at", "位置"),
}
GROUPS = ("group", "组", "组别")
"""Heads of schemes that may be meant as groups of students who all have the same lengths."""

Figures = tuple[Picture | Plate, ...]


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
class ClassRow:
    """A line of the table of a class."""

    student: Student
    values: PlaceValues


@dataclass(frozen=True)
class Scheme:
    """One mechanism of a course: its positions (SI values of the first driver) and what was read off at each."""

    name: str
    scene: Mechanism
    drivers: Mapping[str, float]
    places: Mapping[str, PlaceValues]

    def values(self, place: str) -> dict[str, float]:
        """Driver values (rad, m) at a position."""
        return {self.scene.drivers[0].key: self.drivers[place]}


@dataclass(frozen=True, repr=False, eq=False)
class CourseDesigns(OfScene, Result):
    """The reports of a course project: a file for each student, and the table of the class.

    ``rows`` are the lines of that table: who, which scheme and position, what was read off there.
    """

    mechanism: Mechanism
    rows: tuple[ClassRow, ...]
    asked: tuple[Symbol, ...]
    content: Mapping[str, bytes]
    agrees: bool
    typeset: bool = True

    @property
    def ok(self) -> bool:
        """Whether every reading of every report agrees with the analytic solver."""
        return self.agrees

    @cached_property
    def table(self) -> Table:
        """A row for each student: who, variant, position, driver value, and each quantity as read off and exact."""
        return _class_table(self.mechanism, self.rows, self.asked)

    @cached_property
    def data(self) -> dict[str, Json]:
        """The table for programs, in scene units."""
        students: list[dict[str, Json]] = [
            {"name": row.student.name, "id": row.student.id, "variant": row.student.scheme,
             "position": row.student.place, "at": row.values.driver,
             "values": {str(s): row.values.read.get(s) for s in self.asked},
             "exact": {str(s): row.values.exact.get(s) for s in self.asked}}
            for row in self.rows
        ]  # fmt: skip
        return {"ok": self.ok, "students": students}

    @property
    def files(self) -> Mapping[str, bytes]:
        """Content of each file by name: the reports, class.csv, class.html, class.pdf, answers_template.csv."""
        return self.content

    @property
    def notes(self) -> tuple[Phrase, ...]:
        """What was not done as asked: typeset PDF without the extra ``pdf``."""
        return () if self.typeset else (Phrase("no pdf extra"),)

    def __repr__(self) -> str:
        return f"<CourseDesigns {self.mechanism.name}: {len(self.rows)} reports>"


def course_design(
    scene: SceneLike,
    *,
    at: At = None,
    find: Iterable[str | Symbol] | None = None,
    students: str | os.PathLike[str] | None = None,
    rows: str | os.PathLike[str] | None = None,
    positions: int | None = None,
    variants: int | None = None,
    out: str | os.PathLike[str] | None = None,
    formats: Sequence[str] = FORMATS,
    language: str | None = None,
    convention: str | None = None,
    seed: int = 0,
    progress: Progress | None = None,
) -> CourseDesigns:
    """The reports of a course project: one position of one mechanism for each student, and the table of the class.

    Parameters
    ----------
    scene, find : as for `check`
    students : a CSV file with a line for each student: a column name (姓名), and where wished id (学号), scheme
        (方案, group) and position (位置, the name of one); who has no position gets the next one of their scheme, who
        has no scheme the next one that has a position left.  Without it one report with a blank cover (one for each
        scheme)
    rows : a CSV file with a row of data for each scheme, as `problem_set` reads it
    variants, seed : instead, so many schemes drawn as those of a problem set
    at : the position of the one report where there are no students; the scene's own if None
    positions : of the driver, numbered from 1, where the scene has no `[positions]`; 12 if None
    out : folder for the files; none are written without it
    formats, language, convention : as for `handout`
    progress : called with the reports done and the number of all

    Raises
    ------
    SceneError, CallError : the file, a table or the call is wrong
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    known_words(formats, language, convention, known_formats=FORMATS, known_languages=ON_SHEETS)
    require_callable("progress", progress)
    _ = out is None or path_of(out)
    given = for_paper(scene)
    asked_symbols(given, find)
    if students is not None and at is not None:
        raise CallError.of("at", "beside students", "write each position into the table of the")
    count = 12 if positions is None else whole_number("positions", positions, 2, 72)
    spoken, letters = language or given.question.sheet.language, convention or given.question.sheet.convention
    if rows is not None and variants is not None:
        raise CallError.of("variants", "beside rows", "give one of them")
    sources: Mapping[str, SceneLike] = {"": scene}
    data: tuple[tuple[str, ...], ...] = ()
    if rows is not None:
        sources, data = schemes_of(scene, rows)
    elif variants is not None:
        sources, data = drawn_schemes(scene, variants, seed, find)
    course = {name: scheme_of(name, source, find, count) for name, source in sources.items()}
    if students is None:
        dealt = [(Student(scheme=name), driver_values(scheme.scene, at)) for name, scheme in course.items()]
        dealt = [(replace(who, place=at if isinstance(at, str) else ""), values) for who, values in dealt]
    else:
        dealt = [(who, course[scheme_name(course, who)].values(who.place)) for who in dealt_out(students, course)]
    content: dict[str, bytes] = {}
    lines, agrees, shared = [], True, dict[str, dict[str, Figures]]()
    lesson = None
    for k, (who, values) in enumerate(dealt):
        scheme = course[scheme_name(course, who)]
        motion = solved_here(scheme.scene, values)
        what = paper_plan(motion.structure, values, asked_symbols(scheme.scene, find))
        lesson = lesson_of(what, motion, spoken, letters)
        agrees = agrees and lesson.report.ok
        if scheme.name not in shared:
            shared[scheme.name] = _figures(scheme.scene, spoken, letters)
        asked = asked_in_tables(scheme.scene, find)
        stands = lesson.sheet.drivers[scheme.scene.drivers[0].key]
        place = scheme.places[who.place] if who.place in scheme.places else read_at("", stands, lesson, asked)
        lines.append(ClassRow(who, place))
        figures = shared[scheme.name] | {"loops": _drawn(scheme.scene, "loops", spoken, letters, place.driver)}
        document = _report(lesson, who, scheme, stands, data, asked, figures)
        stem = "report" if len(dealt) == 1 and students is None and not data else _stem(k, len(dealt), who)
        content |= papers_as(formats, {stem: document})
        if progress is not None:
            progress(k + 1, len(dealt))
    assert lesson is not None
    asked = asked_in_tables(lesson.sheet.scene, find)
    whole = class_document(lesson, lines, asked, given.unit_of(given.drivers[0]).written)
    bound = [paper for name, paper in content.items() if name.endswith(".pdf")]
    content |= papers_as(formats, {"class": whole})
    if len(bound) > 1 and can_join():
        content["all-reports.pdf"] = one_after_another(bound)
    content["class.csv"] = _class_table(given, lines, asked).harmless().csv().encode("utf-8-sig")
    drawn = [(r.student.name, r.student.id, r.student.scheme, f"{r.values.driver:.9g}") for r in lines]
    blank = answers_template(asked, given.units, "en", drawn, "variant", "at in a class")
    content["answers_template.csv"] = blank.harmless().csv().encode("utf-8-sig")
    result = CourseDesigns(given, tuple(lines), asked, content, agrees, "pdf" not in formats or can_typeset())
    if out is not None:
        result.write(out)
    return result


def _stem(k: int, count: int, who: Student) -> str:
    """The name of a report's file, which no two share."""
    words = "-".join(word for word in (who.name or who.id, who.scheme, who.place) if word)
    return f"{k + 1:0{max(2, len(str(count)))}}-{safe_name(words) if words else 'report'}"


def _drawn(
    scene: Mechanism, name: str, language: str, convention: str, at: At = None
) -> Figures:
    """The pages of a figure; none where it cannot be drawn: a report without it is whole in all else."""
    try:
        figure = draw(scene, at=at, language=language, convention=convention, figures=[name]).figures.get(name)
    except Unsolvable:
        return ()
    pages = (figure, *figure.further) if figure is not None else ()
    return tuple(on_paper(page, paper_of(scene)) for page in pages)


def _figures(scene: Mechanism, language: str, convention: str) -> dict[str, Figures]:
    """Figures that all students of a scheme share."""
    paper = paper_of(scene)
    figures = {name: _drawn(scene, name, language, convention) for name in ("structure", "positions")}
    pages_of: list[Picture | Plate] = []
    for page in sweep(scene, language=languages(language)[0]).figures.values():
        if isinstance(page, ChartPage):
            size = page.width, page.height
            pages_of.append(plate(page.content("svg", text="outlines"), size, paper, f"{page.title}. {page.desc}"))
        else:
            pages_of.append(on_paper(page, paper))
    return figures | {"diagrams": tuple(pages_of)}


# -- schemes, and which of them each student draws ---------------------------------------------------------------------


def scheme_of(name: str, source: SceneLike, find: Iterable[str | Symbol] | None, count: int) -> Scheme:
    """A mechanism with all its positions, each drawn and held against the solver."""
    scene = for_paper(as_scene(source))
    structure = solver.structure_of(scene)
    key = scene.drivers[0].key
    named = named_positions(scene)
    if named is not None and named.names.names:
        drivers = dict(named.values)
    else:
        drivers = {str(k): row[key] for k, row in enumerate(positions(structure, None, count)[0], 1)}
    asked = asked_in_tables(scene, find)
    places = {}
    for place, value in drivers.items():
        try:
            motion = solved_here(structure, {key: value})
            sheet = execute(paper_plan(structure, {key: value}, asked))
            lesson = compared(sheet, motion, "en", "chinese", asked)
            lesson.report.must_agree(scene)
            places[place] = read_at(place, value, lesson, asked)
        except Unsolvable:
            places[place] = PlaceValues(place, scene.unit_of(scene.drivers[0]).of(value))
    return Scheme(name, scene, drivers, places)


def read_at(place: str, value: float, lesson: Lesson, asked: Sequence[Symbol]) -> PlaceValues:
    """What was read off at a position, in scene units."""
    rows = [row for row in lesson.report.rows if row.symbol in asked]
    read = {row.symbol: value_read(lesson, row) for row in rows}
    exact = {
        row.symbol: lesson.in_unit(row.symbol, abs(row.true) if row.symbol.is_vector else float(row.true.real))
        for row in rows
    }
    return PlaceValues(place, lesson.sheet.scene.unit_of(lesson.sheet.scene.drivers[0]).of(value), read, exact)


def scheme_name(course: Mapping[str, Scheme], who: Student) -> str:
    """The scheme of a student; where there is but one, what stands in the table is the name of a group."""
    return who.scheme if who.scheme in course else next(iter(course))


def dealt_out(students: str | os.PathLike[str], course: Mapping[str, Scheme]) -> Iterator[Student]:
    """Every student with a scheme and a position of it.

    Raises CallError for a table without names, and all schemes and positions that there are not.
    """
    table = table_of(students)
    columns = {
        role: i for role, names in HEADS.items() for i, head in reversed(tuple(enumerate(table.heads)))
        if head.strip().lower() in names
    }  # fmt: skip
    if "name" not in columns and "id" not in columns:
        raise CallError.of(str(students), "no column of names", "write a head name or id",
                           names=', '.join(table.heads)[:200])
    problems: list[Problem] = []
    head = table.heads[columns["scheme"]].strip().lower() if "scheme" in columns else ""
    may_be_groups = len(course) == 1 and head in GROUPS
    if head and "" in course and not may_be_groups:
        named = dict.fromkeys(cells[columns["scheme"]] for _, cells in table.rows if len(cells) > columns["scheme"])
        if schemes := ", ".join(filter(None, named))[:80]:
            found, wanted = (
                Phrase("schemes without their data", schemes=schemes),
                Phrase("give a row for each rows file.csv"),
            )
            raise CallError.of(f"{students}, {head}", found, wanted)
    listed = []
    for line, cells in table.rows:
        who = Student(**{role: cells[i] if i < len(cells) else "" for role, i in columns.items()})
        where = Phrase("line of students and line", students=students, line=line)
        if who.scheme and who.scheme not in course and not may_be_groups:
            problems.append(Problem(where, "there is no scheme", did_you_mean(who.scheme, course), scheme=who.scheme))
            continue
        known = course[scheme_name(course, who)].places if who.scheme or len(course) == 1 else None
        all_known = dict.fromkeys(n for scheme in course.values() for n in scheme.places) if known is None else known
        if who.place and who.place not in all_known:
            problems.append(Problem(where, "there is no position", did_you_mean(who.place, all_known), at=who.place))
            continue
        if who.place and known is not None and not known[who.place].read:
            problems.append(Problem(where, "position cannot be drawn", "give another one", place=who.place))
        listed.append(who)
    if problems:
        raise CallError(*problems)
    free = {name: [p for p, v in scheme.places.items() if v.read] for name, scheme in course.items()}
    if not any(free.values()):
        raise CallError.of("positions", "none of them can be drawn", "give others in positions")
    taken: dict[str, list[str]] = {}
    for who in listed:
        if who.place:
            taken.setdefault(who.scheme, []).append(who.place)
    for who in listed:
        if not who.scheme and len(course) > 1:
            # the first scheme with a position left, and when all are dealt out from the start again
            name = min(free, key=lambda n: len(taken.get(n, ())) // max(1, len(free[n])))
            who = replace(who, scheme=name)
        if not who.place:
            places_taken = taken.setdefault(who.scheme, [])
            places = free[scheme_name(course, who)]
            who = replace(who, place=min(places, key=places_taken.count))
            places_taken.append(who.place)
        yield who


def asked_in_tables(scene: Mechanism, find: Iterable[str | Symbol] | None) -> tuple[Symbol, ...]:
    """What the tables show: what is asked of the position itself, else the motion of the last joint and the rates of
    what turns about fixed pivots, else every velocity and acceleration that is read off."""
    asked = (s for s in asked_symbols(scene, find) if s.scope in ("motion", "position", "force") and not s.at)
    kept = tuple(asked) or asked_of(scene.asking(find=()))
    if kept:
        return kept
    drawn = (reading.symbol for reading in read_off(execute(paper_plan(scene, None, ()))))
    return tuple(s for s in drawn if s.scope == "motion" and s.to is None and s.kind in ("v", "a", "omega", "alpha"))


# -- the report of a student, and the table of the class ---------------------------------------------------------------


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


def _report(
    lesson: Lesson, student: Student, scheme: Scheme, stands: float, data: tuple[tuple[str, ...], ...],
    asked: Sequence[Symbol], figures: Mapping[str, Figures],
) -> Document:  # fmt: skip
    """The report of one student.

    Parameters
    ----------
    lesson : the mechanism in the student's position
    stands : value of the first driver there (rad, m)
    data : heads and rows of the data of all schemes, the name of each first; without any nothing is told of them
    asked : what the table of all positions shows
    figures : "structure", "positions", "loops" and "diagrams", where they could be drawn
    """
    language, driver = lesson.language, scheme.scene.unit_of(scheme.scene.drivers[0])
    driver_value = said("course place", language, value=driver.said(stands))
    task = Heading(said("course task", language), 2, fresh=True)
    blocks: list[Block] = [*_cover(lesson, student, driver_value), task, *given_words(lesson)]
    if data:
        blocks.append(Together((Heading(said("course data", language)), *_data(data, student, language))))
    for name in ("structure", "positions"):
        blocks += _headed(f"course {name}", figures[name], language)
    place = said("course position", language, position=in_markup(student.place)) if student.place else driver_value
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


def class_document(lesson: Lesson, rows: Sequence[ClassRow], asked: Sequence[Symbol], unit: str) -> Document:
    """The values of a whole class in one table; the lesson lends its letters, units and paper."""
    language = lesson.language
    keys = ["name of student"]
    cells: list[tuple[str, ...]] = [(row.student.name or "–",) for row in rows]
    more = (("course id head", "id"), ("course scheme head", "scheme"), ("course place head", "place"))
    for key, name in more:
        column = [getattr(row.student, name) for row in rows]
        if any(column):
            keys.append(key)
            cells = [(*before, own or "–") for before, own in zip(cells, column, strict=True)]
    plain = [tuple(in_markup(cell) for cell in line) for line in cells]
    tables = _value_tables(lesson, said_each(language, keys), plain, [row.values for row in rows], asked, unit)
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
    """Title, whose it is, what is theirs, and the mechanism."""
    language = lesson.language
    yield Heading(said("course design", language), 1)
    yield Heading(scene_title(lesson), 2)
    blanks = []
    if student.name:
        yield Paragraph(said("course student", language, name=in_markup(student.name)))
    else:
        blanks.append("name of student")
    if student.id:
        yield Paragraph(said("course id", language, id=in_markup(student.id)))
    else:
        blanks.append("class of student")
    if student.scheme:
        yield Paragraph(said("course scheme", language, scheme=in_markup(student.scheme)))
    if student.place:
        yield Paragraph(said("course position", language, position=in_markup(student.place)))
    yield Paragraph(place)
    yield Fields(said_each(language, (*blanks, "course teacher", "date")))
    yield Picture(mechanism_picture(lesson))


def _letters(head: str) -> str:
    """The head of a column as markup, a letter with its index set as such.

    >>> _letters("l_O2A (mm)"), _letters("n2 (r/min)"), _letters("driver.angle")
    ('$l_{O2A}$ (mm)', '$n_{2}$ (r/min)', 'driver.angle')
    """
    parted = re.match(r"([^\W\d_])(?:_([^\W_]+)|(\d+))(?=\s|$)", head)
    if parted is None:
        return in_markup(head)
    return f"${parted[1]}_{{{parted[2] or parted[3]}}}${in_markup(head[parted.end():])}"


def _data(data: tuple[tuple[str, ...], ...], student: Student, language: str) -> Iterable[TableBlock]:
    """The data of the schemes, split where they are many, the student's own row in bold."""
    heads, *rows = data
    bold = frozenset(i for i, row in enumerate(rows) if row[0] == student.scheme)
    for k in range(1, len(heads), MOST_VALUES):
        part = slice(k, k + MOST_VALUES)
        names = (said("course scheme head", language), *((("en", _letters(head)),) for head in heads[part]))
        lines = tuple(tuple(map(in_markup, (row[0], *row[part]))) for row in rows)
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
    driver = said("course driver head", language, unit=unit)
    tables = []
    for k in range(0, len(asked), MOST_VALUES):
        part = asked[k : k + MOST_VALUES]
        columns = tuple((("en", f"${lesson.letters.vector(s)}$ {lesson.unit(s)}"),) for s in part)
        rows = tuple(
            (*named, number(place.driver, DIGITS),
             *(number(place.read[s], DIGITS) if s in place.read else "–" for s in part))
            for named, place in zip(cells, places, strict=True)
        )  # fmt: skip
        align = "l" * len(heads) + "r" * (1 + len(part))
        tables.append(TableBlock((*heads, driver, *columns), rows, align, bold))
    return tables


def _class_table(scene: Mechanism, rows: Sequence[ClassRow], asked: Sequence[Symbol]) -> Table:
    heads = ["name", "id", "variant", "position", "at"]
    heads += [head for s in asked for head in (head_of(s, scene.units), f"{s} exact")]
    lines = [
        (row.student.name, row.student.id, row.student.scheme, row.student.place, row.values.driver,
         *(v for s in asked for v in (row.values.read.get(s), row.values.exact.get(s))))
        for row in rows
    ]  # fmt: skip
    return Table.of(heads, lines, ("", "", "", "", ".9g", *[".9g"] * (2 * len(asked))))
