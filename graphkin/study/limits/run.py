"""All trials, in the order in which they are drawn."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

from graphkin.study.limits.dead_points import dead_point
from graphkin.study.limits.formulas import angle_formulas, crossing_height, differences
from graphkin.study.limits.guides import flip, near_ground, slow_sliding
from graphkin.study.limits.law import Trial
from graphkin.study.limits.parallels import parallel_lines
from graphkin.study.limits.scale import drawing_scale
from graphkin.study.reference import context

__all__ = ["KINDS", "run_trials"]

KINDS: dict[str, Callable[..., Trial]] = {
    "dead point RRR": partial(dead_point, "RRR"),
    "dead point RRP": partial(dead_point, "RRP"),
    "dead point RPR": partial(dead_point, "RPR"),
    "crossing height": crossing_height,
    "angle near zero": angle_formulas,
    "differences": differences,
    "parallel lines": parallel_lines,
    "near ground": near_ground,
    "guide flip": flip,
    "slow sliding": slow_sliding,
    "small scale": drawing_scale,
}


def run_trials(kinds: Iterable[str] = (), samples: int = 4) -> tuple[Trial, ...]:
    """Measure the errors beside singular positions.

    Parameters
    ----------
    kinds : which of ``KINDS``; all if none is named
    samples : distances to each half of a decade, of which the largest error counts

    Raises
    ------
    CallError : mpmath is not installed
    """
    mp: Any = context()
    return tuple(KINDS[kind](mp, samples=samples) for kind in (tuple(kinds) or KINDS))
