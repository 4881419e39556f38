"""Instant centres from the analytic motion: where two links have the same velocity."""

from __future__ import annotations

import numpy as np

from graphkin.exact.motion import Motion
from graphkin.exact.pose import Array

__all__ = ["instant_centre"]


def instant_centre(motion: Motion, a: str, b: str) -> tuple[Array, Array]:
    """The relative rotation of link a against link b, as homogeneous coordinates of their instant centre.

    Returns
    -------
    q : complex, shape (n,), m rad/s
    omega : real, shape (n,), rad/s
        the centre is q / omega; at infinity in the direction of q where omega is 0; none where both are 0.  With the
        velocity v0 of the point at the world's origin, 0 = v0 + i omega z gives q = i v0.
    """
    one, two = motion.poses[a], motion.poses[b]
    v0 = (one.v - 1j * one.omega * one.z) - (two.v - 1j * two.omega * two.z)
    return np.asarray(1j * v0), np.asarray(one.omega - two.omega)
