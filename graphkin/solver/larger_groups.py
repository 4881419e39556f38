"""Groups larger than a dyad, and groups with a driver that joins no common pair: all their links together.

Unknown are place and angle of each link; every pair and every driver inside gives its equations, with lengths counted
in the size of the mechanism, so that columns weigh alike.  Newton's method finds the position to rounding, the same
matrix gives velocity and acceleration (Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, ch. 3).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple
from weakref import finalize

import numpy as np

from graphkin.scene.model import AngleDriver
from graphkin.solver.joints import Drive, joint_place, turned
from graphkin.solver.pose import FIELDS, Array, Pose, rest, together
from graphkin.solver.rounding import UNIT
from graphkin.structure import Cluster, Driven, Dyad, Pair, Slide, Structure, Turn

__all__ = ["ClusterSolved", "System", "as_place", "solve_all", "solve_cluster"]

ROUNDS = 40
ROUNDINGS = 32 * UNIT


class _Ends(NamedTuple):
    """One side of some joints: columns of their links, place and direction of the joint's frame in the link's axes."""

    link: Array
    place: Array
    direction: Array

    def of(self, all_: Pose, order: int) -> Pose:
        """The joints' frames in the world, fields of shape (n, joints); rates up to the order, the others nothing."""
        z, u = all_.z[:, self.link], all_.u[:, self.link]
        arm = u * self.place
        z, u = z + arm, u * self.direction
        if order == 0:
            return Pose(z, u, _NOTHING, _NOTHING, _NOTHING, _NOTHING)
        omega, alpha = all_.omega[:, self.link], all_.alpha[:, self.link]
        spin = 1j * omega
        v = all_.v[:, self.link] + spin * arm
        return Pose(z, u, v, omega, all_.a[:, self.link] + (1j * alpha + spin * spin) * arm, alpha)


class _Entries(NamedTuple):
    """Entries of the matrix by links of the group: of which joints, in which row and column, with which sense."""

    joint: Array
    row: Array
    column: Array
    sense: Array


_NOTHING = np.zeros(1)


