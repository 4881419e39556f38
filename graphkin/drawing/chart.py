"""Charts on a page in millimetres: axes, curves and marks by matplotlib, words and labels as on every other figure.

Dash and shape of marker distinguish all curves, so that black on white is enough.
"""

from __future__ import annotations

import json
import math
import re
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import lru_cache
from html import escape, unescape
from io import BytesIO
from itertools import pairwise
from threading import RLock, local
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from graphkin.drawing.box import Box
from graphkin.drawing.font import FAMILY, FOLDER, Style, face_rules, families, holds
from graphkin.drawing.ink.primitives import Line, Stroke, Text
from graphkin.drawing.place.labels import Label, Mark
from graphkin.drawing.place.obstacles import Obstacles
from graphkin.drawing.place.placement import Placement
from graphkin.drawing.text import rich, start_runs, width
from graphkin.drawing.write.drawing import Kept
from graphkin.drawing.write.pdf import CHINESE, MM_PER_INCH, SvgPage
from graphkin.errors import CallError
from graphkin.words import Phrase
from graphkin.words.symbols import Words

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes  # also for those who paint charts
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure as Figure
    from matplotlib.transforms import Transform

Look = dict[str, Any]
"""Properties of a line of matplotlib, by their names there."""
Shape = Literal["circle", "disc", "up", "down", "square", "diamond", "cross"]

POINTS_PER_MM = 72 / MM_PER_INCH
NUMBER, TITLE = 2.5, 3.0  # letters, mm
MARKER = 1.8  # mm across
IN_FRONT = 100  # place in the order of drawing from which words stand: in front of all curves
BEHIND = 1.5
"""Lines of this order or less (zero lines, limit positions) are ground: labels keep off them only where they can."""

# Kinds of curve in the order of use: told apart without colour.
_DASHES: tuple[tuple[float, ...], ...] = (), (3.0, 1.2), (0.9, 0.9), (4.0, 1.0, 0.9, 1.0)
SOLID_AND_DASHED = tuple(Stroke(width, dash) for width in (0.45, 0.25) for dash in _DASHES)
_SIGNS: dict[Shape, str] = {
    "circle": "o", "disc": "o", "up": "^", "down": "v", "square": "s", "diamond": "D", "cross": "x",
}
_SMALLER = {"up": 0.9, "down": 0.9, "diamond": 0.8, "square": 0.9}  # of the side, to look as large as a disc

# The look of a chart, and everything of the user's settings of matplotlib that could change a stroke or a letter.
_SETTINGS = {
    "text.parse_math": True,  # powers at ticks; words never are
    "text.usetex": False, "text.hinting": "none", "text.antialiased": True, "lines.scale_dashes": False,
    "path.simplify": False, "path.snap": False, "path.sketch": None, "path.effects": [],
    "font.family": [FAMILY],
    "font.size": NUMBER * POINTS_PER_MM,
    "mathtext.fontset": "stix",
    "svg.fonttype": "none",
    "svg.hashsalt": "graphkin",
    "axes.linewidth": 0.25 * POINTS_PER_MM,
    "axes.axisbelow": True,
    "axes.formatter.limits": (-3, 6),
    "axes.formatter.useoffset": False,
    "axes.grid": True,
    "grid.color": "#b8b8b8",
    "grid.linewidth": 0.1 * POINTS_PER_MM,
    "lines.solid_capstyle": "butt",
    "lines.solid_joinstyle": "round",
    **{f"{axis}tick.direction": "in" for axis in "xy"},
    **{f"{axis}tick.major.size": 1.2 * POINTS_PER_MM for axis in "xy"},
    **{f"{axis}tick.major.width": 0.25 * POINTS_PER_MM for axis in "xy"},
    "xtick.major.pad": 1.6 * POINTS_PER_MM,
    "ytick.major.pad": 1.2 * POINTS_PER_MM,
    **{f"{axis}tick.minor.size": 0.0 for axis in "xy"},
}
_ALONE = RLock()
_UPRIGHT = f"{FAMILY} Upright"  # so that what a bold or italic face lacks is found there, as in an SVG
_FAMILY = re.compile(f"; font-family: '(?:{FAMILY}|STIXGeneral)'(?:, '[^']*')*")
_TEXT = re.compile("<text([^>]*)>(.*?)</text>", re.DOTALL)
_TAG = re.compile("<[^>]*>")
_SIZE = re.compile(r"font-size: ([\d.]+)px")


