"""The structure of a scene: pairs, mobility, and the elements in the order of solution.

A pin in a slot is treated as a block without mass between pin and slot (replacement of the higher pair by a lower
one, 高副低代); such a block is a link named ``B/3`` like its pair, and is not counted in the mobility.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, wraps
from typing import Any, ClassVar, Concatenate, Literal, ParamSpec, TypeAlias, TypeVar

from graphkin.errors import CallError, did_you_mean
from graphkin.plane import added_up
from graphkin.scene.model import Driver, Mechanism, PlacedLink
from graphkin.scene.pairs import HigherPair, LawCam, Pair
from graphkin.scene.symbol import Symbol, centre_links
from graphkin.scene.tables import derived
from graphkin.words import Phrase, bodies_named, joined, links_named, listed


@dataclass(frozen=True)
class DrivenJoint:
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
    """Links that move as one except for the given motion of the drivers between them; ``links[0]`` is the base.

    ``joints`` are in an order in which each ``a`` is the base or a ``b`` of an earlier one.
    """

    links: tuple[str, ...]
    joints: tuple[DrivenJoint, ...] = ()


Coordinate = tuple[str, str]
"""("angle", link) or ("travel", sliding pair)."""


def _named(group: Element) -> Phrase:
    """The members of a group in words: its links of the file, and what stands in it for pins in slots and for contacts:
    ``links 2, 3``, ``link 2 and the block at B``, ``the blocks at P``."""
    blocks = [name for name in group.members if "/" in name]
    parts = [links_named(group.links)] if group.links else []
    if blocks:
        parts.append(bodies_named(blocks))
    bars = (name for name in group.members if name not in group.links and "/" not in name)
    named: Phrase = joined("one and other", (*parts, *(Phrase("bar of name", bar=bar) for bar in bars)))
    return named


@dataclass(frozen=True)
class RollingRelation:
    """A sum of coordinates with factors that keeps its value; ``links`` are the links that it ties.

    Where it moves a link that rolls on links of known motion it is solved for that link's ``coordinate``: from its
    value ``start`` (rad, m) in the scene's own position that changes by ``factors`` times the changes of the others.
    """

    name: str
    terms: Mapping[Coordinate, Fraction] = field(hash=False)
    links: tuple[str, ...]
    coordinate: Coordinate = ("", "")
    start: float = 0.0
    # asked of whatever moves a link
    rolls: ClassVar[bool] = True
    given: ClassVar[bool] = False
    through: ClassVar[tuple[str, ...]] = ()

    @property
    def turns(self) -> bool:
        """Whether it is solved for an angle."""
        return self.coordinate[0] == "angle"

    @property
    def key(self) -> str:
        """The link that it turns, or the sliding pair."""
        return self.coordinate[1]

    @cached_property
    def factors(self) -> tuple[tuple[Coordinate, float], ...]:
        """The other coordinates, with what a change of each moves the one for which it is solved."""
        factor = self.terms[self.coordinate]
        return tuple((c, float(-f / factor)) for c, f in self.terms.items() if c != self.coordinate)

    @property
    def in_lengths(self) -> bool:
        """Whether it holds a travel, and so its factors of angles are lengths (m)."""
        return any(kind == "travel" for kind, _ in self.terms)

    def weights(self, size: float) -> Mapping[Coordinate, float]:
        """The factors so that the sum has no unit, lengths counted in a ``size`` (m)."""
        whole = size if self.in_lengths else max(abs(float(f)) for f in self.terms.values())
        return {coordinate: float(factor) / whole for coordinate, factor in self.terms.items()}


Mover: TypeAlias = Driver | LawCam | RollingRelation
"""What moves a link from known links: a driver, a cam by its law, or rolling."""

TurnedBy: TypeAlias = tuple[tuple[Driver | Pair, bool], ...]
"""What gives a link's direction from the frame on: drivers and sliding pairs, each with whether it turns its first link
from its second."""


@dataclass(frozen=True)
class Driven:
    """A link that a driver, or a cam by its law, moves from known links: crank, driven slider, follower.

    ``pair`` joins it (``a``) to a known link (``b``); for a slide driver it is the slide itself, in which the
    driven link may be the sliding or the guiding one.  It has the properties of groups: ``links`` and ``members`` hold
    this link alone; ``drivers`` has the driver unless it is ``lifted`` by a cam or ``rolled``; ``outside`` are the
    known links of its pair, ``named`` its words; it is ``explicit``, given by formulas of the drivers alone, unless it
    follows a cam, whose law has pieces, or rolls.

    Where the link from which it is turned is placed later, ``ahead`` gives that link's direction.
    """

    link: str
    pair: Pair
    driver: Mover
    ahead: TurnedBy = ()
    order: ClassVar[int] = 1
    joints: ClassVar[tuple[DrivenJoint, ...]] = ()
    starts: ClassVar[tuple[Driver, ...]] = ()
    rolling: ClassVar[tuple[RollingRelation, ...]] = ()

    links: tuple[str] = derived()
    members: tuple[str] = derived()
    pairs: tuple[Pair] = derived()
    all_pairs: tuple[Pair, ...] = derived()
    drivers: tuple[Driver, ...] = derived()
    rolled: RollingRelation | None = derived()
    lifted: LawCam | None = derived()
    explicit: bool = derived()
    outside: frozenset[str] = derived()
    named = cached_property(_named)

    def __post_init__(self) -> None:
        driver = self.driver
        self.__dict__.update(
            links=(self.link,), members=(self.link,), pairs=(self.pair,), all_pairs=(self.pair,),
            drivers=(driver,) if isinstance(driver, Driver) else (),
            rolled=driver if isinstance(driver, RollingRelation) else None,
            lifted=driver if isinstance(driver, LawCam) else None, explicit=driver.given,
            outside=frozenset((*self.pair.links, *driver.links, *driver.through)).union(
                *(step.links for step, _ in self.ahead)) - {self.link},
        )


DyadKind = Literal["RRR", "RRP", "RPR", "PRP", "RPP"]
"""Turning (R) and sliding (P) pairs: outer, inner, outer."""


@dataclass(frozen=True)
class Dyad:
    """An Assur group of class II: two bodies, one pair between them, one pair from each to known links.

    ``kind`` is RRR, RRP, RPR, PRP or RPP (outer pair of ``first``, inner, outer pair of ``second``).  The mirror
    images PRR and PPR are turned so that ``first`` is the body with two turning pairs (RRP) or with the outer turning
    pair (RPP).  In RRR and PRP ``first`` is the body whose outer pair is on the link written first; in RPR ``first`` is
    the sliding one.  In ``outer_first`` and ``outer_second`` a turning pair has ``a`` in the body and ``b`` known; a
    slide has its own direction (see ``Pair``), and either side may be known.
    ``links`` are the real links of the group in the order of the file.

    From these follow its ``bodies``, all ``members`` (blocks of pins included), ``pairs`` in the order of its kind,
    the ``outer`` ones, the driven ``joints`` and ``drivers`` inside its bodies, ``all_pairs`` with those of the joints,
    the known links ``outside``, its words ``named``, and whether it ``is_two_lines``: two straight lines cross in it,
    so that it has one assembly only.
    """

    kind: DyadKind
    first: Body
    second: Body
    inner: Pair
    outer_first: Pair
    outer_second: Pair
    links: tuple[str, ...]
    order: ClassVar[int] = 2
    explicit: ClassVar[bool] = True
    starts: ClassVar[tuple[Driver, ...]] = ()
    rolling: ClassVar[tuple[RollingRelation, ...]] = ()
    rolled: ClassVar[None] = None
    lifted: ClassVar[None] = None

    bodies: tuple[Body, Body] = derived()
    members: tuple[str, ...] = derived()
    pairs: tuple[Pair, Pair, Pair] = derived()
    all_pairs: tuple[Pair, ...] = derived()
    outer: tuple[Pair, Pair] = derived()
    joints: tuple[DrivenJoint, ...] = derived()
    drivers: tuple[Driver, ...] = derived()
    outside: frozenset[str] = derived()
    is_two_lines: bool = derived()
    named = cached_property(_named)

    @property
    def label(self) -> str:
        """Its links, ``2-3``; of blocks alone that stand for a pin in slots, the pin."""
        return "-".join(self.links or dict.fromkeys(name.split("/")[0] for name in self.members))

    def __post_init__(self) -> None:
        first, second, outer = self.first, self.second, (self.outer_first, self.outer_second)
        members, joints = first.links + second.links, first.joints + second.joints
        drivers, pairs = tuple(joint.driver for joint in joints), (outer[0], self.inner, outer[1])
        hung = {name for pair in outer for name in pair.links}.union(*(driver.through for driver in drivers))
        self.__dict__.update(
            bodies=(first, second), members=members, pairs=pairs, outer=outer, joints=joints, drivers=drivers,
            all_pairs=(*pairs, *(joint.pair for joint in joints)), outside=frozenset(hung.difference(members)),
            is_two_lines=self.kind in ("PRP", "RPP"),
        )


@dataclass(frozen=True)
class DrivenTriangle:
    """Two links of a group that a pair joins, and a driven slide hung on both.

    With ``held`` at rest the other three ``links`` (the second link of the pair, then the slide's) are a dyad, whatever
    the group does; it moves ``pair`` as the driver ``equivalent`` there would move it.
    """

    held: str
    links: tuple[str, str, str]
    pair: Pair
    driver: Driver
    equivalent: Driver


@dataclass(frozen=True)
class LargerGroup:
    """A larger group (class III and higher, with a driver that joins no common pair, or with links that roll and move
    each other), solved as a whole.

    ``members`` are all its links, blocks of pins included; ``pairs`` all pairs that hold them (each with at least one
    side among the members); ``drivers`` those inside the group; ``rolling`` its rolling relations, and ``starts`` as
    many drivers that give its place at the scene's own position.  With ``triangles`` it is drawn like dyads: ``parts``
    are the elements into which it falls when each triangle's equivalent driver replaces its driver.
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
    explicit: ClassVar[bool] = False  # found by Newton's method
    joints: ClassVar[tuple[DrivenJoint, ...]] = ()
    rolled: ClassVar[None] = None
    lifted: ClassVar[None] = None

    kind: str = derived()
    all_pairs: tuple[Pair, ...] = derived()
    outside: frozenset[str] = derived()
    named = cached_property(_named)

    def __post_init__(self) -> None:
        names = {name for pair in self.pairs for name in pair.links}
        names.update(name for driver in self.drivers for name in (*driver.links, *driver.through))
        names.update(name for relation in self.rolling for name in relation.links)
        self.__dict__.update(
            kind="group of " + ", ".join(self.links), outside=frozenset(names.difference(self.members)),
            all_pairs=self.pairs,
        )


Element = Driven | Dyad | LargerGroup


@dataclass(frozen=True, eq=False, repr=False)
class Mobility:
    """F = 3 n - 2 p_L - p_H (Chebyshev-Gruebler-Kutzbach in the plane; compound hinges count k - 1)."""

    links: int
    lower: int
    higher: int

    @property
    def value(self) -> int:
        return 3 * self.links - 2 * self.lower - self.higher


@dataclass(frozen=True, eq=False, repr=False)
class Structure:
    """The mechanism in the order of solution.

    ``links`` holds every link that takes part, the frame and the blocks of pins included, redundant links left out;
    ``hinges`` maps each point shared by links to those links.  ``followers`` are the drivers of links that follow the
    scene's drivers by rolling, ``relations`` the other rolling relations, ``touching`` the higher pairs, among them the
    cams ``lifting`` a follower by their law.

    From these follow the ``blocks`` that replace pins in slots and discs on faces, with the sliding pair of each; all
    ``drivers``, those of the scene first; the Assur ``groups`` in the order of solution, among them the ``dyads`` by
    their places in it and the ``larger_groups`` that are solved as a whole; the ``driven`` links, which drivers, cams
    and rolling move; ``place_of`` each link the place of the element that places it.  ``kept`` holds results that are
    made of the structure once and used again, by name: layouts of groups, programs, the last range of its driver; it is
    neither compared nor pickled.
    """

    scene: Mechanism
    links: Mapping[str, PlacedLink]
    slides: tuple[Pair, ...]
    hinges: Mapping[str, tuple[str, ...]]
    mobility: Mobility
    elements: tuple[Element, ...]
    followers: tuple[Driver, ...] = ()
    relations: tuple[RollingRelation, ...] = ()
    touching: tuple[HigherPair, ...] = ()

    blocks: Mapping[str, Pair] = derived()
    lifting: tuple[LawCam, ...] = derived()
    drivers: tuple[Driver, ...] = derived()
    groups: tuple[Dyad | LargerGroup, ...] = derived()
    driven: tuple[Driven, ...] = derived()
    dyads: Mapping[int, Dyad] = derived()
    larger_groups: tuple[LargerGroup, ...] = derived()
    place_of: Mapping[str, int] = derived()
    kept: dict[Hashable, Any] = derived()

    def __post_init__(self) -> None:
        elements = self.elements
        self.__dict__.update(
            blocks={slide.a: slide for slide in self.slides if slide.higher},
            lifting=tuple(pair for pair in self.touching if isinstance(pair, LawCam)),
            drivers=(*self.scene.drivers, *self.followers), kept={},
            groups=tuple(e for e in elements if not isinstance(e, Driven)),
            driven=tuple(e for e in elements if isinstance(e, Driven)),
            dyads={i: e for i, e in enumerate(elements) if isinstance(e, Dyad)},
            larger_groups=tuple(e for e in elements if isinstance(e, LargerGroup)),
            place_of={name: i for i, e in enumerate(elements) for name in e.members},
        )

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"kept": {}}

    @property
    def rolls(self) -> bool:
        """Whether links roll, so that the motion need not close with a turn of the driver."""
        coupled = any(element.rolling for element in self.elements)
        return bool(self.followers) or coupled or any(element.driver.rolls for element in self.driven)

    def followed(self, values: Mapping[str, float]) -> dict[str, float]:
        """Driver values by key (rad, m), with the values of their followers."""
        drivers = self.scene.drivers
        moved = [values.get(d.key, d.values[0]) - d.values[0] for d in drivers]
        followed = {f.key: f.values[0] + added_up(r * change for r, change in zip(f.ratios, moved, strict=True))
                    for f in self.followers}
        return {**values, **followed}

    @cached_property
    def led_by(self) -> tuple[frozenset[int], ...]:
        """For each element the indices of all elements that it depends on, directly or through others, and its own; the
        link that replaces a contact needs both links of it, and a rolling link may depend on later links."""
        outside = [element.outside for element in self.elements]
        for pair in self.touching:
            if (place := self.place_of.get(pair.block)) is not None:
                outside[place] |= {*pair.bodies}
        before = [[self.place_of[n] for n in names if n in self.place_of] for names in outside]
        return tuple(frozenset(reached([place], before.__getitem__)) for place in range(len(before)))

    @property
    def whole(self) -> Structure | Mechanism:
        """Its mechanism, or the mechanism with cams that this one replaces."""
        return self if self.scene.instead_of is None else self.scene.instead_of

    def turning_with(self, link: str) -> set[str]:
        """A link, and the links that turn as it does because they slide on it, or on such links."""
        return {*reached([link], lambda name: [slide.other(name) for slide in self.slides if name in slide.links])}

    def slide(self, key: str) -> Pair:
        """The sliding pair or pin in slot of that name."""
        return next(s for s in self.slides if s.key == key)


