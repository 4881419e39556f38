"""A group larger than a dyad placed on paper by trial positions.

Something of the group is left out, and a link of it moved in steps; the free end that should fit describes a curve,
which the arc or the line on which it must lie cuts at the place sought.  Between the two trials next to it what is left
open is divided proportionally, until what was left out fits.

Moving one thing, what is missed changes its sense between two neighbouring trials, and is divided between them (regula
falsi).  Moving several, what is missed in one trial more than there are of them is taken to change evenly; the position
so found takes the place of the trial that misses most (Hain, Applied Kinematics; Ortega and Rheinboldt, Iterative
solution of nonlinear equations in several variables: the sequential secant method).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from graphkin.construction.dyads import Story, drive, meet
from graphkin.construction.follow import best_first, drawn_near, fitted
from graphkin.construction.instruments import EXACT
from graphkin.construction.links_on_paper import PlacedLinks, Pose, Poses
from graphkin.construction.proportional_division import divide, shares
from graphkin.construction.reduced_mechanism import ReducedMechanism, RemovedConstraint
from graphkin.construction.steps import (
    Bar,
    CompassArc,
    Missed,
    Moved,
    Step,
    Stroke,
    TrialCurve,
    TrialPositions,
    TrialRow,
    TrialTable,
)
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import Driver
from graphkin.structure import Driven
from graphkin.words import Phrase

__all__ = ["GroupTrial"]

POINTS = 7  # trial positions drawn
BETWEEN = 6  # parts into which the curve between two of them is divided
AWAY = 0.35  # of the trial driver (rad, or the mechanism's size): how far the first trial is from the last
AGAIN = 2  # times that a trial drawing is drawn which does not close by hands that err
PARTS = (1, 4, 16)  # steps in which links known already are moved to where hands put them
BEFORE = 0.45  # part of the trial positions that lie before the place sought; so that none falls on it
DIVISIONS, UNSEEN = 4, 0.02  # divisions at most, until so little (mm, degrees) is missed
STEP = 0.06  # from trial to trial of several drivers (rad, or the mechanism's size)
BEFORE = 0.45  # part of it that lies before the place sought
LEAST = 1e-3  # of the largest singular value: trials that tell less about one of what is moved are not divided


@dataclass(frozen=True)
class GroupTrial:
    """By which reduced mechanism a group is placed, and where every link lies then with the mechanism of size 1.

    ``given`` at the position from which rolling starts, where links stand as the problem says.
    """

    reduced: ReducedMechanism
    poses: Poses
    given: bool = False

    def on(self, paper: PlacedLinks) -> dict[str, Pose]:
        """Where the links lie, at the scale of a sheet."""
        mm = paper.mm * self.reduced.structure.scene.size
        return {name: pose.scaled(mm) for name, pose in self.poses.items()}

    def place(self, paper: PlacedLinks) -> None:
        """Place a group among the links known already.

        Where errors of the hand bring a trial drawing to a dead point it is drawn again, and then something else is
        left out.

        Raises
        ------
        Unsolvable : "not assembled": what was left out fits nowhere near
        """
        if paper.instrument.faultless:
            exact = replace(paper, instrument=EXACT, poses=dict(paper.poses), pricked=dict(paper.pricked))
            paper.poses.update(_fit(exact, self.reduced, self.on(paper)))
            return
        stops: list[Unsolvable] = []
        for reduced in _to_hand(paper, self):
            for _ in range(AGAIN):
                try:
                    _placed_by_hand(paper, reduced, self.on(paper))
                except Unsolvable as stop:
                    stops.append(stop)
                else:
                    return
        raise stops[0]

    def steps(self, paper: PlacedLinks, so_far: PlacedLinks) -> Story:
        """What is drawn to place a group: the trial curve with what it must meet, then each part of it in its place."""
        reduced = self.reduced
        poses = {**so_far.poses, **{n: paper.poses[n] for n in reduced.group.members}}
        values = np.array(reduced.values(poses, paper.mm))
        story: list[Step] = []
        if self.given:
            story += [_started(paper, driver) for driver in reduced.group.starts]
        if reduced.trial:
            driven = tuple(d.key for d in reduced.trial)
            strokes: tuple[Stroke, ...] = ()
            point, table = "", None
            if len(values) == 1:
                tried = _trial_drawings(replace(so_far, instrument=EXACT), reduced, poses, values)
                point, strokes = _curve(so_far, reduced, poses, tried)
                table = table_of_one(so_far, reduced, tried[::BETWEEN], BEFORE) if tried else None
            else:
                table = table_of_several(so_far, reduced, poses, values)
            rolling = tuple(r.name for r in reduced.removed if r.rolling is not None)
            left_out = tuple(name for name in reduced.left_out if name not in rolling)
            links, instead = reduced.group.links, tuple(reduced.driven_instead())
            told = TrialPositions(links, driven, left_out, point, POINTS, rolling, table, instead)
            story.append(Step("trial", "positions", strokes=strokes, data=told))
        board = reduced.opened(so_far, [float(v) for v in values])
        board = replace(board, instrument=EXACT)
        for element in reduced.elements:
            if isinstance(element, Driven):
                pose, told_here = drive(board, element)
                axis = cmath.phase(pose.axis)  # found by trial, whatever it was tried against
                told_here = tuple(
                    replace(step, value=axis, base="") if step.reason == "angle" else step for step in told_here
                )
            else:
                meeting = meet(board, element)
                best = meeting.nearest(poses)
                told_here = meeting.tell(best) if best is not None else ()
            story += told_here
            for name in element.members:
                board.poses[name] = poses[name]
        return tuple(story)


def _to_hand(paper: PlacedLinks, trial: GroupTrial) -> Iterator[ReducedMechanism]:
    """The reduced mechanism of a trial, then others; links that roll stand as they are given in their own only."""
    yield trial.reduced
    if trial.given:
        return
    guess = trial.on(paper)
    known = replace(paper, instrument=EXACT, poses={name: guess.get(name, paper.poses[name]) for name in paper.poses})
    known.pricked = {}
    yield from best_first(trial.reduced.structure, trial.reduced.group, known, guess)


def _fit(known: PlacedLinks, reduced: ReducedMechanism, guess: Poses) -> dict[str, Pose]:
    """The group among links that lie near where they are guessed; these are moved there in steps where at once nothing
    closes."""
    there = replace(known, poses={name: guess.get(name, known.poses[name]) for name in known.poses}, pricked={})
    exact = {p: there.point(n, p) for n in there.poses for p in known.links[n].points if p in known.pricked}
    for parts in PARTS:
        poses = dict(guess)
        for k in range(1, parts + 1):
            part = k / parts
            there.pricked = {p: z + part * (known.pricked[p] - z) for p, z in exact.items()}
            there.poses = {n: _between(guess.get(n, pose), pose, part) for n, pose in known.poses.items()}
            fit = fitted(reduced, there if k < parts else known, poses)
            if fit is None:
                break
            if k == parts:
                return fit
            poses.update(fit)
    names = ", ".join(reduced.group.links)
    raise Unsolvable(
        "not assembled", Problem(Phrase("links", links=names), Phrase("no trial position closes this group here"))
    )


def _between(one: Pose, two: Pose, part: float) -> Pose:
    axis = one.axis + part * (two.axis - one.axis)
    return Pose(one.origin + part * (two.origin - one.origin), axis / abs(axis))


def _placed_by_hand(paper: PlacedLinks, reduced: ReducedMechanism, guess: Poses) -> None:
    """The last trial by hands that err, what it leaves open, and the drawing that this asks for."""
    exact = replace(paper, instrument=EXACT, poses=dict(paper.poses), pricked=dict(paper.pricked))
    poses = {**paper.poses, **_fit(exact, reduced, guess)}
    values = np.array(reduced.values(poses, paper.mm))
    if reduced.trial:
        at, slopes = _by_hand(paper, reduced, poses, values)
        values = values - np.linalg.solve(slopes, at)
    last = drawn_near(reduced, paper, poses, values)
    if last is None:
        names = ", ".join(reduced.group.links)
        raise Unsolvable(
            "not assembled", Problem(Phrase("links", links=names), Phrase("the last trial drawing does not close"))
        )
    paper.pricked.update(last.pricked)
    paper.poses.update(reduced.put_back(last))
    paper.settle([r.left_out for r in reduced.removed if r.left_out])


def _by_hand(
    paper: PlacedLinks, reduced: ReducedMechanism, poses: Poses, values: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """What a trial drawing leaves open as hands find and read it, and how that changes with the trial values."""
    drawn = drawn_near(reduced, paper, poses, values)
    if drawn is None:
        names = ", ".join(reduced.group.links)
        raise Unsolvable(
            "not assembled", Problem(Phrase("links", links=names), Phrase("a trial drawing does not close"))
        )
    size = paper.mm * reduced.structure.scene.size
    gaps = np.array([
        gap if one.is_angle else paper.instrument.read(gap * size) / size
        for gap, one in zip(reduced.gaps(drawn), reduced.removed, strict=True)
    ])  # fmt: skip
    exact = replace(paper, instrument=EXACT, poses=dict(paper.poses), pricked={})
    step = 1e-6
    rows = []
    for i in range(len(values)):
        sides = [drawn_near(reduced, exact, poses, values + s * step * np.eye(len(values))[i]) for s in (-1, 1)]
        if sides[0] is None or sides[1] is None:
            raise Unsolvable("dead point", Problem("trial", Phrase("the trial drawing is at a dead point")))
        rows.append((np.array(reduced.gaps(sides[1])) - np.array(reduced.gaps(sides[0]))) / (2 * step))
    return gaps, np.array(rows).T


def _started(paper: PlacedLinks, driver: Driver) -> Step:
    """What is given of a link, or of a pair, at the position from which rolling starts."""
    if driver.turns:
        return Step("lay off", "rolling", link=driver.link, value=cmath.phase(paper.poses[driver.link].axis))
    return Step("lay off", "rolling", pairs=(driver.key,), mm=driver.values[0] * paper.mm)


def _trial_drawings(
    known: PlacedLinks, reduced: ReducedMechanism, poses: Poses, values: np.ndarray
) -> list[tuple[float, PlacedLinks]]:
    """Drawings at trial values on either side of the place sought, so near that all can be drawn; none where even the
    nearest cannot."""
    parts = (POINTS - 1) * BETWEEN
    away = AWAY
    for _ in range(6):
        near: dict[int, PlacedLinks] = {}
        for i in sorted(range(parts + 1), key=lambda i: abs(i - BEFORE * parts)):
            beside = next((near[j].poses for j in (i - 1, i + 1) if j in near), poses)
            drawn = drawn_near(reduced, known, beside, values + away * (i / parts - BEFORE))
            if drawn is None:
                break
            near[i] = drawn
        else:
            return [(float(values[0]) + away * (i / parts - BEFORE), near[i]) for i in range(parts + 1)]
        away /= 2.0
    return []


def _curve(
    known: PlacedLinks, reduced: ReducedMechanism, poses: Poses, tried: Sequence[tuple[float, PlacedLinks]]
) -> tuple[str, tuple[Stroke, ...]]:
    """The free end in some trial positions, and the arc or the line that it must meet; nothing where what is left out
    is an angle or a driver."""
    removed = reduced.removed[0]
    if not removed.ends or not tried:
        return "", ()
    if removed.slide is None and removed.ends[0][1] not in reduced.group.members:
        removed = replace(removed, ends=removed.ends[::-1])  # the free end is the one that moves
    places = tuple(_seen(drawn, removed, poses) for _, drawn in tried)
    curve = TrialCurve(places, places[::BETWEEN], removed.ends[0][0])
    return removed.ends[0][0], (curve, *_goal(known, removed, poses))


def _seen(drawn: PlacedLinks, removed: RemovedConstraint, poses: Poses) -> complex:
    """The free end as seen from what it must meet: from the bar's other end, or from the link with the guide."""
    free = _at(drawn, drawn.poses, *removed.ends[0])
    if removed.slide is None:
        return free - _at(drawn, drawn.poses, *removed.ends[1]) + _at(drawn, poses, *removed.ends[1])
    base = removed.other_side
    was, lies = drawn.poses[base], poses[base]
    return lies.place((free - was.origin) / was.axis)


