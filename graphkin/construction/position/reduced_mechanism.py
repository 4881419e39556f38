"""Mechanisms of dyads in place of one with a larger group, which compass and ruler cannot draw.

With constraints of the group removed (bars, blocks or drivers) and as many trial drivers in their place, every part is
a dyad and can be drawn; at the right values of the trial drivers the removed constraints fit (method of trial
positions; Hain, Applied Kinematics; 试凑法).  The fewest possible constraints are removed.  From a trial drawing near
the wanted place the right values are found by its gaps.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations, islice
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphkin.construction.position.links_on_paper import (
    PlacedLinks,
    across,
    assembled,
    met_near,
    moved,
    reading,
    stuck,
    travel,
)
from graphkin.plane import Pose, Poses, cross, cross_lines, unit
from graphkin.scene.model import Driver
from graphkin.scene.pairs import Pair
from graphkin.structure import (
    Driven,
    Dyad,
    Element,
    LargerGroup,
    RollingRelation,
    Structure,
    regrouped,
    started,
    unrolled,
    without,
)

MOST_REMOVED = 4
MOST_KEPT = 24  # reduced mechanisms with several trial drivers that are looked at
FIT = 1e-12  # what is left out fits, in the size of the mechanism
NUDGE = 1e-4  # of the trial driver, to see how the gap changes
ROUNDS = 30
POOR = 0.01  # below this more constraints are removed than it takes
GOOD = 0.3  # a reduced mechanism as good as this is taken without a look at the others

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class ReducedMechanism:
    """A mechanism with dyads in place of a larger group.

    Parameters
    ----------
    removed : its removed constraints
    trial : the trial drivers in their place, at value and rate 0
    elements : they place the links of the group, in the order of drawing
    since : angles and travels (rad, m) of rolling links at a position within half a turn at which they fit, by name
    held : drivers of left-out blocks, acting on the links that turn with these: by their keys there, the driver's own
        key and the increase of the angle (rad)
    """

    structure: Structure
    removed: tuple[RemovedConstraint, ...]
    trial: tuple[Driver, ...]
    group: LargerGroup
    elements: tuple[Driven | Dyad, ...]
    since: Mapping[str, float] = field(default_factory=dict)
    held: Mapping[str, tuple[str, float]] = field(default_factory=dict)

    @property
    def starts(self) -> tuple[Driver, ...]:
        """The given data of the starts of rolling links."""
        return () if self.group in self.structure.elements else self.group.starts

    def rolled_from(self, poses: Poses, mm: float) -> ReducedMechanism:
        """The reduced mechanism with rolling counted from a position at which it fits."""
        since = {name: value for r in self.removed for name, value in r.coordinates(poses, mm).items()}
        return replace(self, since=since) if since else self

    def gaps(self, paper: PlacedLinks) -> list[float]:
        """The misfit of each left-out constraint: in the mechanism's size, or rad."""
        size = paper.mm * self.structure.scene.size
        return [r.gap(paper, self.since) / (1.0 if r.is_angle else size) for r in self.removed]

    def put_back(self, paper: PlacedLinks) -> dict[str, Pose]:
        """The poses of the group's links, left-out ones included."""
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
    """All reductions of a larger group to dyads with the fewest constraints removed, or with the fewest above
    ``more_than``; none if no constraints can be left out so that only dyads remain."""
    before = structure.elements[: structure.elements.index(group)]
    known = {structure.scene.frame.name, *(n for e in before for n in e.members)}
    rolling = len(group.rolling)
    for count in range(max(more_than + 1, rolling), rolling + MOST_REMOVED + 1):
        reduced = list(islice(_reduced(structure, group, known, count), MOST_KEPT if count > 1 else None))
        if reduced:
            return reduced
    return []


