"""Extremes and zeros of quantities over the whole range of the driver; and the parameter of their curves: the driver's
offset, or an angle in which positions are smooth up to the ends.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Literal

import numpy as np

from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Measure
from graphkin.search import SAME, Pieces, Turn, angles_between, extrapolated, places_between, resolve
from graphkin.solver import DriverRange, Motion
from graphkin.solver.algebra.pose import Array
from graphkin.study.quantities import IN_LINE, course_of, of_smooth, rates_of, smooth_course

NOTHING = 5e-11
"""A driver value this small (rad, m) is 0: no extreme of an acceleration is placed better."""
NOTHING_AT_END = 2e-9
"""A position at an end of a motion this small (rad, or of the size) is 0: it grows with the root of the distance from
there, and so does the rounding of the end."""
SAMPLES, LOCAL = 400, 1e-9
"""Positions over a range that ends, and how much, of the largest value there, goes beyond an extreme."""
NEAR = np.array([1e-8, 1e-6])
"""Of a range: so near to its ends one sees what grows without bound there."""
GROWS = 5.0
"""A hundred times nearer to an end a rate like the root of the distance is ten times as much."""
EQUAL = 1e-11
"""Of a value: extremes that differ by less are equal."""
NEAR_END = 1e-4
"""Of the range: an extreme this near to an end of the motion is the end itself."""
LEAST_REACHED = 6
"""Positions, each twice as far from an end at which links go away as the last: fewer give no value there."""
STEPS_TO_END = 2e-2
"""Of the angle that runs over the range: steps to an end that the solver does not come near enough to."""
ASIDE = 1e-3
"""Of the way from a zero to the nearer end of the motion: so far aside of it the curve is not zero."""
ZERO = 0.01
"""Of the values there: what a curve is at most where it is zero."""
AT_REST = 1e-12
"""Of the largest value: what a curve is at most along a stretch where it is zero."""
HAIR = 1e-6
"""Of the range of the driver: what is left out before an end at which links go away without bound."""

@dataclass(frozen=True)
class Extreme:
    """A greatest or least value, or the value at an end of the motion: its place (offset, and value of the driver, SI)
    and its value (SI); ``local`` if the quantity exceeds it elsewhere in a range that ends; ``rest``, how far the
    driver turns before it while the quantity keeps the value."""

    kind: Literal["max", "min", "end"]
    offset: float
    driver: float
    value: float
    local: bool = False
    rest: float = 0.0


@dataclass(frozen=True)
class Traced:
    """A quantity over the driver's range: its extremes in the order of the motion; its zeros (driver), both ends of a
    stretch of zeros; ``rests`` tells whether it is zero from each to the next; ``unbounded``, whether it grows without
    bound towards an end of the range."""

    quantity: Symbol
    extremes: tuple[Extreme, ...]
    zeros: tuple[float, ...]
    constant: float | None = None
    unbounded: bool = False
    rests: tuple[bool, ...] = ()

    @property
    def zero_stretches(self) -> tuple[tuple[float, float], ...]:
        """The first and the last driver value of each zero: the same, but of a stretch along which it is zero."""
        stretches = []
        for k in (k for k in range(len(self.rests)) if not self.rests[k - 1]):
            last = k
            while self.rests[last]:
                last = (last + 1) % len(self.rests)
            stretches.append((self.zeros[k], self.zeros[last]))
        return tuple(stretches)

    def furthest(self, sense: float, kind: str = "") -> Extreme | None:
        """The extreme (of a kind) of the greatest value, with -1 for ``sense`` of the least; the first of equals.
        None where there is none, or none is known."""
        candidates = [e for e in self.extremes if kind in ("", e.kind) and not math.isnan(e.value)]
        most = max((sense * e.value for e in candidates), default=0.0)
        return next((e for e in candidates if math.isclose(sense * e.value, most, rel_tol=EQUAL)), None)

    @property
    def least(self) -> Extreme | None:
        return self.furthest(-1.0)


@dataclass(frozen=True)
class Curve:
    """A quantity, and its index among the curves that represent it."""

    quantity: Symbol
    pieces: Pieces
    k: int

    @cached_property
    def zeros(self) -> Array:
        """The parameters of its zeros, in increasing order; of the angle between two links, where they stand alike
        after any whole turns; none of a link's own angle."""
        if self.quantity.is_angle_of_link:
            return np.zeros(0)
        if self.quantity.kind != "theta":
            return self.pieces.zeros(self.k)
        low, high = (bound / math.tau for bound in self.pieces.span(self.k))
        turns = range(math.ceil(low), math.floor(high) + 1)
        zeros = np.sort(np.concatenate([self.pieces.zeros(self.k, math.tau * n) for n in turns]))
        whole = float(self.pieces.high[-1] - self.pieces.low[0])
        same = self.pieces.periodic and len(zeros) > 1 and zeros[-1] - zeros[0] > (1 - SAME) * whole
        return zeros[:-1] if same else zeros

    def about_zeros(self, values: Array) -> Array:
        """Its values at its zeros, before and after them, shape (3, n), without whole turns at the zeros."""
        values = values.reshape(3, -1)
        return values - math.tau * np.rint(values[0] / math.tau) if self.quantity.kind == "theta" else values


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
        low, high = (hair if away else 0.0 for away in self._away)
        return low, float(np.pi) - high

    @cached_property
    def _away(self) -> tuple[bool, bool]:
        """The ends at which links go away without bound."""
        low, high = self.reach.ends
        parts = np.array([1e-6, 1e-4])
        motion = self.reach.motion(np.append(low + parts * (high - low), high - parts * (high - low)), extended=False)
        far = np.max([np.abs(p.z) for p in motion.poses.values()], axis=0)
        # at an end where links only turn they come nearer to a place of theirs
        return not far[0] < 10 * far[1], not far[2] < 10 * far[3]

    @cached_property
    def seams(self) -> Array:
        """The seams between parts of a cam's law, in increasing order."""
        low, high = self.reach.ends
        offsets = self.reach.seams
        return offsets if self.reach.full else angles_between(offsets, low, high)

    def end(self, curve: Curve, which: int) -> float:
        """The value of a position at the lower or upper end of the motion, 0 where it is nothing but rounding."""
        value, size = self._at_end(curve, which), self.reach.scene.size
        return 0.0 if abs(value) <= NOTHING_AT_END * size**curve.quantity.measure.length else value

    def _at_end(self, curve: Curve, which: int) -> float:
        """The value at an end, where the solver refuses it, or loses half of its digits: from the curve, or from values
        nearer and nearer to the end."""
        value = np.nan if self._away[which] else float(curve.pieces.at(self.range[which], curve.k))
        if np.isfinite(value):
            return of_smooth(curve.quantity, value)
        (low, high), steps = self.range, np.arange(1.0, 9.0)
        if self._away[which]:
            parts = HAIR * 2.0 ** np.arange(2, 18)
            values = self._beside_end(curve.quantity, which, parts)
            reached = np.flatnonzero(np.isfinite(values))
            if len(reached) < LEAST_REACHED:
                return np.nan
            nearest, next_, third = np.abs(values[reached[:3]])
            if nearest > 1.5 * next_ > 2.25 * third:
                return float(np.copysign(np.inf, values[reached[0]]))
            values = self._beside_end(curve.quantity, which, parts[reached[0]] * steps)
        else:
            near = self.offset(high - STEPS_TO_END * steps if which else low + STEPS_TO_END * steps)
            values = course_of(curve.quantity, self.reach, self.reach.motion(near))
        value, _ = extrapolated(values.tolist(), steps.tolist())
        # an angle of at most 90 degrees is not negative, and 0 where it is rounding alone
        return 0.0 if curve.quantity.entry.acute and value < IN_LINE else value

    def _beside_end(self, quantity: Symbol, which: int, parts: Array) -> Array:
        """A quantity at parts of the range beside its lower or upper end."""
        low, high = self.reach.ends
        near = high - parts * (high - low) if which else low + parts * (high - low)
        return course_of(quantity, self.reach, self.reach.motion(near))

    def offset(self, parameter: Array) -> Array:
        return np.asarray(parameter) if self.reach.full else places_between(parameter, *self.reach.ends)

    def inside(self, parameter: Array) -> Array:
        """The parameters that are not at an end of the motion."""
        if self.reach.full:
            return parameter
        margin = NEAR_END * float(np.pi)
        low, high = self.range
        return parameter[(parameter > low + margin) & (parameter < high - margin)]


