"""Points pulled by hand, in every kind of mechanism; what one pull does is in `test_answers`."""

from __future__ import annotations

import pytest

from graphkin.board.answers import answer
from graphkin.board.building import movable
from graphkin.board.shelf import Shelf
from graphkin.scene import mechanism_of
from graphkin.scene.scene import library_text
from tests.scenes import YOKE


@pytest.mark.parametrize("name", [
    "four-bar-coupler-point", "shaper-scheme-2", "whitworth", "hydraulic-cylinder", "single-flier", "sixbar-AE70",
    "elliptic-trammel", "cam-eccentric-flat-rocker", "double-butterfly",
])
def test_each_point_that_says_so_can_be_pulled_in_every_kind_of_mechanism(name: str) -> None:
    desk, text = Shelf(first=name), library_text(name)
    start = answer(desk, {"do": "show", "text": text, "figures": ["mechanism"]})
    for point, at in start["points"].items():
        if at["pull"]:
            there = {"x": at["x"] + 2e-3 * start["perMm"], "y": at["y"] + 1e-3 * start["perMm"]}
            found = answer(desk, {"do": "pull", "text": text, "point": point, **there, "quick": True, "figures": []})
            assert found["ok"], (point, found)


def test_a_link_driven_along_another_is_not_pulled_along_the_frame():
    assert {"A": "frame", "B": "lengths"} == movable(mechanism_of(YOKE))
