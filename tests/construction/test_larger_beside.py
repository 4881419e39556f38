"""Groups of more than two links beside a cam by its law, and beside what rolls on them."""

from __future__ import annotations

import copy
import math

import pytest

from graphkin import check, solve

TRIAD = {
    "frame": {
        "name": "1", "points": {"A": [0, 0], "G": [150, -20], "N": [100, 110], "O": [-40, -60]},
        "guides": {"h": {"through": [0, 86], "angle": 0}},
    },
    "links": {
        "2": {"points": ["A", "B"], "length": 25}, "3": {"points": ["B", "C"], "length": 70},
        "4": {"points": ["C", "D"], "length": 60, "at": {"E": {"from": ["C", "D"], "r": [50, 52], "side": "left"}}},
        "5": {"points": ["G", "D"], "length": 65}, "6": {"points": ["E"], "on": "1.h"},
    },
    "driver": {"link": "2", "angle": 60, "omega": 10, "alpha": 3},
    "sketch": {"C": [70, 55], "D": [130, 45], "E": [105, 86]},
}


def pinion():
    """A pinion rolls on the group's slider, a rack."""
    made = copy.deepcopy(TRIAD)
    made["links"]["7"] = {"points": ["N", "P"], "length": 10, "start": 15}
    made["gears"] = {"g": {"between": ["7", "6"], "teeth": [12, "rack"]}}
    return made


def cam():
    """A cam swings the crank that moves the group."""
    made = copy.deepcopy(TRIAD)
    made["links"]["9"] = {"points": ["O"]}
    law = [{"to": 180, "rise": 15, "by": "345"}, {"to": 360, "fall": 15, "by": "cycloidal"}]
    made["cams"] = {"9": {"follower": "2", "law": law, "base": {"r": 80}, "roller": 5}}
    made["driver"] = {"link": "9", "angle": 30, "omega": 10, "alpha": -4}
    return made


@pytest.mark.parametrize("made", [pinion, cam])
def test_the_drawing_agrees_with_the_solver_on_larger_groups_beside(made):
    scene = made()
    result = check(scene, at=scene["driver"]["angle"] + 9)
    assert result.ok
    for row in result.report.rows:
        assert row.exact == pytest.approx(row.reading.value, rel=1e-8, abs=1e-8)


@pytest.mark.parametrize("at", [95, 300])
def test_a_rack_beside_a_cam_by_its_law_stands_as_far_on_its_guide_as_its_wheel_has_turned(at):
    scene = {
        "frame": {"points": {"A": [0, 0]},
                  "guides": {"g": {"through": [8, 0], "angle": 90}, "r": {"through": [0, -60], "angle": 15}}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["B"], "on": "0.g"}, "3": {"points": ["R"], "on": "0.r"}},
        "cams": {"1": {"follower": "2", "base": {"r": 32}, "roller": 9,
                       "law": [{"to": 180, "rise": 24, "by": "cycloidal"}, {"to": 360, "fall": 24, "by": "345"}]}},
        "gears": {"g": {"between": ["1", "3"], "teeth": [40, "rack"]}},
        "driver": {"link": "1", "angle": 50, "omega": 8},
    }
    found = check(scene, at=at, find=["x_R", "y_R"])
    radius = math.sin(math.radians(75)) * 60  # the rack's line passes the axis at this distance, below it
    for name, part in (("x_R", math.cos), ("y_R", math.sin)):
        expected = radius * math.radians(at - 50) * part(math.radians(15)) - (60 if name == "y_R" else 0)
        assert expected == pytest.approx(found[name].measured, abs=1e-6)
        assert expected == pytest.approx(found[name].exact, abs=1e-6)


@pytest.mark.parametrize("made", [pinion, cam])
def test_their_rates_are_the_differences_of_their_places(made):
    scene = made()
    at, rate, step = scene["driver"]["angle"] + 9, scene["driver"]["omega"], 1e-5
    before, here, after = (
        solve(scene, at=at + math.degrees(k * step)).data["positions"][0]["links"] for k in (-1, 0, 1)
    )
    for name, link in here.items():
        slope = (after[name]["angle"] - before[name]["angle"]) / (2 * step)
        assert slope * rate == pytest.approx(link["omega"], abs=1e-6)


def test_a_wheel_off_the_way_to_what_is_asked_is_left_out_beside_a_cam():
    scene = {
        "frame": {"points": {"A": [0, 0], "C": [80, 0], "W": [-90, 0]}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["C", "B"], "length": 70},
                  "9": {"points": ["W"], "start": 10}},
        "cams": {"1": {"follower": "2", "base": {"r": 35}, "roller": 8,
                       "law": [{"to": 180, "rise": 25, "by": "345"}, {"to": 360, "fall": 25, "by": "345"}]}},
        "gears": {"g": {"between": ["1", "9"], "teeth": [20, 30]}},
        "driver": {"link": "1", "angle": 40, "omega": 10}, "find": ["a_B"],
    }
    assert check(scene).ok


def test_beside_a_cam_links_are_followed_as_far_round_as_a_crank_drives_it():
    law = [{"to": 120, "rise": 20, "by": "345"}, {"to": 180}, {"to": 300, "fall": 20, "by": "cycloidal"}, {"to": 360}]
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [200, 0]}, "guides": {"g": {"through": [0, 0], "angle": 90}}},
        "links": {"5": {"points": ["D", "G"], "length": 50}, "6": {"points": ["G", "H"], "length": 190},
                  "1": {"points": ["A", "H"], "length": 90}, "2": {"points": ["K"], "on": "0.g"}},
        "cams": {"1": {"follower": "2", "law": law, "base": {"r": 40}, "roller": 10}},
        "driver": {"link": "5", "angle": 70, "omega": 5},
    }
    for at in (-60, 170, 430):
        result = check(scene, at=at)
        assert (True, True) == (result.ok, result.complete)


@pytest.mark.parametrize("below", [False, True])
def test_a_follower_that_is_a_cam_itself_turns_its_own_follower_on_either_side(below):
    rise = [{"to": 120, "rise": 25, "by": "345"}, {"to": 180}, {"to": 300, "fall": 25, "by": "harmonic"}, {"to": 360}]
    scene = {
        "frame": {"points": {"A": [0, 0], "C": [80, 0], "Q": [160, 10]}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["C", "B"], "length": 70},
                  "7": {"points": ["Q", "S"], "length": 60}},
        "cams": {
            "1": {"follower": "2", "law": rise, "base": {"r": 35}, "roller": 8},
            "2": {"follower": "7", "base": {"r": 45}, "roller": 5,
                  "law": [{"to": 180, "rise": 20, "by": "345"}, {"to": 360, "fall": 20, "by": "345"}]},
        },
        "driver": {"link": "1", "angle": 40, "omega": 10}, "sketch": {"B": [30, -40 if below else 40]},
    }
    for at in (70, 215):
        result = check(scene, at=at)
        assert (True, True) == (result.ok, result.complete)
