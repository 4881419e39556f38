"""A polygon as it stands on a page: its vectors and steps, where its pole is, how large it is, which of its parts are
too small for a ruler, how far vectors of one line, which would cover each other, are shifted off their places; and its
points (end points of vectors, feet between components, the pole), each with its letter.
"""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from graphkin.account.end_letters import SAME, Foot, Place, PolygonPoints
from graphkin.account.headings import spoken_ref
from graphkin.account.notation import Letters, pole
from graphkin.construction.scales import SERIES
from graphkin.construction.seen_from import vectors_seen
from graphkin.construction.sheet import DiagramName, Sheet, Step
from graphkin.construction.strokes import Aid, Bar, Mark, Vector
from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import runs_width
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Segment, Stroke, Text, on_page
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.piece import Piece, dated, joined
from graphkin.drawing.text import SMALLEST, plain, symbol
from graphkin.plane import added_up, cross, dot
from graphkin.scene.symbol import PointRef, Symbol

__all__ = [
    "END_RADIUS", "Detail", "PolygonOnPage", "details", "extent",
    "points", "same_place", "side_by_side", "step_number",
]  # fmt: skip

FAR = 60.0  # mm: construction further outside than this is cut off
SMALL = 2.0  # mm: shorter vectors are drawn again larger
TOGETHER = 3.0  # mm: small vectors nearer than this share an inset
SEEN = 0.5  # mm: a vector shorter than this is no vector in an inset either
LONGEST = 13.0  # mm of the largest part in the inset
RING, CLEAR = 0.8, 0.35  # mm from the place to the ring about it, and from a ring to writing
CROWD = 5.0  # how many times larger a crowd is drawn again at most


@dataclass(frozen=True)
class PolygonOnPage:
    """A sheet's polygon with the letters of a convention and the words of a language, its pole at ``origin`` of a page;
    lines known by direction only are clipped to the ``panel``, and ``enlarged`` places are drawn again larger."""

    sheet: Sheet
    diagram: DiagramName
    letters: Letters
    language: str
    panel: Box
    origin: complex
    enlarged: tuple[Detail, ...]

    def at(self, z: complex) -> complex:
        """The page point of a point of the polygon."""
        return self.origin + on_page(z)

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        return tuple(step for step in self.sheet.steps if step.diagram == self.diagram)

    @cached_property
    def vectors(self) -> Mapping[Symbol, tuple[int, Vector]]:
        """Each vector, with the number of the step that drew it last."""
        return {s.symbol: (step.number, s) for step in self.steps for s in step.strokes if isinstance(s, Vector)}

    @cached_property
    def lettered(self) -> PolygonPoints:
        """Its points with their letters; those of special points as far as they lie on the panel."""
        return PolygonPoints(self.sheet, self.diagram, self.letters, lambda z: self.panel.distance(self.at(z)) == 0.0)

    @cached_property
    def ends_since(self) -> Mapping[PointRef, int]:
        """The step that marks the end point of each point first."""
        marks = ((s.ref, step.number) for step in self.steps for s in step.strokes if isinstance(s, Mark))
        return dict(reversed([*marks]))

    def since(self, detail: Detail) -> int:
        """The step from which on a place that is drawn again larger is all there."""
        return detail.crowd or max(self.vectors[vector.symbol][0] for vector in detail.vectors)

    @cached_property
    def shifts(self) -> Mapping[Symbol, complex]:
        """How far (mm on the page) vectors lie off their places, so that they do not cover others."""
        found = side_by_side(vector for _, vector in self.vectors.values())
        return {symbol: on_page(shift) for symbol, shift in found.items()}

    def drawn(self, vector: Vector) -> Segment:
        """Where a vector is drawn on the page."""
        shift = self.shifts.get(vector.symbol, 0j)
        return self.at(vector.tail) + shift, self.at(vector.tip) + shift

    def in_order(self) -> list[tuple[int, Vector]]:
        """Long vectors first, so that short ones lie on top."""
        return sorted(self.vectors.values(), key=lambda sv: (-round(abs(sv[1].span), 6), sv[0]))

    def covered(self, a: complex, b: complex) -> bool:
        """Whether a drawn vector lies from a to b or back."""
        return any(
            (abs(v.tail - a) < SAME and abs(v.tip - b) < SAME) or (abs(v.tail - b) < SAME and abs(v.tip - a) < SAME)
            for _, v in self.vectors.values()
        )


