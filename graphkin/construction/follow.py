"""From one position of a mechanism with larger groups to the next: trial drawings that start where the last ended."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from graphkin.construction.links_on_paper import PlacedLinks, assembled, meet, rolled_near
from graphkin.construction.reduced_mechanism import ReducedMechanism, RemovedConstraint, reduced_mechanisms
from graphkin.errors import Unsolvable
from graphkin.plane import Pose, Poses
from graphkin.scene.model import Driver
from graphkin.structure import Driven, Dyad, Element, LargerGroup, Rolled, Structure, started
from graphkin.structure.assembly import out_of_reach, ways

Array = NDArray[np.float64]

STEP, LONG_STEP = math.radians(2.0), math.radians(8.0)  # of the driver at most, with larger groups and without
FIT = 1e-12  # what is left out fits, in the size of the mechanism
SURPRISE = 1e-3  # so far from where it was expected a link may be found, in the size of the mechanism

NUDGE = 1e-4  # of the trial driver, to see how the gap changes
ROUNDS = 30
POOR = 0.01  # below this more constraints are removed than it takes
GOOD = 0.3  # a reduced mechanism as good as this is taken without a look at the others


class Choices:
    """The reduced mechanisms of each larger group of a mechanism, and which of them serve now."""

    def __init__(self, structure: Structure, elements: Sequence[Element]) -> None:
        self.structure, self.elements = structure, elements
        wanted = [c for c in structure.larger_groups if c in elements]
        self.of: Mapping[LargerGroup, list[ReducedMechanism]] = {c: reduced_mechanisms(structure, c) for c in wanted}
        self.last: dict[LargerGroup, ReducedMechanism] = {}
        self._further: dict[LargerGroup, list[ReducedMechanism]] = {}

    @cached_property
    def at_start(self) -> Choices:
        """Of the mechanism at the scene's own position, where what rolls and moves each other stands as it is given;
        these themselves where there is nothing of it."""
        if not any(group.starts for group in self.structure.larger_groups):
            return self
        there = started(self.structure)
        wanted = {n for element in self.elements for n in element.members}
        return Choices(there, [e for e in there.elements if wanted.intersection(e.members)])

    def further(self, group: LargerGroup) -> list[ReducedMechanism]:
        """Those with more constraints removed than it takes, for where the others are at dead points."""
        if group not in self._further:
            try:
                fewest = len(self.of[group][0].removed)
                self._further[group] = reduced_mechanisms(self.structure, group, fewest)
            except Unsolvable:
                self._further[group] = []
        return self._further[group]


def moved_to(
    choices: Choices, elements: Sequence[Element], own: Mapping[str, float], values: Mapping[str, float], poses: Poses
) -> dict[str, Pose]:
    """All links at driver values, from where they lie at others (``own``), on paper of the mechanism's size.

    Raises
    ------
    Unsolvable : "not assembled": the motion does not reach the values; the message gives the limit
    """
    scene = choices.structure.scene
    first, goal = [own[d.key] for d in scene.drivers], [values[d.key] for d in scene.drivers]
    limits: list[Mapping[str, float]] = []
    for way in ways(scene.drivers, first, goal, choices.structure.rolls):
        target = dict(zip((d.key for d in scene.drivers), way, strict=True))
        length = max(abs(target[d.key] - own[d.key]) / d.span(scene.size) for d in scene.drivers)
        longest = 1.0 / max(1, math.ceil(length / (STEP if choices.of else LONG_STEP)))
        # nothing says yet where the links go: the first step is small
        pace = Pace(longest, longest / 64, SURPRISE, SURPRISE, longest / 1e10)

        def at(part: float, target: Mapping[str, float] = target) -> dict[str, float]:
            return {k: own[k] + part * (target[k] - own[k]) for k in own}

        def near(part: float, guess: Poses, there: Poses, at: Callable[[float], dict[str, float]] = at) -> Poses | None:
            return found_near(choices, elements, at(part), guess, there)

        part, found = [(0.0, poses), *walk(near, poses, 0.0, 1.0, pace)][-1]
        if part == 1.0:
            return dict(found)
        limits.append(at(part))
    raise Unsolvable("not assembled", out_of_reach(scene, dict(zip(own, goal, strict=True)), limits))


@dataclass(frozen=True)
class Pace:
    """How a motion is followed: its longest and its first step, so far from where it was expected a link may be found
    (in the size of the mechanism; and at the first step), and the step below which it is taken to end."""

    longest: float
    first: float
    surprise: float
    at_first: float
    shortest: float


def walk(
    near: Callable[[float, Poses, Poses], Poses | None], start: Poses, begin: float, end: float, pace: Pace
) -> Iterator[tuple[float, Poses]]:
    """The positions from one to another, each followed from the one before; they end where the motion does.

    Parameters
    ----------
    near : the position at a place of the way near which it is guessed, and the one before; None where nothing fits
    begin, end : places of the way
    """
    before, at, t = start, start, begin
    step = last = pace.first
    while t < end:
        step = min(step, pace.longest, end - t)
        going = t > begin
        guess = _ahead(before, at, step / last) if going else at
        found = near(t + step, guess, at)
        if found is None or moved(guess, found) > (pace.surprise + 0.3 * moved(at, found) if going else pace.at_first):
            step /= 2
            if step < pace.shortest:
                return
            continue
        before, at, t, last = at, found, (end if step >= end - t else t + step), step
        step *= 2
        yield t, at


def _ahead(before: Poses, at: Poses, times: float) -> dict[str, Pose]:
    """The next position if everything went on as in the last step."""
    made = {}
    for name, pose in at.items():
        old = before[name]
        axis = pose.axis * cmath.rect(1.0, cmath.phase(pose.axis / old.axis) * times)
        made[name] = Pose(pose.origin + (pose.origin - old.origin) * times, axis / abs(axis))
    return made


def moved(one: Poses, other: Poses, size: float = 1.0) -> float:
    """How far the link that moves most does (in the size of the mechanism, and its direction)."""
    apart = (abs(p.origin - other[n].origin) / size + abs(p.axis - other[n].axis) for n, p in one.items())
    return max(apart, default=0.0)


def found_near(
    choices: Choices, elements: Sequence[Element], values: Mapping[str, float], guess: Poses, start: Poses | None = None
) -> dict[str, Pose] | None:
    """All links of the elements at driver values near which a position is guessed, on paper of the mechanism's size;
    None where nothing fits near by.  What rolls is followed from ``start``."""
    structure = choices.structure
    ground = structure.scene.frame.name
    values = structure.followed(values)
    paper = PlacedLinks(structure.links, 1.0 / structure.scene.size, values, {ground: Pose(0j, 1 + 0j)})
    from_there = guess if start is None else start

    def choose(_: int, element: Dyad | LargerGroup) -> Poses | None:
        if isinstance(element, Dyad):
            return _nearest(paper, element, guess)
        trial = _best(choices, element, paper, guess)
        if trial is not None and element.rolling:
            return fitted(choices.last[element].rolled_from(from_there, paper.mm), paper, guess)
        return None if trial is None else _closed(trial, paper, guess)

    def rolled(driver: Rolled) -> float:
        return rolled_near(structure, paper, driver, from_there, guess)

    return dict(paper.poses) if assembled(paper, elements, choose, rolled) else None


def _nearest(paper: PlacedLinks, dyad: Dyad, guess: Poses) -> Poses | None:
    """The assembly of a dyad that lies nearest to a guess."""
    meeting = meet(paper, dyad)
    branch = meeting.nearest(guess)
    return None if branch is None else meeting.poses[branch]


@dataclass(frozen=True)
class _Tried:
    """A trial drawing of a larger group: the trial values, what is drawn, the gaps that it leaves, how these change
    with the values, and how well it finds the group (0: not at all)."""

    reduced: ReducedMechanism
    at: Array
    drawn: PlacedLinks
    gap: Array
    slope: Array
    quality: float


def _tried(
    reduced: ReducedMechanism, known: PlacedLinks, guess: Poses, values: Sequence[float] | None = None
) -> _Tried | None:
    """A trial drawing near a guess; a small gap shall mean a small error of every link, and no link outrun the trial
    driver by much."""
    at = np.array(reduced.values(guess, known.mm) if values is None else values)
    one = drawn_near(reduced, known, guess, at)
    if one is None:
        return None
    group = {n: pose for n, pose in one.poses.items() if n in reduced.group.members}
    gap = np.array(reduced.gaps(one))
    quality, slopes, each = 1.0, [], []
    size = known.mm * reduced.structure.scene.size
    for step in NUDGE * np.eye(len(at)):
        two = drawn_near(reduced, known, guess, at + step)
        if two is None:
            return None
        slopes.append((np.array(reduced.gaps(two)) - gap) / NUDGE)
        grown = max(moved(group, two.poses, size), 1e-12) / NUDGE
        each.append(slopes[-1] / grown)
        quality = min(quality, 2.0 / grown)
    least = float(np.linalg.svd(np.array(each), compute_uv=False)[-1]) if len(at) > 1 else abs(float(each[0][0]))
    return _Tried(reduced, at, one, gap, np.array(slopes).T, quality * least)


def fitted(
    reduced: ReducedMechanism, known: PlacedLinks, guess: Poses, values: Sequence[float] | None = None
) -> dict[str, Pose] | None:
    """A larger group near a guess: the trial values by proportional division of the gaps that trial drawings leave,
    again and again (secant; with several trial drivers that of Broyden, Math. Comp. 19, 1965)."""
    if not reduced.trial:  # everything stands as it is given
        drawn = drawn_near(reduced, known, guess, ())
        return None if drawn is None else reduced.put_back(drawn)
    start = _tried(reduced, known, guess, values)
    return None if start is None else _closed(start, known, guess)


def _closed(start: _Tried, known: PlacedLinks, guess: Poses) -> dict[str, Pose] | None:
    """``fitted`` from a trial drawing on."""
    reduced, at, one, gap, slope = start.reduced, start.at, start.drawn, start.gap, start.slope
    for _ in range(ROUNDS):
        try:
            step = np.linalg.solve(slope, -gap)
        except np.linalg.LinAlgError:
            break
        if not np.abs(step).max() <= 1.0:
            break  # nowhere near, or nothing but rounding is left
        two = drawn_near(reduced, known, guess, at + step)
        if two is None:
            break
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


def drawn_near(
    reduced: ReducedMechanism, known: PlacedLinks, guess: Poses, values: Sequence[float] | np.ndarray
) -> PlacedLinks | None:
    """A trial drawing of a group, each dyad in the assembly nearest to a guess."""
    paper = reduced.opened(known, [float(v) for v in values])

    def choose(_: int, dyad: Dyad | LargerGroup) -> Poses | None:
        assert isinstance(dyad, Dyad)
        return _nearest(paper, dyad, guess)

    return paper if assembled(paper, reduced.elements, choose) else None


def best_reduced(choices: Choices, group: LargerGroup, known: PlacedLinks, guess: Poses) -> ReducedMechanism | None:
    """The reduced mechanism that finds the group well; None where all are at dead points."""
    return None if _best(choices, group, known, guess) is None else choices.last[group]


def _best(choices: Choices, group: LargerGroup, known: PlacedLinks, guess: Poses) -> _Tried | None:
    """The trial drawing by it, which is the last of the choices then."""
    last = choices.last.get(group)
    best = _tried(last.rolled_from(guess, known.mm), known, guess) if last is not None else None
    if best is not None and best.quality > GOOD / 2:
        return best
    best = _best_of(choices.of[group], known, guess)
    if best is None or best.quality < POOR:
        further = _best_of(choices.further(group), known, guess)
        if further is not None and (best is None or further.quality > best.quality):
            best = further
    if best is not None:
        choices.last[group] = best.reduced
    return best


def _best_of(candidates: Sequence[ReducedMechanism], known: PlacedLinks, guess: Poses) -> _Tried | None:
    best: _Tried | None = None
    for reduced in candidates:
        now = _tried(reduced.rolled_from(guess, known.mm), known, guess)
        if now is not None and now.quality > (0.0 if best is None else best.quality):
            best = now
            if now.quality > GOOD:
                break
    return best


def best_first(
    structure: Structure, group: LargerGroup, known: PlacedLinks, guess: Poses
) -> Iterator[ReducedMechanism]:
    """The reduced mechanisms that can be drawn, those first that find the group best; those with the fewest constraints
    removed before the others."""
    choices = Choices(structure, [group])
    for some in (choices.of[group], choices.further(group)):
        tried = (_tried(reduced.rolled_from(guess, known.mm), known, guess) for reduced in some)
        for one in sorted(filter(None, tried), key=lambda one: -one.quality):
            yield one.reduced


def standing(choices: Choices, group: LargerGroup, known: PlacedLinks, guess: Poses) -> ReducedMechanism | None:
    """A group in which links roll and move each other at the scene's own position, ``choices`` being of the mechanism
    that drivers hold there: without its rolling.  None where all are at dead points."""
    removed: list[RemovedConstraint] = []
    trial: list[Driver] = []
    drawn: list[Driven | Dyad] = []
    held: dict[str, tuple[str, float]] = {}
    before = replace(known, poses=dict(known.poses))
    mine = [e for e in choices.structure.elements if set(e.members) <= set(group.members)]
    for k, element in enumerate(mine):
        if isinstance(element, LargerGroup):
            # what later ones hang on is not left out
            wanted = {name for later in mine[k + 1 :] for name in later.outside}
            few_or_more = (choices.of[element], choices.further(element))
            served = ([r for r in some if wanted.isdisjoint(x.left_out for x in r.removed)] for some in few_or_more)
            found = (_best_of(some, before, guess) for some in served)
            best = next((one for one in found if one is not None), None)
            if best is None:
                return None
            removed += best.reduced.removed
            trial += best.reduced.trial
            drawn += best.reduced.elements
            held.update(best.reduced.held)
        else:
            drawn.append(element)
        before.poses.update({name: guess[name] for name in element.members})
    return ReducedMechanism(choices.structure, tuple(removed), tuple(trial), group, tuple(drawn), held=held)
