"""The reading of a scene file: the mechanism of its tables, or all their problems; and the file of a mechanism.

The docstring of `graphkin.scene` settles the points that the format leaves open.
"""

from __future__ import annotations

import dataclasses
import unicodedata
from collections.abc import Iterable
from typing import TypeVar

from graphkin.errors import Problem, SceneError
from graphkin.files import OwnTables
from graphkin.plane import degrees
from graphkin.scene import position as places
from graphkin.scene.asked import asked, at_its_position, loops_named, positions_named, stated_values
from graphkin.scene.bodies import (
    Reading,
    check_held,
    check_own_points,
    check_references,
    driver_tables,
    pins_in_slots,
    sliding_pairs,
    with_bars,
    with_carriages,
)
from graphkin.scene.drivers import drives, placed_driver, stated_driver
from graphkin.scene.loads import loading_of
from graphkin.scene.model import Loading, Mechanism, PlacedLink, Question, no_force
from graphkin.scene.pairs import LawCam
from graphkin.scene.pictures import background_of, scans_of
from graphkin.scene.scene_tables import Frame, Guide, Link, SceneTables
from graphkin.scene.tables import KeyPath, path_name, plain, tidy
from graphkin.scene.touching import cams_of, contacts_of, discs_of, gears_of, wrong_distances

MOST_LINKS = 200
MOST_POINTS = 100
AnyBody = TypeVar("AnyBody", Link, Frame)


# -- what a file says --------------------------------------------------------------------------------------------------


def mechanism_said(file: SceneTables, name: str, problems: list[Problem], lost: frozenset[KeyPath]) -> Mechanism:
    """The mechanism that a file describes.

    Parameters
    ----------
    file : the valid part of the file
    name : the scene's name
    problems : the problems of the file's form
    lost : the paths of the entries taken out for them

    Raises
    ------
    SceneError : with all problems, those of the form first
    """
    reading = Reading(file, lost, list(problems), file.frame, file.links, file.pins)
    problems, metres = reading.problems, reading.metres
    _refuse_too_much(file, problems)
    _check_texts(reading)
    reading = with_bars(with_carriages(reading))
    check_own_points(reading)
    reading = dataclasses.replace(reading, slides=sliding_pairs(reading))
    reading = dataclasses.replace(reading, slides=(*reading.slides, *pins_in_slots(reading)))
    discs = discs_of(reading) if any(body.discs for _, _, body in reading.bodies) else {}
    contacts = contacts_of(reading, discs) if file.contacts else ()
    gears = gears_of(reading) if file.gears else ()
    for table in ("sketch", "drawn"):
        reading.wrong(*(reading.no_point(f"{table}.{point}", point) for point in getattr(file, table)))
    check_references(reading)
    places.check_rolling(reading)
    find = asked(reading) if file.find else ()
    stated = stated_values(reading) if file.printed or file.printed_rows or file.printed_table else ()
    positions = positions_named(file.positions, reading) if file.positions else None
    loops = loops_named(reading) if file.loops else {}
    check_held(reading)
    driven = drives(reading)
    position = places.stated_position(reading, driven.values())
    places.check_placed_twice(position)
    if not problems:
        places.check_starts(position)
    if not problems and position.drawn:
        places.check_agreement(position)
        places.check_contacts(contacts, position)
    if not problems:
        places.check_all_found(position)
        places.check_distances(position)
    reading = dataclasses.replace(reading, places={name: body.local for name, body in position.bodies.items()})
    cams = _cams(reading, position) if file.cams else ()
    if (contacts or gears) and not problems:
        wrong_distances(contacts, gears, {n: b.guides for n, b in position.bodies.items()}, reading)
    acting = file.masses or file.loads or file.springs or file.balance or file.flywheel
    loading = loading_of(reading) if acting else Loading()
    wish = file.sheet.background
    under = background_of(wish, {**position.drawn, **reading.places[reading.frame.name]}, reading) if wish else None
    scans = scans_of(reading) if file.scans else ()
    values = [position.value_of(driver) for driver in driven.values()]
    tables = () if problems else ((reading.frame.name, None), *reading.links.items())
    bodies = [position.placed(link_name, discs, link) for link_name, link in tables]
    drivers = [placed_driver(*at, value, reading) for at, value in zip(driven.items(), values, strict=True)]
    if positions is not None and drivers and drivers[0].turns and drivers[0].position:
        drivers[0] = at_its_position(drivers[0], positions)
    if problems:
        raise SceneError(*dict.fromkeys(problems))
    question = Question(
        title=file.title or name, title_zh=file.title_zh, source=file.source, source_zh=file.source_zh, find=find,
        sheet=file.sheet, stated=stated, positions=positions, loops=loops, vary=file.vary, grading=dict(file.grading),
        background=under, scans=scans, written=file,
    )  # fmt: skip
    made = Mechanism(
        name=name, frame=bodies[0], links=tuple(bodies[1:]), slides=reading.slides, drivers=tuple(drivers),
        units=file.units,
        sketch={p: complex(*place) * metres for p, place in file.sketch.items()}, drawn=position.drawn,
        loading=loading, cams=cams, contacts=contacts, gears=gears,
        starts=places.starts_of(position, contacts) if contacts or gears else {}, slots=reading.slots,
        question=question,
    )  # fmt: skip
    if find or stated:
        _check_forces(made)
    return made


