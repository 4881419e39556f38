"""From a scene to everything drawn: position, velocity polygon, acceleration polygon, and the scales that show them.

A scene is analysed once, and once carried out by exact hands, at scales of its own; every figure is that construction
at the scales that suit it: the scene's own, or those of the 1-2-2.5-5 series that fill the paper.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

from graphkin.construction.board import EXACT, Instrument
from graphkin.construction.cam_outline import outlines_on_paper
from graphkin.construction.execution import Task, carried_out, finished
from graphkin.construction.inversion import Inversion, inversions_of, opened_at_triangles, own_assembly
from graphkin.construction.links_on_paper import PlacedLinks
from graphkin.construction.net import contacts_of
from graphkin.construction.polygon_acts import Asked
from graphkin.construction.position import branches_at, rolled_position
from graphkin.construction.seen_from import vectors_seen
from graphkin.construction.sheet import DIAGRAMS, ORDERS, DiagramName, Extent, Order, Pose, Scales, Sheet, fitting_scale
from graphkin.construction.slip import NO_SLIP, Slip
from graphkin.construction.strokes import Aid, Vector
from graphkin.construction.touching import Touching
from graphkin.errors import Unsolvable
from graphkin.scene.loads import Loading
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.structure import (
    Cluster,
    Driven,
    Dyad,
    Element,
    Rolled,
    Structure,
    analyse,
    needed,
    pins_on_circles,
)
from graphkin.structure.replacement import with_cams

if TYPE_CHECKING:
    from graphkin.construction.group_position import GroupTrial
    from graphkin.construction.trial import Known

__all__ = ["Plan", "Room", "draft", "drawn_sizes", "execute", "plan", "scales_for"]

@dataclass(frozen=True)
class Room:
    """Width and height (mm) that the mechanism and each polygon may fill.

    ``others`` are rooms that may be taken instead, where their scales are so much finer (in powers of ten, of all three
    figures together) as they ``cost`` more; with ``keeps_wishes`` scales that the scene wishes for are kept in a room
    that holds them.
    """

    mechanism: tuple[float, float] = (150.0, 150.0)
    polygon: tuple[float, float] = (140.0, 140.0)
    others: tuple[Room, ...] = ()
    cost: float = 0.0
    keeps_wishes: bool = False


UNMET = 40.0  # what a wish that a room does not hold costs, as `Room.cost`
INTO_MARGIN = 1.1  # times as large as its room may trial polygons be: panels have a margin for names, and figures grow


def _chosen_scales(scene: Mechanism, extents: Mapping[DiagramName, Extent], room: Room | None) -> Scales:
    """The scene's own scales, and for those it does not give the finest of the series that fit the room."""
    fast = scene.units.rates.metres
    wanted = scene.sheet.length_scale, scene.sheet.velocity_scale, scene.sheet.acceleration_scale
    wishes = [wish * per if wish else None for wish, per in zip(wanted, (1e-3, fast, fast), strict=True)]
    space = room or Room()
    best: tuple[float, list[float]] | None = None
    for one in (space, *space.others):
        cost, scales = one.cost, []
        for name, wish in zip(DIAGRAMS, wishes, strict=True):
            most = one.mechanism if name == "mechanism" else one.polygon
            unit = scene.units.metres if name == "mechanism" else fast
            fitting = fitting_scale(extents[name], most, 1.0 / unit) * unit
            if wish is not None and (room is None or space.keeps_wishes):
                if room is None or wish * (1 + 1e-9) >= _least(extents[name], one, name):
                    scales.append(wish)
                    continue
                cost += UNMET
            scales.append(fitting)
            cost += math.log10(fitting)
        if best is None or cost < best[0] - 1e-9:
            best = cost, scales
    assert best is not None
    return Scales(*best[1])


def _least(extent: Extent, room: Room, name: DiagramName) -> float:
    """The scale (m, m/s, m/s2 for one mm) at which something just fits a room."""
    width, height = room.mechanism if name == "mechanism" else room.polygon
    return max(extent.width / width, extent.height / height)


