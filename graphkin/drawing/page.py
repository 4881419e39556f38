"""Drawings as PDF and PNG at true size, from the same primitives as the SVG, the same bytes every time.

matplotlib stays behind this module.  Latin and Greek are set in STIX General, which comes with matplotlib; Chinese in
the first known Chinese face of the machine.
"""

from __future__ import annotations

import math
import re
import warnings
from functools import lru_cache
from io import BytesIO
from typing import Any

from graphkin.drawing.primitives import Arc, Circle, Drawing, Group, Line, Polygon, Polyline, Text, walk
from graphkin.drawing.text import has_cjk, start_runs

__all__ = ["MissingFont", "pdf_bytes", "png_bytes"]

MM_PER_INCH, POINTS_PER_MM = 25.4, 72 / 25.4

# In the order of liking: serif faces of simplified Chinese, then any face that has the signs.
_CHINESE = (
    "Noto Serif CJK SC", "Noto Serif SC", "Source Han Serif SC", "Source Han Serif CN", "Songti SC", "SimSun", "STSong",
    "AR PL UMing CN", "Noto Serif CJK JP", "Noto Sans CJK SC", "Source Han Sans SC", "Noto Sans SC", "PingFang SC",
    "Microsoft YaHei", "SimHei", "WenQuanYi Zen Hei", "WenQuanYi Micro Hei", "Noto Sans CJK JP", "Droid Sans Fallback",
    "Arial Unicode MS",
)  # fmt: skip
_CHINESE_FILES = re.compile("cjk|sourcehan|songti|simsun|uming|pingfang|msyh|simhei|wqy|droidsans|notos.*sc", re.I)

# Everything of the user's matplotlib settings that could change a stroke or a letter.
_SETTINGS = {
    "text.parse_math": False,
    "text.usetex": False,
    "text.hinting": "none",
    "text.antialiased": True,
    "lines.scale_dashes": False,
    "path.simplify": False,
    "path.snap": False,
    "path.sketch": None,
    "path.effects": [],
    "pdf.compression": 6,
    "pdf.use14corefonts": False,
    "pdf.inheritcolor": False,
}


class MissingFont(UserWarning):
    """No Chinese face is installed: Chinese words in a PDF or PNG come out as empty boxes."""


def pdf_bytes(drawing: Drawing) -> bytes:
    """The drawing as a PDF of one page at true size with its fonts embedded and no date.

    Warns
    -----
    MissingFont : once for the drawing, where it holds Chinese and the machine has no face for it
    """
    import matplotlib
    from matplotlib.backends.backend_pdf import FigureCanvasPdf

    # Chinese faces mostly hold PostScript outlines, which do not fit into a TrueType (42) font of a PDF; as Type 3 any
    # outlines do.  TrueType is what printers ask for, so it is used wherever it can be.
    font_type = 3 if _holds_cjk(drawing) else 42
    with matplotlib.rc_context({**_SETTINGS, "pdf.fonttype": font_type}), warnings.catch_warnings():
        family = _family(drawing)
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        figure = _figure(drawing, drawing.width / MM_PER_INCH, drawing.height / MM_PER_INCH, 72.0, family)
        figure.patch.set_visible(False)
        buffer = BytesIO()
        facts = {"Title": drawing.title or None, "CreationDate": None, "Producer": None, "Creator": "graphkin"}
        FigureCanvasPdf(figure).print_pdf(buffer, metadata=facts)
    return buffer.getvalue()


def png_bytes(drawing: Drawing, dpi: float = 200.0) -> bytes:
    """The drawing as a PNG on white, true to size at ``dpi`` pixels per inch, rounded up to whole pixels.

    Warns
    -----
    MissingFont : as ``pdf_bytes``
    """
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    with matplotlib.rc_context(_SETTINGS), warnings.catch_warnings():
        family = _family(drawing)
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        # Whole pixels, or the canvas cuts the last one off and all heights shift.
        across, down = (math.ceil(mm * dpi / MM_PER_INCH - 1e-6) for mm in (drawing.width, drawing.height))
        figure = _figure(drawing, across / dpi, down / dpi, dpi, family)
        buffer = BytesIO()
        FigureCanvasAgg(figure).print_png(buffer, metadata={"Software": None})
    return buffer.getvalue()


