"""What is known of a vector before it is drawn: the rule of its size, and its direction as it is written; and what
somebody may take where the drawing has something else: a component left out, a value of their own for a drawn one.

A drawing with a slip shows what follows from it; nothing else of the construction changes.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from graphkin.scene.symbol import Symbol
from graphkin.words import word

__all__ = [
    "NO_SLIP", "ORDERS", "Component", "Direction", "Given", "OffCurves", "Order", "Part", "RateTimes", "Role",
    "RollingCurves", "Size", "Slip", "SquareOverRadius", "Term", "plain_in",
]  # fmt: skip

Order = Literal["velocity", "acceleration"]
Role = Literal["resultant", "relative", "normal", "tangential", "coriolis", "sliding"]
ORDERS: tuple[Order, ...] = ("velocity", "acceleration")


@dataclass(frozen=True)
class Direction:
    """A direction as it is written in an equation row: square to or along what is named.

    ``names`` are the letters of a bar (``("B", "C")``) or the name of a guide (``("h",)``); ``relation`` is "square",
    "along", "towards" (from the first to the second), "turned" (the relative velocity turned by 90 degrees in the
    sense of the guide's rotation) or "found" (as a polygon of its own gave it).
    """

    relation: Literal["square", "along", "towards", "turned", "found"]
    names: tuple[str, ...]

    def __str__(self) -> str:
        if self.relation == "towards":
            return "→".join(self.names)
        sign = {"along": "∥", "found": ""}.get(self.relation, "⊥")
        return sign + "".join(self.names)


@dataclass(frozen=True)
class Given:
    """A size that the problem gives."""

    def __str__(self) -> str:
        return "given"


@dataclass(frozen=True)
class RateTimes:
    """An angular rate of ``links`` (one, or two for a relative one) times a bar's length or a vector's size.

    >>> str(RateTimes("omega", ("3",), ("B", "C"), square=True))
    'ω_{3}²·BC'
    """

    rate: Literal["omega", "alpha"]
    links: tuple[str, ...]
    factor: tuple[str, str] | Symbol
    square: bool = False
    twice: bool = False

    def __str__(self) -> str:
        letter = "ω" if self.rate == "omega" else "α"
        factor = str(self.factor) if isinstance(self.factor, Symbol) else "".join(self.factor)
        return f"{'2' * self.twice}{letter}_{{{''.join(self.links)}}}{'²' * self.square}·{factor}"


@dataclass(frozen=True)
class SquareOverRadius:
    """The square of a relative velocity over the radius of curvature (m) of the path.

    >>> str(SquareOverRadius(Symbol.parse("v_B@2/B@1"), 0.05))
    '(v_B@2/B@1)²/ρ'
    """

    velocity: Symbol
    radius: float

    def __str__(self) -> str:
        return f"({self.velocity})²/ρ"


@dataclass(frozen=True)
class OffCurves:
    """What the curvatures of two outlines give along the normal of their contact, by the slip and the relative rate of
    the two ``links``; ``round`` where both are round, else the second is flat.

    >>> str(OffCurves(Symbol.parse("v_K@2/K@1"), ("2", "1"), False))
    '2ω_{21}·v_K@2/K@1 − ω_{21}²ρ_{1}'
    """

    velocity: Symbol
    links: tuple[str, str]
    round: bool

    def written(self, velocity: str) -> str:
        """With the slip as it is written somewhere."""
        two, one = self.links
        omega = f"ω_{{{two}{one}}}"
        if not self.round:
            return f"2{omega}·{velocity} − {omega}²ρ_{{{one}}}"
        parts = "".join(f"({omega}ρ_{{{n}}} − {velocity})" for n in (one, two))
        return f"{omega}·{velocity} − {parts}/(ρ_{{{two}}} − ρ_{{{one}}})"

    def __str__(self) -> str:
        return self.written(str(self.velocity))


@dataclass(frozen=True)
class RollingCurves:
    """What the curvatures of two round outlines that roll on each other give along their normal: the square of the
    rate of ``turning`` (one link, or two for a relative one) times what follows from the radii of the two ``links``,
    ``radius`` (m); ``inside`` where one is hollow, the second the larger.

    >>> str(RollingCurves(("3",), ("2", "3"), False, 0.01))
    'ω_{3}²·ρ_{2}ρ_{3}/(ρ_{2} + ρ_{3})'
    """

    turning: tuple[str, ...]
    links: tuple[str, str]
    inside: bool
    radius: float

    def __str__(self) -> str:
        one, two = self.links
        sign = "−" if self.inside else "+"
        first, second = (two, one) if self.inside else (one, two)
        return f"ω_{{{''.join(self.turning)}}}²·ρ_{{{one}}}ρ_{{{two}}}/(ρ_{{{first}}} {sign} ρ_{{{second}}})"


Size = Given | RateTimes | SquareOverRadius | OffCurves | RollingCurves


_SEEN = re.compile(r" seen from (\w+)")


def plain_in(language: str) -> Callable[[object], str]:
    """What writes symbols, points, sizes and directions as plain text of a language: ``v_B@3/B@2``, ``⊥BC``."""

    def written(thing: object) -> str:
        text = str(thing).replace("{", "").replace("}", "")
        if text == str(Given()):
            return word("given size", language)
        return _SEEN.sub(lambda found: word("symbol seen", language).format(found[1]), text)

    return written


# -- terms, and what somebody may take in their place ------------------------------------------------------------------


Part = Literal["", "t", "n"]
"""All of a force, or its part that moments give (t) or its part along the bar or guide (n)."""


@dataclass(frozen=True)
class Term:
    """A term of a vector equation: is its size known, is its direction known, and as what.

    ``size`` is the rule that gives the size (None where it was drawn before or is unknown); of a force it may be a
    ``part``, and be ``turned`` where it is the opposite of its symbol's.
    """

    symbol: Symbol
    size_known: bool
    direction_known: bool
    size: Size | None = None
    direction: Direction | None = None
    part: Part = ""
    turned: bool = False


@dataclass(frozen=True)
class Component:
    """One term of a relative motion in an equation: its vector on paper (mm) if known, else only its direction."""

    symbol: Symbol
    role: Role
    along: complex
    span: complex | None
    written: Direction
    size: Size | None = None


def _same_term(part: Component) -> Component:
    return part


def _same_vector(_: Symbol, tail: complex, tip: complex) -> complex:
    return tip


def _same_line(_: Symbol, along: complex) -> complex:
    return along


def _same_rate(_: Symbol, value: float) -> float | None:
    return None


@dataclass(frozen=True)
class Slip:
    """Four places where a value may be another than the drawn one.

    ``term`` gets each term of an equation before it is laid off; ``found`` each vector found (end points by image
    included) by tail and tip, mm on paper, and returns its tip; ``rate`` each angular rate measured (rad/s, rad/s2),
    and returns None where it stays; ``line`` the direction of each line along which a vector of unknown size is drawn.
    """

    term: Callable[[Component], Component] = _same_term
    found: Callable[[Symbol, complex, complex], complex] = _same_vector
    rate: Callable[[Symbol, float], float | None] = _same_rate
    line: Callable[[Symbol, complex], complex] = _same_line


NO_SLIP = Slip()
