"""Exact values by symbol: of the motion, of the whole turn, of forces and moments, and of the flywheel that keeps a
machine even; and a motion as plain data for programs, in the scene's length unit.

The driving moment on a flywheel is constant and does in a cycle the work of the balance: where it is less than the
balance needs, kinetic energy falls, where it is more, it rises.  The greatest difference of the energy is the excess
work W, and a flywheel of J_F = W / (delta omega^2) keeps the coefficient of speed fluctuation (Sun Huan, Mechanical
Principles, ch. 7; Norton, Design of Machinery, ch. 11).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import islice, pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from graphkin.errors import CallError, Problem, Unsolvable
from graphkin.files import Json
from graphkin.files import json_text as one_line
from graphkin.scene.model import Mechanism, no_force
from graphkin.scene.scene_tables import LoadPhase
from graphkin.scene.symbol import Symbol, Value
from graphkin.solver.algebra.pose import Array, Pose, aimed
from graphkin.solver.mobility import structure_of
from graphkin.solver.motion import SLIGHT, Motion, listed_points, own_slides
from graphkin.solver.path.driver_range import DriverRange, extremes, range_of
from graphkin.solver.quantities import value_of_symbol
from graphkin.structure import Structure, kept_with, links_for, part_of
from graphkin.words import Phrase, Wording, listed, say

if TYPE_CHECKING:
    from graphkin.solver.forces import Forces
    from graphkin.solver.touching import Measure


def exact_values(motion: Motion, symbols: Iterable[Symbol]) -> dict[Symbol, Value]:
    """The exact values of quantities at the single position of a motion (SI), also of the whole turn.

    Raises
    ------
    CallError : a symbol names nothing here
    Unsolvable : a quantity of the whole turn without a whole turn, a force at a dead point
    """
    posed, values = motion.posed, dict[Symbol, Value]()
    for symbol, scope in {symbol: symbol.scope for symbol in symbols}.items():
        if scope == "turn":
            values[symbol] = _of_turn(motion, symbol)
        elif scope == "force" and no_force(motion.scene.whole, str(symbol), symbol) is None:
            values[symbol] = _of_forces_here(motion, symbol)
        elif scope == "cycle":
            values[symbol] = float(of_cycle(motion, symbol)[0])
        else:
            if scope == "force" or symbol.axis:
                from graphkin.solver.forces import value_of

                exact = value_of(motion, symbol)[0]
            else:
                exact = value_of_symbol(posed, symbol)[0]
            if symbol.kind == "d" and math.isnan(exact):  # the centre of links at rest: that of any motion
                exact = motion.value(symbol)[0]
            values[symbol] = complex(exact) if np.iscomplexobj(exact) else float(exact)
    return values


def of_cycle(motion: Motion, symbol: Symbol) -> Array:
    """The excess work (J) or the moment of inertia of the flywheel (kg m2), the same at all positions: shape (n,).

    Raises
    ------
    CallError : the scene has no flywheel
    Unsolvable : the driver makes no whole turn
    """
    problem = no_force(motion.scene, str(symbol), symbol)
    if problem is not None:
        raise CallError(problem)
    wheel = flywheel_of(range_of(structure_of(motion.structure)))
    return np.full(len(motion), wheel.excess if symbol.kind == "excess" else wheel.inertia)


def _of_turn(motion: Motion, symbol: Symbol) -> float:
    """A quantity of the whole turn of the first driver, the others at the single position of a motion."""
    values = motion.scene.by_driver(motion.values[0])
    turn = extremes(range_of(structure_of(motion.structure), values), symbol)
    return {"K": turn.ways.ratio, "theta_lag": turn.ways.lag}.get(symbol.kind, turn.stroke)


@kept_with
def forces_here(motion: Motion) -> Forces:
    """The forces at the single position of a motion.

    Raises
    ------
    Unsolvable : "dead point": the balance does no work
    """
    from graphkin.solver.forces import forces_of, without_line

    whole = motion.scene.whole  # the mechanism with cams itself, where another replaces it; the links move alike
    forces = forces_of(motion if whole is motion.scene else replace(motion, structure=structure_of(whole)))
    for spring, where in without_line(forces.motion).items():
        if where[0]:
            raise Unsolvable("dead point", Problem(spring.where, "its two points coincide in this position so",
                                                   "move the driver off this position"))
    if not forces.ok[0]:
        drivers = listed([d.key for d in motion.scene.drivers])
        raise Unsolvable("dead point", Problem(Phrase("driver of driver", driver=drivers),
                                               "the balance does no work in this position of nothing",
                                               "move the driver or ask for the motion alone"))
    return forces


class Lost(NamedTuple):
    """The rounding errors of the places and vectors that lead to a quantity (m, m/s, m/s2, N); ``slight`` where they
    are so small beside the motion of the drivers that a value below them is 0."""

    mechanism: float = 0.0
    velocity: float = math.inf
    acceleration: float = math.inf
    force: float = 0.0
    slight: bool = True


def rounding_of(motion: Motion, symbols: Iterable[Symbol], of_forces: bool = False) -> dict[Symbol, Lost]:
    """The rounding errors of exact values at the single position of a motion; those ``of_forces`` where these are
    compared too.

    Where they are more than slight beside the motion of the drivers they are given for the links of each quantity: near
    a dead point of one group the links before it stay certain.

    Raises
    ------
    Unsolvable : "dead point": the balance does no work
    """
    force = float(forces_here(motion).bound[0][0]) if of_forces else 0.0
    size = motion.structure.scene.size
    rate, second = (float(driven[0]) for driven in motion.driven)

    def lost(position: Array, velocity: Array, acceleration: Array) -> Lost:
        place, v, a = float(np.nan_to_num(position[0], posinf=0.0)), float(velocity[0]), float(acceleration[0])
        return Lost(place, v, a, force, v <= SLIGHT * rate * size and a <= SLIGHT * second * size)

    whole = lost(motion.bound.position, *motion.rates_in_double)

    rounding = dict.fromkeys(symbols, whole)
    for symbol in () if whole.slight else [symbol for symbol in rounding if symbol.scope != "force"]:
        with suppress(CallError):  # a special point of the drawing
            rounding[symbol] = lost(*motion.bounds_in_double(links_for(motion.structure, symbol)))
    return rounding


def _of_forces_here(motion: Motion, symbol: Symbol) -> Value:
    """A force (N), moment (N m), shift of an inertia force (m) or arm on Zhukovsky's lever (m/s: the power of a force
    over its size) at the single position of a motion; of a mechanism at rest an arm belongs to a unit rate of the
    driver.

    Raises
    ------
    Unsolvable : "dead point": the balance does no work
    """
    forces = forces_here(motion)
    if symbol.kind == "h":
        force, moment = (forces.values[Symbol(kind, link=symbol.link)][0] for kind in ("Fi", "Mi"))
        return float(moment / abs(force)) if force else 0.0
    if symbol.kind == "arm":
        return _arm(forces.motion.growing, forces, Symbol.parse(symbol.name))
    known = forces.value(symbol)
    return math.nan if known is None else complex(known[0]) if symbol.is_vector else float(known[0])


def as_drawn(motion: Motion, structure: Structure) -> Motion:
    """A motion at one position, with the blocks and points of the replacing mechanism; itself where no mechanism
    replaces it."""
    solved = motion.structure.scene
    if len(solved.drivers) < len(structure.scene.drivers):  # solved for what leads to the asked alone
        structure = structure_of(part_of(structure, solved.question.find))
    if structure is motion.structure or (
        structure.scene.instead_of is None and structure.links.keys() == motion.structure.links.keys()
    ):
        return motion
    poses = dict(motion.poses)
    for slide in structure.slides:
        if slide.a in poses or not poses.keys() >= {slide.of, slide.b}:
            continue  # a slide of the scene's own, or nothing asks for it
        at = poses[slide.of].fixed(structure.links[slide.of].points[slide.pin])
        guide = poses[slide.b]
        turn = np.asarray(guide.u * slide.guide.direction)
        poses[slide.a] = Pose(at.z, turn, at.v, guide.omega, at.a, guide.alpha)
    for bar, path in structure.scene.replacing.items():
        if bar in poses or bar not in structure.links or path.on not in poses:
            continue
        held = [n for n in structure.hinges.get(path.point, ()) if n != bar and n in poses]
        if not held:
            continue  # nothing asks for it
        holder = held[0]
        start = poses[path.on].fixed(structure.links[path.on].points[path.centre])
        end = poses[holder].fixed(structure.links[holder].points[path.point])
        poses[bar] = aimed(start, end)
    return replace(motion, structure=structure, poses=poses)


def _arm(moving: Motion, forces: Forces, of: Symbol) -> float:
    """The component of a point's velocity along its force; for a balancing force along its line, positive in the line's
    own sense."""
    from graphkin.solver.forces import actions, balances

    for balance in balances(moving):
        if balance.symbol == of:
            return float(balance.power(moving)[0])
    force = forces.values[of] if forces.values[of][0] else forces.beside.get(of, forces.values[of])
    acting = next(action for action in actions(moving) if action.symbol == of)
    return float(replace(acting, value=force).power(moving)[0] / abs(force[0])) if force[0] else 0.0


PANEL = np.radians(10.0)
"""Between two edges of loads the moment is smooth: over so much of the driver twelve nodes give its work to the last
digits (Gauss and Legendre)."""
NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)


@dataclass(frozen=True, eq=False, repr=False)
class FlywheelStudy:
    """A flywheel on a link.

    driving : constant driving moment on the driver (N m), in its sense positive
    work : of a cycle (J)
    areas : between driving and needed moment, over a cycle from the start on: the work of the driving moment less that
        of the needed one (J), by the offsets of the driver at two crossings
    excess : the greatest difference of kinetic energy (J)
    slowest, fastest : offsets of the driver at the least and the greatest speed
    speed : mean angular velocity of the link (rad/s)
    inertia : of the flywheel (kg m2)
    """

    link: str
    delta: float
    driving: float
    work: float
    areas: Mapping[tuple[float, float], float]
    excess: float
    slowest: float
    fastest: float
    speed: float
    inertia: float


def needed_moment(reach: DriverRange, offset: Array) -> Array:
    """The balance as a moment on the driver, positive in its sense (N m), shape (n,)."""
    from graphkin.solver.forces import forces_of

    motion, moved = reach.motion(offset), reach.motion(offset, unit=True, extended=False)
    forces = forces_of(motion)
    return np.asarray(np.sum([balance.power(moved) for balance in forces.balancing], axis=0))


NO_WORK = 1e-12
"""Of the work done and taken in a cycle: a sum that is less is nothing but rounding."""


@kept_with
def flywheel_of(reach: DriverRange) -> FlywheelStudy:
    """The flywheel that a scene asks for.

    Raises
    ------
    Unsolvable : the driver makes no whole turn, the link does not turn on and on, or the mechanism is at rest
    """
    wanted = reach.scene.loading.flywheel
    assert wanted is not None
    if not reach.driver.turns or not reach.full or len(reach.scene.drivers) > 1:
        raise _without(Phrase("the mechanism runs through no cycle one driver"), Phrase("leave flywheel out"))
    speed = _mean_speed(reach, wanted.on)
    if not speed:
        rests = not reach.driver.rate
        found = Phrase("the driver rests") if rests else Phrase("link does not turn on and on", link=wanted.on)
        raise _without(found, Phrase("give it a speed") if rests else Phrase("put the flywheel on one that does"))
    edges = _panels(reach)
    work = _work(reach, edges[:-1], edges[1:])
    if not np.isfinite(work).all():
        raise _without(Phrase("the balance does no work in some position"), Phrase("balance at the driver"))
    cycle = float(edges[-1] - edges[0])
    driving = float(work.sum()) / cycle
    driving = 0.0 if abs(driving) * cycle < NO_WORK * float(np.abs(work).sum()) else driving
    crossings = _balanced(reach, edges, driving)
    places = np.array(sorted({0.0, cycle, *crossings}))
    stored = np.concatenate([[0.0], np.cumsum(driving * np.diff(edges) - work)])
    energy = np.array([_stored(reach, edges, stored, driving, x) for x in places])
    areas = dict(zip(pairwise(places.tolist()), np.diff(energy).tolist(), strict=True))
    low, high = int(np.argmin(energy)), int(np.argmax(energy))
    excess = float(energy[high] - energy[low])
    inertia = excess / (wanted.delta * speed**2)
    return FlywheelStudy(
        wanted.on, wanted.delta, driving, driving * cycle, areas, excess, float(places[low]), float(places[high]),
        speed, inertia,
    )


def _without(found: Wording, wanted: Wording) -> Unsolvable:
    return Unsolvable("no flywheel", Problem("flywheel", found, wanted))


def _mean_speed(reach: DriverRange, link: str) -> float:
    """Mean angular velocity of a link over a cycle (rad/s)."""
    turned = float(np.diff(reach.angle(reach.at_ends, link))[0])
    driver = reach.driver
    return float(np.rint(turned / (2 * np.pi)) * 2 * np.pi / abs(reach.wide) * abs(driver.rate))


def _panels(reach: DriverRange) -> Array:
    """Ends of panels over one cycle, edges of loads among them."""
    low, high = reach.ends
    hard = np.unique(np.concatenate([[low, high], np.clip(load_edges(reach), low, high)]))
    parts = [np.linspace(a, b, int(np.ceil((b - a) / PANEL)) + 1)[:-1] for a, b in pairwise(hard.tolist())]
    return np.concatenate([*parts, [high]])


def _work(reach: DriverRange, first: Array, last: Array) -> Array:
    """The work of the balance over panels (J)."""
    half = (last - first) / 2
    nodes = (first + last)[:, None] / 2 + half[:, None] * NODES
    needed = needed_moment(reach, nodes.ravel()).reshape(nodes.shape)
    return np.asarray((needed * WEIGHTS).sum(axis=1) * half)


def _balanced(reach: DriverRange, edges: Array, driving: float) -> list[float]:
    """The offsets at which the needed moment crosses the driving one, jumps across it included."""
    from graphkin.search import changes

    inside = (edges[:-1, None] + np.diff(edges)[:, None] * np.linspace(1e-6, 1 - 1e-6, 24)).ravel()
    crossed = changes(lambda offset: needed_moment(reach, offset) > driving, inside, within=1e-9)
    nearest = [float(edges[np.argmin(np.abs(edges - offset))]) for offset in crossed]
    # between an edge and the first place inside beside it
    return [edge if abs(edge - offset) < 2e-6 else offset for edge, offset in zip(nearest, crossed, strict=True)]


def _stored(reach: DriverRange, edges: Array, stored: Array, driving: float, at: float) -> float:
    """Kinetic energy gained since the start (J)."""
    k = min(int(np.searchsorted(edges, at, side="right")) - 1, len(edges) - 2)
    rest = float(_work(reach, edges[k : k + 1], np.array([at]))[0])
    return float(stored[k] + driving * (at - edges[k]) - rest)

SAMPLES = 720


def load_edges(reach: DriverRange) -> Array:
    """The offsets at which a load begins, ends or reverses, in increasing order, the ends of the range included.

    Raises
    ------
    Unsolvable : a load acts on a part of a stroke, and the driver makes no whole turn
    """
    low, high = reach.ends
    edges: list[float] = []
    for load in reach.scene.loading.loads:
        if load.against:
            edges += _crossings(reach, _speed(reach, load.against))
        if load.phase is not None:
            try:
                edges += _begins_and_ends(reach, load.phase)
            except Unsolvable as stop:
                raise load.without_stroke(stop) from None
    kept = sorted(offset for offset in edges if low - 1e-9 <= offset <= high + 1e-9)
    least = 1e-9 * (high - low)
    return np.array([x for i, x in enumerate(kept) if i == 0 or x - kept[i - 1] > least])


def _begins_and_ends(reach: DriverRange, phase: LoadPhase) -> Iterator[float]:
    (low, high), stroke = reach.ends, phase.stroke
    if not stroke:
        for value in (phase.start, phase.end):
            at = float(reach.sense * (value - reach.start[0]))
            if reach.driver.turns:
                first = at + np.ceil((low - 1e-9 - at) / (2 * np.pi)) * 2 * np.pi
                yield from np.arange(first, high + 1e-9, 2 * np.pi).tolist()
            else:
                yield at
        return
    least, most = reach.stroke(stroke)

    def part(edge: float) -> Callable[[Array], Array]:
        wanted = least + (most - least) * (edge if phase.sense > 0 else 1.0 - edge)
        return lambda offset: reach.motion(offset, extended=False).slide(stroke)[0] - wanted

    speed = _speed(reach, stroke)
    for edge in (phase.start, phase.end):
        if edge < 1e-9 or edge > 1.0 - 1e-9:  # where the slide turns back
            yield from _crossings(reach, speed)
        else:
            yield from (x for x in _crossings(reach, part(edge)) if np.sign(speed(np.array([x]))[0]) == phase.sense)


def _speed(reach: DriverRange, pair: str) -> Callable[[Array], Array]:
    return lambda offset: reach.motion(offset, unit=True, extended=False).slide(pair)[1]


def _crossings(reach: DriverRange, value: Callable[[Array], Array]) -> list[float]:
    """The offsets at which a value changes its sign over the range."""
    from graphkin.search import changes

    grid = np.linspace(*reach.ends, SAMPLES + 1)
    return changes(lambda offset: value(offset) >= 0.0, grid)


BLOCK = 1024
"""Positions that are made into objects at once."""


def json_text(first: Mapping[str, Json], positions: Iterable[Mapping[str, Json]]) -> Iterator[str]:
    """A head and the entries of positions as one object in the text of JSON, with a line feed at its end, piece by
    piece: of a long sweep only some entries are in memory.  Control characters are escaped."""
    yield one_line(first)[:-1] + ', "positions": ['
    between, rest = "", iter(positions)
    while block := list(islice(rest, BLOCK)):
        yield between + one_line(block)[1:-1]
        between = ", "
    yield "]}\n"


def head(motion: Motion) -> dict[str, Json]:
    """The entries of a motion before its positions: title, units, mobility, passed change points, groups."""
    scene = motion.scene
    force = {"force": scene.units.force} if scene.loading else {}
    speed = {"speed": scene.units.speed} if scene.units.speed else {}
    units = [(d.key, scene.unit_of(d, radians=True)) for d in scene.drivers]
    # the links whose two assemblies meet at each change point on the way, and the drivers' values there
    passed: list[Json] = [
        {"links": list(point.links),
         "driver": {key: unit.of(value) for (key, unit), value in zip(units, point.values, strict=True)}}
        for point in motion.passed
    ]
    return {
        "title": scene.question.title,
        "units": {"length": scene.units.length, **speed, "time": "s", "angle": "rad", **force},
        "mobility": motion.structure.mobility.value,
        **({"passed": passed} if passed else {}),
        "groups": [
            {"class": group.order, "kind": group.kind, "links": list(group.links), "assembly": say(words)}
            for group, words in zip(motion.structure.groups, motion.assembly, strict=True)
        ],
    }


def entries(motion: Motion, forces: Forces | None = None) -> Iterator[dict[str, Json]]:
    """The entry of ``solve --json`` for each position in turn: numbers in the scene's length unit, seconds, radians;
    forces in its force unit, moments in that times metre.  Some thousand are made at a time."""
    scene, flywheel = motion.scene, _flywheel(motion)
    angles = {link.name: motion.angle(link.name) for link in scene.links}
    driven = [(d.key, scene.unit_of(d, radians=True).of(motion.values[:, i])) for i, d in enumerate(scene.drivers)]
    for first in range(0, len(motion), BLOCK):
        some = slice(first, first + BLOCK)
        drivers: Columns = {"driver": {key: values[some].tolist() for key, values in driven}}
        columns = _of_motion(motion.rows(some), {name: angle[some] for name, angle in angles.items()})
        columns["error_bound"] = _of_bounds(motion, some)
        if forces is not None:
            columns |= _of_forces(scene, forces, some)
            columns["moments"] |= {key: [value] * BLOCK for key, value in flywheel.items()}
        for k, status in enumerate(motion.status[some].tolist()):
            said = _at(columns, k) if status == "ok" else {"why": str(motion.reasons[first + k])}
            yield {**_at(drivers, k), "status": status, **said}


Columns = dict[str, Any]
"""What an entry says, by name, of each part again by name: at last a list with an item for each position."""
ABSENT = object()
"""Stands in a list where a position has no such item."""


def _at(columns: Columns, k: int) -> dict[str, Json]:
    """The values of columns at a position."""
    cells = ((key, _at(part, k) if isinstance(part, dict) else part[k]) for key, part in columns.items())
    return {key: cell for key, cell in cells if cell is not ABSENT}


def _of_motion(motion: Motion, angles: Mapping[str, Array]) -> Columns:
    """Every number of some positions, in the scene's units."""
    scene = motion.scene
    metres, fast = scene.units.metres, scene.units.rates.metres
    columns: Columns = {"links": {}, "points": {}, "slides": {}}

    def put(part: str, of: str, **values: Measure) -> None:
        columns.setdefault(part, {})[of] = {name: _column(value) for name, value in values.items()}

    for name, angle in angles.items():
        put("links", name, angle=angle, omega=motion.omega(name), alpha=motion.alpha(name))
    for ref, link in listed_points(scene, motion.slides):
        at = motion.posed.point(ref)
        put("points", f"{ref.point}@{link}", position=at.z / metres, velocity=at.v / fast, acceleration=at.a / fast)
    for pair in own_slides(scene, motion.slides):
        travel, *rates = motion.slide(pair.key)
        velocity, acceleration, coriolis = (rate / fast for rate in rates)
        put("slides", pair.key, travel=travel / metres, velocity=velocity, acceleration=acceleration, coriolis=coriolis)
    for touching in scene.higher_pairs:
        from graphkin.solver.touching import measured

        put(touching.table, touching.name, **measured(motion, touching))
    return columns


