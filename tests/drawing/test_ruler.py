"""The ruler: lengths measured on the printed page, times the scale stated on it, are the exact values."""

from __future__ import annotations

import io
from functools import lru_cache
from itertools import pairwise

import numpy as np
import pytest

import graphkin
from tests.drawing.pdf_page import painted, size

SCENES = ("sixbar-guide-40deg", "shaper-scheme-2", "hydraulic-cylinder")
READABLE = 0.1  # mm: what a ruler tells


@lru_cache(maxsize=8)
def printed(name: str):
    drawn = graphkin.draw(name)
    return drawn, painted(drawn.figures["sheet"].content("pdf"))


def vectors(paths: list[tuple[str, list[complex]]]) -> np.ndarray:
    """Every line that an arrowhead follows, from its tail to the tip of the head, in mm, y up."""
    return np.array([
        head[0] - line[0] for (stroked, line), (filled, head) in pairwise(paths)
        if (stroked, len(line), filled, len(head)) == ("S", 2, "f", 3)
    ])


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("kind", ["velocity", "acceleration"])
def test_a_ruler_on_the_printed_sheet_reads_the_exact_values(name: str, kind: str) -> None:
    drawn, paths = printed(name)
    sheet, measured = drawn.small.sheet, vectors(paths)
    scale = sheet.scales.of(kind)
    exact = {row.symbol: complex(row.exact) / scale for row in drawn.small.report.rows if row.symbol.is_vector}
    spans = {s: exact[s] for s in sheet.vectors[kind] if s in exact and abs(exact[s]) > READABLE}
    assert spans
    off = {str(s): float(np.abs(measured - span).min()) for s, span in spans.items()}
    assert {} == {s: gap for s, gap in off.items() if gap > READABLE}


@pytest.mark.parametrize("name", SCENES)
def test_the_check_bar_is_fifty_millimetres_long_on_paper(name: str) -> None:
    lines = [line for kind, line in printed(name)[1] if kind == "S" and len(line) == 2]
    level = [abs(end - start) for start, end in lines if start.imag == end.imag]
    assert 50.0 == pytest.approx(min(level, key=lambda length: abs(length - 50.0)), abs=0.01)


@pytest.mark.parametrize(
    ("name", "paper"), [("shaper-scheme-2", (210.0, 297.0)), ("sixbar-guide-40deg", (297.0, 420.0))]
)
def test_a_sheet_is_printed_on_a4_or_on_the_a3_that_its_wished_scales_need(
    name: str, paper: tuple[float, float]
) -> None:
    from PIL import Image

    sheet = printed(name)[0].figures["sheet"]
    assert paper == pytest.approx(size(sheet.content("pdf")), abs=0.01)
    image = Image.open(io.BytesIO(sheet.content("png", dpi=300.0)))
    sides = [pixels / dpi * 25.4 for pixels, dpi in zip(image.size, image.info["dpi"], strict=True)]
    assert paper == pytest.approx(sides, abs=0.1)
