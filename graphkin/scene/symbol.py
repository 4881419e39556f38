"""Names of quantities: ``v_B``, ``v_B@3/B@2``, ``omega_3``, ``theta_3/2``, ``d_B/C``, ``stroke_5/6``, ``F_5/6`` ...;
and values that somebody states of them.

A kind of quantity is one entry of `KINDS`: what its name is followed by, and what it measures.  A name means the same
wherever it stands: ``v_C/B`` is the velocity of point C relative to point B, ``v_3/4``, where the names are no points,
that of link 3 along the guide of link 4 on which it slides, with its sign; ``C`` and ``B@3`` are places of points,
``v_C.x`` is a component.
"""

from __future__ import annotations

import math
import re
from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from decimal import Decimal, InvalidOperation
from functools import cached_property
from typing import Literal, NamedTuple

from graphkin.scene.tables import MEASURES, Measure, Unit, Units
from graphkin.words import Phrase, listed

Value = complex | float
"""What a quantity is: a vector of the plane, or a number."""
Scope = Literal["motion", "position", "turn", "force", "cycle"]

_POINT = r"[A-Z][A-Za-z0-9]*"
_LINK = r"[A-Za-z0-9]+"


def forms_of_names(point: str, link: str, lax: bool = False) -> dict[str, str]:
    """The patterns of names behind a kind: groups "of" and "to" are points (of the links "of_link" and "to_link"),
    "link" and "other" are links.

    Parameters
    ----------
    point, link : patterns of their names
    lax : as people write them: signs between names may be missing, and loads are not distinguished
    """
    at, plus = ("@?", "") if lax else ("@", r"(?P<plus>\+)?")

    def between(signs: str) -> str:
        return f"[{signs}]?" if lax else signs[0]

    def part(name: str, must: bool = False) -> str:
        return rf"(?P<{name}>{point})(?:{at}(?P<{name}_link>{link})){'' if must else '?'}"

    of, to, first, second = rf"(?P<of>{point})", rf"(?P<to>{point})", rf"(?P<link>{link})", rf"(?P<other>{link})"
    forms = {
        "point": of,
        "points": rf"{part('of')}(?:{between('/')}{part('to')})?",
        "coincident": rf"{part('of', lax)}{between('/')}{part('to', lax)}",
        "two points": rf"{of}{between('/-')}{to}",
        "link": first,
        "link of link": rf"{first}(?:{between('/')}{second})?",
        "pair": rf"{first}{between('/-')}{second}",
        "links": rf"{first}{between('-/')}{second}",
        "place": part("of"),
        "link or joint": rf"{first}(?:{between('/')}{second})?(?:@{part('of')})?{plus}",
        "of link": rf"{first}{plus}",
    }
    named = {
        "load": rf"(?P<name>{link}){plus}",
        "force": rf"(?P<name>(?:F|Fi|G|P)_{link}){plus}",
        "excess work": r"(?P<name>W)",
        "flywheel": r"(?P<name>F)",
    }
    return forms if lax else forms | named


_FORMS = forms_of_names(_POINT, _LINK)


@dataclass(frozen=True)
class Kind:
    """A kind of quantity.

    ``measure`` is the name of its measure, ``form`` the form of its names (a key of the forms above), ``scope`` where
    it belongs: to a polygon of motion, to the mechanism's position, to the whole turn, to a force polygon, or to a
    flywheel.  ``letter`` is its letter in print, where it is not its name, ``mark`` a sign above it.  ``of_pose`` tells
    a place, an angle, a travel or a derivative of one by time; with ``of_pairs`` sliding pairs have it too, along the
    guide and with a sign.  A ``distance`` and an ``acute`` angle, of at most 90 degrees, are never negative.
    ``instead`` names the quantities that a drawing has for one that tables alone give.
    """

    name: str
    measure: str
    form: str
    scope: Scope
    example: str
    is_vector: bool = False
    of_pose: bool = False
    of_pairs: bool = False
    letter: str = ""
    mark: str = ""
    distance: bool = False
    acute: bool = False
    instead: str = ""


