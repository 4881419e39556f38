"""Answers of several people: a table with a row for each, from a CSV file or a mapping, as people write them."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from graphkin.errors import CallError, Problem, some_of
from graphkin.scene.asked import known_symbol, spelling_of
from graphkin.scene.model import Mechanism, no_force
from graphkin.scene.spelling import is_blank, plain_text, read_cell, read_way, unit_factor
from graphkin.scene.symbol import KINDS, Printed, Symbol
from graphkin.table import Rows, pointed, style_of, table_of
from graphkin.words import Phrase, Wording

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
}


Cell = Printed | tuple[str, Phrase] | None
"""A stated value; the text of a cell that nobody can read, and why; nothing where nothing was answered."""


@dataclass(frozen=True)
class Answers:
    """The values of a person, their driver value or named position (None: the scene's, or the call's), and how found.

    ``cells`` stand in the order of the columns; ``variant`` is the name of the person's problem ("" for the scene
    itself), ``id`` their number, ``marks`` the points that a teacher gave, by part.
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
    names the person where none of these does; the rest is unused.  A unit in a cell goes before the unit of its head,
    and that before the scene's.  A vector is its size, with or without a direction, or two numbers.  An empty cell is
    no answer; an unreadable cell has a verdict of its own.

    Returns
    -------
    The answers of each row, and the unused heads

    Raises
    ------
    CallError : all problems of the table itself, by line and column
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


def stated_answers(scene: Mechanism) -> tuple[Answers, ...]:
    """The values stated in a scene's own tables, a row for each position."""
    answers: list[Answers] = []
    for stated in scene.question.stated:
        if stated.file:
            rows, _ = as_answers(scene, stated.file)
            answers += [replace(row, person="", by=stated.by) for row in rows]
            continue
        for place in dict.fromkeys(symbol.at for symbol in stated.values):
            there = (replace(p, symbol=s.here) for s, p in stated.values.items() if s.at == place)
            answers.append(Answers("", place or stated.at, {p.symbol: p for p in there}, stated.by))
    return tuple(answers)


def with_signs(people: Sequence[Answers]) -> tuple[Answers, ...]:
    """The answers with the numbers of a column signed where one of them has a written sign."""
    signed = {
        (who.person, who.variant, who.by, p.symbol)
        for who in people for p in who.values if p.shows_sign and p.way.angle is None and not p.way.lines
    }
    if not signed:
        return tuple(people)

    def told(who: Answers, cell: Cell) -> Cell:
        if not isinstance(cell, Printed):
            return cell
        return replace(cell, signed=(who.person, who.variant, who.by, cell.symbol) in signed)

    return tuple(replace(who, cells={s: told(who, cell) for s, cell in who.cells.items()}) for who in people)


def _answers(
    scene: Mechanism, sheet: Rows, name: str, silent: Mapping[int, frozenset[str]]
) -> tuple[tuple[Answers, ...], tuple[str, ...]]:
    problems: list[Problem] = []
    values, directions, roles = _columns(scene, sheet.heads, name, problems)
    others = [i for i, head in enumerate(sheet.heads) if head and i not in {*values, *directions, *roles.values()}]
    if "person" not in roles and others:
        roles["person"] = others.pop(0)
    if "person" not in roles and "id" in roles:
        roles["person"] = roles.pop("id")
    if not values and not problems:
        problems.append(Problem(name, "no column is a quantity", "write symbols as heads for example v_d or",
                                names=some_of([*filter(None, sheet.heads)])))
    rows = [(line, (*cells, *[""] * (len(sheet.heads) - len(cells)))) for line, cells in sheet.rows]
    places = {cells[roles["at"]] for _, cells in rows if "at" in roles} - {""}
    # numbers are driver values, unless all of them are names of positions
    positions = scene.question.positions
    by_name = positions is not None and bool(places) and places <= set(positions.names)
    by_signs = {i for i in directions if any(plain_text(cells[i]) == "+" for _, cells in rows)}  # there - is no blank

    def read(line: int, cells: Sequence[str], style: str) -> dict[Symbol, Cell]:
        made: dict[Symbol, Cell] = {}
        for i, (symbol, unit) in values.items():
            if sheet.heads[i] not in silent.get(line, ()):
                columns = [(k, cells[k], unit) for k, (of, unit) in directions.items() if of == symbol and cells[k]]
                stated = [(text, unit) for k, text, unit in columns if k in by_signs or not is_blank(text)]
                made[symbol] = _cell(scene, symbol, unit, cells[i], stated, style)
        return made

    usual = "." if sheet.sign == "," else ""
    first = [read(line, cells, usual) for line, cells in rows]
    texts = [  # of single numbers: a comma of two components tells nothing
        [c[i] for i, (s, _) in values.items() if isinstance(cell := made.get(s), Printed) and len(cell.texts) == 1]
        for made, (_, c) in zip(first, rows, strict=True)
    ]
    whole, answers = style_of(text for row in texts for text in row).strip("?") or usual, []
    for (line, cells), made, row in zip(rows, first, texts, strict=True):
        notes, at = {role: cells[i] for role, i in roles.items()}, None
        style = style_of(row) or whole  # who writes 1075,8 means a decimal by 2,819 too
        if text := notes.get("at", ""):
            try:
                at = text if by_name else _plain_number(text, style)
            except ValueError:
                problems.append(Problem(Phrase("line at", name=name, line=line), "is no driver value", text=text[:40]))
        person = notes.get("person", "") or ("" if at is not None else str(Phrase("line", line=line)))
        marks = {part: mark for part in ("equations", "drawing") if (mark := _mark(notes.get(part, ""))) is not None}
        made = made if style == usual else read(line, cells, style)
        answers.append(Answers(person, at, made, variant=notes.get("variant", ""), id=notes.get("id", ""), marks=marks))
    if problems:
        raise CallError(*problems[:50])
    return tuple(answers), tuple(sheet.heads[i] for i in others)


