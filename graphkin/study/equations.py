"""The closure equations of a mechanism in any kind of number, doubles, complex steps, 50 digits; and their solution to
50 digits, by which all methods are measured.

Three unknowns a link (the place of its origin and its angle), two equations a pair, one a driver; the general method of
multibody programs (Haug, Computer Aided Kinematics and Dynamics, ch. 3).  It knows neither dyads nor their order, and
so it is independent of the closed form.  The numbers of the scene, doubles in SI, count as exact.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from graphkin.errors import CallError
from graphkin.plane import Values, added_up
from graphkin.scene.pairs import Pair
from graphkin.solver import Motion
from graphkin.solver.algebra.constraints import solve_all
from graphkin.solver.algebra.pose import Array
from graphkin.structure import Structure
from graphkin.words import Phrase

if TYPE_CHECKING:
    from mpmath import MPContext, mpf

    Digits = Sequence[float | mpf]

DIGITS = 50
STEPS = 60
CLOSED = 1e-38


@dataclass(frozen=True)
class Arithmetic:
    """The functions that the equations need beyond the four operations: elementwise functions of arrays, and a linear
    solver.

    ``unturned`` removes whole turns from a difference of angles; ``solve`` solves matrix (m, m, ...) x = right (m,
    ...).
    """

    cos: Callable[[Array], Array]
    sin: Callable[[Array], Array]
    arg: Callable[[complex], Values]
    unturned: Callable[[Values], Values]
    solve: Callable[[Array, Array], Array]


def _side_by_side(matrix: Array, right: Array) -> Array:
    """Solve n systems at once: matrix (m, m, n), right (m, n); a singular system gives nan."""
    return np.moveaxis(solve_all(np.moveaxis(matrix, -1, 0), np.moveaxis(right, -1, 0)), 0, -1)


DOUBLES = Arithmetic(
    np.cos, np.sin, cmath.phase, lambda d: d - 2 * math.pi * np.rint(np.real(d) / (2 * math.pi)), _side_by_side
)


@dataclass(frozen=True)
class Solution:
    """Unknowns and their two rates: rows x, y, angle of each link in the order of ``Equations.names``."""

    place: Array
    rate: Array
    second: Array


Line = tuple[int, str, complex, str, complex, str, complex, float]
"""Row, a link and a place in its axes, another link and a place in its, the link whose axes tell a direction, that
direction, offset: the way from the second place to the first, seen along the direction, is the offset."""


class Equations:
    """The closure equations of a structure: lines, and turns of one link against another.

    Driver values and their rates are given as sequences, one entry a driver, each a number or an array over positions.
    """

    def __init__(self, structure: Structure, numbers: Arithmetic = DOUBLES) -> None:
        self.structure, self.numbers = structure, numbers
        self.frame = structure.scene.frame.name
        self.names = tuple(n for n in structure.links if n != self.frame)
        self.column = {n: 3 * k for k, n in enumerate(self.names)}
        self.lines: list[Line] = []
        self.turns: list[tuple[int, str, str, Values]] = []
        """Row, a link, another, and the angle by which the first stands ahead of the second."""
        self.drivers: list[int] = []
        """The row of each driver."""
        row = 0
        for pair in (pair for element in structure.elements for pair in element.all_pairs):
            if pair.turns:
                first, second = (structure.links[link].points[pair.point] for link in (pair.a, pair.b))
                self.lines += [(row + k, pair.a, first, pair.b, second, self.frame, along, 0.0)
                               for k, along in enumerate((1 + 0j, 1j))]
            else:
                self._along(row, pair, 1j * pair.guide.direction)
                held = numbers.arg(pair.guide.direction) + numbers.arg(pair.turn)
                self.turns.append((row + 1, pair.a, pair.b, held))
            row += 2
        for driver in structure.scene.drivers:
            self.drivers.append(row)
            if driver.turns:
                self.turns.append((row, driver.link, driver.relative_to, 0.0))
            else:
                pair = structure.slide(driver.key)
                self._along(row, pair, pair.guide.direction)
            row += 1

    def _along(self, row: int, pair: Pair, along: complex) -> None:
        """The line of a sliding pair along a direction of its guide."""
        offset = (pair.guide.through * along.conjugate()).real
        self.lines.append((row, pair.a, 0j, pair.b, 0j, pair.b, along, offset))

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
        matrix, gaps = self._system(x, values)
        return x - self.numbers.solve(matrix, gaps)

    def open(self, x: Array, values: Sequence[Values]) -> Array:
        """The residual of each equation (m, rad)."""
        return self._system(x, values)[1]

    def rates(self, x: Array, values: Sequence[Values], first: Sequence[Values], second: Sequence[Values]) -> Solution:
        """Velocities and accelerations at a position: two linear systems with the matrix of the last Newton step."""
        matrix, _ = self._system(x, values)
        rate = self.numbers.solve(matrix, self._drive(x, first))
        return Solution(x, rate, self.numbers.solve(matrix, self._drive(x, second) + self._turning(x, rate)))

    def velocities(self, x: Array, values: Sequence[Values], first: Sequence[Values]) -> Array:
        """Velocities alone."""
        return self.numbers.solve(self._system(x, values)[0], self._drive(x, first))

    def point(self, at: Solution, link: str, local: Values) -> tuple[Values, ...]:
        """x and y of place, velocity and acceleration of a place of a link."""
        k = self.column[link]
        x, y, _ = at.place[k : k + 3]
        rx, ry = self._turned(at.place, link, local)
        w, push = at.rate[k + 2], at.second[k + 2]
        return (
            x + rx, y + ry, at.rate[k] - w * ry, at.rate[k + 1] + w * rx,
            at.second[k] - push * ry - w * w * rx, at.second[k + 1] + push * rx - w * w * ry,
        )

    def under(self, at: Solution, point: str, link: str) -> Values:
        """The place of a link that lies under a pin, in its own axes."""
        holder = next(name for name in self.names if point in self.structure.links[name].points)
        x, y = self.point(at, holder, self.structure.links[holder].points[point])[:2]
        origin_x, origin_y, angle = at.place[self.column[link] : self.column[link] + 3]
        away = x - origin_x + 1j * (y - origin_y)
        return away * (self.numbers.cos(angle) - 1j * self.numbers.sin(angle))

    # the equations

    def _of(self, x: Array, link: str) -> Any:
        """x, y and angle of a link, or their rates."""
        k = self.column.get(link)
        return (0.0, 0.0, 0.0) if k is None else x[k : k + 3]

    def _turned(self, x: Array, link: str, local: Values) -> tuple[Values, Values]:
        """A vector of a link in the axes of the frame."""
        if link not in self.column:
            return local.real, local.imag
        angle = x[self.column[link] + 2]
        c, s = self.numbers.cos(angle), self.numbers.sin(angle)
        return c * local.real - s * local.imag, s * local.real + c * local.imag

    def _system(self, x: Array, values: Sequence[Values]) -> tuple[Array, Array]:
        """The derivative of the equations by the unknowns, and their residuals."""
        matrix = np.zeros((len(x), *x.shape), dtype=x.dtype)
        gaps = np.zeros_like(x)

        def put(row: int, name: str, *by: Values) -> None:
            if name in self.column:
                for k, value in enumerate(by, self.column[name]):
                    matrix[row, k] = matrix[row, k] + value

        for row, a, of_a, b, of_b, axes, along, offset in self.lines:
            gx, gy = self._turned(x, axes, along)
            (ax, ay), (bx, by) = self._turned(x, a, of_a), self._turned(x, b, of_b)
            (xa, ya, _), (xb, yb, _) = self._of(x, a), self._of(x, b)
            ex, ey = (xa + ax) - (xb + bx), (ya + ay) - (yb + by)
            gaps[row] = gx * ex + gy * ey - offset
            put(row, a, gx, gy, gy * ax - gx * ay)
            put(row, b, -gx, -gy, gx * by - gy * bx)
            put(row, axes, 0, 0, gx * ey - gy * ex)
        for row, a, b, held in self.turns:
            driven = values[self.drivers.index(row)] if row in self.drivers else 0.0
            gaps[row] = self.numbers.unturned(self._of(x, a)[2] - self._of(x, b)[2] - held - driven)
            put(row, a, 0, 0, 1)
            put(row, b, 0, 0, -1)
        for k, row in enumerate(self.drivers):
            if not self.structure.scene.drivers[k].turns:
                gaps[row] = gaps[row] - values[k]
        return matrix, gaps

    def _drive(self, x: Array, given: Sequence[Values]) -> Array:
        right = np.zeros_like(x)
        for row, value in zip(self.drivers, given, strict=True):
            right[row] = right[row] + value
        return right

    def _turning(self, x: Array, rate: Array) -> Array:
        """The terms of velocities on the right side of the acceleration equations: normal and Coriolis terms."""
        right = np.zeros_like(x)
        for row, a, of_a, b, of_b, axes, along, _ in self.lines:
            gx, gy = self._turned(x, axes, along)
            (ax, ay), (bx, by) = self._turned(x, a, of_a), self._turned(x, b, of_b)
            (xa, ya, _), (xb, yb, _) = self._of(x, a), self._of(x, b)
            (va, ua, wa), (vb, ub, wb) = self._of(rate, a), self._of(rate, b)
            w = self._of(rate, axes)[2]
            ex, ey = (xa + ax) - (xb + bx), (ya + ay) - (yb + by)
            vx, vy = (va - wa * ay) - (vb - wb * by), (ua + wa * ax) - (ub + wb * bx)
            normal = wa * wa * (gx * ax + gy * ay) - wb * wb * (gx * bx + gy * by)
            right[row] = normal + w * w * (gx * ex + gy * ey) + 2 * w * (gy * vx - gx * vy)
        return right


# 50 digits


def context() -> MPContext:
    """An mpmath context of 50 digits.

    Raises
    ------
    CallError : mpmath is not installed
    """
    try:
        from mpmath import MPContext
    except ImportError:
        raise CallError.of("study", "the 50-digit reference needs mpmath", "pip install 'graphkin[study]'") from None
    mp = MPContext()
    mp.dps = DIGITS
    return mp


def reference(structure: Structure, mp: MPContext) -> Equations:
    """The closure equations of a structure in numbers of an mpmath context."""
    turn = 2 * mp.pi
    numbers = Arithmetic(
        cos=np.frompyfunc(mp.cos, 1, 1),
        sin=np.frompyfunc(mp.sin, 1, 1),
        arg=lambda z: mp.arg(mp.mpc(z)),
        unturned=lambda d: d - turn * mp.nint(d / turn),
        solve=_eliminated,
    )
    return Equations(structure, numbers)


def _eliminated(matrix: Array, right: Array) -> Array:
    """Solve a system of numbers of any kind by elimination with the largest pivot of each column (Golub and Van Loan,
    Matrix Computations, 3.4).  Most entries are 0 and are passed over: `mpmath.lu_solve` takes 18 times as long.

    matrix, right : shape (m, m) and (m,)

    Raises
    ------
    ZeroDivisionError : the matrix is singular
    """
    rows = [[*row, value] for row, value in zip(matrix.tolist(), right.tolist(), strict=True)]
    count = len(rows)
    for k in range(count):
        largest = max(range(k, count), key=lambda i: abs(rows[i][k]))
        rows[k], rows[largest] = rows[largest], rows[k]
        filled = [j for j in range(k + 1, count + 1) if rows[k][j]]
        for row in (row for row in rows[k + 1 :] if row[k]):
            factor = row[k] / rows[k][k]
            for j in filled:
                row[j] -= factor * rows[k][j]
    solution = np.zeros(count, dtype=object)
    for k in reversed(range(count)):
        known = [rows[k][j] * solution[j] for j in range(k + 1, count) if rows[k][j]]
        solution[k] = (rows[k][count] - added_up(known)) / rows[k][k]
    return solution


def refined(
    equations: Equations, mp: MPContext, x: Digits, values: Digits, first: Digits, second: Digits
) -> Solution:
    """Position and rates to 50 digits from a start near by.

    Raises
    ------
    ArithmeticError : Newton's method does not close the equations from there
    """
    at = np.array([mp.mpf(v) for v in x], dtype=object)
    for _ in range(STEPS):
        new = equations.improved(at, values)
        moved = max(abs(v) for v in new - at)
        at = new
        if moved < CLOSED:
            return equations.rates(at, values, first, second)
    raise ArithmeticError(Phrase("the reference does not converge"))