def same_place(z: complex) -> complex:
    """A key that is the same for points that fall together."""
    return complex(round(z.real / SAME), round(z.imag / SAME))


def extent(sheet: Sheet, diagram: DiagramName, within: Box | None = None) -> Box:
    """The box (mm, y down, about the pole) around all vectors of a polygon, trial polygons among them; lines that lead
    to them are counted in where they do not reach far."""
    seen = vectors_seen(sheet, diagram)
    vectors: list[Vector | Aid] = [*sheet.vectors(diagram).values(), *seen, *sheet.trials(diagram)]
    ends = [0j, *(z for v in vectors for z in (v.tail, v.tip))]
    box = Box.around(on_page(z) for z in ends)
    for step in sheet.steps:
        for stroke in step.strokes:
            if step.diagram == diagram and isinstance(stroke, Bar):
                wider = box.joined(Box.around((on_page(stroke.a), on_page(stroke.b))))
                if within is None:
                    fits = max(wider.width - box.width, wider.height - box.height) < FAR
                else:
                    fits = wider.width <= within.width and wider.height <= within.height
                box = wider if fits else box
    return box


@dataclass(frozen=True)
class Detail:
    """A place of a polygon (mm on paper, y up) with its small vectors, or those that end there in a crowd, and how much
    larger they are drawn; of a crowd the step after which it is all there."""

    centre: complex
    radius: float
    vectors: tuple[Vector, ...]
    factor: float
    crowd: int | None = None

    @property
    def ring(self) -> float:
        """Radius of the ring about it, mm."""
        return self.radius + RING

    def strikes(self, centre: complex, box: Box) -> bool:
        """Whether its ring runs through a box or close by, the place being at ``centre`` of the page."""
        farthest = max(abs(corner - centre) for corner in box.corners)
        return box.distance(centre) < self.ring + CLEAR and farthest > self.ring - CLEAR


def details(sheet: Sheet, diagram: DiagramName) -> list[Detail]:
    """The places of a polygon that need a larger drawing."""
    small = [v for v in sheet.vectors(diagram).values() if 0.0 < abs(v.span) < SMALL]
    found = [detail for group in _near(small) for detail in _at_their_scales(group)]
    return sorted(found, key=lambda d: (d.factor, -len(d.vectors), d.centre.real, d.centre.imag))


def crowds(here: PolygonOnPage, crowded: Iterable[Label]) -> list[Detail]:
    """The places around points whose letters, and tips of vectors whose names, find no good place at the size of the
    figure, near ones together; not those that are drawn again larger already."""
    vectors = {f"label-{symbol.id}": vector for symbol, (_, vector) in here.vectors.items()}
    groups: list[list[tuple[complex, tuple[Vector, ...]]]] = []
    for label in crowded:
        vector = vectors.get(label.text.id)
        if vector is not None:
            point = vector.tip
        elif isinstance(label.mark, complex):
            point = on_page(label.mark - here.origin)
        else:
            continue
        if any(abs(point - known.centre) <= known.radius for known in here.enlarged):
            continue
        near = [group for group in groups if any(abs(point - z) < TOGETHER for z, _ in group)]
        own = point, (vector,) if vector else ()
        groups = [group for group in groups if group not in near] + [[own, *(one for group in near for one in group)]]
    return [_crowd(here, group) for group in groups]


