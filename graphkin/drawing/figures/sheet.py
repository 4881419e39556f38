"""The sheet: mechanism, both polygons, equations, given data, readings and title block on one page, true to scale; and
under them the photograph or scan, with the lines read from it.  Equations, data, insets and readings without room in
their own place go to the room that others leave, or to further pages.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import islice, product
from typing import Literal, TypeAlias

from graphkin.account.account import written_lines
from graphkin.account.given import drivers
from graphkin.account.headings import (
    FIGURE_WORDS,
    describe,
    dimensions_in,
    facts,
    figure_title,
    term,
    titles,
)
from graphkin.checking.report import Compared, Report
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import DiagramName
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import MARGIN, FigurePage
from graphkin.drawing.equations import LEAST_LETTERS, LineToSet, equations_in_room, equations_on_page, line_to_set
from graphkin.drawing.figures import Figure, figure_kinds
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Group, Line, Polygon, Primitive, Run, Text, moved, walk
from graphkin.drawing.parts.insets import (
    INSET,
    CoriolisTerm,
    coriolis_rows,
    mechanism_with_inset,
    polygon_with_insets,
)
from graphkin.drawing.parts.mechanism import mechanism_piece
from graphkin.drawing.parts.polygon import extent
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.piece import Piece, ink_box, joined, layer_groups
from graphkin.drawing.sheet_plan import BLOCK, GUTTER, SheetPlan, sheet_plan, with_less_mechanism, with_less_polygons
from graphkin.drawing.tables import TableRow, given_data, given_lines, readings_table, set_lines, table_rows
from graphkin.drawing.text import cut_off, fitted, plain, runs_width, wrapped
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import Phrase, about, languages, say
from graphkin.words.symbols import spaced

GIVEN = (2.8, 2.5)  # mm, letters of the given data: usual, and where room is short
NAMES = 7.0  # mm above and below a polygon that gives room to the equations
POLYGONS: tuple[DiagramName, DiagramName] = ("velocity", "acceleration")
EQUATIONS_ROOM = 20.0  # least height of the equations above insets of Coriolis terms
GAP, LEAST_GAP = 6.0, 2.0  # mm between two parts, and where room is short
CAPTION = 5.5
HEAD = 15.0  # mm for the heading
NARROWEST = 209.0  # mm: the narrower side of A4, about
LEAST_TABLE = 20.0  # mm: a table of fewer rows is none
TABLE_WIDTH = 80.0  # mm: a narrower one has no room for its columns
TWO_LINES = 3.4  # mm: letters of titles that stand below each other, where one line would have them smaller


def sheet_page(page: FigurePage, report: Report) -> Drawing:
    """The page of the sheet; parts without room are on its ``further`` pages.

    Parameters
    ----------
    page : its sheet drafted in ``sheet_room(scene)``, so that its polygons fill their panels
    report : its readings compared with the exact values
    """
    sheet = page.sheet
    plan = sheet_plan(sheet)
    velocity, acceleration, homeless = _polygons(page, plan)
    written = written_lines(sheet, page.letters, page.language)
    lines = [line_to_set(line, sheet, page.letters, page.language) for line in written]
    rows = table_rows(report)
    written_on = _writing(page, rows, lines, homeless)
    writing, rest = written_on(plan, GIVEN[0])
    if rest and plan.equations:
        usual, panels = (plan, *with_less_mechanism(plan, sheet)), zip(
            POLYGONS, (plan.velocity, plan.acceleration), strict=True)
        high = [extent(sheet, diagram, box.grown(-3.0)).height + 2 * NAMES for diagram, box in panels]
        closer = (*usual, *(less for each in usual for less in with_less_polygons(each, high)))
        for each, size in islice(product(closer, GIVEN), 1, None):
            there, left = written_on(each, size)
            if left:
                continue
            drawn = _polygons(page, each) if each.beside else (velocity, acceleration, homeless)
            if drawn[2] == homeless and _insets(drawn) == _insets((velocity, acceleration)):
                plan, writing, rest = each, there, left
                velocity, acceleration, _ = drawn
                break
    shown: tuple[DiagramName, ...] = ("mechanism", "velocity")
    pieces = []
    if acceleration is not None:
        shown = (*shown, "acceleration")
        pieces += [_panel(page, "acceleration", plan.acceleration), acceleration]
    pieces += [
        heading(page, plan.page), _panel(page, "mechanism", plan.mechanism), _panel(page, "velocity", plan.velocity),
        _mechanism(page, plan.mechanism), velocity, *writing,
        _below(plan.page, fitted(term("step number", page.language, number="(9)"), 2.4, 0.7 * plan.page.width)),
        title_block(page, [row.compared for row in rows], plan.block),
    ]
    further = continuation(page, rest, plan.page)
    for kind in ("plan", "loops") if sheet.scene.question.sheet.loops else ("plan",):
        figure = figure_kinds()[kind].draw(replace(page, name=kind))
        for drawn_page in (figure, *figure.further) if figure is not None else ():
            further += (_as_page(sheet, drawn_page, plan, len(further) + 2),)
    if further:
        pieces.append(_below(plan.page, plain(page.term("goes on"), 2.6), "end"))
    made = _drawn_page(page, plan.width, plan.height, pieces, "")
    return replace(made, desc=describe(sheet, shown, page.language), further=further)


def _drawn_page(page: FigurePage, width: float, height: float, pieces: Sequence[Piece], number: str) -> Drawing:
    """A page of the sheet; ``number`` follows its title."""
    title = figure_title(page.sheet, "sheet", page.language) + number
    return Drawing(width, height, layer_groups(joined(pieces)), title, "", languages(page.language)[0],
                   facts(page.sheet, "sheet"))


def _writing(
    page: FigurePage, rows: Sequence[TableRow], lines: Sequence[LineToSet], coriolis: Sequence[CoriolisTerm]
) -> Callable[[SheetPlan, float], tuple[list[Piece], Remainder]]:
    """The equations, given data and readings, with the insets of Coriolis terms without room in their panel, as a
    function of a plan and of the largest letters of the given data (mm): the writing on the plan, and the rest for
    further pages.  Each part is set once for each of its rooms, for all plans tried."""
    all_of = cache(lambda size: Remainder(lines, coriolis, (), rows, size))

    @cache
    def part_in(part: Part, rest: Remainder, room: Box) -> tuple[Piece, Remainder, Box]:
        """A part in its own room, with the rest, and the room below it."""
        piece, left = part(page, rest, room, "own")
        return piece, left, below(room, piece.drawn, LEAST_GAP)

    def on(plan: SheetPlan, size: float) -> tuple[list[Piece], Remainder]:
        whole = all_of(size)
        if not (plan.given and plan.equations and plan.readings):
            given = given_lines(page.sheet, page.letters, page.language, plan.page.width, GIVEN[0])
            return [], replace(whole, given=given)
        data, rest, under_data = part_in(_own_given, whole, plan.given)
        written, rest, under_written = part_in(_own_equations, rest, plan.equations)
        # the same table whatever stands before it
        table, left, under_table = part_in(_readings, all_of(GIVEN[0]), plan.readings)
        rest, pieces = replace(rest, readings=left.readings, begun=True), [data, written, table]
        rooms = [under_data, under_written, under_table]
        if plan.beside is not None:  # the equations go on there; readings begin below equations that are whole
            rooms.insert(0 if rest.equations else 2, plan.beside)
        more = continued(page, rest, rooms)
        if more is None:
            return pieces, rest
        # rooms that are left lie before that of the readings: they take the first of them
        if before := len(rest.readings):
            first = replace(rest, readings=whole.readings[:before], begun=False)
            turned = continued(page, first, rooms[:-1])
            others = replace(whole, readings=whole.readings[before:], begun=True)
            last, left, _ = part_in(_readings, others, plan.readings)
            if turned is not None and not left.readings:
                pieces[-1], more = last, turned
        return [*pieces, more], Remainder()

    return on


def _as_page(sheet: Sheet, figure: Drawing, plan: SheetPlan, number: int) -> Drawing:
    """A figure on a page of the sheet's size, or on a longer one if necessary."""
    to = complex(plan.page.left - MARGIN, plan.page.top - MARGIN)
    height = max(plan.height, figure.height + to.imag)
    return replace(figure, width=plan.width, height=height, children=moved(figure.children, to),
                   title=f"{figure.title} ({number})", metadata=facts(sheet, "sheet"), further=())


