"""What holds the links of a scene: hinges, slides and drivers as equations between coordinates; which links are solved
together by them, in which order, and what they are: driven, a dyad of one of its kinds, or a larger group.

The matching and the strongly connected components are our own 80 lines: a graph of some ten nodes does not call for one
more dependency (networkx), or for scipy.sparse.csgraph, which takes longer to import than a mechanism to solve.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Literal, TypeVar

from graphkin.errors import Problem, Unsolvable
from graphkin.scene.cams import LawCam, SlidingFollower
from graphkin.scene.model import Driver, Mechanism, PlacedGuide, PlacedLink
from graphkin.structure.model import (
    Body,
    Driven,
    DrivenJoint,
    Dyad,
    DyadKind,
    Element,
    LargerGroup,
    Mobility,
    Pair,
    RollingRelation,
    driver_pair,
)
from graphkin.structure.replacement import replacing_link
from graphkin.structure.rolling import followers_of, meshes_of, relations_of, rolled_by
from graphkin.words import Phrase

__all__ = ["Constraints", "Node", "Unknown", "components", "element_of", "match"]


Node = tuple[str, str]  # ("link" | "point", name)
Unknown = tuple[Node, str]  # a node and one of its coordinates x, y, t


class Constraints:
    """The links, blocks, hinges and slides that take part, and their constraints."""

    def __init__(self, scene: Mechanism) -> None:
        self.scene = scene
        links: dict[str, PlacedLink] = {scene.frame.name: scene.frame}
        links.update({link.name: link for link in scene.links if not link.redundant})
        slides = [
            Pair(s.key, s.link, s.on, links[s.on].guides[s.guide], s.turn, s.pin)
            for s in scene.slidings
            if s.link in links and s.on in links
        ]
        for pin in scene.pins:
            if pin.of not in links or pin.on not in links:
                continue
            links[pin.key] = PlacedLink(pin.key, {pin.point: 0j}, (pin.point,), {"": PlacedGuide("", 0j, 1 + 0j)})
            slides.append(Pair(pin.key, pin.key, pin.on, links[pin.on].guides[pin.guide], 1 + 0j, pin.point, True))
        self.contacts = tuple(c for c in scene.contacts if {*c.links, c.carrier} - {""} <= links.keys())
        self.gears = tuple(g for g in scene.gears if {*g.wheels, g.carrier} <= links.keys())
        for contact in self.contacts:
            link, slide = replacing_link(contact, links)
            links[link.name] = link
            slides += [slide] if slide else []
        hinges: dict[str, list[str]] = {}
        for link in links.values():
            for point in link.points:
                hinges.setdefault(point, []).append(link.name)
        self.links: Mapping[str, PlacedLink] = links
        self.slides = tuple(slides)
        self.hinges = {p: tuple(names) for p, names in hinges.items() if len(names) > 1}
        self.cams: tuple[LawCam, ...] = tuple(
            cam for cam in scene.cams if scene.instead_of is None and {cam.link, cam.follower} <= links.keys()
        )
        relations = relations_of(scene, meshes_of(scene, self.contacts, self.gears, links))
        self.followers, self.relations = followers_of(scene, relations, links, self.slides)
        self.drivers: tuple[Driver, ...] = (*scene.drivers, *self.followers)
        self._place = {name: i for i, name in enumerate(links)}

    def place(self, node: Node) -> tuple[int, int, str]:
        """Order of nodes: links as in the file, then blocks, then points."""
        kind, name = node
        return (0, self._place[name], "") if kind == "link" else (1, 0, name)

    def nodes(self) -> list[Node]:
        moving = [name for name in self.links if name != self.scene.frame.name]
        return [("link", name) for name in moving] + [("point", name) for name in self.hinges]

    def mobility(self) -> Mobility:
        frame = self.scene.frame.name
        bars = {s.bar for s in self.scene.slots if not s.block and s.bar in self.links}  # instead of pins in slots
        real = [name for name in self.links if name in self.scene.by_name and name not in bars]
        shared = [sum(name in real for name in names) for names in self.hinges.values()]
        lower = sum(n - 1 for n in shared if n) + sum(not s.slot for s in self.slides)
        rolling = [c for c in self.contacts if c.rolling and not c.carrier]  # two constraints each, as a lower pair
        blocks = sum(s.slot for s in self.slides) - sum(c.flat for c in self.contacts)
        higher = blocks + len(bars) + len(self.contacts) - len(rolling) + len(self.gears) + len(self.cams)
        return Mobility(len([n for n in real if n != frame]), lower + len(rolling), higher)

    def equations(self) -> list[set[Unknown]]:
        """For each scalar constraint the coordinates in it."""
        rows: list[set[Unknown]] = []
        for point, names in self.hinges.items():
            for name in names:
                for axis in "xy":
                    rows.append({(("point", point), axis), *self._coordinates(name, axis + "t")})
        for s in self.slides:
            rows.append({*self._coordinates(s.a, "t"), *self._coordinates(s.b, "t")})
            rows.append({*self._coordinates(s.a, "xy"), *self._coordinates(s.b, "xyt")})
        for cam in self.cams:
            moved = "xy" if isinstance(cam.motion, SlidingFollower) else "t"
            rows.append({*self._coordinates(cam.link, "t"), *self._coordinates(cam.follower, moved)})
        for relation in self.relations:
            row: set[Unknown] = set()
            for kind, name in relation.terms:
                if kind == "angle":
                    row.update(self._coordinates(name, "t"))
                else:
                    s = next(s for s in self.slides if s.key == name)
                    row.update((*self._coordinates(s.a, "xy"), *self._coordinates(s.b, "xyt")))
            rows.append(row)
        for driver in self.drivers:
            driven, base = ("t", "t") if driver.turns else ("xy", "xyt")
            rows.append({*self._coordinates(driver.link, driven), *self._coordinates(driver.relative_to, base)})
        return rows

    def _coordinates(self, name: str, axes: str) -> Iterable[Unknown]:
        if name == self.scene.frame.name:
            return ()
        return [(("link", name), axis) for axis in axes]


# -- what is solved together -------------------------------------------------------------------------------------------

N = TypeVar("N", bound=Hashable)


def match(equations: Sequence[Sequence[N]]) -> dict[int, N]:
    """Assign to as many equations as possible one of their unknowns each (augmenting paths).

    Parameters
    ----------
    equations : for each equation its unknowns

    Returns
    -------
    dict from the index of an equation to the unknown it gives; equations left out cannot be served
    """
    given: dict[N, int] = {}
    held: dict[int, N] = {}
    for start in range(len(equations)):
        # breadth-first search for a free unknown, so that depth is no limit
        came_from: dict[N, int] = {}
        queue = [start]
        free: N | None = None
        while queue and free is None:
            equation = queue.pop(0)
            for unknown in equations[equation]:
                if unknown in came_from:
                    continue
                came_from[unknown] = equation
                if unknown not in given:
                    free = unknown
                    break
                queue.append(given[unknown])
        if free is None:
            continue
        step: N | None = free
        while step is not None:
            equation = came_from[step]
            given[step] = equation
            held[equation], step = step, held.get(equation)
    return {equation: unknown for unknown, equation in given.items()}


def components(needs: Mapping[N, Sequence[N]]) -> list[tuple[N, ...]]:
    """Strongly connected components, each after those it needs (Tarjan 1972, without recursion).

    Parameters
    ----------
    needs : for each node the nodes it needs
    """
    index: dict[N, int] = {}
    low: dict[N, int] = {}
    stack: list[N] = []
    on_stack: set[N] = set()
    found: list[tuple[N, ...]] = []
    for root in needs:
        if root in index:
            continue
        work: list[tuple[N, int]] = [(root, 0)]
        while work:
            node, place = work.pop()
            if node not in index:
                index[node] = low[node] = len(index)
                stack.append(node)
                on_stack.add(node)
            children = needs[node]
            while place < len(children) and children[place] in index:
                if children[place] in on_stack:
                    low[node] = min(low[node], index[children[place]])
                place += 1
            if place < len(children):
                work.append((node, place))
                work.append((children[place], 0))
                continue
            if low[node] == index[node]:
                members: list[N] = []
                while True:
                    member = stack.pop()
                    on_stack.discard(member)
                    members.append(member)
                    if member == node:
                        break
                found.append(tuple(members))
            if work:
                parent = work[-1][0]
                low[parent] = min(low[parent], low[node])
    return found


_KINDS: Mapping[str, tuple[DyadKind, Literal["as found", "the other", "as written", "what slides"]]] = {
    "RRR": ("RRR", "as written"), "PRP": ("PRP", "as written"), "RPR": ("RPR", "what slides"),
    "RRP": ("RRP", "as found"), "PRR": ("RRP", "the other"), "RPP": ("RPP", "as found"), "PPR": ("RPP", "the other"),
}  # fmt: skip
"""Of three pairs in their order the kind of dyad, and which of its bodies is called the first."""


def element_of(system: Constraints, members: list[str], known: set[str]) -> Element:
    scene = system.scene
    inside = set(members)
    drivers = [d for d in system.drivers if inside & {*d.links} and {*d.links} <= inside | known]
    pairs = _pairs(system, members, known)
    for cam in system.cams:
        if members == [cam.follower] and cam.link in known and len(pairs) == 1 and not drivers:
            return Driven(cam.follower, pairs[0], cam)
        if cam.follower in inside or (cam.link in inside and cam.follower in known):
            raise Unsolvable("mobility", Problem(
                f"cams.{cam.link}", Phrase("link is not moved by the cam alone", follower=cam.follower),
                Phrase("drive cam what else moves hangs on the", link=cam.link)))  # fmt: skip
    rolling = tuple(r for r in system.relations if _touches(system, r, inside, known))
    real = tuple(m for m in members if m in scene.by_name)
    if rolling:
        if len(members) == 1 and len(pairs) == 1 and not drivers:
            rolled = rolled_by(scene, rolling[0], members[0], pairs[0])
            if rolled is not None:
                return Driven(members[0], pairs[0], rolled)
        order = 2 if _rolls_like_a_dyad(members, pairs, drivers, rolling) else _order(members, pairs)
        return LargerGroup(tuple(members), tuple(pairs), tuple(drivers), real, order, rolling=rolling)
    if len(members) == 1 and len(pairs) == 1 and len(drivers) == 1:
        return Driven(members[0], pairs[0], drivers[0])
    bodies, loose = _bodies(system, members, drivers)
    dyad = _dyad(system, bodies, pairs, real) if not loose else None
    return dyad or LargerGroup(tuple(members), tuple(pairs), tuple(drivers), real, _order(members, pairs))


def _touches(system: Constraints, relation: RollingRelation, inside: set[str], known: set[str]) -> bool:
    """Whether a relation holds members of a group, all else in it being known."""
    frame = system.scene.frame.name
    within = {n for n in relation.links if n != frame}
    for kind, name in relation.terms:
        if kind == "travel":
            s = next(s for s in system.slides if s.key == name)
            within |= {s.a, s.b} - {frame}
    return bool(within & inside) and within <= inside | known


def _pairs(system: Constraints, members: list[str], known: set[str]) -> list[Pair]:
    """All pairs that hold the members: to known links, or among themselves."""
    found: list[Pair] = []
    for point, names in system.hinges.items():
        mine = [n for n in names if n in members]
        base = [n for n in names if n in known]
        mine.sort(key=lambda n: system.place(("link", n)))
        if base:
            found += [Pair(point, n, base[0]) for n in mine]
        else:
            found += [Pair(point, b, a) for a, b in pairwise(mine)]
    inside = set(members)
    found += [s for s in system.slides if {s.a, s.b} & inside and {s.a, s.b} <= inside | known]
    return found


def _bodies(system: Constraints, members: list[str], drivers: list[Driver]) -> tuple[list[Body], list[Driver]]:
    """Links of the group that drivers hold together, and the drivers that act at no pair inside it."""
    joints: list[DrivenJoint] = []
    loose: list[Driver] = []
    for driver in drivers:
        pair = driver_pair(driver, system.links, system.slides)
        if pair is None or not {pair.a, pair.b} <= set(members):
            loose.append(driver)
        else:
            joints.append(DrivenJoint(pair, driver, pair.b, pair.a))
    bodies: list[Body] = []
    left = list(members)
    while left:
        names, used = [left.pop(0)], []
        grown = True
        while grown:
            grown = False
            for w in joints:
                if w in used or {w.a, w.b} <= set(names):
                    continue
                if w.a in names:
                    used.append(w)
                elif w.b in names:
                    used.append(DrivenJoint(w.pair, w.driver, w.b, w.a, -1))
                else:
                    continue
                names.append(used[-1].b)
                left.remove(used[-1].b)
                grown = True
                break
        bodies.append(Body(tuple(names), tuple(used)))
    return bodies, loose


def _dyad(system: Constraints, bodies: list[Body], pairs: list[Pair], links: tuple[str, ...]) -> Dyad | None:
    if len(bodies) != 2:
        return None
    one, two = bodies
    inner: list[Pair] = []
    outer: dict[int, list[Pair]] = {0: [], 1: []}
    hinged: set[tuple[str, int]] = set()
    for pair in pairs:
        sides = [i for i, body in enumerate(bodies) if pair.a in body.links or pair.b in body.links]
        if pair.turns:
            # links held together by a driver at this very point hang on it once
            if (pair.point, sum(1 << i for i in sides)) in hinged:
                continue
            hinged.add((pair.point, sum(1 << i for i in sides)))
        if len(sides) == 2:
            inner.append(pair)
        elif not (pair.a in bodies[sides[0]].links and pair.b in bodies[sides[0]].links):
            outer[sides[0]].append(pair)
    if len(inner) != 1 or len(outer[0]) != 1 or len(outer[1]) != 1:
        return None
    middle, first, second = inner[0], outer[0][0], outer[1][0]
    known = _KINDS.get(first.letter + middle.letter + second.letter)
    if known is None:
        return None
    kind, begins = known

    def written(pair: Pair, body: Body) -> tuple[int, int, str]:
        return system.place(("link", pair.a if pair.a in body.links else pair.b))

    swap = {
        "as found": False,
        "the other": True,
        "as written": written(second, two) < written(first, one),
        "what slides": middle.a in two.links,
    }[begins]
    if swap:
        one, two, first, second = two, one, second, first
    return Dyad(kind, one, two, middle, first, second, links)


def _rolls_like_a_dyad(
    members: Sequence[str], pairs: Sequence[Pair], drivers: Sequence[Driver], rolling: Sequence[RollingRelation]
) -> bool:
    """Whether for velocities a group is two links with three joints, one of them where it rolls, as if hinged there: a
    link that only carries a wheel follows it, links that a driver joins are one."""
    carriers = {carrier for relation in rolling for carrier in relation.links[2:]}
    bodies = sum(name not in carriers for name in members)
    joints = sum(not carriers & {pair.a, pair.b} for pair in pairs) + len(rolling)
    return (bodies, joints) == (2 + len(drivers), 3 + len(drivers))


def _order(members: list[str], pairs: list[Pair]) -> int:
    """Class of a group after Assur and Artobolevsky: the most pairs on a link of it (three or more), or the most
    links in a shortest closed contour of it (four or more)."""
    most = max(sum(name in (p.a, p.b) for p in pairs) for name in members)
    edges = [(p.a, p.b) for p in pairs if p.a in members and p.b in members]
    contour = 0
    for i, (a, b) in enumerate(edges):
        reach, front, steps = {a}, [a], 1
        while front and b not in reach:
            front = [y for x in front for j, e in enumerate(edges) if j != i and x in e for y in e if y not in reach]
            reach.update(front)
            steps += 1
        if b in reach:
            contour = max(contour, steps)
    return max(3, most, contour if contour >= 4 else 0)
