"""Groups larger than a dyad, and groups with a driver that joins no common pair: all their links together.

Newton's method finds the position to rounding, the same matrix gives velocity and acceleration (Haug, Computer Aided
Kinematics and Dynamics of Mechanical Systems, ch. 3).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from graphkin.solver.group_equations import System
from graphkin.solver.group_errors import certificate
from graphkin.solver.joints import Drive
from graphkin.solver.pose import Array, Pose
from graphkin.structure import Cluster, Structure

__all__ = ["ClusterSolved", "as_place", "solve_all", "solve_cluster"]

ROUNDS = 40


class ClusterSolved(NamedTuple):
    """What a larger group gives.

    poses : its links
    place : the same as an array (n, members, 3) of x, y (m) and angle (rad, not reduced)
    missed : largest constraint still open, no unit
    determinant : of the scaled constraints, its sign tells the branch
    condition : of the scaled constraints, one over the least singular value: how much an error grows
    matrix : derivative of the constraints by the scaled unknowns, shape (n, rows, columns)
    load : rate of the constraints with the group held still, shape (n, rows)
    certificate : less than 1/2 where Newton's method has converged quadratically to a position
    """

    poses: Mapping[str, Pose]
    place: Array
    missed: Array
    determinant: Array
    condition: Array
    matrix: Array
    load: Array
    certificate: Array


def solve_cluster(
    structure: Structure,
    group: Cluster,
    known: Mapping[str, Pose],
    drive: Drive,
    start: Array,
    rates: bool = True,
) -> ClusterSolved:
    """Solve a group by Newton's method from given places, shape (n, members, 3)."""
    n = len(drive)
    system = System(structure, group, known, drive)
    place = np.array(np.broadcast_to(start, (n, len(group.members), 3)), dtype=float)
    missed = np.full(n, np.inf)
    best = place
    for _ in range(ROUNDS):
        members = system.poses(place)
        open_, _, _ = system.constraints(members)
        now = np.abs(open_).max(axis=1)
        better = now < missed
        best = np.where(better[:, None, None], place, best)
        if not np.any(better & (now > 1e-13)) and not np.any(better & (now < 0.5 * missed)):
            missed = np.minimum(missed, now)
            break
        missed = np.fmin(missed, now)
        place = place - system.scaled(solve_all(system.matrix(members), open_))
    place = best
    members = system.poses(place)
    matrix = system.matrix(members)
    if rates:
        # the guiding, centripetal and Coriolis terms are the rates of the constraints with the unknown rates left out
        _, load, _ = system.constraints(members)
        rate = system.scaled(solve_all(matrix, -load))
        _, _, bent = system.constraints(system.poses(place, rate))
        second = system.scaled(solve_all(matrix, -bent))
        members = system.poses(place, rate, second)
    else:
        load = np.zeros((n, matrix.shape[1]))
    whole: Array = np.asarray(np.isfinite(matrix).all(axis=(1, 2)))
    values = np.linalg.svd(np.asarray(np.where(whole[:, None, None], matrix, 0.0), dtype=float), compute_uv=False)
    condition = np.where(whole, 1 / np.maximum(values[:, -1], 1e-300), np.inf)
    missed = np.where(whole, missed, np.inf)
    certain = certificate(system, members, condition, missed)
    return ClusterSolved(members, place, missed, np.linalg.det(matrix), condition, matrix, load, certain)


def solve_all(matrix: Array, right: Array) -> Array:
    """Solve a stack of linear systems; a singular one gives NaN instead of an error for all."""
    try:
        return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0])
    except np.linalg.LinAlgError:
        given = np.full_like(right, np.nan)
        for i in range(len(right)):
            try:
                given[i] = np.linalg.solve(matrix[i], right[i])
            except np.linalg.LinAlgError:
                continue
        return given


def as_place(poses: Mapping[str, Pose], names: tuple[str, ...]) -> Array:
    """Poses as an array of shape (n, members, 3)."""
    return np.stack(
        [np.stack([poses[k].z.real, poses[k].z.imag, np.angle(poses[k].u)], axis=-1) for k in names], axis=1
    )
