"""Extremes and zeros of quantities over the whole range of the driver; and what their curves run over: the driver's
offset, or an angle in which positions are smooth up to the ends.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Literal

import numpy as np

from graphkin.scene.cams import LawCam
from graphkin.search import Pieces, resolve
from graphkin.solver import DriverRange, Motion
from graphkin.solver.cams import cam_angle
from graphkin.solver.pose import Array
from graphkin.solver.quantities import transmission
from graphkin.structure import Dyad
from graphkin.study.quantities import Quantity, rates_of

__all__ = ["CurveParameter", "Extreme", "Least", "Traced", "driver_value", "trace"]

_SIGNS: tuple[tuple[Literal["max", "min"], float], ...] = (("max", 1.0), ("min", -1.0))
POLISH = 3
BESIDE_SEAM = 1e-3
CLOSE_TO_SEAM = 1e-7
"""Of the range: how far off a seam of a law one sees how a curve goes on, and reads its value before it."""
SAME_AT_SEAM = 1e-11
"""Of the largest value: a curve that changes by less stands still."""
NOTHING = 5e-11
"""A driver value this small (rad, m) is 0: no extreme of an acceleration is placed better."""

SEAM_STEPS = 360
SAME = 1e-8
"""Of the range: seams as near to each other are one."""
SECANTS = 5
NEAR_END = 1e-5
"""Of the range: an extreme this near to an end of the motion is the end itself."""
STEPS_TO_END = 2e-2
"""Of the angle that runs over the range: steps to an end that the solver does not come near enough to."""
HAIR = 1e-6
"""Of the range of the driver: what is left out before an end at which links go away without bound."""

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


@dataclass(frozen=True)
class Curve:
    """A quantity, and its place among the curves that represent it."""

    quantity: Quantity
    pieces: Pieces
    k: int


@dataclass(frozen=True)
class CurveParameter:
    """The parameter of the curves: the offset itself for a driver that turns fully; else an angle whose cosine runs
    over the range, in which positions stay smooth up to the ends, where their rates are infinite.  An end at which
    links go away without bound, as where two guides become parallel, is left out, a hair of the range before it."""

    reach: DriverRange

    @cached_property
    def range(self) -> tuple[float, float]:
        if self.reach.full:
            return self.reach.ends
        hair = 2 * float(np.arcsin(np.sqrt(HAIR)))
        one, two = (hair if away else 0.0 for away in self._away)
        return one, float(np.pi) - two

    @cached_property
    def _away(self) -> tuple[bool, bool]:
        """At which ends links go away without bound."""
        low, high = self.reach.ends
        parts = np.array([1e-6, 1e-4])
        motion = self.reach.motion(np.append(low + parts * (high - low), high - parts * (high - low)), fine=False)
        far = np.max([np.abs(p.z) for p in motion.poses.values()], axis=0)
        # at an end where links only turn they come nearer to a place of theirs
        return not far[0] < 10 * far[1], not far[2] < 10 * far[3]

    @cached_property
    def seams(self) -> Array:
        """Where one part of the law of a cam gives way to the next, in increasing order."""
        low, high = self.range
        found: list[float] = []
        for cam in self.reach.scene.cams:

            def beyond(at: Array, start: Array, cam: LawCam = cam) -> Array:
                at = low + np.remainder(at - low, high - low) if self.reach.full else np.clip(at, low, high)
                turn = self.reach.motion(self.offset(at), fine=False).poses[cam.link].u
                return np.asarray(np.angle(np.exp(1j * (cam_angle(cam, turn) - start))))

            step = (high - low) / SEAM_STEPS
            # the grid begins beside the start of the range, which is often a seam
            grid = np.linspace(low, high, SEAM_STEPS + 1) + (step / 2 if self.reach.full else 0.0)
            for start in np.array(cam.law.starts):
                apart = beyond(grid, start)
                one, two = apart[:-1], apart[1:]
                n = np.flatnonzero(((one < 0) != (two < 0)) & (np.abs(one) < 1.0) & (np.abs(two) < 1.0))
                a, b, f, g = grid[n], grid[n + 1], one[n], two[n]
                for _ in range(SECANTS if len(n) else 0):
                    with np.errstate(all="ignore"):
                        by = g * (b - a) / (g - f)
                    a, f, b = b, g, b - np.where(np.isfinite(by), by, 0.0)
                    g = beyond(b, start)
                found += b.tolist()
        return self._placed(found)

    def _placed(self, seams: list[float]) -> Array:
        """Inside the range, each once; the two ends of a turn are one place."""
        low, high = self.range
        near = SAME * (high - low)
        if self.reach.full:
            seams = [low + (at - low) % (high - low) for at in seams]
            seams = [low if high - at < near or at - low < near else at for at in seams]
        else:
            seams = [at for at in seams if low + near < at < high - near]
        kept: list[float] = []
        for at in sorted(seams):
            if not kept or at - kept[-1] > near:
                kept.append(at)
        return np.array(kept)

    def end(self, curve: Curve, which: int) -> float:
        """The value of a position at the lower or upper end of the motion, where the solver refuses it, or loses half
        of its digits: from the curve, or, where links go away without bound, from values nearer and nearer to it."""
        if not self._away[which]:
            value = curve.pieces.at(self.range[which], curve.k)
            return self._beyond(curve, which) if np.isnan(value) else curve.quantity.of_smooth(value)
        reach, quantity = self.reach, curve.quantity
        low, high = reach.ends
        steps = np.asarray(HAIR * 2.0 ** np.arange(2, 8), dtype=np.float64)
        near = steps * (high - low)
        values = quantity.values(reach, reach.motion(high - near if which else low + near))
        if abs(values[0]) > 1.5 * abs(values[1]) > 2.25 * abs(values[2]):
            return float(np.copysign(np.inf, values[0]))
        return _to_zero(steps, values)

    def _beyond(self, curve: Curve, which: int) -> float:
        """The value at an end of which the curve was left out, because the solver refuses places too near to it."""
        low, high = self.range
        steps: Array = STEPS_TO_END * np.arange(1, 9, dtype=np.float64)
        motion = self.reach.motion(self.offset(high - steps if which else low + steps))
        return _to_zero(steps, curve.quantity.values(self.reach, motion))

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
        margin = NEAR_END * float(np.pi)
        low, high = self.range
        return parameter[(parameter > low + margin) & (parameter < high - margin)]


def _to_zero(steps: Array, values: Array) -> float:
    """Neville's scheme: the value at 0 of the polynomial through values at steps."""
    found = values.tolist()
    for k in range(1, len(found)):
        found = [b - (c - b) * x / (y - x) for b, c, x, y in zip(found, found[1:], steps, steps[k:], strict=False)]
    return float(found[0])


