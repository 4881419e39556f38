"""Cams and their followers: the law at many angles of the cam, the inputs of a mechanism's formulas, and the profile in
closed form: pitch curve, contact, normal, curvature and pressure angle.

With P the follower's point from the cam's axis, and derivatives by the cam's own angle, w = P' - iP is the tangent of
the pitch curve and i w points out of the cam; a flat face touches where the normal passes the instant centre (Norton,
Cam Design and Manufacturing Handbook, ch. 7; Sun Huan, Mechanical Principles, ch. 9).

The study of a cam: pressure angles and their extremes, curvature and undercutting, rates, jumps.

Extremes are found where a derivative in closed form goes through zero, and at both sides of every seam.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from operator import attrgetter

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, dot
from graphkin.scene.laws import SEAM, TURN, FollowerLaw, Lift, LiftPiece
from graphkin.scene.pairs import LawCam, SlidingFollower, SwingingFollower
from graphkin.search import intervals, last_true, resolve
from graphkin.solver.algebra.pose import Array, turned
from graphkin.structure import Structure


@dataclass(frozen=True, eq=False, repr=False)
class CamAt:
    """A cam and its follower at angles of the law; every field of shape (n,), places from the cam's axis (m).

    Complex numbers are in the axes of the frame; turned back by ``turn``, the direction of the cam's own axis, in those
    of the cam.

    point : the roller's centre or edge, of a flat face its foot
    normal : unit, out of the cam
    contact : the point of contact of cam and follower
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
        return np.minimum(np.abs(self.leaning), np.pi - np.abs(self.leaning))

    @property
    def pitch(self) -> Array:
        """The pitch curve in the cam's own axes, from its axis (m)."""
        return self.point * np.conj(self.turn)

    @property
    def profile(self) -> Array:
        """The profile in the cam's own axes, from its axis (m)."""
        return self.contact * np.conj(self.turn)


def cam_at(cam: LawCam, degree: Array) -> CamAt:
    """The cam at angles of its law (rad), a seam belonging to the later piece."""
    degree = np.asarray(degree, dtype=float)
    return cam_with(cam, degree, lifts(cam.law, degree))


def cam_with(cam: LawCam, degree: Array, lift: Lift) -> CamAt:
    """The cam at angles of its law, with the lift there: at seams the lift of either side."""
    sense, motion = cam.sense, cam.motion
    u = np.exp(1j * sense * np.asarray(degree, dtype=float))
    s0, s1, s2 = np.asarray(lift.lift), sense * np.asarray(lift.slope), np.asarray(lift.second)
    course = cam.course(lift, np.exp)
    point, travel, tangent, tangent_rate = course.point, course.way, course.tangent, course.tangent_rate
    with np.errstate(all="ignore"):
        if cam.flat:
            assert isinstance(motion, SlidingFollower)
            normal = travel
            contact = motion.along * (cam.base + s0 - 1j * s1)
            radius = cam.base + s0 + s2
            leaning = leaning_rate = 0.0 * s1
            radius_rate = s1 + sense * np.asarray(lift.jerk)
        else:
            size, turn = np.abs(tangent), cross(tangent, tangent_rate)
            normal = 1j * tangent / size
            contact = point - cam.roller * normal
            radius = -(size**3) / turn - cam.roller
            leaning = np.angle(normal * np.conj(travel))
            leaning_rate = turn / size**2 + 1.0 - course.turning
            along = 3.0 * size * dot(tangent, tangent_rate)
            radius_rate = (size**3 * cross(tangent, course.jerk) - along * turn) / turn**2
    columns = (s0, lift.slope, u, point, normal, contact, travel, radius, leaning, leaning_rate, radius_rate)
    return CamAt(*map(np.asarray, columns))


