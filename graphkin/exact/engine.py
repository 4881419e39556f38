"""All elements of a structure in their order, at many driver values at once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from graphkin.exact.bounds import Bound, enlarged
from graphkin.exact.cluster import ClusterSolved, solve_cluster
from graphkin.exact.dyads import Solved, solve_dyad
from graphkin.exact.joints import Drive, body_shape, driven, dyad_joints, members
from graphkin.exact.pose import Array, Pose, rest
from graphkin.structure import Driven, Dyad, Pair, Structure

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

    def bound(names: Iterable[str], pairs: Iterable[Pair], gain: Array) -> None:
        radius = {name: max(map(abs, structure.links[name].points.values()), default=0.0) for name in names}
        bases = {end for pair in pairs for end in (pair.a, pair.b)} - set(radius)
        found = enlarged(bounds, poses, radius, bases, gain, size)
        bounds.update(dict.fromkeys(radius, found))

    with np.errstate(all="ignore"):
        for i, element in enumerate(structure.elements[:upto]):
            if isinstance(element, Driven):
                poses[element.link] = driven(structure, element, poses, drive)
                if rates:
                    bound([element.link], [element.pair], np.ones(1))
            elif isinstance(element, Dyad):
                shapes = body_shape(structure, element.first, drive), body_shape(structure, element.second, drive)
                joints = dyad_joints(structure, element, shapes, poses)
                solved = solve_dyad(element.kind, joints, np.asarray(forms[i]), rates)
                groups[i] = solved
                poses.update(members(shapes[0], solved.first))
                poses.update(members(shapes[1], solved.second))
                if rates:
                    bound(
                        [*shapes[0], *shapes[1]], [element.outer_first, element.outer_second], 1 / np.abs(solved.sine)
                    )
            else:
                together = solve_cluster(structure, element, poses, drive, np.asarray(forms[i]), rates)
                groups[i] = together
                poses.update(together.poses)
                if rates:
                    bound(element.members, element.pairs, together.condition)
    return State(poses, groups, bounds)
