"""A point pulled by hand: what it changes in the scene.

A point of the frame moves; a point of the driven link turns it; any other changes the lengths and places of the links
that have it, so that it comes to lie where it is pulled while all others stay.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.errors import CallError, Problem
from graphkin.files import OwnTables, Tables
from graphkin.plane import cross, degrees, dot
from graphkin.scene.model import Driver, Mechanism
from graphkin.solver import Motion
from graphkin.words import Phrase

__all__ = ["Pulled", "movable", "pulled"]


@dataclass(frozen=True)
class Pulled:
    """What a pull changes: entries of the file by key, or the value of a driver in its own unit."""

    changes: Tables
    at: Mapping[str, float]


def movable(scene: Mechanism) -> dict[str, str]:
    """What pulling each point does: it is of the "frame", it turns or shifts the "driver", or it changes "lengths";
    points of which none is true are left out."""
    found = dict.fromkeys(scene.frame.points, "frame")
    for link in scene.links:
        for point in link.points:
            if point not in found and (link.length is not None or point not in link.bar):
                found[point] = "lengths"
    for driver in scene.drivers:
        for point in _driven(scene, driver):
            found[point] = "driver"
    return found


def _driven(scene: Mechanism, driver: Driver) -> list[str]:
    """The points with which a driver is turned or shifted by hand: those of a link about a pivot of the frame, and of
    a link on a guide of the frame."""
    if driver.turns and driver.relative_to == scene.frame.name:
        link = scene.by_name[driver.link]
        if any(p in scene.frame.points for p in link.points):
            return [p for p in link.points if p not in scene.frame.points]
    if not driver.turns:
        slide = next((s for s in scene.slidings if s.key == driver.key), None)
        if slide is not None and slide.on == scene.frame.name:
            return list(scene.by_name[slide.link].points)
    return []


def pulled(raw: Tables, motion: Motion, point: str, to: complex, lengths: bool = False) -> Pulled:
    """Pull a point to a place.

    Parameters
    ----------
    raw : the mapping of the scene's file
    motion : where everything lies now, one position
    to : the place (m)
    lengths : whether a point of a driven link changes its length instead of driving it

    Raises
    ------
    CallError : a point that the scene does not have, or that nothing of the file places
    """
    scene = motion.scene
    kinds = movable(scene)
    if point not in kinds:
        raise CallError(
            Problem(
                Phrase("point", point=point[:60]),
                Phrase("cannot be pulled"),
                Phrase("its place follows from the others"),
            )
        )
    if point in scene.frame.points:
        return Pulled(_of_frame(raw, scene, point, to), {})
    if kinds[point] == "driver" and not lengths:
        return Pulled({}, _driver(motion, point, to))
    changes: OwnTables = {}
    if point in raw.get("drawn", {}):
        return Pulled(_as_drawn(motion, point, to), {})
    to = _on_guide(scene, point, to)
    for link in scene.links:
        if point in link.points:
            changes |= _of_link(raw, motion, link.name, point, to)
    if not changes:
        raise CallError(
            Problem(
                Phrase("point", point=point), Phrase("has no length that could change"), Phrase("pull another point")
            )
        )
    return Pulled(changes, {})


def _as_drawn(motion: Motion, point: str, to: complex) -> OwnTables:
    """The place of a point that the file gives as drawn, which holds at the scene's own position."""
    scene = motion.scene
    own = [driver.values[0] for driver in scene.drivers]
    if any(abs(v - o) > 1e-9 * max(1.0, abs(o)) for v, o in zip(motion.values[0], own, strict=True)):
        raise CallError(Problem(Phrase("point", point=point), Phrase("is given as drawn at the scene's own"),
                                Phrase("go back to that position to pull it")))
    return {f"drawn.{point}": [_length(scene, to.real), _length(scene, to.imag)]}


