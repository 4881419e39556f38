"""How large a polygon is."""

from __future__ import annotations

from graphkin.drafting.sheet import Bar, DiagramName, Sheet
from graphkin.drawing.box import Box

__all__ = ["extent"]

FAR = 60.0  # mm: construction further outside than this is cut off


def extent(sheet: Sheet, diagram: DiagramName, within: Box | None = None) -> Box:
    """The box (mm, y down, about the pole) around all vectors of a polygon; lines that lead to them are counted in
    where they do not reach far."""
    ends = [0j, *(z for v in sheet.vectors(diagram).values() for z in (v.tail, v.tip))]
    box = Box.around(z.conjugate() for z in ends)
    for step in sheet.steps:
        for stroke in step.strokes:
            if step.diagram == diagram and isinstance(stroke, Bar):
                wider = box.joined(Box.around((stroke.a.conjugate(), stroke.b.conjugate())))
                if within is None:
                    fits = max(wider.width - box.width, wider.height - box.height) < FAR
                else:
                    fits = wider.width <= within.width and wider.height <= within.height
                box = wider if fits else box
    return box
