"""Velocity plans of trains of wheels, against Willis' formula and the solver."""

from __future__ import annotations

import re

import pytest

from graphkin import check, draw
from graphkin.construction import draft
from graphkin.scene import mechanism_of

SUN = {"1": {"points": ["A"]}, "2": {"points": ["A", "B"], "length": 50}, "3": {"points": ["B", "P"], "length": 15}}
AXIS = {"points": {"A": [0, 0]}}
TRAINS = {
    "differential with two inputs": (
        {"frame": AXIS, "links": {**SUN, "4": {"points": ["A"]}},
         "gears": {"s": {"between": ["1", "3"], "teeth": [30, 20], "carrier": "2"},
                   "r": {"between": ["3", "4"], "teeth": [20, -70], "carrier": "2"}},
         "driver": [{"link": "1", "angle": 0, "omega": 10}, {"link": "4", "angle": 0, "omega": -3, "alpha": 2}]},
        {"omega_2": (30 * 10 - 70 * 3) / 100, "omega_3": -12.75, "alpha_2": 1.4}),
    "compound planet between two rings": (
        {"frame": AXIS, "links": {**SUN, "4": {"points": ["A"]}},
         "gears": {"s": {"between": ["1", "3"], "teeth": [30, 20], "carrier": "2"},
                   "r": {"between": ["3", "0"], "teeth": [20, -70], "carrier": "2"},
                   "q": {"between": ["3", "4"], "teeth": [18, -68], "carrier": "2"}},
         "driver": {"link": "1", "angle": 0, "omega": 100}},
        {"omega_2": 30, "omega_3": -75, "omega_4": 30 - 105 * 18 / 68}),
    "coupled sets, found by trial": (
        {"frame": {"points": {"A": [0, 0], "D": [0, 50]}},
         "links": {**SUN, "4": {"points": ["A"]}, "6": {"points": ["D"]}},
         "gears": {"s": {"between": ["1", "3"], "teeth": [30, 20], "carrier": "2"},
                   "r": {"between": ["3", "4"], "teeth": [20, -70], "carrier": "2"},
                   "t": {"between": ["1", "6"], "teeth": [30, 20]}, "u": {"between": ["6", "2"], "teeth": [20, -70]}},
         "driver": {"link": "4", "angle": 0, "omega": 10, "alpha": -2}},
        {"omega_2": 10 / (1 + 3 / 7 * (1 + 7 / 3)), "omega_1": -10 * 7 / 3 / (1 + 3 / 7 * (1 + 7 / 3))}),
    "planets on planets, on two lines of centres": (
        {"frame": AXIS,
         "links": {**SUN, "2": {"points": ["A", "B"], "length": 50,
                                "at": {"C": {"from": ["A", "B"], "r": [56, 40], "side": "left"}}},
                   "4": {"points": ["C"]}, "5": {"points": ["A"]}},
         "gears": {"s": {"between": ["1", "3"], "teeth": [30, 20], "carrier": "2"},
                   "m": {"between": ["3", "4"], "teeth": [20, 20], "carrier": "2"},
                   "r": {"between": ["4", "5"], "teeth": [20, -76], "carrier": "2"}},
         "driver": [{"link": "1", "angle": 0, "omega": 10}, {"link": "2", "angle": 10, "omega": 3}]},
        {"omega_5": 3 + 7 * 30 / 76}),
    "a rack that drives": (
        {"frame": {"points": {"A": [0, 0], "B": [0, -60]}, "guides": {"h": {"through": [0, 40], "angle": 0}}},
         "links": {"1": {"points": ["A"]}, "2": {"points": ["R"], "on": "0.h"}, "3": {"points": ["B"]}},
         "gears": {"g": {"between": ["1", "2"], "teeth": [20, "rack"]},
                   "k": {"between": ["1", "3"], "teeth": [20, 40]}},
         "driver": {"slide": "2", "travel": 5, "velocity": 40, "acceleration": 3}},
        {"omega_1": -1, "omega_3": 0.5, "alpha_3": 3 / 80}),
    "a rack that is driven": (
        {"frame": {"points": {"A": [0, 0], "B": [0, -60]}, "guides": {"h": {"through": [0, 40], "angle": 0}}},
         "links": {"1": {"points": ["A"]}, "2": {"points": ["R"], "on": "0.h"}, "3": {"points": ["B"]}},
         "gears": {"g": {"between": ["1", "2"], "teeth": [20, "rack"]},
                   "k": {"between": ["1", "3"], "teeth": [20, 40]}},
         "driver": {"link": "3", "angle": 5, "omega": 4, "alpha": 3}},
        {"omega_1": -8, "v_R": 320, "a_R": 240}),
    "a rack along an arm that turns": (
        {"frame": {"points": {"A": [0, 0]}},
         "links": {"1": {"points": ["A", "B"], "length": 60, "guides": {"h": {"through": [0, 40], "angle": 0}}},
                   "2": {"points": ["R"], "on": "1.h"}, "3": {"points": ["B"]}},
         "gears": {"g": {"between": ["3", "2"], "teeth": [20, "rack"], "carrier": "1"}},
         "driver": [{"link": "1", "angle": 10, "omega": 3}, {"slide": "2", "travel": 5, "velocity": 40}]},
        {"omega_3": 2}),
    "a motor between planet and carrier": (
        {"frame": AXIS, "links": {k: SUN[k] for k in ("2", "3")},
         "gears": {"r": {"between": ["3", "0"], "teeth": [20, -70], "carrier": "2"}},
         "driver": {"link": "3", "relative_to": "2", "angle": 0, "omega": 10}},
        {"omega_2": -20 / 7}),
}


