"""Drawings as DXF for CAD: one unit is one millimetre on paper, layers as in the SVG, the same bytes every time.

ezdxf (extra ``cad``) stays behind this module.  What has a name in the SVG is a group of that name.  White fills, which
hide lines on paper, are left out: what is drawn is geometry.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from io import StringIO
from threading import Lock
from typing import TYPE_CHECKING

from graphkin.drawing.font_widths import CAP_HEIGHT, has_cjk, start_runs, width
from graphkin.drawing.ink.primitives import (
    Arc,
    Circle,
    Group,
    Line,
    Page,
    Polygon,
    Polyline,
    Primitive,
    Scan,
    Stroke,
    Text,
)
from graphkin.errors import CallError, Problem
from graphkin.plane import added_up
from graphkin.words import Phrase

if TYPE_CHECKING:
    from ezdxf.document import Drawing as DxfFile
    from ezdxf.entities import DXFGraphic

__all__ = ["closed_curve_dxf", "dxf_bytes"]

WIDTHS = (0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100, 106, 120, 140, 158, 200, 211)
"""Widths of lines that the format knows, in hundredths of a millimetre."""
STYLES = {"serif": "times.ttf", "serif-italic": "timesi.ttf", "serif-bold": "timesbd.ttf", "chinese": "simsun.ttc"}
PAPER = "paper"  # the layer of what stands in none
_ALONE = Lock()


def dxf_bytes(drawing: Page) -> bytes:
    """The drawing as a DXF file (release 2010).  Raises CallError where the extra ``cad`` is not installed."""

    def put(document: DxfFile) -> None:
        for name, font in STYLES.items():
            document.styles.add(name, font=font)
        _Board(document, drawing.height).draw(drawing.children, PAPER)

    return _document(put)


def closed_curve_dxf(vertices: Sequence[tuple[complex, float]], reach: float) -> bytes:
    """A closed curve of arcs on the layer "profile", each vertex with the bulge to the next (mm), and on the layer
    "axis" a cross at the origin, half a ``reach`` long.  Raises CallError without the extra ``cad``."""

    def put(document: DxfFile) -> None:
        space = document.modelspace()
        points = [(z.real, z.imag, bulge) for z, bulge in vertices]
        space.add_lwpolyline(points, format="xyb", close=True, dxfattribs={"layer": "profile"})
        for way in (reach / 4, 1j * reach / 4):
            space.add_line((-way.real, -way.imag), (way.real, way.imag), {"layer": "axis"})

    return _document(put)


def _document(put: Callable[[DxfFile], None]) -> bytes:
    """A file in millimetres, filled by ``put``."""
    try:
        import ezdxf
        from ezdxf import units
    except ImportError:
        needs = Phrase("it needs the extra cad pip install graphkin")
        raise CallError(Problem("format", '"dxf"', needs)) from None
    with _ALONE:  # that no date is written is an option of the whole process
        before = ezdxf.options.write_fixed_meta_data_for_testing
        ezdxf.options.write_fixed_meta_data_for_testing = True
        try:
            document = ezdxf.new("R2010", units=units.MM)
            put(document)
            out = StringIO()
            document.write(out)
        finally:
            ezdxf.options.write_fixed_meta_data_for_testing = before
    return out.getvalue().encode()


class _Board:
    """Puts primitives into the model space of a document, y up."""

    def __init__(self, document: DxfFile, height: float) -> None:
        self.document, self.space, self.height = document, document.modelspace(), height

    def draw(self, things: Iterable[Primitive], layer: str) -> list[DXFGraphic]:
        """Draw on a layer; returns the entities."""
        made: list[DXFGraphic] = []
        for thing in things:
            if isinstance(thing, Group):
                inner = self.draw(thing.children, thing.layer or layer)
                if thing.id and not thing.layer and inner:
                    self._named(thing.id, inner)
                made += inner
            elif isinstance(thing, Scan):
                pass  # a DXF holds no pictures
            elif isinstance(thing, Text):
                made += self._text(thing, layer)
            else:
                made += self._shape(thing, layer)
        return made

    def _named(self, name: str, entities: list[DXFGraphic]) -> None:
        groups, free, count = self.document.groups, name, 1
        while free in groups:
            count += 1
            free = f"{name}-{count}"
        groups.new(free).extend(entities)

    def _at(self, z: complex) -> tuple[float, float]:
        return round(z.real, 6), round(self.height - z.imag, 6)

    def _shape(self, thing: Line | Polyline | Polygon | Circle | Arc, layer: str) -> list[DXFGraphic]:
        made = []
        fill = thing.fill if isinstance(thing, Polygon | Circle) else ""
        if fill and fill.lower() not in ("#fff", "#ffffff"):
            made.append(self._filled(thing, fill, layer))
        if thing.stroke is None:
            return made
        look = self._look(thing.stroke, layer)
        if isinstance(thing, Line):
            made.append(self.space.add_line(self._at(thing.start), self._at(thing.end), look))
        elif isinstance(thing, Circle):
            made.append(self.space.add_circle(self._at(thing.centre), thing.radius, look))
        elif isinstance(thing, Arc):
            low, high = sorted((math.degrees(thing.start), math.degrees(thing.end)))
            made.append(self.space.add_arc(self._at(thing.centre), thing.radius, low, high, dxfattribs=look))
        else:
            closed = isinstance(thing, Polygon)
            made.append(self.space.add_lwpolyline(list(map(self._at, thing.points)), close=closed, dxfattribs=look))
        return made

    def _filled(self, thing: Line | Polyline | Polygon | Circle | Arc, fill: str, layer: str) -> DXFGraphic:
        look = {"layer": layer, "true_color": _colour(fill)}
        if isinstance(thing, Polygon) and len(thing.points) in (3, 4):
            corners = list(map(self._at, thing.points))
            if len(corners) == 4:
                corners[2], corners[3] = corners[3], corners[2]  # as the format has it
            return self.space.add_solid(corners, look)
        hatch = self.space.add_hatch(dxfattribs=look)
        if isinstance(thing, Circle):
            hatch.paths.add_edge_path().add_arc(self._at(thing.centre), thing.radius, 0.0, 360.0)
        elif isinstance(thing, Polygon):
            hatch.paths.add_polyline_path(list(map(self._at, thing.points)), is_closed=True)
        return hatch

    def _look(self, stroke: Stroke, layer: str) -> dict[str, object]:
        weight = min(WIDTHS, key=lambda known: abs(known - 100.0 * stroke.width))
        look: dict[str, object] = {"layer": layer, "true_color": _colour(stroke.colour), "lineweight": weight}
        if stroke.dash:
            name = "dash-" + "-".join(f"{mm:g}" for mm in stroke.dash)
            if name not in self.document.linetypes:
                signed = [mm if i % 2 == 0 else -mm for i, mm in enumerate(stroke.dash * (1 + len(stroke.dash) % 2))]
                self.document.linetypes.add(name, [added_up(map(abs, signed)), *signed])
            look["linetype"] = name
        return look

    def _text(self, text: Text, layer: str) -> list[DXFGraphic]:
        """A text of each run, fitted into the length that its glyphs have in the other formats."""
        from ezdxf.enums import TextEntityAlignment

        made: list[DXFGraphic] = []
        for run in start_runs(text):
            style = "serif-bold" if run.bold else "serif-italic" if run.italic else "serif"
            look = {"layer": layer, "true_color": _colour(text.colour)}
            look["style"] = "chinese" if has_cjk(run.text) else style
            entity = self.space.add_text(run.text, height=CAP_HEIGHT * run.size, dxfattribs=look)
            long = width(run.text, run.size, run.italic, run.bold)
            start, end = complex(run.x, run.y), complex(run.x + long, run.y)
            entity.set_placement(self._at(start), self._at(end), TextEntityAlignment.FIT)
            made.append(entity)
        if text.id and made:
            self._named(text.id, made)
        return made


def _colour(name: str) -> int:
    return int(name.removeprefix("#"), 16)
