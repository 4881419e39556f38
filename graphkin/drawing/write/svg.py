"""Drawings as SVG: one user unit is one millimetre, the same bytes every time.

Elements are written as they are drawn; svgwrite, which stays behind this module, checks them against the standard.
"""

from __future__ import annotations

import json
import math
import re
from base64 import b64encode
from collections.abc import Callable, Mapping
from functools import cache, lru_cache
from html import escape
from itertools import count
from operator import itemgetter
from zlib import crc32

from graphkin.drawing.font import Style, face_rules, families, outline, style_of
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
from graphkin.drawing.text import BEFORE, has_cjk, start_of, width

# What XML 1.0 cannot hold, and other control characters.
_UNFIT = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")
_HIDING = re.compile("[\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069\ufeff]")  # what could hide what stands beside it
_MARKUP = re.compile('[&<>"\\r\\n\\t]')
_IN_QUOTES = str.maketrans({'"': "&quot;", "\r": "&#13;", "\n": "&#10;", "\t": "&#09;"})
_DOUBLED = re.compile(r"#(\w)\1(\w)\2(\w)\3")
_SPACES = re.compile(r"\s+")
BLACK = "#000000"  # what is filled unless something else is said
HIT = Stroke(3.0)  # mm: the breadth of a finger
_NAMESPACES = {
    "xmlns": "http://www.w3.org/2000/svg", "xmlns:ev": "http://www.w3.org/2001/xml-events",
    "xmlns:inkscape": "http://www.inkscape.org/namespaces/inkscape", "xmlns:xlink": "http://www.w3.org/1999/xlink",
}  # fmt: skip


@lru_cache(maxsize=8192)
def number(value: float) -> str:
    """A number as it stands in the file: at most 3 decimals, no trailing zeros, no minus zero.

    Raises ValueError for a number that is not finite: no figure has one.

    >>> number(12.5), number(-0.0001), number(3.0)
    ('12.5', '0', '3')
    """
    if not math.isfinite(value):
        raise ValueError(f"a coordinate of the drawing is {value}")
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def svg_bytes(drawing: Page, debug: bool = False, outlines: bool = False) -> bytes:
    """The drawing as an SVG file, UTF-8.

    Parameters
    ----------
    drawing : sizes and places in mm
    debug : have svgwrite check every element and attribute against the SVG standard (slow; for tests)
    outlines : letters as paths, for programs without fonts; the text lies over them without colour, for search and
        screen readers

    Raises
    ------
    ValueError : a coordinate is not finite
    """
    ink = _Ink(drawing.lang, outlines)
    facts = json.dumps(drawing.metadata, ensure_ascii=False, sort_keys=True, allow_nan=False, separators=(",", ":"))
    told = {"title": drawing.title, "desc": drawing.desc, "metadata": facts}
    parts = [ink.element(tag, {}, _escaped(_clean(words))) for tag, words in told.items() if words]
    drawn = ink.page(drawing)
    head = {**_head(drawing), **_NAMESPACES, "baseProfile": "full", "version": "1.1", "xml:lang": _quoted(drawing.lang)}
    name, rules = face_rules({} if outlines else ink.used)
    head["font-family"] = families(name)
    parts += [ink.element("style", {}, _escaped(rules))] if rules else []
    text = ink.element("svg", head, "".join((*parts, drawn)))
    if debug:
        check_standard(text)
    return f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n'.encode()


def svg_element(drawing: Page, named: bool = False, alone: bool = False) -> str:
    """The drawing as an element of a page, which has the letters; screen readers read its title and description.

    It is as short as possible, since a page may have hundreds: no layers, no lengths of texts, no default values.
    Lines end under their arrowheads by a dash and not by a clip, whose name would have to be unique in the page.

    Parameters
    ----------
    drawing : sizes and places in mm
    named : whether vectors, points and links keep their names, which are unique in a page, and vectors have an
        invisible band of a finger's breadth for the pointer
    alone : whether it is a picture by itself, for another program: with its namespaces, without white paper

    Raises
    ------
    ValueError : a coordinate is not finite
    """
    ink = _InPage(drawing.lang, named)
    words = _clean(_HIDING.sub("", _SPACES.sub(" ", f"{drawing.title}. {drawing.desc}".strip(". "))))
    head = {**_head(drawing), "aria-label": _quoted(words), "focusable": "false"}
    if alone:
        spaces = {name: _NAMESPACES[name] for name in ("xmlns", "xmlns:xlink")}
        return ink.element("svg", {**head, **spaces}, "".join(map(ink.draw, drawing.children)))
    return ink.element("svg", head, ink.page(drawing))


