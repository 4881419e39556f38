"""Quantities, directions and values as people write them.

Names: ``v_B3``, ``ω₃``, ``omega3``, ``vB``, ``a_{CB}^{n}``, ``v_C/(m/s)``; a spelling is held against the names that
the scene has, so that ``v_B3`` is the pin B3 where there is one, and else B as a point of link 3.  Directions and
senses: ``clockwise``, ``←``, ``12° above x``, ``S 50° E``, ``向右下``, ``⊥AB``.  Cells: ``482,7``, ``≈575``,
``↻ 2.82``, ``0.483 m/s ←``.  The words for them are those of the tables of words (``[spelling]``), of every language.
"""

from __future__ import annotations

import cmath
import math
import re
import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from graphkin.plane import added_up
from graphkin.scene.symbol import KINDS, Line, PointRef, Printed, Symbol, Way, centre_links, forms_of_names, stated
from graphkin.scene.tables import FORCES, LENGTHS, Units
from graphkin.table import pointed
from graphkin.words import LANGUAGES, Phrase, area

_GREEK = {"ω": "omega", "Ω": "omega", "α": "alpha", "ε": "alpha", "ϵ": "alpha", "θ": "theta", "φ": "theta",
          "ϕ": "theta", "ψ": "theta", "γ": "gamma", "τ": "t"}
_WRITTEN = {"w": "omega", "epsilon": "alpha", "phi": "theta", "ac": "ak", "l": "d", "V": "v",
            "F_R": "F", "FR": "F", "R": "F", **{k: k for k in KINDS}}
_SPOKEN = sorted(_WRITTEN, key=len, reverse=True)
_PART = re.compile(r"\^\{?([a-z])\}?")
_HEAD_UNIT = re.compile(r"^(.*?)\s*(?:\(([^()]*(?:\([^()]*\)[^()]*)*)\)|\[([^\[\]]*)\])\s*$")
_BEHIND_A_LINE = re.compile(r"^(.*?[^/\s])\s*/\s*((?:[^/]|/(?=s|min|\())+)$")
_SEXAGESIMAL = re.compile(
    r"([+\-]?)(?<![\d.,])(\d+)\s*(?:°|度)\s*(\d+)\s*['\u2032\u2019分](?!['\u2032\u2019])"
    r"(?:\s*(\d+)\s*(?:[\"\u201d秒]|['\u2032\u2019]{2}))?"
)
_WORDS_ASIDE = re.compile("[\u3000-\u9fff\uff00-\uffef]+")


def plain_text(text: str) -> str:
    """Raised and lowered signs, wide ones and typographic minus signs as plain ones: ``ω₃`` is ``ω3``; powers of ten
    keep an e; minutes and seconds of arc are whole.

    >>> plain_text("−1.22×10³ mm/s²"), plain_text("2．82（rad／s）"), plain_text("1.2·$10^{-7}$"), plain_text("57°54′")
    ('-1.22e3 mm/s2', '2.82(rad/s)', '1.2e-7', '3474 arcmin')
    """
    raised = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
    powers = re.sub(
        r"\s*[×xX·*⋅]\s*10\s*([⁻⁺]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda m: "e" + m[1].translate(raised), text.replace("$", "")
    )
    powers = re.sub(r"\s*[×xX·*⋅]\s*10\s*\^\s*\{?\s*([-+\u2212]?\d+)\s*\}?", r"e\1", powers)
    signs = str.maketrans({"\u2212": "-", "\u2010": "-", "\u2011": "-", "\u2012": "-", "\u2013": "-", "\u207b": "-",
                           **dict.fromkeys("\u20d7\u0305\u200b\u2060\ufeff"), "º": "°"})
    return _SEXAGESIMAL.sub(_in_parts, unicodedata.normalize("NFKC", powers.translate(signs)).translate(signs).strip())


def _in_parts(match: re.Match[str]) -> str:
    """Degrees and minutes as minutes of arc, with seconds as seconds, so that the last digit tells the rounding."""
    sign, degrees, minutes, seconds = match.groups()
    parts = 60 * int(degrees) + int(minutes)
    return f"{sign}{parts} arcmin" if seconds is None else f"{sign}{60 * parts + int(seconds)} arcsec"


