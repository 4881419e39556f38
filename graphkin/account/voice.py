"""Steps in words and in numbers: the sentence of each, and what is computed in it from what is measured.

Sentences hold symbols between dollar signs, in the notation of `graphkin.drawing.text`; the lines of numbers are
the same in every language.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from graphkin.account.arithmetic import laid_sum, parts_by_rates, plan_sum, rate_sum
from graphkin.account.end_letters import Markup, names_in_letters
from graphkin.account.headings import number, written
from graphkin.account.lettered_steps import LetteredSteps
from graphkin.account.measured_lengths import scale_of, times_scale, unit_of
from graphkin.account.notation import Letters
from graphkin.account.reasons import reasons
from graphkin.account.written_lines import by_rates
from graphkin.construction.polygon_acts import ByRate, Carried, LaidOff, MeasuredRate, PlanDrawn, RateSeen, SeenByRate
from graphkin.construction.sheet import DiagramName, Equation, Sheet, Step
from graphkin.construction.sizes import Direction, Given, OffCurves, RateTimes, RollingCurves, Size, SquareOverRadius
from graphkin.construction.strokes import Aid, Bar, Vector
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, say, word
from graphkin.words.written import MOST, in_markup, on_paper, pointing

__all__ = ["Speaker", "capital", "whole_sentence"]

_RATE = re.compile(r"([ωα])_\{([^{}]*)\}")
_MARKED_RATE = re.compile("([ωα]_{)\x02([^\x03}]*)\x03}")
_OPEN, _CLOSE = "\x02", "\x03"  # around symbols until the sentence is whole; no argument can hold them


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
        return whole_sentence(said, language)

    def step(self, step: Step, language: str) -> str:
        """The sentence of a step, with the letters of the points from which it goes and in which it ends."""
        return self.sentence(self._lettered.phrase(step), language)

    def why(self, equation: Equation, language: str) -> str:
        """Why an equation is as it is written, in sentences; "" where there is nothing to say."""
        told = (self.sentence(phrase, language) for phrase in reasons(self.sheet, equation))
        return word("between sentences", language).join(told)

    @cached_property
    def _lettered(self) -> LetteredSteps:
        return LetteredSteps(self.sheet, self.letters)

    def _show(self, thing: object, language: str) -> str:
        if isinstance(thing, Markup):
            return self._marked(thing)
        if isinstance(thing, Symbol):
            return self._marked(self.letters.vector(thing))
        if isinstance(thing, PointRef):
            return self._marked(self.point(thing))
        if isinstance(thing, Direction):
            return self._marked(self.letters.direction(thing, self.sheet.scene.frame.name))
        if isinstance(thing, Given):
            return word("given", language).lower()
        if isinstance(thing, RateTimes | SquareOverRadius | OffCurves | RollingCurves):
            return self._marked(self.letters.size(thing))
        text = str(thing)
        names = names_in_letters(self.letters, text)
        return in_markup(text) if names is None else ", ".join(map(self._marked, names))

    def _marked(self, markup: str) -> str:
        return f"{_OPEN}{markup}{_CLOSE}"

    def point(self, ref: PointRef) -> str:
        """A point, with the link as a further index where coincident points are told apart."""
        link = ref.link or self.letters.blocks.get(ref.point, "")
        base = self.letters.point(ref.point)
        if not link:
            return base
        return f"{base[:-1]},{link}}}" if base.endswith("}") else f"{base}_{{{link}}}"

    # -- numbers -----------------------------------------------------------------------------------------------------

    def work(self, step: Step) -> tuple[str, ...]:
        """What is computed in a step, as lines of symbols and numbers."""
        if isinstance(step.act, MeasuredRate | RateSeen):
            return self._rate(step.act)
        if isinstance(step.act, PlanDrawn):
            letter = "ω" if step.act.rate == "omega" else "α"
            return () if step.act.known else (f"${letter}_{{{step.act.link}}}$ = {plan_sum(step.act)}",)
        if isinstance(step.act, LaidOff) and not step.act.is_zero:
            drawn = next(s for s in step.strokes if isinstance(s, Vector | Aid))
            return self._laid_off(step.diagram, step.act.symbol, step.act.size, abs(drawn.span))
        if isinstance(step.act, Carried) and step.equation is not None:
            sides = self.sheet.equations[step.equation - 1].sides
            size = next((t.size for side in sides for t in side if t.symbol == step.act.symbol), None)
            bar = next((s for s in step.strokes if isinstance(s, Bar) and s.b != s.a), None)
            return self._laid_off(step.diagram, step.act.symbol, size, abs(bar.b - bar.a)) if bar and size else ()
        measured = tuple(self._measured(step.diagram, s) for s in step.strokes if isinstance(s, Vector))
        return (*self._by_rate(step, step.act), *measured) if isinstance(step.act, ByRate | SeenByRate) else measured

    def _by_rate(self, step: Step, act: ByRate | SeenByRate) -> Iterator[str]:
        """The parts of a relative vector that follow from the rates of a link, each with its length and direction."""
        per, unit = scale_of(self.sheet, step.diagram), unit_of(self.sheet, step.diagram)
        parts = parts_by_rates(self.sheet, step.diagram, act)
        for said, part in zip(by_rates(self.sheet, step, act, self.letters), parts, strict=True):
            yield said
            yield f"÷ {number(per)} ({unit})/mm = {written(on_paper(abs(part.span)))} mm,  {pointing(part.span)}°"

    def _rate(self, act: MeasuredRate | RateSeen) -> tuple[str, ...]:
        omega = act.rate == "omega"
        value = rate_sum(self.sheet, act) or f"{number(abs(act.value), MOST)} {'rad/s' if omega else 'rad/s²'}"
        links = act.link if isinstance(act, MeasuredRate) else act.link + act.held
        return (f"${'ω' if omega else 'α'}_{{{links}}}$ = {value}",)

    def _laid_off(self, diagram: DiagramName, symbol: Symbol, size: Size | None, length: float) -> tuple[str, ...]:
        computed, laid = laid_sum(self.sheet, diagram, size, length)
        return f"${self.letters.vector(symbol)}$ = {computed}", laid

    def _measured(self, diagram: DiagramName, vector: Vector) -> str:
        size = abs(vector.span)
        value = times_scale(self.sheet, diagram, size) if size else "0"
        return f"${self.letters.vector(vector.symbol)}$ = {value}"


def whole_sentence(text: str, language: str) -> str:
    """Words as a sentence, with its capital and its full stop."""
    stop = word("full stop", language)
    return capital(text).rstrip(stop) + stop


def capital(text: str) -> str:
    """Words with a capital; a symbol stays as it is.

    >>> capital("the rise"), capital("φ = 140°")
    ('The rise', 'φ = 140°')
    """
    return text[:1].upper() + text[1:] if text[:1].isascii() else text
