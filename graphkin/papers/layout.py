"""A document as pieces on pages: what is never parted, what stands in two columns, what goes beside a figure.

Heights are those of the typesetter, which measures each piece once.  Words are never parted from what they lead to; a
figure that a page has no more room for may stand at the head of the next one, while the words behind it go on.  Among
all ways the one with the least white is taken, as Knuth and Plass take lines of a paragraph (Software: Practice and
Experience 11, 1981).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import NamedTuple, TypeAlias

from graphkin.papers.blocks import (
    Beside,
    Block,
    Document,
    Fields,
    Heading,
    Paragraph,
    Picture,
    Plate,
    StepItem,
    Steps,
    TableBlock,
    Together,
)  # fmt: skip
from graphkin.papers.paper import BOTTOM, SIDE, TOP
from graphkin.plane import added_up

__all__ = [
    "COLUMN_GAP", "HALVES_GAP", "KEPT", "MANY_ROWS", "Leaf", "Measure", "Pair", "Piece", "Row", "Wrapped", "balanced",
    "fill_pages", "pages_of",
]  # fmt: skip

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
DEFERRED = 0.15  # of a figure overleaf, some of what follows it before it
WORTH = 0.5  # that a figure below its words instead of beside them must save


@dataclass(frozen=True)
class Pair:
    """Two halves of a table side by side."""

    left: TableBlock
    right: TableBlock


@dataclass(frozen=True)
class Wrapped:
    """What stands at the left of a figure, each with the gap above it (mm)."""

    blocks: tuple[tuple[float, Heading | Paragraph | StepItem], ...]
    picture: Picture


Leaf: TypeAlias = Heading | Paragraph | Fields | StepItem | Picture | Plate | TableBlock | Pair | Wrapped
Measure: TypeAlias = Callable[[Sequence[tuple[Leaf, float | None]]], Sequence[tuple[float, float]]]
"""Widths and heights (mm) of leaves at a width, or as wide as they are by themselves."""
Sizes: TypeAlias = dict[tuple[Leaf, float | None], tuple[float, float]]


@dataclass(frozen=True)
class Piece:
    """Something that is not parted: its height and the gap above it (mm), and what a page break before it costs.

    floats : a figure that what follows may overtake
    fresh : begins a page
    fills : takes what is left of its page
    half : stands in one of two columns, with its neighbours that do
    flows : higher than a page, parted wherever one ends
    block : what it shows
    """

    height: float = 0.0
    gap: float = 0.0
    tie: float = 0.0
    floats: bool = False
    fresh: bool = False
    fills: bool = False
    half: bool = False
    flows: bool = False
    block: Leaf | Beside | None = None


@dataclass(frozen=True)
class Row:
    """A part of a page: a piece, or those of two columns side by side; the gap above them, and the ``height`` of a
    piece that takes what a page has left (mm)."""

    left: tuple[Piece, ...]
    right: tuple[Piece, ...] = ()
    gap: float = 0.0
    height: float = 0.0

    @property
    def taken(self) -> float:
        """What it takes of the height of its page (mm), but for what takes the rest."""
        head = self.left[0]
        both = (*self.left, *self.right)
        return self.gap + (balanced([piece.height for piece in both])[1] if head.half else head.height)


Page: TypeAlias = tuple[Row, ...]


def pages_of(document: Document, measure: Measure) -> list[tuple[Page, ...]]:
    """The pages of a document; what stands before its first fresh heading in two halves where it is ``folded``."""
    wide, high = document.paper.width - 2 * SIDE, document.paper.height - TOP - BOTTOM - LEEWAY
    pieces = list(_pieces(document.blocks))
    half = (wide - HALVES_GAP) / 2
    end = next((i for i, piece in enumerate(pieces) if piece.fresh), len(pieces)) if document.folded else 0
    folded, whole = pieces[:end], pieces[end:]
    asked = tuple(dict.fromkeys(
        question for some, width in ((folded, half), (whole, wide)) for piece in some
        for question in _questions(piece, width)
    ))  # fmt: skip
    sizes = dict(zip(asked, measure(asked), strict=True))
    halves = _filled(folded, half, high, sizes)
    return [tuple(halves[i : i + 2]) for i in range(0, len(halves), 2)] + [
        (page,) for page in _filled(whole, wide, high, sizes)
    ]


# -- from blocks to pieces of known height -----------------------------------------------------------------------------


def _pieces(blocks: Iterable[Block]) -> Iterator[Piece]:
    """Leaf by leaf, and what it costs to part it from the one before."""
    before: Piece | None = None
    for block in blocks:
        for i, piece in enumerate(_parts(block)):
            kept = i > 0 and isinstance(block, Together) and piece.tie == 0.0
            before = replace(piece, tie=KEPT) if kept or (before is not None and _leads(before.block)) else piece
            yield before


def _parts(block: Block) -> Iterator[Piece]:
    if isinstance(block, Together):
        for i, one in enumerate(block.blocks):
            for k, piece in enumerate(_parts(one)):
                keeps = (i or k) and piece.tie == 0.0
                yield replace(piece, tie=BEFORE if piece.block == one and _floats(one) else KEPT) if keeps else piece
    elif isinstance(block, Steps):
        for i, step in enumerate(block.items):
            yield Piece(tie=INSIDE if i else 0.0, half=block.parted, block=step)
    else:
        yield Piece(fresh=isinstance(block, Heading) and block.fresh, block=block)


def _floats(block: object) -> bool:
    return isinstance(block, Picture) and block.floats


def _leads(block: Leaf | Beside | None) -> bool:
    """Whether words or an equation lead to what follows them."""
    return isinstance(block, Heading) or (isinstance(block, Picture) and block.joined)


def _width(piece: Piece, wide: float) -> float:
    return (wide - COLUMN_GAP) / 2 if piece.half else wide


def _narrow(picture: Picture, wide: float) -> float:
    """What a figure leaves of a width for the words at its left."""
    return wide - picture.drawing.width - FIGURE_GAP


def _questions(piece: Piece, wide: float) -> Iterator[tuple[Leaf, float | None]]:
    """Every leaf and width of which the size may be wanted."""
    block = piece.block
    assert block is not None
    if isinstance(block, Beside):
        yield block.picture, block.picture.drawing.width
        yield replace(block.picture, floats=True), wide
        for one in _lines(block):
            yield one, _narrow(block.picture, wide)
            yield one, (wide - COLUMN_GAP) / 2 if isinstance(one, StepItem) else wide
        return
    yield block, _width(piece, wide)
    if isinstance(block, TableBlock) and _may_halve(block):
        yield _halves(block), wide if block.roomy else None


def _may_halve(table: TableBlock) -> bool:
    return len(table.rows) >= (2 * HALVED if table.roomy else HALVED)


def _halves(table: TableBlock) -> Pair:
    k = (len(table.rows) + 1) // 2
    left, right = (frozenset(i for i in table.bold if i < k), frozenset(i - k for i in table.bold if i >= k))
    return Pair(replace(table, rows=table.rows[:k], bold=left), replace(table, rows=table.rows[k:], bold=right))


def _lines(beside: Beside) -> Iterator[Heading | Paragraph | StepItem]:
    for one in beside.blocks:
        if isinstance(one, Steps):
            yield from one.items
        else:
            yield one


def _filled(pieces: Sequence[Piece], wide: float, high: float, sizes: Sizes) -> list[Page]:
    """Pages of some pieces.  A figure beside its words keeps much together: where pages gape, some go below them."""

    def filled(below: frozenset[int]) -> Filled:
        ready = [one for i, piece in enumerate(pieces) for one in _fitted(piece, wide, sizes, i in below)]
        pairs = zip((None, *ready), ready, strict=False)
        return fill_pages([_sized(before, one, wide, sizes) for before, one in pairs], high)

    if not pieces:
        return []
    below: frozenset[int] = frozenset()
    best = filled(below)
    for i, piece in enumerate(pieces):
        if best.gaping and isinstance(piece.block, Beside):
            other = filled(below | {i})
            if other.cost < best.cost - WORTH:
                best, below = other, below | {i}
    return best.pages


def _fitted(piece: Piece, wide: float, sizes: Sizes, below: bool) -> Iterator[Piece]:
    """A table in two halves where they have room; words beside a figure as far as it reaches and the rest below, or
    with ``below`` the figure below them all."""
    block = piece.block
    if isinstance(block, TableBlock) and _may_halve(block):
        pair = _halves(block)
        fits = block.roomy or sizes[pair, None][0] <= wide
        yield replace(piece, block=pair) if fits else piece
    elif not isinstance(block, Beside):
        yield piece
    elif below:
        for i, one in enumerate(_lines(block)):
            half = isinstance(one, StepItem)
            yield Piece(tie=INSIDE if i and half else piece.tie if not i else 0.0, half=half, block=one)
        yield Piece(tie=BEFORE, block=replace(block.picture, floats=True))
    else:
        beside = _beside(block, wide, sizes)
        yield replace(piece, block=Wrapped(beside, block.picture))
        for one in list(_lines(block))[len(beside) :]:
            yield Piece(tie=INSIDE, half=True, block=one)


def _beside(block: Beside, wide: float, sizes: Sizes) -> tuple[tuple[float, Heading | Paragraph | StepItem], ...]:
    """The lines that stand beside a figure, each with the gap above it: all, unless nothing but steps goes below it."""
    lines, narrow = list(_lines(block)), _narrow(block.picture, wide)
    taken = 0.0
    beside: list[tuple[float, Heading | Paragraph | StepItem]] = []
    for i, one in enumerate(lines):
        gap = _gap(lines[i - 1], one) if i else 0.0
        taken += gap + sizes[one, narrow][1]
        steps = all(isinstance(each, StepItem) for each in lines[max(i - 1, 0) :])
        if taken > _high(block.picture, sizes) and len(lines) - i >= MANY_STEPS and steps:
            break
        beside.append((gap, one))
    return tuple(beside)


def _high(picture: Picture, sizes: Sizes) -> float:
    """The height of a figure with words at its left, its caption as wide as itself."""
    return sizes[picture, picture.drawing.width][1]


def _sized(before: Piece | None, piece: Piece, wide: float, sizes: Sizes) -> Piece:
    """A piece with its height and the gap above it."""
    block = piece.block
    assert block is not None
    gap = _gap(before.block, block) if before is not None and before.block is not None else 0.0
    if isinstance(block, Wrapped):
        narrow = _narrow(block.picture, wide)
        words = added_up(gap + sizes[one, narrow][1] for gap, one in block.blocks)
        height = max(words, _high(block.picture, sizes))
    elif isinstance(block, Pair):
        height = sizes[block, wide if block.left.roomy else None][1]
    elif isinstance(block, Paragraph) and block.fills:
        return Piece(0.0, gap, piece.tie, fills=True, block=block)
    else:
        assert not isinstance(block, Beside)  # wrapped
        height = sizes[block, _width(piece, wide)][1]
    flows = isinstance(block, TableBlock) and len(block.rows) > MANY_ROWS
    return replace(piece, height=height, gap=gap, floats=_floats(block), flows=flows)


def _gap(above: Leaf | Beside, below: Leaf | Beside) -> float:
    """The gap between two leaves: what the one asks for below it, or the other above."""
    return max(_around(above)[1], _around(below)[0])


def _around(block: Leaf | Beside) -> tuple[float, float]:
    """What a leaf asks for above and below it (mm)."""
    if isinstance(block, Heading):
        return {1: (5.8, 3.2), 2: (5.2, 2.5)}.get(block.level, (4.1, 2.2))
    if isinstance(block, StepItem):
        return 2.0, 2.0
    if isinstance(block, Fields):
        return 3.7, 4.4
    roomy = isinstance(block, Picture | Plate | Wrapped | Beside) or (isinstance(block, Paragraph) and block.fills)
    return (3.3, 3.3) if roomy else (2.6, 2.6)


# -- pages with the least white ----------------------------------------------------------------------------------------


class Filled(NamedTuple):
    """Pages, each with what stands on it from its head on; what their white costs, and whether some of it is seen."""

    pages: list[Page]
    cost: float
    gaping: bool


class _Begun(NamedTuple):
    """A page as far as it is filled: the numbers of its pieces, the height up to the steps in two columns that end it
    (mm), and these."""

    numbers: tuple[int, ...]
    base: float
    columns: tuple[int, ...] = ()
    full: bool = False


def balanced(heights: Sequence[float]) -> tuple[int, float]:
    """How many of some steps stand in the left one of two columns, and the height of both.

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


