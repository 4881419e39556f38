"""``graphkin audit``: other people's values judged, the slips of wrong ones, and the results of a class: points by a
scheme, a slip for each student, the slips in each quantity."""

from __future__ import annotations

import math
import os
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from graphkin import solver
from graphkin.api.answers import Answers, AnswersLike, Cell, as_answers
from graphkin.api.arguments import At, as_scene, driver_values, known_words, placed
from graphkin.api.results import OfScene, Result, named
from graphkin.checking.audit import judge, judge_table, with_gaps
from graphkin.checking.report import Known
from graphkin.checking.scans import JudgedScan, judge_scans
from graphkin.checking.slip_likelihood import Judged
from graphkin.checking.slips import Evidence, ValuesElsewhere
from graphkin.checking.uncertainty import predict
from graphkin.construction import execute, plan
from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean
from graphkin.files import Json, path_of
from graphkin.plane import added_up
from graphkin.scene.asked import spelling_of
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike
from graphkin.scene.symbol import Printed, Symbol, Value
from graphkin.solver import Motion, driver_range, solved_here, structure_of
from graphkin.solver.values import exact_values, value_of
from graphkin.words import Phrase, say, word

if TYPE_CHECKING:
    from graphkin.table import Table

POSITIONS = 72
MOST_DRAWN = 6  # rows of a table that are drawn each
MOST_LOOPS = 24  # rows of a table of which wrong angles are told with the gaps of their loops

FULL = ("right", "within drafting accuracy", "right from own values")
PARTS = ("equations", "drawing", "values")
COUNTED = (*FULL, "wrong", "missing", "not readable")
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


