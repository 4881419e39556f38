"""The analytic solution of a scene: at its own position, at given driver values, or over a turn; and a motion with cams
as that of what is drawn in its place: the same links, bars to centres of curvature, blocks on curves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from graphkin.errors import CallError, Problem, Unsolvable
from graphkin.scene.model import Mechanism
from graphkin.solver.assemblies import choose_forms, own_values
from graphkin.solver.diagnosis import assembly_words
from graphkin.solver.driver_range import range_from, stopped_why, way_to
from graphkin.solver.joints import Drive
from graphkin.solver.mobility import structure_of
from graphkin.solver.motion import Motion, goal_values, motion_of
from graphkin.solver.pose import Array, Pose, rest
from graphkin.solver.redundant import all_slides
from graphkin.solver.rounding import ErrorBound
from graphkin.structure import Structure, part_of
from graphkin.structure.assembly import ChangePoint
from graphkin.words import Phrase, Wording

__all__ = ["as_drawn", "solve", "sweep_in_blocks"]


def solve(
    scene: Mechanism | Structure, at: Mapping[str, float] | None = None, sweep: int | None = None, fine: bool = True
) -> Motion:
    """Solve a scene, or its structure, analytically.

    Parameters
    ----------
    at : driver values other than the scene's, by driver key (link, or sliding pair), in rad or m
    sweep : this many positions: over a full turn of the first driver, in the sense of its omega (counter-clockwise if
        it is 0), from the scene's own value (or that of ``at``) on; for a slide driver, in the same sense, spread
        evenly inside the range of travel that the motion reaches
    fine : False leaves 16 digits where they are rough, with the bounds of each link alone, as a drawing has them; of
        one position only

    Returns
    -------
    Motion; a position that cannot be reached or stands in a dead point has its status and the reason, and no numbers
    (``Motion.require`` raises if no position is ok)

    Raises
    ------
    Unsolvable
        "mobility": the number of drivers does not fit, the mechanism is held too much, a redundant link does not fit
    SceneError
        a larger group has several assemblies and no sketch
    CallError
        ``at`` names no driver, ``sweep`` is less than 1
    """
    structure = structure_of(scene)
    goal = goal_values(structure.scene, at)
    if sweep is not None and sweep < 1:
        raise CallError(Problem("sweep", Phrase("positions of number", number=sweep), Phrase("give 1 or more")))
    start = _start(structure, goal)
    if isinstance(start, _Refused):
        return _nowhere(structure, goal, sweep, *start)
    forms, passed = start
    if sweep is not None:
        return range_from(structure, forms, goal).sweep(sweep)
    drive, here = Drive.at(structure, goal[None]), {i: f[None] for i, f in forms.items()}
    found = motion_of(structure, drive, here, assembly_words(structure, forms), np.ones(1, dtype=bool), fine=fine)
    return replace(found, passed=passed)


def sweep_in_blocks(scene: Mechanism | Structure, at: Mapping[str, float] | None, sweep: int) -> Iterator[Motion]:
    """``solve`` of a sweep a block of positions at a time: no more of it is in memory."""
    structure = structure_of(scene)
    goal = goal_values(structure.scene, at)
    start = _start(structure, goal)
    if isinstance(start, _Refused):
        yield _nowhere(structure, goal, sweep, *start)
    else:
        yield from range_from(structure, start[0], goal).sweep_in_blocks(sweep)


class _Refused(NamedTuple):
    """Why driver values are not reached."""

    status: str
    why: Wording


def _start(structure: Structure, goal: Array) -> tuple[Mapping[int, Array], tuple[ChangePoint, ...]] | _Refused:
    """The form of each group at driver values, and the change points on the way there; or why they are not reached."""
    try:
        forms = choose_forms(structure)
    except Unsolvable as stop:
        return _Refused(stop.status, stop.reason)
    own = own_values(structure.scene)
    if np.array_equal(own, goal):
        return forms, ()
    path = way_to(structure, forms, goal)
    if path.limit is not None:
        return _Refused("not assembled", stopped_why(structure, forms, own, path))
    return path.last_forms, path.change_points


def _nowhere(structure: Structure, goal: Array, sweep: int | None, status: str, why: Wording) -> Motion:
    """No position at all; the driver values are those that were asked for, but of a slide driver, whose range is not
    known, all alike."""
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
    nan = np.full(n, np.nan)
    unknown = tuple(Phrase("assembled nowhere") for _ in structure.groups)
    slides, said = all_slides(structure), (why,) * n
    bound = ErrorBound(*(nan,) * 6)
    return Motion(structure, values, np.full(n, status), said, poses, slides, unknown, bound, (nan, nan))


def as_drawn(motion: Motion, structure: Structure) -> Motion:
    """A motion at one position, with the blocks and points that a replacing mechanism has there; itself of a mechanism
    that nothing replaces."""
    if len(motion.scene.drivers) < len(structure.scene.drivers):  # solved for what leads to the asked alone
        structure = structure_of(part_of(structure, motion.scene.find))
    if structure.scene.instead_of is None and structure.links.keys() == motion.structure.links.keys():
        return motion
    poses = dict(motion.poses)
    for slide in structure.slides:
        if slide.a in poses or not slide.slot or slide.pin is None:
            continue
        holder = next(n for n in structure.hinges.get(slide.pin, ()) if n != slide.a)
        if holder not in poses or slide.b not in poses:
            continue  # nothing asks for it
        at = poses[holder].fixed(structure.links[holder].points[slide.pin])
        guide = poses[slide.b]
        turn = np.asarray(guide.u * slide.guide.direction)
        poses[slide.a] = Pose(at.z, turn, at.v, guide.omega, at.a, guide.alpha)
    for slot in structure.scene.slots:
        if slot.bar in poses or slot.bar not in structure.links or slot.on not in poses:
            continue
        held = [n for n in structure.hinges.get(slot.point, ()) if n != slot.bar and n in poses]
        if not held:
            continue  # nothing asks for it
        holder = held[0]
        start = poses[slot.on].fixed(structure.links[slot.on].points[slot.centre])
        end = poses[holder].fixed(structure.links[holder].points[slot.point])
        across = (end.z - start.z) / slot.radius
        way = across / np.abs(across)
        omega = (np.conj(1j * way) * (end.v - start.v)).real / slot.radius
        alpha = (np.conj(1j * way) * (end.a - start.a)).real / slot.radius
        poses[slot.bar] = Pose(start.z, way, start.v, omega, start.a, alpha)
    return replace(motion, structure=structure, poses=poses, slides=all_slides(structure))
