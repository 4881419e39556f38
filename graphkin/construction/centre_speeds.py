"""Velocities by centres: from the driver to every link by the shortest chain of centres, measured on the figure.

The point P_ij belongs to both links and has one velocity: omega_i * P_ij P_i0 = omega_j * P_ij P_j0, the same sense of
turning where P_i0 and P_j0 lie on one side of P_ij, the opposite where it lies between them; a point X of link j then
moves with omega_j * P_j0 X square to P_j0 X (Norton, Design of Machinery, 6.5).  The distances are measured as products
of homogeneous coordinates, so that a centre at infinity needs no rule of its own: links that turn alike, sliders.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.construction.centres import Centre, Centres, product, wedge
from graphkin.plane import dot
from graphkin.scene.model import Driver
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import driver_pair

__all__ = ["Turning", "by_centres", "error_by_centres", "moving_pins", "speeds", "turning_of"]

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
    frame = centres.scene.frame.name
    moving = [d for d in centres.scene.drivers if d.values[1] != 0.0]
    if not moving:
        return {name: Turning(name, 0.0, 0.0, (name,)) for name in centres.names}
    found = {frame: Turning(frame, 0.0, 0.0, (frame,)), **_driven(centres, moving[0])}
    steps = max(len(t.chain) for t in found.values())
    largest = SURE * max(abs(t.strength) for t in found.values())
    while len(found) < len(centres.names):
        fresh: dict[str, Turning] = {}
        last = steps > len(centres.names)  # no further chain gives anything better
        known = [t for t in found.values() if t.link != frame and (last or len(t.chain) == steps)]
        for name in (name for name in centres.names if name not in found):
            # from one link to the next by their common centre
            chains = [_carried(t, centres.of(t.link, frame), centres.of(name, t.link), centres.of(name, frame),
                               (*t.chain, name)) for t in known]  # fmt: skip
            best = min((t for t in chains if t is not None), key=lambda turning: turning.error, default=None)
            if best is not None and (last or best.error <= max(largest, SURE * abs(best.strength))):
                fresh[name] = best
        if not fresh and last:
            break
        found.update(fresh)
        steps += 1
    return found


def _driven(centres: Centres, driver: Driver) -> dict[str, Turning]:
    """The links that the driver's own pair moves, from its rate: turning about their common centre, or sliding."""
    chart, structure, frame = centres.chart, centres.sheet.structure, centres.scene.frame.name
    pin = next((p for p in centres.scene.pins if p.key == driver.key), None)
    if driver.turns:
        a, b = driver.links
    else:
        pair = driver_pair(driver, structure.links, structure.slides)
        assert pair is not None
        a, b = (pin.of, pin.on) if pin else (pair.a, pair.b)
    centre = centres.of(a, b)
    if centre.place is None:
        return {}
    once, reach = centre.place[2], 1.0
    if not driver.turns:
        at = centres.point(pin.point) if pin else chart.middle
        along = centres.poses[b].axis * structure.slide(driver.key).guide.direction
        once = dot(chart.velocity(centre.place, 1.0, at), along) / centres.mm
        reach = (abs(at - chart.middle) + chart.unit) / centres.mm
    if once == 0.0:
        return {}
    strength = driver.values[1] / once
    own = Turning(a, strength, strength * centre.place[2], (a,), abs(strength / once) * centre.error * reach)
    if b == frame:
        return {a: own}
    back = Turning(b, -own.strength, -own.omega, (b,), own.error)
    if a == frame:
        return {b: back}
    # two moving links: the difference of their motions is known
    found = (_carried(turning, centre, centres.of(other, frame), centres.of(turning.link, frame), turning.chain)
             for turning, other in ((own, b), (back, a)))  # fmt: skip
    return {turning.link: turning for turning in found if turning is not None}


def _carried(
    turning: Turning, known: Centre, common: Centre, wanted: Centre, chain: tuple[str, ...]
) -> Turning | None:
    """From a motion about ``known`` to that about ``wanted``, three centres on a line, where the motion about
    ``common`` is the difference; None where a centre is missing, or the last two fall together.

    k * known - m * wanted is a multiple of common: k (known x common) = m (wanted x common).
    """
    if known.place is None or common.place is None or wanted.place is None:
        return None
    line, apart = wedge(wanted.place, common.place)
    over, sine = wedge(known.place, common.place)
    if apart == 0.0:
        return None
    ratio = product(over, line) * sine / apart
    off = (known.error + common.error + 2 * (sine / apart) * (wanted.error + common.error)) / apart
    strength, error = turning.strength * ratio, turning.error * abs(ratio) + abs(turning.strength) * off
    return Turning(chain[-1], strength, strength * wanted.place[2], chain, error)


def turning_of(centres: Centres, moving: Mapping[str, Turning], ref: PointRef) -> Turning | None:
    """The motion of the link of a point: that of the first link with it that is known."""
    holders = [ref.link] if ref.link else centres.scene.holders[ref.point]
    return next((moving[name] for name in holders if name in moving), None)


def by_centres(centres: Centres, moving: Mapping[str, Turning], symbol: Symbol) -> complex | float | None:
    """A velocity (m/s) or an angular velocity (rad/s) by centres, measured on the figure; None where no chain leads to
    it, or where it is neither."""
    if symbol.kind == "omega":
        return moving[symbol.link].omega if symbol.link in moving else None
    if symbol.kind != "v" or symbol.of is None:
        return None
    of = _velocity(centres, moving, symbol.of)
    to = _velocity(centres, moving, symbol.to) if symbol.to else 0j
    return None if of is None or to is None else of - to


def _velocity(centres: Centres, moving: Mapping[str, Turning], ref: PointRef) -> complex | None:
    turning = turning_of(centres, moving, ref)
    if turning is None or turning.strength == 0.0:
        return 0j if turning else None
    place = centres.of(turning.link, centres.scene.frame.name).place
    assert place is not None
    return centres.chart.velocity(place, turning.strength, centres.point(ref.point)) / centres.mm


def error_by_centres(centres: Centres, moving: Mapping[str, Turning], symbol: Symbol) -> float:
    """How far a velocity by centres (m/s, rad/s) may be off by the rounding of the centres' places."""
    chart, frame = centres.chart, centres.scene.frame.name
    refs = [ref for ref in (symbol.of, symbol.to) if ref is not None]
    spots = [chart.middle + chart.unit, *(centres.point(ref.point) for ref in refs)]
    reach = 1.0 + max(abs(z - chart.middle) for z in spots) / chart.unit
    whole = 0.0
    for ref in refs or [PointRef("", symbol.link)]:
        turning = turning_of(centres, moving, ref)
        if turning is not None and turning.link != frame:
            # a motion of nothing may be off by all there is, where centres fall together
            whole += turning.error + abs(turning.strength) * centres.of(turning.link, frame).error
    return whole * reach * (1.0 if symbol.link else chart.unit / centres.mm)


def moving_pins(centres: Centres) -> tuple[Symbol, ...]:
    """The velocities of all pins that links move."""
    frame, links = centres.scene.frame, set(centres.names) - {centres.scene.frame.name}
    pins = (p for p, names in centres.scene.holders.items() if p not in frame.points and links.intersection(names))
    return tuple(Symbol("v", PointRef(p)) for p in pins)
