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
from itertools import combinations, islice
from typing import Literal

from graphkin.construction.links_on_paper import PlacedLinks, across, reading, travel
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import Pose, Poses, cross, cross_lines, unit
from graphkin.scene.model import Driver
from graphkin.structure import Driven, Dyad, LargerGroup, Pair, RollingRelation, Structure, regrouped, unrolled, without
from graphkin.words import Phrase

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

    @property
    def starts(self) -> tuple[Driver, ...]:
        """Of the position from which rolling starts: what tells where the links stand that roll, as the problem says.
        """
        return () if self.group in self.structure.elements else self.group.starts

    def rolled_from(self, poses: Poses, mm: float) -> ReducedMechanism:
        """The same, what rolls counted from a position at which it fits."""
        since = {name: value for r in self.removed for name, value in r.coordinates(poses, mm).items()}
        return replace(self, since=since) if since else self

    def gaps(self, paper: PlacedLinks) -> list[float]:
        """By how much each of what was left out does not fit: in the mechanism's size, or rad."""
        size = paper.mm * self.structure.scene.size
        return [r.gap(paper, self.since) / (1.0 if r.is_angle else size) for r in self.removed]

    def put_back(self, paper: PlacedLinks) -> dict[str, Pose]:
        """The group's links where they lie, those left out among them."""
        group = {name: pose for name, pose in paper.poses.items() if name in self.group.members}
        back = ((r.left_out, r.placed(paper)) for r in self.removed if r.left_out)
        return group | {name: pose for name, pose in back if pose is not None}

    def opened(self, known: PlacedLinks, values: Sequence[float]) -> PlacedLinks:
        """The board before the group is drawn, the trial drivers at values (rad, or travel in the mechanism's size)."""
        here = {d.key: v * d.span(self.structure.scene.size) for d, v in zip(self.trial, values, strict=True)}
        here |= {key: known.values[driver] + more for key, (driver, more) in self.held.items()}
        return replace(known, values={**known.values, **here}, poses=dict(known.poses), pricked=dict(known.pricked))

    def values(self, poses: Poses, mm: float) -> list[float]:
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
    rolling = len(group.rolling)
    for count in range(max(more_than + 1, rolling), rolling + MOST_REMOVED + 1):
        reduced = list(islice(_reduced(structure, group, known, count), MOST_KEPT if count > 1 else None))
        if reduced:
            return reduced
    links = Phrase("links", links=", ".join(group.links))
    raise Unsolvable("not drawn", Problem(links, Phrase("nothing can be left out so that only")))


def _reduced(structure: Structure, group: LargerGroup, known: set[str], count: int) -> Iterator[ReducedMechanism]:
    scene = structure.scene
    rails = (tuple(structure.slide(n) for kind, n in r.terms if kind == "travel") for r in group.rolling)
    rolling = tuple(RemovedConstraint("", slides=s, rolling=r) for r, s in zip(group.rolling, rails, strict=True))
    as_given = {d.key: d for d in scene.drivers}
    driven = {n for d in scene.drivers if d.turns for n in d.links}
    # what the driver moves is rather left in its place
    removable = sorted(_removable(structure, group, driven), key=lambda r: r.left_out in driven)
    for others in combinations(removable, count - len(rolling)):
        removed = (*rolling, *others)
        gone = {r.left_out for r in removed if r.left_out}
        if len(gone) + sum(not r.left_out for r in removed) < count:
            continue
        if any(gone.intersection(r.links) for r in removed):
            continue  # where one is put back, the other must lie already
        drivers = _instead(scene.drivers, removed)
        if len({d.key for d in drivers.values()}) < len(drivers):
            continue
        opened = without(unrolled(scene, [r.rolling.name for r in removed if r.rolling]), gone)
        moved = ((key, as_given[key], new) for key, new in drivers.items() if new != as_given[key])
        held = {new.key: (key, new.values[0] - old.values[0]) for key, old, new in moved}
        members = [m for m in group.members if m not in gone]
        for trial in combinations(list(_trials(structure, group, gone, known)), count):
            elements = regrouped(replace(opened, drivers=(*drivers.values(), *trial)), known, members)
            if elements is None or held.keys() & {d.key for d in trial}:
                continue
            drawn = tuple(e for e in elements if isinstance(e, Driven | Dyad))
            if len(drawn) == len(elements):
                yield ReducedMechanism(structure, removed, trial, group, drawn, held=held)


