"""Special points of two moving links that legs join, as in groups of class IV.

Each leg leaves the one link free along one direction as seen from the other; where the lines square to these cross, the
points of both links that lie there move alike: the centre of their relative motion.  What their accelerations differ by
a polygon of its own gives, and then both links are drawn as if hinged there (Assur's points, taken relative to a moving
link; Artobolevsky, Theory of mechanisms).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from graphkin.construction.net import Edge, Net
from graphkin.plane import cross, cross_lines, unit
from graphkin.scene.symbol import PointRef

__all__ = ["FarPoint", "RelativePoint", "RelativePoints"]

LONGEST = 3  # edges of a leg
OFF = 1e-9  # sine between a leg's line and the way from joint to joint, below which it is that way
WORST = 0.05  # crossing and distance of a point that is still taken

Path = tuple[Edge, ...]


@dataclass(frozen=True)
class RelativePoint:
    """Where the special point of the second link relative to the first lies, and the legs from the one to the other."""

    links: tuple[str, str]
    at: complex
    legs: tuple[Path, Path]


@dataclass(frozen=True)
class FarPoint:
    """Two links whose special point cannot be used: how far from the joints (m; in a net as its places), and at which
    angle (rad) the lines of the legs cross."""

    links: tuple[str, str]
    away: float
    crossing: float


@dataclass(frozen=True)
class RelativePoints:
    """The special points of two moving links of a group, as far as its motion is known.

    known : what is no longer unknown
    settled : nodes whose motion is known
    along : direction of the relative motion of an edge
    turn : for each link of the group the one link whose angular velocity it shares
    """

    net: Net
    known: Collection[str]
    settled: Collection[PointRef]
    along: Callable[[Edge, Mapping[str, complex]], complex]
    turn: Mapping[str, str]

    def best(self, left_out: Collection[tuple[str, str]]) -> tuple[RelativePoint | None, list[FarPoint]]:
        """The special point that gives the best crossing, None where there is none; and those that are no use.

        Parameters
        ----------
        left_out : pairs of links that are not looked at
        """
        size = max((abs(z) for z in self.net.places.values()), default=1.0) or 1.0
        best: tuple[float, RelativePoint] | None = None
        far: list[FarPoint] = []
        for links, legs in self._legs(left_out).items():
            for one, two in combinations(legs, 2):
                (p, d), (q, e) = (self._line(leg) for leg in (one, two))
                at = cross_lines(p, d, q, e)
                if at is None:
                    continue
                sine, away = abs(cross(d, e)), abs(at - (p + q) / 2)
                quality = sine / (1.0 + away / size)
                if sine < OFF:  # parallel: nothing lies there
                    continue
                if quality <= WORST:
                    far.append(FarPoint(links, away, math.asin(min(1.0, sine))))
                elif best is None or quality > best[0]:
                    best = quality, RelativePoint(links, at, (one, two))
        return best[1] if best else None, far

    def _legs(self, left_out: Collection[tuple[str, str]]) -> Mapping[tuple[str, str], Sequence[Path]]:
        """For each two links the shortest way by each unknown that joins them."""
        owners, names = self.net.owners, [name for name in self.net.inside if "/" not in name]
        of = {name: [n for n in self.net.nodes if name in owners[n]] for name in names}
        found: dict[tuple[str, str], dict[str, Path]] = {}
        for i, one in enumerate(names):
            others = {n: [two for two in names[i + 1 :] if two in self.net.owners[n]] for n in self.net.nodes}
            own = f"omega {self.turn.get(one, one)}"
            for path in self._ways(of[one], one):
                names_of = [e.unknown for e in path if e.unknown]
                for two in others[path[-1].end]:
                    if (one, two) in left_out or len(names_of) != 1:
                        continue
                    (unknown,) = names_of
                    turned = (own, f"omega {self.turn.get(two, two)}")
                    if unknown in turned:
                        continue
                    old = found.setdefault((one, two), {}).get(unknown)
                    if (old is None or len(path) < len(old)) and self._straight(path):
                        found[one, two][unknown] = path
        return {links: list(legs.values()) for links, legs in found.items()}

    def _ways(self, starts: Sequence[PointRef], link: str) -> Iterator[Path]:
        """Ways that leave a link, with one unknown at most."""
        stack: list[Path] = [()]
        while stack:
            path = stack.pop()
            for start in (path[-1].end,) if path else starts:
                for edge in self.net.edges[start]:
                    if edge.link == link or edge.end in self.settled:
                        continue
                    seen = replace(edge, unknown="") if edge.unknown in self.known else edge
                    if seen.unknown and any(e.unknown for e in path):
                        continue
                    longer = (*path, seen)
                    yield longer
                    if len(longer) < LONGEST:
                        stack.append(longer)

    def _line(self, leg: Path) -> tuple[complex, complex]:
        free = next(e for e in leg if e.unknown)
        return self.net.places[leg[-1].end.point], 1j * self.along(free, self.net.places)

    def _straight(self, leg: Path) -> bool:
        """Whether a leg's joints on both links lie on its line, so that neither's turning moves it along that."""
        end, way = self._line(leg)
        arm = end - self.net.places[leg[0].start.point]
        return abs(arm) <= self.net.tiny or abs(cross(unit(arm), way)) < OFF
