"""A construction on paper while it is drawn: strokes by layer, and names that need a place; places in mm, y up."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from graphkin.drawing.box import Box
from graphkin.drawing.boxes import Block, panel
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Primitive, Run, Stroke, on_page
from graphkin.drawing.ink.symbols import RESULTANT, ArrowKind, arrow
from graphkin.drawing.place.labels import Label, Mark, mapped
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, cut_to, middle_of, moved_piece
from graphkin.drawing.text import rich
from graphkin.words.symbols import RichText, Words


@dataclass
class Plate:
    """The strokes of a construction by layer, and its names, in their order."""

    layers: dict[str, list[Primitive]] = field(default_factory=dict)
    labels: list[Label] = field(default_factory=list)

    @property
    def piece(self) -> Piece:
        """The whole construction about its own origin (y down)."""
        return Piece({layer: tuple(things) for layer, things in self.layers.items()}, tuple(self.labels))

    def put(
        self, layer: str, *things: Primitive, id: str = "", classes: tuple[str, ...] = (), step: int | None = None
    ) -> None:
        """Put primitives in a layer; as a group if they have an id, a class or a step."""
        if id or classes or step is not None:
            things = (Group(things, id=id, classes=classes, step=step),)
        self.layers.setdefault(layer, []).extend(things)

    def line(self, layer: str, a: complex, b: complex, stroke: Stroke) -> None:
        """A straight line."""
        self.put(layer, Line.between(a, b, stroke))

    def circle(self, layer: str, at: complex, radius: float, fill: str = "", stroke: Stroke | None = None) -> None:
        """A circle; a dot where it is filled."""
        self.put(layer, Circle(on_page(at), radius, fill, stroke))

    def name(
        self, runs: tuple[Run, ...], mark: Mark, id: str = "", *, colour: str = strokes.BLACK, rank: int = 0,
        toward: tuple[float, ...] = (), step: int | None = None, between: Words = "",
    ) -> None:
        """A name of a point, or of the line between two; as `Label.of`."""
        self.labels.append(Label.of(runs, mapped(mark, on_page), id, colour=colour, rank=rank, toward=toward,
                                    step=step, between=between))

    def arrow(
        self, layer: str, id: str, tail: complex, tip: complex, symbol: RichText, size: float = 3.0, *,
        kind: ArrowKind = RESULTANT, colour: str = strokes.BLACK, classes: tuple[str, ...] = (),
        step: int | None = None, rank: int = 0, between: Words = "",
    ) -> None:
        """A vector with its symbol."""
        self.put(layer, *arrow(on_page(tail), on_page(tip), kind, colour), id=id, classes=classes, step=step)
        name = rich(symbol, size)
        self.name(name, (tail, tip), f"label-{id}", colour=colour, rank=rank, step=step, between=between)


def centred(
    content: Box, width: float, height: float, draw: Callable[[Box], Piece],
    name: Callable[[Piece, Box], Piece] = with_labels,
) -> Block:
    """A panel with a figure in its middle.

    Parameters
    ----------
    content : the box to be centred (mm about the figure's own origin, y down)
    draw : function of the room there to the figure about its own origin
    name : function that puts its names in their places
    """

    def drawn(room: Box) -> Piece:
        origin = room.centre - content.centre
        around = room.moved(-origin)
        return moved_piece(name(draw(around), around), origin)

    return panel(width, height, drawn)


def cut_piece(piece: Piece, box: Box) -> Piece:
    """The part of a piece in a box, with the names of its visible parts."""
    layers = {name: cut_to(things, box) for name, things in piece.layers.items()}
    return Piece(layers, tuple(name for name in piece.labels if box.distance(middle_of(name.mark)) == 0.0), piece.marks)
