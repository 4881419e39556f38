"""``graphkin audit``: other people's values judged, the slips of wrong ones, and the results of a class: points by a
scheme, a slip for each student, the slips in each quantity."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property

import numpy as np

from graphkin import solver
from graphkin.api.arguments import At, as_scene, driver_values, known_words, placed
from graphkin.api.results import OfScene, Result, named
from graphkin.checking.answers import Answers, AnswersLike, as_answers, stated_answers, with_signs
from graphkin.checking.audit import judge, judge_table, with_gaps
from graphkin.checking.grading import (
    JudgedValue,
    Person,
    Scheme,
    people_of,
    quantities_of,
    rows_of,
    scheme_of,
    verdicts_of,
)
from graphkin.checking.scans import JudgedScan, judge_scans
from graphkin.checking.slip_likelihood import Judged
from graphkin.checking.slips import Evidence, ValuesElsewhere
from graphkin.checking.uncertainty import predict
from graphkin.construction import execute, plan, plan_with_forces
from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean, some_of
from graphkin.files import Json, path_of
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike
from graphkin.scene.symbol import Symbol, Value
from graphkin.solver import Motion, driver_range, solved_here, structure_of
from graphkin.solver.forces import value_of
from graphkin.solver.values import exact_values
from graphkin.table import Table
from graphkin.words import Phrase, say, word

POSITIONS = 72
MOST_DRAWN = 6  # rows of a table that are drawn each
MOST_LOOPS = 24  # rows of a table of which wrong angles are told with the gaps of their loops

@dataclass(frozen=True, repr=False, eq=False)
class Audited(OfScene, Result):
    """The values of each person with their verdicts; of a scene's ``[printed]`` values the person is "".

    ``unused`` are heads of the table of answers that are no quantities, ``scheme`` the points of each part, ``scans``
    drawings judged line by line.
    """

    mechanism: Mechanism
    people: tuple[Person, ...]
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
        return not any(wrong & set(verdicts_of(who, judged).values()) for who, judged in self.people)

    @cached_property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin audit --json`` prints; values in scene units."""
        values = [row for who, judged in self.people for row in rows_of(self.mechanism, who, judged, "en")]
        said: dict[str, Json] = {"ok": self.ok, "values": values}
        if self.is_class:
            said["people"] = list(people_of(self.people, self.scheme, "en"))
            said["quantities"] = list(quantities_of(self.people, "en"))
        if self.scans:
            said["scans"] = {scan.diagram: scan.data for scan in self.scans}
        return {**said, **({"unused": list(self.unused)} if self.unused else {})}

    @property
    def scan_lines(self) -> list[str]:
        """The sentences on the scans, in the language of the call."""
        return [line for scan in self.scans for line in scan.sentences(self.language)]

    @property
    def is_class(self) -> bool:
        """Whether these are answers of people, not values of a scene."""
        return any(who.person for who, _ in self.people)

    @property
    def _named(self) -> dict[str, str]:
        """The columns that name the person of a value, with their heads."""
        keys = ("person", "id", "variant", "at")
        known = [key for key in keys if any(getattr(who, key) not in ("", None) for who, _ in self.people)]
        return {key: _head(key, self.language) for key in known}

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
            lead = [_cell(getattr(who, key)) for key in self._named]
            for row in rows_of(self.mechanism, who, judged, self.language):
                error, gap = row["deviation_pct"], row.get("loop_gap")
                deviation = f"{round(error, 2) + 0.0:+.2f} %" if isinstance(error, float) else ""
                verdict = word(str(row["verdict"] or "not judged"), self.language)
                said = str(row.get("looks_like", row.get("why", "") if row["verdict"] == "not readable" else ""))
                if "looks_like_off_pct" in row:
                    percent = f"{row['looks_like_off_pct']:g}"
                    said = say(Phrase("slip nearly", slip=said, percent=percent), self.language)
                if isinstance(gap, dict):
                    open_ = Phrase("loop open", loop=gap["loop"], gap=f"{gap['gap']:.4g} {self.mechanism.units.length}")
                    mark = word("list semicolon", self.language)
                    said = mark.join(filter(None, (said, say(open_, self.language))))
                values = str(row["written"]), _shown(row["exact"]), str(row["unit"])
                rows.append([*lead, str(row["symbol"]), *values, deviation, verdict, said])
        return rows

    def __getitem__(self, name: str) -> tuple[JudgedValue, ...]:
        """The judged values of a symbol, one a person, in the file's units.  Raises CallError if nobody gave it."""
        judged = [j for _, row in self.people for j in row]
        symbol = named({str(j.printed.symbol): j.printed.symbol for j in judged}, name, Phrase("no value of this name"))
        values = (j for j in judged if j.printed.symbol == symbol)
        return tuple(JudgedValue.of(self.mechanism, value, self.language) for value in values)

    @cached_property
    def table(self) -> Table:
        """The values and their verdicts as texts, in the language of the call."""
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
    scans: tuple[JudgedScan, ...] = ()
    if given.question.scans and answers is None:
        standing, values = placed(given, at)
        solved_here(standing, values)  # a position that cannot be had
        scans = judge_scans(execute(plan_with_forces(standing, values, (), ())))
    if answers is None and variants is not None:
        raise CallError.of("variants", "without answers", "leave it out")
    scheme = scheme_of(given, grading)
    people, unused = (stated_answers(given), ()) if answers is None else as_answers(given, answers)
    people = with_signs(people)
    asked = list(dict.fromkeys(p.symbol for who in people for p in who.values if not p.symbol.at))
    problems = _problems(given, people, variants)

    @cache
    def case(place: float | str | None, variant: str = "") -> Evidence:
        elsewhere = _others_values(problems, variant) if variant else (lambda symbol: ())
        return evidence_at(problems[variant], asked, at if place is None else place, elsewhere)

    table = [who for who in people if not who.variant and (who.by == "computation" or who.at is not None)]
    few = len(table) <= MOST_DRAWN and all(who.by == "drawing" for who in table)
    rows = {} if few else dict(zip(map(id, table), judged_table(given, table, at, case), strict=True))

    def of(who: Answers) -> tuple[Judged, ...]:
        if id(who) in rows or not who.values:
            return rows.get(id(who), ())
        return judge(case(who.at, who.variant), who.values)

    judged = tuple((who, of(who)) for who in people)
    opened = [(who, row) for who, row in judged if any(
        j.verdict == "wrong" and j.printed.symbol.kind in ("theta", "s") for j in row)]
    gapped = {id(who): with_gaps(case(who.at, who.variant), row) for who, row in opened[:MOST_LOOPS]}
    judged = tuple((who, gapped.get(id(who), row)) for who, row in judged)
    return Audited(given, judged, language or given.question.sheet.language, unused, scheme, scans)


