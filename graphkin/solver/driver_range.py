"""The range of the first driver: how far the motion reaches from a position to both sides, whether it closes after some
turns, which assembly stands at each place of it, and the motion there.

Whatever goes over the driver's range goes this way: a solution elsewhere and over a turn, prepared mechanisms, the
study of a turn, the positions of a handout.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean
from graphkin.scene.model import AngleDriver, AnyDriver, Mechanism
from graphkin.solver.assemblies import choose_forms, own_values
from graphkin.solver.engine import positions
from graphkin.solver.error_bound import ErrorBound
from graphkin.solver.findings import assembly_words, limit_why, singular, structure_of, without_singular
from graphkin.solver.joints import Drive
from graphkin.solver.motion import Motion
from graphkin.solver.path import FAR, Path, follow_path
from graphkin.solver.pose import Array, rest
from graphkin.solver.redundant import all_slides, place_redundant
from graphkin.structure import Structure
from graphkin.structure.assembly import ways

__all__ = ["DriverRange", "driver_range", "goal_values", "motion_of", "range_from", "way_to", "whole_range"]

MOST_TURNS = 4
CLOSED = 1e-7
"""Two positions are the same where links lie closer than this, in the size of the mechanism, and turn closer (rad)."""


@dataclass(frozen=True)
class DriverRange:
    """The assembly of one position, carried along over the range of the first driver.

    Offsets count from the start value of the first driver, in rad or m, positive in the sense of its rate; parts are
    offsets divided by ``wide``.

    start : values of all drivers at offset 0, shape (drivers,) (rad, m)
    ahead, behind : the ways in the sense of the driver and against it; the same where it turns fully
    wide : how far each of them goes, if nothing ends it, signed (rad, m)
    turns : over how many turns of the driver it goes; 0 where the driver cannot turn fully, or slides
    """

    structure: Structure
    start: Array
    ahead: Path
    behind: Path
    wide: float
    turns: int

    @property
    def scene(self) -> Mechanism:
        return self.structure.scene

    @property
    def driver(self) -> AnyDriver:
        return self.scene.drivers[0]

    @property
    def full(self) -> bool:
        """Whether the driver can turn fully."""
        return self.turns > 0

    @property
    def sense(self) -> float:
        return float(np.copysign(1.0, self.wide))

    @cached_property
    def ends(self) -> tuple[float, float]:
        """Least and greatest offset that the motion reaches."""
        return (0.0 if self.full else -self.behind.reach * abs(self.wide)), self.ahead.reach * abs(self.wide)

    @property
    def limited(self) -> tuple[bool, bool]:
        """Whether the motion ends at the least and at the greatest offset, or is only not followed further."""
        return (not self.full and self.behind.limit is not None), self.ahead.limit is not None

    @cached_property
    def limit_why(self) -> str:
        """Why the motion ends."""
        path, other = (self.ahead, self.behind) if self.ahead.limit is not None else (self.behind, self.ahead)
        return "" if path.limit is None else limit_why(self.structure, self._own_forms, self.start, path, other)

    # offsets and values of the driver

    def value(self, offset: Array) -> Array:
        """Values of the first driver (rad, m) at these offsets."""
        return np.asarray(self.start[0] + self.sense * np.asarray(offset))

    def values(self, offset: Array) -> Array:
        """Values of all drivers, shape (n, drivers)."""
        values = np.repeat(self.start[None], len(offset), axis=0)
        values[:, 0] = self.value(offset)
        return values

    def offsets(self, value: Array) -> Array:
        """The offsets at which the motion comes to these values of the first driver, or would; of an angle at most a
        turn ahead, or as far behind as the motion reaches."""
        offset = self.sense * (value - self.start[0])
        if isinstance(self.driver, AngleDriver):
            offset = np.remainder(offset, 2 * np.pi)
            offset = offset if self.full else np.where(offset <= self.ends[1], offset, offset - 2 * np.pi)
        return np.asarray(offset)

    def reaches(self, offset: Array) -> Array:
        """Whether the motion comes to these offsets, shape (n,)."""
        low, high = self.ends
        return np.asarray((offset >= low) & (offset <= high))

    def table_offsets(self, n: int, first: int = 0, last: int | None = None) -> Array:
        """Offsets of positions ``first`` to ``last`` (not included) of a table of n: over a turn from the start on, or
        evenly inside the range of travel."""
        k = np.arange(first, n if last is None else last)
        if isinstance(self.driver, AngleDriver):
            return np.asarray(k / n * (2 * np.pi))
        low, high = self.ends
        return np.asarray(low + (k + 0.5) / n * (high - low))

    # the assembly

    def forms(self, part: Array) -> dict[int, Array]:
        """The form of each group at parts of the range, for ``positions``; beyond its ends that at the end."""
        ahead, t, s = self._split(part)
        forms = self.ahead.form(t)
        if ahead.all():
            return forms
        other = self.behind.form(s)
        return {i: np.where(ahead.reshape(-1, *[1] * (f.ndim - 1)), f, other[i]) for i, f in forms.items()}

    def turned(self, part: Array) -> dict[str, Array]:
        """How far each link that is not redundant has turned since the start (rad), whole turns included, to a few
        degrees."""
        ahead, t, s = self._split(part)
        turned = self.ahead.turned(t)
        if ahead.all():
            return turned
        other = self.behind.turned(s)
        return {name: np.where(ahead, angle, other[name]) for name, angle in turned.items()}

    def _split(self, part: Array) -> tuple[Array, Array, Array]:
        """Which parts lie ahead, and all of them as parameters of both ways."""
        return part >= 0, np.clip(part, 0.0, self.ahead.reach), np.clip(-part, 0.0, self.behind.reach)

    @cached_property
    def _own_forms(self) -> dict[int, Array]:
        return {i: f[0] for i, f in self.ahead.form(np.zeros(1)).items()}

    @cached_property
    def assembly(self) -> tuple[str, ...]:
        """For each group which assembly was taken."""
        return assembly_words(self.structure, self._own_forms)

    # the motion

    def motion(self, offset: Array, unit: bool = False, fine: bool = True) -> Motion:
        """The motion at these offsets, with status and reason at each.

        Parameters
        ----------
        offset : shape (n,); over the range of an angle driver that cannot turn fully an offset may also be meant the
            other way round
        unit : rates by the first driver's own value (rate 1, second rate 0, other drivers held) instead of the scene's
        fine : False for curves: 16 digits throughout, and no reasons where the status is not ok
        """
        offset = np.asarray(offset, dtype=float)
        low, high = self.ends
        if not self.full and isinstance(self.driver, AngleDriver):
            offset = np.where((offset > high) & (offset - 2 * np.pi >= low), offset - 2 * np.pi, offset)
        within = np.clip(offset, low, high)
        drive = Drive.at(self.structure, self.values(within))
        if unit:
            rate = np.zeros_like(drive.value)
            rate[:, 0] = self.sense
            drive = Drive(drive.value, rate, np.zeros_like(rate))
        return self._motion(within / abs(self.wide), self.values(offset), drive, self.reaches(offset), fine)

    def sweep(self, n: int) -> Motion:
        """The motion at n positions: over a full turn from the start on, or, by increasing travel, spread evenly inside
        the range of a driver that slides."""
        k, wide = np.arange(n), abs(self.wide)
        values = np.repeat(self.start[None], n, axis=0)
        if isinstance(self.driver, AngleDriver):
            values[:, 0] += self.sense * 2 * np.pi * k / n
            part = k / n / max(self.turns, 1)
            part = np.where(part <= self.ahead.reach, part, part - 1)
            good = -part <= self.behind.reach
        else:
            low, high = sorted(self.sense * end for end in self.ends)
            offset = low + (k + 0.5) / n * (high - low)
            values[:, 0] += offset
            part, good = self.sense * offset / wide, np.ones(n, dtype=bool)
        # positions out of reach are computed at the first one that is not, and thrown away
        fill = int(np.argmax(good))
        part, used = np.where(good, part, part[fill]), np.where(good[:, None], values, values[fill])
        return self._motion(part, values, Drive.at(self.structure, used), good)

    def _motion(self, part: Array, values: Array, drive: Drive, good: Array, fine: bool = True) -> Motion:
        why = "" if good.all() or not fine else self.limit_why
        found = motion_of(self.structure, drive, self.forms(part), self.assembly, good, why, fine)
        return replace(found, values=values, turned=self.turned(part))

    def angle(self, motion: Motion, link: str) -> Array:
        """The angle of a link in a motion of this range (rad), without jumps over the whole of it, whole turns
        included; in (-pi, pi] at the start."""
        here = np.angle(motion.poses[link].u)
        since = self._start_angle[link] + motion.turned.get(link, 0.0)
        return np.asarray(here + 2 * np.pi * np.rint((since - here) / (2 * np.pi)))

    @cached_property
    def _start_angle(self) -> dict[str, float]:
        poses = self.motion(np.zeros(1)).poses
        return {name: float(np.angle(np.where(np.isfinite(p.u), p.u, 1.0))[0]) for name, p in poses.items()}

    # whole turns

    def until_closed(self) -> DriverRange:
        """The range over as many turns of the driver as it takes until every link is where it was; this one turn where
        four do not close it, or where the driver does not turn fully."""
        if not self.full:
            return self
        longer = self
        for turns in range(1, MOST_TURNS + 1):
            if turns > 1:
                end = self.start + turns * self.wide * _first(self.start)
                path = follow_path(self.structure, self._own_forms, self.start, end)
                if path.limit is not None:
                    break
                longer = DriverRange(self.structure, self.start, path, path, turns * self.wide, turns)
            if longer._closes():
                return longer
        return self

    def _closes(self) -> bool:
        """Whether every link comes back to where it was at the start."""
        motion = self.motion(np.array(self.ends))
        poses = [motion.poses[link.name] for link in self.scene.links]
        return not motion.ok.all() or all(
            abs(p.z[1] - p.z[0]) < CLOSED * self.scene.size and abs(p.u[1] - p.u[0]) < CLOSED for p in poses
        )


def _first(like: Array) -> Array:
    unit = np.zeros_like(like)
    unit[0] = 1.0
    return unit


def driver_range(scene: Mechanism | Structure, at: Mapping[str, float] | None = None) -> DriverRange:
    """Follow a mechanism from its own position, or from other driver values, over a turn of its first driver, or as far
    as this slides.

    Parameters
    ----------
    at : driver values to start from, by driver key (rad, m)

    Raises
    ------
    SceneError : a group has several assemblies and no sketch tells which
    Unsolvable : wrong mobility, the start cannot be assembled or reached
    CallError : ``at`` names no driver
    """
    structure = structure_of(scene)
    forms, own, start = choose_forms(structure), own_values(structure.scene), goal_values(structure.scene, at)
    if not np.array_equal(own, start):
        path = way_to(structure, forms, start)
        if path.limit is not None:
            why = limit_why(structure, forms, own, path)
            raise Unsolvable("not assembled", Problem(structure.scene.name or "scene", why))
        forms = path.last_forms
    return range_from(structure, forms, start)


def whole_range(scene: Mechanism | Structure, at: Mapping[str, float] | None = None) -> DriverRange:
    """``driver_range`` over as many turns as it takes until the motion closes."""
    return driver_range(scene, at).until_closed()


def range_from(structure: Structure, forms: Mapping[int, Array], start: Array) -> DriverRange:
    """The range about driver values, shape (drivers,), at which the groups have these forms."""
    first = structure.scene.drivers[0]
    turning = isinstance(first, AngleDriver)
    wide = float(np.copysign(2 * np.pi if turning else FAR * structure.scene.size, first.values[1]))
    ahead = follow_path(structure, forms, start, start + wide * _first(start))
    full = turning and ahead.limit is None
    behind = ahead if full else follow_path(structure, forms, start, start - wide * _first(start))
    return DriverRange(structure, start, ahead, behind, wide, 1 if full else 0)


def way_to(structure: Structure, forms: Mapping[int, Array], goal: Array) -> Path:
    """The way from the scene's own position to other driver values: straight, else the other way round for drivers that
    turn; the straight one if none gets there."""
    start, first = own_values(structure.scene), None
    for end in ways(structure.scene.drivers, start.tolist(), goal.tolist()):
        path = follow_path(structure, forms, start, np.array(end))
        if path.limit is None:
            return path
        first = first or path
    assert first is not None
    return first


def goal_values(scene: Mechanism, at: Mapping[str, float] | None) -> Array:
    """The scene's driver values, but for those given by driver key, shape (drivers,).

    Raises
    ------
    CallError : a key that is no driver, a value that is no number
    """
    goal = own_values(scene)
    keys = [d.key for d in scene.drivers]
    for key, value in (at or {}).items():
        if key not in keys:
            raise CallError(Problem(f'at "{key}"', "there is no such driver", did_you_mean(key, keys)))
        if not np.isfinite(value):
            raise CallError(Problem(f'at "{key}"', f"{value} is no driver value"))
        goal[keys.index(key)] = value
    return goal


def motion_of(
    structure: Structure,
    drive: Drive,
    forms: Mapping[int, Array],
    assembly: tuple[str, ...],
    good: Array,
    why: str = "",
    fine: bool = True,
) -> Motion:
    """Positions in one pass over all driver values, their status, redundant links placed and checked.

    Parameters
    ----------
    forms : the form of each group at each position, as for ``positions``
    assembly : in words
    good, why : which positions the motion reaches, shape (n,), and why it does not reach the others
    fine : False leaves 16 digits where they are rough, and the reasons away
    """
    n = len(drive)
    state = positions(structure, drive, forms, fine=fine)
    status = np.where(good, "ok", "not assembled").astype("<U13")
    reasons = ["" if g else why for g in good]
    if fine:
        status, reasons = without_singular(structure, state, drive.value, forms, status, reasons)
    else:
        for _, dead in singular(structure, state, n):
            status[dead & good] = "dead point"
    ok = status == "ok"
    assert state.bounds is not None
    bound = ErrorBound(*(np.where(ok, b, np.nan) for b in state.bounds))
    rough = (np.where(ok, state.rough[0], np.nan), np.where(ok, state.rough[1], np.nan))
    poses = {name: pose.spread(n).where(ok) for name, pose in state.poses.items()}
    poses[structure.scene.frame.name] = rest().spread(n)
    place_redundant(structure, poses, ok, bound)
    slides = all_slides(structure)
    return Motion(structure, drive.value, status, tuple(reasons), poses, slides, assembly, bound, rough)
