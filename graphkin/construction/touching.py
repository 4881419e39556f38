"""Higher pairs on paper: the outlines of cams, found point by point, contacts with their normals, pitch circles, pitch
lines and pitch points.

A cam's follower is turned back with its line; the normal passes through the instant centre, and the roller's radius is
laid off along it.
"""

from __future__ import annotations

import cmath
import math
from cmath import phase
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache

from graphkin.construction.board.steps import OnPaper
from graphkin.plane import Pose, dot, unit
from graphkin.scene.laws import Lift
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import ContactMotion, HigherPair, LawCam, PlacedContact, PlacedGear, SlidingFollower

POINTS = 180
"""Stations of a turn, those at the seams besides them."""
PAST_ROLLER = 17.0
"""mm from the roller of a follower to the middle of its guide."""


@dataclass(frozen=True, eq=False, repr=False)
class Touch:
    """The contact of two links: its letter, its place, the direction of the common normal, and letters and places of
    the centres of round bodies, by link.  Meshing wheels have their centres held apart by another link: their force is
    tangential."""

    name: str
    links: tuple[str, str]
    at: complex
    normal: complex
    means: ContactMotion
    centres: Mapping[str, tuple[str, complex]] = field(default_factory=dict)

    def curvatures(self, links: Sequence[str], mm: float) -> list[float]:
        """The curvatures of the outlines of links (1/m) on paper of ``mm`` for one m, positive where the centre of
        curvature lies on the side of the normal; 0 for an outline that is not round."""
        return [mm / dot(self.centres[n][1] - self.at, self.normal) if n in self.centres else 0.0 for n in links]


@dataclass(frozen=True, eq=False, repr=False)
class CamOnPaper:
    """A cam and its follower on paper (mm): the profile, the follower's point, the contact, the normal (unit, out of
    the cam), the radius of the roller (0 without one)."""

    cam: LawCam
    profile: tuple[complex, ...]
    point: complex
    contact: complex
    normal: complex
    roller: float