def _head(drawing: Page) -> dict[str, str]:
    """The attributes of a page's outermost element."""
    width, height = number(drawing.width), number(drawing.height)
    return {
        "width": f"{width}mm", "height": f"{height}mm", "viewBox": f"0 0 {width} {height}", "role": "img",
        "lang": _quoted(drawing.lang), "stroke-linejoin": "round", "text-rendering": "geometricPrecision",
    }  # fmt: skip


class _Ink:
    """Writes primitives as elements of a page; it keeps the clips, names and characters that it has written."""

    closing = " />"  # of an element that holds nothing

    def __init__(self, lang: str, outlines: bool = False) -> None:
        self.lang, self.outlines = lang, outlines
        self.clips: set[str] = set()
        self.ids: set[str] = set()
        self.used: dict[Style, set[str]] = {"regular": set(), "italic": set(), "bold": set()}

    def element(self, tag: str, attributes: dict[str, str], inner: str = "") -> str:
        """An element around written ones."""
        return f"{_opening(tag, attributes)}>{inner}</{tag}>" if inner else _opening(tag, attributes) + self.closing

    def page(self, drawing: Page) -> str:
        """The content of the page."""
        # white paper, so that black lines show on a dark screen too
        whole = {"x": "0", "y": "0", "width": "100%", "height": "100%"}
        paper = self.element("rect", {**whole, **self.filled("#ffffff"), "class": "paper"})
        return paper + "".join(map(self.draw, drawing.children))

    def colour(self, colour: str) -> str:
        return colour

    def filled(self, colour: str) -> dict[str, str]:
        """The attribute of an area, empty for none."""
        return {"fill": self.colour(colour) or "none"}

    def draw(self, thing: Primitive) -> str:
        if isinstance(thing, Group):
            return self._group(thing)
        if isinstance(thing, Text):
            return self._text(thing)
        if isinstance(thing, Scan):
            return self._scan(thing)
        stroke = self._stroke(thing.stroke)
        if isinstance(thing, Line):
            return self._line(thing, stroke)
        if isinstance(thing, Polyline):
            return self.element("polyline", {"points": _points(thing.points), "fill": "none", **stroke})
        if isinstance(thing, Polygon):
            return self.element("polygon", {"points": _points(thing.points), **self.filled(thing.fill), **stroke})
        if isinstance(thing, Circle):
            x, y = _pair(thing.centre)
            return self.element(
                "circle", {"cx": x, "cy": y, "r": number(thing.radius), **self.filled(thing.fill), **stroke})
        return self.element("path", {"d": _arc(thing), "fill": "none", **stroke})

    def _stroke(self, stroke: Stroke | None) -> dict[str, str]:
        if stroke is None:
            return {}
        dashes = {"stroke-dasharray": " ".join(map(number, stroke.dash))} if stroke.dash else {}
        return {"stroke": self.colour(stroke.colour), "stroke-width": number(stroke.width), **dashes}

    def _line(self, line: Line, look: dict[str, str]) -> str:
        """A line, cut by a clip if its end lies under an arrowhead."""
        (x1, y1), (x2, y2) = _pair(line.start), _pair(line.end)
        look = {"x1": x1, "y1": y1, "x2": x2, "y2": y2, **look}
        if not line.covered:
            return self.element("line", look)
        # Named by its shape: where several figures stand in one HTML page, equal names mean equal clips.
        shaft = _shaft(line)
        name = f"clip-{crc32(shaft.encode()):08x}"
        drawn = self.element("line", {**look, "clip-path": f"url(#{name})"})
        if name in self.clips:
            return drawn
        self.clips.add(name)
        return drawn + self.element("clipPath", {"id": name}, self.element("path", {"d": shaft}))

    def _group(self, group: Group) -> str:
        called, inner = self._called(group), "".join(map(self.draw, group.children))
        if group.motion is not None:
            inner = self._moving(group.motion, inner)
        # last, because the first child of a vector's group is its line
        return self.element("g", called, inner + self._last_of(group))

    def _called(self, group: Group) -> dict[str, str]:
        """Id, classes and layer of a group."""
        layer = {"inkscape:groupmode": "layer", "inkscape:label": _quoted(_clean(group.layer))} if group.layer else {}
        return {**self._named(group.id, class_names(group)), **layer}

    def _last_of(self, group: Group) -> str:
        """The end of a group after its children: its title."""
        return self.element("title", {}, _escaped(_clean(group.title))) if group.title else ""

    def _moving(self, motion: Travel, inner: str) -> str:
        """The inside of a moving group, with its turning part in a group of its own."""
        always = {"dur": f"{number(motion.seconds)}s", "repeatCount": "indefinite"}
        transform = {"attributeName": "transform", "attributeType": "XML", **always}
        moves, last = [], next((m for m in motion.moves if m is not None), 0j)
        for move in motion.moves:
            last = last if move is None else move
            moves.append(" ".join(_pair(last)))
        parts = [self.element("animateTransform", {**transform, "type": "translate", "values": ";".join(moves)})]
        if None in motion.moves:
            seen = ";".join("hidden" if m is None else "visible" for m in motion.moves)
            shown = {"attributeName": "visibility", "values": seen, "calcMode": "discrete", **always}
            parts.append(self.element("animate", shown))
        if motion.turns:
            x, y = _pair(motion.about)
            turns = ";".join(f"{number(turn)} {x} {y}" for turn in motion.turns)
            turning = self.element("animateTransform", {**transform, "type": "rotate", "values": turns})
            inner = self.element("g", {}, turning + inner)
        return "".join((*parts, inner))

    def _scan(self, scan: Scan) -> str:
        """A picture with its file in it, cut by a clip beside it."""
        shape = "M" + "L".join(" ".join(_pair(corner)) for corner in scan.panel) + "Z"
        name = f"clip-{crc32(shape.encode()):08x}"
        clip = self.element("clipPath", {"id": name}, self.element("path", {"d": shape}))
        a, b = scan.step.real, scan.step.imag
        look = {"width": str(scan.width), "height": str(scan.height), "opacity": number(PALE)}
        look["transform"] = f"matrix({a:.9g} {b:.9g} {-b:.9g} {a:.9g} {scan.corner.real:.6f} {scan.corner.imag:.6f})"
        look["xlink:href"] = f"data:{scan.kind};base64,{b64encode(scan.data).decode()}"
        return self.element("g", {"clip-path": f"url(#{name})"}, clip + self.element("image", look))

    def _text(self, text: Text) -> str:
        runs, start, anchor = text.runs, start_of(text), ""
        places = [(number(start.real + run.x), number(start.imag + run.y)) for run in runs]
        if len(runs) == 1 and text.anchor != "start":
            # One run may stand by its own middle or end, exact in whatever face the reader has.
            anchor = text.anchor
            places = [(number(text.at.real + (1.0 - BEFORE[anchor]) * runs[0].x), places[0][1])]
        named = self._named(text.id, class_names(text))
        look = {"x": places[0][0], "y": places[0][1], **self.filled("" if self.outlines else text.colour)}
        look["font-size"] = number(max(run.size for run in runs))
        if anchor:
            look["text-anchor"] = anchor
        if not self.lang.startswith("zh") and has_cjk(text.string):
            look["xml:lang"] = "zh"
        spans = "".join([self._run(run, x, y, look) for run, (x, y) in zip(runs, places, strict=True)])
        if not self.outlines:
            return self.element("text", {**look, **named}, spans)
        return self._outlined(text, start, named, look, spans)

    def _run(self, run: Run, x: str, y: str, text: Mapping[str, str]) -> str:
        """A run at its place in a text of these attributes, with its length."""
        words = _clean(run.text)
        self.used[style_of(run.italic, run.bold)].update(words)
        long = number(width(words, run.size, run.italic, run.bold))
        face = f'{_face(run)} lengthAdjust="spacingAndGlyphs" textLength="{long}"'
        return f'<tspan font-size="{number(run.size)}"{face} x="{x}" y="{y}">{_escaped(words)}</tspan>'

    def _outlined(
        self, text: Text, start: complex, named: dict[str, str], look: dict[str, str], spans: str
    ) -> str:
        """A text as paths, with the invisible text over them; only the text if no face has its letters."""
        letters = "".join(
            outline(_clean(run.text), start + complex(run.x, run.y), run.size, style_of(run.italic, run.bold))
            for run in text.runs
        )
        filled = self.filled(text.colour)
        if not letters:
            return self.element("g", named, self.element("text", {**look, **filled}, spans))
        path = self.element("path", {"d": letters, **filled, "aria-hidden": "true"})
        return self.element("g", named, path + self.element("text", look, spans))

    def _named(self, id: str, classes: tuple[str, ...]) -> dict[str, str]:
        """Id and classes; an id that is taken (B1 of link 2 and B12 are written alike) gets a number."""
        named = {"class": _quoted(" ".join(classes))} if classes else {}
        if id:
            free = id if id not in self.ids else next(n for k in count(2) if (n := f"{id}-{k}") not in self.ids)
            self.ids.add(free)
            named["id"] = _quoted(free)
        return named


