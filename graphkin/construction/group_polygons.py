"""Groups larger than a dyad in the polygons: contours of known shape first, then special points or trial polygons."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import chain, product

from graphkin.construction.as_seen import equations_seen, seen, steps_seen
from graphkin.construction.board import Board
from graphkin.construction.contours import Joint, contours
from graphkin.construction.group_plan import GroupPlan, plan_group
from graphkin.construction.links_on_paper import PlacedLinks
from graphkin.construction.moves import Move, Special, paths_of
from graphkin.construction.net import Edge, contacts_of
from graphkin.construction.polygon_acts import SeenFrom
from graphkin.construction.polygon_pair import Order, Plot
from graphkin.construction.polygons import links_alike
from graphkin.construction.relative_points import FarPoint
from graphkin.construction.remarks import ParallelLegs
from graphkin.construction.sheet import DrawnGroup, Rate, Scales
from graphkin.construction.sizes import Direction
from graphkin.construction.slip import NO_SLIP, Slip
from graphkin.construction.strokes import Vector
from graphkin.construction.trial_polygons import TrialPolygons
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import AngleDriver, SlideDriver
from graphkin.scene.symbol import PointRef
from graphkin.structure import Cluster, Driven, Dyad, Slide, Structure, Turn, driver_pair
from graphkin.words import Phrase

__all__ = ["GroupPolygons"]

MOST_WAYS = 12  # choices of held links that are tried
MUCH_BETTER = 2.0  # so many times as well must another plan find the rates


class GroupPolygons(TrialPolygons):
    """Both polygons of one position, larger groups among their elements."""

    def __init__(
        self, board: Board, structure: Structure, frame: PlacedLinks, scales: Scales, slip: Slip = NO_SLIP
    ) -> None:
        super().__init__(board, structure, frame, scales, slip)
        self.plans: dict[Cluster, GroupPlan] = {}
        self.part_of: Cluster | None = None  # the group to which all belongs that is drawn with a link of it held still

    def draw(self, order: Order, element: Driven | Dyad | Cluster) -> None:
        """Draw what an element adds to a polygon."""
        if not isinstance(element, Cluster):
            super().draw(order, element)
            return
        self._known_turns(order, element)
        self._rolling_points(element)
        if element in self.plans:
            self.contours[element] = self.plans[element].contours
            self._by_plan(order, element, self.plans[element])
        else:
            self._first(order, element)

    def shown_of(self, order: Order) -> list[Vector]:
        """The vectors of a polygon, those that only lead to special points left out."""
        return [v for symbol, v in self.drawn[order].items() if not self.is_aid(symbol)]

    def drawn_group(self, group: Cluster, kept: Sequence[str]) -> DrawnGroup:
        """How a group was drawn, said."""
        plan = self.plans[group]
        points = tuple((m.letter, m.link) for m in plan.moves if isinstance(m, Special))
        closing = tuple(e.link or (e.slide.key if e.slide else "") for e, _ in plan.open_ends)
        return DrawnGroup(group, plan.way, tuple(kept), plan.tried, closing, points)

    def _first(self, order: Order, group: Cluster) -> None:
        """Find how a group is drawn, and draw it so."""
        plain = plan_group(self._net(group), self._same_turn(group), self._way, self._free_letters())
        first = next(plain, None)
        if first is None or not first.tried:
            self._take(order, group, () if first is None else (first,))
            return
        shorter, far = self._shorter(group, len(first.tried))
        if shorter:
            self.contours[group] = shorter[0].contours
            self._see(order, group)
            self._take(order, group, shorter)
        else:
            self._take(order, group, (replace(p, far=p.far or far) for p in chain((first,), plain)))

    def _take(self, order: Order, group: Cluster, plans: Iterable[GroupPlan]) -> None:
        """Draw a group by the first plan without trials, else by that whose trials find the rates best; all have as
        many."""
        best: tuple[float, GroupPlan] | None = None
        for found in plans:
            if not found.tried:
                best = 1.0, found
                break
            quality, made = self._judged(order, group, found)
            if best is None or quality > MUCH_BETTER * best[0]:
                best = quality, made
            if MUCH_BETTER * best[0] >= len(found.tried) ** 0.5:
                break  # none can be so much better
        if best is None or not best[0]:
            names = ", ".join(group.links)
            raise Unsolvable(
                "dead point",
                Problem(Phrase("links", links=names), Phrase("no drawing tells how this group moves here")),
            )
        self.plans[group] = best[1]
        self._by_plan(order, group, best[1])

    def _by_plan(self, order: Order, group: Cluster, plan: GroupPlan) -> None:
        self._see(order, group)
        if order == "velocity":
            for _, one, two in plan.parallel:
                self.board.notice("mechanism", ParallelLegs((one, two)))
        if plan.tried:
            plan = self.plans[group] = self._with_assumptions(order, group, plan)
            self._assume(order, group, plan, self._true_rates(order, group, plan))
        self._complete(order, group)
        for move in plan.moves:
            self._move(order, group, move)
        for edge in self._left(order, plan.net):
            self._close(order, (edge,), group)

    # -- contours of known shape ---------------------------------------------------------------------------------------

    def _turned(self, order: Order | None, group: Dyad | Cluster) -> list[tuple[str, str, float]]:
        pairs = super()._turned(order, group if self.part_of is None else self.part_of)
        for held, rest in self.contours.get(group, ()) if isinstance(group, Cluster) else ():
            seen = self.seen[held].rates[order] if order and held in self.seen else {}
            pairs += [(held, n, seen[n].value if n in seen else 0.0) for n in rest.members if not order or n in seen]
        return pairs

    def _same_turn(self, group: Dyad | Cluster) -> dict[str, str]:
        if self.part_of is None or not isinstance(group, Cluster):
            return super()._same_turn(group)
        # links of the group that are not of the contour turn as unknown as its own
        alike = links_alike(group.members, self._turned(None, group))
        inside = set(group.members)
        return {n: self.ground if self.ground in alike[n] else min(alike[n] & inside) for n in group.members}

    def _shorter(self, group: Cluster, trials: int) -> tuple[list[GroupPlan], FarPoint | None]:
        """The plans of a group with fewer trials than so many, special points carried over to all links that turn with
        theirs, its contours drawn first where that spares more; none where neither does, and then the special point
        met with that is no use.  The links held still are chosen so that what is seen from them is laid off as it was
        seen."""
        choices = [self._held(group, links) for links in self._contours(group)]
        choices = [some for some in choices if some]
        best: tuple[tuple[int, bool], list[GroupPlan]] | None = None
        far: FarPoint | None = None
        for number, chosen in enumerate(chain([()], product(*choices) if choices else ())):
            self.contours[group] = chosen
            net = self._net(group, wide=True)
            plans = plan_group(net, self._same_turn(group), self._way, self._free_letters())
            first = next(plans, None)
            if first is not None and len(first.tried) >= trials:
                far = far or first.far
            elif first is not None:
                cost = len(first.tried), _against(first)
                if best is None or cost < best[0]:
                    best = cost, [replace(p, contours=chosen) for p in (first, *(plans if first.tried else ()))]
            if number + 1 == MOST_WAYS or (best is not None and best[0] == (0, False)):
                break
        del self.contours[group]
        return (best[1] if best is not None else []), far

    def _contours(self, group: Cluster) -> list[tuple[str, ...]]:
        if group.rolling or (self.at_contacts and contacts_of(self.structure, group)):
            return []
        inside = set(group.members)
        keys = {d.key for d in group.drivers if isinstance(d, SlideDriver)}
        held = [driver_pair(d, self.links, self.structure.slides) for d in group.drivers]
        turned = {frozenset((p.a, p.b)) for p in held if isinstance(p, Turn)}
        joints = []
        for pair in group.pairs:
            if not {pair.a, pair.b} <= inside:
                continue
            if isinstance(pair, Slide):
                along = self.frame.poses[pair.b].axis * pair.guide.direction
                at = self.places[pair.pin] if pair.pin else self.frame.poses[pair.a].origin
                joints.append(Joint((pair.a, pair.b), at, along, pair.key in keys))
            else:
                driven = frozenset((pair.a, pair.b)) in turned
                joints.append(Joint((pair.a, pair.b), self.places[pair.point], None, driven))
        turning = [(a, b) for a, b, _ in self._turned(None, group) if {a, b} <= inside]
        return contours(group.members, joints, turning)

    def _held(self, group: Cluster, contour: Sequence[str]) -> list[tuple[str, Cluster]]:
        """The links of a contour that can be held still so that the rest is drawn on it without trials; those first on
        which the most hangs besides."""
        outer = [n for p in group.pairs for n in (p.a, p.b) if not {p.a, p.b} <= set(contour)]
        found = []
        for held in sorted((n for n in contour if "/" not in n), key=lambda n: -outer.count(n)):
            rest = _on(group, held, contour, self.structure.slides)
            made = self._with_held(group, held)
            plan = next(plan_group(made._net(rest), made._same_turn(rest), made._way, made._free_letters()), None)
            if plan is not None and not plan.tried:
                self.plans[rest] = plan
                found.append((held, rest))
        return found

    def _with_held(self, group: Cluster, held: str) -> GroupPolygons:
        """Empty polygons with a link of a group for the frame."""
        made = self._fork(0)
        made.ground, made.part_of = held, group
        made.board.lengths = {}
        made.slip = Slip(line=lambda symbol, way: self.slip.line(seen(symbol, held), way))
        made.still = made._never_turning()
        made.seen, made.contours = {}, {}
        for order in ("velocity", "acceleration"):
            made.ends[order] = {PointRef(p): 0j for p in self.links[held].points}
            made.rates[order] = {held: Rate(held, 0.0)}
            made.drawn[order] = {}
        return made

    def _turn_driven(self, order: Order, rest: Cluster) -> None:
        """Lay off points of links that turn at known rates about hinges of the held link."""
        for pair in (p for p in rest.pairs if isinstance(p, Turn) and self.ground in (p.a, p.b)):
            name, pivot = pair.b if pair.a == self.ground else pair.a, PointRef(pair.point)
            if name not in self.rates[order] or name in self.still:
                continue
            for end in self._first_ends(name, pair.point):
                if end not in self.ends[order]:
                    way = Direction("square", (pivot.point, end.point))
                    self._lay_off(order, (Edge(pivot, end, (pivot, end), way, link=name),), rest)

    def _see(self, order: Order, group: Cluster) -> None:
        """Draw the contours of a group, each as it moves seen from one of its links."""
        for held, rest in self.contours.get(group, ()):
            if held not in self.seen:
                self.seen[held] = self._with_held(group, held)
            apart = self.seen_from(held)
            if rest.members[0] in apart.rates[order]:
                continue
            assert isinstance(apart, GroupPolygons)
            before = len(apart.board.steps), len(apart.board.equations)
            apart._spread(order, held, rest)
            apart._turn_driven(order, rest)
            apart.draw(order, rest)
            for name in rest.members:
                apart.complete(order, name)
            self.special, self.places, self.links = apart.special, apart.places, apart.links
            for step in apart.board.steps[before[0] :]:
                if step.diagram == "mechanism":
                    self.board.do("mechanism", step.act, *step.strokes)
            first = len(self.board.equations) + 1 if len(apart.board.equations) > before[1] else None
            self.board.do(order, SeenFrom(held, rest.links, order), equation=first)
            self._tell(order, group, held, apart, *before)
        for held, rest in self.contours.get(group, ()):
            for name in (held, *rest.members):
                if name in self.rates[order]:
                    self._spread(order, name, group)

    def _tell(self, order: Order, group: Cluster, held: str, apart: Plot, steps: int, equations: int) -> None:
        """What has been drawn with a link held still, after so many steps and equations."""
        further = len(self.board.equations) - equations
        self.board.equations += equations_seen(apart, equations, held, group, further)
        for act, strokes, number in steps_seen(apart, steps, held, further):
            self.board.do(order, act, *strokes, equation=number)

    def _move(self, order: Order, group: Cluster, move: Move) -> None:
        for edge in (e for path in paths_of(move) for e in path if e.held):
            # the point of the contour that the equation needs
            apart = self.seen_from(edge.held)
            before = len(apart.board.steps), len(apart.board.equations)
            apart.end(order, edge.end if edge.forward else edge.start)
            if not self.trial:
                self._tell(order, group, edge.held, apart, *before)
        super()._move(order, group, move)


def _on(group: Cluster, held: str, contour: Sequence[str], slides: Sequence[Slide]) -> Cluster:
    """The links of a contour besides the held one, as a group of their own."""
    rest = tuple(n for n in contour if n != held)
    within = set(contour)
    joined = {s.key: {s.a, s.b} for s in slides}
    drivers = tuple(
        d for d in group.drivers
        if (isinstance(d, AngleDriver) and {d.link, d.relative_to} <= within)
        or (isinstance(d, SlideDriver) and joined[d.key] <= within)
    )  # fmt: skip
    pairs = tuple(p for p in group.pairs if {p.a, p.b} <= within)
    return Cluster(rest, pairs, drivers, tuple(n for n in rest if n in group.links), group.order)


def _against(plan: GroupPlan) -> bool:
    """Whether a plan lays off what was seen from a link in the other sense."""
    return any(e.held and not e.forward for move in plan.moves for path in paths_of(move) for e in path)
