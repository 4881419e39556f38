"""A drawn position as its forces see it: joints and their forces by name, the groups in which they are found (those of
the mechanism driven where it is balanced, last group first), how any place of a link moves, off its image in the drawn
polygons (Mehmke), and what acts on the links from outside: weights, loads, springs, and inertia forces from the drawn
accelerations; which loads act at a position, which begin or end exactly there, by what is drawn.

F = -m a_S acts at the centre of mass, opposite to its acceleration, M = -J alpha against the angular acceleration; both
together are the force alone, on a line at the distance h = M / F from the centre (Sun Huan, Mechanical Principles, ch.
4).
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from graphkin.construction.board.instruments import Instrument
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import Order
from graphkin.construction.forces.steps import ForceStep, ForceVector, Inertia, shifted_line
from graphkin.construction.position.links_on_paper import travel
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import dot, unit
from graphkin.scene.model import Driver, ForceJoint, LinkMass, LoadOn, SpringOn, balance_of, hosts_at, joints
from graphkin.scene.pairs import Pair
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Element, LargerGroup, Structure, analyse
from graphkin.words import Phrase

COINCIDE = 1e-9
"""Of the mechanism's size: places nearer to each other are one, and points of a spring have no line."""


@dataclass(frozen=True, eq=False, repr=False)
class DrawnPosition:
    """The joints of a sheet by name, and the images of all its links.

    Links at one point: the first that has it (the frame, or the link written first) is paired with each later one.
    Guests are paired with their host alone: the block of a pin in a slot, or the bar in place of a circular slot, with
    the link of the pin.  A block has no name of its own: what it carries is the force between the link of the pin and
    the link of the slot.  Of a driven block that is the guide's own force alone; with the push of the driver it is the
    force of the pin on the link of the slot, ``F_B/2``, on the link of the pin ``F_2/B``.
    """

    sheet: Sheet

    @property
    def structure(self) -> Structure:
        """The links and pairs, those that stand for what touches among them."""
        return self.sheet.structure

    # forces by name

    @cached_property
    def hosts(self) -> Mapping[str, Mapping[str, str]]:
        """For each hinge its guests, each with its host."""
        hosts = dict[str, Mapping[str, str]]()
        for point, names in self.structure.hinges.items():
            slides = (slide for slide in self.structure.blocks.values() if {slide.a, slide.of} <= {*names})
            hosts[point] = {**{slide.a: slide.of for slide in slides}, **hosts_at(self.structure.scene, point, names)}
        return hosts

    @cached_property
    def holders(self) -> Mapping[str, tuple[str, ...]]:
        """The links that meet at each hinge, guests left out."""
        return {p: tuple(n for n in names if n not in self.hosts[p]) for p, names in self.structure.hinges.items()}

    @cached_property
    def pushed(self) -> Collection[str]:
        """The blocks of pins that drivers push along their slots."""
        scene, blocks = self.structure.scene, self.structure.blocks.items()
        keys = {driver.key for driver in scene.drivers} if scene.loading.balance is None else ()
        return {name for name, slide in blocks if slide.key in keys}

    def with_guests(self, point: str, link: str) -> list[str]:
        """A link at a hinge, with its guests there, and theirs."""
        guests = (guest for guest, host in self.hosts.get(point, {}).items() if host == link)
        return [link, *(name for guest in guests for name in self.with_guests(point, guest))]

    @cached_property
    def joints(self) -> tuple[ForceJoint, ...]:
        """All joints, with the names of their forces."""
        return joints(self.structure.scene)

    def between(self, first: str, second: str, point: str | None, kind: str = "F") -> Symbol:
        """The force (couple) of one link on another at a joint."""
        several = point and sum({joint.first, joint.second} == {first, second} for joint in self.joints) > 1
        return Symbol(kind, PointRef(point) if several and point else None, link=first, other=second)

    def of_pin(self, point: str, link: str, done: Collection[str]) -> Symbol:
        """The name of the force of the pin at a point on a link, without those of the link's guests that are ``done``,
        known before: the pin's own where it is the sum of several."""
        blocks = self.structure.blocks
        if link in self.pushed:
            return Symbol("F", link=point, other=blocks[link].b)
        if link in blocks:
            return self.between(blocks[link].of, blocks[link].b, point)
        hosts, (first, *later) = self.hosts[point], self.holders[point]
        paired = later if link == first else [hosts.get(link, first)]
        paired = [*paired, *(guest for guest, host in hosts.items() if host == link and guest not in done)]
        if len(paired) != 1:
            return Symbol("F", link=point, other=link)
        (other,) = paired
        return self.of_pin(point, other, done).opposite if other in blocks else self.between(other, link, point)

    def of_slide(self, slide: Pair, kind: str = "F") -> Symbol:
        """The force (couple) of the guiding link on the sliding one."""
        return self.between(slide.b, slide.body, slide.pin, kind)

    # places, and motion off the polygons

    @cached_property
    def mm(self) -> float:
        """Of paper for one m of the mechanism."""
        return 1.0 / self.sheet.scales.length

    @cached_property
    def size(self) -> float:
        """Of the mechanism on paper (mm)."""
        return self.sheet.scene.size * self.mm

    def place(self, link: str, at: complex) -> complex:
        """A place of a link on paper (mm), from that in the link's own axes (m)."""
        return self.sheet.poses[link].place(at * self.mm)

    def point(self, link: str, point: str) -> complex:
        """A point of a link, where it was pricked (mm)."""
        drawn = self.sheet.points.get(PointRef(point))
        return self.place(link, self.sheet.structure.links[link].points[point]) if drawn is None else drawn

    def foot(self, slide: Pair) -> complex:
        """The place of a sliding pair's force: the sliding link's first point, or its origin (mm)."""
        return self.point(slide.a, slide.pin) if slide.pin else self.sheet.poses[slide.a].origin

    def along(self, slide: Pair) -> complex:
        """The direction of a guide."""
        return slide.along(self.sheet.poses)

    def balance(self, driver: Driver) -> ForceVector:
        """The balancing load in place of a driver, of size 1: the scene's own, else a moment where it turns and a force
        along the guide where it slides."""
        scene = self.structure.scene
        if scene.loading.balance is not None:
            return replace(self.load(scene.loading.balance, 1.0), off=scene.frame.name)
        symbol = balance_of(scene, driver)
        if driver.turns:
            return ForceVector(symbol, link=driver.link, moment=1.0, off=driver.relative_to)
        slide = self.structure.slide(driver.key)
        return ForceVector(symbol, link=slide.a, force=self.along(slide), at=self.foot(slide), off=slide.b)

    def load(self, load: LoadOn, size: float) -> ForceVector:
        """A load of a size (N, N m), its direction from the drawn links."""
        if not load.is_force:
            return ForceVector(load.symbol, link=load.link, moment=size)
        force = size * load.turn * (self.sheet.poses[load.follows].axis if load.follows else 1.0)
        return ForceVector(load.symbol, link=load.link, force=force, at=self.place(load.link, load.at))

    def slip(self, slide: Pair) -> tuple[float, float]:
        """The sliding velocity along the guide, and the greatest speed that leads to it (m/s)."""
        at = self.foot(slide)
        a, b = self.end("velocity", slide.a, at), self.end("velocity", slide.b, at)
        most = max(abs(a), abs(b), *(abs(z) for z in self.sheet.ends["velocity"].values()))
        return dot(a - b, self.along(slide)) * self.sheet.scales.velocity, most * self.sheet.scales.velocity

    def image(self, order: Order, link: str) -> tuple[tuple[complex, complex], tuple[complex, complex]] | None:
        """Two points of a link that lie farthest apart, each with its end point; None where it has no two."""
        known = self._known(order, link)
        far = max(((p, q) for p in known for q in known), key=lambda both: abs(both[0][0] - both[1][0]), default=None)
        return far if far is not None and abs(far[0][0] - far[1][0]) > COINCIDE * self.size else None

    def _known(self, order: Order, link: str) -> list[tuple[complex, complex]]:
        """Points of a link that have an end point: place on the mechanism and end (mm)."""
        points = self.sheet.structure.links[link].points
        return [
            (self.sheet.points[PointRef(ref.point)], end)
            for ref, end in self.sheet.ends[order].items()
            if PointRef(ref.point) in self.sheet.points and (ref.link == link or (not ref.link and ref.point in points))
        ]

    def end(self, order: Order, link: str, at: complex) -> complex:
        """The end point of the velocity or the acceleration of the point of a link that lies at a place (mm)."""
        if link == self.sheet.scene.frame.name:
            return 0j
        known = self._known(order, link)
        if not known:
            raise Unsolvable("not drawn", Problem(Phrase("link of name", name=link),
                                                  "no point of it stands in the polygons"))
        start, end = min(known, key=lambda pair: abs(pair[0] - at))
        if abs(start - at) <= COINCIDE * self.size:
            return end
        far = self.image(order, link)
        if far is not None:
            (a, a_end), (b, b_end) = far
            return a_end + (b_end - a_end) * ((at - a) / (b - a))
        scales, omega = self.sheet.scales, self.sheet.rates["omega"][link].value
        turning = 1j * omega if order == "velocity" else 1j * self.sheet.rates["alpha"][link].value - omega**2
        return end + turning * (at - start) * (scales.length / scales.of(order))


