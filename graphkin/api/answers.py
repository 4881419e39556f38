"""Answers of several people: a table with a row for each, from a CSV file or a mapping, as people write them."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

from graphkin.api.arguments import asked_symbols
from graphkin.errors import CallError, Problem
from graphkin.scene.asked import spelling_of
from graphkin.scene.model import Mechanism
from graphkin.scene.spelling import Way, is_blank, plain_text, read_cell, read_way, unit_factor
from graphkin.scene.symbol import KINDS, Printed, Symbol, Unreadable
from graphkin.table import Rows, table_of
from graphkin.words import Phrase, Wording

__all__ = ["Answers", "AnswersLike", "Cell", "as_answers"]

Role = Literal["at", "variant", "person", "id", "equations", "drawing"]
AnswersLike = str | os.PathLike[str] | Mapping[str, Mapping[str, object]]

_QUANTITY = re.compile(rf"({'|'.join(KINDS)})_")
_WAY = re.compile(r"direction|sense|angle|dir\b|arg|方向|转向|角度|指向|∠", re.IGNORECASE)
_OTHER_COLUMNS: Mapping[Role, set[str]] = {
    "at": {"at", "position", "driver", "位置", "position no", "φ1", "phi_1"},
    "variant": {"variant", "version", "variante", "变式", "题号", "题目编号", "试题", "no. of problem"},
    "person": {"name", "student", "person", "姓名", "学生", "学生姓名", "full name", "student name", "group", "组",
               "组号", "小组"},
    "id": {"id", "student id", "student no", "student no.", "number", "学号", "matriculation", "matr", "matr.",
           "考号", "编号"},
    "equations": {"equations", "vector equations", "方程", "矢量方程"},
    "drawing": {"drawing", "drawings", "作图", "图", "图形"},
}  # fmt: skip


Cell = Printed | tuple[str, Phrase] | None
"""A stated value; the text of a cell that nobody can read, and why; nothing where nothing was answered."""


@dataclass(frozen=True)
class Answers:
    """What one person states, at which driver value or named position (None: the scene's, or that of the call), and how
    it was found.

    ``cells`` stand in the order of the columns; ``variant`` is the name of the problem that was the person's ("" for
    the scene itself), ``id`` another name of theirs, ``marks`` what a teacher gave (points by part).
    """

    person: str
    at: float | str | None
    cells: Mapping[Symbol, Cell]
    by: str = "drawing"
    variant: str = ""
    id: str = ""
    marks: Mapping[str, float] = field(default_factory=dict)

    @property
    def values(self) -> tuple[Printed, ...]:
        """The values that can be judged."""
        return tuple(cell for cell in self.cells.values() if isinstance(cell, Printed))


def as_answers(scene: Mechanism, given: AnswersLike) -> tuple[tuple[Answers, ...], tuple[str, ...]]:
    """The answers in a CSV file, or in a mapping from person to values by symbol.

    The file has a line of heads: symbols as people spell them ("v_D", "ω3", "v_B3"), with or without a unit; behind
    one, or with its name, a column of directions or senses; ``at`` for the driver's value where rows are positions,
    ``variant``, ``name``, ``id``, and points already given for ``equations`` and ``drawing``.  Of other heads the first
    names the person where none of these does; the rest is left alone.  A unit in a cell counts more than that of its
    head, and that more than the scene's.  A vector is its size, with or without a direction, or two numbers.  An empty
    cell is no answer; one that cannot be read is a verdict of its own.

    Returns
    -------
    The answers of each row, and the heads that were left alone

    Raises
    ------
    CallError : everything that is wrong with the table itself, by line and column
    """
    if isinstance(given, Mapping):
        strange = [name for name, values in given.items() if not isinstance(values, Mapping)]
        if strange:
            raise CallError.of(Phrase("answers of", name=strange[0]), "found value", "give v_d 480",
                               value=f'{given[strange[0]]!r:.60}')
        heads = list(dict.fromkeys(s for values in given.values() for s in values))
        rows = [(i, (name, *(_text(v.get(h, "")) for h in heads))) for i, (name, v) in enumerate(given.items(), 1)]
        # who says nothing of a quantity was not asked for it
        silent = {i: frozenset(h for h in heads if h not in v) for i, v in enumerate(given.values(), 1)}
        return _answers(scene, Rows(("person", *heads), tuple(rows)), "answers", silent)
    return _answers(scene, table_of(given), str(given), {})


@dataclass(frozen=True)
class _Columns:
    """What the columns of a table are: values with their units, directions by symbol, and the others by role."""

    values: Mapping[int, Symbol]
    units: Mapping[int, str]
    ways: Mapping[int, Symbol]
    roles: Mapping[Role, int]
    unused: tuple[str, ...]

    def cell(self, role: Role, cells: Sequence[str]) -> str:
        """The cell of a role, "" where the table has none."""
        i = self.roles.get(role)
        return cells[i] if i is not None and i < len(cells) else ""


def _columns(scene: Mechanism, heads: Sequence[str], name: str, problems: list[Problem]) -> _Columns:
    spelling = spelling_of(scene)
    values: dict[int, Symbol] = {}
    units: dict[int, str] = {}
    ways: dict[int, Symbol] = {}
    roles: dict[Role, int] = {}
    others: list[int] = []
    for i, head in enumerate(heads):
        role = _role(head)
        if role is not None and role not in roles:
            roles[role] = i
            continue
        told = _WAY.search(head)
        text, unit = spelling.head(_WAY.sub("", head).strip(" _-:") if told else head)
        symbol = spelling.symbol(re.sub(r"\bof\b", "", text).strip())
        if told and symbol is None and not _QUANTITY.match(text) and values and i - 1 in values:
            symbol = values[i - 1]
        if symbol is not None and told:
            ways[i] = symbol
            continue
        if symbol is None:
            if _QUANTITY.match(text):
                problems += _unknown(scene, text, Phrase("column", name=name, head=head))
            elif head:
                others.append(i)
            continue
        problems += _unknown(scene, str(symbol), Phrase("column", name=name, head=head))
        if unit and unit_factor(unit, symbol, scene.units) is None:
            wanted = Phrase("give it in", unit=symbol.unit(scene.units).text)
            problems.append(
                Problem(
                    Phrase("column", name=name, head=head),
                    Phrase("is no unit of", unit=unit, measure=symbol.measure),
                    wanted,
                )
            )
        if symbol in values.values():
            problems.append(Problem(Phrase("column", name=name, head=head), "stands twice", "keep one of them"))
        values[i], units[i] = symbol, unit
    if "person" not in roles and others:
        roles["person"] = others.pop(0)
    if "person" not in roles and "id" in roles:
        roles["person"] = roles.pop("id")
    return _Columns(values, units, ways, roles, tuple(heads[i] for i in others))


def _role(head: str) -> Role | None:
    plain = plain_text(head).lower().strip()
    return next((role for role, names in _OTHER_COLUMNS.items() if plain in names), None)


def _unknown(scene: Mechanism, text: str, where: Wording) -> list[Problem]:
    try:
        asked_symbols(scene, [text])
    except CallError as error:
        return [Problem(where, p.found, p.wanted) for p in error.problems]
    return []


def _answers(
    scene: Mechanism, sheet: Rows, name: str, silent: Mapping[int, frozenset[str]]
) -> tuple[tuple[Answers, ...], tuple[str, ...]]:
    problems: list[Problem] = []
    columns = _columns(scene, sheet.heads, name, problems)
    if not columns.values and not problems:
        problems.append(Problem(name, "no column is a quantity", "write symbols as heads for example v_d or",
                                names=', '.join(sheet.heads)[:200]))
    places = [own for _, cells in sheet.rows if (own := columns.cell("at", cells))]
    # numbers are driver values, unless all of them are names of positions
    positions = scene.question.positions
    by_name = positions is not None and bool(places) and set(places) <= set(positions.names)
    found = []
    for line, cells in sheet.rows:
        at: float | str | None = None
        text = columns.cell("at", cells)
        if text:
            try:
                at = text if by_name else _plain_number(text, sheet.sign)
            except ValueError:
                problems.append(Problem(Phrase("line at", name=name, line=line), "is no driver value", text=text[:40]))
        found.append(_row(scene, sheet, columns, line, cells, at, silent.get(line, frozenset())))
    if problems:
        raise CallError(*problems[:50])
    return tuple(found), columns.unused


def _row(
    scene: Mechanism, sheet: Rows, columns: _Columns, line: int, cells: Sequence[str], at: float | str | None,
    silent: frozenset[str],
) -> Answers:  # fmt: skip
    made: dict[Symbol, Cell] = {}
    ways: dict[Symbol, Way] = {}
    bad: dict[Symbol, Unreadable] = {}
    for i, symbol in columns.ways.items():
        text = cells[i] if i < len(cells) else ""
        if not is_blank(text):
            try:
                ways[symbol] = read_way(text, symbol)
            except Unreadable as error:
                bad[symbol] = error
    for i, symbol in columns.values.items():
        if sheet.heads[i] in silent:
            continue
        text = cells[i] if i < len(cells) else ""
        try:
            if symbol in bad and not is_blank(text):
                raise bad[symbol]
            way, unit = ways.get(symbol), columns.units[i]
            made[symbol] = None if is_blank(text) else read_cell(text, symbol, scene.units, unit, sheet.sign, way)
        except Unreadable as error:
            made[symbol] = text, error.phrase
    person = columns.cell("person", cells)
    marks = {role: _mark(columns.cell(role, cells)) for role in ("equations", "drawing") if role in columns.roles}
    name = person or ("" if at is not None else str(Phrase("line", line=line)))
    other = columns.cell("id", cells) if "id" in columns.roles else ""
    known = {role: mark for role, mark in marks.items() if mark is not None}
    return Answers(name, at, made, variant=columns.cell("variant", cells), id=other, marks=known)


def _mark(text: str) -> float | None:
    try:
        return _plain_number(text, ";") if text else None
    except ValueError:
        return None


def _plain_number(text: str, sign: str) -> float:
    plain = plain_text(text).rstrip("°").strip()
    return float(plain if sign == "," else plain.replace(",", "."))


def _text(value: object) -> str:
    if isinstance(value, list | tuple):
        return "; ".join(str(v) for v in value)
    return "" if value is None else str(value)
