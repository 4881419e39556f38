"""The acts of a construction: typed, with the sentence that each makes.

An act says what is done and to what; the strokes that it leaves on the paper stand in its `Step`.  ``mm`` are lengths
on paper, the only thing of an act that a scale changes (`scaled`).  `phrase_of` is the one place where an act becomes a
sentence to be; who wants to know more than the sentence looks at the type and the fields.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeVar

from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase
from graphkin.words.written import amount, on_paper

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
    "FoundVector",
    "Given",
    "GuideThrough",
    "GuideTouching",
    "HeldStill",
    "LaidOff",
    "LaidOffAngle",
    "LaidOffTravel",
    "LinesMeet",
    "LinkPoints",
    "MeasuredRate",
    "Named",
    "PathDrawn",
    "PathsCross",
    "Placing",
    "PlanDrawn",
    "PlanTravel",
    "PlanTried",
    "PutBack",
    "RateTimes",
    "ReadOff",
    "Resultant",
    "SamePlace",
    "Size",
    "SlidToMeet",
    "SpecialPoint",
    "SquareOverRadius",
    "Superposed",
    "Translated",
    "TrialDrawn",
    "TrialPositions",
    "links_drawn",
    "phrase_of",
    "scaled",
]  # fmt: skip



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
class SquareOverRadius:
    """The square of a relative velocity over the radius of curvature (m) of the path.

    >>> str(SquareOverRadius(Symbol.parse("v_B@2/B@1"), 0.05))
    '(v_B@2/B@1)²/ρ'
    """

    velocity: Symbol
    radius: float

    def __str__(self) -> str:
        return f"({self.velocity})²/ρ"


Size = Given | RateTimes | SquareOverRadius

# -- acts in the mechanism ---------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class FixedPoints:
    """The fixed points marked."""

    frame: str
    points: tuple[str, ...]


@dataclass(frozen=True)
class LaidOffAngle:
    """The angle (rad) of a driven link, about a hinge."""

    link: str
    angle: float
    hinge: str


@dataclass(frozen=True)
class LaidOffTravel:
    """The travel of a driven sliding pair."""

    pair: str
    mm: float


@dataclass(frozen=True)
class CompassArcs:
    """Two arcs of these radii about known points find a third."""

    about: tuple[str, str]
    point: str
    radii: tuple[float, float]


@dataclass(frozen=True)
class PathDrawn:
    """The straight path of a point that slides."""

    point: str
    pair: str


@dataclass(frozen=True)
class ArcOnPath:
    """An arc of a radius about a known point finds another on its path."""

    about: str
    point: str
    mm: float


@dataclass(frozen=True)
class GuideThrough:
    """A guide drawn from its pivot through the pivot of what slides on it."""

    pivot: str
    through: str
    pair: str


@dataclass(frozen=True)
class GuideTouching:
    """A guide at a distance from its pivot, drawn as a tangent from the pivot of what slides on it."""

    pivot: str
    through: str
    mm: float
    pair: str


@dataclass(frozen=True)
class PathsCross:
    """A point lies where its two straight paths cross."""

    point: str
    pairs: tuple[str, str]


@dataclass(frozen=True)
class SlidToMeet:
    """A link shifted along one pair until its other guide meets a point."""

    point: str
    along: str
    until: str


@dataclass(frozen=True)
class LinkPoints:
    """The new points of a link marked; ``transferred`` where they come with the shape of a whole link."""

    link: str
    points: tuple[str, ...]
    transferred: bool


@dataclass(frozen=True)
class HeldStill:
    """What a driven slide gives of one link on another that is held still: the angle or the travel at their common pair
    (rad, m), or its rate (rad/s, m/s) or second rate (rad/s2, m/s2)."""

    held: str
    link: str
    slide: str
    gives: Literal["angle", "travel", "omega", "velocity", "alpha", "acceleration"]
    value: float


@dataclass(frozen=True)
class TrialPositions:
    """A group placed by trial: ``driven`` names what is moved, ``left_out`` the link (or driver) left out until it
    fits, ``point`` the free point whose trial curve is drawn ("" for none), in ``count`` trial positions."""

    links: tuple[str, ...]
    driven: tuple[str, ...]
    left_out: tuple[str, ...]
    point: str
    count: int


# -- acts in a polygon -------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class LaidOff:
    """A known vector, laid off by the rule of its size."""

    symbol: Symbol
    size: Size | None
    mm: float
    direction: Direction
    role: str

    @property
    def is_zero(self) -> bool:
        return self.mm == 0.0


@dataclass(frozen=True)
class FoundVector:
    """A vector found by its end point, and measured."""

    symbol: Symbol
    mm: float

    @property
    def is_zero(self) -> bool:
        return self.mm == 0.0


@dataclass(frozen=True)
class DirectionLine:
    """A line along which a vector of unknown size lies."""

    symbol: Symbol
    direction: Direction


@dataclass(frozen=True)
class _OfVector:
    symbol: Symbol


class Carried(_OfVector):
    """A known vector added before its turn in the chain."""


class PutBack(_OfVector):
    """A vector that was added before its turn, put in its place."""


class Resultant(_OfVector):
    """The vector from the pole to an end point that was found."""


class Asked(_OfVector):
    """A vector that stands in no equation, drawn because it is asked for."""


@dataclass(frozen=True)
class _AtPoint:
    point: PointRef


class LinesMeet(_AtPoint):
    """Two direction lines meet in an end point."""


class Named(_AtPoint):
    """An end point that stands already gets its letter."""


@dataclass(frozen=True)
class SamePlace:
    """Two points at one place of a link have one end point."""

    point: PointRef
    other: PointRef


@dataclass(frozen=True)
class ByRate:
    """An end point from another of the same link, by its measured rates."""

    point: PointRef
    start: PointRef
    link: str


@dataclass(frozen=True)
class ByImage:
    """An end point by the image of its link: a figure similar to the link, or, ``on_line``, a division of a line."""

    point: PointRef
    between: tuple[PointRef, PointRef]
    link: str
    on_line: bool


@dataclass(frozen=True)
class Translated:
    """A link that only translates: all its points have one end point."""

    link: str


@dataclass(frozen=True)
class MeasuredRate:
    """An angular rate (rad/s, rad/s2; counter-clockwise positive) measured from a vector and the bar it belongs to."""

    rate: Literal["omega", "alpha"]
    link: str
    vector: Symbol
    bar: tuple[str, str]
    value: float


@dataclass(frozen=True)
class PlanDrawn:
    """The line of a link in the plan of a train, by its places ``by``, or one place and its known rate; and the rate
    (rad/s, rad/s2) that it marks off, ``mm`` on the rate scale at ``per_mm``."""

    rate: Literal["omega", "alpha"]
    link: str
    by: tuple[str, ...]
    known: bool
    mm: float
    per_mm: float
    value: float


@dataclass(frozen=True)
class PlanTravel:
    """How fast a rack slides (m/s, m/s2), read off the plan of a train: ``mm`` at ``per_mm``."""

    rate: Literal["omega", "alpha"]
    slide: str
    mm: float
    per_mm: float
    value: float


@dataclass(frozen=True)
class PlanTried:
    """Rates assumed in trial plans, what each left open (mm), and the rates that follow by proportion."""

    rate: Literal["omega", "alpha"]
    links: tuple[str, ...]
    assumed: tuple[tuple[float, ...], ...]
    apart: tuple[tuple[float, ...], ...]
    found: tuple[float, ...]


@dataclass(frozen=True)
class SpecialPoint:
    """The special point of a link, where the lines of two legs with these joints cross (Assur)."""

    point: str
    link: str
    joints: tuple[str, str]


@dataclass(frozen=True)
class TrialDrawn:
    """A trial polygon by its number, with what was assumed (rad/s, or the scene's units)."""

    number: int
    assumed: tuple[tuple[Symbol, float], ...]


@dataclass(frozen=True)
class Superposed:
    """The true rates by proportional division; ``apart`` (mm) is what is left open in each trial at ``closing``."""

    found: tuple[tuple[Symbol, float], ...]
    closing: tuple[str, ...]
    apart: tuple[tuple[float, ...], ...]


OnMechanism = (
    FixedPoints | LaidOffAngle | LaidOffTravel | CompassArcs | PathDrawn | ArcOnPath | GuideThrough | GuideTouching
    | PathsCross | SlidToMeet | LinkPoints | HeldStill | SpecialPoint | TrialPositions
)  # fmt: skip
InPolygon = (
    LaidOff | FoundVector | DirectionLine | Carried | PutBack | Resultant | Asked | LinesMeet | Named | SamePlace
    | ByRate | ByImage | Translated | MeasuredRate | PlanDrawn | PlanTravel | PlanTried | TrialDrawn
    | Superposed
)  # fmt: skip
Act = OnMechanism | InPolygon

# -- causes of uncertainty besides the acts ----------------------------------------------------------------------------


@dataclass(frozen=True)
class Placing:
    """The pricking and placing of links."""

    links: tuple[str, ...]


@dataclass(frozen=True)
class ReadOff:
    """The reading itself."""

    symbol: Symbol


Cause = Act | Placing | ReadOff


_WITH_LENGTH = (LaidOffTravel, ArcOnPath, GuideTouching, LaidOff, FoundVector)
_Scalable = TypeVar("_Scalable", bound=Act)


def scaled(thing: _Scalable, times: float) -> _Scalable:
    """The same act with its lengths so many times as large."""
    if isinstance(thing, CompassArcs):
        return replace(thing, radii=(thing.radii[0] * times, thing.radii[1] * times))
    if isinstance(thing, Superposed):
        return replace(thing, apart=tuple(tuple(mm * times for mm in row) for row in thing.apart))
    return replace(thing, mm=thing.mm * times) if isinstance(thing, _WITH_LENGTH) else thing


def links_drawn(act: Act) -> tuple[str, ...]:
    """The links that an act places or draws."""
    match act:
        case FixedPoints():
            return (act.frame,)
        case LaidOffAngle() | LinkPoints():
            return (act.link,)
        case LaidOffTravel() | PathDrawn() | GuideThrough() | GuideTouching():
            pairs: tuple[str, ...] = (act.pair,)
        case PathsCross():
            pairs = act.pairs
        case SlidToMeet():
            pairs = act.along, act.until
        case TrialPositions():
            return act.links
        case _:
            pairs = ()
    return tuple(name for pair in pairs for name in pair.split("/"))


def phrase_of(thing: Cause) -> Phrase:
    """An act, or another cause of uncertainty, as a sentence to be."""
    match thing:
        case FixedPoints(frame, points):
            return Phrase("frame", (frame, ", ".join(points)))
        case LaidOffAngle(link, angle, hinge):
            return Phrase("lay off angle", (link, f"{math.degrees(angle):.6g}", hinge))
        case LaidOffTravel(pair, mm):
            return Phrase("lay off travel", (pair, on_paper(mm)))
        case CompassArcs(about, point, radii):
            return Phrase("arcs", (*about, point, *map(on_paper, radii)))
        case PathDrawn(point, pair):
            return Phrase("path", (point, pair))
        case ArcOnPath(about, point, mm):
            return Phrase("arc on path", (about, point, on_paper(mm)))
        case GuideThrough(pivot, through, pair):
            return Phrase("line of guide", (pivot, through, pair))
        case GuideTouching(pivot, through, mm, pair):
            return Phrase("tangent", (pivot, through, on_paper(mm), pair))
        case PathsCross(point, pairs):
            return Phrase("paths", (point, *pairs))
        case SlidToMeet(point, along, until):
            return Phrase("slide to meet", (point, along, until))
        case LinkPoints(link, points, transferred):
            return Phrase("transfer" if transferred else "points", (link, ", ".join(points)))
        case HeldStill(held, link, slide, gives, value):
            shown = math.degrees(value) if gives == "angle" else value
            return Phrase(f"held still {gives}", (held, link, slide, f"{shown:.6g}"))
        case SpecialPoint(point, link, joints):
            return Phrase("special point", (point, link, *joints))
        case TrialPositions(links, driven, left_out, point, count):
            key = "trial positions" if point else "trial positions without curve"
            return Phrase(key, (", ".join(links), ", ".join(driven), ", ".join(left_out), point, count))
        case Placing(links):
            return Phrase("placing", (", ".join(links),))
        case ReadOff(symbol):
            return Phrase("reading", (symbol,))
        case _:
            return _in_polygon(thing)


def _in_polygon(act: InPolygon) -> Phrase:
    match act:
        case LaidOff(symbol, size, mm, direction, role):
            if act.is_zero:
                return Phrase("zero vector", (symbol,))
            key = {"normal": "lay off normal", "coriolis": "lay off coriolis"}.get(role, "lay off")
            return Phrase(key, (symbol, size or "", on_paper(mm), direction))
        case FoundVector(symbol, mm):
            return Phrase("zero vector", (symbol,)) if act.is_zero else Phrase("found", (symbol, on_paper(mm)))
        case DirectionLine(symbol, direction):
            return Phrase("direction", (symbol, direction))
        case Carried() | PutBack() | Resultant() | Asked():
            key = {Carried: "carry", PutBack: "put back", Resultant: "resultant", Asked: "asked"}[type(act)]
            return Phrase(key, (act.symbol,))
        case LinesMeet() | Named():
            return Phrase("meet" if isinstance(act, LinesMeet) else "name", (act.point,))
        case SamePlace(point, other):
            return Phrase("same place", (point, other))
        case ByRate(point, start, link):
            return Phrase("by rate", (point, start, link))
        case ByImage(point, between, link, on_line):
            return Phrase("division" if on_line else "image", (point, *between, link))
        case Translated(link):
            return Phrase("translates", (link,))
        case TrialDrawn(number, assumed):
            if not any(value for _, value in assumed):
                return Phrase("trial polygon at rest", (number, assumed[0][0]))
            return Phrase("trial polygon", (number, *_assumed([one for one in assumed if one[1]])))
        case Superposed(found, closing, apart):
            rows = "; ".join(", ".join(f"{mm:.2f}" for mm in row) for row in apart).replace("-", "−")
            return Phrase("superposed", (", ".join(closing), rows, *_assumed(found)))
        case PlanDrawn() | PlanTravel() | PlanTried():
            return _on_plan(act)
        case MeasuredRate(rate, link, vector, bar, value):
            turning = "cw" if value < 0.0 else "ccw" if value > 0.0 else "zero"
            return Phrase(f"{rate} {turning}", (link, vector, "".join(bar), amount(abs(value), 4)))


def _assumed(rates: Sequence[tuple[Symbol, float]]) -> tuple[object, str]:
    """The first of some rates as a symbol, and its value with those that follow."""
    (first, value), *rest = rates
    more = "".join(f", {symbol} = {amount(v, 5)}" for symbol, v in rest)
    return first, f"{amount(value, 5)}{more}".replace("-", "−")


def _on_plan(act: PlanDrawn | PlanTravel | PlanTried) -> Phrase:
    letter = "ω" if act.rate == "omega" else "α"
    match act:
        case PlanDrawn(rate, link, by, known, mm, per_mm, value):
            turning = "cw" if value < 0.0 else "ccw" if value > 0.0 else "zero"
            if known:
                return Phrase(f"plan line {rate}", (link, by[0], amount(value, 4).replace("-", "−")))
            read = on_paper(mm), amount(per_mm, 6), amount(abs(value), 4)
            return Phrase(f"plan line {rate} {turning}", (link, *by, *read))
        case PlanTravel(_, slide, mm):
            return Phrase("plan travel", (slide, on_paper(mm)))
        case PlanTried(_, links, _, apart, found):
            rows = "; ".join(", ".join(f"{mm:.2f}" for mm in row) for row in apart).replace("-", "−")
            rates = ", ".join(f"{letter}_{{{n}}} = {amount(v, 5)}" for n, v in zip(links, found, strict=True))
            return Phrase("plan tried", (", ".join(f"{letter}_{{{n}}}" for n in links), rows, rates.replace("-", "−")))
