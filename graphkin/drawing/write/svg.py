"""Drawings as SVG: one user unit is one millimetre, the same bytes every time.

svgwrite stays behind this module.
"""

from __future__ import annotations

import json
import math
import re
from base64 import b64encode
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache, lru_cache, partial
from html import escape
from itertools import count
from typing import TYPE_CHECKING, Protocol
from zlib import crc32

from graphkin.drawing.embedded import face_rules, families, outline
from graphkin.drawing.font import Style
from graphkin.drawing.font_widths import has_cjk, runs_width, start_runs, style_of, width
from graphkin.drawing.ink.primitives import (
    PALE,
    Arc,
    Circle,
    Group,
    Line,
    Page,
    Polygon,
    Polyline,
    Primitive,
    Run,
    Scan,
    Stroke,
    Text,
    Travel,
    class_names,
)

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element as XmlElement

    import svgwrite

__all__ = ["number", "svg_bytes", "svg_element"]

# What XML 1.0 cannot hold, and other control characters.
_UNFIT = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")
_HIDING = re.compile("[\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069\ufeff]")  # what could hide what stands beside it
_MARKUP = re.compile('[&<>"\\r\\n\\t]')
_IN_QUOTES = str.maketrans({'"': "&quot;", "\r": "&#13;", "\n": "&#10;", "\t": "&#09;"})
_DOUBLED = re.compile(r"#(\w)\1(\w)\2(\w)\3")
_SPACES = re.compile(r"\s+")
BLACK = "#000000"  # what is filled unless something else is said
HIT = Stroke(3.0)  # mm: the breadth of a finger
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


def svg_bytes(drawing: Page, debug: bool = False, embed: bool = True, outlines: bool = False) -> bytes:
    """The drawing as an SVG file, UTF-8.

    Parameters
    ----------
    drawing : sizes and places in mm
    debug : have svgwrite check every element and attribute against the SVG standard (slow; for tests)
    embed : whether the used glyphs come with it; not where a page holds them for all its figures
    outlines : letters as paths, for programs without fonts; the text lies over them without colour, for search and for
        readers of screens

    Raises
    ------
    ValueError : a coordinate is not finite
    """
    page = _page(debug)
    if debug:
        _allow_accessibility(page)
    page.attribs |= _head(drawing)
    page["xmlns:inkscape"] = _INKSCAPE
    page["xml:lang"] = drawing.lang
    page.elements.remove(page.defs)  # empty; the title comes first
    ink = _Ink(page, drawing.lang, outlines)
    facts = json.dumps(drawing.metadata, ensure_ascii=False, sort_keys=True, allow_nan=False, separators=(",", ":"))
    for tag, words in (("title", drawing.title), ("desc", drawing.desc), ("metadata", facts)):
        if words:
            page.elements.append(ink.made(tag, {}, _clean(words)))
    places = len(page.elements)
    ink.fill(drawing)
    if embed:
        name, rules = face_rules({} if outlines else ink.used)
        page["font-family"] = families(name)
        if rules:
            page.elements.insert(places, ink.made("style", {}, rules))
    text: str = page.tostring() if debug else _written(page)
    return f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n'.encode()


def svg_element(drawing: Page, named: bool = False) -> str:
    """The drawing as an element of a page, which brings the letters; its title and description are read aloud.

    It is as short as can be, for a page may hold hundreds: no layers, no lengths of texts, nothing that goes without
    saying.  Lines end under their arrowheads by a dash and not by a clip, whose name would have to be unique in the
    page.

    Parameters
    ----------
    drawing : sizes and places in mm
    named : whether vectors, points and links keep their names, which stand once in a page, and vectors have a band of a
        finger's breadth that is not seen but felt by the pointer

    Raises
    ------
    ValueError : a coordinate is not finite
    """
    page = _page(False)
    page.elements.clear()
    _InPage(page, drawing.lang, named).fill(drawing)
    words = _clean(_HIDING.sub("", _SPACES.sub(" ", f"{drawing.title}. {drawing.desc}".strip(". "))))
    out = [_tag("svg", {**_head(drawing), "aria-label": words, "focusable": "false"}), ">"]
    for element in page.elements:
        _write(element, out, "/>")
    return "".join([*out, "</svg>"])


def _page(debug: bool) -> svgwrite.Drawing:
    import svgwrite

    return svgwrite.Drawing(debug=debug)


def _head(drawing: Page) -> dict[str, str]:
    """What the outermost element says of a page."""
    width, height = number(drawing.width), number(drawing.height)
    return {
        "width": f"{width}mm", "height": f"{height}mm", "viewBox": f"0 0 {width} {height}", "role": "img",
        "lang": drawing.lang, "stroke-linejoin": "round", "text-rendering": "geometricPrecision",
    }  # fmt: skip


