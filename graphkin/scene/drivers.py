"""The drivers of a mechanism, read from its file: an angle or a travel, its rates, or its law over time; and the
mechanism at a moment of such laws.

With ``from = "dead point"`` a driver's angle or travel is the distance from a dead point of the mechanism, given
without loss however small it is: positive beyond a dead point at which the motion begins (as the driver's value grows),
negative before one where it ends; at a change point, through which the motion goes on, either.  ``near`` (degrees, or
travel) chooses one where there are several.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

from graphkin.errors import CallError, Problem, did_you_mean, some_of
from graphkin.scene import model
from graphkin.scene.bodies import Reading
from graphkin.scene.laws import LiftPiece, MotionLaw, form_of
from graphkin.scene.model import Mechanism
from graphkin.scene.scene_tables import SMALLEST, DrivenSlide, Driver, DriverLaw, Positions
from graphkin.scene.tables import Units, in_si, in_units
from graphkin.words import Phrase, joined, listed

# reading


def drives(reading: Reading) -> dict[str, model.Driver]:
    """The drivers of the file by their places in it; their problems are noted.

    A value that follows from the drawn points, or from a named position, is not a number.
    """
    drivers: dict[str, model.Driver] = {}
    tables = reading.drivers
    several = "driver" not in tables
    for i, (where, driver) in enumerate(tables.items()):
        before = len(reading.problems)
        there = (p for p in reading.lost if p[0] == "driver" and (not several or p[1:2] == (i,)))
        lost = {str(p[-1]) for p in there}
        if isinstance(driver, Driver):
            name, base = driver.link, driver.relative_to or reading.frame.name
            reading.wrong(*_angle_problems(where, driver, reading, lost))
            if driver.position is not None:
                reading.wrong(*_position_problems(where, i, driver, reading))
        else:
            name, base = _pair_of(where, driver, reading, lost), ""
        law = _law(where, driver, reading)
        reading.wrong(*_origin_problems(where, driver, reading),
                      *_driven_twice(where, name, base, drivers, reading.frame.name), *_too_slow(where, driver))
        if len(reading.problems) > before or lost & {"angle", "travel", "law", "time"}:
            continue
        si = in_si(driver, reading.units)
        value = si.angle if isinstance(si, Driver) else si.travel
        distance = None if driver.origin is None else value
        if law is not None and driver.time is not None:
            value = law.at(law.time).lift
        value = math.nan if value is None else value
        if isinstance(si, Driver):
            sign = -1.0 if si.sense == "clockwise" else 1.0
            omega = sign * (si.omega if si.omega is not None else (si.rpm or 0.0) * math.pi / 30)
            rpm = None if si.rpm is None else sign * si.rpm
            speed = (si.of, sign * si.speed) if si.speed is not None and si.of is not None else None
            position = "" if si.position is None else str(si.position)
            drivers[where] = model.Driver(
                name, base, value, omega + 0.0, sign * si.alpha + 0.0, "", distance, position, rpm, speed, law,
                near=si.near,
            )
        else:
            ends = {pair.key: (pair.a, pair.b) for pair in reading.slides}
            sliding, on = ends.get(name, (name, ""))  # of a pin in a slot its block
            drivers[where] = model.Driver(
                sliding, on, value, si.velocity or 0.0, si.acceleration, name, distance, law=law, near=si.near
            )
    return drivers


def _law(where: str, driver: Driver | DrivenSlide, reading: Reading) -> MotionLaw | None:
    """The law of a driver, at the moment that the file asks for."""
    if driver.law is None:
        law_is_wrong = any(str(problem.where).startswith(f"{where}.law") for problem in reading.problems)
        if driver.time is not None and not law_is_wrong:
            reading.say(f"{where}.time", "tells the moment of a law", "write law with it")
        return None
    value, given = ("angle", driver.angle) if isinstance(driver, Driver) else ("travel", driver.travel)
    for name in ("omega", "rpm", "speed", "velocity", "alpha", "acceleration", "sense", "position", "origin"):
        there = getattr(driver, name, None)
        if there is not None and not (name in ("alpha", "acceleration") and not there):
            reading.say(f"{where}.{'from' if name == 'origin' else name}", "stands beside law",
                        "the law gives it leave one of them")
    if driver.time is not None and given is not None:
        reading.say(f"{where}.time", "stands beside", "write one of the two", value=value)
    unit = math.pi / 180 if value == "angle" else reading.metres
    law = motion_law(f"{where}.law", driver.law, unit, reading)
    if law is None or driver.time is None:
        return law
    if not law.pieces[0].start <= driver.time <= law.duration:
        reading.say(f"{where}.time", "found value", "the law goes from to s", value=f"{driver.time:g}",
                    start=f"{law.pieces[0].start:g}", duration=f"{law.duration:g}")
    return replace(law, time=driver.time)


def _too_slow(where: str, driver: Driver | DrivenSlide) -> Iterator[Problem]:
    for name in ("omega", "rpm", "speed", "alpha", "velocity", "acceleration"):
        rate = getattr(driver, name, None)
        if rate and abs(rate) < SMALLEST:
            yield Problem(f"{where}.{name}", "found value", "write 0 or at least", value=f"{rate:g}",
                          smallest=f"{SMALLEST:g}")


def _origin_problems(where: str, driver: Driver | DrivenSlide, reading: Reading) -> Iterator[Problem]:
    key, value = ("angle", driver.angle) if isinstance(driver, Driver) else ("travel", driver.travel)
    if driver.origin is None:
        if driver.near is not None:
            yield Problem(f"{where}.near", "tells which dead point", "write from dead point with it")
        return
    if value is None or value == 0.0:
        fault = Phrase("is missing") if value is None else Phrase("0 is the dead point itself")
        yield Problem(f"{where}.{key}", fault, "write the distance from the dead point")
    if len(reading.drivers) > 1:
        yield Problem(f"{where}.from", "a dead point is found for a single", "give the value itself")
    if reading.file.drawn:
        yield Problem(f"{where}.from", "with drawn the value of the driver follows", "leave one of the two out")


def _angle_problems(where: str, driver: Driver, reading: Reading, lost: set[str]) -> Iterator[Problem]:
    """The problems of a driven angle whose keys ``lost`` were taken out."""
    links, frame = reading.links, reading.frame.name
    for name, link in (("link", driver.link), ("relative_to", driver.relative_to)):
        if link is None:
            continue
        missing = reading.no_link(f"{where}.{name}", link, moving=name == "link")
        if missing:
            yield missing
        elif link in links and links[link].redundant:
            yield Problem(f"{where}.{name}", "link is redundant", "drive by a link that counts", what=link)
    if driver.link == frame and driver.link not in links:
        yield Problem(f"{where}.link", "link is the frame", "drive a moving link", name=driver.link,
                      moving=some_of([*links]))
    if driver.relative_to == driver.link:
        yield Problem(f"{where}.relative_to", "link is driven relative to itself",
                      "name another link or leave it out for", link=driver.link)
    rates = {name: rate for name in ("omega", "rpm", "speed") if (rate := getattr(driver, name)) is not None}
    if "omega" in rates and "rpm" in rates:
        yield Problem(f"{where}.omega", "found omega and rpm", "write one of the two", omega=f"{driver.omega:g}",
                      rpm=f"{driver.rpm:g}")
    for other, rate in rates.items():
        if "speed" in rates and other != "speed":
            yield Problem(f"{where}.speed", "found speed and", "write one of the two", speed=f"{driver.speed:g}",
                          other=other, rate=f"{rate:g}")
    if "speed" in rates and driver.of is None and "of" not in lost:
        yield Problem(f"{where}.of", "is missing", "write of b the point whose speed it")
    if driver.of is not None:
        if "speed" not in rates and "speed" not in lost:
            yield Problem(f"{where}.of", "names a point whose speed is not given", "write speed or leave it out")
        moving = [p for n, points in reading.points.items() if n != frame for p in points]
        if driver.of not in moving and not reading.unsure:
            yield Problem(f"{where}.of", "no moving link has a point", did_you_mean(driver.of, moving), name=driver.of)
        if len(reading.drivers) > 1:
            yield Problem(f"{where}.speed", "the speed of a point tells the rate", "give omega")
    for name, rate in rates.items():
        if driver.sense is not None and rate < 0:
            yield Problem(f"{where}.{name}", "found beside the sense", "with sense write the size or leave sense",
                          rate=f"{rate:g}", sense=driver.sense)
    if not rates and driver.law is None and not lost & {"omega", "rpm", "speed", "law"}:
        yield Problem(f"{where}.omega", "is missing", "write omega in rad s or rpm it")


def _position_problems(where: str, i: int, driver: Driver, reading: Reading) -> Iterator[Problem]:
    """The problems of driver number i, which names its position."""
    named, here, known = str(driver.position), f"{where}.position", reading.positions
    positions = reading.file.positions or Positions()
    if i > 0:
        yield Problem(here, "positions are those of the first driver", "give the angle")
    elif named not in known:
        wanted = did_you_mean(named, known) if known else Phrase("name it in positions")
        yield Problem(here, "there is no position", wanted, at=driver.position)
    elif positions.first is None and named not in positions.also:
        yield Problem(here, "the numbered positions count from the driver's own", "write positions.first or the angle")
    if driver.angle is not None and driver.origin is None:
        yield Problem(here, "found angle too", "write one of the two", angle=f"{driver.angle:g}")
    if driver.origin is not None or reading.file.drawn:
        yield Problem(here, "what gives the driver's value stands here twice", "leave one of them out")


def _pair_of(where: str, driver: DrivenSlide, reading: Reading, lost: set[str]) -> str:
    """The key of the pair that a table drives, if it is known; its problems are noted."""
    if driver.velocity is None and driver.law is None and not lost & {"velocity", "law"}:
        reading.say(f"{where}.velocity", "is missing", "write velocity per second it may be 0")
    slider, _, on = driver.slide.partition("/")
    # the whole key first: a pin may bear the name of a link that slides elsewhere
    pairs = {p.key: p.b for p in reading.slides if p.key == driver.slide}
    pairs = pairs or {p.key: p.b for p in reading.slides if p.a == slider}
    pairs = pairs or {p.key: p.b for p in reading.slides if p.of and p.pin == slider}
    keys = [pair for pair, rail in pairs.items() if rail in (on or rail,) and rail == (driver.relative_to or rail)]
    known = reading.pairs
    meant, link, here = keys[0] if len(keys) == 1 else driver.slide, reading.links.get(slider), f"{where}.slide"
    if "" in reading.unsure or reading.is_unread(driver.slide):
        return meant  # its pair has a problem of its own
    if not pairs and slider not in reading.points:
        reading.say(here, "there is no sliding link", did_you_mean(slider, known), what=slider)
    elif not pairs:
        drive = Phrase("drive a sliding pair", pairs=listed(known)) if known else Phrase("there is no sliding pair")
        reading.say(here, "link slides on nothing", drive, what=slider)
    elif not keys:
        name, rail = ("slide", on) if on and on not in pairs.values() else ("relative_to", driver.relative_to)
        reading.say(f"{where}.{name}", "does not slide on link", "it may be", what=slider, name=rail,
                    names=joined("one or other", pairs))
    elif len(keys) > 1:
        reading.say(here, "slides on links", "write a key", what=slider, count=len(keys),
                    names=joined("one or other", [f'"{pair}"' for pair in keys]))
    if link is not None and link.redundant:
        reading.say(here, "link is redundant", "drive by a link that counts", what=slider)
    return meant


def _driven_twice(where: str, name: str, base: str, before: Mapping[str, model.Driver], frame: str) -> list[Problem]:
    """The problem of a motion that another driver gives already; ``base`` is "" for a travel."""
    for place, other in before.items():
        if other.key == name:
            motion = Phrase("link of name", name=name) if base else name
            said, wanted = Phrase("is driven by already", what=motion, where=place), Phrase("leave one of them out")
            if base and not (other.turns and other.relative_to == base):
                # the frame cannot be driven: the driver that has a moving link turns about
                wanted = (Phrase("write the first as link relative_to", base=other.relative_to, key=name)
                          if base == frame else Phrase("write the second as link relative_to", base=base, key=name))
            return [Problem(where, said, wanted)]
        if base and other.turns and {name, base} == {*other.links}:
            said = Phrase("the angle between links and is driven by", key=name, base=base, where=place)
            return [Problem(where, said, Phrase("leave one of them out"))]
    return []


def placed_driver(where: str, driver: model.Driver, value: float, reading: Reading) -> model.Driver:
    """The driver with its value, and with the rates by its law there; problems are noted.

    ``value`` comes from the file or its drawn points (rad, m); it is not a number where they give none.
    """
    # where drawn points are wrong, that they give no value is no second problem
    problems = [] if reading.problems and (reading.file.drawn or reading.lost_under("drawn")) else reading.problems
    if driver.position:  # its value is found where the positions are known
        return replace(driver, value=0.0)
    name, law = "angle" if driver.turns else "travel", driver.law
    if math.isnan(value):
        if law is not None:
            wanted = Phrase("write time in s or the angle" if driver.turns else "write time in s or the travel")
        elif driver.turns:
            wanted = Phrase("write angle in degrees or draw two points", key=driver.key)
        else:
            wanted = Phrase("write travel or draw the points that give")
        problems.append(Problem(f"{where}.{name}", "is missing", wanted))
        return driver
    driver = replace(driver, value=value)
    if law is None:
        return driver
    if abs(law.at(law.time).lift - value) > 1e-12 * max(map(abs, law.span)):
        time = law.reached(value)  # where no moment is asked, the first at which it comes there
        if time is None:
            unit = math.pi / 180 if driver.turns else reading.metres
            low, high = (f"{end / unit:.6g}" for end in law.span)
            problems.append(Problem(f"{where}.{name}", "found value", "the law goes from to",
                                    value=f"{value / unit:.6g}", least=low, greatest=high, turns=" deg" * driver.turns))
            return driver
        law = replace(law, time=time)
    return driver.moving(law)


def stated_driver(driver: model.Driver, tables: Iterable[Driver | DrivenSlide], units: Units) -> Driver | DrivenSlide:
    """The table of a driver with its present value and rates; with a law, at its present moment.

    Parameters
    ----------
    tables : of the file, where one of them may be that of this driver
    """
    # a sliding pair may be written by its sliding link alone
    key = "link" if driver.turns else "slide"
    names = (driver.link,) if driver.turns else (driver.slide, driver.slide.split("/")[0])
    table: Any = next((in_si(table, units) for table in tables if getattr(table, key, None) in names), None)
    value, rate, second = (None, None, 0.0) if driver.law is not None else driver.values
    time = None if driver.law is None else driver.law.time
    if driver.distance is not None:
        value = driver.distance
    elif table is not None:
        table = replace(table, origin=None, near=None)
    if not driver.turns:
        slide = table or DrivenSlide(slide=driver.slide)
        return in_units(replace(slide, travel=value, velocity=rate, acceleration=second, time=time), units)
    speed = None if driver.given_speed is None else driver.given_speed[1]
    crank = table or Driver(link=driver.link, relative_to=driver.relative_to)
    value, position = (None, crank.position) if driver.position else (value, None)
    return in_units(replace(crank, angle=value, omega=rate if speed is None else None, rpm=None, speed=speed,
                            alpha=second, sense=None, position=position, time=time), units)


def motion_law(where: str, law: DriverLaw, unit: float, reading: Reading) -> MotionLaw | None:
    """The law in a driver's table, in rad or m and s; its problems are noted."""
    single = any(x is not None for x in (law.to, law.rise, law.duration, law.by))
    forms = {"table": law.table, "pieces": law.pieces, "by": single}
    given = [name for name, there in forms.items() if there]
    if len(given) != 1:
        fault = Phrase("says its motion by", ways=listed(given)) if given else "says nothing"
        reading.say(where, fault, "write from and to or pieces or a table")
        return None
    if law.table:
        return _by_table(where, law, unit, reading)
    before = len(reading.problems)
    if law.origin is None:
        reading.say(f"{where}.from", "is missing", "write the driver's value at 0 s")
    pieces: list[LiftPiece] = []
    start = law.origin or 0.0
    if single:
        if (law.to is None) == (law.rise is None):
            fault = "is missing" if law.to is None else "stands beside rise"
            reading.say(f"{where}.to", fault, "write to the value at the end or")
        if law.duration is None:
            reading.say(f"{where}.duration", "is missing", "write the seconds that it takes")
        if law.by is None:
            reading.say(f"{where}.by", "is missing", "write by cycloidal harmonic 345 or another law")
        end = law.to if law.to is not None else start + (law.rise or 0.0)
        pieces.append(LiftPiece(0.0, law.duration or 1.0, start * unit, end * unit, form_of(law.by)))
    time, low = 0.0, start * unit
    for i, piece in enumerate(law.pieces, 1):
        here = f"{where}.pieces.{i}"
        reading.wrong(*piece.problems(here))
        high = low + piece.height * unit
        if not piece.to > time:
            reading.say(here, "ends at s where it begins at", "seconds grow", to=f"{piece.to:g}", time=f"{time:g}")
        pieces.append(LiftPiece(time, piece.to, low, high, form_of(piece.by)))
        time, low = piece.to, high
    return None if len(reading.problems) > before else MotionLaw(tuple(pieces))


