"""What closes a group that compass and ruler cannot draw: one bar, block or driver that is left out, and must fit."""

from __future__ import annotations

import cmath
from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.drafting.sheet import Pose
from graphkin.plane import cross, dot
from graphkin.scene.model import AngleDriver, Driver, SlideDriver
from graphkin.structure import Slide, Structure

__all__ = ["Closing", "Moved"]


@dataclass(frozen=True)
class Moved:
    """A link on paper and how it moves: its pose, the velocity (mm/s) of its origin, its angular velocity."""

    pose: Pose
    velocity: complex
    omega: float

    def at(self, z: complex) -> complex:
        """Velocity of the point of the link that lies at z."""
        return self.velocity + 1j * self.omega * (z - self.pose.origin)


@dataclass(frozen=True)
class Closing:
    """A constraint left out: ``left_out`` names the bar, block or driver; ``ends`` are (point, link) of a bar's two
    hinges, or of a block's one; ``slide`` is the sliding pair of a block or a driven slide."""

    left_out: str
    ends: tuple[tuple[str, str], ...] = ()
    slide: Slide | None = None
    driver: Driver | None = None

    @property
    def links(self) -> tuple[str, ...]:
        """The links between which it stood."""
        names = [link for _, link in self.ends]
        if self.slide is not None:
            names += [n for n in (self.slide.a, self.slide.b) if n != self.left_out]
        if isinstance(self.driver, AngleDriver):
            names += [self.driver.link, self.driver.relative_to]
        return tuple(dict.fromkeys(names))

    def gap(
        self, structure: Structure, poses: Mapping[str, Pose], mm: float, values: Mapping[str, float]
    ) -> float:
        """By how much it does not fit: mm of paper, or rad for a driven angle; ``values`` are those of the drivers."""
        if isinstance(self.driver, AngleDriver):
            turn = poses[self.driver.link].axis / poses[self.driver.relative_to].axis
            return cmath.phase(turn * cmath.rect(1.0, -values[self.driver.key]))
        if isinstance(self.driver, SlideDriver):
            start, along, origin = self._rail(structure, poses, mm)
            return dot(along, origin - start) - values[self.driver.key] * mm
        at = [_place(structure, poses, mm, *end) for end in self.ends]
        if self.slide is None:
            points = structure.links[self.left_out].points
            return abs(at[1] - at[0]) - abs(points[self.ends[1][0]] - points[self.ends[0][0]]) * mm
        start, along, _ = self._rail(structure, poses, mm)
        return cross(along, at[0] - start) - self._offset(structure) * mm

    def rate(self, structure: Structure, moved: Mapping[str, Moved], mm: float) -> float:
        """How fast it comes not to fit: mm/s on paper, or rad/s."""
        poses = {name: m.pose for name, m in moved.items()}
        if isinstance(self.driver, AngleDriver):
            return moved[self.driver.link].omega - moved[self.driver.relative_to].omega - self.driver.omega
        if isinstance(self.driver, SlideDriver):
            assert self.slide is not None
            _, along, origin = self._rail(structure, poses, mm)
            slip = moved[self.slide.a].at(origin) - moved[self.slide.b].at(origin)
            return dot(along, slip) - self.driver.velocity * mm
        at = [_place(structure, poses, mm, *end) for end in self.ends]
        speed = [moved[link].at(z) for (_, link), z in zip(self.ends, at, strict=True)]
        if self.slide is None:
            return dot(at[1] - at[0], speed[1] - speed[0]) / abs(at[1] - at[0])
        _, along, _ = self._rail(structure, poses, mm)
        other = self.slide.b if self.slide.a == self.left_out else self.slide.a
        return cross(along, speed[0] - moved[other].at(at[0]))

    def put_back(self, structure: Structure, moved: Mapping[str, Moved], mm: float) -> Moved | None:
        """The link left out, where it fits; None where a driver was left out."""
        if not self.ends:
            return None
        poses = {name: m.pose for name, m in moved.items()}
        at = [_place(structure, poses, mm, *end) for end in self.ends]
        own = [structure.links[self.left_out].points[point] * mm for point, _ in self.ends]
        speed = moved[self.ends[0][1]].at(at[0])
        if self.slide is None:
            axis = (at[1] - at[0]) / (own[1] - own[0])
            axis /= abs(axis)
            span = at[1] - at[0]
            omega = cross(span, moved[self.ends[1][1]].at(at[1]) - speed) / abs(span) ** 2
        else:
            s = self.slide
            other = s.b if s.a == self.left_out else s.a
            turn = s.guide.direction * s.turn
            axis = poses[other].axis * (turn if s.a == self.left_out else turn.conjugate())
            omega = moved[other].omega
        pose = Pose(at[0] - axis * own[0], axis)
        return Moved(pose, speed - 1j * omega * axis * own[0], omega)

    def _rail(self, structure: Structure, poses: Mapping[str, Pose], mm: float) -> tuple[complex, complex, complex]:
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

    def _offset(self, structure: Structure) -> float:
        """Distance (m) of a block's hinge from the guide, to its left."""
        s = self.slide
        assert s is not None
        hinge = structure.links[self.left_out].points[self.ends[0][0]]
        if s.a == self.left_out:
            return (s.turn * hinge).imag
        return cross(s.guide.direction, hinge - s.guide.through)


def _place(structure: Structure, poses: Mapping[str, Pose], mm: float, point: str, link: str) -> complex:
    pose = poses[link]
    return pose.origin + pose.axis * structure.links[link].points[point] * mm
