"""How far rounding may have moved what the solver finds: one bound for each of the six numbers of a pose."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Generic, TypeVar

from graphkin.frozen import dataclass
from graphkin.solver.expressions import Real
from graphkin.solver.pose import Array

__all__ = ["ErrorBound"]

N = TypeVar("N", Real, Array)


@dataclass(frozen=True)
class ErrorBound(Generic[N]):
    """Bounds of the errors of a frame of axes: of its origin, or the most of any point that moves with it, and of its
    direction.  Arrays of shape (n,), or formulas; infinite where nothing is known.

    position, velocity, acceleration : of the origin, or of any point (m, m/s, m/s2)
    angle, omega, alpha : of the direction and of its rates (rad, rad/s, rad/s2)
    """

    position: N
    velocity: N
    acceleration: N
    angle: N
    omega: N
    alpha: N

    def __iter__(self) -> Iterator[N]:
        return iter((self.position, self.velocity, self.acceleration, self.angle, self.omega, self.alpha))

    def __add__(self, other: ErrorBound[N]) -> ErrorBound[N]:
        return ErrorBound(*(a + b for a, b in zip(self, other, strict=True)))

    @property
    def of_point(self) -> tuple[N, N, N]:
        """Of position, velocity, acceleration."""
        return self.position, self.velocity, self.acceleration

    @property
    def of_turning(self) -> tuple[N, N, N]:
        """Of the angle and its first and second rate."""
        return self.angle, self.omega, self.alpha

    def turning_as(self, angle: N, omega: N, alpha: N) -> ErrorBound[N]:
        """The same origin, with another direction."""
        return replace(self, angle=angle, omega=omega, alpha=alpha)

    def within(self, r: N, origin: tuple[N, N, N], spin: N, bend: N, rounding: N | float) -> ErrorBound[N]:
        """The most of any point within a radius of the origin.

        Parameters
        ----------
        r : the radius (m)
        origin : sizes of the origin's place, velocity and acceleration
        spin, bend : sizes of the angular velocity, and of the angular acceleration with the square of that
        rounding : relative error of adding a point to the origin
        """
        place, speed, push = origin
        few = rounding
        return replace(
            self,
            position=self.position + r * self.angle + few * (place + r),
            velocity=self.velocity + r * (self.omega + spin * self.angle) + few * (speed + spin * r),
            acceleration=self.acceleration
            + r * (self.alpha + bend * self.angle + (2.0 * spin + self.omega) * self.omega)
            + few * (push + bend * r),
        )
