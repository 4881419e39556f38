"""Vector equations as they are written: terms with what is known of their size and direction."""

from __future__ import annotations

from dataclasses import dataclass

from graphkin.drafting.sheet import Equation, Sheet, Term
from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters, rows_of
from graphkin.drawing.headings import number, term
from graphkin.drawing.metrics import runs_width
from graphkin.drawing.primitives import Line, Primitive, Run, Text
from graphkin.drawing.typeset import rich, symbol

__all__ = ["Written", "write_equation", "write_equations"]

SIZES = (3.2, 2.9, 2.6, 2.3, 2.0)  # mm, of the letters; the largest that fits is taken
GAP = 1.3  # mm beside a column


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
) -> tuple[list[Written], int]:
    """All equations of a sheet as large as they fit an area (mm) below each other, and how many had to be left out."""
    for size in SIZES:
        blocks = [write_equation(sheet, e, letters, language, width, size) for e in sheet.equations]
        if sum(b.height for b in blocks) <= height and all(b.width <= width + 1e-9 for b in blocks):
            return blocks, 0
    kept: list[Written] = []
    left = height - 4.0  # for the remark on those left out
    for block in blocks:
        left -= block.height
        if left < 0.0:
            break
        kept.append(block)
    return kept, len(blocks) - len(kept)


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
    if only.size and only.size != "given":
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
    known = letters.size(one.size) if rules and one.size and one.size != "given" else "√"
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
    pitch = 1.45 * size
    base = top + size + (pitch * 0.85 if rows == "over" else 0.0)
    children: list[Primitive] = []
    for i, head in enumerate(heads):
        children.append(Text(complex(0, base + (i + 1) * pitch), head))
    x = lead
    edges = [x - gap / 2]
    for cell in line:
        middle = x + cell.width / 2
        for runs, y in (
            (cell.runs, base),
            (cell.over, base - 1.15 * size),
            (cell.size, base + pitch),
            (cell.direction, base + (2 if heads else 1) * pitch + (0.0 if heads else 0.25 * size)),
        ):
            if runs:
                children.append(Text(complex(middle, y), runs, "middle"))
        for i in range(cell.underlines):
            half = runs_width(cell.runs) / 2
            y = base + size * (0.52 + 0.2 * i)
            children.append(Line(complex(middle - half, y), complex(middle + half, y), strokes.DIMENSION))
        if not cell.is_term:
            edges.append(middle)
        x += cell.width + gap
    edges.append(x)
    depth = {"rows": 2, "table": 2, "over": 0, "underlines": 1}[rows]
    bottom = base + depth * pitch + 0.35 * size
    if rows == "table":
        children += _grid(edges, base, pitch, size)
    return Written(tuple(children), x + 0.2, bottom - top + 0.55 * size)


def _grid(edges: list[float], base: float, pitch: float, size: float) -> list[Primitive]:
    """Rules of the table under an equation."""
    box = Box(-0.8, base + 0.42 * size, edges[-1], base + 2 * pitch + 0.42 * size)
    across = [box.top, box.top + pitch, box.bottom]
    lines: list[Primitive] = [Line(complex(box.left, y), complex(box.right, y), strokes.DIMENSION) for y in across]
    for x in (box.left, *edges):
        lines.append(Line(complex(x, box.top), complex(x, box.bottom), strokes.DIMENSION))
    return lines