def fill_pages(pieces: Sequence[Piece], height: float) -> Filled:
    """Pages of a height (mm)."""

    @cache
    def onwards(at: int, waiting: int | None) -> tuple[float, tuple[_Begun, ...]]:
        if at == len(pieces) and waiting is None:
            return 0.0, ()
        best: tuple[float, tuple[_Begun, ...]] | None = None
        for page, end, left in _begun(pieces, height, at, waiting):
            last = end == len(pieces) and left is None
            cost = _white(_used(page, pieces) / height, last, not page.numbers[1:])
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
    return Filled(rows, cost, any(_used(page, pieces) < (1.0 - WHITE) * height for page in pages[:-1]))


def _white(filled: float, last: bool, alone: bool) -> float:
    """What the white of a page costs; every page costs something."""
    if last:
        return 0.5 + 4.0 * max(0.0, SHORT - filled) + (0.3 if alone else 0.0)
    white = max(0.0, 1.0 - filled)
    return 0.5 + 4.0 * white**2 + 12.0 * max(0.0, white - WHITE)


def _begun(
    pieces: Sequence[Piece], height: float, at: int, waiting: int | None
) -> Iterator[tuple[_Begun, int, int | None]]:
    """Every page that may begin with a piece, behind a figure that waits; the piece after it, and the figure that
    waits then."""
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
            if page.numbers and (piece.fresh or page.full or (left is not None and piece.floats)):
                break
            if piece.floats and piece.tie < KEPT and left is None and page.numbers:
                stack.append((page, i + 1, i))
            more = _with(page, i, pieces, height)
            if more is None:
                break
            page, i = more, i + 1


