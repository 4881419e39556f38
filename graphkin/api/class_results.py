"""What an audit says, of each value of a person as rows of JSON, and of a class: points by a scheme, a slip for each
student, what went wrong with each quantity."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from numbers import Real

from graphkin.api.answers import Answers, Unread
from graphkin.checking.audit import Judged
from graphkin.errors import CallError, Problem
from graphkin.files import Json
from graphkin.plane import added_up
from graphkin.scene.model import Mechanism
from graphkin.scene.spelling import Spelling
from graphkin.scene.symbol import Symbol, Value
from graphkin.words import Phrase, say

__all__ = ["Scheme", "people_of", "quantities_of", "rows_of", "scheme_of"]

FULL = ("right", "within drafting accuracy", "right from own values")
PARTS = ("equations", "drawing", "values")
COUNTED = (*FULL, "wrong", "missing", "not readable")
Person = tuple[Answers, tuple[Judged, ...]]


@dataclass(frozen=True)
class Scheme:
    """How many points there are: for each part that is marked by hand, for all values together, and for single ones."""

    parts: Mapping[str, float]
    symbols: Mapping[Symbol, float]

    def of(self, symbol: Symbol, asked: Sequence[Symbol]) -> float:
        """Points for one of the values asked for."""
        if symbol in self.symbols:
            return self.symbols[symbol]
        alike = [s for s in asked if s not in self.symbols]
        return self.parts.get("values", 0.0) / len(alike) if symbol in alike else 0.0


def scheme_of(scene: Mechanism, given: Mapping[str, float] | None) -> Scheme | None:
    """The scheme of a call, or else that of the scene (``[grading]``); None where there is none.

    Raises CallError for a name that is neither a part nor a quantity of the scene, and for points below 0.
    """
    weights = given if given is not None else scene.grading
    if not isinstance(weights, Mapping):
        wanted = Phrase("give points by parts and symbols drawing 30")
        raise CallError(Problem("grading", Phrase("found value", value=f'{weights!r:.60}'), wanted))
    if not weights:
        return None
    spelling = Spelling.of(scene)
    parts: dict[str, float] = {}
    symbols: dict[Symbol, float] = {}
    problems = []
    for name, weight in weights.items():
        symbol = spelling.symbol(str(name))
        if isinstance(weight, bool) or not isinstance(weight, Real) or not 0 <= weight < 1e6:
            problems.append(
                Problem(
                    f"grading {name}", Phrase("found value", value=f"{weight!r:.40}"), Phrase("give points 0 or more")
                )
            )
        elif name in PARTS:
            parts[name] = float(weight)
        elif symbol is not None:
            symbols[symbol] = float(weight)
        else:
            problems.append(Problem(f"grading {name}", Phrase("is no part and no quantity of the"),
                                    Phrase("or a symbol such as v_d", names=', '.join(PARTS))))  # fmt: skip
    if problems:
        raise CallError(*problems)
    return Scheme(parts, symbols)


def people_of(people: Sequence[Person], scheme: Scheme | None, language: str) -> Iterator[dict[str, Json]]:
    """For each person: the verdicts counted, the slip to talk about, and the points where there is a scheme.

    The slip is the first one made: values that only follow from it are no slips.
    """
    for who, judged in people:
        asked = [*(j.printed.symbol for j in judged), *(u.symbol for u in who.unread)]
        counts = Counter(_verdicts(who, judged))
        slip = next((j.looks_like for j in judged if j.verdict == "wrong" and j.looks_like is not None), None)
        row: dict[str, Json] = {"person": who.person}
        row |= {k: v for k, v in (("id", who.id), ("variant", who.variant), ("at", who.at)) if v not in ("", None)}
        row |= {verdict: counts[verdict] for verdict in COUNTED}
        if slip is not None:
            row["slip"] = say(slip, language)
        if scheme is not None:
            row |= _points(who, judged, asked, scheme)
        yield row


def _points(who: Answers, judged: Sequence[Judged], asked: Sequence[Symbol], scheme: Scheme) -> dict[str, Json]:
    """Points by part, their sum, and of how many; a part that nobody has marked yet is None and not counted."""
    good = [j.printed.symbol for j in judged if j.verdict in FULL]
    values = added_up(scheme.of(s, asked) for s in good)
    most = added_up(scheme.of(s, asked) for s in asked)
    points: dict[str, float | None] = {"values": values}
    total = values
    for part in ("equations", "drawing"):
        if part in scheme.parts:
            mark = who.marks.get(part)
            points[part] = own = None if mark is None else min(max(mark, 0.0), scheme.parts[part])
            if own is not None:
                total += own
                most += scheme.parts[part]
    return {"points": {k: None if v is None else round(v, 4) for k, v in points.items()},
            "total": round(total, 4), "of": round(most, 4)}  # fmt: skip


def _verdicts(who: Answers, judged: Sequence[Judged]) -> Iterator[str]:
    yield from (j.verdict for j in judged)
    yield from ("not readable" if u.why else "missing" for u in who.unread)


def quantities_of(people: Sequence[Person], language: str) -> Iterator[dict[str, Json]]:
    """For each quantity: the verdicts of the class counted, and the commonest slip with how many made it."""
    symbols: dict[Symbol, None] = {}
    for who, judged in people:
        symbols |= dict.fromkeys([*(j.printed.symbol for j in judged), *(u.symbol for u in who.unread)])
    for symbol in symbols:
        own = [j for _, judged in people for j in judged if j.printed.symbol == symbol]
        counts: Counter[str] = Counter(j.verdict for j in own)
        unread = [u for who, _ in people for u in who.unread if u.symbol == symbol]
        counts["not readable"] = sum(bool(u.why) for u in unread)
        counts["missing"] = len(unread) - counts["not readable"]
        slips: Counter[Phrase] = Counter(j.looks_like for j in own if j.verdict == "wrong" and j.looks_like)
        row: dict[str, Json] = {"symbol": str(symbol), **{verdict: counts[verdict] for verdict in COUNTED}}
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
    rows = [(one.printed.symbol, _value(scene, one, language)) for one in judged]
    rows += [(cell.symbol, _unread(scene, cell, language)) for cell in who.unread]
    place = {symbol: i for i, symbol in enumerate(who.order)}
    for _, row in sorted(rows, key=lambda row: place.get(row[0], 0)):
        yield lead | row


def _unread(scene: Mechanism, cell: Unread, language: str) -> Row:
    row: Row = {
        "symbol": str(cell.symbol), "written": cell.text, "printed": None, "exact": None,
        "unit": cell.symbol.unit(scene.units).text, "deviation_pct": None,
    }  # fmt: skip
    if cell.why:
        return row | {"verdict": "not readable", "why": say(cell.why, language)}
    return row | {"verdict": "missing", "why": "no answer"}


def _value(scene: Mechanism, judged: Judged, language: str) -> Row:
    symbol = judged.printed.symbol
    file_unit = symbol.unit(scene.units)

    def unit(value: Value) -> float | list[float]:
        if isinstance(value, complex):
            # what is left of a component that cancels is no value
            parts = (v if abs(v) > 1e-12 * abs(value) else 0.0 for v in (value.real, value.imag))
            return [_plain(file_unit.of(v)) for v in parts]
        return _plain(file_unit.of(value))

    row: Row = {
        "symbol": str(symbol), "written": judged.printed.text, "printed": unit(judged.printed.value),
        "exact": unit(judged.exact), "unit": file_unit.text,
    }  # fmt: skip
    row["deviation_pct"] = None if judged.deviation is None else 100 * judged.deviation
    if judged.deviation is None:
        row["why"] = "the exact value is zero"
    row["verdict"] = judged.verdict if judged.verdict != "not judged" else None
    row["bound"] = unit(judged.bound) if math.isfinite(judged.bound) else None
    if judged.verdict == "not judged":
        row["why"] = say(Phrase("nothing to judge by"), language)
    if judged.looks_like is not None:
        row["looks_like"] = say(judged.looks_like, language)
    if judged.gap is not None:
        row["loop_gap"] = {"loop": judged.gap[0], "gap": _plain(judged.gap[1] / scene.units.metres)}
    if judged.follows_from:
        row["follows_from"] = [str(s) for s in judged.follows_from]
    return row


def _plain(value: float) -> float:
    return float(f"{value:.12g}") + 0.0
