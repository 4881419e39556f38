"""The assembly of every group along a straight path of driver values, by continuity, without jumping.

Dyads are followed by their discriminants; larger groups are walked from position to position.  Both go through change
points, and to the end of the motion.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from graphkin.solver.dyads import DyadSolution
from graphkin.solver.engine import group_at, least_closes, positions
from graphkin.solver.larger_groups import GroupSolved
from graphkin.solver.pose import Array, Drive
from graphkin.solver.sentences import limit_why
from graphkin.structure import Driven, Dyad, LargerGroup, Rolled, Structure
from graphkin.structure.assembly import ChangePoint, Passage, follow
from graphkin.words import Phrase

FAR = 4.0  # sizes of the mechanism that a slide driver which nothing limits is followed to either side
CLOSE = 2e-13
"""A position is found where no constraint is open by more, with lengths in the size."""
LEAST = 1e-13
BEND = 0.2
AT_END = 1e-9
BESIDE = 0.003
TOWARD = 0.75  # part of what is left to a dead point that is taken in one step
NARROW = 1e-6
"""A gap in the motion that is narrower than this (of the path) is a change point, as for groups of two links."""
At = Callable[[float, Array], tuple[GroupSolved, Array]]


@dataclass(frozen=True)
class _Walk:
    """Where a group was found along the path parameter.

    nodes, places : parameters, shape (n,), and places there, shape (n, members, 3)
    end : where its motion ends, None if it does not
    flips : change points that it passed
    """

    nodes: Array
    places: Array
    end: float | None
    flips: tuple[float, ...]

    def start(self, t: Array) -> Array:
        """Places from which Newton's method starts, shape (n, members, 3)."""
        flat = self.places.reshape(len(self.nodes), -1)
        columns = [np.interp(t, self.nodes, flat[:, k]) for k in range(flat.shape[1])]
        return np.stack(columns, axis=1).reshape(len(t), -1, 3)


def _walk_group(at: At, place: Array, size: float, end: float, most: float) -> _Walk:
    """_Walk with a tangent predictor; a step is taken only if Newton's method confirms what was predicted, or if the
    group hardly moves: then it may stop, dwell, turn back or start with a jolt, as the link that moves it does.

    Towards a dead point rates grow as one over the root of what is left to it (Seydel, Practical Bifurcation and
    Stability Analysis, ch. 2): two of them tell how much that is, and what to expect of the next step.

    The sign of the determinant tells the assembly.  Where it changes and the motion goes on in the same direction the
    group has passed a change point; where nothing is found any more the motion ends.

    Parameters
    ----------
    at : function of a parameter and a starting place to what is found there and its rate by the parameter
    most : largest step
    """
    weight = np.array([size, size, 1.0])
    here, slope = at(0.0, place)
    sense = np.sign(here.determinant[0])
    t, step = 0.0, most / 2
    nodes, places, flips = [0.0], [here.place[0]], []
    left, fresh = np.inf, True
    while t < end:
        step = min(step, end - t)
        if 2 * LEAST < TOWARD * left < step:
            step = TOWARD * left
        else:
            left = np.inf
        root = (1 - step / left) ** 0.5
        guess = places[-1] + (2 / (1 + root)) * step * slope
        there, new_slope = at(t + step, guess)
        off = float(np.max(np.abs((there.place[0] - guess) / weight)))
        moved = float(np.max(np.abs((there.place[0] - places[-1]) / weight)))
        found = there.residual[0] < CLOSE and bool(np.all(np.isfinite(new_slope)))
        steady = _bend(slope / root, new_slope, weight) < BEND
        good = found and off < min(0.03, 0.003 + 0.3 * moved) and (steady or there.same_assembly(places[-1]))
        if good and np.sign(there.determinant[0]) != sense:
            passed = _passed(at, t, places[-1], slope, step, there, new_slope, weight)
            if passed is not None:
                flips.append(passed[0])
                nodes += [x for x, _ in passed[1]]
                places += [p for _, p in passed[1]]
                sense = -sense
            good = passed is not None
        if good:
            faster = float(np.max(np.abs(new_slope / weight)) / (np.max(np.abs(slope / weight)) or 1.0)) ** 2 - 1
            left = step / faster if steady and faster > 0 else np.inf
            t, slope = t + step, new_slope
            nodes.append(t)
            places.append(there.place[0])
            # what has just been too far is not tried again at once
            step, fresh = min(most, step * (1.0 if not fresh else 2.0 if off < 0.005 else 1.2)), True
            continue
        step, fresh, left = step / 2, False, np.inf
        if step < LEAST:
            break
    if t < end and end - t < NARROW:
        # the end of the path may itself be singular, and roundings lead astray beside it: what stands there says so
        there, _ = at(end, places[-1])
        off = float(np.max(np.abs((there.place[0] - places[-1]) / weight)))
        if end - t < AT_END or (there.residual[0] < CLOSE and off < BESIDE):
            t = end
    return _Walk(np.array(nodes), np.array(places), None if t >= end else t, tuple(flips))