def _at(paper: PlacedLinks, poses: Poses, point: str, link: str) -> complex:
    pose = poses[link]
    return pose.origin + pose.axis * paper.links[link].points[point] * paper.mm


def _goal(paper: PlacedLinks, removed: RemovedConstraint, poses: Poses) -> tuple[Stroke, ...]:
    free = _at(paper, poses, *removed.ends[0])
    if removed.slide is None:
        centre = _at(paper, poses, *removed.ends[1])
        return (CompassArc(centre, abs(free - centre), free),)
    along = removed.along(poses)
    reach = 0.2 * paper.mm * max((abs(z) for link in paper.links.values() for z in link.points.values()), default=0.0)
    return (Bar(free - along * reach, free + along * reach, ""),)


# -- what is measured in trial positions -------------------------------------------------------------------------------


def table_of_one(
    known: PlacedLinks, reduced: ReducedMechanism, tried: Sequence[tuple[float, PlacedLinks]], before: float
) -> TrialTable:
    """The table of one trial driver.

    Parameters
    ----------
    tried : trial positions in their order
    before : the part of them that lies before the place sought
    """
    columns = _Columns(known, reduced)
    exact = replace(known, instrument=EXACT)
    trials = [(value, reduced.gaps(drawn)[0]) for value, drawn in tried]
    over = [i for i, ((_, a), (_, b)) in enumerate(pairwise(trials)) if a * b < 0.0]
    sides = min(over, key=lambda i: abs(i + 0.5 - before * (len(tried) - 1)), default=None)
    divided: list[tuple[float, float]] = []
    if sides is not None:
        (a, one), (b, two) = trials[sides], trials[sides + 1]
        near: Poses = tried[sides][1].poses
        while len(divided) < DIVISIONS and not (divided and columns.is_unseen([divided[-1][1]])):
            c = (a * two - b * one) / (two - one)
            drawn = drawn_near(reduced, exact, near, np.array([c]))
            if drawn is None:
                break
            gap, near = reduced.gaps(drawn)[0], drawn.poses
            divided.append((c, gap))
            (a, one), (b, two) = ((c, gap), (b, two)) if gap * two < 0.0 else ((a, one), (c, gap))
            if gap == 0.0:
                break
    return TrialTable(
        columns.moved, columns.missed, tuple(columns.row([v], [gap]) for v, gap in trials),
        tuple(columns.row([v], [gap]) for v, gap in divided), (sides or 0) + 1,
    )  # fmt: skip


