"""Positions measured on the drawn mechanism: lengths with a rule, angles with a protractor.

Between which directions a transmission angle lies is said in `graphkin.structure.transmission`.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass

from graphkin.construction.instruments import Instrument
from graphkin.construction.links_on_paper import travel
from graphkin.construction.sheet import Sheet
from graphkin.construction.zero_vectors import MOST_LOST
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure.transmission import TransmissionAngle, joint_between, joint_of_follower, sliding_pair

__all__ = ["Measured", "measured"]

Place = Callable[[str], complex | None]


@dataclass(frozen=True)
class Measured:
    """A length in mm on paper (None for an angle or a number) and the value (m, rad)."""

    mm: float | None
    value: float


def measured(sheet: Sheet, symbol: Symbol, instrument: Instrument, place: Place | None = None) -> Measured | None:
    """A position or a quantity of the whole turn, measured; None where what it is of is not drawn.

    Parameters
    ----------
    place : where a name lies (mm) that is none of the scene's points, an instant centre; None where it has no place

    Raises
    ------
    CallError : a symbol that means nothing in this mechanism
    """
    if symbol.scope == "turn":
        return _of_turn(sheet, symbol, instrument)
    if symbol.kind in ("x", "y", "d"):
        return _lengths(sheet, symbol, instrument, place)
    if symbol.kind == "s":
        slide = sliding_pair(sheet.structure, symbol)
        if not {slide.a, slide.b} <= set(sheet.poses):
            return None
        return _length(sheet, instrument, travel(slide, sheet.poses, 1.0 / sheet.scales.length))
    names = [name for name in (symbol.link, symbol.other) if name]
    if any(name not in sheet.poses for name in names):
        return None
    if symbol.kind == "theta":
        turned = sheet.poses[symbol.link].axis
        turned = turned / sheet.poses[symbol.other].axis if symbol.other else turned
        return Measured(None, phase(instrument.read_direction(turned)))
    joint = (
        joint_between(sheet.structure, symbol.link, symbol.other, symbol)
        if symbol.kind == "gamma" else joint_of_follower(sheet.structure, symbol.link, symbol)
    )  # fmt: skip
    if any(link not in sheet.poses for way in (joint.first, joint.second) for link, _ in way):
        return None
    first, second = ways(sheet, joint)
    across = instrument.read_direction(first.conjugate() * second / abs(first * second))
    angle = math.atan2(abs(across.imag), abs(across.real))
    return Measured(None, angle if symbol.kind == "gamma" else math.pi / 2 - angle)


def phase(along: complex) -> float:
    """The angle of a direction, in (-pi, pi]."""
    angle = cmath.phase(along)
    return math.pi if angle == -math.pi else angle


def _length(sheet: Sheet, instrument: Instrument, mm: float) -> Measured:
    read = math.copysign(abs(instrument.read(abs(mm))), mm)
    return Measured(abs(read), read * sheet.scales.length)


def _lengths(sheet: Sheet, symbol: Symbol, instrument: Instrument, place: Place | None) -> Measured | None:
    assert symbol.of is not None
    spots = []
    for ref in (symbol.of, symbol.to):
        if ref is None:
            continue
        spot = sheet.points.get(PointRef(ref.point))
        if spot is None and place is not None and ref.point not in sheet.scene.holders:
            spot = place(ref.point)
        if spot is None:
            return None
        spots.append(spot)
    if symbol.kind == "d":
        kept = sheet.readings.get(frozenset(ref.point for ref in (symbol.of, symbol.to) if ref))
        if kept is not None:
            return Measured(abs(kept), abs(kept) * sheet.scales.length)
        return _length(sheet, instrument, abs(spots[1] - spots[0]))
    return _length(sheet, instrument, spots[0].real if symbol.kind == "x" else spots[0].imag)


def ways(sheet: Sheet, joint: TransmissionAngle) -> tuple[complex, complex]:
    """The two directions on paper between which a transmission angle lies (`graphkin.structure.transmission`)."""

    def of(spot: tuple[str, complex]) -> complex:
        pose = sheet.poses[spot[0]]
        return pose.place(spot[1] / sheet.scales.length)

    first, second = (of(end) - of(start) for start, end in (joint.first, joint.second))
    return first, second * (1j if joint.square else 1.0)


# -- the whole turn ----------------------------------------------------------------------------------------------------


def _of_turn(sheet: Sheet, symbol: Symbol, instrument: Instrument) -> Measured | None:
    limits = sheet.limits.get(symbol.pair)
    if limits is None:
        return None
    mm = 1.0 / sheet.scales.length
    low, high = limits.low.poses, limits.high.poses
    if symbol.kind == "stroke":
        slide = sliding_pair(sheet.structure, symbol)
        return _length(sheet, instrument, abs(travel(slide, high, mm) - travel(slide, low, mm)))
    if symbol.kind == "swing":
        turned = high[symbol.link].axis / low[symbol.link].axis
        angle = phase(instrument.read_direction(turned))
        return Measured(None, abs(angle + math.tau * round((limits.swing - angle) / math.tau)))
    driver = sheet.scene.drivers[0]
    one, two = (poses[driver.link].axis / poses[driver.relative_to].axis for poses in (low, high))
    between = phase(instrument.read_direction(two / one))
    lag = math.pi - abs(between)
    lag = 0.0 if abs(lag) < MOST_LOST else lag  # rounding of exact hands: a pencil reads no such angle
    if symbol.kind == "theta_lag":
        return Measured(None, lag)
    return Measured(None, (math.pi + lag) / (math.pi - lag))