BESIDE_NOUGHT = 5e-8
"""Angles (rad) that rounding leaves beside a whole turn, where two assemblies meet."""


def driver_value(reach: DriverRange, offset: float) -> float:
    """Value of the first driver at an offset; an angle of a driver that turns fully within a turn from 0 on."""
    value = float(reach.value(np.array(offset)))
    if reach.full and reach.driver.turns:
        whole = 2 * np.pi * reach.turns
        value = value % whole
        value = 0.0 if min(value, whole - value) < BESIDE_NOUGHT else value
    return 0.0 if abs(value) < NOTHING else value


def trace(reach: DriverRange, quantities: Sequence[Symbol]) -> tuple[Traced, ...]:
    """Find all extremes and zeros of quantities; a mechanism that is singular throughout has none."""
    axis = CurveParameter(reach)
    places = [q for q in quantities if q.is_position]
    rates = [q for q in quantities if not q.is_position]
    here: dict[bytes, Motion] = {}

    def at(parameter: Array) -> Motion:
        key = parameter.tobytes()  # positions and rates are looked at on the same pieces at first
        if key not in here:
            here[key] = reach.motion(axis.offset(parameter), extended=False)
        return here[key]

    def resolved(group: Sequence[Symbol], floor: Array, weight: Array | None = None) -> list[Curve]:
        def columns(parameter: Array) -> tuple[Array, Array]:
            values, errors = zip(*(smooth_course(q, reach, at(parameter)) for q in group), strict=True)
            return np.stack(values, axis=1), np.stack(errors, axis=1)

        pieces = resolve(columns, *axis.range, reach.full, floor, weight, axis.seams)
        return [Curve(q, pieces, k) for k, q in enumerate(group)]

    # apart, because positions stay smooth where rates grow without bound
    curves: list[Curve] = []
    if places:
        curves += resolved(places, np.array([reach.scene.size**q.measure.length for q in places]))
    if rates:
        # near the end of a motion, a distance x away, velocities grow as x^-1/2 and accelerations as x^-3/2
        power = np.array([(2.0 * q.measure.order - 1.0) * (2 if q.is_vector else 1) for q in rates])
        curves += resolved(rates, _floor(reach, rates), None if reach.full else power * _grow(reach, rates))
    traced = _traced(axis, curves) if reach.full else _beside_ends(reach, _traced(axis, curves))
    finite = {t.quantity: t for t in traced if t.constant is None or np.isfinite(t.constant)}
    return tuple(finite[q] for q in quantities if q in finite)


