"""The motion at given values of the drivers, in one pass over all of them: what stands there, and where and why nothing
does.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.scene.model import Mechanism
from graphkin.solver.assemblies import own_values
from graphkin.solver.engine import positions
from graphkin.solver.error_bound import ErrorBound
from graphkin.solver.findings import singular, without_singular
from graphkin.solver.joints import Drive
from graphkin.solver.motion import Motion
from graphkin.solver.pose import Array, Pose, rest
from graphkin.solver.redundant import all_slides, place_redundant
from graphkin.structure import Structure

__all__ = ["BLOCK", "goal_values", "motion_of"]

BLOCK = 16384
"""Positions that are computed together."""


def goal_values(scene: Mechanism, at: Mapping[str, float] | None) -> Array:
    """The scene's driver values, but for those given by driver key, shape (drivers,).

    Raises
    ------
    CallError : a key that is no driver, a value that is no number
    """
    goal = own_values(scene)
    keys = [d.key for d in scene.drivers]
    for key, value in (at or {}).items():
        if key not in keys:
            raise CallError(Problem(f'at "{key}"', "there is no such driver", did_you_mean(key, keys)))
        if not np.isfinite(value):
            raise CallError(Problem(f'at "{key}"', f"{value} is no driver value"))
        goal[keys.index(key)] = value
    return goal


def motion_of(
    structure: Structure,
    drive: Drive,
    forms: Mapping[int, Array],
    assembly: tuple[str, ...],
    good: Array,
    why: str = "",
    fine: bool = True,
) -> Motion:
    """Positions in one pass over all driver values, their status, redundant links placed and checked.

    Parameters
    ----------
    forms : the form of each group at each position, as for ``positions``
    assembly : in words
    good, why : which positions the motion reaches, shape (n,), and why it does not reach the others
    fine : False leaves 16 digits where they are rough, and the reasons away
    """
    n = len(drive)
    if n > BLOCK:
        return _in_blocks(structure, drive, forms, assembly, good, why, fine)
    state = positions(structure, drive, forms, fine=fine)
    status = np.where(good, "ok", "not assembled").astype("<U13")
    reasons = ["" if g else why for g in good]
    if fine:
        status, reasons = without_singular(structure, state, drive.value, forms, status, reasons)
    else:
        for _, dead in singular(structure, state, n):
            status[dead & good] = "dead point"
    ok = status == "ok"
    assert state.bounds is not None
    bound = ErrorBound(*(np.where(ok, b, np.nan) for b in state.bounds))
    rough = (np.where(ok, state.rough[0], np.nan), np.where(ok, state.rough[1], np.nan))
    poses = {name: pose.spread(n).where(ok) for name, pose in state.poses.items()}
    poses[structure.scene.frame.name] = rest().still(n)
    place_redundant(structure, poses, ok, bound)
    slides = all_slides(structure)
    return Motion(structure, drive.value, status, tuple(reasons), poses, slides, assembly, bound, rough)


def _in_blocks(
    structure: Structure,
    drive: Drive,
    forms: Mapping[int, Array],
    assembly: tuple[str, ...],
    good: Array,
    why: str,
    fine: bool,
) -> Motion:
    """``motion_of`` a block of positions at a time, so that no more is in memory than what is found."""
    n = len(drive)
    status, reasons = np.empty(n, dtype="<U13"), [""] * n
    poses: dict[str, Pose] = {}
    numbers = np.empty((8, n))
    for first in range(0, n, BLOCK):
        rows = slice(first, min(first + BLOCK, n))
        own = {i: f[rows] if np.ndim(f) and len(f) == n else f for i, f in forms.items()}
        some = motion_of(structure, drive[rows], own, assembly, good[rows], why, fine)
        status[rows], reasons[rows] = some.status, some.why
        numbers[:, rows] = [*some.bound, *some.rough]
        poses = poses or {name: rest().spread(n) for name in some.poses}
        for name, pose in some.poses.items():
            poses[name].put(rows, pose)
    poses[structure.scene.frame.name] = rest().still(n)
    bound, rough = ErrorBound(*numbers[:6]), (numbers[6], numbers[7])
    return Motion(structure, drive.value, status, tuple(reasons), poses, some.slides, assembly, bound, rough)
