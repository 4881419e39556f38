"""A method in the race: what it costs and how far it is off."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

__all__ = ["Entry", "Family", "best_time"]

ENOUGH, MOST = 0.08, 40  # s, runs

Family = Literal["drawn", "closed", "newton", "differences", "complex step", "peer", "by hand"]


@dataclass(frozen=True)
class Entry:
    """One method on the work.

    Parameters
    ----------
    key : word for it, ``tag`` what tells it from others of that name ("3" iterations, "1e-4" step, scale)
    velocity_cost, acceleration_cost : s for a position, as far as velocities, and with accelerations
    velocity_error, acceleration_error : the largest, in parts of the largest value; None where it gives none
    """

    family: Family
    key: str
    tag: str
    velocity_cost: float
    acceleration_cost: float
    velocity_error: float | None
    acceleration_error: float | None


def best_time(run: Callable[[], object], repeats: int, least: float = 2e-3) -> float:
    """The shortest of some runs (s), each made long enough to be timed; other work on the machine only adds.

    There are more runs than asked for where they are short, since a busy machine interrupts many of them.
    """
    started = time.perf_counter()
    run()  # warm: compiled, cached
    once = time.perf_counter() - started
    loops = 1 if once >= least else max(1, min(10_000, int(least / max(once, 1e-7))))
    best, begun, done = float("inf"), time.perf_counter(), 0
    while done < repeats or (done < MOST and time.perf_counter() - begun < ENOUGH):
        done += 1
        started = time.perf_counter()
        for _ in range(loops):
            run()
        best = min(best, (time.perf_counter() - started) / loops)
    return best
