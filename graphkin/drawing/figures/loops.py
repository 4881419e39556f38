"""The figure of the vector loops: each loop as a closed polygon of arrows, tip to tail, with its angles from the x
axis, and below it its equations in numbers."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import product

from graphkin.account.headings import number
from graphkin.account.loops import MatrixEquation, equation, matrices, projections, root, size_name
from graphkin.account.notation import notation_of
from graphkin.checking.loop_gaps import places_of_loops, stated_arrows
from graphkin.construction.board.scales import next_of_series
from graphkin.construction.board.sheet import Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import BARE, SIZE, Block, FigurePage, column, panel, prose, row
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes, symbols
from graphkin.drawing.ink.primitives import Arc, Circle, Line, Polyline, Primitive, Run, Stroke, Text, on_page
from graphkin.drawing.ink.strokes import colour_of_link
from graphkin.drawing.ink.symbols import POINTER, arrowhead
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, moved_piece
from graphkin.drawing.plate import Plate
from graphkin.drawing.text import SMALLEST, rich, runs_width
from graphkin.drawing.write.drawing import Drawing
from graphkin.plane import added_up
from graphkin.structure.loops import Loop, LoopBlock, loops_in_numbers
from graphkin.words import Neutral, Phrase, languages, listed, say
from graphkin.words.symbols import Words, sign, spaced

PANEL = (84.0, 62.0)  # width and least height of a polygon's panel (mm)
ROOM = 11.0  # around a polygon, for names
BESIDE = 6.0  # between a polygon and its equations
OPEN = Stroke(0.5, (), "#b00020")
CLOSES = 2e-3  # part of a loop's length within which printed angles close it, rounded as they are
ARC = 5.0  # mm, of an angle from the x axis
AXIS = 8.5  # mm of x axis at a tail


def loops_figure(page: FigurePage) -> Drawing | None:
    """Every vector loop with its equations, measured on the drawing; None without loops.

    Raises
    ------
    CallError : a chosen loop does not go from point to point
    """
    sheet = page.sheet
    blocks = loops_in_numbers(sheet.structure, *places_of_loops(sheet))
    if not blocks:
        return None
    scale, loops = _scale(blocks), [(block, loop) for block in blocks for loop in block.loops]
    heads = (Phrase("loop heading", loop=loop.name, links=listed(loop.links), equation=listed(loop.points))
             for _, loop in loops)
    return page.drawing(
        page.at_drivers(page.term("loops")), column(*(_loop(page, *loop, scale) for loop in loops), gap=5.0),
        page.scale("mechanism", scale), title="loops",
        said=". ".join(say(head, each) for each, head in product(languages(page.language), heads)),
        metadata={"scales": {"length": scale / sheet.scene.units.metres}},
    )


def _loop(page: FigurePage, block: LoopBlock, loop: Loop, scale: float) -> Block:
    """The polygon of a loop; beside it its equations, with the last loop of a block the matrices of all."""
    piece, box = _polygon(page.sheet, loop, block, scale)
    height = max(PANEL[1] if len(block.loops) == 1 else 30.0, box.height + 2 * ROOM)
    polygon = panel(PANEL[0], height, lambda room: with_labels(moved_piece(piece, room.centre - box.centre), room))
    width = page.width - PANEL[0] - BESIDE
    lines = column(*(prose((line,), width, bold=bold) for line, bold in _lines(page, loop, block)))
    equations = [*matrices(block, page.sheet.scene)] if loop is block.loops[-1] else []
    solved, below = _solved(page, equations, width), None
    if solved.width > width:  # too wide even in the smallest letters: it stands below, across the page
        solved, below = BARE, _solved(page, equations, page.width)
    return column(row(polygon, column(lines, solved, gap=1.0), gap=BESIDE), below)


def _solved(page: FigurePage, equations: Sequence[MatrixEquation], width: float) -> Block:
    """Matrix equations below each other, each with its solution, in a width (mm)."""
    return column(*(
        part for matrix in equations
        for part in (prose((page.term(matrix.key),), width, bold=True), _matrix(matrix, width),
                     prose((spaced(",  ", matrix.solution),), width))
    ), gap=1.2)


def _scale(blocks: Iterable[LoopBlock]) -> float:
    """m for one mm of paper, of the series 1-2-2.5-5, at which the largest loop fits its panel."""
    least = 1e-12
    for loop in (loop for block in blocks for loop in block.loops):
        box = Box.around(_corners(loop, 1.0))
        least = max(least, box.width / (PANEL[0] - 1.5 * ROOM), box.height / (1.6 * PANEL[1] - 2 * ROOM))
    return next_of_series(least)


def _corners(loop: Loop, scale: float) -> list[complex]:
    """Page points (mm, y down) of a polygon that begins at the page's origin; the last is the first again."""
    at, corners = 0j, [0j]
    for arrow in loop.arrows:
        at += arrow.vector / scale
        corners.append(on_page(at))
    corners[-1] = 0j  # what is missing is rounding
    return corners


