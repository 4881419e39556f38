"""Drawings as SVG: one user unit is one millimetre, the same bytes every time.

svgwrite stays behind this module.
"""

from __future__ import annotations

import json
import math
import re
from functools import lru_cache
from itertools import chain, count
from typing import Any
from zlib import crc32

from graphkin.drawing.font_widths import has_cjk, runs_width, start_runs
from graphkin.drawing.primitives import (
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
    class_names,
)

__all__ = ["FONTS", "number", "svg_bytes"]

# Times and its twins, then faces that have the signs of mathematics, then Chinese serif faces of Linux, macOS, Windows.
FONTS = (
    "'Times New Roman', 'Liberation Serif', Times, 'STIX Two Text', STIXGeneral, 'Cambria Math', 'DejaVu Serif', "
    "'Noto Serif CJK SC', 'Source Han Serif SC', 'Songti SC', SimSun, serif"
)
# What XML 1.0 cannot hold, and other control characters.
_UNFIT = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")
_INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"


@lru_cache(maxsize=8192)
def number(value: float) -> str:
    """A number as it stands in the file: at most 3 decimals, no trailing zeros, no minus zero.

    Raises ValueError for what is no finite number: a figure never holds one.

    >>> number(12.5), number(-0.0001), number(3.0)
    ('12.5', '0', '3')
    """
    if not math.isfinite(value):
        raise ValueError(f"a coordinate of the drawing is {value}")
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def svg_bytes(drawing: Page, debug: bool = False) -> bytes:
    """The drawing as an SVG file, UTF-8.

    Parameters
    ----------
    drawing : sizes and places in mm
    debug : have svgwrite check every element and attribute against the SVG standard (slow; for tests)

    Raises
    ------
    ValueError : a coordinate is not finite
    """
    import svgwrite

    page = svgwrite.Drawing(size=(f"{number(drawing.width)}mm", f"{number(drawing.height)}mm"), debug=debug)
    if debug:
        _allow_accessibility(page)
    page["viewBox"] = f"0 0 {number(drawing.width)} {number(drawing.height)}"
    page["xmlns:inkscape"] = _INKSCAPE
    page["role"] = "img"
    page["lang"] = page["xml:lang"] = drawing.lang
    page["font-family"] = FONTS
    page["stroke-linejoin"] = "round"
    page["text-rendering"] = "geometricPrecision"
    page.elements.remove(page.defs)  # empty; the title comes first
    facts = json.dumps(drawing.metadata, ensure_ascii=False, sort_keys=True, allow_nan=False, separators=(",", ":"))
    for tag, words in (("title", drawing.title), ("desc", drawing.desc), ("metadata", facts)):
        if words:
            page.elements.append(_words(tag, words))
    # white paper, so that black lines show on a dark screen too
    page.add(page.rect((0, 0), ("100%", "100%"), fill="#ffffff", class_="paper"))
    ink = _Ink(page, drawing.lang)
    for child in drawing.children:
        ink.draw(page, child)
    text: str = page.tostring()
    return f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n'.encode()


