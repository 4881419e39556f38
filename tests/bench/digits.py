"""Mechanisms with larger groups against fifty digits: in the test-suite, more by ``python -m tests.bench.digits 200``.

Three coordinates for every link, an equation for every hinge, guide and driver, nothing else; Newton's method from the
place where the solver finds the assembly, and rates from differences of places 1e-14 s apart.  What is
measured on the drawing, and what the solver gives, is held against it: points, angular velocities and accelerations.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import mpmath
import numpy as np

import graphkin
from graphkin import solver
from graphkin.errors import GraphkinError, Unsolvable
from graphkin.scene.model import Driver, Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Structure, analyse
from tests.bench.larger import random_larger

__all__ = ["Reference", "random_driven", "worst"]

STEP = mpmath.mpf(10) ** -14
"""Seconds; with places to 52 digits a second difference has twenty right."""


class Reference:
    """Places, velocities and accelerations of a scene in its own position."""

    def __init__(self, scene: Mechanism, motion: solver.Motion) -> None:
        self.mp = mpmath.mp.clone()
        self.mp.dps = 60
        self.structure: Structure = analyse(scene)
        self.frame = scene.frame.name
        self.names = [name for name in self.structure.links if name != self.frame]
        poses = [motion.poses[name] for name in self.names]
        start = [x for p in poses for x in (p.z[0].real, p.z[0].imag, float(np.angle(p.u[0])))]
        at, before, after = (self._found(start, t) for t in (0, -STEP, STEP))
        self.place = at
        self.rate = [(b - a) / (2 * STEP) for a, b in zip(before, after, strict=True)]
        self.second = [(a - 2 * x + b) / STEP**2 for a, x, b in zip(before, at, after, strict=True)]

    def _pose(self, q: Sequence[Any], name: str) -> tuple[Any, Any]:
        if name == self.frame:
            return self.mp.mpc(0), self.mp.mpc(1)
        k = 3 * self.names.index(name)
        return self.mp.mpc(q[k], q[k + 1]), self.mp.expj(q[k + 2])

    def _point(self, q: Sequence[Any], name: str, local: complex) -> Any:
        z, u = self._pose(q, name)
        return z + u * local

    def _open(self, q: Sequence[Any], t: Any) -> list[Any]:
        """What each pair and each driver leaves open at a time (s)."""
        rows: list[Any] = []
        links, size = self.structure.links, self.structure.scene.size
        for point, (first, *others) in self.structure.hinges.items():
            for other in others:
                one, two = (self._point(q, name, links[name].points[point]) for name in (first, other))
                gap = one - two
                rows += [gap.real / size, gap.imag / size]
        seen = {}
        for slide in self.structure.slides:
            (za, ua), (_, ub) = self._pose(q, slide.a), self._pose(q, slide.b)
            along = ub * slide.guide.direction
            seen[slide.key] = (za - self._point(q, slide.b, slide.guide.through)) * along.conjugate()
            rows += [self.mp.arg(ua * slide.turn.conjugate() * along.conjugate()), seen[slide.key].imag / size]
        for driver in self.structure.scene.drivers:
            value, rate, second = (self.mp.mpf(x) for x in driver.values)
            wanted = value + rate * t + second * t**2 / 2
            if driver.turns:
                turned = self._pose(q, driver.link)[1] * self._pose(q, driver.relative_to)[1].conjugate()
                rows.append(self.mp.arg(turned * self.mp.expj(-wanted)))
            else:
                rows.append((seen[driver.key].real - wanted) / size)
        return rows

    def _found(self, start: Sequence[float], t: Any) -> list[Any]:
        """Newton's method with one inverse in sixteen digits, again and again on what is left."""
        q = [self.mp.mpf(x) for x in start]
        h = self.mp.mpf(10) ** -20
        here = self._open(q, t)
        columns = []
        for k in range(len(q)):
            moved = [*q[:k], q[k] + h, *q[k + 1 :]]
            columns.append([float((b - a) / h) for a, b in zip(here, self._open(moved, t), strict=True)])
        inverse = np.linalg.pinv(np.array(columns).T)
        for _ in range(60):
            most = max(abs(x) for x in here)
            if most < self.mp.mpf(10) ** -52:
                return q
            step = inverse @ np.array([float(x / most) for x in here])
            q = [x - most * float(s) for x, s in zip(q, step, strict=True)]
            here = self._open(q, t)
        raise ArithmeticError("Newton's method does not converge")

    def value(self, symbol: Symbol) -> complex | None:
        """A velocity or an acceleration of a point, a rate of a link; None of anything else."""
        if symbol.kind in ("omega", "alpha") and symbol.link in self.names:
            rates = self.rate if symbol.kind == "omega" else self.second
            return complex(rates[3 * self.names.index(symbol.link) + 2])
        if symbol.kind not in ("v", "a") or symbol.of is None or symbol.to is not None or symbol.of.link:
            return None
        return self._moved(symbol.of, symbol.kind)

    def _moved(self, ref: PointRef, kind: str) -> complex:
        name = next(n for n in self.names if ref.point in self.structure.links[n].points)
        k = 3 * self.names.index(name)
        arm = self._pose(self.place, name)[1] * self.structure.links[name].points[ref.point]
        i, (vx, vy, omega), (ax, ay, alpha) = self.mp.mpc(0, 1), self.rate[k : k + 3], self.second[k : k + 3]
        if kind == "v":
            return complex(self.mp.mpc(vx, vy) + i * omega * arm)
        return complex(self.mp.mpc(ax, ay) + (i * alpha - omega**2) * arm)


