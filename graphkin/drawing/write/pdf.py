"""Drawings and charts as PDF and PNG at true size: their SVG on pages of Typst, the same bytes every time.

Typst stays behind this module and that of typeset papers.  Letters are those of the SVG; Chinese beyond them is set in
the first known Chinese face of the machine.
"""

from __future__ import annotations

import json
import math
import warnings
from collections.abc import Sequence
from functools import cache
from io import BytesIO
from typing import TYPE_CHECKING, Any, TypeAlias

from graphkin.drawing.font import FAMILY, FOLDER

if TYPE_CHECKING:
    import typst

MM_PER_INCH = 25.4

# In the order of liking: serif faces of simplified Chinese, then any face that has the signs.
CHINESE = (
    "Noto Serif CJK SC", "Noto Serif SC", "Source Han Serif SC", "Source Han Serif CN", "Songti SC", "SimSun", "STSong",
    "AR PL UMing CN", "Noto Serif CJK JP", "Noto Sans CJK SC", "Source Han Sans SC", "Noto Sans SC", "PingFang SC",
    "Microsoft YaHei", "SimHei", "WenQuanYi Zen Hei", "WenQuanYi Micro Hei", "Noto Sans CJK JP", "Droid Sans Fallback",
    "Arial Unicode MS",
)
SIGNS = ("DejaVu Sans Mono", "New Computer Modern")  # come with Typst: for signs that no other face has

SvgPage: TypeAlias = tuple[float, float, str, str, bool]
"""A page: its width and height (mm), its content as an SVG element without faces, its description in words, and whether
it has Chinese characters that the family lacks."""

_TEMPLATE = b"""
#let given = json(bytes(sys.inputs.given))
#set document(title: given.title, date: none)
#for (width, height, svg, seen, paper) in given.pages {
  page(width: paper.at(0) * 1mm, height: paper.at(1) * 1mm, margin: 0mm, place(top + left,
    image(bytes(svg), format: "svg", width: width * 1mm, height: height * 1mm, alt: seen)))
}
"""


class MissingFont(UserWarning):
    """No Chinese face is installed: Chinese words in a PDF or PNG come out as empty boxes."""


@cache
def faces(more: bool) -> tuple[list[str], typst.Fonts]:
    """Names of the faces in order of preference, and what Typst has found of them, read once; ``more`` with those of
    the machine, for Chinese characters that the family lacks."""
    import typst

    fonts = typst.Fonts(include_system_fonts=more, font_paths=[str(FOLDER)])
    known = set(fonts.families())
    return [name for name in (FAMILY, *CHINESE, *SIGNS) if name in known], fonts


def in_faces(svg: str, names: Sequence[str]) -> str:
    """An SVG element with the names of its faces, in order of preference."""
    return svg.replace("<svg ", f'<svg font-family="{", ".join(names)}" ', 1)


def pdf_bytes(pages: Sequence[SvgPage], title: str) -> bytes:
    """Pages as a PDF at true size, with its fonts embedded and no date.

    Warns
    -----
    MissingFont : if they have Chinese characters that the family lacks, and the machine has no face for them
    """
    return _typeset(pages, title, None, format="pdf", timestamp=0)


def png_bytes(page: SvgPage, title: str, dpi: float) -> bytes:
    """A page as a PNG on white, true to size at ``dpi`` pixels per inch, rounded up to whole pixels.

    Warns
    -----
    MissingFont : as ``pdf_bytes``
    """
    from PIL import Image

    made = BytesIO()
    with Image.open(BytesIO(_typeset([page], title, dpi, format="png", ppi=dpi))) as image:
        image.convert("RGB").save(made, "PNG", dpi=(dpi, dpi))
    return made.getvalue()


def _typeset(pages: Sequence[SvgPage], title: str, dpi: float | None, **options: Any) -> bytes:
    """The file that Typst makes of pages; where ``dpi`` is given the sides of the paper are rounded up to whole
    pixels."""
    import typst

    more = any(page[-1] for page in pages)
    names, fonts = faces(more)
    if more and not set(names) & set(CHINESE):
        warnings.warn(
            "no Chinese font is installed, so Chinese words in PDF and PNG that graphkin's own font lacks are empty "
            "boxes; install one (Debian: fonts-noto-cjk)",
            MissingFont,
            stacklevel=4,
        )

    def side(mm: float) -> float:
        return mm if dpi is None else math.ceil(mm * dpi / MM_PER_INCH - 1e-6) / dpi * MM_PER_INCH

    given = [(width, height, in_faces(svg, names), seen, (side(width), side(height)))
             for width, height, svg, seen, _ in pages]
    inputs = {"given": json.dumps({"title": title, "pages": given}, ensure_ascii=False, allow_nan=False)}
    made = typst.compile(_TEMPLATE, font_paths=fonts, sys_inputs=inputs, **options)
    assert isinstance(made, bytes)
    return made
