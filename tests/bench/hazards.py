"""Random mechanisms in and near singular positions: no jump of assembly, nothing not a number, nothing silently wrong.

Run by hand, ``python -m tests.bench.hazards 100000 [SEED]``; the test-suite runs a few thousand positions of it.
Four-bars whose lengths just fold, or miss it by 1e-2 to 1e-14; guide bars whose crank just reaches the pivot; slider-
cranks whose rod is as long as the crank.  Each is swept over its range, and looked at close to its dead points.  What
is given out must close (every pair, in position, velocity and acceleration, to its own bound), be finite, and move
from one position to the next no further than its rates allow.
"""

from __future__ import annotations

import json
import sys
import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphkin.errors import GraphkinError
from graphkin.scene import mechanism_of
from graphkin.scene.model import Mechanism
from graphkin.solver import Motion, solve, structure_of
from graphkin.solver.path.dead_points import dead_points
from graphkin.structure import Structure
from tests.solver.checks import to_json

__all__ = ["Found", "look"]


MORE = 8


def _length(rng: np.random.Generator) -> float:
    return float(round(rng.uniform(20, 200), int(rng.integers(0, 4))))


def hazardous(rng: np.random.Generator) -> tuple[Mechanism, bool]:
    """A mechanism that just has a change point, or just misses it; and which of both."""
    kind = int(rng.integers(3))
    miss = float(rng.choice([0.0, 1.0, -1.0])) * 10.0 ** float(rng.uniform(-14, -2))
    a, b = _length(rng), _length(rng)
    if kind == 0:
        # the ground by one of the ways in which a four-bar can fold flat: parallelogram, kite, any sum
        c, d = [(a, b), (b, a), (_length(rng), None)][int(rng.integers(3))]
        ground = abs(a + b - c) if d is None else d
        scene: dict[str, Any] = {
            "frame": {"points": {"A": [0, 0], "D": [max(ground * (1 + miss), 1.0), 0]}},
            "links": {
                "1": {"points": ["A", "B"], "length": a},
                "2": {"points": ["B", "C"], "length": b, "at": {"E": [30, 40]}},
                "3": {"points": ["D", "C"], "length": c},
            },
            "sketch": {"C": [float(rng.uniform(-100, 300)), float(rng.uniform(-200, 200))]},
        }
    elif kind == 1:
        scene = {
            "frame": {"points": {"A": [0, a * (1 + miss)], "C": [0, 0]}},
            "links": {
                "1": {"points": ["A", "B"], "length": a},
                "2": {"points": ["B"], "on": "3"},
                "3": {"points": ["C", "D"], "length": b},
            },
        }
    else:
        scene = {
            "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
            "links": {
                "1": {"points": ["A", "B"], "length": a},
                "2": {"points": ["B", "C"], "length": a * (1 + miss), "at": {"E": [30, 40]}},
                "3": {"points": ["C"], "on": "0.h"},
            },
        }
    angle = float(rng.choice([float(rng.uniform(-180, 180)), 30.0, 60.0, 90.0, 135.0]))
    return mechanism_of({**scene, "driver": {"link": "1", "angle": angle, "omega": 1}}), miss == 0.0


@dataclass
class Found:
    """What was looked at, and what was wrong."""

    positions: int = 0
    dead: int = 0
    unreached: int = 0
    wrong: list[str] = field(default_factory=list)


def look(positions: int, seed: int, each: int = 24) -> Found:
    """Look at about so many positions."""
    rng = np.random.default_rng(seed)
    found = Found()
    while found.positions < positions:
        scene, smooth = hazardous(rng)
        try:
            structure = structure_of(scene)
            motion = solve(structure, sweep=each)
            fine = solve(structure, sweep=each * MORE)
            near = _near(rng, structure, each)
        except GraphkinError:
            continue
        _count(found, fine)
        wrong = [*_not_finite(motion), *_jumps(motion, fine, smooth), *_open(fine)]
        found.wrong += [f"{x} in a sweep of {scene}" for x in wrong]
        for value in near:
            one = solve(structure, at={"1": value})
            _count(found, one)
            found.wrong += [f"{x} at {value!r} of {scene}" for x in (*_not_finite(one), *_open(one))]
    return found


