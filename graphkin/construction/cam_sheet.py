"""A cam drawn on the board by inversion: the displacement diagram divided into parts, the follower's line turned back
by each, the lifts carried on to it, the profile, the normals and the pressure angles measured.  Every division is drawn
by hands: each line laid off, each point pricked, with their errors carried on.

After Sun Huan, Mechanical Principles, ch. 9; Norton, Design of Machinery, ch. 8.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass

from graphkin.construction.board.instruments import EXACT, Instrument
from graphkin.construction.touching import CamStation, station, stations
from graphkin.plane import cross_arcs, cross_line_arc, dot, unit
from graphkin.scene.pairs import LawCam, SlidingFollower, SwingingFollower
from graphkin.words import Phrase
from graphkin.words.written import amount

STEP = math.radians(15.0)
FEWEST, MOST = 4, 12


@dataclass(frozen=True)
class CamSheet:
    """A cam on paper, at cam degree 0, about its axis, y up.

    Parameters
    ----------
    scale : m for one mm of paper
    divisions : of the displacement diagram, the follower turned back about the cam at each (mm)
    profile, pitch : closed curves (mm); the pitch curve is empty for a flat face
    base, offset, roller : radii of circles on paper (mm); offset 0 without one, or if the follower swings
    """

    cam: LawCam
    scale: float
    divisions: tuple[CamStation, ...]
    profile: tuple[complex, ...]
    pitch: tuple[complex, ...]
    base: float
    offset: float
    roller: float

    @property
    def steps(self) -> tuple[Phrase, ...]:
        """The steps in order."""
        cam, motion = self.cam, self.cam.motion
        radius, shifted = amount(self.base, 4), self.offset > 1e-9
        steps = [Phrase("cam step diagram", divisions=str(len(self.divisions)))]
        steps.append(Phrase("cam step base", centre=cam.point, radius=radius))
        normals = Phrase("cam step normals", centre=cam.point)
        if isinstance(motion, SwingingFollower):
            distance = amount(abs(self.divisions[0].line), 4)
            steps.append(Phrase("cam step pivots", centre=cam.point, pivot=motion.pivot, distance=distance))
            steps.append(Phrase("cam step swings", pivot=motion.pivot, tip=motion.tip))
            normals = Phrase("cam step normals swinging", centre=cam.point, pivot=motion.pivot)
        else:
            if shifted:
                steps[-1] = Phrase("cam step circles", centre=cam.point, radius=radius, offset=amount(self.offset, 4))
            steps.append(Phrase("cam step tangents") if shifted else Phrase("cam step rays", centre=cam.point))
            steps.append(Phrase("cam step lifts"))
        if cam.flat:
            return (*steps, Phrase("cam step faces"))
        edge = Phrase("cam step rollers", radius=amount(self.roller, 4)) if cam.roller else Phrase("cam step edge")
        return (*steps, edge, normals)


def cam_sheet(cam: LawCam, scale: float) -> CamSheet:
    """Draw a cam.

    Parameters
    ----------
    scale : m for one mm of paper
    """
    mm = 1.0 / scale
    # where arcs only touch, rounding may part them
    divided = tuple(division(cam, degree, mm) or station(cam, degree).scaled(mm) for degree in _degrees(cam))
    pitch = () if cam.flat else tuple(here.point * mm for here in stations(cam))
    offset = abs(cam.motion.offset) * mm if isinstance(cam.motion, SlidingFollower) else 0.0
    profile = tuple(here.contact * mm for here in stations(cam))
    return CamSheet(cam, scale, divided, profile, pitch, cam.base * mm, offset, cam.roller * mm)


def _degrees(cam: LawCam) -> Iterator[float]:
    """Angles of the divisions (rad): equal parts of each rise and fall, the ends of each dwell."""
    for piece in cam.law.pieces:
        width = piece.end - piece.start
        count = min(MOST, max(FEWEST, 2 * round(width / STEP / 2))) if piece.by else 1
        yield from (piece.start + width * k / count for k in range(count))


TINY = 1e-9  # of the base radius: a line nearer to the axis passes it
TOUCHES, ONE = 1e-14, 1e-7
"""Of the base radius: a line so near to the base circle touches it, and crossings so near to each other are one."""

ROUNDING = 1e-15  # rad: an angle that is less is none


def division(cam: LawCam, degree: float, mm: float, hand: Instrument = EXACT) -> CamStation | None:
    """Draw a division.

    Parameters
    ----------
    degree : of the cam (rad)
    mm : mm of paper for one m

    Returns
    -------
    the follower on paper (mm), with its lift as read (m, rad) and its normal as read by the protractor; None where the
    hands' errors let its line miss the base circle
    """
    given, base = station(cam, degree).scaled(mm), hand.compass(cam.base * mm)
    drawn = (_on_line if isinstance(cam.motion, SlidingFollower) else _on_arc)(cam, given, mm, base, hand)
    if drawn is None:
        return None
    turned = unit(drawn.way / given.way)
    centre = None if given.centre is None else given.centre * turned
    if cam.flat:  # it touches where the perpendicular from the instant centre meets the face
        assert centre is not None
        return drawn._replace(centre=centre, normal=drawn.way, contact=centre + drawn.way * dot(drawn.way, drawn.point))
    if centre is None:
        normal = hand.direction(given.normal * turned)
    else:
        spot = hand.point(hand.direction(unit(centre)) * hand.length(abs(centre))) if centre else 0j
        normal = unit(drawn.point - spot) if drawn.point != spot else drawn.way
    normal = hand.read_direction(normal)
    if dot(normal, given.normal * turned) < 0.0:  # the line has no sense, the normal leads out of the cam
        normal = -normal
    contact = drawn.point - cam.roller * mm * normal
    return drawn._replace(centre=centre, normal=normal, contact=contact)


def _on_line(cam: LawCam, given: CamStation, mm: float, base: float, hand: Instrument) -> CamStation | None:
    """The line of a sliding follower turned back, and its point on it; the normal is still to be drawn."""
    laid = hand.length(given.lift * mm)
    way = hand.angle(given.way)
    away = given.line - given.way * dot(given.way, given.line)  # square to the line, to its foot
    side = 1j if dot(away, 1j * given.way) >= 0 else -1j
    foot = side * way * hand.compass(abs(away)) if abs(away) > TINY * cam.base * mm else 0j
    if cam.flat:  # the face touches the base circle, wherever its line runs
        start = foot + base * way
    elif abs(abs(foot) - base) <= TOUCHES * base:
        start = foot
    else:
        crossed = cross_line_arc(foot, way, 0j, base)
        if crossed is None:
            return None
        start = crossed[0]
    point = hand.point(start + way * laid)
    lift = hand.read(abs(point - start)) / mm * (1 if laid >= 0 else -1)
    return given._replace(lift=lift, line=foot, base=start, point=point, way=way)


def _on_arc(cam: LawCam, given: CamStation, mm: float, base: float, hand: Instrument) -> CamStation | None:
    """The pivot of a swinging follower turned back, and the end of its bar; the normal is still to be drawn."""
    pivot = hand.point(hand.angle(unit(given.line)) * hand.length(abs(given.line)))
    arm = hand.compass(abs(given.point - given.line))
    crossed = cross_arcs(0j, base, pivot, arm)
    if crossed is None:
        return None
    start = min(crossed, key=lambda z: abs(z - given.base))
    start = hand.point((crossed[0] + crossed[1]) / 2 if abs(crossed[1] - crossed[0]) <= ONE * base else start)
    turned = unit((given.point - given.line) / (given.base - given.line))
    bar = hand.angle(unit(start - pivot) * turned)
    point = hand.point(pivot + arm * bar)
    swing = cmath.phase(hand.read_direction(bar) / unit(start - pivot))
    lift = swing * (1 if cmath.phase(turned) * given.lift >= 0 else -1) if abs(swing) > ROUNDING else 0.0
    way = hand.direction(bar * (given.way / unit(given.point - given.line)))
    return given._replace(lift=lift, line=pivot, base=start, point=point, way=way)
