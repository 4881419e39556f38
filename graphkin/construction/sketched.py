"""Where the links of a larger group lie roughly, by the sketch of a problem.

Two sketched points of a link tell its direction.  Sliding pairs and driven angles tell it of others; where links are
joined so but none of them has two such points, a guide and what slides on it tell it, once for either sense.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping
from itertools import islice

import numpy as np

from graphkin.construction.links_on_paper import PlacedLinks
from graphkin.construction.sheet import Pose
from graphkin.plane import cross
from graphkin.scene.model import AngleDriver
from graphkin.structure import Cluster, Slide, Structure

__all__ = ["as_sketched"]

MOST = 8  # positions that a sketch is taken to mean
ALIKE = 0.05  # directions nearer to each other, and distances (of the size) that differ less, are the same in a sketch
ACROSS = 0.1  # sine of the least angle at which two guides tell a place

Axes = dict[str, complex]


def as_sketched(structure: Structure, cluster: Cluster, known: PlacedLinks) -> list[dict[str, Pose]]:
    """All links known and those of a group roughly where they are sketched, in each position that the sketch can mean;
    none where it does not tell of all of them."""
    scene = structure.scene
    places = {p: z * known.mm for p, z in {**scene.sketch, **scene.drawn}.items()}
    places |= {p: known.point(n, p) for n in known.poses for p in structure.links[n].points}
    sketch = _Sketch(structure, cluster, known, places)
    return list(islice(sketch.positions(dict(known.poses), {n: pose.axis for n, pose in known.poses.items()}), MOST))


class _Sketch:
    def __init__(
        self, structure: Structure, cluster: Cluster, known: PlacedLinks, places: Mapping[str, complex]
    ) -> None:
        self.members, self.places = cluster.members, places
        self.slides = [p for p in cluster.pairs if isinstance(p, Slide)]
        self.points = {n: {p: z * known.mm for p, z in link.points.items()} for n, link in structure.links.items()}
        self.mm = known.mm
        # links whose directions tell each other's: the second's is the first's times this
        self.joined = [(s.b, s.a, s.guide.direction * s.turn) for s in self.slides]
        self.joined += [
            (d.relative_to, d.link, cmath.rect(1.0, known.values[d.key]))
            for d in cluster.drivers if isinstance(d, AngleDriver)
        ]  # fmt: skip

    def positions(self, poses: dict[str, Pose], axes: Axes) -> Iterator[dict[str, Pose]]:
        """Every position from the links and directions known already."""
        self._spread(axes)
        found = next(((n, axis) for n in self.members if n not in axes and (axis := self._by_points(n))), None)
        if found is not None:
            yield from self.positions(poses, {**axes, found[0]: found[1]})
            return
        self._place(poses, axes)
        left = next((n for n in self.members if n not in axes), None)
        if left is None:
            if poses.keys() >= set(self.members):
                yield poses
            return
        for name in self.members:
            if name in axes:
                continue
            for axis in self._by_guides(name, poses):
                yield from self.positions(dict(poses), {**axes, name: axis})
            return

    def _spread(self, axes: Axes) -> None:
        grown = True
        while grown:
            grown = False
            for base, name, turn in self.joined:
                if base in axes and name not in axes:
                    axes[name], grown = axes[base] * turn, True
                elif name in axes and base not in axes:
                    axes[base], grown = axes[name] * turn.conjugate(), True

    def _by_points(self, name: str) -> complex | None:
        own = {p: z for p, z in self.points[name].items() if p in self.places}
        a, b = max(((a, b) for a in own for b in own), key=lambda ab: abs(own[ab[0]] - own[ab[1]]), default=("", ""))
        if a == b or self.places[a] == self.places[b]:
            return None
        axis = (self.places[b] - self.places[a]) / (own[b] - own[a])
        return axis / abs(axis)

    def _by_guides(self, name: str, poses: Mapping[str, Pose]) -> list[complex]:
        """Directions of a link at which what slides on guides, of it or of links joined to it, lies on them."""
        turned: Axes = {name: 1 + 0j}
        self._spread(turned)
        rows = []
        for s in self.slides:
            block, rail = self._one_point(s.a, poses), self._one_point(s.b, poses)
            if s.b not in turned or block is None or rail is None or block[0] == rail[0]:
                continue
            offset = (s.turn * block[1]).imag + cross(s.guide.direction, s.guide.through * self.mm - rail[1])
            rows.append((turned[s.b] * s.guide.direction, block[0] - rail[0], offset))
        senses = []
        for along, way, offset in rows:
            lean = math.asin(min(1.0, max(-1.0, offset / abs(way))))
            # towards what slides first, as a rod lies on its cylinder
            senses += [cmath.rect(1.0, cmath.phase(way) + turn) / along for turn in (-lean, lean - math.pi)]
        told: list[tuple[float, complex]] = []
        for axis in senses:
            off = max(abs(cross(axis * along, way) - offset) for along, way, offset in rows)
            if all(abs(axis - other) > ALIKE for _, other in told):
                told.append((off, axis))
        least = min((off for off, _ in told), default=0.0)
        return [axis for off, axis in told if off <= least + ALIKE]

    def _one_point(self, name: str, poses: Mapping[str, Pose]) -> tuple[complex, complex] | None:
        """Where a point of a link lies, and its place on the link."""
        if name in poses:
            return poses[name].origin, 0j
        return next(((self.places[p], z) for p, z in self.points[name].items() if p in self.places), None)

    def _place(self, poses: dict[str, Pose], axes: Axes) -> None:
        """The links of known direction: by a point of them, or where two of their guides tell the place."""
        grown = True
        while grown:
            grown = False
            for name in self.members:
                if name in poses or name not in axes:
                    continue
                at = self._one_point(name, poses)
                origin = at[0] - axes[name] * at[1] if at is not None else self._by_two_guides(name, poses, axes)
                if origin is not None:
                    poses[name], grown = Pose(origin, axes[name]), True

    def _by_two_guides(self, name: str, poses: Mapping[str, Pose], axes: Axes) -> complex | None:
        ways, offs = [], []
        for s in self.slides:
            other = s.b if s.a == name else s.a
            if name not in (s.a, s.b) or other not in poses:
                continue
            along = axes[s.b] * s.guide.direction
            through = axes[s.b] * s.guide.through * self.mm
            start = poses[other].origin + (through if s.a == name else -through)
            ways.append((-along.imag, along.real))
            offs.append(cross(along, start))
        if len(ways) < 2 or np.linalg.svd(np.array(ways), compute_uv=False)[-1] < ACROSS:
            return None
        x, y = np.linalg.lstsq(np.array(ways), np.array(offs), rcond=None)[0]
        return complex(x, y)