def _reduced(structure: Structure, group: LargerGroup, known: set[str], count: int) -> Iterator[ReducedMechanism]:
    """The reduced mechanisms with ``count`` constraints removed, those of rolling included; ``known`` links are placed
    before."""
    scene = structure.scene
    rails = (tuple(structure.slide(n) for kind, n in r.terms if kind == "travel") for r in group.rolling)
    rolling = tuple(RemovedConstraint("", slides=s, rolling=r) for r, s in zip(group.rolling, rails, strict=True))
    # what turned links before from later ones holds no more
    before = {d.key for e in structure.driven if e.ahead and e.link in known for d in e.drivers}
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
        drivers = _instead([d for d in scene.drivers if d.key not in before], removed)
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
    """The removable parts of a group: bars with two hinges, links with a hinge and a guide or two guides, drivers."""
    scene = structure.scene
    place = structure.place_of[group.members[0]]
    here = [pair for pair in scene.acting if all(structure.place_of.get(n, place) <= place for n in pair.members)]
    touching = {n for pair in here for n in (*pair.members, *((pair.block,) if pair.rolling else ()))}
    touching |= {n for slide in scene.slides if slide.higher and slide in group.pairs for n in slide.bodies}
    keys = {d.key for d in scene.drivers}
    for name in group.members:
        if name in touching:
            continue  # what stands for its contacts, and the block of its pin or slot, would hang on nothing
        # what later groups hang on it hangs on it still when it is put back
        ends = []
        for point, names in structure.hinges.items():
            others = {n for p in group.pairs if p.turns and p.point == point for n in p.links} - {name}
            ends += [(point, n) for n in names if n in others and name in names][:1]
        slides = tuple(s for s in structure.slides if name in s.links and s in group.pairs)
        if (name in driven and not slides) or any(s.key in keys for s in slides):
            continue
        if (len(ends), len(slides)) in ((2, 0), (1, 1), (0, 2)):
            yield RemovedConstraint(name, tuple(ends), slides)
    for driver in group.drivers:
        yield RemovedConstraint("", slides=() if driver.turns else (structure.slide(driver.key),), driver=driver)


def _instead(drivers: Sequence[Driver], removed: Sequence[RemovedConstraint]) -> dict[str, Driver]:
    """The remaining drivers, by their keys: the angle of a left-out block is that of its guide, or of the link that
    slides on it, and a constant."""
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
    """Trial drivers for the removed constraints: of a wheel that rolls on a flat face, from the block at its centre,
    which turns as the face does; at a pair of the group that is neither driven nor left out, those at known links
    first, since their links are laid off."""
    rolling = {relation.name for relation in group.rolling}
    for block, slide in structure.blocks.items():
        contact = structure.scene.replaced_by.get(block)
        if contact is not None and contact.name in rolling and {slide.of, block} <= {*group.members}:
            yield Driver(slide.of, block, 0.0, 0.0, 0.0)
    driven = {d.key for d in structure.scene.drivers}
    pairs = [p for p in group.pairs if gone.isdisjoint(p.links)]
    for pair in sorted(pairs, key=lambda p: known.isdisjoint(p.links)):
        if not pair.turns and pair.key not in driven:
            yield Driver(pair.a, pair.b, 0.0, 0.0, 0.0, pair.key)
        elif pair.turns and pair.a not in driven and structure.blocks.keys().isdisjoint(pair.links):
            yield Driver(pair.a, pair.b, 0.0, 0.0, 0.0)


# what is left out


