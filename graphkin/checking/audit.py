"""Judging stated values: right, within drafting accuracy, or wrong with its likeliest slip.

The slip of a wrong value is the likeliest of the known slips by Bayes' rule: its frequency times the likelihood of the
stated digits, as a number computed (to its last digit) or drawn (with the predicted deviation).  No slip is named where
none fits much better than chance.

Whole tables of positions are judged by their digits at the speed of the solver, before a position is drawn.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from graphkin.checking.loop_gaps import loop_gaps
from graphkin.checking.slip_likelihood import (
    CHANCE,
    COMPUTED,
    NEVER,
    Judged,
    Suspect,
    Suspects,
    Verdict,
    clearest,
    comparable,
    transcription_errors,
)
from graphkin.checking.slips import CANCELLING, NOTHING, Evidence
from graphkin.scene.symbol import Line, PointRef, Printed, Symbol, Value
from graphkin.solver import Motion, listed_points
from graphkin.solver.algebra.pose import Array
from graphkin.solver.forces import forces_of, senses_along, value_of
from graphkin.words import Phrase, listed

RIGHT_SHARE = 0.7  # drawn values that are right but for drafting errors
SURER = 10.0  # so much likelier must a slip be than drafting errors, to call a value in their reach wrong
DIGITS = 5  # fewer digits than this tell no slip from an error of drafting
FAR, FEW_DIGITS = 0.1, 3  # but so far off, to this many digits, they do
COMPUTED_SHARE = 1e-4  # a computed value may be off by so much of itself, for inputs that were rounded
COPIED = 1e-3  # of itself: so near lies a value that is copied from another problem of a set
INPUTS = 1e-3  # of itself: what lies nearer shows coarser inputs, no slip of the pen and no other row
LEAST_TURN = math.radians(1.5)  # directions are read off with a protractor
TELLING = 4  # digits from which a number can be told to be another
MOST_PREDICTED = 72  # positions of a table that are drawn, to see what a pencil keeps within; in others the nearest
MOST_EXPLAINED = 3  # rows of which the drawing is asked what their wrong values look like


def with_gaps(case: Evidence, judged: Sequence[Judged]) -> tuple[Judged, ...]:
    """The verdicts, with the gaps of loops for wrong values."""
    wrong = {j.printed.symbol for j in judged if j.verdict == "wrong"}
    gaps = loop_gaps(case.sheet, {j.printed.symbol: j.printed.value for j in judged})
    return tuple(replace(j, gap=gaps.get(j.printed.symbol)) if j.printed.symbol in wrong else j for j in judged)


def judge(case: Evidence, stated: Sequence[Printed]) -> tuple[Judged, ...]:
    """Judge the values of one person."""
    first = [_judged(case, p) for p in stated]
    wrong = [j.printed.symbol for j in first if j.verdict == "wrong"]
    values = {p.symbol: p.value for p in stated}
    return tuple(
        explained(case, j, values, wrong) if j.verdict == "wrong" and j.looks_like is None else j for j in first
    )


def _judged(case: Evidence, printed: Printed) -> Judged:
    symbol = printed.symbol
    held = min(map(case.held, symbol.both), key=lambda h: abs(printed.value - comparable(printed, h.right, h.line)))
    judged = Judged(printed, comparable(printed, held.right, held.line), bound=held.bound, line=held.line)
    deviation, size, bound = abs(judged.off), abs(judged.exact), judged.bound
    turned = _turned(case, judged, held.right)
    nothing = NOTHING * held.largest if judged.exact == 0 and symbol.scope in CANCELLING else 0.0
    if deviation <= printed.rounding + max(1e-9 * size, nothing):
        return turned or judged
    if math.isinf(bound):
        fits = [s for s, _ in _weighed(case, judged) if not s.copied and judged.shows(s)]
        if printed.sure_digits < DIGITS or not fits or deviation <= printed.coarse + COMPUTED * size:
            return replace(judged, verdict="not judged")
        return replace(judged, verdict="wrong", looks_like=max(fits, key=lambda s: s.share).phrase)
    if deviation > bound + printed.coarse:
        return replace(judged, verdict="wrong")
    if turned:
        return turned
    far = printed.digits >= FEW_DIGITS and deviation > FAR * size
    if far or (printed.sure_digits >= DIGITS and deviation > NEVER * size):
        best = max(_weighed(case, judged), key=lambda w: w[1], default=None)
        if best and best[1] > SURER * RIGHT_SHARE * judged.by_errors() and judged.shows(best[0]):
            return replace(judged, verdict="wrong", looks_like=best[0].phrase)
    return replace(judged, verdict="within drafting accuracy")


def _turned(case: Evidence, judged: Judged, right: Value) -> Judged | None:
    """A value of the right size and a wrong stated direction or line, with its slip; None for others."""
    printed = judged.printed
    if not right or printed.symbol.measure.is_angle:
        return None
    true = cmath.phase(complex(right))
    drawn = judged.bound / abs(right) if math.isfinite(judged.bound) else math.pi
    reach = max(LEAST_TURN, min(drawn, math.pi / 6))
    way = printed.way
    directions = [(way.angle, reach + way.room * (1 + 1e-9), way.either)]
    directions += [(_angle_of(case, line), reach, not line.directed) for line in way.lines]
    for angle, room, either in directions:
        if angle is None or _near(true - angle, room, either):
            continue
        slips = (("slip turned back", math.pi), ("slip mirrored", -2 * true), ("slip mirrored", math.pi - 2 * true),
                 ("slip square", math.pi / 2), ("slip square", -math.pi / 2))
        key = next((key for key, turn in slips if _near(true + turn - angle, room, either)), "slip direction")
        deviation = math.degrees(math.remainder(angle - true, math.pi if either else math.tau))
        return replace(judged, verdict="wrong", looks_like=Phrase(key, angle=f"{deviation:+.0f}"))
    return None


def _near(deviation: float, room: float, either: bool) -> bool:
    return abs(math.remainder(deviation, math.pi if either else math.tau)) <= room


def _angle_of(case: Evidence, line: Line) -> float | None:
    """The angle of a line (rad), None where its points are not drawn."""
    sheet = case.sheet
    if not line.two:
        guide = sheet.scene.slide_on(line.one)
        return None if guide is None else cmath.phase(guide.along(sheet.poses) * (1j if line.square else 1.0))
    first, second = (sheet.points.get(PointRef(name)) for name in (line.one, line.two))
    if first is None or second is None or first == second:
        return None
    return cmath.phase((second - first) * (1j if line.square else 1.0))


def _weighed(case: Evidence, judged: Judged) -> Iterator[tuple[Suspect, float]]:
    """Every explanation that fits, with its weight."""
    yield from judged.weighed(case.suspects(judged.printed.symbol))
    yield from judged.copied()


def explained(
    case: Evidence, judged: Judged, answers: Mapping[Symbol, Value], wrong: Iterable[Symbol], drawn: bool = True
) -> Judged:
    """A wrong value with its slip; a value that follows from the person's own earlier values is judged so.

    ``drawn`` tells whether it may have been drawn badly, which a computed value was not.
    """
    symbol = judged.printed.symbol
    judged = replace(judged, line=case.held(symbol).line)
    chance = CHANCE / max(abs(judged.printed.value), abs(judged.exact), judged.printed.step)
    others = [s for s in wrong if s != symbol]
    follows = _following(case, judged, answers, others, chance) if not _copied(case, answers, symbol, others) else ()
    suspects = [*_weighed(case, judged), *follows]
    best, deviation = clearest(suspects, chance), None
    if best is None and drawn:
        every = Suspects((*case.suspects(symbol).all, *(s for s, _ in suspects if s.follows_from)))
        best = judged.drawn_badly(every)
        if best is not None:
            meant = comparable(judged.printed, best.value, judged.line)
            deviation = abs(judged.printed.value - meant) / abs(meant)
    if best is None:
        return judged
    verdict: Verdict = "right from own values" if best.follows_from else "wrong"
    return replace(judged, verdict=verdict, looks_like=best.phrase, follows_from=best.follows_from, apart=deviation)


def _copied(case: Evidence, answers: Mapping[Symbol, Value], symbol: Symbol, others: Iterable[Symbol]) -> bool:
    """Whether a value and another wrong one are the answers to the same other problem of a set."""

    def problems(of: Symbol) -> set[str]:
        size = abs(answers[of])
        return {name for name, value in case.variants(of) if abs(abs(value) - size) <= COPIED * size}

    there = problems(symbol)
    return any(there & problems(other) for other in others)


def _following(
    case: Evidence, judged: Judged, answers: Mapping[Symbol, Value], others: Sequence[Symbol], chance: float
) -> Iterator[tuple[Suspect, float]]:
    """The explanations of a value by earlier wrong values, drawn on from each that moves it more than drafting does."""
    symbol = judged.printed.symbol
    earlier = [s for s in others if case.before(s, symbol)]

    def moved(value: Value) -> bool:
        return abs(comparable(judged.printed, value, judged.line) - judged.exact) > judged.bound / 3

    def causes() -> Iterator[tuple[Value, tuple[Symbol, ...]]]:
        for value in filter(moved, case.following(answers, symbol) if earlier else ()):
            yield value, tuple(s for s in earlier if any(map(moved, case.following({s: answers[s]}, symbol))))
        by_rates = case.by_rates(answers, symbol)
        if by_rates is not None and not isinstance(judged.printed.value, complex) and moved(by_rates[0]):
            yield by_rates[0], tuple(s for s in by_rates[1] if s in others)

    for value, names in causes():
        follows = Suspect(Phrase("slip follows", name=listed([*map(str, names)])), value, 0.5, follows_from=names)
        for suspect, weight in judged.weighed(Suspects((follows,))) if names else ():
            if weight > chance:
                yield suspect, weight


# tables, by their digits

Row = tuple[Sequence[Printed], str]
"""What is stated of one position, and how it was found: by "drawing" or by "computation"."""
Exact = Callable[[int, Printed], Value]
"""The exact value that a stated one is held against, by the number of the position in a motion."""


def judge_table(
    motion: Motion, rows: Sequence[Row], of_turn: Mapping[Symbol, float], names: Sequence[str],
    case: Callable[[int], Evidence],
) -> list[tuple[Judged, ...]]:
    """Judge a table by its digits; wrong values are explained, and some positions are drawn to find a pencil's errors.

    Parameters
    ----------
    motion : the exact motion, a position for each row
    of_turn : the quantities of the whole turn, which are the same at all positions
    names : of the positions
    case : the evidence at the position of a row
    """
    symbols = list(dict.fromkeys(p.symbol for values, _ in rows for p in values))
    errors = computing_errors(motion, [s for s in symbols if s not in of_turn])
    exact, signed = _exact_rows(motion, symbols, of_turn, errors), _signed_columns(motion, rows)
    made: list[tuple[Judged, ...]] = []
    looked_into = 0
    for row, (values, by) in enumerate(rows):
        judged = []
        for stated in values:
            by_line = by == "computation" and stated.symbol in signed and stated.way.angle is None
            printed = replace(stated, signed=True) if by_line else stated
            cell, error = Judged(printed, exact(row, printed)), errors.get(printed.symbol)
            cell = _by_digits(cell, by, 0.0 if error is None or by == "drawing" else float(error[row]))
            if cell.verdict != "right" and by == "drawing":
                cell = _by_digits(cell, by, case(_nearest(row, len(rows))).held(printed.symbol).bound)
            judged.append(_explained_by_digits(cell, exact, row, symbols, names) if cell.verdict == "wrong" else cell)
        if any(_unexplained(cell) for cell in judged) and looked_into < MOST_EXPLAINED:
            looked_into += 1
            judged = _looked_into(case(row), judged, by)
        made.append(tuple(judged))
    return made


def _unexplained(judged: Judged) -> bool:
    return judged.verdict == "wrong" and not judged.looks_like and not _by_inputs(judged)


def _by_inputs(judged: Judged) -> bool:
    """Whether inputs that were rounded explain a wrong value."""
    return abs(judged.off) <= INPUTS * abs(judged.exact)


def _looked_into(case: Evidence, judged: Sequence[Judged], by: str) -> list[Judged]:
    """The values of a row, wrong ones with their slips at the row's position."""
    if by == "drawing":  # by what a pencil keeps within here, not near by
        judged = [
            j if j.verdict == "right" or j.looks_like else _by_digits(j, by, case.held(j.printed.symbol).bound)
            for j in judged
        ]
    values = {j.printed.symbol: j.printed.value for j in judged}
    wrong = [j.printed.symbol for j in judged if j.verdict == "wrong"]
    return [explained(case, j, values, wrong, by == "drawing") if _unexplained(j) else j for j in judged]


