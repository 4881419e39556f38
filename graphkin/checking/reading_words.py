"""Readings in figures, in the units of files: as they follow from what is read off the paper, with as many figures as
that has."""

from __future__ import annotations

from graphkin.checking.readings import Reading
from graphkin.checking.report import Compared
from graphkin.construction.sheet import Scales
from graphkin.scene.tables import Units
from graphkin.words.written import MOST, amount, figures, on_paper, product

__all__ = ["deviation", "exact", "measured", "paper"]


def paper(reading: Reading, compared: Compared | None = None) -> str:
    """The length on paper, or a dash for what has none: angles, given rates; where it cannot be told from zero, 0, or
    with a pencil what it is less than."""
    if not reading.on_paper:
        return "0" if reading.symbol.is_vector else "–"
    if compared is None or compared.measured != 0.0:
        return on_paper(reading.on_paper)
    if compared.uncertainty is None or not reading.value:
        return "0"
    return f"< {amount(compared.bound * abs(reading.on_paper / reading.value), 2)}"


def measured(reading: Reading, scales: Scales, units: Units, compared: Compared | None = None) -> str:
    """A reading in scene units: a vector or a length by what is read times the scale, a rate with as
    many figures as that has; 0 where it cannot be told from zero."""
    value = reading.value if compared is None else compared.measured
    if value == 0.0:
        return "0"
    per = reading.symbol.per_unit(units)
    if not reading.on_paper:
        return amount(float(value.real) / per, MOST + 1)
    length = on_paper(reading.on_paper)
    if reading.symbol.is_vector:
        return product(length, amount(scales.of(reading.diagram) / per, 12))
    if abs(abs(value) - abs(reading.on_paper) * scales.length) < 1e-9 * abs(value):
        return ("-" if value.real < 0.0 < reading.on_paper else "") + product(length, amount(scales.length / per, 12))
    return amount(float(value.real) / per, min(MOST, figures(length)))


def exact(compared: Compared, units: Units, carried: int = MOST + 1) -> str:
    """The exact value in scene units."""
    value = abs(compared.true) if compared.symbol.is_vector else float(compared.true.real)
    return amount(value / compared.symbol.per_unit(units), carried)


def deviation(compared: Compared, units: Units) -> str:
    """How far a reading lies off the exact value: in per cent, or, where there is nothing to be a part of, the bound
    (scene units) within which it cannot be told from zero; 0 where a hand cannot be off."""
    if compared.relative is None:
        if compared.uncertainty is not None and compared.bound <= compared.floor:
            return "0"
        return f"± {amount(max(compared.bound, compared.error) / compared.symbol.per_unit(units), 2)}"
    return f"{100 * compared.relative:.2g} %"
