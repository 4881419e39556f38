"""Extremes and zeros of quantities over the whole range of the driver."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphkin.scene.model import AngleDriver
from graphkin.solver import DriverRange
from graphkin.solver.places import transmission
from graphkin.structure import Dyad
from graphkin.study.curves import Pieces, resolve
from graphkin.study.quantities import Quantity, link_quantities, slide_quantities

__all__ = ["Extreme", "Least", "Traced", "driver_value", "trace"]

Array = NDArray[np.float64]

NEAR_END = 1e-5
"""Of the range: an extreme this near to an end of the motion is the end itself."""
POLISH = 3
NOTHING = 5e-11
"""A driver value this small (rad, m) is 0: no extreme of an acceleration is placed better."""


@dataclass(frozen=True)
class Extreme:
    """A greatest or least value, or the value at an end of the motion: where (offset, and value of the driver, SI) and
    how much (SI)."""

    kind: Literal["max", "min", "end"]
    offset: float
    driver: float
    value: float


@dataclass(frozen=True)
class Traced:
    """A quantity over the driver's range: its extremes in the order of the motion, and where it is zero (driver)."""

    quantity: Quantity
    extremes: tuple[Extreme, ...]
    zeros: tuple[float, ...]
    constant: float | None = None

    @property
    def greatest(self) -> Extreme | None:
        return max(self.extremes, key=lambda e: e.value, default=None)

    @property
    def least(self) -> Extreme | None:
        return min(self.extremes, key=lambda e: e.value, default=None)


@dataclass(frozen=True)
class Least:
    """The least transmission angle of a group (rad), and the value of the driver there (None if it never changes)."""

    group: Dyad
    angle: float
    driver: float | None

    @property
    def pressure(self) -> float:
        """The greatest pressure angle (rad)."""
        return float(np.pi / 2) - self.angle


def driver_value(reach: DriverRange, offset: float) -> float:
    """Value of the first driver at an offset; an angle of a driver that turns fully within a turn from 0 on."""
    value = float(reach.value(np.array(offset)))
    if reach.full and isinstance(reach.driver, AngleDriver):
        whole = 2 * np.pi * reach.turns
        value = value % whole
        value -= whole if whole - value < 1e-9 else 0.0
    return 0.0 if abs(value) < NOTHING else value


def trace(reach: DriverRange, quantities: Sequence[Quantity]) -> tuple[tuple[Traced, ...], tuple[Least, ...]]:
    """Find all extremes and zeros of quantities, and the least transmission angle of each group of two links."""
    way = _Way(reach)
    dyads = [g for g in reach.structure.groups if isinstance(g, Dyad)]
    places = [q for q in quantities if q.is_position]
    rates = [q for q in quantities if not q.is_position]

    def positions(parameter: Array) -> Array:
        motion = reach.motion(way.offset(parameter))
        columns = [q.smooth(reach, motion) for q in places]
        columns += [transmission(reach.structure, d, motion.poses).cosine for d in dyads]
        return np.stack(columns, axis=1)

    def speeds(parameter: Array) -> Array:
        motion = reach.motion(way.offset(parameter))
        return np.stack([q.smooth(reach, motion) for q in rates], axis=1)

    # apart, because positions stay smooth where rates grow without bound
    found: dict[Quantity, Traced] = {}
    least: tuple[Least, ...] = ()
    if places or dyads:
        size = reach.scene.size
        floor = np.array([size if q.measure == "length" else 1.0 for q in places] + [1.0] * len(dyads))
        pieces = resolve(positions, *way.range, periodic=reach.full, floor=floor)
        found.update({q: _traced(way, pieces, k, q) for k, q in enumerate(places)})
        least = tuple(_least(way, pieces, len(places) + k, d) for k, d in enumerate(dyads))
    if rates:
        # near the end of a motion, a distance x away, velocities grow as x^-1/2 and accelerations as x^-3/2
        power = np.array([(1.0 if q.is_speed else 3.0) * (2 if q.is_size else 1) for q in rates])
        weight = None if reach.full else power
        pieces = resolve(speeds, *way.range, periodic=reach.full, floor=_floor(reach, rates), weight=weight)
        found.update({q: _traced(way, pieces, k, q) for k, q in enumerate(rates)})
    return tuple(found[q] for q in quantities), least