def _bend(slope: Array, new_slope: Array, weight: Array) -> float:
    """How much the direction of the motion changes over a step, relatively.

    At a change point the other branch leaves in another direction, however small the step.
    """
    most = max(float(np.max(np.abs(slope / weight))), float(np.max(np.abs(new_slope / weight))))
    return float(np.max(np.abs((new_slope - slope) / weight))) / (most or 1.0)


def _passed(
    at: At, t: float, place: Array, slope: Array, step: float, there: GroupSolved, new_slope: Array, weight: Array
) -> tuple[float, list[tuple[float, Array]]] | None:
    """The change point inside a step, and places close to it on both sides; None if the step is not one smooth motion.

    On the smooth motion the place is a cubic in the parameter by both ends and both rates, and the determinant goes
    through zero once.  The other branch at a change point leaves it in another direction.
    """
    last = there.place[0]

    def between(s: float) -> Array:
        return np.asarray(
            (1 + 2 * s) * (1 - s) ** 2 * place
            + s * (1 - s) ** 2 * step * slope
            + s * s * (3 - 2 * s) * last
            + s * s * (s - 1) * step * new_slope
        )

    low, high = 0.0, 1.0
    sign = -np.sign(there.determinant[0])
    for _ in range(60):
        middle = (low + high) / 2
        if (high - low) * step < NARROW / 8:
            break
        found, _ = at(t + middle * step, between(middle))
        if not found.residual[0] < CLOSE:
            # so close to the point, or in a gap: the sides decide
            break
        low, high = (middle, high) if np.sign(found.determinant[0]) == sign else (low, middle)
    flip = (low + high) / 2
    sides: list[tuple[float, Array]] = []
    far = max(high - low, NARROW / step)
    for s in (flip - 30 * far, flip - far, flip + far, flip + 30 * far):
        if not 0 < s < 1:
            continue
        found, _ = at(t + s * step, between(s))
        off = np.max(np.abs((found.place[0] - between(s)) / weight))
        expected = sign if s < flip else -sign
        if (
            not found.residual[0] < CLOSE
            or off > 1e-3 * abs(s - flip) * step + 1e-7
            or (np.sign(found.determinant[0]) != expected)
        ):
            return None
        sides.append((t + s * step, found.place[0]))
    if (high - low) * step > NARROW or len(sides) < 2:
        return None
    return t + flip * step, sides


TURN_STEP = np.radians(1.0)
TRAVEL_STEP = 1 / 200
CLUSTER_STEP = np.radians(4.0)
SWING = 0.09
"""Between two nodes no link turns by more than this (about 5 degrees)."""
OFF_FLIP = 1e-6
"""At a change point a group tells nothing; what follows it is watched this far beside it."""


