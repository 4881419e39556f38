"""Typeset vector equations: terms with the known parts of size and direction, in columns on a sheet."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, partial
from typing import TypeAlias

from graphkin.account.account import WrittenLine, rule_alone
from graphkin.account.arithmetic import bound, rule_sum, scale_of
from graphkin.account.headings import number, term
from graphkin.account.notation import Notation, rows_of, unit_of
from graphkin.construction.board.sheet import Equation, Sheet
from graphkin.construction.board.steps import GIVEN, Term
from graphkin.drawing.boxes import Block
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Line, Primitive, Run, Text
from graphkin.drawing.place.piece import Piece
from graphkin.drawing.text import box_about, rich, runs_width, wrapped
from graphkin.plane import added_up
from graphkin.words.symbols import RichText, spaced
from graphkin.words.written import MOST

# mm, of the letters, and columns; the first that fits is taken: sums break in narrow columns
WAYS = ((3.2, 1), (2.9, 1), (3.2, 2), (2.9, 2), (2.6, 1), (2.6, 2))
LEAST_LETTERS = min(size for size, _ in WAYS)
LEAST_ROW = 2.3  # mm, of the letters in rows: below it a square over an index runs into it
CLEAR, UNDERLINE = 0.55, 0.6  # mm between two rows, and between two lines under a term
GAP, BESIDE = 1.3, 0.2  # mm beside a column of terms, and beside the last
COLUMN_GAP = 5.0  # mm between two columns of equations
WIDE = 150.0  # mm: a page that holds two of them


@dataclass(frozen=True)
class _Cell:
    """A term (with its marks) or an operator, set."""

    runs: tuple[Run, ...]
    size: tuple[Run, ...] = ()
    direction: tuple[Run, ...] = ()
    over: tuple[Run, ...] = ()
    underlines: int = 0
    is_term: bool = True

    @cached_property
    def width(self) -> float:
        return max(runs_width(self.runs), runs_width(self.size), runs_width(self.direction), runs_width(self.over))


Placed: TypeAlias = list[tuple[Block, complex]]
"""Blocks with their left upper corners (mm)."""
LineToSet = Callable[[float, float], Block]
"""A line as it is set: at most so wide, in letters of a size (mm)."""


def line_to_set(line: WrittenLine, sheet: Sheet, letters: Notation, language: str) -> LineToSet:
    """A line that is set once for each width and size, for all places tried."""
    short = _short(sheet, line, letters) if isinstance(line, Equation) else line
    if short is not None:
        return cache(lambda width, size: _sentence(short, size, width))
    assert isinstance(line, Equation)
    cells = cache(partial(_cells, sheet, line.sides, letters))
    return cache(lambda width, size: _written_cells(cells(size), letters, language, width, size))


def equations_in_room(
    lines: Sequence[LineToSet], width: float, height: float, most: float = WAYS[0][0]
) -> tuple[tuple[Primitive, ...], int]:
    """Lines as large as they fit an area (mm), with letters of at most ``most`` mm, in one column or two, about its
    left upper corner; and the number of first lines that fit."""

    def tried() -> Iterator[Placed]:
        for size, columns in WAYS:
            if size <= most and height > 0.0:
                wide = (width - (columns - 1) * COLUMN_GAP) / columns
                # lines are set as they are placed, since those after one that has no room are not wanted
                yield _in_columns((line(wide, size) for line in lines), wide, height, columns)

    return _fullest(tried(), len(lines))


def equations_on_page(lines: Sequence[LineToSet], width: float, height: float) -> tuple[tuple[Primitive, ...], int]:
    """Lines on a page of their own (mm), as ``equations_in_room``, in columns of equal height on a wide page."""

    def tried() -> Iterator[Placed]:
        for columns in (2, 1) if width >= WIDE else (1,):  # lines with long names want the whole width
            wide = (width - (columns - 1) * COLUMN_GAP) / columns
            for size in dict.fromkeys(size for size, _ in WAYS):
                blocks = [line(wide, size) for line in lines]
                high = min(height, added_up(block.height for block in blocks) / columns)
                while high < height and len(_in_columns(blocks, wide, high, columns)) < len(blocks):
                    high = min(height, high + size)
                yield _in_columns(blocks, wide, high, columns)
        yield [(line(width, LEAST_LETTERS), 0j) for line in lines[:1]]  # one too wide for any page runs off it

    return _fullest(tried(), len(lines))


def _fullest(tried: Iterable[Placed], count: int) -> tuple[tuple[Primitive, ...], int]:
    """The first arrangement in which all lines fit, or most of them, and their number."""
    best: Placed = []
    for placed in tried:
        best = max(best, placed, key=len)
        if len(best) == count:
            break
    return tuple(part for block, at in best for part in block.moved(at).drawn), len(best)


def _in_columns(blocks: Iterable[Block], wide: float, height: float, columns: int) -> Placed:
    """Blocks below each other in columns, with their corners, up to the last that fits."""
    placed: Placed = []
    column, y = 0, 0.0
    for block in blocks:
        if y + block.height > height:
            column, y = column + 1, 0.0
        if column == columns or block.height > height or block.width > wide + 1e-9:
            break
        placed.append((block, complex(column * (wide + COLUMN_GAP), y)))
        y += block.height
    return placed


def _sentence(text: RichText, size: float, width: float) -> Block:
    """Words and symbols, broken into lines."""
    lines = wrapped(text, size, width)
    texts = tuple(Text(complex(0, size * (1 + 1.5 * k)), runs) for k, runs in enumerate(lines))
    return Block(Piece({"labels": texts}), (0.4 + 1.5 * len(lines)) * size, max(map(runs_width, lines), default=0.0))


def _written_cells(cells: list[_Cell], letters: Notation, language: str, width: float, size: float) -> Block:
    """Terms and operators with their rows, broken before a line gets too long."""
    gap = 1.2 * GAP if rows_of(letters.convention) == "table" else 0.6 * GAP
    heads = _heads(letters, language, size)
    lead = max((runs_width(h) for h in heads), default=0.0) + (2 * GAP if heads else 0.0)
    children: list[Primitive] = []
    y = most = 0.0
    for line in _lines(cells, width - lead - BESIDE, gap):
        block = _set(line, heads, lead, gap, letters, size, y)
        children += block.piece.drawn
        y += block.height
        most = max(most, block.width)
    return Block(Piece({"labels": tuple(children)}), y, most)


def write_sum(sheet: Sheet, terms: Sequence[Term], letters: Notation, language: str, width: float) -> Block:
    """Vectors whose sum is zero, with their rows of sizes and directions, at most ``width`` mm wide."""
    size = WAYS[0][0]
    cells = _cells(sheet, [terms], letters, size)
    cells += [_Cell(rich("=", size), is_term=False), _Cell(rich("0", size), is_term=True)]
    return _written_cells(cells, letters, language, width, size)


def _short(sheet: Sheet, equation: Equation, letters: Notation) -> RichText | None:
    """An equation that is only a rule, on one line: ``v_B = ω_1 l_AB = 1220 mm/s, ⊥AB``."""
    if not rule_alone(sheet, equation):
        return None
    only = equation.sides[-1][0]
    vector = sheet.vectors[equation.diagram][only.symbol]
    parts = [letters.vector(side[0].symbol) for side in equation.sides]
    if only.size and only.size != GIVEN:
        parts.append(letters.size(only.size))
    amount = bound(rule_sum(sheet, only.size, equation.diagram))  # the product of what is written
    if not amount:
        laid_off = (s.mm for s in sheet.steps if s.verb == "lay off" and s.symbol == only.symbol)
        # as given, not as a hand has drawn it
        value = next(laid_off, abs(vector.span)) * scale_of(sheet, equation.diagram)
        amount = bound(f"{number(value, MOST)} {unit_of(sheet, equation.diagram).written}")
    parts.append(amount)
    direction = letters.direction(only.direction, sheet.scene.frame.name)
    return spaced(" =\u00a0", parts) + (",  " + direction if direction else "")


def _cells(sheet: Sheet, sides: Sequence[Sequence[Term]], letters: Notation, size: float) -> list[_Cell]:
    """The terms of equal sums, each after its sign."""
    cells: list[_Cell] = []
    for k, summand in (numbered for side in sides for numbered in enumerate(side)):
        if cells:
            cells.append(_Cell(rich("+" if k else "=", size), is_term=False))
        cells.append(_cell(sheet, summand, letters, size))
    return cells


def _row_size(size: float) -> float:
    return max(LEAST_ROW, 0.8 * size)


def _cell(sheet: Sheet, term: Term, letters: Notation, size: float) -> _Cell:
    """A term with its rows; if marks show what is known, the rows only give size and direction."""
    rows = rows_of(letters.convention)
    small = _row_size(size)
    whole = rich(letters.term(term), size)
    rule = letters.size(term.size) if term.size and term.size != GIVEN else ""
    direction = letters.direction(term.direction, sheet.scene.frame.name)
    written = rich(rule, small) if rule else (), rich(direction, small) if direction else ()
    if rows == "over":
        marks = ("√" if term.size_known else "?") + ("√" if term.direction_known else "?")
        return _Cell(whole, *written, over=rich(marks, small))
    if rows == "underlines":
        return _Cell(whole, *written, underlines=term.direction_known + term.size_known)
    sized = written[0] or rich("√" if term.size_known else "?", small)
    return _Cell(whole, sized, written[1] or rich("√" if term.direction_known else "?", small))


def _heads(letters: Notation, language: str, size: float) -> tuple[tuple[Run, ...], ...]:
    """Names of the rows."""
    if rows_of(letters.convention) not in ("rows", "table"):
        return ()
    small = _row_size(size)
    return rich(term("size", language), small), rich(term("direction of", language), small)


def _lines(cells: list[_Cell], width: float, gap: float) -> list[list[_Cell]]:
    """The cells in lines, broken before an operator."""
    lines: list[list[_Cell]] = [[]]
    used = 0.0
    for i, cell in enumerate(cells):
        need = cell.width + gap
        if not cell.is_term and i + 1 < len(cells):
            need += cells[i + 1].width + gap
            if lines[-1] and used + need > width:
                lines.append([])
                used = 0.0
        lines[-1].append(cell)
        used += cell.width + gap
    return lines


def _set(
    line: list[_Cell], heads: tuple[tuple[Run, ...], ...], lead: float, gap: float, letters: Notation, size: float,
    top: float,
) -> Block:
    rows = rows_of(letters.convention)
    stack = [[c.over for c in line], [c.runs for c in line], [c.size for c in line], [c.direction for c in line]]
    lines = max((c.underlines for c in line), default=0)
    between = 2 * CLEAR if rows == "table" else CLEAR
    under = max(UNDERLINE * (lines + 0.5) if lines else 0.0, between)
    bases, edges_down = _baselines(stack, heads, top, under, between)
    children: list[Primitive] = [Text(complex(0, y), head) for head, y in zip(heads, bases[2:], strict=False)]
    x = lead
    across = []
    for cell in line:
        middle = x + cell.width / 2
        for runs, y in zip((cell.over, cell.runs, cell.size, cell.direction), bases, strict=True):
            if runs:
                children.append(Text(complex(middle, y), runs, "middle"))
        half = runs_width(cell.runs) / 2
        for i in range(cell.underlines):
            y = edges_down[1] + UNDERLINE * (0.5 + i)
            children.append(Line(complex(middle - half, y), complex(middle + half, y), strokes.DIMENSION))
        if not cell.is_term:
            across.append(middle)
        x += cell.width + gap
    if rows == "table":
        first = [lead - gap / 2] if line[0].is_term else []  # a line goes on with its sign at the head of the table
        children += _grid([-0.8, *first, *across, x], [y + CLEAR for y in edges_down[1:]])
    return Block(Piece({"labels": tuple(children)}), max(edges_down) - top + 0.55 * size, x + BESIDE)


def _baselines(
    stack: list[list[tuple[Run, ...]]], heads: tuple[tuple[Run, ...], ...], top: float, under: float, between: float
) -> tuple[list[float], list[float]]:
    """Baselines of the rows of an equation, marks above it first, and the lower edge of each; ``under`` and ``between``
    are the spaces (mm) below the terms and between other rows."""
    bases: list[float] = []
    down: list[float] = []
    below = next((i for i in (2, 3) if any(stack[i])), 0)  # the first row under the terms
    y = top
    for i, row in enumerate(stack):
        boxes = [box_about(runs) for runs in (*row, *heads[max(0, i - 2) : max(0, i - 1)]) if runs]
        if not boxes:
            bases.append(y)
            down.append(y)
            continue
        y += -min(b.top for b in boxes) + (under if i == below else between if y > top else 0.0)
        bases.append(y)
        y += max(b.bottom for b in boxes)
        down.append(y)
    return bases, down


def _grid(across: list[float], down: list[float]) -> list[Primitive]:
    """Rules of the table under an equation, at some x and y."""
    level = [Line(complex(across[0], y), complex(across[-1], y), strokes.DIMENSION) for y in down]
    upright = [Line(complex(x, down[0]), complex(x, down[-1]), strokes.DIMENSION) for x in across]
    return [*level, *upright]
