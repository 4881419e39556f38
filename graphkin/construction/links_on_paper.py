"""Links on paper: where they lie, how they move, how hands prick and place them, how pairs hold a body of them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from graphkin.construction.instruments import EXACT, Instrument
from graphkin.construction.steps import OnPaper
from graphkin.plane import added_up, direction, dot, unit
from graphkin.scene.model import Driver, PlacedLink
from graphkin.structure import Body, Dyad, Pair, Structure

__all__ = [
    "LinkMotion", "PlacedLinks", "Pose", "Poses", "RigidBody", "across", "apart", "hinge", "inner_hinge",
    "pushed_by_driver", "rail", "start_board", "travel",
]  # fmt: skip


@dataclass(frozen=True)
class Pose(OnPaper):
    """Where a link lies on paper: its origin (mm) and the unit direction of its own x axis."""

    origin: complex
    axis: complex

    def place(self, own: complex) -> complex:
        """A place on paper (mm), given in the link's own axes (mm)."""
        return self.origin + self.axis * own

Poses = Mapping[str, Pose]


def apart(one: Poses, other: Poses) -> float:
    """How far links lie from where others of the same names do, on paper (mm, and direction by direction)."""
    return added_up(abs(p.origin - other[n].origin) + abs(p.axis - other[n].axis) for n, p in one.items())

SAME_HOLE = 1e-9
"""Points of a link that lie nearer to each other on paper (mm) are pricked once."""


@dataclass(frozen=True)
class LinkMotion:
    """A link moves so that its point ``at`` (mm) has ``velocity`` (mm/s on paper), and turns at ``omega`` (rad/s)."""

    at: complex
    velocity: complex
    omega: float

    def of(self, z: complex) -> complex:
        """Velocity (mm/s on paper) of the point of the link that lies at z (mm)."""
        return self.velocity + 1j * self.omega * (z - self.at)


@dataclass
class PlacedLinks:
    """Links on paper: their shapes at the length scale, the driver values, and where the known ones lie."""

    links: Mapping[str, PlacedLink]
    mm: float  # of paper for one m
    values: Mapping[str, float]  # drivers, rad or m
    poses: dict[str, Pose] = field(default_factory=dict)
    instrument: Instrument = EXACT
    pricked: dict[str, complex] = field(default_factory=dict)  # points as they came to lie, where hands err

    def place(self, link: str, local: complex) -> complex:
        """A place given in a link's own axes (m), on paper."""
        return self.poses[link].place(local * self.mm)

    def point(self, link: str, point: str) -> complex:
        if point in self.pricked:
            return self.pricked[point]
        return self.place(link, self.links[link].points[point])

    def fresh(self, poses: Poses) -> dict[str, complex]:
        """Places (m) of the points of more links, laid so, that none of those here has."""
        known = {p for name in self.poses for p in self.links[name].points}
        there = PlacedLinks(self.links, self.mm, self.values, dict(poses))
        return {p: there.point(n, p) / self.mm for n in poses for p in self.links[n].points if p not in known}

    def settle(self, names: Sequence[str]) -> None:
        """Prick the new points of links just placed, and let the links lie as their points came out."""
        if self.instrument.faultless:
            return
        for name in names:
            link, pose = self.links[name], self.poses[name]
            known = [p for p in link.points if p in self.pricked]
            for point in link.points:
                if point in self.pricked:
                    continue
                lies, own = self._settled(name, pose, known), link.points[point]
                same = next((p for p in known if abs(link.points[p] - own) * self.mm < SAME_HOLE), None)
                self.pricked[point] = (
                    self.pricked[same] if same else self.instrument.point(lies.origin + lies.axis * own * self.mm)
                )
                known.append(point)
            self.poses[name] = self._settled(name, pose, known)

    def _settled(self, name: str, pose: Pose, known: Sequence[str]) -> Pose:
        """A link as two of its points on paper hold it, the farthest apart; by one point with the direction drawn."""
        link = self.links[name]
        if not known:
            return pose
        a, b = max(((a, b) for a in known for b in known), key=lambda ab: abs(link.points[ab[0]] - link.points[ab[1]]))
        span = link.points[b] - link.points[a]
        axis = unit((self.pricked[b] - self.pricked[a]) / span) if abs(span) * self.mm > 1.0 else pose.axis
        return Pose(self.pricked[a] - axis * (link.points[a] * self.mm), axis)


def start_board(
    structure: Structure, mm: float, values: Mapping[str, float], instrument: Instrument = EXACT
) -> PlacedLinks:
    """The empty paper with the fixed points pricked, at driver values (rad, m); ``mm`` of paper for one m."""
    ground = structure.scene.frame.name
    paper = PlacedLinks(structure.links, mm, structure.followed(values), {ground: Pose(0j, 1 + 0j)}, instrument)
    if not instrument.faultless:
        paper.pricked.update({p: instrument.point(z * mm) for p, z in structure.links[ground].points.items()})
    return paper


