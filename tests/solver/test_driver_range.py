"""One way over the driver's range: how far it reaches, which assembly stands where, and when it closes."""

from __future__ import annotations

import math

import numpy as np
import pytest

from graphkin.errors import CallError, Unsolvable
from graphkin.scene import library_text, mechanism_of, mechanism_of_text
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver import DriverRange, driver_range, solve, structure_of
from graphkin.solver.compiled.engine import group_at
from graphkin.solver.path.driver_range import each_once
from graphkin.solver.prepared import prepare
from graphkin.structure.assembly import ways
from tests import scenes

ROCKER = scenes.FOUR_BAR.replace("length = 150", "length = 350").replace("length = 500", "length = 200")
LOOSE = scenes.DOUBLE_PARALLELOGRAM.replace("length = 100\nredundant", "length = 101\nredundant")


def scene_of(text: str) -> Mechanism:
    return mechanism_of_text(text, "scene")


def range_of(text: str) -> DriverRange:
    return driver_range(scene_of(text))


def test_a_driver_that_cannot_turn_fully_reaches_where_coupler_and_rocker_are_in_line() -> None:
    rocker = range_of(ROCKER)
    ends = [math.degrees(float(rocker.value(np.array(end)))) for end in rocker.ends]
    # coupler 200 and rocker 300 in line span 100 or 500 between the ends of crank 350 and frame 400
    right = [math.degrees(math.acos((350**2 + 400**2 - d**2) / (2 * 350 * 400))) for d in (100, 500)]
    assert right == pytest.approx(ends, abs=1e-9)


@pytest.mark.parametrize("text", [scenes.FOUR_BAR, ROCKER, scenes.OFFSET_SLIDER, scenes.PISTON])
def test_solve_and_prepare_come_to_the_same_positions_over_the_range(text: str) -> None:
    scene = scene_of(text)
    name = f"omega_{next(link.name for link in scene.links if link.name not in [d.key for d in scene.drivers])}"
    motion = solve(scene, sweep=40)
    columns, ok = prepare(scene, [Symbol.parse(name)]).columns(motion.values[:, 0])
    assert columns[0, ok] == pytest.approx(motion.omega(name[6:])[ok], rel=1e-9, abs=1e-9)
    assert motion.ok.tolist() == ok.tolist()


@pytest.mark.parametrize("travel", [70, 170])
def test_angles_do_not_jump_over_a_range_that_begins_in_a_dead_point(travel: int) -> None:
    reach = range_of(scenes.PISTON.replace("travel = 150", f"travel = {travel}") + "[sketch]\nB = [49, 1]\n")
    angle = reach.angle(reach.motion(np.linspace(*reach.ends, 200)[1:-1]), "1")
    assert np.abs(np.diff(angle)).max() < 0.2


def test_a_range_in_one_turn_closes_there() -> None:
    assert 1 == range_of(scenes.FOUR_BAR).turns


def test_a_structure_serves_as_well_as_its_scene() -> None:
    scene = scene_of(ROCKER)
    assert driver_range(scene).ends == driver_range(structure_of(scene)).ends


def test_a_start_that_the_motion_does_not_reach_is_refused() -> None:
    with pytest.raises(Unsolvable, match="the motion reaches from"):
        driver_range(scene_of(ROCKER), {"1": math.pi})


def test_a_larger_group_comes_to_both_its_dead_points_in_few_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    from graphkin.solver.path import continuity

    steps: list[float] = []
    monkeypatch.setattr(continuity, "group_at", lambda *given: steps.append(0.0) or group_at(*given))
    reach = driver_range(mechanism_of_text(library_text("triad-slider"), ""))
    assert (True, True) == reach.limited
    assert len(steps) < 150


def test_a_start_of_no_driver_is_refused() -> None:
    with pytest.raises(CallError, match="there is no such driver"):
        driver_range(scene_of(ROCKER), {"3": 1.0})


def test_a_redundant_link_that_does_not_fit_is_refused_over_the_range_too() -> None:
    with pytest.raises(Unsolvable, match="it misses its joints"):
        range_of(LOOSE).motion(np.zeros(1))


def test_a_redundant_link_is_not_refused_for_what_rounding_makes_of_it_beside_a_dead_point() -> None:
    whole = range_of(scenes.DOUBLE_PARALLELOGRAM)
    beside = np.geomspace(1e-12, 1e-2, 60)
    motion = whole.motion(whole.offsets(beside))
    assert set(motion.status) == {"dead point", "ok"}