class _InPage(_Ink):
    """Writes primitives as the elements of a figure in a page."""

    closing = "/>"

    def __init__(self, lang: str, named: bool) -> None:
        super().__init__(lang)
        self.named = named

    def colour(self, colour: str) -> str:
        return _DOUBLED.sub(r"#\1\2\3", colour)

    def filled(self, colour: str) -> dict[str, str]:
        return {} if colour == BLACK else super().filled(colour)

    def draw(self, thing: Primitive) -> str:
        if isinstance(thing, Line) and thing.covered:
            inked = abs(thing.inked_end - thing.start)
            dashed = thing.stroke._replace(dash=(inked, abs(thing.end - thing.start) + 1.0))
            thing = Line(thing.start, thing.end, dashed)
        return super().draw(thing)

    def _called(self, group: Group) -> dict[str, str]:
        return self._named("" if group.layer else group.id, class_names(group))

    def _named(self, id: str, classes: tuple[str, ...]) -> dict[str, str]:
        return super()._named(id if self.named else "", classes)

    def _last_of(self, group: Group) -> str:
        shaft = group.children[0] if self.named and "vector" in group.classes and group.children else None
        if not isinstance(shaft, Line) or shaft.start == shaft.end:
            return ""
        return self._group(Group((Line(shaft.start, shaft.end, HIT),), classes=("hit",)))

    def _run(self, run: Run, x: str, y: str, text: Mapping[str, str]) -> str:
        size = number(run.size)
        alike = (size, x, y) == (text["font-size"], text["x"], text["y"])  # of its text
        first, last = ("", "") if alike else (f' font-size="{size}"', f' x="{x}" y="{y}"')
        return f"<tspan{first}{_face(run)}{last}>{_escaped(_clean(run.text))}</tspan>"


