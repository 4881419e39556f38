"""A step of a construction: one verb of the hand with its arguments, and the strokes that it leaves on paper, in mm;
and the terms of vector equations, with what is known of a vector before it is drawn.

Ten verbs draw mechanisms, polygons and groups alike; the ``reason`` distinguishes the uses of a verb, and gives the
sentence of the step (`SENTENCES`) and its arguments.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, Self, TypeAlias, TypeVar, get_args

from graphkin.plane import Pose
from graphkin.scene.scene_tables import Diagram
from graphkin.scene.symbol import KINDS, PointRef, Symbol
from graphkin.scene.tables import Units
from graphkin.words import Phrase, clauses, gaps_of, listed, say, sense_of, word
from graphkin.words.symbols import RichText, Words, rate, sign
from graphkin.words.written import MOST, amount, computed, figures, increase, on_paper, printed, product, true_minus

Order = Literal["velocity", "acceleration"]
Role = Literal["resultant", "relative", "normal", "tangential", "coriolis", "sliding"]
PARTS: Mapping[str, Role] = {"an": "normal", "at": "tangential", "ak": "coriolis", "ar": "sliding"}
"""The role of each part of a relative acceleration, by its kind."""
ORDERS: tuple[Order, ...] = ("velocity", "acceleration")
ROLES: tuple[Role, ...] = get_args(Role)


# terms of vector equations


@dataclass(frozen=True)
class Direction:
    """A direction in an equation row: square to or along a named line.

    ``names`` are the letters of a bar (``("B", "C")``) or the name of a guide (``("h",)``); ``relation`` is "square",
    "along", "towards" (from the first to the second), "turned" (the relative velocity turned by 90 degrees in the sense
    of the guide's rotation) or "found" (given by a polygon of its own).
    """

    relation: Literal["square", "along", "towards", "turned", "found"]
    names: tuple[str, ...]

    def __str__(self) -> str:
        if self.relation == "towards":
            return "→".join(self.names)
        sign = {"along": "∥", "found": ""}.get(self.relation, "⊥")
        return sign + "".join(self.names)


NO_DIRECTION = Direction("found", ())


@dataclass(frozen=True)
class Size:
    """The rule of a size.

    Parameters
    ----------
    rule : "given": by the problem.  "rate": a rate, or its square, times ``factor``, the letters of a bar or a vector.
        "over radius": the square of the vector ``factor`` over the radius of curvature (m).  "slip on curves": the term
        of two outlines' curvatures along their normal, by the slip ``factor`` and the relative rate.  "rolling curves":
        their term for round outlines that roll on each other, the square of the rate times ``radius``
    rate, links : the rate of one link, or of the first from the second
    curves : the links in contact; "slip on curves": the round ones; "rolling curves": a hollow one is the second
    hollow : whether one is hollow
    radius : of curvature, or a combination of two outlines' radii (m)

    >>> str(Size("rate", ("3",), ("B", "C"), square=True))
    'ω_3²·BC'
    >>> str(Size("over radius", factor=Symbol.parse("v_B@2/B@1"), radius=0.05))
    '(v_B@2/B@1)²/ρ'
    >>> str(Size("slip on curves", ("2", "1"), Symbol.parse("v_K@2/K@1"), curves=("1",)))
    '2ω_21·v_K@2/K@1 − ω_21²ρ_1'
    >>> str(Size("rolling curves", ("3",), curves=("2", "3"), radius=0.01))
    'ω_3²·ρ_2ρ_3/(ρ_2 + ρ_3)'
    """

    rule: Literal["given", "rate", "over radius", "slip on curves", "rolling curves"]
    links: tuple[str, ...] = ()
    factor: tuple[str, str] | Symbol = ("", "")
    rate: Literal["omega", "alpha"] = "omega"
    square: bool = False
    twice: bool = False
    curves: tuple[str, ...] = ()
    hollow: bool = False
    radius: float = 0.0

    def __str__(self) -> str:
        return str(self.written("".join(self.factor) if isinstance(self.factor, tuple) else str(self.factor)))

    def written(self, factor: Words, times: str = "·", over: str = "/") -> RichText:
        """The rule with its bar or vector as written in a text, and signs of multiplication and division."""
        turning, squared = (rate(self.rate, "".join(self.links), above) for above in ("", "2"))
        rho = [sign("ρ", link) for link in self.curves]
        match self.rule:
            case "rate":
                return RichText("2" * self.twice, squared if self.square else turning, times, factor)
            case "over radius":
                return RichText("(", factor, sign(")", above="2"), over, "ρ")
            case "slip on curves" if len(rho) == 1:
                return RichText("2", turning, times, factor, " − ", squared, rho[0])
            case "slip on curves":
                parts = (RichText("(", turning, radius, " − ", factor, ")") for radius in rho)
                return RichText(turning, times, factor, " − ", *parts, "/(", rho[1], " − ", rho[0], ")")
            case "rolling curves":
                below = (rho[1], " − ", rho[0]) if self.hollow else (rho[0], " + ", rho[1])
                return RichText(squared, times, *rho, "/(", *below, ")")
        return RichText("given")


GIVEN = Size("given")


def plain_in(language: str) -> Callable[[object], str]:
    """The writer of symbols, points, sizes and directions as plain text of a language: ``v_B@3/B@2``, ``⊥BC``."""

    def written(term: object) -> str:
        if term == GIVEN:
            return word("given size", language)
        if isinstance(term, PointNames) and not term.bar:
            return say(listed(term.names), language)
        if isinstance(term, Symbol) and term.kind in ("omega", "alpha") and not term.at:
            return str(rate(term.kind, term.link + term.other))
        if isinstance(term, Symbol) and term.seen:
            return str(replace(term, seen="")) + word("symbol seen", language).format(link=term.seen)
        if isinstance(term, Size) and isinstance(term.factor, Symbol):
            term = term.written(written(term.factor))
        return str(term)

    return written


@dataclass(frozen=True)
class PointNames:
    """Points of the mechanism in a sentence: a bar by its ends, or points in a list."""

    names: tuple[str, ...]
    bar: bool = False

    def __str__(self) -> str:
        return ("" if self.bar else ", ").join(self.names)


Part = Literal["", "t", "n"]
"""All of a force, or its part that moments give (t) or its part along the bar or guide (n)."""


# on paper

Value = TypeVar("Value")
LENGTHS = {
    "tail", "tip", "through", "to", "centre", "radius", "at", "a", "b", "curve", "corners", "mm", "radii", "apart",
    "poses", "less", "span", "strokes", "by_rates", "divisions", "line", "base", "point", "contact",
}
"""Places and lengths on paper (mm), and what has such, which a scale changes; a direction stays."""


class OnPaper:
    """A value with places or lengths on paper (mm), or on a velocity ``plan``, which has a scale of its own."""

    plan: int = 0

    def scaled(self, times: float) -> Self:
        """The value with its lengths multiplied by ``times``, unless they are those of a plan."""
        if self.plan:
            return self
        return changed(self, **{name: _times(value, times) for name, value in vars(self).items() if name in LENGTHS})


def changed(value: Value, /, **fields: object) -> Value:
    """As ``replace``, for values without work in their making: a sheet is scaled for each figure, and copying the
    fields is ten times faster than reading each of them."""
    copy = object.__new__(type(value))
    vars(copy).update(vars(value), **fields)
    return copy


def _times(value: Any, times: float) -> Any:
    """Data of a step with every length on paper multiplied by ``times``."""
    if isinstance(value, tuple):
        return tuple(_times(part, times) for part in value)
    if isinstance(value, dict):
        return {name: _times(part, times) for name, part in value.items()}
    if isinstance(value, OnPaper | Pose):
        return value.scaled(times)
    return value * times if isinstance(value, float | complex) else value


@dataclass(frozen=True)
class Term(OnPaper):
    """A term of a vector equation, with the known parts of its size and direction.

    Parameters
    ----------
    size : the rule of its size (None if it was drawn before or is unknown)
    direction : as written
    part, turned : of a force: its part, and whether it is the opposite of its symbol
    role, link, pair : its part in the motion of one point relative to another; the link of both points, or the sliding
        pair at which they coincide
    along, span : on paper, while it is drawn: a unit vector along it, and the vector (mm; None: of unknown size)
    """

    symbol: Symbol
    size_known: bool
    direction_known: bool
    size: Size | None = None
    direction: Direction = NO_DIRECTION
    part: Part = ""
    turned: bool = False
    role: Role = "relative"
    link: str = ""
    pair: str = ""
    along: complex = 0j
    span: complex | None = None


# steps

DiagramName = Diagram | Literal["force"]
Verb = Literal["mark", "lay off", "line", "cross", "image", "read", "join", "carry over", "trial", "divide"]
TaskReason = Literal[
    "design places", "design pivots", "cam step pivots",  # mark
    "design stroke", "design swing", "design limit positions", "design centres", "design bar limits", "design pairs",
    "design reckoned", "cam step lifts",  # lay off
    "design sagitta", "cam step base", "cam step circles", "cam step rays", "cam step tangents", "cam step rollers",
    "cam step edge", "cam step faces", "cam step normals", "cam step normals swinging",  # line
    "design centre", "design parallel", "design arc", "design line", "design crank circle", "design feet",
    "design bar ends", "design ram", "design bisectors", "design reciprocals", "cam step swings",  # cross
    "design theta", "design measured",  # read
    "design halve", "design inverted",  # carry over
    "design trial",  # trial
    "cam step diagram",  # divide
]
"""Reasons of steps of a task with a construction of its own."""
Reason = TaskReason | Role | Literal[
    "frame", "points", "whole link", "pitch point", "letter",  # mark
    "angle", "travel", "rolling",  # lay off; and vectors, by their part in the equation
    "path", "guide", "tangent", "direction",  # line
    "arcs", "arc on path", "paths", "guide to point", "special point", "lines",  # cross
    "similar", "division", "same place", "translation", "rates",  # image
    "vector", "rate", "sum of rates", "given on plan", "plan", "plan travel",  # read
    "pole to end", "asked", "put back",  # join
    "before its turn", "held still", "seen from",  # carry over
    "positions", "polygon",  # trial
    "open ends", "plans",  # divide
    # forces
    "cut free",  # mark
    "known forces", "on lever",  # lay off
    "closed by lines",  # cross
    "inertia", "spring", "along guide", "two-force member", "about pin", "about guide",  # read
    "about driver", "system", "couple", "no couple", "balance", "all moments",  # read
    "closed", "inside",  # join
    "lever",  # carry over
]
FINDS_A_POINT: Collection[Reason] = ("arcs", "arc on path", "paths")
"""Reasons of steps by which a point of the mechanism is found, before it is marked on its link."""
NO_SYMBOL, NO_POINT, NO_PHRASE = Symbol(""), PointRef(""), Phrase("")


@dataclass(frozen=True, eq=False, repr=False)
class FarPoint:
    """Two links whose special point cannot be used.

    Parameters
    ----------
    away : its distance from the joints (m; in a vector graph in the unit of its places)
    crossing : the crossing angle of the legs' lines (rad)
    """

    links: tuple[str, str]
    away: float
    crossing: float


@dataclass(frozen=True, repr=False)
class Step(OnPaper):
    """An action on the board: one verb with its reason, its strokes and its arguments, of which those that a reason
    does not have are empty.

    Parameters
    ----------
    equation : the number of the equation that it helps to draw
    number : its number in the order, from 1; 0 before it is on a board
    symbol : the vector that it draws or finds, or by which it measures
    link : the link that it places, turns or takes
    held : the link held still, from which it is seen; "" for the frame
    plan : the velocity plan of wheels that it helps to draw, by its number from 1; 0 on a diagram
    point, points : the point that it finds, and those from which it is found, or over which it measures; or the points
        that it marks; of a vector seen from a held link its points, with that which it finds; or the places on a plan
    links : links that meet there, or that are seen; or the link of known rate and the base of the other rate
    base : the reference link; "" for the x axis, or the frame
    pairs : sliding pairs, by key
    kind : the given or read quantity; "driven" for a special point with a driver in its leg
    value, other : the given or read value (rad, m, rad/s, ...), and the value added to it
    mm, radii : lengths on paper
    per_mm : the scale of a plan; 0 on a diagram
    size, direction : of the term of its vector in the equation
    ref, refs : the end point of a polygon that it finds or names, and those from which it is found
    begins : of a vector seen from a held link, the vectors at whose ends it begins; None for the pole
    by_rates : the parts by the rates of a link, laid off in order
    trial, rates : the number of a trial polygon, and the rates (rad/s, or the scene's units) that it assumes, or that
        trials give by proportional division
    far : the useless special point that made trial polygons necessary
    closing, apart : the parts that trials leave open, and their gaps in each (mm); of plans of a train only the gaps
    ways, between : the directions of the gaps, from the end point of the first to that of the second
    less : the known vectors between these, each with its length in that direction (mm)
    """

    verb: Verb
    reason: Reason
    diagram: DiagramName = "mechanism"
    strokes: tuple[Stroke, ...] = ()
    equation: int | None = None
    number: int = 0
    symbol: Symbol = NO_SYMBOL
    link: str = ""
    held: str = ""
    plan: int = 0
    point: str = ""
    points: tuple[str, ...] = ()
    links: tuple[str, ...] = ()
    base: str = ""
    pairs: tuple[str, ...] = ()
    kind: str = ""
    value: float = 0.0
    other: float = 0.0
    mm: float = 0.0
    radii: tuple[float, ...] = ()
    per_mm: float = 0.0
    size: Size | None = None
    direction: Direction = NO_DIRECTION
    ref: PointRef = NO_POINT
    refs: tuple[PointRef, ...] = ()
    begins: tuple[Symbol | None, ...] = ()
    by_rates: tuple[Term, ...] = ()
    trial: int = 0
    rates: tuple[tuple[Symbol, float], ...] = ()
    far: FarPoint | None = None
    closing: tuple[str, ...] = ()
    apart: tuple[tuple[float, ...], ...] = ()
    ways: tuple[Direction, ...] = ()
    between: tuple[tuple[PointRef, PointRef], ...] = ()
    less: tuple[tuple[tuple[Term, float], ...], ...] = ()

    @property
    def vectors(self) -> tuple[Vector, ...]:
        """Its vectors, without those of the construction only."""
        return tuple(s for s in self.each(Vector) if not s.aid)

    @property
    def auxiliary(self) -> tuple[Vector, ...]:
        """Its vectors of the construction only."""
        return tuple(s for s in self.each(Vector) if s.aid)

    def each(self, kind: type[Value]) -> tuple[Value, ...]:
        """Its strokes of a kind."""
        return tuple(s for s in self.strokes if isinstance(s, kind))

    @property
    def phrase(self) -> Phrase:
        """The step as a phrase, without the letters of any school."""
        key = self.sentence
        return Phrase(key, **{name: self.gap(name) for name in gaps_of(key)})

    @property
    def sentence(self) -> str:
        """The key of its sentence in the table of words."""
        match self.reason:
            case "special point" if self.base:
                return f"relative special point{' driven' * (self.kind == 'driven')}"
            case "angle" if self.base:
                return "lay off angle to"
            case "frame" if not self.points:
                return "guides of the frame"
            case "points" if "/" in self.link:  # a block that only stands for a pin or a contact
                return "points alone"
            case "rolling":
                return "rolling starts at angle" if self.link else "rolling starts at travel"
            case "rates" if self.held:
                return "by rate seen" if self.symbol.kind == "v" else "by rates seen"
            case "similar" | "division" if self.held:
                return "image seen" if self.reason == "similar" else "division seen"
            case "polygon" if not any(value for _, value in self.rates):
                return "trial polygon at rest"
            case "vector":
                return "found" if self.mm else "zero vector"
        if self.reason in ROLES:
            if not self.mm:
                return "zero vector"
            if not self.direction.names:  # it was found before
                return "lay off so long" if self.size else "lay off as found"
            return {"normal": "lay off normal", "coriolis": "lay off coriolis"}.get(self.reason, "lay off")
        turning = "turning" if self.value else "zero"
        key = SENTENCES.get(self.reason, self.reason)
        return key.format(kind=self.kind, turning=turning, diagram=self.diagram)

    def gap(self, name: str) -> object:
        """The value of a gap in its sentence: an argument by its name, ``points.1`` the second of several, ``bar`` the
        points as the letters of a figure, lengths on paper as a ruler shows them; or a value that follows from its
        arguments."""
        written = self._in_figures
        if name in written:
            return written[name]
        source, _, part = name.rpartition(".")
        whole = source or part
        value = getattr(self, "points" if whole == "bar" else whole)
        if source:
            value = value[int(part)] if isinstance(value, tuple) else getattr(value, part)
        if whole in ("point", "points", "bar"):
            return PointNames((value,) if isinstance(value, str) else value, whole == "bar") if value else ""
        if isinstance(value, tuple) and not isinstance(value, PointRef):
            return listed(value)
        return on_paper(value) if isinstance(value, float) else value or ""

    @property
    def _in_figures(self) -> Mapping[str, object]:
        """A rate in figures, as measured, as the sum of two, or on the plan of a train; what is carried over from a
        held link, an angle in degrees, others in SI units; rates that trials assume or give, and their gaps."""
        match self.reason:
            case "held still":
                return {"amount": true_minus(f"{math.degrees(self.value) if self.kind == 'angle' else self.value:.6g}")}
            case "sum of rates":
                known, of = self.links
                direct = self.link == of
                total = increase(self.value, self.other if direct else -self.other)
                return {"known": known, "sign": "+" if direct else "−", "told": total,
                        "between": self.link + known if direct else known + self.link}
            case "given on plan":
                signed = "−" * (self.value < 0.0) + printed(on_paper(self.mm))
                return {"told": printed(amount(self.value, 4)), "signed": signed}
            case "plan":
                per = amount(self.per_mm, 6)
                return {"per": printed(per), "product": printed(product(on_paper(self.mm), per))}
            case "rate":
                carried = min(MOST - 1, figures(on_paper(self.mm))) if self.mm else MOST - 1
                return {"told": printed(computed(abs(self.value), carried))}
            case "polygon":
                return _assumed([pair for pair in self.rates if pair[1]] or self.rates)
            case "open ends" | "plans":
                open_at = [f"{name} ({direction})" for name, direction in zip(self.closing, self.ways, strict=True)]
                gaps = clauses([listed([true_minus(f"{mm:.2f}") for mm in row]) for row in self.apart])
                of_links = [(rate(symbol.kind, symbol.link), value) for symbol, value in self.rates]
                rates = listed([name + f" = {printed(amount(value, 5))}" for name, value in of_links])
                parted = {"open_at": listed(open_at), "apart": gaps, "names": listed([name for name, _ in of_links])}
                return {**parted, "rates": rates, **_assumed(self.rates)}
        return {}

    @property
    def sense(self) -> Phrase:
        """The sense of its rate."""
        return sense_of(self.value)

    @property
    def degrees(self) -> str:
        """The given angle as it is written (degrees)."""
        return true_minus(f"{math.degrees(self.value):.6g}")

    @property
    def unit(self) -> str:
        """The unit of the rate of a link, in print."""
        return Units().of(KINDS[self.kind].measure).written

    @property
    def start(self) -> tuple[Phrase, ...]:
        """The ends of the vectors at which it begins."""
        return tuple(map(end_of, self.begins))

    @property
    def seen(self) -> str:
        """The link whose rate it takes, with the link held still."""
        return self.link + self.held

    @property
    def finds_rate(self) -> bool:
        """Whether it finds the rate of a link against the frame."""
        return self.reason in ("rate", "sum of rates", "plan") and not self.held

    @property
    def links_drawn(self) -> tuple[str, ...]:
        """The links of the mechanism that it places or draws."""
        if self.reason in ("frame", "points", "whole link", "angle"):
            return (self.link,)
        placed = self.verb in ("lay off", "line", "cross") and self.reason != "rolling"
        return tuple(name for pair in self.pairs for name in pair.split("/")) if placed else ()


Cause: TypeAlias = Step | Phrase
"""What brings an error into the drawing: a step, or the placing of links and the reading itself, in words."""


def phrase_of(cause: Cause) -> Phrase:
    """A step, or another cause of uncertainty, as a phrase."""
    return cause if isinstance(cause, Phrase) else cause.phrase


# strokes

LineKind = Literal["given", "construction", "limit", "mechanism"]
"""Lines that a task gives, help lines, bars in other positions, and the mechanism that is found."""


@dataclass(frozen=True)
class Vector(OnPaper):
    """A vector: ``symbol`` from ``tail`` to ``tip``, with its part in an equation.

    An ``aid`` is a vector of the construction only: of a ``trial`` polygon by its number (0 for none), of a special
    point, or seen from a held link.
    """

    symbol: Symbol
    tail: complex
    tip: complex
    role: Role = "relative"
    aid: bool = False
    trial: int = 0

    @property
    def span(self) -> complex:
        """The vector on paper (mm), from tail to tip."""
        return self.tip - self.tail


@dataclass(frozen=True)
class Ray(OnPaper):
    """A direction known only as a line, through a point, drawn up to the crossing ``to`` (None without one)."""

    through: complex
    along: complex
    to: complex | None
    direction: Direction = NO_DIRECTION
    symbol: Symbol = NO_SYMBOL


@dataclass(frozen=True)
class CompassArc(OnPaper):
    """A compass arc about ``centre`` through the point ``at`` that it finds; or the ``whole`` circle."""

    centre: complex
    radius: float
    at: complex
    whole: bool = False


@dataclass(frozen=True)
class Bar(OnPaper):
    """A line of the mechanism or of a construction from a to b, of a task by its ``kind``."""

    a: complex
    b: complex
    link: str = ""
    kind: LineKind = "construction"


@dataclass(frozen=True)
class Angle(OnPaper):
    """An angle at a place, with its value (rad) and its name, from the leg through ``a`` to that through ``b``,
    counter-clockwise."""

    at: complex
    a: complex
    b: complex
    value: float
    name: str = ""


@dataclass(frozen=True)
class Curve(OnPaper):
    """A curve by its places: of a group's free ``point``, through its places ``at`` in trial positions, or of a cam."""

    curve: tuple[complex, ...]
    at: tuple[complex, ...] = ()
    point: str = ""


@dataclass(frozen=True)
class Mark(OnPaper):
    """A named point of a figure, of a task perhaps a ``fixed`` pivot.  ``ref`` without a point name is the pole, on the
    mechanism a point without a name."""

    ref: PointRef
    at: complex
    fixed: bool = False


@dataclass(frozen=True)
class Image(OnPaper):
    """The image of a link: the end points of its points, in order."""

    link: str
    corners: tuple[complex, ...]


Stroke = Vector | Curve | Ray | CompassArc | Bar | Angle | Mark | Image


# trials


@dataclass(frozen=True, eq=False, repr=False)
class MeasuredGap:
    """The measured gap of a left-out part.

    Parameters
    ----------
    names : of its ends
    length : of a bar (m)
    angle : whether it is an angle, else a length
    """

    kind: Literal["bar", "guide", "turn", "travel", "guides", "rolled"]
    names: tuple[str, ...]
    length: float
    angle: bool


TrialRow: TypeAlias = tuple[tuple[float, ...], tuple[float, ...]]
"""The values of what is moved in a trial position, and what is missed there (rad, m)."""


@dataclass(frozen=True, repr=False)
class TrialPositions(Step):
    """A group placed by trial.

    Parameters
    ----------
    links, group : the links of the group, and the group in words
    driven : the moved quantities
    left_out : the link (or driver) left out until it fits
    rolling : contacts or gears at which the rolling must fit that since the scene's own position
    point, count : the free point whose trial curve is drawn ("" for none), and the number of trial positions
    instead : left-out driven blocks, each with the link that is driven in its place and the block's angle from it (rad)
    moved, missed, trials : what is moved, what is missed, and both as measured in each trial: angles from a link (""
        for the x axis) and travels; empty if none could be drawn
    divided : positions by proportional division, in order, the last one without a gap
    before : with a single moved quantity the number (from 1) of the trial between which and the next the first divided
        position lies
    parts, replaced : with several, each trial but the first differs from it in one of them: the parts of these steps
        that together make the first divided position, and the number (from 1) of the trial that each divided position
        replaces
    """

    group: Phrase = NO_PHRASE
    driven: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    count: int = 0
    rolling: tuple[str, ...] = ()
    instead: tuple[tuple[str, str, float], ...] = ()
    moved: tuple[Symbol, ...] = ()
    missed: tuple[MeasuredGap, ...] = ()
    trials: tuple[TrialRow, ...] = ()
    divided: tuple[TrialRow, ...] = ()
    before: int = 0
    parts: tuple[float, ...] = ()
    replaced: tuple[int, ...] = ()

    @property
    def phrase(self) -> Phrase:
        """The step as a phrase, without the letters of any school."""
        phrase = super().phrase
        for block, link, turned in self.instead:
            angle = true_minus(f"{math.degrees(turned) + 0.0:.6g}")
            phrase = Phrase("driven in its stead", told=phrase, block=block, link=link, angle=angle)
        return phrase

    @property
    def sentence(self) -> str:
        """The key of its sentence in the table of words."""
        if self.rolling:
            return f"trial positions rolling{' and others' * bool(self.left_out)}"
        return "trial positions" if self.point else "trial positions without curve"

    @property
    def links_drawn(self) -> tuple[str, ...]:
        """The links of the mechanism that it places or draws."""
        return self.links


# in words

SENTENCES: Mapping[Reason, str] = {
    "whole link": "transfer", "letter": "name", "angle": "lay off angle", "travel": "lay off travel",
    "guide": "line of guide", "guide to point": "slide to meet", "lines": "meet", "similar": "image",
    "translation": "translates", "rates": "by rate", "pole to end": "resultant", "before its turn": "carry",
    "rate": "{kind} {turning}", "sum of rates": "added {kind}", "given on plan": "plan line {kind}",
    "plan": "plan line {kind} {turning}", "held still": "held still {kind}", "seen from": "seen from {diagram}",
    "polygon": "trial polygon", "open ends": "superposed", "plans": "plan tried",
    "inertia": "force step inertia", "spring": "force spring", "cut free": "force step cut",
    "along guide": "force reason along", "two-force member": "force two-force member", "about pin": "force reason pin",
    "about guide": "force reason guide", "about driver": "force reason driver", "system": "force reason system",
    "known forces": "force step lay", "closed": "force polygon closes", "closed by lines": "force polygon closes",
    "inside": "force step inside", "couple": "force reason couple", "no couple": "force no couple",
    "balance": "force reason balance", "lever": "lever reason", "on lever": "lever step forces",
    "all moments": "lever sum",
}
"""The key in the table of words of steps that are told in one way, or in one for each kind; of others the reason is the
key."""


def end_of(vector: Symbol | None) -> Phrase:
    """The end of a vector from the pole; None for a vector without length."""
    return Phrase("the pole itself") if vector is None else Phrase("the end of", vector=vector)


def _assumed(rates: Sequence[tuple[Symbol, float]]) -> dict[str, object]:
    """The first of some rates as a symbol, and its value with the others."""
    values = [(symbol, symbol.unit(Units()).beside(printed(amount(value, 5)))) for symbol, value in rates]
    more = [f", {symbol} = {value}" for symbol, value in values[1:]]
    return {"first": rates[0][0], "values": "".join((values[0][1], *more))}
