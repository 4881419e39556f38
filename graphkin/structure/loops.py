"""Closed vector loops: each group has one or more, found from the structure, or chosen as a book writes them.

A loop goes from link to link through their joints.  On each link it is an arrow from one joint to the next, fixed in
the link; along a guide it is an arrow whose size is the travel.  The sum of all arrows is zero, and so are its first
and second rate (Norton, Design of Machinery, ch. 4, 6, 7; Raven, Velocity and acceleration analysis of plane and space
mechanisms by means of independent-position equations, 1958).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from graphkin.errors import CallError, Problem
from graphkin.structure.model import Cluster, Driven, Dyad, Element, Pair, Structure
from graphkin.words import Phrase

__all__ = ["Arrow", "Loop", "Unknown", "angle_of", "loops_of"]


@dataclass(frozen=True)
class Arrow:
    """One arrow of a loop, in the axes of ``link``: ``vector`` (m) is its coefficient; where ``slide`` is set it is a
    unit vector along the guide, times the travel.  ``names`` are the points from which to which it leads, as far as
    they have names; ``sign`` is -1 where a loop goes through it backwards."""

    link: str
    vector: complex
    names: tuple[str, str]
    slide: str = ""


@dataclass(frozen=True, order=True)
class Unknown:
    """What a loop is to give: the angle of a link (and of all that turn with it), or the travel of a sliding pair."""

    kind: str  # "theta" or "s"
    of: str

    def __str__(self) -> str:
        return f"{self.kind}_{self.of}"


@dataclass(frozen=True)
class Loop:
    """A closed loop of arrows.  ``links`` are those of its group, whose motion it gives together with the other loops
    of the same ``block``."""

    name: str
    arrows: tuple[Arrow, ...]
    unknowns: tuple[Unknown, ...]
    links: tuple[str, ...]
    element: Element | None = None
    block: int = 0
    ties: Mapping[str, str] = field(default_factory=dict, hash=False)

    @cached_property
    def points(self) -> tuple[str, ...]:
        """The points that it goes through, in order, as far as they have names."""
        return tuple(dict.fromkeys(a.names[0] for a in self.arrows if a.names[0]))


def angle_of(structure: Structure) -> dict[str, str]:
    """For each link the one whose angle stands for its own: links that slide on each other, or are held by a driver,
    turn alike, a guide's stands for its blocks'; the frame's stands for all that never turn or are given."""
    group = {name: {name} for name in structure.links}
    joins = [(s.a, s.b) for s in structure.slides]
    joins += [(d.link, d.relative_to) for d in structure.scene.drivers if d.turns]
    for a, b in joins:
        merged = group[a] | group[b]
        for name in merged:
            group[name] = merged
    order, frame = structure.scene.order, structure.scene.frame.name
    blocks = {s.a for s in structure.slides}
    size = len(order)

    def rank(name: str) -> tuple[bool, bool, int, str]:
        return name != frame, name in blocks, order.get(name, size), name

    return {name: min(group[name], key=rank) for name in structure.links}


def loops_of(structure: Structure) -> tuple[Loop, ...]:
    """The loops of a mechanism: those that the scene chooses, else as many as each group has, the frame's way round.

    Raises
    ------
    CallError : a chosen loop goes from a point to another that no link and no guide joins
    """
    chosen = structure.scene.loops
    return _chosen(structure, chosen) if chosen else _found(structure)


# -- as the structure has them -----------------------------------------------------------------------------------------

Edge = tuple[str, str, Pair]


def _pairs(element: Element) -> tuple[Pair, ...]:
    welds = element.welds if isinstance(element, Dyad) else ()
    return *element.pairs, *(weld.pair for weld in welds)


def _found(structure: Structure) -> tuple[Loop, ...]:
    known: list[Edge] = []
    found: list[Loop] = []
    ties = angle_of(structure)
    for block, element in enumerate(structure.elements):
        edges: list[Edge] = [(pair.a, pair.b, pair) for pair in _pairs(element)]
        if not isinstance(element, Driven):
            for cycle in _cycles(structure, element, edges, known):
                arrows = _arrows(structure, cycle)
                name = _roman(len(found) + 1)
                found.append(Loop(name, arrows, (), element.links, element, block, ties))
        known += edges
    return tuple(_with_unknowns(structure, found))


