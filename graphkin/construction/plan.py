"""The scales of a sheet: the scene's own, or those of the 1-2-2.5-5 series that fill the paper.

What is to be drawn for what is asked, and at which scales.

From a scene to everything drawn: position, velocity polygon, acceleration polygon.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from graphkin.construction.asked import show
from graphkin.construction.board import EXACT, Board, Instrument
from graphkin.construction.equations import Chain
from graphkin.construction.plot import Order
from graphkin.construction.polygons import Polygons
from graphkin.construction.position import branches_at, draw_position, place
from graphkin.construction.sheet import Scales, Sheet
from graphkin.construction.slip import NO_SLIP, Slip
from graphkin.scene.model import AngleDriver, Scene
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Cluster, Driven, Dyad, Element, Structure, analyse, links_of, needed
from graphkin.words import Phrase

__all__ = ["ORDERS", "Plan", "Room", "chosen_scales", "draft", "execute", "plan"]

SERIES = (1.0, 2.0, 2.5, 5.0)


@dataclass(frozen=True)
class Room:
    """Width and height (mm) that the mechanism and each polygon may fill; ``larger`` are rooms that the mechanism has
    instead where it can be drawn twice as large in them, the first such."""

    mechanism: tuple[float, float] = (150.0, 150.0)
    polygon: tuple[float, float] = (140.0, 140.0)
    larger: tuple[tuple[float, float], ...] = ()


def chosen_scales(polygons: Polygons, room: Room | None) -> Scales:
    """The scene's own scales, and for those it does not give the finest of the series that fit the room."""
    scene, trial = polygons.structure.scene, polygons.scales
    wishes, unit = scene.sheet, scene.units.metres
    space = room or Room()
    tips = {
        order: [0j, *(z for v in polygons.drawn[order].values() for z in (v.tail, v.tip))]
        for order in ("velocity", "acceleration")
    }
    spots = list(polygons.places.values())
    rooms = (space.mechanism, *space.larger)
    lengths = [_fit(spots, room_of_it, trial.length * 1e3) * 1e-3 for room_of_it in rooms]
    length = next((finer for finer in lengths if 2.0 * finer <= lengths[0] * (1 + 1e-9)), lengths[0])
    velocity = _fit(tips["velocity"], space.polygon, 1.0 / unit) * unit
    acceleration = _fit(tips["acceleration"], space.polygon, 1.0 / unit) * unit
    if room is None:
        length = wishes.length_scale * 1e-3 if wishes.length_scale else length
        velocity = wishes.velocity_scale * unit if wishes.velocity_scale else velocity
        acceleration = wishes.acceleration_scale * unit if wishes.acceleration_scale else acceleration
    return Scales(length, velocity, acceleration)


def _fit(points: Sequence[complex], room: tuple[float, float], per_mm: float) -> float:
    """The finest scale of the series at which points given at ``per_mm`` fit the room; 1 if they span nothing."""
    if not points:
        return 1.0
    width = max(z.real for z in points) - min(z.real for z in points)
    height = max(z.imag for z in points) - min(z.imag for z in points)
    least = max(width / room[0], height / room[1]) * per_mm
    if not math.isfinite(least) or least <= 0.0:
        return 1.0
    decade = 10.0 ** math.floor(math.log10(least))
    for step in (*SERIES, 10.0):
        if step * decade >= least * (1 - 1e-12):
            return float(f"{step * decade:.12g}")
    return 10.0 * decade


ORDERS: tuple[Order, ...] = ("velocity", "acceleration")


@dataclass(frozen=True)
class Plan:
    """What is to be drawn, at which position and scales, in which assembly, and by which equation for each dyad."""

    structure: Structure
    asked: tuple[Symbol, ...]
    elements: tuple[Driven | Dyad, ...]
    values: Mapping[str, float]
    branches: Mapping[int, int]
    scales: Scales
    stopped: Phrase | None
    chains: Mapping[Dyad, Chain] = field(default_factory=dict)

    @cached_property
    def drawn(self) -> Mapping[Order, tuple[Driven | Dyad, ...]]:
        """What each polygon needs for what is asked: accelerations only of what leads to accelerations."""
        return {order: _drawn(self.structure, self.elements, self.asked, order) for order in ORDERS}

    @cached_property
    def left_out(self) -> tuple[Phrase, ...]:
        """What nothing asked for needs."""
        wanted = needed(self.structure, self.asked)
        placed = {n for e in self.elements for n in links_of(e)}
        pushed = {n for e in self.drawn["acceleration"] for n in links_of(e)}
        gone = {n for e in self.structure.elements if e not in wanted for n in links_of(e)}
        names = [link.name for link in self.structure.scene.links]
        without = [n for n in names if n in gone], [n for n in names if n in placed - pushed]
        keys = "left out elements", "left out accelerations"
        return tuple(Phrase(key, (", ".join(links),)) for key, links in zip(keys, without, strict=True) if links)


