"""Figures of a handout at true scale: whole or as far as drawn, bare for the problem sheet, and frames to draw in."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace

from graphkin.account.headings import FIGURE_WORDS, describe, punctuation, term
from graphkin.account.notation import Letters, pole, rows_of, scale_statement
from graphkin.construction.sheet import Equation, Sheet
from graphkin.construction.steps import DiagramName
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import without_titles
from graphkin.drawing.equations import write_equation
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Polygon, Primitive, Text, map_tree, moved
from graphkin.drawing.parts.insets import polygon_with_insets, strip_height
from graphkin.drawing.parts.mechanism import mechanism_piece
from graphkin.drawing.parts.polygon import extent
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import ink_box, joined, layer_groups, moved_piece
from graphkin.drawing.stepwise import so_far, stepped
from graphkin.drawing.text import rich, runs_width, symbol
from graphkin.drawing.write.drawing import Drawing
from graphkin.papers.paper import paper_of
from graphkin.plane import added_up
from graphkin.words import languages

__all__ = [
    "LEAST_FRAME",
    "POLYGONS",
    "bare_picture",
    "blank_equations",
    "blank_sums",
    "cropped",
    "draw_frame",
    "equation_picture",
    "force_space",
    "mechanism_picture",
    "parts",
    "shared_workspace",
    "stage_picture",
    "workspace",
]

ROOM = 11.0  # mm around a figure, for names
AROUND = 14.0  # mm around a polygon that is still to be drawn
FOOT = 9.0  # mm for the scale and the check bar beside it
LEAST_FRAME = 110.0
GAP = 4.0  # mm between the mechanism and the frame beside it
BAR = 50.0  # mm, of the check bar
POLYGONS: tuple[DiagramName, ...] = ("velocity", "acceleration")
Layers = tuple[Group, ...]


def parts(sheet: Sheet, diagram: DiagramName, letters: Letters, language: str) -> Layers:
    """A figure by layers, every part with the class of its step."""
    body = paper_of(sheet.scene).body
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
        piece, _ = polygon_with_insets(sheet, diagram, letters, language, panel, origin, strip)
    return tuple(g for g in stepped(layer_groups(joined((piece,)))) if isinstance(g, Group))


def cropped(
    children: Iterable[Primitive],
    title: str,
    desc: str,
    language: str,
    foot: tuple[Text, tuple[Primitive, ...]] | None = None,
) -> Drawing:
    """Primitives as a drawing just as large as they are; below them the scale, and its check bar beside or under it."""
    children = tuple(children)
    box = (ink_box(children) or Box(0.0, 0.0, 10.0, 10.0)).grown(1.2)
    if foot is None:
        return Drawing(box.width, box.height, moved(children, -box.corners[0]), title, desc, languages(language)[0])
    words, bar = foot
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
    height = box.height + (FOOT if wide else 2 * FOOT)
    return Drawing(width, height, (*whole, *low), title, desc, languages(language)[0])


def bare_picture(figure: Drawing) -> Drawing:
    """A figure as large as its ink and without the scene's titles, where the page has them already."""
    untitled = without_titles(figure.children)
    box = (ink_box(untitled) or Box(0.0, 0.0, 10.0, 10.0)).grown(1.0)
    return replace(figure, width=box.width, height=box.height, children=moved(untitled, -box.corners[0]), further=())


def stage_picture(
    sheet: Sheet, layers: Layers, diagram: DiagramName, letters: Letters, language: str, first: int, last: int
) -> Drawing:
    """A figure up to step ``last``, what is new since step ``first`` on a light band."""
    steps = [step.number for step in sheet.steps if step.diagram == diagram]
    seen = so_far(layers, first if first > steps[0] else last + 1, last)
    if first <= steps[0]:
        whole = so_far(layers, steps[0], last)
        seen = map_tree(whole, lambda thing: None if isinstance(thing, Group) and "new" in thing.classes else thing)
    foot = scale_foot(sheet, diagram, letters, language)
    return cropped(seen, term(FIGURE_WORDS[diagram], language), "", language, foot)


def scale_foot(
    sheet: Sheet, diagram: DiagramName, letters: Letters, language: str
) -> tuple[Text, tuple[Primitive, ...]]:
    """The scale of a figure, and the bar that checks it, each about the left end of its baseline."""
    words = Text(0j, rich(scale_statement(sheet, letters.convention, diagram), 3.2))
    return words, check_bar(0j, rich(term("check bar", language), 2.4))


def mechanism_picture(sheet: Sheet, layers: Layers, letters: Letters, language: str) -> Drawing:
    """The mechanism as a problem shows it: nothing that was found, no arcs."""
    found = {"answers", "construction"}
    special = {s.point for s in sheet.steps if s.reason == "special point"}
    aids = {f"{part}-{point}" for point in special for part in ("special", "point", "label-point")}
    kept = [_without_results(layer, aids) for layer in layers if layer.id not in found]
    return cropped(kept, term("mechanism", language), describe_bare(sheet, language), language,
                   scale_foot(sheet, "mechanism", letters, language))  # fmt: skip


