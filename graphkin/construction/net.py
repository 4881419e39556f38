"""Points of links as nodes, their relative motions as edges: vector equations are chains of them; and which can be
drawn next.

A node is a point of a link (`PointRef`; coincident points are nodes of their own).  An edge leads from one node to
another and stands for the velocity of the second relative to the first: square to the bar between them where both are
points of one link, along the guide where they coincide on both sides of a sliding pair.  A chain from one known node to
another gives a vector equation; it can be drawn when two sizes are unknown.

Groups with sliding contacts are drawn at the contacts themselves too, as a second way beside what replaces them.  Where
two outlines touch, the velocities of the material points of both bodies differ along the tangent only: v_K2 is v_K1 and
the slip.  In acceleration the term of Coriolis comes to it, and along the normal one that the curvatures of both
outlines give: the contact wanders along them at rates s1' and s2', where s1' - s2' is the slip and s1'/rho1 - s2'/rho2
the relative rate of turning, and its acceleration is the same seen from either body.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from itertools import pairwise

from graphkin.construction.steps import Direction
from graphkin.scene.model import PlacedContact, PlacedLink
from graphkin.scene.symbol import PointRef
from graphkin.structure import DrivenJoint, Dyad, LargerGroup, Pair, Structure

__all__ = [
    "ClosingVector", "Edge", "Joined", "Net", "ParallelLegs", "Path", "RollingPoint", "Sliding", "Turning",
    "TwoUnknowns", "Unknown", "contacts_of", "equation_of", "joined_at_contacts", "node", "split",
]  # fmt: skip


@dataclass(frozen=True)
class Turning:
    """The unknown angular rate of a link, and of all that turn with it."""

    name: str


@dataclass(frozen=True)
class Sliding:
    """The unknown speed along a sliding pair."""

    name: str


@dataclass(frozen=True)
class Slipping:
    """The unknown slip at a contact."""

    name: str


Unknown = Turning | Sliding | Slipping


@dataclass(frozen=True)
class Edge:
    """The motion of ``end`` relative to ``start``.

    ``link`` is the rigid link between them, or ``slide`` the sliding pair they belong to, or ``joint`` the driven
    turning pair, or ``contact`` the sliding contact, or ``rolling`` what rolls without slip; or they lie at the special
    point of two links (``tied``), which legs join; or on two links of one contour, of which one is ``held`` still.
    ``unknown`` is what is not known of it, if anything.  ``labels`` are the nodes as
    written, coincident points with their links.
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
    tied: bool = False
    held: str = ""
    forward: bool = True
    unknown: Unknown | None = None

    @property
    def bar(self) -> tuple[str, str]:
        """The letters of both ends."""
        return self.start.point, self.end.point

    def reversed(self) -> Edge:
        return replace(self, start=self.end, end=self.start, labels=self.labels[::-1], forward=not self.forward)


Path = tuple[Edge, ...]


@dataclass(frozen=True)
class TwoUnknowns:
    """An equation with two unknown sizes: two ways to the node ``end``, each from a known node and with one of them."""

    end: PointRef
    left: Path
    right: Path

    @property
    def sides(self) -> tuple[Path, Path]:
        return self.left, self.right


@dataclass(frozen=True)
class ClosingVector:
    """An equation with one unknown size, what is left of a way between two nodes known already; or with none."""

    path: Path

    @property
    def end(self) -> PointRef:
        return self.path[-1].end

    @property
    def sides(self) -> tuple[Path]:
        return (self.path,)


@dataclass(frozen=True)
class ParallelLegs:
    """Two parallel legs of a link, their special point at infinity: the way from one to the other gives its rate."""

    link: str
    path: Path

    @property
    def end(self) -> PointRef:
        return self.path[-1].end

    @property
    def sides(self) -> tuple[Path]:
        return (self.path,)


@dataclass(frozen=True)
class RollingPoint:
    """Where two links roll on each other: the name of the contact or the wheels, the letter of the point."""

    name: str
    letter: str
    links: tuple[str, str]


def node(links: Mapping[str, PlacedLink], point: str, link: str) -> PointRef:
    """The node of a point on a link: the pin itself if it is one of the link's own points."""
    return PointRef(point) if point in links[link].points else PointRef(point, link)


