"""The motion of a mechanism with cams as that of what is drawn in its place: the same links, bars to centres of
curvature, blocks on curves."""

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
    that nothing replaces."""
    if structure.scene.instead_of is None and structure.links.keys() == motion.structure.links.keys():
        return motion
    poses = dict(motion.poses)
    for slide in structure.slides:
        if slide.a in poses or not slide.slot or slide.pin is None:
            continue
        holder = next(n for n in structure.hinges.get(slide.pin, ()) if n != slide.a)
        if holder not in poses or slide.b not in poses:
            continue  # nothing asks for it
        at = poses[holder].fixed(structure.links[holder].points[slide.pin])
        guide = poses[slide.b]
        turn = np.asarray(guide.u * slide.guide.direction)
        poses[slide.a] = Pose(at.z, turn, at.v, guide.omega, at.a, guide.alpha)
    for slot in structure.scene.slots:
        if slot.bar in poses or slot.bar not in structure.links or slot.on not in poses:
            continue
        held = [n for n in structure.hinges.get(slot.point, ()) if n != slot.bar and n in poses]
        if not held:
            continue  # nothing asks for it
        holder = held[0]
        start = poses[slot.on].fixed(structure.links[slot.on].points[slot.centre])
        end = poses[holder].fixed(structure.links[holder].points[slot.point])
        across = (end.z - start.z) / slot.radius
        way = across / np.abs(across)
        omega = (np.conj(1j * way) * (end.v - start.v)).real / slot.radius
        alpha = (np.conj(1j * way) * (end.a - start.a)).real / slot.radius
        poses[slot.bar] = Pose(start.z, way, start.v, omega, start.a, alpha)
    return replace(motion, structure=structure, poses=poses, slides=all_slides(structure))
