"""How far rounding may have moved a result: a running first-order bound, carried along with the solution.

Each group takes over the bound of what it hangs on and multiplies it by one over the sine of the angle at which its two
loci cross (for a larger group by the condition of its equations).  An error of place counts in the velocity in
proportion to the size of the mechanism, one of velocity in the acceleration by the Coriolis term.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from graphkin.exact.pose import Array, Pose

__all__ = ["Bound", "enlarged"]

EPS = float(np.finfo(float).eps)
ROUNDINGS = 2.0
"""Roundings that a step of the chain adds, in units of the last place of its largest term."""


@dataclass(frozen=True)
class Bound:
    """Bounds of a link's points: position (m), velocity (m/s), acceleration (m/s2), and the largest values met."""

    position: Array
    velocity: Array
    acceleration: Array
    speed: Array
    push: Array

    @classmethod
    def none(cls) -> Bound:
        """The frame's."""
        zero = np.zeros(1)
        return cls(zero, zero, zero, zero, zero)


def enlarged(
    bounds: Mapping[str, Bound],
    poses: Mapping[str, Pose],
    radius: Mapping[str, float],
    bases: Iterable[str],
    gain: Array,
    size: float,
) -> Bound:
    """The bound of links found from others (``bases``) by equations that enlarge an error by ``gain``.

    Parameters
    ----------
    radius : for each link found the distance of its farthest point from its origin (m)
    """
    before = [bounds[name] for name in bases]
    new = [(poses[name], r) for name, r in radius.items()]
    reach = _most([np.abs(p.z) + r for p, r in new])
    spin = _most([np.abs(p.omega) for p, _ in new])
    speed = _most([b.speed for b in before] + [np.abs(p.v) + np.abs(p.omega) * r for p, r in new])
    push = _most([b.push for b in before] + [np.abs(p.a) + (np.abs(p.alpha) + p.omega**2) * r for p, r in new])
    place = gain * (_most([b.position for b in before]) + ROUNDINGS * EPS * reach)
    velocity = gain * (_most([b.velocity for b in before]) + (ROUNDINGS * EPS + place / size) * speed)
    acceleration = gain * (
        _most([b.acceleration for b in before]) + (ROUNDINGS * EPS + place / size) * push + 2 * spin * velocity
    )
    return Bound(place, velocity, acceleration, speed, push)


def _most(values: list[Array]) -> Array:
    most = values[0]
    for value in values[1:]:
        most = np.maximum(most, value)
    return np.asarray(most)
