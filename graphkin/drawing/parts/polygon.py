"""A polygon on a page: its vectors and steps, its pole, its size, its parts that are too small for a ruler, and the
shifts of collinear vectors that would cover each other; and its drawing: points (end points of vectors, feet between
components, the pole), each with its letter; vectors with their names and the numbers of their steps; and their
construction: direction lines, images of links, carried vectors, trial polygons in line kinds of their own, rings around
details.
"""

from __future__ import annotations

import math
from cmath import phase
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from typing import TypeVar

from graphkin.account.headings import number
from graphkin.account.notation import Notation, pole, unit_of
from graphkin.account.spoken import spoken_ref, spoken_vector
from graphkin.account.voice import SAME, NamedPoint, PolygonPoints
from graphkin.construction.board.scales import SERIES
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import (
    Bar,
    DiagramName,
    Image,
    Mark,
    Ray,
    Step,
    Vector,
)
from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Polygon, Primitive, Segment, Stroke, Text, on_page
from graphkin.drawing.ink.strokes import colour_of_link, colour_of_vector
from graphkin.drawing.ink.symbols import COMPONENT, POINTER, RESULTANT, arrowhead, vector_group
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.numbers import BESIDE, LEAST_NUMBERED, beside_ring, step_number
from graphkin.drawing.place.obstacles import Obstacles
from graphkin.drawing.place.piece import Piece, joined, obstacles_of
from graphkin.drawing.text import LETTER, behind, plain, rich, runs_width, text_box
from graphkin.plane import added_up, cross, dot
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words.symbols import RichText, sign, spaced
from graphkin.words.written import roman

FAR = 60.0  # mm: construction further outside than this is cut off
SMALL = 2.0  # mm: shorter vectors are drawn again larger
LEAST_DRAWN = 0.05  # mm: what is shorter no pencil draws at any scale of use, and is written beside its point
TOGETHER = 3.0  # mm: small vectors nearer than this share an inset
SEEN = 0.5  # mm: a vector shorter than this is no vector in an inset either
LONGEST = 13.0  # mm of the largest part in the inset
RING = 0.8  # mm from the place to the ring about it
NUMERAL = 2.6  # mm: of the letters that a ring and its inset share
CROWD = 5.0  # how many times larger a crowd is drawn again at most


@dataclass(frozen=True)
class PolygonOnPage:
    """A sheet's polygon with the letters of a convention and the words of a language, its pole at ``origin`` of a page;
    lines known by direction only are clipped to the ``panel``."""

    sheet: Sheet
    diagram: DiagramName
    letters: Notation
    language: str
    panel: Box
    origin: complex

    def at(self, z: complex) -> complex:
        """The page point of a point of the polygon."""
        return self.origin + on_page(z)

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        return self.sheet.of(self.diagram)

    @property
    def vectors(self) -> Mapping[Symbol, tuple[int, Vector]]:
        """Each vector, with the number of the step that drew it last."""
        return self.lettered.vectors

    @cached_property
    def colours(self) -> Mapping[Symbol, str]:
        """The colour of each vector."""
        return {symbol: colour_of_vector(self.sheet, symbol) for symbol in self.vectors}

    @cached_property
    def names(self) -> Mapping[Symbol, Label]:
        """A name for vectors that share tail and tip, by the first of them, the longest first; vectors of zero length
        are named in words."""
        letters = {same_place(point.at): point.letter for point in reversed(self.lettered.named)}
        groups: dict[tuple[complex, complex, bool], list[Vector]] = {}
        for _, vector in self.in_order:
            key = same_place(vector.tail), same_place(vector.tip), vector.span == 0.0
            groups.setdefault(key, []).append(vector)
        shared = sorted(groups.values(), key=lambda group: -round(abs(group[0].span), 6))
        named = ((group[0].symbol, _name(self, group, letters)) for group in shared)
        return {symbol: name for symbol, name in named if name is not None}

    @cached_property
    def lettered(self) -> PolygonPoints:
        """Its points with their letters; those of special points only on the panel."""
        return PolygonPoints(self.sheet, self.diagram, self.letters, lambda z: self.panel.distance(self.at(z)) == 0.0)

    @cached_property
    def ends_since(self) -> Mapping[PointRef, int]:
        """The first step that marks the end point of each point."""
        marks = ((s.ref, step.number) for step in self.steps for s in step.each(Mark))
        return dict(reversed([*marks]))

    def since(self, detail: Detail) -> int:
        """The step from which an enlarged place is complete."""
        return detail.crowd or max(self.vectors[vector.symbol][0] for vector in detail.vectors)

    @cached_property
    def shifts(self) -> Mapping[Symbol, complex]:
        """The shifts (mm on the page) of vectors that would cover others."""
        shifts = side_by_side(vector for _, vector in self.vectors.values())
        return {symbol: on_page(shift) for symbol, shift in shifts.items()}

    def drawn(self, vector: Vector) -> Segment:
        """The place of a vector on the page."""
        shift = self.shifts.get(vector.symbol, 0j)
        return self.at(vector.tail) + shift, self.at(vector.tip) + shift

    @cached_property
    def in_order(self) -> Sequence[tuple[int, Vector]]:
        """The vectors with long ones first, so that short ones lie on top."""
        return sorted(self.vectors.values(), key=lambda sv: (-round(abs(sv[1].span), 6), sv[0]))

    def covered(self, a: complex, b: complex) -> bool:
        """Whether a drawn vector lies from a to b or back."""
        return any(
            (abs(v.tail - a) < SAME and abs(v.tip - b) < SAME) or (abs(v.tail - b) < SAME and abs(v.tip - a) < SAME)
            for _, v in self.vectors.values()
        )


