"""How long the worked job of a scene takes after import: run by hand, ``python -m tests.bench.figures [SCENE ...]``.

Drawing, readings and check; the four figures (mechanism, both polygons, instant centres) with their labels, written as
SVG; the share of placing labels among them; and the A4 sheet, which shows the same construction at its own scales.
Times depend on the machine; the last column is the job in units of the solver's own part of it.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from unittest.mock import patch

import graphkin
from graphkin.construction.centres import speeds
from graphkin.drawing import figures, labels, svg_bytes
from graphkin.drawing.centres import centres_figure
from graphkin.scene import library

REPEATS = 7


def best(call: Callable[[], object]) -> float:
    """Least processor time of a call, ms."""
    found = float("inf")
    for _ in range(REPEATS):
        start = time.process_time()
        call()
        found = min(found, time.process_time() - start)
    return 1e3 * found


def job(name: str) -> None:
    """Everything from the scene to the bytes of its four figures."""
    checked = graphkin.check(name)
    assert checked.ok
    for figure in figures(checked.sheet).values():
        svg_bytes(figure)
    svg_bytes(centres_figure(checked.centres, speeds(checked.centres)))


def whole(name: str) -> None:
    """The four figures and the sheet."""
    drawn = graphkin.draw(name)
    for figure in drawn.figures.values():
        svg_bytes(figure)


def placed(name: str) -> tuple[float, int]:
    """Time for all labels of a scene's figures, ms, and how many times labels were placed."""
    spent, times = 0.0, 0
    own = labels.place

    def timed(*args: object, **more: object) -> object:
        nonlocal spent, times
        start = time.process_time()
        try:
            return own(*args, **more)  # type: ignore[arg-type]
        finally:
            spent += time.process_time() - start
            times += 1

    with patch.object(labels, "place", timed):
        modules = [m for m in sys.modules.values() if getattr(m, "place", None) is own]
        for module in modules:
            module.place = timed  # type: ignore[attr-defined]
        try:
            job(name)
        finally:
            for module in modules:
                module.place = own  # type: ignore[attr-defined]
    return 1e3 * spent, times


def main() -> None:
    names = sys.argv[1:] or sorted(library())
    whole(names[0])  # imports, fonts
    print(f"{'scene':<32}{'job, ms':>10}{'labels, ms':>12}{'placings':>10}{'with sheet':>12}{'job / solve':>13}")
    for name in names:
        four, five = best(lambda name=name: job(name)), best(lambda name=name: whole(name))
        alone = best(lambda name=name: graphkin.solve(name))
        labels, times = placed(name)
        print(f"{name:<32}{four:>10.0f}{labels:>12.1f}{times:>10}{five:>12.0f}{four / alone:>13.0f}")


if __name__ == "__main__":
    main()
