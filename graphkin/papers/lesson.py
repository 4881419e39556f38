"""A drawing as a lesson: its stages, equation by equation, its questions and results; and the lessons of a scene: its
drawing compared with the solver, and the positions for a screen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, reduce

import numpy as np

from graphkin import solver
from graphkin.account.notation import Notation, notation_of
from graphkin.account.voice import Account
from graphkin.checking.centres import must_agree
from graphkin.checking.readings import report_on
from graphkin.checking.report import Compared, Report, Uncertainty
from graphkin.checking.uncertainty import predict
from graphkin.construction import Plan, execute, plan
from graphkin.construction.board.scales import Scales, next_of_series
from graphkin.construction.board.sheet import Equation, Sheet
from graphkin.construction.board.steps import DiagramName, Step
from graphkin.construction.centres import Centres, find_centres
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import INSIDE, FigurePage
from graphkin.drawing.parts.polygon import extent
from graphkin.errors import Unsolvable
from graphkin.jobs import Progress
from graphkin.papers.blocks import Said, in_each, said
from graphkin.papers.paper import Paper, paper_of
from graphkin.scene.asked import known_symbol
from graphkin.scene.drivers import moves_by_law
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver import Motion
from graphkin.solver.algebra.pose import Array
from graphkin.structure import Structure
from graphkin.words import Phrase, languages

POSITIONS = 12
MANY_LINKS = 10
MECHANISM, POLYGON = (160.0, 218.0), 190.0  # mm that the mechanism in all positions and a polygon may fill



@dataclass(frozen=True)
class Stage:
    """Steps that serve one equation, or the position (no equation)."""

    diagram: DiagramName
    equation: Equation | None
    steps: tuple[Step, ...]

    @property
    def first(self) -> int:
        return self.steps[0].number

    @property
    def last(self) -> int:
        return self.steps[-1].number

    @property
    def of_plans(self) -> bool:
        """Whether it is drawn on the velocity plans of trains alone."""
        return self.equation is None and all(step.plan for step in self.steps)


def stages(sheet: Sheet) -> tuple[Stage, ...]:
    """The steps in groups: of the position, of each equation with its measurements, of velocity plans between."""
    equations = {e.number: e for e in sheet.equations}
    parts: list[Stage] = []
    for step in sheet.steps:
        equation = equations.get(step.equation) if step.equation is not None else None
        last = parts[-1] if parts else None
        begins = last is None or last.diagram != step.diagram or equation not in (None, last.equation)
        if last is not None and not begins and (last.equation is None or not step.plan):
            parts[-1] = Stage(last.diagram, last.equation, (*last.steps, step))
        else:
            parts.append(Stage(step.diagram, equation, (step,)))
    return tuple(parts)


@dataclass(frozen=True)
class Lesson:
    """The content of a handout on a scene at one position.

    Parameters
    ----------
    report : the drawing, at the scales of the handout's paper, and its readings compared with the exact values
    tolerance : predicted uncertainty of each reading on a pencil drawing at these scales
    language : "en", "zh" or "both"
    convention : "chinese", "us", "british" or "russian"
    centres : the instant centres of the position, for a screen, if they exist
    """

    report: Report
    tolerance: Mapping[Symbol, Uncertainty]
    language: str
    convention: str
    centres: Centres | None = None

    @cached_property
    def letters(self) -> Notation:
        return notation_of(self.sheet, self.convention)  # type: ignore[arg-type]

    @cached_property
    def account(self) -> Account:
        return Account(self.sheet, self.letters)

    @cached_property
    def stages(self) -> tuple[Stage, ...]:
        return stages(self.sheet)

    @property
    def sheet(self) -> Sheet:
        return self.report.sheet

    @property
    def first(self) -> str:
        """The first language of the handout."""
        return languages(self.language)[0]

    @property
    def paper(self) -> Paper:
        """The paper that the scene asks for."""
        return paper_of(self.sheet.scene)

    def page(self, name: str, width: float = INSIDE) -> FigurePage:
        """The page of a figure by its name (mm wide)."""
        return FigurePage(self.sheet, name, self.language, self.letters, width)

    @property
    def level(self) -> str:
        """The level of the problem by the scene's ``[vary]``: "easy", "usual" or "hard"."""
        vary = self.sheet.scene.question.vary
        return vary.level if vary is not None else "usual"

    def said(self, key: str, /, **gaps: object) -> Said:
        """Words from the table of terms, in the languages of the handout."""
        return said(key, self.language, **gaps)

    def sentence(self, phrase: Phrase) -> Said:
        """A phrase as a sentence in the languages of the handout."""
        return in_each(self.language, lambda each: self.account.sentence(phrase, each))

    @cached_property
    def results(self) -> tuple[Compared, ...]:
        """The readings that are results: not given ones, nor a rate under a second name.

        Positions come first, then velocities, angular velocities, accelerations, angular accelerations, forces,
        moments.
        """
        kept = [row for row in self.report.rows if row.symbol in self.questions or self._is_result(row.symbol)]

        def place(symbol: Symbol) -> tuple[int, ...]:
            measure = symbol.measure
            if symbol.scope == "force":
                return 1, 0 if symbol.is_load else 1, measure.length
            return 0, measure.order, measure.angle if measure.order else 0

        return tuple(sorted(kept, key=lambda row: place(row.symbol)))

    @cached_property
    def questions(self) -> tuple[Symbol, ...]:
        """The questions for a student: the scene's own, or every absolute vector and every found rate of its points and
        links, not of those that stand in for a contact or a cam alone."""
        have = {row.symbol for row in self.report.rows}
        if self.sheet.asked:
            return tuple(symbol for asked in self.sheet.asked for symbol in asked.both if symbol in have)
        symbols = (row.symbol for row in self.report.rows if self._is_result(row.symbol) and row.symbol.to is None)
        whole = self.sheet.scene.whole
        return tuple(
            symbol for symbol in symbols
            if symbol.kind in ("v", "a", "omega", "alpha") and isinstance(known_symbol("", str(symbol), whole), Symbol)
        )

    def _is_result(self, symbol: Symbol) -> bool:
        if symbol.kind == "arm":  # of the lever, beside which it stands
            return False
        if symbol.is_vector or symbol.scope != "motion":
            return True
        return self.sheet.rates[symbol.kind][symbol.link].is_own

    def unit(self, symbol: Symbol) -> str:
        """The unit of a quantity in the handout."""
        return symbol.unit(self.sheet.scene.units).written

    def in_unit(self, symbol: Symbol, value: float) -> float:
        """A value (SI) in that unit."""
        return float(symbol.unit(self.sheet.scene.units).of(value))


