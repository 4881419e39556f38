"""Forces on the drawing board: inertia forces, force polygons group by group, joint forces, balancing loads, and
Zhukovsky's lever."""

from graphkin.construction.forces.draw import force_readings, force_scales, with_forces
from graphkin.construction.forces.position import acting_loads
from graphkin.construction.forces.steps import ForceGroup, ForceState, Lever

__all__ = [
    "ForceGroup", "ForceState", "Lever", "acting_loads", "force_readings", "force_scales", "with_forces",
]
