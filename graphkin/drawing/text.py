"""Texts as runs: plain words, and symbols with sub- and superscripts at places of their own; fitted to a width;
and the width and the ink of a text, from its glyphs.

Letters of symbols are italic, digits and signs upright, Chinese upright everywhere; an index and a mark after one
letter stand above each other; an index may have an index; a prime behind an index stands above it; a vector is bold
and upright, or has an arrow over its letter.
"""

from __future__ import annotations

import re
import unicodedata
from bisect import bisect_right
from collections.abc import Sequence
from functools import lru_cache
from itertools import accumulate

from graphkin.drawing.box import Box
from graphkin.drawing.font import EM, Style, glyph, style_of
from graphkin.drawing.ink.primitives import Run, Text
from graphkin.plane import added_up
from graphkin.words.symbols import Atom, RichText, Words, stretches

LETTER, INDEX, SMALLEST = 3.5, 2.5, 2.0  # mm
_DROP, _DROP_STACKED, _RISE = 0.24, 0.30, 0.40  # of the size of the letter, after the usual practice of typesetting
_GAP_SUB, _GAP_SUPER = 0.02, 0.06
_LEADING = 1.4  # from line to line
_UNBROKEN = re.compile("[顺逆]时针")  # Chinese words that stay whole, since they often stand last
_BREAKS_AFTER = ("，", "。", "；", "：", "、")
_SPACES = " \u00a0\u3000"
_ARROW = "→"
_ARROW_SIZE, _ARROW_GAP, _SLANT = 0.57, 0.05, 0.04  # of the size of the letter under it


def plain(text: str, size: float = LETTER, italic: bool = False, bold: bool = False) -> tuple[Run, ...]:
    """Words in one face; white space is folded to single spaces."""
    folded = " ".join(text.split())
    return (Run(folded, 0.0, 0.0, size, italic, bold),) if folded else ()


@lru_cache(maxsize=8192)
def rich(text: Words, size: float = LETTER, bold: bool = False) -> tuple[Run, ...]:
    """Words and symbols set as runs in order."""
    runs: list[Run] = []
    x = 0.0
    for part in stretches(text):
        if not isinstance(part, str):
            set_part, advance = _symbol(part, size)
            runs += [Run(r.text, r.x + x, r.y, r.size, r.italic, r.bold) for r in set_part]
            x += advance
        else:
            folded = " ".join(("_" + part + "_").split())[1:-1]
            runs += _trimmed(folded, x, 0.0, size, False, bold)
            x += width(folded, size, False, bold)
    return tuple(runs)


def fitted(text: Words, size: float, width: float, bold: bool = False, least: float = SMALLEST) -> tuple[Run, ...]:
    """Words and symbols as large as they fit a width (mm), at most ``size`` and at least ``least``."""
    runs = rich(text, size, bold)
    wide = runs_width(runs)
    if wide <= width:
        return runs
    return rich(text, max(least, size * width / wide * 0.995), bold)


def cut_off(words: str, size: float, width: float, bold: bool = False) -> tuple[Run, ...]:
    """Words set as `fitted`; what is too long for a width (mm) even so ends in dots.

    >>> cut_off("a title", 3.0, 40.0)[0].text, cut_off("a long title", 3.0, 10.0)[0].text
    ('a title', 'a long title')
    >>> cut_off("a very long title", 3.0, 10.0)[0].text
    'a very lon…'
    """
    runs = fitted(words, size, width, bold)
    while runs_width(runs) > width and words:
        words = words.removesuffix("…")[:-1].rstrip() + "…" if words != "…" else ""
        runs = fitted(words, size, width, bold)
    return runs


@lru_cache(maxsize=2048)
def wrapped(text: Words, size: float, width: float, bold: bool = False) -> tuple[tuple[Run, ...], ...]:
    """Words and symbols set in lines of a width (mm), broken at spaces, between Chinese characters and after their
    commas."""
    pieces, ends = _pieces(text), _ends(text, size, bold)
    words = [piece for piece in pieces if isinstance(piece, str)]
    lines: list[tuple[Run, ...]] = []
    start = 0
    while start < len(pieces):

        def line(end: int, start: int = start) -> tuple[Run, ...]:
            if len(words) == len(pieces):
                return rich("".join(words[start:end]).strip(_SPACES), size, bold)
            return rich(RichText(*pieces[start:end]).stripped(_SPACES), size, bold)

        # as many pieces as fit, or the first; what is set decides, their lengths only tell where to begin
        end = max(bisect_right(ends, ends[start] + width) - 1, start + 1)
        runs = line(end)
        while end > start + 1 and runs_width(runs) > width:
            end -= 1
            runs = line(end)
        while end < len(pieces) and runs_width(longer := line(end + 1)) <= width:
            end, runs = end + 1, longer
        lines += [runs] if runs else []
        start = end
    return tuple(lines)


