"""What a scene asks for, what was published about it, and the points that it sketches or draws.

From the tables of a file to the one model of the mechanism: names looked up, points placed, SI units.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import replace

from graphkin.errors import Problem, SceneError, did_you_mean
from graphkin.scene.background import background_of, scans_of
from graphkin.scene.cam_reading import cams_of
from graphkin.scene.cams import LawCam
from graphkin.scene.contacts import PlacedDisc
from graphkin.scene.driving import drives
from graphkin.scene.force_names import no_force
from graphkin.scene.loads import Loading, loading_of
from graphkin.scene.model import Driver, Mechanism, PlacedGuide, PlacedLink
from graphkin.scene.motion_law import MotionLaw
from graphkin.scene.names import Flaws, Names
from graphkin.scene.pairs import islands, pins_in_slots, sliding_pairs, with_bars, with_carriages
from graphkin.scene.placing import (
    DrawnPosition,
    Placement,
    find_position,
    origins_of,
    place_of,
    starts_apart,
    starts_of,
    travel_of,
)
from graphkin.scene.reading import path_name
from graphkin.scene.rules import (
    disagreements,
    not_held,
    nowhere_placed,
    placed_twice,
    too_far_apart,
    unwritable_texts,
    wrong_own_points,
)
from graphkin.scene.stating import asked, loops_named, positions_named, stated_values
from graphkin.scene.tables import Link, SceneTables
from graphkin.scene.touching import contacts_of, discs_of, drawn_apart, gears_of, wrong_distances
from graphkin.words import Phrase

__all__ = ["resolve", "unknown_places"]


def unknown_places(file: SceneTables, names: Names) -> list[Problem]:
    """Sketched and drawn points that no link has."""
    wanted = [(f"{table}.{point}", point) for table in ("sketch", "drawn") for point in getattr(file, table)]
    return [p for where, point in wanted if (p := names.no_point(where, point))]


MOST_LINKS = 200
MOST_POINTS = 100


def resolve(file: SceneTables, name: str, problems: list[Problem], flaws: Flaws) -> Mechanism:
    """Make the scene that a file describes.

    Parameters
    ----------
    file : what is valid in the file
    name : the scene's name
    problems : what was found wrong with the file's form so far
    flaws : what was taken out for it

    Raises
    ------
    SceneError : with everything that is wrong, the form first
    """
    problems = list(problems)
    many = [n for n, link in file.links.items() if len(link.at) + len(link.guides) + len(link.points) > MOST_POINTS]
    if len(file.links) > MOST_LINKS:
        problems.append(
            Problem(
                "links",
                Phrase("found moving links", count=len(file.links)),
                Phrase("at most are possible", limit=MOST_LINKS),
            )
        )
    problems += [
        Problem(f"links.{n}", Phrase("has too many points and guides"), Phrase("at most", most=MOST_POINTS))
        for n in many
    ]
    if many or len(file.links) > MOST_LINKS:
        raise SceneError(*problems)

    metres = file.units.metres
    file, slots = with_bars(with_carriages(file), flaws, problems)
    names = Names.of(file, flaws)
    problems += unwritable_texts(file)
    problems += wrong_own_points(file, names, flaws)
    slidings = sliding_pairs(file, names, flaws, problems)
    pins = pins_in_slots(file, names, slidings, problems)
    discs = discs_of(file, names, problems)
    contacts = contacts_of(file, names, flaws, discs, problems)
    gears = gears_of(file, names, slidings, problems)
    driven = drives(file, names, flaws, slidings, pins, metres, problems)
    problems += unknown_places(file, names)
    find = asked(file, names, problems)
    stated = stated_values(file, names, problems)
    positions = positions_named(file, slidings, pins, metres, problems)
    loops = loops_named(file, names, problems)
    problems += nowhere_placed(file, names, flaws)
    if not names.unsure and not flaws.under("pins") and not any(p[2:] == ("on",) for p in flaws.paths):
        bare = {p.where for p in problems}
        problems += [not_held(group, names) for group in islands(file, names) if f"links.{group[0]}" not in bare]

    drawn = {p: complex(*xy) * metres for p, xy in file.drawn.items()}
    bodies = _bodies(file, names, drawn, metres, flaws, problems)
    referred = {p.on for p in slidings} | {p.on for p in pins}
    referred |= {name for d in driven.values() if d.turns for name in d.links}
    for other in sorted(referred):  # links that were taken out for something wrong are placed nowhere
        bodies.setdefault(other, Placement(other, f"links.{other}", (), {}, {}))
    fixed = bodies[names.frame].local
    told = [d for d in driven.values() if not math.isnan(d.value)]
    position = DrawnPosition(
        bodies,
        fixed,
        drawn,
        slidings,
        pins,
        tuple((*d.links, cmath.rect(1.0, d.value)) for d in told if d.turns),
        {d.key: d.value for d in told if not d.turns},
        metres,
        _size(bodies, drawn, metres),
        problems,
    )
    find_position(position)
    problems += placed_twice(position)
    if not problems:
        problems += starts_apart(file, position)
    if not problems and drawn:
        problems += disagreements(position)
        problems += drawn_apart(contacts, bodies, position.places, position.tolerance, metres)
    if not problems:
        problems += _not_found(position)
        problems += too_far_apart(position)
    cams = _cams(file, names, flaws, position, problems) if file.cams else ()
    if not problems:
        places, rails = {n: b.local for n, b in bodies.items()}, {n: b.guides for n, b in bodies.items()}
        problems += wrong_distances(contacts, gears, slidings, places, rails, metres)
    loading = Loading()
    if file.masses or file.loads or file.springs or file.balance or file.flywheel:
        places = {n: b.local for n, b in bodies.items()}
        loading = loading_of(file, names, places, (*(s.key for s in slidings), *(p.key for p in pins)), problems)
    under = background_of(file.sheet.background, fixed, drawn, problems) if file.sheet.background else None
    scans = scans_of(file.scans, problems)
    hopeless = bool(problems) and (bool(drawn) or flaws.under("drawn"))
    drivers = [_driver(where, d, position, [] if hopeless else problems) for where, d in driven.items()]
    if positions is not None and drivers and drivers[0].turns and drivers[0].position:
        drivers[0] = positions.placed(drivers[0])
    if problems:
        raise SceneError(*dict.fromkeys(problems))
    links = tuple(_link(n, t, bodies[n], discs) for n, t in file.links.items())
    outlines = tuple(d for d in discs.values() if d.link == names.frame)
    frame = PlacedLink(names.frame, fixed, (), _guides(bodies[names.frame]), discs=outlines)
    title = file.title or name
    made = Mechanism(
        name,
        title,
        frame,
        links,
        slidings,
        pins,
        tuple(drivers),
        file.units,
        file.title_zh,
        file.source,
        {p: complex(*xy) * metres for p, xy in file.sketch.items()},
        drawn,
        find,
        file.sheet,
        loading,
        stated,
        positions,
        loops,
        file.vary,
        dict(file.grading),
        cams,
        contacts=contacts,
        gears=gears,
        starts=starts_of(file, position, contacts) if contacts or gears else {},
        slots=slots,
        source_zh=file.source_zh,
        background=under,
        scans=scans,
        written=file,
    )
    _ask_for_forces(made)
    return made


def _ask_for_forces(made: Mechanism) -> None:
    """Raises SceneError for symbols of forces that the mechanism does not have."""
    asked = [("find", made.find), *(("printed", tuple(own.values)) for own in made.stated)]
    wrong = (no_force(made, path_name((table, str(symbol))), symbol) for table, symbols in asked for symbol in symbols)
    problems = [problem for problem in wrong if problem is not None]
    if problems:
        raise SceneError(*dict.fromkeys(problems))


def _cams(
    file: SceneTables, names: Names, flaws: Flaws, position: DrawnPosition, problems: list[Problem]
) -> tuple[LawCam, ...]:
    """The cams, with the lines of the frame on which followers slide."""
    frame = position.bodies[names.frame]
    rails = {s.link: (s, frame.guides.get(s.guide)) for s in position.slidings if s.on == names.frame}
    lines = {name: (s.key, rail.through, rail.direction) for name, (s, rail) in rails.items() if rail is not None}
    seen = {p: complex(*xy) * position.metres for p, xy in file.sketch.items()} | dict(position.drawn)
    return cams_of(file, names, flaws, lines, frame.local, seen, problems)


def _bodies(
    file: SceneTables, names: Names, drawn: Mapping[str, complex], metres: float, flaws: Flaws, problems: list[Problem]
) -> dict[str, Placement]:
    """Every link with its own points placed, where its length is known."""
    fixed = _fixed(file, metres, problems)
    given = {**drawn, **fixed}
    bodies: dict[str, Placement] = {}
    for name, table in file.links.items():
        own = tuple(table.points) if len(set(table.points)) == len(table.points) <= 2 else tuple(table.points[:1])
        body = Placement(name, f"links.{name}", own, table.at, table.guides)
        body.guides[""] = PlacedGuide("", 0j, 1 + 0j)
        body.local |= dict.fromkeys(own[:1], 0j)
        if len(own) == 2:
            body.length = table.length * metres if table.length is not None else None
            if body.length is None and own[0] in given and own[1] in given:
                body.length = abs(given[own[1]] - given[own[0]])
                if body.length == 0.0:
                    problems.append(
                        Problem(
                            f"links.{name}",
                            Phrase("and are given at the same place", name=own[0], other=own[1]),
                            Phrase("a bar has two points apart"),
                        )
                    )
            if body.length is not None:
                body.local[own[1]] = complex(body.length)
            elif not flaws.under("links", name, "length") and not flaws.under("drawn"):
                problems.append(_no_length(name, own, given))
        bodies[name] = body
    frame = Placement(names.frame, "frame", (), {}, file.frame.guides)
    frame.local, frame.turn, frame.origin = dict(fixed), 1 + 0j, 0j
    frame.guides[""] = PlacedGuide("", 0j, 1 + 0j)
    return {**bodies, names.frame: frame}


def _fixed(file: SceneTables, metres: float, problems: list[Problem]) -> dict[str, complex]:
    """The places of the frame's points (m), those given from others too."""
    given = file.frame.points
    found: dict[str, complex] = {}
    left = dict(given)
    while left:
        where = {p: place_of(f"frame.points.{p}", entry, metres, found) for p, entry in left.items()}
        placed = {p: z for p, z in where.items() if z is not None}
        problems += [z for z in placed.values() if isinstance(z, Problem)]
        if not placed:
            for point, entry in left.items():
                missing = next(p for p in origins_of(entry) if p not in found)
                known = (
                    Phrase("the points are placed from one another")
                    if missing in given
                    else did_you_mean(missing, given)
                )
                said = (
                    Phrase("has no place yet", missing=missing)
                    if missing in given
                    else Phrase("the frame has no point", missing=missing)
                )
                problems.append(Problem(f"frame.points.{point}", said, known))
            placed = dict.fromkeys(left, 0j)
        found |= {p: 0j if isinstance(z, Problem) else z for p, z in placed.items()}
        left = {p: entry for p, entry in left.items() if p not in placed}
    return {p: found[p] for p in given}


