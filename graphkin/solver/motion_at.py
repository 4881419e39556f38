"""The motion at given values of the drivers, in one pass over all of them: what stands there, and where and why nothing
does.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import takewhile

import numpy as np

from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.scene.model import Mechanism
from graphkin.solver.assemblies import own_values
from graphkin.solver.diagnosis import singular, without_singular
from graphkin.solver.engine import positions
from graphkin.solver.joints import Drive
from graphkin.solver.motion import Motion
from graphkin.solver.pose import FIELDS, Array, Pose, rest
from graphkin.solver.redundant import all_slides, place_redundant
from graphkin.solver.rounding import ErrorBound
from graphkin.structure import Structure
from graphkin.words import Phrase, Wording

__all__ = ["BLOCK", "goal_values", "joined", "motion_of"]

BLOCK = 16384
"""Positions that are computed together."""


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
            raise CallError(Problem(f'at "{key}"', Phrase("there is no such driver"), did_you_mean(key, keys)))
        if not np.isfinite(value):
            raise CallError(Problem(f'at "{key}"', Phrase("is no driver value of value", value=value)))
        goal[keys.index(key)] = value
    return goal


def motion_of(
    structure: Structure,
    drive: Drive,
    forms: Mapping[int, Array],
    assembly: tuple[Phrase, ...],
    good: Array,
    why: Wording = "",
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
    if n > BLOCK:
        blocks = (slice(first, min(first + BLOCK, n)) for first in range(0, n, BLOCK))
        own = (({i: f[rows] if np.ndim(f) and len(f) == n else f for i, f in forms.items()}, rows) for rows in blocks)
        return joined((motion_of(structure, drive[r], f, assembly, good[r], why, fine) for f, r in own), n)
    state = positions(structure, drive, forms, fine=fine, each=not fine)
    status = np.where(good, "ok", "not assembled").astype("<U13")
    reasons: list[Wording] = ["" if g else why for g in good]
    if fine:
        status, reasons = without_singular(structure, state, drive.value, forms, status, reasons)
    else:
        for _, dead in singular(structure, state, n):
            status[dead & good] = "dead point"
    ok = status == "ok"
    assert state.bounds is not None
    bound = ErrorBound(*(np.where(ok, b, np.nan) for b in state.bounds))
    of_links = {name: ErrorBound(*(np.where(ok, b, np.nan) for b in own)) for name, own in state.each.items()}
    rough = (np.where(ok, state.rough[0], np.nan), np.where(ok, state.rough[1], np.nan))
    poses = {name: pose.spread(n).where(ok) for name, pose in state.poses.items()}
    poses[structure.scene.frame.name] = rest().still(n)
    place_redundant(structure, poses, ok, bound)
    slides = all_slides(structure)
    return Motion(structure, drive.value, status, tuple(reasons), poses, slides, assembly, bound, rough,
                  bounds=of_links)  # fmt: skip


def joined(blocks: Iterable[Motion], n: int) -> Motion:
    """Motions of blocks of positions, one after the other, as one of n positions.

    Each block is let go before the next is found, and what is the same at all positions, or for two links (the angle of
    a block on its guide), is kept once: fields may be read-only, or be the memory of another.
    """
    columns: dict[tuple[str, str], _Column] = {}
    reasons = list[Wording]([""] * n)
    first, some = 0, None
    for some in blocks:
        rows = slice(first, first + len(some))
        parts = {(name, f): np.broadcast_to(getattr(p, f), len(some)) for name, p in some.poses.items() for f in FIELDS}
        parts |= {("bound", str(k)): b for k, b in enumerate((*some.bound, *some.rough))}
        parts |= {("", "status"): some.status, ("", "values"): some.values}
        if not columns:
            columns = {key: _Column(n) for key in parts}
        for key, values in parts.items():
            columns[key].put(rows, values, [c for other, c in columns.items() if other[1] == key[1]])
        reasons[rows] = some.reasons
        first = rows.stop
    assert some is not None
    kept = {key: column.array for key, column in columns.items()}
    numbers = [kept["bound", str(k)] for k in range(8)]
    return replace(
        some,
        values=kept["", "values"],
        status=kept["", "status"],
        reasons=tuple(reasons),
        poses={name: Pose(*(kept[name, field] for field in FIELDS)) for name in some.poses},
        bound=ErrorBound(*numbers[:6]),
        bounds={},
        rough=(numbers[6], numbers[7]),
    )


class _Column:
    """A column of n rows that is filled from the top: one row for all as long as they are the same, bit by bit, nothing
    of its own as long as another column is the same."""

    def __init__(self, n: int) -> None:
        self.n = n
        self.like: _Column | None = None
        self.own: Array | None = None

    @property
    def array(self) -> Array:
        if self.like is not None:
            return self.like.array
        assert self.own is not None
        return self.own if len(self.own) == self.n else np.broadcast_to(self.own, (self.n, *self.own.shape[1:]))

    def put(self, rows: slice, values: Array, others: Iterable[_Column]) -> None:
        """The next rows; ``others`` that come before this one have theirs already."""
        if rows.start == 0:
            one = values[:1]
            if _same(values, np.broadcast_to(one, values.shape)):
                self.own = one.copy()
                return
            before = takewhile(lambda c: c is not self, others)
            self.like = next((c for c in before if c.like is None and _same(values, c.array[rows])), None)
            if self.like is None:
                self._spread(values[:0])[rows] = values
            return
        if self.own is not None and len(self.own) == self.n:
            self.own[rows] = values
        elif not _same(values, self.array[rows]):
            self._spread(self.array[: rows.start])[rows] = values

    def _spread(self, above: Array) -> Array:
        self.own, self.like = np.empty((self.n, *above.shape[1:]), dtype=above.dtype), None
        self.own[: len(above)] = above
        return self.own


def _same(one: Array, other: Array) -> bool:
    """Whether two arrays are the same bit by bit: minus zero is not zero, and NaN is NaN."""
    return one.dtype == other.dtype and one.tobytes() == other.tobytes()
