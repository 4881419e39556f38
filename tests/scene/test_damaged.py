"""Damaged scene files: sentences and statuses, never a traceback, and never for long."""

from __future__ import annotations

import pytest

from graphkin import GraphkinError
from graphkin.scene import mechanism_of, mechanism_of_text

from ..bench.damaged import damaged, what_gives_way


@pytest.mark.parametrize("first", range(0, 200, 50))
def test_a_damaged_scene_is_solved_and_checked_or_told_what_is_wrong(first: int) -> None:
    assert [] == [line for seed in range(first, first + 50) for line in what_gives_way(seed, drawn=seed % 25 == 0)]


def test_some_damaged_scenes_are_scenes_and_most_are_not() -> None:
    good = 0
    for seed in range(100):
        source = damaged(seed)
        try:
            assert mechanism_of_text(source, "damaged") if isinstance(source, str) else mechanism_of(source)
            good += 1
        except GraphkinError:
            pass
    assert 10 < good < 90