def _nearest(row: int, count: int) -> int:
    """The row of a long table whose drawing gives a pencil's errors for a row: some rows are drawn."""
    step = max(1, math.ceil(count / MOST_PREDICTED))
    return min(count - 1, step * round(row / step))


def _signed_columns(motion: Motion, rows: Sequence[Row]) -> set[Symbol]:
    """The vectors whose computed values are signed, as a program prints them: vectors along a guide, unless their
    column has no sign although the motion goes both ways: then they are sizes."""
    places: dict[Symbol, list[int]] = {}
    for row, (values, by) in enumerate(rows):
        for printed in values if by == "computation" else ():
            if printed.symbol.is_vector and len(printed.texts) == 1:
                places.setdefault(printed.symbol, []).append(row)
    signed = set()
    for symbol, numbers in places.items():
        lines = senses_along(motion, symbol)
        if lines is not None:
            along = (value_of(motion, symbol) * lines.conjugate()).real[numbers]
            if not (along.min() < 0.0 < along.max()):
                signed.add(symbol)
    return signed


def _exact_rows(
    motion: Motion, symbols: Sequence[Symbol], of_turn: Mapping[Symbol, float], errors: Mapping[Symbol, Array]
) -> Exact:
    """The function of exact values of a table; a value that is rounding alone is 0."""
    columns, lines = dict[Symbol, list[list[Value]]](), dict[Symbol, list[complex | None]]()
    for symbol in symbols:
        if symbol not in of_turn:
            column, nothing = [value_of(motion, each) for each in symbol.both], np.zeros(len(motion))
            if symbol in errors:
                nothing = NOTHING / COMPUTED_SHARE * errors[symbol]
            elif symbol.scope == "force":
                nothing = np.nan_to_num(forces_of(motion).bound[symbol.measure.length])
            columns[symbol] = np.where(np.abs(column) <= nothing, 0.0, column).T.tolist()
            senses = senses_along(motion, symbol)
            lines[symbol] = [None] * len(motion) if senses is None else senses.tolist()

    def exact(row: int, printed: Printed) -> Value:
        symbol = printed.symbol
        if symbol in of_turn:
            return of_turn[symbol]
        stated = (comparable(printed, value, lines[symbol][row]) for value in columns[symbol][row])
        return min(stated, key=lambda value: abs(printed.value - value))

    return exact


