"""The line along which a vector has a sense, so that a signed number can stand for it."""

from __future__ import annotations

from graphkin.drafting import Sheet
from graphkin.plane import unit
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Slide

__all__ = ["line_of"]


def line_of(sheet: Sheet, symbol: Symbol) -> complex | None:
    """Unit vector of the positive sense of a vector symbol, None where nothing gives it one.

    A point that slides in the frame, and one that slides relative to a coincident one: the guide's sense.  A tangential
    acceleration: counter-clockwise.
    """
    if symbol.of is None:
        return None
    if symbol.kind == "at":
        start = sheet.points.get(PointRef(symbol.to.point)) if symbol.to else _pivot(sheet, symbol.of)
        end = sheet.points.get(PointRef(symbol.of.point))
        return 1j * unit(end - start) if start is not None and end is not None and end != start else None
    if symbol.kind not in ("v", "a", "ar"):
        return None
    for slide in sheet.structure.slides:
        if _along(sheet, slide, symbol):
            pose = sheet.poses.get(slide.b)
            return pose.axis * slide.guide.direction if pose else None
    return None


def _along(sheet: Sheet, slide: Slide, symbol: Symbol) -> bool:
    """Whether a vector lies along a guide."""
    of, to, frame = symbol.of, symbol.to, sheet.scene.frame.name
    assert of is not None
    if to is not None:
        both = {of.link, to.link} - {""}
        return slide.pin == of.point == to.point and both <= {slide.a, slide.b}
    slider = sheet.structure.links[slide.a]
    return slide.b == frame and (of.link == slide.a or (not of.link and of.point in slider.points))


def _pivot(sheet: Sheet, of: PointRef) -> complex | None:
    scene = sheet.scene
    for link in scene.links:
        if of.point in link.points and of.link in ("", link.name):
            fixed = next((p for p in link.points if p in scene.frame.points and p != of.point), None)
            if fixed:
                return sheet.points.get(PointRef(fixed))
    return None
