"""Mechanisms of dyads in place of one with a larger group, which compass and ruler cannot draw.

With constraints of the group removed (bars, blocks or drivers) and as many trial drivers in their stead, every part is
a dyad and can be drawn; the right values of the trial drivers are those at which what was removed fits (method of trial
positions; Hain, Applied Kinematics; 试凑法).  The fewest constraints that do are removed.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations

from graphkin.construction.links_on_paper import PlacedLinks, Pose, Poses, across, reading, travel
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, cross_lines, unit
from graphkin.scene.model import Driver, Mechanism, PlacedLink
from graphkin.structure import Driven, Dyad, LargerGroup, Pair, RollingRelation, Structure, regrouped, unrolled
from graphkin.words import Phrase

__all__ = ["ReducedMechanism", "RemovedConstraint", "reduced_mechanisms"]

MOST_REMOVED = 4
MOST_KEPT = 24  # reduced mechanisms with several trial drivers that are looked at


@dataclass(frozen=True)
class ReducedMechanism:
    """A mechanism of one larger group less.

    ``removed`` are left out of it, ``trial`` are the trial drivers in their stead, at value and rate 0; ``elements``
    are those that place the links of the group, in the order of drawing.  ``since`` are angles and travels (rad, m) of
    what rolls at a position within half a turn at which it fits, by their names.  ``held`` are drivers of blocks left
    out, as they drive the links that turn with these: by their keys there, the driver's own key and by how much the
    angle is larger (rad).
    """

    structure: Structure
    removed: tuple[RemovedConstraint, ...]
    trial: tuple[Driver, ...]
    group: LargerGroup
    elements: tuple[Driven | Dyad, ...]
    since: Mapping[str, float] = field(default_factory=dict)
    held: Mapping[str, tuple[str, float]] = field(default_factory=dict)

    @property
    def left_out(self) -> tuple[str, ...]:
        """Names of the links, of the drivers, or of what rolls, that are left out."""
        return tuple(r.name for r in self.removed)

    def driven_instead(self) -> Iterator[tuple[str, str, float]]:
        """Driven blocks left out, each with the link driven in its stead and by how much it is turned from it (rad)."""
        angles = [d for d in self.structure.scene.drivers if d.turns]
        for one in self.removed:
            if one.left_out and one.slide is not None and any(one.left_out in (d.link, d.relative_to) for d in angles):
                yield one.left_out, one.other_side, one.turned

    def rolled_from(self, poses: Mapping[str, Pose], mm: float) -> ReducedMechanism:
        """The same, what rolls counted from a position at which it fits."""
        since = {name: value for r in self.removed for name, value in r.coordinates(poses, mm).items()}
        return replace(self, since=since) if since else self

    def gaps(self, paper: PlacedLinks) -> list[float]:
        """By how much each of what was left out does not fit: in the mechanism's size, or rad."""
        size = paper.mm * self.structure.scene.size
        found = []
        for r in self.removed:
            gap = r.gap(paper.links, paper.poses, paper.mm, self.since if r.rolling else paper.values)
            found.append(gap if r.is_angle else gap / size)
        return found

    def put_back(self, paper: PlacedLinks) -> dict[str, Pose]:
        """The group's links where they lie, those left out among them."""
        group = {name: pose for name, pose in paper.poses.items() if name in self.group.members}
        for r in self.removed:
            back = r.placed(paper.links, paper.poses, paper.mm)
            if back is not None:
                group[r.left_out] = back
        return group

    def opened(self, known: PlacedLinks, values: Sequence[float]) -> PlacedLinks:
        """The board before the group is drawn, the trial drivers at values (rad, or travel in the mechanism's size)."""
        here = {d.key: v * d.span(self.structure.scene.size) for d, v in zip(self.trial, values, strict=True)}
        here |= {key: known.values[own] + more for key, (own, more) in self.held.items()}
        return PlacedLinks(
            known.links, known.mm, {**known.values, **here}, dict(known.poses), known.instrument, dict(known.pricked)
        )

    def values(self, poses: Mapping[str, Pose], mm: float) -> list[float]:
        """The trial drivers' values in a position (rad, or travel in the mechanism's size)."""
        size = self.structure.scene.size
        return [reading(self.structure, d, poses, mm) / d.span(size) for d in self.trial]


