"""Putting a figure together: pieces with what they draw by layer and what wants a name, then labels in their places."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from graphkin.drawing.box import Box
from graphkin.drawing.obstacles import Obstacles, obstacles_of
from graphkin.drawing.placing import Label, Mark, place_those_that_fit
from graphkin.drawing.primitives import Arc, Circle, Group, Line, Polygon, Polyline, Primitive, Run, Text, walk
from graphkin.drawing.text import SMALLEST, rich, runs_width, text_box

__all__ = [
    "LAYERS",
    "Name",
    "Piece",
    "cut_to",
    "fitted",
    "ink_box",
    "joined",
    "layer_groups",
    "middle_of",
    "moved",
    "moved_piece",
    "settled",
    "wrapped",
]

# In the order of drawing.
LAYERS = ("construction", "mechanism", "velocity", "acceleration", "centres", "answers", "labels")


@dataclass(frozen=True)
class Name:
    """A label that a piece asks for; one with ``rank`` 0 must stand, others are given up first, the highest first."""

    label: Label
    rank: int = 0


@dataclass(frozen=True)
class Piece:
    """Part of a page: primitives by layer, names that want a place, and further marks a name could be taken for."""

    layers: Mapping[str, tuple[Primitive, ...]] = field(default_factory=dict)
    names: tuple[Name, ...] = ()
    marks: tuple[Mark, ...] = ()

    @property
    def drawn(self) -> tuple[Primitive, ...]:
        return tuple(thing for layer in self.layers.values() for thing in layer)


def joined(pieces: Iterable[Piece]) -> Piece:
    """Several pieces as one."""
    layers: dict[str, tuple[Primitive, ...]] = {}
    names: tuple[Name, ...] = ()
    marks: tuple[Mark, ...] = ()
    for piece in pieces:
        for layer, things in piece.layers.items():
            layers[layer] = layers.get(layer, ()) + things
        names += piece.names
        marks += piece.marks
    return Piece(layers, names, marks)


def settled(piece: Piece, panel: Box, fences: Sequence[Box] = ()) -> Piece:
    """The piece with its names in their places, in the layer "labels"; some that find none are given up.

    No name leaves the panel or enters a fence.
    """
    names = [name for name in piece.names if name.rank < _most(len(piece.names))]
    obstacles = obstacles_of(piece.drawn) + Obstacles(areas=tuple(fences), writing=tuple(fences))
    labels, ranks = [name.label for name in names], [name.rank for name in names]
    written: list[Primitive] = []
    for one in place_those_that_fit(labels, ranks, panel, obstacles, piece.marks):
        if one is not None:
            written += (one.text,) if one.leader is None else (one.leader, one.text)
    return Piece({**piece.layers, "labels": (*piece.layers.get("labels", ()), *written)}, (), piece.marks)


def _most(count: int) -> int:
    """The rank from which names are left out at once, because there are so many that none would be read."""
    return 5 if count < 45 else 4 if count < 60 else 2


def layer_groups(piece: Piece) -> tuple[Group, ...]:
    """The layers of a page as groups with names, in the order of drawing."""
    return tuple(Group(piece.layers[name], id=name, layer=name) for name in LAYERS if piece.layers.get(name))


def cut_to(children: Iterable[Primitive], box: Box) -> tuple[Primitive, ...]:
    """What of some primitives lies in a box: lines are cut at its edge, other things left out where they cross it."""
    kept: list[Primitive] = []
    for thing in children:
        if isinstance(thing, Group):
            kept.append(replace(thing, children=cut_to(thing.children, box)))
        elif isinstance(thing, Line):
            inside = box.clip(thing.start, thing.end)
            if inside is not None and inside[0] != inside[1]:
                kept.append(replace(thing, start=inside[0], end=inside[1]))
        else:
            reach = _reach(thing)
            if reach is not None and box.holds(reach):
                kept.append(thing)
    return tuple(kept)


def ink_box(children: Iterable[Primitive]) -> Box | None:
    """The box around everything drawn, line widths left out; None where nothing is."""
    box: Box | None = None
    for thing in walk(tuple(children)):
        own = _reach(thing)
        if own is not None:
            box = own if box is None else box.joined(own)
    return box


def _reach(thing: Primitive) -> Box | None:
    if isinstance(thing, Line):
        return Box.around((thing.start, thing.end))
    if isinstance(thing, Polyline | Polygon):
        return Box.around(thing.points)
    if isinstance(thing, Circle):
        return Box.around((thing.centre,)).grown(thing.radius)
    if isinstance(thing, Arc):
        steps = [thing.start + (thing.end - thing.start) * i / 12 for i in range(13)]
        return Box.around(thing.at(angle) for angle in steps)
    if isinstance(thing, Text) and thing.runs:
        return text_box(thing)
    return None


def fitted(markup: str, size: float, width: float, bold: bool = False, least: float = SMALLEST) -> tuple[Run, ...]:
    """Words with symbols set as large as they fit a width (mm), at most ``size`` and at least ``least``."""
    runs = rich(markup, size, bold)
    wide = runs_width(runs)
    if wide <= width:
        return runs
    return rich(markup, max(least, size * width / wide * 0.995), bold)


def wrapped(markup: str, size: float, width: float, bold: bool = False) -> list[tuple[Run, ...]]:
    """Words with symbols set in lines of a width (mm), broken at spaces and between Chinese characters."""
    lines: list[str] = []
    line = ""
    for piece in _pieces(markup):
        if line and runs_width(rich((line + piece).strip(), size, bold)) > width:
            lines.append(line.strip())
            line = piece.lstrip()
        else:
            line += piece
    if line.strip():
        lines.append(line.strip())
    return [rich(text, size, bold) for text in lines]


def _pieces(markup: str) -> list[str]:
    """Words with the space before them; symbols between dollar signs stay whole."""
    pieces: list[str] = []
    word, inside = "", False
    for character in markup:
        wide = ord(character) > 0x2E7F
        if not inside and (character == " " or (wide and character not in "，。；：、）")):
            if word:
                pieces.append(word)
            word = ""
        if character == "$":
            inside = not inside
        word += character
    if word:
        pieces.append(word)
    return pieces


def moved_piece(piece: Piece, by: complex) -> Piece:
    """The same piece elsewhere on the page."""
    names = tuple(replace(n, label=replace(n.label, mark=_moved_mark(n.label.mark, by))) for n in piece.names)
    layers = {layer: moved(things, by) for layer, things in piece.layers.items()}
    return Piece(layers, names, tuple(_moved_mark(mark, by) for mark in piece.marks))


def middle_of(mark: Mark) -> complex:
    """The middle of a mark."""
    return (mark[0] + mark[1]) / 2 if isinstance(mark, tuple) else mark


def _moved_mark(mark: Mark, by: complex) -> Mark:
    return (mark[0] + by, mark[1] + by) if isinstance(mark, tuple) else mark + by


def moved(children: Iterable[Primitive], by: complex) -> tuple[Primitive, ...]:
    """The same primitives elsewhere on the page."""
    return tuple(_moved(child, by) for child in children)


def _moved(thing: Primitive, by: complex) -> Primitive:
    if isinstance(thing, Text):
        return replace(thing, at=thing.at + by)
    if isinstance(thing, Line):
        return replace(thing, start=thing.start + by, end=thing.end + by)
    if isinstance(thing, Circle | Arc):
        return replace(thing, centre=thing.centre + by)
    if isinstance(thing, Polyline | Polygon):
        return replace(thing, points=tuple(z + by for z in thing.points))
    return replace(thing, children=moved(thing.children, by))
