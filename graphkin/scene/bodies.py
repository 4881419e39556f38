"""The bodies of a scene file and what joins them: the frame and the moving links, their points, guides and outlines;
sliding pairs, pins in slots; and the checks that references name existing things and that every link is held.

Circular slots and carriages with two pins, which people measure and draw, are first replaced by tables of links,
lengths and angles.
"""

from __future__ import annotations

import cmath
import math
import unicodedata
from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from functools import cached_property
from itertools import chain, count
from typing import TypeVar

from graphkin.errors import Problem, SceneError, did_you_mean
from graphkin.plane import direction
from graphkin.scene.pairs import CircularSlot, Pair, PlacedGuide
from graphkin.scene.scene_tables import (
    TOUCHING,
    Compass,
    Contact,
    DrivenSlide,
    Driver,
    Frame,
    Gear,
    Guide,
    Link,
    Pin,
    Polar,
    SceneTables,
    no_position,
)
from graphkin.scene.tables import KeyPath, Units
from graphkin.words import Phrase, Wording, links_named, listed

AnyBody = TypeVar("AnyBody", Frame, Link)
Item = TypeVar("Item", str, float)


def driver_tables(file: SceneTables) -> dict[str, Driver | DrivenSlide]:
    """The drivers by their places in the file, whether written as one table or several."""
    if isinstance(file.driver, Driver | DrivenSlide):
        return {"driver": file.driver}
    return {f"driver.{i}": table for i, table in enumerate(file.driver, 1)}


def items_of(given: Item | Sequence[Item] | None) -> list[Item]:
    """Names of guides, or angles to them, written alone or in a list."""
    if given is None:
        return []
    return list(given) if isinstance(given, list | tuple) else [given]  # type: ignore[list-item]


def references(entry: object) -> tuple[str, ...]:
    """The points of a link from which an entry places a point."""
    if isinstance(entry, Polar):
        return (entry.origin,) if entry.toward is None else (entry.origin, entry.toward)
    return tuple(entry.origins) if isinstance(entry, Compass) else ()


