"""Putting a figure together: pieces with what they draw by layer and the labels they ask for; pieces joined, moved,
measured and cut.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import (
    Arc,
    Circle,
    Group,
    Line,
    Polygon,
    Polyline,
    Primitive,
    Text,
    map_tree,
    moved,
    walk,
)
from graphkin.drawing.place.labels import Label, Mark
from graphkin.drawing.text import text_box

__all__ = [
    "LAYERS", "Piece", "cut_to", "dated", "ink_box", "joined", "kept_in", "layer_groups", "middle_of", "moved_piece",
    "renamed",
]  # fmt: skip

# In the order of drawing.
LAYERS = (
    "background", "construction", "mechanism", "velocity", "acceleration", "forces", "centres", "answers", "labels",
)  # fmt: skip


@dataclass(frozen=True)
class Piece:
    """Part of a page: primitives by layer, labels that want a place, and further marks a label could be taken for."""

    layers: Mapping[str, tuple[Primitive, ...]] = field(default_factory=dict)
    labels: tuple[Label, ...] = ()
    marks: tuple[Mark, ...] = ()

    @property
    def drawn(self) -> tuple[Primitive, ...]:
        return tuple(thing for layer in self.layers.values() for thing in layer)


def joined(pieces: Iterable[Piece]) -> Piece:
    """Several pieces as one."""
    layers: dict[str, tuple[Primitive, ...]] = {}
    labels: tuple[Label, ...] = ()
    marks: tuple[Mark, ...] = ()
    for piece in pieces:
        for layer, things in piece.layers.items():
            layers[layer] = layers.get(layer, ()) + things
        labels += piece.labels
        marks += piece.marks
    return Piece(layers, labels, marks)


def dated(piece: Piece, since: int | None) -> Piece:
    """The piece with the number of the step from which on it is there on its parts and names that have none."""

    def known(thing: Primitive) -> Primitive:
        return replace(thing, since=since) if isinstance(thing, Group | Text) and thing.since is None else thing

    layers = {layer: tuple(map(known, things)) for layer, things in piece.layers.items()}
    names = (label.text if label.text.since else replace(label.text, since=since) for label in piece.labels)
    labels = (replace(label, text=name) for label, name in zip(piece.labels, names, strict=True))
    return Piece(layers, tuple(labels), piece.marks)


def layer_groups(piece: Piece) -> tuple[Group, ...]:
    """The layers of a page as groups with names, in the order of drawing."""
    return tuple(Group(piece.layers[name], id=name, layer=name) for name in LAYERS if piece.layers.get(name))


def cut_to(children: Iterable[Primitive], box: Box) -> tuple[Primitive, ...]:
    """What of some primitives lies in a box: lines are cut at its edge, other things left out where they cross it."""

    def cut(thing: Primitive) -> Primitive | None:
        if isinstance(thing, Group):
            return thing
        if isinstance(thing, Line):
            inside = box.clip(thing.start, thing.end)
            return None if inside is None or inside[0] == inside[1] else replace(thing, start=inside[0], end=inside[1])
        reach = _outermost(thing)
        return thing if reach and box.holds(Box.around(reach)) else None

    return map_tree(children, cut)


def kept_in(piece: Piece, box: Box) -> int:
    """How many names of a piece stand in a box, and how many of the things that are left out where they cross its
    edge."""
    things = walk(cut_to(piece.drawn, box))
    names = sum(box.distance(middle_of(name.mark)) == 0.0 for name in piece.labels)
    return names + sum(not isinstance(one, Line | Group) for one in things)


def ink_box(children: Iterable[Primitive]) -> Box | None:
    """The box around everything drawn, line widths left out; None where nothing is."""
    held = [z for thing in walk(tuple(children)) for z in _outermost(thing)]
    return Box.around(held) if held else None


def _outermost(thing: Primitive) -> Sequence[complex]:
    """Points that a primitive does not reach beyond; none of a group."""
    if isinstance(thing, Line):
        return thing.start, thing.end
    if isinstance(thing, Text):
        if not thing.runs:
            return ()
        box = text_box(thing)
        return complex(box.left, box.top), complex(box.right, box.bottom)
    if isinstance(thing, Polyline | Polygon):
        return thing.points
    if isinstance(thing, Circle):
        corner = complex(thing.radius, thing.radius)
        return thing.centre - corner, thing.centre + corner
    if isinstance(thing, Arc):
        steps = [thing.start + (thing.end - thing.start) * i / 12 for i in range(13)]
        return [thing.at(angle) for angle in steps]
    return ()


def moved_piece(piece: Piece, by: complex) -> Piece:
    """The same piece elsewhere on the page."""
    labels = tuple(replace(label, mark=_moved_mark(label.mark, by)) for label in piece.labels)
    layers = {layer: moved(things, by) for layer, things in piece.layers.items()}
    return Piece(layers, labels, tuple(_moved_mark(mark, by) for mark in piece.marks))


def renamed(piece: Piece, suffix: str) -> Piece:
    """The piece with other ids, where it stands beside others of its kind."""

    def renamed(thing: Primitive) -> Primitive:
        return replace(thing, id=thing.id + suffix) if isinstance(thing, Group | Text) and thing.id else thing

    return replace(piece, layers={layer: map_tree(things, renamed) for layer, things in piece.layers.items()})


def middle_of(mark: Mark) -> complex:
    """The middle of a mark."""
    return (mark[0] + mark[1]) / 2 if isinstance(mark, tuple) else mark


def _moved_mark(mark: Mark, by: complex) -> Mark:
    return (mark[0] + by, mark[1] + by) if isinstance(mark, tuple) else mark + by
