"""Closed vector loops: each group has one or more, found from the structure, or chosen as a book writes them.

A loop goes from link to link through their joints.  On each link it is an arrow from one joint to the next, fixed in
the link; along a guide it is an arrow whose size is the travel.  The sum of all arrows is zero, and so are its first
and second rate (Norton, Design of Machinery, ch. 4, 6, 7; Raven, Velocity and acceleration analysis of plane and space
mechanisms by means of independent-position equations, 1958).

In numbers: the gap of a loop, its rates as matrix equations, and its root.  With the angular velocities w
of the arrows z and, along guides (unit vector u), sliding velocities v the rates are sum(i w z + v u) = 0 and
sum((i a - w^2) z + 2 i w v u + b u) = 0, a and b being the second rates: two linear equations a loop.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import takewhile

import numpy as np
from numpy.typing import NDArray

from graphkin.errors import CallError
from graphkin.plane import added_up, cross, dot
from graphkin.scene.pairs import Pair
from graphkin.structure.model import Coordinate, Driven, Element, Structure, carried
from graphkin.words.written import roman


@dataclass(frozen=True, eq=False, repr=False)
class LoopArrow:
    """One arrow of a loop, fixed in ``link``.

    Parameters
    ----------
    coefficient : the arrow in the axes of its link (m); where ``slide`` is set the unit vector along the guide
    names : its first and last point, where they have names
    slide : the sliding pair whose travel is its size, "" for a fixed size
    axis, travel : of the link, and of the pair (m, else 1), at a position
    """

    link: str
    coefficient: complex
    names: tuple[str, str]
    slide: str = ""
    axis: complex = 1 + 0j
    travel: float = 1.0

    @property
    def along(self) -> complex:
        """The unit vector of a guide in the frame, 0 for an arrow of fixed size."""
        return self.coefficient * self.axis if self.slide else 0j

    @property
    def vector(self) -> complex:
        """The arrow (m) in the frame."""
        return self.coefficient * self.axis * self.travel


@dataclass(frozen=True, eq=False, repr=False)
class Root:
    """The closed-form root of a loop: ``key`` is its kind, ``unknown`` its quantity, ``numbers`` are its coefficients
    (SI), ``sign`` of the square root belongs to the assembly (0: there is one root only), ``value`` is the result (rad,
    m)."""

    key: str
    unknown: Coordinate
    numbers: tuple[float, ...]
    sign: int
    value: float


@dataclass(frozen=True, eq=False, repr=False)
class Loop:
    """A closed loop of arrows.  ``links`` are the links of its group, whose motion it gives together with the other
    loops of the same ``block``, and ``unknowns`` the quantities that these give; ``ties`` name for each link the link
    whose angle it shares.  At a position it has a ``root``, unless it is solved together with others."""

    name: str
    arrows: tuple[LoopArrow, ...]
    links: tuple[str, ...] = ()
    unknowns: tuple[Coordinate, ...] = ()
    block: int = 0
    ties: Mapping[str, str] = field(default_factory=dict, hash=False)
    root: Root | None = None

    @cached_property
    def points(self) -> tuple[str, ...]:
        """The named points on it, in order."""
        return tuple(dict.fromkeys(a.names[0] for a in self.arrows if a.names[0]))

    @property
    def gap(self) -> complex:
        """The sum of its arrows (m): rounding alone."""
        return added_up((a.vector for a in self.arrows), 0j)


Turning = Mapping[str, tuple[str, float, float]]
"""For each link the one whose angle stands for its own, and how much faster it turns (rad/s, rad/s2)."""


def _turning(structure: Structure) -> Turning:
    """For each link the link whose angle it shares, by slides and drivers: a block has its guide's angle, a link that
    never turns or is given the frame's."""
    joins = [(s.b, s.a, (0.0, 0.0)) for s in structure.slides]
    joins += [(d.relative_to, d.link, (d.rate, d.second)) for d in structure.scene.drivers if d.turns]
    order, frame, blocks = structure.scene.order, structure.scene.frame.name, {s.a for s in structure.slides}

    def rank(name: str) -> tuple[bool, bool, int, str]:
        return name != frame, name in blocks, order.get(name, len(order)), name

    def onward(turning: tuple[str, float, float], rates: tuple[float, float], on: bool) -> tuple[str, float, float]:
        first, omega, alpha = turning
        rate, second = rates
        sign = 1.0 if on else -1.0
        return first, omega + sign * rate, alpha + sign * second

    turning: dict[str, tuple[str, float, float]] = {}
    for name in sorted(structure.links, key=rank):
        turning = carried({**turning, name: turning.get(name, (name, 0.0, 0.0))}, joins, onward)
    return turning


