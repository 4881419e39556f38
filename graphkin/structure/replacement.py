"""Higher pairs replaced by lower ones (高副低代): contacts at every position, cams at one of them.

A contact of two discs is replaced by a bar between their centres, a contact of a disc and a flat face by a block at the
centre that slides along the face: this holds at every position, since the outlines have constant curvature.

A mechanism with cams is replaced by one without, of the same velocities and accelerations at one position.  The
roller's centre, or the edge, turns about the centre of curvature of the pitch curve, on a bar; a flat face is moved by
the centre of curvature of the profile, a pin in a slot along the face.  Or, at the contact itself and where the pitch
curve is nearly straight: the centre runs as a pin on the pitch curve, given by a straight guide along the tangent with
the curvature; a flat face touches the circle of curvature of the profile.

Source: Artobolevsky, Theory of Machines and Mechanisms, on substitute linkages.
"""

from __future__ import annotations

import cmath
from collections.abc import Mapping
from dataclasses import replace

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import Poses, cross, unit
from graphkin.scene.bodies import free_names
from graphkin.scene.model import Mechanism, PlacedLink
from graphkin.scene.pairs import OWN_AXIS, CircularSlot, HigherPair, Pair, PlacedContact, PlacedGuide, told
from graphkin.structure.model import Mobility, Structure
from graphkin.words import Phrase


def replacing_link(contact: HigherPair, links: Mapping[str, PlacedLink]) -> tuple[PlacedLink, Pair | None] | None:
    """The link that replaces a contact, and for a flat face the sliding pair; None for wheels and cams.  The point of
    contact is a point of it.  Where another link holds both centres of a rolling pair, that link gets the point of
    contact."""
    if not isinstance(contact, PlacedContact):
        return None
    centre, radius = contact.centres[0], contact.radii[0]
    if contact.flat:
        face = links[contact.face].guides[contact.guide]
        along = replace(face, through=face.through + contact.normal_to_face * face.direction * radius)
        places = {centre: 0j, contact.name: -contact.normal_to_face * radius}
        block = PlacedLink(contact.block, places, (centre,), OWN_AXIS)
        (of,) = contact.round_links
        return block, Pair(contact.block, contact.block, contact.face, along, 1 + 0j, centre, of)
    other, far = contact.centres[1], contact.apart
    part = radius / far
    if contact.carrier:
        held = links[contact.carrier]
        a, b = held.points[centre], held.points[other]
        return replace(held, points={**held.points, contact.name: a + (b - a) * part}), None
    places = {centre: 0j, other: complex(abs(far)), contact.name: complex(abs(far) * radius / far)}
    return PlacedLink(contact.block, places, contact.centres, OWN_AXIS), None


def pins_on_circles(scene: Mechanism, poses: Poses, values: Mapping[str, float]) -> Mechanism:
    """The mechanism at one position with pins in its circular slots, instead of the bars that replace them: each in a
    straight guide along the tangent, with the curvature; ``poses`` are those of its links (m), ``values`` of the
    drivers, by key (rad, m).
    """
    links, slides = dict(scene.by_name), list(scene.slides)
    for bar, slot in scene.replacing.items():
        if bar not in poses:
            continue
        del links[bar]
        holder = next(n for n in scene.holders[slot.point] if n != bar)
        at = poses[slot.on].local(poses[holder].place(scene.by_name[holder].points[slot.point]))
        guide = PlacedGuide(slot.name, at, 1j * unit(at - links[slot.on].points[slot.centre]), 1.0 / slot.radius)
        slides.append(pin_in_guide(links, slot.point, holder, slot.on, guide))
    return replace(
        _standing(scene, poses, values), frame=links.pop(scene.frame.name), links=tuple(links.values()),
        slides=tuple(slides), slots=tuple(s for s in scene.slots if s.bar in links),
    )


def _standing(scene: Mechanism, poses: Poses, values: Mapping[str, float]) -> Mechanism:
    """The mechanism at other driver values and poses of its links: their points are sketched there."""
    lying = (link for link in scene.links if link.name in poses)
    places = {p: poses[link.name].place(z) for link in lying for p, z in link.points.items()}
    return replace(scene, drivers=tuple(d.at_value(values[d.key]) for d in scene.drivers),
                   sketch={**scene.sketch, **places}, drawn={})


def replacement_told(structure: Structure) -> tuple[Phrase, ...]:
    """The higher pairs in words, the replacement of each, and the mobility counted after it."""
    scene, m, bars = structure.scene, structure.mobility, structure.scene.whole.replacing
    pins = [pair for pair in scene.whole.slides if pair.higher]
    said = [told(pair, "structure") for pair in (*pins, *bars.values(), *scene.higher_pairs)]
    said += [Phrase("structure roller", link=cam.follower) for cam in scene.cams if cam.roller]
    replaced = [pair for pair in scene.higher_pairs if pair.replaced]
    if replaced or bars:
        # links, each with two lower pairs
        more = len(replaced) + len(bars) + len(pins)
        after = Mobility(m.links + more, m.lower + 2 * more, m.higher - more)
        numbers = {"links": after.links, "lower": after.lower, "higher": after.higher, "mobility": after.value}
        said.append(Phrase("structure replaced", **numbers))
    return tuple(said)


