"""Cams by the law of their follower, resolved, in SI units, and that law: the lift over the angle of the cam, piece by
piece, with three derivatives.

A sliding follower's first point stands beyond the foot of the axis on its line by the root of base radius and offset
plus the lift (a flat face: by base radius plus lift); a swinging one's bar turns by the lift from where its roller's
centre lies on the base circle of the pitch curve.
"""

from __future__ import annotations

import cmath
import math
from bisect import bisect_right
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import ModuleType
from typing import ClassVar, NamedTuple

from graphkin.plane import Values

__all__ = [
    "LAWS", "SPELLINGS", "Course", "FollowerLaw", "LawCam", "Lift", "LiftPiece", "SlidingFollower", "SmoothPart",
    "SwingingFollower", "form_of",
]  # fmt: skip

TURN = 2 * math.pi
SEAM = 1e-12
"""An angle (rad) nearer than this before a seam belongs to the piece after it."""


class Lift(NamedTuple):
    """Lift and its first three derivatives by the angle of the cam (m or rad, per rad)."""

    lift: Values
    slope: Values
    bend: Values
    jerk: Values


Form = Callable[[Values, ModuleType], tuple[Values, Values, Values, Values]]
"""From 0 to 1 over 0 to 1, with three derivatives; of floats with the functions of math, of arrays with NumPy's."""


def _uniform(x: Values, _: ModuleType) -> tuple[Values, Values, Values, Values]:
    return x, 1.0 + 0 * x, 0.0 * x, 0.0 * x


def _accelerated(x: Values, _: ModuleType) -> tuple[Values, Values, Values, Values]:
    return x * x, 2 * x, 2.0 + 0 * x, 0.0 * x


def _decelerated(x: Values, _: ModuleType) -> tuple[Values, Values, Values, Values]:
    return x * (2 - x), 2 * (1 - x), -2.0 + 0 * x, 0.0 * x


def _harmonic(x: Values, m: ModuleType) -> tuple[Values, Values, Values, Values]:
    c, s, w = m.cos(math.pi * x), m.sin(math.pi * x), math.pi
    return (1 - c) / 2, w * s / 2, w**2 * c / 2, -(w**3) * s / 2


def _cycloidal(x: Values, m: ModuleType) -> tuple[Values, Values, Values, Values]:
    c, s, w = m.cos(TURN * x), m.sin(TURN * x), TURN
    return x - s / w, 1 - c, w * s, w**2 * c


def _345(x: Values, _: ModuleType) -> tuple[Values, Values, Values, Values]:
    y = 1 - x
    return x**3 * (10 + x * (6 * x - 15)), 30 * (x * y) ** 2, 60 * x * y * (1 - 2 * x), 60 - 360 * x * y


def _4567(x: Values, _: ModuleType) -> tuple[Values, Values, Values, Values]:
    xy = x * (1 - x)
    lift = x**4 * (35 + x * (x * (70 - 20 * x) - 84))
    return lift, 140 * xy**3, 420 * xy**2 * (1 - 2 * x), 840 * xy * (1 - 5 * xy)


LAWS: Mapping[str, tuple[tuple[float, Form], ...]] = {
    "uniform": ((1.0, _uniform),),
    "parabolic": ((0.5, _accelerated), (1.0, _decelerated)),
    "harmonic": ((1.0, _harmonic),),
    "cycloidal": ((1.0, _cycloidal),),
    "345": ((1.0, _345),),
    "4567": ((1.0, _4567),),
}
"""Laws by their names in a scene: the forms of their smooth parts, each up to a share of the angle and of the lift."""
PEAKS: Mapping[str, tuple[tuple[float, ...], tuple[float, ...]]] = {
    "harmonic": ((0.5,), ()),
    "cycloidal": ((0.5,), (0.25, 0.75)),
    "345": ((0.5,), (0.5 - math.sqrt(1 / 12), 0.5 + math.sqrt(1 / 12))),
    "4567": ((0.5,), (0.5 - math.sqrt(1 / 20), 0.5 + math.sqrt(1 / 20))),
}
"""Where inside a form its first derivative, and its second, is extreme: the next derivative is 0 there.  The other laws
are extreme at their ends."""
SPELLINGS = (*LAWS, *("-".join(name) for name in LAWS if name.isdigit()))
"""The names as people write them: "3-4-5" too."""


def form_of(by: str | None) -> str:
    """The name of a law, however people write it: "3-4-5" is "345"; "" of a dwell."""
    return (by or "").replace("-", "")