@dataclass(frozen=True)
class Joined:
    """Links of a group, all pairs that hold them, what drivers hold together among them, and the sliding contacts that
    nothing replaces.

    ``near`` keeps of the points that lie under each other on two links those next to a point of either, as larger
    groups need: all of them would be too many.  ``rolling`` are the points where links of a group roll; ``contours`` a
    held link with each other of its contour.  With ``wide`` a special point of one link lies under it on all that turn
    with it, too.
    """

    inside: Sequence[str]
    pairs: Sequence[Pair]
    joints: Sequence[DrivenJoint]
    driven: frozenset[str] = frozenset()  # sliding pairs of which a driver gives the motion
    near: bool = False
    contacts: tuple[PlacedContact, ...] = ()
    rolling: Sequence[RollingPoint] = ()
    contours: Sequence[tuple[str, str]] = ()
    wide: bool = False


class Net:
    """Nodes and edges around a group."""

    def __init__(
        self,
        links: Mapping[str, PlacedLink],
        frame: str,
        joined: Joined,
        places: Mapping[str, complex],
        guide_names: Mapping[str, tuple[str, ...]],
        same_turn: Mapping[str, str],
        tiny: float,
    ) -> None:
        self.links, self.frame, self.places, self.tiny = links, frame, places, tiny
        self.inside, pairs, joints = joined.inside, joined.pairs, joined.joints
        self.shares = same_turn
        slides = [p for p in pairs if not p.turns]
        turns = [p for p in pairs if p.turns]
        driven = {w.pair.key for w in joints if not w.pair.turns} | joined.driven
        touching = [c.name for c in joined.contacts]
        letters = list(dict.fromkeys([s.pin for s in slides if s.pin] + [t.point for t in turns] + touching))
        self.natural = {node(links, t.point, t.a) for t in turns}
        self.natural |= {node(links, s.pin, side) for s in slides if s.pin for side in (s.a, s.b)}
        self.natural |= {PointRef(c.name, side) for c in joined.contacts for side in c.links}
        between = [*((p.a, p.b) for p in pairs), *((w.a, w.b) for w in joints), *(c.links for c in joined.contacts)]
        around = list(dict.fromkeys([*self.inside, *(n for both in between for n in both)]))
        on = _near(links, joined, around, letters) if joined.near else {}
        self.owners: dict[PointRef, list[str]] = {}
        for name in around:
            block = "/" in name
            for letter in letters:
                if letter in links[name].points or (not block and (not joined.near or letter in on[name])):
                    self.owners.setdefault(node(links, letter, name), []).append(name)
        for one in joined.rolling:
            ends = [PointRef(one.letter, link) for link in one.links]
            self.natural.update(ends)
            for ref in ends:
                self.owners[ref] = [ref.link]
        self.nodes = list(self.owners)
        self.order = {n: i for i, n in enumerate(self.nodes)}
        self.edges: dict[PointRef, list[Edge]] = {n: [] for n in self.nodes}
        for name in self.inside:
            self._rigid(name, same_turn.get(name, name))
        for s in slides:
            self._sliding(s, letters, guide_names[s.key], None if s.key in driven else Sliding(s.key))
        for w in joints:
            if w.pair.turns:
                self._driven(w, letters)
        for c in joined.contacts:
            self._touching(c)
        for one in joined.rolling:
            a, b = (PointRef(one.letter, link) for link in one.links)
            self._add(Edge(a, b, (a, b), Direction("along", ("n-n",)), rolling=one.name))
        for held, other in joined.contours:
            self._seen(held, other, letters)
        self.under: list[Edge] = []  # for links that turn alike one edge between coincident points of theirs
        if joined.wide:
            found = {(e.slide or e.joint or e.held, *self._sides(e)): e for n in self.nodes for e in self.edges[n]
                     if e.forward and (e.slide or e.joint or e.held) and "/" not in "".join(self._sides(e))}
            self.under = list(found.values())

    def copy(self) -> Net:
        """The same net, to which special points may be added."""
        made = copy(self)
        made.owners, made.nodes, made.order = dict(self.owners), list(self.nodes), dict(self.order)
        made.edges = {n: list(edges) for n, edges in self.edges.items()}
        return made

    def fixed(self, n: PointRef) -> bool:
        return self.frame in self.owners[n]

    def known(self, n: PointRef) -> bool:
        return any(name not in self.inside for name in self.owners[n])

    def _add(self, edge: Edge) -> None:
        self.edges[edge.start].append(edge)
        self.edges[edge.end].append(edge.reversed())

    def _rigid(self, name: str, shares: str) -> None:
        mine = [n for n in self.nodes if name in self.owners[n]]
        unknown = Turning(shares) if shares in self.inside else None
        for i, a in enumerate(mine):
            for b in mine[i + 1 :]:
                if abs(self.places[a.point] - self.places[b.point]) > self.tiny:
                    way = Direction("square", (a.point, b.point))
                    self._add(Edge(a, b, (a, b), way, link=name, unknown=unknown))

    def _sliding(self, s: Pair, letters: Sequence[str], written: tuple[str, ...], unknown: Unknown | None) -> None:
        for letter in letters:
            a, b = node(self.links, letter, s.a), node(self.links, letter, s.b)
            if a in self.owners and b in self.owners and a != b:
                labels = (PointRef(letter, s.b), PointRef(letter, s.a))
                self._add(Edge(b, a, labels, Direction("along", written), slide=s, unknown=unknown))

    def _driven(self, w: DrivenJoint, letters: Sequence[str]) -> None:
        for letter in letters:
            a, b = node(self.links, letter, w.a), node(self.links, letter, w.b)
            if a in self.owners and b in self.owners and a != b:
                labels = (PointRef(letter, w.a), PointRef(letter, w.b))
                hinge = w.pair.point
                self._add(Edge(a, b, labels, Direction("square", (hinge, letter)), joint=w))

    def _seen(self, held: str, other: str, letters: Sequence[str]) -> None:
        for letter in letters:
            a, b = node(self.links, letter, held), node(self.links, letter, other)
            if a in self.owners and b in self.owners and a != b:
                labels = (PointRef(letter, held), PointRef(letter, other))
                self._add(Edge(a, b, labels, Direction("found", ()), held=held))

    def _touching(self, contact: PlacedContact) -> None:
        # against the frame where it can be: its point stands in the pole
        sides = sorted(contact.links, key=lambda link: link != self.frame)
        a, b = (PointRef(contact.name, link) for link in sides)
        way = Direction("along", ("t-t",))
        self._add(Edge(a, b, (a, b), way, contact=contact.name, unknown=Slipping(contact.name)))

    def _sides(self, edge: Edge) -> tuple[str, str]:
        """The links of an edge between coincident points, as it was added."""
        return edge.labels[0].link, edge.labels[1].link

    def add(self, name: str, letter: str, at: complex) -> PointRef:
        """One more point of a link, such as a special point."""
        ref = self._added(PointRef(letter), name, at)
        self._carry_over({name: ref}, at)
        return ref

    def tie(self, names: tuple[str, str], letter: str, at: complex) -> None:
        """The special point of two links: a point of each, of which the relative motion is found first."""
        one, two = (self._added(PointRef(letter, name), name, at) for name in names)
        self._add(Edge(one, two, (one, two), Direction("found", ()), tied=True))
        self._carry_over({names[0]: one, names[1]: two}, at)

    def _carry_over(self, refs: dict[str, PointRef], at: complex) -> None:
        """A special point also on the links that turn with those that have it."""
        letter = next(iter(refs.values())).point
        left, grown = list(self.under), True
        while grown:
            grown = False
            for edge in list(left):
                sides = self._sides(edge)
                if not any(name in refs for name in sides) or not all(name in self.inside for name in sides):
                    continue
                for name in sides:
                    if name not in refs:
                        refs[name] = self._added(PointRef(letter, name), name, at)
                labels = PointRef(letter, sides[0]), PointRef(letter, sides[1])
                way = edge.direction
                if edge.joint is not None:
                    way = Direction("square", (edge.joint.pair.point, letter))
                self._add(replace(edge, start=refs[sides[0]], end=refs[sides[1]], labels=labels, direction=way))
                left.remove(edge)
                grown = True

    def _added(self, ref: PointRef, name: str, at: complex) -> PointRef:
        shares = self.shares.get(name, name)
        unknown = Turning(shares) if shares in self.inside else None
        others = [n for n in self.nodes if name in self.owners[n]]
        self.owners[ref], self.edges[ref] = [name], []
        self.nodes.append(ref)
        self.order[ref] = len(self.order)
        self.places = {**self.places, ref.point: at}
        for n in others:
            if abs(self.places[n.point] - at) > self.tiny:
                way = Direction("square", (ref.point, n.point))
                self._add(Edge(ref, n, (ref, n), way, link=name, unknown=unknown))
        return ref

    def paths(self, start: PointRef) -> Iterator[tuple[Edge, ...]]:
        """All paths from a known node through unknown ones to another known node, with two unknowns."""
        stack: list[tuple[PointRef, tuple[Edge, ...]]] = [(start, ())]
        while stack:
            at, path = stack.pop()
            if path and self.known(at):
                if sum(bool(e.unknown) for e in path) == 2:
                    yield path
                continue
            if len(path) == 5:
                continue
            # a chain may come back to where it began: a pin that both guides of a group belong to
            visited = {e.end for e in path}
            for edge in reversed(self.edges[at]):
                if edge.end in visited or sum(bool(e.unknown) for e in (*path, edge)) > 2:
                    continue
                stack.append((edge.end, (*path, edge)))


