"""What is drawn of a group larger than a dyad in a polygon, move by move: equations, closings, special points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from graphkin.construction.mechanism_acts import PitchPoint, SpecialPoint
from graphkin.construction.moves import Closed, Crossed, Move, OneLine, Path, Special
from graphkin.construction.net import Edge, Joined, Net, RollingPoint, TwoWays
from graphkin.construction.polygon_acts import Carried, DirectionLine, FoundVector, MeasuredRate
from graphkin.construction.polygon_pair import Order, letter
from graphkin.construction.polygons import Polygons
from graphkin.construction.sheet import Equation, Rate, Term
from graphkin.construction.strokes import Aid, Bar, Mark, Ray
from graphkin.construction.touching import Touching
from graphkin.plane import added_up, cross, unit
from graphkin.scene.model import AngleDriver, SlideDriver
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Cluster, Slide, Turn, Weld, driver_pair, links_of

__all__ = ["GroupMoves"]

LETTERS = tuple("SQTUVWXYZ") + tuple(f"S{i}" for i in range(1, 30))


class GroupMoves(Polygons):
    """Polygons with the moves by which a group is drawn."""

    def _free_letters(self) -> Sequence[str]:
        taken = {*self.places, *(p for link in self.links.values() for p in link.points)}
        return [name for name in LETTERS if name not in taken]

    def _net(self, group: Cluster, wide: bool = False) -> Net:
        slides = [p for p in group.pairs if isinstance(p, Slide)]
        welds = []
        for driver in group.drivers:
            pair = driver_pair(driver, self.links, self.structure.slides)
            if pair is not None and isinstance(driver, AngleDriver):
                welds.append(Weld(pair, driver, pair.b, pair.a))
        driven = frozenset(d.key for d in group.drivers if isinstance(d, SlideDriver))
        rolling = self._rolling_points(group)
        seen = [(held, n) for held, rest in self.contours.get(group, ()) for n in rest.links]
        whole = Joined(group.members, group.pairs, welds, driven, near=True, rolling=rolling, contours=seen, wide=wide)
        joined = self._at_contacts(group, whole)
        names = {s.key: self.guide_names(s) for s in slides}
        return Net(self.links, self.ground, joined, self.places, names, self._same_turn(group), self.tiny)

    def _rolling_points(self, group: Cluster) -> list[RollingPoint]:
        """The points where links of a group roll on each other: contacts by their name, those of wheels by a free
        letter, marked on the mechanism."""
        scene = self.structure.scene
        between = {c.name: c.links for c in scene.contacts} | {g.name: g.wheels for g in scene.gears}
        found = []
        for relation in group.rolling:
            letter = relation.name
            if relation.name not in self.touching:
                letter = self.pitch_points.get(relation.name) or self._mark_pitch_point(relation.name)
            found.append(RollingPoint(relation.name, letter, between[relation.name]))
        return found

    def _mark_pitch_point(self, name: str) -> str:
        letter = self.pitch_points[name] = next(iter(self._free_letters()))
        touching = Touching(self.structure.scene, self.frame.mm, self.frame.poses)
        at = self.board.instrument.point(touching.rolling_centres(name)[0])
        self.special.add(letter)
        self.places[letter] = at
        wheels = next(g.wheels for g in self.structure.scene.gears if g.name == name)
        self.board.do("mechanism", PitchPoint(letter, wheels), Mark(PointRef(letter), at))
        return letter

    def _way(self, edge: Edge, places: Mapping[str, complex]) -> complex:
        if edge.rolling:
            touching = Touching(self.structure.scene, self.frame.mm, self.frame.poses)
            return 1j * touching.rolling_centres(edge.rolling)[1]
        if edge.slide is not None:
            return self.frame.poses[edge.slide.b].axis * edge.slide.guide.direction
        if edge.contact:
            return -1j * self.contact(edge.contact)[2]
        if edge.weld is not None and isinstance(edge.weld.pair, Turn):  # both ends lie at one place, off the hinge
            return 1j * unit(places[edge.end.point] - places[edge.weld.pair.point])
        return 1j * unit(places[edge.end.point] - places[edge.start.point])

    def _move(self, order: Order, group: Cluster, move: Move) -> None:
        match move:
            case Crossed(chain):
                self._equation(order, group, chain)
            case Closed(path):
                self._close(order, path, group)
            case Special():
                self._special(order, group, move)
            case OneLine(link, path):
                self._one_line(order, group, link, path)
        self._complete(order, group)

    def _complete(self, order: Order, group: Cluster) -> None:
        """All points of links that turn at known rates and of which one point is known, by images."""
        ends = self.ends[order]
        left = [n for n in links_of(group) if n in self.rates[order]]
        while ready := [n for n in left if any(self._on(ref, n) for ref in ends)]:
            for name in ready:
                self.complete(order, name)
                left.remove(name)

    def _left(self, order: Order, net: Net) -> list[Edge]:
        """What moves along the guides of a group, or slips at its contacts, and has not been drawn."""
        found = []
        for ref in net.nodes:
            for edge in net.edges[ref]:
                s = edge.slide
                if not edge.forward or not (edge.contact or (s is not None and edge.start.point == s.pin)):
                    continue
                symbol = Symbol(letter(order), self.label(edge.labels[1]), self.label(edge.labels[0]))
                if symbol not in self.drawn[order] and not self.fixed(edge.start):
                    found.append(replace(edge, unknown=edge.unknown))
        return found

    def _equation(self, order: Order, group: Cluster, chain: TwoWays) -> None:
        number = len(self.board.equations) + 1
        sides = [self._side(order, chain.left), self._side(order, chain.right)]
        self.board.equations.append(Equation(number, order, self._two_ways(order, chain, sides), group))
        self._cross(order, chain, sides, number)
        for edges in (chain.left, chain.right):
            if sum(bool(edge.unknown) for edge in edges) == 1:  # of several along one line only the sum is known
                for edge in edges:
                    self._measure(order, edge, group)

    def _close(self, order: Order, path: Path, group: Cluster) -> None:
        """A way between two points whose end points stand already, or from one such with nothing unknown."""
        number: int | None = len(self.board.equations) + 1
        side = self._side(order, path)
        last = path[-1].end
        stands = self.fixed(last) or last in self.ends[order] or self._placeable(order, last)
        parts = [p for _, found in side for p in found]
        head = Term(Symbol(letter(order), self.label(last)), stands, stands)
        terms = self._terms(order, side)
        if len(terms) != 1 or terms[0].symbol != head.symbol:
            self.board.equations.append(Equation(len(self.board.equations) + 1, order, ((head,), terms), group))
        else:
            number = None
        at = self.end(order, path[0].start)
        open_at = next((i for i, p in enumerate(parts) if p.span is None), None)
        if open_at is None:
            for edge, found in side:
                for part in found:
                    at = self._vector(order, part, at, number)
                self.reach(order, edge.end, at, number)
            return
        for part in parts[:open_at]:
            known = self.drawn[order].get(part.symbol)
            at = known.tip if known is not None else self._vector(order, part, at, number)
        after = added_up((p.span for p in parts[open_at + 1 :] if p.span is not None), 0j)
        self._fill(order, side, self.end(order, last) - after, at, number)
        for edge in path:
            self._measure(order, edge, group)

    def _placeable(self, order: Order, ref: PointRef) -> bool:
        owners = [ref.link] if ref.link else [n for n, k in self.links.items() if ref.point in k.points]
        return any(n in self.rates[order] and any(self._on(r, n) for r in self.ends[order]) for n in owners)

    # -- special points ------------------------------------------------------------------------------------------------

    def _special(self, order: Order, group: Cluster, move: Special) -> None:
        link, name = move.link, move.letter
        if name not in self.places:
            self._mark_special(move)
        if move.base:
            self._relative(order, group, move)
            return
        ref = PointRef(name)
        ways = []
        for leg in move.legs:
            ways.append((*leg, *self._to_special(group, leg, leg[-1].end, ref, link, link in self.rates[order])))
        right, left = ways
        self._equation(order, group, TwoWays(ref, left, right))

    def _to_special(
        self, group: Cluster, leg: Path, joint: PointRef, ref: PointRef, link: str, turns: bool = False
    ) -> tuple[Edge, ...]:
        """From the joint of a leg to the special point; nothing where it is the joint itself."""
        if abs(self.places[joint.point] - self.places[ref.point]) <= self.tiny:
            return ()
        unknown = "" if turns else f"omega {self._same_turn(group).get(link, link)}"
        # written as the leg's own direction, for the two lie along one line
        free = next(e for e in leg if e.unknown)
        return (Edge(joint, ref, (joint, ref), free.direction, link=link, unknown=unknown),)

    def _relative(self, order: Order, group: Cluster, move: Special) -> None:
        """How the special point of one link moves relative to that of another: by both legs, drawn from the pole.

        The velocities of both are the same where nothing drives a leg; their accelerations are not."""
        base, ref = PointRef(move.letter, move.base), PointRef(move.letter, move.link)
        sides = []
        for leg in move.legs:
            # what both links turn by lies along the line that the leg leaves free: its size is not asked
            before = self._to_special(group, leg, leg[0].start, base, move.base)
            after = self._to_special(group, leg, leg[-1].end, ref, move.link)
            sides.append(self._side(order, (*(e.reversed() for e in before), *leg, *after)))
        parts = [[part for _, found in side for part in found] for side in sides]
        self.ties[order, move.letter] = 0j  # exactly, where nothing drives a leg
        if not any(part.span for side in parts for part in side):
            return
        symbol = Symbol(letter(order), self.label(ref), self.label(base))
        number = len(self.board.equations) + 1
        terms = [tuple(Term(p.symbol, p.span is not None, True, p.size, p.written) for p in side) for side in parts]
        self.board.equations.append(Equation(number, order, ((Term(symbol, False, False),), *terms), group))
        starts, lines = [], []
        for side in parts:
            at = 0j
            for part in side:
                if part.span:
                    self.board.do(order, Carried(part.symbol), Bar(at, at + part.span, ""), equation=number)
                    at += part.span
            starts.append(at)
            lines.append(next(part for part in side if part.span is None))
        left, right = (self.slip.line(part.symbol, part.along) for part in lines)
        meeting = self.board.cross(order, starts[0], left, starts[1], right, str(symbol))
        for start, part in zip(starts, lines, strict=True):
            ray = Ray(start, part.along, meeting, part.written, part.symbol)
            self.board.do(order, DirectionLine(part.symbol, part.written), ray, equation=number)
        self.ties[order, move.letter] = meeting
        found = Aid(symbol, 0j, meeting, self.trial)
        self.board.do(order, FoundVector(symbol, abs(meeting)), found, equation=number)

    def _mark_special(self, move: Special) -> None:
        """The special point on the mechanism: where the lines of two legs cross."""
        (p, d), (q, e) = (self._leg_line(leg) for leg in move.legs)
        d = self.slip.line(Symbol("v", PointRef(move.letter)), d)
        at = self.board.cross("mechanism", p, d, q, e, move.letter)
        self.special.add(move.letter)
        self.places[move.letter] = at
        if not move.base:
            pose = self.frame.poses[move.link]
            points = {**self.links[move.link].points, move.letter: (at - pose.origin) / pose.axis / self.frame.mm}
            self.links[move.link] = replace(self.links[move.link], points=points)
        joints = tuple(leg[-1].end.point for leg in move.legs)
        driven = any(not e.unknown and (e.slide or e.weld) for leg in move.legs for e in leg)
        act = SpecialPoint(move.letter, move.link, (joints[0], joints[1]), move.base, driven)
        self.board.do("mechanism", act, Bar(p, at, ""), Bar(q, at, ""), Mark(PointRef(move.letter), at))

    def _leg_line(self, leg: Path) -> tuple[complex, complex]:
        free = next(e for e in leg if e.unknown)
        return self.places[leg[-1].end.point], 1j * self._way(free, self.places)

    def _one_line(self, order: Order, group: Cluster, link: str, path: Path) -> None:
        """The rate of a link whose two legs are parallel: from one leg's known end square to the bar between the
        joints, from the other's along the direction that both leave free."""
        number = len(self.board.equations) + 1
        side = self._side(order, path)
        terms = self._terms(order, side)
        head = Term(Symbol(letter(order), self.label(path[-1].end)), True, True)
        self.board.equations.append(Equation(number, order, ((head,), terms), group))
        start, goal = self.end(order, path[0].start), self.end(order, path[-1].end)
        mine = free = None
        for edge, parts in side:
            for part in parts:
                if part.span is not None:
                    self.board.do(order, Carried(part.symbol), Bar(start, start + part.span, ""), equation=number)
                    start += part.span
                elif edge.link == link and edge.unknown.endswith(self._same_turn(group).get(link, link)):
                    mine = edge, part
                else:
                    free = part
        assert mine is not None
        assert free is not None
        edge, part = mine
        what = str(part.symbol)
        meeting = self.board.cross(order, start, part.along, goal, self.slip.line(free.symbol, free.along), what)
        for through, one in ((start, part), (goal, free)):
            ray = Ray(through, one.along, meeting, one.written, one.symbol)
            self.board.do(order, DirectionLine(one.symbol, one.written), ray, equation=number)
        span = meeting - start
        act = FoundVector(part.symbol, self.found_mm(part.symbol, span))
        self.board.do(order, act, Aid(part.symbol, start, meeting, 0), equation=number)
        arm = self.places[edge.end.point] - self.places[edge.start.point]
        value, read = self.rate_of(order, part.symbol, abs(span), arm, (edge.start.point, edge.end.point))
        value *= 1.0 if cross(arm, span) >= 0 else -1.0
        kind = "omega" if order == "velocity" else "alpha"
        self.rates[order][link] = Rate(link, value, None, read, abs(arm))
        told = MeasuredRate(kind, link, part.symbol, (edge.start.point, edge.end.point), value, read)  # type: ignore[arg-type]
        self.board.do(order, told)
        self._spread(order, link, group)
