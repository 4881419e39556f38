"""Points and guides of a link in its own axes, from the ways in which a file may give them.

Each function answers with a plane vector (m), None while something that it refers to is not known yet, or a
``Problem`` where what is known does not fit.

Sliding pairs and pins in slots, and whether every link is held by something.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches

from graphkin.errors import Problem
from graphkin.plane import cross_arcs, degrees, direction
from graphkin.scene.file import Compass, GuideTable, LinkTable, Polar, SceneFile
from graphkin.scene.model import Guide, PinInSlot, SlidingPair
from graphkin.scene.names import Names
from graphkin.scene.reading import Flaws

__all__ = ["Body", "circle_of_references", "guide_of", "islands", "pins_in_slots", "place_of", "sliding_pairs"]

Places = Mapping[str, complex]


@dataclass
class Body:
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
    rails: Mapping[str, GuideTable]
    length: float | None = None
    local: dict[str, complex] = field(default_factory=dict)
    guides: dict[str, Guide] = field(default_factory=dict)
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
                f"{where}.toward", f"{entry.toward} lies at {entry.origin} itself", "name a point that lies elsewhere"
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
        return Problem(f"{where}.from", f"{first} and {second} lie at the same place", "name two points apart")
    both = cross_arcs(p, r, q, s)
    if both is None and min(abs(r + s - c), abs(abs(r - s) - c)) <= 1e-12 * max(r, s, c):
        both = (p + (q - p) / c * math.copysign(r, c * c + r * r - s * s),) * 2  # the arcs touch
    if both is None:
        least, most = abs(c - r) / metres, (c + r) / metres
        return Problem(
            where,
            f"arcs of {entry.r[0]:g} about {first} and {entry.r[1]:g} about {second} do not meet",
            f"with {first}{second} = {c / metres:.6g} the second may be from {least:.6g} to {most:.6g}",
        )
    return both[0 if entry.side == "left" else 1]


def place_of(where: str, entry: object, metres: float, local: Places) -> complex | Problem | None:
    """A further point of a link; "drawn" answers None, it needs the pose."""
    if isinstance(entry, list):
        return complex(*entry) * metres
    if isinstance(entry, Polar):
        return place_polar(where, entry, metres, local)
    return place_compass(where, entry, metres, local) if isinstance(entry, Compass) else None


def guide_of(
    where: str, name: str, entry: GuideTable, metres: float, body: Body, places: Places, tolerance: float
) -> Guide | Problem | None:
    """A guide of a link, its direction by angle or toward a point of the link, a fixed one or a drawn one."""
    through = body.local.get(entry.through) if isinstance(entry.through, str) else complex(*entry.through) * metres
    if through is None:
        return None
    if entry.toward is None:
        return None if entry.angle is None else Guide(name, through, direction(entry.angle))
    aim = body.local.get(entry.toward)
    if aim is None and entry.toward in places:
        aim = body.in_own_axes(places[entry.toward])
    if aim is None:
        return None
    way = aim - through
    if abs(way) <= tolerance:
        return Problem(
            f"{where}.toward", f"{entry.toward} lies where the guide goes through", "name a point that lies elsewhere"
        )
    sense = way / abs(way)
    if entry.angle is None:
        return Guide(name, through, sense)
    given = direction(entry.angle)
    if abs(given - sense) * abs(way) > tolerance:
        return Problem(
            f"{where}.angle",
            f"found {entry.angle:g} deg, but toward {entry.toward} it is {degrees(sense):.8g} deg",
            "leave one of the two out, or correct it",
        )
    return Guide(name, through, given)


def circle_of_references(table: LinkTable) -> list[str]:
    """Points of ``at`` that are placed from one another in a circle, [] if there is no circle."""
    needs: dict[str, set[str]] = {}
    for point, entry in table.at.items():
        if point in table.points:
            continue
        if isinstance(entry, Polar):
            needs[point] = {entry.origin, entry.toward or entry.origin}
        elif isinstance(entry, Compass):
            needs[point] = set(entry.origins)
    left = set(needs)
    while free := {p for p in left if not needs[p] & left}:
        left -= free
    trail: list[str] = []
    here = min(left, default="")
    while here and here not in trail:
        trail.append(here)
        here = min(needs[here] & left)
    return trail[trail.index(here) :] if trail else []


def _as_list(refs: str | list[str]) -> list[str]:
    return [refs] if isinstance(refs, str) else refs


def sliding_pairs(file: SceneFile, names: Names, flaws: Flaws, problems: list[Problem]) -> tuple[SlidingPair, ...]:
    """The sliding pairs of the file; what is wrong with them is added to ``problems``."""
    pairs: list[SlidingPair] = []
    for name, link in file.links.items():
        if link.on is None:
            if link.angle_on is not None and name not in names.unsure and not flaws.under("links", name, "on"):
                problems.append(Problem(f"links.{name}.angle_on", "stands without on", "say what the link slides on"))
            continue
        refs = _as_list(link.on)
        angles = _angles(name, link, len(refs), problems)
        for ref, angle in zip(refs, angles, strict=True):
            on, _, guide = ref.partition(".")
            problem = names.no_guide(f"links.{name}.on", ref) or _sliding_problem(name, on, link, names, pairs)
            if problem:
                problems.append(problem)
                continue
            pairs.append(SlidingPair(name, on, guide, direction(angle), link.points[0] if link.points else None))
    return tuple(pairs)


def _angles(name: str, link: LinkTable, guides: int, problems: list[Problem]) -> list[float]:
    if link.angle_on is None:
        return [0.0] * guides
    angles = link.angle_on if isinstance(link.angle_on, list) else [link.angle_on]
    if len(angles) != guides:
        problems.append(
            Problem(
                f"links.{name}.angle_on", f"found {len(angles)} for {guides} guides", "write one number for each guide"
            )
        )
        return [0.0] * guides
    return angles


def _sliding_problem(name: str, on: str, link: LinkTable, names: Names, pairs: list[SlidingPair]) -> Problem | None:
    where = f"links.{name}.on"
    if on == name:
        return Problem(where, f"link {name} slides on itself", "name the link that guides it")
    if any({p.link, p.on} == {name, on} for p in pairs):
        return Problem(
            where, f"link {name} already has a sliding pair with link {on}", "two links have one sliding pair at most"
        )
    if link.points and link.points[0] in names.points.get(on, ()):
        return Problem(
            where,
            f"{link.points[0]} is a point of link {on} too, which pins the two together",
            f"take {link.points[0]} away from one of them, or do not let link {name} slide",
        )
    return None


def pins_in_slots(
    file: SceneFile, names: Names, slidings: tuple[SlidingPair, ...], problems: list[Problem]
) -> tuple[PinInSlot, ...]:
    """The pins in slots of the file; what is wrong with them is added to ``problems``."""
    pins: list[PinInSlot] = []
    for point, pin in file.pins.items():
        where = f"pins.{point}"
        problem = names.no_link(f"{where}.of", pin.of) or names.no_point_of(f"{where}.of", pin.of, point)
        if problem:
            problems.append(problem)
        for ref in _as_list(pin.slots):
            on, _, guide = ref.partition(".")
            found = names.no_guide(f"{where}.in", ref)
            if not found and on == pin.of:
                found = Problem(
                    f"{where}.in", f"{ref} is a guide of link {on} itself", "name the guide of another link"
                )
            if not found and any(p.point == point and p.on == on for p in pins):
                found = Problem(
                    f"{where}.in", f"{point} runs twice in link {on}", f"one slot of link {on}, or a turning pair"
                )
            if not found and point in names.points.get(on, ()):
                found = Problem(
                    f"{where}.in",
                    f"{point} is also a point of link {on}, which is a turning pair",
                    f"take {point} away from link {on}, or the pin away",
                )
            if not found and any(s.key == f"{point}/{on}" for s in slidings):
                found = Problem(where, f"{point}/{on} is also the name of a sliding pair", f"rename link {point}")
            if found:
                problems.append(found)
            elif not problem:
                pins.append(PinInSlot(point, pin.of, on, guide))
    return tuple(pins)


def islands(file: SceneFile, names: Names) -> list[tuple[str, ...]]:
    """The sets of links that no chain of joints connects with the frame, in the order of the file.

    A link that does not exist is taken for the one with the nearest name; empty where there is none near, since it
    may stand for the one that seems unheld.
    """
    slides = [(name, ref.partition(".")[0]) for name, link in file.links.items() for ref in _as_list(link.on or [])]
    slides += [(pin.of, ref.partition(".")[0]) for pin in file.pins.values() for ref in _as_list(pin.slots)]
    meant = {n: n if n in names.points else "".join(get_close_matches(n, names.points, n=1)) for p in slides for n in p}
    if "" in meant.values():
        return []
    near: dict[str, set[str]] = {name: set() for name in names.points}
    holders: dict[str, list[str]] = {}
    for name, points in names.points.items():
        for point in points:
            holders.setdefault(point, []).append(name)
    joined = [(a, b) for held in holders.values() for a in held for b in held if a != b]
    for a, b in (*joined, *((meant[a], meant[b]) for a, b in slides)):
        near[a].add(b)
        near[b].add(a)
    apart: list[tuple[str, ...]] = []
    seen: set[str] = set()
    for start in (names.frame, *names.points):
        if start in seen:
            continue
        reached, todo = {start}, [start]
        while todo:
            new = near[todo.pop()] - reached
            reached |= new
            todo += new
        seen |= reached
        if start != names.frame:
            apart.append(tuple(n for n in names.points if n in reached))
    return apart