def _refuse_too_much(file: SceneTables, problems: list[Problem]) -> None:
    """Raises SceneError for a file with too many links, or too many points of a link."""
    before = len(problems)
    if len(file.links) > MOST_LINKS:
        problems.append(Problem("links", "found moving links", "at most are possible", count=len(file.links),
                                limit=MOST_LINKS))
    for name, link in file.links.items():
        if len(link.at) + len(link.guides) + len(link.points) > MOST_POINTS:
            problems.append(Problem(f"links.{name}", "has too many points and guides", "at most", most=MOST_POINTS))
    if len(problems) > before:
        raise SceneError(*problems)


def _check_texts(reading: Reading) -> None:
    """Note texts that cannot be written on one line of a sheet."""
    for where in ("title", "title_zh", "source", "source_zh"):
        if any(unicodedata.category(c) in ("Cc", "Cs", "Cn", "Zl", "Zp") for c in getattr(reading.file, where)):
            reading.say(where, "holds a control character or a line break", "write one line of plain text")


def _check_forces(made: Mechanism) -> None:
    """Raises SceneError for symbols of forces that the mechanism does not have."""
    wanted = [("find", made.question.find), *(("printed", tuple(stated.values)) for stated in made.question.stated)]
    wrong = (no_force(made, path_name((table, str(symbol))), symbol) for table, symbols in wanted for symbol in symbols)
    problems = [problem for problem in wrong if problem is not None]
    if problems:
        raise SceneError(*dict.fromkeys(problems))


def _cams(reading: Reading, position: places.StatedPosition) -> tuple[LawCam, ...]:
    """The cams, with the lines of the frame on which followers slide."""
    frame, file = position.bodies[reading.frame.name], reading.file
    rails = {s.link: (s.key, frame.guides.get(s.guide)) for s in reading.slides if s.on == frame.name}
    lines = {name: (pair, rail.through, rail.direction) for name, (pair, rail) in rails.items() if rail is not None}
    seen = {p: complex(*place) * reading.metres for p, place in file.sketch.items()} | dict(position.drawn)
    return cams_of(reading, lines, seen)


# -- what says a mechanism ---------------------------------------------------------------------------------------------


def as_mapping(scene: Mechanism) -> OwnTables:
    """The mapping of a scene file of this mechanism: the file that it was read from, with its drivers as they are now
    and all places in the links' own axes.

    Drawn points, arcs and polar entries become lengths and places.
    """
    file = scene.question.written
    assert file is not None  # a mechanism is made by reading
    held = {contact.round[0].centre for contact in scene.contacts if contact.rolling and contact.flat}
    sketch = {point: z for point, z in {**scene.drawn, **scene.sketch}.items() if point not in scene.frame.points}
    tables = driver_tables(file).values()
    drivers = [stated_driver(*pair, scene.units) for pair in zip(tables, scene.drivers, strict=False)]
    made = plain(dataclasses.replace(
        file, driver=drivers, frame=_body(scene, scene.frame, file.frame, file.frame.points, "points"),
        links={name: _link(scene, scene.by_name[name], table) for name, table in file.links.items()
               if name in scene.by_name},
        sketch={point: _place(scene, z) for point, z in sketch.items()},
        drawn={point: place for point, place in file.drawn.items() if point in held},
    ))  # fmt: skip
    head: OwnTables = {}
    for text in ("title", "title_zh", "source", "source_zh", "find"):
        if text in made:
            head[text] = made.pop(text)
    return {**head, "units": {"length": scene.units.length, **made.pop("units", {})}, **made}  # always with its unit


def _link(scene: Mechanism, link: PlacedLink, table: Link) -> Link:
    """The table of a link with all its places in its own axes; of a rolling link with its start."""
    pairs = [pair for pair in scene.slidings if pair.link == link.name]
    start, angle_on = table.start, table.angle_on
    if scene.gears or any(contact.rolling for contact in scene.contacts):
        begun = scene.starts.get(pairs[0].key if pairs else link.name)
        start = None if begun is None else tidy(scene.units.of("length" if pairs else "angle").of(begun))
    if angle_on is None and len(pairs) == 1 and pairs[0].turn != 1.0:  # as it was drawn
        angle_on = tidy(degrees(pairs[0].turn))
    length = None if link.length is None else tidy(link.length / scene.units.metres)
    made = dataclasses.replace(table, points=list(link.bar), length=length, angle_on=angle_on, start=start)
    return _body(scene, link, made, [point for point in (*table.points, *table.at) if point not in link.bar], "at")


def _body(scene: Mechanism, link: PlacedLink, table: AnyBody, points: Iterable[str], key: str) -> AnyBody:
    """The table of a link or the frame with these points, under a key, and its straight guides placed."""
    guides = {name: guide for name, guide in link.guides.items() if name}
    straight = {name: Guide(_place(scene, g.through), tidy(degrees(g.direction))) for name, g in guides.items()}
    placed = {point: _place(scene, link.points[point]) for point in points}
    return dataclasses.replace(table, guides={**table.guides, **straight}, **{key: placed})  # type: ignore[arg-type]


def _place(scene: Mechanism, z: complex) -> list[float]:
    """A place in the scene's unit of length."""
    return [tidy(part / scene.units.metres) for part in (z.real, z.imag)]
