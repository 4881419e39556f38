"""Linear systems of one pattern at many positions, solved block by block in the order that the pattern gives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from graphkin.solver.pose import Array
from graphkin.structure.groups import components, match

__all__ = ["LinearBlocks"]

Entry = float | Array
DEAD = 1e-10
"""A block of entries of order 1 whose inverse is greater than 1 / DEAD has no answer."""


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
    def blocks(self) -> list[tuple[list[int], list[int]]] | None:
        """Rows and columns of each block, each after those it needs; None for a pattern that has no answer."""
        unknowns: list[list[int]] = [[] for _ in range(self.rows)]
        for (row, column), entry in self.entries.items():
            if isinstance(entry, float) or (np.nan_to_num(entry) != 0.0).any():
                unknowns[row].append(column)
        matched = match(unknowns)
        if self.rows != self.columns or len(matched) < self.rows:
            return None
        row_of = {unknown: row for row, unknown in matched.items()}
        order = components({unknown: unknowns[row] for unknown, row in row_of.items()})
        return [([row_of[k] for k in part], list(part)) for part in order]

    @cached_property
    def _others(self) -> list[list[tuple[int, int, Entry]]]:
        """For each block the entries of its columns in the rows of later ones: (row, column, entry)."""
        found = []
        for rows, columns in self.blocks or ():
            own, done = set(columns), set(rows)
            found.append([(r, c, e) for (r, c), e in self.entries.items() if c in own and r not in done])
        return found

    @cached_property
    def _eliminations(self) -> list[_Elimination]:
        return [_eliminated(self.entries, rows, columns, self.good) for rows, columns in self.blocks or ()]

    @cached_property
    def solvable(self) -> Array:
        """Where every block has an answer, shape (n,)."""
        if self.blocks is None:
            return np.zeros_like(self.good)
        good = self.good.copy()
        for block in self._eliminations:
            good &= block.good
        return good

    def answer(self, right: Array) -> tuple[Array, Array]:
        """The solution of each system, shape (columns, n), NaN where there is none, and where there is one."""
        good = self.solvable & np.isfinite(right).all(axis=0)
        if not good.any():
            return np.full((self.columns, len(good)), np.nan), good
        found = self._pass(right)
        # a second pass takes back the rounding of the first
        rest = right.copy()
        for (row, column), entry in self.entries.items():
            rest[row] -= entry * found[column]
        found += self._pass(rest)
        if not good.all():
            found[:, ~good] = np.nan
        return found, good

    def _pass(self, right: Array) -> Array:
        rest, found = right.copy(), np.empty((self.columns, right.shape[1]))
        for block, others in zip(self._eliminations, self._others, strict=True):
            block.solve(rest, found)
            for row, column, entry in others:
                rest[row] -= entry * found[column]
        return found

    def spread(self, right: Array) -> Array:
        """How far errors of this size on the right side may move each unknown, shape (columns, n)."""
        rest, found = np.nan_to_num(right), np.zeros((self.columns, right.shape[1]))
        for (rows, columns), others in zip(self.blocks or (), self._others, strict=True):
            unit = np.eye(len(rows))
            block = np.zeros((len(self.good), len(rows), len(rows)))
            for i, row in enumerate(rows):
                for k, column in enumerate(columns):
                    block[:, i, k] = self.entries.get((row, column), 0.0)
            inverse = np.linalg.inv(np.where(self.solvable[:, None, None], block, unit))
            found[columns] = np.einsum("nij,jn->in", np.abs(inverse), rest[rows])
            for row, column, entry in others:
                rest[row] += np.nan_to_num(np.abs(entry)) * found[column]
        return found


@dataclass(frozen=True)
class _Elimination:
    """One block with its constant pivots taken out, and the inverse of what is left.

    steps : for each pivot its row and column, its number, the factors by which its row goes into others, and the other
        entries of its row
    rows, columns, inverse : what is left, the inverse of shape (n, k, k)
    good : where that has an inverse, shape (n,)
    """

    steps: Sequence[tuple[int, int, float, Mapping[int, Entry], Mapping[int, Entry]]]
    rows: Sequence[int]
    columns: Sequence[int]
    inverse: Array
    good: Array

    def solve(self, rest: Array, found: Array) -> None:
        """Put the answer into the rows of ``found``; rows of ``rest`` of this block are used up."""
        for row, _, _, factors, _ in self.steps:
            for other, factor in factors.items():
                rest[other] -= factor * rest[row]
        for i, column in enumerate(self.columns):
            found[column] = self.inverse[i, 0] * rest[self.rows[0]]
            for k in range(1, len(self.rows)):
                found[column] += self.inverse[i, k] * rest[self.rows[k]]
        for row, column, pivot, _, own in reversed(self.steps):
            value = rest[row]
            for other, entry in own.items():
                value = value - entry * found[other]
            found[column] = value / pivot


def _eliminated(
    entries: Mapping[tuple[int, int], Entry], rows: Sequence[int], columns: Sequence[int], good: Array
) -> _Elimination:
    """A block without the unknowns that constants give (of forces: the components at inner pins), the cheapest first
    (Markowitz, The elimination form of the inverse, Management Science 3, 1957)."""
    left = {(r, c): entries[r, c] for r in rows for c in columns if (r, c) in entries}
    steps = []
    while len({r for r, _ in left}) > 1:
        cost = {
            (r, c): (sum(k == c for _, k in left) - 1) * (sum(k == r for k, _ in left) - 1)
            for (r, c), entry in left.items()
            if isinstance(entry, float) and abs(entry) >= 0.5
        }
        if not cost:
            break
        row, column = min(cost, key=lambda at: (cost[at], at))
        pivot = left[row, column]
        assert isinstance(pivot, float)
        own = {c: e for (r, c), e in left.items() if r == row and c != column}
        factors = {r: e / pivot for (r, c), e in left.items() if c == column and r != row}
        left = {(r, c): e for (r, c), e in left.items() if r != row and c != column}
        for r, factor in factors.items():
            for c, entry in own.items():
                was = left.get((r, c), 0.0)
                left[r, c] = was - factor * entry
        steps.append((row, column, pivot, factors, own))
    gone = {row for row, *_ in steps}, {column for _, column, *_ in steps}
    last, unknown = [r for r in rows if r not in gone[0]], [c for c in columns if c not in gone[1]]
    inverse, able = _inverse([[left.get((r, c), 0.0) for c in unknown] for r in last], good)
    return _Elimination(steps, last, unknown, inverse, able)


def _inverse(block: list[list[Entry]], good: Array) -> tuple[Array, Array]:
    """The inverse of a block, shape (k, k, n), and where it has one."""
    n, k = len(good), len(block)
    with np.errstate(all="ignore"):
        if k == 1:
            made = np.broadcast_to(1.0 / np.asarray(block[0][0]), (1, 1, n))
        elif k == 2:
            (a, b), (c, d) = block
            by = 1.0 / (a * d - b * c) + np.zeros(n)
            made = np.array([[d * by, -b * by], [-c * by, a * by]])
        else:
            whole = np.empty((n, k, k))
            for i, row in enumerate(block):
                for j, entry in enumerate(row):
                    whole[:, i, j] = entry
            finite = good & np.isfinite(whole).all(axis=(1, 2))
            whole[~finite] = np.eye(k)
            singular = np.linalg.slogdet(whole)[0] == 0.0
            whole[singular] = np.nan
            made = np.full((k, k, n), np.nan)
            made[..., ~singular] = np.moveaxis(np.linalg.inv(whole[~singular]), 0, 2)
            made[..., ~finite] = np.nan
        # what is not a number is not less either
        return made, np.asarray(np.abs(made).sum(axis=1).max(axis=0) < 1.0 / DEAD)
