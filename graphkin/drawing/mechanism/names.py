"""What links and guides are called, beside them."""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Iterator

from graphkin.drawing import strokes
from graphkin.drawing.layout import Name, Piece
from graphkin.drawing.mechanism.on_paper import OnPaper, page
from graphkin.drawing.placing import Label
from graphkin.drawing.primitives import Text
from graphkin.drawing.shapes import GUIDE_LENGTH
from graphkin.drawing.typeset import plain, symbol

__all__ = ["link_names"]


def link_names(here: OnPaper) -> Piece:
    """Numbers of the links, letters of the guides that the equations speak of, the number of the frame."""
    return Piece(names=(*_numbers(here), *_guides(here), *_frame(here)))


def _number(link: str, colour: str) -> Text:
    return Text(0j, plain(link, bold=True), "start", colour, f"label-link-{link}", ("label", "link-number"))


def _numbers(here: OnPaper) -> Iterator[Name]:
    for shape in here.shapes:
        text = _number(shape.link, here.colour(shape.link))
        whole = _cylinder_part(here, shape.link) or shape.longest
        block = next((b.at for b in here.bearings if b.slide.a == shape.link), None)
        if whole is not None:
            yield Name(Label(text, (page(whole[0]), page(whole[1]))), 1)
        elif block is not None:
            yield Name(Label(text, page(block)), 1)


def _cylinder_part(here: OnPaper, link: str) -> tuple[complex, complex] | None:
    """The barrel or the rod of a cylinder."""
    for b in here.bearings:
        if b.slide.key in here.cylinders and link in (b.slide.a, b.slide.b):
            rod = here.rod(b)
            return (here.pivot(b), rod[0]) if link == b.slide.b else rod
    return None


def _guides(here: OnPaper) -> Iterator[Name]:
    written = {
        name for step in here.sheet.equations for side in step.sides for term in side
        if term.direction and len(term.direction.names) == 1 for name in term.direction.names
    }  # fmt: skip
    for b in here.bearings:
        if b.slide.guide.name in written:
            written.discard(b.slide.guide.name)
            edge = GUIDE_LENGTH / 2 if b.slide.b == here.ground else 7.0
            letter = symbol(here.letters.guide(b.slide.guide.name, here.ground), 3.0)
            id = f"label-guide-{b.slide.b}-{b.slide.guide.name}"
            text = Text(0j, letter, "start", strokes.BLACK, id, ("label",))
            yield Name(Label(text, page(b.at + edge * b.along), (phase(b.along),)), 1)


def _frame(here: OnPaper) -> Iterator[Name]:
    pivots = [p for p in here.scene.frame.points if here.moving(p)]
    spots = [here.places[p] for p in pivots]
    spots += [b.at for b in here.bearings if here.ground in (b.slide.b, b.slide.a)]
    if spots:
        foot = here.foot(pivots[0]) if pivots else 0.0
        away = complex(math.cos(foot), math.sin(foot)) * 5 if pivots else 3.6j
        yield Name(Label(_number(here.ground, strokes.BLACK), page(spots[0] + away), (phase(away),)), 1)