def table_of_several(
    known: PlacedLinks, reduced: ReducedMechanism, poses: Poses, values: np.ndarray
) -> TrialTable | None:
    """The table of several trial drivers, for the position in which links lie; None where no trials about it can be
    drawn."""
    columns = _Columns(known, reduced)
    exact = replace(known, instrument=EXACT)

    def missed(at: np.ndarray) -> np.ndarray | None:
        drawn = drawn_near(reduced, exact, poses, at)
        return None if drawn is None else np.array(reduced.gaps(drawn))

    tried = next((made for i in range(6) if (made := _trials_about(missed, values, STEP / 2**i))), None)
    if tried is None:
        return None
    at, gaps = [v for v, _ in tried], [gap for _, gap in tried]
    parts: tuple[float, ...] = ()
    divided: list[TrialRow] = []
    instead: list[int] = []
    while len(divided) < DIVISIONS:
        slopes = np.array([gap - gaps[0] for gap in gaps[1:]]).T
        sizes = np.linalg.svd(slopes, compute_uv=False)
        if sizes[-1] <= LEAST * sizes[0] or not sizes[0]:
            break
        found = divide(at, gaps)
        open_there = missed(found)
        if open_there is None:
            break
        parts = parts or tuple(map(float, shares(gaps)))
        divided.append(columns.row(found, open_there))
        if columns.is_unseen(open_there):
            break
        most = max(range(len(gaps)), key=lambda i: float(np.abs(gaps[i]).max()))
        at[most], gaps[most] = found, open_there
        instead.append(most + 1)
    trials = tuple(columns.row(v, gap) for v, gap in tried)
    return TrialTable(columns.moved, columns.missed, trials, tuple(divided), 0, parts, tuple(instead))


