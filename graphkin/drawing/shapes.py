"""What a link of a mechanism looks like on paper: bars, areas, guides and slots, from its pose and its pairs."""

from __future__ import annotations

from dataclasses import dataclass

from graphkin.construction.sheet import Sheet
from graphkin.plane import cross, dot
from graphkin.scene.model import SlideDriver
from graphkin.structure import Slide

__all__ = ["GUIDE_LENGTH", "Bearing", "Shape", "bearings", "shapes"]

Segment = tuple[complex, complex]

# mm: how far a bar of no fixed length goes on beyond a block, and a slot beyond its pin
PAST_BLOCK, PAST_PIN = 9.0, 8.0
GUIDE_LENGTH = 24.0  # mm of the frame's guide about a block
NEAR = 1e-4  # mm: points so near to a line lie on it


@dataclass(frozen=True)
class Bearing:
    """A sliding pair on paper: where its block stands and along which direction, and whether a driver moves it."""

    slide: Slide
    at: complex
    along: complex
    driven: bool


@dataclass(frozen=True)
class Shape:
    """The parts of one link on paper (mm): the corners of its area, bars, slots, and where its points are."""

    link: str
    points: dict[str, complex]
    corners: tuple[complex, ...] = ()
    bars: tuple[Segment, ...] = ()
    slots: tuple[Segment, ...] = ()
    redundant: bool = False

    @property
    def segments(self) -> tuple[Segment, ...]:
        """Everything straight in it."""
        edges = zip(self.corners, (*self.corners[1:], *self.corners[:1]), strict=True)
        return (*self.bars, *self.slots, *edges)

    @property
    def longest(self) -> Segment | None:
        return max(self.segments, key=lambda s: abs(s[1] - s[0]), default=None)


def bearings(sheet: Sheet) -> tuple[Bearing, ...]:
    """All sliding pairs whose two links stand on paper, pins in slots too."""
    driven = {d.key for d in sheet.scene.drivers if isinstance(d, SlideDriver)}
    return tuple(
        Bearing(
            slide, sheet.poses[slide.a].origin, sheet.poses[slide.b].axis * slide.guide.direction, slide.key in driven
        )
        for slide in sheet.structure.slides
        if slide.a in sheet.poses and slide.b in sheet.poses
    )


def shapes(sheet: Sheet) -> tuple[Shape, ...]:
    """The moving links on paper, in the order of the file; links that were not reached are left out."""
    places = {ref.point: z for ref, z in sheet.points.items() if not ref.link}
    slides = bearings(sheet)
    found = []
    for link in sheet.scene.links:
        points = {p: places[p] for p in link.points if p in places}
        if link.redundant and len(points) == len(link.points):
            corners, bars = _spanned(tuple(points.values()))
            found.append(Shape(link.name, points, corners, bars, redundant=True))
        elif link.name in sheet.poses:
            found.append(_shape(link.name, points, slides))
    return tuple(found)


def _shape(name: str, points: dict[str, complex], slides: tuple[Bearing, ...]) -> Shape:
    anchors = _apart((*points.values(), *(b.at for b in slides if b.slide.a == name)))
    carried: dict[str, list[Bearing]] = {}
    for b in slides:
        if b.slide.b == name:
            carried.setdefault(b.slide.guide.name, []).append(b)
    bars: list[Segment] = []
    slots: list[Segment] = []
    tied: list[complex] = []
    for on_it in carried.values():
        line = on_it[0]
        met = [z for z in anchors if abs(cross(z - line.at, line.along)) < NEAR]
        span = [dot(z - line.at, line.along) for z in met]
        if not met and anchors:
            # a guide that passes by: the link reaches it square from the nearest of its points
            anchor = min(anchors, key=lambda z: abs(cross(z - line.at, line.along)))
            foot = dot(anchor - line.at, line.along)
            bars.append((anchor, line.at + foot * line.along))
            met, span = [anchor], [foot]
        tied += met
        low, high = _reach(on_it, span)
        bars += [(line.at + a * line.along, line.at + z * line.along) for a, z in _solid(on_it, low, high)]
        for b in on_it:
            if b.slide.slot:
                slots.append((b.at - PAST_PIN * line.along, b.at + PAST_PIN * line.along))
    loose = [z for z in anchors if z not in tied]
    corners: tuple[complex, ...] = ()
    if not carried or (loose and len(anchors) > 2):
        corners, more = _spanned(anchors)
        bars += more
    elif loose:
        bars += [(z, min((w for w in anchors if w != z), key=lambda w: abs(w - z))) for z in loose if len(anchors) > 1]
    return Shape(name, points, corners, tuple(bars), tuple(slots))


def _reach(on_it: list[Bearing], span: list[float]) -> tuple[float, float]:
    """From where to where a guide is drawn: over the link's points on it and a little beyond all that runs on it."""
    start, along = on_it[0].at, on_it[0].along
    low, high = (min(span), max(span)) if span else (float("inf"), float("-inf"))
    fixed = len(span) > 1
    for b in on_it:
        t = dot(b.at - start, along)
        past = PAST_PIN if b.slide.slot else PAST_BLOCK
        if fixed and low <= t <= high:
            continue
        if not span or t >= high:
            high = max(high, t + past)
        if not span or t <= low:
            low = min(low, t - past)
    return low, high


def _solid(on_it: list[Bearing], low: float, high: float) -> list[tuple[float, float]]:
    """The stretches of a guide that are bar, the slots taken out."""
    start, along = on_it[0].at, on_it[0].along
    solid = [(low, high)]
    for b in on_it:
        if b.slide.slot:
            t = dot(b.at - start, along)
            cut = (t - PAST_PIN, t + PAST_PIN)
            solid = [
                (x, y)
                for a, z in solid
                for x, y in ((a, min(z, cut[0])), (max(a, cut[1]), z))
                if y - x > NEAR
            ]
    return solid


def _spanned(places: tuple[complex, ...]) -> tuple[tuple[complex, ...], tuple[Segment, ...]]:
    """Corners of the area spanned by places, or one bar along them where they lie on a line."""
    places = _apart(places)
    if len(places) < 2:
        return (), ()
    a, b = max(((p, q) for p in places for q in places), key=lambda pq: abs(pq[0] - pq[1]))
    if all(abs(cross(z - a, b - a)) < 1e-3 * abs(b - a) for z in places):
        return (), ((a, b),)
    return _hull(places), ()


def _apart(places: tuple[complex, ...]) -> tuple[complex, ...]:
    """Places without those that repeat another."""
    kept: list[complex] = []
    for z in places:
        if all(abs(z - w) > NEAR for w in kept):
            kept.append(z)
    return tuple(kept)


def _hull(places: tuple[complex, ...]) -> tuple[complex, ...]:
    """Convex hull, counter-clockwise.  Andrew, Another efficient algorithm for convex hulls (1979)."""
    ordered = sorted(places, key=lambda z: (z.real, z.imag))
    hull: list[complex] = []
    for chain in (ordered, ordered[::-1]):
        half: list[complex] = []
        for z in chain:
            while len(half) > 1 and cross(half[-1] - half[-2], z - half[-2]) <= 0:
                half.pop()
            half.append(z)
        hull += half[:-1]
    return tuple(hull)
