"""A later group that cannot be assembled, because an earlier one lies the wrong way about."""

from __future__ import annotations

import re

import numpy as np
import pytest

import graphkin


def _two_groups(seed: int) -> dict[str, object]:
    """A slotted bar or a rocker, whose other assembly alone lets the rod on it reach its guide."""
    rng = np.random.default_rng(seed)
    crank, down, bar = rng.uniform(80, 120), rng.uniform(180, 220), rng.uniform(380, 420)
    slotted = {
        "2": {"points": ["B"], "on": "3.s"},
        "3": {"points": ["C", "D"], "length": bar, "guides": {"s": {"through": "C", "angle": 180}}},
    }
    rocker = {
        "2": {"points": ["B", "G"], "length": 260},
        "3": {"points": ["C", "G"], "length": 190, "at": {"D": {"from": "C", "r": bar, "toward": "G", "angle": -60}}},
    }
    return {
        "frame": {"points": {"A": [0, 0], "C": [0, -down]}, "guides": {"h": {"through": [0, 190], "angle": 0}}},
        "links": {"1": {"points": ["A", "B"], "length": crank}, **(rocker if seed % 2 else slotted),
                  "4": {"points": ["D", "E"], "length": 90}, "5": {"points": ["E"], "on": "0.h"}},
        "driver": {"link": "1", "angle": rng.uniform(60, 120), "omega": 10},
    }


@pytest.mark.quick
@pytest.mark.parametrize("seed", range(1, 12, 2))
def test_a_group_that_reaches_in_the_other_assembly_of_an_earlier_one_is_told_the_point_to_sketch(seed: int) -> None:
    given = _two_groups(seed)
    first = graphkin.solve(given).data["positions"][0]
    assert "not assembled" == first["status"]
    hint = re.search(r"other assembly they do: write (\w+) = \[(\S+), (\S+)\] in \[sketch\]", first["why"])
    assert hint is not None
    place = [float(hint[2]), float(hint[3])]
    again = graphkin.solve({**given, "sketch": {hint[1]: place}}).data["positions"][0]
    assert pytest.approx(place, rel=1e-5, abs=1e-3) == again["points"][f"{hint[1]}@3"]["position"]


@pytest.mark.quick
@pytest.mark.parametrize("seed", range(0, 12, 2))
def test_a_slotted_bar_that_only_one_way_lets_the_rod_reach_points_that_way(seed: int) -> None:
    place = graphkin.solve(_two_groups(seed)).data["positions"][0]["points"]["D@3"]["position"]
    assert place[1] > 90  # the rod of 90 is to reach the guide at 190 from D