def _near(
    links: Mapping[str, PlacedLink], joined: Joined, around: Sequence[str], letters: Sequence[str]
) -> dict[str, set[str]]:
    """For each link the letters at which it is looked at: its own, and those of links that slide on it or that a driver
    turns on it, and of those next to them."""
    on = {name: {p for p in letters if p in links[name].points} for name in around}
    for c in joined.contacts:
        for side in c.links:
            on[side].add(c.name)
    touching = [(p.a, p.b) for p in joined.pairs if not p.turns] + [(w.a, w.b) for w in joined.joints]
    touching += joined.contours
    for _ in range(2):
        shared = [(a, b, on[a] | on[b]) for a, b in touching]
        for a, b, both in shared:
            on[a], on[b] = on[a] | both, on[b] | both
    for a, b in touching * len(touching):
        if not on[a] & on[b]:  # far from any point: what slides there is looked at somewhere
            on[a], on[b] = on[a] | on[b], on[a] | on[b]
    return on


def equation_of(net: Net, drawn: Collection[PointRef]) -> TwoUnknowns | None:
    """Find the shortest equation with two unknown sizes of a dyad's links and all pairs that hold them.

    Parameters
    ----------
    drawn : nodes that stand in the polygon already (preferred as starting points)
    """
    best: tuple[tuple[float, ...], TwoUnknowns] | None = None
    for start in (n for n in net.nodes if net.known(n)):
        for path in net.paths(start):
            first, second = (i for i, e in enumerate(path) if e.unknown)
            if path[first].unknown == path[second].unknown:
                continue
            ends = (path[0].start, path[-1].end)
            strangers = {n for e in path for n in (e.start, e.end)} - net.natural
            cost = (
                len(path) + 0.6 * len(strangers) + 0.1 * sum(n not in drawn for n in ends),
                float(net.fixed(start)),
                float(net.order[start]),
            )
            if best is None or cost < best[0]:
                best = cost, split(path, second)
    return best[1] if best else None


