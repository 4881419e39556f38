"""Where a sheet goes on: what of its equations, data, insets and readings found no room in its own place stands where
others have left some, or on further pages.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from graphkin.account.headings import drivers, facts, figure_title, term, titles
from graphkin.account.notation import Letters
from graphkin.construction.sheet import Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.equations import LEAST_LETTERS, LineToSet, equations_in_room, equations_on_page
from graphkin.drawing.ink.primitives import Group, Primitive, Run, Text, moved
from graphkin.drawing.parts.coriolis import INSET, CoriolisTerm, coriolis_row, per_row
from graphkin.drawing.place.piece import Piece, ink_box, joined, layer_groups
from graphkin.drawing.tables import TableRow, readings_table, set_lines
from graphkin.drawing.text import fitted, plain
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import Phrase, languages, say

__all__ = ["Remainder", "below", "captioned", "continued", "heading", "overleaf"]

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
        for part in (_equations, _senses, _given, _readings):
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
        for part in (_equations, _senses, _given, _readings):
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


def _equations(
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
