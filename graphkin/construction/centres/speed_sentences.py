"""How a worked solution tells velocities by centres: each rate from the one before it, each speed from its link's rate,
with the distances as the figure shows them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from decimal import Decimal

from graphkin.construction.centres.find import Centres
from graphkin.construction.centres.pairs import LinkPair
from graphkin.construction.centres.speeds import SURE, Turning, by_centres, error_by_centres
from graphkin.plane import dot
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, written
from graphkin.words.written import MOST, amount, on_paper, true_minus

__all__ = ["points_asked", "velocity_sentences"]

TOGETHER = 1e-9  # mm: places nearer than this are one
STILL = 1e-12  # part of the largest speed that is none


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
    if scene.find:
        return tuple(s for s in scene.find if s.kind == "v" and s.to is None)
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
