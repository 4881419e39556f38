"""The given numbers: values of drivers with their cosines and sines, in words and at even steps; and the decimals
written in the file for them, for computations in 50 digits near singular positions, where 16 are not enough."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from decimal import ROUND_HALF_EVEN, Context, Decimal, DivisionByZero, InvalidOperation, Overflow, localcontext
from numbers import Real

import numpy as np

from graphkin.errors import CallError, did_you_mean
from graphkin.scene.model import Driver, Mechanism
from graphkin.solver.algebra.pose import GIVEN, Array, turned

NEAR = 1e-14
HALF_PI = math.pi / 2
MANY = 2000
"""From so many even steps on cosines are products."""


@dataclass(frozen=True, eq=False, repr=False)
class GivenValues:
    """Given values of the first driver."""

    values: Array

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, part: slice | Array) -> GivenValues:
        return GivenValues(self.values[part])

    @property
    def given(self) -> tuple[Array]:
        """The inputs of compiled code."""
        return (self.values,)

    @property
    def turn(self) -> tuple[Array, Array]:
        """Cosines and sines, exact at quarter turns."""
        c, s = np.cos(self.values), np.sin(self.values)
        near = np.flatnonzero(np.abs(c * s) < NEAR)
        if len(near):
            u = turned(self.values[near])
            c[near], s[near] = u.real, u.imag
        return c, s


@dataclass(frozen=True, eq=False, repr=False)
class UniformGrid:
    """Values at even steps over ``way`` in ``n`` parts: start + way / n k, for k from ``first`` to ``last`` (not
    included)."""

    start: float
    way: float
    n: int
    first: int
    last: int

    def __len__(self) -> int:
        return self.last - self.first

    def __getitem__(self, part: slice | Array) -> UniformGrid | GivenValues:
        if not isinstance(part, slice):
            return GivenValues(self.start + self.step * (self.first + part))
        return UniformGrid(self.start, self.way, self.n, self.first + part.start, self.first + part.stop)

    @property
    def step(self) -> float:
        return self.way / self.n

    @property
    def values(self) -> Array:
        steps = np.arange(float(self.first), float(self.last))
        steps *= self.step
        steps += self.start
        return steps

    @property
    def given(self) -> tuple[int, int]:
        """The inputs of compiled code besides start and way."""
        return self.n, self.first

    @property
    def turn(self) -> tuple[Array, Array]:
        """Cosines and sines, exact at quarter turns; of many each as the product of a coarse and a fine turn: two
        roundings more."""
        n = len(self)
        if n < MANY:
            return GivenValues(self.values).turn
        begin, end = self.start + self.step * self.first, self.start + self.step * (self.last - 1)
        fine = 1 << (n.bit_length() + 1) // 2
        coarse, inner = begin + self.step * np.arange(0, n, fine), self.step * np.arange(fine)
        u = np.multiply.outer(np.cos(coarse) + 1j * np.sin(coarse), np.cos(inner) + 1j * np.sin(inner))
        flat = u.reshape(-1)[:n]
        c, s = np.ascontiguousarray(flat.real), np.ascontiguousarray(flat.imag)
        low, high = min(begin, end) / HALF_PI, max(begin, end) / HALF_PI
        for m in range(math.ceil(low - 1e-6), math.floor(high + 1e-6) + 1):
            k = round((m * HALF_PI - begin) / self.step) if self.step else 0
            value = self.start + self.step * (self.first + k)
            if 0 <= k < n and abs(value - m * HALF_PI) <= NEAR * (1 + abs(value)):
                c[k], s[k] = quarter(value)
        return c, s


def quarter(angle: float) -> tuple[float, float]:
    """Cosine and sine, as ``turned`` gives them."""
    c, s, zero = math.cos(angle), math.sin(angle), 4e-16 * abs(angle)
    return 0.0 if abs(c) <= zero else c, 0.0 if abs(s) <= zero else s


def own_values(scene: Mechanism) -> Array:
    """The drivers' values in the scene's own position, shape (drivers,)."""
    return np.array([d.values[0] for d in scene.drivers])


def goal_values(scene: Mechanism, at: Mapping[str, float] | None) -> Array:
    """The scene's driver values, with those given by driver key replaced, shape (drivers,).

    Raises
    ------
    CallError : a key that is no driver, a value that is no number
    """
    goal = own_values(scene)
    keys = [d.key for d in scene.drivers]
    for key, value in (at or {}).items():
        if key not in keys:
            raise CallError.of(f'at "{key}"', "there is no such driver", did_you_mean(key, keys))
        if not isinstance(value, Real) or not math.isfinite(value):
            raise CallError.of(f'at "{key}"', "is no driver value of value", value=value)
        goal[keys.index(key)] = value
    return goal


# the decimals that are meant


DIGITS = 50
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899863")
SHORT = 12
"""A float that agrees in its last digits with a decimal of this many places is taken for that decimal."""


def working() -> AbstractContextManager[Context]:
    """The arithmetic of this module, as a context manager."""
    return localcontext(
        Context(prec=DIGITS + 10, rounding=ROUND_HALF_EVEN, traps=[DivisionByZero, InvalidOperation, Overflow])
    )


def meant(value: float) -> tuple[Decimal, bool]:
    """The decimal written in the file for a float, and whether there is one; else the float itself."""
    short = f"{value:.{SHORT}g}"
    if abs(float(short) - value) <= 4.5e-16 * abs(value):
        return Decimal(short), True
    return Decimal(value), False


def meant_angle(value: float) -> tuple[Decimal, bool]:
    """The angle (rad) of the decimal degrees written for it."""
    with working():
        degrees, known = meant(float(Decimal(value) * 180 / PI))
        return (degrees * PI / 180 if known else Decimal(value)), known


def meant_value(driver: Driver, value: float) -> Decimal:
    """The value of a driver written for a float."""
    return (meant_angle if driver.turns else meant)(value)[0]


def meant_vector(z: complex, direction: bool) -> tuple[tuple[Decimal, Decimal], bool]:
    """The decimals written in the file for a place or a direction, and whether there are any."""
    if direction:
        return meant_direction(z)
    (x, known_x), (y, known_y) = meant(z.real), meant(z.imag)
    return (x, y), known_x and known_y


def meant_direction(z: complex) -> tuple[tuple[Decimal, Decimal], bool]:
    """The unit vector at the decimal degrees written for it."""
    angle, known = meant_angle(cmath.phase(z))
    if known:
        with working():
            u = cos_sin(angle)
        if max(abs(float(u[0]) - z.real), abs(float(u[1]) - z.imag)) < 4.5e-16:
            return u, True
    return (Decimal(z.real), Decimal(z.imag)), False


def law_doubts(drivers: Sequence[Driver]) -> Array:
    """How far rounding may move value, rate and second rate of drivers that move by laws, and of what follows them:
    shape (3, drivers) (rad or m, by s and by s2); 0 for others."""
    doubts = np.zeros((len(drivers), 3))
    for driver, doubt in zip(drivers, doubts, strict=True):
        if driver.law is not None:
            doubt[:] = driver.law.doubts
        elif driver.ratios:
            doubt[:] = np.abs(driver.ratios) @ doubts[: len(driver.ratios)]
    return doubts.T


def conversion_error(z: complex, direction: bool) -> tuple[float, float]:
    """The error of a place or a direction of the file after its conversion from decimals and units: as floats, and as
    the decimals taken for them."""
    (x, y), known = meant_vector(z, direction)
    if not known:
        return GIVEN * abs(z), GIVEN * abs(z)
    return max(abs(float(Decimal(z.real) - x)), abs(float(Decimal(z.imag) - y))), 0.0


def cos_sin(angle: Decimal) -> tuple[Decimal, Decimal]:
    """Cosine and sine by their series, with the angle reduced to 45 degrees about a quarter turn."""
    quarter = PI / 2
    turns = (angle / quarter).to_integral_value(rounding=ROUND_HALF_EVEN)
    x = angle - turns * quarter
    if abs(x) < Decimal(10) ** -(DIGITS + 5):
        x = Decimal(0)
    term = Decimal(1)
    parts = [Decimal(0), Decimal(0)]
    k = 0
    while term and abs(term) > Decimal(10) ** -(DIGITS + 15):
        parts[k % 2] += term if k % 4 < 2 else -term
        k += 1
        term = term * x / k
    c, s = parts
    return ((c, s), (-s, c), (-c, -s), (s, -c))[int(turns) % 4]