def reduced_mechanisms(structure: Structure, group: LargerGroup, more_than: int = 0) -> list[ReducedMechanism]:
    """All ways to replace a larger group of a mechanism by dyads with the fewest constraints removed, or the fewest
    that are ``more_than`` so many.

    Raises
    ------
    Unsolvable : "not drawn": nothing can be left out so that only dyads remain
    """
    before = structure.elements[: structure.elements.index(group)]
    known = {structure.scene.frame.name, *(n for e in before for n in e.members)}
    for count in range(max(more_than + 1, len(group.rolling)), len(group.rolling) + MOST_REMOVED + 1):
        found: list[ReducedMechanism] = []
        for reduced in _reduced(structure, group, known, count):
            found.append(reduced)
            if count > 1 and len(found) == MOST_KEPT:
                break
        if found:
            return found
    names = ", ".join(group.links)
    raise Unsolvable("not drawn", Problem(Phrase("links", links=names), Phrase("nothing can be left out so that only")))


def _reduced(structure: Structure, group: LargerGroup, known: set[str], count: int) -> Iterator[ReducedMechanism]:
    rolling = tuple(_rolling(structure, group))
    own = {d.key: d for d in structure.scene.drivers}
    driven = {n for d in structure.scene.drivers if d.turns for n in d.links}
    # what the driver moves is rather left in its place
    removable = sorted(_removable(structure, group, driven), key=lambda r: r.left_out in driven)
    for others in combinations(removable, count - len(rolling)):
        removed = (*rolling, *others)
        gone = {r.left_out for r in removed if r.left_out}
        if len(gone) + sum(not r.left_out for r in removed) < count:
            continue
        if any(gone.intersection(r.links) for r in removed):
            continue  # where one is put back, the other must lie already
        drivers = _instead(structure.scene.drivers, removed)
        if len({d.key for d in drivers.values()}) < len(drivers):
            continue
        opened = _opened(structure.scene, removed, drivers)
        held = {new.key: (key, new.values[0] - own[key].values[0]) for key, new in drivers.items() if new != own[key]}
        members = [m for m in group.members if m not in gone]
        for trial in combinations(list(_trials(structure, group, gone, known)), count):
            elements = regrouped(replace(opened, drivers=(*opened.drivers, *trial)), known, members)
            if elements is None or held.keys() & {d.key for d in trial}:
                continue
            drawn = tuple(e for e in elements if isinstance(e, Driven | Dyad))
            if len(drawn) == len(elements):
                yield ReducedMechanism(structure, removed, trial, group, drawn, held=held)


def _rolling(structure: Structure, group: LargerGroup) -> Iterator[RemovedConstraint]:
    for relation in group.rolling:
        slides = [structure.slide(name) for kind, name in relation.terms if kind == "travel"]
        yield RemovedConstraint("", slide=slides[0] if slides else None, rolling=relation)


def _removable(structure: Structure, group: LargerGroup, driven: set[str]) -> Iterator[RemovedConstraint]:
    scene = structure.scene
    touching = {n for c in scene.contacts for n in c.links}
    touching |= {n for c in scene.contacts if c.rolling for n in (c.block, c.carrier)}
    touching |= {n for g in scene.gears for n in (*g.wheels, g.carrier)}
    touching |= {n for pin in scene.pins for n in (pin.of, pin.on)}
    for name in group.members:
        if name in touching:
            continue  # what stands for its contacts, and the block of its pin or slot, would hang on nothing
        hinges = [p for p, names in structure.hinges.items() if name in names]
        slides = [s for s in structure.slides if name in (s.a, s.b)]
        # what later groups hang on it hangs on it still when it is put back
        hinges = [p for p in hinges if _within(structure, group, p, name)]
        slides = [s for s in slides if s in group.pairs]
        if (name in driven and not slides) or any(s.key == d.key for d in scene.drivers for s in slides):
            continue
        ends = tuple((p, _within(structure, group, p, name)) for p in hinges)
        if len(hinges) == 2 and not slides:
            yield RemovedConstraint(name, ends)
        elif len(hinges) == 1 and len(slides) == 1:
            yield RemovedConstraint(name, ends, slides[0])
        elif not hinges and len(slides) == 2:
            yield RemovedConstraint(name, (), slides[0], slides[1])
    for driver in group.drivers:
        yield RemovedConstraint("", slide=None if driver.turns else structure.slide(driver.key), driver=driver)


