"""The drawing board: position, velocity and acceleration polygons constructed step by step.

It starts from the scene and takes every later length and angle from what is already drawn; it never sees the
analytic solver.
"""

from graphkin.drafting.draft import Plan, Room, draft, execute, plan
from graphkin.drafting.instrument import EXACT, Cad, Exact, Instrument, nudged, pencil
from graphkin.drafting.sheet import Scales, Sheet

__all__ = [
    "EXACT",
    "Cad",
    "Exact",
    "Instrument",
    "Plan",
    "Room",
    "Scales",
    "Sheet",
    "draft",
    "execute",
    "nudged",
    "pencil",
    "plan",
]
