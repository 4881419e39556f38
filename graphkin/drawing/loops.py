"""The figure of the vector loops: each loop as a closed polygon of arrows, tip to tail, with the angles that it has
from the x axis, and below it its equations in numbers."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from graphkin.checking.loop_gaps import places_of_loops, stated_arrows
from graphkin.construction.sheet import Sheet, next_of_series
from graphkin.drawing.bilingual import in_both
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import letters_of, scale_statement
from graphkin.drawing.font_widths import runs_width
from graphkin.drawing.headings import drivers, facts, figure_title, number, term
from graphkin.drawing.ink import strokes, symbols
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Polyline, Primitive, Run, Stroke, Text
from graphkin.drawing.ink.strokes import colour_of_link
from graphkin.drawing.ink.symbols import POINTER, arrowhead
from graphkin.drawing.loop_words import MatrixEquation, equation, matrices, projections, root, size_name
from graphkin.drawing.page_text import titled
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, joined, layer_groups, moved_piece
from graphkin.drawing.text import rich, symbol, wrapped
from graphkin.drawing.write.drawing import Drawing
from graphkin.plane import added_up
from graphkin.scene.sheet_tables import Convention
from graphkin.structure.loop_values import LoopBlock, LoopValue, loops_in_numbers
from graphkin.words import Phrase, languages, say

__all__ = ["loop_blocks", "loops_figure"]

WIDTH, MARGIN = 190.0, 8.0
PANEL = (84.0, 62.0)  # width and least height of a polygon's panel (mm)
ROOM = 11.0  # around a polygon, for names
LINE, SMALL = 4.6, 2.8  # mm from line to line, size of letters
OPEN = Stroke(0.5, (), "#b00020")
CLOSES = 2e-3  # part of a loop's length within which printed angles close it, rounded as they are
ARC = 5.0  # mm, of an angle from the x axis
AXIS = 8.5  # mm of x axis at a tail


def loop_blocks(sheet: Sheet) -> tuple[LoopBlock, ...]:
    """The loops of what stands on a sheet, measured on the drawn mechanism.  Raises CallError for a chosen loop that
    does not go from point to point."""
    axes, travels = places_of_loops(sheet)
    return loops_in_numbers(sheet.structure, axes, travels)


def loops_figure(sheet: Sheet, *, language: str | None = None, convention: str | None = None) -> Drawing | None:
    """Every vector loop with its equations; None where there is none.

    Parameters
    ----------
    language : "en", "zh" or "both"; the scene's own if None
    convention : letters of the driver's values; the scene's own if None
    """
    blocks = loop_blocks(sheet)
    if not blocks:
        return None
    spoken = language or sheet.scene.sheet.language
    letters = letters_of(sheet, convention or sheet.scene.sheet.convention)  # type: ignore[arg-type]
    pieces: list[Piece] = []
    words, y = titled(sheet, spoken, f"{term('loops', spoken)}:  {drivers(sheet, letters)}", MARGIN)
    y += 4.0
    scale = _scale(blocks)
    for block in blocks:
        panels = [_polygon(sheet, loop, block, scale) for loop in block.loops]
        for piece, box, loop in zip([p for p, _ in panels], [b for _, b in panels], block.loops, strict=True):
            height = max(PANEL[1] if len(block.loops) == 1 else 30.0, box.height + 2 * ROOM)
            panel = Box(MARGIN, y, MARGIN + PANEL[0], y + height)
            pieces.append(with_labels(moved_piece(piece, panel.centre - box.centre), panel))
            column = Box(panel.right + 6.0, y, WIDTH - MARGIN, y + height)
            lines = _lines(sheet, loop, block, letters.convention, spoken)
            end = _write(words, lines, column)
            if loop is block.loops[-1]:
                end = _matrices(words, sheet, block, spoken, complex(column.left, end + 1.0), column.right)
            y = max(panel.bottom, end) + 5.0
    at_scale = replace(sheet, scales=replace(sheet.scales, length=scale))
    words.append(Text(complex(MARGIN, y + 2.0), rich(scale_statement(at_scale, letters.convention, "mechanism"), 3.2)))
    page = joined((*pieces, Piece({"labels": tuple(words)})))
    return Drawing(
        WIDTH, y + 8.0, layer_groups(page), figure_title(sheet, "loops", spoken), _described(sheet, blocks, spoken),
        languages(spoken)[0], facts(sheet, "loops") | {"scales": {"length": scale / sheet.scene.units.metres}},
    )  # fmt: skip


def _scale(blocks: Iterable[LoopBlock]) -> float:
    """m for one mm of paper, of the series 1-2-2.5-5, at which the largest loop fits its panel."""
    least = 1e-12
    for loop in (one for block in blocks for one in block.loops):
        box = Box.around(_corners(loop, 1.0))
        least = max(least, box.width / (PANEL[0] - 1.5 * ROOM), box.height / (1.6 * PANEL[1] - 2 * ROOM))
    return next_of_series(least)


def _corners(loop: LoopValue, scale: float) -> list[complex]:
    """Page points (mm, y down) of a polygon that begins at the page's origin; the last is the first again."""
    at, corners = 0j, [0j]
    for arrow in loop.arrows:
        at += arrow.vector / scale
        corners.append(at.conjugate())
    corners[-1] = 0j  # what is missing is rounding
    return corners


