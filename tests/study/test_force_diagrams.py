"""Forces over a turn: diagrams whose jumps stand where loads begin and end, polar diagrams, the flywheel."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

import graphkin
from graphkin.api.report_text import verdict
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import Symbol
from graphkin.solver import driver_range
from graphkin.solver.values import flywheel_of, load_edges, needed_moment
from graphkin.study.charts import MARGIN, DriverAxis
from graphkin.study.force_diagrams import force_panel, whole_turn
from tests.scenes import slider_crank

FORCES = Path(__file__).parent.parent / "validation" / "forces"
SHAPER, ENGINE = FORCES / "shaper-scheme-2.toml", FORCES / "engine.toml"
STROKE = 2 * 0.58 * 90 / 350


def crank(load, **driver):
    """A crank alone, that a moment holds up over a quarter of the turn."""
    return {
        "frame": {"name": "0", "points": {"A": [0, 0]}},
        "links": {"1": {"points": ["A", "B"], "length": 100}},
        "driver": {"link": "1", "angle": 30, "omega": 20, **driver},
        "loads": {"L": {"on": "1", "moment": load, "when": {"driver": [45, 135]}}},
        "flywheel": {"on": "1", "delta": 0.1},
    }


def reach_of(scene):
    return driver_range(mechanism_of(scene))


@pytest.mark.parametrize(("load", "speed"), [(-100, 20), (100, -20)])
def test_a_flywheel_carries_over_what_the_driving_moment_lacks(load, speed):
    found = flywheel_of(reach_of(crank(load, omega=speed)))
    assert 25 == pytest.approx(found.driving, rel=1e-9)
    assert 75 * math.pi / 2 == pytest.approx(found.excess, rel=1e-8)
    assert 75 * math.pi / 2 / (0.1 * 400) == pytest.approx(found.inertia, rel=1e-8)
    assert 0 == pytest.approx(sum(found.areas.values()), abs=1e-9)


def test_a_flywheel_is_told_in_the_units_of_the_scene():
    scene = crank(-0.1) | {"units": {"force": "kN", "mass": "g"}}
    told = graphkin.sweep(scene, positions=4).data["flywheel"]
    energies = [0.025 * math.tau, 0.0375 * math.pi, *(0.025 * math.radians(x) for x in (15, -3 * 90, 255))]
    assert energies == pytest.approx([told["work"], told["excess_W"], *(area["work"] for area in told["areas"])])
    assert (0.025, 0.0375 * math.pi / (0.1 * 400) * 1e6) == pytest.approx((told["driving_moment"], told["J_F"]))
    assert [30, 45, 135] == pytest.approx([math.degrees(area["from"]) for area in told["areas"]])


def test_the_work_of_a_cycle_is_that_of_the_loads():
    scene = graphkin.read(SHAPER).to_dict() | {"flywheel": {"on": "2", "delta": 0.1}}
    found = flywheel_of(reach_of(scene))
    assert 9000 * 0.9 * STROKE == pytest.approx(found.work, rel=1e-10)


def test_the_excess_work_is_that_of_a_sum_over_many_positions():
    scene = graphkin.read(ENGINE).to_dict() | {"flywheel": {"on": "2", "delta": 0.02}}
    reach = reach_of(scene)
    found = flywheel_of(reach)
    n = 20_000
    moment = needed_moment(reach, (np.arange(n) + 0.5) / n * math.tau)
    energy = np.cumsum(moment.mean() - moment) * math.tau / n
    assert np.ptp(energy) == pytest.approx(found.excess, rel=1e-6)


@pytest.mark.parametrize("change", [{"driver": {"link": "1", "angle": 30, "omega": 0}}])
def test_a_machine_at_rest_has_no_flywheel(change):
    swept = graphkin.sweep(crank(-100) | change, positions=4)
    assert {"excess_W": None, "J_F": None, "why": swept.data["flywheel"]["why"]} == swept.data["flywheel"]
    assert "the driver rests" in swept.data["flywheel"]["why"]
    assert "flywheel" not in swept.figures


def test_a_flywheel_is_told_by_name_and_judged():
    scene = crank(-100)
    solved = graphkin.solve(scene, find=["J_F", "excess_W"])
    assert 75 * math.pi / 2 == pytest.approx(solved["excess_W"][0], rel=1e-8)
    assert ("J_F (kg m2)", "excess_W (N m)") == solved.table.heads[2:4]
    assert solved["J_F"][0] == graphkin.solve(scene).data["positions"][0]["moments"]["J_F"]
    judged = graphkin.audit(scene | {"printed": {"J_F": 2.945, "excess_W": 100}})
    assert ["right", "wrong"] == [value["verdict"] for value in judged.data["values"]]
    with pytest.raises(graphkin.CallError, match="but there is none"):
        graphkin.solve(SHAPER, find="J_F")


def test_forces_jump_where_the_cut_begins_and_ends():
    edges = np.degrees(load_edges(reach_of(SHAPER)))
    # 14.9 degrees at the start; the crank turns clockwise; 2.6 and 207.5 are the ends of the cut, 180 and 29.8 those of
    # the strokes, where the force against the ram turns round
    assert [2.60618, 29.80119, 180.0, 207.52959] == pytest.approx(edges.tolist(), abs=1e-4)


def test_both_values_stand_at_a_jump_of_the_diagram():
    axis = DriverAxis(reach_of(crank(-100)))
    x, moment = force_panel(axis, Symbol.parse("M_1"), whole_turn(axis)).curve.T
    for place in (45, 135):
        assert {0.0, 100.0} == set(moment[np.abs(x - place) < 1e-4].round(6).tolist())


def test_the_diagrams_of_forces_are_those_that_are_asked_for():
    swept = graphkin.sweep(SHAPER, positions=4, find=["M_2", "F_4/3"])
    assert ["diagram-F_4-3", "diagram-M_2", "polar-F_4-3"] == sorted(swept.figures)
    svg = swept.figures["diagram-M_2"].content("svg").decode()
    greatest = np.abs(graphkin.solve(SHAPER, sweep=3600)["M_2"]).max()
    assert f"−{greatest:.5g}" in re.sub("<[^>]*>", "", svg)


def test_a_sweep_without_wishes_draws_the_balance_and_the_flywheel():
    scene = graphkin.read(SHAPER).to_dict() | {"flywheel": {"on": "2", "delta": 0.1}}
    swept = graphkin.sweep(scene, positions=4, language="zh")
    assert {"diagram-M_2", "flywheel"} <= set(swept.figures)
    assert "飞轮" in swept.text
    assert json.dumps(swept.data)


def test_greatest_and_least_forces_stand_in_the_summary_of_a_turn():
    exact = graphkin.sweep("engine-gas-force", positions=3600, find=["M_2", "F_3/4"])
    found = graphkin.sweep("engine-gas-force").data["forces"]
    (high, low) = found["M_2"]["extremes"]
    assert np.max(exact["M_2"]) == pytest.approx(high["value"], rel=1e-4)
    assert np.min(exact["M_2"]) == pytest.approx(low["value"], rel=1e-3)
    assert np.max(np.abs(exact["F_3/4"])) == pytest.approx(found["F_3/4"]["extremes"][0]["value"], rel=1e-4)


def test_a_force_that_grows_without_bound_is_said_to():
    swept = graphkin.sweep("boom-lifted")
    *high, _ = swept.data["forces"]["F_2"]["extremes"]
    assert [None, None] == [extreme["value"] for extreme in high]
    assert "without bound" in high[0]["why"]
    # the cylinder, 400 on 360.555, is in line with its pivots at both ends
    assert [400 - 360.555127546, 400 + 360.555127546] == pytest.approx([extreme["driver"] for extreme in high])
    assert "F_2 (kN): grows without bound at 39.4449 mm, 760.555 mm; minimum 0 @ " in swept.text


@pytest.mark.parametrize(
    ("scene", "force", "whole"), [("toggle-press-force", "M_1", True), ("boom-lifted", "F_2", False)]
)
def test_a_panel_holds_a_whole_force_unless_it_grows_without_bound(scene, force, whole):
    reach = driver_range(mechanism_of(scene))
    axis = DriverAxis(reach)
    panel = force_panel(axis, Symbol.parse(force), axis.offsets)
    least, most = np.nanmin(panel.curve[:, 1]), np.nanmax(panel.curve[:, 1])
    room = MARGIN * (most - least)
    assert (whole, whole) == (not panel.unbounded, panel.span == pytest.approx((least - room, most + room)))


@pytest.mark.parametrize(
    ("scene", "force", "least", "at"),
    [
        # beside an end of the motion, towards which it grows without bound; 0.728606 at 758.589 is but the least sample
        ("boom-lifted", "F_4/1", 0.504888, 39.9306),
        ("boom-lifted", "F_1/2", 0.0329722, 750.700),
        ("boom-lifted", "F_2", 0.0, 750.822),  # it changes its sign
        ("toggle-press-force", "F_6/1", 0.140029, 350.146),  # it jumps
        ("sine-mechanism-forces", "F_4/1", 2.85714, 90.0),  # so small at this position alone, where the load rests
        ("shaper-forces", "F_1/2", 0.0, 269.589),
    ],
)
def test_the_least_force_is_nought_only_where_it_is(scene, force, least, at):
    low = graphkin.sweep(scene).data["forces"][force]["extremes"][-1]
    driver = at if scene == "boom-lifted" else np.radians(at)
    assert (least, driver) == pytest.approx((low["value"], low["driver"]), rel=3e-6)


def test_the_least_force_is_sought_also_beside_the_position_at_which_the_turn_begins():
    # it was that of the sample beside, 350.154°
    scene = graphkin.read("toggle-press-force").replace("driver.angle", 350.1)
    _, low = graphkin.sweep(scene, positions=2).data["forces"]["F_6/1"]["extremes"]
    assert 350.14634 == pytest.approx(math.degrees(low["driver"]), abs=2e-4)


def test_a_polar_diagram_tells_the_greatest_force_of_the_turn_between_its_points():
    said = graphkin.sweep("rocker-return-spring", positions=2, find=["F_4/3"]).figures["polar-F_4-3"].desc
    turn = graphkin.solve("rocker-return-spring", sweep=3600)
    sizes = np.abs(turn["F_4/3"])
    place = math.degrees(turn.data["positions"][int(sizes.argmax())]["driver"]["1"]) % 360
    assert f"{sizes.max():.4g} N, driver at {place:.4g}°" in said


def test_a_flywheel_asked_of_one_position_is_told_as_computed_over_the_turn():
    scene = graphkin.read("engine-gas-force").to_dict() | {"flywheel": {"on": "2", "delta": 0.05}}
    checked = graphkin.check(scene, find=["J_F", "M_2"])
    assert ["J_F"] == checked.data["not_drawn"]
    assert graphkin.solve(scene).data["positions"][0]["moments"]["J_F"] == pytest.approx(
        checked.data["computed_over_turn"]["J_F"]
    )
    assert "computed over the whole turn" in verdict(checked, "en")


@pytest.mark.parametrize(("convention", "written"), [("chinese", "FR56"), ("us", "F56"), ("russian", "R56")])
def test_diagrams_of_forces_bear_the_letters_of_the_convention(convention, written):
    scene = graphkin.read("shaper-forces").replace("sheet.convention", convention)
    page = graphkin.sweep(scene, positions=12, find=["F_5/6"]).figures["polar-F_5-6"]
    assert f"diagramof{written}" in re.sub(r"<[^>]+>|\s", "", page.content("svg").decode())


def test_a_force_that_grows_without_bound_is_shown_where_most_of_the_way_lies(tmp_path):
    graphkin.sweep("boom-lifted", positions=12, find=["F_2"], language="zh").write(tmp_path)
    svg = (tmp_path / "diagram-F_2.svg").read_text(encoding="utf-8")
    texts = re.findall(r"<text[^>]*? x=\"([\d.e+-]+)\" y=\"([\d.e+-]+)\"[^>]*>([^<]*)", svg)
    height = float(re.search(r'viewBox="0 0 [\d.]+ ([\d.]+)"', svg)[1])
    assert texts
    assert [] == [text for _, y, text in texts if not 0.0 <= float(y) <= height]
    assert "趋于无穷" in re.sub("<[^>]*>", "", svg)
    assert "极大值" not in re.sub("<[^>]*>", "", svg)


def pushed_along_a_guide(**load):
    """A slider on a guide, which bars hold between -57.8695 and 345.605 mm, with a load at 75 degrees to the guide."""
    guide = {"through": [0, 0], "angle": 37}
    return {
        "frame": {"name": "0", "points": {"D": [150, 40]}, "guides": {"h": guide}},
        "links": {
            "1": {"points": ["B"], "on": "0.h"},
            "2": {"points": ["B", "C"], "length": 120},
            "3": {"points": ["D", "C"], "length": 90},
        },
        "driver": {"slide": "1", "travel": 50, "velocity": 50},
        "sketch": {"C": [120, 120]},
        "loads": {"P": {"on": "1", "at": "B", "force": 57.3, "angle": 112} | load},
    }


def test_a_force_that_is_the_same_everywhere_has_one_greatest_value_and_no_least():
    told = graphkin.sweep(pushed_along_a_guide(), positions=6).text
    assert "F_0/1 (N): maximum 55.3475 @ -57.8676 mm\n" in told


@pytest.mark.parametrize("driver", [[330, 400], [-100, -40]])
def test_a_load_that_begins_near_an_end_of_the_motion_grows_nowhere_without_bound(driver):
    # of a load near the upper end it was said that the driving force grows without bound where it begins
    scene = pushed_along_a_guide(when={"driver": driver})
    forces = graphkin.sweep(scene, positions=6, find=["F_1", "F_0/1"]).data["forces"]
    parts = 57.3 * math.cos(math.radians(75)), 57.3 * math.sin(math.radians(75))
    assert parts == pytest.approx(tuple(forces[name]["extremes"][0]["value"] for name in ("F_1", "F_0/1")))


def test_every_place_within_a_turn_towards_which_a_force_grows_without_bound_is_named():
    # a slider 13 beside the crank stands still where crank and rod are in line
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 13], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 30},
            "2": {"points": ["B", "C"], "length": 80},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 50, "omega": 10},
        "loads": {"P": {"on": "1", "moment": 4}},
        "balance": {"on": "3", "at": "C", "angle": 180},
    }
    *away, _ = graphkin.sweep(scene, positions=4).data["forces"]["F_1/2"]["extremes"]
    still = math.asin(13 / 110), math.pi + math.asin(13 / 50)
    assert [(None, pytest.approx(place, abs=1e-6)) for place in still] == [(e["value"], e["driver"]) for e in away]


def test_the_driving_moment_of_loads_that_do_no_work_in_a_turn_is_nothing():
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [200, 40]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 50},
            "2": {"points": ["B", "C"], "length": 180},
            "3": {"points": ["D", "C"], "length": 110},
        },
        "sketch": {"C": [180, 140]},
        "driver": {"link": "1", "angle": 200, "rpm": 150},
        "masses": {"3": {"at": "C", "mass": 5}},
        "gravity": {},
        "loads": {"T": {"on": "3", "moment": -40}},
        "flywheel": {"on": "1", "delta": 0.04},
    }
    assert "constant driving moment 0 N m;" in graphkin.sweep(scene, positions=2).text


def test_extremes_of_forces_stand_within_the_turns_after_which_the_motion_closes():
    scene = graphkin.read("geared-five-bar").to_dict() | {"masses": {"2": {"at": "C", "mass": 1}}}
    scene["driver"] |= {"angle": 640}
    forces = graphkin.sweep(scene, positions=4).data["forces"]
    places = [extreme["driver"] for force in forces.values() for extreme in force["extremes"]]
    assert (True, True) == (0 <= min(places) < math.tau, math.tau < max(places) < 2 * math.tau)


@pytest.mark.parametrize("speed", [157.08, -157.08])
def test_slowest_and_fastest_stand_within_a_turn(speed):
    scene = graphkin.read("engine-gas-force").to_dict() | {"flywheel": {"on": "2", "delta": 0.02}}
    scene["driver"] = {"link": "2", "angle": 30, "omega": speed}
    found = graphkin.sweep(scene, positions=4).data["flywheel"]
    assert [25.1320, 161.1270] == pytest.approx([math.degrees(found[k]) for k in ("slowest", "fastest")], abs=1e-4)


def test_a_force_that_is_known_nowhere_has_no_polar_diagram():
    balance = {"on": "3", "at": "C", "angle": 90}  # square to the guide it does no work
    scene = slider_crank(50, 120, masses={"3": {"at": "C", "mass": 2}}, balance=balance)
    assert ["diagram-F_1-2"] == [*graphkin.sweep(scene, positions=3, find=["F_1/2"]).figures]