@dataclass(frozen=True, eq=False, repr=False)
class Reading:
    """A file under reading, the paths of the entries taken out of it, the problems so far, to which each reader adds
    its own, and the parts that are read already.

    ``frame``, ``links`` and ``pins`` are the tables of the file, with bars in place of circular ``slots``;
    ``slides`` are its sliding pairs and pins in slots; ``places`` the points of each link in its own
    axes (m), once they are known.
    """

    file: SceneTables
    lost: frozenset[KeyPath]
    problems: list[Problem]
    frame: Frame
    links: Mapping[str, Link]
    pins: Mapping[str, Pin]
    slots: tuple[CircularSlot, ...] = ()
    slides: tuple[Pair, ...] = ()
    places: Mapping[str, Mapping[str, complex]] = field(default_factory=dict)

    @cached_property
    def units(self) -> Units:
        return self.file.units

    @cached_property
    def metres(self) -> float:
        """One length unit of the file in m."""
        return self.units.metres

    @cached_property
    def drivers(self) -> Mapping[str, Driver | DrivenSlide]:
        """The tables of the drivers by their places in the file."""
        return driver_tables(self.file)

    @cached_property
    def along(self) -> bool:
        """Whether the first driver is a slide, so that its values are travels."""
        return any(isinstance(table, DrivenSlide) for table in list(self.drivers.values())[:1])

    @cached_property
    def pairs(self) -> tuple[str, ...]:
        """The keys of the sliding pairs and pins in slots."""
        return tuple(pair.key for pair in self.slides)

    @cached_property
    def positions(self) -> tuple[str, ...]:
        """The names of the file's positions, the numbered ones first."""
        return self.file.positions.names if self.file.positions else ()

    @cached_property
    def points(self) -> Mapping[str, tuple[str, ...]]:
        """The points of each link, the frame's included."""
        names = {name: (*link.points, *link.at, *sorted(self.lost_names("links", name, "at")))
               for name, link in self.links.items()}
        names |= dict.fromkeys(self.lost_names("links"), ())
        names.setdefault(self.frame.name, (*self.frame.points, *sorted(self.lost_names("frame", "points"))))
        return {name: tuple(dict.fromkeys(points)) for name, points in names.items()}

    @cached_property
    def guides(self) -> Mapping[str, frozenset[str]]:
        """The names of the guides of each link, the frame's included."""
        names = {name: frozenset(link.guides) | self.lost_names("links", name, "guides")
               for name, link in self.links.items()}
        names |= dict.fromkeys(self.lost_names("links"), frozenset[str]())
        names.setdefault(self.frame.name, frozenset(self.frame.guides) | self.lost_names("frame", "guides"))
        return names

    @cached_property
    def touching(self) -> list[Contact | Gear]:
        """The entries of all tables of bodies that touch."""
        return [pair for table in TOUCHING for pair in getattr(self.file, table).values()]

    @cached_property
    def contact_at(self) -> frozenset[str]:
        """The names of the points of contact."""
        return frozenset(self.file.contacts) | self.lost_names("contacts")

    @cached_property
    def unsure(self) -> frozenset[str]:
        """The links that lost a wrong entry with names in it, so that a name missing there is no second problem; ""
        stands for all links."""
        harmless = {"length", "on", "angle_on", "redundant"}
        damaged = {str(p[1]) for p in self.lost if p[0] == "links" and len(p) == 3 and p[2] not in harmless}
        unsure = self.lost_names("links") | damaged
        if self.lost_under("frame", "name") or any(p[0] == "frame" and len(p) == 2 for p in self.lost):
            unsure |= {self.frame.name}
        return frozenset(unsure | {""} if unsure else unsure)

    def lost_under(self, *prefix: str | int) -> bool:
        """Whether an entry at or under this path, or a table that holds it, was taken out."""
        n = len(prefix)
        return any(p[:n] == prefix or p == prefix[: len(p)] for p in self.lost)

    def lost_names(self, *table: str) -> set[str]:
        """The names of the entries of a table that were taken out as a whole."""
        n = len(table)
        return {str(p[n]) for p in self.lost if len(p) == n + 1 and p[:n] == table}

    @property
    def bodies(self) -> list[tuple[str, str, Frame | Link]]:
        """Every link, the frame last: its place in the file, its name, its table."""
        moving = [(f"links.{name}", name, link) for name, link in self.links.items()]
        return [*moving, ("frame", self.frame.name, self.frame)]

    def say(self, where: Wording, found: Wording, wanted: Wording, **gaps: object) -> None:
        """Note a problem."""
        self.problems.append(Problem(where, found, wanted, **gaps))

    def wrong(self, *problems: Problem | None) -> bool:
        """Note the problems among these; whether there is any."""
        there = [problem for problem in problems if problem is not None]
        self.problems.extend(there)
        return bool(there)

    def place(self, link: str, point: str) -> complex:
        """A point of a link in the link's own axes (m); 0 where it is unknown."""
        return self.places.get(link, {}).get(point, 0j)

    def is_unread(self, ref: str) -> bool:
        """Whether the link of a sliding pair slides on what is not there, so that the pair is no second problem."""
        name = ref.partition("/")[0]
        slides = name in self.links and (self.links[name].on or self.lost_under("links", name, "on"))
        return name in self.unsure or (bool(slides) and not any(pair.split("/")[0] == name for pair in self.pairs))

    def no_link(self, where: str, name: str, moving: bool = False) -> Problem | None:
        """The problem of a link that does not exist, None if it does; ``moving`` where the frame is not allowed."""
        if name in self.points or ("" in self.unsure and self.frame.name in self.unsure):
            return None
        known = [link for link in self.points if not (moving and link == self.frame.name)]
        return Problem(where, "there is no link", did_you_mean(name, known), name=name)

    def no_point(self, where: str, point: str) -> Problem | None:
        """The problem of a point that no link has."""
        everywhere = {p for points in self.points.values() for p in points} | self.contact_at
        if point in everywhere or "" in self.unsure:
            return None
        return Problem(where, "no link has a point", did_you_mean(point, everywhere), point=point)

    def no_position(self, where: str, name: str) -> Problem | None:
        """The problem of a position that does not exist; any name may be there where the positions were taken out."""
        return None if self.lost_under("positions") else no_position(where, name, self.positions)

    def no_point_of(self, where: str, link: str, point: str) -> Problem | None:
        """The problem of a point that this link does not have."""
        points = self.points.get(link, ())
        if point in points or link in self.unsure:
            return None
        return Problem(where, "is nowhere placed on link", did_you_mean(point, points), point=point, link=link)

    def no_guide(self, where: str, ref: str) -> Problem | None:
        """The problem of a guide LINK or LINK.GUIDE that does not exist."""
        link, _, guide = ref.partition(".")
        missing = self.no_link(where, link)
        if missing or not guide or link in self.unsure or guide in self.guides.get(link, ()):
            return missing
        if link not in self.points or (link == self.frame.name and guide in self.frame.guides):
            return None  # it may be the frame's, whose name is wrong
        guides = self.guides.get(link, frozenset())
        hint = did_you_mean(guide, guides) if guides else Phrase("its own axis is the guide", link=link)
        return Problem(where, "link has no guide", hint, link=link, guide=guide)


