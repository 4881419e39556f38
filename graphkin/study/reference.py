"""The 50-digit reference: closure equations solved by Newton's method in mpmath, from a solution in doubles.

The numbers of the scene are taken as they are in memory, doubles in SI, and as exact.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from graphkin.errors import CallError, Problem
from graphkin.solver.pose import Array
from graphkin.structure import Structure
from graphkin.study.equations import Arithmetic, Equations, Solution
from graphkin.words import Phrase

if TYPE_CHECKING:
    from mpmath import MPContext, mpf

    Digits = Sequence[float | mpf]

__all__ = ["DIGITS", "Split", "context", "reference", "refined", "split"]

DIGITS = 50
STEPS = 60
CLOSED = 1e-38



def context() -> MPContext:
    """An mpmath context of 50 digits.

    Raises
    ------
    CallError : mpmath is not installed
    """
    try:
        from mpmath import MPContext
    except ImportError:
        raise CallError(
            Problem("study", Phrase("the 50-digit reference needs mpmath"), "pip install 'graphkin[study]'")
        ) from None
    mp = MPContext()
    mp.dps = DIGITS
    return mp


def reference(structure: Structure, mp: MPContext) -> Equations:
    """The closure equations of a structure in numbers of an mpmath context."""
    turn = 2 * mp.pi
    return Equations(
        structure,
        Arithmetic(
            cos=np.frompyfunc(mp.cos, 1, 1),
            sin=np.frompyfunc(mp.sin, 1, 1),
            arg=lambda z: mp.arg(mp.mpc(z)),
            unturned=lambda d: d - turn * mp.nint(d / turn),
            solve=_eliminated,
        ),
    )


def refined(
    equations: Equations, mp: MPContext, x: Digits, values: Digits, first: Digits, second: Digits
) -> Solution:
    """Position and rates to 50 digits from a start near by.

    Raises
    ------
    ArithmeticError : Newton's method does not close the equations from there
    """
    at = np.array([mp.mpf(v) for v in x], dtype=object)
    for _ in range(STEPS):
        new = equations.improved(at, values)
        moved = max(abs(v) for v in new - at)
        at = new
        if moved < CLOSED:
            return equations.rates(at, values, first, second)
    raise ArithmeticError(Phrase("the reference does not converge"))


def _eliminated(matrix: Array, right: Array) -> Array:
    """Gaussian elimination with row pivots, for numbers that numpy does not know."""
    m = len(right)
    rows = np.concatenate([matrix, right[:, None]], axis=1)
    for k in range(m):
        p = max(range(k, m), key=lambda i: abs(rows[i, k]))
        if p != k:
            rows[[k, p]] = rows[[p, k]]
        for i in range(k + 1, m):
            if rows[i, k] != 0:
                rows[i, k:] = rows[i, k:] - rows[k, k:] * (rows[i, k] / rows[k, k])
    found = np.empty(m, dtype=object)
    for k in range(m - 1, -1, -1):
        rest = rows[k, m]
        for j in range(k + 1, m):
            if rows[k, j] != 0:
                rest = rest - rows[k, j] * found[j]
        found[k] = rest / rows[k, k]
    return found


class Split:
    """Numbers of 50 digits as sums of two doubles, so that the error of doubles can be told to 1e-32."""

    def __init__(self, high: Array, low: Array) -> None:
        self.high, self.low = high, low

    def off(self, values: Array) -> Array:
        """How far values lie off."""
        return np.asarray(np.abs((values - self.high) - self.low))

    def __getitem__(self, which: tuple[Array, ...]) -> Split:
        return Split(self.high[which], self.low[which])


def split(numbers: Array, mp: MPContext) -> Split:
    """Real or complex mpmath numbers, any shape, in two parts."""
    given = np.asarray(numbers, dtype=object)
    high = np.array([complex(z) for z in given.ravel()]).reshape(given.shape)
    low = np.array(
        [complex(mp.mpc(z) - mp.mpc(complex(z))) for z in given.ravel()]
    ).reshape(given.shape)
    return Split(high, low)