def named_with_contact(structure: Structure, group: Dyad | LargerGroup) -> Phrase:
    """The links and blocks of a group in words; of a dyad that replaces a contact, that: ``contact K of links 1, 2``.
    """
    contacts = (pair for pair in structure.touching if pair.block in group.members and not pair.carrier)
    contact = next(contacts, None) if isinstance(group, Dyad) else None
    if contact is None:
        return group.named
    return Phrase("contact of links", contact=contact.name, links=listed(contact.bodies))


N = TypeVar("N", bound=Hashable)


def reached(start: Iterable[N], onward: Callable[[N], Iterable[N]]) -> dict[N, None]:
    """All nodes that can be reached from some nodes, these included."""
    nodes = dict.fromkeys(start)
    queue = list(nodes)
    while queue:
        fresh = [node for node in dict.fromkeys(onward(queue.pop())) if node not in nodes]
        nodes.update(dict.fromkeys(fresh))
        queue += fresh
    return nodes


V = TypeVar("V")
E = TypeVar("E")


def carried(
    known: Mapping[str, V], edges: Sequence[tuple[str, str, E]], onward: Callable[[V, E, bool], V]
) -> dict[str, V]:
    """Values of some links carried along edges to all links that hang on them, in the order of the edges.

    Parameters
    ----------
    onward : function of the value at one end, the edge, and whether that end is its first, to the value at the other
    """
    values, grown = dict(known), True
    while grown:
        grown = False
        for a, b, edge in edges:
            if (a in values) != (b in values):
                here, there = (a, b) if a in values else (b, a)
                values[there] = onward(values[here], edge, here == a)
                grown = True
    return values


