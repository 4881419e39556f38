"""The places of a file's points and guides: in their link's own axes, from every form in which a file may give them,
and at the scene's own position, if the file gives it; and the check that data given twice agree.

A function that places a point or a guide returns a plane vector (m), None while a reference of it is still unknown, or
a ``Problem`` where the data contradict each other.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from graphkin.errors import Problem, did_you_mean
from graphkin.plane import cross, cross_arcs, degrees, direction, dot
from graphkin.scene.bodies import Reading, references
from graphkin.scene.model import Driver, PlacedLink
from graphkin.scene.pairs import HigherPair, Pair, PlacedContact, PlacedGear, PlacedGuide
from graphkin.scene.scene_tables import Compass, Disc, Guide, Link, Polar
from graphkin.scene.tables import in_si
from graphkin.words import Phrase, joined

GIVEN_TWICE = 1e-6
"""Of the size: so far two statements of one place may lie apart; of an angle its sine."""
FARTHEST = 4e10
"""So many times the shortest bar places may lie away: beyond, sixteen digits leave less than five of the bar."""
Places = Mapping[str, complex]


@dataclass
class Placement:
    """A link while it is being placed.

    ``where`` is its name in the file ("links.3", "frame"); ``own`` its one or two own points, ``at`` and ``rails``
    the further points and guides as the file gives them, in SI.  ``local`` and ``guides`` are in its own axes (m);
    ``turn`` (unit complex, direction of the own x axis) and ``origin`` (m) are its pose in the world at the scene's
    position, None while unknown.  ``arm`` is the distance (m) of the places that gave ``turn``: how well it is known.
    """

    name: str
    where: str
    own: tuple[str, ...]
    at: Mapping[str, object]
    rails: Mapping[str, Guide]
    length: float | None = None
    local: dict[str, complex] = field(default_factory=dict)
    guides: dict[str, PlacedGuide] = field(default_factory=lambda: {"": PlacedGuide("")})
    turn: complex | None = None
    origin: complex | None = None
    arm: float = math.inf
    failed: set[str] = field(default_factory=set)

    def world(self, local: complex) -> complex | None:
        """A place of the link in world axes, None while its pose is unknown."""
        return None if self.turn is None or self.origin is None else self.origin + self.turn * local

    def in_own_axes(self, world: complex) -> complex | None:
        """A place in world axes in the link's own, None while its pose is unknown."""
        return None if self.turn is None or self.origin is None else (world - self.origin) / self.turn


def _polar(where: str, entry: Polar, local: Places) -> complex | Problem | None:
    """A point at r and angle from a point of the link, the angle from the x axis or toward another point."""
    if entry.origin not in local:
        return None
    start, sense = local[entry.origin], 1 + 0j
    if entry.toward is not None:
        if entry.toward not in local:
            return None
        arm = local[entry.toward] - start
        if arm == 0:
            return Problem(f"{where}.toward", "lies at itself", "name a point that lies elsewhere", toward=entry.toward,
                           origin=entry.origin)
        sense = arm / abs(arm)
    return start + entry.r * sense * direction(entry.angle)


def _compass(where: str, entry: Compass, metres: float, local: Places) -> complex | Problem | None:
    """A point at two distances from two points of the link, on the given side of the line between them."""
    first, second = entry.origins
    if first not in local or second not in local:
        return None
    p, q = local[first], local[second]
    r, s = entry.r
    c = abs(q - p)
    if c == 0:
        return Problem(f"{where}.from", "and lie at the same place", "name two points apart", point=first, other=second)
    both = cross_arcs(p, r, q, s)
    if both is None and min(abs(r + s - c), abs(abs(r - s) - c)) <= 1e-12 * max(r, s, c):
        both = (p + (q - p) / c * math.copysign(r, c * c + r * r - s * s),) * 2  # the arcs touch
    if both is None:
        least, most = abs(c - r) / metres, (c + r) / metres
        return Problem(where, "arcs of about and about do not meet", "with the second may be from to",
                       r=f"{r / metres:g}", first=first, other=f"{s / metres:g}", second=second,
                       name=f"{c / metres:.6g}", least=f"{least:.6g}", most=f"{most:.6g}")
    return both[0 if entry.side == "left" else 1]


