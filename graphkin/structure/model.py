"""What analysis finds in a scene: pairs, mobility, and the elements in the order of solution.

A pin in a slot is treated as a block without mass between pin and slot (replacement of the higher pair by a lower
one, 高副低代); such a block is a link named ``B/3`` like its pair, and is not counted in the mobility.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, ClassVar, Literal

from graphkin.plane import added_up
from graphkin.scene.cams import LawCam
from graphkin.scene.model import Driver, Mechanism, PlacedGuide, PlacedLink

__all__ = [
    "Body",
    "Cluster",
    "Driven",
    "DrivenTriangle",
    "Dyad",
    "DyadKind",
    "Element",
    "Mobility",
    "Pair",
    "Rolled",
    "RollingRelation",
    "Structure",
    "Weld",
    "driver_pair",
    "links_of",
    "outside_of",
]


NO_GUIDE = PlacedGuide("", 0j, 0j)
"""Where a pair has no direction in which it slides: it turns."""


@dataclass(frozen=True)
class Pair:
    """A lower pair of the links ``a`` and ``b``: both turn about a point, or ``a`` slides by its origin on ``b``.

    Parameters
    ----------
    key : the point of a turning pair; SLIDING/GUIDING of a sliding one, POINT/GUIDING of a pin in a slot
    guide : of link b, along which a slides
    turn : unit complex number from the guide's sense to a's own x axis
    pin : a's first point, if it has one
    slot : whether the block ``a`` only stands for a pin in a slot
    """

    key: str
    a: str
    b: str
    guide: PlacedGuide = NO_GUIDE
    turn: complex = 1 + 0j
    pin: str | None = None
    slot: bool = False

    @property
    def turns(self) -> bool:
        """Whether it is a turning pair, not a sliding one."""
        return not self.guide.direction

    @property
    def links(self) -> tuple[str, str]:
        """Both links."""
        return self.a, self.b

    @property
    def point(self) -> str:
        """The point about which both links turn, "" of a sliding pair."""
        return self.key if self.turns else ""

    @property
    def letter(self) -> str:
        """R for turning (revolute), P for sliding (prismatic)."""
        return "R" if self.turns else "P"

    def other(self, link: str) -> str:
        """The link that it joins to one of its links."""
        return self.b if link == self.a else self.a


@dataclass(frozen=True)
class Weld:
    """Link ``b`` held to link ``a`` of the same body by a driver at their common pair.

    For an angle driver ``sign`` is +1 where the driver turns ``b`` from ``a``, -1 where it turns ``a`` from ``b``.
    """

    pair: Pair
    driver: Driver
    a: str
    b: str
    sign: int = 1


@dataclass(frozen=True)
class Body:
    """Links that move as one but for the given motion of the drivers between them; ``links[0]`` is the base.

    ``welds`` are in an order in which each ``a`` is the base or a ``b`` of an earlier one.
    """

    links: tuple[str, ...]
    welds: tuple[Weld, ...] = ()


Coordinate = tuple[str, str]
"""("angle", link) or ("travel", sliding pair)."""


@dataclass(frozen=True)
class RollingRelation:
    """A sum of coordinates with factors that keeps its value; ``links`` are all that it is between."""

    name: str
    terms: Mapping[Coordinate, Fraction] = field(hash=False)
    links: tuple[str, ...]

    @property
    def in_lengths(self) -> bool:
        """Whether it holds a travel, and so its factors of angles are lengths (m)."""
        return any(kind == "travel" for kind, _ in self.terms)

    def weights(self, size: float) -> Mapping[Coordinate, float]:
        """The factors so that the sum has no unit, lengths counted in a ``size`` (m)."""
        whole = size if self.in_lengths else max(abs(float(f)) for f in self.terms.values())
        return {coordinate: float(factor) / whole for coordinate, factor in self.terms.items()}


@dataclass(frozen=True)
class Rolled:
    """What moves a link that rolls on others whose motion is known: its angle or travel follows from theirs.

    ``start`` is its value (rad, m) in the scene's own position, from which it goes by ``factors`` as these coordinates
    go; ``links`` are all that take part.
    """

    name: str
    coordinate: Coordinate
    start: float
    factors: tuple[tuple[Coordinate, float], ...]
    links: tuple[str, ...]
    rolls: ClassVar[bool] = True
    given: ClassVar[bool] = False
    through: ClassVar[tuple[str, ...]] = ()

    @property
    def key(self) -> str:
        return self.coordinate[1]

    @property
    def turns(self) -> bool:
        """Whether it is an angle."""
        return self.coordinate[0] == "angle"


@dataclass(frozen=True)
class Driven:
    """A link that a driver, or a cam by its law, moves from links already known: crank, driven slider, follower.

    ``pair`` joins it (``a``) to a known link (``b``); for a slide driver it is the slide itself, in which the
    driven link may be the sliding or the guiding one.
    """

    link: str
    pair: Pair
    driver: Driver | LawCam | Rolled


DyadKind = Literal["RRR", "RRP", "RPR", "PRP", "RPP"]
"""Turning (R) and sliding (P) pairs: outer, inner, outer."""


@dataclass(frozen=True)
class Dyad:
    """An Assur group of class II: two bodies, one pair between them, one pair from each to known links.

    ``kind`` is RRR, RRP, RPR, PRP or RPP (outer pair of ``first``, inner, outer pair of ``second``).  The mirror
    images PRR and PPR are turned so that ``first`` is the body with two turning pairs (RRP) or with the outer turning
    pair (RPP).  In RRR and PRP ``first`` is the body whose outer pair is on the link written first; in RPR ``first`` is
    the sliding one.  In ``outer_first`` and ``outer_second`` a turning pair has ``a`` in the body and ``b`` known; a
    slide has its own direction (see ``Pair``), either side may be the known one.
    ``links`` are the real links of the group in the order of the file.
    """

    kind: DyadKind
    first: Body
    second: Body
    inner: Pair
    outer_first: Pair
    outer_second: Pair
    links: tuple[str, ...]

    @property
    def bodies(self) -> tuple[Body, Body]:
        return self.first, self.second

    @property
    def outer(self) -> tuple[Pair, Pair]:
        """The outer pairs of both bodies."""
        return self.outer_first, self.outer_second

    @property
    def pairs(self) -> tuple[Pair, Pair, Pair]:
        """The outer pair of the first body, the inner one, the outer pair of the second."""
        return self.outer_first, self.inner, self.outer_second

    @property
    def is_two_lines(self) -> bool:
        """Whether it is found by two straight lines that cross (PRP, RPP), and so in one way only."""
        return self.kind in ("PRP", "RPP")

    @property
    def is_slider_on_bar(self) -> bool:
        """Whether one body slides on the other, and both turn about known points (RPR)."""
        return self.kind == "RPR"


@dataclass(frozen=True)
class DrivenTriangle:
    """Two links of a group that a pair joins, and a driven slide hung on both.

    With ``held`` at rest the other three ``links`` (the other of the two, then the slide's) are a dyad, whatever the
    group does; what it gives at ``pair`` is what the driver ``equivalent`` there would give.
    """

    held: str
    links: tuple[str, str, str]
    pair: Pair
    driver: Driver
    equivalent: Driver


@dataclass(frozen=True)
class Cluster:
    """A larger group (class III and higher, with a driver that joins no common pair, or with links that roll and move
    each other): solved as a whole.

    ``members`` are all its links, blocks of pins included; ``pairs`` all pairs that hold them (each with at least one
    side among the members); ``drivers`` those inside the group; ``rolling`` the relations of what rolls in it, and
    ``starts`` as many drivers that tell where it stands at the scene's own position.  With ``triangles`` it is drawn
    like dyads: ``parts`` are the elements that it falls into where each triangle's stand-in takes the place of its
    driver.
    """

    members: tuple[str, ...]
    pairs: tuple[Pair, ...]
    drivers: tuple[Driver, ...]
    links: tuple[str, ...]
    order: int
    triangles: tuple[DrivenTriangle, ...] = ()
    parts: tuple[Driven | Dyad, ...] = ()
    rolling: tuple[RollingRelation, ...] = ()
    starts: tuple[Driver, ...] = ()

    @property
    def kind(self) -> str:
        return "group of " + ", ".join(self.links)


Element = Driven | Dyad | Cluster


def links_of(element: Element) -> tuple[str, ...]:
    """The links that an element places."""
    if isinstance(element, Driven):
        return (element.link,)
    if isinstance(element, Cluster):
        return element.members
    return tuple(n for body in element.bodies for n in body.links)


def outside_of(element: Element) -> set[str]:
    """The links that an element hangs on."""
    if isinstance(element, Driven):
        driver = element.driver
        return {element.pair.a, element.pair.b, *driver.links, *driver.through} - {element.link}
    if isinstance(element, Cluster):
        names = {n for pair in element.pairs for n in (pair.a, pair.b)}
        names |= {n for driver in element.drivers for n in (*driver.links, *driver.through)}
        names |= {n for relation in element.rolling for n in relation.links}
    else:
        names = {n for pair in element.outer for n in (pair.a, pair.b)}
        names |= {n for body in element.bodies for weld in body.welds for n in weld.driver.through}
    return names.difference(links_of(element))


@dataclass(frozen=True)
class Mobility:
    """F = 3 n - 2 p_L - p_H (Chebyshev-Gruebler-Kutzbach in the plane; compound hinges count k - 1)."""

    links: int
    lower: int
    higher: int

    @property
    def value(self) -> int:
        return 3 * self.links - 2 * self.lower - self.higher


@dataclass(frozen=True)
class Structure:
    """The mechanism in the order of solution.

    ``links`` holds every link that takes part, the frame and the blocks of pins included, redundant links left out;
    ``hinges`` maps each point shared by links to those links.  ``followers`` are what rolling makes follow the drivers.
    """

    scene: Mechanism
    links: Mapping[str, PlacedLink]
    slides: tuple[Pair, ...]
    hinges: Mapping[str, tuple[str, ...]]
    mobility: Mobility
    elements: tuple[Element, ...]
    followers: tuple[Driver, ...] = ()

    @property
    def drivers(self) -> tuple[Driver, ...]:
        """The drivers of the scene, then what follows them by rolling."""
        return (*self.scene.drivers, *self.followers)

    @property
    def rolls(self) -> bool:
        """Whether something rolls, so that the motion need not close with a turn of the driver."""
        driven = (e.driver for e in self.elements if isinstance(e, Driven))
        coupled = any(isinstance(e, Cluster) and e.rolling for e in self.elements)
        return bool(self.followers) or coupled or any(isinstance(driver, Rolled) for driver in driven)

    def followed(self, values: Mapping[str, float]) -> dict[str, float]:
        """Driver values by key (rad, m), with those of what follows them."""
        if not self.followers:
            return dict(values)
        own = self.scene.drivers
        moved = [values.get(d.key, d.values[0]) - d.values[0] for d in own]
        return {**values, **{
            f.key: f.values[0] + added_up(r * way for r, way in zip(f.ratios, moved, strict=True))
            for f in self.followers
        }}  # fmt: skip

    @property
    def groups(self) -> tuple[Dyad | Cluster, ...]:
        """The Assur groups, in the order of solution."""
        return tuple(e for e in self.elements if not isinstance(e, Driven))

    @cached_property
    def kept(self) -> dict[Hashable, Any]:
        """What is made of the structure once and serves again, by what it is: layouts of groups, programs, the range of
        its driver that was followed last.  It is neither compared nor pickled."""
        return {}

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "kept"}

    @cached_property
    def place_of(self) -> Mapping[str, int]:
        """The place among the elements of the one that places each link."""
        return {name: i for i, element in enumerate(self.elements) for name in links_of(element)}

    @cached_property
    def hangs_on(self) -> tuple[frozenset[str], ...]:
        """The links that each element hangs on; what stands for a contact is there only with both links of it."""
        found = [outside_of(element) for element in self.elements]
        for contact in self.scene.contacts:
            if (place := self.place_of.get(contact.block)) is not None:
                found[place] |= {*contact.links}
        return tuple(map(frozenset, found))

    @cached_property
    def found_by_groups(self) -> frozenset[str]:
        """The links that are not moved by drivers and cams alone: those of groups, and what hangs on them."""
        found = {name for element in self.groups for name in links_of(element)}
        before = -1
        while len(found) > before:  # what rolls may follow through links that come later
            before = len(found)
            found.update(n for e, on in zip(self.elements, self.hangs_on, strict=True)
                         if not on.isdisjoint(found) for n in links_of(e))  # fmt: skip
        return frozenset(found)

    def slide(self, key: str) -> Pair:
        """The sliding pair or pin in slot of that name."""
        return next(s for s in self.slides if s.key == key)


def driver_pair(driver: Driver, links: Mapping[str, PlacedLink], slides: tuple[Pair, ...]) -> Pair | None:
    """The pair at which a driver acts; None for an angle between links that no turning pair joins."""
    if driver.slide:
        return next(s for s in slides if s.key == driver.slide)
    common = [p for p in links[driver.link].points if p in links[driver.relative_to].points]
    return Pair(common[0], driver.link, driver.relative_to) if common else None