def _below(frame: Box, words: tuple[Run, ...], anchor: str = "start") -> Piece:
    """A note below the left lower corner of a page, or its right one."""
    corner = complex(frame.right if anchor == "end" else frame.left, frame.bottom + 4.0)
    return Piece({"labels": (Text(corner, words, anchor),)})


def _panel(page: FigurePage, diagram: DiagramName, box: Box) -> Piece:
    """The frame of a figure, above it its name and scale."""
    unit = dimensions_in(page.sheet, page.language) if diagram == "mechanism" else ""
    parts = page.term(FIGURE_WORDS[diagram]), page.scale(diagram), unit
    caption = spaced(page.punctuation("list comma"), filter(None, parts))
    frame = Polygon(box.corners, "", strokes.DIMENSION)
    words = Text(complex(box.left, box.top - 1.6), fitted(caption, 3.2, box.width))
    return Piece({"construction": (Group((frame,), classes=("panel",)),), "labels": (words,)})


def _mechanism(page: FigurePage, panel: Box) -> Piece:
    room = panel.grown(-0.8)
    piece, content = mechanism_piece(page.sheet, page.letters, (room.width, room.height))
    return mechanism_with_inset(page.sheet, page.letters, page.language, piece, panel.centre - content.centre, room)


def _polygons(page: FigurePage, plan: SheetPlan) -> tuple[Piece, Piece | None, list[CoriolisTerm]]:
    """The polygons on a plan, of accelerations if it is drawn, and the Coriolis terms without room for their insets."""
    velocity, _ = _polygon(page, "velocity", plan.velocity)
    if not page.sheet.vectors["acceleration"]:
        return velocity, None, []
    return velocity, *_polygon(page, "acceleration", plan.acceleration)


