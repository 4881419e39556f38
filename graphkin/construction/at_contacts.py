"""Groups with sliding contacts drawn at the contacts themselves, as a second way beside what replaces them.

Where two outlines touch, the velocities of the material points of both bodies differ along the tangent only: v_K2 is
v_K1 and the slip.  In acceleration the term of Coriolis comes to it, and along the normal one that the curvatures of
both outlines give: the contact wanders along them at rates s1' and s2', where s1' - s2' is the slip and
s1'/rho1 - s2'/rho2 the relative rate of turning, and its acceleration is the same seen from either body.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from graphkin.construction.net import Joined
from graphkin.scene.contacts import PlacedContact
from graphkin.structure import Cluster, Dyad, Pair, Structure, Turn, links_of

__all__ = ["contacts_of", "joined_at_contacts"]


def contacts_of(structure: Structure, group: Dyad | Cluster) -> tuple[PlacedContact, ...]:
    """The sliding contacts that a bar or a block of a group stands for."""
    members = links_of(group)
    return tuple(c for c in structure.scene.contacts if not c.rolling and c.block in members)


def joined_at_contacts(group: Joined, contacts: Sequence[PlacedContact]) -> Joined:
    """The links of a group and its pairs, contacts among them instead of what replaces them."""
    gone = {c.block for c in contacts}
    pairs: list[Pair] = [p for p in group.pairs if not gone & {p.a, p.b}]
    pairs += _past(group.pairs, gone)
    inside = [name for name in group.inside if name not in gone]
    return replace(group, inside=inside, pairs=pairs, contacts=tuple(contacts))


def _past(pairs: Sequence[Pair], gone: Collection[str]) -> Iterator[Turn]:
    """Turning pairs of links that only what is gone joins at a point."""
    around: dict[str, list[str]] = {}
    for pair in pairs:
        if isinstance(pair, Turn) and (pair.a in gone or pair.b in gone):
            around.setdefault(pair.point, []).extend(n for n in (pair.a, pair.b) if n not in gone)
    for point, names in around.items():
        for one, two in pairwise(dict.fromkeys(names)):
            yield Turn(point, one, two)
