"""Where everything stands on a sheet: panels of the mechanism and of the polygons, equations, data, readings.

The sheet: mechanism, both polygons, equations, given data, readings and title block on one page, true to scale.
"""

from __future__ import annotations

from dataclasses import dataclass

from graphkin.checking.report import Report
from graphkin.construction import Room
from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters, letters_of, scale_statement
from graphkin.drawing.coriolis import CoriolisTerm
from graphkin.drawing.dimensions import check_bar
from graphkin.drawing.drawing import Drawing
from graphkin.drawing.equations import WrittenLine, equations_in_room, written_lines
from graphkin.drawing.headings import FIGURE_WORDS, describe, facts, figure_title, term, titles
from graphkin.drawing.insets import INSET, coriolis_row, per_row, polygon_with_insets
from graphkin.drawing.mechanism import mechanism_piece
from graphkin.drawing.overleaf import Remainder, captioned, heading, overleaf
from graphkin.drawing.piece import Piece, ink_box, joined, layer_groups, moved, moved_piece, with_labels
from graphkin.drawing.polygon_on_page import extent
from graphkin.drawing.primitives import Group, Line, Polygon, Primitive, Run, Text
from graphkin.drawing.tables import given_data, readings_table, table_rows
from graphkin.drawing.text import fitted, plain, wrapped
from graphkin.scene.model import Mechanism
from graphkin.words import Phrase, languages, say, word

__all__ = ["BLOCK", "GUTTER", "MARGIN", "SheetPlan", "sheet_page", "sheet_plan", "sheet_room"]

MARGIN, GUTTER, CAPTION = 10.0, 2.0, 5.5
HEAD, BLOCK = 11.0, 16.0  # heading above, title block below
FILL = 0.87  # of a panel, by the polygon with the finest scale
BAR_ROOM, SCALES_ROOM = 56.0, 33.0  # least widths in the title block, for the check bar and for the scales
EQUATIONS_ROOM = 20.0  # least height of the equations above insets of Coriolis terms
AROUND_MECHANISM = (13.0, 15.0)  # mm for symbols and names
# Height of the mechanism's panel by that of a polygon's: the usual one, and such as tall mechanisms may have.
HEIGHTS = (1.08, 1.33, 1.43)


@dataclass(frozen=True)
class SheetPlan:
    """Where everything stands on the page (mm); panels without their captions."""

    width: float
    height: float
    mechanism: Box
    velocity: Box
    acceleration: Box
    equations: Box
    given: Box
    readings: Box
    block: Box


def sheet_room(scene: Mechanism) -> Room:
    """The room in which a sheet for ``sheet_page`` is to be drafted: ``draft(scene, room=sheet_room(scene))``."""
    plans = _plans(scene)
    first, *others = (_mechanism_room(plan) for plan in plans)
    panel = plans[0].velocity
    return Room(first, (panel.width * FILL, panel.height * FILL), tuple(others))


def _mechanism_room(plan: SheetPlan) -> tuple[float, float]:
    return plan.mechanism.width - AROUND_MECHANISM[0], plan.mechanism.height - AROUND_MECHANISM[1]


def _plans(scene: Mechanism) -> tuple[SheetPlan, ...]:
    """The usual plan of a page, and those for taller mechanisms."""
    if scene.sheet.orientation == "landscape":
        return (_landscape(*scene.sheet.size),)
    return tuple(_portrait(*scene.sheet.size, tall) for tall in HEIGHTS)


def sheet_plan(sheet: Sheet) -> SheetPlan:
    """The first plan whose room holds the mechanism as it is drawn."""
    plans = _plans(sheet.scene)
    size = Box.around(sheet.points.values()) if sheet.points else Box(0.0, 0.0, 0.0, 0.0)
    for plan in plans:
        room = _mechanism_room(plan)
        if size.width <= room[0] + 1e-6 and size.height <= room[1] + 1e-6:
            return plan
    return plans[0]


def _portrait(width: float, height: float, tall: float) -> SheetPlan:
    page = Box(MARGIN, MARGIN, width - MARGIN, height - MARGIN)
    top = page.top + HEAD + CAPTION
    split = page.left + 0.483 * page.width
    polygon = 0.315 * page.height  # height of a polygon's panel
    right = split + GUTTER
    velocity = Box(right, top, page.right, top + polygon)
    acceleration = velocity.moved(complex(0, polygon + CAPTION + GUTTER))
    mechanism = Box(page.left, top, split, top + tall * polygon)
    equations = Box(page.left, mechanism.bottom + GUTTER + CAPTION, split, acceleration.bottom)
    block = Box(page.left, page.bottom - BLOCK, page.right, page.bottom)
    low = acceleration.bottom + GUTTER + CAPTION
    third = page.left + 0.27 * page.width
    given = Box(page.left, low, third, block.top - GUTTER)
    readings = Box(third + 2 * GUTTER, low, page.right, block.top - GUTTER)
    return SheetPlan(width, height, mechanism, velocity, acceleration, equations, given, readings, block)


