"""Readings as rows: for programs, and in the units of the file for tables that people read."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from graphkin.checking.report import Compared
from graphkin.construction.steps import phrase_of
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase, say
from graphkin.words.written import ROUNDED

if TYPE_CHECKING:
    from graphkin.checking.uncertainty import Uncertainty

__all__ = ["finite", "in_scene_units", "reading_row", "without_residues"]

RESIDUE = 1e-6  # of what a deviation may be: what is smaller, rounding leaves
TURNED = 1e-12  # rad, likewise


def in_scene_units(scene: Mechanism, symbol: Symbol, value: float, degrees: bool = False) -> float:
    """A value in the scene's length unit, seconds, and radians as in JSON, or degrees as in files."""
    units = scene.units
    return value / (symbol.per_unit(units) if degrees else symbol.per_unit_of_programs(units))


def reading_row(scene: Mechanism, row: Compared, degrees: bool = False) -> dict[str, Json]:
    """One reading as in the JSON: vectors by size, others with sign; ``degrees`` for tables that people read."""

    def unit(value: float) -> float:
        return in_scene_units(scene, row.symbol, value, degrees)

    def size(value: complex | float) -> float:
        return unit(abs(value) if row.symbol.is_vector else float(value.real))

    return {
        "symbol": str(row.symbol),
        "on_paper_mm": 0.0 if row.on_paper is not None and abs(row.on_paper) < ROUNDED else row.on_paper,
        "measured": size(row.measured),
        "exact": size(row.true),
        "error": unit(row.error),
        "tolerance": finite(unit(row.tolerance)),
        "direction_error_rad": row.direction_error,
        "ok": row.ok,
        **({"why": say(Phrase("not determined", (str(row.symbol),)))} if row.ok is None else {}),
        **(_predicted(finite(unit(row.uncertainty.deviation)), row.uncertainty) if row.uncertainty else {}),
    }


def without_residues(row: Compared) -> Compared:
    """A reading whose deviations are 0 where they are nothing but rounding, for tables that people read."""
    error = 0.0 if row.error <= RESIDUE * row.tolerance else row.error
    return replace(row, error=error, direction_error=0.0 if abs(row.direction_error) <= TURNED else row.direction_error)


def finite(value: float) -> float | None:
    """A number as JSON has it: none where there is no bound."""
    return value if math.isfinite(value) else None


def _predicted(deviation: float | None, uncertainty: Uncertainty) -> dict[str, Json]:
    """Standard deviation of a reading in its unit, and the step that adds most to it."""
    return {
        "uncertainty": deviation,
        "cause": say(phrase_of(uncertainty.cause)),
        "cause_share": uncertainty.share,
    }
