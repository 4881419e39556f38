"""A voice: how a sheet is spoken of in one school of notation.

Sentences hold symbols between dollar signs, in the notation of `graphkin.drawing.text`; sums are the same in every
language.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from graphkin.account.end_letters import EndLetters, names_in_letters
from graphkin.account.notation import Letters
from graphkin.construction.sheet import Sheet
from graphkin.construction.sizes import Direction, Given, OffCurves, RateTimes, RollingCurves, SquareOverRadius
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Neutral, Phrase, word
from graphkin.words.rich_text import Markup, as_markup, rich_text
from graphkin.words.written import in_markup

__all__ = ["Voice", "capital", "whole_sentence"]


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
