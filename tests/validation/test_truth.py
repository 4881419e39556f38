"""Every link, point and slide of the textbook problems over a turn, against another solver of 50 digits."""

from __future__ import annotations

import cmath
import json
import math
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import graphkin

CASES = json.loads((Path(__file__).parent / "truth.json").read_text())["cases"]
PLACES = [(name, k) for name, case in CASES.items() for k in range(len(case["positions"]))]
CLOSE = 1e-10  # of the largest value of its kind
TINY = 1e-10  # in the scene's units, where all values are zero


scene = cache(graphkin.read)


def named(name: str, k: int) -> str:
    return f"{name} at {float(CASES[name]['positions'][k]['driver_deg']):.3f}"


def kinds(row: dict[str, Any], kind: str) -> dict[str, complex]:
    """The values of a row of the reference by their names in graphkin's data."""
    if kind == "links":
        turn = cmath.exp(1j * math.radians(row[0]))
        return {"angle": turn, "omega": row[1], "alpha": row[2]}
    if kind == "slides":
        return {"travel": row[0], "velocity": row[1], "acceleration": row[2], "coriolis": complex(row[3], row[4])}
    return {n: complex(*row[2 * i : 2 * i + 2]) for i, n in enumerate(("position", "velocity", "acceleration"))}


def found(name: str, position: dict[str, Any], kind: str, key: str, what: str) -> complex:
    """The same in graphkin's data, a point as the links that it joins carry it (not the guide under its block)."""
    row = position[kind][key if kind != "points" else f"{key}@{scene(name).mechanism.holders[key][0]}"]
    value = row[what]
    return cmath.exp(1j * value) if what == "angle" else complex(*value) if isinstance(value, list) else value


@pytest.mark.parametrize(("name", "k"), PLACES, ids=[named(*place) for place in PLACES])
def test_everything_moves_as_in_the_reference(name: str, k: int) -> None:
    true = CASES[name]["positions"][k]
    position = graphkin.solve(scene(name), at=float(true["driver_deg"])).data["positions"][0]
    for kind in ("links", "points", "slides"):
        pairs: dict[str, list[tuple[complex, complex]]] = {}
        for key, row in true[kind].items():
            for what, exact in kinds(row, kind).items():
                pairs.setdefault(what, []).append((exact, found(name, position, kind, key, what)))
        for rows in pairs.values():
            largest = max(abs(exact) for exact, _ in rows)
            assert max(abs(exact - mine) for exact, mine in rows) <= CLOSE * largest + TINY
