"""The assembly of every group along a straight path of driver values, by continuity, without jumping.

Dyads are followed by their discriminants; larger groups are walked from position to position.  Both pass change points,
and stop at the end of the motion.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from operator import itemgetter

import numpy as np

from graphkin.search import extrapolated
from graphkin.solver.algebra.dyads import TOUCH
from graphkin.solver.algebra.larger_groups import GroupSolved
from graphkin.solver.algebra.pose import Array
from graphkin.solver.compiled.engine import group_at
from graphkin.solver.path.driver_path import OFF_FLIP, START, Path, Stretch, closed, stretches, turning
from graphkin.structure import Dyad, LargerGroup, RollingRelation, Structure

CLOSE = 2e-13
"""A position is found where no constraint is open by more, with lengths in the size."""
LEAST = 1e-13
BEND = 0.2
FAR = 3.0
"""Beyond so many sizes of the mechanism the places of links that go away count in parts of their distance."""
AT_END = 1e-9
BESIDE = 0.003
TOWARD = 0.75  # part of what is left to a dead point that is taken in one step
EXTRAPOLATED, APART = 7, 1.5
"""Nodes from which the end of a motion is extrapolated; each has so many times the determinant of the next at least."""
SETTLED = 0.01
"""Of the way from the last node to the end: so far the last two extrapolations may differ."""
NARROW = 1e-6
"""A gap in the motion that is narrower than this (of the path) is a change point, as for groups of two links."""
At = Callable[[float, Array], tuple[GroupSolved, Array]]


def _interpolated(nodes: Array, values: Array, t: Array) -> Array:
    """The values at path parameters: linear between those at the nodes, shape (nodes, ...)."""
    columns = [np.interp(t, nodes, column) for column in values.reshape(len(nodes), -1).T]
    return np.stack(columns, axis=1).reshape(len(t), *values.shape[1:])


def _flipped(sign: float, flips: Array, t: Array) -> Array:
    """The assembly mode of a dyad at path parameters, which changes at each change point."""
    return sign * np.where(np.searchsorted(flips, t) % 2, -1.0, 1.0)


def _walk_group(
    at: At, place: Array, size: float, end: float, most: float
) -> tuple[Array, Array, float | None, tuple[float, ...]]:
    """Walk with a tangent predictor; a step is taken only if Newton's method confirms the prediction, or if the group
    hardly moves: then it may stop, dwell, turn back or start with a jolt, as its driving link does.

    Towards a dead point rates grow as one over the root of the distance to it (Seydel, Practical Bifurcation and
    Stability Analysis, ch. 2): two of them give that distance, and the prediction for the next step.

    The sign of the determinant tells the assembly.  Where it changes and the motion continues in the same direction the
    group has passed a change point; where Newton's method fails the motion ends.

    Parameters
    ----------
    at : function of a parameter and a starting place to the solution there and its rate by the parameter
    most : largest step

    Returns
    -------
    nodes, places : parameters, shape (n,), and places there, shape (n, members, 3)
    end : the parameter at which the motion ends, None if it does not end
    flips : the change points that it passed
    """
    weight = np.array([size, size, 1.0])
    here, slope = at(0.0, place)
    sense = np.sign(here.determinant[0])
    t, step = 0.0, most / 2
    nodes, places, flips = [0.0], [here.place[0]], []
    determinants = [float(here.determinant[0])]
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
        misfit = float(np.max(np.abs((there.place[0] - guess) / weight)))
        moved = float(np.max(np.abs((there.place[0] - places[-1]) / weight)))
        closed = there.residual[0] < CLOSE and bool(np.all(np.isfinite(new_slope)))
        steady = _bend(slope / root, new_slope, weight) < BEND
        good = closed and misfit < min(0.03, 0.003 + 0.3 * moved) and (steady or there.same_assembly(places[-1]))
        if good and np.sign(there.determinant[0]) != sense:
            passed = _passed(at, t, places[-1], slope, step, there, new_slope, weight)
            if passed is not None:
                flips.append(passed[0])
                nodes += [x for x, _ in passed[1]]
                places += [p for _, p in passed[1]]
                determinants = []
                sense = -sense
            good = passed is not None
        if good:
            faster = float(np.max(np.abs(new_slope / weight)) / (np.max(np.abs(slope / weight)) or 1.0)) ** 2 - 1
            left = step / faster if steady and faster > 0 else np.inf
            t, slope = t + step, new_slope
            nodes.append(t)
            places.append(there.place[0])
            determinants.append(float(there.determinant[0]))
            weight[:2] = max([size, *(float(abs(pose.z[0])) / FAR for pose in there.poses.values())])
            # what has just been too far is not tried again at once
            step, fresh = min(most, step * (1.0 if not fresh else 2.0 if misfit < 0.005 else 1.2)), True
            continue
        step, fresh, left = step / 2, False, np.inf
        if step < LEAST:
            break
    if t < end and end - t < NARROW:
        # the end of the path may itself be singular, and roundings lead astray beside it: what stands there says so
        there, _ = at(end, places[-1])
        misfit = float(np.max(np.abs((there.place[0] - places[-1]) / weight)))
        if end - t < AT_END or (there.residual[0] < CLOSE and misfit < BESIDE):
            t = end
    stop = None if t >= end else min(_singular_ahead(nodes[-len(determinants) :], determinants), end)
    return np.array(nodes), np.array(places), stop, tuple(flips)


def _singular_ahead(nodes: Sequence[float], determinants: Sequence[float]) -> float:
    """The parameter beyond the last node at which the determinant goes to zero; the last node if it cannot be told.

    It goes as the root of the distance where links turn back, as the distance where they go away without bound, or as a
    product of these: the parameter is smooth in a root of it, by which it is extrapolated (Neville's scheme).
    """
    last, chosen = float(nodes[-1]), list[tuple[float, float]]()
    for t, determinant in zip(nodes[::-1], np.abs(determinants[::-1]).tolist(), strict=True):
        if determinant > (APART * chosen[-1][1] if chosen else 0.0):
            chosen.append((float(t), determinant))
    if len(chosen) < EXTRAPOLATED:
        return last
    (near, less), (far, more) = chosen[EXTRAPOLATED // 2], chosen[EXTRAPOLATED - 1]
    places, sizes = zip(*chosen[:EXTRAPOLATED], strict=True)
    first, _ = extrapolated(places, sizes)
    if not last <= first <= 2 * last - far:
        return last
    power = round(2 * math.log(more / less) / math.log((first - far) / (first - near)))
    roots = {0: (), 2: (1, 2)}.get(power, (power,))
    ends = (extrapolated(places, [size ** (1 / root) for size in sizes]) for root in roots)
    end, error = min(ends, key=itemgetter(1), default=(last, 0.0))
    return end if last <= end <= 2 * last - far and error < SETTLED * (end - last) + LEAST else last


def _bend(slope: Array, new_slope: Array, weight: Array) -> float:
    """The relative change of the motion's direction over a step.

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
        solved, _ = at(t + middle * step, between(middle))
        if not solved.residual[0] < CLOSE:
            # so close to the point, or in a gap: the sides decide
            break
        low, high = (middle, high) if np.sign(solved.determinant[0]) == sign else (low, middle)
    flip = (low + high) / 2
    sides: list[tuple[float, Array]] = []
    far = max(high - low, NARROW / step)
    for s in (flip - 30 * far, flip - far, flip + far, flip + 30 * far):
        if not 0 < s < 1:
            continue
        solved, _ = at(t + s * step, between(s))
        misfit = np.max(np.abs((solved.place[0] - between(s)) / weight))
        expected = sign if s < flip else -sign
        if (
            not solved.residual[0] < CLOSE
            or misfit > 1e-3 * abs(s - flip) * step + 1e-7
            or (np.sign(solved.determinant[0]) != expected)
        ):
            return None
        sides.append((t + s * step, solved.place[0]))
    if (high - low) * step > NARROW or len(sides) < 2:
        return None
    return t + flip * step, sides


TURN_STEP = np.radians(1.0)
TRAVEL_STEP = 1 / 200
GROUP_STEP = np.radians(4.0)
SWING = 0.09
"""Between two nodes no link turns by more than this (about 5 degrees)."""


def follow_path(structure: Structure, modes: Mapping[int, Array], start: Array, end: Array) -> Path:
    """Keep the assembly of every group along a straight path of driver values.

    Parameters
    ----------
    modes : the assembly at the start: the sign of a dyad, the places (members, 3) of a larger group
    start, end : driver values, shape (drivers,), SI
    """
    path = Path(structure, start, end)
    grid = np.linspace(0.0, 1.0, _steps(structure, np.abs(end - start)) + 1)
    for i, element in enumerate(structure.elements):
        if isinstance(element, Dyad):
            path = _follow_dyad(path, i, element, float(modes[i]))
        elif element.rolled is not None:
            path = _follow_rolled(path, i, element.rolled, np.asarray(modes[i]), grid)
        elif isinstance(element, LargerGroup):
            path = _follow_group(path, i, np.asarray(modes[i]))
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


def _follow_dyad(path: Path, i: int, dyad: Dyad, sign: float) -> Path:
    """A path with the assembly mode of a dyad, which changes at change points, up to the dyad's end."""
    tried = path.with_sign(i, sign)
    # of a start in a dead point rounding alone may hide where the stretch begins
    parts = [s for s in stretches(tried, i, 0.0, path.reach)
             if s.low <= START or tried.discriminant(i, np.array([s.low / 2]))[0] >= -TOUCH]
    first = parts[0] if parts else Stretch(0.0, 0.0, (False, True))
    limit = first.high if first.ends[1] else None
    flips = np.sort([*first.touches, *_without_leg(tried, i, dyad, first)])
    if dyad.is_two_lines and len(flips):
        limit, flips = float(flips[0]), flips[:0]
    return _passed_by(path, i, partial(_flipped, sign, flips), flips, limit)


def _without_leg(path: Path, i: int, dyad: Dyad, along: Stretch) -> list[float]:
    """The places at which a driven slide draws the inner hinge of a dyad into an outer one: as it passes through this
    the two change sides."""
    links, inner, places = path.structure.links, dyad.inner.point, list[float]()
    bodies = (dyad.first, dyad.outer_first), (dyad.second, dyad.outer_second)
    for (body, outer), (other, _) in zip(bodies, bodies[::-1], strict=True):
        if dyad.kind == "RRR" and not all(joint.pair.turns for joint in body.joints):
            link = next(name for name in other.links if inner in links[name].points)
            ends = (link, links[link].points[inner]), (outer.b, links[outer.b].points[outer.point])
            places += closed(partial(_square_between, path, i, *ends), along.low, along.high)[0].touches
    return places


def _square_between(path: Path, i: int, first: tuple[str, complex], second: tuple[str, complex], t: Array) -> Array:
    """The square of the distance of two places, each of a link, over the size."""
    poses = path.placed(t, i + 1).poses
    (a, b), size = (poses[link].fixed(at).z for link, at in (first, second)), path.structure.scene.size
    return np.broadcast_to(np.abs((a - b) / size) ** 2, t.shape)


def _passed_by(path: Path, i: int, mode: Callable[[Array], Array], flips: Array, limit: float | None) -> Path:
    """A path with a further group: its mode, its change points, and its end of the path."""
    end, by = (path.limit, path.by) if limit is None else (limit, i)
    passed = (*path.passed, *((i, t) for t in flips.tolist()))
    flips = np.sort(np.append(path.flips, flips))
    return replace(path, modes={**path.modes, i: mode}, flips=flips, limit=end, by=by, passed=passed)


def _refined(path: Path, i: int, grid: Array) -> Array:
    """The nodes, more of them where the placed links turn fast."""
    for _ in range(20):
        poses = path.placed(grid, i + 1).poses
        turning = [np.broadcast_to(np.nan_to_num(p.u), grid.shape) for p in poses.values()]
        swing = np.max([np.abs(np.diff(u)) for u in turning], axis=0)
        fast = np.flatnonzero((swing > SWING) & (np.diff(grid) > OFF_FLIP))
        if not len(fast) or len(grid) > 20000:
            break
        grid = np.sort(np.append(grid, (grid[fast] + grid[fast + 1]) / 2))
    return grid


def _follow_group(path: Path, i: int, place: Array) -> Path:
    def solved(t: float, start: Array) -> tuple[GroupSolved, Array]:
        t_ = path.off_flips(np.array([t]))
        group = group_at(path.structure, path.drive(t_), {**path.mode(t_), i: start[None]}, i)
        return group, group.slope

    steps = _steps(path.structure, np.abs(path.end - path.start))
    most = min(0.125, GROUP_STEP / TURN_STEP / steps)
    nodes, places, end, flips = _walk_group(solved, place, path.structure.scene.size, path.reach, most)
    return _passed_by(path, i, partial(_interpolated, nodes, places), np.array(flips), end)


def _follow_rolled(path: Path, i: int, rolled: RollingRelation, mode: Array, grid: Array) -> Path:
    """Count the turns of the links on which a link rolls."""
    poses = path.placed(grid, i).poses
    columns = []
    for k, ((kind, name), _) in enumerate(rolled.factors):
        columns.append(np.full(len(grid), mode[2 * k]))
        if kind == "angle":
            u = np.nan_to_num(np.broadcast_to(poses[name].u, grid.shape), nan=1.0)
            columns.append(mode[2 * k + 1] + turning(u))
        else:
            columns.append(np.full(len(grid), mode[2 * k + 1]))
    return replace(path, modes={**path.modes, i: partial(_interpolated, grid, np.stack(columns, axis=1))})