def _place_of(where: str, entry: object, metres: float, local: Places) -> complex | Problem | None:
    """A further point of a link; "drawn" answers None, it needs the pose."""
    if isinstance(entry, list):
        return complex(*entry)
    if isinstance(entry, Polar):
        return _polar(where, entry, local)
    return _compass(where, entry, metres, local) if isinstance(entry, Compass) else None


def _guide_of(
    where: str, name: str, entry: Guide, body: Placement, places: Places, tolerance: float
) -> PlacedGuide | Problem | None:
    """A guide of a link, its direction by angle or toward a point of the link, a fixed one or a drawn one."""
    if entry.through is None:
        return None
    through = body.local.get(entry.through) if isinstance(entry.through, str) else complex(*entry.through)
    if through is None:
        return None
    if entry.toward is None:
        return None if entry.angle is None else PlacedGuide(name, through, direction(entry.angle))
    aim = body.local.get(entry.toward)
    if aim is None and entry.toward in places:
        aim = body.in_own_axes(places[entry.toward])
    if aim is None:
        return None
    arm = aim - through
    if abs(arm) <= tolerance:
        return Problem(f"{where}.toward", "lies where the guide goes through", "name a point that lies elsewhere",
                       toward=entry.toward)
    sense = arm / abs(arm)
    if entry.angle is None:
        return PlacedGuide(name, through, sense)
    given = direction(entry.angle)
    if abs(given - sense) * abs(arm) > tolerance:
        return Problem(f"{where}.angle", "found deg but toward it is deg", "leave one of the two out or correct",
                       angle=f"{entry.angle:g}", toward=entry.toward, degrees=f"{degrees(sense):.8g}")
    return PlacedGuide(name, through, given)


AngleBetween = tuple[str, Placement, Placement, complex, complex]
"""A given angle: where it stands in the file ("" of a driver), the link, its base, the direction in the base's axes
from which it counts, and the angle as a unit complex number."""


def bodies_of(reading: Reading, drawn: Places) -> dict[str, Placement]:
    """Every link with its own points placed, if its length is known; their problems are noted.

    ``drawn`` are the drawn points (m).
    """
    fixed = _fixed(reading)
    given = {**drawn, **fixed}
    bodies: dict[str, Placement] = {}
    for name, table in reading.links.items():
        si = in_si(table, reading.units)
        ends = tuple(si.points) if len(set(si.points)) == len(si.points) <= 2 else tuple(si.points[:1])
        body = Placement(name, f"links.{name}", ends, si.at, si.guides)
        body.local |= dict.fromkeys(ends[:1], 0j)
        if len(ends) == 2:
            body.length = si.length
            if body.length is None and ends[0] in given and ends[1] in given:
                body.length = abs(given[ends[1]] - given[ends[0]])
                if body.length == 0.0:
                    reading.say(body.where, "and are given at the same place", "a bar has two points apart",
                                name=ends[0], other=ends[1])
            if body.length is not None:
                body.local[ends[1]] = complex(body.length)
            elif not any(reading.lost_under(*path) for path in (("links", name, "length"), ("drawn",), ("frame",))):
                undrawn = joined("one and other", [point for point in ends if point not in given])
                reading.say(f"{body.where}.length", "is missing", "write length or give in drawn", undrawn=undrawn)
        bodies[name] = body
    frame = Placement(reading.frame.name, "frame", (), {}, in_si(reading.frame, reading.units).guides)
    frame.local, frame.turn, frame.origin = dict(fixed), 1 + 0j, 0j
    return {**bodies, frame.name: frame}


def _fixed(reading: Reading) -> dict[str, complex]:
    """The places of the frame's points (m), those given from others too."""
    given = in_si(reading.frame, reading.units).points
    places: dict[str, complex] = {}
    left = dict(given)
    while left:
        where = {p: _place_of(f"frame.points.{p}", entry, reading.metres, places) for p, entry in left.items()}
        placed = {p: z for p, z in where.items() if z is not None}
        reading.problems.extend(z for z in placed.values() if isinstance(z, Problem))
        if not placed:
            for point, entry in left.items():
                missing = next(p for p in references(entry) if p not in places)
                said, wanted = Phrase("the frame has no point", missing=missing), did_you_mean(missing, given)
                if missing in given:
                    said = Phrase("has no place yet", missing=missing)
                    wanted = Phrase("the points are placed from one another")
                reading.say(f"frame.points.{point}", said, wanted)
            placed = dict.fromkeys(left, 0j)
        places |= {p: 0j if isinstance(z, Problem) else z for p, z in placed.items()}
        left = {p: entry for p, entry in left.items() if p not in placed}
    return {p: places[p] for p in given}


