"""Drawings as PDF and PNG at true size, from the same primitives as the SVG, the same bytes every time.

Only this module and the charts know matplotlib.  Letters are those of the SVG; Chinese beyond them is set in the first
known Chinese face of the machine.
"""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from io import BytesIO
from threading import RLock, local
from typing import TYPE_CHECKING

from graphkin.drawing.font import FAMILY, FOLDER, holds
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
    Scan,
    Text,
    walk,
)
from graphkin.drawing.text import start_runs

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from matplotlib.path import Path
    from matplotlib.transforms import Transform

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
    "text.parse_math": False, "text.usetex": False, "text.hinting": "none", "text.antialiased": True,
    "lines.scale_dashes": False, "path.simplify": False, "path.snap": False, "path.sketch": None, "path.effects": [],
    "pdf.compression": 6, "pdf.use14corefonts": False, "pdf.inheritcolor": False,
}  # fmt: skip
_ALONE = RLock()


class MissingFont(UserWarning):
    """No Chinese face is installed: Chinese words in a PDF or PNG come out as empty boxes."""


@contextmanager
def own_settings(**further: object) -> Iterator[None]:
    """A context with our settings of matplotlib in this thread alone: the user's settings stay, also for the user's
    other threads meanwhile, whose changes are kept.

    matplotlib's settings are one dict for the whole process.  During a drawing that dict answers the drawing thread
    with our settings; all writes go to the user's.  One thread draws at a time, since matplotlib's reader of formulas
    cannot serve two.
    """
    import matplotlib

    users = matplotlib.rcParams
    with _ALONE, warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        kind, before = type(users), getattr(_OF_THREAD, "settings", None)
        _OF_THREAD.settings = _settings(tuple(further.items())) if before is None else {**before, **further}
        users.__class__ = _answering()
        try:
            yield
        finally:
            users.__class__ = kind
            _OF_THREAD.settings = before


def leave_undocumented() -> None:
    """Keep matplotlib from writing the documentation of its classes during its import: a third of the import's time.
    Only for processes of our own, where nobody reads it."""
    from matplotlib import artist

    artist.kwdoc = lambda artist: ""
    artist.Artist._update_set_signature_and_docstring = classmethod(lambda _: None)  # type: ignore[attr-defined]


_OF_THREAD = local()


def _settings(further: tuple[tuple[str, object], ...]) -> dict[str, object]:
    """matplotlib's default settings with ours over them, in its own form."""
    import matplotlib

    ours = matplotlib.RcParams({**_SETTINGS, **dict(further)})
    both = {**dict.copy(matplotlib.rcParamsDefault), **dict.copy(ours)}
    return {key: value for key, value in both.items() if not key.startswith("backend")}


@lru_cache(maxsize=1)
def _answering() -> type:
    """The user's settings, which answer a thread that draws here out of ours."""
    from matplotlib import RcParams

    class Answering(RcParams):
        def __getitem__(self, key: str) -> object:
            ours = getattr(_OF_THREAD, "settings", None)
            return ours[key] if ours is not None and key in ours else super().__getitem__(key)

        def copy(self) -> RcParams:
            """A copy of the user's settings, as one of the user's threads may make it meanwhile."""
            made = RcParams()
            dict.update(made, dict.copy(self))
            return made

    return Answering


def pdf_bytes(drawing: Page, *further: Page) -> bytes:
    """Drawings as a PDF at true size, a page each, with its fonts embedded and no date.

    Warns
    -----
    MissingFont : once, if a drawing has Chinese text and the machine has no face for it
    """
    pages = drawing, *further
    more = any(map(_needs_more, pages))
    family = faces(more)
    with own_settings():
        inked = []
        for page in pages:
            figure = empty_page(page.width, page.height)
            ink(figure, page.children, family)
            inked.append(figure)
        return figure_pdf(inked[0], drawing.title, more, *inked[1:])


def png_bytes(drawing: Page, dpi: float = 200.0) -> bytes:
    """The drawing as a PNG on white, true to size at ``dpi`` pixels per inch, rounded up to whole pixels.

    Warns
    -----
    MissingFont : as ``pdf_bytes``
    """
    family = faces(_needs_more(drawing))
    with own_settings():
        figure = empty_page(whole_pixels(drawing.width, dpi), whole_pixels(drawing.height, dpi), dpi)
        ink(figure, drawing.children, family)
        return figure_png(figure)


def whole_pixels(mm: float, dpi: float) -> float:
    """A length (mm) rounded up to whole pixels; otherwise the canvas cuts off the last pixel and all heights shift."""
    return math.ceil(mm * dpi / MM_PER_INCH - 1e-6) / dpi * MM_PER_INCH


def empty_page(width: float, height: float, dpi: float = 72.0) -> Figure:
    """A white matplotlib figure of a size in mm."""
    from matplotlib.figure import Figure

    size = width / MM_PER_INCH, height / MM_PER_INCH
    return Figure(figsize=size, dpi=dpi, facecolor="white", edgecolor="none", linewidth=0.0)


