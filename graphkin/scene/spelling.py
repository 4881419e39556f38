"""Names of quantities as people spell them: ``v_B3``, ``ω₃``, ``omega3``, ``vB``, ``a_{CB}^{n}``, ``v_C/(m/s)``.

A spelling is held against the names that the scene has, so that ``v_B3`` is the pin B3 where there is one, and else B
as a point of link 3.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import KINDS, PointRef, Symbol
from graphkin.scene.tables import Units

__all__ = ["Spelling", "is_unit", "plain_text", "unit_factor"]

_GREEK = {"ω": "omega", "Ω": "omega", "α": "alpha", "ε": "alpha", "ϵ": "alpha", "θ": "theta", "φ": "theta",
          "ϕ": "theta", "ψ": "theta", "γ": "gamma", "τ": "t"}  # fmt: skip
_WRITTEN = {"w": "omega", "epsilon": "alpha", "phi": "theta", "ac": "ak", "l": "d", "V": "v",
            "F_R": "F", "FR": "F", "R": "F", **{k: k for k in KINDS}}
_SPOKEN = sorted(_WRITTEN, key=len, reverse=True)
_PART = re.compile(r"\^\{?([a-z])\}?")
_HEAD_UNIT = re.compile(r"^(.*?)\s*(?:\(([^()]*(?:\([^()]*\)[^()]*)*)\)|\[([^\[\]]*)\])\s*$")
_BEHIND_A_LINE = re.compile(r"^(.*?[^/\s])\s*/\s*((?:[^/]|/(?=s|min|\())+)$")
_WORDS_ASIDE = re.compile("[\u3000-\u9fff\uff00-\uffef]+")


def plain_text(text: str) -> str:
    """Raised and lowered signs, wide ones and typographic minus signs as plain ones: ``ω₃`` is ``ω3``; powers of ten
    keep an e.

    >>> plain_text("−1.22×10³ mm/s²"), plain_text("2．82（rad／s）"), plain_text("1.2·$10^{-7}$")
    ('-1.22e3 mm/s2', '2.82(rad/s)', '1.2e-7')
    """
    raised = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
    powers = re.sub(
        r"\s*[×xX·*⋅]\s*10\s*([⁻⁺]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda m: "e" + m[1].translate(raised), text.replace("$", "")
    )
    powers = re.sub(r"\s*[×xX·*⋅]\s*10\s*\^\s*\{?\s*([-+\u2212]?\d+)\s*\}?", r"e\1", powers)
    signs = str.maketrans({"\u2212": "-", "\u2010": "-", "\u2011": "-", "\u2012": "-", "\u2013": "-", "\u207b": "-",
                           "\u20d7": None, "\u0305": None, "°": "°", "º": "°"})  # fmt: skip
    return unicodedata.normalize("NFKC", powers.translate(signs)).translate(signs).strip()


@dataclass(frozen=True)
class Spelling:
    """Reads names of quantities of one scene: its points, each with the links that own it (none owns one at which
    outlines touch), its links with the frame, and its units."""

    points: Mapping[str, frozenset[str]]
    links: frozenset[str]
    units: Units

    @classmethod
    def of(cls, scene: Mechanism) -> Spelling:
        moving = {link.name: tuple(link.points) for link in scene.links}
        contacts = [contact.name for contact in scene.contacts]
        return cls.by_link({scene.frame.name: tuple(scene.frame.points), **moving}, scene.units, contacts)

    @classmethod
    def by_link(cls, points: Mapping[str, Iterable[str]], units: Units, contacts: Iterable[str] = ()) -> Spelling:
        """From the points of each link, the frame's included, and the names of contacts."""
        owners: dict[str, frozenset[str]] = dict.fromkeys(contacts, frozenset())
        for link, names in points.items():
            for name in names:
                owners[name] = owners.get(name, frozenset()) | {link}
        return cls(owners, frozenset(points), units)

    def head(self, text: str) -> tuple[str, str]:
        """The name in a head and its unit, "" if none is written: ``v_C (m/s)``, ``ω3 [rad/s]``, ``v_C/(mm·s⁻¹)``."""
        plain = plain_text(text)
        for pattern in (_HEAD_UNIT, _BEHIND_A_LINE):
            match = pattern.match(plain)
            if match:
                name, unit = match[1].rstrip(" /"), next(g for g in match.groups()[1:] if g is not None)
                unit = unit.strip("() ")
                symbol = self.symbol(name)
                if (symbol is not None or pattern is _HEAD_UNIT) and (
                    pattern is _HEAD_UNIT or (symbol and unit_factor(unit, symbol, self.units))
                ):
                    return name, unit
        return plain, ""

    def symbol(self, text: str) -> Symbol | None:
        """The quantity that a text means; None where it means none of this scene."""
        plain = plain_text(text)
        for one in dict.fromkeys((plain, _WORDS_ASIDE.sub("", plain).strip())):
            found = next(self._meanings(one), None)
            if found is not None:
                return found
        return None

    def _meanings(self, text: str) -> Iterator[Symbol]:
        if not text or len(text) > 60:
            return
        head, _, place = text.partition(" at ")
        try:
            symbol = Symbol.parse(text)
            if self._exists(symbol):
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
        for kind in _SPOKEN:
            if bare.startswith(kind) and len(bare) > len(kind):
                rest = bare[len(kind) :]
                joined = rest.lstrip("_")
                for form in self._of_kind(_WRITTEN[kind], joined):
                    if kind.endswith("R") and "/" not in form:
                        continue  # a reaction is of two links
                    yield self._usual(Symbol.parse(f"{form} at {place}" if place else form))

    def _of_kind(self, kind: str, rest: str) -> Iterator[str]:
        points = "|".join(sorted(map(re.escape, self.points), key=len, reverse=True))
        links = "|".join(sorted(map(re.escape, self.links), key=len, reverse=True))
        ways = {
            "point": [rf"({points})"],
            "points": [rf"({points})", rf"({points})@?({links})", rf"({points})/?({points})",
                       rf"({points})@?({links})/?({points})@?({links})", rf"({points})@?({links})/?({points})",
                       rf"({points})/?({points})@?({links})"],
            "coincident": [rf"({points})@?({links})/?({points})@?({links})"],
            "two points": [rf"({points})[/-]?({points})"],
            "link": [rf"({links})"],
            "of link": [rf"({links})"],
            "link or joint": [rf"({links})", rf"({links})/?({links})"],
            "link of link": [rf"({links})", rf"({links})/?({links})"],
            "pair": [rf"({links})[/-]?({links})"],
            "links": [rf"({links})[/-]?({links})"],
        }.get(KINDS[kind].form, [])  # fmt: skip
        for flags in (re.NOFLAG, re.IGNORECASE):
            for way in ways:
                match = re.fullmatch(way, rest, flags)
                if match is None:
                    continue
                names = [self._own_case(g) for g in match.groups()]
                if None in names:
                    continue
                yield f"{kind}_{self._joined(kind, [n for n in names if n])}"

    def _own_case(self, name: str) -> str | None:
        known = [*self.points, *self.links]
        if name in known:
            return name
        alike = [k for k in known if k.lower() == name.lower()]
        return alike[0] if len(alike) == 1 else None

    def _joined(self, kind: str, names: list[str]) -> str:
        if KINDS[kind].form not in ("points", "coincident", "point", "two points"):
            return KINDS[kind].sign.join(names)
        refs: list[str] = []
        for name in names:
            if name in self.points and not (name in self.links and refs and "@" not in refs[-1]):
                refs.append(name)
            else:
                refs[-1] += f"@{name}"
        return "/".join(refs)

    def _exists(self, symbol: Symbol) -> bool:
        refs = [r for r in (symbol.of, symbol.to) if r]
        return all(r.point in self.points for r in refs) and all(
            link in self.links or link in self.points for link in symbol.links()
        )

    def _usual(self, symbol: Symbol) -> Symbol:
        """The name under which a point of a link is known: ``v_B@2`` is ``v_B`` where B is one of link 2's points."""
        of, to = symbol.of, symbol.to
        if of is None or symbol.link or (to is not None and to.point == of.point):
            return symbol

        def plain(ref: PointRef | None) -> PointRef | None:
            own = ref is not None and ref.link in self.points.get(ref.point, frozenset())
            return PointRef(ref.point) if ref is not None and own else ref

        return replace(symbol, of=plain(of), to=plain(to))


