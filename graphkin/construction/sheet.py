"""What stands on the paper after a construction, and the board on which it grows: strokes in mm, in numbered steps,
each with its reason.

Coordinates are complex numbers in mm on paper, y up.  The mechanism is drawn from the world's origin, the velocity and
acceleration polygons from their poles; where a figure is placed on a page is not decided here.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypeVar

from graphkin.construction.instruments import EXACT_NAME, Exact, Instrument
from graphkin.construction.links_on_paper import Pose
from graphkin.construction.steps import DIAGRAMS, Aid, Cause, DiagramName, Mark, Step, Term, Vector
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, cross_lines
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure.model import Element, LargerGroup, Structure
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.construction.trains import TrainPlan

__all__ = [
    "Board", "DrawnGroup", "Equation", "LimitPosition", "Limits", "Rate", "Remark", "Scales", "Sheet",
    "either_way",
]  # fmt: skip

_Thing = TypeVar("_Thing")
PARALLEL = 1e-12  # sine below which two lines have no crossing at all
REACH = 2000.0  # mm to either side: how far a construction line is drawn
SHARP = math.sin(math.radians(15.0))
SHORT = 3.0  # mm on paper; a direction drawn through two points nearer than this errs by a pencil's width in ten
MAGNIFIED = 2.0  # times as much as was left open: from there on it is said


@dataclass(frozen=True)
class Remark:
    """What may have to be said of a construction: whether it ``holds`` depends on the scale of the figure.

    Parameters
    ----------
    key : its phrase.  "sharp crossing": two lines cross at so small an angle that the place is uncertain; "off the
        sheet": they cross so far from where they start that rulers do not reach, and the place is computed; "zero
        vector"; "short arm": the two points lie too near to each other that direct a guide; "magnified": what a trial
        polygon leaves open and is read wrong moves end points by so many times as much; "parallel legs": two legs of a
        link leave it free along one direction, their special point lies at infinity; "at contact", "at pitch curve":
        a sliding contact is drawn at the contact itself, or as a pin on the pitch curve, not by what replaces it
    of : what is found there, or what it is said of
    size : the sine of the angle of a sharp crossing, by how much it is magnified, else a length on paper (mm)
    """

    key: Literal["sharp crossing", "off the sheet", "zero vector", "short arm", "magnified", "parallel legs",
                 "at contact", "at pitch curve"]  # fmt: skip
    of: tuple[str | Symbol | Phrase, ...]
    size: float = 0.0

    @property
    def holds(self) -> bool:
        match self.key:
            case "sharp crossing":
                return self.size < SHARP
            case "off the sheet":
                return self.size > REACH
            case "short arm":
                return self.size < SHORT
            case "magnified":
                return self.size > MAGNIFIED
        return self.size == 0.0

    @property
    def phrase(self) -> Phrase:
        match self.key:
            case "sharp crossing":
                return Phrase(self.key, (*self.of, f"{math.degrees(math.asin(self.size)):.2g}"))
            case "magnified":
                return Phrase(self.key, (*self.of, f"{self.size:.2g}"))
            case "short arm":
                links, one, other = self.of
                return Phrase(self.key, (links, one, f"{self.size:.2g}", other))
        return Phrase(self.key, self.of)

    def scaled(self, times: float) -> Remark:
        """The same where lengths on paper are so many times as large."""
        return self if self.key in ("sharp crossing", "magnified") else replace(self, size=self.size * times)


@dataclass(frozen=True)
class Scales:
    """Scale factors: m, m/s, m/s2 and N for one mm of paper; ``force`` is 0 where no forces are drawn."""

    length: float
    velocity: float
    acceleration: float
    force: float = 0.0

    def of(self, diagram: DiagramName) -> float:
        return {
            "mechanism": self.length, "velocity": self.velocity, "acceleration": self.acceleration, "force": self.force,
        }[diagram]  # fmt: skip


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
    ``same_as``), ``mm`` its length on paper and ``arm_mm`` that of the bar; without a bar ``mm`` was read off the rate
    scale of a velocity plan.
    """

    link: str
    value: float
    vector: Symbol | None = None
    mm: float = 0.0
    arm_mm: float = 0.0
    same_as: str = ""

    @property
    def off_plan(self) -> bool:
        """Whether it was read off the velocity plan of a train."""
        return self.mm != 0.0 and not self.arm_mm

    @property
    def is_own(self) -> bool:
        """Whether it was read off by itself, neither given nor that of another link."""
        return (self.vector is not None or self.off_plan) and not self.same_as

    def scaled(self, vector_times: float, arm_times: float) -> Rate:
        """The same rate read off larger figures; one that was read off a velocity plan stays."""
        if self.off_plan:
            return self
        return replace(self, mm=self.mm * vector_times, arm_mm=self.arm_mm * arm_times)


