"""``graphkin.prepare``: the values are those of ``solve`` in the scene's units, within the bounds that are told."""

from __future__ import annotations

import math
import pickle
import sys
from importlib.util import find_spec

import numpy as np
import pytest

import graphkin
from graphkin.api.prepared import Prepared
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.symbol import Symbol
from graphkin.solver.compiled import kernel
from tests import scenes
from tests.mechanisms import KINDS, random_scene

ASKED = ["C", "v_C", "a_C", "a_B@4", "v_C/B", "omega_4", "alpha_4", "theta_4", "s_3/4"]


def shaper(**wishes: bool) -> Prepared:
    return graphkin.prepare("shaper-scheme-2", find=ASKED, **wishes)


@pytest.fixture
def without_numba(monkeypatch):
    caches = kernel._library, kernel._compiled
    for cache in caches:
        cache.cache_clear()
    monkeypatch.setitem(sys.modules, "numba", None)
    yield
    for cache in caches:
        cache.cache_clear()


def test_a_turn_has_the_values_of_solve_in_the_units_of_the_scene():
    samples, motion = shaper().sweep(30), graphkin.solve("shaper-scheme-2", sweep=30).motion
    assert motion.velocity("C") * 1000 == pytest.approx(samples["v_C"], abs=1e-9)
    assert motion.acceleration("B", "4") * 1000 == pytest.approx(samples["a_B@4"], abs=1e-8)
    assert motion.slide("3/4")[0] * 1000 == pytest.approx(samples["s_3/4"], abs=1e-9)
    assert motion.omega("4") == pytest.approx(samples["omega_4"], abs=1e-12)
    assert np.degrees(motion.angle("4")) == pytest.approx(samples["theta_4"], abs=1e-9)


def test_one_position_is_that_of_solve_at_the_same_degrees():
    motion = graphkin.solve("shaper-scheme-2", at=100).motion
    assert complex(motion.velocity("C")[0]) * 1000 == pytest.approx(complex(*shaper().at(100)[2:4]), abs=1e-9)


def test_given_values_are_those_of_the_sweep_there():
    ready = shaper()
    turn = ready.sweep(50)
    assert ready.columns(turn.driver).values == pytest.approx(turn.values, abs=1e-7)


def test_velocity_is_the_rate_of_the_place():
    ready, step = shaper(), 1e-4
    seconds = np.radians(step) / abs(ready.mechanism.drivers[0].values[1])
    turn = ready.sweep(20)
    before, after = (ready.columns(turn.driver + d)["C"] for d in (step, -step))  # it turns clockwise
    assert turn["v_C"] == pytest.approx((after - before) / (2 * seconds), abs=1e-3)


