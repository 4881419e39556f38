"""Bounds of the errors of a mechanism with larger groups, of all its links together.

An error is the inverse of the matrix of all constraints times what these may be off, term by term: what is still open
of them, the rounding in telling that, and the roundings in the numbers of the scene.  An error of place puts the
constraints of the rates off, errors of place and rates those of the second rates.

Links that a cam or rolling leads, beside larger groups, are as good as driven at the places that were found for them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from graphkin.scene.cams import LawCam, SlidingFollower
from graphkin.scene.model import Driver
from graphkin.solver.cams import follower_inputs, greatest_jerk
from graphkin.solver.drivers import Drive
from graphkin.solver.expressions import Name
from graphkin.solver.larger_groups import System, joint_place
from graphkin.solver.linear_blocks import solve_all
from graphkin.solver.pose import UNIT, Array, ErrorBound, Pose, rest
from graphkin.structure import Driven, Pair, Rolled, RollingRelation, Structure

__all__ = ["Rows", "bounds"]

@dataclass(frozen=True)
class LedLink:
    """A link that a cam or rolling leads, and the driver that would move it so."""

    element: Driven
    driver: Driver

    def off(
        self, order: int, structure: Structure, poses: Mapping[str, Pose], errors: Mapping[str, Errors],
        given: Callable[[Name], float],
    ) -> Array:  # fmt: skip
        """How far its value (0), or its first or second rate, may be off (rad, m): by the looking up, and by what leads
        it, with the errors of that."""
        lead = self.element.driver
        if isinstance(lead, LawCam):
            return self._by_cam(order, lead, poses, errors, given)
        assert isinstance(lead, Rolled)
        part = "cos" if lead.turns else "travel"
        found = np.asarray(given(("error", "rolled", lead.key, part)))
        for (kind, name), factor in lead.factors:
            if kind == "angle":
                found = found + abs(factor) * _turning_of(errors, name, order)
                continue
            slide = structure.slide(name)
            for link in (slide.a, slide.b):
                error, arm = errors.get(link), np.abs(poses[slide.a].z - poses[slide.b].z)
                if error is not None:
                    found = found + abs(factor) * (error.of_point[order] + arm * error.of_turning[order])
        return np.asarray(found)

    def _by_cam(
        self, order: int, cam: LawCam, poses: Mapping[str, Pose], errors: Mapping[str, Errors],
        given: Callable[[Name], float],
    ) -> Array:  # fmt: skip
        own = poses[cam.link]
        inputs = follower_inputs(cam, np.asarray(own.u))
        slope, bend = np.abs(inputs["slope"]), np.abs(inputs["bend"])
        jerk = greatest_jerk(cam.law)
        value = given(("error", "lift", cam.link, "travel" if isinstance(cam.motion, SlidingFollower) else "cos"))
        off = [_turning_of(errors, cam.link, k) for k in range(3)]
        if order == 0:
            return np.asarray(value + slope * off[0])
        spin, push = np.abs(own.omega), np.abs(own.alpha)
        of_slope = given(("error", "lift", cam.link, "slope")) + bend * off[0]
        if order == 1:
            return np.asarray(of_slope * spin + slope * off[1])
        of_bend = given(("error", "lift", cam.link, "bend")) + jerk * off[0]
        return np.asarray(of_bend * spin**2 + of_slope * push + 2 * bend * spin * off[1] + slope * off[2])


def _turning_of(errors: Mapping[str, Errors], link: str, order: int) -> Array:
    return errors[link].of_turning[order] if link in errors else np.zeros(1)


def with_led_links(
    structure: Structure, poses: Mapping[str, Pose], drive: Drive
) -> tuple[Structure, Drive, tuple[LedLink, ...]]:
    """The structure with drivers for the links that cams and rolling lead, and their values in these positions."""
    led: list[LedLink] = []
    columns: list[tuple[Array, Array, Array]] = []
    frame = structure.scene.frame.name
    for element in structure.elements:
        if not (isinstance(element, Driven) and isinstance(element.driver, LawCam | Rolled)):
            continue
        pair = element.pair
        if pair.turns:
            pose = poses[element.link]
            led.append(LedLink(element, Driver(element.link, frame, 0.0, 0.0, 0.0)))
            columns.append((np.angle(pose.u), pose.omega, pose.alpha))
            continue
        one, two = (poses[name].fixed(*joint_place(structure, pair, name)) for name in (pair.a, pair.b))
        seen = two.inverse().of(one)
        led.append(LedLink(element, Driver(pair.a, pair.b, 0.0, 0.0, 0.0, pair.key)))
        columns.append((seen.z.real, seen.v.real, seen.a.real))
    if not led:
        return structure, drive, ()
    n = len(drive)
    more = [np.stack([np.broadcast_to(c[k], (n,)) for c in columns], axis=1) for k in range(3)]
    whole = Drive(*(np.concatenate((np.asarray(had), add), axis=1)
                    for had, add in zip((drive.value, drive.rate, drive.second), more, strict=True)))  # fmt: skip
    return replace(structure, followers=(*structure.followers, *(one.driver for one in led))), whole, tuple(led)


FEW = 4 * UNIT
"""The roundings of a sum of products."""
Errors = ErrorBound[Array]
_NONE = Errors(*(np.zeros(1),) * 6)


def bounds(
    structure: Structure, poses: Mapping[str, Pose], drive: Drive, given: Callable[[Name], float], rolled: Array
) -> Errors:
    """Bounds of the errors of a whole mechanism: the most of any point of any link and of the turning of any.

    Parameters
    ----------
    poses : of all links, with their rates
    given : how far a number of the scene may be off, by its name as in ``graphkin.solver.program``
    rolled : how far what rolls in groups may be off, shape (n, relations)
    """
    structure, drive, led = with_led_links(structure, poses, drive)
    before: Mapping[str, Errors] = {}
    for _ in led:  # each may be led by what another leads
        before = _bounds(structure, poses, drive, given, led, before, rolled)[0]
    found = _bounds(structure, poses, drive, given, led, before, rolled)[1]
    return Errors(*(np.max(np.broadcast_arrays(*column), axis=0) for column in zip(*found, strict=True)))


def _bounds(
    structure: Structure, poses: Mapping[str, Pose], drive: Drive, given: Callable[[Name], float],
    led: Sequence[LedLink], before: Mapping[str, Errors], rolled: Array,
) -> tuple[Mapping[str, Errors], list[Errors]]:  # fmt: skip
    """Errors of each link, and the most of any point of it; ``before`` are those of what leads the ``led``."""
    system = System.whole(structure, drive)
    names, n = system.group.members, len(drive)
    members = {name: poses[name].spread(n) for name in names}
    every, all_ = {**system.known, **members}, system.of(members)
    with np.errstate(all="ignore"):
        matrix = system.matrix(all_)
        inverse = solve_all(matrix, np.broadcast_to(np.eye(matrix.shape[1]), matrix.shape))
        inverse = np.where(np.isnan(inverse), np.inf, inverse)
        sizes = _sizes(system, all_, matrix, inverse)
        residuals = np.abs(system.constraints(all_))

        def off(order: int, rows: Rows) -> Array:
            return np.asarray(residuals[order] + np.stack(_all(rows.off(order), n), axis=1))

        first = Rows(system, every, {}, given, rolled, led, before)
        alone = [off(order, first) for order in range(3)]
        change = np.zeros(n)
        found = dict.fromkeys(names, _NONE)
        chained = dict.fromkeys(names, _NONE)
        for order in range(3):
            # what has happened to the constraints so far, by the rates at which the inverse passes it on
            tight = sum(w * _times(sizes[k], alone[order - k]) for k, w in enumerate(_BINOMIAL[order]))
            # and step by step through the constraints of the rates: more, but with what the first leaves out
            loose = _times(sizes[0], off(order, replace(first, errors=chained)) if order else alone[0])
            if order == 0:
                change = _change(system, every, inverse, np.asarray(tight))
            grown = 1 / np.maximum(1 - 3 * change, 0.0)[:, None]
            loose = loose + (grown - 1) * loose.max(axis=1, keepdims=True)
            found = _with(found, order, tight + (grown - 1) * loose.max(axis=1, keepdims=True), system)
            chained = _with(chained, order, loose, system)
        return found, [_points(structure, name, members, found[name]) for name in names]


_BINOMIAL = ((1,), (1, 1), (1, 2, 1))


def _times(matrix: Array, right: Array) -> Array:
    return np.asarray(np.einsum("nij,nj->ni", matrix, right))


def _with(found: Mapping[str, Errors], order: int, error: Array, system: System) -> dict[str, Errors]:
    """The errors of place, rate or second rate put to each link."""
    made: dict[str, Errors] = {}
    error = np.where(np.isfinite(error), error, np.inf).reshape(len(error), -1, 3)
    for k, name in enumerate(system.group.members):
        place, turn = system.structure.scene.size * np.hypot(error[:, k, 0], error[:, k, 1]), error[:, k, 2]
        fields = dict(zip((("position", "angle"), ("velocity", "omega"), ("acceleration", "alpha"))[order],
                          (place, turn), strict=True))
        made[name] = replace(found[name], **fields)
    return made


def _sizes(system: System, all_: Pose, here: Array, inverse: Array) -> tuple[Array, Array, Array]:
    """Sizes of the entries of the inverse of a matrix, and of its first and second rate along the motion.

    With G and A the rates of the matrix these are -S G S and 2 S G S G S - S A S; G and A by differences, which is
    enough for a bound.
    """
    size, p = system.structure.scene.size, all_
    quick = np.sqrt(np.fmax(np.abs(p.alpha), np.abs(p.a) / size))
    fast = np.fmax(np.fmax(np.abs(p.omega), np.abs(p.v) / size), quick).max(axis=1)
    step = 1e-4 / np.where(fast > 0, fast, 1.0)

    def at(t: Array) -> Array:
        half = t * t / 2
        turn = np.exp(1j * (t * p.omega + half * p.alpha))
        return system.matrix(replace(p, z=p.z + t * p.v + half * p.a, u=p.u * turn))

    wide = step[:, None, None]
    ahead, behind = at(step[:, None]), at(-step[:, None])
    first, second = (ahead - behind) / (2 * wide), (ahead - 2 * here + behind) / wide**2
    bent = inverse @ first @ inverse
    return np.abs(inverse), np.abs(bent), np.abs(2 * bent @ first @ inverse - inverse @ second @ inverse)


def _all(rows: Sequence[Array], n: int) -> list[Array]:
    return [np.broadcast_to(row, (n,)) for row in rows]


def _change(system: System, poses: Mapping[str, Pose], inverse: Array, error: Array) -> Array:
    """By how much of itself the matrix may change within the error of place, and then, divided by one less this, its
    inverse (Golub and Van Loan, Matrix Computations, theorem 2.3.4)."""
    size = system.structure.scene.size
    column = {name: k for k, name in enumerate(system.group.members)}
    spread = error.reshape(len(error), -1, 3)
    still = np.zeros(len(error))

    def turn(name: str) -> Array:
        return spread[:, column[name], 2] if name in column else still

    def moved(name: str) -> Array:
        return np.hypot(spread[:, column[name], 0], spread[:, column[name], 1]) if name in column else still

    change = np.zeros(len(error))
    for pair in system.group.pairs:
        one, two = (poses[k].fixed(joint_place(system.structure, pair, k)[0]) for k in (pair.a, pair.b))
        arm, other = (np.abs(j.z - poses[k].z) / size for j, k in ((one, pair.a), (two, pair.b)))
        change += (arm * turn(pair.a)) ** 2 + (other * turn(pair.b)) ** 2
        if not pair.turns:
            far = np.abs(one.z - poses[pair.b].z) / size
            off = moved(pair.a) + moved(pair.b) + arm * turn(pair.a)
            # along the guide and across, as either may be a constraint
            change += 2 * (2 * turn(pair.b)) ** 2 + 2 * ((arm + far) * turn(pair.b) + off) ** 2
    most = np.sqrt(np.sum(inverse**2, axis=(1, 2)))
    return np.asarray(most * np.sqrt(change))


def _points(structure: Structure, name: str, poses: Mapping[str, Pose], error: Errors) -> Errors:
    """The most of any point of a link, coincident points under what slides on it too, and of its turning."""
    pose = poses[name]
    r = np.full(len(pose.z), max(map(abs, structure.links[name].points.values()), default=0.0))
    for slide in structure.slides:
        if slide.b == name and slide.a in poses:
            r = np.maximum(r, np.abs(poses[slide.a].z - pose.z))
    spin, bend = np.abs(pose.omega), np.abs(pose.alpha) + pose.omega**2
    return error.within(r, (np.abs(pose.z), np.abs(pose.v), np.abs(pose.a)), spin, bend, FEW)


class _Joint(NamedTuple):
    """A joint's frame on its link, with bounds of its fields."""

    pose: Pose
    error: Errors


