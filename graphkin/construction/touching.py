"""What touches, as it stands on paper: the outlines of cams, found point by point, contacts with their normals, pitch
circles, pitch lines and pitch points; and how far what rolls has gone, in angles and travels read off, since elsewhere.

A cam's follower is turned back with its line; the normal goes through the instant centre, and the roller's radius is
laid off along it.
"""

from __future__ import annotations

import cmath
import math
from cmath import phase
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Literal, NamedTuple

from graphkin.construction.links_on_paper import PlacedLinks, Pose, Poses, travel
from graphkin.plane import dot, unit
from graphkin.scene.cams import LawCam, SlidingFollower
from graphkin.scene.laws import TURN, Lift
from graphkin.scene.model import Mechanism, PlacedContact, PlacedGear
from graphkin.structure import Rolled, Structure
from graphkin.structure.model import Coordinate

__all__ = [
    "CamStation", "Touch", "Touching", "coordinate_on_paper", "outline", "outlines_on_paper", "rolled_near", "station",
]  # fmt: skip

POINTS = 180
"""Points of an outline, those at the seams beside them."""


@dataclass(frozen=True)
class Touch:
    """Two links that touch: a letter for it, where, and the direction of the common normal.  Wheels mesh whose centres
    another link holds apart: what they carry is tangential."""

    name: str
    links: tuple[str, str]
    at: complex
    normal: complex
    means: Literal["slides", "rolls", "meshes"]