def _values(
    reach: DriverRange, quantities: Sequence[Symbol], offsets: Sequence[Array], extended: bool = False,
    unit: bool = False,
) -> list[Array]:
    """Quantities at offsets of their own, any number for each, all from one motion; with ``unit`` for a driver of rate
    1."""
    ends = np.cumsum([0, *map(len, offsets)]).tolist()
    motion = reach.motion(np.concatenate([*offsets, np.zeros(1)]), unit=unit, extended=extended)
    return [course_of(q, reach, motion)[a:b] for q, (a, b) in zip(quantities, pairwise(ends), strict=True)]


def _grow(reach: DriverRange, rates: Sequence[Symbol]) -> Array:
    """Whether rates grow without bound towards the lower and the upper end, if it is known there, shape (2, n)."""
    low, high = reach.ends
    motion = reach.motion(low + (high - low) * np.concatenate([NEAR, 1.0 - NEAR]), extended=False)
    nearest, next_ = np.abs([course_of(q, reach, motion) for q in rates]).T.reshape(2, 2, -1).swapaxes(0, 1)
    return np.asarray(~(nearest <= GROWS * next_) & np.array(reach.limited)[:, None])


def _floor(reach: DriverRange, rates: Sequence[Symbol]) -> Array:
    """For each rate the size of such rates in this mechanism: smaller values within rounding are zero."""
    size = reach.scene.size
    motion = reach.motion(np.linspace(*reach.ends, 62)[1:-1], extended=False)
    poses = [motion.poses[link.name] for link in reach.scene.links]
    omega = max(_usual(p.omega) for p in poses)
    fields = {1: ("omega", "v"), 2: ("alpha", "a")}

    def usual(measure: Measure) -> float:
        here = [max(_usual(getattr(p, name)) for p in poses) for name in fields.get(measure.order, ())]
        turning, moving = here or (0.0, 0.0)
        turning = max(omega**measure.order, turning)
        return turning if measure.angle else max(turning * size, moving)

    return np.array([usual(q.measure) ** (2 if q.is_vector else 1) for q in rates]) * 1e-3


