"""Answers of several people: a table with a row for each, from a CSV file or a mapping, as people write them."""

from __future__ import annotations

import csv
import io
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.api.arguments import asked_symbols
from graphkin.checking.printed import Printed, stated
from graphkin.errors import CallError, Problem
from graphkin.files import path_of
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import KINDS, Symbol
from graphkin.scene.tables import Units

__all__ = ["Answers", "AnswersLike", "as_answers", "table_of", "with_points"]

AnswersLike = str | os.PathLike[str] | Mapping[str, Mapping[str, object]]

LARGEST = 10_000_000
PLACE = "at"
_QUANTITY = re.compile(rf"({'|'.join(KINDS)})_")
_UNIT = re.compile(r"^(.*?)\s*[(（\[]([^)）\]]*)[)）\]]$")
_GREEK = {"ω": "omega", "α": "alpha", "θ": "theta", "γ": "gamma", "a": "a", "v": "v"}
_JOINED = re.compile(r"([ωαθ])_?([A-Za-z0-9]+)|([va])([A-Z][A-Za-z0-9]*)")
_NOTHING = {"", "-", "--", "–", "—", "/", "?", "？", "n/a", "na", "无"}
_DECIMAL = re.compile(r"[+\-\u2212]?\d+,\d+(?:[eE][+\-]?\d+)?")
_THOUSANDS = re.compile(r"[+\-\u2212]?\d{1,3}(?:,\d{3})+(?:\.\d+)?")
_MARKS = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}


@dataclass(frozen=True)
class Rows:
    """A table as read: its heads, its rows with the number of their line, and the sign between their cells."""

    heads: tuple[str, ...]
    rows: tuple[tuple[int, tuple[str, ...]], ...]
    sign: str = ","


@dataclass(frozen=True)
class Answers:
    """What one person states, at which driver value or named position (None: the scene's, or that of the call), and how
    it was found."""

    person: str
    at: float | str | None
    values: tuple[Printed, ...]
    by: str = "drawing"


def as_answers(scene: Mechanism, given: AnswersLike) -> tuple[tuple[Answers, ...], tuple[str, ...]]:
    """The answers in a CSV file, or in a mapping from person to values by symbol.

    The file has a line of heads: symbols ("v_D", "omega_3", also "ω3", with or without their unit), ``at`` for the
    driver's value where rows are positions, and any other word for who it is (the first such column counts).  Units
    are the scene's, rad/s, rad/s2.  A vector is one number, its size, or two with a blank or semicolon between.  A
    decimal comma is understood, where it cannot be one of thousands.  An empty cell is no answer.

    Returns
    -------
    The answers of each row, and the heads that were left alone

    Raises
    ------
    CallError : everything that is wrong with the table, by line and column
    """
    if isinstance(given, Mapping):
        strange = [name for name, values in given.items() if not isinstance(values, Mapping)]
        if strange:
            found = f"found {given[strange[0]]!r:.60}"
            raise CallError(Problem(f"answers of {strange[0]}", found, 'give {"v_D": 480}'))
        heads = list(dict.fromkeys(s for values in given.values() for s in values))
        rows = [(i, (name, *(_text(v.get(h, "")) for h in heads))) for i, (name, v) in enumerate(given.items(), 1)]
        return _answers(scene, Rows(("person", *heads), tuple(rows)), "answers")
    return _answers(scene, table_of(given), str(given))


def table_of(path: str | os.PathLike[str]) -> Rows:
    """A CSV file in UTF-8, or in GB 18030 as Chinese spreadsheets write it; commas, semicolons or tabs part the cells.

    Raises CallError.
    """
    shown = str(path)[:200]
    try:
        with path_of(path).open("rb") as stream:
            data = stream.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise CallError(Problem(shown, f"cannot be read: {reason}", "name a CSV file")) from None
    if len(data) > LARGEST:
        raise CallError(Problem(shown, f"is larger than {LARGEST // 1_000_000} MB", "give fewer rows"))
    text = ""
    for encoding in (_MARKS.get(data[:2], "utf-8-sig"), "gb18030"):
        try:
            text = data.decode(encoding)
            break
        except UnicodeDecodeError:
            continue
    first = text.split("\n", 1)[0]
    sign = max(",;\t", key=first.count)
    try:
        reader = csv.reader(io.StringIO(text), delimiter=sign, strict=True)
        lines = [(reader.line_num, tuple(c.strip() for c in row)) for row in reader if any(c.strip() for c in row)]
    except csv.Error as error:
        raise CallError(Problem(shown, f"is no table: {error}", "save it as CSV")) from None
    if len(lines) < 2:
        raise CallError(Problem(shown, "has no rows", "write a line of heads, and a line for each row"))
    return Rows(lines[0][1], tuple(lines[1:]), sign)


def with_points(sheet: Rows) -> Rows:
    """A table with decimal points, where commas do not part its cells."""
    if sheet.sign == ",":
        return sheet
    rows = ((line, tuple(re.sub(r"(?<=\d),(?=\d)", ".", cell) for cell in cells)) for line, cells in sheet.rows)
    return Rows(sheet.heads, tuple(rows), sheet.sign)


