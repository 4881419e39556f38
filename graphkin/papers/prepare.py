"""From a scene to its lesson: readings held against the solver, positions for a screen.

The files of a handout, by name.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from graphkin import solver
from graphkin.checking.readings import read_off
from graphkin.checking.report import compare, rounding_of
from graphkin.checking.slips import Evidence
from graphkin.checking.uncertainty import predict
from graphkin.construction import Plan, execute, plan
from graphkin.construction.centres import Centres, find_centres
from graphkin.construction.forces import force_scale
from graphkin.construction.scales import Scales
from graphkin.construction.sheet import Sheet
from graphkin.drawing.figures.diagrams import diagram_figures
from graphkin.errors import Unsolvable
from graphkin.papers.blocks import Block, Document
from graphkin.papers.documents import (
    answer_key,
    answers_template,
    beginning,
    key_table,
    problem,
    solution,
    solution_blocks,
)
from graphkin.papers.exports import files_for, question_of
from graphkin.papers.lesson import Lesson
from graphkin.papers.paper import paper_plan
from graphkin.papers.pdf import can_typeset, papers_as
from graphkin.papers.screen import POSITIONS, Progress, common_scales, handout_page, motion_data, rows_in_order
from graphkin.papers.variants import Variant, asked_of
from graphkin.scene.drivers import moves_by_law
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver import Motion
from graphkin.solver.values import force_values
from graphkin.structure import Structure
from graphkin.words import languages

__all__ = [
    "FORMATS", "Papers", "compared", "evidence_of", "handout_files", "lesson_of", "positions", "usual_count",
    "views_of",
]  # fmt: skip

MANY_LINKS = 10


def lesson_of(what: Plan, motion: Motion, language: str, convention: str) -> Lesson:
    """The lesson of a plan, with its check and with the tolerances of a pencil drawing.

    Raises
    ------
    Disagreement : its own check finds a value out of tolerance
    """
    lesson = compared(execute(what), motion, language, convention, what.asked)
    scene = lesson.sheet.scene
    lesson.report.must_agree(scene)
    return replace(lesson, tolerance=predict(what, "pencil", scene.question.sheet.tools))


def compared(sheet: Sheet, motion: Motion, language: str, convention: str, asked: tuple[Symbol, ...]) -> Lesson:
    """The lesson of a sheet, its readings held against the motion; without tolerances of a pencil."""
    motion = solver.as_drawn(motion, sheet.structure)
    exact = solver.exact_values(motion, asked)
    scale, lost = (force_scale(sheet), force_values(motion)[1]) if sheet.has_forces else (0.0, 0.0)
    rounding = rounding_of(motion, lost)
    report = compare(sheet, read_off(sheet), exact, asked, rounding=rounding, force_scale=scale)
    return Lesson(sheet, report, {}, language, convention, asked)


def evidence_of(what: Plan, motion: Motion, lesson: Lesson) -> Evidence:
    """What the slips of a lesson are looked for in: everything drawn, so that one in what leads to the asked counts."""
    whole = plan(what.structure, what.values, ())
    drawn = what if set(what.elements) == set(whole.elements) else whole
    exact = solver.exact_values(solver.as_drawn(motion, what.structure), what.asked)
    return Evidence(drawn, exact, lesson.tolerance, lambda symbol: ())


def usual_count(scene: Mechanism) -> int:
    """How many positions of the driver a page shows where nobody says: fewer of a mechanism of many links, of which
    each takes its time to draw and to load; only its own of one whose drivers move by laws over the time."""
    if moves_by_law(scene):
        return 1
    return POSITIONS if len(scene.links) <= MANY_LINKS else POSITIONS // 2


def positions(
    of: Mechanism | Structure, values: Mapping[str, float] | None, count: int = POSITIONS
) -> tuple[list[dict[str, float]], int]:
    """Driver values (rad, m) spread over a turn or over what the motion reaches, and which of them is the given one."""
    motion = solver.solve(of, at=values, sweep=count)
    drivers = motion.scene.drivers
    keys = [d.key for d in drivers]
    own = {d.key: d.values[0] for d in drivers} | dict(values or {})
    rows = [dict(zip(keys, map(float, motion.values[i]), strict=True)) for i in rows_in_order(motion.ok)]
    first = keys[0]
    at = next((i for i, row in enumerate(rows) if np.isclose(row[first], own[first], rtol=0, atol=1e-9)), None)
    if at is None:
        at = sum(row[first] < own[first] for row in rows)
        rows.insert(at, own)
    rows[at] = own
    return rows, at


def views_of(
    structure: Structure,
    values: Mapping[str, float] | None,
    asked: Sequence[Symbol],
    language: str,
    convention: str,
    paper: Scales,
    count: int = POSITIONS,
    progress: Progress | None = None,
) -> tuple[list[Lesson], int]:
    """The positions that the screen shows, each drawn and with its centres, and which of them is the given one.

    ``progress`` is called with the number of positions done and the number of all.  ``paper`` are the scales of the
    solution on paper, kept wherever the figures fit.  Positions in which the construction fails (dead points), or its
    check, are left out.
    """
    rows, start = positions(structure, values, count)
    made = {start: plan(structure, rows[start], asked)}
    for way in (range(start + 1, len(rows)), range(start - 1, -1, -1)):
        last = made[start]
        for i in way:
            with suppress(Unsolvable):
                try:
                    made[i] = last = plan(structure, rows[i], asked, near=last.exact)
                except Unsolvable:  # the way from its neighbour is barred, from the scene's own position it may not be
                    made[i] = last = plan(structure, rows[i], asked)
    given = sum(i < start for i in made)
    plans = [made[i] for i in sorted(made)]
    sheets = [execute(replace(w, scales=s)) for w, s in zip(plans, common_scales(plans, paper), strict=True)]
    centres = _centres(structure, sheets, given, progress)
    views: list[Lesson] = []
    start = given
    for number, (sheet, here) in enumerate(zip(sheets, centres, strict=True)):
        motion = solver.solve(structure, at=sheet.drivers)
        lesson = compared(sheet, motion, language, convention, tuple(asked))
        if number != given and any(row.ok is False for row in lesson.report.rows):
            start -= number < given
        else:
            views.append(replace(lesson, centres=here))
    return views, start


def _centres(
    structure: Structure, sheets: Sequence[Sheet], given: int, progress: Progress | None
) -> list[Centres | None]:
    """The centres in each position, from the given one onwards and then backwards: each starts from its neighbour."""
    found: dict[int, Centres | None] = {}
    for i in (*range(given, len(sheets)), *range(given - 1, -1, -1)):
        near = found.get(i - 1) if i > given else found.get(i + 1)
        found[i] = None
        for start in (near, None) if near is not None else (None,):
            with suppress(Unsolvable):
                found[i] = find_centres(structure, sheets[i].drivers, sheet=sheets[i], near=start)
                break
        if progress is not None:
            progress(len(found), len(sheets))
    return [found[i] for i in range(len(sheets))]


FORMATS = ("html", "pdf")


def handout_files(
    lesson: Lesson,
    views: Sequence[Lesson] = (),
    start: int = 0,
    formats: Sequence[str] = FORMATS,
    progress: Progress | None = None,
    values: Mapping[str, float] | None = None,
) -> Mapping[str, bytes]:
    """Everything to be written for a lesson.

    ``problem.html`` and ``problem.pdf`` (without answers), ``handout.html`` (the solution to step through),
    ``solution.pdf``, ``key.html``, ``key.pdf`` and ``key.csv``.  Without the extra ``pdf`` the figure sheets
    ``mechanism.pdf``, ``velocity.pdf`` and ``acceleration.pdf`` take the place of the typeset ones.

    Parameters
    ----------
    views, start : positions of the driver for the screen, and which of them is the given one; without any the given
        one alone
    formats : "html", "pdf" or both
    progress : called with the number of positions done for the screen and the number of all
    values : of the drivers, from which the motion on the screen goes on
    """
    worked = tuple(solution_blocks(lesson, beginning(lesson)))
    sheets = {"problem": problem(lesson), "key": answer_key(lesson)}
    # typesetting runs beside Python
    with ThreadPoolExecutor(1) as beside:
        typeset = beside.submit(_typeset, lesson, sheets, worked) if "pdf" in formats else None
        made: dict[str, bytes] = {}
        if "html" in formats:
            moving = motion_data(lesson.sheet, lesson.letters, values)
            page = handout_page(lesson, views or (lesson,), start, progress, moving, worked)
            made |= papers_as(("html",), sheets) | {"handout.html": page.encode()}
        if typeset is not None:
            made |= typeset.result()
    made["key.csv"] = key_table(lesson).csv().encode()
    template = answers_template(lesson.questions, lesson.sheet.scene.units, languages(lesson.language)[0])
    made["answers_template.csv"] = template.csv().encode("utf-8-sig")
    return made


def _typeset(
    lesson: Lesson, sheets: Mapping[str, Document], worked: Sequence[Block] | None = None
) -> dict[str, bytes]:
    """Problem sheet, key and worked solution typeset, or the figure sheets where nothing can be typeset."""
    if can_typeset():
        return papers_as(("pdf",), {**sheets, "solution": solution(lesson, worked)})
    drawn = diagram_figures(lesson.sheet, language=lesson.language, convention=lesson.convention)
    return {f"{name}.pdf": figure.content("pdf") for name, figure in drawn.items()}


@dataclass(frozen=True)
class Papers:
    """Writes the papers of a variant: problem sheet and key in each format, and the worked solution as PDF; questions
    for learning platforms are called by the ``name`` of the set.

    A value that can be sent to another process.
    """

    language: str
    convention: str
    formats: tuple[str, ...]
    exports: tuple[str, ...] = ()
    name: str = "scene"

    def __call__(self, variant: Variant) -> Mapping[str, bytes]:
        scene = variant.scene
        asked = asked_of(scene)
        motion = solver.solve(scene)
        what = paper_plan(motion.structure, None, asked, share=False)
        lesson = lesson_of(what, motion, self.language, self.convention)
        made = {"key.csv": key_table(lesson).csv().encode()}
        sheets = {"problem": problem(lesson), "key": answer_key(lesson)}
        if "html" in self.formats:
            made |= papers_as(("html",), sheets)
        if "pdf" in self.formats:
            made |= _typeset(lesson, sheets)
        if self.exports:
            question = question_of(lesson, evidence_of(what, motion, lesson), f"{self.name}-{variant.name}")
            made |= files_for(question, self.exports)
        return made
