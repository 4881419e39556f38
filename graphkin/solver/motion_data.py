"""A motion as plain data for programs, in the scene's length unit."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice

import numpy as np

from graphkin.errors import Unsolvable
from graphkin.files import Json
from graphkin.files import json_text as one_line
from graphkin.scene.cams import SwingingFollower
from graphkin.scene.model import Mechanism
from graphkin.solver.cams import contact_of
from graphkin.solver.contacts import contact_motion, pitch_point
from graphkin.solver.driver_range import driver_range
from graphkin.solver.flywheel import flywheel_of
from graphkin.solver.forces import Forces
from graphkin.solver.motion import Motion
from graphkin.solver.pose import Array
from graphkin.structure import Cluster, Dyad, Slide
from graphkin.structure.assembly import ChangePoint
from graphkin.words import Phrase, say

__all__ = ["entries", "head", "json_text", "listed_points", "own_slides", "to_json"]

BLOCK = 1024
"""Positions that are made into objects at once."""


def listed_points(scene: Mechanism, slides: Sequence[Slide]) -> tuple[tuple[str, str], ...]:
    """Every point of a moving link, on every link that has it, every coincident point under a sliding pin, and the
    points of both bodies at a contact: (point, link) in the order of the file."""
    found = [(p, link.name) for link in scene.links for p in link.points]
    moving = {link.name for link in scene.links}
    found += [(c.name, link) for c in scene.contacts for link in c.links if link in moving]
    for pair in own_slides(scene, slides):
        if pair.pin and pair.b in moving and (pair.pin, pair.b) not in found:
            found.append((pair.pin, pair.b))
    place = {link.name: i for i, link in enumerate(scene.links)}
    return tuple(sorted(found, key=lambda ref: place[ref[1]]))


def own_slides(scene: Mechanism, slides: Sequence[Slide]) -> tuple[Slide, ...]:
    """The sliding pairs and pins in slots of the scene, and of a contact with a face its disc's centre along it; not
    that of what rolls."""
    blocks = {c.block for c in scene.contacts if c.rolling}
    return tuple(s for s in slides if s.key not in blocks)


def to_json(motion: Motion, forces: Forces | None = None) -> dict[str, Json]:
    """The object that ``solve --json`` prints: numbers in the scene's length unit, seconds, radians; forces, where
    there are any, in its force unit, moments in that times metre."""
    return {**head(motion), "positions": list(entries(motion, forces))}


def json_text(first: Mapping[str, Json], positions: Iterable[Mapping[str, Json]]) -> Iterator[str]:
    """A head and the entries of positions as one object in the text of JSON, with a line feed at its end, piece by
    piece: of a long sweep only some entries are in memory.  What would command a terminal is escaped."""
    yield one_line(first)[:-1] + ', "positions": ['
    between, rest = "", iter(positions)
    while block := list(islice(rest, BLOCK)):
        yield between + one_line(block)[1:-1]
        between = ", "
    yield "]}\n"


def head(motion: Motion) -> dict[str, Json]:
    """What is said of a motion before its positions: title, units, mobility, change points passed, groups."""
    scene = motion.scene
    force = {"force": scene.units.force} if scene.loading else {}
    speed = {"speed": scene.units.speed} if scene.units.speed else {}
    return {
        "title": scene.title,
        "units": {"length": scene.units.length, **speed, "time": "s", "angle": "rad", **force},
        "mobility": motion.structure.mobility.value,
        **({"passed": [_change_point(motion.scene, one) for one in motion.passed]} if motion.passed else {}),
        "groups": [_group(g, words) for g, words in zip(motion.structure.groups, motion.assembly, strict=True)],
    }


def _change_point(scene: Mechanism, one: ChangePoint) -> dict[str, Json]:
    """A change point on the way: the links whose two assemblies meet, and the drivers' values there."""
    values = zip(scene.drivers, one.values, strict=True)
    at = {d.key: v / (scene.units.metres if not d.turns else 1.0) for d, v in values}
    return {"links": list(one.links), "driver": at}


def entries(motion: Motion, forces: Forces | None = None) -> Iterator[dict[str, Json]]:
    """What is said of each position, one after the other; some thousand are made at a time."""
    scene = motion.scene
    metres = scene.units.metres
    flywheel = _flywheel(motion)
    angles = {link.name: motion.angle(link.name) for link in scene.links}
    drivers = {
        d.key: motion.values[:, i] / (metres if not d.turns else 1.0)
        for i, d in enumerate(scene.drivers)
    }
    for first in range(0, len(motion), BLOCK):
        some = slice(first, first + BLOCK)
        columns = _columns(motion.rows(some), {name: angle[some] for name, angle in angles.items()})
        cells = {
            part: {key: {what: _plain(v) for what, v in row.items()} for key, row in table.items()}
            for part, table in columns.items()
        }
        own = {key: v[some].tolist() for key, v in drivers.items()}
        touching = _touching(motion.rows(some)) if scene.contacts or scene.gears else [{}] * BLOCK
        for k, status in enumerate(motion.status[some].tolist()):
            entry: dict[str, Json] = {"driver": {key: v[k] for key, v in own.items()}, "status": status}
            if status != "ok":
                yield {**entry, "why": motion.why[first + k]}
                continue
            for part, table in cells.items():
                entry[part] = {key: {what: v[k] for what, v in row.items()} for key, row in table.items()}
            entry |= touching[k]
            entry["error_bound"] = _bounds(motion, first + k)
            if forces is not None:
                found = _forces(scene, forces, first + k)
                found["moments"] |= flywheel
                entry |= found
            yield entry