def driver_value(reach: DriverRange, offset: float) -> float:
    """Value of the first driver at an offset; an angle of a driver that turns fully within a turn from 0 on."""
    value = float(reach.value(np.array(offset)))
    if reach.full and reach.driver.turns:
        whole = 2 * np.pi * reach.turns
        value = value % whole
        value -= whole if whole - value < 1e-9 else 0.0
    return 0.0 if abs(value) < NOTHING else value


def trace(reach: DriverRange, quantities: Sequence[Quantity]) -> tuple[tuple[Traced, ...], tuple[Least, ...]]:
    """Find all extremes and zeros of quantities, and the least transmission angle of each group of two links; of a
    mechanism that is singular throughout there are none."""
    way = CurveParameter(reach)
    dyads = [*reach.structure.dyads.values()]
    places = [q for q in quantities if q.is_position]
    rates = [q for q in quantities if not q.is_position]
    size = reach.scene.size

    here: dict[bytes, Motion] = {}

    def at(parameter: Array) -> Motion:
        key = parameter.tobytes()  # positions and rates are looked at on the same pieces at first
        if key not in here:
            here[key] = reach.motion(way.offset(parameter), fine=False)
        return here[key]

    def positions(parameter: Array) -> tuple[Array, Array]:
        motion = at(parameter)
        columns = [q.smooth(reach, motion) for q in places]
        bound = motion.bound.angle + motion.bound.position / size
        off = np.where(np.isfinite(bound), bound, 0.0)
        columns += [(transmission(reach.structure, d, motion.poses).cosine, off) for d in dyads]
        return _columns(columns)

    def speeds(parameter: Array) -> tuple[Array, Array]:
        return _columns([q.smooth(reach, at(parameter)) for q in rates])

    # apart, because positions stay smooth where rates grow without bound
    curves: list[Curve] = []
    least: tuple[Least, ...] = ()
    if places or dyads:
        floor = np.array([size if q.measure == "length" else 1.0 for q in places] + [1.0] * len(dyads))
        pieces = resolve(positions, *way.range, periodic=reach.full, floor=floor, seams=way.seams)
        curves += [Curve(q, pieces, k) for k, q in enumerate(places)]
        least = _leasts(way, pieces, len(places), dyads)
    if rates:
        # near the end of a motion, a distance x away, velocities grow as x^-1/2 and accelerations as x^-3/2
        power = np.array([(1.0 if q.is_speed else 3.0) * (2 if q.is_size else 1) for q in rates])
        weight = None if reach.full else power
        usual = _floor(reach, rates)
        pieces = resolve(speeds, *way.range, periodic=reach.full, floor=usual, weight=weight, seams=way.seams)
        curves += [Curve(q, pieces, k) for k, q in enumerate(rates)]
    found = {t.quantity: t for t in _traced(way, curves) if t.constant is None or np.isfinite(t.constant)}
    return tuple(found[q] for q in quantities if q in found), least