def _cell(
    scene: Mechanism, symbol: Symbol, unit: str, text: str, beside: Sequence[tuple[str, str]], style: str
) -> Cell:
    """A cell with its direction or sense from other columns, each with the unit of its head."""
    if is_blank(text):
        return None
    try:
        way = next((read_way(stated, symbol, of_head) for stated, of_head in beside), None)
        cell = read_cell(text, symbol, scene.units, unit, style, way)
        if any(not line.two and scene.slide_on(line.one) is None for line in cell.way.lines):
            raise ValueError(Phrase("cell no direction", cell=text[:40]))
        return cell
    except ValueError as error:
        return text, error.args[0]


def _columns(
    scene: Mechanism, heads: Sequence[str], name: str, problems: list[Problem]
) -> tuple[dict[int, tuple[Symbol, str]], dict[int, tuple[Symbol, str]], dict[Role, int]]:
    """The columns of values, of directions and senses, both with their units, and others by role; problems of the heads
    are added to ``problems``."""
    spelling = spelling_of(scene)
    values: dict[int, tuple[Symbol, str]] = {}
    directions: dict[int, tuple[Symbol, str]] = {}
    roles: dict[Role, int] = {}
    for i, head in enumerate(heads):
        plain, where = plain_text(head).lower().strip(), Phrase("column", name=name, head=head)
        role = next((role for role, names in _OTHER_COLUMNS.items() if plain in names), None)
        if role is not None and role not in roles:
            roles[role] = i
            continue
        match = _WAY.search(head)
        text, unit = spelling.head(_WAY.sub("", head).strip(" _-:") if match else head)
        symbol = spelling.symbol(re.sub(r"\bof\b", "", text).strip())
        if match and symbol is None and not _QUANTITY.match(text) and i - 1 in values:
            symbol = values[i - 1][0]
        if symbol is not None and match:
            directions[i] = symbol, unit
        elif symbol is None:
            problems += _unknown(scene, text, where) if _QUANTITY.match(text) else []
        else:
            problems += _unknown(scene, str(symbol), where)
            if unit and unit_factor(unit, symbol, scene.units) is None:
                wanted = Phrase("give it in", unit=symbol.unit(scene.units).text)
                measure = Phrase(f"measure {symbol.measure.name}")
                problems.append(Problem(where, "is no unit of", wanted, unit=unit, measure=measure))
            if symbol in {known for known, _ in values.values()}:
                problems.append(Problem(where, "stands twice", "keep one of them"))
            values[i] = symbol, unit
    return values, directions, roles


def _unknown(scene: Mechanism, text: str, where: Wording) -> list[Problem]:
    known = known_symbol("", text, scene)
    wrong = [no_force(scene, "", known)] if isinstance(known, Symbol) else known
    return [Problem(where, problem.found, problem.wanted) for problem in wrong if problem is not None]


def _mark(text: str) -> float | None:
    try:
        return _plain_number(text, "") if text else None
    except ValueError:
        return None


def _plain_number(text: str, style: str) -> float:
    return float(pointed(plain_text(text).rstrip("°").strip(), style))


def _text(value: object) -> str:
    if isinstance(value, list | tuple):
        return "; ".join(str(v) for v in value)
    return "" if value is None else str(value)
