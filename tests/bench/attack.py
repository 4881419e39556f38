"""Random mechanisms of every driver and every dyad, also with round data and at rest, through every command.

Run by hand, ``python -m tests.bench.attack 10000 [first seed]``; the test-suite runs some of it.  Each answer must be
right or a refusal by name: no traceback, no reading out of tolerance, nothing said of what is not drawn, nothing that
takes longer than five seconds.
"""

from __future__ import annotations

import json
import random
import sys
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Mapping
from typing import Any

import graphkin
from graphkin.errors import GraphkinError
from tests.mechanisms import DRIVES, KINDS, floating_cylinder, random_scene

__all__ = ["COMMANDS", "attack", "mechanism"]

Scene = Mapping[str, Any]


def mechanism(seed: int) -> dict[str, Any]:
    """A random mechanism; one in eight with a driven cylinder between two floating links."""
    dice = random.Random(f"attack {seed}")
    if dice.random() < 0.125:
        return floating_cylinder(seed)
    while True:
        kinds = tuple(dice.choice(KINDS) for _ in range(dice.randint(1, 3)))
        try:
            return random_scene(dice.randrange(10**9), kinds, dice.choice(DRIVES), textbook=dice.random() < 0.5)
        except (ZeroDivisionError, ValueError):
            continue  # two of the places chosen fall together


def _check(scene: Scene) -> list[str]:
    result = graphkin.check(scene)
    json.dumps(result.data, allow_nan=False)
    off = [str(row.symbol) for row in result.report.rows if row.ok is False]
    return off + ([] if result.complete else ["not whole"])


def _cad(scene: Scene) -> list[str]:
    result = graphkin.check(scene, instrument="cad")
    json.dumps(result.data, allow_nan=False)
    return [str(row.symbol) for row in result.report.rows if row.ok is False]


def _centres(scene: Scene) -> list[str]:
    result = graphkin.centres(scene)
    json.dumps(result.data, allow_nan=False)
    return [str(v.symbol) for v in result.velocities if v.ok is False] + ([] if result.ok else ["centres"])


def _audit(scene: Scene) -> list[str]:
    """The exact values stated to six digits: none may be called wrong."""
    rows = graphkin.check(scene).report.rows
    sizes = {str(r.symbol): abs(r.exact) / 1e-3 if r.symbol.is_vector else float(r.exact.real) for r in rows}
    stated = {name: float(f"{size:.6g}") for name, size in sizes.items()}
    result = graphkin.audit({**scene, "printed": stated})
    return [str(j.printed.symbol) for _, judged in result.people for j in judged if j.verdict == "wrong"]


def _draw(scene: Scene) -> list[str]:
    drawn = graphkin.draw(scene)
    return [name for name, figure in drawn.figures.items() if not figure.content("svg")]


def _sweep(scene: Scene) -> list[str]:
    """Limits, extremes and diagrams of the whole motion."""
    swept = graphkin.sweep(scene, positions=12)
    json.dumps(swept.data, allow_nan=False)
    empty = [name for name, figure in swept.figures.items() if not figure.content("svg")]
    return empty + (["not a number"] if "nan" in swept.text.split() else [])


COMMANDS: Mapping[str, Callable[[Scene], list[str]]] = {
    "check": _check,
    "centres": _centres,
    "cad": _cad,
    "audit": _audit,
    "draw": _draw,
    "sweep": _sweep,
}
SLOWEST = 5.0  # seconds of the processor


def attack(scene: Scene, command: str) -> str:
    """What came of a command: "ok", "refused: ..." or what is wrong."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            wrong = COMMANDS[command](scene)
    except GraphkinError as refusal:
        return f"refused: {str(refusal).splitlines()[0]}"
    except Exception as fault:  # whatever it is, it is what is looked for here
        return f"{type(fault).__name__}: {fault} at {traceback.extract_tb(fault.__traceback__)[-1]}"
    return "ok" if not wrong else f"wrong: {', '.join(wrong)}"


def commands_of(seed: int) -> list[str]:
    """What a mechanism goes through: ``check`` and ``centres``, and one of the others, which take longer, in turn."""
    others = [command for command in COMMANDS if command not in ("check", "centres")]
    return ["check", "centres", others[seed % len(others)]]


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    tally: Counter[tuple[str, str]] = Counter()
    for seed in range(first, first + count):
        scene = mechanism(seed)
        for command in commands_of(seed):
            begin = time.process_time()
            came = attack(scene, command)
            if (taken := time.process_time() - begin) > SLOWEST:
                came = f"slow: {taken:.1f} s, {came}"
            tally[command, came.partition(":")[0]] += 1
            if not came.startswith(("ok", "refused")):
                print(seed, command, came, flush=True)
        if (seed - first) % 100 == 99:
            print(f"{seed - first + 1} mechanisms", dict(sorted(tally.items())), flush=True)
    for (command, came), number in sorted(tally.items()):
        print(f"{command:8} {came:12} {number}")


if __name__ == "__main__":
    main()
