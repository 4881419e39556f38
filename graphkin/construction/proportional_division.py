"""Proportional division: what must be tried so that nothing is left open, from trials and what each of them left open.

What is left open changes evenly with what is tried.  With one thing tried two trials are divided, with several one more
than there are of them, each of which differs from the first in one (Hain, Applied Kinematics).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def shares(gaps: Sequence[ArrayLike]) -> Array:
    """How much of each step from the first trial to another one together leaves nothing open, or, where more is left
    open than is tried, as little as may be.

    gaps : what each trial leaves open, shape (tried + 1, open)
    """
    slopes, wanted = _slopes(gaps), -np.array(gaps[0])
    if slopes.shape[0] == slopes.shape[1]:
        return np.asarray(np.linalg.solve(slopes, wanted))
    return np.asarray(np.linalg.lstsq(slopes, wanted, rcond=None)[0])


def divide(trials: Sequence[ArrayLike], gaps: Sequence[ArrayLike]) -> Array:
    """The values at which nothing is left open.

    trials : the values of each trial, shape (tried + 1, tried)
    gaps : what each leaves open, shape (tried + 1, open)
    """
    first = found = np.array(trials[0])
    for share, trial in zip(shares(gaps), trials[1:], strict=True):
        found = found + share * (np.array(trial) - first)
    return np.asarray(found)


def magnified(places: Sequence[Sequence[complex]], gaps: Sequence[ArrayLike]) -> float:
    """How far a place moves, at most, for what a trial leaves open; each trial has as many places."""
    moved = [[there - here for there in others] for here, *others in zip(*places, strict=True)]
    return float(np.abs(np.array(moved) @ np.linalg.inv(_slopes(gaps))).max(initial=0.0))


def _slopes(gaps: Sequence[ArrayLike]) -> Array:
    """How what is left open changes from the first trial to each other one, shape (open, tried)."""
    first = np.array(gaps[0])
    return np.array([np.array(row) - first for row in gaps[1:]]).T
