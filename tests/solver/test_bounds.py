"""The stated error bounds against 50 digits on random mechanisms (a hundred thousand: tests/bench/accuracy.py)."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import pytest

from tests import EVERYTHING
from tests.bench.accuracy import measure
from tests.bench.larger import measure_larger
from tests.bench.tally import KINDS, Tally

MANY = 20 if EVERYTHING else 1
RUNS: dict[str, Callable[[], Tally]] = {
    "16 digits throughout": lambda: measure(MANY * 180, 7, False, each=3),
    "as given out": lambda: measure(MANY * 180, 7, True, each=3),
    "larger groups": lambda: measure_larger(MANY * 48, 3, each=12),
}


@cache
def measured(run: str) -> Tally:
    return RUNS[run]()


@pytest.fixture(params=list(RUNS))
def tally(request: pytest.FixtureRequest) -> Tally:
    return measured(request.param)


def test_the_true_error_never_exceeds_the_bound(tally: Tally) -> None:
    assert tally.broken == []


@pytest.mark.parametrize("kind", KINDS)
def test_nine_bounds_in_ten_are_within_1000_times_the_true_error(tally: Tally, kind: str) -> None:
    assert tally.within(kind) > 0.88  # of a few hundred; of a hundred thousand it is more than 0.9


def test_next_to_no_position_of_dyads_is_refused() -> None:
    tally = measured("as given out")
    assert tally.refused < 0.02 * len(tally.ratios)