def _usual(values: Array) -> float:
    """The median size of the known values; 0 without any."""
    known = np.abs(values[np.isfinite(values)])
    return float(np.median(known)) if len(known) else 0.0


def _traced(axis: CurveParameter, curves: Sequence[Curve]) -> list[Traced]:
    reach = axis.reach
    start = reach.known
    constant = _constant(axis, curves)
    traced = []
    for curve in (c for c in curves if c.quantity in constant):
        quantity = curve.quantity
        nothing = not quantity.is_position and smooth_course(quantity, reach, start)[0][0] == 0.0
        traced.append(Traced(quantity, (), (), 0.0 if nothing else float(course_of(quantity, reach, start)[0])))
    moving = [c for c in curves if c.quantity not in constant]
    for curve, extremes, zeros in zip(moving, _extremes(axis, moving), _zeros(axis, moving), strict=True):
        quantity = curve.quantity
        if quantity.is_unsigned:
            most = max((e.value for e in extremes if e.kind != "end"), default=0.0)
            extremes = tuple(replace(e, value=0.0) if e.value <= 1e-11 * most else e for e in extremes)
            least = [e.offset for e in extremes if e.value == 0.0 and e.kind != "end"]
            zeros = np.union1d(least, zeros[np.isin(zeros, reach.seams)])
        at_zero = tuple(driver_value(reach, float(z)) for z in zeros)
        traced.append(Traced(quantity, extremes, at_zero, rests=_rests(axis, curve, zeros)))
    return traced


def _rests(axis: CurveParameter, curve: Curve, zeros: Array) -> tuple[bool, ...]:
    """Whether a curve is zero from each of its zeros (offsets) to the next: along a dwell."""
    reach, (low, high) = axis.reach, axis.reach.ends
    at = zeros if reach.full else angles_between(zeros, low, high)
    following = np.append(at[1:], at[:1] + (high - low) if reach.full else at[-1:])
    between = at + np.linspace(0.0, 1.0, 5)[1:-1, None] * (following - at)
    between = low + np.remainder(between - low, high - low) if reach.full else between
    rests = (np.abs(curve.pieces.at(between, curve.k)) <= AT_REST * curve.pieces.scale[curve.k]).all(axis=0)
    return (*rests[:-1].tolist(), *(rests[-1:] & reach.full).tolist())


def _zeros(axis: CurveParameter, curves: Sequence[Curve]) -> list[Array]:
    """Offsets at which curves are zero.  Near an end of the motion, where rounding grows without bound, a curve that it
    hides is zero too: there fifty digits tell."""
    offsets = [axis.offset(axis.inside(curve.zeros)) for curve in curves]
    if axis.reach.full:
        return offsets
    low, high = axis.reach.ends
    steps = [ASIDE * np.minimum(zeros - low, high - zeros) for zeros in offsets]
    places = [np.concatenate([zeros, zeros - step, zeros + step]) for zeros, step in zip(offsets, steps, strict=True)]
    values = _values(axis.reach, [c.quantity for c in curves], places, extended=True)
    zero = [
        np.isin(zeros, axis.reach.seams) | ~(np.abs(at) > ZERO * np.max(np.abs(beside), axis=0))
        for zeros, (at, *beside) in zip(offsets, map(Curve.about_zeros, curves, values), strict=True)
    ]
    return [zeros[is_one] for zeros, is_one in zip(offsets, zero, strict=True)]


def _beside_ends(reach: DriverRange, curves: Sequence[Traced]) -> list[Traced]:
    """Curves over a range that ends, with what goes beyond their extremes, and what grows without bound."""
    low, high = reach.ends
    part = np.concatenate([NEAR, np.sin(np.linspace(0.0, np.pi / 2, SAMPLES)[1:-1]) ** 2, 1.0 - NEAR[::-1]])
    motion, traced = reach.motion(low + (high - low) * part), list[Traced]()
    for curve in curves:
        values = course_of(curve.quantity, reach, motion)
        size, known = np.abs(values), values[np.isfinite(values)]
        slack = LOCAL * float(np.max(np.abs(known), initial=0.0))
        most, least = float(np.max(known, initial=-np.inf)) - slack, float(np.min(known, initial=np.inf)) + slack
        extremes = tuple(
            replace(e, local=e.kind != "end" and (most > e.value if e.kind == "max" else least < e.value))
            for e in curve.extremes
        )
        grows = size[0] > GROWS * size[1], size[-1] > GROWS * size[-2]
        unbounded = curve.constant is None and any(np.logical_and(grows, reach.limited))
        traced.append(replace(curve, extremes=extremes, unbounded=unbounded))
    return traced