def _extents(
    places: Iterable[complex], vectors: Callable[[Order], Iterable[Vector | Aid]], scales: Scales
) -> dict[DiagramName, Extent]:
    """Extents of the mechanism and of both polygons, pole included."""
    extents: dict[DiagramName, Extent] = {"mechanism": Extent.around(places, scales.length)}
    for order in ORDERS:
        drawn = [*vectors(order)]
        true, every = (
            Extent.around([0j, *(z for v in some for z in (v.tail, v.tip))], scales.of(order))
            for some in ([v for v in drawn if not (isinstance(v, Aid) and v.trial)], drawn)
        )
        width, height = max(true.width, every.width / INTO_MARGIN), max(true.height, every.height / INTO_MARGIN)
        extents[order] = Extent(width, height)
    return extents


def scales_for(sheet: Sheet, room: Room) -> Scales:
    """The finest scales of the series at which a sheet fits a room; vectors that only a question asks for left out."""
    return _chosen_scales(sheet.scene, _extents_of(sheet), room)


def drawn_sizes(sheet: Sheet) -> tuple[tuple[float, float], ...]:
    """Width and height (mm) of the mechanism and of both polygons as they are drawn, as scales are chosen by them."""
    extents = _extents_of(sheet)
    return tuple(
        (extents[name].width / sheet.scales.of(name), extents[name].height / sheet.scales.of(name)) for name in DIAGRAMS
    )


def _leading_on(sheet: Sheet, order: Order) -> list[Aid]:
    """What must find room although it only leads on: vectors seen from held links, and trial polygons."""
    return [*vectors_seen(sheet, order), *sheet.trials(order)]


def _extents_of(sheet: Sheet) -> dict[DiagramName, Extent]:
    def vectors(order: Order) -> Iterator[Vector | Aid]:
        for step in sheet.steps:
            if step.diagram == order and not isinstance(step.act, Asked):
                yield from (s for s in step.strokes if isinstance(s, Vector))
        yield from _leading_on(sheet, order)

    outlines = outlines_on_paper(sheet.scene, sheet.poses, 1.0 / sheet.scales.length)
    places = [*sheet.points.values(), *(z for o in outlines.values() for z in o)]
    places += Touching(sheet.scene, 1.0 / sheet.scales.length, sheet.poses).outermost()
    return _extents(places, vectors, sheet.scales)


NATURAL = Scales(1e-3, 1e-3, 1e-3)  # 1 mm of paper for 1 mm, 1 mm/s, 1 mm/s2


@dataclass(frozen=True)
class Plan(Task):
    """A task as exact hands carry it out, and the scales of its figures.

    ``exact`` is that construction, once for all figures, at scales of its own; ``extents`` are those of its figures,
    vectors that only a question asks for left out.
    """

    scales: Scales
    exact: Sheet
    extents: Mapping[DiagramName, Extent]

    def scales_for(self, room: Room | None) -> Scales:
        """The scales that fill a room; without one the scene's own where it gives them."""
        return _chosen_scales(self.structure.scene, self.extents, room)

    def with_branches(self, branches: Mapping[int, int]) -> Plan:
        """The same task in another assembly, at the same scales.  Raises Unsolvable where it cannot be drawn."""
        return replace(_planned(replace(self, branches=branches, chains={}, plans={}), None), scales=self.scales)

    def at_contacts(self) -> Plan | None:
        """The same task with sliding contacts, or rollers, edges and faces of cams, drawn at the contact itself instead
        of by what replaces them, at scales that suit it; None where there is none, or where one lies in a pivot."""
        whole = self.structure.scene.instead_of
        if whole is None:
            scene = self.structure.scene
            if all(slot.block for slot in scene.slots):
                return self._touching()
            size = self.exact.scales.length
            poses = {name: (pose.origin * size, pose.axis) for name, pose in self.exact.poses.items()}
            drivers = tuple(d.at_value(self.values[d.key]) for d in scene.drivers)
            other = plan(replace(pins_on_circles(scene, poses), drivers=drivers), None, self.asked)
            return other._touching() or other
        barred = any(slot.bar not in whole.by_name for slot in self.structure.scene.slots)
        if not barred and not whole.contacts and not any(cam.flat for cam in whole.cams):
            return None
        other = plan(whole, self.values, self.asked, bars=False)
        return other._touching() or (other if barred else None)

    def _touching(self) -> Plan | None:
        """The same task with its sliding contacts drawn themselves, as far as it has any."""
        touching = {e for e in self.elements if not isinstance(e, Driven) and contacts_of(self.structure, e)}
        if not touching:
            return None
        chains = {dyad: chain for dyad, chain in self.chains.items() if dyad not in touching}
        other = replace(self, chains=chains, plans={}, touching=True)
        try:
            made = carried_out(other, NATURAL)
        except Unsolvable:  # a contact at a pivot, which turns nothing there
            return None
        exact = finished(other, made)
        extents = _extents_of(exact)
        return replace(
            other, exact=exact, extents=extents, scales=_chosen_scales(self.structure.scene, extents, None),
            chains=made.polygons.chains, plans=made.polygons.plans,
        )  # fmt: skip


