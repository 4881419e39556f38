"""What is read off a drawing, how far each reading may lie off before it is drawn, and what would make it better.

Readings are lengths on paper times scale factors, and angles from the drawn ends.  Uncertainty is of first order, from
every act that leads to a reading: each (a point pricked, a direction set, a length laid off or read) is made wrong once
by one standard deviation, the rest exactly; what that does to a reading is its sensitivity times the deviation, and the
squares add up (Guide to the expression of uncertainty in measurement, 5.1).  Crossing angles, lengths and scales come
in by the construction itself.  What acts do together, where each alone does little (the square of a speed that is
nought, a product of two such: a mechanism at rest), is seen on some drawings in which all err at once.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from graphkin.construction import Plan, Scales, erring, execute, nudged
from graphkin.construction.board import EXACT, Instrument
from graphkin.construction.centres import Centres, centres_on
from graphkin.construction.forces import force_readings
from graphkin.construction.measures import measured
from graphkin.construction.sheet import DiagramName, Sheet, Vector
from graphkin.construction.steps import Cause, ReadOff, phrase_of
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.symbol import Symbol, centre_links
from graphkin.scene.tables import Tools
from graphkin.words import Phrase

__all__ = ["COVERAGE", "Advice", "Reading", "Uncertainty", "advise", "predict", "read_off"]


@dataclass(frozen=True)
class Reading:
    """One quantity measured on the drawing.

    ``on_paper`` is the length on paper (mm) it comes from, None for an angle read with the protractor; ``value`` a
    complex number (m/s, m/s2) for a vector, a float (rad/s, rad/s2, counter-clockwise positive; m, rad) for others.
    ``diagram`` is the one it was read from.
    """

    symbol: Symbol
    on_paper: float | None
    value: complex | float
    diagram: DiagramName


def read_off(sheet: Sheet, asked: Sequence[Symbol] = (), instrument: Instrument = EXACT) -> tuple[Reading, ...]:
    """Measure every vector and every rate that was drawn, and the positions that the drawing was asked for, or only
    what is asked for here, with the instrument's eyes.

    >>> from graphkin.scene import mechanism_of
    >>> from graphkin.construction import draft
    >>> sheet = draft(mechanism_of("sixbar-guide-40deg"))
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
    places = _centres(sheet, instrument)
    for symbol in dict.fromkeys((*sheet.asked, *asked)):
        if symbol.scope in ("position", "turn") and not symbol.at:
            one = measured(sheet, symbol, instrument, places)
            if one is not None:
                found[symbol] = Reading(symbol, one.mm, one.value, "mechanism")
    if sheet.has_forces:
        found |= {r.symbol: Reading(r.symbol, r.mm, r.value, r.diagram) for r in force_readings(sheet, instrument)}
        for symbol in (*sheet.asked, *asked):
            same = _as_drawn(symbol, found)
            if same is not None and symbol not in found:
                found[symbol] = replace(same, symbol=symbol, value=-same.value)
    if not asked:
        return tuple(found.values())
    return tuple(found[s] for s in asked if s in found)


def _as_drawn(symbol: Symbol, found: Mapping[Symbol, Reading]) -> Reading | None:
    """The reading of a joint force or couple that is asked for from its other side."""
    if symbol.scope != "force" or not symbol.other:
        return None
    return found.get(replace(symbol, link=symbol.other, other=symbol.link))


def _centres(sheet: Sheet, instrument: Instrument) -> Callable[[str], complex | None]:
    """Where instant centres lie on the drawing (mm), found as soon as one is asked for."""
    centres: list[Centres] = []

    def place(name: str) -> complex | None:
        pair = centre_links(name, sheet.scene.by_name)
        if pair is None:
            return None
        if not centres:
            centres.append(centres_on(sheet, sheet.asked, instrument))
        if not set(pair) <= set(centres[0].links.names):
            return None
        centre = centres[0].of(*pair)
        if centre.point is None:
            found = "lies at infinity here" if centre.place is not None else "has no place here"
            raise Unsolvable("not drawn", Problem(name, f"the instant centre of links {' and '.join(pair)} {found}"))
        return centre.point

    return place


def _vector(sheet: Sheet, diagram: DiagramName, vector: Vector, instrument: Instrument) -> Reading:
    size = abs(vector.span)
    if instrument is EXACT or size == 0.0:
        return Reading(vector.symbol, size, vector.span * sheet.scales.of(diagram), diagram)
    length = abs(instrument.read(size))
    along = instrument.read_direction(vector.span / size)
    return Reading(vector.symbol, length, length * along * sheet.scales.of(diagram), diagram)


COVERAGE = 3.0  # a stated bound is this many standard deviations
SAMPLES = 24  # drawings in which every act errs at random
BEYOND = 1.6  # times the deviation of first order: more than that in the samples is no accident (one in 10 000)
CURVED = 1.5  # so many times the deviation of the samples is stated then: squares of errors have long tails


@dataclass(frozen=True)
class Uncertainty:
    """Standard deviation of a reading (SI; of a vector, the root of the sum over both components).

    ``cause`` is the step that adds most to it, ``share`` its part of the variance.
    """

    deviation: float
    cause: Cause
    share: float

    @property
    def bound(self) -> float:
        """What the reading keeps within at least 99 times in a hundred."""
        return COVERAGE * self.deviation


