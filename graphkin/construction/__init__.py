"""The drawing board: position, velocity and acceleration polygons constructed step by step.

It starts from the scene and takes every later length and angle from the drawing itself; it never sees the analytic
solver.
"""

from graphkin.construction.board.instruments import EXACT, Instrument, cad, erring, nudged, pencil
from graphkin.construction.board.scales import Room, Scales
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.plan import Plan, Stages, draft, execute, plan, plan_with_forces
from graphkin.construction.polygons.polygons import AS_DRAWN, OwnValues

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
    "plan_with_forces",
]
