"""How wide a text is, and how far its ink reaches: boxes of texts, from the glyphs in which they are set."""

from __future__ import annotations

import unicodedata
from functools import lru_cache

from graphkin.drawing.box import Box
from graphkin.drawing.font import EM, Style, glyph
from graphkin.drawing.ink.primitives import Run, Text
from graphkin.plane import added_up

__all__ = ["CAP_HEIGHT", "has_cjk", "is_cjk", "run_box", "runs_width", "start_runs", "style_of", "text_box", "width"]

ASCENT, DESCENT = 0.70, 0.22  # of the size, at least; accents, roots and CJK reach further
CAP_HEIGHT = 0.66
UNKNOWN = 0.72  # of the size: the advance of a sign that no face at hand has


def is_cjk(character: str) -> bool:
    """Whether a character is of a Chinese font and one em wide (full-width marks count)."""
    return ord(character) > 0x2E7F and unicodedata.east_asian_width(character) in "WF"


@lru_cache(maxsize=4096)
def has_cjk(text: str) -> bool:
    return any(map(is_cjk, text))


@lru_cache(maxsize=4096)
def width(text: str, size: float, italic: bool = False, bold: bool = False) -> float:
    """Advance width (mm) of a text set at a size (mm)."""
    return _length(text, style_of(italic, bold)) * size


@lru_cache(maxsize=8192)
def _length(text: str, style: Style) -> float:
    """Advance width in sizes."""
    return added_up(_advance(character, style) for character in text)


def style_of(italic: bool, bold: bool) -> Style:
    """The face of a run; bold wins, for there is no bold italic."""
    return "bold" if bold else "italic" if italic else "regular"


@lru_cache(maxsize=8192)
def _advance(character: str, style: Style) -> float:
    found = glyph(character, style)
    if found is not None:
        return found.advance / EM
    return 1.0 if is_cjk(character) else 0.0 if unicodedata.combining(character) else UNKNOWN


def run_box(run: Run) -> Box:
    """Box of one run about its text's own point: from ascender to descender, from start to advance, and further where
    slanted letters reach further."""
    before, ascent, after, descent = _reach(run.text, style_of(run.italic, run.bold))
    return Box(
        run.x - before * run.size,
        run.y - ascent * run.size,
        run.x + width(run.text, run.size, run.italic, run.bold) + after * run.size,
        run.y + descent * run.size,
    )


@lru_cache(maxsize=4096)
def _reach(text: str, style: Style) -> tuple[float, float, float, float]:
    """How far ink reaches beyond the start, above the baseline, beyond the advance and below the baseline, in sizes."""
    found = [g for c in text if (g := glyph(c, style)) is not None]
    if not found:
        return 0.0, ASCENT, 0.0, DESCENT
    first, last = found[0], found[-1]
    return (
        max(0, -first.box[0]) / EM,
        max(ASCENT, *(g.box[3] / EM for g in found)),
        max(0, last.box[2] - last.advance) / EM,
        max(DESCENT, *(-g.box[1] / EM for g in found)),
    )


def runs_width(runs: tuple[Run, ...]) -> float:
    """From the text's own point to the end of the run that reaches furthest (mm)."""
    if len(runs) == 1:
        return runs[0].x + width(runs[0].text, runs[0].size, runs[0].italic, runs[0].bold)
    return max((run.x + width(run.text, run.size, run.italic, run.bold) for run in runs), default=0.0)


def start_runs(text: Text) -> tuple[Run, ...]:
    """The runs of a text on the page: x and y become page coordinates (mm) of the start of each baseline."""
    x, y = text.at.real, text.at.imag
    if text.anchor != "start":
        x -= (0.5 if text.anchor == "middle" else 1.0) * runs_width(text.runs)
    return tuple(Run(run.text, x + run.x, y + run.y, run.size, run.italic, run.bold) for run in text.runs)


def text_box(text: Text) -> Box:
    """Box of a text on the page (mm).  Raises ValueError for a text without runs."""
    return box_about(text.runs, text.anchor).moved(text.at)


@lru_cache(maxsize=4096)
def box_about(runs: tuple[Run, ...], anchor: str = "start") -> Box:
    """Box of the text of some runs about its own point (mm)."""
    boxes = [run_box(run) for run in start_runs(Text(0j, runs, anchor))]
    return Box(
        min(b.left for b in boxes),
        min(b.top for b in boxes),
        max(b.right for b in boxes),
        max(b.bottom for b in boxes),
    )
