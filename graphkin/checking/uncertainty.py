"""The uncertainty of each reading before it is drawn, and its remedy.

Uncertainty is of first order, from every act that leads to a reading: each (a point pricked, a direction set, a length
laid off or read) is made wrong once by one standard deviation, the rest exactly; the change of a reading is its
sensitivity times the deviation, and the squares add up (Guide to the expression of uncertainty in measurement, 5.1).
Crossing angles, lengths and scales enter by the construction itself.

Where readings are not in proportion to errors, first order gives too little.  So each is drawn once more with all acts
wrong together in the most probable combination for three deviations, to either side, and its error then is stated (the
design point of Hasofer and Lind, Exact and invariant second-moment code format, 1974): near a dead point, and where
trial polygons are divided, errors grow faster than in proportion.  The effect of acts together, where each alone has
none (the square of a speed that is zero, a product of two such: a mechanism at rest), is found from some drawings in
which all err at once.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from graphkin.checking.readings import read_off
from graphkin.checking.report import COVERAGE, Uncertainty
from graphkin.construction import Plan, Scales, Sheet, Stages, erring, nudged
from graphkin.construction.board.instruments import Instrument
from graphkin.construction.board.sheet import Reading
from graphkin.construction.board.steps import Cause, Order, phrase_of
from graphkin.errors import Unsolvable
from graphkin.plane import added_up
from graphkin.scene.scene_tables import Tools
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase

Values = Mapping[Symbol, complex | float]
Drawn = Callable[..., Values | None]
"""What is read off the drawing of hands that do not err before an act; None where it cannot be drawn."""
T = TypeVar("T")


NO_LIMITS: Mapping[Symbol, float] = MappingProxyType({})
SAMPLES = 24  # drawings in which every act errs at random
FEW_SAMPLES, CLEARLY = 6, 1.3  # in so few a reading that is off by more than that part of its bound does not keep it
BEYOND = 1.6  # times the deviation of first order: more than that in the samples is no accident (one in 10 000)
BENT = 1.1  # a reading is farther off than first order tells by more than that where it is not in proportion
ALIKE = 0.98  # cosine between the errors that bring two readings off most easily, above which one drawing tells of both
CURVED = 1.5  # so many times the deviation of the samples is stated then: squares of errors have long tails


def predict(
    planned: Plan, name: str, tools: Tools, together: bool = True, most: Mapping[Symbol, float] = NO_LIMITS,
    spare: int = 0,
) -> Mapping[Symbol, Uncertainty]:
    """Uncertainty of every reading of a plan drawn with an instrument ("pencil" or "cad").

    Parameters
    ----------
    together : whether effects of acts together, out of proportion, are included
    most, spare : bounds (SI) for readings; without ``together`` the prediction stops when some drawings in which every
        act errs, or the acts so far, show that more than ``spare`` readings exceed their bounds; the uncertainties are
        then those seen so far
    """
    still = nudged(name, tools)
    sheet, read = _drawn_by(planned, still)
    drawn = still.acts
    base = read(still) or {}
    if most and not together:
        some = _samples(read, name, tools, FEW_SAMPLES)
        offs = {s: _spread(s, value, some) for s, value in base.items()}
        if sum(COVERAGE * offs[s] > CLEARLY * most[s] for s in most if s in offs) > spare:
            return {s: Uncertainty(error, _reading(s), 1.0, error) for s, error in offs.items()}
    drawn_causes = sheet.causes
    marks = [acts for acts, _ in drawn_causes]
    reading = len(drawn_causes)
    limits = np.array([(most.get(s, math.inf) / COVERAGE) ** 2 for s in base])
    squares = np.zeros(len(base))
    # how far each act moves each reading, shape (readings, acts)
    moved = np.zeros((len(base), still.acts), dtype=complex)
    for act in range(still.acts, 0, -1):  # the last first: less is drawn again after them
        values = read(nudged(name, tools, {act: 1.0}), act)
        # so near a dead point that this act alone makes the arcs miss: nothing can be promised
        moved[:, act - 1] = [
            math.inf if values is None else s.difference(values.get(s, math.inf), value) for s, value in base.items()
        ]
        if most and not together:
            squares += np.abs(moved[:, act - 1]) ** 2
            if int((squares > limits).sum()) > spare:
                break
    causes = np.array([bisect_left(marks, act) if act <= drawn else reading for act in range(1, still.acts + 1)])
    samples = _samples(read, name, tools) if together else ()
    bent = _bent(read, name, tools, base, moved) if together else np.ones(len(base))
    predicted = {}
    for row, times, (symbol, value) in zip(moved, bent.tolist(), base.items(), strict=True):
        shares: dict[int, float] = {}
        for cause, error in zip(causes.tolist(), (np.abs(row) ** 2).tolist(), strict=True):
            if error:
                shares[cause] = shares.get(cause, 0.0) + error
        if shares and symbol.is_vector and value == 0:  # what errs away from nothing is read off the ruler then
            order: Order = "velocity" if symbol.measure.order == 1 else "acceleration"
            shares[reading] = shares.get(reading, 0.0) + (still.reading_error * planned.scales.of(order)) ** 2
        uncertainty = replace(_summed(symbol, shares, drawn_causes), moved=tuple(row.tolist()))
        if times > BENT:
            uncertainty = replace(uncertainty, deviation=uncertainty.first * times)
        seen = _spread(symbol, value, samples)
        if seen > BEYOND * uncertainty.deviation:
            uncertainty = replace(uncertainty, deviation=CURVED * seen)
        predicted[symbol] = uncertainty
    return predicted


def _drawn_by(planned: Plan, still: Instrument) -> tuple[Sheet, Drawn]:
    """A plan drawn without errors; a function for its readings by other hands, force polygons at the same scales."""
    stages = Stages(planned, planned.scales, still)
    has_forces = stages.sheet.has_forces
    if has_forces:
        from graphkin.construction.forces import force_scales, with_forces

        scales = force_scales(stages.sheet)

    def values(hand: Instrument, first: int = 0) -> Values | None:
        try:
            sheet = stages.sheet if hand is still else stages.by(hand, first)
            sheet = with_forces(sheet, hand, scales) if has_forces else sheet
            return {r.symbol: r.value for r in read_off(sheet, (), hand)}
        except (Unsolvable, ArithmeticError):
            return None

    return stages.sheet, values


def _samples(read: Drawn, name: str, tools: Tools, count: int = SAMPLES) -> Sequence[Values]:
    """The readings of drawings whose acts all err at random, without failed drawings."""
    readings = (read(erring(name, tools, seed)) for seed in range(count))
    return [values for values in readings if values is not None]


def _bent(
    read: Drawn, name: str, tools: Tools, base: Values, moved: NDArray[np.complex128]
) -> NDArray[np.float64]:
    """The factor by which the error of each reading exceeds first order where all acts err together in the most
    probable combination for three deviations; shape (readings,)."""
    nudges: list[tuple[NDArray[np.float64], tuple[Values, ...]]] = []
    times = np.ones(len(base))
    for i, (symbol, row) in enumerate(zip(base, moved, strict=True)):
        if not np.isfinite(row).all() or not row.any():
            continue
        errors = _easiest(row)
        drawn = next((x for x in nudges if abs(float(errors @ x[0])) > ALIKE), None)
        if drawn is None:
            acts = np.flatnonzero(errors).tolist()
            wrong = ({k + 1: sense * COVERAGE * float(errors[k]) for k in acts} for sense in (1.0, -1.0))
            tried = (read(nudged(name, tools, errs)) for errs in wrong)
            drawn = errors, tuple(values for values in tried if values is not None)
            nudges.append(drawn)
        expected = COVERAGE * abs(complex(row @ drawn[0]))
        offs = [abs(symbol.difference(values[symbol], base[symbol])) for values in drawn[1] if symbol in values]
        times[i] = max(offs) / expected if offs else 1.0
    return times


def _easiest(row: NDArray[np.complex128]) -> NDArray[np.float64]:
    """The errors of all acts (in deviations, sum of squares 1) that change a reading most: along its principal axis."""
    parts = np.stack((row.real, row.imag))
    axis = np.linalg.eigh(parts @ parts.T)[1][:, 1]
    errors = axis @ parts
    return np.asarray(errors / np.linalg.norm(errors))


def _reading(symbol: Symbol) -> Phrase:
    """The reading itself as a cause of uncertainty."""
    return Phrase("reading", symbol=symbol)


def _spread(symbol: Symbol, value: complex | float, samples: Sequence[Values]) -> float:
    """Root of the mean square deviation of a reading from a value."""
    errors = [abs(symbol.difference(values[symbol], value)) for values in samples if symbol in values]
    return math.sqrt(added_up(error**2 for error in errors) / len(errors)) if errors else 0.0


def _summed(symbol: Symbol, shares: Mapping[int, float], causes: tuple[tuple[int, Cause], ...]) -> Uncertainty:
    whole = added_up(shares.values())
    if not whole:
        return Uncertainty(0.0, _reading(symbol), 0.0)
    worst = max(shares, key=shares.__getitem__)
    cause = causes[worst][1] if worst < len(causes) else _reading(symbol)
    share = shares[worst] / whole if math.isfinite(whole) else 1.0
    return Uncertainty(math.sqrt(whole), cause, share, math.sqrt(whole))


def deviations(read: Callable[[Instrument], Mapping[T, float] | None], name: str, tools: Tools) -> dict[T, float]:
    """Standard deviation of first order of the readings from a construction drawn with an instrument, "pencil" or
    "cad": each act made wrong once by one standard deviation, the squares added up; infinite where the error of a
    single act makes the construction impossible.

    Parameters
    ----------
    read : function of hands to the readings from their drawing, by name; None where they cannot draw it
    """
    still = nudged(name, tools)
    right = read(still) or {}
    drawn = [read(nudged(name, tools, {act: 1.0})) for act in range(1, still.acts + 1)]
    return {
        key: math.sqrt(added_up(math.inf if wrong is None else (wrong[key] - value) ** 2 for wrong in drawn))
        for key, value in right.items()
    }


SMALL = 0.05  # readings below this part of the largest of their kind are no fair measure of a drawing


def _sort(symbol: Symbol) -> str:
    """The kind of a reading, within which sizes are compared."""
    return symbol.kind[0] if symbol.scope == "motion" else symbol.measure.name


def advise(
    planned: Plan, name: str, tools: Tools, readings: Sequence[Reading], predicted: Mapping[Symbol, Uncertainty]
) -> Phrase | None:
    """The worst reading of a drawing and its best remedy, in a sentence; None where no reading is uncertain, or no
    figure helps.

    Its gaps are the ``symbol`` of the reading, its standard deviation in ``percent`` of its size, the ``cause`` that
    adds most to it with its ``share`` of the variance (per cent), the ``figure`` (of the three the best to draw twice
    as large) and the ``better`` deviation with it (per cent).
    """
    largest: dict[str, float] = {}
    for r in readings:
        largest[_sort(r.symbol)] = max(largest.get(_sort(r.symbol), 0.0), abs(r.value))
    parts: dict[Symbol, float] = {}
    for r in readings:
        expected = predicted.get(r.symbol)
        if expected is None or not expected.first or not expected.deviation < math.inf:
            continue
        # what is smaller is too small, or nothing that is told from zero, such as velocities at rest
        if abs(r.value) > max(SMALL * largest[_sort(r.symbol)], expected.bound):
            parts[r.symbol] = expected.deviation / abs(r.value)
    if not parts:
        return None
    symbol = max(parts, key=parts.__getitem__)
    relative = parts[symbol]
    expected = predicted[symbol]
    figures = ("length", "velocity", "acceleration")
    gains = {figure: _gain(planned, name, tools, symbol, expected.moved, figure) for figure in figures}
    best = min(gains, key=gains.__getitem__)
    if gains[best] == math.inf:
        return None
    return Phrase(
        "advice", symbol=symbol, percent=f"{100 * relative:.2g}", cause=phrase_of(expected.cause),
        share=f"{100 * expected.share:.0f}", figure=Phrase(f"figure {best}"),
        better=f"{100 * relative * gains[best]:.2g}",
    )


def _gain(
    planned: Plan, name: str, tools: Tools, symbol: Symbol, moved: Sequence[complex], figure: str
) -> float:
    """The part of a reading's deviation of first order that is left with a figure drawn twice as large; infinite
    where it cannot be drawn so.

    An act that errs by a length in that figure moves the reading half as far then, any other as far as before.  One
    drawing to either side, in which all acts err in proportion to how far they move it, gives the sum of the products
    of both effects, and so the squares of the acts that are halved.

    Parameters
    ----------
    moved : how far each act moves the reading that errs by one deviation (SI)
    """
    scales: Scales = replace(planned.scales, **{figure: getattr(planned.scales, figure) / 2})
    still = nudged(name, tools)
    _, read = _drawn_by(replace(planned, scales=scales), still)
    if read(still) is None or still.acts != len(moved):
        return math.inf  # at that scale it is drawn otherwise
    row = np.array(moved)
    products = 0.0
    for part, effects in ((np.real, row.real), (np.imag, row.imag)):
        size = float(np.linalg.norm(effects))
        if size:
            errors = {act: error / size for act, error in enumerate(effects.tolist(), 1) if error}
            hands = (nudged(name, tools, {a: sense * error for a, error in errors.items()}) for sense in (1.0, -1.0))
            ahead, behind = ((read(hand) or {}).get(symbol) for hand in hands)
            if ahead is None or behind is None:
                return math.inf
            products += size * float(part(symbol.difference(ahead, behind))) / 2
    squares = float((np.abs(row) ** 2).sum())
    halved = min(max(2 * (squares - products), 0.0), squares)
    return math.sqrt(1 - 0.75 * halved / squares)
