"""The order of drawing of a group larger than a dyad in a polygon, found before it is drawn.

A vector equation with two unknown sizes is drawn if there is one.  If not, a link held by two legs has a special point:
each leg leaves its joint on the link free along one direction, and where the lines square to these through the joints
cross, the point of the link moves along both at once (Assur; Artobolevsky, Theory of mechanisms). If no link has one,
two links joined by two legs may have one relative to each other, as in groups of class IV: each leg leaves the one link
free along one direction as seen from the other; where the lines square to these cross, the points of both links there
move alike, as the centre of their relative motion.  A polygon of its own gives the difference of their accelerations,
and then both links are drawn as if hinged there (Assur's points, taken relative to a moving link; Artobolevsky). If no
special point serves either, a rate is assumed, and trial polygons with two rates are superposed: once for every
remaining degree of freedom; the fewest are sought.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations

from graphkin.construction.board.steps import FarPoint, changed
from graphkin.construction.polygons.vector_graph import Path, RelativeMotion, Unknown, VectorChain, VectorGraph
from graphkin.plane import cross, cross_lines, unit
from graphkin.scene.symbol import PointRef
from graphkin.structure import LargerGroup

FLAT = 1e-9  # sine below which the legs of a special point are parallel
MOST_TRIALS = 4
LONGEST_LEG = 3  # edges of a leg between two moving links
OFF = 1e-9  # sine between a leg's line and the way from joint to joint, below which it is that way
WORST = 0.05  # crossing and distance of a special point of two moving links that is still taken
SpecialPoint = tuple[float, tuple[str, ...], tuple[Path, Path], complex]
"""A special point that might be taken: its quality, its link or the two links that move alike there, the legs that give
it, and its place on paper (mm)."""


@dataclass(frozen=True, eq=False, repr=False)
class GroupPlan:
    """The order of drawing.

    ``tried`` are the assumed unknowns; ``open_ends`` as many edges whose ends do not meet for a wrong assumption, along
    them or (True) square to them; ``assumed`` the rates of each trial polygon, by the kind of polygon (SI).
    ``parallel`` names links with two parallel legs, ``far`` the useless special point in place of which a rate is
    assumed, if there is one.  ``contours`` are drawn first: the link held still, and the rest as a group on it.
    """

    moves: tuple[VectorChain, ...]
    tried: tuple[Unknown, ...]
    graph: VectorGraph
    parallel: tuple[tuple[str, str, str], ...] = ()
    open_ends: tuple[tuple[RelativeMotion, bool], ...] = ()
    assumed: Mapping[str, tuple[tuple[float, ...], ...]] = field(default_factory=dict)
    far: FarPoint | None = None
    contours: tuple[tuple[str, LargerGroup], ...] = ()


@dataclass
class _Search:
    """The known part of a group, and the moves that gave it.

    along : direction of the relative motion of an edge
    far : useless special points of two moving links, of all searches
    """

    graph: VectorGraph
    along: Callable[[RelativeMotion, Mapping[str, complex]], complex]
    letters: Iterator[str]
    nodes: set[PointRef]
    known: set[Unknown]
    far: list[FarPoint]
    moves: list[VectorChain] = field(default_factory=list)
    parallel: list[tuple[str, str, str]] = field(default_factory=list)

    # what is known

    def seen(self, edge: RelativeMotion) -> RelativeMotion:
        """An edge with its present unknowns."""
        return changed(edge, unknown=None) if edge.unknown in self.known else edge

    def of(self, link: str) -> list[PointRef]:
        """The points of a link in the graph."""
        return [n for n in self.graph.nodes if link in self.graph.owners[n]]

    def turns(self, link: str) -> bool:
        """Whether the rate of a link is known."""
        unknown = self.graph.turning(link)
        return unknown[1] not in self.graph.inside or unknown in self.known

    @property
    def size(self) -> float:
        """The distance of the farthest point from the origin."""
        return max((abs(z) for z in self.graph.places.values()), default=1.0) or 1.0

    def settle(self) -> None:
        """Add all points of links that turn at a known rate about a known point."""
        grown = True
        while grown:
            grown = False
            for link in self.graph.inside:
                mine = self.of(link)
                if self.turns(link) and not self.nodes.issuperset(mine) and self.nodes.intersection(mine):
                    self.nodes.update(mine)
                    grown = True

    # ways

    def ways(self, start: PointRef, most: int, stop: Callable[[PointRef], bool]) -> Iterator[Path]:
        """Paths from a known point through unknown ones to their ends, with at most ``most`` unknowns."""
        return (tuple(map(self.seen, path)) for path in self.graph.paths(start, most, stop, self.nodes, self.known))

    def all_ways(self, most: int, ends: Collection[PointRef]) -> Iterator[Path]:
        """Paths from every known point to some ends, with at most ``most`` unknowns."""
        return (path for start in self.graph.in_order(self.nodes) for path in self.ways(start, most, ends.__contains__))

    # moves, each tried in turn

    def close(self) -> bool:
        """A rate that two known points of a link give."""
        for link in self.graph.inside:
            if self.turns(link):
                continue
            pairs = [
                e for n in self.of(link) if n in self.nodes for e in self.graph.edges[n]
                if e.link == link and e.end in self.nodes
            ]
            if pairs:
                # from what was known before to what was found: from the frame where it can be
                places = self.graph.places
                best = max(pairs, key=lambda e: (
                    -self.graph.strange((e,)), e.start in self.graph.fixed, e.start in self.graph.known,
                    abs(places[e.end.point] - places[e.start.point]), e.forward,
                ))
                return self.drawn(VectorChain.closing(self.seen(best)), (best,))
        return False

    def drawn(self, move: VectorChain, path: Path) -> bool:
        """Add a move, after which a path is known."""
        self.moves.append(move)
        for edge in path:
            if edge.link and edge.unknown:
                self.known.add(edge.unknown)
            self.nodes |= {edge.start, edge.end}
        self.settle()
        return True

    def way(self, edge: RelativeMotion) -> complex:
        """The direction of the relative motion of an edge."""
        return self.along(edge, self.graph.places)

    def reach(self) -> bool:
        """Take a path without unknowns from a known point to a link without a known point; or a path with one unknown
        between two known points."""
        for start in self.graph.in_order(self.nodes):
            for path in self.ways(start, 1, self.nodes.__contains__):
                if len(path) > 1 and not self.nodes.issuperset(e.end for e in path):
                    return self.drawn(VectorChain.closing(*path), path)
            for path in self.ways(start, 0, lambda n: n not in self.nodes):
                links = [name for name in self.graph.owners[path[-1].end] if name in self.graph.inside]
                if all(self.nodes.isdisjoint(self.of(name)) for name in links):
                    return self.drawn(VectorChain.closing(*path), path)
        return False

    def cross(self) -> bool:
        """Take the best equation with two unknown sizes."""
        best: tuple[tuple[float, ...], Path] | None = None
        for path in self.all_ways(2, self.nodes):
            if best is not None and best[0][:2] < (0.0, len(path) - 1.0):
                continue  # even a right angle makes it no better
            two = [self.way(e) for e in path if e.unknown]
            sine = abs(cross(*two)) if len(two) == 2 else 0.0
            cost = (float(sine < 0.05), len(path) + 0.6 * self.graph.strange(path) - sine,
                    float(self.graph.order[path[0].start]))
            if sine >= FLAT and (best is None or cost < best[0]):
                best = cost, path
        return best is not None and self.drawn(VectorChain.crossing(best[1]), best[1])

    def legs(self, link: str) -> list[Path]:
        """Paths from known points to a link, each with one unknown that is not the link's own rate."""
        own_rate, mine = self.graph.turning(link), set(self.of(link))
        best: dict[Unknown, Path] = {}
        for path in self.all_ways(1, mine):
            unknown = next((e.unknown for e in path if e.unknown), None)
            if unknown is None or unknown == own_rate:
                continue
            old = best.get(unknown)
            if old is None or (len(path), self.graph.strange(path)) < (len(old), self.graph.strange(old)):
                best[unknown] = path
        return list(best.values())

    def special(self, left_out: Collection[tuple[str, str]]) -> bool:
        """Take the special point with the best crossings, of any link except these."""
        choices: list[SpecialPoint] = []
        flat: tuple[str, Path, Path] | None = None
        for link in self.graph.inside:
            if ("", link) in left_out or self.turns(link) or self.nodes.intersection(self.of(link)):
                continue
            legs = self.legs(link)
            for first, second in combinations(legs, 2):
                at, sine, away = self.crossing(first, second)
                if at is None or sine < FLAT:
                    flat = flat or (link, first, second)
                    names = link, first[-1].end.point, second[-1].end.point
                    if names[1] != names[2] and names not in self.parallel:
                        self.parallel.append(names)
                    continue
                third = [self._third(leg, at) for leg in legs if leg not in (first, second)]
                quality = sine / (1.0 + away / self.size) * max(third, default=0.5)
                choices.append((quality, (link,), (first, second), at))
        if self.take(choices):
            return True
        if flat is None:
            return False
        link, first, second = flat
        edges = self.graph.edges[first[-1].end]
        bar = next((self.seen(e) for e in edges if e.link == link and e.end == second[-1].end), None)
        if bar is None or abs(cross(self.way(bar), self.line(first)[1] * 1j)) < FLAT:
            return False
        self.moves.append(VectorChain.closing(*first, bar, *(e.reversed() for e in reversed(second)), link=link))
        assert bar.unknown is not None
        self.known.add(bar.unknown)
        self.settle()
        return True

    def take(self, choices: Sequence[SpecialPoint]) -> bool:
        """Take the best of some special points, if there is one.

        What a link turns by lies along the line that the leg leaves free: its size is not asked.
        """
        if not choices:
            return False
        _, links, sides, at = max(choices, key=lambda choice: choice[0])
        *base, ref = self.graph.add_special_point(links, next(self.letters), at)

        def between(leg: Path) -> Path:
            before = [e.reversed() for start in base for e in self.on_line(leg, leg[0].start, start, links[0])]
            return (*before, *leg, *self.on_line(leg, leg[-1].end, ref, links[-1]))

        if not base:
            self.nodes.add(ref)
        self.moves.append(VectorChain(ref, tuple(map(between, sides)), links[-1], links[0] if base else ""))
        self.settle()
        return True

    def on_line(self, leg: Path, joint: PointRef, ref: PointRef, link: str) -> Path:
        """The edge from the joint of a leg to the special point, written in the leg's own direction, since both lie
        along one line; none where the special point is the joint itself."""
        if abs(self.graph.places[joint.point] - self.graph.places[ref.point]) <= self.graph.tiny:
            return ()
        free = next(e for e in leg if e.unknown)
        return (RelativeMotion(joint, ref, (joint, ref), free.direction, link=link, unknown=self.graph.turning(link)),)

    def line(self, leg: Path) -> tuple[complex, complex]:
        """The line of a leg: through its joint on the link, square to the direction that it leaves free."""
        free = next(e for e in leg if e.unknown)
        return self.graph.places[leg[-1].end.point], 1j * self.way(free)

    def crossing(self, first: Path, second: Path) -> tuple[complex | None, float, float]:
        """The crossing of the lines of two legs, the sine of their angle, and its distance from the middle of their
        joints."""
        (p, d), (q, e) = self.line(first), self.line(second)
        at = cross_lines(p, d, q, e)
        return at, abs(cross(d, e)), 0.0 if at is None else abs(at - (p + q) / 2)

    def _third(self, leg: Path, at: complex) -> float:
        """The sine of the angle between a third leg's line and a line from it to a place; 0 if it leads there."""
        p, d = self.line(leg)
        return abs(cross(unit(p - at), d)) if abs(p - at) > self.graph.tiny else 0.0

    # the special point of two links that both move

    def take_special_point(self, left_out: Collection[tuple[str, str]]) -> bool:
        """Take the special point of two moving links with the best crossing: they are drawn as if hinged there."""
        choices: list[SpecialPoint] = []
        for links, legs in self._legs_between({*left_out, *self.points}).items():
            for first, second in combinations(legs, 2):
                at, sine, away = self.crossing(first, second)
                if at is None or sine < OFF:  # parallel: nothing lies there
                    continue
                quality = sine / (1.0 + away / self.size)
                if quality <= WORST:
                    self.far.append(FarPoint(links, away, math.asin(min(1.0, sine))))
                else:
                    choices.append((quality, links, (first, second), at))
        return self.take(choices)

    def _legs_between(self, left_out: Collection[tuple[str, str]]) -> Mapping[tuple[str, str], Sequence[Path]]:
        """For each two links except these the shortest path by each unknown that joins them."""
        owners, names = self.graph.owners, [name for name in self.graph.inside if "/" not in name]
        turning = {name: self.graph.turning(name) for name in names}
        legs_between: dict[tuple[str, str], dict[Unknown, Path]] = {}
        for i, link in enumerate(names):
            others = {n: [other for other in names[i + 1 :] if other in owners[n]] for n in self.graph.nodes}
            for path in self._ways_off(link):
                unknown = next((e.unknown for e in path if e.unknown), None)
                for other in others[path[-1].end] if unknown else ():
                    if unknown is None or (link, other) in left_out or unknown in (turning[link], turning[other]):
                        continue
                    legs = legs_between.setdefault((link, other), {})
                    if (unknown not in legs or len(path) < len(legs[unknown])) and self._straight(path):
                        legs[unknown] = path
        return {links: list(legs.values()) for links, legs in legs_between.items()}

    def _ways_off(self, link: str) -> Iterator[Path]:
        """Paths that leave a link, with at most one unknown."""
        stack: list[Path] = [()]
        while stack:
            path = stack.pop()
            for start in (path[-1].end,) if path else self.of(link):
                for edge in map(self.seen, self.graph.edges[start]):
                    if edge.link == link or edge.end in self.nodes or (
                            edge.unknown and any(e.unknown for e in path)):
                        continue
                    yield (*path, edge)
                    if len(path) + 1 < LONGEST_LEG:
                        stack.append((*path, edge))

    def _straight(self, leg: Path) -> bool:
        """Whether a leg's joints on both links lie on its line, so that the turning of neither moves it along the
        line."""
        end, along = self.line(leg)
        arm = end - self.graph.places[leg[0].start.point]
        return abs(arm) <= self.graph.tiny or abs(cross(unit(arm), along)) < OFF

    # the whole

    def run(self, relative: bool, left_out: Collection[tuple[str, str]]) -> bool:
        """Take moves while any is possible; whether the whole group is drawn then.  Special points of two moving links
        are allowed if ``relative``, none of those ``left_out``, by base ("": none) and link."""
        self.settle()
        # until the rate of each link is known, and a point of it
        while not all(self.turns(link) and self.nodes.intersection(self.of(link)) for link in self.graph.inside):
            if not (self.close() or self.cross() or self.reach() or self.special(left_out)) and not (
                relative and self.take_special_point(left_out)
            ):
                return False
        return True

    @property
    def points(self) -> list[tuple[str, str]]:
        """The used special points, by base ("": none) and link."""
        return [(m.base, m.link) for m in self.moves if m.is_special]

    def unknowns(self) -> list[Unknown]:
        """The unknowns that can be assumed: rates of links, those next to known links first; then those of sliding
        pairs."""
        edges = [e for n in self.graph.nodes for e in self.graph.edges[n] if e.unknown and e.unknown not in self.known]
        near = [e for e in edges if e.link and (e.start in self.nodes or e.end in self.nodes)]
        turning = [e for e in edges if e.link]
        sliding = [e for e in edges if e.slide is not None]
        return list(dict.fromkeys(e.unknown for e in (*near, *turning, *sliding) if e.unknown))


