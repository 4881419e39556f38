"""Zhukovsky's lever: the velocity polygon turned by 90 degrees as a rigid lever about its pole.

Each force at the end point of its point's velocity; the moment about the pole is the power of the force over the scale,
so that all moments together are nought (virtual power), which gives what balances (N. E. Zhukovsky 1909; Artobolevsky,
Theory of mechanisms and machines, ch. 13).  A couple is a pair of forces square to a bar, at the end points of the
bar's points.
"""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.construction.board import Instrument
from graphkin.construction.forces.force_sheet import Acting, ForceState, KnownMoment, Lever, LeverRow
from graphkin.construction.forces.images import Images
from graphkin.construction.forces.order import BalanceForm, balance_of
from graphkin.construction.sheet import Sheet
from graphkin.plane import cross, unit
from graphkin.scene.symbol import Symbol

__all__ = ["levers_of"]

TURN = -1j
"""Turned clockwise: the moment of a force about the pole, counter-clockwise positive, is its power then."""


def levers_of(sheet: Sheet, state: ForceState, hand: Instrument) -> tuple[Lever, ...]:
    """A lever for each driver, or for what balances instead; none where that does not move."""
    drivers = sheet.scene.drivers
    if sheet.scene.loading.balance is not None:
        drivers = drivers[:1]
    moving = sheet.growing or (sheet,)
    made = [
        _lever(sheet, drawn, state, balance_of(sheet.structure, driver), hand)
        for driver, drawn in zip(drivers, moving, strict=True)
    ]
    return tuple(lever for lever in made if lever is not None)


def _lever(sheet: Sheet, drawn: Sheet, state: ForceState, balance: BalanceForm, hand: Instrument) -> Lever | None:
    images = Images(drawn)
    ends = {str(ref): TURN * z for ref, z in drawn.ends["velocity"].items()}
    rows = [_force(images, one, hand) for one in _at(images, sheet, state.known)]
    rows += [_couple(images, one, hand) for one in state.turning]
    unknown = _unknown(images, balance, hand)
    if abs(unknown.moment) <= 1e-12 * max((abs(z) for z in ends.values()), default=0.0):
        return None
    value = -sum(row.moment for row in rows) / unknown.moment
    vector = 0j if balance.is_moment else value * unknown.force
    return Lever(drawn.scales.velocity, drawn is not sheet, ends, tuple(rows), balance.symbol, unknown, value, vector)


def _at(images: Images, sheet: Sheet, known: Sequence[Acting]) -> list[Acting]:
    """The forces with their places on the figure from which the images are."""
    times = sheet.scales.length / images.sheet.scales.length
    return [Acting(one.symbol, one.link, one.force, one.at * times, one.turned) for one in known]


def _arm(end: complex, force: complex, hand: Instrument) -> float:
    mm = cross(end, unit(force))
    if abs(mm) <= 1e-13 * abs(end):
        return 0.0
    read = hand.read(abs(mm))
    return read if mm > 0 else -read


def _force(images: Images, one: Acting, hand: Instrument) -> LeverRow:
    end = TURN * images.velocity(one.link, one.at)
    arm = _arm(end, one.force, hand) if one.force and end else 0.0
    return LeverRow(one.symbol, one.force, end, arm, abs(one.force) * arm, None, one.turned)


def _couple(images: Images, one: KnownMoment, hand: Instrument) -> LeverRow:
    return _pair(images, one.symbol, one.link, one.moment, hand)


def _pair(images: Images, symbol: Symbol, link: str, moment: float, hand: Instrument) -> LeverRow:
    """A couple on a link as a pair of forces at two of its points, square to the line between them."""
    far = images.image("velocity", link) if link != images.sheet.scene.frame.name else None
    omega = images.sheet.omega[link].value if link in images.sheet.omega else 0.0
    if far is None or omega == 0.0:
        # a link without two points on the figure: its rate is that of another link
        arm = omega / images.sheet.scales.velocity
        return LeverRow(symbol, complex(moment), 0j, arm, moment * arm)
    (a, a_end), (b, b_end) = far
    bar = b - a
    force = 1j * unit(bar) * (moment / (abs(bar) / images.mm))
    tail, tip = TURN * a_end, TURN * b_end
    read = hand.read(abs(tip - tail))
    arm = read if cross(tip - tail, 1j * unit(bar)) > 0 else -read
    return LeverRow(symbol, force, tip, arm, moment / (abs(bar) / images.mm) * arm, (tail, tip))


def _unknown(images: Images, balance: BalanceForm, hand: Instrument) -> LeverRow:
    """What balances, of unit size, between both links that it acts on."""
    frame = images.sheet.scene.frame.name
    if balance.is_moment:
        own = _pair(images, balance.symbol, balance.link, 1.0, hand)
        if balance.other == frame:
            return own
        other = _pair(images, balance.symbol, balance.other, 1.0, hand)
        return LeverRow(balance.symbol, own.force, own.at, own.arm, own.moment - other.moment, own.pair)
    along, at = images.of_balance(balance)
    own = _force(images, Acting(balance.symbol, balance.link, along, at), hand)
    if balance.other == frame:
        return own
    other = _force(images, Acting(balance.symbol, balance.other, along, at), hand)
    return LeverRow(balance.symbol, along, own.at, own.arm, own.moment - other.moment)
