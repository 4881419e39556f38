"""The range of the first driver: how far the motion reaches from a position to both sides, or after how many turns it
closes, which assembly stands at each place of it, and the motion there; and the ways to other driver values.

Whatever goes over the driver's range goes this way: a solution elsewhere and over a turn, prepared mechanisms, the
study of a turn, the positions of a handout.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import added_up
from graphkin.scene.model import Driver, Mechanism
from graphkin.solver.assemblies import choose_forms, own_values
from graphkin.solver.diagnosis import assembly_words, limit_why
from graphkin.solver.driver_values import UniformGrid
from graphkin.solver.engine import positions
from graphkin.solver.joints import Drive
from graphkin.solver.mobility import structure_of
from graphkin.solver.motion import BLOCK, Motion, goal_values, joined, motion_of
from graphkin.solver.pose import Array
from graphkin.structure import Structure
from graphkin.structure.assembly import MOST_TURNS, ChangePoint, ways
from graphkin.words import Phrase, Wording

if TYPE_CHECKING:
    from graphkin.solver.continuity import Path

__all__ = ["DriverRange", "driver_range", "range_from", "stopped_why", "way_to"]

CLOSED = 1e-7
"""Two positions are the same where links lie closer than this, in the size of the mechanism, and turn closer (rad)."""


def driver_range(scene: Mechanism | Structure, at: Mapping[str, float] | None = None) -> DriverRange:
    """Follow a mechanism from its own position, or from other driver values, over as many turns of its first driver as
    it takes until every link lies where it lay; or to both limits of the motion, be they more than a turn apart.

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
            why = stopped_why(structure, forms, own, path)
            raise Unsolvable("not assembled", Problem(structure.scene.name or "scene", why))
        forms = path.last_forms
    return range_from(structure, forms, start)


def range_from(structure: Structure, forms: Mapping[int, Array], start: Array, which: int = 0) -> DriverRange:
    """The range about driver values, shape (drivers,), at which the groups have these forms; of the first driver, or of
    another."""
    latest: _Known | None = structure.kept.get("range")  # strokes, loads and tables of one motion ask for the same
    if latest is not None and latest.is_from(forms, start, which):
        return latest.range
    found = _followed(structure, forms, start, which)
    structure.kept["range"] = _Known({i: form.copy() for i, form in forms.items()}, start.copy(), which, found)
    return found


@dataclass(frozen=True)
class _Known:
    """A range that was followed, and from where."""

    forms: Mapping[int, Array]
    start: Array
    which: int
    range: DriverRange

    def is_from(self, forms: Mapping[int, Array], start: Array, which: int) -> bool:
        same = which == self.which and self.forms.keys() == forms.keys() and np.array_equal(start, self.start)
        return same and all(np.array_equal(form, forms[i]) for i, form in self.forms.items())


def _followed(structure: Structure, forms: Mapping[int, Array], start: Array, which: int) -> DriverRange:
    from graphkin.solver.continuity import FAR, follow_path

    driver = structure.scene.drivers[which]
    turning = driver.turns
    wide = float(np.copysign(2 * np.pi if turning else FAR * structure.scene.size, driver.values[1]))

    # the ways from here that ended before they came to where they should
    ended: list[tuple[Mapping[int, Array], Path]] = structure.kept.get("ended", [])

    def followed(turns: int) -> Path:
        end = start.copy()
        end[which] += turns * wide
        for known, path in ended:
            moved = path.end - start
            if known is forms and np.array_equal(path.start, start) and np.array_equal(np.flatnonzero(moved), [which]):
                by = float((end - start)[which] / moved[which])
                if path.reach <= by:
                    return path.rescaled(by)
        return follow_path(structure, forms, start, end)

    ahead = followed(1)
    if not turning:
        return DriverRange(structure, start, ahead, followed(-1), wide, 0)
    if ahead.limit is None:
        if _closes(ahead):
            return DriverRange(structure, start, ahead, ahead, wide, 1)
        ahead = followed(MOST_TURNS)
        for turns in range(2, MOST_TURNS + 1 if ahead.limit is None else 2):
            cycle = ahead.rescaled(turns / MOST_TURNS)
            if _closes(cycle):
                return DriverRange(structure, start, cycle, cycle, turns * wide, turns)
    else:
        ahead = ahead.rescaled(MOST_TURNS)
    return DriverRange(structure, start, ahead, followed(-MOST_TURNS), MOST_TURNS * wide, 0)


