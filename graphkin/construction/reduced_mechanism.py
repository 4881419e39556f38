"""Mechanisms of dyads in place of one with a larger group, which compass and ruler cannot draw.

With one constraint of the group removed (a bar, a block or a driver) and one link of it driven in its stead, every
group is a dyad and can be drawn; the right value of this trial driver is that at which what was removed fits (method of
trial positions; Hain, Applied Kinematics; 试凑法).
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from graphkin.construction.rigid import LinkMotion, PlacedLinks, Poses
from graphkin.construction.sheet import Pose
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, dot
from graphkin.scene.model import AngleDriver, AnyDriver, Mechanism, PlacedLink, SlideDriver
from graphkin.scene.symbol import Symbol
from graphkin.structure import Cluster, Driven, Dyad, Slide, Structure, Turn, analyse, links_of, needed

__all__ = ["ReducedMechanism", "RemovedConstraint", "clusters", "reduced_mechanisms"]


@dataclass(frozen=True)
class RemovedConstraint:
    """A constraint removed from a group.

    ``left_out`` names the bar or block, "" for a driver; ``ends`` are (point, link) of a bar's two hinges, or of a
    block's one; ``slide`` is the sliding pair of a block or a driven slide.
    """

    left_out: str
    ends: tuple[tuple[str, str], ...] = ()
    slide: Slide | None = None
    driver: AnyDriver | None = None

    @property
    def links(self) -> tuple[str, ...]:
        """The links between which it stood."""
        names = [link for _, link in self.ends]
        if self.slide is not None:
            names += [n for n in (self.slide.a, self.slide.b) if n != self.left_out]
        if isinstance(self.driver, AngleDriver):
            names += [self.driver.link, self.driver.relative_to]
        return tuple(dict.fromkeys(names))

    def gap(self, links: Mapping[str, PlacedLink], poses: Poses, mm: float, values: Mapping[str, float]) -> float:
        """By how much it does not fit: mm of paper, or rad for a driven angle; ``values`` are those of the drivers."""
        if isinstance(self.driver, AngleDriver):
            turn = poses[self.driver.link].axis / poses[self.driver.relative_to].axis
            return cmath.phase(turn * cmath.rect(1.0, -values[self.driver.key]))
        if isinstance(self.driver, SlideDriver):
            start, along, origin = self._rail(poses, mm)
            return dot(along, origin - start) - values[self.driver.key] * mm
        at = [_place(links, poses, mm, *end) for end in self.ends]
        if self.slide is None:
            points = links[self.left_out].points
            return abs(at[1] - at[0]) - abs(points[self.ends[1][0]] - points[self.ends[0][0]]) * mm
        start, along, _ = self._rail(poses, mm)
        return cross(along, at[0] - start) - self._offset(links) * mm

    def rate(
        self, links: Mapping[str, PlacedLink], poses: Poses, motions: Mapping[str, LinkMotion], mm: float
    ) -> float:
        """How fast it comes not to fit: mm/s on paper, or rad/s."""
        if isinstance(self.driver, AngleDriver):
            return motions[self.driver.link].omega - motions[self.driver.relative_to].omega - self.driver.omega
        if isinstance(self.driver, SlideDriver):
            assert self.slide is not None
            _, along, origin = self._rail(poses, mm)
            slip = motions[self.slide.a].of(origin) - motions[self.slide.b].of(origin)
            return dot(along, slip) - self.driver.velocity * mm
        at = [_place(links, poses, mm, *end) for end in self.ends]
        speed = [motions[link].of(z) for (_, link), z in zip(self.ends, at, strict=True)]
        if self.slide is None:
            return dot(at[1] - at[0], speed[1] - speed[0]) / abs(at[1] - at[0])
        _, along, _ = self._rail(poses, mm)
        return cross(along, speed[0] - motions[self._other_side].of(at[0]))

    def placed(self, links: Mapping[str, PlacedLink], poses: Poses, mm: float) -> Pose | None:
        """Where the link left out lies, where it fits; None where a driver was left out."""
        if not self.ends:
            return None
        at = [_place(links, poses, mm, *end) for end in self.ends]
        own = [links[self.left_out].points[point] * mm for point, _ in self.ends]
        if self.slide is None:
            axis = (at[1] - at[0]) / (own[1] - own[0])
            axis /= abs(axis)
        else:
            turn = self.slide.guide.direction * self.slide.turn
            axis = poses[self._other_side].axis * (turn if self.slide.a == self.left_out else turn.conjugate())
        return Pose(at[0] - axis * own[0], axis)

    def moving(
        self, links: Mapping[str, PlacedLink], poses: Poses, motions: Mapping[str, LinkMotion], mm: float
    ) -> LinkMotion:
        """How the link left out moves, from the links that hold it."""
        at = [_place(links, poses, mm, *end) for end in self.ends]
        speed = motions[self.ends[0][1]].of(at[0])
        if self.slide is not None:
            return LinkMotion(at[0], speed, motions[self._other_side].omega)
        span = at[1] - at[0]
        return LinkMotion(at[0], speed, cross(span, motions[self.ends[1][1]].of(at[1]) - speed) / abs(span) ** 2)

    @property
    def _other_side(self) -> str:
        """The link on which a block left out slides, or that slides on it."""
        assert self.slide is not None
        return self.slide.b if self.slide.a == self.left_out else self.slide.a

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


@dataclass(frozen=True)
class ReducedMechanism:
    """A mechanism of one larger group less.

    ``removed`` is left out of it, ``driver`` is the key of the trial driver; ``elements`` are those that place the
    links of the group, in the order of drawing.
    """

    scene: Mechanism
    structure: Structure
    removed: RemovedConstraint
    driver: str
    cluster: Cluster
    elements: tuple[Driven | Dyad, ...]

    def gap(self, frame: PlacedLinks) -> float:
        """By how much what was left out does not fit."""
        return self.removed.gap(frame.links, frame.poses, frame.mm, frame.values)

    def put_back(self, frame: PlacedLinks) -> dict[str, Pose]:
        """The group's links where they lie, the one left out among them."""
        group = {name: pose for name, pose in frame.poses.items() if name in self.cluster.members}
        back = self.removed.placed(frame.links, frame.poses, frame.mm)
        return group if back is None else {**group, self.removed.left_out: back}

    def opened(self, known: PlacedLinks, value: float) -> PlacedLinks:
        """The board before the group is drawn, the trial driver at a value."""
        return PlacedLinks(known.links, known.mm, {**known.values, self.driver: value}, dict(known.poses))

    def value(self, poses: Mapping[str, Pose], mm: float) -> tuple[complex | None, float]:
        """The trial driver's value in a position: the direction of a turned link, or the travel (m)."""
        driver = next(d for d in self.scene.drivers if d.key == self.driver)
        if isinstance(driver, AngleDriver):
            return poses[driver.link].axis / poses[driver.relative_to].axis, 0.0
        slide = self.structure.slide(driver.key)
        rail = poses[slide.b]
        start = rail.origin + rail.axis * slide.guide.through * mm
        return None, dot(rail.axis * slide.guide.direction, poses[slide.a].origin - start) / mm


