"""Drawings as SVG: one user unit is one millimetre, the same bytes every time.

Elements are written as they are drawn; svgwrite, which stays behind this module, checks them against the standard.
"""

from __future__ import annotations

import json
import math
import re
from base64 import b64encode
from collections.abc import Mapping
from functools import lru_cache
from html import escape
from itertools import count
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
}


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
    texts = {"title": drawing.title, "desc": drawing.desc, "metadata": facts}
    parts = [ink.element(tag, "", _escaped(_clean(words))) for tag, words in texts.items() if words]
    drawn = ink.page(drawing)
    head = {**_head(drawing), **_NAMESPACES, "baseProfile": "full", "version": "1.1", "xml:lang": _quoted(drawing.lang)}
    name, rules = face_rules({} if outlines else {style: "".join(words) for style, words in ink.used.items()})
    head["font-family"] = families(name)
    parts += [ink.element("style", "", _escaped(rules))] if rules else []
    # joined once: a sheet has 170,000 letters
    whole = "".join(('<?xml version="1.0" encoding="utf-8"?>\n<svg', _attributes(head), ">", *parts, drawn, "</svg>\n"))
    if debug:
        check_standard(whole)
    return whole.encode()


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
        return ink.element("svg", _attributes(head | spaces), "".join(map(ink.draw, drawing.children)))
    return ink.element("svg", _attributes(head), ink.page(drawing))


def _head(drawing: Page) -> dict[str, str]:
    """The attributes of a page's outermost element."""
    width, height = number(drawing.width), number(drawing.height)
    return {
        "width": f"{width}mm", "height": f"{height}mm", "viewBox": f"0 0 {width} {height}", "role": "img",
        "lang": _quoted(drawing.lang), "stroke-linejoin": "round", "text-rendering": "geometricPrecision",
    }