def _polygon(sheet: Sheet, loop: LoopValue, block: LoopBlock, scale: float) -> tuple[Piece, Box]:
    corners = _corners(loop, scale)
    open_ = {(u.kind, u.of) for u in block.unknowns}
    drawn: list[Primitive] = []
    thin: list[Primitive] = []
    labels: list[Label] = []
    name = loop.loop.name
    for k, arrow in enumerate(loop.arrows):
        tail, tip = corners[k], corners[k + 1]
        colour = colour_of_link(sheet.scene, arrow.arrow.link)
        ends = "".join(arrow.arrow.names) or str(k + 1)
        group = symbols.vector_group(f"loop-{name}-{k + 1}-{ends}", None, tail, tip, symbols.RESULTANT, colour,
                                     f"{name}: {ends}", ("loop",))  # fmt: skip
        drawn.append(group)
        if abs(tip - tail) < 1e-6:
            continue
        unknown = ("s", arrow.arrow.slide) in open_
        written = rich(f"${size_name(arrow)}$ ?") if unknown else symbol(size_name(arrow))
        labels.append(Label(Text(0j, written, "start", colour, classes=("label",)), (tail, tip)))
        along = (sheet.poses[arrow.arrow.link].axis.conjugate() * arrow.vector) / abs(arrow.vector)
        if arrow.arrow.link != sheet.scene.frame.name and abs(along.imag) < 1e-9:
            # the angle of the vector: the link's own, and half a turn more where the loop runs against it
            thin += _angle(tail, arrow.vector)
            turned = "" if along.real > 0 else " + 180°"
            mark = " ?" if ("theta", loop.loop.ties[arrow.arrow.link]) in open_ else ""
            middle = cmath.rect(ARC + 0.5, cmath.phase(arrow.vector) % math.tau / 2).conjugate()
            angle = rich(f"$θ_{{{arrow.arrow.link}}}${turned}{mark}", 3.0)
            letter = Text(0j, angle, "start", colour, classes=("label",))
            labels.append(Label(letter, tail + middle, rank=1))
    for k, arrow in enumerate(loop.arrows):
        if arrow.arrow.names[0]:
            drawn.append(Circle(corners[k], 0.55, fill=strokes.BLACK))
            point = Text(0j, symbol(letters_of(sheet, "chinese").point(arrow.arrow.names[0])), classes=("label",))
            labels.append(Label(point, corners[k], rank=1))
    opened, more = _as_printed(sheet, loop, scale)
    thin += opened
    labels += more
    marks = tuple(corners[:-1])
    piece = Piece({"construction": tuple(thin), "mechanism": (Group(tuple(drawn), id=f"loop-{name}"),)},
                  tuple(labels), marks)  # fmt: skip
    return piece, Box.around(corners)


def _as_printed(sheet: Sheet, loop: LoopValue, scale: float) -> tuple[list[Primitive], list[Label]]:
    """The loop with the printed angles and travels, dashed, where these leave it open, and its gap."""
    gap = _gap(sheet, loop)
    if gap is None:
        return [], []
    at, corners = 0j, [0j]
    for vector in stated_arrows(sheet, loop.loop, sheet.scene.printed):
        at += vector / scale
        corners.append(at.conjugate())
    drawn = Group((Polyline(tuple(corners), strokes.DIRECTION),), classes=("printed",))
    ends = Line(corners[-1], corners[0], OPEN)
    if abs(ends.end - ends.start) < 0.05:
        return [drawn], []
    metres, unit = sheet.scene.units.metres, sheet.scene.units.length
    words = Text(0j, rich(f"{number(gap / metres, 4)} {unit}", 2.8), "start", OPEN.colour, classes=("label",))
    return [drawn, Group((ends,), id=f"gap-{loop.loop.name}", classes=("gap",))], [Label(words, (ends.start, ends.end))]


def _gap(sheet: Sheet, loop: LoopValue) -> float | None:
    """How far the values printed for this position leave a loop open (m); None where it closes as well as they are
    printed."""
    if any(abs(sheet.drivers[d.key] - d.values[0]) > 1e-9 for d in sheet.scene.drivers):
        return None
    vectors = stated_arrows(sheet, loop.loop, sheet.scene.printed)
    gap = abs(added_up(vectors, 0j))
    return gap if gap > CLOSES * added_up(map(abs, vectors)) else None


