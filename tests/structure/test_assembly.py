"""Which assembly a scene means: drawn, then sketched, then the rule."""

from __future__ import annotations

from dataclasses import replace

import pytest

from graphkin.errors import SceneError
from graphkin.scene.model import Mechanism, PlacedLink
from graphkin.scene.pairs import PlacedGuide
from graphkin.structure import pick

pytestmark = pytest.mark.quick

OWN = {"": PlacedGuide("", 0j, 1 + 0j)}
FRAME = PlacedLink("0", {"A": 0j, "D": 0.4 + 0j}, (), OWN)
SCENE = Mechanism("s", FRAME, (PlacedLink("1", {"A": 0j, "B": 0.1 + 0j}, ("A", "B"), OWN),), (), ())
UP, DOWN = {"C": 0.2 + 0.1j}, {"C": 0.2 - 0.1j}


def test_a_sketch_wins_over_the_rule() -> None:
    assert 1 == pick(replace(SCENE, sketch={"C": 0.3 - 0.02j}), ["2"], [UP, DOWN], 0)


def test_without_a_sketch_the_rule_decides() -> None:
    assert 0 == pick(SCENE, ["2"], [UP, DOWN], 0)


def test_a_sketch_that_cannot_tell_leaves_it_to_the_rule() -> None:
    assert 0 == pick(replace(SCENE, sketch={"C": 0.3 + 0j}), ["2"], [UP, DOWN], 0)


def test_a_sketched_point_that_lies_in_one_place_but_for_rounding_leaves_it_to_the_rule() -> None:
    first, second = {"C": 0.2 + 0.1j, "M": -0.2 + 0j}, {"C": 0.2 + (0.1 - 1e-16) * 1j, "M": 0.4 + 0j}
    assert 0 == pick(replace(SCENE, sketch={"C": 0.3 - 0.2j}), ["2"], [first, second], 0)


def test_drawn_points_pick() -> None:
    assert 1 == pick(replace(SCENE, drawn=DOWN), ["2"], [UP, DOWN], 0)


def test_drawn_points_win_over_a_sketch() -> None:
    assert 1 == pick(replace(SCENE, drawn=DOWN, sketch=UP), ["2"], [UP, DOWN], 0)


def test_drawn_points_in_no_assembly_are_refused_with_both_places() -> None:
    with pytest.raises(SceneError, match=r"drawn.C: drawn at \[200, 50\].*\[200, 100\]"):
        pick(replace(SCENE, drawn={"C": 0.2 + 0.05j}), ["2"], [UP, DOWN], 0)


def test_without_a_rule_the_assemblies_are_listed_to_paste() -> None:
    with pytest.raises(SceneError, match=r"sketch = \{ C = \[200, 100\] \}\n  sketch = \{ C = \[200, -100\] \}"):
        pick(SCENE, ["2", "3"], [UP, DOWN], None)


def test_a_single_assembly_is_taken_without_a_rule() -> None:
    assert 0 == pick(SCENE, ["2"], [UP], None)
