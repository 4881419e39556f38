"""Figures of a handout at true scale: whole or as far as drawn, bare for the problem sheet, and frames to draw in."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

from graphkin.account.headings import FIGURE_WORDS, describe, punctuation, term
from graphkin.account.notation import pole, rows_of, scale_statement
from graphkin.construction.board.sheet import Equation
from graphkin.construction.board.steps import DiagramName
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import without_titles
from graphkin.drawing.equations import line_to_set
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Polygon, Primitive, Text, map_tree, moved
from graphkin.drawing.parts.insets import polygon_with_insets, strip_height
from graphkin.drawing.parts.mechanism import mechanism_piece
from graphkin.drawing.parts.polygon import extent
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import ink_box, joined, layer_groups, moved_piece
from graphkin.drawing.stepwise import so_far, stepped
from graphkin.drawing.text import rich, runs_width
from graphkin.drawing.write.drawing import Drawing
from graphkin.papers.lesson import Lesson
from graphkin.plane import added_up

ROOM = 11.0  # mm around a figure, for names
AROUND = 14.0  # mm around a polygon that is still to be drawn
FOOT = 9.0  # mm for the scale and the check bar beside it
LEAST_FRAME = 110.0
GAP = 4.0  # mm between the mechanism and the frame beside it
BAR = 50.0  # mm, of the check bar
POLYGONS: tuple[DiagramName, ...] = ("velocity", "acceleration")
Layers = tuple[Group, ...]


def parts(lesson: Lesson, diagram: DiagramName) -> Layers:
    """A figure by layers, every part with the class of its step."""
    sheet, letters = lesson.sheet, lesson.letters
    body = lesson.paper.body
    if diagram == "mechanism":
        piece, content = mechanism_piece(sheet, letters, (body.width, body.height - 20.0))
        panel = Box(0.0, 0.0, content.width + 2 * ROOM, content.height + 2 * ROOM)
        piece = with_labels(moved_piece(piece, panel.centre - content.centre), panel)
    else:
        content = extent(sheet, diagram)
        width = max(content.width + 2 * ROOM, min(body.width, 110.0))
        panel = Box(0.0, 0.0, width, content.height + 2 * ROOM)
        strip = Box(0.0, panel.bottom, width, panel.bottom + strip_height(sheet, diagram, width))
        origin = panel.centre - content.centre
        piece, _ = polygon_with_insets(sheet, diagram, letters, lesson.language, panel, origin, strip)
    return tuple(g for g in stepped(layer_groups(joined((piece,)))) if isinstance(g, Group))


def _cropped(
    lesson: Lesson, children: Iterable[Primitive], title: str, desc: str, diagram: DiagramName | None = None
) -> Drawing:
    """Primitives as a drawing of their own size; below a diagram its scale, and the check bar beside or under it."""
    first = lesson.first
    children = tuple(children)
    box = (ink_box(children) or Box(0.0, 0.0, 10.0, 10.0)).grown(1.2)
    if diagram is None:
        return Drawing(box.width, box.height, moved(children, -box.corners[0]), title, desc, first)
    words, bar = _scale_foot(lesson, diagram)
    lead = runs_width(words.runs) + 8.0
    wide = box.width >= lead + BAR
    width = max(box.width, BAR + 2.4)
    left = max(1.2, (width - lead - BAR) / 2) if wide else (width - BAR) / 2
    base = box.height + FOOT - 2.0
    low = (
        *moved((words,), complex(left, base)),
        *moved(bar, complex(left + lead, base) if wide else complex(left, base + FOOT)),
    )
    whole = moved(children, complex((width - box.width) / 2, 0.0) - box.corners[0])
    return Drawing(width, box.height + (FOOT if wide else 2 * FOOT), (*whole, *low), title, desc, first)


def _scale_foot(lesson: Lesson, diagram: DiagramName) -> tuple[Text, tuple[Primitive, ...]]:
    """The scale of a figure, and the bar that checks it, each about the left end of its baseline."""
    words = Text(0j, rich(scale_statement(lesson.sheet, lesson.letters.convention, diagram), 3.2))
    return words, check_bar(0j, rich(term("check bar", lesson.language, length="50 mm"), 2.4))


def bare_picture(figure: Drawing) -> Drawing:
    """A figure of the size of its ink, without the scene's titles if the page has them already."""
    untitled = without_titles(figure.children)
    box = (ink_box(untitled) or Box(0.0, 0.0, 10.0, 10.0)).grown(1.0)
    return replace(figure, width=box.width, height=box.height, children=moved(untitled, -box.corners[0]), further=())


