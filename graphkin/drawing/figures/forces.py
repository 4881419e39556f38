"""The sheet of forces: given masses and loads, each group cut free with its polygon, its equations and readings, in the
order in which they are found, and the readings with their check; on as many pages as it takes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from graphkin.account.forces import couple_sentences, inertia_line, moment_sentences, read_off, sum_terms
from graphkin.account.given_loads import given_loads, spring_lines
from graphkin.account.headings import figure_title, term
from graphkin.account.notation import Letters
from graphkin.checking.report import Report
from graphkin.construction.forces.force_sheet import ForceGroup, ForceSheet, ForceVector
from graphkin.construction.sheet import Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import MARGIN, Block, FigurePage, column, framed, pages, panel, prose, row, rows
from graphkin.drawing.equations import write_sum
from graphkin.drawing.figures import Figure
from graphkin.drawing.force_stages import ForceStage, force_stages
from graphkin.drawing.ink.primitives import Group
from graphkin.drawing.parts.free_body import drawn_polygon, extent_of, free_body, polygons_of, sketch_height
from graphkin.drawing.place.piece import Piece, layer_groups
from graphkin.drawing.stepwise import tied
from graphkin.drawing.tables import TableRow, readings_table
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import Phrase, about, languages, listed, say

__all__ = ["FIGURES", "forces_figure", "group_equation", "group_picture"]

SKETCH = 64.0  # mm, width of a sketch
AROUND = 11.0  # mm of room around a polygon
LEAST, SMALLEST, NARROW = 46.0, 26.0, 40.0  # mm, least heights of a sketch and a polygon, and width
APART, CLOSE, INSIDE = 4.0, 2.0, 0.6  # mm between groups, between the parts of one, and inside a frame


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
    sheet = replace(sheet, scales=replace(sheet.scales, force=forces.per_mm))
    page = FigurePage.of(sheet, "forces", language, convention)
    width, height = sheet.scene.sheet.size
    boxes = [
        extent_of((*vectors, *inside)).grown(AROUND)
        for state in forces.states for group in state.groups for _, vectors, inside in polygons_of(group)
    ]  # fmt: skip
    page = replace(page, width=max(width - 2 * MARGIN, *(box.width for box in boxes), 0.0))
    below = page.at_drivers(page.term("forces"))
    spare = page.height_for(below, height)
    needed = max((box.height for box in boxes), default=0.0) + 2 * page.prose(("force",)).height
    room, height = max(spare, needed), height + max(0.0, needed - spare)  # a larger paper for a wished scale
    blocks = [_given(page, forces), *_groups(page, forces, room)]
    if report is not None:
        rows = [TableRow(row.reading, row) for row in report.rows if row.symbol.scope == "force"]
        blocks += _tables(replace(page, sheet=replace(sheet, scales=report.scales)), rows)
    units = sheet.scene.units
    scales = {"length": sheet.scales.length * 1e3, "force": sheet.scales.force / units.newtons}
    first, *further = (
        page.drawing(
            below, body, page.scale("force"), title="forces", said=page.said("force described")[0], height=height,
            note=say(Phrase("sheet number", (number,)), languages(page.language)[0]) if number > 1 else "",
            metadata={"scales": {name: float(f"{per:.12g}") for name, per in scales.items()}},
        ) for number, body in enumerate(pages(blocks, room, APART), 1)
    )  # fmt: skip
    further = [replace(one, title=f"{one.title} ({number})") for number, one in enumerate(further, 2)]
    return replace(first, further=tuple(further))


def _groups(page: FigurePage, forces: ForceSheet, room: float) -> Iterator[Block]:
    """Group by group in the order in which forces are found; where loads begin or end here, without and with them."""
    names: Counter[str] = Counter()
    state = None
    for stage in force_stages(page.sheet, forces, page.letters, page.language):
        if stage.group is None:
            continue
        if len(forces.states) > 1 and stage.state is not state:
            yield page.prose((Phrase("force with load" if stage.again else "force without load"),), bold=True)
        state = stage.state
        yield from _group(page, forces, stage, stage.group, room, names)


def _given(page: FigurePage, forces: ForceSheet) -> Block:
    """Masses and loads, inertia forces, springs."""
    sheet, letters = page.sheet, page.letters
    inertia = [inertia_line(sheet, one, letters) for one in forces.inertias.values()]
    return column(
        page.prose((page.term("given"),), bold=True), page.prose(given_loads(sheet, letters)),
        page.prose((Phrase("force inertia"),) * bool(inertia), bold=True), page.prose(inertia),
        page.prose(spring_lines(sheet, forces, letters)),
    )  # fmt: skip


def _group(
    page: FigurePage, forces: ForceSheet, stage: ForceStage, group: ForceGroup, room: float, names: Counter[str]
) -> Iterator[Block]:
    """A group: its caption, its sketch beside its polygon, and what is written below; in parts where a page does not
    hold it."""
    caption = page.prose((text for _, text in stage.title), 3.2, bold=True)
    first, *more = _pictures(page, forces, stage, group, names)
    parts = column(caption, first, gap=CLOSE), *more, _below(page, forces, stage, group)
    whole = column(*parts, gap=CLOSE)
    yield from parts if more or whole.height > room else (whole,)


def group_picture(
    sheet: Sheet, forces: ForceSheet, stage: ForceStage, group: ForceGroup, letters: Letters, spoken: str, width: float,
    tag: str,
) -> Drawing:  # fmt: skip
    """The sketch of a group cut free with its polygons, every part with its step, and nothing written below; ``tag``
    ends the names of its parts."""
    page = FigurePage(sheet, "forces", spoken, letters, width)
    whole = column(*_pictures(page, forces, stage, group, Counter(), tag), gap=CLOSE)
    parts = tied(layer_groups(whole.piece))  # leaders come with their names
    return Drawing(max(width, whole.width), whole.height, parts, figure_title(sheet, "forces", spoken),
                   page.said("force described")[0], languages(spoken)[0])  # fmt: skip


def _pictures(
    page: FigurePage, forces: ForceSheet, stage: ForceStage, group: ForceGroup, names: Counter[str], tag: str = ""
) -> Iterator[Block]:
    """The sketch of a group beside its polygon, or above its polygons."""
    suffix = ("-with" if stage.again else "") + tag
    polygons = [(link, vectors, inside, extent_of((*vectors, *inside)).grown(AROUND))
                for link, vectors, inside in polygons_of(group)]  # fmt: skip
    alone = len(polygons) == 1 and polygons[0][3].width <= page.width - SKETCH - APART
    wide = SKETCH if alone else page.width
    high = max(LEAST, sketch_height(page.sheet, group, wide), polygons[0][3].height if alone else 0.0)
    sketch = framed(panel(wide, high, lambda room: free_body(
        page.sheet, forces, stage, group, page.letters, room.grown(-INSIDE), "-".join(group.links) + suffix)))

    def polygon(
        link: str, vectors: Sequence[ForceVector], inside: Sequence[ForceVector], width: float, height: float
    ) -> Block:
        return framed(panel(width, height, lambda room: drawn_polygon(
            page.sheet, stage, link, vectors, inside, page.letters, room.grown(-INSIDE), names, suffix)))

    if alone:
        yield row(sketch, polygon("", *polygons[0][1:3], page.width - SKETCH - APART, high), gap=APART)
        return
    yield sketch
    singles = []
    for link, vectors, inside, box in polygons:
        drawn = polygon(link, vectors, inside, max(box.width, NARROW), max(box.height, SMALLEST))
        said = (" / ".join(page.said("force on link", link)),) if link else ()
        singles.append(column(prose(said, drawn.width, 2.4), drawn))
    yield from rows(singles, page.width, gap=2.0)


def _below(page: FigurePage, forces: ForceSheet, stage: ForceStage, group: ForceGroup) -> Block:
    """Moments with their reasons, the vector equation with its rows, and what was read off."""
    sheet, letters = page.sheet, page.letters
    said = [line for told in moment_sentences(sheet, group, letters) for line in told.lines]
    if group.way == "drawn system":
        said.append(Phrase("force reason system", (listed(group.links),)))
    elif len(group.equation) > 1 and group.way == "polygon":
        said.append(Phrase(about("force reason polygon", group.links), (listed(group.links),)))
    equation = group_equation(sheet, group, letters, page.language, page.width)
    rows_of = equation and (Piece({"labels": (Group(equation.children, id=""),)}), equation.height)
    couples = [line for told in couple_sentences(sheet, group, letters) for line in told.lines]
    read = read_off(sheet, forces, stage.state, group, letters)
    return column(
        page.prose(said), Block(*rows_of) if rows_of else None,
        page.prose((*couples, *([";  ".join(read.values())] if read else []))), gap=CLOSE,
    )  # fmt: skip


def group_equation(sheet: Sheet, group: ForceGroup, letters: Letters, language: str, width: float) -> Drawing | None:
    """The equation of a group over its rows of sizes and directions; None where it is drawn by one system."""
    if group.way == "drawn system" or len(group.equation) < 2:
        return None
    written = write_sum(sum_terms(sheet, group, letters), letters, language, width)
    title = term("forces", language)
    return Drawing(written.width, written.height, written.children, title, "", languages(language)[0])


def _tables(page: FigurePage, some: Sequence[TableRow]) -> Iterator[Block]:
    """The readings with their check, parted where they do not fit one page."""
    left = list(some)
    while left:
        most = min(len(left), 80)
        height = 10.0 + 4.2 * -(-most // 2) + 3.7 * (len(languages(page.language)) - 1)
        area = Box(0.0, 0.0, page.width, height)
        readings, shown = readings_table(page.sheet, left[:most], page.letters, page.language, area)
        caption = page.prose((page.term("readings"),), 3.2, bold=True)
        yield column(caption, Block(Piece({"answers": readings}), height))
        if shown == 0:
            return
        left = left[shown:]


FIGURES = (Figure("forces", forces_figure, "forces", lambda scene: bool(scene.loading), of_all=True, place=13),)