def _driver(motion: Motion, point: str, to: complex) -> dict[str, float]:
    scene = motion.scene
    for index, driver in enumerate(scene.drivers):
        if point not in _driven(scene, driver):
            continue
        now = complex(motion.position(point)[0])
        if driver.turns:
            pivot = next(p for p in scene.by_name[driver.link].points if p in scene.frame.points)
            centre = scene.frame.points[pivot]
            if abs(to - centre) == 0.0:
                return {}
            turn = math.degrees(cmath.phase((to - centre) / (now - centre)))
            return {driver.key: math.degrees(float(motion.values[0][index])) + turn}
        slide = next(s for s in scene.slidings if s.key == driver.key)
        along = scene.frame.guides[slide.guide].direction
        travel = float(motion.values[0][index]) + dot(to - now, along)
        return {driver.key: travel / scene.units.metres}
    return {}


def _of_frame(raw: Tables, scene: Mechanism, point: str, to: complex) -> OwnTables:
    entry = raw["frame"]["points"][point]
    key = f"frame.points.{point}"
    if not isinstance(entry, Mapping):
        return {key: [_length(scene, to.real), _length(scene, to.imag)]}
    return _from_others(scene, key, entry, scene.frame.points, point, to)


def _from_others(
    scene: Mechanism, key: str, entry: Tables, places: Mapping[str, complex], point: str, to: complex
) -> OwnTables:
    """An entry that places a point from one or two others, so that it lies at a place."""
    if isinstance(entry["from"], str):
        origin = places[entry["from"]]
        return _polar(scene, key, entry, places[point] - origin, to - origin)
    first, second = (places[p] for p in entry["from"])
    side = "left" if cross(second - first, to - first) > 0 else "right"
    return {
        f"{key}.r": [_length(scene, abs(to - first)), _length(scene, abs(to - second))], f"{key}.side": side,
    }  # fmt: skip


def _polar(scene: Mechanism, key: str, entry: Tables, before: complex, now: complex) -> OwnTables:
    if abs(now) == 0.0:
        return {}
    turned = float(entry.get("angle", 0.0)) + degrees(now / before)
    return {f"{key}.r": _length(scene, abs(now)), f"{key}.angle": _angle(turned)}


def _on_guide(scene: Mechanism, point: str, to: complex) -> complex:
    """The foot of a place on the guide of the frame on which the point's block slides."""
    for slide in scene.slidings:
        if slide.on == scene.frame.name and scene.by_name[slide.link].points.get(point) == 0j:
            guide = scene.frame.guides[slide.guide]
            return guide.through + dot(to - guide.through, guide.direction) * guide.direction
    return to


def _of_link(raw: Tables, motion: Motion, name: str, point: str, to: complex) -> OwnTables:
    """What a link's own entries become, so that it has the point at a place with all its others where they are."""
    scene = motion.scene
    link = scene.by_name[name]
    if point in link.bar:
        if link.length is None or len(link.bar) < 2 or "length" not in raw["links"][name]:
            return {}
        other = link.bar[0] if point == link.bar[1] else link.bar[1]
        long = _length(scene, abs(to - complex(motion.position(other, name)[0])))
        return {f"links.{name}.length": long} if long > 0 else {}
    entry = raw["links"][name].get("at", {}).get(point)
    key = f"links.{name}.at.{point}"
    axis = cmath.rect(1.0, float(motion.angle(name)[0]))
    known = next((p for p in link.points if p != point), None)
    if entry is None or known is None:
        return {}
    own = (to - complex(motion.position(known, name)[0])) / axis + link.points[known]
    if not isinstance(entry, Mapping):
        return {key: [_length(scene, own.real), _length(scene, own.imag)]}
    return _from_others(scene, key, entry, link.points, point, own)


def _length(scene: Mechanism, value: float) -> float:
    """A length in the scene's unit, to a few thousandths of the mechanism: what a hand can mean."""
    lengths = [link.length for link in scene.links if link.length] + [abs(z) for z in scene.frame.points.values()]
    size = max(lengths, default=1.0) / scene.units.metres
    return _rounded(value / scene.units.metres, 10.0 ** (math.floor(math.log10(size)) - 3) if size > 0 else 1e-3)


def _angle(value: float) -> float:
    return _rounded(math.remainder(value, 360.0), 0.1)


def _rounded(value: float, step: float) -> float:
    return float(f"{round(value / step) * step:.10g}") + 0.0