def stage_picture(lesson: Lesson, layers: Layers, diagram: DiagramName, first: int, last: int) -> Drawing:
    """A figure up to step ``last``, the strokes from step ``first`` on with a light band."""
    steps = [step.number for step in lesson.sheet.of(diagram)]
    seen = so_far(layers, first if first > steps[0] else last + 1, last)
    if first <= steps[0]:
        whole = so_far(layers, steps[0], last)
        seen = map_tree(whole, lambda shape: None if isinstance(shape, Group) and "new" in shape.classes else shape)
    return _cropped(lesson, seen, term(FIGURE_WORDS[diagram], lesson.language), "", diagram)


def mechanism_picture(lesson: Lesson) -> Drawing:
    """The mechanism of a problem: without found quantities and arcs, described without its solution.

    Names of unknown angular velocities and accelerations are left out with their arcs, and so are special points and
    trial positions; those of drivers stay.
    """
    special = lesson.sheet.special_points
    special_ids = {f"{part}-{point}" for point in special for part in ("special", "point", "label-point")}

    def names_result(shape: Primitive | None) -> bool:
        results = ("label-omega-", "label-alpha-", "label-trial-")
        named = isinstance(shape, Text) and shape.id.startswith(results)
        return named or (isinstance(shape, Group | Text) and shape.id in special_ids)

    kept = []
    for layer in parts(lesson, "mechanism"):
        if layer.id not in ("answers", "construction"):
            both = zip(layer.children, (*layer.children[1:], None), strict=True)
            shapes = tuple(
                shape for shape, after in both if not names_result(shape)
                and not (isinstance(shape, Group) and "leader" in shape.classes and names_result(after))
            )
            kept.append(layer._replace(children=shapes))
    described = describe(lesson.sheet, ("mechanism",), lesson.language)
    return _cropped(lesson, kept, term("mechanism", lesson.language), described, "mechanism")


def equation_picture(lesson: Lesson, equation: Equation) -> Drawing:
    """A vector equation over its rows of sizes and directions; ``v_B3 = v_B2 + v_B3B2`` for who cannot see it."""
    sheet, letters = lesson.sheet, lesson.letters
    sides = (" + ".join(str(letters.vector(t.symbol)) for t in side) for side in equation.sides)
    width = lesson.paper.body.width - 4.0
    written = line_to_set(equation, sheet, letters, lesson.language)(width, 3.8)
    return _cropped(lesson, written.piece.drawn, " = ".join(sides), "")


# frames to draw in


def workspace(lesson: Lesson, bare: Drawing, diagrams: Sequence[DiagramName], page: Box) -> Drawing | None:
    """The bare mechanism and the frames for polygons in one drawing, so that directions are carried over with two set
    squares: the frames at its right, side by side or above each other, or a single one below it; None where a page (its
    body given) has no room for them."""
    needs = [extent(lesson.sheet, diagram) for diagram in diagrams]
    leasts = [complex(max(need.width + 2 * AROUND, BAR + 40.0), need.height + 2 * AROUND) for need in needs]
    count, left, top = len(diagrams), bare.width + GAP, bare.height + GAP
    wide, high = page.width - left - GAP * (count - 1), page.height - GAP * (count - 1)
    across, up = added_up(z.real for z in leasts), added_up(z.imag for z in leasts)
    widest, highest = max(z.real for z in leasts), max(z.imag for z in leasts)
    if across <= wide and max(bare.height, highest) <= page.height:
        sizes = [complex(z.real + (wide - across) / count, page.height) for z in leasts]
        place, along = complex(left, 0.0), 1.0 + 0j
    elif count > 1 and up <= high and bare.height <= page.height and widest <= page.width - left:
        sizes = [complex(page.width - left, z.imag + (high - up) / count) for z in leasts]
        place, along = complex(left, 0.0), 1j
    elif count == 1 and widest <= page.width and top + up <= page.height:
        sizes = [complex(page.width, page.height - top)]
        place, along = complex(0.0, top), 1j
    else:
        return None
    children = [*bare.children]
    for diagram, size in zip(diagrams, sizes, strict=True):
        frame = draw_frame(lesson, diagram, size.imag, size.real)
        children += moved(frame.children, place)
        place += along * (GAP + (size.real if along.real else size.imag))
    title = frame.title if count == 1 else ", ".join(term(FIGURE_WORDS[d], lesson.language) for d in diagrams)
    first = lesson.first
    return Drawing(page.width, page.height + 0.2, tuple(children), title, bare.desc, first)


