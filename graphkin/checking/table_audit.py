"""Values of many positions judged at the speed of the solver: by their digits, before anything is drawn."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

from graphkin.checking.audit import COMPUTED_SHARE, Judged, deviation, difference
from graphkin.checking.slip_likelihood import comparable, transcription_errors
from graphkin.plane import unit
from graphkin.scene.printed import Printed
from graphkin.scene.symbol import Symbol, Value
from graphkin.solver import Motion, value_of
from graphkin.words import Phrase

__all__ = ["Exact", "exact_rows", "explained_by_digits", "judged_by_digits"]

Exact = Callable[[int, Printed], Value]


def exact_rows(motion: Motion, symbols: Sequence[Symbol], of_turn: Mapping[Symbol, float]) -> Exact:
    """What gives the exact value that a stated one is held against, by the number of the position in a motion.

    Parameters
    ----------
    of_turn : the quantities of the whole turn, which are the same at all positions
    """
    columns = {s: value_of(motion, s).tolist() for s in symbols if s not in of_turn}

    def exact(row: int, printed: Printed) -> Value:
        symbol = printed.symbol
        if symbol in of_turn:
            return of_turn[symbol]
        value = columns[symbol][row]
        signed = symbol.is_vector and not isinstance(printed.value, complex) and printed.value < 0
        return comparable(printed, value, _line(motion, symbol, row) if signed else None)

    return exact


def _line(motion: Motion, symbol: Symbol, row: int) -> complex | None:
    """Unit vector of the positive sense of a vector that lies along a guide, None where nothing gives it one."""
    of, to, frame = symbol.of, symbol.to, motion.scene.frame.name
    if of is None:
        return None
    for slide in motion.slides:
        mine = motion.structure.links[slide.a].points if slide.a in motion.structure.links else {}
        if to is None:
            along = slide.b == frame and (of.link == slide.a or (not of.link and of.point in mine))
        else:
            along = slide.pin == of.point == to.point and {of.link, to.link} - {""} <= {slide.a, slide.b}
        if along and symbol.kind in ("v", "a", "ar"):
            return unit(complex(motion.poses[slide.b].u[row]) * slide.guide.direction)
    return None


def judged_by_digits(printed: Printed, exact: Value, by: str, bound: float) -> Judged:
    """A stated value judged by its digits: computed ones may be off by 1e-4 of themselves too, for inputs that were
    rounded; drawn ones by what a pencil keeps within (``bound``, SI; infinite where nothing can be judged)."""
    off = abs(difference(printed, exact))
    share = deviation(printed, exact)
    if off <= printed.rounding + 1e-9 * abs(exact):
        return Judged(printed, exact, share, "right", bound)
    if by == "computation":
        near = off <= printed.rounding + COMPUTED_SHARE * abs(exact)
        return Judged(printed, exact, share, "right" if near else "wrong", 0.0)
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

