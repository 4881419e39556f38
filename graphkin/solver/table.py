"""A motion as plain data for programs, in the scene's length unit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from graphkin.scene.model import Scene, SlideDriver
from graphkin.solver.motion import Motion
from graphkin.solver.pose import Array
from graphkin.structure import Cluster, Dyad, Slide

__all__ = ["listed_points", "to_json"]


def listed_points(scene: Scene, slides: Sequence[Slide]) -> tuple[tuple[str, str], ...]:
    """Every point of a moving link, on every link that has it, and every coincident point under a sliding pin:
    (point, link) in the order of the file."""
    found = [(p, link.name) for link in scene.links for p in link.points]
    moving = {link.name for link in scene.links}
    for pair in slides:
        if pair.pin and pair.b in moving and (pair.pin, pair.b) not in found:
            found.append((pair.pin, pair.b))
    place = {link.name: i for i, link in enumerate(scene.links)}
    return tuple(sorted(found, key=lambda ref: place[ref[1]]))


def to_json(motion: Motion) -> dict[str, Any]:
    """The object that ``solve --json`` prints: numbers in the scene's length unit, seconds, radians."""
    scene = motion.scene
    n = len(motion)
    metres = scene.units.metres
    columns: dict[str, dict[str, dict[str, list[Any]]]] = {"links": {}, "points": {}, "slides": {}}
    for link in scene.links:
        columns["links"][link.name] = {
            "angle": _numbers(motion.angle(link.name)),
            "omega": _numbers(motion.omega(link.name)),
            "alpha": _numbers(motion.alpha(link.name)),
        }
    for point, name in listed_points(scene, motion.slides):
        at = motion.point(point, name)
        columns["points"][f"{point}@{name}"] = {
            "position": _pairs(at.z / metres),
            "velocity": _pairs(at.v / metres),
            "acceleration": _pairs(at.a / metres),
        }
    for pair in motion.slides:
        travel, velocity, acceleration, coriolis = motion.slide(pair.key)
        columns["slides"][pair.key] = {
            "travel": _numbers(travel / metres),
            "velocity": _numbers(velocity / metres),
            "acceleration": _numbers(acceleration / metres),
            "coriolis": _pairs(coriolis / metres),
        }
    positions: list[dict[str, Any]] = []
    for k in range(n):
        driver = {
            d.key: float(motion.values[k, i]) / (metres if isinstance(d, SlideDriver) else 1.0)
            for i, d in enumerate(scene.drivers)
        }
        entry: dict[str, Any] = {"driver": driver, "status": str(motion.status[k])}
        if motion.status[k] != "ok":
            positions.append({**entry, "why": motion.why[k]})
            continue
        for part, table in columns.items():
            entry[part] = {key: {what: values[k] for what, values in row.items()} for key, row in table.items()}
        entry["error_bound"] = _bounds(motion, k)
        positions.append(entry)
    groups = [_group(g, words) for g, words in zip(motion.structure.groups, motion.assembly, strict=True)]
    return {
        "title": scene.title,
        "units": {"length": scene.units.length, "time": "s", "angle": "rad"},
        "mobility": motion.structure.mobility.value,
        "groups": groups,
        "positions": positions,
    }


def _bounds(motion: Motion, k: int) -> dict[str, Any]:
    metres = motion.scene.units.metres
    moving, turning = motion.bound.of_point, motion.bound.of_turning
    found: dict[str, Any] = {
        name: float(b[k]) / metres if np.isfinite(b[k]) else None
        for name, b in zip(("position", "velocity", "acceleration"), moving, strict=True)
    }
    for name, b in zip(("angle", "omega", "alpha"), turning, strict=True):
        found[name] = float(b[k]) if np.isfinite(b[k]) else None
    if None in found.values():
        found["why"] = "the worst case of rounding, multiplied along so many groups, says nothing"
    return found


def _group(group: Dyad | Cluster, words: str) -> dict[str, Any]:
    order = group.order if isinstance(group, Cluster) else 2
    return {"class": order, "kind": group.kind, "links": list(group.links), "assembly": words}


def _numbers(values: Array) -> list[float]:
    return [float(x) for x in values]


def _pairs(values: Array) -> list[list[float]]:
    return [[float(z.real), float(z.imag)] for z in values]
