"""What closes a group that compass and ruler cannot draw: one bar, block or driver that is left out, and must fit.

Mechanisms of dyads that stand in for one with a larger group.

With one bar, block or driver left out (see `closing`) and one link of the group driven in its stead, every group is a
dyad and can be drawn; the right value of this trial driver is that at which what was left out fits (method of trial
positions; Hain, Applied Kinematics; 试凑法).
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from graphkin.construction.rigid import Frame
from graphkin.construction.sheet import Pose
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, dot
from graphkin.scene.model import AngleDriver, Driver, Scene, SlideDriver
from graphkin.scene.symbol import Symbol
from graphkin.structure import Cluster, Driven, Dyad, Slide, Structure, Turn, analyse, links_of, needed

__all__ = ["Closing", "Moved", "StandIn", "clusters", "stand_ins"]


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

    def gap(self, structure: Structure, poses: Mapping[str, Pose], mm: float, values: Mapping[str, float]) -> float:
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


@dataclass(frozen=True)
class StandIn:
    """A mechanism of one larger group less.

    ``closing`` is left out of it, ``driver`` is the key of the trial driver; ``elements`` are those that place the
    links of the group, in the order of drawing.
    """

    scene: Scene
    structure: Structure
    closing: Closing
    driver: str
    cluster: Cluster
    elements: tuple[Driven | Dyad, ...]

    def gap(self, frame: Frame) -> float:
        """By how much what was left out does not fit."""
        return self.closing.gap(self._whole(frame), frame.poses, frame.mm, frame.values)

    def put_back(self, frame: Frame) -> dict[str, Pose]:
        """The group's links where they lie, the one left out among them."""
        still = {name: Moved(pose, 0j, 0.0) for name, pose in frame.poses.items()}
        back = self.closing.put_back(self._whole(frame), still, frame.mm)
        group = {name: pose for name, pose in frame.poses.items() if name in self.cluster.members}
        return group if back is None else {**group, self.closing.left_out: back.pose}

    def opened(self, known: Frame, value: float) -> Frame:
        """The board before the group is drawn, the trial driver at a value."""
        return Frame(known.links, known.mm, {**known.values, self.driver: value}, dict(known.poses))

    def value(self, poses: Mapping[str, Pose], mm: float) -> tuple[complex | None, float]:
        """The trial driver's value in a position: the direction of a turned link, or the travel (m)."""
        driver = next(d for d in self.scene.drivers if d.key == self.driver)
        if isinstance(driver, AngleDriver):
            return poses[driver.link].axis / poses[driver.relative_to].axis, 0.0
        slide = self.structure.slide(driver.key)
        rail = poses[slide.b]
        start = rail.origin + rail.axis * slide.guide.through * mm
        return None, dot(rail.axis * slide.guide.direction, poses[slide.a].origin - start) / mm

    def _whole(self, frame: Frame) -> Structure:
        """The structure in which the link left out still has its points."""
        return replace(self.structure, links=frame.links)


def clusters(structure: Structure) -> list[Cluster]:
    """The larger groups, in the order of solution."""
    return [e for e in structure.elements if isinstance(e, Cluster)]


def stand_ins(scene: Scene, cluster: Cluster) -> list[StandIn]:
    """All ways to replace a larger group of a scene by dyads; the trial driver stands at value and rate 0.

    Raises
    ------
    Unsolvable : "not drawn": nothing can be left out so that only dyads remain
    """
    # earlier larger groups are known when this one is drawn: any stand-in does for them
    while (first := clusters(analyse(scene))[0]).members != cluster.members:
        scene = stand_ins(scene, first)[0].scene
    structure = analyse(scene)
    found = list(_stand_ins(scene, structure, cluster))
    if not found:
        names = ", ".join(cluster.links)
        raise Unsolvable("not drawn", Problem(f"links {names}", "nothing can be left out so that only dyads remain"))
    return found


def _stand_ins(scene: Scene, structure: Structure, cluster: Cluster) -> Iterator[StandIn]:
    for closing in _closings(structure, cluster):
        opened = _opened(scene, closing)
        for trial in _trials(structure, cluster, closing):
            candidate = replace(opened, drivers=(*opened.drivers, trial))
            try:
                dyads = analyse(candidate)
            except Unsolvable:
                continue
            wanted = [*closing.links, *(m for m in cluster.members if m != closing.left_out)]
            way = needed(dyads, [Symbol("omega", link=n) for n in dict.fromkeys(wanted)])
            inside = [e for e in way if set(links_of(e)) & set(cluster.members)]
            drawn = tuple(e for e in inside if isinstance(e, Driven | Dyad))
            if len(drawn) == len(inside):
                yield StandIn(candidate, dyads, closing, trial.key, cluster, drawn)


def _closings(structure: Structure, cluster: Cluster) -> Iterator[Closing]:
    for driver in cluster.drivers:
        if isinstance(driver, AngleDriver):
            yield Closing("", driver=driver)
        else:
            yield Closing("", slide=structure.slide(driver.key), driver=driver)
    driven = {n for d in structure.scene.drivers if isinstance(d, AngleDriver) for n in (d.link, d.relative_to)}
    for name in cluster.members:
        hinges = [p for p, names in structure.hinges.items() if name in names]
        slides = [s for s in structure.slides if name in (s.a, s.b)]
        if name in driven or any(s.key == d.key for d in structure.scene.drivers for s in slides):
            continue
        ends = tuple((p, next(n for n in structure.hinges[p] if n != name)) for p in hinges)
        if len(hinges) == 2 and not slides:
            yield Closing(name, ends)
        elif len(hinges) == 1 and len(slides) == 1:
            yield Closing(name, ends, slides[0])


def _opened(scene: Scene, closing: Closing) -> Scene:
    """The scene without what closes its group, everything known of its place kept as a sketch."""
    gone = closing.left_out
    return replace(
        scene,
        links=tuple(link for link in scene.links if link.name != gone),
        slidings=tuple(s for s in scene.slidings if gone not in (s.link, s.on)),
        pins=tuple(p for p in scene.pins if p.key != gone and gone not in (p.of, p.on)),
        drivers=tuple(d for d in scene.drivers if d != closing.driver),
        sketch={**scene.sketch, **scene.drawn},
        drawn={},
        find=(),
        printed={},
    )


def _trials(structure: Structure, cluster: Cluster, closing: Closing) -> Iterator[Driver]:
    """Drivers that can stand in: at a turning or sliding pair of the group that is not driven and not left out."""
    driven = {d.key for d in structure.scene.drivers}
    blocks = {s.key for s in structure.slides if s.slot}
    for pair in cluster.pairs:
        if closing.left_out in (pair.a, pair.b):
            continue
        if isinstance(pair, Turn):
            if pair.a not in driven and not {pair.a, pair.b} & blocks:
                yield AngleDriver(pair.a, pair.b, 0.0, 0.0, 0.0)
        elif pair.key not in driven:
            yield SlideDriver(pair.key, 0.0, 0.0, 0.0)
