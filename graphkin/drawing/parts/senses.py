"""Senses of rotation on the mechanism: the arcs of drivers and of found angular velocities and accelerations, where
they are clear of bars, joints, feet and each other; and the arrows of driven slides.
"""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Sequence
from itertools import pairwise
from typing import Literal

import numpy as np

from graphkin.drawing.ink import strokes, symbols
from graphkin.drawing.ink.primitives import Group, Line, Stroke, Text
from graphkin.drawing.ink.symbols import POINTER, arrowhead
from graphkin.drawing.parts.mechanism_on_paper import GUIDE_LENGTH, MechanismOnPaper, page
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.meeting import Floats, Points
from graphkin.drawing.place.piece import Piece, joined
from graphkin.drawing.text import symbol
from graphkin.plane import added_up
from graphkin.scene.model import AngleDriver, SlideDriver

__all__ = ["clearance", "drivers", "found_rates"]

RADII = (5.5, 8.0, 11.0)  # mm, in the order of liking
HALF_SPAN = math.radians(37)
LABEL_AT = 3.6  # mm beyond the arc: where its name would stand
CLEAR, CLEAR_LABEL = 1.9, 2.6  # mm
_MIDDLES = np.arange(20) * (2 * math.pi / 20)
_SPREAD = np.linspace(-HALF_SPAN, HALF_SPAN, 5)


class SenseClearance:
    """Segments (mm) that arcs keep clear of; arcs that were given a place are added to them."""

    def __init__(self, segments: Sequence[tuple[complex, complex]]) -> None:
        self.segments = list(segments)

    def arc(self, centres: Sequence[complex], radius: float) -> tuple[complex, float, float]:
        """Centre, radius (mm) and middle direction (rad) of the arc about one of some centres that is clearest.

        ``radius`` is the least radius; centres are in the order of liking.
        """
        near = self._near(centres, radius + RADII[-1] - RADII[0] + LABEL_AT + CLEAR_LABEL)
        radii = np.array([radius + r - RADII[0] for r in RADII])
        ways = np.exp(1j * (_MIDDLES[:, None] + _SPREAD))  # middle x sample
        arcs = np.array(centres)[:, None, None, None] + radii[:, None, None] * ways
        names = np.array(centres)[:, None, None] + (radii[:, None] + LABEL_AT) * np.exp(1j * _MIDDLES)
        cost = 10.0 * np.clip(CLEAR - _distance(arcs, near), 0.0, None).sum(axis=-1)
        cost += 2.0 * np.clip(CLEAR_LABEL - _distance(names, near), 0.0, None)
        cost += 0.35 * (radii - radius)[:, None] + 0.5 * np.arange(len(centres))[:, None, None]
        cost += 0.05 * np.abs(np.angle(np.exp(1j * (_MIDDLES - math.radians(50)))))
        c, r, m = np.unravel_index(int(np.argmin(np.round(cost, 6))), cost.shape)
        found = centres[int(c)], float(radii[r]), float(_MIDDLES[m])
        course = [complex(z) for z in arcs[c, r, m]]
        self.segments += pairwise(course)
        name = complex(names[c, r, m])
        self.segments.append((name - 1.2, name + 1.2))
        return found

    def _near(self, centres: Sequence[complex], reach: float) -> tuple[Points, Points]:
        """Start and way of each segment that comes within reach of a centre."""
        ends = np.array(self.segments, dtype=complex).reshape(-1, 2)
        start, along = ends[:, 0], ends[:, 1] - ends[:, 0]
        off = _off(np.array(centres, dtype=complex), start, along)
        close = (off < reach**2).any(axis=0)
        return start[close], along[close]


def _distance(points: Points, segments: tuple[Points, Points]) -> Floats:
    """Least distance of each point to any segment."""
    if not len(segments[0]):
        return np.full(points.shape, np.inf)
    least: Floats = np.sqrt(_off(points, *segments).min(axis=-1))
    return least


def _off(points: Points, start: Points, along: Points) -> Floats:
    """Square of the distance of each point to each segment."""
    # copies lie side by side in memory, which halves the time
    way_x, way_y = along.real.copy(), along.imag.copy()
    x, y = points.real[..., None] - start.real.copy(), points.imag[..., None] - start.imag.copy()
    share = np.clip((x * way_x + y * way_y) / np.maximum(way_x**2 + way_y**2, 1e-18), 0.0, 1.0)
    x -= share * way_x
    y -= share * way_y
    far: Floats = x * x + y * y
    return far


DRIVER_RADIUS, RADIUS = 6.5, 5.5


def clearance(here: MechanismOnPaper) -> SenseClearance:
    """Everything that arcs keep clear of."""
    segments = [segment for shape in here.shapes for segment in shape.segments]
    segments += [(z, z + 0.01) for z in here.places.values()]
    for point in here.scene.frame.points:
        if here.moving(point):
            z, foot = here.places[point], here.foot(point)
            down = complex(math.cos(foot), math.sin(foot))
            end = z + symbols.FOOT_HEIGHT * down
            segments += [(z, end + 3.2j * down), (z, end - 3.2j * down), (end + 4.5j * down, end - 4.5j * down)]
    for b in here.sliders:
        reach = GUIDE_LENGTH / 2 if here.ground in (b.slide.a, b.slide.b) else symbols.BLOCK_LENGTH / 2
        side = 1j * b.along * symbols.BLOCK_WIDTH / 2
        segments += [(b.at + s * side - reach * b.along, b.at + s * side + reach * b.along) for s in (-1, 1)]
    return SenseClearance(segments)


