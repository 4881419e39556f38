"""What stands on the paper after a construction: strokes in mm, in numbered steps, each with its reason.

Coordinates are complex numbers in mm on paper, y up.  The mechanism is drawn from the world's origin, the velocity and
acceleration polygons from their poles; where a figure is placed on a page is not decided here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from graphkin.scene.model import Scene
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure.model import Element, Structure
from graphkin.words import Phrase

__all__ = [
    "Arc",
    "Bar",
    "DiagramName",
    "Direction",
    "Equation",
    "Image",
    "Mark",
    "Pose",
    "Rate",
    "Ray",
    "Scales",
    "Sheet",
    "Step",
    "Stroke",
    "Term",
    "Vector",
]

DiagramName = Literal["mechanism", "velocity", "acceleration"]
Role = Literal["resultant", "relative", "normal", "tangential", "coriolis", "sliding"]


@dataclass(frozen=True)
class Scales:
    """Scale factors: m, m/s and m/s2 for one mm of paper."""

    length: float
    velocity: float
    acceleration: float

    def of(self, diagram: DiagramName) -> float:
        return {"mechanism": self.length, "velocity": self.velocity, "acceleration": self.acceleration}[diagram]


@dataclass(frozen=True)
class Direction:
    """A direction as it is written in an equation row: square to or along what is named.

    ``names`` are the letters of a bar (``("B", "C")``) or the name of a guide (``("h",)``); ``relation`` is "square",
    "along", "towards" (from the first to the second) or "turned" (the relative velocity turned by 90 degrees in the
    sense of the guide's rotation).
    """

    relation: Literal["square", "along", "towards", "turned"]
    names: tuple[str, ...]


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


@dataclass(frozen=True)
class Ray:
    """A direction known only as a line, through a point, drawn as far as the crossing ``to`` (None: it has none)."""

    through: complex
    along: complex
    to: complex | None
    direction: Direction
    symbol: Symbol


@dataclass(frozen=True)
class Arc:
    """A compass arc about ``centre`` through the point ``at`` that it finds."""

    centre: complex
    radius: float
    at: complex


@dataclass(frozen=True)
class Bar:
    """A line of the mechanism or of a construction from a to b."""

    a: complex
    b: complex
    link: str


@dataclass(frozen=True)
class Mark:
    """A named point of a figure.  ``ref`` without a point name is the pole."""

    ref: PointRef
    at: complex


@dataclass(frozen=True)
class Image:
    """The image of a link: the end points of its points, in order."""

    link: str
    corners: tuple[complex, ...]


Stroke = Vector | Ray | Arc | Bar | Mark | Image


@dataclass(frozen=True)
class Step:
    """One action on the board, with its reason in words."""

    number: int
    diagram: DiagramName
    phrase: Phrase
    strokes: tuple[Stroke, ...] = ()
    equation: int | None = None


@dataclass(frozen=True)
class Term:
    """A term of a vector equation: is its size known, is its direction known, and as what.

    ``size`` is the rule that gives the size ("omega_1 * AB", "" where it was drawn before or is unknown).
    """

    symbol: Symbol
    size_known: bool
    direction_known: bool
    size: str = ""
    direction: Direction | None = None


@dataclass(frozen=True)
class Equation:
    """A vector equation as written above its rows of sizes and directions.  ``sides`` are equal sums of terms."""

    number: int
    diagram: DiagramName
    sides: tuple[tuple[Term, ...], ...]
    element: Element

    @property
    def unknowns(self) -> int:
        """Number of unknown sizes and directions."""
        own = {t.symbol: (not t.size_known) + (not t.direction_known) for side in self.sides for t in side}
        return sum(own.values())


@dataclass(frozen=True)
class Rate:
    """An angular velocity or acceleration measured on the drawing (rad/s, rad/s2; counter-clockwise positive).

    ``vector`` is the relative or tangential vector it comes from (None where it is given, or is that of another link:
    ``same_as``), ``mm`` its length on paper and ``arm_mm`` that of the bar.
    """

    link: str
    value: float
    vector: Symbol | None = None
    mm: float = 0.0
    arm_mm: float = 0.0
    same_as: str = ""


@dataclass(frozen=True)
class Pose:
    """Where a link lies on paper: its origin (mm) and the unit direction of its own x axis."""

    origin: complex
    axis: complex


@dataclass(frozen=True)
class Sheet:
    """Everything drawn, in order.

    ``ends`` gives the end points in each polygon: ends["velocity"][PointRef("B", "3")] is b3.
    ``omega`` and ``alpha`` hold the measured rates by link.  ``stopped`` names the group that could not be drawn and
    why; everything before it stands.  ``notes`` are remarks on the construction (lines that meet off the sheet,
    zero vectors).  ``causes`` tells to which step the acts of the hand belong: (acts made when it was done, the step).
    ``left_out`` says what nothing asked for needs.
    """

    scene: Scene
    structure: Structure
    instrument: str
    drivers: Mapping[str, float]
    scales: Scales
    poses: Mapping[str, Pose]
    points: Mapping[PointRef, complex]
    ends: Mapping[str, Mapping[PointRef, complex]]
    omega: Mapping[str, Rate]
    alpha: Mapping[str, Rate]
    steps: tuple[Step, ...]
    equations: tuple[Equation, ...]
    assembly: Mapping[str, Phrase]
    notes: tuple[Phrase, ...] = ()
    stopped: Phrase | None = None
    causes: tuple[tuple[int, Phrase], ...] = ()
    left_out: tuple[Phrase, ...] = ()

    def vectors(self, diagram: DiagramName) -> dict[Symbol, Vector]:
        """All vectors of a diagram by symbol."""
        return {
            s.symbol: s for step in self.steps if step.diagram == diagram for s in step.strokes if isinstance(s, Vector)
        }
