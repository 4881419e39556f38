"""Errors against the distance from a singular position, and the power of the distance with which they grow."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from graphkin.words import Phrase
from graphkin.words.written import true_minus

__all__ = ["LOST", "ErrorLaw", "Singularity", "binned", "grid", "in_powers", "measured"]

LOST = 0.03
PER_DECADE = 2


@dataclass(frozen=True)
class ErrorLaw:
    """How the error of one method grows.

    Parameters
    ----------
    key : word for the method and what it finds
    x : distances from the singular position, falling
    error : the largest error at each, nan where the method gives no answer
    theory : the slope that theory tells, None where there is no law
    warns_from : from this distance down the method says itself that its answer is uncertain, or refuses (None: never)
    refuses_from : from this distance down it gives no answer (None: it always does)
    bound : the error that the method states itself, at each distance
    window : least and largest distance over which the slope is fitted
    lost : an error beyond this is no longer one of first order and tells no slope
    """

    key: str
    x: tuple[float, ...] = ()
    error: tuple[float, ...] = ()
    theory: float | None = None
    warns_from: float | None = None
    refuses_from: float | None = None
    bound: tuple[float, ...] = ()
    window: tuple[float, float] = (0.0, math.inf)
    lost: float = LOST

    @property
    def slope(self) -> float:
        """Slope of log error against log distance by least squares; nan where fewer than three points tell it."""
        low, high = self.window
        points = [
            (math.log10(x), math.log10(e))
            for x, e in zip(self.x, self.error, strict=True)
            if low <= x <= high and 0.0 < e < self.lost
        ]
        if len(points) < 3:
            return math.nan
        a, b = np.array(points).T
        return float(np.polyfit(a, b, 1)[0])


    @property
    def worst(self) -> float:
        """The largest error where there is an answer."""
        return max((e for e in self.error if math.isfinite(e)), default=math.nan)

    @property
    def best(self) -> float:
        """The least error."""
        return min((e for e in self.error if math.isfinite(e)), default=math.nan)

    def near(self, x: float) -> float:
        """The error at the distance next to one where there is an answer."""
        told = [(abs(math.log(at / x)), e) for at, e in zip(self.x, self.error, strict=True) if math.isfinite(e)]
        return min(told, default=(0.0, math.nan))[1]


def in_powers(value: float) -> str:
    """A measured number to two figures, as markup.

    >>> in_powers(0.0123), in_powers(1.5e-8), in_powers(math.nan)
    ('0.012', '1.5·$10^{−8}$', '–')
    """
    if not math.isfinite(value):
        return "–"
    text = f"{value:.2g}"
    if "e" not in text:
        return true_minus(text)
    head, power = text.split("e")
    return f"{head}·$10^{{{true_minus(str(int(power)))}}}$"


@dataclass(frozen=True)
class Singularity:
    """One kind of singularity with the laws of all methods there.

    ``key`` is the word for it, ``distance`` the word for what is on the axis, ``fates`` say where methods stop and how
    they say so; ``growth`` holds how values themselves grow, where they do.
    """

    key: str
    distance: str
    laws: tuple[ErrorLaw, ...]
    fates: tuple[Phrase, ...] = ()
    growth: tuple[ErrorLaw, ...] = ()

    def __getitem__(self, key: str) -> ErrorLaw:
        return next(law for law in self.laws if law.key == key)


def grid(first: float, last: float, samples: int) -> list[float]:
    """Distances falling from ``first`` to ``last``, so many samples to each half of a decade."""
    count = max(1, round(abs(math.log10(last / first)) * PER_DECADE)) * samples
    return [first * (last / first) ** (k / count) for k in range(count + 1)]


def binned(
    x: Sequence[float], error: Sequence[float], samples: int, worst: Callable[..., float] = np.nanmax
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The largest error among each ``samples`` neighbouring distances, at their middle; rounding errors scatter."""
    xs: list[float] = []
    es: list[float] = []
    for k in range(0, len(x), samples):
        part = [e for e in error[k : k + samples] if math.isfinite(e)]
        here = x[k : k + samples]
        xs.append(float(np.exp(np.mean(np.log(here)))))
        es.append(float(worst(part)) if part and len(part) == len(here) else math.nan)
    return tuple(xs), tuple(es)


def measured(
    laws: Sequence[ErrorLaw], x: Sequence[float], rows: Iterable[Sequence[float]], samples: int | None = None
) -> tuple[ErrorLaw, ...]:
    """Laws as they were stated, with what was measured.

    Parameters
    ----------
    x : distances, falling
    rows : at each of them the error of every law
    samples : how many neighbouring distances become one, with the largest error of them; None: each stands by itself
    """
    made = []
    for law, error in zip(laws, zip(*rows, strict=True), strict=True):
        xs, es = (tuple(x), tuple(error)) if samples is None else binned(x, error, samples)
        made.append(replace(law, x=xs, error=es))
    return tuple(made)
