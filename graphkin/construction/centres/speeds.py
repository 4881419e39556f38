"""Velocities by centres: from the driver to every link by the shortest chain of centres, measured on the figure.

The point P_ij belongs to both links and has one velocity: omega_i * P_ij P_i0 = omega_j * P_ij P_j0, the same sense of
turning where P_i0 and P_j0 lie on one side of P_ij, the opposite where it lies between them; a point X of link j then
moves with omega_j * P_j0 X square to P_j0 X (Norton, Design of Machinery, 6.5).  The distances are measured as products
of homogeneous coordinates, so that a centre at infinity needs no rule of its own: links that turn alike, sliders.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.construction.centres.find import Centres
from graphkin.construction.centres.kennedy import ROUNDING
from graphkin.construction.centres.pairs import Place, product, wedge
from graphkin.plane import dot
from graphkin.scene.model import AngleDriver, AnyDriver
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import driver_pair

__all__ = ["Turning", "by_centres", "error_by_centres", "speeds"]

SURE = 1e-6  # of the driver's own: a link whose motion may err by more waits for a longer chain that gives it better


@dataclass(frozen=True)
class Turning:
    """The motion of a link by centres.

    ``strength`` (1/s) belongs to the centre's homogeneous coordinates (`ProjectiveChart.velocity`), ``omega`` is the
    angular velocity (rad/s).  ``chain`` names the links from the driver to this one, each measured from the one before;
    ``error`` (1/s) is how far the strength may be off, since centres near each other measure badly.
    """

    link: str
    strength: float
    omega: float
    chain: tuple[str, ...]
    error: float = 0.0


def speeds(centres: Centres) -> dict[str, Turning]:
    """The motion of every link that a chain of centres reaches from a driver; a link at rest is among them.

    Returns
    -------
    dict from the link's name to its motion; with several drivers the first that moves is the start
    """
    frame = centres.links.scene.frame.name
    found = {frame: Turning(frame, 0.0, 0.0, (frame,))}
    moving = [d for d in centres.links.scene.drivers if d.values[1] != 0.0]
    if not moving:
        return {name: Turning(name, 0.0, 0.0, (name,)) for name in centres.links.names}
    found.update(_driven(centres, moving[0]))
    steps = max(len(t.chain) for t in found.values())
    largest = SURE * max(abs(t.strength) for t in found.values())
    while len(found) < len(centres.links.names):
        fresh: dict[str, Turning] = {}
        last = steps > len(centres.links.names)  # no further chain gives anything better
        for name in centres.links.names:
            if name in found:
                continue
            from_here = [t for t in found.values() if t.link != frame and (last or len(t.chain) == steps)]
            ways = [turning for t in from_here if (turning := _step(centres, t, name)) is not None]
            best = min(ways, key=lambda turning: turning.error, default=None)
            if best is not None and (last or best.error <= max(largest, SURE * abs(best.strength))):
                fresh[name] = best
        if not fresh and last:
            break
        found.update(fresh)
        steps += 1
    return found


def _driven(centres: Centres, driver: AnyDriver) -> dict[str, Turning]:
    """The links that the driver's own pair moves, from its rate: turning about their common centre, or sliding."""
    scene, chart = centres.links.scene, centres.chart
    structure = centres.sheet.structure
    frame = scene.frame.name
    rate = driver.values[1]
    if isinstance(driver, AngleDriver):
        a, b = driver.link, driver.relative_to
        place = _place(centres, a, b)
        if place is None or place[2] == 0.0:
            return {}
        strength = rate / place[2]
        error = abs(strength / place[2]) * _error(centres, a, b)
    else:
        pair = driver_pair(driver, structure.links, structure.slides)
        slide = structure.slide(driver.key)
        pin = next((p for p in scene.pins if p.key == driver.key), None)
        assert pair is not None
        a, b = (pin.of, pin.on) if pin else (pair.a, pair.b)
        place = _place(centres, a, b)
        if place is None:
            return {}
        along = centres.links.poses[b].axis * slide.guide.direction
        at = centres.links.point(pin.point) if pin else chart.middle
        once = dot(chart.velocity(place, 1.0, at), along)
        if once == 0.0:
            return {}
        strength = rate * centres.links.mm / once
        error = abs(strength / once) * _error(centres, a, b) * (abs(at - chart.middle) + chart.unit)
    if b == frame:
        return {a: Turning(a, strength, strength * place[2], (a,), error)}
    if a == frame:
        return {b: Turning(b, -strength, -strength * place[2], (b,), error)}
    # two moving links: T_a - T_b is known, and the three centres a-b, a-0, b-0 lie on one line
    found = {}
    for name, other, sign in ((a, b, 1.0), (b, a, -1.0)):
        own, its = _place(centres, name, frame), _place(centres, other, frame)
        if own is None or its is None:
            continue
        errors = _error(centres, a, b), _error(centres, other, frame), _error(centres, name, frame)
        ratio, off = _ratio(place, its, own, errors)
        if math.isfinite(off):
            turned = sign * strength * ratio
            found[name] = Turning(name, turned, turned * own[2], (name,), error * abs(ratio) + abs(strength) * off)
    return found


