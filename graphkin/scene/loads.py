"""Masses, loads, springs, gravity, balance and flywheel of a mechanism, read from its file.

In a file forces are in its force unit, moments in it times metre, masses in its mass unit, angles in degrees.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from graphkin.errors import did_you_mean
from graphkin.plane import direction
from graphkin.scene.bodies import Reading
from graphkin.scene.model import LinkMass, Loading, LoadOn, SpringOn
from graphkin.scene.scene_tables import STANDARD_GRAVITY, Balance, Load, LoadPhase, Mass, Spring
from graphkin.scene.tables import in_si
from graphkin.words import Phrase, joined, listed

NONE, TURN = 1e-12 * math.tau, (1 + 1e-12) * math.tau
"""rad: no part of a turn, and a whole one, as far as rounding tells."""
ACTING = ("masses", "loads", "springs")
"""The tables of what makes forces."""

# reading


def loading_of(reading: Reading) -> Loading:
    """The causes of forces in the tables of a file; their problems are noted."""
    file = reading.file
    if not any(getattr(file, table) for table in (*ACTING, "balance", "flywheel")):
        return Loading()
    g = file.gravity.g if file.gravity else STANDARD_GRAVITY
    down = g * direction(file.gravity.angle) if file.gravity else 0j
    weighing = [_mass(reading, link, mass, g) for link, mass in file.masses.items()]
    carried = [_load(reading, name, load) for name, load in file.loads.items()]
    pulling = [_spring(reading, name, spring) for name, spring in file.springs.items()]
    balancing, evening = _balance(reading, file.balance), None
    if file.flywheel is not None and not _not_moving(reading, "flywheel.on", file.flywheel.on):
        evening = file.flywheel
        if evening.delta >= 2.0:
            reading.say("flywheel.delta", "found value", "a part of the mean speed below 2", value=f"{evening.delta:g}")
    acting = any(getattr(file, table) or reading.lost_under(table) for table in ACTING)
    if (balancing or evening) and not acting:
        where = "balance" if balancing else "flywheel"
        reading.say(where, "there is nothing to balance", "give masses.link loads.name or springs.name")
    return Loading(down, tuple(filter(None, weighing)), tuple(filter(None, carried)), balancing, evening,
                   tuple(filter(None, pulling)))


def _not_moving(reading: Reading, where: str, link: str) -> bool:
    """Note a name that is no moving link; whether it is so."""
    if reading.wrong(reading.no_link(where, link)):
        return True
    if link == reading.frame.name:
        reading.say(where, "link is the frame", "what acts on the fixed link moves nothing", name=link)
        return True
    if link in reading.links and reading.links[link].redundant:
        reading.say(where, "link is redundant", "its share of the forces is not determined", what=link)
        return True
    return False


def _place(reading: Reading, where: str, link: str, at: str | Sequence[float]) -> complex:
    """A point of a link by name, or a place (m), in the link's own axes (m)."""
    if not isinstance(at, str):
        return complex(*at)
    reading.wrong(reading.no_point_of(where, link, at))
    return reading.place(link, at)


def _pair(reading: Reading, where: str, ref: str) -> str:
    """The key of a sliding pair, "6" standing for the one pair of link 6."""
    known = [pair for pair in reading.pairs if ref in (pair, pair.split("/")[0])]
    if len(known) != 1 and not reading.is_unread(ref):
        meant = did_you_mean(ref, reading.pairs)
        if known:
            reading.say(where, "may be", meant, ref=ref, name=joined("one or other", known))
        else:
            reading.say(where, "is no sliding pair", meant, ref=ref)
    return known[0] if known else ""


def _mass(reading: Reading, link: str, table: Mass, g: float) -> LinkMass | None:
    """The mass of a link, where ``g`` (m/s2) makes its weight."""
    where = f"masses.{link}"
    si = in_si(table, reading.units)
    if _not_moving(reading, where, link):
        return None
    at = _place(reading, f"{where}.at", link, si.at)
    if reading.lost_under("masses", link):
        return None
    if (table.mass is None) == (table.weight is None):
        fault = "has neither mass nor weight" if table.mass is None else "has both mass and weight"
        reading.say(where, fault, "give one of them")
        return None
    heavy = si.weight / g if si.weight is not None else si.mass or 0.0
    return LinkMass(link, at, heavy, si.inertia)


def _load(reading: Reading, name: str, load: Load) -> LoadOn | None:
    """A load."""
    where, say, si = f"loads.{name}", reading.say, in_si(load, reading.units)
    if _not_moving(reading, f"{where}.on", load.on):
        return None
    lost = reading.lost_under("loads", name)
    if (load.force is None) == (load.moment is None) and not lost:
        fault = "has neither force nor moment" if load.force is None else "has both force and moment"
        say(where, fault, "give one of them")
        return None
    phase = _phase(reading, f"{where}.when", load.when) if load.when is not None else None
    if si.moment is not None:
        for beside in ("at", "angle", "follows", "against"):
            if getattr(load, beside) is not None:
                say(f"{where}.{beside}", "stands beside moment", "a moment has neither place nor direction")
        return LoadOn(name, load.on, si.moment, False, phase=phase)
    at = 0j
    if si.at is not None:
        at = _place(reading, f"{where}.at", load.on, si.at)
    elif not lost:
        say(f"{where}.at", "is missing", "a point of the link or x y")
    turn = direction(load.angle) if load.angle is not None else 1 + 0j
    follows, against = "", ""
    if load.against is not None:
        against = _pair(reading, f"{where}.against", load.against)
        if load.angle is not None or load.follows is not None:
            say(f"{where}.against", "stands beside angle or follows", "a force has one direction")
    elif load.follows is not None:
        reading.wrong(reading.no_link(f"{where}.follows", load.follows))
        follows = load.follows
    elif load.angle is None and not lost:
        say(f"{where}.angle", "is missing", "write angle follows or against a force has")
    return LoadOn(name, load.on, si.force or 0.0, True, at, turn, follows, against, phase)