def _drawn(
    structure: Structure, elements: Sequence[Driven | Dyad], asked: Sequence[Symbol], order: Order
) -> tuple[Driven | Dyad, ...]:
    if order == "velocity" or not asked:
        return tuple(elements)
    pushes = [s for s in asked if s.kind not in ("v", "omega")]
    wanted = needed(structure, pushes) if pushes else []
    return tuple(e for e in elements if e in wanted)


def plan(
    scene: Scene,
    at: Mapping[str, float] | None = None,
    find: Iterable[Symbol] | None = None,
    room: Room | None = None,
) -> Plan:
    """Decide what to draw; parameters and errors as for `draft`."""
    structure = analyse(scene)
    asked = tuple(scene.find if find is None else find)
    wanted = needed(structure, asked)
    elements = _drawable(wanted)
    values = {d.key: d.values[0] for d in scene.drivers} | dict(at or {})
    branches = branches_at(structure, elements, values)
    orders = {order: _drawn(structure, elements, asked, order) for order in ORDERS}
    trial = _trial(structure, orders, values, branches)
    scales = chosen_scales(trial, room)
    return Plan(structure, asked, tuple(elements), values, branches, scales, _stopped(wanted), trial.chains)


def _stopped(elements: Sequence[Element]) -> Phrase | None:
    """Which group compass and ruler cannot draw, and why."""
    for e in elements:
        if isinstance(e, Cluster):
            return Phrase("stopped", (", ".join(e.links), e.order))
    return None


def _drawable(elements: Sequence[Element]) -> list[Driven | Dyad]:
    """The elements that need no larger group."""
    lost: set[str] = set()
    kept: list[Driven | Dyad] = []
    for element in elements:
        if isinstance(element, Cluster):
            lost.update(element.members)
        elif lost & _leans_on(element):
            lost.update(links_of(element))
        else:
            kept.append(element)
    return kept


def _leans_on(element: Driven | Dyad) -> set[str]:
    if isinstance(element, Driven):
        names = {element.pair.a, element.pair.b}
        if isinstance(element.driver, AngleDriver):
            names |= {element.driver.link, element.driver.relative_to}
        return names
    return {n for pair in (element.outer_first, element.outer_second) for n in (pair.a, pair.b)}


def _trial(
    structure: Structure,
    drawn: Mapping[Order, Sequence[Driven | Dyad]],
    values: Mapping[str, float],
    branches: Mapping[int, int],
) -> Polygons:
    """Both polygons drawn once at any scale, to see how large they come out."""
    trial = Scales(structure.scene.size / 100.0, 1.0, 1.0)
    frame = place(structure, drawn["velocity"], 1.0 / trial.length, values, branches).frame
    polygons = Polygons(Board(EXACT), structure, frame, trial)
    for order in ORDERS:
        for element in drawn[order]:
            polygons.draw(order, element)
    return polygons


def execute(what: Plan, instrument: Instrument = EXACT, slip: Slip = NO_SLIP) -> Sheet:
    """Draw a plan with an instrument; with a ``slip``, what follows from it."""
    structure, elements, scales = what.structure, what.elements, what.scales
    board = Board(instrument)
    position = place(structure, elements, 1.0 / scales.length, what.values, what.branches, instrument)
    assembly = draw_position(board, structure, elements, position, what.branches)
    board.causes[:] = position.causes
    polygons = Polygons(board, structure, position.frame, scales, slip)
    polygons.chains.update(what.chains)
    for order in ORDERS:
        for element in what.drawn[order]:
            polygons.draw(order, element)
    show(polygons, what.asked)
    return Sheet(
        scene=structure.scene,
        structure=structure,
        instrument=instrument.name,
        drivers=what.values,
        scales=scales,
        poses=dict(position.frame.poses),
        points={PointRef(p): z for p, z in polygons.places.items()},
        ends={order: dict(ends) for order, ends in polygons.ends.items()},
        omega=dict(polygons.rates["velocity"]),
        alpha=dict(polygons.rates["acceleration"]),
        steps=tuple(board.steps),
        equations=tuple(board.equations),
        assembly=assembly,
        notes=tuple(board.notes),
        stopped=what.stopped,
        left_out=what.left_out,
        causes=tuple(board.causes),
    )


def draft(
    scene: Scene,
    at: Mapping[str, float] | None = None,
    find: Iterable[Symbol] | None = None,
    instrument: Instrument = EXACT,
    room: Room | None = None,
) -> Sheet:
    """Draw a scene: the position, both polygons, all angular rates measured.

    Parameters
    ----------
    at : driver values other than the scene's own (rad or m), by the driver's key
    find : what is asked (the scene's own ``find`` if None; empty: everything)
    instrument : what draws and reads
    room : paper to fill, with scales chosen from the 1-2-2.5-5 series; None takes the scene's own scales where it
        gives them

    Raises
    ------
    Unsolvable
        wrong mobility, a position that cannot be assembled or reached, a dead point.  A group larger than a dyad is no
        error: ``Sheet.stopped`` says which it is, and what stands before it is drawn.
    """
    return execute(plan(scene, at, find, room), instrument)
