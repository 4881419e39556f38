"""The account of instant centres: the construction and the place of each, and every velocity taken through them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from decimal import Decimal
from typing import NamedTuple

from graphkin.construction.centres import Centre, CentreRelation, Centres, LinkPair, Turning
from graphkin.plane import dot
from graphkin.scene.model import Driver
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, listed, written
from graphkin.words.symbols import RichText, Words
from graphkin.words.written import MOST, amount, on_paper, printed

SURE = 1e-6  # of the largest rate: one that may err by more, and is no larger than that, is nothing but rounding
TOGETHER = 1e-9  # mm: places nearer than this are one
STILL = 1e-12  # part of the largest speed that is none


def how_found(centres: Centres, centre: Centre, name: Callable[[LinkPair], Words]) -> Phrase:
    """The construction of a centre as a phrase; ``name`` writes centres."""
    if centre.kind == "undetermined":
        return Phrase("centre none", centre=centre.pair)
    far = centre.point is None
    if centre.kind == "permanent":
        key = "centre rolling" if centre.rolls else "centre guide" if far else "centre joint"
        return Phrase(key, centre=centre.pair, joint=centre.joint)
    if centre.way:
        return Phrase(f"centre {centre.way}", centre=centre.pair, kept=listed(centres.kept))
    through = [line.through for line in centre.lines]
    endless = [all(not isinstance(end, str) and centres.of(*end).point is None for end in ends) for ends in through]
    first, second = (line_through(line, name, lambda pin: f"n({pin})") for line in centre.lines)
    if any(endless):
        line, infinite = (second, first) if endless[0] else (first, second)
        return Phrase("centre at infinity on", centre=centre.pair, line=line, infinite=infinite)
    key = "centre crossing far" if far else "centre crossing"
    return Phrase(key, centre=centre.pair, first=first, second=second)


def line_through(
    line: CentreRelation, name: Callable[[LinkPair], Words], normal: Callable[[str], Words]
) -> RichText:
    """A line through a centre, by the centres on it, or as the normal of a pin in a slot."""
    return RichText(*(normal(through) if isinstance(through, str) else name(through) for through in line.through))


def place_of(centres: Centres, centre: Centre) -> tuple[float, float] | None:
    """Coordinates of a centre in the scene's unit of length, 0 where they are rounding alone; of a centre at infinity
    its direction; None where it is undetermined."""
    scene = centres.scene
    if centre.point is None and centre.direction is None:
        return None
    units = scene.units.metres
    z = centre.direction if centre.point is None else centre.point * centres.sheet.scales.length / units
    assert z is not None
    x, y = (value if abs(value) > 1e-12 * scene.size / units else 0.0 for value in (z.real, z.imag))
    return x, y


def velocity_sentences(centres: Centres) -> tuple[Phrase, ...]:
    """Sentences on every link's rate from the link before it in its chain, then on every asked point's speed from its
    link's rate (on every moving pin's if the scene asks for nothing), and on the sliding velocity of every pin along a
    moving guide.

    In the gaps of the phrases a pair of links is a centre, a `Symbol` a velocity, a `PointRef` a point; distances are
    those of the figure (mm).
    """
    rates: dict[str, _Rate] = {}
    of_links: dict[str, Phrase] = {}
    moving = centres.turning
    largest = max((abs(t.omega) for t in moving.values()), default=0.0)
    bases = {driver.relative_to for driver in centres.scene.drivers}
    for turning in sorted(moving.values(), key=lambda t: (len(t.chain), t.link in bases)):
        error = centres.velocity_error(Symbol("omega", link=turning.link))
        nothing = abs(turning.omega) <= max(STILL * largest, min(error, SURE * largest))  # but rounding
        driver = None if nothing or len(turning.chain) > 1 else _between_moving(centres, turning)
        chain = driver.links if driver else turning.chain  # from the driven link, through their common centre
        entry = None
        if driver and turning.link == driver.link:
            entry = _of_driver(centres, turning, driver)
        elif len(chain) > 1:
            entry = _of_link(turning, chain[-2], rates[chain[-2]], _three(centres, *chain[-2:]), nothing)
        if entry is None:
            rates[turning.link] = _Rate("0" if nothing else amount(turning.omega))
        else:
            rates[turning.link], of_links[turning.link] = entry
    links = [of_links[name] for name in moving if name in of_links]
    asked = [s for s in centres.scene.question.find if s.kind == "v" and s.to is None]
    wanted = asked if centres.scene.question.find else centres.moving_pins
    speeds = {s: abs(centres.velocity(s) or 0.0) for s in wanted}
    least = STILL * max(speeds.values(), default=0.0)
    points = [_of_point(centres, rates, s) for s, speed in speeds.items() if speed > least]
    slidings = (_of_sliding(centres, rates, *pin) for pin in _pins_on_guides(centres))
    return (*links, *(p for p in (*points, *slidings) if p is not None))


class _Rate(NamedTuple):
    """An angular velocity (rad/s) as it is written, and the number of its figures."""

    written: str
    carried: int = MOST

    @property
    def size(self) -> str:
        return self.written.removeprefix("-")

    @property
    def last(self) -> int:
        """The power of ten of its last figure."""
        return Decimal(self.written).adjusted() - self.carried


def _apart(first: complex, second: complex) -> str:
    """A distance on the figure (mm); 0 for places that differ by rounding alone."""
    mm = abs(first - second)
    return on_paper(mm if mm > TOGETHER else 0.0)


def _three(centres: Centres, known: str, name: str) -> tuple[Centre, Centre, Centre]:
    """The centres of a link's motion: its own, that of the link before it in its chain, and their common one."""
    frame = centres.scene.frame.name
    return centres.of(name, frame), centres.of(known, frame), centres.of(name, known)