class _Element(Protocol):
    """An element of svgwrite."""

    elementname: str
    attribs: dict[str, str]
    elements: list[_Element]
    text: str

    def add(self, element: _Element) -> _Element: ...


class _Page(_Element, Protocol):
    """A page of svgwrite, with its options."""

    _parameter: object

    def tostring(self) -> str: ...


class _Ink:
    """Turns primitives into elements of one page; knows the clips and names that it has already given."""

    def __init__(self, page: _Page, lang: str, outlines: bool = False) -> None:
        self.page, self.lang, self.outlines = page, lang, outlines
        self.made = partial(_element_class(), page)
        self.clips: set[str] = set()
        self.ids: set[str] = set()
        self.used: dict[Style, set[str]] = {"regular": set(), "italic": set(), "bold": set()}

    def fill(self, drawing: Page) -> None:
        """Put everything on the page."""
        # white paper, so that black lines show on a dark screen too
        whole = {"x": "0", "y": "0", "width": "100%", "height": "100%"}
        self.page.add(self.made("rect", {**whole, **self.filled("#ffffff"), "class": "paper"}))
        for child in drawing.children:
            self.draw(self.page, child)

    def colour(self, colour: str) -> str:
        return colour

    def filled(self, colour: str) -> dict[str, str]:
        """The attribute of an area, empty for none."""
        return {"fill": self.colour(colour) or "none"}

    def draw(self, parent: _Element, thing: Primitive) -> None:
        element = parent.add(self._element(thing))
        if isinstance(thing, Line) and thing.covered:
            shaft = _shaft(thing)
            # Named by its shape: where several figures stand in one HTML page, equal names mean equal clips.
            id = f"clip-{crc32(shaft.encode()):08x}"
            element.attribs["clip-path"] = f"url(#{id})"
            if id not in self.clips:
                self.clips.add(id)
                clip = self.made("clipPath", {"id": id})
                clip.add(self.made("path", {"d": shaft}))
                parent.add(clip)

    def _element(self, thing: Primitive) -> _Element:
        if isinstance(thing, Group):
            return self._group(thing)
        if isinstance(thing, Text):
            return self._text(thing)
        if isinstance(thing, Scan):
            return self._scan(thing)
        stroke = self._stroke(thing.stroke)
        if isinstance(thing, Line):
            (x1, y1), (x2, y2) = _pair(thing.start), _pair(thing.end)
            return self.made("line", {"x1": x1, "y1": y1, "x2": x2, "y2": y2, **stroke})
        if isinstance(thing, Polyline):
            return self.made("polyline", {"points": _points(thing.points), "fill": "none", **stroke})
        if isinstance(thing, Polygon):
            return self.made("polygon", {"points": _points(thing.points), **self.filled(thing.fill), **stroke})
        if isinstance(thing, Circle):
            x, y = _pair(thing.centre)
            look = {"cx": x, "cy": y, "r": number(thing.radius)}
            return self.made("circle", {**look, **self.filled(thing.fill), **stroke})
        return self.made("path", {"d": _arc(thing), "fill": "none", **stroke})

    def _stroke(self, stroke: Stroke | None) -> dict[str, str]:
        if stroke is None:
            return {}
        dashes = {"stroke-dasharray": " ".join(map(number, stroke.dash))} if stroke.dash else {}
        return {"stroke": self.colour(stroke.colour), "stroke-width": number(stroke.width), **dashes}

    def _group(self, group: Group) -> _Element:
        element = self.made("g", self._called(group))
        inner = element if group.motion is None else self._moving(element, group.motion)
        for child in group.children:
            self.draw(inner, child)
        last = self._last_of(group)  # last, because the first child of a vector's group is its line
        if last is not None:
            element.elements.append(last)
        return element

    def _called(self, group: Group) -> dict[str, str]:
        """Id, classes and layer of a group."""
        layer = {"inkscape:groupmode": "layer", "inkscape:label": _clean(group.layer)} if group.layer else {}
        return {**self._named(group.id, class_names(group)), **layer}

    def _last_of(self, group: Group) -> _Element | None:
        """What stands in a group behind its children: its title."""
        return self.made("title", {}, _clean(group.title)) if group.title else None

    def _moving(self, element: _Element, motion: Travel) -> _Element:
        """Have an element move; returns the one that turns in it."""

        def animated(parent: _Element, attributes: dict[str, str], tag: str = "animateTransform") -> None:
            always = {"dur": f"{number(motion.seconds)}s", "repeatCount": "indefinite"}
            parent.add(self.made(tag, {**attributes, **always}))

        moves, last = [], next((m for m in motion.moves if m is not None), 0j)
        for move in motion.moves:
            last = last if move is None else move
            moves.append(" ".join(_pair(last)))
        transform = {"attributeName": "transform", "attributeType": "XML"}
        animated(element, {**transform, "type": "translate", "values": ";".join(moves)})
        if None in motion.moves:
            seen = ";".join("hidden" if m is None else "visible" for m in motion.moves)
            animated(element, {"attributeName": "visibility", "values": seen, "calcMode": "discrete"}, "animate")
        if not motion.turns:
            return element
        inner, (x, y) = self.made("g", {}), _pair(motion.about)
        turns = ";".join(f"{number(turn)} {x} {y}" for turn in motion.turns)
        animated(inner, {**transform, "type": "rotate", "values": turns})
        return element.add(inner)

    def _scan(self, scan: Scan) -> _Element:
        """A picture with its file in it, cut by a clip that stands beside it."""
        shape = "M" + "L".join(" ".join(_pair(corner)) for corner in scan.panel) + "Z"
        group = self.made("g", {"clip-path": f"url(#clip-{crc32(shape.encode()):08x})"})
        clip = self.made("clipPath", {"id": f"clip-{crc32(shape.encode()):08x}"})
        clip.add(self.made("path", {"d": shape}))
        a, b = scan.step.real, scan.step.imag
        look = {"width": str(scan.width), "height": str(scan.height), "opacity": number(PALE)}
        look["transform"] = f"matrix({a:.9g} {b:.9g} {-b:.9g} {a:.9g} {scan.corner.real:.6f} {scan.corner.imag:.6f})"
        look["xlink:href"] = f"data:{scan.kind};base64,{b64encode(scan.data).decode()}"
        group.add(clip)
        group.add(self.made("image", look))
        return group

    def _text(self, text: Text) -> _Element:
        runs, anchor = start_runs(text), ""
        places = [(number(run.x), number(run.y)) for run in runs]
        if len(runs) == 1 and text.anchor != "start":
            # One run may stand by its own middle or end, exact in whatever face the reader has.
            anchor = text.anchor
            share = 0.5 if anchor == "middle" else 1.0
            places = [(number(runs[0].x + share * (runs_width(text.runs) - text.runs[0].x)), places[0][1])]
        look = {"x": places[0][0], "y": places[0][1], **self.filled(text.colour)}
        look |= self._named(text.id, class_names(text))
        look["font-size"] = number(max(run.size for run in runs))
        if anchor:
            look["text-anchor"] = anchor
        if not self.lang.startswith("zh") and has_cjk(text.string):
            look["xml:lang"] = "zh"
        element = self.made("text", look)
        for run, (x, y) in zip(runs, places, strict=True):
            words = _clean(run.text)
            face = {"x": x, "y": y, "font-size": number(run.size)}
            if run.italic:
                face["font-style"] = "italic"
            if run.bold:
                face["font-weight"] = "bold"
            element.add(self._run(run, face, words, look))
        return self._outlined(element, runs) if self.outlines else element

    def _run(self, run: Run, face: dict[str, str], words: str, text: Mapping[str, str]) -> _Element:
        """A run of a text of these attributes, with its length."""
        self.used[style_of(run.italic, run.bold)].update(words)
        long = number(width(words, run.size, run.italic, run.bold))
        return self.made("tspan", {**face, "textLength": long, "lengthAdjust": "spacingAndGlyphs"}, words)

    def _outlined(self, element: _Element, runs: tuple[Run, ...]) -> _Element:
        """A text as paths, with itself unseen over them."""
        own = {key: element.attribs.pop(key) for key in ("id", "class") if key in element.attribs}
        group = self.made("g", own)
        letters = "".join(outline(run._replace(text=_clean(run.text))) for run in runs)
        if letters:
            group.add(self.made("path", {"d": letters, "fill": element.attribs["fill"], "aria-hidden": "true"}))
            element.attribs["fill"] = "none"
        group.add(element)
        return group

    def _named(self, id: str, classes: tuple[str, ...]) -> dict[str, str]:
        """Id and classes; an id that is taken (B1 of link 2 and B12 are written alike) is told apart by a number."""
        named = {"class": " ".join(classes)} if classes else {}
        if id:
            free = id if id not in self.ids else next(n for k in count(2) if (n := f"{id}-{k}") not in self.ids)
            self.ids.add(free)
            named["id"] = free
        return named