def _place(centres: Centres, a: str, b: str) -> Place | None:
    return centres.of(a, b).place


def _error(centres: Centres, a: str, b: str) -> float:
    """How far the centre of two links may be off, on the unit sphere."""
    return max(centres.of(a, b).error, ROUNDING)


def _ratio(
    known: Place, common: Place, wanted: Place, errors: tuple[float, float, float]
) -> tuple[float, float]:
    """From strength about ``known`` to strength about ``wanted``, three places on a line, the motion about ``common``
    being the difference; and how far it may be off, by the ``errors`` of the three.

    k * known - m * wanted is a multiple of common: k (known x common) = m (wanted x common).
    """
    line, apart = wedge(wanted, common)
    over, sine = wedge(known, common)
    if apart == 0.0:
        return 0.0, math.inf
    of_known, of_common, of_wanted = errors
    off = (of_known + of_common + 2 * (sine / apart) * (of_wanted + of_common)) / apart
    return product(over, line) * sine / apart, off


def _step(centres: Centres, turning: Turning, name: str) -> Turning | None:
    """From one link to the next by their common centre; None where a centre is missing, or falls together with that of
    the link."""
    frame = centres.links.scene.frame.name
    own, its = _place(centres, name, frame), _place(centres, turning.link, frame)
    common = _place(centres, name, turning.link)
    if own is None or its is None or common is None:
        return None
    errors = _error(centres, turning.link, frame), _error(centres, name, turning.link), _error(centres, name, frame)
    ratio, off = _ratio(its, common, own, errors)
    if not math.isfinite(off):
        return None
    strength = turning.strength * ratio
    error = turning.error * abs(ratio) + abs(turning.strength) * off
    return Turning(name, strength, strength * own[2], (*turning.chain, name), error)


def by_centres(centres: Centres, moving: Mapping[str, Turning], symbol: Symbol) -> complex | float | None:
    """A velocity (m/s) or an angular velocity (rad/s) by centres, measured on the figure; None where no chain leads to
    it, or where it is neither."""
    if symbol.kind == "omega":
        turning = moving.get(symbol.link)
        return turning.omega if turning else None
    if symbol.kind != "v" or symbol.of is None:
        return None
    of = _velocity(centres, moving, symbol.of)
    to = _velocity(centres, moving, symbol.to) if symbol.to else 0j
    return None if of is None or to is None else of - to


def error_by_centres(centres: Centres, moving: Mapping[str, Turning], symbol: Symbol) -> float:
    """How far a velocity by centres (m/s, rad/s) may be off by the rounding of the centres' places."""
    links, chart = centres.links, centres.chart
    names = [symbol.link] if symbol.link else []
    spots = [chart.middle + chart.unit]
    for ref in (symbol.of, symbol.to):
        if ref is not None:
            names += [ref.link] if ref.link else [n for n in links.scene.holders[ref.point] if n in moving][:1]
            spots.append(links.point(ref.point))
    reach = 1.0 + max(abs(z - chart.middle) for z in spots) / chart.unit
    whole = 0.0
    for name in names:
        turning = moving.get(name)
        if turning is not None:  # a motion of nothing may be off by all there is, where centres fall together
            whole += turning.error + abs(turning.strength) * _error(centres, name, links.scene.frame.name)
    return whole * reach * (1.0 if symbol.link else chart.unit / links.mm)


def _velocity(centres: Centres, moving: Mapping[str, Turning], ref: PointRef) -> complex | None:
    links = centres.links
    frame = links.scene.frame.name
    holders = [ref.link] if ref.link else [n for n in links.scene.holders[ref.point] if n in links.poses]
    for name in holders:
        turning = moving.get(name)
        if turning is None:
            continue
        if name == frame or turning.strength == 0.0:
            return 0j
        place = _place(centres, name, frame)
        assert place is not None
        return centres.chart.velocity(place, turning.strength, links.point(ref.point)) / links.mm
    return None


