"""Documents as typeset PDF, by Typst: filled pages, figures at true scale, page numbers, the same bytes every time.

The template is fixed; the document is given to it as data, so that no word of a scene
is read as a command.  Typst measures each piece of a document once.  Words stay with the block to which they lead; a
figure without room on a page may stand at the head of the next one, after the words that follow it.  Of all page breaks
those with the least white are taken, as Knuth and Plass break the lines of a paragraph (Software: Practice and
Experience 11, 1981).
"""

from __future__ import annotations

import io
import json
import re
import warnings
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files
from itertools import groupby, pairwise
from typing import Any, TypeAlias

from graphkin.drawing.ink.primitives import Scan, map_tree, moved
from graphkin.drawing.text import is_italic
from graphkin.drawing.write.drawing import Drawing
from graphkin.drawing.write.pdf import faces, in_faces
from graphkin.drawing.write.svg import svg_element
from graphkin.papers.blocks import (
    Beside,
    Block,
    Document,
    Fields,
    Heading,
    Leaf,
    Paragraph,
    Picture,
    Plate,
    Said,
    StepItem,
    TableBlock,
    Together,
    clean,
)
from graphkin.papers.html import document_page
from graphkin.papers.paper import BOTTOM, SIDE, TOP
from graphkin.plane import added_up
from graphkin.words import word
from graphkin.words.symbols import Atom, Words, stretches

FORMATS = ("html", "pdf")
"""What papers are written as."""
Data: TypeAlias = dict[str, object]
"""What the template reads, as JSON holds it."""

EDGE = 0.5  # mm around a figure, for lines on its edge


def pdf(document: Document) -> bytes:
    """The document as a PDF on its paper, without a date."""
    import typst

    names, fonts = faces(True)
    template = files("graphkin.papers").joinpath("template.typ").read_bytes()
    frame = {
        "title": clean(document.title),
        "languages": list(document.languages),
        "page": " / ".join(word("page of", each) for each in document.languages),
        "fonts": names,
        "paper": [document.paper.width, document.paper.height],
        "columns": COLUMN_GAP,
        "halves": HALVES_GAP,
        "many": MANY_ROWS,
    }

    def measured(leaves: Sequence[tuple[Leaf, float | None]]) -> list[tuple[float, float]]:
        asked = [{"block": _block(leaf, bare=True), "width": width or 0} for leaf, width in leaves]
        sizes = typst.query(
            template, "<sizes>", field="value", one=True, format="json", font_paths=fonts,
            sys_inputs=_inputs({**frame, "measure": asked}),
        )
        return [(wide, high) for wide, high in json.loads(sizes)]

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        pages = [[[_row(row) for row in half] for half in page] for page in pages_of(document, measured)]
        made = typst.compile(
            template, font_paths=fonts, format="pdf", timestamp=0, sys_inputs=_inputs({**frame, "pages": pages})
        )
    assert isinstance(made, bytes)
    return made


def papers_as(formats: Collection[str], documents: Mapping[str, Document]) -> dict[str, bytes]:
    """Documents as files by name, in HTML, in PDF or in both."""
    made: dict[str, bytes] = {}
    if "html" in formats:
        made |= {f"{name}.html": document_page(document).encode() for name, document in documents.items()}
    if "pdf" in formats:
        made |= {f"{name}.pdf": pdf(document) for name, document in documents.items()}
    return made


def _inputs(data: Data) -> dict[str, str]:
    return {"document": json.dumps(data, ensure_ascii=False, allow_nan=False)}


def one_after_another(papers: Sequence[bytes]) -> bytes:
    """Several PDFs as one, for printing at once."""
    from pypdf import PdfWriter

    whole = PdfWriter()
    for paper in papers:
        whole.append(io.BytesIO(paper))
    made = io.BytesIO()
    whole.write(made)
    return made.getvalue()


def _block(block: Leaf, bare: bool = False) -> Data:
    """A leaf for the template, its fields by name; ``bare`` without the ink of figures, to measure their size."""
    if isinstance(block, Beside):
        lines = [{"gap": gap, "block": _block(line)} for gap, line in lines_of(block)]
        return {"kind": "Beside", "lines": lines, "picture": _block(block.picture)}
    if bare and isinstance(block, Picture):
        block = replace(block, drawing=replace(block.drawing, children=()))
    elif bare and isinstance(block, Plate):
        block = replace(block, svg="")
    fields = {name: FORMS[name](value) if name in FORMS else value for name, value in vars(block).items()}
    return {"kind": type(block).__name__, "edge": 0, **fields}


