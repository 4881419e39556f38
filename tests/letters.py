"""The letters that a figure brings along."""

from __future__ import annotations

import io
import re
import xml.etree.ElementTree as ET
from base64 import b64decode

from fontTools.ttLib import TTFont

from graphkin.drawing.font import FOLDER

SVG = "{http://www.w3.org/2000/svg}"
STYLES = {"": "regular", "font-style:italic": "italic", "font-weight:bold": "bold"}
Notation = dict[str, dict[str, tuple[int, str, list[tuple[int, int]]]]]
"""Advance, flags and points of each character, by style."""


def unpacked(svg: bytes) -> bytes:
    """A figure without the bytes of its letters, which change with the version of fontTools or zlib."""
    return re.sub(rb"data:font/woff;base64,[^)]*", b"", svg)


def faces(svg: str) -> dict[str, TTFont]:
    """The embedded faces by their style."""
    rules = re.findall(r"@font-face\{font-family:'[^']*'([^}]*?);?src:url\(data:font/woff;base64,([^)]*)\)", svg)
    return {STYLES[look.strip(";")]: TTFont(io.BytesIO(b64decode(data))) for look, data in rules}


def whole(style: str) -> TTFont:
    """The file from which the letters of a style are cut."""
    return TTFont(FOLDER / f"{style}.ttf", lazy=True)


def letters(fonts: dict[str, TTFont]) -> Notation:
    found: Notation = {}
    for style, font in fonts.items():
        found[style] = {}
        for code, name in font.getBestCmap().items():
            points, ends, flags = font["glyf"][name].getCoordinates(font["glyf"])
            outline = bytes(f & 1 for f in flags).hex() + str(ends)
            found[style][chr(code)] = font["hmtx"][name][0], outline, list(points)
    return found


def shown(svg: str) -> dict[str, set[str]]:
    """The characters that a figure shows, by style."""
    found: dict[str, set[str]] = {}
    for span in ET.fromstring(svg).iter(f"{SVG}tspan"):
        style = "bold" if span.get("font-weight") else "italic" if span.get("font-style") else "regular"
        found.setdefault(style, set()).update(span.text or "")
    return found
