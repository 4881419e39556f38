"""The laws as rows of a CSV file, and as data for programs."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from typing import Any

from graphkin.study.limits.law import Law, Trial
from graphkin.words import say, word

__all__ = ["laws_csv", "to_json"]


def laws_csv(trials: Sequence[Trial]) -> str:
    """One row for each point of each law; an empty error is a refusal."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["singularity", "distance", "law", "x", "error", "slope", "theory", "warns_from", "refuses_from"])
    for trial in trials:
        for law in (*trial.laws, *trial.growth):
            ends = [_number(law.theory), _number(law.told), _number(law.stops)]
            for x, error in zip(law.x, law.error, strict=True):
                writer.writerow(
                    [trial.key, trial.distance, law.key, f"{x:.4g}", _number(error), _slope(law), *ends]
                )
    return out.getvalue()


def _number(value: float | None) -> str:
    return "" if value is None or not math.isfinite(value) else f"{value:.3g}"


def _slope(law: Law) -> str:
    return "" if math.isnan(law.slope) else f"{law.slope:.2f}"


def to_json(trials: Sequence[Trial], language: str = "en") -> dict[str, Any]:
    """Slopes, theory, and where each method warns and refuses; no ``nan``."""

    def law(one: Law) -> dict[str, Any]:
        return {
            "law": one.key,
            "says": word(one.key, language),
            "slope": None if math.isnan(one.slope) else round(one.slope, 3),
            "theory": one.theory,
            "warns_from": one.told,
            "refuses_from": one.stops,
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
            for t in trials
        ]
    }