@dataclass(frozen=True)
class Spelling:
    """Reads names of quantities of one scene: its points, each with the links that own it (none for a point of
    contact), its links with the frame, and its units."""

    points: Mapping[str, frozenset[str]]
    links: frozenset[str]
    units: Units

    def head(self, text: str) -> tuple[str, str]:
        """The name in a head and its unit, "" if none is written: ``v_C (m/s)``, ``ω3 [rad/s]``, ``v_C/(mm·s⁻¹)``."""
        plain = plain_text(text)
        for pattern in (_HEAD_UNIT, _BEHIND_A_LINE):
            match = pattern.match(plain)
            if match:
                name, unit = match[1].rstrip(" /"), next(g for g in match.groups()[1:] if g is not None)
                unit = unit.strip("() ")
                symbol = self.symbol(name)
                if pattern is _HEAD_UNIT or (symbol and unit_factor(unit, symbol, self.units)):
                    return name, unit
        return plain, ""

    def symbol(self, text: str) -> Symbol | None:
        """The quantity of this scene that a text means; None where it means none."""
        plain = plain_text(text)
        spellings = dict.fromkeys((plain, _WORDS_ASIDE.sub("", plain).strip()))
        return next((symbol for spelling in spellings for symbol in self._meanings(spelling)), None)

    def _meanings(self, text: str) -> Iterator[Symbol]:
        if not text or len(text) > 60:
            return
        head, _, place = text.partition(" at ")
        try:
            symbol = Symbol.parse(text)
            if self._exists(symbol) and not symbol.is_of_tables:
                yield symbol
        except ValueError:
            pass
        bare = "".join(_GREEK.get(c, c) for c in head)
        part = "".join(_PART.findall(bare))
        bare = re.sub(r"[\\{}\s|]", "", _PART.sub("", bare)).replace("(", "").replace(")", "")
        if len(part) > 1 or (part and not bare.startswith("a")):
            return
        if part:
            bare = f"a{ {'c': 'k', 'n': 'n', 't': 't', 'k': 'k', 'r': 'r'}.get(part, '?') }{bare[1:]}".replace(" ", "")
        for spoken in _SPOKEN:
            if bare.startswith(spoken) and len(bare) > len(spoken):
                for symbol in self._of_kind(spoken, bare[len(spoken) :].lstrip("_")):
                    yield self._usual(replace(symbol, at=place))

    @cached_property
    def _forms(self) -> dict[str, str]:
        """The patterns of names behind a kind, with the names of the scene."""
        points, links = (sorted(map(re.escape, names), key=len, reverse=True) for names in (self.points, self.links))
        return forms_of_names("|".join(points), "|".join(links), lax=True)

    def _of_kind(self, spoken: str, names: str) -> Iterator[Symbol]:
        """The quantities of a kind that the names behind it may mean, in their own case or in any."""
        kind = _WRITTEN[spoken]
        form = "pair" if spoken.endswith("R") else KINDS[kind].form  # a reaction is of two links
        for flags in (re.NOFLAG, re.IGNORECASE) if form in self._forms else ():
            match = re.fullmatch(self._forms[form], names, flags)
            if match is not None:
                named = {part: self._own_case(name) for part, name in match.groupdict().items() if name}
                if "" not in named.values():
                    yield Symbol.of_names(kind, named)

    def _own_case(self, name: str) -> str:
        """A name of the scene, written in any case; "" where several are alike."""
        known = [*self.points, *self.links]
        alike = [name] if name in known else [k for k in known if k.lower() == name.lower()]
        return alike[0] if len(alike) == 1 else ""

    def _exists(self, symbol: Symbol) -> bool:
        names = [ref.point for ref in (symbol.of, symbol.to) if ref]
        centres = {name for name in names if symbol.kind == "d" and centre_links(name, self.links)}
        return {*names} <= {*self.points, *centres} and {*symbol.links()} <= {*self.links, *self.points}

    def _usual(self, symbol: Symbol) -> Symbol:
        """The name under which a point of a link is known: ``v_B@2`` is ``v_B`` where B is one of link 2's points."""
        of, to = symbol.of, symbol.to
        if of is None or symbol.link or (to is not None and to.point == of.point):
            return symbol

        def plain(ref: PointRef | None) -> PointRef | None:
            known = ref is not None and ref.link in self.points.get(ref.point, frozenset())
            return PointRef(ref.point) if ref is not None and known else ref

        return replace(symbol, of=plain(of), to=plain(to))


