"""How letters come along with a file, so that a figure looks the same wherever it is opened: the used glyphs of the
family as a rule of a style sheet; or as outlines, for programs that have no fonts.
"""

from __future__ import annotations

import struct
from base64 import b64encode
from collections.abc import Iterable, Mapping
from zlib import crc32

from graphkin.drawing.font import EM, FAMILY, Glyph, Style, glyph, held, part
from graphkin.drawing.font_widths import style_of
from graphkin.drawing.ink.primitives import Run

__all__ = ["FALLBACK", "face_rules", "families", "outline"]

# Where a program passes over embedded faces, as Inkscape does: Times and its twins, then faces that have the signs of
# mathematics, then Chinese serif faces of Linux, macOS, Windows.
FALLBACK = (
    "'Times New Roman', 'Liberation Serif', Times, 'STIX Two Text', STIXGeneral, 'Cambria Math', 'DejaVu Serif', "
    "'Noto Serif CJK SC', 'Source Han Serif SC', 'Songti SC', SimSun, serif"
)
_LOOK: Mapping[Style, str] = {"regular": "", "italic": ";font-style:italic", "bold": ";font-weight:bold"}


def face_rules(used: Mapping[Style, Iterable[str]]) -> tuple[str, str]:
    """The name of a family with the used characters of each style, and the rules that hold it.

    The name tells the glyphs, since several figures with different ones may stand in one page; not how they are packed,
    which may differ with the version of a library.
    """
    letters = {style: frozenset(used[style]) for style in _LOOK if used.get(style)}
    if not letters:
        return FAMILY, ""
    glyphs = b"".join(
        struct.pack(">IH", code, found.advance) + found.outline
        for style, characters in letters.items()
        for code, found in held(style, characters).items()
    )
    name = f"{FAMILY} {crc32(glyphs):08x}"
    rules = (
        f"@font-face{{font-family:'{name}'{_LOOK[style]};"
        f"src:url(data:font/woff;base64,{b64encode(part(style, characters)).decode()}) format('woff')}}"
        for style, characters in letters.items()
    )
    return name, "".join(rules)


def families(name: str) -> str:
    """A list of faces that begins with an embedded one."""
    return f"'{name}', {FALLBACK}"


def outline(run: Run) -> str:
    """The letters of a run on a page (mm) as the data of an SVG path; "" where no face at hand has them."""
    from fontTools.pens.svgPathPen import SVGPathPen
    from fontTools.pens.transformPen import TransformPen

    pen = SVGPathPen(None, ntos=_hundredths)
    times, x = run.size / EM, run.x
    for character in run.text:
        found = glyph(character, style_of(run.italic, run.bold))
        if found is None:
            continue
        _draw(found, TransformPen(pen, (times, 0, 0, -times, x, run.y)))
        x += found.advance * times
    commands: str = pen.getCommands()
    return commands


def _hundredths(mm: float) -> str:
    return f"{mm:.2f}".rstrip("0").rstrip(".")


def _draw(found: Glyph, pen: object) -> None:
    from fontTools.ttLib.tables._g_l_y_f import Glyph as Outline

    if found.outline:
        shape = Outline(found.outline)
        shape.expand(None)
        shape.draw(pen, None)