def plan(
    scene: Mechanism | Structure,
    at: Mapping[str, float] | None = None,
    find: Iterable[Symbol] | None = None,
    room: Room | None = None,
    near: Sheet | None = None,
    follows: Plan | None = None,
    bars: bool = True,
) -> Plan:
    """Decide what to draw, and carry it out exactly; parameters and errors as for `draft`.

    ``follows`` is the same task at another position: the assembly is followed from there, which is shorter than from
    the scene's own.  With ``bars`` these stand for rollers and edges of cams, else pins on the pitch curves.
    """
    structure = analyse(with_cams(scene))
    scene = structure.scene
    asked = tuple(scene.find if find is None else find)
    if scene.cams:
        from graphkin.construction.cams_in_place import cams_in_place

        structure = cams_in_place(structure, {d.key: d.values[0] for d in scene.drivers} | dict(at or {}), bars)
        scene = structure.scene
    opened = opened_at_triangles(structure)
    if any(isinstance(e, Cluster) for e in needed(opened, asked)):
        opened = structure  # groups that remain are found by trial, driven triangles with them
    elements = tuple(needed(opened, asked))
    own = {d.key: d.values[0] for d in scene.drivers}
    values = own | {key: value for key, value in (at or {}).items() if key in own}
    if any(isinstance(e, Cluster) for e in elements):
        branches, trials, rolled = _by_trial(structure, elements, values, near)
        values |= rolled
        task = Task(structure, structure, asked, elements, values, branches, trials, {}, {}, (), {}, {}, ())
        return _planned(task, room)
    dyads = [e for e in elements if isinstance(e, Driven | Dyad)]
    if any(isinstance(e, Driven) and isinstance(e.driver, Rolled) for e in elements):
        values, branches = rolled_position(structure, elements, own, values)
        task = Task(structure, structure, asked, elements, values, branches, {}, {}, {}, (), {}, {}, ())
        return _planned(task, room)
    inversions = inversions_of(structure)
    triangles: tuple[tuple[Inversion, int], ...] = ()
    chosen = None
    if inversions:
        taken, own, chosen = own_assembly(structure, opened, dyads, inversions, own)
        triangles = tuple((v, v.branch(own, values, taken[v.key])) for v in inversions if v.key in taken)
        values |= {v.key: v.near(own[v.key], v.value(values, branch)) for v, branch in triangles}
    keys = [d.key for d in opened.scene.drivers]
    if follows is not None and not inversions and follows.elements == elements:
        own, chosen = dict(follows.values), dict(follows.branches)
    branches = branches_at(opened, elements, {k: values[k] for k in keys}, {k: own[k] for k in keys}, chosen)
    return _planned(Task(structure, opened, asked, elements, values, branches, {}, {}, {}, triangles, {}, {}, ()), room)


def _by_trial(
    structure: Structure, elements: Sequence[Element], values: Mapping[str, float], near: Sheet | None
) -> tuple[dict[int, int], dict[Cluster, GroupTrial], dict[str, float]]:
    """The assembly of each dyad, by what trial positions each larger group is placed, and how far what rolls on them
    has gone (rad, m)."""
    from graphkin.construction.follow import Choices
    from graphkin.construction.group_position import nearest_assembly
    from graphkin.construction.touching import coordinate_on_paper
    from graphkin.construction.trial import found_by_trial

    choices = Choices(structure, elements)
    poses = found_by_trial(choices, elements, values, None if near is None else _known(near))
    scene = structure.scene
    at_start = all(values[d.key] == d.values[0] for d in scene.drivers)
    there = choices.at_start if at_start else choices
    starts = {d.key: d.values[0] for d in there.structure.scene.drivers if d.key not in values}
    placed = structure.followed(values) | starts
    frame = PlacedLinks(structure.links, 1.0 / scene.size, placed, {scene.frame.name: Pose(0j, 1 + 0j)})
    branches, trials = nearest_assembly(choices, elements, frame, poses, there if at_start else None)
    rolling = [e.driver for e in elements if isinstance(e, Driven) and isinstance(e.driver, Rolled)]
    rolled = {r.key: coordinate_on_paper(structure, frame, r.coordinate) for r in rolling}
    return branches, trials, starts | rolled


