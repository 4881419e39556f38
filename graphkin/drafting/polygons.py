"""Velocity and acceleration polygons: equations drawn, rates measured, the rest by images.

The position stands on paper already.  Every size is either given, or measured on what was drawn before: normal
components from lengths in the velocity polygon, Coriolis components from a measured angular velocity and a measured
sliding velocity (Sun Huan, Mechanical Principles, ch. 3; Norton, Design of Machinery, ch. 6 and 7).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from graphkin.drafting.board import Board
from graphkin.drafting.chains import Chain, Edge, equation_of, node
from graphkin.drafting.dyads import Frame
from graphkin.drafting.sheet import (
    Bar,
    Direction,
    Equation,
    Image,
    Mark,
    Rate,
    Ray,
    Scales,
    Stroke,
    Term,
    Vector,
)
from graphkin.errors import CallError, Problem
from graphkin.plane import cross, dot, unit
from graphkin.scene.model import AngleDriver, SlideDriver
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Driven, Dyad, Element, Slide, Structure, Turn, Weld
from graphkin.words import Phrase

__all__ = ["ZERO_MM", "Polygons"]

ZERO_MM = 1e-7  # a vector shorter than this is no vector on paper
Order = Literal["velocity", "acceleration"]


@dataclass(frozen=True)
class _Part:
    """One term of a relative motion: its vector on paper if known, else only its direction."""

    symbol: Symbol
    role: Literal["resultant", "relative", "normal", "tangential", "coriolis", "sliding"]
    along: complex
    span: complex | None
    written: Direction
    size: str = ""


_Side = list[tuple[Edge, list[_Part]]]


class Polygons:
    """Both polygons of one position, drawn element by element in the order of solution."""

    def __init__(self, board: Board, structure: Structure, frame: Frame, scales: Scales) -> None:
        self.board, self.structure, self.frame, self.scales = board, structure, frame, scales
        self.links = structure.links
        self.ground = structure.scene.frame.name
        fixed = {PointRef(p): 0j for p in self.links[self.ground].points}
        self.ends: dict[Order, dict[PointRef, complex]] = {"velocity": dict(fixed), "acceleration": dict(fixed)}
        self.rates: dict[Order, dict[str, Rate]] = {
            "velocity": {self.ground: Rate(self.ground, 0.0)},
            "acceleration": {self.ground: Rate(self.ground, 0.0)},
        }
        self.drivers = {d.key: d.values for d in structure.scene.drivers}
        self.still = self._never_turning()
        self.drawn: dict[Order, dict[Symbol, Vector]] = {"velocity": {}, "acceleration": {}}
        self.chains: dict[Element, Chain] = {}
        self.places = {point: frame.point(name, point) for name in frame.poses for point in self.links[name].points}
        size = max((abs(z - w) for z in self.places.values() for w in self.places.values()), default=1.0)
        self.tiny = 1e-9 * size
        self.block_of = {p.key: p.of for p in structure.scene.pins}

    # -- names -------------------------------------------------------------------------------------------------------

    def label(self, ref: PointRef) -> PointRef:
        """A node as it is written: the block of a pin in a slot bears the name of the pin's link."""
        return PointRef(ref.point, self.block_of[ref.link]) if ref.link in self.block_of else ref

    def guide_names(self, slide: Slide) -> tuple[str, ...]:
        """How the direction of a guide is written: by two letters on it, else by its name."""
        start = self.frame.place(slide.b, slide.guide.through)
        along = self.frame.poses[slide.b].axis * slide.guide.direction
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
        return (slide.guide.name or f"x{slide.b}",)

    def _never_turning(self) -> set[str]:
        """Links that slide on the frame, or on such links, and so can only translate."""
        still = {self.ground}
        grown = True
        while grown:
            grown = False
            for s in self.structure.slides:
                if len({s.a, s.b} & still) == 1:
                    still |= {s.a, s.b}
                    grown = True
        return still

    # -- drawing, element by element -----------------------------------------------------------------------------------

    def draw(self, order: Order, element: Driven | Dyad) -> None:
        """Draw what an element adds to a polygon."""
        if isinstance(element, Driven):
            self._driven(order, element)
        else:
            self._dyad(order, element)
        for name in _links_of(element):
            self._complete(order, name)

    def _driven(self, order: Order, element: Driven) -> None:
        name, driver, pair = element.link, element.driver, element.pair
        which = 1 if order == "velocity" else 2
        rate = driver.values[which]
        if isinstance(driver, AngleDriver):
            other, sign = (driver.relative_to, 1) if driver.link == name else (driver.link, -1)
            base = self.rates[order][other].value
            self.rates[order][name] = Rate(name, base + sign * rate)
            assert isinstance(pair, Turn)
            pivot = PointRef(pair.point)
            far = [
                PointRef(p)
                for p in self.links[name].points
                if abs(self.places[p] - self.places[pair.point]) > self.tiny
            ]
            if far:
                edge = Edge(pivot, far[0], (pivot, far[0]), Direction("square", (pivot.point, far[0].point)), link=name)
                self._lay_off(order, (edge,), element)
            return
        assert isinstance(pair, Slide)
        known = pair.b if name == pair.a else pair.a
        self._share_rate(order, known, name)
        letter = pair.pin or next(iter(self.links[name].points), "")
        if letter:
            edge = self._slide_edge(pair, letter)
            self._lay_off(order, (edge if name == pair.a else edge.reversed(),), element)

    def _slide_edge(self, slide: Slide, letter: str) -> Edge:
        a, b = node(self.links, letter, slide.a), node(self.links, letter, slide.b)
        labels = (PointRef(letter, slide.b), PointRef(letter, slide.a))
        return Edge(b, a, labels, Direction("along", self.guide_names(slide)), slide=slide)

    def _dyad(self, order: Order, dyad: Dyad) -> None:
        if dyad not in self.chains:
            self.chains[dyad] = self._find(dyad)
        chain = self.chains[dyad]
        self._known_turns(order, dyad)
        number = len(self.board.equations) + 1
        sides = [self._side(order, chain.left), self._side(order, chain.right)]
        terms = [self._terms(order, side) for side in sides]
        if len(terms[0]) != 1 or terms[0][0].symbol != Symbol(_letter(order), self.label(chain.middle)):
            head = Term(Symbol(_letter(order), self.label(chain.middle)), False, False)
            terms.insert(0, (head,))
        self.board.equations.append(Equation(number, order, tuple(terms), dyad))
        self._cross(order, chain, sides, number)
        for edges in (chain.left, chain.right):
            for edge in edges:
                self._measure(order, edge, dyad)

    def _find(self, dyad: Dyad) -> Chain:
        slides = [p for p in (dyad.outer_first, dyad.inner, dyad.outer_second) if isinstance(p, Slide)]
        slides += [w.pair for body in dyad.bodies for w in body.welds if isinstance(w.pair, Slide)]
        chain = equation_of(
            self.links,
            self.ground,
            dyad,
            self.places,
            {s.key: self.guide_names(s) for s in slides},
            self.ends["velocity"],
            _same_turn(dyad),
            self.tiny,
        )
        assert chain is not None, "every dyad has an equation with two unknowns"
        return chain

    def _known_turns(self, order: Order, dyad: Dyad) -> None:
        """Links that share their rotation with one already known."""
        for name, other in _same_turn(dyad).items():
            if other in self.rates[order] and name not in self.rates[order]:
                self._spread(order, other, dyad)

    def _share_rate(self, order: Order, known: str, name: str, add: float = 0.0) -> None:
        rate = self.rates[order][known]
        self.rates[order][name] = Rate(name, rate.value + add, rate.vector, rate.mm, rate.arm_mm, rate.same_as or known)

    def _spread(self, order: Order, start: str, dyad: Dyad) -> None:
        """From one known rotation to those of all links that slide on each other or are held by drivers."""
        which = 1 if order == "velocity" else 2
        pairs: list[tuple[str, str, float]] = []
        for pair in (dyad.outer_first, dyad.inner, dyad.outer_second):
            if isinstance(pair, Slide):
                pairs.append((pair.a, pair.b, 0.0))
        for w in (w for body in dyad.bodies for w in body.welds):
            pairs.append((w.a, w.b, 0.0 if isinstance(w.pair, Slide) else _turn_sign(w) * w.driver.values[which]))
        queue = [start]
        while queue:
            at = queue.pop(0)
            for a, b, add in pairs:
                for known, new, more in ((a, b, add), (b, a, -add)):
                    if known == at and new not in self.rates[order]:
                        self._share_rate(order, at, new, more)
                        queue.append(new)

    # -- one edge: its parts ---------------------------------------------------------------------------------------------

    def _parts(self, order: Order, edge: Edge) -> list[_Part]:
        """The terms of the motion of an edge's end relative to its start."""
        if edge.weld is not None:
            return self._weld_parts(order, edge, edge.weld)
        if edge.slide is not None:
            return self._slide_parts(order, edge, edge.slide)
        return self._rigid_parts(order, edge)

    def _fixed(self, ref: PointRef) -> bool:
        return ref.link == self.ground or (not ref.link and ref.point in self.links[self.ground].points)

    def _symbol(self, kind: str, edge: Edge) -> Symbol:
        start, end = self.label(edge.labels[0]), self.label(edge.labels[1])
        if kind in ("v", "a") and self._fixed(edge.start):
            return Symbol(kind, self.label(edge.end))
        return Symbol(kind, end, start)

    def _rigid_parts(self, order: Order, edge: Edge) -> list[_Part]:
        arm = self.places[edge.end.point] - self.places[edge.start.point]
        if edge.link in self.still:
            return []
        arm_m = abs(arm) * self.scales.length
        square = 1j * unit(arm)
        name = _bar(edge)
        rate = self.rates[order].get(edge.link)
        role: Literal["resultant", "relative"] = "resultant" if self._fixed(edge.start) else "relative"
        if order == "velocity":
            span = None if edge.unknown or rate is None else square * (rate.value * arm_m / self.scales.velocity)
            size = f"ω_{{{edge.link}}}·{name}" if span is not None else ""
            return [_Part(self._symbol("v", edge), role, square, span, edge.direction, size)]
        speed = self._measured_speed(edge)
        inward = -unit(arm)
        normal = _Part(
            self._symbol("an", edge),
            "normal",
            inward,
            inward * (speed**2 / arm_m / self.scales.acceleration),
            Direction("towards", (edge.end.point, edge.start.point)),
            f"ω_{{{edge.link}}}²·{name}",
        )
        steady = rate is not None and not edge.unknown and rate.value == 0.0
        if steady:
            return [normal]
        span = None if edge.unknown or rate is None else square * (rate.value * arm_m / self.scales.acceleration)
        size = f"α_{{{edge.link}}}·{name}" if span is not None else ""
        return [normal, _Part(self._symbol("at", edge), "tangential", square, span, edge.direction, size)]

    def _measured_speed(self, edge: Edge) -> float:
        """Relative velocity of an edge (m/s) as read off the velocity polygon."""
        ends = self.ends["velocity"]
        return (
            abs(self._end("velocity", edge.end, ends) - self._end("velocity", edge.start, ends)) * self.scales.velocity
        )

    def _end(self, order: Order, ref: PointRef, ends: Mapping[PointRef, complex]) -> complex:
        if self._fixed(ref):
            return 0j
        if ref not in ends:
            self.place(order, ref)
        return ends[ref]

    def _slide_parts(self, order: Order, edge: Edge, slide: Slide) -> list[_Part]:
        sense = self.frame.poses[slide.b].axis * slide.guide.direction * (1 if edge.forward else -1)
        given = self._given(slide.key, order)
        fixed = self._fixed(edge.start)
        role: Literal["resultant", "relative"] = "resultant" if fixed else "relative"
        if order == "velocity":
            span = None if given is None else sense * (given / self.scales.velocity)
            return [_Part(self._symbol("v", edge), role, sense, span, edge.direction, _given_size(slide, span))]
        span = None if given is None else sense * (given / self.scales.acceleration)
        if slide.b in self.still or slide.a in self.still:
            # no rotation, no Coriolis: the sliding part is all there is
            symbol = self._symbol("a", edge) if fixed else self._symbol("ar", edge)
            return [
                _Part(
                    symbol, "resultant" if fixed else "sliding", sense, span, edge.direction, _given_size(slide, span)
                )
            ]
        omega = self.rates["velocity"][slide.b].value
        ends = self.ends["velocity"]
        slip = self._end("velocity", edge.end, ends) - self._end("velocity", edge.start, ends)
        size = 2 * omega * self.scales.velocity / self.scales.acceleration
        coriolis = _Part(
            self._symbol("ak", edge),
            "coriolis",
            1j * sense,
            1j * slip * size,
            Direction("turned", edge.direction.names),
            f"2ω_{{{slide.b}}}·{_plain(self._symbol('v', edge))}",
        )
        sliding = _Part(self._symbol("ar", edge), "sliding", sense, span, edge.direction, _given_size(slide, span))
        return [coriolis, sliding]

    def _given(self, key: str, order: Order) -> float | None:
        """Rate of a driven slide."""
        for driver in self.structure.scene.drivers:
            if isinstance(driver, SlideDriver) and driver.key == key:
                return driver.velocity if order == "velocity" else driver.acceleration
        return None

    def _weld_parts(self, order: Order, edge: Edge, weld: Weld) -> list[_Part]:
        """A point of a link that a driver turns about a hinge of another link, relative to that link."""
        hinge = weld.pair.point  # type: ignore[union-attr]
        arm = self.places[edge.end.point] - self.places[hinge]
        way = 1 if edge.forward else -1
        _, speed, rate = weld.driver.values
        omega, alpha = way * _turn_sign(weld) * speed, way * _turn_sign(weld) * rate
        arm_m = abs(arm) * self.scales.length
        square = 1j * unit(arm)
        if order == "velocity":
            span = square * (omega * arm_m / self.scales.velocity)
            size = f"ω_{{{weld.b}{weld.a}}}·{hinge}{edge.end.point}"
            return [_Part(self._symbol("v", edge), "relative", square, span, edge.direction, size)]
        base = weld.a if edge.forward else weld.b
        turn = self.rates["velocity"][base].value
        per = arm_m / self.scales.acceleration
        inward = -unit(arm)
        return [
            _Part(
                self._symbol("an", edge),
                "normal",
                inward,
                inward * (omega**2 * per),
                Direction("towards", (edge.end.point, hinge)),
                "ω²r",
            ),
            _Part(self._symbol("at", edge), "tangential", square, square * (alpha * per), edge.direction, "αr"),
            _Part(
                self._symbol("ak", edge),
                "coriolis",
                inward,
                inward * (2 * turn * omega * per),
                Direction("turned", edge.direction.names),
                "2ωv",
            ),
        ]

    # -- equations -----------------------------------------------------------------------------------------------------

    def _side(self, order: Order, edges: tuple[Edge, ...]) -> _Side:
        return [(edge, self._parts(order, edge)) for edge in edges]

    def _terms(self, order: Order, side: _Side) -> tuple[Term, ...]:
        start = side[0][0].start
        terms = []
        if not self._fixed(start):
            terms.append(Term(Symbol(_letter(order), self.label(start)), True, True))
        terms += [Term(p.symbol, p.span is not None, True, p.size, p.written) for _, parts in side for p in parts]
        return tuple(terms)

    def _lay_off(self, order: Order, edges: tuple[Edge, ...], element: Driven) -> None:
        """An equation without unknowns: the vectors are laid off one after the other."""
        number = len(self.board.equations) + 1
        side = self._side(order, edges)
        middle = edges[-1].end
        terms = [self._terms(order, side)]
        whole = Symbol(_letter(order), self.label(middle))
        if len(terms[0]) != 1 or terms[0][0].symbol != whole:
            terms.insert(0, (Term(whole, False, False),))
        self.board.equations.append(Equation(number, order, tuple(terms), element))
        at = self._start(order, edges[0].start)
        for part in (p for _, parts in side for p in parts):
            at = self._vector(order, part, at, number)
        self._reach(order, middle, at, number)

    def _start(self, order: Order, ref: PointRef) -> complex:
        return self._end(order, ref, self.ends[order])

    def _vector(self, order: Order, part: _Part, at: complex, equation: int) -> complex:
        """Lay off a known vector."""
        assert part.span is not None
        size = abs(part.span)
        span = part.span
        if size > 0.0:
            laid = self.board.instrument.direction(part.span / size) * self.board.instrument.length(size)
            span = laid
        vector = Vector(part.symbol, at, at + span, part.role)
        if size < ZERO_MM:
            phrase = Phrase("zero vector", (part.symbol,))
            self.board.note(phrase)
        else:
            key = {"normal": "lay off normal", "coriolis": "lay off coriolis"}.get(part.role, "lay off")
            phrase = Phrase(key, (part.symbol, part.size, f"{size:.2f}", part.written))
        self._record(order, vector, phrase, equation)
        return at + span

    def _record(self, order: Order, vector: Vector, phrase: Phrase, equation: int | None, *more: Stroke) -> None:
        self.drawn[order][vector.symbol] = vector
        self.board.do(order, phrase, vector, *more, equation=equation)

    def _cross(self, order: Order, chain: Chain, sides: list[_Side], equation: int) -> None:
        """Draw both sides of an equation up to their unknowns, and let these meet."""
        starts, lines = [], []
        for side in sides:
            parts = [p for _, found in side for p in found]
            open_at = next(i for i, p in enumerate(parts) if p.span is None)
            at = self._start(order, side[0][0].start)
            for part in parts[:open_at]:
                at = self._vector(order, part, at, equation)
            carried = 0j
            for part in parts[open_at + 1 :]:
                # known terms behind the unknown one are added first, and put in their place afterwards
                assert part.span is not None
                self.board.do(order, Phrase("carry", (part.symbol,)), Bar(at, at + part.span, ""), equation=equation)
                at += part.span
                carried += part.span
            starts.append((at, carried))
            lines.append(parts[open_at])
        what = f"{_letter(order)}_{self.label(chain.middle)}"
        (p, _), (q, _) = starts
        left, right = lines
        meeting = self.board.cross(p, left.along, q, right.along, what)
        for start, part in ((p, left), (q, right)):
            ray = Ray(start, part.along, meeting, part.written, part.symbol)
            self.board.do(order, Phrase("direction", (part.symbol, part.written)), ray, equation=equation)
        mark = Mark(self.label(chain.middle), meeting)
        self.board.do(order, Phrase("meet", (mark.ref,)), mark, equation=equation)
        for side, (start, carried) in zip(sides, starts, strict=True):
            self._fill(order, side, meeting - carried, start - carried, equation)
        self._reach(order, chain.middle, meeting, equation)

    def _fill(self, order: Order, side: _Side, tip: complex, tail: complex, equation: int) -> None:
        """Draw the unknown vector of a side, now found, and the end points along the side."""
        at = self._start(order, side[0][0].start)
        for edge, parts in side:
            for part in parts:
                if part.span is None:
                    found = Vector(part.symbol, tail, tip, part.role)
                    if abs(found.span) < ZERO_MM:
                        self.board.note(Phrase("zero vector", (part.symbol,)))
                    self._record(order, found, Phrase("found", (part.symbol, f"{abs(found.span):.2f}")), equation)
                    at = tip
                else:
                    if part.symbol not in self.drawn[order]:
                        moved = Vector(part.symbol, at, at + part.span, part.role)
                        self._record(order, moved, Phrase("put back", (part.symbol,)), equation)
                    at += part.span
            if edge is not side[-1][0]:
                self._reach(order, edge.end, at, equation)

    def _reach(self, order: Order, ref: PointRef, at: complex, equation: int | None) -> None:
        """Name an end point, and draw the vector to it from the pole."""
        if ref in self.ends[order]:
            return
        self.ends[order][ref] = at
        mark = Mark(self.label(ref), at)
        symbol = Symbol(_letter(order), self.label(ref))
        if symbol in self.drawn[order]:
            self.board.do(order, Phrase("name", (mark.ref,)), mark, equation=equation)
            return
        self._record(order, Vector(symbol, 0j, at, "resultant"), Phrase("resultant", (symbol,)), equation, mark)

    def _measure(self, order: Order, edge: Edge, dyad: Dyad) -> None:
        """Angular velocity or acceleration from the vector just found."""
        if not edge.link or not edge.unknown or edge.link in self.rates[order]:
            return
        kind = "v" if order == "velocity" else "at"
        symbol = self._symbol(kind, edge)
        vector = self.drawn[order][symbol]
        arm = self.places[edge.end.point] - self.places[edge.start.point]
        size = abs(vector.span) * self.scales.of(order) / (abs(arm) * self.scales.length)
        sense = 1.0 if cross(arm, vector.span) >= 0 else -1.0
        self.rates[order][edge.link] = Rate(edge.link, sense * size, symbol, abs(vector.span), abs(arm))
        key = "omega" if order == "velocity" else "alpha"
        turning = "ccw" if sense > 0 else "cw"
        self.board.do(order, Phrase(f"{key} {turning}", (edge.link, symbol, _bar(edge), f"{size:.6g}")))
        self._spread(order, edge.link, dyad)

    # -- images --------------------------------------------------------------------------------------------------------

    def _complete(self, order: Order, name: str) -> None:
        """All points of a link, and the points of it under sliding pins."""
        for point in self.links[name].points:
            self.place(order, PointRef(point))
        for s in self.structure.slides:
            if s.pin and s.pin in self.places and s.b == name and "/" not in name:
                self.place(order, node(self.links, s.pin, name))

    def place(self, order: Order, ref: PointRef) -> None:
        """Find the end point of any point of a link whose motion is known, by image."""
        ends = self.ends[order]
        if ref in ends or self._fixed(ref):
            return
        owners = [ref.link] if ref.link else [n for n, k in self.links.items() if ref.point in k.points]
        name = next(n for n in owners if n in self.rates[order])
        here = self.places[ref.point]
        refs = [r for r in ends if self._on(r, name)]
        if not refs:
            self._from_slide(order, ref, name)
            return
        if name in self.still:
            self._reach_by(order, ref, ends[refs[0]], Phrase("translates", (name,)))
            return
        same = [r for r in refs if abs(self.places[r.point] - here) <= self.tiny]
        if same:
            self._reach_by(order, ref, ends[same[0]], Phrase("same place", (self.label(ref), self.label(same[0]))))
            return
        a, b = max(
            ((a, b) for a in refs for b in refs),
            key=lambda ab: abs(self.places[ab[0].point] - self.places[ab[1].point]),
        )
        bar = self.places[b.point] - self.places[a.point]
        if abs(bar) <= self.tiny:
            at = self._by_rates(order, ends[a], here - self.places[a.point], name)
            self._reach_by(order, ref, at, Phrase("by rate", (self.label(ref), self.label(a), name)))
            return
        ratio = (here - self.places[a.point]) / bar
        at = self.board.instrument.point(ends[a] + (ends[b] - ends[a]) * ratio)
        names = (self.label(ref), self.label(a), self.label(b), name)
        if abs(ratio.imag) < 1e-9:
            self._reach_by(order, ref, at, Phrase("division", names), Bar(ends[a], at, name))
        else:
            image = Image(name, (ends[a], ends[b], at))
            self._reach_by(order, ref, at, Phrase("image", names), image)

    def _from_slide(self, order: Order, ref: PointRef, name: str) -> None:
        """A link none of whose own points stands in the polygon: by the driven pair on which it slides."""
        for element in self.structure.elements:
            if isinstance(element, Driven) and element.link == name and isinstance(element.pair, Slide):
                edge = self._slide_edge(element.pair, ref.point)
                self._lay_off(order, (edge if edge.end == ref else edge.reversed(),), element)
                return
        raise CallError(Problem(str(ref), f"link {name} has no point in the {order} polygon"))

    def _reach_by(self, order: Order, ref: PointRef, at: complex, phrase: Phrase, *strokes: Stroke) -> None:
        self.ends[order][ref] = at
        mark = Mark(self.label(ref), at)
        symbol = Symbol(_letter(order), self.label(ref))
        self._record(order, Vector(symbol, 0j, at, "resultant"), phrase, None, mark, *strokes)

    def _on(self, ref: PointRef, name: str) -> bool:
        return ref.link == name or (not ref.link and ref.point in self.links[name].points)

    def _by_rates(self, order: Order, start: complex, arm: complex, name: str) -> complex:
        """From one end point to another of the same link by its measured rates."""
        omega = self.rates["velocity"][name].value
        if order == "velocity":
            return start + 1j * omega * arm * (self.scales.length / self.scales.velocity)
        alpha = self.rates["acceleration"][name].value
        return start + (1j * alpha - omega**2) * arm * (self.scales.length / self.scales.acceleration)