def _polygon(sheet: Sheet, loop: Loop, block: LoopBlock, scale: float) -> tuple[Piece, Box]:
    plate, corners = Plate(), [on_page(z) for z in _corners(loop, scale)]
    name, drawn = loop.name, list[Primitive]()
    for k, (arrow, tail, tip) in enumerate(zip(loop.arrows, corners, corners[1:], strict=False), 1):
        colour, ends = colour_of_link(sheet.scene, arrow.link), "".join(arrow.names) or str(k)
        drawn.append(symbols.vector_group(f"loop-{name}-{k}-{ends}", None, on_page(tail), on_page(tip),
                                          symbols.RESULTANT, colour, f"{name}: {ends}", ("loop",)))
        if abs(tip - tail) < 1e-6:
            continue
        unknown = ("travel", arrow.slide) in block.unknowns
        plate.name(rich(size_name(arrow) + " ?" * unknown), (tail, tip), colour=colour)
        along = (sheet.poses[arrow.link].axis.conjugate() * arrow.vector) / abs(arrow.vector)
        if arrow.link != sheet.scene.frame.name and abs(along.imag) < 1e-9:
            # the angle of the vector: the link's own, and half a turn more where the loop runs against it
            plate.put("construction", *_angle(on_page(tail), arrow.vector))
            turned = "" if along.real > 0 else " + 180°"
            mark = " ?" if ("angle", loop.ties[arrow.link]) in block.unknowns else ""
            middle = tail + cmath.rect(ARC + 0.5, cmath.phase(arrow.vector) % math.tau / 2)
            plate.name(rich(sign("θ", arrow.link) + turned + mark, 3.0), middle, colour=colour, rank=1)
    for arrow, at in zip(loop.arrows, corners, strict=False):
        if arrow.names[0]:
            drawn.append(Circle(on_page(at), 0.55, fill=strokes.BLACK))
            plate.name(rich(notation_of(sheet, "chinese").point(arrow.names[0])), at, rank=1)
    _as_printed(plate, sheet, loop, scale)
    plate.put("mechanism", *drawn, id=f"loop-{name}")
    marks = tuple(map(on_page, corners))
    return replace(plate.piece, marks=marks[:-1]), Box.around(marks)


def _as_printed(plate: Plate, sheet: Sheet, loop: Loop, scale: float) -> None:
    """The loop with the printed angles and travels, dashed, if these leave it open, and its gap."""
    gap = _gap(sheet, loop)
    if gap is None:
        return
    at, corners = 0j, [0j]
    for vector in stated_arrows(sheet, loop, sheet.scene.question.printed):
        at += vector / scale
        corners.append(at)
    plate.put("construction", Polyline(tuple(map(on_page, corners)), strokes.DIRECTION), classes=("printed",))
    if abs(at) >= 0.05:
        plate.put("construction", Line(on_page(at), 0j, OPEN), id=f"gap-{loop.name}", classes=("gap",))
        metres, unit = sheet.scene.units.metres, sheet.scene.units.length
        plate.name(rich(f"{number(gap / metres, 4)} {unit}", 2.8), (at, 0j), colour=OPEN.colour)


