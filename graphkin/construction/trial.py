"""Position and velocity of mechanisms with larger groups, by trial drawings.

Position: the trial driver of a reduced mechanism is moved until what was left out fits; from one position of the real
driver to the next the trial starts where the last one ended.  Velocity: everything is linear in the trial driver's
speed, so two trial drawings with two arbitrary speeds give the true one by proportional division: the two motions are
superposed so that what was left out keeps fitting.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise, product

from graphkin.construction.dyads import drive, meet
from graphkin.construction.follow import best_reduced, moved_to, trial_value
from graphkin.construction.reduced_mechanism import ReducedMechanism, RemovedConstraint, clusters, reduced_mechanisms
from graphkin.construction.rigid import PlacedLinks, Poses
from graphkin.construction.sheet import Pose
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import AngleDriver, AnyDriver, Mechanism
from graphkin.structure import Cluster, Driven, Dyad, Structure, analyse, links_of, pick

__all__ = ["Known", "trial_position"]

GRID = 360  # trial values looked at over a turn
TRIALS = 3  # trial drivers used, one after the other, to find all assemblies

Branches = tuple[int, ...]  # which assembly each dyad of a reduced mechanism takes, in the order of drawing
Known = tuple[Mapping[str, float], Poses]  # driver values, and every link there with the mechanism of size 1


@dataclass(frozen=True)
class TrialPosition:
    """A scene of dyads only that choices where the given one does: trial drivers at their right values.

    ``removed`` are what was left out, in order, each with the key of its trial driver.
    """

    scene: Mechanism
    removed: tuple[tuple[RemovedConstraint, str], ...]


def trial_position(scene: Mechanism, values: Mapping[str, float], near: Known | None = None) -> TrialPosition:
    """Find by trial the position of a scene with larger groups.

    Parameters
    ----------
    near : a position known already, from which the motion is moved_to; without one the scene's own is found first

    Raises
    ------
    Unsolvable
        "not drawn": no link can be left out so that dyads remain; "not assembled": nothing fits at these values
    SceneError : a group has several assemblies and no sketch says which is meant
    """
    if near is None:
        own: Mapping[str, float] = {d.key: d.values[0] for d in scene.drivers}
        poses: Poses = _own_position(scene, own)
    else:
        own, poses = near
    moving = {k: v for k, v in values.items() if v != own[k]}
    if moving:
        poses = moved_to(scene, own, values, poses)
    return _reduced_here(scene, values, poses)


# -- the scene's own position: all the places at which the groups close -----------------------------------------------


def _own_position(scene: Mechanism, own: Mapping[str, float]) -> dict[str, Pose]:
    structure = analyse(scene)
    frame = PlacedLinks(structure.links, 1.0 / scene.size, own, {scene.frame.name: Pose(0j, 1 + 0j)})
    for element in structure.elements:
        if isinstance(element, Driven):
            frame.poses[element.link], _ = drive(frame, element)
        elif isinstance(element, Dyad):
            _dyad_by_sketch(scene, structure, frame, element)
        else:
            _cluster_by_sketch(scene, structure, frame, element)
    return dict(frame.poses)


def _dyad_by_sketch(scene: Mechanism, structure: Structure, frame: PlacedLinks, dyad: Dyad) -> None:
    meeting = meet(frame, dyad)
    if not meeting.poses:
        raise Unsolvable("not assembled", Problem(f"links {', '.join(dyad.links)}", "their loci do not meet here"))
    candidates = [_fresh(structure, frame, poses) for poses in meeting.poses]
    frame.poses.update(meeting.poses[pick(scene, dyad.links, candidates, 0).index])


def _fresh(structure: Structure, frame: PlacedLinks, poses: Poses) -> dict[str, complex]:
    """Places (m) of the points that were not known before."""
    known = {p for n in frame.poses for p in structure.links[n].points}
    there = PlacedLinks(frame.links, frame.mm, frame.values, {**frame.poses, **poses})
    return {p: there.point(n, p) / frame.mm for n in poses for p in structure.links[n].points if p not in known}


def _cluster_by_sketch(scene: Mechanism, structure: Structure, frame: PlacedLinks, cluster: Cluster) -> None:
    found: list[dict[str, Pose]] = []
    # by several trial drivers: what one passes over at its dead point another sees
    by_driver: dict[str, ReducedMechanism] = {}
    for reduced in reduced_mechanisms(scene, cluster):
        by_driver.setdefault(reduced.driver, reduced)
    for reduced in list(by_driver.values())[:TRIALS]:
        for fit in _fits(reduced, frame):  # a fit at a value of the grid is met from both sides
            if not any(_near(fit, other) for other in found):
                found.append(fit)
    if not found:
        names = ", ".join(cluster.links)
        raise Unsolvable("not assembled", Problem(f"links {names}", "no trial position closes this group here"))
    candidates = [_fresh(structure, frame, poses) for poses in found]
    frame.poses.update(found[pick(scene, cluster.links, candidates, None).index])


def _near(one: Poses, other: Poses) -> bool:
    return all(abs(p.origin - other[n].origin) + abs(p.axis - other[n].axis) < 1e-6 for n, p in one.items())


def _fits(reduced: ReducedMechanism, known: PlacedLinks) -> list[dict[str, Pose]]:
    """Every position of the trial driver and every assembly of the trial dyads at which what was left out fits."""
    driver = next(d for d in reduced.scene.drivers if d.key == reduced.driver)
    turns = isinstance(driver, AngleDriver)
    span, start = (2 * math.pi, 0.0) if turns else (4.0 * reduced.scene.size, -2.0 * reduced.scene.size)
    grid = [start + span * i / GRID for i in range(GRID + 1)]
    # a value is drawn once for all assemblies: where one cannot be drawn on, others often cannot either
    gaps_at = cache(lambda value: _gaps(reduced, known, value))
    found: list[dict[str, Pose]] = []
    for branches in product((0, 1), repeat=sum(isinstance(e, Dyad) for e in reduced.elements)):

        def gap(value: float, branches: Branches = branches) -> float:
            return gaps_at(value).get(branches, math.nan)

        for pair in pairwise((value, gap(value)) for value in grid):
            (a, one), (b, two) = _inside(gap, *pair)
            # nan compares false; a gap that leaps has passed half a turn, not zero
            if not one * two <= 0.0 or abs(one - two) > 1.0:
                continue
            frame = _drawn(reduced, known, _root(gap, a, b, one, two), branches)
            if frame is not None and abs(reduced.gap(frame)) < 1e-9:
                found.append(reduced.put_back(frame))
    return found


def _gaps(reduced: ReducedMechanism, known: PlacedLinks, value: float) -> dict[Branches, float]:
    """The gap in every assembly of the trial dyads at one value; those that cannot be drawn are left out.

    A dyad is drawn once for all assemblies of those after it.
    """
    frame = reduced.opened(known, value)
    found: dict[Branches, float] = {}

    def draw(elements: Sequence[Driven | Dyad], branches: Branches) -> None:
        if not elements:
            found[branches] = reduced.gap(frame)
            return
        element = elements[0]
        if isinstance(element, Driven):
            frame.poses[element.link], _ = drive(frame, element)
            draw(elements[1:], branches)
            return
        for branch, poses in enumerate(meet(frame, element).poses):
            frame.poses.update(poses)
            draw(elements[1:], (*branches, branch))

    draw(reduced.elements, ())
    return found


def _drawn(reduced: ReducedMechanism, known: PlacedLinks, value: float, branches: Branches) -> PlacedLinks | None:
    """A trial drawing of the group; None where two loci do not meet."""
    frame = reduced.opened(known, value)
    wanted = iter(branches)
    for element in reduced.elements:
        if isinstance(element, Driven):
            frame.poses[element.link], _ = drive(frame, element)
            continue
        meeting, branch = meet(frame, element), next(wanted)
        if branch >= len(meeting.poses):
            return None
        frame.poses.update(meeting.poses[branch])
    return frame


def _inside(
    gap: Callable[[float], float], one: tuple[float, float], two: tuple[float, float]
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Two trial values with their gaps; where only one can be drawn, the other is moved to the last that can."""
    if math.isnan(one[1]) == math.isnan(two[1]):
        return one, two
    good, bad = (one, two[0]) if math.isnan(two[1]) else (two, one[0])
    last = good
    for _ in range(45):
        middle = (last[0] + bad) / 2
        there = gap(middle)
        if math.isnan(there):
            bad = middle
        else:
            last = middle, there
    return good, last


