"""Positions that 16 digits leave too rough, near dead points, computed again in 50."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal

import numpy as np

from graphkin.scene.model import AngleDriver, AnyDriver
from graphkin.solver.code import Code
from graphkin.solver.decimals import cos_sin, meant, meant_angle, working
from graphkin.solver.expressions import Name, Real, Vec
from graphkin.solver.pose import FIELDS, Array
from graphkin.solver.program import GIVEN, DimensionedProgram
from graphkin.solver.rounding import UNIT

__all__ = ["ExtendedPrecision", "known_exactly"]

ROUGH = 1e-10
"""Relative bound of a rate above which a position is computed in more digits."""
FEW = 8
"""Roundings in a result that is itself exact but for the last place."""


def known_exactly(drivers: Sequence[AnyDriver], values: Array) -> Array:
    """Positions whose driver values, shape (n, drivers), are known to fifty digits, shape (n,)."""
    found = np.zeros(len(values), dtype=bool)
    for j, driver in enumerate(drivers):
        if driver.dead_point and driver.dead_point.exact:
            found |= values[:, j] == driver.values[0]
    return found


@dataclass(frozen=True)
class ExtendedPrecision:
    """What it takes to compute a position again.

    value, rate, second : of the drivers, shape (n, drivers), (drivers,), (drivers,)
    signs : the other inputs of the formulas, by name, shape (n,)
    """

    dimensioned: DimensionedProgram
    code: Code
    drivers: Sequence[AnyDriver]
    value: Array
    rate: Array
    second: Array
    signs: Mapping[Name, Array]

    def place(self, asked: Sequence[Real | Vec], columns: Sequence[Array]) -> None:
        """Compute these positions in 50 digits, in ``columns`` of ``asked``."""
        with working():
            for k in np.flatnonzero(known_exactly(self.drivers, self.value)).tolist():
                self._put(k, asked, columns)

    def _put(self, k: int, asked: Sequence[Real | Vec], columns: Sequence[Array]) -> bool:
        try:
            row = [float(x) for x in self.row(k)]
        except ArithmeticError:
            return False
        for x, column in zip(asked, columns, strict=True):
            column[k] = complex(row.pop(0), row.pop(0)) if isinstance(x, Vec) else row.pop(0)
        return True

    def refine(self, asked: Sequence[Real | Vec], columns: Sequence[Array], links: int) -> None:
        """Replace the rough positions in ``columns``: those of ``asked``, which begin with the fields of so many links
        and end with their bounds."""
        speed, push = (self._largest(columns, links, k) for k in (1, 2))
        size = self.dimensioned.structure.scene.size
        velocity, acceleration = columns[-5] + size * columns[-2], columns[-4] + size * columns[-1]
        rough = ~(np.maximum(velocity / speed, acceleration / push) < ROUGH) | known_exactly(self.drivers, self.value)
        with working():
            for k in np.flatnonzero(rough).tolist():
                if not self._put(k, asked, columns):
                    continue
                one = [column[k : k + 1] for column in columns]
                spin, bend = (max(float(np.abs(one[6 * n + f][0])) for n in range(links)) for f in (3, 5))
                wide = [*(float(self._largest(one, links, f)[0]) for f in range(3)), 1.0, spin, bend]
                for column, w in zip(columns[-6:], wide, strict=True):
                    column[k] += FEW * UNIT * w

    def _largest(self, columns: Sequence[Array], links: int, order: int) -> Array:
        """Largest place, velocity or acceleration, for points as far off as the mechanism is large."""
        size = self.dimensioned.structure.scene.size
        most = np.full(len(columns[0]), 1e-300)
        for n in range(links):
            own = columns[len(FIELDS) * n : len(FIELDS) * (n + 1)]
            turning = (1.0, np.abs(own[3]), np.abs(own[5]) + own[3] ** 2)[order]
            most = np.fmax(most, np.abs(own[2 * order]) + turning * size)
        return most

    def row(self, k: int, at: Mapping[int, Decimal] | None = None) -> tuple[Decimal, ...]:
        """What the code computes at position ``k``, or with drivers at other values."""
        given: dict[Name, Decimal] = {name: Decimal(float(column[k])) for name, column in self.signs.items()}
        for j, driver in enumerate(self.drivers):
            value = float(self.value[k, j])
            turns = isinstance(driver, AngleDriver)
            number, exact = meant_angle(value) if turns else meant(value)
            dead = driver.dead_point
            if dead and dead.exact and value == driver.values[0]:
                number, exact = Decimal(dead.exact), True
            if at and j in at:
                number, exact = at[j], True
            if turns:
                given["cos", j], given["sin", j] = cos_sin(number)
            else:
                given["travel", j] = number
            given["error", "angle" if turns else "travel", j] = Decimal(0 if exact else GIVEN * abs(value))
            for name, rate in (("rate", float(self.rate[j])), ("second", float(self.second[j]))):
                given[name, j], exact = meant(rate)
                given["error", name, j] = Decimal(0 if exact else GIVEN * abs(rate))
        params = self.dimensioned.decimals(self.code.params, given)
        return self.code.decimals(params, [given[name] for name in self.code.inputs])
