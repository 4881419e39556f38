"""Which reading is worst, which step makes it so, and which scale would give a better one."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from graphkin.checking.readings import Reading
from graphkin.checking.uncertainty import Uncertainty, predict
from graphkin.drafting import Plan, Scales
from graphkin.scene.model import Tools
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase

__all__ = ["Advice", "advise"]

SMALL = 0.05  # readings below this part of the largest of their kind are no fair measure of a drawing


@dataclass(frozen=True)
class Advice:
    """The worst reading of a drawing and what would help it most.

    ``relative`` is its standard deviation over its size; ``cause`` the step that adds most to it, with its ``share`` of
    the variance; ``figure`` the one to draw twice as large, and ``gain`` what is left of the deviation then.
    """

    symbol: Symbol
    relative: float
    cause: Phrase
    share: float
    figure: str
    gain: float

    def phrase(self) -> Phrase:
        return Phrase(
            "advice",
            (
                self.symbol,
                f"{100 * self.relative:.2g}",
                self.cause,
                f"{100 * self.share:.0f}",
                Phrase(f"figure {self.figure}"),
                f"{100 * self.relative * self.gain:.2g}",
            ),
        )


def advise(
    what: Plan, name: str, tools: Tools, readings: Sequence[Reading], predicted: Mapping[Symbol, Uncertainty]
) -> Advice | None:
    """Look for the worst reading and the remedy; None where nothing is uncertain.

    The remedy is found by predicting again with each of the three figures drawn twice as large.
    """
    largest: dict[str, float] = {}
    for r in readings:
        largest[r.symbol.kind[0]] = max(largest.get(r.symbol.kind[0], 0.0), abs(r.value))
    worst: tuple[float, Symbol] | None = None
    for r in readings:
        expected = predicted[r.symbol]
        if abs(r.value) < SMALL * largest[r.symbol.kind[0]] or not expected.deviation:
            continue
        part = expected.deviation / abs(r.value)
        if math.isfinite(part) and (worst is None or part > worst[0]):
            worst = part, r.symbol
    if worst is None:
        return None
    relative, symbol = worst
    gains = {}
    for figure in ("length", "velocity", "acceleration"):
        scales: Scales = replace(what.scales, **{figure: getattr(what.scales, figure) / 2})
        again = predict(replace(what, scales=scales), name, tools)[symbol].deviation
        gains[figure] = again / predicted[symbol].deviation
    best = min(gains, key=gains.__getitem__)
    expected = predicted[symbol]
    return Advice(symbol, relative, expected.cause, expected.share, best, gains[best])
