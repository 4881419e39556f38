"""The user's way against the engine behind it, and against peers: run by hand, ``python -m tests.bench.sweeps``.

``graphkin.sweep`` returning arrays, from a scene that is read, against the sweep of a mechanism that is prepared
already, and against pylinkage's compiled sweep of the same twelve columns; then the command line writing a table,
against pyarrow writing the same numbers.  Times depend on the machine, ratios within one run much less.
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

import graphkin
from graphkin.scene import mechanism_of_text
from graphkin.solver.compiled.kernel import pays
from graphkin.solver.prepared import prepare

from . import peers
from .compare import best, header
from .mechanisms import MECHANISMS

COUNTS = (10_000, 100_000, 1_000_000)
SCENE = "shaper-scheme-2"


def arrays() -> None:
    print(f"{'mechanism':14}{'positions':>10}{'engine ms':>11}{'sweep ms':>10}{'of engine':>11}{'of pylinkage':>14}")
    for case in MECHANISMS:
        scene = mechanism_of_text(case.text, case.name)
        for n in COUNTS:
            ready = prepare(scene, case.asked)
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
    tables()
