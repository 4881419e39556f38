"""Sliding links with two pins."""

import math

import pytest

import graphkin
from graphkin.errors import SceneError
from graphkin.scene import mechanism_of
from graphkin.scene.scene import as_mapping


def carriage(three, **more):
    return {
        "frame": {"points": {"A": [0, 0], "E": [260, 120]}, "guides": {"h": {"through": [0, -20], "angle": 10}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 40},
            "2": {"points": ["B", "P"], "length": 130},
            "3": {"points": ["P", "Q"], "on": "0.h", **three},
            "4": {"points": ["Q", "F"], "length": 80},
            "5": {"points": ["E", "F"], "length": 90},
        },
        "driver": {"link": "1", "angle": 50, "omega": 4},
        **more,
    }


BY_PLACE = carriage({"at": {"Q": [70, 30], "S": [20, 5]}})
BY_ANGLE = carriage({"length": math.hypot(70, 30), "angle_on": math.degrees(math.atan2(30, 70))})


def test_the_second_pin_is_told_by_where_it_stands_along_and_across_the_guide():
    along = complex(math.cos(math.radians(10)), math.sin(math.radians(10)))
    solved = graphkin.solve(BY_PLACE)
    for point, place in (("Q", 70 + 30j), ("S", 20 + 5j)):
        assert place == pytest.approx((solved[point] - solved["P"])[0] / along, abs=1e-12)
    assert graphkin.check(BY_PLACE).ok


def test_both_ways_of_writing_a_carriage_move_alike():
    one, other = graphkin.solve(BY_PLACE), graphkin.solve(BY_ANGLE)
    for name in ("Q", "v_F", "a_F", "alpha_5"):
        assert other[name][0] == pytest.approx(one[name][0], rel=1e-11)


def test_where_both_pins_are_drawn_their_angle_to_the_guide_is_the_drawn_one():
    solved = graphkin.solve(BY_ANGLE)
    drawn = {p: [solved[p][0].real, solved[p][0].imag] for p in ("P", "Q")}
    again = graphkin.solve(carriage({}, drawn=drawn))
    assert solved["a_F"][0] == pytest.approx(again["a_F"][0], rel=1e-9)


@pytest.mark.parametrize("drawn", [False, True])
def test_a_carriage_is_written_again_as_it_stands(drawn):
    solved = graphkin.solve(BY_PLACE)
    places = {p: [solved[p][0].real, solved[p][0].imag] for p in ("P", "Q")}
    scene = mechanism_of(carriage({}, drawn=places) if drawn else BY_PLACE)
    again = mechanism_of(as_mapping(scene))
    assert scene.slidings[0].turn == pytest.approx(again.slidings[0].turn, abs=1e-12)
    assert scene.by_name["3"].points == pytest.approx(again.by_name["3"].points, abs=1e-12)


def test_a_carriage_whose_second_pin_is_told_twice_is_refused():
    with pytest.raises(SceneError, match="Q"):
        graphkin.read(carriage({"length": 70, "at": {"Q": [70, 30]}}))