def driver_pair(driver: Driver, links: Mapping[str, PlacedLink], slides: tuple[Pair, ...]) -> Pair | None:
    """The pair at which a driver acts; None for an angle between links that no turning pair joins."""
    if driver.slide:
        return next(s for s in slides if s.key == driver.slide)
    common = [p for p in links[driver.link].points if p in links[driver.relative_to].points]
    return Pair(common[0], driver.link, driver.relative_to) if common else None


# the part of a mechanism that leads to what is asked, and nothing more


def needed(structure: Structure, asked: Sequence[Symbol]) -> list[Element]:
    """The elements that the asked quantities need, in the order of solution; all of them if nothing is asked.

    Raises
    ------
    CallError : a symbol that names no point of a link here
    """
    if not asked or any(symbol.scope in ("force", "cycle") for symbol in asked):  # every link may push any other
        return list(structure.elements)
    kept = {place for symbol in asked for place in leading(structure, links_for(structure, symbol))}
    return [structure.elements[place] for place in sorted(kept)]


def leading(structure: Structure, links: Iterable[str]) -> set[int]:
    """The indices of the elements that some links need."""
    places = (structure.place_of.get(name) for name in links)
    return {before for place in places if place is not None for before in structure.led_by[place]}


def by_drivers_alone(structure: Structure, symbol: Symbol) -> bool:
    """Whether a quantity of the motion depends on no group, but only on links that drivers and cams move from the
    frame: it is known where a group is lost in rounding."""
    if symbol.seen or not structure.links.keys() >= set(symbol.links()):  # of redundant links nothing is asked
        return False
    try:
        places = leading(structure, links_for(structure, symbol))
    except CallError:  # a special point of the drawing
        return False
    return all(isinstance(structure.elements[place], Driven) for place in places)