# the file as a whole

MOST_LINKS = 200
MOST_POINTS = 100
"""With the guides, of one link."""


def check_size(reading: Reading) -> None:
    """Raises SceneError for a file with too many links, or too many points of a link."""
    links = reading.file.links
    before = len(reading.problems)
    if len(links) > MOST_LINKS:
        reading.say("links", "found moving links", "at most are possible", count=len(links), limit=MOST_LINKS)
    for name, link in links.items():
        if len(link.at) + len(link.guides) + len(link.points) > MOST_POINTS:
            reading.say(f"links.{name}", "has too many points and guides", "at most", most=MOST_POINTS)
    if len(reading.problems) > before:
        raise SceneError(*reading.problems)


def check_texts(reading: Reading) -> None:
    """Note texts that cannot be written on one line of a sheet."""
    for where in ("title", "title_zh", "source", "source_zh"):
        if any(unicodedata.category(c) in ("Cc", "Cs", "Cn", "Zl", "Zp") for c in getattr(reading.file, where)):
            reading.say(where, "holds a control character or a line break", "write one line of plain text")


# own points and what is placed from them


def check_own_points(reading: Reading) -> None:
    """Note the problems of the links' own points."""
    frame, say = reading.frame.name, reading.say
    if frame in reading.links:
        say("frame.name", "the frame is named as a moving link", "give the frame a name of its own", frame=frame)
    for name, link in reading.links.items():
        where, points = f"links.{name}", link.points
        if len(points) > 2:
            wanted = Phrase("two at most place in at x y", name=points[2], other=points[2])
            say(f"{where}.points", "found names", wanted, count=len(points), name=listed(points[:6]))
        if twice := [p for p in points if points.count(p) > 1]:
            say(f"{where}.points", "stands there twice", "a bar has two different points", name=min(twice))
        if link.length is not None and len(points) < 2 and name not in reading.unsure:
            key = "found with own points" if len(points) != 1 else "found with own point"
            say(f"{where}.length", Phrase(key, length=f"{link.length:g}", count=len(points)),
                "a length needs two names in points")
        lost = name in reading.unsure or reading.lost_under("links", name, "on")
        if not points and reading.file.links[name].on is None and not lost:
            say(where, "has neither points nor on so nothing places", "write points a b or on for a")


def check_references(reading: Reading) -> None:
    """Note points that ``at`` and ``guides`` refer to and that are nowhere placed."""
    drawn, fixed, drawn_lost = reading.file.drawn, reading.frame.points, reading.lost_under("drawn")
    for name, link in reading.links.items():
        for point, entry in link.at.items():
            where = f"links.{name}.at.{point}"
            if isinstance(entry, Polar):
                reading.wrong(reading.no_point_of(f"{where}.from", name, entry.origin),
                              reading.no_point_of(f"{where}.toward", name, entry.toward) if entry.toward else None)
            elif isinstance(entry, Compass):
                reading.wrong(*(reading.no_point_of(f"{where}.from", name, ref) for ref in entry.origins))
            elif entry == "drawn" and point not in drawn and point not in fixed and not drawn_lost:
                reading.say(where, "is drawn but is not in drawn", "write x y in drawn", point=point)
        circle = _circle_of_references(link)
        if circle:
            reading.say(f"links.{name}.at", "are placed from one another", "place one of them by x y or",
                        points=listed(circle))
    for where, name, body in reading.bodies:
        for guide, rail in body.guides.items():
            here, aim = f"{where}.guides.{guide}", rail.toward
            if rail.through is None:
                reading.say(f"{here}.through", "is missing", "write a point of the guide a circular")
            if isinstance(rail.through, str):
                reading.wrong(reading.no_point_of(f"{here}.through", name, rail.through))
            if rail.angle is None and aim is None:
                reading.say(here, "has no direction", "write angle in degrees or toward a point")
            placed = aim is None or aim in drawn or aim in fixed or drawn_lost
            if aim and not placed and reading.no_point_of("", name, aim):
                reading.say(f"{here}.toward", "is no point of link nor fixed or", "write x y in drawn or the direction",
                            point=aim, name=name)


