"""The law of a driver: its value over the time, piece by piece, and from it rate and second rate at any moment.

The laws are those of cams (`graphkin.scene.cams`), over seconds instead of degrees of a cam.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from graphkin.errors import Problem
from graphkin.scene.cams import Lift, LiftPiece, SmoothPart, form_of
from graphkin.scene.contact_tables import DriverLaw
from graphkin.words import Phrase

__all__ = ["CubicPart", "MotionLaw", "law_of"]

ROUNDING = 1e-12
"""Of the way: so much nearer a value is reached."""
HALVINGS = 200
NOTHING = 1e-14
"""Of the way by the time, and by its square: a smaller rate is nothing but rounding."""


@dataclass(frozen=True)
class CubicPart:
    """A cubic between two moments (s), by its values (rad, m) and rates at both."""

    start: float
    end: float
    low: float
    high: float
    rate: float
    last_rate: float

    @property
    def parts(self) -> tuple[CubicPart, ...]:
        return (self,)

    @property
    def _bends(self) -> tuple[float, float]:
        """The factors of the square and of the cube of the time since its start."""
        wide = self.end - self.start
        mean = (self.high - self.low) / wide
        return (3 * mean - 2 * self.rate - self.last_rate) / wide, (self.rate + self.last_rate - 2 * mean) / wide**2

    def at(self, time: float) -> Lift:
        """Value and its derivatives at a moment inside (s)."""
        (b, c), x = self._bends, time - self.start
        return Lift(
            self.low + x * (self.rate + x * (b + x * c)), self.rate + x * (2 * b + x * 3 * c), 2 * b + 6 * c * x, 6 * c
        )

    @property
    def turns(self) -> tuple[float, ...]:
        """Moments inside at which it turns back."""
        b, c = self._bends
        square = b * b - 3 * c * self.rate
        if square <= 0.0:
            return ()
        half = -(b + math.copysign(math.sqrt(square), b))
        roots = [self.rate / half if half else 0.0, half / (3 * c) if c else 0.0]
        return tuple(sorted(self.start + x for x in roots if 0.0 < x < self.end - self.start))


@dataclass(frozen=True)
class MotionLaw:
    """A driver's value (rad, m) over the time (s), which begins at 0; a seam belongs to the later piece.

    ``time`` is the moment that is asked.

    >>> law = MotionLaw((LiftPiece(0.0, 2.0, 1.0, 4.0, "harmonic"),))
    >>> law.at(1.0).lift, round(law.at(1.0).slope, 6), law.reached(2.5)
    (2.5, 2.356194, 1.0)
    """

    pieces: tuple[LiftPiece | CubicPart, ...]
    time: float = 0.0

    @cached_property
    def parts(self) -> tuple[SmoothPart | CubicPart, ...]:
        return tuple(part for piece in self.pieces for part in piece.parts)

    @property
    def duration(self) -> float:
        return self.pieces[-1].end

    def at(self, time: float) -> Lift:
        """Value, rate, second and third rate at a moment (s); before and after it stands still."""
        part = next((part for part in reversed(self.parts) if part.start <= time), self.parts[0])
        if self.pieces[0].start <= time <= self.duration:
            found = part.at(time)
            wide, way = part.end - part.start, max(abs(part.high - part.low), abs(part.low), abs(part.high))
            rates = (x if abs(x) > NOTHING * way / wide**k else 0.0 for k, x in enumerate(found[1:], 1))
            return Lift(found.lift, *rates)
        return Lift(part.low if time < part.start else part.high, 0.0, 0.0, 0.0)

    @cached_property
    def _runs(self) -> tuple[tuple[SmoothPart | CubicPart, float, float], ...]:
        """Stretches of the time in which the value grows, falls, or stands."""
        found = []
        for part in self.parts:
            ends = (part.start, *(part.turns if isinstance(part, CubicPart) else ()), part.end)
            found += [(part, a, b) for a, b in pairwise(ends)]
        return tuple(found)

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
                    if (part.at(middle).lift - value) * first > 0.0:
                        low = middle
                    else:
                        high = middle
                return (low + high) / 2
            if abs(last) <= near:
                return high
        return None


def law_of(where: str, table: DriverLaw, unit: float, problems: list[Problem]) -> MotionLaw | None:
    """The law that a driver's table says, in rad or m and s; what is wrong with it is added to ``problems``."""
    ways = {
        "table": bool(table.table),
        "pieces": bool(table.pieces),
        "by": any(x is not None for x in (table.to, table.rise, table.duration, table.by)),
    }
    given = [name for name, there in ways.items() if there]
    if len(given) != 1:
        found = Phrase("says its motion by", ways=", ".join(given)) if given else Phrase("says nothing")
        problems.append(Problem(where, found, Phrase("write from and to or pieces or a table")))
        return None
    if given == ["table"]:
        return _by_table(where, table, unit, problems)
    wrong: list[Problem] = []
    start = (table.origin or 0.0) * unit
    if table.origin is None:
        wrong.append(Problem(f"{where}.from", Phrase("is missing"), Phrase("write the driver's value at 0 s")))
    pieces = _one(where, table, unit, wrong) if given == ["by"] else _several(where, table, unit, start, wrong)
    problems += wrong
    return None if wrong else MotionLaw(tuple(pieces))