def drivers(here: MechanismOnPaper, clear: SenseClearance) -> Piece:
    """What drives, and which way."""
    pieces = [Piece({"mechanism": ()})]
    for driver in here.scene.drivers:
        if isinstance(driver, SlideDriver):
            pieces.append(_slide_arrow(here, driver))
        elif driver.link in here.sheet.poses:
            pieces += [_driver_arc(here, clear, driver, kind) for kind in ("omega", "alpha") if getattr(driver, kind)]
    return joined(pieces)


def _driver_arc(
    here: MechanismOnPaper, clear: SenseClearance, driver: AngleDriver, kind: Literal["omega", "alpha"]
) -> Piece:
    other, speed = driver.relative_to, kind == "omega"
    markup = f"{'ω' if speed else 'α'}_{{{driver.link}{'' if other == here.ground else other}}}"
    centres = _centres_of_turn(here, driver.link, other)
    place = clear.arc(centres, DRIVER_RADIUS)
    sense = 1 if (driver.omega if speed else driver.alpha) > 0 else -1
    id = f"driver-{driver.link}{'' if speed else '-alpha'}"
    return _arc("mechanism", place, sense, 1 if speed else 2, here.colour(driver.link), markup, id)


def _slide_arrow(here: MechanismOnPaper, driver: SlideDriver) -> Piece:
    b = next((b for b in here.sliders if b.slide.key == driver.key), None)
    if b is None or not driver.velocity:
        return Piece()
    way = b.along * (1 if driver.velocity > 0 else -1)
    side = 1j * b.along * 5.2
    tail, tip = page(b.at + side - 5 * way), page(b.at + side + 5 * way)
    colour, id = here.colour(b.slide.a), f"driver-{driver.key.replace('/', '-')}"
    head = arrowhead(tip, tip - tail, POINTER.head_length, 1.0, colour)
    line = Line(tail, tip, Stroke(0.25, (), colour), covered=1.6)
    index = b.slide.a if b.slide.b == here.ground else b.slide.a + b.slide.b
    letter = "V" if here.letters.convention == "us" else "v"
    text = Text(0j, symbol(f"{letter}_{{{index}}}"), "start", strokes.BLACK, f"label-{id}", ("label",))
    arrow = Group((line, head), id=id, classes=("driver",))
    return Piece({"mechanism": (arrow,)}, (Label(text, (tail, tip), (phase(side),)),))


def found_rates(here: MechanismOnPaper, clear: SenseClearance) -> Piece:
    """Angular velocities and accelerations measured on the drawing."""
    pieces = [Piece({"answers": ()})]
    named = (here.scene.instead_of or here.scene).by_name  # not of bars that stand for cams
    for sign, kind, own, heads in (("ω", "omega", here.sheet.omega, 1), ("α", "alpha", here.sheet.alpha, 2)):
        for link, rate in own.items():
            if not rate.is_own or link not in named or abs(rate.value) < 1e-12:
                continue
            place = clear.arc(_centres_of_turn(here, link, here.ground), RADIUS)
            sense = 1 if rate.value > 0 else -1
            markup, colour = f"{sign}_{{{link}}}", here.colour(link)
            pieces.append(_arc("answers", place, sense, heads, colour, markup, f"{kind}-{link}"))
    return joined(pieces)


def _centres_of_turn(here: MechanismOnPaper, link: str, other: str) -> list[complex]:
    """Where an arc of sense may stand: about the pivot of the link, else about places along it."""
    mine = here.scene.by_name[link].points
    theirs = here.scene.by_name[other].points
    for point in mine:
        if point in theirs and point in here.places:
            return [here.places[point]]
    shape = next((s for s in here.shapes if s.link == link), None)
    if shape is not None and shape.corners:
        return [added_up(shape.corners, 0j) / len(shape.corners)]
    if shape is not None and shape.longest is not None:
        a, b = shape.longest
        return [a + share * (b - a) for share in (0.5, 0.34, 0.66)]
    return [here.sheet.poses[link].origin]


def _arc(
    layer: str, place: tuple[complex, float, float], sense: int, heads: int, colour: str, markup: str, id: str
) -> Piece:
    """An arc at its place (centre, radius, middle direction), with its symbol."""
    centre, radius, middle = place
    parts = symbols.sense_arc(page(centre), radius, middle, sense, colour=colour, heads=heads)
    text = Text(0j, symbol(markup), "start", strokes.BLACK, f"label-{id}", ("label",))
    top = page(centre + radius * complex(math.cos(middle), math.sin(middle)))
    return Piece({layer: (Group(parts, id=id, classes=("sense",)),)}, (Label(text, top, (middle,)),))