def _said(key: str, signs: str = "(?!)") -> re.Pattern[str]:
    """The pattern of a word in any language (``[spelling]`` in the tables of words) or of signs."""
    words = (area("spelling", language)[f"spelt {key}"] for language in LANGUAGES)
    return re.compile("|".join((*words, signs)), re.IGNORECASE)


_UNITS = {
    unit: _said(f"unit {unit}") for unit in ("k", "mm", "cm", "m", "rad", "deg", "r", "/", "min", "s2", "s", "n", "2")
}
_LENGTHS = {**LENGTHS, "dm": 0.1, "km": 1e3, "um": 1e-6, "inch": 0.0254, "inches": 0.0254, "\"": 0.0254, "feet": 0.3048}
_FORCES = {**{force.lower(): newtons for force, newtons in FORCES.items()}, "lb": FORCES["lbf"], "lbs": FORCES["lbf"]}
_ANGLES = {**dict.fromkeys(("rad", "弧度", "", "1"), 1.0), **dict.fromkeys(("deg", "°", "degrees"), math.radians(1.0)),
           "arcmin": math.radians(1.0) / 60, "arcsec": math.radians(1.0) / 3600,
           **dict.fromkeys(("r", "rev", "turn"), math.tau)}
_TIMES = {"s": 1.0, "sec": 1.0, "min": 60.0, "h": 3600.0, "": 1.0}
_RATE = re.compile(r"(?P<what>[a-z°\"1]*?)(?:/(?P<over>s|sec|min|h)(?P<power>2?)|/(?P<one>s|sec)/(?P<two>s|sec)"
                   r"|(?P<by>s|min)-(?P<times>[12]))?")


def unit_factor(text: str, symbol: Symbol, units: Units) -> float | None:
    """The value in SI of a unit as people write it, None where it is no unit of this quantity.

    >>> unit_factor("m/s", Symbol.parse("v_B"), Units()), unit_factor("mm·s⁻²", Symbol.parse("a_B"), Units())
    (1.0, 0.001)
    >>> round(unit_factor("r/min", Symbol.parse("omega_3"), Units()), 6)
    0.10472
    """
    plain = plain_text(text).lower()
    for unit, pattern in _UNITS.items():
        plain = pattern.sub(unit, plain)
    bare = re.sub(r"[\s^·*⋅.{}]", "", plain).replace("µ", "u").replace("μ", "u")
    measure = symbol.measure
    if measure.force:
        arms = _LENGTHS if measure.length else {"": 1.0}
        for force, newtons in _FORCES.items():  # lb-ft, or ft-lb
            split = (bare.removeprefix(force), bare.removesuffix(force))
            arm = next((a.strip("-") for a in split if a != bare and a.strip("-") in arms), None)
            if arm is not None:
                return newtons * arms[arm]
        return None
    bare = bare.replace("rpm", "r/min")
    match = _RATE.fullmatch(bare)
    if match is None or not measure.is_of_motion:
        return None
    power = 0
    if match["over"]:
        power = int(match["power"] or 1)
    elif match["one"]:
        power = 2
    elif match["by"]:
        power = int(match["times"])
    time = _TIMES[match["over"] or match["one"] or match["by"] or ""]
    table = _LENGTHS if measure.length else _ANGLES
    name = match["what"]
    if power != measure.order or name not in table or (power == 0 and name in ("", "1")):
        return None
    return table[name] / time**power


_MEASURED = [Symbol.parse(name) for name in ("v_A", "a_A", "omega_1", "alpha_1", "x_A", "theta_1", "F_1/2", "M_1/2")]
_TURNED = Symbol.parse("theta_1")
_MASSES = {"kg", "g", "t", "lb", "lbs", "kgm2", "w", "j", "pa", "mpa"}


