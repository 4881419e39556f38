"""Drawings as DXF for CAD: one unit is one millimetre on paper, layers as in the SVG, the same bytes every time.

ezdxf (extra ``cad``) stays behind this module.  A named group of the SVG is a group of that name.  White fills and
strokes, which hide lines on paper, are left out: a DXF holds geometry.

The profile of a cam is true to size for a milling machine, as a closed curve of arcs within a millionth of a millimetre
of the computed one.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Sequence
from io import StringIO
from itertools import pairwise
from threading import Lock
from typing import TYPE_CHECKING

import numpy as np

from graphkin.drawing.ink.primitives import (
    Arc,
    Circle,
    Group,
    Line,
    Page,
    Polygon,
    Polyline,
    Primitive,
    Stroke,
    Text,
)
from graphkin.drawing.text import CAP_HEIGHT, has_cjk, start_runs, width
from graphkin.errors import CallError
from graphkin.plane import added_up, cross, dot
from graphkin.scene.laws import LiftPiece
from graphkin.scene.pairs import LawCam
from graphkin.solver.cams import cam_with

if TYPE_CHECKING:
    from ezdxf.document import Drawing as DxfFile
    from ezdxf.entities import DXFGraphic

WIDTHS = (0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100, 106, 120, 140, 158, 200, 211)
"""Widths of lines that the format knows, in hundredths of a millimetre."""
STYLES = {"serif": "times.ttf", "serif-italic": "timesi.ttf", "serif-bold": "timesbd.ttf", "chinese": "simsun.ttc"}
WHITE = ("#fff", "#ffffff")
Stroked = Line | Polyline | Polygon | Circle | Arc
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
        for arm in (reach / 4, 1j * reach / 4):
            space.add_line((-arm.real, -arm.imag), (arm.real, arm.imag), {"layer": "axis"})

    return _document(put)


def _document(put: Callable[[DxfFile], None]) -> bytes:
    """A file in millimetres, filled by ``put``."""
    try:
        import ezdxf
        from ezdxf import units
    except ImportError:
        raise CallError.of("format", '"dxf"', "it needs the extra cad pip install graphkin") from None
    with _ALONE:  # that no date is written is an option of the whole process
        before = ezdxf.options.write_fixed_meta_data_for_testing
        ezdxf.options.write_fixed_meta_data_for_testing = True
        try:
            document = ezdxf.new("R2010", units=units.MM)
            put(document)
            for name in sorted(document.entitydb.dxf_types_in_use()):  # ezdxf would take them in the order of a set
                document.classes.add_class(name)
            out = StringIO()
            document.write(out)
        finally:
            ezdxf.options.write_fixed_meta_data_for_testing = before
    return out.getvalue().encode()


class _Board:
    """Puts primitives into the model space of a document, y up."""

    def __init__(self, document: DxfFile, height: float) -> None:
        self.document, self.space, self.height = document, document.modelspace(), height

    def draw(self, parts: Iterable[Primitive], layer: str) -> list[DXFGraphic]:
        """Draw on a layer; returns the entities."""
        made: list[DXFGraphic] = []
        for part in parts:
            if isinstance(part, Group):
                inner = self.draw(part.children, part.layer or layer)
                if part.id and not part.layer and inner:
                    self._named(part.id, inner)
                made += inner
            elif isinstance(part, Text):
                made += self._text(part, layer)
            elif isinstance(part, Stroked):  # a DXF holds no pictures
                made += self._shape(part, layer)
        return made

    def _named(self, name: str, entities: list[DXFGraphic]) -> None:
        groups, free, count = self.document.groups, name, 1
        while free in groups:
            count += 1
            free = f"{name}-{count}"
        groups.new(free).extend(entities)

    def _at(self, z: complex) -> tuple[float, float]:
        return round(z.real, 6), round(self.height - z.imag, 6)

    def _shape(self, part: Stroked, layer: str) -> list[DXFGraphic]:
        made = []
        fill = part.fill if isinstance(part, Polygon | Circle) else ""
        if fill and fill.lower() not in WHITE:
            made.append(self._filled(part, fill, layer))
        if part.stroke is None or part.stroke.colour.lower() in WHITE:
            return made
        look = self._look(part.stroke, layer)
        if isinstance(part, Line):
            made.append(self.space.add_line(self._at(part.start), self._at(part.end), look))
        elif isinstance(part, Circle):
            made.append(self.space.add_circle(self._at(part.centre), part.radius, look))
        elif isinstance(part, Arc):
            low, high = sorted((math.degrees(part.start), math.degrees(part.end)))
            made.append(self.space.add_arc(self._at(part.centre), part.radius, low, high, dxfattribs=look))
        else:
            closed = isinstance(part, Polygon)
            made.append(self.space.add_lwpolyline(list(map(self._at, part.points)), close=closed, dxfattribs=look))
        return made

    def _filled(self, part: Stroked, fill: str, layer: str) -> DXFGraphic:
        look = {"layer": layer, "true_color": _colour(fill)}
        if isinstance(part, Polygon) and len(part.points) in (3, 4):
            corners = list(map(self._at, part.points))
            if len(corners) == 4:
                corners[2], corners[3] = corners[3], corners[2]  # as the format has it
            return self.space.add_solid(corners, look)
        hatch = self.space.add_hatch(dxfattribs=look)
        if isinstance(part, Circle):
            hatch.paths.add_edge_path().add_arc(self._at(part.centre), part.radius, 0.0, 360.0)
        elif isinstance(part, Polygon):
            hatch.paths.add_polyline_path(list(map(self._at, part.points)), is_closed=True)
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
        """A text of each run, fitted into the length of its glyphs in the other formats."""
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


KEEPS = 2e-7  # mm that an arc may lie off the profile
COUNT, ROUNDS = 90, 12

Vertex = tuple[complex, float]
"""A place (mm) and the bulge of the arc to the next one: the tangent of a quarter of its angle."""


def profile_dxf(cam: LawCam) -> bytes:
    """The profile in mm in the cam's own axes from its axis, with the axis marked.  Raises CallError without ezdxf."""
    return closed_curve_dxf(arcs_of_profile(cam), cam.base_of_profile * 1e3)


