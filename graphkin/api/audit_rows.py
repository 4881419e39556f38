"""What an audit says of each value of a person, as rows of JSON."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from graphkin.api.answers import Answers, Unread
from graphkin.api.reading_rows import in_scene_units
from graphkin.checking.audit import Judged
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Value
from graphkin.words import Phrase, say

__all__ = ["Row", "rows_of"]

Row = dict[str, Json]
"""A value as JSON: what was written, what is exact, the verdict, and why."""


def rows_of(scene: Mechanism, who: Answers, judged: Sequence[Judged], language: str) -> Iterator[Row]:
    """The rows of one person, answered or not."""
    lead: Row = {k: v for k, v in (("person", who.person), ("id", who.id), ("variant", who.variant)) if v}
    lead |= {"at": who.at} if who.at is not None else {}
    rows = [(one.printed.symbol, _value(scene, one, language)) for one in judged]
    rows += [(cell.symbol, _unread(cell, language)) for cell in who.unread]
    place = {symbol: i for i, symbol in enumerate(who.order)}
    for _, row in sorted(rows, key=lambda row: place.get(row[0], 0)):
        yield lead | row


def _unread(cell: Unread, language: str) -> Row:
    row: Row = {"symbol": str(cell.symbol), "written": cell.text, "printed": None, "exact": None, "deviation_pct": None}
    if cell.why:
        return row | {"verdict": "not readable", "why": say(cell.why, language)}
    return row | {"verdict": "missing", "why": "no answer"}


def _value(scene: Mechanism, judged: Judged, language: str) -> Row:
    symbol = judged.printed.symbol

    def unit(value: Value) -> float | list[float]:
        if isinstance(value, complex):
            # what is left of a component that cancels is no value
            parts = (v if abs(v) > 1e-12 * abs(value) else 0.0 for v in (value.real, value.imag))
            return [_plain(in_scene_units(scene, symbol, v, degrees=True)) for v in parts]
        return _plain(in_scene_units(scene, symbol, value, degrees=True))

    row: Row = {
        "symbol": str(symbol), "written": judged.printed.text, "printed": unit(judged.printed.value),
        "exact": unit(judged.exact),
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
    return float(f"{value:.12g}")
