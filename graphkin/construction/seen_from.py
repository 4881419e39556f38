"""Motion seen from a link of a larger group that is held still: contours of known shape, and how they are drawn.

Whatever the rest of a group does, links that drivers inside it hold to each other move as one link at the moment, but
for motions that the drivers give.  Seen with one link of such a contour held still, these are drawn first; the others
are then points of the held link, each with a known vector more (Coriolis included), and the group is drawn as if the
contour were one link.  A point's own velocity, seen from the held link, is that relative to the coincident point of it;
other vectors bear its name.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

__all__ = ["Joint", "contours"]

ALIKE = 1e-9  # of unit motions: what differs less moves alike
Rows = list[np.ndarray]


@dataclass(frozen=True)
class Joint:
    """What joins two links of a group: a hinge in a place, or, ``along`` a direction, a sliding pair; ``driven`` where
    a driver gives how they turn or slide on each other."""

    links: tuple[str, str]
    at: complex
    along: complex | None
    driven: bool


def contours(
    links: Sequence[str], joints: Sequence[Joint], turning: Sequence[tuple[str, str]]
) -> list[tuple[str, ...]]:
    """The largest sets of links that can only move as one, drivers at rest, however the group hangs on others.

    Links that a driver holds at their common pair are one already: a set of nothing else is left out.

    Parameters
    ----------
    joints : those between links of the group
    turning : further links whose rotations differ only by what drivers give
    """
    at = {name: 3 * i for i, name in enumerate(links)}
    size = max((abs(j.at) for j in joints), default=1.0) or 1.0
    rows: Rows = []
    for one, two in turning:
        rows.append(_row(at, one, two, (0.0, 0.0, 1.0)))
    for joint in joints:
        z = joint.at / size
        # how a point there moves: by the motion at the origin and the rate of turning
        across, up = (1.0, 0.0, -z.imag), (0.0, 1.0, z.real)
        if joint.along is None or joint.driven:
            rows += [_row(at, *joint.links, across), _row(at, *joint.links, up)]
        else:
            n = 1j * joint.along
            rows.append(_row(at, *joint.links, tuple(n.real * x + n.imag * y for x, y in zip(across, up, strict=True))))
        if joint.along is not None or joint.driven:
            rows.append(_row(at, *joint.links, (0.0, 0.0, 1.0)))
    _, sizes, turned = np.linalg.svd(np.array(rows))
    free = turned[int(np.sum(sizes > ALIKE)) :].T.reshape(len(links), 3, -1)
    sets: list[list[int]] = []
    for i in range(len(links)):
        home = next((one for one in sets if np.abs(free[one[0]] - free[i]).max(initial=0.0) < 10 * ALIKE), None)
        if home is None:
            sets.append([i])
        else:
            home.append(i)
    found = [tuple(links[i] for i in one) for one in sets]
    held = [set(j.links) for j in joints if j.driven]
    return [one for one in found if len(one) > 1 and not _one_already(one, held)]


def _row(at: dict[str, int], one: str, two: str, weights: Sequence[float]) -> np.ndarray:
    row = np.zeros(3 * len(at))
    row[at[one] : at[one] + 3] = weights
    row[at[two] : at[two] + 3] = [-w for w in weights]
    return row


def _one_already(links: Sequence[str], held: Sequence[set[str]]) -> bool:
    """Whether driven pairs alone hold links together."""
    reached, grown = {links[0]}, True
    while grown:
        grown = False
        for both in held:
            if both & reached and not both <= reached:
                reached, grown = reached | both, True
    return reached >= set(links)
