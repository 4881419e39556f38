"""Dead points: recognised exactly there, told apart by kind, and right a hundredth of a degree away."""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest

from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.solver import Motion, solve
from tests import scenes


def at(text: str, value: float) -> Motion:
    return solve(mechanism_of_text(text, "scene"), at={"1": np.radians(value)})


# crank 300, rod 200, rocker 300, ground 400: the crank turns back where 200 + 300 reach across
RIGHT = """
[frame]
points = { A = [0, 0], D = [400, 0] }
[links.1]
points = ["A", "B"]
length = 300
[links.2]
points = ["B", "C"]
length = 200
[links.3]
points = ["C", "D"]
length = 300
[driver]
link = "1"
angle = {angle}
omega = 10
[sketch]
C = [300, 280]
"""


def test_the_end_of_a_motion_is_a_dead_point() -> None:
    # 3-4-5: at 90 deg B and D are 500 apart, rod and rocker in line
    assert at(RIGHT.replace("{angle}", "60"), 90).status[0] == "dead point"


def test_a_rate_is_infinite_at_the_end_of_a_motion() -> None:
    assert "a rate is infinite" in at(RIGHT.replace("{angle}", "60"), 90).why[0]


def test_the_links_in_line_are_named() -> None:
    assert "links 2, 3 have BC and CD in line" in at(RIGHT.replace("{angle}", "60"), 90).why[0]


def test_a_scene_in_a_dead_point_says_so() -> None:
    assert solve(mechanism_of_text(RIGHT.replace("{angle}", "90"), "scene")).status[0] == "dead point"


def test_a_position_just_beyond_the_end_is_not_assembled() -> None:
    assert at(RIGHT.replace("{angle}", "60"), 90.01).status[0] == "not assembled"


def test_a_hundredth_of_a_degree_before_the_end_the_rocker_is_right() -> None:
    found = at(RIGHT.replace("{angle}", "60"), 89.99).omega("3")[0]
    with mp.workdps(50):
        crank = mp.radians(mp.mpf("89.99"))

        def rocker(t: mp.mpf) -> mp.mpf:
            b = mp.mpf("0.3") * mp.expj(crank + 10 * t)
            line = b - mp.mpf("0.4")
            c = abs(line)
            inside = (mp.mpf("0.09") + c * c - mp.mpf("0.04")) / (2 * mp.mpf("0.3") * c)
            return mp.arg(line) - mp.acos(inside)

        expected = float(mp.diff(rocker, 0))
    assert found == pytest.approx(expected, rel=1e-9)


def test_the_velocity_is_not_unique_where_a_parallelogram_is_in_line() -> None:
    assert "not unique" in at(scenes.PARALLELOGRAM, 180).why[0]


def test_a_hundredth_of_a_degree_before_the_line_a_parallelogram_is_right() -> None:
    assert at(scenes.PARALLELOGRAM, 179.99).omega("3")[0] == pytest.approx(10.0, rel=1e-9)


def test_a_hundredth_of_a_degree_after_the_line_a_parallelogram_is_right() -> None:
    assert at(scenes.PARALLELOGRAM, 180.01).omega("3")[0] == pytest.approx(10.0, rel=1e-9)


def test_a_guide_through_its_own_pin_has_no_direction() -> None:
    assert "B and C fall together" in at(scenes.EQUAL_GUIDE, 270).why[0]


def test_a_driven_piston_stands_at_a_dead_point_where_crank_and_rod_are_in_line() -> None:
    motion = solve(mechanism_of_text(scenes.PISTON, "scene"), at={"3/0": 0.17})
    assert motion.status[0] == "dead point"


def test_a_driven_piston_does_not_go_beyond_crank_and_rod_in_line() -> None:
    motion = solve(mechanism_of_text(scenes.PISTON, "scene"), at={"3/0": 0.171})
    assert "170 mm" in motion.why[0]


def test_guides_that_become_parallel_end_the_motion() -> None:
    text = scenes.TWO_SLOTS
    # the slot of crank 1 stands at 70 deg to it, the guide at 15: parallel at crank -55 and 125
    assert "parallel guides at 1 = 125 deg" in at(text, 140).why[0]


def test_a_larger_group_at_its_limit_is_dead_or_out_of_reach() -> None:
    scene = mechanism_of_text(scenes.FLOATING, "scene")
    why = solve(scene, at={"2": np.radians(90)}).why[0]
    limit = float(why.split("2 = ")[1].split(" deg")[0])
    near = solve(scene, at={"2": np.radians(limit - 0.01)})
    crank = solve(mechanism_of_text(scenes.FOUR_BAR, "scene"), at={"1": float(near.angle("1")[0])})
    assert crank.omega("3")[0] / crank.omega("2")[0] == pytest.approx(near.omega("3")[0] / near.omega("2")[0], rel=1e-6)


APART = """
[frame]
points = { A = [0, 0] }
guides = { v = { through = [100, 0], angle = 90 } }
[links.1]
points = ["A"]
[links.4]
points = ["B"]
on = "0.v"
[pins.B]
of = "4"
in = "1"
[driver]
link = "1"
angle = 50
omega = 1.5
"""


def test_parallel_guides_that_lie_apart_are_no_dead_point() -> None:
    motion = at(APART, 90)
    assert ("not assembled", True) == (motion.status[0], "meet nowhere" in motion.why[0])


@pytest.mark.parametrize("tilt", [0, 30])
def test_a_slot_parallel_to_its_own_guide_is_never_assembled(tilt: float) -> None:
    yoke = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"x": {"through": [0, 0], "angle": tilt}}},
        "links": {"1": {"points": ["A", "B"], "length": 50}, "2": {"points": ["B"], "on": "3.s"},
                  "3": {"on": "0.x", "guides": {"s": {"through": [0, 0], "angle": 0}}}},
        "driver": {"link": "1", "angle": 50, "omega": 1},
    }
    motion = solve(mechanism_of(yoke))
    said = "links 2, 3 have guides that are parallel in every position: they meet nowhere, or all along"
    assert ("not assembled", said) == (motion.status[0], motion.why[0])


def test_parallel_guides_in_one_line_are_a_dead_point() -> None:
    assert "dead point" == at(APART.replace("[100, 0]", "[0, 0]"), 90).status[0]


@pytest.mark.parametrize("at", [0.9, 1.0])  # a root of the second parallelogram that is rounding lay beyond the start
def test_two_parallelograms_in_line_are_left_in_the_assembly_of_the_rule(at: float) -> None:
    bars = {"1": ("AB", 60), "2": ("BC", 100), "3": ("CD", 60), "4": ("CF", 110), "5": ("FG", 60)}
    motion = solve(mechanism_of({
        "frame": {"points": {"A": [0, 0], "D": [100, 0], "G": [210, 0]}},
        "links": {name: {"points": [*ends], "length": length} for name, (ends, length) in bars.items()},
        "driver": {"link": "1", "angle": 0, "omega": 1},
    }), at={"1": np.radians(at)})
    assert pytest.approx([1.0, 1.0]) == [motion.omega(name)[0] for name in ("3", "5")]
