"""Quantities with what is known of them, as rows for programs and, by name, in the units of the file for people."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from graphkin.checking.report import Compared
from graphkin.construction.steps import phrase_of
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol, Value
from graphkin.scene.tables import Unit
from graphkin.words import Phrase, say
from graphkin.words.written import ROUNDED

if TYPE_CHECKING:
    from graphkin.checking.audit import Judged
    from graphkin.checking.uncertainty import Uncertainty

__all__ = ["JudgedValue", "Known", "ReadValue", "finite", "in_unit", "reading_row", "without_residues"]

RESIDUE = 1e-6  # of what a deviation may be: what is smaller, rounding leaves
TURNED = 1e-12  # rad, likewise


@dataclass(frozen=True)
class Known:
    """What a result knows of a quantity, in the file's units: degrees for angles, complex numbers for vectors."""

    symbol: Symbol
    unit: str

    def __repr__(self) -> str:
        told = (f"{what} {self.shown(value)}" for what, value in self._values() if value is not None)
        return f"<{self.symbol}: {', '.join(filter(None, (*told, *self._words())))}>"

    def _values(self) -> tuple[tuple[str, Value | None], ...]:
        """Its values by what they are."""
        return ()

    def _words(self) -> tuple[str, ...]:
        """What else is to be said of it."""
        return ()

    def shown(self, value: Value) -> str:
        """A value with its unit beside it; of a vector size and direction."""
        size, way = abs(value) if isinstance(value, complex) else value, ""
        if isinstance(value, complex) and size:
            way = f" at {math.degrees(cmath.phase(value)):.6g}°"
        unit = {"deg": "°", "": ""}.get(self.unit, f" {self.unit}")
        return f"{size:.6g}{unit}{way}"


def in_unit(unit: Unit, value: Value, floor: float) -> Value:
    """A value (SI) in a unit; what of it is not above ``floor`` is 0."""
    parts = (part if abs(part) > floor else 0.0 for part in (value.real, value.imag))
    re, im = (float(unit.of(part)) for part in parts)
    return complex(re, im) if isinstance(value, complex) else re


@dataclass(frozen=True, repr=False)
class ReadValue(Known):
    """A reading of a drawing beside the exact value, both 0 where they are nothing but rounding.

    on_paper : the length it was read from (mm); None for an angle and for what is given
    error, tolerance : how far the two are apart, as vectors where they are vectors, and what that may be
    direction_error : from the exact direction to the drawn one (degrees)
    ok : whether they agree; None where agreement would mean nothing
    uncertainty : the predicted standard deviation; None for exact hands
    """

    on_paper: float | None
    measured: Value
    exact: Value
    error: float
    tolerance: float
    direction_error: float
    ok: bool | None
    uncertainty: float | None

    @classmethod
    def of(cls, scene: Mechanism, row: Compared) -> ReadValue:
        """A compared reading (SI) in the units of its scene."""
        unit = row.symbol.unit(scene.units)
        measured, exact = (complex(v) if row.symbol.is_vector else float(v.real) for v in (row.measured, row.true))
        return cls(
            row.symbol, unit.text, row.on_paper, in_unit(unit, measured, row.bound), in_unit(unit, exact, row.floor),
            unit.of(row.error), unit.of(row.tolerance), math.degrees(row.direction_error), row.ok,
            None if row.uncertainty is None else unit.of(row.uncertainty.deviation),
        )  # fmt: skip

    def _values(self) -> tuple[tuple[str, Value | None], ...]:
        return ("measured", self.measured), ("exact", self.exact)

    def _words(self) -> tuple[str, ...]:
        read = "" if self.on_paper is None else f"read from {self.on_paper:.6g} mm on paper"
        return read, {True: "ok", False: "out of tolerance", None: "not determined here"}[self.ok]


@dataclass(frozen=True, repr=False)
class JudgedValue(Known):
    """A stated value with its verdict, in the file's units.

    exact : what it is held against: signed where it has a sense, a complex number against two components, else the size
        of the vector
    deviation : the relative one; None where the exact value is 0
    bound : what a pencil drawing keeps within
    looks_like : the slip that explains a wrong value, in words; "" where none is known
    follows_from : earlier wrong values of the same person from which it follows
    """

    printed: Value
    exact: Value
    deviation: float | None
    verdict: str
    bound: float
    looks_like: str
    follows_from: tuple[Symbol, ...]

    @classmethod
    def of(cls, scene: Mechanism, judged: Judged, language: str) -> JudgedValue:
        """A judged value (SI) in the units of its scene."""
        symbol = judged.printed.symbol
        unit = symbol.unit(scene.units)
        return cls(
            symbol, unit.text, unit.of(judged.printed.value), unit.of(judged.exact), judged.deviation, judged.verdict,
            unit.of(judged.bound), "" if judged.looks_like is None else say(judged.looks_like, language),
            judged.follows_from,
        )  # fmt: skip

    def _values(self) -> tuple[tuple[str, Value | None], ...]:
        return ("printed", self.printed), ("exact", self.exact)

    def _words(self) -> tuple[str, ...]:
        return self.verdict, self.looks_like


def reading_row(scene: Mechanism, row: Compared, degrees: bool = False) -> dict[str, Json]:
    """One reading as in the JSON: vectors by size, others with sign; ``degrees`` for tables that people read."""
    unit = row.symbol.unit(scene.units, radians=not degrees)

    def size(value: Value) -> float:
        return float(unit.of(abs(value) if row.symbol.is_vector else float(value.real)))

    return {
        "symbol": str(row.symbol),
        "on_paper_mm": 0.0 if row.on_paper is not None and abs(row.on_paper) < ROUNDED else row.on_paper,
        "measured": size(row.measured),
        "exact": size(row.true),
        "error": unit.of(row.error),
        "tolerance": finite(unit.of(row.tolerance)),
        "direction_error_rad": row.direction_error,
        "ok": row.ok,
        **({"why": say(Phrase("not determined", (str(row.symbol),)))} if row.ok is None else {}),
        **(_predicted(finite(unit.of(row.uncertainty.deviation)), row.uncertainty) if row.uncertainty else {}),
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
