"""Symbols as they are read aloud: ``v_{B3B2}`` is "velocity of B3 relative to B2"; for readers of screens."""

from __future__ import annotations

import re
from collections.abc import Sequence

from graphkin.drawing.text import Atom, parsed
from graphkin.words import Phrase, area, say, word

__all__ = ["spoken_symbol", "spoken_words"]

_POINT = re.compile(r"[A-Z][a-z]*\d*")
_VECTORS = {"v": "v", "V": "v", "a": "a", "A": "a"}
_PARTS = ("n", "t", "k", "c", "r", "s")
_RATES = {"ω": "omega", "α": "alpha", "ε": "alpha"}
_PLAIN = re.compile(r"[A-Za-z0-9 .,()−+=:]*")


def spoken_words(markup: str, language: str) -> str:
    """Words with symbols between dollar signs, all in words.

    >>> spoken_words("so $v_{B3B2}$ is found", "en")
    'so velocity of B3 relative to B2 is found'
    """
    parts = (part if isinstance(part, str) else spoken_symbol(part, language) or _flat(part) for part in parsed(markup))
    return "".join(parts)


def spoken_symbol(atoms: Sequence[Atom], language: str) -> str:
    """A symbol in words; "" where it is read rightly as it stands."""
    if all(not a.sub and not a.sup and _PLAIN.fullmatch(a.text) for a in atoms):
        return ""
    return re.sub(r"\s+", " ", " ".join(_spoken(atom, language) for atom in atoms)).strip()


def _spoken(atom: Atom, language: str) -> str:
    before, base = _parted(atom.text)
    sub, sup = _flat(atom.sub), _flat(atom.sup)
    named = _quantity(base, sub, sup, language)
    if not named:
        named = _signs(base, language)
        named += f" {_signs(sub, language)}" if sub else ""
        named += f" {_raised(sup, language)}" if sup else ""
    return f"{_signs(before, language)} {named}"


def _quantity(base: str, sub: str, sup: str, language: str) -> str:
    """A velocity, an acceleration, a rate or a length by its index; "" for anything else."""
    power = sup.lstrip("".join(_PARTS)) if base in _VECTORS else sup
    if base in _VECTORS and sub[:1].isupper():
        part = sup[:1] if sup[:1] in _PARTS else ""
        points = sub.split("/") if "/" in sub else _POINT.findall(sub)
        key = f"spoken {_VECTORS[base]}{part}"
        names = (points[0], " ".join(points[1:]))
        said = say(Phrase(f"{key} relative" if names[1] else key, names), language)
    elif base in _RATES and sub:
        said = say(Phrase(f"spoken {_RATES[base]}", (sub,)), language)
    elif base == "l" and sub[:1].isupper():
        said = say(Phrase("spoken length", (" ".join(_POINT.findall(sub)),)), language)
    else:
        return ""
    return f"{said} {_raised(power, language)}" if power else said


def _parted(text: str) -> tuple[str, str]:
    """What stands before the letter that bears an index, and that letter."""
    return (text[:-1], text[-1]) if text else ("", "")


def _flat(atoms: Sequence[Atom]) -> str:
    return "".join(a.text + _flat(a.sub) + _flat(a.sup) for a in atoms)


def _raised(text: str, language: str) -> str:
    return _signs({"2": "²", "3": "³"}.get(text, text), language)


def _signs(text: str, language: str) -> str:
    signs = area("signs read aloud")
    return "".join(f" {word(c, language)} " if c in signs else c for c in text)
