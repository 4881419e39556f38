"""What stated values are held against: the evidence of one position, and whole tables of positions at once, judged at
the speed of the solver: by their digits, before anything is drawn."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from graphkin.api.answers import Answers
from graphkin.api.arguments import At, driver_values, placed
from graphkin.api.checked import solved_here
from graphkin.checking.audit import COMPUTED_SHARE, Judged, deviation, difference, explained
from graphkin.checking.slip_likelihood import comparable, transcription_errors
from graphkin.checking.slips import NOTHING, Evidence, ValuesElsewhere
from graphkin.checking.uncertainty import predict
from graphkin.construction import plan
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import Mechanism
from graphkin.scene.printed import Printed
from graphkin.scene.symbol import Symbol, Value
from graphkin.solver import Motion, forces_of, listed_points, senses_along, value_of
from graphkin.solver.pose import Array
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.solver import Motion

__all__ = ["MOST_DRAWN", "evidence_at", "judged_table"]

POSITIONS = 72
MOST_DRAWN = 6  # rows of a table that are drawn each
MOST_PREDICTED = 4  # positions of a longer one that are
MOST_EXPLAINED = 3  # rows of which the drawing is asked what their wrong values look like


def judged_table(
    scene: Mechanism, table: Sequence[Answers], at: At, case: Callable[[float | str | None], Evidence]
) -> dict[int, tuple[Judged, ...]]:
    """Rows of a table: all positions solved at once, judged by their digits; only what is wrong is looked into, and of
    a table that was drawn some positions are drawn to see what a pencil keeps within."""
    from graphkin.solver import driver_range, exact_values, structure_of

    symbols = list(dict.fromkeys(p.symbol for who in table for p in who.values))
    reach = driver_range(structure_of(scene))
    key = scene.drivers[0].key
    places = [(driver_values(scene, at if who.at is None else who.at) or {}).get(key) for who in table]
    own = scene.drivers[0].values[0]
    motion = reach.motion(reach.offsets(np.array([own if place is None else place for place in places])))
    if not motion.ok.all():
        k = int(np.argmin(motion.ok))
        where = scene.unit_of(scene.drivers[0]).said(float(motion.values[k, 0]))
        status = str(motion.status[k])
        raise Unsolvable(
            status,
            Problem(
                Phrase("driver at", key=key, where=where),
                motion.said(k),
            ),
        )
    turning = [s for s in symbols if s.scope in ("turn", "cycle")]
    value = exact_values(solved_here(scene, None), turning)
    exact = exact_rows(motion, symbols, {s: float(value(s).real) for s in turning})
    signed = _signed_columns(table, motion)
    bounds = _Bounds(table, case)
    computed = any(who.by == "computation" for who in table)
    errors = computing_errors(motion, [s for s in symbols if s not in turning]) if computed else {}
    names = [_named(scene, who.at, motion.values[row, 0]) for row, who in enumerate(table)]
    made: dict[int, tuple[Judged, ...]] = {}
    looked_into = 0
    for row, who in enumerate(table):
        judged = []
        for stated in who.values:
            by_line = who.by == "computation" and stated.symbol in signed and stated.direction is None
            printed = replace(stated, signed=True) if by_line else stated
            right = exact(row, printed)
            error = errors.get(printed.symbol) if who.by == "computation" else None
            one = judged_by_digits(printed, right, who.by, 0.0 if error is None else float(error[row]))
            if one.verdict != "right" and who.by == "drawing":
                one = judged_by_digits(printed, right, who.by, bounds.bound(row, printed.symbol))
            if one.verdict == "wrong":
                one = explained_by_digits(one, exact, row, symbols, names)
            judged.append(one)
        if any(one.verdict == "wrong" and not one.looks_like for one in judged) and looked_into < MOST_EXPLAINED:
            looked_into += 1
            evidence, values = case(who.at), {p.symbol: p.value for p in who.values}
            if who.by == "drawing":  # by what a pencil keeps within here, not near by
                judged = [
                    j if j.verdict == "right" or j.looks_like
                    else judged_by_digits(j.printed, j.exact, who.by, evidence.held(j.printed.symbol).bound)
                    for j in judged
                ]  # fmt: skip
            wrong = [one.printed.symbol for one in judged if one.verdict == "wrong"]
            drawn = who.by == "drawing"
            judged = [
                explained(evidence, j, values, wrong, drawn) if j.verdict == "wrong" and not j.looks_like else j
                for j in judged
            ]
        made[id(who)] = tuple(judged)
    return made


def _signed_columns(table: Sequence[Answers], motion: Motion) -> set[Symbol]:
    """The vectors whose computed values are signed, as a program prints them: those along a guide, unless no sign
    stands in the column although the motion goes both ways, which tells that sizes are meant."""
    from graphkin.solver import senses_along, value_of

    rows: dict[Symbol, list[int]] = {}
    for row, who in enumerate(table):
        for printed in who.values:
            if who.by == "computation" and printed.symbol.is_vector and len(printed.texts) == 1:
                rows.setdefault(printed.symbol, []).append(row)
    signed = set()
    for symbol, own in rows.items():
        lines = senses_along(motion, symbol)
        if lines is not None:
            along = (value_of(motion, symbol) * lines.conjugate()).real[own]
            if not (along.min() < 0.0 < along.max()):
                signed.add(symbol)
    return signed


@dataclass
class _Bounds:
    """What a pencil keeps within at the rows of a long table: predicted at some of them, the nearest is taken."""

    table: Sequence[Answers]
    case: Callable[[float | str | None], Evidence]

    def bound(self, row: int, symbol: Symbol) -> float:
        step = max(1, math.ceil(len(self.table) / MOST_PREDICTED))
        near = min(len(self.table) - 1, step * round(row / step))
        return self.case(self.table[near].at).held(symbol).bound


def evidence_at(
    scene: Mechanism, asked: Sequence[Symbol], at: At, variants: ValuesElsewhere = lambda symbol: ()
) -> Evidence:
    """Everything that is known of a scene at one position.

    ``variants`` gives the values of the other problems of its set.
    """
    from graphkin.solver import as_drawn, exact_values

    scene, values = placed(scene, at)
    motion = solved_here(scene, values)
    structure = motion.structure
    what = plan(structure, values, [symbol for symbol in asked if symbol.scope != "cycle"])
    # everything is drawn, so that slips in what leads to the asked and beside it are found
    whole = plan(structure, values, ())
    drawn = what if set(what.elements) == set(whole.elements) else whole

    predicted = predict(what, "pencil", scene.sheet.tools)
    exact = exact_values(as_drawn(motion, what.structure), asked)
    return Evidence(drawn, exact, predicted, _elsewhere(scene, values), variants, motion)


def _elsewhere(scene: Mechanism, values: dict[str, float] | None) -> ValuesElsewhere:
    """Exact values at the positions of a table: steps of 5 degrees, from here and from 0."""
    from graphkin import solver

    @cache
    def motions() -> tuple[Motion, ...]:
        first = scene.drivers[0]
        if not first.turns:
            return ()
        from_zero = {**(values or {}), first.key: 0.0}
        return solver.solve(scene, values, POSITIONS), solver.solve(scene, from_zero, POSITIONS)

    def table(symbol: Symbol) -> list[tuple[str, complex | float]]:
        found: list[tuple[str, complex | float]] = []
        if symbol.scope in ("turn", "cycle") or symbol.kind == "arm":  # the lever has its arms at one position
            return found
        for motion in motions():
            for i, value in enumerate(solver.value_of(motion, symbol)):
                if motion.ok[i]:
                    driver, at = scene.drivers[0], float(motion.values[i, 0])
                    name = f"{driver.key} = {scene.unit_of(driver).said(at)}"
                    found.append((name, complex(value) if symbol.is_vector else float(value.real)))
        return found

    return table


def _named(scene: Mechanism, at: float | str | None, value: float) -> str:
    """How a row of a table is called: its position's name, or the driver's value."""
    driver = scene.drivers[0]
    return at if isinstance(at, str) else f"{driver.key} = {scene.unit_of(driver).said(float(value))}"


Exact = Callable[[int, Printed], Value]


def exact_rows(motion: Motion, symbols: Sequence[Symbol], of_turn: Mapping[Symbol, float]) -> Exact:
    """What gives the exact value that a stated one is held against, by the number of the position in a motion.

    Parameters
    ----------
    of_turn : the quantities of the whole turn, which are the same at all positions
    """
    largest = computing_errors(motion, symbols)
    columns = {}
    for s in symbols:
        if s not in of_turn:
            column = value_of(motion, s)
            nothing = NOTHING / COMPUTED_SHARE * largest[s] if s in largest else _rounding(motion, s)
            columns[s] = np.where(np.abs(column) <= nothing, 0.0, column).tolist()
    lines: dict[Symbol, Array | None] = {}

    def exact(row: int, printed: Printed) -> Value:
        symbol = printed.symbol
        if symbol in of_turn:
            return of_turn[symbol]
        value = columns[symbol][row]
        if symbol not in lines:
            lines[symbol] = senses_along(motion, symbol)
        line = lines[symbol]
        return comparable(printed, value, None if line is None else complex(line[row]))

    return exact


def _rounding(motion: Motion, symbol: Symbol) -> Array | float:
    """What rounding leaves of a force or a moment that is none (SI), shape (n,)."""
    return np.nan_to_num(forces_of(motion).bound[symbol.measure == "moment"]) if symbol.scope == "force" else 0.0


def computing_errors(motion: Motion, symbols: Sequence[Symbol]) -> dict[Symbol, Array]:
    """How far a computation may be off that goes on with rounded numbers, for quantities of the motion: shape (n,), SI.

    What cancels keeps the errors of what it is the difference of.  So `COMPUTED_SHARE` is taken of a velocity (an
    acceleration) as large as the largest of any point in the same position, of a rate of a bar with that at one of its
    ends, of a place as far as the mechanism reaches, of an angle of 1 rad; a rate in r/min is taken to four figures in
    rad/s, which shows once in velocities and twice in accelerations.  Others may be off by the share of themselves.
    """
    places = listed_points(motion.scene, motion.slides)
    motions = [motion.point(point, link) for point, link in places]
    none = np.zeros(len(motion))
    speed = np.max([none, *(np.abs(p.v) + none for p in motions)], axis=0)
    acceleration = np.max([none, *(np.abs(p.a) + none for p in motions)], axis=0)
    reach = np.max([none, *(np.abs(p.z) + none for p in motions)], axis=0)
    rate = max((_rounded_off(d.rate) for d in motion.scene.drivers if d.turns and d.rpm), default=0)
    first, second = COMPUTED_SHARE + rate, COMPUTED_SHARE + 2 * rate
    found = {}
    for symbol in symbols:
        arm = _reach_of(motion, symbol.link)
        errors = {
            "velocity": first * speed, "acceleration": second * acceleration, "length": COMPUTED_SHARE * reach,
            "angle": COMPUTED_SHARE + none, "angular velocity": first * speed / arm if arm else none,
            "angular acceleration": second * acceleration / arm if arm else none,
        }  # fmt: skip
        if symbol.scope in ("motion", "position") and symbol.measure in errors:
            own = {"velocity": first, "angular velocity": first, "acceleration": second, "angular acceleration": second}
            size = np.abs(value_of(motion, symbol))
            found[symbol] = np.maximum(errors[symbol.measure], own.get(symbol.measure, COMPUTED_SHARE) * size)
    return found


def _rounded_off(rate: float) -> float:
    """The part of a rate (rad/s) that is lost when it is written to four figures."""
    return abs(float(f"{rate:.4g}") / rate - 1.0) if rate else 0.0


def _reach_of(motion: Motion, link: str) -> float:
    """The distance of the two points of a link, or of one that it slides on, that are farthest from each other (m); 0
    where it has but one."""
    turning = {link, *(slide.b for slide in motion.slides if slide.a == link)} - {motion.scene.frame.name}
    bars = [motion.scene.by_name[name].points.values() for name in turning if name in motion.scene.by_name]
    return max((abs(one - other) for places in bars for one, other in combinations(places, 2)), default=0.0)


def judged_by_digits(printed: Printed, exact: Value, by: str, bound: float) -> Judged:
    """A stated value judged by its digits: computed ones may be off by ``bound`` too, and by `COMPUTED_SHARE` of
    themselves, for numbers that were rounded on the way; drawn ones by what a pencil keeps within (``bound``, SI;
    infinite where nothing can be judged)."""
    off = abs(difference(printed, exact))
    share = deviation(printed, exact)
    if by == "computation":
        near = off <= printed.rounding + max(bound, COMPUTED_SHARE * abs(exact))
        return Judged(printed, exact, share, "right" if near else "wrong", 0.0)
    if off <= printed.rounding + 1e-9 * abs(exact):
        return Judged(printed, exact, share, "right", bound)
    if math.isinf(bound):
        return Judged(printed, exact, share, "not judged", bound)
    near = off <= bound + printed.coarse
    return Judged(printed, exact, share, "within drafting accuracy" if near else "wrong", bound)


TELLING = 4  # digits from which a number can be told to be another


def explained_by_digits(
    judged: Judged, exact: Exact, row: int, symbols: Sequence[Symbol], names: Sequence[str]
) -> Judged:
    """A wrong value of a table with what its digits are: the right one with a slip of the pen or a sign, that of
    another row or of another column.

    Parameters
    ----------
    symbols, names : of the columns and rows of the table
    """
    printed = judged.printed
    if printed.digits < TELLING or isinstance(printed.value, complex):
        return judged
    ways = _ways(judged, exact, row, symbols, names)
    near = COMPUTED_SHARE * abs(printed.value) / 10
    phrase = next((phrase for phrase, value in ways if abs(printed.value - value) <= printed.rounding + near), None)
    return judged if phrase is None else replace(judged, looks_like=phrase)


def _ways(
    judged: Judged, exact: Exact, row: int, symbols: Sequence[Symbol], names: Sequence[str]
) -> Iterator[tuple[Phrase, Value]]:
    printed, right = judged.printed, judged.exact
    value: Value = -right
    yield Phrase("slip sign"), value
    for power in (1, 2, 3):
        for factor in (10.0**power, 0.1**power):
            yield Phrase("slip factor", (f"{factor:g}",)), right * factor
    for text, _, value in transcription_errors(printed):
        if abs(value - right) <= printed.rounding + 0.1 * COMPUTED_SHARE * abs(right):
            yield Phrase("slip pen", (text,)), printed.value
    others = sorted((k for k in range(len(names)) if k != row), key=lambda k: abs(k - row))
    for k in others:
        yield Phrase("slip position", (names[k],)), exact(k, printed)
    for symbol in symbols:
        if symbol != printed.symbol and (symbol.is_vector or not isinstance(printed.value, complex)):
            value = exact(row, replace(printed, symbol=symbol))
            yield Phrase("slip other", (str(symbol),)), value