def _landscape(width: float, height: float) -> SheetPlan:
    page = Box(MARGIN, MARGIN, width - MARGIN, height - MARGIN)
    top = page.top + HEAD + CAPTION
    panel = (page.width - 2 * GUTTER) / 3
    bottom = top + panel * 0.98
    boxes = [
        Box(page.left + i * (panel + GUTTER), top, page.left + i * (panel + GUTTER) + panel, bottom) for i in range(3)
    ]
    block = Box(page.left, page.bottom - BLOCK, page.right, page.bottom)
    low = bottom + GUTTER + CAPTION
    one, two = page.left + 0.17 * page.width, page.left + 0.53 * page.width
    given = Box(page.left, low, one, block.top - GUTTER)
    equations = Box(one + GUTTER, low, two, block.top - GUTTER)
    readings = Box(two + GUTTER, low, page.right, block.top - GUTTER)
    return SheetPlan(width, height, boxes[0], boxes[1], boxes[2], equations, given, readings, block)


def sheet_page(
    sheet: Sheet, report: Report | None = None, *, language: str | None = None, convention: str | None = None
) -> Drawing:
    """One page with everything; what it has no room for stands on its ``further`` pages.

    Parameters
    ----------
    sheet : drafted in ``sheet_room(scene)``, so that its polygons fill their panels
    report : its readings held against the exact values; without it the table shows the readings alone
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    """
    scene = sheet.scene
    spoken = language or scene.sheet.language
    letters = letters_of(sheet, convention or scene.sheet.convention)  # type: ignore[arg-type]
    plan = sheet_plan(sheet)
    velocity, _ = _polygon(sheet, "velocity", letters, spoken, plan.velocity)
    drawn: list[DiagramName] = ["mechanism", "velocity"]
    homeless: list[CoriolisTerm] = []
    pieces = []
    if sheet.vectors("acceleration"):
        drawn.append("acceleration")
        acceleration, homeless = _polygon(sheet, "acceleration", letters, spoken, plan.acceleration)
        pieces += [_panel(plan.acceleration, _caption(sheet, letters, spoken, "acceleration")), acceleration]
    given, given_rest = given_data(sheet, letters, spoken, plan.given)
    spare = _spare(plan.given, given)
    if spare is not None and not given_rest:
        pieces.append(coriolis_row(sheet, homeless[:1], letters, spare))
        homeless = homeless[1:]
    equations, lines, homeless = _equations(sheet, letters, spoken, plan.equations, homeless)
    rows = table_rows(sheet, report)
    readings, count = readings_table(sheet, rows, letters, spoken, plan.readings)
    page = Box(MARGIN, MARGIN, plan.width - MARGIN, plan.height - MARGIN)
    pieces += [
        heading(sheet, letters, spoken, page),
        _panel(plan.mechanism, _caption(sheet, letters, spoken, "mechanism")),
        _panel(plan.velocity, _caption(sheet, letters, spoken, "velocity")),
        _mechanism(sheet, letters, plan.mechanism),
        velocity,
        equations,
        captioned(plan.given, term("given", spoken), "labels", given),
        captioned(plan.readings, term("readings", spoken), "answers", readings),
        _title_block(sheet, report, letters, spoken, plan.block),
    ]
    rest = Remainder(lines, homeless, given_rest, rows[count:])
    further = overleaf(sheet, rest, letters, spoken, page)
    if further:
        pieces.append(_goes_on(spoken, page))
    return Drawing(
        plan.width,
        plan.height,
        layer_groups(joined(pieces)),
        figure_title(sheet, "sheet", spoken),
        describe(sheet, tuple(drawn), spoken),
        languages(spoken)[0],
        facts(sheet, "sheet"),
        further,
    )


def _goes_on(language: str, page: Box) -> Piece:
    words = plain(word("goes on", languages(language)[0]), 2.6)
    return Piece({"labels": (Text(complex(page.right, page.bottom + 4.0), words, "end"),)})


def _spare(box: Box, written: tuple[Primitive, ...]) -> Box | None:
    """Room for an inset at the foot of a box in which something is written; None where there is none."""
    ink = ink_box(written)
    top = box.bottom - INSET[1]
    return Box(box.left, top, box.right, box.bottom) if ink is None or ink.bottom + GUTTER < top else None


def _caption(sheet: Sheet, letters: Letters, language: str, diagram: DiagramName) -> str:
    return f"{term(FIGURE_WORDS[diagram], language)},  {scale_statement(sheet, letters.convention, diagram)}"