@dataclass(frozen=True, repr=False)
class ChartPage(Kept):
    """A page drawn by matplotlib: size in mm, title and description in words, language, facts for programs.

    ``paint`` puts panels, curves and words on an empty figure of that size; it is called anew for every file, so that
    files share no state.
    """

    width: float
    height: float
    paint: Callable[[Figure], None]
    title: str = ""
    desc: str = ""
    lang: str = "en"
    metadata: Mapping[str, object] = field(default_factory=dict)

    def __hash__(self) -> int:
        return hash((self.width, self.height, self.title, self.desc))

    def __reduce__(self) -> tuple[object, ...]:
        raise CallError.of(Phrase("a chart"), "is drawn by a function and cannot be",
                           "pickle the result that it belongs to or")

    def figure(self, dpi: float = 72.0) -> Figure:
        """The page as a new matplotlib figure, which the caller may change."""
        with own_settings():
            figure = self._painted(dpi)
            figure.draw_without_rendering()  # ticks are made where they are first drawn, with the settings of then
            return figure

    def _painted(self, dpi: float = 72.0) -> Figure:
        from matplotlib.figure import Figure

        _register()
        size = self.width / MM_PER_INCH, self.height / MM_PER_INCH
        figure = Figure(figsize=size, dpi=dpi, facecolor="white", edgecolor="none", linewidth=0.0)
        self.paint(figure)
        return figure

    def _written(self, outlines: bool = False, on_paper: bool = True) -> tuple[str, str]:
        """What matplotlib writes as SVG, texts with their lengths: the beginning of the element, and the rest of it."""
        from matplotlib.backends.backend_svg import FigureCanvasSVG

        buffer = BytesIO()
        with own_settings(**{"svg.fonttype": "path" if outlines else "none"}):
            figure = self._painted()
            figure.patch.set_visible(on_paper)
            FigureCanvasSVG(figure).print_svg(buffer, metadata=dict.fromkeys(("Date", "Creator", "Format", "Type")))
        text = _FAMILY.sub("", buffer.getvalue().decode())
        start, rest = text[text.index("<svg ") :].split(">", 1)
        return start, _TEXT.sub(_with_length, rest)

    def _svg_pages(self) -> Iterator[SvgPage]:
        yield self.width, self.height, ">".join(self._written(on_paper=False)), self.desc, not holds(self.title)

    def _svg(self, outlines: bool = False) -> bytes:
        """The SVG with the head and the font faces of all figures."""
        start, rest = self._written(outlines)
        name, rules = face_rules(_used(rest))
        facing = f'role="img" lang="{self.lang}" xml:lang="{self.lang}" font-family="{families(name)}"'
        facts = json.dumps(self.metadata, ensure_ascii=False, sort_keys=True, allow_nan=False, separators=(",", ":"))
        words = {"title": self.title, "desc": self.desc, "metadata": facts}
        head = "".join(f"<{tag}>{escape(text)}</{tag}>" for tag, text in words.items() if text)
        head += f"<style>{rules}</style>"
        return f'<?xml version="1.0" encoding="utf-8"?>\n{start} {facing}>{head}{rest}'.encode()


def _with_length(text: re.Match[str]) -> str:
    """A text of an SVG of matplotlib with the length of its glyphs, which also holds in readers that round each glyph
    to whole pixels."""
    look, inner = text.groups()
    size = _SIZE.search(look)
    if size is None or "<" in inner or not inner:
        return text[0]
    long = width(unescape(inner), float(size[1]), "italic" in look, _is_bold(look))
    return f'<text{look} textLength="{long:.4f}">{inner}</text>'


def _is_bold(look: str) -> bool:
    return "font-weight: 700" in look or "font-weight: bold" in look


def _used(svg: str) -> dict[Style, set[str]]:
    """The characters of each face in the texts of an SVG of matplotlib."""
    used: dict[Style, set[str]] = {"regular": set(), "italic": set(), "bold": set()}
    for look, inner in _TEXT.findall(svg):
        characters = set(unescape(_TAG.sub("", inner)))
        used["regular"] |= characters
        for style in ("italic", "bold"):
            if style in look + inner or (style == "bold" and _is_bold(look)):
                used[style] |= characters
    return used


def add_panel(figure: Figure, box: Box, id: str, title: Words = "", x_title: Words = "") -> Axes:
    """Axes whose frame is a box of the page (mm): the title of the vertical axis stands over it, that of the horizontal
    axis below its right end."""
    width, height = _size(figure)
    shares = box.left / width, 1 - box.bottom / height, box.width / width, box.height / height
    axes = figure.add_axes(shares, gid=id)
    add_words(figure, Text(complex(box.left, box.top - 1.8), rich(title, TITLE)))
    add_words(figure, Text(complex(box.right, box.bottom + 6.0 + NUMBER), rich(x_title, TITLE), "end"))
    axes.yaxis.set_offset_position("right")  # a power of ten, where the titles leave room
    axes.xaxis.get_offset_text().set(x=0.0, horizontalalignment="left")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_label_coords(0.0, 0.0)  # it has none, and no place is looked for
    return axes


