"""Formulas in 50 decimal digits, for positions so near to a singular one that 16 are not enough."""

from __future__ import annotations

import cmath
from contextlib import AbstractContextManager
from decimal import ROUND_HALF_EVEN, Context, Decimal, DivisionByZero, InvalidOperation, Overflow, localcontext

from graphkin.scene.model import Driver
from graphkin.solver.pose import GIVEN

__all__ = ["DIGITS", "PI", "cos_sin", "meant", "meant_angle", "meant_direction", "meant_value", "working"]

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
    """The decimal that was written in the file for a float, and whether there is one; else the float itself."""
    short = f"{value:.{SHORT}g}"
    if abs(float(short) - value) <= 4.5e-16 * abs(value):
        return Decimal(short), True
    return Decimal(value), False


def meant_angle(value: float) -> tuple[Decimal, bool]:
    """The angle (rad) of the decimal degrees that were written for it."""
    with working():
        degrees, known = meant(float(Decimal(value) * 180 / PI))
        return (degrees * PI / 180 if known else Decimal(value)), known


def meant_value(driver: Driver, value: float) -> Decimal:
    """The value of a driver that was written for a float."""
    return (meant_angle if driver.turns else meant)(value)[0]


def meant_direction(z: complex) -> tuple[tuple[Decimal, Decimal], bool]:
    """The unit vector at the decimal degrees that were written for it."""
    angle, known = meant_angle(cmath.phase(z))
    if known:
        with working():
            u = cos_sin(angle)
        if max(abs(float(u[0]) - z.real), abs(float(u[1]) - z.imag)) < 4.5e-16:
            return u, True
    return (Decimal(z.real), Decimal(z.imag)), False


def conversion_error(z: complex, direction: bool) -> tuple[float, float]:
    """How far a place or a direction of the file may be off after its conversion from decimals and units: as floats,
    and as the decimals that are taken to be meant."""
    if direction:
        (x, y), known = meant_direction(z)
    else:
        (x, known_x), (y, known_y) = meant(z.real), meant(z.imag)
        known = known_x and known_y
    if not known:
        return GIVEN * abs(z), GIVEN * abs(z)
    return max(abs(float(Decimal(z.real) - x)), abs(float(Decimal(z.imag) - y))), 0.0


def cos_sin(angle: Decimal) -> tuple[Decimal, Decimal]:
    """Cosine and sine by their series, after the angle is brought within 45 degrees of a quarter turn."""
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