def _removable(structure: Structure, group: LargerGroup, driven: set[str]) -> Iterator[RemovedConstraint]:
    scene = structure.scene
    touching = {n for c in scene.contacts for n in (*c.links, *((c.block, c.carrier) if c.rolling else ()))}
    touching |= {n for g in scene.gears for n in (*g.wheels, g.carrier)}
    touching |= {n for pin in scene.pins for n in (pin.of, pin.on)}
    keys = {d.key for d in scene.drivers}
    for name in group.members:
        if name in touching:
            continue  # what stands for its contacts, and the block of its pin or slot, would hang on nothing
        # what later groups hang on it hangs on it still when it is put back
        joined = ((p, _joined_at(structure, group, p, name)) for p, names in structure.hinges.items() if name in names)
        ends = tuple((point, link) for point, link in joined if link)
        slides = tuple(s for s in structure.slides if name in s.links and s in group.pairs)
        if (name in driven and not slides) or any(s.key in keys for s in slides):
            continue
        if (len(ends), len(slides)) in ((2, 0), (1, 1), (0, 2)):
            yield RemovedConstraint(name, ends, slides)
    for driver in group.drivers:
        yield RemovedConstraint("", slides=() if driver.turns else (structure.slide(driver.key),), driver=driver)


def _joined_at(structure: Structure, group: LargerGroup, point: str, name: str) -> str:
    """The link to which a hinge joins a link of a group: one of the group, or one known before; "" if none."""
    others = {n for p in group.pairs if p.turns and p.point == point for n in p.links} - {name}
    return next((n for n in structure.hinges[point] if n in others), "")


def _instead(drivers: Sequence[Driver], removed: Sequence[RemovedConstraint]) -> dict[str, Driver]:
    """The drivers that are not removed, by their keys: an angle of a block left out is that of what it slides on, or of
    what slides on it, and a constant."""
    blocks = {r.left_out: r for r in removed if r.left_out and r.slides}
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


def _trials(structure: Structure, group: LargerGroup, gone: set[str], known: set[str]) -> Iterator[Driver]:
    """Drivers that can take its place: of a wheel that rolls on a flat face, from the block at its centre, which turns
    as the face does; at a pair of the group that is not driven and not left out, those at known links first, for their
    links are laid off."""
    rolling = {relation.name for relation in group.rolling}
    for contact in structure.scene.contacts:
        if contact.name in rolling and contact.flat and {contact.round[0].link, contact.block} <= set(group.members):
            yield Driver(contact.round[0].link, contact.block, 0.0, 0.0, 0.0)
    driven = {d.key for d in structure.scene.drivers}
    blocks = {s.key for s in structure.slides if s.slot}
    pairs = [p for p in group.pairs if gone.isdisjoint(p.links)]
    for pair in sorted(pairs, key=lambda p: known.isdisjoint(p.links)):
        if not pair.turns and pair.key not in driven:
            yield Driver(pair.a, pair.b, 0.0, 0.0, 0.0, pair.key)
        elif pair.turns and pair.a not in driven and blocks.isdisjoint(pair.links):
            yield Driver(pair.a, pair.b, 0.0, 0.0, 0.0)


