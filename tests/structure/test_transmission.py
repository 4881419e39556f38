"""By which directions a link is pushed: expected angles from the shape of the mechanism alone."""

from __future__ import annotations

import cmath
import math

import pytest

import graphkin
from graphkin.errors import CallError
from tests.construction.test_at_contacts import scene
from tests.rolling_linkages import wheel_on_a_rocker


def test_a_slider_with_a_flat_face_is_pressed_by_how_much_its_face_leans() -> None:
    # the face stands at 95 degrees to the guide: square to it and 5 degrees more
    assert pytest.approx(5.0) == float(graphkin.solve(scene("flat slider"), find=["pressure_2"])["pressure_2"][0])


def test_a_slider_with_a_roller_is_pressed_along_the_line_of_centres() -> None:
    solved = graphkin.solve(scene("round slider"), find=["x_B", "y_B", "x_O", "y_O", "pressure_2"])
    b, o = (complex(float(solved[f"x_{p}"][0]), float(solved[f"y_{p}"][0])) for p in "BO")
    leans = cmath.phase((b - o) / cmath.rect(1.0, math.radians(80)))
    assert pytest.approx(abs(math.degrees(leans))) == float(solved["pressure_2"][0])


def test_a_rocker_of_a_larger_group_is_pressed_along_the_bar_at_its_pin() -> None:
    solved = graphkin.solve("double-butterfly", find=["theta_5", "theta_6", "pressure_5"])
    between = math.radians(float(solved["theta_6"][0]) - float(solved["theta_5"][0]))
    acute = math.degrees(math.atan2(abs(math.sin(between)), abs(math.cos(between))))
    assert pytest.approx(90.0 - acute) == float(solved["pressure_5"][0])


def test_the_joint_of_a_pin_in_a_slot_is_named_by_the_link_that_has_the_pin() -> None:
    # the crank pushes the wheel square to its slot, in which the pin slides
    assert pytest.approx(90.0) == float(graphkin.solve("geneva-step", find=["gamma_1-2"])["gamma_1-2"][0])


def test_a_link_on_which_a_wheel_rolls_is_pushed_along_no_line_that_is_known_before() -> None:
    with pytest.raises(CallError, match="link 5 is driven through no joint"):
        graphkin.solve(wheel_on_a_rocker(), find=["pressure_5"])


def test_a_crank_presses_the_block_in_its_pin_square_to_the_guide() -> None:
    solved = graphkin.solve("sixbar-guide-40deg", find=["theta_1", "theta_3", "gamma_1-2"])
    apart = math.radians(float(solved["theta_3"][0]) + 90.0 - float(solved["theta_1"][0]))
    acute = math.degrees(math.atan2(abs(math.sin(apart)), abs(math.cos(apart))))
    assert pytest.approx(acute) == float(solved["gamma_1-2"][0])
