"""Where the points and guides of a file lie: in their link's own axes, from the ways in which a file may give them,
and at the scene's own position, as far as the file says it outright.

Each function of the first part answers with a plane vector (m), None while something that it refers to is not known
yet, or a ``Problem`` where what is known does not fit.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from graphkin.errors import Problem
from graphkin.plane import cross_arcs, degrees, direction, dot
from graphkin.scene.contacts import PlacedContact
from graphkin.scene.model import PinInSlot, PlacedGuide, SlidingPair
from graphkin.scene.tables import Compass, Guide, Link, Polar, SceneTables
from graphkin.words import Phrase

__all__ = [
    "DrawnPosition", "Placement", "circle_of_references", "find_position", "guide_of", "origins_of", "place_of",
    "running_points", "starts_apart", "starts_of", "travel_of",
]  # fmt: skip

Places = Mapping[str, complex]


@dataclass
class Placement:
    """A link while it is being placed.

    ``where`` is its name in the file ("links.3", "frame"); ``own`` its one or two own points, ``at`` and ``rails``
    the further points and guides as the file gives them.  ``local`` and ``guides`` are in its own axes (m);
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
    guides: dict[str, PlacedGuide] = field(default_factory=dict)
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


def place_polar(where: str, entry: Polar, metres: float, local: Places) -> complex | Problem | None:
    """A point at r and angle from a point of the link, the angle from the x axis or toward another point."""
    if entry.origin not in local:
        return None
    start, sense = local[entry.origin], 1 + 0j
    if entry.toward is not None:
        if entry.toward not in local:
            return None
        way = local[entry.toward] - start
        if way == 0:
            return Problem(
                f"{where}.toward",
                Phrase("lies at itself", toward=entry.toward, origin=entry.origin),
                Phrase("name a point that lies elsewhere"),
            )
        sense = way / abs(way)
    return start + entry.r * metres * sense * direction(entry.angle)


def place_compass(where: str, entry: Compass, metres: float, local: Places) -> complex | Problem | None:
    """A point at two distances from two points of the link, on the given side of the line between them."""
    first, second = entry.origins
    if first not in local or second not in local:
        return None
    p, q = local[first], local[second]
    r, s = entry.r[0] * metres, entry.r[1] * metres
    c = abs(q - p)
    if c == 0:
        return Problem(
            f"{where}.from",
            Phrase("and lie at the same place", point=first, other=second),
            Phrase("name two points apart"),
        )
    both = cross_arcs(p, r, q, s)
    if both is None and min(abs(r + s - c), abs(abs(r - s) - c)) <= 1e-12 * max(r, s, c):
        both = (p + (q - p) / c * math.copysign(r, c * c + r * r - s * s),) * 2  # the arcs touch
    if both is None:
        least, most = abs(c - r) / metres, (c + r) / metres
        return Problem(
            where,
            Phrase(
                "arcs of about and about do not meet",
                r=f"{entry.r[0]:g}",
                first=first,
                other=f"{entry.r[1]:g}",
                second=second,
            ),
            Phrase(
                "with the second may be from to",
                first=first,
                second=second,
                name=f"{c / metres:.6g}",
                least=f"{least:.6g}",
                most=f"{most:.6g}",
            ),
        )
    return both[0 if entry.side == "left" else 1]


def place_of(where: str, entry: object, metres: float, local: Places) -> complex | Problem | None:
    """A further point of a link; "drawn" answers None, it needs the pose."""
    if isinstance(entry, list):
        return complex(*entry) * metres
    if isinstance(entry, Polar):
        return place_polar(where, entry, metres, local)
    return place_compass(where, entry, metres, local) if isinstance(entry, Compass) else None


def origins_of(entry: object) -> tuple[str, ...]:
    """The points from which a point is placed."""
    if isinstance(entry, Polar):
        return (entry.origin,) if entry.toward is None else (entry.origin, entry.toward)
    return tuple(entry.origins) if isinstance(entry, Compass) else ()