def _no_length(name: str, own: tuple[str, ...], given: Mapping[str, complex]) -> Problem:
    undrawn = " and ".join(p for p in own if p not in given)
    return Problem(
        f"links.{name}.length", Phrase("is missing"), Phrase("write length or give in drawn", undrawn=undrawn)
    )


def _size(bodies: Mapping[str, Placement], drawn: Mapping[str, complex], metres: float) -> float:
    """The largest distance that the file gives (m)."""
    fixed = [z for b in bodies.values() if b.where == "frame" for z in b.local.values()]
    spans = [b.length for b in bodies.values() if b.length]
    spans += [abs(complex(*e)) * metres for b in bodies.values() for e in b.at.values() if isinstance(e, list)]
    spans += [abs(a - b) for a in (*fixed, *drawn.values()) for b in fixed]
    return max(spans, default=0.0) or metres


def _not_found(position: DrawnPosition) -> list[Problem]:
    """Points, guides that need the position of their link, where it does not follow from what is drawn."""
    found = []
    for body in position.bodies.values():
        hint = Phrase("draw two points of link or give it", body=body.name)
        why = Phrase("where link lies does not follow from what", body=body.name)
        open_ = [f"at.{point}" for point in body.at if point not in body.local]
        open_ += [f"guides.{guide}" for guide in body.rails if guide not in body.guides]
        found += [Problem(f"{body.where}.{key}", why, hint) for key in open_]
    return found


