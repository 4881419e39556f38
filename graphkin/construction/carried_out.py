"""A task carried out on a board: the position, both polygons, all of it as a sheet; and again, with other errors."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from graphkin.construction.asked import show
from graphkin.construction.board import EXACT, Board, Hand, Instrument
from graphkin.construction.group_polygons import GroupPolygons
from graphkin.construction.held_still import TriangleDrawn
from graphkin.construction.polygons import RATE
from graphkin.construction.position import draw_position, place
from graphkin.construction.residues import without_residues
from graphkin.construction.sheet import DrawnGroup, Limits, Scales, Sheet, Step
from graphkin.construction.slip import NO_SLIP, Slip
from graphkin.construction.task import Task
from graphkin.frozen import dataclass
from graphkin.scene.symbol import PointRef, Symbol, Value
from graphkin.structure import Cluster, needed
from graphkin.words import Phrase

__all__ = ["GoneOn", "OnBoard", "Redrawn", "carried_out", "finished", "positioned"]


@dataclass(frozen=True)
class OnBoard:
    """What stands on a board.

    assembly : the words for each assembly
    held : what was drawn with a link held still
    """

    polygons: GroupPolygons
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
    polygons = GroupPolygons(board, task.opened, position.frame, scales, slip)
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
        made.polygons.draw(order, element)
    return made


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
    )
    return without_residues(sheet) if board.instrument.faultless else sheet


def _limits(task: Task, scales: Scales, hand: Instrument) -> Mapping[str, Limits]:
    if not task.limits:
        return {}
    from graphkin.construction.limits import limits_on_paper

    hand = EXACT if task.triangles else hand
    return limits_on_paper(task.limits, task.structure, task.elements, task.values, scales, hand)


def _drawn_groups(task: Task, polygons: GroupPolygons) -> Iterator[DrawnGroup]:
    for group in needed(task.structure, task.asked):
        if group in task.trials and isinstance(group, Cluster):
            yield polygons.drawn_group(group, task.trials[group].reduced.left_out)
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
        self.kept: list[tuple[int, GroupPolygons]] = []
        """What stood there after so many acts."""
        for order, element in what.in_order:
            self.kept.append((still.acts, made.polygons.again(still)))
            made.polygons.draw(order, element)
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
            made.polygons.draw(order, element)
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
            polygons.draw(order, element)
            self._note(polygons, number)
            self.kept.append(polygons)
        polygons = polygons.again(EXACT)
        show(polygons, what.asked)
        self._note(polygons, len(self.kept))
        self.others: dict[tuple[int, frozenset[tuple[Symbol, Value]]], GroupPolygons] = {}

    def _note(self, polygons: GroupPolygons, number: int) -> None:
        rates = [Symbol(RATE[order], link=link) for order, found in polygons.rates.items() for link in found]
        for symbol in (*(s for drawn in polygons.drawn.values() for s in drawn), *rates):
            self.found_by.setdefault(symbol, number)

    def to(self, symbol: Symbol, own: Own) -> GroupPolygons | None:
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

    def _after(self, number: int, own: Own) -> GroupPolygons:
        """What stands there after so many elements."""
        own = {s: value for s, value in own.items() if self.found_by.get(s, number + 1) <= number}
        if not own:
            return self.kept[number]
        key = number, frozenset(own.items())
        if key not in self.others:
            polygons = self._after(number - 1, own).again(EXACT)
            polygons.slip = self.slip(own)
            polygons.draw(*self.in_order[number - 1])
            while len(self.others) >= self.KEPT:
                del self.others[next(iter(self.others))]
            self.others[key] = polygons
        return self.others[key]