def greatest_before(
    structure: Structure, sizes: Iterable[tuple[Symbol, float]], of: Iterable[Symbol]
) -> dict[Symbol, float]:
    """For quantities of the motion the greatest of sizes: of its own links, and of the links on which they depend.

    Greater sizes later in the order of solution do not count: near a dead point of the last group the rates of the
    others are not affected.  For special points of the drawing, and vectors seen from a held link, all sizes count;
    theirs count from the first larger group on.
    """
    elements = structure.elements
    special = next((i for i, e in enumerate(elements) if isinstance(e, LargerGroup)), len(elements) - 1)

    def links(symbol: Symbol) -> frozenset[str] | None:
        try:
            return None if symbol.seen else links_for(structure, symbol)
        except CallError:
            return None

    greatest: dict[int, float] = {}  # of what each element adds
    for symbol, size in sizes:
        names = links(symbol)
        of_frame = [] if names is None else [structure.place_of[n] for n in names if n in structure.place_of]
        place = special if names is None else max(of_frame, default=-1)
        greatest[place] = max(greatest.get(place, 0.0), size)
    greatest.pop(-1, None)

    before: dict[Symbol, float] = {}
    for symbol in of:
        names = links(symbol)
        places = greatest.keys() if names is None else greatest.keys() & leading(structure, names)
        before[symbol] = max((greatest[place] for place in places), default=0.0)
    return before