def _closes(path: Path) -> bool:
    """Whether every link lies at the end of a path where it lay at its start."""
    ends = np.array([0.0, 1.0])
    poses = positions(path.structure, path.drive(ends), path.form(ends), rates=False).poses
    for pose in (p.spread(2) for p in poses.values()):
        moved = max(abs(pose.z[1] - pose.z[0]) / path.structure.scene.size, abs(pose.u[1] - pose.u[0]))
        # of a start in a singular position nothing is known
        if moved >= CLOSED:
            return False
    return True


def stopped_why(structure: Structure, forms: Mapping[int, Array], start: Array, path: Path) -> Phrase:
    """Why a way from the values of ``start`` ends, and between which values the motion runs."""
    moved = np.flatnonzero(path.end != path.start)
    if len(moved) > 1:
        return limit_why(structure, path)
    which = int(moved[0]) if len(moved) else 0
    whole = range_from(structure, forms, start, which)
    low, high = sorted(float(start[which] + end * whole.sense) for end in whole.ends)
    return limit_why(structure, path, (low, high))


def way_to(structure: Structure, forms: Mapping[int, Array], goal: Array) -> Path:
    """The way from the scene's own position to other driver values: straight, whole turns included, else the other way
    round for drivers that turn; the straight one if none gets there."""
    from graphkin.solver.continuity import Path, follow_path

    start, ended = own_values(structure.scene), list[tuple[Mapping[int, Array], Path]]()
    for end in ways(structure.scene.drivers, start.tolist(), goal.tolist(), structure.rolls):
        path = follow_path(structure, forms, start, np.array(end))
        if path.limit is None:
            return path
        ended.append((forms, path))
    structure.kept["ended"] = ended
    return ended[0][1]


