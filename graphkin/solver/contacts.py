"""What happens where outlines touch: place, normal, slip, pressure angles; where the pitch circles of gears touch."""

from __future__ import annotations

import numpy as np

from graphkin.frozen import dataclass
from graphkin.scene.contacts import PlacedContact, PlacedGear
from graphkin.solver.motion import Motion
from graphkin.solver.pose import Array

__all__ = ["ContactMotion", "contact_motion", "pitch_point"]

STANDS = 1e-12
"""A point stands that is slower than this beside the other of the two, or beside the drivers' rate times the size."""


@dataclass(frozen=True)
class ContactMotion:
    """A contact at n positions.

    place : complex, shape (n,) (m)
    normal : unit complex, out of the first body
    slip : complex, velocity of the first body's point minus that of the second's (m/s)
    pressure : for each moving body the angle between normal and velocity of its point at the contact, 0 .. pi/2 (rad),
        NaN where it stands
    """

    place: Array
    normal: Array
    slip: Array
    pressure: dict[str, Array]


def contact_motion(motion: Motion, contact: PlacedContact) -> ContactMotion:
    """Place, normal, slip and pressure angles of a contact."""
    place = motion.position(contact.name)
    if contact.discs[0] is not None:
        disc = contact.discs[0]
        normal = (place - motion.position(disc.centre, disc.link)) / disc.radius
    else:
        assert contact.discs[1] is not None
        disc = contact.discs[1]
        normal = (motion.position(disc.centre, disc.link) - place) / disc.radius
    with np.errstate(invalid="ignore"):  # of positions that are none
        normal = normal / np.abs(normal)
    one, two = (motion.velocity(contact.name, link) for link in contact.links)
    ground = motion.scene.frame.name
    rates = max((abs(d.values[1]) for d in motion.scene.drivers), default=0.0)
    fast = np.maximum(np.abs(one), np.abs(two)) + rates * motion.scene.size
    pressure = {}
    for link, v in zip(contact.links, (one, two), strict=True):
        if link != ground:
            across = np.conj(normal) * v
            angle = np.arctan2(np.abs(across.imag), np.abs(across.real))
            pressure[link] = np.where(np.abs(v) > STANDS * fast, angle, np.nan)
    return ContactMotion(place, normal, np.asarray(one - two), pressure)


def pitch_point(motion: Motion, gear: PlacedGear) -> tuple[Array, tuple[float, float | None]]:
    """Where the pitch circles of a gear touch, complex, shape (n,) (m), and their radii with the signs of the teeth (m;
    None for a rack)."""
    axis = motion.position(gear.axes[0], gear.carrier)
    if gear.is_rack:
        rack = motion.link(gear.wheels[1])
        line = motion.poses[rack.name].fixed(rack.guides[gear.guide].through, rack.guides[gear.guide].direction)
        foot = line.z + line.u * ((axis - line.z) * np.conj(line.u)).real
        return np.asarray(foot), (float(np.abs(foot - axis).flat[0]), None)
    z1, z2 = gear.teeth
    assert z2 is not None
    way = motion.position(gear.axes[1], gear.carrier) - axis
    held = motion.link(gear.carrier).points
    far = abs(held[gear.axes[1]] - held[gear.axes[0]]) / abs(z1 + z2)
    return np.asarray(axis + way * (z1 / (z1 + z2))), (far * z1, far * z2)