@pytest.mark.parametrize("name", TRAINS)
def test_rates_read_off_the_plan_are_those_of_willis_and_of_the_solver(name):
    scene, expected = TRAINS[name]
    result = check(scene)
    assert result.ok
    for symbol, rate in expected.items():
        assert rate == pytest.approx(result[symbol].measured, rel=1e-9)
        assert result[symbol].on_paper > 0


@pytest.mark.parametrize("name", TRAINS)
def test_what_is_read_on_paper_times_the_scale_of_the_plan_is_the_rate(name):
    scene, expected = TRAINS[name]
    result = check(scene)
    scales = {plan.rate: plan.turning for plan in result.sheet.trains}
    for kind, link in (symbol.split("_") for symbol in expected if symbol[0] in "oa" and symbol != "a_R"):
        assert abs(expected[f"{kind}_{link}"]) == pytest.approx(result[f"{kind}_{link}"].on_paper * scales[kind])


@pytest.mark.parametrize("name", ["differential with two inputs", "coupled sets, found by trial"])
def test_a_pencil_s_plan_is_within_its_predicted_uncertainty(name):
    assert check(TRAINS[name][0], instrument="pencil", seed=2).ok


def test_the_slope_of_a_wheel_s_line_on_paper_is_its_rate():
    page = draw("gears-epicyclic", figures=["plan"]).figures["plan"]
    svg, scales = page._repr_svg_(), page.metadata["scales"]
    x1, y1, x2, y2 = (
        float(re.search(rf'id="plan-line-3".*?<line[^>]*? {end}="([-\d.]+)"', svg, re.DOTALL)[1])
        for end in ("x1", "y1", "x2", "y2")
    )
    rate = (x2 - x1) * scales["velocity"] / ((y2 - y1) * scales["length"])
    assert -7.5 == pytest.approx(rate, rel=1e-3)


@pytest.mark.parametrize(("axis", "pole"), [("B", "P"), ("P", "H")])
def test_the_pole_of_a_plan_has_a_letter_that_no_axis_of_the_plan_has(axis, pole):
    links = {"1": {"points": ["A"]}, "2": {"points": ["A", axis], "length": 50}, "3": {"points": [axis]}}
    gears = {"s": {"between": ["1", "3"], "teeth": [30, 20], "carrier": "2"},
             "r": {"between": ["3", "0"], "teeth": [20, -70], "carrier": "2"}}
    scene = {"frame": {"points": {"A": [0, 0]}}, "links": links, "gears": gears,
             "driver": {"link": "1", "angle": 0, "omega": 10}}
    svg = draw(scene, figures=["plan"]).figures["plan"]._repr_svg_()
    assert f"through the pole {pole} mark" in re.sub(r"<[^>]*>", "", svg)


