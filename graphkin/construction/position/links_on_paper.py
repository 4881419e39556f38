"""Links on paper: their poses, their placing by hands, the travel of rolling links, the links of an element, and the
following of links from one position to another, lengths in mm.

Of a driven link the angle or the travel is laid off.  For each kind of dyad compass arcs and ruler lines meet: a
`Intersection` has the quality of the crossing, the possible places of the links, and the steps of each.

Everywhere ``poses`` are those of links on paper (mm), and ``mm`` is the length on paper of one m.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from graphkin.construction.board.instruments import EXACT, Instrument
from graphkin.construction.board.steps import Bar, CompassArc, Step
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import Pose, Poses, added_up, cross, cross_arcs, cross_line_arc, cross_lines, direction, dot, unit
from graphkin.scene.model import Driver, PlacedLink
from graphkin.scene.pairs import Pair
from graphkin.structure import (
    Body,
    Driven,
    Dyad,
    DyadKind,
    Element,
    LargerGroup,
    RollingRelation,
    Structure,
    named_with_contact,
)
from graphkin.structure.model import Coordinate
from graphkin.words import Phrase

SAME_HOLE = 1e-9
"""Points of a link that lie nearer to each other on paper (mm) are pricked once."""
DEAD = 1e-7  # sine of a crossing below which a group is at a dead point
MEETING = 1e-5  # of the size of the mechanism: a step that moves no link farther may pass a change point
TOLD = 0.25  # so much nearer to an assembly than to the other a guess tells which is meant


def apart(poses: Poses, other: Poses) -> float:
    """The distance of links from others of the same names, on paper (mm, and of directions)."""
    return added_up(abs(p.origin - other[n].origin) + abs(p.axis - other[n].axis) for n, p in poses.items())


@dataclass
class PlacedLinks:
    """Links on paper: their shapes at the length scale, the driver values, and the poses of the known ones."""

    links: Mapping[str, PlacedLink]
    mm: float  # of paper for one m
    values: Mapping[str, float]  # drivers, rad or m
    poses: dict[str, Pose] = field(default_factory=dict)
    instrument: Instrument = EXACT
    pricked: dict[str, complex] = field(default_factory=dict)  # points as they came to lie, where hands err

    def place(self, link: str, local: complex) -> complex:
        """A place given in a link's own axes (m), on paper."""
        return self.poses[link].place(local * self.mm)

    def point(self, link: str, point: str) -> complex:
        """The place of a point of a link (mm), where it was pricked."""
        if point in self.pricked:
            return self.pricked[point]
        return self.place(link, self.links[link].points[point])

    def fresh(self, poses: Poses) -> dict[str, complex]:
        """Places (m) of the points of further links in these poses that no link here has."""
        known = {p for name in self.poses for p in self.links[name].points}
        return {p: pose.place(z * self.mm) / self.mm
                for n, pose in poses.items() for p, z in self.links[n].points.items() if p not in known}

    def settle(self, names: Sequence[str]) -> None:
        """Prick the new points of links just placed, and put the links where their pricked points are."""
        if self.instrument.faultless:
            return
        for name in names:
            link, pose = self.links[name], self.poses[name]
            known = [p for p in link.points if p in self.pricked]
            for point in link.points:
                if point in self.pricked:
                    continue
                lies, local = self._settled(name, pose, known), link.points[point]
                same = next((p for p in known if abs(link.points[p] - local) * self.mm < SAME_HOLE), None)
                self.pricked[point] = (
                    self.pricked[same] if same else self.instrument.point(lies.origin + lies.axis * local * self.mm)
                )
                known.append(point)
            self.poses[name] = self._settled(name, pose, known)

    def _settled(self, name: str, pose: Pose, known: Sequence[str]) -> Pose:
        """The pose of a link by its two farthest points on paper; by a single point with the drawn direction."""
        link = self.links[name]
        if not known:
            return pose
        a, b = max(((a, b) for a in known for b in known), key=lambda ab: abs(link.points[ab[0]] - link.points[ab[1]]))
        span = link.points[b] - link.points[a]
        axis = unit((self.pricked[b] - self.pricked[a]) / span) if abs(span) * self.mm > 1.0 else pose.axis
        return Pose(self.pricked[a] - axis * (link.points[a] * self.mm), axis)


