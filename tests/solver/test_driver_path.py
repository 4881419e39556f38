"""Where a group closes along a path: touches flip, crossings end, and no stretch is too short to be seen."""

from __future__ import annotations

import math
from collections.abc import Callable
from decimal import Decimal
from typing import Any

import numpy as np
import pytest

from graphkin.scene import mechanism_of
from graphkin.solver import structure_of
from graphkin.solver.algebra.pose import Array
from graphkin.solver.path.dead_points import dead_points
from graphkin.solver.path.driver_path import Stretch, closed
from graphkin.solver.path.driver_range import range_of
from graphkin.study.turn import ranges
from tests.scenes import four_bar

pytestmark = pytest.mark.quick


def along(gap: Callable[[Array], Array]) -> list[Stretch]:
    return closed(gap, 0.0, 1.0)


def test_a_positive_discriminant_lets_pass() -> None:
    assert [Stretch(0.0, 1.0)] == along(lambda t: 0.2 + (t - 0.5) ** 2)


def test_a_crossing_ends_the_motion_at_its_place() -> None:
    (found,) = along(lambda t: 0.3 - t)
    assert (0.3, (False, True)) == (pytest.approx(found.high, abs=1e-16), found.ends)


def test_a_short_dip_ends_the_motion() -> None:
    first, second = along(lambda t: (t - 0.5123) ** 2 - 1e-8)
    assert [0.5122, 0.5124] == pytest.approx([first.high, second.low], abs=1e-12)


def test_a_short_stretch_is_seen() -> None:
    (found,) = along(lambda t: 1e-10 - (t - 0.4321) ** 2)
    assert [0.43209, 0.43211] == pytest.approx([found.low, found.high], abs=1e-11)


def test_a_near_miss_is_no_touch() -> None:
    assert [Stretch(0.0, 1.0)] == along(lambda t: (t - 0.5123) ** 2 + 1e-10)


@pytest.mark.parametrize("place", [0.5, 0.5123, 0.003, 0.9971])
@pytest.mark.parametrize("below", [0.0, 1e-15])
def test_a_touch_is_a_change_point_also_where_rounding_is_below_zero(place: float, below: float) -> None:
    (found,) = along(lambda t: (t - place) ** 2 - below)
    assert (0.0, 1.0, (place,)) == (found.low, found.high, pytest.approx(found.touches, abs=1e-7))


def test_a_dip_that_only_fifty_digits_tell_ends_the_motion_on_both_sides() -> None:
    dip = Decimal("0.49999"), Decimal("0.50001")
    first, second = closed(lambda t: (t - 0.5) ** 2 - 1e-10, 0.0, 1.0, lambda _: dip)
    assert (0.49999, 0.50001, (), ()) == (first.high, second.low, first.touches, second.touches)


def test_two_touches_are_two_change_points() -> None:
    (found,) = along(lambda t: np.sin(2 * np.pi * (t + 0.1)) ** 2)
    assert (0.4, 0.9) == pytest.approx(found.touches, abs=1e-9)


@pytest.mark.parametrize("gap", [lambda t: t * t * (2 - t), lambda t: (t - 1e-9) ** 2])
def test_a_start_at_zero_is_no_touch(gap: Callable[[Array], Array]) -> None:
    assert [Stretch(0.0, 1.0)] == along(gap)


def test_a_path_may_end_at_zero() -> None:
    assert [Stretch(0.0, 1.0)] == along(lambda t: 1 - t)


PARALLEL: dict[str, Any] = {
    # crank and coupler are in line at the angle of a 3-4-5 triangle, where the rocker stands upright, as the guide does
    "frame": {"points": {"A": [0, 0], "D": [40, 0]}, "guides": {"h": {"through": [60, 0], "angle": 90}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 15},
        "2": {"points": ["B", "C"], "length": 35},
        "3": {"points": ["D", "C"], "length": 30, "guides": {"s": {"through": "D", "angle": 0}}},
        "4": {"points": ["E"], "on": "3.s"},
        "5": {"points": ["E"], "on": "0.h"},
    },
    "driver": {"link": "1", "angle": 60, "omega": 1},
    "sketch": {"C": [35, 29]},
}


def test_guides_that_become_parallel_for_a_moment_end_the_motion() -> None:
    reach = range_of(structure_of(mechanism_of(PARALLEL)))
    limits = [math.atan2(3, 4), math.atan2(3, 4) + 2 * math.pi]
    assert limits == pytest.approx(reach.value(np.array(reach.ends)).tolist(), abs=1e-9)


SHORT: dict[str, Any] = {
    # a cylinder turns a bar, whose end takes a second pair of bars along: these reach between 24 and 112 from P4
    "frame": {"points": {"P1": [0, 0], "P2": [70, 24], "P4": [122, 166]}},
    "links": {
        "1": {"points": ["P1", "P3"], "length": 230},
        "2": {"points": ["P2"]},
        "3": {"points": ["P4", "P5"], "length": 44},
        "4": {"points": ["P3", "P5"], "length": 68},
    },
    "pins": {"P3": {"of": "1", "in": "2"}},
    "driver": {"slide": "P3/2", "travel": 169, "velocity": 3},
    "sketch": {"P3": [160, 165], "P5": [104, 126]},
}


def cylinder(reach: float, sense: float) -> float:
    """Length of the cylinder (mm) where the second pair of bars is at the end of its reach, by the law of cosines."""
    across = abs(complex(122, 166))
    turned = math.acos((230**2 + across**2 - reach**2) / (2 * 230 * across))
    end = 230 * np.exp(1j * (math.atan2(166, 122) + sense * turned))
    return float(abs(end - complex(70, 24)))


LENGTHS = sorted(cylinder(reach, sense) for reach in (24, 112) for sense in (1, -1))


def test_dead_points_close_to_those_of_the_group_before_are_found() -> None:
    found = [p for p in dead_points(structure_of(mechanism_of(SHORT))) if p.element == 1]
    assert [-x for x in LENGTHS[::-1]] + LENGTHS == pytest.approx([1000 * float(p.value) for p in found], abs=1e-9)


def test_a_short_gap_between_two_ranges_is_seen() -> None:
    found = ranges(range_of(structure_of(mechanism_of(SHORT))))
    expected = [LENGTHS[:2], LENGTHS[2:], [-x for x in LENGTHS[:2][::-1]], [-x for x in LENGTHS[2:][::-1]]]
    assert sorted(expected) == [pytest.approx([1000 * r.low, 1000 * r.high], abs=1e-9) for r in
                                sorted(found, key=lambda r: r.low)]


def test_links_that_nearly_lie_in_line_pass_no_change_point() -> None:
    # least discriminant some 1e-11: fifty digits tell that it does not touch zero
    reach = range_of(structure_of(mechanism_of(four_bar(149.99999999, 400, 150, 400))))
    assert (1, ()) == (reach.turns, reach.change_points)
