"""The whole way of a mechanism under its first driver: how far it goes, and its motion anywhere on that way."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import AngleDriver, Driver, Scene
from graphkin.solver import Motion, structure_of
from graphkin.solver.assemblies import choose_forms, own_values
from graphkin.solver.engine import positions
from graphkin.solver.findings import assembly_words, limit_why, without_singular
from graphkin.solver.joints import Drive
from graphkin.solver.path import Path, follow_path
from graphkin.solver.pose import Array, Pose, rest
from graphkin.solver.redundant import all_slides, fit
from graphkin.structure import Structure

__all__ = ["Course", "course_of"]

FAR = 4.0
"""A driven slide that nothing limits is followed this many sizes of the mechanism to either side."""
MOST_TURNS = 4
CLOSED = 1e-7
"""Two positions are the same where links lie closer than this, in the size of the mechanism, and turn closer (rad)."""


@dataclass(frozen=True)
class Course:
    """The assembly of the scene's own position, carried along over the range of the first driver.

    Offsets count from the start value of the first driver, in rad or m, positive in the sense of its rate.
    ``turns`` is how many turns of the driver it takes until every link is where it was; 0 where the driver cannot turn
    fully, or slides.
    """

    structure: Structure
    start: Array
    ahead: Path
    behind: Path
    wide: float
    turns: int

    @property
    def scene(self) -> Scene:
        return self.structure.scene

    @property
    def driver(self) -> Driver:
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

    def value(self, offset: Array) -> Array:
        """Values of the first driver (rad, m) at these offsets."""
        return np.asarray(self.start[0] + self.sense * np.asarray(offset))

    def values(self, offset: Array) -> Array:
        """Values of all drivers, shape (n, drivers)."""
        values = np.repeat(self.start[None], len(offset), axis=0)
        values[:, 0] = self.value(offset)
        return values

    def table_offsets(self, n: int, first: int = 0, last: int | None = None) -> Array:
        """Offsets of positions ``first`` to ``last`` (not included) of a table of n: over a turn from the start on, or
        evenly inside the range of travel."""
        k = np.arange(first, n if last is None else last)
        if isinstance(self.driver, AngleDriver):
            return np.asarray(k / n * (2 * np.pi))
        low, high = self.ends
        return np.asarray(low + (k + 0.5) / n * (high - low))

    def motion(self, offset: Array, unit: bool = False) -> Motion:
        """The motion at these offsets, with status and reason at each.

        Parameters
        ----------
        offset : shape (n,); over the range of an angle driver that cannot turn fully an offset may also be meant the
            other way round
        unit : rates by the first driver's own value (rate 1, second rate 0, other drivers held) instead of the scene's
        """
        offset = np.asarray(offset, dtype=float)
        low, high = self.ends
        if not self.full and isinstance(self.driver, AngleDriver):
            offset = np.where((offset > high) & (offset - 2 * np.pi >= low), offset - 2 * np.pi, offset)
        good = (offset >= low) & (offset <= high)
        within = np.clip(offset, low, high)
        values = self.values(offset)
        forms, turned = self._forms(within)
        drive = Drive.at(self.structure, self.values(within))
        if unit:
            rate = np.zeros_like(values)
            rate[:, 0] = self.sense
            drive = Drive(drive.value, rate, np.zeros_like(values))
        state = positions(self.structure, drive, forms)
        n = len(offset)
        status = np.where(good, "ok", "not assembled").astype("<U13")
        reasons = [""] * n
        if not good.all():
            why = self.limit_why
            reasons = ["" if g else why for g in good]
        status, reasons = without_singular(self.structure, state, drive.value, forms, status, reasons)
        ok = status == "ok"
        poses = {name: _masked(pose.spread(n), ok) for name, pose in state.poses.items()}
        poses[self.scene.frame.name] = rest().spread(n)
        self._place_redundant(poses)
        bounds, rough = state.bounds, state.rough
        assert bounds is not None
        return Motion(
            self.structure,
            values,
            status,
            tuple(reasons),
            poses,
            all_slides(self.structure),
            self.assembly,
            np.where(ok, bounds.velocity, np.nan),
            np.where(ok, bounds.acceleration, np.nan),
            turned,
            position_bound=np.where(ok, bounds.position, np.nan),
            rough=(np.where(ok, rough[0], np.nan), np.where(ok, rough[1], np.nan)),
            turning_bound=(
                np.where(ok, bounds.angle, np.nan),
                np.where(ok, bounds.omega, np.nan),
                np.where(ok, bounds.alpha, np.nan),
            ),
        )

    @cached_property
    def assembly(self) -> tuple[str, ...]:
        """For each group which assembly was taken."""
        forms = {i: f[0] for i, f in self.ahead.form(np.zeros(1)).items()}
        return assembly_words(self.structure, forms)

    @cached_property
    def limit_why(self) -> str:
        """Why the motion ends."""
        forms = {i: f[0] for i, f in self.ahead.form(np.zeros(1)).items()}
        path = self.ahead if self.ahead.limit is not None else self.behind
        return "" if path.limit is None else limit_why(self.structure, forms, self.start, path, self._other(path))

    def angle(self, motion: Motion, link: str) -> Array:
        """The angle of a link in a motion of this course (rad), without jumps over the whole course, whole turns
        included; in (-pi, pi] at the start."""
        here = np.angle(motion.poses[link].u)
        since = self._start_angle[link] + motion.turned[link]
        return np.asarray(here + 2 * np.pi * np.rint((since - here) / (2 * np.pi)))

    @cached_property
    def _start_angle(self) -> dict[str, float]:
        poses = self.motion(np.zeros(1)).poses
        return {name: float(np.angle(np.where(np.isfinite(p.u), p.u, 1.0))[0]) for name, p in poses.items()}

    @cached_property
    def _turned_ahead(self) -> tuple[Array, dict[str, Array]]:
        return self.ahead.nodes, self.ahead.turned(self.ahead.nodes)

    @cached_property
    def _turned_behind(self) -> tuple[Array, dict[str, Array]]:
        return self.behind.nodes, self.behind.turned(self.behind.nodes)

    def _other(self, path: Path) -> Path:
        return self.behind if path is self.ahead else self.ahead

    def _forms(self, offset: Array) -> tuple[dict[int, Array], dict[str, Array]]:
        ahead = offset >= 0
        t = np.clip(offset / abs(self.wide), 0.0, self.ahead.reach)
        forms, turned = self.ahead.form(t), _turned(self._turned_ahead, t)
        if not ahead.all():
            s = np.clip(-offset / abs(self.wide), 0.0, self.behind.reach)
            other, back = self.behind.form(s), _turned(self._turned_behind, s)
            forms = {i: np.where(ahead.reshape(-1, *[1] * (forms[i].ndim - 1)), forms[i], other[i]) for i in forms}
            turned = {name: np.where(ahead, turned[name], back[name]) for name in turned}
        for link in self.scene.links:
            # a redundant link turns with the others, near enough to count its turns; it never drives anything
            turned.setdefault(link.name, np.zeros_like(offset))
        return forms, turned

    def _place_redundant(self, poses: dict[str, Pose]) -> None:
        waiting = [link for link in self.scene.links if link.redundant]
        while waiting:
            placed = [(link, fit(self.scene, link, poses)) for link in waiting]
            found = [(link, laid) for link, laid in placed if laid is not None]
            if not found:
                names = ", ".join(link.name for link in waiting)
                raise Unsolvable("mobility", Problem(f"links {names}", "redundant, but nothing holds both ends"))
            for link, laid in found:
                poses[link.name] = laid.pose
                waiting.remove(link)


def course_of(scene: Scene, at: dict[str, float] | None = None) -> Course:
    """Follow a scene from its own position, or from other driver values, over the range of its first driver.

    Parameters
    ----------
    at : driver values to start from, by driver key (rad, m)

    Raises
    ------
    SceneError : a group has several assemblies and no sketch tells which
    Unsolvable : wrong mobility, the start cannot be assembled or reached
    """
    structure = structure_of(scene)
    forms = choose_forms(structure)
    own = own_values(scene)
    start = np.array([(at or {}).get(d.key, v) for d, v in zip(scene.drivers, own, strict=True)])
    if not np.array_equal(start, own):
        path = follow_path(structure, forms, own, start)
        if path.limit is not None:
            why = limit_why(structure, forms, own, path)
            raise Unsolvable("not assembled", Problem(scene.name or "scene", why))
        forms = {i: f[0] for i, f in path.form(np.ones(1)).items()}
    first = scene.drivers[0]
    one = np.zeros_like(start)
    one[0] = 1.0
    if not isinstance(first, AngleDriver):
        wide = float(np.copysign(FAR * scene.size, first.velocity))
        ahead = follow_path(structure, forms, start, start + wide * one)
        behind = follow_path(structure, forms, start, start - wide * one)
        return Course(structure, start, ahead, behind, wide, 0)
    wide = -2 * np.pi if first.omega < 0 else 2 * np.pi
    ahead = follow_path(structure, forms, start, start + wide * one)
    if ahead.limit is not None:
        behind = follow_path(structure, forms, start, start - wide * one)
        return Course(structure, start, ahead, behind, wide, 0)
    for turns in range(1, MOST_TURNS + 1):
        if turns > 1:
            longer = follow_path(structure, forms, start, start + turns * wide * one)
            if longer.limit is not None:
                break
            ahead = longer
        course = Course(structure, start, ahead, ahead, turns * wide, turns)
        if _closes(course):
            return course
    ahead = follow_path(structure, forms, start, start + wide * one)
    return Course(structure, start, ahead, ahead, wide, 1)


def _closes(course: Course) -> bool:
    """Whether every link comes back to where it was at the start."""
    motion = course.motion(np.array([0.0, course.ends[1]]))
    size = course.scene.size
    poses = [motion.poses[link.name] for link in course.scene.links]
    return all(
        not motion.ok.all() or (abs(p.z[1] - p.z[0]) < CLOSED * size and abs(p.u[1] - p.u[0]) < CLOSED) for p in poses
    )


def _turned(table: tuple[Array, dict[str, Array]], t: Array) -> dict[str, Array]:
    nodes, turned = table
    return {name: np.interp(t, nodes, angle) for name, angle in turned.items()}


def _masked(pose: Pose, ok: Array) -> Pose:
    return replace(pose, **{k: np.where(ok, getattr(pose, k), np.nan) for k in ("z", "u", "v", "omega", "a", "alpha")})
