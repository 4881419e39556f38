"""Velocity and acceleration polygons: equations drawn, rates measured, the rest by images.

The position stands on paper already.  Every size is either given, or measured on what was drawn before: normal
components from lengths in the velocity polygon, Coriolis components from a measured angular velocity and a measured
sliding velocity (Sun Huan, Mechanical Principles, ch. 3; Norton, Design of Machinery, ch. 6 and 7).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import Literal

from graphkin.construction.board import Board
from graphkin.construction.links_on_paper import PlacedLinks
from graphkin.construction.net import Edge, Joined, TwoWays, contacts_of, equation_of, joined_at_contacts, node
from graphkin.construction.polygon_acts import (
    AddedRate,
    Carried,
    DirectionLine,
    FoundVector,
    LaidOff,
    LinesMeet,
    MeasuredRate,
    PutBack,
)
from graphkin.construction.polygon_pair import Order, Plot, letter
from graphkin.construction.remarks import ZeroVector
from graphkin.construction.sheet import Equation, Rate, Scales, Term
from graphkin.construction.sizes import Direction
from graphkin.construction.slip import NO_SLIP, Component, Slip
from graphkin.construction.strokes import Bar, Mark, Ray, Vector
from graphkin.construction.terms import bar, parts_of, symbol_of, turn_sign
from graphkin.construction.wheels import Wheels
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, dot
from graphkin.scene.model import AngleDriver, Follower, SlideDriver, SlideFollower
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Cluster, Driven, Dyad, Rolled, Slide, Structure, Turn, links_of
from graphkin.words import Phrase

__all__ = ["Polygons", "links_alike", "same_turn"]

_Side = list[tuple[Edge, list[Component]]]
RATE: Mapping[Order, Literal["omega", "alpha"]] = {"velocity": "omega", "acceleration": "alpha"}


class Polygons(Plot):
    """Both polygons of one position, drawn element by element in the order of solution."""

    def __init__(
        self, board: Board, structure: Structure, frame: PlacedLinks, scales: Scales, slip: Slip = NO_SLIP
    ) -> None:
        super().__init__(board, structure, frame, scales, slip)
        self.chains: dict[Dyad, TwoWays] = {}
        self.contours: dict[Cluster, tuple[tuple[str, Cluster], ...]] = {}  # of groups: the held link, the rest on it
        self.wheels = Wheels.of(structure)
        self.at_contacts = False  # whether sliding contacts are drawn themselves, instead of what replaces them

    def draw(self, order: Order, element: Driven | Dyad) -> None:
        """Draw what an element adds to a polygon."""
        if isinstance(element, Driven):
            self._driven(order, element)
        else:
            self._dyad(order, element)
        for name in links_of(element):
            self.complete(order, name)

    def _driven(self, order: Order, element: Driven) -> None:
        name, driver, pair = element.link, element.driver, element.pair
        mm = self._roll(order, driver) if isinstance(driver, Rolled | Follower) else 0.0
        rate = self.given[driver.key][0 if order == "velocity" else 1]
        if isinstance(driver, AngleDriver):
            other, sign = (driver.relative_to, 1) if driver.link == name else (driver.link, -1)
            base = self.rates[order][other].value
            self.rates[order][name] = Rate(name, base + sign * rate, mm=mm)
        elif isinstance(pair, Turn):
            self.rates[order][name] = Rate(name, rate, mm=mm)
        if isinstance(pair, Turn) and name in self.rates[order]:
            pivot = PointRef(pair.point)
            for end in self._first_ends(name, pair.point):
                way = Direction("square", (pivot.point, end.point))
                self._lay_off(order, (Edge(pivot, end, (pivot, end), way, link=name),), element)
            return
        assert isinstance(pair, Slide)
        known = pair.b if name == pair.a else pair.a
        self._share_rate(order, known, name)
        point = pair.pin or next(iter([*self.links[name].points, *self.places]), "")
        if point:
            edge = self._slide_edge(pair, point)
            self._lay_off(order, (edge if name == pair.a else edge.reversed(),), element)

    def _roll(self, order: Order, driver: Follower | Rolled) -> float:
        """The rate of what rolls, read off a velocity plan, as the driver's; and the length read for it (mm)."""
        coordinate = driver.coordinate if isinstance(driver, Rolled) else ("angle", driver.key)
        if isinstance(driver, SlideFollower):
            coordinate = "travel", driver.key
        which = 0 if order == "velocity" else 1
        turns = [(s.a, s.b, 0.0) for s in self.structure.slides]
        turns += [(d.link, d.relative_to, d.values[1 + which]) for d in self.structure.scene.drivers
                  if isinstance(d, AngleDriver)]  # fmt: skip
        known = {name: rate.value for name, rate in self.rates[order].items()}
        before = self.wheels
        self.wheels, value, mm = before.found(
            order, coordinate, known, lambda key: self._travel_rate(order, key), turns, self.board.instrument
        )
        for act in self.wheels.acts(before, order):
            self.board.do(order, act)
        had = self.given.get(driver.key, (0.0, 0.0))
        self.given[driver.key] = (value, had[1]) if which == 0 else (had[0], value)
        return mm

    def _travel_rate(self, order: Order, key: str) -> float | None:
        """How fast a sliding link goes along its guide (m/s, m/s2), where that is known: given, or read off the polygon
        as the part along it of its motion relative to the coincident point; that of Coriolis is square to it."""
        which = 0 if order == "velocity" else 1
        given = next((d for d in self.structure.scene.drivers if d.key == key and isinstance(d, SlideDriver)), None)
        if given is not None:
            return given.values[1 + which]
        slide = self.structure.slide(key)
        if not {slide.a, slide.b} <= self.rates[order].keys():
            return None
        point = slide.pin or next(iter(self.links[slide.a].points), "")
        if not point:
            names = ", ".join((slide.a, slide.b))
            raise Unsolvable(
                "not drawn", Problem(Phrase("links", links=names), Phrase("no point of the sliding link is drawn"))
            )
        along = self.frame.poses[slide.b].axis * slide.guide.direction
        slip = self.end(order, node(self.links, point, slide.a)) - self.end(order, node(self.links, point, slide.b))
        return dot(slip, along) * self.scales.of(order)

    def _first_ends(self, name: str, hinge: str) -> list[PointRef]:
        """With which points of a driven link a drawing begins: one of its own, else those under what slides on it."""
        own = [PointRef(p) for p in self.links[name].points if p != hinge]
        under = [
            node(self.links, s.pin, name)
            for s in self.structure.slides
            if s.pin in self.places and s.b == name and "/" not in name
        ]
        away = [n for n in (*own, *under) if abs(self.places[n.point] - self.places[hinge]) > self.tiny]
        first = away[:1] if any(n in own for n in away) else away
        return list(dict.fromkeys(first))

    def _slide_edge(self, slide: Slide, point: str) -> Edge:
        a, b = node(self.links, point, slide.a), node(self.links, point, slide.b)
        labels = (PointRef(point, slide.b), PointRef(point, slide.a))
        return Edge(b, a, labels, Direction("along", self.guide_names(slide)), slide=slide)

    def _dyad(self, order: Order, dyad: Dyad) -> None:
        if dyad not in self.chains:
            self.chains[dyad] = self._find(dyad)
        chain = self.chains[dyad]
        self._known_turns(order, dyad)
        number = len(self.board.equations) + 1
        sides = [self._side(order, chain.left), self._side(order, chain.right)]
        self.board.equations.append(Equation(number, order, self._two_ways(order, chain, sides), dyad))
        self._cross(order, chain, sides, number)
        for edges in (chain.left, chain.right):
            for edge in edges:
                self._measure(order, edge, dyad)

    def _find(self, dyad: Dyad) -> TwoWays:
        welds = tuple(w for body in dyad.bodies for w in body.welds)
        pairs = (dyad.outer_first, dyad.inner, dyad.outer_second, *(w.pair for w in welds))
        slides = [p for p in pairs if isinstance(p, Slide)]
        joined = Joined(links_of(dyad), pairs, welds)
        chain = equation_of(
            self.links,
            self.ground,
            self._at_contacts(dyad, joined),
            self.places,
            {s.key: self.guide_names(s) for s in slides},
            self.ends["velocity"],
            self._same_turn(dyad),
            self.tiny,
        )
        if chain is None:
            # every dyad has an equation with two unknowns, but its points must be apart on the sheet
            names = ", ".join(dyad.links)
            raise Unsolvable(
                "not drawn",
                Problem(Phrase("links", links=names), Phrase("points of theirs fall together on any sheet")),
            )
        return chain

    def _at_contacts(self, group: Dyad | Cluster, joined: Joined) -> Joined:
        contacts = contacts_of(self.structure, group) if self.at_contacts else ()
        return joined_at_contacts(joined, contacts) if contacts else joined

    def _same_turn(self, group: Dyad | Cluster) -> dict[str, str]:
        contacts = contacts_of(self.structure, group) if self.at_contacts else ()
        return same_turn(group, self._turned(None, group), {c.block for c in contacts})

    def _turned(self, order: Order | None, group: Dyad | Cluster) -> list[tuple[str, str, float]]:
        """Links a and b of a group that turn alike but for a given rate: (a, b, that of b from a); without an order
        only which."""
        return _turned_alike(group, order or "velocity", self.given if order else {})

    def _known_turns(self, order: Order, group: Dyad | Cluster) -> None:
        """Links that share their rotation with one already known."""
        for name, other in self._same_turn(group).items():
            if other in self.rates[order] and name not in self.rates[order]:
                self._spread(order, other, group)

    def _share_rate(self, order: Order, known: str, name: str, add: float = 0.0) -> None:
        rate = self.rates[order][known]
        self.rates[order][name] = Rate(name, rate.value + add, rate.vector, rate.mm, rate.arm_mm, rate.same_as or known)

    def _spread(self, order: Order, start: str, group: Dyad | Cluster) -> None:
        """From one known rotation to those of all links that slide on each other or are held by drivers."""
        pairs = self._turned(order, group)
        queue = [start]
        while queue:
            at = queue.pop(0)
            for a, b, add in pairs:
                for known, new, more in ((a, b, add), (b, a, -add)):
                    if known == at and new not in self.rates[order]:
                        self._share_rate(order, at, new, more)
                        told = self._told_apart(order, a, b) if a in self.seen else add != 0.0
                        if isinstance(group, Cluster) and at != self.ground and told:
                            value = self.rates[order][at].value
                            self.board.do(order, AddedRate(RATE[order], new, at, b, value, add))
                        queue.append(new)

    def _told_apart(self, order: Order, one: str, other: str) -> bool:
        """Whether it is told how a link turns as seen from another: it does not just turn as a third does."""
        rates = self.seen[one].rates[order]
        if other not in rates:
            return False
        return not rates[other].same_as or rates[rates[other].same_as].value != rates[other].value

    def _side(self, order: Order, edges: tuple[Edge, ...]) -> _Side:
        return [(edge, [self.slip.term(part) for part in parts_of(self, order, edge)]) for edge in edges]

    def _terms(self, order: Order, side: _Side) -> tuple[Term, ...]:
        start = side[0][0].start
        terms = []
        if not self.fixed(start):
            terms.append(Term(Symbol(letter(order), self.label(start)), True, True))
        terms += [Term(p.symbol, p.span is not None, True, p.size, p.written) for _, parts in side for p in parts]
        return tuple(terms)

    def _two_ways(self, order: Order, chain: TwoWays, sides: Iterable[_Side]) -> tuple[tuple[Term, ...], ...]:
        """Both sides of an equation behind what they are equal to; a side that is this itself stands first."""
        whole = Symbol(letter(order), self.label(chain.middle))
        terms = [self._terms(order, side) for side in sides]
        alone = [side for side in terms if [t.symbol for t in side] == [whole]]
        others = [side for side in terms if side not in alone]
        return (*(alone or [(Term(whole, False, False),)]), *others)

    def _lay_off(self, order: Order, edges: tuple[Edge, ...], element: Driven | Cluster) -> None:
        """An equation without unknowns: the vectors are laid off one after the other."""
        number = len(self.board.equations) + 1
        side = self._side(order, edges)
        middle = edges[-1].end
        terms = [self._terms(order, side)]
        whole = Symbol(letter(order), self.label(middle))
        if len(terms[0]) != 1 or terms[0][0].symbol != whole:
            terms.insert(0, (Term(whole, False, False),))
        self.board.equations.append(Equation(number, order, tuple(terms), element))
        at = self.end(order, edges[0].start)
        for part in (p for _, parts in side for p in parts):
            at = self._vector(order, part, at, number)
        self.reach(order, middle, at, number)

    def _vector(self, order: Order, part: Component, at: complex, equation: int | None) -> complex:
        """Lay off a known vector."""
        assert part.span is not None
        size = abs(part.span)
        tip = at
        if size > 0.0:
            hand = self.board.instrument
            tip = hand.point(at + hand.direction(part.span / size) * hand.length(size))
        vector = Vector(part.symbol, at, tip, part.role)
        self.board.notice(order, ZeroVector(part.symbol, size))
        self.record(order, vector, LaidOff(part.symbol, part.size, size, part.written, part.role), equation)
        return tip

    def _cross(self, order: Order, chain: TwoWays, sides: list[_Side], equation: int) -> None:
        """Draw both sides of an equation up to their unknowns, and let these meet.

        A side may have several unknowns along one direction, as those of a special point have: their sum is found.
        """
        starts, lines = [], []
        for side in sides:
            parts = [p for _, found in side for p in found]
            open_at = next(i for i, p in enumerate(parts) if p.span is None)
            at = self.end(order, side[0][0].start)
            for part in parts[:open_at]:
                at = self._vector(order, part, at, equation)
            carried = 0j
            for part in parts[open_at + 1 :]:
                if part.span is None:
                    continue
                # known terms behind the unknown one are added first, and put in their place afterwards
                self.board.do(order, Carried(part.symbol), Bar(at, at + part.span, ""), equation=equation)
                at += part.span
                carried += part.span
            starts.append((at, carried))
            lines.append(parts[open_at])
        what = f"{letter(order)}_{self.label(chain.middle)}"
        (p, _), (q, _) = starts
        left, right = (self.slip.line(part.symbol, part.along) for part in lines)
        meeting = self.board.cross(order, p, left, q, right, what)
        meeting = self.slip.found(Symbol(letter(order), self.label(chain.middle)), 0j, meeting)
        for start, part in zip((p, q), lines, strict=True):
            ray = Ray(start, part.along, meeting, part.written, part.symbol)
            self.board.do(order, DirectionLine(part.symbol, part.written), ray, equation=equation)
        mark = Mark(self.label(chain.middle), meeting)
        self.board.do(order, LinesMeet(mark.ref), mark, equation=equation)
        for side, (start, carried) in zip(sides, starts, strict=True):
            if sum(part.span is None for _, found in side for part in found) == 1:
                self._fill(order, side, meeting - carried, start - carried, equation)
        self.reach(order, chain.middle, meeting, equation)

    def _fill(self, order: Order, side: _Side, tip: complex, tail: complex, equation: int | None) -> None:
        """Draw the unknown vector of a side, now found, and the end points along the side."""
        at = self.end(order, side[0][0].start)
        for edge, parts in side:
            for part in parts:
                if part.span is None:
                    found = Vector(part.symbol, tail, self.slip.found(part.symbol, tail, tip), part.role)
                    self.board.notice(order, ZeroVector(part.symbol, abs(found.span)))
                    act = FoundVector(part.symbol, self.found_mm(part.symbol, found.span))
                    self.record(order, found, act, equation)
                    at = tip
                else:
                    if part.symbol not in self.drawn[order]:
                        moved = Vector(part.symbol, at, at + part.span, part.role)
                        self.record(order, moved, PutBack(part.symbol), equation)
                    at = self.drawn[order][part.symbol].tip
            if edge is not side[-1][0]:
                self.reach(order, edge.end, at, equation)

    def _measure(self, order: Order, edge: Edge, group: Dyad | Cluster) -> None:
        """Angular velocity or acceleration from the vector just found."""
        if not edge.link or not edge.unknown or edge.link in self.rates[order]:
            return
        kind = "v" if order == "velocity" else "at"
        symbol = symbol_of(self, kind, edge)
        vector = self.drawn[order][symbol]
        arm = self.places[edge.end.point] - self.places[edge.start.point]
        # in a trial the ends need not meet: only the part square to the bar turns it
        drawn = cross(arm, vector.span) / abs(arm) if self.trial else abs(vector.span)
        size, read = self.rate_of(order, symbol, abs(drawn), arm, bar(edge))
        sense = 1.0 if cross(arm, vector.span) >= 0 else -1.0
        rate = RATE[order]
        own = self.slip.rate(Symbol(rate, link=edge.link), sense * size)
        if own is not None:
            self.believed.add((order, edge.link))
        self.rates[order][edge.link] = Rate(
            edge.link, sense * size if own is None else own, symbol, read, abs(arm)
        )
        self.board.do(order, MeasuredRate(rate, edge.link, symbol, bar(edge), sense * size, read))
        self._spread(order, edge.link, group)


