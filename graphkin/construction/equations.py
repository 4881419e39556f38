"""Vector equations as chains of points, and which of them can be drawn next.

A chain from one known node to another (`net`) gives a vector equation; it can be drawn when two sizes are unknown.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from graphkin.construction.net import Edge, Joined, Net, TwoWays
from graphkin.scene.model import PlacedLink
from graphkin.scene.symbol import PointRef

__all__ = ["equation_of"]


def equation_of(
    links: Mapping[str, PlacedLink],
    frame: str,
    joined: Joined,
    places: Mapping[str, complex],
    guide_names: Mapping[str, tuple[str, ...]],
    drawn: Mapping[PointRef, complex],
    same_turn: Mapping[str, str],
    tiny: float,
) -> TwoWays | None:
    """Find the shortest equation with two unknown sizes of a dyad's links and all pairs that hold them.

    Parameters
    ----------
    places : where each letter lies on paper (mm)
    guide_names : how the direction of each sliding pair is written, by its key
    drawn : nodes that stand in the polygon already (preferred as starting points)
    same_turn : for each link of the group the one link whose angular velocity it shares
    tiny : points nearer to each other than this (mm) give no direction
    """
    net = Net(links, frame, joined, places, guide_names, same_turn, tiny)
    known = [n for n in net.nodes if net.known(n)]
    best: tuple[tuple[float, ...], TwoWays] | None = None
    for start in known:
        for path in net.paths(start):
            chain = _as_chain(path, frame, links)
            if chain is None:
                continue
            ends = (path[0].start, path[-1].end)
            strangers = {n for e in path for n in (e.start, e.end)} - net.natural
            cost = (
                len(path) + 0.6 * len(strangers) + 0.1 * sum(n not in drawn for n in ends),
                float(net.fixed(path[0].start)),
                float(net.order[path[0].start]),
            )
            if best is None or cost < best[0]:
                best = (cost, chain)
    return best[1] if best else None


def _as_chain(path: Sequence[Edge], frame: str, links: Mapping[str, PlacedLink]) -> TwoWays | None:
    """Split a path with two unknowns at the node before the second."""
    places = [i for i, e in enumerate(path) if e.unknown]
    if len(places) != 2 or path[places[0]].unknown == path[places[1]].unknown:
        return None
    cut = places[1]
    right = tuple(path[:cut])
    left = tuple(e.reversed() for e in reversed(path[cut:]))
    return TwoWays(right[-1].end, left, right)
