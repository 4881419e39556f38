"""The acts by which a polygon is drawn and measured, and the sentence of each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from graphkin.construction.sizes import Direction, Size
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, listed
from graphkin.words.written import MOST, amount, computed, figures, increase, on_paper, product, true_minus

__all__ = [
    "AddedRate",
    "Asked",
    "ByImage",
    "ByRate",
    "Carried",
    "DirectionLine",
    "FarPoint",
    "FoundVector",
    "ImageSeen",
    "InPolygon",
    "LaidOff",
    "LinesMeet",
    "MeasuredRate",
    "Named",
    "OnPlan",
    "PlanDrawn",
    "PlanTravel",
    "PlanTried",
    "PutBack",
    "RateSeen",
    "Resultant",
    "SamePlace",
    "SeenByRate",
    "SeenFrom",
    "Superposed",
    "TakenOff",
    "Translated",
    "TrialDrawn",
    "end_of",
    "polygon_phrase",
]


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
    """An act on one vector."""

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
    """An act at one point."""

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
    """An angular rate (rad/s, rad/s2; counter-clockwise positive) measured from a vector, ``mm`` long on paper, and the
    bar it belongs to."""

    rate: Literal["omega", "alpha"]
    link: str
    vector: Symbol
    bar: tuple[str, str]
    value: float
    mm: float


@dataclass(frozen=True)
class AddedRate:
    """An angular rate (rad/s, rad/s2) from the ``value`` of that of a ``known`` link; how the two turn relative to each
    other, ``apart``, is given, or seen: that of link ``of`` relative to the other."""

    rate: Literal["omega", "alpha"]
    link: str
    known: str
    of: str
    value: float
    apart: float


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


OnPlan: TypeAlias = PlanDrawn | PlanTravel | PlanTried


@dataclass(frozen=True)
class FarPoint:
    """Two links whose special point cannot be used: how far from the joints (m; in a net as its places), and at which
    angle (rad) the lines of the legs cross."""

    links: tuple[str, str]
    away: float
    crossing: float


@dataclass(frozen=True)
class TrialDrawn:
    """A trial polygon by its number, with what was assumed (rad/s, or the scene's units); ``far`` is the special point
    for want of which."""

    number: int
    assumed: tuple[tuple[Symbol, float], ...]
    far: FarPoint | None = None


@dataclass(frozen=True)
class TakenOff:
    """A known vector with the rule of its size, and how long it is (mm) in the direction in which something is open."""

    symbol: Symbol
    size: Size | None
    mm: float


@dataclass(frozen=True)
class SeenFrom:
    """Links of a contour are seen from one that is held still, in an ``order``: what follows is drawn so."""

    held: str
    links: tuple[str, ...]
    order: Literal["velocity", "acceleration"]


@dataclass(frozen=True)
class RateSeen:
    """How a link turns as seen from a held one (rad/s, rad/s2), measured from a vector, ``mm`` long, and its bar."""

    rate: Literal["omega", "alpha"]
    link: str
    held: str
    vector: Symbol
    bar: tuple[str, str]
    value: float
    mm: float


@dataclass(frozen=True)
class ImageSeen:
    """The vector to a point of a link as seen from a held one, by the image of the link over two others: a similar
    figure, or, ``on_line``, a division of a line."""

    vector: Symbol
    between: tuple[Symbol | None, Symbol | None]
    points: tuple[str, str, str]
    link: str
    on_line: bool


@dataclass(frozen=True)
class SeenByRate:
    """The vector to a point of a link as seen from a held one, by the rates of the link laid off from ``start``, that
    to its point ``origin`` (None: it rests)."""

    vector: Symbol
    origin: PointRef
    start: Symbol | None
    link: str
    held: str


@dataclass(frozen=True)
class Superposed:
    """The true rates by proportional division; ``apart`` (mm) is what is left open in each trial at ``closing``, along
    ``ways``: from the end point of the first of ``between`` to that of the second, less what is known between them,
    ``less``."""

    found: tuple[tuple[Symbol, float], ...]
    closing: tuple[str, ...]
    apart: tuple[tuple[float, ...], ...]
    ways: tuple[Direction, ...]
    between: tuple[tuple[PointRef, PointRef], ...]
    less: tuple[tuple[TakenOff, ...], ...]


InPolygon = (
    LaidOff | FoundVector | DirectionLine | Carried | PutBack | Resultant | Asked | LinesMeet | Named | SamePlace
    | ByRate | ByImage | Translated | MeasuredRate | AddedRate | OnPlan | TrialDrawn
    | Superposed | SeenFrom | RateSeen | ImageSeen | SeenByRate
)  # fmt: skip


def polygon_phrase(act: InPolygon) -> Phrase:
    """An act in a polygon as a sentence to be."""
    match act:
        case LaidOff(symbol, size, mm, direction, role):
            if act.is_zero:
                return Phrase("zero vector", (symbol,))
            if not direction.names:  # it was found before
                return Phrase("lay off so long", (symbol, size, on_paper(mm))) if size else Phrase(
                    "lay off as found", (symbol, on_paper(mm))
                )
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
        case TrialDrawn(number, assumed, _):
            if not any(value for _, value in assumed):
                return Phrase("trial polygon at rest", (number, assumed[0][0]))
            return Phrase("trial polygon", (number, *_assumed([one for one in assumed if one[1]])))
        case Superposed(found, closing, apart, ways, _, _):
            rows = true_minus("; ".join(", ".join(f"{mm:.2f}" for mm in row) for row in apart))
            open_at = ", ".join(f"{name} ({way})" for name, way in zip(closing, ways, strict=True))
            return Phrase("superposed", (open_at, rows, *_assumed(found)))
        case SeenFrom(held, links, order):
            return Phrase(f"seen from {order}", (held, listed(links)))
        case ImageSeen(vector, between, points, link, on_line):
            key = "division seen" if on_line else "image seen"
            return Phrase(key, (vector, *map(end_of, between), link, "".join(points)))
        case SeenByRate(vector, _, start, link, held):
            key = "by rate seen" if vector.kind == "v" else "by rates seen"
            return Phrase(key, (vector, end_of(start), f"{link}{held}"))
        case PlanDrawn() | PlanTravel() | PlanTried():
            return _on_plan(act)
        case RateSeen(rate, link, held, vector, bar, value, mm):
            return polygon_phrase(MeasuredRate(rate, f"{link}{held}", vector, bar, value, mm))
        case AddedRate(rate, link, known, of, value, apart):
            signed = ("+", link + known) if link == of else ("−", known + link)
            told = increase(value, apart if link == of else -apart)
            return Phrase(f"added {rate}", (link, known, *signed, told))
        case MeasuredRate(rate, link, vector, bar, value, mm):
            turning = "cw" if value < 0.0 else "ccw" if value > 0.0 else "zero"
            carried = min(MOST - 1, figures(on_paper(mm))) if mm else MOST - 1
            return Phrase(f"{rate} {turning}", (link, vector, "".join(bar), computed(abs(value), carried)))


def end_of(vector: Symbol | None) -> Phrase:
    """Where a vector from the pole ends; None: it has no length."""
    return Phrase("the pole itself") if vector is None else Phrase("the end of", (vector,))


def _assumed(rates: Sequence[tuple[Symbol, float]]) -> tuple[object, str]:
    """The first of some rates as a symbol, and its value with those that follow."""
    (first, value), *rest = rates
    units = {"omega": " rad/s", "alpha": " rad/s²"}
    more = "".join(f", {symbol} = {amount(v, 5)}{units.get(symbol.kind, '')}" for symbol, v in rest)
    return first, true_minus(f"{amount(value, 5)}{units.get(first.kind, '')}{more}")


def _on_plan(act: OnPlan) -> Phrase:
    letter = "ω" if act.rate == "omega" else "α"
    match act:
        case PlanDrawn(rate, link, by, known, mm, per_mm, value):
            turning = "cw" if value < 0.0 else "ccw" if value > 0.0 else "zero"
            if known:
                told = true_minus(amount(value, 4))
                return Phrase(f"plan line {rate}", (link, by[0], told, "−" * (value < 0.0) + on_paper(mm)))
            read = on_paper(mm), amount(per_mm, 6)
            return Phrase(f"plan line {rate} {turning}", (link, *by, *read, product(*read)))
        case PlanTravel(_, slide, mm):
            return Phrase("plan travel", (slide, on_paper(mm)))
        case PlanTried(_, links, _, apart, found):
            rows = true_minus("; ".join(", ".join(f"{mm:.2f}" for mm in row) for row in apart))
            rates = ", ".join(f"{letter}_{{{n}}} = {amount(v, 5)}" for n, v in zip(links, found, strict=True))
            return Phrase("plan tried", (", ".join(f"{letter}_{{{n}}}" for n in links), rows, true_minus(rates)))
