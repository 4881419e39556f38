"""The drawing board: position, velocity and acceleration polygons constructed step by step.

It starts from the scene and takes every later length and angle from the drawing itself; it never sees the analytic
solver.
"""

from graphkin.construction.instruments import EXACT, Instrument, cad, erring, nudged, pencil
from graphkin.construction.plan import Plan, Stages, draft, execute, plan
from graphkin.construction.polygons import AS_DRAWN, OwnValues
from graphkin.construction.scales import Room, Scales
from graphkin.construction.sheet import Sheet

__all__ = [
    "AS_DRAWN",
    "EXACT",
    "Instrument",
    "OwnValues",
    "Plan",
    "Room",
    "Scales",
    "Sheet",
    "Stages",
    "cad",
    "draft",
    "erring",
    "execute",
    "nudged",
    "pencil",
    "plan",
]  # fmt: skip
