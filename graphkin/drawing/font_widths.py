"""How wide a text is, without a font file: the advance widths of a Times-like face, and boxes of texts.

The widths are the larger of STIX General's and Times', in hundredths of the size, so that a box holds its text in
either; for the signs of arithmetic, whose width differs most, they are the mean, so that the gaps look even in both.
"""

from __future__ import annotations

import unicodedata
from functools import lru_cache

from graphkin.drawing.box import Box
from graphkin.drawing.primitives import Run, Text

__all__ = ["CAP_HEIGHT", "has_cjk", "is_cjk", "run_box", "runs_width", "start_runs", "text_box", "width"]

ASCENT, DESCENT = 0.70, 0.22  # of the size; accents and CJK reach further
CJK_ASCENT = 0.86
CAP_HEIGHT = 0.66
_TALL = {"∥": 0.83, "√": 0.83}  # signs that reach higher
_ROMAN = {
    18: "'", 20: "|", 25: " ,.·", 28: "/:;\\ijltιîï", 29: "′", 33: "!()-I[]`fr‘’", 39: "Js", 40: "°", 41: '"', 43: "″",
    44: "?acezεζàâäéèêëçå“”", 45: "ξ", 46: "ν", 47: "^γ", 48: "{}τ",
    50: "#$*0123456789_bdghknopquvxyπθδλρκχ–ôöùûüßñø§", 51: "β", 52: "ηυ‖•", 54: "~αμ", 55: "σ", 56: "FPS÷", 58: "µ",
    59: "Γ", 61: "ELTZ", 62: "φΣ", 60: "∥×", 63: "+<=>−", 66: "ω", 67: "BCRæ", 68: "≈≤≥±∠≠", 69: "ψ",
    72: "ADGHKNOQUVXYwΔΠΘΛ", 74: "Ω", 75: "Ψ½", 76: "Φ", 78: "&m", 83: "%", 86: "⊥", 89: "M", 91: "∑", 92: "@",
    93: "√∞", 94: "W", 100: "→←…—",
}  # fmt: skip
_ITALIC = {
    21: "'", 25: " ,.·", 28: "/\\fijlt|ιîï", 33: "!()-:;I`‘’", 39: "[]rsz", 40: "{}°", 41: "τγ", 42: '"^″',
    44: "Jcekvxyεéèêëç", 45: "ξζ", 46: "δλχ", 47: "ν", 48: "κυ", 49: "θ",
    50: "#$*0123456789?S_abdghnopquπρση–àâäôöùûüßñåø§", 51: "β", 52: "•", 53: "μ", 54: "~", 55: "α",
    56: "LTYZ“”", 58: "µ", 61: "ABEFPRVXΔΛΓ", 62: "φψΣ", 67: "CKNwæ", 68: "±÷", 70: "Ψ", 71: "ω∞∑",
    72: "DGHOQUmΠΘ", 75: "½", 76: "ΩΦ", 78: "&", 83: "%MW", 89: "…—", 92: "@", 100: "→←",
}  # fmt: skip
_BOLD = {
    22: "|", 25: " ,.·", 28: "'/\\ilîï", 31: "′", 33: "!()-:;[]`fjtι‘’", 39: "Is{}", 40: "°", 44: "cerzεéèêëç",
    46: "ζ", 47: "ξ", 49: "τ", 50: "#$*0123456789?J_agovxy–àâäôöåø§“”", 52: "~θγδν", 55: "λρ″",
    56: '"Sbdhknpquβùûüßñ•', 57: "σ÷", 58: "^ηκυµ", 61: "FPμχ", 63: "π", 64: "αΓ", 65: "φ", 67: "BELTZΣ",
    72: "ACDNRUVXYwΔΛæ", 73: "ω", 75: "≈≤≥½≠", 76: "ψ", 77: "±", 78: "GHKOQΠΘ", 79: "∠", 80: "Ω", 81: "Ψ",
    83: "&m", 84: "Φ", 91: "∑", 93: "@", 94: "M", 96: "√∞", 100: "%W→←…—",
}  # fmt: skip
# How far the ink of some letters reaches beyond their advance, to the left and to the right, in hundredths of the size.
_OVER_LEFT = {15: "f", 12: "j", 8: "y", 7: "p/", 6: "A", 5: ")", 3: "xμX"}
_OVER_RIGHT = {
    15: "f", 11: "/", 10: "V", 9: "Y", 8: "TW", 6: "KN", 5: "HIJMUZ(", 4: "X7[", 3: "dEFτπ'",
}  # fmt: skip


