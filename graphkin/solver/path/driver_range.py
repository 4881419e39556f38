"""The range of the first driver: the reach of the motion from a position to both sides, or the number of turns after
which it closes, the assembly at each place of it, and the motion there; and the paths to other driver values.

All computations over the driver's range use it: a solution elsewhere and over a turn, prepared mechanisms, the study of
a turn, the positions of a handout.

Quantities of the whole turn: stroke of a slide, swing of a link, coefficient of travel-speed variation.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import added_up
from graphkin.scene.model import Driver, Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver.algebra.bounds import Accuracy
from graphkin.solver.algebra.pose import FIELDS, Array, Drive, Pose, rest
from graphkin.solver.compiled.engine import positions
from graphkin.solver.drivers import GivenValues, UniformGrid, goal_values, own_values
from graphkin.solver.motion import Motion
from graphkin.solver.path.assemblies import choose_modes
from graphkin.solver.path.dead_points import singular, without_singular
from graphkin.solver.redundant import redundant_poses
from graphkin.structure import Structure, kept_with
from graphkin.structure.assembly import MOST_TURNS, ChangePoint, ways
from graphkin.structure.transmission import sliding_pair
from graphkin.words import Phrase, Wording

if TYPE_CHECKING:
    from graphkin.search import Strokes
    from graphkin.solver.path.driver_path import Path

CLOSED = 1e-7
"""Two positions are the same where links lie closer than this, in the size of the mechanism, and turn closer (rad)."""
SAME = 1e-8
"""Of the range: seams of a law as near to each other are one."""


def range_of(structure: Structure, at: Mapping[str, float] | None = None) -> DriverRange:
    """Follow a mechanism from its own position, or from other driver values, over turns of its first driver until every
    link is back in its pose; or to both limits of the motion, even if they are more than a turn apart.

    Parameters
    ----------
    at : driver values to start from, by driver key (rad, m)

    Raises
    ------
    SceneError : a group has several assemblies and no sketch chooses
    Unsolvable : the start cannot be assembled or reached
    CallError : ``at`` names no driver
    """
    start, modes, _, why = start_of(structure, at)
    if why:
        raise Unsolvable("not assembled", Problem(structure.scene.name or "scene", why))
    return range_from(structure, modes, start)


def start_of(
    structure: Structure, at: Mapping[str, float] | None
) -> tuple[Array, Mapping[int, Array], tuple[ChangePoint, ...], Wording]:
    """The values of the drivers that are asked for, shape (drivers,), the assembly mode of each group there, the change
    points on the way to them, and the reason why the motion does not reach them, "" where it does.  Raises as
    ``choose_modes``."""
    values, goal = own_values(structure.scene), goal_values(structure.scene, at)
    modes = choose_modes(structure)
    if np.array_equal(values, goal):
        return goal, modes, (), ""
    path = way_to(structure, modes, goal)
    why = "" if path.limit is None else stopped_why(structure, modes, values, path)
    return goal, path.last_modes, path.change_points, why


def range_from(structure: Structure, modes: Mapping[int, Array], start: Array, which: int = 0) -> DriverRange:
    """The range of the first driver, or of another, about driver values, shape (drivers,), at which the groups have
    these modes."""
    asked = which, start.tobytes(), tuple((i, mode.tobytes()) for i, mode in modes.items())
    # strokes, loads and tables of one motion ask for the same
    if structure.kept.get("range", (None,))[0] != asked:
        structure.kept["range"] = asked, _followed(structure, modes, start, which)
    reach: DriverRange = structure.kept["range"][1]
    return reach


def _followed(structure: Structure, modes: Mapping[int, Array], start: Array, which: int) -> DriverRange:
    from graphkin.solver.path.continuity import follow_path
    from graphkin.solver.path.driver_path import FAR

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
            if known is modes and np.array_equal(path.start, start) and np.array_equal(np.flatnonzero(moved), [which]):
                by = float((end - start)[which] / moved[which])
                if path.reach <= by:
                    return path.rescaled(by)
        return follow_path(structure, modes, start, end)

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
    """Whether every link has the same pose at the end of a path as at its start."""
    ends = np.array([0.0, 1.0])
    poses = positions(path.structure, path.drive(ends), path.mode(ends), rates=False).poses
    for pose in (p.spread(2) for p in poses.values()):
        moved = max(abs(pose.z[1] - pose.z[0]) / path.structure.scene.size, abs(pose.u[1] - pose.u[0]))
        # of a start in a singular position nothing is known
        if moved >= CLOSED:
            return False
    return True


def stopped_why(structure: Structure, modes: Mapping[int, Array], start: Array, path: Path) -> Phrase:
    """The reason why a path from the values of ``start`` ends, and the values between which the motion runs."""
    moved = np.flatnonzero(path.end != path.start)
    if len(moved) > 1:
        return path.why_ended()
    which = int(moved[0]) if len(moved) else 0
    whole = range_from(structure, modes, start, which)
    low, high = sorted(float(start[which] + end * whole.sense) for end in whole.ends)
    return path.why_ended((low, high))


def way_to(structure: Structure, modes: Mapping[int, Array], goal: Array) -> Path:
    """The path from the scene's own position to other driver values: straight, whole turns included, else the opposite
    way round for drivers that turn; the straight path if none reaches them."""
    from graphkin.solver.path.continuity import follow_path

    ended: list[tuple[Mapping[int, Array], Path]] = []
    start = own_values(structure.scene)
    for end in ways(structure.scene.drivers, start.tolist(), goal.tolist(), structure.rolls):
        path = follow_path(structure, modes, start, np.array(end))
        if path.limit is None:
            return path
        ended.append((modes, path))
    structure.kept["ended"] = ended
    return ended[0][1]


@dataclass(frozen=True, eq=False, repr=False)
class DriverRange:
    """The assembly of one position, carried along over the range of the first driver.

    Offsets count from the start value of the first driver, in rad or m, positive in the sense of its rate; parts are
    offsets divided by ``wide``.

    start : values of all drivers at offset 0, shape (drivers,) (rad, m)
    ahead, behind : the paths in the sense of the driver and against it; the same path where the motion closes
    wide : the length of each of them without an end, signed (rad, m)
    turns : the number of the driver's turns after which every link is back in its pose; 0 where the motion does not
        close, because it ends, also beyond a turn, or the driver slides
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
        """Whether the motion ends at the least and at the greatest offset, or is followed only to them."""
        return (not self.full and self.behind.limit is not None), self.ahead.limit is not None

    @cached_property
    def rolls_apart(self) -> bool:
        """Whether positions a turn of the driver apart differ by rolling, and the motion has an end, so that a value is
        reached from one side only."""
        return self.driver.turns and self.structure.rolls and not self.full and any(self.limited)

    @cached_property
    def limit_why(self) -> Wording:
        """The reason why the motion ends."""
        path = self.ahead if self.ahead.limit is not None else self.behind
        low, high = sorted(self.value(np.array(self.ends)).tolist())
        return "" if path.limit is None else path.why_ended((low, high))

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
        """The offsets at which the motion reaches these values of the first driver, or would: of the values themselves,
        in a closed motion within its turns; for an angle outside them at most a turn ahead, or behind within the
        motion's reach, unless rolling changes the position by then."""
        offset = np.asarray(self.sense * (value - self.start[0]))
        if not self.driver.turns or self.rolls_apart:
            return offset
        if self.full:
            return np.asarray(np.remainder(offset, abs(self.wide)))
        within = np.remainder(offset, 2 * np.pi)
        within = np.where(within <= self.ends[1], within, within - 2 * np.pi)
        return np.where(self.reaches(offset), offset, within)

    def reaches(self, offset: Array) -> Array:
        """Whether the motion reaches these offsets, shape (n,)."""
        low, high = self.ends
        return (offset >= low) & (offset <= high)

    def table_offsets(self, n: int, some: Array | None = None) -> Array:
        """Offsets of all positions of a table of n, or of some numbered from 0, in the sense of the driver: over a turn
        from the start on, or evenly inside the range of travel."""
        k = np.arange(n) if some is None else some
        if self.driver.turns:
            return 2 * np.pi * k / n
        low, high = self.ends
        return low + (k + 0.5) / n * (high - low)

    @cached_property
    def clear(self) -> Array:
        """The parts of the range in which every dyad keeps its assembly and stays away from its dead points: the
        offsets at which each begins and ends, shape (parts, 2), in increasing order."""
        sides = ((1.0, self.ahead),) if self.full else ((-1.0, self.behind), (1.0, self.ahead))
        steps = np.concatenate([np.sort(side * abs(self.wide) * path.clear, axis=1) for side, path in sides])
        low, high = steps[np.argsort(steps[:, 0])].T
        begins = np.ones(len(low), dtype=bool)
        begins[1:] = low[1:] > high[:-1]
        return np.stack([low[begins], high[np.roll(begins, -1)]], axis=1)

    @cached_property
    def seams(self) -> Array:
        """Offsets of the seams between parts of a cam's law, in increasing order."""
        from graphkin.search import resolve
        from graphkin.solver.cams import cam_angle

        starts = [(cam, start) for cam in self.structure.lifting for start in cam.law.starts]
        if not starts:
            return np.zeros(0)

        def since_starts(offset: Array) -> tuple[Array, Array]:
            poses = self.motion(offset, extended=False).poses
            since = np.stack([np.exp(1j * (cam_angle(cam, poses[cam.link].u) - start)) for cam, start in starts], 1)
            return np.concatenate([since.imag, since.real], axis=1), np.zeros((len(offset), 2 * len(starts)))

        pieces = resolve(since_starts, *self.ends, periodic=self.full)
        seams = [at for k in range(len(starts)) for at in pieces.zeros(k) if pieces.at(at, k + len(starts)) > 0]
        return each_once(np.array(seams), *self.ends, self.full)

    def stroke(self, pair: str) -> tuple[float, float]:
        """Least and greatest travel of a sliding pair over a turn (m).  Raises Unsolvable where there is no turn."""
        turn = extremes(self, Symbol.parse(f"stroke_{pair}"))
        return turn.low, turn.high

    def grid(self, n: int, first: int = 0, last: int | None = None) -> UniformGrid | GivenValues:
        """Values of the first driver at positions ``first`` to ``last`` (not included) of a table of n: a turn from the
        start on in the sense of the driver, or evenly inside the range of travel; where rolling links reach an angle
        only from the other side, the value a turn less."""
        last, start = n if last is None else last, float(self.start[0])
        if self.rolls_apart:
            offset = self.table_offsets(n, np.arange(first, last))
            reached = self._reached(offset)
            if not np.array_equal(reached, offset):
                return GivenValues(self.value(reached))
        if self.driver.turns:
            return UniformGrid(start, self.sense * 2 * np.pi, n, first, last)
        low, high = self.ends
        return UniformGrid(start + self.sense * ((high - low) / n / 2 + low), self.sense * (high - low), n, first, last)

    # the assembly

    def modes(self, part: Array) -> dict[int, Array]:
        """The assembly mode of each group at parts of the range, for ``positions``; beyond its ends the mode at the
        end."""
        ahead, t, s = self._split(part)
        modes = self.ahead.mode(t)
        if ahead.all():
            return modes
        other = self.behind.mode(s)
        return {i: np.where(ahead.reshape(-1, *[1] * (f.ndim - 1)), f, other[i]) for i, f in modes.items()}

    def turned(self, part: Array) -> Mapping[str, Array]:
        """The angle of each link from the start (rad), whole turns included, to a few degrees; each is computed when it
        is asked for."""
        return _Turned(self, part)

    def _split(self, part: Array) -> tuple[Array, Array, Array]:
        """Whether parts lie ahead, and all of them as parameters of both paths."""
        return part >= 0, np.clip(part, 0.0, self.ahead.reach), np.clip(-part, 0.0, self.behind.reach)

    @cached_property
    def change_points(self) -> tuple[ChangePoint, ...]:
        """The change points of the range, at which two assemblies of a group meet and the motion continues smoothly."""
        return self.ahead.change_points + (() if self.full else self.behind.change_points)

    # the motion

    def motion(
        self, offset: Array, unit: bool = False, extended: bool = True, rates: tuple[Array, Array] | None = None
    ) -> Motion:
        """The motion at these offsets, with status and reason at each.

        Parameters
        ----------
        offset : shape (n,); over the range of an angle driver that cannot turn fully an offset may also be reached the
            opposite way round
        unit : rates by the first driver's own value (rate 1, second rate 0, other drivers held) instead of the scene's
        extended : False for curves: 16 digits throughout, and no reasons where the status is not ok
        rates : of the first driver at each offset, first and second, shape (n,), instead of the scene's
        """
        offset = np.asarray(offset, dtype=float)
        n = len(offset)
        if n > BLOCK:
            parts = (slice(k, k + BLOCK) for k in range(0, n, BLOCK))
            blocks = (self.motion(offset[k], unit, extended, rates and (rates[0][k], rates[1][k])) for k in parts)
            part = np.clip(self._reached(offset), *self.ends) / abs(self.wide)
            return replace(joined(blocks, n), turned=self.turned(part))
        offset = self._reached(offset)
        within = np.clip(offset, *self.ends)
        drive = Drive.at(self.structure, self.values(within))
        if unit:
            rates = np.full(n, self.sense), np.zeros(n)
        if rates:
            drive = Drive(drive.value, *(np.zeros_like(drive.value) for _ in rates))
            drive.rate[:, 0], drive.second[:, 0] = rates
        part = within / abs(self.wide)
        good = self.reaches(offset)
        why = "" if good.all() or not extended else self.limit_why
        at_start = {i: mode[0] for i, mode in self.ahead.mode(np.zeros(1)).items()}
        motion = motion_of(self.structure, drive, self.modes(part), at_start, good, why, extended)
        return replace(motion, values=self.values(offset), turned=self.turned(part))

    def _reached(self, offset: Array) -> Array:
        """The offsets, a turn less where an angle driver that cannot turn fully reaches them the opposite way round."""
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
        """``sweep`` block by block, with a single block in memory."""
        offset = self.table_offsets(n)
        before: Motion | None = None
        for first in range(0, n, BLOCK):
            block = replace(self.motion(offset[first : first + BLOCK]), passed=self.change_points)
            before = block if before is None else block.after(before)
            yield before

    def angle(self, motion: Motion, link: str) -> Array:
        """The angle of a link in a motion of this range (rad), without jumps over the whole of it, whole turns
        included; in (-pi, pi] at the start."""
        here = np.angle(motion.poses[link].u)
        since = self.ahead.angles[link][0] + motion.turned.get(link, 0.0)
        return np.asarray(here + 2 * np.pi * np.rint((since - here) / (2 * np.pi)))