def test_a_straight_carrier_stays_straight_on_its_line_of_centres():
    links = {**SUN, "2": {"points": ["A", "B"], "length": 50, "at": {"C": [90, 0]}}, "4": {"points": ["C"]}}
    gears = {"s": {"between": ["1", "3"], "teeth": [30, 20], "carrier": "2"},
             "m": {"between": ["3", "4"], "teeth": [20, 20], "carrier": "2"}}
    drivers = [{"link": "1", "angle": 0, "omega": 10}, {"link": "2", "angle": 10, "omega": 3}]
    scene = {"frame": AXIS, "links": links, "gears": gears, "driver": drivers}
    (line,) = check(scene).sheet.trains[0].on
    assert [0, 50, 90] == pytest.approx([1e3 * line.spot(axis).height for axis in "ABC"])


FOUND_LATER = {
    "frame": {"points": {"A": [0, 0], "D": [90, 0]}},
    "links": {"1": {"points": ["A"]}, "2": {"points": ["D", "E"], "length": 25},
              "4": {"points": ["E", "F"], "length": 80},
              "5": {"points": ["A", "F"], "length": 60, "at": {"G": [50, 0]}}, "6": {"points": ["G"]}},
    "gears": {"s": {"between": ["1", "2"], "teeth": [20, 40]},
              "m": {"between": ["1", "6"], "teeth": [30, 20], "carrier": "5"}},
    "driver": {"link": "1", "angle": 100, "omega": 10, "alpha": 4},
}
"""Wheel 2 drives a four-bar, and its rocker 5 carries wheel 6 of the same train."""


@pytest.mark.parametrize("link", ["2", "6"])
def test_a_rate_is_read_off_a_plan_that_is_shown_though_others_of_the_train_are_found_later(link):
    sheet = check(FOUND_LATER).sheet
    (step,) = (s for s in sheet.steps if s.diagram == "velocity" and s.reason == "plan" and s.link == link)
    shown = [(plan.turning, plan.line(link).mm) for plan in sheet.trains if plan.order == "velocity"
             and plan.line(link) is not None and plan.line(link).reason == "plan"]
    assert [(step.per_mm, step.mm)] == shown
    # a figure at other scales keeps the lengths of a plan
    assert step.mm == sheet.rates["omega"][link].scaled(2.0).mm


def test_a_wheel_on_a_carrier_that_is_found_later_has_the_rate_of_willis():
    result = check(FOUND_LATER)
    carrier = result["omega_5"].measured
    assert carrier - 1.5 * (10 - carrier) == pytest.approx(result["omega_6"].measured, rel=1e-9)


@pytest.mark.parametrize(("name", "first", "last"), [
    ("coupled sets, found by trial", "plans", "plan"), ("a rack that is driven", "given on plan", "plan travel"),
])
def test_the_steps_of_a_plan_are_its_trials_its_lines_and_the_speeds_read_off_it(name, first, last):
    sheet = draft(mechanism_of(TRAINS[name][0]))
    for number, plan in enumerate(sheet.trains, 1):
        steps = [step for step in sheet.steps if step.plan == number]
        assert (first, last) == (steps[0].reason, steps[-1].reason)
        assert len(steps) == len(plan.lines) + len(plan.travels) + (plan.trial is not None)


def test_speeds_of_a_rack_stand_in_the_table_of_the_plan_in_the_units_of_the_scene():
    figures = draw(TRAINS["a rack that is driven"][0] | {"units": {"length": "cm"}}, figures=["plan"]).figures
    assert [">320 cm/s<" in figures["plan"]._repr_svg_(), ">240 cm/s²<" in figures["plan-2"]._repr_svg_()] == [True] * 2


