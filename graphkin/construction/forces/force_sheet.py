"""Forces on a sheet: forces and couples on links, moment equations, force polygons, and their results.

Places are complex numbers in mm on the drawn mechanism, the vectors of polygons in mm at the scale of their group;
sizes are in N and N m, counter-clockwise positive.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from graphkin.construction.board.steps import NO_DIRECTION, Direction, Part, Term
from graphkin.plane import cross, unit
from graphkin.scene.model import LinkMass
from graphkin.scene.symbol import Symbol

Way = Literal["polygon", "driver", "drawn system"]
"""How the forces of a group are found: by moments and one polygon, at last at a driver, by one drawn system."""


@dataclass(frozen=True)
class ForceVector:
    """A force, or a couple, that acts on a link; in a polygon it stands from ``tail`` to ``tip``.

    Parameters
    ----------
    symbol, part : its symbol, and its part
    link, at : the link on which it acts, and its place on the mechanism (mm)
    off : the other link, on which its opposite acts, of a pair's force or a balancing load
    force, moment : of a force the vector (N; a unit vector if only the direction is known), of a couple the moment (N
        m)
    turned : whether it is the opposite of its symbol
    by : its source: given, by moments before its polygon is drawn, or by closing a polygon
    direction : as written, if it was found by its direction
    tail, tip : in a polygon (mm)
    """

    symbol: Symbol
    link: str
    force: complex = 0j
    at: complex = 0j
    moment: float = 0.0
    turned: bool = False
    part: Part = ""
    by: Literal["given", "moments", "closing"] = "given"
    direction: Direction | None = None
    tail: complex = 0j
    tip: complex = 0j
    off: str = ""

    @property
    def known(self) -> bool:
        """Whether it was known before the group."""
        return self.by == "given"

    @property
    def span(self) -> complex:
        """The force as it is drawn (mm), from tail to tip."""
        return self.tip - self.tail

    @property
    def term(self) -> Term:
        """Its term in the vector equation of its polygon."""
        sized, direction = self.by != "closing", self.direction or NO_DIRECTION
        return Term(self.symbol, sized, sized or self.direction is not None, None, direction, self.part, self.turned)

    def between(self, tail: complex, tip: complex) -> ForceVector:
        """The vector at its place in a polygon (mm)."""
        return replace(self, tail=tail, tip=tip)

    @property
    def back(self) -> ForceVector:
        """Its opposite, on the other link."""
        turned = self.turned if self.symbol.other else not self.turned
        return replace(self, symbol=self.symbol.opposite, link=self.off, off=self.link, force=-self.force,
                       moment=-self.moment, turned=turned)  # fmt: skip

    def on(self, link: str) -> ForceVector:
        """The vector as it acts on one of its two links."""
        return self if link == self.link else self.back


def shifted_line(force: complex, at: complex, couple: float, mm: float) -> tuple[complex, float]:
    """The line of action of a force together with a couple.

    Parameters
    ----------
    force, at : the force (N) at its place on paper (mm)
    couple : N m
    mm : mm of paper for one m

    Returns
    -------
    a place of the line (mm), and its shift (m, counter-clockwise positive: the couple's sense)
    """
    shift = couple / abs(force)
    return at - 1j * unit(force) * (shift * mm), shift


@dataclass(frozen=True)
class Inertia:
    """Inertia force and couple of a link, from its drawn acceleration.

    Parameters
    ----------
    centre, push : the centre of mass (mm), and its acceleration as it was read (m/s2)
    force, moment : -m a_S (N), -J alpha (N m)
    shifted, h : a place (mm) of the line on which the force alone is force and couple together, and its distance
        M / F from the centre (m); None where there is no force
    """

    mass: LinkMass
    centre: complex
    push: complex
    force: complex
    moment: float
    shifted: complex | None = None
    h: float | None = None


@dataclass(frozen=True)
class MomentTerm:
    """The moment of an action on a link: of a force about a place, or of a couple.

    Parameters
    ----------
    acting : the force at its place (mm on the mechanism; on a lever m/s from its pole), or the couple
    arm : the distance of its line, as measured (mm, m/s; positive where the force turns counter-clockwise); None for a
        couple
    moment : its value (N m, W)
    about : the place of the moments (mm, m/s)
    pair : on a lever a couple is a pair of forces at these two end points of an image (m/s): its arm is their distance,
        its force the couple over the length of the bar
    """

    acting: ForceVector
    arm: float | None
    moment: float
    about: complex = 0j
    pair: tuple[complex, complex] | None = None

    @property
    def symbol(self) -> Symbol:
        """The symbol of the force or couple whose moment it is."""
        return self.acting.symbol

    @property
    def size(self) -> float:
        """The size of the force, or the couple with its sense (N, N m)."""
        return self.moment if self.arm is None else abs(self.acting.force)

    @property
    def foot(self) -> complex:
        """The foot of the arm, on the line of the force (mm)."""
        along = unit(self.acting.force)
        return self.about - 1j * along * cross(self.acting.at - self.about, along)


@dataclass(frozen=True)
class MomentEquation:
    """The moments of all actions on some links about a point are in balance, which gives one unknown.

    Parameters
    ----------
    about : the letter of the point, or the name of the link at whose origin it lies
    terms : the moments of the known actions
    unknown, value : a force or a couple of size 1, and its size (N, N m)
    """

    links: tuple[str, ...]
    about: str
    terms: tuple[MomentTerm, ...]
    unknown: MomentTerm
    value: float

    @property
    def found(self) -> ForceVector:
        """The unknown with its found size."""
        sought = self.unknown.acting
        return replace(sought, force=sought.force * self.value, moment=sought.moment * self.value, by="moments")


@dataclass
class ForceGroup:
    """A group cut free, and its forces found; it grows while it is drawn.

    Parameters
    ----------
    links, kind, way : of the group, and the construction of its forces
    per_mm : N for one mm of its polygons
    couples_before : couples on it that are known beforehand
    moments : equations that give parts of forces
    polygon : the forces on it head to tail, closed; empty for a group drawn link by link
    inner : the polygons of single links that give the forces inside, by link
    couples : equations that give couples of sliding pairs, and balancing moments
    lines : the line of action of a pair's force with its couple: a place (mm), and the shift (m), by the symbol of the
        force
    """

    links: tuple[str, ...]
    kind: str
    way: Way = "polygon"
    per_mm: float = 1.0
    couples_before: Sequence[ForceVector] = ()
    moments: list[MomentEquation] = field(default_factory=list)
    polygon: list[ForceVector] = field(default_factory=list)
    inner: dict[str, list[ForceVector]] = field(default_factory=dict)
    couples: list[MomentEquation] = field(default_factory=list)
    lines: dict[Symbol, tuple[complex, float]] = field(default_factory=dict)

    @property
    def polygons(self) -> list[list[ForceVector]]:
        """The polygon of the group and those of single links, without empty ones."""
        return [polygon for polygon in (self.polygon, *self.inner.values()) if polygon]


@dataclass(frozen=True)
class Lever:
    """Zhukovsky's lever of one driver: the velocity polygon turned by 90 degrees clockwise about its pole, so that the
    moment of a force about the pole is its power.

    Parameters
    ----------
    per_mm : m/s for one mm of the polygon
    virtual : whether the mechanism rests, or has several drivers, and the polygon belongs to a unit rate
    ends : the end points (m/s)
    rows : the moments of the known forces (W), with arms in m/s
    unknown, value : the moment of a balancing load of size 1, and that load (N m, or N along its line)
    """

    per_mm: float
    virtual: bool
    ends: Mapping[str, complex]
    rows: tuple[MomentTerm, ...]
    unknown: MomentTerm
    value: float


@dataclass(frozen=True)
class ForceState:
    """All forces of the mechanism, with or without the loads that begin or end exactly at the position.

    Parameters
    ----------
    known : the forces and couples that act from outside, inertia included
    groups : in the order of construction
    vectors, moments : drawn forces (N) and couples (N m) by symbol
    per_mm : N for one mm of the polygon in which a force was found, or laid off first, by symbol
    levers : one for each driver whose balance does work
    """

    known: tuple[ForceVector, ...]
    groups: tuple[ForceGroup, ...]
    vectors: Mapping[Symbol, complex]
    moments: Mapping[Symbol, float]
    per_mm: Mapping[Symbol, float]
    levers: tuple[Lever, ...] = ()