def _polygon(page: FigurePage, diagram: DiagramName, panel: Box) -> tuple[Piece, list[CoriolisTerm]]:
    origin = panel.centre - extent(page.sheet, diagram, panel.grown(-3.0)).centre
    return polygon_with_insets(page.sheet, diagram, page.letters, page.language, panel.grown(-0.8), origin)


def _insets(pieces: Sequence[object]) -> list[str]:
    """The insets in polygons."""
    drawn = (piece.drawn for piece in pieces if isinstance(piece, Piece))
    return [part.id for each in drawn for part in walk(each) if isinstance(part, Group) and "inset" in part.classes]


@dataclass(frozen=True, eq=False)
class Remainder:
    """The remaining content, in the order of its parts.

    size : of the letters of the given data, at most (mm)
    begun : whether some of the readings are shown already
    """

    equations: Sequence[LineToSet] = ()
    coriolis: Sequence[CoriolisTerm] = ()
    given: Sequence[tuple[Run, ...]] = ()
    readings: Sequence[TableRow] = ()
    size: float = GIVEN[0]
    begun: bool = False

    def __len__(self) -> int:
        return len(self.equations) + len(self.coriolis) + len(self.given) + len(self.readings)


Place: TypeAlias = Literal["own", "spare", "continuation"]
"""Where a room is: that of its kind, below the caption; left by others on the first page; on a further page."""
Part: TypeAlias = Callable[[FigurePage, Remainder, Box, Place], tuple[Piece, Remainder]]
"""The part of one kind that a room holds, and the rest."""


def _into(page: FigurePage, rest: Remainder, room: Box, place: Place) -> tuple[list[Piece], Remainder]:
    """The part of the rest that fits a room, kinds below each other."""
    pieces: list[Piece] = []
    for part in (_equations, _senses, _given, _readings):
        if pieces and pieces[-1].layers:
            room = below(room, pieces[-1].drawn, GAP)
        piece, rest = part(page, rest, room, place)
        pieces.append(piece)
        if not rest:
            break
    return pieces, rest


def continued(page: FigurePage, rest: Remainder, rooms: Sequence[Box]) -> Piece | None:
    """The rest in rooms that other writing leaves on the first page; None where it does not fit."""
    pieces: list[Piece] = []
    for room in rooms:
        more, rest = _into(page, rest, room, "spare")
        pieces += more
    return None if rest else joined(pieces)


def continuation(page: FigurePage, rest: Remainder, frame: Box) -> tuple[Drawing, ...]:
    """The further pages of the rest, each of the size of a first page with the inside ``frame``, halved down to A4 or
    Letter, since the rest are words."""
    short, long = sorted((frame.left + frame.right, frame.top + frame.bottom))
    if long / 2 >= NARROWEST:
        while long / 2 >= NARROWEST:
            short, long = long / 2, short
        frame = Box(frame.left, frame.top, short - frame.left, long - frame.top)
    made: list[Drawing] = []
    while rest:
        number, before = len(made) + 2, rest
        said = " ".join(map(str, page.said("sheet number", number=number)))
        corner = _below(frame, plain(said, 2.6), "end")
        pieces, rest = _into(page, rest, Box(frame.left, frame.top + HEAD, frame.right, frame.bottom), "continuation")
        size = frame.left + frame.right, frame.top + frame.bottom
        made.append(replace(
            _drawn_page(page, *size, (heading(page, frame), corner, *pieces), f" ({number})"),
            desc=_held(page, before, rest),
        ))
        if len(rest) == len(before):  # nothing is so large that a page does not hold it
            raise AssertionError("a page holds nothing of what is left")
    return tuple(made)