@pytest.mark.parametrize("start", [{"3": 40}, {"2": 20}])
@pytest.mark.parametrize(("wheel", "seen_from", "sense"), [("2", "3", 1), ("3", "2", -1)])
def test_a_driver_may_turn_one_wheel_of_a_train_seen_from_another(wheel, seen_from, sense, start):
    scene = {
        "frame": {"points": {"B": [0, 0], "C": [60, 0]}},
        "links": {"2": {"points": ["C", "D"], "length": 31}, "3": {"points": ["B", "E"], "length": 13}},
        "gears": {"g": {"between": ["2", "3"], "teeth": [20, 35], "carrier": "0"}},
        "driver": {
            "link": wheel, "angle": -20 * sense, "omega": -12 * sense, "alpha": 14 * sense, "relative_to": seen_from,
        },
    }
    for link, angle in start.items():
        scene["links"][link]["start"] = angle
    result = check(scene, find=["theta_2", "theta_3", "omega_2", "omega_3"])
    # 20 omega_2 + 35 omega_3 = 0, omega_2 - omega_3 = -12
    expected = {"theta_2": 20, "theta_3": 40, "omega_2": -12 * 35 / 55, "omega_3": 12 * 20 / 55}
    assert expected == pytest.approx({name: result[name].measured for name in expected})
    assert result.ok


def two_trains(seen_from: str) -> dict:
    """Two trains about one axis, each on the frame with its own carrier: wheel 6 of the second is turned from a link of
    the first at 0.3, which a sum rounds; wheel 5 turns at 12."""
    links = {
        "1": {"points": ["A", "B"], "length": 30}, "2": {"points": ["B"]}, "3": {"points": ["A"]},
        "4": {"points": ["A", "C"], "length": 40, "start": 0}, "5": {"points": ["C"]}, "6": {"points": ["A"]},
    }
    meshes = ("32", [31, 16], "1"), ("02", [55, 14], "1"), ("65", [36, 17], "4"), ("05", [-75, 21], "4")
    gears = {f"g{k}": {"between": [*pair], "teeth": teeth, "carrier": on} for k, (pair, teeth, on) in enumerate(meshes)}
    driver = [{"link": "6", "angle": 0, "omega": 0.3, "relative_to": seen_from}, {"link": "5", "angle": 0, "omega": 12}]
    return {"frame": AXIS, "links": links, "gears": gears, "driver": driver}


@pytest.mark.parametrize("seen_from", ["1", "2", "3"])
def test_a_train_whose_motion_comes_from_another_by_a_driver_is_drawn_with_it(seen_from):
    second_carrier = -21 * 12 / 54
    six = second_carrier - 17 / 36 * (12 - second_carrier)
    to_carrier = {"1": 1, "2": 1 + 55 / 14, "3": 1 - 16 / 31 * 55 / 14}  # of the first, about its fixed wheel
    carrier = (six - 0.3) / to_carrier[seen_from]
    checked = check(two_trains(seen_from))
    assert checked.ok
    expected = {f"omega_{link}": share * carrier for link, share in to_carrier.items()} | {"omega_6": six}
    assert expected == pytest.approx({name: checked[name].measured for name in expected})


BELOW = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, -30], "angle": 0}}},
    "links": {"1": {"points": ["A", "B"], "length": 50}, "2": {"points": ["R"], "on": "0.h"}},
    "gears": {"g": {"between": ["1", "2"], "teeth": [24, "rack"]}},
    "driver": {"link": "1", "angle": 40, "omega": 5, "alpha": -2},
}


@pytest.mark.parametrize("scene", [BELOW, *(scene for scene, _ in TRAINS.values())])
def test_the_lines_of_a_plan_stand_at_the_heights_of_their_train(scene):
    for plan in draw(scene, figures=["plan"]).checked.sheet.trains:
        for (k, link), step in plan.lines.items():
            heights = [spot.height / plan.length for spot in plan.on[k].spots]
            ends = [end.imag for bar in step.strokes for end in (bar.a, bar.b)]
            assert {link: []} == {link: [y for y in ends if not min(heights) - 1e-6 <= y <= max(heights) + 1e-6]}
