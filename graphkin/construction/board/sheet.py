"""The paper after a construction, and the board on which it grows: strokes in mm, in numbered steps, each with its
reason.

Coordinates are complex numbers in mm on paper, y up.  The mechanism is drawn from the world's origin, the velocity and
acceleration polygons from their poles; their places on a page are decided elsewhere.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal

from graphkin.construction.board.instruments import EXACT_NAME, Instrument
from graphkin.construction.board.scales import Rectangle, Room, Scales, chosen_scales, extent_of
from graphkin.construction.board.steps import (
    ORDERS,
    Bar,
    Cause,
    DiagramName,
    Mark,
    OnPaper,
    PointNames,
    Reason,
    Step,
    Term,
    Vector,
    changed,
)
from graphkin.plane import Pose, cross
from graphkin.scene.model import Mechanism
from graphkin.scene.scene_tables import DIAGRAMS, Diagram
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import greatest_before
from graphkin.structure.model import Element, LargerGroup, Structure
from graphkin.words import Neutral, Phrase, bodies_named, gaps_of, joined, listed
from graphkin.words.written import amount

if TYPE_CHECKING:
    from graphkin.construction.forces.steps import ForceState, ForceStep, Inertia
    from graphkin.construction.trains import TrainPlan

REACH = 2000.0  # mm to either side: how far a construction line is drawn
SHARP = math.sin(math.radians(15.0))
SHORT = 3.0  # mm on paper; a direction drawn through two points nearer than this errs by a pencil's width in ten
INTO_MARGIN = 1.1  # times as large as its room may trial polygons and carried vectors be: panels have a margin
LOST = 1e-13  # of the largest vector, by rounding, where lines cross square
MOST_LOST = 1e-9  # what is larger is no residue, however lines cross
MAGNIFIED = 2.0  # times as much as was left open: from there on it is said


Remarkable = Literal[
    "sharp crossing", "off the sheet", "zero vector", "short arm", "magnified", "parallel legs", "at contact",
    "at pitch curve",
]


@dataclass(frozen=True)
class Remark(OnPaper):
    """A possible remark on the construction: whether it ``holds`` depends on the scale of the figure.

    Parameters
    ----------
    key : its phrase.  "sharp crossing": two lines cross at so small an angle that the place is uncertain; "off the
        sheet": they cross so far from their starts that rulers do not reach, and the place is computed; "zero
        vector"; "short arm": the two points lie too near to each other that direct a guide; "magnified": an error in
        reading a trial polygon's gap moves end points by a multiple of it; "parallel legs": two legs of a link leave it
        free along one direction, their special point lies at infinity; "at contact", "at pitch curve": a sliding
        contact is drawn at the contact itself, or as a pin on the pitch curve, not by its replacement
    of : the thing found there, or its subject, as the gaps of its sentence; points by name
    size : the sine of the angle of a sharp crossing, the factor of magnification
    mm : the length of a vector or an arm, or the distance of a crossing
    finds : the quantity that a sharp crossing finds, of a place its velocity
    """

    diagram: DiagramName
    key: Remarkable
    of: Mapping[str, str | Symbol | Phrase]
    size: float = 0.0
    mm: float = 0.0
    finds: Symbol | None = None

    @property
    def holds(self) -> bool:
        """Whether it is to be said at this scale; a length that is zero is one at every scale."""
        match self.key:
            case "sharp crossing":
                return self.size < SHARP
            case "off the sheet":
                return self.mm > REACH
            case "short arm":
                return self.mm < SHORT
            case "magnified":
                return self.size > MAGNIFIED
        return self.mm == 0.0

    @property
    def phrase(self) -> Phrase:
        """The remark as a phrase; of a crossing with its angle, arcsin of the size (deg), of others with their size or
        length."""
        gaps: dict[str, object] = {gap: PointNames((of,)) if isinstance(of, str) else of for gap, of in self.of.items()}
        if "size" in gaps_of(self.key):
            angle = math.degrees(math.asin(self.size)) if self.key == "sharp crossing" else 0.0
            gaps["size"] = f"{angle or self.size or self.mm:.2g}"
        return Phrase(self.key, **gaps)


@dataclass(frozen=True)
class Equation:
    """A vector equation as written above its rows of sizes and directions.  ``sides`` are equal sums of terms."""

    number: int
    diagram: DiagramName
    sides: tuple[tuple[Term, ...], ...]
    element: Element


@dataclass(frozen=True)
class Rate(OnPaper):
    """An angular velocity or acceleration measured on the drawing.

    Parameters
    ----------
    value : rad/s, rad/s2; counter-clockwise positive
    vector : the relative or tangential vector from which it comes; None for a given rate, or that of another link
    mm, arm : the length of the vector on paper, and of the bar (m)
    same_as : the other link whose rate it is
    plan : whether ``mm`` was read off the rate scale of a velocity plan
    """

    link: str
    value: float
    vector: Symbol | None = None
    mm: float = 0.0
    arm: float = 0.0
    same_as: str = ""
    plan: bool = False

    @property
    def is_own(self) -> bool:
        """Whether it was read off by itself, neither given nor the rate of another link."""
        return (self.vector is not None or self.mm != 0.0) and not self.same_as


@dataclass(frozen=True)
class Reading:
    """A quantity read off a drawing.

    Parameters
    ----------
    on_paper : its length on paper (mm), None for an angle read with the protractor and for a rate that is given
    value : of a vector a complex number (m/s, m/s2, N), of others a float (rad/s, rad/s2, counter-clockwise positive;
        m, rad, N m)
    diagram : the diagram of the reading
    per_mm : the value of 1 mm there (m, m/s, m/s2, N); 0 where no length is read
    """

    symbol: Symbol
    on_paper: float | None
    value: complex | float
    diagram: DiagramName
    per_mm: float = 0.0


@dataclass(frozen=True, eq=False, repr=False)
class LimitPosition(OnPaper):
    """The mechanism drawn once more, at a limit position of an output.

    Parameters
    ----------
    value : of the crank (rad)
    poses : of links, on paper (mm)
    angle : of the output (rad), to a few degrees and with whole turns; 0 of a slide
    rest : angle (rad) by which the crank turns before it while the output rests
    """

    value: float
    poses: Mapping[str, Pose]
    angle: float = 0.0
    rest: float = 0.0


Limits = tuple[LimitPosition, LimitPosition]
"""Both limit positions of a slide or of a link over a whole turn of the crank; the second is the farthest along the
guide's sense, or counter-clockwise."""

