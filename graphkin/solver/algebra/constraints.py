"""The constraints of links at many positions at once: their residuals, their derivative, and their rates.

Unknown are place and angle of each link, with lengths counted in the size of the mechanism, so that columns weigh alike
(Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, ch. 3).  There are two kinds of rows:

- a line: the vector from a place of one link to a place of another, along an axis that turns with a third.  A turning
  pair has two in the axes of the frame, a sliding pair one across its guide, a driven slide one along it;
- a turn: a sum of the angles of links with weights, of a sliding pair and an angle driver of two links.

Rolling adds both kinds.  Every part of a row is a product of complex numbers, so that one rule for products gives all
rates, also of the derivative.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

import numpy as np

from graphkin.scene.pairs import Pair
from graphkin.solver.algebra.pose import Array, Drive, Pose, rest, together, turned
from graphkin.structure import Driven, LargerGroup, RollingRelation, Structure, kept_with
from graphkin.structure.model import Coordinate

Jet = list[Array]
"""A quantity and its rates, as many as are asked for."""
NOTHING = np.zeros(1)


def solve_all(matrix: Array, right: Array) -> Array:
    """Solve a stack of linear systems; a singular one gives NaN instead of an error for all.

    matrix, right : shape (n, k, k), and (n, k) or (n, k, columns)
    """
    if right.ndim == 2:
        return solve_all(matrix, right[..., None])[..., 0]
    try:
        return np.linalg.solve(matrix, right)
    except np.linalg.LinAlgError:
        with np.errstate(invalid="ignore"):
            regular = np.linalg.slogdet(matrix)[0] != 0.0
        solution = np.full_like(right, np.nan)
        solution[regular] = np.linalg.solve(matrix[regular], right[regular])
        return solution


def product(f: Jet, g: Jet) -> Jet:
    """The product of two quantities with its rates (Leibniz)."""
    jet = [f[0] * g[0]]
    if len(f) > 1:
        jet.append(f[0] * g[1] + f[1] * g[0])
    if len(f) > 2:
        jet.append(f[0] * g[2] + 2.0 * (f[1] * g[1]) + f[2] * g[0])
    return jet


class Parts(NamedTuple):
    """The parts of the lines, each with its rates: for both links of each joint the ``arm`` from the link's origin and
    the ``place`` of its end, shape (n, 2, joints); the ``gap`` from the second place to the first, shape (n, joints);
    the ``axis`` of each line, conjugate, shape (n, lines)."""

    arm: Jet
    place: Jet
    gap: Jet
    axis: Jet


class Sums:
    """The assignment of many numbers to the entries to which they add up.

    entry : for each number its entry, below 0 for none
    """

    def __init__(self, entry: Sequence[int] | Array) -> None:
        entry = np.asarray(entry, dtype=int)
        order = np.argsort(entry, kind="stable")
        self.order = order[entry[order] >= 0]
        self.entries, self.starts = np.unique(entry[self.order], return_index=True)

    def of(self, numbers: Array) -> Array:
        """The sums, in the order of ``entries``; numbers of shape (n, numbers)."""
        sorted_ = numbers[:, self.order]
        if len(self.starts) == len(self.order):
            return sorted_
        return np.add.reduceat(sorted_, self.starts, axis=1)


class Layout:
    """The layout of a group's constraints: the rows of its pairs, of its drivers, of its rolling relations.

    names, members : the links, those of the group first, then those on which it depends; the number of the group's
        links
    joints : the columns of the two links of each, shape (2, joints), and ``places`` in their axes (m)
    joint, axis, along : of each line its joint, the link with which its axis turns, and the direction of the axis in
        that link, conjugate
    one, two, aim : of each turn its two links and the direction that the first has in the axes of the second, conjugate
    rolled : the weight of the turning of each link in each rolling relation, shape (relations, links)
    driven, drivers, scales : the rows of drivers, the drivers, and the factors of their value, rate and second rate
    """

    def __init__(self, structure: Structure, group: LargerGroup) -> None:
        frame = structure.scene.frame.name
        used = [name for pair in group.pairs for name in pair.links]
        used += [name for driver in group.drivers if driver.turns for name in (driver.link, driver.relative_to)]
        used += [name for relation in group.rolling for name in relation.links]
        self.names = (*group.members, *dict.fromkeys(n for n in (*used, frame) if n not in group.members))
        self.link = {name: k for k, name in enumerate(self.names)}
        self.members, self.size = len(group.members), structure.scene.size
        lines: list[tuple[int, Pair, complex]] = []
        turns: list[tuple[int, str, str, complex, Pair | None]] = []
        given: list[tuple[int, int, float, float]] = []
        row = 0
        for pair in group.pairs:
            if pair.turns:
                lines += [(row, pair, 1 + 0j), (row + 1, pair, -1j)]
            else:
                turns.append((row, pair.a, pair.b, (pair.guide.direction * pair.turn).conjugate(), pair))
                lines.append((row + 1, pair, -1j))
            row += 2
        self.angle_drivers = np.array([structure.drivers.index(d) for d in group.drivers if d.turns], dtype=int)
        self.by_driver = slice(len(turns), len(turns) + len(self.angle_drivers))
        """The turns that drivers give."""
        for driver in group.drivers:
            if driver.turns:
                turns.append((row, driver.link, driver.relative_to, 1 + 0j, None))
            else:
                lines.append((row, structure.slide(driver.key), 1 + 0j))
            scales = (0.0, 1.0) if driver.turns else (1.0 / self.size,) * 2  # the angle itself stands in the turn
            given.append((row, structure.drivers.index(driver), *scales))
            row += 1
        weights = [relation.weights(self.size) for relation in group.rolling]
        self.rolling_rows = np.arange(row, row + len(weights))
        self.rolled = np.zeros((len(weights), len(self.names)))
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
        self.rows = row + len(weights)
        self._set_lines(structure, lines)
        self.line_rows = Sums([r for r, *_ in lines])
        self.turn_rows = np.array([r for r, *_ in turns], dtype=int)
        self.one: Array = np.array([self.link[name] for _, name, *_ in turns], dtype=int)
        self.two: Array = np.array([self.link[name] for _, _, name, *_ in turns], dtype=int)
        self.aim = np.array([aim for *_, aim, _ in turns], dtype=complex)
        self.turn_pairs = [pair for *_, pair in turns]
        self.driven, self.drivers = (np.array([x[k] for x in given], dtype=int) for k in (0, 1))
        self.scales = [np.array([x[k] for x in given]) for k in (2, 3, 3)]
        self.constant = np.zeros((self.rows, 3 * self.members))
        """The entries of the matrix that are the same at all positions: those of turns."""
        self.constant[self.rolling_rows, 2::3] = self.rolled[:, : self.members]
        for links, sign in ((self.one, 1.0), (self.two, -1.0)):
            moving = links < self.members
            self.constant[self.turn_rows[moving], 3 * links[moving] + 2] += sign

    def _set_lines(self, structure: Structure, lines: Sequence[tuple[int, Pair, complex]]) -> None:
        """The joints of lines, and the entries of the matrix that lines make."""
        frame, links = self.link[structure.scene.frame.name], structure.links
        pairs = [*{(pair.key, pair.a, pair.b): pair for _, pair, _ in lines}.values()]
        where = {(pair.key, pair.a, pair.b): k for k, pair in enumerate(pairs)}
        self.joints = np.array([[self.link[p.a] for p in pairs], [self.link[p.b] for p in pairs]], dtype=int)
        self.places = np.array([
            [links[p.a].points[p.point] if p.turns else 0j for p in pairs],
            [links[p.b].points[p.point] if p.turns else p.guide.through for p in pairs],
        ], dtype=complex)
        self.line_pairs = [pair for _, pair, _ in lines]
        self.joint = np.array([where[pair.key, pair.a, pair.b] for pair in self.line_pairs], dtype=int)
        self.axis = np.array([frame if pair.turns else self.link[pair.b] for pair in self.line_pairs], dtype=int)
        self.along = np.array([part if pair.turns else part * pair.guide.direction.conjugate()
                               for _, pair, part in lines], dtype=complex)
        a, b = self.joints[:, self.joint]
        columns = [3 * a, 3 * a + 1, 3 * b, 3 * b + 1, 3 * a + 2, 3 * b + 2, 3 * self.axis + 2]
        wide, rows = 3 * self.members, np.array([row for row, *_ in lines], dtype=int)
        self.entries = Sums(np.concatenate([np.where(column < wide, rows * wide + column, -1) for column in columns]))
        """Of both ends of a line the columns x and y, of both and of its axis the angle."""


def led_relation(element: Driven) -> RollingRelation:
    """The relation of a link to the links on which it rolls; of a cam's follower its own part."""
    pair, rolled = element.pair, element.rolled
    led: Coordinate = ("angle", element.link) if pair.turns else ("travel", pair.key)
    factors = rolled.factors if rolled else ()
    terms = {led: Fraction(1), **{coordinate: Fraction(-factor) for coordinate, factor in factors}}
    return RollingRelation(f"{element.link} led", terms, rolled.links if rolled else (element.link, *pair.links))


