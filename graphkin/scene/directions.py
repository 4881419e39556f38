"""Directions and senses as people write them: ``clockwise``, ``←``, ``12° above x``, ``S 50° E``, ``向右下``, ``⊥AB``.

A sense is a sign, a direction an angle from the x axis (east), counter-clockwise; arrows and words that name no angle
leave room for an eighth of a turn.  Words are read in English and Chinese.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from graphkin.plane import added_up
from graphkin.scene.printed import Line, Unreadable
from graphkin.scene.spelling import plain_text
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase

__all__ = ["NUMBER", "Way", "read_way", "way_in"]

NUMBER = r"[+\-]?(?:\d+(?:[.,]\d+)*[.]?|\.\d+)(?:[eE][+\-]?\d+)?"
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
    _NUMBERED + r"\s*(?P<side>above|below|over|under|left of|right of"
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
    (r"(?:along\s*)?(?:\+|positive)\s*x(?:[\s-]*axis)?\b|沿?\+?\s*x\s*轴?正(?:方)?向", 0.0),
    (r"(?:along\s*)?(?:-|negative)\s*x(?:[\s-]*axis)?\b|沿?-?\s*x\s*轴?负(?:方)?向", 180.0),
    (r"(?:along\s*)?(?:\+|positive)\s*y(?:[\s-]*axis)?\b|沿?\+?\s*y\s*轴?正(?:方)?向", 90.0),
    (r"(?:along\s*)?(?:-|negative)\s*y(?:[\s-]*axis)?\b|沿?-?\s*y\s*轴?负(?:方)?向", -90.0),
)  # fmt: skip
_WAY = [(re.compile(pattern, re.IGNORECASE), angle) for pattern, angle in _WAYS]
_PAPER = r" (?:the )?(?:page|paper|plane|sheet)\b|(?:垂直)?于?(?:纸面)?指?向"
_INTO = re.compile(rf"\binto{_PAPER}里", re.IGNORECASE)
_OUT_OF = re.compile(rf"\bout of{_PAPER}外", re.IGNORECASE)
_NEGATIVE = re.compile(r"\b(?:negative|minus)\b|[-]\s*k\u0302?\b|为?负", re.IGNORECASE)
_POSITIVE = re.compile(r"\b(?:positive|plus)\b|为?正", re.IGNORECASE)
_SENSES = ((_COUNTER, 1), (_CLOCKWISE, -1), (_INTO, -1), (_OUT_OF, 1), (_NEGATIVE, -1), (_POSITIVE, 1))

_COMPASS = {"east": 0, "e": 0, "东": 0, "north": 90, "n": 90, "北": 90, "west": 180, "w": 180, "西": 180,
            "south": -90, "s": -90, "南": -90}  # fmt: skip
_WORD = r"(?:north|south|east|west)"
_ENDING = r"(?:(?:er)?ly|ern|wards?)?"
_FROM_COMPASS = (
    re.compile(rf"{_NUMBERED}\s*(?P<to>{_WORD}|[NSEW])\s*of\s*(?:due\s*)?(?P<base>{_WORD}|[NSEW])\b", re.IGNORECASE),
    re.compile(rf"\b(?P<base>{_WORD})\s*{_NUMBERED}\s*(?P<to>{_WORD})\b", re.IGNORECASE),
    re.compile(rf"(?<![\w/])(?P<base>[NSEW])\s*{_NUMBERED}\s*(?P<to>[NSEW])(?![\w/])"),
    re.compile(rf"(?P<base>[东南西北])偏(?P<to>[东南西北])\s*{_NUMBERED}"),
)
_BEARING = re.compile(
    r"(?:\b(?:bearing|azimuth|heading)\b|方位角?)\s*(?:of\b|[=:为是])?\s*(?P<deg>\d+(?:[.,]\d+)?)\s*(?:°|deg(?:rees?)?|度)?",
    re.IGNORECASE,
)
_POINTS = (
    re.compile(rf"\b(?:due\s*)?(?P<one>north|south)(?:[\s-]*(?P<two>east|west))?{_ENDING}\b", re.IGNORECASE),
    re.compile(rf"\b(?:due\s*)?(?P<one>east|west)(?P<two>)?{_ENDING}\b", re.IGNORECASE),
    re.compile(r"(?<![\w/.])(?P<near>[NSEW])(?P<one>[NS])(?P<two>[EW])(?![\w/])"),
    re.compile(r"(?<![\w/.])(?P<one>[NS])(?P<two>[EW])(?![\w/])"),
    re.compile(r"(?<![\w/.])(?P<one>[NSEW])(?P<two>)(?![\w/])"),
    re.compile(r"(?:向|往|朝|正)?(?P<one>[东西])(?P<two>[南北])?(?:方向?|面|边)?"),
    re.compile(r"(?:向|往|朝|正)?(?P<one>[南北])(?P<two>)(?:方向?|面|边)?"),
)
_UP = re.compile(r"\b(?:up(?:per|wards?)?|above|over)\b|上", re.IGNORECASE)
_DOWN = re.compile(r"\b(?:down(?:wards?)?|lower|below|under)\b|下", re.IGNORECASE)
_RIGHT = re.compile(r"\bright(?:wards?)?\b|右", re.IGNORECASE)
_LEFT = re.compile(r"\bleft(?:wards?)?\b|左", re.IGNORECASE)
_FROM_UPRIGHT = re.compile(r"\b(?:vertical|y)\b|竖直|铅垂|铅直|[yY]\s*轴", re.IGNORECASE)
_QUADRANT_ASIDE = re.compile(
    r"\b(?:up(?:per|wards?)?|above|over|down(?:wards?)?|lower|below|under|right(?:wards?)?|left(?:wards?)?|to|from|with|the|and|at"
    r"|an?|angle|of|horizontal(?:ly)?|vertical(?:ly)?|[xy](?:[\s-]*axis)?)\b"
    r"|指?[向往朝]?[左右上下]+方?|与|和|水平|竖直|铅垂|铅直|方向|线|成|的?夹角为?|[xy]\s*轴",
    re.IGNORECASE,
)
_POLAR = re.compile(r"\be\s*\^?\s*[({]*\s*(?:[ij]\s*[*·]?\s*)?" + _NUMBERED + r"\s*[*·]?\s*[ij]?\s*[)}]*")
_LINE = re.compile(
    r"(?:(?P<square>⊥|⟂|(?i:\b(?:perpendicular|square|normal)\s*to\b)|垂直于?)"
    r"|∥|//|(?i:\bparallel\s*to\b|\balong\b)|平行于?|沿)\s*(?:(?i:the|bar|link|line)\b\s*)*杆?"
    r"(?P<one>[A-Z]\d*)(?P<two>[A-Z]\d*)(?![A-Za-z0-9])\s*(?:(?i:bar|link|line)\b|杆)?(?:方向)?"
)
_POINT = r"(?P<{}>[A-Z]\d*)(?![A-Za-z0-9])"
_FROM_TO = re.compile(
    rf"(?:(?i:\bfrom\b)|[由从自])?\s*(?:点\s*)?{_POINT.format('one')}\s*(?:点\s*)?(?:(?i:\bto(?:wards?)?\b)|→|指向|到|向)"
    rf"\s*{_POINT.format('two')}\s*点?"
)
_TOWARDS = re.compile(rf"(?:(?i:\btowards?\b|\bto\b)|指向)\s*(?:(?i:point)\s*)?{_POINT.format('two')}\s*点?")
_UPRIGHT_LINE = re.compile(r"\bvertical(?:ly)?\b|竖直|铅垂|铅直", re.IGNORECASE)
_LEVEL_LINE = re.compile(r"\bhorizontal(?:ly)?\b|水平", re.IGNORECASE)
ROUGH = math.radians(45.0)  # an arrow or a word is meant for all that lies nearest to it


@dataclass(frozen=True)
class Way:
    """A direction as written (rad, counter-clockwise from the x axis) with how far it may be meant otherwise, its
    opposite too where ``either``; a sense (+1 counter-clockwise, -1 clockwise); or lines that it lies along."""

    angle: float | None = None
    room: float = 0.0
    sense: int = 0
    either: bool = False
    lines: tuple[Line, ...] = ()

    @property
    def says(self) -> bool:
        """Whether anything is said."""
        return bool(self.sense or self.angle is not None or self.lines)


def read_way(text: str, symbol: Symbol) -> Way:
    """What a cell of a column of directions says: an angle, an arrow, words.  Raises Unreadable."""
    way, rest = way_in(plain_text(text), symbol)
    if symbol.is_vector and not way.says:
        bare = rest.strip(" °;,()")
        if re.fullmatch(NUMBER, bare):
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


def way_in(text: str, symbol: Symbol) -> tuple[Way, str]:
    """The direction or the sense in a text, and the text without it."""
    if not symbol.is_vector:
        for pattern, sense in _SENSES:
            match = pattern.search(text)
            if match:
                return Way(sense=sense), _without(text, match)
        return Way(), text
    lines, text = _lines(text, symbol)
    way = next(_ways(text, symbol), None)
    if way is None:
        return Way(lines=lines), text
    return Way(way[0].angle, way[0].room, either=way[0].either, lines=lines), way[1]


def _without(text: str, match: re.Match[str]) -> str:
    return text[: match.start()] + " " + text[match.end() :]


def _lines(text: str, symbol: Symbol) -> tuple[tuple[Line, ...], str]:
    """Along or square to which bars, from where to where, something is said to lie, and the text without it."""
    found: list[Line] = []
    while match := _LINE.search(text):
        found.append(Line(match["one"], match["two"], square=bool(match["square"])))
        text = _without(text, match)
    while match := _FROM_TO.search(text):
        found.append(Line(match["one"], match["two"], directed=True))
        text = _without(text, match)
    match = _TOWARDS.search(text)
    if match and symbol.of is not None:
        found.append(Line(symbol.of.point, match["two"], directed=True))
        text = _without(text, match)
    return tuple(found), text


def _ways(text: str, symbol: Symbol) -> Iterator[tuple[Way, str]]:
    """The directions that a text may mean, the plainest first, each with the text without it."""
    yield from _by_compass_angle(text, symbol)
    quadrant = _by_quadrant(text)
    if quadrant is not None:
        yield quadrant
    for found in (_SIDE.search(text), _SIDE_ZH.search(text)):
        if found:
            yield Way(*_from_axis(found)), _without(text, found)
    for pattern in (_POLAR, _RADIANS, _LETTERED, _ANGLE, _DEGREES):
        match = pattern.search(text)
        if match:
            angle, room = _degrees(match["deg"])
            per = math.degrees(1.0) if pattern is _RADIANS else 1.0
            yield Way(angle * per, room * per), _without(text, match)
    arrows = [c for c in text if c in _ARROWS]
    if len(arrows) == 1:
        yield Way(math.radians(_ARROWS[arrows[0]]), ROUGH), text.replace(arrows[0], " ")
    for word, degrees in _WAY:
        match = word.search(text)
        if match:
            yield Way(math.radians(degrees), ROUGH), _without(text, match)
    yield from _by_compass_point(text, symbol)
    for word, angle in ((_UPRIGHT_LINE, math.pi / 2), (_LEVEL_LINE, 0.0)):
        match = word.search(text)
        if match:
            yield Way(angle, ROUGH, either=True), _without(text, match)


def _letters(match: re.Match[str], symbol: Symbol) -> bool:
    """Whether a compass point is a letter that may be a unit of a force."""
    return symbol.measure in ("force", "moment") and any(g in ("N", "E", "S", "W") for g in match.groups())


def _by_compass_angle(text: str, symbol: Symbol) -> Iterator[tuple[Way, str]]:
    """40° south of east, S 50° E, 南偏东50°; bearing 130° counts clockwise from north."""
    for pattern in _FROM_COMPASS:
        match = pattern.search(text)
        if match and not _letters(match, symbol):
            base, to = (_COMPASS[match[key].lower()] for key in ("base", "to"))
            turn = math.sin(math.radians(to - base))
            if abs(turn) > 0.5:
                off, room = _degrees(match["deg"])
                yield Way(math.radians(base) + math.copysign(off, turn), room), _without(text, match)
    match = _BEARING.search(text)
    if match:
        off, room = _degrees(match["deg"])
        yield Way(math.pi / 2 - off, room), _without(text, match)


def _by_compass_point(text: str, symbol: Symbol) -> Iterator[tuple[Way, str]]:
    for pattern in _POINTS:
        match = pattern.search(text)
        if match and not _letters(match, symbol):
            names = [name.lower() for name in (match["one"], match["two"]) if name]
            z = added_up((cmath.rect(1.0, math.radians(_COMPASS[name])) for name in names), 0j)
            if "near" in pattern.groupindex:  # of sixteen points
                z = z / abs(z) + cmath.rect(1.0, math.radians(_COMPASS[match["near"].lower()]))
                yield Way(cmath.phase(z), ROUGH / 2), _without(text, match)
            else:
                yield Way(cmath.phase(z), ROUGH), _without(text, match)


def _by_quadrant(text: str) -> tuple[Way, str] | None:
    """An angle from the horizontal (or the vertical) within the quarter that words name: right and down at 40°."""
    match = _DEGREES.search(text)
    if match is None or match["deg"][0] in "+-" or _CLOCKWISE.search(text):
        return None
    rest = _without(text, match)
    sides = [bool(side.search(rest)) for side in (_RIGHT, _LEFT, _UP, _DOWN)]
    off, room = _degrees(match["deg"])
    if sides[0] == sides[1] or sides[2] == sides[3] or off > math.pi / 2:
        return None
    off = math.pi / 2 - off if _FROM_UPRIGHT.search(rest) else off
    along, up = (1.0 if sides[0] else -1.0), (1.0 if sides[2] else -1.0)
    return Way(math.atan2(up * math.sin(off), along * math.cos(off)), room), _QUADRANT_ASIDE.sub(" ", rest)


def _from_axis(match: re.Match[str]) -> tuple[float, float]:
    """An angle said from an axis: 12° above -x is 168°."""
    off, room = _degrees(match["deg"])
    sign, side = (match["sign"] or "").strip().lower(), match["side"] or "above"
    negative = sign in ("-", "negative", "负") or (match.groupdict().get("half") or "").startswith("负")
    if match["axis"].lower() in ("x", "horizontal"):
        base = math.pi if negative else 0.0
        turns = {"above": 1, "over": 1, "below": -1, "under": -1}.get(side.lower())
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