# lessons of a scene


def lesson_of(planned: Plan, motion: Motion, language: str, convention: str) -> Lesson:
    """The lesson of a plan, with its check and with the tolerances of a pencil drawing.

    Raises
    ------
    Disagreement : its check finds a value out of tolerance
    """
    sheet = execute(planned)
    report = report_on(sheet, motion)
    report.must_agree()
    return Lesson(report, predict(planned, "pencil", sheet.scene.question.sheet.tools), language, convention)


def usual_count(scene: Mechanism) -> int:
    """The default number of the driver's positions on a page: fewer for a mechanism of many links, since each takes
    time to draw and to load; only the scene's own if drivers move by laws over time."""
    if moves_by_law(scene):
        return 1
    return POSITIONS if len(scene.links) <= MANY_LINKS else POSITIONS // 2


def positions(
    of: Mechanism | Structure, values: Mapping[str, float] | None, count: int = POSITIONS
) -> tuple[list[dict[str, float]], int]:
    """Driver values (rad, m) spread over a turn or over the range of the motion, and the index of the given one."""
    motion = solver.solve(of, at=values, sweep=count)
    scene = motion.scene
    stands = scene.by_driver(driver.value for driver in scene.drivers) | dict(values or {})
    rows = [scene.by_driver(motion.values[i]) for i in rows_in_order(motion.ok)]
    first = scene.drivers[0].key
    at = next((i for i, row in enumerate(rows) if np.isclose(row[first], stands[first], rtol=0, atol=1e-9)), None)
    if at is None:
        at = sum(row[first] < stands[first] for row in rows)
        rows.insert(at, stands)
    rows[at] = stands
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
    """The positions for the screen, each drawn and with its centres, and the index of the given one.

    ``progress`` is called with the number of finished positions and of all.  ``paper`` are the scales of the solution
    on paper, kept if the figures fit.  Positions in which the construction (dead points) or its check fails are left
    out.
    """
    rows, start = positions(structure, values, count)
    made = {start: plan(structure, rows[start], asked)}
    for numbers in (range(start + 1, len(rows)), range(start - 1, -1, -1)):
        last = made[start]
        for i in numbers:
            with suppress(Unsolvable):
                try:
                    made[i] = last = plan(structure, rows[i], asked, near=last.exact)
                except Unsolvable:  # the way from its neighbour is barred, from the scene's own position it may not be
                    made[i] = last = plan(structure, rows[i], asked)
    given = sum(i < start for i in made)
    plans = [made[i] for i in sorted(made)]
    sheets = [execute(replace(w, scales=s)) for w, s in zip(plans, common_scales(plans, paper), strict=True)]
    centres = _centres(sheets, given, progress)
    views: list[Lesson] = []
    start = given
    for number, (sheet, here) in enumerate(zip(sheets, centres, strict=True)):
        motion = solver.solve(structure, at=sheet.drivers)
        report = report_on(sheet, motion)
        if here is not None:
            must_agree(here, motion)
        if number != given and any(row.ok is False for row in report.rows):
            start -= number < given
        else:
            views.append(Lesson(report, {}, language, convention, here))
    return views, start