class _Ink:
    """Turns primitives into elements of one page; knows the clips and names that it has already given."""

    def __init__(self, page: Any, lang: str) -> None:
        self.page, self.lang = page, lang
        self.clips: set[str] = set()
        self.ids: set[str] = set()

    def draw(self, parent: Any, thing: Primitive) -> None:
        element = parent.add(self._element(thing))
        if isinstance(thing, Line) and thing.covered:
            shaft = _shaft(thing)
            # Named by its shape: where several figures stand in one HTML page, equal names mean equal clips.
            id = f"clip-{crc32(shaft.encode()):08x}"
            element["clip-path"] = f"url(#{id})"
            if id not in self.clips:
                self.clips.add(id)
                clip = self.page.clipPath(id=id)
                clip.add(self.page.path(d=shaft))
                parent.add(clip)

    def _element(self, thing: Primitive) -> Any:
        page = self.page
        if isinstance(thing, Group):
            return self._group(thing)
        if isinstance(thing, Text):
            return self._text(thing)
        if isinstance(thing, Line):
            element = page.line(_pair(thing.start), _pair(thing.end))
        elif isinstance(thing, Polyline):
            element = page.polyline(map(_pair, thing.points), fill="none")
        elif isinstance(thing, Polygon):
            element = page.polygon(map(_pair, thing.points), fill=thing.fill or "none")
        elif isinstance(thing, Circle):
            element = page.circle(_pair(thing.centre), number(thing.radius), fill=thing.fill or "none")
        else:
            element = page.path(d=_arc(thing), fill="none")
        if thing.stroke is not None:
            _stroke(element, thing.stroke)
        return element

    def _group(self, group: Group) -> Any:
        element = self.page.g()
        self._name(element, group.id, class_names(group))
        if group.layer:
            # Set past svgwrite's check, which knows no Inkscape.
            element.attribs["inkscape:groupmode"] = "layer"
            element.attribs["inkscape:label"] = _clean(group.layer)
        for child in group.children:
            self.draw(element, child)
        if group.title:  # last, because the first child of a vector's group is its line
            element.elements.append(_words("title", group.title))
        return element

    def _text(self, text: Text) -> Any:
        runs, anchor = start_runs(text), ""
        if len(runs) == 1 and text.anchor != "start":
            # One run may stand by its own middle or end, exact in whatever face the reader has.
            anchor = text.anchor
            share = 0.5 if anchor == "middle" else 1.0
            x = runs[0].x + share * (runs_width(text.runs) - text.runs[0].x)
            places = [(x, runs[0].y)]
        else:
            places = [(run.x, run.y) for run in runs]
        element = self.page.text("", insert=tuple(map(number, places[0])), fill=text.colour)
        element["font-size"] = number(max(run.size for run in runs))
        self._name(element, text.id, class_names(text))
        if anchor:
            element["text-anchor"] = anchor
        if not self.lang.startswith("zh") and has_cjk(text.string):
            element["xml:lang"] = "zh"
        for run, place in zip(runs, places, strict=True):
            span = self.page.tspan(_clean(run.text), insert=tuple(map(number, place)))
            span["font-size"] = number(run.size)
            if run.italic:
                span["font-style"] = "italic"
            if run.bold:
                span["font-weight"] = "bold"
            element.add(span)
        return element

    def _name(self, element: Any, id: str, classes: tuple[str, ...]) -> None:
        """Id and classes; an id that is taken (B1 of link 2 and B12 are written alike) is told apart by a number."""
        if id:
            free = next(name for name in chain((id,), (f"{id}-{n}" for n in count(2))) if name not in self.ids)
            self.ids.add(free)
            element["id"] = free
        if classes:
            element["class"] = " ".join(classes)


def _clean(text: str) -> str:
    return _UNFIT.sub("", text)


def _pair(point: complex) -> tuple[str, str]:
    return number(point.real), number(point.imag)


def _stroke(element: Any, stroke: Stroke) -> None:
    element["stroke"] = stroke.colour
    element["stroke-width"] = number(stroke.width)
    if stroke.dash:
        element["stroke-dasharray"] = " ".join(map(number, stroke.dash))


def _arc(arc: Arc) -> str:
    start, end = arc.at(arc.start), arc.at(arc.end)
    large = "1" if abs(arc.end - arc.start) > math.pi else "0"
    sweep = "0" if arc.end > arc.start else "1"  # the sweep flag of SVG turns clockwise on the page
    radius = number(arc.radius)
    return f"M{' '.join(_pair(start))}A{radius} {radius} 0 {large} {sweep} {' '.join(_pair(end))}"


def _shaft(line: Line) -> str:
    """The area around the inked part of a line, as a path."""
    along = (line.end - line.start) / abs(line.end - line.start)
    side = 1j * along * line.stroke.width
    back, front = line.start - along * line.stroke.width, line.inked_end
    corners = (back + side, front + side, front - side, back - side)
    return "M" + "L".join(" ".join(_pair(corner)) for corner in corners) + "Z"


def _words(tag: str, words: str) -> Any:
    """An element that holds nothing but words."""
    from svgwrite.base import Title

    element = Title(_clean(words))
    element.xml.tag = element.elementname = tag
    return element


def _allow_accessibility(page: Any) -> None:
    """Teach svgwrite's check of SVG 1.1 the attributes for readers and editors that later standards have."""
    from svgwrite.data.types import SVGAttribute
    from svgwrite.extensions import Inkscape

    Inkscape(page)
    del page.attribs["xmlns:sodipodi"]
    known = page.validator
    for name in ("role", "lang"):
        known.attributes[name] = SVGAttribute(name, anim=False, types=frozenset(["string"]), const=frozenset())
        known.elements["svg"].valid_attributes = {name} | known.elements["svg"].valid_attributes
