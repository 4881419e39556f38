"""``graphkin audit``: other people's values judged, and what the wrong ones look like."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from graphkin.api.answers import Answers, AnswersLike, as_answers
from graphkin.api.arguments import At, SceneLike, as_scene, driver_values, known_words, own_unit, write_files
from graphkin.api.checked import in_scene_units, solved_here
from graphkin.api.results import Result
from graphkin.checking.audit import Judged, explained, judge
from graphkin.checking.printed import printed_values, stated
from graphkin.checking.readings import predict
from graphkin.checking.slips import Evidence, ValuesElsewhere
from graphkin.checking.table_audit import exact_rows, judged_by_digits
from graphkin.construction import plan
from graphkin.errors import CallError, Problem, Unsolvable, as_text, did_you_mean
from graphkin.files import path_of
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase, say, word

if TYPE_CHECKING:
    from graphkin.solver import Motion
    from graphkin.table import Table

__all__ = ["Audited", "audit"]

POSITIONS = 72
MOST_DRAWN = 6  # rows of a table that are drawn each
MOST_PREDICTED = 4  # positions of a longer one that are
MOST_EXPLAINED = 3  # rows of which is told what their wrong values look like


@dataclass(frozen=True, repr=False, eq=False)
class Audited(Result):
    """The values of each person with their verdicts; of a scene's ``[printed]`` values the person is "".

    ``unused`` are heads of the table of answers that are no quantities.
    """

    scene: Mechanism
    people: tuple[tuple[Answers, tuple[Judged, ...]], ...]
    language: str = "en"
    unused: tuple[str, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether no value is wrong."""
        return all(j.verdict != "wrong" for _, judged in self.people for j in judged)

    @cached_property
    def data(self) -> dict[str, Any]:
        """The object that ``graphkin audit --json`` prints; values in scene units."""
        values = [_value(self.scene, who, j, "en") for who, judged in self.people for j in judged]
        return {"ok": self.ok, "values": values, **({"unused": list(self.unused)} if self.unused else {})}

    @property
    def heads(self) -> list[str]:
        """Heads of ``rows``."""
        keys = ("quantity", "printed", "exact", "deviation", "verdict", "looks like")
        who = [word("person", self.language)] if any(w.person for w, _ in self.people) else []
        at = ["at"] if any(w.at is not None for w, _ in self.people) else []
        return [*who, *at, *(word(k, self.language) for k in keys)]

    @cached_property
    def rows(self) -> list[list[str]]:
        """The table as texts, in the language of the call."""
        named = any(w.person for w, _ in self.people)
        placed = any(w.at is not None for w, _ in self.people)
        rows = []
        for who, judged in self.people:
            for j in judged:
                row = _value(self.scene, who, j, self.language)
                off = "" if row["deviation_pct"] is None else f"{round(row['deviation_pct'], 2) + 0.0:+.2f} %"
                rows.append(
                    [
                        *([who.person] if named else []),
                        *(["" if who.at is None else _place(who.at)] if placed else []),
                        row["symbol"],
                        ", ".join(j.printed.texts),
                        _shown(row["exact"]),
                        off,
                        word(j.verdict, self.language),
                        row.get("looks_like", ""),
                    ]
                )
        return rows

    def __getitem__(self, name: str) -> tuple[Judged, ...]:
        """What was judged of a symbol, one for each person who gave it.  Raises CallError for one that nobody gave."""
        name = as_text("name", name)
        judged = [j for _, own in self.people for j in own]
        found = tuple(j for j in judged if str(j.printed.symbol) == name)
        if not found:
            known = [str(j.printed.symbol) for j in judged]
            raise CallError(Problem(f'"{name}"', "no value of this name", did_you_mean(str(name), known)))
        return found

    @cached_property
    def table(self) -> Table:
        """The values and their verdicts as texts, in the language of the call."""
        from graphkin.table import Table

        return Table.of(self.heads, self.rows)

    def write(self, folder: str | os.PathLike[str]) -> list[Path]:
        """Write audit.csv into a folder.  Raises CallError where it cannot be written."""
        return write_files(path_of(folder), {"audit.csv": self.table.csv().encode("utf-8-sig")})

    def __repr__(self) -> str:
        return (
            f"<Audited {self.scene.name}: {sum(len(judged) for _, judged in self.people)} values, "
            f"{sum(j.verdict == 'wrong' for _, judged in self.people for j in judged)} wrong>"
        )