def _held(page: FigurePage, before: Remainder, after: Remainder) -> str:
    """The content of a further page in words: the parts that remain before it and not after it."""
    kinds = {
        "equations": len(before.equations) - len(after.equations), "given": len(before.given) - len(after.given),
        "readings": len(before.readings) - len(after.readings),
        FIGURE_WORDS["acceleration"]: len(before.coriolis) - len(after.coriolis),
    }
    shown = [page.term(kind) for kind, count in kinds.items() if count]
    return page.punctuation("symbol comma").join(shown)


def heading(page: FigurePage, frame: Box) -> Piece:
    """Title and driver values at the head of a page."""
    names = titles(page.sheet, page.language)
    runs = fitted("   ".join(names), 4.6, frame.width, bold=True, least=2.6)
    lines = [(4.0, runs if runs_width(runs) <= frame.width else cut_off(names[0], 4.6, frame.width, bold=True))]
    if len(names) > 1 and runs[0].size < TWO_LINES:
        lines = [(2.6 + 3.7 * i, cut_off(name, TWO_LINES, frame.width, bold=True)) for i, name in enumerate(names)]
    lines.append((9.2 + 0.6 * (len(lines) - 1), fitted(drivers(page.sheet, page.letters), 3.2, frame.width)))
    return Piece({"labels": tuple(Text(complex(frame.left, frame.top + y), said) for y, said in lines)})


def captioned(box: Box, caption: str, layer: str, children: tuple[Primitive, ...]) -> Piece:
    """Things in a box under its caption."""
    words = Text(complex(box.left, box.top - 1.6), fitted(caption, 3.2, box.width, bold=True))
    return joined((Piece({"labels": (words,)}), Piece({layer: children})))


def below(room: Box, drawn: tuple[Primitive, ...], gap: float) -> Box:
    """The part of a room below its content."""
    ink = ink_box(drawn)
    return room._replace(top=(ink.bottom if ink else room.top) + gap)


def _under_caption(room: Box, place: Place) -> Box:
    return room if place == "own" else room._replace(top=room.top + CAPTION)


def _foot(room: Box) -> Box:
    """The foot of a room, which a row of insets fills."""
    return room._replace(top=room.bottom - INSET[1])


def _own_given(page: FigurePage, rest: Remainder, room: Box, place: Place) -> tuple[Piece, Remainder]:
    """The given data, as large as they fit, with insets below them if these have room too."""
    drawn, left = given_data(page.sheet, page.letters, page.language, room, rest.size)
    data, rest = captioned(room, page.term("given"), "labels", drawn), replace(rest, given=left)
    if left or below(room, drawn, GUTTER).top >= _foot(room).top:
        return data, rest
    insets, rest = _senses(page, rest, _foot(room), place)
    return joined((data, insets)), rest


def _own_equations(page: FigurePage, rest: Remainder, room: Box, place: Place) -> tuple[Piece, Remainder]:
    """The equations, and below them insets, if all equations have room above these."""
    above = room._replace(bottom=_foot(room).top - GUTTER)
    if rest.coriolis and above.height >= EQUATIONS_ROOM:
        written, left = _equations(page, rest, above, place)
        if not left.equations:
            insets, left = _senses(page, left, _foot(room), place)
            return joined((written, insets)), left
    return _equations(page, rest, room, place)


def _equations(page: FigurePage, rest: Remainder, room: Box, place: Place) -> tuple[Piece, Remainder]:
    box = _under_caption(room, place)
    if place == "continuation":
        blocks, count = equations_on_page(rest.equations, box.width, box.height)
    else:
        most = (LEAST_LETTERS,) if place == "spare" else ()
        blocks, count = equations_in_room(rest.equations, box.width, box.height, *most)
    if not count and place != "own":
        return Piece(), rest
    written = moved(blocks, complex(box.left, box.top))
    name = "equations continued" if place == "spare" else "equations"
    piece = captioned(box, page.term(name), "labels", (Group(written, id=name.replace(" ", "-")),))
    return piece, replace(rest, equations=rest.equations[count:])