def _columns(motion: Motion, angles: Mapping[str, Array]) -> dict[str, dict[str, dict[str, Array]]]:
    """Every number of some positions, in the scene's units."""
    scene = motion.scene
    metres, fast = scene.units.metres, scene.units.rates.metres
    columns: dict[str, dict[str, dict[str, Array]]] = {"links": {}, "points": {}, "slides": {}}
    for name, angle in angles.items():
        columns["links"][name] = {"angle": angle, "omega": motion.omega(name), "alpha": motion.alpha(name)}
    for point, name in listed_points(scene, motion.slides):
        # a pin is the same on each of its links
        at = motion.point(point, "" if point in scene.by_name[name].points else name)
        found = at.z / metres, at.v / fast, at.a / fast
        columns["points"][f"{point}@{name}"] = dict(zip(("position", "velocity", "acceleration"), found, strict=True))
    for pair in own_slides(scene, motion.slides):
        kinds, each = ("travel", "velocity", "acceleration", "coriolis"), (metres, fast, fast, fast)
        values = zip(motion.slide(pair.key), each, strict=True)
        columns["slides"][pair.key] = dict(zip(kinds, (x / per for x, per in values), strict=True))
    for cam in scene.cams:
        turn = motion.poses[cam.link]
        touching = contact_of(cam, np.asarray(turn.u), np.asarray(turn.omega))
        unit = 1.0 if isinstance(cam.motion, SwingingFollower) else metres
        columns.setdefault("cams", {})[cam.link] = {
            "lift": touching.lift / unit, "contact": touching.contact / metres, "normal": touching.normal,
            "slip": touching.slip / fast, "pressure": touching.pressure,
        }  # fmt: skip
    return columns


def _touching(motion: Motion) -> list[dict[str, dict[str, Json]]]:
    """Contacts and gears of each position."""
    scene, metres = motion.scene, motion.scene.units.metres
    found: list[dict[str, dict[str, Json]]] = [{} for _ in range(len(motion))]
    for contact in scene.contacts:
        at = contact_motion(motion, contact)
        kind = "rolling" if contact.rolling else "sliding"
        columns = {"position": at.place / metres, "normal": at.normal, "slip": at.slip / scene.units.rates.metres}
        cells = {what: _plain(column) for what, column in columns.items()}
        for k, entry in enumerate(found):
            pressure = {link: float(angle[k]) for link, angle in at.pressure.items() if np.isfinite(angle[k])}
            own = {"kind": kind, **{what: cell[k] for what, cell in cells.items()}, "pressure": pressure}
            entry.setdefault("contacts", {})[contact.name] = own
    for gear in scene.gears:
        place, radii = pitch_point(motion, gear)
        shown = [None if r is None else r / metres for r in radii]
        for entry, cell in zip(found, _plain(place / metres), strict=True):
            entry.setdefault("gears", {})[gear.name] = {"pitch_point": cell, "radii": shown}
    return found


def _forces(scene: Mechanism, forces: Forces, k: int) -> dict[str, dict[str, Json]]:
    """Forces and moments at one position; a key with + is the value with the loads that begin or end exactly here."""
    found: dict[str, dict[str, Json]] = {"forces": {}, "moments": {}}
    for part, table in (("forces", forces.forces), ("moments", forces.moments)):
        for key, values in table.items():
            here = {key: values[k]}
            if key in forces.beside and not np.isnan(forces.beside[key][k]):
                here[f"{key}+"] = forces.beside[key][k]
            for name, value in here.items():
                shown = value / scene.units.newtons
                plain = [float(shown.real) + 0.0, float(shown.imag) + 0.0]  # no minus before nought
                found[part][name] = plain if part == "forces" else plain[0]
    bound: dict[str, Json] = {}
    for name, b in zip(found, forces.bound, strict=True):
        bound[name] = float(b[k]) / scene.units.newtons
    return {**found, "force_bound": bound}


def _flywheel(motion: Motion) -> dict[str, Json]:
    """Excess work and inertia of the flywheel that the scene asks for, where it has one."""
    units = motion.scene.units
    if motion.scene.loading.flywheel is None or not motion.ok.any():
        return {}
    try:
        found = flywheel_of(driver_range(motion.structure))
    except Unsolvable:
        return {}
    return {"excess_W": found.excess / units.newtons, "J_F": found.inertia / units.inertias}


def _plain(values: Array) -> list[Json]:
    """Numbers, or pairs of numbers for complex ones; no minus before nought."""
    parts = np.stack([values.real, values.imag], axis=1) if np.iscomplexobj(values) else values
    found: list[Json] = (parts + 0.0).tolist()
    return found


def _bounds(motion: Motion, k: int) -> dict[str, Json]:
    metres, fast = motion.scene.units.metres, motion.scene.units.rates.metres
    moving, turning = motion.bound.of_point, motion.bound.of_turning
    found: dict[str, Json] = {
        name: float(b[k]) / per if np.isfinite(b[k]) else None
        for name, b, per in zip(("position", "velocity", "acceleration"), moving, (metres, fast, fast), strict=True)
    }
    for name, b in zip(("angle", "omega", "alpha"), turning, strict=True):
        found[name] = float(b[k]) if np.isfinite(b[k]) else None
    if None in found.values():
        found["why"] = "the worst case of rounding, multiplied along so many groups, says nothing"
    return found


def _group(group: Dyad | Cluster, words: Phrase) -> dict[str, Json]:
    order = group.order if isinstance(group, Cluster) else 2
    return {"class": order, "kind": group.kind, "links": list(group.links), "assembly": say(words)}