@dataclass(frozen=True, eq=False, repr=False)
class _Turned(Mapping[str, Array]):
    """The angles of links from the start at parts of a range, by name: each is computed when it is asked for."""

    range: DriverRange
    part: Array

    def __getitem__(self, link: str) -> Array:
        ahead, t, s = self.range._split(self.part)
        turned = self.range.ahead.turned_of(link, t)
        return turned if ahead.all() else np.where(ahead, turned, self.range.behind.turned_of(link, s))

    def __iter__(self) -> Iterator[str]:
        return iter(self.range.ahead.angles)

    def __len__(self) -> int:
        return len(self.range.ahead.angles)

    def __reduce__(self) -> tuple[type, tuple[dict[str, Array]]]:
        return dict, (dict(self),)

def each_once(seams: Array, low: float, high: float, full: bool) -> Array:
    """Places inside a range, in increasing order and each once; the two ends of a turn are one place."""
    near = SAME * (high - low)
    if full:
        seams = low + (seams - low) % (high - low)
        seams = np.where((high - seams < near) | (seams - low < near), low, seams)
    else:
        seams = seams[(seams > low + near) & (seams < high - near)]
    seams = np.sort(seams)
    return seams[np.diff(seams, prepend=-np.inf) > near]


BLOCK = 16384
"""Positions that are computed together."""


