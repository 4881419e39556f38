"""The drawing board: position, velocity and acceleration polygons constructed step by step.

It starts from the scene and takes every later length and angle from what is already drawn; it never sees the
analytic solver.
"""

from graphkin.drafting.draft import draft, execute
from graphkin.drafting.instrument import EXACT, Cad, Exact, Instrument, nudged, pencil
from graphkin.drafting.plan import Plan, plan
from graphkin.drafting.scales import Room
from graphkin.drafting.sheet import Scales, Sheet
from graphkin.drafting.slip import NO_SLIP, Slip

__all__ = [
    "EXACT",
    "NO_SLIP",
    "Cad",
    "Exact",
    "Instrument",
    "Plan",
    "Room",
    "Scales",
    "Sheet",
    "Slip",
    "draft",
    "execute",
    "nudged",
    "pencil",
    "plan",
]
