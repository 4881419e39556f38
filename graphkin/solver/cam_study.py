"""What is to be said of a cam: pressure angles and their extremes, curvature and undercutting, rates, jumps.

Extremes are found where a derivative in closed form goes through zero, and at both sides of every seam.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from graphkin.errors import Unsolvable
from graphkin.scene.cams import FollowerLaw, LawCam, Lift, SmoothPart
from graphkin.search import intervals, last_true
from graphkin.solver.cams import CamAt, cam_with
from graphkin.solver.pose import Array

__all__ = ["AtDegree", "CamStudy", "Jump", "least_base", "study_cam"]

NODES = 97
SAME = 1e-9
CORNER = 1e-9
"""A jump of a derivative smaller than this, of the greatest, is none."""


@dataclass(frozen=True)
class AtDegree:
    """A value at an angle of the law (rad)."""

    value: float
    degree: float


@dataclass(frozen=True)
class Jump:
    """A jump of the follower's velocity (``order`` 1: an impact) or acceleration (2: a soft one) at a seam (rad), by
    that much (m or rad, per rad or rad2)."""

    order: int
    degree: float
    by: float


@dataclass(frozen=True)
class CamStudy:
    """A cam looked over; rates are by the cam's angle (m or rad, per rad and rad2), angles in rad, lengths in m.

    rise, fall : the greatest pressure angle while the follower rises and while it falls; None where it never does
    velocity, acceleration : the greatest in size, with sign
    radius : the least radius of curvature of the profile where it is convex; None where it nowhere is
    undercut : from where to where the profile cannot be cut: the roller is larger than the pitch curve is round there,
        or the flat face does not touch the whole of it
    jumps : where velocity or acceleration jump
    """

    cam: LawCam
    rise: AtDegree | None
    fall: AtDegree | None
    velocity: AtDegree
    acceleration: AtDegree
    radius: AtDegree | None
    undercut: tuple[tuple[float, float], ...]
    jumps: tuple[Jump, ...]

    @property
    def judged(self) -> tuple[bool | None, bool | None]:
        """Whether the pressure angles of rise and fall are within what is allowed; None where nothing is said."""
        return _judged(self.cam, self.rise, self.fall)

    @property
    def ok(self) -> bool:
        """Whether the cam can be made as wished."""
        return False not in self.judged and not self.undercut


def study_cam(cam: LawCam) -> CamStudy:
    """Look a cam over.  Raises Unsolvable where the follower does not come to the base circle."""
    most_rise, most_fall = _pressures(cam)
    round_ = [a for p in cam.law.parts for a in _extremes(cam, p, _radius, _radius_rate)]
    convex = [a for a in round_ if a.value + cam.roller > 0.0 or cam.flat]
    return CamStudy(
        cam, most_rise, most_fall, _greatest(cam.law, 1), _greatest(cam.law, 2),
        min(convex, key=_value, default=None), tuple(_undercut(cam)), tuple(_jumps(cam)),
    )  # fmt: skip


def _pressures(cam: LawCam) -> tuple[AtDegree | None, AtDegree | None]:
    """The greatest pressure angles of rise and fall."""

    def most(parts: Sequence[SmoothPart]) -> AtDegree | None:
        found = (a for p in parts for a in _extremes(cam, p, lambda at, lift: at.pressure, _leaning_rate))
        return max(found, key=_value, default=None)

    return most([p for p in cam.law.parts if p.high > p.low]), most([p for p in cam.law.parts if p.high < p.low])


def _judged(cam: LawCam, rise: AtDegree | None, fall: AtDegree | None) -> tuple[bool | None, bool | None]:
    found: list[bool | None] = []
    for most, allowed in zip((rise, fall), cam.allowed, strict=True):
        found.append(None if allowed is None or most is None else most.value <= allowed * (1 + SAME))
    return found[0], found[1]


NEAREST = 1e-7
"""How near, of the base radius, the nearest base circle is found."""
LARGEST = 50.0
"""So many base radii are looked at for one that will do."""


def least_base(cam: LawCam) -> float | None:
    """The nearest larger base radius of the profile (m) with which a cam keeps the allowed pressure angles and can be
    cut; None where none does."""

    def good(radius: float) -> bool:
        larger = replace(cam, base=radius + cam.roller)
        try:
            rise, fall = _pressures(larger)
        except Unsolvable:
            return False
        return False not in _judged(larger, rise, fall) and not any(True for _ in _undercut(larger))

    low = high = cam.base_of_profile
    while not good(high):
        low, high = high, 1.25 * high
        if high > LARGEST * cam.base:
            return None
    if low == high:
        return high
    return last_true(lambda radii: np.array([good(float(r)) for r in radii]), high, low, 2, NEAREST * cam.base)


def _value(at: AtDegree) -> float:
    return at.value


def _greatest(law: FollowerLaw, order: int) -> AtDegree:
    """The first or second derivative where it is greatest in size: the first place of several as great."""
    found = [AtDegree(*extreme) for part in law.parts for extreme in part.extremes(order)]
    most = max(abs(at.value) for at in found)
    return next(at for at in found if abs(at.value) >= most * (1 - SAME))


Of = Callable[[CamAt, Lift], Array]


def _radius(at: CamAt, lift: Lift) -> Array:
    """Radius of curvature of the profile; infinite where it is straight."""
    return np.asarray(at.radius)


def _leaning_rate(at: CamAt, lift: Lift) -> Array:
    """How the angle between normal and the follower's way changes: both turn."""
    return np.asarray(at.leaning_rate)