def guide_of(
    where: str, name: str, entry: Guide, metres: float, body: Placement, places: Places, tolerance: float
) -> PlacedGuide | Problem | None:
    """A guide of a link, its direction by angle or toward a point of the link, a fixed one or a drawn one."""
    if entry.through is None:
        return None
    through = body.local.get(entry.through) if isinstance(entry.through, str) else complex(*entry.through) * metres
    if through is None:
        return None
    if entry.toward is None:
        return None if entry.angle is None else PlacedGuide(name, through, direction(entry.angle))
    aim = body.local.get(entry.toward)
    if aim is None and entry.toward in places:
        aim = body.in_own_axes(places[entry.toward])
    if aim is None:
        return None
    way = aim - through
    if abs(way) <= tolerance:
        return Problem(
            f"{where}.toward",
            Phrase("lies where the guide goes through", toward=entry.toward),
            Phrase("name a point that lies elsewhere"),
        )
    sense = way / abs(way)
    if entry.angle is None:
        return PlacedGuide(name, through, sense)
    given = direction(entry.angle)
    if abs(given - sense) * abs(way) > tolerance:
        return Problem(
            f"{where}.angle",
            Phrase(
                "found deg but toward it is deg",
                angle=f"{entry.angle:g}",
                toward=entry.toward,
                degrees=f"{degrees(sense):.8g}",
            ),
            Phrase("leave one of the two out or correct"),
        )
    return PlacedGuide(name, through, given)


def circle_of_references(table: Link) -> list[str]:
    """Points of ``at`` that are placed from one another in a circle, [] if there is no circle."""
    needs: dict[str, set[str]] = {}
    for point, entry in table.at.items():
        if point in table.points:
            continue
        if origins := origins_of(entry):
            needs[point] = set(origins)
    left = set(needs)
    while free := {p for p in left if not needs[p] & left}:
        left -= free
    trail: list[str] = []
    here = min(left, default="")
    while here and here not in trail:
        trail.append(here)
        here = min(needs[here] & left)
    return trail[trail.index(here) :] if trail else []


GIVEN_TWICE = 1e-6


@dataclass
class DrawnPosition:
    """What is known of the scene's own position while it is being collected.

    ``fixed`` and ``drawn`` are the places of points that the file gives in the world (``given`` both of them),
    ``places`` also those found from them (m).
    ``angles`` are driven links with the link they are measured from and the direction, ``travels`` driven
    pairs by key with the travel (m).
    """

    bodies: Mapping[str, Placement]
    fixed: Mapping[str, complex]
    drawn: Mapping[str, complex]
    slidings: tuple[SlidingPair, ...]
    pins: tuple[PinInSlot, ...]
    angles: tuple[tuple[str, str, complex], ...]
    travels: Mapping[str, float]
    metres: float
    size: float
    problems: list[Problem]

    def __post_init__(self) -> None:
        self.given = {**self.drawn, **self.fixed}
        self.places = dict(self.given)
        self.news = False

    @property
    def tolerance(self) -> float:
        """How far apart two statements of one place may be (m)."""
        return GIVEN_TWICE * self.size

    def set_turn(self, body: Placement, turn: complex, arm: float) -> None:
        """Note the direction of a link, if it is news."""
        if body.turn is None:
            body.turn, body.arm, self.news = turn, arm, True

    def set_origin(self, body: Placement, origin: complex) -> None:
        """Note the place of a link's origin, if it is news."""
        if body.origin is None:
            body.origin, self.news = origin, True


def find_position(position: DrawnPosition) -> None:
    """Place everything that can be placed, in the links' own axes and in the world."""
    while True:
        position.news = False
        for body in position.bodies.values():
            _place_points(position, body)
            _place_guides(position, body)
            _turn_by_points(position, body)
            _move_by_points(position, body)
        _turn_by_slidings(position)
        _turn_by_drivers(position)
        _move_by_travels(position)
        if not (position.news or _turn_to_positive_side(position) or _turn_to_drawn_point(position)):
            return


def _place_points(position: DrawnPosition, body: Placement) -> None:
    for point, entry in body.at.items():
        if point in body.local or point in body.failed:
            continue
        found = place_of(f"{body.where}.at.{point}", entry, position.metres, body.local)
        if entry == "drawn" and point in position.given:
            found = body.in_own_axes(position.given[point])
        if isinstance(found, Problem):
            position.problems.append(found)
            body.failed.add(point)
        elif found is not None:
            body.local[point] = found
            position.news = True