KINDS = {
    kind.name: kind
    for kind in (
        Kind("v", "velocity", "points", "motion", "v_B, v_B@3, v_C/B", True, of_pose=True, of_pairs=True),
        Kind("a", "acceleration", "points", "motion", "a_B, a_B@3, a_C/B", True, of_pose=True, of_pairs=True),
        Kind("an", "acceleration", "points", "motion", "an_B, an_C/B", True),
        Kind("at", "acceleration", "points", "motion", "at_B, at_C/B", True),
        Kind("ak", "acceleration", "coincident", "motion", "ak_B@3/B@2", True),
        Kind("ar", "acceleration", "coincident", "motion", "ar_B@3/B@2", True),
        Kind("omega", "angular velocity", "link", "motion", "omega_3", of_pose=True, letter="ω"),
        Kind("alpha", "angular acceleration", "link", "motion", "alpha_3", of_pose=True, letter="α"),
        Kind("x", "length", "point", "position", "x_D"),
        Kind("y", "length", "point", "position", "y_D"),
        Kind("theta", "angle", "link of link", "position", "theta_3, theta_3/2", of_pose=True, letter="θ"),
        Kind("d", "length", "two points", "position", "d_B/C, d_P12/A", letter="l", distance=True),
        Kind("s", "length", "pair", "position", "s_2/3", of_pose=True),
        Kind("gamma", "angle", "links", "position", "gamma_2-3", letter="γ", acute=True),
        Kind("pressure", "angle", "link", "position", "pressure_5", letter="α", mark="p", acute=True),
        Kind("stroke", "length", "pair", "turn", "stroke_5/6", letter="H"),
        Kind("swing", "angle", "link", "turn", "swing_3", letter="ψ"),
        Kind("K", "number", "link of link", "turn", "K_5/6"),
        Kind("theta_lag", "angle", "link of link", "turn", "theta_lag_5/6", letter="θ", mark="K"),
        Kind("F", "force", "link or joint", "force", "F_5/6, F_5/6@C, F_2, F_2@B, F_2@B@3", True),
        Kind("Fi", "force", "of link", "force", "Fi_6", True),
        Kind("G", "force", "of link", "force", "G_6", True),
        Kind("P", "force", "load", "force", "P_cut", True),
        Kind("M", "moment", "link or joint", "force", "M_2, M_6/1"),
        Kind("Mi", "moment", "of link", "force", "Mi_4"),
        Kind("h", "length", "of link", "force", "h_4"),
        Kind("arm", "velocity", "force", "force", "arm_P_cut, arm_G_6"),
        Kind("excess", "work", "excess work", "cycle", "excess_W"),
        Kind("J", "inertia", "flywheel", "cycle", "J_F"),
    )
}
"""All kinds of quantities by name.  A further kind of quantity is a further entry."""

_OF_ALL = {
    **KINDS,
    "place": Kind("place", "length", "points", "motion", "C or B@3", of_pose=True, instead="x_{point}, y_{point}"),
    "transmission": Kind("transmission", "angle", "links", "position", "4-5", letter="γ", acute=True),
}
"""With the place of a point, which has no letter of its own, and what only a group as a whole has."""
_LONGEST_FIRST = sorted(KINDS, key=len, reverse=True)
_ELSEWHERE = re.compile(r"(.*\S)\s+at\s+(\S+)", re.DOTALL)
_COMPONENT = re.compile(r"(.+)\.([xy])", re.DOTALL)


class PointRef(NamedTuple):  # looked up by the ten thousand
    """A point as a point of a link: ``B@3`` is the point of link 3 that lies at B at this moment.

    ``link`` is "" for the pin itself (``B``).
    """

    point: str
    link: str = ""

    def __str__(self) -> str:
        return f"{self.point}@{self.link}" if self.link else self.point


