"""From one position of a mechanism with larger groups to the next: trial drawings that start where the last ended."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence

from graphkin.construction.dyads import drive, meet
from graphkin.construction.reduced_mechanism import ReducedMechanism, clusters, reduced_mechanisms
from graphkin.construction.rigid import PlacedLinks, Poses
from graphkin.construction.sheet import Pose
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.structure import Driven, Dyad, Element, Structure, analyse
from graphkin.structure.assembly import ways

__all__ = ["best_reduced", "found_near", "moved_to", "trial_value"]

STEP = math.radians(2.0)
FIT = 1e-12  # what is left out fits, in the size of the mechanism
SURPRISE = 1e-3  # so far from where it was expected a link may be found, in the size of the mechanism

NUDGE = 1e-4  # of the trial driver, to see how the gap changes
ROUNDS = 30

Table = Mapping[tuple[str, ...], Sequence[ReducedMechanism]]


def moved_to(scene: Mechanism, own: Mapping[str, float], values: Mapping[str, float], poses: Poses) -> dict[str, Pose]:
    """All links at driver values, from where they lie at others (``own``), on paper of the mechanism's size.

    Raises
    ------
    Unsolvable : "not assembled": the motion does not reach the values
    """
    last: Unsolvable | None = None
    for way in ways(scene.drivers, [own[d.key] for d in scene.drivers], [values[d.key] for d in scene.drivers]):
        try:
            return _walk(scene, own, dict(zip((d.key for d in scene.drivers), way, strict=True)), poses)
        except Unsolvable as stop:
            last = last or stop
    assert last is not None
    raise last


def _walk(scene: Mechanism, own: Mapping[str, float], target: Mapping[str, float], start: Poses) -> dict[str, Pose]:
    structure = analyse(scene)
    table = {cluster.members: reduced_mechanisms(scene, cluster) for cluster in clusters(structure)}
    length = max(
        abs(target[d.key] - own[d.key]) / (1.0 if isinstance(d, AngleDriver) else scene.size) for d in scene.drivers
    )
    longest = 1.0 / max(1, math.ceil(length / STEP))
    step = last = longest / 64  # nothing says yet where the links go
    before, at, t = dict(start), dict(start), 0.0
    while t < 1.0:
        step = min(step, longest, 1.0 - t)
        here = {k: own[k] + (t + step) * (target[k] - own[k]) for k in own}
        guess = _ahead(before, at, step / last) if t > 0.0 else at
        found = found_near(structure, structure.elements, table, here, guess)
        if found is None or _moved(guess, found) > SURPRISE + _moved(at, found) * (0.3 if t > 0.0 else 0.0):
            step /= 2
            if step < longest / 1e5:
                raise Unsolvable("not assembled", Problem("driver", "the motion does not reach these values"))
            continue
        before, at, t, last = at, found, (1.0 if step >= 1.0 - t else t + step), step
        step *= 2
    return at


def _ahead(before: Poses, at: Poses, times: float) -> dict[str, Pose]:
    """The next position if everything went on as in the last step."""
    made = {}
    for name, pose in at.items():
        old = before[name]
        turn = pose.axis / old.axis
        axis = pose.axis * cmath.rect(1.0, cmath.phase(turn) * times)
        made[name] = Pose(pose.origin + (pose.origin - old.origin) * times, axis / abs(axis))
    return made


def _moved(one: Poses, other: Poses) -> float:
    return max(abs(p.origin - other[n].origin) + abs(p.axis - other[n].axis) for n, p in one.items())


def found_near(
    structure: Structure, elements: Sequence[Element], table: Table, values: Mapping[str, float], guess: Poses
) -> dict[str, Pose] | None:
    """All links of the elements at driver values near which a position is guessed, on paper of the mechanism's size;
    None where nothing fits near by.  ``table`` has the reduced mechanisms of each larger group."""
    scene = structure.scene
    frame = PlacedLinks(structure.links, 1.0 / scene.size, values, {scene.frame.name: Pose(0j, 1 + 0j)})
    for element in elements:
        if isinstance(element, Driven):
            frame.poses[element.link], _ = drive(frame, element)
            continue
        near = _nearest(frame, element, guess) if isinstance(element, Dyad) else _fitted(
            table[element.members], frame, guess)
        if near is None:
            return None
        frame.poses.update(near)
    return dict(frame.poses)


def _nearest(frame: PlacedLinks, dyad: Dyad, guess: Poses) -> Poses | None:
    """The assembly of a dyad that lies nearest to a guess."""
    meeting = meet(frame, dyad)
    if not meeting.poses:
        return None
    return min(
        meeting.poses,
        key=lambda poses: sum(abs(p.origin - guess[n].origin) ** 2 + abs(p.axis - guess[n].axis) ** 2
                              for n, p in poses.items()),
    )  # fmt: skip


def _fitted(choices: Sequence[ReducedMechanism], known: PlacedLinks, guess: Poses) -> dict[str, Pose] | None:
    """A larger group near a guess: the trial value by proportional division of two gaps, again and again (secant)."""
    reduced = best_reduced(choices, known, guess)
    if reduced is None:
        return None
    value = trial_value(reduced, guess, known.mm)
    other = value + NUDGE
    one, two = _drawn(reduced, known, guess, value), _drawn(reduced, known, guess, other)
    for _ in range(ROUNDS):
        if one is None or two is None:
            return None
        gap, new = reduced.gap(one), reduced.gap(two)
        if abs(new) >= abs(gap) and abs(gap) < FIT:
            return reduced.put_back(one)
        if new == 0.0 or gap == new:
            break
        step = new * (other - value) / (gap - new)
        if abs(step) > 1.0:
            return None
        value, one = other, two
        other += step
        two = _drawn(reduced, known, guess, other)
    return reduced.put_back(two) if two is not None and abs(reduced.gap(two)) < FIT else None


def _drawn(reduced: ReducedMechanism, known: PlacedLinks, guess: Poses, value: float) -> PlacedLinks | None:
    """A trial drawing of a group, each dyad in the assembly nearest to a guess."""
    frame = reduced.opened(known, value)
    for element in reduced.elements:
        if isinstance(element, Driven):
            frame.poses[element.link], _ = drive(frame, element)
            continue
        near = _nearest(frame, element, guess)
        if near is None:
            return None
        frame.poses.update(near)
    return frame


def best_reduced(choices: Sequence[ReducedMechanism], known: PlacedLinks, guess: Poses) -> ReducedMechanism | None:
    """The reduced mechanism that finds the group best: a small gap means a small error of every link, and no link
    outruns the trial driver by much.  None where all are at dead points."""
    best: tuple[float, ReducedMechanism] | None = None
    for reduced in choices:
        value = trial_value(reduced, guess, known.mm)
        one, two = _drawn(reduced, known, guess, value - NUDGE), _drawn(reduced, known, guess, value + NUDGE)
        if one is None or two is None:
            continue
        group = {n: pose for n, pose in one.poses.items() if n in reduced.cluster.members}
        grown = max(_moved(group, two.poses), 1e-12)
        quality = abs(reduced.gap(two) - reduced.gap(one)) / grown * min(1.0, 2 * NUDGE / grown)
        if best is None or quality > best[0]:
            best = quality, reduced
    return best[1] if best else None


def trial_value(reduced: ReducedMechanism, poses: Poses, mm: float) -> float:
    """The trial driver's value in a position (rad, m)."""
    turned, travel = reduced.value(poses, mm)
    return travel if turned is None else cmath.phase(turned)
