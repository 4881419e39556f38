"""Lengths found on the drawing board, held against those in closed form."""

from __future__ import annotations

import math
from collections.abc import Mapping

from graphkin.checking.uncertainty import COVERAGE
from graphkin.construction import EXACT, Instrument, nudged
from graphkin.construction.design_sheet import DesignSheet
from graphkin.construction.synthesis import construct
from graphkin.errors import Unsolvable
from graphkin.frozen import dataclass
from graphkin.scene.sheet_tables import Tools
from graphkin.scene.synthesis import DesignTask

__all__ = ["FoundLength", "compare_lengths", "predict_lengths"]

AGREES = 1e-9  # of the largest length, for exact hands


@dataclass(frozen=True)
class FoundLength:
    """A length measured (mm on paper, and in the task's unit) beside the exact one; ``tolerance`` is what they may
    differ."""

    symbol: str
    on_paper: float
    measured: float
    exact: float
    tolerance: float

    @property
    def error(self) -> float:
        return abs(self.measured - self.exact)

    @property
    def ok(self) -> bool:
        return self.error <= self.tolerance


def predict_lengths(task: DesignTask, scale: float, name: str, tools: Tools) -> dict[str, float]:
    """Standard deviation (mm on paper) of each length that is drawn with an instrument, "pencil" or "cad"; infinite
    where one act alone keeps it from being found."""
    still = nudged(name, tools)
    base = construct(task, scale, still).lengths
    squares = dict.fromkeys(base, 0.0)
    for act in range(1, still.acts + 1):
        try:
            wrong: Mapping[str, float] = construct(task, scale, nudged(name, tools, {act: 1.0})).lengths
        except Unsolvable:
            wrong = dict.fromkeys(base, math.inf)
        for key, value in base.items():
            squares[key] += (wrong[key] - value) ** 2
    return {key: math.sqrt(square) for key, square in squares.items()}


def compare_lengths(
    sheet: DesignSheet, exact: Mapping[str, float], instrument: Instrument = EXACT, tools: Tools | None = None
) -> tuple[FoundLength, ...]:
    """Hold what was measured against the exact lengths (in the task's unit), in their order."""
    expected: Mapping[str, float] = {}
    if instrument is not EXACT:
        expected = predict_lengths(sheet.task, sheet.scale, instrument.name, tools or Tools())
    least = AGREES * max(exact.values())
    rows = []
    for symbol, value in exact.items():
        mm = sheet.lengths[symbol]
        tolerance = max(least, COVERAGE * expected.get(symbol, 0.0) * sheet.scale)
        rows.append(FoundLength(symbol, mm, mm * sheet.scale, value, tolerance))
    return tuple(rows)
