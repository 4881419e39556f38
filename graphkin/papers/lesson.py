"""A drawing as a lesson: what belongs together, equation by equation, and what is asked and found; what each step
finds, so that somebody may try it first: size, unit and direction, and how far an answer may lie off."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from graphkin.account.notation import Letters, letters_of
from graphkin.account.tell import Account
from graphkin.checking.report import Compared, Report
from graphkin.checking.uncertainty import COVERAGE, Uncertainty
from graphkin.construction.forces import ForceSheet, forces_on
from graphkin.construction.polygon_acts import AddedRate, MeasuredRate, PlanDrawn
from graphkin.construction.sheet import DiagramName, Equation, Sheet, Step
from graphkin.construction.strokes import Vector
from graphkin.drawing.force_stages import ForceStage, ForceStep
from graphkin.drawing.text import Atom, parsed
from graphkin.files import Json
from graphkin.papers.html import words_html
from graphkin.scene.symbol import Symbol

__all__ = ["Lesson", "Stage", "force_found", "found_in", "plain_words", "stages", "tolerances"]


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


def stages(sheet: Sheet) -> tuple[Stage, ...]:
    """The steps of a sheet in groups: one for the position, one for each equation with what is measured after it."""
    equations = {e.number: e for e in sheet.equations}
    found: list[Stage] = []
    for step in sheet.steps:
        equation = equations.get(step.equation) if step.equation is not None else None
        if found and found[-1].diagram == step.diagram and (equation is None or equation is found[-1].equation):
            last = found[-1]
            found[-1] = Stage(last.diagram, last.equation, (*last.steps, step))
        else:
            found.append(Stage(step.diagram, equation, (step,)))
    return tuple(found)


@dataclass(frozen=True)
class Lesson:
    """Everything a handout tells of one scene at one position.

    Parameters
    ----------
    sheet : the drawing, at the scales of the handout's paper
    report : its readings held against the exact values
    tolerance : predicted uncertainty of each reading on a pencil drawing at these scales
    language : "en", "zh" or "both"
    convention : "chinese", "us", "british" or "russian"
    asked : what is to be found; empty for everything
    """

    sheet: Sheet
    report: Report
    tolerance: Mapping[Symbol, Uncertainty]
    language: str
    convention: str
    asked: tuple[Symbol, ...] = ()

    @cached_property
    def letters(self) -> Letters:
        return letters_of(self.sheet, self.convention)  # type: ignore[arg-type]

    @cached_property
    def account(self) -> Account:
        return Account(self.sheet, self.letters)

    @cached_property
    def stages(self) -> tuple[Stage, ...]:
        return stages(self.sheet)

    @cached_property
    def forces(self) -> ForceSheet | None:
        """The forces as they are drawn; None where there is neither mass nor load, or nothing of them is asked."""
        return forces_on(self.sheet) if self.sheet.has_forces else None

    @cached_property
    def results(self) -> tuple[Compared, ...]:
        """The readings that are results: not what is given, nor the same rate under a second name.

        Positions come first, then velocities, angular velocities, accelerations, angular accelerations, forces,
        moments.
        """
        kept = [row for row in self.report.rows if row.symbol in self.questions or self._is_result(row.symbol)]
        order = {"velocity": 1, "angular velocity": 2, "acceleration": 3, "angular acceleration": 4}
        last = {"force": 5, "moment": 6}

        def place(symbol: Symbol) -> int:
            return last.get(symbol.measure, 7) if symbol.scope == "force" else order.get(symbol.measure, 0)

        return tuple(sorted(kept, key=lambda row: place(row.symbol)))

    @cached_property
    def questions(self) -> tuple[Symbol, ...]:
        """What a student is asked for: the scene's own questions, or every absolute vector and every rate found."""
        have = {row.symbol for row in self.report.rows}
        if self.asked:
            return tuple(s for s in self.asked if s in have)
        return tuple(
            row.symbol
            for row in self.report.rows
            if self._is_result(row.symbol) and row.symbol.to is None and row.symbol.kind in ("v", "a", "omega", "alpha")
        )

    def _is_result(self, symbol: Symbol) -> bool:
        if symbol.kind == "arm":  # of the lever, beside which it stands
            return False
        if symbol.is_vector or symbol.scope != "motion":
            return True
        rate = (self.sheet.omega if symbol.kind == "omega" else self.sheet.alpha)[symbol.link]
        return rate.is_own

    def unit(self, symbol: Symbol) -> str:
        """The unit in which a quantity is given."""
        return symbol.unit(self.sheet.scene.units).written

    def in_unit(self, symbol: Symbol, value: float) -> float:
        """A value (SI) in that unit."""
        return float(symbol.unit(self.sheet.scene.units).of(value))


