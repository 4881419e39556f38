"""From a scene to everything drawn: position, velocity polygon, acceleration polygon."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from graphkin.drafting.asked import show
from graphkin.drafting.board import Board
from graphkin.drafting.chains import Chain
from graphkin.drafting.dyads import Frame, drive
from graphkin.drafting.instrument import EXACT, Instrument
from graphkin.drafting.plot import Order
from graphkin.drafting.polygons import Polygons
from graphkin.drafting.position import Position, branches_at, place
from graphkin.drafting.sheet import Mark, Scales, Sheet
from graphkin.drafting.slip import NO_SLIP, Slip
from graphkin.scene.model import AngleDriver, Scene
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Cluster, Driven, Dyad, Element, Structure, Turn, analyse, links_of, needed
from graphkin.words import Phrase

__all__ = ["Plan", "Room", "draft", "execute", "plan"]

SERIES = (1.0, 2.0, 2.5, 5.0)
ORDERS: tuple[Order, ...] = ("velocity", "acceleration")
SHORT = 3.0  # mm on paper; a direction drawn through two points nearer than this errs by a pencil's width in ten


@dataclass(frozen=True)
class Room:
    """Width and height (mm) that the mechanism and each polygon may fill."""

    mechanism: tuple[float, float] = (150.0, 150.0)
    polygon: tuple[float, float] = (140.0, 140.0)


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
    scales = _scales(trial, room)
    return Plan(structure, asked, tuple(elements), values, branches, scales, _stopped(wanted), trial.chains)


def execute(what: Plan, instrument: Instrument = EXACT, slip: Slip = NO_SLIP) -> Sheet:
    """Draw a plan with an instrument; with a ``slip``, what follows from it."""
    structure, elements, scales = what.structure, what.elements, what.scales
    board = Board(instrument)
    position = place(structure, elements, 1.0 / scales.length, what.values, what.branches, instrument)
    assembly = _draw_position(board, structure, elements, position, what.branches)
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
            lost.update(_members(element))
        else:
            kept.append(element)
    return kept


def _members(element: Driven | Dyad) -> tuple[str, ...]:
    if isinstance(element, Driven):
        return (element.link,)
    return tuple(n for body in element.bodies for n in body.links)


def _leans_on(element: Driven | Dyad) -> set[str]:
    if isinstance(element, Driven):
        names = {element.pair.a, element.pair.b}
        if isinstance(element.driver, AngleDriver):
            names |= {element.driver.link, element.driver.relative_to}
        return names
    return {n for pair in (element.outer_first, element.outer_second) for n in (pair.a, pair.b)}


def _draw_position(
    board: Board,
    structure: Structure,
    elements: Sequence[Driven | Dyad],
    position: Position,
    branches: Mapping[int, int],
) -> dict[str, Phrase]:
    """Record how each link was placed; returns the words for each assembly, by the group's links."""
    frame = position.frame
    ground = structure.scene.frame
    fixed = tuple(Mark(PointRef(p), frame.point(ground.name, p)) for p in ground.points)
    board.do("mechanism", Phrase("frame", (ground.name, ", ".join(ground.points))), *fixed)
    named = set(ground.points)
    assembly: dict[str, Phrase] = {}
    so_far = Frame(frame.links, frame.mm, frame.values, {ground.name: frame.poses[ground.name]})
    for i, element in enumerate(elements):
        if isinstance(element, Driven):
            _, story = drive(so_far, element)
        else:
            meeting = position.meetings[i]
            board.warn(min(meeting.sine, 1.0), _inner_name(element))
            _warn_short(board, element, frame)
            index = branches.get(i, 0) % len(meeting.poses)
            story = meeting.stories[index]
            key = ", ".join(element.links)
            assembly[key] = Phrase(
                f"{element.kind} {index}"
                if len(meeting.poses) > 1 or element.kind in ("RRR", "RRP", "RPR")
                else "one assembly",
                _assembly_names(element),
            )
        for phrase, strokes in story:
            board.do("mechanism", phrase, *strokes)
        for name in _members(element):
            so_far.poses[name] = frame.poses[name]
            fresh = [p for p in structure.links[name].points if p not in named]
            marks = tuple(Mark(PointRef(p), frame.point(name, p)) for p in fresh)
            named.update(fresh)
            if marks and len(structure.links[name].points) > 2:
                board.do("mechanism", Phrase("transfer", (name, ", ".join(fresh))), *marks)
            elif marks:
                board.do("mechanism", Phrase("points", (name, ", ".join(fresh))), *marks)
    return assembly


def _warn_short(board: Board, dyad: Dyad, frame: Frame) -> None:
    """Say where a guide is directed by two points that lie too near to each other."""
    one, two = dyad.outer_first, dyad.outer_second
    if dyad.kind == "RPR" and isinstance(one, Turn) and isinstance(two, Turn):
        apart = abs(frame.point(one.b, one.point) - frame.point(two.b, two.point))
        if apart < SHORT:
            board.note(Phrase("short arm", (", ".join(dyad.links), one.point, f"{apart:.2g}", two.point)))


def _inner_name(dyad: Dyad) -> str:
    """What the loci of a dyad find, for a remark."""
    if isinstance(dyad.inner, Turn):
        return dyad.inner.point
    return f"links {', '.join(dyad.links)}"


def _assembly_names(dyad: Dyad) -> tuple[object, ...]:
    def name(pair: object) -> str:
        return getattr(pair, "point", "") or getattr(pair, "key", "")

    return name(dyad.outer_first), name(dyad.inner), name(dyad.outer_second)


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


def _scales(polygons: Polygons, room: Room | None) -> Scales:
    """The scene's own scales, and for those it does not give the finest of the series that fit the room."""
    scene, trial = polygons.structure.scene, polygons.scales
    wishes, unit = scene.sheet, scene.units.metres
    space = room or Room()
    tips = {
        order: [0j, *(z for v in polygons.drawn[order].values() for z in (v.tail, v.tip))]
        for order in ("velocity", "acceleration")
    }
    spots = list(polygons.places.values())
    length = _fit(spots, space.mechanism, trial.length * 1e3) * 1e-3
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
