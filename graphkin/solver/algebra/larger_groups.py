"""Groups larger than a dyad, and groups with a driver that joins no common pair: all their links together.

Newton's method finds the position to rounding from the constraints of the group (``Constraints``), the same matrix
gives velocity and acceleration (Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, ch. 3).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphkin.solver.algebra.constraints import Constraints, solve_all
from graphkin.solver.algebra.pose import UNIT, Array, Drive, Pose
from graphkin.structure import LargerGroup, Structure

ROUNDS = 40
ROUNDINGS = 32 * UNIT
TOLD = 8 * UNIT
"""Relative error of what was given of rolling: radii, and where it starts."""
ROUGH = 1e-13
"""While more than this of a constraint is open, a step may make it more for once."""


@dataclass(frozen=True, eq=False, repr=False)
class GroupSolved:
    """The solution of a larger group.

    poses : its links
    place : the poses as an array (n, members, 3) of x, y (m) and angle (rad, not reduced); with rolling with more rows,
        see ``mode_of``
    residual : the largest of the constraints, no unit; infinite where it is unknown
    matrix : derivative of the constraints by the scaled unknowns, shape (n, rows, columns)
    right_side : rate of the constraints with the group held still, shape (n, rows)
    """

    system: Constraints
    poses: Mapping[str, Pose]
    place: Array
    residual: Array
    matrix: Array
    right_side: Array

    @cached_property
    def determinant(self) -> Array:
        """The determinant of the scaled constraints; its sign tells the branch."""
        return np.asarray(np.linalg.det(self.matrix))

    @cached_property
    def condition(self) -> Array:
        """The condition of the scaled constraints, one over the least singular value: the growth of an error."""
        known = np.asarray(np.isfinite(self.matrix).all(axis=(1, 2)))
        with np.errstate(all="ignore"):
            finite = np.asarray(np.where(known[:, None, None], self.matrix, 0.0), dtype=float)
            least = np.linalg.svd(finite, compute_uv=False)[:, -1]
            return np.where(known, 1 / np.maximum(least, 1e-300), np.inf)

    def same_assembly(self, place: Array) -> bool:
        """Whether a place nearby (rows, 3) certainly belongs to the same assembly, whatever the rates there: by the
        bound on its matrix, which stays regular around it (of the first position)."""
        shift = (self.place[0] - place)[: len(self.system.group.members)]
        moved = float(np.linalg.norm(shift / np.array([self.system.structure.scene.size] * 2 + [1.0])))
        return bool(self.condition[0] * self._bending[0] * moved < 0.5)

    @cached_property
    def _bending(self) -> Array:
        """The greatest change of the matrix with the scaled unknowns, both as roots of squares."""
        size = self.system.structure.scene.size
        poses = [*self.poses.values(), *self.system.known.values()]
        reach = 1 + np.max(np.broadcast_arrays(*(np.abs(p.z) / size for p in poses)), axis=0)
        return np.asarray(4 * reach * self.matrix.shape[1] ** 0.5)

    @cached_property
    def rolling_residuals(self) -> Array:
        """Errors of the rolling relations: their residuals, and the rounding of turns; shape (n, relations)."""
        system, layout = self.system, self.system.layout
        if not len(layout.rolling_rows):
            return np.zeros((len(self.residual), 0))
        assert system.kept is not None
        angles = np.concatenate((self.place[:, : layout.members, 2], self.place[:, layout.relations_end :, 2]), axis=1)
        turned = np.abs(angles).max(axis=1, initial=1.0)[:, None] * np.abs(layout.rolled).sum(axis=1)
        return np.asarray(self.residual[:, None] + TOLD * (np.abs(system.kept) + turned))

    @property
    def slope(self) -> Array:
        """Rates of the rows of ``place``, shape (rows, 3), at the first position."""
        system, layout = self.system, self.system.layout
        moved = {**system.known, **self.poses}
        places = [(moved[k].v.real[0], moved[k].v.imag[0], moved[k].omega[0]) for k in system.group.members]
        outside = [(0.0, 0.0, moved[layout.names[k]].omega[0]) for k in layout.outside]
        return np.array([*places, *[(0.0, 0.0, 0.0)] * len(layout.rolling_rows), *outside])

    @cached_property
    def certificate(self) -> Array:
        """Kantorovich's number: |J^-1| |step| times the rate of change of the matrix J, with step <= |J^-1| |residual|.

        Below 1/2 there is a single position within twice the step, and Newton's method has converged to it
        quadratically (Ortega and Rheinboldt, Iterative Solution of Nonlinear Equations in Several Variables, 12.6).
        """
        with np.errstate(all="ignore"):
            step = self.condition * np.maximum(self.residual, ROUNDINGS) * self.matrix.shape[1] ** 0.5
            return np.asarray(self.condition * step * self._bending)


def solve_group(
    structure: Structure,
    group: LargerGroup,
    known: Mapping[str, Pose],
    drive: Drive,
    start: Array,
    rates: bool = True,
) -> GroupSolved:
    """Solve a group by Newton's method from given places, shape (n, members, 3); with rolling with more rows, see
    ``mode_of``."""
    n = len(drive)
    system, start = Constraints(structure, group, known, drive), np.asarray(start)
    start = np.broadcast_to(start, (n, *start.shape[-2:]))
    system = _rolling_from(system, start)
    place = np.array(start[:, : len(group.members)], dtype=float)
    residual = np.full(n, np.inf)
    left, part, now_at = np.arange(n), system, place.copy()
    for _ in range(ROUNDS):
        all_ = part.at(now_at)
        residuals = part.residuals(all_)
        now, last = np.abs(residuals).max(axis=1), residual[left]
        better = now < last
        place[left[better]] = now_at[better]
        residual[left] = np.fmin(last, now)
        gains = better & ((now > ROUGH) | (now < 0.5 * last))
        if not gains.any():
            break
        step = part.scaled(solve_all(part.matrix(all_), residuals))
        # a position that gains nothing any more is left as it is, whatever others still do
        on = gains | (residual[left] > ROUGH)
        now_at = now_at - step if on.all() else now_at[on] - step[on]
        if not on.all():
            left, part = left[on], system.part(left[on])
    matrix = system.matrix(system.at(place))
    residual[~np.isfinite(matrix).all(axis=(1, 2))] = np.inf
    rate: Array | None = None
    second: Array | None = None
    if rates:
        # the guiding, centripetal and Coriolis terms are the rates of the constraints with the unknown rates left out
        right_side = system.constraints(system.at(place, np.zeros_like(place)), 1)[1]
        rate = system.scaled(solve_all(matrix, -right_side))
        bent = system.constraints(system.at(place, rate))[2]
        second = system.scaled(solve_all(matrix, -bent))
    else:
        right_side = np.zeros((n, matrix.shape[1]))
    mode = _with_turns(system, place)
    return GroupSolved(system, system.poses(place, rate, second), mode, residual, matrix, right_side)


def _rolling_from(system: Constraints, start: Array) -> Constraints:
    """The constraints with the turns and the sums of starting places, see ``mode_of``."""
    layout = system.layout
    if not len(layout.rolling_rows):
        return system
    near = np.zeros((len(start), len(layout.names)))
    near[:, : layout.members] = start[:, : layout.members, 2]
    near[:, layout.outside] = start[:, layout.relations_end :, 2]
    return replace(system, near=near, kept=start[:, layout.members : layout.relations_end, 0])


def _with_turns(system: Constraints, place: Array) -> Array:
    """Places of the group with the sums that rolling keeps, and the turns of the links outside, see ``mode_of``."""
    layout = system.layout
    if not len(layout.rolling_rows):
        return place
    assert system.kept is not None
    more = np.zeros((len(place), len(layout.rolling_rows) + len(layout.outside), 3))
    more[:, : len(layout.rolling_rows), 0] = system.kept
    more[:, len(layout.rolling_rows) :, 2] = system.angles(system.at(place).u)[:, layout.outside]
    return np.concatenate((place, more), axis=1)


def mode_of(structure: Structure, group: LargerGroup, poses: Mapping[str, Pose]) -> Array:
    """The start of Newton's method from the scene's own position, shape (rows, 3): the places of the links; with
    rolling also a row for each sum that it keeps, and a row for each link outside the group that rolls with it, for its
    turns."""
    drive = Drive(*(np.zeros((1, len(structure.drivers))),) * 3)
    system = Constraints(structure, group, poses, drive)
    place = as_place(poses, group.members)[:1]
    if not group.rolling:
        return np.asarray(place[0])
    all_ = system.at(place)
    system = replace(system, near=np.angle(all_.u), kept=np.zeros((1, len(group.rolling))))
    kept = system.constraints(all_, 0)[0][:, system.layout.rolling_rows]
    return np.asarray(_with_turns(replace(system, kept=kept), place)[0])


def as_place(poses: Mapping[str, Pose], names: tuple[str, ...]) -> Array:
    """Poses as an array of shape (n, members, 3)."""
    return np.stack(
        [np.stack([poses[k].z.real, poses[k].z.imag, np.angle(poses[k].u)], axis=-1) for k in names], axis=1
    )
