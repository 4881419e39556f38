"""Every reading compared with the analytic solver, by size and direction; and readings in figures, in the units of
files, with the figures that the reading on paper carries."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import ClassVar

from graphkin.construction.board.sheet import Reading, Sheet
from graphkin.construction.board.steps import ORDERS, Cause, phrase_of
from graphkin.errors import Disagreement, Problem
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol, Value
from graphkin.scene.tables import Unit, Units, derived
from graphkin.solver.motion import SLIGHT
from graphkin.solver.values import Lost
from graphkin.structure import by_drivers_alone, greatest_before
from graphkin.words import Phrase, say
from graphkin.words.written import MOST, ROUNDED, amount, computed, figures, on_paper, product

EXACT_TOLERANCE = 1e-9
ROUNDING = 1e-14
CANCELLED = 1e-12  # of the largest of its sort: what is left where two values cancel
LAST_DIGITS = 4e-15  # of the largest: what is left of a zero where its terms do not cancel exactly
GRAIN = 2e-15  # rounding of places, of the farthest
JUDGED = 4.0  # deviations of a pencil: what each of a dozen readings keeps within in a thousand drawings
FAIR = 1e-3  # of the largest of its diagram: a tolerance that is greater accepts anything (exact hands, programs)
COARSE = 1.0  # the same for hands that err
ON_PAPER = {"exact": 0.0, "cad": 0.1}  # mm that may be read off a figure in which nothing moves
HAND = 5.0
COVERAGE = 3.0  # a stated bound is this many standard deviations
RESIDUE = 1e-6  # of what a deviation may be: what is smaller, rounding leaves
TURNED = 1e-12  # rad, likewise



@dataclass(frozen=True)
class Uncertainty:
    """Standard deviation of a reading (SI; of a vector, the root of the sum over both components).

    ``cause`` is the step that adds most to it, ``share`` its part of the variance, ``first`` the deviation of first
    order, ``moved`` how far each act of the hand moves the reading that errs by one deviation.
    """

    deviation: float
    cause: Cause
    share: float
    first: float = 0.0
    moved: tuple[complex, ...] = field(default=(), repr=False)

    @property
    def bound(self) -> float:
        """The bound of the reading's error in at least 99 of a hundred drawings."""
        return COVERAGE * self.deviation


@dataclass(frozen=True)
class Compared:
    """A reading beside the exact value (SI).

    ``error`` is the size of their difference, as vectors where they are vectors; ``tolerance`` the allowed error;
    ``direction_error`` the angle from the exact direction to the drawn one (rad; 0 for rates and for vectors too short
    to have a direction).  A value not above ``floor`` is rounding alone; a reading is not ``determined`` where its
    tolerance accepts any value.  ``by_drivers``: the drivers alone give it, also where the groups are lost in rounding.
    """

    reading: Reading
    exact: complex | float
    error: float
    tolerance: float
    direction_error: float
    uncertainty: Uncertainty | None = None
    floor: float = 0.0
    determined: bool = True
    by_drivers: bool = False

    @property
    def symbol(self) -> Symbol:
        return self.reading.symbol

    @property
    def on_paper(self) -> float | None:
        """The length on paper from which it was read (mm); None for an angle."""
        return self.reading.on_paper

    @property
    def ok(self) -> bool | None:
        """Whether they agree; None where the reading is not determined."""
        if self.error > self.tolerance:
            return False
        return True if self.determined else None

    @property
    def bound(self) -> float:
        """The size that a reading must exceed to be told from zero."""
        predicted = self.uncertainty.bound if self.uncertainty else 0.0
        return max(self.floor, predicted if math.isfinite(predicted) else 0.0)

    @property
    def measured(self) -> complex | float:
        """The reading, zero where its size is below its own uncertainty."""
        return self.reading.value if abs(self.reading.value) > self.bound else 0.0

    @property
    def true(self) -> complex | float:
        """The exact value, zero where it is rounding alone."""
        return self.exact if abs(self.exact) > self.floor else 0.0

    @property
    def relative(self) -> float | None:
        """The error over the exact value; None where either is zero."""
        return self.error / abs(self.exact) if self.measured != 0.0 and self.true != 0.0 else None


