"""What the joints of a mechanism give on paper: permanent centres, and the common normals of pins in slots.

Places of the plane with infinity among them have homogeneous coordinates of unit length.  A place is (x, y, w): the
point (x + iy) / w of the chart, or for w = 0 the direction x + iy.  A line is (a, b, c) with a x + b y + c w = 0.  The
line through two places and the place where two lines cross are both vector products; the length of the product is the
sine of the angle between the two on the unit sphere, and says how well they tell apart (Coxeter, Projective Geometry;
Kimbrell, Kinematics Analysis and Synthesis, on centres at infinity).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

from graphkin.construction.links_on_paper import Pose
from graphkin.construction.touching import Touching
from graphkin.plane import dot
from graphkin.scene.model import Mechanism

__all__ = [
    "Line",
    "LinkPair",
    "Links",
    "Normal",
    "Place",
    "ProjectiveChart",
    "links_on_paper",
    "normal",
    "normals",
    "permanent",
    "product",
    "wedge",
]

Place = tuple[float, float, float]
Line = tuple[float, float, float]
INFINITE = 1e-12
"""A place whose third coordinate is smaller lies at infinity: so far off that doubles do not tell it from there."""


def wedge(a: Place, b: Place) -> tuple[Place, float]:
    """The vector product of two places (a line) or of two lines (a place), of unit length, and the sine between them.

    Both are (0, 0, 0) and 0 where the two are the same.
    """
    x, y, w = a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
    sine = math.sqrt(x * x + y * y + w * w)
    if sine == 0.0:
        return (0.0, 0.0, 0.0), 0.0
    return (x / sine, y / sine, w / sine), sine


def product(a: Place, b: Place) -> float:
    """Scalar product: for a place and a line the distance (on the sphere) of one from the other."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normal(a: Place) -> Place:
    """The same place with coordinates of unit length, w not negative."""
    length = math.copysign(math.sqrt(product(a, a)), a[2])
    return a[0] / length, a[1] / length, a[2] / length


@dataclass(frozen=True)
class ProjectiveChart:
    """The sheet as seen from the middle of the mechanism: ``unit`` (mm) is half its size, so that it spans about 1."""

    middle: complex
    unit: float

    def at(self, z: complex) -> Place:
        """A point of the sheet (mm)."""
        s = (z - self.middle) / self.unit
        return normal((s.real, s.imag, 1.0))

    def towards(self, direction: complex) -> Place:
        """The place at infinity in a direction."""
        size = abs(direction)
        return direction.real / size, direction.imag / size, 0.0

    def line(self, z: complex, along: complex) -> Line:
        """The line through a point of the sheet (mm) along a direction."""
        return wedge(self.at(z), self.towards(along))[0]

    def point(self, place: Place) -> complex | None:
        """The point of the sheet (mm), None at infinity."""
        x, y, w = place
        return None if abs(w) < INFINITE else self.middle + self.unit * (complex(x, y) / w)

    def direction(self, place: Place) -> complex:
        """The way to a place from the middle of the sheet, of unit length; to the right, or straight up."""
        x, y, _ = place
        size = math.hypot(x, y) or 1.0
        sense = -1.0 if x < 0.0 or (x == 0.0 and y < 0.0) else 1.0
        return complex(x, y) * (sense / size)

    def pole(self, at: complex, velocity: complex, omega: float) -> tuple[Place, float]:
        """Where a motion has no velocity: the motion that gives the point ``at`` (mm) a velocity (mm/s) and turns at
        ``omega`` (rad/s).  Returns the place and the strength: 0 where nothing moves (and then no place is meant).

        The velocity of z is i omega (z - pole): with pole = q / omega, q = omega z + i v at any z.
        """
        q = omega * (at - self.middle) / self.unit + 1j * velocity / self.unit
        strength = math.hypot(abs(q), omega)
        if strength == 0.0:
            return (0.0, 0.0, 0.0), 0.0
        place = (q.real / strength, q.imag / strength, omega / strength)
        return (place, strength) if omega >= 0.0 else ((-place[0], -place[1], -place[2]), -strength)

    def velocity(self, place: Place, strength: float, z: complex) -> complex:
        """The velocity (mm/s) of the point z of the sheet in a rotation about a place; the reverse of `pole`."""
        x, y, w = place
        return 1j * strength * (w * (z - self.middle) - complex(x, y) * self.unit)


LinkPair = tuple[str, str]