@dataclass(frozen=True)
class DriverRange:
    """The assembly of one position, carried along over the range of the first driver.

    Offsets count from the start value of the first driver, in rad or m, positive in the sense of its rate; parts are
    offsets divided by ``wide``.

    start : values of all drivers at offset 0, shape (drivers,) (rad, m)
    ahead, behind : the ways in the sense of the driver and against it; the same where the motion closes
    wide : how far each of them goes, if nothing ends it, signed (rad, m)
    turns : after how many turns of the driver every link lies where it lay; 0 where the motion does not close, because
        something ends it, be it beyond a turn, or the driver slides
    """

    structure: Structure
    start: Array
    ahead: Path
    behind: Path
    wide: float
    turns: int

    @cached_property
    def kept(self) -> dict[Hashable, Any]:
        """What was found of the whole range and is asked for again: strokes, the flywheel."""
        return {}

    @property
    def scene(self) -> Mechanism:
        return self.structure.scene

    @property
    def driver(self) -> Driver:
        return self.scene.drivers[0]

    @property
    def full(self) -> bool:
        """Whether the driver turns on and on, and the motion closes."""
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
    def limit_why(self) -> Wording:
        """Why the motion ends."""
        path = self.ahead if self.ahead.limit is not None else self.behind
        low, high = sorted(self.value(np.array(self.ends)).tolist())
        return "" if path.limit is None else limit_why(self.structure, path, (low, high))

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
        """The offsets at which the motion comes to these values of the first driver, or would: those of the values
        themselves, of a motion that closes within its turns; of an angle that it does not reach so, at most a turn
        ahead or as far behind as the motion reaches."""
        offset = np.asarray(self.sense * (value - self.start[0]))
        if not self.driver.turns:
            return offset
        if self.full:
            return np.asarray(np.remainder(offset, abs(self.wide)))
        within = np.remainder(offset, 2 * np.pi)
        within = np.where(within <= self.ends[1], within, within - 2 * np.pi)
        return np.asarray(np.where(self.reaches(offset), offset, within))

    def reaches(self, offset: Array) -> Array:
        """Whether the motion comes to these offsets, shape (n,)."""
        low, high = self.ends
        return np.asarray((offset >= low) & (offset <= high))

    def table_offsets(self, n: int, first: int = 0, last: int | None = None) -> Array:
        """Offsets of positions ``first`` to ``last`` (not included) of a table of n, in the sense of the driver: over a
        turn from the start on, or evenly inside the range of travel."""
        k = np.arange(first, n if last is None else last)
        if self.driver.turns:
            return np.asarray(2 * np.pi * k / n)
        low, high = self.ends
        return np.asarray(low + (k + 0.5) / n * (high - low))

    def grid(self, n: int, first: int = 0, last: int | None = None) -> UniformGrid:
        """Values of the first driver at positions ``first`` to ``last`` (not included) of a table of n: a turn from the
        start on in the sense of the driver, or evenly inside the range of travel."""
        last, start = n if last is None else last, float(self.start[0])
        if self.driver.turns:
            return UniformGrid(start, self.sense * 2 * np.pi, n, first, last)
        low, high = self.ends
        return UniformGrid(start + self.sense * ((high - low) / n / 2 + low), self.sense * (high - low), n, first, last)

    # the assembly

    def forms(self, part: Array) -> dict[int, Array]:
        """The form of each group at parts of the range, for ``positions``; beyond its ends that at the end."""
        ahead, t, s = self._split(part)
        forms = self.ahead.form(t)
        if ahead.all():
            return forms
        other = self.behind.form(s)
        return {i: np.where(ahead.reshape(-1, *[1] * (f.ndim - 1)), f, other[i]) for i, f in forms.items()}

    def turned(self, part: Array) -> Mapping[str, Array]:
        """How far each link that is not redundant has turned since the start (rad), whole turns included, to a few
        degrees; each found when it is asked for."""
        return _Turned(self, part)

    def _split(self, part: Array) -> tuple[Array, Array, Array]:
        """Which parts lie ahead, and all of them as parameters of both ways."""
        return part >= 0, np.clip(part, 0.0, self.ahead.reach), np.clip(-part, 0.0, self.behind.reach)

    @cached_property
    def _own_forms(self) -> dict[int, Array]:
        return {i: f[0] for i, f in self.ahead.form(np.zeros(1)).items()}

    @cached_property
    def change_points(self) -> tuple[ChangePoint, ...]:
        """Where two assemblies of a group meet in the range, and the motion goes smoothly on."""
        return self.ahead.change_points + (() if self.full else self.behind.change_points)

    @cached_property
    def assembly(self) -> tuple[Phrase, ...]:
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
        n = len(offset)
        if n > BLOCK:
            blocks = (self.motion(offset[k : k + BLOCK], unit, fine) for k in range(0, n, BLOCK))
            part = np.clip(self._reached(offset), *self.ends) / abs(self.wide)
            return replace(joined(blocks, n), turned=self.turned(part))
        offset = self._reached(offset)
        within = np.clip(offset, *self.ends)
        drive = Drive.at(self.structure, self.values(within))
        if unit:
            rate = np.zeros_like(drive.value)
            rate[:, 0] = self.sense
            drive = Drive(drive.value, rate, np.zeros_like(rate))
        return self._motion(within / abs(self.wide), self.values(offset), drive, self.reaches(offset), fine)

    def _reached(self, offset: Array) -> Array:
        """The offsets, a turn less where an angle driver that cannot turn fully comes there the other way round."""
        low, high = self.ends
        if self.full or not self.driver.turns:
            return offset
        return np.where((offset > high) & (offset - 2 * np.pi >= low), offset - 2 * np.pi, offset)

    @cached_property
    def known(self) -> Motion:
        """The position from which the range is followed; where that is singular, the middle of the range."""
        start = self.motion(np.zeros(1))
        whole = all(np.isfinite(pose.z).all() for pose in start.poses.values())
        return start if whole else self.motion(np.array([added_up(self.ends) / 2]))

    @cached_property
    def at_ends(self) -> Motion:
        """The motion at its ends."""
        return self.motion(np.array(self.ends))

    def sweep(self, n: int) -> Motion:
        """The motion at n positions in the sense of the driver: over a full turn from the start on, or spread evenly
        inside the range of a driver that slides."""
        return replace(self.motion(self.table_offsets(n)), passed=self.change_points)

    def sweep_in_blocks(self, n: int) -> Iterator[Motion]:
        """``sweep`` a block of positions at a time: no more of it is in memory."""
        offset = self.table_offsets(n)
        before: Motion | None = None
        for first in range(0, n, BLOCK):
            found = replace(self.motion(offset[first : first + BLOCK]), passed=self.change_points)
            before = found if before is None else found.after(before)
            yield before

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


@dataclass(frozen=True)
class _Turned(Mapping[str, Array]):
    """How far links have turned at parts of a range, by name: of a million positions only what is asked for."""

    range: DriverRange
    part: Array

    def __getitem__(self, link: str) -> Array:
        ahead, t, s = self.range._split(self.part)
        turned = self.range.ahead.turned_of(link, t)
        return turned if ahead.all() else np.where(ahead, turned, self.range.behind.turned_of(link, s))

    def __iter__(self) -> Iterator[str]:
        return iter(self.range.ahead.turned(np.zeros(1)))

    def __len__(self) -> int:
        return len(self.range.ahead.turned(np.zeros(1)))

    def __reduce__(self) -> tuple[type, tuple[dict[str, Array]]]:
        return dict, (dict(self),)
