"""A cell as people fill it in: ``482,7``, ``≈575``, ``2.82 clockwise``, ``↻ 2.82``, ``0.483 m/s ←``, ``12° above x``.

A sense is a sign, a direction an angle from the x axis; arrows and words that name no angle leave room for an eighth
of a turn.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from graphkin.scene.printed import Printed, Unreadable, stated
from graphkin.scene.spelling import plain_text, unit_factor
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Units
from graphkin.words import Phrase

__all__ = ["Way", "is_blank", "read_cell", "read_way"]

_NOTHING = {"", "-", "--", "/", "?", "n/a", "na", "无", "未答", "缺", "空", "—", "none", "missing"}
_DECIMAL = re.compile(r"[+\-]?\d+,\d+(?:[eE][+\-]?\d+)?")
_THOUSANDS = re.compile(r"[+\-]?\d{1,3}(?:,\d{3})+(?:\.\d+)?")
_NUMBER = r"[+\-]?(?:\d+(?:[.,]\d+)*[.]?|\.\d+)(?:[eE][+\-]?\d+)?"
_ABOUT = re.compile(r"[≈~≃≅∼]|\b(?:approx(?:imately)?|about|circa|ca)\b\.?|大约|约(?:为|等于)?|近似", re.IGNORECASE)
_COUNTER = re.compile(
    r"\b(?:c\.?c\.?w\.?|a\.?c\.?w\.?)(?![a-z])|counter[\s-]*clock[\s-]*wise|anti[\s-]*clock[\s-]*wise"
    r"|逆(?:时针)?(?:方向|转动|转|旋转)?|[↺⟲⥀↶]",
    re.IGNORECASE,
)
_CLOCKWISE = re.compile(
    r"\bc\.?w\.?(?![a-z])|clock[\s-]*wise|顺(?:时针)?(?:方向|转动|转|旋转)?|[↻⟳⥁↷]", re.IGNORECASE
)
_NUMBERED = r"(?P<deg>[+\-]?\d+(?:[.,]\d+)?)\s*(?:°|deg(?:rees?)?|度)"
_SIDE = re.compile(
    _NUMBERED + r"\s*(?P<side>above|below|left of|right of"
    r"|counter-?clockwise from|ccw from|clockwise from|cw from|from)"
    r"\s*(?:the\s*)?(?P<sign>[+\-]|positive\s*|negative\s*)?\s*(?P<axis>x|y|horizontal|vertical)(?:[\s-]*axis)?",
    re.IGNORECASE,
)
_SIDE_ZH = re.compile(
    r"(?:与)?(?P<sign>[+\-负正])?\s*(?P<axis>[xX])\s*轴?(?P<half>正向|负向|正方向|负方向)?"
    r"(?:(?P<side>上方|下方|以上|以下|之上|之下)|成|的?夹角为?)\s*" + _NUMBERED + "(?:角)?"
)
_TURN = r"(?P<deg>[+\-]?\d+(?:[.,]\d+)?)"
_ANGLE = re.compile(
    r"(?:[∠@]|\bat\b|\b(?:at )?(?:an )?(?:angle|direction)\b|方向角?|角度)\s*(?:of\b|[=:为是])?\s*" + _TURN
    + r"\s*(?:°|deg(?:rees?)?|度)?", re.IGNORECASE,
)  # fmt: skip
_LETTERED = re.compile(r"[θφϕψαβ]\s*[=:]\s*" + _NUMBERED, re.IGNORECASE)
_DEGREES = re.compile(_NUMBERED + r"(?!\s*/)", re.IGNORECASE)
_RADIANS = re.compile(r"[,;(∠@]\s*" + _TURN + r"\s*rad\b(?!\s*/)", re.IGNORECASE)
_ARROWS = {"→": 0.0, "↗": 45.0, "↑": 90.0, "↖": 135.0, "←": 180.0, "↙": -135.0, "↓": -90.0, "↘": -45.0,
           "⇒": 0.0, "⇑": 90.0, "⇐": 180.0, "⇓": -90.0, "➔": 0.0, "➜": 0.0}  # fmt: skip
_TO = r"[\s-]*(?:(?:and[\s-]*)?to the[\s-]*)?"
_WAYS = (
    (rf"(?:to the )?(?:upper|up(?:wards?)?){_TO}right|(?:向|往|朝)?右上(?:方)?", 45.0),
    (rf"(?:to the )?(?:upper|up(?:wards?)?){_TO}left|(?:向|往|朝)?左上(?:方)?", 135.0),
    (rf"(?:to the )?(?:lower|down(?:wards?)?){_TO}left|(?:向|往|朝)?左下(?:方)?", -135.0),
    (rf"(?:to the )?(?:lower|down(?:wards?)?){_TO}right|(?:向|往|朝)?右下(?:方)?", -45.0),
    (r"(?:horizontally\s*)?(?:to the |to )?\b(?:right(?:wards?)?)\b|(?:水平)?(?:向|往|朝)?右(?:方)?", 0.0),
    (r"(?:horizontally\s*)?(?:to the |to )?\b(?:left(?:wards?)?)\b|(?:水平)?(?:向|往|朝)?左(?:方)?", 180.0),
    (r"(?:vertically\s*)?\bup(?:wards?)?\b|(?:竖直|垂直|铅垂)?(?:向|往|朝)?上(?:方)?", 90.0),
    (r"(?:vertically\s*)?\bdown(?:wards?)?\b|(?:竖直|垂直|铅垂)?(?:向|往|朝)?下(?:方)?", -90.0),
    (r"(?:along\s*)?(?:\+|positive)\s*x\b|沿?\+?\s*x\s*轴?正(?:方)?向", 0.0),
    (r"(?:along\s*)?(?:-|negative)\s*x\b|沿?-?\s*x\s*轴?负(?:方)?向", 180.0),
    (r"(?:along\s*)?(?:\+|positive)\s*y\b|沿?\+?\s*y\s*轴?正(?:方)?向", 90.0),
    (r"(?:along\s*)?(?:-|negative)\s*y\b|沿?-?\s*y\s*轴?负(?:方)?向", -90.0),
)  # fmt: skip
_WAY = [(re.compile(pattern, re.IGNORECASE), angle) for pattern, angle in _WAYS]
_ASIDE = re.compile(
    r"\b(?:in|at|of|the|and|with|direct(?:ed|ion)|pointing|sense)\b|方向|转向|指向|大小|为|沿|偏", re.IGNORECASE
)
_RAISED = re.compile(r"(?<=[A-Za-z])\s*\^\s*\{?\s*([+-]?\d)\s*\}?")
_PER_TIME = re.compile(r"(?<=[\d\s])\b1\s*/\s*(?=s|min)")
_SPACED = re.compile(r"(?<![\d.,])\d{1,3}(?: \d{3})+(?![\d.,]*\d)(?:[.,]\d+)?")
_HAT = r"\s*[*·]?\s*(?:\\?hat)?\{{?[{0}]\u0302?\}}?"
_UNIT_VECTORS = re.compile(
    rf"({_NUMBER}){_HAT.format('iîI')}\s*([+-])\s*({_NUMBER}){_HAT.format('jĵJ')}(?![A-Za-z])"
)
_LABELLED = re.compile(
    rf"[A-Za-z_]*x\s*[=:]\s*({_NUMBER})([^;,=:]*)[;,]?\s*[A-Za-z_]*y\s*[=:]\s*({_NUMBER})", re.IGNORECASE
)
ROUGH = math.radians(45.0)  # an arrow or a word is meant for all that lies nearest to it


@dataclass(frozen=True)
class Way:
    """A direction as written (rad, counter-clockwise from the x axis) with how far it may be meant otherwise; or a
    sense (+1 counter-clockwise, -1 clockwise)."""

    angle: float | None = None
    room: float = 0.0
    sense: int = 0


def is_blank(text: str) -> bool:
    """Whether a cell says that there is no answer."""
    return plain_text(text).lower() in _NOTHING


def read_way(text: str, symbol: Symbol) -> Way:
    """What a cell of a column of directions says: an angle, an arrow, words.  Raises Unreadable."""
    way, rest = _way(plain_text(text), symbol)
    if symbol.is_vector and way.angle is None:
        bare = rest.strip(" °;,()")
        if re.fullmatch(_NUMBER, bare):
            return Way(*_degrees(bare))
        raise Unreadable(Phrase("cell no direction", (text[:40],)))
    if not symbol.is_vector and not way.sense:
        if rest.strip() in ("+", "-"):
            return Way(sense=1 if rest.strip() == "+" else -1)
        raise Unreadable(Phrase("cell no sense", (text[:40],)))
    return way


def _degrees(text: str) -> tuple[float, float]:
    """An angle (rad) and half a unit of its last digit."""
    plain = text.replace(",", ".")
    places = len(plain.partition(".")[2])
    return math.radians(float(plain)), math.radians(0.5 * 10.0**-places)


def _way(text: str, symbol: Symbol) -> tuple[Way, str]:
    """The direction or the sense in a text, and the text without it."""
    if not symbol.is_vector:
        for pattern, sense in ((_COUNTER, 1), (_CLOCKWISE, -1)):
            match = pattern.search(text)
            if match:
                return Way(sense=sense), text[: match.start()] + " " + text[match.end() :]
        return Way(), text
    for found in (_SIDE.search(text), _SIDE_ZH.search(text)):
        if found:
            angle, room = _from_axis(found)
            return Way(angle, room), text[: found.start()] + " " + text[found.end() :]
    for pattern in (_RADIANS, _LETTERED, _ANGLE, _DEGREES):
        match = pattern.search(text)
        if match:
            angle, room = _degrees(match["deg"])
            per = math.degrees(1.0) if pattern is _RADIANS else 1.0
            return Way(angle * per, room * per), text[: match.start()] + " " + text[match.end() :]
    arrows = [c for c in text if c in _ARROWS]
    if len(arrows) == 1:
        return Way(math.radians(_ARROWS[arrows[0]]), ROUGH), text.replace(arrows[0], " ")
    for pattern, degrees in _WAY:
        match = pattern.search(text)
        if match:
            return Way(math.radians(degrees), ROUGH), text[: match.start()] + " " + text[match.end() :]
    return Way(), text


def _from_axis(match: re.Match[str]) -> tuple[float, float]:
    """An angle said from an axis: 12° above -x is 168°."""
    off, room = _degrees(match["deg"])
    sign, side = (match["sign"] or "").strip().lower(), match["side"] or "above"
    negative = sign in ("-", "negative", "负") or (match.groupdict().get("half") or "").startswith("负")
    if match["axis"].lower() in ("x", "horizontal"):
        base = math.pi if negative else 0.0
        turns = {"above": 1, "below": -1}.get(side.lower())
        if turns is None:
            turns = 1 if side in ("上方", "以上", "之上", "成") else -1 if side in ("下方", "以下", "之下") else None
        if turns is not None:
            return base + (off if (turns > 0) != negative else -off), room
    else:
        base = -math.pi / 2 if negative else math.pi / 2
        if side.lower() in ("left of", "right of"):
            return base + (off if (side.lower() == "left of") != negative else -off), room
    clockwise = side.lower().startswith(("clockwise", "cw"))
    return base + (-off if clockwise else off), room


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
        plain = _LABELLED.sub(r"\1; \3 \2", _UNIT_VECTORS.sub(r"\1; \2\3", plain))
    plain = re.sub(r"(?:±|\+/-|\+-).*$", "", plain)
    own, rest = _way(plain, symbol)
    rest = rest.rpartition("=")[2]
    way = own if own.sense or own.angle is not None else way or Way()
    numbers = [m[0].rstrip(".") if not m[0].endswith(".") else m[0][:-1] for m in re.finditer(_bare_number(), rest)]
    left = re.sub(_bare_number(), " ", rest)
    left = re.sub(r"[;:,()\[\]|\s]+", " ", _ASIDE.sub(" ", left))
    left = " ".join(dict.fromkeys(left.split()))  # both components may bear the unit
    if not symbol.is_vector:
        left = re.sub(r"^k\u0302?$", "", left)  # the unit vector out of the paper
    if not numbers or len(numbers) > (2 if symbol.is_vector else 1):
        raise Unreadable(Phrase("cell more numbers" if numbers else "cell no number", (text.strip()[:40],)))
    factor = symbol.per_unit(units)
    for said in (left, unit):
        if said:
            found = unit_factor(said, symbol, units)
            if found is None:
                measure = Phrase(f"measure {symbol.measure}")
                raise Unreadable(Phrase("cell no unit", (text.strip()[:40], said[:20], measure)))
            factor = found
            break
    pointed = [_pointed(n, sign) for n in numbers]
    if way.sense:
        pointed = [("-" if way.sense < 0 else "") + n.lstrip("+-") for n in pointed]
    if way.angle is not None and len(pointed) == 1 and pointed[0].startswith("-"):
        pointed, way = [pointed[0][1:]], Way(way.angle + math.pi, way.room)
    made = stated(symbol, pointed, units, factor)
    angle = way.angle if len(pointed) == 1 and symbol.is_vector else None
    return made.written(text.strip(), angle, way.room if angle is not None else 0.0)


def _bare_number() -> str:
    # no digit that belongs to a unit (s2, s-1) is a number
    return rf"(?<![A-Za-z0-9./^])(?<!\d,)(?<![A-Za-z]-){_NUMBER}"


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
