"""A drawing as a lesson: what belongs together, equation by equation, and what is asked and found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from graphkin.checking import Compared, Report, Uncertainty
from graphkin.drafting.sheet import DiagramName, Equation, Sheet, Step
from graphkin.drawing.conventions import Letters, letters_of
from graphkin.handout.sentences import Speaker
from graphkin.scene.symbol import Symbol

__all__ = ["Lesson", "Stage", "stages"]


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
    def speaker(self) -> Speaker:
        return Speaker(self.sheet, self.letters)

    @cached_property
    def stages(self) -> tuple[Stage, ...]:
        return stages(self.sheet)

    @cached_property
    def results(self) -> tuple[Compared, ...]:
        """The readings that are results: not what is given, nor the same rate under a second name.

        Velocities come first, then angular velocities, accelerations, angular accelerations.
        """
        kept = [row for row in self.report.rows if row.symbol in self.questions or self._is_result(row.symbol)]
        order = {"v": 0, "omega": 1, "alpha": 3}
        return tuple(sorted(kept, key=lambda row: order.get(row.symbol.kind, 2)))

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
        if symbol.is_vector:
            return True
        rate = (self.sheet.omega if symbol.kind == "omega" else self.sheet.alpha)[symbol.link]
        return rate.vector is not None and not rate.same_as

    def unit(self, symbol: Symbol) -> str:
        """The unit in which a quantity is given."""
        length = self.sheet.scene.units.length
        return {"v": f"{length}/s", "omega": "rad/s", "alpha": "rad/s²"}.get(symbol.kind, f"{length}/s²")

    def in_unit(self, symbol: Symbol, value: float) -> float:
        """A value (SI) in that unit."""
        return value / self.sheet.scene.units.metres if symbol.is_vector else value