def random_driven(seed: int) -> Mechanism:
    """A random mechanism with a larger group; every other one driven by the angle between two of its links instead."""
    rng = np.random.default_rng(seed)
    scene = next(scene for scene in iter(lambda: random_larger(rng), None) if _moves(scene))
    if seed % 2:
        return scene
    motion = solver.solve(scene)
    motion.require()
    names = [scene.frame.name, *(link.name for link in scene.links)]
    link, base = (names[k] for k in rng.permutation(len(names))[:2])
    if link == scene.frame.name:
        link, base = base, link
    angle = float(motion.angle(link)[0]) - (0.0 if base == scene.frame.name else float(motion.angle(base)[0]))
    driver = Driver(link, base, angle, round(float(rng.uniform(-9, 9)), 2), round(float(rng.uniform(-20, 20)), 2))
    places = {p: complex(motion.position(p)[0]) for p in scene.holders if p not in scene.frame.points}
    return replace(scene, drivers=(driver,), sketch=places, drawn={})


def _moves(scene: Mechanism) -> bool:
    """Whether its one driver is all that it needs: of some the last links hang on what was left out."""
    try:
        return bool(analyse(scene))
    except Unsolvable:
        return False


def worst(scene: Mechanism) -> tuple[float, float, int]:
    """How far the drawing and the solver are off at most, of the largest of the kind, and in how many readings."""
    result = graphkin.check(scene)
    reference = Reference(scene, solver.solve(scene))
    rows = [(row, reference.value(row.symbol)) for row in result.report.rows if row.ok is not None]
    found = [(row, value) for row, value in rows if value is not None]
    kinds = {row.symbol.kind for row, _ in found}
    largest = {kind: max(abs(v) for r, v in found if r.symbol.kind == kind) for kind in kinds}
    drawn = max(abs(row.reading.value - value) / largest[row.symbol.kind] for row, value in found)
    solved = max(abs(row.exact - value) / largest[row.symbol.kind] for row, value in found)
    return drawn, solved, len(found)


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    most, refused = 0.0, 0
    for seed in range(count):
        try:
            drawn, solved, readings = worst(random_driven(seed))
        except GraphkinError as refusal:
            refused += 1
            print(seed, "refused:", str(refusal).splitlines()[0])
            continue
        most = max(most, drawn, solved)
        if max(drawn, solved) > 1e-9 or not math.isfinite(drawn):
            print(f"{seed}: drawing off by {drawn:.2g}, solver by {solved:.2g}, of {readings} readings")
    print(f"{count - refused} mechanisms, at most {most:.2g} off; {refused} refused")


if __name__ == "__main__":
    main()