def start_board(
    structure: Structure, mm: float, values: Mapping[str, float], instrument: Instrument = EXACT
) -> PlacedLinks:
    """The empty paper with the fixed points pricked, at values of the drivers (rad, m)."""
    ground = structure.scene.frame.name
    values = structure.followed(values) if structure.followers else values
    paper = PlacedLinks(structure.links, mm, values, {ground: Pose(0j, 1 + 0j)}, instrument)
    if not instrument.faultless:
        paper.pricked.update({p: instrument.point(z * mm) for p, z in structure.links[ground].points.items()})
    return paper


class RigidBody:
    """A body as one piece: the poses of its links in the axes of its base link (mm)."""

    def __init__(self, paper: PlacedLinks, body: Body) -> None:
        self.paper, self.body = paper, body
        self.rel: dict[str, Pose] = {body.links[0]: Pose(0j, 1 + 0j)}
        for joint in body.joints:
            base = self.rel[joint.a]
            if joint.a in paper.poses and joint.b in paper.poses:  # as they lie
                a, b = paper.poses[joint.a], paper.poses[joint.b]
                self.rel[joint.b] = Pose(base.place(a.local(b.origin)), unit(base.axis * b.axis / a.axis))
                continue
            value = paper.values[joint.driver.key]
            if joint.pair.turns:
                turned = (joint.driver.link == joint.b) if joint.driver.turns else True
                axis = base.axis * direction(math.degrees(value if turned else -value))
                links, point = paper.links, joint.pair.point
                hinge = base.place(links[joint.a].points[point] * paper.mm)
                self.rel[joint.b] = Pose(hinge - axis * (links[joint.b].points[point] * paper.mm), axis)
            else:
                self.rel[joint.b] = across(joint.pair, joint.b, base, value * paper.mm, paper.mm)

    def point(self, point: str, link: str = "") -> complex:
        """A point of a link, or of any link of the body with the point."""
        link = link or next(name for name in self.body.links if point in self.paper.links[name].points)
        return self.rel[link].place(self.paper.links[link].points[point] * self.paper.mm)

    def hinge(self, pair: Pair) -> tuple[complex, complex]:
        """An outer turning pair: its place on paper and in the body's axes."""
        return self.paper.point(pair.b, pair.point), self.point(pair.point, pair.a)

    def rail(self, slide: Pair) -> tuple[Pose, complex]:
        """The body on a known guide, or with a guide on a known block: its pose at travel 0 and its displacement per
        mm."""
        paper = self.paper
        mine = slide.a if slide.a in self.rel else slide.b
        known = paper.poses[slide.other(mine)]
        at_zero, rel = across(slide, mine, known, 0.0, paper.mm), self.rel[mine]
        axis = unit(at_zero.axis * rel.axis.conjugate())
        # a block on a known guide goes along it; a guide on a known block goes against its own sense
        along = known.axis if mine == slide.a else -at_zero.axis
        step = paper.instrument.direction(unit(along * slide.guide.direction))
        return Pose(at_zero.origin - axis * rel.origin, axis), step

    def placed(self, base: Pose) -> dict[str, Pose]:
        """Its links, with its base link in a pose."""
        if len(self.rel) == 1:
            return {self.body.links[0]: Pose(base.origin, unit(base.axis))}
        return {n: Pose(base.place(rel.origin), unit(base.axis * rel.axis)) for n, rel in self.rel.items()}

    def through(self, local: tuple[complex, complex], world: tuple[complex, complex]) -> dict[str, Pose]:
        """Place the body by two of its points."""
        axis = unit((world[1] - world[0]) / (local[1] - local[0]))
        return self.placed(Pose(world[0] - axis * local[0], axis))

    def shifted(self, base: Pose, shift: complex) -> dict[str, Pose]:
        """Its links, with its base link displaced."""
        return self.placed(Pose(base.origin + shift, base.axis))


