"""Charts: axes, curves cut at the panel, labels clear of the curves, files that are the same wherever they are made."""

from __future__ import annotations

import io
import math
import re
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import numpy as np
import pytest

from graphkin.drawing import Box
from graphkin.drawing.chart import (
    SOLID_AND_DASHED,
    ChartPage,
    add_labels,
    add_legend,
    add_panel,
    add_words,
    count_powers,
    count_steps,
    degree_step,
    look,
    marker,
    own_settings,
)
from graphkin.drawing.font import FALLBACK
from graphkin.drawing.ink.primitives import Line, Text
from graphkin.drawing.text import rich, width
from graphkin.drawing.write.pdf import MissingFont
from graphkin.errors import CallError
from tests.drawing.chart_words import overlapping, word_boxes
from tests.notation import noted

PANEL = Box(20, 20, 120, 80)
X = np.linspace(0.0, 1.0, 51)
WAVE = 0.5 + 0.4 * np.sin(12 * X)


def chart(paint, **more) -> ChartPage:
    """A page with one panel, which is painted by a function of its axes."""
    titles = noted("$y$ (mm)"), noted("$x$ (°)")
    return ChartPage(140.0, 100.0, lambda figure: paint(add_panel(figure, PANEL, "p", *titles)), **more)


def axes(paint):
    return chart(paint).figure().axes[0]


def numbers(axis) -> list[str]:
    low, high = axis.get_view_interval()
    axis.figure.draw_without_rendering()
    slack = 1e-9 * (high - low)
    return [t.label1.get_text() for t in axis.get_major_ticks() if low - slack <= t.get_loc() <= high + slack]


def linear(low: float, high: float, step: float | None = None, most: int = 6) -> list[str]:
    def paint(panel) -> None:
        panel.set_ylim(low, high)
        count_steps(panel.yaxis, step, most)

    return numbers(axes(paint).yaxis)


def wave(panel) -> None:
    panel.set(xlim=(0, 1), ylim=(-0.1, 1))
    panel.plot(X, WAVE, **look(SOLID_AND_DASHED[0]))
    peaks = [(X[k], WAVE[k]) for k in (6, 20, 33)]
    panel.plot(*zip(*peaks, strict=True), **marker("up"))
    add_labels(panel, [("0.900", peaks[0]), ("0.100", peaks[1]), (noted("速度 $v_B$"), peaks[2])])


WAVES = chart(wave, title="A wave", desc="up & down", lang="zh", metadata={"output": "6/1"})


def pixels(page: ChartPage, dpi: float = 254.0) -> np.ndarray:
    from PIL import Image

    return np.asarray(Image.open(io.BytesIO(page.content("png", dpi))).convert("L"))


def test_ticks_of_a_linear_axis_are_round_numbers() -> None:
    assert ["−100", "−50", "0", "50", "100"] == linear(-116, 116)


def test_ticks_of_quarters_have_their_digits() -> None:
    assert ["0.00", "0.25", "0.50", "0.75", "1.00"] == linear(0, 1, most=4)


def test_large_numbers_have_one_power_of_ten_for_all() -> None:
    def paint(panel) -> None:
        panel.set_ylim(0, 4e7)
        count_steps(panel.yaxis)

    assert r"$\times\mathdefault{10^{7}}$" in [words for words, _ in word_boxes(chart(paint))]


def test_a_turn_has_a_tick_every_thirty_degrees() -> None:
    assert [str(k) for k in range(0, 361, 30)] == linear(0, 360, degree_step(360))


def scale(low: float, high: float):
    return axes(lambda panel: count_powers(panel, "y", low, high))


def test_a_log_axis_has_powers_of_ten() -> None:
    assert [1e-3, 1e-2, 1e-1, 1.0] == pytest.approx(list(scale(2e-3, 0.7).get_yticks()))


def test_a_log_axis_puts_the_mean_power_in_the_middle() -> None:
    panel = scale(1e-4, 1.0)
    assert 0.5 == pytest.approx(panel.transAxes.inverted().transform(panel.transData.transform((0.5, 1e-2)))[1])


