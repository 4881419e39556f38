"""Designs of a prepared mechanism: the values are those of the changed scene, read and prepared anew."""

from __future__ import annotations

import pickle
import tomllib
from importlib.util import find_spec

import numpy as np
import pytest

import graphkin
from graphkin.scene import library_text, mechanism_of
from graphkin.scene.symbol import Symbol
from graphkin.solver.prepared import prepare
from graphkin.study.designs import applied
from graphkin.study.prepared_designs import PreparedMechanisms
from tests import scenes

SHAPER = tomllib.loads(library_text("shaper-scheme-2"))
FOUR_BAR = {
    "frame": {"points": {"A": [0, 0], "D": [400, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 150},
        "2": {
            "points": ["B", "C"],
            "length": 500,
            "at": {"E": [200, 100], "F": {"from": "C", "r": 60, "angle": 20, "toward": "E"}},
        },
        "3": {"points": ["C", "D"], "length": 300},
    },
    "driver": {"link": "1", "angle": 60, "omega": 10, "alpha": 0},
}
ASKED = ["v_C", "a_C", "theta_4", "v_3/4", "a_6/1", "x_C", "d_O4/C", "theta_4/5", "ak_A@3/A@4", "an_B", "at_C/B"]
KEYS = {
    "links.2.length": np.linspace(70, 110, 7),
    "frame.points.O2.y": np.linspace(300, 400, 7),
    "frame.points.O4.x": np.linspace(0, 30, 7),
    "driver.rpm": np.linspace(-70, 80, 7),
    "driver.angle": np.linspace(0, 90, 7),
    "frame.guides.h.angle": np.linspace(0, 6, 7),
    "links.5.length": np.linspace(170, 180, 7),
}


def off(source, designs, find, n=24):
    """How far the designs are from the scenes that say so, relative to the largest value of each column."""
    found = graphkin.prepare(source, find=find).over(designs).sweep(n)
    worst = 0.0
    for k in range(found.ok.shape[0]):
        design = applied(source, tuple(designs), tuple(float(v[k]) for v in designs.values()))
        anew = graphkin.prepare(design, find=find)
        expected = anew.sweep(n)
        assert expected.ok.tolist() == found.ok[k].tolist()
        apart = np.abs(found.values[:, k] - expected.values)[:, expected.ok]
        worst = max(worst, float(np.max(apart / np.abs(expected.values[:, expected.ok]).max(initial=1.0), initial=0)))
    return worst


@pytest.mark.parametrize("key", KEYS)
def test_a_key_of_the_file_acts_as_in_the_file(key):
    assert off(SHAPER, {key: KEYS[key]}, ASKED) < 1e-12


def test_the_value_of_a_driver_that_is_held_is_another_in_each_design():
    five_bar = tomllib.loads(scenes.FIVE_BAR.replace("angle = 40", "angle = 90"))
    designs = {"driver.2.angle": np.array([60.0, 100.0, 120.0])}
    assert graphkin.prepare(five_bar, find="v_C").over(designs)._designs.together.all()
    assert off(five_bar, designs, ["C", "v_C", "a_C", "omega_3"]) < 1e-12


def test_keys_act_together_as_in_the_file():
    assert off(SHAPER, KEYS, ASKED) < 1e-12


@pytest.mark.parametrize(
    ("key", "values"),
    [
        ("links.2.at.F.r", [50, 80]),
        ("links.2.at.F.angle", [-40, 50]),
        ("driver.alpha", [3, -30]),
        ("driver.omega", [0, -5]),
    ],
)
def test_points_placed_from_others_follow_as_the_reader_places_them(key, values):
    assert off(FOUR_BAR, {key: np.array(values, dtype=float)}, ["F", "a_F", "omega_3", "alpha_3"]) < 1e-12


@pytest.mark.parametrize("key", ["links.2.at.E.x", "links.2.length"])
def test_a_key_that_bends_the_way_of_a_point_is_refused(key):
    with pytest.raises(graphkin.CallError, match="neither as a line nor as a turn"):  # F lies from C toward E
        graphkin.prepare(FOUR_BAR, find="v_C").over({key: [480]})


def test_designs_that_do_not_turn_fully_are_followed_as_scenes_are():
    assert off(FOUR_BAR, {"links.1.length": np.linspace(180, 300, 4)}, ["v_C", "omega_3"]) < 1e-12


def test_a_driven_slide_has_designs_too():
    source = tomllib.loads(library_text("hydraulic-cylinder"))
    key = next(f"links.{name}.length" for name, table in source["links"].items() if "length" in table)
    own = source["links"][key.split(".")[1]]["length"]
    assert off(source, {key: own * np.array([0.98, 1.02])}, ["omega_1"], 6) < 1e-9


def test_designs_that_stay_away_from_dead_points_are_computed_together():
    ready = prepare(mechanism_of("shaper-scheme-2"), [Symbol.parse("v_C")])
    lengths = np.linspace(0.08, 0.1, 5)
    (crank,) = (name for name in ready.dimensions if name[:2] == ("point", "2") and ready.dimensions[name])
    assert PreparedMechanisms(ready, {crank: lengths}).together.all()


def test_at_gives_all_designs_at_one_position():
    ready = graphkin.prepare(SHAPER, find=ASKED)
    lengths = [80.0, 95.0]
    found = ready.over({"links.2.length": lengths}).at(70)
    for k, length in enumerate(lengths):
        anew = graphkin.prepare(applied(SHAPER, ("links.2.length",), (length,)), find=ASKED)
        assert anew.at(70) == pytest.approx(found.values[:, k].tolist(), rel=1e-12, abs=1e-9)


def test_one_number_gives_one_design():
    assert (24,) == graphkin.prepare(SHAPER, find="v_C").over({"links.2.length": 80}).sweep(24)["v_C"].shape


def test_its_own_numbers_give_the_scene_itself():
    ready = graphkin.prepare(SHAPER, find=ASKED)
    itself = ready.over({"links.2.length": 90, "frame.points.O4.x": 0}).sweep(50)
    assert ready.sweep(50).values == pytest.approx(itself.values, rel=1e-13, abs=1e-9)


def test_bounds_hold_for_designs():
    ready, lengths = graphkin.prepare(SHAPER, find=["v_C"], bounds=True), [80.0, 100.0]
    found = ready.over({"links.2.length": lengths}).sweep(30)
    for k, length in enumerate(lengths):
        motion = graphkin.solve(applied(SHAPER, ("links.2.length",), (length,)), sweep=30).motion
        known = 1000 * motion.bound.velocity
        assert (np.abs(found["v_C"][k] - 1000 * motion.velocity("C")) <= 1.5 * found.bound("v_C")[k] + known).all()


@pytest.mark.skipif(find_spec("numba") is None, reason="the extra fast is not installed")
def test_compiled_designs_are_those_of_numpy():
    designs = {"links.2.length": [80, 90], "driver.rpm": [-60, 70], "driver.angle": [10, 200]}
    slow, fast = (graphkin.prepare(SHAPER, find="a_C", fast=f).over(designs).sweep(100).values for f in (False, True))
    assert np.abs(fast - slow).max() < 1e-13 * np.abs(slow).max()


@pytest.mark.parametrize(
    ("source", "asked", "designs"),
    [
        (FOUR_BAR, ["v_C", "omega_3"], {"links.1.length": [150.0, 250.0, 1000.0]}),  # one with ends, one that is none
        (applied(FOUR_BAR, ("links.1.length",), (250.0,)), ["v_C"], {"driver.angle": [20.0, 100.0]}),
        (tomllib.loads(scenes.FIVE_BAR), ["omega_3"], {"driver.2.angle": [60.0, 100.0]}),
    ],
)
def test_the_table_of_designs_is_the_table_of_a_sweep_over_them(source, asked, designs):
    swept = graphkin.sweep(source, positions=12, find=asked, designs=designs).table
    table = graphkin.prepare(source, find=asked).over(designs).sweep(12).table
    assert (swept.heads, swept.index) == (table.heads, table.index)
    for column, other in zip(swept.columns, table.columns, strict=True):
        if column.is_text:
            assert column.values.tolist() == other.values.tolist()
        else:
            np.testing.assert_allclose(column.values, other.values, rtol=1e-9, err_msg=column.head)


def test_positions_and_whether_they_are_solved_are_read_alike_from_a_table_and_from_arrays():
    designs = {"links.1.length": [150.0, 250.0]}  # the second has ends
    made = graphkin.sweep(FOUR_BAR, positions=5, find=["v_C"], designs=designs).over
    ready = graphkin.prepare(FOUR_BAR, find="v_C").over(designs).sweep(5)
    assert made.ok.tolist() == ready.ok.tolist()
    assert (True, False) == (made.ok[0].all(), made.ok[1].all())
    np.testing.assert_allclose(made.driver, np.broadcast_to(ready.driver, (2, 5)), rtol=1e-9)


def test_designs_at_a_position_have_that_value_of_the_driver_not_their_own():
    table = graphkin.prepare(SHAPER, find="omega_4").over({"driver.angle": [30.0, 50.0]}).at(70).table
    assert [70.0, 70.0] == table["driver_2"].tolist()


@pytest.mark.parametrize(("length", "rows"), [(80, [80.0]), ([80, 90], [80.0, 90.0])])
def test_the_table_at_a_position_has_a_row_for_each_design(length, rows):
    table = graphkin.prepare(SHAPER, find="omega_4").over({"links.2.length": length}).at(30).table
    assert rows == table["links.2.length"].tolist()
    assert [30.0] * len(rows) == table["driver_2"].tolist()
    assert ("design", "position") == table.index


def test_designs_that_were_swept_can_be_sent_to_another_process():
    swept = graphkin.prepare(FOUR_BAR, find="v_C").over({"links.1.length": [150.0, 1000.0]}).sweep(4)
    assert swept == pickle.loads(pickle.dumps(swept))


def test_designs_in_xarray_are_over_designs_and_positions():
    pytest.importorskip("xarray")
    found = graphkin.prepare(SHAPER, find="omega_4").over({"links.2.length": [80, 90]}).sweep(3)
    assert found["omega_4"].tolist() == found.to_xarray()["omega_4"].values.tolist()


@pytest.mark.parametrize(
    ("designs", "what"),
    [
        ({"links.2.size": [1]}, "size"),
        ({"links.2.length": [-4]}, "above 0"),
        ({"links.2.length": [float("nan")]}, "above 0"),
        ({"links.2.length": [1, 2], "driver.angle": [1, 2, 3]}, "each key"),
        ({}, "each key"),
        ({"sketch.C.x": [3]}, "changes no dimension"),
    ],
)
def test_designs_that_mean_nothing_are_refused(designs, what):
    with pytest.raises(graphkin.CallError, match=what):
        graphkin.prepare(SHAPER, find="v_C").over(designs)


def test_a_scene_that_is_read_already_has_designs():
    scene = graphkin.read("shaper-scheme-2")
    found = graphkin.prepare(scene, find="v_C").over({"links.2.length": [80.0]}).sweep(10)
    anew = graphkin.prepare(applied(SHAPER, ("links.2.length",), (80.0,)), find="v_C").sweep(10)
    assert anew["v_C"] == pytest.approx(found["v_C"][0], rel=1e-12)


def test_a_sweep_over_designs_holds_what_they_give():
    designs = {"links.2.length": [80.0, 90.0, 30.0], "driver.rpm": [-60.0, 70.0]}
    table = graphkin.sweep(SHAPER, positions=5, find=["omega_4"], designs=designs).table
    every = {"links.2.length": np.repeat(designs["links.2.length"], 2), "driver.rpm": designs["driver.rpm"] * 3}
    over = graphkin.prepare(SHAPER, find="omega_4").over(every).sweep(5)
    assert over["omega_4"].ravel() == pytest.approx(table["omega_4 (rad/s)"], rel=1e-12)


def test_a_crank_alone_has_designs():
    crank = {
        "frame": {"points": {"A": [0, 0]}},
        "links": {"1": {"points": ["A", "B"], "length": 50}},
        "driver": {"link": "1", "angle": 10, "omega": 2},
    }
    found = graphkin.sweep(crank, positions=4, designs={"links.1.length": [50, 60]}, find=["v_B"])
    assert [[100.0] * 4, [120.0] * 4] == pytest.approx(np.abs(found["v_B"]))


@pytest.mark.parametrize("angle", [30.0, [30.0], [30.0, 50.0], [-20.0, 200.0, 30.0]])
def test_a_design_with_another_driver_angle_begins_there(angle):
    ready = graphkin.prepare(SHAPER, find=["theta_4", "omega_4"])
    found = ready.over({"driver.angle": angle})
    for k, one in enumerate(np.atleast_1d(angle).tolist()):
        anew = graphkin.prepare(applied(SHAPER, ("driver.angle",), (one,)), find=["theta_4", "omega_4"])
        turn, here = found.sweep(5), found["omega_4"]
        rows = (turn["omega_4"], turn.driver) if np.ndim(angle) == 0 else (turn["omega_4"][k], turn.driver[k])
        assert anew.sweep(5)["omega_4"].tolist() == pytest.approx(rows[0].tolist(), rel=1e-12)
        assert anew.sweep(5).driver.tolist() == pytest.approx(rows[1].tolist(), rel=1e-12)
        assert float(anew["omega_4"][0]) == pytest.approx(float(np.atleast_1d(here)[k]), rel=1e-12)


def test_the_driven_slide_of_each_design_has_its_own_range():
    lift = {
        "frame": {"name": "1", "points": {"A": [0, 0], "C": [200, -300]}},
        "links": {
            "2": {"points": ["A", "B"], "length": 400},
            "3": {"points": ["B"], "on": "4"},
            "4": {"points": ["C"]},
        },
        "driver": {"slide": "3", "travel": 520, "velocity": -60},
    }
    found = graphkin.prepare(lift, find=["theta_2"]).over({"links.2.length": [400, 380]}).sweep(5)
    for k, length in enumerate([400, 380]):
        anew = graphkin.prepare(applied(lift, ("links.2.length",), (length,)), find=["theta_2"]).sweep(5)
        assert anew.driver.tolist() == pytest.approx(found.driver[k].tolist(), rel=1e-9)
        assert anew["theta_2"].tolist() == pytest.approx(found["theta_2"][k].tolist(), rel=1e-9)


def test_a_face_may_lie_at_any_angle_in_its_own_link():
    # the face touches a disc of radius 50 about O, 22 mm from A, and turns about C, 80 mm from A
    def face(driver: float) -> float:
        way = 22 * np.exp(1j * driver) - 80
        return float(np.angle(way) - np.arcsin(50 / abs(way)))

    h = 1e-5
    omega = 10 * (face(np.pi / 2 + h) - face(np.pi / 2 - h)) / (2 * h)
    designs, source = {"links.2.guides.f.angle": [0.0, 10.0, -25.0]}, "cam-eccentric-flat-rocker"
    over = graphkin.prepare(source, find="omega_2").over(designs).at(90)["omega_2"]
    swept = graphkin.sweep(source, designs=designs, positions=1, find=["omega_2"]).table["omega_2"]
    assert [omega] * 3 == pytest.approx(over.tolist(), rel=1e-8)
    assert [omega] * 3 == pytest.approx(swept.tolist(), rel=1e-8)


@pytest.mark.parametrize("key", ["frame.points.A.x", "frame.points.C.y", "links.2.length"])
def test_a_key_that_moves_a_cam_by_its_law_is_refused(key):
    ready = graphkin.prepare("cam-swinging-roller", find=["theta_2"])
    with pytest.raises(graphkin.CallError, match=f"designs {key}: changes more than dimensions: cams"):
        ready.over({key: [50, 60]})


def test_a_rate_that_follows_from_the_lengths_has_no_designs():
    driver = {"link": "1", "angle": 60, "speed": 2000, "of": "C"}
    ready = graphkin.prepare(FOUR_BAR | {"driver": driver}, find=["v_C"])
    with pytest.raises(graphkin.CallError, match="the driver's value or rate is given by a dead point"):
        ready.over({"links.1.length": [140, 150]})


def test_each_design_that_does_not_turn_fully_has_its_own_range():
    designs = {"links.1.length": np.array([180.0, 300.0])}
    found = graphkin.prepare(FOUR_BAR, find=["omega_3"]).over(designs).sweep(6)
    for k, length in enumerate(designs["links.1.length"].tolist()):
        anew = graphkin.prepare(applied(FOUR_BAR, ("links.1.length",), (length,)), find=["omega_3"]).sweep(6)
        assert anew.driver.tolist() == pytest.approx(found.driver[k].tolist(), rel=1e-12)


def test_an_angle_at_a_joint_is_not_given_over_designs():
    with pytest.raises(graphkin.CallError, match="gamma_4-5 are not given over designs"):
        graphkin.prepare(SHAPER, find=["v_C", "gamma_4-5"]).over({"links.2.length": [80, 90]})


def test_the_table_of_a_design_keeps_the_assembly_of_the_scene_as_its_arrays_do():
    # the sketch lies so near to the line from B to D that it would choose the other assembly where D stands higher
    scene = scenes.four_bar(178, 241, 118, 184, sketch={"C": [123.4, 85.9], "E": [900, -100]})
    scene["frame"]["guides"] = {"h": {"through": [0, -100], "angle": 0}}
    scene["links"] |= {"6": {"points": ["C", "E"], "length": 193}, "7": {"points": ["E"], "on": "4.h"}}
    scene["driver"]["angle"] = 71
    turn = graphkin.prepare(scene, find=["C"]).over({"frame.points.D.y": [40]}).sweep(8)
    assert turn.ok[0].tolist() == (turn.table["status"] == "ok").tolist()
    assert np.isfinite(turn["C"][0]).tolist() == np.isfinite(turn.table["x_C"]).tolist()
    assert not turn.ok.all()
