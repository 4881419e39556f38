"""Points of links as nodes, their relative motions as edges: vector equations are chains of them; and which can be
drawn next.

A node is a point of a link (`PointRef`; coincident points are nodes of their own).  An edge leads from one node to
another and stands for the velocity of the second relative to the first: square to the bar between them where both are
points of one link, along the guide where they coincide on both sides of a sliding pair.  A chain from one known node to
another gives a vector equation; it can be drawn when two sizes are unknown.

Groups with sliding contacts are drawn at the contacts themselves too, as a second way beside what replaces them: an
edge then joins the material points of both bodies, whose velocities differ along the tangent only.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from itertools import chain, pairwise

from graphkin.construction.board.steps import Direction
from graphkin.scene.model import PlacedLink
from graphkin.scene.pairs import HigherPair, Pair
from graphkin.scene.symbol import PointRef
from graphkin.structure import DrivenJoint, Dyad, LargerGroup, Structure
from graphkin.structure.model import Coordinate

LONGEST = 5  # edges of an equation


Unknown = Coordinate
"""An unknown rate: of the angle of a link, with all links that turn alike, of a travel, or ("slip", contact)."""


@dataclass(frozen=True)
class RelativeMotion:
    """The motion of ``end`` relative to ``start``.

    ``link`` is the rigid link between them, or ``slide`` their sliding pair, or ``joint`` the driven turning pair, or
    ``contact`` the sliding contact, or ``rolling`` the rolling pair; or they lie at the special point of two links
    joined by legs (``special``); or on two links of one contour, of which one is ``held`` still.  ``unknown`` is its
    unknown, if it has one.  ``labels`` are the names of the nodes, coincident points with their links.
    """

    start: PointRef
    end: PointRef
    labels: tuple[PointRef, PointRef]
    direction: Direction
    link: str = ""
    slide: Pair | None = None
    joint: DrivenJoint | None = None
    contact: str = ""
    rolling: str = ""
    special: bool = False
    held: str = ""
    forward: bool = True
    unknown: Unknown | None = None

    @classmethod
    def of_link(cls, start: PointRef, end: PointRef, link: str, unknown: Unknown | None = None) -> RelativeMotion:
        """The relative motion of two points of one link."""
        direction = Direction("square", (start.point, end.point))
        return cls(start, end, (start, end), direction, link=link, unknown=unknown)

    @property
    def bar(self) -> tuple[str, str]:
        """The letters of both ends."""
        return self.start.point, self.end.point

    @property
    def between(self) -> tuple[str, str]:
        """The written links of an edge between coincident points."""
        return self.labels[0].link, self.labels[1].link

    def reversed(self) -> RelativeMotion:
        """The motion of its start relative to its end."""
        return replace(self, start=self.end, end=self.start, labels=self.labels[::-1], forward=not self.forward)


Path = tuple[RelativeMotion, ...]


@dataclass(frozen=True, eq=False, repr=False)
class VectorChain:
    """A vector equation to be drawn: paths from known nodes to the node ``end``.

    Two ``sides`` have one unknown size each, and cross there.  A single side has one unknown size, in a path to a drawn
    node, or none; or it leads between two parallel legs of a ``link``, whose special point lies at infinity, and gives
    its rate.

    Two sides of a ``link`` lead to its special point ``end``, by the legs that give it: from known nodes; or from the
    same point of another moving link, ``base``, with which the link moves there.
    """

    end: PointRef
    sides: tuple[Path, ...]
    link: str = ""
    base: str = ""

    @property
    def is_special(self) -> bool:
        """Whether it leads to a special point."""
        return bool(self.link) and len(self.sides) == 2

    @classmethod
    def closing(cls, *path: RelativeMotion, link: str = "") -> VectorChain:
        """The equation of a single path to a node."""
        return cls(path[-1].end, (path,), link)

    @classmethod
    def crossing(cls, path: Path) -> VectorChain:
        """The equation of a path with two unknowns between known nodes: its two sides meet at the node before the
        second unknown."""
        second = [i for i, edge in enumerate(path) if edge.unknown][1]
        return cls(path[second].start, (tuple(edge.reversed() for edge in reversed(path[second:])), path[:second]))


def node(links: Mapping[str, PlacedLink], point: str, link: str) -> PointRef:
    """The node of a point on a link: the pin itself if it is one of the link's own points."""
    return PointRef(point) if point in links[link].points else PointRef(point, link)


