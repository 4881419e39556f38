"""graphkin against its peers on the same mechanisms: run by hand, ``python -m tests.bench.compare [MECHANISM ...]``.

Position, velocity and acceleration of two points of a four-bar, a slider-crank and two shapers (twelve columns) over a
turn, into arrays that are there already, on one thread; "all threads" and "a new array" say what they say.  Everyone's
values are checked against each other first.  Times depend on the machine, ratios within one run much less.  A peer that
is not installed is left out.
"""

from __future__ import annotations

import math
import os
import platform
import sys
import time
import warnings
from collections.abc import Callable, Mapping
from importlib.metadata import PackageNotFoundError, version

import numpy as np

import graphkin
from graphkin.scene import mechanism_of_text
from graphkin.scene.symbol import Symbol
from graphkin.solver.prepared import prepare

from . import by_hand, peers
from .mechanisms import MECHANISMS, Case

COUNTS = (360, 10_000, 1_000_000)
ROUNDS = 200
SHARE = 2.0
"""Seconds that a call is run for, in all."""
LEAST = 5
GOES = 10


def best(calls: Mapping[str, Callable[[], object]]) -> dict[str, float]:
    """Least time of each call (s), after a first one that warms up.

    The calls take turns, so that what else the machine does meets them alike; a round gives the quick ones several
    goes, and a slow one sits out where it has had its share.
    """
    spent: dict[str, list[float]] = {}
    for name, call in calls.items():
        call()
        spent[name] = [_once(call)]
    rounds = 0
    while rounds < ROUNDS and any(sum(times) < SHARE for times in spent.values()):
        for name, call in calls.items():
            times = spent[name]
            if len(times) < LEAST or sum(times) < SHARE:
                times += [_once(call) for _ in range(GOES if min(times) < 1e-3 else 1)]
        rounds += 1
    return {name: min(times) for name, times in spent.items()}


def _once(call: Callable[[], object]) -> float:
    if peers.have("numba"):
        import numba

        numba.set_num_threads(getattr(call, "threads", numba.config.NUMBA_NUM_THREADS))
    begin = time.perf_counter()
    call()
    return time.perf_counter() - begin


def one_thread(call: Callable[[], object]) -> Callable[[], object]:
    """A call with the threads of numba held to one before it is timed."""
    call.threads = 1  # type: ignore[attr-defined]
    return call


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
    scene = mechanism_of_text(case.text, case.name)
    ready = prepare(scene, [*map(Symbol.parse, case.asked)])
    public, compiled = (graphkin.prepare(scene, find=case.asked, fast=fast) for fast in (False, True))
    shaper = by_hand.compiled_shaper(case.sizes) if case.sizes and peers.have("numba") else None
    found: list[tuple[str, int, float, str]] = []
    for n in COUNTS:
        mine, ok = ready.sweep(n)
        assert ok.all()
        out = np.empty_like(mine)
        calls: dict[str, Callable[[], object]] = {"graphkin, NumPy": lambda n=n, out=out: ready.sweep(n, out)}
        values = {"graphkin, NumPy": "ok"}
        calls["graphkin, a new array"] = lambda n=n: public.sweep(n)
        values["graphkin, a new array"] = agree("public", mine, public.sweep(n).values)
        if peers.have("numba"):
            calls["graphkin, fast"] = one_thread(lambda n=n, out=out: ready.sweep(n, out, fast=True))
            calls["fast, a new array"] = one_thread(lambda n=n: compiled.sweep(n))
            calls["fast, all threads"] = lambda n=n, out=out: ready.sweep(n, out, fast=True)
            values["graphkin, fast"] = agree("fast", mine, ready.sweep(n, fast=True)[0])
            if shaper is not None:
                start, step = float(ready.range.grid(1).values[0]), 2 * math.pi / n
                shaper(start, step, out)
                calls["by hand, numba"] = one_thread(lambda a=start, d=step, out=out: shaper(a, d, out))
                values["by hand, numba"] = agree("hand", mine, out)
        for name, make in peers.PEERS.items():
            call = make(case, n) if peers.have(name) else None
            if call is not None:
                calls[name] = getattr(call, "timed", call)
                values[name] = agree(name, mine, call())
        if case.name in by_hand.WRITTEN:
            hand, angles = by_hand.WRITTEN[case.name], ready.range.grid(n).values
            calls["by hand, NumPy"] = lambda v=angles, h=hand: h(v)
            values["by hand, NumPy"] = agree("hand", mine, hand(angles))
        copy = np.empty_like(mine)
        calls["copying the columns"] = lambda c=copy, m=mine: np.copyto(c, m)
        found += [(name, n, took, values.get(name, "")) for name, took in best(calls).items()]
    value = float(ready.range.grid(360).values[17])
    took = best({"one": lambda: [ready.at(value) for _ in range(1000)]})["one"] / 1000
    found.append(("graphkin, plain floats", 1, took, "ok"))
    return found


def main() -> None:
    warnings.simplefilter("ignore")
    print(header())
    head = f"{'mechanism':14}{'positions':>10}  {'who':24}{'time us':>12}{'ns each':>10}"
    print(f"{head}{'to pylinkage':>14}{'to by hand':>12}  values")
    for case in MECHANISMS:
        if sys.argv[1:] and case.name not in sys.argv[1:]:
            continue
        table = rows(case)
        slow = {n: t for who, n, t, _ in table if who == "pylinkage"}
        hand = {n: t for who, n, t, _ in table if who == "by hand, numba"}
        for who, n, t, same in sorted(table, key=lambda row: row[1]):
            ratio = f"{slow[n] / t:.1f} x" if n in slow else ""
            times = f"{t / hand[n]:.2f} x" if n in hand else ""
            print(f"{case.name:14}{n:10}  {who:24}{t * 1e6:12.1f}{t / n * 1e9:10.1f}{ratio:>14}{times:>12}  {same}")


if __name__ == "__main__":
    if __package__ is None:
        sys.exit("run it as python -m tests.bench.compare")
    main()
