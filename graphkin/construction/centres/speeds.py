"""Velocities by centres: from the driver to every link by the shortest chain of centres, measured on the figure.

The point P_ij belongs to both links and has one velocity: omega_i * P_ij P_i0 = omega_j * P_ij P_j0, the same sense of
turning where P_i0 and P_j0 lie on one side of P_ij, the opposite where it lies between them; a point X of link j then
moves with omega_j * P_j0 X square to P_j0 X (Norton, Design of Machinery, 6.5).  The distances are measured as products
of homogeneous coordinates, so that a centre at infinity needs no rule of its own: links that turn alike, sliders.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from decimal import Decimal

from graphkin.construction.centres.find import ROUNDING, Centres
from graphkin.construction.centres.pairs import LinkPair, Place, product, wedge
from graphkin.plane import dot
from graphkin.scene.model import Driver
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import driver_pair
from graphkin.words import Phrase, written
from graphkin.words.written import MOST, amount, on_paper, true_minus

__all__ = ["Turning", "by_centres", "error_by_centres", "points_asked", "speeds", "velocity_sentences"]

SURE = 1e-6  # of the driver's own: a link whose motion may err by more waits for a longer chain that gives it better
TOGETHER = 1e-9  # mm: places nearer than this are one
STILL = 1e-12  # part of the largest speed that is none


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


def _driven(centres: Centres, driver: Driver) -> dict[str, Turning]:
    """The links that the driver's own pair moves, from its rate: turning about their common centre, or sliding."""
    scene, chart = centres.links.scene, centres.chart
    structure = centres.sheet.structure
    frame = scene.frame.name
    rate = driver.values[1]
    if driver.turns:
        a, b = driver.links
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


# -- told --------------------------------------------------------------------------------------------------------------


def velocity_sentences(centres: Centres, moving: Mapping[str, Turning]) -> tuple[Phrase, ...]:
    """Every link's rate from the link before it in its chain, then every asked point's speed from its link's rate, and
    the sliding velocity of every pin along a guide that moves.

    Among the arguments of the phrases, pairs of links stand for centres, `Symbol` for a velocity, `PointRef` for a
    point; distances are those of the figure (mm).
    """
    rates = _rates(centres, moving)
    links = [_of_link(centres, rates, t) for t in moving.values() if len(t.chain) > 1]
    speeds = {s: abs(by_centres(centres, moving, s) or 0.0) for s in points_asked(centres)}
    least = STILL * max(speeds.values(), default=0.0)
    points = [_of_point(centres, moving, rates, s) for s, speed in speeds.items() if speed > least]
    slidings = (_of_sliding(centres, rates, *one) for one in _pins_on_guides(centres))
    return (*links, *(p for p in (*points, *slidings) if p is not None))


def _apart(mm: float) -> str:
    """A distance on the figure (mm); of places that fall together but for rounding, none."""
    return on_paper(mm if mm > TOGETHER else 0.0)


@dataclass(frozen=True)
class _Rate:
    """An angular velocity (rad/s) as it is written, and how many figures it carries."""

    written: str
    carried: int = MOST

    @property
    def size(self) -> str:
        return self.written.removeprefix("-")


def _carried_apart(one: _Rate, other: _Rate) -> int:
    """How many figures the difference of two rates carries; none where they differ by no more than rounding."""
    apart = Decimal(written.difference(one.written, other.written))
    last = [value.adjusted() - rate.carried for rate in (one, other) if (value := Decimal(rate.written))]
    return apart.adjusted() - max(last) if apart and last else 0


def _rates(centres: Centres, moving: Mapping[str, Turning]) -> Mapping[str, _Rate]:
    """The rate of every link, worked out from the rate before it and the distances as they are written."""
    frame = centres.links.scene.frame.name
    found: dict[str, _Rate] = {}
    largest = max((abs(t.omega) for t in moving.values()), default=0.0)
    for name, turning in sorted(moving.items(), key=lambda one: len(one[1].chain)):
        off = 0.0 if name == frame else error_by_centres(centres, moving, Symbol("omega", link=name))
        if abs(turning.omega) <= max(STILL * largest, min(off, SURE * largest)):
            found[name] = _Rate("0")  # nothing but rounding
            continue
        if len(turning.chain) < 2 or turning.chain[-2] not in found:
            found[name] = _Rate(amount(turning.omega))
            continue
        known = turning.chain[-2]
        own, its, common = centres.of(name, frame), centres.of(known, frame), centres.of(name, known)
        if own.point is None or common.point is None:  # it only translates, or turns as the other does
            found[name] = found[known] if own.point is not None else _Rate(amount(turning.omega))
            continue
        near = _apart(abs(common.point - own.point))
        if its.point is None:
            speed = amount(abs(turning.omega) * abs(common.point - own.point))
            over, carried = speed, written.figures(near)
        else:
            far = _apart(abs(common.point - its.point))
            over = written.product(found[known].size, far)
            carried = min(found[known].carried, written.figures(far, near))
        if near == "0":
            found[name] = _Rate(amount(turning.omega, MOST))
            continue
        carried = min(carried, MOST)
        value = written.quotient(over, near, carried)
        found[name] = _Rate("-" * (turning.omega < 0.0 and value != "0") + value, carried)
    return found


