"""Stated error bounds against 50 digits, on random mechanisms, half of the positions near singular ones.

Run by hand, ``python -m tests.bench.accuracy 100000 [SEED]``; the test-suite runs a few hundred positions of it.  For
each position the largest true error of any point of any link in place, velocity and acceleration, and of any link in
angle and its rates, is held against its bound: it must never exceed it, and the bound should be within 1000 times of
it for nine in ten.  A tenth as many positions are of mechanisms with larger groups.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from decimal import Decimal, localcontext
from typing import Any
from unittest.mock import patch

import numpy as np

from graphkin.errors import GraphkinError
from graphkin.scene import mechanism_of
from graphkin.scene.model import Mechanism
from graphkin.solver.algebra.bounds import most_of
from graphkin.solver.algebra.pose import FIELDS, Drive
from graphkin.solver.compiled import engine
from graphkin.solver.drivers import PI, meant, own_values, working
from graphkin.solver.path.assemblies import choose_modes
from graphkin.solver.path.continuity import follow_path
from graphkin.structure import Structure, analyse

from .larger import measure_larger
from .tally import Tally

__all__ = ["measure", "random_scene"]

EACH = 40


def _mm(rng: np.random.Generator, low: float, high: float) -> float:
    return float(round(rng.uniform(low, high), 3))


def _point(rng: np.random.Generator, wide: float) -> list[float]:
    return [_mm(rng, -wide, wide), _mm(rng, -wide, wide)]


def random_scene(rng: np.random.Generator) -> Mechanism:
    """A crank and one to three dyads on it, each of a random kind, hung on a point of what is there already."""
    links: dict[str, Any] = {"1": {"points": ["A", "B"], "length": _mm(rng, 20, 120)}}
    points: dict[str, list[float]] = {"A": [0.0, 0.0]}
    guides: dict[str, Any] = {}
    free = ["B"]
    number = 1
    for k in range(int(rng.integers(1, 4))):
        kind = str(rng.choice(["RRR", "RRP", "RPR"]))
        hang = str(rng.choice(free))
        number += 2
        one, two, pivot, inner = str(number - 1), str(number), f"P{k}", f"Q{k}"
        if kind == "RRR":
            points[pivot] = _point(rng, 300)
            links[one] = {"points": [hang, inner], "length": _mm(rng, 50, 400), "at": {f"E{k}": _point(rng, 150)}}
            links[two] = {"points": [pivot, inner], "length": _mm(rng, 50, 400)}
            free += [f"E{k}", inner]
        elif kind == "RRP":
            guides[f"g{k}"] = {"through": _point(rng, 150), "angle": _mm(rng, -180, 180)}
            links[one] = {"points": [hang, inner], "length": _mm(rng, 100, 400), "at": {f"E{k}": _point(rng, 150)}}
            links[two] = {"points": [inner], "on": f"0.g{k}", "angle_on": _mm(rng, -90, 90)}
            free += [f"E{k}"]
        else:
            points[pivot] = _point(rng, 200)
            links[one] = {"points": [hang], "on": f"{two}.s"}
            links[two] = {
                "points": [pivot, f"E{k}"], "length": _mm(rng, 50, 300),
                "guides": {"s": {"through": _point(rng, 40), "angle": _mm(rng, -180, 180)}},
            }
            free += [f"E{k}"]
    driver = {"link": "1", "angle": _mm(rng, -180, 180), "omega": _mm(rng, -20, 20), "alpha": _mm(rng, -50, 50)}
    return mechanism_of({"frame": {"points": points, "guides": guides}, "links": links, "driver": driver})


def _values(rng: np.random.Generator, structure: Structure, modes: dict[int, Any], n: int) -> np.ndarray:
    """Driver values (degrees) the motion reaches: half anywhere, half 1e-1 to 1e-12 of it from its ends."""
    start = own_values(structure.scene)
    ahead = follow_path(structure, modes, start, start + 2 * np.pi)
    behind = follow_path(structure, modes, start, start - 2 * np.pi)
    low, high = (-behind.reach, ahead.reach) if ahead.limit is not None else (0.0, 1.0)
    share = rng.uniform(low, high, n)
    near = 10.0 ** rng.uniform(-12, -1, n) * (high - low)
    ends = np.where(rng.random(n) < 0.5, low + near, high - near)
    close = (rng.random(n) < 0.5) & (ahead.limit is not None)
    return np.degrees(start[0] + 2 * np.pi * np.where(close, ends, share))


def measure(positions: int, seed: int, refine: bool = False, each: int = EACH) -> Tally:
    """Hold bounds against true errors at about so many positions.

    Parameters
    ----------
    each : positions of one mechanism
    refine : True looks at the results as they are given out, False at those of 16 digits throughout
    """
    rng = np.random.default_rng(seed)
    tally = Tally()
    with patch.object(engine, "ROUGH", engine.ROUGH if refine else np.inf):
        while tally.looked_at < positions:
            try:
                scene = random_scene(rng)
                structure = analyse(scene)
                modes = choose_modes(structure)
                values = _values(rng, structure, modes, each)
            except GraphkinError:
                continue
            _hold(structure, modes, values, tally)
    return tally


def _hold(structure: Structure, modes: dict[int, Any], values: np.ndarray, tally: Tally) -> None:
    drive = Drive.at(structure, np.radians(values)[:, None])
    state = engine.positions(structure, drive, modes)
    program_row = _exact_rows(structure, drive, modes, values)
    names = [n for n in structure.links if n != structure.scene.frame.name]
    sines = [np.broadcast_to(g.sine, values.shape) for g in state.groups.values()]
    told = most_of(state.bounds(structure, np.ones(len(values), dtype=bool)).values())
    for k in range(len(values)):
        bounds = [float(b[k]) for b in told]
        if min(abs(s[k]) for s in sines) < engine.SINGULAR or not np.isfinite(bounds).all():
            tally.refused += 1
            continue
        try:
            row = program_row(k)
        except ArithmeticError:
            tally.lost += 1
            continue
        worst = [0.0] * 6
        for name in names:
            pose, exact = state.poses[name], row[name]
            places = [0j, *structure.links[name].points.values()]
            found = [(pose.fixed(z), exact, z) for z in places]
            pairs = [(0, p.z, e.place(z)) for p, e, z in found]
            pairs += [(1, p.v, e.velocity(z)) for p, e, z in found] + [(2, p.a, e.acceleration(z)) for p, e, z in found]
            pairs += [(3, pose.u, exact.parts["u"])]
            pairs += [(4, pose.omega, exact.parts["omega"]), (5, pose.alpha, exact.parts["alpha"])]
            for kind, got, want in pairs:
                z = complex(np.broadcast_to(got, values.shape)[k])
                off = abs(complex(float(Decimal(z.real) - want[0]), float(Decimal(z.imag) - want[1])))
                worst[kind] = max(worst[kind], off)
        tally.hold(bounds, worst, f"at {values[k]!r} of {structure.scene}")


class _Exact:
    """A link in 50 digits."""

    def __init__(self, parts: dict[str, tuple[Decimal, Decimal]]) -> None:
        self.parts = parts

    def _turned(self, place: complex) -> tuple[Decimal, Decimal]:
        (ux, uy), x, y = self.parts["u"], meant(place.real)[0], meant(place.imag)[0]
        return ux * x - uy * y, uy * x + ux * y

    def place(self, place: complex) -> tuple[Decimal, Decimal]:
        with working():
            (zx, zy), (rx, ry) = self.parts["z"], self._turned(place)
            return zx + rx, zy + ry

    def velocity(self, place: complex) -> tuple[Decimal, Decimal]:
        with working():
            (vx, vy), (w, _), (rx, ry) = self.parts["v"], self.parts["omega"], self._turned(place)
            return vx - w * ry, vy + w * rx

    def acceleration(self, place: complex) -> tuple[Decimal, Decimal]:
        with working():
            (ax, ay), (w, _), (rx, ry) = self.parts["a"], self.parts["omega"], self._turned(place)
            al = self.parts["alpha"][0]
            return ax - al * ry - w * w * rx, ay + al * rx - w * w * ry


def _exact_rows(structure: Structure, drive: Drive, modes: dict[int, Any], degrees: np.ndarray) -> Any:
    """Function of the number of a position to its links in 50 digits, with the driver at just these degrees."""
    run = engine._Run(structure, drive, modes, True)
    program = run.dimensioned.program
    names = [n for n in structure.links if n != structure.scene.frame.name]
    asked = [getattr(program.poses[n], f) for n in names for f in FIELDS]
    again = run._extended(program.code(("accuracy",), asked))

    def row(k: int) -> dict[str, _Exact]:
        exact = Decimal(float(degrees[k]))
        with working(), patch.object(engine, "meant_angle", lambda _: (exact * PI / 180, True)):
            numbers = list(again.row(k))
        found: dict[str, _Exact] = {}
        for name in names:
            parts: dict[str, tuple[Decimal, Decimal]] = {}
            for f in FIELDS:
                x = numbers.pop(0)
                parts[f] = (x, numbers.pop(0)) if f not in ("omega", "alpha") else (x, Decimal(0))
            found[name] = _Exact(parts)
        return found

    return row


def main() -> None:
    count, seed = (int(n) for n in (*sys.argv[1:3], *("100000", "1")[len(sys.argv) - 1 :]))
    runs: list[tuple[str, Callable[[], Tally]]] = [
        ("dyads, in 16 digits throughout", lambda: measure(count, seed, False)),
        ("dyads, as given out", lambda: measure(count, seed, True)),
        ("larger groups", lambda: measure_larger(count // 10, seed)),
    ]
    for what, run in runs:
        begin = time.perf_counter()
        tally = run()
        print(what, f"({time.perf_counter() - begin:.0f} s)")
        print(tally.text(), flush=True)
        for line in tally.broken[:10]:
            print("BROKEN", line[:300])


if __name__ == "__main__":
    with localcontext():
        main()
