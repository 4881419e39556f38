"""How long the figures of a scene take: run by hand, ``python -m tests.bench.figures [SCENE ...]``.

Processor times of the public call: `graphkin.draw` of the five figures with readings and check, to the bytes of their
SVG, after import; the share of placing labels in it; the same in units of `graphkin.solve` alone, which does not depend
on the machine; the first call of a new process; and the whole process ``graphkin draw``, files written.

Asked after import: the shaper 100 ms, a six-bar with a class III group 200 ms, the double butterfly 400 ms.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from unittest.mock import patch

import graphkin
from graphkin.drawing import svg_bytes
from graphkin.drawing.place import names
from tests.command import PROGRAM

REPEATS = 9
FIVE = ("mechanism", "velocity", "acceleration", "sheet", "centres")
ASKED = {"shaper-scheme-2": 100, "sixbar-coupler-1A": 200, "double-butterfly": 400}  # ms
FIRST = """
import sys, time
import graphkin, graphkin.api.drawn, graphkin.drawing.figures.sheet, graphkin.drawing.figures.centres
from tests.bench.figures import five
start = time.process_time()
five(sys.argv[1])
assert not {"matplotlib", "scipy", "shapely"} & set(sys.modules)
print(time.process_time() - start)
"""


def best(call: Callable[[], object]) -> float:
    """Least processor time of a call, ms."""
    found = float("inf")
    for _ in range(REPEATS):
        start = time.process_time()
        call()
        found = min(found, time.process_time() - start)
    return 1e3 * found


def five(name: str) -> None:
    """Everything from the name of a scene to the bytes of its five figures."""
    drawn = graphkin.draw(name, figures=FIVE)
    assert drawn.ok
    for figure in drawn.figures.values():
        svg_bytes(figure)


def placed(name: str) -> tuple[float, int]:
    """Time for all labels of a scene's figures, ms, and how many times labels were placed."""
    spent, times = 0.0, 0
    own = names.named

    def timed(*args: object) -> object:
        nonlocal spent, times
        start = time.process_time()
        try:
            return own(*args)  # type: ignore[arg-type]
        finally:
            spent += time.process_time() - start
            times += 1

    with patch.object(names, "named", timed):
        five(name)
    return 1e3 * spent, times


def first(name: str) -> float:
    """The first call of a new process, ms of the processor, imports left out."""
    said = subprocess.run([sys.executable, "-c", FIRST, name], capture_output=True, text=True, check=True).stdout
    return 1e3 * float(said)


def process(name: str) -> float:
    """The whole process that draws a scene and writes its files, ms of the processor."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([*PROGRAM, "draw", name, "-o", folder], capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return 1e3 * (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def main() -> None:
    names = sys.argv[1:] or list(ASKED)
    five(names[0])  # imports, fonts
    heads = ("five, ms", "asked", "labels", "placings", "five / solve", "first call", "process")
    print(f"{'scene':<32}" + "".join(f"{head:>14}" for head in heads))
    for name in names:
        whole, alone = best(lambda name=name: five(name)), best(lambda name=name: graphkin.solve(name))
        spent, times = placed(name)
        cells = (f"{whole:.0f}", str(ASKED.get(name, "")), f"{spent:.0f}", str(times), f"{whole / alone:.0f}",
                 f"{first(name):.0f}", f"{process(name):.0f}")
        print(f"{name:<32}" + "".join(f"{cell:>14}" for cell in cells))


if __name__ == "__main__":
    main()
