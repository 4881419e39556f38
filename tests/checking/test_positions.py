"""Positions asked for by name: measured on the drawing, equal to what geometry says and to the solver."""

from __future__ import annotations

import math

import pytest

import graphkin
from graphkin.api.checked import Checked
from graphkin.errors import CallError, Unsolvable
from graphkin.scene.symbol import Symbol
from tests.mechanisms import floating_cylinder

SHAPER = "shaper-scheme-2"
FOUR_BAR = {
    "frame": {"name": "4", "points": {"A": [0, 0], "D": [400, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 150},
        "2": {"points": ["B", "C"], "length": 500},
        "3": {"points": ["D", "C"], "length": 300},
    },
    "driver": {"link": "1", "angle": 60, "omega": 10},
    "sketch": {"C": [500, 290]},
}
EVERY = ["theta_4", "theta_5/4", "x_C", "d_B/C", "d_P25/P46", "s_3/4", "gamma_5-6", "pressure_6", "stroke_6/1",
         "swing_4", "K_6/1", "theta_lag_6/1"]


@pytest.fixture(scope="module")
def shaper() -> Checked:
    return graphkin.check(SHAPER, find=EVERY)


def test_every_kind_of_position_agrees_with_the_solver(shaper: Checked) -> None:
    assert [] == [str(row.symbol) for row in shaper.report.rows if row.error > 1e-11]


def test_the_shaper_has_the_stroke_and_the_K_of_its_course_design(shaper: Checked) -> None:
    theta = 2 * math.asin(90 / 350)
    stroke, k = shaper["stroke_6/1"].measured, shaper["K_6/1"].measured
    assert [580 * 2 * 90 / 350, (math.pi + theta) / (math.pi - theta)] == pytest.approx([stroke, k], rel=1e-12)


def test_the_angle_between_the_limit_positions_is_that_of_the_tangents(shaper: Checked) -> None:
    assert shaper["theta_lag_6/1"].measured == pytest.approx(2 * math.degrees(math.asin(90 / 350)))


def test_lengths_stand_on_paper_and_angles_do_not(shaper: Checked) -> None:
    rows = {row["symbol"]: row["on_paper_mm"] for row in shaper.data["readings"]}
    assert (None, None, 298.28571428571428 / 5) == (rows["theta_4"], rows["K_6/1"], pytest.approx(rows["stroke_6/1"]))


def test_angles_are_radians_for_programs_and_degrees_in_files(shaper: Checked) -> None:
    (row,) = (r for r in shaper.data["readings"] if r["symbol"] == "theta_4")
    column = list(shaper.table["symbol"]).index("theta_4")
    assert math.degrees(row["measured"]) == pytest.approx(shaper.table["measured"][column])


@pytest.fixture(scope="module")
def pencil() -> Checked:
    return graphkin.check(FOUR_BAR, find=["theta_3", "d_P13/A", "K_3", "swing_3"], instrument="pencil", seed=3)


def test_a_pencil_keeps_within_what_is_predicted_for_positions(pencil: Checked) -> None:
    assert [] == [str(row.symbol) for row in pencil.report.rows if not row.ok]


def test_a_pencil_is_uncertain_of_what_it_measures(pencil: Checked) -> None:
    places = [row for row in pencil.report.rows if row.symbol.scope != "motion"]
    assert all(row.uncertainty and row.uncertainty.deviation > 0 for row in places)


def test_a_four_bar_has_the_transmission_angle_of_the_law_of_cosines() -> None:
    b = 150 * complex(math.cos(math.radians(60)), math.sin(math.radians(60)))
    cosine = (500**2 + 300**2 - abs(400 - b) ** 2) / (2 * 500 * 300)
    gamma = graphkin.check(FOUR_BAR, find=["gamma_2-3"])["gamma_2-3"].measured
    assert math.acos(abs(cosine)) == pytest.approx(math.radians(gamma), abs=1e-12)


def test_a_printed_angle_is_judged_in_degrees_and_without_whole_turns() -> None:
    scene = {**FOUR_BAR, "printed": {"theta_3": 57.93 - 360, "K_3": 1.366, "d_B/C": 500}}
    assert ["right"] * 3 == [v["verdict"] for v in graphkin.audit(scene).data["values"]]


@pytest.mark.parametrize("name", ["swing_1", "K_1"])
def test_a_link_that_turns_on_and_on_has_no_limit_positions(name: str) -> None:
    with pytest.raises(Unsolvable, match=f"{name}: link 1 turns on and on"):
        graphkin.check(FOUR_BAR, find=[name])


def test_a_crank_that_other_links_stop_does_not_turn_on_and_on() -> None:
    with pytest.raises(Unsolvable, match="swing_2: belongs to a whole turn, but driver 2 does not turn fully"):
        graphkin.check("triad-slider", find=["swing_2"])


def test_a_driver_that_does_not_turn_fully_has_no_whole_turn() -> None:
    scene = {**FOUR_BAR, "driver": {"link": "3", "angle": 58, "omega": 1}, "sketch": {"B": [75, 130]}}
    with pytest.raises(Unsolvable, match="K_1: belongs to a whole turn, but driver 3 does not turn fully"):
        graphkin.check(scene, find=["K_1"])


@pytest.mark.parametrize("name", ["swing_1", "swing_3"])
def test_what_a_cylinder_drives_has_no_whole_turn(name: str) -> None:
    with pytest.raises(Unsolvable, match=f"{name}: belongs to a whole turn, but the driver slides"):
        graphkin.check(floating_cylinder(900), find=[name])


def test_a_pair_that_does_not_slide_is_refused_by_name() -> None:
    with pytest.raises(CallError, match="s_2/1: there is no such sliding pair"):
        graphkin.check(FOUR_BAR, find=["s_2/1"])


@pytest.fixture
def slider_with_a_redundant_one() -> dict[str, object]:
    """A slider-crank whose slider is held on its guide a second time, by a link 40 before it."""
    return {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": "A", "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 30}, "2": {"points": ["B", "C"], "length": 80},
            "3": {"points": ["C"], "on": "0.h", "at": {"E": [40, 0]}},
            "4": {"points": ["E"], "on": "0.h", "redundant": True},
        },
        "driver": {"link": "1", "angle": 40, "omega": 3},
    }


