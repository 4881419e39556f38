"""Drivers and mechanisms as values: what follows from what they are made of."""

import math
from dataclasses import replace

import pytest

from graphkin.scene import mechanism_of_text
from graphkin.scene.model import Driver, Mechanism
from tests.scenes import FOUR_BAR

CRANK = Driver("1", "4", 0.5, 10.0, 0.0)
CYLINDER = Driver("2", "3", 0.42, 0.06, 0.0, "2/3")


def four_bar() -> Mechanism:
    return mechanism_of_text(FOUR_BAR, "four-bar")


@pytest.mark.parametrize("turns", [-2, 0, 1])
def test_a_change_of_an_angle_counts_but_for_whole_turns(turns: int) -> None:
    assert pytest.approx(-0.1, abs=1e-12) == CRANK.wrapped(-0.1 + turns * math.tau)


def test_a_change_of_a_travel_counts_whole() -> None:
    assert math.tau == CYLINDER.wrapped(math.tau)


def test_an_angle_is_measured_in_radians_and_a_travel_in_the_size() -> None:
    assert (1.0, 3.0) == (CRANK.span(3.0), CYLINDER.span(3.0))


def test_a_driver_is_known_by_its_link_or_its_sliding_pair() -> None:
    assert ("1", "2/3") == (CRANK.key, CYLINDER.key)


def test_only_an_angle_turns_about_a_link() -> None:
    assert (True, False) == (CRANK.turns_about("4"), CYLINDER.turns_about("3"))


def test_a_driver_at_another_value_has_that_among_its_values() -> None:
    assert (0.7, 10.0, 0.0) == CRANK.at_value(0.7).values


def test_a_mechanism_with_other_links_knows_them_by_name() -> None:
    scene = four_bar()
    first = scene.links[0]
    assert [first.name, scene.frame.name] == [*replace(scene, links=(first,)).order]


def test_the_frame_comes_first_among_the_holders_of_its_points() -> None:
    scene = four_bar()
    assert {scene.frame.name} == {scene.holders[point][0] for point in scene.frame.points}
