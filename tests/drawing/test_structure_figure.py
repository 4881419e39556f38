"""The figure of the structure: the count in numbers, and every group in the reverse order of solution."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

import graphkin
from graphkin.drawing import svg_bytes
from graphkin.errors import CallError


def drawn(name: str, driver: str = "", language: str = "en") -> ET.Element:
    figures = graphkin.draw(name, figures=["structure"], driver=driver, language=language).figures
    return ET.fromstring(svg_bytes(figures["structure"]))


@pytest.fixture(scope="module")
def shaper() -> ET.Element:
    return drawn("shaper-scheme-2", "6")


def words(root: ET.Element) -> str:
    return " ".join(" ".join(e.itertext()) for e in root.iter("{http://www.w3.org/2000/svg}text"))


def test_the_groups_of_both_drivers_are_taken_apart(shaper: ET.Element) -> None:
    ids = {e.get("id") for e in shaper.iter()}
    assert {f"group-{driver}-{k}" for driver in ("2", "6-1") for k in (1, 2, 3)} <= ids


def test_the_mobility_stands_there_in_numbers(shaper: ET.Element) -> None:
    assert "n = 5 moving links, 7 lower pairs, 0 higher pairs" in words(shaper)


def test_each_group_tells_its_kind_class_and_joints(shaper: ET.Element) -> None:
    assert "links 5, 6: RRP class II, inner C, outer B, 6/1" in words(shaper)


def test_a_compound_hinge_has_its_badge() -> None:
    assert "badge-B" in {e.get("id") for e in drawn("toggle-press").iter()}


def test_a_driver_that_is_no_link_is_refused() -> None:
    with pytest.raises(CallError, match='driver 9: there is no link "9"'):
        _ = graphkin.draw("shaper-scheme-2", figures=["structure"], driver="9").figures


def test_a_cam_stays_in_its_panel_and_its_rollers_own_turning_is_told() -> None:
    root = drawn("cam-offset-roller")
    cam = next(e for e in root.iter("{http://www.w3.org/2000/svg}g") if e.get("id") == "cam-1")
    shape = next(cam.iter("{http://www.w3.org/2000/svg}polygon"))
    corners = [tuple(map(float, corner.split(","))) for corner in shape.get("points").split()]
    assert min(y for _, y in corners) > 15.0  # below the heading
    assert max(x for x, _ in corners) < 110.0  # left of the words
    assert "own turning" in words(root)
    assert "in a slot" not in words(root)


def test_a_driver_inside_a_group_has_no_empty_panel() -> None:
    root = drawn("scissor-lift", language="zh")
    panels = [e for e in root.iter("{http://www.w3.org/2000/svg}g") if e.get("class") == "panel"]
    assert 1 == len(panels)
    assert "级杆组，" in words(root)
