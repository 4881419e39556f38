"""Wheels laid on a line of centres: the heights at which a velocity plan is drawn (Kutzbach 1927); and what stands on
that plan, and on that of their tangential accelerations.

What rolls keeps its rates when the carrier of its axes is bent or straightened, as long as no distance of two axes that
it holds changes.  So all axes of a train are laid on one line as far as that goes; a pair of wheels whose axes stand on
a line already, but not so far apart, gets a line of its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from graphkin.plane import cross, dot
from graphkin.scene.model import PlacedLink
from graphkin.structure import Mesh

__all__ = ["CentreLine", "PlanLine", "PlanScales", "PlanTrial", "Spot", "TrainPlan", "centre_lines", "trains"]

ALIKE = 1e-9  # of a length: heights that are one


@dataclass(frozen=True)
class Spot:
    """A place of a line of centres at which some links have one velocity: an axis by its point, or where two roll on
    each other by the name of that pair.  ``height`` in m."""

    name: str
    height: float
    links: tuple[str, ...]
    rolls: bool


@dataclass(frozen=True)
class CentreLine:
    """Pairs that roll, with their axes on one line.

    ``still`` is the place that velocities are counted from: it belongs to the frame, or else they are those relative
    to that axis.
    """

    meshes: tuple[Mesh, ...]
    spots: tuple[Spot, ...]
    still: str
    in_frame: bool

    @property
    def links(self) -> tuple[str, ...]:
        """Links with a line in the plan, in the order of the pairs."""
        return tuple(dict.fromkeys(name for mesh in self.meshes for name in mesh.links))

    def spots_of(self, link: str) -> tuple[Spot, ...]:
        """The places of a link, from below."""
        return tuple(sorted((s for s in self.spots if link in s.links), key=lambda s: s.height))

    def spot(self, name: str) -> Spot:
        """A place by its name."""
        return next(s for s in self.spots if s.name == name)


def trains(meshes: Sequence[Mesh], ground: str) -> tuple[tuple[Mesh, ...], ...]:
    """Pairs that hang together by links that move."""
    groups: list[tuple[set[str], list[Mesh]]] = []
    for mesh in meshes:
        links, members = set(mesh.links) - {ground}, [mesh]
        for other in [g for g in groups if g[0] & links]:
            groups.remove(other)
            links |= other[0]
            members = other[1] + members
        groups.append((links, members))
    return tuple(tuple(members) for _, members in groups)


def centre_lines(train: Iterable[Mesh], links: Mapping[str, PlacedLink], ground: str) -> tuple[CentreLine, ...]:
    """The lines on which the axes of a train are laid.

    Parameters
    ----------
    train : pairs that roll
    links : with the points of the carriers in their own axes (m)
    ground : the frame's name
    """
    made: list[tuple[dict[str, float], list[Mesh]]] = []
    left = list(train)
    while left:
        # the train is followed from pair to pair, so that a line reaches as far as it can
        mesh = next((m for m in left if made and any(p in made[-1][0] for p in m.axes)), left[0])
        left.remove(mesh)
        for heights, members in made:
            if any(p in heights for p in mesh.axes) and _laid(mesh, heights, members, links):
                members.append(mesh)
                break
        else:
            fixed = [p for p in mesh.axes if p in links[ground].points]
            heights = {(*fixed, mesh.axes[0])[0]: 0.0}
            _laid(mesh, heights, [], links)
            made.append((heights, [mesh]))
    return tuple(_line(members, heights, links, ground) for heights, members in made)


def _apart(mesh: Mesh, links: Mapping[str, PlacedLink]) -> float:
    held = links[mesh.carrier].points
    return abs(held[mesh.axes[1]] - held[mesh.axes[0]])


def _laid(
    mesh: Mesh, heights: dict[str, float], members: Sequence[Mesh], links: Mapping[str, PlacedLink]
) -> bool:
    """Lay a pair's axes on a line where they fit; False where they stand there at other distances."""
    one, two = mesh.axes
    if not two:
        return one in heights
    far = _apart(mesh, links)
    if one in heights and two in heights:
        return abs(abs(heights[two] - heights[one]) - far) <= ALIKE * far
    known, new = (one, two) if one in heights else (two, one)
    held = links[mesh.carrier].points
    way = 1.0
    others = [p for p in heights if p != known and p in held and held[p] != held[known]]
    if others:
        # a carrier that is straight stays so
        near = others[0]
        up = held[near] - held[known]
        sense = 1.0 if heights[near] > heights[known] else -1.0
        along = dot(held[new] - held[known], up) / abs(up)
        straight = abs(cross(held[new] - held[known], up)) <= ALIKE * abs(up) * far
        way = sense * (1.0 if along > 0 else -1.0) if straight else -sense
    elif members:
        near_height = next((h for p, h in heights.items() if p != known and h != heights[known]), None)
        way = -1.0 if near_height is not None and near_height > heights[known] else 1.0
    heights[new] = heights[known] + way * far
    return True


