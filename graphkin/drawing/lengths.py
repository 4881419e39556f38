"""Given lengths and the places of the frame's points, drawn as dimensions where there is room for them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from graphkin.drafting.sheet import Sheet
from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.dimensions import angle_dimension, dimension
from graphkin.drawing.headings import number
from graphkin.drawing.metrics import text_box
from graphkin.drawing.obstacles import Obstacles, obstacles_of
from graphkin.drawing.primitives import Arc, Group, Line, Polygon, Primitive, Text
from graphkin.drawing.shapes import GUIDE_LENGTH, bearings
from graphkin.drawing.typeset import rich
from graphkin.scene.model import AngleDriver
from graphkin.scene.symbol import PointRef

__all__ = ["LENGTHS", "drawn_lengths"]

LENGTHS = "dimensions"  # id of their group
OFFSETS = (6.0, -6.0, 9.0, -9.0, 12.5, -12.5, 17.0, -17.0)  # mm from the bar
LEAST = 11.0  # mm: a shorter bar gets no dimension
BESIDE = 6.5  # mm from the mechanism to the dimensions of the frame
SIZE = 2.8
ANGLE_RADII = (10.0, 13.0, 16.0)
Parts = tuple[Line | Polygon | Arc | Text, ...]


def drawn_lengths(sheet: Sheet, drawn: Iterable[Primitive], panel: Box | None) -> Group:
    """Dimensions of bars and of the frame.

    Parameters
    ----------
    drawn : the mechanism, of which the dimensions keep clear
    panel : no dimension leaves it
    """
    drawn = tuple(drawn)
    room = _Room(obstacles_of(drawn), panel)
    parts: list[Primitive] = []
    for taken in (*_frame(sheet, room), *_bars(sheet, room), *_angles(sheet, room)):
        parts += taken
    return Group(tuple(parts), id=LENGTHS)


class _Room:
    """What is drawn already, as arrays."""

    def __init__(self, obstacles: Obstacles, panel: Box | None) -> None:
        self.panel = panel
        self.areas = list(obstacles.areas)
        self.segments = [*obstacles.solid]
        corners = [z for box in self.areas for z in box.corners] + [z for s in self.segments for z in s]
        self.content = Box.around(corners) if corners else Box(0, 0, 0, 0)

    def take(self, parts: Parts, extensions: int) -> bool:
        """Add a dimension if it is clear of everything; its first lines are extension lines, which may touch what they
        come from."""
        lines = [part for part in parts if isinstance(part, Line)]
        texts = [text_box(part) for part in parts if isinstance(part, Text)]
        ends = []
        for i, line in enumerate(lines):
            start = line.start
            if i < extensions:
                length = abs(line.end - line.start)
                start = line.start + min(2.2, 0.8 * length) * (line.end - line.start) / length
            ends.append((start, line.end))
        boxes = [*texts, *(Box.around(p.points) for p in parts if isinstance(p, Polygon))]
        for arc in (part for part in parts if isinstance(part, Arc)):
            course = [arc.at(arc.start + (arc.end - arc.start) * (0.06 + 0.11 * i)) for i in range(9)]
            ends += pairwise(course)
        if self.panel is not None and not all(self.panel.holds(box) for box in boxes):
            return False
        if self._meets(ends) or any(self._touched(box.grown(0.5)) for box in boxes):
            return False
        if any(area.grown(0.4).clip(*end) for end in ends for area in self.areas):
            return False
        self.segments += ends
        self.areas += boxes
        return True

    def _touched(self, box: Box) -> bool:
        return any(box.overlaps(area) for area in self.areas) or any(box.clip(*s) for s in self.segments)

    def _meets(self, lines: list[tuple[complex, complex]]) -> bool:
        """Whether a line crosses a segment, or runs along one nearer than a millimetre."""
        if not self.segments or not lines:
            return False
        own = np.array(lines)[:, None, :]
        others = np.array(self.segments)[None, :, :]
        p, d = own[..., 0], own[..., 1] - own[..., 0]
        q, e = others[..., 0], others[..., 1] - others[..., 0]
        crossing = (_side(d, q - p) * _side(d, q + e - p) <= 0) & (_side(e, p - q) * _side(e, p + d - q) <= 0)
        return bool(crossing.any())


def _side(a: Any, b: Any) -> Any:
    return a.real * b.imag - a.imag * b.real


def _bars(sheet: Sheet, room: _Room) -> Iterator[Parts]:
    places = {ref.point: z for ref, z in sheet.points.items() if not ref.link}
    for link in sheet.scene.links:
        if link.length is None or link.redundant or not all(p in places for p in link.bar):
            continue
        start, end = (places[p].conjugate() for p in link.bar)
        if abs(end - start) < LEAST:
            continue
        runs = rich(number(link.length / sheet.scene.units.metres, 5), SIZE)
        for offset in OFFSETS:
            parts = dimension(start, end, offset, runs)
            if room.take(parts, 2):
                yield parts
                break


def _frame(sheet: Sheet, room: _Room) -> Iterator[Parts]:
    """Distances between fixed points and guides: across below the mechanism, upright beside it."""
    scene = sheet.scene
    per_mm = sheet.scales.length / scene.units.metres
    spots = [z.conjugate() for ref, z in sheet.points.items() if not ref.link and ref.point in scene.frame.points]
    level, plumb = [], []
    for bearing in bearings(sheet):
        if bearing.slide.b == scene.frame.name and bearing.slide.guide.name:
            # from the end of the guide as it is drawn, left or below
            if abs(bearing.along.imag) < 1e-9:
                level.append(bearing.at.conjugate() - GUIDE_LENGTH / 2 + 4.0)
            elif abs(bearing.along.real) < 1e-9:
                plumb.append(bearing.at.conjugate() + 1j * (GUIDE_LENGTH / 2 - 4.0))
    xs = _levels([*spots, *plumb], lambda z: z.real)
    ys = _levels([*spots, *level], lambda z: z.imag)
    content = room.content
    bottom, left = content.bottom + BESIDE, content.left - BESIDE
    for (a, p), (b, q) in pairwise(xs):
        runs = rich(number((b - a) * per_mm, 5), SIZE)
        lines = tuple(_extension(z, complex(z.real, bottom + 1.5)) for z in (p, q))
        parts = (*lines, *dimension(complex(a, bottom), complex(b, bottom), 0.0, runs))
        if b - a >= 5.0 and room.take(parts, 2):
            yield parts
    for (a, p), (b, q) in pairwise(ys):
        runs = rich(number((b - a) * per_mm, 5), SIZE)
        lines = tuple(_extension(z, complex(left - 1.5, z.imag)) for z in (p, q))
        parts = (*lines, *dimension(complex(left, a), complex(left, b), 0.0, runs))
        if b - a >= 5.0 and room.take(parts, 2):
            yield parts


def _angles(sheet: Sheet, room: _Room) -> Iterator[Parts]:
    """The angle of a driver from the x axis."""
    for driver in sheet.scene.drivers:
        if not isinstance(driver, AngleDriver) or driver.relative_to != sheet.scene.frame.name:
            continue
        link = sheet.scene.by_name[driver.link]
        pivot = next((sheet.points[PointRef(p)] for p in link.points if p in sheet.scene.frame.points), None)
        value = sheet.drivers[driver.key]
        turn = math.remainder(value, 2 * math.pi)
        if pivot is None or abs(turn) < 0.2 or math.pi - abs(turn) < 0.05:
            continue
        runs = rich(f"{number(math.degrees(turn), 5)}°", SIZE)
        for radius in ANGLE_RADII:
            at = pivot.conjugate()
            base = Line(at + 2.2, at + radius + 3.0, strokes.DIMENSION)
            parts = (base, *angle_dimension(at, radius, 0.0, turn, runs))
            if room.take(parts, 1):
                yield parts
                break


def _levels(spots: list[complex], key: Any) -> list[tuple[float, complex]]:
    """Places in the order of one coordinate, each value once."""
    found: dict[float, complex] = {}
    for z in spots:
        found.setdefault(round(key(z), 6), z)
    return sorted(found.items(), key=lambda item: item[0])


def _extension(start: complex, end: complex) -> Line:
    return Line(start + 6.0 * (end - start) / abs(end - start), end, strokes.DIMENSION)
