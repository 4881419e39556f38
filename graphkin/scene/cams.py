"""Cams by the law of their follower, resolved, in SI units.

A sliding follower's first point stands beyond the foot of the axis on its line by the root of base radius and offset
plus the lift (a flat face: by base radius plus lift); a swinging one's bar turns by the lift from where its roller's
centre lies on the base circle of the pitch curve.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from graphkin.plane import Values
from graphkin.scene.follower_law import FollowerLaw, Lift

__all__ = ["Course", "LawCam", "SlidingFollower", "SwingingFollower"]


@dataclass(frozen=True)
class SlidingFollower:
    """A follower on a guide of the frame: the ``pair``, the ``foot`` of the cam's axis on the line (m), the sense of
    the line, the travel at the foot (m), and the ``offset`` (m), positive where the axis lies to the left of the line.
    """

    pair: str
    foot: complex
    along: complex
    travel: float
    offset: float


@dataclass(frozen=True)
class SwingingFollower:
    """A follower that swings about ``pivot`` of the frame (at ``centre``, m): its roller's centre ``tip`` lies ``arm``
    m off, on the side of the line from pivot to cam axis on which angles grow (``side`` 1), or on the other (-1).

    ``back`` is true where the link's own axis points from tip to pivot."""

    pivot: str
    tip: str
    centre: complex
    arm: float
    side: int
    back: bool = False


class Course(NamedTuple):
    """The follower's point from the cam's axis (m), its first to third derivative by the cam's own angle, and the
    direction in which it moves, unit; complex, or arrays of complex numbers.  ``turning`` is how fast that turns."""

    point: Values
    first: Values
    second: Values
    third: Values
    way: Values
    turning: Values

    @property
    def tangent(self) -> Values:
        """Derivative of the pitch curve, as seen from the cam (in the axes of the frame)."""
        return self.first - 1j * self.point

    @property
    def bend(self) -> Values:
        """Its second derivative."""
        return self.second - 2j * self.first - self.point

    @property
    def jerk(self) -> Values:
        """Its third derivative."""
        return self.third - 3j * self.second - 3.0 * self.first + 1j * self.point


@dataclass(frozen=True)
class LawCam:
    """A cam that turns about ``point`` of the frame (at ``axis``, m), given by the law of its follower.

    The cam degree is ``sense`` times the link's own angle.  ``base`` is the radius of the base circle of the pitch
    curve (of the profile, where the face is flat), ``roller`` 0 of a knife edge or a flat face (m); ``allowed`` are the
    greatest pressure angles of rise and fall (rad), where they are given.
    """

    link: str
    follower: str
    point: str
    axis: complex
    law: FollowerLaw
    sense: int
    base: float
    roller: float
    flat: bool
    motion: SlidingFollower | SwingingFollower
    allowed: tuple[float | None, float | None] = (None, None)

    @property
    def key(self) -> str:
        """What it is told from drivers by."""
        return f"cam {self.link}"

    @property
    def base_of_profile(self) -> float:
        """Radius of the base circle of the profile (m)."""
        return self.base - self.roller

    @property
    def name_of_point(self) -> str:
        """The point of the follower that the law moves: the roller's centre, the edge; "" where it has no name."""
        return self.motion.tip if isinstance(self.motion, SwingingFollower) else ""

    def degree(self, angle: float) -> float:
        """The angle of the law (rad) at an angle of the link's own axis."""
        return self.law.reduced(self.sense * angle)

    def leaves(self, lift: float, sense: int) -> float:
        """The angle of the link's own axis (rad, 0 to a turn) from which the follower leaves its least or greatest lift
        where the cam turns in a sense; the smallest of several."""
        grows = sense * self.sense > 0
        moving = [piece for piece in self.law.pieces if piece.low != piece.high]
        ends = [piece.start if grows else piece.end for piece in moving if lift == (piece.low if grows else piece.high)]
        return min(self.sense * end % math.tau for end in ends)

    def course(self, start: float, lift: Lift, exp: Callable[[Values], Values] = cmath.exp) -> Course:
        """The follower's point where it has some lift.

        Parameters
        ----------
        start : where it stands at lift 0 (`beginning`)
        lift : with its derivatives by the degree of the cam
        exp : the exponential function, of NumPy for arrays
        """
        motion = self.motion
        s1, s2, s3 = self.sense * lift.slope, lift.bend, self.sense * lift.jerk
        if isinstance(motion, SlidingFollower):
            point = motion.foot - self.axis + motion.along * (start + lift.lift)
            e = motion.along
            return Course(point, e * s1, e * s2, e * s3, e + 0 * point, 0.0 * s1)
        line = self.axis - motion.centre
        bar = motion.arm * line / abs(line) * exp(1j * motion.side * (start + lift.lift))
        t1, t2, t3 = motion.side * s1, motion.side * s2, motion.side * s3
        third = (1j * t3 - 3.0 * t1 * t2 - 1j * t1 * t1 * t1) * bar
        return Course(motion.centre - self.axis + bar, 1j * t1 * bar, (1j * t2 - t1 * t1) * bar, third,
                      1j * motion.side * bar / motion.arm, t1)  # fmt: skip

    @property
    def beginning(self) -> float | None:
        """Lift 0: of a sliding follower the distance beyond the foot (m), of a swinging one the angle of its bar from
        the line to the cam's axis (rad); None where the follower does not come to the base circle."""
        motion = self.motion
        if isinstance(motion, SlidingFollower):
            if self.flat:
                return self.base
            square = (self.base - motion.offset) * (self.base + motion.offset)
            return math.sqrt(square) if square >= 0.0 else None
        a, b, c = abs(self.axis - motion.centre), motion.arm, self.base
        half = (a + b + c) / 2
        under, over = (half - a) * (half - b), half * (half - c)
        return 2.0 * math.atan2(math.sqrt(under), math.sqrt(over)) if under >= 0.0 < over else None