def _between_moving(centres: Centres, turning: Turning) -> Driver | None:
    """The driver with which a chain begins, where it moves a link that turns relative to another such link, about a
    pin or along a guide."""
    frame, moving = centres.scene.frame.name, centres.turning
    for driver in [driver for driver in centres.scene.drivers if driver.rate][:1]:
        pinned = not driver.turns and centres.sheet.structure.slide(driver.key).higher
        if turning.link in driver.links and not pinned and {*driver.links} <= moving.keys() - {frame}:
            here, there = (centres.of(link, frame).point for link in driver.links)
            if here is not None and there is not None and _apart(here, there) != "0":
                return driver
    return None


def _of_driver(centres: Centres, turning: Turning, driver: Driver) -> tuple[_Rate, Phrase] | None:
    """The rate of a driven link from that of the driver, relative to another moving link, and its sentence.

    Of links a and b: omega_a : omega_ab = P_ab P_b0 : P_a0 P_b0, as of two links with the common centre P_b0; where
    they slide on each other, v_ab = omega_a P_a0 P_b0.
    """
    frame, units, both = centres.scene.frame.name, centres.scene.units.rates, "".join(driver.links)
    new, common = (centres.of(link, frame) for link in driver.links)
    if driver.turns:
        relative, its = _Rate(amount(abs(driver.values[1]))), centres.of(*driver.links)
        return None if its.point is None else _of_link(turning, both, relative, (new, its, common))
    assert new.point is not None
    assert common.point is not None
    near = _apart(new.point, common.point)
    sign = "-" * (turning.omega < 0.0)
    per_mm, speed = amount(centres.sheet.scales.length / units.metres), amount(abs(driver.values[1]) / units.metres)
    rate = _Rate(sign + written.quotient(speed, written.product(near, per_mm), MOST), written.figures(near))
    return rate, Phrase("centre from cylinder", link=turning.link, known=both, centre=new.pair, common=common.pair,
                        near=near, rate=printed(rate.size), scale=f"{printed(per_mm)} {units.length}/mm",
                        speed=units.of("velocity").beside(printed(speed)))


def _of_link(
    turning: Turning, before: str, known: _Rate, three: tuple[Centre, Centre, Centre], nothing: bool = False
) -> tuple[_Rate, Phrase]:
    """The rate of a link and its sentence, from the ``known`` rate of the link ``before`` it, ``three`` centres (see
    `_three`) and their distances as they are written; ``nothing`` where the rate is rounding alone: 0."""
    new, its, common = three
    sign = "-" * (turning.omega < 0.0)
    gaps: dict[str, object] = {
        "link": turning.link, "known": before, "common": common.pair, "known_centre": its.pair, "centre": new.pair,
    }
    if new.point is None:  # it only translates
        key = "centre slides otherwise" if common.point is None else "centre slides"
        return _Rate("0" if nothing else amount(turning.omega)), Phrase(key, **gaps)
    if common.point is None:  # it turns as the other does
        return _Rate("0") if nothing else known, Phrase("centre turns alike", **gaps)
    near, far = _apart(new.point, common.point), None if its.point is None else _apart(common.point, its.point)
    if nothing or near == "0":
        rate = _Rate("0" if nothing else amount(turning.omega, MOST))
    else:
        over = amount(abs(turning.omega) * abs(common.point - new.point))
        carried = written.figures(near)
        if far is not None:
            over, carried = written.product(known.size, far), min(known.carried, written.figures(far, near))
        value = written.quotient(over, near, min(carried, MOST))
        rate = _Rate(sign * (value != "0") + value, min(carried, MOST))
    if far is None or its.point is None:
        return rate, Phrase("centre from slider", **gaps, near=near, rate=printed(rate.size))
    same = dot(its.point - common.point, new.point - common.point) >= 0.0
    key = "centre same sense" if same else "centre opposite sense"
    if far == "0" and near != "0":
        key = "centre stands still"
    return rate, Phrase(key, **gaps, far=far, near=near, rate=printed(rate.written))