# -- what is left out --------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class RemovedConstraint:
    """A constraint removed from a group.

    ``left_out`` names the bar or block, "" for a driver and for rolling; ``ends`` are (point, link) of a bar's two
    hinges, or of a block's one; ``slides`` is the sliding pair of a block, of a driven slide or of what rolls along it,
    or both of a link that slides on two; ``rolling`` is what rolled.
    """

    left_out: str
    ends: tuple[tuple[str, str], ...] = ()
    slides: tuple[Pair, ...] = ()
    driver: Driver | None = None
    rolling: RollingRelation | None = None

    @property
    def kind(self) -> Literal["bar", "guide", "turn", "travel", "guides", "rolled"]:
        """A bar's length, the side of a block's guide, a driver's angle or travel, the angle between two guides, or how
        much has rolled off: what fits or not."""
        if self.rolling is not None:
            return "rolled"
        if self.driver is not None:
            return "turn" if self.driver.turns else "travel"
        return ("bar", "guide", "guides")[len(self.slides)]

    @property
    def name(self) -> str:
        """Of the bar or block, of the driver, or of the contact or the wheels that roll."""
        return self.rolling.name if self.rolling else self.driver.key if self.driver else self.left_out

    @property
    def links(self) -> tuple[str, ...]:
        """The links between which it stood."""
        names = [link for _, link in self.ends]
        names += [n for slide in self.slides for n in slide.links if n != self.left_out]
        names += self.driver.links if self.driver and self.driver.turns else ()
        return tuple(dict.fromkeys((*names, *(self.rolling.links if self.rolling else ()))))

    @property
    def is_angle(self) -> bool:
        """Whether its gap is an angle (rad), not a length (mm)."""
        return self.kind in ("turn", "guides") or (self.rolling is not None and not self.rolling.in_lengths)

    def gap(self, paper: PlacedLinks, since: Mapping[str, float]) -> float:
        """By how much it does not fit: mm of paper, or rad.

        Parameters
        ----------
        since : angles and travels (rad, m) of what rolls at a position within half a turn, by names of coordinates
        """
        poses, mm, driver = paper.poses, paper.mm, self.driver
        if self.rolling is not None:  # by how much the sum that rolling keeps is another
            gap, here = 0.0, self.coordinates(poses, mm)
            for (kind, name), weight in self.rolling.weights(1.0).items():
                moved = here[f"{kind} {name}"] - since[f"{kind} {name}"]
                gap += weight * (math.remainder(moved, math.tau) if kind == "angle" else moved)
            return gap * mm if self.rolling.in_lengths else gap
        if driver is not None and driver.turns:
            turn = poses[driver.link].axis / poses[driver.relative_to].axis
            return cmath.phase(turn * cmath.rect(1.0, -paper.values[driver.key]))
        if driver is not None:
            return travel(self.slides[0], poses, mm) - paper.values[driver.key] * mm
        if self.kind == "guides":
            one, two = (self._slid(slide, poses).axis for slide in self.slides)
            return cmath.phase(two / one)
        if self.kind == "bar":
            (p, one), (q, two) = self._hinges(paper)
            return abs(two - one) - abs(q - p)
        (slide,), lies, other = self.slides, self.placed(paper), poses[self.other_side]
        assert lies is not None
        block, rail = (lies, other) if slide.a == self.left_out else (other, lies)
        off = cross(rail.axis * slide.guide.direction, block.origin - rail.place(slide.guide.through * mm))
        return off if slide.a == self.left_out else -off

    def coordinates(self, poses: Poses, mm: float) -> dict[str, float]:
        """The angles within a turn and the travel of what rolls (rad, m), by the names of the coordinates."""
        values = {}
        for kind, name in self.rolling.terms if self.rolling else ():
            value = cmath.phase(poses[name].axis) if kind == "angle" else travel(self.slides[0], poses, mm) / mm
            values[f"{kind} {name}"] = value
        return values

    def placed(self, paper: PlacedLinks) -> Pose | None:
        """Where the link left out lies, where it fits: a bar by its two hinges, a block by its hinge and the direction
        of its guide, a link that slides on two where both put it."""
        poses = paper.poses
        if self.kind == "guides":
            (p, to_p), (q, to_q) = ([self._slid(slide, poses, mm, paper.mm).origin for mm in (0.0, paper.mm)]
                                    for slide in self.slides)  # fmt: skip
            at_both = cross_lines(p, to_p - p, q, to_q - q)
            return None if at_both is None else Pose(at_both, self._slid(self.slides[0], poses).axis)
        (local, at), *other = self._hinges(paper)
        bar = None if self.slides else unit((other[0][1] - at) / (other[0][0] - local))
        axis = bar or self._slid(self.slides[0], poses).axis
        return Pose(at - axis * local, axis)

    def _hinges(self, paper: PlacedLinks) -> list[tuple[complex, complex]]:
        """Of each hinge its place (mm) on the link left out, in its axes, and where the other link has it on paper."""
        points, lying = paper.links[self.left_out].points, ((p, paper.poses[n], paper.links[n]) for p, n in self.ends)
        return [(points[p] * paper.mm, pose.origin + pose.axis * link.points[p] * paper.mm) for p, pose, link in lying]

    def _slid(self, slide: Pair, poses: Poses, moved: float = 0.0, mm: float = 1.0) -> Pose:
        """The link left out as a sliding pair puts it, at a travel (mm)."""
        return across(slide, self.left_out, poses[slide.other(self.left_out)], moved, mm)

    @property
    def other_side(self) -> str:
        """The link on which a block left out slides, or that slides on it."""
        return self.slides[0].other(self.left_out)

    @property
    def turned(self) -> float:
        """By how much (rad) a block left out is turned from the link on its other side, always."""
        turn = cmath.phase(self.slides[0].guide.direction * self.slides[0].turn)
        return turn if self.slides[0].a == self.left_out else -turn

    def along(self, poses: Poses) -> complex:
        """Direction of the guide of a block left out."""
        (slide,) = self.slides
        rail = self._slid(slide, poses) if slide.b == self.left_out else poses[slide.b]
        return rail.axis * slide.guide.direction
