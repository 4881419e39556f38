"""Forces on the drawing board: inertia forces, force polygons group by group, joint forces, balancing loads, and
Zhukovsky's lever."""

from graphkin.construction.forces.draw import force_readings, force_scale, forces_on, readings_of
from graphkin.construction.forces.force_sheet import ForceGroup, ForceSheet, ForceState, Lever
from graphkin.construction.forces.position import acting_loads

__all__ = [
    "ForceGroup", "ForceSheet", "ForceState", "Lever", "acting_loads", "force_readings", "force_scale", "forces_on",
    "readings_of",
]  # fmt: skip