def is_unit(text: str, units: Units) -> bool:
    """Whether a text is a unit, of whatever quantity.

    >>> is_unit("kg", Units()), is_unit("rad/s", Units()), is_unit("im Uhrzeigersinn", Units())
    (True, True, False)
    """
    return text.lower() in _MASSES or any(unit_factor(text, symbol, units) for symbol in _MEASURED)


NUMBER = r"[+\-]?(?:\d+(?:[.,]\d+)*[.]?|\.\d+)(?:[eE][+\-]?\d+)?"
_UNIT = r"\s*(?:°|deg(?:rees?)?|度|(?P<unit>arcmin|arcsec|rad|弧度)(?:ians?)?(?![A-Za-z]|\s*(?:/|[·*]?\s*s\b)))"
_TURN = r"(?P<deg>[+\-]?\d+(?:[.,]\d+)?)"
_NUMBERED = _TURN + _UNIT
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
_ANGLE = re.compile(
    r"(?:[∠@]|\bat\b|\b(?:at )?(?:an )?(?:angle|direction|dir\.?|arg)(?!\w)|方向角?|角度"
    r"|(?:[θφϕψαβγδ]|\b(?:theta|phi|psi|alpha|beta|gamma|delta))(?=\s*[=:]))\s*(?:of\b|[=:为是])?\s*" + _TURN
    + rf"(?:{_UNIT})?", re.IGNORECASE,
)
_DEGREES = re.compile(_NUMBERED + r"(?!\s*/)", re.IGNORECASE)
_ARROWS = {"→": 0.0, "↗": 45.0, "↑": 90.0, "↖": 135.0, "←": 180.0, "↙": -135.0, "↓": -90.0, "↘": -45.0,
           "⇒": 0.0, "⇑": 90.0, "⇐": 180.0, "⇓": -90.0, "➔": 0.0, "➜": 0.0}
_CLOCKWISE = _said("clockwise", "[↻⟳⥁↷]")
_SENSES = (
    (_said("counter-clockwise", "[↺⟲⥀↶]"), 1), (_CLOCKWISE, -1), (_said("into the paper"), -1),
    (_said("out of the paper"), 1), (_said("negative", r"[-]\s*k\u0302?\b"), -1), (_said("positive"), 1),
)
_WAY = [
    (_said(f"{way}"), angle) for way, angle in (
        ("to the upper right", 45.0), ("to the upper left", 135.0), ("to the lower left", -135.0),
        ("to the lower right", -45.0), ("to the right", 0.0), ("to the left", 180.0), ("upward", 90.0),
        ("downward", -90.0), ("along x", 0.0), ("against x", 180.0), ("along y", 90.0), ("against y", -90.0),
    )
]

_COMPASS = {"east": 0, "e": 0, "东": 0, "north": 90, "n": 90, "北": 90, "west": 180, "w": 180, "西": 180,
            "south": -90, "s": -90, "南": -90}
