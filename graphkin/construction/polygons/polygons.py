"""Velocity and acceleration polygons under construction: end points, measured rates, names, and points found by image.

The position is drawn already.  Every size is either given, or measured on earlier strokes: normal
components from lengths in the velocity polygon, Coriolis components from a measured angular velocity and a measured
sliding velocity (Sun Huan, Mechanical Principles, ch. 3; Norton, Design of Machinery, ch. 6 and 7).

Images after Mehmke: the end points of a link's points form a figure similar to the link, in the same sense.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from graphkin.construction.board.instruments import Instrument
from graphkin.construction.board.scales import Scales
from graphkin.construction.board.sheet import Board, Rate
from graphkin.construction.board.steps import (
    ORDERS,
    PARTS,
    Bar,
    Direction,
    Image,
    Mark,
    Order,
    Ray,
    Size,
    Step,
    Stroke,
    Term,
    Vector,
    changed,
)
from graphkin.construction.polygons.vector_graph import VectorChain, node
from graphkin.construction.position.links_on_paper import PlacedLinks, pushed_by_driver
from graphkin.errors import CallError, Problem, Unsolvable
from graphkin.plane import added_up, cross, dot, unit
from graphkin.scene.model import PlacedLink
from graphkin.scene.pairs import Pair
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Dyad, LargerGroup, Structure
from graphkin.words import Phrase, listed

if TYPE_CHECKING:
    from graphkin.construction.polygons.group_plan import GroupPlan
    from graphkin.construction.touching import Touch
    from graphkin.construction.trains import TrainPlan

RATE: Mapping[Order, Literal["omega", "alpha"]] = {"velocity": "omega", "acceleration": "alpha"}
SHARED = {"chains", "plans", "contours"}  # by all drawings of a task


@dataclass(frozen=True)
class OwnValues:
    """Four places at which a person may take another value than the drawn one: a component left out, a value of their
    own.

    A drawing with own values shows their consequences; the construction itself does not change.

    Parameters
    ----------
    term : from each term of an equation before it is laid off
    found : from each vector found (end points by image included) by tail and tip (mm) to its tip
    rate : from each angular rate measured (rad/s, rad/s2); None where it stays
    line : from the direction of each line along which a vector of unknown size is drawn
    """

    term: Callable[[Term], Term] = lambda part: part
    found: Callable[[Symbol, complex, complex], complex] = lambda _, tail, tip: tip
    rate: Callable[[Symbol, float], float | None] = lambda _, value: None
    line: Callable[[Symbol, complex], complex] = lambda _, along: along


AS_DRAWN = OwnValues()


class DrawnMotion(NamedTuple):
    """The motion of the links seen from one of them, as far as it is drawn: end points (mm), measured rates, vectors.

    A point that no link has is special, of this link and another: its end is the difference of their motions there.
    """

    ends: dict[Order, dict[PointRef, complex]]
    rates: dict[Order, dict[str, Rate]]
    drawn: dict[Order, dict[Symbol, Vector]]

    @classmethod
    def begun(cls, links: Mapping[str, PlacedLink], ground: str) -> DrawnMotion:
        """The motion seen from a link, whose points are in the poles, before it is drawn."""
        fixed = dict.fromkeys(map(PointRef, links[ground].points), 0j)
        return cls({order: dict(fixed) for order in ORDERS}, {order: {ground: Rate(ground, 0.0)} for order in ORDERS},
                   {order: {} for order in ORDERS})


@dataclass(frozen=True, eq=False)
class Polygons:
    """The velocity and the acceleration polygon of a position, as far as they are drawn: the collections grow with each
    vector, as the steps on the board do; `again` gives others to go on with, which leave these as they stand.

    Parameters
    ----------
    links, places : the links with the special points that larger groups get, and the places of all points (mm)
    tiny : a distance of points that is none (mm)
    ends, rates, drawn : end points (mm), measured rates, and vectors
    own_values : a person's own values in place of drawn ones
    given : the rates of each order by the driver's key (SI), of rolling links once they are read; in a trial those of
        sliding pairs that are assumed
    at_contacts : whether sliding contacts are drawn themselves, instead of their replacements
    chains, plans : the construction of each group, found once for all drawings of a task
    contours : for each group its links held still, each with the rest on it
    special, pitch_points : the special points, and the letters where wheels of larger groups roll on each other
    believed : links whose rates are own values, not measured
    trains : velocity plans of rolling links
    trial : the number of the trial polygon that this is; 0 for none
    held, part_of : the link that is held still, "" for the frame, and the group whose it is
    seen : motion seen from links of larger groups
    """

    board: Board
    structure: Structure
    paper: PlacedLinks
    scales: Scales
    links: dict[str, PlacedLink]
    places: dict[str, complex]
    tiny: float
    ends: dict[Order, dict[PointRef, complex]]
    rates: dict[Order, dict[str, Rate]]
    drawn: dict[Order, dict[Symbol, Vector]]
    own_values: OwnValues = AS_DRAWN
    given: dict[tuple[Order, str], float] = field(default_factory=dict)
    at_contacts: bool = False
    chains: dict[Dyad, VectorChain] = field(default_factory=dict)
    plans: dict[LargerGroup, GroupPlan] = field(default_factory=dict)
    contours: dict[LargerGroup, tuple[tuple[str, LargerGroup], ...]] = field(default_factory=dict)
    special: set[str] = field(default_factory=set)
    pitch_points: dict[str, str] = field(default_factory=dict)
    believed: set[tuple[Order, str]] = field(default_factory=set)
    trains: list[TrainPlan] = field(default_factory=list)
    trial: int = 0
    held: str = ""
    part_of: LargerGroup | None = None
    seen: dict[str, DrawnMotion] = field(default_factory=dict)

    @classmethod
    def begun(
        cls, board: Board, structure: Structure, paper: PlacedLinks, scales: Scales, own_values: OwnValues = AS_DRAWN
    ) -> Polygons:
        """Empty polygons of placed links."""
        links = dict(structure.links)
        places = {point: paper.point(name, point) for name in paper.poses for point in links[name].points}
        size = max((abs(z - w) for z in places.values() for w in places.values()), default=1.0)
        given = {(order, d.key): d.values[i] for d in structure.drivers for i, order in enumerate(ORDERS, 1)}
        begun = DrawnMotion.begun(links, structure.scene.frame.name)
        return cls(board, structure, paper, scales, links, places, 1e-11 * size, *begun, own_values, given)

    @cached_property
    def ground(self) -> str:
        """The link whose points are in the poles."""
        return self.held or self.structure.scene.frame.name

    @cached_property
    def still(self) -> set[str]:
        """The links that can only translate."""
        return self.structure.turning_with(self.ground)

    @cached_property
    def per(self) -> Mapping[Order, float]:
        """The scales: m/s, m/s2 for one mm."""
        return {order: self.scales.of(order) for order in ORDERS}

    def again(self, hand: Instrument) -> Polygons:
        """The same polygons as they stand here, to go on with by other hands."""
        copies = {part.name: _copied(getattr(self, part.name)) for part in fields(self) if part.name not in SHARED}
        return replace(self, **{**copies, "board": self.board.again(hand)})

    def seen_from(self, held: str, group: LargerGroup | None = None) -> Polygons:
        """These polygons with a link of a group held still, as if it were the frame, on a board of their own."""
        motion = self.seen.setdefault(held, DrawnMotion.begun(self.links, held))
        board = Board(self.board.instrument, equations=self.board.equations, readings=self.board.readings)
        own_values = OwnValues(line=self.own_values.line)
        return replace(self, **motion._asdict(), board=board, own_values=own_values, believed=set(), trial=0, held=held,
                       part_of=group, seen={})

    def do(self, step: Step, *first: Stroke) -> None:
        """Record a step, with further strokes before its own.  Seen from a held link only vectors are shown: end points
        get their letters in the polygon of the mechanism itself."""
        drawn = (*first, *step.strokes)
        if not self.held or step.diagram == "mechanism":
            self.board.do(step, strokes=drawn)
        elif step.symbol.kind:
            early = step.reason == "before its turn"
            strokes = (s for s in drawn if early or isinstance(s, Ray) or (isinstance(s, Vector) and s.aid))
            self.board.do(step, strokes=tuple(strokes))

    def symbol(self, kind: str, end: PointRef, start: PointRef | None = None) -> Symbol:
        """The motion of a point, or a part of it, from the pole or from that of another point, by its letters.  Seen
        from a held link a point's own is that relative to the coincident point of it; others bear its name, and all
        accelerations do."""
        if self.held and start is None:
            seen = "" if kind == "v" else self.held  # the difference of accelerations holds the term of Coriolis, too
            return Symbol(kind, self.label(end), PointRef(end.point, self.held), seen=seen)
        return Symbol(kind, self.label(end), start and self.label(start), seen=self.held)

    def label(self, ref: PointRef) -> PointRef:
        """The name of a node: the block of a pin in a slot has the name of the pin's link."""
        block = self.structure.blocks.get(ref.link)
        return ref if block is None else PointRef(ref.point, block.of)

    def guide_names(self, slide: Pair) -> tuple[str, ...]:
        """The name of a guide in a direction: two letters on it, else its name."""
        start = self.paper.place(slide.b, slide.guide.through)
        along = slide.along(self.paper.poses)
        on = [
            (dot(z - start, along), p)
            for p, z in self.places.items()
            if p in self.links[slide.b].points and abs(cross(z - start, along)) < 1e3 * self.tiny
        ]
        pin = slide.pin
        if pin and pin in self.places:
            others = [(s, p) for s, p in sorted(on) if p != pin and abs(self.places[p] - self.places[pin]) > self.tiny]
            if others:
                return others[0][1], pin
        if len(on) > 1:
            return min(on)[1], max(on)[1]
        return (slide.guide_name,)

    def fixed(self, ref: PointRef) -> bool:
        """Whether a node is a point of the frame."""
        return self.on(ref, self.ground)

    def touch(self, name: str) -> Touch:
        """The place of a contact, or of the mesh of wheels."""
        from graphkin.construction.touching import Touching

        return Touching(self.structure.scene, self.paper.mm, self.paper.poses).named(name)

    def length(self, arm: complex, between: Sequence[str]) -> float:
        """The length (m) between two points of the mechanism that lie ``arm`` apart on paper: given if a link has both
        or a driver pushes one from the other, else read off the drawing.

        Raises
        ------
        Unsolvable : "not drawn": the two are so near to each other that the instrument cannot read their distance
        """
        start, end = between
        for link in self.links.values() if self.special.isdisjoint(between) else ():  # special points are drawn
            if start in link.points and end in link.points and link.points[start] != link.points[end]:
                return abs(link.points[end] - link.points[start])
        pushed = pushed_by_driver(self.structure, self.paper.values, between)
        if pushed is not None:
            return pushed[1]
        read = self.board.read(frozenset(between), abs(arm))
        if read == 0.0:
            raise Unsolvable("not drawn", Problem("".join(between), "mm on paper are too short to be",
                                                  "draw the mechanism larger", length=f'{abs(arm):.2g}'))
        return read * self.scales.length

    def found_mm(self, symbol: Symbol, span: complex) -> float:
        """The measured length of a found vector (mm); None where the next trial has a vector of its name."""
        return abs(self.board.read(symbol, abs(span))) if span and not self.trial else abs(span)

    def slip_mm(self, symbol: Symbol, slip: complex) -> float:
        """The length (mm) of a relative velocity, read off its polygon when it is first needed."""
        if symbol.of is not None and symbol.to is not None and self.fixed(symbol.of):
            symbol = self.symbol(symbol.kind, symbol.to)
        return self.board.read(symbol, abs(slip))

    def end(self, order: Order, ref: PointRef) -> complex:
        """The end point of a node, found by image if it is not drawn yet; the pole for a fixed point."""
        if self.fixed(ref):
            return 0j
        if ref not in self.ends[order]:
            self.place(order, ref)
        return self.ends[order][ref]

    def record(self, vector: Vector, step: Step) -> None:
        """Put a vector into a polygon, with the step that drew it and its further strokes; one of a trial polygon, seen
        from a held link or to a special point is drawn as a construction vector."""
        if step.diagram in ORDERS:
            self.drawn[step.diagram][vector.symbol] = vector
        of_special = any(ref is not None and ref.point in self.special for ref in (vector.symbol.of, vector.symbol.to))
        if self.trial or self.held or of_special:
            vector = changed(vector, aid=True, trial=self.trial)
        self.do(step, vector)

    def reach(self, order: Order, ref: PointRef, at: complex, equation: int | None) -> None:
        """Name an end point, and draw the vector to it from the pole."""
        if ref in self.ends[order]:
            return
        self.ends[order][ref] = at
        mark = Mark(self.label(ref), at)
        symbol = self.symbol(letter(order), ref)
        if symbol in self.drawn[order]:
            if not self.held and not self.board.pricked(order, mark):
                self.do(Step("mark", "letter", order, (mark,), equation, ref=mark.ref))
            return
        step = Step("join", "pole to end", order, (mark,), equation, symbol=symbol)
        self.record(Vector(symbol, 0j, at, "resultant"), step)

    def complete(self, order: Order, name: str) -> None:
        """All points of a link, and the points of it under sliding pins and at contacts."""
        for point in self.links[name].points:
            if point not in self.structure.scene.contact_at:
                self.place(order, PointRef(point))
        for point, pair in self.structure.scene.contact_at.items():
            if name in pair.bodies and point in self.places and name != self.ground:
                self.place(order, PointRef(point, name))
        for s in self.structure.slides:
            if s.pin and s.pin in self.places and s.b == name and "/" not in name:
                self.place(order, node(self.links, s.pin, name))

    def place(self, order: Order, ref: PointRef) -> None:
        """Find the end point of any point of a link whose motion is known, by image."""
        ends = self.ends[order]
        if ref in ends or self.fixed(ref):
            return
        name = next(n for n in self.holders(ref) if n in self.rates[order] and any(self.on(r, n) for r in ends))
        here = self.places[ref.point]
        refs = [r for r in ends if self.on(r, name)]
        if name in self.still:
            self._reach_by(ref, ends[refs[0]], Step("image", "translation", order, link=name))
            return
        same = [r for r in refs if abs(self.places[r.point] - here) <= self.tiny]
        if same:
            step = Step("image", "same place", order, refs=(self.label(same[0]),))
            self._reach_by(ref, ends[same[0]], step)
            return
        # a special point may lie far away: it serves where the link has no other two
        for some in ([r for r in refs if r.point not in self.special], refs):
            spans = {(a, b): self.places[b.point] - self.places[a.point] for a in some for b in some}
            a, b = max(spans, key=lambda pair: abs(spans[pair]), default=(refs[0], refs[0]))
            bar = spans.get((a, b), 0j)
            if abs(bar) > self.tiny:
                break
        if abs(bar) <= self.tiny or (order, name) in self.believed:
            start = refs[0]  # a fixed point, if the link has one
            parts = self._by_rates(order, start, ref, name)
            at = added_up((part.span for part in parts if part.span is not None), ends[start])
            self._reach_by(ref, at, Step("image", "rates", order, refs=(self.label(start),), link=name, by_rates=parts))
            return
        points = self.links[name].points
        if {a.point, b.point, ref.point} <= points.keys():  # the shape of the link is given
            ratio = (points[ref.point] - points[a.point]) / (points[b.point] - points[a.point])
        else:
            ratio = (here - self.places[a.point]) / bar
        at = self.board.instrument.point(ends[a] + (ends[b] - ends[a]) * ratio)
        on_line = abs(ratio.imag) < 1e-9
        lined = on_line or bool({a.point, b.point} & self.special)
        stroke = Bar(ends[a], at, name) if lined else Image(name, (ends[a], ends[b], at))
        reason: Literal["division", "similar"] = "division" if on_line else "similar"
        step = Step("image", reason, order, (stroke,), refs=(self.label(a), self.label(b)), link=name)
        self._reach_by(ref, at, step)

    def _reach_by(self, ref: PointRef, at: complex, image: Step) -> None:
        """Draw an end point that follows from others of its link."""
        order: Order = "velocity" if image.diagram == "velocity" else "acceleration"
        symbol, label = self.symbol(letter(order), ref), self.label(ref)
        at = self.own_values.found(symbol, 0j, at)
        self.ends[order][ref] = at
        if not self.held:
            step = replace(image, ref=label, strokes=(Mark(label, at), *image.strokes))
        elif image.reason in ("same place", "translation"):
            step = Step("join", "pole to end", order, symbol=symbol)
        else:
            begins = tuple(None if self.fixed(start) else self.symbol(letter(order), start) for start in image.refs)
            corners = tuple(corner.point for corner in (*image.refs, label))
            step = changed(image, ref=label, symbol=symbol, begins=begins, points=corners, held=self.held)
        self.record(Vector(symbol, 0j, at, "resultant"), step)

    def on(self, ref: PointRef, name: str) -> bool:
        """Whether a node is a point of a link."""
        return ref.link == name or (not ref.link and ref.point in self.links[name].points)

    def holders(self, ref: PointRef) -> list[str]:
        """The links that have a point, or the link of the point."""
        return [ref.link] if ref.link else [name for name, link in self.links.items() if ref.point in link.points]

    def _by_rates(self, order: Order, start: PointRef, end: PointRef, name: str) -> tuple[Term, ...]:
        """Draw from one end point to another of the same link by its measured rates, part by part."""
        names = end.point, start.point
        drawn = self.places[end.point] - self.places[start.point]
        arm = drawn / abs(drawn) * self.length(drawn, names[::-1]) / self.scales.of(order) if drawn else 0j
        links = (name, self.held) if self.held else (name,)
        omega, alpha = (self.rates[each][name].value if name in self.rates[each] else 0.0 for each in ORDERS)
        inward, square = Direction("towards", names), Direction("square", names)
        parts = [
            ("an", Size("rate", links, names, square=True), inward, -omega * omega * arm),
            ("at", Size("rate", links, names, "alpha"), square, 1j * alpha * arm),
        ] if order == "acceleration" else [("v", Size("rate", links, names), square, 1j * omega * arm)]
        between = self.label(end), self.label(start)
        return tuple(
            Term(Symbol(kind, *between, seen=self.held), True, True, size, direction, span=span)
            for kind, size, direction, span in parts if span
        )