def test_a_driven_slide_takes_travel_in_the_unit_of_the_scene():
    ready = graphkin.prepare("hydraulic-cylinder", find=["omega_1"])
    value = ready.sweep(5).driver[2]
    omega = graphkin.solve("hydraulic-cylinder", at=float(value)).motion.omega("1")
    assert omega[0] == pytest.approx(ready.at(float(value))[0], rel=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_no_value_is_further_from_that_of_solve_than_both_bounds_say(kind):
    scene = graphkin.read(random_scene(3, (kind, "RRR"))).mechanism
    links = [link.name for link in scene.links]
    asked = [f"{what}_{link}" for link in links for what in ("omega", "alpha")] + [f"a_{p}" for p in scene.holders]
    samples, motion = graphkin.prepare(scene, find=asked, bounds=True).sweep(40), graphkin.solve(scene, sweep=40).motion
    both = samples.ok & motion.ok
    assert both.any()
    for name in asked:
        metres = scene.units.metres if name.startswith("a_") else 1.0
        exact = motion.value(Symbol.parse(name)) / metres
        size = {"o": motion.bound.omega, "a": motion.bound.alpha}[name[0]]
        known = (motion.bound.acceleration if name.startswith("a_") else size) / metres
        off = np.abs(samples[name] - exact)[both]
        assert (off <= (1.5 * samples.bound(name) + known)[both]).all(), name


def test_bounds_that_were_not_asked_for_are_refused():
    with pytest.raises(graphkin.CallError, match="bounds=True"):
        shaper().sweep(3).bound("v_C")


def test_the_bounds_of_a_shaper_are_a_few_roundings():
    samples = shaper(bounds=True).sweep(100)
    assert np.max(samples.bound("v_C")) < 1e-12 * np.abs(samples["v_C"]).max()


@pytest.mark.skipif(find_spec("numba") is None, reason="the extra fast is not installed")
def test_compiled_samples_are_those_of_numpy():
    slow, fast = (graphkin.prepare("shaper-scheme-2", find="v_C", fast=fast).sweep(1000) for fast in (False, True))
    assert np.abs(fast.values - slow.values).max() < 2e-14 * np.abs(slow.values).max()


def test_positions_out_of_reach_have_no_numbers():
    samples = graphkin.prepare("sixbar-AE70", find="v_C").columns([50, 180])
    assert [True, False] == samples.ok.tolist()
    assert [False, True] == np.isnan(samples["v_C"]).tolist()


def test_a_larger_group_is_served_too():
    samples = graphkin.prepare("double-butterfly", find=["v_E"], bounds=True).sweep(3)
    motion = graphkin.solve("double-butterfly", sweep=3).motion
    off = np.abs(samples["v_E"] - motion.velocity("E") / motion.scene.units.metres)
    assert (off <= samples.bound("v_E")).all()


def test_the_table_of_a_prepared_mechanism_is_the_table_of_a_sweep():
    name, asked = "sixbar-AE70", ["v_C", "omega_4"]  # a motion with ends
    assert graphkin.sweep(name, positions=9, find=asked).table == graphkin.prepare(name, find=asked).sweep(9).table


@pytest.mark.parametrize("name", ["sixbar-AE70", "hydraulic-cylinder"])
def test_positions_that_are_given_have_the_rows_of_a_sweep_that_meets_them(name):
    link = mechanism_of(name).links[-1].name
    ready = graphkin.prepare(name, find=[f"omega_{link}"])
    turn, given = ready.sweep(8), ready.columns(ready.sweep(8).driver)
    assert turn.table["status"].tolist() == given.table["status"].tolist()
    assert turn.table["why"].tolist() == given.table["why"].tolist()
    for head in turn.table.heads[:-2]:
        np.testing.assert_allclose(turn.table[head], given.table[head], rtol=1e-9, err_msg=head)


@pytest.mark.parametrize(("find", "what"), [("v_Q", "Q"), (["omega_9"], "9"), ([], "nothing")])
def test_what_names_nothing_is_refused(find, what):
    with pytest.raises(graphkin.CallError, match=what):
        graphkin.prepare("shaper-scheme-2", find=find)


def test_a_quantity_that_was_not_asked_for_is_refused_with_what_was():
    with pytest.raises(graphkin.CallError, match="v_C"):
        graphkin.prepare("shaper-scheme-2", find="v_C").sweep(3)["v_B"]


def test_values_are_put_where_they_are_wished():
    ready = graphkin.prepare("shaper-scheme-2", find="v_C")
    out = np.empty((2, 50))
    assert ready.sweep(50, out).values is out
    assert ready.sweep(50).values.tolist() == out.tolist()


@pytest.mark.parametrize("out", [np.empty((2, 49)), np.empty((2, 50), order="F"), np.empty((2, 50), dtype="f4")])
def test_room_that_does_not_fit_is_refused(out):
    with pytest.raises(graphkin.CallError, match=r"\(2, 50\)"):
        graphkin.prepare("shaper-scheme-2", find="v_C").sweep(50, out)


@pytest.mark.parametrize("n", [0, 1.5, -3, 10**10])
def test_no_number_of_positions_is_refused(n):
    with pytest.raises(graphkin.CallError, match="positions"):
        graphkin.prepare("shaper-scheme-2", find="v_C").sweep(n)


def test_a_scene_of_the_tests_without_units_is_in_millimetres():
    assert "mm/s" == graphkin.prepare(mechanism_of_text(scenes.FOUR_BAR, "f"), find="v_C").units["v_C"]


def test_without_numba_many_positions_are_computed_in_numpy(without_numba):
    samples = graphkin.prepare("shaper-scheme-2", find="omega_4").sweep(500_000)
    assert samples.ok.all()


def test_compiling_without_numba_says_what_to_install(without_numba):
    with pytest.raises(graphkin.CallError, match=r"graphkin\[fast\]"):
        shaper(fast=True).sweep(10)


@pytest.mark.parametrize(("name", "along"), [("slider-crank-offset", "v_C"), ("engine-gas-force", "a_B")])
def test_a_component_that_is_nothing_but_rounding_is_0_wherever_it_is_read(name, along):
    turn = graphkin.prepare(name, find=[along]).sweep(100)
    swept = graphkin.sweep(name, positions=100, find=[along]).table
    assert turn.values[1].any()  # what the engine gives has the residues
    assert [0.0] * 100 == turn[f"{along}.y"].tolist() == turn[along].imag.tolist()
    assert [0.0] * 100 == [*turn.table[f"{along}.y"]] == [*swept[f"{along}.y"]]


def test_a_small_value_that_is_no_rounding_is_read_as_it_is():
    tiny = {
        "frame": {"points": {"A": [0, 0], "D": [400, 0]}},
        "links": {"1": {"points": ["A", "B"], "length": 100, "at": {"E": {"from": "A", "r": 1e-9, "angle": 20}}},
                  "2": {"points": ["B", "C"], "length": 350}, "3": {"points": ["D", "C"], "length": 290}},
        "driver": {"link": "1", "angle": 30, "omega": 10},
        "sketch": {"C": [300, 280]},
    }
    assert [1e-8] * 9 == pytest.approx(np.abs(graphkin.prepare(tiny, find=["v_E"]).sweep(9)["v_E"]).tolist(), rel=1e-9)


def rack_of_a_rocking_crank() -> Prepared:
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [100, 0]}, "guides": {"h": {"through": [0, 40], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 60},
            "2": {"points": ["B", "C"], "length": 40},
            "3": {"points": ["D", "C"], "length": 50},
            "4": {"on": "0.h"},
        },
        "gears": {"g": {"between": ["1", "4"], "teeth": [20, "rack"], "carrier": "0"}},
        "driver": {"link": "1", "angle": 30, "omega": 2},
    }
    return graphkin.prepare(scene, find=["s_4/0", "omega_3"])