def _floor(reach: DriverRange, rates: Sequence[Quantity]) -> Array:
    """For each rate the size that such rates have in this mechanism: what is nothing beside it is zero."""
    size = reach.scene.size
    motion = reach.motion(np.linspace(*reach.ends, 62)[1:-1])
    poses = [motion.poses[link.name] for link in reach.scene.links]
    omega = max(float(np.nanmedian(np.abs(p.omega))) for p in poses)
    speed = max(omega * size, max(float(np.nanmedian(np.abs(p.v))) for p in poses))
    alpha = max(omega**2, max(float(np.nanmedian(np.abs(p.alpha))) for p in poses))
    push = max(alpha * size, max(float(np.nanmedian(np.abs(p.a))) for p in poses))
    table = {"angular rate": omega, "angular acceleration": alpha, "speed": speed, "acceleration": push}
    return np.array([table[q.measure] ** (2 if q.is_size else 1) for q in rates]) * 1e-3


@dataclass(frozen=True)
class _Way:
    """The parameter of the curves: the offset itself for a driver that turns fully; else an angle whose cosine runs
    over the range, in which positions stay smooth up to the ends, where their rates are infinite."""

    reach: DriverRange

    @property
    def range(self) -> tuple[float, float]:
        return self.reach.ends if self.reach.full else (0.0, float(np.pi))

    def offset(self, parameter: Array) -> Array:
        low, high = self.reach.ends
        if self.reach.full:
            return np.asarray(parameter)
        # halves of a product of sines, so that nothing is lost near the ends
        return np.asarray(np.where(
            parameter < np.pi / 2,
            low + (high - low) * np.sin(parameter / 2) ** 2,
            high - (high - low) * np.cos(parameter / 2) ** 2,
        ))

    def inside(self, parameter: Array) -> Array:
        """Those that are not at an end of the motion."""
        if self.reach.full:
            return parameter
        low, high = self.range
        margin = NEAR_END * (high - low)
        return parameter[(parameter > low + margin) & (parameter < high - margin)]


def _traced(way: _Way, pieces: Pieces, k: int, quantity: Quantity) -> Traced:
    reach = way.reach
    at_start = reach.motion(np.zeros(1))
    if pieces.is_constant(k) or _is_constant(way, quantity):
        nothing = quantity.smooth(reach, at_start)[0] == 0.0
        return Traced(quantity, (), (), 0.0 if nothing else float(quantity.values(reach, at_start)[0]))
    offset = way.offset(way.inside(pieces.extremes(k)))
    zeros = way.offset(way.inside(pieces.zeros(k)))
    if quantity.kind in ("theta", "s"):
        offset = _polished(reach, quantity, offset)
    elif quantity.kind in ("omega", "v") and len(reach.scene.drivers) == 1 and reach.driver.values[2] == 0:
        offset = _at_zero(reach, quantity, offset)
    extremes = _extremes(way, pieces, k, quantity, offset)
    if quantity.is_size:
        most = max((e.value for e in extremes), default=0.0)
        extremes = tuple(replace(e, value=0.0) if e.value <= 1e-11 * most else e for e in extremes)
        zeros = np.array([e.offset for e in extremes if e.value == 0.0])
    elif quantity.kind == "theta":
        zeros = np.zeros(0)
    return Traced(quantity, extremes, tuple(driver_value(reach, float(z)) for z in zeros))


def _is_constant(way: _Way, quantity: Quantity) -> bool:
    """Whether a rate is the same wherever it is finite."""
    if quantity.is_position:
        return False
    low, high = way.range
    motion = way.reach.motion(way.offset(np.linspace(low, high, 34)[1:-1]))
    values = quantity.smooth(way.reach, motion)
    values = values[np.isfinite(values)]
    return bool(len(values) == 0 or np.ptp(values) <= 1e-12 * np.max(np.abs(values)))