@dataclass(frozen=True)
class Path:
    """A straight path of driver values, parameter 0 .. 1, with the form of each group along it.

    ``limit`` is the parameter where the motion ends (None if it does not), ``by`` the element that ends it.
    Between two ``nodes`` no link turns by more than a few degrees.
    """

    structure: Structure
    start: Array
    end: Array
    forms: Mapping[int, Callable[[Array], Array]] = field(default_factory=dict)
    flips: Array = field(default_factory=lambda: np.zeros(0))
    limit: float | None = None
    by: int | None = None
    nodes: Array = field(default_factory=lambda: np.zeros(1))
    passed: tuple[tuple[int, float], ...] = ()

    @property
    def reach(self) -> float:
        """The parameter that the motion reaches."""
        return 1.0 if self.limit is None else self.limit

    def values(self, t: Array) -> Array:
        """Driver values, shape (n, drivers)."""
        return np.asarray(self.start + t[:, None] * (self.end - self.start))

    def rescaled(self, by: float) -> Path:
        """The same way, its end so many times as far: nearer where the motion goes on, farther where it has ended."""
        forms = {i: lambda t, form=form: form(np.asarray(t) * by) for i, form in self.forms.items()}
        nodes, flips = self.nodes / by, self.flips / by
        return replace(
            self,
            end=self.start + by * (self.end - self.start),
            forms=forms,
            flips=flips[flips < 1.0],
            limit=None if self.limit is None else self.limit / by,
            passed=tuple((i, t / by) for i, t in self.passed if t / by < 1.0),
            nodes=np.append(nodes[nodes < 1.0], 1.0) if by < 1.0 else nodes,
        )

    def form(self, t: Array) -> dict[int, Array]:
        """The form of each group at these parameters, for ``positions``."""
        return {i: form(t) for i, form in self.forms.items()}

    @cached_property
    def change_points(self) -> tuple[ChangePoint, ...]:
        """Where two assemblies of a group meet on the way, and the motion went smoothly on, in the order of the way."""
        found = []
        for i, t in sorted(self.passed, key=lambda one: one[1]):
            element = self.structure.elements[i]
            if t < self.reach and element.order > 1:
                found.append(ChangePoint(element.links, tuple(self.values(np.array([t]))[0].tolist())))
        return tuple(found)

    def why_ended(self, between: tuple[float, float] | None = None) -> Phrase:
        """Why it ends, and between which values the motion runs, where that is known."""
        end = self.values(np.array([self.reach]))[0].tolist()
        return limit_why(self.structure, self.by or 0, np.flatnonzero(self.end != self.start).tolist(), end, between)

    @cached_property
    def last_forms(self) -> dict[int, Array]:
        """The form of each group at the end of the path."""
        return {i: form[0] for i, form in self.form(np.ones(1)).items()}

    def turned(self, t: Array) -> dict[str, Array]:
        """How far each link has turned from the start (rad), whole turns included, to a few degrees."""
        return {name: self.turned_of(name, t) for name in self._turned}

    def turned_of(self, link: str, t: Array) -> Array:
        """The same of one link.  Raises KeyError for a redundant one."""
        return np.asarray(np.interp(t, self.nodes, self._turned[link]))

    @cached_property
    def _turned(self) -> dict[str, Array]:
        nodes = _off_flips(self.flips, self.nodes)
        poses = positions(self.structure, self.drive(nodes), self.form(nodes), rates=False).poses
        found: dict[str, Array] = {}
        for name, pose in poses.items():
            u = np.nan_to_num(np.broadcast_to(pose.u, nodes.shape), nan=1.0)
            steps = np.angle(u[1:] * np.conj(u[:-1]))
            found[name] = np.concatenate(([0.0], np.cumsum(steps)))
        return found

    def drive(self, t: Array) -> Drive:
        """The drivers with rates by the path parameter."""
        value = self.values(t)
        return Drive(value, np.broadcast_to(self.end - self.start, value.shape), np.zeros_like(value))


def follow_path(structure: Structure, forms: Mapping[int, Array], start: Array, end: Array) -> Path:
    """Keep the assembly of every group along a straight path of driver values.

    Parameters
    ----------
    forms : the assembly at the start: the sign of a dyad, the places (members, 3) of a larger group
    start, end : driver values, shape (drivers,), SI
    """
    path = Path(structure, start, end)
    grid = np.linspace(0.0, 1.0, _steps(structure, np.abs(end - start)) + 1)
    for i, element in enumerate(structure.elements):
        if isinstance(element, Dyad):
            path = _follow_dyad(path, i, element, float(forms[i]), grid)
        elif isinstance(element, Driven) and element.rolled is not None:
            path = _follow_rolled(path, i, element.rolled, np.asarray(forms[i]), grid)
        elif isinstance(element, LargerGroup):
            path = _follow_group(path, i, np.asarray(forms[i]))
        if path.limit is not None:
            grid = np.append(grid[grid < path.limit], path.limit)
        grid = _refined(path, i, grid)
    return replace(path, nodes=grid)


def _steps(structure: Structure, span: Array) -> int:
    steps = 8
    for driver, wide in zip(structure.scene.drivers, span, strict=True):
        fine = TRAVEL_STEP * structure.scene.size if not driver.turns else TURN_STEP
        steps = max(steps, int(np.ceil(wide / fine)))
    return min(steps, 4000)