@pytest.mark.parametrize(
    ("goal", "found"),
    [
        (1.0, [1.0, 1.0 - 2 * math.pi]),
        (-1.0, [-1.0, 2 * math.pi - 1.0]),
        (1.0 + 4 * math.pi, [1.0 + 4 * math.pi, 1.0, 1.0 - 2 * math.pi]),
        (1.0 + 26 * math.pi, [1.0 + 2 * math.pi, 1.0, 1.0 - 2 * math.pi]),
        (4.0, [4.0, 4.0 - 2 * math.pi]),
        (4 * math.pi, [4 * math.pi, 0.0]),
        (0.0, [0.0]),
    ],
)
def test_a_turning_driver_goes_straight_to_a_goal_or_where_it_stands_the_same_way(
    goal: float, found: list[float]
) -> None:
    turning = [d for d in scene_of(scenes.FOUR_BAR).drivers if d.turns]
    assert [pytest.approx((x,), abs=1e-14) for x in found] == list(ways(turning, [0.0], [goal]))


def test_a_sliding_driver_has_one_way_to_a_goal() -> None:
    assert [(0.3,)] == list(ways(scene_of(scenes.PISTON).drivers, [0.1], [0.3]))


@pytest.fixture(scope="module")
def wide() -> DriverRange:
    return range_of(scenes.WIDE_SWINGING)


def test_a_range_wider_than_a_turn_is_followed_to_both_limits(wide: DriverRange) -> None:
    low, high = np.degrees(wide.value(np.array(wide.ends)))
    assert (True, True, 0) == (*wide.limited, wide.turns)
    # found by following the four-bar over its circuit and closing the dyad at each of its positions
    assert [-517.4023, -71.9625] == pytest.approx([low, high], abs=1e-4)


def test_the_same_range_is_found_whichever_way_the_driver_runs(wide: DriverRange) -> None:
    other = range_of(scenes.WIDE_SWINGING.replace("omega = 1", "omega = -1"))
    ends = sorted(float(other.value(np.array(end))) for end in other.ends)
    assert sorted(float(wide.value(np.array(end))) for end in wide.ends) == pytest.approx(ends, abs=1e-9)


def test_beyond_a_turn_stands_what_the_way_there_leads_to(wide: DriverRange) -> None:
    # 360 degrees apart the driver stands the same way and the links do not
    here, beyond = wide.motion(np.array([-0.1, -0.1 - 2 * math.pi])).position("C")
    asked = solve(wide.scene, {"5": float(wide.start[0]) - 0.1 - 2 * math.pi}).position("C")[0]
    assert beyond == pytest.approx(asked, abs=1e-12)
    assert abs(beyond - here) > 0.01
    steps = wide.motion(-np.linspace(0.0, 0.1 + 2 * math.pi, 2000)).position("C")
    assert np.abs(np.diff(steps)).max() < 0.003


def test_a_sweep_over_a_turn_of_a_wide_range_finds_every_position(wide: DriverRange) -> None:
    assert {"ok"} == set(wide.sweep(36).status)


def test_seams_are_counted_once_and_the_ends_of_a_turn_as_one() -> None:
    low, high = 0.0, 2 * math.pi
    places = np.array([high - 1e-12, low + 1.0, low - 1e-12, low + 1e-12, high + 1.0 + 1e-12, low + 2.0])
    assert [low, low + 1.0, low + 2.0] == pytest.approx(each_once(places, low, high, True).tolist(), abs=1e-11)
    assert low == each_once(places, low, high, True)[0]
    inside = each_once(np.array([low, low + 1e-12, low + 0.5, high - 1e-12, high]), low, high, False)
    assert [low + 0.5] == inside.tolist()


def test_a_change_point_on_the_way_to_an_end_beyond_keeps_its_place() -> None:
    # a parallelogram, and on its coupler a rod that holds the crank back beyond half a turn
    scene = scenes.four_bar(100, 300, 100, 300, driver={"link": "1", "angle": 20, "omega": 1}, sketch={"C": [390, 40]})
    scene["frame"]["points"]["G"] = [0, 210]
    scene["links"] |= {"5": {"points": ["B", "F"], "length": 150}, "6": {"points": ["G", "F"], "length": 150}}
    reach = driver_range(mechanism_of(scene))
    assert math.degrees(math.asin((100**2 + 210**2 - 300**2) / (2 * 100 * 210))) == pytest.approx(
        180 - math.degrees(reach.value(np.array(reach.ends[1])))
    )
    assert [0, 180] == sorted(round(math.degrees(point.values[0]), 6) for point in reach.change_points)


def test_wheels_that_stand_in_their_places_close_when_all_have_turned_back() -> None:
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [50, 0]}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["D"]}},
        "gears": {"g": {"between": ["1", "2"], "teeth": [20, 30]}},
        "driver": {"link": "1", "angle": 10, "omega": 1},
    }
    assert 3 == driver_range(mechanism_of(scene)).turns