_WORD = r"(?:north|south|east|west)"
_ENDING = r"(?:(?:er)?ly|ern|wards?)?"
_FROM_COMPASS = (
    re.compile(rf"{_NUMBERED}\s*(?P<to>{_WORD}|[NSEW])\s*of\s*(?:due\s*)?(?P<base>{_WORD}|[NSEW])\b", re.IGNORECASE),
    re.compile(rf"\b(?P<base>{_WORD})\s*{_NUMBERED}\s*(?P<to>{_WORD})\b", re.IGNORECASE),
    re.compile(rf"(?<![\w/])(?P<base>[NSEW])\s*{_NUMBERED}\s*(?P<to>[NSEW])(?![\w/])"),
    re.compile(rf"(?P<base>[东南西北])偏(?P<to>[东南西北])\s*{_NUMBERED}"),
)
_BEARING = re.compile(
    r"(?:\b(?:bearing|azimuth|heading)\b|方位角?)\s*(?:of\b|[=:为是])?\s*(?P<deg>\d+(?:[.,]\d+)?)"
    + rf"(?:{_UNIT})?", re.IGNORECASE,
)
_POINTS = (
    re.compile(rf"\b(?P<near>{_WORD})[\s-]*(?P<one>north|south)[\s-]*(?P<two>east|west){_ENDING}\b", re.IGNORECASE),
    re.compile(rf"\b(?:due\s*)?(?P<one>north|south)(?:[\s-]*(?P<two>east|west))?{_ENDING}\b", re.IGNORECASE),
    re.compile(rf"\b(?:due\s*)?(?P<one>east|west)(?P<two>)?{_ENDING}\b", re.IGNORECASE),
    re.compile(r"(?<![\w/.])(?P<near>[NSEW])(?P<one>[NS])(?P<two>[EW])(?![\w/])"),
    re.compile(r"(?<![\w/.])(?P<one>[NS])(?P<two>[EW])(?![\w/])"),
    re.compile(r"(?<![\w/.])(?P<one>[NSEW])(?P<two>)(?![\w/])"),
    re.compile(r"(?:向|往|朝|正)?(?P<one>[东西])(?P<two>[南北])?(?:方向?|面|边)?"),
    re.compile(r"(?:向|往|朝|正)?(?P<one>[南北])(?P<two>)(?:方向?|面|边)?"),
)
_QUARTER = [_said(f"{side}") for side in ("right of it", "left of it", "above", "below")]
_FROM_UPRIGHT, _QUADRANT_ASIDE = _said("from the vertical"), _said("beside a quarter")
_POLAR = re.compile(r"\be\s*\^?\s*[({]*\s*(?:[ij]\s*[*·]?\s*)?" + _NUMBERED + r"\s*[*·]?\s*[ij]?\s*[)}]*")
_LINE = re.compile(
    r"(?:(?P<square>⊥|⟂|(?i:\b(?:perpendicular|square|normal)\s*to\b)|垂直于?)"
    r"|∥|//|(?i:\bparallel\s*to\b|\balong\b)|平行于?|沿)\s*(?:(?i:the|bar|link|line)\b\s*)*杆?"
    r"(?P<one>[A-Z]\d*)(?P<two>[A-Z]\d*)(?![A-Za-z0-9])\s*(?:(?i:bar|link|line)\b|杆)?(?:方向)?"
)
_GUIDE = re.compile(r"(?:(?P<square>⊥|⟂)|∥|//)\s*(?P<one>[A-Za-z]\w*)(?![\w-])")
_POINT = r"(?P<{}>[A-Z]\d*)(?![A-Za-z0-9])"
_FROM_TO = re.compile(
    rf"(?:(?i:\bfrom\b)|[由从自])?\s*(?:点\s*)?{_POINT.format('one')}\s*(?:点\s*)?(?:(?i:\bto(?:wards?)?\b)|→|指向|到|向)"
    rf"\s*{_POINT.format('two')}\s*点?"
)
_TOWARDS = re.compile(rf"(?:(?i:\btowards?\b|\bto\b)|指向)\s*(?:(?i:point)\s*)?{_POINT.format('two')}\s*点?")
_UPRIGHT_LINE, _LEVEL_LINE = _said("vertical"), _said("horizontal")
ROUGH = math.radians(45.0)  # an arrow or a word is meant for all that lies nearest to it


def read_way(text: str, symbol: Symbol, unit: str = "") -> Way:
    """The direction in a cell of a column of directions: an angle, in the unit of the column's head if it has none of
    its own, an arrow, words.  Raises ValueError."""
    way, rest = way_in(plain_text(text), symbol)
    if symbol.is_vector and not way.says:
        bare = re.fullmatch(_TURN, rest.strip(" °;,()"))
        if bare is not None:
            return Way(*_angle(bare, unit_factor(unit, _TURNED, Units()) or math.radians(1.0)))
        raise ValueError(Phrase("cell no direction", cell=text[:40]))
    if not symbol.is_vector and not way.sense:
        if rest.strip() in ("+", "-"):
            return Way(sense=1 if rest.strip() == "+" else -1)
        raise ValueError(Phrase("cell no sense", cell=text[:40]))
    return way


def _angle(match: re.Match[str], per: float = math.radians(1.0)) -> tuple[float, float]:
    """An angle and half a unit of its last digit (rad), in the unit behind it; without one in units of ``per`` rad."""
    plain, unit = match["deg"].replace(",", "."), match.groupdict().get("unit")
    per = _ANGLES[unit.lower()] if unit else per
    places = len(plain.partition(".")[2])
    return float(plain) * per, 0.5 * 10.0**-places * per