def _copied(kept: Any) -> Any:
    """A copy of a collection with the collections in it; another value as it is."""
    if isinstance(kept, dict):
        return {key: _copied(value) for key, value in kept.items()}
    if isinstance(kept, DrawnMotion):
        return DrawnMotion(*map(_copied, kept))
    return type(kept)(kept) if isinstance(kept, set | list) else kept


def letter(order: Order) -> str:
    """v or a."""
    return "v" if order == "velocity" else "a"


# vectors that are asked for and stand in no equation


def draw_asked(plot: Polygons, asked: Sequence[Symbol]) -> None:
    """Draw the asked vectors that are in no equation."""
    for symbol in asked:
        order: Order = "velocity" if symbol.kind == "v" else "acceleration"
        if symbol.scope != "motion" or not symbol.is_vector or symbol.of is None or symbol in plot.drawn[order]:
            continue
        of, to = (node(plot.links, ref.point, ref.link) if ref and ref.link else ref for ref in (symbol.of, symbol.to))
        assert of is not None
        rated = plot.rates["velocity"].keys()
        if not all(ref.point in plot.places and rated & plot.holders(ref) for ref in (of, to) if ref):
            continue
        tail, tip = plot.end(order, to) if to else 0j, plot.end(order, of)
        role = PARTS.get(symbol.kind) or ("relative" if to else "resultant")
        if symbol.kind in ("an", "at"):
            tail = plot.end(order, to := to or _pivot(plot, of, symbol))
            along = _joining(plot, symbol, of, to)
            corner = tail + along * dot(tip - tail, along)
        elif to is not None and role in ("coriolis", "sliding"):
            slip = plot.end("velocity", of) - plot.end("velocity", to)
            omega = plot.rates["velocity"][_guide_of(plot, of, to, symbol)].value
            corner = tail + 2j * omega * slip * (plot.scales.velocity / plot.scales.acceleration)
        if role in ("normal", "coriolis"):
            tip = corner
        elif role in ("tangential", "sliding"):
            tail = corner
        vector = plot.drawn[order][symbol] = Vector(symbol, tail, tip, role)
        plot.do(Step("join", "asked", order, (vector,), symbol=symbol))


