"""The mechanism as it stands on paper: where its parts are, and what they must know of each other to be drawn."""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from graphkin.construction.sheet import Sheet
from graphkin.drawing import symbols
from graphkin.drawing.conventions import Letters
from graphkin.drawing.shapes import Bearing, Shape, bearings, shapes
from graphkin.drawing.strokes import colour_of_link
from graphkin.plane import cross, dot
from graphkin.scene.model import Scene

__all__ = ["OnPaper", "page"]

FOOT = {-math.pi / 2: 0.0, 0.0: 0.5, math.pi: 0.5, math.pi / 2: 0.7}  # where feet may point, and how little liked


def page(z: complex) -> complex:
    """A place on the page, whose y axis points down."""
    return z.conjugate()


@dataclass(frozen=True)
class OnPaper:
    """A sheet's mechanism with the letters of a convention; places in mm, y up, about the world's origin."""

    sheet: Sheet
    letters: Letters

    @property
    def scene(self) -> Scene:
        return self.sheet.scene

    @property
    def ground(self) -> str:
        return self.sheet.scene.frame.name

    @cached_property
    def shapes(self) -> tuple[Shape, ...]:
        return shapes(self.sheet)

    @cached_property
    def bearings(self) -> tuple[Bearing, ...]:
        return bearings(self.sheet)

    @cached_property
    def places(self) -> Mapping[str, complex]:
        """Where each point is."""
        return {ref.point: z for ref, z in self.sheet.points.items() if not ref.link}

    @cached_property
    def cylinders(self) -> frozenset[str]:
        """Driven slides that are drawn as cylinder and rod."""
        return frozenset(b.slide.key for b in self.bearings if b.driven and self._is_cylinder(b))

    def colour(self, link: str) -> str:
        return colour_of_link(self.scene, link)

    def moving(self, point: str) -> list[str]:
        """The moving links that have a point."""
        return [n for n in self.scene.holders.get(point, ()) if n != self.ground and n in self.sheet.poses]

    def foot(self, point: str) -> float:
        """Direction of a pivot's foot (rad): down, unless links are in the way."""
        here = self.places[point]
        ways = [phase(w) for w in self.ways(here)]

        def cost(angle: float) -> float:
            nearest = min((_turn(angle, way) for way in ways), default=math.pi)
            end = here + (symbols.FOOT_HEIGHT + 1.0) * complex(math.cos(angle), math.sin(angle))
            covered = sum(_inside(end, shape.corners) for shape in self.shapes)
            return FOOT[angle] + max(0.0, 0.9 - nearest) * 3 + 0.9 * covered

        return min(FOOT, key=cost)

    def ways(self, here: complex) -> list[complex]:
        """Directions in which bars leave a place."""
        ways = []
        for shape in self.shapes:
            for a, b in shape.segments:
                length = abs(b - a)
                if length < 1e-9 or abs(cross(here - a, b - a)) / length > 1.0:
                    continue
                t = dot(here - a, b - a) / length
                if -1.0 <= t < length - 2.0:
                    ways.append(b - a)
                if 2.0 < t <= length + 1.0:
                    ways.append(a - b)
        return ways

    def nested(self, link: str) -> int:
        """How many larger blocks stand around the block of a link: two that slide at one pin lie in each other."""
        mine = next(b for b in self.bearings if b.slide.a == link)
        around = [b for b in self.bearings if not b.slide.slot and b.slide.a != link and abs(b.at - mine.at) < 0.5]
        rank = (mine.slide.b != self.ground, self.scene.order.get(link, 0))
        return sum((b.slide.b != self.ground, self.scene.order.get(b.slide.a, 0)) < rank for b in around)

    def pivot(self, b: Bearing) -> complex:
        """Where the guiding link of a slide is held."""
        link = self.scene.by_name[b.slide.b]
        return next((self.places[p] for p in link.points if p in self.places), self.sheet.poses[b.slide.b].origin)

    def rod(self, b: Bearing) -> tuple[complex, complex]:
        """The part of a cylinder's rod that is seen."""
        pivot = self.pivot(b)
        return pivot + 0.6 * (b.at - pivot), b.at

    def _is_cylinder(self, b: Bearing) -> bool:
        if b.slide.b == self.ground or b.slide.slot:
            return False
        pivot = self.pivot(b)
        return abs(cross(b.at - pivot, b.along)) < 1e-3 and dot(b.at - pivot, b.along) > 12.0


def _inside(z: complex, corners: tuple[complex, ...]) -> bool:
    """Whether a place lies in a convex area whose corners run counter-clockwise."""
    ends = zip(corners, (*corners[1:], *corners[:1]), strict=True)
    return len(corners) > 2 and all(cross(b - a, z - a) > 0 for a, b in ends)


def _turn(a: float, b: float) -> float:
    """Angle between two directions (rad, 0 to pi)."""
    return abs((a - b + math.pi) % (2 * math.pi) - math.pi)
