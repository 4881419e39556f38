"""Zeros, extremes and intervals of a function of one variable: the one search of the house.

What is only true or false, or dear to compute, is looked for by sections, here; smooth curves by their polynomials
(``graphkin.search.curves``).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["changes", "intervals", "last_true", "least_value"]

Array = NDArray[Any]
SECTIONS = 64
LEAST_SECTIONS = 16
NARROW = 1e-11
"""A least value is flat: its place has no more digits."""


def last_true(
    holds: Callable[[Array], Array], low: float, high: float, sections: int = SECTIONS, within: float = 0.0
) -> float:
    """The place up to which a condition holds that is true at ``low`` and false at ``high``, in either order.

    Parameters
    ----------
    holds : function of places, shape (n,), to bool, shape (n,)
    sections : how many are looked at together; 2 where each place is dear
    within : how near is near enough; 0 for the last digit
    """
    while True:
        at = np.linspace(low, high, sections + 1)
        false = np.flatnonzero(~holds(at[1:-1]))
        i = int(false[0]) if len(false) else sections - 1
        if abs(high - low) <= max(within, 4e-16 * max(1.0, abs(high))) or (at[i], at[i + 1]) == (low, high):
            return float(low)
        low, high = float(at[i]), float(at[i + 1])


def changes(holds: Callable[[Array], Array], grid: Array, within: float = 0.0) -> list[float]:
    """Where a condition begins or ceases to hold along a grid that is fine enough to see every change, to the last
    digit (as near as ``within``): places where it still holds."""
    true = holds(grid)
    pairs = ((k, k + 1) if true[k] else (k + 1, k) for k in np.flatnonzero(true[1:] != true[:-1]))
    return [last_true(holds, float(grid[inside]), float(grid[outside]), within=within) for inside, outside in pairs]


def intervals(holds: Callable[[Array], Array], grid: Array) -> list[tuple[float, float]]:
    """Where a condition holds along a grid, as for ``changes``; at most from its first to its last place."""
    first, last = holds(grid[[0, -1]]).tolist()
    places = [*([float(grid[0])] if first else []), *changes(holds, grid), *([float(grid[-1])] if last else [])]
    return list(zip(places[::2], places[1::2], strict=True))


def least_value(
    function: Callable[[Array], Array], low: float, high: float, enough: float = -np.inf
) -> tuple[float, float]:
    """Place and value of the least value between two places, with one valley between them; less than ``enough`` is not
    looked into."""
    while True:
        at = np.linspace(low, high, LEAST_SECTIONS + 1)
        value = function(at)
        i = int(np.nanargmin(value))
        if value[i] < enough or high - low < NARROW:
            return float(at[i]), float(value[i])
        low, high = float(at[max(i - 1, 0)]), float(at[min(i + 1, LEAST_SECTIONS)])
