"""``graphkin handout``: problem sheet, worked solution and answer key."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, astuple, dataclass, field, fields
from functools import cached_property, partial

from graphkin import solver
from graphkin.api.arguments import (
    ON_SHEETS,
    At,
    as_scene,
    asked_symbols,
    for_paper,
    known_words,
    placed,
    require_callable,
    unknown_words,
    whole_number,
)
from graphkin.api.cams import cam_made
from graphkin.api.classroom.task_papers import cam_papers
from graphkin.api.results import OfScene, Result, named
from graphkin.errors import CallError, as_list
from graphkin.files import Json, path_of
from graphkin.jobs import Progress
from graphkin.papers.blocks import Block
from graphkin.papers.documents import (
    KeyRow,
    answer_key,
    answers_template,
    beginning,
    key_rows,
    key_table,
    problem,
    solution,
    solution_blocks,
)
from graphkin.papers.exports import PLATFORMS, Question, files_for, question_of
from graphkin.papers.html import blocks_html
from graphkin.papers.lesson import Lesson, lesson_of, usual_count, views_of
from graphkin.papers.paper import paper_plan
from graphkin.papers.pdf import FORMATS, papers_as
from graphkin.papers.screen import handout_page, motion_data
from graphkin.papers.variants import Variant, asked_of
from graphkin.scene.drivers import moves_by_law
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike
from graphkin.scene.symbol import Symbol
from graphkin.solver import solved_here
from graphkin.table import Table
from graphkin.words import Phrase, listed


@dataclass(frozen=True, repr=False, eq=False)
class Handout(OfScene, Result):
    """A handout: its lesson, and its files by name (`files`).  In a notebook it shows the answer key.

    ``elsewhere`` is what was asked of other positions, which papers of one position leave out.
    """

    lesson: Lesson
    values: Mapping[str, float] | None
    formats: tuple[str, ...]
    count: int
    progress: Progress | None = field(default=None, compare=False)
    question: Question | None = None
    exports: tuple[str, ...] = ()
    elsewhere: tuple[Symbol, ...] = ()

    @property
    def mechanism(self) -> Mechanism:
        return self.lesson.sheet.scene

    @property
    def ok(self) -> bool:
        """Whether every reading of the drawing agrees with the analytic solver."""
        return self.lesson.report.ok

    @property
    def key(self) -> tuple[KeyRow, ...]:
        """The answer key, in scene units."""
        return key_rows(self.lesson)

    @cached_property
    def data(self) -> dict[str, Json]:
        """The key for programs, in scene units."""
        return {"ok": self.ok, "key": [asdict(row) for row in self.key]}

    def __getitem__(self, name: str) -> KeyRow:
        """A row of the key by its symbol.  Raises CallError for a symbol that is not in it."""
        return named({row.symbol: row for row in self.key}, name, Phrase("no answer of this name"))

    @cached_property
    def table(self) -> Table:
        """The answer key, in scene units."""
        return Table.of([f.name for f in fields(KeyRow)], map(astuple, self.key))

    @property
    def notes(self) -> tuple[Phrase, ...]:
        """Deviations from the request: quantities of other positions."""
        names = [*map(str, self.elsewhere)]
        return (Phrase("papers leave out", names=listed(names)),) if names else ()

    @cached_property
    def files(self) -> Mapping[str, bytes]:
        """Content of each file: problem.html, handout.html, problem.pdf, solution.pdf, key.html, key.pdf, key.csv,
        answers_template.csv for a class to fill in, and the files for learning platforms."""
        papers = papers_in(self.lesson, self.formats, self._page)
        blank = answers_template(self.lesson.questions, self.mechanism.units, self.lesson.first)
        papers["answers_template.csv"] = blank.csv().encode("utf-8-sig")
        for i, made in enumerate(cam_made(self.mechanism)):
            prefix = f"cam-{made.cam.link}-" if i else "cam-"
            papers |= cam_papers(made, self.formats, self.lesson.language, prefix)
        return papers | (files_for(self.question, self.exports) if self.question is not None else {})

    def _page(self, worked: Sequence[Block]) -> str:
        """The solution to step through, with the positions of the driver and the mechanism in motion."""
        sheet, language = self.lesson.sheet, self.lesson.language
        views, start = views_of(
            sheet.structure, self.values, sheet.asked, language, self.lesson.convention, sheet.scales, self.count,
            self._half(0),
        )
        moving = motion_data(sheet, self.lesson.letters, self.values)
        return handout_page(self.lesson, views, start, self._half(1), moving, worked)

    def _half(self, done: int) -> Progress | None:
        """Progress of one half of the work: placing every position, and then drawing it."""
        tell = self.progress
        return None if tell is None else lambda i, count: tell(i + done * count, 2 * count)

    def __repr__(self) -> str:
        return f"<Handout {self.mechanism.name}: {', '.join(self.formats)}>"

    def _repr_html_(self) -> str:
        return blocks_html(answer_key(self.lesson).blocks, self.lesson.first)


def handout(
    scene: SceneLike,
    *,
    at: At = None,
    find: Iterable[str | Symbol] | None = None,
    positions: int | None = None,
    exports: Sequence[str] = (),
    out: str | os.PathLike[str] | None = None,
    formats: Sequence[str] = FORMATS,
    language: str | None = None,
    convention: str | None = None,
    progress: Progress | None = None,
) -> Handout:
    """Problem sheet, worked solution and answer key of a scene.

    Parameters
    ----------
    scene, at : as for `solve`
    find : as for `check`
    out : folder for the files; none are written without it
    formats : "html", "pdf" or both
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    positions : of the driver, for the second slider of the page; 12 if None, 6 with more than 10 moving links
    progress : called with the finished parts of the page and the number of all, while its files are made
    exports : "moodle", "gift", "prairielearn": questions with tolerances and feedback for learning platforms

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    known_words(formats, language, convention, known_formats=FORMATS, known_languages=ON_SHEETS)
    platforms = known_platforms(exports)
    require_callable("progress", progress)
    _ = out is None or path_of(out)  # what is wrong with it is said before the work
    given = for_paper(scene)
    count = usual_count(given) if positions is None else whole_number("positions", positions, 1, 72)
    if count > 1 and moves_by_law(given):
        raise CallError.of("positions", "found value", "a driver that moves by a law stands", value=count)
    asked = asked_symbols(given, find)
    given, values = placed(given, at)
    motion = solved_here(given, values)
    planned = paper_plan(motion.structure, values, asked)
    wishes = given.question.sheet
    lesson = lesson_of(planned, motion, language or wishes.language, convention or wishes.convention)
    question = question_of(lesson, planned, motion, given.name) if platforms else None
    elsewhere = tuple(symbol for symbol in asked if symbol.at)
    kinds = tuple(dict.fromkeys(formats))
    return Handout(lesson, values, kinds, count, progress, question, platforms, elsewhere).saved(out)


