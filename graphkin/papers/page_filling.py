"""What stands on which page: pieces of known height, in their order, so that pages are filled.

Words are never parted from what they lead to; a figure that a page has no more room for may stand at the head of the
next one, while the words behind it go on.  Among all ways the one with the least white is taken, as Knuth and Plass
take lines of a paragraph (Software: Practice and Experience 11, 1981).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache

from graphkin.plane import added_up

__all__ = ["KEPT", "Filled", "Piece", "Placed", "balanced", "fill_pages"]

KEPT = 50.0  # cost of parting what belongs together: only where a page does not hold it
DEFERRED = 0.15  # of a figure overleaf, some of what follows it before it
LEAST_ROOM = 25.0  # mm to write in
LEAST_FLOW = 40.0  # mm of what is parted over pages, on the first of them
MOST_MORE = 8.0  # mm by which a gap grows where a page has white left
ITEMS = 2.0  # mm between steps
WHITE = 0.28  # of a page, above which it is seen
SHORT = 0.25  # of a last page that is worth a page


@dataclass(frozen=True)
class Piece:
    """Something that is not parted: its height and the gap above it (mm), and what a page break before it costs.

    floats : a figure that what follows may overtake
    fresh : begins a page
    fills : takes what is left of its page
    half : stands in one of two columns, with its neighbours that do
    flows : higher than a page, parted wherever one ends
    """

    height: float
    gap: float = 0.0
    tie: float = 0.0
    floats: bool = False
    fresh: bool = False
    fills: bool = False
    half: bool = False
    flows: bool = False


@dataclass(frozen=True)
class Placed:
    """Pieces by their numbers with the gap above them: one, or those of two columns side by side; ``height`` is that
    of a piece which takes what is left."""

    left: tuple[int, ...]
    right: tuple[int, ...] = ()
    gap: float = 0.0
    height: float = 0.0


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


@dataclass(frozen=True)
class Filled:
    """Pages, each with what stands on it from its head on; what their white costs, and whether some of it is seen."""

    pages: tuple[tuple[Placed, ...], ...]
    cost: float
    gaping: bool


def fill_pages(pieces: Sequence[Piece], height: float) -> Filled:
    """Pages of a height (mm)."""

    @cache
    def onwards(at: int, waiting: int | None) -> tuple[float, tuple[_Page, ...]]:
        if at == len(pieces) and waiting is None:
            return 0.0, ()
        found: tuple[float, tuple[_Page, ...]] | None = None
        for page, end, left in _pages(pieces, height, at, waiting):
            last = end == len(pieces) and left is None
            cost = _white(page.used / height, last, not page.numbers[1:])
            cost += pieces[end].tie if end < len(pieces) else 0.0
            cost += DEFERRED if left is not None else 0.0
            if found is not None and cost >= found[0]:
                continue
            rest, others = onwards(end, left)
            if found is None or cost + rest < found[0]:
                found = cost + rest, (page, *others)
        assert found is not None  # a page holds one piece at least
        return found

    cost, pages = onwards(0, None)
    told = tuple(tuple(_set(page, pieces, height, page is pages[-1])) for page in pages)
    return Filled(told, cost, any(page.used < (1.0 - WHITE) * height for page in pages[:-1]))


@dataclass(frozen=True)
class _Page:
    """The pieces of a page in their order, and the height that they take."""

    numbers: tuple[int, ...]
    used: float


def _white(filled: float, last: bool, alone: bool) -> float:
    """What the white of a page costs; every page costs something."""
    if last:
        return 0.5 + 4.0 * max(0.0, SHORT - filled) + (0.3 if alone else 0.0)
    white = max(0.0, 1.0 - filled)
    return 0.5 + 4.0 * white**2 + 12.0 * max(0.0, white - WHITE)


def _pages(
    pieces: Sequence[Piece], height: float, at: int, waiting: int | None
) -> Iterator[tuple[_Page, int, int | None]]:
    """Every page that may begin with a piece, behind a figure that waits; the piece after it, and the figure that
    waits then."""
    begun = _Run(pieces, height, () if waiting is None else (waiting,))
    stack: list[tuple[_Run, int, int | None]] = [(begun, at, None)]
    while stack:
        run, i, left = stack.pop()
        while i < len(pieces):
            piece = pieces[i]
            if run.numbers and (left is None or run.numbers[-1] > left):
                yield run.page, i, left
            if run.numbers and (piece.fresh or run.full or (left is not None and piece.floats)):
                break
            if piece.floats and piece.tie < KEPT and left is None and run.numbers:
                stack.append((run, i + 1, i))
            more = run.plus(i)
            if more is None:
                break
            run, i = more, i + 1
        else:
            if run.numbers and (left is None or run.numbers[-1] > left):
                yield run.page, i, left


@dataclass(frozen=True)
class _Run:
    """A page as far as it is filled: ``base`` up to the steps in two columns that end it."""

    pieces: Sequence[Piece]
    height: float
    numbers: tuple[int, ...]
    base: float = 0.0
    columns: tuple[int, ...] = ()
    full: bool = False

    @property
    def used(self) -> float:
        own = self.base
        if not self.columns:
            head = self.numbers[:1] if not self.base else ()
            return own + added_up(self.pieces[n].height for n in head)
        gap = self.pieces[self.columns[0]].gap if self.base else 0.0
        return own + gap + balanced([self.pieces[n].height for n in self.columns])[1]

    @property
    def page(self) -> _Page:
        return _Page(self.numbers, self.used)

    def plus(self, i: int) -> _Run | None:
        """With one more piece; None where it has no room."""
        piece, used = self.pieces[i], self.used
        numbers = (*self.numbers, i)
        if piece.half:
            columns = (*self.columns, i)
            more = replace(self, numbers=numbers, base=self.base if self.columns else used, columns=columns)
            return more if more.used <= self.height or not self.numbers else None
        gap = piece.gap if self.numbers else 0.0
        if piece.fills:
            left = self.height - used - gap
            if left < LEAST_ROOM:
                return replace(self, numbers=numbers, base=used, columns=())
            return replace(self, numbers=numbers, base=self.height, columns=(), full=True)
        end = used + gap + piece.height
        if end > self.height and piece.flows and self.height - used - gap > LEAST_FLOW:
            end = end % self.height + 10.0  # its heads stand on every page
        elif end > self.height and self.numbers:
            return None
        return replace(self, numbers=numbers, base=end, columns=())


def _set(page: _Page, pieces: Sequence[Piece], height: float, last: bool) -> list[Placed]:
    """The pieces of a page with their gaps, a little wider where that fills it."""
    placed: list[Placed] = []
    columns: list[int] = []
    for n in (*page.numbers, None):
        if n is not None and pieces[n].half:
            columns.append(n)
            continue
        if columns:
            k, _ = balanced([pieces[m].height for m in columns])
            gap = pieces[columns[0]].gap if placed else 0.0
            placed.append(Placed(tuple(columns[:k]), tuple(columns[k:]), gap))
            columns = []
        if n is not None:
            placed.append(Placed((n,), (), pieces[n].gap if placed else 0.0))
    rooms = [i for i, one in enumerate(placed) if pieces[one.left[0]].fills]
    if rooms:
        taken = _taken(placed, pieces)
        rest = height - taken
        if rest < LEAST_ROOM:
            return [one for one in placed if not pieces[one.left[0]].fills]
        placed[rooms[0]] = replace(placed[rooms[0]], height=rest)
        return placed
    heads = [pieces[one.left[0]] for one in placed]
    wider = [i > 0 and head.tie < KEPT and head.gap > ITEMS + 1.0 for i, head in enumerate(heads)]
    if not last and any(wider):
        more = max(0.0, min(MOST_MORE, (height - page.used) / sum(wider)))
        placed = [replace(one, gap=one.gap + more * own) for one, own in zip(placed, wider, strict=True)]
    return placed


def _taken(placed: Sequence[Placed], pieces: Sequence[Piece]) -> float:
    """Height of what stands on a page, without what takes the rest."""
    return added_up(
        one.gap + (balanced([pieces[n].height for n in (*one.left, *one.right)])[1] if pieces[one.left[0]].half
                   else pieces[one.left[0]].height)
        for one in placed
    )  # fmt: skip
