"""The mechanism on paper: the places of its points, links and sliding pairs, the shapes of links, and the relations of
the parts that their drawing needs.

Places are in mm, y up, about the world's origin, until `on_page` turns them.
"""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from graphkin.account.notation import Notation
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import Mark, Step
from graphkin.construction.touching import Touching
from graphkin.drawing.ink import symbols
from graphkin.drawing.ink.primitives import Segment
from graphkin.drawing.ink.strokes import colour_of_link
from graphkin.drawing.ink.symbols import hull
from graphkin.plane import cross, dot
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import Pair

# mm: how far a bar of no fixed length goes on beyond a block, and a slot beyond its pin
PAST_BLOCK, PAST_PIN = 9.0, 8.0
GUIDE_LENGTH = 24.0  # mm of the frame's guide about a block
NEAR = 1e-4  # mm: points so near to a line lie on it
FOOT = {-math.pi / 2: 0.0, 0.0: 0.5, math.pi: 0.5, math.pi / 2: 0.7}  # where feet may point, and how little liked


@dataclass(frozen=True)
class Slider:
    """A sliding pair on paper: the place and the direction of its block, and whether a driver moves it."""

    slide: Pair
    at: complex
    along: complex
    driven: bool


@dataclass(frozen=True)
class LinkShape:
    """The parts of a link on paper (mm): the corners of its area, bars, slots, and the places of its points."""

    link: str
    points: dict[str, complex]
    corners: tuple[complex, ...] = ()
    bars: tuple[Segment, ...] = ()
    slots: tuple[Segment, ...] = ()
    redundant: bool = False

    @cached_property
    def edges(self) -> tuple[Segment, ...]:
        """The edges of its area."""
        return tuple(pairwise((*self.corners, *self.corners[:1])))

    @cached_property
    def segments(self) -> tuple[Segment, ...]:
        """Its straight strokes."""
        return (*self.bars, *self.slots, *self.edges)

    @cached_property
    def longest(self) -> Segment | None:
        return max(self.segments, key=lambda s: abs(s[1] - s[0]), default=None)