def _angle(tail: complex, vector: complex) -> list[Primitive]:
    """The angle of an arrow, as an arc from a stub of the x axis, counter-clockwise."""
    angle = cmath.phase(vector) % math.tau
    parts: list[Primitive] = [Line(tail, tail + AXIS, strokes.DIRECTION)]
    if angle > 0.05:
        parts.append(Arc(tail, ARC, 0.0, angle - min(0.3, 0.4 * angle), strokes.DIMENSION))
        tip = tail + cmath.rect(ARC, angle).conjugate()
        along = (1j * cmath.rect(1.0, angle)).conjugate()
        head, width = symbols.head_size(POINTER, ARC * angle)
        parts.append(arrowhead(tip, along, head, width, strokes.BLACK))
    return parts


def _lines(
    sheet: Sheet, loop: LoopValue, block: LoopBlock, convention: Convention, spoken: str
) -> list[tuple[str, bool]]:
    scene = sheet.scene
    lines: list[tuple[str, bool]] = []
    head = Phrase("loop heading", (loop.loop.name, ", ".join(loop.loop.links), equation(loop, convention)))
    lines += [(text, True) for text in in_both([say(head, each) for each in languages(spoken)])]
    x, y = projections(loop, block, scene)
    lines += [(f"x:  {x}", False), (f"y:  {y}", False)]
    gap = _gap(sheet, loop)
    if gap is not None:
        told = f"{number(gap / scene.units.metres, 4)} {scene.units.length}"
        left = Phrase("loop open", (loop.loop.name, told))
        lines += [(text, False) for text in in_both([say(left, each) for each in languages(spoken)])]
    if loop.root is not None:
        lines += [(root(loop.root, loop, scene, each), False) for each in languages(spoken)[:1]]
    return lines


def _write(words: list[Primitive], lines: Sequence[tuple[str, bool]], column: Box) -> float:
    y = column.top
    for text, bold in lines:
        for runs in wrapped(text, SMALL, column.width, bold=bold):
            y += LINE
            words.append(Text(complex(column.left, y), runs))
    return y


def _matrices(
    words: list[Primitive], sheet: Sheet, block: LoopBlock, spoken: str, at: complex, right: float
) -> float:
    y = at.imag
    for one in matrices(block, sheet.scene):
        y += LINE
        words.append(Text(complex(at.real, y), rich(term(one.key, spoken), SMALL, bold=True)))
        y = _matrix(words, one, complex(at.real, y + 1.2), right - at.real)
        for line in wrapped(",  ".join(one.solution), SMALL, right - at.real):
            y += LINE
            words.append(Text(complex(at.real, y), line))
    return y


def _matrix(words: list[Primitive], one: MatrixEquation, at: complex, room: float) -> float:
    """A matrix equation set with brackets; returns where it ends."""
    size = SMALL
    while True:
        columns = [[rich(row[k], size) for row in one.rows] for k in range(len(one.unknowns))]
        names, column = [symbol(n, size) for n in one.unknowns], [rich(r, size) for r in one.right]
        wide = [max(map(runs_width, cells)) for cells in columns]
        whole = added_up(wide) + 2.6 * len(wide) + max(map(runs_width, names)) + max(map(runs_width, column)) + 16.0
        if whole <= room or size <= 1.6:
            break
        size -= 0.2
    step, x = 1.5 * size, at.real
    height = step * len(one.rows) + 0.6

    def bracket(x: float, sense: float) -> None:
        for start, end in ((0j, 0.9 * sense + 0j), (0j, height * 1j), (height * 1j, height * 1j + 0.9 * sense)):
            corner = complex(x, at.imag)
            words.append(Line(corner + start, corner + end, strokes.DIMENSION))

    def cells(runs: Sequence[tuple[Run, ...]], x: float, wide: float, anchor: str) -> None:
        for k, cell in enumerate(runs):
            place = x + wide if anchor == "end" else x
            words.append(Text(complex(place, at.imag + step * (k + 0.85)), cell, anchor))

    bracket(x, 1.0)
    x += 1.4
    for column_cells, width in zip(columns, wide, strict=True):
        cells(column_cells, x, width, "end")
        x += width + 2.6
    bracket(x - 1.0, -1.0)
    x += 1.0
    bracket(x, 1.0)
    cells(names, x + 1.4, 0.0, "start")
    x += 2.8 + max(map(runs_width, names))
    bracket(x, -1.0)
    words.append(Text(complex(x + 1.6, at.imag + height / 2 + 0.35 * size), rich("=", size)))
    x += 5.0
    bracket(x, 1.0)
    cells(column, x + 1.4, max(map(runs_width, column)), "end")
    bracket(x + 2.8 + max(map(runs_width, column)), -1.0)
    return at.imag + height


def _described(sheet: Sheet, blocks: Sequence[LoopBlock], spoken: str) -> str:
    said = []
    for each in languages(spoken):
        for loop in (one for block in blocks for one in block.loops):
            points = ", ".join(loop.loop.points)
            said.append(say(Phrase("loop heading", (loop.loop.name, ", ".join(loop.loop.links), points)), each))
    return ". ".join(said)
