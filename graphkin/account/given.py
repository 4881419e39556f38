"""The given data of a problem, for sheets, papers and force pages alike: drivers, starts of rolling, lengths, teeth,
the shapes of links, fixed points and guides, masses, loads and springs.

A shape is the part of a link's form that the distances of its points do not give: its guides, its angle to the guide on
which it slides, and further points of links without two points of their own.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import replace
from functools import reduce

from graphkin.account.headings import number, term
from graphkin.account.notation import Notation, force_letters
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.forces.position import DrawnPosition
from graphkin.plane import degrees
from graphkin.scene.drivers import moment_of
from graphkin.scene.model import Driver, LoadOn, Mechanism, PlacedLink, SpringOn
from graphkin.scene.pairs import Pair, PlacedGuide
from graphkin.scene.scene_tables import LoadPhase
from graphkin.scene.symbol import Symbol
from graphkin.structure import Driven, RollingRelation
from graphkin.words import Neutral, Phrase, Wording, languages, listed, rich_text, say
from graphkin.words.symbols import RichText, Words, rate, sign, spaced
from graphkin.words.written import as_given, printed

LEVEL = 1e-9  # of directions and of lengths by the size of a scene: what rounding leaves
NO_LENGTH = 1e-12  # of the mechanism's size: what is shorter are two points that fall together

# drivers


def given_drivers(sheet: Sheet, letters: Notation) -> list[RichText]:
    """The moment, and values of drivers with their rates."""
    scene = sheet.scene
    moment = moment_of(scene)
    lines = [] if moment is None else [sign("t") + f" = {number(moment)} s"]
    for driver in scene.drivers:
        lines.append(_stands(sheet, driver, sheet.drivers[driver.key]))
        if driver.turns and driver.rpm is not None and math.isclose(driver.rpm * math.pi / 30, driver.rate):
            lines.append(sign("n", _index(sheet, driver)) + f" = {number(driver.rpm)} r/min")
        for kind, value in zip(("omega", "alpha") if driver.turns else ("v", "a"), driver.values[1:], strict=True):
            unit = Symbol(kind, link=driver.link).unit(scene.units)
            if value or kind in ("omega", "v"):
                letter = kind.upper() if letters.convention == "us" else kind
                name = (rate if driver.turns else sign)(kind if driver.turns else letter, _index(sheet, driver))
                lines.append(name + f" = {unit.beside(number(unit.of(value)))}")
    return lines


def drivers(sheet: Sheet, letters: Notation) -> RichText:
    """The drivers with their rates in one line."""
    return spaced(",  ", given_drivers(sheet, letters))


def rolling_starts(sheet: Sheet) -> list[RichText]:
    """The starts of links that move each other by rolling, at the scene's position: ``φ_3 = 60° (φ_1 = 50°)``."""
    scene, parts = sheet.scene, []
    starts = [_stands(sheet, driver, driver.values[0]) for driver in scene.drivers]
    for group in sheet.structure.elements:
        for driver in group.starts:
            value = driver.values[0]
            if driver.turns:  # from what never turns
                value = cmath.phase(sheet.poses[driver.relative_to].axis * cmath.rect(1.0, value))
                driver = replace(driver, relative_to=scene.frame.name)
            parts.append(_stands(sheet, driver, value) + " (" + spaced(", ", starts) + ")")
    return parts


def rolled_starts(sheet: Sheet) -> list[RichText]:
    """The starts of links that only follow by rolling, as in `rolling_starts`; none of a wheel with only its axis."""
    scene = sheet.scene
    starts = spaced(", ", (_stands(sheet, driver, driver.values[0]) for driver in scene.drivers))
    lines = []
    for element in sheet.structure.elements:
        if not isinstance(element, Driven):
            continue
        driver = element.driver
        if isinstance(driver, RollingRelation):
            slide = "" if driver.turns else driver.key
            driver = Driver(element.link, scene.frame.name, driver.start, 0.0, 0.0, slide=slide)
        elif not isinstance(driver, Driver) or not driver.ratios:
            continue
        if not driver.turns or len(sheet.structure.links[element.link].points) > 1 or _axis_counts(
            scene.whole, scene.by_name[element.link]
        ):
            lines.append(_stands(sheet, driver, driver.value) + " (" + starts + ")")
    return lines


def _stands(sheet: Sheet, driver: Driver, value: float) -> RichText:
    unit = sheet.scene.unit_of(driver)
    return sign("φ" if driver.turns else "s", _index(sheet, driver)) + f" = {unit.beside(number(unit.of(value)))}"


def _index(sheet: Sheet, driver: Driver) -> str:
    if driver.slide:
        return slide_index(sheet, driver.slide)
    return driver.link if driver.turns_about(sheet.scene.frame.name) else driver.link + driver.relative_to


