"""Velocities measured through centres beside the exact ones, and how far they may be apart."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from graphkin.construction.centres import (
    Centres,
    Turning,
    by_centres,
    error_by_centres,
)
from graphkin.scene.symbol import PointRef, Symbol

if TYPE_CHECKING:
    from graphkin.solver import Motion

__all__ = ["TOLERANCE", "Velocity", "velocities_by_centres"]

TOLERANCE = 1e-9
FAIR = 1e-3  # of the largest: a value that may be off by more is not determined by the centres
SAFETY = 4.0  # the bound of a velocity by centres over its error of first order


@dataclass(frozen=True)
class Velocity:
    """A velocity or angular velocity by centres beside the exact one (SI).

    ``tolerance`` is how far the two may be apart: 1e-9 of the largest velocity of the mechanism (of the largest rate,
    or that velocity over the size), or what rounding does to the centres and to the position where that is more.  Where
    it exceeds a thousandth of the largest, or where centres are missing, they do not determine the value: ``ok`` is
    None, and ``by_centres`` is None where there is none at all.
    """

    symbol: Symbol
    by_centres: complex | float | None
    exact: complex | float
    chain: tuple[str, ...]
    tolerance: float
    largest: float
    ok: bool | None


def velocities_by_centres(centres: Centres, turning: Mapping[str, Turning], motion: Motion) -> tuple[Velocity, ...]:
    """Velocities measured through centres beside the exact ones: those the scene asks for, or all."""
    scene = centres.links.scene
    asked = [s for s in scene.find if s.kind in ("v", "omega")]
    symbols = asked if scene.find else _all(centres)
    found = []
    # what is asked may be nought beside the rest: it is judged by the whole mechanism
    exact = {s: complex(motion.value(s)[0]) for s in dict.fromkeys((*symbols, *_all(centres)))}
    largest = {kind: max((abs(x) for s, x in exact.items() if s.kind == kind), default=0.0) for kind in ("v", "omega")}
    size = scene.size
    largest["omega"] = max(largest["omega"], largest["v"] / size)
    rounded = float(motion.rough[0][0])
    for symbol in symbols:
        value = by_centres(centres, turning, symbol)
        wanted = exact[symbol] if symbol.is_vector else exact[symbol].real
        if value is None:
            found.append(Velocity(symbol, None, wanted, (), math.inf, largest[symbol.kind], None))
            continue
        most = max(largest[symbol.kind], 1e-300)
        own = rounded / (1.0 if symbol.is_vector else size)
        tolerance = max(TOLERANCE * most, own, SAFETY * error_by_centres(centres, turning, symbol))
        close = None if tolerance > FAIR * most else abs(value - wanted) <= tolerance
        found.append(Velocity(symbol, value, wanted, _chain(centres, turning, symbol), tolerance, most, close))
    return tuple(found)


def _all(centres: Centres) -> list[Symbol]:
    links = centres.links
    frame = links.scene.frame
    moving = [name for name in links.names if name != frame.name]
    pins = [p for p, names in links.scene.holders.items() if p not in frame.points and any(n in moving for n in names)]
    return [Symbol("omega", link=name) for name in moving] + [Symbol("v", PointRef(p)) for p in pins]


def _chain(centres: Centres, turning: Mapping[str, Turning], symbol: Symbol) -> tuple[str, ...]:
    if symbol.link:
        return turning[symbol.link].chain
    assert symbol.of is not None
    holders = [symbol.of.link] if symbol.of.link else centres.links.scene.holders[symbol.of.point]
    return next((turning[n].chain for n in holders if n in turning), ())