def _panel(box: Box, caption: str) -> Piece:
    frame = Polygon(box.corners, "", strokes.DIMENSION)
    words = Text(complex(box.left, box.top - 1.6), fitted(caption, 3.2, box.width))
    return Piece({"construction": (Group((frame,), classes=("panel",)),), "labels": (words,)})


def _mechanism(sheet: Sheet, letters: Letters, panel: Box) -> Piece:
    room = panel.grown(-0.8)
    piece, content = mechanism_piece(sheet, letters, (room.width, room.height))
    return with_labels(moved_piece(piece, panel.centre - content.centre), room)


def _polygon(
    sheet: Sheet, diagram: DiagramName, letters: Letters, language: str, panel: Box
) -> tuple[Piece, list[CoriolisTerm]]:
    content = extent(sheet, diagram, panel.grown(-3.0))
    origin = panel.centre - content.centre
    return polygon_with_insets(sheet, diagram, letters, language, panel.grown(-0.8), origin)


def _equations(
    sheet: Sheet, letters: Letters, language: str, box: Box, senses: list[CoriolisTerm]
) -> tuple[Piece, list[WrittenLine], list[CoriolisTerm]]:
    """The equations, and below them the insets of Coriolis terms that found no room in their panel; and what of both
    is left for another page."""
    lines = written_lines(sheet, letters, language)
    count = 0
    insets = INSET[1] + GUTTER if senses else 0.0
    if senses and box.height >= insets + EQUATIONS_ROOM:
        blocks, count = equations_in_room(lines, sheet, letters, language, box.width, box.height - insets)
    shown = senses[: per_row(box.width)] if count == len(lines) else []  # the equations come first
    if not shown:
        blocks, count = equations_in_room(lines, sheet, letters, language, box.width, box.height)
    written = Group(moved(blocks, complex(box.left, box.top)), id="equations")
    parts = [captioned(box, term("equations", language), "labels", (written,))]
    if shown:
        row = Box(box.left, box.bottom - INSET[1], box.right, box.bottom)
        parts.append(coriolis_row(sheet, shown, letters, row))
    return joined(parts), lines[count:], senses[len(shown) :]


def _title_block(sheet: Sheet, report: Report | None, letters: Letters, language: str, box: Box) -> Piece:
    lines: list[Primitive] = [Polygon(box.corners, "", strokes.OUTLINE)]
    two = min(box.left + 0.66 * box.width, box.right - BAR_ROOM)
    one = min(box.left + 0.36 * box.width, two - SCALES_ROOM)
    lines += [Line(complex(x, box.top), complex(x, box.bottom), strokes.DIMENSION) for x in (one, two)]
    words: list[Primitive] = []
    names = titles(sheet, language)
    left = box.left + 2.0
    y = box.top + 1.4
    for runs in _title_lines(names, one - left - 1.5):
        y += 1.25 * runs[0].size
        words.append(Text(complex(left, y), runs))
    second = f"{sheet.scene.name},  {term('instrument', language)}: {sheet.instrument}"
    words.append(Text(complex(left, box.bottom - 2.0), fitted(second, 2.6, one - left - 1.5)))
    for i, diagram in enumerate(("mechanism", "velocity", "acceleration")):
        text = scale_statement(sheet, letters.convention, diagram)  # type: ignore[arg-type]
        words.append(Text(complex(one + 2.0, box.top + 4.6 + 4.4 * i), fitted(text, 3.0, two - one - 4.0)))
    words += check_bar(complex(box.right - 53.0, box.bottom - 2.2), fitted(term("check bar", language), 2.4, 50.0))
    answers: tuple[Primitive, ...] = ()
    if report is not None:
        wrong = sum(not row.ok for row in report.rows)
        whole = len(report.rows)
        phrase = Phrase("not all agree", (wrong, whole)) if wrong else Phrase("all agree", (whole,))
        answers = tuple(
            Text(complex(two + 2.0, box.top + 4.2 + 3.6 * i), fitted(say(phrase, each), 2.6, box.right - two - 4.0))
            for i, each in enumerate(languages(language))
        )
    return Piece(
        {"construction": (Group(tuple(lines), classes=("title-block",)),), "labels": tuple(words), "answers": answers}
    )


def _title_lines(names: tuple[str, ...], width: float) -> list[tuple[Run, ...]]:
    """Titles in lines, as large as they fit the block."""
    lines: list[tuple[Run, ...]] = []
    for size in (3.2, 2.8, 2.4, 2.0):
        lines = [line for name in names for line in wrapped(name, size, width, bold=True)]
        if 1.25 * size * len(lines) <= BLOCK - 7.0:
            break
    return lines[:3]
