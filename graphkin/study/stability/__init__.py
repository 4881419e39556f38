"""Where methods fail and how fast: the error of each beside each kind of singular position, in the order in which they
are drawn; as a chart, as a table, and as data for programs."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from graphkin.files import Json
from graphkin.study.reference import context
from graphkin.study.stability.chart import stability_pages
from graphkin.study.stability.dead_points import dead_point
from graphkin.study.stability.degenerate import (
    angle_formulas,
    crossing_height,
    differences,
    drawing_scale,
    parallel_lines,
)
from graphkin.study.stability.guides import flip, near_ground, slow_sliding
from graphkin.study.stability.laws import ErrorLaw, Singularity
from graphkin.table import Table
from graphkin.words import say, word

if TYPE_CHECKING:
    from mpmath import MPContext

__all__ = ["KINDS", "ErrorLaw", "Singularity", "laws_table", "run_singularities", "stability_pages", "to_json"]




KINDS: dict[str, Callable[..., Singularity]] = {
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


def run_singularities(kinds: Iterable[str] = (), samples: int = 4) -> tuple[Singularity, ...]:
    """Measure the errors beside singular positions.

    Parameters
    ----------
    kinds : which of ``KINDS``; all if none is named
    samples : distances to each half of a decade, of which the largest error counts

    Raises
    ------
    CallError : mpmath is not installed
    """
    mp: MPContext = context()
    return tuple(KINDS[kind](mp, samples=samples) for kind in (tuple(kinds) or KINDS))


def laws_table(found: Sequence[Singularity]) -> Table:
    """One row for each point of each law; without an error where the method refuses."""
    heads = ("singularity", "distance", "law", "x", "error", "slope", "theory", "warns_from", "refuses_from")
    rows = [
        (one.key, one.distance, law.key, x, error, law.slope, law.theory, law.warns_from, law.refuses_from)
        for one in found for law in (*one.laws, *one.growth) for x, error in zip(law.x, law.error, strict=True)
    ]  # fmt: skip
    return Table.of(heads, rows, ("", "", "", ".4g", ".3g", ".2f", ".3g", ".3g", ".3g"))


def to_json(found: Sequence[Singularity], language: str = "en") -> dict[str, Json]:
    """Slopes, theory, and where each method warns and refuses; no ``nan``."""

    def law(one: ErrorLaw) -> dict[str, Json]:
        return {
            "law": one.key,
            "says": word(one.key, language),
            "slope": None if math.isnan(one.slope) else round(one.slope, 3),
            "theory": one.theory,
            "warns_from": one.warns_from,
            "refuses_from": one.refuses_from,
            "points": [[x, e if math.isfinite(e) else None] for x, e in zip(one.x, one.error, strict=True)],
        }

    return {
        "singularities": [
            {
                "kind": t.key,
                "distance": word(t.distance, language),
                "laws": [law(one) for one in (*t.laws, *t.growth)],
                "notes": [say(f, language).replace("$", "") for f in t.fates],
            }
            for t in found
        ]
    }
