"""The sheet of forces: given masses and loads, each group cut free with its polygon, its equations and readings, in the
order in which they are found, and the readings with their check; on as many pages as it takes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from graphkin.account.forces import couple_sentences, inertia_line, moment_sentences, read_off, sum_terms
from graphkin.account.given_loads import given_loads, spring_lines
from graphkin.account.headings import facts, figure_title, term
from graphkin.account.notation import Letters, letters_of, scale_statement
from graphkin.checking.report import Report
from graphkin.construction.forces.force_sheet import ForceGroup, ForceSheet, ForceVector
from graphkin.construction.sheet import Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.equations import write_sum
from graphkin.drawing.force_polygon import drawn_polygon, extent_of, polygons_of
from graphkin.drawing.force_stages import ForceStage, force_stages
from graphkin.drawing.free_body import free_body, sketch_height
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Group, Polygon, Primitive, Run, Text
from graphkin.drawing.overleaf import heading
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.piece import Piece, joined, layer_groups, moved_piece
from graphkin.drawing.stepwise import stepped
from graphkin.drawing.tables import TableRow, readings_table
from graphkin.drawing.text import fitted, plain, rich, wrapped
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import Phrase, about, in_all, languages, listed, say

__all__ = ["forces_figure", "group_equation", "group_picture"]

MARGIN, HEAD, FOOT = 10.0, 13.0, 12.0  # mm of the page
SKETCH = 64.0  # mm, width of a sketch
AROUND, LEAST, SMALLEST = 11.0, 46.0, 26.0  # mm of room around a polygon; least heights of panels
GAP, LINE, SIZE = 4.0, 4.3, 2.8


@dataclass(frozen=True)
class _Block:
    """Part of the sheet, about its left upper corner."""

    piece: Piece
    height: float


def forces_figure(
    sheet: Sheet, forces: ForceSheet, report: Report | None = None, *, language: str | None = None,
    convention: str | None = None,
) -> Drawing:  # fmt: skip
    """The forces of a drawn position on pages of the scene's paper.

    Parameters
    ----------
    sheet, forces : what is drawn of motion and of forces
    report : readings held against the exact values; without it there is no table
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    """
    spoken = language or sheet.scene.sheet.language
    sheet = replace(sheet, scales=replace(sheet.scales, force=forces.per_mm))
    letters = letters_of(sheet, convention or sheet.scene.sheet.convention)  # type: ignore[arg-type]
    width, height = _paper(sheet, forces)
    page = Box(MARGIN, MARGIN, width - MARGIN, height - MARGIN)
    blocks = [*_given(sheet, forces, letters, spoken, page.width), *_groups(sheet, forces, letters, spoken, page.width)]
    if report is not None:
        rows = [TableRow(row.reading, row) for row in report.rows if row.symbol.scope == "force"]
        blocks += _tables(replace(sheet, scales=report.scales), rows, letters, spoken, page)
    return _pages(sheet, blocks, letters, spoken, page)


def _groups(sheet: Sheet, forces: ForceSheet, letters: Letters, spoken: str, width: float) -> Iterator[_Block]:
    """Group by group in the order in which forces are found; where loads begin or end here, without and with them."""
    names: Counter[str] = Counter()
    state = None
    for stage in force_stages(sheet, forces, letters, spoken):
        if stage.group is None:
            continue
        if len(forces.states) > 1 and stage.state is not state:
            yield _said("force with load" if stage.again else "force without load", spoken, width)
        state = stage.state
        yield from _group(sheet, forces, stage, stage.group, letters, spoken, width, names)


def _paper(sheet: Sheet, forces: ForceSheet) -> tuple[float, float]:
    """Width and height of the scene's paper, or of a larger one where a wished scale needs it."""
    boxes = [
        extent_of((*vectors, *inside))
        for state in forces.states for group in state.groups for _, vectors, inside in polygons_of(group)
    ]  # fmt: skip
    width = max((box.width for box in boxes), default=0.0) + 2 * (AROUND + MARGIN)
    height = max((box.height for box in boxes), default=0.0) + 2 * (AROUND + MARGIN) + HEAD + FOOT + 2 * LINE
    own = sheet.scene.sheet.size
    return max(own[0], width), max(own[1], height)


def _pages(sheet: Sheet, blocks: Sequence[_Block], letters: Letters, spoken: str, page: Box) -> Drawing:
    """Blocks below each other, as many to a page as it holds."""
    inside = Box(page.left, page.top + HEAD, page.right, page.bottom - FOOT)
    pages: list[list[Piece]] = [[]]
    y = inside.top
    for block in blocks:
        if y + block.height > inside.bottom and pages[-1]:
            pages.append([])
            y = inside.top
        pages[-1].append(moved_piece(block.piece, complex(page.left, y)))
        y += block.height + GAP
    made = []
    for number, pieces in enumerate(pages, 1):
        whole = joined((heading(sheet, letters, spoken, page), *pieces, _foot(sheet, letters, spoken, page, number)))
        title = figure_title(sheet, "forces", spoken) + (f" ({number})" if number > 1 else "")
        made.append(
            Drawing(
                page.left + page.right, page.top + page.bottom, layer_groups(whole), title,
                say(Phrase("force described"), languages(spoken)[0]), languages(spoken)[0], _facts(sheet),
            )
        )  # fmt: skip
    first, *further = made
    return replace(first, further=tuple(further))


