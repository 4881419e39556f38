"""Words in each language: one table for each, of all sentences for steps, notes and headings.

A phrase is a key with its arguments; the sentence is made where it is shown, in the reader's language.
The tables are the files of this folder, ``en.toml`` and ``zh.toml``: a further language is one more of them, with the
same keys, and every command knows it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, reduce
from pathlib import Path

__all__ = ["BOTH", "LANGUAGES", "Phrase", "about", "area", "class_of", "languages", "listed", "say", "word"]


_TABLES = {path.stem: path for path in Path(__file__).parent.glob("*.toml")}
LANGUAGES = tuple(sorted(_TABLES, key=lambda name: (name != "en", name)))
"""Languages that have a table; English, which the others translate, first."""
BOTH = "both"
"""English and Chinese on one sheet."""


@cache
def _areas(language: str) -> Mapping[str, Mapping[str, str]]:
    import tomllib  # here, since ``graphkin --help`` wants to know the languages only

    return tomllib.loads(_TABLES[language].read_text(encoding="utf-8"))


@cache
def _table(language: str) -> Mapping[str, str]:
    return {key: text for area in _areas(language).values() for key, text in area.items()}


def area(name: str, language: str = "en") -> Mapping[str, str]:
    """All words of an area of the table by their keys, as a page takes them along."""
    return _areas(language)[name]


@dataclass(frozen=True)
class Phrase:
    """A sentence to be: its key in the table and what stands in its gaps (names, symbols, numbers, phrases)."""

    key: str
    args: tuple[object, ...] = ()


def say(phrase: Phrase, language: str = "en", show: Callable[[object], str] = str) -> str:
    """The sentence in a language.  ``show`` writes each argument (plain text, or markup of a convention).

    >>> say(Phrase("points", ("2", "B, C")))
    'mark B, C on link 2'
    """
    parts = (say(a, language, show) if isinstance(a, Phrase) else show(a) for a in phrase.args)
    return _table(language)[phrase.key].format(*parts)


def about(key: str, names: Sequence[object]) -> str:
    """The key of a sentence about several things, or of the one about a single one."""
    return key if len(names) > 1 else f"{key} one"


def listed(names: Sequence[object]) -> object:
    """Names or phrases, one at least, as an argument of a sentence: a list with the marks of its language.

    >>> say(Phrase("points", ("2", listed(["B", "C", "D"]))))
    'mark B, C, D on link 2'
    """
    return reduce(lambda one, other: Phrase("listed", (one, other)), names)


def class_of(order: int) -> Phrase | str:
    """The class of a group as a numeral of each language, Roman as far as the table goes."""
    return Phrase(f"class {order}") if f"class {order}" in _table("en") else str(order)


def word(key: str, language: str = "en", otherwise: str | None = None) -> str:
    """A heading or a term in a language; ``otherwise`` stands for one that the table does not have."""
    return _table(language)[key] if otherwise is None else _table(language).get(key, otherwise)


def languages(language: str) -> tuple[str, ...]:
    """The languages that stand on a sheet: `BOTH` are two.

    >>> languages("both"), languages("zh")
    (('en', 'zh'), ('zh',))
    """
    return ("en", "zh") if language == BOTH else (language,)
