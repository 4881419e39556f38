"""The projective plane: the sheet with infinity, so that a point at infinity needs no rule of its own.

Places of the plane with infinity among them have homogeneous coordinates of unit length.  A place is (x, y, w): the
point (x + iy) / w of the chart, or for w = 0 the direction x + iy.  A line is (a, b, c) with a x + b y + c w = 0.  The
line through two places and the place where two lines cross are both vector products; the length of the product is the
sine of the angle between the two on the unit sphere, a measure of their separation (Coxeter, Projective Geometry;
Kimbrell, Kinematics Analysis and Synthesis, on centres at infinity).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

Place = tuple[float, float, float]
Line = tuple[float, float, float]

INFINITE = 1e-12
"""A place whose third coordinate is smaller lies at infinity: so far off that doubles do not tell it from there."""


def wedge(a: Place, b: Place) -> tuple[Place, float]:
    """The vector product of two places (a line) or of two lines (a place), of unit length, and the sine between them.

    Both are (0, 0, 0) and 0 where the two coincide.
    """
    x, y, w = a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
    sine = math.sqrt(x * x + y * y + w * w)
    if sine == 0.0:
        return (0.0, 0.0, 0.0), 0.0
    return (x / sine, y / sine, w / sine), sine


def product(a: Place, b: Place) -> float:
    """Scalar product: for a place and a line the distance (on the sphere) of one from the other."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normal(a: Place) -> Place:
    """The place with coordinates of unit length, w not negative."""
    length = math.copysign(math.sqrt(product(a, a)), a[2])
    return a[0] / length, a[1] / length, a[2] / length


@dataclass(frozen=True, eq=False, repr=False)
class ProjectiveChart:
    """The sheet as seen from the middle of the mechanism: ``unit`` (mm) is half its size, so that it spans about 1."""

    middle: complex
    unit: float

    def at(self, z: complex) -> Place:
        """A point of the sheet (mm)."""
        s = (z - self.middle) / self.unit
        return normal((s.real, s.imag, 1.0))

    def towards(self, direction: complex) -> Place:
        """The place at infinity in a direction."""
        size = abs(direction)
        return direction.real / size, direction.imag / size, 0.0

    def line(self, z: complex, along: complex) -> Line:
        """The line through a point of the sheet (mm) along a direction."""
        return wedge(self.at(z), self.towards(along))[0]

    def point(self, place: Place) -> complex | None:
        """The point of the sheet (mm), None at infinity."""
        x, y, w = place
        return None if abs(w) < INFINITE else self.middle + self.unit * (complex(x, y) / w)

    def direction(self, place: Place) -> complex:
        """The unit vector from the middle of the sheet to a place; to the right, or straight up."""
        x, y, _ = place
        size = math.hypot(x, y) or 1.0
        sense = -1.0 if x < 0.0 or (x == 0.0 and y < 0.0) else 1.0
        return complex(x, y) * (sense / size)

    def pole(self, velocity: complex, omega: float) -> tuple[Place, float]:
        """The pole of the motion with a velocity of the middle: the velocity of z is i omega (z - pole), with pole =
        q / omega from the middle, q = i v there.

        Parameters
        ----------
        velocity : of the middle (mm/s)
        omega : angular velocity (rad/s)

        Returns
        -------
        the place and the strength (1/s): 0 at rest, and then the place has no meaning
        """
        q = 1j * velocity / self.unit
        strength = math.hypot(abs(q), omega)
        if strength == 0.0:
            return (0.0, 0.0, 0.0), 0.0
        place = (q.real / strength, q.imag / strength, omega / strength)
        return (place, strength) if omega >= 0.0 else ((-place[0], -place[1], -place[2]), -strength)

    def velocity(self, place: Place, strength: float, z: complex) -> complex:
        """The velocity (mm/s) of the point z of the sheet in a rotation about a place; the reverse of `pole`."""
        x, y, w = place
        return 1j * strength * (w * (z - self.middle) - complex(x, y) * self.unit)