def _by_table(where: str, law: DriverLaw, unit: float, reading: Reading) -> MotionLaw | None:
    """A law through the values of a table."""
    here = f"{where}.table"
    if law.origin is not None:
        reading.say(f"{where}.from", "stands beside a table", "the table says where it begins")
        return None
    times, values = [t for t, _ in law.table], [v * unit for _, v in law.table]
    if len(times) < 2:
        reading.say(here, "has one row", "write time value two rows or more")
        return None
    for i, (a, b) in enumerate(pairwise(times), 2):
        if not b > a:
            reading.say(f"{here}.{i}", "is at s after one at s", "seconds grow", other=f"{b:g}", name=f"{a:g}")
            return None
    rates = _spline(times, values)
    rows = zip(pairwise(times), pairwise(values), pairwise(rates), strict=True)
    return MotionLaw(tuple(LiftPiece(*ends, *between, "", rates=slopes) for ends, between, slopes in rows), times[0])


def _spline(times: Sequence[float], values: Sequence[float]) -> list[float]:
    """The rates at its knots of the cubic spline without acceleration at both ends (de Boor, A Practical Guide to
    Splines, ch. 4), by elimination."""
    n = len(times)
    wide = [b - a for a, b in pairwise(times)]
    mean = [(b - a) / w for a, b, w in zip(values, values[1:], wide, strict=False)]
    before, right = [0.5], [1.5 * mean[0]]
    for k in range(1, n - 1):
        # wide[k] s[k-1] + 2 (wide[k-1] + wide[k]) s[k] + wide[k-1] s[k+1] = 3 (wide[k] mean[k-1] + wide[k-1] mean[k])
        main = 2 * (wide[k - 1] + wide[k]) - wide[k] * before[-1]
        right.append((3 * (wide[k] * mean[k - 1] + wide[k - 1] * mean[k]) - wide[k] * right[-1]) / main)
        before.append(wide[k - 1] / main)
    rates = [(3 * mean[-1] - right[-1]) / (2 - before[-1])]
    for k in range(n - 2, -1, -1):
        rates.insert(0, right[k] - before[k] * rates[0])
    return rates


