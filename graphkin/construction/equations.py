"""Vector equations as chains of points, and which of them can be drawn next.

A node is a point of a link (`PointRef`; coincident points are nodes of their own).  An edge leads from one node to
another and stands for the velocity of the second relative to the first: square to the bar between them where both are
points of one link, along the guide where they coincide on both sides of a sliding pair.  A chain from one known node
to another gives a vector equation; it can be drawn when two sizes are unknown.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from graphkin.construction.steps import Direction
from graphkin.scene.model import PlacedLink
from graphkin.scene.symbol import PointRef
from graphkin.structure import Dyad, Pair, Slide, Turn, Weld

__all__ = ["Chain", "Edge", "equation_of", "node"]


@dataclass(frozen=True)
class Edge:
    """The motion of ``end`` relative to ``start``.

    ``link`` is the rigid link between them, or ``slide`` the sliding pair they belong to, or ``weld`` the driven
    turning pair.  ``unknown`` names what is not known of it ("omega 3", "slide 2/3"); "" if nothing.  ``labels`` are
    the nodes as written, coincident points with their links.
    """

    start: PointRef
    end: PointRef
    labels: tuple[PointRef, PointRef]
    direction: Direction
    link: str = ""
    slide: Slide | None = None
    weld: Weld | None = None
    forward: bool = True
    unknown: str = ""

    def reversed(self) -> Edge:
        return replace(self, start=self.end, end=self.start, labels=self.labels[::-1], forward=not self.forward)


@dataclass(frozen=True)
class Chain:
    """An equation: two ways to the node ``middle``, each from a known node and with one unknown."""

    middle: PointRef
    left: tuple[Edge, ...]
    right: tuple[Edge, ...]


def node(links: Mapping[str, PlacedLink], point: str, link: str) -> PointRef:
    """The node of a point on a link: the pin itself if it is one of the link's own points."""
    return PointRef(point) if point in links[link].points else PointRef(point, link)


def equation_of(
    links: Mapping[str, PlacedLink],
    frame: str,
    dyad: Dyad,
    places: Mapping[str, complex],
    guide_names: Mapping[str, tuple[str, ...]],
    drawn: Mapping[PointRef, complex],
    same_turn: Mapping[str, str],
    tiny: float,
) -> Chain | None:
    """Find the shortest equation of a dyad with two unknown sizes.

    Parameters
    ----------
    places : where each letter lies on paper (mm)
    guide_names : how the direction of each sliding pair is written, by its key
    drawn : nodes that stand in the polygon already (preferred as starting points)
    same_turn : for each link of the group the one link whose angular velocity it shares
    tiny : points nearer to each other than this (mm) give no direction
    """
    net = _Net(links, frame, dyad, places, guide_names, same_turn, tiny)
    known = [n for n in net.nodes if net.known(n)]
    best: tuple[tuple[float, ...], Chain] | None = None
    for start in known:
        for path in net.paths(start):
            chain = _as_chain(path, frame, links)
            if chain is None:
                continue
            ends = (path[0].start, path[-1].end)
            strangers = {n for e in path for n in (e.start, e.end)} - net.natural
            cost = (
                len(path) + 0.6 * len(strangers) + 0.1 * sum(n not in drawn for n in ends),
                float(net.fixed(path[0].start)),
                float(net.order[path[0].start]),
            )
            if best is None or cost < best[0]:
                best = (cost, chain)
    return best[1] if best else None


def _as_chain(path: Sequence[Edge], frame: str, links: Mapping[str, PlacedLink]) -> Chain | None:
    """Split a path with two unknowns at the node before the second."""
    places = [i for i, e in enumerate(path) if e.unknown]
    if len(places) != 2 or path[places[0]].unknown == path[places[1]].unknown:
        return None
    cut = places[1]
    right = tuple(path[:cut])
    left = tuple(e.reversed() for e in reversed(path[cut:]))
    return Chain(right[-1].end, left, right)


class _Net:
    """Nodes and edges around a dyad."""

    def __init__(
        self,
        links: Mapping[str, PlacedLink],
        frame: str,
        dyad: Dyad,
        places: Mapping[str, complex],
        guide_names: Mapping[str, tuple[str, ...]],
        same_turn: Mapping[str, str],
        tiny: float,
    ) -> None:
        self.links, self.frame, self.places, self.tiny = links, frame, places, tiny
        self.inside = [name for body in dyad.bodies for name in body.links]
        welds = [w for body in dyad.bodies for w in body.welds]
        pairs: list[Pair] = [dyad.outer_first, dyad.inner, dyad.outer_second, *(w.pair for w in welds)]
        slides = [p for p in pairs if isinstance(p, Slide)]
        turns = [p for p in pairs if isinstance(p, Turn)]
        driven = {w.pair.key for w in welds if isinstance(w.pair, Slide)}
        letters = list(dict.fromkeys([s.pin for s in slides if s.pin] + [t.point for t in turns]))
        self.natural = {node(links, t.point, t.a) for t in turns}
        self.natural |= {node(links, s.pin, side) for s in slides if s.pin for side in (s.a, s.b)}
        around = list(dict.fromkeys([*self.inside, *(n for p in pairs for n in (p.a, p.b))]))
        self.owners: dict[PointRef, list[str]] = {}
        for name in around:
            block = "/" in name
            for letter in letters:
                if letter in links[name].points or not block:
                    self.owners.setdefault(node(links, letter, name), []).append(name)
        self.nodes = list(self.owners)
        self.order = {n: i for i, n in enumerate(self.nodes)}
        self.edges: dict[PointRef, list[Edge]] = {n: [] for n in self.nodes}
        for name in self.inside:
            self._rigid(name, same_turn.get(name, name))
        for s in slides:
            self._sliding(s, letters, guide_names[s.key], "" if s.key in driven else f"slide {s.key}")
        for w in welds:
            if isinstance(w.pair, Turn):
                self._welded(w, letters)

    def fixed(self, n: PointRef) -> bool:
        return self.frame in self.owners[n]

    def known(self, n: PointRef) -> bool:
        return any(name not in self.inside for name in self.owners[n])

    def _add(self, edge: Edge) -> None:
        self.edges[edge.start].append(edge)
        self.edges[edge.end].append(edge.reversed())

    def _rigid(self, name: str, shares: str) -> None:
        mine = [n for n in self.nodes if name in self.owners[n]]
        unknown = f"omega {shares}" if shares in self.inside else ""
        for i, a in enumerate(mine):
            for b in mine[i + 1 :]:
                if abs(self.places[a.point] - self.places[b.point]) > self.tiny:
                    way = Direction("square", (a.point, b.point))
                    self._add(Edge(a, b, (a, b), way, link=name, unknown=unknown))

    def _sliding(self, s: Slide, letters: Sequence[str], written: tuple[str, ...], unknown: str) -> None:
        for letter in letters:
            a, b = node(self.links, letter, s.a), node(self.links, letter, s.b)
            if a in self.owners and b in self.owners and a != b:
                labels = (PointRef(letter, s.b), PointRef(letter, s.a))
                self._add(Edge(b, a, labels, Direction("along", written), slide=s, unknown=unknown))

    def _welded(self, w: Weld, letters: Sequence[str]) -> None:
        for letter in letters:
            a, b = node(self.links, letter, w.a), node(self.links, letter, w.b)
            if a in self.owners and b in self.owners and a != b:
                labels = (PointRef(letter, w.a), PointRef(letter, w.b))
                hinge = w.pair.point  # type: ignore[union-attr]
                self._add(Edge(a, b, labels, Direction("square", (hinge, letter)), weld=w))

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
