"""Forces of a position on the drawing board: from the drawn accelerations to what balances the mechanism, by force
polygons and by Zhukovsky's lever; and what is read off it: sizes, directions, moments, shifts, arms on the lever.

What touches stands there as pairs that carry the same forces at a drawn position: a sliding contact, or a cam with its
follower, is a pin that runs along the common tangent, rolling a pin at the contact, teeth a pin that runs along the
line of centres.  Forces ask for the position alone, so these stand at the contact itself, whatever replaces it in
motion; without friction a sliding contact pushes along the common normal, teeth along the tangent of the pitch circles
in the pitch point (what they also push apart the axes hold), and what rolls in both ways.

The lever is the velocity polygon turned by 90 degrees as a rigid body about its pole.  Each force stands at the end
point of its point's velocity; the moment about the pole is the power of the force over the scale, so that all moments
together are nought (virtual power), which gives what balances (N. E. Zhukovsky 1909; Artobolevsky, Theory of mechanisms
and machines, ch. 13).  A couple is a pair of forces square to a bar, at the end points of the bar's points.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from graphkin.construction.forces.cut_free import NORMAL, TANGENT, CutFree
from graphkin.construction.forces.force_sheet import (
    Acting,
    ForceGroup,
    ForceSheet,
    ForceState,
    KnownMoment,
    Lever,
    LeverRow,
)
from graphkin.construction.forces.groups import at_driver, of_dyad, of_larger_group
from graphkin.construction.forces.joints import BalanceForm, Images, JointNames, balance_of, force_groups
from graphkin.construction.forces.known import from_outside, inertias
from graphkin.construction.instruments import EXACT, Instrument
from graphkin.construction.links_on_paper import Pose
from graphkin.construction.scales import Extent, fitting_scale
from graphkin.construction.sheet import Sheet
from graphkin.construction.steps import DiagramName
from graphkin.construction.touching import Touch, Touching
from graphkin.plane import added_up, cross, unit
from graphkin.scene.bodies import PinInSlot
from graphkin.scene.model import Mechanism, PlacedGuide, PlacedLink
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Driven, Dyad, Element, Structure, analyse

__all__ = ["ROOM", "ForceReading", "force_readings", "force_scale", "forces_on", "readings_of"]

ROOM = (98.0, 84.0)
"""Width and height (mm) that the largest force polygon fills at most, where the scene wishes for no scale."""
SAME = 1e-12
"""Of the largest force: a load that begins exactly here leaves what differs less as it is."""
NOUGHT = 1e-10
"""Of the largest force: an inertia force smaller than this has no line."""


def forces_on(sheet: Sheet, hand: Instrument = EXACT, per_mm: float = 0.0) -> ForceSheet:
    """All forces of a drawn position, each taken off its polygon, and the levers.

    Parameters
    ----------
    per_mm : N for one mm of the polygons; 0: as `force_scale` chooses

    Raises
    ------
    Unsolvable : "dead point": the balance does no work, or a polygon does not close
    """
    return _drawn(sheet, hand, per_mm or force_scale(sheet))


def force_scale(sheet: Sheet) -> float:
    """N for one mm of the force polygons: as the scene wishes, or the finest of the series at which every polygon fits
    its room.  Raises Unsolvable as `forces_on`."""
    newtons, wish = sheet.scene.units.newtons, sheet.scene.question.sheet.force_scale
    if wish:
        return wish * newtons
    whole = _drawn(sheet, EXACT, 1.0)
    polygons = [p for state in whole.states for group in state.groups for p in (group.polygon, *group.inner.values())]
    extents = [Extent.around([z for v in p for z in (v.tail, v.tip)], 1.0) for p in polygons if p]
    width, height = (max((getattr(e, name) for e in extents), default=0.0) for name in ("width", "height"))
    return fitting_scale(Extent(width, height), ROOM, 1.0 / newtons) * newtons


def _drawn(sheet: Sheet, hand: Instrument, per_mm: float) -> ForceSheet:
    moves = any(driver.values[1] for driver in sheet.scene.drivers)
    growing = sheet if moves else sheet.growing[0]
    held = held_by_pairs(sheet)
    found = inertias(sheet, hand)
    edges = None in sheet.acting.values()
    states = []
    for with_edges in (False, True) if edges else (False,):
        forces, moments = from_outside(sheet, growing, found, sheet.acting, with_edges, hand)
        states.append(_state(held, hand, per_mm, forces, moments))
    levers = tuple(levers_of(sheet, state, hand) for state in states)
    return ForceSheet(per_mm, found, tuple(states), levers)


def _state(
    held: Sheet, hand: Instrument, per_mm: float, known: tuple[Acting, ...], turning: tuple[KnownMoment, ...]
) -> ForceState:
    names = JointNames(held.structure)
    cut = CutFree(Images(held), hand, per_mm, names, {}, {})
    for one in known:
        cut.push(one)
    for moment in turning:
        cut.turn(moment)
    groups = tuple(_group(cut, element) for element in reversed(force_groups(held.structure)))
    vectors = {one.symbol: one.force / per_mm for one in known if not one.turned}
    moments = {one.symbol: one.moment for one in turning}
    _joints(cut, vectors, moments)
    for symbol, value in cut.balances.items():
        if symbol.kind == "M":
            moments[symbol] = float(value.real)
        else:
            vectors[symbol] = complex(value) / per_mm
    return ForceState(known, turning, tuple(g for g in groups if g.links), vectors, moments)


def _group(cut: CutFree, element: Element) -> ForceGroup:
    structure = cut.names.structure
    balances: Mapping[str, BalanceForm] = {d.key: balance_of(structure, d) for d in element.drivers}
    if isinstance(element, Driven):
        return at_driver(cut, element, balances[element.driver.key])
    if isinstance(element, Dyad):
        return of_dyad(cut, element, balances)
    return of_larger_group(cut, element, tuple(balances.values()))


def _joints(cut: CutFree, vectors: dict[Symbol, complex], moments: dict[Symbol, float]) -> None:
    """The forces of all joints by their names, off what was found of pins and sliding pairs."""
    names = cut.names
    for point, first, later in names.turning():
        force = cut.pins[point, later]
        # the block of a pin in a slot belongs to the link of the pin
        force += added_up((cut.pins[point, key] for key, (of, _) in names.blocks.items()
                           if of == later and point in names.structure.links[key].points), 0j)  # fmt: skip
        vectors[names.between(first, later, point)] = force / cut.per_mm
    for slide in names.structure.slides:
        force, couple = cut.slides[slide.key]
        vectors[names.of_slide(slide)] = force / cut.per_mm
        if not slide.slot:
            moments[names.of_slide(slide, "M")] = couple


def held_by_pairs(sheet: Sheet) -> Sheet:
    """The same drawing with the structure in which forces are found; itself where nothing touches."""
    scene = sheet.scene
    if not (scene.contacts or scene.gears or scene.cams):
        return sheet
    made = _Pairs(sheet, {link.name: link for link in (scene.frame, *scene.links)})
    for touch in Touching(scene, 1.0 / sheet.scales.length, sheet.poses).touches():
        if touch.means == "rolls":
            for link in touch.links:
                made.with_point(link, touch.name, touch.at)
        elif touch.means == "meshes":
            made.guide(touch, NORMAL, touch.normal)
        else:
            made.guide(touch, TANGENT, 1j * touch.normal)
    return made.sheet_of(scene)


@dataclass
class _Pairs:
    """The links with the pairs that they get."""

    sheet: Sheet
    links: dict[str, PlacedLink]
    pins: list[PinInSlot] = field(default_factory=list)
    places: dict[PointRef, complex] = field(default_factory=dict)
    blocks: dict[str, Pose] = field(default_factory=dict)

    def guide(self, touch: Touch, line: str, along: complex) -> None:
        """A pin of the second link runs in a slot of the first."""
        first, second = touch.links
        self.with_point(second, touch.name, touch.at)
        pose, link = self.sheet.poses[first], self.links[first]
        slot = PlacedGuide(line, self._local(first, touch.at), along / pose.axis)
        while slot.name in link.guides:
            slot = replace(slot, name=slot.name + "'")
        self.links[first] = replace(link, guides={**link.guides, slot.name: slot})
        self.pins.append(PinInSlot(touch.name, second, first, slot.name))
        self.blocks[self.pins[-1].key] = Pose(touch.at, along)

    def _local(self, link: str, at: complex) -> complex:
        pose = self.sheet.poses[link]
        return (at - pose.origin) / pose.axis * self.sheet.scales.length

    def with_point(self, link: str, point: str, at: complex) -> None:
        own = self.links[link]
        self.links[link] = replace(own, points={**own.points, point: self._local(link, at)})
        self.places[PointRef(point)] = at

    def sheet_of(self, scene: Mechanism) -> Sheet:
        """The drawing with these pairs instead of what touches."""
        links = tuple(self.links[link.name] for link in scene.whole.links)  # without bars for cams
        other = replace(
            scene, frame=self.links[scene.frame.name], links=links, pins=(*_own_pins(scene), *self.pins), contacts=(),
            gears=(), cams=(), slots=scene.whole.slots,
        )  # fmt: skip
        structure: Structure = analyse(other)
        poses: Mapping[str, Pose] = {**self.sheet.poses, **self.blocks}
        return replace(self.sheet, structure=structure, poses=poses, points={**self.sheet.points, **self.places})


def _own_pins(scene: Mechanism) -> tuple[PinInSlot, ...]:
    """The pins in slots of a scene, those left out that stand for cams in its motion."""
    return scene.whole.pins


TURN = -1j
"""Turned clockwise: the moment of a force about the pole, counter-clockwise positive, is its power then."""


def levers_of(sheet: Sheet, state: ForceState, hand: Instrument) -> tuple[Lever, ...]:
    """A lever for each driver, or for what balances instead; none where that does not move."""
    drivers = sheet.scene.drivers
    if sheet.scene.loading.balance is not None:
        drivers = drivers[:1]
    moving = sheet.growing or (sheet,)
    made = [
        _lever(sheet, drawn, state, balance_of(sheet.structure, driver), hand)
        for driver, drawn in zip(drivers, moving, strict=True)
    ]
    return tuple(lever for lever in made if lever is not None)


def _lever(sheet: Sheet, drawn: Sheet, state: ForceState, balance: BalanceForm, hand: Instrument) -> Lever | None:
    images = Images(drawn)
    ends = {str(ref): TURN * z for ref, z in drawn.ends["velocity"].items()}
    rows = [_force(images, one, hand) for one in _at(images, sheet, state.known)]
    rows += [_couple(images, one, hand) for one in state.turning]
    unknown = _unknown(images, balance, hand)
    if abs(unknown.moment) <= 1e-12 * max((abs(z) for z in ends.values()), default=0.0):
        return None
    value = -added_up(row.moment for row in rows) / unknown.moment
    vector = 0j if balance.is_moment else value * unknown.force
    return Lever(drawn.scales.velocity, drawn is not sheet, ends, tuple(rows), balance.symbol, unknown, value, vector)


def _at(images: Images, sheet: Sheet, known: Sequence[Acting]) -> list[Acting]:
    """The forces with their places on the figure from which the images are."""
    times = sheet.scales.length / images.sheet.scales.length
    return [Acting(one.symbol, one.link, one.force, one.at * times, one.turned) for one in known]


def _arm(end: complex, force: complex, hand: Instrument) -> float:
    mm = cross(end, unit(force))
    if abs(mm) <= 1e-13 * abs(end):
        return 0.0
    read = hand.read(abs(mm))
    return read if mm > 0 else -read


def _force(images: Images, one: Acting, hand: Instrument) -> LeverRow:
    end = TURN * images.velocity(one.link, one.at)
    arm = _arm(end, one.force, hand) if one.force and end else 0.0
    return LeverRow(one.symbol, one.force, end, arm, abs(one.force) * arm, None, one.turned)


def _couple(images: Images, one: KnownMoment, hand: Instrument) -> LeverRow:
    return _pair(images, one.symbol, one.link, one.moment, hand)


def _pair(images: Images, symbol: Symbol, link: str, moment: float, hand: Instrument) -> LeverRow:
    """A couple on a link as a pair of forces at two of its points, square to the line between them."""
    far = images.image("velocity", link) if link != images.sheet.scene.frame.name else None
    omega = images.sheet.omega[link].value if link in images.sheet.omega else 0.0
    if far is None or omega == 0.0:
        # a link without two points on the figure: its rate is that of another link
        arm = omega / images.sheet.scales.velocity
        return LeverRow(symbol, complex(moment), 0j, arm, moment * arm)
    (a, a_end), (b, b_end) = far
    bar = b - a
    force = 1j * unit(bar) * (moment / (abs(bar) / images.mm))
    tail, tip = TURN * a_end, TURN * b_end
    read = hand.read(abs(tip - tail))
    arm = read if cross(tip - tail, 1j * unit(bar)) > 0 else -read
    return LeverRow(symbol, force, tip, arm, moment / (abs(bar) / images.mm) * arm, (tail, tip))


def _unknown(images: Images, balance: BalanceForm, hand: Instrument) -> LeverRow:
    """What balances, of unit size, between both links that it acts on."""
    frame = images.sheet.scene.frame.name
    if balance.is_moment:
        own = _pair(images, balance.symbol, balance.link, 1.0, hand)
        if balance.other == frame:
            return own
        other = _pair(images, balance.symbol, balance.other, 1.0, hand)
        return LeverRow(balance.symbol, own.force, own.at, own.arm, own.moment - other.moment, own.pair)
    along, at = images.of_balance(balance)
    own = _force(images, Acting(balance.symbol, balance.link, along, at), hand)
    if balance.other == frame:
        return own
    other = _force(images, Acting(balance.symbol, balance.other, along, at), hand)
    return LeverRow(balance.symbol, along, own.at, own.arm, own.moment - other.moment)


# -- what is read off --------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class ForceReading:
    """A quantity with its length on paper (mm; None where it is the result of a moment equation) and its value (N, N m,
    m, m/s)."""

    symbol: Symbol
    mm: float | None
    value: complex | float
    diagram: DiagramName


def force_readings(sheet: Sheet, hand: Instrument = EXACT) -> tuple[ForceReading, ...]:
    """Draw the forces of a sheet with an instrument and read them off.  Raises Unsolvable as `forces_on`."""
    return readings_of(sheet, forces_on(sheet, hand), hand)


def readings_of(sheet: Sheet, forces: ForceSheet, hand: Instrument = EXACT) -> tuple[ForceReading, ...]:
    """What is read off forces that are drawn; with ``+`` what a load changes that begins or ends exactly there."""
    return (*_of_states(forces, hand), *_shifts(sheet, forces), *_arms(sheet, forces))


def _of_states(forces: ForceSheet, hand: Instrument) -> Iterator[ForceReading]:
    base = forces.states[0]
    largest = max((abs(v) for state in forces.states for v in state.vectors.values()), default=0.0)
    for state in forces.states:
        for symbol, span in state.vectors.items():
            named = symbol if state is base else replace(symbol, plus=True)
            if state is not base and abs(span - base.vectors[symbol]) <= SAME * largest:
                continue
            size = abs(span)
            if size == 0.0:
                yield ForceReading(named, 0.0, 0j, "force")
                continue
            length = abs(hand.read(size))
            along = hand.read_direction(span / size) if hand is not EXACT else span / size
            yield ForceReading(named, length, length * along * forces.per_mm, "force")
        most = max((abs(m) for m in state.moments.values()), default=0.0)
        for symbol, moment in state.moments.items():
            named = symbol if state is base else replace(symbol, plus=True)
            if state is base or abs(moment - base.moments[symbol]) > SAME * most:
                yield ForceReading(named, None, moment, "force")


def _largest(forces: ForceSheet) -> float:
    return max((abs(v) for state in forces.states for v in state.vectors.values()), default=0.0) * forces.per_mm


def _shifts(sheet: Sheet, forces: ForceSheet) -> Iterator[ForceReading]:
    """The shifts of inertia forces that have a couple."""
    most = _largest(forces)
    for link, one in forces.inertias.items():
        if one.h is not None and one.inertia and abs(one.force) > NOUGHT * most:
            yield ForceReading(Symbol("h", link=link), abs(one.h) / sheet.scales.length, one.h, "mechanism")


def _arms(sheet: Sheet, forces: ForceSheet) -> Iterator[ForceReading]:
    """The arms of all forces on the lever of one driver, in the state in which they act."""
    if any(len(levers) != 1 for levers in forces.levers):
        return
    most, seen = _largest(forces), set[Symbol]()
    for (lever,) in forces.levers:
        for row in (*lever.rows, lever.unknown):
            symbol = Symbol("arm", name=str(row.symbol))
            forceful = row.symbol.is_vector and (row is lever.unknown or abs(row.force) > NOUGHT * most)
            if forceful and symbol not in seen:
                seen.add(symbol)
                arm = row.moment if row is lever.unknown else row.arm  # what balances may act between two moving links
                yield ForceReading(symbol, abs(arm), arm * lever.per_mm, "velocity")
