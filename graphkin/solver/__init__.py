"""The analytic solver: dyads in closed form, higher groups by Newton, whole sweeps as arrays."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from graphkin.solver.driver_range import DriverRange, driver_range
from graphkin.solver.exact_values import exact_values, senses_along, value_of
from graphkin.solver.mobility import structure_of
from graphkin.solver.motion import Motion, Sliding
from graphkin.solver.over_time import over_time
from graphkin.solver.solve import as_drawn, solve, sweep_in_blocks

if TYPE_CHECKING:
    from graphkin.solver.external_forces import without_line
    from graphkin.solver.forces import Forces, forces_of
    from graphkin.solver.motion_data import entries, head, json_text, listed_points, own_slides, to_json
    from graphkin.solver.prepared import PreparedMechanism, prepare

__all__ = [
    "DriverRange",
    "Forces",
    "Motion",
    "PreparedMechanism",
    "Sliding",
    "as_drawn",
    "driver_range",
    "entries",
    "exact_values",
    "forces_of",
    "head",
    "json_text",
    "listed_points",
    "over_time",
    "own_slides",
    "prepare",
    "senses_along",
    "solve",
    "structure_of",
    "sweep_in_blocks",
    "to_json",
    "value_of",
    "without_line",
]

_PLACES = {
    "external_forces": ["without_line"],
    "forces": ["Forces", "forces_of"],
    "prepared": ["PreparedMechanism", "prepare"],
    "motion_data": ["entries", "head", "json_text", "listed_points", "own_slides", "to_json"],
}


def __getattr__(name: str) -> object:
    # what few ask for is loaded when it is asked for
    for place, names in _PLACES.items():
        if name in names:
            return getattr(import_module(f"graphkin.solver.{place}"), name)
    raise AttributeError(f"module 'graphkin.solver' has no attribute {name!r}")
