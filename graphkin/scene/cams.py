"""Cams by the law of their follower, in SI units, and how they are read from a file.

A sliding follower's first point stands beyond the foot of the axis on its line by the root of base radius and offset
plus the lift (a flat face: by base radius plus lift); a swinging one's bar turns by the lift from where its roller's
centre lies on the base circle of the pitch curve.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import Values, cross, dot
from graphkin.scene.bodies import Reading
from graphkin.scene.laws import FollowerLaw, Lift, follower_law
from graphkin.scene.scene_tables import Cam
from graphkin.scene.tables import Units, in_si
from graphkin.words import Phrase

AGREES = 1e-6

# -- cams as they are --------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class SlidingFollower:
    """A follower on a guide of the frame: the ``pair``, the ``foot`` of the cam's axis on the line (m), the sense of
    the line, the travel at the foot (m), and the ``offset`` (m), positive where the axis lies to the left of the line.
    """

    pair: str
    foot: complex
    along: complex
    travel: float
    offset: float


@dataclass(frozen=True)
class SwingingFollower:
    """A follower that swings about ``pivot`` of the frame (at ``centre``, m): its roller's centre ``tip`` lies ``arm``
    m off, on the side of the line from pivot to cam axis on which angles grow (``side`` 1), or on the other (-1).

    ``back`` is true where the link's own axis points from tip to pivot."""

    pivot: str
    tip: str
    centre: complex
    arm: float
    side: int
    back: bool = False


class Course(NamedTuple):
    """The follower's point from the cam's axis (m), its first to third derivative by the cam's own angle, and the
    direction in which it moves, unit; complex, or arrays of complex numbers.  ``turning`` is how fast that turns."""

    point: Values
    first: Values
    second: Values
    third: Values
    way: Values
    turning: Values

    @property
    def tangent(self) -> Values:
        """Derivative of the pitch curve, as seen from the cam (in the axes of the frame)."""
        return self.first - 1j * self.point

    @property
    def bend(self) -> Values:
        """Its second derivative."""
        return self.second - 2j * self.first - self.point

    @property
    def jerk(self) -> Values:
        """Its third derivative."""
        return self.third - 3j * self.second - 3.0 * self.first + 1j * self.point


