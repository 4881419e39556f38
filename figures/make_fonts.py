"""Make the fonts of the figures: STIX General for Latin, Greek and signs, Noto Serif CJK SC for Chinese, as one family.

    python figures/make_fonts.py

Needs matplotlib (which brings STIX General) and Debian's fonts-noto-cjk.  Chinese is cut to the characters that come
first in GB 2312 (3755 of them, those of everyday), and to those of the tables of words and of the scenes; in bold to
the latter.  Outlines are quadratic, since one file holds both, and have as few points as keep them near enough, on a
grid: a quarter less comes along with a figure, and a letter of 3.5 mm is off by 0.015 mm at most, a fifth of what a
printer or a screen shows as a point.  Hints go.  Every face has all that the upright has, but for Chinese, so that an
italic word never changes its face at a sign.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import numpy as np
from fontTools.cu2qu import curve_to_quadratic
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.basePen import AbstractPen
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.pens.reverseContourPen import ReverseContourPen
from fontTools.pens.transformPen import TransformPen
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
)
EPOCH = 3_786_825_600  # the same date in every file
RAISED = dict(zip("⁰⁴⁵⁶⁷⁸⁹⁻", "0456789−", strict=True))  # of which STIX General has no glyphs, as it has ¹²³
RAISED_AS = (0.6, 0.0, 0.0, 0.6, 0.0, 270.0)  # its ¹²³: so much smaller and higher than 1, 2, 3
CORNER = 60.0  # degrees that one curve does not go round
MERGED = 6  # curves at most that become one

Segment = tuple[complex, ...]
Point = tuple[complex, bool]  # and whether it is on the outline


@dataclass(frozen=True)
class Fit:
    """By how much of an em of 1000 an outline may be moved, and the grid on which its points lie: their low bits are
    alike then, which packs well."""

    off: float
    grid: int

    def round(self, z: complex) -> complex:
        return complex(round(z.real / self.grid) * self.grid, round(z.imag / self.grid) * self.grid)


LATIN, CHINESE = Fit(3.0, 2), Fit(4.0, 4)
_T = np.linspace(0.0, 1.0, 17)
_FINE = np.linspace(0.0, 1.0, 65)


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


def segments(path: Sequence[tuple[str, tuple[tuple[float, float] | None, ...]]]) -> list[list[Segment]]:
    """Lines (two points) and cubic curves (four) of each contour of a recorded path."""
    contours: list[list[Segment]] = []
    start = here = 0j
    for operator, arguments in path:
        points = [complex(*point) for point in arguments if point is not None]
        if operator == "moveTo":
            start = here = points[0]
            contours.append([])
        elif operator == "closePath":
            if here != start:
                contours[-1].append((here, start))
        elif operator == "qCurveTo":
            if None in arguments:  # no point on the outline
                start = here = (points[-1] + points[0]) / 2
                contours.append([])
                points.append(start)
            *controls, last = points
            for k, control in enumerate(controls):
                end = (control + controls[k + 1]) / 2 if k + 1 < len(controls) else last
                contours[-1].append((here, (here + 2 * control) / 3, (end + 2 * control) / 3, end))
                here = end
        else:
            contours[-1].append((here, *points))
            here = points[-1]
    return [contour for contour in contours if contour]


def fitted(contour: list[Segment], fit: Fit) -> list[Point]:
    """A contour by as few points on the grid as keep it near enough: runs of curves become one quadratic curve where
    that is so; the least sum over all ways from corner to corner."""
    first = max(range(len(contour)), key=lambda k: _turn(contour[k - 1], contour[k]))
    contour = contour[first:] + contour[:first]
    nodes = [fit.round(segment[0]) for segment in contour]
    nodes.append(nodes[0])
    along = [_along(segment) for segment in contour]
    best: list[tuple[float, int, list[complex]]] = [(0.0, 0, [])] + [(np.inf, 0, [])] * len(contour)
    for i in range(len(contour)):
        for j in range(i + 1, min(len(contour), i + MERGED) + 1):
            if j > i + 1 and _turn(contour[j - 2], contour[j - 1]) > CORNER:
                break
            path = np.concatenate([along[i], *(part[1:] for part in along[i + 1 : j])])
            between = _between(path, nodes[i], nodes[j], contour[i] if j == i + 1 else None, fit)
            if between is not None and best[i][0] + len(between) + 1 < best[j][0]:
                best[j] = best[i][0] + len(between) + 1, i, between
    points: list[Point] = []
    j = len(contour)
    while j:
        _, i, between = best[j]
        points[:0] = [*((z, False) for z in between), (nodes[j], True)] if between or nodes[i] != nodes[j] else []
        j = i
    return _needed(points)


def _between(path: np.ndarray, start: complex, end: complex, alone: Segment | None, fit: Fit) -> list[complex] | None:
    """The points off the outline between two on it: none for a line, one for a curve, more where a curve alone wants
    them; None where neither is near enough."""
    if alone is not None and len(alone) == 2:
        return []
    if start == end:
        return [] if alone is not None else None
    straight = np.array([start, end])
    if _apart(path, straight) <= (fit.off if alone is not None else fit.off / 2):
        return []
    control = fit.round(_control(path, start, end))
    curve = _quadratic(start, control, end)
    if max(_apart(path, curve), _apart(curve, path)) <= fit.off:
        return [control]
    if alone is None:
        return None
    spline = curve_to_quadratic([(z.real, z.imag) for z in alone], fit.off / 2)
    return [fit.round(complex(*point)) for point in spline[1:-1]]


def _needed(points: list[Point]) -> list[Point]:
    """Without points on the outline that readers put in by themselves, half way between two beside it, or on a line."""
    told = []
    for k, (z, on) in enumerate(points):
        (before, on_before), (after, on_after) = points[k - 1], points[(k + 1) % len(points)]
        implied = on and not on_before and not on_after and before + after == 2 * z
        way = (z - before).conjugate() * (after - z)
        in_line = on and on_before and on_after and way.imag == 0.0 and way.real > 0.0
        if k == len(points) - 1 or not (implied or in_line):  # one is kept, to begin with
            told.append((z, on))
    return told


def _control(path: np.ndarray, start: complex, end: complex) -> complex:
    """The third point of the quadratic curve that comes nearest to a path (least squares, by turns with the places)."""
    ways = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(path)))])
    t = ways / ways[-1]
    control = 0j
    for _ in range(6):
        weight = 2 * (1 - t) * t
        control = complex(((path - (1 - t) ** 2 * start - t**2 * end) * weight).sum() / (weight * weight).sum())
        t = _FINE[np.abs(path[:, None] - _quadratic(start, control, end)[None]).argmin(1)]
    return control


def _quadratic(start: complex, control: complex, end: complex) -> np.ndarray:
    return (1 - _FINE) ** 2 * start + 2 * (1 - _FINE) * _FINE * control + _FINE**2 * end


def _apart(points: np.ndarray, line: np.ndarray) -> float:
    """How far the farthest of some points lies from a broken line."""
    start, way = line[:-1], np.diff(line)
    long = np.where(way == 0, 1.0, np.abs(way) ** 2)
    off = points[:, None] - start
    t = np.clip((off * way.conjugate()).real / long, 0.0, 1.0)
    return float(np.abs(off - t * way).min(1).max())


def _along(segment: Segment) -> np.ndarray:
    if len(segment) == 2:
        return segment[0] + (segment[1] - segment[0]) * _T
    a, b, c, d = segment
    return (1 - _T) ** 3 * a + 3 * (1 - _T) ** 2 * _T * b + 3 * (1 - _T) * _T**2 * c + _T**3 * d


def _turn(one: Segment, other: Segment) -> float:
    """By how much (degrees) an outline turns from one segment to the next."""
    into = next((one[-1] - z for z in one[-2::-1] if z != one[-1]), 1j)
    out = next((z - other[0] for z in other[1:] if z != other[0]), 1j)
    return abs(float(np.degrees(np.angle(out / into))))


def lay(points: list[Point], pen: AbstractPen) -> None:
    """Draw a closed outline of quadratic curves that begins with a point on it."""
    if len(points) < 3:
        return
    start = next(k for k, (_, on) in enumerate(points) if on)
    points = points[start:] + points[: start + 1]
    pen.moveTo((points[0][0].real, points[0][0].imag))
    beside: list[tuple[float, float]] = []
    for z, on in points[1:]:
        beside.append((z.real, z.imag))
        if on:
            (pen.qCurveTo if len(beside) > 1 else pen.lineTo)(*beside)
            beside = []
    pen.closePath()


def write(name: str, style: str, sources: list[tuple[TTFont, set[str]]]) -> None:
    glyphs, metrics, cmap = {".notdef": TTGlyphPen(None).glyph()}, {".notdef": (500, 0)}, {}
    for font, characters in sources:
        held, drawn = font.getBestCmap(), font.getGlyphSet()
        times = 1000 / font["head"].unitsPerEm
        assert times == 1.0, name
        for character in sorted(characters):
            code, base = ord(character), ord(RAISED.get(character, character))
            if code in cmap or base not in held:
                continue
            path = DecomposingRecordingPen(drawn)
            drawn[held[base]].draw(path if base == code else TransformPen(path, RAISED_AS))
            pen = TTGlyphPen(None)
            quadratic = "glyf" in font
            for contour in segments(path.value):
                lay(fitted(contour, LATIN if quadratic else CHINESE), pen if quadratic else ReverseContourPen(pen))
            own = f"u{code:04X}"
            glyphs[own] = pen.glyph()
            metrics[own] = (round(drawn[held[base]].width * (1.0 if base == code else RAISED_AS[0])), 0)
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
    })
    bold, italic = style == "Bold", style == "Italic"
    made.setupOS2(
        sTypoAscender=880, sTypoDescender=-230, sTypoLineGap=0, usWinAscent=880, usWinDescent=230,
        usWeightClass=700 if bold else 400, fsSelection=0x20 if bold else 0x01 if italic else 0x40,
    )
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
