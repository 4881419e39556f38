"""Contours of known shape in a larger group, which are drawn with one of their links held still.

Whatever the rest of a group does, links that drivers inside it hold to each other move as one link for the moment,
except for the drivers' given motions.  These motions, seen with one link of such a contour held still, are drawn first;
points of the others are then points of the held link with a known vector added (Coriolis included), and the group is
drawn as if the contour were one link.  A point's velocity, seen from the held link, is its velocity relative to the
coincident point of that link; other vectors have the link's name.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphkin.construction.polygons.polygons import Polygons
from graphkin.construction.polygons.vector_graph import contacts_of, links_alike
from graphkin.structure import LargerGroup, driver_pair

ALIKE = 1e-9  # of unit motions: what differs less moves alike
Joint = tuple[tuple[str, str], complex, complex | None, bool]
"""What joins two links: a hinge in a place, or along a direction a sliding pair; and whether a driver gives how they
turn or slide on each other."""


def contours_of(plot: Polygons, group: LargerGroup, turned: Sequence[tuple[str, str, float]]) -> list[tuple[str, ...]]:
    """The contours of a group on paper, of which links are ``turned`` alike; none where its links roll or touch."""
    if group.rolling or (plot.at_contacts and contacts_of(plot.structure, group)):
        return []
    held = [driver_pair(driver, plot.links, plot.structure.slides) for driver in group.drivers]
    driven = {(pair.turns, frozenset(pair.links)) for pair in held if pair is not None}
    poses, inside, joints = plot.paper.poses, set(group.members), list[Joint]()
    for pair in (pair for pair in group.pairs if inside.issuperset(pair.links)):
        letter, along = pair.point or pair.pin, None if pair.turns else pair.along(poses)
        at = plot.places[letter] if letter else poses[pair.a].origin
        joints.append((pair.links, at, along, (pair.turns, frozenset(pair.links)) in driven))
    return contours(group.members, joints, [(a, b) for a, b, _ in turned if inside.issuperset((a, b))])


def on_held(group: LargerGroup, held: str, contour: Sequence[str]) -> LargerGroup:
    """The links of a contour besides the held link, as a group of their own."""
    rest, within = tuple(n for n in contour if n != held), set(contour)
    drivers = tuple(d for d in group.drivers if within.issuperset(d.links))
    pairs = tuple(p for p in group.pairs if within.issuperset(p.links))
    return LargerGroup(rest, pairs, drivers, tuple(n for n in rest if n in group.links), group.order)


def contours(
    links: Sequence[str], joints: Sequence[Joint], turning: Sequence[tuple[str, str]]
) -> list[tuple[str, ...]]:
    """The largest sets of links that can only move as one with drivers at rest, in every motion that the joints allow.

    Links that a driver holds at their common pair are one already: a set of only such links is left out.

    Parameters
    ----------
    joints : between links of the group
    turning : further links whose rotations differ only by the drivers' motions
    """
    turns = np.array([0.0, 0.0, 1.0])
    kept = [(both, turns) for both in turning]
    size = max((abs(at) for _, at, _, _ in joints), default=1.0) or 1.0
    for both, at, along, driven in joints:
        # how a point there moves: by the motion at the origin and the rate of turning
        across, up = np.array([1.0, 0.0, -at.imag / size]), np.array([0.0, 1.0, at.real / size])
        if along is None or driven:
            kept += [(both, across), (both, up)]
        else:
            kept.append((both, (1j * along).real * across + (1j * along).imag * up))
        if along is not None or driven:
            kept.append((both, turns))
    rows = np.zeros((len(kept), len(links), 3))
    for row, ((members, two), weights) in zip(rows, kept, strict=True):
        row[links.index(members)], row[links.index(two)] = weights, -weights
    _, sizes, motions = np.linalg.svd(rows.reshape(len(kept), -1))
    free = motions[int(np.sum(sizes > ALIKE)) :].T.reshape(len(links), 3, -1)
    sets: list[list[int]] = []
    for i in range(len(links)):
        distances = (np.abs(free[members[0]] - free[i]).max(initial=0.0) for members in sets)
        home = next((members for members, distance in zip(sets, distances, strict=True) if distance < 10 * ALIKE), None)
        if home is None:
            sets.append([i])
        else:
            home.append(i)
    alike = [tuple(links[i] for i in members) for members in sets if len(members) > 1]
    already = links_alike(links, ((*both, 0.0) for both, _, _, driven in joints if driven))
    return [members for members in alike if not already[members[0]].issuperset(members)]