def add_words(figure: Figure, *parts: Text | Line) -> None:
    """Texts with their strokes, in mm of the page."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path
    from matplotlib.transforms import Affine2D

    mm = Affine2D().scale(1 / MM_PER_INCH, -1 / MM_PER_INCH).translate(0.0, figure.get_figheight())
    placed: Look = {"transform": mm + figure.dpi_scale_trans, "zorder": IN_FRONT, "clip_on": False}
    for part in parts:
        if isinstance(part, Line):
            ends = [(z.real, z.imag) for z in (part.start, part.end)]
            line = {"edgecolor" if key == "color" else key: value for key, value in look(part.stroke).items()}
            figure.add_artist(PathPatch(
                Path(ends), facecolor="none", capstyle="butt", joinstyle="round", snap=False, **line, **placed))
            continue
        for k, run in enumerate(start_runs(part)):
            figure.text(
                run.x, run.y, run.text, family=_faces(run.text), size=run.size * POINTS_PER_MM,
                style="italic" if run.italic else "normal", weight="bold" if run.bold else "normal", color=part.colour,
                ha="left", va="baseline", parse_math=False, gid=part.id if part.id and k == 0 else None, **placed,
            )


def add_legend(figure: Figure, at: complex, entries: Sequence[tuple[Look, str]]) -> None:
    """A legend in one line: pieces of curves (``look``) and markers, with their words; ``at`` is its left end."""
    from matplotlib.lines import Line2D

    width, height = _size(figure)
    family = _faces("".join(words for _, words in entries))
    legend = figure.legend(
        [Line2D([], [], **style) for style, _ in entries], [words for _, words in entries],
        loc="center left", bbox_to_anchor=(at.real / width, 1 - at.imag / height), ncols=len(entries), frameon=False,
        borderpad=0.0, borderaxespad=0.0, handlelength=8.0 / TITLE, handletextpad=0.5, columnspacing=2.0,
        prop={"family": family, "size": TITLE * POINTS_PER_MM},
    )
    legend.set_zorder(IN_FRONT)


def look(stroke: Stroke) -> Look:
    """A stroke as matplotlib's properties of a line."""
    dash = (0.0, tuple(mm * POINTS_PER_MM for mm in stroke.dash)) if stroke.dash else "-"
    return {"linewidth": stroke.width * POINTS_PER_MM, "linestyle": dash, "color": stroke.colour}


def marker(shape: Shape) -> Look:
    """A marker as matplotlib's properties of an invisible line; whole also at the edge of a panel."""
    return {
        "linestyle": "", "color": "#000000", "marker": _SIGNS[shape],
        "markersize": MARKER * _SMALLER.get(shape, 1.0) * POINTS_PER_MM,
        "markerfacecolor": "#ffffff" if shape == "circle" else "#000000", "markeredgewidth": 0.25 * POINTS_PER_MM,
        "clip_on": False, "snap": False,
    }


def count_steps(axis: Axis, step: float | None = None, most: int = 6) -> None:
    """Ticks of an axis at whole steps; by default at steps of the series 1, 2, 2.5, 5."""
    from matplotlib.ticker import MaxNLocator, MultipleLocator, ScalarFormatter

    class Numbers(ScalarFormatter):
        """Plain numbers; their common power of ten is written once."""

        def get_offset(self) -> str:
            power = super().get_offset().removeprefix("1e")
            return f"$\\times\\mathdefault{{10^{{{power}}}}}$" if power else ""

    axis.set_major_formatter(Numbers())
    axis.set_major_locator(MultipleLocator(step) if step else MaxNLocator(most, steps=(1, 2, 2.5, 5, 10)))


def degree_step(wide: float, most: int = 13) -> float:
    """Ticks of an axis of angles (degrees): 30, 45, 60, 90 or parts of them, at most ``most``."""
    steps = (1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0)
    return next((step for step in steps if wide / step <= most), 360.0)


def count_powers(axes: Axes, which: Literal["x", "y"], low: float, high: float, most: int = 9) -> tuple[float, float]:
    """A scale of powers of ten for positive values; returns its ends, whole powers."""
    from matplotlib.ticker import FixedLocator

    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    last = max(last, first + 1)
    ends = 10.0**first, 10.0**last
    axes.set(**{f"{which}scale": "log", f"{which}lim": ends})
    axis = axes.xaxis if which == "x" else axes.yaxis
    axis.set_major_locator(FixedLocator([10.0**k for k in range(first, last + 1, math.ceil((last - first) / most))]))
    axis.minorticks_off()
    return ends