def computing_errors(motion: Motion, symbols: Sequence[Symbol]) -> dict[Symbol, Array]:
    """The error of a computation that continues with rounded numbers, for quantities of the motion: shape (n,), SI.

    A difference keeps the errors of its terms.  So `COMPUTED_SHARE` is taken of the largest velocity (acceleration) of
    any point in the same position, for the rate of a bar with that velocity at one end, for a place of the size of the
    mechanism, for an angle of 1 rad; a rate in r/min is taken to four figures in rad/s, which counts once in velocities
    and twice in accelerations.  Other quantities may be off by that share of themselves.
    """
    motions = [motion.point(ref.point, link) for ref, link in listed_points(motion.scene, motion.slides)]
    none = np.zeros(len(motion))
    speed = np.max([none, *(np.abs(p.v) + none for p in motions)], axis=0)
    acceleration = np.max([none, *(np.abs(p.a) + none for p in motions)], axis=0)
    reach = np.max([none, *(np.abs(p.z) + none for p in motions)], axis=0)
    in_rpm = (d.rate for d in motion.scene.drivers if d.turns and d.rpm and d.rate)
    rate = max((abs(float(f"{given:.4g}") / given - 1.0) for given in in_rpm), default=0.0)
    bounds = {}
    for symbol in (s for s in symbols if s.scope in ("motion", "position")):
        order, share = symbol.measure.order, COMPUTED_SHARE + symbol.measure.order * rate
        whole = (reach, speed, acceleration)[order]
        if symbol.measure.angle:
            arm = _reach_of(motion, symbol.link)
            whole = none + 1.0 if order == 0 else whole / arm if arm else none
        bounds[symbol] = share * np.maximum(whole, np.abs(value_of(motion, symbol)))
    return bounds