# over the time


def moves_by_law(scene: Mechanism) -> bool:
    """Whether a driver moves by a law over the time."""
    return any(d.law is not None for d in scene.drivers)


def moment_of(scene: Mechanism) -> float | None:
    """The moment (s) of the scene's position; None without a law, and where laws reach the values that were asked of
    their drivers at different moments."""
    times = [d.law.time for d in scene.drivers if d.law is not None]
    return times[0] if times and all(math.isclose(time, times[0], abs_tol=1e-9) for time in times) else None


def time_span(scene: Mechanism) -> tuple[float, float]:
    """The first and the last moment (s) of the drivers' laws."""
    laws = [d.law for d in scene.drivers if d.law is not None]
    return min(law.pieces[0].start for law in laws), max(law.duration for law in laws)


def moments(scene: Mechanism, count: int) -> tuple[float, ...]:
    """``count`` moments (s), evenly from the beginning of the laws to their end."""
    low, high = time_span(scene)
    return (*(low + (high - low) * k / max(count - 1, 1) for k in range(count - 1)), high)


def at_time(scene: Mechanism, time: float) -> tuple[Mechanism, dict[str, float]]:
    """The scene with the rates of its drivers at a moment (s), and their values (rad, m) by their keys.

    A driver without a law moves on from its value at the scene's moment with its omega and alpha.

    Raises
    ------
    CallError : a moment before or after all laws
    """
    low, high = time_span(scene)
    if not low <= time <= high:
        raise CallError.of("at time", "found s", "the law goes from to s", time=f"{time:g}", start=f"{low:g}",
                           duration=f"{high:g}")
    drivers: list[model.Driver] = []
    values: dict[str, float] = {}
    since = time - next(d.law.time for d in scene.drivers if d.law is not None)
    for driver in scene.drivers:
        if driver.law is not None:
            values[driver.key] = driver.law.at(time).lift
            drivers.append(driver.moving(replace(driver.law, time=time)))
            continue
        value, rate, second = driver.values
        values[driver.key] = value + since * (rate + since * second / 2)
        now = rate + since * second
        drivers.append(driver if now == rate else replace(driver, rate=now))
    return replace(scene, drivers=tuple(drivers)), values