def draw_frame(
    lesson: Lesson, diagram: DiagramName, height: float | None = None, width: float | None = None
) -> Drawing:
    """A frame for drawing a polygon, with the pole where the polygon has room, and its scale; no pole for forces."""
    page, language = lesson.paper.body, lesson.language
    title, wide, marks = term(FIGURE_WORDS[diagram], language), width or page.width, list[Primitive]()
    tall = height or page.height - 40.0
    if diagram != "force":
        content = extent(lesson.sheet, diagram)
        tall = height or min(tall, max(LEAST_FRAME, content.height + 2 * AROUND))
        # to the nearest 5 mm, so that the place of the pole does not tell the answer
        shift = Box(0.2, 0.2, wide - 0.2, tall).centre - content.centre
        at = complex(5.0 * round(shift.real / 5.0), 5.0 * round(shift.imag / 5.0))
        mark = pole(lesson.letters.convention, diagram)
        title += punctuation("colon", language) + str(mark)
        marks += Circle(at, 0.9, fill=strokes.WHITE, stroke=strokes.OUTLINE), Circle(at, 0.3, fill=strokes.BLACK)
        marks.append(Text(at + complex(1.6, -1.6), rich(mark, 3.5)))
    words, bar = _scale_foot(lesson, diagram)
    children = (
        Polygon(Box(0.2, 0.2, wide - 0.2, tall).corners, "", strokes.DIMENSION), *marks,
        *moved((words,), complex(3.0, tall - 3.0)),
        *moved(bar, complex(wide - 3.0 - BAR, tall - (3.0 if wide > 2 * BAR else 10.0))),
    )
    return Drawing(wide, tall + 0.2, children, title, "", lesson.first)


def force_space(lesson: Lesson, bare: Drawing, page: Box) -> Drawing:
    """The bare mechanism, on which directions and arms are taken, and a frame for force polygons with their scale: side
    by side, above each other, or the frame alone where the mechanism leaves no room on a page."""
    beside = page.width - bare.width - GAP >= LEAST_FRAME and bare.height <= page.height
    above = not beside and page.height - bare.height - GAP >= LEAST_FRAME / 2 and bare.width <= page.width
    corner = complex(bare.width + GAP if beside else 0.0, bare.height + GAP if above else 0.0)
    frame = draw_frame(lesson, "force", page.height - corner.imag, page.width - corner.real)
    children = (*(bare.children if beside or above else ()), *moved(frame.children, corner))
    return replace(frame, width=page.width, height=page.height + 0.2, children=children, desc=bare.desc)


def blank_equations(lesson: Lesson, equations: Iterable[Equation], width: float) -> Drawing:
    """A blank for each equation: a box for each term, above boxes for its size and direction if they are rows."""
    rows = []
    for equation in equations:
        cells = [len(side) for side in equation.sides]
        signs = [sign for i, n in enumerate(cells) for sign in ["="] * (i > 0) + ["+"] * (n - 1)] or ["="]
        rows.append((max(2, sum(cells)), signs, ""))
    return blanks(lesson, rows, width)


def blanks(lesson: Lesson, rows: Iterable[tuple[int, Sequence[str], str]], width: float) -> Drawing:
    """Rows of boxes with these signs between them and these words after them."""
    language = lesson.language
    rowed = rows_of(lesson.letters.convention) in ("rows", "table")
    heads = (term("size", language), term("direction of", language)) if rowed else ()
    lead = max((runs_width(rich(h, 2.8)) for h in heads), default=0.0) + 2.0
    children: list[Primitive] = []
    y = 1.0
    for count, signs, tail in rows:
        behind = 8.0 if tail else 0.0
        cell = min(38.0, (width - lead - behind - 5.0 * (count - 1) - 0.4) / count)
        x = lead
        for i in range(count):
            if i:
                children.append(Text(complex(x - 2.5, y + 6.2), rich(signs[i - 1], 3.5), "middle"))
            tops = [y, *(y + 9.0 + 6.5 * row for row in range(len(heads) + 1))]
            for top, bottom in pairwise(tops):
                children.append(Polygon(Box(x, top, x + cell, bottom).corners, "", strokes.DIMENSION))
            x += cell + 5.0
        if tail:
            children.append(Text(complex(x - 3.0, y + 6.2), rich(tail, 3.5)))
        for row, head in enumerate(heads):
            children.append(Text(complex(0.0, y + 13.6 + 6.5 * row), rich(head, 2.8)))
        y += 13.0 + 6.5 * len(heads)
    return Drawing(width, y - 2.0, tuple(children), term("your equations", language), "", lesson.first)