@dataclass(frozen=True, order=True)
class Symbol:
    """A quantity by name.

    ``kind`` is a name of `KINDS`, "place" for a point's place, or "transmission" for the angle of a group, whose label
    is its ``name``; ``of`` and ``to`` are its points (``to`` the reference point, or the second of two), ``link`` and
    ``other`` its links (of a sliding pair the sliding and the guiding link; of a pin in a slot ``link`` is the pin).
    ``at`` names the position, "" for this one.

    Of forces ``link`` acts on ``other`` at the joint ``of`` (where they share two); of a balance ``of`` is the place
    where it acts on ``link`` (where several drivers push that); ``name`` is the name of a load, or
    of the force of an arm; with ``plus`` a load that begins or ends exactly there acts.  ``turning`` marks a load that
    is a moment, which its name does not tell.  ``seen`` is the link held still, from which a vector is seen; "" for the
    frame.  ``axis`` is "x" or "y" for a component of a vector along an axis of the frame; ``along`` marks the component
    along the guide on which the vector lies, with its sign, which has no name of its own.

    >>> Symbol.parse("v_B@3/B@2").id
    'v_B3-B2'
    >>> str(Symbol.parse("omega_3")), str(Symbol.parse("gamma_2-3 at 7"))
    ('omega_3', 'gamma_2-3 at 7')
    >>> Symbol.parse("v_C/B").is_vector, Symbol.parse("v_3/4").is_vector, Symbol.parse("B@3").kind
    (True, False, 'place')
    """

    kind: str
    of: PointRef | None = None
    to: PointRef | None = None
    link: str = ""
    other: str = ""
    at: str = ""
    name: str = ""
    plus: bool = field(default=False, hash=False)
    turning: bool = field(default=False, compare=False)
    seen: str = field(default="", hash=False)
    axis: str = field(default="", hash=False)
    along: bool = field(default=False, hash=False)

    @classmethod
    def parse(cls, text: str) -> Symbol:
        """Read a symbol.  Raises ValueError with the reason where it is none."""
        elsewhere = _ELSEWHERE.fullmatch(text)
        if elsewhere:
            return replace(cls.parse(elsewhere[1]), at=elsewhere[2])
        component = _COMPONENT.fullmatch(text)
        if component:
            vector = cls.parse(component[1])
            if not vector.is_vector:
                raise ValueError(Phrase("is no vector", text=component[1]))
            return replace(vector, axis=component[2])
        place = re.fullmatch(_FORMS["place"], text)
        if place is not None:
            return cls.of_names("place", place.groupdict(""))
        name = next((kind for kind in _LONGEST_FIRST if text.startswith(f"{kind}_")), None)
        if name is None:
            raise ValueError(no_quantity(text))
        kind = KINDS[name]
        names = text[len(name) + 1 :]
        match = re.fullmatch(_FORMS[kind.form], names)
        if match is None and kind.of_pairs:
            match = re.fullmatch(_FORMS["pair"], names)
        if match is None:
            missing, example = Phrase(_MISSING.get(kind.form, "names no link")), listed(kind.example.split(", "))
            raise ValueError(Phrase("write for example", text=text, missing=missing, example=example))
        return cls.of_names(name, match.groupdict(""))

    @classmethod
    def of_names(cls, kind: str, names: Mapping[str, str]) -> Symbol:
        """The quantity of a kind by the names behind it, as `forms_of_names` calls them; "" stands for none."""
        of, to = (PointRef(names[part], names.get(f"{part}_link", "")) if names.get(part) else None
                  for part in ("of", "to"))
        link, other, name = (names.get(part, "") for part in ("link", "other", "name"))
        return cls(kind, of, to, link, other, name=name, plus=bool(names.get("plus")))

    @property
    def entry(self) -> Kind:
        """The entry of its kind."""
        return _OF_ALL[self.kind]

    @property
    def is_vector(self) -> bool:
        return self.entry.is_vector and not (self.turning or self.axis or self.along or self.is_rate_of_pair)

    @property
    def heads(self) -> tuple[str, ...]:
        """The names of its columns; a vector ("v_B.x", "v_B.y") and a place ("x_B", "y_B") have two."""
        if self.kind == "place":
            return f"x_{self}", f"y_{self}"
        return (f"{self}.x", f"{self}.y") if self.is_vector else (str(self),)

    @property
    def is_rate_of_pair(self) -> bool:
        """Whether it is a rate of a sliding pair along its guide."""
        return self.of is None and self.entry.of_pairs

    @property
    def of_pair(self) -> Symbol | None:
        """The rate of a sliding pair whose links are called as its two points; None where it is no such quantity."""
        of, to = self.of, self.to
        if of is None or to is None or of.link or to.link or not self.entry.of_pairs:
            return None
        return Symbol(self.kind, link=of.point, other=to.point, at=self.at)

    @property
    def is_of_tables(self) -> bool:
        """Whether only tables give it: the place of a point, a component, a rate of a sliding pair; no drawing has
        these by themselves."""
        return self.entry.instead != "" or self.axis != "" or self.is_rate_of_pair

    @property
    def is_load(self) -> bool:
        """Whether it is a force or a moment of the mechanism."""
        return self.scope == "force" and self.measure.force == 1

    @property
    def both(self) -> tuple[Symbol, ...]:
        """A force without and with the loads that begin or end just there, both of them right; others themselves."""
        return (self, replace(self, plus=True)) if self.is_load and not self.plus else (self,)

    @property
    def order(self) -> int | None:
        """The order of its derivative by time of a place, an angle or a travel; None for other quantities."""
        return self.measure.order if self.entry.of_pose else None

    @property
    def is_position(self) -> bool:
        """Whether it is an angle, a travel, or another position."""
        return self.scope == "position"

    @property
    def is_angle_of_link(self) -> bool:
        """Whether it is the angle of a link, which may turn on and on."""
        return self.kind == "theta" and not self.other

    @property
    def is_of_output(self) -> bool:
        """Whether it is the angle of a link or the travel of a sliding pair."""
        return self.is_angle_of_link or self.kind == "s"

    @property
    def is_unsigned(self) -> bool:
        """Whether its number is never negative, and zero only at a least value: a size, a distance, an angle of at most
        90 degrees."""
        return self.is_vector or self.entry.distance or self.entry.acute

    @property
    def scope(self) -> Scope:
        return self.entry.scope

    @property
    def measure(self) -> Measure:
        return MEASURES["moment" if self.turning else self.entry.measure]

    @property
    def pair(self) -> str:
        """The sliding pair or the link that it is of, as `solve` names it."""
        return f"{self.link}/{self.other}" if self.other else self.link

    @property
    def here(self) -> Symbol:
        """This quantity without the name of its position."""
        return replace(self, at="") if self.at else self

    @property
    def whole(self) -> Symbol:
        """The vector of which it is a component; itself where it is no component."""
        return replace(self, axis="", along=False) if self.axis or self.along else self

    @property
    def opposite(self) -> Symbol:
        """The force or couple of the second link on the first, ``F_6/5@C`` of ``F_5/6@C``; a quantity of one link as it
        is."""
        return replace(self, link=self.other, other=self.link) if self.other else self

    def difference(self, value: complex | float, other: complex | float) -> complex | float:
        """A value of it (SI) less another; of an angle without whole turns.

        >>> Symbol.parse("theta_3").difference(math.radians(179), math.radians(-179)) < 0
        True
        """
        less = value - other
        return math.remainder(less.real, math.tau) if self.measure.is_angle and math.isfinite(less.real) else less

    def links(self) -> Iterator[str]:
        """The names of links in it; the first may be a pin's (see ``link``)."""
        yield from (name for name in (self.link, self.other) if name)
        yield from (ref.link for ref in (self.of, self.to) if ref and ref.link)

    def unit(self, units: Units, radians: bool = False) -> Unit:
        """Its unit in files and tables by the scene's units; with ``radians`` its unit in JSON."""
        return units.of(self.measure, radians)

    @cached_property
    def id(self) -> str:
        """The symbol as an SVG id: ``@`` dropped, ``/`` written ``-``."""
        return str(self).replace("@", "").replace("/", "-").replace(" at ", "-at-").replace("+", "-with").replace(
            " seen from ", "-seen-from-"
        )

    def __str__(self) -> str:
        if self.of is None or self.link:
            name = f"{self.kind}_{self.link or self.name}"
            name += ("-" if self.entry.form == "links" else "/") + self.other if self.other else ""
            name += (f"@{self.of}" if self.of else "") + ("+" if self.plus else "")
        elif self.kind == "place":
            name = str(self.of)
        else:
            name = f"{self.kind}_{self.of}" + (f"/{self.to}" if self.to else "")
            name += f" seen from {self.seen}" if self.seen else ""
        name += f".{self.axis}" if self.axis else ""
        return f"{name} at {self.at}" if self.at else name