class _InPage(_Ink):
    """Turns primitives into the elements of a figure in a page."""

    def __init__(self, page: _Page, lang: str, named: bool) -> None:
        super().__init__(page, lang)
        self.named = named

    def colour(self, colour: str) -> str:
        return _DOUBLED.sub(r"#\1\2\3", colour)

    def filled(self, colour: str) -> dict[str, str]:
        return {} if colour == BLACK else super().filled(colour)

    def draw(self, parent: _Element, thing: Primitive) -> None:
        if isinstance(thing, Line) and thing.covered:
            inked = abs(thing.inked_end - thing.start)
            dashed = replace(thing.stroke, dash=(inked, abs(thing.end - thing.start) + 1.0))
            thing = Line(thing.start, thing.end, dashed)
        super().draw(parent, thing)

    def _called(self, group: Group) -> dict[str, str]:
        return self._named("" if group.layer else group.id, class_names(group))

    def _named(self, id: str, classes: tuple[str, ...]) -> dict[str, str]:
        return super()._named(id if self.named else "", classes)

    def _last_of(self, group: Group) -> _Element | None:
        shaft = group.children[0] if self.named and "vector" in group.classes and group.children else None
        if not isinstance(shaft, Line) or shaft.start == shaft.end:
            return None
        return self._group(Group((Line(shaft.start, shaft.end, HIT),), classes=("hit",)))

    def _run(self, run: Run, face: dict[str, str], words: str, text: Mapping[str, str]) -> _Element:
        if face["font-size"] == text["font-size"] and (face["x"], face["y"]) == (text["x"], text["y"]):
            face = {key: value for key, value in face.items() if key not in ("font-size", "x", "y")}  # of its text
        return self.made("tspan", face, words)