def way_in(text: str, symbol: Symbol) -> tuple[Way, str]:
    """The direction or the sense in a text, and the text without it."""
    if not symbol.is_vector:
        for pattern, sense in _SENSES:
            match = pattern.search(text)
            if match:
                return Way(sense=sense), _without(text, match)
        return Way(), text
    lines, text = _lines(text, symbol)
    way, rest = next(_ways(text, symbol), (Way(), text))
    return replace(way, lines=lines), rest


def _without(text: str, match: re.Match[str]) -> str:
    return text[: match.start()] + " " + text[match.end() :]


def _lines(text: str, symbol: Symbol) -> tuple[tuple[Line, ...], str]:
    """The bars along or square to which a vector is said to lie, with their senses, and the text without them."""
    lines: list[Line] = []
    while match := _LINE.search(text):
        lines.append(Line(match["one"], match["two"], square=bool(match["square"])))
        text = _without(text, match)
    while match := _GUIDE.search(text):
        lines.append(Line(match["one"].replace("_", ""), square=bool(match["square"])))
        text = _without(text, match)
    while match := _FROM_TO.search(text):
        lines.append(Line(match["one"], match["two"], directed=True))
        text = _without(text, match)
    match = _TOWARDS.search(text)
    if match and symbol.of is not None:
        lines.append(Line(symbol.of.point, match["two"], directed=True))
        text = _without(text, match)
    return tuple(lines), text


def _ways(text: str, symbol: Symbol) -> Iterator[tuple[Way, str]]:
    """The directions that a text may mean, the plainest first, each with the text without it."""
    yield from _by_compass_angle(text, symbol)
    quadrant = _by_quadrant(text)
    if quadrant is not None:
        yield quadrant
    for match in (_SIDE.search(text), _SIDE_ZH.search(text)):
        if match:
            yield Way(*_from_axis(match)), _without(text, match)
    for pattern in (_POLAR, _ANGLE, _DEGREES):
        match = pattern.search(text)
        if match:
            yield Way(*_angle(match)), _without(text, match)
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
    return symbol.measure.force > 0 and any(g in ("N", "E", "S", "W") for g in match.groups())


def _by_compass_angle(text: str, symbol: Symbol) -> Iterator[tuple[Way, str]]:
    """40° south of east, S 50° E, 南偏东50°; bearing 130° counts clockwise from north."""
    for pattern in _FROM_COMPASS:
        match = pattern.search(text)
        if match and not _letters(match, symbol):
            base, to = (_COMPASS[match[key].lower()] for key in ("base", "to"))
            turn = math.sin(math.radians(to - base))
            if abs(turn) > 0.5:
                angle, room = _angle(match)
                yield Way(math.radians(base) + math.copysign(angle, turn), room), _without(text, match)
    match = _BEARING.search(text)
    if match:
        angle, room = _angle(match)
        yield Way(math.pi / 2 - angle, room), _without(text, match)


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
    sides = [bool(side.search(rest)) for side in _QUARTER]
    angle, room = _angle(match)
    if sides[0] == sides[1] or sides[2] == sides[3] or angle > math.pi / 2:
        return None
    angle = math.pi / 2 - angle if _FROM_UPRIGHT.search(rest) else angle
    along, up = (1.0 if sides[0] else -1.0), (1.0 if sides[2] else -1.0)
    return Way(math.atan2(up * math.sin(angle), along * math.cos(angle)), room), _QUADRANT_ASIDE.sub(" ", rest)


_TURNS = {"above": 1, "over": 1, "上方": 1, "以上": 1, "之上": 1,
          "below": -1, "under": -1, "下方": -1, "以下": -1, "之下": -1}
_LEANS = {"left of": 1, "right of": -1}


