"""Motion diagrams and coupler curves: what is drawn is what was measured and computed."""

from __future__ import annotations

import json
from functools import cache

import numpy as np
import pytest
from matplotlib.figure import Figure

from graphkin.construction.board.scales import next_of_series
from graphkin.drawing import Box, Drawing, Group, Line, Polyline, Text
from graphkin.drawing.chart import ChartPage
from graphkin.drawing.ink.primitives import walk
from graphkin.drawing.text import text_box
from graphkin.errors import Unsolvable
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.solver import driver_range
from graphkin.study.diagrams import coupler_points, diagrams, measured
from graphkin.study.quantities import course_of, link_quantities, slide_quantities
from graphkin.study.turn import TurnStudy, study_turn
from tests import scenes
from tests.drawing.chart_words import off_the_page, overlapping, word_boxes


@cache
def turn_of(name: str) -> TurnStudy:
    return study_turn(driver_range(mechanism_of(name)))


@cache
def pages(name: str, language: str = "en", positions: int = 12) -> dict[str, ChartPage | Drawing]:
    return diagrams(turn_of(name), language, positions)


def test_a_mechanism_that_no_pencil_can_draw_has_its_diagrams_and_no_coupler_curve(monkeypatch) -> None:
    def refuses(*given: object) -> None:
        raise Unsolvable("not drawn")

    monkeypatch.setattr("graphkin.study.diagrams.draft", refuses)
    assert ["motion-link-3", "motion-link-6"] == sorted(pages.__wrapped__("sixbar-coupler-1A", positions=0))


@pytest.mark.parametrize("name", ["sixbar-420rpm", "shaper-scheme-2"])
def test_values_measured_off_the_polygons_are_those_of_the_solver(name: str) -> None:
    reach = driver_range(mechanism_of(name))
    quantities = [o.quantity for o in study_turn(reach, everything=False).outputs]
    for quantity, rows in measured(reach, quantities, 4).items():
        motion = reach.motion(np.array([r[0] for r in rows]))
        of = link_quantities if quantity.kind == "theta" else slide_quantities
        for k, q in enumerate(of(quantity.pair)):
            assert [r[k + 1] for r in rows] == pytest.approx(course_of(q, reach, motion).tolist(), rel=1e-9, abs=1e-9)


def test_every_output_has_a_diagram_and_every_coupler_point_a_curve() -> None:
    assert ["curve-E", "motion-link-3", "motion-link-6"] == sorted(pages("sixbar-coupler-1A", positions=0))


def test_pins_of_cranks_and_sliders_are_no_coupler_points() -> None:
    assert coupler_points(mechanism_of("slider-crank-s50-e16-K1.2")) == ()


@pytest.mark.parametrize(
    ("name", "language"),
    [("sixbar-AE70", "en"), ("four-bar-coupler-point", "zh"), ("elliptic-trammel", "en"), ("swinging-block", "zh")],
)
def test_nothing_runs_off_the_page_of_a_coupler_curve(name: str, language: str) -> None:
    curves = [page for page in pages(name, language, positions=2).values() if isinstance(page, Drawing)]
    assert curves
    for page in curves:
        paper = Box(0, 0, page.width, page.height)
        for thing in walk(page.children):
            if isinstance(thing, Text):
                assert paper.holds(text_box(thing))
            elif isinstance(thing, Line):
                assert paper.holds(Box.around((thing.start, thing.end)))
            elif isinstance(thing, Polyline):
                assert paper.holds(Box.around(thing.points))


@pytest.mark.parametrize(
    ("name", "language"),
    [("sixbar-guide-40deg", "en"), ("sixbar-AE70", "zh"), ("hydraulic-cylinder", "en"), ("shaper-scheme-2", "zh")],
)
def test_no_two_words_of_a_motion_diagram_overlap_and_none_runs_off_the_page(name: str, language: str) -> None:
    charts = [page for page in pages(name, language, positions=2).values() if isinstance(page, ChartPage)]
    assert charts
    for page in charts:
        assert [] == overlapping(page)
        assert [] == off_the_page(page)


def lines(figure: Figure, panel: str) -> dict[str, np.ndarray]:
    """What a panel shows: the curve, the dots, in values of its axes."""
    axes = next(a for a in figure.axes if a.get_gid() == panel)
    curve = next(line for line in axes.lines if len(line.get_xdata()) > 100)
    dots = next(line for line in axes.lines if line.get_marker() == "o")
    return {"curve": np.array(curve.get_xydata()), "dots": np.array(dots.get_xydata())}


def test_twelve_measured_points_lie_on_each_curve() -> None:
    figure = pages("slider-crank-offset")["motion-slide-3-4"].figure()
    for panel in ("s_3-4", "v_3-4", "a_3-4"):
        shown = lines(figure, panel)
        curve, dots = shown["curve"], shown["dots"]
        assert len(dots) == 12
        near = np.interp(dots[:, 0], *curve[np.argsort(curve[:, 0])].T)
        assert np.abs(dots[:, 1] - near).max() < 2e-4 * np.ptp(curve[:, 1])


def test_the_curve_shows_the_values_of_the_solver() -> None:
    reach = driver_range(mechanism_of("shaper-scheme-2"))
    figure = pages("shaper-scheme-2", positions=0)["motion-slide-6-1"].figure()
    for quantity in slide_quantities("6/1"):
        curve = lines(figure, str(quantity).replace("/", "-"))["curve"]
        sense = np.sign(reach.driver.values[1])
        offsets = ((np.radians(curve[1:-1, 0]) - reach.start[0]) * sense) % (2 * np.pi)
        right = course_of(quantity, reach, reach.motion(offsets)) * 1e3
        assert right == pytest.approx(curve[1:-1, 1], rel=1e-7, abs=1e-6 * np.ptp(right))