class RigidBody:
    """A body as one piece: its points in mm in the axes of its base link."""

    def __init__(self, paper: PlacedLinks, body: Body) -> None:
        self.paper = paper
        self.body = body
        self.rel: dict[str, Pose] = {body.links[0]: Pose(0j, 1 + 0j)}
        for joint in body.joints:
            value = paper.values[joint.driver.key]
            base = self.rel[joint.a]
            if joint.pair.turns:
                turned = (joint.driver.link == joint.b) if joint.driver.turns else True
                axis = base.axis * direction(math.degrees(value if turned else -value))
                hinge = base.place(self._local(joint.a, joint.pair.point))
                self.rel[joint.b] = Pose(hinge - axis * self._local(joint.b, joint.pair.point), axis)
            else:
                self.rel[joint.b] = across(joint.pair, joint.b, base, value * paper.mm, paper.mm)

    def _local(self, link: str, point: str) -> complex:
        return self.paper.links[link].points[point] * self.paper.mm

    def point(self, link: str, point: str) -> complex:
        pose = self.rel[link]
        return pose.place(self._local(link, point))

    def placed(self, base: Pose) -> dict[str, Pose]:
        """Its links, its base link lying so."""
        if not self.body.joints:
            return {self.body.links[0]: Pose(base.origin, unit(base.axis))}
        return {
            name: Pose(base.place(rel.origin), unit(base.axis * rel.axis))
            for name, rel in self.rel.items()
        }

    def through(self, local: tuple[complex, complex], world: tuple[complex, complex]) -> dict[str, Pose]:
        """Place the body by two of its points."""
        axis = unit((world[1] - world[0]) / (local[1] - local[0]))
        return self.placed(Pose(world[0] - axis * local[0], axis))


def travel(slide: Pair, poses: Poses, mm: float) -> float:
    """How far what slides has gone along its guide, from the guide's origin to its own (mm); ``mm`` of paper for one m.
    """
    guide = poses[slide.b]
    start = guide.place(slide.guide.through * mm)
    return dot(poses[slide.a].origin - start, guide.axis * slide.guide.direction)


def reading(structure: Structure, driver: Driver, poses: Poses, mm: float) -> float:
    """The value of a driver off the links as they lie (rad, m); ``mm`` of paper for one m."""
    if driver.turns:
        return cmath.phase(poses[driver.link].axis / poses[driver.relative_to].axis)
    return travel(structure.slide(driver.slide), poses, mm) / mm


def across(slide: Pair, link: str, other: Pose, travel: float, mm: float) -> Pose:
    """Pose of one side of a sliding pair from the other and the travel (mm)."""
    g, start = slide.guide.direction, slide.guide.through * mm
    if link == slide.a:
        return Pose(other.place(start + travel * g), other.axis * g * slide.turn)
    axis = other.axis * (g * slide.turn).conjugate()
    return Pose(other.origin - axis * (start + travel * g), axis)


def hinge(paper: PlacedLinks, shape: RigidBody, pair: Pair) -> tuple[complex, complex]:
    """An outer turning pair: its place on paper and in the body's axes."""
    return paper.point(pair.b, pair.point), shape.point(pair.a, pair.point)


def _holder(body: Body, paper: PlacedLinks, point: str) -> str:
    return next(name for name in body.links if point in paper.links[name].points)


def inner_hinge(paper: PlacedLinks, dyad: Dyad, one: RigidBody, two: RigidBody) -> tuple[str, complex, complex]:
    """The inner turning pair: its letter and its place in each body's axes."""
    point = dyad.inner.point
    return (
        point,
        one.point(_holder(dyad.first, paper, point), point),
        two.point(_holder(dyad.second, paper, point), point),
    )


def rail(paper: PlacedLinks, shape: RigidBody, slide: Pair) -> tuple[Pose, complex]:
    """A body on a known guide, or with a guide on a known block: its pose at travel 0 and the way of it per mm."""
    mine = slide.a if slide.a in shape.rel else slide.b
    known = slide.b if mine == slide.a else slide.a
    at_zero = across(slide, mine, paper.poses[known], 0.0, paper.mm)
    rel = shape.rel[mine]
    axis = unit(at_zero.axis * rel.axis.conjugate())
    # a block on a known guide goes along it; a guide on a known block goes against its own sense
    along = paper.poses[known].axis if mine == slide.a else -at_zero.axis
    step = paper.instrument.direction(unit(along * slide.guide.direction))
    return Pose(at_zero.origin - axis * rel.origin, axis), step


def pushed_by_driver(
    structure: Structure, values: Mapping[str, float], between: Iterable[str]
) -> tuple[Driver, float] | None:
    """The driver whose travel gives the distance of two points, and that (m), at values of the drivers; None for any
    other two."""
    ends = set(between)
    driver = next((d for d in structure.scene.drivers if _ends_of_travel(structure, d) == ends), None)
    return None if driver is None else (driver, abs(values[driver.key]))


def _ends_of_travel(structure: Structure, driver: Driver) -> set[str]:
    """The two points between which the travel of a driver counts: that of its guide's origin, and what slides; none
    where the guide does not begin in a point."""
    slide = next((s for s in structure.slides if s.key == driver.key), None)
    if driver.turns or slide is None or slide.pin is None:
        return set()
    on = structure.scene.by_name[slide.b].points
    least = 1e-9 * structure.scene.size
    origin = next((p for p, z in on.items() if abs(z - slide.guide.through) < least), None)
    return set() if origin is None else {origin, slide.pin}