@dataclass(frozen=True)
class MechanismOnPaper:
    """A sheet's mechanism with the letters of a convention; places in mm, y up, about the world's origin."""

    sheet: Sheet
    letters: Notation

    @property
    def scene(self) -> Mechanism:
        return self.sheet.scene

    @property
    def ground(self) -> str:
        return self.sheet.scene.frame.name

    @cached_property
    def touching(self) -> Touching:
        """Its higher pairs on paper."""
        return Touching(self.scene, 1.0 / self.sheet.scales.length, self.sheet.poses)

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """The steps that draw it."""
        return self.sheet.of("mechanism")

    def since(self, link: str) -> int | None:
        """The step from which a link is shown: all its points are marked, and it is drawn."""
        steps, last = self.steps, self.stands
        if link == self.ground or last is None:
            return steps[0].number if steps else None
        if link not in self.scene.by_name:
            return last
        drawn = next((step.number for step in steps if link in step.links_drawn), 0)
        return max([drawn, *(self.found.get(point, last) for point in self.scene.by_name[link].points)]) or last

    @cached_property
    def stands(self) -> int | None:
        """The step from which the whole mechanism is shown; parts found later do not belong to it."""
        steps = [step.number for step in self.steps]
        polygons = min((step.number for step in self.sheet.steps if step.diagram != "mechanism"), default=math.inf)
        return max((number for number in steps if number < polygons), default=max(steps, default=None))

    @cached_property
    def found(self) -> Mapping[str, int]:
        """The first step that marks each point of the mechanism."""
        numbers: dict[str, int] = {}
        for step in self.steps:
            for mark in step.each(Mark):
                numbers.setdefault(mark.ref.point, step.number)
        return numbers

    @cached_property
    def shapes(self) -> tuple[LinkShape, ...]:
        """The moving links on paper, in the order of the file, without links that were not reached."""
        slides = tuple(slider for slider in self.sliders if slider.slide.key not in self.replaced_pairs)
        shapes = []
        for link in self.scene.whole.links:
            points = {p: self.places[p] for p in self.scene.own_points(link) if p in self.places}
            if link.redundant and len(points) == len(link.points):
                corners, bars = _spanned(tuple(points.values()))
                shapes.append(LinkShape(link.name, points, corners, bars, redundant=True))
            elif link.name in self.sheet.poses:
                flat = frozenset(b.slide.key for b in self._faces)
                tips = tuple(touch.point for touch in self.touching.cams if touch.cam.follower == link.name)
                shapes.append(_shape(link.name, points, tips, (*slides, *self._faces), flat))
        return tuple(shapes)

    @cached_property
    def replaced_pairs(self) -> frozenset[str]:
        """Keys of the sliding pairs that replace a cam and its follower."""
        return frozenset(pair.key for pair in self.scene.slides) - {pair.key for pair in self.scene.whole.slides}

    @cached_property
    def sliders(self) -> tuple[Slider, ...]:
        """All sliding pairs whose two links are on paper, with pins in slots."""
        sheet = self.sheet
        driven = {d.key for d in self.scene.drivers if not d.turns}
        sliders = []
        for slide in sheet.structure.slides:
            if slide.a in sheet.poses and slide.b in sheet.poses and slide.key not in self.scene.replaced_by:
                along = slide.along(sheet.poses)
                at = sheet.poses[slide.a].origin + self.touching.clearance(slide.key) * along
                sliders.append(Slider(slide, at, along, slide.key in driven))
        return tuple(sliders)

    @cached_property
    def _faces(self) -> tuple[Slider, ...]:
        """The flat faces of moving links as sliders: a contact with the direction of the face."""
        faces = []
        for slide in self.sheet.structure.slides:
            pair = self.scene.replaced_by.get(slide.key)
            at = None if pair is None else self.places.get(pair.name)
            if at is not None and slide.b in self.sheet.poses:
                faces.append(Slider(slide, at, slide.along(self.sheet.poses), False))
        return tuple(faces)

    @cached_property
    def places(self) -> Mapping[str, complex]:
        """The place of each point."""
        return {ref.point: z for ref, z in self.sheet.points.items() if not ref.link}

    @cached_property
    def cylinders(self) -> frozenset[str]:
        """Driven slides that are drawn as cylinder and rod."""
        cylinders = []
        for b in self.sliders:
            if b.driven and b.slide.b != self.ground and not b.slide.higher:
                rod = b.at - self.pivot(b)
                cylinders += [b.slide.key] if abs(cross(rod, b.along)) < 1e-3 and dot(rod, b.along) > 12.0 else []
        return frozenset(cylinders)

    def colour(self, link: str) -> str:
        return colour_of_link(self.scene, link)

    def moving(self, point: str) -> list[str]:
        """The moving links that have a point, redundant ones too."""
        drawn = self.sheet.poses.keys() | {link.name for link in self.scene.links if link.redundant}
        return [n for n in self.scene.holders.get(point, ()) if n != self.ground and n in drawn]

    @cached_property
    def feet(self) -> Mapping[str, float]:
        """The directions of the feet of fixed pivots (rad): down, unless links are in the way."""
        return {point: self._foot(self.places[point]) for point in self.scene.frame.points if self.moving(point)}

    def _foot(self, here: complex) -> float:
        bars = [phase(w) for w in self.ways(here)]

        def cost(angle: float) -> float:
            nearest = min((abs(math.remainder(angle - bar, math.tau)) for bar in bars), default=math.pi)
            end = here + (symbols.FOOT_HEIGHT + 1.0) * rect(1.0, angle)
            covered = sum(_inside(end, shape.corners) for shape in self.shapes)
            return FOOT[angle] + max(0.0, 0.9 - nearest) * 3 + 0.9 * covered

        return min(FOOT, key=cost)

    def ways(self, here: complex) -> list[complex]:
        """Directions in which bars leave a place."""
        directions = []
        for shape in self.shapes:
            for a, b in shape.segments:
                length = abs(b - a)
                if length < 1e-9 or abs(cross(here - a, b - a)) / length > 1.0:
                    continue
                t = dot(here - a, b - a) / length
                if -1.0 <= t < length - 2.0:
                    directions.append(b - a)
                if 2.0 < t <= length + 1.0:
                    directions.append(a - b)
        return directions

    def nested(self, link: str) -> int:
        """The number of larger blocks around the block of a link: two that slide at one pin lie in each other."""
        mine = next(b for b in self.sliders if b.slide.a == link)
        around = [b for b in self.sliders if not b.slide.higher and b.slide.a != link and abs(b.at - mine.at) < 0.5]
        rank = (mine.slide.b != self.ground, self.scene.order.get(link, 0))
        return sum((b.slide.b != self.ground, self.scene.order.get(b.slide.a, 0)) < rank for b in around)

    def pivot(self, b: Slider) -> complex:
        """The place at which the guiding link of a slide is held."""
        link = self.scene.by_name[b.slide.b]
        return next((self.places[p] for p in link.points if p in self.places), self.sheet.poses[b.slide.b].origin)

    def rod(self, b: Slider) -> tuple[complex, complex]:
        """The visible part of a cylinder's rod."""
        pivot = self.pivot(b)
        return pivot + 0.6 * (b.at - pivot), b.at