def _follow_dyad(path: Path, i: int, dyad: Dyad, sign: float, grid: Array) -> Path:
    def discriminant(t: Array) -> Array:
        t = _off_flips(path.flips, t)
        forms = {**path.form(t), i: np.asarray(sign)}
        solved = positions(path.structure, path.drive(t), forms, i + 1, rates=False).groups[i]
        assert isinstance(solved, DyadSolution)
        return np.broadcast_to(solved.discriminant, t.shape)

    def least(t: float) -> tuple[float, int] | None:
        if not all(e.explicit for e in path.structure.elements[:i]):
            return None
        forms = path.form(_off_flips(path.flips, np.array([t])))
        return least_closes(path.structure, i, forms, path.start.tolist(), path.end.tolist(), t)

    passage = follow(discriminant, grid, flips=not dyad.is_two_lines, least_closes=least)
    limit, by = (path.limit, path.by) if passage.limit is None else (passage.limit, i)
    flips = np.sort(np.append(path.flips, passage.flips))
    passed = (*path.passed, *((i, t) for t in passage.flips.tolist()))
    form = _signed(sign, passage)
    return replace(path, forms={**path.forms, i: form}, flips=flips, limit=limit, by=by, passed=passed)


def _signed(sign: float, passage: Passage) -> Callable[[Array], Array]:
    return lambda t: sign * passage.sign(t)


def _off_flips(flips: Array, t: Array) -> Array:
    for flip in flips:
        t = np.where(np.abs(t - flip) < OFF_FLIP, flip + OFF_FLIP, t)
    return t


def _refined(path: Path, i: int, grid: Array) -> Array:
    """More nodes where the links found so far turn fast."""
    for _ in range(20):
        t = _off_flips(path.flips, grid)
        poses = positions(path.structure, path.drive(t), path.form(t), i + 1, rates=False).poses
        turning = [np.broadcast_to(np.nan_to_num(p.u), grid.shape) for p in poses.values()]
        swing = np.max([np.abs(np.diff(u)) for u in turning], axis=0)
        fast = np.flatnonzero((swing > SWING) & (np.diff(grid) > OFF_FLIP))
        if not len(fast) or len(grid) > 20000:
            break
        grid = np.sort(np.append(grid, (grid[fast] + grid[fast + 1]) / 2))
    return grid


def _follow_group(path: Path, i: int, place: Array) -> Path:
    def solved(t: float, start: Array) -> tuple[GroupSolved, Array]:
        t_ = _off_flips(path.flips, np.array([t]))
        found = group_at(path.structure, path.drive(t_), {**path.form(t_), i: start[None]}, i)
        return found, found.slope

    steps = _steps(path.structure, np.abs(path.end - path.start))
    most = min(0.125, CLUSTER_STEP / TURN_STEP / steps)
    walk = _walk_group(solved, place, path.structure.scene.size, path.reach, most)
    limit, by = (path.limit, path.by) if walk.end is None else (walk.end, i)
    flips = np.sort(np.append(path.flips, walk.flips))
    passed = (*path.passed, *((i, t) for t in walk.flips))
    return replace(path, forms={**path.forms, i: walk.start}, flips=flips, limit=limit, by=by, passed=passed)


def _follow_rolled(path: Path, i: int, rolled: Rolled, form: Array, grid: Array) -> Path:
    """Count the turns of what a link rolls on."""
    t = _off_flips(path.flips, grid)
    poses = positions(path.structure, path.drive(t), path.form(t), i, rates=False).poses
    columns = []
    for k, ((kind, name), _) in enumerate(rolled.factors):
        columns.append(np.full(len(grid), form[2 * k]))
        if kind == "angle":
            u = np.nan_to_num(np.broadcast_to(poses[name].u, grid.shape), nan=1.0)
            steps = np.angle(u[1:] * np.conj(u[:-1]))
            columns.append(form[2 * k + 1] + np.concatenate(([0.0], np.cumsum(steps))))
        else:
            columns.append(np.full(len(grid), form[2 * k + 1]))

    def at(t: Array) -> Array:
        return np.stack([np.interp(t, grid, column) for column in columns], axis=1)

    return replace(path, forms={**path.forms, i: at})