def test_the_panel_stands_where_its_box_is() -> None:
    share = axes(wave).get_position()
    assert (20, 120, 20, 80) == pytest.approx((share.x0 * 140, share.x1 * 140, 100 - share.y1 * 100,
                                               100 - share.y0 * 100))


def test_a_curve_is_cut_off_at_the_panel() -> None:
    def paint(panel) -> None:
        panel.set(xlim=(0, 1), ylim=(0, 1))
        panel.plot([0, 0.5, 1], [0, 2, 0], **look(SOLID_AND_DASHED[0]))

    above = pixels(ChartPage(140.0, 100.0, lambda figure: paint(add_panel(figure, PANEL, "p"))))[: 200 - 3, 250:]
    assert above.min() == 255


def test_a_curve_breaks_where_it_has_no_value() -> None:
    def paint(panel) -> None:
        panel.set(xlim=(0, 1), ylim=(0, 1))
        panel.plot([0, 0.2, 0.4, 0.6, 1], [0, 0.5, math.nan, 0.5, 1], **look(SOLID_AND_DASHED[0]))

    gap = pixels(chart(paint))[210:780, 410:790]  # between 0.2 and 0.6
    assert gap.min() > 128  # nothing but the grid


def test_labels_are_clear_of_the_curve_and_of_each_other() -> None:
    labels = [box for words, box in word_boxes(WAVES) if words in ("0.900", "0.100") or "速度" in words]
    curve = [complex(20 + 100 * x, 80 - 60 * (y + 0.1) / 1.1) for x, y in zip(X, WAVE, strict=True)]
    assert len(labels) == 3
    assert not any(box.clip(a, b) for box in labels for a, b in pairwise(curve))
    assert [] == overlapping(WAVES)


def test_a_legend_has_a_line_or_a_marker_for_each_of_its_words() -> None:
    entries = [(look(SOLID_AND_DASHED[1]), "计算值"), (marker("circle"), "measured")]
    legend = ChartPage(140.0, 100.0, lambda figure: add_legend(figure, 20 + 10j, entries)).figure().legends[0]
    assert ["计算值", "measured"] == [text.get_text() for text in legend.get_texts()]
    assert ["None", "o"] == [str(line.get_marker()) for line in legend.get_lines()]


@pytest.mark.parametrize("format", ["svg", "pdf", "png"])
def test_the_bytes_are_the_same_again(format: str) -> None:
    assert WAVES.content(format) == WAVES.content(format)


def test_threads_give_the_same_bytes_and_leave_the_users_settings_alone() -> None:
    import matplotlib

    with matplotlib.rc_context({"font.family": ["monospace"], "lines.linewidth": 7.0, "svg.fonttype": "path"}):
        before = dict(matplotlib.rcParams)
        with ThreadPoolExecutor(6) as threads:
            made = list(threads.map(WAVES.content, ["svg", "png", "pdf"] * 4))
        assert before == dict(matplotlib.rcParams)
    assert 3 == len(set(made))
    assert made[0] == WAVES.content("svg")


def test_another_thread_keeps_the_users_settings_while_one_draws() -> None:
    import matplotlib

    def users() -> tuple[object, object]:
        with matplotlib.rc_context({"font.size": 7.0}):
            matplotlib.rcParams["lines.linewidth"] = 3.25
            return matplotlib.rcParams["text.hinting"], matplotlib.rcParams["font.size"]

    with matplotlib.rc_context({"text.hinting": "native"}), ThreadPoolExecutor(1) as pool:
        with own_settings():
            assert ("none", ("native", 7.0)) == (matplotlib.rcParams["text.hinting"], pool.submit(users).result())
        assert "native" == matplotlib.rcParams["text.hinting"]


def test_what_another_thread_changes_while_one_draws_is_kept() -> None:
    import matplotlib

    with matplotlib.rc_context(), ThreadPoolExecutor(1) as pool:
        with own_settings():
            pool.submit(matplotlib.rcParams.update, {"lines.linewidth": 3.25}).result()
        assert 3.25 == matplotlib.rcParams["lines.linewidth"]


