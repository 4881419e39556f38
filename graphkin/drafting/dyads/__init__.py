"""Where the links of a group lie: compass arcs and ruler lines that meet, for each kind of dyad.

All lengths in mm on paper.  For each kind a function returns a `Meeting`: how well the two loci cross, the possible
places of the links, and for each what was drawn.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from graphkin.drafting.dyads.arcs import rpr, rrp, rrr
from graphkin.drafting.dyads.driven import drive
from graphkin.drafting.dyads.frame import Frame
from graphkin.drafting.dyads.lines import prp, rpp
from graphkin.drafting.dyads.meeting import Meeting
from graphkin.drafting.dyads.rigid import RigidBody
from graphkin.structure import Dyad

__all__ = ["Frame", "Meeting", "drive", "meet"]

_MEETINGS: Mapping[str, Callable[[Frame, Dyad, RigidBody, RigidBody], Meeting]] = {
    "RRR": rrr,
    "RRP": rrp,
    "RPR": rpr,
    "PRP": prp,
    "RPP": rpp,
}


def meet(frame: Frame, dyad: Dyad) -> Meeting:
    """Draw the loci of a dyad and find where they meet."""
    return _MEETINGS[dyad.kind](frame, dyad, RigidBody(frame, dyad.first), RigidBody(frame, dyad.second))
