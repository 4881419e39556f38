"""In which ranges of the driver a mechanism can be assembled, and which of them the motion reaches."""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from graphkin.frozen import dataclass
from graphkin.scene.model import AngleDriver
from graphkin.solver import DriverRange
from graphkin.solver.engine import positions
from graphkin.solver.joints import Drive
from graphkin.solver.path import FAR
from graphkin.structure import Cluster, Dyad
from graphkin.structure.assembly import last_true

__all__ = ["AssemblyRange", "not_searched", "ranges"]

Array = NDArray[np.float64]

GRID = 1440
MOST_GROUPS = 7


@dataclass(frozen=True)
class AssemblyRange:
    """Values of the first driver (SI) between which the mechanism assembles.

    ``reached`` says whether the motion of the scene's own assembly runs there; ``whole`` that it is a full turn;
    ``open_low``, ``open_high`` that the motion does not end there but was not followed further.
    """

    low: float
    high: float
    reached: bool
    whole: bool = False
    open_low: bool = False
    open_high: bool = False


def ranges(reach: DriverRange) -> tuple[AssemblyRange, ...]:
    """The range that the motion reaches, then all others in which some assembly closes, as far as ``not_searched`` does
    not say otherwise: within a turn of the driver; of a driven slide within four sizes of the mechanism and twice as
    far as its motion reaches."""
    if reach.full:
        return (AssemblyRange(0.0, 2 * np.pi * reach.turns, True, whole=True),)
    low, high = sorted(float(reach.value(np.array(end))) for end in reach.ends)
    below, above = reach.limited if reach.sense > 0 else reach.limited[::-1]
    own = AssemblyRange(low, high, True, open_low=not below, open_high=not above)
    dyads = [i for i, e in enumerate(reach.structure.elements) if isinstance(e, Dyad)]
    if not dyads or not_searched(reach):
        return (own,)
    return own, *_elsewhere(reach, dyads, own)


def not_searched(reach: DriverRange) -> tuple[str, ...]:
    """Links for whose sake ranges in which the mechanism assembles otherwise are not known: of larger groups, whose
    assemblies are known only along their motion, or of too many groups to try all their assemblies."""
    if reach.full:
        return ()
    larger = [e.links for e in reach.structure.elements if isinstance(e, Cluster)]
    dyads = [e.links for e in reach.structure.elements if isinstance(e, Dyad)]
    many = dyads[MOST_GROUPS:] if not larger else []
    return tuple(name for links in (*larger, *many) for name in links)


def _elsewhere(reach: DriverRange, dyads: list[int], own: AssemblyRange) -> list[AssemblyRange]:
    def closes(value: Array) -> NDArray[np.bool_]:
        values = np.repeat(reach.start[None], len(value), axis=0)
        values[:, 0] = value
        drive = Drive.at(reach.structure, values)
        some = np.zeros(len(value), dtype=bool)
        # the last group's own form decides nothing about whether it closes
        for signs in product((1.0, -1.0), repeat=max(len(dyads) - 1, 0)):
            forms = {i: np.asarray(sign) for i, sign in zip(dyads, (*signs, 1.0), strict=True)}
            state = positions(reach.structure, drive, forms, rates=False)
            gaps = [np.broadcast_to(_closed(reach, i, state.groups[i]), value.shape) for i in dyads]
            some |= np.logical_and.reduce(gaps)
        return some

    turning = isinstance(reach.driver, AngleDriver)
    if turning:
        grid = own.low + 1e-9 + np.linspace(0.0, 2 * np.pi, GRID + 1)
    else:
        wide = max(FAR * reach.scene.size, 2 * abs(own.low), 2 * abs(own.high))
        grid = np.linspace(-wide, wide, GRID + 1)
    holds = closes(grid)
    found: list[AssemblyRange] = []
    k = 0
    while k <= GRID:
        if not holds[k]:
            k += 1
            continue
        end = k
        while end < GRID and holds[end + 1]:
            end += 1
        low = float(grid[k]) if k == 0 else last_true(closes, float(grid[k]), float(grid[k - 1]))
        high = float(grid[end]) if end == GRID else last_true(closes, float(grid[end]), float(grid[end + 1]))
        apart = not (low < own.high and high > own.low + 2e-9)
        if apart and turning and k > 0 and end < GRID:
            found.append(_within(low, high))
        elif apart and not turning:
            found.append(AssemblyRange(low, high, False, open_low=k == 0, open_high=end == GRID))
        k = end + 1
    return found


def _closed(reach: DriverRange, i: int, solved: object) -> NDArray[np.bool_]:
    discriminant = np.asarray(solved.discriminant)  # type: ignore[attr-defined]
    element = reach.structure.elements[i]
    if isinstance(element, Dyad) and element.is_two_lines:
        return np.asarray(np.abs(discriminant) > 1e-12)
    return np.asarray(discriminant >= 0)


def _within(low: float, high: float) -> AssemblyRange:
    """The same range with its middle in (-pi, pi]."""
    shift = 2 * np.pi * np.ceil(((low + high) / 2 - np.pi - 1e-9) / (2 * np.pi))
    return AssemblyRange(float(low - shift), float(high - shift), False)