@dataclass(frozen=True)
class Rows:
    """How far each constraint may be off with its unknowns as they are found.

    poses, errors : of every link, errors as far as they are known already
    known : joints of links of which nothing is off, as they are found
    """

    system: System
    poses: Mapping[str, Pose]
    errors: Mapping[str, Errors]
    given: Callable[[Name], float]
    rolled: Array
    led: Sequence[LedLink] = ()
    before: Mapping[str, Errors] = field(default_factory=dict)
    known: dict[tuple[int, str], _Joint] = field(default_factory=dict)

    def off(self, order: int) -> list[Array]:
        """In the order of the constraints, of their values (0), first (1) or second rates (2)."""
        rows: list[Array] = []
        size, structure = self.system.structure.scene.size, self.system.structure
        for pair in self.system.group.pairs:
            one, two = self._joint(pair, pair.a), self._joint(pair, pair.b)
            if pair.turns:
                gap = (one.error.of_point[order] + two.error.of_point[order]) / size
                rows += [gap, gap]
            else:
                rows += [_turning(one, two, order), _sliding(one, two, order) / size]
        for driver in self.system.group.drivers:
            i = structure.drivers.index(driver)
            first = len(structure.drivers) - len(self.led)
            given: float | Array
            if i >= first:
                given = self.led[i - first].off(order, structure, self.poses, self.before, self.given)
            else:
                given = self.given(("error", ("angle" if driver.turns else "travel", "rate", "second")[order], i))
            if driver.turns:
                one, two = (_Joint(self.poses[k], self._errors(k)) for k in driver.links)
                rows.append(_turning(one, two, order) + given)
            else:
                pair = structure.slide(driver.key)
                rows.append((_sliding(self._joint(pair, pair.a), self._joint(pair, pair.b), order) + given) / size)
        return rows + [self._rolling(k, relation, order) for k, relation in enumerate(self.system.group.rolling)]

    def _rolling(self, k: int, relation: RollingRelation, order: int) -> Array:
        structure = self.system.structure
        found = self.rolled[:, k] if order == 0 else np.zeros(1)
        still = _Joint(rest(), _NONE)
        for (kind, name), weight in relation.weights(structure.scene.size).items():
            if kind == "travel":
                pair = structure.slide(name)
                one, two = self._joint(pair, pair.a), self._joint(pair, pair.b)
                off = _sliding(one, two, order)
                told = np.abs((one.pose.z - two.pose.z, one.pose.v - two.pose.v, one.pose.a - two.pose.a)[order])
            else:
                pose = self.poses[name]
                off = _turning(_Joint(pose, self._errors(name)), still, order)
                told = np.abs((np.zeros(1), pose.omega, pose.alpha)[order])
            found = found + abs(weight) * (off + FEW * told)
        return np.asarray(found)

    def _errors(self, name: str) -> Errors:
        """Of a link; a computed direction may be a little longer or shorter than one."""
        found = self.errors.get(name, _NONE)
        return replace(found, angle=found.angle + np.abs(np.abs(self.poses[name].u) - 1))

    def _joint(self, pair: Pair, name: str) -> _Joint:
        own = self.known.get((id(pair), name))
        if own is None:
            own = self.known[id(pair), name] = self._alone(pair, name)
        e = self.errors.get(name)
        if e is None:
            return own
        p, far, (pose, off) = self.poses[name], abs(joint_place(self.system.structure, pair, name)[0]), own
        spin, bend = np.abs(p.omega), np.abs(p.alpha) + p.omega**2
        turn = far * e.angle
        return _Joint(
            pose,
            Errors(
                e.position + turn + off.position,
                e.velocity + far * e.omega + spin * turn + off.velocity,
                e.acceleration + far * (e.alpha + (2 * spin + e.omega) * e.omega) + bend * turn + off.acceleration,
                e.angle + off.angle,
                e.omega,
                e.alpha,
            ),
        )

    def _alone(self, pair: Pair, name: str) -> _Joint:
        """A joint of a link of which nothing is off but what is written and rounded."""
        place, direction = joint_place(self.system.structure, pair, name)
        p, far = self.poses[name], abs(place)
        written, turned = 0.0, 0.0
        if pair.turns:
            written = self.given(("error", "point", name, pair.point))
        elif name == pair.b:
            written = self.given(("error", "through", pair.key))
            turned = self.given(("error", "direction", pair.key))
        else:
            turned = self.given(("error", "turn", pair.key))
        spin, bend = np.abs(p.omega), np.abs(p.alpha) + p.omega**2
        angle = np.abs(np.abs(p.u) - 1)  # a computed direction may be a little longer or shorter than one
        off = far * (angle + FEW) + 1.5 * written
        return _Joint(
            p.fixed(place, direction),
            Errors(
                off + UNIT * np.abs(p.z),
                spin * off + UNIT * np.abs(p.v),
                bend * off + UNIT * np.abs(p.a),
                angle + (1.5 * turned + FEW if direction != 1 else 0.0),
                np.zeros(1),
                np.zeros(1),
            ),
        )