def test_extremes_are_marked_where_they_are_and_say_how_much() -> None:
    turn = turn_of("shaper-scheme-2")
    page = pages("shaper-scheme-2", positions=0)["motion-slide-6-1"]
    axes = next(a for a in page.figure().axes if a.get_gid() == "v_6-1")
    found = next(t for t in turn.curves if str(t.quantity) == "v_6/1").extremes
    marked = {(line.get_marker(), *np.round(line.get_xydata()[0], 6)) for line in axes.lines
              if line.get_marker() in ("^", "v")}
    assert marked == {("^" if e.kind == "max" else "v", round(np.degrees(e.driver), 6), round(e.value * 1e3, 6))
                      for e in found}
    assert {f"{e.value * 1e3:.5g}".replace("-", "−") for e in found} <= {t.get_text() for t in axes.figure.texts}


def test_limit_positions_are_lines_through_all_panels() -> None:
    turn = study_turn(driver_range(mechanism_of("shaper-scheme-2")))
    output = next(o for o in turn.outputs if o.quantity.pair == "6/1")
    page = diagrams(turn, positions=0)["motion-slide-6-1"]
    right = sorted(np.degrees([output.lows[0].driver, output.highs[0].driver]))
    for axes in page.figure().axes:
        upright = sorted(line.get_xdata()[0] for line in axes.lines if len(set(line.get_xdata())) == 1
                         and len(line.get_xdata()) == 2)
        assert right == pytest.approx(upright)


def test_the_axis_of_a_driver_that_turns_backwards_runs_downwards() -> None:
    page = pages("shaper-scheme-2", positions=0)["motion-slide-6-1"]
    assert {(360.0, 0.0)} == {axes.get_xlim() for axes in page.figure().axes}


def test_of_a_limited_motion_the_whole_way_and_every_measured_rate_are_seen() -> None:
    for name in ("hydraulic-cylinder", "elliptic-trammel"):
        for page in (p for n, p in pages(name).items() if n.startswith("motion")):
            figure = page.figure()
            place, *rates = figure.axes
            way = lines(figure, place.get_gid())["curve"][1:-1, 1]  # at its very ends it is a dead point
            assert place.get_ylim()[0] < way.min() < way.max() < place.get_ylim()[1]
            for axes in rates:
                dots = lines(figure, axes.get_gid())["dots"][:, 1]
                assert len(dots) == 12
                assert all(axes.get_ylim()[0] < y < axes.get_ylim()[1] for y in dots)


def test_the_zero_line_is_heavier_than_the_grid() -> None:
    axes = pages("shaper-scheme-2", positions=0)["motion-slide-6-1"].figure().axes[1]
    zero = next(line for line in axes.lines if set(line.get_ydata()) == {0.0})
    assert zero.get_linewidth() > 1.5 * axes.get_ygridlines()[0].get_linewidth()


def test_the_coupler_curve_is_drawn_in_its_scale() -> None:
    page = pages("four-bar-coupler-point", positions=0)["curve-P"]
    reach = driver_range(mechanism_of("four-bar-coupler-point"))
    path = reach.motion(np.linspace(*reach.ends, 721)).position("P")
    scale = json.loads(json.dumps(page.metadata))["scales"]["length"]
    curve = next(g for g in walk(page.children) if isinstance(g, Group) and g.id == "curve-P")
    drawn = Box.around(next(t for t in curve.children if isinstance(t, Polyline)).points)
    assert np.ptp(path.real) * 1e3 / scale == pytest.approx(drawn.width, abs=1e-6)
    assert np.ptp(path.imag) * 1e3 / scale == pytest.approx(drawn.height, abs=1e-6)


@pytest.mark.parametrize("angle", ["33", "0"])
def test_a_change_point_at_the_end_of_the_axis_is_a_gap_in_the_curve_only(angle: str) -> None:
    scene = mechanism_of_text(scenes.PARALLELOGRAM.replace("angle = 60", f"angle = {angle}"), "p")
    figure = diagrams(study_turn(driver_range(scene)), positions=12)["motion-link-3"].figure()
    assert all(np.isfinite(lines(figure, panel)["dots"]).all() for panel in ("theta_3", "omega_3", "alpha_3"))


@pytest.mark.parametrize(("least", "step"), [(0.2, 0.2), (0.21, 0.25), (0.3, 0.5), (60, 100)])
def test_steps_are_of_the_series(least: float, step: float) -> None:
    assert next_of_series(least) == pytest.approx(step)


def test_a_constant_has_an_axis() -> None:
    page = pages("oldham-coupling", positions=2)["motion-link-3"]
    speed = next(axes for axes in page.figure().axes if axes.get_gid() == "omega_3")
    low, high = speed.get_ylim()
    assert all(low < y < high for line in speed.lines if len(line.get_xdata()) > 100 for y in line.get_ydata())


@pytest.mark.parametrize(("language", "title"), [("en", "Motion of link 4"), ("zh", "构件 4 的运动线图")])
def test_a_page_is_headed_by_its_title_the_scene_and_the_facts(language: str, title: str) -> None:
    page, scene = pages("shaper-scheme-2", language, 0)["motion-link-4"], turn_of("shaper-scheme-2").scene
    heads = [words for words, _ in word_boxes(page)][:3]
    assert [title, scene.question.title_in(language)] == heads[:2]
    assert f"{title}: {scene.question.title_in(language)}" == page.title
    assert "29.8012°" in heads[2]
    assert scene.name == page.metadata["scene"]


def test_the_same_scene_gives_the_same_pages() -> None:
    turn = turn_of("slotter-75-150")
    one, two = ({n: page._repr_svg_() for n, page in diagrams(turn, positions=2).items()} for _ in "ab")
    assert one == two