def _figure(drawing: Drawing, width: float, height: float, dpi: float, family: list[str]) -> Any:
    """All strokes, fills and texts on a page of a size in inches."""
    from matplotlib.figure import Figure
    from matplotlib.transforms import Affine2D

    figure = Figure(figsize=(width, height), dpi=dpi, facecolor="white", edgecolor="none", linewidth=0.0)
    page = Affine2D().scale(1 / MM_PER_INCH, -1 / MM_PER_INCH).translate(0.0, height) + figure.dpi_scale_trans
    for order, thing in enumerate(walk(drawing.children)):
        if isinstance(thing, Text):
            _add_text(figure, thing, page, order, family)
        elif not isinstance(thing, Group):
            _add_shape(figure, thing, page, order)
    return figure


def _add_shape(figure: Any, thing: Line | Polyline | Polygon | Circle | Arc, page: Any, order: int) -> None:
    from matplotlib.patches import PathPatch

    stroke = thing.stroke
    look: dict[str, object] = {"linewidth": 0.0, "edgecolor": "none"}
    if stroke is not None:
        look = {"linewidth": stroke.width * POINTS_PER_MM, "edgecolor": stroke.colour}
        if stroke.dash:
            look["linestyle"] = (0.0, tuple(mm * POINTS_PER_MM for mm in stroke.dash))
    fill = thing.fill if isinstance(thing, Polygon | Circle) else ""
    figure.add_artist(
        PathPatch(
            _path(thing),
            facecolor=fill or "none",
            capstyle="butt",
            joinstyle="round",
            transform=page,
            zorder=order,
            clip_on=False,
            snap=False,
            **look,
        )
    )


def _path(thing: Line | Polyline | Polygon | Circle | Arc) -> Any:
    import numpy as np
    from matplotlib.path import Path

    if isinstance(thing, Line):
        return Path(_pairs((thing.start, thing.inked_end)))
    if isinstance(thing, Polyline):
        return Path(_pairs(thing.points))
    if isinstance(thing, Polygon):
        return Path(_pairs((*thing.points, thing.points[0])), closed=True)
    if isinstance(thing, Circle):
        return Path.circle((thing.centre.real, thing.centre.imag), thing.radius)
    low, high = sorted((thing.start, thing.end))
    unit = Path.arc(math.degrees(low), math.degrees(high))
    corners = np.asarray(unit.vertices) * (thing.radius, -thing.radius) + (thing.centre.real, thing.centre.imag)
    return Path(corners if thing.end > thing.start else corners[::-1], unit.codes)


def _pairs(points: tuple[complex, ...]) -> list[tuple[float, float]]:
    return [(point.real, point.imag) for point in points]


def _add_text(figure: Any, text: Text, page: Any, order: int, family: list[str]) -> None:
    for run in start_runs(text):
        figure.text(
            run.x,
            run.y,
            run.text,
            transform=page,
            family=family,
            size=run.size * POINTS_PER_MM,
            style="italic" if run.italic else "normal",
            weight="bold" if run.bold else "normal",
            color=text.colour,
            ha="left",
            va="baseline",
            zorder=order,
            clip_on=False,
            parse_math=False,
        )


def _holds_cjk(drawing: Drawing) -> bool:
    return any(isinstance(thing, Text) and has_cjk(thing.string) for thing in walk(drawing.children))


def _family(drawing: Drawing) -> list[str]:
    """Faces in the order in which a glyph is looked for.  Warns MissingFont."""
    if not _holds_cjk(drawing):
        return ["STIXGeneral"]
    chinese = _chinese_face()
    if chinese is None:
        warnings.warn(
            "no Chinese font is installed, so Chinese words in PDF and PNG are empty boxes; "
            "install one (Debian: fonts-noto-cjk) or take the SVG",
            MissingFont,
            stacklevel=3,
        )
        return ["STIXGeneral"]
    return ["STIXGeneral", chinese]


@lru_cache(maxsize=1)
def _chinese_face() -> str | None:
    from matplotlib import font_manager

    manager = font_manager.fontManager
    known = {entry.name for entry in manager.ttflist}
    if known.isdisjoint(_CHINESE):
        # The list of fonts that matplotlib keeps may be older than the fonts.
        for path in sorted(font_manager.findSystemFonts()):
            if _CHINESE_FILES.search(path):
                manager.addfont(path)
        known = {entry.name for entry in manager.ttflist}
    return next((name for name in _CHINESE if name in known), None)
