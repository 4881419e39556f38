"""How far rounding may have moved a result: a running first-order bound, carried along with the solution.

Each group takes over the bound of what it hangs on and multiplies it by one over the sine of the angle at which its two
loci cross (for a larger group by the condition of its equations).  Lengths are counted in the size of the
mechanism, velocities in the largest velocity met so far, accelerations likewise.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from graphkin.exact.pose import Array, Pose

__all__ = ["Bound", "crossing", "solved_together"]

EPS = float(np.finfo(float).eps)
ROUNDINGS = 8.0
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


def crossing(
    bounds: Mapping[str, Bound], poses: Mapping[str, Pose], names: Iterable[str], sine: Array, size: float
) -> Bound:
    """The bound of links that were found where two loci cross at an angle of this sine."""
    return solved_together(bounds, poses, names, 1 / np.abs(sine), size)


def solved_together(
    bounds: Mapping[str, Bound], poses: Mapping[str, Pose], names: Iterable[str], gain: Array, size: float
) -> Bound:
    """The bound of links that were found from equations that enlarge an error by ``gain``."""
    before = list(bounds.values())
    new = [poses[name] for name in names]
    spin = _most([np.abs(p.omega) for p in new])
    reach = _most([np.abs(p.z) for p in new] + [np.asarray([size])])
    speed = _most([b.speed for b in before] + [np.abs(p.v) + np.abs(p.omega) * size for p in new])
    push = _most([b.push for b in before] + [np.abs(p.a) + (np.abs(p.alpha) + p.omega**2) * size for p in new])
    place = gain * (_most([b.position for b in before]) + ROUNDINGS * EPS * reach)
    turned = place / size
    velocity = gain * (_most([b.velocity for b in before]) + ROUNDINGS * EPS * speed + turned * speed)
    whirl = 2 * spin * velocity
    acceleration = gain * (_most([b.acceleration for b in before]) + ROUNDINGS * EPS * push + turned * push + whirl)
    return Bound(place, velocity, acceleration, speed, push)


def _most(values: list[Array]) -> Array:
    most = values[0]
    for value in values[1:]:
        most = np.maximum(most, value)
    return np.asarray(most)
