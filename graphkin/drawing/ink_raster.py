"""Where ink is on a panel, cell by cell: of many upright boxes at once it tells most of those that meet ink, so that
few are left to be looked at exactly."""

from __future__ import annotations

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.meeting import Flags, Floats, Indices, Points

__all__ = ["InkRaster"]

CELL = 1.0  # mm
ROUNDING = 1e-9  # cells


class InkRaster:
    """The cells of a panel that hold points of lines or areas, summed up over rows and columns (Crow, Summed-area
    tables for texture mapping, SIGGRAPH 1984), so that four numbers tell how many lie in a box of cells."""

    def __init__(self, panel: Box, start: Points, end: Points, areas: int) -> None:
        """Lines from ``start`` to ``end``; the first ``areas`` of them are diagonals of filled upright boxes."""
        self.left, self.top = panel.left - 2 * CELL, panel.top - 2 * CELL
        self.columns, rows = int(panel.width / CELL) + 6, int(panel.height / CELL) + 6
        height = (end - start).imag[:areas]
        lines, step = _apart(height)
        low = start[:areas][lines] + 1j * step * height[lines]
        width = (end - start).real[:areas][lines]
        start, end = np.concatenate((low, start[areas:])), np.concatenate((low + width, end[areas:]))
        lines, step = _apart(end - start)
        points = start[lines] + step * (end - start)[lines]
        x, y = (points.real - self.left) / CELL, (points.imag - self.top) / CELL
        inside = (x >= 0) & (x < self.columns - 1) & (y >= 0) & (y < rows - 1)
        held = np.zeros((rows, self.columns), dtype=np.int32)
        held[y[inside].astype(np.intp) + 1, x[inside].astype(np.intp) + 1] = 1
        self.sums = held.cumsum(axis=0, dtype=np.int32).cumsum(axis=1, dtype=np.int32).ravel()

    def meets(self, low: Points, high: Points) -> Flags:
        """Which of some boxes of these corners surely meet ink, since a cell with ink is within; boxes in the panel."""
        grown = 1.0 + ROUNDING
        x, y = (low.real - self.left) / CELL + grown, (low.imag - self.top) / CELL + grown
        left, right = x.astype(np.intp), np.maximum((high.real - self.left) / CELL, x).astype(np.intp)
        top, bottom = y.astype(np.intp), np.maximum((high.imag - self.top) / CELL, y).astype(np.intp)
        top *= self.columns
        bottom *= self.columns
        more: Flags = self._upto(bottom + right) + self._upto(top + left) > (
            self._upto(bottom + left) + self._upto(top + right)
        )
        return more

    def _upto(self, cells: Indices) -> Indices:
        """How many cells hold something up to each of some."""
        return self.sums.take(cells, mode="clip")


def _apart(ways: Points | Floats) -> tuple[Indices, Floats]:
    """Points that lie no further than a cell apart along each of some ways, both ends included: the way of each, and
    its share of it."""
    steps = np.maximum(np.ceil(np.abs(ways) / CELL), 1).astype(np.intp)
    which = np.repeat(np.arange(len(ways)), steps + 1)
    first = np.cumsum(steps + 1) - (steps + 1)
    return which, (np.arange(len(which)) - first[which]) / steps[which]