def _radius_rate(at: CamAt, lift: Lift) -> Array:
    return np.asarray(at.radius_rate)


def _at(cam: LawCam, part: SmoothPart, degree: Array) -> tuple[CamAt, Lift]:
    lift = part.at(degree, np)
    return cam_with(cam, degree, lift), lift


def _extremes(cam: LawCam, part: SmoothPart, of: Of, rate: Of) -> Iterator[AtDegree]:
    """A quantity at the ends of a part and where its rate goes through zero."""
    def rate_at(degree: Array) -> Array:
        return np.asarray(np.nan_to_num(np.broadcast_to(rate(*_at(cam, part, degree)), degree.shape)))

    def same_sign(rising: bool, degree: Array) -> Array:
        return np.asarray(rate_at(degree) > 0.0 if rising else rate_at(degree) < 0.0)

    nodes = np.linspace(part.start, part.end, NODES)
    rates = rate_at(nodes)
    spots = [part.start, part.end]
    for k in np.flatnonzero(rates[:-1] * rates[1:] < 0.0):
        rising = bool(rates[k] > 0.0)
        spots.append(last_true(partial(same_sign, rising), float(nodes[k]), float(nodes[k + 1])))
    spots += nodes[rates == 0.0].tolist()
    values = np.broadcast_to(of(*_at(cam, part, np.array(spots))), (len(spots),))
    yield from (AtDegree(float(v), d) for v, d in zip(values, spots, strict=True) if not math.isnan(v))


def _undercut(cam: LawCam) -> Iterator[tuple[float, float]]:
    """Stretches in which the profile is not round enough, joined across seams."""
    stretches: list[list[float]] = []
    for part in cam.law.parts:
        nodes = np.linspace(part.start, part.end, 4 * NODES)
        for start, end in intervals(partial(_too_sharp, cam, part), nodes):
            if stretches and abs(stretches[-1][1] - start) < SAME:
                stretches[-1][1] = end
            else:
                stretches.append([start, end])
    yield from ((start, end) for start, end in stretches if end > start)


def _too_sharp(cam: LawCam, part: SmoothPart, degree: Array) -> Array:
    """Where the profile turns back on itself: a flat face on a radius that is not positive, a roller larger than the
    convex pitch curve is round."""
    at, _ = _at(cam, part, degree)
    if cam.flat:
        return np.asarray(at.radius < 0.0)
    return np.asarray((at.radius < 0.0) & (at.radius + cam.roller > 0.0))


def _jumps(cam: LawCam) -> Iterator[Jump]:
    """Where a velocity jumps the acceleration is infinite, and its own jump is not told."""
    law, hard = cam.law, set[int]()
    ends = [(part.at(part.start), part.at(part.end)) for part in law.parts]
    for order in (1, 2):
        most = abs(_greatest(law, order).value)
        for k, part in enumerate(law.parts):
            by = ends[k][0][order] - ends[k - 1][1][order]
            if abs(by) > CORNER * most and k not in hard:
                hard.add(k)
                yield Jump(order, part.start, by)
