"""A driven slide between two links not yet known: the triangle gives their relative motion, the rest are dyads."""

from __future__ import annotations

import cmath
import math
import tomllib

import pytest

import graphkin
from graphkin.construction import draft
from graphkin.scene import mechanism_of
from graphkin.solver import solve
from graphkin.structure import Dyad, analyse
from tests.mechanisms import floating_cylinder

SCISSOR_LIFT = """
[frame]
points = { A = [0, 0] }
guides = { h = { through = [0, 0], angle = 0 } }
[links.1]
points = ["A", "C"]
length = 2000
at = { J = [1000, 0], P = [400, 60] }
[links.2]
points = ["D", "E"]
length = 2000
at = { J = [1000, 0], Q = [1500, 80] }
[links.5]
points = ["D"]
on = "0.h"
[links.3]
points = ["P"]
[links.4]
points = ["Q"]
on = "3"
[driver]
slide = "4"
travel = 800
velocity = 50
[sketch]
J = [900, 400]
D = [1800, 0]
"""


@pytest.fixture(scope="module")
def lift(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("lift") / "scissor-lift.toml"
    path.write_text(SCISSOR_LIFT)
    return str(path)


@pytest.mark.quick
def test_a_scissor_lift_is_of_class_two(lift: str) -> None:
    assert [2] == [getattr(e, "order", 2) for e in analyse(mechanism_of(lift)).elements]


@pytest.mark.quick
def test_its_arms_and_foot_are_a_dyad_and_so_is_its_cylinder(lift: str) -> None:
    (group,) = analyse(mechanism_of(lift)).elements
    assert [("RRP", ("1", "2", "5")), ("RPR", ("3", "4"))] == [
        (part.kind, part.links) for part in group.parts if isinstance(part, Dyad)  # type: ignore[union-attr]
    ]


@pytest.mark.parametrize("travel", [700, 800])
def test_a_scissor_lift_is_drawn_whole_as_it_is_solved(lift: str, travel: float) -> None:
    checked = graphkin.check(lift, at=travel)
    assert (True, True) == (checked.ok, checked.complete)


def test_the_report_of_a_scissor_lift_says_what_was_drawn_with_an_arm_held_still(lift: str) -> None:
    sheet = draft(mechanism_of(lift))
    told = [step.phrase.key for step in sheet.steps if step.phrase.key.startswith("held still")]
    assert ["held still angle", "held still omega", "held still alpha"] == told


def test_a_pencil_draws_a_scissor_lift_within_what_it_promises(lift: str) -> None:
    assert graphkin.check(lift, find=["omega_1"], instrument="pencil", seed=3).ok


@pytest.mark.parametrize("seed", range(6))
def test_any_cylinder_between_two_floating_links_is_drawn_as_it_is_solved(seed: int) -> None:
    checked = graphkin.check(floating_cylinder(seed))
    assert (True, True) == (checked.ok, checked.complete)


@pytest.mark.parametrize("seed", range(6, 10))
def test_its_centres_agree_too(seed: int) -> None:
    assert graphkin.centres(floating_cylinder(seed)).ok


def test_a_triangle_of_which_two_links_slide_on_each_other_is_drawn_as_it_is_solved() -> None:
    checked = graphkin.check({
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 368], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "P"], "length": 100, "guides": {"g": {"through": [0, 50], "angle": 0}}},
            "2": {"points": ["Q", "D"], "length": 200, "on": "1.g", "angle_on": 60},
            "3": {"points": ["P"]}, "4": {"points": ["Q"], "on": "3"}, "5": {"points": ["D"], "on": "0.h"},
        },
        "driver": {"slide": "4", "travel": 158, "velocity": 40, "acceleration": -25},
        "sketch": {"P": [87, 50], "Q": [191, 168], "D": [191, 368]},
    })
    assert ["2/1"] == [t.pair.key for group in checked.sheet.structure.larger_groups for t in group.triangles]
    assert (True, True) == (checked.ok, checked.complete)


def test_a_turn_of_a_crank_is_drawn_with_the_triangle_that_a_cylinder_holds() -> None:
    # the cylinder holds J, 60 from B and from C, at one angle: a coupler BC of 90
    sheet = draft(mechanism_of({
        "frame": {"points": {"A": [0, 0], "D": [120, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 30}, "7": {"points": ["D", "C"], "length": 90},
            "2": {"points": ["B", "J"], "length": 60, "at": {"P": [50, 0]}},
            "3": {"points": ["J", "C"], "length": 60, "at": {"Q": [10, 0]}},
            "4": {"points": ["P"]}, "5": {"points": ["Q"], "on": "4"},
        },
        "driver": [{"link": "1", "angle": 60, "omega": 10}, {"slide": "5", "travel": 15, "velocity": 2}],
        "sketch": {"B": [15, 26], "J": [60, 80], "C": [105, 90], "P": [52, 70], "Q": [68, 82]},
        "find": ["swing_7"],
    }))
    # of the rocker in both limits from the frame
    turned = [math.acos((120**2 + 90**2 - long**2) / (2 * 120 * 90)) for long in (90 - 30, 90 + 30)]
    axes = [math.pi - cmath.phase(limit.poses["7"].axis) for limit in sheet.limits["7"]]
    assert turned == pytest.approx(sorted(axes), abs=1e-9)


@pytest.mark.quick
def test_two_cylinders_on_one_link_close_triangles_about_different_links() -> None:
    structure = analyse(mechanism_of({
        "frame": {"points": {"A": [0, 0], "B": [300, 0]}},
        "links": {
            "1": {"points": ["A", "C"], "length": 100, "at": {"P": [60, 20]}},
            "3": {"points": ["D", "E"], "length": 100, "at": {"S": [40, 25]}},
            "4": {"points": ["E", "B"], "length": 110},
            "2": {"points": ["C", "D"], "length": 120, "at": {"Q": [40, 30], "R": [80, 30]}},
            "5": {"points": ["P"]}, "6": {"points": ["Q"], "on": "5"},
            "7": {"points": ["R"]}, "8": {"points": ["S"], "on": "7"},
        },
        "driver": [{"slide": "6", "travel": 70, "velocity": 10}, {"slide": "8", "travel": 75, "velocity": 5}],
        "sketch": {"C": [40, 95], "D": [155, 130], "E": [235, 80]},
    }))
    # from link 1 and from link 3 the first cylinder and the second both turn link 2; it has one driver only
    (group,) = structure.larger_groups
    assert [("6/5", "2"), ("8/7", "3")] == [(t.driver.key, t.equivalent.key) for t in group.triangles]


def test_bars_in_line_at_the_own_position_beside_a_triangle_are_told_with_what_helps() -> None:
    scene = tomllib.loads(SCISSOR_LIFT)
    end, pivot = 1000 * solve(mechanism_of(scene)).position("E")[0], 2500 + 2600j
    scene["frame"]["points"]["G"] = [pivot.real, pivot.imag]
    scene["links"] |= {name: {"points": ends, "length": abs(pivot - end) / 2}
                       for name, ends in (("6", ["E", "F"]), ("7", ["F", "G"]))}
    with pytest.raises(graphkin.Unsolvable, match="from which others are drawn: move its driver off it"):
        draft(mechanism_of(scene), at={"4/3": 0.81})
