"""The font family of all figures, read from its files: glyphs, advances, and embedded parts of it; and Chinese
characters that it lacks, from a face of this machine.

``fonts`` holds it as three TrueType files (made by figures/make_fonts.py).  fontTools reads them, and packs the used
part of a face as WOFF: in 5 ms a figure, while WOFF2 takes 20 to 70 ms and a further library, for letters smaller by a
quarter and files smaller by 3 %.

A file contains its letters, so that a figure looks the same everywhere: the used glyphs of the family as
a rule of a style sheet; or as outlines, for programs that have no fonts.
"""

from __future__ import annotations

import os
import struct
from base64 import b64encode
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from io import BytesIO
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Literal
from zlib import crc32

if TYPE_CHECKING:
    from fontTools.ttLib import TTFont

FAMILY = "Graphkin Serif"
FOLDER = Path(__file__).parent / "fonts"
EM = 1000
READING = Lock()
"""fontTools reads a table when it is first asked for, in one thread at a time; the page answers in several."""
Style = Literal["regular", "italic", "bold"]


def style_of(italic: bool, bold: bool) -> Style:
    """The face of a run; bold wins, for there is no bold italic."""
    return "bold" if bold else "italic" if italic else "regular"


@dataclass(frozen=True)
class Glyph:
    """A glyph: its advance and its outline, in thousandths of the size.

    ``outline`` is a simple glyph of a glyf table, empty for a blank.
    """

    advance: int
    outline: bytes

    @property
    def box(self) -> tuple[int, int, int, int]:
        """xMin, yMin, xMax, yMax."""
        left, low, right, high = struct.unpack(">4h", self.outline[2:10]) if self.outline else (0, 0, 0, 0)
        return left, low, right, high


@cache
def _face(style: Style) -> tuple[TTFont, Mapping[int, str]]:
    """A file of the family, and the names of its glyphs by their characters."""
    from fontTools.ttLib import TTFont

    font = TTFont(FOLDER / f"{style}.ttf", lazy=True)
    font.setGlyphOrder([str(k) for k in range(font["maxp"].numGlyphs)])  # names by their characters would take longer
    return font, font.getBestCmap()


@lru_cache(maxsize=4096)
def holds(text: str) -> bool:
    """Whether the family has all Chinese characters of a text."""
    codes = {code for code in map(ord, text) if code > 0x2E7F}
    if not codes:
        return True
    with READING:
        return codes <= _face("regular")[1].keys()


@lru_cache(maxsize=8192)
def glyph(character: str, style: Style = "regular") -> Glyph | None:
    """A glyph of the family, upright where the style lacks it; for a Chinese character that it lacks a glyph from a
    face of this machine, None without such a face."""
    code = ord(character)
    with READING:
        for face in (style, "regular"):
            font, names = _face(face)
            if (name := names.get(code)) is not None:
                outlines = font["glyf"]
                return Glyph(font["hmtx"][name][0], outlines.glyphs[name].compile(outlines, recalcBBoxes=False))
    return machine_glyph(character) if code > 0x2E7F else None


def held(style: Style, characters: Iterable[str]) -> dict[int, Glyph]:
    """The glyphs of those characters that a face has, by their codes in order."""
    return {ord(c): sign for c in sorted(set(characters)) if (sign := glyph(c, style)) is not None}


NAME = struct.pack(">9H", 0, 1, 18, 3, 1, 0x409, 1, 2 * len(FAMILY), 0) + FAMILY.encode("utf-16-be")
"""The table of names with the family alone, as programs ask for one.  For its own, fontTools loads the tables of all
features of fonts: a thirtieth of the time of a command that draws."""
MADE = ("glyf", "maxp", "loca", "head", "hmtx", "hhea", "OS/2", "cmap", "post")
"""The other tables of a file, each after those from which it is made."""


@lru_cache(maxsize=256)
def part(style: Style, characters: frozenset[str]) -> bytes:
    """A WOFF file of a face with only these characters, their outlines as they are in the whole."""
    from fontTools.fontBuilder import FontBuilder
    from fontTools.ttLib import TTFont, newTable
    from fontTools.ttLib.sfnt import SFNTWriter
    from fontTools.ttLib.tables._g_l_y_f import Glyph as Outline
    from fontTools.ttLib.ttFont import sortedTagList

    glyphs = {f"u{code:04X}": sign for code, sign in held(style, characters).items()}
    font = TTFont(FOLDER / f"{style}.ttf", lazy=True, recalcBBoxes=False, recalcTimestamp=False)
    builder = FontBuilder(font=font)
    builder.setupGlyphOrder([".notdef", *glyphs])
    builder.setupCharacterMap({int(name[1:], 16): name for name in glyphs})
    builder.setupHorizontalMetrics({".notdef": (500, 0)} | {n: (g.advance, g.box[0]) for n, g in glyphs.items()})
    font["loca"], font["glyf"] = newTable("loca"), newTable("glyf")
    font["glyf"].glyphs = {".notdef": Outline()} | {name: Outline(sign.outline) for name, sign in glyphs.items()}
    stream = BytesIO()
    tables = {tag: font.getTableData(tag) for tag in MADE} | {"name": NAME}
    packed = SFNTWriter(stream, len(tables), font.sfntVersion, "woff")
    for tag in sortedTagList(tables):
        packed[tag] = tables[tag]
    packed.close()
    font.close()
    return stream.getvalue()