def _known(sheet: Sheet) -> Known:
    """A sheet as a position to start from."""
    size = sheet.scales.length / sheet.scene.size
    return sheet.drivers, {name: pose.scaled(size) for name, pose in sheet.poses.items()}


def _planned(task: Task, room: Room | None) -> Plan:
    made = carried_out(task, NATURAL)
    polygons = made.polygons
    size = NATURAL.length / task.structure.scene.size
    poses = {name: pose.scaled(size) for name, pose in polygons.frame.poses.items()}
    exact = finished(task, made)
    asked = task.asked
    if exact.has_forces:
        from graphkin.construction.forces.known import acting_loads, strokes_of_loads

        asked = (*asked, *strokes_of_loads(task.structure))
    if any(symbol.scope == "turn" for symbol in asked):
        from graphkin.construction.limits import limits_asked

        found = limits_asked(task.structure, needed(task.structure, task.asked), asked, task.values, poses)
        task = replace(task, limits=found)
        exact = finished(task, made)
    if exact.has_forces:
        growing = _growing(task, exact)
        moves = any(driver.values[1] for driver in task.structure.scene.drivers)
        task = replace(task, acting=acting_loads(exact, exact if moves else growing[0]), growing=growing)
        exact = replace(exact, acting=task.acting, growing=task.growing)
    places = [z for p, z in polygons.places.items() if p not in polygons.special]
    for profile in outlines_on_paper(task.structure.scene, polygons.frame.poses, 1.0 / NATURAL.length).values():
        places += profile
    places += Touching(task.structure.scene, 1.0 / NATURAL.length, polygons.frame.poses).outermost()
    extents = _extents(places, lambda order: (*polygons.shown_of(order), *_leading_on(exact, order)), NATURAL)
    own = {f.name: getattr(task, f.name) for f in fields(Task)} | {"chains": polygons.chains, "plans": polygons.plans}
    scales = _chosen_scales(task.structure.scene, extents, room)
    return Plan(**own, scales=scales, exact=exact, extents=extents)


def _growing(task: Task, here: Sheet) -> tuple[Sheet, ...]:
    """The position with each driver's value alone growing at a unit rate, where one driver's motion alone is not drawn
    already."""
    scene = task.structure.scene.instead_of or task.structure.scene
    if len(scene.drivers) == 1 and scene.drivers[0].values[1]:
        return ()
    made = []
    for moving in scene.drivers:
        drivers = tuple(driver.at_rate(1.0 if driver is moving else 0.0) for driver in scene.drivers)
        other = replace(scene, drivers=drivers, loading=Loading())
        made.append(plan(other, here.drivers, (), near=here).exact)
    return tuple(made)


def execute(what: Plan, instrument: Instrument = EXACT, slip: Slip = NO_SLIP) -> Sheet:
    """A plan drawn with an instrument; with a ``slip``, what follows from it.

    What exact hands draw stands in the plan already; finite ones, whose errors depend on the scale, draw it anew.
    """
    if instrument is EXACT and slip is NO_SLIP:
        return what.exact.at(what.scales)
    return finished(what, carried_out(what, what.scales, instrument, slip))


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
    find : what is asked (the scene's own ``find`` if None; empty: everything)
    instrument : what draws and reads
    room : paper to fill, with scales chosen from the 1-2-2.5-5 series; None takes the scene's own scales where it
        gives them
    near : everything drawn at other driver values already, from where a mechanism with larger groups is followed;
        without it from the scene's own

    Raises
    ------
    Unsolvable
        wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    return execute(plan(scene, at, find, room, near), instrument)