def _shape(
    name: str, points: dict[str, complex], tips: tuple[complex, ...], slides: tuple[Slider, ...], flat: frozenset[str]
) -> LinkShape:
    anchors = _apart((*points.values(), *tips, *(b.at for b in slides if b.slide.a == name)))
    carried: dict[str, list[Slider]] = {}
    for b in slides:
        if b.slide.b == name:
            carried.setdefault(b.slide.guide.name, []).append(b)
    bars: list[Segment] = []
    slots: list[Segment] = []
    tied: list[complex] = []
    for sliding in carried.values():
        line = sliding[0]
        met = [z for z in anchors if abs(cross(z - line.at, line.along)) < NEAR]
        span = [dot(z - line.at, line.along) for z in met]
        if not met and anchors:
            # a guide that passes by: the link reaches it square from the nearest of its points
            anchor = min(anchors, key=lambda z: abs(cross(z - line.at, line.along)))
            foot = dot(anchor - line.at, line.along)
            bars.append((anchor, line.at + foot * line.along))
            met, span = [anchor], [foot]
        tied += met
        low, high = _reach(sliding, span)
        pins = [b.at for b in sliding if b.slide.higher and b.slide.key not in flat]
        slots += [(pin - PAST_PIN * line.along, pin + PAST_PIN * line.along) for pin in pins]
        # the guide is bar between its slots
        cuts = sorted(dot(pin - line.at, line.along) for pin in pins)
        solid = zip((low, *(t + PAST_PIN for t in cuts)), (*(t - PAST_PIN for t in cuts), high), strict=True)
        bars += [(line.at + a * line.along, line.at + z * line.along) for a, z in solid if not pins or z - a > NEAR]
    loose = [z for z in anchors if z not in tied]
    corners: tuple[complex, ...] = ()
    if not carried or (loose and len(anchors) > 2):
        corners, more = _spanned(anchors)
        bars += more
    elif loose:
        bars += [(z, min((w for w in anchors if w != z), key=lambda w: abs(w - z))) for z in loose if len(anchors) > 1]
    return LinkShape(name, points, corners, tuple(bars), tuple(slots))


def _reach(sliding: list[Slider], span: list[float]) -> tuple[float, float]:
    """The ends of a drawn guide: over the link's points on it and a little beyond all blocks and pins on it."""
    start, along = sliding[0].at, sliding[0].along
    low, high = (min(span), max(span)) if span else (float("inf"), float("-inf"))
    fixed = len(span) > 1
    for b in sliding:
        t = dot(b.at - start, along)
        past = PAST_PIN if b.slide.higher else PAST_BLOCK
        if fixed and low <= t <= high:
            continue
        if not span or t >= high:
            high = max(high, t + past)
        if not span or t <= low:
            low = min(low, t - past)
    return low, high


def _spanned(places: tuple[complex, ...]) -> tuple[tuple[complex, ...], tuple[Segment, ...]]:
    """Corners of the area spanned by places, or a bar along them if they lie on a line."""
    places = _apart(places)
    if len(places) < 2:
        return (), ()
    a, b = max(((p, q) for p in places for q in places), key=lambda pq: abs(pq[0] - pq[1]))
    if all(abs(cross(z - a, b - a)) < 1e-3 * abs(b - a) for z in places):
        return (), ((a, b),)
    return hull(places), ()


def _apart(places: tuple[complex, ...]) -> tuple[complex, ...]:
    """Places without repetitions."""
    kept: list[complex] = []
    for z in places:
        if all(abs(z - w) > NEAR for w in kept):
            kept.append(z)
    return tuple(kept)


def _inside(z: complex, corners: tuple[complex, ...]) -> bool:
    """Whether a place lies in a convex area whose corners run counter-clockwise."""
    return len(corners) > 2 and all(cross(b - a, z - a) > 0 for a, b in pairwise((*corners, corners[0])))
