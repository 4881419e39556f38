"""A mechanism as the mapping of a scene file, and the text of such a mapping."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from graphkin.files import OwnTables, Tables
from graphkin.plane import degrees
from graphkin.scene.cams import LawCam, LiftPiece, SwingingFollower
from graphkin.scene.contacts import PlacedContact, PlacedGear
from graphkin.scene.loads import Phase
from graphkin.scene.model import Driver, Mechanism, PlacedLink
from graphkin.scene.motion_law import CubicPart, MotionLaw

__all__ = ["as_mapping", "toml_text"]


def as_mapping(scene: Mechanism) -> OwnTables:
    """The mapping of a scene file that reads as this scene, everything placed in the links' own axes.

    What was given by drawn points, arcs or polar entries stands there as lengths and places.
    """

    def length(value: float) -> float:
        return _tidy(value / scene.units.metres)

    def place(z: complex) -> list[float]:
        return [length(z.real), length(z.imag)]

    def guides(link: PlacedLink) -> OwnTables:
        own = {n: g for n, g in link.guides.items() if n}
        made = {n: {"through": place(g.through), "angle": _tidy(degrees(g.direction))} for n, g in own.items()}
        for slot in (s for s in scene.slots if s.on == link.name):
            made[slot.name] = {"centre": slot.centre, "r": length(slot.radius)}
            made[slot.name] |= {"ends": [_tidy(math.degrees(a)) for a in slot.ends]} if slot.ends else {}
        return made

    def discs(link: PlacedLink) -> OwnTables:
        return {d.name: {"centre": d.centre, "r": length(d.radius)} for d in link.discs}

    frame: OwnTables = {"name": scene.frame.name}
    frame["points"] = {p: place(z) for p, z in scene.frame.points.items()}
    frame["guides"] = guides(scene.frame)
    frame["discs"] = discs(scene.frame)
    links: dict[str, OwnTables] = {}
    bars = {slot.bar for slot in scene.slots if not slot.block}
    for link in scene.links:
        if link.name in bars:
            continue
        blocks = [slot for slot in scene.slots if slot.bar == link.name]
        table: OwnTables = {"points": list(link.bar)} if link.bar else {}
        if link.length is not None:
            table["length"] = length(link.length)
        pairs = [s for s in scene.slidings if s.link == link.name]
        if pairs or blocks:
            table["on"] = [_guide_name(s.on, s.guide) for s in pairs] + [f"{s.on}.{s.name}" for s in blocks]
            sides = [degrees(1j / link.points[s.centre] * abs(link.points[s.centre])) for s in blocks]
            table["angle_on"] = [_tidy(degree) for degree in (*(degrees(s.turn) for s in pairs), *sides)]
        centres = {slot.centre for slot in blocks}
        table["at"] = {p: place(z) for p, z in link.points.items() if p not in (*link.bar, *centres)}
        table["guides"] = guides(link)
        table["discs"] = discs(link)
        if (start := _start(scene, link, length)) is not None:
            table["start"] = start
        if link.redundant:
            table["redundant"] = True
        links[link.name] = {k: v for k, v in table.items() if v != {}}
    pins: dict[str, OwnTables] = {}
    for pin in scene.pins:
        pins.setdefault(pin.point, {"of": pin.of, "in": []})["in"].append(_guide_name(pin.on, pin.guide))
    for slot in (s for s in scene.slots if not s.block):
        of = next(n for n in scene.holders[slot.point] if n not in (slot.bar, slot.on))
        pins.setdefault(slot.point, {"of": of, "in": []})["in"].append(f"{slot.on}.{slot.name}")
    made: OwnTables = {"title": scene.title, "title_zh": scene.title_zh, "source": scene.source,
                            "source_zh": scene.source_zh}  # fmt: skip
    made["units"] = {"length": scene.units.length}
    if scene.units.speed:
        made["units"]["speed"] = scene.units.speed
    if scene.loading:
        made["units"] |= {"force": scene.units.force, "mass": scene.units.mass}
    made["frame"] = {k: v for k, v in frame.items() if v != {}}
    made["links"] = links
    made["pins"] = pins
    made["cams"] = {cam.link: _cam(cam, length) for cam in scene.cams}
    made["contacts"] = {c.name: _contact(c) for c in scene.contacts}
    made["gears"] = {g.name: _gear(g) for g in scene.gears}
    made["driver"] = [_driver(scene, d, length) for d in scene.drivers]
    made |= _loading(scene, place)
    made["sketch"] = {p: place(z) for p, z in {**scene.drawn, **scene.sketch}.items() if _moves(scene, p)}
    held = {c.round[0].centre for c in scene.contacts if c.rolling and c.flat}
    made["drawn"] = {p: place(z) for p, z in scene.drawn.items() if p in held}
    made["find"] = [str(s) for s in scene.find]
    return {k: v for k, v in made.items() if v not in ("", {}, [])}


def _cam(cam: LawCam, length: Callable[[float], float]) -> OwnTables:
    """A cam by the law of its follower."""
    swings = isinstance(cam.motion, SwingingFollower)
    pieces: list[OwnTables] = []
    for piece in cam.law.pieces:
        way = piece.high - piece.low
        moved = _tidy(math.degrees(abs(way))) if swings else length(abs(way))
        kind = {"rise" if way > 0 else "fall": moved, "by": piece.by} if piece.by else {}
        pieces.append({"to": _tidy(math.degrees(piece.end)), **kind})
    made: OwnTables = {"follower": cam.follower, "law": pieces, "base": {"r": length(cam.base), "of": "pitch"}}
    made |= {"sense": cam.sense} if cam.sense < 0 else {}
    made |= {"roller": length(cam.roller)} if cam.roller else {}
    made |= {"flat": True} if cam.flat else {}
    allow = {key: _tidy(math.degrees(a)) for key, a in zip(("rise", "fall"), cam.allowed, strict=True) if a is not None}
    return made | ({"allow": allow} if allow else {})


def _start(scene: Mechanism, link: PlacedLink, length: Callable[[float], float]) -> float | None:
    """Where a link stands that rolls."""
    if not (scene.gears or any(c.rolling for c in scene.contacts)):
        return None
    slide = next((s.key for s in scene.slidings if s.link == link.name), None)
    if slide is not None:
        return length(scene.starts[slide]) if slide in scene.starts else None
    return _tidy(math.degrees(scene.starts[link.name])) if link.name in scene.starts else None


def _contact(contact: PlacedContact) -> OwnTables:
    between = [f"{d.link}.{d.name}" if d else _guide_name(contact.face, contact.guide) for d in contact.discs]
    if contact.flat:
        side = "left" if contact.left else "right"
    else:
        side = "inside" if min(d.radius for d in contact.round) < 0 else "outside"
    return {"between": between, "side": side, "rolling": contact.rolling}


def _gear(gear: PlacedGear) -> OwnTables:
    second = _guide_name(gear.wheels[1], gear.guide)
    teeth = ["rack" if z is None else z for z in gear.teeth]
    return {"between": [gear.wheels[0], second], "teeth": teeth, "carrier": gear.carrier}


def _loading(scene: Mechanism, place: Callable[[complex], list[float]]) -> OwnTables:
    """Masses, loads, gravity, balance and flywheel."""
    loading, units = scene.loading, scene.units
    made: OwnTables = {"masses": {}, "loads": {}, "springs": {}}
    if loading.gravity:
        made["gravity"] = {"g": _tidy(abs(loading.gravity)), "angle": _tidy(degrees(loading.gravity))}
    for mass in loading.masses:
        heavy, inertia = _tidy(mass.mass / units.kilograms), _tidy(mass.inertia / units.inertias)
        made["masses"][mass.link] = {"at": place(mass.at), "mass": heavy, "inertia": inertia}
    for load in loading.loads:
        table: OwnTables = {"on": load.link}
        if load.is_force:
            table |= {"at": place(load.at), "force": _tidy(load.size / units.newtons)}
            table |= {"against": load.against} if load.against else {"angle": _tidy(degrees(load.turn))}
            table |= {"follows": load.follows} if load.follows else {}
        else:
            table["moment"] = _tidy(load.size / units.newtons)
        if load.phase is not None:
            table["when"] = _phase(scene, load.phase)
        made["loads"][load.name] = table
    for spring in loading.springs:
        rate, free = spring.rate * units.metres / units.newtons, spring.free / units.metres
        made["springs"][spring.name] = {
            "between": list(spring.points), "links": list(spring.links), "rate": _tidy(rate), "free": _tidy(free),
            "preload": _tidy(spring.preload / units.newtons),
        }  # fmt: skip
    if loading.balance is not None:
        balance = loading.balance
        made["balance"] = {"on": balance.link}
        if balance.kind == "force":
            angle = "square" if balance.square else _tidy(degrees(balance.turn))
            made["balance"] |= {"at": place(balance.at), "angle": angle}
    if loading.flywheel is not None:
        made["flywheel"] = {"on": loading.flywheel.link, "delta": loading.flywheel.delta}
    return made


def _phase(scene: Mechanism, phase: Phase) -> OwnTables:
    if phase.stroke:
        return {"stroke": phase.stroke, "sense": phase.sense, "from": phase.start, "to": phase.end}
    turns = scene.drivers[0].turns
    unit = math.radians(1.0) if turns else scene.units.metres
    return {"driver": [_tidy(phase.start / unit), _tidy(phase.end / unit)]}


def _moves(scene: Mechanism, point: str) -> bool:
    return point not in scene.frame.points


def _guide_name(link: str, guide: str) -> str:
    return f"{link}.{guide}" if guide else link


def _driver(scene: Mechanism, driver: Driver, length: Callable[[float], float]) -> OwnTables:
    if driver.turns:
        base = {} if driver.relative_to == scene.frame.name else {"relative_to": driver.relative_to}
        angle = _tidy(math.degrees(driver.value))
        rate: OwnTables = {"omega": _tidy(driver.rate)}
        if driver.law is not None:
            moment = _law(driver.law, math.pi / 180)
            return {"link": driver.link, **base, **moment}
        if driver.given_speed is not None:
            rate = {"speed": _tidy(driver.given_speed[1] / scene.units.rates.metres), "of": driver.given_speed[0]}
        return {"link": driver.link, **base, "angle": angle, **rate, "alpha": _tidy(driver.second)}
    if driver.law is not None:
        return {"slide": driver.key, **_law(driver.law, scene.units.metres)}
    travel = length(driver.value)
    velocity, second = (_tidy(v / scene.units.rates.metres) for v in driver.values[1:])
    return {"slide": driver.key, "travel": travel, "velocity": velocity, "acceleration": second}


def _law(law: MotionLaw, unit: float) -> OwnTables:
    """How a driver moves over the time, and the moment that is asked."""
    if isinstance(law.pieces[0], CubicPart):
        rows = [[piece.start, _tidy(piece.low / unit)] for piece in law.pieces]
        return {"time": law.time, "law": {"table": [*rows, [law.duration, _tidy(law.pieces[-1].high / unit)]]}}
    pieces: list[OwnTables] = []
    for piece in law.pieces:
        assert isinstance(piece, LiftPiece)
        way = _tidy((piece.high - piece.low) / unit)
        moved = {"rise" if way > 0 else "fall": abs(way), "by": piece.by} if piece.by else {}
        pieces.append({"to": piece.end, **moved})
    return {"time": law.time, "law": {"from": _tidy(law.pieces[0].low / unit), "pieces": pieces}}


def _tidy(value: float) -> float:
    """A number without the noise of unit conversion."""
    return float(f"{value:.13g}") + 0.0


def toml_text(mapping: Tables) -> str:
    """The text of a scene file from its mapping; reading it gives the mapping again.

    >>> print(toml_text({"title": "A", "links": {"1": {"points": ["A", "B"], "length": 2.0}}}), end="")
    title = "A"
    <BLANKLINE>
    [links.1]
    points = ["A", "B"]
    length = 2
    """
    import tomlkit
    from tomlkit.items import Table

    def value(given: object) -> object:
        if isinstance(given, Mapping):
            inline = tomlkit.inline_table()
            for key, item in given.items():
                inline.append(key, value(item))
            return inline
        if isinstance(given, list | tuple):
            return [value(item) for item in given]
        return int(given) if isinstance(given, float) and given.is_integer() and abs(given) < 1e15 else given

    def table(given: Tables) -> Table:
        made = tomlkit.table()
        for key, item in given.items():
            made.append(key, value(item))
        return made

    text = tomlkit.document()
    for key in sorted(mapping, key=lambda key: _is_table(mapping[key])):  # tables come after what stands alone
        given = mapping[key]
        if key in ("links", "pins", "contacts", "gears", "cams") and _is_table(given):
            made = tomlkit.table(is_super_table=True)
            for name, item in given.items():
                made.append(name, table(item))
            text.append(key, made)
        elif isinstance(given, Mapping):
            text.append(key, table(given))
        elif _is_table(given):
            several = tomlkit.aot()
            for item in given:
                several.append(table(item))
            text.append(key, several)
        else:
            text.append(key, value(given))
    return text.as_string()


def _is_table(value: object) -> bool:
    return isinstance(value, Mapping) or (
        isinstance(value, list) and bool(value) and all(isinstance(v, Mapping) for v in value)
    )
