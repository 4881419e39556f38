"""From a scene to its drawing: position, velocity polygon, acceleration polygon, and their scales.

A scene is analysed once, and drawn once by exact hands, at scales of its own; every figure is that construction at the
scales that suit it: the scene's own, or those of the 1-2-2.5-5 series that fill the paper.  It may be drawn again with
other errors, or continued from a person's own values.

Driven triangles are drawn with one of their links held still, as if it were the frame.  The place and motion of the
other link relative to it do not depend on the held link's motion: they are carried over to the mechanism as a driver at
their common pair, and the rest of the group are dyads.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING

from graphkin.construction.board.instruments import EXACT, Instrument
from graphkin.construction.board.scales import Room, Scales
from graphkin.construction.board.sheet import Board, GroupWay, Limits, Sheet, without_residues
from graphkin.construction.board.steps import ORDERS, Order, Step
from graphkin.construction.polygons.elements import draw_element
from graphkin.construction.polygons.polygons import AS_DRAWN, RATE, OwnValues, Polygons, draw_asked
from graphkin.construction.polygons.vector_graph import VectorChain, contacts_of
from graphkin.construction.position.group_position import each_assembly
from graphkin.construction.position.links_on_paper import PlacedLinks, reading, stuck, travel
from graphkin.construction.position.position import (
    Assembly,
    assembly_at,
    cams_in_place,
    off_the_own_position,
    own_position,
    place,
)
from graphkin.construction.position.reduced_mechanism import PlacedElements
from graphkin.errors import Unsolvable
from graphkin.plane import Poses, dot
from graphkin.scene.model import Loading, LoadOn, Mechanism
from graphkin.scene.scene_tables import DIAGRAMS
from graphkin.scene.symbol import PointRef, Symbol, Value, asked_here
from graphkin.structure import (
    Driven,
    DrivenTriangle,
    Dyad,
    Element,
    LargerGroup,
    Structure,
    analyse,
    needed,
    pick,
    pins_on_circles,
    without,
)
from graphkin.words import Phrase, links_named

if TYPE_CHECKING:
    from graphkin.construction.polygons.group_plan import GroupPlan

NATURAL = Scales(1e-3, 1e-3, 1e-3)  # 1 mm of paper for 1 mm, 1 mm/s, 1 mm/s2
FITS = 1e-6
"""Of the size: so well a driven slide must have its travel in an assembly."""

# what is to be drawn


@dataclass(frozen=True, eq=False, repr=False)
class Plan:
    """The plan of a drawing: its quantities, position, assembly, the equation for each dyad, and its scales.

    ``opened`` is the structure with groups that driven triangles turn into dyads in their parts, ``triangles`` are
    these, each in its assembly; ``assembly`` is that of the elements, with the values at the triangles' pairs;
    ``limits`` are the limit positions of asked quantities, on paper of the mechanism's size.  ``acting`` and
    ``growing`` as in `Sheet`. With ``touching`` sliding contacts are drawn themselves, not their replacements.
    ``without_forces`` is the reason why no forces are drawn. ``made`` is the drawing by exact hands, at scales of its
    own; None until it is drawn.
    """

    structure: Structure
    opened: Structure
    asked: tuple[Symbol, ...]
    elements: tuple[Element, ...]
    assembly: Assembly
    triangles: tuple[Inversion, ...]
    chains: Mapping[Dyad, VectorChain] = field(default_factory=dict)
    plans: Mapping[LargerGroup, GroupPlan] = field(default_factory=dict)
    limits: Mapping[str, Limits] = field(default_factory=dict)
    acting: Mapping[str, bool | None] = field(default_factory=dict)
    growing: tuple[Sheet, ...] = ()
    touching: bool = False
    without_forces: Unsolvable | None = None
    scales: Scales = NATURAL
    made: Sheet | None = None

    @property
    def exact(self) -> Sheet:
        """The drawing by exact hands, once for all figures."""
        assert self.made is not None
        return self.made

    @property
    def values(self) -> Mapping[str, float]:
        """Driver values (rad, m), by key."""
        return self.assembly.values

    @cached_property
    def is_whole(self) -> bool:
        """Whether the whole motion is drawn: no quantity is asked for, or a force, which every link may push."""
        return not self.asked or any(s.scope in ("force", "cycle") for s in self.asked)

    @cached_property
    def has_forces(self) -> bool:
        """Whether forces can be drawn: there are masses or loads, and all that they need is drawn."""
        return self.is_whole and self.without_forces is None and bool(self.structure.scene.loading)

    @cached_property
    def force_scales(self) -> Mapping[tuple[str, ...], float]:
        """The scales of its force polygons, by exact hands, as in `Sheet`.  Raises Unsolvable as `with_forces`."""
        from graphkin.construction.forces.draw import force_scales

        return force_scales(self.exact.at(self.scales))

    @property
    def loads_on_strokes(self) -> dict[Symbol, LoadOn]:
        """The strokes on parts of which loads act, each with a load on it; empty where no forces are drawn."""
        loads = self.structure.scene.loading.loads if self.has_forces else ()
        keys = {load.phase.stroke: load for load in loads[::-1] if load.phase is not None and load.phase.stroke}
        parts = ((*key.partition("/"), load) for key, load in keys.items())
        return {Symbol("stroke", link=sliding, other=on): load for sliding, _, on, load in parts}

    @cached_property
    def drawn(self) -> Mapping[Order, tuple[Element, ...]]:
        """The elements of each polygon that the asked quantities need: in accelerations only those that lead to
        accelerations."""
        pushes = [s for s in self.asked if s.measure.order == 2]
        wanted = needed(self.opened, pushes) if pushes else []
        pushed = self.elements if self.is_whole else tuple(e for e in self.elements if e in wanted)
        return {"velocity": self.elements, "acceleration": pushed}

    @cached_property
    def left_out(self) -> tuple[Phrase, ...]:
        """The elements that no asked quantity needs."""
        placed = {n for e in self.elements for n in e.members}
        pushed = {n for e in self.drawn["acceleration"] for n in e.members}
        gone = {n for e in self.opened.elements if e not in self.elements for n in e.members}
        without = {"left out elements": gone, "left out accelerations": placed - pushed}
        names = [link.name for link in self.structure.scene.links]
        links_by_key = {key: [name for name in names if name in links] for key, links in without.items()}
        return tuple(Phrase(key, links=links_named(links)) for key, links in links_by_key.items() if links)

    @property
    def in_order(self) -> Iterator[tuple[Order, Element]]:
        """The elements drawn in the polygons, in order."""
        return ((order, element) for order in ORDERS for element in self.drawn[order])

    def with_branches(self, branches: Mapping[int, int]) -> Plan:
        """The plan in another assembly, at the same scales.  Raises Unsolvable where it cannot be drawn."""
        other = replace(self, assembly=replace(self.assembly, branches=branches), chains={}, plans={})
        return replace(_planned(other, None), scales=self.scales)

    def at_contacts(self) -> Plan | None:
        """The plan with sliding contacts, or rollers, edges and faces of cams, drawn at the contact itself instead of
        by their replacements, at scales that suit it; None without such contacts, or if one lies in a pivot."""
        scene = self.structure.scene
        if scene.instead_of is None:
            if scene.replacing.keys().isdisjoint(self.exact.poses):
                return self._touching()
            poses = {name: pose.scaled(self.exact.scales.length) for name, pose in self.exact.poses.items()}
            replaced = analyse(pins_on_circles(scene, poses, self.values))
            other = _plan(replaced, self.asked, without_forces=self.without_forces)
            return other._touching() or other
        whole = scene.whole
        barred = bool(scene.replacing.keys() - whole.by_name.keys())
        values = {d.key: self.values[d.key] for d in whole.drivers}
        placed = cams_in_place(analyse(whole), self.asked, values, bars=False)
        other = _plan(placed, self.asked, without_forces=self.without_forces)
        return other._touching() or (other if barred else None)

    def _touching(self) -> Plan | None:
        """The plan with its sliding contacts drawn themselves, if it has any."""
        if not self.structure.scene.higher_pairs:
            return None
        touching = {e for e in self.elements if not isinstance(e, Driven) and contacts_of(self.structure, e)}
        if not touching:
            return None
        chains = {dyad: chain for dyad, chain in self.chains.items() if dyad not in touching}
        other = replace(self, chains=chains, plans={}, touching=True)
        try:
            polygons = carried_out(other, NATURAL)
        except Unsolvable:  # a contact at a pivot, which turns nothing there
            return None
        exact = finished(other, polygons)
        return replace(other, made=exact, scales=exact.scales_for(None), chains=polygons.chains, plans=polygons.plans)


# carried out on a board


def positioned(
    planned: Plan, scales: Scales, instrument: Instrument = EXACT, own_values: OwnValues = AS_DRAWN,
    with_steps: bool = True,
) -> Polygons:
    """The position on a board without polygons; its steps, which need no readings, only if they are wanted."""
    board = Board(instrument)
    triangles = [(inversion, inversion.drawn(board, scales, planned.values)) for inversion in planned.triangles]
    values = {**planned.values, **{v.key: v.near(planned.values[v.key], motion[0]) for v, motion in triangles}}
    assembly = replace(planned.assembly, values=values)
    told_on = board if with_steps else None
    paper = place(planned.opened, planned.elements, 1.0 / scales.length, assembly, instrument, told_on)
    polygons = Polygons.begun(board, planned.opened, paper, scales, own_values)
    for inversion, motion in triangles:
        for order, rate in zip(ORDERS, motion[1:], strict=True):
            polygons.given[order, inversion.key] = rate
        for step in inversion.carried_over(motion):
            board.do(step)
    return replace(polygons, at_contacts=planned.touching, chains={**planned.chains}, plans={**planned.plans})


def carried_out(
    planned: Plan, scales: Scales, instrument: Instrument = EXACT, own_values: OwnValues = AS_DRAWN
) -> Polygons:
    """Position and both polygons on a board."""
    in_order = [*planned.in_order]
    polygons = positioned(planned, scales, instrument, own_values)
    for order, element in in_order:
        draw_element(polygons, order, element)
    return polygons


def finished(planned: Plan, polygons: Polygons) -> Sheet:
    """The board as a sheet, with vectors that only a question needs."""
    draw_asked(polygons, planned.asked)
    board, limits, stop = polygons.board, planned.limits, planned.without_forces
    groups: dict[LargerGroup, GroupWay] = {}
    for group in needed(planned.structure, planned.asked) if planned.structure.larger_groups else ():
        if isinstance(group, LargerGroup):
            by_points = group in polygons.plans and not polygons.plans[group].tried
            groups[group] = "special points" if by_points else "superposition"
    if limits:
        from graphkin.construction.position.limits import limits_on_paper

        hand = EXACT if planned.triangles else board.instrument
        limits = limits_on_paper(limits, planned.structure, planned.elements, planned.values, polygons.scales, hand)
    sheet = Sheet(
        scene=planned.structure.scene,
        structure=planned.structure,
        instrument=board.instrument.name,
        drivers={d.key: planned.values[d.key] for d in planned.structure.scene.drivers},
        scales=polygons.scales,
        poses=dict(polygons.paper.poses),
        points={PointRef(p): z for p, z in polygons.places.items()},
        ends={order: dict(ends) for order, ends in polygons.ends.items()},
        rates={RATE[order]: dict(rates) for order, rates in polygons.rates.items()},
        steps=tuple(board.steps),
        held_still=tuple(board.held_still),
        equations=tuple(board.equations),
        assembly=board.assembly,
        noticed=tuple(board.noticed),
        left_out=planned.left_out,
        groups=groups,
        causes=tuple(board.causes) if board.instrument.acts else (),
        asked=planned.asked,
        acting=planned.acting,
        growing=planned.growing,
        trains=tuple(polygons.trains),
        limits=limits,
        readings=dict(board.readings),
        has_forces=planned.has_forces,
        without_forces=None if stop is None else Phrase("forces not known", why=stop.reason),
    )
    return without_residues(sheet) if board.instrument.faultless else sheet


Own = Mapping[Symbol, Value]


class Stages:
    """A plan drawn by some hands, its polygons kept after each element: from there other hands draw on that err in some
    of their acts, and people from their own values in place of drawn ones.

    ``own_values`` gives the changes by a person's values; the results of equal values are kept.
    """

    KEPT = 256

    def __init__(
        self, planned: Plan, scales: Scales, hand: Instrument = EXACT,
        own_values: Callable[[Own], OwnValues] = lambda _: AS_DRAWN,
    ) -> None:
        self.planned, self.scales, self.hand, self.own_values = planned, scales, hand, own_values
        self.in_order = tuple(planned.in_order)
        polygons = positioned(planned, scales, hand)
        self.after = [(hand.acts, polygons)]
        """The acts of the hand, and the polygons, after a number of elements."""
        for order, element in self.in_order:
            polygons = polygons.again(hand)
            draw_element(polygons, order, element)
            self.after.append((hand.acts, polygons))
        self.others: dict[tuple[int, frozenset[tuple[Symbol, Value]]], Polygons] = {}

    @cached_property
    def sheet(self) -> Sheet:
        """The drawing as it was kept."""
        return finished(self.planned, self.after[-1][1].again(self.hand))

    def by(self, hand: Instrument, first: int = 0) -> Sheet:
        """The drawing of hands that err in no act before the ``first``; readings may be taken of it, the steps of its
        position may be missing.  Raises as `execute`."""
        before = [(acts, polygons) for acts, polygons in self.after if acts < first]
        if not before:
            polygons = positioned(self.planned, self.scales, hand, with_steps=False)
        else:
            hand.acts, kept = before[-1]
            polygons = kept.again(hand)
        for order, element in self.in_order[max(0, len(before) - 1) :]:
            draw_element(polygons, order, element)
        return finished(self.planned, polygons)

    @cached_property
    def found_by(self) -> Mapping[Symbol, int]:
        """The number of elements that lead to each vector and rate; one more than there are, to what only a question
        asks for."""
        asked = self.after[-1][1].again(EXACT)
        draw_asked(asked, self.planned.asked)
        numbers: dict[Symbol, int] = {}
        for number, polygons in enumerate([*(polygons for _, polygons in self.after[1:]), asked], 1):
            rates = [Symbol(RATE[order], link=link) for order, links in polygons.rates.items() for link in links]
            for symbol in (*(s for drawn in polygons.drawn.values() for s in drawn), *rates):
                numbers.setdefault(symbol, number)
        return numbers

    def to(self, symbol: Symbol, answers: Own) -> Polygons | None:
        """The polygons up to a vector or rate, drawn from a person's answers; None where no element leads to it.
        Raises as `execute`."""
        number = self.found_by.get(symbol)
        if number is None:
            return None
        if number < len(self.after):
            return self._from(number, answers)
        polygons = self._from(number - 1, answers).again(EXACT)
        draw_asked(polygons, self.planned.asked)
        return polygons

    def _from(self, number: int, answers: Own) -> Polygons:
        """The polygons after a number of elements, drawn from a person's answers."""
        answers = {s: value for s, value in answers.items() if self.found_by.get(s, number + 1) <= number}
        if not answers:
            return self.after[number][1]
        key = number, frozenset(answers.items())
        if key not in self.others:
            polygons = replace(self._from(number - 1, answers).again(EXACT), own_values=self.own_values(answers))
            draw_element(polygons, *self.in_order[number - 1])
            while len(self.others) >= self.KEPT:
                del self.others[next(iter(self.others))]
            self.others[key] = polygons
        return self.others[key]


