"""What acts on the links of a motion from outside: inertia forces, weights, loads, each where and while it acts; and
where over the range of the driver the forces jump, as loads begin and end, and turn with the sense of a slide."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from graphkin.scene.loads import LoadOn, Phase, SpringOn
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.search import changes
from graphkin.solver.driver_range import DriverRange, driver_range
from graphkin.solver.motion import Motion
from graphkin.solver.pose import Array
from graphkin.solver.whole_turn import extremes

__all__ = ["EDGE", "Action", "actions", "load_edges", "spring_ends", "stroke_of", "without_line"]

EDGE = 1e-9
"""Of the stroke or the turn: a load that begins or ends within this of a position does so exactly there."""


@dataclass(frozen=True)
class Action:
    """A force or a couple on a link.

    key : its symbol, ``Fi_6``, ``G_6``, ``P_name``; empty where another tells it
    at : where a force acts, complex, shape (n,) (m); None for a couple
    value : force, complex, shape (n,) (N), or couple, real (N m)
    beside : the same with the loads that begin or end exactly at a position; None where that changes nothing
    """

    key: str
    link: str
    at: Array | None
    value: Array
    beside: Array | None = None

    def power(self, motion: Motion) -> Array:
        """What it does (W), shape (n,)."""
        pose = motion.poses[self.link]
        if self.at is None:
            return np.asarray(self.value * pose.omega)
        return np.asarray((np.conj(pose.v + 1j * pose.omega * (self.at - pose.z)) * self.value).real)


def actions(motion: Motion) -> Iterator[Action]:
    """All that is known of what acts on the links: inertia force -m a and inertia couple -J alpha (d'Alembert)
    and weight of each mass, then loads and springs, of the two forces of a spring one may act on the frame.

    Raises
    ------
    Unsolvable : a load acts on a part of a stroke, and the driver makes no whole turn
    """
    loading = motion.scene.loading
    for mass in loading.masses:
        centre = motion.poses[mass.link].fixed(mass.at)
        at = np.asarray(centre.z)
        yield Action(f"Fi_{mass.link}", mass.link, at, np.asarray(-mass.mass * centre.a))
        yield Action(f"Mi_{mass.link}", mass.link, None, np.asarray(-mass.inertia * centre.alpha))
        if loading.gravity:
            yield Action(f"G_{mass.link}", mass.link, at, np.full(len(motion), mass.mass * loading.gravity))
    applied = _Loads(motion)
    for load in loading.loads:
        yield applied.action(load)
    for spring in loading.springs:
        yield from _spring(motion, spring)


def _spring(motion: Motion, spring: SpringOn) -> Iterator[Action]:
    """The forces of a spring on both its links, along the line of its points."""
    one, two = spring_ends(motion, spring)
    way = two - one
    length = np.abs(way)
    along = np.divide(way, length, out=np.full(len(motion), np.nan + 0j), where=_has_line(motion, length))
    force = np.asarray((spring.preload + spring.rate * (length - spring.free)) * along)
    yield Action(f"P_{spring.name}", spring.links[0], one, force)
    yield Action("", spring.links[1], two, -force)


def spring_ends(motion: Motion, spring: SpringOn) -> tuple[Array, Array]:
    """Where the two points of a spring lie, complex, shape (n,) each (m)."""
    one, two = (np.broadcast_to(motion.poses[n].z + motion.poses[n].u * at, len(motion)) for n, at in spring.ends)
    return np.asarray(one), np.asarray(two)


def without_line(motion: Motion) -> dict[str, Array]:
    """For each spring the positions, bool, shape (n,), at which its points coincide, so that its force has no line."""
    springs = motion.scene.loading.springs
    apart = {one.name: np.abs(np.subtract(*spring_ends(motion, one))) for one in springs}
    return {name: motion.ok & ~_has_line(motion, length) for name, length in apart.items()}


def _has_line(motion: Motion, length: Array) -> Array:
    return np.asarray(length > EDGE * motion.scene.size)


@dataclass(frozen=True)
class _Loads:
    """Loads in a motion."""

    motion: Motion

    @property
    def scene(self) -> Mechanism:
        return self.motion.scene

    def action(self, load: LoadOn) -> Action:
        acts, edge = self._acts(load.phase)
        key = f"P_{load.name}"
        if load.is_force:
            pose = self.motion.poses[load.link]
            at, value, none = np.asarray(pose.z + pose.u * load.at), self._force(load), 0j
        else:
            at, value, none = None, np.full(len(self.motion), load.size), 0.0
        beside = np.where(acts | edge, value, none) if edge.any() else None
        surely = acts & ~edge
        return Action(key, load.link, at, value if surely.all() else np.where(surely, value, none), beside)

    def _force(self, load: LoadOn) -> Array:
        """A force load as a vector, whether it acts or not."""
        if load.against:
            slide = next(s for s in self.motion.slides if s.key == load.against)
            speed = self._growing.slide(slide.key).velocity
            most = np.abs(self._growing.poses[slide.b].omega) * self.scene.size + self._scale_of_speed
            sign = np.where(np.abs(speed) > 1e-12 * most, np.sign(speed), 0.0)
            return np.asarray(-load.size * sign * self.motion.poses[slide.b].u * slide.guide.direction)
        if load.follows:
            return np.asarray(load.size * load.turn * self.motion.poses[load.follows].u)
        return np.full(len(self.motion), load.size * load.turn)

    @cached_property
    def _growing(self) -> Motion:
        """The motion itself or, at rest, that in which the first driver's value grows."""
        if any(driver.values[1] for driver in self.scene.drivers):
            return self.motion
        return self._reach.motion(self._reach.offsets(self.motion.values[:, 0]), unit=True)

    @cached_property
    def _scale_of_speed(self) -> Array:
        """The largest speed of any link at each position (m/s)."""
        moving = [self._growing.poses[link.name] for link in self.scene.links if not link.redundant]
        speeds = [np.abs(pose.v) for pose in moving] + [np.abs(pose.omega) * self.scene.size for pose in moving]
        return np.asarray(np.max(np.nan_to_num(speeds), axis=0))

    @cached_property
    def _reach(self) -> DriverRange:
        return driver_range(self.motion.structure)

    def _acts(self, phase: Phase | None) -> tuple[Array, Array]:
        """Where a load acts, and where it begins or ends exactly; shape (n,) each."""
        n = len(self.motion)
        always = np.ones(n, dtype=bool), np.zeros(n, dtype=bool)
        if phase is None:
            return always
        if phase.stroke:
            return self._on_stroke(phase)
        value = self.motion.values[:, 0]
        if not self.scene.drivers[0].turns:
            edge = EDGE * (phase.end - phase.start)
            near = (np.abs(value - phase.start) < edge) | (np.abs(value - phase.end) < edge)
            return np.asarray((phase.start < value) & (value < phase.end)), np.asarray(near)
        turn, span = 2 * np.pi, phase.end - phase.start
        if span >= turn * (1 - EDGE):
            return always
        since = np.remainder(value - phase.start, turn)
        near = np.minimum(since, turn - since) < EDGE * turn
        near |= np.abs(since - span) < EDGE * turn
        return np.asarray(since < span), np.asarray(near)

    def _on_stroke(self, phase: Phase) -> tuple[Array, Array]:
        low, high = stroke_of(self._reach, phase.stroke)
        travel = self.motion.slide(phase.stroke).travel
        speed = self._growing.slide(phase.stroke).velocity
        part = (travel - low) / (high - low) if high > low else np.zeros(len(self.motion))
        if phase.sense < 0:
            part = 1.0 - part
        running = np.sign(speed) == phase.sense
        near = np.zeros(len(self.motion), dtype=bool)
        for edge in (phase.start, phase.end):
            # where the slide turns back both senses meet
            turns = edge < EDGE or edge > 1.0 - EDGE
            near |= (np.abs(part - edge) < EDGE) & (running | turns)
        return np.asarray(running & (phase.start < part) & (part < phase.end)), np.asarray(near)


def stroke_of(reach: DriverRange, pair: str) -> tuple[float, float]:
    """Least and greatest travel of a sliding pair (m)."""
    key = "stroke", pair
    if key not in reach.kept:
        turn = extremes(reach, Symbol.parse(f"stroke_{pair}"))
        reach.kept[key] = turn.low, turn.high
    stroke: tuple[float, float] = reach.kept[key]
    return stroke


SAMPLES = 720


def load_edges(reach: DriverRange) -> Array:
    """The offsets at which a load begins, ends or turns round, growing; those at the ends of the range among them.

    Raises
    ------
    Unsolvable : a load acts on a part of a stroke, and the driver makes no whole turn
    """
    low, high = reach.ends
    found: list[float] = []
    for load in reach.scene.loading.loads:
        if load.against:
            found += _crossings(reach, _speed(reach, load.against))
        if load.phase is not None:
            found += _begins_and_ends(reach, load.phase)
    kept = sorted(offset for offset in found if low - 1e-9 <= offset <= high + 1e-9)
    apart = 1e-9 * (high - low)
    return np.array([x for i, x in enumerate(kept) if i == 0 or x - kept[i - 1] > apart])


def _begins_and_ends(reach: DriverRange, phase: Phase) -> Iterator[float]:
    low, high = reach.ends
    if not phase.stroke:
        for value in (phase.start, phase.end):
            at = float(reach.sense * (value - reach.start[0]))
            if reach.driver.turns:
                first = at + np.ceil((low - 1e-9 - at) / (2 * np.pi)) * 2 * np.pi
                yield from np.arange(first, high + 1e-9, 2 * np.pi).tolist()
            else:
                yield at
        return
    least, most = stroke_of(reach, phase.stroke)

    def part(edge: float) -> Callable[[Array], Array]:
        wanted = least + (most - least) * (edge if phase.sense > 0 else 1.0 - edge)
        return lambda offset: reach.motion(offset, fine=False).slide(phase.stroke).travel - wanted

    speed = _speed(reach, phase.stroke)
    for edge in (phase.start, phase.end):
        if edge < 1e-9 or edge > 1.0 - 1e-9:  # where the slide turns back
            yield from _crossings(reach, speed)
        else:
            yield from (x for x in _crossings(reach, part(edge)) if np.sign(speed(np.array([x]))[0]) == phase.sense)


def _speed(reach: DriverRange, pair: str) -> Callable[[Array], Array]:
    return lambda offset: reach.motion(offset, unit=True, fine=False).slide(pair).velocity


def _crossings(reach: DriverRange, value: Callable[[Array], Array]) -> list[float]:
    """Where something changes its sign over the range."""
    grid = np.linspace(*reach.ends, SAMPLES + 1)
    return changes(lambda offset: value(offset) >= 0.0, grid)
