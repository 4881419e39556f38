"""From the scene's own position to other driver values by continuity, without jumping."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from graphkin.exact.cluster import ClusterSolved
from graphkin.exact.dyads import Solved
from graphkin.exact.engine import positions
from graphkin.exact.joints import Drive
from graphkin.exact.pose import Array
from graphkin.exact.walk import walk_cluster
from graphkin.scene.model import SlideDriver
from graphkin.structure import Cluster, Dyad, Structure
from graphkin.structure.continuity import Passage, follow

__all__ = ["Path", "follow_path"]

TURN_STEP = np.radians(1.0)
TRAVEL_STEP = 1 / 200
CLUSTER_STEP = np.radians(4.0)
SWING = 0.09
"""Between two nodes no link turns by more than this (about 5 degrees)."""
BESIDE = 1e-6
"""At a change point a group tells nothing; what follows it is watched this far beside it."""


@dataclass(frozen=True)
class Path:
    """A straight path of driver values, parameter 0 .. 1, with the form of each group along it.

    ``limit`` is the parameter where the motion ends (None if it does not), ``by`` the element that ends it.
    Between two ``nodes`` no link turns by more than a few degrees.
    """

    structure: Structure
    start: Array
    end: Array
    forms: Mapping[int, Callable[[Array], Array]] = field(default_factory=dict)
    flips: Array = field(default_factory=lambda: np.zeros(0))
    limit: float | None = None
    by: int | None = None
    nodes: Array = field(default_factory=lambda: np.zeros(1))

    @property
    def reach(self) -> float:
        """The parameter that the motion reaches."""
        return 1.0 if self.limit is None else self.limit

    def values(self, t: Array) -> Array:
        """Driver values, shape (n, drivers)."""
        return np.asarray(self.start + t[:, None] * (self.end - self.start))

    def form(self, t: Array) -> dict[int, Array]:
        """The form of each group at these parameters, for ``positions``."""
        return {i: form(t) for i, form in self.forms.items()}

    def turned(self, t: Array) -> dict[str, Array]:
        """How far each link has turned from the start (rad), whole turns included, to a few degrees."""
        nodes = _beside(self.flips, self.nodes)
        poses = positions(self.structure, self.drive(nodes), self.form(nodes), rates=False).poses
        found: dict[str, Array] = {}
        for name, pose in poses.items():
            u = np.nan_to_num(np.broadcast_to(pose.u, nodes.shape), nan=1.0)
            steps = np.angle(u[1:] * np.conj(u[:-1]))
            found[name] = np.interp(t, self.nodes, np.concatenate(([0.0], np.cumsum(steps))))
        return found

    def drive(self, t: Array) -> Drive:
        """The drivers with rates by the path parameter."""
        value = self.values(t)
        return Drive(value, np.broadcast_to(self.end - self.start, value.shape), np.zeros_like(value))


def follow_path(structure: Structure, forms: Mapping[int, Array], start: Array, end: Array) -> Path:
    """Keep the assembly of every group along a straight path of driver values.

    Parameters
    ----------
    forms : the assembly at the start: the sign of a dyad, the places (members, 3) of a larger group
    start, end : driver values, shape (drivers,), SI
    """
    path = Path(structure, start, end)
    grid = np.linspace(0.0, 1.0, _steps(structure, np.abs(end - start)) + 1)
    for i, element in enumerate(structure.elements):
        if isinstance(element, Dyad):
            path = _follow_dyad(path, i, element, float(forms[i]), grid)
        elif isinstance(element, Cluster):
            path = _follow_cluster(path, i, element, np.asarray(forms[i]))
        if path.limit is not None:
            grid = np.append(grid[grid < path.limit], path.limit)
        grid = _refined(path, i, grid)
    return replace(path, nodes=grid)


def _steps(structure: Structure, span: Array) -> int:
    steps = 8
    for driver, wide in zip(structure.scene.drivers, span, strict=True):
        fine = TRAVEL_STEP * structure.scene.size if isinstance(driver, SlideDriver) else TURN_STEP
        steps = max(steps, int(np.ceil(wide / fine)))
    return min(steps, 4000)


def _follow_dyad(path: Path, i: int, dyad: Dyad, sign: float, grid: Array) -> Path:
    def discriminant(t: Array) -> Array:
        t = _beside(path.flips, t)
        forms = {**path.form(t), i: np.asarray(sign)}
        solved = positions(path.structure, path.drive(t), forms, i + 1, rates=False).groups[i]
        assert isinstance(solved, Solved)
        return np.broadcast_to(solved.discriminant, t.shape)

    passage = follow(discriminant, grid, flips=dyad.kind not in ("PRP", "RPP"))
    limit, by = (path.limit, path.by) if passage.limit is None else (passage.limit, i)
    flips = np.sort(np.append(path.flips, passage.flips))
    return replace(path, forms={**path.forms, i: _signed(sign, passage)}, flips=flips, limit=limit, by=by)


def _signed(sign: float, passage: Passage) -> Callable[[Array], Array]:
    return lambda t: sign * passage.sign(t)


def _beside(flips: Array, t: Array) -> Array:
    for flip in flips:
        t = np.where(np.abs(t - flip) < BESIDE, flip + BESIDE, t)
    return t


def _refined(path: Path, i: int, grid: Array) -> Array:
    """More nodes where the links found so far turn fast."""
    for _ in range(20):
        t = _beside(path.flips, grid)
        poses = positions(path.structure, path.drive(t), path.form(t), i + 1, rates=False).poses
        turning = [np.broadcast_to(np.nan_to_num(p.u), grid.shape) for p in poses.values()]
        swing = np.max([np.abs(np.diff(u)) for u in turning], axis=0)
        fast = np.flatnonzero((swing > SWING) & (np.diff(grid) > BESIDE))
        if not len(fast) or len(grid) > 20000:
            break
        grid = np.sort(np.append(grid, (grid[fast] + grid[fast + 1]) / 2))
    return grid


def _follow_cluster(path: Path, i: int, group: Cluster, place: Array) -> Path:
    def solved(t: float, start: Array) -> tuple[ClusterSolved, Array]:
        t_ = _beside(path.flips, np.array([t]))
        state = positions(path.structure, path.drive(t_), {**path.form(t_), i: start[None]}, i + 1, sure=False)
        found = state.groups[i]
        assert isinstance(found, ClusterSolved)
        slope = [[state.poses[k].v.real[0], state.poses[k].v.imag[0], state.poses[k].omega[0]] for k in group.members]
        return found, np.array(slope)

    steps = _steps(path.structure, np.abs(path.end - path.start))
    most = min(0.125, CLUSTER_STEP / TURN_STEP / steps)
    walk = walk_cluster(solved, place, path.structure.scene.size, path.reach, most)
    limit, by = (path.limit, path.by) if walk.end is None else (walk.end, i)
    flips = np.sort(np.append(path.flips, walk.flips))
    return replace(path, forms={**path.forms, i: walk.start}, flips=flips, limit=limit, by=by)