def _clean(text: str) -> str:
    # what is printable is fit, and that is told at once
    return text if text.isprintable() else _UNFIT.sub("", text)


def _face(run: Run) -> str:
    """The attributes of slanted and of bold letters."""
    return ' font-style="italic"' * run.italic + ' font-weight="bold"' * run.bold


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


def _opening(tag: str, attributes: dict[str, str]) -> str:
    """The beginning of an element, up to its bracket; those who give an attribute words give them `_quoted`."""
    if "" in attributes.values():
        attributes = {key: value for key, value in attributes.items() if value}
    form, values = _form(tag, tuple(attributes))
    return form % values(attributes)


@cache
def _form(tag: str, names: tuple[str, ...]) -> tuple[str, Callable[[dict[str, str]], object]]:
    """The beginning of an element with these attributes, in the order of their names, a gap for each value; and the
    values for the gaps."""
    names = tuple(sorted(names))
    return f"<{tag}" + "".join(f' {name}="%s"' for name in names), itemgetter(*names) if names else lambda _: ()


def _quoted(text: str) -> str:
    """A text as it stands between quotation marks."""
    return _escaped(text).translate(_IN_QUOTES) if _MARKUP.search(text) else text


def _escaped(text: str) -> str:
    return escape(text, quote=False) if _MARKUP.search(text) else text


def check_standard(text: str) -> None:
    """Check all elements of a page against SVG 1.1 by svgwrite, with the attributes of later standards for readers and
    editors added.  Raises ValueError or TypeError for a wrong element."""
    from xml.etree import ElementTree

    import svgwrite
    from svgwrite.data.types import SVGAttribute
    from svgwrite.extensions import Inkscape

    page = svgwrite.Drawing(debug=True)
    Inkscape(page)
    standard = page.validator
    for name in ("role", "lang"):
        standard.attributes[name] = SVGAttribute(name, anim=False, types=frozenset(["string"]), const=frozenset())
        standard.elements["svg"].valid_attributes = {name} | standard.elements["svg"].valid_attributes
    prefixes = {uri: f"{name.removeprefix('xmlns:')}:" for name, uri in _NAMESPACES.items() if ":" in name}
    prefixes |= {_NAMESPACES["xmlns"]: "", "http://www.w3.org/XML/1998/namespace": "xml:"}

    def plain(name: str) -> str:
        uri, _, local = name.rpartition("}")
        return prefixes.get(uri.removeprefix("{"), "") + local

    for element in ElementTree.fromstring(text).iter():
        for name, value in element.attrib.items():
            standard.check_svg_attribute_value(plain(element.tag), plain(name), value)
        for child in element:
            standard.check_valid_children(plain(element.tag), plain(child.tag))