def travel(slide: Pair, poses: Poses, mm: float) -> float:
    """The travel of a sliding link along its guide, from the guide's origin to its own (mm)."""
    start = poses[slide.b].place(slide.guide.through * mm)
    return dot(poses[slide.a].origin - start, slide.along(poses))


def reading(structure: Structure, driver: Driver, poses: Poses, mm: float) -> float:
    """The value of a driver read from the links' poses (rad, m)."""
    if driver.turns:
        return cmath.phase(poses[driver.link].axis / poses[driver.relative_to].axis)
    return travel(structure.slide(driver.slide), poses, mm) / mm


def across(slide: Pair, link: str, other: Pose, travel: float, mm: float) -> Pose:
    """The pose of a link of a sliding pair from that of the other link, at a travel (mm)."""
    g, start = slide.guide.direction, slide.guide.through * mm
    if link == slide.a:
        return Pose(other.place(start + travel * g), other.axis * g * slide.turn)
    axis = other.axis * (g * slide.turn).conjugate()
    return Pose(other.origin - axis * (start + travel * g), axis)


def pushed_by_driver(
    structure: Structure, values: Mapping[str, float], between: Iterable[str]
) -> tuple[Driver, float] | None:
    """The driver whose travel gives the distance of two points, and that (m), at values of the drivers: it counts from
    the origin of its guide to the sliding link; None for another pair of points."""
    ends, least = set(between), 1e-9 * structure.scene.size
    for driver in structure.scene.drivers:
        slide = next((s for s in structure.slides if s.key == driver.key), None)
        if driver.turns or slide is None or slide.pin not in ends:
            continue
        on = structure.scene.by_name[slide.b].points
        origin = next((p for p, z in on.items() if abs(z - slide.guide.through) < least), None)
        if ends == {origin, slide.pin}:
            return driver, abs(values[driver.key])
    return None


TURNS = 3
"""Turns that what something rolls on may have made since the position from which it is followed."""


def rolled_near(structure: Structure, paper: PlacedLinks, driver: RollingRelation, start: Poses, guess: Poses) -> float:
    """The value of a rolling link (rad, m) in a position under construction, by the motion of the links on which it
    rolls.

    Parameters
    ----------
    paper : the position under construction
    start : the poses from which it rolls, within some turns
    guess : the poses that are expected: of several values the nearest is taken
    """
    value, turns = coordinate_on_paper(structure, start, paper.mm, driver.coordinate), [0.0]
    for coordinate, factor in driver.factors:
        here, there = (coordinate_on_paper(structure, poses, paper.mm, coordinate) for poses in (paper.poses, start))
        value += factor * (here - there)
        if coordinate[0] == "angle":
            turns = [more + k * math.tau * factor for more in turns for k in range(-TURNS, TURNS + 1)]
    wanted = coordinate_on_paper(structure, guess, paper.mm, driver.coordinate)

    def misfit(whole: float) -> float:
        far = value + whole - wanted
        return abs(math.remainder(far, math.tau) if driver.turns else far)

    # of several that fit as well the one with the fewest turns
    return value + min(turns, key=lambda whole: (round(misfit(whole), 9), abs(whole)))


def coordinate_on_paper(structure: Structure, poses: Poses, mm: float, coordinate: Coordinate) -> float:
    """An angle within a turn (rad), or a travel (m), of links on paper."""
    kind, name = coordinate
    return cmath.phase(poses[name].axis) if kind == "angle" else travel(structure.slide(name), poses, mm) / mm


# the links of an element

Steps = tuple[Step, ...]


@dataclass(frozen=True, eq=False, repr=False)
class Intersection:
    """The intersection of two loci.

    ``gap`` is positive where they cross, zero where they touch, negative where they miss each other; for two lines
    it is the sine of their angle, and they meet once.  ``poses`` are the possible places of the group's links, that of
    the default rule first; ``steps`` gives the steps of each.  ``sine`` of the crossing angle is 0 where the crossing
    is lost; a guide between two pivots is lost when they coincide, at any angle of its lines' ``cross``.
    """

    gap: float
    sine: float
    poses: tuple[Poses, ...]
    steps: Callable[[int], Steps]
    cross: float | None = None

    @property
    def sharpness(self) -> float:
        """Sine of the angle at which the two loci cross on paper."""
        return min(1.0, self.sine if self.cross is None else self.cross)

    def nearest(self, poses: Poses) -> int | None:
        """The index of the possible places nearest to the expected poses of the links; None without places."""
        return min(range(len(self.poses)), key=lambda k: apart(self.poses[k], poses), default=None)