def part_of(structure: Structure, asked: Sequence[Symbol]) -> Mechanism:
    """The scene with only the links, pairs and drivers that the asked quantities need; itself if nothing is asked or
    nothing is left out.

    No quantity needs a redundant link, unless it is asked for itself: then all is kept.
    """
    scene = structure.scene
    named = {name for s in asked for name in s.links()}
    if not asked or any(link.redundant and link.name in named for link in scene.links):
        return scene
    kept = {scene.frame.name, *(n for e in needed(structure, asked) for n in e.members)}
    if all(link.name in kept for link in scene.links):
        return scene
    return _part_scene(scene, kept, tuple(asked))


def _part_scene(scene: Mechanism, kept: set[str], asked: tuple[Symbol, ...]) -> Mechanism:
    """The scene with these links only."""
    part = without(scene, {link.name for link in scene.links} - kept)
    return replace(
        part,
        drivers=tuple(d for d in scene.drivers if {scene.body_of(d.link), d.relative_to} <= kept),
        question=replace(part.question, find=asked),
        instead_of=None if scene.instead_of is None else _part_scene(scene.instead_of, kept, asked),
    )


def without(scene: Mechanism, gone: Collection[str]) -> Mechanism:
    """The scene without some links, or blocks that replace higher pairs, and without their pairs; its drivers stay, and
    nothing is asked or stated."""
    lost = set(gone)
    return replace(
        scene, higher_pairs=tuple(p for p in scene.higher_pairs if lost.isdisjoint((*p.members, p.block))),
        links=tuple(link for link in scene.links if link.name not in lost),
        slides=tuple(s for s in scene.slides if lost.isdisjoint((*s.links, s.of))),
        question=replace(scene.question, find=(), stated=()),
    )


