"""The account of a construction: for each step its sentence, what is computed in it and what is written of it, and for
each equation why it is so, in one school of notation and any language.

What an act tells is told in one place: a class of `graphkin.account.voice.Told`, named here for the act.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from graphkin.account.reasons import reasons
from graphkin.account.tell import groups, polygon, position
from graphkin.account.voice import Told, Voice
from graphkin.construction.sheet import Equation, Step
from graphkin.words import word

__all__ = ["Account"]

_TOLD: Mapping[type, type[Told[Any]]] = {**position.TOLD, **polygon.TOLD, **groups.TOLD}


@dataclass(frozen=True)
class Account(Voice):
    """Tells the construction of one sheet in the letters of one convention."""

    def told(self, step: Step) -> Told[Any]:
        """What is told of a step, each part made when it is asked for."""
        return _TOLD.get(type(step.act), Told)(self, step, step.act)

    def step(self, step: Step, language: str) -> str:
        """The sentence of a step, with the letters of the points from which it goes and in which it ends."""
        return self.sentence(self.told(step).sentence, language)

    def work(self, step: Step) -> tuple[str, ...]:
        """What is computed in a step, as lines of symbols and numbers."""
        return tuple(self.told(step).sums())

    def why(self, equation: Equation, language: str) -> str:
        """Why an equation is as it is written, in sentences; "" where there is nothing to say."""
        told = (self.sentence(phrase, language) for phrase in reasons(self.sheet, equation))
        return word("between sentences", language).join(told)