def same_place(z: complex) -> complex:
    """A key that coincident points share."""
    return complex(round(z.real / SAME), round(z.imag / SAME))


def extent(sheet: Sheet, diagram: DiagramName, within: Box | None = None) -> Box:
    """The box (mm, y down, about the pole) around all vectors of a polygon and its trial polygons; construction lines
    count if they do not reach far."""
    vectors = [*sheet.vectors[diagram].values(), *sheet.vectors_seen(diagram), *sheet.trials(diagram)]
    ends = [0j, *(z for v in vectors for z in (v.tail, v.tip))]
    box = Box.around(on_page(z) for z in ends)
    for bar in (bar for step in sheet.of(diagram) for bar in step.each(Bar)):
        wider = box.joined(Box.around((on_page(bar.a), on_page(bar.b))))
        if within is None:
            fits = max(wider.width - box.width, wider.height - box.height) < FAR
        else:
            fits = wider.width <= within.width and wider.height <= within.height
        box = wider if fits else box
    return box


@dataclass(frozen=True)
class Detail:
    """A place of a polygon (mm on paper, y up) with its small vectors, or the vectors that end there in a crowd, and
    the factor of their enlargement; of a crowd the step after which it is complete."""

    centre: complex
    radius: float
    vectors: tuple[Vector, ...]
    factor: float
    crowd: int | None = None


def details(sheet: Sheet, diagram: DiagramName) -> list[Detail]:
    """The places of a polygon that need a larger drawing."""
    small = [v for v in sheet.vectors[diagram].values() if LEAST_DRAWN <= abs(v.span) < SMALL]
    places = [detail for group in _together(small, _ends_of) for detail in _at_their_scales(group)]
    return sorted(places, key=lambda d: (d.factor, -len(d.vectors), d.centre.real, d.centre.imag))


def crowds(here: PolygonOnPage, enlarged: Sequence[Detail], crowded: Iterable[Label]) -> list[Detail]:
    """The places around points and tips of vectors whose letters and names find no good place at the size of the
    figure, near ones together; without places that are ``enlarged`` already."""
    vectors = {f"label-{symbol.id}": vector for symbol, (_, vector) in here.vectors.items()}
    spots: list[tuple[complex, Vector | None]] = []
    for label in crowded:
        vector = vectors.get(label.text.id)
        if vector is not None:
            spots.append((vector.tip, vector))
        elif isinstance(label.mark, complex):
            spots.append((on_page(label.mark - here.origin), None))
    fresh = (spot for spot in spots if all(abs(spot[0] - known.centre) > known.radius for known in enlarged))
    return [_crowd(here, group) for group in _together(fresh, lambda spot: spot[:1])]


