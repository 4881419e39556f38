"""The drawn mechanism as a whole, cut to its room where it has to be."""

from __future__ import annotations

import math
from cmath import phase

from graphkin.drafting.sheet import Arc as Compass
from graphkin.drafting.sheet import Sheet
from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters
from graphkin.drawing.layout import Piece, cut_to, ink_box, joined, middle_of
from graphkin.drawing.lengths import LENGTHS, drawn_lengths
from graphkin.drawing.mechanism.joints import joints
from graphkin.drawing.mechanism.links import links
from graphkin.drawing.mechanism.names import link_names
from graphkin.drawing.mechanism.on_paper import OnPaper, page
from graphkin.drawing.mechanism.rates import clearance, drivers, found_rates
from graphkin.drawing.primitives import Arc, Group

__all__ = ["mechanism_piece"]

COMPASS = 4.0  # mm of arc to either side of what it finds


def mechanism_piece(sheet: Sheet, letters: Letters, room: tuple[float, float] | None = None) -> tuple[Piece, Box]:
    """Draw the mechanism about the world's origin.

    Parameters
    ----------
    room : width and height (mm) of its panel; None for as much as it takes

    Returns
    -------
    the piece, and the box (mm, y down) that it takes up, names left out.  Where it does not fit the room, dimensions
    are left out first, then bars are cut at the edge of a room about its points.
    """
    here = OnPaper(sheet, letters)
    piece = _piece(here, None)
    box = ink_box(piece.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    if room is None or _fits(box, room):
        return piece, box
    lengths = [thing for thing in piece.drawn if isinstance(thing, Group) and thing.id == LENGTHS]
    bare = ink_box(thing for thing in piece.drawn if thing not in lengths) or box
    if not _fits(bare, room):
        bare = Box.around(page(z) for z in sheet.points.values())
    half = complex(*room) / 2
    panel = Box.around((bare.centre - half, bare.centre + half))
    piece = _piece(here, panel)
    layers = {name: cut_to(things, panel) for name, things in piece.layers.items()}
    names = tuple(n for n in piece.names if panel.distance(middle_of(n.label.mark)) == 0.0)
    return Piece(layers, names, piece.marks), panel


def _fits(box: Box, room: tuple[float, float]) -> bool:
    return box.width <= room[0] and box.height <= room[1]


def _piece(here: OnPaper, panel: Box | None) -> Piece:
    clear = clearance(here)
    whole = joined((_construction(here), links(here), joints(here), drivers(here, clear), found_rates(here, clear)))
    drawn = [thing for layer in ("construction", "mechanism", "answers") for thing in whole.layers[layer]]
    lengths = Piece({"mechanism": (drawn_lengths(here.sheet, drawn, panel),)})
    marks = Piece(marks=tuple(page(z) for z in here.places.values()))
    return joined((whole, lengths, link_names(here), marks))


def _construction(here: OnPaper) -> Piece:
    """Compass arcs near the points that they find."""
    drawn = []
    for step in here.sheet.steps:
        if step.diagram != "mechanism":
            continue
        for arc in (s for s in step.strokes if isinstance(s, Compass)):
            if arc.radius < 1e-9:
                continue
            middle, half = phase(arc.at - arc.centre), min(COMPASS / arc.radius, math.pi * 0.9)
            shape = Arc(page(arc.centre), arc.radius, middle - half, middle + half, strokes.CONSTRUCTION)
            drawn.append(Group((shape,), classes=("compass", f"step-{step.number:02d}")))
    return Piece({"construction": tuple(drawn)})
