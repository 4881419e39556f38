"""Drawing: primitives on a page in mm, texts, kinematic symbols, placed labels, and the writers that draw them all."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Polygon, Polyline, Primitive, Run, Stroke, Text
from graphkin.drawing.write.drawing import Drawing, save
from graphkin.drawing.write.svg import svg_bytes

if TYPE_CHECKING:
    from graphkin.drawing.chart import ChartPage
    from graphkin.drawing.figure_pages import acceleration_figure, figures, mechanism_figure, velocity_figure
    from graphkin.drawing.sheet import sheet_page
    from graphkin.drawing.sheet_plan import sheet_room

__all__ = [
    "Arc",
    "Box",
    "ChartPage",
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

# Composing needs numpy, which whoever only writes a drawing does not wait for.
_COMPOSED = {
    "ChartPage": "chart",
    "acceleration_figure": "figure_pages",
    "figures": "figure_pages",
    "mechanism_figure": "figure_pages",
    "velocity_figure": "figure_pages",
    "sheet_page": "sheet",
    "sheet_room": "sheet_plan",
}


def __getattr__(name: str) -> object:
    if name in _COMPOSED:
        return getattr(import_module(f"graphkin.drawing.{_COMPOSED[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