def _reach_of(motion: Motion, link: str) -> float:
    """The greatest distance between two points of a link, or of a link on which it slides (m); 0 for a single point."""
    turning = {link, *(slide.b for slide in motion.slides if slide.a == link)} - {motion.scene.frame.name}
    bars = [motion.scene.by_name[name].points.values() for name in turning if name in motion.scene.by_name]
    return max((abs(first - second) for places in bars for first, second in combinations(places, 2)), default=0.0)


def _by_digits(judged: Judged, by: str, bound: float) -> Judged:
    """A stated value judged by its digits: a computed value may be off by ``bound`` and by `COMPUTED_SHARE` of itself,
    for rounded intermediate numbers; a drawn value by a pencil's error (``bound``, SI; infinite where nothing can be
    judged)."""
    deviation, rounding, size = abs(judged.off), judged.printed.rounding, abs(judged.exact)
    if by == "computation":
        near = deviation <= rounding + max(bound, COMPUTED_SHARE * size)
        return replace(judged, verdict="right" if near else "wrong")
    verdict: Verdict = "within drafting accuracy" if deviation <= bound + judged.printed.coarse else "wrong"
    if deviation <= rounding + 1e-9 * size:
        verdict = "right"
    elif math.isinf(bound):
        verdict = "not judged"
    return replace(judged, verdict=verdict, bound=bound)


