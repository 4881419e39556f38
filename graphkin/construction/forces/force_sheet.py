"""What stands on the sheet of forces: known forces, moment equations, force polygons, and what was found by them.

Places are complex numbers in mm on the drawn mechanism, force vectors in mm of their polygons at ``per_mm`` N; sizes
are in N and N m, counter-clockwise positive.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from graphkin.construction.steps import Part, Term
from graphkin.scene.symbol import Symbol

__all__ = [
    "Acting",
    "Arm",
    "ForceGroup",
    "ForceLine",
    "ForceSheet",
    "ForceState",
    "ForceVector",
    "Inertia",
    "KnownMoment",
    "Lever",
    "LeverRow",
    "MomentEquation",
    "MomentTerm",
    "Way",
]  # fmt: skip

Way = Literal["polygon", "driver", "drawn system"]
"""How the forces of a group are found: by moments and one polygon, at last at a driver, by one drawn system."""


@dataclass(frozen=True)
class Acting:
    """A known force (N) on a link at a place (mm); ``turned`` where it is the opposite of its symbol's."""

    symbol: Symbol
    link: str
    force: complex
    at: complex
    turned: bool = False


@dataclass(frozen=True)
class KnownMoment:
    """A known moment (N m) on a link; ``turned`` where it is the opposite of its symbol's."""

    symbol: Symbol
    link: str
    moment: float
    turned: bool = False


@dataclass(frozen=True)
class Inertia:
    """Inertia force and couple of a link, from its drawn acceleration.

    ``centre`` is the centre of mass (mm), ``image`` the end point of its acceleration (mm from the pole), ``push`` that
    acceleration as it was read (m/s2).  The force -m a_S and the couple -J alpha together are the force alone, shifted
    to the line through ``shifted`` (mm), at the distance ``h`` = M / F (m, counter-clockwise positive: the couple's
    sense); None where there is no force.
    """

    link: str
    mass: float
    inertia: float
    centre: complex
    image: complex
    push: complex
    alpha: float
    force: complex
    moment: float
    h: float | None = None
    shifted: complex | None = None


@dataclass(frozen=True)
class Arm:
    """The distance of a force's line from a point, measured on the drawing (mm; positive where the force turns
    counter-clockwise about it), with the foot on the line."""

    about: complex
    foot: complex
    mm: float


@dataclass(frozen=True)
class MomentTerm:
    """A term of a moment equation: a force (N) times its arm, or a couple (N m, without arm)."""

    symbol: Symbol
    part: Part
    size: float
    arm: Arm | None
    moment: float
    turned: bool = False


@dataclass(frozen=True)
class MomentEquation:
    """The moments of all that acts on some links about a point are in balance, which gives one unknown.

    ``about`` is the letter of the point, or the name of the link at whose origin it lies; ``value`` (N, or N m where
    there is no ``arm``) is that of the unknown ``symbol``, positive along its ``along``.
    """

    links: tuple[str, ...]
    about: str
    terms: tuple[MomentTerm, ...]
    symbol: Symbol
    part: Part
    arm: Arm | None
    value: float
    along: complex = 0j


@dataclass(frozen=True)
class ForceVector:
    """A force in a polygon, ``tail`` to ``tip`` (mm), that acts on ``link`` at a place of the mechanism (mm)."""

    symbol: Symbol
    part: Part
    link: str
    at: complex
    tail: complex
    tip: complex
    known: bool
    turned: bool = False

    @property
    def span(self) -> complex:
        return self.tip - self.tail


@dataclass(frozen=True)
class ForceLine:
    """The line of action of a force that is known by its direction only, or of a sliding pair's force where its couple
    puts it: ``at`` and ``along`` on the mechanism (mm)."""

    symbol: Symbol
    at: complex
    along: complex
    shifted: float = 0.0


@dataclass(frozen=True)
class ForceGroup:
    """A group cut free, and its forces found.

    ``equation`` are terms that sum to nought; ``polygon`` the same head to tail, closed; ``inner`` the polygons of
    single links that give the forces inside, by link; ``points`` are letters of the special points used.
    """

    links: tuple[str, ...]
    kind: str
    way: Way
    moments: tuple[MomentEquation, ...] = ()
    equation: tuple[Term, ...] = ()
    polygon: tuple[ForceVector, ...] = ()
    inner: Mapping[str, tuple[ForceVector, ...]] = field(default_factory=dict)
    couples: tuple[MomentEquation, ...] = ()
    lines: tuple[ForceLine, ...] = ()


@dataclass(frozen=True)
class ForceState:
    """All forces of the mechanism, with or without the loads that begin or end exactly at the position.

    ``vectors`` are drawn forces by symbol (mm of polygon), ``moments`` by symbol (N m); ``known`` and ``turning`` are
    what acts from outside, inertia included.
    """

    known: tuple[Acting, ...]
    turning: tuple[KnownMoment, ...]
    groups: tuple[ForceGroup, ...]
    vectors: Mapping[Symbol, complex]
    moments: Mapping[Symbol, float]


@dataclass(frozen=True)
class LeverRow:
    """A force on the lever at the end point of its point's velocity (mm from the pole, turned), with its arm about the
    pole (mm, signed) and its moment there (N mm).

    A couple is a ``pair`` of forces at two end points of an image; its arm is their distance, its size force is the
    couple over the length of the bar.
    """

    symbol: Symbol
    force: complex
    at: complex
    arm: float
    moment: float
    pair: tuple[complex, complex] | None = None
    turned: bool = False


@dataclass(frozen=True)
class Lever:
    """Zhukovsky's lever of one driver: the velocity polygon turned by 90 degrees clockwise about its pole, so that the
    moment of a force about the pole is its power.

    ``per_mm`` is m/s for one mm; ``virtual`` where the mechanism rests (or has several drivers) and the polygon is that
    of a unit rate.  ``balance`` is the symbol of what balances, ``value`` (N m, or N along its line) what the moments
    give for it.
    """

    per_mm: float
    virtual: bool
    ends: Mapping[str, complex]
    rows: tuple[LeverRow, ...]
    balance: Symbol
    unknown: LeverRow
    value: float
    vector: complex = 0j


@dataclass(frozen=True)
class ForceSheet:
    """Everything drawn of forces at a position: once, or twice where a load begins or ends exactly there."""

    per_mm: float
    inertias: Mapping[str, Inertia]
    states: tuple[ForceState, ...]
    levers: tuple[tuple[Lever, ...], ...] = ()

    @property
    def ways(self) -> tuple[Way, ...]:
        """How its groups were found, each way once."""
        return tuple(dict.fromkeys(group.way for group in self.states[0].groups))