@dataclass(frozen=True)
class Touching:
    """The contacts and gears of links placed on paper; ``mm`` of paper for one m."""

    scene: Mechanism
    mm: float
    poses: Mapping[str, Pose]

    def place(self, link: str, local: complex) -> complex:
        """A place given in a link's own axes (m), on paper (mm)."""
        return self.poses[link].place(local * self.mm)

    def contacts(self) -> Iterator[PlacedContact]:
        """The contacts both of whose links stand on paper."""
        return (c for c in self.scene.contacts if set(c.links) <= self.poses.keys())

    def gears(self) -> Iterator[PlacedGear]:
        """The gears whose wheels and carrier stand on paper."""
        return (g for g in self.scene.gears if {*g.wheels, g.carrier} <= self.poses.keys())

    def centres(self, contact: PlacedContact) -> list[complex]:
        """The centres of its discs."""
        return [self.place(d.link, self.scene.by_name[d.link].points[d.centre]) for d in contact.round]

    def contact(self, contact: PlacedContact) -> tuple[complex, complex]:
        """Where a contact is made, and the direction of its normal: out of the face, or from the first centre to the
        second."""
        spots = self.centres(contact)
        if contact.flat:
            guide = self.scene.by_name[contact.face].guides[contact.guide]
            normal = self.poses[contact.face].axis * guide.direction * contact.normal_to_face
            return spots[0] - normal * contact.round[0].radius * self.mm, normal
        one, two = contact.round
        way = spots[1] - spots[0]
        return spots[0] + way * (one.radius / (one.radius + two.radius)), way / abs(way)

    def pitch_point(self, gear: PlacedGear) -> complex:
        """Where the pitch circles touch, or circle and pitch line."""
        held = self.scene.by_name[gear.carrier].points
        axis = self.place(gear.carrier, held[gear.axes[0]])
        if gear.teeth[1] is None:
            rack = self.scene.by_name[gear.wheels[1]].guides[gear.guide]
            along = self.poses[gear.wheels[1]].axis * rack.direction
            start = self.place(gear.wheels[1], rack.through)
            return start + along * dot(axis - start, along)
        way = self.place(gear.carrier, held[gear.axes[1]]) - axis
        return axis + way * (gear.teeth[0] / (gear.teeth[0] + gear.teeth[1]))

    def normal(self, gear: PlacedGear) -> complex:
        """The direction of the line of centres of two wheels, of a rack square to its pitch line."""
        if gear.teeth[1] is None:
            rack = self.scene.by_name[gear.wheels[1]].guides[gear.guide]
            return 1j * self.poses[gear.wheels[1]].axis * rack.direction
        held = self.scene.by_name[gear.carrier].points
        way = self.poses[gear.carrier].axis * (held[gear.axes[1]] - held[gear.axes[0]])
        return way / abs(way)

    def touches(self) -> Iterator[Touch]:
        """Everything that touches: contacts, wheels, cams with their followers."""
        for contact in self.contacts():
            means: Literal["slides", "rolls", "meshes"] = "slides"
            if contact.rolling:
                means = "meshes" if contact.carrier else "rolls"
            yield Touch(contact.name, contact.links, *self.contact(contact), means)
        taken = {*self.scene.holders, *(contact.name for contact in self.scene.contacts)}
        for gear in self.gears():
            yield Touch(_free(gear.name, taken), gear.wheels, self.pitch_point(gear), self.normal(gear), "meshes")
        touched = [{*contact.links} for contact in self.contacts()]
        for cam in self.scene.cams:
            both = {cam.link, cam.follower}
            if both <= self.poses.keys() and both not in touched:  # drawn at the contact, it is one of the contacts
                pose = self.poses[cam.link]
                here = station(cam, cam.sense * phase(pose.axis))
                at, normal = pose.origin + pose.axis * here.contact * self.mm, pose.axis * here.normal
                yield Touch(_free("K", taken), (cam.link, cam.follower), at, normal, "slides")

    def rolling(self) -> Iterator[tuple[str, str, complex, str]]:
        """Links that roll on each other, where they touch, and the name of the contact or the gear."""
        for contact in self.contacts():
            if contact.rolling:
                yield *contact.links, self.contact(contact)[0], contact.name
        for gear in self.gears():
            yield *gear.wheels, self.pitch_point(gear), gear.name

    def rolling_centres(self, name: str) -> tuple[complex, complex, Mapping[str, complex]]:
        """Where a contact rolls or wheels mesh, the direction of their normal, and the centres of what is round there,
        by the links."""
        contact = next((c for c in self.contacts() if c.name == name), None)
        if contact is not None:
            spots = dict(zip((d.link for d in contact.round), self.centres(contact), strict=True))
            return *self.contact(contact), spots
        gear = next(g for g in self.gears() if g.name == name)
        held = self.scene.by_name[gear.carrier].points
        axes = {w: self.place(gear.carrier, held[p]) for w, p in zip(gear.wheels, gear.axes, strict=True) if p}
        return self.pitch_point(gear), self.normal(gear), axes

    def pitch_circles(self) -> Iterator[tuple[str, complex, float]]:
        """Wheels with the centre and the radius (mm, negative for internal teeth) of each pitch circle."""
        for gear in self.gears():
            held, at = self.scene.by_name[gear.carrier].points, self.pitch_point(gear)
            for wheel, axis, teeth in zip(gear.wheels, gear.axes, gear.teeth, strict=True):
                if teeth is not None:
                    centre = self.place(gear.carrier, held[axis])
                    yield wheel, centre, math.copysign(abs(at - centre), teeth)

    def pitch_lines(self) -> Iterator[tuple[str, complex, complex]]:
        """Racks with the pitch point, and the direction from the wheel to the rack's body."""
        for gear in self.gears():
            if gear.is_rack:
                at = self.pitch_point(gear)
                axis = self.place(gear.carrier, self.scene.by_name[gear.carrier].points[gear.axes[0]])
                yield gear.wheels[1], at, (at - axis) / abs(at - axis)

    def outermost(self, of: Collection[str] | None = None) -> list[complex]:
        """The four outermost places of each round outline and each pitch circle, ``of`` some links or of all."""
        names = self.poses.keys() if of is None else self.poses.keys() & of
        found = [(c, abs(radius)) for wheel, c, radius in self.pitch_circles() if wheel in names]
        for link in (self.scene.frame, *self.scene.links):
            if link.name in names:
                found += [(self.place(link.name, link.points[d.centre]), abs(d.radius) * self.mm) for d in link.discs]
        return [centre + radius * way for centre, radius in found for way in (1, 1j, -1, -1j)]


def _free(name: str, taken: set[str]) -> str:
    """A letter that no point has, from then on taken."""
    while name in taken:
        name += "'"
    taken.add(name)
    return name


TURNS = 3
"""Turns that what something rolls on may have made since the position from which it is followed."""


