"""Points and verdicts: what is told of judged values, a person's points by a scheme, a class's slips by quantity."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any, ClassVar

from graphkin.checking.answers import Answers, Cell
from graphkin.checking.report import Known
from graphkin.checking.slip_likelihood import Judged
from graphkin.errors import CallError, Problem
from graphkin.files import Json
from graphkin.plane import added_up
from graphkin.scene.asked import spelling_of
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol, Value
from graphkin.words import Phrase, listed, say

FULL = ("right", "within drafting accuracy", "right from own values")
PARTS = ("equations", "drawing", "values")
COUNTED = (*FULL, "wrong", "missing", "not readable")
NAMED = 0.005
"""Of the value of a slip: a stated value that lies farther off is said to."""
Person = tuple[Answers, tuple[Judged, ...]]


@dataclass(frozen=True, repr=False)
class JudgedValue(Known):
    """A stated value with its verdict, in the file's units.

    exact : the value for comparison: signed where it has a sense, a complex number against two components, else the
        size of the vector
    deviation : the relative deviation; None where the exact value is 0
    bound : the error of a pencil drawing
    looks_like : the slip that explains a wrong value, in words; "" where none is known
    follows_from : earlier wrong values of the same person from which it follows
    """

    values: ClassVar = ("printed", "exact")
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
        )

    def _words(self) -> tuple[str, ...]:
        return self.verdict, self.looks_like


# points, and what a class did


Scheme = Mapping[str | Symbol, float]
"""Points for each part that is marked by hand, for all "values" together, and for single ones."""


def scheme_of(scene: Mechanism, given: Mapping[str, float] | None) -> Scheme | None:
    """The scheme of a call, or else of the scene (``[grading]``); None without a scheme.

    Raises CallError for a name that is neither a part nor a quantity of the scene, and for points below 0.
    """
    weights = given if given is not None else scene.question.grading
    if not isinstance(weights, Mapping):
        raise CallError.of("grading", "found value", "give points by parts and symbols drawing 30",
                           value=f'{weights!r:.60}')
    if not weights:
        return None
    spelling = spelling_of(scene)
    scheme: dict[str | Symbol, float] = {}
    problems = []
    for name, weight in weights.items():
        symbol = spelling.symbol(str(name))
        if isinstance(weight, bool) or not isinstance(weight, Real) or not 0 <= weight <= 1e6:
            problems.append(Problem(f"grading {name}", "found value", "give points from 0 to a million",
                                    value=f"{weight!r:.40}"))
        elif name in PARTS:
            scheme[str(name)] = float(weight)
        elif symbol is not None:
            scheme[symbol] = float(weight)
        else:
            problems.append(Problem(f"grading {name}", "is no part and no quantity of the", "or a symbol such as v_d",
                                    names=listed([*PARTS])))
    if problems:
        raise CallError(*problems)
    return scheme


def people_of(people: Sequence[Person], scheme: Scheme | None, language: str) -> Iterator[dict[str, Any]]:
    """For each person: the verdicts counted, the main slip, and with a scheme the points.

    The main slip is the first: values that follow from it are no slips.
    """
    for who, judged in people:
        slip = next((j.looks_like for j in judged if j.verdict == "wrong" and j.looks_like is not None), None)
        row: dict[str, Json] = {"person": who.person}
        row |= {k: v for k, v in (("id", who.id), ("variant", who.variant), ("at", who.at)) if v not in ("", None)}
        row |= _counted(verdicts_of(who, judged).values())
        if slip is not None:
            row["slip"] = say(slip, language)
        if scheme is not None:
            row |= _points_of(who, judged, scheme)
        yield row


def _points_of(who: Answers, judged: Sequence[Judged], scheme: Scheme) -> dict[str, Json]:
    """Points by part, their sum, and the greatest possible sum; a part without a mark yet is None and not counted."""
    alike = sum(symbol not in scheme for symbol in who.cells)  # these share what is given for all values

    def worth(symbol: Symbol) -> float:
        return scheme[symbol] if symbol in scheme else scheme.get("values", 0.0) / alike

    values = added_up(worth(j.printed.symbol) for j in judged if j.verdict in FULL)
    most = added_up(map(worth, who.cells))
    points: dict[str, float | None] = {"values": values}
    total = values
    for part in ("equations", "drawing"):
        if part in scheme:
            mark = who.marks.get(part)
            points[part] = None if mark is None else min(max(mark, 0.0), scheme[part])
            total += points[part] or 0.0
            most += 0.0 if mark is None else scheme[part]
    return {"points": {k: None if v is None else round(v, 4) for k, v in points.items()},
            "total": round(total, 4), "of": round(most, 4)}


def verdicts_of(who: Answers, judged: Sequence[Judged]) -> dict[Symbol, str]:
    """The verdict on each cell; a cell without a value is "missing" or "not readable"."""
    unread = {s: "missing" if cell is None else "not readable" for s, cell in who.cells.items()}
    return unread | {j.printed.symbol: j.verdict for j in judged}


def _counted(verdicts: Iterable[str]) -> dict[str, Json]:
    """The count of each verdict."""
    counts = Counter(verdicts)
    return {verdict: counts[verdict] for verdict in COUNTED}


def quantities_of(people: Sequence[Person], language: str) -> Iterator[dict[str, Json]]:
    """For each quantity: the verdicts of the class counted, and the commonest slip with its count."""
    verdicts = [verdicts_of(who, judged) for who, judged in people]
    for symbol in dict.fromkeys(symbol for values in verdicts for symbol in values):
        values = [j for _, judged in people for j in judged if j.printed.symbol == symbol]
        slips: Counter[Phrase] = Counter(j.looks_like for j in values if j.verdict == "wrong" and j.looks_like)
        row: dict[str, Json] = {"symbol": str(symbol), **_counted(of[symbol] for of in verdicts if symbol in of)}
        if slips:
            phrase, made = slips.most_common(1)[0]
            row |= {"commonest_slip": say(phrase, language), "made_by": made}
        yield row


Row = dict[str, Json]
"""A value as JSON: what was written, what is exact, the verdict, and why."""


def rows_of(scene: Mechanism, who: Answers, judged: Sequence[Judged], language: str) -> Iterator[Row]:
    """The rows of one person, answered or not."""
    lead: Row = {k: v for k, v in (("person", who.person), ("id", who.id), ("variant", who.variant)) if v}
    lead |= {"at": who.at} if who.at is not None else {}
    values = {value.printed.symbol: _value(scene, value, language) for value in judged}
    for symbol, cell in who.cells.items():
        yield lead | (values[symbol] if symbol in values else _unread(scene, symbol, cell, language))


def _unread(scene: Mechanism, symbol: Symbol, cell: Cell, language: str) -> Row:
    text, why = cell if isinstance(cell, tuple) else ("", None)
    verdict, reason = ("missing", "no answer") if why is None else ("not readable", say(why, language))
    return {
        "symbol": str(symbol), "written": text, "printed": None, "exact": None, "unit": symbol.unit(scene.units).text,
        "deviation_pct": None, "verdict": verdict, "why": reason,
    }


def _value(scene: Mechanism, judged: Judged, language: str) -> Row:
    value = JudgedValue.of(scene, judged, language)
    row: Row = {
        "symbol": str(value.symbol), "written": judged.printed.text, "printed": _plain(value.printed),
        "exact": _plain(value.exact), "unit": value.unit,
        "deviation_pct": None if value.deviation is None else 100 * value.deviation,
    }
    if value.deviation is None:
        row["why"] = "the exact value is zero"
    row["verdict"] = value.verdict if value.verdict != "not judged" else None
    row["bound"] = _plain(value.bound) if math.isfinite(value.bound) else None
    if value.verdict == "not judged":
        row["why"] = say(Phrase("nothing to judge by"), language)
    if value.looks_like:
        row["looks_like"] = value.looks_like
        if judged.apart is not None and judged.apart >= NAMED:
            row["looks_like_off_pct"] = float(f"{100.0 * judged.apart:.1g}")
    if judged.gap is not None:
        row["loop_gap"] = {"loop": judged.gap[0], "gap": _plain(judged.gap[1] / scene.units.metres)}
    if value.follows_from:
        row["follows_from"] = [str(s) for s in value.follows_from]
    return row


def _plain(value: Value) -> float | list[float]:
    """A number, or the components of a vector, 0 for a component that cancels."""
    if isinstance(value, complex):
        parts = (v if abs(v) > 1e-12 * abs(value) else 0.0 for v in (value.real, value.imag))
        return [float(f"{v:.12g}") + 0.0 for v in parts]
    return float(f"{value:.12g}") + 0.0