def _root(gap: Callable[[float], float], a: float, b: float, fa: float, fb: float) -> float:
    """Where a gap closes between two trial values: proportional division, halving where that is slow (regula falsi,
    Illinois variant)."""
    side = 0
    for _ in range(100):
        c = (fa * b - fb * a) / (fa - fb) if fa != fb else (a + b) / 2
        if not min(a, b) < c < max(a, b):
            c = (a + b) / 2
        fc = gap(c)
        if fc == 0.0 or math.isnan(fc) or abs(b - a) <= 4e-16 * max(abs(a), abs(b), 1.0):
            return c
        if (fc > 0) == (fb > 0):
            b, fb = c, fc
            fa = fa / 2 if side == -1 else fa
            side = -1
        else:
            a, fa = c, fc
            fb = fb / 2 if side == 1 else fb
            side = 1
    return c


def _reduced_here(scene: Mechanism, values: Mapping[str, float], poses: Poses) -> TrialPosition:
    """The reduced mechanism of each larger group at the position found, with a sketch by which each dyad takes its
    assembly."""
    here: Mechanism = replace(scene, drivers=tuple(_at(d, values[d.key]) for d in scene.drivers), drawn={}, find=())
    mm = 1.0 / scene.size
    links = analyse(scene).links
    removed: list[tuple[RemovedConstraint, str]] = []
    while larger := clusters(structure := analyse(here)):
        before = structure.elements[: structure.elements.index(larger[0])]
        placed = {scene.frame.name, *(n for element in before for n in links_of(element))}
        now = {d.key: d.values[0] for d in here.drivers}
        frame = PlacedLinks(links, mm, now, {n: pose for n, pose in poses.items() if n in placed})
        reduced = best_reduced(reduced_mechanisms(here, larger[0]), frame, poses)
        if reduced is None:
            names = ", ".join(larger[0].links)
            raise Unsolvable("dead point", Problem(f"links {names}", "every trial drawing is at a dead point here"))
        value = trial_value(reduced, poses, mm)
        drivers = tuple(_at(d, value) if d.key == reduced.driver else d for d in reduced.scene.drivers)
        here = replace(reduced.scene, drivers=drivers)
        removed.append((reduced.removed, reduced.driver))
    whole = PlacedLinks(links, mm, {}, dict(poses))
    places = {p: whole.point(n, p) / mm for n in poses for p in links[n].points if n != scene.frame.name}
    return TrialPosition(replace(here, sketch=places), tuple(removed))


def _at(driver: AnyDriver, value: float) -> AnyDriver:
    if isinstance(driver, AngleDriver):
        return replace(driver, angle=value)
    return replace(driver, travel=value)
