"""Numbers of a scene file that must fit each other when they vary: teeth that mesh, discs that roll, pieces of a cam's
law, a driver's law and the moment asked."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

from graphkin.files import OwnTables, Tables
from graphkin.scene import mechanism_of
from graphkin.scene.contacts import PlacedContact, PlacedGear
from graphkin.scene.file_keys import KeyPath
from graphkin.scene.model import Mechanism

__all__ = ["fitted", "fitting_keys"]


LEAST_TEETH = 8
EARLY = 0.15  # part of a driver's law at its beginning and at its end that no problem asks for
LEAST_PIECE = 10.0  # degrees of a cam
ALIKE = 1e-6


def fitting_keys(source: Tables) -> Iterator[tuple[KeyPath, str]]:
    """The numbers of discs, wheels, cams and driver laws that vary: radii ("length"), "teeth", the ends of a cam's
    pieces ("end"), its rises ("length"), the end, duration and moment of a driver's law ("length", "rate", "moment").

    Falls follow the rises, lengths of carriers their wheels.
    """
    owners: list[tuple[KeyPath, Tables]] = [(("frame",), source.get("frame", {}))]
    owners += [(("links", name), link) for name, link in source.get("links", {}).items()]
    for where, owner in owners:
        for name, disc in owner.get("discs", {}).items():
            if disc.get("r"):
                yield (*where, "discs", name, "r"), "length"
    for name, gear in source.get("gears", {}).items():
        if all(isinstance(z, int | float) for z in gear.get("teeth", ["rack"])):
            yield from ((("gears", name, "teeth", i), "teeth") for i in (0, 1))
    for name, cam in source.get("cams", {}).items():
        law = cam.get("law", ())
        yield from ((("cams", name, "law", i, "to"), "end") for i in range(len(law) - 1))
        yield from ((("cams", name, "law", i, "rise"), "length") for i, piece in enumerate(law) if piece.get("rise"))
        if cam.get("roller"):
            yield ("cams", name, "roller"), "length"
    drivers = source.get("driver", [])
    several = isinstance(drivers, list)
    for i, driver in enumerate(drivers if several else [drivers]):
        path: KeyPath = ("driver", i) if several else ("driver",)
        law = driver.get("law", {})
        if law.get("duration"):
            yield (*path, "law", "duration"), "rate"
            if law.get("to"):
                yield (*path, "law", "to"), "length"
            if driver.get("time"):
                yield (*path, "time"), "moment"


def fitted(source: Tables, made: OwnTables, free: Callable[[KeyPath], bool]) -> None:
    """Make the numbers of a candidate fit each other; those that cannot are put back as they were.

    Parameters
    ----------
    free : whether a number may follow others
    """
    for name, cam in made.get("cams", {}).items():
        _cam(source["cams"][name], cam)
    drivers = made.get("driver", [])
    for driver in drivers if isinstance(drivers, list) else [drivers]:
        if driver.get("law", {}).get("duration"):
            _moment(driver, driver["law"])
    rolling = any(contact.get("rolling") for contact in made.get("contacts", {}).values())
    for name, link in made.get("links", {}).items():
        _rims(source["links"][name], link)
    if made.get("gears") or rolling:
        scene = mechanism_of(source)
        if not _teeth(scene, made, free):
            for name, gear in made.get("gears", {}).items():
                gear["teeth"] = list(source["gears"][name]["teeth"])
        if not _radii(scene, made, free):
            for where in ("frame", "links"):
                _put_back(source.get(where, {}), made.get(where, {}))


def _cam(was: Tables, cam: OwnTables) -> None:
    """Pieces one after the other, that come back to where they began."""
    law, old = cam["law"], was["law"]
    ends = [0.0, *(float(piece["to"]) for piece in law)]
    if any(b - a < LEAST_PIECE for a, b in pairwise(ends)):
        for piece, before in zip(law, old, strict=True):
            piece["to"] = before["to"]
    up, down = (sum(piece.get(key) or 0.0 for piece in law) for key in ("rise", "fall"))
    falls = [piece for piece in law if piece.get("fall")]
    for piece in falls:
        piece["fall"] = float(f"{piece['fall'] * up / down:.9g}")
    if falls:
        falls[-1]["fall"] = float(f"{up - sum(piece['fall'] for piece in falls[:-1]):.12g}")


def _moment(driver: OwnTables, law: Tables) -> None:
    """A moment, or an angle, well within what a law goes through."""
    if driver.get("time"):
        within = min(max(driver["time"] / law["duration"], EARLY), 1.0 - EARLY)
        driver["time"] = float(f"{within * law['duration']:.3g}")
    elif driver.get("angle") is not None and law.get("to") is not None:
        begin, end = law.get("from", 0.0), law["to"]
        within = EARLY + (1.0 - 2.0 * EARLY) * (driver["angle"] % 360.0) / 360.0
        driver["angle"] = float(round(begin + within * (end - begin)))


def _rims(was: Tables, link: OwnTables) -> None:
    """A bar that ends on the rim of a disc goes on doing so."""
    points = link.get("points", ())
    for name, disc in link.get("discs", {}).items():
        if disc.get("centre") in points and len(points) == 2 and was.get("length") == was["discs"][name].get("r"):
            disc["r"] = link["length"]


def _axle_key(made: Tables, carrier: str, axes: tuple[str, str]) -> KeyPath | None:
    """Where the distance of two axes stands as the length of their carrier."""
    link = made.get("links", {}).get(carrier, {})
    return ("links", carrier, "length") if set(link.get("points", ())) == set(axes) and "length" in link else None


def _teeth(scene: Mechanism, made: OwnTables, free: Callable[[KeyPath], bool]) -> bool:
    """Wheels that mesh with several others keep one pitch circle: of wheels about the same two axes the last number of
    teeth follows, else the distance of the axes.  False where neither can."""
    meshes: list[tuple[PlacedGear, list[int]]] = []
    modules: dict[tuple[str, int], float] = {}  # distance of the axes for a tooth, by link and teeth before
    numbers = {  # those that somebody has ranged or kept hold for the whole wheel
        (link, abs(int(z or 0))): abs(int(made["gears"][gear.name]["teeth"][i]))
        for gear in scene.gears if not gear.is_rack
        for i, (link, z) in enumerate(zip(gear.wheels, gear.teeth, strict=True))
        if not free(("gears", gear.name, "teeth", i))
    }  # fmt: skip
    for gear in scene.gears:
        if gear.is_rack:
            continue
        old = [int(z or 0) for z in gear.teeth]
        wheels = [(link, abs(z)) for link, z in zip(gear.wheels, old, strict=True)]  # one has one number of teeth
        drawn = [int(z) for z in made["gears"][gear.name]["teeth"]]
        teeth = [int(math.copysign(numbers.get(w, abs(z)), z)) for w, z in zip(wheels, drawn, strict=True)]
        here = _axle_key(made, gear.carrier, gear.axes)
        known = next((i for i, wheel in enumerate(wheels) if wheel in modules), None)
        if known is not None:
            twin = next((t for g, t in meshes if g.carrier == gear.carrier and set(g.axes) == set(gear.axes)), None)
            if twin is not None:
                total = abs(sum(twin))
                teeth[1 - known] = int(math.copysign(total, sum(old))) - teeth[known]
            elif here is not None and free(here):
                made["links"][gear.carrier]["length"] = float(f"{modules[wheels[known]] * abs(sum(teeth)):.6g}")
            elif teeth != old:
                return False
        if any(abs(t) < LEAST_TEETH or t * z < 0 for t, z in zip(teeth, old, strict=True)) or not sum(teeth):
            return False
        if (sum(teeth) > 0) != (sum(old) > 0):
            return False
        length = made["links"][gear.carrier]["length"] if here is not None else 1.0
        for wheel, z in zip(wheels, teeth, strict=True):
            modules.setdefault(wheel, length / abs(sum(teeth)))
            numbers.setdefault(wheel, abs(z))
        meshes.append((gear, teeth))
        made["gears"][gear.name]["teeth"] = teeth
    return True


def _radii(scene: Mechanism, made: OwnTables, free: Callable[[KeyPath], bool]) -> bool:
    """Discs that roll on each other stand as far apart as their radii say.  False where they cannot."""
    for contact in scene.contacts:
        if not contact.rolling:
            continue
        if contact.flat:
            if not _on_its_face(made, contact):
                return False
            continue
        one, two = made["contacts"][contact.name]["between"]
        radii = [_disc(made, ref) for ref in (one, two)]
        signs = [math.copysign(1.0, disc.radius) for disc in contact.round]
        centres = (contact.round[0].centre, contact.round[1].centre)
        here = _axle_key(made, contact.carrier, centres)
        if here is None or not free(here):
            return False
        total = sum(sign * abs(r) for sign, r in zip(signs, radii, strict=True))
        if abs(total) <= ALIKE * max(map(abs, radii)):
            return False
        made["links"][contact.carrier]["length"] = float(f"{abs(total):.12g}")
    return True


def _on_its_face(made: OwnTables, contact: PlacedContact) -> bool:
    """A drawn centre of a disc that rolls on a face of the frame goes off it by the radius.  False where it cannot."""
    (disc,) = contact.round
    drawn = made.get("drawn", {}).get(disc.centre)
    if drawn is None:
        return True
    refs = made["contacts"][contact.name]["between"]
    wheel, face = (refs if contact.discs[0] is not None else refs[::-1])
    frame = made.get("frame", {})
    guide = frame.get("guides", {}).get(face.partition(".")[2])
    if guide is None or face.partition(".")[0] != str(frame.get("name", "0")) or not isinstance(guide["through"], list):
        return False
    normal = cmath.rect(1.0 if contact.left else -1.0, math.radians(guide["angle"]) + math.pi / 2)
    through = complex(*guide["through"])
    off = ((complex(*drawn) - through) * normal.conjugate()).real
    place = complex(*drawn) + normal * (abs(_disc(made, wheel)) - off)
    made["drawn"][disc.centre] = [float(f"{part:.12g}") for part in (place.real, place.imag)]
    return True


def _disc(made: Tables, ref: str) -> float:
    link, _, name = ref.partition(".")
    owner = made["links"].get(link, made.get("frame", {}))
    return float(owner["discs"][name]["r"])


def _put_back(was: Any, now: Any) -> None:
    """Radii of discs as they were."""
    if "discs" in now:
        for name, disc in now["discs"].items():
            disc["r"] = was["discs"][name]["r"]
    for name, table in now.items():
        if isinstance(table, dict) and name in was and "discs" in table:
            _put_back(was[name], table)
