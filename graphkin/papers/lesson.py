"""A drawing as a lesson: what belongs together, equation by equation, and what is asked and found.

Steps in words and in numbers: the sentence of each, and what is computed in it from what is measured.

Sentences hold symbols between dollar signs, in the notation of `graphkin.drawing.text`; the lines of numbers are
the same in every language.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from graphkin.checking.report import Compared, Report
from graphkin.checking.uncertainty import Uncertainty
from graphkin.construction.forces import ForceSheet, forces_on
from graphkin.construction.sheet import Aid, DiagramName, Equation, Ray, Sheet, Step, Vector
from graphkin.construction.steps import (
    Direction,
    DirectionLine,
    Given,
    LaidOff,
    MeasuredRate,
    PlanDrawn,
    RateTimes,
    SquareOverRadius,
)  # fmt: skip
from graphkin.drawing.conventions import Letters, letters_of, pole
from graphkin.drawing.headings import number, written
from graphkin.drawing.sums import factors_of, plan_sum, rate_sum, scale_of, substituted, times_scale, unit_of
from graphkin.drawing.text import Atom, parsed
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, say, word
from graphkin.words.written import MOST, amount, on_paper, product

__all__ = ["Lesson", "Speaker", "Stage", "plain_words", "stages"]


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
        if symbol.is_vector or symbol.scope != "motion":
            return True
        rate = (self.sheet.omega if symbol.kind == "omega" else self.sheet.alpha)[symbol.link]
        return rate.is_own

    def unit(self, symbol: Symbol) -> str:
        """The unit in which a quantity is given."""
        return symbol.written_unit(self.sheet.scene.units)

    def in_unit(self, symbol: Symbol, value: float) -> float:
        """A value (SI) in that unit."""
        return value / symbol.per_unit(self.sheet.scene.units)


_POINT_NAMES = re.compile(r"(?:[A-Z][a-z]*\d*)+")
_RATE = re.compile(r"([ωα])_\{([^{}]*)\}")
SAME = 1e-6  # mm
_MARKED_RATE = re.compile("([ωα]_{)\x02([^\x03}]*)\x03}")
_OPEN, _CLOSE = "\x02", "\x03"  # around symbols until the sentence is whole; no argument can hold them


class _Markup(str):
    """A symbol in the notation of `graphkin.drawing.text`."""


@dataclass(frozen=True)
class Speaker:
    """Says the steps of one sheet in one convention."""

    sheet: Sheet
    letters: Letters

    def sentence(self, phrase: Phrase, language: str) -> str:
        """A phrase as a sentence with its full stop."""
        said = say(phrase, language, lambda thing: self._show(thing, language))
        said = _MARKED_RATE.sub(r"\1\2}", said)  # a link whose name could be that of a bar
        # symbols stand between marks; a rate whose index is a gap of the sentence is marked here
        parts = re.split(f"{_OPEN}([^{_CLOSE}]*){_CLOSE}", said)
        for i in range(0, len(parts), 2):
            parts[i] = _RATE.sub(f"{_OPEN}\\g<0>{_CLOSE}", parts[i])
        parts[1::2] = [f"{_OPEN}{symbol}{_CLOSE}" for symbol in parts[1::2]]
        said = "".join(parts).replace(_CLOSE + _OPEN, "").replace(_OPEN, "$").replace(_CLOSE, "$")
        stop = word("full stop", language)
        return said[:1].upper() + said[1:].rstrip(stop) + stop

    def step(self, step: Step, language: str) -> str:
        """The sentence of a step; a line of known direction is said with the point through which it goes."""
        return self.sentence(self._from_its_start(step), language)

    def _from_its_start(self, step: Step) -> Phrase:
        ray = next((s for s in step.strokes if isinstance(s, Ray)), None)
        act = step.act
        if not isinstance(act, DirectionLine) or ray is None:
            return step.phrase
        if abs(ray.through) < SAME:
            mark = _Markup(pole(self.letters.convention, step.diagram))
            return Phrase("direction from pole", (act.symbol, act.direction, mark))
        before = [
            stroke.symbol
            for one in self.sheet.steps[: self.sheet.steps.index(step)]
            for stroke in one.strokes
            if one.diagram == step.diagram and isinstance(stroke, Vector) and abs(stroke.tip - ray.through) < SAME
        ]
        return Phrase("direction from end", (act.symbol, act.direction, before[-1])) if before else step.phrase

    def _show(self, thing: object, language: str) -> str:
        if isinstance(thing, _Markup):
            return self._marked(thing)
        if isinstance(thing, Symbol):
            return self._marked(self.letters.vector(thing))
        if isinstance(thing, PointRef):
            return self._marked(self.point(thing))
        if isinstance(thing, Direction):
            return self._marked(self.letters.direction(thing, self.sheet.scene.frame.name))
        if isinstance(thing, Given):
            return word("given", language).lower()
        if isinstance(thing, RateTimes | SquareOverRadius):
            return self._marked(self.letters.size(thing))
        text = str(thing)
        names = text.split(", ")
        if all(map(_POINT_NAMES.fullmatch, names)):
            return ", ".join(self._marked(self.bar(name)) for name in names)
        return text.replace("$", "$$")

    def _marked(self, markup: str) -> str:
        return f"{_OPEN}{markup}{_CLOSE}"

    def point(self, ref: PointRef) -> str:
        """A point, with the link as a further index where coincident points are told apart."""
        link = ref.link or self.letters.blocks.get(ref.point, "")
        base = self.letters.point(ref.point)
        if not link:
            return base
        return f"{base[:-1]},{link}}}" if base.endswith("}") else f"{base}_{{{link}}}"

    def bar(self, names: str) -> str:
        """Letters of a bar as they are written: ``O_{4}A``."""
        return "".join(self.letters.point(name) for name in re.findall(r"[A-Z][a-z]*\d*", names))

    # -- numbers -----------------------------------------------------------------------------------------------------

    def work(self, step: Step) -> tuple[str, ...]:
        """What is computed in a step, as lines of symbols and numbers."""
        if isinstance(step.act, MeasuredRate):
            return self._rate(step.act)
        if isinstance(step.act, PlanDrawn):
            letter = "ω" if step.act.rate == "omega" else "α"
            return () if step.act.known else (f"${letter}_{{{step.act.link}}}$ = {plan_sum(step.act)}",)
        if isinstance(step.act, LaidOff) and not step.act.is_zero:
            return self._laid_off(step, step.act)
        return tuple(self._measured(step.diagram, s) for s in step.strokes if isinstance(s, Vector))

    def _rate(self, act: MeasuredRate) -> tuple[str, ...]:
        omega = act.rate == "omega"
        rate = (self.sheet.omega if omega else self.sheet.alpha)[act.link]
        value = rate_sum(self.sheet, act) or f"{number(abs(rate.value), MOST)} {'rad/s' if omega else 'rad/s²'}"
        return (f"${'ω' if omega else 'α'}_{{{act.link}}}$ = {value}",)

    def _laid_off(self, step: Step, act: LaidOff) -> tuple[str, ...]:
        drawn = next(s for s in step.strokes if isinstance(s, Vector | Aid))
        length = abs(drawn.span)
        per, unit = scale_of(self.sheet, step.diagram), unit_of(self.sheet, step.diagram)
        factors = factors_of(self.sheet, act.size)
        value = written(product(*factors, carried=MOST) if factors else amount(length * per, MOST))
        middle = f" = {substituted(act.size, factors)}" if factors else ""
        return (
            f"${self.letters.vector(act.symbol)}${middle} = {value} {unit}",
            f"{value} {unit} ÷ {number(per)} ({unit})/mm = {written(on_paper(length))} mm",
        )

    def _measured(self, diagram: DiagramName, vector: Vector) -> str:
        size = abs(vector.span)
        value = times_scale(self.sheet, diagram, size) if size else "0"
        return f"${self.letters.vector(vector.symbol)}$ = {value}"


def plain_words(markup: str) -> str:
    """Words with symbols as one plain line, for titles and for readers of screens: ``v_B3B2``."""
    return "".join(p if isinstance(p, str) else "".join(map(_plain_atom, p)) for p in parsed(markup))


def _plain_atom(atom: Atom) -> str:
    up = "".join(map(_plain_atom, atom.sup))
    down = "".join(map(_plain_atom, atom.sub))
    return atom.text + (f"^{up}" if up else "") + (f"_{down}" if down else "")