GroupWay = Literal["special points", "superposition"]
"""How a group larger than a dyad is drawn in polygons: by special points, or by superposing motions: trial polygons, or
the motion seen from a link held still and that link's own."""


@dataclass(frozen=True, eq=False, repr=False)
class Sheet:
    """The whole drawing, in order.

    Parameters
    ----------
    scene, structure : of the mechanism; empty where a synthesis or a cam is drawn
    instrument : the name of the hands
    drivers : values by the driver's key (rad, m)
    poses, points : of links and points, on paper (mm)
    ends : the end points in each polygon (mm): ends["velocity"][PointRef("B", "3")] is b3
    rates : measured rates by kind, "omega" and "alpha", and by link
    assembly : the words for the assembly of each group by its name
    noticed : possible remarks on the construction
    causes : the sources of the acts of the hand, each with the number of acts made when it was done
    left_out : links that no asked quantity needs
    held_still : steps drawn separately, with one link as the frame
    asked, limits : the asked quantities, if the drawing is limited to them, and the limit positions drawn for them, by
        sliding pair or link
    groups : those larger than a dyad, with the construction of each
    acting : of each load whether it acts here, None where it begins or ends exactly here; if forces are drawn
    growing : then, where the mechanism rests or has several drivers, drawings with each driver's value alone growing at
        a unit rate
    trains : the velocity plans of rolling links, at scales of their own
    readings : the lengths (mm) that an erring hand has read for the construction, of vectors by their symbols
        (`either_way`), of the mechanism by the two points
    has_forces : whether forces can be drawn from it: there are masses or loads, and all that they need is drawn
    without_forces : the sentence on why none are drawn where the scene has loads
    force_scales : N for one mm of force polygons, for erring hands as on the exact drawing; empty: as polygons fit
    inertias, springs : inertia forces by link, and the forces of springs
    forces : the drawn forces, once, or twice if a load begins or ends exactly here
    """

    scene: Mechanism
    structure: Structure
    instrument: str
    scales: Scales
    points: Mapping[PointRef, complex]
    steps: tuple[Step, ...]
    drivers: Mapping[str, float] = field(default_factory=dict)
    poses: Mapping[str, Pose] = field(default_factory=dict)
    ends: Mapping[str, Mapping[PointRef, complex]] = field(default_factory=dict)
    rates: Mapping[str, Mapping[str, Rate]] = field(default_factory=dict)
    equations: tuple[Equation, ...] = ()
    assembly: Mapping[Phrase, Phrase] = field(default_factory=dict)
    noticed: tuple[Remark, ...] = ()
    causes: tuple[tuple[int, Cause], ...] = ()
    left_out: tuple[Phrase, ...] = ()
    held_still: tuple[Step, ...] = ()
    asked: tuple[Symbol, ...] = ()
    limits: Mapping[str, Limits] = field(default_factory=dict)
    groups: Mapping[LargerGroup, GroupWay] = field(default_factory=dict)
    acting: Mapping[str, bool | None] = field(default_factory=dict)
    growing: tuple[Sheet, ...] = ()
    trains: tuple[TrainPlan, ...] = ()
    readings: Mapping[Symbol | frozenset[str], float] = field(default_factory=dict)
    has_forces: bool = False
    without_forces: Phrase | None = None
    force_scales: Mapping[tuple[str, ...], float] = field(default_factory=dict)
    inertias: Mapping[str, Inertia] = field(default_factory=dict)
    springs: tuple[ForceStep, ...] = ()
    forces: tuple[ForceState, ...] = ()

    def larger(self, times: float) -> Sheet:
        """The mechanism alone enlarged by a factor, drawn by any hands; without the points of its construction."""
        return replace(
            self, scales=replace(self.scales, length=self.scales.length / times), steps=(),
            poses={name: pose.scaled(times) for name, pose in self.poses.items()},
            points={ref: z * times for ref, z in self.points.items() if ref.point not in self.serving},
        )

    def at(self, scales: Scales) -> Sheet:
        """The construction at other scales: every length on paper multiplied by a factor.  Forces are drawn anew.

        Raises
        ------
        ValueError : it was drawn by erring hands, whose errors depend on the scale
        """
        if self.instrument != EXACT_NAME:
            raise ValueError(f"a sheet drawn by {self.instrument} is drawn anew at other scales")
        if scales == self.scales:
            return self
        k: dict[str, float] = {name: self.scales.of(name) / scales.of(name) for name in DIAGRAMS}
        length, *fast = k.values()
        return replace(
            self,
            scales=scales, inertias={}, springs=(), forces=(),
            poses={name: pose.scaled(length) for name, pose in self.poses.items()},
            points={ref: z * length for ref, z in self.points.items()},
            ends={order: {ref: z * k[order] for ref, z in ends.items()} for order, ends in self.ends.items()},
            rates={kind: {name: rate.scaled(times) for name, rate in rates.items()}
                   for (kind, rates), times in zip(self.rates.items(), fast, strict=False)},
            noticed=tuple(remark.scaled(k[remark.diagram]) for remark in self.noticed),
            steps=tuple(step.scaled(k[step.diagram]) for step in self.steps),
            held_still=tuple(step.scaled(k[step.diagram]) for step in self.held_still),
            limits={pair: (low.scaled(length), high.scaled(length)) for pair, (low, high) in self.limits.items()},
        )

    @property
    def remarks(self) -> tuple[Remark, ...]:
        """The remarks on the construction at these scales: lines that meet off the sheet, zero vectors."""
        return tuple(remark for remark in self.noticed if remark.holds)

    @property
    def notes(self) -> tuple[Phrase, ...]:
        """The remarks as phrases, each once; at last the reason why there are no forces, or the scales of force
        polygons that have their own."""
        without = () if self.without_forces is None else (self.without_forces,)
        return (*dict.fromkeys(remark.phrase for remark in self.remarks), *without, *self.force_notes)

    @property
    def force_notes(self) -> tuple[Phrase, ...]:
        """The scales of force polygons that have their own, with the forces that are read there."""
        units, phrases = self.scene.units, list[Phrase]()
        for state in self.forces[:1]:
            read_at = state.per_mm.items()
            for per_mm in dict.fromkeys(per_mm for _, per_mm in read_at if per_mm != self.scales.force):
                groups = [group.links for group in state.groups if group.per_mm == per_mm]
                links = [name for names in groups for name in names if "/" not in name]
                blocks = [names for names in groups if "/" in names[0]]
                parts = [bodies_named(names) for names in (links, *blocks) if names]
                scale = Neutral(f"1 mm = {amount(per_mm / units.newtons, 12)} {units.force}")
                phrases.append(Phrase(
                    "own scale of forces", links=joined("one and other", parts), scale=scale,
                    forces=listed([symbol for symbol, per in read_at if per == per_mm]),
                ))
        return tuple(phrases)

    @cached_property
    def special_points(self) -> dict[str, str]:
        """The special points of larger groups with their links."""
        return {step.point: step.link for step in self.placing("special point")}

    @cached_property
    def serving(self) -> frozenset[str]:
        """The points of the construction only: special points of larger groups, pitch points."""
        return frozenset(step.point for step in self.placing("special point", "pitch point"))

    @cached_property
    def drawn_in(self) -> dict[Symbol, int]:
        """The step in which each vector is first drawn."""
        drawn = [(s.symbol, step.number) for step in self.steps for s in step.vectors]
        return dict(reversed(drawn))

    def arm_mm(self, between: Iterable[str]) -> float | None:
        """The distance of two points of the mechanism (mm), as read by an erring hand; None for a missing point.
        """
        names = frozenset(between)
        ends = [self.points.get(PointRef(name)) for name in names]
        if any(z is None for z in ends):
            return None
        return self.readings.get(names, abs(ends[0] - ends[-1]))  # type: ignore[operator]

    @cached_property
    def vectors(self) -> Mapping[DiagramName, Mapping[Symbol, Vector]]:
        """All vectors of each diagram by symbol."""
        drawn: dict[DiagramName, dict[Symbol, Vector]] = {"force": {}}
        drawn.update((diagram, {}) for diagram in DIAGRAMS)
        for step in self.steps:
            drawn[step.diagram].update({s.symbol: s for s in step.vectors})
        return drawn

    def of(self, diagram: DiagramName) -> tuple[Step, ...]:
        """The steps of a diagram."""
        return tuple(step for step in self.steps if step.diagram == diagram)

    def placing(self, *reasons: Reason) -> Iterator[Step]:
        """The steps that place the mechanism for some reasons."""
        return (step for step in self.steps if step.reason in reasons)

    def before(self, step: Step) -> tuple[Step, ...]:
        """The steps before one of them."""
        return self.steps[: step.number - 1]

    def trials(self, diagram: DiagramName) -> list[Vector]:
        """The vectors of trial polygons in a diagram."""
        return [aid for step in self.of(diagram) for aid in step.auxiliary if aid.trial]

    def vectors_seen(self, diagram: DiagramName) -> Iterator[Vector]:
        """The vectors of a diagram that are seen from held links, without those that lead to special points."""
        held = {step.held for step in self.steps if step.reason == "seen from"}
        special = self.special_points.keys()
        for step in self.of(diagram) if held else ():
            for aid in step.auxiliary:
                of, to = aid.symbol.of, aid.symbol.to
                if to is None or special & {to.point, of.point if of else ""}:
                    continue
                if {aid.symbol.seen, to.link} & held:
                    yield aid

    def carried(self, diagram: DiagramName) -> Iterator[complex]:
        """The ends (mm) of vectors that are laid off before their turn in the chain, except those of special points."""
        for step in self.of(diagram):
            if step.reason == "before its turn":
                points = {ref.point for ref in (step.symbol.of, step.symbol.to) if ref is not None}
                if not points & self.special_points.keys():
                    yield from (z for bar in step.each(Bar) for z in (bar.a, bar.b))

    @cached_property
    def extents(self) -> dict[Diagram, Rectangle]:
        """Width and height of the mechanism and of both polygons, poles included, by which scales are chosen: without
        special points, with vectors seen from held links, with trial polygons and carried vectors slightly smaller."""
        places = [z for ref, z in self.points.items() if ref.point not in self.serving]
        if self.scene.higher_pairs or any(link.discs for link in (self.scene.frame, *self.scene.links)):
            from graphkin.construction.touching import Touching

            per = 1.0 / self.scales.length
            places += Touching(self.scene, per, self.poses).outermost()
        ends: dict[DiagramName, tuple[list[complex], list[complex]]] = {}
        for order in ORDERS:
            drawn = [*self.vectors[order].values(), *self.vectors_seen(order)]
            true, trial = ([z for v in some for z in (v.tail, v.tip)] for some in (drawn, self.trials(order)))
            ends[order] = [0j, *true], [0j, *true, *trial, *self.carried(order)]
        extents: dict[Diagram, Rectangle] = {"mechanism": extent_of(places, self.scales.length)}
        for order in ORDERS:
            least, most = (extent_of(spots, self.scales.of(order)) for spots in ends[order])
            extents[order] = max(least[0], most[0] / INTO_MARGIN), max(least[1], most[1] / INTO_MARGIN)
        return extents

    @property
    def drawn_sizes(self) -> tuple[tuple[float, float], ...]:
        """Width and height (mm) of the mechanism and of both polygons as they are drawn."""
        pairs = ((self.extents[name], self.scales.of(name)) for name in DIAGRAMS)
        return tuple((width / per, height / per) for (width, height), per in pairs)

    def scales_for(self, room: Room | None) -> Scales:
        """The finest scales of the series at which it fits a room; without one the scene's own if it gives them."""
        return chosen_scales(self.scene, self.extents, room)