def papers_of(
    scene: SceneLike, formats: Sequence[str] = FORMATS, language: str | None = None, convention: str | None = None,
    exports: Sequence[str] = (),
) -> Callable[[Variant], Mapping[str, bytes]]:
    """The writer of a variant's papers, also in another process: ``problem_set(scene, 30, render=papers_of(scene))``.

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    """
    known_words(formats, language, convention, known_formats=FORMATS, known_languages=ON_SHEETS)
    given = as_scene(scene)
    wishes = given.question.sheet
    return partial(_papers, given.name, known_platforms(exports), tuple(dict.fromkeys(formats)),
                   language or wishes.language, convention or wishes.convention)


def _papers(
    name: str, exports: Sequence[str], formats: Sequence[str], language: str, convention: str, variant: Variant
) -> Mapping[str, bytes]:
    """The papers of a variant in each format, and questions for learning platforms, called by the name of the set."""
    motion = solver.solve(variant.scene)
    planned = paper_plan(motion.structure, None, asked_of(variant.scene), share=False)
    lesson = lesson_of(planned, motion, language, convention)
    made = papers_in(lesson, formats)
    if exports:
        made |= files_for(question_of(lesson, planned, motion, f"{name}-{variant.name}"), exports)
    return made


def known_platforms(exports: Sequence[str]) -> tuple[str, ...]:
    """Names of learning platforms, each once.  Raises CallError for an unknown one."""
    if isinstance(exports, str):
        raise CallError.of("export", "is a text", "give a list", formats=exports)
    named = as_list("export", exports, Phrase("give a list of", names=listed([*PLATFORMS])))
    if wrong := unknown_words("export", named, PLATFORMS):
        raise CallError(*wrong)
    return tuple(dict.fromkeys(named))


def papers_in(
    lesson: Lesson, formats: Sequence[str], page: Callable[[Sequence[Block]], str] | None = None
) -> dict[str, bytes]:
    """The papers of a lesson by name: problem sheet and key in each format, key as CSV, "pdf" the typeset solution.

    Parameters
    ----------
    page : function that makes handout.html of the stages of the solution
    """
    worked = tuple(solution_blocks(lesson, beginning(lesson))) if "pdf" in formats or page is not None else ()
    sheets = {"problem": problem(lesson), "key": answer_key(lesson)}
    with ThreadPoolExecutor(1) as beside:  # typesetting runs beside Python
        typeset = {**sheets, "solution": solution(lesson, worked)} if "pdf" in formats else {}
        pdf = beside.submit(papers_as, ("pdf",), typeset)
        made = {"key.csv": key_table(lesson).csv().encode()}
        if "html" in formats:
            made |= papers_as(("html",), sheets)
            made |= {"handout.html": page(worked).encode()} if page is not None else {}
        return made | pdf.result()
