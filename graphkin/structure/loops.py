"""Closed vector loops: each group has one or more, found from the structure, or chosen as a book writes them.

A loop goes from link to link through their joints.  On each link it is an arrow from one joint to the next, fixed in
the link; along a guide it is an arrow whose size is the travel.  The sum of all arrows is zero, and so are its first
and second rate (Norton, Design of Machinery, ch. 4, 6, 7; Raven, Velocity and acceleration analysis of plane and space
mechanisms by means of independent-position equations, 1958).

In numbers: how far a loop is from closing, its rates as matrix equations, and its root.  With the angular velocities w
of the arrows z and, along guides (unit vector u), sliding velocities v the rates are sum(i w z + v u) = 0 and
sum((i a - w^2) z + 2 i w v u + b u) = 0, a and b being the second rates: two linear equations a loop.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from graphkin.errors import CallError, Problem
from graphkin.plane import added_up, cross, dot
from graphkin.structure.model import Driven, Dyad, Element, LargerGroup, Pair, Structure
from graphkin.words import Phrase

__all__ = ["Arrow", "ArrowValue", "Loop", "LoopBlock", "LoopValue", "Root", "Unknown", "loops_in_numbers", "loops_of"]


@dataclass(frozen=True)
class Arrow:
    """One arrow of a loop, in the axes of ``link``: ``vector`` (m) is its coefficient; where ``slide`` is set it is a
    unit vector along the guide, times the travel.  ``names`` are the points from which to which it leads, as far as
    they have names."""

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
    chosen = structure.scene.question.loops
    return _chosen(structure, chosen) if chosen else _found(structure)


# -- as the structure has them -----------------------------------------------------------------------------------------

Edge = tuple[str, str, Pair]


def _pairs(element: Element) -> tuple[Pair, ...]:
    joints = element.joints if isinstance(element, Dyad) else ()
    return *element.pairs, *(joint.pair for joint in joints)


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


def _cycles(structure: Structure, element: Dyad | LargerGroup, edges: list[Edge], known: list[Edge]) -> list[Cycle]:
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


# -- in numbers --------------------------------------------------------------------------------------------------------


Matrix = NDArray[np.float64]


@dataclass(frozen=True)
class ArrowValue:
    """An arrow here: ``vector`` (m) in the frame; along a guide ``travel`` (m) times the unit vector ``along``."""

    arrow: Arrow
    vector: complex
    along: complex = 0j
    travel: float = 0.0


@dataclass(frozen=True)
class Root:
    """The closed-form root of a loop: ``key`` tells the kind, ``unknown`` what it gives, ``numbers`` are its
    coefficients (SI), ``sign`` of the square root is that of the assembly (0: there is one root only), ``value`` is
    what comes out (rad, m)."""

    key: str
    unknown: Unknown
    numbers: tuple[float, ...]
    sign: int
    value: float


@dataclass(frozen=True)
class LoopValue:
    """A loop here; ``gap`` is the sum of its arrows (m), which is nothing but rounding."""

    loop: Loop
    arrows: tuple[ArrowValue, ...]
    root: Root | None

    @property
    def gap(self) -> complex:
        return added_up((a.vector for a in self.arrows), 0j)


@dataclass(frozen=True)
class LoopBlock:
    """Loops that are solved together: ``matrix`` times the rates of ``unknowns`` is ``velocity``, times their second
    rates ``acceleration``; rows are the x and y components of the loops in turn (m, or 1 for a travel)."""

    loops: tuple[LoopValue, ...]
    unknowns: tuple[Unknown, ...]
    values: tuple[float, ...]
    matrix: Matrix
    velocity: Matrix
    acceleration: Matrix
    rates: tuple[float, ...]
    second_rates: tuple[float, ...]


def loops_in_numbers(
    structure: Structure, axes: Mapping[str, complex], travels: Mapping[str, float]
) -> tuple[LoopBlock, ...]:
    """Every loop at one position, in the order of solution, as far as its links are placed.

    Parameters
    ----------
    axes : unit vector of each link's own x axis
    travels : of each sliding pair (m)

    Raises
    ------
    CallError : see `loops_of`
    """
    turning = _turning(structure)
    angle = {Unknown("theta", structure.scene.frame.name): (0.0, 0.0)}
    for driver in structure.scene.drivers:
        if not driver.turns:
            angle[Unknown("s", driver.key)] = driver.values[1:]
    blocks: dict[int, list[Loop]] = {}
    for loop in loops_of(structure):
        blocks.setdefault(loop.block, []).append(loop)
    made = []
    for block in blocks.values():
        if not all(a.link in axes and (not a.slide or a.slide in travels) for loop in block for a in loop.arrows):
            break
        one = _block(structure, block, axes, travels, turning, angle)
        if one is None:
            break
        angle |= {u: (v, w) for u, v, w in zip(one.unknowns, one.rates, one.second_rates, strict=True)}
        made.append(one)
    return tuple(made)


Turning = Mapping[str, tuple[str, float, float]]
"""For each link the one whose angle stands for its own, and how much faster it turns (rad/s, rad/s2)."""


def _turning(structure: Structure) -> Turning:
    joins: list[tuple[str, str, float, float]] = [(s.b, s.a, 0.0, 0.0) for s in structure.slides]
    for d in structure.scene.drivers:
        if d.turns:
            joins.append((d.relative_to, d.link, d.rate, d.second))
    found: dict[str, tuple[str, float, float]] = {}
    for first in angle_of(structure).values():
        found.setdefault(first, (first, 0.0, 0.0))
    grown = True
    while grown:
        grown = False
        for a, b, rate, second in joins:
            for here, there, sign in ((a, b, 1.0), (b, a, -1.0)):
                if here in found and there not in found:
                    first, omega, alpha = found[here]
                    found[there] = first, omega + sign * rate, alpha + sign * second
                    grown = True
    return found


def _block(
    structure: Structure, block: Sequence[Loop], axes: Mapping[str, complex], travels: Mapping[str, float],
    turning: Turning, known: Mapping[Unknown, tuple[float, float]],
) -> LoopBlock | None:  # fmt: skip
    unknowns = block[0].unknowns
    place = {u: k for k, u in enumerate(unknowns)}
    size = 2 * len(block)
    if len(unknowns) != size:
        return None
    matrix = np.zeros((size, size))
    velocity, acceleration = np.zeros(size), np.zeros(size)
    loops = []
    for n, loop in enumerate(block):
        arrows = tuple(_value(arrow, axes, travels) for arrow in loop.arrows)
        for arrow in arrows:
            first = Unknown("theta", turning[arrow.arrow.link][0])
            _add(matrix, n, place.get(first), 1j * arrow.vector)
            if arrow.arrow.slide:
                _add(matrix, n, place.get(Unknown("s", arrow.arrow.slide)), arrow.along)
        loops.append(LoopValue(loop, arrows, _root(loop, arrows, turning, axes)))
    for n, loop_value in enumerate(loops):
        for arrow in loop_value.arrows:
            (omega, _), (slip, _) = _known_rates(arrow, turning, known)
            _put(velocity, n, -(1j * omega * arrow.vector + slip * arrow.along))
    try:
        rates = np.linalg.solve(matrix, velocity)
    except np.linalg.LinAlgError:
        return None
    now = {**known, **{u: (float(rates[k]), 0.0) for u, k in place.items()}}
    for n, loop_value in enumerate(loops):
        for arrow in loop_value.arrows:
            (omega, alpha), (slip, push) = _known_rates(arrow, turning, now)
            bent = (1j * alpha - omega**2) * arrow.vector + (2j * omega * slip + push) * arrow.along
            _put(acceleration, n, -bent)
    second = np.linalg.solve(matrix, acceleration)
    values = tuple(
        travels[u.of] if u.kind == "s" else cmath.phase(axes[u.of]) for u in unknowns
    )
    return LoopBlock(tuple(loops), unknowns, values, matrix, velocity, acceleration,
                     tuple(map(float, rates)), tuple(map(float, second)))  # fmt: skip


def _value(arrow: Arrow, axes: Mapping[str, complex], travels: Mapping[str, float]) -> ArrowValue:
    z = arrow.vector * axes[arrow.link]
    if not arrow.slide:
        return ArrowValue(arrow, z)
    return ArrowValue(arrow, z * travels[arrow.slide], z, travels[arrow.slide])


def _known_rates(
    arrow: ArrowValue, turning: Turning, known: Mapping[Unknown, tuple[float, float]]
) -> tuple[tuple[float, float], tuple[float, float]]:
    first, more, more_second = turning[arrow.arrow.link]
    omega, alpha = known.get(Unknown("theta", first), (0.0, 0.0))
    slip = known.get(Unknown("s", arrow.arrow.slide), (0.0, 0.0)) if arrow.arrow.slide else (0.0, 0.0)
    return (omega + more, alpha + more_second), slip


def _add(matrix: Matrix, loop: int, column: int | None, z: complex) -> None:
    if column is not None:
        matrix[2 * loop, column] += z.real
        matrix[2 * loop + 1, column] += z.imag


def _put(vector: Matrix, loop: int, z: complex) -> None:
    vector[2 * loop] += z.real
    vector[2 * loop + 1] += z.imag


# -- the root ---------------------------------------------------------------------------------------------------------


def _root(loop: Loop, arrows: Sequence[ArrowValue], turning: Turning, axes: Mapping[str, complex]) -> Root | None:
    """The closed-form root of a loop with two unknowns; None for loops that are solved together."""
    if len(loop.unknowns) != 2:
        return None
    angles = [u for u in loop.unknowns if u.kind == "theta"]
    slides = [u for u in loop.unknowns if u.kind == "s"]
    rigid: dict[str, complex] = {u.of: 0j for u in angles}  # in the axes of the link that stands for the angle
    along: dict[str, tuple[str | None, complex]] = {}  # of a slide: the angle that it turns with, its unit vector
    known = 0j
    for arrow in arrows:
        first = turning[arrow.arrow.link][0]
        turned = axes[first].conjugate() if first in rigid else 1.0
        open_slide = any(u.of == arrow.arrow.slide for u in slides)
        if open_slide:
            along[arrow.arrow.slide] = (first if first in rigid else None), arrow.along * turned
        elif first in rigid:
            rigid[first] += arrow.vector * turned
        else:
            known += arrow.vector
    if len(angles) == 2:
        one, two = angles
        return _two_angles(one, rigid[one.of], rigid[two.of], known, axes[one.of])
    if len(angles) == 1 and len(along) == 1:
        (key, (turns, unit)), angle = next(iter(along.items())), angles[0]
        travel = next(a.travel for a in arrows if a.arrow.slide == key)
        if turns is None:
            # r e^(i theta) + s u + d = 0
            middle, across = -dot(known, unit), cross(unit, known)
            rest = abs(rigid[angle.of]) ** 2 - across**2
        else:
            # (s u + c) e^(i theta) + d = 0
            middle, across = -dot(rigid[angle.of], unit), cross(unit, rigid[angle.of])
            rest = abs(known) ** 2 - across**2
        sign = 1 if travel >= middle else -1
        value = middle + sign * math.sqrt(max(0.0, rest))
        return Root("loop root travel", Unknown("s", key), (middle, rest), sign, value)
    if len(along) == 2 and not angles:
        (one_key, (_, u)), (_, (_, v)) = along.items()
        sine = cross(u, v)
        return None if sine == 0.0 else Root("loop root lines", Unknown("s", one_key), (cross(v, known), sine), 0,
                                             cross(v, known) / sine)  # fmt: skip
    return None


def _two_angles(unknown: Unknown, r: complex, other: complex, d: complex, axis: complex) -> Root | None:
    """|r e^(i theta) + d| = |other|: A cos + B sin = C, theta = 2 atan2(B +- sqrt(A2 + B2 - C2), A + C)."""
    turned = d * r.conjugate()
    a, b = 2 * turned.real, 2 * turned.imag
    c = abs(other) ** 2 - abs(r) ** 2 - abs(d) ** 2
    inside = a * a + b * b - c * c
    if r == 0 or other == 0:
        return None
    here = cmath.phase(axis)

    def root(sign: int) -> float:
        return 2 * math.atan2(b + sign * math.sqrt(max(0.0, inside)), a + c)

    sign = min((1, -1), key=lambda s: abs(math.remainder(root(s) - here, math.tau)))
    return Root("loop root angle", unknown, (a, b, c), sign, math.remainder(root(sign), math.tau))
