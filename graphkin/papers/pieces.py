"""A document as pieces on pages: what is never parted, what stands in two columns, what goes beside a figure.

Heights are those of the typesetter, which measures each piece once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from graphkin.papers.blocks import (
    Beside,
    Block,
    Document,
    Fields,
    Heading,
    Paragraph,
    Picture,
    Plate,
    Room,
    StepItem,
    Steps,
    TableBlock,
    Together,
)
from graphkin.papers.page_filling import KEPT, Filled, Piece, Placed, fill_pages
from graphkin.papers.paper import BOTTOM, SIDE, TOP
from graphkin.plane import added_up

__all__ = [
    "COLUMN_GAP", "HALVES_GAP", "MANY_ROWS", "Leaf", "Measure", "OnPage", "Pair", "Spread", "Wrapped", "pages_of",
]  # fmt: skip

COLUMN_GAP = 4.0  # mm between two columns of steps
HALVES_GAP = 12.0  # mm between the halves of a large page
FIGURE_GAP = 5.0  # mm between words and the figure beside them
HALVED = 12  # rows that are set in two halves side by side where these have room
MANY_ROWS = 30  # rows of a table that is parted where a page ends
MANY_STEPS = 2  # that leave the side of a figure for two columns below it
INSIDE = 0.08  # cost of a page break between steps
BEFORE = 0.04  # of one between steps and their figure
WORTH = 0.5  # cost that a figure below its words instead of beside them must save
LEEWAY = 0.5  # mm of a page that stay free, for rounding


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


Leaf: TypeAlias = Heading | Paragraph | Fields | StepItem | Room | Picture | Plate | TableBlock | Pair | Wrapped
Measure: TypeAlias = Callable[[Sequence[tuple[Leaf, float | None]]], Sequence[tuple[float, float]]]
"""Widths and heights (mm) of leaves at a width, or as wide as they are by themselves."""


Sizes: TypeAlias = dict[tuple[Leaf, float | None], tuple[float, float]]


@dataclass(frozen=True)
class OnPage:
    """A part of a page: leaves one below the other, at their right those of a second column; the gap above them, and
    the height of one that takes what a page has left (mm)."""

    left: tuple[Leaf, ...]
    right: tuple[Leaf, ...] = ()
    gap: float = 0.0
    height: float = 0.0


@dataclass(frozen=True)
class _Item:
    block: Leaf | Beside
    tie: float = 0.0
    half: bool = False
    fresh: bool = False


@dataclass(frozen=True)
class Spread:
    """Two halves of a page side by side."""

    left: tuple[OnPage, ...]
    right: tuple[OnPage, ...] = ()


def pages_of(document: Document, measure: Measure) -> list[Spread]:
    """The pages of a document; what stands before its first fresh heading in two halves where it is ``folded``."""
    wide, high = document.paper.width - 2 * SIDE, document.paper.height - TOP - BOTTOM - LEEWAY
    items = list(_items(document.blocks))
    half = (wide - HALVES_GAP) / 2
    end = next((i for i, item in enumerate(items) if item.fresh), len(items)) if document.folded else 0
    folded, whole = items[:end], items[end:]
    asked = [*_asked(folded, half), *_asked(whole, wide)]
    sizes = dict(zip(dict.fromkeys(asked), measure(tuple(dict.fromkeys(asked))), strict=True))
    halves = _filled(folded, half, high, sizes)
    spreads = [Spread(*halves[i : i + 2]) for i in range(0, len(halves), 2)]
    return spreads + [Spread(page) for page in _filled(whole, wide, high, sizes)]


def _asked(items: Sequence[_Item], wide: float) -> list[tuple[Leaf, float | None]]:
    return [question for item in items for question in _questions(item, wide)]


def _filled(items: Sequence[_Item], wide: float, high: float, sizes: Sizes) -> list[tuple[OnPage, ...]]:
    """Pages of some items.  A figure beside its words keeps much together: where pages gape, some go below them."""
    if not items:
        return []

    def filled(below: frozenset[int]) -> tuple[Filled, list[_Item]]:
        ready = [one for i, item in enumerate(items) for one in _fitted(item, wide, sizes, i in below)]
        pieces = [_piece(before, item, wide, sizes) for before, item in zip((None, *ready), ready, strict=False)]
        return fill_pages(pieces, high), ready

    below: frozenset[int] = frozenset()
    best, ready = filled(below)
    for i, item in enumerate(items):
        if best.gaping and isinstance(item.block, Beside):
            other, others = filled(below | {i})
            if other.cost < best.cost - WORTH:
                best, ready, below = other, others, below | {i}
    return [tuple(_on_page(placed, ready) for placed in page) for page in best.pages]


def _on_page(placed: Placed, items: Sequence[_Item]) -> OnPage:
    left, right = (tuple(_leaf(items[n]) for n in side) for side in (placed.left, placed.right))
    return OnPage(left, right, placed.gap, placed.height)


def _leaf(item: _Item) -> Leaf:
    assert not isinstance(item.block, Beside)  # wrapped
    return item.block


def _items(blocks: Iterable[Block]) -> Iterator[_Item]:
    """Leaf by leaf, and what it costs to part it from the one before."""
    before: _Item | None = None
    for block in blocks:
        for i, item in enumerate(_parts(block)):
            kept = i > 0 and isinstance(block, Together) and item.tie == 0.0
            led = before is not None and _leads(before.block, item.block)
            before = replace(item, tie=KEPT) if kept or led else item
            yield before


def _parts(block: Block) -> Iterator[_Item]:
    if isinstance(block, Together):
        for i, one in enumerate(block.blocks):
            for k, item in enumerate(_parts(one)):
                keeps = (i or k) and item.tie == 0.0
                yield replace(item, tie=BEFORE if item.block == one and _floats(one) else KEPT) if keeps else item
    elif isinstance(block, Steps):
        for i, step in enumerate(block.items):
            yield _Item(step, INSIDE if i else 0.0, half=block.parted)
    else:
        yield _Item(block, fresh=isinstance(block, Heading) and block.fresh)


def _floats(block: object) -> bool:
    return isinstance(block, Picture) and block.floats


def _leads(one: Leaf | Beside, other: Leaf | Beside) -> bool:
    """Whether words or an equation lead to what follows them."""
    if isinstance(one, Heading):
        return True
    return isinstance(one, Picture) and one.joined


def _questions(item: _Item, wide: float) -> Iterator[tuple[Leaf, float | None]]:
    block = item.block
    if isinstance(block, Beside):
        yield block.picture, block.picture.drawing.width
        yield replace(block.picture, floats=True), wide
        for one in _lines(block):
            yield one, wide - block.picture.drawing.width - FIGURE_GAP
            yield one, (wide - COLUMN_GAP) / 2 if isinstance(one, StepItem) else wide
        return
    yield block, (wide - COLUMN_GAP) / 2 if item.half else wide
    if isinstance(block, TableBlock) and _may_halve(block):
        yield Pair(*_halves(block)), wide if block.roomy else None


def _may_halve(table: TableBlock) -> bool:
    return len(table.rows) >= (2 * HALVED if table.roomy else HALVED)


def _halves(table: TableBlock) -> tuple[TableBlock, TableBlock]:
    k = (len(table.rows) + 1) // 2
    right = frozenset(i - k for i in table.bold if i >= k)
    return (
        replace(table, rows=table.rows[:k], bold=frozenset(i for i in table.bold if i < k)),
        replace(table, rows=table.rows[k:], bold=right),
    )


def _lines(beside: Beside) -> Iterator[Heading | Paragraph | StepItem]:
    for one in beside.blocks:
        if isinstance(one, Steps):
            yield from one.items
        else:
            yield one


def _high(picture: Picture, sizes: Sizes) -> float:
    """The height of a figure with words at its left, its caption as wide as itself."""
    return sizes[picture, picture.drawing.width][1]


def _fitted(item: _Item, wide: float, sizes: Sizes, below: bool) -> Iterator[_Item]:
    """A table in two halves where they have room; words beside a figure as far as it reaches and the rest below, or
    with ``below`` the figure below them all."""
    block = item.block
    if isinstance(block, TableBlock) and _may_halve(block):
        pair = Pair(*_halves(block))
        if block.roomy or sizes[pair, None][0] <= wide:
            yield replace(item, block=pair)
            return
    if not isinstance(block, Beside):
        yield item
        return
    if below:
        for i, one in enumerate(_lines(block)):
            half = isinstance(one, StepItem)
            yield _Item(one, INSIDE if i and half else item.tie if not i else 0.0, half)
        yield _Item(replace(block.picture, floats=True), BEFORE)
        return
    narrow = wide - block.picture.drawing.width - FIGURE_GAP
    high, taken, lines = _high(block.picture, sizes), 0.0, list(_lines(block))
    beside: list[tuple[float, Heading | Paragraph | StepItem]] = []
    for i, one in enumerate(lines):
        gap = _gap(lines[i - 1], one) if i else 0.0
        rest = lines[i:]
        if (
            taken + gap + sizes[one, narrow][1] > high
            and len(rest) >= MANY_STEPS
            and all(isinstance(each, StepItem) for each in lines[max(i - 1, 0) :])
        ):
            break
        beside.append((gap, one))
        taken += gap + sizes[one, narrow][1]
    yield replace(item, block=Wrapped(tuple(beside), block.picture))
    for one in lines[len(beside) :]:
        yield _Item(one, INSIDE, half=True)


def _piece(before: _Item | None, item: _Item, wide: float, sizes: Sizes) -> Piece:
    block = item.block
    gap = _gap(before.block, block) if before is not None else 0.0
    if isinstance(block, Wrapped):
        narrow = wide - block.picture.drawing.width - FIGURE_GAP
        words = added_up(gap + sizes[one, narrow][1] for gap, one in block.blocks)
        height = max(words, _high(block.picture, sizes))
    elif isinstance(block, Pair):
        height = sizes[block, wide if block.left.roomy else None][1]
    elif isinstance(block, Room):
        return Piece(0.0, gap, item.tie, fills=True)
    else:
        assert not isinstance(block, Beside)  # wrapped
        height = sizes[block, (wide - COLUMN_GAP) / 2 if item.half else wide][1]
    flows = isinstance(block, TableBlock) and len(block.rows) > MANY_ROWS
    return Piece(height, gap, item.tie, _floats(block), item.fresh, half=item.half, flows=flows)


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
    if isinstance(block, Picture | Plate | Room):
        return 3.3, 3.3
    return (3.3, 3.3) if isinstance(block, Wrapped | Beside) else (2.6, 2.6)