@dataclass(frozen=True)
class LimitPosition:
    """The mechanism drawn once more, at a limit position of an output: the crank's value (rad) and where links lie."""

    value: float
    poses: Mapping[str, Pose]

    def scaled(self, times: float) -> LimitPosition:
        return LimitPosition(self.value, {name: pose.scaled(times) for name, pose in self.poses.items()})


@dataclass(frozen=True)
class Limits:
    """Both limit positions of a slide or of a link over a whole turn of the crank, the one furthest along the guide's
    sense, or furthest counter-clockwise, being ``high``; ``swing`` is how far a link turns between them (rad), to a
    few degrees."""

    low: LimitPosition
    high: LimitPosition
    swing: float

    def scaled(self, times: float) -> Limits:
        return Limits(self.low.scaled(times), self.high.scaled(times), self.swing)


@dataclass(frozen=True)
class DrawnGroup:
    """How a group larger than a dyad was drawn: ``kept`` names the links (or drivers) left out for its trial positions,
    ``assumed`` what was assumed in trial polygons and ``closing`` what had to fit in them (links, or sliding pairs),
    ``points`` its special points with their links."""

    group: LargerGroup
    way: Literal["special points", "superposition"]
    kept: tuple[str, ...]
    assumed: tuple[str, ...]
    closing: tuple[str, ...]
    points: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Sheet:
    """Everything drawn, in order.

    ``ends`` gives the end points in each polygon: ends["velocity"][PointRef("B", "3")] is b3.
    ``omega`` and ``alpha`` hold the measured rates by link.
    ``noticed`` are what may have to be said of the construction, by diagram.
    ``causes`` tells to what the acts of the hand belong: (acts made when it was done, what).
    ``left_out`` says what nothing asked for needs; ``held_still`` are steps drawn apart, with one link for a frame.
    ``asked`` is what is asked for, if the drawing is limited to it; ``limits`` are the limit positions drawn for it, by
    sliding pair or link.
    ``groups`` tells how each group larger than a dyad was drawn.
    ``acting`` says of each load whether it acts here (None where it begins or ends exactly here), if forces are drawn;
    ``growing`` are then, where the mechanism rests or has several drivers, drawings with each driver's value alone
    growing at a unit rate.
    ``trains`` are the velocity plans of what rolls, at scales of their own.
    ``readings`` are the lengths (mm) that a hand which errs has read for the construction, of vectors by their symbols
    (`either_way`), of the mechanism by the two points.
    """

    scene: Mechanism
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
    noticed: tuple[tuple[DiagramName, Remark], ...] = ()
    causes: tuple[tuple[int, Cause], ...] = ()
    left_out: tuple[Phrase, ...] = ()
    held_still: tuple[Step, ...] = ()
    asked: tuple[Symbol, ...] = ()
    limits: Mapping[str, Limits] = field(default_factory=dict)
    groups: tuple[DrawnGroup, ...] = ()
    acting: Mapping[str, bool | None] = field(default_factory=dict)
    growing: tuple[Sheet, ...] = ()
    trains: tuple[TrainPlan, ...] = ()
    readings: Mapping[Symbol | frozenset[str], float] = field(default_factory=dict)

    @property
    def has_forces(self) -> bool:
        """Whether forces are drawn of it: there are masses or loads, and all is drawn that they need."""
        wanted = not self.asked or any(s.scope in ("force", "cycle") for s in self.asked)
        return bool(self.scene.loading) and wanted

    def larger(self, times: float) -> Sheet:
        """The mechanism alone so many times as large, drawn by any hands."""
        return replace(
            self, scales=replace(self.scales, length=self.scales.length / times), steps=(),
            poses={name: pose.scaled(times) for name, pose in self.poses.items()},
            points={ref: z * times for ref, z in self.points.items()},
        )  # fmt: skip

    def at(self, scales: Scales) -> Sheet:
        """The same construction at other scales: every length on paper so many times as large.

        Raises
        ------
        ValueError : it was drawn by hands that err, whose errors depend on the scale
        """
        if self.instrument != EXACT_NAME:
            raise ValueError(f"a sheet drawn by {self.instrument} is drawn anew at other scales")
        if scales == self.scales:
            return self
        k: dict[DiagramName, float] = {name: self.scales.of(name) / scales.of(name) for name in DIAGRAMS}
        length, velocity, acceleration = k.values()
        return replace(
            self,
            scales=scales,
            poses={name: pose.scaled(length) for name, pose in self.poses.items()},
            points={ref: z * length for ref, z in self.points.items()},
            ends={
                "velocity": {ref: z * velocity for ref, z in self.ends["velocity"].items()},
                "acceleration": {ref: z * acceleration for ref, z in self.ends["acceleration"].items()},
            },
            omega={name: rate.scaled(velocity, length) for name, rate in self.omega.items()},
            alpha={name: rate.scaled(acceleration, length) for name, rate in self.alpha.items()},
            steps=tuple(step.scaled(k[step.diagram]) for step in self.steps),
            held_still=tuple(step.scaled(k[step.diagram]) for step in self.held_still),
            noticed=tuple((name, remark.scaled(k[name])) for name, remark in self.noticed),
            limits={pair: limits.scaled(length) for pair, limits in self.limits.items()},
        )

    @property
    def remarks(self) -> tuple[Remark, ...]:
        """What is to be said of the construction at these scales: lines that meet off the sheet, zero vectors."""
        return tuple(remark for _, remark in self.noticed if remark.holds)

    @property
    def notes(self) -> tuple[Phrase, ...]:
        """The remarks as sentences to be, each once."""
        return tuple(dict.fromkeys(remark.phrase for remark in self.remarks))

    @cached_property
    def drawn_in(self) -> dict[Symbol, int]:
        """The step in which each vector is first drawn."""
        drawn = [(s.symbol, step.number) for step in self.steps for s in step.strokes if isinstance(s, Vector)]
        return dict(reversed(drawn))

    def arm_mm(self, between: Iterable[str]) -> float | None:
        """How far two points of the mechanism lie apart (mm), as read where a hand has; None for one that is not there.
        """
        names = frozenset(between)
        ends = [self.points.get(PointRef(name)) for name in names]
        if any(z is None for z in ends):
            return None
        return self.readings.get(names, abs(ends[0] - ends[-1]))  # type: ignore[operator]

    def vectors(self, diagram: DiagramName) -> dict[Symbol, Vector]:
        """All vectors of a diagram by symbol."""
        return {
            s.symbol: s for step in self.steps if step.diagram == diagram for s in step.strokes if isinstance(s, Vector)
        }

    def before(self, step: Step) -> tuple[Step, ...]:
        """The steps before one of them."""
        return self.steps[: step.number - 1]

    def trials(self, diagram: DiagramName) -> list[Aid]:
        """The vectors of trial polygons in a diagram."""
        strokes = (s for step in self.steps if step.diagram == diagram for s in step.strokes)
        return [s for s in strokes if isinstance(s, Aid) and s.trial]


