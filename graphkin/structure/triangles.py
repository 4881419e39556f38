"""Driven slides that close a triangle with a pair of two links not yet known: tippers, scissor lifts, excavators.

The rod and the cylinder hang on two links that a pair joins.  Seen with one of these held still, the other, the rod and
the cylinder are a dyad with a given travel between: the triangle is rigid at the moment, and the motion at the common
pair follows at once, whatever the rest of the mechanism does.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.scene.model import Driver, PlacedLink
from graphkin.structure.model import Cluster, DrivenTriangle, Pair

__all__ = ["triangles_of"]


@dataclass(frozen=True)
class _Joints:
    """The pairs of a group, hinges of several links counted between each two of them."""

    cluster: Cluster
    links: Mapping[str, PlacedLink]
    hinges: Mapping[str, tuple[str, ...]]

    def of(self, link: str, besides: Pair) -> list[tuple[Pair, tuple[str, ...]]]:
        """The pairs of a link besides one, each with the members of the group on its other side."""
        found: list[tuple[Pair, tuple[str, ...]]] = []
        points = {p.point for p in self.cluster.pairs if p.turns and p.point in self.links[link].points}
        for point in sorted(points):
            others = tuple(n for n in self.hinges[point] if n != link and n in self.cluster.members)
            found.append((Pair(point, link, others[0] if others else ""), others))
        for pair in self.cluster.pairs:
            if not pair.turns and pair != besides and link in (pair.a, pair.b):
                other = pair.b if pair.a == link else pair.a
                found.append((pair, (other,) if other in self.cluster.members else ()))
        return found

    def between(self, one: str, two: str) -> list[Pair]:
        found: list[Pair] = [
            Pair(point, two, one) for point, names in self.hinges.items() if one in names and two in names
        ]
        return found + [p for p in self.cluster.pairs if not p.turns and {p.a, p.b} == {one, two}]


def triangles_of(
    cluster: Cluster, links: Mapping[str, PlacedLink], hinges: Mapping[str, tuple[str, ...]], taken: set[str]
) -> list[DrivenTriangle]:
    """The driven triangles of a larger group; ``taken`` are the keys of drivers, which no other may bear."""
    joints = _Joints(cluster, links, hinges)
    found = []
    for driver in cluster.drivers:
        slide = next((p for p in cluster.pairs if not p.turns and p.key == driver.key), None)
        if not driver.turns and slide is not None and {slide.a, slide.b} <= set(cluster.members):
            triangle = _triangle(joints, slide, driver, taken)
            if triangle is not None:
                taken.add(triangle.equivalent.key)
                found.append(triangle)
    return found


def _triangle(joints: _Joints, slide: Pair, driver: Driver, taken: set[str]) -> DrivenTriangle | None:
    one, two = joints.of(slide.a, slide), joints.of(slide.b, slide)
    if len(one) != 1 or len(two) != 1:
        return None
    for a in one[0][1]:
        for b in two[0][1]:
            pairs = joints.between(a, b) if a != b and not {a, b} & {slide.a, slide.b} else []
            if len(pairs) != 1:
                continue
            first = min(a, b, key=joints.cluster.members.index)
            for held, other in ((first, b if first == a else a), (b if first == a else a, first)):
                equivalent = _equivalent_driver(pairs[0], held, other)
                if equivalent.key not in taken:
                    return DrivenTriangle(held, (other, slide.a, slide.b), pairs[0], driver, equivalent)
    return None


def _equivalent_driver(pair: Pair, held: str, other: str) -> Driver:
    if pair.turns:
        return Driver(other, held, 0.0, 0.0, 0.0)
    return Driver(pair.a, pair.b, 0.0, 0.0, 0.0, pair.key)
