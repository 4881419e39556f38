"""A voice: how a sheet is spoken of in one school of notation, and what is told of a step in it.

Sentences hold symbols between dollar signs, in the notation of `graphkin.drawing.text`; sums are the same in every
language.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, TypeVar

from graphkin.account.end_letters import EndLetters, names_in_letters
from graphkin.account.measured_lengths import times_scale
from graphkin.account.notation import Letters
from graphkin.construction.sheet import Act, Sheet, Step
from graphkin.construction.sizes import Direction, Given, OffCurves, RateTimes, RollingCurves, SquareOverRadius
from graphkin.construction.strokes import Vector
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Neutral, Phrase, word
from graphkin.words.rich_text import Markup, as_markup, rich_text
from graphkin.words.written import in_markup

__all__ = ["Told", "Voice", "capital", "whole_sentence"]


@dataclass(frozen=True)
class Voice:
    """Speaks of one sheet in the letters of one convention."""

    sheet: Sheet
    letters: Letters

    def sentence(self, phrase: Phrase, language: str) -> str:
        """A phrase as a sentence with its full stop."""
        return whole_sentence(self.say(phrase, language), language)

    def say(self, phrase: Phrase, language: str) -> str:
        """A phrase with its symbols between dollar signs; symbols side by side are one."""
        return as_markup(rich_text(phrase, language, lambda thing: self._show(thing, language)))

    def _show(self, thing: object, language: str) -> str:
        if isinstance(thing, Neutral | Markup):
            return thing
        if isinstance(thing, Symbol):
            return Markup(self.letters.vector(thing))
        if isinstance(thing, PointRef):
            return Markup(self.point(thing))
        if isinstance(thing, Direction):
            return Markup(self.letters.direction(thing, self.sheet.scene.frame.name))
        if isinstance(thing, Given):
            return word("given", language).lower()
        if isinstance(thing, RateTimes | SquareOverRadius | OffCurves | RollingCurves):
            return Markup(self.letters.size(thing))
        names = names_in_letters(self.letters, str(thing))
        if names is None:
            return in_markup(str(thing))
        return Markup(names[0]) if len(names) == 1 else ", ".join(f"${name}$" for name in names)

    def point(self, ref: PointRef) -> str:
        """A point, with the link as a further index where coincident points are told apart."""
        link = ref.link or self.letters.blocks.get(ref.point, "")
        base = self.letters.point(ref.point)
        if not link:
            return base
        return f"{base[:-1]},{link}}}" if base.endswith("}") else f"{base}_{{{link}}}"

    def symbol(self, symbol: Symbol) -> str:
        """A vector or a rate, between dollar signs."""
        return f"${self.letters.vector(symbol)}$"

    @cached_property
    def ends(self) -> EndLetters:
        """The letters of the end points in the polygons."""
        return EndLetters(self.sheet, self.letters)


ActType = TypeVar("ActType", bound=Act)


@dataclass(frozen=True)
class Told(Generic[ActType]):
    """What is told of a step: its sentence, what is computed in it, and what is written on the sheet to repeat it.

    Each is made when it is asked for; an act that is told in another way has a class of its own, named in a ``TOLD`` of
    `graphkin.account.tell`.
    """

    voice: Voice
    step: Step
    act: ActType

    shares_line = False  # with the step before, where that is told by the same class

    @property
    def sheet(self) -> Sheet:
        return self.voice.sheet

    @property
    def sentence(self) -> Phrase:
        """With the letters of the points from which it goes and in which it ends, where there are some."""
        return self.lettered() or self.step.phrase

    def lettered(self) -> Phrase | None:
        """The step as it is said on paper; None where the sentence of the act itself says enough."""
        return None

    def sums(self) -> Iterable[str]:
        """What is computed in it, as lines of symbols and numbers: here each vector as it is measured."""
        return (self._measured(s) for s in self.step.strokes if isinstance(s, Vector))

    def _measured(self, vector: Vector) -> str:
        size = abs(vector.span)
        value = times_scale(self.sheet, self.step.diagram, size) if size else "0"
        return f"{self.voice.symbol(vector.symbol)} = {value}"

    def above_equation(self, language: str) -> Iterator[str]:
        """What is written before its equation, where that begins with it."""
        yield from ()

    def lines(self, language: str) -> Iterator[str]:
        """What is written of it."""
        yield from ()


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