def loops_of(structure: Structure) -> tuple[Loop, ...]:
    """The loops of a mechanism, in the order in which they can be solved: those that the scene chooses, else the loops
    of each group, through the frame.

    Raises
    ------
    CallError : a chosen loop joins two points that no link and no guide joins
    """
    ties = {name: first for name, (first, _, _) in _turning(structure).items()}
    waiting = _chosen(structure) if structure.scene.question.loops else _found(structure)
    known = {("angle", structure.scene.frame.name)}
    known |= {("travel", d.key) for d in structure.scene.drivers if not d.turns}
    order = [*structure.scene.order, *structure.links]
    made: list[Loop] = []
    block = 0
    while waiting:
        taken = _next_block(waiting, ties, known)
        every = {u for loop in taken for u in _variables(loop, ties)}
        unknowns = sorted(every - known, key=lambda u: (u[0], order.index(u[1]) if u[0] == "angle" else 0, u[1]))
        links = tuple(dict.fromkeys(name for _, name in unknowns))
        for loop in taken:
            waiting.remove(loop)
            made.append(replace(loop, links=loop.links or links, unknowns=tuple(unknowns), block=block, ties=ties))
        known |= every
        block += 1
    return tuple(made)


def _variables(loop: Loop, ties: Mapping[str, str]) -> set[Coordinate]:
    return {("angle", ties[a.link]) for a in loop.arrows} | {("travel", a.slide) for a in loop.arrows if a.slide}


def _next_block(waiting: Sequence[Loop], ties: Mapping[str, str], known: set[Coordinate]) -> Sequence[Loop]:
    """The first loop with two unknowns; else the first few loops with twice as many unknowns as loops."""
    for loop in waiting:
        if len(_variables(loop, ties) - known) <= 2:
            return [loop]
    variables: set[Coordinate] = set()
    for count, loop in enumerate(waiting, 1):
        variables |= _variables(loop, ties)
        if len(variables - known) <= 2 * count:
            return waiting[:count]
    return list(waiting)


# as the structure has them

Passage = tuple[str, Pair, str]
"""From a link by a pair to another."""


def _found(structure: Structure) -> list[Loop]:
    """The loops of all groups in the order of solution, those that the pairs of each close with what comes before."""
    known: list[Pair] = []
    loops: list[Loop] = []
    for element in structure.elements:
        for cycle in () if isinstance(element, Driven) else _cycles(structure, element, known):
            loops.append(Loop(roman(len(loops) + 1), _arrows(structure, cycle), element.links))
        known += element.all_pairs
    return loops


def _through(pair: Pair, start: str) -> Passage:
    return start, pair, pair.other(start)


def _cycles(structure: Structure, element: Element, known: Sequence[Pair]) -> list[Sequence[Passage]]:
    """Independent cycles: a tree from the known links over the group; each pair outside the tree closes a cycle, from
    where the ways to its links part."""
    pairs = element.all_pairs
    known_links = [n for pair in pairs for n in pair.links if n not in element.members]
    starts: dict[str, list[Passage]] = {name: [] for name in known_links}

    def onward(path: list[Passage], pair: Pair, from_first: bool) -> list[Passage]:
        return [*path, _through(pair, pair.a if from_first else pair.b)]

    path = carried(starts, [(pair.a, pair.b, pair) for pair in pairs], onward)
    tree = [passages[-1][1] for passages in path.values() if passages]
    cycles = []
    for pair in (pair for pair in pairs if pair not in tree):
        a, b = pair.links
        common = sum(1 for _ in takewhile(lambda both: both[0] == both[1], zip(path[a], path[b], strict=False)))
        out, back = path[a][common:], path[b][common:]
        start, end = (out[0][0] if out else a), (back[0][0] if back else b)
        closing = [(to, of_pair, of) for of, of_pair, to in reversed(back)]
        cycles.append(_oriented(structure, [*out, (a, pair, b), *closing, *_over_known(structure, end, start, known)]))
    return cycles