def slide_index(sheet: Sheet, key: str) -> str:
    """The index of a sliding pair's travel: the sliding link, and the guiding link unless it is the frame."""
    sliding, guiding = key.split("/")
    return sliding if guiding == sheet.scene.frame.name else sliding + guiding


# lengths, teeth and the frame


def given_lengths(scene: Mechanism, letters: Notation) -> list[tuple[RichText, str]]:
    """The given lengths of all links: symbol and value in the scene's unit, as it is given."""
    lengths: list[tuple[RichText, float]] = []
    for link in scene.links:
        if link.length is not None:
            lengths.append((letters.length(link.bar), link.length / scene.units.metres))
        lengths += _further(link, scene, letters)
    metres = scene.units.metres
    discs = (disc for link in (*scene.links, scene.frame) for disc in link.discs.items())
    lengths += [(sign("r", name), abs(disc.r) / metres) for name, disc in discs]
    least = NO_LENGTH * scene.size / metres
    return [(name, printed(as_given(length))) for name, length in lengths if length > least]


def given_teeth(scene: Mechanism, language: str) -> list[RichText]:
    """The numbers of teeth, each wheel once; with its gear where it has several.  Internal teeth are marked."""
    wheels: dict[str, RichText] = {}
    for gear in scene.gears:
        for wheel, teeth in zip(gear.bodies, gear.teeth, strict=True):
            if teeth is None:
                continue
            said = sign("z", wheel) + f" = {number(abs(teeth))}"
            if teeth < 0:
                said += say(Phrase("in brackets", words=term("internal", language)), languages(language)[0])
            if wheels.setdefault(wheel, said) != said:
                wheels[f"{wheel} {gear.name}"] = said + f" ({gear.name})"
    return list(wheels.values())


def _further(link: PlacedLink, scene: Mechanism, letters: Notation) -> list[tuple[RichText, float]]:
    """Distances of the further points of a link from those of its bar."""
    beside = off_its_guide(scene, link) if len(link.bar) < 2 and along_its_guide(scene, link) else []
    more = [p for p in link.points if p not in (*link.bar, *beside)]
    return [
        (letters.length((start, p)), abs(link.points[p] - link.points[start]) / scene.units.metres)
        for p in more
        for start in link.bar
    ]


def fixed_guides(scene: Mechanism, letters: Notation) -> list[tuple[RichText, str, str]]:
    """The named guides of the frame: symbol, coordinates of a point (scene unit) in brackets, direction (degrees)."""
    return [
        (letters.guide(guide.name, scene.frame.name), place_of(guide.through, scene),
         number(degrees(guide.direction)))
        for guide in scene.frame.guides.values() if guide.name
    ]


def place_of(z: complex, scene: Mechanism) -> str:
    """The coordinates of a place (m) in the scene's unit, in brackets."""
    least = LEVEL * scene.size
    x, y = ((part if abs(part) > least else 0.0) / scene.units.metres for part in (z.real, z.imag))
    return f"({number(x)}, {number(y)})"


# shapes of links


def given_shapes(scene: Mechanism, letters: Notation, language: str) -> list[RichText]:
    """The shapes of links as short phrases: ``guide s on 3: 140 mm from C, 90° to x``.

    Angles are those of lines, from -90 to 90 degrees, counter-clockwise positive; places are along the guide on which
    the link slides and to the left of it.  Pins and blocks in circular slots come last.
    """
    whole = scene.whole
    phrases = [phrase for link in whole.links if not link.redundant for phrase in _shape(whole, link, letters)]
    for slot in whole.slots:
        centre, point = letters.point(slot.centre), letters.point(slot.point)
        key, bar = "block on circle" if slot.block else "pin on circle", letters.bar((slot.centre, slot.point))
        runs = {"point": point, "link": slot.of or slot.bar, "on": slot.on, "centre": centre}
        phrases.append(Phrase(key, **runs, **({} if slot.block else {"bar": bar, "name": slot.bar})))
    shapes = ((rich_text(phrase, each) for each in languages(language)) for phrase in phrases)
    return [spaced(" ", dict.fromkeys(shape)) for shape in shapes]


