"""The outlines of cams on paper, found point by point: the follower's line turned back, the normal through the instant
centre, the roller's radius laid off along it."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

from graphkin.construction.links_on_paper import Pose
from graphkin.plane import dot, unit
from graphkin.scene.cams import TURN, LawCam, Lift, SlidingFollower
from graphkin.scene.model import Mechanism

__all__ = ["CamStation", "outline", "outlines_on_paper", "station"]

POINTS = 180
"""Points of an outline, those at the seams beside them."""


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
