"""The closure equations of a mechanism in any kind of number: doubles, single precision, complex steps, 50 digits.

Three unknowns a link (the place of its origin and its angle), two equations a pair, one a driver; the general way of
multibody programs (Haug, Computer Aided Kinematics and Dynamics, ch. 3).  It knows neither dyads nor their order, and
so it is the foil to the closed form and the base of its 50-digit reference.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from graphkin.plane import Values
from graphkin.solver import Motion
from graphkin.solver.constraints import solve_all
from graphkin.solver.pose import Array
from graphkin.structure import Driven, Dyad, LargerGroup, Pair, Structure

__all__ = ["DOUBLES", "Arithmetic", "Equations", "Solution", "solve_many"]



@dataclass(frozen=True)
class Arithmetic:
    """What the equations need beyond the four operations: elementwise functions of arrays, and a linear solver.

    ``unturned`` takes whole turns off a difference of angles; ``solve`` solves matrix (m, m, ...) x = right (m, ...).
    """

    cos: Callable[[Array], Array]
    sin: Callable[[Array], Array]
    arg: Callable[[complex], Values]
    unturned: Callable[[Values], Values]
    solve: Callable[[Array, Array], Array]


def solve_many(matrix: Array, right: Array) -> Array:
    """Solve systems side by side: matrix (m, m, n), right (m, n); a singular one gives inf or nan."""
    return np.moveaxis(solve_all(np.moveaxis(matrix, -1, 0), np.moveaxis(right, -1, 0)), 0, -1)


DOUBLES = Arithmetic(
    np.cos, np.sin, cmath.phase, lambda d: d - 2 * math.pi * np.rint(np.real(d) / (2 * math.pi)), solve_many
)


@dataclass(frozen=True)
class Solution:
    """Unknowns and their two rates: rows x, y, angle of each link in the order of ``Equations.names``."""

    place: Array
    rate: Array
    second: Array


class Equations:
    """The closure equations of a structure.

    Driver values and their rates are given as sequences, one entry a driver, each a number or an array over positions.
    """

    def __init__(self, structure: Structure, numbers: Arithmetic = DOUBLES) -> None:
        self.structure, self.numbers = structure, numbers
        frame = structure.scene.frame.name
        self.names = tuple(n for n in structure.links if n != frame)
        self.column = {n: 3 * k for k, n in enumerate(self.names)}

    @cached_property
    def pairs(self) -> tuple[Pair, ...]:
        """Every pair that joins the links."""
        found: list[Pair] = []
        for e in self.structure.elements:
            if isinstance(e, Driven):
                found.append(e.pair)
            elif isinstance(e, Dyad):
                found += [e.outer_first, e.inner, e.outer_second, *(w.pair for body in e.bodies for w in body.joints)]
            else:
                assert isinstance(e, LargerGroup)
                found += e.pairs
        return tuple(found)

    def start(self, motion: Motion, which: slice | int = slice(None)) -> Array:
        """Unknowns from a motion, shape (3 links, positions)."""
        rows: list[Array] = []
        for name in self.names:
            pose = motion.poses[name]
            z = np.broadcast_to(pose.z, (len(motion),))[which]
            u = np.broadcast_to(pose.u, (len(motion),))[which]
            rows += [z.real, z.imag, np.angle(u)]
        return np.array(rows)

    def improved(self, x: Array, values: Sequence[Values]) -> Array:
        """One step of Newton's method."""
        matrix, open_ = self._system(x, values)
        return np.asarray(x - self.numbers.solve(matrix, open_))

    def open(self, x: Array, values: Sequence[Values]) -> Array:
        """How far each equation is from closed (m, rad)."""
        return self._system(x, values)[1]

    def rates(self, x: Array, values: Sequence[Values], first: Sequence[Values], second: Sequence[Values]) -> Solution:
        """Velocities and accelerations at a position: two linear systems with the matrix of the last Newton step."""
        matrix, _ = self._system(x, values)
        rate = self.numbers.solve(matrix, self._drive(x, first))
        push = self._drive(x, second)
        self._bend(x, rate, values, push)
        return Solution(x, rate, self.numbers.solve(matrix, push))

    def velocities(self, x: Array, values: Sequence[Values], first: Sequence[Values]) -> Array:
        """Velocities alone."""
        return self.numbers.solve(self._system(x, values)[0], self._drive(x, first))

    def point(self, at: Solution, link: str, local: Values) -> tuple[Values, ...]:
        """x and y of place, velocity and acceleration of a place of a link."""
        k = self.column[link]
        x, y, angle = at.place[k : k + 3]
        c, s = self.numbers.cos(angle), self.numbers.sin(angle)
        rx, ry = c * local.real - s * local.imag, s * local.real + c * local.imag
        w, bend = at.rate[k + 2], at.second[k + 2]
        return (
            x + rx, y + ry, at.rate[k] - w * ry, at.rate[k + 1] + w * rx,
            at.second[k] - bend * ry - w * w * rx, at.second[k + 1] + bend * rx - w * w * ry,
        )  # fmt: skip

    # the equations in their order: two for each pair, then one for each driver

    def _link(self, x: Array, name: str) -> tuple[Values, Values, Values, Values]:
        """Place and direction of a link."""
        if name not in self.column:
            return 0.0, 0.0, 1.0, 0.0
        k = self.column[name]
        return x[k], x[k + 1], self.numbers.cos(x[k + 2]), self.numbers.sin(x[k + 2])

    def _angle(self, x: Array, name: str) -> Values:
        return x[self.column[name] + 2] if name in self.column else 0.0

    def _system(self, x: Array, values: Sequence[Values]) -> tuple[Array, Array]:
        matrix = np.zeros((len(x), *x.shape), dtype=x.dtype)
        open_ = np.zeros_like(x)

        def put(row: int, name: str, *by: Values) -> None:
            if name in self.column:
                k = self.column[name]
                for j, value in enumerate(by):
                    matrix[row, k + j] = matrix[row, k + j] + value

        for n, pair in enumerate(self.pairs):
            i, (a, b) = 2 * n, (pair.a, pair.b)
            if pair.turns:
                sides = [(name, sign, *self._arm(x, name, pair.point)) for name, sign in ((a, 1), (b, -1))]
                for name, sign, place_x, place_y, rx, ry in sides:
                    open_[i] = open_[i] + sign * (place_x + rx)
                    open_[i + 1] = open_[i + 1] + sign * (place_y + ry)
                    put(i, name, sign, 0, -sign * ry)
                    put(i + 1, name, 0, sign, sign * rx)
                continue
            gx, gy, over, along = self._guide(x, pair)
            through = pair.guide.through
            offset = pair.guide.direction.real * through.imag - pair.guide.direction.imag * through.real
            open_[i] = over - offset
            put(i, a, -gy, gx, 0)
            put(i, b, gy, -gx, -along)
            held = self.numbers.arg(pair.guide.direction) + self.numbers.arg(pair.turn)
            open_[i + 1] = self.numbers.unturned(self._angle(x, a) - self._angle(x, b) - held)
            put(i + 1, a, 0, 0, 1)
            put(i + 1, b, 0, 0, -1)
        for n, driver in enumerate(self.structure.scene.drivers):
            i = 2 * len(self.pairs) + n
            if driver.turns:
                turned = self._angle(x, driver.link) - self._angle(x, driver.relative_to)
                open_[i] = self.numbers.unturned(turned - values[n])
                put(i, driver.link, 0, 0, 1)
                put(i, driver.relative_to, 0, 0, -1)
                continue
            pair = self.structure.slide(driver.key)
            gx, gy, over, along = self._guide(x, pair)
            g, through = pair.guide.direction, pair.guide.through
            open_[i] = along - (g.real * through.real + g.imag * through.imag) - values[n]
            put(i, pair.a, gx, gy, 0)
            put(i, pair.b, -gx, -gy, over)
        return matrix, open_

    def _arm(self, x: Array, name: str, point: str) -> tuple[Values, Values, Values, Values]:
        place_x, place_y, c, s = self._link(x, name)
        p = self.structure.links[name].points[point]
        return place_x, place_y, c * p.real - s * p.imag, s * p.real + c * p.imag

    def _guide(self, x: Array, pair: Pair) -> tuple[Values, ...]:
        """Direction g of a guide, and g x e and g . e for the way e from its link's origin to the sliding link's."""
        ax, ay, _, _ = self._link(x, pair.a)
        bx, by, c, s = self._link(x, pair.b)
        g = pair.guide.direction
        gx, gy, ex, ey = c * g.real - s * g.imag, s * g.real + c * g.imag, ax - bx, ay - by
        return gx, gy, gx * ey - gy * ex, gx * ex + gy * ey

    def _drive(self, x: Array, given: Sequence[Values]) -> Array:
        right = np.zeros_like(x)
        for n, value in enumerate(given):
            right[2 * len(self.pairs) + n] = right[2 * len(self.pairs) + n] + value
        return right

    def _bend(self, x: Array, rate: Array, values: Sequence[Values], right: Array) -> None:
        """Add to the right side of the acceleration equations what the velocities give: normal and Coriolis terms."""

        def spin(name: str) -> Values:
            return rate[self.column[name] + 2] if name in self.column else 0.0

        def speed(name: str) -> tuple[Values, Values]:
            return (rate[self.column[name]], rate[self.column[name] + 1]) if name in self.column else (0.0, 0.0)

        def guided(pair: Pair) -> tuple[Values, ...]:
            gx, gy, over, along = self._guide(x, pair)
            (ax, ay), (bx, by), w = speed(pair.a), speed(pair.b), spin(pair.b)
            return gx, gy, over, along, ax - bx, ay - by, w

        for n, pair in enumerate(self.pairs):
            i = 2 * n
            if pair.turns:
                for name, sign in ((pair.a, 1), (pair.b, -1)):
                    _, _, rx, ry = self._arm(x, name, pair.point)
                    right[i] = right[i] + sign * spin(name) ** 2 * rx
                    right[i + 1] = right[i + 1] + sign * spin(name) ** 2 * ry
                continue
            gx, gy, over, _, vx, vy, w = guided(pair)
            right[i] = right[i] + w * w * over + 2 * w * (gx * vx + gy * vy)
        for n, driver in enumerate(self.structure.scene.drivers):
            if not driver.turns:
                i = 2 * len(self.pairs) + n
                gx, gy, _, along, vx, vy, w = guided(self.structure.slide(driver.key))
                right[i] = right[i] + w * w * along - 2 * w * (gx * vy - gy * vx)
