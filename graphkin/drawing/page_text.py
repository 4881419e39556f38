"""What stands in words on the page of one construction: heading, numbered steps, sentences on what is found, foot."""

from __future__ import annotations

from collections.abc import Iterable

from graphkin.construction.sheet import Sheet
from graphkin.drawing.headings import term, titles
from graphkin.drawing.ink.primitives import Primitive, Run, Text, map_tree, walk
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.text import plain, rich, wrapped
from graphkin.words import Phrase, in_all
from graphkin.words.written import in_markup

__all__ = [
    "FOOT",
    "LETTER",
    "LINE",
    "MARGIN",
    "WIDTH",
    "foot",
    "heading",
    "note_lines",
    "step_lines",
    "titled",
    "without_titles",
]

WIDTH, MARGIN, FOOT = 210.0, 12.0, 14.0
LETTER, LINE = 3.0, 4.6
INDENT = 8.0


def heading(title: str, given: str) -> list[Primitive]:
    """The title, and below it what is given, from the upper margin on."""
    head: list[tuple[Run, ...]] = [rich(in_markup(title), 4.0, bold=True)]
    head += wrapped(given, 3.2, WIDTH - 2 * MARGIN)
    return [Text(complex(MARGIN, MARGIN + 3.5 + 5.0 * i), runs, classes=("heading",)) for i, runs in enumerate(head)]


def titled(sheet: Sheet, language: str, below: str, margin: float = MARGIN) -> tuple[list[Primitive], float]:
    """The titles of a figure of a mechanism, and below them what it shows (markup), with the base line of that."""
    words: list[Primitive] = []
    y = margin
    for text in titles(sheet, language):
        y += 4.8
        words.append(Text(complex(margin, y), rich(text, 4.0, bold=True), classes=("heading",)))
    y += 5.0
    words.append(Text(complex(margin, y), rich(below, 3.2)))
    return words, y


def without_titles(children: tuple[Primitive, ...]) -> tuple[tuple[Primitive, ...], float]:
    """What a figure shows without its titles, for a page that has them, and the mm that are free then at its head."""

    def is_title(thing: Primitive) -> bool:
        return isinstance(thing, Text) and "heading" in thing.classes

    lines = [thing.at.imag for thing in walk(children) if isinstance(thing, Text) and is_title(thing)]
    return map_tree(children, lambda thing: None if is_title(thing) else thing), max(lines, default=0.0)


def step_lines(steps: Iterable[tuple[int, str]], y: float) -> tuple[list[Primitive], float]:
    """Steps with their numbers (markup), and where they end."""
    words: list[Primitive] = []
    for number, said in steps:
        numeral = plain(str(number), LETTER, bold=True)
        words.append(Text(complex(MARGIN + 5.0, y), numeral, "end", classes=("told",), step=number))
        for line in wrapped(said, LETTER, WIDTH - 2 * MARGIN - INDENT):
            words.append(Text(complex(MARGIN + INDENT, y), line, classes=("told",), step=number))
            y += LINE
    return words, y


def note_lines(notes: Iterable[Phrase], language: str, y: float) -> tuple[list[Primitive], float]:
    """Sentences, and where they end."""
    words: list[Primitive] = []
    for note in (line for said in notes for line in in_all(said, language)):
        for line in wrapped(note.replace(" -", " −"), LETTER, WIDTH - 2 * MARGIN):
            words.append(Text(complex(MARGIN, y), line, classes=("told",)))
            y += LINE
    return words, y


def foot(scale: str, y: float, size: float, language: str) -> list[Primitive]:
    """The scale (markup, mm high) on a base line, and a bar to check it by."""
    bar = check_bar(complex(WIDTH - MARGIN - 50.0, y), rich(term("check bar", language), 2.5))
    return [Text(complex(MARGIN, y), rich(scale, size)), *bar]
