"""What makes a scene easy to write: polar points of the frame, the sense as a word."""

from __future__ import annotations

import math

import pytest

import graphkin
from graphkin.errors import SceneError
from graphkin.scene import mechanism_of
from graphkin.scene.scene import as_mapping

pytestmark = pytest.mark.quick


def four_bar(points: dict[str, object], **driver: object) -> graphkin.Scene:
    return graphkin.read(
        {
            "frame": {"points": points},
            "links": {
                "1": {"points": ["A", "B"], "length": 150},
                "2": {"points": ["B", "C"], "length": 500},
                "3": {"points": ["D", "C"], "length": 300},
            },
            "driver": {"link": "1", "angle": 60, **driver},
            "sketch": {"C": [500, 290]},
        }
    )


def problems(points: dict[str, object], **driver: object) -> list[str]:
    with pytest.raises(SceneError) as refusal:
        four_bar(points, **driver)
    return [str(p) for p in refusal.value.problems]


def test_a_point_of_the_frame_may_be_polar_from_another_that_may_be_polar_itself() -> None:
    points = {"D": {"from": "E", "r": 100, "angle": 90}, "A": [10, 20], "E": {"from": "A", "r": 400, "angle": -30}}
    found = four_bar(points, omega=10).mechanism.frame.points
    assert ["D", "A", "E"] == list(found)
    wanted = 10 + 20j + 400 * complex(math.cos(math.pi / 6), -0.5) + 100j
    assert pytest.approx(wanted * 1e-3) == found["D"]


@pytest.mark.parametrize(("side", "sign"), [("left", 1), ("right", -1)])
def test_a_point_of_the_frame_may_be_given_by_the_sides_of_a_triangle(side: str, sign: int, tmp_path) -> None:
    corner = {"from": ["A", "E"], "r": [300, 400], "side": side}
    scene = four_bar({"D": corner, "A": [10, 20], "E": {"from": "A", "r": 500, "angle": 90}}, omega=10)
    assert pytest.approx((10 + 20j + 180j - sign * 240) * 1e-3) == scene.mechanism.frame.points["D"]
    assert scene == graphkin.read(scene.save(tmp_path / "a.toml"))


def test_polar_points_of_the_frame_stay_as_they_are_written(tmp_path) -> None:
    scene = four_bar({"A": [0, 0], "D": {"from": "A", "r": 400, "angle": 0}}, omega=10)
    assert scene == graphkin.read(scene.save(tmp_path / "a.toml"))
    assert {"from": "A", "r": 400, "angle": 0} == scene.to_dict()["frame"]["points"]["D"] | {"angle": 0}


@pytest.mark.parametrize(
    ("points", "said"),
    [
        ({"A": [0, 0], "D": {"from": "Q", "r": 400}}, "frame.points.D: the frame has no point Q; known here: A, D"),
        (
            {"A": [0, 0], "B": [9, 0], "D": {"from": ["A", "B"], "r": [3, 4], "side": "left"}},
            "frame.points.D: arcs of 3 about A and 4 about B do not meet; with AB = 9 the second may be from 6 to 12",
        ),
        (
            {"A": [0, 0], "D": {"from": ["A", "Q"], "r": [3, 4], "side": "left"}},
            "frame.points.D: the frame has no point Q; known here: A, D",
        ),
        ({"A": [0, 0], "D": {"from": ["A", "A"], "r": [3, 4], "side": "left"}}, "frame.points.D.from: A and A lie at"),
        ({"A": [0, 0], "D": {"from": ["A", "B"], "r": [3, 4]}}, "frame.points.D.side: is missing"),
        ({"A": {"from": "D", "r": 1}, "D": {"from": "A", "r": 400}}, "frame.points.A: D has no place yet; the"),
        ({"A": [0, 0], "D": {"from": "A"}}, "frame.points.D.r: is missing; distance"),
        ({"A": [0, 0], "D": {"from": "A", "r": 4, "x": 1}}, "frame.points.D.x: unknown key"),
        ({"A": [0, 0], "D": "left"}, 'frame.points.D: found "left"; write [x, y], { from = "A"'),
    ],
)
def test_a_polar_point_that_has_no_place_is_told(points: dict[str, object], said: str) -> None:
    assert any(p.startswith(said) for p in problems(points, omega=10))


@pytest.mark.parametrize(("sense", "sign"), [("clockwise", -1), ("counter-clockwise", 1)])
def test_the_sense_is_a_word(sense: str, sign: int) -> None:
    points = {"A": [0, 0], "D": [400, 0]}
    (driver,) = four_bar(points, rpm=30, alpha=2, sense=sense).mechanism.drivers
    assert (pytest.approx(sign * math.pi), sign * 2) == (driver.rate, driver.second)


