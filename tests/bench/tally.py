"""What comes out when stated bounds are held against true errors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

__all__ = ["KINDS", "Tally"]

KINDS = ("position", "velocity", "acceleration", "angle", "omega", "alpha")
CLOSE = 1000.0
LEAST = 1e-300


@dataclass
class Tally:
    """By how much bounds exceed true errors.

    ratios : bound over true error, for each position one of each kind
    refused : positions that were not given out
    lost : positions whose true values were not found
    broken : in words, each bound that a true error exceeds
    """

    ratios: list[list[float]] = field(default_factory=list)
    refused: int = 0
    lost: int = 0
    broken: list[str] = field(default_factory=list)

    @property
    def looked_at(self) -> int:
        """All positions."""
        return len(self.ratios) + self.refused + self.lost

    def hold(self, bounds: Sequence[float], off: Sequence[float], where: str) -> None:
        """Hold the bounds of one position against its true errors, both in the order of ``KINDS``."""
        for kind, bound, error in zip(KINDS, bounds, off, strict=True):
            if not error <= bound:
                self.broken.append(f"{kind} off by {error:.3g}, bound {bound:.3g}, {where}")
        self.ratios.append([b / max(e, LEAST) for b, e in zip(bounds, off, strict=True)])

    def within(self, kind: str) -> float:
        """Part of the bounds of a kind that are within 1000 times the true error."""
        every = np.array(self.ratios)[:, KINDS.index(kind)]
        return float(np.mean(every <= CLOSE)) if len(every) else 1.0

    def text(self) -> str:
        """A few lines for people."""
        lines = [
            f"{len(self.ratios)} positions, {self.refused} refused, {self.lost} without a reference, "
            f"{len(self.broken)} bounds broken; bound over true error:"
        ]
        every = np.array(self.ratios)
        for k, kind in enumerate(KINDS):
            middle = ", ".join(f"{x:.3g}" for x in np.quantile(every[:, k], [0.1, 0.5, 0.9, 0.99]))
            lines.append(
                f"  {kind:13} {middle} at 10, 50, 90, 99 %; within 1000 times: {100 * self.within(kind):.1f} %"
            )
        return "\n".join(lines)
