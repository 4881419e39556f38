"""What a pencil leaves on the paper: vectors, rays, arcs, bars, curves and named points, in mm."""

from __future__ import annotations

from dataclasses import dataclass

from graphkin.construction.sizes import Direction, Role
from graphkin.scene.symbol import PointRef, Symbol

__all__ = ["Aid", "Bar", "CompassArc", "Image", "Mark", "Ray", "Stroke", "TrialCurve", "Vector"]


@dataclass(frozen=True)
class Vector:
    """A vector drawn: ``symbol`` from ``tail`` to ``tip``."""

    symbol: Symbol
    tail: complex
    tip: complex
    role: Role

    @property
    def span(self) -> complex:
        return self.tip - self.tail

    def scaled(self, times: float) -> Vector:
        return Vector(self.symbol, self.tail * times, self.tip * times, self.role)


@dataclass(frozen=True)
class Aid:
    """A vector that only leads on: of a ``trial`` polygon by its number, or of a special point (0)."""

    symbol: Symbol
    tail: complex
    tip: complex
    trial: int

    @property
    def span(self) -> complex:
        return self.tip - self.tail

    def scaled(self, times: float) -> Aid:
        return Aid(self.symbol, self.tail * times, self.tip * times, self.trial)


@dataclass(frozen=True)
class Ray:
    """A direction known only as a line, through a point, drawn as far as the crossing ``to`` (None: it has none)."""

    through: complex
    along: complex
    to: complex | None
    direction: Direction
    symbol: Symbol

    def scaled(self, times: float) -> Ray:
        to = None if self.to is None else self.to * times
        return Ray(self.through * times, self.along, to, self.direction, self.symbol)


@dataclass(frozen=True)
class CompassArc:
    """A compass arc about ``centre`` through the point ``at`` that it finds."""

    centre: complex
    radius: float
    at: complex

    def scaled(self, times: float) -> CompassArc:
        return CompassArc(self.centre * times, self.radius * times, self.at * times)


@dataclass(frozen=True)
class Bar:
    """A line of the mechanism or of a construction from a to b."""

    a: complex
    b: complex
    link: str

    def scaled(self, times: float) -> Bar:
        return Bar(self.a * times, self.b * times, self.link)


@dataclass(frozen=True)
class TrialCurve:
    """Where the free ``point`` of a group comes to lie in trial positions, ``at``, and the curve through them."""

    curve: tuple[complex, ...]
    at: tuple[complex, ...]
    point: str

    def scaled(self, times: float) -> TrialCurve:
        return TrialCurve(tuple(z * times for z in self.curve), tuple(z * times for z in self.at), self.point)


@dataclass(frozen=True)
class Mark:
    """A named point of a figure.  ``ref`` without a point name is the pole."""

    ref: PointRef
    at: complex

    def scaled(self, times: float) -> Mark:
        return Mark(self.ref, self.at * times)


@dataclass(frozen=True)
class Image:
    """The image of a link: the end points of its points, in order."""

    link: str
    corners: tuple[complex, ...]

    def scaled(self, times: float) -> Image:
        return Image(self.link, tuple(z * times for z in self.corners))


Stroke = Vector | Aid | TrialCurve | Ray | CompassArc | Bar | Mark | Image
"""Each is had so many times as large by ``scaled(times)``."""
