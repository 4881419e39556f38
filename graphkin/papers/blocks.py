"""What a handout is made of, whatever it is written as: headings, sentences, steps, figures, tables.

Words are said in one language or in several, one below the other; symbols in them stand between dollar signs, in the
notation of `graphkin.drawing.text`.  Words from a scene are made fit to be shown: nothing in them hides, turns
or breaks a line of text.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from graphkin.account.voice import capital, whole_sentence
from graphkin.drawing.write.drawing import Drawing
from graphkin.papers.paper import A4, Paper
from graphkin.words import Phrase, languages, say, word

# control characters, halves of surrogates, what no file may hold, and marks that turn the direction of writing
_UNFIT = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069\ud800-\udfff\ufeff\ufffe\uffff]"
)


def clean(text: str) -> str:
    """The words without characters that could hide what stands beside them.

    >>> clean("sheet\\u202egpj.exe")
    'sheetgpj.exe'
    """
    return _UNFIT.sub("", text)


Said: TypeAlias = tuple[tuple[str, str], ...]  # (language, words) for each language


@dataclass(frozen=True)
class Heading:
    """A heading of level 1 (the document's), 2 or 3; ``fresh`` begins a new page with it."""

    words: Said
    level: int = 2
    fresh: bool = False


@dataclass(frozen=True)
class Paragraph:
    """Sentences; ``small`` for remarks; ``fills`` makes the rest of a page below them room to write in, and leaves them
    out where little of it is left."""

    words: Said
    small: bool = False
    fills: bool = False


@dataclass(frozen=True)
class StepItem:
    """One step of the construction: its number, its reason, the lines of numbers computed in it; ``parted`` sets it and
    those beside it on paper in two columns, down the left and then down the right."""

    number: int
    words: Said
    work: tuple[str, ...] = ()
    parted: bool = False


@dataclass(frozen=True)
class Picture:
    """A figure at true scale with its caption; ``drawing.desc`` says in words what it shows.

    ``joined`` keeps it with what follows on one page (an equation with its steps); ``floats`` lets it stand at the head
    of the next page, what follows it before it.
    """

    drawing: Drawing
    caption: Said = ()
    joined: bool = False
    floats: bool = False


@dataclass(frozen=True)
class Plate:
    """A finished page of a figure as an SVG with its letters as paths (mm), shown as wide as the paper allows at most;
    ``seen`` says what it shows."""

    svg: str
    width: float
    height: float
    seen: str
    caption: Said = ()


@dataclass(frozen=True)
class TableBlock:
    """Rows under heads; ``align`` is one of l, r, c for each column; ``bold`` are the rows that stand out.

    ``roomy`` makes cells to write in by hand, ``halved`` sets them in two halves side by side.
    """

    heads: tuple[Said, ...]
    rows: tuple[tuple[str, ...], ...]
    align: str
    bold: frozenset[int] = frozenset()
    roomy: bool = False
    halved: bool = False


@dataclass(frozen=True)
class Fields:
    """Names of what is filled in on lines, as at the head of a sheet."""

    names: tuple[Said, ...]


@dataclass(frozen=True)
class Beside:
    """Blocks with a narrow figure at their right."""

    blocks: tuple[Heading | Paragraph | StepItem, ...]
    picture: Picture


@dataclass(frozen=True)
class Together:
    """Blocks that stand on one page if they fit on one."""

    blocks: tuple[Leaf, ...]


Leaf: TypeAlias = Heading | Paragraph | Fields | StepItem | Picture | Plate | TableBlock | Beside
"""What is never parted, but for long tables."""
Block: TypeAlias = Leaf | Together


@dataclass(frozen=True)
class Document:
    """A whole document: its title in words, its languages in order, its blocks, and its paper, of which ``folded`` sets
    in two halves what stands before the first fresh heading."""

    title: str
    languages: tuple[str, ...]
    blocks: tuple[Block, ...]
    paper: Paper = A4
    folded: bool = False


def laid_out(blocks: Iterable[Block]) -> Iterator[Leaf]:
    """Every block by itself, in the order in which they are read."""
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
    return in_each(language, lambda each: say(Phrase(key, **gaps), each))


def said_each(language: str, keys: Sequence[str]) -> tuple[Said, ...]:
    """Heads of columns, or names of fields, by their keys in the table of terms."""
    return tuple(said(key, language) for key in keys)


def table_of(
    language: str, rows: Iterable[Mapping[str, str]], keys: Sequence[str], bold: Collection[int] = (),
    roomy: bool = False,
) -> TableBlock:  # fmt: skip
    """Rows of cells by the keys of their heads as a table of some of these columns; a cell that a row does not have is
    left empty.  Names, units and senses stand on the left, numbers on the right, rooms to write in in the middle."""
    left = ("quantity", "unit") if roomy else ("quantity", "unit", "sense")
    align = "".join("l" if key in left else "c" if roomy else "r" for key in keys)
    cells = tuple(tuple(row.get(key, "") for key in keys) for row in rows)
    return TableBlock(said_each(language, keys), cells, align, frozenset(bold), roomy)


def in_each(language: str, words: Callable[[str], str]) -> Said:
    """Words made for each language of a sheet."""
    return tuple((each, words(each)) for each in languages(language))


def spoken(markup: str, language: str) -> Said:
    """Words that are the same in every language, said once."""
    return ((languages(language)[0], markup),)


def finished(words: Said) -> Said:
    """Words in each language as sentences."""
    return tuple((each, whole_sentence(text, each)) for each, text in words)


def numbered(count: int, caption: Said) -> Said:
    """The caption of a figure behind its number."""
    return tuple(
        (each, say(Phrase("figure numbered", number=count, caption=capital(text)), each)) for each, text in caption
    )


def sentences(*several: Said) -> Said:
    """Sentences one after the other, by language."""
    by_language: dict[str, list[str]] = {}
    for one in several:
        for each, text in one:
            by_language.setdefault(each, []).append(text)
    return tuple((each, word("between sentences", each).join(parts)) for each, parts in by_language.items())
