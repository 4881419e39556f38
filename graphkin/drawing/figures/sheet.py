"""The sheet: mechanism, both polygons, equations, given data, readings and title block on one page, true to scale; and
under them the photograph or scan, with the lines that were read off it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from itertools import islice, product

from graphkin.account.headings import (
    FIGURE_WORDS,
    describe,
    dimensions_in,
    facts,
    figure_title,
    punctuation,
    term,
)
from graphkin.account.notation import Letters, letters_of, scale_statement
from graphkin.account.written_lines import written_lines
from graphkin.checking.report import Report
from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import MARGIN
from graphkin.drawing.equations import LineToSet, equations_in_room, line_to_set
from graphkin.drawing.figures import Figure
from graphkin.drawing.figures.loops import loops_figure
from graphkin.drawing.figures.train import train_figure
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Group, Polygon, Primitive, Run, Text, moved, walk
from graphkin.drawing.overleaf import Remainder, below, captioned, continued, heading, overleaf
from graphkin.drawing.parts.coriolis import INSET, CoriolisTerm, coriolis_row, per_row
from graphkin.drawing.parts.insets import mechanism_detail, polygon_with_insets
from graphkin.drawing.parts.mechanism import mechanism_piece
from graphkin.drawing.parts.polygon_on_page import extent
from graphkin.drawing.parts.scans import background_piece
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined, layer_groups, moved_piece
from graphkin.drawing.sheet_plan import GUTTER, SheetPlan, sheet_plan, with_less_mechanism, with_less_polygons
from graphkin.drawing.tables import TableRow, given_data, given_lines, readings_table, table_rows
from graphkin.drawing.text import fitted, plain
from graphkin.drawing.title_block import title_block
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import languages, word

__all__ = ["FIGURES", "sheet_page"]

GIVEN = (2.8, 2.5)  # mm, letters of the given data: usual, and where room is short
NAMES = 7.0  # mm above and below a polygon that gives room to the equations
POLYGONS: tuple[DiagramName, DiagramName] = ("velocity", "acceleration")
EQUATIONS_ROOM = 20.0  # least height of the equations above insets of Coriolis terms


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
    polygons = _Polygons(sheet, letters, spoken)
    velocity, acceleration, homeless = polygons.on(plan)
    lines = [line_to_set(line, sheet, letters, spoken) for line in written_lines(sheet, letters, spoken)]
    rows = table_rows(sheet, report)
    words = _Writing(sheet, rows, letters, spoken, lines, homeless)
    writing, rest = words.on(plan, GIVEN[0])
    if rest and plan.equations:
        usual = (plan, *with_less_mechanism(plan, sheet))
        closer = (*usual, *(less for each in usual for less in with_less_polygons(each, polygons.heights(plan))))
        for each, size in islice(product(closer, GIVEN), 1, None):
            there, left = words.on(each, size)
            if left:
                continue
            drawn = polygons.on(each) if each.beside else (velocity, acceleration, homeless)
            if drawn[2] == homeless and _insets(drawn) == _insets((velocity, acceleration)):
                plan, writing, rest = each, there, left
                velocity, acceleration, _ = drawn
                break
    drawn_diagrams: list[DiagramName] = ["mechanism", "velocity"]
    pieces = []
    if acceleration is not None:
        drawn_diagrams.append("acceleration")
        pieces += [_panel(plan.acceleration, _caption(sheet, letters, spoken, "acceleration")), acceleration]
    pieces += [
        heading(sheet, letters, spoken, plan.page),
        _panel(plan.mechanism, _caption(sheet, letters, spoken, "mechanism")),
        _panel(plan.velocity, _caption(sheet, letters, spoken, "velocity")),
        _mechanism(sheet, letters, spoken, plan.mechanism),
        velocity,
        *writing,
        _step_number(spoken, plan.page),
        title_block(sheet, [row.compared for row in rows if row.compared], letters, spoken, plan.block),
    ]
    further = overleaf(sheet, rest, letters, spoken, plan.page)
    figures = [train_figure(sheet, language=spoken, convention=letters.convention)]
    if scene.sheet.loops:
        figures.append(loops_figure(sheet, language=spoken, convention=letters.convention))
    for one in (page for figure in figures if figure is not None for page in (figure, *figure.further)):
        further += (_as_page(sheet, one, plan, len(further) + 2),)
    if further:
        pieces.append(_goes_on(spoken, plan.page))
    return Drawing(
        plan.width,
        plan.height,
        layer_groups(joined(pieces)),
        figure_title(sheet, "sheet", spoken),
        describe(sheet, tuple(drawn_diagrams), spoken),
        languages(spoken)[0],
        facts(sheet, "sheet"),
        further,
    )


class _Writing:
    """Equations, given data and readings, with the insets of Coriolis terms that found no room in their panel; each is
    set once for each of its rooms, however many plans are tried."""

    def __init__(
        self, sheet: Sheet, rows: list[TableRow], letters: Letters, language: str, lines: Sequence[LineToSet],
        senses: list[CoriolisTerm],
    ) -> None:  # fmt: skip
        self.sheet, self.rows, self.letters, self.language = sheet, rows, letters, language
        self.lines, self.senses = lines, senses
        self._given = cache(self._set_given)
        self._equations = cache(self._set_equations)
        self._readings = cache(self._set_readings)

    def on(self, plan: SheetPlan, size: float) -> tuple[list[Piece], Remainder]:
        """All of it on a plan, given data in letters of at most a size; and what is left for further pages."""
        sheet, letters, language = self.sheet, self.letters, self.language
        if plan.equations is None or plan.given is None or plan.readings is None:
            given = given_lines(sheet, letters, language, plan.page.width, GIVEN[0])
            return [], Remainder(self.lines, self.senses, given, self.rows)
        data, given_rest, shown = self._given(plan.given, size)
        equations, lines_left, senses = self._equations(plan.equations, shown)
        readings, count = self._readings(plan.readings)
        rest = Remainder(lines_left, senses, given_rest, self.rows[count:])
        places = (plan.given, data), (plan.equations, equations), (plan.readings, readings)
        rooms = [below(box, piece.drawn) for box, piece in places]
        if plan.beside is not None:  # what is written there goes on from the equations
            rooms.insert(0, plan.beside)
        more = continued(sheet, rest, rooms, letters, language)
        if more is None:
            return [data, equations, readings], rest
        # rooms that are left lie before that of the readings: they take the first of them
        before = len(rest.readings)
        if before:
            first = replace(rest, readings=self.rows[:before], readings_begin=True)
            turned = continued(sheet, first, rooms[:-1], letters, language)
            last, count = self._set_last(plan.readings, before)
            if turned is not None and count == len(self.rows) - before:
                readings, more = last, turned
        return [data, equations, readings, more], Remainder()

    def _set_given(self, box: Box, size: float) -> tuple[Piece, Sequence[tuple[Run, ...]], int]:
        """The given data, what is left of it, and how many of the insets stand below it."""
        given, rest = given_data(self.sheet, self.letters, self.language, box, size)
        data = captioned(box, term("given", self.language), "labels", given)
        spare = _spare(box, given)
        if spare is None or rest:
            return data, rest, 0
        first = self.senses[:1]
        return joined((data, coriolis_row(self.sheet, first, self.letters, spare))), rest, len(first)

    def _set_equations(self, box: Box, shown: int) -> tuple[Piece, Sequence[LineToSet], list[CoriolisTerm]]:
        return _equations(self.sheet, self.letters, self.language, box, self.lines, self.senses[shown:])

    def _set_readings(self, box: Box) -> tuple[Piece, int]:
        table, count = readings_table(self.sheet, self.rows, self.letters, self.language, box)
        return captioned(box, term("readings", self.language), "answers", table), count

    def _set_last(self, box: Box, before: int) -> tuple[Piece, int]:
        """The readings but for some that stand before them."""
        table, count = readings_table(self.sheet, self.rows[before:], self.letters, self.language, box)
        return captioned(box, term("readings continued", self.language), "answers", table), count


def _as_page(sheet: Sheet, figure: Drawing, plan: SheetPlan, number: int) -> Drawing:
    """A figure on a page of the sheet's size, or a longer one where it takes that."""
    to = complex(plan.page.left - MARGIN, plan.page.top - MARGIN)
    height = max(plan.height, figure.height + to.imag)
    return replace(figure, width=plan.width, height=height, children=moved(figure.children, to),
                   title=f"{figure.title} ({number})", metadata=facts(sheet, "sheet"), further=())  # fmt: skip


