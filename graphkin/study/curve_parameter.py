"""What the curves of a turn run over: the driver's offset, or an angle in which positions are smooth up to the ends."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from graphkin.frozen import dataclass
from graphkin.solver import DriverRange
from graphkin.solver.pose import Array
from graphkin.study.curves import Pieces
from graphkin.study.quantities import Quantity

__all__ = ["Curve", "CurveParameter"]

NEAR_END = 1e-5
"""Of the range: an extreme this near to an end of the motion is the end itself."""
STEPS_TO_END = 2e-2
"""Of the angle that runs over the range: steps to an end that the solver does not come near enough to."""
HAIR = 1e-6
"""Of the range of the driver: what is left out before an end at which links go away without bound."""


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
