"""What is read off a drawing: lengths on paper times scale factors, angles from the drawn ends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from graphkin.drafting.instrument import EXACT, Instrument
from graphkin.drafting.sheet import DiagramName, Sheet, Vector
from graphkin.scene.symbol import Symbol

__all__ = ["Reading", "read_off"]


@dataclass(frozen=True)
class Reading:
    """One quantity measured on the drawing.

    ``on_paper`` is the length on paper (mm) it comes from; ``value`` a complex number (m/s, m/s2) for a vector, a float
    (rad/s, rad/s2, counter-clockwise positive) for a rate.  ``diagram`` is the one it was read from.
    """

    symbol: Symbol
    on_paper: float
    value: complex | float
    diagram: DiagramName


def read_off(sheet: Sheet, asked: Sequence[Symbol] = (), instrument: Instrument = EXACT) -> tuple[Reading, ...]:
    """Measure every vector and every rate that was drawn, or only those asked for, with the instrument's eyes.

    >>> from graphkin.scene import read
    >>> from graphkin.drafting import draft
    >>> sheet = draft(read("sixbar-guide-40deg"))
    >>> b3 = {str(r.symbol): r for r in read_off(sheet)}["v_B@3"]
    >>> round(b3.on_paper, 3)
    107.578
    """
    found: dict[Symbol, Reading] = {}
    for diagram, rate, kind in (("velocity", sheet.omega, "omega"), ("acceleration", sheet.alpha, "alpha")):
        name: DiagramName = "velocity" if diagram == "velocity" else "acceleration"
        for symbol, vector in sheet.vectors(name).items():
            found[symbol] = _vector(sheet, name, vector, instrument)
        for link, r in rate.items():
            if link == sheet.scene.frame.name or "/" in link:
                continue
            symbol = Symbol(kind, link=link)
            found[symbol] = Reading(symbol, r.mm, r.value, name)
    if not asked:
        return tuple(found.values())
    return tuple(found[s] for s in asked if s in found)


def _vector(sheet: Sheet, diagram: DiagramName, vector: Vector, instrument: Instrument) -> Reading:
    size = abs(vector.span)
    if instrument is EXACT or size == 0.0:
        return Reading(vector.symbol, size, vector.span * sheet.scales.of(diagram), diagram)
    read = abs(instrument.read(size))
    along = instrument.read_direction(vector.span / size)
    return Reading(vector.symbol, read, read * along * sheet.scales.of(diagram), diagram)
