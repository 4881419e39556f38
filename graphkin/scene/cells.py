"""A cell as people fill it in: ``482,7``, ``≈575``, ``2.82 clockwise``, ``↻ 2.82``, ``0.483 m/s ←``, ``⊥AB``."""

from __future__ import annotations

import math
import re
from dataclasses import replace

from graphkin.scene.directions import NUMBER, Way, way_in
from graphkin.scene.printed import Printed, Unreadable, stated
from graphkin.scene.spelling import is_unit, plain_text, unit_factor
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Units
from graphkin.words import Phrase

__all__ = ["is_blank", "read_cell"]

_NOTHING = {"", "-", "--", "/", "?", "n/a", "na", "无", "未答", "缺", "空", "—", "none", "missing",
            "n.a.", "blank", "空白", "未求", "未做", "没做", "不会"}  # fmt: skip
_DECIMAL = re.compile(r"[+\-]?\d+,\d+(?:[eE][+\-]?\d+)?")
_THOUSANDS = re.compile(r"[+\-]?\d{1,3}(?:,\d{3})+(?:\.\d+)?")
_ABOUT = re.compile(r"[≈~≃≅∼]|\b(?:approx(?:imately)?|about|circa|ca)\b\.?|大约|约(?:为|等于)?|近似", re.IGNORECASE)
_ASIDE = re.compile(
    r"\b(?:along|on|in) (?:the|its) (?:guide|slot|line|rod)\b|\b(?:in|at|of|the|and|with|to|towards?|along|is|it|turns?"
    r"|turning|rotat(?:es|ing)|direct(?:ed|ion)|points?|pointing|sense|axis)\b"
    r"|沿(?:导路|导轨|导杆|滑道)|方向|转向|指向|大小|转动|旋转|为|沿|偏|的|与|线", re.IGNORECASE
)  # fmt: skip
_RAISED = re.compile(r"(?<=[A-Za-z])\s*\^\s*\{?\s*([+-]?\d)\s*\}?")
_PER_TIME = re.compile(r"(?<=[\d\s])\b1\s*/\s*(?=s|min)")
_SPACED = re.compile(r"(?<![\d.,])\d{1,3}(?: \d{3})+(?![\d.,]*\d)(?:[.,]\d+)?")
_HAT = r"\s*[*·]?\s*(?:\\?hat)?\{{?[{0}]\u0302?\}}?"
_UNIT_VECTORS = re.compile(
    rf"({NUMBER}){_HAT.format('iîI')}\s*([+-])\s*({NUMBER}){_HAT.format('jĵJ')}(?![A-Za-z])"
)
_LABELLED = re.compile(
    rf"[A-Za-z_]*x\s*[=:]\s*({NUMBER})([^;,=:]*)[;,]?\s*[A-Za-z_]*y\s*[=:]\s*({NUMBER})", re.IGNORECASE
)
_PART = rf"({NUMBER})([^\d,;+°→←↑↓-]*?)\s*(?:to the |向)?(?:({{}})|({{}}))(?:wards?|方)?"
_TWO_WAYS = re.compile(
    _PART.format("right|east|E|→|右|东", "left|west|W|←|左|西") + r"\s*(?:[,;，；]|and|和)?\s*"
    + _PART.format("up|north|N|↑|上|北", "down|south|S|↓|下|南") + "(?![A-Za-z])"
)  # fmt: skip
_COMPLEX = re.compile(rf"({NUMBER})\s*([+-])\s*({NUMBER})\s*[*·]?\s*[ij]\b")


def is_blank(text: str) -> bool:
    """Whether a cell says that there is no answer."""
    return plain_text(text).lower() in _NOTHING


