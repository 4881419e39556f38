"""The work of all methods: some positions of a scene, the compared points, and the 50-digit truth.

A measurement: the cost and the error of a method, and the machine.
"""

from __future__ import annotations

import math
import os
import platform
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from importlib import metadata
from typing import TYPE_CHECKING, Literal

import numpy as np

from graphkin import solver
from graphkin.errors import CallError
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver import Motion
from graphkin.solver.algebra.pose import Array
from graphkin.structure import Dyad, Structure
from graphkin.study.equations import Equations, Solution, reference, refined
from graphkin.version import __version__
from graphkin.words import Phrase

if TYPE_CHECKING:
    from mpmath import MPContext

PLACES = 24
FINE = 720


def compared_points(structure: Structure) -> tuple[PointRef, ...]:
    """Every moving point, and the points of guides under sliding pins."""
    scene = structure.scene
    points = (PointRef(p) for link in scene.links if not link.redundant for p in link.points)
    unders = (
        PointRef(s.pin, s.b)
        for s in structure.slides
        if s.pin and s.b != scene.frame.name and s.b in scene.by_name and s.pin not in structure.links[s.b].points
    )
    return (*dict.fromkeys(ref for ref in points if ref.point not in scene.frame.points), *unders)


def holder(scene: Mechanism, ref: PointRef) -> str:
    """The link of a point: of a pin the first moving link that has it."""
    moving = (link for link in scene.links if not link.redundant)
    return ref.link or next(link.name for link in moving if ref.point in link.points)


def point_rates(equations: Equations, solution: Solution, outputs: Sequence[PointRef]) -> tuple[Array, Array]:
    """Velocities and accelerations of points, as complex numbers of the kind in which the equations are solved, shape
    (outputs,) or (outputs, positions)."""
    structure = equations.structure
    velocities, accelerations = [], []
    for ref in outputs:
        link = holder(structure.scene, ref)
        local = equations.under(solution, *ref) if ref.link else structure.links[link].points[ref.point]
        _, _, vx, vy, ax, ay = equations.point(solution, link, local)
        velocities.append(vx + 1j * vy)
        accelerations.append(ax + 1j * ay)
    return np.array(velocities), np.array(accelerations)


@dataclass(frozen=True)
class Work:
    """A scene, the positions at which errors are taken, and the true values there.

    motion : the solver's, at fine steps
    rows : the places, by their indices in the motion
    truth : velocities and accelerations, numbers of mpmath of 50 digits, of shape (2, outputs, places)
    count : positions in a timed run, for methods that compute many at once
    full : whether the driver turns fully
    """

    structure: Structure
    outputs: tuple[PointRef, ...]
    motion: Motion
    rows: Array
    truth: Array
    count: int
    full: bool

    @property
    def scene(self) -> Mechanism:
        return self.structure.scene

    @property
    def values(self) -> Array:
        """Driver values, shape (places, drivers)."""
        return self.motion.values[self.rows]

    @property
    def positions(self) -> list[dict[str, float]]:
        """Driver values of each place by the driver's key."""
        return [*map(self.scene.by_driver, self.values)]

    def errors(self, velocity: Array | None, acceleration: Array | None) -> tuple[float | None, float | None]:
        """The largest errors of vectors of shape (outputs, places), in parts of the largest value; None for None."""
        return _error(self.truth[0], velocity), _error(self.truth[1], acceleration)

    def some(self, every: int) -> Work:
        """Every n-th of the places alone."""
        return replace(self, rows=self.rows[::every], truth=self.truth[:, :, ::every])

    def only(self, outputs: Sequence[PointRef]) -> Work:
        """Some of the outputs alone."""
        kept = [self.outputs.index(o) for o in outputs]
        return replace(self, outputs=tuple(outputs), truth=self.truth[:, kept])

    @property
    def asked(self) -> tuple[Symbol, ...]:
        """The quantities that the scene asks for; of a scene that asks for all, the motion of a point of its first
        group."""
        if self.scene.question.find:
            return self.scene.question.find
        group = next((e for e in self.structure.elements if isinstance(e, Dyad)), None)
        links = group.links if group is not None else tuple(self.structure.links)
        first = next((ref for ref in self.outputs if holder(self.scene, ref) in links), self.outputs[0])
        return Symbol("v", first), Symbol("a", first)

    def asked_outputs(self) -> tuple[PointRef, ...]:
        """The asked outputs: points, or points of links whose turning is asked for."""
        refs = {ref for s in self.asked for ref in (s.of, s.to) if ref is not None}
        turning = {s.link for s in self.asked if s.link}
        asked = tuple(
            ref for ref in self.outputs
            if ref in refs or (not ref.link and holder(self.scene, ref) in turning)
        )
        return asked or self.outputs


