"""Groups larger than a dyad, and groups with a driver that joins no common pair: all their links together.

Unknown are place and angle of each link; every pair, every driver inside and everything that rolls gives its equations,
with lengths counted in the size of the mechanism, so that columns weigh alike.  Newton's method finds the position to
rounding, the same matrix gives velocity and acceleration (Haug, Computer Aided Kinematics and Dynamics of Mechanical
Systems, ch. 3).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

import numpy as np

from graphkin.solver.linear_blocks import solve_all
from graphkin.solver.pose import FIELDS, UNIT, Array, Drive, Pose, rest, together, turned
from graphkin.structure import Driven, Dyad, LargerGroup, Pair, RollingRelation, Structure
from graphkin.structure.model import Coordinate

__all__ = [
    "Ends",
    "GroupSolved",
    "Layout",
    "System",
    "as_place",
    "form_of",
    "joint_place",
    "led_relation",
    "solve_group",
]  # fmt: skip


class Ends(NamedTuple):
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
            return Pose(z, u, NOTHING, NOTHING, NOTHING, NOTHING)
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


NOTHING = np.zeros(1)


class Layout:
    """What stands where among the constraints of a group: the rows of its pairs, then of its drivers."""

    def __init__(self, structure: Structure, group: LargerGroup) -> None:
        drivers = structure.drivers
        self.names = (*group.members, *dict.fromkeys(n for n in self._used(group) if n not in group.members))
        self.link = {name: k for k, name in enumerate(self.names)}
        self.members = len(group.members)
        self.size = structure.scene.size
        turns: list[tuple[int, Pair]] = []
        lines: list[tuple[int, Pair, complex]] = []
        slides: list[int] = []
        angles: list[tuple[int, str, str, int]] = []
        self.travels: list[tuple[int, int, int]] = []
        row = 0
        for pair in group.pairs:
            if pair.turns:
                turns.append((row, pair))
            else:
                slides.append(row)
                lines.append((row + 1, pair, -1j))
            row += 2
        self.slides = len(slides)
        for driver in group.drivers:
            i = drivers.index(driver)
            if driver.turns:
                angles.append((row, driver.link, driver.relative_to, i))
            else:
                self.travels.append((row, len(lines), i))
                lines.append((row, structure.slide(driver.key), 1 + 0j))
            row += 1
        weights = [relation.weights(self.size) for relation in group.rolling]
        self.rolling_rows = np.arange(row, row + len(weights))
        self.rolled = np.zeros((len(weights), len(self.names)))
        """How much the turning of each link counts in each relation of what rolls."""
        for k, terms in enumerate(weights):
            for (kind, name), weight in terms.items():
                if kind == "angle":
                    self.rolled[k, self.link[name]] = weight
                else:
                    lines.append((row + k, structure.slide(name), complex(weight * self.size)))
        outside = np.flatnonzero(np.any(self.rolled != 0.0, axis=0))
        self.outside = outside[outside >= self.members]
        """Links that the group hangs on of which the turns count."""
        self.relations_end = self.members + len(weights)
        row += len(weights)
        self.rows = row
        self.turn_pairs, self.line_pairs = [p for _, p in turns], [p for _, p, _ in lines]
        self.turns = [self._ends(structure, [(p, getattr(p, side)) for p in self.turn_pairs]) for side in "ab"]
        self.lines = [self._ends(structure, [(p, getattr(p, side)) for p in self.line_pairs]) for side in "ab"]
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
        self.same[self.rolling_rows, 2::3] = self.rolled[:, : self.members]
        for entries in self.turn_entries:
            self.same[entries.row, entries.column] = entries.sense
            self.same[entries.row + 1, entries.column + 1] = entries.sense
        turning = [(r, p.a, p.b) for r, (_, p, _) in zip(slides, lines, strict=False)]
        for r, one, two in [*turning, *((r, one, two) for r, one, two, _ in angles)]:
            for name, sign in ((one, 1.0), (two, -1.0)):
                if self.link[name] < self.members:
                    self.same[r, 3 * self.link[name] + 2] += sign

    @staticmethod
    def _used(group: LargerGroup) -> Iterator[str]:
        for pair in group.pairs:
            yield from (pair.a, pair.b)
        for driver in group.drivers:
            if driver.turns:
                yield from (driver.link, driver.relative_to)
        for relation in group.rolling:
            yield from relation.links

    def _ends(self, structure: Structure, joints: Sequence[tuple[Pair, str]]) -> Ends:
        frames = [joint_place(structure, pair, link) for pair, link in joints]
        return Ends(
            np.array([self.link[link] for _, link in joints], dtype=int),
            np.array([place for place, _ in frames], dtype=complex),
            np.array([direction for _, direction in frames], dtype=complex),
        )

    def _entries(self, ends: Ends, rows: Array, sense: float) -> _Entries:
        own = np.flatnonzero(ends.link < self.members)
        return _Entries(own, rows[own], 3 * ends.link[own], np.full(len(own), sense))


def layout_of(structure: Structure, group: LargerGroup) -> Layout:
    """The layout of a group, made once; it goes with its structure."""
    drivers = tuple(structure.drivers.index(driver) for driver in group.drivers)
    key = "layout", group.members, group.pairs, drivers, group.rolling
    if key not in structure.kept:
        structure.kept[key] = Layout(structure, group)
    layout: Layout = structure.kept[key]
    return layout


ROUNDS = 40
ROUNDINGS = 32 * UNIT
TOLD = 8 * UNIT
"""Relative error of what was given of rolling: radii, and where it starts."""
ROUGH = 1e-13
"""While more than this of a constraint is open, a step may make it more for once."""


def led_relation(element: Driven) -> RollingRelation:
    """How a link goes as those that it rolls on; of the follower of a cam what it goes by itself."""
    pair, rolled = element.pair, element.rolled
    own: Coordinate = ("angle", element.link) if pair.turns else ("travel", pair.key)
    factors = rolled.factors if rolled else ()
    terms = {own: Fraction(1), **{coordinate: Fraction(-factor) for coordinate, factor in factors}}
    return RollingRelation(f"{element.link} led", terms, rolled.links if rolled else (element.link, *pair.links))


@dataclass(frozen=True)
class System:
    """The constraints of a group at n positions of what it hangs on.

    The links together are one ``Pose``, its fields of shape (n, links): the group's own first, then those it hangs on.

    near : angles of all links to half a turn, whole turns included, shape (n, links) (rad); None where nothing rolls
    kept : the sums that rolling keeps, no unit, shape (n, relations)
    """

    structure: Structure
    group: LargerGroup
    known: Mapping[str, Pose]
    drive: Drive
    near: Array | None = None
    kept: Array | None = None

    @cached_property
    def layout(self) -> Layout:
        """What stands where."""
        return layout_of(self.structure, self.group)

    @cached_property
    def _outside(self) -> Pose:
        """The links that the group hangs on."""
        layout = self.layout
        return together([self.known[name] for name in layout.names[layout.members :]], len(self.drive))

    @classmethod
    def whole(cls, structure: Structure, drive: Drive) -> System:
        """The constraints of all links together; of a follower of a cam its own part alone."""
        frame = structure.scene.frame.name
        if "whole" in structure.kept:
            return cls(structure, structure.kept["whole"], {frame: rest()}, drive)
        pairs: list[Pair] = []
        rolling: list[RollingRelation] = []
        for e in structure.elements:
            pairs += [*e.pairs, *(joint.pair for joint in e.joints)] if isinstance(e, Dyad) else e.pairs
            rolling += [led_relation(e)] if isinstance(e, Driven) and not e.drivers else e.rolling
        members = tuple(name for name in structure.links if name != frame)
        whole = LargerGroup(members, tuple(pairs), structure.drivers, members, 0, rolling=tuple(rolling))
        structure.kept["whole"] = whole
        return cls(structure, structure.kept["whole"], {frame: rest()}, drive)

    def part(self, which: Array) -> System:
        """The constraints at some of the positions."""
        def some(column: Array) -> Array:
            return column[which] if len(column) > 1 else column

        known = {name: Pose(*(some(getattr(pose, f)) for f in FIELDS)) for name, pose in self.known.items()}
        near, kept = (None if rows is None else rows[which] for rows in (self.near, self.kept))
        return System(self.structure, self.group, known, self.drive[which], near, kept)

    def at(self, place: Array, rate: Array | None = None, second: Array | None = None) -> Pose:
        """All links from the members' places, rates and second rates, each of shape (n, members, 3)."""
        angle, out = place[:, :, 2], self._outside
        u = np.empty((len(place), len(self.layout.names)), dtype=complex)
        z, count = np.empty_like(u), self.layout.members
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
            return Pose(z, u, NOTHING, NOTHING, NOTHING, NOTHING)
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

    def rolling_from(self, start: Array) -> System:
        """With the turns and the sums that starting places tell, see ``form_of``."""
        layout = self.layout
        if not len(layout.rolling_rows):
            return self
        near = np.zeros((len(start), len(layout.names)))
        near[:, : layout.members] = start[:, : layout.members, 2]
        near[:, layout.outside] = start[:, layout.relations_end :, 2]
        return replace(self, near=near, kept=start[:, layout.members : layout.relations_end, 0])

    def with_turns(self, place: Array) -> Array:
        """Places of the group with the sums that rolling keeps, and the turns of the links outside, see ``form_of``."""
        layout = self.layout
        if not len(layout.rolling_rows):
            return place
        assert self.kept is not None
        more = np.zeros((len(place), len(layout.rolling_rows) + len(layout.outside), 3))
        more[:, : len(layout.rolling_rows), 0] = self.kept
        more[:, len(layout.rolling_rows) :, 2] = self.angles(self.at(place).u)[:, layout.outside]
        return np.concatenate((place, more), axis=1)

    def slope(self, poses: Mapping[str, Pose]) -> Array:
        """Rates of what ``form_of`` tells, shape (rows, 3), at the first position."""
        names = [*self.group.members, *("" for _ in self.layout.rolling_rows)]
        names += [self.layout.names[k] for k in self.layout.outside]
        moved = [poses[k] if k else rest() for k in names]
        rows = np.array([[p.v.real[0], p.v.imag[0], p.omega[0]] for p in moved])
        rows[len(self.group.members) :, :2] = 0.0
        return rows

    def residuals(self, all_: Pose) -> Array:
        """Each constraint, with lengths in the size, shape (n, rows)."""
        return np.asarray(self.constraints(all_, 0)[0])

    def constraints(self, all_: Pose, order: int = 2) -> Array:
        """Each constraint and its rates up to the order, with lengths in the size, shape (order + 1, n, rows)."""
        layout, drive = self.layout, self.drive
        size = layout.size
        found = np.empty((order + 1, len(drive), layout.rows))
        found[:, :, layout.rolling_rows] = 0.0
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
        if len(layout.rolling_rows):
            if self.near is None or self.kept is None:
                found[0][:, layout.rolling_rows] = 0.0  # the turns are not counted
            else:
                found[0][:, layout.rolling_rows] += self.angles(all_.u) @ layout.rolled.T - self.kept
            for k, field in enumerate(("omega", "alpha")[:order]):
                found[k + 1][:, layout.rolling_rows] += getattr(all_, field) @ layout.rolled.T
        return found

    def angles(self, u: Array) -> Array:
        """Angles of all links, whole turns included, shape (n, links) (rad)."""
        assert self.near is not None
        return np.asarray(self.near + np.angle(u * np.exp(-1j * self.near)))

    def matrix(self, all_: Pose) -> Array:
        """Derivative of the constraints by (x / size, y / size, angle) of each member, shape (n, rows, columns)."""
        layout = self.layout
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
                    found[:, row, column + 2] += -(along * arm).imag / layout.size
        return found

    def scaled(self, step: Array) -> Array:
        """Columns (n, 3 members) back to (n, members, 3) in m and rad."""
        size = self.structure.scene.size
        return np.asarray(step.reshape(len(step), -1, 3) * np.array([size, size, 1.0]))


