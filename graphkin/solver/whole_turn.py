"""Quantities of the whole turn: stroke of a slide, swing of a link, coefficient of travel-speed variation."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.scene.cams import LawCam, SlidingFollower
from graphkin.scene.symbol import Symbol
from graphkin.search import last_true
from graphkin.solver.cams import beginning
from graphkin.solver.driver_range import DriverRange
from graphkin.solver.pose import Array
from graphkin.structure.transmission import sliding_pair
from graphkin.words import Phrase, Wording

__all__ = ["Extremes", "extremes"]

Course = Callable[[Array], tuple[Array, Array, Array]]

SAMPLES = 720
EQUAL = 1e-9  # of two extremes that differ by less, the one at the smaller angle of the crank is meant
STEPS = 6
NEAR = 1e-14
"""Within this (rad) of what Newton's method gives a rate's sign is looked for digit by digit."""
ROUNDED = 1e-11
"""An angle (rad) between limit positions that is nothing but rounding."""
WHERE_ELSE = Phrase("ask for s_ theta_ or d_ at single")


@dataclass(frozen=True)
class Extremes:
    """The least and the greatest value of an output over a turn (m, rad), and the driver's offsets there."""

    low: float
    high: float
    low_offset: float
    high_offset: float

    @property
    def stroke(self) -> float:
        return self.high - self.low

    @property
    def lag(self) -> float:
        """The angle theta between the crank's two limit positions (rad), what the longer way lacks to half a turn."""
        way = abs(self.high_offset - self.low_offset)
        lag = max(way, math.tau - way) - math.pi
        return lag if lag > ROUNDED else 0.0

    @property
    def ratio(self) -> float:
        """K = (180 + theta) / (180 - theta): the longer way of the crank over the shorter (coefficient of travel speed
        variation, 行程速比系数; time ratio, Norton, Design of Machinery, ch. 3)."""
        return (math.pi + self.lag) / (math.pi - self.lag)


def extremes(reach: DriverRange, symbol: Symbol) -> Extremes:
    """The extremes of the sliding pair or link that a symbol is of, over one turn of the driver.

    Raises
    ------
    Unsolvable : the driver slides or does not turn fully, the motion does not repeat after one turn, or the output has
        no limit positions
    CallError : there is no such sliding pair
    """
    if not reach.driver.turns:
        raise _without(symbol, Phrase("belongs to a whole turn but the driver"), WHERE_ELSE)
    if reach.turns != 1:
        why = reach.limit_why or Phrase("the motion does not repeat after one turn")
        raise _without(symbol, Phrase("belongs to a whole turn which the driver", why=why), WHERE_ELSE)
    if symbol.other:
        sliding_pair(reach.structure, symbol)
    cam = next((c for c in reach.scene.cams if symbol.pair in (c.follower, getattr(c.motion, "pair", ""))), None)
    if cam is not None and (reach.driver.link, reach.driver.relative_to) == (cam.link, reach.scene.frame.name):
        return _of_follower(reach, cam)

    def course(offset: Array) -> tuple[Array, Array, Array]:
        """Value, rate and second rate by the driver's own angle."""
        motion = reach.motion(offset, unit=True)
        if symbol.other:
            slide = motion.slide(symbol.pair)
            return slide.travel, slide.velocity, slide.acceleration
        return reach.angle(motion, symbol.link), motion.omega(symbol.link), motion.alpha(symbol.link)

    grid = np.linspace(0.0, math.tau, SAMPLES + 1)
    values, rates, _ = course(grid)
    pair = symbol.pair
    if not symbol.other and abs(values[-1] - values[0]) > 1.0:
        raise _without(symbol, Phrase("link turns on and on it has no", output=pair), Phrase("ask for one that swings"))
    size = reach.scene.size if symbol.other else 1.0
    if np.ptp(values) < 1e-12 * size:
        raise _without(
            symbol, Phrase("does not move it has no limit positions", name=pair), Phrase("ask for an output that moves")
        )
    (low_at, low), (high_at, high) = (
        _best(course, grid, values, rates, sign, lambda offset: float(reach.value(np.array(offset))))
        for sign in (-1.0, 1.0)
    )
    return Extremes(low, high, low_at, high_at)


def _of_follower(reach: DriverRange, cam: LawCam) -> Extremes:
    """The extremes of a follower by its law; where it stands still, the end of the dwell."""
    law, motion = cam.law, cam.motion
    if law.least == law.greatest:
        raise _without(
            Symbol("stroke"),
            Phrase("does not move of follower", follower=cam.follower),
            Phrase("ask for an output that moves"),
        )
    ends = []
    for lift in (law.least, law.greatest):
        offset = reach.sense * (cam.leaves(lift, int(reach.sense)) - float(reach.start[0])) % math.tau
        if isinstance(motion, SlidingFollower):
            ends.append((motion.travel + beginning(cam) + lift, offset))
        else:
            ends.append((motion.side * lift, offset))
    low, high = sorted(ends)
    return Extremes(low[0], high[0], low[1], high[1])


def _turning_point(course: Course, sign: float, places: Array, rates: Array) -> float:
    """Where between two places, with the rates there, a rate of this sign changes it: by Newton's method, beside its
    answer to the last digit."""
    low, high = places.tolist()

    def before(offset: Array) -> Array:
        return np.asarray(sign * course(offset)[1] >= 0.0)

    at = low + (high - low) * float(rates[0] / (rates[0] - rates[1]))
    for _ in range(STEPS):
        _, rate, slope = (float(found[0]) for found in course(np.array([at])))
        if not slope or not low <= (last := at) - rate / slope <= high:
            return last_true(before, low, high)
        at = last - rate / slope
        if abs(at - last) < 1e-7:
            break
    found = last_true(before, at - NEAR, at + NEAR)
    return found if abs(found - at) < 0.9 * NEAR else last_true(before, low, high)


def _without(symbol: Symbol, found: Wording, wanted: Wording) -> Unsolvable:
    return Unsolvable("no whole turn", Problem(str(symbol), found, wanted))


def _best(
    course: Course, grid: Array, values: Array, rates: Array, sign: float, angle: Callable[[float], float]
) -> tuple[float, float]:
    """Where the greatest (or for sign -1 the least) value stands, and how much it is: the rate changes its sign there.
    ``angle`` is the crank's at an offset."""
    n = len(grid) - 1
    tops = [k for k in range(n) if sign * rates[k] >= 0.0 > sign * rates[k + 1]]
    best = max((sign * values[k] for k in tops), default=0.0)
    found = []
    for k in tops:
        if max(sign * values[k], sign * values[k + 1]) < best - 0.05 * float(np.ptp(values)):
            continue
        c = _turning_point(course, sign, grid[k : k + 2], rates[k : k + 2])
        found.append((c, float(course(np.array([c]))[0][0])))
    most = max(sign * value for _, value in found)
    equal = [one for one in found if sign * one[1] > most - EQUAL * float(np.ptp(values))]
    return min(equal, key=lambda one: (angle(one[0]) + EQUAL) % math.tau)