# what values are held against


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
                           named=some_of(named))
    scenes: dict[str, SceneLike] = {}
    if isinstance(variants, Mapping):
        scenes = {str(name): variant for name, variant in variants.items()}
    else:
        folder = path_of(variants)
        scenes = {path.stem.rpartition("-")[2]: path for path in sorted(folder.rglob("*-*.toml"))}
    plain = {name.lstrip("0") or "0": name for name in scenes}
    problems = []
    made = {"": scene, **{name: as_scene(variant) for name, variant in scenes.items()}}
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


def _others_values(problems: Mapping[str, Mechanism], variant: str) -> ValuesElsewhere:
    """Exact values of the other problems of a set, by their names."""
    @cache
    def values(symbol: Symbol) -> tuple[tuple[str, Value], ...]:
        others = {id(scene): (name, scene) for name, scene in reversed([*problems.items()])  # "02" is "2" too
                  if name and scene is not problems[variant]}
        return tuple((name, exact_values(solver.solve(scene), [symbol])[symbol]) for name, scene in others.values())

    return values


def judged_table(
    scene: Mechanism, table: Sequence[Answers], at: At, case: Callable[[float | str | None], Evidence]
) -> list[tuple[Judged, ...]]:
    """Rows of a table, all solved at once and judged by their digits.  Raises Unsolvable for a position not reached."""
    turning = {p.symbol for who in table for p in who.values if p.symbol.scope in ("turn", "cycle")}
    values = exact_values(solved_here(scene, None), turning)
    reach, driver = driver_range(structure_of(scene)), scene.drivers[0]
    places = [(driver_values(scene, at if who.at is None else who.at) or {}).get(driver.key) for who in table]
    stands = [driver.values[0] if place is None else place for place in places]
    motion = reach.motion(reach.offsets(np.array(stands)))
    shown = [scene.unit_of(driver).said(place) for place in stands]
    if not motion.ok.all():
        k = int(np.argmin(motion.ok))
        where = Phrase("driver at", key=driver.key, where=shown[k])
        raise Unsolvable(str(motion.status[k]), Problem(where, motion.said(k)))
    names = [
        who.at if isinstance(who.at, str) else f"{driver.key} = {place}"
        for who, place in zip(table, shown, strict=True)
    ]
    return judge_table(
        motion, [(who.values, who.by) for who in table], {s: float(value.real) for s, value in values.items()}, names,
        lambda row: case(table[row].at),
    )


def evidence_at(
    scene: Mechanism, asked: Sequence[Symbol], at: At, variants: ValuesElsewhere = lambda symbol: ()
) -> Evidence:
    """The evidence on a scene at one position.

    ``variants`` gives the values of the other problems of its set.
    """
    scene, values = placed(scene, at)
    motion = solved_here(scene, values)
    planned = plan(motion.structure, values, [symbol for symbol in asked if symbol.scope != "cycle"])
    predicted = predict(planned, "pencil", scene.question.sheet.tools)
    evidence = Evidence.of(planned, motion, predicted)
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
