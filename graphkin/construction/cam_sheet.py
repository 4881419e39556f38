"""A cam drawn on the board by inversion: the displacement diagram divided into parts, the follower's line turned back
by each, the lifts carried on to it, the profile, the normals and the pressure angles measured.  Every division is drawn
by hands: each line laid off, each point pricked, with their errors carried on.

After Sun Huan, Mechanical Principles, ch. 9; Norton, Design of Machinery, ch. 8.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

from graphkin.construction.board.instruments import EXACT, Instrument
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import NO_POINT, Bar, CompassArc, Curve, Mark, Ray
from graphkin.construction.tasks import TaskBoard, TaskStep
from graphkin.construction.touching import CamStation, station, stations
from graphkin.plane import cross_arcs, cross_line_arc, dot, unit
from graphkin.scene.pairs import LawCam, SlidingFollower, SwingingFollower, beyond_rounding

STEP = math.radians(15.0)
FEWEST, MOST = 4, 12
SHIFTED = 1e-9  # mm: a follower's line that passes nearer to the axis has no offset


def cam_sheet(cam: LawCam, scale: float) -> Sheet:
    """Draw a cam at cam degree 0, about its axis.

    Parameters
    ----------
    scale : m for one mm of paper
    """
    mm, board, motion = 1.0 / scale, TaskBoard(EXACT, scale=scale), cam.motion
    # where arcs only touch, rounding may part them
    divided = tuple(division(cam, degree, mm) or station(cam, degree).scaled(mm) for degree in _degrees(cam))
    pivots = (motion.pivot, motion.tip) if isinstance(motion, SwingingFollower) else ()
    around, step = stations(cam), partial(board.step, points=(cam.point, *pivots))
    step("divide", "cam step diagram", divisions=divided)
    offset = abs(motion.offset) * mm if isinstance(motion, SlidingFollower) else 0.0
    shifted = offset > SHIFTED
    radii = (cam.base * mm, offset) if shifted else (cam.base * mm,)
    circles = (*radii, (cam.base - cam.roller) * mm) if cam.roller else radii
    step("line", "cam step circles" if shifted else "cam step base",
         *(CompassArc(0j, radius, complex(radius), whole=True) for radius in circles), radii=radii)
    if pivots:
        step("mark", "cam step pivots", *(Mark(NO_POINT, d.line) for d in divided), radii=(abs(divided[0].line),))
        step("cross", "cam step swings", *(CompassArc(d.line, abs(d.point - d.line), d.point) for d in divided))
    else:
        lines = (Ray(d.line, d.way, None) for d in divided)
        step("line", "cam step tangents" if shifted else "cam step rays", *lines)
        step("lay off", "cam step lifts")
    profile = Curve(tuple(here.contact * mm for here in around))
    if cam.flat:
        step("line", "cam step faces", *(Bar(d.point, d.contact) for d in divided), profile)
        return board.sheet
    if cam.roller:
        pitch, roller = Curve(tuple(here.point * mm for here in around)), cam.roller * mm
        rollers = (CompassArc(d.point, roller, d.contact, whole=True) for d in divided)
        step("line", "cam step rollers", *rollers, pitch, profile, radii=(roller,))
    else:
        step("line", "cam step edge", profile)
    normals = (Ray(d.contact, d.normal, d.point) for d in divided)
    step("line", "cam step normals swinging" if cam.turns else "cam step normals", *normals)
    return board.sheet


def divisions(sheet: Sheet) -> tuple[CamStation, ...]:
    """The follower turned back about the cam at each division of its diagram (mm)."""
    return next(step.divisions for step in sheet.steps if isinstance(step, TaskStep))


def _degrees(cam: LawCam) -> Iterator[float]:
    """Angles of the divisions (rad): equal parts of each rise and fall, the ends of each dwell."""
    for piece in cam.law.pieces:
        width = piece.end - piece.start
        count = min(MOST, max(FEWEST, 2 * round(width / STEP / 2))) if piece.by else 1
        yield from (piece.start + width * k / count for k in range(count))


TINY = 1e-9  # of the base radius: a line nearer to the axis passes it
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
        return replace(drawn, centre=centre, normal=drawn.way, contact=centre + drawn.way * dot(drawn.way, drawn.point))
    if centre is None:
        normal = hand.direction(given.normal * turned)
    else:
        spot = hand.point(hand.direction(unit(centre)) * hand.length(abs(centre))) if centre else 0j
        normal = unit(drawn.point - spot) if drawn.point != spot else drawn.way
    normal = hand.read_direction(normal)
    if dot(normal, given.normal * turned) < 0.0:  # the line has no sense, the normal leads out of the cam
        normal = -normal
    contact = drawn.point - cam.roller * mm * normal
    return replace(drawn, centre=centre, normal=normal, contact=contact)


def _on_line(cam: LawCam, given: CamStation, mm: float, base: float, hand: Instrument) -> CamStation | None:
    """The line of a sliding follower turned back, and its point on it; the normal is still to be drawn."""
    laid = hand.length(given.lift * mm)
    travel = hand.angle(given.way)
    away = given.line - given.way * dot(given.way, given.line)  # square to the line, to its foot
    side = 1j if dot(away, 1j * given.way) >= 0 else -1j
    foot = side * travel * hand.compass(abs(away)) if abs(away) > TINY * cam.base * mm else 0j
    if cam.flat:  # the face touches the base circle, wherever its line runs
        start = foot + base * travel
    elif not beyond_rounding(base, abs(foot)):
        start = foot
    else:
        crossed = cross_line_arc(foot, travel, 0j, base)
        if crossed is None:
            return None
        start = crossed[0]
    point = hand.point(start + travel * laid)
    lift = hand.read(abs(point - start)) / mm * (1 if laid >= 0 else -1)
    return replace(given, lift=lift, line=foot, base=start, point=point, way=travel)


def _on_arc(cam: LawCam, given: CamStation, mm: float, base: float, hand: Instrument) -> CamStation | None:
    """The pivot of a swinging follower turned back, and the end of its bar; the normal is still to be drawn."""
    pivot = hand.point(hand.angle(unit(given.line)) * hand.length(abs(given.line)))
    arm = hand.compass(abs(given.point - given.line))
    crossed = cross_arcs(0j, base, pivot, arm)
    if crossed is None:
        return None
    half = (abs(pivot) + arm + base) / 2  # of the perimeter of the triangle: as long as a side where both arcs touch
    touching = not all(beyond_rounding(half, side) for side in (abs(pivot), arm, base))
    nearest = min(crossed, key=lambda z: abs(z - given.base))
    start = hand.point((crossed[0] + crossed[1]) / 2 if touching else nearest)
    turned = unit((given.point - given.line) / (given.base - given.line))
    bar = hand.angle(unit(start - pivot) * turned)
    point = hand.point(pivot + arm * bar)
    swing = cmath.phase(hand.read_direction(bar) / unit(start - pivot))
    lift = swing * (1 if cmath.phase(turned) * given.lift >= 0 else -1) if abs(swing) > ROUNDING else 0.0
    travel = hand.direction(bar * (given.way / unit(given.point - given.line)))
    return replace(given, lift=lift, line=pivot, base=start, point=point, way=travel)
