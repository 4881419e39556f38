"""From a scene to the elements in the order of solution."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import pairwise

from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import AngleDriver, Driver, Guide, Link, Scene
from graphkin.structure.graph import components, match
from graphkin.structure.model import (
    Body,
    Cluster,
    Driven,
    Dyad,
    Element,
    Mobility,
    Pair,
    Slide,
    Structure,
    Turn,
    Weld,
    driver_pair,
)

__all__ = ["analyse", "mobility_of"]

Node = tuple[str, str]  # ("link" | "point", name)
Unknown = tuple[Node, str]  # a node and one of its coordinates x, y, t

_KINDS = {"RRR": "RRR", "RRP": "RRP", "PRR": "RRP", "RPR": "RPR", "PRP": "PRP", "RPP": "RPP", "PPR": "RPP"}


def analyse(scene: Scene) -> Structure:
    """Find the mobility and the order of solution.

    Each constraint is assigned one coordinate that it gives (a perfect matching exists just when every part of the
    mechanism has as many constraints as coordinates); the strongly connected components of what needs what are then
    the Assur groups, in the order of solution.

    Raises
    ------
    Unsolvable
        status "mobility": the number of drivers is not the mobility, or a part of the mechanism is held too much
        while another is free.
    """
    parts = _Parts(scene)
    mobility = parts.mobility()
    if mobility.value != len(scene.drivers):
        raise Unsolvable("mobility", _wrong_count(scene, mobility, parts))
    equations = parts.equations()
    unknowns = [sorted(e) for e in equations]
    given = match(unknowns)
    if len(given) < len(equations):
        raise Unsolvable("mobility", _wrong_part(parts, unknowns, given))
    needs: dict[Node, list[Node]] = {node: [] for node in parts.nodes()}
    for i, (node, _) in given.items():
        others = sorted({n for n, _ in unknowns[i]} - {node}, key=parts.place)
        needs[node] += [n for n in others if n not in needs[node]]
    elements: list[Element] = []
    known = {scene.frame.name}
    for component in components(needs):
        members = [name for kind, name in component if kind == "link"]
        if not members:
            continue
        members.sort(key=lambda name: parts.place(("link", name)))
        elements.append(_element(parts, members, known))
        known.update(members)
    return Structure(scene, parts.links, parts.slides, parts.hinges, mobility, tuple(elements))


def mobility_of(scene: Scene) -> Mobility:
    """Links, pairs and F of a scene, whatever its drivers are."""
    return _Parts(scene).mobility()


class _Parts:
    """The links, blocks, hinges and slides that take part, and their constraints."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        links: dict[str, Link] = {scene.frame.name: scene.frame}
        links.update({link.name: link for link in scene.links if not link.redundant})
        slides = [
            Slide(s.key, s.link, s.on, links[s.on].guides[s.guide], s.turn, s.pin)
            for s in scene.slidings
            if s.link in links and s.on in links
        ]
        for pin in scene.pins:
            if pin.of not in links or pin.on not in links:
                continue
            links[pin.key] = Link(pin.key, {pin.point: 0j}, (pin.point,), {"": Guide("", 0j, 1 + 0j)})
            slides.append(Slide(pin.key, pin.key, pin.on, links[pin.on].guides[pin.guide], 1 + 0j, pin.point, True))
        hinges: dict[str, list[str]] = {}
        for link in links.values():
            for point in link.points:
                hinges.setdefault(point, []).append(link.name)
        self.links: Mapping[str, Link] = links
        self.slides = tuple(slides)
        self.hinges = {p: tuple(names) for p, names in hinges.items() if len(names) > 1}
        self._place = {name: i for i, name in enumerate(links)}

    def place(self, node: Node) -> tuple[int, int, str]:
        """Order of nodes: links as in the file, then blocks, then points."""
        kind, name = node
        return (0, self._place[name], "") if kind == "link" else (1, 0, name)

    def nodes(self) -> list[Node]:
        moving = [name for name in self.links if name != self.scene.frame.name]
        return [("link", name) for name in moving] + [("point", name) for name in self.hinges]

    def mobility(self) -> Mobility:
        blocks = {s.key for s in self.slides if s.slot}
        real = [name for name in self.links if name not in blocks and name != self.scene.frame.name]
        lower = sum(len([n for n in names if n not in blocks]) - 1 for names in self.hinges.values())
        return Mobility(len(real), lower + len(self.slides) - len(blocks), len(blocks))

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
        for driver in self.scene.drivers:
            if isinstance(driver, AngleDriver):
                rows.append({*self._coordinates(driver.link, "t"), *self._coordinates(driver.relative_to, "t")})
            else:
                s = next(s for s in self.slides if s.key == driver.key)
                rows.append({*self._coordinates(s.a, "xy"), *self._coordinates(s.b, "xyt")})
        return rows

    def _coordinates(self, name: str, axes: str) -> Iterable[Unknown]:
        if name == self.scene.frame.name:
            return ()
        return [(("link", name), axis) for axis in axes]


