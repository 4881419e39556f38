"""Dimensions of what slides, after ISO 129-1: slanted guides of the frame, places and angles of guides on links, angles
at which links sit on their guides, and how far drivers have pushed.
"""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Iterator, Sequence

from graphkin.construction.sheet import Sheet
from graphkin.drawing.headings import number, slide_index, written
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Line, Run, Text
from graphkin.drawing.parts.given_shapes import along_its_guide, as_line, off_its_guide, used_guides
from graphkin.drawing.parts.mechanism_on_paper import GUIDE_LENGTH, Slider, shapes, sliders
from graphkin.drawing.place.dimensions import (
    GAP,
    OVERRUN,
    DimensionClearance,
    Parts,
    angle_dimension,
    dimension,
)
from graphkin.drawing.place.labels import Label, Mark
from graphkin.drawing.text import rich
from graphkin.plane import cross, cross_lines, dot
from graphkin.scene.model import Mechanism, PlacedLink
from graphkin.words.written import as_given

__all__ = ["DRIVEN", "driven_value", "guide_dimensions", "travels"]

SIZE = 2.8
DRIVEN = "label-driven-"  # how the id of a driver's value begins where it is a label
BESIDE = (6.0, 9.0, 12.5, 17.0, 22.0, 28.0)  # mm from what is dimensioned
RADII = (8.0, 11.0, 14.0, 18.0, 23.0)
SHORTEST = 1.0  # mm; a shorter distance has no dimension
LEVEL = 1e-9
NEAR = 0.5  # mm from a corner


def guide_dimensions(sheet: Sheet, room: DimensionClearance) -> Iterator[Parts]:
    """Those for which there is room: of the frame's guides, then of links."""
    scene = sheet.scene.instead_of or sheet.scene
    shown = _shown(sheet)
    tried: list[Parts | None] = []
    slanted: set[str] = set()
    for slider in shown:
        frames = slider.slide.b == scene.frame.name and slider.slide.guide.name not in slanted
        if frames and slider.slide.guide.name and abs(slider.along.real * slider.along.imag) > LEVEL:
            slanted.add(slider.slide.guide.name)
            tried += [_off_pivot(sheet, room, slider), _slant(room, slider)]
    for parts in tried:
        if parts is not None:
            yield parts
    for link in scene.links:
        if link.name in sheet.poses and not link.redundant:
            yield from _on_link(sheet, scene, link, room, shown)


def travels(sheet: Sheet, room: DimensionClearance) -> Iterator[Parts | Label]:
    """How far each driver has pushed along its guide, from the guide's origin; where there is no room for a dimension,
    as a label."""
    for slider in _shown(sheet):
        if slider.driven:
            key, pose = slider.slide.key, sheet.poses[slider.slide.b]
            value = sheet.drivers[key] / sheet.scene.units.metres
            start = pose.origin + pose.axis * slider.slide.guide.through / sheet.scales.length
            runs = rich(f"$s_{{{slide_index(sheet, key)}}}$ = {written(as_given(value))}", SIZE)
            parts = _apart(room, (start,), (slider.at,), slider.along, abs(value), runs)
            yield parts or driven_value(key, runs, (start.conjugate(), slider.at.conjugate()))


def driven_value(key: str, runs: tuple[Run, ...], mark: Mark) -> Label:
    """The value of a driver as a label; it is given, so everything else gives way to it."""
    return Label(Text(0j, runs, "start", strokes.BLACK, f"{DRIVEN}{key.replace('/', '-')}", ("label",)), mark, rank=0)


def _shown(sheet: Sheet) -> list[Slider]:
    """The sliding pairs of the scene, not those that stand for something else."""
    scene = sheet.scene.instead_of or sheet.scene
    keys = {pair.key for pair in scene.slidings} | {pin.key for pin in scene.pins}
    return [one for one in sliders(sheet) if one.slide.key in keys]


def _off_pivot(sheet: Sheet, room: DimensionClearance, slider: Slider) -> Parts | None:
    """How far a slanted guide of the frame runs from the nearest fixed point, square to it."""
    frame = sheet.scene.frame
    guide = slider.slide.guide
    apart = {p: abs(cross(z - guide.through, guide.direction)) for p, z in frame.points.items() if p in _places(sheet)}
    if not apart:
        return None
    nearest = min(apart, key=lambda p: (apart[p], p))
    pivot = _places(sheet)[nearest]
    off = (guide.through - frame.points[nearest]) / sheet.scene.units.metres
    for way, given in ((1j, off.imag), (1 + 0j, off.real)):
        if abs(given) < LEVEL or abs(off - given * way) > LEVEL * abs(off):
            continue  # the problem gives no distance straight from the pivot
        foot = pivot + given * way * sheet.scene.units.metres / sheet.scales.length
        end = min((slider.at + s * GUIDE_LENGTH / 2 * slider.along for s in (1, -1)), key=lambda z: abs(z - foot))
        along = (Line(end.conjugate(), foot.conjugate(), strokes.DIMENSION),) if abs(end - foot) > SHORTEST else ()
        found = _apart(room, (pivot,), (foot,), way, abs(given), also=along)
        if found is not None:
            return found
    end = GUIDE_LENGTH / 2 * slider.along
    spots = (slider.at - end, slider.at + end)
    return _apart(room, (pivot,), spots, slider.along * 1j, apart[nearest] / sheet.scene.units.metres)