def _crowd(here: PolygonOnPage, group: Sequence[tuple[complex, Vector | None]]) -> Detail:
    steps = [step for step, vector in here.vectors.values() if any(abs(vector.tip - z) <= SAME for z, _ in group)]
    last = max(steps, default=here.steps[-1].number)
    box = Box.around(z for z, _ in group)
    size = max(box.width, box.height)
    vectors = tuple(vector for _, vector in group if vector is not None)
    return Detail(box.centre, max(1.2, 0.75 * size), vectors, min(CROWD, _factor(LONGEST / max(size, 1.0))), last)


_Thing = TypeVar("_Thing")


def _together(members: Iterable[_Thing], places: Callable[[_Thing], Sequence[complex]]) -> list[list[_Thing]]:
    """Things in groups of neighbours, by the places (mm) of each."""

    def near(first: _Thing, second: _Thing) -> bool:
        return any(abs(p - q) < TOGETHER for p in places(first) for q in places(second))

    groups: list[list[_Thing]] = []
    for member in members:
        joining = [group for group in groups if any(near(member, other) for other in group)]
        groups = [group for group in groups if group not in joining] + [[member, *chain.from_iterable(joining)]]
    return groups


def _at_their_scales(group: Sequence[Vector]) -> Iterator[Detail]:
    """A group drawn larger, and its vectors that are too small even there at a further scale."""
    box = Box.around(chain.from_iterable(map(_ends_of, group)))
    size = max(box.width, box.height)
    factor = _factor(LONGEST / size)
    shown = [v for v in group if abs(v.span) * factor >= SEEN]
    if factor > 1.0 and shown:
        yield Detail(box.centre, max(1.2, 0.75 * size), tuple(shown), factor)
    for smaller in _together((v for v in group if abs(v.span) * factor < SEEN), _ends_of):
        if len(smaller) < len(group):
            yield from _at_their_scales(smaller)


def _factor(most: float) -> float:
    """The largest number of the series 1, 2, 2.5, 5, 10 up to ``most``; 1 if there is none."""
    decade = 10.0 ** math.floor(math.log10(most))
    return max(1.0, *(float(f"{step * decade:.12g}") for step in SERIES if step * decade <= most * (1 + 1e-12)))


def _ends_of(vector: Vector) -> Segment:
    return vector.tail, vector.tip


APART = 1.0  # mm between two of them
ON_ONE_LINE = 0.3  # mm: nearer to a line than this, an arrow covers what lies there
OVERLAP = 1.0  # mm that two must have in common


def side_by_side(vectors: Iterable[Vector]) -> Mapping[Symbol, complex]:
    """For each vector that would cover another, or lie under it, its shift square to itself (mm, y up).

    The longest resultant on a line stays; equal or opposite vectors lie beside it.
    """
    shown = [(v, length) for v in vectors if (length := abs(v.span)) >= SMALL]
    shown.sort(key=lambda pair: (pair[0].role != "resultant", -round(pair[1], 6)))
    lanes: list[tuple[Vector, float, int]] = []
    shifts: dict[Symbol, complex] = {}
    for vector, length in shown:
        taken = {
            lane for other, long, lane in lanes
            if (_covers(vector, length, other) if length >= long else _covers(other, long, vector))
        }
        lane = next(n for k in range(len(lanes) + 1) for n in ((k, -k) if k else (0,)) if n not in taken)
        lanes.append((vector, length, lane))
        if lane:
            shifts[vector.symbol] = lane * APART * 1j * _way(vector)
    return shifts


def _way(vector: Vector) -> complex:
    """The direction of the line of a vector, the same for the opposite vector."""
    direction = vector.span / abs(vector.span)
    return -direction if (round(direction.real, 6), round(direction.imag, 6)) < (0.0, 0.0) else direction


def _covers(longer: Vector, length: float, shorter: Vector) -> bool:
    """Whether a vector of a length lies on a part of a shorter one."""
    along, start, end = longer.span / length, shorter.tail - longer.tail, shorter.tip - longer.tail
    if abs(cross(along, start)) > ON_ONE_LINE or abs(cross(along, end)) > ON_ONE_LINE:
        return False
    low, high = sorted((dot(along, start), dot(along, end)))
    return min(high, length) - max(low, 0.0) > OVERLAP