# planned


def plan(
    scene: Mechanism | Structure,
    at: Mapping[str, float] | None = None,
    find: Iterable[Symbol] | None = None,
    room: Room | None = None,
    near: Sheet | None = None,
    without_forces: Unsolvable | None = None,
) -> Plan:
    """Plan a drawing, and carry it out exactly; parameters and errors as for `draft`.

    ``without_forces`` is the reason why none shall be drawn.
    """
    structure = analyse(scene.whole)
    scene = structure.scene
    asked = tuple(scene.question.find if find is None else find)
    if scene.cams:
        values = {d.key: (at or {}).get(d.key, d.values[0]) for d in scene.drivers}
        structure, near = cams_in_place(structure, asked, values), None
    return _plan(structure, asked, at, room, near, without_forces)


def plan_with_forces(
    structure: Mechanism | Structure, values: Mapping[str, float] | None, asked: Sequence[Symbol],
    by_name: Sequence[Symbol],
) -> Plan:
    """The plan of a drawing with its forces: of the motion alone, where a load acts on a part of a stroke without a
    whole turn and no force is asked for by name.

    Raises
    ------
    Unsolvable : a position that cannot be assembled; no whole turn for what is asked by name
    """
    try:
        return plan(structure, values, asked)
    except Unsolvable as stop:
        if stop.status != "no whole turn" or any(s.scope in ("force", "cycle") for s in by_name):
            raise
        return plan(structure, values, asked_here(by_name), without_forces=stop)