def _facts(sheet: Sheet) -> dict[str, object]:
    units = sheet.scene.units
    return facts(sheet, "forces") | {
        "scales": {
            "length": float(f"{sheet.scales.length * 1e3:.12g}"),
            "force": float(f"{sheet.scales.force / units.newtons:.12g}"),
        }
    }


def _foot(sheet: Sheet, letters: Letters, spoken: str, page: Box, number: int) -> Piece:
    told = term("forces", spoken) + ",  " + scale_statement(sheet, letters.convention, "force")
    words: list[Primitive] = [Text(complex(page.left, page.bottom - 2.0), fitted(told, 3.2, page.width - 70.0))]
    words += check_bar(complex(page.right - 50.0, page.bottom - 3.0), rich(term("check bar", spoken), 2.4))
    if number > 1:
        text = plain(say(Phrase("sheet number", (number,)), languages(spoken)[0]), 2.6)
        words.append(Text(complex(page.right, page.bottom + 4.0), text, "end"))
    return Piece({"labels": tuple(words)})


def _words(lines: Sequence[tuple[str, bool]], width: float, size: float = SIZE) -> _Block:
    """Lines of words with symbols, bold where that is said."""
    rows: list[tuple[Run, ...]] = [runs for text, bold in lines for runs in wrapped(text, size, width, bold=bold)]
    height = LINE * size / SIZE
    texts = tuple(Text(complex(0.0, height * (k + 0.75)), runs) for k, runs in enumerate(rows))
    return _Block(Piece({"labels": texts}), height * len(rows))


def _said(key: str, spoken: str, width: float) -> _Block:
    return _words([(say(Phrase(key), each), True) for each in languages(spoken)], width)


def _given(sheet: Sheet, forces: ForceSheet, letters: Letters, spoken: str, width: float) -> Iterator[_Block]:
    lines: list[tuple[str, bool]] = []
    every = languages(spoken)
    lines.append((term("given", spoken), True))
    lines += [(text, False) for told in given_loads(sheet, letters) for text in in_all(told, spoken)]
    if forces.inertias:
        lines += [(say(Phrase("force inertia"), each), True) for each in every]
        lines += [(inertia_line(sheet, one, letters), False) for one in forces.inertias.values()]
    lines += [(text, False) for told in spring_lines(sheet, forces, letters) for text in in_all(told, spoken)]
    yield _words(lines, width)


def _group(
    sheet: Sheet, forces: ForceSheet, stage: ForceStage, group: ForceGroup, letters: Letters, spoken: str, width: float,
    names: Counter[str],
) -> Iterator[_Block]:  # fmt: skip
    """A group: its caption, its sketch beside its polygon, and what is written below."""
    caption = _words([(text, True) for _, text in stage.title], width, 3.2)
    lower = _below(sheet, forces, stage, group, letters, spoken, width)
    first, *rest = _pictures(sheet, forces, stage, group, letters, spoken, width, names)
    above = _stacked((caption, first))
    if rest or above.height + lower.height > sheet.scene.sheet.size[1] - 2 * MARGIN - HEAD - FOOT:
        yield from (above, *rest, lower)
    else:
        yield _stacked((above, lower))


def group_picture(
    sheet: Sheet, forces: ForceSheet, stage: ForceStage, group: ForceGroup, letters: Letters, spoken: str, width: float,
    tag: str,
) -> Drawing:  # fmt: skip
    """The sketch of a group cut free with its polygons, every part with its step, and nothing written below; ``tag``
    ends the names of its parts."""
    names: Counter[str] = Counter()
    whole = _stacked(list(_pictures(sheet, forces, stage, group, letters, spoken, width, names, tag)))
    title = figure_title(sheet, "forces", spoken)
    told = say(Phrase("force described"), languages(spoken)[0])
    widest = max((extent_of((*vectors, *inside)).width for _, vectors, inside in polygons_of(group)), default=0.0)
    width = max(width, widest + 2 * AROUND)
    parts = stepped(layer_groups(whole.piece), {})  # leaders come with their names
    return Drawing(width, whole.height, parts, title, told, languages(spoken)[0])


