"""Drawing: primitives on a page in mm, texts, kinematic symbols, placed labels, and the writers that draw them all."""

from graphkin.drawing.box import Box
from graphkin.drawing.figures import acceleration_figure, figures, mechanism_figure, velocity_figure
from graphkin.drawing.primitives import (
    Arc,
    Circle,
    Drawing,
    Group,
    Line,
    Polygon,
    Polyline,
    Primitive,
    Run,
    Stroke,
    Text,
)
from graphkin.drawing.save import save
from graphkin.drawing.sheet_page import sheet_page, sheet_room
from graphkin.drawing.svg import svg_bytes

__all__ = [
    "Arc",
    "Box",
    "Circle",
    "Drawing",
    "Group",
    "Line",
    "Polygon",
    "Polyline",
    "Primitive",
    "Run",
    "Stroke",
    "Text",
    "acceleration_figure",
    "figures",
    "mechanism_figure",
    "save",
    "sheet_page",
    "sheet_room",
    "svg_bytes",
    "velocity_figure",
]
