"""Given lengths and the places of the frame's points, drawn as dimensions where there is room for them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Any

from graphkin.drafting.sheet import Sheet
from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.dimension_room import Parts, Room
from graphkin.drawing.dimensions import GAP, OVERRUN, angle_dimension, dimension
from graphkin.drawing.headings import number
from graphkin.drawing.obstacles import obstacles_of
from graphkin.drawing.primitives import Arc, Group, Line, Polygon, Primitive, Text
from graphkin.drawing.shapes import GUIDE_LENGTH, bearings
from graphkin.drawing.typeset import rich
from graphkin.scene.model import AngleDriver, Link
from graphkin.scene.symbol import PointRef

__all__ = ["LENGTHS", "drawn_lengths"]

LENGTHS = "dimensions"  # id of their group
OFFSETS = (6.0, -6.0, 9.0, -9.0, 12.5, -12.5, 17.0, -17.0, 22.0, -22.0)  # mm from the bar
LEAST, SHORTEST = 9.0, 5.0  # mm: a shorter bar, or distance in the frame, gets no dimension
BESIDE = 6.5  # mm from the mechanism to the dimensions of the frame
SIZE = 2.8
ANGLE_RADII = (10.0, 13.0, 16.0)


def drawn_lengths(sheet: Sheet, drawn: Iterable[Primitive], panel: Box | None) -> Group:
    """Dimensions of bars and of the frame.

    Parameters
    ----------
    drawn : the mechanism, of which the dimensions keep clear
    panel : no dimension leaves it
    """
    drawn = tuple(drawn)
    room = Room(obstacles_of(drawn), panel)
    parts: list[Primitive] = []
    for taken in (*_frame(sheet, room), *_bars(sheet, room), *_angles(sheet, room)):
        parts += taken
    return Group(tuple(parts), id=LENGTHS)


def _drawn(room: Room, choices: Iterable[Parts], extensions: int = 2) -> Parts | None:
    """The first of some dimensions for which there is room; extension lines run over others only where they must."""
    tried = tuple(choices)
    found = (room.take(parts, extensions, over) for over in (False, True) for parts in tried)
    return next((parts for parts in found if parts is not None), None)


def _bars(sheet: Sheet, room: Room) -> Iterator[Parts]:
    """Lengths of bars, and of further points from them where those are round numbers."""
    places = {ref.point: z for ref, z in sheet.points.items() if not ref.link}
    for link in sheet.scene.links:
        if link.redundant:
            continue
        spans = [(link.bar[0], link.bar[1])] if link.length is not None else []
        for further in (p for p in link.points if p not in link.bar):
            given = [own for own in link.bar if _round(link, own, further, sheet.scene.units.metres)]
            on_the_bar = abs(link.points[further].imag) < 1e-9 * abs(link.points[further])
            spans += [(own, further) for own in (given[:1] if on_the_bar else given)]
        for one, other in spans:
            if one not in places or other not in places:
                continue
            start, end = places[one].conjugate(), places[other].conjugate()
            if abs(end - start) < LEAST:
                continue
            value = abs(link.points[other] - link.points[one]) / sheet.scene.units.metres
            runs = rich(number(value, 5), SIZE)
            parts = _drawn(room, (dimension(start, end, offset, runs) for offset in OFFSETS))
            if parts is not None:
                yield parts


def _round(link: Link, one: str, other: str, metres: float) -> bool:
    """Whether a distance looks like one that was given: at most four digits."""
    value = abs(link.points[other] - link.points[one]) / metres
    return value > 0.0 and abs(float(f"{value:.4g}") - value) < 1e-9 * value


def _frame(sheet: Sheet, room: Room) -> Iterator[Parts]:
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
    below_or_above = (content.bottom + BESIDE, OVERRUN), (content.top - BESIDE, -OVERRUN)
    beside = (content.left - BESIDE, -OVERRUN), (content.right + BESIDE, OVERRUN)

    def chain(levels: Sequence[tuple[float, complex]], upright: bool) -> Parts | None:
        """Dimensions one after the other on one line, beside the mechanism."""
        choices = []
        for line, past in beside if upright else below_or_above:
            feet = [complex(line, level) if upright else complex(level, line) for level, _ in levels]
            beyond = past if upright else past * 1j
            parts: list[Line | Polygon | Arc | Text] = [
                _extension(z, foot + beyond) for (_, z), foot in zip(levels, feet, strict=True)
            ]
            for (a, p), (b, q) in pairwise(zip((level for level, _ in levels), feet, strict=True)):
                parts += dimension(p, q, 0.0, rich(number((b - a) * per_mm, 5), SIZE))
            choices.append(tuple(parts))
        return _drawn(room, choices, len(levels))

    for levels, upright in ((xs, False), (ys, True)):
        wide = [pair for pair in pairwise(levels) if pair[1][0] - pair[0][0] >= SHORTEST]
        whole = chain(levels, upright) if len(wide) == len(levels) - 1 > 1 else None
        if whole is not None:
            yield whole
        else:
            yield from (parts for pair in wide for parts in (chain(pair, upright),) if parts is not None)


def _angles(sheet: Sheet, room: Room) -> Iterator[Parts]:
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
            parts = room.take((base, *angle_dimension(at, radius, 0.0, turn, runs)), 1)
            if parts is not None:
                yield parts
                break


def _levels(spots: list[complex], key: Any) -> list[tuple[float, complex]]:
    """Places in the order of one coordinate, each value once."""
    found: dict[float, complex] = {}
    for z in spots:
        found.setdefault(round(key(z), 6), z)
    return sorted(found.items(), key=lambda item: item[0])


def _extension(start: complex, end: complex) -> Line:
    return Line(start + GAP * (end - start) / abs(end - start), end, strokes.DIMENSION)
