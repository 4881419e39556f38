"""How far the motion reaches from a position: over as many turns of the first driver as it takes until every link lies
where it lay, or to both its limits; and the ways to other driver values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.solver.assemblies import choose_forms, own_values
from graphkin.solver.diagnosis import limit_why
from graphkin.solver.driver_range import DriverRange
from graphkin.solver.engine import positions
from graphkin.solver.mobility import structure_of
from graphkin.solver.motion_at import goal_values
from graphkin.solver.pose import Array
from graphkin.structure import Structure
from graphkin.structure.assembly import MOST_TURNS, ways
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.solver.continuity import Path

__all__ = ["driver_range", "range_from", "stopped_why", "way_to"]

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
    turning = isinstance(driver, AngleDriver)
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
