"""Points and directions of the plane as complex numbers: products, crossings, compass arcs in closed form; and the pose
of a link."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any, TypeAlias, overload

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Points = NDArray[np.complex128]
    Floats = NDArray[np.float64]

Values: TypeAlias = Any
"""A number, an array, or whatever else sums and products are made of: decimals, formulas."""


@overload
def added_up(values: Iterable[float], start: float = ...) -> float: ...
@overload
def added_up(values: Iterable[complex], start: complex) -> complex: ...
def added_up(values: Iterable[Values], start: Values = 0) -> Values:
    """Numbers added from left to right, each sum rounded.

    The builtin ``sum`` compensates for rounding, of floats from Python 3.12 on, of complex numbers from 3.14 on: files
    would depend on the Python that writes them.
    """
    return reduce(add, values, start)


@overload
def dot(a: complex, b: complex) -> float: ...
@overload
def dot(a: Points, b: Points) -> Floats: ...
@overload
def dot(a: Values, b: Values) -> Values: ...
def dot(a: Values, b: Values) -> Values:
    """Scalar product of two plane vectors: complex numbers, arrays of them, or formulas."""
    return a.real * b.real + a.imag * b.imag


@overload
def cross(a: complex, b: complex) -> float: ...
@overload
def cross(a: Points, b: Points) -> Floats: ...
@overload
def cross(a: Values, b: Values) -> Values: ...
def cross(a: Values, b: Values) -> Values:
    """Vector product (its z part) of two plane vectors: positive where b lies counter-clockwise of a."""
    return a.real * b.imag - a.imag * b.real


def unit(z: complex) -> complex:
    """Direction of z as a unit complex number.  Raises ZeroDivisionError for z = 0."""
    return z / abs(z)


def direction(angle_deg: float) -> complex:
    """Unit complex number at an angle in degrees, exact at multiples of 90 degrees.

    >>> direction(90), direction(-180)
    (1j, (-1+0j))
    """
    turns, rest = divmod(angle_deg, 90.0)
    quarter = (1 + 0j, 1j, -1 + 0j, -1j)[int(turns) % 4]
    if rest == 0.0:
        return quarter
    rad = math.radians(rest)
    return quarter * complex(math.cos(rad), math.sin(rad))


def degrees(z: complex) -> float:
    """Angle of a vector in degrees, in (-180, 180]."""
    angle = math.degrees(math.atan2(z.imag, z.real))
    return 180.0 if angle == -180.0 else angle


def cross_lines(p: complex, d: complex, q: complex, e: complex) -> complex | None:
    """Point where the line through p along d meets the line through q along e; None if parallel."""
    sine = cross(d, e)
    if sine == 0.0:
        return None
    return p + d * (cross(q - p, e) / sine)


def cross_line_arc(p: complex, d: complex, centre: complex, radius: float) -> tuple[complex, complex] | None:
    """The two points where a line through p along unit d cuts a circle, the point farther along d first."""
    foot = p + d * dot(centre - p, d)
    offset = abs(centre - foot)
    inside = (radius - offset) * (radius + offset)
    if inside < 0.0:
        return None
    half = math.sqrt(inside)
    return foot + half * d, foot - half * d


def cross_arcs(p: complex, r: float, q: complex, s: float) -> tuple[complex, complex] | None:
    """The two points where the circle about p (radius r) cuts the circle about q (radius s), the point to the left of
    the directed line from p to q first; None where they do not meet.

    The height over the line of centres comes from Heron's product with the small factors formed first, which
    keeps its digits where r**2 - x**2 loses them (Kahan, Miscalculating area and angles of a needle-like triangle).
    """
    line = q - p
    c = abs(line)
    if c == 0.0:
        return None
    lo, mid, hi = sorted((r, s, c))
    product = (hi + (mid + lo)) * (lo - (hi - mid)) * (lo + (hi - mid)) * (hi + (mid - lo))
    if product < 0.0:
        return None
    height = math.sqrt(product) / (2.0 * c)
    along = ((r - s) * (r + s) / c + c) / 2.0
    e = line / c
    return p + e * complex(along, height), p + e * complex(along, -height)


@dataclass(frozen=True, eq=False, repr=False)
class Pose:
    """The pose of a link: its origin (m, or mm on paper) and the unit direction of its own x axis."""

    origin: complex
    axis: complex

    def place(self, local: complex) -> complex:
        """The place (in the frame) of a place in the link's own axes."""
        return self.origin + self.axis * local

    def local(self, place: complex) -> complex:
        """The place in the link's own axes of a place in the frame."""
        return (place - self.origin) / self.axis

    def scaled(self, times: float) -> Pose:
        """The pose with lengths multiplied by ``times``."""
        return Pose(self.origin * times, self.axis)


Poses = Mapping[str, Pose]
"""Where links lie, by their names."""