def _from_axis(match: re.Match[str]) -> tuple[float, float]:
    """An angle said from an axis: 12° above -x is 168°."""
    angle, room = _angle(match)
    side, half = (match["side"] or "above").lower(), match.groupdict().get("half") or ""
    sign = -1 if (match["sign"] or "").strip().lower() in ("-", "negative", "负") or half.startswith("负") else 1
    level = match["axis"].lower() in ("x", "horizontal")
    base = (math.pi if sign < 0 else 0.0) if level else sign * math.pi / 2
    turn = (_TURNS if level else _LEANS).get(side)
    if turn is None:
        turn = sign * (-1 if side.startswith(("clockwise", "cw")) else 1)
    return base + sign * turn * angle, room


_NOTHING = _said("nothing", "[-?/—]?|--")
_ABOUT, _ASIDE = _said("about", "[≈~≃≅∼]"), _said("beside a value")
_RAISED = re.compile(r"(?<=[A-Za-z])\s*\^\s*\{?\s*([+-]?\d)(?:\s*\})?")
# an inch behind a number or a force, which is no "in the sense of"
_INCHES = re.compile(
    r"(?:(?<=[\d)\]])|(?<=lb)|(?<=lbf))[\s·*⋅-]*in\b\.?"
    r"(?!\s+(?:the|its|a|direction|sense|positive|negative|[+-]?[xy]|mm|cm|m|rad|deg)\b)", re.IGNORECASE,
)
_PER_TIME = re.compile(r"(?<=[\d\s])\b1\s*/\s*(?=s|min)")
# of a number at the beginning, or behind a sign of punctuation
_PARTED_SIGN = re.compile(r"(?:^|(?<=[=:;,(\[<])\s*)([+-])\s+(?=[\d.])")
_SPACED = re.compile(r"(?<![\d.,])\d{1,3}(?: \d{3})+(?!\d)(?:[.,]\d+)?(?![\d.,]*\d)")
_HAT = r"\s*[*·]?\s*(?:\\?hat)?\{{?[{0}]\u0302?\}}?"
_UNIT_VECTORS = re.compile(rf"({NUMBER}){_HAT.format('iîI')}\s*([+-])\s*({NUMBER}){_HAT.format('jĵJ')}(?![A-Za-z])")
_LABELLED = re.compile(
    rf"[A-Za-z_]*([xy])\s*[=:]\s*({NUMBER})([^;,=:]*?)[;,]?\s*[A-Za-z_]*(?!\1)[xy]\s*[=:]\s*({NUMBER})", re.IGNORECASE
)
_CELL_PART = rf"({NUMBER})((?:[^\d,;+°→←↑↓-]|(?<=[A-Za-z^])\d)*?)\s*(?:to the |向)?(?:({{}})|({{}}))(?:wards?|方)?"
_TWO_WAYS = re.compile(
    _CELL_PART.format("right|east|E|→|右|东", "left|west|W|←|左|西") + r"\s*(?:[,;，；]|and|和)?\s*"
    + _CELL_PART.format("up|north|N|↑|上|北", "down|south|S|↓|下|南") + "(?![A-Za-z])"
)
# no digit that belongs to a unit (s2, s-1, 秒²) is a number
_BARE_NUMBER = re.compile(rf"(?<![A-Za-z0-9./^])(?<!\d,)(?<![A-Za-z秒]-)(?!(?<=秒)-?2(?![\d.,])){NUMBER}")
_PAIR = re.compile(r"[(\[<⟨]\s*([+-]?[\d.]+)\s*,\s*([+-]?[\d.]+)\s*[)\]>⟩]")
_COMPLEX = re.compile(rf"({NUMBER})\s*([+-])\s*({NUMBER})\s*[*·]?\s*[ij]\b")


def is_blank(text: str) -> bool:
    """Whether a cell holds no answer."""
    return _NOTHING.fullmatch(plain_text(text)) is not None


