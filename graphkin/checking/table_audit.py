"""Values of many positions judged at the speed of the solver: by their digits, before anything is drawn."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

from graphkin.checking.audit import COMPUTED_SHARE, Judged, Value, comparable, deviation, difference
from graphkin.checking.printed import Printed
from graphkin.plane import unit
from graphkin.scene.symbol import Symbol
from graphkin.solver import Motion, value_of

__all__ = ["Exact", "exact_rows", "judged_by_digits"]

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
    rounded; drawn ones by what a pencil keeps within (``bound``, SI)."""
    off = abs(difference(printed, exact))
    share = deviation(printed, exact)
    if off <= printed.rounding + 1e-9 * abs(exact):
        return Judged(printed, exact, share, "right", bound)
    if by == "computation":
        near = off <= printed.rounding + COMPUTED_SHARE * abs(exact)
        return Judged(printed, exact, share, "right" if near else "wrong", 0.0)
    near = math.isfinite(bound) and off <= bound + printed.coarse
    return Judged(printed, exact, share, "within drafting accuracy" if near else "wrong", bound)
