"""The SVG standard, as svgwrite knows it."""

from __future__ import annotations

from xml.etree import ElementTree

import svgwrite
from svgwrite.data.types import SVGAttribute
from svgwrite.extensions import Inkscape

from graphkin.drawing.write.svg import NAMESPACES


def check(svg: bytes) -> None:
    """Check all elements of a page against SVG 1.1 by svgwrite, with the attributes of later standards for readers and
    editors added.  Raises ValueError or TypeError for a wrong element."""
    page = svgwrite.Drawing(debug=True)
    Inkscape(page)
    standard = page.validator
    for name in ("role", "lang"):
        standard.attributes[name] = SVGAttribute(name, anim=False, types=frozenset(["string"]), const=frozenset())
        standard.elements["svg"].valid_attributes = {name} | standard.elements["svg"].valid_attributes
    prefixes = {uri: f"{name.removeprefix('xmlns:')}:" for name, uri in NAMESPACES.items() if ":" in name}
    prefixes |= {NAMESPACES["xmlns"]: "", "http://www.w3.org/XML/1998/namespace": "xml:"}

    def plain(name: str) -> str:
        uri, _, local = name.rpartition("}")
        return prefixes.get(uri.removeprefix("{"), "") + local

    for element in ElementTree.fromstring(svg).iter():
        for name, value in element.attrib.items():
            standard.check_svg_attribute_value(plain(element.tag), plain(name), value)
        for child in element:
            standard.check_valid_children(plain(element.tag), plain(child.tag))