def _seen(one: Pose, two: Pose) -> Pose:
    """Place and direction of a frame in the axes of another."""
    back = np.conj(two.u)
    return Pose(back * (one.z - two.z), back * one.u, NOTHING, NOTHING, NOTHING, NOTHING)


@dataclass(frozen=True)
class GroupSolved:
    """What a larger group gives.

    poses : its links
    place : the same as an array (n, members, 3) of x, y (m) and angle (rad, not reduced); where something rolls with
        more rows, see ``form_of``
    residual : of the constraint that is most open, no unit; infinite where nothing is known
    matrix : derivative of the constraints by the scaled unknowns, shape (n, rows, columns)
    right_side : rate of the constraints with the group held still, shape (n, rows)
    """

    system: System
    poses: Mapping[str, Pose]
    place: Array
    residual: Array
    matrix: Array
    right_side: Array

    @cached_property
    def _whole(self) -> Array:
        return np.asarray(np.isfinite(self.matrix).all(axis=(1, 2)))

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

    def same_assembly(self, place: Array) -> bool:
        """Whether a place nearby (rows, 3) is of the same assembly for certain, whatever the rates there: by the
        bound on its matrix, which stays regular all around (of the first position)."""
        off = (self.place[0] - place)[: len(self.system.group.members)]
        moved = float(np.linalg.norm(off / np.array([self.system.structure.scene.size] * 2 + [1.0])))
        return bool(self.condition[0] * _bending(self.system, self.poses)[0] * moved < 0.5)

    @cached_property
    def rolling_residuals(self) -> Array:
        """How far what rolls may be off: what is still open, and the rounding of its turns; shape (n, relations)."""
        system, layout = self.system, self.system.layout
        if not len(layout.rolling_rows):
            return np.zeros((len(self.residual), 0))
        assert system.kept is not None
        angles = np.concatenate((self.place[:, : layout.members, 2], self.place[:, layout.relations_end :, 2]), axis=1)
        turned = np.abs(angles).max(axis=1, initial=1.0)[:, None] * np.abs(layout.rolled).sum(axis=1)
        return np.asarray(self.residual[:, None] + TOLD * (np.abs(system.kept) + turned))

    @cached_property
    def certificate(self) -> Array:
        """Less than 1/2 where Newton's method has converged quadratically to a position."""
        with np.errstate(all="ignore"):
            return certificate(self.system, self.poses, self.condition, self.residual)


