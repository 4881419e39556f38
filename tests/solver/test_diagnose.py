"""Wrong mobility is told apart: redundant, over-constrained, not to be closed, wrongly counted."""

from __future__ import annotations

import math
import re
from typing import Any

import pytest

from graphkin.errors import Unsolvable
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.solver import solve
from tests import scenes

pytestmark = pytest.mark.quick


def refused(text: str) -> str:
    with pytest.raises(Unsolvable) as stop:
        solve(mechanism_of_text(text, "scene"))
    assert stop.value.status == "mobility"
    return str(stop.value)


def test_a_third_crank_of_a_double_parallelogram_is_named_as_redundant() -> None:
    said = refused(scenes.DOUBLE_PARALLELOGRAM.replace("redundant = true", ""))
    assert "write redundant = true in [links.4]" in said


def test_a_link_that_fits_here_but_locks_is_over_constrained() -> None:
    # its frame pin moved away, its length that to E at this position: E = (200, 106.60254) for F = (150, 90)
    text = scenes.DOUBLE_PARALLELOGRAM.replace("redundant = true", "").replace(
        "F = [150, 20]", "F = [200, 6.602540378443865]"
    )
    said = refused(text.replace('points = ["F", "E"]\nlength = 100', 'points = ["F", "E"]\nlength = 100.0'))
    assert "locks" in said


TWO_DRIVERS = scenes.FOUR_BAR.replace("[driver]", "[[driver]]") + '[[driver]]\nlink = "3"\nangle = 90\nomega = 1\n'


def test_a_truss_does_not_fit() -> None:
    assert "does not fit" in refused(scenes.TRUSS)


def test_a_truss_has_its_count_said() -> None:
    assert "F = 3*4 - 2*6 = 0" in refused(scenes.TRUSS)


def test_a_loop_of_wedges_is_named() -> None:
    assert "1, 2 slide on each other in a closed loop" in refused(scenes.WEDGES)


def test_a_missing_driver_is_counted() -> None:
    text = scenes.FIVE_BAR.rsplit("[[driver]]", 1)[0]
    assert "F = 3*4 - 2*5 = 2, but 1 driver given" in refused(text)


def test_a_driver_too_many_is_counted() -> None:
    assert "F = 3*3 - 2*4 = 1, but 2 drivers given" in refused(TWO_DRIVERS)


def test_drivers_of_which_there_are_too_many_are_named() -> None:
    assert "too many drivers (1, 3)" in refused(TWO_DRIVERS)


def test_with_a_driver_too_many_no_link_is_to_be_left_out() -> None:
    assert "leave" not in refused(TWO_DRIVERS)


def test_a_redundant_link_that_does_not_fit_is_named_with_its_miss() -> None:
    text = scenes.DOUBLE_PARALLELOGRAM.replace('"E"]\nlength = 100', '"E"]\nlength = 101')
    assert "links.4.redundant: it misses its joints by 1 mm" in refused(text)


@pytest.mark.parametrize(("link", "miss"), [
    ({"length": math.hypot(20, 10), "on": "0.h"}, 20 * math.sin(math.atan(0.5) / 2) * math.sqrt(5)),  # held askew
    ({"length": math.hypot(20, 10), "at": {"M": [math.sqrt(125), 0]}, "on": "0.h"},
     20 * math.sin(math.atan(0.5) / 2) * math.sqrt(5)),  # also where a third joint lies between them
    ({"length": math.hypot(20, 10.002)}, 0.0008942),
])
def test_the_miss_of_a_redundant_link_is_that_of_its_ends(link: dict[str, Any], miss: float) -> None:
    scene = scenes.slider_crank(50, 120)
    scene["links"]["3"]["at"] = {"E": [30, 0], "F": [50, 10], "M": [40, 5]}
    scene["links"]["4"] = {"points": ["E", "F"], "redundant": True, **link}
    with pytest.raises(Unsolvable) as refusal:
        solve(mechanism_of(scene))
    told = re.search(r"it misses its joints by ([\d.e-]+) mm", str(refusal.value))
    assert told is not None
    assert miss == pytest.approx(float(told[1]), rel=1e-3)


def test_a_redundant_link_stands_between_its_joints_wherever_they_lie_on_it() -> None:
    scene = scenes.slider_crank(50, 120)
    scene["links"]["3"]["at"] = {"E": [30, 0], "F": [50, 10]}
    scene["links"]["4"] = {"points": ["E", "X"], "length": 10, "at": {"F": [10, -20]}, "redundant": True}
    assert math.pi / 2 == pytest.approx(solve(mechanism_of(scene)).angle("4")[0])


def test_a_redundant_link_that_would_lock_is_refused() -> None:
    text = scenes.DOUBLE_PARALLELOGRAM.replace("F = [150, 20]", "F = [200, 6.602540378443865]")
    assert "would stop the motion" in refused(text)
