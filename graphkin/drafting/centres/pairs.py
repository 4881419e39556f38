"""What the joints give: permanent centres, and the common normals of pins in slots."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

from graphkin.drafting.centres.chart import Chart, Line, Place
from graphkin.drafting.sheet import Pose
from graphkin.plane import dot
from graphkin.scene.model import Scene

__all__ = ["Links", "Normal", "Pair", "Permanent", "links_on_paper", "normals", "permanent"]

Pair = tuple[str, str]


@dataclass(frozen=True)
class Links:
    """Every link where it lies on paper: the frame first, then in the order of the file; ``mm`` of paper for one m.

    Blocks that only stand for a pin in a slot are no links.  A redundant link is one if turning pairs hold two of its
    points.
    """

    scene: Scene
    mm: float
    poses: Mapping[str, Pose]

    @property
    def names(self) -> tuple[str, ...]:
        named = (self.scene.frame.name, *(link.name for link in self.scene.links))
        return tuple(name for name in named if name in self.poses)

    @cached_property
    def pairs(self) -> tuple[Pair, ...]:
        """All pairs, each written in the order of the file, the frame last."""
        return tuple(self.pair(a, b) for a, b in combinations(self.names, 2))

    def pair(self, a: str, b: str) -> Pair:
        order = self.scene.order
        return (a, b) if order[a] < order[b] else (b, a)

    def place(self, link: str, local: complex) -> complex:
        """A place given in a link's own axes (m), on paper (mm)."""
        pose = self.poses[link]
        return pose.origin + pose.axis * (local * self.mm)

    def point(self, name: str) -> complex:
        """A pin or a point of any link, on paper (mm)."""
        holder = next(n for n in self.scene.holders[name] if n in self.poses)
        return self.place(holder, self.scene.by_name[holder].points[name])

    def chart(self) -> Chart:
        """The chart about the middle of all points and of all named guides' origins."""
        spots = [self.point(p) for p, names in self.scene.holders.items() if any(n in self.poses for n in names)]
        spots += [self.place(n, 0j) for n in self.names]
        left, right = min(z.real for z in spots), max(z.real for z in spots)
        low, high = min(z.imag for z in spots), max(z.imag for z in spots)
        half = abs(complex(right - left, high - low)) / 2
        return Chart(complex(left + right, low + high) / 2, half or self.scene.size * self.mm)


@dataclass(frozen=True)
class Permanent:
    """A centre that a joint gives: at a point (mm), or at infinity square to a guide."""

    pair: Pair
    place: Place
    point: complex | None
    joint: str


@dataclass(frozen=True)
class Normal:
    """The common normal of a pin (at ``foot``, mm) and its slot: the centre of the two links lies on it."""

    pair: Pair
    line: Line
    foot: complex
    key: str


def links_on_paper(scene: Scene, mm: float, poses: Mapping[str, Pose]) -> Links:
    """Links placed by the drawing, and those redundant ones that two turning pairs place."""
    placed = {name: pose for name, pose in poses.items() if name in scene.by_name}
    for link in scene.links:
        if link.name in placed:
            continue
        so_far = Links(scene, mm, placed)
        held = [p for p in link.points if any(n in placed for n in scene.holders[p])]
        if len(held) >= 2:
            a, b = held[:2]
            here, there = so_far.point(a), so_far.point(b)
            axis = (there - here) / ((link.points[b] - link.points[a]) * mm)
            placed[link.name] = Pose(here - axis * link.points[a] * mm, axis / abs(axis))
    return Links(scene, mm, placed)


def permanent(links: Links, chart: Chart) -> dict[Pair, Permanent]:
    """The centres that turning and sliding pairs give; k links at one hinge share k (k - 1) / 2 of them."""
    found: dict[Pair, Permanent] = {}
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
    return found


def normals(links: Links, chart: Chart) -> list[Normal]:
    """For each pin in a slot the line through the pin square to the slot."""
    found = []
    for pin in links.scene.pins:
        if pin.of in links.poses and pin.on in links.poses and pin.of != pin.on:
            guide = links.scene.by_name[pin.on].guides[pin.guide]
            along = links.poses[pin.on].axis * guide.direction
            at = links.place(pin.of, links.scene.by_name[pin.of].points[pin.point])
            start = links.place(pin.on, guide.through)
            foot = start + along * dot(at - start, along)
            found.append(Normal(links.pair(pin.of, pin.on), chart.line(foot, 1j * along), foot, pin.key))
    return found
