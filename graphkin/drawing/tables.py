"""Tables of a sheet: the readings with their check, and the given data."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from graphkin.account.given import (
    fixed_guides,
    given_drivers,
    given_lengths,
    given_shapes,
    given_teeth,
    place_of,
    rolling_starts,
)
from graphkin.account.headings import remarks, term
from graphkin.account.notation import Notation
from graphkin.account.voice import Account
from graphkin.checking.report import Compared, Report, deviation, exact, measured, paper
from graphkin.construction.board.sheet import Reading, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import Block, row, table
from graphkin.drawing.ink.primitives import Primitive, Run, Text
from graphkin.drawing.text import rich, runs_width, wrapped
from graphkin.scene.tables import Units
from graphkin.words import languages, word
from graphkin.words.symbols import RichText, Words, rate
from graphkin.words.written import printed

ROW, LEAST_ROW, GUTTER = 4.2, 3.75, 4.0  # mm
_LETTERS = {"v": 0, "omega": 1, "a": 2, "alpha": 4}
_SHARES = (0.26, 0.18, 0.19, 0.19, 0.18)  # of the width: symbol, mm on paper, measured, exact, difference


@dataclass(frozen=True)
class TableRow:
    compared: Compared
    more: tuple[str, ...] = ()  # further links that turn alike

    @property
    def rank(self) -> int:
        """Order in the table: positions, velocities, rates, accelerations and their parts, rates."""
        return -1 if self.compared.symbol.scope != "motion" else _LETTERS.get(self.compared.symbol.kind, 3)


def readings_table(
    sheet: Sheet, rows: Sequence[TableRow], letters: Notation, language: str, area: Box
) -> tuple[Block, int]:
    """Readings in columns as wide as an area (mm): symbol, on paper, measured, exact, difference; how many fit."""
    count, columns, row_height = _grid(len(rows), area, len(languages(language)))
    rows = rows[: max(0, count)]
    width = (area.width - GUTTER * (columns - 1)) / columns
    per_column = max(1, math.ceil(len(rows) / columns))
    return row(*(
        _column(sheet, rows[k : k + per_column], letters, language, width, row_height)
        for k in range(0, len(rows), per_column)
    ), gap=GUTTER), len(rows)


def table_rows(report: Report) -> list[TableRow]:
    """The readings of the table in order: without given rates; links that turn alike share a row."""
    shown: list[TableRow] = []
    for compared in (compared for compared in report.rows if compared.symbol.scope != "force"):
        symbol = compared.symbol
        if symbol.is_vector or symbol.scope != "motion":
            shown.append(TableRow(compared))
            continue
        alike = next((i for i, row in enumerate(shown) if _alike(row.compared.reading, compared.reading)), None)
        if alike is not None:
            shown[alike] = replace(shown[alike], more=(*shown[alike].more, symbol.link))
        elif compared.on_paper:
            shown.append(TableRow(compared))
    return sorted(shown, key=lambda row: row.rank)


def _alike(first: Reading, second: Reading) -> bool:
    return (first.symbol.kind, first.value, first.on_paper) == (second.symbol.kind, second.value, second.on_paper)


def _grid(count: int, area: Box, heads: int) -> tuple[int, int, float]:
    """The number of rows that fit under the heads, the number of columns, and the height of a row."""
    widest = 3 if area.width > 170 else 2 if area.width > 100 else 1
    room = 0
    for columns in range(1, widest + 1):
        if area.width / columns > 95 and columns < widest:
            continue  # too wide to read across
        for height in (ROW, LEAST_ROW):
            room = int(area.height / height - 0.6 - 0.75 * heads) * columns
            if room >= count:
                return room, columns, height
    return room, widest, LEAST_ROW


def _column(
    sheet: Sheet, rows: Sequence[TableRow], letters: Notation, language: str, width: float, line: float
) -> Block:
    heads = [[word(head, each) for head in ("quantity", "on paper", "measured", "exact", "difference")]
             for each in languages(language)]
    cells = [_texts(row, sheet.scene.units, letters, language) for row in rows]
    return table(heads, cells, [width * share for share in _SHARES], size=2.4, line=line, layer="answers")


def _texts(row: TableRow, units: Units, letters: Notation, language: str) -> list[Words]:
    compared = row.compared
    reading, symbol = compared.reading, compared.symbol
    unit = symbol.unit(units).written
    name = rate(symbol.kind, ",".join((symbol.link, *row.more))) if row.more else letters.vector(symbol)
    agrees = compared.uncertainty is None and compared.ok
    numbers = paper(reading, compared), measured(reading, units, compared), exact(compared, units)
    difference = term("agrees", language) if agrees else printed(deviation(compared, units))
    return [name + f", {unit}" if unit else name, *map(printed, numbers), difference]


def given_lines(sheet: Sheet, letters: Notation, language: str, width: float, size: float) -> list[tuple[Run, ...]]:
    """Drivers, lengths, fixed points and remarks as lines of text of a width (mm)."""
    scene = sheet.scene
    unit = scene.units.length
    items = given_drivers(sheet, letters) + rolling_starts(sheet)
    items += given_teeth(scene, language)
    items += [name + f" = {value} {unit}" for name, value in given_lengths(scene, letters)]
    items += given_shapes(scene, letters, language)
    fixed = [letters.point(p) + f" {place_of(z, scene)} {unit}" for p, z in scene.frame.points.items()]
    guide = term("guide", language)
    fixed += [guide + " " + name + f" {place} {unit}, {angle}°" for name, place, angle in fixed_guides(scene, letters)]
    lines = [line for group in (items, fixed) for line in _flowed(group, size, width)]
    for each in languages(language):
        notes = (Account(sheet, letters).sentence(note, each) for note in remarks(sheet))
        lines += [line for note in notes for line in wrapped(note, size, width)]
    return lines


def given_data(
    sheet: Sheet, letters: Notation, language: str, area: Box, most: float
) -> tuple[tuple[Primitive, ...], list[tuple[Run, ...]]]:
    """The given data as lines in an area (mm), as large as they fit, at most ``most`` mm; the lines without room."""
    for size in (each for each in (2.8, 2.5, 2.2) if each <= most):
        lines = given_lines(sheet, letters, language, area.width, size)
        if len(lines) * 1.55 * size <= area.height:
            break
    most = int(area.height / (1.55 * size))
    return set_lines(lines[:most], complex(area.left, area.top)), lines[most:]


def set_lines(lines: Sequence[tuple[Run, ...]], corner: complex) -> tuple[Primitive, ...]:
    """Lines of text below each other from a corner."""
    size = max((run.size for line in lines for run in line), default=0.0)
    return tuple(Text(corner + complex(0, size + i * 1.55 * size), runs) for i, runs in enumerate(lines))


def _flowed(items: Sequence[RichText], size: float, width: float) -> list[tuple[Run, ...]]:
    """Items in lines, each unbroken; an item longer than a line is broken."""
    lines: list[RichText] = []
    for item in items:
        joined = lines[-1] + ";  " + item if lines else item
        if lines and runs_width(rich(joined, size)) <= width:
            lines[-1] = joined
        else:
            lines.append(item)
    return [runs for line in lines for runs in wrapped(line, size, width)]