def _columns(pairs: Sequence[tuple[Array, Array]]) -> tuple[Array, Array]:
    values, off = zip(*pairs, strict=True)
    return np.stack(values, axis=1), np.stack(off, axis=1)


def _values(
    reach: DriverRange, quantities: Sequence[Quantity], offsets: Sequence[Array], fine: bool = False, unit: bool = False
) -> list[Array]:
    """Quantities at offsets of their own, for each as many as it has, all from one motion; with ``unit`` of a driver
    that moves at the rate 1."""
    ends = np.cumsum([0, *map(len, offsets)]).tolist()
    motion = reach.motion(np.concatenate([*offsets, np.zeros(1)]), unit=unit, fine=fine)
    return [q.values(reach, motion)[a:b] for q, (a, b) in zip(quantities, pairwise(ends), strict=True)]


def _floor(reach: DriverRange, rates: Sequence[Quantity]) -> Array:
    """For each rate the size that such rates have in this mechanism: what is nothing beside it is zero."""
    size = reach.scene.size
    motion = reach.motion(np.linspace(*reach.ends, 62)[1:-1], fine=False)
    poses = [motion.poses[link.name] for link in reach.scene.links]
    omega = max(_usual(p.omega) for p in poses)
    speed = max(omega * size, *(_usual(p.v) for p in poses))
    alpha = max(omega**2, *(_usual(p.alpha) for p in poses))
    push = max(alpha * size, *(_usual(p.a) for p in poses))
    table = {"angular velocity": omega, "angular acceleration": alpha, "velocity": speed, "acceleration": push}
    return np.array([table[q.measure] ** (2 if q.is_size else 1) for q in rates]) * 1e-3


def _usual(values: Array) -> float:
    """The median size of what is known of some values; 0 where nothing is."""
    known = np.abs(values[np.isfinite(values)])
    return float(np.median(known)) if len(known) else 0.0


def _traced(way: CurveParameter, curves: Sequence[Curve]) -> list[Traced]:
    reach = way.reach
    start = reach.known
    constant = _constant(way, curves)
    found = []
    for curve in (c for c in curves if c.quantity in constant):
        quantity = curve.quantity
        nothing = quantity.smooth(reach, start)[0][0] == 0.0
        found.append(Traced(quantity, (), (), 0.0 if nothing else float(quantity.values(reach, start)[0])))
    moving = [c for c in curves if c.quantity not in constant]
    offsets = [way.offset(way.inside(c.pieces.extremes(c.k))) for c in moving]
    offsets = _polished(reach, [c.quantity for c in moving], offsets)
    offsets = _at_zero(reach, [c.quantity for c in moving], offsets)
    for curve, extremes in zip(moving, _extremes(way, moving, offsets), strict=True):
        quantity = curve.quantity
        zeros = way.offset(way.inside(curve.pieces.zeros(curve.k)))
        if quantity.is_size:
            most = max((e.value for e in extremes), default=0.0)
            extremes = tuple(replace(e, value=0.0) if e.value <= 1e-11 * most else e for e in extremes)
            zeros = np.array([e.offset for e in extremes if e.value == 0.0])
        elif quantity.kind == "theta":
            zeros = np.zeros(0)
        found.append(Traced(quantity, extremes, tuple(driver_value(reach, float(z)) for z in zeros)))
    return found


def _constant(way: CurveParameter, curves: Sequence[Curve]) -> set[Quantity]:
    """Quantities that do not change; of rates those that are the same wherever they are finite."""
    found = {c.quantity for c in curves if c.pieces.is_constant(c.k)}
    low, high = way.range
    motion = way.reach.motion(way.offset(np.linspace(low, high, 34)[1:-1]), fine=False)
    for quantity in (c.quantity for c in curves if not c.quantity.is_position):
        values = quantity.smooth(way.reach, motion)[0]
        values = values[np.isfinite(values)]
        if len(values) == 0 or np.ptp(values) <= 1e-12 * np.max(np.abs(values)):
            found.add(quantity)
    return found


