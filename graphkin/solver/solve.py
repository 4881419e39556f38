"""The analytic solution of a scene: at its own position, at given driver values, or over a turn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import product

import numpy as np

from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean
from graphkin.scene.model import AngleDriver, Scene, SlideDriver
from graphkin.solver.assemblies import choose_forms, own_values
from graphkin.solver.engine import State, positions
from graphkin.solver.findings import assembly_words, limit_why, structure_of, without_singular
from graphkin.solver.joints import Drive
from graphkin.solver.motion import Motion
from graphkin.solver.path import Path, follow_path
from graphkin.solver.pose import Array, Pose, rest
from graphkin.solver.redundant import all_slides, fit
from graphkin.structure import Structure

__all__ = ["solve", "solve_structure"]

FAR = 4.0
"""A slide driver that nothing limits is followed this many sizes of the mechanism to either side."""


def solve(scene: Scene, at: Mapping[str, float] | None = None, sweep: int | None = None) -> Motion:
    """Solve a scene analytically.

    Parameters
    ----------
    at : driver values other than the scene's, by driver key (link, or sliding pair), in rad or m
    sweep : this many positions: over a full turn of the first driver, in the sense of its omega (counter-clockwise if
        it is 0), from the scene's own value (or that of ``at``) on; for a slide driver spread evenly inside the range
        of travel that the motion reaches

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
    return solve_structure(structure, at, sweep)


def solve_structure(structure: Structure, at: Mapping[str, float] | None = None, sweep: int | None = None) -> Motion:
    """``solve`` for a structure that is known already."""
    scene = structure.scene
    start = own_values(scene)
    goal = _goal(scene, at, start)
    if sweep is not None and sweep < 1:
        raise CallError(Problem("sweep", f"{sweep} positions", "give 1 or more"))
    try:
        forms = choose_forms(structure)
    except Unsolvable as stop:
        values = goal[None] if sweep is None else _turn(scene, goal, sweep)
        return _nowhere(structure, values, stop.status, stop.why)
    if not np.array_equal(start, goal):
        path = _reached(structure, forms, start, goal)
        if path.limit is not None:
            values = goal[None] if sweep is None else _turn(scene, goal, sweep)
            return _nowhere(structure, values, "not assembled", limit_why(structure, forms, start, path))
        forms = {i: f[0] for i, f in path.form(np.ones(1)).items()}
    if sweep is None:
        return _solved(structure, forms, goal[None], {i: f[None] for i, f in forms.items()}, np.ones(1, dtype=bool), "")
    return _swept(structure, forms, goal, sweep)


def _goal(scene: Scene, at: Mapping[str, float] | None, start: Array) -> Array:
    goal = start.copy()
    keys = [d.key for d in scene.drivers]
    for key, value in (at or {}).items():
        if key not in keys:
            raise CallError(Problem(f'at "{key}"', "there is no such driver", did_you_mean(key, keys)))
        if not np.isfinite(value):
            raise CallError(Problem(f'at "{key}"', f"{value} is no driver value"))
        goal[keys.index(key)] = value
    return goal


def _reached(structure: Structure, forms: Mapping[int, Array], start: Array, goal: Array) -> Path:
    """The way to a goal: straight, else the other way round for drivers that turn; the straight one if none does."""
    first: Path | None = None
    for end in _ways(structure.scene, start, goal):
        path = follow_path(structure, forms, start, end)
        if path.limit is None:
            return path
        first = first or path
    assert first is not None
    return first


def _ways(scene: Scene, start: Array, goal: Array) -> Iterator[Array]:
    """Goals that are the same position, each turning driver direct or the other way round."""
    choices: list[tuple[float, ...]] = []
    for driver, a, b in zip(scene.drivers, start, goal, strict=True):
        turns = isinstance(driver, AngleDriver) and a != b
        direct = (
            float(np.remainder(b - a + np.pi, 2 * np.pi) - np.pi) if turns and abs(b - a) > 2 * np.pi else float(b - a)
        )
        choices.append((direct, direct - np.copysign(2 * np.pi, direct)) if turns else (direct,))
    for deltas in product(*choices):
        yield start + np.array(deltas)


def _turn(scene: Scene, start: Array, n: int) -> Array:
    """Driver values of a sweep, shape (n, drivers); those of a slide driver are all alike (its range is unknown)."""
    values = np.repeat(start[None], n, axis=0)
    first = scene.drivers[0]
    if isinstance(first, AngleDriver):
        values[:, 0] += _sense(first) * 2 * np.pi * np.arange(n) / n
    return values


def _sense(driver: AngleDriver) -> float:
    return -1.0 if driver.omega < 0 else 1.0