POLE_RADIUS, END_RADIUS, FOOT_RADIUS, DOT_RING = 0.9, 0.5, 0.4, 0.45
MOST_AT_POLE = 24.0  # mm of names of points at rest beside the letter of the pole


def points(here: PolygonOnPage) -> Piece:
    """All points with their letters."""
    places = here.lettered.places
    return joined((*_ends(here, places), *_feet(here, here.lettered.feet), _pole(here, places[0j])))


def _ends(here: PolygonOnPage, places: Mapping[complex, Sequence[PointRef]]) -> Iterator[Piece]:
    fixed = set(here.sheet.scene.frame.points)
    for order, (at, refs) in enumerate(places.items()):
        moving = [ref for ref in refs if ref.link or ref.point not in fixed]
        for i, ref in enumerate(moving):
            id = f"{here.diagram}-{ref}".replace("@", "")
            dot = _dot(here.at(at), i + (order == 0))
            said, since = spoken_ref(ref, here.language), here.ends_since[ref]
            group = Group((dot,), id=id, classes=("end",), title=said, since=since)
            yield Piece({here.diagram: (group,)}, (), (here.at(at),))
        if order and moving:
            letters = spaced(sign(", "), filter(None, (here.letters.end(here.diagram, ref) for ref in moving)))
            id, since = f"label-{here.diagram}-{moving[0]}", here.ends_since[moving[0]]
            yield Piece(labels=_named(here, letters, at, id, 0, at, since))


def _dot(at: complex, ring: int) -> Circle:
    """A dot for the first point of a place, rings around it for coincident ones."""
    if ring == 0:
        return Circle(at, END_RADIUS, strokes.BLACK)
    return Circle(at, END_RADIUS + ring * DOT_RING, stroke=Stroke(0.18))


def _feet(here: PolygonOnPage, feet: Sequence[NamedPoint]) -> Iterator[Piece]:
    """Points between components: ends of components without an end point."""
    for foot in feet:
        assert foot.symbol is not None
        at, id = here.at(foot.at), f"foot-{foot.symbol.id}"
        if foot.aid and here.panel.distance(at) > 0.0:
            continue
        dot = Group((Circle(at, FOOT_RADIUS, fill=strokes.BLACK),), id=id, classes=("foot",), since=foot.step)
        names = _named(here, foot.letter, foot.at, f"label-{id}", 1, foot.at, foot.step)
        yield Piece({here.diagram: (dot,)}, names, (at,))


def _pole(here: PolygonOnPage, refs: Sequence[PointRef]) -> Piece:
    shown = spaced(sign(", "), filter(None, (here.letters.end(here.diagram, ref) for ref in refs)))
    letter = pole(here.letters.convention, here.diagram)
    name = letter + sign(" (") + shown + sign(")") if shown and runs_width(rich(shown)) < MOST_AT_POLE else letter
    away = -added_up((v.span for _, v in here.vectors.values() if abs(v.tail) < SAME), 0j)
    shape = Circle(here.at(0j), POLE_RADIUS, fill=strokes.WHITE, stroke=strokes.OUTLINE)
    dot = Circle(here.at(0j), 0.3, fill=strokes.BLACK)
    since = here.steps[0].number if here.steps else None
    group = Group((shape, dot), id=f"pole-{here.diagram}", classes=("pole",), since=since)
    names = _named(here, name, 0j, f"label-pole-{here.diagram}", 0, away, since)
    if name != letter:
        names = tuple(replace(label, key=Text(0j, rich(letter))) for label in names)
    return Piece({here.diagram: (group,)}, names)


def _named(
    here: PolygonOnPage, name: RichText, at: complex, id: str, rank: int, away: complex, since: int | None
) -> tuple[Label, ...]:
    if not name:
        return ()
    toward, id = (phase(away),) if abs(away) > SAME else (), id.replace("@", "")
    return (Label.of(rich(name), here.at(at), id, toward=toward, rank=rank, since=since),)


