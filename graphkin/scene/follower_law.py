"""The law of a follower: its lift over the angle of the cam, piece by piece, with three derivatives.

A further law is its form and a row of `LAWS`; scenes, the schema, the solver, figures and sentences know it by that.
Laws after Norton, Cam Design and Manufacturing Handbook, ch. 2 and 3, and Sun Huan, Mechanical Principles, ch. 9.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import ModuleType
from typing import NamedTuple

from graphkin.plane import Values

__all__ = ["LAWS", "SPELLINGS", "FollowerLaw", "Lift", "LiftPiece", "SmoothPart", "form_of"]

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
