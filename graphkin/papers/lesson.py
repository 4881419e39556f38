"""A drawing as a lesson: what belongs together, equation by equation, and what is asked and found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from graphkin.account.account import Account
from graphkin.account.notation import Letters, letters_of
from graphkin.checking.report import Compared, Report
from graphkin.checking.uncertainty import Uncertainty
from graphkin.construction.centres import Centres
from graphkin.construction.forces import ForceSheet, forces_on
from graphkin.construction.sheet import Equation, Sheet
from graphkin.construction.steps import DiagramName, Step
from graphkin.drawing.text import Atom, parsed
from graphkin.papers.blocks import Said, in_each
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase

__all__ = ["Lesson", "Stage", "plain_words", "stages"]


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
    centres : the instant centres of the position, for a screen, where they can be had
    """

    sheet: Sheet
    report: Report
    tolerance: Mapping[Symbol, Uncertainty]
    language: str
    convention: str
    asked: tuple[Symbol, ...] = ()
    centres: Centres | None = None

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
    def scaled(self) -> Sheet:
        """The sheet with the scale of its forces."""
        sheet = self.sheet
        return sheet if self.forces is None else replace(sheet, scales=replace(sheet.scales, force=self.forces.per_mm))

    @property
    def level(self) -> str:
        """How hard the problem is meant to be, as ``[vary]`` of the scene says: "easy", "usual" or "hard"."""
        vary = self.sheet.scene.question.vary
        return vary.level if vary is not None else "usual"

    def sentence(self, phrase: Phrase) -> Said:
        """A phrase as a sentence in the languages of the handout."""
        return in_each(self.language, lambda each: self.account.sentence(phrase, each))

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