def _row(row: Row) -> Data:
    left, right = ([_block(piece.block) for piece in side] for side in (row.left, row.right))
    return {"gap": row.gap, "left": left, "right": right, "height": row.height}


def _said(said: Said) -> list[tuple[str, list[str | list[Data]]]]:
    return [(language, _words(text)) for language, text in said]


def _words(text: Words) -> list[str | list[Data]]:
    """Stretches of words, and symbols as lists of atoms."""
    return [clean(part) if isinstance(part, str) else _atoms(part) for part in stretches(text)]


def _atoms(atoms: tuple[Atom, ...]) -> list[Data]:
    return [
        {"text": clean(atom.text), "italic": is_italic(atom.text), "sub": _atoms(atom.sub), "sup": _atoms(atom.sup)}
        for atom in atoms
    ]


def _drawing(drawing: Drawing) -> Data:
    """A figure as an SVG with the faces of the document, and its description; no SVG for a figure without ink."""
    seen = clean(re.sub(r"\s+", " ", f"{drawing.title}. {drawing.desc}").strip())
    # a handout has no picture under its figures
    inked = moved(map_tree(drawing.children, lambda shape: None if isinstance(shape, Scan) else shape), EDGE * (1 + 1j))
    wide, high = drawing.width + 2 * EDGE, drawing.height + 2 * EDGE
    svg = svg_element(replace(drawing, width=wide, height=high, children=inked), alone=True) if inked else ""
    size = {"width": _mm(drawing.width), "height": _mm(drawing.height), "edge": EDGE}
    return {**size, "seen": seen, "svg": in_faces(svg, faces(True)[0])}


def _mm(value: float) -> float:
    return round(value, 4)


FORMS: Mapping[str, Callable[[Any], object]] = {
    "words": _said, "caption": _said, "heads": lambda heads: [*map(_said, heads)], "width": _mm, "height": _mm,
    "names": lambda names: [*map(_said, names)], "work": lambda lines: [*map(_words, lines)], "drawing": _drawing,
    "rows": lambda rows: [[*map(_words, row)] for row in rows], "bold": sorted, "seen": clean,
}
"""The fields of blocks that are not handed to the template as they are, and what it reads instead."""


# pieces on pages


COLUMN_GAP = 4.0  # mm between two columns of steps
HALVES_GAP = 12.0  # mm between the halves of a large page
FIGURE_GAP = 5.0  # mm between words and the figure beside them
HALVED = 12  # rows that are set in two halves side by side where these have room
MANY_ROWS = 30  # rows of a table that is parted where a page ends
MANY_STEPS = 2  # that leave the side of a figure for two columns below it
LEEWAY = 0.5  # mm of a page that stay free, for rounding
LEAST_ROOM = 25.0  # mm to write in
LEAST_FLOW = 40.0  # mm of what is parted over pages, on the first of them
MOST_MORE = 8.0  # mm by which a gap grows where a page has white left
ITEMS = 2.0  # mm between steps
WHITE = 0.28  # of a page, above which it is seen
SHORT = 0.25  # of a last page that is worth a page

# costs, where 1 is that of a page all but empty
KEPT = 50.0  # of parting what belongs together: only where a page does not hold it
INSIDE = 0.08  # of a page break between steps
BEFORE = 0.04  # of one between steps and their figure
DEFERRED = 0.15  # of a figure on the next page, some of what follows it before it
WORTH = 0.5  # that a figure below its words instead of beside them must save

Question: TypeAlias = tuple[Leaf, float | None]
"""A leaf, and the width (mm) at which its size is wanted, None where it is as wide as it is by itself."""
Measure: TypeAlias = Callable[[Sequence[Question]], Sequence[tuple[float, float]]]
"""Widths and heights (mm) of leaves."""
Sizes: TypeAlias = dict[Question, tuple[float, float]]


@dataclass(frozen=True)
class PageItem:
    """What stands on a page unbroken: its block, its height and the gap above it (mm), and the cost of a page break
    before it; with ``half`` it stands in one of two columns, with its neighbours of that kind."""

    block: Leaf
    height: float = 0.0
    gap: float = 0.0
    tie: float = 0.0
    half: bool = False

    @property
    def floats(self) -> bool:
        """Whether it is a figure that later words may overtake."""
        return isinstance(self.block, Picture) and self.block.floats

    @property
    def fills(self) -> bool:
        """Whether it takes the rest of its page."""
        return isinstance(self.block, Paragraph) and self.block.fills

    @property
    def fresh(self) -> bool:
        """Whether it begins a page."""
        return isinstance(self.block, Heading) and self.block.fresh