@dataclass(frozen=True)
class Links:
    """Every link where it lies on paper: the frame first, then in the order of the file; ``mm`` of paper for one m.

    Blocks that only stand for a pin in a slot are no links.  A redundant link is one if turning pairs hold two of its
    points.
    """

    scene: Mechanism
    mm: float
    poses: Mapping[str, Pose]

    @property
    def names(self) -> tuple[str, ...]:
        named = (self.scene.frame.name, *(link.name for link in self.scene.links))
        return tuple(name for name in named if name in self.poses)

    @cached_property
    def touching(self) -> Touching:
        """What touches among them."""
        return Touching(self.scene, self.mm, self.poses)

    @cached_property
    def pairs(self) -> tuple[LinkPair, ...]:
        """All pairs, each written in the order of the file, the frame last."""
        return tuple(self.pair(a, b) for a, b in combinations(self.names, 2))

    def pair(self, a: str, b: str) -> LinkPair:
        order = self.scene.order
        return (a, b) if order[a] < order[b] else (b, a)

    def place(self, link: str, local: complex) -> complex:
        """A place given in a link's own axes (m), on paper (mm)."""
        return self.poses[link].place(local * self.mm)

    def point(self, name: str) -> complex:
        """A pin or a point of any link, or the point of a contact, on paper (mm)."""
        contact = next((c for c in self.scene.contacts if c.name == name), None)
        if contact is not None:
            return self.touching.contact(contact)[0]
        holder = next(n for n in self.scene.holders[name] if n in self.poses)
        return self.place(holder, self.scene.by_name[holder].points[name])

    def chart(self) -> ProjectiveChart:
        """The chart about the middle of all points and of all named guides' origins."""
        spots = [self.point(p) for p, names in self.scene.holders.items() if any(n in self.poses for n in names)]
        spots += [self.place(n, 0j) for n in self.names]
        left, right = min(z.real for z in spots), max(z.real for z in spots)
        low, high = min(z.imag for z in spots), max(z.imag for z in spots)
        half = abs(complex(right - left, high - low)) / 2
        return ProjectiveChart(complex(left + right, low + high) / 2, half or self.scene.size * self.mm)


@dataclass(frozen=True)
class Permanent:
    """A centre that a joint gives: at a point (mm), or at infinity square to a guide; or where two links roll."""

    pair: LinkPair
    place: Place
    point: complex | None
    joint: str
    rolls: bool = False


@dataclass(frozen=True)
class Normal:
    """The common normal of a pin (at ``foot``, mm) and its slot: the centre of the two links lies on it."""

    pair: LinkPair
    line: Line
    foot: complex
    key: str


def links_on_paper(scene: Mechanism, mm: float, poses: Mapping[str, Pose]) -> Links:
    """Links placed by the drawing, and those redundant ones that two turning pairs place."""
    placed = {name: pose for name, pose in poses.items() if name in scene.by_name}
    for link in scene.links:
        if link.name in placed:
            continue
        so_far = Links(scene, mm, placed)
        held = [p for p in link.points if any(n in placed for n in scene.holders[p])]
        if len(held) >= 2 and link.points[held[0]] != link.points[held[1]]:
            a, b = held[:2]
            here, there = so_far.point(a), so_far.point(b)
            axis = (there - here) / ((link.points[b] - link.points[a]) * mm)
            placed[link.name] = Pose(here - axis * link.points[a] * mm, axis / abs(axis))
    return Links(scene, mm, placed)


def permanent(links: Links, chart: ProjectiveChart) -> dict[LinkPair, Permanent]:
    """The centres that turning, sliding and rolling pairs give; k links at one hinge share k (k - 1) / 2 of them."""
    found: dict[LinkPair, Permanent] = {}
    for point, holders in links.scene.holders.items():
        here = [name for name in holders if name in links.poses]
        for a, b in combinations(here, 2):
            z = links.point(point)
            found.setdefault(links.pair(a, b), Permanent(links.pair(a, b), chart.at(z), z, point))
    for s in links.scene.slidings:
        if s.link in links.poses and s.on in links.poses:
            guide = links.scene.by_name[s.on].guides[s.guide]
            square = 1j * links.poses[s.on].axis * guide.direction
            pair = links.pair(s.link, s.on)
            found.setdefault(pair, Permanent(pair, chart.towards(square), None, s.key))
    for a, b, z, name in links.touching.rolling():
        found.setdefault(links.pair(a, b), Permanent(links.pair(a, b), chart.at(z), z, name, True))
    return found


def normals(links: Links, chart: ProjectiveChart) -> list[Normal]:
    """The common normals: of a pin in a slot the line through the pin square to the slot, and of sliding contacts."""
    found = []
    for pin in links.scene.pins:
        if pin.of in links.poses and pin.on in links.poses and pin.of != pin.on:
            guide = links.scene.by_name[pin.on].guides[pin.guide]
            along = links.poses[pin.on].axis * guide.direction
            at = links.place(pin.of, links.scene.by_name[pin.of].points[pin.point])
            start = links.place(pin.on, guide.through)
            foot = start + along * dot(at - start, along)
            found.append(Normal(links.pair(pin.of, pin.on), chart.line(foot, 1j * along), foot, pin.key))
    for contact in links.scene.contacts:
        if not contact.rolling and set(contact.links) <= links.poses.keys():
            at, along = links.touching.contact(contact)
            found.append(Normal(links.pair(*contact.links), chart.line(at, along), at, contact.name))
    return found