def _by_character(table: dict[int, str]) -> dict[str, float]:
    return {character: hundredths / 100 for hundredths, held in table.items() for character in held}


_WIDTHS = (_by_character(_ROMAN), _by_character(_ITALIC), _by_character(_BOLD))
_LEFT, _RIGHT = _by_character(_OVER_LEFT), _by_character(_OVER_RIGHT)


def is_cjk(character: str) -> bool:
    """Whether a character is of a Chinese font and one em wide (full-width marks count)."""
    return ord(character) > 0x2E7F and unicodedata.east_asian_width(character) in "WF"


@lru_cache(maxsize=4096)
def has_cjk(text: str) -> bool:
    return any(map(is_cjk, text))


@lru_cache(maxsize=4096)
def width(text: str, size: float, italic: bool = False, bold: bool = False) -> float:
    """Advance width (mm) of a text set at a size (mm)."""
    widths = _WIDTHS[2 if bold else 1 if italic else 0]
    roman = _WIDTHS[0]
    total = 0.0
    for character in text:
        if character in widths:
            total += widths[character]
        elif character in roman:
            total += roman[character]
        elif is_cjk(character):
            total += 1.0
        elif not unicodedata.combining(character):
            total += 0.72
    return total * size


def run_box(run: Run) -> Box:
    """Box of one run about its text's own point: from ascender to descender, from start to advance, and further where
    slanted letters reach further."""
    before, ascent, after = _reach(run.text, run.italic)
    return Box(
        run.x - before * run.size,
        run.y - ascent * run.size,
        run.x + width(run.text, run.size, run.italic, run.bold) + after * run.size,
        run.y + DESCENT * run.size,
    )


@lru_cache(maxsize=4096)
def _reach(text: str, italic: bool) -> tuple[float, float, float]:
    """How far ink reaches beyond the start, above the baseline and beyond the advance, in sizes."""
    ascent = max((CJK_ASCENT if has_cjk(text) else ASCENT, *(_TALL[sign] for sign in _TALL if sign in text)))
    return (_LEFT.get(text[:1], 0.0), ascent, _RIGHT.get(text[-1:], 0.0)) if italic else (0.0, ascent, 0.0)


def runs_width(runs: tuple[Run, ...]) -> float:
    """From the text's own point to the end of the run that reaches furthest (mm)."""
    if len(runs) == 1:
        return runs[0].x + width(runs[0].text, runs[0].size, runs[0].italic, runs[0].bold)
    return max((run.x + width(run.text, run.size, run.italic, run.bold) for run in runs), default=0.0)


def start_runs(text: Text) -> tuple[Run, ...]:
    """The runs of a text on the page: x and y become page coordinates (mm) of the start of each baseline."""
    share = {"start": 0.0, "middle": 0.5, "end": 1.0}[text.anchor]
    shift = share * runs_width(text.runs)
    x, y = text.at.real - shift, text.at.imag
    return tuple(Run(run.text, x + run.x, y + run.y, run.size, run.italic, run.bold) for run in text.runs)


def text_box(text: Text) -> Box:
    """Box of a text on the page (mm).  Raises ValueError for a text without runs."""
    boxes = [run_box(run) for run in start_runs(text)]
    if len(boxes) == 1:
        return boxes[0]
    return Box(
        min(b.left for b in boxes),
        min(b.top for b in boxes),
        max(b.right for b in boxes),
        max(b.bottom for b in boxes),
    )