def _shape(scene: Mechanism, link: PlacedLink, letters: Notation) -> Iterator[Phrase]:
    pairs = along_its_guide(scene, link)
    axis, turn = _axis(scene, link, letters), _turn(scene, link)
    if len(pairs) == 2:
        first, second = (_guide_name(scene, pair, letters) for pair in pairs)
        angle = number(as_line(pairs[0].turn / pairs[1].turn))
        yield Phrase("guides at angle", first=first, second=second, angle=angle)
    elif pairs and (len(link.bar) == 2 or _carries_its_axis(scene, link)) and abs(pairs[0].turn.imag) > LEVEL:
        line = axis if len(link.bar) == 2 else Phrase("axis of", link=link.name)
        held_to = _guide_name(scene, pairs[0], letters)
        yield Phrase("held at angle", bar=line, angle=number(as_line(pairs[0].turn)), axis=held_to)
    beside = off_its_guide(scene, link) if len(link.bar) < 2 else []
    if not pairs and len(link.points) <= 2 and not _axis_counts(scene, link):
        beside = []
    for point in beside:
        z = link.points[point]
        name = letters.point(point)
        if pairs:
            yield Phrase("point along", point=name, **_along(scene, link, z, letters))
        else:
            bar = letters.bar((link.bar[0], point)) if link.bar else name
            yield Phrase("held at angle", bar=bar, angle=number(degrees(z)), axis=axis)
    guides = used_guides(scene, link)
    alone = not pairs and len(link.bar) < 2 and len(guides) == 1 and not beside and not _carries_its_axis(scene, link)
    for guide in guides:
        name = letters.guide(guide.name, scene.frame.name)
        angle = number(as_line(guide.direction * turn))
        on = next((p for p, z in link.points.items() if abs(z - guide.through) < LEVEL * scene.size), None)
        if alone and on is not None:  # what its angle counts from is nothing else's
            yield Phrase("guide on link only through", guide=name, link=link.name, point=letters.point(on))
        elif on is None and abs(guide.through) < LEVEL * scene.size:
            yield Phrase("guide on link", guide=name, link=link.name, angle=angle, axis=axis)
        elif on is not None:
            through = letters.point(on)
            yield Phrase("guide on link through", guide=name, link=link.name, point=through, angle=angle, axis=axis)
        else:
            at = _along(scene, link, guide.through, letters)
            yield Phrase("guide on link at", guide=name, link=link.name, **at, angle=angle)


def along_its_guide(scene: Mechanism, link: PlacedLink) -> list[Pair]:
    """The sliding pairs in which a link slides on others."""
    return [pair for pair in scene.slidings if pair.a == link.name]


def off_its_guide(scene: Mechanism, link: PlacedLink) -> list[str]:
    """Further points of a link off its own axis."""
    return [p for p, z in link.points.items() if p not in link.bar and abs(z.imag) > LEVEL * scene.size]


def used_guides(scene: Mechanism, link: PlacedLink) -> list[PlacedGuide]:
    """The guides of a link besides its own axis that are used by a slide or a contact."""
    used = {guide for on, guide in _ridden(scene) if on == link.name}
    used |= {contact.guide for contact in scene.contacts if contact.face == link.name}
    return [guide for name, guide in link.guides.items() if name and name in used]


def as_line(direction: complex) -> float:
    """The angle of a line (degrees), above -90 to 90."""
    angle = degrees(direction)
    return 90.0 if abs(abs(angle) - 90.0) < 1e-9 else math.remainder(angle, 180.0) + 0.0


def _carries_its_axis(scene: Mechanism, link: PlacedLink) -> bool:
    """Whether a link or a pin slides on a link's own axis."""
    return (link.name, "") in _ridden(scene)


def _ridden(scene: Mechanism) -> set[tuple[str, str]]:
    """The guides on which links or pins slide, with the links that have them."""
    return {(s.b, s.guide.name) for s in scene.slides}


def _axis_counts(scene: Mechanism, link: PlacedLink) -> bool:
    """Whether any given angle or place counts from a link's own axis."""
    turned = any(link.name in d.links for d in scene.drivers if d.turns)
    return turned or _carries_its_axis(scene, link) or bool(used_guides(scene, link))


def _guide_name(scene: Mechanism, pair: Pair, letters: Notation) -> Words:
    if pair.guide.name:
        return letters.guide(pair.guide.name, scene.frame.name)
    return sign("x") if pair.b == scene.frame.name else _own(scene.by_name[pair.b], letters)


def _own(link: PlacedLink, letters: Notation) -> Words:
    """The own axis of a link: its bar, else its number."""
    return letters.bar(link.bar) if len(link.bar) == 2 else link.name


def _axis(scene: Mechanism, link: PlacedLink, letters: Notation) -> Wording:
    """The line from which angles on a link count: its bar, the guide on which it slides, else its own axis."""
    if len(link.bar) == 2:
        return _own(link, letters)
    pairs = along_its_guide(scene, link)
    return _guide_name(scene, pairs[0], letters) if pairs else Phrase("axis of", link=link.name)


def _turn(scene: Mechanism, link: PlacedLink) -> complex:
    """The direction of a link's own axis from that line."""
    pairs = along_its_guide(scene, link)
    return pairs[0].turn if pairs and len(link.bar) < 2 else 1.0 + 0j