def _circle_of_references(link: Link) -> list[str]:
    """Points of ``at`` placed from each other in a circle, [] without a circle."""
    needs = {point: set(refs) for point, entry in link.at.items()
             if point not in link.points and (refs := references(entry))}
    left = set(needs)
    while free := {p for p in left if not needs[p] & left}:
        left -= free
    trail: list[str] = []
    here = min(left, default="")
    while here and here not in trail:
        trail.append(here)
        here = min(needs[here] & left)
    return trail[trail.index(here) :] if trail else []


# pairs


def sliding_pairs(reading: Reading) -> tuple[Pair, ...]:
    """The sliding pairs of the file; their problems are noted."""
    pairs: list[Pair] = []
    for name, link in reading.links.items():
        if link.on is None:
            lost = name in reading.unsure or reading.lost_under("links", name, "on")
            if link.angle_on is not None and not lost:
                where = f"links.{name}.angle_on"
                reading.say(where, "stands without on", "say what the link slides on")
            continue
        refs = items_of(link.on)
        angles = items_of(link.angle_on) or [0.0] * len(refs)
        if len(angles) != len(refs):
            reading.say(f"links.{name}.angle_on", "found for guides", "write one number for each guide",
                        count=len(angles), guides=len(refs))
            angles = [0.0] * len(refs)
        for ref, angle in zip(refs, angles, strict=True):
            on, _, guide = ref.partition(".")
            problem = reading.no_guide(f"links.{name}.on", ref) or _sliding_problem(name, on, link, reading, pairs)
            if not reading.wrong(problem):
                pin = link.points[0] if link.points else ""
                pairs.append(Pair.sliding(name, on, PlacedGuide(guide), direction(angle), pin))
    return tuple(pairs)


def _sliding_problem(name: str, on: str, link: Link, reading: Reading, pairs: list[Pair]) -> Problem | None:
    where = f"links.{name}.on"
    if on == name:
        return Problem(where, "link slides on itself", "name the link that guides it", name=name)
    if any({p.a, p.b} == {name, on} for p in pairs):
        return Problem(where, "link already has a sliding pair with link", "two links have one sliding pair at most",
                       name=name, on=on)
    if link.points and link.points[0] in reading.points.get(on, ()):
        return Problem(where, "is a point of link too which pins", "take away from one of them or do",
                       points=link.points[0], on=on, name=name)
    return None


def pins_in_slots(reading: Reading) -> tuple[Pair, ...]:
    """The pins in slots of a file with known sliding pairs; their problems are noted."""
    pins: list[Pair] = []
    for point, pin in reading.pins.items():
        where = f"pins.{point}"
        unknown = reading.wrong(
            reading.no_link(f"{where}.of", pin.of) or reading.no_point_of(f"{where}.of", pin.of, point)
        )
        for ref in items_of(pin.slots):
            on, _, guide = ref.partition(".")
            here = f"{where}.in"
            problem = reading.no_guide(here, ref) or _pin_problem(here, point, pin, ref, reading, pins)
            if reading.wrong(problem):
                continue
            if f"{point}/{on}" in reading.pairs:
                reading.say(where, "is also the name of a sliding pair", "rename link", point=point, on=on)
            elif not unknown:
                pins.append(Pair.of_pin(point, pin.of, on, PlacedGuide(guide)))
    return tuple(pins)


def _pin_problem(where: str, point: str, pin: Pin, ref: str, reading: Reading, pins: list[Pair]) -> Problem | None:
    on = ref.partition(".")[0]
    if on == pin.of:
        return Problem(where, "is a guide of link itself", "name the guide of another link", ref=ref, on=on)
    if any(p.pin == point and p.b == on for p in pins):
        return Problem(where, "runs twice in link", "one slot of link or a turning pair", point=point, on=on)
    if point in reading.points.get(on, ()):
        return Problem(where, "is also a point of link which is", "take away from link or the pin away", point=point,
                       on=on)
    return None


def check_rolling(reading: Reading) -> None:
    """Note starts of rolling in a file in which nothing rolls."""
    if any(pair.rolling for pair in reading.touching) or any(map(reading.lost_under, TOUCHING)):
        return
    for name, link in reading.links.items():
        if link.start is not None:
            reading.say(f"links.{name}.start", "nothing rolls here", "leave start out the driver")