def test_a_sense_with_a_negative_speed_is_told() -> None:
    points: dict[str, object] = {"A": [0, 0], "D": [400, 0]}
    said = "driver.omega: found -10 beside the sense clockwise; with sense write the size, or leave sense out"
    assert [said] == problems(points, omega=-10, sense="clockwise")
    assert ['driver.sense: found "left"; one of "clockwise", "counter-clockwise" is possible'] == problems(
        points, omega=10, sense="left"
    )


def test_polar_points_of_the_frame_vary_from_problem_to_problem() -> None:
    scene = four_bar({"A": [0, 0], "D": {"from": "A", "r": 400, "angle": 10}}, rpm=60, sense="clockwise")
    made = graphkin.problem_set(scene, variants=2, seed=1)
    assert (2, ()) == (len(made.answers), made.failures)


@pytest.mark.parametrize(("length", "speed", "times"), [("mm", "m/s", 1e-3), ("in", "ft/s", 1 / 12)])
def test_speeds_may_have_a_unit_of_their_own(length: str, speed: str, times: float) -> None:
    given = graphkin.read("slider-crank-offset").to_dict()
    given.pop("sheet", None)
    plain = {**given, "units": {"length": length}}
    own = {**given, "units": {"length": length, "speed": speed}}
    assert graphkin.check(own).ok
    drawn, after = ({r["symbol"]: r["measured"] for r in graphkin.check(s).data["readings"]} for s in (plain, own))
    assert times * drawn["v_C"] == pytest.approx(after["v_C"], rel=1e-12)
    before = graphkin.solve(plain).data["positions"][0]["points"]["C@3"]
    entry = graphkin.solve(own).data["positions"][0]["points"]["C@3"]
    assert before["position"] == entry["position"]
    for rate in ("velocity", "acceleration"):
        assert [times * x for x in before[rate]] == pytest.approx(entry[rate], rel=1e-12)
    assert f"v_C ({speed})" in graphkin.sweep(own, positions=3, find=["v_C"]).table.heads


def test_a_driven_slide_is_given_in_the_unit_of_speeds() -> None:
    given = graphkin.read("hydraulic-cylinder").to_dict()
    driver = given["driver"] if isinstance(given["driver"], dict) else given["driver"][0]
    metres = {**given, "units": {"length": "mm", "speed": "m/s"},
              "driver": {**driver, "velocity": driver["velocity"] / 1000}}
    assert mechanism_of(given).drivers[0].values == pytest.approx(mechanism_of(metres).drivers[0].values, rel=1e-12)
    again = mechanism_of(as_mapping(mechanism_of(metres))).drivers
    assert mechanism_of(metres).drivers[0].values == pytest.approx(again[0].values, rel=1e-12)


@pytest.mark.parametrize(("point", "sense"), [("B", None), ("C", None), ("C", "clockwise"), ("S2", None)])
def test_the_speed_of_a_point_may_stand_for_the_rate_of_the_driver(point: str, sense: str | None) -> None:
    given = graphkin.read("slider-crank-offset").to_dict()
    given["driver"] = {"link": "1", "angle": 120, "speed": 800, "of": point, **({"sense": sense} if sense else {})}
    result = graphkin.check(given)
    assert result.ok
    assert 800 == pytest.approx(abs(result[f"v_{point}"].measured), rel=1e-12)
    turning = graphkin.solve(given).data["positions"][0]["links"]["1"]["omega"]
    assert (-1 if sense else 1) == math.copysign(1, turning)


@pytest.mark.parametrize(
    ("driver", "said"),
    [
        ({"speed": 1}, 'driver.of: is missing; write of = "B", the point whose speed it is'),
        ({"speed": 1, "of": "Q"}, "driver.of: no moving link has a point Q"),
        ({"speed": 1, "of": "B", "omega": 2}, "driver.speed: found speed = 1 and omega = 2; write one of the two"),
        ({"of": "B", "omega": 2}, "driver.of: names a point whose speed is not given"),
    ],
)
def test_a_speed_that_does_not_tell_the_rate_is_refused(driver: dict[str, object], said: str) -> None:
    assert any(p.startswith(said) for p in problems({"A": [0, 0], "D": [400, 0]}, **driver))


def test_a_point_that_stands_still_tells_no_rate() -> None:
    given = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 50},
            "2": {"points": ["B", "C"], "length": 150},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 0, "speed": 100, "of": "C"},
    }
    with pytest.raises(graphkin.Unsolvable, match="C: stands still here"):
        graphkin.check(given)