class VectorGraph:
    """Nodes and edges around a group.

    Parameters
    ----------
    links, places, frame, tiny : all links with their points, the places of points on paper (mm), the fixed link, and
        the distance within which points coincide
    inside, pairs, joints : links of the group, all their pairs, the driven joints among them
    shares : for each link a link that turns alike
    guide_names : the names of the guides of sliding pairs
    driven : sliding pairs moved by a driver
    near : whether of the coincident points of two links only those next to a point of either are kept, as for larger
        groups, where all would be too many
    contacts : sliding contacts without a replacement
    rolling : the points of rolling in a group, by the name of the contact or the wheels: the letter of the point, and
        the links
    contours : a held link with each other of its contour
    wide : whether a special point of a link is also a node on all links that turn with it
    """

    def __init__(
        self, links: Mapping[str, PlacedLink], places: Mapping[str, complex], frame: str, tiny: float,
        inside: Sequence[str], pairs: Sequence[Pair], joints: Sequence[DrivenJoint], shares: Mapping[str, str],
        guide_names: Mapping[str, tuple[str, ...]], driven: Collection[str] = (), near: bool = False,
        contacts: Sequence[HigherPair] = (), rolling: Mapping[str, tuple[str, tuple[str, str]]] | None = None,
        contours: Sequence[tuple[str, str]] = (), wide: bool = False,
    ) -> None:
        self.links, self.places, self.tiny = links, places, tiny
        self.inside, self.shares, rolling = inside, shares, rolling or {}
        slides, turns = [p for p in pairs if not p.turns], [p for p in pairs if p.turns]
        touching = [c.name for c in contacts]
        letters = list(dict.fromkeys([s.pin for s in slides if s.pin] + [t.point for t in turns] + touching))
        self.natural = {node(links, t.point, t.a) for t in turns}
        self.natural |= {node(links, s.pin, side) for s in slides if s.pin for side in (s.a, s.b)}
        self.natural |= {PointRef(c.name, side) for c in contacts for side in c.bodies}
        self.natural |= {PointRef(letter, link) for letter, both in rolling.values() for link in both}
        sides = [*((p.a, p.b) for p in pairs), *((j.a, j.b) for j in joints), *(c.bodies for c in contacts)]
        around = dict.fromkeys([*inside, *chain(*sides)])
        beside = [*((s.a, s.b) for s in slides), *((j.a, j.b) for j in joints), *contours]
        on = _near(links, beside, contacts, around, letters) if near else {}
        self.owners: dict[PointRef, list[str]] = {}
        for name in around:
            for letter in letters:
                if letter in links[name].points or ("/" not in name and (not near or letter in on[name])):
                    self.owners.setdefault(node(links, letter, name), []).append(name)
        for letter, both in rolling.values():
            self.owners |= {PointRef(letter, link): [link] for link in both}
        self.nodes = list(self.owners)
        self.fixed = {n for n, names in self.owners.items() if frame in names}
        self.known = {n for n, names in self.owners.items() if not set(inside).issuperset(names)}
        self.order = {n: i for i, n in enumerate(self.nodes)}
        self.edges: dict[PointRef, list[RelativeMotion]] = {n: [] for n in self.nodes}
        for name in inside:
            mine = [n for n in self.nodes if name in self.owners[n]]
            for i, a in enumerate(mine):
                for b in mine[i + 1 :]:
                    self._add_bar(a, b, name)
        given = {j.pair.key for j in joints if not j.pair.turns}.union(driven)
        for s in slides:
            direction, unknown = Direction("along", guide_names[s.key]), ("travel", s.key)
            for b, a, labels in self._coincident(letters, s.b, s.a):
                self._add(RelativeMotion(b, a, labels, direction, slide=s, unknown=None if s.key in given else unknown))
        for j in (j for j in joints if j.pair.turns):
            for a, b, labels in self._coincident(letters, j.a, j.b):
                self._add(RelativeMotion(a, b, labels, Direction("square", (j.pair.point, labels[0].point)), joint=j))
        for c in contacts:
            # against the frame where it can be: its point stands in the pole
            a, b = (PointRef(c.name, link) for link in sorted(c.bodies, key=lambda link: link != frame))
            direction, unknown = Direction("along", ("t-t",)), ("slip", c.name)
            self._add(RelativeMotion(a, b, (a, b), direction, contact=c.name, unknown=unknown))
        for relation, (letter, both) in rolling.items():
            a, b = (PointRef(letter, link) for link in both)
            self._add(RelativeMotion(a, b, (a, b), Direction("along", ("n-n",)), rolling=relation))
        for held, other in contours:
            for a, b, labels in self._coincident(letters, held, other):
                self._add(RelativeMotion(a, b, labels, Direction("found", ()), held=held))
        self.under: list[RelativeMotion] = []  # for links that turn alike one edge between coincident points of theirs
        if wide:
            by_pair = {(e.slide or e.joint or e.held, *e.between): e for n in self.nodes for e in self.edges[n]
                     if e.forward and (e.slide or e.joint or e.held) and "/" not in "".join(e.between)}
            self.under = list(by_pair.values())

    def copy(self) -> VectorGraph:
        """A copy of the graph, to which special points may be added."""
        made = copy(self)
        made.owners, made.nodes, made.order = dict(self.owners), list(self.nodes), dict(self.order)
        made.edges = {n: list(edges) for n, edges in self.edges.items()}
        return made

    def equation(self, drawn: Collection[PointRef]) -> VectorChain | None:
        """The shortest equation with two unknown sizes of a dyad's links and all pairs that hold them, if any; nodes
        ``drawn`` in the polygon already are preferred as its ends."""
        # it may come back to where it begins: a pin that both guides belong to
        paths = [path for start in self.in_order(self.known)
                 for path in self.paths(start, 2, self.known.__contains__, self.known, shortest=0)
                 if sum(bool(e.unknown) for e in path) == 2]

        def cost(path: Path) -> tuple[float, bool, int]:
            start = path[0].start
            ends = sum(n not in drawn for n in (start, path[-1].end))
            return len(path) + 0.6 * self.strange(path) + 0.1 * ends, start in self.fixed, self.order[start]

        best = min(reversed(paths), key=cost, default=None)
        return None if best is None else VectorChain.crossing(best)

    def paths(
        self, start: PointRef, most: int, stop: Callable[[PointRef], bool], nodes: Collection[PointRef],
        known: Collection[Unknown] = (), shortest: int = 1,
    ) -> Iterator[Path]:
        """Paths from a node through others to their ends.

        Parameters
        ----------
        most : the greatest number of unknowns along a path
        nodes, known : drawn nodes, through which no path leads, and found unknowns
        shortest : a path may return to its beginning with more than this number of edges besides the last
        """
        stack: list[tuple[Path, tuple[Unknown, ...]]] = [((), ())]
        while stack:
            path, unknowns = stack.pop()
            at = path[-1].end if path else start
            if path and stop(at):
                yield path
                continue
            if path and (at in nodes or len(path) >= LONGEST):
                continue
            visited = {e.end for e in path}
            for e in self.edges[at]:
                if e.end in visited or (e.end == start and 0 < len(path) <= shortest):
                    continue
                if not e.unknown or e.unknown in known:
                    stack.append(((*path, e), unknowns))
                elif len(unknowns) < most and e.unknown not in unknowns:
                    stack.append(((*path, e), (*unknowns, e.unknown)))

    def strange(self, path: Path) -> int:
        """The number of nodes of a path that are no joints."""
        return len({n for e in path for n in (e.start, e.end)} - self.natural)

    def in_order(self, nodes: Iterable[PointRef]) -> list[PointRef]:
        """Some nodes in their order."""
        return sorted(nodes, key=self.order.__getitem__)

    def turning(self, link: str) -> Unknown:
        """The rate of a link, by the name of a link that turns alike."""
        return "angle", self.shares.get(link, link)

    def _add(self, edge: RelativeMotion) -> None:
        self.edges[edge.start].append(edge)
        self.edges[edge.end].append(edge.reversed())

    def _add_bar(self, a: PointRef, b: PointRef, link: str) -> None:
        """Add the edge between two distinct points of a link."""
        turning = self.turning(link)
        if abs(self.places[a.point] - self.places[b.point]) > self.tiny:
            self._add(RelativeMotion.of_link(a, b, link, turning if turning[1] in self.inside else None))

    def _coincident(
        self, letters: Sequence[str], link: str, other: str
    ) -> Iterator[tuple[PointRef, PointRef, tuple[PointRef, PointRef]]]:
        """Coincident points of two links: their nodes, and their names."""
        for letter in letters:
            a, b = node(self.links, letter, link), node(self.links, letter, other)
            if a in self.owners and b in self.owners and a != b:
                yield a, b, (PointRef(letter, link), PointRef(letter, other))

    def add_special_point(self, links: Sequence[str], letter: str, at: complex) -> list[PointRef]:
        """Add the special point of a link; or that of two, a point of each, whose relative motion is found first."""
        refs = [self._added(PointRef(letter, name if len(links) > 1 else ""), name, at) for name in links]
        for first, second in pairwise(refs):
            self._add(RelativeMotion(first, second, (first, second), Direction("found", ()), special=True))
        self._carry_over(dict(zip(links, refs, strict=True)), at)
        return refs

    def _carry_over(self, refs: dict[str, PointRef], at: complex) -> None:
        """Add a special point also on the links that turn with its links."""
        letter = next(iter(refs.values())).point
        left, grown = list(self.under), True
        while grown:
            grown = False
            for edge in list(left):
                sides = edge.between
                if refs.keys().isdisjoint(sides) or not set(self.inside).issuperset(sides):
                    continue
                for name in sides:
                    if name not in refs:
                        refs[name] = self._added(PointRef(letter, name), name, at)
                labels = PointRef(letter, sides[0]), PointRef(letter, sides[1])
                direction = Direction("square", (edge.joint.pair.point, letter)) if edge.joint else edge.direction
                self._add(replace(edge, start=refs[sides[0]], end=refs[sides[1]], labels=labels, direction=direction))
                left.remove(edge)
                grown = True

    def _added(self, ref: PointRef, name: str, at: complex) -> PointRef:
        """A new point of a link, at a place on paper (mm), with bars to all points of the link."""
        others = [n for n in self.nodes if name in self.owners[n]]
        self.owners[ref], self.edges[ref] = [name], []
        self.nodes.append(ref)
        self.order[ref] = len(self.order)
        self.places = {**self.places, ref.point: at}
        for n in others:
            self._add_bar(ref, n, name)
        return ref