def ink(figure: Figure, children: tuple[Primitive, ...], family: list[str], order: int = 0) -> None:
    """Put strokes, fills and texts (mm from the left upper corner, y down) on a figure, from a place in its order of
    drawing on."""
    from matplotlib.transforms import Affine2D

    height = figure.get_figheight()
    page = Affine2D().scale(1 / MM_PER_INCH, -1 / MM_PER_INCH).translate(0.0, height) + figure.dpi_scale_trans
    for place, thing in enumerate(walk(children), order):
        if isinstance(thing, Text):
            _add_text(figure, thing, page, place, family)
        elif isinstance(thing, Scan):
            _add_scan(figure, thing, page, place)
        elif not isinstance(thing, Group):
            _add_shape(figure, thing, page, place)


def figure_pdf(figure: Figure, title: str, more: bool, *further: Figure) -> bytes:
    """Figures as a PDF without a date, a page each."""
    from matplotlib.backends.backend_pdf import FigureCanvasPdf, PdfPages

    buffer = BytesIO()
    facts = {"Title": title or None, "CreationDate": None, "Producer": None, "Creator": "graphkin"}
    # Chinese faces mostly hold PostScript outlines, which do not fit into a TrueType (42) font of a PDF; as Type 3 any
    # outlines do.  TrueType is what printers ask for, so it is used wherever it can be.
    with own_settings(**{"pdf.fonttype": 3 if more else 42}), PdfPages(buffer, metadata=facts) as pages:
        for page in (figure, *further):
            page.patch.set_visible(False)
            page.dpi = 200  # of pictures alone: what is drawn has no dots
            FigureCanvasPdf(page).print_pdf(pages)
    return buffer.getvalue()


def figure_png(figure: Figure) -> bytes:
    """A figure as a PNG, at its own dots per inch."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    buffer = BytesIO()
    FigureCanvasAgg(figure).print_png(buffer, metadata={"Software": None})
    return buffer.getvalue()


def _add_shape(
    figure: Figure, thing: Line | Polyline | Polygon | Circle | Arc, page: Transform, order: int
) -> None:
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
            _path(thing), facecolor=fill or "none", capstyle="butt", joinstyle="round", transform=page, zorder=order,
            clip_on=False, snap=False, **look,
        )
    )


def _add_scan(figure: Figure, scan: Scan, page: Transform, order: int) -> None:
    import numpy as np
    from matplotlib.path import Path
    from matplotlib.transforms import Affine2D
    from PIL import Image

    (a, b), (x, y) = (scan.step.real, scan.step.imag), (scan.corner.real, scan.corner.imag)
    with Image.open(BytesIO(scan.data)) as image:
        pixels = np.asarray(image.convert("RGBA"))
    whole = figure.add_axes((0.0, 0.0, 1.0, 1.0), zorder=order, frame_on=False)
    whole.set_axis_off()
    placed = Affine2D(np.array([[a, -b, x], [b, a, y], [0.0, 0.0, 1.0]])) + page
    shown = whole.imshow(
        pixels, extent=(0, scan.width, scan.height, 0), alpha=PALE, aspect="auto", transform=placed, origin="upper"
    )
    shown.set_clip_path(Path(_pairs((*scan.panel, scan.panel[0])), closed=True), page)


def _path(thing: Line | Polyline | Polygon | Circle | Arc) -> Path:
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


def _add_text(figure: Figure, text: Text, page: Transform, order: int, family: list[str]) -> None:
    for k, run in enumerate(start_runs(text)):
        figure.text(
            run.x, run.y, run.text, transform=page, family=family, size=run.size * POINTS_PER_MM,
            style="italic" if run.italic else "normal", weight="bold" if run.bold else "normal", color=text.colour,
            ha="left", va="baseline", zorder=order, clip_on=False, parse_math=False,
            gid=text.id if text.id and k == 0 else None,
        )  # fmt: skip


def _needs_more(drawing: Page) -> bool:
    """Whether a drawing has Chinese characters that the family lacks."""
    return not all(holds(thing.string) for thing in walk(drawing.children) if isinstance(thing, Text))


def faces(more: bool, warn: bool = True) -> list[str]:
    """Faces in the order of the search for a glyph; ``more`` for Chinese characters that the family lacks.  Warns
    MissingFont."""
    _register()
    if not more:
        return [FAMILY, _UPRIGHT]
    face = _chinese_face()
    if face is not None:
        return [FAMILY, _UPRIGHT, face]
    if warn:
        warnings.warn(
            "no Chinese font is installed, so Chinese words in PDF and PNG that graphkin's own font lacks are empty "
            "boxes; install one (Debian: fonts-noto-cjk)",
            MissingFont,
            stacklevel=3,
        )
    return [FAMILY, _UPRIGHT]


_UPRIGHT = f"{FAMILY} Upright"  # so that what a bold or italic face lacks is found there, as in an SVG


@lru_cache(maxsize=1)
def _register() -> None:
    """Make the family known to matplotlib, in this process."""
    from matplotlib.font_manager import FontEntry, fontManager

    looks = {"regular": ("normal", 400), "italic": ("italic", 400), "bold": ("normal", 700)}
    for name, (style, weight) in looks.items():
        path = str(FOLDER / f"{name}.ttf")
        fontManager.ttflist.append(FontEntry(path, name=FAMILY, style=style, weight=weight, size="scalable"))
    for style, weight in looks.values():
        path = str(FOLDER / "regular.ttf")
        fontManager.ttflist.append(FontEntry(path, name=_UPRIGHT, style=style, weight=weight, size="scalable"))


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