# the position as far as the file says it


@dataclass
class StatedPosition:
    """The known part of the scene's own position while it is collected.

    ``drawn`` are the places of points that the file draws in the world, ``given`` these and the fixed ones, ``places``
    also those found from them (m).
    ``angles`` are driven links with the link they are measured from and the direction, ``travels`` driven
    pairs by key with the travel (m).
    """

    reading: Reading
    bodies: Mapping[str, Placement]
    drawn: Mapping[str, complex]
    angles: tuple[tuple[str, str, complex], ...]
    travels: Mapping[str, float]

    def __post_init__(self) -> None:
        fixed = self.bodies[self.reading.frame.name].local
        self.given = {**self.drawn, **fixed}
        self.places = dict(self.given)
        bodies = self.bodies.values()
        spans = [b.length for b in bodies if b.length]
        spans += [abs(complex(*e)) for b in bodies for e in b.at.values() if isinstance(e, list)]
        spans += [abs(a - b) for a in (*fixed.values(), *self.drawn.values()) for b in fixed.values()]
        self.size = max(spans, default=0.0) or self.reading.metres
        """The largest distance that the file gives (m)."""

    @property
    def tolerance(self) -> float:
        """The allowed distance between two statements of a place (m)."""
        return GIVEN_TWICE * self.size

    def number(self, length: float) -> str:
        """A length (m) in the file's unit, to ten digits."""
        return f"{length / self.reading.metres:.10g}"

    def pair(self, z: complex) -> str:
        """A place (m) as the file has it."""
        return f"[{z.real / self.reading.metres:.8g}, {z.imag / self.reading.metres:.8g}]"

    @property
    def known(self) -> int:
        """How much is known of the position."""
        bodies = self.bodies.values()
        parts = (len(b.local) + len(b.guides) + (b.turn is not None) + (b.origin is not None) for b in bodies)
        return len(self.places) + sum(parts)

    def placed(self, name: str, discs: Mapping[tuple[str, str], Disc], link: Link | None) -> PlacedLink:
        """A link with everything in its own axes, in the order of the file; the frame where no table is given."""
        body = self.bodies[name]
        points = dict.fromkeys((*body.own, *link.at)) if link else body.local
        guides = {guide: body.guides[guide] for guide in ("", *body.rails)}
        outlines = {disc_name: disc for (of, disc_name), disc in discs.items() if of == name}
        redundant = link is not None and link.redundant
        return PlacedLink(name, {p: body.local[p] for p in points}, body.own, guides, redundant, outlines)

    def running(self, pair: Pair) -> complex | None:
        """The place of the point that runs in a guide (m), None if it is unknown."""
        return self.places.get(pair.pin) if pair.pin else self.bodies[pair.a].origin

    def travel_of(self, key: str) -> float | None:
        """The travel of a sliding pair or pin in slot at the known position (m), None if it is not known."""
        pair = next((pair for pair in self.reading.slides if pair.key == key), None)
        return None if pair is None else _along(self.bodies[pair.b], pair.guide.name, self.running(pair))

    def relations(self) -> Iterator[AngleBetween]:
        """The given angles between links: of sliding links, by their guides, and of drivers."""
        for pair in self.reading.slides:
            guide = self.bodies[pair.b].guides.get(pair.guide.name)
            if not pair.of and guide is not None:
                rail, slider = self.bodies[pair.b], self.bodies[pair.a]
                yield f"links.{pair.a}.angle_on", slider, rail, guide.direction, pair.turn
        for link, base, turn in self.angles:
            yield "", self.bodies[link], self.bodies[base], 1 + 0j, turn

    def value_of(self, driver: Driver) -> float:
        """The value of a driver (rad, m), given or from the known position; not a number if it is unknown."""
        if not math.isnan(driver.value):
            return driver.value
        if not driver.turns:
            travel = self.travel_of(driver.key)
            return math.nan if travel is None else travel
        driven, base = (self.bodies.get(name) for name in driver.links)
        if driven and base and driven.turn is not None and base.turn is not None:
            return cmath.phase(driven.turn / base.turn)
        return math.nan