@dataclass(frozen=True, eq=False, repr=False)
class RemovedConstraint:
    """A constraint removed from a group.

    ``left_out`` names the bar or block, "" for a driver and for rolling; ``ends`` are (point, link) of a bar's two
    hinges, or of a block's one; ``slides`` is the sliding pair of a block, of a driven slide or of rolling along it, or
    both pairs of a link that slides on two; ``rolling`` is the rolling relation.
    """

    left_out: str
    ends: tuple[tuple[str, str], ...] = ()
    slides: tuple[Pair, ...] = ()
    driver: Driver | None = None
    rolling: RollingRelation | None = None

    @property
    def kind(self) -> Literal["bar", "guide", "turn", "travel", "guides", "rolled"]:
        """The kind of the gap: a bar's length, the side of a block's guide, a driver's angle or travel, the angle
        between two guides, or rolling."""
        if self.rolling is not None:
            return "rolled"
        if self.driver is not None:
            return "turn" if self.driver.turns else "travel"
        return ("bar", "guide", "guides")[len(self.slides)]

    @property
    def name(self) -> str:
        """The name of the bar or block, of the driver, or of the contact or the wheels that roll."""
        return self.rolling.name if self.rolling else self.driver.key if self.driver else self.left_out

    @property
    def links(self) -> tuple[str, ...]:
        """The links that it joined."""
        names = [link for _, link in self.ends]
        names += [n for slide in self.slides for n in slide.links if n != self.left_out]
        names += self.driver.links if self.driver and self.driver.turns else ()
        return tuple(dict.fromkeys((*names, *(self.rolling.links if self.rolling else ()))))

    @property
    def is_angle(self) -> bool:
        """Whether its gap is an angle (rad), not a length (mm)."""
        return self.kind in ("turn", "guides") or (self.rolling is not None and not self.rolling.in_lengths)

    def gap(self, paper: PlacedLinks, since: Mapping[str, float]) -> float:
        """Its misfit (mm of paper, or rad); ``since`` has angles and travels (rad, m) of rolling links at a position
        within half a turn, by names of coordinates."""
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
            first, second = (self._slid(slide, poses).axis for slide in self.slides)
            return cmath.phase(second / first)
        if self.kind == "bar":
            (p, first), (q, second) = self._hinges(paper)
            return abs(second - first) - abs(q - p)
        (slide,), lies, other = self.slides, self.placed(paper), poses[self.other_side]
        assert lies is not None
        block, rail = (lies, other) if slide.a == self.left_out else (other, lies)
        distance = cross(rail.axis * slide.guide.direction, block.origin - rail.place(slide.guide.through * mm))
        return distance if slide.a == self.left_out else -distance

    def coordinates(self, poses: Poses, mm: float) -> dict[str, float]:
        """The angles within a turn and the travel of rolling links (rad, m), by the names of the coordinates."""
        values = {}
        for kind, name in self.rolling.terms if self.rolling else ():
            value = cmath.phase(poses[name].axis) if kind == "angle" else travel(self.slides[0], poses, mm) / mm
            values[f"{kind} {name}"] = value
        return values

    def placed(self, paper: PlacedLinks) -> Pose | None:
        """The pose of the left-out link, if it fits: a bar by its two hinges, a block by its hinge and the direction of
        its guide, a link that slides on two by both guides."""
        poses = paper.poses
        if self.kind == "guides":
            (p, to_p), (q, to_q) = ([self._slid(slide, poses, mm, paper.mm).origin for mm in (0.0, paper.mm)]
                                    for slide in self.slides)
            at_both = cross_lines(p, to_p - p, q, to_q - q)
            return None if at_both is None else Pose(at_both, self._slid(self.slides[0], poses).axis)
        (local, at), *other = self._hinges(paper)
        bar = None if self.slides else unit((other[0][1] - at) / (other[0][0] - local))
        axis = bar or self._slid(self.slides[0], poses).axis
        return Pose(at - axis * local, axis)

    def _hinges(self, paper: PlacedLinks) -> list[tuple[complex, complex]]:
        """For each hinge its place (mm) in the left-out link's axes, and its place on paper on the other link."""
        points, lying = paper.links[self.left_out].points, ((p, paper.poses[n], paper.links[n]) for p, n in self.ends)
        return [(points[p] * paper.mm, pose.origin + pose.axis * link.points[p] * paper.mm) for p, pose, link in lying]

    def _slid(self, slide: Pair, poses: Poses, moved: float = 0.0, mm: float = 1.0) -> Pose:
        """The pose of the left-out link on a sliding pair, at a travel (mm)."""
        return across(slide, self.left_out, poses[slide.other(self.left_out)], moved, mm)

    @property
    def other_side(self) -> str:
        """The link on which a left-out block slides, or that slides on it."""
        return self.slides[0].other(self.left_out)

    @property
    def turned(self) -> float:
        """The constant angle (rad) of a left-out block from the link on its other side."""
        turn = cmath.phase(self.slides[0].guide.direction * self.slides[0].turn)
        return turn if self.slides[0].a == self.left_out else -turn

    def along(self, poses: Poses) -> complex:
        """The direction of a left-out block's guide."""
        (slide,) = self.slides
        rail = self._slid(slide, poses) if slide.b == self.left_out else poses[slide.b]
        return rail.axis * slide.guide.direction


# trial drawings