LOST = Intersection(0.0, 0.0, (), lambda _: ())
"""Loci that find nothing: an arc of no radius, lines along each other."""


def drive(paper: PlacedLinks, element: Driven) -> tuple[Pose, Step]:
    """Place a driven link: the angle or the travel is laid off."""
    name, driver, pair = element.link, element.driver, element.pair
    value = paper.values[driver.key]
    if driver.turns:
        forward, to, base = True, "", 1 + 0j
        if isinstance(driver, Driver):
            forward = driver.link == name
            to = driver.relative_to if forward else driver.link
            base = 1 + 0j if element.ahead else paper.poses[to].axis
            for step, forth in element.ahead:
                turn = step.guide.direction * step.turn if isinstance(step, Pair) else (
                    direction(math.degrees(paper.values[step.key])))
                base *= turn if forth else turn.conjugate()
        axis = unit(base * paper.instrument.angle(direction(math.degrees(value if forward else -value))))
        hinge = paper.point(pair.b, pair.point)
        pose = Pose(hinge - axis * (paper.links[name].points[pair.point] * paper.mm), axis)
        value = value if forward else -value
        return pose, Step("lay off", "angle", link=name, value=value, point=pair.point, base=to)
    known = pair.b if name == pair.a else pair.a
    pose = across(pair, name, paper.poses[known], paper.instrument.length(value * paper.mm), paper.mm)
    start = paper.place(pair.b, pair.guide.through) if name == pair.a else pose.origin
    end = pose.origin if name == pair.a else paper.poses[known].origin
    bar = Bar(start, end, name)
    return pose, Step("lay off", "travel", strokes=(bar,), pairs=(pair.key,), mm=abs(value) * paper.mm)


def _arcs(gap: float, poses: list[Poses], steps: Callable[[int], Steps], cross: float | None = None) -> Intersection:
    """The intersection of loci of which one is an arc; ``gap`` is the square of the sine of their crossing angle,
    negative where they miss."""
    return Intersection(gap, math.sqrt(max(gap, 0.0)), tuple(poses), steps, cross)


def _rrr(paper: PlacedLinks, dyad: Dyad, first: RigidBody, second: RigidBody) -> Intersection:
    """Arcs about both outer hinges meet in the inner hinge.  The sine of the angle between the bars is twice the area
    of the triangle over r1 r2, the area by Heron's formula in the order that loses no figures (Kahan)."""
    letter, about = dyad.inner.point, (dyad.outer_first.point, dyad.outer_second.point)
    (p1, local1), (p2, local2) = first.hinge(dyad.outer_first), second.hinge(dyad.outer_second)
    inner1, inner2 = first.point(letter), second.point(letter)
    r1, r2 = paper.instrument.compass(abs(inner1 - local1)), paper.instrument.compass(abs(inner2 - local2))
    if r1 == 0.0 or r2 == 0.0:
        return LOST
    lo, mid, hi = sorted((r1, r2, abs(p2 - p1)))
    product = (hi + (mid + lo)) * (lo - (hi - mid)) * (lo + (hi - mid)) * (hi + (mid - lo))
    places = cross_arcs(p1, r1, p2, r2) or ()

    def steps(k: int) -> Steps:
        arcs = CompassArc(p1, r1, places[k]), CompassArc(p2, r2, places[k])
        return (Step("cross", "arcs", strokes=arcs, points=about, point=letter, radii=(r1, r2)),)

    poses: list[Poses] = [
        {**first.through((local1, inner1), (p1, q)), **second.through((local2, inner2), (p2, q))} for q in places
    ]
    return _arcs(product / (2 * r1 * r2) ** 2, poses, steps)