def stated_position(reading: Reading, drivers: Collection[Driver]) -> StatedPosition:
    """The places that can be found, in the links' own axes and in the world; problems are noted.  Drivers of unknown
    value have none.
    """
    given = [d for d in drivers if not math.isnan(d.value)]
    drawn = {point: complex(*place) * reading.metres for point, place in reading.file.drawn.items()}
    bodies = bodies_of(reading, drawn)
    referred = {pair.b for pair in reading.slides}
    referred |= {name for d in drivers if d.turns for name in d.links}
    for other in sorted(referred):  # links that were taken out for something wrong are placed nowhere
        bodies.setdefault(other, Placement(other, f"links.{other}", (), {}, {}, guides={}))
    position = StatedPosition(
        reading, bodies, drawn, tuple((*d.links, cmath.rect(1.0, d.value)) for d in given if d.turns),
        {d.key: d.value for d in given if not d.turns},
    )
    _find(position)
    return position


def _find(position: StatedPosition) -> None:
    """Place all points and links that follow from placed ones."""
    before = -1
    while position.known > before or _turn_to_positive_side(position) or _turn_to_drawn_point(position):
        before = position.known
        for body in position.bodies.values():
            _place_points(position, body)
            _place_guides(position, body)
            if body.turn is None:
                _turn_by_points(position, body)
            if body.turn is not None:
                _move_by_points(position, body, body.turn)
        _turn_by_angles(position)
        _move_by_travels(position)


def _place_points(position: StatedPosition, body: Placement) -> None:
    for point, entry in body.at.items():
        if point in body.local or point in body.failed:
            continue
        place = _place_of(f"{body.where}.at.{point}", entry, position.reading.metres, body.local)
        if entry == "drawn" and point in position.given:
            place = body.in_own_axes(position.given[point])
        if isinstance(place, Problem):
            position.reading.problems.append(place)
            body.failed.add(point)
        elif place is not None:
            body.local[point] = place


def _place_guides(position: StatedPosition, body: Placement) -> None:
    for name, entry in body.rails.items():
        if name in body.guides or f".{name}" in body.failed:
            continue
        where = f"{body.where}.guides.{name}"
        guide = _guide_of(where, name, entry, body, position.places, position.tolerance)
        if isinstance(guide, Problem):
            position.reading.problems.append(guide)
            body.failed.add(f".{name}")
        elif guide is not None:
            body.guides[name] = guide


def _turn_by_points(position: StatedPosition, body: Placement) -> None:
    ends, places = body.own, position.places
    if len(ends) == 2 and all(p in places for p in ends):
        arm = places[ends[1]] - places[ends[0]]
        if abs(arm) > position.tolerance:
            body.turn, body.arm = arm / abs(arm), abs(arm)
        return
    placed = [p for p in body.local if p in places]
    pairs = ((p, q) for i, q in enumerate(placed) for p in placed[:i])
    far = max(pairs, key=lambda pq: abs(body.local[pq[1]] - body.local[pq[0]]), default=None)
    if far:
        local = body.local[far[1]] - body.local[far[0]]
        arm = places[far[1]] - places[far[0]]
        if min(abs(local), abs(arm)) > position.tolerance:
            turn = arm / local
            body.turn, body.arm = turn / abs(turn), abs(arm)


def _move_by_points(position: StatedPosition, body: Placement, turn: complex) -> None:
    placed = (point for point in body.local if point in position.places)
    if body.origin is None and (point := next(placed, None)) is not None:
        body.origin = position.places[point] - turn * body.local[point]
    if body.origin is not None:
        for point, local in body.local.items():
            position.places.setdefault(point, body.origin + turn * local)


def _turn_by_angles(position: StatedPosition) -> None:
    for _, body, base, zero, turn in position.relations():
        if body.turn is None and base.turn is not None:
            body.turn, body.arm = base.turn * zero * turn, base.arm
        elif base.turn is None and body.turn is not None:
            base.turn, base.arm = body.turn / (zero * turn), body.arm


def _move_by_travels(position: StatedPosition) -> None:
    for pair in position.reading.slides:
        rail = position.bodies[pair.b]
        guide = rail.guides.get(pair.guide.name)
        if pair.of or pair.key not in position.travels or guide is None:
            continue
        slider = position.bodies[pair.a]
        along = guide.through + guide.direction * position.travels[pair.key]
        placed = position.places.keys()
        rail_is_loose = rail.origin is None and not rail.local.keys() & placed
        if slider.origin is None and not slider.local.keys() & placed:
            slider.origin = rail.world(along)
        elif slider.origin is not None and rail.turn is not None and rail_is_loose:
            rail.origin = slider.origin - rail.turn * along


