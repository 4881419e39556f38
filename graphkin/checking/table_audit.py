"""Values of many positions judged at the speed of the solver: by their digits, before anything is drawn."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from graphkin.checking.audit import COMPUTED_SHARE, Judged, deviation, difference
from graphkin.checking.slip_likelihood import comparable, transcription_errors
from graphkin.checking.slips import NOTHING
from graphkin.scene.model import AngleDriver
from graphkin.scene.printed import Printed
from graphkin.scene.symbol import Symbol, Value
from graphkin.solver import Motion, forces_of, listed_points, senses_along, value_of
from graphkin.solver.pose import Array
from graphkin.words import Phrase

__all__ = ["Exact", "computing_errors", "exact_rows", "explained_by_digits", "judged_by_digits"]

Exact = Callable[[int, Printed], Value]


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
    rate = max((_rounded_off(d.omega) for d in motion.scene.drivers if isinstance(d, AngleDriver) and d.rpm), default=0)
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


TELLING = 4  # digits from which a number can be told to be another


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