def slip_of(cam: LawCam, at: CamAt, omega: Array) -> Array:
    """Velocity of the cam's point at the contact minus the follower's (m/s), of a cam that turns at a rate (rad/s),
    shape (n,)."""
    motion, rate = cam.motion, cam.sense * at.slope * omega
    if isinstance(motion, SlidingFollower):
        follower = motion.along * rate
    else:
        follower = 1j * motion.side * rate * (cam.axis + at.contact - motion.centre)
    slip = 1j * omega * at.contact - follower
    return slip - at.normal * dot(at.normal, slip)  # without what rounding leaves across


def lifts(law: FollowerLaw, angle: Array) -> Lift:
    """Lift and derivatives at angles of the cam (rad), each of shape (n,); a seam belongs to the later piece."""
    within = np.remainder(np.asarray(angle, dtype=float), TURN)
    seams = np.array([*law.starts, TURN])
    nearest = np.argmin(np.abs(within[:, None] - seams[None, :]), axis=1)
    near = np.abs(within - seams[nearest]) < SEAM
    within = np.where(near, seams[nearest] % TURN, within)
    which = np.searchsorted(seams, within, side="right") - 1
    rates = np.empty((4, len(within)))
    for k, part in enumerate(law.parts):
        rows = which == k
        if rows.any():
            for order, values in enumerate(part.at(within[rows], np)):
                rates[order, rows] = values
    return Lift(*rates)


def greatest_jerk(law: FollowerLaw) -> float:
    """The greatest third derivative of the lift (m or rad, per rad3), jumps left out."""
    at = [
        abs(part.at(part.start + x * (part.end - part.start)).jerk) for part in law.parts for x in (0.0, 0.25, 0.5, 1.0)
    ]
    return float(max(at))


def cam_angle(cam: LawCam, turn: Array) -> Array:
    """The angle of the law (rad) where the cam's own axis points along unit complex numbers."""
    return cam.sense * np.angle(turn)


def meeting_followers(structure: Structure) -> Structure:
    """The structure itself, if every follower comes to its base circle.  Raises Unsolvable, all of them named."""
    problems: list[Problem] = []
    for cam in structure.scene.cams:
        try:
            cam.beginning(structure.scene.units)
        except Unsolvable as stop:
            problems += stop.problems
    if problems:
        raise Unsolvable("not assembled", *problems)
    return structure


def follower_inputs(cam: LawCam, turn: Array) -> Mapping[str, Array]:
    """The inputs of a follower's formulas at each position, by the direction of the cam's own axis.

    travel (m), or cos and sin of the angle of the follower's own axis, and the two derivatives of either by the angle
    of the cam's own axis, slope and second derivative
    """
    lift, start = lifts(cam.law, cam_angle(cam, turn)), cam.beginning()
    motion = cam.motion
    if isinstance(motion, SlidingFollower):
        return {"travel": motion.travel + start + lift.lift, "slope": cam.sense * lift.slope, "second": lift.second}
    line = cam.axis - motion.centre
    line = line / abs(line) * (-1 if motion.back else 1)
    axis = line * turned(motion.side * (start + lift.lift))
    return {"cos": axis.real, "sin": axis.imag, "slope": motion.side * cam.sense * lift.slope,
            "second": motion.side * lift.second}


# the study of a cam: pressure angles, curvature and undercutting, rates


NODES = 97
SAME = 1e-9
REACHES = 1e-6
"""Of the base radius: so far a roller reaches over the profile beside it by rounding, or at its limit."""
CORNER = 1e-9
"""A jump of a derivative smaller than this, of the greatest, is none."""


@dataclass(frozen=True)
class AtDegree:
    """A value at an angle of the law (rad)."""

    value: float
    degree: float