def clusters(structure: Structure) -> list[Cluster]:
    """The larger groups, in the order of solution."""
    return [e for e in structure.elements if isinstance(e, Cluster)]


def reduced_mechanisms(scene: Mechanism, cluster: Cluster) -> list[ReducedMechanism]:
    """All ways to replace a larger group of a scene by dyads; the trial driver choices at value and rate 0.

    Raises
    ------
    Unsolvable : "not drawn": nothing can be left out so that only dyads remain
    """
    # earlier larger groups are known when this one is drawn: any reduction does for them
    while (first := clusters(analyse(scene))[0]).members != cluster.members:
        scene = reduced_mechanisms(scene, first)[0].scene
    structure = analyse(scene)
    found = list(_reduced(scene, structure, cluster))
    if not found:
        names = ", ".join(cluster.links)
        raise Unsolvable("not drawn", Problem(f"links {names}", "nothing can be left out so that only dyads remain"))
    return found


def _reduced(scene: Mechanism, structure: Structure, cluster: Cluster) -> Iterator[ReducedMechanism]:
    for removed in _removable(structure, cluster):
        opened = _opened(scene, removed)
        for trial in _trials(structure, cluster, removed):
            candidate = replace(opened, drivers=(*opened.drivers, trial))
            try:
                dyads = analyse(candidate)
            except Unsolvable:
                continue
            wanted = [*removed.links, *(m for m in cluster.members if m != removed.left_out)]
            way = needed(dyads, [Symbol("omega", link=n) for n in dict.fromkeys(wanted)])
            inside = [e for e in way if set(links_of(e)) & set(cluster.members)]
            drawn = tuple(e for e in inside if isinstance(e, Driven | Dyad))
            if len(drawn) == len(inside):
                yield ReducedMechanism(candidate, dyads, removed, trial.key, cluster, drawn)


def _removable(structure: Structure, cluster: Cluster) -> Iterator[RemovedConstraint]:
    for driver in cluster.drivers:
        if isinstance(driver, AngleDriver):
            yield RemovedConstraint("", driver=driver)
        else:
            yield RemovedConstraint("", slide=structure.slide(driver.key), driver=driver)
    driven = {n for d in structure.scene.drivers if isinstance(d, AngleDriver) for n in (d.link, d.relative_to)}
    for name in cluster.members:
        hinges = [p for p, names in structure.hinges.items() if name in names]
        slides = [s for s in structure.slides if name in (s.a, s.b)]
        if name in driven or any(s.key == d.key for d in structure.scene.drivers for s in slides):
            continue
        ends = tuple((p, next(n for n in structure.hinges[p] if n != name)) for p in hinges)
        if len(hinges) == 2 and not slides:
            yield RemovedConstraint(name, ends)
        elif len(hinges) == 1 and len(slides) == 1:
            yield RemovedConstraint(name, ends, slides[0])


def _opened(scene: Mechanism, removed: RemovedConstraint) -> Mechanism:
    """The scene without a constraint of its group, everything known of its place kept as a sketch."""
    gone = removed.left_out
    return replace(
        scene,
        links=tuple(link for link in scene.links if link.name != gone),
        slidings=tuple(s for s in scene.slidings if gone not in (s.link, s.on)),
        pins=tuple(p for p in scene.pins if p.key != gone and gone not in (p.of, p.on)),
        drivers=tuple(d for d in scene.drivers if d != removed.driver),
        sketch={**scene.sketch, **scene.drawn},
        drawn={},
        find=(),
        printed={},
    )


def _trials(structure: Structure, cluster: Cluster, removed: RemovedConstraint) -> Iterator[AnyDriver]:
    """Drivers that can take its place: at a pair of the group that is not driven and not left out."""
    driven = {d.key for d in structure.scene.drivers}
    blocks = {s.key for s in structure.slides if s.slot}
    for pair in cluster.pairs:
        if removed.left_out in (pair.a, pair.b):
            continue
        if isinstance(pair, Turn):
            if pair.a not in driven and not {pair.a, pair.b} & blocks:
                yield AngleDriver(pair.a, pair.b, 0.0, 0.0, 0.0)
        elif pair.key not in driven:
            yield SlideDriver(pair.key, 0.0, 0.0, 0.0)
