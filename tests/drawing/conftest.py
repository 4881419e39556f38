"""A reader of finished figures: what a person with the printed SVG could find fault with."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
import pytest
import shapely

SVG = "{http://www.w3.org/2000/svg}"
JOINT = 4.0  # mm: wider circles are outlines of rollers and discs, in which names may stand
# Boxes touch by this much (mm) before it counts: the rounding of the file.
TOUCH = 0.05


@dataclass
class Figure:
    """Texts (string, box), solid lines, arrowheads and joint symbols of one file, as shapely geometries."""

    page: shapely.Polygon
    texts: list[tuple[str, shapely.Geometry]] = field(default_factory=list)
    solid: list[shapely.Geometry] = field(default_factory=list)
    strokes: list[shapely.Geometry] = field(default_factory=list)
    arrowheads: list[shapely.Geometry] = field(default_factory=list)
    joints: list[shapely.Geometry] = field(default_factory=list)


FILES = {"": "regular", "Italic": "italic", "Bol": "bold"}


@lru_cache(maxsize=4)
def _face(style: str):
    from fontTools.ttLib import TTFont

    from graphkin.drawing.font import FOLDER

    font = TTFont(FOLDER / f"{FILES[style]}.ttf")
    return font.getBestCmap(), font["hmtx"]


@lru_cache(maxsize=4096)
def advance(text: str, style: str = "") -> float:
    """Width of a text of size 1 in the family of the figures, as fontTools reads it."""
    total = 0.0
    for character in text:
        cmap, advances = _face(style if ord(character) in _face(style)[0] else "")
        total += advances[cmap[ord(character)]][0] / 1000
    return total


def _numbers(text: str) -> list[float]:
    return [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?", text)]


def _text(element: ET.Element) -> tuple[str, shapely.Geometry]:
    boxes = []
    for span in element.iter(f"{SVG}tspan"):
        size, x, y = (float(span.get(key)) for key in ("font-size", "x", "y"))
        style = "Italic" if span.get("font-style") == "italic" else "Bol" if span.get("font-weight") == "bold" else ""
        wide = size * advance(span.text, style)
        left = x - wide * {"middle": 0.5, "end": 1.0}.get(element.get("text-anchor", ""), 0.0)
        boxes.append(shapely.box(left, y - 0.68 * size, left + wide, y + 0.22 * size))
    return "".join(element.itertext()), shapely.union_all(boxes)


def _shape(element: ET.Element) -> shapely.Geometry | None:
    tag = element.tag.removeprefix(SVG)
    if tag == "line":
        ends = [float(element.get(key)) for key in ("x1", "y1", "x2", "y2")]
        return shapely.LineString([ends[:2], ends[2:]])
    if tag in ("polyline", "polygon"):
        values = _numbers(element.get("points"))
        points = list(zip(values[::2], values[1::2], strict=True))
        return shapely.LineString(points) if tag == "polyline" else shapely.Polygon(points)
    if tag == "circle":
        centre = shapely.Point(float(element.get("cx")), float(element.get("cy")))
        return centre.buffer(float(element.get("r")))
    if tag == "path":
        x0, y0, r, _, _, large, sweep, x1, y1 = _numbers(element.get("d"))
        return _arc(complex(x0, y0), complex(x1, y1), r, bool(large), bool(sweep))
    return None


def _arc(start: complex, end: complex, radius: float, large: bool, sweep: bool) -> shapely.Geometry:
    half = (end - start) / 2
    rise = math.sqrt(max(radius**2 - abs(half) ** 2, 0.0))
    side = 1j if large != sweep else -1j
    centre = start + half + side * rise * half / abs(half)
    first = math.atan2((start - centre).imag, (start - centre).real)
    turn = math.atan2(((end - centre) / (start - centre)).imag, ((end - centre) / (start - centre)).real)
    if sweep and turn < 0:
        turn += 2 * math.pi
    if not sweep and turn > 0:
        turn -= 2 * math.pi
    angles = [first + turn * i / 24 for i in range(25)]
    return shapely.LineString(
        [(centre.real + radius * math.cos(t), centre.imag + radius * math.sin(t)) for t in angles]
    )


def read_figure(svg: bytes) -> Figure:
    """Read a file as its parts."""
    root = ET.fromstring(svg)
    figure = Figure(shapely.box(*_corners(root)))

    def visit(element: ET.Element) -> None:
        for child in element:
            if child.tag == f"{SVG}clipPath":
                continue
            if child.tag == f"{SVG}text":
                figure.texts.append(_text(child))
                continue
            shape = _shape(child)
            if shape is not None:
                _sort(figure, child, shape)
            visit(child)

    visit(root)
    return figure


def _corners(root: ET.Element) -> tuple[float, float, float, float]:
    x, y, wide, high = _numbers(root.get("viewBox"))
    return x, y, x + wide, y + high


def _sort(figure: Figure, element: ET.Element, shape: shapely.Geometry) -> None:
    stroked = element.get("stroke") is not None
    if element.tag == f"{SVG}circle" and (not stroked or float(element.get("r")) <= JOINT):
        figure.joints.append(shape)
    elif element.tag == f"{SVG}polygon" and not stroked and shape.length < 12:
        figure.arrowheads.append(shape)
    elif stroked:
        course = shape.boundary if element.tag in (f"{SVG}polygon", f"{SVG}circle") else shape
        figure.strokes.append(course)
        if element.get("stroke-dasharray") is None:
            figure.solid.append(course)


def count_violations(svg: bytes) -> list[str]:
    """Every fault of the placing of labels in a finished file, in words."""
    figure = read_figure(svg)
    found = []
    names = [text for text, _ in figure.texts]
    inner = shapely.buffer(np.array([box for _, box in figure.texts], dtype=object), -TOUCH)
    for one, other in shapely.STRtree(inner).query(inner, predicate="intersects").T:
        if one < other:
            found.append(f"{names[one]!r} overlaps {names[other]!r}")
    kinds = (("is crossed by a line", figure.solid), ("covers an arrowhead", figure.arrowheads),
             ("covers a joint", figure.joints))
    for words, shapes in kinds:
        tree = shapely.STRtree(shapes)
        found += [f"{names[i]!r} {words}" for i in tree.query(inner, predicate="intersects")[0]]
    for text, box in figure.texts:
        if not figure.page.contains(box):
            found.append(f"{text!r} runs off the page")
    for shape in (*figure.strokes, *figure.arrowheads, *figure.joints):
        if not figure.page.covers(shape):
            found.append(f"a shape runs off the page at {shape.bounds}")
    return found


@pytest.fixture(scope="session")
def violations() -> Callable[[bytes], list[str]]:
    """Every fault of the placing of labels in a finished SVG file, in words; an empty list is a good figure."""
    return count_violations


@pytest.fixture(scope="session")
def true_width() -> Callable[[str, str], float]:
    """Width of a text of size 1 in STIX General itself; style is "", "Italic" or "Bol"."""
    return advance


