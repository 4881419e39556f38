"""Curves of instant centres, in pieces that a pen draws without lifting."""

from __future__ import annotations

import numpy as np
import pytest

from graphkin.study.centrodes import branches

pytestmark = pytest.mark.quick


def test_a_curve_is_lifted_behind_the_last_place_before_infinity() -> None:
    places = np.array([0.0, 1.0, 5.0, 6.0], dtype=complex)
    assert [[0j, 1 + 0j], [5 + 0j, 6 + 0j]] == branches(places, np.array([True, False, True]))


def test_a_place_that_is_not_known_is_passed_over() -> None:
    places = np.array([0.0, np.nan, 2.0], dtype=complex)
    assert [[0j], [2 + 0j]] == branches(places, np.array([False, False]))