@dataclass(frozen=True)
class Row:
    """A part of a page: a piece, or two columns; the gap above, the ``height`` of what takes a page's rest (mm)."""

    left: tuple[PageItem, ...]
    right: tuple[PageItem, ...] = ()
    gap: float = 0.0
    height: float = 0.0


Page: TypeAlias = tuple[Row, ...]


def pages_of(document: Document, measure: Measure) -> list[tuple[Page, ...]]:
    """The pages of a document; on ``folded`` paper the pieces before its first fresh heading in two halves."""
    wide, high = document.paper.width - 2 * SIDE, document.paper.height - TOP - BOTTOM - LEEWAY
    pieces = list(_pieces(document.blocks))
    half = (wide - HALVES_GAP) / 2
    end = next((i for i, piece in enumerate(pieces) if piece.fresh), len(pieces)) if document.folded else 0
    folded, whole = pieces[:end], pieces[end:]
    asked = tuple(dict.fromkeys(
        question for some, width in ((folded, half), (whole, wide)) for piece in some
        for question in _questions(piece, width)
    ))
    sizes = dict(zip(asked, measure(asked), strict=True))
    halves = _filled(folded, half, high, sizes)
    return [tuple(halves[i : i + 2]) for i in range(0, len(halves), 2)] + [
        (page,) for page in _filled(whole, wide, high, sizes)
    ]


# from blocks to pieces of known height


def _pieces(blocks: Iterable[Block]) -> Iterator[PageItem]:
    """The pieces leaf by leaf, each with the cost of a break before it."""
    leads, before = False, None  # whether words or an equation lead to what follows them
    for block in blocks:
        leaves: Sequence[Leaf] = block.blocks if isinstance(block, Together) else (block,)
        for i, leaf in enumerate(leaves):
            tie = INSIDE if isinstance(leaf, StepItem) and isinstance(before, StepItem) else 0.0
            if leads:
                tie = KEPT
            elif i and not tie:
                tie = BEFORE if isinstance(leaf, Picture) and leaf.floats else KEPT
            yield PageItem(leaf, tie=tie, half=isinstance(leaf, StepItem) and leaf.parted)
            leads, before = isinstance(leaf, Heading) or (isinstance(leaf, Picture) and leaf.joined), leaf


def lines_of(beside: Beside) -> list[tuple[float, Heading | Paragraph | StepItem]]:
    """The words beside a figure, step by step, each with the gap above it (mm)."""
    gaps = [0.0, *(_gap(above, below) for above, below in pairwise(beside.blocks))]
    return list(zip(gaps, beside.blocks, strict=True))


def _narrow(picture: Picture, wide: float) -> float:
    """The width beside a figure for the words at its left."""
    return wide - picture.drawing.width - FIGURE_GAP


def _questions(piece: PageItem, wide: float) -> Iterator[Question]:
    """Every leaf and width whose size may be needed."""
    block, half = piece.block, (wide - COLUMN_GAP) / 2
    if isinstance(block, Beside):
        yield block.picture, block.picture.drawing.width
        yield replace(block.picture, floats=True), wide
        for _, line in lines_of(block):
            yield line, _narrow(block.picture, wide)
            yield line, half if isinstance(line, StepItem) else wide
        return
    yield block, half if piece.half else wide
    if isinstance(block, TableBlock) and (halved := _in_halves(block, wide)):
        yield halved


def _in_halves(table: TableBlock, wide: float) -> Question | None:
    """A table in two halves side by side, and its width; None for few rows."""
    few = len(table.rows) < HALVED * (1 + table.roomy)
    return None if few else (replace(table, halved=True), wide if table.roomy else None)


def _filled(pieces: Sequence[PageItem], wide: float, high: float, sizes: Sizes) -> list[Page]:
    """Pages of some pieces.  Where they would have much white, some figures go below their words, not beside them."""

    def filled(below: frozenset[int]) -> tuple[list[Page], float, bool]:
        ready = [fitted for i, piece in enumerate(pieces) for fitted in _fitted(piece, wide, sizes, i in below)]
        gaps = [0.0, *(_gap(before.block, after.block) for before, after in pairwise(ready))]
        placed = zip(ready, gaps, strict=True)
        return fill_pages([replace(p, gap=gap, height=_height(p, wide, sizes)) for p, gap in placed], high)

    if not pieces:
        return []
    below: frozenset[int] = frozenset()
    best, cost, gaping = filled(below)
    for i, piece in enumerate(pieces):
        if gaping and isinstance(piece.block, Beside):
            other = filled(below | {i})
            if other[1] < cost - WORTH:
                (best, cost, gaping), below = other, below | {i}
    return best


