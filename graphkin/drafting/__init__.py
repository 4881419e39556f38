"""The drawing board: position, velocity and acceleration polygons constructed step by step.

It starts from the scene and takes every later length and angle from what is already drawn; it never sees the
analytic solver.
"""

from graphkin.drafting.draft import Room, draft
from graphkin.drafting.instrument import EXACT, Exact, Instrument
from graphkin.drafting.sheet import Scales, Sheet

__all__ = ["EXACT", "Exact", "Instrument", "Room", "Scales", "Sheet", "draft"]