def _spring(reading: Reading, name: str, table: Spring) -> SpringOn | None:
    """A spring; it may not have the name of a load."""
    where, say, known = f"springs.{name}", reading.say, len(reading.problems)
    if name in reading.file.loads:
        say(where, "a load is called too", "another name both would be p_", name=name)
    nothing = Phrase("nothing")
    if len(table.between) != 2 or table.between[0] == table.between[1]:
        say(f"{where}.between", "found value", "two different points", value=listed(table.between) or nothing)
    elif table.links is not None and len(table.links) != 2:
        say(f"{where}.links", "found value", "two links one for each point", value=listed(table.links) or nothing)
    if len(reading.problems) > known:
        return None
    p, q = table.between
    on_p, on_q = table.links or ("", "")
    a = _end(reading, where, p, on_p)
    b = _end(reading, where, q, on_q)
    if len(reading.problems) > known or not (a and b):
        return None
    if a == b:
        say(where, "both ends are on link", "two links where several have a point write", ends=a)
        return None
    si = in_si(table, reading.units)
    at = reading.place(a, p), reading.place(b, q)
    return SpringOn(name, (p, q), (a, b), at, si.rate, si.free, si.preload)


def _end(reading: Reading, where: str, point: str, link: str) -> str:
    """The link of a spring's end: the given link, or the first link with the point, the frame before others."""
    frame = reading.frame.name
    here = f"{where}.{'links' if link else 'between'}"
    if not link:
        missing = reading.wrong(reading.no_point(here, point))
        order = [frame, *sorted(reading.links, key=lambda name: reading.links[name].redundant)]
        on = next((n for n in order if point in reading.places.get(n, {})), "")
        unread = "" in reading.unsure or any(point in points for points in reading.points.values())
        if not on and not missing and not unread:
            reading.say(here, "is placed on no link", "a point of a link or the frame", point=point)
        return "" if on not in (frame, "") and _not_moving(reading, here, on) else on
    if link != frame and _not_moving(reading, here, link):
        return ""
    reading.wrong(reading.no_point_of(here, link, point))
    return link


def _phase(reading: Reading, where: str, when: LoadPhase) -> LoadPhase | None:
    """When a load acts, in SI, its pair by its key."""
    say = reading.say
    if (when.stroke is None) == (when.driver is None):
        fault = "has neither stroke nor driver" if when.stroke is None else "has both stroke and driver"
        say(where, fault, "give one of them")
        return None
    if when.stroke is not None:
        if not when.start < when.end <= 1.0:
            say(where, "from to", "parts of the stroke grow from 0 to", least=f"{when.start:g}",
                greatest=f"{when.end:g}")
        if when.sense not in (1, -1):
            say(f"{where}.sense", "found value", "1 along the guide's sense 1 against it", value=f"{when.sense:g}")
        return replace(when, stroke=_pair(reading, f"{where}.stroke", when.stroke))
    assert when.driver is not None
    for beside, said in (("sense", when.sense != 1.0), ("from", when.start != 0.0), ("to", when.end != 1.0)):
        if said:
            say(f"{where}.{beside}", "stands beside driver", "it is of a stroke the driver's two")
    slides = reading.along
    start, end = (value * reading.units.of("length" if slides else "angle").si for value in when.driver)
    end = end if slides or end >= start else end + math.tau
    given = Phrase("found of bounds and fast", bounds=f"{when.driver[0]:g}", fast=f"{when.driver[1]:g}")
    if slides and start >= end:
        say(f"{where}.driver", given, "the travel grows between them")
    elif not slides and not NONE < end - start <= TURN:
        wanted = Phrase("two different values" if end - start <= NONE else "at most a turn lies between them")
        say(f"{where}.driver", given, Phrase("a load that acts always has no when", wanted=wanted))
    return LoadPhase(start=start, end=end)


def _balance(reading: Reading, table: Balance | None) -> LoadOn | None:
    """The balancing load, its size still unknown."""
    if table is None or _not_moving(reading, "balance.on", table.on):
        return None
    say, si = reading.say, in_si(table, reading.units)
    if len(reading.drivers) > 1:
        say("balance", "one balance cannot stand for several drivers", "leave it out each driver has its own")
    if si.at is None:
        if table.angle is not None:
            say("balance.angle", "stands without at", "a force has a place a moment has")
        return LoadOn("", table.on, 0.0, False)
    at = _place(reading, "balance.at", table.on, si.at)
    if table.angle is None:
        say("balance.angle", "is missing", "degrees in the frame or square to the")
    if isinstance(table.angle, int | float):
        return LoadOn("", table.on, 0.0, True, at, direction(table.angle))
    return LoadOn("", table.on, 0.0, True, at, 1j, follows=table.on)
