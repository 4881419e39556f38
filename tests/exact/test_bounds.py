"""The stated error bounds against 50 digits on random mechanisms (a hundred thousand: tests/bench/accuracy.py)."""

from __future__ import annotations

import pytest

from tests.bench.accuracy import Tally, measure


@pytest.fixture(scope="module", params=[False, True], ids=["16 digits throughout", "as given out"])
def tally(request: pytest.FixtureRequest) -> Tally:
    return measure(600, 7, request.param, each=3)


def test_the_true_error_never_exceeds_the_bound(tally: Tally) -> None:
    assert tally.broken == []


def test_nine_bounds_in_ten_are_within_1000_times_the_true_error(tally: Tally) -> None:
    assert tally.within > 0.88  # of a few hundred; of a hundred thousand it is more than 0.9


def test_next_to_nothing_is_refused(tally: Tally) -> None:
    assert tally.refused < 0.02 * len(tally.ratios)