_MISSING = {
    "point": "names no point", "points": "names no point", "coincident": "needs two coincident points",
    "two points": "needs two points", "pair": "names no sliding pair", "links": "needs two links",
    "link or joint": "names no link and no joint of two", "load": "names no load", "force": "names no force",
    "excess work": "is no quantity", "flywheel": "is no quantity",
}
"""What a name lacks that has not the form of its kind; of the other forms it names no link."""


def no_quantity(text: str) -> Phrase:
    """The sentence on a name that names no quantity."""
    known = listed([kind.example.split(",")[0] for kind in KINDS.values()])
    return Phrase("is no quantity known are", text=text, names=known)


def centre_links(name: str, links: Container[str]) -> tuple[str, str] | None:
    """The two links of an instant centre by its name in books; None for a name of no centre.

    >>> centre_links("P12", {"1", "2"}), centre_links("P", {"1"})
    (('1', '2'), None)
    """
    cuts = ((name[1:k], name[k:]) for k in range(2, len(name))) if name.startswith(("P", "I")) else ()
    return next(((a, b) for a, b in cuts if a != b and a in links and b in links), None)


# values that somebody states, with the digits they are stated to

MOST_PARDONED = 0.01  # part of a value that rounding to one digit may take away
SMALLEST = -300  # power of ten of a last digit that a double still holds


@dataclass(frozen=True)
class Line:
    """A line through two points, or along a guide (``two`` is ""), or ``square`` to it, along which a vector is said to
    lie; ``directed``: from the first to the second."""

    one: str
    two: str = ""
    square: bool = False
    directed: bool = False