def predict(what: Plan, name: str, tools: Tools, together: bool = True) -> Mapping[Symbol, Uncertainty]:
    """Uncertainty of every reading of a plan drawn with an instrument ("pencil" or "cad"); what acts do only
    ``together`` may be left out."""
    still = nudged(name, tools, 0)
    sheet = execute(what, still)
    drawn = still.acts
    base = {r.symbol: r.value for r in read_off(sheet, (), still)}
    marks = [acts for acts, _ in sheet.causes]
    parts: dict[Symbol, dict[int, float]] = {symbol: {} for symbol in base}
    reading = len(sheet.causes)
    for act in range(1, still.acts + 1):
        hand = nudged(name, tools, act)
        try:
            values = {r.symbol: r.value for r in read_off(execute(what, hand), (), hand)}
        except (Unsolvable, ArithmeticError):
            # so near a dead point that this act alone makes the arcs miss: nothing can be promised
            values = dict.fromkeys(base, complex(math.inf))
        cause = bisect_left(marks, act) if act <= drawn else reading
        for symbol, value in base.items():
            off = abs(values.get(symbol, math.inf) - value) ** 2
            if off:
                parts[symbol][cause] = parts[symbol].get(cause, 0.0) + off
    for symbol, shares in parts.items():
        if shares and symbol.is_vector and base[symbol] == 0:  # what errs away from nothing is read off the ruler then
            order: DiagramName = "velocity" if symbol.measure == "velocity" else "acceleration"
            shares[reading] = shares.get(reading, 0.0) + (still.reading_error * what.scales.of(order)) ** 2
    samples = _samples(what, name, tools) if together else ()
    found = {}
    for symbol, shares in parts.items():
        first = _summed(symbol, shares, sheet.causes)
        seen = _spread(base[symbol], [values[symbol] for values in samples if symbol in values])
        found[symbol] = replace(first, deviation=CURVED * seen) if seen > BEYOND * first.deviation else first
    return found


def _samples(what: Plan, name: str, tools: Tools) -> Sequence[Mapping[Symbol, complex | float]]:
    """The readings of some drawings in which every act errs at random; those that cannot be drawn are left out."""
    found = []
    for seed in range(SAMPLES):
        hand = erring(name, tools, seed)
        try:
            found.append({r.symbol: r.value for r in read_off(execute(what, hand), (), hand)})
        except (Unsolvable, ArithmeticError):
            continue
    return found


def _spread(value: complex | float, values: Sequence[complex | float]) -> float:
    """Root of the mean square deviation from a value."""
    return math.sqrt(sum(abs(v - value) ** 2 for v in values) / len(values)) if values else 0.0


def _summed(symbol: Symbol, shares: Mapping[int, float], causes: tuple[tuple[int, Cause], ...]) -> Uncertainty:
    whole = sum(shares.values())
    if not whole:
        return Uncertainty(0.0, ReadOff(symbol), 0.0)
    worst = max(shares, key=shares.__getitem__)
    cause = causes[worst][1] if worst < len(causes) else ReadOff(symbol)
    return Uncertainty(math.sqrt(whole), cause, shares[worst] / whole if math.isfinite(whole) else 1.0)


SMALL = 0.05  # readings below this part of the largest of their kind are no fair measure of a drawing


@dataclass(frozen=True)
class Advice:
    """The worst reading of a drawing and what would help it most.

    ``relative`` is its standard deviation over its size; ``cause`` the step that adds most to it, with its ``share`` of
    the variance; ``figure`` the one to draw twice as large, and ``gain`` what is left of the deviation then.
    """

    symbol: Symbol
    relative: float
    cause: Cause
    share: float
    figure: str
    gain: float

    def phrase(self) -> Phrase:
        return Phrase(
            "advice",
            (
                self.symbol,
                f"{100 * self.relative:.2g}",
                phrase_of(self.cause),
                f"{100 * self.share:.0f}",
                Phrase(f"figure {self.figure}"),
                f"{100 * self.relative * self.gain:.2g}",
            ),
        )


def _sort(symbol: Symbol) -> str:
    """What readings are compared with for their size."""
    return symbol.kind[0] if symbol.scope == "motion" else symbol.measure


def advise(
    what: Plan, name: str, tools: Tools, readings: Sequence[Reading], predicted: Mapping[Symbol, Uncertainty]
) -> Advice | None:
    """Look for the worst reading and the remedy; None where nothing is uncertain.

    The remedy is found by predicting again with each of the three figures drawn twice as large.
    """
    largest: dict[str, float] = {}
    for r in readings:
        largest[_sort(r.symbol)] = max(largest.get(_sort(r.symbol), 0.0), abs(r.value))
    worst: tuple[float, Symbol] | None = None
    for r in readings:
        expected = predicted.get(r.symbol)
        if expected is None or not 0.0 < expected.deviation < math.inf:
            continue
        if abs(r.value) < max(SMALL * largest[_sort(r.symbol)], expected.deviation):
            continue  # too small, or no value but noise, such as velocities at rest
        part = expected.deviation / abs(r.value)
        if worst is None or part > worst[0]:
            worst = part, r.symbol
    if worst is None:
        return None
    relative, symbol = worst
    gains = {}
    for figure in ("length", "velocity", "acceleration"):
        scales: Scales = replace(what.scales, **{figure: getattr(what.scales, figure) / 2})
        again = predict(replace(what, scales=scales), name, tools, together=False)
        gains[figure] = again[symbol].deviation / predicted[symbol].deviation if symbol in again else math.inf
    best = min(gains, key=gains.__getitem__)
    expected = predicted[symbol]
    return Advice(symbol, relative, expected.cause, expected.share, best, gains[best])