SHADE, SHADED = 0.09, 12.0  # how much of its colour an image has within, from which size (mm) on
BEYOND = 9.0  # mm: how far a direction line runs past the crossing


def polygon_piece(here: PolygonOnPage, enlarged: Sequence[Detail] = (), lines: Piece | None = None) -> Piece:
    """Draw a polygon at its place, its ``lines`` perhaps drawn already; an ``enlarged`` place, drawn again in an inset,
    gets a ring, and its vectors have no names here."""
    elsewhere = {v.symbol for detail in enlarged for v in detail.vectors}
    names = tuple(name for symbol, name in here.names.items() if symbol not in elsewhere)
    areas = Piece({"construction": tuple(rings(here, enlarged))})
    return joined((areas, lines or polygon_lines(here), Piece(labels=names)))


def polygon_lines(here: PolygonOnPage) -> Piece:
    """A polygon without rings and names of vectors, which its enlarged places change."""
    areas, vectors = Piece({"construction": tuple(_images(here))}), Piece({here.diagram: (*_vectors(here),)})
    construction = areas, *trial_marks_in_polygon(here), *_bars(here), *_rays(here)
    return joined((*construction, vectors, points(here)))


def rings(here: PolygonOnPage, enlarged: Sequence[Detail]) -> Iterator[Group]:
    """A ring about each enlarged place."""
    for order, d in enumerate(enlarged, 1):
        ring = Circle(here.at(d.centre), d.radius + RING, stroke=strokes.CONSTRUCTION)
        yield Group((ring,), id=f"ring-{here.diagram}-{order}", classes=("ring",), step=d.crowd, since=here.since(d))


def ring_numerals(rings: Iterable[Group], around: Obstacles, panel: Box) -> Piece:
    """At each ring the numeral that it shares with its inset, where everything ``around`` leaves room; further off with
    a leader."""
    pieces = []
    for order, ring in enumerate(rings, 1):
        (circle,) = ring.children
        assert isinstance(circle, Circle)
        classes, since = ("label", "ring"), ring.since
        text = Text(0j, plain(roman(order), NUMERAL), id=f"label-{ring.id}", classes=classes, since=since)
        box = text_box(text)
        place = beside_ring(box, circle.centre, circle.radius, around, panel)
        if place is not None:
            middle, leader = place
            led = (Group((Line(*leader, strokes.LEADER),), since=since),) if leader else ()
            pieces.append(Piece({"labels": (*led, text._replace(at=middle - box.centre))}))
            around += obstacles_of(pieces[-1].drawn)
    return joined(pieces)


def _images(here: PolygonOnPage) -> Iterator[Primitive]:
    count: Counter[str] = Counter()
    for step in here.steps:
        for image in step.each(Image):
            count[image.link] += 1
            tail = f"-{count[image.link]}" if count[image.link] > 1 else ""
            outline = strokes.CONSTRUCTION.coloured(colour_of_link(here.sheet.scene, image.link))
            corners = tuple(map(here.at, image.corners))
            parts: tuple[Primitive, ...] = (Polygon(corners, "", outline),)
            box = Box.around(corners)
            if not here.panel.holds(box):  # cut at the panel
                edges = (here.panel.clip(a, b) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True))
                parts = tuple(Line(*edge, outline) for edge in edges if edge is not None and edge[0] != edge[1])
            elif max(box.width, box.height) > SHADED:
                parts = (Polygon(corners, strokes.tint(outline.colour, SHADE)), *parts)
            id = f"image-{here.diagram}-{image.link}{tail}"
            yield Group(parts, id=id, classes=("image",), step=step.number)