def either_way(symbol: Symbol) -> Symbol:
    """A vector by its name or that of its opposite, whichever is first: both have the same length.

    >>> str(either_way(Symbol.parse("v_C/B"))), str(either_way(Symbol.parse("v_B/C")))
    ('v_B/C', 'v_B/C')
    """
    if symbol.kind != "v" or symbol.of is None or symbol.to is None:
        return symbol
    return replace(symbol, of=symbol.to, to=symbol.of) if str(symbol.to) < str(symbol.of) else symbol


# vectors that are nothing but rounding
#
# Exact hands lose some 1e-16 of the largest vector, and more where lines cross at a small angle.  A normal component is
# v squared over a length, and so is as certain as the velocity that it comes from, however short.


def without_residues(sheet: Sheet) -> Sheet:
    """A sheet of exact hands, with every vector that is rounding alone made zero, and the rates measured from it."""
    zero = _residues(sheet)
    if not zero:
        return sheet
    rates = {kind: dict(of_links) for kind, of_links in sheet.rates.items()}
    for (kind, of_links), scale in zip(sheet.rates.items(), map(sheet.scales.of, ORDERS), strict=True):
        for name, rate in of_links.items():
            if rate.vector in zero:  # a driver's own rate on top of one that came from a residue stays
                residue = rate.mm * scale / rate.arm if rate.arm else 0.0
                value = 0.0 if abs(rate.value) <= 2.0 * residue else rate.value
                rates[kind][name] = replace(rate, value=value, mm=0.0)

    def cleared(step: Step) -> Step:
        step = changed(step, strokes=tuple(
            replace(s, tip=s.tail) if isinstance(s, Vector) and s.symbol in zero else s for s in step.strokes
        ))
        if step.reason == "sum of rates":
            return changed(step, value=rates[step.kind][step.links[0]].value)
        if step.symbol not in zero:
            return step
        return changed(step, value=0.0) if step.reason == "rate" else changed(step, mm=0.0)

    noticed = (replace(r, mm=0.0) if r.of.get("symbol") in zero else r for r in sheet.noticed)
    return replace(sheet, steps=tuple(map(cleared, sheet.steps)), noticed=tuple(noticed), rates=rates)


