"""Boxes of a page: content about its left upper corner that knows its size; set below each other, beside each other,
and at last as a page with its heading and its foot.

Every length is in mm, y down.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from graphkin.account.given import drivers
from graphkin.account.headings import facts, figure_title, punctuation, term, titles
from graphkin.account.notation import Notation, notation_of, scale_statement
from graphkin.account.spoken import spoken_words
from graphkin.account.voice import Account, account_of
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import DiagramName
from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Group, Line, Polygon, Primitive, Run, Text, map_tree
from graphkin.drawing.place.dimensions import BAR, check_bar
from graphkin.drawing.place.piece import Piece, joined, layer_groups, moved_piece
from graphkin.drawing.text import SMALLEST, fitted, plain, rich, runs_width, wrapped
from graphkin.drawing.write.drawing import Drawing
from graphkin.plane import added_up
from graphkin.scene.scene_tables import Convention
from graphkin.words import Phrase, Wording, in_all, languages, word
from graphkin.words.symbols import RichText, Words
from graphkin.words.written import in_sentence

MARGIN = 8.0  # of a page
INSIDE = 174.0  # width of a page between its margins, where a figure has none of its own
BELOW = 6.0  # from the base line of the foot to the edge of the page
WORKED = 186.0  # width between the margins of a page on which a task is worked out
SIZE, STEP = 2.8, 3.0  # of the letters of prose; of steps and notes
LEADING, BASE = 1.55, 0.7  # a line of text by the size of its letters; its base line, of the line
TITLE, GIVEN, SCALE = 4.0, 3.2, 3.5  # letters of titles, of what stands below them, of the scale
HEAD_LINE = 5.0  # from line to line of a heading
CELL_GAP = 0.8  # between cells of a table
GAP = 2.0  # between heading and body, body and foot
LEAST = 114.0  # least width of a page between its margins
INDENT = 8.0  # of a paragraph behind its number
TOLD = ("told",)  # the class of what is said of a figure


@dataclass(frozen=True)
class Block:
    """Content about its left upper corner, with its height and width."""

    piece: Piece
    height: float
    width: float = 0.0

    def moved(self, by: complex) -> Piece:
        return moved_piece(self.piece, by) if by else self.piece


BARE = Block(Piece(), 0.0)


def prose(
    lines: Iterable[Words], width: float, size: float = SIZE, *, bold: bool = False, line: float = 0.0,
    classes: tuple[str, ...] = (), step: int | None = None,
) -> Block:
    """Text in paragraphs of one line or more, ``line`` mm from line to line."""
    height = line or LEADING * size
    rows = [runs for text in lines for runs in wrapped(text, size, width, bold=bold)]
    bases = (complex(0.0, height * (k + BASE)) for k in range(len(rows)))
    texts = tuple(Text(at, runs, classes=classes, step=step) for at, runs in zip(bases, rows, strict=True))
    return Block(Piece({"labels": texts} if texts else {}), height * len(rows), width)


def line(text: Words, width: float, size: float = SIZE) -> Block:
    """One line of text, smaller where it is wider than its width."""
    height = LEADING * size
    return Block(Piece({"labels": (Text(complex(0.0, BASE * height), fitted(text, size, width)),)}), height, width)


def numeral(number: int, width: float, size: float = SIZE, *, bold: bool = False, step: int | None = None,
            classes: tuple[str, ...] = ()) -> Block:
    """A number at the left of numbered content, which begins after a width."""
    line = LEADING * size
    at, runs = complex(width - 2.5, BASE * line), plain(str(number), size, bold=bold)
    return Block(Piece({"labels": (Text(at, runs, "end", classes=classes, step=step),)}), line, width)


def numbered(number: int, text: Words, width: float, size: float = SIZE, *, step: int | None = None) -> Block:
    """A paragraph after its number."""
    paragraph = prose((text,), width - INDENT, size, classes=TOLD, step=step)
    return row(numeral(number, INDENT, size, bold=True, step=step, classes=TOLD), paragraph)


def column(*blocks: Block | None, gap: float = 0.0) -> Block:
    """Blocks below each other; those without height take no gap."""
    pieces: list[Piece] = []
    y = width = 0.0
    for block in (block for block in blocks if block is not None and block.height):
        y += gap if pieces else 0.0
        pieces.append(block.moved(complex(0.0, y)))
        y, width = y + block.height, max(width, block.width)
    return Block(joined(pieces), y, width)


def row(*blocks: Block, gap: float = 0.0) -> Block:
    """Blocks beside each other, their upper edges level."""
    pieces: list[Piece] = []
    x = 0.0
    for block in blocks:
        pieces.append(block.moved(complex(x, 0.0)))
        x += block.width + gap
    return Block(joined(pieces), max((block.height for block in blocks), default=0.0), max(0.0, x - gap))


def pages(blocks: Iterable[Block], height: float, gap: float) -> list[Block]:
    """Blocks below each other, divided into pages of a height."""
    return [column(*some, gap=gap) for some in _lots(blocks, height, gap, lambda block: block.height)]


def rows(blocks: Sequence[Block], width: float, gap: float) -> list[Block]:
    """Blocks beside each other, divided into rows of a width."""
    return [row(*some, gap=gap) for some in _lots(blocks, width + 0.1, gap, lambda block: block.width)]


def _lots(
    blocks: Iterable[Block], room: float, gap: float, size: Callable[[Block], float]
) -> Iterator[list[Block]]:
    """Blocks in order in lots whose sizes (mm), with gaps between, a room holds; a larger block is a lot of its own."""
    lot: list[Block] = []
    used = 0.0
    for block in blocks:
        if lot and used + size(block) > room:
            yield lot
            lot, used = [], 0.0
        lot.append(block)
        used += size(block) + gap
    if lot:
        yield lot


def panel(width: float, height: float, draw: Callable[[Box], Piece]) -> Block:
    """A room for a drawing; ``draw`` gets the room."""
    return Block(draw(Box(0.0, 0.0, width, height)), height, width)


def framed(block: Block) -> Block:
    """The block in a thin frame."""
    frame = Polygon(Box(0.0, 0.0, block.width, block.height).corners, "", strokes.DIMENSION)
    return replace(block, piece=joined((Piece({"construction": (Group((frame,), classes=("panel",)),)}), block.piece)))


def table(
    heads: Sequence[Sequence[Words]], rows: Sequence[Sequence[Words]], widths: Sequence[float], *, size: float = SIZE,
    line: float = 0.0, layer: str = "labels",
) -> Block:
    """A table: lines of heads (one a language) over a rule, rows of cells, a thin rule below; the first column begins
    at the left, the others end at the right.  Text wider than its column is set smaller; a column that does not
    hold it even so is as much wider as others can do with less."""
    line = line or LEADING * size
    widths = _wide_enough(rows, widths, size)
    edges = [added_up(widths[:k]) for k in range(len(widths) + 1)]
    drawn: list[Primitive] = []
    y = 0.72 * line
    for n, words in enumerate(heads):
        small = min(_fitting(text, size - 0.1, edges[k + 1] - edges[k] - 1.2) for k, text in enumerate(words))
        drawn += [_cell(rich(text, small), edges, k, y) for k, text in enumerate(words)
                  if text and not (n and text == heads[0][k])]
        y += 0.75 * line
    rule = y - 0.42 * line
    drawn.append(Line(complex(edges[0], rule), complex(edges[-1], rule), strokes.OUTLINE))
    for n, cells in enumerate(rows):
        for k, text in enumerate(cells):
            runs = fitted(text, size, edges[k + 1] - edges[k] - CELL_GAP)
            if runs:
                drawn.append(_cell(runs, edges, k, rule + (n + 0.72) * line))
    low = rule + (len(rows) + 0.3) * line
    drawn.append(Line(complex(edges[0], low), complex(edges[-1], low), strokes.DIMENSION))
    return Block(Piece({layer: tuple(drawn)}), low, edges[-1])


def _wide_enough(rows: Sequence[Sequence[Words]], widths: Sequence[float], size: float) -> Sequence[float]:
    """Widths of columns (mm) in which no cell is wider in the smallest letters, as far as others can do with less."""
    least = [CELL_GAP] * len(widths)
    for cells in rows:
        for k, text in enumerate(cells):
            wide = runs_width(rich(text, size)) + CELL_GAP
            if wide > widths[k]:
                wide = runs_width(rich(text, SMALLEST)) + CELL_GAP
            least[k] = max(least[k], wide)
    short = [max(0.0, need - width) for need, width in zip(least, widths, strict=True)]
    spare = [max(0.0, width - need) for need, width in zip(least, widths, strict=True)]
    passed = min(added_up(short), added_up(spare))
    if not passed:
        return widths
    taken, given = passed / added_up(spare), passed / added_up(short)
    return [width - taken * more + given * less for width, more, less in zip(widths, spare, short, strict=True)]


def _fitting(text: Words, size: float, width: float) -> float:
    """The size, down to 2 mm, at which a head fits a width."""
    wide = runs_width(rich(text, size))
    return size if wide <= width else max(2.0, size * width / wide)


def _cell(runs: tuple[Run, ...], edges: Sequence[float], k: int, y: float) -> Text:
    return Text(complex(edges[k], y), runs) if k == 0 else Text(complex(edges[k + 1] - 0.6, y), runs, "end")


def heading(names: Iterable[str], below: Words, width: float) -> Block:
    """Titles, and below them lines on the content or the given data."""
    parts = [prose((text,), width, TITLE, bold=True, line=HEAD_LINE, classes=("heading",)) for text in names]
    return column(*parts, prose((below,) if below else (), width, GIVEN, line=HEAD_LINE, classes=("heading",)))


def foot(scale: Words, width: float, language: str, note: Words = "") -> Block:
    """The scale, a bar that checks a print, and a small note below them."""
    base = 8.0j
    bar = check_bar(base + width - BAR, fitted(term("check bar", language, length="50 mm"), 2.5, BAR))
    words = (Text(base, fitted(scale, SCALE, width - BAR - 6.0)),) if scale else ()
    more = (Text(base + 3.8j, fitted(note, 2.4, width)),) if note else ()
    return Block(Piece({"labels": (*words, *bar, *more)}), base.imag, width)


def page(
    head: Block, body: Block, low: Block, *, title: str, said: Words, language: str, metadata: Mapping[str, object],
    margin: float = MARGIN, height: float = 0.0,
) -> Drawing:
    """Heading, body and foot on a page of their own width and height, or of the height of its paper, the foot at its
    end.

    Parameters
    ----------
    said : the figure in words, read aloud to those who do not see it
    language : "en", "zh" or "both"
    """
    top = margin + head.height + (GAP if head.height else 0.0)
    after = low.height + min(BELOW, margin)
    end = max(top + body.height, height - after)
    parts = body.moved(complex(margin, top)), head.moved(complex(margin, margin)), low.moved(complex(margin, end))
    width = max(block.width for block in (head, body, low)) + 2 * margin
    first = languages(language)[0]
    desc = spoken_words(said, first)
    return Drawing(width, end + after, layer_groups(joined(parts)), title, desc, first, dict(metadata))


def without_titles(children: tuple[Primitive, ...]) -> tuple[Primitive, ...]:
    """The content of a page without its heading, for a paper with the same heading."""
    return map_tree(children, lambda part: None if isinstance(part, Text) and "heading" in part.classes else part)


def worked_page(
    names: Iterable[str], given: Words, drawn: Sequence[Block], sheet: Sheet, results: Block,
    notes: Iterable[Wording], scale: Words, *, title: str, said: Words, language: str, metadata: Mapping[str, object],
) -> Drawing:
    """The page of a worked task, of the width `WORKED` inside: the given data, its drawings, its numbered steps in each
    language, the results, notes, and the foot.

    Parameters
    ----------
    names : of the task, in each language in which it has one
    title, said : of the figure as a key of the table of words, and the figure in words
    """
    head, every, account = dict.fromkeys(names), languages(language), account_of(sheet)
    work = [
        column(*(numbered(step.number, account.say(step.phrase, each), WORKED, STEP, step=step.number)
                 for step in sheet.steps)) for each in every
    ]
    lines = [line.with_words(in_sentence) for note in notes for line in in_all(note, language)]
    return page(
        heading(head, given, WORKED), column(*drawn, *work, results, prose(lines, WORKED, STEP, classes=TOLD), gap=3.0),
        foot(scale, WORKED, language), said=said, language=language, metadata=metadata, margin=12.0,
        title=f"{' / '.join(head)}: {word(title, every[0])}",
    )


def spoken(account: Account, phrases: Iterable[Phrase], language: str) -> str:
    """Sentences in the first language of a figure, for readers who do not see it."""
    first = languages(language)[0]
    sentences = (account.sentence(phrase, first).plain("") for phrase in phrases)
    return word("between sentences", first).join(sentences)


def picture(body: Block, title: str, language: str, metadata: Mapping[str, object], scale: Words = "") -> Drawing:
    """A block by itself, with its scale below it if it has one, for a paper with the other words."""
    words = word(title, languages(language)[0])
    low = foot(scale, WORKED, language) if scale else BARE
    return page(BARE, body, low, title=words, said=words, language=language, metadata=metadata, margin=2.0)


@dataclass(frozen=True)
class FigurePage:
    """The page of a figure of a drawn mechanism: its language and letters, and its width inside.

    name : of the figure in the metadata
    """

    sheet: Sheet
    name: str
    language: str
    letters: Notation
    width: float = INSIDE

    @classmethod
    def of(
        cls, sheet: Sheet, name: str, language: str | None, convention: str | None, width: float = INSIDE
    ) -> FigurePage:
        """``language`` and ``convention`` are by default the scene's own."""
        wish = sheet.scene.question.sheet
        letters = notation_of(sheet, convention or wish.convention)  # type: ignore[arg-type]
        return cls(sheet, name, language or wish.language, letters, width)

    def wide_enough(self, width: float) -> FigurePage:
        """The page at the width of a drawing, but not narrower than its words need."""
        return replace(self, width=max(LEAST, width))

    @property
    def convention(self) -> Convention:
        return self.letters.convention

    def term(self, key: str) -> str:
        return term(key, self.language)

    def punctuation(self, key: str) -> str:
        """A mark of punctuation behind words of `term`."""
        return punctuation(key, self.language)

    def at_drivers(self, name: str) -> RichText:
        """The name of a figure, and the values of the drivers: the line below its title."""
        return name + self.punctuation("colon") + drivers(self.sheet, self.letters)

    def said(self, key: str, /, **gaps: object) -> tuple[RichText, ...]:
        """A phrase in each language of the page, a single line if its formulas can stand once."""
        return in_all(Phrase(key, **gaps), self.language)

    def prose(self, said: Iterable[Wording], size: float = SIZE, *, bold: bool = False) -> Block:
        """A statement in every language of the page."""
        return prose((line for words in said for line in in_all(words, self.language)), self.width, size, bold=bold)

    def panel(self, height: float, draw: Callable[[Box], Piece]) -> Block:
        return panel(self.width, height, draw)

    def scale(self, diagram: DiagramName, per_mm: float | None = None) -> Words:
        """The scale of a diagram in the form of the convention; ``per_mm`` (SI) in place of the sheet's own."""
        sheet = self.sheet
        if per_mm is not None:
            name = "length" if diagram == "mechanism" else diagram
            sheet = replace(sheet, scales=replace(sheet.scales, **{name: per_mm}))
        return scale_statement(sheet, self.convention, diagram)

    def height_for(self, below: Words, height: float) -> float:
        """The height of the body on a paper of a height."""
        head = heading(titles(self.sheet, self.language), below, self.width)
        return height - MARGIN - head.height - 2 * GAP - foot("", self.width, self.language).height - BELOW

    def drawing(
        self, below: Words, body: Block, scale: Words | None, *, title: str, said: Words, note: Words = "",
        metadata: Mapping[str, object] | None = None, height: float = 0.0,
    ) -> Drawing:
        """The page with the titles of the scene.

        Parameters
        ----------
        below : the lines below the titles
        scale, note : of the foot; a figure without a scale (None) has no foot
        title : the name of the figure, as a key of the table of words
        height : of the paper, if the page is not as high as its content
        """
        low = BARE if scale is None else foot(scale, self.width, self.language, note)
        return page(
            heading(titles(self.sheet, self.language), below, self.width), body, low,
            title=figure_title(self.sheet, title, self.language), said=said, language=self.language,
            metadata=facts(self.sheet, self.name) | dict(metadata or {}), height=height,
        )