class _Layout:
    """What stands where among the constraints of a group: the rows of its pairs, then of its drivers."""

    def __init__(self, structure: Structure, group: Cluster) -> None:
        drivers = structure.drivers
        self.names = (*group.members, *dict.fromkeys(n for n in self._used(group) if n not in group.members))
        self.link = {name: k for k, name in enumerate(self.names)}
        self.members = len(group.members)
        self.size = structure.scene.size
        turns: list[tuple[int, Turn]] = []
        lines: list[tuple[int, Slide, complex]] = []
        slides: list[int] = []
        angles: list[tuple[int, str, str, int]] = []
        self.travels: list[tuple[int, int, int]] = []
        row = 0
        for pair in group.pairs:
            if isinstance(pair, Turn):
                turns.append((row, pair))
            else:
                slides.append(row)
                lines.append((row + 1, pair, -1j))
            row += 2
        self.slides = len(slides)
        for driver in group.drivers:
            i = drivers.index(driver)
            if isinstance(driver, AngleDriver):
                angles.append((row, driver.link, driver.relative_to, i))
            else:
                self.travels.append((row, len(lines), i))
                lines.append((row, structure.slide(driver.key), 1 + 0j))
            row += 1
        self.rows = row
        self.turns = [self._ends(structure, [(p, getattr(p, side)) for _, p in turns]) for side in "ab"]
        self.lines = [self._ends(structure, [(p, getattr(p, side)) for _, p, _ in lines]) for side in "ab"]
        self.turn_rows = np.array([r for r, _ in turns], dtype=int)
        self.slide_rows = np.array(slides, dtype=int)
        self.line_rows = np.array([r for r, _, _ in lines], dtype=int)
        self.part = np.array([part for _, _, part in lines], dtype=complex)
        """By this times a number its real part is the part that a line wants: along the guide or across."""
        both = [(link, base) for _, link, base, _ in angles]
        self.angle_rows = np.array([r for r, *_ in angles], dtype=int)
        self.turned = [np.array([self.link[x] for x in side], dtype=int) for side in zip(*both, strict=True)]
        self.angle_drivers = np.array([i for *_, i in angles], dtype=int)
        self.turn_entries = [self._entries(e, self.turn_rows, s) for e, s in zip(self.turns, (1.0, -1.0), strict=True)]
        self.line_entries = [self._entries(e, self.line_rows, s) for e, s in zip(self.lines, (1.0, -1.0), strict=True)]
        self.same = np.zeros((self.rows, 3 * self.members))
        for entries in self.turn_entries:
            self.same[entries.row, entries.column] = entries.sense
            self.same[entries.row + 1, entries.column + 1] = entries.sense
        turning = [(r, p.a, p.b) for r, (_, p, _) in zip(slides, lines, strict=False)]
        for r, one, two in [*turning, *((r, one, two) for r, one, two, _ in angles)]:
            for name, sign in ((one, 1.0), (two, -1.0)):
                if self.link[name] < self.members:
                    self.same[r, 3 * self.link[name] + 2] += sign

    @staticmethod
    def _used(group: Cluster) -> Iterator[str]:
        for pair in group.pairs:
            yield from (pair.a, pair.b)
        for driver in group.drivers:
            if isinstance(driver, AngleDriver):
                yield from (driver.link, driver.relative_to)

    def _ends(self, structure: Structure, joints: Sequence[tuple[Pair, str]]) -> _Ends:
        frames = [joint_place(structure, pair, link) for pair, link in joints]
        return _Ends(
            np.array([self.link[link] for _, link in joints], dtype=int),
            np.array([place for place, _ in frames], dtype=complex),
            np.array([direction for _, direction in frames], dtype=complex),
        )

    def _entries(self, ends: _Ends, rows: Array, sense: float) -> _Entries:
        own = np.flatnonzero(ends.link < self.members)
        return _Entries(own, rows[own], 3 * ends.link[own], np.full(len(own), sense))


_LAYOUTS: dict[tuple[int, tuple[str, ...], tuple[str, ...]], _Layout] = {}


def _layout(structure: Structure, group: Cluster) -> _Layout:
    """The layout of a group, made once."""
    key = (id(structure), group.members, tuple(driver.key for driver in group.drivers))
    if key not in _LAYOUTS:
        _LAYOUTS[key] = _Layout(structure, group)
        finalize(structure, _LAYOUTS.pop, key, None)
    return _LAYOUTS[key]