def _within(structure: Structure, group: LargerGroup, point: str, name: str) -> str:
    """The link to which a hinge joins a link of a group: one of the group, or one known before; "" if none."""
    pairs = [p for p in group.pairs if p.turns and p.point == point]
    others = [n for p in pairs for n in (p.a, p.b) if n != name]
    return next((n for n in structure.hinges[point] if n in others), "")


def _instead(drivers: Sequence[Driver], removed: Sequence[RemovedConstraint]) -> dict[str, Driver]:
    """The drivers that are not removed, by their keys: an angle of a block left out is that of what it slides on, or of
    what slides on it, and a constant."""
    blocks = {r.left_out: r for r in removed if r.left_out and r.slide is not None}
    left: dict[str, Driver] = {}
    for driver in drivers:
        if any(driver == r.driver for r in removed):
            continue
        new = driver
        if new.turns and new.link in blocks:
            block = blocks[new.link]
            new = replace(new, link=block.other_side, value=new.value - block.turned)
        if new.turns and new.relative_to in blocks:
            block = blocks[new.relative_to]
            new = replace(new, relative_to=block.other_side, value=new.value + block.turned)
        left[driver.key] = new
    return left


def _opened(
    scene: Mechanism, removed: Sequence[RemovedConstraint], drivers: Mapping[str, Driver]
) -> Mechanism:
    """The scene without some constraints of a group, driven as given."""
    gone = {r.left_out for r in removed if r.left_out}
    scene = unrolled(scene, [r.rolling.name for r in removed if r.rolling is not None])
    return replace(
        scene,
        links=tuple(link for link in scene.links if link.name not in gone),
        slidings=tuple(s for s in scene.slidings if not gone & {s.link, s.on}),
        pins=tuple(p for p in scene.pins if p.key not in gone and not gone & {p.of, p.on}),
        contacts=tuple(c for c in scene.contacts if c.block not in gone),
        drivers=tuple(drivers.values()),
        question=replace(scene.question, find=(), stated=()),
    )


def _on_faces(structure: Structure, group: LargerGroup) -> Iterator[tuple[str, str]]:
    """The wheels of a group that roll on flat faces, with the blocks at their centres, which turn as the faces do."""
    names = {relation.name for relation in group.rolling}
    for contact in structure.scene.contacts:
        if contact.name in names and contact.flat and {contact.round[0].link, contact.block} <= set(group.members):
            yield contact.round[0].link, contact.block


def _trials(structure: Structure, group: LargerGroup, gone: set[str], known: set[str]) -> Iterator[Driver]:
    """Drivers that can take its place: at a pair of the group that is not driven and not left out; those at known links
    first, for their links are laid off."""
    driven = {d.key for d in structure.scene.drivers}
    blocks = {s.key for s in structure.slides if s.slot}
    for wheel, block in _on_faces(structure, group):
        yield Driver(wheel, block, 0.0, 0.0, 0.0)
    pairs = [p for p in group.pairs if not gone & {p.a, p.b}]
    for pair in sorted(pairs, key=lambda p: not known & {p.a, p.b}):
        if pair.turns:
            if pair.a not in driven and not {pair.a, pair.b} & blocks:
                yield Driver(pair.a, pair.b, 0.0, 0.0, 0.0)
        elif pair.key not in driven:
            yield Driver(pair.a, pair.b, 0.0, 0.0, 0.0, pair.key)