def motion_of(
    structure: Structure,
    drive: Drive,
    modes: Mapping[int, Array],
    start: Mapping[int, Array],
    good: Array,
    why: Wording = "",
    extended: bool = True,
) -> Motion:
    """Positions in one pass over all driver values, their status, redundant links placed and checked.

    Parameters
    ----------
    modes : the assembly mode of each group at each position, as for ``positions``
    start : the assembly mode of each group where the motion starts
    good, why : the positions that the motion reaches, shape (n,), and the reason for the others
    extended : False keeps 16 digits everywhere, without reasons
    """
    n = len(good)
    state = positions(structure, drive, modes, extended=extended)
    status = np.where(good, "ok", "not assembled").astype("<U13")
    reasons: list[Wording] = ["" if g else why for g in good]
    if extended:
        status, reasons = without_singular(structure, state, drive.value, modes, status, reasons)
    else:
        for _, dead in singular(structure, state, n):
            status[dead & good] = "dead point"
    ok = status == "ok"
    poses = {name: pose.spread(n).where(ok) for name, pose in state.poses.items()}
    poses[structure.scene.frame.name] = rest().still(n)
    accuracy = Accuracy(structure, poses, state.drive, state.slack, state.refined, state.clear, ok)
    if any(link.redundant for link in structure.scene.links):
        poses = {**poses, **redundant_poses(structure, poses, ok, accuracy.of(()))}
    return Motion(structure, drive.value, status, tuple(reasons), poses, start, accuracy, partial(range_of, structure))


