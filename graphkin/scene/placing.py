"""Points and guides of a link in its own axes, from the ways in which a file may give them.

Each function answers with a plane vector (m), None while something that it refers to is not known yet, or a
``Problem`` where what is known does not fit.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from graphkin.errors import Problem
from graphkin.plane import cross_arcs, degrees, direction
from graphkin.scene.model import PlacedGuide
from graphkin.scene.tables import Compass, Guide, Link, Polar
from graphkin.words import Phrase

__all__ = ["Placement", "circle_of_references", "guide_of", "origins_of", "place_of"]

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