def _fitted(piece: PageItem, wide: float, sizes: Sizes, below: bool) -> Iterator[PageItem]:
    """The pieces of a piece: a table in two halves if they fit; words beside a figure down to its end and the rest
    below, or with ``below`` the figure below all words."""
    block = piece.block
    if isinstance(block, TableBlock):
        halved = _in_halves(block, wide)
        yield replace(piece, block=halved[0]) if halved and (block.roomy or sizes[halved][0] <= wide) else piece
    elif not isinstance(block, Beside):
        yield piece
    elif below:
        for i, (_, line) in enumerate(lines_of(block)):
            half = isinstance(line, StepItem)
            yield PageItem(line, tie=piece.tie if not i else INSIDE if half else 0.0, half=half)
        yield PageItem(replace(block.picture, floats=True), tie=BEFORE)
    else:
        lines, picture = lines_of(block), block.picture
        taken, count = 0.0, 0
        for i, (gap, line) in enumerate(lines):
            taken += gap + sizes[line, _narrow(picture, wide)][1]
            steps = all(isinstance(each, StepItem) for _, each in lines[max(i - 1, 0) :])
            # nothing but steps goes below the figure
            if taken > sizes[picture, picture.drawing.width][1] and len(lines) - i >= MANY_STEPS and steps:
                break
            count = i + 1
        yield replace(piece, block=replace(block, blocks=block.blocks[:count]))
        yield from (PageItem(line, tie=INSIDE, half=True) for _, line in lines[count:])


def _height(piece: PageItem, wide: float, sizes: Sizes) -> float:
    """The height of a piece (mm)."""
    block = piece.block
    if isinstance(block, Beside):
        picture = block.picture
        words = added_up(gap + sizes[line, _narrow(picture, wide)][1] for gap, line in lines_of(block))
        return max(words, sizes[picture, picture.drawing.width][1])
    if piece.fills:
        return 0.0
    alone = isinstance(block, TableBlock) and block.halved and not block.roomy
    return sizes[block, None if alone else (wide - COLUMN_GAP) / 2 if piece.half else wide][1]


def _gap(above: Leaf, below: Leaf) -> float:
    """The gap between two leaves (mm): the larger of the gap below the first and the gap above the second."""
    return max(_around(above)[1], _around(below)[0])


def _around(block: Leaf) -> tuple[float, float]:
    """The gaps above and below a leaf (mm)."""
    if isinstance(block, Heading):
        return {1: (5.8, 3.2), 2: (5.2, 2.5)}.get(block.level, (4.1, 2.2))
    if isinstance(block, StepItem):
        return 2.0, 2.0
    if isinstance(block, Fields):
        return 3.7, 4.4
    roomy = isinstance(block, Picture | Plate | Beside) or (isinstance(block, Paragraph) and block.fills)
    return (3.3, 3.3) if roomy else (2.6, 2.6)


# pages with the least white


@dataclass(frozen=True)
class _Begun:
    """A partly filled page: the numbers of its pieces, the height (mm) above the steps in two columns at its end, these
    steps, and the height of a piece that fills the page (mm)."""

    numbers: tuple[int, ...]
    base: float
    columns: tuple[int, ...] = ()
    room: float = 0.0


def balanced(heights: Sequence[float]) -> tuple[int, float]:
    """The number of steps in the left of two columns, and the height of both.

    >>> balanced([10.0, 10.0, 10.0])
    (2, 22.0)
    """
    whole = added_up(heights) + ITEMS * (len(heights) - 1)
    best, left = (len(heights), whole), -ITEMS
    for k, height in enumerate(heights, 1):
        left += height + ITEMS
        higher = max(left, whole - left - ITEMS)
        if higher <= best[1] + 1e-9:
            best = (k, higher)
    return best