def _polished(reach: DriverRange, quantities: Sequence[Quantity], offsets: Sequence[Array]) -> list[Array]:
    """Newton's method on the rate by the driver: the places of extreme positions to the last digits."""
    low, high = reach.ends
    found = list(offsets)
    which = [k for k, q in enumerate(quantities) if q.kind in ("theta", "s") and len(offsets[k])]
    both = [rates_of(quantities[k])[1:] for k in which]
    asked = [q for pair in both for q in pair]
    for _ in range(POLISH if which else 0):
        rates = _values(reach, asked, [found[k] for k in which for _ in range(2)], unit=True)
        for k, rate, bend in zip(which, rates[::2], rates[1::2], strict=True):
            with np.errstate(all="ignore"):
                step = rate / bend
            step = np.where(np.abs(step) < 1e-5 * (high - low), step, 0.0)
            found[k] = np.clip(found[k] - step, low, high)
    return found


def _at_zero(reach: DriverRange, quantities: Sequence[Quantity], offsets: Sequence[Array]) -> list[Array]:
    """Where the driver runs evenly, a velocity is at rest where its acceleration is zero: the secant method on that."""
    found = list(offsets)
    if len(reach.scene.drivers) != 1 or reach.driver.values[2] != 0:
        return found
    low, high = reach.ends
    near = 1e-6 * (high - low)
    which = [k for k, q in enumerate(quantities) if q.kind in ("omega", "v") and len(offsets[k])]
    asked = [rates_of(quantities[k])[2] for k in which]
    before = [_wrapped(reach, found[k] - near) for k in which]
    values = _values(reach, asked, before) if which else []
    for _ in range(POLISH if which else 0):
        now = _values(reach, asked, [found[k] for k in which])
        for n, k in enumerate(which):
            with np.errstate(all="ignore"):
                step = now[n] * (found[k] - before[n]) / (now[n] - values[n])
            step = np.where(np.abs(step) < near, step, 0.0)
            before[n], found[k] = found[k], np.clip(found[k] - step, low, high)
        values = now
    return found


def _extremes(way: CurveParameter, curves: Sequence[Curve], offsets: Sequence[Array]) -> list[tuple[Extreme, ...]]:
    reach = way.reach
    low, high = reach.ends
    asked = [c.quantity for c in curves]
    seams = way.offset(way.seams)
    inner = [np.sort(places) for places in offsets]
    # only what is printed takes all its digits
    values = _values(reach, asked, inner, fine=True)
    # a little beside each, and not beyond an end of the motion
    wide = 1e-4 * (high - low)
    near = [
        np.full(len(at), wide) if reach.full else np.minimum(wide, np.minimum(at - low, high - at) / 2) for at in inner
    ]
    before = _values(reach, asked, [_wrapped(reach, at - by) for at, by in zip(inner, near, strict=True)])
    after = _values(reach, asked, [_wrapped(reach, at + by) for at, by in zip(inner, near, strict=True)])
    at_seams = _at_seams(reach, asked, seams, [np.append(v, 0.0) for v in values])
    found: list[tuple[Extreme, ...]] = []
    for n, curve in enumerate(curves):
        own: list[Extreme] = []
        bounded = not reach.full and curve.quantity.is_position
        if bounded:
            own.append(Extreme("end", low, driver_value(reach, low), way.end(curve, 0)))
        for place, value, one, two in zip(*(x[n].tolist() for x in (inner, values, before, after)), strict=True):
            # a curve that only stands still for a moment has none; what comes to rest at a seam is told there
            if not at_seams[n].has(place, value) and (one < value > two or one > value < two):
                own.append(Extreme("max" if one < value else "min", place, driver_value(reach, place), value))
        own = sorted([*own, *at_seams[n].extremes], key=lambda e: e.offset)
        if bounded:
            own.append(Extreme("end", high, driver_value(reach, high), way.end(curve, 1)))
        found.append(tuple(own))
    return found


@dataclass(frozen=True)
class _Seams:
    """A curve where one part of a law gives way to the next.

    places : offsets, shape (seams,)
    levels : values before and after, shape (2, seams)
    near, slack : how far from a seam, and how far from its values, a curve is still there
    whole : after what offset the curve repeats
    """

    places: Array
    levels: Array
    near: Array
    slack: float
    whole: float
    extremes: tuple[Extreme, ...] = ()

    def has(self, place: float, value: float) -> bool:
        apart = np.abs(self.places - place)
        here = np.minimum(apart, self.whole - apart) < self.near
        return bool((here & (np.abs(self.levels - value) <= self.slack)).any())