@dataclass(frozen=True, repr=False, eq=False)
class Audited(OfScene, Result):
    """The values of each person with their verdicts; of a scene's ``[printed]`` values the person is "".

    ``unused`` are heads of the table of answers that are no quantities, ``scheme`` the points of each part, ``scans``
    drawings judged line by line.
    """

    mechanism: Mechanism
    people: tuple[tuple[Answers, tuple[Judged, ...]], ...]
    language: str = "en"
    unused: tuple[str, ...] = ()
    scheme: Scheme | None = None
    scans: tuple[JudgedScan, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether no value is wrong or unreadable, and no line of a scan is wrong."""
        if not all(scan.ok for scan in self.scans):
            return False
        wrong = {"wrong", "right from own values", "not readable"}
        return not any(wrong & set(_verdicts(who, judged).values()) for who, judged in self.people)

    @cached_property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin audit --json`` prints; values in scene units."""
        values = [row for who, judged in self.people for row in rows_of(self.mechanism, who, judged, "en")]
        said: dict[str, Json] = {"ok": self.ok, "values": values}
        if self.is_class:
            said["people"] = list(people_of(self.people, self.scheme, "en"))
            said["quantities"] = list(quantities_of(self.people, "en"))
        if self.scans:
            said["scans"] = {scan.diagram: self._scan(scan) for scan in self.scans}
        return {**said, **({"unused": list(self.unused)} if self.unused else {})}

    def _scan(self, judged: JudgedScan) -> dict[str, Json]:
        lines: list[dict[str, Json]] = [
            {
                "line": line.name, "on_paper_mm": abs(line.read), "exact_mm": abs(line.exact),
                "turned_deg": math.degrees(line.turned), "ok": line.ok, "said": say(line.said, "en"),
            }
            for line in judged.lines
        ]  # fmt: skip
        return {"ok": judged.ok, "off": judged.off.name if judged.off else None, "lines": lines}

    @property
    def scan_lines(self) -> list[str]:
        """The sentences on the scans, in the language of the call."""
        said = []
        for judged in self.scans:
            said.append(f"{word(f'scan of {judged.diagram}', self.language)}{word('colon', self.language)}")
            said += [f"  {line.name}: {say(line.said, self.language)}" for line in judged.lines]
            off = judged.off
            end = Phrase("scan right") if off is None else Phrase("scan off", line=off.name, slip=off.said)
            said.append("  " + say(end, self.language))
        return said

    @property
    def is_class(self) -> bool:
        """Whether these are answers of people, not values of a scene."""
        return any(who.person for who, _ in self.people)

    @property
    def _named(self) -> dict[str, str]:
        """The columns that name the person of a value, with their heads."""
        known = {
            "person": any(w.person for w, _ in self.people), "id": any(w.id for w, _ in self.people),
            "variant": any(w.variant for w, _ in self.people), "at": any(w.at is not None for w, _ in self.people),
        }  # fmt: skip
        return {key: _head(key, self.language) for key, there in known.items() if there}

    @property
    def heads(self) -> list[str]:
        """Heads of ``rows``."""
        keys = ("quantity", "printed", "exact", "unit", "deviation", "verdict", "looks like")
        return [*self._named.values(), *(word(k, self.language) for k in keys)]

    @cached_property
    def rows(self) -> list[list[str]]:
        """The table as texts, in the language of the call."""
        rows = []
        for who, judged in self.people:
            own = {"person": who.person, "id": who.id, "variant": who.variant, "at": _cell(who.at)}
            lead = [own[key] for key in self._named]
            for row in rows_of(self.mechanism, who, judged, self.language):
                percent, gap = row["deviation_pct"], row.get("loop_gap")
                off = f"{round(percent, 2) + 0.0:+.2f} %" if isinstance(percent, float) else ""
                verdict = word(str(row["verdict"] or "not judged"), self.language)
                said = str(row.get("looks_like", row.get("why", "") if row["verdict"] == "not readable" else ""))
                if isinstance(gap, dict):
                    open_ = Phrase("loop open", loop=gap["loop"], gap=f"{gap['gap']:.4g} {self.mechanism.units.length}")
                    mark = word("list semicolon", self.language)
                    said = mark.join(filter(None, (said, say(open_, self.language))))
                values = str(row["written"]), _shown(row["exact"]), str(row["unit"])
                rows.append([*lead, str(row["symbol"]), *values, off, verdict, said])
        return rows

    def __getitem__(self, name: str) -> tuple[JudgedValue, ...]:
        """The judged values of a symbol, one for each person who gave it, in the file's units.  Raises CallError for a
        symbol that nobody gave."""
        judged = [j for _, own in self.people for j in own]
        symbol = named({str(j.printed.symbol): j.printed.symbol for j in judged}, name, Phrase("no value of this name"))
        values = (j for j in judged if j.printed.symbol == symbol)
        return tuple(JudgedValue.of(self.mechanism, value, self.language) for value in values)

    @cached_property
    def table(self) -> Table:
        """The values and their verdicts as texts, in the language of the call."""
        from graphkin.table import Table

        return Table.of(self.heads, self.rows)

    @cached_property
    def students(self) -> Table:
        """A row for each person: verdicts counted, points, the main slip."""
        rows = [row | row.pop("points", {}) for row in people_of(self.people, self.scheme, self.language)]
        return _tabled(rows, ("total", "of", "slip"), self.language)

    @cached_property
    def matrix(self) -> Table:
        """A row for each quantity: verdicts of the class counted, the commonest slip."""
        rows = list(quantities_of(self.people, self.language))
        return _tabled(rows, ("commonest_slip", "made_by"), self.language)

    @property
    def files(self) -> Mapping[str, bytes]:
        """audit.csv, of a class also students.csv and quantities.csv, as a spreadsheet opens them."""
        tables = {"audit.csv": self.table}
        if self.is_class:
            tables |= {"students.csv": self.students, "quantities.csv": self.matrix}
        return {name: table.harmless().csv().encode("utf-8-sig") for name, table in tables.items()}

    def __repr__(self) -> str:
        return (
            f"<Audited {self.mechanism.name}: {sum(len(judged) for _, judged in self.people)} values, "
            f"{sum(j.verdict == 'wrong' for _, judged in self.people for j in judged)} wrong>"
        )


def _head(key: str, language: str) -> str:
    named = {"id": "id in a class", "at": "at in a class", "symbol": "quantity"}
    return word(named.get(key, key.replace("_", " ")), language)


def _tabled(rows: Sequence[Mapping[str, object]], last: Sequence[str], language: str) -> Table:
    """Rows as a table with a head for each of their keys, some of them at the end."""
    from graphkin.table import Table

    known = dict.fromkeys(key for row in rows for key in row)
    keys = [*(key for key in known if key not in last), *(key for key in last if key in known)]
    return Table.of([_head(key, language) for key in keys], [[_cell(row.get(key)) for key in keys] for row in rows])


def _cell(value: object) -> str:
    return "" if value is None else f"{value:g}" if isinstance(value, int | float) else str(value)


def _shown(value: Json) -> str:
    """A number or the components of a vector; "" where there is none."""
    return "" if value is None else ", ".join(f"{v:.6g}" for v in (value if isinstance(value, list) else [value]))


def audit(
    scene: SceneLike,
    *,
    at: At = None,
    answers: AnswersLike | None = None,
    variants: str | os.PathLike[str] | Mapping[str, SceneLike] | None = None,
    grading: Mapping[str, float] | None = None,
    language: str | None = None,
) -> Audited:
    """Judge the scene's ``[printed]`` values and its ``[scans]``, or the answers of several people.

    Parameters
    ----------
    scene, at : as for `solve`
    answers : a CSV file with a row for each person (or, with a column ``at``, for each position) and symbols as heads,
        or a mapping from person to values by symbol; in scene units, rad/s, rad/s2, where no unit is written
    language : "en" or "zh", of the table; the scene's own if None
    variants : for answers with a column ``variant``: the folder of a problem set, or scenes by name
    grading : points by "equations", "drawing", "values", or by symbol; the scene's ``[grading]`` if None.  The first
        two are taken from columns of the same names

    Returns
    -------
    Audited; each value is "right" (to the digits stated), "within drafting accuracy" (of a pencil drawing with the
    scene's scales and tools), "right from own values" (it follows from earlier wrong ones) or "wrong",
    then with the slip that explains it, if there is one; "not judged" (None in the JSON, with why) where the error of a
    pencil has no bound, near a dead point; "missing" or "not readable" where there is no value

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
    if answers is None and not given.question.stated and not given.question.scans:
        raise CallError.of("printed", "the scene has no printed values", "write them in printed or give answers as")
    scans = _scanned(given, at) if given.question.scans and answers is None else ()
    scheme = scheme_of(given, grading)
    people, unused = (_stated(given), ()) if answers is None else as_answers(given, answers)
    people = _with_signs(people)
    asked = list(dict.fromkeys(p.symbol for who in people for p in who.values if not p.symbol.at))
    problems = _problems(given, people, variants)

    @cache
    def case(place: float | str | None, variant: str = "") -> Evidence:
        own = _others_values(problems, variant) if variant else (lambda symbol: ())
        return evidence_at(problems[variant], asked, at if place is None else place, own)

    table = [who for who in people if not who.variant and (who.by == "computation" or who.at is not None)]
    if len(table) <= MOST_DRAWN and all(who.by == "drawing" for who in table):
        judged = tuple((who, judge(case(who.at, who.variant), who.values) if who.values else ()) for who in people)
    else:
        rows = dict(zip(map(id, table), judged_table(given, table, at, case), strict=True))
        judged = tuple(
            (who, rows[id(who)] if id(who) in rows else judge(case(who.at, who.variant), who.values)) for who in people
        )
    opened = [(who, own) for who, own in judged if any(
        j.verdict == "wrong" and j.printed.symbol.kind in ("theta", "s") for j in own)]  # fmt: skip
    told = {id(who): with_gaps(case(who.at, who.variant), own) for who, own in opened[:MOST_LOOPS]}
    judged = tuple((who, told.get(id(who), own)) for who, own in judged)
    return Audited(given, judged, language or given.question.sheet.language, unused, scheme, scans)


# -- what values are held against --------------------------------------------------------------------------------------


def _scanned(scene: Mechanism, at: At) -> tuple[JudgedScan, ...]:
    """The scans of a scene, compared with the exact drawing."""
    given, values = placed(scene, at)
    solved_here(given, values)
    return judge_scans(execute(plan(given, values, ())))


def _problems(
    scene: Mechanism, people: Sequence[Answers], variants: str | os.PathLike[str] | Mapping[str, SceneLike] | None
) -> dict[str, Mechanism]:
    """The scene of each variant in the answers; "" is the scene itself.

    Raises CallError for answers to an unknown variant.
    """
    named = sorted({who.variant for who in people if who.variant})
    if not named:
        return {"": scene}
    if variants is None:
        raise CallError.of("variant", "the answers name variants", "give the folder of the problem set variants",
                           named=', '.join(named)[:80])
    scenes: dict[str, SceneLike] = {}
    if isinstance(variants, Mapping):
        scenes = {str(name): one for name, one in variants.items()}
    else:
        folder = path_of(variants)
        scenes = {path.stem.rpartition("-")[2]: path for path in sorted(folder.rglob("*-*.toml"))}
    plain = {name.lstrip("0") or "0": name for name in scenes}
    problems = []
    made = {"": scene, **{name: as_scene(one) for name, one in scenes.items()}}
    for name in named:
        key = name if name in scenes else plain.get(name.lstrip("0") or "0")
        if key is None:
            problems.append(Problem(Phrase("variant of name", name=name), "is not in the set",
                                    did_you_mean(name, scenes)))
        else:
            made[name] = made[key]
    if problems:
        raise CallError(*problems[:20])
    return made


def _others_values(problems: Mapping[str, Mechanism], own: str) -> ValuesElsewhere:
    """Exact values of the other problems of a set, by their names."""
    @cache
    def values(symbol: Symbol) -> tuple[tuple[str, Value], ...]:
        others: list[tuple[str, Value]] = []
        for name, scene in problems.items():
            if name and scene is not problems[own]:
                value = exact_values(solver.solve(scene), [symbol])(symbol)
                others.append((name, value))
        return tuple(others)

    return values


def _with_signs(people: Sequence[Answers]) -> tuple[Answers, ...]:
    """The answers with the numbers of a column signed where one of them has a written sign."""
    signed = {
        (who.person, who.variant, who.by, p.symbol)
        for who in people for p in who.values if p.shows_sign and p.direction is None and not p.lines
    }  # fmt: skip
    if not signed:
        return tuple(people)

    def told(who: Answers, cell: Cell) -> Cell:
        if not isinstance(cell, Printed):
            return cell
        return replace(cell, signed=(who.person, who.variant, who.by, cell.symbol) in signed)

    return tuple(replace(who, cells={s: told(who, cell) for s, cell in who.cells.items()}) for who in people)


def _stated(scene: Mechanism) -> tuple[Answers, ...]:
    """The values stated in a scene's own tables, a row for each position."""
    answers: list[Answers] = []
    for own in scene.question.stated:
        if own.file:
            rows, _ = as_answers(scene, own.file)
            answers += [replace(row, person="", by=own.by) for row in rows]
            continue
        for place in dict.fromkeys(symbol.at for symbol in own.values):
            there = (replace(p, symbol=s.here) for s, p in own.values.items() if s.at == place)
            answers.append(Answers("", place or own.at, {p.symbol: p for p in there}, own.by))
    return tuple(answers)


def _over_places(scene: Mechanism, table: Sequence[Answers], at: At) -> Motion:
    """The exact motion at the positions of some answers."""
    reach = driver_range(structure_of(scene))
    driver = scene.drivers[0]
    places = [(driver_values(scene, at if who.at is None else who.at) or {}).get(driver.key) for who in table]
    here = driver.values[0]
    motion = reach.motion(reach.offsets(np.array([here if place is None else place for place in places])))
    if not motion.ok.all():
        k = int(np.argmin(motion.ok))
        where = Phrase("driver at", key=driver.key, where=scene.unit_of(driver).said(float(motion.values[k, 0])))
        raise Unsolvable(str(motion.status[k]), Problem(where, motion.said(k)))
    return motion


def judged_table(
    scene: Mechanism, table: Sequence[Answers], at: At, case: Callable[[float | str | None], Evidence]
) -> list[tuple[Judged, ...]]:
    """Rows of a table: all positions solved at once, judged by their digits."""
    turning = {p.symbol for who in table for p in who.values if p.symbol.scope in ("turn", "cycle")}
    value = exact_values(solved_here(scene, None), tuple(turning))
    motion = _over_places(scene, table, at)
    names = [_named(scene, who.at, motion.values[row, 0]) for row, who in enumerate(table)]
    return judge_table(
        motion, [(who.values, who.by) for who in table], {s: float(value(s).real) for s in turning}, names,
        lambda row: case(table[row].at),
    )  # fmt: skip


def evidence_at(
    scene: Mechanism, asked: Sequence[Symbol], at: At, variants: ValuesElsewhere = lambda symbol: ()
) -> Evidence:
    """The evidence on a scene at one position.

    ``variants`` gives the values of the other problems of its set.
    """
    scene, values = placed(scene, at)
    motion = solved_here(scene, values)
    what = plan(motion.structure, values, [symbol for symbol in asked if symbol.scope != "cycle"])
    predicted = predict(what, "pencil", scene.question.sheet.tools)
    evidence = Evidence.of(what, motion, predicted, asked)
    return replace(evidence, elsewhere=_elsewhere(scene, values), variants=variants, motion=motion)


def _elsewhere(scene: Mechanism, values: dict[str, float] | None) -> ValuesElsewhere:
    """Exact values at the positions of a table: steps of 5 degrees, from here and from 0."""
    @cache
    def motions() -> tuple[Motion, ...]:
        first = scene.drivers[0]
        if not first.turns:
            return ()
        from_zero = {**(values or {}), first.key: 0.0}
        return solver.solve(scene, values, POSITIONS), solver.solve(scene, from_zero, POSITIONS)

    def table(symbol: Symbol) -> list[tuple[str, complex | float]]:
        rows: list[tuple[str, complex | float]] = []
        if symbol.scope in ("turn", "cycle") or symbol.kind == "arm":  # the lever has its arms at one position
            return rows
        for motion in motions():
            for i, value in enumerate(value_of(motion, symbol)):
                if motion.ok[i]:
                    driver, at = scene.drivers[0], float(motion.values[i, 0])
                    name = f"{driver.key} = {scene.unit_of(driver).said(at)}"
                    rows.append((name, complex(value) if symbol.is_vector else float(value.real)))
        return rows

    return table


def _named(scene: Mechanism, at: float | str | None, value: float) -> str:
    """The name of a table's row: its position's name, or the driver's value."""
    driver = scene.drivers[0]
    return at if isinstance(at, str) else f"{driver.key} = {scene.unit_of(driver).said(float(value))}"


# -- points, and what a class did --------------------------------------------------------------------------------------


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
        if isinstance(weight, bool) or not isinstance(weight, Real) or not 0 <= weight < 1e6:
            problems.append(Problem(f"grading {name}", "found value", "give points 0 or more", value=f"{weight!r:.40}"))
        elif name in PARTS:
            scheme[str(name)] = float(weight)
        elif symbol is not None:
            scheme[symbol] = float(weight)
        else:
            problems.append(Problem(f"grading {name}", "is no part and no quantity of the", "or a symbol such as v_d",
                                    names=', '.join(PARTS)))
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
        row |= _counted(_verdicts(who, judged).values())
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

    good = [j.printed.symbol for j in judged if j.verdict in FULL]
    values = added_up(map(worth, good))
    most = added_up(map(worth, who.cells))
    points: dict[str, float | None] = {"values": values}
    total = values
    for part in ("equations", "drawing"):
        if part in scheme:
            mark = who.marks.get(part)
            points[part] = own = None if mark is None else min(max(mark, 0.0), scheme[part])
            if own is not None:
                total += own
                most += scheme[part]
    return {"points": {k: None if v is None else round(v, 4) for k, v in points.items()},
            "total": round(total, 4), "of": round(most, 4)}  # fmt: skip


def _verdicts(who: Answers, judged: Sequence[Judged]) -> dict[Symbol, str]:
    """The verdict on each cell; a cell without a value is "missing" or "not readable"."""
    unread = {s: "missing" if cell is None else "not readable" for s, cell in who.cells.items()}
    return unread | {j.printed.symbol: j.verdict for j in judged}


def _counted(verdicts: Iterable[str]) -> dict[str, Json]:
    """The count of each verdict."""
    counts = Counter(verdicts)
    return {verdict: counts[verdict] for verdict in COUNTED}


def quantities_of(people: Sequence[Person], language: str) -> Iterator[dict[str, Json]]:
    """For each quantity: the verdicts of the class counted, and the commonest slip with its count."""
    verdicts = [_verdicts(who, judged) for who, judged in people]
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
    row: Row = {
        "symbol": str(symbol), "written": text, "printed": None, "exact": None, "unit": symbol.unit(scene.units).text,
        "deviation_pct": None,
    }  # fmt: skip
    if why is None:
        return row | {"verdict": "missing", "why": "no answer"}
    return row | {"verdict": "not readable", "why": say(why, language)}


def _value(scene: Mechanism, judged: Judged, language: str) -> Row:
    value = JudgedValue.of(scene, judged, language)
    row: Row = {
        "symbol": str(value.symbol), "written": judged.printed.text, "printed": _plain(value.printed),
        "exact": _plain(value.exact), "unit": value.unit,
        "deviation_pct": None if value.deviation is None else 100 * value.deviation,
    }  # fmt: skip
    if value.deviation is None:
        row["why"] = "the exact value is zero"
    row["verdict"] = value.verdict if value.verdict != "not judged" else None
    row["bound"] = _plain(value.bound) if math.isfinite(value.bound) else None
    if value.verdict == "not judged":
        row["why"] = say(Phrase("nothing to judge by"), language)
    if value.looks_like:
        row["looks_like"] = value.looks_like
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