def check_held(reading: Reading) -> None:
    """Note the links that no joint connects with the frame, except where a joint may have been taken out, and links
    with a problem of their own."""
    lost = any(map(reading.lost_under, ("pins", *TOUCHING))) or any(p[2:] == ("on",) for p in reading.lost)
    if reading.unsure or lost:
        return
    bare = {problem.where for problem in reading.problems}
    for island in islands(reading):
        if f"links.{island[0]}" in bare:
            continue
        hint = Phrase("share a point with another link or slide", frame=reading.frame.name)
        if len(island) == 1:
            reading.say(f"links.{island[0]}", "nothing holds this link", hint)
        else:
            reading.say(links_named(island), "nothing joins these links to the frame", hint)


def islands(reading: Reading) -> list[tuple[str, ...]]:
    """The sets of links that no chain of joints connects with the frame, in the order of the file.

    A link that does not exist is taken for the link with the nearest name; without such a name nothing is returned,
    since the misspelt link may be the link that seems unheld.
    """
    slides = [(name, ref) for name, link in reading.links.items() for ref in items_of(link.on)]
    slides += [(pin.of, ref) for pin in reading.pins.values() for ref in items_of(pin.slots)]
    touching = [pair.between for pair in reading.touching]
    sides = [[ref.partition(".")[0] for ref in pair] for pair in (*slides, *touching)]
    known = reading.points
    meant = {n: n if n in known else "".join(get_close_matches(n, known, n=1)) for pair in sides for n in pair}
    if "" in meant.values():
        return []
    holders: dict[str, list[str]] = {}
    for name, points in known.items():
        for point in points:
            holders.setdefault(point, []).append(name)
    together = [[meant[name] for name in pair] for pair in sides]
    island = {name: {name} for name in known}
    for joined in (*together, *holders.values()):
        whole = set().union(*(island[name] for name in joined))
        island |= dict.fromkeys(whole, whole)
    moving = (name for name in known if reading.frame.name not in island[name])
    return [*dict.fromkeys(tuple(n for n in known if n in island[name]) for name in moving)]


# carriages


def with_carriages(reading: Reading) -> Reading:
    """The reading with each sliding link of two own points that says neither their distance nor ``angle_on``, but

    - in ``at`` where the second stands from the first, as a link of one own point: its axes lie along the guide, and
      all its places are in them; or
    - nothing, where both are drawn and the guide is one of the frame with an angle, at the angle drawn.
    """
    return replace(reading, links={name: _measured(reading, link) for name, link in reading.links.items()})


def _measured(reading: Reading, link: Link) -> Link:
    refs, drawn = items_of(link.on), reading.file.drawn
    if len(link.points) != 2 or len(refs) != 1 or link.angle_on is not None:
        return link
    first, second = link.points
    if second in link.at and link.at[second] != "drawn" and link.length is None:
        return replace(link, points=[first])
    on, _, name = refs[0].partition(".")
    guide = reading.frame.guides.get(name)
    straight = on == reading.frame.name and (not name or (guide is not None and guide.angle is not None))
    if not straight or not {first, second} <= drawn.keys():
        return link
    along = complex(*drawn[second]) - complex(*drawn[first])
    if along == 0:
        return link
    angle = math.degrees(cmath.phase(along)) - ((guide.angle or 0.0) if guide is not None else 0.0)
    return replace(link, angle_on=math.remainder(angle, 360.0))


# circular slots

Key = tuple[str, str]
"""A link, and the name of a guide of it."""