_CHINESE_UNITS = (
    ("毫米", "mm"), ("厘米", "cm"), ("米", "m"), ("弧度", "rad"), ("转", "r"), ("度", "deg"), ("分钟", "min"),
    ("分", "min"), ("平方秒", "s2"), ("秒", "s"), ("每", "/"),
)
_WORDED_UNITS = (
    (r"millimet(?:re|er)s?", "mm"), (r"centimet(?:re|er)s?", "cm"), (r"met(?:re|er)s?", "m"),
    (r"radians?|rads(?!-)", "rad"), (r"per\s+|\bp(?=s\b)", "/"),
    (r"minutes?", "min"), (r"seconds?|secs", "s"), (r"newtons?", "n"), ("squared", "2"),
)  # fmt: skip
_LENGTHS = {"mm": 1e-3, "cm": 1e-2, "dm": 0.1, "m": 1.0, "km": 1e3, "um": 1e-6, "in": 0.0254, "inch": 0.0254,
            "inches": 0.0254, "\"": 0.0254, "ft": 0.3048, "feet": 0.3048}  # fmt: skip
_FORCES = {"kn": 1e3, "kgf": 9.80665, "lbf": 4.4482216152605, "lb": 4.4482216152605, "n": 1.0}
_ANGLES = {"rad": 1.0, "": 1.0, "1": 1.0, "deg": 0.017453292519943295, "°": 0.017453292519943295,
           "degrees": 0.017453292519943295, "r": 6.283185307179586, "rev": 6.283185307179586,
           "turn": 6.283185307179586}  # fmt: skip
