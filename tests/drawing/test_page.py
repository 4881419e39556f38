from __future__ import annotations

import io
import re
import shutil
import subprocess
import warnings
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from pypdf import PdfReader

from graphkin.drawing.font import FAMILY
from graphkin.drawing.ink.primitives import Arc, Line, Text
from graphkin.drawing.ink.strokes import CONSTRUCTION, LINK
from graphkin.drawing.ink.symbols import vector_group
from graphkin.drawing.text import plain, rich
from graphkin.drawing.write.drawing import Drawing
from graphkin.drawing.write.pdf import SIGNS, MissingFont, faces
from tests.drawing.pdf_page import painted, size
from tests.notation import noted

NAME = Text(20 + 90j, rich(noted("$v_{B_3}$ = 0")))
A4 = Drawing(210.0, 297.0, (vector_group("v_B", 1, 20 + 50j, 80 + 30j), NAME), "Title")
CHINESE = Drawing(60.0, 30.0, (Text(5 + 15j, rich(noted("速度 $v_B$"))),), lang="zh")


def ink(drawing: Drawing, dpi: float = 254.0):
    """Rows and columns (0.1 mm) of the inked pixels."""
    from PIL import Image

    grey = np.asarray(Image.open(io.BytesIO(drawing.content("png", dpi))).convert("L"))
    return np.nonzero(grey < 128)


def test_the_pdf_page_is_a4():
    assert (210, 297) == pytest.approx(size(A4.content("pdf")), abs=0.001)


@pytest.mark.skipif(shutil.which("pdffonts") is None, reason="poppler is not installed")
def test_all_fonts_of_the_pdf_are_embedded(tmp_path):
    (tmp_path / "a.pdf").write_bytes(A4.content("pdf"))
    listed = subprocess.run(["pdffonts", tmp_path / "a.pdf"], capture_output=True, text=True, check=True).stdout
    rows = listed.splitlines()[2:]
    assert rows
    assert all(re.search(r" yes yes (yes|no)  ", row) for row in rows)


def test_a_stroke_of_the_pdf_is_where_the_drawing_has_it():
    pdf = Drawing(100.0, 100.0, (Line(12.345 + 20j, 60 + 70j, LINK),)).content("pdf")
    assert [("S", pytest.approx([12.345 + 80j, 60 + 30j], abs=1e-3))] == painted(pdf)


def test_a_run_of_the_pdf_stands_where_the_drawing_has_it():
    pdf = Drawing(100.0, 100.0, (Text(12.3 + 40j, plain("B")),)).content("pdf")
    assert [("Tj", [pytest.approx(12.3 + 60j, abs=0.05)])] == painted(pdf)


def test_the_pdf_has_no_date():
    written = A4.content("pdf")
    assert (False, False) == (b"CreationDate" in written, b"ModDate" in written)


@pytest.mark.parametrize("format", ["pdf", "png"])
@pytest.mark.parametrize("drawing", [A4, CHINESE], ids=["latin", "chinese"])
@pytest.mark.filterwarnings("ignore::graphkin.drawing.write.pdf.MissingFont")
def test_the_bytes_are_the_same_again(format, drawing):
    assert drawing.content(format) == drawing.content(format)


def test_the_png_has_as_many_pixels_as_the_page():
    from PIL import Image

    assert Image.open(io.BytesIO(A4.content("png", dpi=254.0))).size == (2100, 2970)


def test_the_png_says_its_resolution():
    from PIL import Image

    assert Image.open(io.BytesIO(A4.content("png", dpi=254.0))).info["dpi"] == pytest.approx((254, 254), abs=0.1)


def test_a_line_of_the_png_is_where_the_drawing_has_it():
    rows, columns = ink(Drawing(50.0, 40.0, (Line(10 + 20j, 30 + 20j, LINK),)))
    assert [
        pytest.approx(columns.min(), abs=1),
        pytest.approx(columns.max() + 1, abs=1),
        pytest.approx(rows.mean() + 0.5, abs=1),
    ] == [100, 300, 200]


def test_a_page_of_odd_size_does_not_shift_its_lines():
    rows, _ = ink(Drawing(50.03, 40.07, (Line(10 + 20j, 30 + 20j, LINK),)))
    assert rows.mean() + 0.5 == pytest.approx(200, abs=1)


def test_counter_clockwise_is_counter_clockwise_on_the_page():
    rows, columns = ink(Drawing(40.0, 40.0, (Arc(20 + 20j, 10.0, 0.0, 1.5, CONSTRUCTION),)))
    assert rows.max() <= 201
    assert columns.min() >= 199


def test_eight_threads_get_the_bytes_of_one_alone():
    given = [(drawing, format) for format in ("pdf", "png") for drawing in (A4, CHINESE)]
    alone = [drawing.content(format) for drawing, format in given]
    with ThreadPoolExecutor(8) as pool:
        made = [pool.submit(drawing.content, format) for drawing, format in given * 4]
    assert alone * 4 == [one.result() for one in made]


def test_a_missing_chinese_font_is_one_warning_and_no_failure(monkeypatch):
    monkeypatch.setattr("graphkin.drawing.write.pdf.CHINESE", ())
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        warnings.simplefilter("ignore", ResourceWarning)  # of what other tests left open
        Drawing(60.0, 30.0, (Text(5 + 15j, rich("鑫")),), lang="zh").content("pdf")
    assert [MissingFont] == [warning.category for warning in caught]


def test_a_figure_in_the_family_alone_looks_for_no_other_fonts():
    names, _ = faces(more=False)
    assert set(names) <= {FAMILY, *SIGNS}


def test_a_pdf_has_a_page_for_each_page_of_a_drawing():
    further = Drawing(60.0, 30.0, ())
    pages = PdfReader(io.BytesIO(replace(A4, further=(further,)).content("pdf"))).pages
    assert [(595, 842), (170, 85)] == [(round(page.mediabox.width), round(page.mediabox.height)) for page in pages]


def test_a_pdf_describes_its_figure_to_those_who_do_not_see_it():
    (words,) = re.findall(rb"/Alt\s*\(([^)]*)\)", replace(A4, desc="v of B").content("pdf"))
    assert b"v of B" == words