@dataclass(frozen=True, eq=False, repr=False)
class Touching:
    """The higher pairs of links placed on paper; ``mm`` of paper for one m."""

    scene: Mechanism
    mm: float
    poses: Mapping[str, Pose]

    def place(self, link: str, point: str) -> complex:
        """A point of a link on paper (mm)."""
        return self.poses[link].place(self.scene.by_name[link].points[point] * self.mm)

    def of(self, pair: HigherPair) -> Touch:
        """The place of a contact, with its normal out of the face, or from the first centre to the second; the pitch
        point of a gear, with the line of centres as its normal, for a rack the normal of its pitch line; or the place
        of a cam, with its normal to the follower."""
        if isinstance(pair, LawCam):
            here = next(here for here in self.cams if here.cam is pair)
            return Touch("K", pair.bodies, here.contact, here.normal, pair.means)
        return self._contact(pair) if isinstance(pair, PlacedContact) else self._mesh(pair)

    def _contact(self, pair: PlacedContact) -> Touch:
        """The contact of two discs, which parts their line of centres (mm) as r1 : r2 with the signs of the radii; or
        of a disc and a face, at the radius from the centre square to the face."""
        centres = {link: (centre, self.place(link, centre))
                   for link, centre in zip(pair.round_links, pair.centres, strict=True)}
        first, *second = (place for _, place in centres.values())
        if pair.flat:
            guide = self.scene.by_name[pair.face].guides[pair.guide]
            normal = self.poses[pair.face].axis * guide.direction * pair.normal_to_face
            at = first - normal * pair.radii[0] * self.mm
            return Touch(pair.name, pair.bodies, at, normal, pair.means, centres)
        line = second[0] - first
        at = first + line * (pair.radii[0] / pair.apart)
        return Touch(pair.name, pair.bodies, at, line / abs(line), pair.means, centres)

    def _mesh(self, pair: PlacedGear) -> Touch:
        """The pitch point of two wheels, which parts the line of their axes (mm) as z1 : z2, internal teeth negative;
        of a rack the foot of the wheel's axis on its pitch line."""
        axes = zip(pair.bodies, pair.axes, strict=True)
        centres = {wheel: (letter, self.place(pair.carrier, letter)) for wheel, letter in axes if letter}
        wheel, other = pair.bodies
        axis, teeth = centres[wheel][1], pair.teeth[1]
        if teeth is None:
            rack, pose = self.scene.by_name[other].guides[pair.guide], self.poses[other]
            along, start = pose.axis * rack.direction, pose.place(rack.through * self.mm)
            at = start + along * dot(axis - start, along)
            return Touch(pair.name, pair.bodies, at, 1j * along, pair.means, centres)
        line = centres[other][1] - axis
        held = self.scene.by_name[pair.carrier].points
        normal = self.poses[pair.carrier].axis * (held[pair.axes[1]] - held[pair.axes[0]])
        share = pair.teeth[0] / (pair.teeth[0] + teeth)
        return Touch(pair.name, pair.bodies, axis + line * share, normal / abs(normal), pair.means, centres)

    def each(self) -> Iterator[tuple[HigherPair, Touch]]:
        """The higher pairs with all members on paper."""
        return ((p, self.of(p)) for p in self.scene.higher_pairs if self.poses.keys() >= {*p.members})

    def contacts(self) -> Iterator[tuple[PlacedContact, Touch]]:
        """The contacts of outlines among them."""
        return ((pair, touch) for pair, touch in self.each() if isinstance(pair, PlacedContact))

    def gears(self) -> Iterator[tuple[PlacedGear, Touch]]:
        """The gears among them."""
        return ((pair, touch) for pair, touch in self.each() if isinstance(pair, PlacedGear))

    def touches(self) -> Iterator[Touch]:
        """All of them, each with a letter of its own; a cam that a contact replaces is that contact."""
        between = {frozenset(contact.bodies) for contact, _ in self.contacts()}
        taken = {*self.scene.holders, *self.scene.contact_at}
        for pair, touch in self.each():
            if isinstance(pair, PlacedContact):
                yield touch
            elif not (pair.by_law and frozenset(pair.bodies) in between):
                name = touch.name
                while name in taken:
                    name += "'"
                taken.add(name)
                yield replace(touch, name=name)

    def rolling(self) -> Iterator[Touch]:
        """The points of rolling, by the name of the contact or the gear."""
        return (touch for pair, touch in self.each() if pair.rolling)

    def named(self, name: str) -> Touch:
        """The place of a contact, or of a mesh."""
        return next(self.of(pair) for pair in self.scene.higher_pairs if pair.name == name)

    @cached_property
    def cams(self) -> tuple[CamOnPaper, ...]:
        """The cams with the followers that they touch."""
        cams = []
        for pair in self.scene.cams:
            if self.poses.keys() >= {*pair.bodies}:
                pose = self.poses[pair.link]
                at = station(pair, pair.sense * phase(pose.axis))
                point, contact = (pose.origin + pose.axis * z * self.mm for z in (at.point, at.contact))
                cams.append(CamOnPaper(pair, self.profile(pair), point, contact, pose.axis * at.normal,
                                       pair.roller * self.mm))
        return tuple(cams)

    def profile(self, cam: LawCam) -> tuple[complex, ...]:
        """The profile of a cam on paper."""
        pose = self.poses[cam.link]
        return tuple(pose.origin + pose.axis * at.contact * self.mm for at in stations(cam))

    def clearance(self, slide: str) -> float:
        """How far (mm) the block of a sliding pair stands beyond the first point of its link: clear of the roller of a
        follower."""
        cam = self.scene.law_of(slide)
        return 0.0 if cam is None else cam.roller * self.mm + PAST_ROLLER

    def pitch_circles(self) -> Iterator[tuple[str, complex, float]]:
        """Wheels with the centre and the radius (mm, negative for internal teeth) of each pitch circle."""
        for gear, touch in self.gears():
            for wheel, teeth in zip(gear.bodies, gear.teeth, strict=True):
                if teeth is not None:
                    _, centre = touch.centres[wheel]
                    yield wheel, centre, math.copysign(abs(touch.at - centre), teeth)

    def pitch_lines(self) -> Iterator[tuple[str, complex, complex]]:
        """Racks with the pitch point, and the direction from the wheel to the rack's body."""
        for gear, touch in self.gears():
            if gear.is_rack:
                yield gear.bodies[1], touch.at, unit(touch.at - touch.centres[gear.bodies[0]][1])

    def outermost(self, of: Collection[str] | None = None) -> list[complex]:
        """The four outermost places of each round outline and each pitch circle, and the profiles of cams, ``of`` some
        links or of all."""
        names = self.poses.keys() if of is None else self.poses.keys() & of
        circles = [(c, abs(radius)) for wheel, c, radius in self.pitch_circles() if wheel in names]
        for link in (self.scene.frame, *self.scene.links):
            if link.name in names:
                circles += [(self.place(link.name, d.centre), abs(d.r) * self.mm) for d in link.discs.values()]
        profiles = (self.profile(cam) for cam in self.scene.cams if cam.link in names)
        spots = [z for profile in profiles for z in profile]
        return spots + [centre + radius * side for centre, radius in circles for side in (1, 1j, -1, -1j)]