def _goes_on(language: str, page: Box) -> Piece:
    words = plain(word("goes on", languages(language)[0]), 2.6)
    return Piece({"labels": (Text(complex(page.right, page.bottom + 4.0), words, "end"),)})


def _step_number(spoken: str, page: Box) -> Piece:
    """What the numbers in brackets at the vectors are."""
    words = fitted(term("step number", spoken), 2.4, 0.7 * page.width)
    return Piece({"labels": (Text(complex(page.left, page.bottom + 4.0), words),)})


def _spare(box: Box, written: tuple[Primitive, ...]) -> Box | None:
    """Room for an inset at the foot of a box in which something is written; None where there is none."""
    ink = ink_box(written)
    top = box.bottom - INSET[1]
    return Box(box.left, top, box.right, box.bottom) if ink is None or ink.bottom + GUTTER < top else None


def _caption(sheet: Sheet, letters: Letters, language: str, diagram: DiagramName) -> str:
    unit = dimensions_in(sheet, language) if diagram == "mechanism" else ""
    parts = term(FIGURE_WORDS[diagram], language), scale_statement(sheet, letters.convention, diagram), unit
    return punctuation("list comma", language).join(filter(None, parts))


def _panel(box: Box, caption: str) -> Piece:
    frame = Polygon(box.corners, "", strokes.DIMENSION)
    words = Text(complex(box.left, box.top - 1.6), fitted(caption, 3.2, box.width))
    return Piece({"construction": (Group((frame,), classes=("panel",)),), "labels": (words,)})