def _count(found: Found, motion: Motion) -> None:
    found.positions += len(motion)
    found.dead += int(np.sum(motion.status == "dead point"))
    found.unreached += int(np.sum(motion.status == "not assembled"))


def _near(rng: np.random.Generator, structure: Structure, n: int) -> list[float]:
    """Driver values at 0 and at 1e-16 to 1e-2 from dead points."""
    points = [float(p.value) for p in dead_points(structure)]
    if not points:
        return []
    away = rng.choice([0.0, 1.0, -1.0], n, p=[0.1, 0.45, 0.45]) * 10.0 ** rng.uniform(-16, -2, n)
    return [float(x) for x in rng.choice(points, n) + away]


def _not_finite(motion: Motion) -> list[str]:
    text = json.dumps(to_json(motion))
    return ["not a number"] if "NaN" in text or "Infinity" in text else []


def _jumps(motion: Motion, fine: Motion, smooth: bool) -> list[str]:
    """A sweep of many positions must agree with one of few where they meet, and between neighbours no link may turn,
    nor change its rate, by more than the rates there allow: where a mechanism just misses a change point it may turn
    back within a step, where it has one it may not."""
    wrong = []
    every = len(fine) // len(motion)
    both = motion.ok & fine.ok[::every]
    ok = fine.ok[1:] & fine.ok[:-1]
    step = np.abs(np.diff(fine.values[:, 0]))
    for link in motion.scene.links:
        apart = np.abs(motion.poses[link.name].u - fine.poses[link.name].u[::every])
        if np.any(apart[both] > 1e-6):
            wrong.append(f"link {link.name} depends on the number of positions")
        u = fine.poses[link.name].u
        turned = np.abs(u[1:] - u[:-1])
        rate, bend = np.abs(fine.omega(link.name)), np.abs(fine.alpha(link.name))
        most = np.maximum(rate[1:], rate[:-1]) * step + np.maximum(bend[1:], bend[:-1]) * step**2
        fastest = np.maximum(rate[1:], rate[:-1])
        quiet = (np.maximum(bend[1:], bend[:-1]) * step < 0.2 * (1 + fastest)) & (fastest * step < 0.3)
        swerved = np.abs(np.diff(fine.omega(link.name))) > 3 * np.maximum(bend[1:], bend[:-1]) * step + 1e-3
        if smooth and np.any(ok & quiet & ((turned > 2 * most + 1e-9) | swerved)):
            wrong.append(f"link {link.name} jumps")
    return wrong


def _open(motion: Motion) -> list[str]:
    """Pairs that are open by more than the bounds allow."""
    ok = motion.ok
    wrong = []
    bounds = (motion.bound.position, motion.bound.velocity, motion.bound.acceleration)
    for point, names in motion.structure.hinges.items():
        first = motion.point(point, names[0])
        for name in names[1:]:
            at = motion.point(point, name)
            for what, a, b, bound in zip("zva", (first.z, first.v, first.a), (at.z, at.v, at.a), bounds, strict=True):
                if np.any(np.abs(a - b)[ok] > 2 * bound[ok] * (1 + 1e-9) + 1e-300):
                    wrong.append(f"{point} is open in {what}")
    return wrong


def main() -> None:
    count, seed = (int(n) for n in (*sys.argv[1:3], *("100000", "1")[len(sys.argv) - 1 :]))
    begin = time.perf_counter()
    found = look(count, seed)
    print(f"{found.positions} positions, {found.dead} dead points, {found.unreached} out of reach "
          f"({time.perf_counter() - begin:.0f} s); wrong: {len(found.wrong)}")
    for line in found.wrong[:10]:
        print(line[:700])


if __name__ == "__main__":
    main()