def _bars(here: PolygonOnPage) -> Iterator[Piece]:
    """Thin straight strokes; a vector added before its turn in the chain has an arrowhead and its name."""
    for step in here.steps:
        for bar in step.each(Bar):
            if abs(bar.b - bar.a) <= SAME or here.covered(bar.a, bar.b):
                continue
            clipped = here.panel.clip(here.at(bar.a), here.at(bar.b))
            if clipped is None:
                continue
            parts: list[Primitive] = [Line(*clipped, strokes.CONSTRUCTION)]
            names: list[Label] = []
            carried, length, tip = step.reason == "before its turn", abs(clipped[1] - clipped[0]), here.at(bar.b)
            if carried and abs(clipped[1] - tip) < SAME and length > 1.0:
                head = min(POINTER.head_length, 0.7 * length)
                parts.append(arrowhead(tip, clipped[1] - clipped[0], head, POINTER.head_width, strokes.BLACK))
            if carried and length > 4.0:
                id = f"label-carried-{step.symbol.id}"
                names.append(_aid_name(here.letters.arrow(step.symbol), clipped, id, 3, step.number))
            drawn = Group(tuple(parts), classes=("construction",), step=step.number)
            yield Piece({"construction": (drawn,)}, tuple(names))


def _rays(here: PolygonOnPage) -> Iterator[Piece]:
    """Lines known by direction only, each named once if several lead to one point."""
    named: set[tuple[RichText, complex]] = set()
    for step in here.steps:
        for ray in step.each(Ray):
            end = ray.to if ray.to is not None else ray.through
            whole, free = _line(here, ray, end)
            names: list[Label] = []
            if free is not None:
                markup = here.letters.direction(ray.direction, here.sheet.scene.frame.name)
                key = (markup, same_place(end))
                if key not in named and abs(free[1] - free[0]) > 1.0:
                    named.add(key)
                    id = f"label-direction-{step.number:02d}"
                    names.append(_aid_name(markup, free, id, 4, step.number, "direction"))
            lines = (Line(*whole, strokes.DIRECTION),) if whole is not None else ()
            drawn = Group(lines, classes=("direction",), step=step.number)
            yield Piece({"construction": (drawn,)}, tuple(names))


def _aid_name(name: RichText, along: Segment, id: str, rank: int, step: int, *classes: str) -> Label:
    """The name of what only helps to draw, from its step on; in a crowd the number of the step replaces it."""
    return Label.of(rich(name, 3.0), along, id, colour=strokes.GREY, rank=rank, classes=classes, since=step,
                    key=step_number(step))


def _line(here: PolygonOnPage, ray: Ray, end: complex) -> tuple[Segment | None, Segment | None]:
    """A ray from its start to beyond its end, and its part without a vector on it."""
    reach = end - ray.through
    e = reach / abs(reach) if abs(reach) > 1.0 else ray.along
    first, last = ray.through, end + BEYOND * e
    free = here.panel.clip(here.at(end), here.at(last))
    if free is None or abs(free[1] - free[0]) < 5.0:
        # no room beyond: the line shows on its other side
        base = ray.through if abs(reach) > 1.0 else end
        behind = here.panel.clip(here.at(base), here.at(base - BEYOND * e))
        if behind is not None:
            free, first, last = behind, base - BEYOND * e, end
    return here.panel.clip(here.at(first), here.at(last)), free


def _vectors(here: PolygonOnPage) -> Iterator[Group]:
    """Every vector as an arrow; one that lies beside its place has thin lines to its true ends."""
    for step, vector in here.in_order:
        tail, tip = here.drawn(vector)
        group = vector_group(
            vector.symbol.id, step, tail, tip, RESULTANT if vector.role == "resultant" else COMPONENT,
            here.colours[vector.symbol], spoken_vector(vector.symbol, here.language), (vector.role,),
        )
        ends = ((here.at(vector.tail), tail), (here.at(vector.tip), tip)) if vector.symbol in here.shifts else ()
        ties = tuple(Line(true, shown, strokes.CONSTRUCTION) for true, shown in ends)
        yield group._replace(children=(*group.children, *ties))


SHORT = 7.0  # mm: beside a shorter vector its name leaves no room for a number, which stands before the name
MANY = 16  # in a polygon of more vectors names have no room for that