def _plan(
    structure: Structure, asked: tuple[Symbol, ...], at: Mapping[str, float] | None = None, room: Room | None = None,
    near: Sheet | None = None, without_forces: Unsolvable | None = None,
) -> Plan:
    """The plan for a mechanism without cams."""
    scene = structure.scene
    opened = opened_at_triangles(structure) if structure.larger_groups else structure
    turned = opened is not structure and any(symbol.scope == "turn" for symbol in asked)
    elements = tuple(needed(opened, () if turned else asked))  # a turn is followed with the driven triangles
    if opened is not structure and any(isinstance(e, LargerGroup) for e in elements):
        # groups that remain are found by trial, driven triangles with them
        opened, elements = structure, tuple(needed(structure, asked))
    given = {d.key: d.values[0] for d in scene.drivers}
    values = given | {key: value for key, value in (at or {}).items() if key in given}
    triangles: tuple[Inversion, ...] = ()
    start: Assembly | None = None
    if opened is not structure:
        try:
            taken, start = own_assembly(structure, elements)
        except Unsolvable as stop:
            if stop.status != "dead point" or values == given:
                raise
            raise off_the_own_position(stop) from None
        given = {**start.values}
        triangles = tuple(v.followed(given, values) for v in taken)
        values |= {v.key: v.near(given[v.key], v.value(values)) for v in triangles}
    elif near is not None and {n for e in elements for n in e.members} <= near.poses.keys():
        size = near.scales.length / near.scene.size
        start = Assembly(near.drivers, {name: pose.scaled(size) for name, pose in near.poses.items()})
    here = {d.key: values[d.key] for d in opened.scene.drivers}
    assembly = assembly_at(opened, elements, here, start)
    assembly = replace(assembly, values={**values, **assembly.values})
    first = Plan(structure, opened, asked, elements, assembly, triangles, without_forces=without_forces)
    return _planned(first, room)


