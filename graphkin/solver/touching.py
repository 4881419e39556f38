"""The motion where links touch, in contacts, wheels and cams: place, common normal, slip, pressure angles, radii of
pitch circles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

import numpy as np

from graphkin.scene.pairs import HigherPair, LawCam, PlacedContact, PlacedGear
from graphkin.solver.algebra.pose import Array
from graphkin.solver.cams import cam_angle, cam_at, slip_of
from graphkin.solver.motion import Motion

STANDS = 1e-12
"""A point slower than this beside the other point, or beside the drivers' rate times the size, stands."""
ROUNDED = 1e-12
"""An angle (rad) between a normal and a direction that fall together."""


Measure: TypeAlias = Array | Mapping[str, Array] | str | list[float | None]
"""Of every position; by link, NaN where there is none; or of the pair at all positions."""


def measured(motion: Motion, pair: HigherPair) -> dict[str, Measure]:
    """The measures of a higher pair by name, arrays of shape (n,), in the scene's units: lengths, velocities in m/s or
    the like, angles in rad."""
    metres, fast = motion.scene.units.metres, motion.scene.units.rates.metres
    if isinstance(pair, PlacedGear):
        at, radii = pitch_point(motion, pair)
        return {"pitch_point": at / metres, "radii": [None if r is None else r / metres for r in radii]}
    at, normal = touch_of(motion, pair)
    if isinstance(pair, PlacedContact):
        first, second = (motion.velocity(pair.name, link) for link in pair.bodies)
        return {"kind": "rolling" if pair.rolling else "sliding", "position": at / metres, "normal": normal,
                "slip": (first - second) / fast, "pressure": contact_pressure(motion, pair)}
    turn = motion.poses[pair.link]
    there = cam_at(pair, cam_angle(pair, turn.u))
    return {"lift": there.lift / (1.0 if pair.turns else metres), "contact": at / metres, "normal": normal,
            "slip": slip_of(pair, there, np.asarray(turn.omega)) / fast, "pressure": there.pressure}


def touch_of(motion: Motion, pair: HigherPair) -> tuple[Array, Array]:
    """The place where two bodies touch (m) and the common normal, unit, both complex, shape (n,); of wheels the pitch
    point and the line of centres."""
    if isinstance(pair, LawCam):
        there = cam_at(pair, cam_angle(pair, motion.poses[pair.link].u))
        return np.asarray(pair.axis + there.contact), there.normal
    if isinstance(pair, PlacedGear):
        at, _ = pitch_point(motion, pair)
        line = at - motion.position(pair.axes[0], pair.carrier)
        return at, np.asarray(line / np.abs(line))
    return motion.position(pair.name), contact_normal(motion, pair)


def contact_normal(motion: Motion, contact: PlacedContact) -> Array:
    """The normal of a contact, out of its first body, unit complex, shape (n,)."""
    radius, link = contact.radii[0], contact.round_links[0]
    arm = motion.position(contact.name) - motion.position(contact.centres[0], link)
    normal = arm / (radius if link == contact.bodies[0] else -radius)
    with np.errstate(invalid="ignore"):  # of positions that are none
        return normal / np.abs(normal)


def contact_pressure(motion: Motion, contact: PlacedContact) -> dict[str, Array]:
    """For each moving body of a contact the angle between the normal and the velocity of its point there, 0 .. pi/2
    (rad), NaN where it rests, shape (n,)."""
    normal = contact_normal(motion, contact)
    velocities = {link: motion.velocity(contact.name, link) for link in contact.bodies}
    rates = max((abs(d.values[1]) for d in motion.scene.drivers), default=0.0)
    fast = np.maximum(*map(np.abs, velocities.values())) + rates * motion.scene.size
    velocities.pop(motion.scene.frame.name, None)
    return {link: np.where(np.abs(velocity) > STANDS * fast, angle_between(normal, velocity), np.nan)
            for link, velocity in velocities.items()}


def angle_between(normal: Array, direction: Array) -> Array:
    """The angle between the lines of a normal and of a direction (rad), 0 .. pi/2; 0 where it is rounding alone."""
    across = np.conj(normal) * direction
    angle = np.arctan2(np.abs(across.imag), np.abs(across.real))
    return np.where(angle > ROUNDED, angle, 0.0)


def pitch_point(motion: Motion, gear: PlacedGear) -> tuple[Array, tuple[float, float | None]]:
    """The pitch point of a gear, complex, shape (n,) (m), and the radii of the pitch circles with the signs of the
    teeth (m; None for a rack)."""
    axis = motion.position(gear.axes[0], gear.carrier)
    if gear.is_rack:
        rack = motion.link(gear.bodies[1])
        line = motion.poses[rack.name].fixed(rack.guides[gear.guide].through, rack.guides[gear.guide].direction)
        foot = line.z + line.u * ((axis - line.z) * np.conj(line.u)).real
        return np.asarray(foot), (float(np.abs(foot - axis).flat[0]), None)
    z1, z2 = gear.teeth
    assert z2 is not None
    span = motion.position(gear.axes[1], gear.carrier) - axis
    held = motion.link(gear.carrier).points
    far = abs(held[gear.axes[1]] - held[gear.axes[0]]) / abs(z1 + z2)
    return np.asarray(axis + span * (z1 / (z1 + z2))), (far * z1, far * z2)
