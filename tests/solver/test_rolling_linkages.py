"""Wheels and links that move each other, none known before the other."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from graphkin import solve
from graphkin.scene import mechanism_of
from graphkin.solver import solve as motion_of
from graphkin.structure import LargerGroup, analyse
from tests.rolling_linkages import (
    ROLLING_LINKAGES,
    five_bar_by_its_middle,
    planet_by_a_rod,
    wheel_at_its_rim,
    wheel_on_a_rocker,
)
from tests.solver.checks import closure, differences


@pytest.mark.parametrize("made", ROLLING_LINKAGES)
def test_joints_stay_closed_and_rates_are_slopes(made):
    scene = mechanism_of(made())
    assert any(isinstance(e, LargerGroup) and e.rolling for e in analyse(scene).elements)
    assert 0.0 == pytest.approx(closure(motion_of(scene)), abs=1e-13)
    assert 0.0 == pytest.approx(differences(scene), abs=3e-6)


@pytest.mark.parametrize(("made", "wheel", "other"), [
    (wheel_at_its_rim, "3", None), (planet_by_a_rod, "3", None), (wheel_on_a_rocker, "3", "5"),
])
def test_where_they_touch_both_have_one_velocity(made, wheel, other):
    scene = made()
    reached = [here for here in solve(scene, sweep=7).data["positions"] if here["status"] == "ok"]
    assert len(reached) > 3
    for here in reached:
        place = complex(*here["contacts"]["K"]["position"])

        def velocity(link, letter, here=here, place=place):
            if link is None:
                return 0j
            point, rates = here["points"][f"{letter}@{link}"], here["links"][link]
            return complex(*point["velocity"]) + 1j * rates["omega"] * (place - complex(*point["position"]))

        assert abs(velocity(wheel, "C") - velocity(other, "F")) < 1e-10


def test_a_wheel_goes_along_the_rail_as_far_as_it_rolls_off():
    turn = solve(wheel_at_its_rim(), sweep=12).data["positions"]
    turned = np.unwrap([here["links"]["3"]["angle"] for here in turn])
    gone = [here["points"]["C@3"]["position"][0] for here in turn]
    assert math.radians(60) == pytest.approx(turned[0], abs=1e-14)
    assert -40 * (turned - turned[0]) == pytest.approx(np.array(gone) - gone[0], abs=1e-11)


def test_a_bar_s_ends_have_one_speed_along_it_and_the_wheel_turns_about_where_it_touches():
    # by hand: v_P is square to KP, its part along BP that of v_B
    here = solve(wheel_at_its_rim()).data["positions"][0]
    b = 60j + 30 * cmath.rect(1, math.radians(50))
    c_height, p_off = 40, 25 * cmath.rect(1, math.radians(60))
    height = c_height + p_off.imag
    p = complex(b.real + math.sqrt(150**2 - (height - b.imag) ** 2), height)
    k = complex((p - p_off).real, 0)
    along = (p - b) / 150
    v_b = 10j * (b - 60j)
    square = 1j * (p - k)
    omega = (v_b * along.conjugate()).real / (square * along.conjugate()).real
    assert omega == pytest.approx(here["links"]["3"]["omega"], rel=1e-12)
    assert [p.real, p.imag] == pytest.approx(here["points"]["P@3"]["position"], rel=1e-12)


@pytest.mark.parametrize("at", [45, 60, 90])
def test_meshing_cranks_of_a_five_bar_driven_at_its_middle_turn_against_each_other(at):
    own, here = (solve(five_bar_by_its_middle(), at=v).data["positions"][0]["links"] for v in (45, at))
    assert 20 * here["1"]["omega"] + 40 * here["4"]["omega"] == pytest.approx(0.0, abs=1e-12)
    assert 20 * here["1"]["alpha"] + 40 * here["4"]["alpha"] == pytest.approx(0.0, abs=1e-11)
    moved = (math.remainder(here[n]["angle"] - own[n]["angle"], math.tau) for n in "14")
    assert 0.0 == pytest.approx(math.remainder(20 * next(moved) + 40 * next(moved), 20 * math.tau), abs=1e-12)


def test_where_it_cannot_start_as_asked_the_links_are_named():
    scene = wheel_at_its_rim()
    scene["links"]["2"]["length"] = 20
    motion = motion_of(mechanism_of(scene))
    assert "not assembled" == motion.status[0]
    assert "contact K of links 3, 0: they do not reach each other" in motion.why[0]
