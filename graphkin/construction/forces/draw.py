"""Forces of a position on the drawing board: from the drawn accelerations to the balancing load, by force polygons and
by Zhukovsky's lever; and the readings: sizes, directions, moments, shifts, arms on the lever.

Higher pairs are replaced by lower pairs with the same forces at a drawn position: a sliding contact, or a cam with its
follower, by a pin that runs along the common tangent, rolling by a pin at the contact, teeth by a pin that runs along
the line of centres.  Forces need the position alone, so these are at the contact itself, whatever replaces it in
motion; without friction a sliding contact pushes along the common normal, teeth along the tangent of the pitch circles
in the pitch point (the axes hold their separating force), and a rolling contact in both directions.

The lever is the velocity polygon turned by 90 degrees as a rigid body about its pole.  Each force stands at the end
point of its point's velocity; the moment about the pole is the power of the force over the scale, so that the sum of
all moments is zero (virtual power), which gives the balancing load (N. E. Zhukovsky 1909; Artobolevsky, Theory of
mechanisms and machines, ch. 13).  A couple is a pair of forces square to a bar, at the end points of the bar's points.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import count
from typing import TypeVar

from graphkin.construction.board.instruments import EXACT, Instrument
from graphkin.construction.board.scales import extent_of, fitting_scale
from graphkin.construction.board.sheet import Reading, Sheet
from graphkin.construction.board.steps import Step, changed
from graphkin.construction.forces.groups import NORMAL, TANGENT, CutFree, at_driver, of_dyad, of_larger_group
from graphkin.construction.forces.position import DrawnPosition, force_groups, from_outside, inertia_read, spring_read
from graphkin.construction.forces.steps import ForceGroup, ForceState, ForceStep, ForceVector, Lever, MomentTerm
from graphkin.construction.touching import Touching
from graphkin.plane import Pose, added_up, cross, unit
from graphkin.scene.pairs import PlacedGuide
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Driven, Dyad, analyse, pin_in_guide

ROOM = (98.0, 84.0)
"""Width and height (mm) that the largest force polygon fills at most, where the scene wishes for no scale."""
LEAST = 10.0
"""Length on paper (mm) of the largest force of a group; a group of smaller forces has a scale of its own, since nobody
can read them to a hundredth."""
Numbered = TypeVar("Numbered", bound=Step)
Stepwise = TypeVar("Stepwise", ForceGroup, Lever)
ForceScales = Mapping[tuple[str, ...], float]
"""N for one mm of force polygons: of groups with a scale of their own by their links, of all others by ()."""
SAME = 1e-12
"""Of the largest force: a load that begins exactly here leaves what differs less as it is."""
NOUGHT = 1e-10
"""Of the largest force: an inertia force smaller than this has no line."""


def with_forces(sheet: Sheet, hand: Instrument = EXACT, scales: ForceScales | None = None) -> Sheet:
    """A drawn position with all its forces, each taken off its polygon, and the levers; drawn twice where a load begins
    or ends exactly here.

    Parameters
    ----------
    scales : of the polygons; None: those of the sheet, or by `force_scales`

    Raises
    ------
    Unsolvable : "dead point": the balance does no work, or a polygon does not close
    """
    scales = scales or sheet.force_scales or force_scales(sheet)
    moves = any(driver.values[1] for driver in sheet.scene.drivers)
    growing = sheet if moves else sheet.growing[0]
    drawn = DrawnPosition(sheet)
    held = held_by_pairs(sheet)
    loading = sheet.scene.loading
    inertias = {mass.link: inertia_read(drawn, mass, hand) for mass in loading.masses}
    springs = tuple(spring_read(drawn, spring, hand) for spring in loading.springs)
    states = [
        _state(held, hand, scales, from_outside(drawn, growing, inertias, springs, with_edges))
        for with_edges in ((False, True) if None in sheet.acting.values() else (False,))
    ]
    states = [replace(state, levers=tuple(_levers(sheet, state, hand))) for state in states]
    scales_used = replace(sheet.scales, force=scales[()])
    return _numbered(replace(sheet, scales=scales_used, inertias=inertias, springs=springs, forces=tuple(states)))


def _numbered(sheet: Sheet) -> Sheet:
    """The steps of the forces numbered after those of the motion: loads from outside, the groups, those of a second
    state where it differs, the levers."""
    numbers, bare = count(sheet.steps[-1].number + 1 if sheet.steps else 1), sheet.forces[0].groups

    def numbered(step: Numbered) -> Numbered:
        return changed(step, number=next(numbers))

    def in_order(group: Stepwise) -> Stepwise:
        return replace(group, steps=tuple(map(numbered, group.steps)))

    inertias = {link: numbered(step) for link, step in sheet.inertias.items()}
    springs = tuple(map(numbered, sheet.springs))
    first = [in_order(group) for group in bare]
    states = [
        replace(state, groups=tuple(done if drawn == before else in_order(drawn)
                                    for drawn, before, done in zip(state.groups, bare, first, strict=True)))
        for state in sheet.forces
    ]
    states = [replace(state, levers=tuple(map(in_order, state.levers))) for state in states]
    return replace(sheet, inertias=inertias, springs=springs, forces=tuple(states))


def force_scales(sheet: Sheet) -> ForceScales:
    """The scales of the force polygons: as the scene wishes, or the finest of the series at which every polygon fits
    its room, for groups of far smaller forces the finest at which their own do.  Raises Unsolvable as `with_forces`."""
    newtons, wish = sheet.scene.units.newtons, sheet.scene.question.sheet.force_scale
    if wish:
        return {(): wish * newtons}
    polygons: defaultdict[tuple[str, ...], list[Sequence[ForceVector]]] = defaultdict(list)
    for state in with_forces(sheet, EXACT, {(): 1.0}).forces:
        for group in state.groups:
            polygons[group.links] += group.polygons

    def fitting(drawn: Iterable[Sequence[ForceVector]]) -> float:
        extents = [extent_of([z for v in polygon for z in (v.tail, v.tip)], 1.0) for polygon in drawn]
        widest = max((wide for wide, _ in extents), default=0.0), max((high for _, high in extents), default=0.0)
        return fitting_scale(widest, ROOM, 1.0 / newtons) * newtons

    common = fitting(polygon for drawn in polygons.values() for polygon in drawn)
    largest = {links: max((abs(v.span) for p in drawn for v in p), default=0.0) for links, drawn in polygons.items()}
    least = NOUGHT * max(largest.values(), default=0.0)
    small = {links for links, most in largest.items() if least < most < LEAST * common}
    return {(): common} | {links: fitting(polygons[links]) for links in small}


def _state(held: Sheet, hand: Instrument, scales: ForceScales, known: tuple[ForceVector, ...]) -> ForceState:
    """All forces, from the known loads."""
    common, drawn_at = scales[()], dict[str, float]()  # the scale of the polygons of each link, in order
    cut, groups = CutFree(DrawnPosition(held), hand, common), []
    cut.push(*known)
    for element in force_groups(cut.drawn):
        cut.per_mm = scales.get(element.links or element.members, common)
        drawn_at |= dict.fromkeys(element.members, cut.per_mm)
        if isinstance(element, Driven):
            groups.append(at_driver(cut, element))
        elif isinstance(element, Dyad):
            groups.append(of_dyad(cut, element))
        else:
            groups.append(of_larger_group(cut, element))
    loads = (load for load in known if not load.turned)
    acting = [*loads, *_of_joints(cut), *cut.balances]
    forces = [load for load in acting if load.symbol.is_vector]
    vectors = {load.symbol: load.force for load in forces}
    moments = {load.symbol: load.moment for load in acting if not load.symbol.is_vector}
    per_mm = {load.symbol: next((drawn_at[name] for name in drawn_at if name in (load.link, load.off)), common)
              for load in forces}
    for k, group in enumerate(groups):  # what was read of forces of pairs, by their names
        named = {symbol: vectors.get(symbol, vectors.get(symbol.opposite)) for symbol in group.read}
        read = {symbol: abs(force / group.per_mm) for symbol, force in named.items() if force is not None}
        groups[k] = changed(group, read={**group.read, **read})
    return ForceState(known, tuple(groups), vectors, moments, per_mm)


def _of_joints(cut: CutFree) -> Iterator[ForceVector]:
    """The forces and couples of all joints, from those of pins and sliding pairs."""
    for joint in cut.drawn.joints:
        if joint.kind == "turning":
            force = cut.at_pin(joint.point, joint.second)
            yield ForceVector(joint.symbol("F"), link=joint.second, off=joint.first, force=force)
        else:
            of_slide, couple = cut.slides[joint.slide]
            yield of_slide
            if joint.couple:
                yield couple


def held_by_pairs(sheet: Sheet) -> Sheet:
    """The drawing with the structure for forces, in which lower pairs replace the contacts; itself without contacts."""
    scene, mm = sheet.scene, 1.0 / sheet.scales.length
    if not scene.higher_pairs:
        return sheet
    links = {link.name: link for link in (scene.frame, *scene.whole.links)}  # without bars for cams
    slides, points, poses = list(scene.whole.slides), dict(sheet.points), dict(sheet.poses)

    def local(link: str, at: complex) -> complex:
        return sheet.poses[link].local(at) / mm

    def with_point(link: str, point: str, at: complex) -> None:
        links[link] = replace(links[link], points={**links[link].points, point: local(link, at)})
        points[PointRef(point)] = at

    for touch in Touching(scene, mm, sheet.poses).touches():
        first, second = touch.links
        if touch.means == "rolls":
            with_point(first, touch.name, touch.at)
            with_point(second, touch.name, touch.at)
            continue
        # a pin of the second link runs in a slot of the first
        with_point(second, touch.name, touch.at)
        name, along = (NORMAL, touch.normal) if touch.means == "meshes" else (TANGENT, 1j * touch.normal)
        guide = PlacedGuide(name, local(first, touch.at), along / sheet.poses[first].axis)
        slides.append(pin_in_guide(links, touch.name, second, first, guide, "'"))
        poses[slides[-1].key] = Pose(touch.at, along)
    other = replace(
        scene, higher_pairs=(), frame=links[scene.frame.name], slides=tuple(slides), slots=scene.whole.slots,
        links=tuple(links[link.name] for link in scene.whole.links),
    )
    return replace(sheet, structure=analyse(other), poses=poses, points=points)


TURN = -1j
"""Turned clockwise: the moment of a force about the pole, counter-clockwise positive, is its power then."""


def _levers(sheet: Sheet, state: ForceState, hand: Instrument) -> Iterator[Lever]:
    """A lever for each driver, or for the balance in its place; none where the balancing load does no work."""
    drivers = sheet.scene.drivers if sheet.scene.loading.balance is None else sheet.scene.drivers[:1]
    # the lever is the velocity polygon of the position with this driver's value alone growing
    for driver, drawn in zip(drivers, sheet.growing or (sheet,), strict=True):
        images = DrawnPosition(drawn)
        balance = images.balance(driver)
        per_mm = drawn.scales.velocity
        ends = {ref: TURN * z * per_mm for ref, z in drawn.ends["velocity"].items()}
        # the forces with their places on the figure from which the images are
        times = sheet.scales.length / drawn.scales.length
        rows = tuple(_on_lever(images, changed(load, at=load.at * times), hand) for load in state.known)
        unknown = _on_lever(images, balance, hand)
        if balance.off != sheet.scene.frame.name:  # between both links that it acts on
            other = _on_lever(images, changed(balance, link=balance.off), hand)
            unknown = replace(unknown, moment=unknown.moment - other.moment)
        longest = max(map(abs, ends.values()), default=0.0)
        if abs(unknown.moment) <= 1e-12 * longest:
            continue
        power = added_up(row.moment for row in rows)
        rounding = 1e-12 * longest * max((abs(row.acting.force) for row in rows), default=0.0)
        value = -power / unknown.moment if abs(power) > rounding else 0.0
        steps = (ForceStep("carry over", "lever", "force"), ForceStep("lay off", "on lever", "force"),
                 ForceStep("read", "all moments", "force", symbol=balance.symbol, finds=(balance.symbol,)))
        by_polygons = state.moments.get(balance.symbol) or abs(state.vectors.get(balance.symbol, 0j))
        yield Lever(per_mm, drawn is not sheet, ends, rows, unknown, value, by_polygons, steps)


def _on_lever(images: DrawnPosition, acting: ForceVector, hand: Instrument) -> MomentTerm:
    """The moment of a force about the pole, at the end point of its point's velocity; of a couple as a pair of forces
    at two points of its link, square to the line between them."""
    link, per_mm = acting.link, images.sheet.scales.velocity
    if acting.symbol.is_vector:
        end = TURN * images.end("velocity", link, acting.at)
        mm = cross(end, unit(acting.force)) if acting.force else 0.0
        longest = max(map(abs, images.sheet.ends["velocity"].values()), default=0.0)
        arm = hand.read_signed(mm) * per_mm if abs(mm) > 1e-13 * longest else 0.0
        return MomentTerm(changed(acting, at=end * per_mm), arm, abs(acting.force) * arm)
    far = images.image("velocity", link) if link != images.sheet.scene.frame.name else None
    rates = images.sheet.rates["omega"]
    omega = rates[link].value if link in rates else 0.0
    if far is None or omega == 0.0:
        # a link without two points on the figure: its rate is that of another link
        return MomentTerm(changed(acting, force=complex(acting.moment), at=0j), omega, acting.moment * omega)
    (a, a_end), (b, b_end) = far
    square, size = 1j * unit(b - a), acting.moment / (abs(b - a) / images.mm)
    tail, tip = TURN * a_end * per_mm, TURN * b_end * per_mm
    arm = hand.read_signed(math.copysign(abs(b_end - a_end), cross(tip - tail, square))) * per_mm
    return MomentTerm(changed(acting, force=square * size, at=tip), arm, size * arm, pair=(tail, tip))


# what is read off


def force_readings(sheet: Sheet, hand: Instrument = EXACT) -> tuple[Reading, ...]:
    """The forces of a sheet as they are read, first drawn if they are not drawn yet; with ``+`` those changed by a load
    that begins or ends exactly there.  Raises Unsolvable as `with_forces`."""
    sheet = sheet if sheet.forces else with_forces(sheet, hand)
    largest = max((abs(v) for state in sheet.forces for v in state.vectors.values()), default=0.0)
    least = NOUGHT * largest
    return (*_of_states(sheet, largest, hand), *_shifts(sheet, least), *_arms(sheet, least))


def _of_states(sheet: Sheet, largest: float, hand: Instrument) -> Iterator[Reading]:
    """Forces (N), the ``largest`` of all states given, and moments (N m) of each state; of the second only those that
    differ from the first."""
    base, *_ = sheet.forces
    for state in sheet.forces:
        most = max((abs(m) for m in state.moments.values()), default=0.0)
        kinds = (state.vectors, base.vectors, largest), (state.moments, base.moments, most)
        for values, old, greatest in kinds:
            for symbol, value in values.items():
                named = symbol if state is base else replace(symbol, plus=True)
                if state is not base and abs(value - old[symbol]) <= SAME * greatest:
                    continue
                if not symbol.is_vector or value == 0.0:
                    yield Reading(named, 0.0 if symbol.is_vector else None, value, "force")
                    continue
                span = value / (per_mm := state.per_mm[symbol])
                length, along = abs(hand.read(abs(span))), span / abs(span)
                along = hand.read_direction(along) if hand is not EXACT else along
                yield Reading(named, length, length * along * per_mm, "force", per_mm)


def _shifts(sheet: Sheet, least: float) -> Iterator[Reading]:
    """The shifts of inertia forces that have a couple, of more than the ``least`` force (N)."""
    for link, inertia in sheet.inertias.items():
        if inertia.h is not None and inertia.mass.inertia and abs(inertia.force) > least:
            per_mm = sheet.scales.length
            yield Reading(Symbol("h", link=link), abs(inertia.h) / per_mm, inertia.h, "mechanism", per_mm)


def _arms(sheet: Sheet, least: float) -> Iterator[Reading]:
    """The arms of all forces above the ``least`` (N) on the lever of one driver, in the state in which they act."""
    if any(len(state.levers) != 1 for state in sheet.forces):
        return
    seen = set[Symbol]()
    for (lever,) in (state.levers for state in sheet.forces):
        for row in (*lever.rows, lever.unknown):
            symbol = Symbol("arm", name=str(row.symbol))
            sought = row is lever.unknown
            forceful = row.symbol.is_vector and (sought or row.size > least)
            if forceful and symbol not in seen:
                seen.add(symbol)
                arm = row.moment if sought else row.arm or 0.0  # what balances may act between two moving links
                yield Reading(symbol, abs(arm) / lever.per_mm, arm, "velocity")