STRAIGHT = 0.02
"""A pitch curve of less curvature, times the base radius, has its centre of curvature too far away for a bar."""
SHARP = 1e-9
"""A pitch curve whose tangent is shorter than this, of the base radius, has a cusp."""
ROUNDED = 1e-13
"""A centre of curvature nearer to the axis than this part of the radius lies on it."""


def cams_replaced(scene: Mechanism, poses: Poses, values: Mapping[str, float], bars: bool = True) -> Mechanism:
    """The mechanism that replaces one with cams at a position.

    Parameters
    ----------
    poses : the poses of its links (m), all cams among them
    values : of the drivers, by key (rad, m)
    bars : whether bars replace rollers and edges, where they can, and pins the points that move faces

    Raises
    ------
    Unsolvable : a follower that does not come to its base circle, a pitch curve with a cusp
    """
    links = {link.name: link for link in scene.links}
    pins: list[Pair] = []
    made: dict[str, PlacedLink] = {}
    slots: list[CircularSlot] = []
    contacts: list[PlacedContact] = []
    places: dict[str, complex] = {}
    taken = {*scene.holders, *scene.contact_at}
    names, letters = free_names(taken, "O", "Q"), free_names(taken, "K")  # of centres of curvature, and of contacts
    for cam in scene.cams:
        turn = poses[cam.link].axis
        lift = cam.law.at(cam.sense * cmath.phase(turn))
        course = cam.course(lift)
        link, follower = links[cam.link], links[cam.follower]
        if cam.flat:
            # the normal passes the centre of curvature, base radius + lift + second derivative before the face
            centre = -course.way * (lift.second + 1j * cam.sense * lift.slope)
            point, radius = next(names), cam.base + lift.lift + lift.second
            links[cam.link] = replace(link, points={**link.points, point: centre / turn})
            touches = not bars and abs(radius) >= SHARP * cam.base
            # the turn from the guide of a sliding follower to its own axis
            turned = scene.sliding(cam.motion.pair).turn
            face = PlacedGuide("f", -(0.0 if touches else radius) / turned, 1j / turned)
            pin = pin_in_guide(links, point, cam.link, cam.follower, face)
            if touches:
                contacts.append(PlacedContact(next(letters), cam.bodies, (point, pin.guide.name), (point,), (radius,),
                                              cam.follower, left=True, rolling=False))
            else:
                pins.append(pin)
            continue
        tangent = course.tangent
        if abs(tangent) < SHARP * cam.base:
            raise Unsolvable("dead point", Problem(f"cams.{cam.link}", "the pitch curve has a cusp at this"))
        point = cam.motion.tip or next(iter(follower.points), "")
        if not point:
            point = next(names)
            links[cam.follower] = replace(follower, points={point: 0j})
        curvature = cross(tangent, course.tangent_rate) / abs(tangent) ** 3
        places[point] = cam.axis + course.point
        if bars and abs(curvature) * cam.base >= STRAIGHT:
            # about the centre of curvature, as in a slot along a circle
            centre, middle = next(names), course.point + 1j * unit(tangent) / curvature
            if abs(middle) * abs(curvature) < ROUNDED:  # in a dwell
                middle = 0j
            links[cam.link] = replace(link, points={**link.points, centre: middle / turn})
            bar = PlacedLink(f"{centre}{point}", {centre: 0j, point: complex(1.0 / abs(curvature))}, (centre, point),
                             OWN_AXIS)
            made[bar.name] = bar
            slots.append(CircularSlot(bar.name, cam.link, centre, 1.0 / abs(curvature), bar.name, point))
            continue
        slot = PlacedGuide("t", course.point / turn, unit(tangent) / turn, curvature)
        pins.append(pin_in_guide(links, point, cam.follower, cam.link, slot))
    here = _standing(scene, poses, values)
    return replace(
        here, links=(*(links[link.name] for link in scene.links), *made.values()), slides=(*scene.slides, *pins),
        slots=(*scene.slots, *slots), higher_pairs=(*scene.higher_pairs, *contacts), sketch={**here.sketch, **places},
        instead_of=scene,
    )


def pin_in_guide(
    links: dict[str, PlacedLink], point: str, of: str, on: str, guide: PlacedGuide, mark: str = "1"
) -> Pair:
    """A pin of link ``of`` in a guide that link ``on`` is given among ``links``, with as many marks behind its name as
    make it the only guide of that name."""
    while guide.name in links[on].guides:
        guide = replace(guide, name=guide.name + mark)
    links[on] = replace(links[on], guides={**links[on].guides, guide.name: guide})
    return Pair.of_pin(point, of, on, guide)