@dataclass(frozen=True)
class SmoothPart:
    """A part of the law with derivatives of every order: the piece itself, or of a parabolic piece each half; ``by`` is
    the law ("" of a dwell), ``which`` the part of it."""

    start: float
    end: float
    low: float
    high: float
    by: str
    which: int = 0

    def at(self, angle: Values, m: ModuleType = math) -> Lift:
        """The lift at angles inside (rad), plain, or arrays with the functions of NumPy."""
        wide, h = self.end - self.start, self.high - self.low
        if h == 0.0:
            return Lift(self.low + 0 * angle, 0.0 * angle, 0.0 * angle, 0.0 * angle)
        _, form = LAWS[self.by][self.which]
        f, f1, f2, f3 = form((angle - self.start) / wide, m)
        return Lift(self.low + h * f, h * f1 / wide, h * f2 / wide**2, h * f3 / wide**3)

    def extremes(self, order: int) -> tuple[tuple[float, float], ...]:
        """The first or second derivative at both ends and at its peaks inside, each with its angle (rad), in order."""
        peaks = PEAKS[self.by][order - 1] if self.by in PEAKS else ()
        inside = (self.start + x * (self.end - self.start) for x in peaks)
        return tuple((self.at(angle)[order], angle) for angle in (self.start, *inside, self.end))


@dataclass(frozen=True)
class LiftPiece:
    """A piece of the law between two cam angles (rad), from one lift to another (m or rad); ``by`` is "" of a dwell."""

    start: float
    end: float
    low: float
    high: float
    by: str

    @property
    def parts(self) -> tuple[SmoothPart, ...]:
        shares = [share for share, _ in LAWS[self.by]] if self.by else [1.0]
        angles = [self.start, *(self.start * (1.0 - share) + self.end * share for share in shares)]
        lifts = [self.low, *(self.low * (1.0 - share) + self.high * share for share in shares)]
        return tuple(
            SmoothPart(angles[k], angles[k + 1], lifts[k], lifts[k + 1], self.by, k) for k in range(len(shares))
        )


@dataclass(frozen=True)
class FollowerLaw:
    """The lift over a turn of the cam; a seam belongs to the later piece.

    >>> rise, fall = LiftPiece(0.0, math.pi, 0.0, 2.0, "harmonic"), LiftPiece(math.pi, TURN, 2.0, 0.0, "harmonic")
    >>> law = FollowerLaw((rise, fall))
    >>> round(law.at(math.pi / 2).lift, 12), law.at(-math.pi / 2).slope
    (1.0, -1.0)
    """

    pieces: tuple[LiftPiece, ...]

    @cached_property
    def parts(self) -> tuple[SmoothPart, ...]:
        return tuple(part for piece in self.pieces for part in piece.parts)

    @cached_property
    def starts(self) -> tuple[float, ...]:
        return tuple(part.start for part in self.parts)

    @cached_property
    def least(self) -> float:
        return min(piece.low for piece in self.pieces)

    @cached_property
    def greatest(self) -> float:
        return max(piece.low for piece in self.pieces)

    def reduced(self, angle: float) -> float:
        """An angle in [0, 2 pi), on a seam where it lies beside one by rounding."""
        within = angle % TURN
        for seam in (*self.starts[1:], TURN):
            if abs(within - seam) < SEAM:
                return seam if seam < TURN else 0.0
        return 0.0 if within < SEAM else within

    def part(self, angle: float) -> SmoothPart:
        """The part in which an angle (rad) lies."""
        return self.parts[bisect_right(self.starts, self.reduced(angle)) - 1]

    def piece(self, angle: float) -> LiftPiece:
        """The piece in which an angle (rad) lies."""
        within = self.reduced(angle)
        return next(piece for piece in reversed(self.pieces) if piece.start <= within)

    def at(self, angle: float) -> Lift:
        """Lift and derivatives at an angle of the cam (rad), of any turn."""
        return self.part(angle).at(self.reduced(angle))


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
    # asked of whatever moves a link: it neither rolls, nor does the scene give its value
    rolls: ClassVar[bool] = False
    given: ClassVar[bool] = False
    through: ClassVar[tuple[str, ...]] = ()

    @property
    def key(self) -> str:
        """What it is told from drivers by."""
        return f"cam {self.link}"

    @property
    def turns(self) -> bool:
        """Whether its follower swings, so that the lift is an angle."""
        return isinstance(self.motion, SwingingFollower)

    @property
    def links(self) -> tuple[str, ...]:
        """The links that give its follower's motion."""
        return (self.link,)

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
