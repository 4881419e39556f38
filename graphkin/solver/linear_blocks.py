"""Linear systems at many positions at once, and those of one pattern solved block by block in the order that it gives.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from graphkin.structure.groups import components, match

__all__ = ["LinearBlocks", "solve_all"]

Array = NDArray[Any]
Entry = float | Array
DEAD = 1e-10
"""A block of entries of order 1 whose inverse is greater than 1 / DEAD has no answer."""


def solve_all(matrix: Array, right: Array) -> Array:
    """Solve a stack of linear systems; a singular one gives NaN instead of an error for all.

    matrix, right : shape (n, k, k), and (n, k) or (n, k, columns)
    """
    if right.ndim == 2:
        return np.asarray(solve_all(matrix, right[..., None])[..., 0])
    try:
        return np.asarray(np.linalg.solve(matrix, right))
    except np.linalg.LinAlgError:
        with np.errstate(invalid="ignore"):
            regular = np.linalg.slogdet(matrix)[0] != 0.0
        solution = np.full_like(right, np.nan)
        solution[regular] = np.linalg.solve(matrix[regular], right[regular])
        return solution


class _Block(NamedTuple):
    """Some of the unknowns and the equations that give them.

    inverse : shape (n, k, k)
    onward : entries of these unknowns in the equations of later blocks
    """

    rows: list[int]
    columns: list[int]
    inverse: Array
    onward: Mapping[tuple[int, int], Entry]


@dataclass(frozen=True)
class LinearBlocks:
    """Square systems at n positions, whose blocks each come after those it needs: of forces, the mechanism's groups in
    the reverse order of solution (Dulmage and Mendelsohn, Coverings of bipartite graphs, Canad. J. Math. 10, 1958).

    entries : by row and column, a number that is the same everywhere, or an array of shape (n,); of order 1
    good : where there is something to solve, shape (n,)
    """

    entries: Mapping[tuple[int, int], Entry]
    rows: int
    columns: int
    good: Array

    @cached_property
    def _blocks(self) -> list[_Block] | None:
        """Each block after those it needs; None for a pattern that has no answer."""
        unknowns: list[list[int]] = [[] for _ in range(self.rows)]
        for (row, column), entry in self.entries.items():
            if isinstance(entry, float) or (np.nan_to_num(entry) != 0.0).any():
                unknowns[row].append(column)
        row_of = {unknown: row for row, unknown in match(unknowns).items()}
        if self.rows != self.columns or len(row_of) < self.rows:
            return None
        blocks, done = [], set[int]()
        for columns in components({unknown: unknowns[row] for unknown, row in row_of.items()}):
            rows = [row_of[column] for column in columns]
            done.update(rows)
            matrix = np.zeros((len(self.good), len(rows), len(rows)))
            for i, row in enumerate(rows):
                for k, column in enumerate(columns):
                    matrix[:, i, k] = self.entries.get((row, column), 0.0)
            onward = {(r, c): entry for (r, c), entry in self.entries.items() if c in columns and r not in done}
            unit = np.broadcast_to(np.eye(len(rows)), matrix.shape)
            blocks.append(_Block(rows, list(columns), solve_all(matrix, unit), onward))
        return blocks

    @cached_property
    def solvable(self) -> Array:
        """Where every block has an answer, shape (n,)."""
        if self._blocks is None:
            return np.zeros_like(self.good)
        sizes = [np.abs(block.inverse).sum(axis=2).max(axis=1) for block in self._blocks]
        # what is not a number is not less either
        return np.asarray(np.logical_and.reduce([self.good, *(size < 1.0 / DEAD for size in sizes)]))

    def answer(self, right: Array) -> tuple[Array, Array]:
        """The solution of each system, shape (columns, n), NaN where there is none, and where there is one."""
        good = self.solvable & np.isfinite(right).all(axis=0)
        if not good.any():
            return np.full((self.columns, len(good)), np.nan), good
        solution = self._pass(right)
        # a second pass takes back the rounding of the first
        residual = right.copy()
        for (row, column), entry in self.entries.items():
            residual[row] -= entry * solution[column]
        return np.where(good, solution + self._pass(residual), np.nan), good

    def spread(self, right: Array) -> Array:
        """How far errors of this size on the right side may move each unknown, shape (columns, n)."""
        return self._pass(np.nan_to_num(right), sizes=True)

    def _pass(self, right: Array, sizes: bool = False) -> Array:
        """Block after block; with ``sizes`` all that goes into a number adds up."""
        right, solution = right.copy(), np.zeros((self.columns, right.shape[1]))
        for block in self._blocks or ():
            inverse = np.nan_to_num(np.abs(block.inverse)) if sizes else block.inverse
            solution[block.columns] = (inverse @ right[block.rows].T[..., None])[..., 0].T
            for (row, column), entry in block.onward.items():
                right[row] -= (-np.nan_to_num(np.abs(entry)) if sizes else entry) * solution[column]
        return solution
