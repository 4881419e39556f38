"""Circular slots: a bar to the centre stands for a pin in one, a turning pair about the centre for a block."""

from __future__ import annotations

import cmath
import math
from typing import Any

import pytest

import graphkin
from graphkin.account.given import given_shapes
from graphkin.account.headings import structure_words
from graphkin.account.notation import Notation
from graphkin.drawing.ink.primitives import Arc, Group, walk
from graphkin.errors import SceneError
from graphkin.scene import mechanism_of
from graphkin.scene.model import joints
from graphkin.scene.scene import as_mapping

pytestmark = pytest.mark.quick


def rocker(centre: object = "M", **slot: object) -> dict[str, Any]:
    """A crank and a rod whose end runs on a circle of 120 about M."""
    points = {"A": [0, 0], "M": [200, 40]} if centre == "M" else {"A": [0, 0]}
    return {
        "frame": {"points": points, "guides": {"s": {"centre": centre, "r": 120, **slot}}},
        "links": {"1": {"points": ["A", "B"], "length": 60}, "2": {"points": ["B", "C"], "length": 150}},
        "driver": {"link": "1", "angle": 70, "omega": 10, "alpha": 3},
        "sketch": {"C": [150, 140]},
    }


def with_pin(**slot: Any) -> dict[str, Any]:
    return {**rocker(**slot), "pins": {"C": {"of": "2", "in": "0.s"}}}


def with_block(angle_on: float = 0.0) -> dict[str, Any]:
    scene = rocker()
    block = {"points": ["C"], "on": "0.s", "angle_on": angle_on}
    return {**scene, "links": {**scene["links"], "3": block}}


def four_bar() -> dict[str, Any]:
    scene = rocker()
    scene["frame"]["guides"] = {}
    return {**scene, "links": {**scene["links"], "3": {"points": ["M", "C"], "length": 120}}}


CASES = [with_pin(), with_pin(centre=[200, 40]), with_block(), with_block(35.0)]


@pytest.mark.parametrize("scene", CASES)
def test_what_runs_in_a_circular_slot_moves_as_at_a_bar_to_its_centre(scene: dict[str, Any]) -> None:
    wanted = graphkin.solve(four_bar()).data["positions"][0]["points"]["C@2"]
    found = graphkin.solve(scene).data["positions"][0]["points"]["C@2"]
    for key, value in wanted.items():
        assert value == pytest.approx(found[key], rel=1e-11)


@pytest.mark.parametrize("scene", CASES[1:3])
def test_it_is_drawn_and_checked(scene: dict[str, Any]) -> None:
    result = graphkin.check(scene)
    assert (True, True) == (result.ok, result.complete)
    assert "slot-" in graphkin.draw(scene, figures=["mechanism"]).figures["mechanism"].content("svg").decode()


def test_a_pin_in_one_counts_as_a_higher_pair() -> None:
    count = graphkin.prepare(with_pin(), find=["v_C"]).ready.range.structure.mobility
    assert (2, 2, 1, 1) == (count.links, count.lower, count.higher, count.value)


@pytest.mark.parametrize(
    ("scene", "language", "told"),
    [
        (with_pin(), "en", "$C$ of 2 in a circular slot of 0 about $M$; the bar $MC$, link s, stands for it"),
        (with_pin(), "zh", "构件 2 上的 $C$ 在构件 0 以 $M$ 为圆心的圆弧槽中，以杆 $MC$（构件 s）代替"),
        (with_block(), "en", "$C$ of 3 in a circular slot of 0 about $M$"),
    ],
)
def test_it_is_among_the_given_data(scene: dict[str, Any], language: str, told: str) -> None:
    assert told == repr(given_shapes(mechanism_of(scene), Notation("chinese"), language)[-1])


@pytest.mark.parametrize(
    ("scene", "told"),
    [
        (with_pin(), ["Link 2 joins B, C.", "Point C of link 2 runs in a circular slot of link 0 about M."]),
        (with_block(), ["Link 2 joins B, C.", "Link 3 joins C.",
                        "Point C of link 3 runs in a circular slot of link 0 about M."]),
    ],
)
def test_a_figure_is_described_with_it(scene: dict[str, Any], told: list[str]) -> None:
    assert ["The fixed link 0 has the points A, M.", "Link 1 joins A, B.", *told] == structure_words(
        mechanism_of(scene), "en")


def test_the_structure_tells_it_and_the_mobility_after_its_replacement() -> None:
    figure = graphkin.draw(with_pin(), figures=["structure"]).figures["structure"].content("svg").decode()
    assert "pin C in a circular slot of link 0 is a higher pair, replaced by link s, the bar MC" in figure
    assert "F = 3 · 3 − 2 · 4 − 0 = 1" in figure
    assert 'id="badge-C-0"' in figure


def test_the_own_axis_of_a_block_lies_along_the_slot_turned_by_angle_on() -> None:
    def axis(scene: dict[str, Any]) -> complex:
        return cmath.rect(1.0, graphkin.solve(scene).data["positions"][0]["links"]["3"]["angle"])

    spoke = axis(four_bar())
    assert 1j * spoke == pytest.approx(axis(with_block()), abs=1e-12)
    assert 1j * spoke * cmath.rect(1.0, math.radians(35)) == pytest.approx(axis(with_block(35.0)), abs=1e-12)


def test_of_a_straight_guide_and_a_slot_each_keeps_its_angle() -> None:
    made = rocker()
    made["links"]["2"] = {"points": ["B", "D"], "length": 300}
    made["links"]["3"] = {"points": ["C"], "on": ["2", "0.s"], "angle_on": [30, 0]}
    assert [cmath.rect(1.0, math.radians(30))] == [pytest.approx(pair.turn) for pair in mechanism_of(made).slidings]


