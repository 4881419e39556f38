"""What leads to the vectors of a polygon: direction lines, images of links, carried vectors, rings around details."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from graphkin.drafting.sheet import Bar, Image, Ray, Step
from graphkin.drawing import strokes
from graphkin.drawing.arrows import POINTER, arrowhead
from graphkin.drawing.colours import colour_of_link
from graphkin.drawing.layout import Name, Piece, joined
from graphkin.drawing.placing import Label
from graphkin.drawing.polygon.on_page import SAME, OnPage, same_place
from graphkin.drawing.primitives import Circle, Group, Line, Polygon, Primitive, Text
from graphkin.drawing.typeset import symbol
from graphkin.scene.symbol import Symbol

__all__ = ["construction"]

BEYOND = 9.0  # mm: how far a direction line runs past the crossing
Segment = tuple[complex, complex]


def construction(here: OnPage) -> Piece:
    """Everything thin, with its names."""
    return joined((Piece({"construction": (*_rings(here), *_images(here))}), *_bars(here), *_rays(here)))


def _rings(here: OnPage) -> Iterator[Primitive]:
    for number, d in enumerate(here.enlarged, 1):
        ring = Circle(here.at(d.centre), d.radius + 0.8, stroke=strokes.CONSTRUCTION)
        yield Group((ring,), id=f"ring-{here.diagram}-{number}", classes=("ring",))


def _images(here: OnPage) -> Iterator[Primitive]:
    count: Counter[str] = Counter()
    for step in here.steps:
        for image in (s for s in step.strokes if isinstance(s, Image)):
            count[image.link] += 1
            tail = f"-{count[image.link]}" if count[image.link] > 1 else ""
            outline = strokes.CONSTRUCTION.coloured(colour_of_link(here.sheet.scene, image.link))
            shape = Polygon(tuple(map(here.at, image.corners)), "", outline)
            yield Group((shape,), id=f"image-{here.diagram}-{image.link}{tail}", classes=("image", _class(step)))


def _bars(here: OnPage) -> Iterator[Piece]:
    for step in here.steps:
        for bar in (s for s in step.strokes if isinstance(s, Bar)):
            if abs(bar.b - bar.a) <= SAME or here.covered(bar.a, bar.b):
                continue
            clipped = here.panel.clip(here.at(bar.a), here.at(bar.b))
            if clipped is None:
                continue
            parts: list[Primitive] = [Line(*clipped, strokes.CONSTRUCTION)]
            names: list[Name] = []
            if step.phrase.key == "carry":
                parts += _head(clipped, here.at(bar.b))
                names += _carried(here, step.phrase.args[0], clipped)
            yield Piece({"construction": (Group(tuple(parts), classes=("construction", _class(step))),)}, tuple(names))


def _head(line: Segment, tip: complex) -> Iterator[Primitive]:
    """The arrowhead of a vector added before its turn in the chain."""
    length = abs(line[1] - line[0])
    if abs(line[1] - tip) < SAME and length > 1.0:
        head = min(POINTER.head_length, 0.7 * length)
        yield arrowhead(tip, line[1] - line[0], head, POINTER.head_width, strokes.BLACK)


def _carried(here: OnPage, moved: object, line: Segment) -> Iterator[Name]:
    if isinstance(moved, Symbol) and abs(line[1] - line[0]) > 4.0:
        markup = symbol(here.letters.vector(moved), 3.0)
        yield Name(Label(Text(0j, markup, "start", strokes.GREY, f"label-carried-{moved.id}", ("label",)), line), 4)


def _rays(here: OnPage) -> Iterator[Piece]:
    """Lines known by direction only, each named once where several lead to one point."""
    named: set[tuple[str, complex]] = set()
    for step in here.steps:
        for ray in (s for s in step.strokes if isinstance(s, Ray)):
            end = ray.to if ray.to is not None else ray.through
            leading, beyond = _lines(here, ray, end)
            names: list[Name] = []
            if beyond is not None:
                markup = here.letters.direction(ray.direction, here.sheet.scene.frame.name)
                key = (markup, same_place(end))
                if key not in named and abs(beyond[1] - beyond[0]) > 1.0:
                    named.add(key)
                    id = f"label-direction-{step.number:02d}"
                    text = Text(0j, symbol(markup, 3.0), "start", strokes.GREY, id, ("label", "direction"))
                    names.append(Name(Label(text, beyond), 4))
            lines = tuple(Line(*line, strokes.DIRECTION) for line in (leading, beyond) if line is not None)
            yield Piece({"construction": (Group(lines, classes=("direction", _class(step))),)}, tuple(names))


def _lines(here: OnPage, ray: Ray, end: complex) -> tuple[Segment | None, Segment | None]:
    """The part of a ray that leads to its end, if no vector lies there, and the part beyond it, as far as they show."""
    way = end - ray.through
    e = way / abs(way) if abs(way) > 1.0 else ray.along
    first = ray.through if not here.covered(ray.through, end) else end
    beyond = here.panel.clip(here.at(end), here.at(end + BEYOND * e))
    if beyond is None or abs(beyond[1] - beyond[0]) < 5.0:
        # no room beyond: the line shows on its other side
        base = ray.through if abs(way) > 1.0 else end
        beyond = here.panel.clip(here.at(base), here.at(base - BEYOND * e)) or beyond
    leading = here.panel.clip(here.at(first), here.at(end)) if abs(first - end) > SAME else None
    return leading, beyond


def _class(step: Step) -> str:
    return f"step-{step.number:02d}"