def read_cell(
    text: str, symbol: Symbol, units: Units, unit: str = "", style: str = ".", way: Way | None = None
) -> Printed:
    """The value that a cell states.

    Parameters
    ----------
    units : of the scene
    unit : of the column's head; the scene's unit if it has none; a unit in the cell goes before both
    style : of the numbers beside it, as of ``style_of``
    way : the direction from a column of directions

    Raises
    ------
    ValueError : a text that is no value of the quantity; its argument is the reason as a phrase

    >>> read_cell("482,7 mm/s", Symbol.parse("v_B"), Units(), style=",").value
    0.4827
    >>> read_cell("≈2.82 cw", Symbol.parse("omega_3"), Units()).value
    -2.82
    >>> read_cell("0.4827", Symbol.parse("v_B"), Units(), "m/s").text
    '0.4827 m/s'
    """
    plain = _PER_TIME.sub("/", _RAISED.sub(r"\1", _ABOUT.sub(" ", plain_text(text))))
    plain = _INCHES.sub(" inch", _joined(_PARTED_SIGN.sub(r"\1", plain), symbol))
    if symbol.is_vector:
        plain = _COMPLEX.sub(r"\1; \2\3", _UNIT_VECTORS.sub(r"\1; \2\3", _PAIR.sub(r"\1; \2", plain)))
        plain = _TWO_WAYS.sub(_two_components, plain)
        plain = _LABELLED.sub(_x_first, plain)
    plain = re.sub(r"(?:±|\+/-|\+-).*$", "", plain)
    direction, rest = way_in(plain, symbol)
    rest = rest.rpartition("=")[2]
    way = direction if direction.says else way or Way()
    numbers = [match[0].removesuffix(".") for match in _BARE_NUMBER.finditer(rest)]
    left = _ASIDE.sub(" ", _BARE_NUMBER.sub(" ", rest))
    left = re.sub(r"[;:,()\[\]<>⟨⟩|、。\s]+", " ", left)
    left = " ".join(dict.fromkeys(left.split()))  # both components may bear the unit
    if not symbol.is_vector:
        left = re.sub(r"^k\u0302?$", "", left)  # the unit vector out of the paper
    if not numbers or len(numbers) > (2 if symbol.is_vector else 1):
        raise ValueError(Phrase("cell more numbers" if numbers else "cell no number", cell=text.strip()[:40]))
    said = left or unit
    factor = unit_factor(said, symbol, units) if said else symbol.unit(units).si
    if factor is None:
        key = "cell no unit" if is_unit(said, units) else "cell no words"
        measure = Phrase(f"measure {symbol.measure.name}")
        raise ValueError(Phrase(key, cell=text.strip()[:60], unit=said[:40], measure=measure))
    written = [pointed(n, style) for n in numbers]
    if way.sense:
        written = [("-" if way.sense < 0 else "") + n.lstrip("+-") for n in written]
    if way.angle is not None and len(written) == 1 and written[0].startswith("-"):
        written, way = [written[0][1:]], replace(way, angle=way.angle + math.pi)
    shown = text.strip()
    if unit and not left and factor != symbol.unit(units).si:
        shown += f" ({unit})" if any(map(str.isalpha, shown)) else f" {unit}"
    made = replace(stated(symbol, written, units, factor), shown=shown)
    if len(written) > 1 or not symbol.is_vector:
        return made
    return replace(made, way=way)


def _two_components(match: re.Match[str]) -> str:
    """934.6 mm/s right, 784.2 mm/s down: the two as signed components."""
    x, unit, right, _, y, _, up, _ = match.groups()
    return f"{x if right else f'-{x}'}; {y if up else f'-{y}'} {unit}"


def _x_first(match: re.Match[str]) -> str:
    """Two components with their letters as two numbers, that along x first, with the unit."""
    x, y = (match[2], match[4]) if match[1] in "xX" else (match[4], match[2])
    return f"{x}; {y} {match[3]}"


def _joined(text: str, symbol: Symbol) -> str:
    """Thousands parted by a space or an apostrophe put together: ``1'220``, ``1 220.5``.  Raises ValueError where they
    may be two components."""
    text = re.sub(r"(?<=\d)['’](?=\d{3}(?!\d))", "", text)
    match = _SPACED.search(text)
    if match is None:
        return text
    if not symbol.is_vector:
        return text[: match.start()] + match[0].replace(" ", "") + text[match.end() :]
    groups = match[0].split(" ")
    if re.match(r"\s*(?:°|deg|度)", text[match.end() :]):  # the last is a direction
        groups.pop()
    if len(groups) > 1 and not text.startswith(("(", "[")):
        raise ValueError(Phrase("cell two components", cell=text[:40], number="".join(groups)))
    return text