def force_groups(drawn: DrawnPosition) -> Sequence[Element]:
    """The groups in the order in which they are cut free, each after all that hang on it; and the guests at a hinge
    before their host where they can be, since the host's force there is then that of one pair, not the sum of several.
    """
    left, ordered = [*reversed(_balanced_groups(drawn.structure))], list[Element]()
    hosted = [both for hosts in drawn.hosts.values() for both in hosts.items()]
    while left:
        free = [e for e in left if all(e is other or other.outside.isdisjoint(e.members) for other in left)]
        waiting = {host for guest, host in hosted for e in left if guest in e.members and host not in e.members}
        ordered.append(next((e for e in free if waiting.isdisjoint(e.members)), free[0]))
        left.remove(ordered[-1])
    return ordered


def _balanced_groups(structure: Structure) -> tuple[Element, ...]:
    """The groups of the mechanism, in the order of solution, were it driven where it is balanced: a force or a moment
    there leaves so many equations to each group as it has unknown forces.

    Where no driver stands for the balance, or links are driven from later ones, all moving links are one group.
    """
    scene = structure.scene
    said = scene.loading.balance
    moving = [name for name in structure.links if name != scene.frame.name]
    whole = LargerGroup(tuple(moving), (), scene.drivers, tuple(n for n in moving if n in scene.by_name), 3)
    if any(element.ahead for element in structure.driven):
        return (whole,)
    if said is None or len(scene.drivers) != 1:
        return structure.elements
    given = scene.drivers[0]
    frame = scene.frame.name
    if given.turns and (given.link, given.relative_to) == (said.link, frame) and not said.is_force:
        return structure.elements
    slide = next((s for s in structure.slides if {s.a, s.b} == {said.link, frame}), None)
    driver: Driver = Driver(said.link, frame, 0.0, 0.0, 0.0)
    if said.is_force and slide is not None:
        driver = Driver(slide.a, slide.b, 0.0, 0.0, 0.0, slide.key)
    try:
        return analyse(replace(scene, drivers=(driver,))).elements
    except Unsolvable:
        return (replace(whole, drivers=(driver,)),)