def _roman(number: int) -> str:
    text = ""
    for value, letters in ((10, "X"), (9, "IX"), (5, "V"), (4, "IV"), (1, "I")):
        while number >= value:
            text, number = text + letters, number - value
    return text


Cycle = list[tuple[str, Pair, Pair]]
"""Links in turn, each with the pair by which the loop comes to it and that by which it leaves it."""


def _cycles(structure: Structure, element: Dyad | Cluster, edges: list[Edge], known: list[Edge]) -> list[Cycle]:
    """Independent cycles: a tree from the known links over the group; each pair that is left over closes one."""
    members = set(element.members)
    reached = {n for a, b, _ in edges for n in (a, b)} - members
    way: dict[str, list[tuple[str, Pair, str]]] = {name: [] for name in reached}  # from a known link: from, pair, to
    left = list(edges)
    grown = True
    while grown:
        grown = False
        for edge in list(left):
            a, b, pair = edge
            if (a in way) != (b in way):
                here, there = (a, b) if a in way else (b, a)
                way[there] = [*way[here], (here, pair, there)]
                left.remove(edge)
                grown = True
    cycles = []
    for a, b, pair in left:
        out, back = way[a], way[b]
        start, end = (out[0][0] if out else a), (back[0][0] if back else b)
        steps = [*out, (a, pair, b), *((to, p, of) for of, p, to in reversed(back))]
        steps += _known_way(structure, end, start, known)
        cycles.append(_oriented(structure, steps))
    return cycles


def _known_way(structure: Structure, start: str, end: str, known: list[Edge]) -> list[tuple[str, Pair, str]]:
    """The shortest way over links placed before."""
    if start == end:
        return []
    came: dict[str, tuple[str, Pair, str]] = {}
    queue, seen = [start], {start}
    shared = [(a, b, Pair(p, a, b)) for p, names in structure.hinges.items() for a in names for b in names if a < b]
    placed = {n for a, b, _ in known for n in (a, b)} | {structure.scene.frame.name}
    edges = [*known, *((a, b, pair) for a, b, pair in shared if {a, b} <= placed)]
    while queue:
        here = queue.pop(0)
        for a, b, pair in edges:
            there = b if a == here else a if b == here else None
            if there is not None and there not in seen:
                seen.add(there)
                came[there] = (here, pair, there)
                queue.append(there)
    steps: list[tuple[str, Pair, str]] = []
    while end != start:
        steps.insert(0, came[end])
        end = came[end][0]
    return steps


def _oriented(structure: Structure, steps: list[tuple[str, Pair, str]]) -> Cycle:
    """A cycle that begins on a driven link if it has one, else on the frame."""
    cycle: Cycle = [(to, pair, steps[(k + 1) % len(steps)][1]) for k, (_, pair, to) in enumerate(steps)]
    driven = [e.link for e in structure.driven]
    frame = structure.scene.frame.name
    first = next((k for k, (n, _, _) in enumerate(cycle) if n in driven), None)
    if first is None:
        first = next((k for k, (n, _, _) in enumerate(cycle) if n == frame), 0)
    cycle = [*cycle[first:], *cycle[:first]]
    # the crank is gone along from the frame outwards
    if cycle[0][0] != frame and len(cycle) > 1 and cycle[1][0] == frame:
        cycle = [(n, out, into) for n, into, out in [cycle[0], *reversed(cycle[1:])]]
    return cycle


def _place(structure: Structure, link: str, pair: Pair) -> tuple[complex, str]:
    """Where a pair is on a link, and the name of the point there."""
    if pair.turns:
        return structure.links[link].points[pair.point], pair.point
    if link == pair.a:
        return 0j, pair.pin or ""
    names = structure.links[link].points
    at = pair.guide.through
    return at, next((p for p, z in names.items() if abs(z - at) < 1e-12 * structure.scene.size), "")


def _arrows(structure: Structure, cycle: Cycle) -> tuple[Arrow, ...]:
    found: list[Arrow] = []
    for link, into, out in cycle:
        if not into.turns and link == into.b:  # from what slides back to the guide's origin
            found.append(_travel(structure, into, -1.0))
        (start, one), (end, two) = _place(structure, link, into), _place(structure, link, out)
        if abs(end - start) > 1e-12 * structure.scene.size:
            found.append(Arrow(link, end - start, (one, two)))
        if not out.turns and link == out.b:
            found.append(_travel(structure, out, 1.0))
    return _named(found)


