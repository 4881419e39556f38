"""The sheet: mechanism, both polygons, equations, given data, readings and title block on one page, true to scale; and
under them the photograph or scan, with the lines that were read off it.  What of its equations, data, insets and
readings finds no room in its own place stands where others have left some, or on further pages.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import islice, product

from graphkin.account.account import written_lines
from graphkin.account.headings import (
    FIGURE_WORDS,
    describe,
    dimensions_in,
    drivers,
    facts,
    figure_title,
    punctuation,
    term,
    titles,
)
from graphkin.account.notation import Letters, letters_of, scale_statement
from graphkin.checking.report import Compared, Report
from graphkin.construction.sheet import Sheet
from graphkin.construction.steps import DiagramName
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import MARGIN
from graphkin.drawing.equations import LEAST_LETTERS, LineToSet, equations_in_room, equations_on_page, line_to_set
from graphkin.drawing.figures import Figure
from graphkin.drawing.figures.loops import loops_figure
from graphkin.drawing.figures.train import train_figure
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Group, Line, Polygon, Primitive, Run, Text, moved, walk
from graphkin.drawing.parts.insets import (
    INSET,
    CoriolisTerm,
    coriolis_row,
    mechanism_with_inset,
    per_row,
    polygon_with_insets,
)
from graphkin.drawing.parts.mechanism import mechanism_piece
from graphkin.drawing.parts.polygon import extent
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.piece import Piece, ink_box, joined, layer_groups
from graphkin.drawing.sheet_plan import BLOCK, GUTTER, SheetPlan, sheet_plan, with_less_mechanism, with_less_polygons
from graphkin.drawing.tables import TableRow, given_data, given_lines, readings_table, set_lines, table_rows
from graphkin.drawing.text import fitted, plain, wrapped
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import Phrase, about, languages, say, word

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
    return mechanism_with_inset(sheet, letters, language, piece, panel.centre - content.centre, room)


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


GAP, LEAST_GAP = 6.0, 2.0  # mm between two parts, and where room is short
CAPTION = 5.5
HEAD = 15.0  # mm for the heading
NARROWEST = 209.0  # mm: the narrower side of A4, about
LEAST_TABLE = 20.0  # mm: a table of fewer rows is none
TABLE_WIDTH = 80.0  # mm: a narrower one has no room for its columns
TWO_LINES = 3.4  # mm: letters of titles that stand below each other, where one line would have them smaller


@dataclass(frozen=True)
class Remainder:
    """What is left to be shown, in the order of its parts.

    readings_begin : whether the readings are the first of all, the others stand further on
    """

    equations: Sequence[LineToSet] = ()
    senses: Sequence[CoriolisTerm] = ()
    given: Sequence[tuple[Run, ...]] = ()
    readings: Sequence[TableRow] = ()
    readings_begin: bool = False

    def __bool__(self) -> bool:
        return bool(self.equations or self.senses or self.given or self.readings)

    @property
    def count(self) -> int:
        return len(self.equations) + len(self.senses) + len(self.given) + len(self.readings)


def continued(
    sheet: Sheet, rest: Remainder, rooms: Sequence[Box], letters: Letters, language: str
) -> Piece | None:
    """The rest in rooms that other writing has left on the first page; None where they do not hold all of it."""
    pieces: list[Piece] = []
    for room in rooms:
        for part in (_equations_left, _senses, _given, _readings):
            piece, rest, room = part(sheet, rest, letters, language, room, True)
            pieces.append(piece)
    return None if rest else joined(pieces)


def overleaf(sheet: Sheet, rest: Remainder, letters: Letters, language: str, page: Box) -> tuple[Drawing, ...]:
    """As many pages as the rest takes, each of the size of a first page whose inside is ``page``, halved down to
    A4 or Letter: what is left are words."""
    short, long = sorted((page.left + page.right, page.top + page.bottom))
    if long / 2 >= NARROWEST:
        while long / 2 >= NARROWEST:
            short, long = long / 2, short
        page = Box(page.left, page.top, short - page.left, long - page.top)
    made: list[Drawing] = []
    while rest:
        number = len(made) + 2
        pieces = [heading(sheet, letters, language, page), _number(sheet, language, number, page)]
        room = Box(page.left, page.top + HEAD, page.right, page.bottom)
        before = rest.count
        for part in (_equations_left, _senses, _given, _readings):
            piece, rest, room = part(sheet, rest, letters, language, room)
            pieces.append(piece)
        made.append(
            Drawing(
                page.left + page.right,
                page.top + page.bottom,
                layer_groups(joined(pieces)),
                f"{figure_title(sheet, 'sheet', language)} ({number})",
                "",
                languages(language)[0],
                facts(sheet, "sheet"),
            )
        )
        if rest.count == before:  # nothing is so large that a page does not hold it
            raise AssertionError("a page holds nothing of what is left")
    return tuple(made)


def heading(sheet: Sheet, letters: Letters, language: str, page: Box) -> Piece:
    """Title and driver values at the head of a page."""
    names = titles(sheet, language)
    runs = fitted("   ".join(names), 4.6, page.width, bold=True, least=2.6)
    lines = [(4.0, runs)]
    if len(names) > 1 and runs[0].size < TWO_LINES:
        lines = [(2.6 + 3.7 * i, fitted(name, TWO_LINES, page.width, bold=True)) for i, name in enumerate(names)]
    lines.append((9.2 + 0.6 * (len(lines) - 1), fitted(drivers(sheet, letters), 3.2, page.width)))
    return Piece({"labels": tuple(Text(complex(page.left, page.top + y), said) for y, said in lines)})


def _number(sheet: Sheet, language: str, number: int, page: Box) -> Piece:
    words = plain(say(Phrase("sheet number", (number,)), languages(language)[0]), 2.6)
    return Piece({"labels": (Text(complex(page.right, page.bottom + 4.0), words, "end"),)})


def captioned(box: Box, caption: str, layer: str, children: tuple[Primitive, ...]) -> Piece:
    """Things in a box under its caption."""
    words = Text(complex(box.left, box.top - 1.6), fitted(caption, 3.2, box.width, bold=True))
    return joined((Piece({"labels": (words,)}), Piece({layer: children})))


_Part = tuple[Piece, Remainder, Box]


def below(room: Box, drawn: tuple[Primitive, ...]) -> Box:
    """What is left of a room below what is drawn in it."""
    ink = ink_box(drawn)
    return Box(room.left, (ink.bottom if ink else room.top) + LEAST_GAP, room.right, room.bottom)


def _after(room: Box, drawn: tuple[Primitive, ...]) -> Box:
    rest = below(room, drawn)
    return Box(rest.left, rest.top + GAP - LEAST_GAP, rest.right, rest.bottom)


def _equations_left(
    sheet: Sheet, rest: Remainder, letters: Letters, language: str, room: Box, begun: bool = False
) -> _Part:
    if not rest.equations:
        return Piece(), rest, room
    box = Box(room.left, room.top + CAPTION, room.right, room.bottom)
    if begun:
        blocks, count = equations_in_room(rest.equations, box.width, box.height, LEAST_LETTERS)
    else:
        blocks, count = equations_on_page(rest.equations, box.width, box.height)
    if not count:
        return Piece(), rest, room
    written = moved(blocks, complex(box.left, box.top))
    caption = term("equations continued" if begun else "equations", language)
    piece = captioned(box, caption, "labels", (Group(written, id="equations-continued" if begun else "equations"),))
    left = replace(rest, equations=rest.equations[count:])
    return piece, left, _after(box, written)


def _senses(sheet: Sheet, rest: Remainder, letters: Letters, language: str, room: Box, begun: bool = False) -> _Part:
    pieces: list[Piece] = []
    senses = rest.senses
    while senses and room.height >= INSET[1]:
        count = per_row(room.width)
        row = Box(room.left, room.top, room.right, room.top + INSET[1])
        pieces.append(coriolis_row(sheet, senses[:count], letters, row))
        senses, room = senses[count:], Box(room.left, row.bottom + GAP, room.right, room.bottom)
    return joined(pieces), replace(rest, senses=senses), room


def _given(sheet: Sheet, rest: Remainder, letters: Letters, language: str, room: Box, begun: bool = False) -> _Part:
    size = max((run.size for line in rest.given for run in line), default=1.0)
    most = max(0, int((room.height - CAPTION) / (1.55 * size)))
    if begun or not rest.given or not most:
        return Piece(), rest, room
    box = Box(room.left, room.top + CAPTION, room.right, room.bottom)
    lines = set_lines(rest.given[:most], complex(box.left, box.top))
    left = replace(rest, given=rest.given[most:])
    return captioned(box, term("given", language), "labels", lines), left, _after(box, lines)


def _readings(
    sheet: Sheet, rest: Remainder, letters: Letters, language: str, room: Box, begun: bool = False
) -> _Part:
    least = 0.0 if begun else LEAST_TABLE
    if not rest.readings or room.height < CAPTION + least or room.width < TABLE_WIDTH:
        return Piece(), rest, room
    box = Box(room.left, room.top + CAPTION, room.right, room.bottom)
    table, count = readings_table(sheet, rest.readings, letters, language, box)
    if not count:
        return Piece(), rest, room
    left = replace(rest, readings=rest.readings[count:], readings_begin=False)
    caption = term("readings continued" if begun and not rest.readings_begin else "readings", language)
    return captioned(box, caption, "answers", table), left, _after(box, table)


LEGIBLE_TITLE = 2.4  # mm
BAR_ROOM, SCALES_ROOM = 56.0, 33.0  # least widths in it, for the check bar and for the scales


def title_block(sheet: Sheet, shown: Sequence[Compared], letters: Letters, language: str, box: Box) -> Piece:
    """The block of a sheet: title, instrument, scales, and whether the ``shown`` readings agree."""
    lines: list[Primitive] = [Polygon(box.corners, "", strokes.OUTLINE)]
    two = min(box.left + 0.66 * box.width, box.right - BAR_ROOM)
    names = titles(sheet, language)
    left = box.left + 2.0
    for share in (0.36, 0.48):  # more for a long title
        one = min(box.left + share * box.width, two - SCALES_ROOM)
        title = _title_lines(names, one - left - 1.5)
        if title[0][0].size >= LEGIBLE_TITLE:
            break
    lines += [Line(complex(x, box.top), complex(x, box.bottom), strokes.DIMENSION) for x in (one, two)]
    words: list[Primitive] = []
    y = box.top + 1.4
    for runs in title:
        y += 1.25 * runs[0].size
        words.append(Text(complex(left, y), runs))
    comma, colon = (punctuation(key, language) for key in ("list comma", "colon"))
    tools = term("instrument", language) + colon + term(f"instrument {sheet.instrument}", language)
    second = sheet.scene.name + comma + tools
    words.append(Text(complex(left, box.bottom - 2.0), fitted(second, 2.6, one - left - 1.5)))
    for i, diagram in enumerate(("mechanism", "velocity", "acceleration")):
        text = scale_statement(sheet, letters.convention, diagram)  # type: ignore[arg-type]
        words.append(Text(complex(one + 2.0, box.top + 4.6 + 4.4 * i), fitted(text, 3.0, two - one - 4.0)))
    words += check_bar(complex(box.right - 53.0, box.bottom - 2.2), fitted(term("check bar", language), 2.4, 50.0))
    answers: tuple[Primitive, ...] = ()
    if shown:
        judged = [row.ok for row in shown if row.ok is not None]
        wrong, whole = judged.count(False), len(judged)
        phrase = Phrase("not all agree", (wrong, whole)) if wrong else Phrase(about("all agree", judged), (whole,))
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


FIGURES = (Figure("sheet", sheet_page, "small sheet", lambda scene: True, place=4),)