class PlacedElements:
    """Elements of a mechanism that are placed on paper, and for each larger group among them the reduced mechanisms by
    whose trial drawings it is found, and the last that served.

    Raises
    ------
    Unsolvable : "not drawn": no constraints of a group can be left out so that only dyads remain
    """

    def __init__(self, structure: Structure, elements: Sequence[Element]) -> None:
        self.structure, self.elements = structure, elements
        wanted = [c for c in structure.larger_groups if c in elements]
        self.of: Mapping[LargerGroup, list[ReducedMechanism]] = {c: reduced_mechanisms(structure, c) for c in wanted}
        for group in (group for group, reduced in self.of.items() if not reduced):
            raise stuck("not drawn", group.named, "nothing can be left out so that only")
        self.last: dict[LargerGroup, ReducedMechanism] = {}
        self._further: dict[LargerGroup, list[ReducedMechanism]] = {}

    @cached_property
    def at_start(self) -> PlacedElements:
        """The elements of the mechanism at the scene's own position, with the starts of links that move each other by
        rolling; these themselves without such links."""
        if not any(group.starts for group in self.structure.larger_groups):
            return self
        there = started(self.structure)
        wanted = {n for element in self.elements for n in element.members}
        return PlacedElements(there, [e for e in there.elements if wanted.intersection(e.members)])

    def further(self, group: LargerGroup) -> list[ReducedMechanism]:
        """The reduced mechanisms with more constraints removed than necessary, for positions at which the others are at
        dead points."""
        if group not in self._further:
            self._further[group] = reduced_mechanisms(self.structure, group, len(self.of[group][0].removed))
        return self._further[group]

    def best(self, group: LargerGroup, known: PlacedLinks, guess: Poses) -> TrialDrawing | None:
        """The trial drawing of a group by the reduced mechanism that finds it best near a guess, which becomes the last
        that served; None where all are at dead points."""
        best = _best_of([self.last[group]] if group in self.last else [], known, guess)
        if best is not None and best.quality > GOOD / 2:
            return best
        best = _best_of(self.of[group], known, guess)
        if best is None or best.quality < POOR:
            further = _best_of(self.further(group), known, guess)
            if further is not None and (best is None or further.quality > best.quality):
                best = further
        if best is not None:
            self.last[group] = best.reduced
        return best

    def standing(self, group: LargerGroup, known: PlacedLinks, guess: Poses) -> ReducedMechanism | None:
        """The reduced mechanism of a group whose links move each other by rolling, at the scene's own position: its
        parts by the elements ``at_start``.  None where all are at dead points."""
        there = self.at_start
        removed: list[RemovedConstraint] = []
        trial: list[Driver] = []
        drawn: list[Driven | Dyad] = []
        held: dict[str, tuple[str, float]] = {}
        before = replace(known, poses=dict(known.poses))
        mine = [e for e in there.structure.elements if set(e.members) <= set(group.members)]
        for k, element in enumerate(mine):
            if isinstance(element, LargerGroup):
                # what later ones hang on is not left out
                wanted = {name for later in mine[k + 1 :] for name in later.outside}
                few_or_more = (there.of[element], there.further(element))
                served = ([r for r in some if wanted.isdisjoint(x.left_out for x in r.removed)] for some in few_or_more)
                drawings = (_best_of(some, before, guess) for some in served)
                best = next((drawing for drawing in drawings if drawing is not None), None)
                if best is None:
                    return None
                removed += best.reduced.removed
                trial += best.reduced.trial
                drawn += best.reduced.elements
                held.update(best.reduced.held)
            else:
                drawn.append(element)
            before.poses.update({name: guess[name] for name in element.members})
        return ReducedMechanism(there.structure, tuple(removed), tuple(trial), group, tuple(drawn), held=held)


