"""One division of a cam as hands draw it by inversion: each line laid off, each point pricked, lift and pressure angle
read; what the hands do wrong is carried on.

The steps are those of `CamSheet`; with exact hands the values are those of its divisions.
"""

from __future__ import annotations

import cmath

from graphkin.construction.board import Instrument
from graphkin.construction.cam_outline import station
from graphkin.plane import cross_arcs, cross_line_arc, unit
from graphkin.scene.cams import LawCam, SlidingFollower, SwingingFollower

__all__ = ["division_by_hand"]

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
    return lift, _pressure(exact.centre, exact.way, exact.normal, point, way, mm, hand)


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
    return lift, _pressure(exact.centre, exact.way, exact.normal, point, way, mm, hand)


def _pressure(
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