# the outlines of cams


@dataclass(frozen=True, eq=False, repr=False)
class CamStation(OnPaper):
    """The follower turned back about the cam (inversion), in the cam's own axes from its axis (any unit of length).

    Parameters
    ----------
    degree, lift : of the cam (rad), and of the follower there (m, rad)
    line : a point of the follower's line (the foot), or of the bar (the pivot)
    base : its point at lift 0
    point : its point (roller's centre, edge, foot of the face)
    centre : instant centre of cam and follower; None where the follower swings at the cam's own rate
    normal : unit, out of the cam
    contact : point of the profile
    way : the direction in which the point moves
    """

    degree: float
    lift: float
    line: complex
    base: complex
    point: complex
    centre: complex | None
    normal: complex
    contact: complex
    way: complex

    @property
    def leaning(self) -> float:
        """The angle from path to normal (rad), with its sense."""
        return cmath.phase(self.normal / self.way)

    @property
    def pressure(self) -> float:
        """The angle between normal and path, as the protractor reads it (rad)."""
        return min(abs(self.leaning), math.pi - abs(self.leaning))


def station(cam: LawCam, degree: float, lift: Lift | None = None) -> CamStation:
    """The follower at an angle of the law, lengths in m.

    The instant centre of cam and follower, through which the normal goes, lies ds/dphi beside the axis, square to the
    path of a sliding follower; that of a swinging one on the line of both pivots, at distances from the axis and from
    the pivot that are as dpsi/dphi to 1 (Norton, Cam Design and Manufacturing Handbook, ch. 7).

    Parameters
    ----------
    degree : of the cam (rad)
    lift : of one side of a seam; None for that of the law
    """
    lift = lift or cam.law.at(degree)
    back = cmath.rect(1.0, -cam.sense * degree)
    motion = cam.motion
    course, base = cam.course(lift), cam.course(Lift(0.0, 0.0, 0.0, 0.0)).point
    point, travel, outward = course.point, course.way, 1j * course.tangent
    if isinstance(motion, SlidingFollower):
        line = motion.foot - cam.axis
        centre: complex | None = -1j * travel * cam.sense * lift.slope
    else:
        line = motion.centre - cam.axis
        ratio = motion.side * cam.sense * lift.slope
        centre = None if ratio == 1.0 else -ratio * line / (1.0 - ratio)
    if cam.flat:
        assert centre is not None
        normal, contact = travel, centre + travel * dot(travel, point)
    else:
        # square to the motion of the point as seen from the cam, and so through the instant centre
        normal = outward if centre is None else point - centre
        normal = unit(normal) if normal else travel
        normal = -normal if dot(normal, outward) < 0.0 else normal
        contact = point - cam.roller * normal
    centre = None if centre is None else centre * back
    return CamStation(degree, lift.lift, line * back, base * back, point * back, centre, normal * back, contact * back,
                      travel * back)


@lru_cache(maxsize=64)
def stations(cam: LawCam) -> tuple[CamStation, ...]:
    """The follower turned back to many places around a turn (lengths in m); on both sides of each seam of the law."""
    return tuple(station(cam, degree, part.at(degree)) for part in cam.law.parts for degree in part.places(POINTS))