@dataclass(frozen=True, eq=False, repr=False)
class TrialDrawing:
    """A drawing of a larger group at trial values, each dyad in the assembly nearest to a guess.

    Parameters
    ----------
    known, guess : the links drawn before, and the expected poses
    at : the trial values (rad, or travel in the mechanism's size), shape (trial drivers,)
    drawn : all links
    gaps : the misfit of each left-out constraint (in the mechanism's size, or rad), shape (constraints,)
    """

    reduced: ReducedMechanism
    known: PlacedLinks
    guess: Poses
    at: Array
    drawn: PlacedLinks
    gaps: Array

    @classmethod
    def of(
        cls, reduced: ReducedMechanism, known: PlacedLinks, guess: Poses, values: Sequence[float] | Array | None = None
    ) -> TrialDrawing | None:
        """The drawing at some values, or at those of the guess; None where it does not close."""
        at = np.array(reduced.values(guess, known.mm) if values is None else values, dtype=float)
        paper = reduced.opened(known, at.tolist())

        def choose(_: int, dyad: Dyad | LargerGroup) -> Poses | None:
            assert isinstance(dyad, Dyad)
            return met_near(paper, dyad, guess)

        if not assembled(paper, reduced.elements, choose):
            return None
        return cls(reduced, known, guess, at, paper, np.array(reduced.gaps(paper)))

    def moved_by(self, step: np.ndarray) -> TrialDrawing | None:
        """The drawing at other trial values."""
        return TrialDrawing.of(self.reduced, self.known, self.guess, self.at + step)

    @cached_property
    def _nudged(self) -> tuple[Array, float] | None:
        """The change of the gaps with the trial values, and the quality; None where a nudged drawing does not close."""
        group = {n: pose for n, pose in self.drawn.poses.items() if n in self.reduced.group.members}
        size = self.known.mm * self.reduced.structure.scene.size
        quality, slopes, each = 1.0, [], []
        for step in NUDGE * np.eye(len(self.at)):
            nudged = self.moved_by(step)
            if nudged is None:
                return None
            slopes.append((nudged.gaps - self.gaps) / NUDGE)
            grown = max(moved(group, nudged.drawn.poses, size), 1e-12) / NUDGE
            each.append(slopes[-1] / grown)
            quality = min(quality, 2.0 / grown)
        several = len(self.at) > 1
        least = float(np.linalg.svd(np.array(each), compute_uv=False)[-1]) if several else abs(float(each[0][0]))
        return np.array(slopes).T, quality * least

    @property
    def quality(self) -> float:
        """The quality with which it finds the group: a small gap should mean a small error of every link, and no link
        should move much more than the trial driver; 0 where it does not find the group at all."""
        return 0.0 if self._nudged is None else self._nudged[1]

    def closed(self) -> dict[str, Pose] | None:
        """The poses of the group: the trial values by repeated proportional division of the gaps, beginning here
        (secant; with several trial drivers Broyden's method, Math. Comp. 19, 1965); None where that finds none."""
        here = self
        if not self.reduced.trial:  # everything stands as it is given
            return self.reduced.put_back(self.drawn)
        if self._nudged is None:
            return None
        slopes, _ = self._nudged
        for _ in range(ROUNDS):
            try:
                step = np.linalg.solve(slopes, -here.gaps)
            except np.linalg.LinAlgError:
                break
            if not 0.0 < np.abs(step).max() <= 1.0:
                break  # it closes, is nowhere near, or nothing but rounding is left
            following = here.moved_by(step)
            if following is None:
                break
            if np.abs(following.gaps).max() >= np.abs(here.gaps).max() and np.abs(here.gaps).max() < FIT:
                break
            slopes = slopes + np.outer(following.gaps - here.gaps - slopes @ step, step) / (step @ step)
            here = following
        return self.reduced.put_back(here.drawn) if np.abs(here.gaps).max() < FIT else None


def fitted(
    reduced: ReducedMechanism, known: PlacedLinks, guess: Poses, values: Sequence[float] | None = None
) -> dict[str, Pose] | None:
    """The poses of a larger group near a guess, from trial drawings at some values, or at those of the guess."""
    start = TrialDrawing.of(reduced, known, guess, values)
    return None if start is None else start.closed()


def _drawn_near(
    candidates: Sequence[ReducedMechanism], known: PlacedLinks, guess: Poses
) -> Iterator[TrialDrawing]:
    """The trial drawings near a guess, from which rolling is counted, that find the group."""
    tried = (TrialDrawing.of(reduced.rolled_from(guess, known.mm), known, guess) for reduced in candidates)
    return (drawing for drawing in tried if drawing is not None and drawing.quality > 0.0)


def _best_of(candidates: Sequence[ReducedMechanism], known: PlacedLinks, guess: Poses) -> TrialDrawing | None:
    """The trial drawing that finds the group best, or the first that finds it well; None if none can be drawn."""
    best: TrialDrawing | None = None
    for drawing in _drawn_near(candidates, known, guess):
        if best is None or drawing.quality > best.quality:
            best = drawing
        if best.quality > GOOD:
            break
    return best


def best_first(
    structure: Structure, group: LargerGroup, known: PlacedLinks, guess: Poses
) -> Iterator[ReducedMechanism]:
    """The reduced mechanisms that can be drawn, the best first; those with the fewest constraints removed before the
    others."""
    placed = PlacedElements(structure, [group])
    for some in (placed.of[group], placed.further(group)):
        served = sorted(_drawn_near(some, known, guess), key=lambda drawing: -drawing.quality)
        yield from (drawing.reduced for drawing in served)
