"""Links on paper, and how hands prick and place them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from graphkin.drafting.instrument import EXACT, Instrument
from graphkin.drafting.sheet import Pose
from graphkin.plane import unit
from graphkin.scene.model import Link

__all__ = ["Frame"]


@dataclass
class Frame:
    """Links on paper: their shapes at the length scale, the driver values, and where the known ones lie."""

    links: Mapping[str, Link]
    mm: float  # of paper for one m
    values: Mapping[str, float]  # drivers, rad or m
    poses: dict[str, Pose] = field(default_factory=dict)
    instrument: Instrument = EXACT
    pricked: dict[str, complex] = field(default_factory=dict)  # points as they came to lie, where hands err

    def place(self, link: str, local: complex) -> complex:
        """A place given in a link's own axes (m), on paper."""
        pose = self.poses[link]
        return pose.origin + pose.axis * (local * self.mm)

    def point(self, link: str, point: str) -> complex:
        if point in self.pricked:
            return self.pricked[point]
        return self.place(link, self.links[link].points[point])

    def settle(self, names: Sequence[str]) -> None:
        """Prick the new points of links just placed, and let the links lie as their points came out."""
        if self.instrument.faultless:
            return
        for name in names:
            link, pose = self.links[name], self.poses[name]
            known = [p for p in link.points if p in self.pricked]
            for point in link.points:
                if point not in self.pricked:
                    lies = self._settled(name, pose, known)
                    self.pricked[point] = self.instrument.point(lies.origin + lies.axis * link.points[point] * self.mm)
                    known.append(point)
            self.poses[name] = self._settled(name, pose, known)

    def _settled(self, name: str, pose: Pose, known: Sequence[str]) -> Pose:
        """A link as two of its points on paper hold it, the farthest apart; by one point with the direction drawn."""
        link = self.links[name]
        if not known:
            return pose
        a, b = max(((a, b) for a in known for b in known), key=lambda ab: abs(link.points[ab[0]] - link.points[ab[1]]))
        span = link.points[b] - link.points[a]
        axis = unit((self.pricked[b] - self.pricked[a]) / span) if abs(span) * self.mm > 1.0 else pose.axis
        return Pose(self.pricked[a] - axis * (link.points[a] * self.mm), axis)
