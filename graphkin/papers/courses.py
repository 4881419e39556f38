"""A course project: its schemes with the readings at all their positions, the scheme and position of each student, and
the table of the class."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from graphkin import solver
from graphkin.checking.readings import read_off, report_on
from graphkin.checking.report import Report
from graphkin.construction import execute
from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean, some_of
from graphkin.papers.documents import head_of
from graphkin.papers.lesson import positions
from graphkin.papers.paper import paper_plan
from graphkin.papers.variants import asked_of
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver import solved_here
from graphkin.solver.path.named_positions import named_positions
from graphkin.table import Table, table_of
from graphkin.words import Phrase

HEADS: Mapping[str, tuple[str, ...]] = {
    "name": ("name", "student", "姓名", "学生"),
    "id": ("id", "number", "no", "学号"),
    "scheme": ("scheme", "variant", "group", "方案", "组", "组别"),
    "place": ("position", "at", "位置"),
}
GROUPS = ("group", "组", "组别")
"""Heads of schemes that may be meant as groups of students who all have the same lengths."""


@dataclass(frozen=True)
class Student:
    """The student of a report, with their scheme and position ("" where the table names none)."""

    name: str = ""
    id: str = ""
    scheme: str = ""
    place: str = ""


@dataclass(frozen=True)
class PlaceValues:
    """The readings at a position: the first driver's value and the readings by symbol, both in scene units (vectors by
    size, rates with sign), and the exact values; no values where it cannot be drawn."""

    name: str
    driver: float
    read: Mapping[Symbol, float] = field(default_factory=dict)
    exact: Mapping[Symbol, float] = field(default_factory=dict)


Placed = tuple[Student, PlaceValues]
"""A line of the table of a class."""


@dataclass(frozen=True)
class Scheme:
    """A mechanism of a course: the quantities in the tables, its positions (SI values of the first driver) and the
    readings at each."""

    name: str
    scene: Mechanism
    asked: tuple[Symbol, ...]
    drivers: Mapping[str, float]
    places: Mapping[str, PlaceValues]

    def values(self, place: str) -> dict[str, float]:
        """Driver values (rad, m) at a position."""
        return {self.scene.drivers[0].key: self.drivers[place]}


def scheme_of(name: str, scene: Mechanism, asked: Sequence[Symbol], count: int) -> Scheme:
    """A mechanism with all its positions, each drawn and compared with the solver.

    Parameters
    ----------
    asked : the asked quantities, empty for all
    count : of positions of the driver, where the scene names none
    """
    structure = solver.structure_of(scene)
    key = scene.drivers[0].key
    drivers = dict(named_positions(scene))
    if not drivers:
        drivers = {str(k): row[key] for k, row in enumerate(positions(structure, None, count)[0], 1)}
    shown, places = asked_in_tables(scene, asked), {}
    for place, value in drivers.items():
        try:
            motion = solved_here(structure, {key: value})
            report = report_on(execute(paper_plan(structure, {key: value}, shown)), motion)
            report.must_agree()
            places[place] = read_at(place, value, scene, report, shown)
        except Unsolvable:
            places[place] = PlaceValues(place, scene.unit_of(scene.drivers[0]).of(value))
    return Scheme(name, scene, shown, drivers, places)


def read_at(
    place: str, value: float, scene: Mechanism, report: Report, asked: Sequence[Symbol]
) -> PlaceValues:
    """The readings at a position, in scene units; 0 where the exact value is rounding alone."""
    read, exact = dict[Symbol, float](), dict[Symbol, float]()
    for row in report.rows:
        symbol, unit = row.symbol, row.symbol.unit(scene.units)
        if symbol in asked:
            drawn, true = (abs(v) if symbol.is_vector else float(v.real) for v in (row.reading.value, row.true))
            read[symbol] = float(unit.of(drawn)) if row.true else 0.0
            exact[symbol] = float(unit.of(true))
    return PlaceValues(place, scene.unit_of(scene.drivers[0]).of(value), read, exact)


def scheme_for(who: Student, course: Mapping[str, Scheme]) -> Scheme:
    """The scheme of a student; with a single scheme the table's entry is the name of a group."""
    return course[who.scheme if who.scheme in course else next(iter(course))]


