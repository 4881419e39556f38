"""Drivers and mechanisms as values: what follows from what they are made of."""

import math
from dataclasses import replace

import numpy as np
import pytest

from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.model import Driver, Loading, LoadOn, Mechanism, SpringOn, forces_named, with_dimensions
from graphkin.scene.scene_tables import LoadPhase
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Measure
from tests.scenes import FOUR_BAR, YOKE

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


@pytest.mark.parametrize(("name", "size"), [("cam-flat-face", 0.04), ("cam-eccentric-flat-slider", 0.04)])
def test_a_mechanism_is_as_large_as_the_base_circle_of_its_cam_or_its_disc(name: str, size: float) -> None:
    assert size == mechanism_of(name).size


def test_of_loads_and_springs_the_moments_alone_turn() -> None:
    loads = (LoadOn("M", "2", 3.0, False), LoadOn("F", "2", 5.0, True))
    spring = SpringOn("s", ("A", "C"), ("4", "3"), (0j, 0j), 200.0, 0.1)
    applied = Loading(loads=loads, springs=(spring,)).applied
    assert [("P_M", True), ("P_F", False), ("P_s", False)] == [(str(force), force.turning) for force in applied]


def test_the_frame_comes_first_among_the_holders_of_its_points() -> None:
    scene = four_bar()
    assert {scene.frame.name} == {scene.holders[point][0] for point in scene.frame.points}


STROKE = LoadPhase(stroke="6/1", sense=-1.0, start=0.0, end=0.9)


@pytest.mark.parametrize(
    ("phase", "turns", "value", "expected"),
    [
        (LoadPhase(start=1.0, end=2.0), False, [0.5, 1.0, 1.5, 2.0],
         [(False, False), (False, True), (True, False), (False, True)]),
        (LoadPhase(start=5.0, end=7.0), True, [4.9, 6.0, 0.5, 0.8],
         [(False, False), (True, False), (True, False), (False, False)]),
        (LoadPhase(start=0.0, end=math.tau), True, [0.0, 3.0], [(True, False), (True, False)]),
    ],
)
def test_a_load_acts_between_two_values_of_the_driver(
    phase: LoadPhase, turns: bool, value: list[float], expected: list[tuple[bool, bool]]
) -> None:
    load = LoadOn("P", "6", 1.0, True, phase=phase)
    assert expected == [load.acts_at(one, turns) for one in value]
    assert expected == [(bool(a), bool(b)) for a, b in zip(*load.acts_at(np.array(value), turns), strict=True)]


def test_a_load_on_a_stroke_acts_in_one_sense_and_jumps_where_both_meet() -> None:
    load = LoadOn("P", "6", 1.0, True, phase=STROKE)
    here = [(1.0, False), (0.5, True), (0.5, False), (0.1, True), (0.1, False), (0.05, True)]
    expected = [(False, True), (True, False), (False, False), (False, True), (False, False), (False, False)]
    assert expected == [load.acts_on_stroke(part, running) for part, running in here]


@pytest.mark.parametrize(("measure", "size"), [
    (Measure("angle", angle=1), 1.0), (Measure("length", length=1), 0.5), (Measure("velocity", length=1, order=1), 1.5),
    (Measure("angular acceleration", angle=1, order=2), 20.0), (Measure("third rate", length=1, order=3), 30.0),
])
def test_values_of_motion_are_as_large_as_the_rates_of_the_drivers_make_them(measure: Measure, size: float) -> None:
    assert size == measure.usual(0.5, rate=3.0, second=20.0)


DRIVEN_PIN = """
[frame]
points = { A = [0, 0] }
guides = { h = { through = [0, 0], angle = 0 } }
[links.1]
points = ["A", "B"]
length = 50
[links.2]
points = ["B", "C"]
length = 120
[pins.C]
of = "2"
in = "0.h"
[driver]
slide = "C/0"
travel = 140
velocity = 30
[masses.2]
mass = 1
at = "B"
inertia = 0.001
"""


def test_the_force_that_drives_a_pin_in_a_slot_acts_on_the_link_that_has_the_pin() -> None:
    assert Symbol("F", link="2") == forces_named(mechanism_of_text(DRIVEN_PIN, "driven pin"))[-1]


def test_a_pair_has_the_guide_of_its_link_also_where_other_numbers_replace_it() -> None:
    mechanism = mechanism_of_text(DRIVEN_PIN, "driven pin")
    lower = with_dimensions(mechanism, {("through", "0", "h"): -5e-3j})
    assert [0j, -5e-3j] == [made.slides[0].guide.through for made in (mechanism, lower)]


def test_values_of_the_drivers_are_by_their_keys_in_the_order_of_the_file() -> None:
    assert {"2": 0.5, "7/6": 0.25} == mechanism_of("loader-cylinder").by_driver(np.array([0.5, 0.25]))


def test_a_link_has_its_pivots_and_its_sliding_pair_on_the_frame() -> None:
    scene = mechanism_of(YOKE)
    assert scene.pivots("1") == ["A"]
    assert scene.pivots("2") == []
    assert scene.sliding("3/0") == scene.rail("3")
    assert scene.rail("2") is None
