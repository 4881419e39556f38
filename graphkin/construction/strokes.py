"""What a pencil leaves on the paper: vectors, rays, arcs, bars, curves and named points, in mm."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Self

from graphkin.construction.sizes import Direction, Role
from graphkin.scene.symbol import PointRef, Symbol

__all__ = ["Aid", "Bar", "CompassArc", "Image", "Mark", "Ray", "Stroke", "TrialCurve", "Vector"]


LENGTHS = {"tail", "tip", "through", "to", "centre", "radius", "at", "a", "b", "curve", "corners"}
"""Places and lengths of strokes (mm), which a scale changes; a direction stays."""


class OnPaper:
    """A stroke by its places (mm)."""

    def scaled(self, times: float) -> Self:
        """The same so many times as large."""
        places = {name: _times(value, times) for name, value in vars(self).items() if name in LENGTHS}
        return replace(self, **places)  # type: ignore[type-var]


def _times(value: Any, times: float) -> Any:
    if isinstance(value, tuple):
        return tuple(place * times for place in value)
    return value if value is None else value * times


@dataclass(frozen=True)
class Vector(OnPaper):
    """A vector drawn: ``symbol`` from ``tail`` to ``tip``."""

    symbol: Symbol
    tail: complex
    tip: complex
    role: Role

    @property
    def span(self) -> complex:
        return self.tip - self.tail


@dataclass(frozen=True)
class Aid(OnPaper):
    """A vector that only leads on: of a ``trial`` polygon by its number, or of a special point (0)."""

    symbol: Symbol
    tail: complex
    tip: complex
    trial: int

    @property
    def span(self) -> complex:
        return self.tip - self.tail


@dataclass(frozen=True)
class Ray(OnPaper):
    """A direction known only as a line, through a point, drawn as far as the crossing ``to`` (None: it has none)."""

    through: complex
    along: complex
    to: complex | None
    direction: Direction
    symbol: Symbol


@dataclass(frozen=True)
class CompassArc(OnPaper):
    """A compass arc about ``centre`` through the point ``at`` that it finds."""

    centre: complex
    radius: float
    at: complex


@dataclass(frozen=True)
class Bar(OnPaper):
    """A line of the mechanism or of a construction from a to b."""

    a: complex
    b: complex
    link: str


@dataclass(frozen=True)
class TrialCurve(OnPaper):
    """Where the free ``point`` of a group comes to lie in trial positions, ``at``, and the curve through them."""

    curve: tuple[complex, ...]
    at: tuple[complex, ...]
    point: str


@dataclass(frozen=True)
class Mark(OnPaper):
    """A named point of a figure.  ``ref`` without a point name is the pole."""

    ref: PointRef
    at: complex


@dataclass(frozen=True)
class Image(OnPaper):
    """The image of a link: the end points of its points, in order."""

    link: str
    corners: tuple[complex, ...]


Stroke = Vector | Aid | TrialCurve | Ray | CompassArc | Bar | Mark | Image