def plan_group(
    graph: VectorGraph, along: Callable[[RelativeMotion, Mapping[str, complex]], complex], letters: Sequence[str]
) -> Iterator[GroupPlan]:
    """The plans for drawing a group, those with the fewest trials first, by the direction ``along`` the relative motion
    of each edge, with free ``letters`` for special points."""
    start = _Search(graph, along, iter(letters), set(graph.known), set(), [])
    for trials in range(MOST_TRIALS + 1):
        for relative in (False, True):  # a special point of two moving links is looked for where no other serves
            served = False
            for tried in combinations(start.unknowns(), trials):
                search = _searched(start, tried, letters, relative)
                if search is not None:
                    served = True
                    far = min(start.far, key=lambda point: point.away, default=None) if tried else None
                    yield GroupPlan(tuple(search.moves), tried, search.graph, tuple(search.parallel), far=far)
            if served:
                return


def _searched(start: _Search, tried: Sequence[Unknown], letters: Sequence[str], relative: bool) -> _Search | None:
    """A complete search; with special points of two moving links the first with the fewest, found by leaving out points
    one by one."""

    def found(left_out: Collection[tuple[str, str]]) -> _Search | None:
        known = {*start.known, *tried}
        search = _Search(start.graph.copy(), start.along, iter(letters), set(start.nodes), known, start.far)
        return search if search.run(relative, left_out) else None

    left_out: tuple[tuple[str, str], ...] = ()
    best = search = found(left_out)
    while relative and search is not None and best is not None:
        if len(search.points) < len(best.points):
            best = search
        points, search = search.points, None
        for point in points if len(points) > 1 else ():
            search = found((*left_out, point))
            if search is not None:
                left_out = (*left_out, point)
                break
    return best