class _Ink:
    """Writes primitives as elements of a page; it keeps the clips, names and words that it has written.

    The attributes of an element stand in the order of their names.
    """

    closing = " />"  # of an element that holds nothing
    short = False  # whether colours are as short as possible

    def __init__(self, lang: str, outlines: bool = False) -> None:
        self.lang, self.outlines = lang, outlines
        self.clips: set[str] = set()
        self.ids: set[str] = set()
        self.used: dict[Style, set[str]] = {"regular": set(), "italic": set(), "bold": set()}

    def element(self, tag: str, attributes: str, inner: str = "") -> str:
        """An element around written ones."""
        return f"<{tag}{attributes}>{inner}</{tag}>" if inner else f"<{tag}{attributes}{self.closing}"

    def page(self, drawing: Page) -> str:
        """The content of the page."""
        # white paper, so that black lines show on a dark screen too
        fill = self.filled("#ffffff")
        paper = f'<rect class="paper"{fill} height="100%" width="100%" x="0" y="0"{self.closing}'
        return paper + "".join(map(self.draw, drawing.children))

    def filled(self, colour: str) -> str:
        """The attribute of an area, empty for none."""
        return _fill(colour, self.short)

    def draw(self, part: Primitive) -> str:
        if isinstance(part, Group):
            return self._group(part)
        if isinstance(part, Text):
            return self._text(part)
        if isinstance(part, Line):
            return self._line(part)
        if isinstance(part, Scan):
            return self._scan(part)
        look = _look(part.stroke, self.short)
        if isinstance(part, Circle):
            x, y = _pair(part.centre)
            fill, radius = self.filled(part.fill), number(part.radius)
            return f'<circle cx="{x}" cy="{y}"{fill} r="{radius}"{look}{self.closing}'
        if isinstance(part, Polygon):
            return f'<polygon{self.filled(part.fill)} points="{_points(part.points)}"{look}{self.closing}'
        if isinstance(part, Polyline):
            return f'<polyline fill="none" points="{_points(part.points)}"{look}{self.closing}'
        return f'<path d="{_arc(part)}" fill="none"{look}{self.closing}'

    def _line(self, line: Line) -> str:
        """A line, cut by a clip if its end lies under an arrowhead."""
        (x1, y1), (x2, y2) = _pair(line.start), _pair(line.end)
        look = f'{_look(line.stroke, self.short)} x1="{x1}" x2="{x2}" y1="{y1}" y2="{y2}"{self.closing}'
        if not line.covered:
            return f"<line{look}"
        # Named by its shape: where several figures stand in one HTML page, equal names mean equal clips.
        shaft = _shaft(line)
        name = f"clip-{crc32(shaft.encode()):08x}"
        drawn = f'<line clip-path="url(#{name})"{look}'
        return drawn if name in self.clips else drawn + self._clip(name, shaft)

    def _clip(self, name: str, shape: str) -> str:
        """A clip by its name, of the shape of a path."""
        self.clips.add(name)
        return f'<clipPath id="{name}"><path d="{shape}"{self.closing}</clipPath>'

    def _group(self, group: Group) -> str:
        called, inner = self._called(group), "".join(map(self.draw, group.children))
        if group.motion is not None:
            inner = self._moving(group.motion, inner)
        # last, because the first child of a vector's group is its line
        return self.element("g", called, inner + self._last_of(group))

    def _called(self, group: Group) -> str:
        """Id, classes and layer of a group."""
        layer = _quoted(_clean(group.layer))
        layer = f' inkscape:groupmode="layer" inkscape:label="{layer}"' if layer else ""
        return _classes(group.classes, group.step) + self._named(group.id) + layer

    def _last_of(self, group: Group) -> str:
        """The end of a group after its children: its title."""
        return self.element("title", "", _escaped(_clean(group.title))) if group.title else ""

    def _moving(self, motion: Travel, inner: str) -> str:
        """The inside of a moving group, with its turning part in a group of its own."""
        always = {"dur": f"{number(motion.seconds)}s", "repeatCount": "indefinite"}
        transform = {"attributeName": "transform", "attributeType": "XML", **always}
        moves, last = [], next((m for m in motion.moves if m is not None), 0j)
        for move in motion.moves:
            last = last if move is None else move
            moves.append(" ".join(_pair(last)))
        travel = _attributes({**transform, "type": "translate", "values": ";".join(moves)})
        parts = [self.element("animateTransform", travel)]
        if None in motion.moves:
            seen = ";".join("hidden" if m is None else "visible" for m in motion.moves)
            shown = {"attributeName": "visibility", "values": seen, "calcMode": "discrete", **always}
            parts.append(self.element("animate", _attributes(shown)))
        if motion.turns:
            x, y = _pair(motion.about)
            turns = ";".join(f"{number(turn)} {x} {y}" for turn in motion.turns)
            turning = _attributes({**transform, "type": "rotate", "values": turns})
            inner = self.element("g", "", self.element("animateTransform", turning) + inner)
        return "".join((*parts, inner))

    def _scan(self, scan: Scan) -> str:
        """A picture with its file in it, cut by a clip beside it."""
        shape = "M" + "L".join(" ".join(_pair(corner)) for corner in scan.panel) + "Z"
        name = f"clip-{crc32(shape.encode()):08x}"
        a, b = scan.step.real, scan.step.imag
        look = {"width": str(scan.width), "height": str(scan.height), "opacity": number(PALE)}
        look["transform"] = f"matrix({a:.9g} {b:.9g} {-b:.9g} {a:.9g} {scan.corner.real:.6f} {scan.corner.imag:.6f})"
        look["xlink:href"] = f"data:{scan.kind};base64,{b64encode(scan.data).decode()}"
        image = self.element("image", _attributes(look))
        return self.element("g", f' clip-path="url(#{name})"', self._clip(name, shape) + image)

    def _text(self, text: Text) -> str:
        runs, start, anchor = text.runs, start_of(text), ""
        across, down, size = start.real, start.imag, number(max([run.size for run in runs]))
        x, y = number(across + runs[0].x), number(down + runs[0].y)
        if len(runs) == 1 and text.anchor != "start":
            # One run may stand by its own middle or end, exact in whatever face the reader has.
            anchor = f' text-anchor="{text.anchor}"'
            x = number(text.at.real + (1.0 - BEFORE[text.anchor]) * runs[0].x)
        place = x, y, size
        spans = self._run(runs[0], x, y, place)
        for run in runs[1:]:
            spans += self._run(run, number(across + run.x), number(down + run.y), place)
        other = "" if self.lang.startswith("zh") or not has_cjk(text.string) else ' xml:lang="zh"'
        before, after = f' font-size="{size}"', f'{anchor} x="{x}"{other} y="{y}"'
        classes, id = _classes(text.classes, text.step), self._named(text.id)
        if not self.outlines:
            return f"<text{classes}{self.filled(text.colour)}{before}{id}{after}>{spans}</text>"
        return self.element("g", classes + id, self._outlined(text, start, before + after, spans))

    def _run(self, run: Run, x: str, y: str, text: tuple[str, str, str]) -> str:
        """A run at its place in a text of a place and size, with its length."""
        style, words, before, after = _span(run.text, run.size, run.italic, run.bold)
        self.used[style].add(words)
        return f'{before} x="{x}" y="{y}"{after}'

    def _outlined(self, text: Text, start: complex, look: str, spans: str) -> str:
        """A text as paths, with the invisible text over them; only the text if no face has its letters."""
        letters = "".join(
            outline(_clean(run.text), start + complex(run.x, run.y), run.size, style_of(run.italic, run.bold))
            for run in text.runs
        )
        fill = self.filled(text.colour)
        path = f'<path aria-hidden="true" d="{letters}"{fill}{self.closing}' if letters else ""
        return f"{path}<text{self.filled('') if letters else fill}{look}>{spans}</text>"

    def _named(self, id: str) -> str:
        """An id; one that is taken (B1 of link 2 and B12 are written alike) gets a number."""
        if not id:
            return ""
        free = id if id not in self.ids else next(n for k in count(2) if (n := f"{id}-{k}") not in self.ids)
        self.ids.add(free)
        return f' id="{_quoted(free)}"'


