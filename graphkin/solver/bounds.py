"""How far rounding and the numbers of the file may have moved each link: by the constraints of all links together.

With J the derivative of the constraints by places and turns, an error of place is J^-1 times what the constraints may
be off, term by term: what is left of them at the place found, the rounding in telling that, and the errors of the
numbers that are given (Higham, Accuracy and Stability of Numerical Algorithms, ch. 1: forward error is condition times
backward error).  Errors of the rates are those products derived by the time, with the rates of J along the motion.
They are made when they are asked for: a motion is found without them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphkin.scene.cams import LawCam
from graphkin.solver.cams import follower_inputs, greatest_jerk
from graphkin.solver.decimals import conversion_error, meant, meant_angle
from graphkin.solver.larger_groups import Ends, Layout, System, led_relation
from graphkin.solver.linear_blocks import solve_all
from graphkin.solver.pose import GIVEN, UNIT, Array, Drive, ErrorBound, Pose
from graphkin.structure import Structure

__all__ = ["LOOKED_UP", "Accuracy", "error_bounds", "most_of", "roughness"]

FEW = 4
"""The roundings of a sum of products."""
FEW_ROUNDINGS = 8
"""Roundings in a result that is itself exact but for the last place."""
LOOKED_UP = 4 * GIVEN
"""Relative error of what the law of a cam gives."""
SLACK = 1.001
"""For the rounding of the bounds themselves."""
SAFE = 2.0
"""The changes of the matrix are taken this much greater: an error is told to first order of them."""
FLAT = 1e-6
"""Changes of the matrix, relatively, that the slack takes."""
BLOCK = 4096
"""Positions whose constraints are looked at together."""
LEAST = 1e-30
"""Stands for an error of place (of the size, rad) that is none."""
VAST = 1e100
"""Stands for an entry of an inverse that is not known."""
_BINOMIAL = ((1,), (1, 1), (1, 2, 1))
Errors = ErrorBound[Array]


def error_bounds(
    structure: Structure, poses: Mapping[str, Pose], drive: Drive, slack: Array, refined: Array,
    value_error: Array | None = None,
) -> dict[str, Errors]:  # fmt: skip
    """Bounds of the errors of each moving link: the most of any point of it, coincident points under what slides on it
    too, and of its turning; fields of shape (n,), infinite where nothing is known.

    Parameters
    ----------
    poses : of all links, with their rates, as they were found
    drive : of the drivers, shape (n, drivers)
    slack : how far the value of each cam's lift and of each relation of what rolls may be off, in the order of the
        elements, shape (n, relations) (rad, m; of larger groups no unit)
    refined : positions that were computed in 50 digits, shape (n,)
    value_error : how far the values of the drivers may be off, shape (n, drivers); None for what conversion and
        rounding leave
    """
    drive = drive.followed(structure)
    system, n = System.whole(structure, drive), len(drive)
    names, size = system.group.members, structure.scene.size
    with np.errstate(all="ignore"):
        all_ = system.of(poses)
        cams = _Cams(system, all_)
        matrix = cams.onto(system.matrix(all_))
        inverse = solve_all(matrix, np.broadcast_to(np.eye(matrix.shape[1]), matrix.shape))
        inverse = np.where(_reached(structure, system.layout), inverse, 0.0)
        sizes = _sizes(system, cams, all_, matrix, inverse)
        residuals = np.abs(cams.without(system.constraints(all_)))
        residuals[:, refined] = 0.0
        given = _driver_errors(structure, drive, refined, value_error)
        rows = residuals + _row_errors(system, all_, refined, given) + cams.errors(slack)
        found: list[Array] = []
        for order in range(3):
            terms = [w * np.einsum("nij,nj->ni", sizes[k], rows[order - k]) for k, w in enumerate(_BINOMIAL[order])]
            error = np.sum(terms, axis=0)
            if order == 0:
                wild, grown = _growth(sizes[0], _changes(system, all_, error), error)
                grown *= _hanging(structure, names)
            # each order has the inverse twice more
            for _ in range(2 * order + 1 if wild.any() else 0):
                error[wild] = np.einsum("nij,nj->ni", grown, error[wild])
            error = error.reshape(n, -1, 3)
            found += [size * np.hypot(error[..., 0], error[..., 1]), error[..., 2]]
        few = FEW_ROUNDINGS * UNIT * refined[:, None]
        wide = _largest(all_, len(names), size)
        own = ErrorBound(*(found[i] + few * w for i, w in zip((0, 2, 4, 1, 3, 5), wide, strict=True)))
        bounds = [_sure(bound).T for bound in _of_points(system, all_, own)]
        return {name: ErrorBound(*rows) for name, *rows in zip(names, *bounds, strict=True)}


@dataclass(frozen=True)
class Accuracy:
    """What was found at n positions, from which its errors are told when they are asked for.

    structure, poses, drive, slack, refined : as for ``error_bounds``
    clear : positions at which it is known beforehand that all errors are slight, shape (n,)
    ok : positions that stand, shape (n,); bounds elsewhere are NaN
    """

    structure: Structure
    poses: Mapping[str, Pose]
    drive: Drive
    slack: Array
    refined: Array
    clear: Array
    ok: Array

    def rows(self, rows: slice | Array) -> Accuracy:
        """Of some of the positions."""
        poses = {name: self.poses[name].rows(rows) for name in self.structure.links}
        columns = (x[rows] for x in (self.slack, self.refined, self.clear, self.ok))
        return Accuracy(self.structure, poses, self.drive[rows], *columns)

    @cached_property
    def links(self) -> Mapping[str, Errors]:
        """Of each moving link that is not redundant."""
        return self._of_links(self.refined)

    @cached_property
    def drawn(self) -> Mapping[str, Errors]:
        """The same if all were computed in 16 digits throughout, as a drawing is."""
        return self._of_links(np.zeros_like(self.refined)) if self.refined.any() else self.links

    def of(self, links: Iterable[str], drawn: bool = False) -> Errors:
        """The most of some links, of all if there are none but the frame."""
        known = self.drawn if drawn else self.links
        held = [known[name] for name in links if name in known] or [*known.values()]
        return most_of(held) if held else ErrorBound(*(np.where(self.ok, 0.0, np.nan),) * 6)

    def _of_links(self, refined: Array) -> dict[str, Errors]:
        names = [name for name in self.structure.links if name != self.structure.scene.frame.name]
        found = {name: np.full((6, len(self.ok)), np.nan) for name in names}
        places = np.flatnonzero(self.ok)
        for rows in (places[first : first + BLOCK] for first in range(0, len(places) if names else 0, BLOCK)):
            poses = {name: self.poses[name].rows(rows) for name in self.structure.links}
            some = error_bounds(self.structure, poses, self.drive[rows], self.slack[rows], refined[rows])
            for name, bound in some.items():
                found[name][:, rows] = [*bound]
        return {name: ErrorBound(*rows) for name, rows in found.items()}


def most_of(bounds: Iterable[Errors]) -> Errors:
    """The most of several links."""
    return ErrorBound(*(np.maximum.reduce(np.broadcast_arrays(*column)) for column in zip(*bounds, strict=True)))


def roughness(structure: Structure, poses: Mapping[str, Pose], bound: Errors) -> Array:
    """A bound of velocities and accelerations beside the greatest there are, for points as far off as the mechanism is
    large, shape (n,)."""
    size, n = structure.scene.size, len(bound.velocity)
    fields = [p.spread(n) for name, p in poses.items() if name != structure.scene.frame.name]
    speed = np.max([np.abs(p.v) + size * np.abs(p.omega) for p in fields], axis=0)
    push = np.max([np.abs(p.a) + size * (np.abs(p.alpha) + p.omega**2) for p in fields], axis=0)
    velocity, acceleration = bound.velocity + size * bound.omega, bound.acceleration + size * bound.alpha
    with np.errstate(all="ignore"):
        parts = velocity / np.maximum(speed, 1e-300), acceleration / np.maximum(push, 1e-300)
        return np.asarray(np.maximum(*parts))


def _sure(bound: Array) -> Array:
    """A bound, infinite where it is not known."""
    return np.where(bound < VAST**0.5, bound * SLACK, np.inf)


def _largest(all_: Pose, count: int, size: float) -> tuple[Array | float, ...]:
    """Of the links: place, velocity and acceleration, for points as far off as the mechanism is large; of a direction
    1, and its rates."""
    z, v, a, omega, alpha = (np.abs(x[:, :count]) for x in (all_.z, all_.v, all_.a, all_.omega, all_.alpha))
    points = z + size, v + size * omega, a + size * (alpha + omega**2)
    place, speed, push, spin, turning = (x.max(axis=1, keepdims=True) for x in (*points, omega, alpha))
    return place, speed, push, 1.0, spin, turning


class _Cams:
    """The followers of cams and what rolls among the constraints of all links.

    A follower's row of the matrix has the slope of the lift at the turning of its cam.
    """

    def __init__(self, system: System, all_: Pose) -> None:
        layout, n = system.layout, len(system.drive)
        self.layout = layout
        relations = system.group.rolling
        self.scale = np.ones(len(relations))
        rows, columns, lifts = [], [], []
        for element in (e for e in system.structure.driven if not e.drivers):
            own, lead = led_relation(element), element.driver
            k = relations.index(own)
            self.scale[k] = next(iter(own.weights(layout.size).values()))
            if isinstance(lead, LawCam):
                cam = layout.link[lead.link]
                inputs, jerk = follower_inputs(lead, all_.u[:, cam]), greatest_jerk(lead.law)
                lifts.append(self.scale[k] * np.stack([inputs["slope"], inputs["bend"], np.full(n, jerk)]))
                rows.append(int(layout.rolling_rows[k]))
                columns.append(cam)
        self.rows, self.columns = np.array(rows, dtype=int), np.array(columns, dtype=int)
        every: Array = np.stack(lifts, axis=-1) if lifts else np.zeros((3, n, 0))
        slope, bend, jerk = every
        omega, alpha = all_.omega[:, self.columns], all_.alpha[:, self.columns]
        # the entries of the matrix, and their rates
        self.entries = slope, bend * omega, np.abs(jerk) * omega**2 + np.abs(bend * alpha)
        # rates of the lift
        self.rates = slope * omega, bend * omega**2 + slope * alpha

    def onto(self, matrix: Array, t: Array | None = None) -> Array:
        """The matrix with the slopes of the lifts, as they are, or at a time from here, shape (n, 1) (s)."""
        slope, first, second = self.entries
        matrix[:, self.rows, 3 * self.columns + 2] -= slope if t is None else slope + t * first + t * t / 2 * second
        return matrix

    def without(self, constraints: Array) -> Array:
        """The constraints and their rates, less what the lifts have done."""
        for order, rate in enumerate(self.rates, start=1):
            constraints[order][:, self.rows] -= rate
        return constraints

    def errors(self, slack: Array) -> Array:
        """How far lifts and relations may be off with their rates, shape (3, n, rows)."""
        found = np.zeros((3, len(slack), self.layout.rows))
        found[0][:, self.layout.rolling_rows] = slack * self.scale
        for order, rate in enumerate(self.rates, start=1):
            found[order][:, self.rows] += LOOKED_UP * np.abs(rate)
        found[2][:, self.rows] += LOOKED_UP * np.abs(self.entries[1] * self.rates[0])
        return found


def _sizes(system: System, cams: _Cams, all_: Pose, here: Array, inverse: Array) -> tuple[Array, Array, Array]:
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
        return cams.onto(system.matrix(replace(p, z=p.z + t * p.v + half * p.a, u=p.u * turn)), t)

    wide = step[:, None, None]
    ahead, behind = at(step[:, None]), at(-step[:, None])
    first, second = (ahead - behind) / (2 * wide), (ahead - 2 * here + behind) / wide**2
    bent = inverse @ first @ inverse
    rates = inverse, bent, 2 * bent @ first @ inverse - inverse @ second @ inverse
    one, two, three = (np.nan_to_num(np.abs(x), nan=VAST, posinf=VAST) for x in rates)
    return one, two, three


def _before(structure: Structure) -> Mapping[str, frozenset[str]]:
    """For each link those that it hangs on, with itself, those of its group and the frame: beside a dead point of one
    group the links before it are as certain as ever.  What rolls may pass by links that come later."""
    if "before" not in structure.kept:
        frame = structure.scene.frame.name
        found = {frame: frozenset((frame,))}
        for element in structure.elements:
            ends = {*element.members, *(link for end in element.outside for link in found.get(end, ()))}
            found |= dict.fromkeys(element.members, frozenset(ends))
        structure.kept["before"] = found
    before: Mapping[str, frozenset[str]] = structure.kept["before"]
    return before


def _reached(structure: Structure, layout: Layout) -> Array:
    """Which entries of the inverse are not zero by what hangs on what: a link is moved by the constraints between those
    that it hangs on alone, shape (columns, rows)."""
    if "reached" not in structure.kept:
        before, names = _before(structure), layout.names[: layout.members]
        taking = (layout.same != 0).reshape(layout.rows, -1, 3).any(axis=2)
        for _, row, column, _ in (*layout.turn_entries, *layout.line_entries):
            taking[row, column // 3] = True
        for _, row, column, _ in layout.turn_entries:
            taking[row + 1, column // 3] = True
        away = np.array([[other not in before[name] for other in names] for name in names])
        structure.kept["reached"] = np.repeat(~(away.astype(int) @ taking.T.astype(int)).astype(bool), 3, axis=0)
    reached: Array = structure.kept["reached"]
    return reached


def _hanging(structure: Structure, names: Sequence[str]) -> Array:
    """Which coordinates of links may pass on an error to which, 1 or 0, shape (columns, columns)."""
    before = _before(structure)
    links = np.array([[float(other in before[name]) for other in names] for name in names])
    return np.repeat(np.repeat(links, 3, axis=0), 3, axis=1)


def _changes(system: System, all_: Pose, error: Array) -> Array:
    """By how much each entry of the matrix may change within the error of place, shape (n, rows, columns)."""
    layout = system.layout
    spread = np.zeros((len(error), len(layout.names), 3))
    spread[:, : layout.members] = error.reshape(len(error), -1, 3)
    turn, moved = spread[:, :, 2], np.hypot(spread[:, :, 0], spread[:, :, 1])
    found = np.zeros((len(error), layout.rows, 3 * layout.members))
    for ends, (joint, row, column, _) in zip(layout.turns, layout.turn_entries, strict=True):
        swept = np.abs(ends.place[joint]) / layout.size * turn[:, ends.link[joint]]
        found[:, row, column + 2] = found[:, row + 1, column + 2] = swept
    if len(layout.line_rows):
        (one, two), at = layout.lines, layout.lines[0].of(all_, 0).z
        turned, arm = turn[:, two.link], np.abs(one.place) / layout.size
        swept = arm * turn[:, one.link]
        off = swept, swept + moved[:, one.link] + moved[:, two.link]
        for ends, own, (joint, row, column, _) in zip(layout.lines, off, layout.line_entries, strict=True):
            part, far = np.abs(layout.part[joint]), np.abs(at[:, joint] - all_.z[:, ends.link[joint]]) / layout.size
            found[:, row, column] = found[:, row, column + 1] = part * turned[:, joint]
            found[:, row, column + 2] += part * (far * turned[:, joint] + own[:, joint])
    return found


def _growth(inverse: Array, changes: Array, error: Array) -> tuple[Array, Array]:
    """Positions at which changes of the matrix may matter, shape (n,), and for these by how much they make each error
    greater: with C the product of both sizes it is (1 - C)^-1, and nothing is known where that is not positive (Varga,
    Matrix Iterative Analysis, theorem 3.8).

    It is solved in parts of the errors of place: along a chain they grow by many powers of ten, and rounding in the
    large ones would reach the small.
    """
    product = SAFE * (inverse @ changes)
    wild = ~(product.sum(axis=2).max(axis=1) < FLAT)
    scale = np.maximum(error[wild], LEAST)
    ratio = scale[:, :, None] / scale[:, None, :]
    parts, unit = product[wild] / ratio, np.eye(product.shape[1])
    grown = solve_all(unit - parts, np.broadcast_to(unit, parts.shape))
    unknown = ~(grown.min(axis=2) > -FLAT)
    grown = np.maximum(grown, unit + parts) * ratio  # the first terms of its series, should rounding leave less
    grown[unknown] = VAST
    return wild, grown


def _of_points(system: System, all_: Pose, error: Errors) -> Errors:
    """The most of any point of each link, and of its turning, fields of shape (n, links)."""
    structure, layout = system.structure, system.layout
    names, count = layout.names[: layout.members], layout.members
    reach = [max(map(abs, structure.links[name].points.values()), default=0.0) for name in names]
    r = np.broadcast_to(np.array(reach), (len(error.angle), count)).copy()
    for slide in structure.slides:
        a, b = (layout.link[name] for name in slide.links)
        if b < count:
            r[:, b] = np.maximum(r[:, b], np.abs(all_.z[:, a] - all_.z[:, b]))
    z, v, a_, omega, alpha = (np.abs(x[:, :count]) for x in (all_.z, all_.v, all_.a, all_.omega, all_.alpha))
    return error.within(r, (z, v, a_), omega, alpha + omega**2, FEW * UNIT)


# what the constraints may be off by themselves


def _driver_errors(structure: Structure, drive: Drive, refined: Array, value_error: Array | None) -> list[Array]:
    """How far values, rates and second rates of the drivers may be off, shape (n, drivers) each (rad, m)."""
    turns = np.array([d.turns for d in structure.drivers], dtype=bool)
    value = np.abs(drive.value)
    found = [np.where(turns, GIVEN / 2 * value + UNIT, GIVEN * value) if value_error is None else value_error.copy()]
    found += [GIVEN * np.abs(drive.rate), GIVEN * np.abs(drive.second)]
    for k in np.flatnonzero(refined):
        for j, driver in enumerate(structure.drivers):
            own = float(drive.value[k, j])
            dead = driver.dead_point and driver.dead_point.exact and own == driver.values[0]
            known = dead or (meant_angle if driver.turns else meant)(own)[1]
            found[0][k, j] = 0.0 if known else GIVEN * abs(own)
            for error, rate in ((found[1], drive.rate[k, j]), (found[2], drive.second[k, j])):
                error[k, j] = 0.0 if meant(float(rate))[1] else GIVEN * abs(rate)
    return found


def _written(structure: Structure, layout: Layout) -> Sequence[Array]:
    """How far the numbers of the file may be off in each joint, by place and by direction on either side of turning
    pairs and of guides; each of shape (2, joints): in 16 digits, and in 50."""
    def errors(numbers: Iterable[tuple[complex, bool]]) -> Array:
        return np.array([conversion_error(*number) for number in numbers]).reshape(-1, 2).T

    key = "written", layout.names, tuple(layout.line_pairs)
    if key not in structure.kept:
        turns, lines, links = layout.turn_pairs, layout.line_pairs, structure.links
        structure.kept[key] = (
            errors((links[p.a].points[p.point], False) for p in turns),
            errors((links[p.b].points[p.point], False) for p in turns),
            errors((s.turn, True) for s in lines),
            errors((s.guide.through, False) for s in lines),
            errors((s.guide.direction, True) for s in lines),
        )
    written: Sequence[Array] = structure.kept[key]
    return written


def _row_errors(system: System, all_: Pose, refined: Array, given: Sequence[Array]) -> Array:
    """How far constraints and their rates may be off with the links just where they were found: (3, n, rows)."""
    layout, size = system.layout, system.layout.size
    unit = np.where(refined, 0.0, UNIT)[:, None]
    which, lean = refined.astype(int), np.abs(np.abs(all_.u) - 1) * (unit > 0)
    found = np.zeros((3, len(refined), layout.rows))
    place_a, place_b, turned, through, directed = (x[:, :0] if not x.size else x for x in
                                                   _written(system.structure, layout))  # fmt: skip
    if len(layout.turn_rows):
        ends = [(e, e.of(all_, 2), w[which], None) for e, w in zip(layout.turns, (place_a, place_b), strict=True)]
        one, two = (_joint(e, frame, lean, unit, written, turn) for e, frame, written, turn in ends)
        for order in range(3):
            gap = (one[order] + two[order]) / size
            found[order][:, layout.turn_rows] = found[order][:, layout.turn_rows + 1] = gap
    if len(layout.line_rows):
        (a, b), none = layout.lines, np.zeros(1)
        p, q = a.of(all_, 2), b.of(all_, 2)
        one = _joint(a, p, lean, unit, none, turned[which])
        two = _joint(b, q, lean, unit, through[which], directed[which])
        for order, off in enumerate(_sliding(p, q, one, two, FEW * unit)):
            np.add.at(found[order].T, layout.line_rows, (off * np.abs(layout.part) / size).T)
        pairs = slice(layout.slides)
        found[0][:, layout.slide_rows] = (one[3] + two[3] + FEW * unit)[:, pairs]
        for order, (x, y) in enumerate(((p.omega, q.omega), (p.alpha, q.alpha)), start=1):
            found[order][:, layout.slide_rows] = unit * (np.abs(x) + np.abs(y))[:, pairs]
        for order in range(3):
            for row, _, i in layout.travels:
                found[order][:, row] += given[order][:, i] / size
    rates = np.abs(all_.omega), np.abs(all_.alpha)
    if len(layout.angle_rows):
        (link, base), drivers = layout.turned, layout.angle_drivers
        found[0][:, layout.angle_rows] = lean[:, link] + lean[:, base] + FEW * unit + given[0][:, drivers]
        for order, rate in enumerate(rates, start=1):
            found[order][:, layout.angle_rows] = unit * (rate[:, link] + rate[:, base]) + given[order][:, drivers]
    weights = np.abs(layout.rolled).T
    found[0][:, layout.rolling_rows] += (lean + FEW * unit) @ weights
    for order, rate in enumerate(rates, start=1):
        found[order][:, layout.rolling_rows] += (FEW + 1) * unit * (rate @ weights)
    return found


_Joint = tuple[Array, Array, Array, Array]
"""How far the joints of links that are just where they were found may be off, shape (n, joints): place, velocity,
acceleration, direction."""


def _joint(ends: Ends, frame: Pose, lean: Array, unit: Array, written: Array, turned: Array | None) -> _Joint:
    """Of frames on their links: by what is written, by rounding, by directions that are not just of length 1."""
    own = lean[:, ends.link]
    off = np.abs(ends.place) * (own + FEW * unit) + 1.5 * written
    spin, bend = np.abs(frame.omega), np.abs(frame.alpha) + frame.omega**2
    turn = own if turned is None else own + 1.5 * turned + np.where(ends.direction == 1, 0.0, FEW * unit)
    place, fast, pushed = (unit * np.abs(x) for x in (frame.z, frame.v, frame.a))
    return off + place, spin * off + fast, bend * off + pushed, turn


def _sliding(p: Pose, q: Pose, one: _Joint, two: _Joint, few: Array) -> tuple[Array, Array, Array]:
    """Of joints' places in the axes of others, and their rates there."""
    gap, slip = np.abs(p.z - q.z), np.abs(p.v - q.v)
    near, quick, turn = one[0] + two[0], one[1] + two[1], two[3]
    spin, bend = np.abs(q.omega), np.abs(q.alpha) + q.omega**2
    far, fast = np.abs(p.z) + np.abs(q.z), np.abs(p.v) + np.abs(q.v)
    pushed = np.abs(p.a - q.a) + 2 * spin * slip + bend * gap
    return (
        gap * turn + near + few * far,
        (slip + spin * gap) * turn + quick + spin * near + few * (fast + spin * far),
        pushed * turn + one[2] + two[2] + 2 * spin * quick + bend * near
        + few * (np.abs(p.a) + np.abs(q.a) + 2 * spin * fast + bend * far),
    )  # fmt: skip