def _slant(room: DimensionClearance, slider: Slider) -> Parts | None:
    """The angle of a slanted guide of the frame with the horizontal, at either of its ends."""
    angle = as_line(slider.along)
    runs = rich(f"{number(abs(angle), 5)}°", SIZE)
    choices = []
    for sense in (1, -1):
        way = sense * slider.along
        level = math.copysign(1.0, way.real)
        start = 0.0 if level > 0 else math.pi
        corner = (slider.at + (GUIDE_LENGTH / 2 + 0.5) * way).conjugate()
        for radius in RADII:
            further = radius + OVERRUN
            choices.append((
                Line(corner, corner + further * level, strokes.DIMENSION),
                Line(corner, corner + further * way.conjugate(), strokes.DIMENSION),
                *angle_dimension(corner, radius, start, start + math.radians(angle), runs),
            ))  # fmt: skip
    return room.take(choices, 2, ends_on_line=True)


def _on_link(
    sheet: Sheet, scene: Mechanism, link: PlacedLink, room: DimensionClearance, shown: Sequence[Slider]
) -> Iterator[Parts]:
    """The places of a link's points and guides, and its angles, as they follow from what it slides on."""
    pairs = along_its_guide(scene, link)
    pose, metres = sheet.poses[link.name], scene.units.metres
    tried: list[Parts | None] = []
    if pairs and len(link.bar) < 2:
        along = pose.axis / pairs[0].turn  # of the guide
        for point in off_its_guide(scene, link):
            z = link.points[point] * pairs[0].turn
            if point in _places(sheet):
                ends = (pose.origin,), (_places(sheet)[point],)
                tried.append(_apart(room, *ends, along, abs(z.real) / metres))
                tried.append(_apart(room, *ends, along * 1j, abs(z.imag) / metres))
    if len(pairs) == 2:
        ways = [pose.axis / pair.turn for pair in pairs]
        tried.append(_angle(room, pose.origin, ways[0], ways[1]))
    elif pairs and abs(pairs[0].turn.imag) > LEVEL and _shows_its_axis(link, shown):
        tried.append(_angle(room, pose.origin, pose.axis / pairs[0].turn, pose.axis))
    for guide in used_guides(scene, link):
        on = next((s for s in shown if s.slide.b == link.name and s.slide.guide.name == guide.name), None)
        if on is None or (abs(cross(guide.direction, 1 + 0j)) < LEVEL and not link.bar):
            continue
        value = abs(cross(guide.through, guide.direction)) / metres
        if abs(float(f"{value:.4g}") - value) < 1e-9 * value:  # as it is given, no result of slanted places
            tried.append(_apart(room, (pose.origin,), (on.at,), on.along * 1j, value))
        corner = cross_lines(pose.origin, pose.axis, on.at, on.along)
        if corner is not None and abs(corner - pose.origin) > GUIDE_LENGTH / 2 and _drawn_at(sheet, link, corner):
            tried.append(_angle(room, corner, pose.origin - corner, on.at - corner))
    yield from (parts for parts in tried if parts is not None)


def _drawn_at(sheet: Sheet, link: PlacedLink, corner: complex) -> bool:
    """Whether two lines of a link meet in a place as it is drawn."""
    shape = next((s for s in shapes(sheet) if s.link == link.name), None)
    ends = [end for segment in (shape.segments if shape else ()) for end in segment]
    return sum(abs(end - corner) < NEAR for end in ends) > 1


def _shows_its_axis(link: PlacedLink, shown: Sequence[Slider]) -> bool:
    """Whether the own axis of a link is drawn: a bar, or what something slides on."""
    return len(link.bar) == 2 or any(s.slide.b == link.name and not s.slide.guide.name for s in shown)


def _angle(room: DimensionClearance, at: complex, one: complex, other: complex) -> Parts | None:
    """The angle between two lines through a place, drawn from one to the other the shortest way."""
    turn = phase(other / one)
    if abs(turn) > math.pi / 2 + LEVEL:  # between the lines, the smaller angle
        one, turn = -one, turn - math.copysign(math.pi, turn)
    runs = rich(f"{number(abs(math.degrees(turn)), 5)}°", SIZE)
    starts = [phase(one), phase(-one)]
    choices = (
        angle_dimension(at.conjugate(), radius, start, start + turn, runs) for radius in RADII for start in starts
    )
    return room.take(choices, 0, ends_on_line=True)


def _apart(
    room: DimensionClearance, ones: Sequence[complex], others: Sequence[complex], along: complex, value: float,
    runs: tuple[Run, ...] = (), also: Parts = (),
) -> Parts | None:  # fmt: skip
    """How far two places are apart in a direction, y up, each measured from the nearest of some spots on its level;
    with what else is drawn for it."""
    runs = runs or rich(written(as_given(value)), SIZE)
    aside = along * 1j
    if abs(dot(others[0] - ones[0], along)) < SHORTEST:
        return None
    levels = [dot(z, aside) for z in (*ones, *others)]
    lines = [edge for far in BESIDE for edge in (max(levels) + far, min(levels) - far)]

    def drawn(line: float) -> Parts:
        feet, extensions = [], []
        for spots in (ones, others):
            spot = min(spots, key=lambda z: abs(line - dot(z, aside)))
            foot = spot + (line - dot(spot, aside)) * aside
            way = (foot - spot) / abs(foot - spot)
            begin, end = spot + GAP * way, foot + OVERRUN * way
            extensions.append(Line(begin.conjugate(), end.conjugate(), strokes.DIMENSION))
            feet.append(foot.conjugate())
        return *extensions, *also, *dimension(feet[0], feet[1], 0.0, runs)

    return room.take((drawn(line) for line in lines), 2)


def _places(sheet: Sheet) -> dict[str, complex]:
    return {ref.point: z for ref, z in sheet.points.items() if not ref.link}