def _over_known(structure: Structure, start: str, end: str, known: Sequence[Pair]) -> list[Passage]:
    """The shortest path over links placed before."""
    placed = {n for pair in known for n in pair.links} | {structure.scene.frame.name}
    shared = [Pair(p, a, b) for p, names in structure.hinges.items() for a in names for b in names
              if a < b and {a, b} <= placed]
    paths: dict[str, list[Passage]] = {start: []}
    queue = [start]
    while end not in paths:
        here = queue.pop(0)
        for passage in (_through(pair, here) for pair in (*known, *shared) if here in pair.links):
            if passage[2] not in paths:
                paths[passage[2]] = [*paths[here], passage]
                queue.append(passage[2])
    return paths[end]


def _oriented(structure: Structure, cycle: list[Passage]) -> Sequence[Passage]:
    """A cycle whose first edge leads to a driven link if it has one, else to the frame; it passes the crank from the
    frame outwards."""
    driven, frame = {e.link for e in structure.driven}, structure.scene.frame.name
    links = [link for _, _, link in cycle]
    first = next((k for k, link in enumerate(links) if link in driven), links.index(frame) if frame in links else 0)
    cycle = [*cycle[first:], *cycle[:first]]
    if len(cycle) > 1 and cycle[0][2] != frame and cycle[1][2] == frame:
        cycle = [(b, pair, a) for a, pair, b in (cycle[1], cycle[0], *reversed(cycle[2:]))]
    return cycle


def _place(structure: Structure, link: str, pair: Pair) -> tuple[complex, str]:
    """The place of a pair on a link, and the name of the point there."""
    if pair.turns:
        return structure.links[link].points[pair.point], pair.point
    if link == pair.a:
        return 0j, pair.pin
    at, points = pair.guide.through, structure.links[link].points
    return at, next((p for p, z in points.items() if abs(z - at) < 1e-12 * structure.scene.size), "")


def _arrows(structure: Structure, cycle: Sequence[Passage]) -> tuple[LoopArrow, ...]:
    """The arrows of a loop of pairs: on each link from the pair that leads to it to the next, along guides the travels.
    """
    arrows: list[LoopArrow] = []
    for (_, into, link), (_, out, _) in zip(cycle, (*cycle[1:], cycle[0]), strict=True):
        if not into.turns and link == into.b:  # from what slides back to the guide's origin
            arrows.append(_travel(structure, into, -1.0))
        (start, tail), (end, tip) = _place(structure, link, into), _place(structure, link, out)
        if abs(end - start) > 1e-12 * structure.scene.size:
            arrows.append(LoopArrow(link, end - start, (tail, tip)))
        if not out.turns and link == out.b:
            arrows.append(_travel(structure, out, 1.0))
    return _named(arrows)


def _travel(structure: Structure, slide: Pair, sign: float) -> LoopArrow:
    names = _place(structure, slide.b, slide)[1], slide.pin
    return LoopArrow(slide.b, sign * slide.guide.direction, names if sign > 0 else names[::-1], slide.key)


def _named(arrows: Sequence[LoopArrow]) -> tuple[LoopArrow, ...]:
    """Arrows tip to tail, with a name for each end: an end without a name takes it from the next arrow's beginning."""
    around = zip((arrows[-1], *arrows), arrows, (*arrows[1:], arrows[0]), strict=False)
    return tuple(
        replace(arrow, names=(arrow.names[0] or before.names[1], arrow.names[1] or after.names[0]))
        for before, arrow, after in around
    )


# as a book writes them


def _chosen(structure: Structure) -> list[Loop]:
    loops = []
    for name, points in structure.scene.question.loops.items():
        ends = zip(points, (*points[1:], points[0]), strict=True)
        arrows = [arrow for tail, tip in ends for arrow in _between(structure, name, tail, tip)]
        loops.append(Loop(name, _named(arrows)))
    return loops


def _between(structure: Structure, name: str, tail: str, tip: str) -> list[LoopArrow]:
    """The arrows from a point to the next of a chosen loop."""
    for link, body in structure.links.items():
        if tail in body.points and tip in body.points:
            return [LoopArrow(link, body.points[tip] - body.points[tail], (tail, tip))]
    for start, end, sign in ((tail, tip, 1.0), (tip, tail, -1.0)):
        for slide in structure.slides:
            points = structure.links[slide.b].points
            if slide.pin == end and start in points:
                offset = slide.guide.through - points[start]
                legs = [(sign * offset, start, "", "")] if abs(offset) > 1e-12 * structure.scene.size else []
                legs.append((sign * slide.guide.direction, "" if legs else start, end, slide.key))
                made = [LoopArrow(slide.b, z, (a, b) if sign > 0 else (b, a), key) for z, a, b, key in legs]
                return made if sign > 0 else made[::-1]
    raise CallError.of(f"loops.{name}", "no link and no guide joins and", "name the points in the order in which",
                       name=tail, other=tip)