class _InPage(_Ink):
    """Writes primitives as the elements of a figure in a page."""

    closing, short = "/>", True

    def __init__(self, lang: str, named: bool) -> None:
        super().__init__(lang)
        self.named = named

    def _line(self, line: Line) -> str:
        if line.covered:
            inked = abs(line.inked_end - line.start)
            dashed = line.stroke._replace(dash=(inked, abs(line.end - line.start) + 1.0))
            line = Line(line.start, line.end, dashed)
        return super()._line(line)

    def _called(self, group: Group) -> str:
        return _classes(group.classes, group.step) + self._named("" if group.layer else group.id)

    def _named(self, id: str) -> str:
        return super()._named(id) if self.named else ""

    def _last_of(self, group: Group) -> str:
        shaft = group.children[0] if self.named and "vector" in group.classes and group.children else None
        if not isinstance(shaft, Line) or shaft.start == shaft.end:
            return ""
        return self._group(Group((Line(shaft.start, shaft.end, HIT),), classes=("hit",)))

    def _run(self, run: Run, x: str, y: str, text: tuple[str, str, str]) -> str:
        size = number(run.size)
        first, last = ("", "") if (x, y, size) == text else (f' font-size="{size}"', f' x="{x}" y="{y}"')
        return f"<tspan{first}{_face(run.italic, run.bold)}{last}>{_escaped(_clean(run.text))}</tspan>"


@lru_cache(maxsize=1024)
def _look(stroke: Stroke | None, short: bool) -> str:
    """The attributes of a line, empty for none."""
    if stroke is None:
        return ""
    colour, dashes = _short(stroke.colour) if short else stroke.colour, " ".join(map(number, stroke.dash))
    return _attributes({"stroke": colour, "stroke-dasharray": dashes, "stroke-width": number(stroke.width)})


@lru_cache(maxsize=1024)
def _fill(colour: str, short: bool) -> str:
    """The attribute of an area; ``short`` without the colour that is filled in any case."""
    return "" if short and colour == BLACK else f' fill="{(_short(colour) if short else colour) or "none"}"'


def _short(colour: str) -> str:
    return _DOUBLED.sub(r"#\1\2\3", colour)


@lru_cache(maxsize=1024)
def _classes(classes: tuple[str, ...], step: int | None) -> str:
    """The attribute of some classes and of a step."""
    return _attributes({"class": _quoted(" ".join(class_names(classes, step)))})


@lru_cache(maxsize=4096)
def _span(text: str, size: float, italic: bool, bold: bool) -> tuple[Style, str, str, str]:
    """A run in an element of its length: its style, its words, and what stands before and behind its place."""
    words = _clean(text)
    long = number(width(words, size, italic, bold))
    face = f'{_face(italic, bold)} lengthAdjust="spacingAndGlyphs" textLength="{long}"'
    return style_of(italic, bold), words, f'<tspan font-size="{number(size)}"{face}', f">{_escaped(words)}</tspan>"


def _clean(text: str) -> str:
    # what is printable is fit, and that is told at once
    return text if text.isprintable() else _UNFIT.sub("", text)


def _face(italic: bool, bold: bool) -> str:
    """The attributes of slanted and of bold letters."""
    return ' font-style="italic"' * italic + ' font-weight="bold"' * bold


def _pair(point: complex) -> tuple[str, str]:
    return number(point.real), number(point.imag)


def _points(points: tuple[complex, ...]) -> str:
    return " ".join([f"{number(z.real)},{number(z.imag)}" for z in points])


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


def _attributes(values: Mapping[str, str]) -> str:
    """Attributes that are not empty; those who give one words give it `_quoted` words."""
    return "".join([f' {name}="{value}"' for name, value in sorted(values.items()) if value])


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
