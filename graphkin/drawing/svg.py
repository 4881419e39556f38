"""Drawings as SVG: one user unit is one millimetre, the same bytes every time.

Elements are written as they are drawn, their attributes in the order of the alphabet; that each is one of SVG 1.1 with
values that it may have is checked by the tests.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from functools import lru_cache
from itertools import chain, count
from zlib import crc32

from graphkin.drawing.font_widths import has_cjk, runs_width, start_runs
from graphkin.drawing.primitives import Arc, Circle, Group, Line, Page, Polygon, Polyline, Primitive, Stroke, Text

__all__ = ["FONTS", "number", "svg_bytes"]

# Times and its twins, then faces that have the signs of mathematics, then Chinese serif faces of Linux, macOS, Windows.
FONTS = (
    "'Times New Roman', 'Liberation Serif', Times, 'STIX Two Text', STIXGeneral, 'Cambria Math', 'DejaVu Serif', "
    "'Noto Serif CJK SC', 'Source Han Serif SC', 'Songti SC', SimSun, serif"
)
# What XML 1.0 cannot hold, and other control characters.
_UNFIT = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")
_SIGNS = str.maketrans({
    "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "\r": "&#13;", "\n": "&#10;", "\t": "&#09;",
})  # fmt: skip
_NAMES = {
    "xmlns": "http://www.w3.org/2000/svg",
    "xmlns:ev": "http://www.w3.org/2001/xml-events",
    "xmlns:inkscape": "http://www.inkscape.org/namespaces/inkscape",
    "xmlns:xlink": "http://www.w3.org/1999/xlink",
}


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


def svg_bytes(drawing: Page) -> bytes:
    """The drawing as an SVG file, UTF-8.

    Raises
    ------
    ValueError : a coordinate is not finite
    """
    width, height = number(drawing.width), number(drawing.height)
    page = {
        **_NAMES,
        "baseProfile": "full",
        "font-family": FONTS,
        "height": f"{height}mm",
        "lang": drawing.lang,
        "role": "img",
        "stroke-linejoin": "round",
        "text-rendering": "geometricPrecision",
        "version": "1.1",
        "viewBox": f"0 0 {width} {height}",
        "width": f"{width}mm",
        "xml:lang": drawing.lang,
    }
    facts = json.dumps(drawing.metadata, ensure_ascii=False, sort_keys=True, allow_nan=False, separators=(",", ":"))
    words = (("title", drawing.title), ("desc", drawing.desc), ("metadata", facts))
    ink = _Ink(drawing.lang)
    parts = [
        '<?xml version="1.0" encoding="utf-8"?>\n', _open("svg", page), ">",
        *(_element(tag, {}, _words(text)) for tag, text in words if text),
        # white paper, so that black lines show on a dark screen too
        _element("rect", {"class": "paper", "fill": "#ffffff", "height": "100%", "width": "100%", "x": "0", "y": "0"}),
        *(part for child in drawing.children for part in ink.drawn(child)),
        "</svg>\n",
    ]  # fmt: skip
    return "".join(parts).encode()


class _Ink:
    """Writes primitives as elements of one page; knows the clips and names that it has already given."""

    def __init__(self, lang: str) -> None:
        self.lang = lang
        self.clips: set[str] = set()
        self.ids: set[str] = set()

    def drawn(self, thing: Primitive) -> Iterator[str]:
        if isinstance(thing, Group):
            yield from self._group(thing)
        elif isinstance(thing, Text):
            yield self._text(thing)
        elif isinstance(thing, Line):
            yield from self._line(thing)
        elif isinstance(thing, Polyline):
            yield _element("polyline", {"fill": "none", "points": _points(thing.points), **_stroke(thing.stroke)})
        elif isinstance(thing, Polygon):
            fill = thing.fill or "none"
            yield _element("polygon", {"fill": fill, "points": _points(thing.points), **_stroke(thing.stroke)})
        elif isinstance(thing, Circle):
            x, y = _pair(thing.centre)
            look = {"cx": x, "cy": y, "fill": thing.fill or "none", "r": number(thing.radius)}
            yield _element("circle", {**look, **_stroke(thing.stroke)})
        else:
            yield _element("path", {"d": _arc(thing), "fill": "none", **_stroke(thing.stroke)})

    def _line(self, line: Line) -> Iterator[str]:
        (x1, y1), (x2, y2) = _pair(line.start), _pair(line.end)
        ends = {**_stroke(line.stroke), "x1": x1, "x2": x2, "y1": y1, "y2": y2}
        if not line.covered:
            yield _element("line", ends)
            return
        shaft = _shaft(line)
        # Named by its shape: where several figures stand in one HTML page, equal names mean equal clips.
        id = f"clip-{crc32(shaft.encode()):08x}"
        yield _element("line", {"clip-path": f"url(#{id})", **ends})
        if id not in self.clips:
            self.clips.add(id)
            yield _element("clipPath", {"id": id}, _element("path", {"d": shaft}))

    def _group(self, group: Group) -> Iterator[str]:
        layer = {"inkscape:groupmode": "layer", "inkscape:label": _clean(group.layer)} if group.layer else {}
        inside = "".join(part for child in group.children for part in self.drawn(child))
        if group.title:  # last, because the first child of a vector's group is its line
            inside += _element("title", {}, _words(group.title))
        yield _element("g", {**self._named(group.id, group.classes), **layer}, inside)

    def _text(self, text: Text) -> str:
        runs, anchor = start_runs(text), ""
        places = [(number(run.x), number(run.y)) for run in runs]
        if len(runs) == 1 and text.anchor != "start":
            # One run may stand by its own middle or end, exact in whatever face the reader has.
            anchor = text.anchor
            share = 0.5 if anchor == "middle" else 1.0
            places = [(number(runs[0].x + share * (runs_width(text.runs) - text.runs[0].x)), places[0][1])]
        spans = []
        for run, (x, y) in zip(runs, places, strict=True):
            face = f'font-size="{number(run.size)}"'
            if run.italic:
                face += ' font-style="italic"'
            if run.bold:
                face += ' font-weight="bold"'
            spans.append(f'<tspan {face} x="{x}" y="{y}">{_words(run.text)}</tspan>')
        look = {**self._named(text.id, text.classes), "fill": text.colour}
        look["font-size"] = number(max(run.size for run in runs))
        if anchor:
            look["text-anchor"] = anchor
        look["x"], look["y"] = places[0]
        if not self.lang.startswith("zh") and has_cjk(text.string):
            look["xml:lang"] = "zh"
        return _element("text", look, "".join(spans))

    def _named(self, id: str, classes: tuple[str, ...]) -> dict[str, str]:
        """Id and classes; an id that is taken (B1 of link 2 and B12 are written alike) is told apart by a number."""
        free = ""
        if id:
            free = next(name for name in chain((id,), (f"{id}-{n}" for n in count(2))) if name not in self.ids)
            self.ids.add(free)
        return {"class": " ".join(classes), "id": free}


def _element(tag: str, attributes: dict[str, str], inside: str = "") -> str:
    start = _open(tag, attributes)
    return f"{start}>{inside}</{tag}>" if inside else f"{start} />"


def _open(tag: str, attributes: dict[str, str]) -> str:
    """The beginning of an element, without attributes that are empty."""
    written = [f' {name}="{value.translate(_SIGNS)}"' for name, value in sorted(attributes.items()) if value]
    return f"<{tag}{''.join(written)}"


def _words(text: str) -> str:
    """Words as the content of an element."""
    return _clean(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def _clean(text: str) -> str:
    return _UNFIT.sub("", text)


def _pair(point: complex) -> tuple[str, str]:
    return number(point.real), number(point.imag)


def _points(points: tuple[complex, ...]) -> str:
    return " ".join(f"{number(z.real)},{number(z.imag)}" for z in points)


def _stroke(stroke: Stroke | None) -> dict[str, str]:
    if stroke is None:
        return {}
    dashes = " ".join(map(number, stroke.dash))
    return {"stroke": stroke.colour, "stroke-dasharray": dashes, "stroke-width": number(stroke.width)}


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