def test_a_rack_stands_where_the_way_that_the_motion_can_go_brings_it():
    ready = rack_of_a_rocking_crank()
    solved = graphkin.solve(ready.source, sweep=12)
    for samples in (ready.sweep(12), ready.over({"links.3.length": [50]}).sweep(12)):
        assert np.asarray(solved["s_4/0"]) == pytest.approx(np.ravel(samples["s_4/0"]), nan_ok=True)
    assert np.rad2deg(solved.motion.values[:, 0]) == pytest.approx(ready.sweep(12).driver)


def test_a_rack_never_comes_to_an_angle_that_lies_a_turn_beyond_the_end_of_the_motion():
    ready = rack_of_a_rocking_crank()
    assert (None, pytest.approx(ready.columns([20])["s_4/0"][0])) == (ready.at(380), ready.at(20)[0])
    assert np.isnan(ready.columns([380])["s_4/0"]).all()


def test_bounds_of_a_component_a_distance_and_an_angle_between_links_follow_from_those_of_their_parts():
    names = ["A", "C", "a_C", "theta_3", "theta_4", "x_C", "a_C.x", "d_A/C", "theta_3/4"]
    samples = graphkin.prepare("shaper-scheme-2", find=names, bounds=True).sweep(12)
    bound = samples.bound
    assert bound("C").tolist() == bound("x_C").tolist()
    assert bound("a_C").tolist() == bound("a_C.x").tolist()
    assert np.isfinite(bound("a_C")).all()
    rounding = 2.0**-51 * samples["d_A/C"]
    assert bound("A") + bound("C") + rounding == pytest.approx(bound("d_A/C"), rel=1e-12, abs=0)
    of_angles = np.degrees(16 * 2.0**-53)
    assert bound("theta_3") + bound("theta_4") - of_angles == pytest.approx(bound("theta_3/4"), rel=1e-12, abs=0)


def test_the_values_of_a_sweep_with_bounds_are_those_of_its_names_alone():
    bounded, alone = (graphkin.prepare("shaper-scheme-2", find=["v_C", "omega_4"], bounds=b) for b in (True, False))
    assert alone.sweep(4).values.tolist() == bounded.sweep(4).values.tolist()


def test_bounds_go_with_a_sweep_to_another_process():
    samples = graphkin.prepare("shaper-scheme-2", find=["v_C"], bounds=True).sweep(4)
    assert samples.bound("v_C").tolist() == pickle.loads(pickle.dumps(samples)).bound("v_C").tolist()


def test_bounds_of_what_nobody_estimates_are_unknown():
    names = ["v_3/4", "ak_A@3/A@4", "gamma_4-5"]
    samples = graphkin.prepare("shaper-scheme-2", find=names, bounds=True).sweep(3)
    assert {math.inf} == {x for name in names for x in samples.bound(name).tolist()}


def test_a_quantity_asked_twice_has_its_column_and_its_bound_once():
    ready = graphkin.prepare("shaper-scheme-2", find=["v_C", "omega_4", "v_C", "v_C.x"], bounds=True)
    alone = graphkin.prepare("shaper-scheme-2", find="omega_4", bounds=True)
    assert ("v_C.x", "v_C.y", "omega_4") == ready.names
    assert alone.sweep(4).bound("omega_4").tolist() == ready.sweep(4).bound("omega_4").tolist()


def test_the_coordinates_of_a_point_have_the_columns_of_tables_and_share_them_with_the_place():
    ready = graphkin.prepare("shaper-scheme-2", find=["C", "x_C"])
    assert ("x_C", "y_C") == ready.names
    assert {"x_C (mm)", "y_C (mm)"} <= set(graphkin.solve("shaper-scheme-2", find=["C"]).table.heads)
    assert graphkin.solve("shaper-scheme-2", at=15)["C"][0] == pytest.approx(complex(*ready.at(15)), rel=1e-12)


def test_a_force_and_its_component_share_a_column():
    ready = graphkin.prepare("shaper-forces", find=["F_5/6.y", "F_5/6", "M_2"])
    assert ("F_5/6.y", "F_5/6.x", "M_2") == ready.names
    assert ready["F_5/6"].imag.tolist() == ready["F_5/6.y"].tolist()
    assert graphkin.solve("shaper-forces")["F_5/6"] == pytest.approx(ready["F_5/6"], rel=1e-12)


def test_a_moment_that_is_rounding_alone_is_0_and_its_bound_is_that_of_moments():
    ready = graphkin.prepare("shaper-forces", find=["M_6/1", "M_2"], bounds=True)
    forces = graphkin.solve("shaper-forces").forces
    assert 0.0 == ready.at(ready.here)[0]
    assert [forces.bound[1][0]] == pytest.approx(ready.columns([ready.here]).bound("M_2"), rel=1e-6, abs=0)