def _turn_to_positive_side(position: StatedPosition) -> bool:
    """Turn a guide about its link's origin until it passes through the point that runs in it; whether there was such a
    guide.

    With k the guide's place seen along its own direction, the running point lies at (k + s) w from the origin,
    w the guide's direction in the world and s its travel, here the larger root of |k + s| = distance.
    """
    for pair in position.reading.slides:
        rail, place = position.bodies[pair.b], position.running(pair)
        guide = rail.guides.get(pair.guide.name)
        if rail.turn is not None or guide is None or place is None:
            continue
        centre = position.places.get(rail.own[0]) if rail.own else None
        if centre is None:
            continue
        k, arm = guide.through / guide.direction, place - centre
        if abs(arm) <= max(abs(k.imag), position.tolerance):
            continue
        s = math.sqrt((abs(arm) - k.imag) * (abs(arm) + k.imag)) - k.real
        sense = arm / (k + s)
        rail.turn, rail.arm = sense / abs(sense) / guide.direction, abs(arm)
        return True
    return False


def _turn_to_drawn_point(position: StatedPosition) -> bool:
    """Choose the x axis of a link that has one own point and nothing measured from its axis; whether there was such a
    link."""
    slides = position.reading.slides
    used = {p.b for p in slides if not p.guide.name} | {p.a for p in slides}
    used |= {name for link, base, _ in position.angles for name in (link, base)}
    for name, body in position.bodies.items():
        measured = any(isinstance(e, list) or (isinstance(e, Polar) and not e.toward) for e in body.at.values())
        aimed = all(g.toward and isinstance(g.through, str) for g in body.rails.values())
        if body.turn is not None or len(body.own) != 1 or name in used or measured or not aimed:
            continue
        aims = [p for p, e in body.at.items() if e == "drawn"] + [g.toward for g in body.rails.values() if g.toward]
        arms = [position.places[p] - position.places[body.own[0]] for p in aims
                if p in position.places and body.own[0] in position.places]
        arm = next((w for w in arms if abs(w) > position.tolerance), None)
        if arm is not None:
            body.turn, body.arm = arm / abs(arm), abs(arm)
            return True
    return False


def _along(rail: Placement, guide_name: str, place: complex | None) -> float | None:
    local = None if place is None else rail.in_own_axes(place)
    guide = rail.guides.get(guide_name)
    return None if local is None or guide is None else dot(guide.direction, local - guide.through)


# where rolling starts


def check_starts(position: StatedPosition) -> None:
    """Note starts of rolling that contradict the given places of a link.  A driven link starts at the driver's
    value."""
    driven = {*position.travels, *(link for link, _, _ in position.angles)}
    said = starts_of(position, ())
    for name, link in position.reading.links.items():
        key = next((pair.key for pair in position.reading.slides if pair.a == name), name)
        if link.start is None or not driven.isdisjoint((name, key)):
            continue
        turn, travel = position.bodies[name].turn, position.travel_of(key)
        if travel is not None and abs(said[key] - travel) > position.tolerance:
            seen = position.number(travel)
        elif key == name and turn is not None and abs(cmath.phase(turn / cmath.rect(1.0, said[key]))) > GIVEN_TWICE:
            seen = f"{degrees(turn):.10g} deg"
        else:
            continue
        position.reading.say(f"links.{name}.start", "found but the given places make it",
                             "one of the two is wrong leave start", start=f"{link.start:.10g}", value=seen)


def starts_of(position: StatedPosition, touching: Iterable[HigherPair]) -> dict[str, float]:
    """The start of rolling motions: angles of links (rad), travels of sliding pairs and of contacts with a face (m),
    from the file or its drawn points."""
    slides, bodies = [pair for pair in position.reading.slides if not pair.of], position.bodies
    turns = {name: bodies[name].turn for name, link in position.reading.links.items() if link.start is None}
    seen = {name: cmath.phase(turn) for name, turn in turns.items() if turn is not None}
    travels = {pair.key: position.travel_of(pair.key) for pair in slides}
    for contact in touching:
        if isinstance(contact, PlacedContact) and contact.flat:
            place = position.places.get(contact.centres[0])
            travels[contact.block] = _along(bodies[contact.face], contact.guide, place)
    starts = dict[str, float]()
    for name, link in position.reading.links.items():
        if link.start is not None:
            key = next((pair.key for pair in slides if pair.a == name), name)
            starts[key] = link.start * position.reading.metres if key != name else math.radians(link.start)
    return {**seen, **{key: travel for key, travel in travels.items() if travel is not None}, **starts}