def _joining(plot: Polygons, symbol: Symbol, of: PointRef, to: PointRef) -> complex:
    """The direction of the bar between two points, or of the normal at a rolling contact."""
    arm = plot.places[of.point] - plot.places[to.point]
    contact = plot.structure.scene.contact_at.get(of.point)
    if contact is not None and contact.rolling and of.point == to.point:
        return plot.touch(of.point).normal
    if abs(arm) > plot.tiny:
        return unit(arm)
    said = Phrase("the two points coincide no line joins them"), Phrase("ask for ak and ar of coincident points")
    raise CallError(Problem(str(symbol), *said))


def _pivot(plot: Polygons, of: PointRef, symbol: Symbol) -> PointRef:
    """The point of the frame on the same link."""
    ground = plot.links[plot.ground].points
    points = (point for name in plot.holders(of) for point in plot.links[name].points)
    pivot = next((point for point in points if point in ground and point != of.point), None)
    if pivot is None:
        wanted = Phrase("turns about no fixed point write a with", name=of, symbol=symbol)
        raise CallError.of(str(symbol), "no link makes this part", wanted)
    return PointRef(pivot)


def _guide_of(plot: Polygons, of: PointRef, to: PointRef, symbol: Symbol) -> str:
    """The guide of the sliding pair between two coincident points; for links of a group the link from which it is
    seen."""
    for s in plot.structure.slides:
        if {node(plot.links, of.point, s.a), node(plot.links, of.point, s.b)} == {of, to}:
            return s.b
    seen = {ref.link for ref in (symbol.of, symbol.to) if ref}
    if symbol.to and any(seen <= {*group.members} for group in plot.structure.larger_groups):
        return symbol.to.link  # links of a group that are drawn as one, seen from one of them
    known = [s.key for s in plot.structure.slides]
    wanted = Phrase("known are", names=listed(known)) if known else Phrase("this mechanism has none")
    raise CallError.of(str(symbol), "these two points do not lie on the", wanted)