def _driver(where: str, driver: Driver, position: DrawnPosition, problems: list[Problem]) -> Driver:
    """The driver with its value, taken from the drawn points where the file leaves it out."""
    if driver.position:  # its value is found where the positions are known
        return replace(driver, value=0.0)
    value = driver.value
    if math.isnan(value) and not driver.turns:
        travel = travel_of(position, driver.key)
        value = value if travel is None else travel
    elif math.isnan(value):
        driven, base = (position.bodies.get(name) for name in driver.links)
        if driven and base and driven.turn is not None and base.turn is not None:
            value = cmath.phase(driven.turn / base.turn)
    if not math.isnan(value):
        driver = replace(driver, value=value)
        return driver if driver.law is None else _by_law(where, driver, driver.law, position.metres, problems)
    if driver.turns:
        key, wanted = "angle", Phrase("write angle in degrees or draw two points", key=driver.key)
    else:
        key, wanted = "travel", Phrase("write travel or draw the points that give")
    if driver.law is not None:
        wanted = Phrase(f"write time in s or the {key}")
    problems.append(Problem(f"{where}.{key}", Phrase("is missing"), wanted))
    return driver


def _by_law(where: str, driver: Driver, law: MotionLaw, metres: float, problems: list[Problem]) -> Driver:
    """The driver with the rates that its law gives it where it stands: at the moment that is asked, else at the first
    at which it comes there."""
    if abs(law.at(law.time).lift - driver.value) > 1e-12 * max(map(abs, law.span)):
        time = law.reached(driver.value)
        if time is None:
            unit, what = (math.pi / 180, "angle") if driver.turns else (metres, "travel")
            low, high = (f"{end / unit:.6g}" for end in law.span)
            found = Phrase("found value", value=f"{driver.value / unit:.6g}")
            wanted = Phrase("the law goes from to", least=low, greatest=high, turns=" deg" * driver.turns)
            problems.append(Problem(f"{where}.{what}", found, wanted))
            return driver
        law = replace(law, time=time)
    return driver.moving(law)


def _guides(body: Placement) -> dict[str, PlacedGuide]:
    return {"": body.guides[""], **{name: body.guides[name] for name in body.rails}}


def _link(name: str, table: Link, body: Placement, discs: Mapping[tuple[str, str], PlacedDisc]) -> PlacedLink:
    order = dict.fromkeys((*body.own, *table.at))
    outlines = tuple(d for d in discs.values() if d.link == name)
    return PlacedLink(name, {p: body.local[p] for p in order}, body.own, _guides(body), table.redundant, outlines)