def _constant(axis: CurveParameter, curves: Sequence[Curve]) -> set[Symbol]:
    """Quantities that do not change; rates, wherever they are finite."""
    constant = {c.quantity for c in curves if c.pieces.is_constant(c.k)}
    low, high = axis.range
    motion = axis.reach.motion(axis.offset(np.linspace(low, high, 34)[1:-1]), extended=False)
    for quantity in (c.quantity for c in curves if not c.quantity.is_position):
        values, errors = smooth_course(quantity, axis.reach, motion)
        known = np.isfinite(values)
        values, errors = values[known], np.broadcast_to(errors, known.shape)[known]
        room = 1e-12 * np.max(np.abs(values), initial=0.0) + np.where(np.isfinite(errors), errors, 0.0)
        if len(values) == 0 or np.all(np.abs(values - np.median(values)) <= room):
            constant.add(quantity)
    return constant


def _polished(axis: CurveParameter, curves: Sequence[Curve], turns: Sequence[Sequence[Turn]]) -> list[Array]:
    """Offsets of the turns; of angles and travels to the last digits, by Newton's method on the rate by the driver."""
    reach = axis.reach
    low, high = reach.ends
    offsets = [axis.offset(np.array([turn.place for turn in reversals])) for reversals in turns]
    which = [k for k, c in enumerate(curves) if c.quantity.is_of_output and len(offsets[k])]
    both = [q for k in which for q in rates_of(curves[k].quantity)[1:]]
    rates = _values(reach, both, [offsets[k] for k in which for _ in range(2)], unit=True) if which else []
    for k, rate, second in zip(which, rates[::2], rates[1::2], strict=True):
        inner = ~np.array([turn.at_seam for turn in turns[k]])
        with np.errstate(all="ignore"):
            step = rate / second
        step = np.where(inner & (np.abs(step) < 1e-5 * (high - low)), step, 0.0)
        offsets[k] = np.clip(offsets[k] - step, low, high)
    return offsets


def _extremes(axis: CurveParameter, curves: Sequence[Curve]) -> list[tuple[Extreme, ...]]:
    """The extremes of each curve, and of a position its values where the motion ends (not where it is followed no
    further)."""
    reach = axis.reach
    low, high = reach.ends
    # a rate that rests along a dwell is at no extreme there; a size is, for it is nowhere less
    turns = [
        [turn for turn in c.pieces.turns(c.k, c.quantity.is_position or c.quantity.is_vector)
         if turn.at_seam or len(axis.inside(np.array([turn.place])))]
        for c in curves
    ]
    offsets = _polished(axis, curves, turns)
    # only what is printed takes all its digits
    values = _values(reach, [c.quantity for c in curves], offsets, extended=True)
    extremes: list[tuple[Extreme, ...]] = []
    for curve, reversals, places, fine in zip(curves, turns, offsets, values, strict=True):
        ends: list[list[Extreme]] = [[], []]
        if not reach.full and curve.quantity.is_position:
            ends = [[Extreme("end", at, driver_value(reach, at), axis.end(curve, k))] if limited else []
                    for k, (at, limited) in enumerate(zip((low, high), reach.limited, strict=True))]
        inner = []
        for turn, place, value in zip(reversals, places.tolist(), fine.tolist(), strict=True):
            # at a jump both values stand at one place
            # and where a group stands in line, at a change point, the solver refuses
            value = of_smooth(curve.quantity, turn.value) if turn.at_seam or np.isnan(value) else value
            kind: Literal["max", "min"] = "max" if turn.sense > 0 else "min"
            inner.append(Extreme(kind, place, driver_value(reach, place), value, rest=turn.rest))
        extremes.append((*ends[0], *inner, *ends[1]))
    return extremes
