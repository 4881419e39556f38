"""Forces on the drawing board: inertia forces, force polygons group by group, joint forces, balancing loads, and
Zhukovsky's lever."""

from graphkin.construction.forces.draw import force_readings, force_scales, with_forces
from graphkin.construction.forces.force_sheet import ForceGroup, ForceState, Lever
from graphkin.construction.forces.position import acting_loads

__all__ = [
    "ForceGroup", "ForceState", "Lever", "acting_loads", "force_readings", "force_scales", "with_forces",
]  # fmt: skip