def stacked(lines: Sequence[Words], size: float = LETTER) -> tuple[Run, ...]:
    """Lines of words and symbols, below each other, as one text."""
    return tuple(
        run._replace(y=run.y + _LEADING * size * i) for i, line in enumerate(lines) for run in rich(line, size)
    )


def behind(first: tuple[Run, ...], second: tuple[Run, ...], gap: float = 0.0) -> tuple[Run, ...]:
    """Two texts one after the other as one, a gap (mm) between them."""
    by = runs_width(first) + gap
    return *first, *(run._replace(x=run.x + by) for run in second)


@lru_cache(maxsize=1024)
def _ends(text: Words, size: float, bold: bool) -> Sequence[float]:
    """The lengths (mm) of the first none, one, two ... of its pieces, each set for itself."""
    long = (
        width(piece, size, False, bold) if isinstance(piece, str) else runs_width(rich(piece, size, bold))
        for piece in _pieces(text)
    )
    return [*accumulate(long, initial=0.0)]


@lru_cache(maxsize=1024)
def _pieces(text: Words) -> Sequence[Words]:
    """Words with the space before them; symbols stay whole."""
    pieces: list[Words] = []
    piece, word, before = RichText(), "", ""
    for part in stretches(text):
        if not isinstance(part, str):
            if before in _BREAKS_AFTER:
                pieces.append(RichText(piece, word))
                piece, word = RichText(), ""
            piece, word, before = RichText(piece, word, *part), "", "symbol"
            continue
        inner = {i for match in _UNBROKEN.finditer(part) for i in range(match.start() + 1, match.end())}
        for i, character in enumerate(part):
            # no line begins with a mark that closes or ends with one that opens; after a comma of theirs it may break
            closes, opened = character in "，。；：、）》”", before in ("（", "《", "“")
            wide = ord(character) > 0x2E7F and not closes and not opened
            after = before in _BREAKS_AFTER and not closes
            if i not in inner and (character == " " or wide or after):
                pieces.append(RichText(piece, word) if piece else word)
                piece, word = RichText(), ""
            word += character
            before = character
    return [piece for piece in (*pieces, RichText(piece, word) if piece else word) if piece]


@lru_cache(maxsize=1024)
def _symbol(atoms: tuple[Atom, ...], size: float) -> tuple[tuple[Run, ...], float]:
    runs, advance = _set(atoms, 0.0, 0.0, size, 0, size)
    return tuple(runs), advance


def _set(atoms: tuple[Atom, ...], x: float, y: float, size: float, level: int, base: float) -> tuple[list[Run], float]:
    """Runs of atoms from a place on, and the place after them; ``base`` is the size of the letters at level 0."""
    runs: list[Run] = []
    stretch, begin, face = "", x, (False, False)

    def flush() -> None:
        nonlocal stretch
        if stretch:
            runs.extend(_trimmed(stretch, begin, y, size, *face))
            stretch = ""

    above: float | None = None  # where a prime stands over an index, at the letter that bears both
    for atom in atoms:
        if above is not None and atom.text == "′" and not (atom.sub or atom.sup):
            runs.extend(_trimmed("′", above, y, size, False, atom.bold))
            x = max(x, above + width("′", size))
            continue
        above = None
        character = "−" if atom.text == "-" and level == 0 else atom.text
        style = is_italic(character) and not atom.bold, atom.bold
        if stretch and (face != style or atom.arrow):
            flush()
        reach = x
        if atom.arrow:
            over, x, reach = _arrow_over(character, style, x, y, size)
            runs.append(over)
        if not stretch:
            begin, face = x, style
        stretch += character
        x = begin + width(stretch, size, *face)
        if atom.arrow and not atom.sub:
            x = max(x, reach)
        if atom.sub or atom.sup or atom.arrow:
            flush()
            above = None if atom.sup else x
            drop = _DROP_STACKED if atom.sup else _DROP
            x = max(
                _hang(runs, atom.sub, x + _GAP_SUB * size, y + drop * size, level, base),
                _hang(runs, atom.sup, max(x, reach) + _GAP_SUPER * size, y - _RISE * size, level, base), x,
            )
    flush()
    return runs, x


def _arrow_over(letter: str, face: tuple[bool, bool], x: float, y: float, size: float) -> tuple[Run, float, float]:
    """The arrow over a letter at a place, the place of the letter with it, and the end of the arrow."""
    base, sign = glyph(letter, style_of(*face)), glyph(_ARROW)
    left, low, right, _ = sign.box if sign else (0, 0, EM, 0)
    start, _, end, top = base.box if base else (0, 0, EM, EM)
    long = max(SMALLEST, _ARROW_SIZE * size) / EM
    begin = x + (start + end) / EM * size / 2 + _SLANT * size - (left + right) * long / 2
    shift = max(0.0, x - begin)
    height = y - (top / EM + _ARROW_GAP) * size + low * long
    return Run(_ARROW, begin + shift, height, EM * long), x + shift, begin + shift + right * long