def with_bars(reading: Reading) -> Reading:
    """The reading with bars and turning pairs in place of circular slots; problems are noted."""
    guides = {(name, key): guide for _, name, body in reading.bodies for key, guide in body.guides.items()}
    arcs = {k: g for k, g in guides.items() if g.centre is not None or g.r is not None or g.ends is not None}
    if not arcs:
        return reading
    points = {name: {*getattr(body, "at", {}), *body.points} for _, name, body in reading.bodies}
    given: dict[str, dict[str, list[float]]] = {name: {} for name in points}  # points that stand for places of centres
    centres = {key: _centre(reading, key, arc, points, given[key[0]]) for key, arc in arcs.items()}
    slots: list[CircularSlot] = []

    def arc_of(ref: str) -> Key | None:
        link, _, guide = ref.partition(".")
        return (link, guide) if (link, guide) in arcs else None

    def note(key: Key, bar: str, point: str, of: str = "") -> None:
        first, last = arcs[key].ends or (None, None)
        ends = None if first is None or last is None else (math.radians(first), math.radians(last))
        radius = (arcs[key].r or 0.0) * reading.metres
        slots.append(CircularSlot(key[1], key[0], centres[key], radius, bar, point, not of, ends, of))

    def without_arcs(name: str, body: AnyBody) -> AnyBody:
        return replace(body, guides={key: guide for key, guide in body.guides.items() if (name, key) not in arcs})

    taken, kept, bars = {*points}, dict[str, Pin](), dict[str, Link]()
    for point, pin in reading.pins.items():
        where, refs = f"pins.{point}", items_of(pin.slots)
        straight = [ref for ref in refs if arc_of(ref) is None]
        if straight:
            kept[point] = replace(pin, slots=straight)
        for slot in filter(None, map(arc_of, refs)):
            if pin.of not in points:
                reading.say(f"{where}.of", "there is no link", did_you_mean(pin.of, taken), name=pin.of)
            elif point not in points[pin.of]:
                reading.say(f"{where}.of", "link has no point of name and centre",
                            did_you_mean(point, sorted(points[pin.of])), name=pin.of, centre=point)
            elif pin.of == slot[0] or point in points[slot[0]]:
                reading.say(f"{where}.in", "is a point of link itself", "name the slot of another link", point=point,
                            key=slot[0])
            elif centres[slot]:
                bar = next(free_names(taken, slot[1]))
                taken.add(bar)
                bars[bar] = Link(points=[centres[slot], point], length=arcs[slot].r or 0.0)
                note(slot, bar, point, pin.of)

    def on_bars(name: str, link: Link) -> Link:
        # of the circular slots that it runs in a link has the centres, as points in its own axes
        refs, at = items_of(link.on), {**link.at, **given[name]}
        keys, angles = [arc_of(ref) for ref in refs], [*items_of(link.angle_on), *([0.0] * len(refs))]
        if any(keys):
            straight = [k for k, key in enumerate(keys) if key is None]
            link = replace(link, on=[refs[k] for k in straight] or None, angle_on=[angles[k] for k in straight] or None)
        for key, angle in zip(keys, angles, strict=False):
            if key is None:
                continue
            if key[0] == name:
                reading.say(f"links.{name}.on", "link slides on itself", "name another link", name=name)
            elif not link.points:
                reading.say(f"links.{name}.points", "is missing", "name the point of the block that runs")
            elif centres[key]:
                # along the guide's sense, turned back by angle_on, lies the own x axis: the centre is to the left of it
                to_centre = 1j * direction(-angle) * (arcs[key].r or 0.0)
                at[centres[key]] = [to_centre.real, to_centre.imag]
                note(key, name, link.points[0])
        return without_arcs(name, replace(link, at=at))

    moving = {name: on_bars(name, link) for name, link in reading.links.items()}
    frame = replace(reading.frame, points={**reading.frame.points, **given[reading.frame.name]})
    return replace(reading, frame=without_arcs(frame.name, frame), links={**moving, **bars}, pins=kept,
                   slots=tuple(slots))


def _centre(
    reading: Reading, key: Key, arc: Guide, points: Mapping[str, set[str]], given: dict[str, list[float]]
) -> str:
    """The point in the centre of a circular slot, "" where there is none; problems are noted.  For a place a new point
    is ``given``."""
    name, names = key[0], points[key[0]]
    body = "frame" if name == reading.frame.name and name not in reading.links else f"links.{name}"
    where = f"{body}.guides.{key[1]}"
    both = [k for k in ("through", "angle", "toward") if getattr(arc, k) is not None]
    if both:
        reading.say(f"{where}.{both[0]}", "stands in a slot along a circle", "a straight guide has through and angle a")
    if arc.centre is None:
        reading.say(f"{where}.centre", "is missing", "write centre m or x y and r")
        return ""
    if arc.r is None:
        reading.say(f"{where}.r", "is missing", "write the slot's radius")
    if not isinstance(arc.centre, str):
        point = next(free_names({p for each in points.values() for p in each}, "M"))
        given[point] = list(arc.centre)
        names.add(point)
        return point
    if arc.centre not in names and not reading.lost_under(*where.split(".")[:2]):
        reading.say(f"{where}.centre", "link has no point of name and centre", did_you_mean(arc.centre, sorted(names)),
                    name=name, centre=arc.centre)
        return ""
    return arc.centre


def free_names(taken: Container[str], *first: str) -> Iterator[str]:
    """Names not taken: some first ones, then the first of them with numbers."""
    return (name for name in chain(first, (f"{first[0]}{k}" for k in count(1))) if name not in taken)