def plain_words(markup: str) -> str:
    """Words with symbols as one plain line, for titles and for readers of screens: ``v_B3B2``."""
    return "".join(p if isinstance(p, str) else "".join(map(_plain_atom, p)) for p in parsed(markup))


def _plain_atom(atom: Atom) -> str:
    up = "".join(map(_plain_atom, atom.sup))
    down = "".join(map(_plain_atom, atom.sub))
    return atom.text + (f"^{up}" if up else "") + (f"_{down}" if down else "")


LEAST, MOST = 0.01, 0.08  # parts of a value: what is taken for right at least, and at most


def found_in(lesson: Lesson, step: Step) -> dict[str, Json]:
    """What a step finds: ``find`` with symbol, name, size in its unit, and direction (degrees) or sense; empty for a
    step that finds nothing."""
    sheet, act = lesson.sheet, step.act
    if isinstance(act, MeasuredRate | AddedRate) or (isinstance(act, PlanDrawn) and not act.known):
        omega = act.rate == "omega"
        rate = (sheet.omega if omega else sheet.alpha).get(act.link)
        if rate is None or not rate.value:
            return {}
        unit = "rad/s" if omega else "rad/s²"
        name = words_html(f"${'ω' if omega else 'α'}_{{{act.link}}}$")
        symbol, sense = f"{act.rate}_{act.link}", 1 if rate.value > 0 else -1
        return {"find": {"symbol": symbol, "name": name, "size": _short(abs(rate.value)), "unit": unit, "sense": sense}}
    vectors = [s for s in step.strokes if isinstance(s, Vector) and s.span]
    if not vectors:
        return {}
    last = vectors[-1]
    value = last.span * sheet.scales.of(step.diagram)
    return {"find": {
        "symbol": str(last.symbol), "name": words_html(f"${lesson.letters.vector(last.symbol)}$"),
        "size": _short(lesson.in_unit(last.symbol, abs(value))), "unit": lesson.unit(last.symbol),
        "angle": round(math.degrees(cmath.phase(value)), 1),
    }}  # fmt: skip


def force_found(lesson: Lesson, stage: ForceStage, step: ForceStep) -> dict[str, Json]:
    """What a step of the forces finds, where it finds one force or moment; as `found_in`."""
    if len(step.found) != 1 or lesson.forces is None:
        return {}
    (symbol,) = step.found
    name = words_html(f"${lesson.letters.vector(symbol)}$")
    back = replace(symbol, link=symbol.other, other=symbol.link) if symbol.other else symbol
    for one, sign in ((symbol, 1.0), (back, -1.0)):
        value = stage.state.moments.get(one)
        span = stage.state.vectors.get(one)
        if value:
            size, unit = _short(lesson.in_unit(symbol, abs(value))), lesson.unit(symbol)
            return {"find": {"symbol": str(symbol), "name": name, "size": size, "unit": unit,
                             "sense": 1 if sign * value > 0 else -1}}  # fmt: skip
        if span:
            size = _short(lesson.in_unit(symbol, abs(span) * lesson.forces.per_mm))
            return {"find": {"symbol": str(symbol), "name": name, "size": size, "unit": lesson.unit(symbol),
                             "angle": round(math.degrees(cmath.phase(sign * span)), 1)}}  # fmt: skip
    return {}


def _short(value: float) -> float:
    return float(f"{value:.5g}")


def tolerances(lesson: Lesson) -> dict[str, float]:
    """By symbol the part of a value within which an answer is taken for right: that of the key, within bounds."""
    found = {}
    for row in lesson.results:
        spread = lesson.tolerance.get(row.symbol)
        size = abs(row.true)
        if spread is not None and size:
            part = COVERAGE * spread.deviation / size
            found[str(row.symbol)] = round(min(max(part, LEAST), MOST), 4) if math.isfinite(part) else MOST
    return found
