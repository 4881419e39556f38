"""The analytic solver: dyads in closed form, higher groups by Newton, whole sweeps as arrays."""

from graphkin.exact.diagnose import structure_of
from graphkin.exact.motion import Motion, Sliding
from graphkin.exact.prepared import Prepared, prepare
from graphkin.exact.solve import solve, solve_structure
from graphkin.exact.table import listed_points, to_json

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
