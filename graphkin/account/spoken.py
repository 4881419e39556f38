"""Symbols in words, for screen readers and titles: quantities by their meaning (``v_B3B2`` is "velocity of B3 relative
to B2"), other symbols letter by letter."""

from __future__ import annotations

import string
from collections.abc import Sequence
from functools import lru_cache

from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, area, languages, say, word
from graphkin.words.symbols import Atom, Words, stretches

_RATES = ("omega", "alpha")
_POWERS = {"2": "²", "3": "³"}
_PLAIN = frozenset(string.ascii_letters + string.digits + " .,()−+=:")


def spoken_ref(ref: PointRef, language: str) -> str:
    """A point in words: "B of link 3"."""
    return " / ".join(say(_point(ref), each) for each in languages(language))


@lru_cache(maxsize=2048)
def spoken_vector(symbol: Symbol, language: str) -> str:
    """A vector in words: "velocity of B of link 3 relative to B of link 2"."""
    assert symbol.of is not None
    said = _vector(symbol.kind, _point(symbol.of), _point(symbol.to) if symbol.to else "")
    return " / ".join(say(said, each) for each in languages(language))


def _point(ref: PointRef) -> Phrase | str:
    return Phrase("point of link", point=ref.point, link=ref.link) if ref.link else ref.point


def _vector(kind: str, point: Phrase | str, reference: Phrase | str) -> Phrase:
    """A vector of a point, relative to ``reference`` unless that is ""."""
    whose = Phrase("relative to", point=point, reference=reference) if reference else point
    return Phrase(f"{kind} of", point=whose)


def spoken_words(text: Words, language: str) -> str:
    """A text with its symbols in words.

    >>> from graphkin.words.symbols import rate
    >>> spoken_words("so " + rate("omega", "3") + " is found", "en")
    'so angular velocity of link 3 is found'
    """
    return "".join(
        part if isinstance(part, str) else spoken_symbol(part, language) or _flat(part) for part in stretches(text)
    )


def spoken_symbol(atoms: Sequence[Atom], language: str) -> str:
    """A symbol in words; "" where a screen reader reads it rightly."""
    if all(not a.sub and not a.sup and _PLAIN.issuperset(a.text) for a in atoms):
        return ""
    return " ".join(" ".join(_spoken(atom, language) for atom in atoms).split())


def _spoken(atom: Atom, language: str) -> str:
    above = _flat(atom.sup)
    if not atom.meaning:
        said = f"{_signs(atom.text, language)} {_signs(_flat(atom.sub), language)}"
    else:
        kind, of, *others = atom.meaning
        to, above = others if others else ("", above)
        if kind in _RATES:
            said = say(Phrase(f"{kind} of", link=of), language)
        elif kind == "length":
            said = say(Phrase("length of", points=of), language)
        else:
            said = say(_vector(kind, of, to), language)
    return f"{said} {_signs(_POWERS.get(above, above), language)}"


def _flat(atoms: Sequence[Atom]) -> str:
    return "".join(atom.text + _flat(atom.sub) + _flat(atom.sup) for atom in atoms)


def _signs(text: str, language: str) -> str:
    signs = area("signs read aloud")
    return "".join(f" {word(c, language)} " if c in signs else c for c in text)
