"""The drawn polygon: its vectors with their names and the numbers of their steps, its points, and what leads to them:
direction lines, images of links, carried vectors, rings around details."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from graphkin.account.end_letters import SAME
from graphkin.account.headings import spoken_vector
from graphkin.construction.polygon_acts import Carried
from graphkin.construction.strokes import Bar, Image, Ray, Vector
from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import text_box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Polygon, Primitive, Segment, Text
from graphkin.drawing.ink.strokes import colour_of_link, colour_of_vector
from graphkin.drawing.ink.symbols import COMPONENT, POINTER, RESULTANT, arrowhead, vector_group
from graphkin.drawing.parts.polygon_on_page import PolygonOnPage, points, same_place, step_number
from graphkin.drawing.parts.trial_marks import trial_marks_in_polygon
from graphkin.drawing.place.labels import Label, Obstacles
from graphkin.drawing.place.obstacles import first_free
from graphkin.drawing.place.piece import Piece, dated, joined
from graphkin.drawing.text import symbol
from graphkin.scene.symbol import Symbol

__all__ = ["polygon_piece", "rings", "step_numbers"]

SHADE, SHADED = 0.09, 12.0  # how much of its colour an image has within, from which size (mm) on
BEYOND = 9.0  # mm: how far a direction line runs past the crossing


def polygon_piece(here: PolygonOnPage) -> Piece:
    """Draw a polygon at its place; what is drawn again larger gets a ring, and its vectors no names here."""
    return joined((_construction(here), _vectors(here), points(here), _vector_names(here)))


def _construction(here: PolygonOnPage) -> Piece:
    """Everything thin, with its names."""
    shapes = Piece({"construction": (*rings(here), *_images(here))})
    return joined((shapes, *trial_marks_in_polygon(here), *_bars(here), *_rays(here)))


def rings(here: PolygonOnPage) -> Iterator[Group]:
    """A ring about each place that is drawn again larger."""
    for number, d in enumerate(here.enlarged, 1):
        ring = Circle(here.at(d.centre), d.ring, stroke=strokes.CONSTRUCTION)
        yield Group((ring,), id=f"ring-{here.diagram}-{number}", classes=("ring",), step=d.crowd, since=here.since(d))


def _images(here: PolygonOnPage) -> Iterator[Primitive]:
    count: Counter[str] = Counter()
    for step in here.steps:
        for image in (s for s in step.strokes if isinstance(s, Image)):
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
    for step in here.steps:
        for bar in (s for s in step.strokes if isinstance(s, Bar)):
            if abs(bar.b - bar.a) <= SAME or here.covered(bar.a, bar.b):
                continue
            clipped = here.panel.clip(here.at(bar.a), here.at(bar.b))
            if clipped is None:
                continue
            parts: list[Primitive] = [Line(*clipped, strokes.CONSTRUCTION)]
            names: list[Label] = []
            if isinstance(step.act, Carried):
                parts += _head(clipped, here.at(bar.b))
                names += _carried(here, step.act.symbol, clipped)
            drawn = Group(tuple(parts), classes=("construction",), step=step.number)
            yield dated(Piece({"construction": (drawn,)}, tuple(names)), step.number)


def _head(line: Segment, tip: complex) -> Iterator[Primitive]:
    """The arrowhead of a vector added before its turn in the chain."""
    length = abs(line[1] - line[0])
    if abs(line[1] - tip) < SAME and length > 1.0:
        head = min(POINTER.head_length, 0.7 * length)
        yield arrowhead(tip, line[1] - line[0], head, POINTER.head_width, strokes.BLACK)


def _carried(here: PolygonOnPage, moved: Symbol, line: Segment) -> Iterator[Label]:
    if abs(line[1] - line[0]) > 4.0:
        markup = symbol(here.letters.arrow(moved), 3.0)
        yield Label(Text(0j, markup, "start", strokes.GREY, f"label-carried-{moved.id}", ("label",)), line, rank=4)


def _rays(here: PolygonOnPage) -> Iterator[Piece]:
    """Lines known by direction only, each named once where several lead to one point."""
    named: set[tuple[str, complex]] = set()
    for step in here.steps:
        for ray in (s for s in step.strokes if isinstance(s, Ray)):
            end = ray.to if ray.to is not None else ray.through
            whole, free = _line(here, ray, end)
            names: list[Label] = []
            if free is not None:
                markup = here.letters.direction(ray.direction, here.sheet.scene.frame.name)
                key = (markup, same_place(end))
                if key not in named and abs(free[1] - free[0]) > 1.0:
                    named.add(key)
                    id = f"label-direction-{step.number:02d}"
                    text = Text(0j, symbol(markup, 3.0), "start", strokes.GREY, id, ("label", "direction"))
                    names.append(Label(text, free, rank=4, key=step_number(step.number)))
            lines = (Line(*whole, strokes.DIRECTION),) if whole is not None else ()
            drawn = Group(lines, classes=("direction",), step=step.number)
            yield dated(Piece({"construction": (drawn,)}, tuple(names)), step.number)


def _line(here: PolygonOnPage, ray: Ray, end: complex) -> tuple[Segment | None, Segment | None]:
    """A ray from its start to beyond its end, and the part of it on which no vector comes to lie."""
    way = end - ray.through
    e = way / abs(way) if abs(way) > 1.0 else ray.along
    first, last = ray.through, end + BEYOND * e
    beyond = here.panel.clip(here.at(end), here.at(last))
    if beyond is None or abs(beyond[1] - beyond[0]) < 5.0:
        # no room beyond: the line shows on its other side
        base = ray.through if abs(way) > 1.0 else end
        behind = here.panel.clip(here.at(base), here.at(base - BEYOND * e))
        if behind is not None:
            beyond, first, last = behind, base - BEYOND * e, end
    return here.panel.clip(here.at(first), here.at(last)), beyond


def _vectors(here: PolygonOnPage) -> Piece:
    """Every vector as an arrow."""
    return Piece({here.diagram: tuple(_arrow(here, step, vector) for step, vector in here.in_order())})


def _arrow(here: PolygonOnPage, step: int, vector: Vector) -> Group:
    tail, tip = here.drawn(vector)
    group = vector_group(
        vector.symbol.id,
        step,
        tail,
        tip,
        RESULTANT if vector.role == "resultant" else COMPONENT,
        colour_of_vector(here.sheet, vector.symbol),
        spoken_vector(vector.symbol, here.language),
        classes=(vector.role,),
    )
    if vector.symbol not in here.shifts:
        return group
    true = here.at(vector.tail), here.at(vector.tip)
    ties = tuple(Line(z, w, strokes.CONSTRUCTION) for z, w in zip(true, (tail, tip), strict=True))
    return replace(group, children=(*group.children, *ties))


def _vector_names(here: PolygonOnPage) -> Piece:
    """One name for vectors that share tail and tip; those of zero length are named in words."""
    letters = {same_place(point.at): point.letter for point in reversed(here.lettered.named)}
    named = (_name(here, length, shared, letters) for length, shared in _shared(here))
    return Piece(labels=tuple(name for name in named if name))


def _shared(here: PolygonOnPage) -> Iterator[tuple[float, list[Vector]]]:
    """Length, and vectors that share tail and tip, the longest first; not those that are drawn again larger."""
    groups: dict[tuple[complex, complex, bool], list[Vector]] = {}
    for _, vector in here.in_order():
        key = same_place(vector.tail), same_place(vector.tip), vector.span == 0.0
        groups.setdefault(key, []).append(vector)
    elsewhere = {v.symbol for detail in here.enlarged for v in detail.vectors}
    for shared in sorted(groups.values(), key=lambda group: -round(abs(group[0].span), 6)):
        if shared[0].symbol not in elsewhere:
            yield abs(shared[0].span), sorted(shared, key=lambda v: here.vectors[v.symbol][0])


def _name(
    here: PolygonOnPage, length: float, vectors: Sequence[Vector], letters: Mapping[complex, str]
) -> Label | None:
    us = here.letters.convention == "us"
    if length == 0.0:
        vectors = [v for v in vectors if v.role != "resultant" or us or abs(v.tip) < SAME]
    if not vectors:
        return None
    first = vectors[0]
    written = here.letters.vector if length == 0.0 else here.letters.arrow
    markup = " = ".join(written(v.symbol) for v in vectors)
    id, step = f"label-{first.symbol.id}", here.vectors[first.symbol][0]
    if length == 0.0:
        text = Text(0j, symbol(markup + " = 0"), "start", strokes.BLACK, id, ("label",), since=step)
        return Label(text, here.at(first.tip), rank=3, key=step_number(step))
    resultants = all(v.role == "resultant" for v in vectors)
    text = Text(0j, symbol(markup), "start", colour_of_vector(here.sheet, first.symbol), id, ("label",), since=step)
    key = step_number(step, text.colour)
    ends = [letters.get(same_place(end), "") for end in (first.tail, first.tip)]
    between = "→".join(ends) if all(ends) else ""
    return Label(text, here.drawn(first), rank=2 if resultants and not us else 1, key=key, between=between)


LEAST = 5.0  # mm: a shorter vector has no room for a number
OFF = 0.9  # mm from the vector to its number
CLEAR = 0.35  # mm around a number
BESIDE = 0.5  # mm from a name to the number beside it
# Along the vector, in the order of liking.
SHARES = np.array((0.5, 0.38, 0.62, 0.26, 0.74, 0.16, 0.84, 0.44, 0.56, 0.32, 0.68, 0.2, 0.8, 0.1, 0.9))


def step_numbers(
    arrows: Sequence[tuple[int, Segment, Box | None]], panel: Box, around: Obstacles
) -> tuple[Text, ...]:
    """A number in brackets beside each arrow, or beside its name, where there is room.

    Parameters
    ----------
    arrows : number of the step, tail and tip (page points, mm), and the box of the name
    around : everything drawn and written
    """
    shown = [arrow for arrow in arrows if abs(arrow[1][1] - arrow[1][0]) >= LEAST]
    if not shown:
        return ()
    texts = [step_number(step) for step, _, _ in shown]
    boxes = [text_box(text) for text in texts]
    half = np.array([complex(box.width, box.height) / 2 for box in boxes])
    tails, tips = (np.array([ends[k] for _, ends, _ in shown]) for k in (0, 1))
    way = (tips - tails) / np.abs(tips - tails)
    off = OFF + np.abs(way.imag) * half.real + np.abs(way.real) * half.imag
    sides = np.array((1.0, -1.0))
    along = tails[:, None] + (tips - tails)[:, None] * SHARES
    by_vectors = (along[:, :, None] + (1j * way * off)[:, None, None] * sides).reshape(len(shown), -1)
    by_names = [_by_name(name, size) for (_, _, name), size in zip(shown, half.tolist(), strict=True)]
    places = np.hstack((by_vectors, np.array(by_names)))
    found = first_free([*places], half.tolist(), around, CLEAR, panel)
    return tuple(
        replace(text, at=complex(row[i]) - box.centre)
        for text, box, row, i in zip(texts, boxes, places, found, strict=True) if i is not None
    )  # fmt: skip


def _by_name(name: Box | None, half: complex) -> tuple[complex, ...]:
    """Places for the middle of a number beside a name, nan of none."""
    if name is None:
        return (complex(np.nan, np.nan),) * 4
    middle, x, y = name.centre, name.width / 2 + BESIDE + half.real, name.height / 2 + BESIDE + half.imag
    return middle - x, middle + x, middle + 1j * y, middle - 1j * y