def _value(scene: Mechanism, who: Answers, judged: Judged, language: str) -> dict[str, Any]:
    symbol = judged.printed.symbol

    def unit(value: complex | float) -> float | list[float]:
        if isinstance(value, complex):
            # what is left of a component that cancels is no value
            parts = (v if abs(v) > 1e-12 * abs(value) else 0.0 for v in (value.real, value.imag))
            return [_plain(in_scene_units(scene, symbol, v, degrees=True)) for v in parts]
        return _plain(in_scene_units(scene, symbol, value, degrees=True))

    row: dict[str, Any] = {"symbol": str(symbol), "printed": unit(judged.printed.value), "exact": unit(judged.exact)}
    row["deviation_pct"] = None if judged.deviation is None else 100 * judged.deviation
    if judged.deviation is None:
        row["why"] = "the exact value is zero"
    row["verdict"] = judged.verdict if judged.verdict != "not judged" else None
    row["bound"] = unit(judged.bound) if math.isfinite(judged.bound) else None
    if judged.verdict == "not judged":
        row["why"] = say(Phrase("nothing to judge by"), language)
    if judged.looks_like is not None:
        row["looks_like"] = say(judged.looks_like, language)
    if judged.follows_from:
        row["follows_from"] = [str(s) for s in judged.follows_from]
    person = {"person": who.person} if who.person else {}
    return {**person, **({"at": who.at} if who.at is not None else {}), **row}


def _place(at: float | str) -> str:
    return at if isinstance(at, str) else f"{at:g}"


def _plain(value: float) -> float:
    return float(f"{value:.12g}")


def _shown(value: float | list[float]) -> str:
    return ", ".join(f"{v:.6g}" for v in (value if isinstance(value, list) else [value]))


def audit(scene: SceneLike, answers: AnswersLike | None = None, at: At = None, language: str | None = None) -> Audited:
    """Judge the scene's ``[printed]`` values, or the answers of several people.

    Parameters
    ----------
    scene, at : as for `solve`
    answers : a CSV file with a row for each person (or, with a column ``at``, for each position) and symbols as heads,
        or a mapping from person to values by symbol; in scene units, rad/s, rad/s2
    language : "en" or "zh", of the table; the scene's own if None

    Returns
    -------
    Audited; each value is "right" (to the digits stated), "within drafting accuracy" (of a pencil drawing with the
    scene's scales and tools) or "wrong", then with what it looks like where a common slip explains it; "not judged"
    (None in the JSON, with why) where a pencil may be off by anything, beside a dead point

    Raises
    ------
    SceneError, CallError : the file, the table or the call is wrong, or there is nothing to judge
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point

    Examples
    --------
    >>> [v["verdict"] for v in audit("shaper-scheme-2").data["values"] if v["symbol"] in ("a_B", "a_C")]
    ['within drafting accuracy', 'wrong']
    """
    given = as_scene(scene)
    known_words(language=language)
    if answers is None and not given.printed and not given.stated:
        raise CallError(
            Problem("printed", "the scene has no printed values", "write them in [printed], or give answers as CSV")
        )
    people, unused = (_stated(given), ()) if answers is None else as_answers(given, answers)
    asked = list(dict.fromkeys(p.symbol for who in people for p in who.values if not p.symbol.at))

    @cache
    def case(place: float | str | None) -> Evidence:
        return _case(given, asked, at if place is None else place)

    table = [who for who in people if who.by == "computation" or who.at is not None]
    if len(table) <= MOST_DRAWN and all(who.by == "drawing" for who in table):
        judged = tuple((who, judge(case(who.at), who.values)) for who in people)
    else:
        rows = _judged_table(given, table, at, case)
        judged = tuple((who, rows.get(id(who)) or judge(case(who.at), who.values)) for who in people)
    return Audited(given, judged, language or given.sheet.language, unused)