def _line(
    members: Sequence[Mesh], heights: Mapping[str, float], links: Mapping[str, PlacedLink], ground: str
) -> CentreLine:
    at: dict[str, dict[str, None]] = {}
    spots = []
    for mesh in members:
        one, two = mesh.axes
        at.setdefault(one, {}).update(dict.fromkeys((mesh.wheels[0], mesh.carrier)))
        part, rest = mesh.parts
        if rest is None:
            height = heights[one] + float(part)
        else:
            at.setdefault(two, {}).update(dict.fromkeys((mesh.wheels[1], mesh.carrier)))
            height = heights[one] + (heights[two] - heights[one]) * float(part / (part + rest))
        spots.append(Spot(mesh.name, height, mesh.wheels, True))
    axes = [Spot(p, heights[p], tuple(names), False) for p, names in at.items()]
    every = (*axes, *spots)
    fixed = [s for s in every if ground in s.links]
    if not fixed:
        fixed = [s for s in axes if s.name in links[ground].points]
    start = fixed[0] if fixed else axes[0]
    return CentreLine(tuple(members), every, start.name, bool(fixed))


@dataclass(frozen=True)
class PlanScales:
    """What 1 mm of a plan is: m, m/s (m/s2), rad/s (rad/s2); and how far the pole stands from the rate scale (mm)."""

    length: float
    speed: float
    rate: float

    @property
    def pole(self) -> float:
        return self.speed / self.length / self.rate


@dataclass(frozen=True)
class PlanLine:
    """The line of a link over the line of centres ``on`` (its number).

    by : the names of the places that give it: two, or one and the rate (``rate_known``); of a link that slides along
        ``beside`` the line is parallel to that one's
    ends : its lowest and its highest place (mm; velocity to the right, height upwards)
    foot : what it marks off on the rate scale, as read (mm), counter-clockwise to the right
    rate : what that says (rad/s, rad/s2)
    """

    link: str
    on: int
    by: tuple[str, ...]
    rate_known: bool
    ends: tuple[complex, complex]
    foot: float
    rate: float
    beside: str = ""
    trial: bool = False


@dataclass(frozen=True)
class PlanTrial:
    """Rates that were assumed, by link: the values of each trial, what each left open (mm), and what follows."""

    links: tuple[str, ...]
    assumed: tuple[tuple[float, ...], ...]
    apart: tuple[tuple[float, ...], ...]
    found: tuple[float, ...]


@dataclass(frozen=True)
class TrainPlan:
    """A plan as drawn.  ``velocities`` (mm) are those of the places, by line of centres and place; ``travels`` of the
    racks (m/s, m/s2) by sliding pair, with the length read (mm)."""

    order: str
    scales: PlanScales
    on: tuple[CentreLine, ...]
    lines: tuple[PlanLine, ...]
    velocities: Mapping[tuple[int, str], float]
    travels: Mapping[str, tuple[float, float]]
    trial: PlanTrial | None = None

    def line(self, link: str) -> PlanLine | None:
        """The line of a link from which its rate is read, else its first."""
        own = [one for one in self.lines if one.link == link]
        return next((one for one in own if not one.rate_known), own[0] if own else None)