def _rrp(paper: PlacedLinks, dyad: Dyad, first: RigidBody, second: RigidBody) -> Intersection:
    """An arc about the outer hinge meets the path of the inner hinge, parallel to the outer guide, which passes the
    outer hinge at the distance h: they cross with the sine sqrt(1 - h^2 / r^2)."""
    letter, outer, slide = dyad.inner.point, dyad.outer_first, dyad.outer_second
    (p, local), (start, step) = first.hinge(outer), second.rail(slide)
    inner, q0 = first.point(letter), start.place(second.point(letter))
    radius = paper.instrument.compass(abs(inner - local))
    if radius == 0.0:
        return LOST
    distance = abs(cross(p - q0, step))
    places = cross_line_arc(q0, step, p, radius) or ()

    def steps(k: int) -> Steps:
        path, arc = Bar(q0, places[k], ""), CompassArc(p, radius, places[k])
        return (
            Step("line", "path", strokes=(path,), point=letter, pairs=(slide.key,)),
            Step("cross", "arc on path", strokes=(arc,), points=(outer.point,), point=letter, mm=radius),
        )

    poses: list[Poses] = [
        {**first.through((local, inner), (p, q)), **second.shifted(start, dot(q - q0, step) * step)} for q in places
    ]
    return _arcs((radius - distance) * (radius + distance) / radius**2, poses, steps)


def _rpr(paper: PlacedLinks, dyad: Dyad, first: RigidBody, second: RigidBody) -> Intersection:
    """The guide passes one pivot at a distance e and goes through the other, or parallel to it: a tangent to a circle
    about the pivot, found by the circle over the distance d of both (Thales); its foot lies sqrt(d^2 - e^2) away."""
    slide, pivots = dyad.inner, (dyad.outer_second.point, dyad.outer_first.point)
    (p1, local1), (p2, local2) = first.hinge(dyad.outer_first), second.hinge(dyad.outer_second)
    # the sliding body as seen from the guiding one, at travel 0
    at_zero = across(slide, slide.a, second.rel[slide.b], 0.0, paper.mm)
    turn = at_zero.axis * first.rel[slide.a].axis.conjugate()
    g = second.rel[slide.b].axis * slide.guide.direction
    c0 = at_zero.origin + turn * (local1 - first.rel[slide.a].origin) - local2
    offset = cross(g, c0)  # of the pivot from the guide's parallel through the other pivot
    if abs(offset) > 1e-9 * abs(c0):
        offset = paper.instrument.compass(offset)
    span = abs(p1 - p2)
    size = max((abs(z) * paper.mm for link in paper.links.values() for z in link.points.values()), default=0.0) or 1.0
    square = (span - abs(offset)) * (span + abs(offset))
    roots = (math.sqrt(square), -math.sqrt(square)) if square >= 0.0 and span > 0.0 else ()
    lined = abs(offset) < 1e-9 * size  # through both pivots
    axes = [unit((p1 - p2) / (g * complex(root, offset))) for root in roots]

    def steps(k: int) -> Steps:
        if lined:
            return (Step("line", "guide", strokes=(Bar(p2, p1, ""),), points=pivots, pairs=(slide.key,)),)
        # foot of the square from the pivot to the guide's parallel through the other pivot
        foot = p1 - axes[k] * g * roots[k]
        strokes = CompassArc((p1 + p2) / 2, span / 2, foot), CompassArc(p2, abs(offset), foot), Bar(foot, p1, "")
        return (Step("line", "tangent", strokes=strokes, points=pivots, mm=abs(offset), pairs=(slide.key,)),)

    poses: list[Poses] = []
    for axis in axes:
        turned = unit(axis * turn)
        sliding, guiding = Pose(p1 - turned * local1, turned), Pose(p2 - axis * local2, axis)
        poses.append({**first.placed(sliding), **second.placed(guiding)})
    return _arcs(square / size**2, poses, steps, 1.0 if lined or not roots else roots[0] / span)