@dataclass(frozen=True)
class System:
    """The constraints of a group at n positions of what it hangs on.

    The links together are one ``Pose``, its fields of shape (n, links): the group's own first, then those it hangs on.
    """

    structure: Structure
    group: Cluster
    known: Mapping[str, Pose]
    drive: Drive

    @cached_property
    def _layout(self) -> _Layout:
        return _layout(self.structure, self.group)

    @cached_property
    def _outside(self) -> Pose:
        """The links that the group hangs on."""
        layout = self._layout
        return together([self.known[name] for name in layout.names[layout.members :]], len(self.drive))

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
        every = Cluster(members, tuple(pairs), structure.drivers, members, 0)
        return cls(structure, every, {frame: rest()}, drive)

    def at(self, place: Array, rate: Array | None = None, second: Array | None = None) -> Pose:
        """All links from the members' places, rates and second rates, each of shape (n, members, 3)."""
        angle, out = place[:, :, 2], self._outside
        u = np.empty((len(place), len(self._layout.names)), dtype=complex)
        z, count = np.empty_like(u), self._layout.members
        z.real[:, :count], z.imag[:, :count] = place[:, :, 0], place[:, :, 1]
        np.cos(angle, out=u.real[:, :count])
        np.sin(angle, out=u.imag[:, :count])
        z[:, count:], u[:, count:] = out.z, out.u

        def rates(given: Array | None, linear: Array, turning: Array) -> tuple[Array, Array]:
            if given is None:
                given = np.zeros_like(place)
            return (
                np.concatenate((given[:, :, 0] + 1j * given[:, :, 1], linear), axis=1),
                np.concatenate((given[:, :, 2], turning), axis=1),
            )

        if rate is None and second is None:
            return Pose(z, u, _NOTHING, _NOTHING, _NOTHING, _NOTHING)
        return Pose(z, u, *rates(rate, out.v, out.omega), *rates(second, out.a, out.alpha))

    def of(self, members: Mapping[str, Pose]) -> Pose:
        """All links from the members' poses."""
        own, out = together([members[name] for name in self.group.members], len(self.drive)), self._outside
        return Pose(*(np.concatenate((getattr(own, f), getattr(out, f)), axis=1) for f in FIELDS))

    def poses(self, place: Array, rate: Array | None = None, second: Array | None = None) -> dict[str, Pose]:
        """Members' poses from places, rates and second rates, each of shape (n, members, 3)."""
        zero = np.zeros_like(place)
        all_ = self.at(place, zero if rate is None else rate, zero if second is None else second)
        return {
            name: Pose(*(np.ascontiguousarray(getattr(all_, f)[:, k]) for f in FIELDS))
            for k, name in enumerate(self.group.members)
        }

    def open_(self, all_: Pose) -> Array:
        """Each constraint, with lengths in the size, shape (n, rows)."""
        return np.asarray(self.constraints(all_, 0)[0])

    def constraints(self, all_: Pose, order: int = 2) -> Array:
        """Each constraint and its rates up to the order, with lengths in the size, shape (order + 1, n, rows)."""
        layout, drive = self._layout, self.drive
        size = layout.size
        found = np.empty((order + 1, len(drive), layout.rows))
        if len(layout.turn_rows):
            one, two = (ends.of(all_, order) for ends in layout.turns)
            for k, field in enumerate(("z", "v", "a")[: order + 1]):
                gap = (getattr(one, field) - getattr(two, field)) / size
                found[k][:, layout.turn_rows], found[k][:, layout.turn_rows + 1] = gap.real, gap.imag
        if len(layout.line_rows):
            one, two = (ends.of(all_, order) for ends in layout.lines)
            seen, pairs = two.inverse().of(one) if order else _seen(one, two), slice(layout.slides)
            found[0][:, layout.slide_rows] = np.angle(seen.u[:, pairs])
            for k, field in enumerate(("z", "v", "a")[: order + 1]):
                found[k][:, layout.line_rows] = (layout.part * getattr(seen, field)).real / size
            for k, field in enumerate(("omega", "alpha")[:order]):
                found[k + 1][:, layout.slide_rows] = getattr(seen, field)[:, pairs]
            for row, _, i in layout.travels:
                for k, given in enumerate((drive.value, drive.rate, drive.second)[: order + 1]):
                    found[k][:, row] -= given[:, i] / size
        if len(layout.angle_rows):
            (link, base), which = layout.turned, layout.angle_drivers
            turn = np.conj(all_.u[:, base]) * all_.u[:, link] * np.conj(turned(drive.value[:, which]))
            found[0][:, layout.angle_rows] = np.angle(turn)
            for k, (field, given) in enumerate((("omega", drive.rate), ("alpha", drive.second))[:order]):
                rates = getattr(all_, field)
                found[k + 1][:, layout.angle_rows] = rates[:, link] - rates[:, base] - given[:, which]
        return found

    def matrix(self, all_: Pose) -> Array:
        """Derivative of the constraints by (x / size, y / size, angle) of each member, shape (n, rows, columns)."""
        layout = self._layout
        found = np.repeat(layout.same[None], len(self.drive), axis=0)
        for ends, (joint, row, column, sense) in zip(layout.turns, layout.turn_entries, strict=True):
            if len(joint):
                arm = all_.u[:, ends.link[joint]] * (ends.place[joint] * (sense / layout.size))
                found[:, row, column + 2], found[:, row + 1, column + 2] = -arm.imag, arm.real
        if len(layout.line_rows):
            one, two = (ends.of(all_, 0) for ends in layout.lines)
            back = np.conj(two.u) * layout.part
            for ends, (joint, row, column, sense) in zip(layout.lines, layout.line_entries, strict=True):
                if len(joint):
                    along = back[:, joint] * sense
                    arm = one.z[:, joint] - all_.z[:, ends.link[joint]]
                    found[:, row, column], found[:, row, column + 1] = along.real, -along.imag
                    found[:, row, column + 2] = -(along * arm).imag / layout.size
        return found

    def scaled(self, step: Array) -> Array:
        """Columns (n, 3 members) back to (n, members, 3) in m and rad."""
        size = self.structure.scene.size
        return np.asarray(step.reshape(len(step), -1, 3) * np.array([size, size, 1.0]))