def _crowd(here: PolygonOnPage, group: Sequence[tuple[complex, tuple[Vector, ...]]]) -> Detail:
    steps = [step for step, vector in here.vectors.values() if any(abs(vector.tip - z) <= SAME for z, _ in group)]
    last = max(steps, default=here.steps[-1].number)
    box = Box.around(z for z, _ in group)
    size = max(box.width, box.height)
    vectors = tuple(vector for _, own in group for vector in own)
    return Detail(box.centre, max(1.2, 0.75 * size), vectors, min(CROWD, _factor(LONGEST / max(size, 1.0))), last)


def _near(small: Sequence[Vector]) -> list[list[Vector]]:
    """Vectors in groups that lie near each other."""
    groups: list[list[Vector]] = []
    for vector in small:
        near = [g for g in groups if any(_apart(vector, other) < TOGETHER for other in g)]
        merged = [vector, *(v for g in near for v in g)]
        groups = [g for g in groups if g not in near] + [merged]
    return groups


def _at_their_scales(group: Sequence[Vector]) -> Iterator[Detail]:
    """A group drawn larger, and again those of it that are too small even there, at a scale of their own."""
    box = Box.around([z for v in group for z in (v.tail, v.tip)])
    size = max(box.width, box.height)
    factor = _factor(LONGEST / size)
    shown = [v for v in group if abs(v.span) * factor >= SEEN]
    if factor > 1.0 and shown:
        yield Detail(box.centre, max(1.2, 0.75 * size), tuple(shown), factor)
    for smaller in _near([v for v in group if abs(v.span) * factor < SEEN]):
        if len(smaller) < len(group):
            yield from _at_their_scales(smaller)


def _factor(most: float) -> float:
    """The largest of the series 1, 2, 2.5, 5, 10 that is not more; 1 where there is none."""
    decade = 10.0 ** math.floor(math.log10(most))
    return max(1.0, *(float(f"{step * decade:.12g}") for step in SERIES if step * decade <= most * (1 + 1e-12)))


def _apart(a: Vector, b: Vector) -> float:
    return min(abs(p - q) for p in (a.tail, a.tip) for q in (b.tail, b.tip))


APART = 1.0  # mm between two of them
ON_ONE_LINE = 0.3  # mm: nearer to a line than this, an arrow covers what lies there
OVERLAP = 1.0  # mm that two must have in common
LEAST = 2.0  # mm: a shorter vector is drawn again larger


def side_by_side(vectors: Iterable[Vector]) -> Mapping[Symbol, complex]:
    """For each vector that would cover another, or lie under it, its shift square to itself (mm, y up).

    Of those on one line the longest resultant stays; what is equal or opposite lies beside it.
    """
    shown = [v for v in vectors if abs(v.span) >= LEAST]
    shown.sort(key=lambda v: (v.role != "resultant", -round(abs(v.span), 6)))
    lanes: list[tuple[Vector, int]] = []
    shifts: dict[Symbol, complex] = {}
    for vector in shown:
        taken = {lane for other, lane in lanes if _cover(vector, other)}
        lane = next(n for k in range(len(lanes) + 1) for n in ((k, -k) if k else (0,)) if n not in taken)
        lanes.append((vector, lane))
        if lane:
            shifts[vector.symbol] = lane * APART * 1j * _way(vector)
    return shifts


def _way(vector: Vector) -> complex:
    """The direction of the line of a vector, the same for one and its opposite."""
    way = vector.span / abs(vector.span)
    return -way if (round(way.real, 6), round(way.imag, 6)) < (0.0, 0.0) else way


def _cover(one: Vector, two: Vector) -> bool:
    longer, shorter = (one, two) if abs(one.span) >= abs(two.span) else (two, one)
    way = longer.span / abs(longer.span)
    ends = [z - longer.tail for z in (shorter.tail, shorter.tip)]
    if any(abs(cross(way, z)) > ON_ONE_LINE for z in ends):
        return False
    low, high = sorted(dot(way, z) for z in ends)
    return min(high, abs(longer.span)) - max(low, 0.0) > OVERLAP


