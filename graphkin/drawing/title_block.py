"""The title block at the foot of a sheet: what it shows, by what tools, its scales, whether all agrees, and a bar by
which a print is checked."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.account.headings import punctuation, term, titles
from graphkin.account.notation import Letters, scale_statement
from graphkin.checking.report import Compared
from graphkin.construction.sheet import Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Group, Line, Polygon, Primitive, Run, Text
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.piece import Piece
from graphkin.drawing.sheet_plan import BLOCK
from graphkin.drawing.text import fitted, wrapped
from graphkin.words import Phrase, languages, say

__all__ = ["title_block"]

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
        wrong = sum(row.ok is False for row in shown)
        whole = sum(row.ok is not None for row in shown)
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
