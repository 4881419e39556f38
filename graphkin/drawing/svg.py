"""Drawings as SVG: one user unit is one millimetre, the same bytes every time.

svgwrite stays behind this module.
"""

from __future__ import annotations

import json
import math
import re
from typing import Any

from graphkin.drawing.metrics import has_cjk, runs_width, start_runs
from graphkin.drawing.primitives import (
    Arc,
    Circle,
    Drawing,
    Group,
    Line,
    Polygon,
    Polyline,
    Primitive,
    Stroke,
    Text,
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


def svg_bytes(drawing: Drawing, debug: bool = False) -> bytes:
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
    labelled = [
        (id, element(_clean(words)))
        for id, element, words in (
            ("title", svgwrite.base.Title, drawing.title),
            ("desc", svgwrite.base.Desc, drawing.desc),
        )
        if words
    ]
    for id, element in labelled:
        element["id"] = id
        page.elements.append(element)
    if labelled:
        page["aria-labelledby"] = " ".join(id for id, _ in labelled)
    page.elements.append(_metadata(svgwrite, drawing))
    ink = _Ink(page, drawing.lang, clips=0)
    for child in drawing.children:
        ink.draw(page, child)
    return ('<?xml version="1.0" encoding="utf-8"?>\n' + page.tostring() + "\n").encode()


class _Ink:
    """Turns primitives into elements of one page; counts the clips that end lines under arrowheads."""

    def __init__(self, page: Any, lang: str, clips: int) -> None:
        self.page, self.lang, self.clips = page, lang, clips

    def draw(self, parent: Any, thing: Primitive) -> None:
        parent.add(self._element(thing))
        if isinstance(thing, Line) and thing.covered:
            clip = self.page.clipPath(id=f"clip-{self.clips}")
            clip.add(self.page.path(d=_shaft(thing)))
            parent.elements[-1]["clip-path"] = f"url(#clip-{self.clips})"
            parent.add(clip)
            self.clips += 1

    def _element(self, thing: Primitive) -> Any:
        page = self.page
        if isinstance(thing, Group):
            return self._group(thing)
        if isinstance(thing, Text):
            return self._text(thing)
        if isinstance(thing, Line):
            element = page.line(_pair(thing.start), _pair(thing.end))
        elif isinstance(thing, Polyline):
            element = page.polyline(fill="none")
            element["points"] = _points(thing.points)
        elif isinstance(thing, Polygon):
            element = page.polygon(fill=thing.fill or "none")
            element["points"] = _points(thing.points)
        elif isinstance(thing, Circle):
            element = page.circle(_pair(thing.centre), number(thing.radius), fill=thing.fill or "none")
        else:
            element = page.path(d=_arc(thing), fill="none")
        if thing.stroke is not None:
            _stroke(element, thing.stroke)
        return element

    def _group(self, group: Group) -> Any:
        element = self.page.g()
        _name(element, group.id, group.classes)
        if group.layer:
            # Set past svgwrite's check, which knows no Inkscape.
            element.attribs["inkscape:groupmode"] = "layer"
            element.attribs["inkscape:label"] = _clean(group.layer)
        for child in group.children:
            self.draw(element, child)
        if group.title:  # last, because the first child of a vector's group is its line
            element.elements.append(self.page_title(group.title))
        return element

    def page_title(self, words: str) -> Any:
        from svgwrite.base import Title

        return Title(_clean(words))

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
        _name(element, text.id, text.classes)
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


def _clean(text: str) -> str:
    return _UNFIT.sub("", text)


def _pair(point: complex) -> tuple[str, str]:
    return number(point.real), number(point.imag)


def _points(points: tuple[complex, ...]) -> str:
    return " ".join(",".join(_pair(point)) for point in points)


def _name(element: Any, id: str, classes: tuple[str, ...]) -> None:
    if id:
        element["id"] = id
    if classes:
        element["class"] = " ".join(classes)


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


def _metadata(svgwrite: Any, drawing: Drawing) -> Any:
    element = svgwrite.base.Metadata()
    text = json.dumps(drawing.metadata, ensure_ascii=False, sort_keys=True, allow_nan=False, separators=(",", ":"))
    plain_xml = element.get_xml

    def with_text() -> Any:
        xml = plain_xml()
        xml.text = _clean(text)
        return xml

    element.get_xml = with_text
    return element


def _allow_accessibility(page: Any) -> None:
    """Teach svgwrite's check of SVG 1.1 the attributes for readers and editors that later standards have."""
    from svgwrite.data.types import SVGAttribute
    from svgwrite.extensions import Inkscape

    Inkscape(page)
    known = page.validator
    for name in ("role", "lang", "aria-labelledby"):
        known.attributes[name] = SVGAttribute(name, anim=False, types=frozenset(["string"]), const=frozenset())
        known.elements["svg"].valid_attributes = {name} | known.elements["svg"].valid_attributes
