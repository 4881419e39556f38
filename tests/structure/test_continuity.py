"""Following a discriminant: touches flip, crossings end, and nothing is missed between the nodes."""

from __future__ import annotations

import numpy as np
import pytest

from graphkin.structure.assembly import follow, last_true

GRID = np.linspace(0.0, 1.0, 41)


def test_a_positive_discriminant_lets_pass() -> None:
    assert follow(lambda t: 0.2 + (t - 0.5) ** 2, GRID).limit is None


def test_a_crossing_ends_the_motion_at_its_place() -> None:
    assert follow(lambda t: 0.3 - t, GRID).limit == pytest.approx(0.3, abs=1e-15)


def test_a_short_dip_between_two_nodes_ends_the_motion() -> None:
    place = 0.5 + 1 / 80
    assert follow(lambda t: (t - place) ** 2 - 1e-8, GRID).limit == pytest.approx(place - 1e-4, abs=1e-12)


def test_a_near_miss_between_two_nodes_is_no_touch() -> None:
    passage = follow(lambda t: (t - 0.5123) ** 2 + 1e-10, GRID)
    assert passage.limit is None
    assert len(passage.flips) == 0


@pytest.mark.parametrize("place", [0.5, 0.5123, 0.003, 0.9971])
def test_a_touch_flips_the_sign(place: float) -> None:
    passage = follow(lambda t: (t - place) ** 2, GRID)
    assert passage.flips == pytest.approx([place], abs=1e-7)


def test_a_touch_with_rounding_below_zero_still_flips() -> None:
    passage = follow(lambda t: (t - 0.5) ** 2 - 1e-15, GRID)
    assert (passage.limit, len(passage.flips)) == (None, 1)


def test_two_touches_flip_twice() -> None:
    passage = follow(lambda t: np.sin(2 * np.pi * (t + 0.1)) ** 2, GRID)
    assert passage.sign(np.array([0.0, 0.5, 1.0])) == pytest.approx([1, -1, 1])


def test_a_touch_of_two_parallel_lines_ends_the_motion() -> None:
    assert follow(lambda t: (t - 0.4) ** 2, GRID, flips=False).limit == pytest.approx(0.4, abs=2e-6)


def test_a_start_at_zero_is_no_touch() -> None:
    assert len(follow(lambda t: t * t * (2 - t), GRID).flips) == 0


def test_a_start_at_zero_with_rounding_is_no_touch() -> None:
    assert len(follow(lambda t: (t - 1e-9) ** 2, GRID).flips) == 0


def test_a_path_may_end_at_zero() -> None:
    assert follow(lambda t: 1 - t, GRID).limit is None


def test_last_true_finds_the_edge_to_rounding() -> None:
    assert last_true(lambda t: t * t < 2, 1.0, 2.0) == pytest.approx(np.sqrt(2), abs=5e-16)


@pytest.mark.parametrize("high", [0.0, 1.0])
def test_the_end_of_a_condition_is_found_in_either_direction(high: float) -> None:
    assert last_true(lambda x: np.abs(x - 0.5) <= 0.1, 0.5, high) == pytest.approx(0.5 + (high - 0.5) / 5, abs=1e-15)
