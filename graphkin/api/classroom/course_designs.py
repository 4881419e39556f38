"""``graphkin handout --template course-design``: the schemes of a course with all their positions, the scheme and
position of each student, and the reports and the table of the class as files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from graphkin.api.arguments import (
    ON_SHEETS,
    At,
    asked_symbols,
    driver_values,
    for_paper,
    known_words,
    require_callable,
    whole_number,
)
from graphkin.api.classroom.problem_sets import drawn_schemes, schemes_of
from graphkin.api.drawn import draw
from graphkin.api.results import OfScene, Result
from graphkin.api.sweep import sweep
from graphkin.drawing.chart import ChartPage
from graphkin.errors import CallError, Unsolvable
from graphkin.files import Json, path_of
from graphkin.jobs import Progress
from graphkin.papers.blocks import Picture, Plate
from graphkin.papers.courses import (
    Figures,
    Placed,
    Student,
    class_document,
    class_table,
    course_report,
    dealt_out,
    on_paper,
    plate,
    read_at,
    scheme_for,
    scheme_of,
)
from graphkin.papers.documents import answers_template
from graphkin.papers.lesson import lesson_of
from graphkin.papers.paper import paper_of, paper_plan
from graphkin.papers.pdf import FORMATS, one_after_another, papers_as
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike, safe_name
from graphkin.scene.symbol import Symbol
from graphkin.solver import solved_here
from graphkin.table import Table
from graphkin.words import Phrase, languages


@dataclass(frozen=True, repr=False, eq=False)
class CourseDesigns(OfScene, Result):
    """The reports of a course project: a file for each student, and the table of the class.

    ``rows`` are the lines of that table: student, scheme and position, readings.
    """

    mechanism: Mechanism
    rows: tuple[Placed, ...]
    asked: tuple[Symbol, ...]
    content: Mapping[str, bytes]
    agrees: bool
    notes: ClassVar[tuple[Phrase, ...]] = ()
    """Deviations from the request: none."""

    @property
    def ok(self) -> bool:
        """Whether every reading of every report agrees with the analytic solver."""
        return self.agrees

    @cached_property
    def table(self) -> Table:
        """A row for each student: name, variant, position, driver value, and each quantity as read and exact."""
        return class_table(self.mechanism, self.rows, self.asked)

    @cached_property
    def data(self) -> dict[str, Json]:
        """The table for programs, in scene units."""
        students: list[dict[str, Json]] = [
            {"name": student.name, "id": student.id, "variant": student.scheme,
             "position": student.place, "at": values.driver,
             "values": {str(s): values.read.get(s) for s in self.asked},
             "exact": {str(s): values.exact.get(s) for s in self.asked}}
            for student, values in self.rows
        ]
        return {"ok": self.ok, "students": students}

    @property
    def files(self) -> Mapping[str, bytes]:
        """Content of each file by name: the reports, class.csv, class.html, class.pdf, answers_template.csv."""
        return self.content

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
    scene : as for `solve`
    find : as for `check`
    students : a CSV file with a line for each student: a column name (姓名), and where wished id (学号), scheme
        (方案, group) and position (位置, its name); a student without a position gets the next one of the scheme, a
        student without a scheme the next scheme with a position left.  Without it one report with a blank cover (one
        for each scheme)
    rows : a CSV file with a row of data for each scheme, as `problem_set` reads it
    variants, seed : instead, a number of schemes drawn as those of a problem set
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
    mechanisms = {name: for_paper(source) for name, source in sources.items()}
    course = {name: scheme_of(name, paper, asked_symbols(paper, find), count) for name, paper in mechanisms.items()}
    if students is None:
        place = at if isinstance(at, str) else ""
        dealt = [
            (Student(scheme=name, place=place), driver_values(scheme.scene, at)) for name, scheme in course.items()
        ]
    else:
        dealt = [(who, scheme_for(who, course).values(who.place)) for who in dealt_out(students, course)]
    content: dict[str, bytes] = {}
    lines, agrees, shared = list[Placed](), True, dict[str, dict[str, Figures]]()
    lesson = None
    for k, (who, values) in enumerate(dealt):
        scheme = scheme_for(who, course)
        motion = solved_here(scheme.scene, values)
        planned = paper_plan(motion.structure, values, asked_symbols(scheme.scene, find))
        lesson = lesson_of(planned, motion, spoken, letters)
        agrees = agrees and lesson.report.ok
        if scheme.name not in shared:
            shared[scheme.name] = _figures(scheme.scene, spoken, letters)
        asked = scheme.asked
        stands = lesson.sheet.drivers[scheme.scene.drivers[0].key]
        readings = scheme.places.get(who.place) or read_at("", stands, scheme.scene, lesson.report, asked)
        lines.append((who, readings))
        figures = shared[scheme.name] | {"loops": _drawn(scheme.scene, "loops", spoken, letters, readings.driver)}
        document = course_report(lesson, who, scheme, stands, data, asked, figures)
        words = "-".join(filter(None, (who.name or who.id, who.scheme, who.place)))
        stem = f"{k + 1:0{max(2, len(str(len(dealt))))}}-{safe_name(words) if words else 'report'}"
        if len(dealt) == 1 and students is None and not data:
            stem = "report"
        content |= papers_as(formats, {stem: document})
        if progress is not None:
            progress(k + 1, len(dealt))
    assert lesson is not None
    whole = class_document(lesson, lines, asked, given.unit_of(given.drivers[0]).written)
    bound = [paper for name, paper in content.items() if name.endswith(".pdf")]
    content |= papers_as(formats, {"class": whole})
    if len(bound) > 1:
        content["all-reports.pdf"] = one_after_another(bound)
    content["class.csv"] = class_table(given, lines, asked).harmless().csv().encode("utf-8-sig")
    drawn = [(student.name, student.id, student.scheme, f"{values.driver:.9g}") for student, values in lines]
    blank = answers_template(asked, given.units, "en", drawn, "variant", "at in a class")
    content["answers_template.csv"] = blank.harmless().csv().encode("utf-8-sig")
    return CourseDesigns(given, tuple(lines), asked, content, agrees).saved(out)


def _drawn(
    scene: Mechanism, name: str, language: str, convention: str, at: At = None
) -> Figures:
    """The pages of a figure; none where it cannot be drawn: the report is complete without it."""
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
