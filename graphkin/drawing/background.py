"""The photograph or scan under a drawn mechanism, at true scale."""

from __future__ import annotations

from graphkin.construction.sheet import Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.piece import Piece
from graphkin.drawing.primitives import Scan

__all__ = ["background_piece"]


def background_piece(sheet: Sheet, origin: complex, panel: Box) -> Piece:
    """The scene's picture, cut to a panel (mm, y down) in which the world's origin lies at ``origin``."""
    under = sheet.scene.background
    if under is None:
        return Piece()
    mm = 1 / sheet.scales.length
    corner, step = (z.conjugate() * mm for z in (under.corner, under.step))
    scan = Scan(origin + corner, step, under.width, under.height, under.kind, under.data, panel.corners)
    return Piece({"background": (scan,)})
