"""A task carried out on a board: the position, both polygons, the vectors that only a question asks for, all of it as a
sheet; and again, with other errors."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from graphkin.construction.board import EXACT, Board, Hand, Instrument
from graphkin.construction.elements import draw_element
from graphkin.construction.inversion import Inversion, TriangleDrawn
from graphkin.construction.larger_groups import draw_group, drawn_group
from graphkin.construction.net import TwoUnknowns, node
from graphkin.construction.polygon_acts import Asked
from graphkin.construction.polygons import RATE, Polygons
from graphkin.construction.position import draw_position, place
from graphkin.construction.seen_from import seen
from graphkin.construction.sheet import ORDERS, DrawnGroup, Limits, Order, Scales, Sheet, Step, either_way
from graphkin.construction.slip import NO_SLIP, Slip
from graphkin.construction.strokes import Vector
from graphkin.construction.touching import Touching
from graphkin.construction.zero_vectors import without_residues
from graphkin.errors import CallError, Problem
from graphkin.plane import dot, unit
from graphkin.scene.symbol import PointRef, Symbol, Value
from graphkin.structure import Cluster, Dyad, Element, Structure, links_of, needed
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.construction.group_plan import GroupPlan
    from graphkin.construction.group_position import GroupTrial

__all__ = ["GoneOn", "OnBoard", "Redrawn", "Task", "carried_out", "finished", "positioned"]




@dataclass(frozen=True)
class OnBoard:
    """What stands on a board.

    assembly : the words for each assembly
    held : what was drawn with a link held still
    """

    polygons: Polygons
    assembly: Mapping[str, Phrase]
    held: tuple[Step, ...]


def positioned(
    task: Task, scales: Scales, instrument: Instrument = EXACT, slip: Slip = NO_SLIP, with_steps: bool = True
) -> OnBoard:
    """The position on a board, on which no polygon is begun; its steps, of which no reading is taken, only where it is
    are wanted."""
    board = Board(instrument)
    found: list[TriangleDrawn] = []
    values, rates = dict(task.values), dict[str, tuple[float, float]]()
    for inversion, branch in task.triangles:
        carried = inversion.drawn(instrument, scales, task.values, branch)
        values[inversion.key] = inversion.near(task.values[inversion.key], carried.value)
        rates[inversion.key] = carried.rate, carried.second
        found.append(carried)
    board.causes += [cause for carried in found for cause in carried.causes]
    before = list(board.causes)
    told = [part for carried in found for part in carried.carried_over()]
    position = place(task.opened, task.elements, 1.0 / scales.length, values, task.branches, instrument, task.trials)
    assembly: Mapping[str, Phrase] = {}
    if with_steps:
        assembly = draw_position(board, task.opened, task.elements, position, task.branches, task.trials)
    board.causes[:] = [*before, *position.causes]
    polygons = Polygons(board, task.opened, position.frame, scales, slip)
    polygons.given.update(rates)
    polygons.at_contacts = task.touching
    polygons.chains.update(task.chains)
    polygons.plans.update(task.plans)
    for name, act in told:
        board.do(name, act)
    return OnBoard(polygons, assembly, tuple(step for carried in found for step in carried.steps))


def carried_out(task: Task, scales: Scales, instrument: Instrument = EXACT, slip: Slip = NO_SLIP) -> OnBoard:
    """Position and both polygons on a board."""
    made = positioned(task, scales, instrument, slip)
    for order, element in task.in_order:
        draw(made.polygons, order, element)
    return made


def draw(polygons: Polygons, order: Order, element: Element) -> None:
    """Draw what an element adds to a polygon."""
    if isinstance(element, Cluster):
        draw_group(polygons, order, element)
    else:
        draw_element(polygons, order, element)


def finished(task: Task, made: OnBoard) -> Sheet:
    """What stands on the board as a sheet, with the vectors that only a question asks for."""
    polygons = made.polygons
    show(polygons, task.asked)
    board = polygons.board
    sheet = Sheet(
        scene=task.structure.scene,
        structure=task.structure,
        instrument=board.instrument.name,
        drivers={d.key: task.values[d.key] for d in task.structure.scene.drivers},
        scales=polygons.scales,
        poses=dict(polygons.frame.poses),
        points={PointRef(p): z for p, z in polygons.places.items()},
        ends={order: dict(ends) for order, ends in polygons.ends.items()},
        omega=dict(polygons.rates["velocity"]),
        alpha=dict(polygons.rates["acceleration"]),
        steps=tuple(board.steps),
        held_still=made.held,
        equations=tuple(board.equations),
        assembly=made.assembly,
        noticed=tuple(board.noticed),
        left_out=task.left_out,
        groups=tuple(_drawn_groups(task, polygons)),
        causes=tuple(board.causes) if board.instrument.acts else (),
        asked=task.asked,
        acting=task.acting,
        growing=task.growing,
        trains=tuple(polygons.wheels.drawn.values()),
        limits=_limits(task, polygons.scales, board.instrument),
        readings=_readings(polygons),
    )
    return without_residues(sheet) if board.instrument.faultless else sheet


def _readings(polygons: Polygons) -> Mapping[Symbol | frozenset[str], float]:
    read: tuple[Mapping[frozenset[str], float] | Mapping[Symbol, float], ...]
    read = polygons.board.arms, polygons.board.lengths
    found: dict[Symbol | frozenset[str], float] = {thing: mm for kept in read for thing, mm in kept.items()}
    for held, apart in polygons.seen.items():
        found |= {either_way(seen(symbol, held)): mm for symbol, mm in apart.board.lengths.items()}
    return found


def _limits(task: Task, scales: Scales, hand: Instrument) -> Mapping[str, Limits]:
    if not task.limits:
        return {}
    from graphkin.construction.limits import limits_on_paper

    hand = EXACT if task.triangles else hand
    return limits_on_paper(task.limits, task.structure, task.elements, task.values, scales, hand)


def _drawn_groups(task: Task, polygons: Polygons) -> Iterator[DrawnGroup]:
    for group in needed(task.structure, task.asked):
        if group in task.trials and isinstance(group, Cluster):
            yield drawn_group(polygons, group, task.trials[group].reduced.left_out)
        elif isinstance(group, Cluster):
            # with one link held still its motion relative to that link is found, and laid over that link's motion
            yield DrawnGroup(group, "superposition", (), (), (), ())


class Redrawn:
    """A plan that is drawn again and again by hands that err in some of their acts.

    What stands before the first of these is taken from a drawing without errors.
    """

    def __init__(self, what: Task, scales: Scales, still: Hand) -> None:
        self.what, self.scales = what, scales
        made = positioned(what, scales, still)
        self.kept: list[tuple[int, Polygons]] = []
        """What stood there after so many acts."""
        for order, element in what.in_order:
            self.kept.append((still.acts, made.polygons.again(still)))
            draw(made.polygons, order, element)
        self.kept.append((still.acts, made.polygons.again(still)))
        self.sheet = finished(what, made)

    def by(self, hand: Hand, first: int = 0) -> Sheet:
        """The drawing of hands that err in no act before the ``first``; readings may be taken of it, the steps of its
        position may be missing.  Raises as `execute`."""
        before = [(acts, polygons) for acts, polygons in self.kept if acts < first]
        if not before:
            made = positioned(self.what, self.scales, hand, with_steps=False)
            left = [*self.what.in_order]
        else:
            hand.acts, polygons = before[-1]
            made = OnBoard(polygons.again(hand), {}, ())
            left = [*self.what.in_order][len(before) - 1 :]
        for order, element in left:
            draw(made.polygons, order, element)
        return finished(self.what, made)


Own = Mapping[Symbol, Value]


class GoneOn:
    """A plan gone on with from values of somebody's own, in place of drawn ones: one person's after the other's.

    ``slip`` says what own values change.  What stands before the first of them is taken from the drawing without any,
    and what some of them gave is kept while they are the same.
    """

    KEPT = 256

    def __init__(self, what: Task, scales: Scales, slip: Callable[[Own], Slip]) -> None:
        self.what, self.slip = what, slip
        self.in_order = tuple(what.in_order)
        polygons = positioned(what, scales, with_steps=False).polygons
        self.kept = [polygons]
        """What stands there after so many elements."""
        self.found_by: dict[Symbol, int] = {}
        """How many elements lead to each vector and rate; one more than there are, to what only a question asks for."""
        for number, (order, element) in enumerate(self.in_order, 1):
            polygons = polygons.again(EXACT)
            draw(polygons, order, element)
            self._note(polygons, number)
            self.kept.append(polygons)
        polygons = polygons.again(EXACT)
        show(polygons, what.asked)
        self._note(polygons, len(self.kept))
        self.others: dict[tuple[int, frozenset[tuple[Symbol, Value]]], Polygons] = {}

    def _note(self, polygons: Polygons, number: int) -> None:
        rates = [Symbol(RATE[order], link=link) for order, found in polygons.rates.items() for link in found]
        for symbol in (*(s for drawn in polygons.drawn.values() for s in drawn), *rates):
            self.found_by.setdefault(symbol, number)

    def to(self, symbol: Symbol, own: Own) -> Polygons | None:
        """The polygons as far as a vector or rate stands in them; None where nothing leads to it.  Raises as
        `execute`."""
        number = self.found_by.get(symbol)
        if number is None:
            return None
        if number < len(self.kept):
            return self._after(number, own)
        polygons = self._after(number - 1, own).again(EXACT)
        show(polygons, self.what.asked)
        return polygons

    def _after(self, number: int, own: Own) -> Polygons:
        """What stands there after so many elements."""
        own = {s: value for s, value in own.items() if self.found_by.get(s, number + 1) <= number}
        if not own:
            return self.kept[number]
        key = number, frozenset(own.items())
        if key not in self.others:
            polygons = self._after(number - 1, own).again(EXACT)
            polygons.slip = self.slip(own)
            draw(polygons, *self.in_order[number - 1])
            while len(self.others) >= self.KEPT:
                del self.others[next(iter(self.others))]
            self.others[key] = polygons
        return self.others[key]


def show(plot: Polygons, asked: Sequence[Symbol]) -> None:
    """Draw the vectors that are asked for and stand in no equation."""
    for symbol in asked:
        if symbol.is_vector:
            _show(plot, symbol)


def _show(plot: Polygons, symbol: Symbol) -> None:
    order: Order = "velocity" if symbol.kind == "v" else "acceleration"
    if symbol in plot.drawn[order] or symbol.of is None:
        return
    of = _node(plot, symbol.of)
    to = _node(plot, symbol.to) if symbol.to else None
    if not _reachable(plot, of) or (to and not _reachable(plot, to)):
        return
    tail, tip = (plot.end(order, to) if to else 0j), plot.end(order, of)
    if symbol.kind in ("v", "a"):
        _draw(plot, order, Vector(symbol, tail, tip, "relative" if to else "resultant"))
    elif symbol.kind in ("an", "at"):
        _split(plot, symbol, of, to)
    else:
        _coincident(plot, symbol, of, to)


def _node(plot: Polygons, ref: PointRef) -> PointRef:
    return node(plot.links, ref.point, ref.link) if ref.link else ref


def _reachable(plot: Polygons, ref: PointRef) -> bool:
    names = [ref.link] if ref.link else [n for n, k in plot.links.items() if ref.point in k.points]
    return ref.point in plot.places and any(n in plot.rates["velocity"] for n in names)


def _draw(plot: Polygons, order: Order, vector: Vector) -> None:
    plot.drawn[order][vector.symbol] = vector
    plot.board.do(order, Asked(vector.symbol), vector)


def _split(plot: Polygons, symbol: Symbol, of: PointRef, to: PointRef | None) -> None:
    """Normal and tangential part of a relative acceleration: along the bar and square to it."""
    if to is None:
        to = _pivot(plot, of)
    tail, tip = plot.end("acceleration", to), plot.end("acceleration", of)
    arm = plot.places[of.point] - plot.places[to.point]
    if any(c.rolling and c.name == of.point == to.point for c in plot.structure.scene.contacts):
        arm = Touching(plot.structure.scene, plot.frame.mm, plot.frame.poses).rolling_centres(of.point)[1]
    elif abs(arm) <= plot.tiny:
        raise CallError(
            Problem(
                str(symbol),
                Phrase("the two points coincide no line joins them"),
                Phrase("ask for ak and ar of coincident points"),
            )
        )
    along = unit(arm)
    foot = tail + along * dot(tip - tail, along)
    if symbol.kind == "an":
        _draw(plot, "acceleration", Vector(symbol, tail, foot, "normal"))
    else:
        _draw(plot, "acceleration", Vector(symbol, foot, tip, "tangential"))


def _pivot(plot: Polygons, of: PointRef) -> PointRef:
    names = [of.link] if of.link else [n for n, k in plot.links.items() if of.point in k.points]
    ground = plot.links[plot.ground]
    for name in names:
        for point in plot.links[name].points:
            if point in ground.points and point != of.point:
                return PointRef(point)
    raise CallError(
        Problem(
            f"{of}",
            Phrase("its link has no fixed pivot to which"),
            Phrase("name the other point too for example an_c"),
        )
    )


def _coincident(plot: Polygons, symbol: Symbol, of: PointRef, to: PointRef | None) -> None:
    """Coriolis and sliding part for two coincident points that stand in no equation."""
    assert to is not None
    pair = _pair(plot, of, to, symbol)
    tail, tip = plot.end("acceleration", to), plot.end("acceleration", of)
    slip = plot.end("velocity", of) - plot.end("velocity", to)
    omega = plot.rates["velocity"][pair].value
    corner = tail + 2j * omega * slip * (plot.scales.velocity / plot.scales.acceleration)
    if symbol.kind == "ak":
        _draw(plot, "acceleration", Vector(symbol, tail, corner, "coriolis"))
    else:
        _draw(plot, "acceleration", Vector(symbol, corner, tip, "sliding"))


def _pair(plot: Polygons, of: PointRef, to: PointRef, symbol: Symbol) -> str:
    """The guide of the sliding pair between two coincident points; of links of a group the one it is seen from."""
    for s in plot.structure.slides:
        sides = {node(plot.links, of.point, s.a), node(plot.links, of.point, s.b)}
        if sides == {of, to}:
            return s.b
    seen = {ref.link for ref in (symbol.of, symbol.to) if ref}
    if symbol.to and any(isinstance(g, Cluster) and seen <= {*g.members} for g in plot.structure.groups):
        return symbol.to.link  # links of a group that are drawn as one, seen from one of them
    known = ", ".join(s.key for s in plot.structure.slides)
    raise CallError(
        Problem(
            str(symbol),
            Phrase("these two points do not lie on the"),
            Phrase("known are", names=known) if known else Phrase("this mechanism has none"),
        )
    )


# -- what is to be drawn -----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Task:
    """What is to be drawn, at which position, in which assembly, and by which equation for each dyad.

    ``opened`` is the structure with groups that driven triangles turn into dyads in their parts, ``triangles`` are
    these, each with its assembly; ``values`` are the drivers', those at the triangles' pairs included; ``limits`` are
    the limit positions of what is asked, on paper of the mechanism's size.  ``acting`` and ``growing`` as in `Sheet`.
    With ``touching`` sliding contacts are drawn themselves, not what replaces them.
    """

    structure: Structure
    opened: Structure
    asked: tuple[Symbol, ...]
    elements: tuple[Element, ...]
    values: Mapping[str, float]
    branches: Mapping[int, int]
    trials: Mapping[Cluster, GroupTrial]
    chains: Mapping[Dyad, TwoUnknowns]
    plans: Mapping[Cluster, GroupPlan]
    triangles: tuple[tuple[Inversion, int], ...]
    limits: Mapping[str, Limits]
    acting: Mapping[str, bool | None]
    growing: tuple[Sheet, ...]
    touching: bool = field(default=False, kw_only=True)

    @cached_property
    def drawn(self) -> Mapping[Order, tuple[Element, ...]]:
        """What each polygon needs for what is asked: accelerations only of what leads to accelerations."""
        pushes = [s for s in self.asked if s.measure in ("acceleration", "angular acceleration")]
        wanted = needed(self.opened, pushes) if pushes else []
        every = not self.asked or any(s.scope in ("force", "cycle") for s in self.asked)
        pushed = self.elements if every else tuple(e for e in self.elements if e in wanted)
        return {"velocity": self.elements, "acceleration": pushed}

    @cached_property
    def left_out(self) -> tuple[Phrase, ...]:
        """What nothing asked for needs."""
        wanted = needed(self.opened, self.asked)
        placed = {n for e in self.elements for n in links_of(e)}
        pushed = {n for e in self.drawn["acceleration"] for n in links_of(e)}
        gone = {n for e in self.opened.elements if e not in wanted for n in links_of(e)}
        names = [link.name for link in self.structure.scene.links]
        without = [n for n in names if n in gone], [n for n in names if n in placed - pushed]
        keys = "left out elements", "left out accelerations"
        return tuple(Phrase(key, (", ".join(links),)) for key, links in zip(keys, without, strict=True) if links)

    @property
    def in_order(self) -> Iterator[tuple[Order, Element]]:
        """What is drawn in the polygons, element by element."""
        for order in ORDERS:
            for element in self.drawn[order]:
                yield order, element