def _wrong_count(scene: Scene, mobility: Mobility, parts: _Parts) -> Problem:
    found = len(scene.drivers)
    count = (
        f"F = 3*{mobility.links} - 2*{mobility.lower} - {mobility.higher} = {mobility.value}"
        if mobility.higher
        else f"F = 3*{mobility.links} - 2*{mobility.lower} = {mobility.value}"
    )
    wanted = f"a mechanism of mobility {mobility.value} needs as many drivers"
    idle = [link.name for link in scene.links if link.redundant]
    if idle and mobility.value > found:
        named = f"links {', '.join(idle)}, marked" if len(idle) > 1 else f"link {idle[0]}, marked"
        wanted += f"; {named} redundant, is not counted: only a link that repeats what others hold may be marked so"
    if mobility.value <= 0:
        wanted = "it is a structure, no driver can move it"
        loop = _sliding_loop(parts)
        if loop:
            wanted = (
                f"Gruebler's count fails here, links {', '.join(loop)} slide on each other in a closed loop and "
                "move all the same; leave one sliding pair of the loop out or give it a turning pair"
            )
    drivers = "no driver" if found == 0 else f"{found} driver{'s' if found > 1 else ''}"
    return Problem("mobility", f"{count}, but {drivers} given", wanted)


def _sliding_loop(parts: _Parts) -> list[str]:
    """Links of a closed loop of sliding pairs only, if there is one."""
    group: dict[str, set[str]] = {name: {name} for name in parts.links}
    for s in parts.slides:
        if group[s.a] is group[s.b]:
            ends = [t for t in parts.slides if group[t.a] is group[s.a]]
            return sorted({n for t in ends for n in (t.a, t.b)}, key=lambda n: parts.place(("link", n)))
        merged = group[s.a] | group[s.b]
        for name in merged:
            group[name] = merged
    return []


def _wrong_part(parts: _Parts, unknowns: list[list[Unknown]], given: dict[int, Unknown]) -> Problem:
    """Name the links that are held too much and those that are free."""
    users: dict[Unknown, list[int]] = {}
    for i, row in enumerate(unknowns):
        for u in row:
            users.setdefault(u, []).append(i)
    owner = {u: i for i, u in given.items()}
    over: set[str] = set()
    queue = [i for i in range(len(unknowns)) if i not in given]
    seen = set(queue)
    while queue:
        for u in unknowns[queue.pop()]:
            if u[0][0] == "link":
                over.add(u[0][1])
            if u in owner and owner[u] not in seen:
                seen.add(owner[u])
                queue.append(owner[u])
    free: set[str] = set()
    todo = [(n, a) for n in parts.nodes() for a in ("xyt" if n[0] == "link" else "xy") if (n, a) not in owner]
    done = set(todo)
    while todo:
        u = todo.pop()
        if u[0][0] == "link":
            free.add(u[0][1])
        for i in users.get(u, []):
            if i in given and given[i] not in done:
                done.add(given[i])
                todo.append(given[i])

    def names(found: set[str]) -> str:
        return ", ".join(sorted(found, key=lambda n: parts.place(("link", n)))) or "none"

    loop = _sliding_loop(parts)
    wanted = "each part of the mechanism needs as many constraints as it has coordinates"
    if loop:
        wanted = f"links {', '.join(loop)} slide on each other in a closed loop, where one pair only repeats the others"
    return Problem("mobility", f"links held too much: {names(over)}; links left free: {names(free)}", wanted)


