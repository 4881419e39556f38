"""Proportional division: the values that close all gaps, from trials and their gaps.

Gaps change linearly with the trial values.  With one value two trials are divided, with several one trial more than
values, each of which differs from the first in one value (Hain, Applied Kinematics).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def shares(gaps: Sequence[ArrayLike]) -> Array:
    """The parts of the steps from the first trial to the others that together close all gaps, or, with more gaps than
    values, leave the least gaps.

    gaps : of each trial, shape (tried + 1, open)
    """
    slopes, wanted = _slopes(gaps), -np.array(gaps[0])
    if slopes.shape[0] == slopes.shape[1]:
        return np.asarray(np.linalg.solve(slopes, wanted))
    return np.asarray(np.linalg.lstsq(slopes, wanted, rcond=None)[0])


def divide(trials: Sequence[ArrayLike], gaps: Sequence[ArrayLike]) -> Array:
    """The values that close all gaps.

    trials : the values of each trial, shape (tried + 1, tried)
    gaps : of each, shape (tried + 1, open)
    """
    first = values = np.array(trials[0])
    for share, trial in zip(shares(gaps), trials[1:], strict=True):
        values = values + share * (np.array(trial) - first)
    return np.asarray(values)


def magnified(places: Sequence[Sequence[complex]], gaps: Sequence[ArrayLike]) -> float:
    """The greatest displacement of a place per unit of a trial's gap; each trial has as many places."""
    moved = [[there - here for there in others] for here, *others in zip(*places, strict=True)]
    return float(np.abs(np.array(moved) @ np.linalg.inv(_slopes(gaps))).max(initial=0.0))


def _slopes(gaps: Sequence[ArrayLike]) -> Array:
    """The changes of the gaps from the first trial to each other one, shape (open, tried)."""
    first = np.array(gaps[0])
    return np.array([np.array(row) - first for row in gaps[1:]]).T