# -- what is left out --------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class RemovedConstraint:
    """A constraint removed from a group.

    ``left_out`` names the bar or block, "" for a driver and for rolling; ``ends`` are (point, link) of a bar's two
    hinges, or of a block's one; ``slide`` is the sliding pair of a block, of a driven slide or of what rolls along it,
    ``second`` the other one of a link that slides on two; ``rolling`` is what rolled.
    """

    left_out: str
    ends: tuple[tuple[str, str], ...] = ()
    slide: Pair | None = None
    second: Pair | None = None
    driver: Driver | None = None
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
        if self.driver is not None and self.driver.turns:
            names += self.driver.links
        if self.rolling is not None:
            names += self.rolling.links
        return tuple(dict.fromkeys(names))

    @property
    def is_angle(self) -> bool:
        """Whether its gap is an angle (rad), not a length (mm)."""
        if self.rolling is not None:
            return not self.rolling.in_lengths
        return self.second is not None if self.driver is None else self.driver.turns

    def gap(self, links: Mapping[str, PlacedLink], poses: Poses, mm: float, values: Mapping[str, float]) -> float:
        """By how much it does not fit: mm of paper, or rad for a driven angle; ``values`` are those of the drivers, and
        of what rolls those at a position within half a turn (rad, m), by the name of the coordinate."""
        if self.rolling is not None:
            return self._rolled_off(poses, mm, values)
        if self.driver is not None and self.driver.turns:
            turn = poses[self.driver.link].axis / poses[self.driver.relative_to].axis
            return cmath.phase(turn * cmath.rect(1.0, -values[self.driver.key]))
        if self.driver is not None:
            assert self.slide is not None
            return travel(self.slide, poses, mm) - values[self.driver.key] * mm
        if self.second is not None:
            return cmath.phase(self._slid(self.second, poses).axis / self._slid(self.slide, poses).axis)
        if self.slide is None:
            (p, here), (q, there) = self.ends
            points = links[self.left_out].points
            return abs(_place(links, poses, mm, q, there) - _place(links, poses, mm, p, here)) - (
                abs(points[q] - points[p]) * mm
            )
        lies, other, guide = self.placed(links, poses, mm), poses[self.other_side], self.slide.guide
        assert lies is not None
        blocked = self.slide.a == self.left_out
        block, rail = (lies, other) if blocked else (other, lies)
        off = cross(rail.axis * guide.direction, block.origin - rail.place(guide.through * mm))
        return off if blocked else -off

    def coordinates(self, poses: Poses, mm: float) -> dict[str, float]:
        """The angles within a turn and the travel of what rolls (rad, m), by the names of the coordinates."""
        found = {}
        for kind, name in self.rolling.terms if self.rolling is not None else ():
            if kind == "angle":
                found[f"{kind} {name}"] = cmath.phase(poses[name].axis)
            elif self.slide is not None:
                found[f"{kind} {name}"] = travel(self.slide, poses, mm) / mm
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
        """Where the link left out lies, where it fits; None where a driver was left out.

        A bar lies by its two hinges, a block by its hinge and the direction of its guide, a link that slides on two
        where both put it.
        """
        if not self.left_out:
            return None
        if self.second is not None:
            (p, to_p), (q, to_q) = ([self._slid(slide, poses, way, mm).origin for way in (0.0, mm)]
                                    for slide in (self.slide, self.second))  # fmt: skip
            at_both = cross_lines(p, to_p - p, q, to_q - q)
            return None if at_both is None else Pose(at_both, self._slid(self.slide, poses).axis)
        at = [_place(links, poses, mm, *end) for end in self.ends]
        own = [links[self.left_out].points[point] * mm for point, _ in self.ends]
        axis = self._slid(self.slide, poses).axis if self.slide else unit((at[1] - at[0]) / (own[1] - own[0]))
        return Pose(at[0] - axis * own[0], axis)

    def _slid(self, slide: Pair | None, poses: Poses, way: float = 0.0, mm: float = 1.0) -> Pose:
        """The link left out as a sliding pair puts it, at a travel (mm)."""
        assert slide is not None
        return across(slide, self.left_out, poses[slide.other(self.left_out)], way, mm)

    @property
    def other_side(self) -> str:
        """The link on which a block left out slides, or that slides on it."""
        assert self.slide is not None
        return self.slide.other(self.left_out)

    @property
    def turned(self) -> float:
        """By how much (rad) a block left out is turned from the link on its other side, always."""
        assert self.slide is not None
        turn = cmath.phase(self.slide.guide.direction * self.slide.turn)
        return turn if self.slide.a == self.left_out else -turn

    def along(self, poses: Poses) -> complex:
        """Direction of the guide of a block left out."""
        assert self.slide is not None
        rail = self._slid(self.slide, poses) if self.slide.b == self.left_out else poses[self.slide.b]
        return rail.axis * self.slide.guide.direction


def _place(links: Mapping[str, PlacedLink], poses: Poses, mm: float, point: str, link: str) -> complex:
    pose = poses[link]
    return pose.origin + pose.axis * links[link].points[point] * mm
