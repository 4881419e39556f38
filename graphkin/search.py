"""Zeros, extremes and intervals of a function of one variable: the one search of the house.

Conditions, which are only true or false, and functions that take long to compute are searched by sections.  Smooth
curves are represented as Chebyshev polynomials, for zeros and extremes to full accuracy, not to a grid: a curve is cut
into pieces until the last coefficients vanish in rounding; zeros are roots of the polynomials, extremes roots of their
derivatives (Boyd, Computing zeros on a real interval through Chebyshev expansion and polynomial rootfinding, SIAM J.
Numer. Anal. 40, 2002; Trefethen, Approximation Theory and Approximation Practice).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike, NDArray

Array = NDArray[Any]
SECTIONS = 64
LEAST_SECTIONS = 16
MOST_DIVISIONS = 100
NARROW = 1e-11
"""A least value is flat: its place has no more digits."""
ROUNDED = 1e-11
"""An angle (rad) between limit positions that is nothing but rounding."""
SAME_VALUE = 1e-12
"""Of the range of values: what is greater by less is the same."""


def last_true(
    holds: Callable[[Array], Array], low: float, high: float, sections: int = SECTIONS, within: float = 0.0
) -> float:
    """The last place at which a condition holds that is true at ``low`` and false at ``high``, in either order.

    Parameters
    ----------
    holds : function of places, shape (n,), to bool, shape (n,)
    sections : the number of sections computed together; 2 where each place takes long
    within : the accuracy of the place; 0 for the last digit
    """
    while True:
        at = np.linspace(low, high, sections + 1)
        false = np.flatnonzero(~holds(at[1:-1]))
        i = int(false[0]) if len(false) else sections - 1
        if abs(high - low) <= max(within, 4e-16 * max(1.0, abs(high))) or (at[i], at[i + 1]) == (low, high):
            return float(low)
        low, high = float(at[i]), float(at[i + 1])


def zero_between(function: Callable[[float], float], low: float, high: float) -> float:
    """The zero of a slow function between two places of opposite senses, or the place on the way there where it is nan.

    By proportional division, the value of an end halved that stays for the second time (regula falsi, Illinois variant;
    Dowell and Jarratt, BIT 11, 1971).
    """
    kept, value_kept, other, value = low, function(low), high, function(high)
    stayed: float | None = None
    for _ in range(MOST_DIVISIONS):
        share = value_kept - value
        at = (value_kept * other - value * kept) / share if share else (kept + other) / 2
        if not min(kept, other) < at < max(kept, other):
            at = (kept + other) / 2
        value_there = function(at)
        narrow = abs(other - kept) <= 4e-16 * max(abs(kept), abs(other), 1.0)
        if value_there == 0.0 or np.isnan(value_there) or narrow:
            break
        if (value_there > 0.0) == (value_kept > 0.0):
            kept, value_kept, other = other, value, kept
        value_kept /= 2.0 if kept == stayed else 1.0
        stayed, other, value = kept, at, value_there
    return at


def changes(holds: Callable[[Array], Array], grid: Array, within: float = 0.0) -> list[float]:
    """The ends of the intervals in which a condition holds, along a grid fine enough to see every change, to the last
    digit (or ``within``): places where it still holds."""
    true = holds(grid)
    pairs = ((k, k + 1) if true[k] else (k + 1, k) for k in np.flatnonzero(true[1:] != true[:-1]))
    return [last_true(holds, float(grid[inside]), float(grid[outside]), within=within) for inside, outside in pairs]


def intervals(holds: Callable[[Array], Array], grid: Array) -> list[tuple[float, float]]:
    """The intervals in which a condition holds along a grid, as for ``changes``; at most from its first to its last
    place."""
    first, last = holds(grid[[0, -1]]).tolist()
    places = [*([float(grid[0])] if first else []), *changes(holds, grid), *([float(grid[-1])] if last else [])]
    return list(zip(places[::2], places[1::2], strict=True))


def least_value(
    function: Callable[[Array], Array], low: float, high: float, enough: float = -np.inf, within: float = NARROW
) -> tuple[float, float]:
    """Place (to ``within``) and value of the least value between two places, with one valley between them; a value
    below ``enough`` ends the search."""
    while True:
        at = np.linspace(low, high, LEAST_SECTIONS + 1)
        value = function(at)
        i = int(np.nanargmin(value))
        if value[i] < enough or high - low < within:
            return float(at[i]), float(value[i])
        low, high = float(at[max(i - 1, 0)]), float(at[min(i + 1, LEAST_SECTIONS)])


class Strokes(NamedTuple):
    """Both strokes of an output in a cycle of its driver: the indices of a least and a greatest value from which it
    leaves for the other, and the ways of the driver to the greatest and to the least."""

    low: int
    high: int
    out: float
    back: float

    @property
    def lag(self) -> float:
        """The angle theta = 180 (K - 1) / (K + 1) (rad): the acute angle between a crank's two limit positions."""
        lag = math.pi * abs(self.out - self.back) / (self.out + self.back)
        return lag if lag > ROUNDED else 0.0

    @property
    def ratio(self) -> float:
        """K = (180 + theta) / (180 - theta): the longer way of a crank over the shorter (coefficient of travel speed
        variation, 行程速比系数; time ratio, Norton, Design of Machinery, ch. 3)."""
        return (math.pi + self.lag) / (math.pi - self.lag)