def _name(here: PolygonOnPage, group: Sequence[Vector], letters: Mapping[complex, RichText]) -> Label | None:
    """The name of vectors with one tail and tip in the order of their steps; None for short resultants, which share the
    letter of their end.  ``letters`` are those of the points."""
    us = here.letters.convention == "us"
    length = abs(group[0].span)
    short = length < LEAST_DRAWN
    vectors = sorted((v for v in group if not short or v.role != "resultant" or us or abs(v.tip) < SAME),
                     key=lambda v: here.vectors[v.symbol][0])
    if not vectors:
        return None
    first = vectors[0]
    id, step = f"label-{first.symbol.id}", here.vectors[first.symbol][0]
    if short:
        unit, sizes = unit_of(here.sheet, here.diagram), dict[str, list[RichText]]()
        for vector in vectors:
            size = number(abs(vector.span) * here.sheet.scales.of(here.diagram) / unit.si, 4)
            amount = f" = {size} {unit.written}" if vector.span else ""
            sizes.setdefault(amount, []).append(here.letters.vector(vector.symbol))
        name = spaced(", ", (spaced(sign(" = "), same) + (amount or sign(" = 0")) for amount, same in sizes.items()))
        return Label.of(rich(name, LETTER), here.at(first.tip), id, rank=3, since=step, key=step_number(step))
    name = spaced(sign(" = "), (here.letters.arrow(v.symbol) for v in vectors))
    resultants = all(v.role == "resultant" for v in vectors)
    colour = here.colours[first.symbol]
    runs = rich(name)
    key = step_number(step, colour)
    numbered = LEAST_NUMBERED <= length < SHORT and len(here.vectors) <= MANY
    ends = [letters.get(same_place(end), RichText()) for end in (first.tail, first.tip)]
    return Label.of(
        behind(key.runs, runs, BESIDE) if numbered else runs, here.drawn(first), id, colour=colour,
        rank=2 if resultants and not us else 1, step=step if numbered else None, since=step, key=key,
        between=spaced(sign("→"), ends) if all(ends) else "",
    )


def trial_marks_in_polygon(here: PolygonOnPage) -> Iterator[Piece]:
    """Trial polygons, each in its own kind of line and with its number at its letters; vectors to special points."""
    held = {step.held for step in here.steps if step.reason == "seen from"}
    for step in here.steps:
        vectors = [aid for aid in step.auxiliary if abs(aid.span) > SAME]
        if not vectors:
            continue
        trial = vectors[0].trial
        stroke = strokes.TRIALS[(trial - 1) % len(strokes.TRIALS)] if trial else strokes.CONSTRUCTION
        parts: list[Primitive] = []
        labels: list[Label] = []
        named: set[complex] = set()
        for aid in vectors:
            clipped = here.panel.clip(here.at(aid.tail), here.at(aid.tip))
            if clipped is None or (not trial and here.covered(aid.tail, aid.tip)):
                continue
            parts.append(Line(*clipped, stroke))
            whole = abs(clipped[1] - here.at(aid.tip)) < SAME
            if whole and abs(aid.tip - aid.tail) > 2.5:
                parts.append(arrowhead(here.at(aid.tip), clipped[1] - clipped[0], 1.6, 0.6, strokes.GREY))
            of, to = aid.symbol.of, aid.symbol.to
            of_one_point = of is not None and to is not None and of.point == to.point
            if not trial and (of_one_point or aid.symbol.seen) and abs(clipped[1] - clipped[0]) > 4.0:
                rank, id = 3 if to and to.link in held else 4, f"label-special-{aid.symbol.id}"
                labels.append(_aid_name(here.letters.arrow(aid.symbol), clipped, id, rank, step.number))
            if trial and whole and to is None and of is not None and same_place(aid.tip) not in named:
                named.add(same_place(aid.tip))
                letter = here.letters.end(here.diagram, of)
                if letter:
                    *before, last = letter.atoms
                    numbered = RichText(*before, last._replace(sup=sign(roman(trial)).atoms))
                    name = f"label-trial-{here.diagram}-{trial}-{aid.symbol.id}"
                    labels.append(Label.of(rich(numbered, 2.5), here.at(aid.tip), name, colour=strokes.GREY,
                            toward=(phase(clipped[1] - clipped[0]),), rank=5, classes=("trial",), since=step.number))
        classes = (f"trial-{trial}",) if trial else ("special",)
        drawn = Group(tuple(parts), classes=classes, step=step.number)
        yield Piece({"construction": (drawn,)}, tuple(labels))