def _element(parts: _Parts, members: list[str], known: set[str]) -> Element:
    scene = parts.scene
    inside = set(members)
    drivers = [d for d in scene.drivers if _ends(d, parts) & inside and not (_ends(d, parts) - inside - known)]
    pairs = _pairs(parts, members, known)
    if len(members) == 1 and len(pairs) == 1 and len(drivers) == 1:
        return Driven(members[0], pairs[0], drivers[0])
    blocks = {s.key for s in parts.slides if s.slot}
    real = tuple(m for m in members if m not in blocks)
    bodies, loose = _bodies(parts, members, drivers)
    dyad = _dyad(parts, bodies, pairs, real) if not loose else None
    return dyad or Cluster(tuple(members), tuple(pairs), tuple(drivers), real, _order(members, pairs))


def _ends(driver: Driver, parts: _Parts) -> set[str]:
    if isinstance(driver, AngleDriver):
        return {driver.link, driver.relative_to}
    s = next(s for s in parts.slides if s.key == driver.key)
    return {s.a, s.b}


def _pairs(parts: _Parts, members: list[str], known: set[str]) -> list[Pair]:
    """All pairs that hold the members: to known links, or among themselves."""
    found: list[Pair] = []
    for point, names in parts.hinges.items():
        mine = [n for n in names if n in members]
        base = [n for n in names if n in known]
        mine.sort(key=lambda n: parts.place(("link", n)))
        if base:
            found += [Turn(point, n, base[0]) for n in mine]
        else:
            found += [Turn(point, b, a) for a, b in pairwise(mine)]
    inside = set(members)
    found += [s for s in parts.slides if {s.a, s.b} & inside and {s.a, s.b} <= inside | known]
    return found


def _bodies(parts: _Parts, members: list[str], drivers: list[Driver]) -> tuple[list[Body], list[Driver]]:
    """Links of the group that drivers hold together, and the drivers that act at no pair inside it."""
    welds: list[Weld] = []
    loose: list[Driver] = []
    for driver in drivers:
        pair = driver_pair(driver, parts.links, parts.slides)
        if pair is None or not {pair.a, pair.b} <= set(members):
            loose.append(driver)
        else:
            welds.append(Weld(pair, driver, pair.b, pair.a))
    bodies: list[Body] = []
    left = list(members)
    while left:
        names, used = [left.pop(0)], []
        grown = True
        while grown:
            grown = False
            for w in welds:
                if w in used or {w.a, w.b} <= set(names):
                    continue
                if w.a in names:
                    used.append(w)
                elif w.b in names:
                    used.append(Weld(w.pair, w.driver, w.b, w.a, -1))
                else:
                    continue
                names.append(used[-1].b)
                left.remove(used[-1].b)
                grown = True
                break
        bodies.append(Body(tuple(names), tuple(used)))
    return bodies, loose


def _dyad(parts: _Parts, bodies: list[Body], pairs: list[Pair], links: tuple[str, ...]) -> Dyad | None:
    if len(bodies) != 2:
        return None
    one, two = bodies
    inner: list[Pair] = []
    outer: dict[int, list[Pair]] = {0: [], 1: []}
    hinged: set[tuple[str, int]] = set()
    for pair in pairs:
        sides = [i for i, body in enumerate(bodies) if pair.a in body.links or pair.b in body.links]
        if isinstance(pair, Turn):
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
    kind = _letter(first) + _letter(middle) + _letter(second)
    if kind not in _KINDS:
        return None

    def written(pair: Pair, body: Body) -> tuple[int, int, str]:
        return parts.place(("link", pair.a if pair.a in body.links else pair.b))

    swap = kind in ("PRR", "PPR")
    if kind in ("RRR", "PRP"):
        swap = written(second, two) < written(first, one)
    elif kind == "RPR":
        swap = middle.a in two.links
    if swap:
        one, two, first, second = two, one, second, first
    return Dyad(_KINDS[kind], one, two, middle, first, second, links)


def _letter(pair: Pair) -> str:
    return "R" if isinstance(pair, Turn) else "P"


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


