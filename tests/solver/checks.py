"""What must hold of any motion, computed without the solver's own formulas."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from graphkin.scene.model import Mechanism
from graphkin.solver import Motion, solve
from graphkin.solver.values import entries, head


def to_json(motion: Motion) -> dict[str, Any]:
    """The object that ``solve --json`` prints."""
    return {**head(motion), "positions": list(entries(motion))}


def closure(motion: Motion) -> float:
    """The most that any joint is open, in position, velocity or acceleration, relative to the largest value there."""
    scene, worst = motion.scene, 0.0
    size = scene.size
    speed = max(np.max(np.abs(p.v) + np.abs(p.omega) * size) for p in motion.poses.values()) or 1.0
    push = max(np.max(np.abs(p.a) + (np.abs(p.alpha) + p.omega**2) * size) for p in motion.poses.values()) or 1.0
    for point, names in motion.structure.hinges.items():
        first = motion.point(point, names[0])
        for name in names[1:]:
            at = motion.point(point, name)
            worst = max(
                worst,
                np.max(np.abs(at.z - first.z)) / size,
                np.max(np.abs(at.v - first.v)) / speed,
                np.max(np.abs(at.a - first.a)) / push,
            )
    for slide in motion.slides:
        block, base = motion.poses[slide.a], motion.poses[slide.b]
        u = base.u * slide.guide.direction
        worst = max(
            worst,
            np.max(np.abs(block.u - u * slide.turn)),
            np.max(np.abs(block.omega - base.omega)) * size / speed,
            np.max(np.abs(block.alpha - base.alpha)) * size / push,
        )
        through = base.fixed(slide.guide.through)
        away = block.z - through.z
        # the first and second rate of the distance from the guide, (away x u), by the product rule
        slip = block.v - through.v
        bend = block.a - through.a
        du = 1j * base.omega * u
        ddu = (1j * base.alpha - base.omega**2) * u
        worst = max(
            worst,
            np.max(np.abs((away * u.conj()).imag)) / size,
            np.max(np.abs((slip * u.conj() + away * du.conj()).imag)) / speed,
            np.max(np.abs((bend * u.conj() + 2 * slip * du.conj() + away * ddu.conj()).imag)) / push,
        )
    return float(worst)


def differences(scene: Mechanism, step: float = 1e-4) -> float:
    """How far velocity and acceleration are from finite differences of the position in time, relative."""
    keys = [d.key for d in scene.drivers]
    given = np.array([d.values for d in scene.drivers])

    def at(t: float) -> Motion:
        values = given[:, 0] + given[:, 1] * t + given[:, 2] * t * t / 2
        return solve(scene, at=dict(zip(keys, values, strict=True)))

    now, before, after = solve(scene), at(-step), at(step)
    worst = 0.0
    names = [link.name for link in scene.links]
    speed = max(abs(now.poses[k].v[0]) + abs(now.omega(k)[0]) * scene.size for k in names)
    push = max(abs(now.poses[k].a[0]) + abs(now.alpha(k)[0]) * scene.size for k in names) + speed
    for k in names:
        here, low, high = now.poses[k], before.poses[k], after.poses[k]
        turned = np.angle(high.u * here.u.conj())[0], np.angle(low.u * here.u.conj())[0]
        worst = max(
            worst,
            abs((high.z - low.z)[0] / (2 * step) - here.v[0]) / speed,
            abs((high.z - 2 * here.z + low.z)[0] / step**2 - here.a[0]) / push,
            abs((turned[0] - turned[1]) / (2 * step) - here.omega[0]) * scene.size / speed,
            abs((turned[0] + turned[1]) / step**2 - here.alpha[0]) * scene.size / push,
        )
    return float(worst)


def slowed(scene: Mechanism, by: float) -> Mechanism:
    """The same with the drivers' rates multiplied, so that finite differences can see them."""
    drivers = (replace(d, rate=d.rate * by, second=d.second * by * by) for d in scene.drivers)
    return replace(scene, drivers=tuple(drivers))