def _explained_by_digits(
    judged: Judged, exact: Exact, row: int, symbols: Sequence[Symbol], names: Sequence[str]
) -> Judged:
    """A wrong value of a table with the slip that its digits show: the right value with a slip of the pen or a wrong
    sign, the value of another row or of another column.

    Parameters
    ----------
    symbols, names : of the columns and rows of the table
    """
    printed, right = judged.printed, judged.exact
    if printed.digits < TELLING or isinstance(printed.value, complex) or _by_inputs(judged):
        return judged

    def ways() -> Iterator[tuple[Phrase, Value]]:
        yield Phrase("slip sign"), -right
        powers = (1, 2, 3) if printed.symbol.measure.name not in ("angle", "number") else ()
        for factor in (sign for power in powers for sign in (10.0**power, 0.1**power)):
            yield Phrase("slip factor", factor=f"{factor:g}"), right * factor
        for text, _, value in transcription_errors(printed):
            if abs(value - right) <= printed.rounding + 0.1 * COMPUTED_SHARE * abs(right):
                yield Phrase("slip pen", name=text), printed.value
        for k in sorted(range(len(names)), key=lambda k: abs(k - row))[1:]:
            yield Phrase("slip position", name=names[k]), exact(k, printed)
        for symbol in symbols:
            if symbol != printed.symbol:
                yield Phrase("slip other", name=str(symbol)), exact(row, replace(printed, symbol=symbol))

    near = printed.rounding + COMPUTED_SHARE * abs(printed.value) / 10
    phrase = next((phrase for phrase, value in ways() if abs(printed.value - value) <= near), None)
    return replace(judged, looks_like=phrase)