@pytest.mark.parametrize("scene", [*CASES, with_pin(ends=[60, 150])])
def test_a_file_is_written_again_with_its_slot(scene: dict[str, Any]) -> None:
    one = mechanism_of(scene)
    again = mechanism_of(as_mapping(one))
    assert one.slots == again.slots
    assert one.slides == again.slides
    for link, copy in zip((one.frame, *one.links), (again.frame, *again.links), strict=True):
        assert (link.name, pytest.approx(dict(link.points))) == (copy.name, dict(copy.points))


@pytest.mark.parametrize(
    ("slot", "said"),
    [
        ({"centre": "Q", "r": 1}, "frame.guides.s.centre: link 0 has no point Q; known here: A, M"),
        ({"centre": "M"}, "frame.guides.s.r: is missing; write the slot's radius"),
        ({"r": 3}, 'frame.guides.s.centre: is missing; write centre = "M" or [x, y], and r = ...'),
        (
            {"centre": "M", "r": 3, "angle": 4},
            "frame.guides.s.angle: stands in a slot along a circle; a straight guide has through and angle, a circular "
            "slot centre and r",
        ),
        ({"angle": 3}, "frame.guides.s.through: is missing; write a point of the guide; a circular slot has centre"),
    ],
)
def test_what_is_wrong_with_one_is_said(slot: dict[str, Any], said: str) -> None:
    scene = with_pin()
    scene["frame"]["guides"] = {"s": slot}
    with pytest.raises(SceneError) as refusal:
        graphkin.read(scene)
    assert any(str(p).startswith(said) for p in refusal.value.problems)


@pytest.mark.parametrize(
    ("pin", "said"),
    [
        ({"of": "9", "in": "0.s"}, 'pins.C.of: there is no link "9"'),
        ({"of": "1", "in": "0.s"}, "pins.C.of: link 1 has no point C"),
    ],
)
def test_a_pin_that_is_not_there_is_said(pin: dict[str, Any], said: str) -> None:
    with pytest.raises(SceneError) as refusal:
        graphkin.read({**rocker(), "pins": {"C": pin}})
    assert any(str(p).startswith(said) for p in refusal.value.problems)


def test_a_block_without_a_point_is_asked_for_one_and_not_said_to_slide_on_nothing() -> None:
    scene = with_block()
    scene["links"]["3"]["points"] = []
    with pytest.raises(SceneError, match="points: is missing; name the point of the block that runs") as refusal:
        graphkin.read(scene)
    assert "neither points nor on" not in str(refusal.value)


def test_a_slot_off_the_way_to_what_is_asked_is_left_alone() -> None:
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [300, 0]}, "guides": {"h": {"centre": [300, 300], "r": 160}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 60}, "2": {"points": ["B", "C"], "length": 260},
            "3": {"points": ["C", "D"], "length": 150}, "4": {"points": ["C", "G"], "length": 150},
        },
        "pins": {"G": {"of": "4", "in": "0.h"}}, "driver": {"link": "1", "angle": 50, "omega": 3}, "find": ["v_C"],
    }
    result = graphkin.check(scene)
    assert (True, True) == (result.ok, "v_G" not in [row["symbol"] for row in result.data["readings"]])


def test_two_pins_in_one_slot_run_each_on_its_own_tangent() -> None:
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"centre": [200, 0], "r": 100}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 60}, "2": {"points": ["B", "C"], "length": 150},
            "3": {"points": ["C", "E"], "length": 60},
        },
        "pins": {"C": {"of": "3", "in": "0.h"}, "E": {"of": "3", "in": "0.h"}},
        "driver": {"link": "1", "angle": 50, "omega": 3},
    }
    assert graphkin.check(scene).ok


def pairs_at(scene: dict[str, Any], point: str) -> list[tuple[str, str]]:
    mechanism = mechanism_of(scene)
    return [(joint.first, joint.second) for joint in joints(mechanism) if joint.point == point]


def test_a_pin_in_a_circular_slot_is_paired_with_the_link_that_has_it() -> None:
    scene = with_pin()
    links = {"3": {"points": ["C", "D"], "length": 20}, **scene["links"]}
    for of in ("2", "3"):
        hinge = pairs_at({**scene, "links": links, "pins": {"C": {"of": of, "in": "0.s"}}}, "C")
        assert [("3", "2"), (of, "s")] == hinge


def test_what_a_circular_slot_guides_is_paired_with_the_link_of_the_slot_in_a_centre_on_a_hinge() -> None:
    scene = with_pin()
    links = {**scene["links"], "4": {"points": ["M", "P"], "length": 30, "guides": {"s": {"centre": "M", "r": 120}}}}
    assert [("0", "4"), ("4", "s")] == pairs_at({**scene, "links": links, "pins": {"C": {"of": "2", "in": "4.s"}}}, "M")
    block = {"3": {"points": ["C"], "on": "4.s"}, **links}
    bare = {key: value for key, value in scene.items() if key != "pins"}
    assert [("4", "3"), ("0", "4")] == pairs_at({**bare, "links": block}, "M")


@pytest.mark.parametrize("scene", [with_pin(), with_block()])
def test_it_is_drawn_along_its_circle_to_both_sides_of_what_runs_in_it(scene: dict[str, Any]) -> None:
    figure = graphkin.draw(scene, figures=["mechanism"]).figures["mechanism"]
    (slot,) = (one for one in walk(figure.children) if isinstance(one, Group) and one.id.startswith("slot-"))
    arc = next(one for one in walk((slot,)) if isinstance(one, Arc))
    here = math.remainder(graphkin.solve(four_bar()).data["positions"][0]["links"]["3"]["angle"] - arc.start, math.tau)
    assert 0.0 < here < arc.end - arc.start < math.pi