Tried = list[tuple[np.ndarray, np.ndarray]]


def _trials_about(missed: Callable[[np.ndarray], np.ndarray | None], values: np.ndarray, step: float) -> Tried | None:
    """Trials about a place, each further one with another of the values changed; None where one cannot be drawn."""
    found = []
    for one in (np.zeros(len(values)), *np.eye(len(values))):
        at = values + step * (one - BEFORE)
        gaps = missed(at)
        if gaps is None:
            return None
        found.append((at, gaps))
    return found


@dataclass(frozen=True)
class _Columns:
    """What stands in a table of trials: values and misses as they are measured on paper."""

    known: PlacedLinks
    reduced: ReducedMechanism

    @property
    def moved(self) -> tuple[Moved, ...]:
        return tuple(self._moved(driver)[0] for driver in self.reduced.trial)

    @property
    def missed(self) -> tuple[Missed, ...]:
        return tuple(_missed(self.reduced, removed, self.known.mm) for removed in self.reduced.removed)

    def row(self, values: Sequence[float] | np.ndarray, gaps: Sequence[float] | np.ndarray) -> TrialRow:
        """Values and gaps of a trial (rad, or the mechanism's size) in degrees and mm on paper."""
        shown = []
        for driver, value in zip(self.reduced.trial, values, strict=True):
            moved, ahead = self._moved(driver)
            shown.append(math.degrees(value + ahead) if moved.turned else value * self._size)
        return tuple(map(float, shown)), tuple(map(float, self._misses(gaps)))

    def is_unseen(self, gaps: Sequence[float] | np.ndarray) -> bool:
        return all(abs(miss) < UNSEEN for miss in self._misses(gaps))

    def _misses(self, gaps: Sequence[float] | np.ndarray) -> list[float]:
        removed = self.reduced.removed
        return [math.degrees(g) if r.is_angle else g * self._size for g, r in zip(gaps, removed, strict=True)]

    @property
    def _size(self) -> float:
        return self.known.mm * self.reduced.structure.scene.size

    def _moved(self, driver: Driver) -> tuple[Moved, float]:
        """What a trial driver moves, and how far (rad) its angle is ahead where it is taken to the x axis."""
        ground = self.reduced.structure.scene.frame.name
        if not driver.turns:
            return Moved(driver.key, "", False), 0.0
        if driver.relative_to in self.known.poses:  # a link that stands already: its angle is taken to the x axis
            return Moved(driver.link, "", True), cmath.phase(self.known.poses[driver.relative_to].axis)
        return Moved(driver.link, "" if driver.relative_to == ground else driver.relative_to, True), 0.0


def _missed(reduced: ReducedMechanism, removed: RemovedConstraint, mm: float) -> Missed:
    """What is measured of what was left out."""
    if removed.rolling is not None:
        return Missed("rolled", (removed.name,), 0.0, removed.is_angle)
    if removed.driver is not None and removed.driver.turns:
        return Missed("turn", (removed.driver.relative_to, removed.driver.link), 0.0, removed.is_angle)
    if removed.driver is not None:
        return Missed("travel", (removed.driver.key,), 0.0, removed.is_angle)
    if removed.second is not None:
        return Missed("guides", (removed.left_out,), 0.0, removed.is_angle)
    ends = tuple(point for point, _ in removed.ends)
    if removed.slide is not None:
        return Missed("guide", (*ends, removed.slide.key), 0.0, removed.is_angle)
    own = reduced.structure.links[removed.left_out].points
    return Missed("bar", ends, abs(own[ends[1]] - own[ends[0]]) * mm, removed.is_angle)
