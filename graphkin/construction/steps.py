"""The acts of a construction, and what is to be remarked on it: typed, with the sentence that each makes.

An act says what is done and to what; the strokes that it leaves on the paper stand in its `Step`.  Lengths are mm on
paper, so an act is had at another scale by ``scaled``.  This is the one place where an act becomes a `Phrase`; who
wants to know more than the sentence looks at the type and the fields.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal, Self

from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase

__all__ = [
    "Act",
    "ArcOnPath",
    "Asked",
    "ByImage",
    "ByRate",
    "Carried",
    "Cause",
    "CompassArcs",
    "Direction",
    "DirectionLine",
    "FixedPoints",
    "Formula",
    "FoundVector",
    "Given",
    "GuideThrough",
    "GuideTouching",
    "LaidOff",
    "LaidOffAngle",
    "LaidOffTravel",
    "LinesMeet",
    "LinkPoints",
    "MeasuredRate",
    "Named",
    "OffTheSheet",
    "PathDrawn",
    "PathsCross",
    "Placing",
    "PutBack",
    "RateTimes",
    "ReadOff",
    "Remark",
    "Resultant",
    "SamePlace",
    "SharpCrossing",
    "ShortArm",
    "Size",
    "SlidToMeet",
    "Translated",
    "ZeroVector",
]

REACH = 2000.0  # mm to either side: how far a construction line is drawn
SHARP = math.sin(math.radians(15.0))
SHORT = 3.0  # mm on paper; a direction drawn through two points nearer than this errs by a pencil's width in ten
ZERO_MM = 1e-7  # a vector shorter than this is no vector on paper


@dataclass(frozen=True)
class Direction:
    """A direction as it is written in an equation row: square to or along what is named.

    ``names`` are the letters of a bar (``("B", "C")``) or the name of a guide (``("h",)``); ``relation`` is "square",
    "along", "towards" (from the first to the second) or "turned" (the relative velocity turned by 90 degrees in the
    sense of the guide's rotation).
    """

    relation: Literal["square", "along", "towards", "turned"]
    names: tuple[str, ...]


# -- what a size is known by ------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Given:
    """A size that the problem gives."""

    def __str__(self) -> str:
        return "given"


@dataclass(frozen=True)
class RateTimes:
    """An angular rate of ``links`` (one, or two for a relative one) times a bar's length or a vector's size.

    >>> str(RateTimes("omega", ("3",), ("B", "C"), square=True))
    'ω_{3}²·BC'
    """

    rate: Literal["omega", "alpha"]
    links: tuple[str, ...]
    factor: tuple[str, str] | Symbol
    square: bool = False
    twice: bool = False

    def __str__(self) -> str:
        letter = "ω" if self.rate == "omega" else "α"
        factor = str(self.factor) if isinstance(self.factor, Symbol) else "".join(self.factor)
        return f"{'2' * self.twice}{letter}_{{{''.join(self.links)}}}{'²' * self.square}·{factor}"


@dataclass(frozen=True)
class Formula:
    """A rule written without names, as for links that a driver turns about a hinge of another link."""

    text: str

    def __str__(self) -> str:
        return self.text


Size = Given | RateTimes | Formula

# -- acts -------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Act:
    """What is done in a step."""

    @property
    def phrase(self) -> Phrase:
        """The act as a sentence to be."""
        raise NotImplementedError

    @property
    def links(self) -> tuple[str, ...]:
        """Links that the act places or draws."""
        return ()

    def scaled(self, times: float) -> Self:
        """The same act with its lengths so many times as large."""
        return self


@dataclass(frozen=True)
class FixedPoints(Act):
    frame: str
    points: tuple[str, ...]

    @property
    def phrase(self) -> Phrase:
        return Phrase("frame", (self.frame, ", ".join(self.points)))

    @property
    def links(self) -> tuple[str, ...]:
        return (self.frame,)


@dataclass(frozen=True)
class LaidOffAngle(Act):
    """The angle (rad) of a driven link, about a hinge."""

    link: str
    angle: float
    hinge: str

    @property
    def phrase(self) -> Phrase:
        return Phrase("lay off angle", (self.link, f"{math.degrees(self.angle):.6g}", self.hinge))

    @property
    def links(self) -> tuple[str, ...]:
        return (self.link,)


class _AtPairs(Act):
    """An act at sliding pairs, by their keys."""

    @property
    def pairs(self) -> tuple[str, ...]:
        raise NotImplementedError

    @property
    def links(self) -> tuple[str, ...]:
        return tuple(name for pair in self.pairs for name in pair.split("/"))


@dataclass(frozen=True)
class LaidOffTravel(_AtPairs):
    pair: str
    mm: float

    @property
    def phrase(self) -> Phrase:
        return Phrase("lay off travel", (self.pair, f"{self.mm:.2f}"))

    @property
    def pairs(self) -> tuple[str, ...]:
        return (self.pair,)

    def scaled(self, times: float) -> Self:
        return replace(self, mm=self.mm * times)


@dataclass(frozen=True)
class CompassArcs(Act):
    """Two arcs about known points find a third."""

    about: tuple[str, str]
    point: str
    radii: tuple[float, float]

    @property
    def phrase(self) -> Phrase:
        return Phrase("arcs", (*self.about, self.point, *(f"{r:.2f}" for r in self.radii)))

    def scaled(self, times: float) -> Self:
        return replace(self, radii=(self.radii[0] * times, self.radii[1] * times))


@dataclass(frozen=True)
class PathDrawn(_AtPairs):
    """The straight path of a point that slides."""

    point: str
    pair: str

    @property
    def phrase(self) -> Phrase:
        return Phrase("path", (self.point, self.pair))

    @property
    def pairs(self) -> tuple[str, ...]:
        return (self.pair,)


@dataclass(frozen=True)
class ArcOnPath(Act):
    """An arc about a known point finds another on its path."""

    about: str
    point: str
    radius: float

    @property
    def phrase(self) -> Phrase:
        return Phrase("arc on path", (self.about, self.point, f"{self.radius:.2f}"))

    def scaled(self, times: float) -> Self:
        return replace(self, radius=self.radius * times)


@dataclass(frozen=True)
class GuideThrough(_AtPairs):
    """A guide drawn from its pivot through the pivot of what slides on it."""

    pivot: str
    through: str
    pair: str

    @property
    def phrase(self) -> Phrase:
        return Phrase("line of guide", (self.pivot, self.through, self.pair))

    @property
    def pairs(self) -> tuple[str, ...]:
        return (self.pair,)


@dataclass(frozen=True)
class GuideTouching(_AtPairs):
    """A guide at a distance (mm) from its pivot, drawn as a tangent from the pivot of what slides on it."""

    pivot: str
    through: str
    offset: float
    pair: str

    @property
    def phrase(self) -> Phrase:
        return Phrase("tangent", (self.pivot, self.through, f"{self.offset:.2f}", self.pair))

    @property
    def pairs(self) -> tuple[str, ...]:
        return (self.pair,)

    def scaled(self, times: float) -> Self:
        return replace(self, offset=self.offset * times)


@dataclass(frozen=True)
class PathsCross(_AtPairs):
    """A point lies where its two straight paths cross."""

    point: str
    pairs_of_paths: tuple[str, str]

    @property
    def phrase(self) -> Phrase:
        return Phrase("paths", (self.point, *self.pairs_of_paths))

    @property
    def pairs(self) -> tuple[str, ...]:
        return self.pairs_of_paths


@dataclass(frozen=True)
class SlidToMeet(_AtPairs):
    """A link shifted along one pair until its other guide meets a point."""

    point: str
    along: str
    until: str

    @property
    def phrase(self) -> Phrase:
        return Phrase("slide to meet", (self.point, self.along, self.until))

    @property
    def pairs(self) -> tuple[str, ...]:
        return self.along, self.until


@dataclass(frozen=True)
class LinkPoints(Act):
    """The new points of a link marked; ``transferred`` where they come with the shape of a whole link."""

    link: str
    points: tuple[str, ...]
    transferred: bool

    @property
    def phrase(self) -> Phrase:
        return Phrase("transfer" if self.transferred else "points", (self.link, ", ".join(self.points)))

    @property
    def links(self) -> tuple[str, ...]:
        return (self.link,)


@dataclass(frozen=True)
class LaidOff(Act):
    """A known vector, laid off by the rule of its size."""

    symbol: Symbol
    size: Size | None
    mm: float
    direction: Direction
    role: str

    @property
    def is_zero(self) -> bool:
        return self.mm < ZERO_MM

    @property
    def phrase(self) -> Phrase:
        if self.is_zero:
            return Phrase("zero vector", (self.symbol,))
        key = {"normal": "lay off normal", "coriolis": "lay off coriolis"}.get(self.role, "lay off")
        return Phrase(key, (self.symbol, self.size or "", f"{self.mm:.2f}", self.direction))

    def scaled(self, times: float) -> Self:
        return replace(self, mm=self.mm * times)


@dataclass(frozen=True)
class _OfVector(Act):
    symbol: Symbol


class Carried(_OfVector):
    """A known vector added before its turn in the chain."""

    @property
    def phrase(self) -> Phrase:
        return Phrase("carry", (self.symbol,))


class PutBack(_OfVector):
    """A vector that was added before its turn, put in its place."""

    @property
    def phrase(self) -> Phrase:
        return Phrase("put back", (self.symbol,))


class Resultant(_OfVector):
    """The vector from the pole to an end point that was found."""

    @property
    def phrase(self) -> Phrase:
        return Phrase("resultant", (self.symbol,))


class Asked(_OfVector):
    """A vector that stands in no equation, drawn because it is asked for."""

    @property
    def phrase(self) -> Phrase:
        return Phrase("asked", (self.symbol,))


@dataclass(frozen=True)
class DirectionLine(_OfVector):
    """A line along which a vector of unknown size lies."""

    direction: Direction

    @property
    def phrase(self) -> Phrase:
        return Phrase("direction", (self.symbol, self.direction))


@dataclass(frozen=True)
class FoundVector(_OfVector):
    """A vector found by its end point, and measured."""

    mm: float

    @property
    def phrase(self) -> Phrase:
        return Phrase("found", (self.symbol, f"{self.mm:.2f}"))

    def scaled(self, times: float) -> Self:
        return replace(self, mm=self.mm * times)


@dataclass(frozen=True)
class _AtPoint(Act):
    point: PointRef


class LinesMeet(_AtPoint):
    """Two direction lines meet in an end point."""

    @property
    def phrase(self) -> Phrase:
        return Phrase("meet", (self.point,))


class Named(_AtPoint):
    """An end point that stands already gets its letter."""

    @property
    def phrase(self) -> Phrase:
        return Phrase("name", (self.point,))


@dataclass(frozen=True)
class SamePlace(_AtPoint):
    """Two points at one place of a link have one end point."""

    other: PointRef

    @property
    def phrase(self) -> Phrase:
        return Phrase("same place", (self.point, self.other))


@dataclass(frozen=True)
class ByRate(_AtPoint):
    """An end point from another of the same link, by its measured rates."""

    start: PointRef
    link: str

    @property
    def phrase(self) -> Phrase:
        return Phrase("by rate", (self.point, self.start, self.link))


@dataclass(frozen=True)
class ByImage(_AtPoint):
    """An end point by the image of its link: a figure similar to the link, or, ``on_line``, a division of a line."""

    between: tuple[PointRef, PointRef]
    link: str
    on_line: bool

    @property
    def phrase(self) -> Phrase:
        return Phrase("division" if self.on_line else "image", (self.point, *self.between, self.link))


@dataclass(frozen=True)
class Translated(Act):
    """A link that only translates: all its points have one end point."""

    link: str

    @property
    def phrase(self) -> Phrase:
        return Phrase("translates", (self.link,))


@dataclass(frozen=True)
class MeasuredRate(Act):
    """An angular rate (rad/s, rad/s2; counter-clockwise positive) measured from a vector and the bar it belongs to."""

    rate: Literal["omega", "alpha"]
    link: str
    vector: Symbol
    bar: tuple[str, str]
    value: float

    @property
    def phrase(self) -> Phrase:
        turning = "cw" if math.copysign(1.0, self.value) < 0 else "ccw"
        args = (self.link, self.vector, "".join(self.bar), f"{abs(self.value):.6g}")
        return Phrase(f"{self.rate} {turning}", args)


# -- what a reading can be made uncertain by, besides the acts ---------------------------------------------------------


@dataclass(frozen=True)
class Placing:
    """The pricking and placing of links."""

    links: tuple[str, ...]

    @property
    def phrase(self) -> Phrase:
        return Phrase("placing", (", ".join(self.links),))


@dataclass(frozen=True)
class ReadOff:
    """The reading itself."""

    symbol: Symbol

    @property
    def phrase(self) -> Phrase:
        return Phrase("reading", (self.symbol,))


Cause = Act | Placing | ReadOff

# -- remarks ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class SharpCrossing:
    """Two lines cross at so small an angle (its sine) that the place of the crossing is uncertain."""

    of: str
    sine: float

    @property
    def holds(self) -> bool:
        return self.sine < SHARP

    @property
    def phrase(self) -> Phrase:
        return Phrase("sharp crossing", (self.of, f"{math.degrees(math.asin(self.sine)):.2g}"))

    def scaled(self, times: float) -> Self:
        return self


@dataclass(frozen=True)
class OffTheSheet:
    """Two lines cross so far (mm) from where they start that rulers do not reach: the place is computed."""

    of: str
    mm: float

    @property
    def holds(self) -> bool:
        return self.mm > REACH

    @property
    def phrase(self) -> Phrase:
        return Phrase("off the sheet", (self.of,))

    def scaled(self, times: float) -> Self:
        return replace(self, mm=self.mm * times)


@dataclass(frozen=True)
class ZeroVector:
    """A vector so short (mm) that it is none on paper."""

    symbol: Symbol
    mm: float

    @property
    def holds(self) -> bool:
        return self.mm < ZERO_MM

    @property
    def phrase(self) -> Phrase:
        return Phrase("zero vector", (self.symbol,))

    def scaled(self, times: float) -> Self:
        return replace(self, mm=self.mm * times)


@dataclass(frozen=True)
class ShortArm:
    """A guide directed by two points that lie too near to each other (mm)."""

    links: tuple[str, ...]
    points: tuple[str, str]
    mm: float

    @property
    def holds(self) -> bool:
        return self.mm < SHORT

    @property
    def phrase(self) -> Phrase:
        return Phrase("short arm", (", ".join(self.links), self.points[0], f"{self.mm:.2g}", self.points[1]))

    def scaled(self, times: float) -> Self:
        return replace(self, mm=self.mm * times)


Remark = SharpCrossing | OffTheSheet | ZeroVector | ShortArm
