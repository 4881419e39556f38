"""The analytic solver: dyads in closed form, higher groups by Newton, whole sweeps as arrays.

The solution of a scene: at its own position, at given driver values, or over a turn; and a motion with cams
as the motion of the mechanism drawn in its place: the same links, bars to centres of curvature, blocks on curves.

The motion at moments in time, where drivers move by laws: their rates change from one moment to the next.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from graphkin.errors import CallError, Problem, Unsolvable
from graphkin.scene.drivers import at_time
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver.algebra.bounds import Accuracy
from graphkin.solver.algebra.pose import Array, Drive, rest
from graphkin.solver.drivers import goal_values, own_values
from graphkin.solver.mobility import structure_of
from graphkin.solver.motion import Motion, listed_points, own_slides
from graphkin.solver.path.assemblies import choose_modes
from graphkin.solver.path.driver_range import DriverRange, motion_of, range_from, range_of, start_of, way_to
from graphkin.structure import Structure, part_of
from graphkin.structure.assembly import ChangePoint
from graphkin.words import Phrase, Wording, listed

__all__ = [
    "DriverRange", "Motion", "driver_range", "listed_points", "over_time", "own_slides", "solve",
    "solved_here", "structure_of", "sweep_in_blocks",
]


def driver_range(scene: Mechanism | Structure, at: Mapping[str, float] | None = None) -> DriverRange:
    """``range_of`` a scene, or of its structure.  Raises Unsolvable also for a wrong mobility."""
    return range_of(structure_of(scene), at)


def solve(
    scene: Mechanism | Structure, at: Mapping[str, float] | None = None, sweep: int | None = None, extended: bool = True
) -> Motion:
    """Solve a scene, or its structure, analytically.

    Parameters
    ----------
    at : driver values other than the scene's, by driver key (link, or sliding pair), in rad or m
    sweep : this many positions: over a full turn of the first driver, in the sense of its omega (counter-clockwise if
        it is 0), from the scene's own value (or that of ``at``) on; for a slide driver, in the same sense, spread
        evenly inside the range of travel that the motion reaches
    extended : False keeps 16 digits everywhere, with the bounds of each link alone, as a drawing has them; of one
        position only

    Returns
    -------
    Motion; a position that is not reached or at a dead point has its status and the reason, and no numbers
    (``Motion.require`` raises if no position is ok)

    Raises
    ------
    Unsolvable
        "mobility": the number of drivers does not fit, the mechanism is overconstrained, a redundant link does not fit
    SceneError
        a larger group has several assemblies and no sketch
    CallError
        ``at`` names no driver or holds no number, ``sweep`` is less than 1
    """
    structure = structure_of(scene)
    if sweep is not None and sweep < 1:
        raise CallError.of("sweep", "positions of number", "give 1 or more", number=sweep)
    start = _start(structure, at, sweep)
    if isinstance(start, Motion):
        return start
    goal, modes, passed = start
    if sweep is not None:
        return range_from(structure, modes, goal).sweep(sweep)
    drive, here = Drive.at(structure, goal[None]), {i: f[None] for i, f in modes.items()}
    motion = motion_of(structure, drive, here, modes, np.ones(1, dtype=bool), extended=extended)
    return replace(motion, passed=passed)


def solved_here(
    of: Mechanism | Structure, values: Mapping[str, float] | None, asked: Sequence[Symbol] = ()
) -> Motion:
    """The exact motion at one position, of the part that leads to the asked quantities.

    It comes before the drawing, because it gives the best reason for a position that is not reached.
    """
    structure = structure_of(of)
    scene = part_of(structure, asked)
    if scene is not structure.scene:
        structure = structure_of(scene)
        kept = [d.key for d in scene.drivers]
        values = {k: v for k, v in values.items() if k in kept} if values else values
    motion = solve(structure, at=values)
    if motion.status[0] != "ok":
        drivers = [
            Phrase("driver at value", driver=d.key, value=scene.unit_of(d).said((values or {}).get(d.key, d.values[0])))
            for d in scene.drivers
        ]
        raise Unsolvable(
            str(motion.status[0]), Problem(Phrase("driver of driver", driver=listed(drivers)), motion.said(0))
        )
    return motion


def sweep_in_blocks(scene: Mechanism | Structure, at: Mapping[str, float] | None, sweep: int) -> Iterator[Motion]:
    """``solve`` of a sweep a block of positions at a time: no more of it is in memory."""
    structure = structure_of(scene)
    start = _start(structure, at, sweep)
    if isinstance(start, Motion):
        yield start
    else:
        yield from range_from(structure, start[1], start[0]).sweep_in_blocks(sweep)


def _start(
    structure: Structure, at: Mapping[str, float] | None, sweep: int | None
) -> tuple[Array, Mapping[int, Array], tuple[ChangePoint, ...]] | Motion:
    """The driver values asked for, the assembly mode of each group there, and the change points on the path to them;
    where they are not reached a motion with the reason."""
    try:
        goal, modes, passed, why = start_of(structure, at)
    except Unsolvable as stop:
        return _nowhere(structure, goal_values(structure.scene, at), sweep, stop.status, stop.reason)
    return _nowhere(structure, goal, sweep, "not assembled", why) if why else (goal, modes, passed)


def _nowhere(structure: Structure, goal: Array, sweep: int | None, status: str, why: Wording) -> Motion:
    """A motion without a solved position; its driver values are the asked ones, for a slide driver, whose range is
    unknown, all equal."""
    n = sweep or 1
    values = np.repeat(goal[None], n, axis=0)
    first = structure.scene.drivers[0]
    if first.turns:
        values[:, 0] += (-1.0 if first.rate < 0 else 1.0) * 2 * np.pi * np.arange(n) / n
    none = rest().spread(n)
    gone = none.where(np.zeros(n, dtype=bool))
    names = [*structure.links, *(link.name for link in structure.scene.links if link.redundant)]
    poses = dict.fromkeys(names, gone)
    poses[structure.scene.frame.name] = none
    nothing = np.zeros(n, dtype=bool)
    accuracy = Accuracy(structure, poses, Drive.at(structure, values), np.zeros((n, 0)), nothing, nothing, nothing)
    reach = partial(range_of, structure)
    return Motion(structure, values, np.full(n, status), (why,) * n, poses, None, accuracy, reach)


# the motion at moments in time, where drivers move by laws


def over_time(of: Mechanism | Structure, times: Array, extended: bool = True) -> Motion:
    """The motion at moments (s) of the laws by which drivers move, from the scene's own assembly on.

    ``extended`` is False for curves: 16 digits throughout, and no reasons where the status is not ok.

    Raises
    ------
    Unsolvable : wrong mobility; of a single driver also where the scene's own position cannot be assembled
    CallError : a moment before or after all laws
    """
    structure = structure_of(of)
    scene = structure.scene
    moments = [at_time(scene, float(t)) for t in times]
    value = np.array([[values[d.key] for d in scene.drivers] for _, values in moments])
    rates = np.array([[d.values[1:] for d in moved.drivers] for moved, _ in moments])
    drive = Drive(value, rates[..., 0], rates[..., 1])
    return (_one_driver if value.shape[1] == 1 else _several_drivers)(structure, drive, extended)


def _one_driver(structure: Structure, drive: Drive, extended: bool) -> Motion:
    reach = range_of(structure)
    offset, rounds = reach.sense * (drive.value[:, 0] - reach.start[0]), np.zeros(len(drive))
    if reach.full:
        rounds = np.floor(offset / abs(reach.wide))
        offset = np.remainder(offset, abs(reach.wide))
    along = reach.motion(offset, extended=extended, rates=(drive.rate[:, 0], drive.second[:, 0]))
    whole = reach.turned(np.ones(1))
    turned = {name: angle + rounds * whole[name] for name, angle in along.turned.items()}
    return replace(along, values=drive.value, turned=turned, accuracy=replace(along.accuracy, drive=drive))


def _several_drivers(structure: Structure, drive: Drive, extended: bool) -> Motion:
    """The motion along the path from moment to moment; moments that are not reached are left out, and the path
    continues from before them."""
    from graphkin.solver.path.continuity import follow_path

    modes = start = choose_modes(structure)
    here, history = own_values(structure.scene), []
    turns: list[dict[str, float]] = []
    good, why = np.ones(len(drive), dtype=bool), list[Wording]([""] * len(drive))
    for k, goal in enumerate(drive.value):
        if not np.array_equal(here, goal):
            path = follow_path(structure, modes, here, goal) if k else way_to(structure, modes, goal)
            if path.limit is None:
                here, modes = goal, path.last_modes
                before = turns[-1] if turns else {}
                turns.append({n: before.get(n, 0.0) + float(by[0]) for n, by in path.turned(np.ones(1)).items()})
            else:
                good[k], why[k] = False, path.why_ended()
        history.append(modes)
        turns[k:] = [turns[-1] if turns else {}]
    stacked = {i: np.stack([f[i] for f in history]) for i in modes}
    motion = motion_of(structure, drive, stacked, start, good, extended=extended)
    reasons = tuple(a or b for a, b in zip(motion.reasons, why, strict=True))
    return replace(motion, reasons=reasons, turned={n: np.array([s.get(n, 0.0) for s in turns]) for n in motion.poses})