_TIMES = {"s": 1.0, "sec": 1.0, "min": 60.0, "h": 3600.0, "": 1.0}
_RATE = re.compile(r"(?P<what>[a-z°\"1]*?)(?:/(?P<over>s|sec|min|h)(?P<power>2?)|/(?P<one>s|sec)/(?P<two>s|sec)"
                   r"|(?P<by>s|min)-(?P<times>[12]))?")  # fmt: skip


def unit_factor(text: str, symbol: Symbol, units: Units) -> float | None:
    """What a unit that people write is in SI, None where it is none of this quantity.

    >>> unit_factor("m/s", Symbol.parse("v_B"), Units()), unit_factor("mm·s⁻²", Symbol.parse("a_B"), Units())
    (1.0, 0.001)
    >>> round(unit_factor("r/min", Symbol.parse("omega_3"), Units()), 6)
    0.10472
    """
    plain = plain_text(text).lower()
    for pattern, unit in _WORDED_UNITS:
        plain = re.sub(pattern, unit, plain)
    bare = re.sub(r"[\s^·*⋅.{}]", "", plain).replace("µ", "u").replace("μ", "u")
    for word, unit in _CHINESE_UNITS:
        bare = bare.replace(word, unit)
    if symbol.measure in ("force", "moment"):
        force, arm = next(((f, bare[len(f) :]) for f in _FORCES if bare.startswith(f)), ("", bare))
        arm = arm.removeprefix("-")
        length = _LENGTHS.get(arm) if symbol.measure == "moment" else 1.0 if not arm else None
        return _FORCES[force] * length if force and length else None
    bare = bare.replace("rpm", "r/min")
    match = _RATE.fullmatch(bare)
    if match is None:
        return None
    order = {"velocity": 1, "angular velocity": 1, "acceleration": 2, "angular acceleration": 2, "length": 0,
             "angle": 0}.get(symbol.measure)  # fmt: skip
    if order is None:
        return None
    power = 0
    if match["over"]:
        power = int(match["power"] or 1)
    elif match["one"]:
        power = 2
    elif match["by"]:
        power = int(match["times"])
    time = _TIMES[match["over"] or match["one"] or match["by"] or ""]
    table = _LENGTHS if symbol.measure in ("velocity", "acceleration", "length") else _ANGLES
    what = match["what"]
    if power != order or what not in table or (order == 0 and what in ("", "1")):
        return None
    return table[what] / time**power


_MEASURED = [Symbol.parse(name) for name in ("v_A", "a_A", "omega_1", "alpha_1", "x_A", "theta_1", "F_1/2", "M_1/2")]
_MASSES = {"kg", "g", "t", "lb", "lbs", "kgm2", "w", "j", "pa", "mpa"}


def is_unit(text: str, units: Units) -> bool:
    """Whether a text is a unit, of whatever quantity.

    >>> is_unit("kg", Units()), is_unit("rad/s", Units()), is_unit("im Uhrzeigersinn", Units())
    (True, True, False)
    """
    return text.lower() in _MASSES or any(unit_factor(text, symbol, units) for symbol in _MEASURED)
