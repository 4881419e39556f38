"""From the scene's position to other driver values: the assembly is kept, limits are named, nothing jumps."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import SimpleNamespace
from typing import Any

import mpmath as mp
import numpy as np
import pytest

import graphkin
from graphkin.api.report_text import report_text
from graphkin.errors import CallError, Unsolvable
from graphkin.scene import library, mechanism_of, mechanism_of_text
from graphkin.solver import Motion, driver_range, solve
from graphkin.solver.algebra.pose import Array
from graphkin.solver.compiled.engine import group_at
from graphkin.solver.path import continuity
from graphkin.solver.path.continuity import At, _passed, _walk_group
from tests import scenes
from tests.mechanisms import redriven

ROCKER = (
    scenes.FOUR_BAR.replace("length = 150", "length = 350")
    .replace("length = 500", "length = 200")
    .replace("angle = 60", "angle = 20")
)


def at(text: str, value: float, key: str = "1") -> Motion:
    return solve(mechanism_of_text(text, "scene"), at={key: np.radians(value)})


def law_of_cosines(diagonal: float, a: float, b: float) -> float:
    return float(np.degrees(np.arccos((a * a + b * b - diagonal * diagonal) / (2 * a * b))))


def test_a_parallelogram_stays_one_through_its_change_points() -> None:
    motion = solve(mechanism_of_text(scenes.PARALLELOGRAM, "scene"), sweep=50)
    assert np.abs(motion.omega("2")[motion.ok]).max() < 1e-9


def test_a_parallelogram_that_begins_in_line_takes_the_form_of_the_rule() -> None:
    motion = solve(mechanism_of_text(scenes.PARALLELOGRAM.replace("angle = 60", "angle = 0"), "scene"), sweep=50)
    assert np.abs(motion.omega("2")[motion.ok]).max() < 1e-9


def test_a_path_places_links_beside_its_change_points_where_a_group_has_no_assembly() -> None:
    path = driver_range(mechanism_of_text(scenes.PARALLELOGRAM, "scene")).ahead
    crank, rocker = (path.placed(path.flips).poses[link].u for link in "13")
    assert 2 == len(path.flips)
    assert np.abs(crank - rocker).max() < 1e-9  # 2e-8 in the change point itself


def test_an_antiparallelogram_stays_one_through_its_change_points() -> None:
    text = scenes.PARALLELOGRAM.replace("C = [350, 87]", "C = [250, -40]")
    motion = solve(mechanism_of_text(text, "scene"), sweep=50)
    assert motion.omega("3")[motion.ok].max() < 0  # the cranks turn against each other all the time


def test_a_guide_bar_whose_crank_is_as_long_as_its_ground_goes_on_smoothly() -> None:
    motion = solve(mechanism_of_text(scenes.EQUAL_GUIDE, "scene"), sweep=37)
    # half the angle of the crank (peripheral angle), also after the crank pin has passed the pivot of the bar
    crank = 10 + 360 * np.arange(37) / 37
    assert np.degrees(motion.angle("3")) == pytest.approx(45 + crank / 2, abs=1e-9)


@pytest.mark.parametrize("name", library())
def test_a_sweep_gives_each_position_as_if_it_were_asked_alone(name: str) -> None:
    scene = mechanism_of(name)
    motion = solve(scene, sweep=4)
    key = scene.drivers[0].key
    for k in np.flatnonzero(motion.ok)[1:]:
        alone = solve(scene, at={key: float(motion.values[k, 0])})
        for link in scene.links:
            assert alone.poses[link.name].u[0] == pytest.approx(motion.poses[link.name].u[k], abs=1e-12)


def test_a_sweep_goes_in_the_sense_of_the_driver() -> None:
    scene = mechanism_of_text(scenes.FOUR_BAR.replace("omega = 10", "omega = -10"), "scene")
    assert np.degrees(solve(scene, sweep=4).values[:, 0]) == pytest.approx([60, -30, -120, -210])


def test_angles_of_a_sweep_count_whole_turns_of_a_fast_bar() -> None:
    # at crank 180 the bar turns 50 times as fast; 8 positions are far too few to see its turns from them alone
    text = scenes.EQUAL_GUIDE.replace("length = 100", "length = 101")
    few, many = (solve(mechanism_of_text(text, "scene"), sweep=n).angle("3") for n in (4, 3600))
    assert few == pytest.approx(many[::900], abs=1e-9)


def test_an_unreachable_angle_names_the_limit_to_full_accuracy() -> None:
    why = at(ROCKER, 170).why[0]
    found = float(why.split("1 = ")[1].split(" deg")[0])
    assert found == pytest.approx(law_of_cosines(500, 400, 350), rel=1e-9)


def test_an_unreachable_angle_names_both_ends_of_the_motion() -> None:
    low, high = law_of_cosines(100, 400, 350), law_of_cosines(500, 400, 350)
    said = at(ROCKER, 170).why[0].rsplit("from ", 1)[1].replace(" deg", "").split(" to ")
    assert [float(x) for x in said] == pytest.approx([low, high], rel=1e-9)


def test_an_unreachable_angle_has_no_numbers() -> None:
    assert np.isnan(at(ROCKER, 170).omega("3")[0])


def test_require_raises_what_the_motion_says() -> None:
    with pytest.raises(Unsolvable, match="reaches from"):
        at(ROCKER, 170).require()


def test_an_angle_behind_a_limit_is_reached_the_other_way_round() -> None:
    # from 40 deg the straight way to 300 leads through 180, where rod and rocker do not reach
    text = (
        scenes.FOUR_BAR.replace("length = 150", "length = 320")
        .replace("length = 500", "length = 330")
        .replace("angle = 60", "angle = 40")
    )
    assert at(text, 300).angle("3") == pytest.approx(at(text, -60).angle("3"), abs=1e-12)


def test_positions_of_a_sweep_behind_a_limit_are_reached_the_other_way_round() -> None:
    motion = solve(mechanism_of("sixbar-AE70"), sweep=36)
    degrees = np.degrees(motion.values[:, 0]) % 360
    assert set(np.flatnonzero(motion.ok)) == set(np.flatnonzero((degrees < 58.99) | (degrees > 301.01)))
    # what is not reached either way stands where it was asked for
    asked = np.degrees(motion.values[0, 0]) + 10 * np.arange(36)
    assert np.degrees(motion.values[~motion.ok, 0]) == pytest.approx(asked[~motion.ok])


def test_more_than_a_turn_is_the_same_as_without_it() -> None:
    assert at(ROCKER, 20 + 720 + 30).angle("3") == pytest.approx(at(ROCKER, 50).angle("3"), abs=1e-12)


def test_a_slide_driver_is_swept_inside_its_range() -> None:
    motion = solve(mechanism_of_text(scenes.CYLINDER, "scene"), sweep=10)
    # A and C are 300 apart, the bar is 200: the cylinder reaches from 100 to 500
    assert motion.values[:, 0] == pytest.approx(0.1 + 0.4 * (np.arange(10) + 0.5) / 10, rel=1e-9)


def test_the_second_of_two_drivers_can_be_moved() -> None:
    scene = mechanism_of_text(scenes.ARM, "scene")
    assert np.degrees(solve(scene, at={"2": np.radians(-60)}).angle("2")[0]) == pytest.approx(-30, abs=1e-12)


def test_an_unknown_driver_is_named() -> None:
    with pytest.raises(CallError, match='at "7"'):
        at(scenes.FOUR_BAR, 10, "7")


def test_a_scene_that_does_not_reach_says_where_it_would() -> None:
    motion = solve(mechanism_of_text(ROCKER.replace("angle = 20", "angle = 100"), "scene"))
    assert motion.status[0] == "not assembled"
    assert f"1 = {law_of_cosines(500, 400, 350):.8g}"[:12] in motion.why[0]


# a larger group


def test_a_driven_coupler_moves_as_with_the_crank() -> None:
    floating = solve(mechanism_of_text(scenes.FLOATING, "scene"), at={"2": np.radians(40)})
    crank = solve(mechanism_of_text(scenes.FOUR_BAR, "scene"), at={"1": float(floating.angle("1")[0])})
    assert crank.angle("2")[0] == pytest.approx(np.radians(40), abs=1e-12)


def test_the_limit_of_a_larger_group_is_where_its_crank_turns_back() -> None:
    why = solve(mechanism_of_text(scenes.FLOATING, "scene"), at={"2": np.radians(90)}).why[0]
    limit = float(why.split("2 = ")[1].split(" deg")[0])
    # with the crank driven, the coupler stands still where it is most inclined
    scene = mechanism_of_text(scenes.FOUR_BAR, "scene")
    turn = solve(scene, sweep=720)
    k = int(np.argmax(turn.angle("2")))
    low, high = turn.values[k - 1, 0], turn.values[k + 1, 0]
    for _ in range(50):
        middle = (low + high) / 2
        rising = solve(scene, at={"1": middle}).omega("2")[0] > 0
        low, high = (middle, high) if rising else (low, middle)
    assert limit == pytest.approx(np.degrees(solve(scene, at={"1": low}).angle("2")[0]), rel=2e-10)


def test_the_limits_of_a_larger_group_are_exact_to_rounding() -> None:
    def inclination(crank: mp.mpf) -> mp.mpf:
        line = 400 - 150 * mp.expj(crank)
        return mp.arg(line) + mp.acos((500**2 + abs(line) ** 2 - 300**2) / (2 * 500 * abs(line)))

    with mp.workdps(40):
        turning_back = [mp.findroot(lambda x: mp.diff(inclination, x), guess) for guess in (1.0, 5.0)]
        right = [float(inclination(crank)) for crank in turning_back]
    reach = driver_range(mechanism_of_text(scenes.FLOATING, "scene"))
    assert right == pytest.approx(reach.value(np.array(reach.ends)).tolist(), abs=2e-15)


def test_a_larger_group_whose_links_go_away_is_followed_to_where_its_guides_are_parallel(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # a bar turns against another from parallel to parallel; steps grow with the distance, of which there were 2666
    steps: list[float] = []
    monkeypatch.setattr(continuity, "group_at", lambda *given: steps.append(0.0) or group_at(*given))
    reach = driver_range(mechanism_of(redriven(7007)))
    assert math.pi == pytest.approx(reach.ends[1] - reach.ends[0], abs=1e-12)
    assert len(steps) < 800


def test_a_larger_group_whose_links_fall_into_one_line_ends_there_to_rounding() -> None:
    # the scissors lie flat, and stand upright
    reach = driver_range(mechanism_of("scissor-lift"))
    assert [0.1, 0.9] == pytest.approx(reach.value(np.array(reach.ends)).tolist(), abs=3e-15)


def test_a_larger_group_comes_back_to_where_it_was() -> None:
    scene = mechanism_of_text(scenes.TRIAD, "scene")
    there = solve(scene, at={"1": np.radians(85)})
    assert there.status[0] == "ok"
    # a scene written at that position, sketched by what was found there, is followed back
    places = ", ".join(f"{p} = [{1000 * there.position(p)[0].real}, {1000 * there.position(p)[0].imag}]" for p in "CDE")
    text = (
        scenes.TRIAD.split("[sketch]")[0]
        .replace("angle = 50", "angle = 85")
        .replace("[frame]", f"sketch = {{ {places} }}\n[frame]")
    )
    again = solve(mechanism_of_text(text, "scene"), at={"1": np.radians(50)})
    assert again.position("E")[0] == pytest.approx(solve(scene).position("E")[0], abs=1e-14)


def moved(degrees: float) -> Motion:
    """The parallelogram whose plate is moved by a slider, with its cranks at an angle."""
    crank = np.radians(degrees)
    travel = 80 + 100 * np.sin(crank) + np.sqrt(400**2 - (500 - 150 - 100 * np.cos(crank)) ** 2)
    return solve(mechanism_of_text(scenes.MOVED_PARALLELOGRAM, "moved"), at={"6/0": float(travel) / 1000})


@pytest.mark.parametrize("degrees", [10, 0.01, -0.01, -1, -60])
def test_a_larger_group_passes_its_change_point_on_the_same_assembly(degrees: float) -> None:
    assert np.degrees(moved(degrees).angle("3")[0]) == pytest.approx(degrees, abs=1e-6)


def test_a_larger_group_at_its_change_point_is_dead() -> None:
    assert "not unique" in moved(0).why[0]


def test_a_sweep_of_a_larger_group_never_leaves_its_assembly() -> None:
    motion = solve(mechanism_of_text(scenes.MOVED_PARALLELOGRAM, "moved"), sweep=60)
    assert np.abs(motion.omega("2")[motion.ok]).max() < 1e-9


def _parallelogram() -> dict[str, object]:
    return {
        "frame": {"points": {"A": [0, 0], "D": [300, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 100},
            "2": {"points": ["B", "C"], "length": 300},
            "3": {"points": ["D", "C"], "length": 100},
        },
        "driver": {"link": "1", "angle": 50, "omega": 5},
        "sketch": {"C": [364, 76]},
    }


@pytest.mark.parametrize(("at", "places"), [(60, []), (200, [180]), (-60, [0]), (420, [180, 360])])
def test_where_two_assemblies_meet_on_the_way_is_told(at: float, places: list[float]) -> None:
    data = graphkin.solve(_parallelogram(), at=at).data
    assert [["2", "3"]] * len(places) == [one["links"] for one in data.get("passed", [])]
    found = [math.degrees(one["driver"]["1"]) for one in data.get("passed", [])]
    assert places == pytest.approx(found, abs=1e-6)


def test_a_report_says_which_branch_was_kept_and_how_to_ask_for_the_other() -> None:
    said = "links 2, 3: at 1 = 180° two assemblies meet; the motion was kept smooth through it."
    assert said in report_text(graphkin.check(_parallelogram(), at=200), "en")
    assert "在 1 = 180° 处两种装配形式重合" in report_text(graphkin.check(_parallelogram(), at=200), "zh")


ON_A_ROCKER = {  # a plate on three legs, moved by the rocker of a four-bar
    "frame": {"points": {"A": [0, 0], "D": [100, 0], "G": [330, -20], "H": [250, 220]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 30},
        "2": {"points": ["B", "C"], "length": 100},
        "3": {"points": ["D", "C"], "length": 70, "at": {"E": [90, 20]}},
        "4": {"points": ["E", "F"], "length": 97},
        "5": {"points": ["F", "K"], "length": 85, "at": {"L": [40, 60]}},
        "6": {"points": ["G", "K"], "length": 122},
        "7": {"points": ["H", "L"], "length": 69},
    },
    "driver": {"link": "1", "angle": 60, "omega": 10},
    "sketch": {"C": [104, 70], "E": [85, 91], "F": [180, 110], "K": [260, 80], "L": [238, 152]},
}


def test_a_larger_group_goes_on_where_the_rocker_that_moves_it_turns_back() -> None:
    dead = math.degrees(math.acos((100**2 + 130**2 - 70**2) / (2 * 100 * 130)))  # crank and coupler in line
    before = solve(mechanism_of(ON_A_ROCKER), at={"1": math.radians(dead - 20)})
    # seen from the other side of the line from pivot to joint C the crank moves the rocker to the same place
    other = 2 * float(np.angle(before.point("C").z[0])) - math.radians(dead - 20)
    after = solve(mechanism_of(ON_A_ROCKER), at={"1": other})
    assert dead < math.degrees(other) < 60
    for link in "34567":
        assert complex(before.poses[link].u[0]) == pytest.approx(complex(after.poses[link].u[0]), abs=1e-9)


def stopping(way: str, alone_within: float) -> At:
    """A group of one coordinate that stops halfway along the path of 0 to 2: goes back, goes on, dwells, or leaps."""
    ways = {
        "back": (lambda t: t * t, lambda t: 2 * t),
        "on": (lambda t: t**3, lambda t: 3 * t * t),
        "dwells": (lambda t: max(t, 0.0) ** 3, lambda t: 3 * max(t, 0.0) ** 2),
        "leaps": (abs, np.sign),
    }
    place, rate = ways[way]

    def at(t: float, _: Array) -> tuple[Any, Array]:
        found = np.array([[[0.1 * place(t - 1), 0.0, 0.0]]])

        def same(before: Array) -> bool:
            return float(np.abs(found[0] - before).max()) < alone_within

        told = SimpleNamespace(residual=[0.0], poses={}, place=found, determinant=[1.0], same_assembly=same)
        return told, np.array([[0.1 * rate(t - 1), 0.0, 0.0]])

    return at


@pytest.mark.parametrize("way", ["back", "on", "dwells", "leaps"])
@pytest.mark.parametrize(("alone_within", "end"), [(1e-3, None), (0.0, pytest.approx(1.0, abs=1e-6))])
def test_a_group_goes_on_from_where_it_stops_if_no_other_assembly_is_near(
    way: str, alone_within: float, end: float | None
) -> None:
    at = stopping(way, alone_within)
    assert end == _walk_group(at, at(0.0, np.zeros(1))[0].place[0], 1.0, 2.0, 0.05)[2]


def changing(beside: float) -> At:
    """A group of one link that passes a change point at 0.05, and lies this far beside its motion inside the step."""

    def at(t: float, _: Array) -> tuple[Any, Array]:
        x = 0.1 * t + (beside if 0.0 < t < 0.1 else 0.0)
        found = SimpleNamespace(residual=[0.0], poses={}, place=np.array([[[x, 0.0, 0.0]]]), determinant=[0.05 - t])
        return found, np.array([[0.1, 0.0, 0.0]])

    return at


@pytest.mark.parametrize(("beside", "flips"), [(0.0, [pytest.approx(0.05, abs=1e-6)]), (1e-4, [])])
def test_a_change_point_is_passed_only_along_the_smooth_motion(beside: float, flips: list[Any]) -> None:
    at = changing(beside)
    ends, slope = [at(t, np.zeros(1))[0] for t in (0.0, 0.1)], np.array([[0.1, 0.0, 0.0]])
    passed = _passed(at, 0.0, ends[0].place[0], slope, 0.1, ends[1], slope, np.ones(3))
    assert flips == ([passed[0]] if passed else [])


def behind_a_cam(law: Sequence[Mapping[str, object]]) -> dict[str, Any]:
    """A plate on three legs, moved by the follower of a cam."""
    return {
        "units": {"length": "mm"},
        "frame": {
            "points": {"A": [0, 0], "G": [130, 30], "H": [40, 190]},
            "guides": {"y": {"through": [0, 0], "angle": 90}},
        },
        "links": {
            "1": {"points": ["A"]},
            "2": {"points": ["B"], "on": "0.y"},
            "3": {"points": ["B", "C"], "length": 61},
            "4": {"points": ["C", "D"], "length": 62, "at": {"E": {"from": ["C", "D"], "r": [39, 57], "side": "left"}}},
            "5": {"points": ["G", "D"], "length": 68},
            "6": {"points": ["H", "E"], "length": 61},
        },
        "cams": {"1": {"follower": "2", "law": law, "base": {"r": 55}, "roller": 8}},
        "driver": {"link": "1", "angle": 70, "omega": 6},
        "sketch": {"B": [0, 75], "C": [50, 110], "D": [110, 95], "E": [75, 140]},
    }


@pytest.mark.parametrize("by", ["uniform", "parabolic", "harmonic", "cycloidal", "345", "4567"])
def test_a_larger_group_follows_a_cam_through_the_seams_of_its_law(by: str) -> None:
    law = [{"to": 150, "rise": 20, "by": by}, {"to": 180}, {"to": 330, "fall": 20, "by": by}, {"to": 360}]
    scene = behind_a_cam(law)
    turned = solve(mechanism_of(scene), sweep=12)
    assert ["ok"] * 12 == list(turned.status)
    # the same follower pushed along its guide, without a cam
    pushed = {**scene, "links": {k: v for k, v in scene["links"].items() if k != "1"}}
    del pushed["cams"]
    for k, lift in ((3, 20.0), (9, 0.0)):  # in the dwells, at 160 and 340 deg
        pushed["driver"] = {"slide": "2", "travel": 63 + lift, "velocity": 1}
        alone = solve(mechanism_of(pushed))
        assert complex(alone.point("E").z[0]) == pytest.approx(complex(turned.point("E").z[k]), abs=1e-13)
