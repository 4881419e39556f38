"""Make the fonts of the figures: STIX General for Latin, Greek and signs, Noto Serif CJK SC for Chinese, as one family.

    python figures/make_fonts.py

Needs matplotlib (which brings STIX General) and Debian's fonts-noto-cjk.  Chinese is cut to the characters that come
first in GB 2312 (3755 of them, those of everyday), and to those of the tables of words and of the scenes; in bold to
the latter.  Outlines become quadratic, since one file holds both, hints go.  Every face has all that the upright has,
but for Chinese, so that an italic word never changes its face at a sign.
"""

from __future__ import annotations

import re
from pathlib import Path

import matplotlib
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.cu2quPen import Cu2QuPen
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTCollection, TTFont

ROOT = Path(__file__).parent.parent
TARGET = ROOT / "graphkin" / "drawing" / "fonts"
STIX = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
NOTO = Path("/usr/share/fonts/opentype/noto")
FAMILY = "Graphkin Serif"
RANGES = (
    (0x20, 0x7E), (0xA0, 0x17F), (0x370, 0x3FF), (0x400, 0x45F), (0x2010, 0x203E), (0x2070, 0x209C), (0x20AC, 0x20AC),
    (0x2100, 0x214F), (0x2150, 0x215F), (0x2190, 0x21FF), (0x2200, 0x22FF), (0x25A0, 0x25FF),
)  # fmt: skip
EPOCH = 3_786_825_600  # the same date in every file
EPS = 2.0  # of an em of 1000, by which an outline may be moved as it becomes quadratic


def chinese_used() -> set[str]:
    """What the tables of words and the scenes of the repository hold."""
    texts = [*(ROOT / "graphkin").rglob("*.toml"), *(ROOT / "figures").rglob("*.toml")]
    return {c for path in texts for c in path.read_text(encoding="utf-8") if is_chinese(c)}


def chinese_of_everyday() -> set[str]:
    """The first level of GB 2312: rows 16 to 55; and its marks."""
    found = set("，。、；：？！（）《》〈〉“”‘’—…·【】「」％＋－＝～　ⅠⅡⅢⅣⅤⅥⅦⅧ")
    for row in range(16, 56):
        for cell in range(1, 95):
            try:
                found.add(bytes((row + 0xA0, cell + 0xA0)).decode("gb2312"))
            except UnicodeDecodeError:
                continue
    return {c for c in found if is_chinese(c)}


def is_chinese(character: str) -> bool:
    return ord(character) > 0x2E7F or character in "ⅠⅡⅢⅣⅤⅥⅦⅧ"


def noto(style: str) -> TTFont:
    collection = TTCollection(NOTO / f"NotoSerifCJK-{style}.ttc", lazy=True)
    return next(font for font in collection.fonts if "CJK SC" in str(font["name"].getDebugName(1)))


def write(name: str, style: str, sources: list[tuple[TTFont, set[str]]]) -> None:
    glyphs, metrics, cmap = {".notdef": TTGlyphPen(None).glyph()}, {".notdef": (500, 0)}, {}
    for font, characters in sources:
        held, drawn = font.getBestCmap(), font.getGlyphSet()
        times = 1000 / font["head"].unitsPerEm
        assert times == 1.0, name
        for character in sorted(characters):
            code = ord(character)
            if code in cmap or code not in held:
                continue
            path = DecomposingRecordingPen(drawn)
            drawn[held[code]].draw(path)
            pen = TTGlyphPen(None)
            cubic = "glyf" not in font
            path.replay(Cu2QuPen(pen, EPS, reverse_direction=True) if cubic else pen)
            own = f"u{code:04X}"
            glyphs[own] = pen.glyph()
            metrics[own] = (round(drawn[held[code]].width), 0)
            cmap[code] = own
    order = [".notdef", *(cmap[code] for code in sorted(cmap))]
    made = FontBuilder(1000, isTTF=True)
    made.setupGlyphOrder(order)
    made.setupCharacterMap(cmap)
    made.setupGlyf({own: glyphs[own] for own in order})
    table = made.font["glyf"]
    made.setupHorizontalMetrics({own: (metrics[own][0], getattr(table[own], "xMin", 0) or 0) for own in order})
    made.setupHorizontalHeader(ascent=880, descent=-230)
    # Typst passes by a face without a PostScript name
    made.setupNameTable({
        "familyName": FAMILY, "styleName": style, "fullName": f"{FAMILY} {style}",
        "psName": f"{FAMILY.replace(' ', '')}-{style}", "licenseDescription": "SIL Open Font License 1.1",
    })  # fmt: skip
    bold, italic = style == "Bold", style == "Italic"
    made.setupOS2(
        sTypoAscender=880, sTypoDescender=-230, sTypoLineGap=0, usWinAscent=880, usWinDescent=230,
        usWeightClass=700 if bold else 400, fsSelection=0x20 if bold else 0x01 if italic else 0x40,
    )  # fmt: skip
    made.setupPost(keepGlyphNames=False, italicAngle=-15 if italic else 0)
    made.setupHead(unitsPerEm=1000, created=EPOCH, modified=EPOCH, macStyle=bold + 2 * italic)
    made.font.recalcTimestamp = False
    path = TARGET / f"{name}.ttf"
    made.save(path)
    print(path.relative_to(ROOT), len(order), path.stat().st_size)


def main() -> None:
    latin = {chr(code) for low, high in RANGES for code in range(low, high + 1)}
    used = chinese_used()
    upright = TTFont(STIX / "STIXGeneral.ttf")
    write("regular", "Regular", [(upright, latin), (noto("Regular"), used | chinese_of_everyday())])
    write("italic", "Italic", [(TTFont(STIX / "STIXGeneralItalic.ttf"), latin), (upright, latin)])
    write("bold", "Bold", [(TTFont(STIX / "STIXGeneralBol.ttf"), latin), (upright, latin), (noto("Bold"), used)])
    terms = re.split("-{20,}", (STIX / "LICENSE_STIX").read_text(encoding="utf-8"), maxsplit=1)[1].strip()
    (TARGET / "LICENSE").write_text(
        "The fonts in this folder are parts of STIX General (as matplotlib brings it) and of Noto Serif CJK SC\n"
        "(c) 2017-2022 Adobe (http://www.adobe.com/), cut, without hints and with quadratic outlines, under a name of\n"
        "their own, by figures/make_fonts.py.  Both are under the SIL Open Font License 1.1, whose text follows.\n\n"
        f"{terms}\n",
        encoding="utf-8",
    )


if __name__ == "__main__":
    main()
