"""Judging stated values: right, within drafting accuracy, or wrong, and then what the wrong one looks like.

What a wrong value looks like is the likeliest of the known slips by Bayes' rule: how often it is made, times how well
its value fits the digits stated, as a number computed (to its last digit) or drawn (with the predicted deviation).  A
value is called by no name where no slip fits much better than chance.

Whole tables of positions are judged by their digits at the speed of the solver, before anything is drawn.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Literal

import numpy as np

from graphkin.checking.loop_gaps import loop_gaps
from graphkin.checking.slip_likelihood import (
    CHANCE,
    COMPUTED,
    NEVER,
    Suspect,
    Suspects,
    Weighing,
    comparable,
    likelihood,
    transcription_errors,
)
from graphkin.checking.slips import CANCELLING, NOTHING, Evidence
from graphkin.scene.symbol import Line, PointRef, Printed, Symbol, Value
from graphkin.solver import Motion, forces_of, listed_points, senses_along, value_of
from graphkin.solver.pose import Array
from graphkin.words import Phrase

__all__ = [
    "Judged", "Value", "computing_errors", "exact_rows", "explained", "explained_by_digits", "judge",
    "judged_by_digits", "with_gaps",
]  # fmt: skip

Verdict = Literal["right", "within drafting accuracy", "right from own values", "wrong", "not judged"]

RIGHT_SHARE = 0.7  # drawn values that are right but for drafting errors
SURER = 10.0  # so much likelier must a slip be than drafting errors, to call a value in their reach wrong
DIGITS = 5  # fewer digits than this tell no slip from an error of drafting
FAR, FEW_DIGITS = 0.1, 3  # but so far off, to this many digits, they do
COMPUTED_SHARE = 1e-4  # a computed value may be off by so much of itself, for inputs that were rounded
LEAST_TURN = math.radians(1.5)  # directions are read off with a protractor
TELLING = 4  # digits from which a number can be told to be another


@dataclass(frozen=True)
class Judged:
    """One stated value with its verdict.

    ``exact`` is what it is held against: signed where it has a sense, a complex number against two components, else
    the size of the vector (SI).  ``deviation`` is the relative one, None where the exact value is zero; ``bound`` what
    a pencil drawing keeps within (0 where nothing can be predicted, infinite where it keeps within nothing: then a
    value that is not right is "not judged", unless a slip explains it to the digit).  ``follows_from`` are earlier
    wrong values of the same person from which it follows.  ``gap`` tells of a wrong angle or travel the vector loop
    that gives it, and how far that stays open with all stated values in it (m).
    """

    printed: Printed
    exact: Value
    deviation: float | None
    verdict: Verdict
    bound: float
    looks_like: Phrase | None = None
    follows_from: tuple[Symbol, ...] = ()
    gap: tuple[str, float] | None = None


def with_gaps(case: Evidence, judged: Sequence[Judged]) -> tuple[Judged, ...]:
    """Verdicts with the gaps of the loops of what is wrong."""
    wrong = {j.printed.symbol for j in judged if j.verdict == "wrong"}
    gaps = loop_gaps(case.sheet, {j.printed.symbol: j.printed.value for j in judged})
    return tuple(replace(j, gap=gaps.get(j.printed.symbol)) if j.printed.symbol in wrong else j for j in judged)


def judge(case: Evidence, stated: Sequence[Printed]) -> tuple[Judged, ...]:
    """Judge the values of one person."""
    first = [_judged(case, p) for p in stated]
    wrong = [j.printed.symbol for j in first if j.verdict == "wrong"]
    own = {p.symbol: p.value for p in stated}
    return tuple(
        explained(case, j, own, wrong) if j.verdict == "wrong" and j.looks_like is None else j for j in first
    )


def _judged(case: Evidence, printed: Printed) -> Judged:
    symbol = printed.symbol
    held = case.held(symbol)
    bound, exact = held.bound, comparable(printed, held.right, held.line)
    off = abs(difference(printed, exact))
    share = deviation(printed, exact)
    judged = Judged(printed, exact, share, "right", bound)
    turned = _turned(case, judged, held.right)
    nothing = NOTHING * held.largest if exact == 0 and symbol.scope in CANCELLING else 0.0
    if off <= printed.rounding + max(1e-9 * abs(exact), nothing):
        return turned or judged
    if math.isinf(bound):
        judged = replace(judged, verdict="not judged")
        fits = [s for s, _ in _weighed(case, judged) if not s.copied and _fits_to_the_digit(judged, s, case)]
        if printed.sure_digits < DIGITS or not fits or off <= printed.coarse + COMPUTED * abs(exact):
            return judged
        return replace(judged, verdict="wrong", looks_like=max(fits, key=lambda s: s.share).phrase)
    if off > bound + printed.coarse:
        return replace(judged, verdict="wrong")
    judged = replace(judged, verdict="within drafting accuracy")
    if turned:
        return turned
    far = printed.digits >= FEW_DIGITS and off > FAR * abs(exact)
    if far or (printed.sure_digits >= DIGITS and off > NEVER * abs(exact)):
        best = max(_weighed(case, judged), key=lambda w: w[1], default=None)
        drawn = RIGHT_SHARE * likelihood(printed, off, bound / 3, exact)
        if best and best[1] > SURER * drawn and _fits_to_the_digit(judged, best[0], case):
            return replace(judged, verdict="wrong", looks_like=best[0].phrase)
    return judged


def _turned(case: Evidence, judged: Judged, right: Value) -> Judged | None:
    """A value whose size is right and whose stated direction, or line, is not, by what it looks like."""
    printed = judged.printed
    if not right or printed.symbol.measure == "angle":
        return None
    true = cmath.phase(complex(right))
    drawn = judged.bound / abs(right) if math.isfinite(judged.bound) else math.pi
    reach = max(LEAST_TURN, min(drawn, math.pi / 6))
    told = [(printed.direction, reach + printed.room * (1 + 1e-9), printed.either)]
    told += [(_angle_of(case, line), reach, not line.directed) for line in printed.lines]
    for angle, room, either in told:
        if angle is None or _near(true - angle, room, either):
            continue
        ways = (("slip turned back", math.pi), ("slip mirrored", -2 * true), ("slip mirrored", math.pi - 2 * true),
                ("slip square", math.pi / 2), ("slip square", -math.pi / 2))  # fmt: skip
        key = next((key for key, turn in ways if _near(true + turn - angle, room, either)), "slip direction")
        off = math.degrees(math.remainder(angle - true, math.pi if either else math.tau))
        return replace(judged, verdict="wrong", looks_like=Phrase(key, (f"{off:+.0f}",)))
    return None


def _near(off: float, room: float, either: bool) -> bool:
    return abs(math.remainder(off, math.pi if either else math.tau)) <= room


def _angle_of(case: Evidence, line: Line) -> float | None:
    """The angle of a line (rad), None where its points are not drawn."""
    one, two = (case.sheet.points.get(PointRef(name)) for name in (line.one, line.two))
    if one is None or two is None or one == two:
        return None
    return cmath.phase((two - one) * (1j if line.square else 1.0))


def difference(printed: Printed, exact: Value) -> Value:
    """A printed value less the exact one; of an angle without whole turns."""
    off = printed.value - exact
    return math.remainder(off.real, math.tau) if printed.symbol.measure == "angle" else off


def deviation(printed: Printed, exact: Value) -> float | None:
    if exact == 0:
        return None
    if isinstance(exact, complex):
        return abs(printed.value - exact) / abs(exact)
    return difference(printed, exact).real / exact


def explained(
    case: Evidence, judged: Judged, own: Mapping[Symbol, Value], wrong: Iterable[Symbol], drawn: bool = True
) -> Judged:
    """A wrong value with what it looks like; one that is right on somebody's own earlier values is so called.

    ``drawn`` is whether it may have been drawn badly, which no computed value was.
    """
    symbol = judged.printed.symbol
    chance = CHANCE / max(abs(judged.printed.value), abs(judged.exact), judged.printed.step)
    found = list(_weighed(case, judged))
    others = [s for s in wrong if s != symbol and case.consequences.before(s, symbol)]
    if others:
        found += _following(case, judged, own, others, chance)
    best = max(found, key=lambda w: w[1], default=None)
    if (best is None or best[1] <= chance) and drawn:
        every = Suspects((*case.suspects(symbol).all, *(s for s, _ in found if s.follows_from)))
        best = _weighing(case, judged).drawn_badly(every)
    if best is None or (not drawn and best[1] <= chance):
        return judged
    verdict: Verdict = "right from own values" if best[0].follows_from else "wrong"
    return replace(judged, verdict=verdict, looks_like=best[0].phrase, follows_from=best[0].follows_from)


def _following(
    case: Evidence, judged: Judged, own: Mapping[Symbol, Value], others: Sequence[Symbol], chance: float
) -> Iterator[tuple[Suspect, float]]:
    """What a value comes to when the drawing is gone on with from earlier wrong ones."""
    symbol = judged.printed.symbol
    line = case.held(symbol).line
    for value in case.consequences.values(own, symbol):
        if abs(comparable(judged.printed, value, line) - judged.exact) <= judged.bound / 3:
            continue
        follows = Suspects((Suspect(Phrase("slip follows"), value, 0.5),))
        for one, weight in _weighing(case, judged).weighed(follows):
            names = tuple(s for s in others if _moves(case, own, s, symbol, judged)) if weight > chance else ()
            if names:
                phrase = Phrase("slip follows", (", ".join(str(s) for s in names),))
                yield replace(one, phrase=phrase, follows_from=names), weight


def _moves(case: Evidence, own: Mapping[Symbol, Value], one: Symbol, symbol: Symbol, judged: Judged) -> bool:
    """Whether one wrong value, taken for granted, moves another by more than drafting errors do."""
    line = case.held(symbol).line
    moved = case.consequences.values({one: own[one]}, symbol)
    return any(abs(comparable(judged.printed, v, line) - judged.exact) > judged.bound / 3 for v in moved)


def _weighing(case: Evidence, judged: Judged) -> Weighing:
    return Weighing(judged.printed, judged.exact, judged.bound, case.held(judged.printed.symbol).line)


def _weighed(case: Evidence, judged: Judged) -> Iterator[tuple[Suspect, float]]:
    """Every explanation that fits, with its weight."""
    weighing = _weighing(case, judged)
    yield from weighing.weighed(case.suspects(judged.printed.symbol))
    yield from weighing.copied()


def _fits_to_the_digit(judged: Judged, suspect: Suspect, case: Evidence) -> bool:
    if suspect.copied:
        return True
    value = comparable(judged.printed, suspect.value, case.held(judged.printed.symbol).line)
    return abs(judged.printed.value - value) <= judged.printed.rounding + COMPUTED * abs(value)


# -- tables, by their digits -------------------------------------------------------------------------------------------

Exact = Callable[[int, Printed], Value]
"""The exact value that a stated one is held against, by the number of the position in a motion."""


def exact_rows(motion: Motion, symbols: Sequence[Symbol], of_turn: Mapping[Symbol, float]) -> Exact:
    """What gives the exact value that a stated one is held against, by the number of the position in a motion.

    Parameters
    ----------
    of_turn : the quantities of the whole turn, which are the same at all positions
    """
    largest = computing_errors(motion, symbols)
    columns = {}
    for s in symbols:
        if s not in of_turn:
            column = value_of(motion, s)
            nothing = NOTHING / COMPUTED_SHARE * largest[s] if s in largest else _rounding(motion, s)
            columns[s] = np.where(np.abs(column) <= nothing, 0.0, column).tolist()
    lines: dict[Symbol, Array | None] = {}

    def exact(row: int, printed: Printed) -> Value:
        symbol = printed.symbol
        if symbol in of_turn:
            return of_turn[symbol]
        value = columns[symbol][row]
        if symbol not in lines:
            lines[symbol] = senses_along(motion, symbol)
        line = lines[symbol]
        return comparable(printed, value, None if line is None else complex(line[row]))

    return exact


def _rounding(motion: Motion, symbol: Symbol) -> Array | float:
    """What rounding leaves of a force or a moment that is none (SI), shape (n,)."""
    return np.nan_to_num(forces_of(motion).bound[symbol.measure == "moment"]) if symbol.scope == "force" else 0.0


def computing_errors(motion: Motion, symbols: Sequence[Symbol]) -> dict[Symbol, Array]:
    """How far a computation may be off that goes on with rounded numbers, for quantities of the motion: shape (n,), SI.

    What cancels keeps the errors of what it is the difference of.  So `COMPUTED_SHARE` is taken of a velocity (an
    acceleration) as large as the largest of any point in the same position, of a rate of a bar with that at one of its
    ends, of a place as far as the mechanism reaches, of an angle of 1 rad; a rate in r/min is taken to four figures in
    rad/s, which shows once in velocities and twice in accelerations.  Others may be off by the share of themselves.
    """
    places = listed_points(motion.scene, motion.slides)
    motions = [motion.point(point, link) for point, link in places]
    none = np.zeros(len(motion))
    speed = np.max([none, *(np.abs(p.v) + none for p in motions)], axis=0)
    acceleration = np.max([none, *(np.abs(p.a) + none for p in motions)], axis=0)
    reach = np.max([none, *(np.abs(p.z) + none for p in motions)], axis=0)
    rate = max((_rounded_off(d.rate) for d in motion.scene.drivers if d.turns and d.rpm), default=0)
    first, second = COMPUTED_SHARE + rate, COMPUTED_SHARE + 2 * rate
    found = {}
    for symbol in symbols:
        arm = _reach_of(motion, symbol.link)
        errors = {
            "velocity": first * speed, "acceleration": second * acceleration, "length": COMPUTED_SHARE * reach,
            "angle": COMPUTED_SHARE + none, "angular velocity": first * speed / arm if arm else none,
            "angular acceleration": second * acceleration / arm if arm else none,
        }  # fmt: skip
        if symbol.scope in ("motion", "position") and symbol.measure in errors:
            own = {"velocity": first, "angular velocity": first, "acceleration": second, "angular acceleration": second}
            size = np.abs(value_of(motion, symbol))
            found[symbol] = np.maximum(errors[symbol.measure], own.get(symbol.measure, COMPUTED_SHARE) * size)
    return found


def _rounded_off(rate: float) -> float:
    """The part of a rate (rad/s) that is lost when it is written to four figures."""
    return abs(float(f"{rate:.4g}") / rate - 1.0) if rate else 0.0


def _reach_of(motion: Motion, link: str) -> float:
    """The distance of the two points of a link, or of one that it slides on, that are farthest from each other (m); 0
    where it has but one."""
    turning = {link, *(slide.b for slide in motion.slides if slide.a == link)} - {motion.scene.frame.name}
    bars = [motion.scene.by_name[name].points.values() for name in turning if name in motion.scene.by_name]
    return max((abs(one - other) for places in bars for one, other in combinations(places, 2)), default=0.0)


def judged_by_digits(printed: Printed, exact: Value, by: str, bound: float) -> Judged:
    """A stated value judged by its digits: computed ones may be off by ``bound`` too, and by `COMPUTED_SHARE` of
    themselves, for numbers that were rounded on the way; drawn ones by what a pencil keeps within (``bound``, SI;
    infinite where nothing can be judged)."""
    off = abs(difference(printed, exact))
    share = deviation(printed, exact)
    if by == "computation":
        near = off <= printed.rounding + max(bound, COMPUTED_SHARE * abs(exact))
        return Judged(printed, exact, share, "right" if near else "wrong", 0.0)
    if off <= printed.rounding + 1e-9 * abs(exact):
        return Judged(printed, exact, share, "right", bound)
    if math.isinf(bound):
        return Judged(printed, exact, share, "not judged", bound)
    near = off <= bound + printed.coarse
    return Judged(printed, exact, share, "within drafting accuracy" if near else "wrong", bound)


def explained_by_digits(
    judged: Judged, exact: Exact, row: int, symbols: Sequence[Symbol], names: Sequence[str]
) -> Judged:
    """A wrong value of a table with what its digits are: the right one with a slip of the pen or a sign, that of
    another row or of another column.

    Parameters
    ----------
    symbols, names : of the columns and rows of the table
    """
    printed = judged.printed
    if printed.digits < TELLING or isinstance(printed.value, complex):
        return judged
    ways = _ways(judged, exact, row, symbols, names)
    near = COMPUTED_SHARE * abs(printed.value) / 10
    phrase = next((phrase for phrase, value in ways if abs(printed.value - value) <= printed.rounding + near), None)
    return judged if phrase is None else replace(judged, looks_like=phrase)


def _ways(
    judged: Judged, exact: Exact, row: int, symbols: Sequence[Symbol], names: Sequence[str]
) -> Iterator[tuple[Phrase, Value]]:
    printed, right = judged.printed, judged.exact
    value: Value = -right
    yield Phrase("slip sign"), value
    for power in (1, 2, 3):
        for factor in (10.0**power, 0.1**power):
            yield Phrase("slip factor", (f"{factor:g}",)), right * factor
    for text, _, value in transcription_errors(printed):
        if abs(value - right) <= printed.rounding + 0.1 * COMPUTED_SHARE * abs(right):
            yield Phrase("slip pen", (text,)), printed.value
    others = sorted((k for k in range(len(names)) if k != row), key=lambda k: abs(k - row))
    for k in others:
        yield Phrase("slip position", (names[k],)), exact(k, printed)
    for symbol in symbols:
        if symbol != printed.symbol and (symbol.is_vector or not isinstance(printed.value, complex)):
            value = exact(row, replace(printed, symbol=symbol))
            yield Phrase("slip other", (str(symbol),)), value