def _planned(planned: Plan, room: Room | None) -> Plan:
    """A plan carried out exactly, with the limit positions and the loads that its question needs, and its scales."""
    asked, loads = planned.asked, planned.loads_on_strokes
    polygons = carried_out(planned, NATURAL)
    exact = finished(planned, polygons)
    if loads or any(symbol.scope == "turn" for symbol in asked):
        from graphkin.construction.position.limits import limits_asked

        size = NATURAL.length / planned.structure.scene.size
        poses = {name: pose.scaled(size) for name, pose in polygons.paper.poses.items()}
        here = needed(planned.structure, asked), planned.values, poses
        limits = limits_asked(planned.structure, asked, *here)
        for stroke, load in loads.items():
            if stroke.pair not in limits:
                try:
                    limits |= limits_asked(planned.structure, [stroke], *here)
                except Unsolvable as stop:
                    raise load.without_stroke(stop) from None
        planned = replace(planned, limits=limits)
        exact = finished(planned, polygons)
    if planned.has_forces:
        from graphkin.construction.forces.position import acting_loads

        growing = _growing(planned, exact)
        moves = any(driver.values[1] for driver in planned.structure.scene.drivers)
        planned = replace(planned, acting=acting_loads(exact, exact if moves else growing[0]), growing=growing)
        exact = replace(exact, acting=planned.acting, growing=planned.growing)
    return replace(planned, chains=polygons.chains, plans=polygons.plans, scales=exact.scales_for(room), made=exact)