# in numbers


Matrix = NDArray[np.float64]
Vectors = NDArray[np.complex128]
ROUNDING = 1e-14  # of the sizes of the terms of a sum


@dataclass(frozen=True, eq=False, repr=False)
class LoopBlock:
    """Loops that are solved together: ``matrix`` times the rates of ``unknowns`` gives ``velocity``, times their second
    rates ``acceleration``; rows are the x and y components of the loops in turn (m, or 1 for a travel)."""

    loops: tuple[Loop, ...]
    unknowns: tuple[Coordinate, ...]
    values: tuple[float, ...]
    matrix: Matrix
    velocity: Matrix
    acceleration: Matrix
    rates: tuple[float, ...]
    second_rates: tuple[float, ...]


Rates = Mapping[Coordinate, tuple[float, float]]
"""The first and the second rate of coordinates (rad, m, per second)."""


def loops_in_numbers(
    structure: Structure, axes: Mapping[str, complex], travels: Mapping[str, float]
) -> tuple[LoopBlock, ...]:
    """The loops at one position, in the order of solution, whose links are placed.

    Parameters
    ----------
    axes : unit vector of each link's own x axis
    travels : of each sliding pair (m)

    Raises
    ------
    CallError : see `loops_of`
    """
    turning = _turning(structure)
    known = {("travel", d.key): d.values[1:] for d in structure.scene.drivers if not d.turns}
    loops, made = loops_of(structure), list[LoopBlock]()
    for block in range(loops[-1].block + 1 if loops else 0):
        together = [loop for loop in loops if loop.block == block]
        arrows = [arrow for loop in together for arrow in loop.arrows]
        if not all(a.link in axes and (not a.slide or a.slide in travels) for a in arrows):
            break
        here = [
            replace(loop, arrows=tuple(
                replace(a, axis=axes[a.link], travel=travels[a.slide] if a.slide else 1.0) for a in loop.arrows
            )) for loop in together
        ]
        solved = _solved(here, axes, travels, turning, known)
        if solved is None:
            break
        known |= {u: (v, w) for u, v, w in zip(solved.unknowns, solved.rates, solved.second_rates, strict=True)}
        made.append(solved)
    return tuple(made)


def _solved(
    loops: Sequence[Loop], axes: Mapping[str, complex], travels: Mapping[str, float], turning: Turning, known: Rates
) -> LoopBlock | None:
    """Loops solved together for the rates of their unknowns: an angle turns each arrow z that it leads by i z, a travel
    lengthens the one along its guide by the unit vector u; what the known rates give stands on the right side.  None
    where there are not two unknowns a loop, or the position is singular.

    Parameters
    ----------
    loops : at the position, with the axis and the travel of each arrow
    axes, travels : of links, and of sliding pairs (m), from which the values of the unknowns come
    known : first and second rates of what was found before
    """
    unknowns = loops[0].unknowns
    if len(unknowns) != 2 * len(loops):
        return None
    factors = np.zeros((len(loops), len(unknowns)), complex)
    for n, loop in enumerate(loops):
        for arrow in loop.arrows:
            for coordinate, factor in (
                (("angle", turning[arrow.link][0]), 1j * arrow.vector), (("travel", arrow.slide), arrow.along)
            ):
                if coordinate in unknowns:
                    factors[n, unknowns.index(coordinate)] += factor
    matrix = _components(factors)
    try:
        velocity, rates = _rates(matrix, *_right_side(loops, turning, known, 1))
    except np.linalg.LinAlgError:
        return None
    now = {**known, **{u: (float(rate), 0.0) for u, rate in zip(unknowns, rates, strict=True)}}
    acceleration, second = _rates(matrix, *_right_side(loops, turning, now, 2))
    values = tuple(travels[name] if kind == "travel" else cmath.phase(axes[name]) for kind, name in unknowns)
    with_roots = tuple(replace(loop, root=_root(loop, axes)) for loop in loops)
    return LoopBlock(with_roots, unknowns, values, matrix, velocity, acceleration,
                     tuple(map(float, rates)), tuple(map(float, second)))


def _components(vectors: Vectors) -> Matrix:
    """Rows of complex numbers as rows of their x and y components in turn."""
    return np.stack([vectors.real, vectors.imag], axis=1).reshape(2 * len(vectors), *vectors.shape[1:])