def solve_group(
    structure: Structure,
    group: LargerGroup,
    known: Mapping[str, Pose],
    drive: Drive,
    start: Array,
    rates: bool = True,
) -> GroupSolved:
    """Solve a group by Newton's method from given places, shape (n, members, 3); where something rolls with more rows,
    see ``form_of``."""
    n = len(drive)
    system, start = System(structure, group, known, drive), np.asarray(start)
    start = np.broadcast_to(start, (n, *start.shape[-2:]))
    system = system.rolling_from(start)
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
    form = system.with_turns(place)
    return GroupSolved(system, system.poses(place, rate, second), form, residual, matrix, right_side)


def form_of(structure: Structure, group: LargerGroup, poses: Mapping[str, Pose]) -> Array:
    """From where Newton's method goes on from the scene's own position, shape (rows, 3): the places of the links; where
    something rolls also a row for each sum that it keeps, and one for each link outside the group that rolls with it,
    for the sake of its turns."""
    drive = Drive(*(np.zeros((1, len(structure.drivers))),) * 3)
    system = System(structure, group, poses, drive)
    place = as_place(poses, group.members)[:1]
    if not group.rolling:
        return np.asarray(place[0])
    all_ = system.at(place)
    system = replace(system, near=np.angle(all_.u), kept=np.zeros((1, len(group.rolling))))
    kept = system.constraints(all_, 0)[0][:, system.layout.rolling_rows]
    return np.asarray(replace(system, kept=kept).with_turns(place)[0])


