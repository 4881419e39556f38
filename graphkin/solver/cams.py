"""Cams and what they move: the law at many angles of the cam, what it gives the formulas of a mechanism, and the
profile in closed form: pitch curve, contact, normal, curvature and pressure angle.

With P the follower's point from the cam's axis, and derivatives by the cam's own angle, w = P' - iP is the tangent of
the pitch curve and i w points out of the cam; a flat face touches where the normal passes the instant centre (Norton,
Cam Design and Manufacturing Handbook, ch. 7; Sun Huan, Mechanical Principles, ch. 9).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, dot
from graphkin.scene.cams import SEAM, TURN, FollowerLaw, LawCam, Lift, SlidingFollower
from graphkin.scene.tables import Units
from graphkin.solver.joints import turned
from graphkin.solver.pose import Array
from graphkin.structure import Structure
from graphkin.words import Phrase, Wording

__all__ = [
    "CamAt", "CamContact", "beginning", "cam_angle", "cam_at", "cam_with", "contact_of", "follower_inputs",
    "greatest_jerk", "lifts", "meeting_followers",
]  # fmt: skip

@dataclass(frozen=True)
class CamAt:
    """A cam and its follower at angles of the law; every field of shape (n,), places from the cam's axis (m).

    Complex numbers stand in the axes of the frame, and turned back by ``turn``, the direction of the cam's own axis, in
    those of the cam.

    point : the roller's centre or edge, of a flat face its foot
    normal : unit, out of the cam
    contact : where cam and follower touch
    way : the direction in which the follower's point moves, unit
    radius : of curvature of the profile, positive where the cam is convex; infinite where it is straight
    leaning : the angle from way to normal (rad), with sign
    leaning_rate, radius_rate : by the cam's own angle
    """

    lift: Array
    slope: Array
    turn: Array
    point: Array
    normal: Array
    contact: Array
    way: Array
    radius: Array
    leaning: Array
    leaning_rate: Array
    radius_rate: Array

    @property
    def pressure(self) -> Array:
        """Pressure angle (rad), in 0 .. pi/2."""
        return np.asarray(np.minimum(np.abs(self.leaning), np.pi - np.abs(self.leaning)))

    @property
    def pitch(self) -> Array:
        """The pitch curve in the cam's own axes, from its axis (m)."""
        return np.asarray(self.point * np.conj(self.turn))

    @property
    def profile(self) -> Array:
        """The profile in the cam's own axes, from its axis (m)."""
        return np.asarray(self.contact * np.conj(self.turn))


def cam_at(cam: LawCam, degree: Array) -> CamAt:
    """The cam at angles of its law (rad), a seam belonging to the later piece."""
    degree = np.asarray(degree, dtype=float)
    return cam_with(cam, degree, lifts(cam.law, degree))


def cam_with(cam: LawCam, degree: Array, lift: Lift) -> CamAt:
    """The cam at angles of its law, with the lift there: at seams that of either side."""
    sense, motion = cam.sense, cam.motion
    u = np.exp(1j * sense * np.asarray(degree, dtype=float))
    s0, s1, s2 = np.asarray(lift.lift), sense * np.asarray(lift.slope), np.asarray(lift.bend)
    course = cam.course(beginning(cam), lift, np.exp)
    point, way, tangent, bend = course.point, course.way, course.tangent, course.bend
    with np.errstate(all="ignore"):
        if cam.flat:
            assert isinstance(motion, SlidingFollower)
            normal = way
            contact = motion.along * (beginning(cam) + s0) - 1j * motion.along * s1
            radius = beginning(cam) + s0 + s2
        else:
            normal = 1j * tangent / np.abs(tangent)
            contact = point - cam.roller * normal
            radius = -(np.abs(tangent) ** 3) / cross(tangent, bend) - cam.roller
        if cam.flat:
            leaning_rate, radius_rate = 0.0 * s1, s1 + sense * np.asarray(lift.jerk)
        else:
            size, turn = np.abs(tangent), cross(tangent, bend)
            leaning_rate = turn / size**2 + 1.0 - course.turning
            radius_rate = (size**3 * cross(tangent, course.jerk) - 3.0 * size * dot(tangent, bend) * turn) / turn**2
    leaning = np.angle(normal * np.conj(way))
    found = (s0, lift.slope, u, point, normal, contact, way, radius, leaning, leaning_rate, radius_rate)
    return CamAt(*map(np.asarray, found))


@dataclass(frozen=True)
class CamContact:
    """What stands at a cam's contact, in the frame: place (m), unit normal out of the cam, velocity of the cam's point
    minus that of the follower's (m/s), pressure angle of the follower (rad), lift (m, rad); each of shape (n,)."""

    lift: Array
    contact: Array
    normal: Array
    slip: Array
    pressure: Array