def _rates(matrix: Matrix, left_open: Vectors, sizes: Matrix) -> tuple[Matrix, Matrix]:
    """The right side of a matrix equation and its solution, 0 where terms of these ``sizes`` leave rounding alone."""
    sizes, right = np.repeat(sizes, 2), _components(left_open)
    right = np.where(np.abs(right) > ROUNDING * sizes, right, 0.0)
    rates = np.linalg.solve(matrix, right)
    most = np.abs(np.linalg.inv(matrix)) @ (sizes + np.abs(matrix) @ np.abs(rates))
    return right, np.where(np.abs(rates) > ROUNDING * most, rates, 0.0)


def _right_side(loops: Sequence[Loop], turning: Turning, rates: Rates, order: int) -> tuple[Vectors, Matrix]:
    """The part of each loop's rate that the known rates leave open, by the sum of its arrows' first or second rates,
    and the sizes of its terms."""
    left_open, sizes = np.zeros(len(loops), complex), np.zeros(len(loops))
    for n, loop in enumerate(loops):
        for arrow in loop.arrows:
            first, faster, more = turning[arrow.link]
            omega, alpha = rates.get(("angle", first), (0.0, 0.0))
            slip, push = rates.get(("travel", arrow.slide), (0.0, 0.0))
            omega, alpha = omega + faster, alpha + more
            turned, along = (1j * omega, slip) if order == 1 else (1j * alpha - omega**2, 2j * omega * slip + push)
            left_open[n] -= turned * arrow.vector + along * arrow.along
            sizes[n] += abs(turned * arrow.vector) + abs(along * arrow.along)
    return left_open, sizes


# the root


def _root(loop: Loop, axes: Mapping[str, complex]) -> Root | None:
    """The closed-form root of a loop with two unknowns; None for loops that are solved together."""
    if len(loop.unknowns) != 2:
        return None
    rigid = {name: 0j for kind, name in loop.unknowns if kind == "angle"}  # in the axes of the link that it names
    along: dict[str, tuple[bool, complex, float]] = {}  # of a slide: whether it turns, unit vector, travel (m)
    known = 0j
    for arrow in loop.arrows:
        first = loop.ties[arrow.link]
        turned = axes[first].conjugate() if first in rigid else 1.0
        if ("travel", arrow.slide) in loop.unknowns:
            along[arrow.slide] = first in rigid, arrow.along * turned, arrow.travel
        elif first in rigid:
            rigid[first] += arrow.vector * turned
        else:
            known += arrow.vector
    if len(rigid) == 2:
        (name, r), (_, other) = rigid.items()
        return _two_angles(("angle", name), r, other, known, axes[name])
    if len(along) == 2:
        (_, u, _), (_, v, _) = along.values()
        sine = cross(u, v)
        travel = "travel", next(iter(along))
        return Root("loop root lines", travel, (cross(v, known), sine), 0, cross(v, known) / sine) if sine else None
    if len(rigid) != 1 or len(along) != 1:
        return None
    ((key, (turns, unit, here)),), (arm,) = along.items(), rigid.values()
    # r e^(i theta) + s u + d = 0, or where the guide turns (s u + c) e^(i theta) + d = 0
    beside, radius = (arm, known) if turns else (known, arm)
    middle, across = -dot(beside, unit), cross(unit, beside)
    rest = abs(radius) ** 2 - across**2
    sign = 1 if here >= middle else -1
    return Root("loop root travel", ("travel", key), (middle, rest), sign, middle + sign * math.sqrt(max(0.0, rest)))


def _two_angles(unknown: Coordinate, r: complex, other: complex, d: complex, axis: complex) -> Root | None:
    """|r e^(i theta) + d| = |other|: A cos + B sin = C, theta = 2 atan2(B +- sqrt(A2 + B2 - C2), A + C)."""
    if r == 0 or other == 0:
        return None
    turned = d * r.conjugate()
    a, b = 2 * turned.real, 2 * turned.imag
    c = abs(other) ** 2 - abs(r) ** 2 - abs(d) ** 2
    half_sine = math.sqrt(max(0.0, a * a + b * b - c * c))
    roots = {sign: math.remainder(2 * math.atan2(b + sign * half_sine, a + c), math.tau) for sign in (1, -1)}
    sign = min(roots, key=lambda s: abs(math.remainder(roots[s] - cmath.phase(axis), math.tau)))
    return Root("loop root angle", unknown, (a, b, c), sign, roots[sign])
