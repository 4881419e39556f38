"""The steps of forces: actions on links, moments in balance, force polygons with the letters of their corners; groups
and levers with their steps.

Places are complex numbers in mm on the drawn mechanism, the vectors of polygons in mm at the scale of their group;
sizes are in N and N m, counter-clockwise positive.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Literal

from graphkin.construction.board.steps import (
    NO_DIRECTION,
    NO_SYMBOL,
    Direction,
    Part,
    Reason,
    Step,
    Term,
    Vector,
    changed,
)
from graphkin.plane import cross, dot, unit
from graphkin.scene.model import LinkMass
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, about, listed

Way = Literal["polygon", "driver", "drawn system"]
"""How the forces of a group are found: by moments and one polygon, at last at a driver, by one drawn system."""


BY_MOMENTS: Collection[Reason] = ("along guide", "two-force member", "about pin", "about guide", "about driver")
"""Reasons of steps that find a part of a force before its polygon is drawn."""
COUPLES: Collection[Reason] = ("couple", "no couple", "balance")
"""Reasons of steps that find the couple of a sliding pair, or a balancing moment."""
CLOSED: Collection[Reason] = ("closed", "closed by lines")
"""Reasons of steps that close the polygon of a group: by one force, or by the lines of two."""
ZERO = 1e-8
"""mm: a shorter force is nothing but rounding."""
APART = 0.3
"""mm: corners of a polygon that are nearer bear one letter."""


@dataclass(frozen=True)
class ForceVector(Vector):
    """A force, or a couple, that acts on a link; in a polygon it stands from ``tail`` to ``tip``.

    Parameters
    ----------
    part : of the force that its symbol names
    link, at : the link on which it acts, and its place on the mechanism (mm)
    off : the other link, on which its opposite acts, of a pair's force or a balancing load
    force, moment : of a force the vector (N; a unit vector if only the direction is known), of a couple the moment (N
        m)
    turned : whether it is the opposite of its symbol
    by : its source: given, by moments before its polygon is drawn, or by closing a polygon
    direction : as written, if it was found by its direction
    ends : the letters of the corners of the polygon between which it stands
    """

    tail: complex = 0j
    tip: complex = 0j
    link: str = ""
    force: complex = 0j
    at: complex = 0j
    moment: float = 0.0
    turned: bool = False
    part: Part = ""
    by: Literal["given", "moments", "closing"] = "given"
    direction: Direction | None = None
    ends: tuple[str, str] = ("", "")
    off: str = ""

    @property
    def known(self) -> bool:
        """Whether it was known before the group."""
        return self.by == "given"

    @property
    def term(self) -> Term:
        """Its term in the vector equation of its polygon."""
        sized, direction = self.by != "closing", self.direction or NO_DIRECTION
        return Term(self.symbol, sized, sized or self.direction is not None, None, direction, self.part, self.turned)

    @property
    def back(self) -> ForceVector:
        """Its opposite, on the other link."""
        turned = self.turned if self.symbol.other else not self.turned
        return changed(self, symbol=self.symbol.opposite, link=self.off, off=self.link, force=-self.force,
                       moment=-self.moment, turned=turned)

    def on(self, link: str) -> ForceVector:
        """The vector as it acts on one of its two links."""
        return self if link == self.link else self.back


@dataclass(frozen=True)
class ForceStep(Step):
    """A step by which forces are found.

    Parameters
    ----------
    link, links : on which an inertia force or a spring acts, or whose polygon closes; all that are cut free, or whose
        moments are in balance
    acting : what acts on links cut free from outside; the forces of a spring on both its links
    finds : the forces or couples that it finds
    part : of the force ``symbol`` that it finds
    length : of a spring as it was read (m)
    """

    acting: tuple[ForceVector, ...] = ()
    finds: tuple[Symbol, ...] = ()
    part: Part = ""
    length: float = 0.0

    @property
    def sentence(self) -> str:
        """The key of its sentence in the table of words."""
        if self.reason == "spring":
            pull_on, opposite = self.acting
            return super().sentence + " pushes" * (dot(pull_on.force, opposite.at - pull_on.at) < 0.0)
        return super().sentence + " bare" * (self.reason == "cut free" and not self.acting)

    @property
    def forces(self) -> tuple[ForceVector, ...]:
        """The forces that it lays off, or by which it closes a polygon."""
        return self.each(ForceVector)


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


@dataclass(frozen=True, kw_only=True)
class Inertia(ForceStep):
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

    @property
    def sentence(self) -> str:
        """The key of its sentence in the table of words."""
        return super().sentence + " alone" * (not self.mass.inertia)


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


@dataclass(frozen=True, kw_only=True)
class MomentStep(ForceStep):
    """The moments of all actions on some links about a point are in balance, which gives part of a force, or a couple.

    Parameters
    ----------
    about : the letter of the point, or the name of the link at whose origin it lies
    terms : the moments of the known actions
    unknown, value : a force or a couple of size 1, and its size (N, N m)
    shifted, shift : of a couple, the force of the pair whose line of action it shifts, and by how much (m)
    """

    about: str
    terms: tuple[MomentTerm, ...]
    unknown: MomentTerm
    value: float
    shifted: Symbol = NO_SYMBOL
    shift: float = 0.0

    @property
    def found(self) -> ForceVector:
        """The unknown with its found size."""
        sought = self.unknown.acting
        return changed(sought, force=sought.force * self.value, moment=sought.moment * self.value, by="moments")


@dataclass(frozen=True)
class ForceGroup:
    """A group cut free, and its forces found.

    Parameters
    ----------
    links, kind, way : of the group, and the construction of its forces
    per_mm : N for one mm of its polygons
    polygon : the forces on it head to tail, closed; empty for a group drawn link by link
    inner : the polygons of parts of it that give the forces inside, by their links, of a pin alone by ``E/``
    lines : the line of action of a pair's force with its couple: a place (mm), by the symbol of the force
    read : the lengths of forces read off its polygons (mm), all parts together, of a driven pair without the driver
    steps : in their order, the first of which cuts it free
    """

    links: tuple[str, ...]
    kind: str
    way: Way = "polygon"
    per_mm: float = 1.0
    polygon: tuple[ForceVector, ...] = ()
    inner: Mapping[tuple[str, ...], tuple[ForceVector, ...]] = field(default_factory=dict)
    lines: Mapping[Symbol, complex] = field(default_factory=dict)
    read: Mapping[Symbol, float] = field(default_factory=dict)
    steps: tuple[ForceStep, ...] = ()

    def told(self, key: str, **gaps: object) -> Phrase:
        """Words about its links, or about a single link, or the blocks of a pin alone."""
        links = dict.fromkeys(link.split("/")[0] for link in self.links)
        key = about(f"{key} blocks" if "/" in self.links[0] else key, self.links)
        return Phrase(key, links=listed([*links]), **gaps)

    @property
    def polygons(self) -> list[tuple[ForceVector, ...]]:
        """The polygon of the group and those of its parts, without empty ones."""
        return [polygon for polygon in (self.polygon, *self.inner.values()) if polygon]

    def by(self, *reasons: Reason) -> tuple[ForceStep, ...]:
        """Its steps for some reasons."""
        return tuple(step for step in self.steps if step.reason in reasons)

    def moments(self, *reasons: Reason) -> tuple[MomentStep, ...]:
        """Its moments for some reasons."""
        return tuple(step for step in self.by(*reasons) if isinstance(step, MomentStep))

    @property
    def corners(self) -> Mapping[str, tuple[complex, ForceVector]]:
        """The corners of its polygon by their letters: each with its place (mm) and the force that ends there, the
        first with the force that begins there."""
        corners: dict[str, tuple[complex, ForceVector]] = {}
        laid = [vector for step in self.by("known forces", *CLOSED) for vector in step.forces]
        for vector in laid or self.polygon:
            for letter, place in zip(vector.ends, (vector.tail, vector.tip), strict=True):
                corners.setdefault(letter, (place, vector))
        return corners

    @property
    def closing(self) -> int:
        """The number of the step that closes its polygon."""
        return [step for step in self.steps if step.reason not in ("inside", *COUPLES)][-1].number

    def on_links(self, vector: ForceVector) -> int:
        """The number of the step that draws a force on the links cut free."""
        by_moments = (s for s in self.by(*BY_MOMENTS) if (s.symbol, s.part) == (vector.symbol, vector.part))
        # of a two-force member moments give the line alone
        finds = (s.number for s in by_moments if s.reason != "two-force member")
        return self.steps[0].number if vector.known else next(finds, self.closing)

    def in_polygon(self, vector: ForceVector, links: tuple[str, ...] = ()) -> int:
        """The number of the step that draws a force in the polygon of some of its links, or of the group."""
        drawn = (s for s in self.by("known forces", "inside") if (s.links == links if links else vector in s.strokes))
        return next((s.number for s in drawn), self.closing)


NO_GROUP = ForceGroup((), "")
"""What no group is, of steps that belong to none."""


@dataclass(frozen=True, eq=False, repr=False)
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
    by_polygons : the same load by the polygons, of a force its size (N)
    steps : its steps
    """

    per_mm: float
    virtual: bool
    ends: Mapping[PointRef, complex]
    rows: tuple[MomentTerm, ...]
    unknown: MomentTerm
    value: float
    by_polygons: float
    steps: tuple[ForceStep, ...] = ()


@dataclass(frozen=True, eq=False, repr=False)
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