def _growing(planned: Plan, here: Sheet) -> tuple[Sheet, ...]:
    """The position with each driver's value alone growing at a unit rate, unless a single driver's motion is drawn
    already."""
    scene = planned.structure.scene.whole
    if len(scene.drivers) == 1 and scene.drivers[0].values[1]:
        return ()
    made = []
    for moving in scene.drivers:
        drivers = tuple(driver.at_rate(1.0 if driver is moving else 0.0) for driver in scene.drivers)
        other = replace(scene, drivers=drivers, loading=Loading())
        made.append(plan(other, here.drivers, (), near=here).exact)
    return tuple(made)


def execute(planned: Plan, instrument: Instrument = EXACT, own_values: OwnValues = AS_DRAWN) -> Sheet:
    """A plan drawn with an instrument; with ``own_values`` the drawing that follows from them.

    The exact drawing is in the plan already; erring hands, whose errors depend on the scale, draw it anew.
    """
    if instrument is EXACT and own_values is AS_DRAWN:
        return planned.exact.at(planned.scales)
    sheet = finished(planned, carried_out(planned, planned.scales, instrument, own_values))
    if instrument.faultless or not planned.has_forces:
        return sheet
    return replace(sheet, force_scales=planned.force_scales)


def draft(
    scene: Mechanism | Structure,
    at: Mapping[str, float] | None = None,
    find: Iterable[Symbol] | None = None,
    instrument: Instrument = EXACT,
    room: Room | None = None,
    near: Sheet | None = None,
) -> Sheet:
    """Draw a scene, or its structure: the position, both polygons, all angular rates measured.

    Parameters
    ----------
    at : driver values other than the scene's own (rad or m), by the driver's key
    find : the asked quantities (the scene's own ``find`` if None; empty: all)
    instrument : the hands that draw and read
    room : paper to fill, with scales chosen from the 1-2-2.5-5 series; None takes the scene's own scales if it gives
        them
    near : the scene drawn at other driver values, from which the motion is followed; without it from the scene's own
        position

    Raises
    ------
    Unsolvable
        wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    return execute(plan(scene, at, find, room, near), instrument)


# driven triangles


@dataclass(frozen=True, eq=False, repr=False)
class Inversion:
    """A driven triangle with its held link as the frame; its result is the value of the equivalent driver at the common
    pair of both links (rad, m).

    Parameters
    ----------
    structure : with the held link as the frame
    branch : one of its two assemblies
    """

    triangle: DrivenTriangle
    structure: Structure
    branch: int = 0

    @property
    def key(self) -> str:
        """The key of the equivalent driver at the common pair."""
        return self.triangle.equivalent.key

    def assembly(self, values: Mapping[str, float]) -> Assembly:
        """The triangle in its assembly at driver values."""
        return Assembly(values, {}, {0: self.branch})

    def placed(self, values: Mapping[str, float]) -> PlacedLinks:
        """The triangle at driver values, on paper of its size.  Raises Unsolvable."""
        mm = 1.0 / self.structure.scene.size
        return place(self.structure, self.structure.elements, mm, self.assembly(values))

    def followed(self, at_start: Mapping[str, float], values: Mapping[str, float]) -> Inversion:
        """The inversion in the assembly at some driver values, followed from the scene's own."""
        key, elements = self.triangle.driver.key, self.structure.elements
        near = Assembly({key: at_start[key]}, self.placed(at_start).poses)
        return replace(self, branch=assembly_at(self.structure, elements, {key: values[key]}, near).branches[0])

    def value(self, values: Mapping[str, float]) -> float:
        """The equivalent driver's value by exact hands.  Raises Unsolvable where the triangle cannot be assembled."""
        return self.read(self.placed(values))

    def near(self, before: float, value: float) -> float:
        """A value of the equivalent driver nearest to another: angles without whole turns."""
        turns = self.triangle.equivalent.turns
        return before + math.remainder(value - before, math.tau) if turns else value

    def read(self, paper: PlacedLinks) -> float:
        """The equivalent driver's value read from the links' poses."""
        return reading(self.structure, self.triangle.equivalent, paper.poses, paper.mm)

    def has_its_travel(self, paper: PlacedLinks) -> bool:
        """Whether the driven slide has its given travel: drawn last, it may also point the opposite way."""
        slide = self.structure.slide(self.triangle.driver.key)
        if slide.a not in paper.poses or slide.b not in paper.poses:
            return True
        return abs(travel(slide, paper.poses, paper.mm) - paper.values[slide.key] * paper.mm) < FITS

    def drawn(self, board: Board, scales: Scales, values: Mapping[str, float]) -> tuple[float, float, float]:
        """The triangle on a board of its own, with its two polygons, which are recorded on the mechanism's board as
        drawn with a link held still; its result at the common pair: value, rate and second rate (SI)."""
        alone = Plan(self.structure, self.structure, (), self.structure.elements, self.assembly(values), ())
        polygons = carried_out(alone, scales, board.instrument)
        board.causes += polygons.board.causes
        board.held_still += polygons.board.steps
        pair, other = self.triangle.pair, self.triangle.links[0]
        if pair.turns:
            rate, second = (polygons.rates[order][other].value for order in ORDERS)
        else:
            # the other link cannot turn on the held one: all its points move alike
            along = pair.along(polygons.paper.poses) * (1 if pair.a == other else -1)
            points = map(PointRef, self.structure.links[other].points)
            end = next(ref for ref in points if ref in polygons.ends["velocity"])
            rate, second = (dot(along, polygons.ends[order][end]) * scales.of(order) for order in ORDERS)
        return self.read(polygons.paper), rate, second

    def carried_over(self, motion: Sequence[float]) -> Iterator[Step]:
        """The results carried over to each diagram: value, rate and second rate (SI) at the common pair."""
        t = self.triangle
        kinds = ("angle", "omega", "alpha") if t.pair.turns else ("travel", "velocity", "acceleration")
        for diagram, kind, value in zip(DIAGRAMS, kinds, motion, strict=True):
            yield Step("carry over", "held still", diagram, held=t.held, link=t.links[0], pairs=(t.driver.key,),
                       kind=kind, value=value)