def _letter(order: Order) -> str:
    return "v" if order == "velocity" else "a"


def _bar(edge: Edge) -> str:
    return edge.start.point + edge.end.point


def _plain(symbol: Symbol) -> str:
    return str(symbol)


def _given_size(slide: Slide, span: complex | None) -> str:
    return "" if span is None else "given"


def _turn_sign(weld: Weld) -> int:
    """+1 where the driver's angle is that of b from a."""
    assert isinstance(weld.driver, AngleDriver)
    return 1 if weld.driver.link == weld.b else -1


def _links_of(element: Driven | Dyad) -> tuple[str, ...]:
    if isinstance(element, Driven):
        return (element.link,)
    return tuple(n for body in element.bodies for n in body.links)


def _same_turn(dyad: Dyad) -> dict[str, str]:
    """For each link of a dyad one link with the same rotation but for given ones: a known one if there is any."""
    inside = [n for body in dyad.bodies for n in body.links]
    groups = {n: {n} for n in inside}
    joins = [(p.a, p.b) for p in (dyad.outer_first, dyad.inner, dyad.outer_second) if isinstance(p, Slide)]
    joins += [(w.a, w.b) for body in dyad.bodies for w in body.welds]
    for a, b in joins:
        merged = groups.get(a, {a}) | groups.get(b, {b})
        for n in merged:
            groups[n] = merged
    return {n: next((m for m in sorted(groups[n]) if m not in inside), min(groups[n])) for n in inside}
