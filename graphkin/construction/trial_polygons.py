"""Trial polygons of a group larger than a dyad, superposed.

Everything is linear in a rate that is assumed.  So two polygons with two assumed rates give the true one by
proportional division of what each leaves open; with k rates left open it takes k + 1 polygons (method of superposition:
Hain, Applied Kinematics; Artobolevsky, Theory of mechanisms).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from graphkin.construction.board import Board
from graphkin.construction.group_moves import GroupMoves
from graphkin.construction.group_plan import GroupPlan
from graphkin.construction.net import Edge
from graphkin.construction.polygon_acts import Superposed, TakenOff, TrialDrawn
from graphkin.construction.polygon_pair import Order
from graphkin.construction.remarks import Magnified
from graphkin.construction.sheet import Rate
from graphkin.construction.sizes import Direction
from graphkin.construction.strokes import Aid, Vector
from graphkin.construction.terms import parts_of
from graphkin.errors import Unsolvable
from graphkin.plane import added_up, dot
from graphkin.scene.model import AngleDriver
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Cluster
from graphkin.words.written import MOST, figures, on_paper

__all__ = ["TrialPolygons"]

NAUGHT = 1e-9  # part of the largest vector that an end that meets may be off in a trial polygon
NEARER = (0.25, 0.2, 0.15, 0.1, 0.07, 0.05, 0.03, 0.02, 0.01, 0.005)  # of a rate, by which it is assumed off
SLOW = 1.2  # so many times these, of the driver's rate, where the true one is nearly naught
BEYOND = 0.08  # of the size of the true polygon, by which a trial polygon may reach beyond it


class TrialPolygons(GroupMoves):
    """Polygons with trials in which rates are assumed."""

    def _assume(self, order: Order, group: Cluster, plan: GroupPlan, rates: Sequence[float]) -> None:
        """Let links turn, or pairs slide, at assumed rates (rad/s, m/s; per second)."""
        for unknown, value in zip(plan.tried, rates, strict=True):
            kind, name = unknown.split(" ", 1)
            if kind == "omega":
                self.rates[order][name] = Rate(name, value)
                self._spread(order, name, group)
            else:
                self.tried[order, name] = value

    def _fork(self, number: int) -> Self:
        """The same polygons, for a trial of their own with the same hands."""
        made = self.again(self.board.instrument)
        made.board, made.trial = Board(self.board.instrument), number
        made.board.arms, made.board.lengths = self.board.arms, self.board.lengths
        for held, seen in made.seen.items():
            seen.board.arms, seen.board.lengths = self.board.arms, self.seen[held].board.lengths
        return made

    def _tried(
        self, order: Order, group: Cluster, plan: GroupPlan, number: int, rates: Sequence[float]
    ) -> Self:
        trial = self._fork(number)
        trial._assume(order, group, plan, rates)
        trial._complete(order, group)
        for move in plan.moves:
            trial._move(order, group, move)
        return trial

    def _trial_rates(self, order: Order, plan: GroupPlan) -> list[list[float]]:
        """The assumptions of each trial polygon: none moves in the first, then each in turn."""
        drivers = self.structure.scene.drivers
        fastest = max((abs(d.values[1]) for d in drivers if isinstance(d, AngleDriver)), default=0.0)
        if not fastest:
            travel = max((abs(d.values[1]) for d in drivers), default=0.0)
            fastest = travel / self.structure.scene.size or 1.0
        base = fastest if order == "velocity" else fastest**2
        once = [base * (1.0 if t.startswith("omega") else self.structure.scene.size) for t in plan.tried]
        return [[0.0] * len(once), *([x if i == j else 0.0 for j, x in enumerate(once)] for i in range(len(once)))]

    def _ends_apart(self, order: Order, plan: GroupPlan) -> dict[tuple[Edge, bool], float]:
        """How far ends that should meet lie apart (mm) after a trial: along each edge, and square to it."""
        found: dict[tuple[Edge, bool], float] = {}
        for ref in plan.net.nodes:
            for edge in plan.net.edges[ref]:
                bare = edge.slide is not None and edge.slide.pin is None  # no point of it is a joint
                if edge.forward and (bare or plan.net.natural >= {edge.start, edge.end}):
                    for across in (False, True):
                        value = self._apart(order, edge, across)
                        if value is not None:
                            found[edge, across] = value
        return found

    def _apart(self, order: Order, edge: Edge, across: bool) -> float | None:
        whole = replace(edge, unknown="")
        parts = parts_of(self, order, whole)
        missing = self.end(order, edge.end) - self.end(order, edge.start)
        missing -= added_up((p.span for p in parts if p.span is not None), 0j)
        if not across and any(p.span is None for p in parts):
            return None
        return dot(missing, self._measured_along(edge, across))

    def _measured_along(self, edge: Edge, across: bool) -> complex:
        """Direction in which what an edge leaves open is measured: along it, or square to it."""
        way = self._way(edge, self.places)
        way = way if edge.slide is not None or edge.contact else -1j * way
        return 1j * way if across else way

    def _taken_off(self, order: Order, edge: Edge, across: bool) -> Iterator[TakenOff]:
        """What is known of an edge and has a part in the direction in which it is left open."""
        way = self._measured_along(edge, across)
        parts = parts_of(self, order, replace(edge, unknown=""))
        for p in parts:
            if p.span and abs(dot(p.span, way)) > NAUGHT * abs(p.span):
                yield TakenOff(p.symbol, p.size, dot(p.span, way))

    def _judged(self, order: Order, group: Cluster, plan: GroupPlan) -> tuple[float, GroupPlan]:
        """How well a group is found by some trials (0: not at all; at most the root of how many rates are assumed), and
        the ends by which the true rates are known."""
        try:
            trials = [
                self._tried(order, group, plan, i + 1, rates)
                for i, rates in enumerate(self._trial_rates(order, plan))
            ]
            rows = [trial._ends_apart(order, plan) for trial in trials]
        except Unsolvable:
            return 0.0, plan
        keys = [k for k in rows[0] if all(k in row for row in rows)]
        slopes = np.array([[row[k] - rows[0][k] for row in rows[1:]] for k in keys])
        scale = max((abs(v) for trial in trials for v in trial.ends[order].values()), default=0.0)
        scale = max(scale, float(np.abs(slopes).max(initial=0.0)))
        chosen: list[int] = []
        left = slopes.copy()
        quality = 1.0
        for _ in plan.tried:
            sizes = np.hypot.reduce(left, axis=1) if len(left) else np.zeros(1)
            best = int(np.argmax(sizes))
            if not len(left) or sizes[best] <= NAUGHT * scale:
                return 0.0, plan
            quality = min(quality, float(sizes[best]) / scale)
            chosen.append(best)
            e = left[best] / sizes[best]
            left = left - np.outer(left @ e, e)
        return quality, replace(plan, open_ends=tuple(keys[i] for i in chosen))

    def _with_assumptions(self, order: Order, group: Cluster, plan: GroupPlan) -> GroupPlan:
        """A plan with rates to assume that make the trial polygons about as large as the true one: round ones on either
        side of it, all on the one side in the first trial, each in its turn on the other in those that follow; the
        nearer to the true ones, the further a trial polygon would reach beyond the true one."""
        if order in plan.assumed:
            return plan
        once = self._trial_rates(order, plan)
        trials = [self._tried(order, group, plan, 1, assumed) for assumed in once]
        true = _divided(once, [self._open(order, plan, trial) for trial in trials])
        reach = _Reach([trial.drawn[order] for trial in trials], once)
        most = reach.at(true) + BEYOND * reach.size(true)
        # what hardly moves is tried by a part of the driver's rate
        bases = (rates[i] for i, rates in enumerate(once[1:]))
        ways = [SLOW * base if abs(x) <= 0.05 * abs(base) else x for x, base in zip(true, bases, strict=True)]

        def fitting(choices: Iterable[list[float]]) -> list[float]:
            for row in choices:
                if (reach.at(row) <= most).all():
                    break
            return row

        low = fitting([_round(x, -share * way) for x, way in zip(true, ways, strict=True)] for share in NEARER)
        fair = [low]
        for i, (x, way) in enumerate(zip(true, ways, strict=True)):
            fair.append(fitting([*low[:i], _round(x, share * way), *low[i + 1 :]] for share in NEARER))
        return replace(plan, assumed={**plan.assumed, order: tuple(map(tuple, fair))})

    def _open(self, order: Order, plan: GroupPlan, trial: Self) -> list[float]:
        """What a trial leaves open (mm, or as read)."""
        return [trial._apart(order, *one) or 0.0 for one in plan.open_ends]

    def _true_rates(self, order: Order, group: Cluster, plan: GroupPlan) -> list[float]:
        """The true rates by proportional division of what trial polygons leave open."""
        rates = plan.assumed[order]
        apart: list[list[float]] = []
        ends: list[dict[PointRef, complex]] = []
        far = plan.far and replace(plan.far, away=plan.far.away * self.scales.length)
        for number, assumed in enumerate(rates, 1):
            trial = self._tried(order, group, plan, number, assumed)
            apart.append([self.board.instrument.read(mm) for mm in self._open(order, plan, trial)])
            ends.append(trial.ends[order])
            # special points are marked on the mechanism by the trial that meets them first
            self.special, self.places, self.links = trial.special, trial.places, trial.links
            for step in trial.board.steps:
                if step.diagram == "mechanism":
                    self.board.do("mechanism", step.act, *step.strokes)
            steps = [step for step in trial.board.steps if step.diagram == order]
            strokes = [replace(s, trial=number) for step in steps for s in step.strokes if isinstance(s, Aid)]
            self.board.do(order, TrialDrawn(number, self._named(order, plan, assumed), far), *strokes)
        self.board.notice(order, Magnified(group.links, _magnified(ends, apart)))
        found = self._noted(plan, rates, apart)
        closing = tuple(e.link or (e.slide.key if e.slide else "") for e, _ in plan.open_ends)
        ways = tuple(_left_open(e, across) for e, across in plan.open_ends)
        between = tuple((self.label(e.labels[0]), self.label(e.labels[1])) for e, _ in plan.open_ends)
        less = tuple(tuple(trial._taken_off(order, *one)) for one in plan.open_ends)
        named = self._named(order, plan, found)
        self.board.do(order, Superposed(named, closing, tuple(map(tuple, apart)), ways, between, less))
        return found

    def _noted(
        self, plan: GroupPlan, rates: Sequence[Sequence[float]], apart: Sequence[Sequence[float]]
    ) -> list[float]:
        """The divided rates as they are written down: the way from the first that was assumed with the figures of the
        lengths that are divided, of several parts with as many as such have."""
        noted, made = self.board.instrument.noted, []
        for i, (unknown, rate) in enumerate(zip(plan.tried, _divided(rates, apart), strict=True)):
            unit = 1.0 if unknown.startswith("omega") else self.structure.scene.units.rates.metres
            low, more = rates[0][i] / unit, (rates[i + 1][i] - rates[0][i]) / unit
            if len(plan.tried) == 1:
                lengths = on_paper(apart[0][0]), on_paper(apart[0][0] - apart[1][0])
                added = noted(rate / unit - low, figures(*lengths))
            else:
                added = noted((rate / unit - low) / more, MOST - 1) * more
            made.append(noted(low + added, MOST) * unit)
        return made

    def _named(self, order: Order, plan: GroupPlan, values: Sequence[float]) -> tuple[tuple[Symbol, float], ...]:
        """Rates by their symbols, in scene units."""
        named = []
        metres = self.structure.scene.units.rates.metres
        for unknown, value in zip(plan.tried, values, strict=True):
            kind, name = unknown.split(" ", 1)
            if kind == "omega":
                named.append((Symbol("omega" if order == "velocity" else "alpha", link=name), value))
                continue
            slide = self.structure.slide(name)
            point = slide.pin or next(iter(self.links[slide.a].points), "")
            of, to = self.label(PointRef(point, slide.a)), self.label(PointRef(point, slide.b))
            named.append((Symbol("v" if order == "velocity" else "ar", of, to), value / metres))
        return tuple(named)


def _left_open(edge: Edge, across: bool) -> Direction:
    """Along which direction a trial leaves an edge open."""
    names = (edge.start.point, edge.end.point) if edge.link else edge.direction.names
    return Direction("square" if across else "along", names)


def _divided(rates: Sequence[Sequence[float]], apart: Sequence[Sequence[float]]) -> list[float]:
    """The rates at which nothing is left open, from trials that each differ from the first in one rate: proportional
    division."""
    first = np.array(apart[0])
    slopes = np.array([np.array(row) - first for row in apart[1:]]).T
    part = np.linalg.solve(slopes, -first)
    return [float(rates[0][i] + x * (rates[i + 1][i] - rates[0][i])) for i, x in enumerate(part)]


def _magnified(ends: Sequence[Mapping[PointRef, complex]], apart: Sequence[Sequence[float]]) -> float:
    """How far an end point moves, at most, for what is left open in a trial."""
    first = np.array(apart[0])
    slopes = np.array([np.array(row) - first for row in apart[1:]]).T
    inverse = np.linalg.inv(slopes)
    moved = [[end[ref] - z for end in ends[1:]] for ref, z in ends[0].items() if all(ref in end for end in ends)]
    return float(np.abs(np.array(moved) @ inverse).max(initial=0.0))


class _Reach:
    """How far a polygon reaches to each side of its pole, whatever is assumed: every vector of it is linear in that."""

    def __init__(self, drawn: Sequence[Mapping[Symbol, Vector]], rates: Sequence[Sequence[float]]) -> None:
        shared = [symbol for symbol in drawn[0] if all(symbol in one for one in drawn)]
        ends = np.array([[0j, *(z for s in shared for z in (one[s].tail, one[s].tip))] for one in drawn])
        self.rest = ends[0]
        self.slopes = (ends[1:] - ends[0]) / np.diag(np.array(rates[1:]))[:, None]

    def at(self, rates: Sequence[float]) -> NDArray[np.float64]:
        """Right, up, left and down (mm)."""
        ends = self.rest + np.array(rates) @ self.slopes
        return np.array([np.max((ends * turn).real) for turn in (1, -1j, -1, 1j)])

    def size(self, rates: Sequence[float]) -> float:
        """Of width and height the larger (mm)."""
        right, up, left, down = self.at(rates)
        return float(max(right + left, up + down))


def _round(value: float, step: float) -> float:
    """About a step off a value, with as few figures as that takes: easy to lay off."""
    wanted = value + step
    for carried in range(1, 9):
        found = float(f"{wanted:.{carried}g}")
        if abs(found - wanted) <= 0.35 * abs(step):
            return found
    return wanted
