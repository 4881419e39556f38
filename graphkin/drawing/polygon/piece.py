"""The drawn polygon as a whole."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.drafting.sheet import DiagramName, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters
from graphkin.drawing.detail import Detail
from graphkin.drawing.layout import Piece, joined
from graphkin.drawing.polygon.construction import construction
from graphkin.drawing.polygon.on_page import OnPage
from graphkin.drawing.polygon.points import points
from graphkin.drawing.polygon.vectors import vector_names, vectors

__all__ = ["polygon_piece"]


def polygon_piece(
    sheet: Sheet, diagram: DiagramName, letters: Letters, language: str, panel: Box, origin: complex,
    enlarged: Sequence[Detail] = (),
) -> Piece:  # fmt: skip
    """Draw a polygon with its pole at a point of the page.

    Parameters
    ----------
    panel : lines known by direction only are clipped to it
    origin : page point of the pole (mm)
    enlarged : places that are drawn again larger; they get a ring, and their vectors no names here
    """
    here = OnPage(sheet, diagram, letters, language, panel, origin, tuple(enlarged))
    return joined((construction(here), vectors(here), points(here), vector_names(here)))