@dataclass(frozen=True, eq=False, repr=False)
class CamStudy:
    """The study of a cam; rates are by the cam's angle (m or rad, per rad and rad2), angles in rad, lengths in m.

    rise, fall : the greatest pressure angle during rise and fall; None without a rise or fall
    velocity, acceleration : the greatest in size, with sign
    radius : the least radius of curvature of the convex profile; None if it is nowhere convex
    undercut : the stretches in which the profile cannot be cut: the roller is larger than the radius of the pitch
        curve, or the flat face does not touch the whole of it; without width where the velocity drops at once
    impacts, soft_impacts : the jumps of velocity and of acceleration at seams, by their size
    """

    cam: LawCam
    rise: AtDegree | None
    fall: AtDegree | None
    velocity: AtDegree
    acceleration: AtDegree
    radius: AtDegree | None
    undercut: tuple[tuple[float, float], ...]
    impacts: tuple[AtDegree, ...]
    soft_impacts: tuple[AtDegree, ...]

    @property
    def judged(self) -> tuple[bool | None, bool | None]:
        """Whether the pressure angles of rise and fall are within their limits; None without limits."""
        return _judged(self.cam, self.rise, self.fall)

    @property
    def ok(self) -> bool:
        """Whether the cam can be made as wished."""
        return False not in self.judged and not self.undercut


def study_cam(cam: LawCam) -> CamStudy:
    """Study a cam.  Raises Unsolvable where the follower does not reach the base circle."""
    most_rise, most_fall = _pressures(cam)
    round_ = [a for p in cam.law.parts for a in _extremes(cam, p, "radius", "radius_rate")]
    convex = [a for a in round_ if a.value + cam.roller > 0.0 or cam.flat]
    return CamStudy(
        cam, most_rise, most_fall, _greatest(cam.law, 1), _greatest(cam.law, 2),
        min(convex, key=attrgetter("value"), default=None), tuple(_undercut(cam)), *_impacts(cam.law),
    )


def _pressures(cam: LawCam) -> tuple[AtDegree | None, AtDegree | None]:
    """The greatest pressure angles of rise and fall."""

    def most(parts: Sequence[LiftPiece]) -> AtDegree | None:
        extremes = (a for p in parts for a in _extremes(cam, p, "pressure", "leaning_rate"))
        return max(extremes, key=attrgetter("value"), default=None)

    return most([p for p in cam.law.parts if p.high > p.low]), most([p for p in cam.law.parts if p.high < p.low])


def _judged(cam: LawCam, rise: AtDegree | None, fall: AtDegree | None) -> tuple[bool | None, bool | None]:
    rising, falling = (None if allowed is None or most is None else most.value <= allowed * (1 + SAME)
                       for most, allowed in zip((rise, fall), cam.allowed, strict=True))
    return rising, falling


NEAREST = 1e-7
"""How near, of the base radius, the nearest base circle is found."""
LARGEST = 50.0
"""So many base radii are looked at for one that will do."""


def least_base(cam: LawCam) -> float | None:
    """The nearest larger base radius of the profile (m) with which a cam keeps the allowed pressure angles and can be
    cut; None if there is none."""

    def good(radius: float) -> bool:
        larger = replace(cam, base=radius + cam.roller)
        try:
            rise, fall = _pressures(larger)
        except Unsolvable:
            return False
        return False not in _judged(larger, rise, fall) and not any(True for _ in _undercut(larger))

    low = high = cam.base_of_profile
    # on a line a larger circle is the better; about a pivot only some circles may do, none that the bar does not reach
    motion, step, most = cam.motion, 1.25, LARGEST * cam.base
    if isinstance(motion, SwingingFollower):
        step, most = 1.02, abs(cam.axis - motion.centre) + motion.arm
    while not good(high):
        low, high = high, step * high
        if high > most:
            return None
    return last_true(lambda radii: np.array([good(float(r)) for r in radii]), high, low, 2, NEAREST * cam.base)


def _greatest(law: FollowerLaw, order: int) -> AtDegree:
    """The first or second derivative of greatest size: the first place of several equal ones."""
    extremes = [AtDegree(*extreme) for part in law.parts for extreme in part.extremes(order)]
    most = max(abs(at.value) for at in extremes)
    return next(at for at in extremes if abs(at.value) >= most * (1 - SAME))