@dataclass(frozen=True)
class Report:
    """All compared readings of a drawing.

    ``sheet`` is the drawing, with its forces if there are masses or loads and forces are asked for; ``missing`` are
    asked symbols that it does not reach.  It is ``ok`` if no reading is out of tolerance, and at least one found value
    is determined.
    """

    sheet: Sheet
    rows: tuple[Compared, ...]
    missing: tuple[Symbol, ...] = ()

    ok: bool = derived()

    def __post_init__(self) -> None:
        compared = any(row.ok and not row.by_drivers for row in self.rows) or all(row.by_drivers for row in self.rows)
        ok = not self.rows or (compared and all(row.ok is not False for row in self.rows))
        self.__dict__.update(ok=ok)

    def must_agree(self) -> None:
        """Raises Disagreement, naming every reading out of tolerance with its drawn and its exact value."""
        problems = []
        for reading in (ReadValue.of(self.sheet.scene, row) for row in self.rows if row.ok is False):
            drawn, exact = reading.shown(reading.measured), reading.shown(reading.exact)
            problems.append(Problem(str(reading.symbol), "by the drawing by computation",
                                    "no paper is written please report this scene", value=drawn, exact=exact))
        if problems:
            raise Disagreement(*problems)

    @property
    def settles_nothing(self) -> bool:
        """Whether no reading is wrong, and none of what is found is determined."""
        return not self.ok and all(row.ok is not False for row in self.rows)

    @property
    def undetermined(self) -> tuple[Symbol, ...]:
        """Readings that are not determined at this position."""
        return tuple(row.symbol for row in self.rows if row.ok is None)


def compare(
    sheet: Sheet,
    readings: Sequence[Reading],
    exact: Mapping[Symbol, Value],
    asked: Sequence[Symbol] = (),
    predicted: Mapping[Symbol, Uncertainty] | None = None,
    rounding: Mapping[Symbol, Lost] | None = None,
) -> Report:
    """Compare readings with exact values.

    Parameters
    ----------
    exact : the exact value of each reading at the drawn position (SI; a complex number for a vector)
    predicted : uncertainty of each reading, by which it is judged; without it (exact instrument) a reading may be off
        by 1e-9 of the largest vector that leads to it, a rate by 1e-9 of the largest rate or of that vector over the
        size; where the tolerance exceeds a thousandth of that (of a pencil: all of it) the reading is not determined
    rounding : for each reading the rounding errors of the exact places (m) and vectors (m/s, m/s2) that lead to it:
        very near a dead point they exceed 1e-9, and drawing and solver agree no better; smaller values are zero
    """
    pairs = [(reading, exact[reading.symbol]) for reading in readings]
    row, lost = partial(_row, sheet, predicted), rounding or {reading.symbol: Lost() for reading in readings}
    scopes = [reading.symbol.scope for reading in readings]
    of_motion, of_forces = (
        [pair for pair, scope in zip(pairs, scopes, strict=True) if scope == kind] for kind in ("motion", "force")
    )
    by_scope = {"motion": _motion(sheet, of_motion, row, rounding)}
    if of_forces:
        by_scope["force"] = _forces(sheet, of_forces, row, lost)

    def place(reading: Reading, value: Value) -> Compared:
        """A length is judged by the size of the mechanism, an angle by a radian, a number by itself."""
        size, power = sheet.scene.size, reading.symbol.measure.length
        whole = max(size**power, abs(value))
        rounded = lost[reading.symbol].mechanism / size ** (1 - power)
        return row(reading, float(value.real), whole, max(rounded, ROUNDING * whole), rounded)

    rows = tuple(by_scope.get(scope, place)(*pair) for scope, pair in zip(scopes, pairs, strict=True))
    have = {r.symbol for r in readings}
    return Report(sheet, rows, tuple(s for s in asked if s not in have))


def _row(
    sheet: Sheet, predicted: Mapping[Symbol, Uncertainty] | None, reading: Reading, exact: Value, whole: float,
    floor: float, rounded: float = 0.0, share: float = EXACT_TOLERANCE, least: float = 0.0, unsure: bool = False,
    by_drivers: bool = False,
) -> Compared:
    """A reading beside the exact value, judged by a size.

    Parameters
    ----------
    whole : the size of which it may be off by a ``share`` with exact hands; where the tolerance exceeds this size, and
        the ``least`` length that a hand reads, the reading is not determined
    floor, rounded : the size up to which a value is rounding alone, and its rounding error
    unsure : whether a value from the last digits of ``whole`` up to the floor may differ from zero
    """
    symbol, expected = reading.symbol, (predicted or {}).get(reading.symbol)
    # an instrument may be off by anything, where it draws and nothing is predicted of this reading
    allowed = 0.0 if predicted is None else math.inf
    if expected is not None:
        allowed = JUDGED * expected.deviation if sheet.instrument == "pencil" else expected.bound
    tolerance = max(allowed, share * whole, rounded)
    part = FAIR if sheet.instrument in ON_PAPER else COARSE
    fair = whole == 0.0 == least or tolerance <= max(part * whole, least)
    error = abs(symbol.difference(reading.value, exact)) if math.isfinite(abs(exact)) else math.inf
    certain = fair and not (unsure and LAST_DIGITS * whole < abs(exact) <= floor)
    return Compared(
        reading, exact, error, tolerance, _turned(reading, exact, whole), expected, floor, certain, by_drivers
    )