def _at_zero(reach: DriverRange, quantity: Quantity, offset: Array) -> Array:
    """Where the driver runs evenly, a velocity is at rest where its acceleration is zero: the secant method on that."""
    bend = link_quantities(quantity.of)[2] if quantity.kind == "omega" else slide_quantities(quantity.of)[2]
    low, high = reach.ends
    if not len(offset):
        return offset
    before = _wrapped(reach, offset - 1e-6 * (high - low))
    value = bend.values(reach, reach.motion(before))
    for _ in range(POLISH):
        now = bend.values(reach, reach.motion(offset))
        with np.errstate(all="ignore"):
            step = now * (offset - before) / (now - value)
        step = np.where(np.abs(step) < 1e-6 * (high - low), step, 0.0)
        before, value, offset = offset, now, np.clip(offset - step, low, high)
    return offset


def _polished(reach: DriverRange, quantity: Quantity, offset: Array) -> Array:
    """Newton's method on the rate by the driver: the place of an extreme position to the last digits."""
    of_position = link_quantities if quantity.kind == "theta" else slide_quantities
    _, rate, bend = of_position(quantity.of)
    low, high = reach.ends
    for _ in range(POLISH if len(offset) else 0):
        motion = reach.motion(offset, unit=True)
        with np.errstate(all="ignore"):
            step = rate.values(reach, motion) / bend.values(reach, motion)
        step = np.where(np.abs(step) < 1e-5 * (high - low), step, 0.0)
        offset = np.clip(offset - step, low, high)
    return offset


def _extremes(way: _Way, pieces: Pieces, curve: int, quantity: Quantity, offset: Array) -> tuple[Extreme, ...]:
    reach = way.reach
    low, high = reach.ends
    ends = [] if reach.full or not quantity.is_position else [low, high]
    places = np.sort(np.append(offset, ends))
    if not len(places):
        return ()
    motion = reach.motion(places)
    near = 1e-4 * (high - low)
    values = quantity.values(reach, motion)
    before = quantity.values(reach, reach.motion(_wrapped(reach, places - near)))
    after = quantity.values(reach, reach.motion(_wrapped(reach, places + near)))
    found: list[Extreme] = []
    for k, place in enumerate(places):
        kind: Literal["max", "min", "end"]
        value = float(values[k])
        if place in ends:
            # the solver refuses a position at the end of the motion, or loses half of its digits there
            kind, value = "end", pieces.at(way.range[0] if place == low else way.range[1], curve)
            value = quantity.of_smooth(value)
        elif before[k] < value > after[k]:
            kind = "max"
        elif before[k] > value < after[k]:
            kind = "min"
        else:
            continue  # a curve that only stands still for a moment
        found.append(Extreme(kind, float(place), driver_value(reach, float(place)), value))
    return tuple(found)


def _wrapped(reach: DriverRange, offset: Array) -> Array:
    low, high = reach.ends
    return np.asarray(offset % (high - low) if reach.full else np.clip(offset, low, high))


def _least(way: _Way, pieces: Pieces, k: int, dyad: Dyad) -> Least:
    reach = way.reach

    def angle(offset: Array) -> Array:
        return transmission(reach.structure, dyad, reach.motion(offset).poses).angle

    if pieces.is_constant(k):
        return Least(dyad, float(angle(np.zeros(1))[0]), None)
    low, high = way.range
    inner = way.inside(np.append(pieces.extremes(k), np.linspace(low, high, 33)))
    offsets = way.offset(inner)
    angles = angle(offsets)
    # where the group stands in line, at a change point or at an end of the motion, the solver refuses
    refused = ~np.isfinite(angles)
    angles[refused] = [_from_cosine(pieces.at(at, k)) for at in inner[refused]]
    places = list(zip(offsets.tolist(), angles.tolist(), strict=True))
    if not reach.full:
        places += [(at, _from_cosine(pieces.at(end, k))) for at, end in zip(reach.ends, way.range, strict=True)]
    offset, best = min((p for p in places if p[1] == p[1]), key=lambda p: p[1])
    return Least(dyad, best, driver_value(reach, offset))


def _from_cosine(cosine: float) -> float:
    """An angle of 90 degrees or less by its cosine as the curve gives it; 0 where rounding tells no more."""
    lack = max(0.0, 1.0 - abs(cosine))
    return 2 * float(np.arcsin(np.sqrt(lack / 2))) if lack > 1e-12 else 0.0
