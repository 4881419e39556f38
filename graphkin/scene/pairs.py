"""What joins and moves the links of a file: sliding pairs, pins in slots, and drivers; whether every link is held.

With ``from = "dead point"`` a driver's angle or travel is the distance from a dead point of the mechanism, given
without loss however small it is: positive beyond a dead point at which the motion begins (as the driver's value grows),
negative before one where it ends; at a change point, through which the motion goes on, either.  ``near`` (degrees, or
travel) tells which one is meant where there are several.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import get_close_matches

from graphkin.errors import Problem, did_you_mean
from graphkin.plane import direction
from graphkin.scene.model import FromDeadPoint, PinInSlot, SlidingPair
from graphkin.scene.names import Flaws, Names
from graphkin.scene.tables import SMALLEST, DrivenSlide, Driver, Link, SceneTables
from graphkin.scene.touching import touching_links

__all__ = ["DriverEntry", "drives", "islands", "pins_in_slots", "sliding_pairs"]


def _as_list(refs: str | Sequence[str]) -> list[str]:
    return [refs] if isinstance(refs, str) else list(refs)


def sliding_pairs(file: SceneTables, names: Names, flaws: Flaws, problems: list[Problem]) -> tuple[SlidingPair, ...]:
    """The sliding pairs of the file; what is wrong with them is added to ``problems``."""
    pairs: list[SlidingPair] = []
    for name, link in file.links.items():
        if link.on is None:
            if link.angle_on is not None and name not in names.unsure and not flaws.under("links", name, "on"):
                problems.append(Problem(f"links.{name}.angle_on", "stands without on", "say what the link slides on"))
            continue
        refs = _as_list(link.on)
        angles = _angles(name, link, len(refs), problems)
        for ref, angle in zip(refs, angles, strict=True):
            on, _, guide = ref.partition(".")
            problem = names.no_guide(f"links.{name}.on", ref) or _sliding_problem(name, on, link, names, pairs)
            if problem:
                problems.append(problem)
                continue
            pairs.append(SlidingPair(name, on, guide, direction(angle), link.points[0] if link.points else None))
    return tuple(pairs)


def _angles(name: str, link: Link, guides: int, problems: list[Problem]) -> list[float]:
    if link.angle_on is None:
        return [0.0] * guides
    angles = [link.angle_on] if isinstance(link.angle_on, int | float) else list(link.angle_on)
    if len(angles) != guides:
        problems.append(
            Problem(
                f"links.{name}.angle_on", f"found {len(angles)} for {guides} guides", "write one number for each guide"
            )
        )
        return [0.0] * guides
    return angles


def _sliding_problem(name: str, on: str, link: Link, names: Names, pairs: list[SlidingPair]) -> Problem | None:
    where = f"links.{name}.on"
    if on == name:
        return Problem(where, f"link {name} slides on itself", "name the link that guides it")
    if any({p.link, p.on} == {name, on} for p in pairs):
        return Problem(
            where, f"link {name} already has a sliding pair with link {on}", "two links have one sliding pair at most"
        )
    if link.points and link.points[0] in names.points.get(on, ()):
        return Problem(
            where,
            f"{link.points[0]} is a point of link {on} too, which pins the two together",
            f"take {link.points[0]} away from one of them, or do not let link {name} slide",
        )
    return None


def pins_in_slots(
    file: SceneTables, names: Names, slidings: tuple[SlidingPair, ...], problems: list[Problem]
) -> tuple[PinInSlot, ...]:
    """The pins in slots of the file; what is wrong with them is added to ``problems``."""
    pins: list[PinInSlot] = []
    for point, pin in file.pins.items():
        where = f"pins.{point}"
        problem = names.no_link(f"{where}.of", pin.of) or names.no_point_of(f"{where}.of", pin.of, point)
        if problem:
            problems.append(problem)
        for ref in _as_list(pin.slots):
            on, _, guide = ref.partition(".")
            found = names.no_guide(f"{where}.in", ref)
            if not found and on == pin.of:
                found = Problem(
                    f"{where}.in", f"{ref} is a guide of link {on} itself", "name the guide of another link"
                )
            if not found and any(p.point == point and p.on == on for p in pins):
                found = Problem(
                    f"{where}.in", f"{point} runs twice in link {on}", f"one slot of link {on}, or a turning pair"
                )
            if not found and point in names.points.get(on, ()):
                found = Problem(
                    f"{where}.in",
                    f"{point} is also a point of link {on}, which is a turning pair",
                    f"take {point} away from link {on}, or the pin away",
                )
            if not found and any(s.key == f"{point}/{on}" for s in slidings):
                found = Problem(where, f"{point}/{on} is also the name of a sliding pair", f"rename link {point}")
            if found:
                problems.append(found)
            elif not problem:
                pins.append(PinInSlot(point, pin.of, on, guide))
    return tuple(pins)


def islands(file: SceneTables, names: Names) -> list[tuple[str, ...]]:
    """The sets of links that no chain of joints connects with the frame, in the order of the file.

    A link that does not exist is taken for the one with the nearest name; empty where there is none near, since it
    may stand for the one that seems unheld.
    """
    slides = [(name, ref.partition(".")[0]) for name, link in file.links.items() for ref in _as_list(link.on or [])]
    slides += [(pin.of, ref.partition(".")[0]) for pin in file.pins.values() for ref in _as_list(pin.slots)]
    slides += touching_links(file)
    meant = {n: n if n in names.points else "".join(get_close_matches(n, names.points, n=1)) for p in slides for n in p}
    if "" in meant.values():
        return []
    near: dict[str, set[str]] = {name: set() for name in names.points}
    holders: dict[str, list[str]] = {}
    for name, points in names.points.items():
        for point in points:
            holders.setdefault(point, []).append(name)
    joined = [(a, b) for held in holders.values() for a in held for b in held if a != b]
    for a, b in (*joined, *((meant[a], meant[b]) for a, b in slides)):
        near[a].add(b)
        near[b].add(a)
    apart: list[tuple[str, ...]] = []
    seen: set[str] = set()
    for start in (names.frame, *names.points):
        if start in seen:
            continue
        reached, todo = {start}, [start]
        while todo:
            new = near[todo.pop()] - reached
            reached |= new
            todo += new
        seen |= reached
        if start != names.frame:
            apart.append(tuple(n for n in names.points if n in reached))
    return apart


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
        reasons += _origin_problems(where, table, file)
        reasons += _driven_twice(where, key, base, found)
        reasons += _too_slow(where, table)
        problems += reasons
        if reasons or lost & {"angle", "travel"}:
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
            found.append(DriverEntry(where, key, base, angle, omega + 0.0, alpha, dead, named, rpm, speed))
        else:
            travel = None if table.travel is None else table.travel * metres
            dead = _from_dead_point(table, travel, metres)
            fast = file.units.rates.metres
            rate, second = (table.velocity or 0.0) * fast, table.acceleration * fast
            found.append(DriverEntry(where, key, base, travel, rate, second, dead))
    return tuple(found)


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
    if table.omega is None and table.rpm is None and table.speed is None and not lost & {"omega", "rpm", "speed"}:
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
