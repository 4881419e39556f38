"""What is removed from a group so that dyads are left, by how much it does not fit, and where it lies when it fits."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.construction.links_on_paper import Poses
from graphkin.construction.sheet import Pose
from graphkin.plane import cross, cross_lines, dot
from graphkin.scene.model import AngleDriver, AnyDriver, PlacedLink, SlideDriver
from graphkin.structure import RollingRelation, Slide

__all__ = ["RemovedConstraint"]


@dataclass(frozen=True)
class RemovedConstraint:
    """A constraint removed from a group.

    ``left_out`` names the bar or block, "" for a driver and for rolling; ``ends`` are (point, link) of a bar's two
    hinges, or of a block's one; ``slide`` is the sliding pair of a block, of a driven slide or of what rolls along it,
    ``second`` the other one of a link that slides on two; ``rolling`` is what rolled.
    """

    left_out: str
    ends: tuple[tuple[str, str], ...] = ()
    slide: Slide | None = None
    second: Slide | None = None
    driver: AnyDriver | None = None
    rolling: RollingRelation | None = None

    @property
    def name(self) -> str:
        """Of the bar or block, of the driver, or of the contact or the wheels that roll."""
        if self.rolling is not None:
            return self.rolling.name
        return self.left_out or (self.driver.key if self.driver else "")

    @property
    def links(self) -> tuple[str, ...]:
        """The links between which it stood."""
        names = [link for _, link in self.ends]
        for slide in (self.slide, self.second):
            if slide is not None:
                names += [n for n in (slide.a, slide.b) if n != self.left_out]
        if isinstance(self.driver, AngleDriver):
            names += [self.driver.link, self.driver.relative_to]
        if self.rolling is not None:
            names += self.rolling.links
        return tuple(dict.fromkeys(names))

    @property
    def is_angle(self) -> bool:
        """Whether its gap is an angle (rad), not a length (mm)."""
        if self.rolling is not None:
            return not self.rolling.in_lengths
        return isinstance(self.driver, AngleDriver) or self.second is not None

    def gap(self, links: Mapping[str, PlacedLink], poses: Poses, mm: float, values: Mapping[str, float]) -> float:
        """By how much it does not fit: mm of paper, or rad for a driven angle; ``values`` are those of the drivers, and
        of what rolls those at a position within half a turn (rad, m), by the name of the coordinate."""
        if self.rolling is not None:
            return self._rolled_off(poses, mm, values)
        if isinstance(self.driver, AngleDriver):
            turn = poses[self.driver.link].axis / poses[self.driver.relative_to].axis
            return cmath.phase(turn * cmath.rect(1.0, -values[self.driver.key]))
        if isinstance(self.driver, SlideDriver):
            start, along, origin = self._rail(poses, mm)
            return dot(along, origin - start) - values[self.driver.key] * mm
        if self.second is not None:
            return cmath.phase(self._turned(poses, self.second) / self._turned(poses, self.slide))
        at = [_place(links, poses, mm, *end) for end in self.ends]
        if self.slide is None:
            points = links[self.left_out].points
            return abs(at[1] - at[0]) - abs(points[self.ends[1][0]] - points[self.ends[0][0]]) * mm
        start, along, _ = self._rail(poses, mm)
        return cross(along, at[0] - start) - self._offset(links) * mm

    def coordinates(self, poses: Poses, mm: float) -> dict[str, float]:
        """The angles within a turn and the travel of what rolls (rad, m), by the names of the coordinates."""
        found = {}
        for kind, name in self.rolling.terms if self.rolling is not None else ():
            if kind == "angle":
                found[f"{kind} {name}"] = cmath.phase(poses[name].axis)
            else:
                start, along, origin = self._rail(poses, mm)
                found[f"{kind} {name}"] = dot(along, origin - start) / mm
        return found

    def _rolled_off(self, poses: Poses, mm: float, values: Mapping[str, float]) -> float:
        """By how much the sum that rolling keeps is another: mm of paper, or rad of the wheel that turns least."""
        assert self.rolling is not None
        gap, here = 0.0, self.coordinates(poses, mm)
        for (kind, name), weight in self.rolling.weights(1.0).items():
            moved = here[f"{kind} {name}"] - values[f"{kind} {name}"]
            gap += weight * (math.remainder(moved, math.tau) if kind == "angle" else moved)
        return gap * mm if self.rolling.in_lengths else gap

    def placed(self, links: Mapping[str, PlacedLink], poses: Poses, mm: float) -> Pose | None:
        """Where the link left out lies, where it fits; None where a driver was left out."""
        if self.second is not None and self.slide is not None:
            axis = self._turned(poses, self.slide)
            p, d = self._track(poses, self.slide, axis, mm)
            q, e = self._track(poses, self.second, axis, mm)
            at_both = cross_lines(p, d, q, e)
            return None if at_both is None else Pose(at_both, axis)
        if not self.ends:
            return None
        at = [_place(links, poses, mm, *end) for end in self.ends]
        own = [links[self.left_out].points[point] * mm for point, _ in self.ends]
        if self.slide is None:
            axis = (at[1] - at[0]) / (own[1] - own[0])
            axis /= abs(axis)
        else:
            axis = self._turned(poses, self.slide)
        return Pose(at[0] - axis * own[0], axis)

    @property
    def other_side(self) -> str:
        """The link on which a block left out slides, or that slides on it."""
        assert self.slide is not None
        return self.slide.b if self.slide.a == self.left_out else self.slide.a

    @property
    def turned(self) -> float:
        """By how much (rad) a block left out is turned from the link on its other side, always."""
        assert self.slide is not None
        turn = cmath.phase(self.slide.guide.direction * self.slide.turn)
        return turn if self.slide.a == self.left_out else -turn

    def along(self, poses: Poses) -> complex:
        """Direction of the guide of a block left out."""
        assert self.slide is not None
        if self.slide.b != self.left_out:
            return poses[self.slide.b].axis * self.slide.guide.direction
        return poses[self.slide.a].axis * self.slide.turn.conjugate()

    def _turned(self, poses: Poses, slide: Slide | None) -> complex:
        """Direction of the link left out, from the link on which it slides or that slides on it."""
        assert slide is not None
        turn = slide.guide.direction * slide.turn
        if slide.a == self.left_out:
            return poses[slide.b].axis * turn
        return poses[slide.a].axis * turn.conjugate()

    def _track(self, poses: Poses, slide: Slide, axis: complex, mm: float) -> tuple[complex, complex]:
        """The line on which the origin of the link left out lies by a sliding pair."""
        if slide.a == self.left_out:
            rail = poses[slide.b]
            return rail.origin + rail.axis * slide.guide.through * mm, rail.axis * slide.guide.direction
        return poses[slide.a].origin - axis * slide.guide.through * mm, axis * slide.guide.direction

    def _rail(self, poses: Poses, mm: float) -> tuple[complex, complex, complex]:
        """A point of the guide, its direction, and the sliding link's origin (or the hinge of a block left out)."""
        s = self.slide
        assert s is not None
        if s.b != self.left_out:
            rail = poses[s.b]
            start = rail.origin + rail.axis * s.guide.through * mm
            along = rail.axis * s.guide.direction
            return start, along, poses[s.a].origin if s.a in poses and s.a != self.left_out else start
        along = poses[s.a].axis * s.turn.conjugate()
        return poses[s.a].origin, along, poses[s.a].origin

    def _offset(self, links: Mapping[str, PlacedLink]) -> float:
        """Distance (m) of a block's hinge from the guide, to its left."""
        s = self.slide
        assert s is not None
        hinge = links[self.left_out].points[self.ends[0][0]]
        if s.a == self.left_out:
            return (s.turn * hinge).imag
        return cross(s.guide.direction, hinge - s.guide.through)


def _place(links: Mapping[str, PlacedLink], poses: Poses, mm: float, point: str, link: str) -> complex:
    pose = poses[link]
    return pose.origin + pose.axis * links[link].points[point] * mm