def _turning(one: _Joint, two: _Joint, order: int) -> Array:
    """Of the angle between two joints, or its rates."""
    both = one.error.of_turning[order] + two.error.of_turning[order]
    if order == 0:
        return np.asarray(both + FEW)
    a, b = ((j.pose.omega, j.pose.alpha)[order - 1] for j in (one, two))
    return np.asarray(both + UNIT * (np.abs(a) + np.abs(b)))


def _sliding(one: _Joint, two: _Joint, order: int) -> Array:
    """Of a joint's place in the axes of another, or its rates there."""
    (p, e), (q, f) = (one.pose, one.error), (two.pose, two.error)
    gap, slip = np.abs(p.z - q.z), np.abs(p.v - q.v)
    near, quick = e.position + f.position, e.velocity + f.velocity
    spin, bend = np.abs(q.omega), np.abs(q.alpha) + q.omega**2
    far = np.abs(p.z) + np.abs(q.z)
    if order == 0:
        return np.asarray(gap * f.angle + near + FEW * far)
    fast = np.abs(p.v) + np.abs(q.v)
    if order == 1:
        turned = (slip + spin * gap) * f.angle + (gap + near) * f.omega
        return np.asarray(turned + quick + spin * near + FEW * (fast + spin * far))
    pushed = np.abs(p.a - q.a) + 2 * spin * slip + bend * gap
    turned = pushed * f.angle + 2 * (slip + quick) * f.omega + (gap + near) * (f.alpha + (2 * spin + f.omega) * f.omega)
    rounded = FEW * (np.abs(p.a) + np.abs(q.a) + 2 * spin * fast + bend * far)
    return np.asarray(turned + e.acceleration + f.acceleration + 2 * spin * quick + bend * near + rounded)