def _pictures(
    sheet: Sheet, forces: ForceSheet, stage: ForceStage, group: ForceGroup, letters: Letters, spoken: str, width: float,
    names: Counter[str], tag: str = "",
) -> Iterator[_Block]:  # fmt: skip
    """The sketch of a group beside its polygon, or above its polygons."""
    suffix = ("-with" if stage.again else "") + tag
    polygons = [(link, vectors, inside, extent_of((*vectors, *inside))) for link, vectors, inside in polygons_of(group)]
    alone = len(polygons) == 1 and polygons[0][3].width + 2 * AROUND <= width - SKETCH - GAP
    wide = SKETCH if alone else width
    height = max(LEAST, sketch_height(sheet, group, wide))
    if alone:
        height = max(height, polygons[0][3].height + 2 * AROUND)
    panel = Box(0.0, 0.0, wide, height)
    sketch = free_body(sheet, forces, stage, group, letters, panel.grown(-0.6), "-".join(group.links) + suffix)
    drawn = joined((sketch, _frame(panel)))
    if not alone:
        yield _Block(drawn, height)
        yield from _rows(sheet, stage, polygons, letters, spoken, width, names, suffix)
        return
    _, vectors, inside, _ = polygons[0]
    panel = Box(SKETCH + GAP, 0.0, width, height)
    polygon = drawn_polygon(sheet, stage, "", vectors, inside, letters, panel.grown(-0.6), names, suffix)
    yield _Block(joined((drawn, polygon, _frame(panel))), height)


def _rows(
    sheet: Sheet, stage: ForceStage,
    polygons: Sequence[tuple[str, Sequence[ForceVector], Sequence[ForceVector], Box]], letters: Letters, spoken: str,
    width: float, names: Counter[str], suffix: str,
) -> Iterator[_Block]:  # fmt: skip
    """Polygons of single links beside each other, row by row."""
    placed: list[Piece] = []
    x = row = 0.0
    for link, vectors, inside, box in polygons:
        wide, high = max(box.width + 2 * AROUND, 40.0), max(box.height + 2 * AROUND, SMALLEST)
        if placed and x + wide > width + 0.1:
            yield _Block(joined(placed), row + LINE)
            placed, x, row = [], 0.0, 0.0
        panel = Box(x, LINE, x + wide, LINE + high)
        polygon = drawn_polygon(sheet, stage, link, vectors, inside, letters, panel.grown(-0.6), names, suffix)
        placed += [polygon, _frame(panel)]
        if link:
            said = " / ".join(say(Phrase("force on link", (link,)), each) for each in languages(spoken))
            placed.append(Piece({"labels": (Text(complex(x + 1.0, LINE - 1.0), rich(said, 2.4)),)}))
        x, row = x + wide + 2.0, max(row, high)
    if placed:
        yield _Block(joined(placed), row + LINE)


def _stacked(blocks: Sequence[_Block]) -> _Block:
    pieces, y = [], 0.0
    for block in blocks:
        pieces.append(moved_piece(block.piece, complex(0.0, y)))
        y += block.height + 1.6
    return _Block(joined(pieces), y)


def _below(
    sheet: Sheet, forces: ForceSheet, stage: ForceStage, group: ForceGroup, letters: Letters, spoken: str, width: float
) -> _Block:
    """Moments with their reasons, the vector equation with its rows, and what was read off."""
    blocks = []
    said = [line for told in moment_sentences(sheet, group, letters) for line in told.lines]
    if group.way == "drawn system":
        said.append(Phrase("force reason system", (listed(group.links),)))
    elif len(group.equation) > 1 and group.way == "polygon":
        said.append(Phrase(about("force reason polygon", group.links), (listed(group.links),)))
    if said:
        blocks.append(_words([(text, False) for told in said for text in in_all(told, spoken)], width))
    if group.way != "drawn system" and len(group.equation) > 1:
        written = write_sum(sum_terms(sheet, group, letters), letters, spoken, width)
        blocks.append(_Block(Piece({"labels": (Group(written.children, id=""),)}), written.height))
    couples = [line for told in couple_sentences(sheet, group, letters) for line in told.lines]
    read = read_off(sheet, forces, stage.state, group, letters)
    last = [*couples, *([";  ".join(read.values())] if read else [])]
    if last:
        blocks.append(_words([(text, False) for told in last for text in in_all(told, spoken)], width))
    return _stacked(blocks)


def group_equation(sheet: Sheet, group: ForceGroup, letters: Letters, language: str, width: float) -> Drawing | None:
    """The equation of a group over its rows of sizes and directions; None where it is drawn by one system."""
    if group.way == "drawn system" or len(group.equation) < 2:
        return None
    written = write_sum(sum_terms(sheet, group, letters), letters, language, width)
    title = term("forces", language)
    return Drawing(written.width, written.height, written.children, title, "", languages(language)[0])


def _frame(panel: Box) -> Piece:
    return Piece({"construction": (Group((Polygon(panel.corners, "", strokes.DIMENSION),), classes=("panel",)),)})


def _tables(sheet: Sheet, rows: Sequence[TableRow], letters: Letters, spoken: str, page: Box) -> Iterator[_Block]:
    """The readings with their check, parted where they do not fit one page."""
    left = list(rows)
    caption = Text(complex(0.0, 3.0), rich(term("readings", spoken), 3.2, bold=True))
    while left:
        most = min(len(left), 80)
        height = 10.0 + 4.2 * -(-most // 2) + 3.7 * (len(languages(spoken)) - 1)
        area = Box(0.0, 5.0, page.width, 5.0 + height)
        table, shown = readings_table(sheet, left[:most], letters, spoken, area)
        yield _Block(Piece({"labels": (caption,), "answers": table}), height + 6.0)
        if shown == 0:
            return
        left = left[shown:]
