"""A train of wheels seen from the side, laid on its line of centres: each wheel a bar from its axis to where it rolls,
in planes beside each other, the carrier behind them; the frame hatched."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from graphkin.construction.centre_lines import CentreLine
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Primitive, Stroke, Text
from graphkin.drawing.ink.symbols import hatched_line
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.piece import Piece
from graphkin.drawing.text import plain
from graphkin.scene.model import Mechanism
from graphkin.structure import Mesh

__all__ = ["scheme"]

TOOTH, RIM, GAP = 5.0, 6.0, 0.45
AXIS = Stroke(0.18, (5.0, 1.0, 0.6, 1.0))
STEP = 13.0
"""mm from one plane to the next, less where there are many."""


@dataclass(frozen=True)
class _Planes:
    """In which plane each pair lies, where the carriers and the legs of rings stand, and how many there are."""

    of: Mapping[str, int]
    behind: Mapping[str, int]
    count: int


def _planes(line: CentreLine) -> _Planes:
    of: dict[str, int] = {}
    rims: dict[tuple[str, str, float], int] = {}
    for mesh in line.meshes:
        pitch = line.spot(mesh.name).height
        own = [(wheel, axis, round(abs(pitch - line.spot(axis).height), 12))
               for wheel, axis in zip(mesh.wheels, mesh.axes, strict=True) if axis]  # fmt: skip
        plane = next((rims[rim] for rim in own if rim in rims), None)
        if plane is None:
            plane = len(set(of.values()))
        of[mesh.name] = plane
        rims.update(dict.fromkeys(own, plane))
    count = len(set(of.values()))
    behind: dict[str, int] = {}
    for mesh in line.meshes:
        parts = mesh.parts if all(mesh.axes) else ()
        rings = [w for w, part in zip(mesh.wheels, parts, strict=False) if part is not None and part < 0]
        for name in (*rings, mesh.carrier):
            if name not in behind:
                behind[name] = count
                count += 1
    return _Planes(of, behind, count)


def scheme(scene: Mechanism, line: CentreLine, mm: float, width: float) -> Piece:
    """The train within ``width`` mm from the left edge at 0, heights up the page from 0 at ``mm`` for one m."""
    planes, ground = _planes(line), scene.frame.name
    step = min(STEP, width / (planes.count + 0.5))
    heights = {s.name: s.height * mm for s in line.spots}

    def at(plane: int, height: float) -> complex:
        return complex((plane + 0.5) * step, -height)

    shapes: dict[str, list[Primitive]] = {}
    labels: list[Label] = []
    named: set[str] = set()
    on_axis: dict[tuple[str, str], set[int]] = {}
    axes: dict[str, None] = {}

    def bar(link: str, plane: int, low: float, high: float) -> None:
        stroke = strokes.LINK.coloured(strokes.colour_of_link(scene, link))
        a, b = at(plane, low), at(plane, high)
        shapes.setdefault(link, []).append(Line(a, b, stroke))
        if link not in named and link in scene.by_name:
            named.add(link)
            text = Text(0j, plain(link, 3.2, bold=True), "start", stroke.colour, f"label-plan-wheel-{link}", ("label",))
            labels.append(Label(text, (a, b), rank=0))

    for mesh in line.meshes:
        plane, pitch = planes.of[mesh.name], heights[mesh.name]
        for wheel, axis, part in zip(mesh.wheels, mesh.axes, mesh.parts, strict=True):
            colour = strokes.LINK.coloured(strokes.colour_of_link(scene, wheel))
            if not axis:
                away = 1.0 if pitch > heights[mesh.axes[0]] else -1.0
                own = shapes.setdefault(wheel, [])
                own.append(Line(at(plane, pitch) - 0.7 * TOOTH, at(plane, pitch) + 0.7 * TOOTH, colour))
                bar(wheel, plane, pitch, pitch + away * RIM)
                if wheel == ground:
                    own += _hatched(at(plane, pitch + away * RIM), away)
                continue
            axes[axis] = None
            away = 1.0 if pitch > heights[axis] else -1.0
            ring = part is not None and part < 0 and all(mesh.axes)  # what runs on a rack has its teeth outside
            tooth = at(plane, pitch - away * (GAP if not ring else -GAP))
            shapes.setdefault(wheel, []).append(Line(tooth - TOOTH / 2, tooth + TOOTH / 2, colour))
            if not ring:
                bar(wheel, plane, heights[axis], pitch - away * GAP)
                on_axis.setdefault((wheel, axis), set()).add(plane)
                if wheel == ground:
                    shapes[wheel] += _hatched(at(plane, heights[axis]), -away)
                continue
            rim = pitch + away * RIM
            bar(wheel, plane, pitch + away * GAP, rim)
            if wheel == ground:
                shapes[wheel] += _hatched(at(plane, rim), away)
            else:
                leg = planes.behind[wheel]
                shapes[wheel] += [Line(at(plane, rim), at(leg, rim), colour),
                                  Line(at(leg, rim), at(leg, heights[axis]), colour)]  # fmt: skip
                on_axis.setdefault((wheel, axis), set()).add(leg)
    for carrier in dict.fromkeys(mesh.carrier for mesh in line.meshes):
        held = [s for s in line.spots_of(carrier) if not s.rolls]
        plane = planes.behind[carrier]
        if carrier == ground:
            for s in held:
                shapes.setdefault(carrier, []).extend(_hatched(at(plane, heights[s.name]), 0.0))
                on_axis.setdefault((carrier, s.name), set()).add(plane)
        elif carrier in scene.by_name:
            ends = [heights[s.name] for s in held]
            if len(held) > 1:
                bar(carrier, plane, min(ends), max(ends))
            for s in held:
                on_axis.setdefault((carrier, s.name), set()).add(plane)
    drawn: list[Primitive] = [Line(complex(0.0, -heights[a]), complex(planes.count * step, -heights[a]), AXIS)
                              for a in axes]  # fmt: skip
    drawn += _shafts(scene, line, on_axis, at, heights)
    drawn += [Group(tuple(own), id=f"plan-link-{link.replace('/', '-')}", classes=("link",))
              for link, own in shapes.items()]  # fmt: skip
    return Piece({"mechanism": tuple(drawn)}, tuple(labels))


def _hatched(z: complex, away: float) -> tuple[Line, ...]:
    """The frame at a place: above it (1), below it (-1), or a bearing to its right (0)."""
    if away == 0.0:
        return hatched_line(z + complex(0.0, 2.6), z - complex(0.0, 2.6))
    half = complex(2.6, 0.0)
    return hatched_line(z + half, z - half) if away < 0 else hatched_line(z - half, z + half)


def _shafts(
    scene: Mechanism, line: CentreLine, on_axis: Mapping[tuple[str, str], set[int]], at: object,
    heights: Mapping[str, float],
) -> Iterator[Primitive]:
    """Wheels of one link that turn about one axis in several planes joined; planets on their pins."""
    assert callable(at)
    for (link, axis), planes in on_axis.items():
        if len(planes) > 1:
            colour = strokes.LINK.coloured(strokes.colour_of_link(scene, link))
            yield Line(at(min(planes), heights[axis]), at(max(planes), heights[axis]), colour)
    for mesh in line.meshes:
        for wheel, axis in zip(mesh.wheels, mesh.axes, strict=True):
            own, held = on_axis.get((wheel, axis), set()), on_axis.get((mesh.carrier, axis), set())
            if axis and own and held and not _central(line, mesh, axis):
                colour = strokes.LINK.coloured(strokes.colour_of_link(scene, mesh.carrier))
                yield Line(at(max(own), heights[axis]), at(max(held), heights[axis]), colour)
                yield Circle(at(max(own), heights[axis]), 0.9, fill=strokes.WHITE, stroke=strokes.OUTLINE)


def _central(line: CentreLine, mesh: Mesh, axis: str) -> bool:
    """Whether several links turn about an axis one in another, so that shafts there would hide each other."""
    return len(line.spot(axis).links) > 2 and axis == line.still
