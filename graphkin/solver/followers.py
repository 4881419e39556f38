"""Followers moved by cams: the law at many angles of the cam, and what it gives the formulas of a mechanism."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.scene.cams import SEAM, TURN, FollowerLaw, LawCam, Lift, SlidingFollower
from graphkin.scene.tables import Units
from graphkin.solver.joints import turned
from graphkin.solver.pose import Array
from graphkin.structure import Structure
from graphkin.words import Phrase, Wording

__all__ = ["beginning", "cam_angle", "follower_inputs", "greatest_jerk", "lifts", "meeting_followers"]


def lifts(law: FollowerLaw, angle: Array) -> Lift:
    """Lift and derivatives at angles of the cam (rad), each of shape (n,); a seam belongs to the later piece."""
    within = np.remainder(np.asarray(angle, dtype=float), TURN)
    seams = np.array([*law.starts, TURN])
    nearest = np.argmin(np.abs(within[:, None] - seams[None, :]), axis=1)
    near = np.abs(within - seams[nearest]) < SEAM
    within = np.where(near, seams[nearest] % TURN, within)
    which = np.searchsorted(seams, within, side="right") - 1
    found = np.empty((4, len(within)))
    for k, part in enumerate(law.parts):
        rows = which == k
        if rows.any():
            for order, values in enumerate(part.at(within[rows], np)):
                found[order, rows] = values
    return Lift(*found)


def greatest_jerk(law: FollowerLaw) -> float:
    """The greatest third derivative of the lift (m or rad, per rad3), jumps left out."""
    at = [
        abs(part.at(part.start + x * (part.end - part.start)).jerk) for part in law.parts for x in (0.0, 0.25, 0.5, 1.0)
    ]
    return float(max(at))


def cam_angle(cam: LawCam, turn: Array) -> Array:
    """The angle of the law (rad) where the cam's own axis points along unit complex numbers."""
    return np.asarray(cam.sense * np.angle(turn))


def beginning(cam: LawCam, units: Units | None = None) -> float:
    """Where the follower stands at lift 0: distance beyond the foot (m), or angle of its bar (rad).

    Raises
    ------
    Unsolvable : it does not come to the base circle
    """
    found = cam.beginning
    if found is not None:
        return found
    raise Unsolvable("not assembled", Problem(f"cams.{cam.link}", *_apart(cam, units or Units())))


def _apart(cam: LawCam, units: Units) -> tuple[Wording, Wording]:
    motion = cam.motion

    def length(metres: float) -> str:
        return f"{metres / units.metres:.6g} {units.length}"

    if isinstance(motion, SlidingFollower):
        said = Phrase("the line of follower passes outside the base", follower=cam.follower)
        return said, Phrase("its radius is at least the offset", length=length(abs(motion.offset)))
    far = abs(cam.axis - motion.centre)
    said = Phrase("follower does not reach the base circle of", follower=cam.follower)
    return said, Phrase(
        "its radius lies between and", length=length(abs(far - motion.arm)), other=length(far + motion.arm)
    )


def meeting_followers(structure: Structure) -> Structure:
    """The structure itself, if every follower comes to its base circle.  Raises Unsolvable, all of them named."""
    problems: list[Problem] = []
    for cam in structure.scene.cams:
        try:
            beginning(cam, structure.scene.units)
        except Unsolvable as stop:
            problems += stop.problems
    if problems:
        raise Unsolvable("not assembled", *problems)
    return structure


def follower_inputs(cam: LawCam, turn: Array) -> Mapping[str, Array]:
    """What the formulas of a follower take at each position, by the direction of the cam's own axis.

    travel (m), or cos and sin of the angle of the follower's own axis, and the two derivatives of either by the angle
    of the cam's own axis, slope and bend
    """
    lift, start = lifts(cam.law, cam_angle(cam, turn)), beginning(cam)
    motion = cam.motion
    if isinstance(motion, SlidingFollower):
        return {"travel": motion.travel + start + lift.lift, "slope": cam.sense * lift.slope, "bend": lift.bend}
    line = cam.axis - motion.centre
    line = line / abs(line) * (-1 if motion.back else 1)
    axis = line * turned(motion.side * (start + lift.lift))
    return {"cos": axis.real, "sin": axis.imag, "slope": motion.side * cam.sense * lift.slope,
            "bend": motion.side * lift.bend}  # fmt: skip