def describe_bare(sheet: Sheet, language: str) -> str:
    """The mechanism in words, without its solution."""
    return describe(sheet, ("mechanism",), language)


def _without_results(layer: Group, aids: Collection[str]) -> Group:
    """Names of angular velocities and accelerations that are to be found go with their arcs, so do special points and
    trial positions; those of drivers stay."""
    kept = tuple(
        thing
        for thing, after in zip(layer.children, (*layer.children[1:], None), strict=False)
        if not _names_result(thing, aids)
        and not (isinstance(thing, Group) and "leader" in thing.classes and _names_result(after, aids))
    )
    return replace(layer, children=kept)


def _names_result(thing: Primitive | None, aids: Collection[str]) -> bool:
    if not isinstance(thing, Group | Text):
        return False
    found = ("label-omega-", "label-alpha-", "label-trial-")
    return thing.id in aids or (isinstance(thing, Text) and thing.id.startswith(found))


def equation_picture(sheet: Sheet, equation: Equation, letters: Letters, language: str, words: str) -> Drawing:
    """A vector equation over its rows of sizes and directions; ``words`` say it for those who do not see it."""
    written = write_equation(sheet, equation, letters, language, paper_of(sheet.scene).body.width - 4.0, 3.8)
    return cropped(written.children, words, "", language)


def workspace(
    sheet: Sheet, diagram: DiagramName, layers: Layers, letters: Letters, language: str, page: Box
) -> Drawing | None:
    """The bare mechanism and the frame for a polygon in one drawing, so that directions are carried over with two set
    squares: side by side, or one above the other; None where a page (its body given) does not hold them."""
    bare = mechanism_picture(sheet, layers, letters, language)
    need = extent(sheet, diagram)
    least = complex(max(need.width + 2 * AROUND, BAR + 40.0), need.height + 2 * AROUND)
    if bare.width + GAP + least.real <= page.width and max(bare.height, least.imag) <= page.height:
        left = bare.width + GAP
        frame = draw_frame(sheet, diagram, letters, language, page.height, page.width - left)
        place, size = complex(left, 0.0), complex(page.width, frame.height)
    elif least.real <= page.width and bare.height + GAP + least.imag <= page.height:
        frame = draw_frame(sheet, diagram, letters, language, page.height - bare.height - GAP, page.width)
        place, size = complex(0.0, bare.height + GAP), complex(page.width, bare.height + GAP + frame.height)
    else:
        return None
    children = (*bare.children, *moved(frame.children, place))
    return Drawing(size.real, size.imag, children, frame.title, bare.desc, languages(language)[0])


def shared_workspace(sheet: Sheet, layers: Layers, letters: Letters, language: str, page: Box) -> Drawing | None:
    """The bare mechanism at the left of the frames for both polygons, these side by side or one above the other; None
    where a page does not hold them, or there is but one polygon."""
    bare = mechanism_picture(sheet, layers, letters, language)
    left = bare.width + GAP
    needs = [extent(sheet, diagram) for diagram in POLYGONS]
    leasts = [complex(max(need.width + 2 * AROUND, BAR + 40.0), need.height + 2 * AROUND) for need in needs]
    if not all(map(sheet.vectors, POLYGONS)) or bare.height > page.height:
        return None
    wide, high = page.width - left - GAP, page.height - GAP
    across, up = added_up(z.real for z in leasts), added_up(z.imag for z in leasts)
    if across <= wide and max(z.imag for z in leasts) <= page.height:
        sizes = [complex(z.real + (wide - across) / 2, page.height) for z in leasts]
        places = [complex(left, 0.0), complex(left + sizes[0].real + GAP, 0.0)]
    elif up <= high and max(z.real for z in leasts) <= page.width - left:
        sizes = [complex(page.width - left, z.imag + (high - up) / 2) for z in leasts]
        places = [complex(left, 0.0), complex(left, sizes[0].imag + GAP)]
    else:
        return None
    frames = [
        moved(draw_frame(sheet, diagram, letters, language, size.imag, size.real).children, place)
        for diagram, size, place in zip(POLYGONS, sizes, places, strict=True)
    ]
    title = ", ".join(term(FIGURE_WORDS[diagram], language) for diagram in POLYGONS)
    children = (*bare.children, *(thing for frame in frames for thing in frame))
    return Drawing(page.width, page.height + 0.2, children, title, bare.desc, languages(language)[0])