def contact_of(cam: LawCam, turn: Array, omega: Array) -> CamContact:
    """The contact where the cam's own axis points along unit complex numbers and turns at a rate (rad/s)."""
    at = cam_at(cam, cam.sense * np.angle(turn))
    motion, rate = cam.motion, cam.sense * at.slope * omega
    if isinstance(motion, SlidingFollower):
        follower = motion.along * rate
    else:
        follower = 1j * motion.side * rate * (cam.axis + at.contact - motion.centre)
    slip = 1j * omega * at.contact - follower
    slip = slip - at.normal * dot(at.normal, slip)  # what rounding leaves across
    return CamContact(at.lift, cam.axis + at.contact, at.normal, slip, at.pressure)


def lifts(law: FollowerLaw, angle: Array) -> Lift:
    """Lift and derivatives at angles of the cam (rad), each of shape (n,); a seam belongs to the later piece."""
    within = np.remainder(np.asarray(angle, dtype=float), TURN)
    seams = np.array([*law.starts, TURN])
    nearest = np.argmin(np.abs(within[:, None] - seams[None, :]), axis=1)
    near = np.abs(within - seams[nearest]) < SEAM
    within = np.where(near, seams[nearest] % TURN, within)
    which = np.searchsorted(seams, within, side="right") - 1
    found = np.empty((4, len(within)))
    for k, part in enumerate(law.parts):
        rows = which == k
        if rows.any():
            for order, values in enumerate(part.at(within[rows], np)):
                found[order, rows] = values
    return Lift(*found)


def greatest_jerk(law: FollowerLaw) -> float:
    """The greatest third derivative of the lift (m or rad, per rad3), jumps left out."""
    at = [
        abs(part.at(part.start + x * (part.end - part.start)).jerk) for part in law.parts for x in (0.0, 0.25, 0.5, 1.0)
    ]
    return float(max(at))


def cam_angle(cam: LawCam, turn: Array) -> Array:
    """The angle of the law (rad) where the cam's own axis points along unit complex numbers."""
    return np.asarray(cam.sense * np.angle(turn))


def beginning(cam: LawCam, units: Units | None = None) -> float:
    """Where the follower stands at lift 0: distance beyond the foot (m), or angle of its bar (rad).

    Raises
    ------
    Unsolvable : it does not come to the base circle
    """
    found = cam.beginning
    if found is not None:
        return found
    raise Unsolvable("not assembled", Problem(f"cams.{cam.link}", *_apart(cam, units or Units())))


def _apart(cam: LawCam, units: Units) -> tuple[Wording, Wording]:
    motion = cam.motion

    def length(metres: float) -> str:
        return f"{metres / units.metres:.6g} {units.length}"

    if isinstance(motion, SlidingFollower):
        said = Phrase("the line of follower passes outside the base", follower=cam.follower)
        return said, Phrase("its radius is at least the offset", length=length(abs(motion.offset)))
    far = abs(cam.axis - motion.centre)
    said = Phrase("follower does not reach the base circle of", follower=cam.follower)
    return said, Phrase(
        "its radius lies between and", length=length(abs(far - motion.arm)), other=length(far + motion.arm)
    )


def meeting_followers(structure: Structure) -> Structure:
    """The structure itself, if every follower comes to its base circle.  Raises Unsolvable, all of them named."""
    problems: list[Problem] = []
    for cam in structure.scene.cams:
        try:
            beginning(cam, structure.scene.units)
        except Unsolvable as stop:
            problems += stop.problems
    if problems:
        raise Unsolvable("not assembled", *problems)
    return structure


def follower_inputs(cam: LawCam, turn: Array) -> Mapping[str, Array]:
    """What the formulas of a follower take at each position, by the direction of the cam's own axis.

    travel (m), or cos and sin of the angle of the follower's own axis, and the two derivatives of either by the angle
    of the cam's own axis, slope and bend
    """
    lift, start = lifts(cam.law, cam_angle(cam, turn)), beginning(cam)
    motion = cam.motion
    if isinstance(motion, SlidingFollower):
        return {"travel": motion.travel + start + lift.lift, "slope": cam.sense * lift.slope, "bend": lift.bend}
    line = cam.axis - motion.centre
    line = line / abs(line) * (-1 if motion.back else 1)
    axis = line * turned(motion.side * (start + lift.lift))
    return {"cos": axis.real, "sin": axis.imag, "slope": motion.side * cam.sense * lift.slope,
            "bend": motion.side * lift.bend}  # fmt: skip