def joined(blocks: Iterable[Motion], n: int) -> Motion:
    """Motions of blocks of positions, in order, as one motion of n positions.

    Each block is released before the next is computed, and values that are equal at all positions, or for two links
    (the angle of a block on its guide), are kept once: fields may be read-only, or share memory.
    """
    columns: dict[tuple[str, str], list[Array]] = {}
    reasons, lengths, some = list[Wording](), list[int](), None
    for some in blocks:
        held: dict[tuple[str, bytes, bytes], Array] = {}
        for key, values in _columns(some):
            columns.setdefault(key, []).append(_held_once(key[1], values, held))
        reasons += some.reasons
        lengths.append(len(some))
    assert some is not None
    whole: dict[tuple[int, ...], Array] = {}
    kept: dict[tuple[str, str], Array] = {}
    for key, parts in columns.items():
        shared = tuple(map(id, parts))
        if shared not in whole:
            whole[shared] = _in_one_column(parts, lengths, n)
        kept[key] = whole[shared]
    poses = {name: Pose(*(kept[name, field] for field in FIELDS)) for name in some.poses}
    drive = Drive(kept["", "value"], kept["", "rate"], kept["", "second"])
    known = (kept["", x] for x in ("slack", "refined", "clear", "ok"))
    return replace(
        some, values=kept["", "values"], status=kept["", "status"], reasons=tuple(reasons), poses=poses,
        accuracy=Accuracy(some.accuracy.structure, poses, drive, *known),
    )