def _one(where: str, table: DriverLaw, unit: float, wrong: list[Problem]) -> list[LiftPiece]:
    if (table.to is None) == (table.rise is None):
        both = Phrase("stands beside rise") if table.to is not None else Phrase("is missing")
        wrong.append(Problem(f"{where}.to", both, Phrase("write to the value at the end or")))
    if table.duration is None:
        wrong.append(Problem(f"{where}.duration", Phrase("is missing"), Phrase("write the seconds that it takes")))
    if table.by is None:
        wrong.append(
            Problem(f"{where}.by", Phrase("is missing"), Phrase("write by cycloidal harmonic 345 or another law"))
        )
    start = table.origin or 0.0
    end = table.to if table.to is not None else start + (table.rise or 0.0)
    return [LiftPiece(0.0, table.duration or 1.0, start * unit, end * unit, form_of(table.by))]


def _several(where: str, table: DriverLaw, unit: float, start: float, wrong: list[Problem]) -> list[LiftPiece]:
    pieces: list[LiftPiece] = []
    time, low = 0.0, start
    for i, piece in enumerate(table.pieces, 1):
        here = f"{where}.pieces.{i}"
        moves = piece.rise is not None or piece.fall is not None
        if piece.rise is not None and piece.fall is not None:
            wrong.append(Problem(here, Phrase("has both rise and fall"), Phrase("give one of them or none for a")))
        if moves != (piece.by is not None):
            said = Phrase("does not say its law") if moves else Phrase("has by without rise or fall", by=piece.by)
            wrong.append(Problem(here, said, Phrase("a rise or fall has by a dwell")))
        if not piece.to > time:
            wrong.append(
                Problem(
                    here,
                    Phrase("ends at s where it begins at", to=f"{piece.to:g}", time=f"{time:g}"),
                    Phrase("seconds grow"),
                )
            )
        high = low + ((piece.rise or 0.0) - (piece.fall or 0.0)) * unit
        pieces.append(LiftPiece(time, piece.to, low, high, form_of(piece.by)))
        time, low = piece.to, high
    return pieces


def _by_table(where: str, table: DriverLaw, unit: float, problems: list[Problem]) -> MotionLaw | None:
    here = f"{where}.table"
    if table.origin is not None:
        problems.append(
            Problem(f"{where}.from", Phrase("stands beside a table"), Phrase("the table says where it begins"))
        )
        return None
    times, values = [t for t, _ in table.table], [v * unit for _, v in table.table]
    if len(times) < 2:
        problems.append(Problem(here, Phrase("has one row"), Phrase("write time value two rows or more")))
        return None
    for i, (a, b) in enumerate(pairwise(times), 2):
        if not b > a:
            problems.append(
                Problem(
                    f"{here}.{i}",
                    Phrase("is at s after one at s", other=f"{b:g}", name=f"{a:g}"),
                    Phrase("seconds grow"),
                )
            )
            return None
    rates = _spline(times, values)
    rows = zip(times, times[1:], values, values[1:], rates, rates[1:], strict=False)
    return MotionLaw(tuple(CubicPart(*row) for row in rows), times[0])


def _spline(times: Sequence[float], values: Sequence[float]) -> list[float]:
    """The rates at its knots of the cubic spline without acceleration at both ends (de Boor, A Practical Guide to
    Splines, ch. 4), by elimination."""
    n = len(times)
    wide = [b - a for a, b in pairwise(times)]
    mean = [(b - a) / w for a, b, w in zip(values, values[1:], wide, strict=False)]
    before, right = [0.5], [1.5 * mean[0]]
    for k in range(1, n - 1):
        # wide[k] s[k-1] + 2 (wide[k-1] + wide[k]) s[k] + wide[k-1] s[k+1] = 3 (wide[k] mean[k-1] + wide[k-1] mean[k])
        main = 2 * (wide[k - 1] + wide[k]) - wide[k] * before[-1]
        right.append((3 * (wide[k] * mean[k - 1] + wide[k - 1] * mean[k]) - wide[k] * right[-1]) / main)
        before.append(wide[k - 1] / main)
    rates = [(3 * mean[-1] - right[-1]) / (2 - before[-1])]
    for k in range(n - 2, -1, -1):
        rates.insert(0, right[k] - before[k] * rates[0])
    return rates
