"""Vector equations as they are written: terms with what is known of their size and direction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from graphkin.construction.sheet import Equation, Sheet, Term
from graphkin.construction.steps import Given
from graphkin.drawing import strokes
from graphkin.drawing.conventions import Letters, rows_of
from graphkin.drawing.font_widths import run_box, runs_width
from graphkin.drawing.headings import number, term
from graphkin.drawing.piece import moved
from graphkin.drawing.primitives import Line, Primitive, Run, Text
from graphkin.drawing.text import rich, symbol

__all__ = ["Written", "write_equation", "write_equations"]

SIZES = (3.2, 2.9, 2.6, 2.3, 2.0)  # mm, of the letters; the largest that fits is taken
CLEAR, UNDERLINE = 0.55, 0.6  # mm between two rows, and between two lines under a term
GAP = 1.3  # mm beside a column of terms
COLUMN_GAP = 5.0  # mm between two columns of equations
REMARK = 4.0  # mm for the remark on those left out


@dataclass(frozen=True)
class Written:
    """A block of writing: what it holds about its left upper corner, and how large it is (mm)."""

    children: tuple[Primitive, ...]
    width: float
    height: float


@dataclass(frozen=True)
class _Cell:
    """A term (with its marks) or an operator, set."""

    runs: tuple[Run, ...]
    size: tuple[Run, ...] = ()
    direction: tuple[Run, ...] = ()
    over: tuple[Run, ...] = ()
    underlines: int = 0
    is_term: bool = True

    @property
    def width(self) -> float:
        return max(runs_width(self.runs), runs_width(self.size), runs_width(self.direction), runs_width(self.over))


def write_equations(
    sheet: Sheet, letters: Letters, language: str, width: float, height: float
) -> tuple[tuple[Primitive, ...], int]:
    """All equations of a sheet as large as they fit an area (mm), in one column or two, about its left upper corner;
    and how many had to be left out."""
    fullest: list[tuple[Written, complex]] = []
    for size in SIZES:
        for columns in (1, 2):
            wide = (width - (columns - 1) * COLUMN_GAP) / columns
            blocks = [write_equation(sheet, e, letters, language, wide, size) for e in sheet.equations]
            placed = _in_columns(blocks, wide, height, columns)
            if len(placed) == len(blocks):
                return _written(placed), 0
            fullest = max(fullest, _in_columns(blocks, wide, height - REMARK, columns), key=len)
    return _written(fullest), len(sheet.equations) - len(fullest)


def _written(blocks: Sequence[tuple[Written, complex]]) -> tuple[Primitive, ...]:
    return tuple(p for block, at in blocks for p in moved(block.children, at))


def _in_columns(blocks: Sequence[Written], wide: float, height: float, columns: int) -> list[tuple[Written, complex]]:
    """Blocks below each other in columns, with their corners, as far as they fit."""
    placed: list[tuple[Written, complex]] = []
    column, y = 0, 0.0
    for block in blocks:
        if y + block.height > height:
            column, y = column + 1, 0.0
        if column == columns or block.height > height or block.width > wide + 1e-9:
            break
        placed.append((block, complex(column * (wide + COLUMN_GAP), y)))
        y += block.height
    return placed


def write_equation(
    sheet: Sheet, equation: Equation, letters: Letters, language: str, width: float, size: float = 3.2
) -> Written:
    """One equation, at most ``width`` mm wide: rules of sizes become √ where they do not fit, long ones are broken."""
    short = _short(sheet, equation, letters, size)
    if short is not None:
        runs = rich(short, size)
        return Written((Text(complex(0, size), runs),), runs_width(runs), 1.9 * size)
    gap = 1.2 * GAP if rows_of(letters.convention) == "table" else 0.6 * GAP
    for rules in (True, False):
        cells = _cells(sheet, equation, letters, size, rules)
        heads = _heads(letters, language, size)
        lead = max((runs_width(h) for h in heads), default=0.0) + (2 * GAP if heads else 0.0)
        if lead + sum(c.width + gap for c in cells) <= width:
            break
    lines = _lines(cells, width - lead, gap)
    children: list[Primitive] = []
    y = most = 0.0
    for line in lines:
        block = _set(line, heads, lead, gap, letters, size, y)
        children += block.children
        y += block.height
        most = max(most, block.width)
    return Written(tuple(children), most, y)


def _short(sheet: Sheet, equation: Equation, letters: Letters, size: float) -> str | None:
    """An equation that is only a rule, on one line: ``v_B = ω_1 l_AB = 1220 mm/s, ⊥AB``."""
    last = equation.sides[-1]
    if len(last) != 1 or not last[0].size_known or len(equation.sides) > 2:
        return None
    only = last[0]
    vector = sheet.vectors(equation.diagram).get(only.symbol)
    if vector is None:
        return None
    parts = [f"${letters.vector(side[0].symbol)}$" for side in equation.sides]
    if only.size and not isinstance(only.size, Given):
        parts.append(f"${letters.size(only.size)}$")
    unit = sheet.scene.units.length + ("/s" if equation.diagram == "velocity" else "/s²")
    value = abs(vector.span) * sheet.scales.of(equation.diagram) / sheet.scene.units.metres
    parts.append(f"{number(value, 5)} {unit}")
    way = letters.direction(only.direction, sheet.scene.frame.name)
    return " = ".join(parts) + (f",  ${way}$" if way else "")


def _cells(sheet: Sheet, equation: Equation, letters: Letters, size: float, rules: bool) -> list[_Cell]:
    cells: list[_Cell] = []
    for i, side in enumerate(equation.sides):
        for j, one in enumerate(side):
            if i or j:
                cells.append(_Cell(symbol("+" if j else "=", size), is_term=False))
            cells.append(_cell(sheet, one, letters, size, rules))
    return cells


def _cell(sheet: Sheet, one: Term, letters: Letters, size: float, rules: bool) -> _Cell:
    rows = rows_of(letters.convention)
    small = max(2.0, 0.8 * size)
    whole = symbol(letters.vector(one.symbol), size)
    way = letters.direction(one.direction, sheet.scene.frame.name) or ("√" if one.direction_known else "?")
    if rows == "over":
        marks = ("√" if one.size_known else "?") + ("√" if one.direction_known else "?")
        return _Cell(whole, over=symbol(marks, small))
    if rows == "underlines":
        lines = one.direction_known + one.size_known
        return _Cell(whole, direction=symbol(way, small) if one.direction else (), underlines=lines)
    known = letters.size(one.size) if rules and one.size and not isinstance(one.size, Given) else "√"
    return _Cell(whole, size=symbol(known if one.size_known else "?", small), direction=symbol(way, small))


def _heads(letters: Letters, language: str, size: float) -> tuple[tuple[Run, ...], ...]:
    """Names of the rows."""
    if rows_of(letters.convention) not in ("rows", "table"):
        return ()
    small = max(2.0, 0.8 * size)
    return rich(term("size", language), small), rich(term("direction of", language), small)


def _lines(cells: list[_Cell], width: float, gap: float) -> list[list[_Cell]]:
    """Broken before an operator where a line gets too long."""
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
    line: list[_Cell], heads: tuple[tuple[Run, ...], ...], lead: float, gap: float, letters: Letters, size: float,
    top: float,
) -> Written:  # fmt: skip
    rows = rows_of(letters.convention)
    stack = [[c.over for c in line], [c.runs for c in line], [c.size for c in line], [c.direction for c in line]]
    lines = max((c.underlines for c in line), default=0)
    room = UNDERLINE * (lines + 0.5) if rows == "underlines" else 2 * CLEAR if rows == "table" else CLEAR
    bases, edges_down = _baselines(stack, heads, top, room)
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
        children += _grid([-0.8, lead - gap / 2, *across, x], [y + CLEAR for y in edges_down[1:]])
    return Written(tuple(children), x + 0.2, max(edges_down) - top + 0.55 * size)


def _baselines(
    stack: list[list[tuple[Run, ...]]], heads: tuple[tuple[Run, ...], ...], top: float, room: float
) -> tuple[list[float], list[float]]:
    """Baselines of the rows of an equation, marks above it first, and the lower edge of each; ``room`` mm between."""
    bases: list[float] = []
    down: list[float] = []
    y = top
    for i, row in enumerate(stack):
        boxes = [run_box(run) for runs in (*row, *heads[max(0, i - 2) : max(0, i - 1)]) for run in runs]
        if not boxes:
            bases.append(y)
            down.append(y)
            continue
        y += -min(b.top for b in boxes) + (room if i > 1 else CLEAR if i == 1 and bases[0] > top else 0.0)
        bases.append(y)
        y += max(b.bottom for b in boxes)
        down.append(y)
    return bases, down


def _grid(across: list[float], down: list[float]) -> list[Primitive]:
    """Rules of the table under an equation, at some x and y."""
    level = [Line(complex(across[0], y), complex(across[-1], y), strokes.DIMENSION) for y in down]
    upright = [Line(complex(x, down[0]), complex(x, down[-1]), strokes.DIMENSION) for x in across]
    return [*level, *upright]