def _used(page: _Begun, pieces: Sequence[Piece]) -> float:
    """The height that a page has taken (mm)."""
    if not page.columns:
        return page.base
    gap = pieces[page.columns[0]].gap if page.base else 0.0
    return page.base + gap + balanced([pieces[n].height for n in page.columns])[1]


def _with(page: _Begun, i: int, pieces: Sequence[Piece], height: float) -> _Begun | None:
    """A page with one more piece; None where it has no room."""
    piece, used = pieces[i], _used(page, pieces)
    numbers = (*page.numbers, i)
    if piece.half:
        more = _Begun(numbers, page.base if page.columns else used, (*page.columns, i))
        return more if _used(more, pieces) <= height or not page.numbers else None
    gap = piece.gap if page.numbers else 0.0
    left = height - used - gap
    if piece.fills:
        return _Begun(numbers, used) if left < LEAST_ROOM else _Begun(numbers, height, full=True)
    end = used + gap + piece.height
    if end > height and piece.flows and left > LEAST_FLOW:
        end = end % height + 10.0  # its heads stand on every page
    elif end > height and page.numbers:
        return None
    return _Begun(numbers, end)


def _rows(page: _Begun, pieces: Sequence[Piece], height: float, last: bool) -> list[Row]:
    """The pieces of a page with their gaps, a little wider where that fills it."""
    rows: list[Row] = []
    columns: list[Piece] = []
    for piece in (*(pieces[n] for n in page.numbers), None):
        if piece is not None and piece.half:
            columns.append(piece)
            continue
        if columns:
            k, _ = balanced([one.height for one in columns])
            rows.append(Row(tuple(columns[:k]), tuple(columns[k:]), columns[0].gap if rows else 0.0))
            columns = []
        if piece is not None:
            rows.append(Row((piece,), (), piece.gap if rows else 0.0))
    room = next((i for i, row in enumerate(rows) if row.left[0].fills), None)
    if room is not None:
        rest = height - added_up(row.taken for row in rows)
        if rest < LEAST_ROOM:
            return [row for row in rows if not row.left[0].fills]
        rows[room] = replace(rows[room], height=rest)
        return rows
    heads = [row.left[0] for row in rows]
    wider = [i > 0 and head.tie < KEPT and head.gap > ITEMS + 1.0 for i, head in enumerate(heads)]
    if not last and any(wider):
        more = max(0.0, min(MOST_MORE, (height - _used(page, pieces)) / sum(wider)))
        rows = [replace(row, gap=row.gap + more * grows) for row, grows in zip(rows, wider, strict=True)]
    return rows