def _columns(motion: Motion) -> Iterator[tuple[tuple[str, str], Array]]:
    """Every column of a motion, by the link and the field that it is of."""
    for name, pose in motion.poses.items():
        yield from (((name, field), np.broadcast_to(getattr(pose, field), len(motion))) for field in FIELDS)
    known, drive = motion.accuracy, motion.accuracy.drive
    common = {"values": motion.values, "status": motion.status, "value": drive.value, "rate": drive.rate,
              "second": drive.second, "slack": known.slack, "refined": known.refined, "clear": known.clear,
              "ok": known.ok}
    yield from ((("", name), values) for name, values in common.items())


def _held_once(field: str, values: Array, held: dict[tuple[str, bytes, bytes], Array]) -> Array:
    """Values of a block: one row where all are equal bit by bit (minus zero is not zero, and NaN is NaN), in the memory
    of equal kept ones."""
    first, last = values[:1].tobytes(), values[-1:].tobytes()
    if first == last and values.tobytes() == first * len(values):
        values = values[:1].copy()
    known = held.setdefault((field, first, last), values)
    return known if known.shape == values.shape and known.tobytes() == values.tobytes() else values


def _in_one_column(parts: list[Array], lengths: Sequence[int], n: int) -> Array:
    """The rows of blocks below each other; one row for all while they are equal.  The parts are released."""
    first = parts[0]
    if all(len(part) == 1 and part.tobytes() == first.tobytes() for part in parts):
        return np.broadcast_to(first, (n, *first.shape[1:]))
    spread = [np.broadcast_to(part, (rows, *part.shape[1:])) for part, rows in zip(parts, lengths, strict=True)]
    parts.clear()
    return np.concatenate(spread)


# quantities of the whole turn


