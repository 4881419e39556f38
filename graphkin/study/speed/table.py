"""The race as rows of a CSV file, and as data for programs."""

from __future__ import annotations

import csv
import io
from typing import Any

from graphkin.study.speed.run import Race
from graphkin.words import say, word

__all__ = ["race_csv", "to_json"]


def race_csv(race: Race) -> str:
    """One row for each method; first the floor."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(
        ["method", "tag", "family", "velocity_cost_s", "velocity_error", "acceleration_cost_s", "acceleration_error"]
    )
    writer.writerow(["copying", "", "floor", f"{race.copying[0]:.3g}", "", f"{race.copying[1]:.3g}", ""])
    for e in race.entries:
        errors = ["" if x is None else f"{x:.3g}" for x in (e.velocity_error, e.acceleration_error)]
        costs = [f"{x:.3g}" for x in (e.velocity_cost, e.acceleration_cost)]
        writer.writerow([e.key, e.tag, e.family, costs[0], errors[0], costs[1], errors[1]])
    return out.getvalue()


def to_json(race: Race, language: str = "en") -> dict[str, Any]:
    """Costs in s for a position, errors in parts of the largest value, and what it was measured on."""
    return {
        "scene": race.scene.name,
        "machine": {
            "cores": race.machine.cores, "processor": race.machine.processor, "versions": dict(race.machine.versions)
        },
        "repeats": race.repeats,
        "positions": race.count,
        "places": race.places,
        "copying_s": list(race.copying),
        "asked": [str(s) for s in race.asked],
        "methods": [
            {
                "method": e.key,
                "tag": e.tag,
                "family": e.family,
                "says": word("differences of" if e.key == "differences" else e.key, language),
                "velocity": {"cost_s": e.velocity_cost, "error": e.velocity_error},
                "acceleration": {"cost_s": e.acceleration_cost, "error": e.acceleration_error},
            }
            for e in race.entries
        ],
        "left_out": [{"peer": name, "why": say(why, language)} for name, why in race.skipped],
    }  # fmt: skip