def fill_pages(pieces: Sequence[PageItem], height: float) -> tuple[list[Page], float, bool]:
    """Pages of a height (mm), each with its pieces in order; the cost of their white, and whether any is visible."""

    @cache
    def onwards(at: int, waiting: int | None) -> tuple[float, tuple[_Begun, ...]]:
        """The cheapest pages from a piece on, after a waiting figure."""
        if at == len(pieces) and waiting is None:
            return 0.0, ()
        best: tuple[float, tuple[_Begun, ...]] | None = None
        for page, end, left in _begun(pieces, height, at, waiting):
            filled = _used(page, pieces) / height
            white = max(0.0, 1.0 - filled)
            cost = 0.5 + 4.0 * white**2 + 12.0 * max(0.0, white - WHITE)  # every page costs something
            if end == len(pieces) and left is None:
                cost = 0.5 + 4.0 * max(0.0, SHORT - filled) + (0.0 if page.numbers[1:] else 0.3)
            cost += pieces[end].tie if end < len(pieces) else 0.0
            cost += DEFERRED if left is not None else 0.0
            if best is not None and cost >= best[0]:
                continue
            rest, others = onwards(end, left)
            if best is None or cost + rest < best[0]:
                best = cost + rest, (page, *others)
        assert best is not None  # a page holds one piece at least
        return best

    cost, pages = onwards(0, None)
    rows = [tuple(_rows(page, pieces, height, page is pages[-1])) for page in pages]
    return rows, cost, any(_used(page, pieces) < (1.0 - WHITE) * height for page in pages[:-1])


def _begun(
    pieces: Sequence[PageItem], height: float, at: int, waiting: int | None
) -> Iterator[tuple[_Begun, int, int | None]]:
    """Every page that may begin with a piece, after a waiting figure; the piece after it, the figure waiting then."""
    empty = _Begun((), 0.0) if waiting is None else _Begun((waiting,), pieces[waiting].height)
    stack: list[tuple[_Begun, int, int | None]] = [(empty, at, None)]
    while stack:
        page, i, left = stack.pop()
        while True:
            if page.numbers and (left is None or page.numbers[-1] > left):
                yield page, i, left
            if i == len(pieces):
                break
            piece = pieces[i]
            later = left is not None and isinstance(piece.block, Picture | Beside)  # no figure overtakes another
            if page.numbers and (piece.fresh or page.room or later):
                break
            if piece.floats and piece.tie < KEPT and left is None and page.numbers:
                stack.append((page, i + 1, i))
            more = _with(page, i, pieces, height)
            if more is None:
                break
            page, i = more, i + 1


def _used(page: _Begun, pieces: Sequence[PageItem]) -> float:
    """The filled height of a page (mm)."""
    if not page.columns:
        return page.base
    gap = pieces[page.columns[0]].gap if page.base else 0.0
    return page.base + gap + balanced([pieces[n].height for n in page.columns])[1]


def _with(page: _Begun, i: int, pieces: Sequence[PageItem], height: float) -> _Begun | None:
    """A page with a further piece; None without room for it."""
    piece, used = pieces[i], _used(page, pieces)
    numbers = (*page.numbers, i)
    if piece.half:
        more = _Begun(numbers, page.base if page.columns else used, (*page.columns, i))
        return more if _used(more, pieces) <= height or not page.numbers else None
    gap = piece.gap if page.numbers else 0.0
    left = height - used - gap
    if piece.fills:
        return _Begun(numbers, used) if left < LEAST_ROOM else _Begun(numbers, height, room=left)
    end = used + gap + piece.height
    flows = isinstance(piece.block, TableBlock) and len(piece.block.rows) > MANY_ROWS and not piece.block.halved
    if end > height and flows and left > LEAST_FLOW:
        end = end % height + 10.0  # its heads stand on every page
    elif end > height and page.numbers:
        return None
    return _Begun(numbers, end)


def _rows(page: _Begun, pieces: Sequence[PageItem], height: float, last: bool) -> list[Row]:
    """The pieces of a page with their gaps, slightly wider if that fills it."""
    rows: list[Row] = []
    for half, some in groupby((pieces[n] for n in page.numbers), key=lambda piece: piece.half):
        columns = tuple(some)
        if half:
            k, _ = balanced([piece.height for piece in columns])
            rows.append(Row(columns[:k], columns[k:], columns[0].gap))
        else:
            shown = (piece for piece in columns if page.room or not piece.fills)
            rows += [Row((piece,), (), piece.gap, page.room if piece.fills else 0.0) for piece in shown]
    if rows:
        rows[0] = replace(rows[0], gap=0.0)
    heads = [row.left[0] for row in rows]
    wider = [i > 0 and head.tie < KEPT and head.gap > ITEMS + 1.0 for i, head in enumerate(heads)]
    if not last and any(wider) and not any(pieces[n].fills for n in page.numbers):
        more = max(0.0, min(MOST_MORE, (height - _used(page, pieces)) / sum(wider)))
        rows = [replace(row, gap=row.gap + more * grows) for row, grows in zip(rows, wider, strict=True)]
    return rows