def _motion(
    sheet: Sheet, pairs: Sequence[tuple[Reading, Value]], row: Callable[..., Compared],
    rounding: Mapping[Symbol, Lost] | None,
) -> Callable[[Reading, Value], Compared]:
    """The comparison of vectors and rates, by the largest vector that leads to them and its rounding error."""
    greatest = _largest(sheet, pairs)
    by_drivers = {r.symbol for r, _ in pairs if by_drivers_alone(sheet.structure, r.symbol)}
    # the largest of each kind that drivers alone give, beside which rounding is nothing
    led: dict[str, float] = {}
    for reading, value in pairs:
        if reading.symbol in by_drivers:
            led[reading.symbol.kind] = max(led.get(reading.symbol.kind, 0.0), abs(value))
    # a velocity that does not change has an acceleration of rounding alone
    led["a"] = max(led.get("a", 0.0), led.get("v", 0.0) ** 2 / sheet.scene.size)
    share = max(EXACT_TOLERANCE, _grain(sheet))

    def compared(reading: Reading, value: Value) -> Compared:
        symbol, lost = reading.symbol, rounding[reading.symbol] if rounding else Lost()
        most, by = greatest[symbol], 1.0 if symbol.is_vector else sheet.scene.size
        rounded = 0.0 if rounding is None else getattr(lost, reading.diagram) / by
        least = ON_PAPER.get(sheet.instrument, HAND) * getattr(sheet.scales, reading.diagram) / by
        floor, alone = _floor(sheet, reading, lost, EXACT_TOLERANCE * most), symbol in by_drivers
        if not symbol.is_vector and math.isfinite(floor):  # over its own bar, which may be short
            rounded = max(rounded, floor)
        made = row(reading, value, most, floor, rounded, share, least, not lost.slight, alone)
        if alone and (not made.ok or 0.0 < abs(value) <= floor):
            # no group comes before it whose rounding it could have
            most = max(most, led[symbol.kind])
            made = row(reading, value, most, min(floor, CANCELLED * led[symbol.kind]), 0.0, share, least, False, True)
        return made

    return compared


def _largest(sheet: Sheet, pairs: Sequence[tuple[Reading, Value]]) -> dict[Symbol, float]:
    """For each reading of the motion the size by which it is judged: a vector by the largest that leads to it, a rate
    by the largest rate or by that vector over the size (SI)."""
    most: dict[Symbol, float] = {}
    for order, per_mm in zip(ORDERS, (sheet.scales.velocity, sheet.scales.acceleration), strict=True):
        sizes = {r.symbol: max(abs(value), abs(r.value)) for r, value in pairs if r.diagram == order}
        vectors = [(symbol, size) for symbol, size in sizes.items() if symbol.is_vector]
        rates = [(symbol, size) for symbol, size in sizes.items() if not symbol.is_vector]
        # vectors that only lead to the readings asked for belong to the diagram too
        every = [*vectors, *((symbol, abs(drawn.span) * per_mm) for symbol, drawn in sheet.vectors[order].items())]
        # a rate that is zero comes from a vector divided by a length
        slow = [(symbol, size / sheet.scene.size) for symbol, size in every]
        most |= greatest_before(sheet.structure, every, [symbol for symbol, _ in vectors])
        most |= greatest_before(sheet.structure, [*rates, *slow], [symbol for symbol, _ in rates])
    return most


def _turned(reading: Reading, exact: complex | float, whole: float) -> float:
    """The angle from the exact direction of a vector to the drawn one (rad); 0 for a vector too short beside
    ``whole``."""
    if not reading.symbol.is_vector or min(abs(reading.value), abs(exact)) <= 1e-7 * whole:
        return 0.0
    return cmath.phase(complex(reading.value) / complex(exact)) + 0.0  # no minus before nought


