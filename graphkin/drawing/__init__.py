"""Drawing: primitives on a page in mm, texts, kinematic symbols, placed labels, and the writers that draw them all."""

from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Polygon, Polyline, Primitive, Run, Stroke, Text
from graphkin.drawing.write.drawing import Drawing, save
from graphkin.drawing.write.svg import svg_bytes

__all__ = [
    "Arc", "Box", "Circle", "Drawing", "Group", "Line", "Polygon", "Polyline", "Primitive", "Run", "Stroke", "Text",
    "save", "svg_bytes",
]
