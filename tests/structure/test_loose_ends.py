"""Too much freedom is told by the names that cause it."""

from __future__ import annotations

from typing import Any

import pytest

from graphkin.errors import Unsolvable
from graphkin.scene import mechanism_of, read
from graphkin.structure import analyse

pytestmark = pytest.mark.quick


def four_bar(**changed: Any) -> dict[str, Any]:
    links = {
        "1": {"points": ["A", "B"], "length": 150},
        "2": {"points": ["B", "C"], "length": 500},
        "3": {"points": ["D", "C"], "length": 300},
    }
    frame = {"points": {"A": [0, 0], "D": [400, 0]}}
    scene = {"frame": frame, "links": links, "driver": {"link": "1", "angle": 60, "omega": 10}}
    links.update(changed.pop("links", {}))
    return scene | changed


def said(scene: dict[str, Any]) -> list[str]:
    with pytest.raises(Unsolvable) as refusal:
        analyse(mechanism_of(scene))
    assert refusal.value.status == "mobility"
    return [str(problem) for problem in refusal.value.problems[1:]]


def test_a_misspelt_pivot_is_named_with_the_frame_point_that_resembles_it() -> None:
    assert [
        "links.3: no other link has its point D, so that it hangs on C alone; did you mean D2, a point of the frame "
        "that no link has?"
    ] == said(four_bar(frame={"points": {"A": [0, 0], "D2": [400, 0]}}))


def test_a_joint_spelt_in_two_ways_is_named_in_both_links() -> None:
    found = said(four_bar(links={"3": {"points": ["D", "C1"], "length": 300}}))
    assert [("links.2", "did you mean C1?"), ("links.3", "did you mean C?")] == [
        (text.partition(":")[0], text.rpartition("; ")[2]) for text in found
    ]


def test_the_own_turning_of_a_roller_is_named() -> None:
    (text,) = said(four_bar(links={"4": {"points": ["C"]}}))
    assert text.startswith("links.4: it hangs on C alone and turns there freely")
    assert "roller" in text


def test_a_link_that_hangs_on_one_pin_is_named() -> None:
    (text,) = said(four_bar(links={"4": {"points": ["B", "E"], "length": 40}}))
    assert text.startswith("links.4: no other link has its point E, so that it hangs on B alone")


def test_a_slide_that_nothing_else_joins_is_said_to_move_not_to_turn() -> None:
    frame = {"points": {"A": [0, 0], "D": [400, 0]}, "guides": {"k": {"through": [0, 90], "angle": 0}}}
    (text,) = said(four_bar(frame=frame, links={"4": {"on": "0.k"}}))
    assert "links.4: 4/0 alone holds it, so that it moves freely; join it to another link too, or drive it" == text


def train(driven: str, *gears: dict[str, Any]) -> dict[str, Any]:
    """Wheels 1 and 4 about O and wheel 3 on the arm 2, of which one is driven."""
    links = {"1": {"points": ["O"]}, "2": {"points": ["O", "P"], "length": 45}, "3": {"points": ["P"]}}
    return {
        "frame": {"points": {"O": [0, 0]}},
        "links": links | {"4": {"points": ["O"]}},
        "gears": {f"g{k}": gear for k, gear in enumerate(gears)},
        "driver": {"link": driven, "angle": 0, "omega": 1},
    }


def test_wheels_that_mesh_do_not_turn_freely() -> None:
    sun, ring = {"between": ["1", "3"], "teeth": [20, 25]}, {"between": ["3", "4"], "teeth": [25, -70]}
    assert [] == said(train("2", sun, ring))


@pytest.mark.parametrize("name", ["cam-swinging-roller", "cam-flat-face"])
def test_a_cam_and_its_follower_hold_each_other(name: str) -> None:
    scene = read(name).to_dict()
    del scene["driver"]
    with pytest.raises(Unsolvable) as refused:
        analyse(mechanism_of(scene))
    assert ["mobility"] == [str(problem.where) for problem in refused.value.problems]


def test_a_driven_link_does_not_turn_freely_and_a_wheel_that_meshes_with_none_does() -> None:
    (text,) = said(train("1", {"between": ["1", "3"], "teeth": [20, 25]}))
    assert text.startswith("links.4: it hangs on O alone")


def test_a_driven_link_to_which_nothing_is_joined_is_named_as_such() -> None:
    first = said(train("1", {"between": ["3", "4"], "teeth": [25, -70]}))[0]
    assert "links.1: its driver moves it, but nothing else is joined to it; join it to another link too" == first


def test_a_wheel_that_rolls_does_not_turn_freely() -> None:
    wheel = {"points": ["P"], "discs": {"k": {"centre": "P", "r": 10}}}
    rail = {"points": {"O": [0, 0]}, "guides": {"f": {"through": [0, -55], "angle": 0}}}
    scene = train("2") | {"frame": rail, "contacts": {"K": {"between": ["3.k", "0.f"], "rolling": True}}}
    scene["links"]["3"] = wheel
    assert ["links.1", "links.4"] == [text.partition(":")[0] for text in said(scene)]