def _extremes(cam: LawCam, part: LiftPiece, of: str, rate: str) -> Iterator[AtDegree]:
    """A field of the cam at the ends of a part and at the zeros of its rate, another field."""
    def at(field: str, degree: Array) -> Array:
        values = getattr(cam_with(cam, degree, part.at(degree, np)), field)
        return np.broadcast_to(values, degree.shape)

    def changing(degree: Array) -> tuple[Array, Array]:
        return at(rate, degree)[:, None], np.zeros((len(degree), 1))

    spots = [part.start, part.end, *resolve(changing, part.start, part.end).zeros(0).tolist()]
    values = at(of, np.array(spots))
    yield from (AtDegree(float(v), d) for v, d in zip(values, spots, strict=True) if not math.isnan(v))


def _undercut(cam: LawCam) -> Iterator[tuple[float, float]]:
    """Stretches in which the profile is not round enough, joined across seams; without width at a corner that a roller
    or a face cannot make.  If there are none, those that the roller cuts away from other angles of the cam."""
    stretches: list[list[float]] = []
    corners = tuple(_sharp_corners(cam))
    for part in cam.law.parts:
        nodes = np.linspace(part.start, part.end, 4 * NODES)
        sharp = intervals(partial(_too_sharp, cam, part), nodes)
        for start, end in ((part.start,) * 2, *sharp) if part.start in corners else sharp:
            if stretches and abs(stretches[-1][1] - start) < SAME:
                stretches[-1][1] = end
            else:
                stretches.append([start, end])
    if cam.roller and not stretches:
        nodes = np.concatenate([np.linspace(part.start, part.end, NODES) for part in cam.law.parts])
        yield from intervals(partial(_cut_away, cam, cam_at(cam, nodes).pitch), nodes)
    yield from ((start, end) for start, end in stretches)


def _sharp_corners(cam: LawCam) -> Iterator[float]:
    """The seams (rad) at which the pitch curve of a roller, or the profile under a flat face, turns by a convex corner:
    the velocity drops."""
    for jump in _impacts(cam.law)[0] if cam.flat or cam.roller else ():
        (leaning,) = cam_at(cam, np.array([jump.degree])).leaning
        if jump.value * math.cos(leaning) < 0.0:
            yield jump.degree


def _cut_away(cam: LawCam, centres: Array, degree: Array) -> Array:
    """Whether the roller about any of these centres, in the cam's own axes, reaches over the point of contact."""
    gap = np.abs(cam_at(cam, degree).profile[:, None] - centres[None, :]).min(axis=1)
    return np.asarray(gap < cam.roller - REACHES * cam.base)


def _too_sharp(cam: LawCam, part: LiftPiece, degree: Array) -> Array:
    """Whether the profile turns back on itself: a flat face on a radius that is not positive, a roller larger than the
    radius of the convex pitch curve."""
    at = cam_with(cam, degree, part.at(degree, np))
    turning = at.radius < -SAME * cam.base  # at its limit a cam has an edge, but does not turn back
    return turning if cam.flat else turning & (at.radius + cam.roller > 0.0)


def _impacts(law: FollowerLaw) -> tuple[tuple[AtDegree, ...], tuple[AtDegree, ...]]:
    """The jumps of velocity and of acceleration of a law.  At a jump of velocity the acceleration is infinite, and its
    own jump is left out."""
    ends = [(part.at(part.start), part.at(part.end)) for part in law.parts]
    hard, soft = (
        [AtDegree(ends[k][0][order] - ends[k - 1][1][order], part.start) for k, part in enumerate(law.parts)]
        for order in (1, 2)
    )
    most = [abs(_greatest(law, order).value) for order in (1, 2)]
    impacts = tuple(jump for jump in hard if abs(jump.value) > CORNER * most[0])
    return impacts, tuple(jump for jump, harder in zip(soft, hard, strict=True)
                          if abs(jump.value) > CORNER * most[1] and harder not in impacts)