def read_cell(
    text: str, symbol: Symbol, units: Units, unit: str = "", sign: str = ",", way: Way | None = None
) -> Printed:
    """What a cell states.

    Parameters
    ----------
    units : of the scene
    unit : of the column's head; the scene's own where there is none; one in the cell counts more
    sign : what parts the cells of the table; where that is a comma, one in a number may be one of thousands
    way : from a column of directions

    Raises
    ------
    Unreadable : what is no such value

    >>> read_cell("482,7 mm/s", Symbol.parse("v_B"), Units(), sign=";").value
    0.4827
    >>> read_cell("≈2.82 cw", Symbol.parse("omega_3"), Units()).value
    -2.82
    """
    plain = _PER_TIME.sub("/", _RAISED.sub(r"\1", _ABOUT.sub(" ", plain_text(text))))
    plain = _joined(plain, symbol)
    if symbol.is_vector:
        plain = _COMPLEX.sub(r"\1; \2\3", _UNIT_VECTORS.sub(r"\1; \2\3", plain))
        plain = _TWO_WAYS.sub(_two_components, plain)
        plain = _LABELLED.sub(r"\1; \3 \2", plain)
    plain = re.sub(r"(?:±|\+/-|\+-).*$", "", plain)
    own, rest = way_in(plain, symbol)
    rest = rest.rpartition("=")[2]
    way = own if own.says else way or Way()
    numbers = [m[0].rstrip(".") if not m[0].endswith(".") else m[0][:-1] for m in re.finditer(_bare_number(), rest)]
    left = re.sub(_bare_number(), " ", rest)
    left = re.sub(r"[;:,()\[\]<>⟨⟩|、。\s]+", " ", _ASIDE.sub(" ", left))
    left = " ".join(dict.fromkeys(left.split()))  # both components may bear the unit
    if not symbol.is_vector:
        left = re.sub(r"^k\u0302?$", "", left)  # the unit vector out of the paper
    if not numbers or len(numbers) > (2 if symbol.is_vector else 1):
        raise Unreadable(Phrase("cell more numbers" if numbers else "cell no number", (text.strip()[:40],)))
    factor = symbol.unit(units).si
    for said in (left, unit):
        if said:
            found = unit_factor(said, symbol, units)
            if found is None:
                key = "cell no unit" if is_unit(said, units) else "cell no words"
                raise Unreadable(Phrase(key, (text.strip()[:60], said[:40], Phrase(f"measure {symbol.measure}"))))
            factor = found
            break
    pointed = [_pointed(n, sign) for n in numbers]
    if way.sense:
        pointed = [("-" if way.sense < 0 else "") + n.lstrip("+-") for n in pointed]
    if way.angle is not None and len(pointed) == 1 and pointed[0].startswith("-"):
        pointed, way = [pointed[0][1:]], replace(way, angle=way.angle + math.pi)
    made = replace(stated(symbol, pointed, units, factor), shown=text.strip())
    if len(pointed) > 1 or not symbol.is_vector:
        return made
    return replace(made, direction=way.angle, room=way.room, either=way.either, lines=way.lines)


def _two_components(match: re.Match[str]) -> str:
    """934.6 mm/s right, 784.2 mm/s down: the two as signed components."""
    x, unit, right, _, y, _, up, _ = match.groups()
    return f"{x if right else f'-{x}'}; {y if up else f'-{y}'} {unit}"


def _bare_number() -> str:
    # no digit that belongs to a unit (s2, s-1) is a number
    return rf"(?<![A-Za-z0-9./^])(?<!\d,)(?<![A-Za-z]-){NUMBER}"


def _joined(text: str, symbol: Symbol) -> str:
    """Thousands parted by a space or an apostrophe put together: ``1'220``, ``1 220.5``.  Raises Unreadable where they
    may be two components."""
    text = re.sub(r"(?<=\d)['’](?=\d{3}(?!\d))", "", text)
    match = _SPACED.search(text)
    if match is None:
        return text
    whole = match[0].replace(" ", "")
    if symbol.is_vector and text.startswith(("(", "[")):
        return text
    if symbol.is_vector:
        raise Unreadable(Phrase("cell two components", (text[:40], whole)))
    return text[: match.start()] + whole + text[match.end() :]


def _pointed(number: str, sign: str) -> str:
    if "," in number and "." in number:  # the last one is the decimal sign
        aside, point = sorted(",.", key=number.rfind)
        if number.count(point) == 1:
            return number.replace(aside, "").replace(point, ".")
    if sign == "," and _THOUSANDS.fullmatch(number):
        if number.count(",") == 1 and "." not in number:
            plain, decimal = number.replace(",", ""), number.replace(",", ".")
            raise Unreadable(Phrase("cell two ways", (number[:40], plain, decimal)))
        return number.replace(",", "")
    return number.replace(",", ".") if _DECIMAL.fullmatch(number) else number