def _gap(sheet: Sheet, loop: Loop) -> float | None:
    """The gap of a loop with the values printed for this position (m); None where it closes within their last digit."""
    if any(abs(sheet.drivers[d.key] - d.values[0]) > 1e-9 for d in sheet.scene.drivers):
        return None
    vectors = stated_arrows(sheet, loop, sheet.scene.question.printed)
    gap = abs(added_up(vectors, 0j))
    return gap if gap > CLOSES * added_up(map(abs, vectors)) else None


def _angle(tail: complex, vector: complex) -> list[Primitive]:
    """The angle of an arrow, as an arc from a stub of the x axis, counter-clockwise."""
    angle = cmath.phase(vector) % math.tau
    parts: list[Primitive] = [Line(tail, tail + AXIS, strokes.DIRECTION)]
    if angle > 0.05:
        parts.append(Arc(tail, ARC, 0.0, angle - min(0.3, 0.4 * angle), strokes.DIMENSION))
        tip = tail + on_page(cmath.rect(ARC, angle))
        along = on_page(1j * cmath.rect(1.0, angle))
        head, width = symbols.head_size(POINTER, ARC * angle)
        parts.append(arrowhead(tip, along, head, width, strokes.BLACK))
    return parts


def _lines(page: FigurePage, loop: Loop, block: LoopBlock) -> Iterator[tuple[Words, bool]]:
    """The lines of text of a loop, and whether each is bold."""
    scene = page.sheet.scene
    sum_ = Neutral(equation(loop, page.convention))
    head = page.said("loop heading", loop=loop.name, links=listed(loop.links), equation=sum_)
    yield from ((text, True) for text in head)
    x, y = projections(loop, block, scene)
    yield from (("x:  " + x, False), ("y:  " + y, False))
    gap = _gap(page.sheet, loop)
    if gap is not None:
        size = Neutral(f"{number(gap / scene.units.metres, 4)} {scene.units.length}")
        yield from ((text, False) for text in page.said("loop open", loop=loop.name, gap=size))
    if loop.root is not None:
        every = dict.fromkeys(root(loop.root, scene, each) for each in languages(page.language))
        yield from ((text, False) for text in every)


def _matrix(matrix: MatrixEquation, room: float) -> Block:
    """A matrix equation with its brackets, as large as it fits a width (mm)."""
    size = SIZE
    while True:
        columns = [[rich(cell, size) for cell in cells] for cells in zip(*matrix.rows, strict=True)]
        names, right = [rich(n, size) for n in matrix.unknowns], [rich(r, size) for r in matrix.right]
        widths = [max(map(runs_width, cells)) for cells in (*columns, names, right)]
        if added_up(widths) + 2.6 * len(columns) + 16.0 <= room or size <= SMALLEST:
            break
        size = max(SMALLEST, size - 0.2)
    step = 1.5 * size
    height = step * len(matrix.rows) + 0.6
    drawn: list[Primitive] = []

    def bracket(x: float, sense: float) -> None:
        top, low = x + 0j, x + height * 1j
        drawn.append(Polyline((top + 0.9 * sense, top, low, low + 0.9 * sense), strokes.DIMENSION))

    def bracketed(x: float, columns: Sequence[Sequence[tuple[Run, ...]]], anchor: str, past: float = 1.4) -> float:
        """Columns of cells between brackets, which begin at a place; the place of the second."""
        bracket(x, 1.0)
        at = x + 1.4
        for cells in columns:
            wide = max(map(runs_width, cells))
            place = at + wide if anchor == "end" else at
            drawn.extend(Text(complex(place, step * (k + 0.85)), runs, anchor) for k, runs in enumerate(cells))
            at += wide + 2.6
        bracket(at - 2.6 + past, -1.0)
        return at - 2.6 + past

    x = bracketed(0.0, columns, "end", 1.6)
    x = bracketed(x + 2.0, [names], "start")
    drawn.append(Text(complex(x + 1.6, height / 2 + 0.35 * size), rich("=", size)))
    x = bracketed(x + 5.0, [right], "end")
    return Block(Piece({"labels": tuple(drawn)}), height, x)


FIGURES = (Figure("loops", loops_figure, by_itself=lambda scene: bool(scene.question.loops), of_all=True, place=12),)