def _at_seams(reach: DriverRange, asked: Sequence[Quantity], seams: Array, values: Sequence[Array]) -> list[_Seams]:
    """Extremes where one part of a law gives way to the next: a curve may jump there, or leave a stretch along which it
    stands still, whose end is meant.  ``values`` are some of each curve, from which its size is seen."""
    low, high = reach.ends
    wide = high - low
    if not len(seams):
        return [_Seams(seams, np.zeros((2, 0)), seams, 0.0, wide)] * len(values)
    ends = (seams[-1] - wide, seams[0] + wide) if reach.full else (low, high)
    around = np.diff(np.concatenate([ends[:1], seams, ends[1:]]))
    near = np.minimum(BESIDE_SEAM * wide, np.minimum(around[:-1], around[1:]) / 3)
    close = CLOSE_TO_SEAM * wide
    places = np.concatenate([_wrapped(reach, seams + by) for by in (-near, -2 * close, -close, 0.0, near)])
    found = []
    around_seams = _values(reach, asked, [places] * len(values), fine=True)
    for quantity, some, five in zip(asked, values, around_seams, strict=True):
        before, two, one, after, beyond = five.reshape(5, -1)
        known = np.abs(np.append(some, five))
        slack = SAME_AT_SEAM * float(np.max(known, where=np.isfinite(known), initial=0.0))
        till = 2 * one - two  # the value before a jump: along the curve to the seam
        till = np.where(np.abs(till - after) <= slack, after, till)
        own: list[Extreme] = []
        for kind, sign in _SIGNS:
            top = sign * np.maximum(sign * till, sign * after)
            is_one = (sign * (top - before) >= -slack) & (sign * (top - beyond) > slack)
            if not quantity.is_position:
                is_one &= np.abs(top) > slack  # where it stands still it is said to be zero
            for place, value in zip(seams[is_one].tolist(), top[is_one].tolist(), strict=True):
                own.append(Extreme(kind, place, driver_value(reach, place), value))
        found.append(_Seams(seams, np.stack([till, after]), near, slack, wide if reach.full else np.inf, tuple(own)))
    return found


def _wrapped(reach: DriverRange, offset: Array) -> Array:
    low, high = reach.ends
    return np.asarray(offset % (high - low) if reach.full else np.clip(offset, low, high))


def _leasts(way: CurveParameter, pieces: Pieces, first: int, dyads: Sequence[Dyad]) -> tuple[Least, ...]:
    if not dyads:
        return ()
    reach = way.reach
    low, high = way.range
    inner = [way.inside(np.append(pieces.extremes(first + n), np.linspace(low, high, 33))) for n in range(len(dyads))]
    motion = reach.motion(np.concatenate([*map(way.offset, inner)]), fine=False)
    ends = np.cumsum([0, *map(len, inner)]).tolist()
    found: list[Least] = []
    least: list[float] = []
    for n, dyad in enumerate(dyads):
        k, angles = first + n, transmission(reach.structure, dyad, motion.poses).angle
        if pieces.is_constant(k):
            found.append(Least(dyad, float(transmission(reach.structure, dyad, reach.known.poses).angle[0]), None))
            least.append(0.0)
            continue
        angles = angles[ends[n] : ends[n + 1]]
        # where the group stands in line, at a change point or at an end of the motion, the solver refuses
        refused = ~np.isfinite(angles)
        angles[refused] = [_from_cosine(pieces.at(at, k)) for at in inner[n][refused]]
        places = list(zip(way.offset(inner[n]).tolist(), angles.tolist(), strict=True))
        if not reach.full:
            places += [(at, _from_cosine(pieces.at(end, k))) for at, end in zip(reach.ends, way.range, strict=True)]
        offset, best = min((p for p in places if p[1] == p[1]), key=lambda p: p[1])
        found.append(Least(dyad, best, driver_value(reach, offset)))
        least.append(offset)
    # only what is printed takes all its digits
    motion = reach.motion(np.array([*least, 0.0]))
    for k, one in enumerate(found):
        fine = float(transmission(reach.structure, one.group, motion.poses).angle[k])
        if np.isfinite(fine) and least[k] not in (() if reach.full else reach.ends):
            found[k] = replace(one, angle=fine)
    return tuple(one for one in found if np.isfinite(one.angle))


def _from_cosine(cosine: float) -> float:
    """An angle of 90 degrees or less by its cosine as the curve gives it; 0 where rounding tells no more, not a number
    where the curve was left out."""
    if np.isnan(cosine):
        return cosine
    lack = max(0.0, 1.0 - abs(cosine))
    return 2 * float(np.arcsin(np.sqrt(lack / 2))) if lack > 1e-12 else 0.0
