"""The object for programs: what it holds, in which units, and that it never holds NaN."""

from __future__ import annotations

import json
import re
from typing import Any

import numpy as np
import pytest

from graphkin.scene import library, mechanism_of, mechanism_of_text
from graphkin.solver import solve, values
from graphkin.solver.values import entries, head, json_text
from tests import scenes
from tests.construction.test_contours import ON_A_GUIDE, THROUGH_A_BLOCK
from tests.solver.checks import to_json


def first(name: str) -> dict[str, Any]:
    found: dict[str, Any] = to_json(solve(mechanism_of(name)))["positions"][0]
    return found


@pytest.mark.parametrize("name", library())
def test_a_sweep_of_any_scene_is_json(name: str) -> None:
    assert json.dumps(to_json(solve(mechanism_of(name), sweep=5)), allow_nan=False)


@pytest.mark.parametrize("name", ["sixbar-AE70", "shaper-scheme-2", "hydraulic-cylinder"])
def test_what_is_written_as_it_goes_is_the_object(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(values, "BLOCK", 5)
    motion = solve(mechanism_of(name), sweep=12)
    whole = json.dumps(to_json(motion), ensure_ascii=False, allow_nan=False) + "\n"
    assert whole == "".join(json_text(head(motion), entries(motion)))


def test_points_are_listed_on_every_link_and_under_every_sliding_pin() -> None:
    assert set(first("sixbar-guide-40deg")["points"]) == {"A@1", "B@1", "B@2", "B@3", "C@3", "D@3", "D@4", "D@5"}


def test_a_swinging_block_has_its_pivot_as_a_point_of_the_rod() -> None:
    assert "C@2" in first("swinging-block")["points"]


def test_a_pin_in_a_slot_is_listed_as_a_slide() -> None:
    table = to_json(solve(mechanism_of_text(scenes.TWO_SLOTS, "scene")))["positions"][0]
    assert set(table["slides"]) == {"2/0", "P/1"}


def test_the_block_of_a_pin_is_no_link() -> None:
    table = to_json(solve(mechanism_of_text(scenes.TWO_SLOTS, "scene")))["positions"][0]
    assert set(table["links"]) == {"1", "2"}


def test_slides_of_the_worked_example_are_signed_along_the_guide() -> None:
    slide = first("sixbar-guide-40deg")["slides"]["2/3"]
    assert [slide["travel"], slide["velocity"], slide["acceleration"]] == pytest.approx(
        [381.602, -575.41, -7725.06], rel=1e-5
    )


def test_coriolis_is_the_term_of_the_sliding_link_relative_to_the_guide() -> None:
    table = first("sixbar-guide-40deg")
    along = np.exp(1j * table["links"]["3"]["angle"])
    expected = 2j * table["links"]["3"]["omega"] * table["slides"]["2/3"]["velocity"] * along
    assert complex(*table["slides"]["2/3"]["coriolis"]) == pytest.approx(expected, rel=1e-12)


def test_a_driven_travel_is_in_the_unit_of_the_scene() -> None:
    position = to_json(solve(mechanism_of_text(scenes.CYLINDER, "scene")))["positions"][0]
    assert position["driver"] == pytest.approx({"2/3": 250})


def test_a_driven_angle_is_in_radians() -> None:
    assert first("sixbar-guide-40deg")["driver"] == pytest.approx({"1": np.radians(50)})


def test_a_position_without_values_has_its_reason_and_no_numbers() -> None:
    table = to_json(solve(mechanism_of("sixbar-AE70"), at={"1": np.radians(90)}))["positions"][0]
    assert set(table) == {"driver", "status", "why"}


def test_angles_begin_in_the_half_open_turn() -> None:
    text = scenes.FOUR_BAR.replace("angle = 60", "angle = 500")
    table = to_json(solve(mechanism_of_text(text, "scene")))["positions"][0]
    assert table["links"]["1"]["angle"] == pytest.approx(np.radians(140))


def test_half_a_turn_is_written_positive() -> None:
    text = scenes.FOUR_BAR.replace("angle = 60", "angle = -180")
    assert to_json(solve(mechanism_of_text(text, "scene")))["positions"][0]["links"]["1"]["angle"] == np.pi


GROUPS = {
    "FOUR_BAR": {"class": 2, "kind": "RRR", "links": ["2", "3"], "assembly": "C left of B to D"},
    "OFFSET_SLIDER": {"class": 2, "kind": "RRP", "links": ["2", "3"], "assembly": "further along 0.h"},
    "OFFSET_SWING": {"class": 2, "kind": "RPR", "links": ["2", "3"], "assembly": "on the positive side of 3.s"},
    "OLDHAM": {"class": 2, "kind": "RPP", "links": ["2", "3"], "assembly": "the only one"},
}


@pytest.mark.parametrize("name", GROUPS)
def test_a_group_says_its_class_kind_links_and_assembly(name: str) -> None:
    assert to_json(solve(mechanism_of_text(getattr(scenes, name), name)))["groups"] == [GROUPS[name]]


@pytest.mark.parametrize("scene", [scenes.TRIAD, ON_A_GUIDE, THROUGH_A_BLOCK], ids=["triad", "guide", "block"])
def test_the_assembly_of_a_larger_group_is_said_as_it_lies(scene: Any) -> None:
    motion = solve(mechanism_of_text(scene, "scene") if isinstance(scene, str) else mechanism_of(scene))
    (said,) = (group["assembly"] for group in to_json(motion)["groups"])
    sides = re.findall(r"(\w+) (left|right) of (\w+) to (\w+)", said)
    for inner, side, one, two in sides:
        z, p, q = (complex(motion.point(name).z[0]) for name in (inner, one, two))
        assert side == ("left" if ((q - p).conjugate() * (z - p)).imag > 0 else "right")
    slides = re.findall(r"(\w+) on the (positive|negative) side of (\w+)\.(\w+)", said)
    for link, sign, rail, name in slides:
        guide, pose = motion.scene.by_name[rail].guides[name], motion.poses[rail]
        along = complex(((motion.poses[link].z - pose.z) / pose.u)[0]) - guide.through
        assert sign == ("positive" if (along / guide.direction).real > 0 else "negative")
    assert len(sides) + len(slides) >= 2


def test_the_other_assembly_is_said() -> None:
    text = scenes.FOUR_BAR + "[sketch]\nC = [300, -250]\n"
    assert to_json(solve(mechanism_of_text(text, "scene")))["groups"][0]["assembly"] == "C right of B to D"
