"""The quantities of all that moves, and the columns of words beside them."""

from __future__ import annotations

import tracemalloc

from graphkin.scene import mechanism_of
from graphkin.structure import analyse
from graphkin.study.quantities import all_that_moves, word_column


def test_what_moves_are_links_points_and_pairs_each_once_and_no_point_of_the_frame() -> None:
    every = [str(quantity) for quantity in all_that_moves(analyse(mechanism_of("sixbar-guide-40deg")))]
    links = [f"{kind}_{link}" for link in "12345" for kind in ("theta", "omega", "alpha")]
    points = ["B", "v_B", "a_B", "v_B@3", "a_B@3", "v_D@3", "a_D@3", "D", "v_D", "a_D"]
    assert [*links, *points] == every[: len(links) + len(points)]
    assert [f"{kind}_{pair}" for pair in ("2/3", "4/3", "5/6") for kind in "sva"] == every[len(links) + len(points) :]


def test_a_column_of_words_keeps_each_word_once() -> None:
    why = "x" * 1000
    tracemalloc.start()
    column = word_column("why", [why, ""] * 2000, 4000)
    held = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert [why, ""] == column.values[:2].tolist()
    assert held < 500_000
    assert ["ok"] * 3 == word_column("status", ["ok"], 3).values.tolist()