def _senses(page: FigurePage, rest: Remainder, room: Box, place: Place) -> tuple[Piece, Remainder]:
    drawn, left = coriolis_rows(page.sheet, rest.coriolis, page.letters, room, GAP)
    return drawn, replace(rest, coriolis=left)


def _given(page: FigurePage, rest: Remainder, room: Box, place: Place) -> tuple[Piece, Remainder]:
    size = max((run.size for line in rest.given for run in line), default=1.0)
    most = max(0, int((room.height - CAPTION) / (1.55 * size)))
    if place == "spare" or not rest.given or not most:
        return Piece(), rest
    box = _under_caption(room, place)
    lines = set_lines(rest.given[:most], complex(box.left, box.top))
    piece = captioned(box, page.term("given"), "labels", lines)
    return piece, replace(rest, given=rest.given[most:])


def _readings(page: FigurePage, rest: Remainder, room: Box, place: Place) -> tuple[Piece, Remainder]:
    least = CAPTION + (LEAST_TABLE if place == "continuation" else 0.0)
    if place != "own" and (not rest.readings or room.height < least or room.width < TABLE_WIDTH):
        return Piece(), rest
    box = _under_caption(room, place)
    table, count = readings_table(page.sheet, rest.readings, page.letters, page.language, box)
    if not count and place != "own":
        return Piece(), rest
    caption = page.term("readings continued" if rest.begun and place != "continuation" else "readings")
    left = replace(rest, readings=rest.readings[count:], begun=True)
    shown = table.moved(complex(box.left, box.top)).layers.get("answers", ())
    return captioned(box, caption, "answers", shown), left


LEGIBLE_TITLE = 2.4  # mm
TITLE_LINES = 3  # at most in the block
BAR_ROOM, SCALES_ROOM = 56.0, 33.0  # least widths in it, for the check bar and for the scales


def title_block(page: FigurePage, shown: Sequence[Compared], box: Box) -> Piece:
    """The block of a sheet: title, instrument, scales, and whether the ``shown`` readings agree."""
    sheet, language = page.sheet, page.language
    lines: list[Primitive] = [Polygon(box.corners, "", strokes.OUTLINE)]
    right = min(box.left + 0.66 * box.width, box.right - BAR_ROOM)
    names = titles(sheet, language)
    left = box.left + 2.0
    for share in (0.36, 0.48):  # more for a long title
        middle = min(box.left + share * box.width, right - SCALES_ROOM)
        title = _title_lines(names, middle - left - 1.5)
        if title[0][0].size >= LEGIBLE_TITLE:
            break
    lines += [Line(complex(x, box.top), complex(x, box.bottom), strokes.DIMENSION) for x in (middle, right)]
    words: list[Primitive] = []
    y = box.top + 1.4
    for runs in title:
        y += 1.25 * runs[0].size
        words.append(Text(complex(left, y), runs))
    tools = page.term("instrument") + page.punctuation("colon") + page.term(f"instrument {sheet.instrument}")
    second = sheet.scene.name + page.punctuation("list comma") + tools
    words.append(Text(complex(left, box.bottom - 2.0), fitted(second, 2.6, middle - left - 1.5)))
    for i, diagram in enumerate(("mechanism", *POLYGONS)):
        text = fitted(page.scale(diagram), 3.0, right - middle - 4.0)
        words.append(Text(complex(middle + 2.0, box.top + 4.6 + 4.4 * i), text))
    label = fitted(term("check bar", page.language, length="50 mm"), 2.4, 50.0)
    words += check_bar(complex(box.right - 53.0, box.bottom - 2.2), label)
    answers: tuple[Primitive, ...] = ()
    if shown:
        judged = [row.ok for row in shown if row.ok is not None]
        wrong, whole = judged.count(False), len(judged)
        agree = Phrase(about("all agree", judged), readings=whole)
        phrase = Phrase("not all agree", wrong=wrong, readings=whole) if wrong else agree
        answers = tuple(
            Text(complex(right + 2.0, box.top + 4.2 + 3.6 * i), fitted(say(phrase, each), 2.6, box.right - right - 4.0))
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
    if len(lines) > TITLE_LINES:
        last = "".join(run.text for run in lines[TITLE_LINES - 1])
        lines[TITLE_LINES - 1] = cut_off(f"{last}…", size, width, bold=True)
    return lines[:TITLE_LINES]


FIGURES = (Figure("sheet", sheet_page, "small sheet", lambda scene: True, place=4),)
