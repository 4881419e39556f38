"""A mechanism without cams that moves as one with cams at one position, in velocity and acceleration (高副低代).

The roller's centre, or the edge, turns about the centre of curvature of the pitch curve, on a bar; a flat face is moved
by the centre of curvature of the profile, a pin in a slot along the face.  Or, at the contact itself and where the
pitch curve is nearly straight: the centre runs as a pin on the pitch curve, of which a straight guide stands for the
tangent and carries the curvature; a flat face touches the circle of curvature of the profile.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, unit
from graphkin.scene.cams import LawCam, SwingingFollower
from graphkin.scene.contacts import PlacedContact, PlacedDisc
from graphkin.scene.model import CircularSlot, Mechanism, PinInSlot, PlacedGuide, PlacedLink
from graphkin.structure.model import Structure

__all__ = ["cams_replaced", "with_cams"]

STRAIGHT = 0.02
"""A pitch curve of less curvature, times the base radius, has its centre of curvature too far away for a bar."""
SHARP = 1e-9
"""A pitch curve whose tangent is shorter than this, of the base radius, has a cusp."""
ROUNDED = 1e-13
"""A centre of curvature nearer to the axis than this part of the radius lies on it."""


def with_cams(scene: Mechanism | Structure) -> Mechanism | Structure:
    """The mechanism itself, in whose place another may stand."""
    own = scene.scene if isinstance(scene, Structure) else scene
    return scene if own.instead_of is None else own.instead_of


def cams_replaced(
    scene: Mechanism, turns: Mapping[str, float], values: Mapping[str, float], seen: Mapping[str, complex],
    bars: bool = True,
) -> Mechanism:
    """The mechanism that stands for one with cams at a position.

    Parameters
    ----------
    turns : the angle of each cam's own axis (rad)
    values : of the drivers, by key (rad, m)
    seen : roughly where points of moving links lie there (m)
    bars : whether bars stand for rollers and edges, as far as they can, and pins for what moves faces

    Raises
    ------
    Unsolvable : a follower that does not come to its base circle, a pitch curve with a cusp
    """
    links = {link.name: link for link in scene.links}
    pins: list[PinInSlot] = []
    made: dict[str, PlacedLink] = {}
    slots: list[CircularSlot] = []
    contacts: list[PlacedContact] = []
    places = dict(seen)
    names = _free_names(scene)
    for cam in scene.cams:
        start, turn = cam.beginning, cmath.rect(1.0, turns[cam.link])
        if start is None:
            said = "the follower does not reach the base circle"
            raise Unsolvable("not assembled", Problem(f"cams.{cam.link}", said))
        lift = cam.law.at(cam.sense * turns[cam.link])
        course = cam.course(start, lift)
        link, follower = links[cam.link], links[cam.follower]
        if cam.flat:
            # the normal passes the centre of curvature, base radius + lift + second derivative before the face
            centre = -course.way * (lift.bend + 1j * cam.sense * lift.slope)
            point, radius = next(names), start + lift.lift + lift.bend
            links[cam.link] = replace(link, points={**link.points, point: centre / turn})
            touches = not bars and abs(radius) >= SHARP * cam.base
            off = 0.0 if touches else radius
            face = _guide(follower, "f", -off / _turn(scene, cam), 1j / _turn(scene, cam), 0.0)
            links[cam.follower] = replace(follower, guides={**follower.guides, face.name: face})
            if touches:
                disc = PlacedDisc(cam.link, point, point, radius)
                pair, name = (disc, None), _free_name(scene, contacts)
                contacts.append(PlacedContact(name, cam.link, cam.follower, pair, face.name, True, False))
            else:
                pins.append(PinInSlot(point, cam.link, cam.follower, face.name))
            continue
        tangent = course.tangent
        if abs(tangent) < SHARP * cam.base:
            raise Unsolvable("dead point", Problem(f"cams.{cam.link}", "the pitch curve has a cusp at this position"))
        point = cam.motion.tip if isinstance(cam.motion, SwingingFollower) else next(iter(follower.points), "")
        if not point:
            point = next(names)
            links[cam.follower] = replace(follower, points={point: 0j})
        bends = cross(tangent, course.bend) / abs(tangent) ** 3
        places[point] = cam.axis + course.point
        if bars and abs(bends) * cam.base >= STRAIGHT:
            # about the centre of curvature, as in a slot along a circle
            centre, middle = next(names), course.point + 1j * unit(tangent) / bends
            if abs(middle) * abs(bends) < ROUNDED:  # in a dwell
                middle = 0j
            links[cam.link] = replace(link, points={**link.points, centre: middle / turn})
            bar = PlacedLink(f"{centre}{point}", {centre: 0j, point: complex(1.0 / abs(bends))}, (centre, point),
                             {"": PlacedGuide("", 0j, 1 + 0j)})  # fmt: skip
            made[bar.name] = bar
            slots.append(CircularSlot(bar.name, cam.link, centre, 1.0 / abs(bends), bar.name, point))
            continue
        slot = _guide(link, "t", course.point / turn, unit(tangent) / turn, bends)
        links[cam.link] = replace(link, guides={**link.guides, slot.name: slot})
        pins.append(PinInSlot(point, cam.follower, cam.link, slot.name))
    whole = (*(links[link.name] for link in scene.links), *made.values())
    return replace(
        scene, links=whole, pins=(*scene.pins, *pins), slots=(*scene.slots, *slots),
        contacts=(*scene.contacts, *contacts),
        drivers=tuple(d.at_value(values.get(d.key, d.values[0])) for d in scene.drivers),
        sketch={**scene.sketch, **places}, drawn={}, instead_of=scene,
    )  # fmt: skip


def _turn(scene: Mechanism, cam: LawCam) -> complex:
    """The turn from the guide of a sliding follower to its own axis."""
    return next(s.turn for s in scene.slidings if s.link == cam.follower and s.on == scene.frame.name)


def _guide(link: PlacedLink, name: str, through: complex, direction: complex, bends: float) -> PlacedGuide:
    while name in link.guides:
        name += "1"
    return PlacedGuide(name, through, direction, bends)


def _free_name(scene: Mechanism, contacts: Sequence[PlacedContact]) -> str:
    """A letter for a contact that no point and no contact has."""
    taken = {*scene.holders, *(c.name for c in (*scene.contacts, *contacts))}
    return next(name for name in ("K", *(f"K{k}" for k in range(1, 1000))) if name not in taken)


def _free_names(scene: Mechanism) -> Iterator[str]:
    """Letters for centres of curvature that no point has."""
    taken = set(scene.holders)
    letters = ["O", "Q", *(f"O{k}" for k in range(1, 1000))]
    return (name for name in letters if name not in taken)
