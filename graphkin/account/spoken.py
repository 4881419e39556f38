"""Symbols in words, for screen readers and titles: vectors by their meaning, and the symbols in the markup of a text
(``v_{B3B2}`` is "velocity of B3 relative to B2")."""

from __future__ import annotations

import re
from collections.abc import Sequence

from graphkin.account.notation import PART_MARKS
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, area, languages, say, word
from graphkin.words.symbols import Atom, parsed

_POINT = re.compile(r"[A-Z][a-z]*\d*")
_RATES = {"ω": "omega", "α": "alpha", "ε": "alpha"}
_POWERS = {"": "", "2": "²", "3": "³"}
_PLAIN = re.compile(r"[A-Za-z0-9 .,()−+=:]*")


def spoken_ref(ref: PointRef, language: str) -> str:
    """A point in words: "B of link 3"."""
    return " / ".join(say(_point(ref), each) for each in languages(language))


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


def spoken_words(markup: str, language: str) -> str:
    """Words with symbols between dollar signs, all in words.

    >>> spoken_words("so $v_{B3B2}$ is found", "en")
    'so velocity of B3 relative to B2 is found'
    """
    parts = (part if isinstance(part, str) else spoken_symbol(part, language) or _flat(part) for part in parsed(markup))
    return "".join(parts)


def spoken_symbol(atoms: Sequence[Atom], language: str) -> str:
    """A symbol in words; "" where a screen reader reads it rightly."""
    if all(not a.sub and not a.sup and _PLAIN.fullmatch(a.text) for a in atoms):
        return ""
    return " ".join(" ".join(_spoken(atom, language) for atom in atoms).split())


def _spoken(atom: Atom, language: str) -> str:
    sub, sup = _flat(atom.sub), _flat(atom.sup)
    named = _quantity(atom.text, sub, sup)
    if named is not None:
        said, above = say(named[0], language), named[1]
    else:
        said, above = f"{_signs(atom.text, language)} {_signs(sub, language)}", _POWERS.get(sup, sup)
    return f"{said} {_signs(above, language)}"


def _quantity(letter: str, index: str, above: str) -> tuple[Phrase, str] | None:
    """A velocity, an acceleration, a rate or a length by its index, and by further marks above it; None for another
    symbol."""
    points = index.split("/") if "/" in index else _POINT.findall(index)
    if letter in "vVaA" and index[:1].isupper():
        part = PART_MARKS.get(above[:1], "") if letter in "aA" else ""
        others = " ".join(points[1:])
        return _vector(part or letter.lower(), points[0], others), above[1:] if part else _POWERS.get(above, above)
    if letter in _RATES and index and above in _POWERS:
        return Phrase(f"{_RATES[letter]} of", link=index), _POWERS[above]
    if letter == "l" and index[:1].isupper():
        return Phrase("length of", points=" ".join(points)), _POWERS.get(above, above)
    return None


def _flat(atoms: Sequence[Atom]) -> str:
    return "".join(atom.text + _flat(atom.sub) + _flat(atom.sup) for atom in atoms)


def _signs(text: str, language: str) -> str:
    signs = area("signs read aloud")
    return "".join(f" {word(c, language)} " if c in signs else c for c in text)