def _stated(scene: Mechanism) -> tuple[Answers, ...]:
    """What a scene's own tables state, a row for each position."""
    found: list[Answers] = []
    for own in scene.stated:
        if own.file:
            rows, _ = as_answers(scene, own.file)
            found += [replace(row, person="", by=own.by) for row in rows]
            continue
        values = (
            printed_values(scene) if own.at is None
            else tuple(stated(symbol, texts, scene.units) for symbol, texts in own.values.items())
        )  # fmt: skip
        for place in dict.fromkeys(p.symbol.at for p in values):
            there = tuple(replace(p, symbol=p.symbol.here) for p in values if p.symbol.at == place)
            found.append(Answers("", place or own.at, there, own.by))
    if not scene.stated:
        found.append(Answers("", None, printed_values(scene)))
    return tuple(found)


def _judged_table(
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
        where = own_unit(scene, scene.drivers[0], float(motion.values[k, 0]))
        status = str(motion.status[k])
        raise Unsolvable(status, Problem(f"driver {key} at {where}", f"{status}: {motion.why[k]}"))
    turning = [s for s in symbols if s.scope == "turn"]
    value = exact_values(solved_here(scene, None), turning)
    exact = exact_rows(motion, symbols, {s: float(value(s).real) for s in turning})
    drawn = _Bounds(table, case)
    made: dict[int, tuple[Judged, ...]] = {}
    looked_into = 0
    for row, who in enumerate(table):
        judged = []
        for printed in who.values:
            right = exact(row, printed)
            one = judged_by_digits(printed, right, who.by, 0.0)
            if one.verdict != "right" and who.by == "drawing":
                one = judged_by_digits(printed, right, who.by, drawn.bound(row, printed.symbol))
            judged.append(one)
        if any(one.verdict == "wrong" for one in judged) and looked_into < MOST_EXPLAINED:
            looked_into += 1
            evidence, values = case(who.at), {p.symbol: p.value for p in who.values}
            wrong = [one.printed.symbol for one in judged if one.verdict == "wrong"]
            judged = [explained(evidence, j, values, wrong) if j.verdict == "wrong" else j for j in judged]
        made[id(who)] = tuple(judged)
    return made


@dataclass
class _Bounds:
    """What a pencil keeps within at the rows of a long table: predicted at some of them, the nearest is taken."""

    table: Sequence[Answers]
    case: Callable[[float | str | None], Evidence]

    def bound(self, row: int, symbol: Symbol) -> float:
        step = max(1, math.ceil(len(self.table) / MOST_PREDICTED))
        near = min(len(self.table) - 1, step * round(row / step))
        uncertainty = self.case(self.table[near].at).predicted.get(symbol)
        return uncertainty.bound if uncertainty and math.isfinite(uncertainty.bound) else 0.0


def _case(scene: Mechanism, asked: Sequence[Symbol], at: At) -> Evidence:
    from graphkin.solver import exact_values

    values = driver_values(scene, at)
    motion = solved_here(scene, values)
    structure = motion.structure
    what = plan(structure, values, [symbol for symbol in asked if symbol.scope != "force"])
    # everything is drawn, so that slips in what leads to the asked and beside it are found
    whole = plan(structure, values, ())
    drawn = what if set(what.elements) == set(whole.elements) else whole

    predicted = predict(what, "pencil", scene.sheet.tools)
    return Evidence(drawn, exact_values(motion, asked), predicted, _elsewhere(scene, values))


def _elsewhere(scene: Mechanism, values: dict[str, float] | None) -> ValuesElsewhere:
    """Exact values at the positions of a table: steps of 5 degrees, from here and from 0."""

    from graphkin import solver

    @cache
    def motions() -> tuple[Motion, ...]:
        first = scene.drivers[0]
        if not isinstance(first, AngleDriver):
            return ()
        from_zero = {**(values or {}), first.key: 0.0}
        return solver.solve(scene, values, POSITIONS), solver.solve(scene, from_zero, POSITIONS)

    def table(symbol: Symbol) -> list[tuple[str, complex | float]]:
        found: list[tuple[str, complex | float]] = []
        if symbol.scope == "turn":
            return found
        for motion in motions():
            for i, value in enumerate(solver.value_of(motion, symbol)):
                if motion.ok[i]:
                    name = f"{scene.drivers[0].key} = {own_unit(scene, scene.drivers[0], float(motion.values[i, 0]))}"
                    found.append((name, complex(value) if symbol.is_vector else float(value.real)))
        return found

    return table