def either_way(symbol: Symbol) -> Symbol:
    """A vector by the name of that or of its opposite, whichever is first: both are as long.

    >>> str(either_way(Symbol.parse("v_C/B"))), str(either_way(Symbol.parse("v_B/C")))
    ('v_B/C', 'v_B/C')
    """
    if symbol.kind != "v" or symbol.of is None or symbol.to is None:
        return symbol
    of, to = sorted((symbol.of, symbol.to), key=str)
    return replace(symbol, of=of, to=to)


# -- the board on which it grows ---------------------------------------------------------------------------------------


@dataclass
class Board:
    """Steps in the order in which they are done, and what was read; the one thing in this room that grows.

    ``arms`` are the lengths (mm) read between two points of the mechanism, ``lengths`` those of vectors: what has been
    read once is used at each later use.
    """

    instrument: Instrument
    steps: list[Step] = field(default_factory=list)
    equations: list[Equation] = field(default_factory=list)
    noticed: list[tuple[DiagramName, Remark]] = field(default_factory=list)
    causes: list[tuple[int, Cause]] = field(default_factory=list)  # acts of the hand up to which each step reaches
    arms: dict[frozenset[str], float] = field(default_factory=dict)
    lengths: dict[Symbol, float] = field(default_factory=dict)

    def again(self, hand: Instrument) -> Board:
        """What stands on the board, to go on with by other hands."""
        kept = {name: copy(value) for name, value in vars(self).items() if name != "instrument"}
        return Board(hand, **kept)

    def do(self, step: Step) -> None:
        """Record one step, by its number in the order."""
        step = replace(step, number=len(self.steps) + 1)
        self.steps.append(step)
        self.causes.append((self.instrument.acts, step))

    def read_arm(self, between: Sequence[str], mm: float) -> float:
        """The distance of two points on paper (mm), read when it is first needed."""
        return self._read(self.arms, frozenset(between), mm)

    def read_vector(self, symbol: Symbol, mm: float) -> float:
        """The length of a vector on paper (mm), read when it is first needed."""
        return self._read(self.lengths, either_way(symbol), mm)

    def _read(self, kept: dict[_Thing, float], thing: _Thing, mm: float) -> float:
        if isinstance(self.instrument, Exact):
            return self.instrument.read(mm)  # it shows the same each time
        if thing not in kept:
            kept[thing] = self.instrument.read(mm)
        return kept[thing]

    def pricked(self, diagram: DiagramName, mark: Mark) -> bool:
        """Whether an end point stands there already: two lines have met in it, or the last vector ends in it and now
        bears its letter."""
        if any(mark in step.strokes for step in self.steps if step.diagram == diagram):
            return True
        last = self.steps[-1]
        ends = (s.tip for s in last.strokes if last.diagram == diagram and isinstance(s, Vector | Aid))
        if mark.at not in ends:
            return False
        self.steps[-1] = replace(last, strokes=(*last.strokes, mark))
        return True

    def notice(self, diagram: DiagramName, remark: Remark) -> None:
        """Take note of what may have to be said, at this scale or at another."""
        self.noticed.append((diagram, remark))

    def cross(self, diagram: DiagramName, p: complex, d: complex, q: complex, e: complex, what: str) -> complex:
        """Where the line through p along d meets the line through q along e, drawn as ruler lines.

        Raises
        ------
        Unsolvable
            status "dead point": the lines are parallel and meet nowhere
        """
        d, e = self.instrument.direction(d), self.instrument.direction(e)
        sine = abs(cross(d, e))
        if sine < PARALLEL:
            raise Unsolvable(
                "dead point",
                Problem(
                    what, Phrase("the two lines that should find it are"), Phrase("move the driver off this position")
                ),
            )
        self.notice(diagram, Remark("sharp crossing", (what,), sine))
        at = cross_lines(p, d, q, e)
        assert at is not None
        self.notice(diagram, Remark("off the sheet", (what,), max(abs(at - p), abs(at - q))))
        return self.instrument.point(at)