def _residues(sheet: Sheet) -> set[Symbol]:
    """The vectors that are rounding alone."""
    scales, size, structure = sheet.scales, sheet.scene.size, sheet.structure
    drawn = [[*sheet.vectors_seen(order), *sheet.vectors[order].values()] for order in ORDERS]
    velocity, acceleration = ({vector.symbol: abs(vector.span) for vector in vectors} for vectors in drawn)
    crossings = [(r.diagram, r.finds, 1.0 / max(r.size, 1e-9)) for r in sheet.noticed if r.finds is not None]
    leans = [[(symbol, lean) for diagram, symbol, lean in crossings if diagram in DIAGRAMS[:last]] for last in (2, 3)]
    # the largest vector that leads to one (mm), and how sharp the crossings are
    fastest, pushed, sharp_before, sharp = (
        greatest_before(structure, sizes, [*velocity, *acceleration])
        for sizes in (velocity.items(), acceleration.items(), *leans)
    )

    def lost(sharpest: float) -> float:
        """The rounding error of a vector over the largest vector that leads to it."""
        return min(MOST_LOST, LOST * max(sharpest, 1.0) ** 2)

    def residue(symbol: Symbol) -> float:
        # a motion without acceleration still has velocities, whose rounding is carried on as v squared over a length
        most, speed = pushed[symbol], fastest[symbol] * scales.velocity
        carried = max(most, speed**2 / size / scales.acceleration) * lost(sharp[symbol])
        # beside a dead point v squared over a length far exceeds all accelerations
        return min(carried, MOST_LOST * most) if most > carried else carried

    zero = {s for s, mm in velocity.items() if 0.0 < mm <= lost(sharp_before[s]) * fastest[s]}
    still = zero | {symbol for symbol, mm in velocity.items() if mm == 0.0}
    fixed, touching = sheet.scene.frame.points, {*sheet.scene.contact_at}
    for symbol, mm in acceleration.items():
        squared: list[Symbol] = []
        # the velocity whose square a normal component is: relative, or from the pole where its start is fixed; at a
        # contact the curvatures give a normal part where nothing slides too
        if symbol.kind == "an" and symbol.to and symbol.of and symbol.of.point not in touching:
            squared = [Symbol("v", symbol.of, symbol.to)]
            squared += [Symbol("v", symbol.of)] if symbol.to.point in fixed else []
        speed = next((s for s in squared if s in velocity), None)
        nothing = mm <= residue(symbol) if speed is None else speed in still
        if nothing and mm != 0.0:
            zero.add(symbol)
    return zero