@pytest.mark.parametrize("name", ["s_4/0", "stroke_4/0", "swing_4", "gamma_3-4"])
def test_nothing_is_drawn_of_a_redundant_link(name: str, slider_with_a_redundant_one: dict[str, object]) -> None:
    result = graphkin.check(slider_with_a_redundant_one, find=[name])
    assert name not in [str(row.symbol) for row in result.report.rows]


def test_a_redundant_slide_has_its_diagrams_and_its_transmission_angle(
    slider_with_a_redundant_one: dict[str, object]
) -> None:
    assert "motion-slide-4-0" in graphkin.sweep(slider_with_a_redundant_one, positions=4).figures
    solved = graphkin.solve(slider_with_a_redundant_one, find=["gamma_3-4"])
    assert float(solved["gamma_3-4"][0]) == pytest.approx(90.0)


def test_a_symbol_reads_as_it_is_written() -> None:
    names = [*EVERY, "v_C at 10", "s_B/3", "theta_lag_3", "ak_B@3/B@2", "d_P12/A at 7'"]
    assert names == [str(Symbol.parse(name)) for name in names]


def test_a_figure_is_drawn_alone_when_it_is_asked_for() -> None:
    assert ["velocity"] == list(graphkin.draw(FOUR_BAR, figures=["velocity"]).figures)


def test_an_unknown_figure_is_refused_with_the_nearest_name() -> None:
    with pytest.raises(CallError, match='figure: "velocty"; did you mean "velocity"'):
        graphkin.draw(FOUR_BAR, figures=["velocty"])


DWELLING = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"g": {"through": "A", "angle": 90}}},
    "links": {"1": {"points": ["A"]}, "2": {"points": ["B"], "on": "0.g"}},
    "cams": {"1": {"follower": "2", "base": {"r": 80}, "law": [
        {"to": 60, "rise": 20, "by": "345"}, {"to": 140}, {"to": 160},
        {"to": 340, "fall": 20, "by": "345"}, {"to": 360},
    ]}},
}
"""A cam that lifts its follower in 60 degrees and lets it down in 180 (mm)."""


@pytest.mark.parametrize("omega", [10, -10])
def test_K_of_a_drawn_follower_is_that_of_rise_and_fall_without_dwells(omega: float) -> None:
    scene = DWELLING | {"driver": {"link": "1", "angle": 30, "omega": omega}}
    checked = graphkin.check(scene, find=["K_2/0", "theta_lag_2/0"])
    assert [3.0, 90.0] == pytest.approx([row.measured for row in (checked["K_2/0"], checked["theta_lag_2/0"])])
    assert checked.ok


def test_a_centre_of_links_at_rest_lies_where_it_lies_in_any_motion() -> None:
    scene = graphkin.read("sixbar-guide-40deg").to_dict()
    moving, resting = (
        graphkin.check({**scene, "driver": {"link": "1", "angle": 50, "omega": omega}}, find=["d_P13/C"])["d_P13/C"]
        for omega in (-10, 0)
    )
    assert [moving.exact] * 2 == pytest.approx([resting.exact, resting.measured])
    table = graphkin.sweep({**scene, "driver": {"link": "1", "angle": 50, "omega": 0}}, find=["d_P13/C"], positions=4)
    assert moving.exact == pytest.approx(table.to_pandas()["d_P13/C (mm)"][0])


def test_tables_have_no_distance_of_a_centre_at_infinity() -> None:
    lengths = {name: {**link, "length": 400 if name == "2" else 150} for name, link in FOUR_BAR["links"].items()}
    parallelogram = {**FOUR_BAR, "links": lengths, "sketch": {"C": [475, 130]}}
    (position,) = graphkin.solve(parallelogram, find=["d_P24/A", "d_P13/A"]).data["positions"]
    assert {"d_P24/A": None, "d_P13/A": None} == position["values"]  # rounding had put P24 at 1e17 mm



def test_a_position_that_a_travel_names_is_that_of_the_travel() -> None:
    scene = {**graphkin.read("hydraulic-cylinder").to_dict(), "positions": {"also": {"x": 540}}}
    velocity = graphkin.solve(scene, at=540).data["positions"][0]["points"]["B@1"]["velocity"]
    (row,) = (row for row in graphkin.check(scene, find=["v_B at x"]).data["readings"] if row["symbol"] == "v_B at x")
    assert [abs(complex(*velocity))] * 2 == pytest.approx([row["exact"], row["measured"]])
