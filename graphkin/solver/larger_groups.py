"""Groups larger than a dyad, and groups with a driver that joins no common pair: all their links together.

Unknown are place and angle of each link; every pair and every driver inside gives its equations, with lengths counted
in the size of the mechanism, so that columns weigh alike.  Newton's method finds the position to rounding, the same
matrix gives velocity and acceleration (Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, ch. 3).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from graphkin.scene.model import AngleDriver
from graphkin.solver.joints import Drive, joint_place, turned
from graphkin.solver.pose import Array, Pose, rest
from graphkin.solver.rounding import UNIT
from graphkin.structure import Cluster, Driven, Dyad, Pair, Slide, Structure, Turn

__all__ = ["ClusterSolved", "System", "as_place", "solve_all", "solve_cluster"]

ROUNDS = 40
ROUNDINGS = 32 * UNIT


@dataclass(frozen=True)
class System:
    """The constraints of a group at n positions of what it hangs on."""

    structure: Structure
    group: Cluster
    known: Mapping[str, Pose]
    drive: Drive

    @classmethod
    def whole(cls, structure: Structure, drive: Drive) -> System:
        """The constraints of all links together."""
        pairs: list[Pair] = []
        for e in structure.elements:
            if isinstance(e, Driven):
                pairs.append(e.pair)
            elif isinstance(e, Dyad):
                pairs += [e.outer_first, e.inner, e.outer_second, *(w.pair for body in e.bodies for w in body.welds)]
            else:
                pairs += e.pairs
        frame = structure.scene.frame.name
        members = tuple(name for name in structure.links if name != frame)
        every = Cluster(members, tuple(pairs), structure.scene.drivers, members, 0)
        return cls(structure, every, {frame: rest()}, drive)

    def poses(self, place: Array, rate: Array | None = None, second: Array | None = None) -> dict[str, Pose]:
        """Members' poses from places, rates and second rates, each of shape (n, members, 3)."""
        zero = np.zeros_like(place)
        r, s = zero if rate is None else rate, zero if second is None else second
        made: dict[str, Pose] = {}
        for k, name in enumerate(self.group.members):
            angle = place[:, k, 2]
            made[name] = Pose(
                place[:, k, 0] + 1j * place[:, k, 1],
                np.cos(angle) + 1j * np.sin(angle),
                r[:, k, 0] + 1j * r[:, k, 1],
                r[:, k, 2],
                s[:, k, 0] + 1j * s[:, k, 1],
                s[:, k, 2],
            )
        return made

    def constraints(self, members: Mapping[str, Pose]) -> tuple[Array, Array, Array]:
        """Each constraint and its first and second rate, with lengths in the size, each of shape (n, rows)."""
        size, n = self.structure.scene.size, len(self.drive)
        poses = {**self.known, **members}
        rows: list[tuple[Array, Array, Array]] = []
        for pair in self.group.pairs:
            one, two = self._joints(pair, poses)
            if isinstance(pair, Turn):
                gap = ((one.z - two.z) / size, (one.v - two.v) / size, (one.a - two.a) / size)
                rows += [(gap[0].real, gap[1].real, gap[2].real), (gap[0].imag, gap[1].imag, gap[2].imag)]
                continue
            seen = two.inverse().of(one)
            rows.append((np.angle(seen.u), seen.omega, seen.alpha))
            rows.append((seen.z.imag / size, seen.v.imag / size, seen.a.imag / size))
        for driver in self.group.drivers:
            i = self.structure.scene.drivers.index(driver)
            value, rate, second = self.drive.value[:, i], self.drive.rate[:, i], self.drive.second[:, i]
            if isinstance(driver, AngleDriver):
                seen = poses[driver.relative_to].inverse().of(poses[driver.link])
                turn = seen.u * np.conj(turned(value))
                rows.append((np.angle(turn), seen.omega - rate, seen.alpha - second))
            else:
                one, two = self._joints(self.structure.slide(driver.key), poses)
                seen = two.inverse().of(one)
                rows.append(((seen.z.real - value) / size, (seen.v.real - rate) / size, (seen.a.real - second) / size))
        found = np.empty((3, n, len(rows)))
        for k, row in enumerate(rows):
            for order in range(3):
                found[order, :, k] = row[order]
        return found[0], found[1], found[2]

    def _joints(self, pair: Pair, poses: Mapping[str, Pose]) -> tuple[Pose, Pose]:
        """The two frames of a joint, in the world."""
        one, two = (poses[link].fixed(*joint_place(self.structure, pair, link)) for link in (pair.a, pair.b))
        return one, two

    def matrix(self, members: Mapping[str, Pose]) -> Array:
        """Derivative of the constraints by (x / size, y / size, angle) of each member, shape (n, rows, columns)."""
        size, n = self.structure.scene.size, len(self.drive)
        poses = {**self.known, **members}
        column = {name: 3 * k for k, name in enumerate(self.group.members)}
        count = 3 * len(column)
        rows: list[Array] = []

        def row() -> Array:
            rows.append(np.zeros((n, count)))
            return rows[-1]

        def sliding(pair: Slide, part: str) -> None:
            one, two = self._joints(pair, poses)
            back = np.conj(two.u)
            gap = one.z - two.z
            line = row()
            for name, sense, arm in (
                (pair.a, 1.0, one.z - poses[pair.a].z),
                (pair.b, -1.0, two.z - poses[pair.b].z + gap),
            ):
                if name in column:
                    at = column[name]
                    line[:, at] = getattr(sense * back, part)
                    line[:, at + 1] = getattr(sense * 1j * back, part)
                    line[:, at + 2] = getattr(sense * 1j * back * arm / size, part)

        def turning(one: str, two: str) -> None:
            line = row()
            for name, sense in ((one, 1.0), (two, -1.0)):
                if name in column:
                    line[:, column[name] + 2] += sense

        for pair in self.group.pairs:
            if isinstance(pair, Slide):
                turning(pair.a, pair.b)
                sliding(pair, "imag")
                continue
            horizontal, vertical = row(), row()
            for name, sense in ((pair.a, 1.0), (pair.b, -1.0)):
                if name in column:
                    at = column[name]
                    arm = poses[name].u * (self.structure.links[name].points[pair.point] / size)
                    horizontal[:, at] = vertical[:, at + 1] = sense
                    horizontal[:, at + 2] = -sense * arm.imag
                    vertical[:, at + 2] = sense * arm.real
        for driver in self.group.drivers:
            if isinstance(driver, AngleDriver):
                turning(driver.link, driver.relative_to)
            else:
                sliding(self.structure.slide(driver.key), "real")
        return np.stack(rows, axis=1)

    def scaled(self, step: Array) -> Array:
        """Columns (n, 3 members) back to (n, members, 3) in m and rad."""
        size = self.structure.scene.size
        return np.asarray(step.reshape(len(step), -1, 3) * np.array([size, size, 1.0]))


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


def certificate(system: System, members: Mapping[str, Pose], condition: Array, missed: Array) -> Array:
    """Kantorovich's number: |J^-1| |step| times how fast the matrix J changes, with step <= |J^-1| |open|.

    Below 1/2 there is a position, the only one within twice the step, and Newton's method converges to it quadratically
    (Ortega and Rheinboldt, Iterative Solution of Nonlinear Equations in Several Variables, 12.6).
    """
    size, rows = system.structure.scene.size, 3 * len(system.group.members)
    poses = [*members.values(), *system.known.values()]
    reach = 1 + np.max(np.broadcast_arrays(*(np.abs(p.z) / size for p in poses)), axis=0)
    step = condition * np.maximum(missed, ROUNDINGS) * rows**0.5
    return np.asarray(condition * step * 4 * reach * rows**0.5)


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
