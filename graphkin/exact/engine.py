"""All elements of a structure in their order, at many driver values at once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from graphkin.exact.bounds import Bound, crossing, solved_together
from graphkin.exact.cluster import ClusterSolved, solve_cluster
from graphkin.exact.dyads import Solved, solve_dyad
from graphkin.exact.joints import Drive, body_shape, driven, dyad_joints, members
from graphkin.exact.pose import Array, Pose, rest
from graphkin.structure import Cluster, Driven, Dyad, Structure

__all__ = ["SINGULAR", "State", "positions"]

SINGULAR = 1e-7
"""A group whose two loci cross at a smaller sine than this is at a dead point."""


@dataclass(frozen=True)
class State:
    """The mechanism at n positions.

    poses : each link by its name, fields of shape (n,) or broadcasting to it
    groups : what each group gave, by its place among the elements
    bounds : how far rounding may have put each link
    """

    poses: Mapping[str, Pose]
    groups: Mapping[int, Solved | ClusterSolved] = field(default_factory=dict)
    bounds: Mapping[str, Bound] = field(default_factory=dict)


def positions(
    structure: Structure, drive: Drive, forms: Mapping[int, Array], upto: int | None = None, rates: bool = True
) -> State:
    """Solve every element at all positions of the drivers, each position afresh.

    Parameters
    ----------
    forms : the assembly of each group, by its place among the elements: for a dyad the sign, shape (n,); for a larger
        group the poses from which Newton's method starts, shape (n, members, 3)
    upto : solve only the elements before this one
    rates : False leaves out velocity and acceleration

    Returns
    -------
    State; at a position that cannot be assembled the discriminant of a group is negative and the poses mean nothing
    """
    frame = structure.scene.frame.name
    poses: dict[str, Pose] = {frame: rest()}
    bounds: dict[str, Bound] = {frame: Bound.none()}
    groups: dict[int, Solved | ClusterSolved] = {}
    size = structure.scene.size
    with np.errstate(all="ignore"):
        for i, element in enumerate(structure.elements[:upto]):
            if isinstance(element, Driven):
                poses[element.link] = driven(structure, element, poses, drive)
                if rates:
                    bounds[element.link] = crossing(bounds, poses, [element.link], np.ones(1), size)
                continue
            if isinstance(element, Dyad):
                shapes = body_shape(structure, element.first, drive), body_shape(structure, element.second, drive)
                joints = dyad_joints(structure, element, shapes, poses)
                solved = solve_dyad(element.kind, joints, np.asarray(forms[i]), rates)
                groups[i] = solved
                poses.update(members(shapes[0], solved.first))
                poses.update(members(shapes[1], solved.second))
                if rates:
                    names = [*shapes[0], *shapes[1]]
                    bound = crossing(bounds, poses, names, solved.sine, size)
                    bounds.update(dict.fromkeys(names, bound))
                continue
            assert isinstance(element, Cluster)
            together = solve_cluster(structure, element, poses, drive, np.asarray(forms[i]), rates)
            groups[i] = together
            poses.update(together.poses)
            if rates:
                bound = solved_together(bounds, poses, element.members, together.condition, size)
                bounds.update(dict.fromkeys(element.members, bound))
    return State(poses, groups, bounds)
