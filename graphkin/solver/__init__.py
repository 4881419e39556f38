"""The analytic solver: dyads in closed form, higher groups by Newton, whole sweeps as arrays."""

from graphkin.solver.findings import structure_of
from graphkin.solver.motion import Motion, Sliding
from graphkin.solver.prepared import Prepared, prepare
from graphkin.solver.solve import solve, solve_structure
from graphkin.solver.table import listed_points, to_json

__all__ = [
    "Motion",
    "Prepared",
    "Sliding",
    "listed_points",
    "prepare",
    "solve",
    "solve_structure",
    "structure_of",
    "to_json",
]
