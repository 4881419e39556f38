"""graphkin against its peers on the same mechanisms: run by hand, ``python -m tests.bench.compare``.

Position, velocity and acceleration of two points of a four-bar, a slider-crank and a shaper (twelve columns) over a
turn.  Everyone's values are checked against each other first.  Times depend on the machine, ratios within one run much
less.  A peer that is not installed is left out.
"""

from __future__ import annotations

import math
import os
import platform
import sys
import time
import warnings
from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version

import numpy as np

from graphkin.exact import prepare
from graphkin.scene import read_text

from . import by_hand, peers
from .mechanisms import MECHANISMS, Case

COUNTS = (360, 10_000, 1_000_000)


def best(call: Callable[[], object], once: float) -> float:
    """Least time of a call (s)."""
    times = []
    for _ in range(3 if once > 0.3 else 7 if once > 0.02 else 40):
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return min(times)


def timed(call: Callable[[], object]) -> float:
    """Least time of a call after a first one that warms up (s)."""
    call()
    begin = time.perf_counter()
    call()
    return best(call, time.perf_counter() - begin)


def header() -> str:
    names = ("numpy", "numba", "pylinkage", "sympy", "mechanism")
    found = []
    for name in names:
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            found.append(f"{name} -")
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else math.nan
    return f"Python {platform.python_version()}, {os.cpu_count()} cores (load {load:.1f}), {', '.join(found)}"


def agree(name: str, mine: np.ndarray, theirs: np.ndarray) -> str:
    """How far two tables of the same columns are apart, relative to the largest value of each column."""
    scale = np.maximum(np.abs(mine).max(axis=1), 1e-3 * np.abs(mine).max())
    worst = float((np.abs(mine - theirs).max(axis=1) / scale).max())
    return "ok" if worst < 1e-6 else f"differs by {worst:.1e}"


def rows(case: Case) -> list[tuple[str, int, float, str]]:
    """What, number of positions, seconds, and whether the values agree."""
    ready = prepare(read_text(case.text, case.name), case.asked)
    found: list[tuple[str, int, float, str]] = []
    for n in COUNTS:
        mine, ok = ready.sweep(n)
        assert ok.all()
        out = np.empty_like(mine)
        found.append(("graphkin, NumPy", n, timed(lambda n=n, out=out: ready.sweep(n, out)), "ok"))
        if peers.have("numba"):
            quick, _ = ready.sweep(n, fast=True)
            took = timed(lambda n=n, out=out: ready.sweep(n, out, fast=True))
            found.append(("graphkin, fast", n, took, agree("fast", mine, quick)))
        for name, make in peers.PEERS.items():
            if not peers.have(name):
                continue
            call = make(case, n)
            if call is None:
                continue
            theirs = call()
            if n > 10_000 and name == "mechanism":
                continue
            found.append((name, n, timed(getattr(call, "timed", call)), agree(name, mine, theirs)))
        if case.name in by_hand.WRITTEN:
            hand = by_hand.WRITTEN[case.name]
            values = ready.values(n)
            theirs = hand(values)
            found.append(("by hand, NumPy", n, timed(lambda v=values, h=hand: h(v)), agree("hand", mine, theirs)))
        copy = np.empty_like(mine)
        found.append(("copying the columns", n, timed(lambda c=copy, m=mine: np.copyto(c, m)), ""))
    value = float(ready.values(360)[17])
    found.append(("graphkin, plain floats", 1, timed(lambda: [ready.at(value) for _ in range(1000)]) / 1000, "ok"))
    return found


def main() -> None:
    warnings.simplefilter("ignore")
    print(header())
    print(f"{'mechanism':14}{'positions':>10}  {'who':24}{'time us':>12}{'ns each':>10}{'to pylinkage':>14}  values")
    for case in MECHANISMS:
        table = rows(case)
        slow = {n: t for who, n, t, _ in table if who == "pylinkage"}
        for who, n, t, same in sorted(table, key=lambda row: row[1]):
            ratio = f"{slow[n] / t:.1f} x" if n in slow else ""
            print(f"{case.name:14}{n:10}  {who:24}{t * 1e6:12.1f}{t / n * 1e9:10.1f}{ratio:>14}  {same}")


if __name__ == "__main__":
    if __package__ is None:
        sys.exit("run it as python -m tests.bench.compare")
    main()
