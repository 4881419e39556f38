"""Proportional division of what trials leave open."""

from __future__ import annotations

import pytest

from graphkin.construction.board.proportional_division import divide, magnified, shares

pytestmark = pytest.mark.quick


def test_one_thing_tried_is_divided_between_two_trials_by_what_they_leave_open():
    assert [2.5] == pytest.approx(divide([[2.0], [4.0]], [[-1.0], [3.0]]).tolist())


def test_several_things_tried_are_found_from_one_trial_more():
    # open: x + 2 y - 5 and x - y + 1, which close at x = 1, y = 2
    trials = [[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]]
    gaps = [[x + 2 * y - 5, x - y + 1] for x, y in trials]
    assert [1.0, 2.0] == pytest.approx(divide(trials, gaps).tolist())
    assert [1 / 3, 1 / 2] == pytest.approx(shares(gaps).tolist())


def test_more_left_open_than_is_tried_is_divided_all_the_same():
    assert [3.0] == pytest.approx(divide([[0.0], [1.0]], [[-3.0, -6.0], [-2.0, -4.0]]).tolist())


def test_a_place_moves_so_many_times_as_far_as_what_is_left_open():
    assert 4.0 == pytest.approx(magnified([[0j, 1j], [8.0 + 0j, 1j]], [[1.0], [3.0]]))
