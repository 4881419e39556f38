"""Which link or sliding pair a driver drives, and how fast.

With ``from = "dead point"`` the angle or travel is the distance from a dead point of the mechanism, given without loss
however small it is: positive beyond a dead point at which the motion begins (as the driver's value grows), negative
before one where it ends; at a change point, through which the motion goes on, either.  ``near`` (degrees, or travel)
tells which one is meant where there are several.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from graphkin.errors import Problem, did_you_mean
from graphkin.scene.file import SMALLEST, AngleDriverTable, SceneFile, SlideDriverTable
from graphkin.scene.model import FromDeadPoint, PinInSlot, SlidingPair
from graphkin.scene.names import Names
from graphkin.scene.reading import Flaws

__all__ = ["Drive", "drives"]


@dataclass(frozen=True)
class Drive:
    """A driver whose names are known to exist; ``value`` is None where it is to be taken from the drawn points.

    ``key`` is the driven link, or the sliding pair; ``base`` is the link that an angle is measured from, "" for a
    sliding pair.  ``value``, ``rate`` and ``second`` are in SI.
    """

    where: str
    key: str
    base: str
    value: float | None
    rate: float
    second: float
    dead_point: FromDeadPoint | None = None


def drives(
    file: SceneFile,
    names: Names,
    flaws: Flaws,
    slidings: tuple[SlidingPair, ...],
    pins: tuple[PinInSlot, ...],
    metres: float,
    problems: list[Problem],
) -> tuple[Drive, ...]:
    """The drivers of the file; what is wrong with them is added to ``problems``."""
    found: list[Drive] = []
    several = isinstance(file.driver, list)
    for i, table in enumerate(file.drivers):
        where = f"driver.{i + 1}" if several else "driver"
        lost = {str(p[-1]) for p in flaws.paths if p[0] == "driver" and (not several or p[1:2] == (i,))}
        if isinstance(table, AngleDriverTable):
            reasons = list(_angle_problems(where, table, file, names, lost))
            key, base = table.link, table.relative_to or names.frame
        else:
            reasons, key = _slide_problems(where, table, file, names, slidings, pins, lost)
            base = ""
        reasons += _origin_problems(where, table, file)
        reasons += _driven_twice(where, key, base, found)
        reasons += _too_slow(where, table)
        problems += reasons
        if reasons or lost & {"angle", "travel"}:
            continue
        if isinstance(table, AngleDriverTable):
            omega = table.omega if table.omega is not None else (table.rpm or 0.0) * math.pi / 30
            angle = None if table.angle is None else math.radians(table.angle)
            unit = math.pi / 180
            found.append(Drive(where, key, base, angle, omega, table.alpha, _from_dead_point(table, angle, unit)))
        else:
            travel = None if table.travel is None else table.travel * metres
            dead = _from_dead_point(table, travel, metres)
            rate, second = (table.velocity or 0.0) * metres, table.acceleration * metres
            found.append(Drive(where, key, base, travel, rate, second, dead))
    return tuple(found)


def _too_slow(where: str, table: AngleDriverTable | SlideDriverTable) -> Iterator[Problem]:
    for key in ("omega", "rpm", "alpha", "velocity", "acceleration"):
        rate = getattr(table, key, None)
        if rate and abs(rate) < SMALLEST:
            yield Problem(f"{where}.{key}", f"found {rate:g}", f"write 0, or at least {SMALLEST:g}")


def _from_dead_point(
    table: AngleDriverTable | SlideDriverTable, value: float | None, unit: float
) -> FromDeadPoint | None:
    if table.origin is None or value is None:
        return None
    return FromDeadPoint(value, None if table.near is None else table.near * unit)


def _origin_problems(
    where: str, table: AngleDriverTable | SlideDriverTable, file: SceneFile
) -> Iterator[Problem]:
    value = table.angle if isinstance(table, AngleDriverTable) else table.travel
    what = "angle" if isinstance(table, AngleDriverTable) else "travel"
    if table.origin is None:
        if table.near is not None:
            yield Problem(f"{where}.near", "tells which dead point", 'write from = "dead point" with it')
        return
    if value is None or value == 0.0:
        yield Problem(f"{where}.{what}", "is missing" if value is None else "0 is the dead point itself",
                      "write the distance from the dead point")
    if len(file.drivers) > 1:
        yield Problem(f"{where}.from", "a dead point is found for a single driver only", "give the value itself")
    if file.drawn:
        yield Problem(f"{where}.from", "with [drawn] the value of the driver follows from the points",
                      "leave one of the two out")


def _angle_problems(
    where: str, table: AngleDriverTable, file: SceneFile, names: Names, lost: set[str]
) -> Iterator[Problem]:
    moving = ", ".join(list(file.links)[:12])
    for key, name in (("link", table.link), ("relative_to", table.relative_to)):
        if name is None:
            continue
        missing = names.no_link(f"{where}.{key}", name)
        if missing:
            yield missing
        elif name in file.links and file.links[name].redundant:
            yield Problem(f"{where}.{key}", f"link {name} is redundant", "drive by a link that counts")
    if table.link == names.frame and table.link not in file.links:
        yield Problem(f"{where}.link", f"link {table.link} is the frame", f"drive a moving link: {moving}")
    if table.relative_to == table.link:
        yield Problem(f"{where}.relative_to", f"link {table.link} is driven relative to itself",
                      "name another link, or leave it out for the frame")
    if table.omega is not None and table.rpm is not None:
        yield Problem(f"{where}.omega", f"found omega = {table.omega:g} and rpm = {table.rpm:g}",
                      "write one of the two")
    if table.omega is None and table.rpm is None and not lost & {"omega", "rpm"}:
        yield Problem(f"{where}.omega", "is missing", "write omega = ... in rad/s or rpm = ...; it may be 0")


def _slide_problems(
    where: str,
    table: SlideDriverTable,
    file: SceneFile,
    names: Names,
    slidings: tuple[SlidingPair, ...],
    pins: tuple[PinInSlot, ...],
    lost: set[str],
) -> tuple[list[Problem], str]:
    problems: list[Problem] = []
    if table.velocity is None and "velocity" not in lost:
        problems.append(Problem(f"{where}.velocity", "is missing", "write velocity = ... per second; it may be 0"))
    what, _, on = table.slide.partition("/")
    pairs = {p.key: p.on for p in slidings if p.link == what} or {p.key: p.on for p in pins if p.point == what}
    keys = [key for key, rail in pairs.items() if rail in (on or rail, ) and rail == (table.relative_to or rail)]
    known = [p.key for p in slidings] + [p.key for p in pins]
    if "" in names.unsure or (what in file.links and file.links[what].on is not None and not pairs):
        return problems, keys[0] if len(keys) == 1 else table.slide  # its pair has a problem of its own
    if not pairs and what not in names.points:
        problems.append(Problem(f"{where}.slide", f'there is no sliding link "{what}"', did_you_mean(what, known)))
    elif not pairs:
        problems.append(Problem(f"{where}.slide", f"link {what} slides on nothing",
                                "drive a sliding pair: " + ", ".join(known) if known else "there is no sliding pair"))
    elif not keys:
        key, name = ("slide", on) if on and on not in pairs.values() else ("relative_to", table.relative_to)
        problems.append(Problem(f"{where}.{key}", f"{what} does not slide on link {name}",
                                "it may be " + " or ".join(pairs)))
    elif len(keys) > 1:
        problems.append(Problem(f"{where}.slide", f"{what} slides on {len(keys)} links",
                                "write " + " or ".join(f'"{key}"' for key in keys)))
    if what in file.links and file.links[what].redundant:
        problems.append(Problem(f"{where}.slide", f"link {what} is redundant", "drive by a link that counts"))
    return problems, keys[0] if len(keys) == 1 else table.slide


def _driven_twice(where: str, key: str, base: str, found: list[Drive]) -> list[Problem]:
    for other in found:
        if other.key == key:
            what = f"link {key}" if base else key
            hint = f'write the second as link = "{base}", relative_to = "{key}"' if base != other.base else ""
            return [Problem(where, f"{what} is driven by {other.where} already", hint or "leave one of them out")]
        if base and {key, base} == {other.key, other.base}:
            return [Problem(where, f"the angle between links {key} and {base} is driven by {other.where} already",
                            "leave one of them out")]
    return []