def _along(scene: Mechanism, link: PlacedLink, z: complex, letters: Notation) -> dict[str, Wording]:
    """A place in a link's own axes (m): along that line and to the left of it, and the origin."""
    place = f"{place_of(z * _turn(scene, link), scene)} {scene.units.length}"
    origin = letters.point(link.bar[0]) if link.bar else f"({link.name})"
    return {"place": place, "origin": origin, "axis": _axis(scene, link, letters)}


# masses, loads and springs


def given_loads(sheet: Sheet, letters: Notation) -> list[Phrase]:
    """A line for each kind: masses, weights (with their direction unless down), inertias, loads, springs, balance."""
    scene, loading = sheet.scene, sheet.scene.loading
    masses, aslant = list(_masses(scene, letters)), degrees(loading.gravity or -1j)
    balance = loading.balance
    balances = dict.fromkeys(DrawnPosition(sheet).balance(driver).symbol for driver in scene.drivers)
    return [
        *([reduce(lambda first, second: Phrase("given masses", first=first, second=second), masses)] if masses else []),
        *([Phrase("given weights", angle=number(aslant, 5))] if masses and abs(aslant + 90.0) > LEVEL else []),
        *(_load(scene, load, letters) for load in loading.loads),
        *(_spring_given(scene, spring, letters) for spring in loading.springs),
        Phrase("given balance", forces=listed([force_letters(letters.convention, force) for force in balances])),
        *([_load(scene, balance, letters)] if balance is not None and balance.is_force else []),
    ]


def _masses(scene: Mechanism, letters: Notation) -> Iterator[Phrase]:
    units, loading = scene.units, scene.loading
    for mass in loading.masses:
        said = sign("m", mass.link) + f" = {number(mass.mass / units.kilograms, 5)} {units.mass}"
        if loading.gravity:
            weight, unit = mass.mass * abs(loading.gravity), units.of("force")
            name = force_letters(letters.convention, Symbol("G", link=mass.link))
            said += ", " + name + f" = {unit.beside(number(unit.of(weight), 5))}"
        if mass.inertia:
            unit = units.of("inertia")
            said += ", " + sign("J", mass.link) + f" = {unit.beside(number(unit.of(mass.inertia), 5))}"
        yield Phrase("given mass", mass=Neutral(said), point=_place_on(scene, mass.link, mass.at, letters))


def _place_on(scene: Mechanism, name: str, at: complex, letters: Notation) -> Wording:
    """A place in a link's own axes (m): the point that lies there, else along the link's axis and to the left of it."""
    link = scene.by_name[name]
    point = next((p for p, z in link.points.items() if z == at), "")
    return letters.point(point) if point else Phrase("place along", **_along(scene, link, at, letters))


def _load(scene: Mechanism, load: LoadOn, letters: Notation) -> Phrase:
    """The given data of a load; of the balancing load, whose size is sought, its line."""
    unit, name = load.symbol.unit(scene.units), force_letters(letters.convention, load.symbol)
    size = Neutral(name, f" = {unit.beside(number(unit.of(load.size)))}") if load.name else name
    return load_given(scene, load, size, letters)


def load_given(scene: Mechanism, load: LoadOn, size: Wording, letters: Notation) -> Phrase:
    """Where a load of some size acts, its direction, and when."""
    gaps = {"size": size, "link": load.link, "point": _place_on(scene, load.link, load.at, letters)}
    if not load.is_force:
        said = Phrase("given moment", size=size, link=load.link)
    elif load.against:
        said = Phrase("given against", **gaps, slide=load.against)
    else:
        angle = number(degrees(load.turn), 5)
        key = "given following" if load.follows else "given force"
        said = Phrase(key, **gaps, angle=angle, other=load.follows)
    return said if load.phase is None else Phrase("given while", load=said, phase=_phase(scene, load.phase))


def _phase(scene: Mechanism, phase: LoadPhase) -> Phrase:
    if phase.stroke:
        key = "given on stroke" if phase.sense > 0 else "given on stroke back"
        return Phrase(key, slide=phase.stroke, start=number(phase.start), end=number(phase.end))
    unit = scene.unit_of(scene.drivers[0])
    start, end = (number(unit.of(value)) for value in (phase.start, phase.end))
    start = unit.beside(start) if scene.drivers[0].turns else start
    return Phrase("given while driver", start=start, end=unit.beside(end))


def _spring_given(scene: Mechanism, spring: SpringOn, letters: Notation) -> Phrase:
    """The given data of a spring, in words with symbols."""
    numbers = {gap: Neutral(f"{number(value)} {unit}") for gap, (value, unit) in spring.numbers(scene.units).items()}
    ends = dict(zip(("point", "other_point"), map(letters.point, spring.points), strict=True))
    name = force_letters(letters.convention, spring.symbol)
    return Phrase(f"given {spring.kind}", **{**spring.gaps, **ends}, **numbers, force=name)