# what acts from outside

STILL = 1e-11
"""Of the greatest speed: what slides more slowly rests."""


def acting_loads(sheet: Sheet, growing: Sheet) -> dict[str, bool | None]:
    """For each load whether it acts; None where it begins or ends exactly here.

    Parameters
    ----------
    sheet : the position, with the limit positions of the strokes of loads
    growing : the same with velocities, those of the driver's growing value where the mechanism rests
    """
    acting: dict[str, bool | None] = {}
    for load in sheet.scene.loading.loads:
        acts, edge = True, False
        phase = load.phase
        if phase is not None and phase.stroke:  # how far its stroke has gone, and which way it runs
            slide = sheet.structure.slide(phase.stroke)
            ends = [end.poses for end in sheet.limits[phase.stroke]]
            here, low, high = (travel(slide, poses, 0.0) for poses in (sheet.poses, *ends))
            slip, most = DrawnPosition(growing).slip(slide)
            running = abs(slip) > STILL * most and (slip > 0) == (phase.sense > 0)
            acts, edge = load.acts_on_stroke((here - low) / (high - low) if high > low else 0.0, running)
        elif phase is not None:
            driver = sheet.scene.drivers[0]
            acts, edge = load.acts_at(sheet.drivers[driver.key], driver.turns)
        acting[load.name] = None if edge else acts
    return acting


