"""How much room a drawing takes, and the scale of the series that fits it."""

from __future__ import annotations

import math
from collections.abc import Iterable

from graphkin.frozen import dataclass

__all__ = ["SERIES", "Extent", "fitting_scale"]

SERIES = (1.0, 2.0, 2.5, 5.0)


@dataclass(frozen=True)
class Extent:
    """Width and height of what a figure shows (m, m/s, m/s2)."""

    width: float
    height: float

    @staticmethod
    def around(points: Iterable[complex], per_mm: float) -> Extent:
        """Of points on paper (mm) at a scale; nothing where there are none."""
        spots = list(points)
        if not spots:
            return Extent(0.0, 0.0)
        x, y = [z.real for z in spots], [z.imag for z in spots]
        return Extent((max(x) - min(x)) * per_mm, (max(y) - min(y)) * per_mm)


def fitting_scale(extent: Extent, room: tuple[float, float], units: float) -> float:
    """The finest scale of the series (units for one mm) at which something fits the room; 1 if it spans nothing."""
    least = max(extent.width / room[0], extent.height / room[1]) * units
    if not math.isfinite(least) or least <= 0.0:
        return 1.0
    decade = 10.0 ** math.floor(math.log10(least))
    for step in (*SERIES, 10.0):
        if step * decade >= least * (1 - 1e-12):
            return float(f"{step * decade:.12g}")
    return 10.0 * decade