def outline_dxf(centre: complex, radius: float) -> bytes:
    """A round outline in mm about a centre (m) in the cam's own axes from its axis, with the axis marked.  Raises
    CallError without ezdxf."""
    ends = [((centre + radius * side) * 1e3, 1.0) for side in (-1.0, 1.0)]
    return closed_curve_dxf(ends, radius * 1e3)


def arcs_of_profile(cam: LawCam) -> list[Vertex]:
    """The profile as tangent arcs, two between each two of its points (biarcs), finer where it bends."""
    vertices: list[Vertex] = []
    parts = cam.law.parts
    for part, following in zip(parts, (*parts[1:], parts[0]), strict=True):
        count = max(2, math.ceil(COUNT * (part.end - part.start) / math.tau))
        nodes = [part.start + (part.end - part.start) * k / count for k in range(count + 1)]
        for start, end in pairwise(nodes):
            vertices += _between(cam, part, start, end, ROUNDS)
        (corner, t), (begin, _) = _point(cam, part, part.end), _point(cam, following, following.start)
        if abs(begin - corner) > KEEPS:  # the speed jumps: along the face, or around the roller
            vertices.append((corner, _bulge(corner, t if dot(t, begin - corner) >= 0.0 else -t, begin)))
    return vertices


def _point(cam: LawCam, part: LiftPiece, degree: float) -> tuple[complex, complex]:
    """A point of the profile (mm) and the direction in which the degree grows there."""
    at = cam_with(cam, np.array([degree]), part.at(np.array([degree]), np))
    # the normal turned by a quarter, towards growing degrees
    return complex(at.profile[0]) * 1e3, complex((at.normal * np.conj(at.turn))[0]) * -1j * cam.sense


def _between(cam: LawCam, part: LiftPiece, start: float, end: float, rounds: int) -> list[Vertex]:
    """Arcs from one angle of the law to another."""
    (p, t), (q, u) = _point(cam, part, start), _point(cam, part, end)
    t, u = (w if dot(w, q - p) >= 0.0 else -w for w in (t, u))
    two = _biarc(p, t, q, u)
    if two is None:
        return [(p, 0.0)]
    joint, first, second = two
    probes = (_point(cam, part, start + share * (end - start))[0] for share in (0.2, 0.5, 0.8))
    gap = max(_off(p, joint, first, z) if dot(z - joint, q - p) < 0.0 else _off(joint, q, second, z) for z in probes)
    if gap > KEEPS and rounds:
        half = (start + end) / 2
        return [*_between(cam, part, start, half, rounds - 1), *_between(cam, part, half, end, rounds - 1)]
    return [(p, first), (joint, second)]


def _biarc(p: complex, t: complex, q: complex, u: complex) -> tuple[complex, float, float] | None:
    """Two arcs that leave p along t, touch each other, and come to q along u: their joint and both bulges; None for
    coincident points (Bolton, Biarc curves, Computer-Aided Design 7, 1975)."""
    v = q - p
    if abs(v) < 1e-9:
        return None
    # equal lengths d of both tangents: v.v + 2 d v.(t + u) + 2 d2 (t.u - 1) = 0 with the sign of v turned
    a, b, c = 2.0 * (1.0 - dot(t, u)), 2.0 * dot(v, t + u), -dot(v, v)
    d = -c / b if abs(a) < 1e-14 else 2.0 * -c / (b + math.sqrt(b * b - 4.0 * a * c))
    joint = (p + d * t + q - d * u) / 2.0
    return joint, _bulge(p, t, joint), _bulge(joint, cmath.exp(1j * 2.0 * cmath.phase((joint - p) / t)) * t, q)


def _bulge(p: complex, t: complex, q: complex) -> float:
    """The bulge of the arc from p along t to q."""
    return math.tan(cmath.phase((q - p) / t) / 2.0)


def _off(p: complex, q: complex, bulge: float, z: complex) -> float:
    """The distance of a place from an arc."""
    chord = q - p
    if abs(bulge) < 1e-12:
        return abs(cross(chord, z - p)) / abs(chord)
    radius = abs(chord) * (1.0 + bulge * bulge) / (4.0 * abs(bulge))
    centre = (p + q) / 2.0 + 1j * chord * (1.0 - bulge * bulge) / (4.0 * bulge)
    return abs(abs(z - centre) - radius)