@dataclass(frozen=True)
class LawCam:
    """A cam that turns about ``point`` of the frame (at ``axis``, m), given by the law of its follower.

    The cam degree is ``sense`` times the link's own angle.  ``base`` is the radius of the base circle of the pitch
    curve (of the profile, where the face is flat), ``roller`` 0 of a knife edge or a flat face (m); ``allowed`` are the
    greatest pressure angles of rise and fall (rad), where they are given.
    """

    link: str
    follower: str
    point: str
    axis: complex
    law: FollowerLaw
    sense: int
    base: float
    roller: float
    flat: bool
    motion: SlidingFollower | SwingingFollower
    allowed: tuple[float | None, float | None] = (None, None)
    # asked of whatever moves a link: it neither rolls, nor does the scene give its value
    rolls: ClassVar[bool] = False
    given: ClassVar[bool] = False
    through: ClassVar[tuple[str, ...]] = ()

    @property
    def key(self) -> str:
        """What it is told from drivers by."""
        return f"cam {self.link}"

    @property
    def turns(self) -> bool:
        """Whether its follower swings, so that the lift is an angle."""
        return isinstance(self.motion, SwingingFollower)

    @property
    def links(self) -> tuple[str, ...]:
        """The links that give its follower's motion."""
        return (self.link,)

    @property
    def base_of_profile(self) -> float:
        """Radius of the base circle of the profile (m)."""
        return self.base - self.roller

    @property
    def name_of_point(self) -> str:
        """The point of the follower that the law moves: the roller's centre, the edge; "" where it has no name."""
        return self.motion.tip if isinstance(self.motion, SwingingFollower) else ""

    def degree(self, angle: float) -> float:
        """The angle of the law (rad) at an angle of the link's own axis."""
        return self.law.reduced(self.sense * angle)

    def leaves(self, lift: float, sense: int) -> float:
        """The angle of the link's own axis (rad, 0 to a turn) from which the follower leaves its least or greatest lift
        where the cam turns in a sense; the smallest of several."""
        grows = sense * self.sense > 0
        moving = [piece for piece in self.law.pieces if piece.low != piece.high]
        ends = [piece.start if grows else piece.end for piece in moving if lift == (piece.low if grows else piece.high)]
        return min(self.sense * end % math.tau for end in ends)

    def course(self, lift: Lift, exp: Callable[[Values], Values] = cmath.exp) -> Course:
        """The follower's point where it has some lift.  Raises Unsolvable as `beginning`.

        Parameters
        ----------
        lift : with its derivatives by the degree of the cam
        exp : the exponential function, of NumPy for arrays
        """
        motion, start = self.motion, self.beginning()
        s1, s2, s3 = self.sense * lift.slope, lift.bend, self.sense * lift.jerk
        if isinstance(motion, SlidingFollower):
            point = motion.foot - self.axis + motion.along * (start + lift.lift)
            e = motion.along
            return Course(point, e * s1, e * s2, e * s3, e + 0 * point, 0.0 * s1)
        line = self.axis - motion.centre
        bar = motion.arm * line / abs(line) * exp(1j * motion.side * (start + lift.lift))
        t1, t2, t3 = motion.side * s1, motion.side * s2, motion.side * s3
        third = (1j * t3 - 3.0 * t1 * t2 - 1j * t1 * t1 * t1) * bar
        return Course(motion.centre - self.axis + bar, 1j * t1 * bar, (1j * t2 - t1 * t1) * bar, third,
                      1j * motion.side * bar / motion.arm, t1)  # fmt: skip

    def beginning(self, units: Units | None = None) -> float:
        """Lift 0: of a sliding follower the distance beyond the foot (m), of a swinging one the angle of its bar from
        the line to the cam's axis (rad).

        Parameters
        ----------
        units : in which the message tells lengths

        Raises
        ------
        Unsolvable : "not assembled": the follower does not come to the base circle
        """
        motion, length = self.motion, (units or Units()).of("length")
        if isinstance(motion, SlidingFollower):
            square = (self.base - motion.offset) * (self.base + motion.offset)
            if self.flat or square >= 0.0:
                return self.base if self.flat else math.sqrt(square)
            said = Phrase("the line of follower passes outside the base", follower=self.follower)
            wanted = Phrase("its radius is at least the offset", length=length.said(abs(motion.offset)))
        else:
            # half the angle at the pivot of a triangle with these three sides
            a, b, c = abs(self.axis - motion.centre), motion.arm, self.base
            half = (a + b + c) / 2
            under, over = (half - a) * (half - b), half * (half - c)
            if under >= 0.0 < over:
                return 2.0 * math.atan2(math.sqrt(under), math.sqrt(over))
            said = Phrase("follower does not reach the base circle of", follower=self.follower)
            wanted = Phrase("its radius lies between and", length=length.said(abs(a - b)), other=length.said(a + b))
        raise Unsolvable("not assembled", Problem(f"cams.{self.link}", said, wanted))

    def follower_at(self, angle: float) -> float:
        """Where the follower stands at an angle of the cam's own axis (rad): the travel of its sliding pair (m), or the
        angle of its own axis (rad).  Raises Unsolvable as `beginning`."""
        motion, moved = self.motion, self.beginning() + float(self.law.at(self.sense * angle).lift)
        if isinstance(motion, SlidingFollower):
            return motion.travel + moved
        line = self.axis - motion.centre
        return cmath.phase(-line if motion.back else line) + motion.side * moved


# -- reading -----------------------------------------------------------------------------------------------------------

Line = tuple[str, complex, complex]
"""A guide of the frame on which a link slides: the key of the pair, a point of it (m), its sense."""


def cams_of(reading: Reading, lines: Mapping[str, Line], drawn: Mapping[str, complex]) -> tuple[LawCam, ...]:
    """The cams of a file; what is wrong with them is noted.

    Parameters
    ----------
    lines : of each link that slides on the frame
    drawn : roughly where points of moving links lie (m)
    """
    moved: dict[str, str] = {}
    found = []
    for name, cam in reading.file.cams.items():
        other = moved.setdefault(cam.follower, name)
        if other != name:
            reading.say(f"cams.{name}.follower", "link is moved by cam already", "a follower has one cam",
                        follower=cam.follower, other=other)
        placed = _cam(name, cam, reading, lines, drawn)
        if placed is not None:
            found.append(placed)
    return tuple(found)


