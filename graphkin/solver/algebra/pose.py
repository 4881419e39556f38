"""The pose of a link and its motion: place, direction, and their first and second rates, as arrays over positions.

The drawing board has a pose of its own (``graphkin.plane.Pose``, on paper, without rates): it never sees this one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Generic

import numpy as np
from numpy.typing import NDArray

from graphkin.plane import cross, dot
from graphkin.scene.tables import Measure
from graphkin.structure import Structure

Array = NDArray[Any]


if TYPE_CHECKING:
    from typing_extensions import TypeVar

    # arrays, or formulas, which compute alike
    V = TypeVar("V", bound=Any, default=Array)
    R = TypeVar("R", bound=Any, default=Array)
else:
    from typing import TypeVar

    V, R = TypeVar("V"), TypeVar("R")

FIELDS = ("z", "u", "v", "omega", "a", "alpha")
REAL = ("omega", "alpha")


@dataclass(frozen=True, eq=False, repr=False)
class Pose(Generic[V, R]):
    """A moving frame of axes, in other axes (the world's, or those of another link).

    Every field is an array of shape (positions,), or one that broadcasts to it (``Pose``); or a formula (``Pose[Vec,
    Real]``), so that the same lines here make the formulas of a mechanism and compute with their results.

    z, v, a : complex, origin (m) and its rates (m/s, m/s2)
    u : complex, direction of the x axis, of unit length
    omega, alpha : real, rates of the direction (rad/s, rad/s2)
    """

    z: V
    u: V
    v: V
    omega: R
    a: V
    alpha: R

    def fixed(self, place: V | complex, direction: V | complex = 1 + 0j) -> Pose[V, R]:
        """The axes fixed to this frame at ``place``, turned by ``direction``."""
        if place == 0:
            u = self.u if direction == 1 else self.u * direction
            return Pose(self.z, u, self.v, self.omega, self.a, self.alpha)
        arm = self.u * place
        return Pose(
            self.z + arm,
            self.u * direction,
            self.v + 1j * self.omega * arm,
            self.omega,
            self.a + (1j * self.alpha - self.omega * self.omega) * arm,
            self.alpha,
        )

    def carrying(self, place: V) -> Pose[V, R]:
        """The axes fixed to this frame with their origin at ``place`` of the outer axes now."""
        arm, spin = place - self.z, 1j * self.omega
        return Pose(
            place, self.u, self.v + spin * arm, self.omega, self.a + (1j * self.alpha + spin * spin) * arm, self.alpha
        )

    def of(self, inner: Pose[V, R]) -> Pose[V, R]:
        """The frame ``inner``, given in these axes, in the outer axes.

        The acceleration has the guiding, the Coriolis (2 i omega v_rel) and the relative part.
        """
        arm, slip = self.u * inner.z, self.u * inner.v
        spin = 1j * self.omega
        return Pose(
            self.z + arm,
            self.u * inner.u,
            self.v + spin * arm + slip,
            self.omega + inner.omega,
            self.a + (1j * self.alpha + spin * spin) * arm + 2 * spin * slip + self.u * inner.a,
            self.alpha + inner.alpha,
        )

    def inverse(self) -> Pose[V, R]:
        """The outer axes as seen from this frame."""
        back = self.u.conjugate()
        spin = 1j * self.omega
        return Pose(
            -back * self.z,
            back,
            -back * (self.v - spin * self.z),
            -self.omega,
            -back * (self.a - 2 * spin * self.v + (spin * spin - 1j * self.alpha) * self.z),
            -self.alpha,
        )

    def along(self, travel: R, velocity: R, acceleration: R) -> Pose[V, R]:
        """This frame moved along its own direction by a travel with rates."""
        spin = 1j * self.omega
        return Pose(
            self.z + travel * self.u,
            self.u,
            self.v + (velocity + spin * travel) * self.u,
            self.omega,
            self.a + (acceleration + 2 * spin * velocity + (1j * self.alpha + spin * spin) * travel) * self.u,
            self.alpha,
        )

    def pinned(self, joint: Pose[V, R], u: V, omega: R, alpha: R) -> Pose[V, R]:
        """The link of known direction with its ``joint`` (in its axes) at the origin of this frame."""
        spin = 1j * omega
        return Pose(
            self.z - u * joint.z,
            u,
            self.v - u * (joint.v + spin * joint.z),
            omega,
            self.a - u * (joint.a + 2 * spin * joint.v + (1j * alpha + spin * spin) * joint.z),
            alpha,
        )

    def each(self: Pose, change: Callable[[Array], Array]) -> Pose:
        """The frame with every field changed."""
        return Pose(*(change(getattr(self, field)) for field in FIELDS))

    def still(self: Pose, n: int) -> Pose:
        """The frame at n positions, in the memory of one."""
        return self.each(lambda x: np.broadcast_to(np.ravel(x)[0], (n,)))

    def rows(self: Pose, rows: slice | Array) -> Pose:
        """The frame at some positions; for a slice in the same memory."""
        return self.each(lambda x: x[rows])

    def where(self: Pose, ok: Array) -> Pose:
        """The frame where ok, NaN elsewhere."""
        return self.each(lambda x: known_where(ok, x))

    def spread(self: Pose, n: int) -> Pose:
        """The frame with every field of shape (n,)."""
        return self.each(lambda x: x if np.shape(x) == (n,) else np.array(np.broadcast_to(x, (n,))))


def known_where(ok: Array, values: Array) -> Array:
    """Values where ok, NaN elsewhere: in both parts of complex ones, so that neither passes for 0."""
    return np.where(ok, values, complex(np.nan, np.nan) if np.iscomplexobj(values) else np.nan)


def aimed(tail: Pose, tip: Pose) -> Pose:
    """Axes at the origin of a frame that point to the origin of another."""
    line, slip, push = tip.z - tail.z, tip.v - tail.v, tip.a - tail.a
    square = np.abs(line) ** 2
    omega = cross(line, slip) / square
    alpha = cross(line, push) / square - 2 * omega * dot(line, slip) / square
    return Pose(tail.z, line / np.abs(line), tail.v, omega, tail.a, alpha)


def rest(place: complex | Array = 0j, direction: complex | Array = 1 + 0j) -> Pose:
    """Axes at rest."""
    zero, none = np.zeros(1), np.zeros(1, dtype=np.complex128)
    return Pose(
        np.atleast_1d(np.asarray(place, dtype=np.complex128)),
        np.atleast_1d(np.asarray(direction)),
        none,
        zero,
        none,
        zero,
    )


def together(poses: Sequence[Pose], n: int) -> Pose:
    """Links at n positions as one, fields of shape (n, links)."""
    made = Pose(*(np.empty((n, len(poses)), dtype=np.float64 if f in REAL else np.complex128) for f in FIELDS))
    for k, pose in enumerate(poses):
        for field in FIELDS:
            getattr(made, field)[:, k] = getattr(pose, field)
    return made


def turned(angle: Array) -> Array:
    """Unit complex numbers at angles, exact at multiples of 90 degrees (within the rounding of the angle itself)."""
    u = np.empty(np.shape(angle), dtype=np.complex128)
    zero = np.abs(angle) * 4e-16
    for part, function in ((u.real, np.cos), (u.imag, np.sin)):
        function(angle, part)
        part[np.abs(part) <= zero] = 0.0
    return u

UNIT = 2.0**-53
"""How far one rounding may move a number, relatively."""
GIVEN = 3 * UNIT
"""Relative error of a number of the file after its conversion from decimals and units."""


@dataclass(frozen=True, eq=False, repr=False)
class ErrorBound(Generic[R]):
    """Bounds of the errors of a frame of axes: of its origin, or the largest of any point that moves with it, and of
    its direction.  Arrays of shape (n,), or formulas; infinite where they are unknown.

    position, velocity, acceleration : of the origin, or of any point (m, m/s, m/s2)
    angle, omega, alpha : of the direction and of its rates (rad, rad/s, rad/s2)
    """

    position: R
    velocity: R
    acceleration: R
    angle: R
    omega: R
    alpha: R

    def __iter__(self) -> Iterator[R]:
        return iter((self.position, self.velocity, self.acceleration, self.angle, self.omega, self.alpha))

    def of(self, measure: Measure) -> R:
        """The bound of a length, an angle, or a derivative of one by time; infinite beyond the second."""
        known = self.of_turning if measure.angle else self.of_point
        unknown: Any = np.full(np.shape(self.position), np.inf)
        return known[measure.order] if measure.order < len(known) else unknown  # type: ignore[no-any-return]

    @property
    def of_point(self) -> tuple[R, R, R]:
        """The bounds of position, velocity, acceleration."""
        return self.position, self.velocity, self.acceleration

    @property
    def of_turning(self) -> tuple[R, R, R]:
        """The bounds of the angle and its first and second rate."""
        return self.angle, self.omega, self.alpha

    def within(self, r: R, origin: tuple[R, R, R], spin: R, turning: R, rounding: R | float) -> ErrorBound[R]:
        """The largest bounds of any point within a radius of the origin.

        Parameters
        ----------
        r : the radius (m)
        origin : sizes of the origin's place, velocity and acceleration
        spin, turning : sizes of the angular velocity, and of the angular acceleration with the square of that
        rounding : relative error of adding a point to the origin
        """
        place, speed, push = origin
        few = rounding
        return replace(
            self,
            position=self.position + r * self.angle + few * (place + r),
            velocity=self.velocity + r * (self.omega + spin * self.angle) + few * (speed + spin * r),
            acceleration=self.acceleration
            + r * (self.alpha + turning * self.angle + (2.0 * spin + self.omega) * self.omega)
            + few * (push + turning * r),
        )


@dataclass(frozen=True, eq=False, repr=False)
class Drive:
    """Values of the drivers and their rates: arrays of shape (positions, drivers), SI."""

    value: Array
    rate: Array
    second: Array

    @classmethod
    def at(cls, structure: Structure, value: Array | None = None) -> Drive:
        """The drivers at these values, or at the one position of the scene itself, with the rates of the scene."""
        given = np.array([d.values for d in structure.scene.drivers]).reshape(-1, 3)
        value = given[None, :, 0] if value is None else value
        return cls(value, np.broadcast_to(given[:, 1], value.shape), np.broadcast_to(given[:, 2], value.shape))

    @classmethod
    def at_unit_rates(cls, value: Array) -> Drive:
        """The drivers at these values, shape (positions, drivers), each at a unit rate."""
        return cls(value, np.ones_like(value), np.zeros_like(value))

    def __len__(self) -> int:
        return len(self.value)

    def followed(self, structure: Structure) -> Drive:
        """The drive with the columns of links that follow the drivers by rolling."""
        if self.value.shape[1] == len(structure.drivers):
            return self
        ratios = np.array([f.ratios for f in structure.followers]).T
        values = np.array([d.values[0] for d in structure.scene.drivers])
        start = np.array([f.values[0] for f in structure.followers])
        columns = (self.value, start + (self.value - values) @ ratios), (self.rate, self.rate @ ratios)
        return Drive(*(np.concatenate(pair, axis=1) for pair in (*columns, (self.second, self.second @ ratios))))

    def __getitem__(self, which: Array | slice) -> Drive:
        return Drive(self.value[which], self.rate[which], self.second[which])
