"""The motion of a mechanism with cams as that of what is drawn in its place: the same links, blocks on curves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphkin.solver.motion import Motion
from graphkin.solver.pose import Pose
from graphkin.solver.redundant import all_slides
from graphkin.structure import Structure

__all__ = ["as_drawn"]


def as_drawn(motion: Motion, structure: Structure) -> Motion:
    """A motion at one position, with the blocks and points that a replacing mechanism has there; itself of a mechanism
    without cams."""
    if structure.scene.instead_of is None:
        return motion
    poses = dict(motion.poses)
    for name, link in structure.links.items():
        if name in poses or name not in structure.links:
            continue
        slide = next(s for s in structure.slides if s.a == name)
        (pin,) = link.points
        holder = next(n for n in structure.hinges.get(pin, ()) if n != name)
        at = poses[holder].fixed(structure.links[holder].points[pin])
        guide = poses[slide.b]
        poses[name] = Pose(at.z, np.asarray(guide.u * slide.guide.direction), at.v, guide.omega, at.a, guide.alpha)
    return replace(motion, structure=structure, poses=poses, slides=all_slides(structure))