def _mechanism(sheet: Sheet, letters: Letters, language: str, panel: Box) -> Piece:
    room = panel.grown(-0.8)
    piece, content = mechanism_piece(sheet, letters, (room.width, room.height))
    origin = panel.centre - content.centre
    named = with_labels(moved_piece(piece, origin), room)
    under = background_piece(sheet, origin, room)
    return joined((under, named, mechanism_detail(sheet, letters, language, room, named.drawn)))


class _Polygons:
    """Both polygons of a sheet, as they stand on its plans."""

    def __init__(self, sheet: Sheet, letters: Letters, language: str) -> None:
        self.sheet, self.letters, self.language = sheet, letters, language

    def on(self, plan: SheetPlan) -> tuple[Piece, Piece | None, list[CoriolisTerm]]:
        """The polygons on a plan, that of accelerations where there is one, and the Coriolis terms for whose insets
        there was no room."""
        velocity, _ = self._in("velocity", plan.velocity)
        if not self.sheet.vectors("acceleration"):
            return velocity, None, []
        return velocity, *self._in("acceleration", plan.acceleration)

    def _in(self, diagram: DiagramName, panel: Box) -> tuple[Piece, list[CoriolisTerm]]:
        content = extent(self.sheet, diagram, panel.grown(-3.0))
        origin = panel.centre - content.centre
        return polygon_with_insets(self.sheet, diagram, self.letters, self.language, panel.grown(-0.8), origin)

    def heights(self, plan: SheetPlan) -> tuple[float, float]:
        """How high (mm) the polygons are on a plan with their names."""
        panels = plan.velocity, plan.acceleration
        one, other = (
            extent(self.sheet, d, box.grown(-3.0)).height + 2 * NAMES for d, box in zip(POLYGONS, panels, strict=True)
        )
        return one, other


def _insets(pieces: Sequence[object]) -> list[str]:
    """The insets that stand in polygons."""
    drawn = (piece.drawn for piece in pieces if isinstance(piece, Piece))
    return [one.id for each in drawn for one in walk(each) if isinstance(one, Group) and "inset" in one.classes]


def _equations(
    sheet: Sheet, letters: Letters, language: str, box: Box, lines: Sequence[LineToSet], senses: list[CoriolisTerm]
) -> tuple[Piece, Sequence[LineToSet], list[CoriolisTerm]]:
    """The equations, and below them the insets of Coriolis terms that found no room in their panel; and what of both
    is left for another page."""
    count = 0
    insets = INSET[1] + GUTTER if senses else 0.0
    if senses and box.height >= insets + EQUATIONS_ROOM:
        blocks, count = equations_in_room(lines, box.width, box.height - insets)
    shown = senses[: per_row(box.width)] if count == len(lines) else []  # the equations come first
    if not shown:
        blocks, count = equations_in_room(lines, box.width, box.height)
    written = Group(moved(blocks, complex(box.left, box.top)), id="equations")
    parts = [captioned(box, term("equations", language), "labels", (written,))]
    if shown:
        row = Box(box.left, box.bottom - INSET[1], box.right, box.bottom)
        parts.append(coriolis_row(sheet, shown, letters, row))
    return joined(parts), lines[count:], senses[len(shown) :]


FIGURES = (Figure("sheet", sheet_page, "small sheet", lambda scene: True, place=4),)