def inertia_read(drawn: DrawnPosition, mass: LinkMass, hand: Instrument) -> Inertia:
    """Inertia force and couple of a link, off the drawn acceleration polygon: F = -m a_S at the centre of mass (N),
    M = -J alpha (N m), and both as one force at h = M / F from it."""
    centre = drawn.place(mass.link, mass.at)
    image = drawn.end("acceleration", mass.link, centre)
    size = hand.read(abs(image))
    push = image / abs(image) * size * drawn.sheet.scales.acceleration if image else 0j
    force, moment = -mass.mass * push, -mass.inertia * drawn.sheet.rates["alpha"][mass.link].value
    shifted, h = shifted_line(force, centre, moment, drawn.mm) if force else (None, None)
    return Inertia(
        "read", "inertia", "force", link=mass.link, finds=(Symbol("Fi", link=mass.link),), mass=mass, centre=centre,
        push=push, force=force, moment=moment, shifted=shifted, h=h,
    )


def from_outside(
    drawn: DrawnPosition, growing: Sheet, inertias: Mapping[str, Inertia], springs: Iterable[ForceStep],
    with_edges: bool,
) -> tuple[ForceVector, ...]:
    """All known forces, then couples, those of no size among them.

    Parameters
    ----------
    growing : what tells the sense in which pairs slide
    inertias, springs : as they were read
    with_edges : whether loads act that begin or end exactly here
    """
    sheet, loading = drawn.sheet, drawn.sheet.scene.loading
    made: list[ForceVector] = []
    for mass in loading.masses:
        link, read = mass.link, inertias[mass.link]
        made.append(ForceVector(Symbol("Fi", link=link), link=link, force=read.force, at=read.centre))
        if loading.gravity:
            weight = mass.mass * loading.gravity
            made.append(ForceVector(Symbol("G", link=link), link=link, force=weight, at=read.centre))
        made.append(ForceVector(Symbol("Mi", link=link), link=link, moment=read.moment))
    for load in loading.loads:
        acting, acts = drawn.load(load, load.size), sheet.acting[load.name]
        if not (with_edges if acts is None else acts):
            acting = replace(acting, force=0j, moment=0.0)
        elif load.against:
            acting = replace(acting, force=_against(growing, load))
        made.append(acting)
    made += (force for step in springs for force in step.acting)
    return tuple(sorted(made, key=lambda load: not load.symbol.is_vector))


def spring_read(drawn: DrawnPosition, spring: SpringOn, hand: Instrument) -> ForceStep:
    """A spring by its length as read on the drawn mechanism (m), its pull on the first link (N) along its line, and the
    opposite on the second.  Raises Unsolvable ("dead point") where its points coincide."""
    pricked = (drawn.sheet.points.get(PointRef(point)) for point in spring.points)
    start, end = (drawn.place(*place) if z is None else z for z, place in zip(pricked, spring.ends, strict=True))
    size = abs(end - start)
    if size <= COINCIDE * drawn.size:
        said = "its two points coincide in this position so", "move the driver off this position"
        raise Unsolvable("dead point", Problem(spring.where, *said))
    length = hand.read(size) / drawn.mm
    force = spring.pull(length) * unit(end - start)
    link, other = spring.links
    acting = (ForceVector(spring.symbol, link=link, force=force, at=start),
              ForceVector(spring.symbol, link=other, force=-force, at=end, turned=True))
    return ForceStep("read", "spring", "force", link=link, acting=acting, length=length)


def _against(growing: Sheet, load: LoadOn) -> complex:
    """A force load (N) opposite to the sliding velocity of its pair; 0 where that rests."""
    drawn, slide = DrawnPosition(growing), growing.structure.slide(load.against)
    slip, most = drawn.slip(slide)
    return 0j if abs(slip) <= STILL * most else -load.size * math.copysign(1.0, slip) * drawn.along(slide)
