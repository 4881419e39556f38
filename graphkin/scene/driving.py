"""What drives the mechanism of a file: an angle or a travel, its rates, or the law by which it moves over the time.

With ``from = "dead point"`` a driver's angle or travel is the distance from a dead point of the mechanism, given
without loss however small it is: positive beyond a dead point at which the motion begins (as the driver's value grows),
negative before one where it ends; at a change point, through which the motion goes on, either.  ``near`` (degrees, or
travel) tells which one is meant where there are several.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from graphkin.errors import Problem, did_you_mean
from graphkin.scene.model import FromDeadPoint, PinInSlot, SlidingPair
from graphkin.scene.motion_law import MotionLaw, law_of
from graphkin.scene.names import Flaws, Names
from graphkin.scene.tables import SMALLEST, DrivenSlide, Driver, SceneTables

__all__ = ["DriverEntry", "drives"]


@dataclass(frozen=True)
class DriverEntry:
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
    position: str = ""
    rpm: float | None = None
    given_speed: tuple[str, float] | None = None
    law: MotionLaw | None = None


def drives(
    file: SceneTables,
    names: Names,
    flaws: Flaws,
    slidings: tuple[SlidingPair, ...],
    pins: tuple[PinInSlot, ...],
    metres: float,
    problems: list[Problem],
) -> tuple[DriverEntry, ...]:
    """The drivers of the file; what is wrong with them is added to ``problems``."""
    found: list[DriverEntry] = []
    several = isinstance(file.driver, list)
    for i, table in enumerate(file.drivers):
        where = f"driver.{i + 1}" if several else "driver"
        lost = {str(p[-1]) for p in flaws.paths if p[0] == "driver" and (not several or p[1:2] == (i,))}
        if isinstance(table, Driver):
            reasons = [*_angle_problems(where, table, file, names, lost), *_position_problems(where, i, table, file)]
            key, base = table.link, table.relative_to or names.frame
        else:
            reasons, key = _slide_problems(where, table, file, names, slidings, pins, lost)
            base = ""
        law, by_law = _law(where, table, metres)
        reasons += by_law
        reasons += _origin_problems(where, table, file)
        reasons += _driven_twice(where, key, base, found)
        reasons += _too_slow(where, table)
        problems += reasons
        if reasons or lost & {"angle", "travel", "law", "time"}:
            continue
        if isinstance(table, Driver):
            sign = -1.0 if table.sense == "clockwise" else 1.0
            omega = sign * (table.omega if table.omega is not None else (table.rpm or 0.0) * math.pi / 30)
            angle = None if table.angle is None else math.radians(table.angle)
            unit = math.pi / 180
            dead = _from_dead_point(table, angle, unit)
            named = "" if table.position is None else str(table.position)
            rpm = None if table.rpm is None else sign * table.rpm
            alpha = sign * table.alpha + 0.0
            speed = None
            if table.speed is not None and table.of is not None:
                speed = table.of, sign * table.speed * file.units.rates.metres
            if law is not None and table.time is not None:
                angle = law.at(law.time).lift
            found.append(DriverEntry(where, key, base, angle, omega + 0.0, alpha, dead, named, rpm, speed, law))
        else:
            travel = None if table.travel is None else table.travel * metres
            dead = _from_dead_point(table, travel, metres)
            fast = file.units.rates.metres
            rate, second = (table.velocity or 0.0) * fast, table.acceleration * fast
            if law is not None and table.time is not None:
                travel = law.at(law.time).lift
            found.append(DriverEntry(where, key, base, travel, rate, second, dead, law=law))
    return tuple(found)


def _law(where: str, table: Driver | DrivenSlide, metres: float) -> tuple[MotionLaw | None, list[Problem]]:
    """How a driver moves over the time, at the moment that the file asks; and what is wrong with it."""
    problems: list[Problem] = []
    given = {key: getattr(table, key, None) for key in ("angle", "travel", "omega", "rpm", "speed", "velocity")}
    given |= {key: getattr(table, key, 0.0) or None for key in ("alpha", "acceleration")}
    given |= {key: getattr(table, key, None) for key in ("sense", "position")} | {"from": table.origin}
    if table.law is None:
        if table.time is not None:
            problems.append(Problem(f"{where}.time", "tells the moment of a law", "write law = ... with it"))
        return None, problems
    value = "angle" if isinstance(table, Driver) else "travel"
    for key, there in given.items():
        if there is not None and key != value:
            problems.append(Problem(f"{where}.{key}", "stands beside law", "the law gives it; leave one of them out"))
    if table.time is not None and given[value] is not None:
        problems.append(Problem(f"{where}.time", f"stands beside {value}", "write one of the two"))
    law = law_of(f"{where}.law", table.law, math.pi / 180 if value == "angle" else metres, problems)
    if law is not None and table.time is not None:
        if not law.pieces[0].start <= table.time <= law.duration:
            found, wanted = f"found {table.time:g}", f"the law goes from {law.pieces[0].start:g} to {law.duration:g} s"
            problems.append(Problem(f"{where}.time", found, wanted))
        law = replace(law, time=table.time)
    return law, problems


def _too_slow(where: str, table: Driver | DrivenSlide) -> Iterator[Problem]:
    for key in ("omega", "rpm", "speed", "alpha", "velocity", "acceleration"):
        rate = getattr(table, key, None)
        if rate and abs(rate) < SMALLEST:
            yield Problem(f"{where}.{key}", f"found {rate:g}", f"write 0, or at least {SMALLEST:g}")


def _from_dead_point(
    table: Driver | DrivenSlide, value: float | None, unit: float
) -> FromDeadPoint | None:
    if table.origin is None or value is None:
        return None
    return FromDeadPoint(value, None if table.near is None else table.near * unit)


def _origin_problems(
    where: str, table: Driver | DrivenSlide, file: SceneTables
) -> Iterator[Problem]:
    value = table.angle if isinstance(table, Driver) else table.travel
    what = "angle" if isinstance(table, Driver) else "travel"
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
    where: str, table: Driver, file: SceneTables, names: Names, lost: set[str]
) -> Iterator[Problem]:
    moving = ", ".join(list(file.links)[:12])
    for key, name in (("link", table.link), ("relative_to", table.relative_to)):
        if name is None:
            continue
        missing = names.no_link(f"{where}.{key}", name, moving=key == "link")
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
    for other, rate in (("omega", table.omega), ("rpm", table.rpm)):
        if table.speed is not None and rate is not None:
            yield Problem(f"{where}.speed", f"found speed = {table.speed:g} and {other} = {rate:g}",
                          "write one of the two")
    if table.speed is not None and table.of is None and "of" not in lost:
        yield Problem(f"{where}.of", "is missing", 'write of = "B", the point whose speed it is')
    if table.of is not None:
        if table.speed is None and "speed" not in lost:
            yield Problem(f"{where}.of", "names a point whose speed is not given", "write speed = ..., or leave it out")
        moving_points = [p for n, own in names.points.items() if n != names.frame for p in own]
        if table.of not in moving_points and not names.unsure:
            wanted = did_you_mean(table.of, moving_points)
            yield Problem(f"{where}.of", f"no moving link has a point {table.of}", wanted)
        if len(file.drivers) > 1:
            yield Problem(f"{where}.speed", "the speed of a point tells the rate of a single driver only",
                          "give omega")
    for key, rate in (("omega", table.omega), ("rpm", table.rpm), ("speed", table.speed)):
        if table.sense is not None and rate is not None and rate < 0:
            yield Problem(f"{where}.{key}", f"found {rate:g} beside the sense {table.sense}",
                          "with sense write the size, or leave sense out")
    told = table.omega, table.rpm, table.speed, table.law
    if all(one is None for one in told) and not lost & {"omega", "rpm", "speed", "law"}:
        yield Problem(f"{where}.omega", "is missing", "write omega = ... in rad/s or rpm = ...; it may be 0")


def _position_problems(where: str, i: int, table: Driver, file: SceneTables) -> Iterator[Problem]:
    if table.position is None:
        return
    known = [str(k) for k in range(1, ((file.positions and file.positions.count) or 0) + 1)]
    known += list(file.positions.also) if file.positions else []
    if i > 0:
        yield Problem(f"{where}.position", "positions are those of the first driver", "give the angle")
    elif str(table.position) not in known:
        wanted = did_you_mean(str(table.position), known) if known else "name it in [positions]"
        yield Problem(f"{where}.position", f'there is no position "{table.position}"', wanted)
    elif file.positions and file.positions.first is None and str(table.position) not in file.positions.also:
        wanted = "write positions.first, or the angle"
        yield Problem(f"{where}.position", "the numbered positions count from the driver's own value", wanted)
    if table.angle is not None:
        yield Problem(f"{where}.position", f"found angle = {table.angle:g} too", "write one of the two")
    if table.origin is not None or file.drawn:
        yield Problem(f"{where}.position", "what gives the driver's value stands here twice", "leave one of them out")


def _slide_problems(
    where: str,
    table: DrivenSlide,
    file: SceneTables,
    names: Names,
    slidings: tuple[SlidingPair, ...],
    pins: tuple[PinInSlot, ...],
    lost: set[str],
) -> tuple[list[Problem], str]:
    problems: list[Problem] = []
    if table.velocity is None and table.law is None and not lost & {"velocity", "law"}:
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


def _driven_twice(where: str, key: str, base: str, found: list[DriverEntry]) -> list[Problem]:
    for other in found:
        if other.key == key:
            what = f"link {key}" if base else key
            hint = f'write the second as link = "{base}", relative_to = "{key}"' if base != other.base else ""
            return [Problem(where, f"{what} is driven by {other.where} already", hint or "leave one of them out")]
        if base and {key, base} == {other.key, other.base}:
            return [Problem(where, f"the angle between links {key} and {base} is driven by {other.where} already",
                            "leave one of them out")]
    return []