POLE_RADIUS, END_RADIUS, FOOT_RADIUS, DOT_RING = 0.9, 0.5, 0.4, 0.45
MOST_AT_POLE = 24.0  # mm of names of points at rest beside the letter of the pole


def points(here: PolygonOnPage) -> Piece:
    """All points with what they are called."""
    places = here.lettered.places
    return joined((*_ends(here, places), *_feet(here, here.lettered.feet), _pole(here, places[0])))


def _ends(here: PolygonOnPage, places: Sequence[Place]) -> Iterator[Piece]:
    fixed = set(here.sheet.scene.frame.points)
    for number, place in enumerate(places):
        moving = [ref for ref in place.refs if ref.link or ref.point not in fixed]
        for i, ref in enumerate(moving):
            id = f"{here.diagram}-{ref}".replace("@", "")
            dot = _dot(here.at(place.at), i + (number == 0))
            group = Group((dot,), id=id, classes=("end",), title=spoken_ref(ref, here.language))
            yield dated(Piece({here.diagram: (group,)}, (), (here.at(place.at),)), here.ends_since[ref])
        if number and moving:
            markup = ", ".join(filter(None, (here.letters.end(here.diagram, ref) for ref in moving)))
            names = _named(here, markup, place.at, f"label-{here.diagram}-{moving[0]}", 0, place.at)
            yield dated(Piece(labels=names), here.ends_since[moving[0]])


def _dot(at: complex, ring: int) -> Circle:
    """A dot for the first point of a place, rings round it for those that fall together with it."""
    if ring == 0:
        return Circle(at, END_RADIUS, fill=strokes.BLACK)
    return Circle(at, END_RADIUS + ring * DOT_RING, stroke=Stroke(0.18))


def _feet(here: PolygonOnPage, feet: Sequence[tuple[Foot, str]]) -> Iterator[Piece]:
    """Points between components: where one ends and no end point lies."""
    for foot, markup in feet:
        at, id = here.at(foot.at), f"foot-{foot.symbol.id}"
        if foot.aid and here.panel.distance(at) > 0.0:
            continue
        dot = Group((Circle(at, FOOT_RADIUS, fill=strokes.BLACK),), id=id, classes=("foot",))
        names = _named(here, markup, foot.at, f"label-{id}", 1, foot.at)
        yield dated(Piece({here.diagram: (dot,)}, names, (at,)), foot.step)


def _pole(here: PolygonOnPage, place: Place) -> Piece:
    shown = ", ".join(filter(None, (here.letters.end(here.diagram, ref) for ref in place.refs)))
    letter = pole(here.letters.convention, here.diagram)
    markup = f"{letter} ({shown})" if shown and runs_width(symbol(shown)) < MOST_AT_POLE else letter
    away = -added_up((v.span for _, v in here.vectors.values() if abs(v.tail) < SAME), 0j)
    shape = Circle(here.at(0j), POLE_RADIUS, fill=strokes.WHITE, stroke=strokes.OUTLINE)
    dot = Circle(here.at(0j), 0.3, fill=strokes.BLACK)
    group = Group((shape, dot), id=f"pole-{here.diagram}", classes=("pole",))
    names = _named(here, markup, 0j, f"label-pole-{here.diagram}", 0, away)
    if markup != letter:
        names = tuple(replace(name, key=Text(0j, symbol(letter))) for name in names)
    return dated(Piece({here.diagram: (group,)}, names), here.steps[0].number if here.steps else None)


def _named(here: PolygonOnPage, markup: str, at: complex, id: str, rank: int, away: complex) -> tuple[Label, ...]:
    if not markup:
        return ()
    text = Text(0j, symbol(markup), "start", strokes.BLACK, id.replace("@", ""), ("label",))
    toward = (phase(away),) if abs(away) > SAME else ()
    return (Label(text, here.at(at), toward, rank),)


def step_number(step: int, colour: str = strokes.GREY) -> Text:
    """The number of a step in brackets."""
    return Text(0j, plain(f"({step})", SMALLEST), "start", colour, "", ("step-number",), step)
