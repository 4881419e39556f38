"""What is read off the sheet of forces: sizes and directions of forces, moments, shifts, and arms on the lever."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from graphkin.construction.forces.draw import forces_on
from graphkin.construction.forces.force_sheet import ForceSheet
from graphkin.construction.instruments import EXACT, Instrument
from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.scene.symbol import Symbol

__all__ = ["ForceReading", "force_readings", "readings_of"]

SAME = 1e-12
"""Of the largest force: a load that begins exactly here leaves what differs less as it is."""
NOUGHT = 1e-10
"""Of the largest force: an inertia force smaller than this has no line."""


@dataclass(frozen=True)
class ForceReading:
    """A quantity with its length on paper (mm; None where it is the result of a moment equation) and its value (N, N m,
    m, m/s)."""

    symbol: Symbol
    mm: float | None
    value: complex | float
    diagram: DiagramName


def force_readings(sheet: Sheet, hand: Instrument = EXACT) -> tuple[ForceReading, ...]:
    """Draw the forces of a sheet with an instrument and read them off.  Raises Unsolvable as `forces_on`."""
    return readings_of(sheet, forces_on(sheet, hand), hand)


def readings_of(sheet: Sheet, forces: ForceSheet, hand: Instrument = EXACT) -> tuple[ForceReading, ...]:
    """What is read off forces that are drawn; with ``+`` what a load changes that begins or ends exactly there."""
    return (*_of_states(forces, hand), *_shifts(sheet, forces), *_arms(sheet, forces))


def _of_states(forces: ForceSheet, hand: Instrument) -> Iterator[ForceReading]:
    base = forces.states[0]
    largest = max((abs(v) for state in forces.states for v in state.vectors.values()), default=0.0)
    for state in forces.states:
        for symbol, span in state.vectors.items():
            named = symbol if state is base else replace(symbol, plus=True)
            if state is not base and abs(span - base.vectors[symbol]) <= SAME * largest:
                continue
            size = abs(span)
            if size == 0.0:
                yield ForceReading(named, 0.0, 0j, "force")
                continue
            length = abs(hand.read(size))
            along = hand.read_direction(span / size) if hand is not EXACT else span / size
            yield ForceReading(named, length, length * along * forces.per_mm, "force")
        most = max((abs(m) for m in state.moments.values()), default=0.0)
        for symbol, moment in state.moments.items():
            named = symbol if state is base else replace(symbol, plus=True)
            if state is base or abs(moment - base.moments[symbol]) > SAME * most:
                yield ForceReading(named, None, moment, "force")


def _largest(forces: ForceSheet) -> float:
    return max((abs(v) for state in forces.states for v in state.vectors.values()), default=0.0) * forces.per_mm


def _shifts(sheet: Sheet, forces: ForceSheet) -> Iterator[ForceReading]:
    """The shifts of inertia forces that have a couple."""
    most = _largest(forces)
    for link, one in forces.inertias.items():
        if one.h is not None and one.inertia and abs(one.force) > NOUGHT * most:
            yield ForceReading(Symbol("h", link=link), abs(one.h) / sheet.scales.length, one.h, "mechanism")


def _arms(sheet: Sheet, forces: ForceSheet) -> Iterator[ForceReading]:
    """The arms of all forces on the lever of one driver, in the state in which they act."""
    if any(len(levers) != 1 for levers in forces.levers):
        return
    most, seen = _largest(forces), set[Symbol]()
    for (lever,) in forces.levers:
        for row in (*lever.rows, lever.unknown):
            symbol = Symbol("arm", name=str(row.symbol))
            forceful = row.symbol.is_vector and (row is lever.unknown or abs(row.force) > NOUGHT * most)
            if forceful and symbol not in seen:
                seen.add(symbol)
                arm = row.moment if row is lever.unknown else row.arm  # what balances may act between two moving links
                yield ForceReading(symbol, abs(arm), arm * lever.per_mm, "velocity")