def _prp(paper: PlacedLinks, dyad: Dyad, first: RigidBody, second: RigidBody) -> Intersection:
    """The paths of the inner hinge, each parallel to an outer guide, cross in it."""
    letter, slides = dyad.inner.point, (dyad.outer_first, dyad.outer_second)
    (start1, step1), (start2, step2) = first.rail(slides[0]), second.rail(slides[1])
    q1, q2 = start1.place(first.point(letter)), start2.place(second.point(letter))
    sine, q = cross(step1, step2), cross_lines(q1, step1, q2, step2)
    if q is None:
        return LOST
    poses = {**first.shifted(start1, q - q1), **second.shifted(start2, q - q2)}
    crossing = Step("cross", "paths", strokes=(Bar(q1, q, ""), Bar(q2, q, "")), point=letter,
                    pairs=(slides[0].key, slides[1].key))
    return Intersection(sine, abs(sine), (poses,), lambda _: (crossing,))


def _rpp(paper: PlacedLinks, dyad: Dyad, first: RigidBody, second: RigidBody) -> Intersection:
    """The second body is pushed along its outer guide until the inner guide passes the outer hinge, or the sliding
    point is at it: the displacement is split along both guides."""
    outer, inner, slide = dyad.outer_first, dyad.inner, dyad.outer_second
    (p, local), (start, step) = first.hinge(outer), second.rail(slide)
    resting = second.placed(start)
    mine, other = (inner.a, inner.b) if inner.a in first.rel else (inner.b, inner.a)
    at_zero = across(inner, mine, resting[other], 0.0, paper.mm)
    axis = unit(at_zero.axis * first.rel[mine].axis.conjugate())
    hung = first.placed(Pose(p - axis * local, axis))
    along = unit(inner.along(resting if inner.b in second.rel else hung))
    # the second body may shift by s * step, and along the guide: s * step = want - t * along
    want, sine = hung[mine].origin - at_zero.origin, cross(step, along)
    if sine == 0.0:
        return LOST
    shift = step * (cross(want, along) / sine)
    base = p - want
    strokes = (Bar(base, base + shift, ""), Bar(base + shift, p, ""))
    crossing = Step("cross", "guide to point", strokes=strokes, point=outer.point, pairs=(slide.key, inner.key))
    return Intersection(sine, abs(sine), ({**hung, **second.shifted(start, shift)},), lambda _: (crossing,))


# The one place in this room where the kinds of dyads are told apart.
_INTERSECTIONS: Mapping[DyadKind, Callable[[PlacedLinks, Dyad, RigidBody, RigidBody], Intersection]] = {
    "RRR": _rrr,
    "RRP": _rrp,
    "RPR": _rpr,
    "PRP": _prp,
    "RPP": _rpp,
}


def meet(paper: PlacedLinks, dyad: Dyad) -> Intersection:
    """Draw the loci of a dyad and find their intersection."""
    return _INTERSECTIONS[dyad.kind](paper, dyad, RigidBody(paper, dyad.first), RigidBody(paper, dyad.second))


def met_near(paper: PlacedLinks, dyad: Dyad, guess: Poses, before: Poses | None = None) -> Poses | None:
    """The assembly of a dyad nearest to a guess.

    ``before`` are the poses from which all links are followed: the dyad keeps the assembly that it has in them, and
    there is none where the guess does not tell the two clearly; only a short step passes from one to the other, where
    they meet, or comes near to a dead point.
    """
    intersection = meet(paper, dyad)
    branch = intersection.nearest(guess)
    if branch is None:
        return None
    poses = intersection.poses[branch]
    if before is not None and len(intersection.poses) > 1 and moved(poses, before) > MEETING:
        other = intersection.poses[1 - branch]
        kept = meet(replace(paper, poses=dict(before)), dyad).nearest(before)
        if branch != kept or apart(poses, guess) > TOLD * apart(other, guess):
            return None
    return poses


def meeting(structure: Structure, paper: PlacedLinks, dyad: Dyad) -> Intersection:
    """The intersection of the loci of a dyad that must be placed.

    Raises
    ------
    Unsolvable : the loci miss each other ("not assembled") or only touch ("dead point"); those drawn by hand miss where
        those of the mechanism meet
    """
    intersection = meet(paper, dyad)
    missed = intersection.gap < -1e-14 and not dyad.is_two_lines
    if missed or not intersection.poses or intersection.sine < DEAD:
        said = "the two loci of the group do not" if missed else "the group stands at a dead point its"
        wanted = "choose a driver value at which the mechanism" if missed else "move the driver off this position"
        if missed and not paper.instrument.faultless:
            said, wanted = "so near a dead point the drawn loci", "draw exactly with another seed or"
        problem = Problem(named_with_contact(structure, dyad), Phrase(said, kind=dyad.kind), Phrase(wanted))
        raise Unsolvable("not assembled" if missed else "dead point", problem)
    return intersection


