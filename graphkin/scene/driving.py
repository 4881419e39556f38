"""What drives the mechanism of a file: an angle or a travel, its rates, or the law by which it moves over the time.

With ``from = "dead point"`` a driver's angle or travel is the distance from a dead point of the mechanism, given
without loss however small it is: positive beyond a dead point at which the motion begins (as the driver's value grows),
negative before one where it ends; at a change point, through which the motion goes on, either.  ``near`` (degrees, or
travel) tells which one is meant where there are several.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from graphkin.errors import Problem, did_you_mean
from graphkin.scene.model import Driver, FromDeadPoint, PinInSlot, SlidingPair
from graphkin.scene.motion_law import MotionLaw, law_of
from graphkin.scene.names import Flaws, Names
from graphkin.scene.tables import SMALLEST, DrivenSlide, SceneTables
from graphkin.scene.tables import Driver as DrivenAngle
from graphkin.words import Phrase, alternatives

__all__ = ["drives"]


def drives(
    file: SceneTables,
    names: Names,
    flaws: Flaws,
    slidings: tuple[SlidingPair, ...],
    pins: tuple[PinInSlot, ...],
    metres: float,
    problems: list[Problem],
) -> dict[str, Driver]:
    """The drivers of the file by their places in it; what is wrong with them is added to ``problems``.

    The value of one that is to be taken from the drawn points, or from a named position, is not a number.
    """
    found: dict[str, Driver] = {}
    several = isinstance(file.driver, list)
    ends = [*((s.key, s.on) for s in slidings), *((p.key, p.on) for p in pins)]
    for i, table in enumerate(file.drivers):
        where = f"driver.{i + 1}" if several else "driver"
        lost = {str(p[-1]) for p in flaws.paths if p[0] == "driver" and (not several or p[1:2] == (i,))}
        if isinstance(table, DrivenAngle):
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
        if isinstance(table, DrivenAngle):
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
            value = math.nan if angle is None else angle
            found[where] = Driver(key, base, value, omega + 0.0, alpha, "", dead, named, rpm, speed, law)
        else:
            travel = None if table.travel is None else table.travel * metres
            dead = _from_dead_point(table, travel, metres)
            fast = file.units.rates.metres
            rate, second = (table.velocity or 0.0) * fast, table.acceleration * fast
            if law is not None and table.time is not None:
                travel = law.at(law.time).lift
            value = math.nan if travel is None else travel
            on = next((on for pair, on in ends if pair == key), "")
            sliding = next((s.link for s in slidings if s.key == key), key)  # or the block of a pin in a slot
            found[where] = Driver(sliding, on, value, rate, second, key, dead, law=law)
    return found


def _law(where: str, table: DrivenAngle | DrivenSlide, metres: float) -> tuple[MotionLaw | None, list[Problem]]:
    """How a driver moves over the time, at the moment that the file asks; and what is wrong with it."""
    problems: list[Problem] = []
    given = {key: getattr(table, key, None) for key in ("angle", "travel", "omega", "rpm", "speed", "velocity")}
    given |= {key: getattr(table, key, 0.0) or None for key in ("alpha", "acceleration")}
    given |= {key: getattr(table, key, None) for key in ("sense", "position")} | {"from": table.origin}
    if table.law is None:
        if table.time is not None:
            problems.append(Problem(f"{where}.time", Phrase("tells the moment of a law"), Phrase("write law with it")))
        return None, problems
    value = "angle" if isinstance(table, DrivenAngle) else "travel"
    for key, there in given.items():
        if there is not None and key != value:
            problems.append(
                Problem(f"{where}.{key}", Phrase("stands beside law"), Phrase("the law gives it leave one of them"))
            )
    if table.time is not None and given[value] is not None:
        problems.append(Problem(f"{where}.time", Phrase("stands beside", value=value), Phrase("write one of the two")))
    law = law_of(f"{where}.law", table.law, math.pi / 180 if value == "angle" else metres, problems)
    if law is not None and table.time is not None:
        if not law.pieces[0].start <= table.time <= law.duration:
            found, wanted = (
                Phrase("found value", value=f"{table.time:g}"),
                Phrase("the law goes from to s", start=f"{law.pieces[0].start:g}", duration=f"{law.duration:g}"),
            )
            problems.append(Problem(f"{where}.time", found, wanted))
        law = replace(law, time=table.time)
    return law, problems


def _too_slow(where: str, table: DrivenAngle | DrivenSlide) -> Iterator[Problem]:
    for key in ("omega", "rpm", "speed", "alpha", "velocity", "acceleration"):
        rate = getattr(table, key, None)
        if rate and abs(rate) < SMALLEST:
            yield Problem(
                f"{where}.{key}",
                Phrase("found value", value=f"{rate:g}"),
                Phrase("write 0 or at least", smallest=f"{SMALLEST:g}"),
            )


def _from_dead_point(
    table: DrivenAngle | DrivenSlide, value: float | None, unit: float
) -> FromDeadPoint | None:
    if table.origin is None or value is None:
        return None
    return FromDeadPoint(value, None if table.near is None else table.near * unit)


def _origin_problems(
    where: str, table: DrivenAngle | DrivenSlide, file: SceneTables
) -> Iterator[Problem]:
    value = table.angle if isinstance(table, DrivenAngle) else table.travel
    what = "angle" if isinstance(table, DrivenAngle) else "travel"
    if table.origin is None:
        if table.near is not None:
            yield Problem(f"{where}.near", Phrase("tells which dead point"), Phrase("write from dead point with it"))
        return
    if value is None or value == 0.0:
        yield Problem(
            f"{where}.{what}",
            Phrase("is missing") if value is None else Phrase("0 is the dead point itself"),
            Phrase("write the distance from the dead point"),
        )
    if len(file.drivers) > 1:
        yield Problem(f"{where}.from", Phrase("a dead point is found for a single"), Phrase("give the value itself"))
    if file.drawn:
        yield Problem(f"{where}.from", Phrase("with drawn the value of the driver follows"),
                      Phrase("leave one of the two out"))


def _angle_problems(
    where: str, table: DrivenAngle, file: SceneTables, names: Names, lost: set[str]
) -> Iterator[Problem]:
    moving = ", ".join(list(file.links)[:12])
    for key, name in (("link", table.link), ("relative_to", table.relative_to)):
        if name is None:
            continue
        missing = names.no_link(f"{where}.{key}", name, moving=key == "link")
        if missing:
            yield missing
        elif name in file.links and file.links[name].redundant:
            yield Problem(
                f"{where}.{key}", Phrase("link is redundant", what=name), Phrase("drive by a link that counts")
            )
    if table.link == names.frame and table.link not in file.links:
        yield Problem(
            f"{where}.link", Phrase("link is the frame", name=table.link), Phrase("drive a moving link", moving=moving)
        )
    if table.relative_to == table.link:
        yield Problem(f"{where}.relative_to", Phrase("link is driven relative to itself", link=table.link),
                      Phrase("name another link or leave it out for"))
    if table.omega is not None and table.rpm is not None:
        yield Problem(f"{where}.omega", Phrase("found omega and rpm", omega=f'{table.omega:g}', rpm=f'{table.rpm:g}'),
                      Phrase("write one of the two"))
    for other, rate in (("omega", table.omega), ("rpm", table.rpm)):
        if table.speed is not None and rate is not None:
            yield Problem(
                f"{where}.speed",
                Phrase("found speed and", speed=f"{table.speed:g}", other=other, rate=f"{rate:g}"),
                Phrase("write one of the two"),
            )
    if table.speed is not None and table.of is None and "of" not in lost:
        yield Problem(f"{where}.of", Phrase("is missing"), Phrase("write of b the point whose speed it"))
    if table.of is not None:
        if table.speed is None and "speed" not in lost:
            yield Problem(
                f"{where}.of", Phrase("names a point whose speed is not given"), Phrase("write speed or leave it out")
            )
        moving_points = [p for n, own in names.points.items() if n != names.frame for p in own]
        if table.of not in moving_points and not names.unsure:
            wanted = did_you_mean(table.of, moving_points)
            yield Problem(f"{where}.of", Phrase("no moving link has a point", name=table.of), wanted)
        if len(file.drivers) > 1:
            yield Problem(f"{where}.speed", Phrase("the speed of a point tells the rate"),
                          Phrase("give omega"))
    for key, rate in (("omega", table.omega), ("rpm", table.rpm), ("speed", table.speed)):
        if table.sense is not None and rate is not None and rate < 0:
            yield Problem(f"{where}.{key}", Phrase("found beside the sense", rate=f'{rate:g}', sense=table.sense),
                          Phrase("with sense write the size or leave sense"))
    told = table.omega, table.rpm, table.speed, table.law
    if all(one is None for one in told) and not lost & {"omega", "rpm", "speed", "law"}:
        yield Problem(f"{where}.omega", Phrase("is missing"), Phrase("write omega in rad s or rpm it"))


def _position_problems(where: str, i: int, table: DrivenAngle, file: SceneTables) -> Iterator[Problem]:
    if table.position is None:
        return
    known = [str(k) for k in range(1, ((file.positions and file.positions.count) or 0) + 1)]
    known += list(file.positions.also) if file.positions else []
    if i > 0:
        yield Problem(f"{where}.position", Phrase("positions are those of the first driver"), Phrase("give the angle"))
    elif str(table.position) not in known:
        wanted = did_you_mean(str(table.position), known) if known else Phrase("name it in positions")
        yield Problem(f"{where}.position", Phrase("there is no position", at=table.position), wanted)
    elif file.positions and file.positions.first is None and str(table.position) not in file.positions.also:
        wanted = Phrase("write positions.first or the angle")
        yield Problem(f"{where}.position", Phrase("the numbered positions count from the driver's own"), wanted)
    if table.angle is not None:
        yield Problem(
            f"{where}.position", Phrase("found angle too", angle=f"{table.angle:g}"), Phrase("write one of the two")
        )
    if table.origin is not None or file.drawn:
        yield Problem(
            f"{where}.position",
            Phrase("what gives the driver's value stands here twice"),
            Phrase("leave one of them out"),
        )


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
        problems.append(
            Problem(f"{where}.velocity", Phrase("is missing"), Phrase("write velocity per second it may be 0"))
        )
    what, _, on = table.slide.partition("/")
    pairs = {p.key: p.on for p in slidings if p.link == what} or {p.key: p.on for p in pins if p.point == what}
    keys = [key for key, rail in pairs.items() if rail in (on or rail, ) and rail == (table.relative_to or rail)]
    known = [p.key for p in slidings] + [p.key for p in pins]
    if "" in names.unsure or (what in file.links and file.links[what].on is not None and not pairs):
        return problems, keys[0] if len(keys) == 1 else table.slide  # its pair has a problem of its own
    if not pairs and what not in names.points:
        problems.append(
            Problem(f"{where}.slide", Phrase("there is no sliding link", what=what), did_you_mean(what, known))
        )
    elif not pairs:
        problems.append(
            Problem(
                f"{where}.slide",
                Phrase("link slides on nothing", what=what),
                Phrase("drive a sliding pair", pairs=", ".join(known)) if known else Phrase("there is no sliding pair"),
            )
        )
    elif not keys:
        key, name = ("slide", on) if on and on not in pairs.values() else ("relative_to", table.relative_to)
        problems.append(Problem(f"{where}.{key}", Phrase("does not slide on link", what=what, name=name),
                                Phrase("it may be", names=alternatives(pairs))))
    elif len(keys) > 1:
        problems.append(Problem(f"{where}.slide", Phrase("slides on links", what=what, count=len(keys)),
                                Phrase("write a key", names=alternatives([f'"{key}"' for key in keys]))))
    if what in file.links and file.links[what].redundant:
        problems.append(
            Problem(f"{where}.slide", Phrase("link is redundant", what=what), Phrase("drive by a link that counts"))
        )
    return problems, keys[0] if len(keys) == 1 else table.slide


def _driven_twice(where: str, key: str, base: str, found: Mapping[str, Driver]) -> list[Problem]:
    for place, other in found.items():
        if other.key == key:
            what = Phrase("link of name", name=key) if base else key
            again = base and not (other.turns and other.relative_to == base)
            hint = Phrase("write the second as link relative_to", base=base, key=key) if again else ""
            said = Phrase("is driven by already", what=what, where=place)
            return [Problem(where, said, hint or Phrase("leave one of them out"))]
        if base and other.turns and {key, base} == {*other.links}:
            said = Phrase("the angle between links and is driven by", key=key, base=base, where=place)
            return [Problem(where, said, Phrase("leave one of them out"))]
    return []