# whether what is given agrees


def check_placed_twice(position: StatedPosition) -> None:
    """Note points that the file places twice in one link, or fixes and draws, at different places."""
    say = position.reading.say
    for body in position.bodies.values():
        for point in body.own:
            local = _place_of(body.where, body.at.get(point), position.reading.metres, body.local)
            if isinstance(local, complex) and point in body.local:
                as_end = body.local[point]
                if abs(local - as_end) > position.tolerance:
                    say(f"{body.where}.at.{point}", "puts it at but as an own point",
                        "leave one of the two out or correct", pair=position.pair(local), other=position.pair(as_end))
        for point, place in body.local.items() if body.where == "frame" else ():
            drawn = position.drawn.get(point, place)
            if abs(drawn - place) > position.tolerance:
                say(f"drawn.{point}", "found but it is a fixed point at", "leave it out or correct it",
                    pair=position.pair(drawn), other=position.pair(place))


def check_all_found(position: StatedPosition) -> None:
    """Note points and guides that need the position of their link, where it does not follow from what is drawn."""
    for body in position.bodies.values():
        missing = [f"at.{point}" for point in body.at if point not in body.local]
        missing += [f"guides.{guide}" for guide in body.rails if guide not in body.guides]
        for key in missing:
            position.reading.say(f"{body.where}.{key}", "where link lies does not follow from what",
                                 "draw two points of link or give it", body=body.name)


def check_contacts(touching: Iterable[HigherPair], position: StatedPosition) -> None:
    """Note outlines that do not touch where given places put them: centres too far apart, or not a radius off the face,
    on its side."""
    for c in (pair for pair in touching if isinstance(pair, PlacedContact)):
        known = [z for centre in c.centres if (z := position.places.get(centre)) is not None]
        if len(known) < len(c.centres):
            continue
        if not c.flat:
            distance, wanted = abs(known[1] - known[0]), abs(c.apart)
            key = "puts the centres apart"
        else:
            body, guide = position.bodies[c.face], position.bodies[c.face].guides.get(c.guide)
            local = body.in_own_axes(known[0])
            if guide is None or local is None:
                continue
            distance, wanted = dot(local - guide.through, guide.direction * c.normal_to_face), c.radii[0]
            key = "puts the centre to the left of the face" if c.left else "puts the centre to the right of the face"
        if abs(distance - wanted) > position.tolerance:
            drawn = Phrase(key, distance=position.number(distance), given=position.number(wanted))
            position.reading.say(f"contacts.{c.name}", "what is drawn", "correct a place a radius or the side",
                                 value=drawn)


def check_held_distances(touching: Iterable[HigherPair], position: StatedPosition) -> None:
    """Note wheels whose carrier holds them at another distance than their radii give, or at none; pitch lines that
    are not parallel to their slide; centres on the other body."""
    reading, bodies = position.reading, position.bodies.items()
    points, guides = {name: body.local for name, body in bodies}, {name: body.guides for name, body in bodies}
    for c in (pair for pair in touching if isinstance(pair, PlacedContact)):
        where = f"contacts.{c.name}"
        if not c.flat and c.carrier:
            first, second = (points[c.carrier][centre] for centre in c.centres)
            held, wanted = abs(second - first), abs(c.apart)
            if abs(held - wanted) > GIVEN_TWICE * max(map(abs, c.radii)):
                radii = {"held": position.number(held), "wanted": position.number(wanted)}
                reading.say(where, Phrase("link holds the centres apart the radii make", carrier=c.carrier, **radii),
                            "correct a radius or the distance")
        if not c.flat and c.centres[0] == c.centres[1]:
            reading.say(where, "both outlines have the same centre", "two centres lie apart")
    for g in (pair for pair in touching if isinstance(pair, PlacedGear)):
        where, carried = f"gears.{g.name}", points[g.carrier]
        if not g.is_rack:
            if abs(carried[g.axes[1]] - carried[g.axes[0]]) == 0:
                reading.say(where, "both axes lie at the same place", "two wheels have axes apart")
            continue
        height, tilt, far = g.rack_place(reading.slides, points, guides)
        if abs(tilt) > GIVEN_TWICE:
            reading.say(where, "the pitch line is not parallel to the", "name a guide of link along which it",
                        slide=g.slide, wheels=g.bodies[1])
        elif abs(height) <= GIVEN_TWICE * max(far, 1e-300):
            reading.say(where, "the wheel's axis lies on the pitch line", "the distance of the two is the radius")