def _of_point(centres: Centres, rates: Mapping[str, _Rate], symbol: Symbol) -> Phrase | None:
    """The speed of a point: its distance from the link's centre times the rate; of a link that only translates, the
    speed of the link before it where both have the same velocity."""
    assert symbol.of is not None
    turning = centres.turning_of(symbol.of)
    if turning is None:
        return None
    link, centre = turning.link, centres.of(turning.link, centres.scene.frame.name)
    end: PointRef | LinkPair = symbol.of
    at: complex | None = centres.point(symbol.of.point)
    if centre.point is None:
        if len(turning.chain) < 2:
            return None
        _, centre, common = _three(centres, *turning.chain[-2:])
        link, end, at = turning.chain[-2], common.pair, common.point
    if centre.point is None or at is None or (length := _apart(at, centre.point)) == "0":
        return None
    rate = rates[link]
    scale, speed = _speed(centres, rate.size, length, min(rate.carried, written.figures(length)))
    return Phrase(
        "centre speed", symbol=symbol, link=link, centre=centre.pair, end=end, rate=printed(rate.size), length=length,
        scale=scale, speed=speed,
    )


def _speed(centres: Centres, rate: str, length: str, carried: int) -> tuple[str, str]:
    """The scale of the figure, and the product of a rate (rad/s) and a length on it (mm)."""
    units = centres.scene.units.rates
    per_mm = amount(centres.sheet.scales.length / units.metres)
    speed = written.product(rate, length, per_mm, carried=carried)
    return f"{printed(per_mm)} {units.length}/mm", units.of("velocity").beside(printed(speed))


def _pins_on_guides(centres: Centres) -> Iterator[tuple[str, str, str, str]]:
    """Pins that slide along guides of moving links: the point, the link whose pin it is, the link that slides with it
    (the same for a pin in a slot) and the link with the guide."""
    scene, frame = centres.scene, centres.scene.frame.name
    yield from ((s.pin, s.of, s.of, s.b) for s in scene.slides if s.higher and frame not in s.bodies)
    for pair in scene.slidings:
        guiding = pair.b.split(".")[0]
        for point in scene.by_name[pair.a].points:
            others = [n for n in scene.holders[point] if n not in (pair.a, guiding, frame)]
            if others and guiding != frame:
                yield point, others[0], pair.a, guiding
                break


def _of_sliding(
    centres: Centres, rates: Mapping[str, _Rate], point: str, pinned: str, sliding: str, guiding: str
) -> Phrase | None:
    """v_B3B2 = |ω_1 − ω_3| P_13 B: relative to the guiding link the pin turns about the centre of both links."""
    if not {pinned, guiding} <= set(rates) or not {pinned, guiding} <= set(centres.names):
        return None
    centre = centres.of(pinned, guiding)
    pinned_rate, guide_rate = rates[pinned], rates[guiding]
    difference = written.difference(pinned_rate.written, guide_rate.written)
    # what the difference carries; None where they turn alike as far as the figure tells
    last = max((rate.last for rate in (pinned_rate, guide_rate) if Decimal(rate.written)), default=0)
    carried = Decimal(difference).adjusted() - last if Decimal(difference) else 0
    if centre.point is None or carried < 1:
        return None
    length = _apart(centres.point(point), centre.point)
    symbol = Symbol("v", PointRef(point, guiding), PointRef(point, sliding))
    first, second = printed(pinned_rate.written), printed(guide_rate.written)
    scale, speed = _speed(centres, difference, length, min(carried, written.figures(length)))
    return Phrase(
        "centre sliding", symbol=symbol, link=pinned, guide=guiding, centre=centre.pair, point=PointRef(point),
        rate=first, guide_rate=f"({second})" if second.startswith("−") else second, length=length, scale=scale,
        speed=speed,
    )
