"""A cam drawn on the board by inversion: the displacement diagram divided into parts, the follower's line turned back
by each, the lifts carried on to it, the profile, the normals and the pressure angles measured; and one division as
hands draw it, each line laid off, each point pricked, what they do wrong carried on.

After Sun Huan, Mechanical Principles, ch. 9; Norton, Design of Machinery, ch. 8.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass

from graphkin.construction.instruments import Instrument
from graphkin.construction.touching import CamStation, outline, station
from graphkin.plane import cross_arcs, cross_line_arc, unit
from graphkin.scene.cams import LawCam, SlidingFollower, SwingingFollower
from graphkin.scene.laws import TURN
from graphkin.words import Phrase
from graphkin.words.written import amount

STEP = math.radians(15.0)
FEWEST, MOST = 4, 12


@dataclass(frozen=True)
class CamSheet:
    """A cam on paper, at cam degree 0, about its axis, y up.

    scale : m for one mm of paper
    divisions : of the displacement diagram, the follower turned back about the cam at each (mm)
    profile, pitch : closed curves (mm); the pitch curve is empty of a flat face
    base, offset, roller : radii of circles on paper (mm); offset 0 where there is none, or the follower swings
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
        """What is done, one after the other."""
        cam, motion = self.cam, self.cam.motion
        radius, shifted = amount(self.base, 4), self.offset > 1e-9
        steps = [Phrase("cam step diagram", (str(len(self.divisions)),)), Phrase("cam step base", (cam.point, radius))]
        if isinstance(motion, SwingingFollower):
            distance = amount(abs(self.divisions[0].line), 4)
            steps.append(Phrase("cam step pivots", (cam.point, motion.pivot, distance)))
            steps.append(Phrase("cam step swings", (motion.pivot, motion.tip)))
        else:
            if shifted:
                steps[-1] = Phrase("cam step circles", (cam.point, radius, amount(self.offset, 4)))
            steps.append(Phrase("cam step tangents" if shifted else "cam step rays", (cam.point,)))
            steps.append(Phrase("cam step lifts"))
        if cam.flat:
            return (*steps, Phrase("cam step faces"))
        edge = Phrase("cam step rollers", (amount(self.roller, 4),)) if cam.roller else Phrase("cam step edge")
        return (*steps, edge, Phrase("cam step normals", (cam.point,)))


def cam_sheet(cam: LawCam, scale: float) -> CamSheet:
    """Draw a cam at a scale (m for one mm of paper)."""
    mm = 1.0 / scale
    divided = tuple(station(cam, degree).scaled(mm) for degree in _degrees(cam))
    pitch = () if cam.flat else tuple(_pitch(cam, mm))
    offset = abs(cam.motion.offset) * mm if isinstance(cam.motion, SlidingFollower) else 0.0
    profile = tuple(z * mm for z in outline(cam))
    return CamSheet(cam, scale, divided, profile, pitch, cam.base * mm, offset, cam.roller * mm)


def _degrees(cam: LawCam) -> Iterator[float]:
    """Angles of the divisions (rad): equal parts of each rise and fall, the ends of each dwell."""
    for piece in cam.law.pieces:
        width = piece.end - piece.start
        count = min(MOST, max(FEWEST, 2 * round(width / STEP / 2))) if piece.by else 1
        yield from (piece.start + width * k / count for k in range(count))


def _pitch(cam: LawCam, mm: float) -> Iterator[complex]:
    for part in cam.law.parts:
        count = max(2, math.ceil(180 * (part.end - part.start) / TURN))
        for k in range(count + 1):
            degree = part.start + (part.end - part.start) * k / count
            yield station(cam, degree, part.at(degree)).point * mm


TINY = 1e-9  # of the base radius: a line nearer to the axis passes it


def division_by_hand(cam: LawCam, degree: float, mm: float, hand: Instrument) -> tuple[float, float] | None:
    """Draw a division at a cam degree (rad), ``mm`` of paper for one m.

    Returns
    -------
    the lift read off (m, rad), and the pressure angle read off (rad, with its sense; 0 of a flat face); None where the
    hands err so far that the follower's line misses the base circle
    """
    base = hand.compass(cam.base * mm)
    if isinstance(cam.motion, SlidingFollower):
        return _sliding(cam, cam.motion, degree, mm, base, hand)
    return _swinging(cam, cam.motion, degree, mm, base, hand)


def _sliding(
    cam: LawCam, motion: SlidingFollower, degree: float, mm: float, base: float, hand: Instrument
) -> tuple[float, float] | None:
    laid = hand.length(cam.law.at(degree).lift * mm)
    exact = station(cam, degree)
    way = hand.angle(exact.way)
    away = exact.line - exact.way * (exact.line * exact.way.conjugate()).real  # square to the line, to its foot
    side = 1j if (away / (1j * exact.way)).real >= 0 else -1j
    foot = side * way * hand.compass(abs(away) * mm) if abs(away) > TINY * cam.base else 0j
    met = cross_line_arc(foot, way, 0j, base)
    if met is None:
        return None
    start = max(met, key=lambda z: (z * way.conjugate()).real)
    point = hand.point(start + way * laid)
    lift = hand.read(abs(point - start)) / mm * (1 if laid >= 0 else -1)
    if cam.flat:
        return lift, 0.0
    return lift, _pressure_by_hand(exact.centre, exact.way, exact.normal, point, way, mm, hand)


def _swinging(
    cam: LawCam, motion: SwingingFollower, degree: float, mm: float, base: float, hand: Instrument
) -> tuple[float, float] | None:
    exact = station(cam, degree)
    pivot = hand.point(hand.angle(unit(exact.line)) * hand.length(abs(exact.line) * mm))
    arm = hand.compass(motion.arm * mm)
    met = cross_arcs(0j, base, pivot, arm)
    if met is None:
        return None
    start = hand.point(min(met, key=lambda z: abs(z - exact.base * mm)))
    turned = unit((exact.point - exact.line) / (exact.base - exact.line))
    bar = hand.angle(unit(start - pivot) * turned)
    point = hand.point(pivot + arm * bar)
    swing = cmath.phase(hand.read_direction(bar) / unit(start - pivot))
    lift = swing * (1 if cmath.phase(turned) * cam.law.at(degree).lift >= 0 else -1)
    way = hand.direction(bar * (exact.way / unit(exact.point - exact.line)))
    return lift, _pressure_by_hand(exact.centre, exact.way, exact.normal, point, way, mm, hand)


def _pressure_by_hand(
    centre: complex | None, way: complex, normal: complex, point: complex, drawn: complex, mm: float, hand: Instrument
) -> float:
    """The angle from the path to the normal, which is drawn through the instant centre."""
    turned = unit(drawn / way)
    if centre is None:
        line = hand.direction(normal * turned)
    else:
        far = abs(centre) * mm
        spot = hand.point(hand.direction(unit(centre) * turned) * hand.length(far)) if far else 0j
        line = unit(point - spot)
    angle = cmath.phase(hand.read_direction(line) / drawn)
    return cmath.phase(cmath.exp(2j * angle)) / 2  # between two lines