def check_distances(position: StatedPosition) -> None:
    """Note places so far away that the digits of a coordinate lose the length of a bar."""
    bars = [(b.length, b.name) for b in position.bodies.values() if b.length]
    if not bars:
        return
    short, body = min(bars, key=lambda bar: bar[0])
    places = []
    for b in position.bodies.values():
        points = f"{b.where}.at" if b.where != "frame" else "frame.points"
        places += [(abs(z), f"{points}.{p}") for p, z in b.local.items() if p not in b.own]
        places += [(abs(g.through), f"{b.where}.guides.{n}") for n, g in b.guides.items() if n]
    places += [(length, f"links.{name}.length") for length, name in bars]
    far, where = max(places, key=lambda place: place[0])
    if far > FARTHEST * short:
        metres = position.reading.metres
        position.reading.say(where, "lies away beside a bar of link", "too far apart sixteen digits hold at most",
                             distance=f"{far / metres:.3g}", short=f"{short / metres:.3g}", body=body,
                             farthest=f"{FARTHEST:.0e}")


def check_agreement(position: StatedPosition) -> None:
    """Note data given twice that differ by more than 1e-6 of the size, with both values."""
    say = position.reading.say
    for body in position.bodies.values():
        _check_points(position, body)
    for pair in position.reading.slides:
        rail, place = position.bodies[pair.b], position.running(pair)
        guide, local = rail.guides.get(pair.guide.name), None if place is None else rail.in_own_axes(place)
        if guide and local is not None:
            beside = abs(cross(guide.direction, local - guide.through))
            if beside > position.tolerance * _reach(rail, local):
                where = f"pins.{pair.pin}.in" if pair.of else f"links.{pair.a}.on"
                say(where, "the given places put it beside the guide", "correct a coordinate or the guide",
                    beside=f"{beside / position.reading.metres:.6g}", ref=pair.gaps["guide"])
    for where, body, base, zero, turn in position.relations():
        if body.turn is not None and base.turn is not None:
            # by how far it moves the points that gave it
            seen = body.turn / (base.turn * zero)
            if abs(seen - turn) * min(body.arm, base.arm, position.size) > position.tolerance:
                say(where or Phrase("driver.angle of link", link=body.name), "found deg but the given places make it",
                    "one of the two is wrong", degrees=f"{degrees(turn):.10g}", other=f"{degrees(seen):.10g}")
    for key, travel in position.travels.items():
        seen_travel = position.travel_of(key)
        if seen_travel is not None and abs(seen_travel - travel) > position.tolerance:
            say(Phrase("driver.travel of", key=key), "found but the given places make it", "one of the two is wrong",
                start=position.number(travel), value=position.number(seen_travel))


def _reach(body: Placement, local: complex) -> float:
    """The growth at ``local`` of an error of the places that gave a link's direction."""
    return max(1.0, abs(local) / body.arm)


def _check_points(position: StatedPosition, body: Placement) -> None:
    """Note points of one link whose places in the link and in the world differ."""
    ends, given = body.own, position.given
    say = position.reading.say
    if len(ends) == 2 and body.length is not None and all(p in given for p in ends):
        drawn = abs(given[ends[1]] - given[ends[0]])
        if abs(drawn - body.length) > position.tolerance:
            say(f"links.{body.name}.length", "found but and are given apart", "one of the two is wrong", name=ends[0],
                other=ends[1], length=position.number(body.length), value=position.number(drawn))
            return
    for point, local in body.local.items():
        place = body.world(local)
        if place is None or point not in given:
            continue
        if abs(given[point] - place) > position.tolerance * _reach(body, local):
            say(Phrase("point", point=point), "link puts it at but it is given", "one of the two is wrong",
                body=body.name, pair=position.pair(place), other=position.pair(given[point]))