@kept_with
def _all_together(structure: Structure) -> LargerGroup:
    """All links as a group; for a cam's follower its own part alone."""
    pairs: list[Pair] = []
    rolling: list[RollingRelation] = []
    for e in structure.elements:
        pairs += e.all_pairs
        rolling += [led_relation(e)] if isinstance(e, Driven) and not e.drivers else e.rolling
    members = tuple(name for name in structure.links if name != structure.scene.frame.name)
    return LargerGroup(members, tuple(pairs), structure.drivers, members, 0, rolling=tuple(rolling))


@dataclass(frozen=True, eq=False, repr=False)
class Constraints:
    """The constraints of a group at n positions of the links on which it depends, or at one position for n places.

    The links together are one ``Pose``, its fields of shape (n, links): the group's own first, then the others.

    near : angles of all links to half a turn, whole turns included, shape (n, links) (rad); None without rolling
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
        """The layout; it is made once and kept with the structure."""
        group, drivers = self.group, self.structure.drivers
        pairs, rolling = tuple(pair.key for pair in group.pairs), tuple(relation.name for relation in group.rolling)
        key = "layout", group.members, pairs, tuple(map(drivers.index, group.drivers)), rolling
        if key not in self.structure.kept:
            self.structure.kept[key] = Layout(self.structure, group)
        layout: Layout = self.structure.kept[key]
        return layout

    @cached_property
    def _outside(self) -> Pose:
        """The links on which the group depends."""
        names = self.layout.names[self.layout.members :]
        return together([self.known[name] for name in names], len(self.drive))

    @classmethod
    def whole(cls, structure: Structure, drive: Drive) -> Constraints:
        """The constraints of all links together; for a cam's follower its own part alone."""
        return cls(structure, _all_together(structure), {structure.scene.frame.name: rest()}, drive)

    def part(self, which: Array) -> Constraints:
        """The constraints at some of the positions."""
        def some(column: Array) -> Array:
            return column[which] if len(column) > 1 else column

        known = {name: pose.each(some) for name, pose in self.known.items()}
        near, kept = (None if rows is None else rows[which] for rows in (self.near, self.kept))
        return Constraints(self.structure, self.group, known, self.drive[which], near, kept)

    # the links together

    def at(self, place: Array, rate: Array | None = None, second: Array | None = None) -> Pose:
        """All links from the members' places, rates and second rates, each of shape (n, members, 3)."""
        angle, out = place[:, :, 2], self._outside
        u = np.empty((len(place), len(self.layout.names)), dtype=complex)
        z, count = np.empty_like(u), self.layout.members
        z.real[:, :count], z.imag[:, :count] = place[:, :, 0], place[:, :, 1]
        np.cos(angle, out=u.real[:, :count])
        np.sin(angle, out=u.imag[:, :count])
        z[:, count:], u[:, count:] = out.z, out.u
        if rate is None and second is None:
            return Pose(z, u, NOTHING, NOTHING, NOTHING, NOTHING)

        def rates(given: Array | None, linear: Array, turning: Array) -> tuple[Array, Array]:
            given = np.zeros_like(place) if given is None else given
            return (
                np.concatenate((given[:, :, 0] + 1j * given[:, :, 1], linear), axis=1),
                np.concatenate((given[:, :, 2], turning), axis=1),
            )

        return Pose(z, u, *rates(rate, out.v, out.omega), *rates(second, out.a, out.alpha))

    def of(self, members: Mapping[str, Pose]) -> Pose:
        """All links from the members' poses."""
        return together([{**self.known, **members}[name] for name in self.layout.names], len(self.drive))

    def poses(self, place: Array, rate: Array | None = None, second: Array | None = None) -> dict[str, Pose]:
        """Members' poses from places, rates and second rates, each of shape (n, members, 3)."""
        zero = np.zeros_like(place)
        all_ = self.at(place, zero if rate is None else rate, zero if second is None else second)
        def of_link(k: int) -> Pose:
            return all_.each(lambda x: np.ascontiguousarray(x[:, k]))

        return {name: of_link(k) for k, name in enumerate(self.group.members)}

    def scaled(self, step: Array) -> Array:
        """Columns (n, 3 members) back to (n, members, 3) in m and rad."""
        size = self.structure.scene.size
        return np.asarray(step.reshape(len(step), -1, 3) * np.array([size, size, 1.0]))

    def angles(self, u: Array) -> Array:
        """Angles of all links, whole turns included, shape (n, links) (rad)."""
        assert self.near is not None
        return np.asarray(self.near + np.angle(u * np.exp(-1j * self.near)))

    # the rows

    def parts(self, all_: Pose, order: int) -> Parts:
        """The parts of the lines, with rates up to the order."""
        layout, u = self.layout, [all_.u]
        if order:
            u.append(1j * all_.omega * all_.u)
        if order > 1:
            u.append((1j * all_.alpha - all_.omega**2) * all_.u)
        arm = [x[:, layout.joints] * layout.places for x in u]
        place = [z[:, layout.joints] + x for z, x in zip((all_.z, all_.v, all_.a), arm, strict=False)]
        axis = [np.conj(x[:, layout.axis]) * layout.along for x in u]
        return Parts(arm, place, [x[:, 0] - x[:, 1] for x in place], axis)

    def residuals(self, all_: Pose) -> Array:
        """Each constraint, with lengths in the size, shape (n, rows)."""
        return np.asarray(self.constraints(all_, 0)[0])

    def constraints(self, all_: Pose, order: int = 2, parts: Parts | None = None) -> Array:
        """Each constraint and its rates up to the order, with lengths in the size, shape (order + 1, n, rows).

        Parameters
        ----------
        parts : as `parts` gives them, if they are known
        """
        layout, drive = self.layout, self.drive
        *_, gap, axis = parts or self.parts(all_, order)
        residuals = np.zeros((order + 1, len(all_.z), layout.rows))
        for k, offset in enumerate(product(axis, [x[:, layout.joint] for x in gap])):
            residuals[k][:, layout.line_rows.entries] = layout.line_rows.of(offset.real) / layout.size
        turn = all_.u[:, layout.one] * np.conj(all_.u[:, layout.two]) * layout.aim
        turn[:, layout.by_driver] *= np.conj(turned(drive.value[:, layout.angle_drivers]))
        residuals[0][:, layout.turn_rows] = np.angle(turn)
        for k, given in enumerate((drive.value, drive.rate, drive.second)[: order + 1]):
            residuals[k][:, layout.driven] -= given[:, layout.drivers] * layout.scales[k]
        rates = (all_.omega, all_.alpha)[:order]
        for k, rate in enumerate(rates, start=1):
            residuals[k][:, layout.turn_rows] += rate[:, layout.one] - rate[:, layout.two]
        if not len(layout.rolling_rows):
            return residuals
        for k, rate in enumerate(rates, start=1):
            residuals[k][:, layout.rolling_rows] += rate @ layout.rolled.T
        if self.near is None or self.kept is None:
            residuals[0][:, layout.rolling_rows] = 0.0  # the turns are not counted
        else:
            residuals[0][:, layout.rolling_rows] += self.angles(all_.u) @ layout.rolled.T - self.kept
        return residuals

    def matrix(self, all_: Pose) -> Array:
        """Derivative of the constraints by (x / size, y / size, angle) of each member, shape (n, rows, columns)."""
        return self.matrices(self.parts(all_, 0))[0]

    def matrices(self, parts: Parts) -> list[Array]:
        """The matrix with as many rates as the parts have."""
        layout = self.layout
        matrices: list[Array] = []
        # what turns with the first link, with the second, with the axis
        legs = [np.concatenate((-arm[:, :1], arm[:, 1:], gap[:, None]), axis=1)[:, :, layout.joint] / layout.size
                for arm, gap in zip(parts.arm, parts.gap, strict=True)]
        turns = product([axis[:, None] for axis in parts.axis], legs)
        for axis, turn in zip(parts.axis, turns, strict=True):
            matrix = np.zeros((len(axis), *layout.constant.shape))
            matrix += 0.0 if matrices else layout.constant
            x, y = axis.real, axis.imag
            entries = np.concatenate((x, -y, -x, y, turn.imag.reshape(len(axis), -1)), axis=1)
            matrix.reshape(len(axis), -1)[:, layout.entries.entries] += layout.entries.of(entries)
            matrices.append(matrix)
        return matrices