def _centres(sheets: Sequence[Sheet], given: int, progress: Progress | None) -> list[Centres | None]:
    """The centres in each position, from the given one onwards and then backwards: each starts from its neighbour.
    Bars that replace cams are those of its own position."""
    centres: dict[int, Centres | None] = {}
    for i in (*range(given, len(sheets)), *range(given - 1, -1, -1)):
        near = centres.get(i - 1) if i > given else centres.get(i + 1)
        centres[i] = None
        for start in (near, None) if near is not None else (None,):
            with suppress(Unsolvable):
                centres[i] = find_centres(sheets[i].structure, sheets[i].drivers, sheet=sheets[i], near=start)
                break
        if progress is not None:
            progress(len(centres), len(sheets))
    return [centres[i] for i in range(len(sheets))]


def common_scales(plans: Sequence[Plan], paper: Scales) -> list[Scales]:
    """Scales for several positions: those of the paper, and coarser ones for polygons that would be too large.

    The mechanism has one scale in all positions.
    """
    sheets = [execute(plan) for plan in plans]
    metres = sheets[0].scene.units.rates.metres
    whole = reduce(Box.joined, (Box.around(sheet.points.values() or (0j,)) for sheet in sheets))
    size = sheets[0].scales.length / paper.length * max(whole.width / MECHANISM[0], whole.height / MECHANISM[1])
    length = _coarser(paper.length * 1e3, size) * 1e-3

    def fitting(sheet: Sheet, diagram: DiagramName) -> float:
        scale, box = paper.of(diagram), extent(sheet, diagram)
        size = max(box.width, box.height) * sheet.scales.of(diagram)
        return _coarser(scale / metres, size / scale / POLYGON) * metres

    return [Scales(length, fitting(sheet, "velocity"), fitting(sheet, "acceleration")) for sheet in sheets]


def _coarser(scale: float, factor: float) -> float:
    """The scale itself if it is coarse enough, else the first of the series that is coarser by the factor."""
    return scale if factor <= 1.0 else next_of_series(scale * factor)


def rows_in_order(ok: Array) -> list[int]:
    """The solved rows of a motion, from any gap on, so that neighbours in the list are neighbours in the motion."""
    good = [bool(stands) for stands in ok]
    cut = next((i for i in range(len(good)) if good[i] and not good[i - 1]), 0)
    return [i for i in (*range(cut, len(good)), *range(cut)) if good[i]]