def certificate(system: System, members: Mapping[str, Pose], condition: Array, residual: Array) -> Array:
    """Kantorovich's number: |J^-1| |step| times how fast the matrix J changes, with step <= |J^-1| |open|.

    Below 1/2 there is a position, the only one within twice the step, and Newton's method converges to it quadratically
    (Ortega and Rheinboldt, Iterative Solution of Nonlinear Equations in Several Variables, 12.6).
    """
    step = condition * np.maximum(residual, ROUNDINGS) * (3 * len(system.group.members)) ** 0.5
    return np.asarray(condition * step * _bending(system, members))


def _bending(system: System, members: Mapping[str, Pose]) -> Array:
    """The most by which the matrix changes with the scaled unknowns, both as roots of squares."""
    size, rows = system.structure.scene.size, 3 * len(system.group.members)
    poses = [*members.values(), *system.known.values()]
    reach = 1 + np.max(np.broadcast_arrays(*(np.abs(p.z) / size for p in poses)), axis=0)
    return np.asarray(4 * reach * rows**0.5)


def as_place(poses: Mapping[str, Pose], names: tuple[str, ...]) -> Array:
    """Poses as an array of shape (n, members, 3)."""
    return np.stack(
        [np.stack([poses[k].z.real, poses[k].z.imag, np.angle(poses[k].u)], axis=-1) for k in names], axis=1
    )


def joint_place(structure: Structure, pair: Pair, link: str) -> tuple[complex, complex]:
    """Origin and direction of the joint's frame in the axes of one of its links (at a sliding pair: of the guide)."""
    if pair.turns:
        return structure.links[link].points[pair.point], 1 + 0j
    if link == pair.a:
        return 0j, pair.turn.conjugate()
    return pair.guide.through, pair.guide.direction