def test_the_settings_are_of_their_own_kind_again() -> None:
    import matplotlib

    kind = type(matplotlib.rcParams)
    with own_settings(), own_settings(**{"svg.fonttype": "path"}):
        pass
    assert (matplotlib.RcParams, matplotlib.RcParams) == (kind, type(matplotlib.rcParams))


def test_the_users_own_matplotlib_settings_do_not_show() -> None:
    import matplotlib

    before = WAVES.content("png")
    with matplotlib.rc_context({"text.usetex": True, "font.family": "monospace", "path.snap": True}):
        assert before == WAVES.content("png")


def test_the_svg_holds_text_in_the_faces_of_all_figures() -> None:
    svg = WAVES.content("svg").decode()
    assert ">速度</text>" in svg
    assert f', {FALLBACK}"' in svg
    assert re.findall("font-family:'([^']*)'", svg)[0] in svg.split("<style>")[0]
    assert "font-family:" not in re.sub("@font-face{[^}]*}", "", svg)


def test_the_svg_is_true_to_size_and_has_no_date() -> None:
    svg = WAVES.content("svg").decode()
    width, height = (float(re.search(rf'{side}="([\d.]+)pt"', svg)[1]) / 72 * 25.4 for side in ("width", "height"))
    assert (140, 100) == pytest.approx((width, height), abs=1e-3)
    assert "date>" not in svg


def test_the_svg_says_title_words_and_language() -> None:
    svg = WAVES.content("svg").decode()
    assert 'role="img" lang="zh" xml:lang="zh"' in svg
    assert "<title>A wave</title>" in svg
    assert "<desc>up &amp; down</desc>" in svg
    assert '<metadata>{"output":"6/1"}</metadata>' in svg.replace("&quot;", '"')


def test_the_svg_is_well_formed() -> None:
    from xml.etree import ElementTree

    assert ElementTree.fromstring(WAVES.content("svg")).tag.endswith("svg")


def test_the_ending_of_the_name_chooses_the_format(tmp_path) -> None:
    heads = {"svg": b"<?xml", "pdf": b"%PDF", "png": b"\x89PNG"}
    assert all(WAVES.save(tmp_path / f"a.{end}").read_bytes().startswith(head) for end, head in heads.items())


def test_an_unknown_format_is_named() -> None:
    with pytest.raises(CallError, match="gif"):
        WAVES.content("gif")


def test_the_png_has_as_many_pixels_as_the_page() -> None:
    assert (1000, 1400) == pixels(WAVES).shape


def test_a_missing_chinese_font_is_a_warning_and_no_failure(monkeypatch) -> None:
    monkeypatch.setattr("graphkin.drawing.write.pdf.CHINESE", ())
    with pytest.warns(MissingFont):
        assert chart(wave, title="鑫", lang="zh").content("png")


def test_dollar_signs_of_words_are_words() -> None:
    page = ChartPage(140.0, 100.0, lambda figure: add_words(figure, Text(20 + 20j, rich("5 $ and $"))))
    assert "5 $ and $" in page.content("svg").decode()


def test_a_stroke_beside_words_is_where_the_page_has_it() -> None:
    page = ChartPage(140.0, 100.0, lambda figure: add_words(figure, Line(10 + 20j, 30 + 20j, SOLID_AND_DASHED[0])))
    rows, columns = np.nonzero(pixels(page) < 128)
    assert (100, 300, 200) == pytest.approx((columns.min(), columns.max() + 1, rows.mean() + 0.5), abs=1)


def test_every_text_of_a_chart_states_the_length_that_its_glyphs_have():
    page = chart(lambda a: a.text(0.5, 0.5, "Newton never meets", fontsize=10, fontweight="bold"))
    text = page.content("svg").decode()
    spans = re.findall(r'<text style="([^"]*)"[^>]*? textLength="([\d.]+)">([^<]*)</text>', text)
    assert len(re.findall("<text ", text)) == len(spans) > 5
    for style, long, words in spans:
        size = float(re.search(r"font-size: ([\d.]+)px", style)[1])
        expected = width(words, size, "italic" in style, "font-weight" in style)
        assert expected == pytest.approx(float(long), abs=1e-3), words
