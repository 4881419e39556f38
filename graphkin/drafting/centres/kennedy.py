"""Kennedy's theorem as a search: which two lines give the next centre is found, not programmed.

Three links have their three centres on one line (Aronhold 1872, Kennedy 1886; Norton, Design of Machinery, 6.4).  On
the circle diagram the links are points and each known centre is a line between two of them; a missing line that is the
side of two closed triangles is a centre that can be found.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from graphkin.drafting.centres.chart import Line, Place, wedge
from graphkin.drafting.centres.pairs import Normal, Pair

__all__ = ["SURE", "Crossing", "Known", "Relation", "Search", "closure"]

ROUNDING = 2e-16
SURE = 1e-10
"""A crossing whose place may err by more than this (of the mechanism's size) is not taken."""
TOGETHER = 1e-9  # two centres nearer to each other (on the unit sphere) give no line


@dataclass(frozen=True)
class Known:
    """A centre already found: its place, and how far it may err on the unit sphere."""

    place: Place
    error: float = ROUNDING


@dataclass(frozen=True)
class Relation:
    """A line on which a centre lies: through two centres with a third link, or the common normal of a pin in a slot.

    ``via`` is the third link ("" for a normal); ``through`` names the two centres, or the pin in slot.
    """

    pair: Pair
    line: Line
    error: float
    via: str
    through: tuple[Pair, Pair] | tuple[str]


@dataclass(frozen=True)
class Crossing:
    """A centre found where two lines cross; ``sine`` of their angle on the sphere, ``error`` of the place."""

    pair: Pair
    place: Place
    lines: tuple[Relation, Relation]
    sine: float
    error: float


class Search:
    """The circle diagram as it fills: centres known, lines known for each missing one, the best crossing of each."""

    def __init__(self, pairs: Sequence[Pair], names: Sequence[str], normals: Sequence[Normal]) -> None:
        self.pairs, self.names, self.known = pairs, names, dict[Pair, Known]()
        self.lines: dict[Pair, list[Relation]] = {pair: [] for pair in pairs}
        self.best: dict[Pair, Crossing] = {}
        self._as_written = {frozenset(pair): pair for pair in pairs}
        for normal in normals:
            self._add(Relation(normal.pair, normal.line, ROUNDING, "", (normal.key,)))

    def learn(self, pair: Pair, known: Known) -> None:
        """Take in a centre, and with it all lines that it completes."""
        self.known[pair] = known
        for a, b in (pair, pair[::-1]):
            for via in self.names:
                # the triangle a, b, via: the side from a to via is missing, b is its third link
                if via in pair:
                    continue
                side, missing = self._as_written[frozenset((b, via))], self._as_written[frozenset((a, via))]
                if side in self.known and missing not in self.known:
                    self._relate(missing, b, pair, side)

    def next(self, least: float = SURE) -> Crossing | None:
        """The missing centre that is found best: the least error to be expected, counted in powers of ten, and among
        those the first in the order of the links.  None where no two lines cross so well that the place errs by no
        more than ``least`` (on the unit sphere)."""
        ranked = [
            (math.ceil(math.log10(self.best[pair].error)), i)
            for i, pair in enumerate(self.pairs)
            if pair in self.best and pair not in self.known and self.best[pair].error <= least
        ]
        return self.best[self.pairs[min(ranked)[1]]] if ranked else None

    def _relate(self, missing: Pair, via: str, one: Pair, two: Pair) -> None:
        a, b = self.known[one], self.known[two]
        line, sine = wedge(a.place, b.place)
        if sine > TOGETHER:
            if missing[0] not in one:
                one, two = two, one
            self._add(Relation(missing, line, (a.error + b.error + ROUNDING) / sine, via, (one, two)))

    def _add(self, relation: Relation) -> None:
        pair = relation.pair
        for other in self.lines[pair]:
            crossing = _cross(other, relation)
            if crossing and (pair not in self.best or crossing.error < self.best[pair].error):
                self.best[pair] = crossing
        self.lines[pair].append(relation)


def _cross(a: Relation, b: Relation) -> Crossing | None:
    place, sine = wedge(a.line, b.line)
    if sine == 0.0:
        return None
    if place[2] < 0.0:
        place = -place[0], -place[1], -place[2]
    return Crossing(a.pair, place, (a, b), sine, (a.error + b.error + ROUNDING) / sine)


def closure(pairs: Sequence[Pair], names: Sequence[str], known: set[Pair], slots: Sequence[Pair]) -> set[Pair]:
    """The centres that two closed triangles of the circle diagram can give, one after the other, lines never falling
    together.  ``slots`` are pairs with a common normal: one line each."""
    have = {frozenset(p) for p in known}
    grown = True
    while grown:
        grown = False
        for pair in pairs:
            if frozenset(pair) in have:
                continue
            count = sum(p == pair for p in slots)
            count += sum(
                frozenset((pair[0], via)) in have and frozenset((via, pair[1])) in have
                for via in names if via not in pair
            )  # fmt: skip
            if count >= 2:
                have.add(frozenset(pair))
                grown = True
    return {p for p in pairs if frozenset(p) in have}