def _pins_on_guides(centres: Centres) -> Iterator[tuple[str, str, str, str]]:
    """Pins that slide along guides of moving links: the point, the link whose pin it is, the link that slides with it
    (the same for a pin in a slot) and the link that bears the guide."""
    scene = centres.links.scene
    frame = scene.frame.name
    yield from ((pin.point, pin.of, pin.of, pin.on) for pin in scene.pins if frame not in (pin.of, pin.on))
    for pair in scene.slidings:
        guiding = pair.on.split(".")[0]
        for point in scene.by_name[pair.link].points:
            others = [n for n in scene.holders[point] if n not in (pair.link, guiding, frame)]
            if others and guiding != frame:
                yield point, others[0], pair.link, guiding
                break


def _of_sliding(
    centres: Centres, moving: Mapping[str, _Rate], point: str, pinned: str, sliding: str, guiding: str
) -> Phrase | None:
    """v_B3B2 = |ω_1 − ω_3| P_13 B: relative to the guiding link the pin turns about the centre of both links."""
    links = centres.links
    if not {pinned, guiding} <= set(moving) or not {pinned, guiding} <= set(links.names):
        return None
    centre = centres.of(pinned, guiding)
    if centre.point is None:
        return None
    rates = [moving[name].written for name in (pinned, guiding)]
    carried = _carried_apart(moving[pinned], moving[guiding])
    if carried < 1:
        return None  # they turn alike as far as the figure tells
    apart = written.difference(*rates)
    units = links.scene.units.rates
    per_mm = amount(centres.sheet.scales.length / units.metres)
    length = _apart(abs(links.point(point) - centre.point))
    symbol = Symbol("v", PointRef(point, guiding), PointRef(point, sliding))
    shown = tuple(f"({rate})" if rate.startswith("-") else rate for rate in rates[1:])
    return Phrase(
        "centre sliding",
        (
            symbol, pinned, guiding, centre.pair, PointRef(point), *(true_minus(r) for r in (rates[0], *shown)),
            length, f"{per_mm} {units.length}/mm",
            f"{written.product(apart, length, per_mm, carried=min(carried, written.figures(length)))} {units.length}/s",
        ),
    )  # fmt: skip


def points_asked(centres: Centres) -> tuple[Symbol, ...]:
    """The absolute velocities of points that the scene asks for; of every moving pin if it asks for nothing."""
    scene = centres.links.scene
    if scene.question.find:
        return tuple(s for s in scene.question.find if s.kind == "v" and s.to is None)
    moving = {name for name in centres.links.names if name != scene.frame.name}
    pins = [p for p, names in scene.holders.items() if p not in scene.frame.points and moving & set(names)]
    return tuple(Symbol("v", PointRef(p)) for p in pins)


def _of_link(centres: Centres, rates: Mapping[str, _Rate], turning: Turning) -> Phrase:
    name, known = turning.link, turning.chain[-2]
    frame = centres.links.scene.frame.name
    own, its, common = centres.of(name, frame), centres.of(known, frame), centres.of(name, known)
    pairs: tuple[LinkPair, ...] = (common.pair, its.pair, own.pair)
    if own.point is None:
        return Phrase("centre slides", (name, known, *pairs))
    if common.point is None:
        return Phrase("centre turns alike", (name, known, *pairs))
    if its.point is None:
        arm = _apart(abs(own.point - common.point))
        return Phrase("centre from slider", (name, known, *pairs, arm, rates[name].size))
    far, near = abs(common.point - its.point), abs(common.point - own.point)
    same = dot(its.point - common.point, own.point - common.point) >= 0.0
    key = "centre same sense" if same else "centre opposite sense"
    omega = true_minus(rates[name].written)
    return Phrase(key, (name, known, *pairs, _apart(far), _apart(near), omega))


def _of_point(
    centres: Centres, moving: Mapping[str, Turning], rates: Mapping[str, _Rate], symbol: Symbol
) -> Phrase | None:
    """The speed of a point: its distance from the link's centre times the rate; of a link that only translates, the
    speed that the link before it has where both have one velocity."""
    ref, links = symbol.of, centres.links
    assert ref is not None
    frame = links.scene.frame.name
    holders = [ref.link] if ref.link else [n for n in links.scene.holders[ref.point] if n in links.poses]
    turning = next((moving[n] for n in holders if n in moving), None)
    if turning is None:
        return None
    units = links.scene.units.rates
    per_mm = amount(centres.sheet.scales.length / units.metres)
    own = centres.of(turning.link, frame)
    if own.point is not None:
        arm = abs(links.point(ref.point) - own.point)
        rate, centre = turning, own.pair
        end: PointRef | LinkPair = ref
    else:
        if len(turning.chain) < 2:
            return None
        rate = moving[turning.chain[-2]]
        its, common = centres.of(rate.link, frame), centres.of(turning.link, rate.link)
        if its.point is None or common.point is None:
            return None
        arm = abs(common.point - its.point)
        centre, end = its.pair, common.pair
    its_rate, length = rates[rate.link], _apart(arm)
    if length == "0":
        return None
    turning_at, carried = its_rate.size, min(its_rate.carried, written.figures(length))
    return Phrase(
        "centre speed",
        (
            symbol, rate.link, centre, end, turning_at, length, f"{per_mm} {units.length}/mm",
            f"{written.product(turning_at, length, per_mm, carried=carried)} {units.length}/s",
        ),
    )
