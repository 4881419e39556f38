"""Where over the range of the driver the forces jump: loads begin and end, and turn with the sense of a slide."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from graphkin.scene.loads import Phase
from graphkin.scene.model import AngleDriver
from graphkin.solver.acting import stroke_of
from graphkin.solver.driver_range import DriverRange
from graphkin.solver.pose import Array
from graphkin.solver.whole_turn import where_true

__all__ = ["load_edges"]

SAMPLES = 720


def load_edges(reach: DriverRange) -> Array:
    """The offsets at which a load begins, ends or turns round, growing; those at the ends of the range among them.

    Raises
    ------
    Unsolvable : a load acts on a part of a stroke, and the driver makes no whole turn
    """
    low, high = reach.ends
    found: list[float] = []
    for load in reach.scene.loading.loads:
        if load.against:
            found += _crossings(reach, _speed(reach, load.against))
        if load.phase is not None:
            found += _begins_and_ends(reach, load.phase)
    kept = sorted(offset for offset in found if low - 1e-9 <= offset <= high + 1e-9)
    apart = 1e-9 * (high - low)
    return np.array([x for i, x in enumerate(kept) if i == 0 or x - kept[i - 1] > apart])


def _begins_and_ends(reach: DriverRange, phase: Phase) -> Iterator[float]:
    low, high = reach.ends
    if not phase.stroke:
        for value in (phase.start, phase.end):
            at = float(reach.sense * (value - reach.start[0]))
            if isinstance(reach.driver, AngleDriver):
                first = at + np.ceil((low - 1e-9 - at) / (2 * np.pi)) * 2 * np.pi
                yield from np.arange(first, high + 1e-9, 2 * np.pi).tolist()
            else:
                yield at
        return
    least, most = stroke_of(reach, phase.stroke)

    def part(edge: float) -> Callable[[Array], Array]:
        wanted = least + (most - least) * (edge if phase.sense > 0 else 1.0 - edge)
        return lambda offset: reach.motion(offset, fine=False).slide(phase.stroke).travel - wanted

    speed = _speed(reach, phase.stroke)
    for edge in (phase.start, phase.end):
        if edge < 1e-9 or edge > 1.0 - 1e-9:  # where the slide turns back
            yield from _crossings(reach, speed)
        else:
            yield from (x for x in _crossings(reach, part(edge)) if np.sign(speed(np.array([x]))[0]) == phase.sense)


def _speed(reach: DriverRange, pair: str) -> Callable[[Array], Array]:
    return lambda offset: reach.motion(offset, unit=True, fine=False).slide(pair).velocity


def _crossings(reach: DriverRange, value: Callable[[Array], Array]) -> list[float]:
    """Where something changes its sign over the range."""
    grid = np.linspace(*reach.ends, SAMPLES + 1)
    signs = value(grid) >= 0.0
    found = []
    for k in np.flatnonzero(signs[1:] != signs[:-1]):

        def there(offset: Array, after: bool = bool(signs[k + 1])) -> Array:
            return np.asarray((value(offset) >= 0.0) == after)

        found.append(where_true(there, float(grid[k]), float(grid[k + 1])))
    return found
