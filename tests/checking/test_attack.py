"""Random mechanisms of every driver through every command: a right answer, or a refusal by name."""

from __future__ import annotations

import math

import pytest

import graphkin
from tests import EVERYTHING
from tests.bench.attack import attack, mechanism
from tests.mechanisms import redriven

MANY = 10 if EVERYTHING else 1
DEAD = ("refused: links", "refused: driver")


def seeds(first: int, count: int) -> range:
    return range(first, first + MANY * count)


@pytest.mark.parametrize(
    ("command", "seed"),
    [("check", s) for s in seeds(1000, 24)]
    + [("centres", s) for s in seeds(2000, 14)]
    + [("cad", s) for s in seeds(3000, 2)]
    + [("audit", s) for s in seeds(4000, 2)]
    + [("draw", s) for s in seeds(5000, 2)]
    + [("sweep", s) for s in seeds(6000, 2)],
)
def test_a_random_mechanism_is_answered_rightly_or_refused_by_name(command: str, seed: int) -> None:
    came = attack(mechanism(seed), command)
    assert came == "ok" or came.startswith(DEAD)


@pytest.mark.parametrize(
    ("command", "seed"),
    [
        ("audit", 7700051),  # whole numbers rounded to tens, where a pencil tells nothing
        ("audit", 7700105),
        ("audit", 7700083),  # a value of 1e-57
        ("centres", 7800124),  # three centres in one place, where a link turns with another
        ("sweep", 30260019),  # its own position is a dead point
        ("sweep", 30260020),  # singular throughout
        ("cad", 7700045),  # a vector that is nothing, drawn as a hair, read to 0.01 mm
    ],
)
def test_what_gave_way_once_holds(command: str, seed: int) -> None:
    assert "ok" == attack(mechanism(seed), command)


@pytest.mark.parametrize(
    "seed", [4, 33, 82, 131]  # blocks of pins that lost the link of their pin or of their slot, hinges of three links
)
def test_a_driver_where_pins_and_slots_are_is_answered(seed: int) -> None:
    assert ["ok"] * 2 == [attack(redriven(seed), command) for command in ("check", "centres")]


@pytest.mark.parametrize("seed", seeds(200, 20))
def test_a_driver_between_any_two_links_is_answered_rightly_or_refused_by_name(seed: int) -> None:
    came = attack(redriven(seed), "check")
    assert came == "ok" or came.startswith((*DEAD, "refused: mobility: "))


@pytest.mark.parametrize("seed", [64, 135])
def test_what_is_driven_where_it_is_held_already_is_refused_by_name(seed: int) -> None:
    assert attack(redriven(seed), "check").startswith("refused: mobility: links held too much: ")


def test_a_driven_slide_that_carries_nothing_is_swept() -> None:
    scene = {
        "frame": {"guides": {"h": {"through": [0, 0], "angle": 30}}},
        "links": {"1": {"points": ["B"], "on": "0.h"}},
        "driver": {"slide": "1", "travel": 60, "velocity": 1},
    }
    assert 12 == len(graphkin.sweep(scene, positions=12)["v_B"])


@pytest.mark.parametrize("at", [None, 0, 30, -40])
def test_a_driven_slide_with_a_pin_in_an_arm_of_no_length_is_drawn(at: float | None) -> None:
    scene = {
        "frame": {"points": {"C": [0, 0]}, "guides": {"h": {"through": [0, 50], "angle": 0}}},
        "links": {"1": {"points": ["B"], "on": "0.h"}, "2": {"points": ["C"]}},
        "pins": {"B": {"of": "1", "in": "2"}},
        "driver": {"slide": "1", "travel": 60, "velocity": 10, "acceleration": 5},
    }
    assert graphkin.check(scene, at=at).ok


def test_check_and_solve_take_the_same_assembly_of_a_bar_without_length_in_a_larger_group() -> None:
    scene = graphkin.read("sixbar-guide-40deg").to_dict()
    scene["links"]["3"]["points"], scene["links"]["4"]["points"] = ["D"], ["C"]
    assert graphkin.check(scene).ok
    assert graphkin.centres(scene).ok


def far(away: float, slope: float = 0.0) -> dict[str, object]:
    guide = {"through": [away, -20 + away * math.tan(math.radians(slope))], "angle": slope}
    return {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": guide}},
        "links": {
            "1": {"points": ["A", "B"], "length": 50},
            "2": {"points": ["B", "C"], "length": 150},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 60, "omega": 10},
        "sketch": {"C": [170, -20]},
    }


@pytest.mark.parametrize("scene", [far(1e9), far(1e9, 17.0), far(1e12), far(1e12, 17.0)])
def test_a_guide_through_a_point_far_away_is_judged_by_the_digits_of_the_file(scene: dict[str, object]) -> None:
    assert not [row for row in graphkin.check(scene).report.rows if row.ok is False]
    assert graphkin.centres(scene).ok


def test_places_too_far_apart_for_sixteen_digits_are_refused() -> None:
    with pytest.raises(graphkin.SceneError, match=r"frame\.guides\.h: lies 1e\+14 away, beside a bar of 50 \(link 1\)"):
        graphkin.read(far(1e14))
