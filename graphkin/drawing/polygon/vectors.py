"""The vectors of a polygon, and their names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin.drafting.sheet import Vector
from graphkin.drawing import strokes
from graphkin.drawing.arrows import COMPONENT, RESULTANT, vector_group
from graphkin.drawing.colours import colour_of_vector
from graphkin.drawing.describe import spoken_vector
from graphkin.drawing.layout import Name, Piece
from graphkin.drawing.placing import Label
from graphkin.drawing.polygon.on_page import SAME, ZERO, OnPage, same_place
from graphkin.drawing.primitives import Group, Text
from graphkin.drawing.typeset import symbol

__all__ = ["vector_names", "vectors"]

SHORT = 8.0  # mm: a shorter vector from the pole is named by its end points alone


def vectors(here: OnPage) -> Piece:
    """Every vector as an arrow."""
    return Piece({here.diagram: tuple(_arrow(here, step, vector) for step, vector in here.in_order())})


def _arrow(here: OnPage, step: int, vector: Vector) -> Group:
    return vector_group(
        vector.symbol.id,
        step,
        here.at(vector.tail),
        here.at(vector.tip),
        RESULTANT if vector.role == "resultant" else COMPONENT,
        colour_of_vector(here.sheet, vector.symbol),
        spoken_vector(vector.symbol, here.language),
        classes=(vector.role,),
    )


def vector_names(here: OnPage) -> Piece:
    """One name for vectors that share tail and tip; those of zero length are named in words."""
    named = (_name(here, length, shared) for length, shared in _shared(here))
    return Piece(names=tuple(name for name in named if name))


def _shared(here: OnPage) -> Iterator[tuple[float, list[Vector]]]:
    """Length, and vectors that share tail and tip, the longest first; not those that are drawn again larger."""
    groups: dict[tuple[complex, complex], list[Vector]] = {}
    for _, vector in here.in_order():
        groups.setdefault((same_place(vector.tail), same_place(vector.tip)), []).append(vector)
    elsewhere = {v.symbol for detail in here.enlarged for v in detail.vectors}
    for shared in sorted(groups.values(), key=lambda group: -abs(group[0].span)):
        if shared[0].symbol not in elsewhere:
            yield abs(shared[0].span), sorted(shared, key=lambda v: here.vectors[v.symbol][0])


def _name(here: OnPage, length: float, vectors: Sequence[Vector]) -> Name | None:
    us = here.letters.convention == "us"
    if length < ZERO:
        vectors = [v for v in vectors if v.role != "resultant" or us or abs(v.tip) < SAME]
    if not vectors:
        return None
    first = vectors[0]
    markup = " = ".join(here.letters.vector(v.symbol) for v in vectors)
    id = f"label-{first.symbol.id}"
    if length < ZERO:
        text = Text(0j, symbol(markup + " = 0"), "start", strokes.BLACK, id, ("label",))
        return Name(Label(text, here.at(first.tip)), 3)
    resultants = all(v.role == "resultant" for v in vectors)
    asked = any(v.symbol in here.sheet.scene.find for v in vectors)
    if not us and length < SHORT and resultants and not asked:
        return None  # the letters at its ends say it
    text = Text(0j, symbol(markup), "start", colour_of_vector(here.sheet, first.symbol), id, ("label",))
    return Name(Label(text, (here.at(first.tail), here.at(first.tip))), 2 if resultants and not us else 1)