def _clean(text: str) -> str:
    # what is printable is fit, and that is told at once
    return text if text.isprintable() else _UNFIT.sub("", text)


def _pair(point: complex) -> tuple[str, str]:
    return number(point.real), number(point.imag)


def _points(points: tuple[complex, ...]) -> str:
    return " ".join(f"{number(z.real)},{number(z.imag)}" for z in points)


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


@cache
def _element_class() -> Callable[..., _Element]:
    from svgwrite.base import BaseElement

    class Element(BaseElement):  # type: ignore[misc]
        """An element of svgwrite whose attributes are texts already, and which may hold a text."""

        def __init__(self, page: _Page, tag: str, attributes: dict[str, str], text: str = "") -> None:
            self._parameter = page._parameter  # its own way looks at each for options of svgwrite
            self.elementname, self.attribs, self.text = tag, attributes, text
            self.elements: list[_Element] = []

        def get_xml(self) -> XmlElement:
            xml: XmlElement = super().get_xml()
            xml.text = self.text
            return xml

    return Element


def _written(page: _Page) -> str:
    """The text that ``page.tostring()`` gives, which makes a tree of it first and takes several times as long."""
    children, page.elements = page.elements, []
    out = [page.tostring().removesuffix(" />"), ">"]
    for child in children:
        _write(child, out)
    page.elements = children
    return "".join([*out, "</svg>"])


def _write(element: _Element, out: list[str], end: str = " />") -> None:
    """An element as text, one that holds nothing closed by ``end``."""
    opening = _tag(element.elementname, element.attribs)
    if element.elements:
        out.append(f"{opening}>{_escaped(element.text)}")
        for child in element.elements:
            _write(child, out, end)
        out.append(f"</{element.elementname}>")
    elif element.text:
        out.append(f"{opening}>{_escaped(element.text)}</{element.elementname}>")
    else:
        out.append(f"{opening}{end}")


def _tag(tag: str, attributes: dict[str, str]) -> str:
    """How an element begins."""
    if "" in attributes.values():
        attributes = {key: value for key, value in attributes.items() if value}
    if _MARKUP.search("".join(attributes.values())):
        attributes = {key: _quoted(value) for key, value in attributes.items()}
    return _opening(tag, tuple(attributes)) % attributes


@cache
def _opening(tag: str, names: tuple[str, ...]) -> str:
    """How an element with these attributes begins, in the order of their names, a gap for each value."""
    return f"<{tag}" + "".join(f' {name}="%({name})s"' for name in sorted(names))


def _escaped(text: str) -> str:
    return escape(text, quote=False) if _MARKUP.search(text) else text


def _quoted(text: str) -> str:
    return _escaped(text).translate(_IN_QUOTES)


def _allow_accessibility(page: svgwrite.Drawing) -> None:
    """Teach svgwrite's check of SVG 1.1 the attributes for readers and editors that later standards have."""
    from svgwrite.data.types import SVGAttribute
    from svgwrite.extensions import Inkscape

    Inkscape(page)
    del page.attribs["xmlns:sodipodi"]
    known = page.validator
    for name in ("role", "lang"):
        known.attributes[name] = SVGAttribute(name, anim=False, types=frozenset(["string"]), const=frozenset())
        known.elements["svg"].valid_attributes = {name} | known.elements["svg"].valid_attributes
