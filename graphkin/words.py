"""Words, in each language: one table of sentences for steps, notes and headings.

A phrase is a key with its arguments; the sentence is made where it is shown, in the reader's language.
A third language is one more entry per key.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

__all__ = ["LANGUAGES", "Phrase", "say", "word"]

LANGUAGES = ("en", "zh")


@dataclass(frozen=True)
class Phrase:
    """A sentence to be: its key in the table and what stands in its gaps (names, symbols, numbers)."""

    key: str
    args: tuple[object, ...] = ()


def say(phrase: Phrase, language: str = "en", show: Callable[[object], str] = str) -> str:
    """The sentence in a language.  ``show`` writes each argument (plain text, or markup of a convention).

    >>> say(Phrase("arcs", ("C", "B", "D")))
    'arcs about B and D meet in C'
    """
    return _TABLE[phrase.key][LANGUAGES.index(language)].format(*(show(a) for a in phrase.args))


def word(key: str, language: str = "en") -> str:
    """A heading or a term in a language."""
    return _TABLE[key][LANGUAGES.index(language)]


_TABLE: dict[str, tuple[str, str]] = {}
