"""The ruler: lengths measured on the printed page, times the scale stated on it, are the exact values."""

from __future__ import annotations

import io
import re
import zlib
from functools import lru_cache

import numpy as np
import pytest

import graphkin
from graphkin.drawing.write.pdf import pdf_bytes, png_bytes

MM = 25.4 / 72  # of a point
STROKED = re.compile(r"([\d.]+) ([\d.]+) m\n([\d.]+) ([\d.]+) l\n\s*S\n")
FILLED = re.compile(r"([\d.]+) ([\d.]+) m\n([\d.]+) ([\d.]+) l\n([\d.]+) ([\d.]+) l\nh\n\s*f\n")
SCENES = ("sixbar-guide-40deg", "shaper-scheme-2", "hydraulic-cylinder")
READABLE = 0.1  # mm: what a ruler tells


@lru_cache(maxsize=8)
def printed(name: str):
    drawn = graphkin.draw(name)
    pdf = pdf_bytes(drawn.figures["sheet"])
    start = re.search(rb"stream\r?\n", pdf).end()  # the data say where they end: their last byte may be a line's end
    return drawn, zlib.decompressobj().decompress(pdf[start:]).decode("latin-1")


def vectors(content: str) -> np.ndarray:
    """Every line that an arrowhead ends, from its tail to the tip of the head, in mm, y up."""
    heads = [(m.start(), [float(n) for n in m.groups()]) for m in FILLED.finditer(content)]
    found = []
    for line in STROKED.finditer(content):
        x, y, *_ = (float(n) for n in line.groups())
        ahead = [corners for at, corners in heads if line.end() <= at < line.end() + 160]
        if ahead:
            found.append(complex(ahead[0][0] - x, ahead[0][1] - y) * MM)
    return np.array(found)


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("kind", ["velocity", "acceleration"])
def test_a_ruler_on_the_printed_sheet_reads_the_exact_values(name: str, kind: str) -> None:
    drawn, content = printed(name)
    sheet, measured = drawn.small.sheet, vectors(content)
    scale = sheet.scales.of(kind)
    exact = {row.symbol: complex(row.exact) / scale for row in drawn.small.report.rows if row.symbol.is_vector}
    spans = {s: exact[s] for s in sheet.vectors(kind) if s in exact and abs(exact[s]) > READABLE}
    assert spans
    off = {str(s): float(np.abs(measured - span).min()) for s, span in spans.items()}
    assert {} == {s: gap for s, gap in off.items() if gap > READABLE}


@pytest.mark.parametrize("name", SCENES)
def test_the_check_bar_is_fifty_millimetres_long_on_paper(name: str) -> None:
    spans = [[float(n) * MM for n in line.groups()] for line in STROKED.finditer(printed(name)[1])]
    level = [abs(x2 - x1) for x1, y1, x2, y2 in spans if y1 == y2]
    assert 50.0 == pytest.approx(min(level, key=lambda length: abs(length - 50.0)), abs=0.01)


@pytest.mark.parametrize(
    ("name", "paper"), [("shaper-scheme-2", (210.0, 297.0)), ("sixbar-guide-40deg", (297.0, 420.0))]
)
def test_a_sheet_is_printed_on_a4_or_on_the_a3_that_its_wished_scales_need(
    name: str, paper: tuple[float, float]
) -> None:
    from PIL import Image

    sheet = printed(name)[0].figures["sheet"]
    box = re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", pdf_bytes(sheet))
    assert paper == pytest.approx([float(side) * MM for side in box.groups()], abs=0.01)
    image = Image.open(io.BytesIO(png_bytes(sheet, dpi=300.0)))
    sides = [pixels / dpi * 25.4 for pixels, dpi in zip(image.size, image.info["dpi"], strict=True)]
    assert paper == pytest.approx(sides, abs=0.1)
