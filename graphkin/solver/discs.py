"""An eccentric disc, which turns about a point beside its centre, measured as a cam: base circles, rise, offset,
pressure angles."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from graphkin.plane import cross
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import PlacedContact
from graphkin.scene.symbol import Symbol
from graphkin.search import resolve
from graphkin.solver.algebra.pose import Array
from graphkin.solver.path.driver_range import DriverRange, extremes, range_of
from graphkin.solver.touching import angle_between, contact_normal, contact_pressure
from graphkin.structure import Structure


@dataclass(frozen=True)
class DiscCam:
    """The measures of a disc as a cam (m, rad).

    contact : its name; ``link`` is the cam, ``follower`` the driven link
    profile : least distance of the disc's outline from the axis; pitch : of the centre of a round follower, None else
    rise : stroke of the follower, or its swing where it ``swings``
    offset : distance of a sliding follower's line from the axis, positive where the axis lies to its left; None else
    most : the greatest pressure angle of a turn, and the driver's angle there
    here : pressure angle at the scene's own position; None where the follower rests
    lowest : travel or angle of the follower nearest to the axis; outline : centre of the disc in the cam's
        own axes, from the axis, and its radius
    """

    contact: str
    link: str
    follower: str
    profile: float
    pitch: float | None
    rise: float
    swings: bool
    offset: float | None
    most: tuple[float, float]
    here: float | None
    lowest: float
    outline: tuple[complex, float]


def disc_cams(structure: Structure) -> tuple[DiscCam, ...]:
    """The discs that the driver of a mechanism turns about the frame, with the followers that they move.

    Raises
    ------
    Unsolvable : the driver makes no whole turn
    """
    scene = structure.scene
    cams = [(c, *sides) for c in scene.contacts if (sides := _sides(scene, c)) is not None]
    if not cams:
        return ()
    return tuple(_measured(range_of(structure), *cam) for cam in cams)


def _sides(scene: Mechanism, contact: PlacedContact) -> tuple[int, str] | None:
    """The side of a contact that is the cam (0 or 1), and the name of the follower's motion: its sliding pair or
    link."""
    driver = scene.drivers[0] if scene.drivers else None
    if driver is None or not driver.turns_about(scene.frame.name) or contact.rolling:
        return None
    if driver.link not in contact.bodies:
        return None
    side = contact.bodies.index(driver.link)
    follower = contact.bodies[1 - side]
    if driver.link == contact.face or not scene.pivots(driver.link):
        return None
    if (rail := scene.rail(follower)) is not None:
        return side, rail.key
    return (side, follower) if scene.pivots(follower) else None


def _measured(reach: DriverRange, contact: PlacedContact, side: int, of: str) -> DiscCam:
    scene = reach.scene
    link, follower = contact.bodies[side], contact.bodies[1 - side]
    which = contact.round_links.index(link)  # of the discs
    centre, radius = contact.centres[which], contact.radii[which]
    points = scene.by_name[link].points
    axis = scene.pivots(link)[0]
    place = points[centre] - points[axis]
    eccentricity = abs(place)
    swings = "/" not in of
    ends = extremes(reach, Symbol.parse(f"swing_{of}" if swings else f"stroke_{of}"))
    offset = None
    if not swings:
        guide = scene.sliding(of).guide
        at = guide.through
        if not contact.flat:
            at = reach.motion(np.zeros(1)).point(contact.centres[1 - which], follower).z[0]
        offset = float(cross(guide.direction, scene.frame.points[axis] - complex(at)))
    here = _pressures(reach, contact, follower, np.zeros(1))[0]
    touch = reach.motion(np.array([ends.low_offset, ends.high_offset])).position(contact.name)
    near, far = np.abs(touch - scene.frame.points[axis])
    return DiscCam(
        contact.name, link, follower, abs(abs(radius) - eccentricity),
        None if contact.flat else abs(abs(contact.apart) - eccentricity),
        ends.stroke, swings, offset, _greatest(reach, contact, follower), None if math.isnan(here) else float(here),
        ends.low if near <= far else ends.high, (place, abs(radius)),
    )


def disc_course(structure: Structure, disc: DiscCam, angle: Array) -> tuple[Array, Array, Array | None, Array]:
    """The course of a measured disc and its follower at angles of the driver (rad), shape (n,).

    Returns
    -------
    lift : from the lowest place (m, rad)
    profile, pitch : contact, and centre of a round follower (None of a flat face), in the cam's own axes from its axis
        (m)
    pressure : pressure angle (rad)
    """
    scene, reach = structure.scene, range_of(structure)
    contact = scene.contact_at[disc.contact]
    sides = _sides(scene, contact)
    assert sides is not None
    side, of = sides
    motion = reach.motion(reach.offsets(angle), unit=True)
    axis = scene.frame.points[scene.pivots(disc.link)[0]]
    back, place = np.conj(motion.poses[disc.link].u), motion.position(contact.name)
    if disc.swings:
        value = reach.angle(motion, disc.follower)
        motion_of_follower = 1j * (place - scene.frame.points[scene.pivots(disc.follower)[0]])
    else:
        value = motion.slide(of)[0]
        motion_of_follower = np.full(len(angle), scene.sliding(of).guide.direction)
    pitch = None if contact.flat else (motion.position(contact.centres[1 - side], disc.follower) - axis) * back
    pressure = angle_between(contact_normal(motion, contact), motion_of_follower)
    return np.abs(value - disc.lowest), (place - axis) * back, pitch, pressure


def _pressures(reach: DriverRange, contact: PlacedContact, follower: str, offset: Array) -> Array:
    """Pressure angles of the follower; NaN where it rests."""
    return contact_pressure(reach.motion(offset, unit=True), contact)[follower]


def _greatest(reach: DriverRange, contact: PlacedContact, follower: str) -> tuple[float, float]:
    """The greatest pressure angle of a turn, and the driver's angle there."""

    def folded(offset: Array) -> tuple[Array, Array]:
        angle = _pressures(reach, contact, follower, offset)
        return -np.cos(2 * angle)[:, None], np.zeros((len(offset), 1))  # smooth where the angle is 0, too

    turns = resolve(folded, 0.0, math.tau, periodic=True, floor=1.0).turns(0)
    places = np.array([*(turn.place for turn in turns if turn.sense > 0), 0.0, 1.0])  # two of a constant
    angles = _pressures(reach, contact, follower, places)
    k = int(np.nanargmax(angles))
    return float(angles[k]), float(reach.value(places[k]))
