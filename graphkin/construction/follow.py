"""From one position of a mechanism with larger groups to the next: trial drawings that start where the last ended."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence

import numpy as np

from graphkin.construction.dyads import drive, meet
from graphkin.construction.reduced_mechanism import ReducedMechanism, clusters, reduced_mechanisms
from graphkin.construction.rigid import PlacedLinks, Poses
from graphkin.construction.rolled_places import rolled_near
from graphkin.construction.sheet import Pose
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import AngleDriver
from graphkin.structure import Cluster, Driven, Dyad, Element, Rolled, Structure
from graphkin.structure.assembly import ways

__all__ = ["Choices", "best_reduced", "drawn_near", "fitted", "found_near", "moved_to"]

STEP = math.radians(2.0)
FIT = 1e-12  # what is left out fits, in the size of the mechanism
SURPRISE = 1e-3  # so far from where it was expected a link may be found, in the size of the mechanism

NUDGE = 1e-4  # of the trial driver, to see how the gap changes
ROUNDS = 30
GOOD = 0.3  # a reduced mechanism as good as this is taken without a look at the others


class Choices:
    """The reduced mechanisms of each larger group of a mechanism, and which of them serve now."""

    def __init__(self, structure: Structure, elements: Sequence[Element]) -> None:
        self.structure = structure
        wanted = [c for c in clusters(structure) if c in elements]
        self.of: Mapping[Cluster, list[ReducedMechanism]] = {c: reduced_mechanisms(structure, c) for c in wanted}
        self.last: dict[Cluster, ReducedMechanism] = {}


def moved_to(
    choices: Choices, elements: Sequence[Element], own: Mapping[str, float], values: Mapping[str, float], poses: Poses
) -> dict[str, Pose]:
    """All links at driver values, from where they lie at others (``own``), on paper of the mechanism's size.

    Raises
    ------
    Unsolvable : "not assembled": the motion does not reach the values
    """
    drivers = choices.structure.scene.drivers
    last: Unsolvable | None = None
    first, goal = [own[d.key] for d in drivers], [values[d.key] for d in drivers]
    for way in ways(drivers, first, goal, choices.structure.rolls):
        try:
            return _walk(choices, elements, own, dict(zip((d.key for d in drivers), way, strict=True)), poses)
        except Unsolvable as stop:
            last = last or stop
    assert last is not None
    raise last


def _walk(
    choices: Choices, elements: Sequence[Element], own: Mapping[str, float], target: Mapping[str, float], start: Poses
) -> dict[str, Pose]:
    scene = choices.structure.scene
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
        found = found_near(choices, elements, here, guess, at)
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


def _moved(one: Poses, other: Poses, size: float = 1.0) -> float:
    return max(abs(p.origin - other[n].origin) / size + abs(p.axis - other[n].axis) for n, p in one.items())


def found_near(
    choices: Choices, elements: Sequence[Element], values: Mapping[str, float], guess: Poses, start: Poses | None = None
) -> dict[str, Pose] | None:
    """All links of the elements at driver values near which a position is guessed, on paper of the mechanism's size;
    None where nothing fits near by.  What rolls is followed from ``start``."""
    structure = choices.structure
    ground = structure.scene.frame.name
    values = structure.followed(values)
    frame = PlacedLinks(structure.links, 1.0 / structure.scene.size, values, {ground: Pose(0j, 1 + 0j)})
    for element in elements:
        if isinstance(element, Driven):
            if isinstance(element.driver, Rolled):
                value = rolled_near(structure, frame, element.driver, guess if start is None else start, guess)
                frame.values = {**frame.values, element.driver.key: value}
            frame.poses[element.link], _ = drive(frame, element)
            continue
        if isinstance(element, Dyad):
            near = _nearest(frame, element, guess)
        else:
            reduced = best_reduced(choices, element, frame, guess)
            if reduced is not None and element.rolling:
                reduced = reduced.rolled_from(guess if start is None else start, frame.mm)
            near = fitted(reduced, frame, guess) if reduced is not None else None
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


def fitted(
    reduced: ReducedMechanism, known: PlacedLinks, guess: Poses, values: Sequence[float] | None = None
) -> dict[str, Pose] | None:
    """A larger group near a guess: the trial values by proportional division of the gaps that trial drawings leave,
    again and again (secant; with several trial drivers that of Broyden, Math. Comp. 19, 1965)."""
    at = np.array(reduced.values(guess, known.mm) if values is None else values)
    one = drawn_near(reduced, known, guess, at)
    if one is None:
        return None
    gap = np.array(reduced.gaps(one))
    slope = _slopes(reduced, known, guess, at, gap)
    if slope is None:
        return None
    for _ in range(ROUNDS):
        try:
            step = np.linalg.solve(slope, -gap)
        except np.linalg.LinAlgError:
            return None
        if not np.abs(step).max() <= 1.0:
            return None
        two = drawn_near(reduced, known, guess, at + step)
        if two is None:
            return None
        new = np.array(reduced.gaps(two))
        if np.abs(new).max() >= np.abs(gap).max() and np.abs(gap).max() < FIT:
            return reduced.put_back(one)
        if not step.any():
            break
        slope = slope + np.outer(new - gap - slope @ step, step) / (step @ step)
        at, one, gap = at + step, two, new
        if not gap.any():
            break
    return reduced.put_back(one) if np.abs(gap).max() < FIT else None


def _slopes(
    reduced: ReducedMechanism, known: PlacedLinks, guess: Poses, at: np.ndarray, gap: np.ndarray
) -> np.ndarray | None:
    """How the gaps change with the trial values."""
    columns = []
    for i in range(len(at)):
        moved = drawn_near(reduced, known, guess, at + NUDGE * np.eye(len(at))[i])
        if moved is None:
            return None
        columns.append((np.array(reduced.gaps(moved)) - gap) / NUDGE)
    return np.array(columns).T


def drawn_near(
    reduced: ReducedMechanism, known: PlacedLinks, guess: Poses, values: Sequence[float] | np.ndarray
) -> PlacedLinks | None:
    """A trial drawing of a group, each dyad in the assembly nearest to a guess."""
    frame = reduced.opened(known, [float(v) for v in values])
    for element in reduced.elements:
        if isinstance(element, Driven):
            frame.poses[element.link], _ = drive(frame, element)
            frame.settle([element.link])
            continue
        near = _nearest(frame, element, guess)
        if near is None:
            return None
        frame.poses.update(near)
        frame.settle(list(near))
    return frame


def best_reduced(choices: Choices, cluster: Cluster, known: PlacedLinks, guess: Poses) -> ReducedMechanism | None:
    """The reduced mechanism that finds the group well: a small gap means a small error of every link, and no link
    outruns the trial driver by much.  None where all are at dead points."""
    last = choices.last.get(cluster)
    if last is not None and _quality(last, known, guess) > GOOD / 2:
        return last
    best: tuple[float, ReducedMechanism] | None = None
    for reduced in choices.of[cluster]:
        quality = _quality(reduced, known, guess)
        if quality > 0.0 and (best is None or quality > best[0]):
            best = quality, reduced
            if quality > GOOD:
                break
    if best is None:
        return None
    choices.last[cluster] = best[1]
    return best[1]


def _quality(reduced: ReducedMechanism, known: PlacedLinks, guess: Poses) -> float:
    reduced = reduced.rolled_from(guess, known.mm)
    at = np.array(reduced.values(guess, known.mm))
    one = drawn_near(reduced, known, guess, at)
    if one is None:
        return 0.0
    group = {n: pose for n, pose in one.poses.items() if n in reduced.cluster.members}
    gap = np.array(reduced.gaps(one))
    quality, slopes = 1.0, []
    size = known.mm * reduced.structure.scene.size
    for i in range(len(at)):
        two = drawn_near(reduced, known, guess, at + NUDGE * np.eye(len(at))[i])
        if two is None:
            return 0.0
        slopes.append((np.array(reduced.gaps(two)) - gap) / NUDGE)
        grown = max(_moved(group, two.poses, size), 1e-12) / NUDGE
        slopes[-1] /= grown
        quality = min(quality, 2.0 / grown)
    least = float(np.linalg.svd(np.array(slopes), compute_uv=False)[-1]) if len(at) > 1 else abs(float(slopes[0][0]))
    return quality * least
