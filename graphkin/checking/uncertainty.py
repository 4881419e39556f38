"""How far a reading may lie off, before it is drawn: first order, from every act that leads to it.

Each act of the hand (a point pricked, a direction set, a length laid off or read) is made wrong once by one standard
deviation, the rest exactly; what that does to a reading is its sensitivity times the deviation, and the squares add up
(Guide to the expression of uncertainty in measurement, 5.1).  Crossing angles, lengths and scales come in by the
construction itself.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.checking.readings import read_off
from graphkin.drafting import Plan, execute, nudged
from graphkin.errors import Unsolvable
from graphkin.scene.model import Tools
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase

__all__ = ["COVERAGE", "Uncertainty", "predict"]

COVERAGE = 3.0  # a stated bound is this many standard deviations


@dataclass(frozen=True)
class Uncertainty:
    """Standard deviation of a reading (SI; of a vector, the root of the sum over both components).

    ``cause`` is the step that adds most to it, ``share`` its part of the variance.
    """

    deviation: float
    cause: Phrase
    share: float

    @property
    def bound(self) -> float:
        """What the reading keeps within at least 99 times in a hundred."""
        return COVERAGE * self.deviation


def predict(what: Plan, name: str, tools: Tools) -> Mapping[Symbol, Uncertainty]:
    """Uncertainty of every reading of a plan drawn with an instrument ("pencil" or "cad")."""
    still = nudged(name, tools, 0)
    sheet = execute(what, still)
    drawn = still.acts
    base = {r.symbol: r.value for r in read_off(sheet, (), still)}
    marks = [acts for acts, _ in sheet.causes]
    parts: dict[Symbol, dict[int, float]] = {symbol: {} for symbol in base}
    reading = len(sheet.causes)
    for act in range(1, still.acts + 1):
        hand = nudged(name, tools, act)
        try:
            values = {r.symbol: r.value for r in read_off(execute(what, hand), (), hand)}
        except Unsolvable:
            # so near a dead point that this act alone makes the arcs miss: nothing can be promised
            values = dict.fromkeys(base, complex(math.inf))
        cause = bisect_left(marks, act) if act <= drawn else reading
        for symbol, value in base.items():
            off = abs(values[symbol] - value) ** 2
            if off:
                parts[symbol][cause] = parts[symbol].get(cause, 0.0) + off
    return {symbol: _summed(symbol, shares, sheet.causes) for symbol, shares in parts.items()}


def _summed(symbol: Symbol, shares: Mapping[int, float], causes: tuple[tuple[int, Phrase], ...]) -> Uncertainty:
    whole = sum(shares.values())
    if not whole:
        return Uncertainty(0.0, Phrase("reading", (symbol,)), 0.0)
    worst = max(shares, key=shares.__getitem__)
    cause = causes[worst][1] if worst < len(causes) else Phrase("reading", (symbol,))
    return Uncertainty(math.sqrt(whole), cause, shares[worst] / whole if math.isfinite(whole) else 1.0)
