"""Motion diagrams and coupler curves: what is drawn is what was measured and computed."""

from __future__ import annotations

import json

import numpy as np
import pytest

from graphkin.drawing import Box, Circle, Drawing, Group, Line, Polyline, Text
from graphkin.drawing.primitives import walk
from graphkin.drawing.text import text_box
from graphkin.scene import read, read_text
from graphkin.study import course_of, diagrams, study_turn
from graphkin.study.coupler import coupler_points
from graphkin.study.measured import measured
from graphkin.study.quantities import link_quantities, slide_quantities
from tests import scenes


def pages(name: str, language: str = "en", positions: int = 12) -> dict[str, Drawing]:
    return diagrams(study_turn(course_of(read(name))), language, positions)


@pytest.mark.parametrize("name", ["sixbar-420rpm", "shaper-scheme-2"])
def test_values_measured_off_the_polygons_are_those_of_the_solver(name: str) -> None:
    course = course_of(read(name))
    quantities = [o.quantity for o in study_turn(course, everything=False).outputs]
    for quantity, rows in measured(course, quantities, 4).items():
        motion = course.motion(np.array([r[0] for r in rows]))
        of = link_quantities if quantity.kind == "theta" else slide_quantities
        for k, q in enumerate(of(quantity.of)):
            assert [r[k + 1] for r in rows] == pytest.approx(q.values(course, motion).tolist(), rel=1e-9, abs=1e-9)


def test_every_output_has_a_diagram_and_every_coupler_point_a_curve() -> None:
    assert ["curve-E", "motion-link-3", "motion-link-6"] == sorted(pages("sixbar-coupler-1A", positions=0))


def test_pins_of_cranks_and_sliders_are_no_coupler_points() -> None:
    assert coupler_points(read("slider-crank-s50-e16-K1.2")) == ()


@pytest.mark.parametrize("name", ["sixbar-guide-40deg", "sixbar-AE70", "hydraulic-cylinder"])
@pytest.mark.parametrize("language", ["en", "zh"])
def test_nothing_runs_off_the_page(name: str, language: str) -> None:
    for page in pages(name, language, positions=2).values():
        paper = Box(0, 0, page.width, page.height)
        for thing in walk(page.children):
            if isinstance(thing, Text):
                assert paper.holds(text_box(thing))
            elif isinstance(thing, Line):
                assert paper.holds(Box.around((thing.start, thing.end)))
            elif isinstance(thing, Polyline):
                assert paper.holds(Box.around(thing.points))


def test_twelve_measured_points_lie_on_each_curve() -> None:
    page = pages("slider-crank-offset")["motion-slide-3-4"]
    charts = [g for g in page.children if isinstance(g, Group) and g.id.startswith("chart-")]
    for chart in charts:
        things = list(walk((chart,)))
        curve = np.array(next(t for t in things if isinstance(t, Polyline)).points)
        dots = [t.centre for t in things if isinstance(t, Circle)]
        assert len(dots) == 12
        assert all(np.abs(curve - z).min() < 0.25 for z in dots)


def test_the_coupler_curve_is_drawn_in_its_scale() -> None:
    page = pages("four-bar-coupler-point", positions=0)["curve-P"]
    course = course_of(read("four-bar-coupler-point"))
    path = course.motion(np.linspace(*course.ends, 721)).position("P")
    scale = json.loads(json.dumps(page.metadata))["scales"]["length"]
    curve = next(g for g in page.children if isinstance(g, Group) and g.id == "curve-P")
    drawn = Box.around(next(t for t in curve.children if isinstance(t, Polyline)).points)
    assert np.ptp(path.real) * 1e3 / scale == pytest.approx(drawn.width, abs=1e-6)
    assert np.ptp(path.imag) * 1e3 / scale == pytest.approx(drawn.height, abs=1e-6)


@pytest.mark.parametrize("angle", ["33", "0"])
def test_a_change_point_at_the_end_of_the_axis_is_a_gap_in_the_curve_only(angle: str) -> None:
    scene = read_text(scenes.PARALLELOGRAM.replace("angle = 60", f"angle = {angle}"), "p")
    page = diagrams(study_turn(course_of(scene)), positions=12)["motion-link-3"]
    dots = [c for group in page.children for c in walk((group,)) if isinstance(c, Circle)]
    assert all(np.isfinite(c.centre) for c in dots)


def test_the_same_scene_gives_the_same_pages() -> None:
    assert pages("slotter-75-150", positions=2) == pages("slotter-75-150", positions=2)