def stuck(status: str, subject: Phrase, said: str) -> Unsolvable:
    """The error of links that cannot be placed or drawn, by the key of its phrase."""
    return Unsolvable(status, Problem(subject, Phrase(said)))


RolledValue = Callable[[RollingRelation], float]
Choose = Callable[[int, Dyad | LargerGroup], Poses | None]
"""Where the links of a group lie, by its place among the elements; None where they cannot be placed."""


def assemble(
    paper: PlacedLinks, elements: Sequence[Element], choose: Choose, rolled: RolledValue | None = None
) -> Iterator[Element]:
    """Place links element by element, yielding each placed element; it ends where an element cannot be placed.

    Parameters
    ----------
    choose : function that chooses among the possible places of a group's links
    rolled : the values of rolling links (rad, m), if the values on paper do not give them
    """
    for i, element in enumerate(elements):
        if isinstance(element, Driven):
            cam = element.lifted
            if rolled is not None and element.rolled is not None:
                paper.values = {**paper.values, element.rolled.key: rolled(element.rolled)}
            elif cam is not None:
                paper.values = {**paper.values, cam.key: cam.follower_at(cmath.phase(paper.poses[cam.link].axis))}
            poses: Poses | None = {element.link: drive(paper, element)[0]}
        else:
            poses = choose(i, element)
        if poses is None:
            return
        paper.poses.update(poses)
        paper.settle(list(poses))
        yield element


def assembled(
    paper: PlacedLinks, elements: Sequence[Element], choose: Choose, rolled: RolledValue | None = None
) -> bool:
    """Place the links of all elements, as `assemble`; whether all could be placed."""
    return len(list(assemble(paper, elements, choose, rolled))) == len(elements)


# from one position to another


def walk(
    near: Callable[[float, Poses, Poses], Poses | None], start: Poses, begin: float, end: float, longest: float,
    shortest: float, surprise: float = math.inf, first: float = 0.0, at_first: float = 0.0,
) -> Iterator[tuple[float, Poses]]:
    """The positions from one to another, each followed from its predecessor; they end with the motion.

    Parameters
    ----------
    near : function of a place of the path, a guess and the position before to the position there; None where the links
        do not fit
    begin, end : places of the path
    longest, shortest, first : the longest step, that below which the motion ends, and the first (the longest if 0)
    surprise, at_first : the allowed distance of a link from its expected place, in the size of the mechanism, and at
        the first step (the same if 0)
    """
    before, at, t = start, start, begin
    step = last = first or longest
    while t < end:
        step = min(step, longest, end - t)
        going = t > begin
        guess = _ahead(before, at, step / last) if going else at
        poses = near(t + step, guess, at)
        allowed = surprise if going else at_first or surprise
        if poses is None or moved(guess, poses) > allowed + (0.3 * moved(at, poses) if going else 0.0):
            step /= 2
            if step < shortest:
                return
            continue
        before, at, t, last = at, poses, (end if step >= end - t else t + step), step
        step *= 2
        yield t, at


def _ahead(before: Poses, at: Poses, times: float) -> dict[str, Pose]:
    """The next position if all links move on as in the last step."""
    made = {}
    for name, pose in at.items():
        old = before[name]
        axis = pose.axis * cmath.rect(1.0, cmath.phase(pose.axis / old.axis) * times)
        made[name] = Pose(pose.origin + (pose.origin - old.origin) * times, axis / abs(axis))
    return made


def moved(poses: Poses, other: Poses, size: float = 1.0) -> float:
    """The greatest displacement of a link (in the size of the mechanism, and of its direction)."""
    changes = (abs(p.origin - other[n].origin) / size + abs(p.axis - other[n].axis) for n, p in poses.items())
    return max(changes, default=0.0)