# In the order of liking; of a collection the face of simplified Chinese.
_FILES = (
    "NotoSerifCJK-Regular.ttc", "NotoSerifCJKsc-Regular.otf", "NotoSerifSC-Regular.otf", "SourceHanSerifSC-Regular.otf",
    "SourceHanSerif-Regular.ttc", "simsun.ttc", "Songti.ttc", "NotoSansCJK-Regular.ttc", "NotoSansCJKsc-Regular.otf",
    "NotoSansSC-Regular.otf", "SourceHanSansSC-Regular.otf", "msyh.ttc", "PingFang.ttc", "uming.ttc", "wqy-zenhei.ttc",
    "wqy-microhei.ttc", "DroidSansFallbackFull.ttf", "DroidSansFallback.ttf",
)
_FOLDERS = (
    "/usr/share/fonts", "/usr/local/share/fonts", "~/.local/share/fonts", "~/.fonts", "/System/Library/Fonts",
    "/Library/Fonts", "~/Library/Fonts", "C:/Windows/Fonts", "/system/fonts",
)
EPS = 1.0  # thousandths of the size by which an outline may be moved as it becomes quadratic


def machine_glyph(character: str) -> Glyph | None:
    """A glyph of the machine's face; None where no known face is installed or none has it."""
    from fontTools.misc.transform import Scale
    from fontTools.pens.cu2quPen import Cu2QuPen
    from fontTools.pens.recordingPen import DecomposingRecordingPen
    from fontTools.pens.transformPen import TransformPen
    from fontTools.pens.ttGlyphPen import TTGlyphPen

    with READING:
        font = _font()
        name = font.getBestCmap().get(ord(character)) if font is not None else None
        if font is None or name is None:
            return None
        drawn = font.getGlyphSet()
        path = DecomposingRecordingPen(drawn)
        drawn[name].draw(path)
        times = EM / font["head"].unitsPerEm
        pen = TTGlyphPen(None)
        path.replay(TransformPen(Cu2QuPen(pen, EPS, reverse_direction="glyf" not in font), Scale(times)))
        outline = pen.glyph(round=round)
        shape = outline.compile(None) if outline.numberOfContours else b""
        return Glyph(round(drawn[name].width * times), shape)


@cache
def _font() -> TTFont | None:
    from fontTools.ttLib import TTCollection, TTFont, TTLibError

    for path in _installed():
        try:
            if path.suffix.lower() != ".ttc":
                return TTFont(path, lazy=True)
            fonts = TTCollection(path, lazy=True).fonts
        except (OSError, TTLibError):
            continue
        return next((f for f in fonts if " SC" in str(f["name"].getDebugName(1))), fonts[0])
    return None


def _installed() -> list[Path]:
    """The installed known faces, the best first."""
    paths: dict[str, Path] = {}
    for folder in _FOLDERS:
        for place, _, names in os.walk(os.path.expanduser(folder)):
            paths.update((name.lower(), Path(place, name)) for name in names)
    return [paths[name.lower()] for name in _FILES if name.lower() in paths]


# Where a program passes over embedded faces, as Inkscape does: Times and its twins, then faces that have the signs of
# mathematics, then Chinese serif faces of Linux, macOS, Windows.
FALLBACK = (
    "'Times New Roman', 'Liberation Serif', Times, 'STIX Two Text', STIXGeneral, 'Cambria Math', 'DejaVu Serif', "
    "'Noto Serif CJK SC', 'Source Han Serif SC', 'Songti SC', SimSun, serif"
)
_LOOK: Mapping[Style, str] = {"regular": "", "italic": ";font-style:italic", "bold": ";font-weight:bold"}


def face_rules(used: Mapping[Style, Iterable[str]]) -> tuple[str, str]:
    """The name of a family with the used characters of each style, and the rules that hold it.

    The name depends on the glyphs, since figures with different ones may stand in one page; not on their packing, which
    may differ with the version of a library.
    """
    letters = {style: frozenset(used[style]) for style in _LOOK if used.get(style)}
    if not letters:
        return FAMILY, ""
    glyphs = b"".join(
        struct.pack(">IH", code, sign.advance) + sign.outline
        for style, characters in letters.items()
        for code, sign in held(style, characters).items()
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


def outline(text: str, at: complex, size: float, style: Style) -> str:
    """The letters of a text on a page (mm) as the data of an SVG path; "" where no face has them.

    Parameters
    ----------
    at : the beginning of its baseline
    size : of the letters
    """
    from fontTools.pens.svgPathPen import SVGPathPen
    from fontTools.pens.transformPen import TransformPen
    from fontTools.ttLib.tables._g_l_y_f import Glyph as Outline

    pen = SVGPathPen(None, ntos=lambda mm: f"{mm:.2f}".rstrip("0").rstrip("."))
    times, x = size / EM, at.real
    for sign in filter(None, (glyph(character, style) for character in text)):
        if sign.outline:
            shape = Outline(sign.outline)
            shape.expand(None)
            shape.draw(TransformPen(pen, (times, 0, 0, -times, x, at.imag)), None)
        x += sign.advance * times
    commands: str = pen.getCommands()
    return commands