def _forces(
    sheet: Sheet, forces: Sequence[tuple[Reading, Value]], row: Callable[..., Compared],
    rounding: Mapping[Symbol, Lost],
) -> Callable[[Reading, Value], Compared]:
    """The comparison of forces, by the largest force (N), that force times the size of the mechanism (N m), and the
    rounding error of a force (N)."""
    def most(measure: str) -> float:
        sizes = (max(abs(r.value), abs(v)) for r, v in forces if r.symbol.measure.name == measure)
        return max((size for size in sizes if math.isfinite(size)), default=0.0)

    largest, size = most("force"), sheet.scene.size
    turning = max(most("moment"), largest * size)
    inertia = {r.symbol.link: abs(v) for r, v in forces if r.symbol.kind == "Fi"}
    relative = rounding[forces[0][0].symbol].force / largest if largest else 0.0
    # arms of what stands still are rounding beside the speeds of the links; at rest the driver has a unit rate
    speeds = (abs(drawn.span) for drawn in sheet.vectors["velocity"].values())
    fastest = max(most("velocity"), max(speeds, default=0.0) * sheet.scales.velocity or size)
    wholes = {"force": largest, "moment": turning, "velocity": fastest}

    def compared(reading: Reading, value: Value) -> Compared:
        symbol = reading.symbol
        whole = wholes.get(symbol.measure.name, size)
        if symbol.kind == "h" and inertia.get(symbol.link):
            # a moment over a force: a small force has an uncertain line
            whole = (turning + abs(value) * largest) / inertia[symbol.link]
        hand = HAND * largest / 100.0 if sheet.instrument not in ON_PAPER and symbol.measure.name == "force" else 0.0
        share, floor = max(EXACT_TOLERANCE, 4.0 * relative), max(relative, CANCELLED) * whole
        return row(reading, value, whole, floor, 0.0, share, hand, relative > SLIGHT)

    return compared


def _grain(sheet: Sheet) -> float:
    """The error of a drawn direction (rad): rounding of places over the shortest bar between two hinges."""
    structure = sheet.structure
    bars = [
        abs(z - w)
        for name, link in structure.links.items() if name != structure.scene.frame.name
        for p, z in link.points.items() if p in structure.hinges
        for q, w in link.points.items() if q in structure.hinges and p < q and z != w
    ]
    far = max((abs(z) for z in sheet.points.values()), default=0.0) * sheet.scales.length
    return GRAIN * far / min(bars, default=math.inf)


_TOLD_APART = (1.0 + math.sqrt(2.0)) ** 2  # v^2 > 2 v d + d^2 from v = (1 + sqrt 2) d on


def _floor(sheet: Sheet, reading: Reading, rounding: Lost, unknown: float) -> float:
    """The size up to which a value is rounding alone (SI), ``unknown`` where it cannot be told: of a rate by the bar at
    which it is measured, of a normal component by the velocity whose square it contains."""
    symbol, slow = reading.symbol, rounding.velocity
    lost: float = getattr(rounding, reading.diagram)
    if not (math.isfinite(lost) and math.isfinite(slow)):
        return unknown
    if symbol.kind == "an" and symbol.of is not None and symbol.to is not None:
        ends = [sheet.points.get(PointRef(ref.point)) for ref in (symbol.of, symbol.to)]
        if ends[0] is not None and ends[1] is not None and ends[0] != ends[1]:
            return min(lost, _TOLD_APART * slow**2 / (abs(ends[0] - ends[1]) * sheet.scales.length))
    if symbol.is_vector:
        return lost
    rate = sheet.rates[symbol.kind].get(symbol.link)
    # a given rate has no bar
    return 0.0 if rate is None else lost / (rate.arm or sheet.scene.size)


def paper(reading: Reading, compared: Compared | None = None) -> str:
    """The length on paper, or a dash for angles and given rates; for a length that cannot be told from zero 0, or with
    a pencil its upper bound."""
    if not reading.on_paper:
        return "0" if reading.symbol.is_vector else "–"
    if compared is None or compared.measured != 0.0:
        return on_paper(reading.on_paper)
    if compared.uncertainty is None or not reading.value:
        return "0"
    return f"< {amount(compared.bound * abs(reading.on_paper / reading.value), 2)}"


def measured(reading: Reading, units: Units, compared: Compared | None = None) -> str:
    """A reading in scene units: a vector or a length as the length on paper times the scale, a rate with the figures of
    its vector; 0 where it cannot be told from zero."""
    value = reading.value if compared is None else compared.measured
    if value == 0.0:
        return "0"
    unit = reading.symbol.unit(units)
    if not reading.on_paper:
        return amount(unit.of(float(value.real)), MOST + 1)
    length = on_paper(reading.on_paper)
    by_scale = product(length, amount(unit.of(reading.per_mm), 12)) if reading.per_mm else ""
    if reading.symbol.is_vector:
        return by_scale
    if abs(abs(value) - abs(reading.on_paper) * reading.per_mm) < 1e-9 * abs(value):
        return ("-" if value.real < 0.0 < reading.on_paper else "") + by_scale
    return computed(unit.of(float(value.real)), min(MOST, figures(length)))