def _travel(structure: Structure, slide: Pair, sign: float) -> Arrow:
    _, start = _place(structure, slide.b, slide)
    names = (start, slide.pin or "")
    return Arrow(slide.b, sign * slide.guide.direction, names if sign > 0 else names[::-1], slide.key)


def _named(arrows: list[Arrow]) -> tuple[Arrow, ...]:
    """Arrows tip to tail: where one has no name for its end, the next one's beginning has."""
    named = []
    for k, arrow in enumerate(arrows):
        before, after = arrows[k - 1], arrows[(k + 1) % len(arrows)]
        start, end = arrow.names[0] or before.names[1], arrow.names[1] or after.names[0]
        named.append(Arrow(arrow.link, arrow.vector, (start, end), arrow.slide))
    return tuple(named)


# -- as a book writes them ---------------------------------------------------------------------------------------------


def _chosen(structure: Structure, chosen: Mapping[str, Sequence[str]]) -> tuple[Loop, ...]:
    ties = angle_of(structure)
    loops = []
    for name, points in chosen.items():
        arrows: list[Arrow] = []
        for one, two in zip(points, (*points[1:], points[0]), strict=True):
            arrows += _between(structure, name, one, two)
        loops.append(Loop(name, _named(arrows), (), (), None, 0, ties))
    return tuple(_with_unknowns(structure, loops))


def _between(structure: Structure, name: str, one: str, two: str) -> list[Arrow]:
    """The arrows from a point to the next of a chosen loop."""
    for link, body in structure.links.items():
        if one in body.points and two in body.points:
            return [Arrow(link, body.points[two] - body.points[one], (one, two))]
    for start, end, sign in ((one, two, 1.0), (two, one, -1.0)):
        for slide in structure.slides:
            own = structure.links[slide.b].points
            if slide.pin == end and start in own:
                made = []
                if abs(slide.guide.through - own[start]) > 1e-12 * structure.scene.size:
                    made.append(Arrow(slide.b, sign * (slide.guide.through - own[start]),
                                      (start, "") if sign > 0 else ("", start)))  # fmt: skip
                travel = _travel(structure, slide, sign)
                made.append(Arrow(travel.link, travel.vector, ("" if made else start, end) if sign > 0 else
                                  (end, "" if made else start), travel.slide))  # fmt: skip
                return made if sign > 0 else made[::-1]
    raise CallError(Problem(f"loops.{name}", Phrase("no link and no guide joins and", name=one, other=two),
                            Phrase("name the points in the order in which")))  # fmt: skip


# -- what they give ----------------------------------------------------------------------------------------------------


def _with_unknowns(structure: Structure, loops: Iterable[Loop]) -> list[Loop]:
    """Loops in the order in which they can be solved, with what each block of them gives."""
    ties = angle_of(structure)
    frame = structure.scene.frame.name
    known = {Unknown("theta", frame)}
    known |= {Unknown("s", d.key) for d in structure.scene.drivers if not d.turns}
    waiting, made, block = list(loops), [], 0
    while waiting:
        taken = _next_block(waiting, ties, known)
        order = [*structure.scene.order, *structure.links]
        every = {u for loop in taken for u in _variables(loop, ties)}
        open_ = sorted(every - known, key=lambda u: (u.kind, order.index(u.of) if u.kind == "theta" else 0, u.of))
        open_.sort(key=lambda u: u.kind == "s")
        for loop in taken:
            waiting.remove(loop)
            links = loop.links or tuple(dict.fromkeys(u.of for u in open_))
            made.append(Loop(loop.name, loop.arrows, tuple(open_), links, loop.element, block, ties))
        known |= set(open_)
        block += 1
    return made


def _variables(loop: Loop, ties: Mapping[str, str]) -> set[Unknown]:
    found = {Unknown("theta", ties[a.link]) for a in loop.arrows}
    return found | {Unknown("s", a.slide) for a in loop.arrows if a.slide}


def _next_block(waiting: list[Loop], ties: Mapping[str, str], known: set[Unknown]) -> list[Loop]:
    """The first loop that two unknowns are left in; else the first few with twice as many unknowns as loops."""
    for loop in waiting:
        if len(_variables(loop, ties) - known) <= 2:
            return [loop]
    taken: list[Loop] = []
    for loop in waiting:
        taken.append(loop)
        if len({u for one in taken for u in _variables(one, ties)} - known) <= 2 * len(taken):
            return taken
    return taken
