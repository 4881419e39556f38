"""Systems of one pattern at many positions, whose answers are known."""

from __future__ import annotations

import numpy as np
import pytest

from graphkin.solver.linear_blocks import LinearBlocks

pytestmark = pytest.mark.quick

EPS = float(np.finfo(float).eps)
N = 7
HILBERT = 1.0 / (1.0 + np.add.outer(np.arange(N), np.arange(N)))


def system(matrix: np.ndarray) -> LinearBlocks:
    entries = {(i, k): np.array([x]) for (i, k), x in np.ndenumerate(matrix) if x}
    return LinearBlocks(entries, *matrix.shape, np.ones(1, dtype=bool))


def test_an_answer_leaves_no_more_than_rounding_of_an_ill_conditioned_block() -> None:
    right = HILBERT @ np.arange(1.0, N + 1)
    solution, ok = system(HILBERT).answer(right[:, None])
    residual = np.abs(HILBERT @ solution[:, 0] - right).max()
    assert (True, True) == (bool(ok[0]), bool(residual <= 4 * EPS * (HILBERT @ np.abs(solution[:, 0])).max()))


def test_blocks_follow_those_they_need() -> None:
    matrix = np.array([[0.0, 1.0, 2.0], [1.0, 1.0, 0.0], [0.0, 0.0, 4.0]])
    solution, _ = system(matrix).answer(np.array([[7.0], [3.0], [8.0]]))
    assert [0.0, 3.0, 2.0] == pytest.approx(solution[:, 0].tolist(), abs=1e-15)


def test_a_pattern_without_an_answer_is_solvable_nowhere() -> None:
    assert [False] == system(np.array([[1.0, 0.0], [1.0, 0.0]])).solvable.tolist()


def test_errors_spread_without_cancelling() -> None:
    matrix = np.array([[1.0, 0.0], [2.0, 1.0]])
    assert [[1.0], [3.0]] == system(matrix).spread(np.ones((2, 1))).tolist()
