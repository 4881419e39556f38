"""Laws of motion, piece by piece, with their derivatives: the lift of a cam's follower over the angle of the cam, and
the value of a driver over the time; in SI units.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from types import ModuleType
from typing import NamedTuple

from graphkin.plane import Values

ROUNDING = 1e-12
"""Of the way: so much nearer a value is reached."""
HALVINGS = 200
NOTHING = 1e-14
"""Of the way by the time, and by its square: a smaller rate is nothing but rounding."""
DOUBT = 256 * 2.0**-53, 64 * 2.0**-53, 320 * 2.0**-53
"""How far rounding may move a value, a rate and a second rate, of the way by the time and by its square: the greatest
sums of terms that cancel in the laws, and the next derivative times the rounding of the share of the time."""

TURN = 2 * math.pi
CHORDS = 40
"""Along a lift at least: so no chord is more than 1/1600 of it off its curve."""
SEAM = 1e-12
"""An angle (rad) nearer than this before a seam belongs to the piece after it."""


class Lift(NamedTuple):
    """Lift and its first three derivatives by the angle of the cam (m or rad, per rad)."""

    lift: Values
    slope: Values
    second: Values
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


def form_of(by: str | None) -> str:
    """The name of a law in its plain spelling: "3-4-5" is "345"; "" for a dwell."""
    return (by or "").replace("-", "")


@dataclass(frozen=True)
class LiftPiece:
    """A piece of a law between two angles of the cam (rad) or moments (s), from one value to another (m or rad); ``by``
    is the law, "" for a dwell.  Its ``parts`` have derivatives of every order: the piece itself, or of a parabolic
    piece the halves, told by ``which``.  Between two rows of a table it is the cubic with these ``rates`` at its
    ends."""

    start: float
    end: float
    low: float
    high: float
    by: str
    which: int = 0
    rates: tuple[float, float] | None = None

    @property
    def parts(self) -> tuple[LiftPiece, ...]:
        if self.rates is not None:
            return (self,)
        shares = [0.0, *(share for share, _ in LAWS[self.by])] if self.by else [0.0, 1.0]
        angles, lifts = ([a * (1.0 - share) + b * share for share in shares]
                         for a, b in ((self.start, self.end), (self.low, self.high)))
        ends = zip(pairwise(angles), pairwise(lifts), strict=True)
        return tuple(LiftPiece(*angle, *lift, self.by, k) for k, (angle, lift) in enumerate(ends))

    def at(self, angle: Values, m: ModuleType = math) -> Lift:
        """The lift of a part at angles inside (rad), plain, or arrays with the functions of NumPy."""
        wide, h = self.end - self.start, self.high - self.low
        if self.rates is not None:
            (first, _), (b, c), x = self.rates, self._bends, angle - self.start
            value, rate = self.low + x * (first + x * (b + x * c)), first + x * (2 * b + x * 3 * c)
            return Lift(value, rate, 2 * b + 6 * c * x, 6 * c)
        if h == 0.0:
            return Lift(self.low + 0 * angle, 0.0 * angle, 0.0 * angle, 0.0 * angle)
        _, form = LAWS[self.by][self.which]
        f, f1, f2, f3 = form((angle - self.start) / wide, m)
        return Lift(self.low + h * f, h * f1 / wide, h * f2 / wide**2, h * f3 / wide**3)

    def places(self, around: int) -> tuple[float, ...]:
        """Angles (rad) of a part's drawing from end to end, at least so many to a turn."""
        count = max(CHORDS if self.high != self.low else 2, math.ceil(around * (self.end - self.start) / TURN))
        return tuple(self.start + (self.end - self.start) * k / count for k in range(count + 1))

    def extremes(self, order: int) -> tuple[tuple[float, float], ...]:
        """The first or second derivative of a part at both ends and at its peaks inside, each with its angle (rad), in
        order."""
        peaks = PEAKS[self.by][order - 1] if self.by in PEAKS else ()
        inside = (self.start + x * (self.end - self.start) for x in peaks)
        return tuple((self.at(angle)[order], angle) for angle in (self.start, *inside, self.end))

    @property
    def _bends(self) -> tuple[float, float]:
        """The factors of the square and the cube of the time since the start of a cubic."""
        (first, last), wide = self.rates or (0.0, 0.0), self.end - self.start
        mean = (self.high - self.low) / wide
        return (3 * mean - 2 * first - last) / wide, (first + last - 2 * mean) / wide**2

    @property
    def turns(self) -> tuple[float, ...]:
        """Moments inside at which a cubic turns back; the laws do not."""
        if self.rates is None:
            return ()
        (rate, _), (b, c) = self.rates, self._bends
        square = b * b - 3 * c * rate
        if square <= 0.0:
            return ()
        half = -(b + math.copysign(math.sqrt(square), b))
        roots = [rate / half if half else 0.0, half / (3 * c) if c else 0.0]
        return tuple(sorted(self.start + x for x in roots if 0.0 < x < self.end - self.start))


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
    def parts(self) -> tuple[LiftPiece, ...]:
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

    def part(self, angle: float) -> LiftPiece:
        """The part in which an angle (rad) lies."""
        return self.parts[bisect_right(self.starts, self.reduced(angle)) - 1]

    def at(self, angle: float) -> Lift:
        """Lift and derivatives at an angle of the cam (rad), of any turn."""
        return self.part(angle).at(self.reduced(angle))


