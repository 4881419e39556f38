"""Sliding contacts drawn at the contact itself, as a second way beside the linkage that replaces them.

Where two outlines touch, the velocities of the material points of both bodies differ along the tangent only: v_K2 is
v_K1 and the slip.  In acceleration the term of Coriolis comes to it, and along the normal one that the curvatures of
both outlines give: the contact wanders along them at rates s1' and s2', where s1' - s2' is the slip and
s1'/rho1 - s2'/rho2 the relative rate of turning, and its acceleration is the same seen from either body.
"""

from __future__ import annotations

from collections.abc import Mapping

from graphkin.construction.net import Edge, TwoWays, node
from graphkin.construction.sheet import Sheet
from graphkin.construction.sizes import Direction
from graphkin.scene.contacts import PlacedContact
from graphkin.scene.symbol import PointRef
from graphkin.structure import Dyad, Slide, Structure, Turn

__all__ = ["chains_at_contacts"]

TINY = 1e-9  # of the mechanism: a contact nearer to a pivot has no arm


def chains_at_contacts(structure: Structure, sheet: Sheet) -> Mapping[Dyad, TwoWays]:
    """For each dyad that has what replaces a sliding contact the equation at the contact, where it has one: the contact
    moved with the follower about its other joint, or along it, and with the body that moves it by the slip."""
    found: dict[Dyad, TwoWays] = {}
    for dyad in (e for e in structure.elements if isinstance(e, Dyad)):
        contact = _contact_of(structure, dyad)
        chain = _chain(structure, sheet, dyad, contact) if contact else None
        if chain is not None:
            found[dyad] = chain
    return found


def _contact_of(structure: Structure, dyad: Dyad) -> PlacedContact | None:
    blocks = {body.links[0] for body in dyad.bodies if len(body.links) == 1}
    sliding = (c for c in structure.scene.contacts if not c.rolling and c.block in blocks)
    return next(sliding, None)


def _chain(structure: Structure, sheet: Sheet, dyad: Dyad, contact: PlacedContact) -> TwoWays | None:
    inside = [n for n in contact.links if n in dyad.links]
    if len(inside) != 1 or any(len(body.links) > 1 for body in dyad.bodies):
        return None
    (moved,) = inside
    mover = next(n for n in contact.links if n != moved)
    name, links, ground = contact.name, structure.links, structure.scene.frame.name
    start, end = PointRef(name, mover), PointRef(name, moved)
    along = Direction("along", ("t-t",))
    slip = Edge(start, end, (start, end), along, contact=name, unknown=f"slip {name}")
    outer = next((p for p in dyad.outer if moved in (p.a, p.b)), None)
    if isinstance(outer, Turn):
        pivot = PointRef(outer.point)
        arm = abs(sheet.points[pivot] - sheet.points[PointRef(name)]) * sheet.scales.length
        if arm <= TINY * structure.scene.size:
            return None
        way = Direction("square", (outer.point, name))
        own = Edge(pivot, end, (pivot, end), way, link=moved, unknown=f"omega {moved}")
    elif isinstance(outer, Slide):
        known = outer.b if outer.a == moved else outer.a
        one = node(links, name, known) if known != ground else PointRef(name, ground)
        written = Direction("along", (outer.guide.name or f"x{outer.b}",))
        own = Edge(one, end, (PointRef(name, known), end), written, slide=outer, forward=outer.a == moved,
                   unknown=f"slide {outer.key}")  # fmt: skip
    else:
        return None
    return TwoWays(end, (own,), (slip,))