def _near(
    links: Mapping[str, PlacedLink], beside: list[tuple[str, str]], contacts: Sequence[HigherPair],
    around: Collection[str], letters: Sequence[str],
) -> dict[str, set[str]]:
    """For each link the letters of its nodes: its own, and those of links ``beside`` it, which slide on it or are
    turned on it by a driver, and of their neighbours."""
    on = {name: {p for p in letters if p in links[name].points} for name in around}
    for c in contacts:
        for side in c.bodies:
            on[side].add(c.name)
    for _ in range(2):
        shared = [(a, b, on[a] | on[b]) for a, b in beside]
        for a, b, both in shared:
            on[a], on[b] = on[a] | both, on[b] | both
    for a, b in beside * len(beside):
        if not on[a] & on[b]:  # far from any point: what slides there is looked at somewhere
            on[a], on[b] = on[a] | on[b], on[a] | on[b]
    return on


def contacts_of(structure: Structure, group: Dyad | LargerGroup) -> tuple[HigherPair, ...]:
    """The sliding contacts that a bar or a block of a group replaces."""
    return tuple(pair for pair in structure.scene.higher_pairs if pair.replaced and pair.block in group.members)


def past(pairs: Sequence[Pair], gone: Collection[str]) -> list[Pair]:
    """The pairs without removed links: turning pairs of the links that these joined at a point take their place."""
    around: dict[str, list[str]] = {}
    for pair in pairs:
        if pair.turns and (pair.a in gone or pair.b in gone):
            around.setdefault(pair.point, []).extend(n for n in (pair.a, pair.b) if n not in gone)
    joined = (Pair(point, *both) for point, names in around.items() for both in pairwise(dict.fromkeys(names)))
    return [*(p for p in pairs if p.a not in gone and p.b not in gone), *joined]


def links_alike(links: Iterable[str], pairs: Iterable[tuple[str, str, float]]) -> dict[str, set[str]]:
    """For each link all links with the same rotation up to given ones."""
    alike = {n: {n} for n in links}
    for a, b, _ in pairs:
        merged = alike.get(a, {a}) | alike.get(b, {b})
        for n in merged:
            alike[n] = merged
    return alike
