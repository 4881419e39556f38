"""Letters as outlines, for programs that have no fonts."""

from __future__ import annotations

from graphkin.drawing.font import EM, Glyph, glyph
from graphkin.drawing.font_widths import style_of
from graphkin.drawing.primitives import Run

__all__ = ["outline"]


def outline(run: Run) -> str:
    """The letters of a run on a page (mm) as the data of an SVG path; "" where no face at hand has them."""
    from fontTools.pens.svgPathPen import SVGPathPen
    from fontTools.pens.transformPen import TransformPen

    pen = SVGPathPen(None, ntos=_hundredths)
    times, x = run.size / EM, run.x
    for character in run.text:
        found = glyph(character, style_of(run.italic, run.bold))
        if found is None:
            continue
        _draw(found, TransformPen(pen, (times, 0, 0, -times, x, run.y)))
        x += found.advance * times
    commands: str = pen.getCommands()
    return commands


def _hundredths(mm: float) -> str:
    return f"{mm:.2f}".rstrip("0").rstrip(".")


def _draw(found: Glyph, pen: object) -> None:
    from fontTools.ttLib.tables._g_l_y_f import Glyph as Outline

    if found.outline:
        shape = Outline(found.outline)
        shape.expand(None)
        shape.draw(pen, None)
