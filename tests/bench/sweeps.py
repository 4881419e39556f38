"""The user's way against the engine behind it, and against peers: run by hand, ``python -m tests.bench.sweeps``.

``graphkin.sweep`` returning arrays, from a scene that is read, against the sweep of a mechanism that is prepared
already, and against pylinkage's compiled sweep of the same twelve columns; the bundled scenes of class II, each
compiled sweep against its bare formulas; then the command line writing a table, against pyarrow writing the same
numbers.  Times depend on the machine, ratios within one run much less.
"""

from __future__ import annotations

import io
import subprocess
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import graphkin
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.scene import library
from graphkin.scene.symbol import Symbol
from graphkin.solver.compiled.kernel import Kernel, pays
from graphkin.solver.mobility import structure_of
from graphkin.solver.prepared import prepare

from . import peers
from .compare import best, header, one_thread
from .mechanisms import MECHANISMS

COUNTS = (10_000, 100_000, 1_000_000)
SCENE = "shaper-scheme-2"


def arrays() -> None:
    print(f"{'mechanism':14}{'positions':>10}{'engine ms':>11}{'sweep ms':>10}{'of engine':>11}{'of pylinkage':>14}")
    for case in MECHANISMS:
        scene = mechanism_of_text(case.text, case.name)
        for n in COUNTS:
            ready = prepare(scene, [*map(Symbol.parse, case.asked)])
            calls: dict[str, Callable[[], object]] = {
                "engine": lambda r=ready, n=n: r.sweep(n, fast=pays(n)),
                "sweep": lambda s=scene, c=case, n=n: graphkin.sweep(s, positions=n, find=c.asked),
            }
            peer = peers.pylinkage(case, n) if peers.have("pylinkage") else None
            if peer is not None:
                calls["peer"] = peer.timed  # type: ignore[attr-defined]
            took = best(calls)
            times = f"{took['engine'] * 1e3:11.2f}{took['sweep'] * 1e3:10.2f}{took['sweep'] / took['engine']:10.2f}x"
            print(f"{case.name:14}{n:10}{times}" + (f"{took['peer'] / took['sweep']:13.1f}x" if peer else ""))


def scenes(n: int = 10_000) -> None:
    """Place, velocity and acceleration of two points of each bundled scene of class II that has a closed form."""
    print(f"{'scene':30}{'columns':>8}{'bare ns':>9}{'sweep ns':>10}{'of bare':>9}  positions that are looked at")
    for name in library():
        structure = structure_of(mechanism_of(name))
        if not all(element.explicit for element in structure.elements):
            continue
        scene = structure.scene
        moving = dict.fromkeys(p for link in scene.links for p in link.points if p not in scene.frame.points)
        asked = [f"{kind}{point}" for kind in ("", "v_", "a_") for point in list(moving)[-2:]]
        ready = prepare(structure, [*map(Symbol.parse, asked)])
        public = graphkin.prepare(structure.scene, find=asked, fast=True)
        bare, given = Kernel(ready.code, ready.turns, True), ready.range.grid(n).given
        out = np.empty((len(ready.asked), n))
        took = best({
            "bare": one_thread(lambda b=bare, g=given, x=ready.numbers[0], o=out: b(0, n, x, *g, o)),
            "sweep": one_thread(lambda p=public: p.sweep(n)),
        })
        ns = {what: seconds / n * 1e9 for what, seconds in took.items()}
        times = f"{ns['bare']:9.1f}{ns['sweep']:10.1f}{ns['sweep'] / ns['bare']:8.2f}x"
        print(f"{name:30}{len(ready.asked):8}{times}  {len(ready._divided(ready.range.grid(n))[2])}", flush=True)


def tables(n: int = 100_000) -> None:
    import pyarrow as pa
    from pyarrow import csv

    program = [sys.executable, "-c", "from graphkin.cli import main; main()", "sweep", SCENE, "--positions", str(n)]
    for what, more in (("all columns", []), ("--find v_C", ["--find", "v_C"])):
        table = graphkin.sweep(SCENE, positions=n, find=more[1:] or None).table
        numbers = pa.table({c.head: c.values for c in table.columns if not c.is_text})
        own = best({"pyarrow": lambda t=numbers: csv.write_csv(t, io.BytesIO())})["pyarrow"]
        mine = best({"table": lambda t=table: t.write_csv(io.BytesIO())})["table"]
        with TemporaryDirectory() as folder:
            begin = time.perf_counter()
            process = subprocess.Popen([*program, *more, "-q", "-o", folder])
            while not (Path(folder) / "table.csv").exists():
                time.sleep(0.002)
            there = time.perf_counter() - begin
            process.wait()
            whole = time.perf_counter() - begin
        print(
            f"{SCENE}, {n} rows, {what}: pyarrow {own:.2f} s, our writer {mine:.2f} s; command line: table there after "
            f"{there:.2f} s (allowed {3 * own + 1:.2f}), with figures {whole:.2f} s"
        )


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    print(header())
    arrays()
    scenes()
    tables()
