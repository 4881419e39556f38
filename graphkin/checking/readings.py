"""Readings from a drawing: lengths on paper times scale factors, and angles from the drawn ends; and the report of a
drawing, all its readings beside the exact values."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING

from graphkin.checking.report import Report, Uncertainty, compare
from graphkin.construction.board.instruments import EXACT, Instrument
from graphkin.construction.board.sheet import MOST_LOST, Reading, Sheet, either_way
from graphkin.construction.board.steps import ORDERS
from graphkin.construction.position.links_on_paper import travel
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.symbol import PointRef, Symbol, centre_links
from graphkin.solver import Motion
from graphkin.solver.values import as_drawn, exact_values, forces_here, rounding_of
from graphkin.structure.transmission import joint_between, joint_of_follower, sliding_pair
from graphkin.words import Phrase, joined

if TYPE_CHECKING:
    from graphkin.construction.centres import Centres

Place = Callable[[str], complex | None]
Measured = tuple[float | None, float]
"""A length in mm on paper (None for an angle or a number) and the value (m, rad)."""


def read_off(
    sheet: Sheet, asked: Sequence[Symbol] = (), instrument: Instrument = EXACT
) -> tuple[Reading, ...]:
    """Measure what is drawn (vectors, rates, asked positions), or only what is asked here, as the instrument does.

    >>> from graphkin.scene import mechanism_of
    >>> from graphkin.construction import draft
    >>> sheet = draft(mechanism_of("sixbar-guide-40deg"))
    >>> b3 = {str(r.symbol): r for r in read_off(sheet)}["v_B@3"]
    >>> round(b3.on_paper, 3)
    107.578
    """
    readings: dict[Symbol, Reading] = {}
    twins = _one_vector(sheet) if instrument is not EXACT else {}
    scales = sheet.scales.velocity, sheet.scales.acceleration
    for order, (kind, rates), per_mm in zip(ORDERS, sheet.rates.items(), scales, strict=True):
        for symbol, drawn in sheet.vectors[order].items():
            twin = readings.get(twins.get(symbol, symbol))
            if twin is not None:
                readings[symbol] = replace(twin, symbol=symbol)
                continue
            length, along = _vector(sheet, symbol, drawn.tip - drawn.tail, instrument)
            readings[symbol] = Reading(symbol, length, along * per_mm, order, per_mm)
        for link, r in rates.items():
            if link == sheet.scene.frame.name or "/" in link:
                continue
            symbol = Symbol(kind, link=link)
            # a given rate, and that of a link which only slides, is read nowhere
            readings[symbol] = Reading(symbol, r.mm if r.mm or r.vector is not None else None, r.value, order)
        fixed = Symbol(kind, link=sheet.scene.frame.name)  # it is told to who asks for it
        if fixed in (*sheet.asked, *asked):
            readings[fixed] = Reading(fixed, None, 0.0, order)
    readings |= _measured(sheet, (*sheet.asked, *asked), instrument)
    if sheet.has_forces:
        from graphkin.construction.forces import force_readings

        readings |= {reading.symbol: reading for reading in force_readings(sheet, instrument)}
        for symbol in (*sheet.asked, *asked):
            # a joint force or couple that is asked for from its other side
            same = readings.get(replace(symbol, link=symbol.other, other=symbol.link)) if symbol.other else None
            if same is not None and symbol.scope == "force" and symbol not in readings:
                readings[symbol] = replace(same, symbol=symbol, value=-same.value)
            # where nothing begins or ends it is what it is anyway
            same = readings.get(replace(symbol, plus=False)) if symbol.plus else None
            if same is not None and symbol not in readings:
                readings[symbol] = replace(same, symbol=symbol)
    if not asked:
        return tuple(readings.values())
    return tuple(readings[s] for s in asked if s in readings)


def report_on(
    sheet: Sheet, motion: Motion, hand: Instrument = EXACT, predicted: Mapping[Symbol, Uncertainty] | None = None
) -> Report:
    """The report of a drawing: its forces drawn, all measured by the hand that drew it, beside the motion solved there.

    Parameters
    ----------
    predicted : as for `compare`

    Raises
    ------
    Unsolvable : "dead point": the balance does no work
    """
    if sheet.has_forces:
        from graphkin.construction.forces import with_forces

        motion = as_drawn(motion, sheet.structure)
        forces_here(motion)  # it tells best why there are none
        sheet = with_forces(sheet, hand)
    readings = read_off(sheet, (), hand)
    symbols, motion = [reading.symbol for reading in readings], as_drawn(motion, sheet.structure)
    rounding, exact = rounding_of(motion, symbols, sheet.has_forces), exact_values(motion, symbols)
    return compare(sheet, readings, exact, sheet.asked, predicted, rounding)


def _one_vector(sheet: Sheet) -> dict[Symbol, Symbol]:
    """Pairs of vectors that an equation makes equal: the acceleration of a crank pin is its normal part."""
    alike = [[term.symbol for side in e.sides for term in side] for e in sheet.equations if len(e.sides) == 2]
    return {first: second for pair in alike if len(pair) == 2 for first, second in (pair, pair[::-1])}


def _measured(sheet: Sheet, asked: Sequence[Symbol], instrument: Instrument) -> dict[Symbol, Reading]:
    """The readings between points and links of the mechanism."""
    asked = [s for s in dict.fromkeys(asked) if s.scope in ("position", "turn") and not s.at]
    if not asked:
        return {}
    place = _centres(sheet, instrument)
    lengths = {symbol: _position(sheet, symbol, instrument, place) for symbol in asked}
    per_mm = sheet.scales.length
    return {s: Reading(s, *measured, "mechanism", per_mm) for s, measured in lengths.items() if measured is not None}


def _centres(sheet: Sheet, instrument: Instrument) -> Place:
    """The places of instant centres on the drawing (mm), found when the first of them is asked for."""
    @cache
    def centres() -> Centres:
        from graphkin.construction.centres import centres_on

        return centres_on(sheet, sheet.asked, instrument)

    def place(name: str) -> complex | None:
        pair = centre_links(name, sheet.scene.by_name)
        if pair is None or not set(pair) <= set(centres().names):
            return None
        centre = centres().of(*pair)
        if centre.point is None:
            why = Phrase("lies at infinity here") if centre.place is not None else Phrase("has no place here")
            raise Unsolvable("not drawn", Problem(name, "the instant centre of links",
                                                  pair=joined("one and other", pair), value=why))
        return centre.point

    return place


def _vector(sheet: Sheet, symbol: Symbol, span: complex, instrument: Instrument) -> tuple[float, complex]:
    """The length of a vector, and the vector, as they are read (mm)."""
    size = abs(span)
    kept = sheet.readings.get(either_way(symbol)) if size and sheet.readings else None
    if size and instrument is not EXACT:
        length = abs(instrument.read(size) if kept is None else kept)
        return length, length * instrument.read_direction(span / size)
    length = size if kept is None else abs(kept)
    return length, span if kept is None else span * (length / size)


# positions, measured on the drawn mechanism


def _position(sheet: Sheet, symbol: Symbol, instrument: Instrument, place: Place) -> Measured | None:
    """A measured position or quantity of the whole turn; None where its points or links are not drawn.

    Parameters
    ----------
    place : the place (mm) of a name that is no point of the scene, an instant centre; None where it has no place

    Raises
    ------
    CallError : a symbol that means nothing in this mechanism
    """
    if symbol.scope == "turn":
        return _of_turn(sheet, symbol, instrument)
    if symbol.kind in ("x", "y", "d"):
        return _lengths(sheet, symbol, instrument, place)
    if any(name in sheet.scene.by_name and name not in sheet.structure.links for name in symbol.links()):  # redundant
        return None
    if symbol.kind == "s":
        slide = sliding_pair(sheet.structure.slides, symbol)
        if not {slide.a, slide.b} <= set(sheet.poses):
            return None
        return _length(sheet, instrument, travel(slide, sheet.poses, 1.0 / sheet.scales.length))
    names = [name for name in (symbol.link, symbol.other) if name]
    if any(name not in sheet.poses for name in names):
        return None
    if symbol.kind == "theta":
        turned = sheet.poses[symbol.link].axis
        turned = turned / sheet.poses[symbol.other].axis if symbol.other else turned
        return None, phase(instrument.read_direction(turned))
    joint = (
        joint_between(sheet.structure, symbol.link, symbol.other, symbol)
        if symbol.kind == "gamma" else joint_of_follower(sheet.structure, symbol.link, symbol)
    )
    if any(link not in sheet.poses for side in (joint.first, joint.second) for link, _ in side):
        return None
    first, second = joint.directions(lambda link, place: sheet.poses[link].place(place / sheet.scales.length))
    across = instrument.read_direction(first.conjugate() * second / abs(first * second))
    angle = math.atan2(abs(across.imag), abs(across.real))
    return None, angle if symbol.kind == "gamma" else math.pi / 2 - angle


def phase(along: complex) -> float:
    """The angle of a direction, in (-pi, pi]."""
    angle = cmath.phase(along)
    return math.pi if angle == -math.pi else angle


def _length(sheet: Sheet, instrument: Instrument, mm: float) -> Measured:
    read = math.copysign(abs(instrument.read(abs(mm))), mm)
    return abs(read), read * sheet.scales.length


def _lengths(sheet: Sheet, symbol: Symbol, instrument: Instrument, place: Place) -> Measured | None:
    names = [ref.point for ref in (symbol.of, symbol.to) if ref is not None]
    spots = []
    for name in names:
        spot = sheet.points.get(PointRef(name))
        if spot is None and name not in sheet.scene.holders:
            spot = place(name)
        if spot is None:
            return None
        spots.append(spot)
    if symbol.kind == "d":
        kept = sheet.readings.get(frozenset(names))
        if kept is not None:
            return abs(kept), abs(kept) * sheet.scales.length
        return _length(sheet, instrument, abs(spots[1] - spots[0]))
    return _length(sheet, instrument, spots[0].real if symbol.kind == "x" else spots[0].imag)


# the whole turn


def _of_turn(sheet: Sheet, symbol: Symbol, instrument: Instrument) -> Measured | None:
    if symbol.pair not in sheet.limits:
        return None
    mm, (lowest, highest) = 1.0 / sheet.scales.length, sheet.limits[symbol.pair]
    low, high = lowest.poses, highest.poses
    if symbol.kind == "stroke":
        slide = sliding_pair(sheet.structure.slides, symbol)
        return _length(sheet, instrument, abs(travel(slide, high, mm) - travel(slide, low, mm)))
    if symbol.kind == "swing":
        angle = phase(instrument.read_direction(high[symbol.link].axis / low[symbol.link].axis))
        return None, abs(angle + math.tau * round((highest.angle - lowest.angle - angle) / math.tau))
    driver = sheet.scene.drivers[0]
    first, second = (poses[driver.link].axis / poses[driver.relative_to].axis for poses in (low, high))
    sense = -1.0 if driver.values[1] < 0.0 else 1.0
    between = (sense * phase(instrument.read_direction(second / first))) % math.tau
    out, back = between - highest.rest, math.tau - between - lowest.rest
    lag = math.pi * abs(out - back) / (out + back)
    lag = 0.0 if abs(lag) < MOST_LOST else lag  # rounding of exact hands: a pencil reads no such angle
    if symbol.kind == "theta_lag":
        return None, lag
    return None, (math.pi + lag) / (math.pi - lag)
