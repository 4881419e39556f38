"""A measurement: what a method costs and how far it is off, and the machine it was made on."""

from __future__ import annotations

import os
import platform
import time
from collections.abc import Callable
from dataclasses import dataclass
from importlib import metadata
from typing import Literal

from graphkin.words import Phrase

__all__ = ["Entry", "Family", "Machine", "Skipped", "best_time", "this_machine"]

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


class Skipped(Exception):
    """A peer that is left out, and why: a key of the table of words with what stands in its gaps."""

    def __init__(self, key: str, *args: str) -> None:
        super().__init__(key, *args)
        self.why = Phrase(f"skip {key}", args)


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


PACKAGES = ("numpy", "numba", "scipy", "pylinkage", "mpmath")


@dataclass(frozen=True)
class Machine:
    """Cores and processor, and the versions of what took part."""

    cores: int
    processor: str
    versions: tuple[tuple[str, str], ...]


def this_machine() -> Machine:
    """The machine that this runs on."""
    from graphkin.version import __version__

    versions = [("graphkin", __version__), ("Python", platform.python_version())]
    for name in PACKAGES:
        try:
            versions.append((name, metadata.version(name)))
        except metadata.PackageNotFoundError:
            continue
    return Machine(os.cpu_count() or 1, _processor(), tuple(versions))


def _processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = [line.partition(":")[2].strip() for line in file if line.startswith("model name")]
    except OSError:
        names = []
    return names[0] if names else platform.processor() or platform.machine()