@dataclass(frozen=True)
class Way:
    """A direction as written (rad, counter-clockwise from the x axis) with the room to either side of it, and its
    opposite where ``either``; a sense (+1 counter-clockwise, -1 clockwise); or the lines along which it lies."""

    angle: float | None = None
    room: float = 0.0
    sense: int = 0
    either: bool = False
    lines: tuple[Line, ...] = ()

    @property
    def says(self) -> bool:
        """Whether it holds a direction, a sense or a line."""
        return bool(self.sense or self.angle is not None or self.lines)


@dataclass(frozen=True)
class Printed:
    """A stated value.

    ``value`` (SI) is a float, or a complex number for a vector given by two components; ``step`` (SI) one unit of its
    last digit; ``digits`` the number of its significant digits; ``texts`` its numbers as written, in scene units unless
    ``shown``, the whole cell, says otherwise.  ``way`` is the direction of a vector given by size and direction.
    ``signed`` tells that its number is a place on the line of the motion (a guide), also where it is positive; else a
    positive number is the size of a vector.
    """

    symbol: Symbol
    value: Value
    step: float
    digits: int
    texts: tuple[str, ...]
    shown: str = ""
    way: Way = Way()
    signed: bool = False

    @property
    def shows_sign(self) -> bool:
        """Whether a sign was written before its one number."""
        return len(self.texts) == 1 and self.texts[0].startswith(("+", "-", "\u2212"))

    @property
    def text(self) -> str:
        """The cell as it was written."""
        return self.shown or ", ".join(self.texts)

    @property
    def rounding(self) -> float:
        """The distance within which the true value lies if it was rounded (SI): half a unit of the last digit (of each
        of two components), but of a single digit never more than a hundredth.

        A single digit is not taken for a rounded number.  A zero is zero to the decimals written.
        """
        if not self.value:
            return (0.5 if any("." in text for text in self.texts) else MOST_PARDONED) * self.step
        most = MOST_PARDONED * abs(self.value) if self.digits < 2 else math.inf
        return min(0.5 * self.step * math.sqrt(len(self.texts)), most) * (1 + 1e-9)

    @property
    def sure_digits(self) -> int:
        """Its significant digits without the zeros that a whole number ends in: 2 650 000 mm/s² may be 2.65 km/s²."""
        zeros = [0 if "." in t or "e" in t.lower() else len(t) - len(t.rstrip("0")) for t in self.texts if t.strip("0")]
        return max(1, self.digits - min(zeros, default=0))

    @property
    def coarse(self) -> float:
        """This value read in the person's favour: a whole number that ends in a zero may be rounded to tens (0.52 m/s,
        written 520 mm/s), where a ten is no more than a hundredth of it."""
        if any("." in t or not t.endswith("0") for t in self.texts):
            return self.rounding
        return max(self.rounding, min(5.0 * self.step, MOST_PARDONED * abs(self.value)))


def asked_here(asked: Sequence[Symbol]) -> tuple[Symbol, ...]:
    """The symbols asked of the scene's own position; where all are asked of others, the same quantities here."""
    return tuple(s for s in asked if not s.at) or tuple(dict.fromkeys(s.here for s in asked))


def stated(symbol: Symbol, texts: Sequence[str], units: Units, unit: float | None = None) -> Printed:
    """A value from its text, or the texts of its two components, in scene units, or in a ``unit`` (SI).

    Trailing zeros of whole numbers count as written: 480 is stated to the unit.  A component that is zero is zero to
    the accuracy of the other.

    Raises
    ------
    ValueError : a text that is no number; its argument is the reason as a phrase

    >>> v = stated(Symbol.parse("v_D"), ["480.0"], Units())
    >>> v.value, v.step, v.digits
    (0.48, 0.0001, 4)
    """
    unit = symbol.unit(units).si if unit is None else unit
    numbers = [_number(text) for text in texts]
    values = [float(n) * unit for n in numbers]
    last = max(int(n.as_tuple().exponent) for n in [n for n in numbers if n] or numbers)
    digits = max(len(n.as_tuple().digits) for n in numbers)
    value: Value = complex(*values) if len(values) == 2 else values[0]
    return Printed(symbol, value, 10.0**last * unit, digits, tuple(t.strip() for t in texts))


def _number(text: str) -> Decimal:
    plain = text.strip().replace("\u2212", "-")
    try:
        number = Decimal(plain)
    except InvalidOperation:
        raise ValueError(Phrase("cell no number", cell=plain[:40])) from None
    fine = number.is_finite() and int(number.as_tuple().exponent) < SMALLEST
    if not number.is_finite() or fine or not abs(number) < Decimal("1e15") or len(plain) > 40:
        raise ValueError(Phrase("cell no size", cell=plain[:40]))
    return number
