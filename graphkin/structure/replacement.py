"""Higher pairs replaced by lower ones (高副低代): a contact of two discs by a bar between their centres, of a disc and
a flat face by a block at the centre that slides along the face.  Outlines of constant curvature make the replacement
hold at every position.

Source: Artobolevsky, Theory of Machines and Mechanisms, on substitute linkages.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from graphkin.plane import unit
from graphkin.scene.contacts import PlacedContact
from graphkin.scene.model import Mechanism, PinInSlot, PlacedGuide, PlacedLink
from graphkin.structure.model import Dyad, Slide, Structure
from graphkin.words import Phrase

__all__ = ["named_with_contact", "pins_on_circles", "replaced_pairs", "replacing_link"]


def replacing_link(contact: PlacedContact, links: Mapping[str, PlacedLink]) -> tuple[PlacedLink, Slide | None]:
    """The link that stands for a contact, and for a flat face the sliding pair.  The point of contact is a point of it.
    Where another link holds both centres of a rolling pair, it is that link with the point of contact."""
    own = {"": PlacedGuide("", 0j, 1 + 0j)}
    if contact.carrier:
        one, two = contact.round
        held = links[contact.carrier]
        a, b = held.points[one.centre], held.points[two.centre]
        at = a + (b - a) * (one.radius / (one.radius + two.radius))
        return replace(held, points={**held.points, contact.name: at}), None
    if not contact.flat:
        one, two = contact.round
        far = abs(one.radius + two.radius)
        at = far * one.radius / (one.radius + two.radius)
        places = {one.centre: 0j, two.centre: complex(far), contact.name: complex(at)}
        return PlacedLink(contact.block, places, (one.centre, two.centre), own), None
    (disc,) = contact.round
    face = links[contact.face].guides[contact.guide]
    along = replace(face, through=face.through + contact.normal_to_face * face.direction * disc.radius)
    places = {disc.centre: 0j, contact.name: -contact.normal_to_face * disc.radius}
    block = PlacedLink(contact.block, places, (disc.centre,), own)
    return block, Slide(contact.block, contact.block, contact.face, along, 1 + 0j, disc.centre, True)


def pins_on_circles(scene: Mechanism, poses: Mapping[str, tuple[complex, complex]]) -> Mechanism:
    """The mechanism at one position with pins in its circular slots, instead of the bars that stand for them: in a
    straight guide along the tangent that carries the curvature; ``poses`` are origin (m) and direction of each link."""
    links, pins = dict(scene.by_name), list(scene.pins)
    for slot in scene.slots:
        if slot.block or slot.bar not in links:
            continue
        del links[slot.bar]
        holder = next(n for n in scene.holders[slot.point] if n != slot.bar)
        (origin, axis), on = poses[holder], links[slot.on]
        place = origin + axis * scene.by_name[holder].points[slot.point]
        at = (place - poses[slot.on][0]) / poses[slot.on][1]
        way = 1j * unit(at - on.points[slot.centre])
        guide = PlacedGuide(slot.name, at, way, 1.0 / slot.radius)
        links[slot.on] = replace(on, guides={**on.guides, guide.name: guide})
        pins.append(PinInSlot(slot.point, holder, slot.on, guide.name))
    places = {p: poses[link.name][0] + poses[link.name][1] * z
              for link in scene.links if link.name in poses for p, z in link.points.items()}  # fmt: skip
    return replace(
        scene, frame=links.pop(scene.frame.name), links=tuple(links.values()), pins=tuple(pins),
        slots=tuple(s for s in scene.slots if s.block), sketch=places, drawn={},
    )  # fmt: skip


def named_with_contact(structure: Structure, dyad: Dyad) -> str:
    """The links of a group, and the contact that one of them stands for: ``contact K of links 1, 2``."""
    inside = {n for body in dyad.bodies for n in body.links}
    contact = next((c for c in structure.scene.contacts if not c.carrier and c.block in inside), None)
    if contact is not None:
        return f"contact {contact.name} of links {', '.join(contact.links)}"
    return f"links {', '.join(dyad.links)}"


def replaced_pairs(structure: Structure) -> tuple[Phrase, ...]:
    """The higher pairs in words, what replaces each, and the mobility counted after the replacement."""
    scene, said = structure.scene, list[Phrase]()
    links = lower = 0
    for contact in scene.contacts:
        names = (contact.name, *contact.links)
        if contact.rolling:
            said.append(Phrase("structure rolling in gear" if contact.carrier else "structure rolling", names))
        elif contact.flat:
            said.append(Phrase("structure flat contact", (*names, contact.round[0].centre)))
        else:
            said.append(Phrase("structure contact", (*names, contact.block)))
        if not contact.rolling:
            links, lower = links + 1, lower + 2
    said += [Phrase("structure gear", (*g.wheels, g.name)) for g in scene.gears]
    links, lower = links + len(scene.pins), lower + 2 * len(scene.pins)
    if any(not c.rolling for c in scene.contacts):
        m = structure.mobility
        after = m.links + links, m.lower + lower, m.higher - links
        said.append(Phrase("structure replaced", (*after, 3 * after[0] - 2 * after[1] - after[2])))
    return tuple(said)