# the board on which it grows


@dataclass
class Board:
    """The hands that draw and read, and what is in a `Sheet` as it grows under them."""

    instrument: Instrument
    steps: list[Step] = field(default_factory=list)
    equations: list[Equation] = field(default_factory=list)
    noticed: list[Remark] = field(default_factory=list)
    causes: list[tuple[int, Cause]] = field(default_factory=list)
    readings: dict[Symbol | frozenset[str], float] = field(default_factory=dict)
    assembly: dict[Phrase, Phrase] = field(default_factory=dict)
    held_still: list[Step] = field(default_factory=list)

    def again(self, hand: Instrument) -> Board:
        """The board for continuing by other hands."""
        kept = {name: copy(value) for name, value in vars(self).items() if name != "instrument"}
        return Board(hand, **kept)

    def do(self, step: Step, **changes: object) -> None:
        """Record a step with some arguments changed, and its number in the order."""
        recorded = object.__new__(type(step))  # as `changed` does: `replace` would take ten times as long
        vars(recorded).update(vars(step), **changes, number=len(self.steps) + 1)
        self.steps.append(recorded)
        self.causes.append((self.instrument.acts, recorded))

    def read(self, between: Symbol | frozenset[str], mm: float) -> float:
        """The length of a vector, or the distance of two points of the mechanism (mm), read when it is first needed."""
        if self.instrument.errs is None:
            return self.instrument.read(mm)  # it shows the same each time
        span = either_way(between) if isinstance(between, Symbol) else between
        if span not in self.readings:
            self.readings[span] = self.instrument.read(mm)
        return self.readings[span]

    def pricked(self, diagram: DiagramName, mark: Mark) -> bool:
        """Whether an end point is drawn already: two lines have met in it, or the last vector ends in it and gets its
        letter."""
        if any(mark in step.strokes for step in self.steps if step.diagram == diagram):
            return True
        last = self.steps[-1]
        ends = (s.tip for s in last.strokes if last.diagram == diagram and isinstance(s, Vector))
        if mark.at not in ends:
            return False
        self.steps[-1] = replace(last, strokes=(*last.strokes, mark))
        return True

    def notice(
        self, diagram: DiagramName, key: Remarkable, size: float = 0.0, mm: float = 0.0, finds: Symbol | None = None,
        **of: str | Symbol | Phrase,
    ) -> None:
        """Note a possible remark, for this scale or another."""
        self.noticed.append(Remark(diagram, key, of, size, mm, finds))

    def cross(
        self, diagram: DiagramName, p: complex, d: complex, q: complex, e: complex, target: str | Symbol
    ) -> complex:
        """The crossing of the line through p along d and the line through q along e, drawn as ruler lines.

        Raises
        ------
        Unsolvable : "dead point": the lines are parallel and meet nowhere
        """
        d, e = self.instrument.direction(d), self.instrument.direction(e)
        at = self.instrument.crossing(target, p, d, q, e)
        finds = target if isinstance(target, Symbol) else Symbol("v", PointRef(target))
        self.notice(diagram, "sharp crossing", result=target, size=abs(cross(d, e)), finds=finds)
        self.notice(diagram, "off the sheet", result=target, mm=max(abs(at - p), abs(at - q)))
        return at