def rolled_near(structure: Structure, paper: PlacedLinks, driver: Rolled, start: Poses, guess: Poses) -> float:
    """The value of what rolls (rad, m) in a position that is being placed, by how far what it rolls on has gone since
    a position ``start`` within some turns; nearest to where it is expected."""
    before, near = (replace(paper, poses=dict(poses)) for poses in (start, guess))
    value, turns = coordinate_on_paper(structure, before, driver.coordinate), [0.0]
    for coordinate, factor in driver.factors:
        here, there = (coordinate_on_paper(structure, placed, coordinate) for placed in (paper, before))
        value += factor * (here - there)
        if coordinate[0] == "angle":
            turns = [more + k * math.tau * factor for more in turns for k in range(-TURNS, TURNS + 1)]
    wanted = coordinate_on_paper(structure, near, driver.coordinate)

    def off(whole: float) -> float:
        far = value + whole - wanted
        return abs(math.remainder(far, math.tau) if driver.turns else far)

    # of several that fit as well the one with the fewest turns
    return value + min(turns, key=lambda whole: (round(off(whole), 9), abs(whole)))


def coordinate_on_paper(structure: Structure, paper: PlacedLinks, coordinate: Coordinate) -> float:
    """An angle within a turn (rad), or a travel (m)."""
    kind, name = coordinate
    if kind == "angle":
        return cmath.phase(paper.poses[name].axis)
    slide = structure.slide(name)
    return travel(slide, paper.poses, paper.mm) / paper.mm


# -- the outlines of cams ----------------------------------------------------------------------------------------------


class CamStation(NamedTuple):
    """The follower turned back about the cam (inversion), in the cam's own axes from its axis (any unit of length).

    line : a point of the follower's line (the foot), or of the bar (the pivot)
    base : its point at lift 0
    point : its point (roller's centre, edge, foot of the face)
    centre : instant centre of cam and follower; None where the follower swings at the cam's own rate
    normal : unit, out of the cam
    contact : point of the profile
    way : the direction in which the point moves
    """

    line: complex
    base: complex
    point: complex
    centre: complex | None
    normal: complex
    contact: complex
    way: complex


def station(cam: LawCam, degree: float, lift: Lift | None = None) -> CamStation:
    """The follower at an angle of the law (rad), lengths in m; ``lift`` is that of one side, at a seam."""
    start, lift = cam.beginning or 0.0, lift or cam.law.at(degree)
    back = cmath.rect(1.0, -cam.sense * degree)
    motion = cam.motion
    point = cam.course(start, lift).point
    way = cam.course(start, lift).way
    base = cam.course(start, Lift(0.0, 0.0, 0.0, 0.0)).point
    if isinstance(motion, SlidingFollower):
        line = motion.foot - cam.axis
        centre: complex | None = -1j * way * cam.sense * lift.slope
    else:
        line = motion.centre - cam.axis
        ratio = motion.side * cam.sense * lift.slope
        centre = None if ratio == 1.0 else -ratio * line / (1.0 - ratio)
    if cam.flat:
        assert centre is not None
        normal, contact = way, centre + way * dot(way, point)
    else:
        # square to the motion of the point as seen from the cam, and so through the instant centre
        normal = 1j * cam.course(start, lift).tangent if centre is None else (point - centre)
        normal = unit(normal) if normal else way
        if dot(normal, 1j * cam.course(start, lift).tangent) < 0.0:
            normal = -normal
        contact = point - cam.roller * normal
    return CamStation(*(None if z is None else z * back for z in (line, base, point, centre, normal, contact, way)))  # type: ignore[arg-type]


@lru_cache(maxsize=64)
def outline(cam: LawCam) -> tuple[complex, ...]:
    """The profile in the cam's own axes, point by point over a turn (m); both sides of each seam."""
    found: list[complex] = []
    for part in cam.law.parts:
        count = max(2, math.ceil(POINTS * (part.end - part.start) / TURN))
        for k in range(count + 1):
            degree = part.start + (part.end - part.start) * k / count
            found.append(station(cam, degree, part.at(degree)).contact)
    return tuple(found)


def outlines_on_paper(scene: Mechanism, poses: Mapping[str, Pose], mm: float) -> Mapping[str, tuple[complex, ...]]:
    """The profile of each cam that stands on paper, by its link; ``mm`` of paper for one m."""
    found = {}
    for cam in scene.cams:
        if cam.link in poses:
            pose = poses[cam.link]
            found[cam.link] = tuple(pose.origin + pose.axis * z * mm for z in outline(cam))
    return found