def _column(measure: Measure) -> Any:
    """A measure as a column; with a column for each link, only where there is a value."""
    if isinstance(measure, Mapping):
        return {link: _plain(values, np.isfinite(values)) for link, values in measure.items()}
    return _plain(measure) if isinstance(measure, np.ndarray) else [measure] * BLOCK


def _of_forces(scene: Mechanism, forces: Forces, some: slice) -> Columns:
    """Forces and moments; a key with + is the value with the loads that begin or end exactly at a position."""
    columns: Columns = {"forces": {}, "moments": {}}
    for symbol, values in forces.values.items():
        part = columns["forces" if symbol.is_vector else "moments"]
        shown = values[some] / scene.units.newtons
        part[str(symbol)] = _plain(shown.astype(complex) if symbol.is_vector else shown.real)
        if symbol in forces.beside:
            shown = forces.beside[symbol][some] / scene.units.newtons
            there = ~np.isnan(shown)
            part[f"{symbol}+"] = _plain(shown.astype(complex) if symbol.is_vector else shown.real, there)
    bounds = (bound[some] / scene.units.newtons for bound in forces.bound)
    return {**columns, "force_bound": {part: bound.tolist() for part, bound in zip(columns, bounds, strict=True)}}


def _flywheel(motion: Motion) -> dict[str, Json]:
    """Excess work and inertia of the flywheel, if the scene asks for one."""
    units = motion.scene.units
    if motion.scene.loading.flywheel is None or not motion.ok.any():
        return {}
    try:
        study = flywheel_of(range_of(structure_of(motion.structure)))
    except Unsolvable:
        return {}
    return {"excess_W": study.excess / units.newtons, "J_F": study.inertia / units.of("inertia").si}


def _plain(values: Array, present: Array | None = None) -> list[Any]:
    """Numbers, or pairs of numbers for complex ones, without a minus before zero; only where they are ``present``."""
    parts = np.stack([values.real, values.imag], axis=1) if np.iscomplexobj(values) else values
    numbers: list[Any] = (parts + 0.0).tolist()
    return numbers if present is None else [x if there else ABSENT for x, there in zip(numbers, present, strict=True)]


def _of_bounds(motion: Motion, some: slice) -> Columns:
    """Bounds of the values' rounding errors; None, with the reason, where they are unknown."""
    metres, fast = motion.scene.units.metres, motion.scene.units.rates.metres
    names = "position", "velocity", "acceleration", "angle", "omega", "alpha"
    bounds: Columns = {}
    for name, bound, per in zip(names, motion.bound, (metres, fast, fast, 1.0, 1.0, 1.0), strict=True):
        bounds[name] = [x if math.isfinite(x) else None for x in (bound[some] / per).tolist()]
    why = "the worst case of rounding, multiplied along so many groups, says nothing"
    bounds["why"] = [why if None in row else ABSENT for row in zip(*bounds.values(), strict=True)]
    return bounds