@dataclass(frozen=True)
class MotionLaw:
    """A driver's value (rad, m) over the time (s), which begins at 0; a seam belongs to the later piece.

    ``time`` is the moment of the question.

    >>> law = MotionLaw((LiftPiece(0.0, 2.0, 1.0, 4.0, "harmonic"),))
    >>> law.at(1.0).lift, round(law.at(1.0).slope, 6), law.reached(2.5)
    (2.5, 2.356194, 1.0)
    """

    pieces: tuple[LiftPiece, ...]
    time: float = 0.0

    @cached_property
    def parts(self) -> tuple[LiftPiece, ...]:
        return tuple(part for piece in self.pieces for part in piece.parts)

    @property
    def duration(self) -> float:
        return self.pieces[-1].end

    def at(self, time: float) -> Lift:
        """Value, rate, second and third rate at a moment (s); before and after it stands still."""
        part = next((part for part in reversed(self.parts) if part.start <= time), self.parts[0])
        if self.pieces[0].start <= time <= self.duration:
            lift = part.at(time)
            wide, largest = part.end - part.start, max(abs(part.high - part.low), abs(part.low), abs(part.high))
            rates = (x if abs(x) > NOTHING * largest / wide**k else 0.0 for k, x in enumerate(lift[1:], 1))
            return Lift(lift.lift, *rates)
        return Lift(part.low if time < part.start else part.high, 0.0, 0.0, 0.0)

    @cached_property
    def doubts(self) -> tuple[float, float, float]:
        """How far rounding may move value, rate and second rate at any moment (rad or m, by s and by s2)."""
        most = [0.0, 0.0, 0.0]
        for part in self.parts:
            wide = part.end - part.start
            height = abs(part.high - part.low) + 4 * wide * max(map(abs, part.rates or (0.0,)))
            later = part.end / wide  # the share of the time is rounded by so much more
            sizes = max(abs(part.low), abs(part.high)) + height * later, height * later / wide, height * later / wide**2
            most = [max(before, doubt * size) for before, doubt, size in zip(most, DOUBT, sizes, strict=True)]
        return most[0], most[1], most[2]

    @cached_property
    def _runs(self) -> tuple[tuple[LiftPiece, float, float], ...]:
        """Stretches of the time in which the value grows, falls, or stands."""
        return tuple((part, a, b) for part in self.parts for a, b in pairwise((part.start, *part.turns, part.end)))

    @cached_property
    def span(self) -> tuple[float, float]:
        """The least and the greatest value."""
        values = [part.at(t).lift for part, a, b in self._runs for t in (a, b)]
        return min(values), max(values)

    def reached(self, value: float) -> float | None:
        """The first moment at which it comes to a value, None if it never does."""
        near = ROUNDING * max(abs(end) for end in (*self.span, self.span[1] - self.span[0]))
        for part, low, high in self._runs:
            first, last = part.at(low).lift - value, part.at(high).lift - value
            if abs(first) <= near:
                return low
            if first * last < 0.0 and abs(last) > near:
                for _ in range(HALVINGS):
                    middle = (low + high) / 2
                    before = (part.at(middle).lift - value) * first > 0.0
                    low, high = (middle, high) if before else (low, middle)
                return (low + high) / 2
            if abs(last) <= near:
                return high
        return None