def add_labels(
    axes: Axes, labels: Sequence[tuple[Words, ArrayLike]], sizes: Sequence[float] = (NUMBER,),
    toward: Sequence[tuple[float, ...]] = (),
) -> None:
    """Words at points or stretches of the curves, in the panel and clear of its strokes and of each other.

    Parameters
    ----------
    labels : the words of each, with a point (x, y) or the two ends of a stretch, shape (2, 2), in values of the axes
    sizes : of letters (mm); the largest with which all stand clear is taken
    toward : directions (rad) from each point in order of preference
    """
    panel, obstacles = _box(axes), _in_the_way(axes)
    marks: list[Mark] = []
    for _, at in labels:
        ends = _on_page(_figure(axes), axes.transData, np.atleast_2d(at))
        marks.append(ends[0] if len(ends) == 1 else (ends[0], ends[1]))
    liked = toward or ((),) * len(labels)
    for size in sizes:
        asked = [
            Label(Text(0j, rich(words, size)), mark, directions)
            for (words, _), mark, directions in zip(labels, marks, liked, strict=True)
        ]
        placed = Placement(asked, panel, obstacles).placed
        if all(label_placed.clear for label_placed in placed):
            break
    for k, label_placed in enumerate(placed, 1):
        text = label_placed.text._replace(id=f"{axes.get_gid()}-label-{k}")
        add_words(_figure(axes), text, *([label_placed.leader] if label_placed.leader is not None else []))


def _figure(axes: Axes) -> Figure:
    return axes.figure  # type: ignore[return-value]  # none of ours is part of another


def _size(figure: Figure) -> tuple[float, float]:
    """Width and height of the page (mm)."""
    width, height = figure.get_size_inches() * MM_PER_INCH
    return float(width), float(height)


def _on_page(figure: Figure, transform: Transform, points: ArrayLike) -> list[complex]:
    """Points, shape (n, 2), in mm of the page."""
    x, y = (transform - figure.dpi_scale_trans).transform(points).T * MM_PER_INCH
    return [complex(a, b) for a, b in zip(x, _size(figure)[1] - y, strict=True)]


def _box(axes: Axes) -> Box:
    """The frame of axes on the page (mm)."""
    width, height = _size(_figure(axes))
    share = axes.get_position()
    return Box(share.x0 * width, (1 - share.y1) * height, share.x1 * width, (1 - share.y0) * height)


def _in_the_way(axes: Axes) -> Obstacles:
    """Frame, curves and markers of axes as obstacles on the page."""
    box = _box(axes)
    solid = [*pairwise((*box.corners, box.corners[0]))]
    ground: list[tuple[complex, complex]] = []
    areas: list[Box] = []
    for line in axes.lines:
        points = _on_page(_figure(axes), line.get_transform(), line.get_xydata())
        if line.get_linestyle() != "None":
            inside = [box.left <= z.real <= box.right and box.top <= z.imag <= box.bottom for z in points]
            parts = (  # most lie whole within
                (a, b) if both else box.clip(a, b)
                for (a, b), both in zip(pairwise(points), map(all, pairwise(inside)), strict=True)
                if both or math.isfinite(abs(a - b))
            )
            kept = ground if line.get_zorder() <= BEHIND else solid
            kept.extend(segment for segment in parts if segment is not None)
        if line.get_marker() not in ("", "None", None):
            reach = line.get_markersize() / POINTS_PER_MM / 2
            areas += [Box.around((z,)).grown(reach) for z in points if math.isfinite(abs(z))]
    return Obstacles(tuple(solid), tuple(ground), tuple(areas))


# matplotlib with our settings and faces


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
        _OF_THREAD.settings = _settings() | further if before is None else {**before, **further}
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


def _settings() -> dict[str, object]:
    """matplotlib's default settings with ours over them, in its own form."""
    import matplotlib

    ours = matplotlib.RcParams(_SETTINGS)
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


def _faces(words: str) -> list[str]:
    """Faces in the order of the search for a glyph of some words."""
    from matplotlib.font_manager import fontManager

    more = [] if holds(words) else [name for name in CHINESE if name in fontManager.get_font_names()]
    return [FAMILY, _UPRIGHT, *more[:1]]


@lru_cache(maxsize=1)
def _register() -> None:
    """Make the family known to matplotlib, in this process."""
    from matplotlib.font_manager import FontEntry, fontManager

    looks = {"regular": ("normal", 400), "italic": ("italic", 400), "bold": ("normal", 700)}
    for name, (style, weight) in looks.items():
        for family, file in ((FAMILY, name), (_UPRIGHT, "regular")):
            path = str(FOLDER / f"{file}.ttf")
            fontManager.ttflist.append(FontEntry(path, name=family, style=style, weight=weight, size="scalable"))