def _seen(one: Pose, two: Pose) -> Pose:
    """Place and direction of a frame in the axes of another."""
    back = np.conj(two.u)
    return Pose(back * (one.z - two.z), back * one.u, _NOTHING, _NOTHING, _NOTHING, _NOTHING)


@dataclass(frozen=True)
class ClusterSolved:
    """What a larger group gives.

    poses : its links
    place : the same as an array (n, members, 3) of x, y (m) and angle (rad, not reduced)
    open_ : largest constraint still open, no unit
    matrix : derivative of the constraints by the scaled unknowns, shape (n, rows, columns)
    load : rate of the constraints with the group held still, shape (n, rows)
    """

    system: System
    poses: Mapping[str, Pose]
    place: Array
    open_: Array
    matrix: Array
    load: Array

    @cached_property
    def _whole(self) -> Array:
        return np.asarray(np.isfinite(self.matrix).all(axis=(1, 2)))

    @cached_property
    def missed(self) -> Array:
        """Largest constraint still open, infinite where nothing is known."""
        return np.asarray(np.where(self._whole, self.open_, np.inf))

    @cached_property
    def determinant(self) -> Array:
        """Of the scaled constraints; its sign tells the branch."""
        return np.asarray(np.linalg.det(self.matrix))

    @cached_property
    def condition(self) -> Array:
        """Of the scaled constraints, one over the least singular value: how much an error grows."""
        with np.errstate(all="ignore"):
            finite = np.asarray(np.where(self._whole[:, None, None], self.matrix, 0.0), dtype=float)
            least = np.linalg.svd(finite, compute_uv=False)[:, -1]
            return np.asarray(np.where(self._whole, 1 / np.maximum(least, 1e-300), np.inf))

    @cached_property
    def certificate(self) -> Array:
        """Less than 1/2 where Newton's method has converged quadratically to a position."""
        with np.errstate(all="ignore"):
            return certificate(self.system, self.poses, self.condition, self.missed)


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
        all_ = system.at(place)
        open_ = system.open_(all_)
        now = np.abs(open_).max(axis=1)
        better = now < missed
        best = np.where(better[:, None, None], place, best)
        if not np.any(better & (now > 1e-13)) and not np.any(better & (now < 0.5 * missed)):
            missed = np.minimum(missed, now)
            break
        missed = np.fmin(missed, now)
        place = place - system.scaled(solve_all(system.matrix(all_), open_))
    place = best
    matrix = system.matrix(system.at(place))
    rate: Array | None = None
    second: Array | None = None
    if rates:
        # the guiding, centripetal and Coriolis terms are the rates of the constraints with the unknown rates left out
        load = system.constraints(system.at(place, np.zeros_like(place)), 1)[1]
        rate = system.scaled(solve_all(matrix, -load))
        bent = system.constraints(system.at(place, rate))[2]
        second = system.scaled(solve_all(matrix, -bent))
    else:
        load = np.zeros((n, matrix.shape[1]))
    return ClusterSolved(system, system.poses(place, rate, second), place, missed, matrix, load)


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