BESIDE = 1e-4
"""Of a radian: as near to where an output turns back it is at rest."""
REST = 1e-9
"""Of the size of the mechanism, or of a radian, for one of the driver: what is slower is at rest."""
EQUAL = 1e-9
"""Of the stroke: extremes that differ by less are equal; and of the crank's angle, within which it is 0 (rad)."""
WHERE_ELSE = "ask for s_ theta_ or d_ at single"


@dataclass(frozen=True, eq=False, repr=False)
class Extremes:
    """The least and the greatest value of an output over a turn (m, rad), the driver's offsets where the output leaves
    them, and the ways of the driver between them (rad)."""

    low: float
    high: float
    low_offset: float
    high_offset: float
    ways: Strokes

    @property
    def stroke(self) -> float:
        return self.high - self.low


@kept_with
def extremes(reach: DriverRange, symbol: Symbol) -> Extremes:
    """The extremes of a symbol's sliding pair or link over one turn of the driver.

    Raises
    ------
    Unsolvable : the driver slides or does not turn fully, the motion does not repeat after one turn, or the output has
        no limit positions
    CallError : there is no such sliding pair
    """
    from graphkin.search import strokes_between

    if not reach.driver.turns:
        raise _without(symbol, "belongs to a whole turn but the driver", WHERE_ELSE)
    if reach.turns != 1:
        why = reach.limit_why or Phrase("the motion does not repeat after one turn")
        raise _without(symbol, "belongs to a whole turn which the driver", WHERE_ELSE, why=why)
    if symbol.other:
        sliding_pair(reach.known.slides, symbol)
    pair = symbol.pair
    offsets, values, rests, turned = _turns(reach, symbol)
    if not symbol.other and abs(turned) > 1.0:
        raise _without(symbol, "link turns on and on it has no", "ask for one that swings", output=pair)
    wide, size = float(np.ptp(values)) if len(values) else 0.0, reach.scene.size if symbol.other else 1.0
    if wide < 1e-12 * size:
        raise _without(symbol, "does not move it has no limit positions", "ask for an output that moves", name=pair)
    crank = reach.sense * reach.value(offsets) + EQUAL
    lows, highs = (np.flatnonzero(sign * values >= (sign * values).max() - EQUAL * wide) for sign in (-1.0, 1.0))
    below, above = ([(float(crank[k]), float(rests[k])) for k in equal] for equal in (lows, highs))
    strokes = strokes_between(below, above, math.tau)
    (low, start), (high, end) = (
        (float(values[k]), float(offsets[k])) for k in (lows[strokes.low], highs[strokes.high])
    )
    return Extremes(low, high, start, end, strokes)


def _turns(reach: DriverRange, symbol: Symbol) -> tuple[Array, Array, Array, float]:
    """The reversals of an output over a turn of the driver: offsets and values, of a dwell its end, and the dwells'
    lengths; and the output's change in a turn."""
    from graphkin.search import resolve

    def course(offset: Array, extended: bool = False) -> Array:
        """Value and rate by the driver's own angle, shape (n, 2)."""
        motion = reach.motion(offset, unit=True, extended=extended)
        if symbol.other:
            return np.stack(motion.slide(symbol.pair)[:2], axis=1)
        return np.stack([reach.angle(motion, symbol.link), motion.omega(symbol.link)], axis=1)

    def curves(offset: Array) -> tuple[Array, Array]:
        return course(offset), np.zeros((len(offset), 2))

    size = reach.scene.size if symbol.other else 1.0
    floor = np.array([1.0, REST]) * size
    pieces = resolve(curves, 0.0, math.tau, periodic=True, floor=floor, seams=reach.seams)
    rests, offsets, turns = pieces.zeros(1), [], pieces.turns(0)
    for turn in turns:
        # the place of a turn is known to the last digits as that where the rate is nought
        beside = rests[np.abs(rests - turn.place) < BESIDE]
        offsets.append(turn.place if turn.at_seam or not len(beside) else float(beside[0]))
    values = course(np.array([*offsets, 0.0, math.tau]), extended=True)[:, 0]
    lengths = np.array([turn.rest for turn in turns])
    return np.array(offsets), values[:-2], lengths, float(values[-1] - values[-2])


def _without(symbol: Symbol, found: str, wanted: str, **gaps: object) -> Unsolvable:
    return Unsolvable("no whole turn", Problem(str(symbol), found, wanted, **gaps))