def _swept(structure: Structure, forms: Mapping[int, Array], start: Array, n: int) -> Motion:
    scene = structure.scene
    first = scene.drivers[0]
    wide = _sense(first) * 2 * np.pi if isinstance(first, AngleDriver) else FAR * scene.size
    there = follow_path(structure, forms, start, start + wide * _first(start))
    if isinstance(first, SlideDriver):
        back = follow_path(structure, forms, start, start - wide * _first(start))
        low, high = -back.reach * wide, there.reach * wide
        offset = low + (np.arange(n) + 0.5) / n * (high - low)
        ahead, t, s = offset >= 0, offset / wide, -offset / wide
        values = start + offset[:, None] * _first(start)
        why = ""
        good = np.ones(n, dtype=bool)
    else:
        values = _turn(scene, start, n)
        t = np.arange(n) / n
        s = 1 - t
        ahead = t <= there.reach
        back = there if ahead.all() else follow_path(structure, forms, start, start - wide * _first(start))
        good = ahead | (s <= back.reach)
        why = "" if good.all() else limit_why(structure, forms, start, there, back)
    one, other = there.form(np.clip(t, 0, there.reach)), back.form(np.clip(s, 0, back.reach))
    chosen = {i: np.where(ahead.reshape(-1, *[1] * (one[i].ndim - 1)), one[i], other[i]) for i in one if i in other}
    motion = _solved(structure, forms, values, chosen, good, why)
    forth, astern = there.turned(np.clip(t, 0, there.reach)), back.turned(np.clip(s, 0, back.reach))
    return replace(motion, turned={name: np.where(ahead, forth[name], astern[name]) for name in forth})


def _first(like: Array) -> Array:
    unit = np.zeros_like(like)
    unit[0] = 1.0
    return unit


def _solved(
    structure: Structure, forms: Mapping[int, Array], values: Array, chosen: Mapping[int, Array], good: Array, why: str
) -> Motion:
    """Positions in one pass over all values, their status, redundant links placed and checked."""
    n = len(values)
    status = np.where(good, "ok", "not assembled").astype("<U13")
    reasons = ["" if g else why for g in good]
    state: State | None = None
    if good.any():
        # positions out of reach are computed at the first one that is not, and thrown away
        fill = int(np.argmax(good))
        used = np.where(good[:, None], values, values[fill])
        picked = {i: np.where(good.reshape(-1, *[1] * (f.ndim - 1)), f, f[fill]) for i, f in chosen.items()}
        state = positions(structure, Drive.at(structure, used), picked)
        status, reasons = without_singular(structure, state, used, picked, status, reasons)
    if state is None:
        return _nowhere(structure, values, "not assembled", why)
    ok = status == "ok"
    poses = {name: _masked(pose.spread(n), ok) for name, pose in state.poses.items()}
    poses[structure.scene.frame.name] = rest().spread(n)
    _place_redundant(structure, poses, ok)
    bounds, rough = state.bounds, state.rough
    assert bounds is not None
    return Motion(
        structure,
        values,
        status,
        tuple(reasons),
        poses,
        all_slides(structure),
        assembly_words(structure, forms),
        np.where(ok, bounds.velocity, np.nan),
        np.where(ok, bounds.acceleration, np.nan),
        position_bound=np.where(ok, bounds.position, np.nan),
        rough=(np.where(ok, rough[0], np.nan), np.where(ok, rough[1], np.nan)),
        turning_bound=(
            np.where(ok, bounds.angle, np.nan),
            np.where(ok, bounds.omega, np.nan),
            np.where(ok, bounds.alpha, np.nan),
        ),
    )


def _masked(pose: Pose, ok: Array) -> Pose:
    return replace(pose, **{k: np.where(ok, getattr(pose, k), np.nan) for k in ("z", "u", "v", "omega", "a", "alpha")})


def _place_redundant(structure: Structure, poses: dict[str, Pose], ok: Array) -> None:
    waiting = [link for link in structure.scene.links if link.redundant]
    while waiting:
        for link in waiting:
            found = fit(structure.scene, link, poses)
            if found is not None:
                break
        else:
            names = ", ".join(link.name for link in waiting)
            raise Unsolvable("mobility", Problem(f"links {names}", "redundant, but nothing holds both ends of them"))
        waiting.remove(link)
        bad = ok & ~found.fits
        if bad.any():
            k = int(np.argmax(bad))
            missed = float(found.position[k]) * structure.scene.size / structure.scene.units.metres
            how = (
                f"it misses its joints by {missed:.4g} {structure.scene.units.length}"
                if found.position[k] >= 1e-9
                else "it fits here, but would stop the motion"
            )
            raise Unsolvable(
                "mobility",
                Problem(f"links.{link.name}.redundant", how, "a redundant link must repeat what the others hold"),
            )
        poses[link.name] = found.pose


def _nowhere(structure: Structure, values: Array, status: str, why: str) -> Motion:
    n = len(values)
    none = rest().spread(n)
    gone = _masked(none, np.zeros(n, dtype=bool))
    names = [*structure.links, *(link.name for link in structure.scene.links if link.redundant)]
    poses = dict.fromkeys(names, gone)
    poses[structure.scene.frame.name] = none
    nan = np.full(n, np.nan)
    unknown = tuple("" for _ in structure.groups)
    slides, said = all_slides(structure), (why,) * n
    return Motion(
        structure, values, np.full(n, status), said, poses, slides, unknown, nan, nan, {}, nan, (nan,) * 2, (nan,) * 3
    )