def exact(compared: Compared, units: Units, carried: int = MOST + 1) -> str:
    """The exact value in scene units."""
    value = abs(compared.true) if compared.symbol.is_vector else float(compared.true.real)
    return amount(compared.symbol.unit(units).of(value), carried)


def deviation(compared: Compared, units: Units) -> str:
    """The deviation of a reading from the exact value: in per cent, or, where the exact value is zero, the bound (scene
    units) within which the reading cannot be told from zero; 0 for a value without a hand's error."""
    if compared.relative is None:
        if compared.uncertainty is not None and compared.bound <= compared.floor:
            return "0"
        return f"± {amount(compared.symbol.unit(units).of(max(compared.bound, compared.error)), 2)}"
    return f"{amount(100 * compared.relative, 2)} %"


# readings in the units of files


@dataclass(frozen=True)
class Known:
    """The values of a quantity in a result, in the file's units: degrees for angles, complex numbers for vectors."""

    symbol: Symbol
    unit: str
    values: ClassVar[tuple[str, ...]] = ()
    """Its values by their names."""

    def __repr__(self) -> str:
        values = ((name, getattr(self, name)) for name in self.values)
        shown = (f"{name.replace('_', ' ')} {self.shown(value)}" for name, value in values if value is not None)
        return f"<{self.symbol}: {', '.join(filter(None, (*shown, *self._words())))}>"

    def _words(self) -> tuple[str, ...]:
        """Further words on it."""
        return ()

    def shown(self, value: Value) -> str:
        """A value with its unit; a vector by size and direction."""
        size, direction = abs(value) if isinstance(value, complex) else value, ""
        if isinstance(value, complex) and size:
            direction = f" at {math.degrees(cmath.phase(value)):.6g}°"
        unit = {"deg": "°", "": ""}.get(self.unit, f" {self.unit}")
        return f"{size:.6g}{unit}{direction}"


def in_unit(unit: Unit, value: Value, floor: float) -> Value:
    """A value (SI) in a unit; parts of it not above ``floor`` are 0."""
    parts = (part if abs(part) > floor else 0.0 for part in (value.real, value.imag))
    re, im = (float(unit.of(part)) for part in parts)
    return complex(re, im) if isinstance(value, complex) else re


@dataclass(frozen=True, repr=False)
class ReadValue(Known):
    """A reading of a drawing beside the exact value, each 0 where it is rounding alone.

    on_paper : the length from which it was read (mm); None for an angle and for a given value
    error, tolerance : the size of their difference, as vectors where they are vectors, and its allowed size
    direction_error : from the exact direction to the drawn one (degrees)
    ok : whether they agree; None where the reading is not determined
    uncertainty : the predicted standard deviation; None for exact hands
    """

    values: ClassVar = ("measured", "exact")
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
        )

    def _words(self) -> tuple[str, ...]:
        read = "" if self.on_paper is None else f"read from {self.on_paper:.6g} mm on paper"
        return read, {True: "ok", False: "out of tolerance", None: "not determined here"}[self.ok]


def reading_row(scene: Mechanism, row: Compared, degrees: bool = False) -> dict[str, Json]:
    """A reading as in the JSON: vectors by size, others with sign; ``degrees`` for tables that people read."""
    unit, predicted = row.symbol.unit(scene.units, radians=not degrees), dict[str, Json]()
    if row.uncertainty is not None:  # the standard deviation, and the step that adds most to it
        deviation, cause = finite(unit.of(row.uncertainty.deviation)), say(phrase_of(row.uncertainty.cause))
        predicted = {"uncertainty": deviation, "cause": cause, "cause_share": row.uncertainty.share}

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
        **({"why": say(Phrase("not determined", readings=str(row.symbol)))} if row.ok is None else {}),
        **predicted,
    }


def without_residues(row: Compared) -> Compared:
    """A reading with deviations of 0 where they are rounding alone, for tables that people read."""
    error = 0.0 if row.error <= RESIDUE * row.tolerance else row.error
    return replace(row, error=error, direction_error=0.0 if abs(row.direction_error) <= TURNED else row.direction_error)


def finite(value: float) -> float | None:
    """A number for JSON: None where it is infinite."""
    return value if math.isfinite(value) else None