def split(path: Path, at: int) -> TwoUnknowns:
    """A path with two unknowns split at the node before the second of them, the edge of that number."""
    return TwoUnknowns(path[at].start, tuple(e.reversed() for e in reversed(path[at:])), path[:at])


def contacts_of(structure: Structure, group: Dyad | LargerGroup) -> tuple[PlacedContact, ...]:
    """The sliding contacts that a bar or a block of a group stands for."""
    members = group.members
    return tuple(c for c in structure.scene.contacts if not c.rolling and c.block in members)


def joined_at_contacts(group: Joined, contacts: Sequence[PlacedContact]) -> Joined:
    """The links of a group and its pairs, contacts among them instead of what replaces them."""
    gone = {c.block for c in contacts}
    pairs: list[Pair] = [p for p in group.pairs if not gone & {p.a, p.b}]
    pairs += _past(group.pairs, gone)
    inside = [name for name in group.inside if name not in gone]
    return replace(group, inside=inside, pairs=pairs, contacts=tuple(contacts))


def _past(pairs: Sequence[Pair], gone: Collection[str]) -> Iterator[Pair]:
    """Turning pairs of links that only what is gone joins at a point."""
    around: dict[str, list[str]] = {}
    for pair in pairs:
        if pair.turns and (pair.a in gone or pair.b in gone):
            around.setdefault(pair.point, []).extend(n for n in (pair.a, pair.b) if n not in gone)
    for point, names in around.items():
        for one, two in pairwise(dict.fromkeys(names)):
            yield Pair(point, one, two)
