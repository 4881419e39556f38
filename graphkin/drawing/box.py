"""Upright rectangles on the page: their overlaps, distances, and lines clipped to them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple


class Box(NamedTuple):  # a page has thousands
    """A rectangle on the page, in mm, y down: ``left <= right`` and ``top <= bottom``."""

    left: float
    top: float
    right: float
    bottom: float

    @classmethod
    def around(cls, points: Iterable[complex]) -> Box:
        """The smallest box that holds all points.  Raises ValueError where there is none."""
        first, *others = points
        left = right = first.real
        top = bottom = first.imag
        for point in others:
            x, y = point.real, point.imag
            if x < left:
                left = x
            elif x > right:
                right = x
            if y < top:
                top = y
            elif y > bottom:
                bottom = y
        return cls(left, top, right, bottom)

    @property
    def width(self) -> float:
        return self.right - self.left

    @property
    def height(self) -> float:
        return self.bottom - self.top

    @property
    def centre(self) -> complex:
        return complex((self.left + self.right) / 2, (self.top + self.bottom) / 2)

    @property
    def corners(self) -> tuple[complex, complex, complex, complex]:
        """Left top, right top, right bottom, left bottom."""
        return (
            complex(self.left, self.top), complex(self.right, self.top), complex(self.right, self.bottom),
            complex(self.left, self.bottom),
        )

    def moved(self, by: complex) -> Box:
        left, top, right, bottom = self
        x, y = by.real, by.imag
        return Box(left + x, top + y, right + x, bottom + y)

    def grown(self, margin: float) -> Box:
        """The box with a margin (mm) all round; a negative one shrinks it, at most to its centre lines."""
        dx, dy = max(margin, -self.width / 2), max(margin, -self.height / 2)
        return Box(self.left - dx, self.top - dy, self.right + dx, self.bottom + dy)

    def joined(self, other: Box) -> Box:
        return Box(
            min(self.left, other.left), min(self.top, other.top), max(self.right, other.right),
            max(self.bottom, other.bottom),
        )

    def overlaps(self, other: Box) -> bool:
        """Whether the two share an area; touching edges do not count."""
        return (
            self.left < other.right
            and other.left < self.right
            and self.top < other.bottom
            and other.top < self.bottom
        )

    def holds(self, other: Box) -> bool:
        return (
            self.left <= other.left
            and self.top <= other.top
            and other.right <= self.right
            and other.bottom <= self.bottom
        )

    def nearest(self, point: complex) -> complex:
        """The point of the box (its area counts) that is nearest to a point."""
        return complex(
            min(max(point.real, self.left), self.right),
            min(max(point.imag, self.top), self.bottom),
        )

    def distance(self, point: complex) -> float:
        """Distance (mm) from a point to the box, 0 inside."""
        return abs(point - self.nearest(point))

    def clip(self, start: complex, end: complex) -> tuple[complex, complex] | None:
        """The part of a segment inside the box, in its own sense; None where they do not meet.

        Liang and Barsky, A new concept and method for line clipping, ACM Trans. Graphics 3 (1984).
        """
        step = end - start
        enter, leave = 0.0, 1.0
        for rate, room in (
            (-step.real, start.real - self.left), (step.real, self.right - start.real),
            (-step.imag, start.imag - self.top), (step.imag, self.bottom - start.imag),
        ):
            if rate == 0.0:
                if room < 0.0:
                    return None
            elif rate < 0.0:
                if (share := room / rate) > enter:
                    enter = share
            elif (share := room / rate) < leave:
                leave = share
        if enter > leave:
            return None
        return (
            start if enter == 0.0 else start + enter * step,
            end if leave == 1.0 else start + leave * step,
        )

    def clip_line(self, through: complex, along: complex) -> tuple[complex, complex] | None:
        """The chord that the box cuts from an endless line, in the sense of ``along``; None where they do not meet."""
        half = (abs(through - self.centre) + self.width + self.height) / abs(along) * along
        return self.clip(through - half, through + half)
