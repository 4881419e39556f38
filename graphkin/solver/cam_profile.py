"""The profile of a cam in closed form: pitch curve, contact, normal, curvature and pressure angle by the law.

With P the follower's point from the cam's axis, and derivatives by the cam's own angle, w = P' - iP is the tangent of
the pitch curve and i w points out of the cam; a flat face touches where the normal passes the instant centre (Norton,
Cam Design and Manufacturing Handbook, ch. 7; Sun Huan, Mechanical Principles, ch. 9).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphkin.plane import cross, dot
from graphkin.scene.cams import LawCam, Lift, SlidingFollower
from graphkin.solver.followers import beginning, lifts
from graphkin.solver.pose import Array

__all__ = ["CamAt", "CamContact", "cam_at", "cam_with", "contact_of"]


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
