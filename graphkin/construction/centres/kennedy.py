"""Kennedy's theorem as a search: which two lines give the next centre is found, not programmed.

Three links have their three centres on one line (Aronhold 1872, Kennedy 1886; Norton, Design of Machinery, 6.4).  On
the circle diagram the links are points and each known centre is a line between two of them; a missing line that is the
side of two closed triangles is a centre that can be found.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from heapq import heappop, heappush

from graphkin.construction.centres.pairs import Line, LinkPair, Normal, Place, wedge

__all__ = ["ROUNDING", "CentreRelation", "CrossedCentre", "Known", "Search", "closure"]

ROUNDING = 2e-16
SURE = 1e-10
"""A crossing whose place may err by more than this (of the mechanism's size) is not taken."""
MOST_LINES = 24  # for one centre; a mechanism of many links has hundreds, and a few of them cross well
TOGETHER = 1e-9  # two centres nearer to each other (on the unit sphere) give no line


@dataclass(frozen=True)
class Known:
    """A centre already found: its place, and how far it may err on the unit sphere."""

    place: Place
    error: float = ROUNDING


@dataclass(frozen=True)
class CentreRelation:
    """A line on which a centre lies: through two centres with a third link, or the common normal of a pin in a slot.

    ``via`` is the third link ("" for a normal); ``through`` names the two centres, or the pin in slot.
    """

    pair: LinkPair
    line: Line
    error: float
    via: str
    through: tuple[LinkPair, LinkPair] | tuple[str]


@dataclass(frozen=True)
class CrossedCentre:
    """A centre found where two lines cross; ``sine`` of their angle on the sphere, ``error`` of the place."""

    pair: LinkPair
    place: Place
    lines: tuple[CentreRelation, CentreRelation]
    sine: float
    error: float


class Search:
    """The circle diagram as it fills: centres known, lines known for each missing one, the best crossing of each."""

    def __init__(self, pairs: Sequence[LinkPair], names: Sequence[str], normals: Sequence[Normal]) -> None:
        self.pairs, self.names, self.known = pairs, names, dict[LinkPair, Known]()
        self.lines: dict[LinkPair, list[CentreRelation]] = {pair: [] for pair in pairs}
        self.best: dict[LinkPair, CrossedCentre] = {}
        self._place = {pair: i for i, pair in enumerate(pairs)}
        self._ranked: list[tuple[int, int]] = []  # powers of ten of the errors, with the place of the pair: a heap
        self._bit = {name: 1 << i for i, name in enumerate(names)}
        # for each link a bit for every other whose centre with it is known, and for every one that needs no more lines
        self._joined, self._full = dict.fromkeys(names, 0), dict.fromkeys(names, 0)
        self._as_written = {(a, b): pair for pair in pairs for a, b in (pair, pair[::-1])}
        for normal in normals:
            self._add(CentreRelation(normal.pair, normal.line, ROUNDING, "", (normal.key,)))

    def learn(self, pair: LinkPair, known: Known) -> None:
        """Take in a centre, and with it all lines that it completes."""
        self.known[pair] = known
        for a, b in (pair, pair[::-1]):
            self._joined[a] |= self._bit[b]
        for a, b in (pair, pair[::-1]):
            # the triangle a, b, via: the side from a to via is missing, b is its third link
            wanted = self._joined[b] & ~(self._joined[a] | self._full[a] | self._bit[a])
            while wanted:
                first = wanted & -wanted
                wanted ^= first
                via = self.names[first.bit_length() - 1]
                self._relate(self._as_written[a, via], b, pair, self._as_written[b, via])

    def next(self) -> CrossedCentre | None:
        """The missing centre that is found best: the least error to be expected, counted in powers of ten, and among
        those the first in the order of the links.  None where no two lines cross so well that the place errs by no
        more than ``SURE`` (on the unit sphere)."""
        while self._ranked:
            pair = self.pairs[self._ranked[0][1]]
            if pair in self.known:
                heappop(self._ranked)
            else:
                return self.best[pair]
        return None

    def _relate(self, missing: LinkPair, via: str, one: LinkPair, two: LinkPair) -> None:
        a, b = self.known[one], self.known[two]
        line, sine = wedge(a.place, b.place)
        if sine > TOGETHER:
            if missing[0] not in one:
                one, two = two, one
            self._add(CentreRelation(missing, line, (a.error + b.error + ROUNDING) / sine, via, (one, two)))

    def _add(self, relation: CentreRelation) -> None:
        pair, lines = relation.pair, self.lines[relation.pair]
        if len(lines) == MOST_LINES:
            return
        for other in lines:
            error = other.error + relation.error + ROUNDING
            if pair in self.best and error >= self.best[pair].error:
                continue  # however well they cross
            place, sine = wedge(other.line, relation.line)
            if sine == 0.0 or (pair in self.best and error / sine >= self.best[pair].error):
                continue
            if place[2] < 0.0:
                place = -place[0], -place[1], -place[2]
            self.best[pair] = CrossedCentre(pair, place, (other, relation), sine, error / sine)
            if error / sine <= SURE:
                heappush(self._ranked, (math.ceil(math.log10(error / sine)), self._place[pair]))
        lines.append(relation)
        if len(lines) == MOST_LINES:
            for a, b in (pair, pair[::-1]):
                self._full[a] |= self._bit[b]


def closure(
    pairs: Sequence[LinkPair], names: Sequence[str], known: set[LinkPair], slots: Sequence[LinkPair]
) -> set[LinkPair]:
    """The centres that two closed triangles of the circle diagram can give, one after the other, lines never falling
    together.  ``slots`` are pairs with a common normal: one line each."""
    place = {name: i for i, name in enumerate(names)}
    slotted = Counter(slots)
    joined = [0] * len(names)  # for each link, a bit for every other whose centre with it is known

    def join(pair: LinkPair) -> None:
        a, b = place[pair[0]], place[pair[1]]
        joined[a] |= 1 << b
        joined[b] |= 1 << a

    have = set(known)
    for pair in have:
        join(pair)
    left = [pair for pair in pairs if pair not in have]
    grown = True
    while grown:
        grown = False
        missing = []
        for pair in left:
            triangles = (joined[place[pair[0]]] & joined[place[pair[1]]]).bit_count()
            if slotted[pair] + triangles >= 2:
                have.add(pair)
                join(pair)
                grown = True
            else:
                missing.append(pair)
        left = missing
    return {pair for pair in pairs if pair in have}