def _hang(runs: list[Run], atoms: tuple[Atom, ...], x: float, y: float, level: int, base: float) -> float:
    if not atoms:
        return x
    hung, end = _set(atoms, x, y, max(SMALLEST, base * (INDEX if level == 0 else SMALLEST) / LETTER), level + 1, base)
    runs.extend(hung)
    return end


def is_italic(character: str) -> bool:
    """Whether a character of a symbol is set in italics."""
    return character.isalpha() and not is_cjk(character)


def _trimmed(text: str, x: float, y: float, size: float, italic: bool, bold: bool) -> list[Run]:
    """A run without outer spaces (SVG drops them), at the place of its first letter; none for spaces alone."""
    body = text.lstrip(" ")
    start = x + width(text[: len(text) - len(body)], size, italic, bold)
    body = body.rstrip(" ")
    return [Run(body, start, y, size, italic, bold)] if body else []


ASCENT, DESCENT = 0.70, 0.22  # of the size, at least; accents, roots and CJK reach further
CAP_HEIGHT = 0.66
UNKNOWN = 0.72  # of the size: the advance of a sign that no face at hand has


def is_cjk(character: str) -> bool:
    """Whether a character is of a Chinese font and one em wide (full-width marks count)."""
    return ord(character) > 0x2E7F and unicodedata.east_asian_width(character) in "WF"


@lru_cache(maxsize=4096)
def has_cjk(text: str) -> bool:
    return any(map(is_cjk, text))


@lru_cache(maxsize=8192)
def width(text: str, size: float, italic: bool = False, bold: bool = False) -> float:
    """Advance width (mm) of a text set at a size (mm)."""
    style = style_of(italic, bold)
    return added_up(_advance(character, style) for character in text) * size


@lru_cache(maxsize=8192)
def _advance(character: str, style: Style) -> float:
    """Advance width in sizes."""
    sign = glyph(character, style)
    if sign is not None:
        return sign.advance / EM
    return 1.0 if is_cjk(character) else 0.0 if unicodedata.combining(character) else UNKNOWN


def run_box(run: Run) -> Box:
    """The box of a run about its text's own point: from ascender to descender, from start to advance, with the overhang
    of slanted letters."""
    before, ascent, after, descent = _reach(run.text, style_of(run.italic, run.bold))
    return Box(
        run.x - before * run.size, run.y - ascent * run.size,
        run.x + width(run.text, run.size, run.italic, run.bold) + after * run.size, run.y + descent * run.size,
    )


@lru_cache(maxsize=4096)
def _reach(text: str, style: Style) -> tuple[float, float, float, float]:
    """The reach of ink beyond the start, above the baseline, beyond the advance and below the baseline, in sizes."""
    signs = [g for c in text if (g := glyph(c, style)) is not None]
    if not signs:
        return 0.0, ASCENT, 0.0, DESCENT
    first, last = signs[0], signs[-1]
    return (
        max(0, -first.box[0]) / EM, max(ASCENT, *(g.box[3] / EM for g in signs)),
        max(0, last.box[2] - last.advance) / EM, max(DESCENT, *(-g.box[1] / EM for g in signs)),
    )


@lru_cache(maxsize=8192)
def runs_width(runs: tuple[Run, ...]) -> float:
    """The distance from the text's own point to the farthest end of a run (mm)."""
    return max((run.x + width(run.text, run.size, run.italic, run.bold) for run in runs), default=0.0)


BEFORE = {"start": 0.0, "middle": 0.5, "end": 1.0}
"""The share of a text's width before its own point."""


def start_of(text: Text) -> complex:
    """The point of the page (mm) about which the runs of a text are set."""
    before = BEFORE[text.anchor]
    return text.at - before * runs_width(text.runs) if before else text.at


def start_runs(text: Text) -> tuple[Run, ...]:
    """The runs of a text on the page: x and y become page coordinates (mm) of the start of each baseline."""
    x, y = (start := start_of(text)).real, start.imag
    return tuple(Run(run.text, x + run.x, y + run.y, run.size, run.italic, run.bold) for run in text.runs)


def text_box(text: Text) -> Box:
    """Box of a text on the page (mm).  Raises ValueError for a text without runs."""
    return box_about(text.runs, text.anchor).moved(text.at)


@lru_cache(maxsize=4096)
def box_about(runs: tuple[Run, ...], anchor: str = "start") -> Box:
    """Box of the text of some runs about its own point (mm)."""
    boxes = [run_box(run) for run in start_runs(Text(0j, runs, anchor))]
    return Box(
        min(b.left for b in boxes), min(b.top for b in boxes), max(b.right for b in boxes), max(b.bottom for b in boxes)
    )
