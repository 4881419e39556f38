"""A velocity or acceleration polygon: vectors, end points, feet of components, direction lines, images."""

from __future__ import annotations

from graphkin.drawing.polygon.extent import extent
from graphkin.drawing.polygon.piece import polygon_piece

__all__ = ["extent", "polygon_piece"]