def _place_guides(position: DrawnPosition, body: Placement) -> None:
    for name, entry in body.rails.items():
        if name in body.guides or f".{name}" in body.failed:
            continue
        where = f"{body.where}.guides.{name}"
        found = guide_of(where, name, entry, position.metres, body, position.places, position.tolerance)
        if isinstance(found, Problem):
            position.problems.append(found)
            body.failed.add(f".{name}")
        elif found is not None:
            body.guides[name] = found
            position.news = True


def _turn_by_points(position: DrawnPosition, body: Placement) -> None:
    if body.turn is not None:
        return
    own = body.own
    if len(own) == 2 and all(p in position.places for p in own):
        way = position.places[own[1]] - position.places[own[0]]
        if abs(way) > position.tolerance:
            position.set_turn(body, way / abs(way), abs(way))
        return
    placed = [p for p in body.local if p in position.places]
    pairs = ((p, q) for i, q in enumerate(placed) for p in placed[:i])
    far = max(pairs, key=lambda pq: abs(body.local[pq[1]] - body.local[pq[0]]), default=None)
    if far:
        local = body.local[far[1]] - body.local[far[0]]
        way = position.places[far[1]] - position.places[far[0]]
        if min(abs(local), abs(way)) > position.tolerance:
            turn = way / local
            position.set_turn(body, turn / abs(turn), abs(way))


def _move_by_points(position: DrawnPosition, body: Placement) -> None:
    if body.turn is None:
        return
    for point, local in body.local.items():
        if body.origin is None and point in position.places:
            position.set_origin(body, position.places[point] - body.turn * local)
    if body.origin is None:
        return
    for point, local in body.local.items():
        if point not in position.places:
            position.places[point] = body.origin + body.turn * local
            position.news = True


def _turn_by_slidings(position: DrawnPosition) -> None:
    for pair in position.slidings:
        slider, rail = position.bodies[pair.link], position.bodies[pair.on]
        guide = rail.guides.get(pair.guide)
        if guide is None:
            continue
        if rail.turn is not None:
            position.set_turn(slider, rail.turn * guide.direction * pair.turn, rail.arm)
        elif slider.turn is not None:
            position.set_turn(rail, slider.turn / (guide.direction * pair.turn), slider.arm)


def _turn_by_drivers(position: DrawnPosition) -> None:
    for link, base, turn in position.angles:
        driven, from_body = position.bodies[link], position.bodies[base]
        if from_body.turn is not None:
            position.set_turn(driven, from_body.turn * turn, from_body.arm)
        elif driven.turn is not None:
            position.set_turn(from_body, driven.turn / turn, driven.arm)


def _move_by_travels(position: DrawnPosition) -> None:
    for pair in position.slidings:
        slider, rail = position.bodies[pair.link], position.bodies[pair.on]
        guide = rail.guides.get(pair.guide)
        if pair.key not in position.travels or guide is None:
            continue
        along = guide.through + guide.direction * position.travels[pair.key]
        if (place := rail.world(along)) is not None and not slider.local.keys() & position.places.keys():
            position.set_origin(slider, place)
        elif rail.turn is not None and slider.origin is not None and not rail.local.keys() & position.places.keys():
            position.set_origin(rail, slider.origin - rail.turn * along)


def running_points(position: DrawnPosition) -> Iterable[tuple[str, str, str, complex | None]]:
    """Each guiding link and guide with the point that runs in it: (link, guide, what runs, its place or None)."""
    for pair in position.slidings:
        place = position.places.get(pair.pin) if pair.pin else position.bodies[pair.link].origin
        yield pair.on, pair.guide, pair.link, place
    for pin in position.pins:
        yield pin.on, pin.guide, pin.point, position.places.get(pin.point)


def _turn_to_positive_side(position: DrawnPosition) -> bool:
    """Turn one guide about its link's origin until it passes through what runs in it; True if there was one.

    With k the guide's place seen along its own direction, the running point lies at (k + s) w from the origin,
    w the guide's direction in the world and s its travel, here the larger root of |k + s| = distance.
    """
    for name, guide_name, _, place in running_points(position):
        rail = position.bodies[name]
        guide = rail.guides.get(guide_name)
        if rail.turn is not None or guide is None or place is None:
            continue
        centre = position.places.get(rail.own[0]) if rail.own else None
        if centre is None:
            continue
        k, way = guide.through / guide.direction, place - centre
        if abs(way) <= max(abs(k.imag), position.tolerance):
            continue
        s = math.sqrt((abs(way) - k.imag) * (abs(way) + k.imag)) - k.real
        sense = way / (k + s)
        position.set_turn(rail, sense / abs(sense) / guide.direction, abs(way))
        return True
    return False