def strokes_between(
    lows: Sequence[tuple[float, float]], highs: Sequence[tuple[float, float]], cycle: float
) -> Strokes:
    """The strokes between the least and the greatest values of an output, of which several may be equal.  Rests, and
    the way from one of several equal values to the next, belong to neither stroke.

    Parameters
    ----------
    lows, highs : the place of each in the order of the motion, and the way before it on which the output rests
    """
    both = [(place % cycle, rest, side, k) for side, extremes in enumerate((lows, highs))
            for k, (place, rest) in enumerate(extremes)]
    both.sort()
    travels, leaves = [0.0, 0.0], dict[int, int]()
    for (place, _, side, k), (following, rest, other, _) in pairwise([*both, both[0]]):
        if other != side:
            travels[other] += (following - place) % cycle - rest
            leaves.setdefault(side, k)
    return Strokes(leaves[0], leaves[1], travels[1], travels[0])


def greatest_and_least(
    function: Callable[[Array], Array], places: Array, values: Array, within: float
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Place and value of the greatest and of the least value of a sampled course over growing places, each sought
    between the neighbours of every sample beside which it may lie."""
    extremes, last = [], len(places) - 1
    for sign in (-1.0, 1.0):
        course = sign * values
        k = int(np.nanargmin(course))
        place, least = float(places[k]), float(course[k])
        # a curve through three samples goes no farther beyond the middle one than that lies beyond the others
        beside = np.concatenate([course[1:2], course, course[-2:-1]])
        beside = np.stack([beside[:-2], beside[2:]])
        rounding = SAME_VALUE * np.fmax.reduce(np.abs([course, *beside]))
        dips = (course <= beside).all(axis=0) & (2 * course - beside.max(axis=0) < least - rounding)
        for dip in {k, *np.flatnonzero(dips).tolist()}:
            low, high = float(places[max(dip - 1, 0)]), float(places[min(dip + 1, last)])
            near, value = least_value(lambda at, by=sign: by * function(at), low, high, within=within)  # type: ignore[misc]
            if value < least - rounding[dip]:
                place, least = near, value
        extremes.append((place, sign * least))
    return extremes[0], extremes[1]


def places_between(angle: Array, low: float, high: float) -> Array:
    """Places from ``low`` to ``high`` by an angle (rad) from 0 to pi whose cosine runs from one to the other: what
    grows like a root of the distance to an end is smooth by it.  Nothing is lost near the ends."""
    first, last = low + (high - low) * np.sin(angle / 2) ** 2, high - (high - low) * np.cos(angle / 2) ** 2
    return np.asarray(np.where(angle < np.pi / 2, first, last))


def angles_between(places: Array, low: float, high: float) -> Array:
    """The angles (rad) by which ``places_between`` gives these places."""
    return np.asarray(2 * np.arcsin(np.sqrt((places - low) / (high - low))))


def extrapolated(values: Sequence[float], steps: Sequence[float]) -> tuple[float, float]:
    """The value at 0 of the polynomial through values at steps, and how far the last of them moves it (Neville's
    scheme)."""
    column, before = [*values], values[0]
    for k in range(1, len(column)):
        before = column[0]
        column = [(a * y - b * x) / (y - x) for a, b, x, y in zip(column, column[1:], steps, steps[k:], strict=False)]
    return column[0], abs(column[0] - before)


POINTS = 24
FIRST_PIECES = 8
MOST_DEPTH = 12
LEFT_OUT = 4
"""A piece in which a value is not finite is halved this often at most."""
MOST_PIECES = 500
MOST_ROOTS = 400
"""A curve with more roots over its range is rounding."""
RESOLVED = 2e-14
PLATEAU = 1e-10
OUTSIDE = 1e-9
"""A root this far outside its piece (in half widths) is still its own: two pieces meet there."""
FLAT = 64.0
"""Times the rounding of a curve: what is more has a sign."""
CONTINUOUS = 1e-6
"""Of the values beside it: a curve that changes by less where it crosses zero does not jump there."""
SAME = 1e-8
CLOSE = 1e-6
"""Of the range: zeros this near to one at a seam are that one."""
NOTHING = 1e-12
"""Of the largest value: what a curve is where it is zero."""
BESIDE = 1e-4
"""Of the range: so far beside a place at rest one sees whether the curve turns there."""
FARTHER = 1e-3
"""Of the range: so far where it is too flat to see."""
STILL = 4e-15
"""Of the largest value: rounding of the values of a polynomial."""
BESIDE_SEAM = 1e-3
"""Of the range, at most: so far beside a seam one sees how a curve comes to it, and how it goes on."""
SAME_AT_SEAM = 1e-11
"""Of the largest value: a curve that changes by less stands still."""

_NODES = np.cos(np.pi * (np.arange(POINTS) + 0.5) / POINTS)[::-1]
_VALUES = chebyshev.chebvander(_NODES, POINTS - 1)
_FIT = np.linalg.inv(_VALUES)


class Turn(NamedTuple):
    """A turning point of a curve: its parameter and value, 1 at a greatest and -1 at a least value, whether a seam lies
    there, and how long the curve has been constant before it: from seam to seam."""

    place: float
    value: float
    sense: float
    at_seam: bool = False
    rest: float = 0.0


@dataclass(frozen=True, eq=False, repr=False)
class Pieces:
    """Curves over a range of a parameter.

    low, high : shape (pieces,), the ends of each piece, in increasing order
    coefficients : shape (pieces, points, curves)
    weight : shape (2, curves), the powers of the sine and of the cosine of half the parameter by which the curves were
        multiplied to stay finite at the lower and at the upper end
    seams : parameters at which curves may jump or bend, each between two pieces
    scale : shape (curves,), the largest value of each curve (a typical one where it grows without bound), or the floor
    doubt : shape (pieces, curves), the bound of the error of each piece; infinite where a piece is left out
    """

    low: Array
    high: Array
    coefficients: Array
    scale: Array
    periodic: bool
    weight: Array
    doubt: Array
    seams: Array

    def zeros(self, curve: int, level: float = 0.0) -> Array:
        """Parameters at which a curve is zero, in increasing order; of a stretch along which it is zero, the ends.  A
        curve without a weight may be looked at from another ``level``."""
        coefficients = self.coefficients[:, :, curve] - level * np.eye(1, POINTS)
        roots = self._roots(coefficients, self.scale[curve], self.doubt[:, curve])
        if not len(self.seams):
            return roots
        whole = self.high[-1] - self.low[0]
        nothing = np.abs(self.levels(curve) - level).min(axis=0) <= NOTHING * self.scale[curve]
        for seam in self.seams[nothing]:
            # several roots at one end are found apart, by the root of the rounding
            distance = np.abs(roots - seam)
            distance = np.minimum(distance, whole - distance) if self.periodic else distance
            roots = np.append(roots[distance > CLOSE * whole], seam)
        return np.sort(roots)

    def near_zero(self, curve: int, within: float) -> tuple[Array, Array]:
        """Zeros and extremes of a curve from the pieces in which it may come within ``within`` of zero; without
        seams."""
        c = self.coefficients[:, :, curve]
        near = np.abs(c[:, 0]) <= np.abs(c[:, 1:]).sum(axis=1) + within
        if not near.any():
            return np.zeros(0), np.zeros(0)
        part = replace(self, low=self.low[near], high=self.high[near], coefficients=self.coefficients[near],
                       doubt=self.doubt[near], seams=self.seams[:0])
        return part.zeros(curve), part.extremes(curve)

    def extremes(self, curve: int) -> Array:
        """Parameters at which the derivative of a curve is zero, in increasing order."""
        c = self.coefficients[:, :, curve]
        slopes = np.ascontiguousarray(chebyshev.chebder(c, axis=1))
        first, last = self.weight[:, curve] / 2
        if first or last:
            # f = g / (s^2a c^2b), s and c of half the parameter, is at rest where g' s c - g (a c^2 - b s^2) = 0
            half = (self.high - self.low)[:, None] / 2
            at = ((self.low + self.high)[:, None] / 2 + half * _NODES) / 2
            g = c @ _VALUES.T
            dg = slopes @ _VALUES[:, :-1].T / half
            rising, falling = np.sin(at) ** (first > 0), np.cos(at) ** (last > 0)
            bent = first * np.cos(at) * falling - last * np.sin(at) * rising
            slopes = (half * (dg * rising * falling - g * bent)) @ _FIT.T
        # rounding of the values, seen in the derivative of a polynomial of this degree
        return self._roots(slopes, self.scale[curve] * POINTS, self.doubt[:, curve] * POINTS)

    def turns(self, curve: int, at_rest: bool = True) -> list[Turn]:
        """The greatest and least values of a curve among their neighbours, in increasing order of the parameter; none
        where it only stands still for a moment.  At a seam it may jump, or leave a stretch along which it is constant;
        then the end of the stretch counts.

        Parameters
        ----------
        at_rest : whether a seam counts at which the curve is zero
        """
        low, high = float(self.low[0]), float(self.high[-1])
        places = self.extremes(curve)
        room = np.inf if self.periodic else np.minimum(places - low, high - places) / 2
        near, far = (np.minimum(by * (high - low), room) for by in (BESIDE, FARTHER))
        beside = self._within(np.stack([places - near, places + near, places - far, places + far]))
        values, *around = self.at(np.concatenate([places[None], beside]), curve)
        # 1 where the curve is greater at a place than beside it, -1 where it is less, 0 where rounding does not tell
        more = (values - np.stack(around)).reshape(2, 2, -1)
        certain = np.abs(more) > STILL * np.maximum(self.scale[curve], np.abs(values))
        sides, farther = np.where(certain, np.sign(more), 0.0)
        rises, falls = np.where(sides.all(axis=0), sides, farther)
        turning = (rises == falls) & (np.abs(rises) == 1.0)
        at_seams = list[Turn]()
        if len(self.seams):
            at_seams, of_seam = self._turns_at_seams(curve, at_rest, places, values)
            turning &= ~of_seam
        inner = zip(*(x[turning].tolist() for x in (places, values, rises)), strict=True)
        turns = sorted([*at_seams, *(Turn(place, value, sense) for place, value, sense in inner)])
        # between two greatest values lies a least one: where none is found, rounding has parted one place
        short = BESIDE * (high - low)
        parted = [turn for turn, after in pairwise(turns) if turn.sense == after.sense
                  and not (turn.at_seam or after.at_seam) and after.place - turn.place < short]
        return [turn for turn in turns if turn not in parted]

    def _turns_at_seams(
        self, curve: int, at_rest: bool, places: Array, values: Array
    ) -> tuple[list[Turn], NDArray[np.bool_]]:
        """The turns of a curve at seams, and which places of no slope, with their values, are those of a seam."""
        low, high, slack = float(self.low[0]), float(self.high[-1]), SAME_AT_SEAM * self.scale[curve]
        wide = high - low
        turns, levels = list[Turn](), self.levels(curve)
        # a seam has room up to the next one, or to an end of the range
        first, last = (self.seams[-1:] - wide, self.seams[:1] + wide) if self.periodic else ([low], [high])
        gaps = np.diff(np.concatenate([first, self.seams, last]))
        near = np.minimum(BESIDE_SEAM * wide, np.minimum(gaps[:-1], gaps[1:]) / 3)
        before, after = (self.at(self._within(self.seams + by), curve) for by in (-near, near))
        for sense in (1.0, -1.0):
            top = sense * (sense * levels).max(axis=0)
            turning = (sense * (top - before) >= -slack) & (sense * (top - after) > slack)
            turning &= at_rest | (np.abs(top) > slack)
            for k in np.flatnonzero(turning).tolist():
                rest = self._rest(curve, k, float(top[k]), slack)
                turns.append(Turn(float(self.seams[k]), float(top[k]), sense, True, rest))
        distance = np.abs(places[:, None] - self.seams)
        distance = np.minimum(distance, wide - distance) if self.periodic else distance
        same = (np.abs(levels - values[:, None, None]) <= slack).any(axis=1)
        return turns, np.asarray(((distance < near) & same).any(axis=1))

    def _rest(self, curve: int, seam: int, level: float, slack: float) -> float:
        """The length of the stretch before a seam, from another seam on, along which a curve keeps a level."""
        whole, rest = float(self.high[-1] - self.low[0]), 0.0
        for back in range(1, len(self.seams) if self.periodic else seam + 1):
            length = float(self.seams[seam] - self.seams[seam - back])
            length += whole if back > seam else 0.0
            inside = self._within(self.seams[seam] - np.linspace(rest, length, POINTS + 1)[1:-1])
            if np.abs(self.at(inside, curve) - level).max() > slack:
                break
            rest = length
        return rest

    def _within(self, parameter: Array) -> Array:
        """The parameters, of a periodic range reduced to it."""
        low, high = self.low[0], self.high[-1]
        return low + np.remainder(parameter - low, high - low) if self.periodic else np.clip(parameter, low, high)

    def at(self, parameter: ArrayLike, curve: int, after: bool = False) -> Array:
        """The values of a curve by its polynomials, also at an end where the curve itself cannot be computed; at a seam
        the value before or ``after`` it; not a number in a piece that was left out."""
        places = np.asarray(parameter, dtype=float)
        piece = np.minimum(np.searchsorted(self.high, places, "right" if after else "left"), len(self.high) - 1)
        low, high = self.low[piece], self.high[piece]
        powers = chebyshev.chebvander((2 * places - low - high) / (high - low), POINTS - 1)
        values = (powers * self.coefficients[piece, :, curve]).sum(axis=-1).reshape(places.shape)
        with np.errstate(all="ignore"):
            values = values / _weighing(places, self.weight[:, curve]) if self.weight[:, curve].any() else values
        return np.asarray(np.where(np.isinf(self.doubt[piece, curve]), np.nan, values))

    def levels(self, curve: int) -> Array:
        """The values of a curve before and after each seam, shape (2, seams)."""
        before = np.where(self.periodic & (self.seams == self.low[0]), self.high[-1], self.seams)
        return np.stack([self.at(before, curve), self.at(self.seams, curve, after=True)])

    def span(self, curve: int) -> tuple[float, float]:
        """Two values between which the known part of a curve lies."""
        c = self.coefficients[np.isfinite(self.doubt[:, curve]), :, curve]
        rest = np.abs(c[:, 1:]).sum(axis=1)
        return float(np.min(c[:, 0] - rest, initial=0.0)), float(np.max(c[:, 0] + rest, initial=0.0))

    def is_constant(self, curve: int) -> bool:
        """Whether the known part of a curve changes by rounding alone."""
        c = self.coefficients[np.isfinite(self.doubt[:, curve]), :, curve]
        level = c[:1] * np.eye(1, c.shape[1])  # the constant of the first piece
        most = float(np.max(np.abs(c - level), initial=0.0))
        return most <= 1e-12 * float(self.scale[curve])

    def _roots(self, coefficients: Array, scale: float, doubt: Array) -> Array:
        rounding = 1e-15 * scale
        rest = np.sum(np.abs(coefficients[:, 1:]), axis=1)
        # a piece that is nothing but rounding has no roots
        look = (np.abs(coefficients[:, 0]) <= rest + rounding) & (rest > np.maximum(rounding, doubt))
        pieces = zip(self.low[look], self.high[look], coefficients[look], strict=True)
        roots = [float((low + high) / 2 + (high - low) / 2 * x)
                 for low, high, c in pieces for x in _real_roots(c, rounding)]
        roots += self._crossings(coefficients, FLAT * np.maximum(rounding, doubt), roots)
        if len(roots) > MOST_ROOTS:
            return np.zeros(0)
        roots.sort()
        kept: list[float] = []
        whole = self.high[-1] - self.low[0]
        for t in roots:
            distance = t - kept[-1] if kept else np.inf
            if distance <= BESIDE * whole and self._unsure(coefficients, doubt, t - distance / 2):
                kept[-1] = t - distance / 2  # rounding has parted one root
            elif distance > SAME * whole:
                kept.append(min(max(t, float(self.low[0])), float(self.high[-1])))
        if self.periodic and len(kept) > 1 and kept[-1] - kept[0] > (1 - SAME) * whole:
            kept.pop()
        return np.array(kept)

    def _unsure(self, coefficients: Array, doubt: Array, place: float) -> bool:
        """Whether polynomials, shape (pieces, k), are no more at a place than what they may be off."""
        k = min(int(np.searchsorted(self.high, place)), len(self.high) - 1)
        low, high = self.low[k], self.high[k]
        return bool(abs(chebyshev.chebval((2 * place - low - high) / (high - low), coefficients[k])) <= doubt[k])

    def _crossings(self, coefficients: Array, noise: Array, roots: Sequence[float]) -> list[float]:
        """Where curves cross zero and no polynomial tells the root: where two pieces meet, or several roots at once,
        which rounding moves off the axis.  Of a stretch of noise, its middle.

        Parameters
        ----------
        coefficients : shape (pieces, k)
        noise : shape (pieces,), below which no sign is sure
        roots : those known
        """
        whole = self.high[-1] - self.low[0]
        which, low, high = np.arange(len(self.low)), self.low, self.high
        known = np.array([*roots, *self.seams])
        if self.periodic:
            which, low, high = np.append(which, 0), np.append(low, low[0] + whole), np.append(high, high[0] + whole)
            known = np.append(known, known + whole)

        def values(place: Array, piece: Array) -> Array:
            """Of a curve at places in pieces; 0 where there is nothing but noise."""
            x = (2 * place - low[piece] - high[piece]) / (high - low)[piece]
            value = (chebyshev.chebvander(x, coefficients.shape[1] - 1) * coefficients[which[piece]]).sum(axis=1)
            return np.where(np.abs(value) > noise[which[piece]], value, 0.0)

        pieces = np.repeat(np.arange(len(low)), POINTS)
        places = (((low + high)[:, None] + (high - low)[:, None] * _NODES) / 2).ravel()
        at_nodes = (_VALUES[:, : coefficients.shape[1]] * coefficients[which][:, None]).sum(axis=2)
        signed = np.where(np.abs(at_nodes) > noise[which][:, None], at_nodes, 0.0).ravel()
        ends, crossings = np.flatnonzero(signed), list[float]()
        turning = (signed[ends[1:]] * signed[ends[:-1]] < 0) & (pieces[ends[1:]] - pieces[ends[:-1]] < 2)
        for i, k in zip(ends[:-1][turning].tolist(), ends[1:][turning].tolist(), strict=True):
            first, last = places[i], places[k]
            if ((known > first - SAME * whole) & (known < last + SAME * whole)).any():
                continue
            for _ in range(MOST_DEPTH):
                inner = np.linspace(first, last, POINTS)
                value = values(inner, np.where(inner > high[pieces[i]], pieces[k], pieces[i])) * np.sign(signed[k])
                first, last = inner[value < 0][-1], inner[value > 0][0]
            # where a curve jumps, it crosses zero without being zero
            largest = np.abs(signed[(pieces == pieces[i]) | (pieces == pieces[k])]).max()
            if value[-1] - value[0] < CONTINUOUS * largest + 4 * noise[which[[pieces[i], pieces[k]]]].max():
                crossings.append(float(first + last) / 2)
        return crossings


def _real_roots(c: Array, rounding: float) -> list[float]:
    significant = np.flatnonzero(np.abs(c) > rounding)
    c = c[: int(significant[-1]) + 1] if len(significant) else c[:1]
    if len(c) < 2:
        return []
    slope = chebyshev.chebder(c)
    roots = []
    for z in chebyshev.chebroots(c):
        if abs(z.imag) > 1e-6 or abs(z.real) > 1 + 1e-6:
            continue
        x, rate = float(z.real), 0.0
        for _ in range(3):
            rate = float(chebyshev.chebval(x, slope))
            step = float(chebyshev.chebval(x, c) / rate) if rate else 0.0
            x -= step if abs(step) < 1e-6 else 0.0
        # a pair of complex roots near the axis is a curve that comes close to zero without reaching it
        outside = max(OUTSIDE, 4 * rounding / abs(rate) if rate else 0.0)
        if abs(x) <= 1 + outside and (abs(z.imag) < 1e-12 or _crosses(c, x, abs(z.imag))):
            roots.append(min(max(x, -1.0), 1.0))
    return roots


def _crosses(c: Array, x: float, reach: float) -> bool:
    """Whether a polynomial changes sign near a root."""
    step = max(10 * reach, 1e-9)
    before, after = chebyshev.chebval(np.array([x - step, x + step]), c)
    return bool(before * after <= 0)


def _weighing(parameter: Array, weight: Array) -> Array:
    return np.asarray(np.sin(parameter / 2) ** weight[0] * np.cos(parameter / 2) ** weight[1])


def resolve(
    curves: Callable[[Array], tuple[Array, Array]],
    low: float,
    high: float,
    periodic: bool = False,
    floor: Array | float = 0.0,
    weight: Array | None = None,
    seams: Array | None = None,
) -> Pieces:
    """Represent curves to rounding.

    Parameters
    ----------
    curves : function of parameters, shape (n,), to values and bounds of their errors, shape (n, curves); a short piece
        with values that are not finite is left out: it has no roots
    low, high : range of the parameter
    periodic : whether both ends are the same position
    weight : shape (2, curves), powers of the sine and of the cosine of half the parameter that the curves are
        multiplied by: over a range 0 .. pi, for curves that grow without bound at its lower or upper end.  Zeros and
        extremes are those of the curve itself.
    floor : shape (curves,), values that vanish in rounding beside it count as zero
    seams : parameters inside the range at which curves may jump or bend: pieces end there
    """
    seams = np.zeros(0) if seams is None else np.sort(seams)
    edges = np.linspace(low, high, FIRST_PIECES + 1)
    if len(seams):
        far = np.abs(edges[:, None] - seams).min(axis=1) > (high - low) / (4 * FIRST_PIECES)
        far[[0, -1]] = True
        edges = np.unique(np.concatenate([edges[far], seams]))
    waiting = np.stack([edges[:-1], edges[1:]], axis=1)
    before = np.full((len(waiting), 1), np.inf)
    done: list[tuple[Array, Array, Array]] = []
    scale = usual = np.zeros(1)
    for depth in range(MOST_DEPTH + 1):
        middle, half = waiting.mean(axis=1), np.diff(waiting, axis=1)[:, 0] / 2
        at = middle[:, None] + half[:, None] * _NODES
        value, error = curves(at.ravel())
        if weight is not None:
            by = _weighing(at.ravel()[:, None], weight)
            value, error = value * by, error * by
        value, error = (x.reshape(len(waiting), POINTS, -1) for x in (value, error))
        broken: NDArray[np.bool_] = np.asarray(~np.isfinite(value).all(axis=1))
        value = np.where(np.isfinite(value), value, 0.0)
        # a bound that is not known stops nothing, and hides nothing
        doubt = np.where(np.isfinite(error), error, 0.0).max(axis=1)
        local = np.abs(value).max(axis=1)
        if depth == 0:
            # a curve that grows without bound at an end is represented to the rounding of its values there
            scale = np.maximum(np.minimum(local.max(axis=0), 30 * np.median(local, axis=0)), floor)
            usual = scale
        c = np.einsum("kn,pnc->pkc", _FIT, value)
        tail = np.abs(c[:, -3:]).max(axis=1)
        size = np.maximum(np.maximum(local, usual), 1e-300)
        # what is small and does not shrink when a piece is halved is rounding, which no halving takes away
        rounding = (tail < PLATEAU * size) & (tail > 0.25 * before)
        unsure = (tail > np.maximum(RESOLVED * size, doubt)) & ~rounding
        rough = ((broken & (depth < LEFT_OUT)) | (unsure & ~broken)).any(axis=1)
        c = np.where(broken[:, None, :], 0.0, c)
        lost = np.where(broken, np.inf, doubt)
        if depth == MOST_DEPTH or len(done) + 2 * int(rough.sum()) > MOST_PIECES:
            rough[:] = False
        done += list(zip(waiting[~rough], c[~rough], lost[~rough], strict=True))
        if not rough.any():
            break
        low_, high_, mid = waiting[rough, 0], waiting[rough, 1], middle[rough]
        waiting = np.concatenate([np.stack([low_, mid], axis=1), np.stack([mid, high_], axis=1)])
        before = np.concatenate([tail[rough], tail[rough]])
    done.sort(key=lambda piece: float(piece[0][0]))
    ends, coefficients, lost = (np.stack(part) for part in zip(*done, strict=True))
    low_ends, high_ends = np.ascontiguousarray(ends.T)
    weight = np.zeros((2, len(scale))) if weight is None else weight
    return Pieces(low_ends, high_ends, coefficients, scale, periodic, weight, lost, seams)
