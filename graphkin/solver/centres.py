"""Instant centres from the analytic motion: where two links have the same velocity.

Centrodes: the paths of a link's instant centre in the frame and in the link itself.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphkin.solver.motion import Motion
from graphkin.solver.pose import Array
from graphkin.solver.quantities import pole

__all__ = ["Centrode", "centrode", "instant_centre"]


def instant_centre(motion: Motion, a: str, b: str) -> tuple[Array, Array]:
    """The relative rotation of link a against link b, as homogeneous coordinates of their instant centre.

    Returns
    -------
    q : complex, shape (n,), m rad/s
    omega : real, shape (n,), rad/s
        the centre is q / omega; at infinity in the direction of q where omega is 0; none where both are 0.  With the
        velocity v0 of the point at the world's origin, 0 = v0 + i omega z gives q = i v0.
    """
    return pole(motion.poses[a], motion.poses[b])


@dataclass(frozen=True)
class Centrode:
    """The instant centre of a link against the frame over a sweep of the driver.

    fixed : complex, shape (n,), its place in the frame (m); NaN where the mechanism does not stand or the link does
        not turn
    moving : complex, shape (n,), its place in the link's own axes (m)
    joined : bool, shape (n - 1,), whether the curves go on from one place to the next: not where the link ceases to
        turn between the two, so that the centre passes through infinity
    """

    fixed: NDArray[np.complex128]
    moving: NDArray[np.complex128]
    joined: NDArray[np.bool_]


def centrode(motion: Motion, link: str) -> Centrode:
    """The centrodes of a link from a sweep.

    The centre lies at z + i v / omega, where no point of the link has a velocity; in the link's axes that is
    i v / (omega u) (Bottema and Roth, Theoretical Kinematics, ch. VIII; Norton, Design of Machinery, 6.6).
    """
    pose = motion.poses[link]
    turns = motion.ok & (np.abs(pose.omega) > 0.0)
    omega = np.where(turns, pose.omega, np.nan)
    with np.errstate(invalid="ignore"):
        arm = 1j * pose.v / omega
    fixed, moving = pose.z + arm, arm * np.conj(pose.u)
    joined = (omega[:-1] * omega[1:] > 0.0) & turns[:-1] & turns[1:]
    return Centrode(np.asarray(fixed), np.asarray(moving), np.asarray(joined))
