"""The schemes of a course with all their positions, and which of them each student draws."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from graphkin import solver
from graphkin.api.answers import table_of
from graphkin.api.arguments import SceneLike, as_scene, asked_symbols, for_paper
from graphkin.api.checked import solved_here
from graphkin.checking.readings import read_off
from graphkin.checking.report import compare, rounding_of
from graphkin.construction import execute
from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean
from graphkin.papers.course_design import PlaceValues, Student, value_read
from graphkin.papers.lesson import Lesson
from graphkin.papers.paper import paper_plan
from graphkin.papers.prepare import positions
from graphkin.papers.variants import asked_of
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver.named_positions import named_positions
from graphkin.words import Phrase

__all__ = ["Scheme", "asked_in_tables", "dealt_out", "read_at", "scheme_name", "scheme_of"]

HEADS: Mapping[str, tuple[str, ...]] = {
    "name": ("name", "student", "姓名", "学生"),
    "id": ("id", "number", "no", "学号"),
    "scheme": ("scheme", "variant", "group", "方案", "组", "组别"),
    "place": ("position", "at", "位置"),
}


GROUPS = ("group", "组", "组别")
"""Heads of schemes that may be meant as groups of students who all have the same lengths."""


@dataclass(frozen=True)
class Scheme:
    """One mechanism of a course: its positions (SI values of the first driver) and what was read off at each."""

    name: str
    scene: Mechanism
    drivers: Mapping[str, float]
    places: Mapping[str, PlaceValues]

    def values(self, place: str) -> dict[str, float]:
        """Driver values (rad, m) at a position."""
        return {self.scene.drivers[0].key: self.drivers[place]}


def scheme_of(name: str, source: SceneLike, find: Iterable[str | Symbol] | None, count: int) -> Scheme:
    """A mechanism with all its positions, each drawn and held against the solver."""
    scene = for_paper(as_scene(source))
    structure = solver.structure_of(scene)
    key = scene.drivers[0].key
    named = named_positions(scene)
    if named is not None and named.names.names:
        drivers = dict(named.values)
    else:
        drivers = {str(k): row[key] for k, row in enumerate(positions(structure, None, count)[0], 1)}
    asked = asked_in_tables(scene, find)
    places = {}
    for place, value in drivers.items():
        try:
            motion = solved_here(structure, {key: value})
            sheet = execute(paper_plan(structure, {key: value}, asked))
            motion = solver.as_drawn(motion, sheet.structure)
            exact = solver.exact_values(motion, asked)
            report = compare(sheet, read_off(sheet), exact, asked, rounding=rounding_of(motion))
            report.must_agree(scene)
            lesson = Lesson(sheet, report, {}, "en", "chinese", asked)
            places[place] = read_at(place, value, lesson, asked)
        except Unsolvable:
            places[place] = PlaceValues(place, scene.unit_of(scene.drivers[0]).of(value))
    return Scheme(name, scene, drivers, places)


def read_at(place: str, value: float, lesson: Lesson, asked: Sequence[Symbol]) -> PlaceValues:
    """What was read off at a position, in scene units."""
    rows = [row for row in lesson.report.rows if row.symbol in asked]
    read = {row.symbol: value_read(lesson, row) for row in rows}
    exact = {
        row.symbol: lesson.in_unit(row.symbol, abs(row.true) if row.symbol.is_vector else float(row.true.real))
        for row in rows
    }
    return PlaceValues(place, lesson.sheet.scene.unit_of(lesson.sheet.scene.drivers[0]).of(value), read, exact)


def scheme_name(course: Mapping[str, Scheme], who: Student) -> str:
    """The scheme of a student; where there is but one, what stands in the table is the name of a group."""
    return who.scheme if who.scheme in course else next(iter(course))


def dealt_out(students: str | os.PathLike[str], course: Mapping[str, Scheme]) -> Iterator[Student]:
    """Every student with a scheme and a position of it.

    Raises CallError for a table without names, and all schemes and positions that there are not.
    """
    table = table_of(students)
    columns = {
        role: i for role, names in HEADS.items() for i, head in reversed(tuple(enumerate(table.heads)))
        if head.strip().lower() in names
    }  # fmt: skip
    if "name" not in columns and "id" not in columns:
        found = Phrase("no column of names", names=', '.join(table.heads)[:200])
        raise CallError(Problem(str(students), found, Phrase("write a head name or id")))
    problems: list[Problem] = []
    head = table.heads[columns["scheme"]].strip().lower() if "scheme" in columns else ""
    may_be_groups = len(course) == 1 and head in GROUPS
    if head and "" in course and not may_be_groups:
        named = dict.fromkeys(cells[columns["scheme"]] for _, cells in table.rows if len(cells) > columns["scheme"])
        if schemes := ", ".join(filter(None, named))[:80]:
            found, wanted = (
                Phrase("schemes without their data", schemes=schemes),
                Phrase("give a row for each rows file.csv"),
            )
            raise CallError(Problem(f"{students}, {head}", found, wanted))
    listed = []
    for line, cells in table.rows:
        who = Student(**{role: cells[i] if i < len(cells) else "" for role, i in columns.items()})
        where = Phrase("line of students and line", students=students, line=line)
        if who.scheme and who.scheme not in course and not may_be_groups:
            problems.append(
                Problem(where, Phrase("there is no scheme", scheme=who.scheme), did_you_mean(who.scheme, course))
            )
            continue
        known = course[scheme_name(course, who)].places if who.scheme or len(course) == 1 else None
        all_known = dict.fromkeys(n for one in course.values() for n in one.places) if known is None else known
        if who.place and who.place not in all_known:
            problems.append(
                Problem(where, Phrase("there is no position", at=who.place), did_you_mean(who.place, all_known))
            )
            continue
        if who.place and known is not None and not known[who.place].read:
            problems.append(
                Problem(where, Phrase("position cannot be drawn", place=who.place), Phrase("give another one"))
            )
        listed.append(who)
    if problems:
        raise CallError(*problems)
    free = {name: [p for p, v in one.places.items() if v.read] for name, one in course.items()}
    if not any(free.values()):
        raise CallError(Problem("positions", Phrase("none of them can be drawn"), Phrase("give others in positions")))
    taken: dict[str, list[str]] = {}
    for who in listed:
        if who.place:
            taken.setdefault(who.scheme, []).append(who.place)
    for who in listed:
        if not who.scheme and len(course) > 1:
            # the first scheme with a position left, and when all are dealt out from the start again
            name = min(free, key=lambda n: len(taken.get(n, ())) // max(1, len(free[n])))
            who = replace(who, scheme=name)
        if not who.place:
            own = taken.setdefault(who.scheme, [])
            places = free[scheme_name(course, who)]
            who = replace(who, place=min(places, key=own.count))
            own.append(who.place)
        yield who


def asked_in_tables(scene: Mechanism, find: Iterable[str | Symbol] | None) -> tuple[Symbol, ...]:
    """What the tables show: what is asked of the position itself, else the motion of the last joint and the rates of
    what turns about fixed pivots, else every velocity and acceleration that is read off."""
    asked = (s for s in asked_symbols(scene, find) if s.scope in ("motion", "position", "force") and not s.at)
    kept = tuple(asked) or asked_of(replace(scene, find=()))
    if kept:
        return kept
    drawn = (reading.symbol for reading in read_off(execute(paper_plan(scene, None, ()))))
    return tuple(s for s in drawn if s.scope == "motion" and s.to is None and s.kind in ("v", "a", "omega", "alpha"))
