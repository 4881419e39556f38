"""Room along the edges of a panel that nothing drawn or written takes."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.drawing.box import Box
from graphkin.drawing.obstacles import Obstacles

__all__ = ["free_boxes"]

STEP = 6.0  # mm from one place tried to the next along the edge of the panel
CLEAR = 2.0  # mm between an inset and what is drawn


def free_boxes(
    count: int, size: tuple[float, float], panel: Box, obstacles: Obstacles, taken: Sequence[Box] = ()
) -> list[Box]:
    """Up to ``count`` boxes of a size (mm) along the edges of a panel that hold nothing, those in corners first."""
    found: list[Box] = []
    for box in _places(size, panel):
        if len(found) == count:
            break
        wide = box.grown(CLEAR)
        if any(wide.overlaps(other) for other in (*taken, *found, *obstacles.areas)):
            continue
        if any(wide.clip(*segment) for segment in (*obstacles.solid, *obstacles.dashed)):
            continue
        found.append(box)
    return found


def _places(size: tuple[float, float], panel: Box) -> list[Box]:
    width, height = size
    right, low = panel.right - width, panel.bottom - height
    if right < panel.left or low < panel.top:
        return []
    xs = [panel.left + i * STEP for i in range(int((right - panel.left) / STEP) + 1)] + [right]
    ys = [panel.top + i * STEP for i in range(int((low - panel.top) / STEP) + 1)] + [low]
    corners = [(x, y) for y in (low, panel.top) for x in (right, panel.left)]
    edges = [(x, y) for y in (low, panel.top) for x in xs] + [(x, y) for x in (right, panel.left) for y in ys]
    return [Box(x, y, x + width, y + height) for x, y in (*corners, *edges)]
