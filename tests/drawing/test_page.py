from __future__ import annotations

import io
import re
import shutil
import subprocess
import warnings
import zlib
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from graphkin.drawing.ink.primitives import Arc, Line, Text
from graphkin.drawing.ink.strokes import CONSTRUCTION, LINK
from graphkin.drawing.ink.symbols import vector_group
from graphkin.drawing.text import plain, rich
from graphkin.drawing.write.drawing import Drawing
from graphkin.drawing.write.pdf import MissingFont, own_settings, pdf_bytes, png_bytes

A4 = Drawing(210.0, 297.0, (vector_group("v_B", 1, 20 + 50j, 80 + 30j), Text(20 + 90j, rich("$v_{B_3}$ = 0"))), "Title")
CHINESE = Drawing(60.0, 30.0, (Text(5 + 15j, rich("速度 $v_B$")),), lang="zh")


def ink(drawing: Drawing, dpi: float = 254.0):
    """Rows and columns (0.1 mm) of the inked pixels."""
    from PIL import Image

    grey = np.asarray(Image.open(io.BytesIO(png_bytes(drawing, dpi))).convert("L"))
    return np.nonzero(grey < 128)


def content(pdf: bytes) -> str:
    """The strokes of the page, unpacked."""
    streams = re.findall(rb"stream\r?\n(.*?)\r?\nendstream", pdf, re.S)
    return zlib.decompress(streams[0]).decode("latin-1")


def test_the_pdf_page_is_a4():
    box = re.search(rb"/MediaBox \[ ?0 0 ([\d.]+) ([\d.]+) ?\]", pdf_bytes(A4))
    across, down = (float(n) / 72 * 25.4 for n in box.groups())
    assert (pytest.approx(210, abs=0.001), pytest.approx(297, abs=0.001)) == (across, down)


@pytest.mark.skipif(shutil.which("pdffonts") is None, reason="poppler is not installed")
def test_all_fonts_of_the_pdf_are_embedded(tmp_path):
    (tmp_path / "a.pdf").write_bytes(pdf_bytes(A4))
    listed = subprocess.run(["pdffonts", tmp_path / "a.pdf"], capture_output=True, text=True, check=True).stdout
    rows = listed.splitlines()[2:]
    assert rows
    assert all(re.search(r" yes yes (yes|no)  ", row) for row in rows)


def test_a_stroke_of_the_pdf_is_where_the_drawing_has_it():
    pdf = content(pdf_bytes(Drawing(100.0, 100.0, (Line(12.345 + 20j, 60 + 70j, LINK),))))
    move, line = (re.search(rf"([\d.]+) ([\d.]+) {op}\n", pdf).groups() for op in "ml")
    drawn = [float(n) / 72 * 25.4 for n in (*move, *line)]
    assert [pytest.approx(n, abs=1e-3) for n in (12.345, 80, 60, 30)] == drawn


def test_a_run_of_the_pdf_stands_where_the_drawing_has_it():
    pdf = content(pdf_bytes(Drawing(100.0, 100.0, (Text(12.3 + 40j, plain("B")),))))
    placed = re.search(r"1 0 -?0 1 ([\d.]+) ([\d.]+) cm\s+BT", pdf)
    x, y = (float(n) / 72 * 25.4 for n in placed.groups())
    assert (pytest.approx(12.3, abs=0.05), pytest.approx(60, abs=0.05)) == (x, y)


def test_the_pdf_has_no_date():
    assert b"Date" not in pdf_bytes(A4)


@pytest.mark.parametrize("write", [pdf_bytes, png_bytes])
@pytest.mark.parametrize("drawing", [A4, CHINESE], ids=["latin", "chinese"])
@pytest.mark.filterwarnings("ignore::graphkin.drawing.write.pdf.MissingFont")
def test_the_bytes_are_the_same_again(write, drawing):
    assert write(drawing) == write(drawing)


def test_the_png_has_as_many_pixels_as_the_page():
    from PIL import Image

    assert Image.open(io.BytesIO(png_bytes(A4, dpi=254.0))).size == (2100, 2970)


def test_the_png_says_its_resolution():
    from PIL import Image

    assert Image.open(io.BytesIO(png_bytes(A4, dpi=254.0))).info["dpi"] == pytest.approx((254, 254), abs=0.1)


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


def test_the_users_own_matplotlib_settings_do_not_show():
    import matplotlib

    before = png_bytes(A4)
    with matplotlib.rc_context({"text.usetex": True, "font.family": "monospace", "path.snap": True}):
        assert png_bytes(A4) == before


def test_eight_threads_get_the_bytes_of_one_alone():
    alone = [write(drawing) for write in (pdf_bytes, png_bytes) for drawing in (A4, CHINESE)]
    given = [(write, drawing) for write in (pdf_bytes, png_bytes) for drawing in (A4, CHINESE)] * 4
    with ThreadPoolExecutor(8) as pool:
        made = [pool.submit(*each) for each in given]
    assert alone * 4 == [one.result() for one in made]


def test_another_thread_keeps_the_users_settings_while_one_draws():
    import matplotlib

    def users() -> tuple[object, object]:
        with matplotlib.rc_context({"font.size": 7.0}):
            matplotlib.rcParams["lines.linewidth"] = 3.25
            return matplotlib.rcParams["text.hinting"], matplotlib.rcParams["font.size"]

    with matplotlib.rc_context({"text.hinting": "native"}), ThreadPoolExecutor(1) as pool:
        with own_settings():
            assert ("none", ("native", 7.0)) == (matplotlib.rcParams["text.hinting"], pool.submit(users).result())
        assert "native" == matplotlib.rcParams["text.hinting"]


def test_what_another_thread_changes_while_one_draws_is_kept():
    import matplotlib

    with matplotlib.rc_context(), ThreadPoolExecutor(1) as pool:
        with own_settings():
            pool.submit(matplotlib.rcParams.update, {"lines.linewidth": 3.25}).result()
        assert 3.25 == matplotlib.rcParams["lines.linewidth"]


def test_the_settings_are_of_their_own_kind_again():
    import matplotlib

    kind = type(matplotlib.rcParams)
    with own_settings(), own_settings(**{"pdf.fonttype": 42}):
        pass
    assert (matplotlib.RcParams, matplotlib.RcParams) == (kind, type(matplotlib.rcParams))


def test_a_missing_chinese_font_is_one_warning_and_no_failure(monkeypatch):
    monkeypatch.setattr("graphkin.drawing.write.pdf._chinese_face", lambda: None)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        pdf_bytes(Drawing(60.0, 30.0, (Text(5 + 15j, rich("鑫")),), lang="zh"))
    assert [MissingFont] == [warning.category for warning in caught]


def test_a_latin_figure_looks_for_no_chinese_font(monkeypatch):
    monkeypatch.setattr("graphkin.drawing.write.pdf._chinese_face", lambda: pytest.fail("looked for one"))
    assert png_bytes(A4).startswith(b"\x89PNG")