def draw_frame(
    sheet: Sheet, diagram: DiagramName, letters: Letters, language: str, height: float | None = None,
    width: float | None = None,
) -> Drawing:  # fmt: skip
    """A frame to draw a polygon in, with the pole where the polygon will have room, and its scale."""
    content = extent(sheet, diagram)
    page = paper_of(sheet.scene).body
    wide = width or page.width
    tall = height or min(page.height - 40.0, max(LEAST_FRAME, content.height + 2 * AROUND))
    box = Box(0.2, 0.2, wide - 0.2, tall)
    # to the nearest 5 mm, so that the place of the pole does not tell the answer
    at = _snapped(box.centre - content.centre)
    mark = pole(letters.convention, diagram)
    words, bar = scale_foot(sheet, diagram, letters, language)
    children: list[Primitive] = [
        Polygon(box.corners, "", strokes.DIMENSION),
        Circle(at, 0.9, fill=strokes.WHITE, stroke=strokes.OUTLINE),
        Circle(at, 0.3, fill=strokes.BLACK),
        Text(at + complex(1.6, -1.6), symbol(mark, 3.5)),
        *moved((words,), complex(3.0, tall - 3.0)),
        *moved(bar, complex(wide - 3.0 - BAR, tall - (3.0 if wide > 2 * BAR else 10.0))),
    ]
    title = f"{term(FIGURE_WORDS[diagram], language)}{punctuation('colon', language)}{mark}"
    return Drawing(wide, tall + 0.2, tuple(children), title, "", languages(language)[0])


def force_space(sheet: Sheet, layers: Layers, letters: Letters, language: str, page: Box) -> Drawing:
    """The bare mechanism, on which directions and arms are taken, and a frame for force polygons with their scale: side
    by side, one above the other, or the frame alone where the mechanism leaves no room on a page."""
    bare = mechanism_picture(sheet, layers, letters, language)
    beside = page.width - bare.width - GAP >= LEAST_FRAME and bare.height <= page.height
    above = not beside and page.height - bare.height - GAP >= LEAST_FRAME / 2 and bare.width <= page.width
    left, top = (bare.width + GAP if beside else 0.0), (bare.height + GAP if above else 0.0)
    box = Box(left + 0.2, top + 0.2, page.width - 0.2, page.height)
    words, bar = scale_foot(sheet, "force", letters, language)
    children: list[Primitive] = [
        *(bare.children if beside or above else ()),
        Polygon(box.corners, "", strokes.DIMENSION),
        *moved((words,), complex(left + 3.0, box.bottom - 3.0)),
        *moved(bar, complex(box.right - 3.0 - BAR, box.bottom - 3.0)),
    ]
    title = term("forces", language)
    return Drawing(page.width, page.height + 0.2, tuple(children), title, bare.desc, languages(language)[0])


def _snapped(z: complex) -> complex:
    return complex(5.0 * round(z.real / 5.0), 5.0 * round(z.imag / 5.0))


def blank_equations(equations: Iterable[Equation], letters: Letters, language: str, width: float) -> Drawing:
    """A blank for each equation: a box for each term, above boxes for its size and direction where they are rows."""
    rows = []
    for equation in equations:
        cells = [len(side) for side in equation.sides]
        count = max(2, sum(cells))
        signs = (
            ["="] if sum(cells) == 1 else [s for i, n in enumerate(cells) for s in ["="] * (i > 0) + ["+"] * (n - 1)]
        )
        rows.append((count, signs, ""))
    return _blanks(rows, letters, language, width)


def blank_sums(counts: Iterable[int], letters: Letters, language: str, width: float) -> Drawing:
    """A blank for each sum of so many forces that is nought."""
    return _blanks([(count, ["+"] * (count - 1), "= 0") for count in counts], letters, language, width)


def _blanks(
    rows: Iterable[tuple[int, Sequence[str], str]], letters: Letters, language: str, width: float
) -> Drawing:
    """Rows of so many boxes with these signs between them and these words behind them."""
    heads = (
        (term("size", language), term("direction of", language))
        if rows_of(letters.convention) in ("rows", "table")
        else ()
    )
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
            children.append(_box(x, y, cell, 9.0))
            children += [_box(x, y + 9.0 + 6.5 * row, cell, 6.5) for row in range(len(heads))]
            x += cell + 5.0
        if tail:
            children.append(Text(complex(x - 3.0, y + 6.2), rich(tail, 3.5)))
        for row, head in enumerate(heads):
            children.append(Text(complex(0.0, y + 13.6 + 6.5 * row), rich(head, 2.8)))
        y += 13.0 + 6.5 * len(heads)
    return Drawing(width, y - 2.0, tuple(children), term("your equations", language), "", languages(language)[0])


def _box(x: float, y: float, width: float, height: float) -> Polygon:
    return Polygon(Box(x, y, x + width, y + height).corners, "", strokes.DIMENSION)
