"""Chinese characters that the family of the figures lacks, from a face of this machine."""

from __future__ import annotations

import os
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

__all__ = ["machine_glyph"]

# In the order of liking; of a collection the face of simplified Chinese.
_FILES = (
    "NotoSerifCJK-Regular.ttc", "NotoSerifCJKsc-Regular.otf", "NotoSerifSC-Regular.otf", "SourceHanSerifSC-Regular.otf",
    "SourceHanSerif-Regular.ttc", "simsun.ttc", "Songti.ttc", "NotoSansCJK-Regular.ttc", "NotoSansCJKsc-Regular.otf",
    "NotoSansSC-Regular.otf", "SourceHanSansSC-Regular.otf", "msyh.ttc", "PingFang.ttc", "uming.ttc", "wqy-zenhei.ttc",
    "wqy-microhei.ttc", "DroidSansFallbackFull.ttf", "DroidSansFallback.ttf",
)  # fmt: skip
_FOLDERS = (
    "/usr/share/fonts", "/usr/local/share/fonts", "~/.local/share/fonts", "~/.fonts", "/System/Library/Fonts",
    "/Library/Fonts", "~/Library/Fonts", "C:/Windows/Fonts", "/system/fonts",
)  # fmt: skip
EPS = 1.0  # thousandths of the size by which an outline may be moved as it becomes quadratic


@lru_cache(maxsize=4096)
def machine_glyph(character: str, em: int) -> tuple[int, bytes] | None:
    """Advance and simple TrueType outline of a glyph at so many units an em; None where no known face is installed or
    none has it."""
    font = _font()
    name = font.getBestCmap().get(ord(character)) if font is not None else None
    if font is None or name is None:
        return None
    from fontTools.misc.transform import Scale
    from fontTools.pens.cu2quPen import Cu2QuPen
    from fontTools.pens.recordingPen import DecomposingRecordingPen
    from fontTools.pens.transformPen import TransformPen
    from fontTools.pens.ttGlyphPen import TTGlyphPen

    drawn = font.getGlyphSet()
    path = DecomposingRecordingPen(drawn)
    drawn[name].draw(path)
    times = em / font["head"].unitsPerEm
    pen = TTGlyphPen(None)
    path.replay(TransformPen(Cu2QuPen(pen, EPS, reverse_direction="glyf" not in font), Scale(times)))
    outline = pen.glyph(round=round)
    return round(drawn[name].width * times), outline.compile(None) if outline.numberOfContours else b""


@cache
def _font() -> Any:
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
    """The known faces that are there, the best first."""
    found: dict[str, Path] = {}
    for folder in _FOLDERS:
        for place, _, names in os.walk(os.path.expanduser(folder)):
            found.update((name.lower(), Path(place, name)) for name in names)
    return [found[name.lower()] for name in _FILES if name.lower() in found]