def _turn_to_drawn_point(position: DrawnPosition) -> bool:
    """Choose the x axis of a link that has one own point and nothing measured from its axis; True if there was one."""
    used = {p.on for p in position.slidings if not p.guide} | {p.on for p in position.pins if not p.guide}
    used |= {p.link for p in position.slidings} | {name for link, base, _ in position.angles for name in (link, base)}
    for name, body in position.bodies.items():
        measured = any(isinstance(e, list) or (isinstance(e, Polar) and not e.toward) for e in body.at.values())
        aimed = all(g.toward and isinstance(g.through, str) for g in body.rails.values())
        if body.turn is not None or len(body.own) != 1 or name in used or measured or not aimed:
            continue
        aims = [p for p, e in body.at.items() if e == "drawn"] + [g.toward for g in body.rails.values() if g.toward]
        ways = [position.places[p] - position.places[body.own[0]] for p in aims
                if p in position.places and body.own[0] in position.places]
        way = next((w for w in ways if abs(w) > position.tolerance), None)
        if way is not None:
            position.set_turn(body, way / abs(way), abs(way))
            return True
    return False


def travel_of(position: DrawnPosition, key: str) -> float | None:
    """The travel of a sliding pair or pin in slot at the known position (m), None if it is not known."""
    for pair in position.slidings:
        if pair.key == key:
            return _along(position.bodies[pair.on], pair.guide, position.bodies[pair.link].origin)
    for pin in position.pins:
        if pin.key == key:
            return _along(position.bodies[pin.on], pin.guide, position.places.get(pin.point))
    return None


def _along(rail: Placement, guide_name: str, place: complex | None) -> float | None:
    local = None if place is None else rail.in_own_axes(place)
    guide = rail.guides.get(guide_name)
    return None if local is None or guide is None else dot(guide.direction, local - guide.through)


def starts_apart(file: SceneTables, position: DrawnPosition) -> Iterable[Problem]:
    """Where rolling starts, said of links that stand elsewhere by given places.  Of a driven link it starts where the
    driver stands."""
    driven = {link for link, _, _ in position.angles}
    for name, link in file.links.items():
        if link.start is None or name in driven:
            continue
        keys = [s.key for s in position.slidings if s.link == name]
        turn, travel = position.bodies[name].turn, None
        if keys and keys[0] not in position.travels:
            travel = travel_of(position, keys[0])
        if travel is not None and abs(link.start * position.metres - travel) > position.tolerance:
            told = f"{travel / position.metres:.10g}"
        elif not keys and turn is not None and abs(cmath.phase(turn / direction(link.start))) > GIVEN_TWICE:
            told = f"{degrees(turn):.10g} deg"
        else:
            continue
        said = Phrase("found but the given places make it", start=f'{link.start:.10g}', value=told)
        yield Problem(f"links.{name}.start", said, Phrase("one of the two is wrong leave start"))


def starts_of(file: SceneTables, position: DrawnPosition, contacts: tuple[PlacedContact, ...]) -> dict[str, float]:
    """Where what rolls stands: angles of links (rad), travels of sliding pairs and of contacts with a face (m), as far
    as the file or its drawn points tell."""
    found: dict[str, float] = {}
    for name, link in file.links.items():
        turn = position.bodies[name].turn
        own = [s.key for s in position.slidings if s.link == name]
        if link.start is not None and own:
            found[own[0]] = link.start * position.metres
        elif link.start is not None:
            found[name] = math.radians(link.start)
        elif turn is not None:
            found[name] = cmath.phase(turn)
    for pair in position.slidings:
        travel = travel_of(position, pair.key)
        if travel is not None:
            found.setdefault(pair.key, travel)
    for contact in contacts:
        if contact.flat:
            place = position.places.get(contact.round[0].centre)
            travel = _along(position.bodies[contact.face], contact.guide, place)
            if travel is not None:
                found[contact.block] = travel
    return found
