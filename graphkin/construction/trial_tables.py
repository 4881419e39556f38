"""What is measured in the trial positions of a group, and how it is divided proportionally.

Moving one thing, what is missed changes its sense between two neighbouring trials, and is divided between them (regula
falsi).  Moving several, what is missed in one trial more than there are of them is taken to change evenly; the position
so found takes the place of the trial that misses most (Hain, Applied Kinematics; Ortega and Rheinboldt, Iterative
solution of nonlinear equations in several variables: the sequential secant method).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from graphkin.construction.board import EXACT
from graphkin.construction.follow import drawn_near
from graphkin.construction.links_on_paper import PlacedLinks, Poses
from graphkin.construction.mechanism_acts import Missed, Moved, TrialRow, TrialTable
from graphkin.construction.reduced_mechanism import ReducedMechanism
from graphkin.construction.removed_constraint import RemovedConstraint
from graphkin.plane import added_up
from graphkin.scene.model import AngleDriver, AnyDriver

__all__ = ["table_of_one", "table_of_several"]

DIVISIONS, UNSEEN = 4, 0.02  # divisions at most, until so little (mm, degrees) is missed
STEP = 0.06  # from trial to trial of several drivers (rad, or the mechanism's size)
BEFORE = 0.45  # part of it that lies before the place sought
LEAST = 1e-3  # of the largest singular value: trials that tell less about one of what is moved are not divided


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
        shares = np.linalg.solve(slopes, -gaps[0])
        found = at[0] + added_up(x * (v - at[0]) for x, v in zip(shares, at[1:], strict=True))
        open_there = missed(found)
        if open_there is None:
            break
        parts = parts or tuple(float(x) for x in shares)
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

    def _moved(self, driver: AnyDriver) -> tuple[Moved, float]:
        """What a trial driver moves, and how far (rad) its angle is ahead where it is taken to the x axis."""
        frame = self.reduced.structure.scene.frame.name
        if not isinstance(driver, AngleDriver):
            return Moved(driver.key, "", False), 0.0
        if driver.relative_to in self.known.poses:  # a link that stands already: its angle is taken to the x axis
            return Moved(driver.link, "", True), cmath.phase(self.known.poses[driver.relative_to].axis)
        return Moved(driver.link, "" if driver.relative_to == frame else driver.relative_to, True), 0.0


def _missed(reduced: ReducedMechanism, removed: RemovedConstraint, mm: float) -> Missed:
    """What is measured of what was left out."""
    if removed.rolling is not None:
        return Missed("rolled", (removed.name,), 0.0, removed.is_angle)
    if isinstance(removed.driver, AngleDriver):
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
