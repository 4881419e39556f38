"""Heads and cells of tables as people write them: units, Greek letters, decimal commas, signs for nothing."""

from __future__ import annotations

import re

from graphkin.scene.symbol import Symbol

__all__ = ["head_of", "is_blank", "numbers_in", "unit_of"]

_UNIT = re.compile(r"^(.*?)\s*[(（\[]([^)）\]]*)[)）\]]$")
_GREEK = {"ω": "omega", "α": "alpha", "a": "a", "v": "v"}
_JOINED = re.compile(r"([ωα])_?([A-Za-z0-9]+)|([va])([A-Z][A-Za-z0-9]*)")
_NOTHING = {"", "-", "--", "–", "—", "/", "?", "？", "n/a", "na", "无"}
_DECIMAL = re.compile(r"[+\-\u2212]?\d+,\d+(?:[eE][+\-]?\d+)?")
_THOUSANDS = re.compile(r"[+\-\u2212]?\d{1,3}(?:,\d{3})+(?:\.\d+)?")


def unit_of(symbol: Symbol, length: str) -> str:
    """The unit in which a quantity is stated."""
    return {"v": f"{length}/s", "omega": "rad/s", "alpha": "rad/s2"}.get(symbol.kind, f"{length}/s2")


def head_of(head: str) -> tuple[str, str]:
    """The name in a head and its unit, "" if none is written.

    >>> head_of("ω3 [rad/s]"), head_of("a_D（mm/s²）"), head_of("vD")
    (('omega_3', 'rad/s'), ('a_D', 'mm/s2'), ('v_D', ''))
    """
    match = _UNIT.match(head)
    name, unit = (match[1], match[2]) if match else (head, "")
    joined = _JOINED.fullmatch(name)
    if joined:
        letter, rest = (joined[1], joined[2]) if joined[1] else (joined[3], joined[4])
        name = f"{_GREEK[letter]}_{rest}"
    return name.strip(), _plain_unit(unit)


def _plain_unit(unit: str) -> str:
    return re.sub(r"\^|\s", "", unit.replace("²", "2")).lower()


def is_blank(text: str) -> bool:
    """Whether a cell says that there is no answer."""
    return text.strip().lower() in _NOTHING


def numbers_in(text: str, unit: str, sign: str) -> list[str]:
    """The numbers of a cell, parted by blanks or semicolons, with decimal points.

    Parameters
    ----------
    unit : what may stand behind the number
    sign : what parts the cells of the table; where that is a comma, one in a number may be one of thousands

    Raises
    ------
    ValueError : a comma that may be either

    >>> numbers_in("482,7", "mm/s", ";"), numbers_in("(-482.7; 0) mm/s", "mm/s", ",")
    (['482.7'], ['-482.7', '0'])
    """
    bare = text.strip()
    if unit and _plain_unit(bare).endswith(unit):
        letters = re.search(r"[^\d\s.,;)\]][^\d]*\s*/\s*s\s*\^?[2²]?$", bare)
        bare = bare[: letters.start()] if letters else bare
    parts = [p for p in re.split(r"[;\s]+", bare.strip("[]() ")) if p]
    return [_pointed(part, sign) for part in parts]


def _pointed(number: str, sign: str) -> str:
    if sign == "," and _THOUSANDS.fullmatch(number):
        if number.count(",") == 1 and "." not in number:
            plain, decimal = number.replace(",", ""), number.replace(",", ".")
            raise ValueError(f'"{number[:40]}" may be {plain} or {decimal}')
        return number.replace(",", "")
    return number.replace(",", ".") if _DECIMAL.fullmatch(number) else number
