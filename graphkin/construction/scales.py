"""Scales of a round series, and which of them shows something in the room that it has."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

__all__ = ["SERIES", "Extent", "fitting_scale", "next_of_series"]

SERIES = (1.0, 2.0, 2.5, 5.0)


def next_of_series(least: float) -> float:
    """The next number of the series 1, 2, 2.5, 5 times a power of ten, in which scales and divisions are chosen.

    >>> next_of_series(0.21), next_of_series(60.0), next_of_series(2.0)
    (0.25, 100.0, 2.0)
    """
    decade = 10.0 ** math.floor(math.log10(least))
    fit = (step * decade for step in (*SERIES, 10.0) if step * decade >= least * (1 - 1e-9))
    return float(f"{next(fit, 10.0 * decade):.12g}")


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
    return next_of_series(least)
