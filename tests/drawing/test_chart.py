"""Charts: axes, curves cut at the panel, labels clear of the curves."""

from __future__ import annotations

import math

import pytest

from graphkin.drawing import Box, Line, Polyline, Text
from graphkin.drawing.chart import Axis, Chart, Curve, Marks, chart_group, degree_axis, linear_axis, log_axis, next_step
from graphkin.drawing.primitives import walk
from graphkin.drawing.text import text_box

PANEL = Box(20, 20, 120, 80)
UNIT = Axis(0.0, 1.0, ((0.0, "0"), (1.0, "1")))


def test_ticks_of_a_linear_axis_are_round_numbers() -> None:
    assert ["−100", "−50", "0", "50", "100"] == [words for _, words in linear_axis(-100, 100).ticks]


def test_ticks_of_quarters_have_their_digits() -> None:
    assert ["0", "0.25", "0.50", "0.75", "1.00"] == [w for _, w in linear_axis(0, 1, most=4, margin=0).ticks]


def test_a_turn_has_a_tick_every_thirty_degrees() -> None:
    assert list(range(0, 361, 30)) == [value for value, _ in degree_axis(0, 360).ticks]


def test_a_log_axis_has_powers_of_ten() -> None:
    assert [1e-3, 1e-2, 1e-1, 1.0] == pytest.approx([value for value, _ in log_axis(2e-3, 0.7).ticks])


def test_a_log_axis_puts_the_mean_power_in_the_middle() -> None:
    assert log_axis(1e-4, 1.0).share(1e-2) == pytest.approx(0.5)


@pytest.mark.parametrize(("least", "step"), [(0.2, 0.2), (0.21, 0.25), (0.3, 0.5), (60, 100)])
def test_steps_are_of_the_series(least: float, step: float) -> None:
    assert next_step(least) == pytest.approx(step)


def test_a_constant_has_an_axis() -> None:
    axis = linear_axis(5.0, 5.0)
    assert axis.low < 5.0 < axis.high


def test_an_axis_may_run_downwards() -> None:
    chart = Chart(PANEL, Axis(360.0, 0.0, ()), UNIT)
    assert chart.at(360.0, 0.0) == complex(20, 80)


def test_a_curve_is_cut_off_at_the_panel() -> None:
    group = chart_group(Chart(PANEL, UNIT, UNIT, (Curve([0, 0.5, 1], [0, 2, 0]),)))
    lines = [t for t in walk((group,)) if isinstance(t, Polyline)]
    assert len(lines) == 2
    assert all(PANEL.grown(1e-5).holds(Box.around(line.points)) for line in lines)


def test_a_curve_breaks_where_it_has_no_value() -> None:
    group = chart_group(Chart(PANEL, UNIT, UNIT, (Curve([0, 0.2, 0.4, 0.6, 1], [0, 0.5, math.nan, 0.5, 1]),)))
    assert len([t for t in walk((group,)) if isinstance(t, Polyline)]) == 2


def test_labels_are_clear_of_the_curve() -> None:
    x = [k / 50 for k in range(51)]
    y = [0.5 + 0.4 * math.sin(12 * v) for v in x]
    marks = Marks([x[6], x[20], x[33]], [y[6], y[20], y[33]], "up", ["0.900", "0.100", "0.899"])
    group = chart_group(Chart(PANEL, UNIT, UNIT, (Curve(x, y),), (marks,)))
    labels = [t for t in walk((group.children[-1],)) if isinstance(t, Text)]
    curve = next(t for t in walk((group,)) if isinstance(t, Polyline))
    assert len(labels) == 3
    assert not any(text_box(t).clip(a, b) for t in labels for a, b in zip(curve.points, curve.points[1:], strict=False))


def test_the_zero_line_is_heavier_than_the_grid() -> None:
    group = chart_group(Chart(PANEL, UNIT, linear_axis(-1, 1)))
    across = {t.stroke.width for t in walk((group,)) if isinstance(t, Line) and t.start.imag == t.end.imag}
    assert {0.1, 0.18} <= across
