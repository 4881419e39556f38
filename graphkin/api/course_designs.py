"""``graphkin handout --template course-design``: the reports of a course project, and the table of the class."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from graphkin.api.arguments import (
    ON_SHEETS,
    At,
    SceneLike,
    asked_symbols,
    driver_values,
    for_paper,
    known_words,
    require_callable,
    whole_number,
)
from graphkin.api.checked import solved_here
from graphkin.api.course_schemes import asked_in_tables, dealt_out, read_at, scheme_name, scheme_of
from graphkin.api.drawn import draw
from graphkin.api.problem_sets import drawn_schemes, schemes_of
from graphkin.api.results import OfScene, Result
from graphkin.api.sweep import sweep
from graphkin.drawing.chart import ChartPage
from graphkin.errors import CallError, Problem, Unsolvable
from graphkin.files import Json, path_of
from graphkin.jobs import Progress
from graphkin.papers.blocks import Picture, Plate
from graphkin.papers.course_design import ClassRow, CourseDesign, Student, class_document, on_paper, plate, report
from graphkin.papers.page import document_page
from graphkin.papers.paper import paper_of, paper_plan
from graphkin.papers.pdf import can_join, can_typeset, one_after_another, pdf
from graphkin.papers.prepare import FORMATS, lesson_of
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.scene.written import safe_name
from graphkin.table import Table
from graphkin.words import Phrase, languages

__all__ = ["CourseDesigns", "course_design"]


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
    students: str | os.PathLike[str] | None = None,
    rows: str | os.PathLike[str] | None = None,
    out: str | os.PathLike[str] | None = None,
    at: At = None,
    find: Iterable[str | Symbol] | None = None,
    formats: Sequence[str] = FORMATS,
    language: str | None = None,
    convention: str | None = None,
    positions: int | None = None,
    progress: Progress | None = None,
    variants: int | None = None,
    seed: int = 0,
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
        raise CallError(Problem("at", Phrase("beside students"), Phrase("write each position into the table of the")))
    count = 12 if positions is None else whole_number("positions", positions, 2, 72)
    spoken, letters = language or given.sheet.language, convention or given.sheet.convention
    if rows is not None and variants is not None:
        raise CallError(Problem("variants", Phrase("beside rows"), Phrase("give one of them")))
    sources: Mapping[str, SceneLike] = {"": scene}
    data: tuple[tuple[str, ...], ...] = ()
    if rows is not None:
        sources, data = schemes_of(scene, rows)
    elif variants is not None:
        sources, data = drawn_schemes(scene, variants, seed, find)
    course = {name: scheme_of(name, source, find, count) for name, source in sources.items()}
    if students is None:
        dealt = [(Student(scheme=name), driver_values(one.scene, at)) for name, one in course.items()]
        dealt = [(replace(who, place=at if isinstance(at, str) else ""), values) for who, values in dealt]
    else:
        dealt = [(who, course[scheme_name(course, who)].values(who.place)) for who in dealt_out(students, course)]
    content: dict[str, bytes] = {}
    lines, agrees, shared, bound = [], True, dict[str, dict[str, tuple[Picture | Plate, ...]]](), []
    lesson = None
    for k, (who, values) in enumerate(dealt):
        one = course[scheme_name(course, who)]
        motion = solved_here(one.scene, values)
        what = paper_plan(motion.structure, values, asked_symbols(one.scene, find))
        lesson = lesson_of(what, motion, spoken, letters)
        agrees = agrees and lesson.report.ok
        if one.name not in shared:
            shared[one.name] = _figures(one.scene, spoken, letters)
        key = one.scene.drivers[0].key
        asked = asked_in_tables(one.scene, find)
        stands = lesson.sheet.drivers[key]
        place = one.places[who.place] if who.place in one.places else read_at("", stands, lesson, asked)
        lines.append(ClassRow(who, place))
        made = CourseDesign(
            lesson, who, one.scene.unit_of(one.scene.drivers[0]).said(stands), data,
            tuple(one.places.values()), asked, one.scene.unit_of(one.scene.drivers[0]).written, **shared[one.name],
            loops=_drawn(one.scene, "loops", spoken, letters, place.driver),
        )  # fmt: skip
        document = report(made)
        stem = "report" if len(dealt) == 1 and students is None and not data else _stem(k, len(dealt), who)
        if "html" in formats:
            content[f"{stem}.html"] = document_page(document).encode()
        if "pdf" in formats and can_typeset():
            content[f"{stem}.pdf"] = pdf(document)
            bound.append(content[f"{stem}.pdf"])
        if progress is not None:
            progress(k + 1, len(dealt))
    assert lesson is not None
    asked = asked_in_tables(lesson.sheet.scene, find)
    whole = class_document(lesson, lines, asked, given.unit_of(given.drivers[0]).written)
    if "html" in formats:
        content["class.html"] = document_page(whole).encode()
    if "pdf" in formats and can_typeset():
        content["class.pdf"] = pdf(whole)
        if len(bound) > 1 and can_join():
            content["all-reports.pdf"] = one_after_another(bound)
    content["class.csv"] = _class_table(given, lines, asked).harmless().csv().encode("utf-8-sig")
    content["answers_template.csv"] = _template(given, lines, asked).harmless().csv().encode("utf-8-sig")
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
) -> tuple[Picture | Plate, ...]:
    """The pages of a figure; none where it cannot be drawn: a report without it is whole in all else."""
    try:
        figure = draw(scene, at=at, language=language, convention=convention, figures=[name]).figures.get(name)
    except Unsolvable:
        return ()
    pages = (figure, *figure.further) if figure is not None else ()
    return tuple(on_paper(page, paper_of(scene)) for page in pages)


def _figures(scene: Mechanism, language: str, convention: str) -> dict[str, tuple[Picture | Plate, ...]]:
    """Figures that all students of a scheme share."""
    paper = paper_of(scene)
    found = {name: _drawn(scene, name, language, convention) for name in ("structure", "positions")}
    pages_of: list[Picture | Plate] = []
    for page in sweep(scene, language=languages(language)[0]).figures.values():
        if isinstance(page, ChartPage):
            size = page.width, page.height
            pages_of.append(plate(page.content("svg", text="outlines"), size, paper, f"{page.title}. {page.desc}"))
        else:
            pages_of.append(on_paper(page, paper))
    return found | {"diagrams": tuple(pages_of)}


def _class_table(scene: Mechanism, rows: Sequence[ClassRow], asked: Sequence[Symbol]) -> Table:
    heads = ["name", "id", "variant", "position", "at", *(c for s in asked for c in (_head(scene, s), f"{s} exact"))]
    lines = [
        (row.student.name, row.student.id, row.student.scheme, row.student.place, row.values.driver,
         *(v for s in asked for v in (row.values.read.get(s), row.values.exact.get(s))))
        for row in rows
    ]  # fmt: skip
    return Table.of(heads, lines, ("", "", "", "", ".9g", *[".9g"] * (2 * len(asked))))


def _template(scene: Mechanism, rows: Sequence[ClassRow], asked: Sequence[Symbol]) -> Table:
    """A table for the class to fill in, as `audit` reads it, with everyone's driver value."""
    heads = ["name", "id", "variant", "at"]
    for s in asked:
        heads += [_head(scene, s), f"{s} direction"] if s.is_vector else [_head(scene, s)]
    blank = [""] * (len(heads) - 4)
    lines = [(r.student.name, r.student.id, r.student.scheme, f"{r.values.driver:.9g}", *blank) for r in rows]
    return Table.of(heads, lines)


def _head(scene: Mechanism, symbol: Symbol) -> str:
    unit = symbol.unit(scene.units).text
    return f"{symbol} ({unit})" if unit else str(symbol)