def opened_at_triangles(structure: Structure) -> Structure:
    """A structure with the parts of groups that driven triangles turn into dyads; itself without such groups."""
    parted = [group for group in structure.larger_groups if group.parts]
    if not parted:
        return structure
    instead = {t.driver: t.equivalent for group in parted for t in group.triangles}
    elements: list[Element] = []
    for e in structure.elements:
        elements += e.parts if isinstance(e, LargerGroup) and e.parts else (e,)
    scene = structure.scene
    drivers = tuple(instead.get(d, d) for d in scene.drivers)
    return replace(structure, scene=replace(scene, drivers=drivers), elements=tuple(elements))


def _held(scene: Mechanism, triangle: DrivenTriangle) -> Mechanism:
    """The links of a triangle alone, with the held link as the frame."""
    alone = without(scene, scene.by_name.keys() - {triangle.held, *triangle.links})
    links = tuple(link for link in alone.links if link.name != triangle.held)
    frame = scene.by_name[triangle.held]
    return replace(alone, frame=frame, links=links, drivers=(triangle.driver,), sketch={}, drawn={})


def own_assembly(structure: Structure, elements: Sequence[Element]) -> tuple[list[Inversion], Assembly]:
    """The assembly of a scene with driven triangles at its own position.

    Returns
    -------
    the triangles in it, and the links' poses, at all driver values with those of the equivalent drivers

    Raises
    ------
    Unsolvable : "not assembled"
    SceneError : a group has several assemblies and no sketch chooses
    """
    taken: list[Inversion] = []

    def of_group(paper: PlacedLinks, group: LargerGroup) -> Poses:
        parts = [element for element in group.parts if element in elements]
        inversions = [Inversion(t, analyse(_held(structure.scene, t))) for t in group.triangles]
        assemblies = list(_assemblies(paper, parts, inversions))
        if not assemblies:
            raise stuck("not assembled", group.named, "no assembly of the group fits together here")
        index = pick(structure.scene, group.links, [paper.fresh(poses) for _, _, poses in assemblies], None)
        triangles, paper.values, poses = assemblies[index]
        taken.extend(triangles)
        return poses

    paper = own_position(PlacedElements(structure, elements), of_group)
    return taken, Assembly(paper.values, paper.poses)


def _assemblies(
    paper: PlacedLinks, elements: Sequence[Driven | Dyad], inversions: Sequence[Inversion]
) -> Iterator[tuple[list[Inversion], Mapping[str, float], Poses]]:
    """Every assembly of the dyads of a group and of its triangles: these, the driver values with those of the
    equivalent drivers, and the poses of the group's links."""
    members = [name for element in elements for name in element.members]
    for branches in product((0, 1), repeat=len(inversions)):
        triangles = [replace(v, branch=branch) for v, branch in zip(inversions, branches, strict=True)]
        try:
            values = {**paper.values, **{v.key: v.value(paper.values) for v in triangles}}
        except Unsolvable:
            continue
        begun = PlacedLinks(paper.links, paper.mm, values, dict(paper.poses), EXACT)
        for _, drawn in each_assembly(begun, elements):
            if all(v.has_its_travel(drawn) for v in triangles):
                yield triangles, values, {name: drawn.poses[name] for name in members}