def dealt_out(students: str | os.PathLike[str], course: Mapping[str, Scheme]) -> Iterator[Student]:
    """Every student with a scheme and a position of it.

    Raises CallError for a table without names, and for all unknown schemes and positions.
    """
    table = table_of(students)
    columns = {
        role: i for role, names in HEADS.items() for i, head in reversed(tuple(enumerate(table.heads)))
        if head.strip().lower() in names
    }  # fmt: skip
    if "name" not in columns and "id" not in columns:
        raise CallError.of(str(students), "no column of names", "write a head name or id",
                           names=some_of(table.heads))
    problems: list[Problem] = []
    head = table.heads[columns["scheme"]].strip().lower() if "scheme" in columns else ""
    may_be_groups = len(course) == 1 and head in GROUPS
    if head and "" in course and not may_be_groups:
        named = dict.fromkeys(cells[columns["scheme"]] for _, cells in table.rows if len(cells) > columns["scheme"])
        if schemes := [*filter(None, named)]:
            found, wanted = (
                Phrase("schemes without their data", schemes=some_of(schemes)),
                Phrase("give a row for each rows file.csv"),
            )
            raise CallError.of(f"{students}, {head}", found, wanted)
    listed = []
    for line, cells in table.rows:
        who = Student(**{role: cells[i] if i < len(cells) else "" for role, i in columns.items()})
        where = Phrase("line of students and line", students=students, line=line)
        if who.scheme and who.scheme not in course and not may_be_groups:
            problems.append(Problem(where, "there is no scheme", did_you_mean(who.scheme, course), scheme=who.scheme))
            continue
        known = scheme_for(who, course).places if who.scheme or len(course) == 1 else None
        all_known = dict.fromkeys(n for scheme in course.values() for n in scheme.places) if known is None else known
        if who.place and who.place not in all_known:
            problems.append(Problem(where, "there is no position", did_you_mean(who.place, all_known), at=who.place))
            continue
        if who.place and known is not None and not known[who.place].read:
            problems.append(Problem(where, "position cannot be drawn", "give another one", place=who.place))
        listed.append(who)
    if problems:
        raise CallError(*problems)
    free = {name: [p for p, v in scheme.places.items() if v.read] for name, scheme in course.items()}
    if not any(free.values()):
        raise CallError.of("positions", "none of them can be drawn", "give others in positions")
    taken: dict[str, list[str]] = {}
    for who in listed:
        if who.place and (who.scheme or len(course) == 1):
            taken.setdefault(scheme_for(who, course).name, []).append(who.place)
    for who in listed:
        if not who.scheme and len(course) > 1:
            # the first scheme with a position left, and when all are dealt out from the start again
            rounds = {n: len(taken.get(n, ())) // max(1, len(free[n])) for n in free}
            alike = {n: taken.get(n, []).count(who.place) for n in free}
            who = replace(who, scheme=min(free, key=lambda n: (alike[n], rounds[n])))
            if who.place:
                taken.setdefault(who.scheme, []).append(who.place)
        if not who.place:
            scheme = scheme_for(who, course).name
            places_taken, places = taken.setdefault(scheme, []), free[scheme]
            who = replace(who, place=min(places, key=places_taken.count))
            places_taken.append(who.place)
        yield who


def asked_in_tables(scene: Mechanism, asked: Iterable[Symbol]) -> tuple[Symbol, ...]:
    """The quantities in the tables: those asked of the position itself, else the motion of the last joint and the rates
    of links about fixed pivots, else every velocity and acceleration that is read."""
    here = (s for s in asked if s.scope in ("motion", "position", "force") and not s.at)
    kept = tuple(here) or asked_of(scene.asking(find=()))
    if kept:
        return kept
    drawn = (reading.symbol for reading in read_off(execute(paper_plan(scene, None, ()))))
    return tuple(s for s in drawn if s.scope == "motion" and s.to is None and s.kind in ("v", "a", "omega", "alpha"))


def class_table(scene: Mechanism, rows: Sequence[Placed], asked: Sequence[Symbol]) -> Table:
    heads = ["name", "id", "variant", "position", "at"]
    heads += [head for s in asked for head in (head_of(s, scene.units), f"{s} exact")]
    lines = [
        (student.name, student.id, student.scheme, student.place, values.driver,
         *(v for s in asked for v in (values.read.get(s), values.exact.get(s))))
        for student, values in rows
    ]  # fmt: skip
    return Table.of(heads, lines, ("", "", "", "", ".9g", *[".9g"] * (2 * len(asked))))
