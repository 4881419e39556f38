"""The analytic solver: dyads in closed form, higher groups by Newton, whole sweeps as arrays."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from graphkin.solver.driver_range import DriverRange
from graphkin.solver.mobility import structure_of
from graphkin.solver.motion import Motion, Sliding, listed_points, own_slides
from graphkin.solver.solve import as_drawn, driver_range, over_time, solve, solved_here, sweep_in_blocks

if TYPE_CHECKING:
    from graphkin.solver.forces import Forces, forces_of, without_line
    from graphkin.solver.prepared import PreparedMechanism, prepare
    from graphkin.solver.values import entries, exact_values, head, json_text, senses_along, value_of

__all__ = [
    "DriverRange", "Forces", "Motion", "PreparedMechanism", "Sliding", "as_drawn", "driver_range", "entries",
    "exact_values", "forces_of", "head", "json_text", "listed_points", "over_time", "own_slides", "prepare",
    "senses_along", "solve", "solved_here", "structure_of", "sweep_in_blocks", "value_of", "without_line",
]  # fmt: skip

_PLACES = {
    "forces": ["Forces", "forces_of", "without_line"],
    "prepared": ["PreparedMechanism", "prepare"],
    "values": ["entries", "exact_values", "head", "json_text", "senses_along", "value_of"],
}


def __getattr__(name: str) -> object:
    # what few ask for is loaded when it is asked for
    for place, names in _PLACES.items():
        if name in names:
            return getattr(import_module(f"graphkin.solver.{place}"), name)
    raise AttributeError(f"module 'graphkin.solver' has no attribute {name!r}")
