"""The blocks of a handout, whatever its format: headings, sentences, steps, figures, tables.

Words are in one language or in several, below each other.  Words from a scene are cleaned: they cannot hide, turn or
break a line of text.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from graphkin.account.voice import capital, whole_sentence
from graphkin.drawing.write.drawing import Drawing
from graphkin.papers.paper import A4, Paper
from graphkin.words import Phrase, languages, rich_text, word
from graphkin.words.symbols import Words, spaced

# control characters, halves of surrogates, what no file may hold, and marks that turn the direction of writing
_UNFIT = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069\ud800-\udfff\ufeff\ufffe\uffff]"
)


def clean(text: str) -> str:
    """The words without characters that could hide their neighbours.

    >>> clean("sheet\\u202egpj.exe")
    'sheetgpj.exe'
    """
    return _UNFIT.sub("", text)


Said: TypeAlias = tuple[tuple[str, Words], ...]  # (language, words) for each language


@dataclass(frozen=True)
class Heading:
    """A heading of level 1 (the document's), 2 or 3; ``fresh`` begins a new page with it."""

    words: Said
    level: int = 2
    fresh: bool = False


@dataclass(frozen=True)
class Paragraph:
    """Sentences; ``small`` for remarks; ``fills`` leaves the rest of the page below them free to write in, and omits
    them where little of it is left."""

    words: Said
    small: bool = False
    fills: bool = False


@dataclass(frozen=True)
class StepItem:
    """A step of the construction: its number, its reason, the lines of its sums; ``parted`` sets it and its neighbours
    on paper in two columns, down the left and then down the right."""

    number: int
    words: Said
    work: tuple[Words, ...] = ()
    parted: bool = False


@dataclass(frozen=True)
class Picture:
    """A figure at true scale with its caption; ``drawing.desc`` describes it in words.

    ``joined`` keeps it on one page with the next block (an equation with its steps); ``floats`` allows it at the head
    of the next page, after the blocks that follow it.
    """

    drawing: Drawing
    caption: Said = ()
    joined: bool = False
    floats: bool = False


@dataclass(frozen=True)
class Plate:
    """A page of a figure as an SVG with letters as paths (mm), no wider than the paper; ``seen`` tells it in words."""

    svg: str
    width: float
    height: float
    seen: str
    caption: Said = ()


@dataclass(frozen=True)
class TableBlock:
    """Rows under heads; ``align`` is one of l, r, c for each column; ``bold`` are the emphasised rows.

    ``roomy`` makes cells to write in by hand, ``halved`` sets the rows in two halves side by side.
    """

    heads: tuple[Said, ...]
    rows: tuple[tuple[Words, ...], ...]
    align: str
    bold: frozenset[int] = frozenset()
    roomy: bool = False
    halved: bool = False


@dataclass(frozen=True)
class Fields:
    """Names of blanks to fill in, as at the head of a sheet."""

    names: tuple[Said, ...]


@dataclass(frozen=True)
class Beside:
    """Blocks with a narrow figure at their right."""

    blocks: tuple[Heading | Paragraph | StepItem, ...]
    picture: Picture


@dataclass(frozen=True)
class Together:
    """Blocks that are kept on one page if they fit on it."""

    blocks: tuple[Leaf, ...]


Leaf: TypeAlias = Heading | Paragraph | Fields | StepItem | Picture | Plate | TableBlock | Beside
"""What is never parted, but for long tables."""
Block: TypeAlias = Leaf | Together


@dataclass(frozen=True)
class Document:
    """A whole document: its title in words, its languages in order, its blocks, and its paper; on ``folded`` paper the
    blocks before the first fresh heading are set in two halves."""

    title: str
    languages: tuple[str, ...]
    blocks: tuple[Block, ...]
    paper: Paper = A4
    folded: bool = False


def laid_out(blocks: Iterable[Block]) -> Iterator[Leaf]:
    """Every block by itself, in reading order."""
    for block in blocks:
        if isinstance(block, Together):
            yield from laid_out(block.blocks)
        elif isinstance(block, Beside):
            yield from block.blocks
            yield block.picture
        else:
            yield block


def said(key: str, language: str, /, **gaps: object) -> Said:
    """Words from the table of terms, in the languages of a sheet ("en", "zh" or "both")."""
    return in_each(language, lambda each: rich_text(Phrase(key, **gaps), each))


def said_each(language: str, keys: Sequence[str]) -> tuple[Said, ...]:
    """Heads of columns, or names of fields, by their keys in the table of terms."""
    return tuple(said(key, language) for key in keys)


def table_of(
    language: str, rows: Iterable[Mapping[str, Words]], keys: Sequence[str], bold: Collection[int] = (),
    roomy: bool = False,
) -> TableBlock:
    """Rows of cells by the keys of their heads as a table of some of these columns; a missing cell is empty.  Names,
    units and senses are aligned to the left, numbers to the right, cells to write in to the middle."""
    left = ("quantity", "unit") if roomy else ("quantity", "unit", "sense")
    align = "".join("l" if key in left else "c" if roomy else "r" for key in keys)
    cells = tuple(tuple(row.get(key, "") for key in keys) for row in rows)
    return TableBlock(said_each(language, keys), cells, align, frozenset(bold), roomy)


def in_each(language: str, words: Callable[[str], Words]) -> Said:
    """Words made for each language of a sheet."""
    return tuple((each, words(each)) for each in languages(language))


def once(words: Words, language: str) -> Said:
    """Words that are the same in every language, once."""
    return ((languages(language)[0], words),)


def finished(words: Said) -> Said:
    """Words in each language as sentences."""
    return tuple((each, whole_sentence(text, each)) for each, text in words)


def numbered(count: int, caption: Said) -> Said:
    """The caption of a figure after its number."""
    return tuple(
        (each, rich_text(Phrase("figure numbered", number=count, caption=capital(text)), each))
        for each, text in caption
    )


def sentences(*several: Said) -> Said:
    """Sentences in order, by language."""
    by_language: list[tuple[str, Words]] = []
    for parts in zip(*several, strict=True):
        language = parts[0][0]
        by_language.append((language, spaced(word("between sentences", language), (text for _, text in parts))))
    return tuple(by_language)
