"""The words of a chart where matplotlib's own renderer sets them."""

from __future__ import annotations

from graphkin.drawing import Box
from graphkin.drawing.chart import ChartPage, own_settings

SLACK = 0.2  # mm


_LAST: list[tuple[ChartPage, list[tuple[str, Box]]]] = []


def word_boxes(chart: ChartPage) -> list[tuple[str, Box]]:
    """Every visible word of a page with its box (mm of the page); a label of several runs is one."""
    if not any(known is chart for known, _ in _LAST):  # setting a page takes long, and it is asked several things
        _LAST[:] = [(chart, _word_boxes(chart))]
    return _LAST[0][1]


def _word_boxes(chart: ChartPage) -> list[tuple[str, Box]]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    with own_settings(**{"text.parse_math": True}):  # letters without hinting, as in the files
        figure = chart.figure(dpi=254.0)
        renderer = FigureCanvasAgg(figure).get_renderer()

        def box_of(text) -> Box:
            extent = text.get_window_extent(renderer)
            return Box(extent.x0 / 10, chart.height - extent.y1 / 10, extent.x1 / 10, chart.height - extent.y0 / 10)

        found: list[tuple[str, Box]] = []
        for run in figure.texts:
            box = box_of(run)
            if found and not run.get_gid() and _follows(found[-1][1], box):
                found[-1] = found[-1][0] + run.get_text(), found[-1][1].joined(box)
            else:
                found.append((run.get_text(), box))
        others = [text for legend in figure.legends for text in legend.get_texts()]
        others += [text for axes in figure.axes for axis in (axes.xaxis, axes.yaxis) for text in _of_axis(axis)]
        return found + [(text.get_text(), box_of(text)) for text in others if text.get_text() and text.get_visible()]


def overlapping(chart: ChartPage) -> list[tuple[str, str]]:
    """Pairs of words that share more than a hair's breadth."""
    boxes = word_boxes(chart)
    return [
        (a, b) for i, (a, one) in enumerate(boxes) for b, other in boxes[:i] if one.grown(-SLACK).overlaps(other)
    ]


def off_the_page(chart: ChartPage) -> list[str]:
    paper = Box(0, 0, chart.width, chart.height)
    return [words for words, box in word_boxes(chart) if not paper.holds(box)]


def curve_points(chart: ChartPage, panel: str) -> list[list[tuple[float, float]]]:
    """What each line of a panel goes through, in values of its axes."""
    axes = next(a for a in chart.figure().axes if a.get_gid() == panel)
    return [[(float(x), float(y)) for x, y in line.get_xydata()] for line in axes.lines]


def _follows(before: Box, box: Box) -> bool:
    """Whether a run goes on where another ended, on the same line or as its index."""
    return abs(box.left - before.right) < 1.5 and before.top - 1.0 < box.bottom and box.top < before.bottom + 1.0


def _of_axis(axis):
    """The numbers at the ticks that are drawn, and the power of ten they stand for."""
    low, high = sorted(axis.get_view_interval())
    slack = 1e-9 * (high - low)
    inside = [tick.label1 for tick in axis.get_major_ticks() if low - slack <= tick.get_loc() <= high + slack]
    return [*inside, axis.get_offset_text()]