def _answers(scene: Mechanism, sheet: Rows, name: str) -> tuple[tuple[Answers, ...], tuple[str, ...]]:
    symbols: dict[int, Symbol] = {}
    problems: list[Problem] = []
    for i, head in enumerate(sheet.heads):
        text, unit = head_of(head)
        if not _QUANTITY.match(text):
            continue
        try:
            (symbol,) = asked_symbols(scene, [text])
        except CallError as error:
            problems += [Problem(f"{name}, column {head}", p.found, p.wanted) for p in error.problems]
            continue
        wanted = unit_of(symbol, scene.units)
        if unit and unit != wanted:
            problems.append(Problem(f"{name}, column {head}", f"is in {unit}", f"give it in {wanted}"))
        if symbol in symbols.values():
            problems.append(Problem(f"{name}, column {head}", "stands twice", "keep one of them"))
        symbols[i] = symbol
    if not symbols and not problems:
        known = "write symbols as heads, for example v_D or omega_3"
        problems.append(Problem(name, f"no column is a quantity: {', '.join(sheet.heads)[:200]}", known))
    who = next((i for i, h in enumerate(sheet.heads) if i not in symbols and h != PLACE), None)
    where = sheet.heads.index(PLACE) if PLACE in sheet.heads else None
    places = [cells[where] for _, cells in sheet.rows if where is not None and where < len(cells) and cells[where]]
    # numbers are driver values, unless all of them are names of positions
    by_name = scene.positions is not None and bool(places) and set(places) <= set(scene.positions.names)
    found = []
    for line, cells in sheet.rows:
        values = []
        for i, symbol in symbols.items():
            text = cells[i] if i < len(cells) else ""
            if not is_blank(text):
                try:
                    numbers = numbers_in(text, unit_of(symbol, scene.units), sheet.sign)
                    if len(numbers) > (2 if symbol.is_vector else 1):
                        raise ValueError(f'"{text[:40]}" is more than one number')
                    values.append(stated(symbol, numbers, scene.units))
                except ValueError as error:
                    problems.append(Problem(f"{name}, line {line}, {symbol}", str(error), "write a number alone"))
        at: float | str | None = None
        if where is not None and where < len(cells) and cells[where]:
            try:
                at = cells[where] if by_name else float(numbers_in(cells[where], "", sheet.sign)[0])
            except ValueError:
                problems.append(Problem(f"{name}, line {line}, at", f'"{cells[where][:40]}" is no driver value'))
        person = cells[who] if who is not None and who < len(cells) else ""
        found.append(Answers(person or ("" if at is not None else f"line {line}"), at, tuple(values)))
    if problems:
        raise CallError(*problems[:50])
    unused = tuple(h for i, h in enumerate(sheet.heads) if h and i not in symbols and i != who and h != PLACE)
    return tuple(found), unused


def _text(value: object) -> str:
    if isinstance(value, list | tuple):
        return "; ".join(str(v) for v in value)
    return "" if value is None else str(value)


# heads and cells as people write them: units, Greek letters, decimal commas, signs for nothing


def unit_of(symbol: Symbol, units: Units) -> str:
    """The unit in which a quantity is stated."""
    return symbol.unit(units)


def head_of(head: str) -> tuple[str, str]:
    """The name in a head and its unit, "" if none is written.

    >>> head_of("ω3 [rad/s]"), head_of("a_D（mm/s²）"), head_of("vD")
    (('omega_3', 'rad/s'), ('a_D', 'mm/s2'), ('v_D', ''))
    """
    match = _UNIT.match(head)
    name, unit = (match[1], match[2]) if match else (head, "")
    joined = _JOINED.fullmatch(name)
    if joined:
        letter, rest = (joined[1], joined[2]) if joined[1] else (joined[3], joined[4])
        name = f"{_GREEK[letter]}_{rest}"
    return name.strip(), _plain_unit(unit)


def _plain_unit(unit: str) -> str:
    return re.sub(r"\^|\s", "", unit.replace("²", "2")).lower()


def is_blank(text: str) -> bool:
    """Whether a cell says that there is no answer."""
    return text.strip().lower() in _NOTHING


def numbers_in(text: str, unit: str, sign: str) -> list[str]:
    """The numbers of a cell, parted by blanks or semicolons, with decimal points.

    Parameters
    ----------
    unit : what may stand behind the number
    sign : what parts the cells of the table; where that is a comma, one in a number may be one of thousands

    Raises
    ------
    ValueError : a comma that may be either

    >>> numbers_in("482,7", "mm/s", ";"), numbers_in("(-482.7; 0) mm/s", "mm/s", ",")
    (['482.7'], ['-482.7', '0'])
    """
    bare = text.strip()
    if unit and _plain_unit(bare).endswith(unit):
        letters = re.search(r"[^\d\s.,;)\]][^\d]*\s*/\s*s\s*\^?[2²]?$", bare)
        bare = bare[: letters.start()] if letters else bare
    parts = [p for p in re.split(r"[;\s]+", bare.strip("[]() ")) if p]
    return [_pointed(part, sign) for part in parts]


def _pointed(number: str, sign: str) -> str:
    if sign == "," and _THOUSANDS.fullmatch(number):
        if number.count(",") == 1 and "." not in number:
            plain, decimal = number.replace(",", ""), number.replace(",", ".")
            raise ValueError(f'"{number[:40]}" may be {plain} or {decimal}')
        return number.replace(",", "")
    return number.replace(",", ".") if _DECIMAL.fullmatch(number) else number