def _error(right: Array, measured: Array | None) -> float | None:
    if measured is None:
        return None
    if not np.isfinite(measured).all():
        return math.nan
    return float(np.max(np.abs(measured - right)) / np.max(np.abs(right)))


def work_of(scene: Mechanism, mp: MPContext, count: int) -> Work:
    """Positions over the turn of the driver (over its range, if it does not turn fully), and the truth there.

    Parameters
    ----------
    count : positions of which the time is taken

    Raises
    ------
    CallError : no link moves, or one by a cam or by rolling; or a group larger than a dyad, which has no closed form
    Unsolvable : as for ``solver.solve``
    """
    structure = solver.structure_of(scene)
    larger = next((group for group in structure.groups if not isinstance(group, Dyad)), None)
    if larger is not None:
        raise CallError.of(larger.named, "have no closed form", "solve such a mechanism with solve")
    if any(element.driver not in structure.scene.drivers for element in structure.driven):
        raise CallError.of(scene.name or "scene", "moves by a cam or by rolling", "solve such a mechanism with solve")
    outputs = compared_points(structure)
    moving = any(d.values[1] for d in scene.drivers)
    if not outputs or not moving:
        wanted = Phrase("give a moving link a point" if moving else "give the driver a rate")
        raise CallError.of(scene.name or "scene", "nothing moves that could be looked at", wanted)
    fine = solver.solve(structure.scene, sweep=FINE).require()
    good = np.flatnonzero(fine.ok)
    full = len(good) == FINE and scene.drivers[0].turns
    margin = 0 if full else len(good) // 24  # ends of a motion are dead points, which are another study
    inner = good[margin : len(good) - margin] if margin else good
    picked = inner[np.linspace(0, len(inner), min(PLACES, len(inner)), endpoint=False).astype(int)]
    equations = reference(structure, mp)
    start = equations.start(fine)
    rates = [d.values[1] for d in scene.drivers], [d.values[2] for d in scene.drivers]
    solutions = (
        refined(equations, mp, list(start[:, k]), [mp.mpf(float(v)) for v in fine.values[k]], *rates) for k in picked
    )
    truth = np.array([point_rates(equations, solution, outputs) for solution in solutions], dtype=object)
    return Work(structure, outputs, fine, picked, truth.transpose(1, 2, 0), count, full)


# a measurement: what a method costs and how far it is off, and the machine it was made on


ENOUGH, MOST, LEAST = 0.08, 40, 2e-3  # s, runs, s of a run

Family = Literal["drawn", "closed", "newton", "differences", "complex step", "peer", "by hand"]


@dataclass(frozen=True)
class Entry:
    """One method on the work.

    key : its word, ``tag`` the difference from others of that word ("3" iterations, "1e-4" step, scale)
    costs : s for a position, as far as velocities, and with accelerations
    errors : the largest of velocities and of accelerations, in parts of the largest value; None where it gives none
    """

    family: Family
    key: str
    tag: str
    costs: Sequence[float]
    errors: Sequence[float | None]

    @property
    def error(self) -> float:
        """The larger of its errors, 0 where it gives none."""
        return max(error or 0.0 for error in self.errors)


class Skipped(Exception):
    """A peer that is left out, with the reason: a key of the table of words with its gaps."""

    def __init__(self, key: str, **gaps: str) -> None:
        super().__init__(key, *gaps.values())
        self.why = Phrase(f"skip {key}", **gaps)


def best_time(run: Callable[[], object], repeats: int) -> float:
    """The shortest time of some runs (s), each long enough to be timed; other work on the machine only adds time.

    There are more runs than asked for where they are short, since a busy machine interrupts many of them.
    """
    started = time.perf_counter()
    run()  # warm: compiled, cached
    once = time.perf_counter() - started
    loops = max(1, min(10_000, int(LEAST / max(once, 1e-7))))
    best, begun, done = float("inf"), time.perf_counter(), 0
    while done < repeats or (done < MOST and time.perf_counter() - begun < ENOUGH):
        done += 1
        started = time.perf_counter()
        for _ in range(loops):
            run()
        best = min(best, (time.perf_counter() - started) / loops)
    return best


PACKAGES = ("numpy", "numba", "scipy", "pylinkage", "mpmath")


def this_machine() -> tuple[int, str, dict[str, str]]:
    """Cores and processor of this machine, and the versions of the programs by name."""
    versions = {"graphkin": __version__, "Python": platform.python_version()}
    for name in PACKAGES:
        with suppress(metadata.PackageNotFoundError):
            versions[name] = metadata.version(name)
    names = []
    with suppress(OSError), open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.partition(":")[2].strip() for line in file if line.startswith("model name")]
    return os.cpu_count() or 1, names[0] if names else platform.processor() or platform.machine(), versions
