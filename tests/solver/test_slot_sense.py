"""Which way a swinging guide points where nobody says."""

import pytest

import graphkin
from graphkin.errors import Unsolvable


def shaper(height, rod=120.0, **more):
    return {
        "frame": {"points": {"A": [0, 280], "C": [0, 0]}, "guides": {"h": {"through": [0, height], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 122},
            "2": {"points": ["B"], "on": "3"},
            "3": {"points": ["C"], "at": {"D": [250, 0]}},
            "4": {"points": ["D", "E"], "length": rod},
            "5": {"points": ["E"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 50, "omega": -10},
        **more,
    }


def test_a_bar_whose_rod_reaches_only_below_the_pivot_points_down():
    solved = graphkin.solve(shaper(-300))
    assert solved["D"][0].imag < 0
    assert solved["s_2/3"][0] < 0
    assert graphkin.check(shaper(-300)).ok


def test_a_bar_whose_rod_reaches_above_points_up_as_the_rule_says():
    assert graphkin.solve(shaper(200))["D"][0].imag > 0


def test_a_sketch_is_kept_and_where_both_ways_would_do_the_rule_stands():
    assert graphkin.solve(shaper(0, 400.0))["D"][0].imag > 0
    with pytest.raises(Unsolvable):
        graphkin.check(shaper(-300, sketch={"D": [50, 250]}))


def test_it_is_said_that_the_guide_was_turned():
    assert "no sketch says where D lies" in graphkin.explain(shaper(-300)).text
    assert "no sketch says" not in graphkin.explain(shaper(200)).text


def test_a_sweep_goes_from_the_assembly_that_was_taken():
    turn = graphkin.sweep(shaper(-300), positions=12, find=["D", "v_E"])
    assert 12 == turn.good
    assert turn["D"].imag.max() < 0
