"""Centrodes: the paths of a link's instant centre in the frame and in the link itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphkin.exact.motion import Motion
from graphkin.exact.pose import Array

__all__ = ["Centrode", "centrode"]


@dataclass(frozen=True)
class Centrode:
    """The instant centre of a link against the frame over a sweep of the driver.

    fixed : complex, shape (n,), its place in the frame (m); NaN where the mechanism does not stand or the link does
        not turn
    moving : complex, shape (n,), its place in the link's own axes (m)
    joined : bool, shape (n - 1,), whether the curves go on from one place to the next: not where the link ceases to
        turn between the two, so that the centre passes through infinity
    """

    fixed: Array
    moving: Array
    joined: Array


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