def _cam(
    name: str, cam: Cam, reading: Reading, lines: Mapping[str, Line], drawn: Mapping[str, complex]
) -> LawCam | None:
    where, before, si = f"cams.{name}", len(reading.problems), in_si(cam, reading.units)
    point = _axis(where, name, reading)
    swings = _swings(where, name, cam, reading, lines)
    law = follower_law(f"{where}.law", cam.law, math.pi / 180 if swings else reading.metres, reading)
    roller = si.roller or 0.0
    base = si.base.r + (roller if cam.base.of == "profile" else 0.0)
    if cam.flat and cam.roller is not None:
        reading.say(f"{where}.flat", "stands beside roller", "the face is flat or it has a")
    if not cam.flat and base <= roller:
        reading.say(f"{where}.base.r", "found with a roller of", "the base circle of the pitch curve is",
                    r=f"{cam.base.r:g}", roller=f"{cam.roller:g}")
    for side in ("rise", "fall"):
        angle = getattr(cam.allow, side, None)
        if angle is not None and not 0.0 < angle < 90.0:
            reading.say(f"{where}.allow.{side}", "found value", "a pressure angle lies between 0 and 90",
                        value=f"{angle:g}")
    if not point or swings is None or len(reading.problems) > before:
        return None
    axis = _fixed(reading)[point]
    motion: SlidingFollower | SwingingFollower | None
    if swings:
        motion = _swinging(where, cam, reading, axis, drawn)
    else:
        motion = _sliding(where, si, reading, axis, lines[cam.follower])
    if motion is None or law is None or len(reading.problems) > before:
        return None
    allowed = (si.allow.rise, si.allow.fall) if si.allow else (None, None)
    return LawCam(name, cam.follower, point, axis, law, cam.sense, base, roller, cam.flat, motion, allowed)


def _fixed(reading: Reading) -> Mapping[str, complex]:
    """The points of the frame (m)."""
    return reading.places[reading.frame.name]


def _axis(where: str, name: str, reading: Reading) -> str:
    """The point of the frame about which a cam turns; "" where there is none."""
    if reading.wrong(reading.no_link(where, name, moving=True)):
        return ""
    if name == reading.frame.name:
        reading.say(where, "link is the frame", "a cam turns", name=name)
        return ""
    link = reading.links.get(name)
    if link is None or reading.lost_under("links", name):
        return ""
    if link.points and link.points[0] in _fixed(reading):
        return link.points[0]
    if not reading.lost_under("frame"):
        no_point = Phrase("link has no point", name=name)
        said = Phrase("is no point of the frame", points=link.points[0]) if link.points else no_point
        reading.say(where, said, "a cam turns about its first point which")
    return ""


def _swings(here: str, name: str, cam: Cam, reading: Reading, lines: Mapping[str, Line]) -> bool | None:
    """Whether the follower swings; None where it neither swings nor slides on the frame."""
    where, follower, frame = f"{here}.follower", cam.follower, reading.frame.name
    if reading.wrong(reading.no_link(where, follower, moving=True)):
        return None
    if follower in (name, frame):
        said = Phrase("the cam itself") if follower == name else Phrase("link is the frame", name=follower)
        reading.say(where, said, "name the link that the cam moves")
        return None
    if follower in lines:
        return False
    link = reading.links.get(follower)
    if link is None or reading.lost_under("links", follower) or reading.lost_under("frame"):
        return None
    pivots = [p for p in link.points if p in _fixed(reading)]
    if len(pivots) != 1 or link.on is not None:
        reading.say(where, "link neither slides on a guide of the", "write on guide or points with a pivot",
                    follower=follower, frame=frame)
        return None
    if len(link.points) != 2:
        reading.say(where, "link has no point but its pivot", "it is a bar from its pivot to", follower=follower)
        return None
    sliding = {"offset": (cam.offset is not None, Phrase("an offset")), "flat": (cam.flat, Phrase("a flat face"))}
    for beside, (there, kind) in sliding.items():
        if there:
            reading.say(f"{here}.{beside}", "link swings", "is for a sliding follower", name=follower, kind=kind)
    return True


def _sliding(where: str, si: Cam, reading: Reading, axis: complex, line: Line) -> SlidingFollower | None:
    """A follower on a line; of the cam in SI."""
    pair, through, along = line
    offset, metres = cross(along, axis - through), reading.metres
    if si.offset is not None and abs(si.offset - offset) > AGREES * max(abs(axis - through), si.base.r):
        reading.say(f"{where}.offset", "found but the guide makes it", "one is wrong positive where the axis is",
                    offset=f"{si.offset / metres:g}", other=f"{offset / metres:.9g}")
        return None
    travel = dot(along, axis - through)
    return SlidingFollower(pair, through + along * travel, along, travel, offset)


def _swinging(
    where: str, cam: Cam, reading: Reading, axis: complex, drawn: Mapping[str, complex]
) -> SwingingFollower | None:
    """A follower that swings about a point of the frame."""
    link = reading.links[cam.follower]
    (first, second), places = link.points, _fixed(reading)
    pivot, tip = (first, second) if first in places else (second, first)
    centre = places[pivot]
    if centre == axis:
        reading.say(f"{where}.follower", "swings about the cam's own axis", "its pivot lies elsewhere", pivot=pivot)
        return None
    if link.length is None:
        reading.say(f"links.{cam.follower}.length", "is missing", "the length of a swinging follower is written")
        return None
    left = tip not in drawn or cross(axis - centre, drawn[tip] - centre) >= 0.0
    return SwingingFollower(pivot, tip, centre, link.length * reading.metres, 1 if left else -1, pivot == second)