def _turned_alike(
    group: Dyad | Cluster, order: Order, rates: Mapping[str, tuple[float, float]]
) -> list[tuple[str, str, float]]:
    """Links a and b of a group that turn alike but for a given rate: (a, b, that of b from a)."""
    which = 0 if order == "velocity" else 1
    if isinstance(group, Cluster):
        slides = [p for p in group.pairs if isinstance(p, Slide)]
        given = [
            (d.relative_to, d.link, rates[d.key][which] if rates else 0.0)
            for d in group.drivers if isinstance(d, AngleDriver)
        ]  # fmt: skip
        return [*((s.a, s.b, 0.0) for s in slides), *given]
    slides = [p for p in (group.outer_first, group.inner, group.outer_second) if isinstance(p, Slide)]
    welds = [w for body in group.bodies for w in body.welds]
    held = [
        (w.a, w.b, turn_sign(w) * rates[w.driver.key][which] if rates and isinstance(w.pair, Turn) else 0.0)
        for w in welds
    ]
    return [*((s.a, s.b, 0.0) for s in slides), *held]


def links_alike(links: Iterable[str], pairs: Iterable[tuple[str, str, float]]) -> dict[str, set[str]]:
    """For each link all those with the same rotation but for given ones."""
    alike = {n: {n} for n in links}
    for a, b, _ in pairs:
        merged = alike.get(a, {a}) | alike.get(b, {b})
        for n in merged:
            alike[n] = merged
    return alike


def same_turn(
    group: Dyad | Cluster, pairs: Iterable[tuple[str, str, float]], without: Collection[str] = ()
) -> dict[str, str]:
    """For each link of a group one link with the same rotation but for given ones, as ``pairs`` turn: a known one if
    there is any, none of those it is ``without``."""
    inside = links_of(group)
    alike = links_alike(inside, pairs)
    own = {n: min(alike[n].difference(without), default=n) for n in inside}
    return {n: next((m for m in sorted(alike[n]) if m not in inside), own[n]) for n in inside}