Keeper = TypeVar("Keeper")
Others = ParamSpec("Others")
Result = TypeVar("Result")


def kept_with(
    function: Callable[Concatenate[Keeper, Others], Result]
) -> Callable[Concatenate[Keeper, Others], Result]:
    """A function whose results are made once, and kept with its first argument (a structure, a motion, a range) by the
    others."""

    @wraps(function)
    def known(keeper: Keeper, /, *args: Others.args, **named: Others.kwargs) -> Result:
        kept = vars(keeper).setdefault("kept", {})
        key = function.__module__, function.__qualname__, args, *named.items()
        if key not in kept:
            kept[key] = function(keeper, *args, **named)
        result: Result = kept[key]
        return result

    return known


@kept_with
def links_for(structure: Structure, symbol: Symbol) -> frozenset[str]:
    """The links that a quantity names, and the links that hold its points.  Raises CallError where there are none."""
    if symbol.link:
        # of a pin in a slot the block that stands for it
        named = {name for name in (symbol.link, symbol.other, symbol.pair) if name in structure.links}
        return frozenset(named or {symbol.link})
    links: set[str] = set()
    for ref in (symbol.of, symbol.to):
        if ref is None:
            continue
        centre = None if ref.point in structure.scene.holders else centre_links(ref.point, structure.scene.by_name)
        if centre is not None:
            links.update(centre)
            continue
        holders = [n for n, link in structure.links.items() if ref.point in link.points]
        if not holders or (ref.link and ref.link not in structure.links):
            wanted = did_you_mean(ref.point, structure.scene.holders)
            raise CallError.of(str(symbol), "names no point of a link here", wanted, ref=ref)
        if ref.link:
            links.add(ref.link)
        if not ref.link or ref.point not in structure.links[ref.link].points:
            # the pin itself must be placed too: by the first link of the order of solution that has it
            links.add(min(holders, key=lambda n: structure.place_of.get(n, -1)))
    return frozenset(links)
