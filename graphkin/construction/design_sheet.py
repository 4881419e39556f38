"""What stands on the paper after a synthesis, and the paper while it grows: strokes in mm, y up, in numbered steps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from graphkin.construction.instruments import Instrument
from graphkin.construction.sheet import PARALLEL
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, cross_line_arc, cross_lines, unit
from graphkin.scene.designs import DesignTask
from graphkin.words import Phrase

__all__ = [
    "DesignAngle", "DesignCircle", "DesignLine", "DesignPaper", "DesignPoint", "DesignSheet", "DesignStep",
    "DesignStroke", "LineKind",
]  # fmt: skip

LineKind = Literal["given", "construction", "direction", "limit", "mechanism"]
"""Lines that the task gives, help lines, lines of which only the direction is known, bars in other positions, and the
mechanism that is found."""


@dataclass(frozen=True)
class DesignLine:
    """A line from a to b."""

    a: complex
    b: complex
    kind: LineKind


@dataclass(frozen=True)
class DesignCircle:
    """A circle, or of it only the arcs near the points ``near``."""

    centre: complex
    radius: float
    near: tuple[complex, ...] = ()


@dataclass(frozen=True)
class DesignPoint:
    """A point with its name ("" for one that needs none); a fixed pivot, or another."""

    name: str
    at: complex
    pivot: bool = False


@dataclass(frozen=True)
class DesignAngle:
    """An angle (degrees) drawn about a point from one direction to another, counter-clockwise."""

    apex: complex
    first: complex
    second: complex
    value: float
    name: str = ""


DesignStroke = DesignLine | DesignCircle | DesignPoint | DesignAngle


@dataclass(frozen=True)
class DesignStep:
    """One action: the sentence to be, and the strokes that it leaves."""

    number: int
    phrase: Phrase
    strokes: tuple[DesignStroke, ...]


@dataclass(frozen=True)
class DesignSheet:
    """A construction on paper, in mm, y up.

    scale : units of the task's length for one mm
    lengths : what was measured, mm on paper, by the two points of a bar ("ram": distance of its line from C)
    turned : bars that were found opposite to the angles asked
    """

    task: DesignTask
    scale: float
    instrument: str
    steps: tuple[DesignStep, ...]
    points: Mapping[str, complex]
    lengths: Mapping[str, float]
    turned: tuple[str, ...] = ()


@dataclass
class DesignPaper:
    """The sheet while a task is drawn on it; the one thing here that grows."""

    scale: float
    hand: Instrument
    steps: list[DesignStep] = field(default_factory=list)
    points: dict[str, complex] = field(default_factory=dict)
    lengths: dict[str, float] = field(default_factory=dict)
    turned: list[str] = field(default_factory=list)

    # -- acts of the hand ----------------------------------------------------------------------------------------------

    def do(self, key: str, args: tuple[object, ...], *strokes: DesignStroke) -> None:
        self.steps.append(DesignStep(len(self.steps) + 1, Phrase(key, args), strokes))
        for stroke in strokes:
            if isinstance(stroke, DesignPoint) and stroke.name:
                self.points[stroke.name] = stroke.at

    def mm(self, length: float) -> float:
        return length / self.scale

    def shown(self, length: float) -> str:
        """A length as it is laid off: mm on paper."""
        return f"{length:.2f}"

    def lay_off(self, start: complex, along: complex, mm: float) -> complex:
        return self.hand.point(start + self.hand.length(mm) * self.hand.direction(along))

    def lay_off_angle(self, start: complex, along: complex, mm: float) -> complex:
        return self.hand.point(start + self.hand.length(mm) * self.hand.angle(along))

    def plot(self, at: complex) -> complex:
        """A point by its coordinates."""
        return self.hand.point(complex(self.hand.length(at.real / self.scale), self.hand.length(at.imag / self.scale)))

    def meet(self, what: str, p: complex, d: complex, q: complex, e: complex) -> complex:
        if abs(cross(d, e)) < PARALLEL:
            raise Unsolvable(
                "not drawn", Problem(what, Phrase("the lines that should find it are parallel"), Phrase("other data"))
            )
        at = cross_lines(p, d, q, e)
        assert at is not None
        return self.hand.point(at)

    def cut(self, what: str, p: complex, d: complex, centre: complex, radius: float) -> tuple[complex, complex]:
        """Where a line cuts a circle, the one further along d first."""
        found = cross_line_arc(p, d, centre, radius)
        if found is None:
            raise Unsolvable(
                "not drawn", Problem(what, Phrase("the line does not reach the circle"), Phrase("other data"))
            )
        return self.hand.point(found[0]), self.hand.point(found[1])

    def bisector(self, a: complex, b: complex) -> tuple[complex, complex]:
        """A point and the direction of the perpendicular bisector, drawn by two pairs of compass arcs."""
        return self.hand.point((a + b) / 2), self.hand.direction(1j * unit(b - a))

    def measure(self, name: str, a: complex, b: complex) -> float:
        """The length of a bar off the paper (mm)."""
        self.lengths[name] = self.hand.read(abs(b - a))
        return self.lengths[name]
