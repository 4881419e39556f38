"""Where the links of a group lie: compass arcs and ruler lines that meet, for each kind of dyad.

All lengths in mm on paper.  For each kind a function returns a `Meeting`: how well the two loci cross, the possible
places of the links, and for each what was drawn.  A driven link: the angle or the travel is laid off.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from graphkin.construction.links_on_paper import (
    PlacedLinks,
    Pose,
    Poses,
    RigidBody,
    across,
    apart,
    hinge,
    inner_hinge,
    rail,
)
from graphkin.construction.steps import Bar, CompassArc, Step
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, cross_arcs, cross_line_arc, cross_lines, direction, dot, unit
from graphkin.scene.model import Driver
from graphkin.structure import (
    Driven,
    Dyad,
    DyadKind,
    Element,
    LargerGroup,
    Rolled,
    Structure,
    named_with_contact,
    pick,
)
from graphkin.words import Phrase

__all__ = ["Choose", "Meeting", "Story", "assemble", "assembled", "drive", "meant", "meet", "refuse"]

DEAD = 1e-7  # sine of a crossing below which a group is at a dead point

Story = tuple[Step, ...]


@dataclass(frozen=True)
class Meeting:
    """Two loci that meet.

    ``gap`` is positive where they cross, zero where they touch, negative where they miss each other; for two lines
    it is the sine of their angle, and they meet once.  ``poses`` are the possible places of the group's links, the one
    of the default rule first; ``tell`` gives what is drawn for each.  ``sine`` of the crossing angle is 0 where the
    crossing is lost; a guide between two pivots is lost as they fall together, at whatever angle its lines
    ``cross``.
    """

    gap: float
    sine: float
    poses: tuple[Poses, ...]
    tell: Callable[[int], Story]
    cross: float | None = None

    @property
    def sharpness(self) -> float:
        """Sine of the angle at which the two loci cross on paper."""
        return min(1.0, self.sine if self.cross is None else self.cross)

    def nearest(self, poses: Poses) -> int | None:
        """Which of the possible places lies nearest to where the links are expected; None where there is none."""
        return min(range(len(self.poses)), key=lambda k: apart(self.poses[k], poses), default=None)


def _nothing(_: int) -> Story:
    return ()


def drive(paper: PlacedLinks, element: Driven) -> tuple[Pose, Story]:
    """Place a driven link: the angle or the travel is laid off."""
    name, driver, pair = element.link, element.driver, element.pair
    value = paper.values[driver.key]
    if driver.turns:
        own, to, base = True, "", 1 + 0j
        if isinstance(driver, Driver):
            own = driver.link == name
            to = driver.relative_to if own else driver.link
            base = paper.poses[to].axis
        axis = unit(base * paper.instrument.angle(direction(math.degrees(value if own else -value))))
        hinge = paper.point(pair.b, pair.point)
        pose = Pose(hinge - axis * (paper.links[name].points[pair.point] * paper.mm), axis)
        value = value if own else -value
        return pose, (Step("lay off", "angle", link=name, value=value, point=pair.point, base=to),)
    known = pair.b if name == pair.a else pair.a
    pose = across(pair, name, paper.poses[known], paper.instrument.length(value * paper.mm), paper.mm)
    start = paper.place(pair.b, pair.guide.through) if name == pair.a else pose.origin
    end = pose.origin if name == pair.a else paper.poses[known].origin
    bar = Bar(start, end, name)
    return pose, (Step("lay off", "travel", strokes=(bar,), pairs=(pair.key,), mm=abs(value) * paper.mm),)


def _rrr(paper: PlacedLinks, dyad: Dyad, one: RigidBody, two: RigidBody) -> Meeting:
    outer1, outer2 = dyad.outer_first, dyad.outer_second
    (p1, local1), (p2, local2) = hinge(paper, one, outer1), hinge(paper, two, outer2)
    letter, inner1, inner2 = inner_hinge(paper, dyad, one, two)
    r1, r2 = paper.instrument.compass(abs(inner1 - local1)), paper.instrument.compass(abs(inner2 - local2))
    if r1 == 0.0 or r2 == 0.0:
        return Meeting(0.0, 0.0, (), _nothing)  # an arc of no radius finds nothing
    lo, mid, hi = sorted((r1, r2, abs(p2 - p1)))
    product = (hi + (mid + lo)) * (lo - (hi - mid)) * (lo + (hi - mid)) * (hi + (mid - lo))
    gap = product / (2 * r1 * r2) ** 2
    places = cross_arcs(p1, r1, p2, r2) or ()
    poses = [{**one.through((local1, inner1), (p1, q)), **two.through((local2, inner2), (p2, q))} for q in places]

    def tell(k: int) -> Story:
        arcs = CompassArc(p1, r1, places[k]), CompassArc(p2, r2, places[k])
        about = outer1.point, outer2.point
        return (Step("cross", "arcs", strokes=arcs, points=about, point=letter, radii=(r1, r2)),)

    return Meeting(gap, math.sqrt(max(gap, 0.0)), tuple(poses), tell)


def _rrp(paper: PlacedLinks, dyad: Dyad, one: RigidBody, two: RigidBody) -> Meeting:
    outer, slide = dyad.outer_first, dyad.outer_second
    p, local = hinge(paper, one, outer)
    letter, inner1, inner2 = inner_hinge(paper, dyad, one, two)
    start, step = rail(paper, two, slide)
    q0 = start.place(inner2)
    radius = paper.instrument.compass(abs(inner1 - local))
    if radius == 0.0:
        return Meeting(0.0, 0.0, (), _nothing)
    off = abs(cross(p - q0, step))
    gap = (radius - off) * (radius + off) / radius**2
    places = cross_line_arc(q0, step, p, radius) or ()
    poses = []
    for q in places:
        moved = Pose(start.origin + dot(q - q0, step) * step, start.axis)
        poses.append({**one.through((local, inner1), (p, q)), **two.placed(moved)})

    def tell(k: int) -> Story:
        q = places[k]
        arc = CompassArc(p, radius, q)
        return (
            Step("line", "path", strokes=(Bar(q0, q, ""),), point=letter, pairs=(slide.key,)),
            Step("cross", "arc on path", strokes=(arc,), points=(outer.point,), point=letter, mm=radius),
        )

    return Meeting(gap, math.sqrt(max(gap, 0.0)), tuple(poses), tell)


def _rpr(paper: PlacedLinks, dyad: Dyad, one: RigidBody, two: RigidBody) -> Meeting:
    outer1, slide, outer2 = dyad.outer_first, dyad.inner, dyad.outer_second
    (p1, local1), (p2, local2) = hinge(paper, one, outer1), hinge(paper, two, outer2)
    # the sliding body as seen from the guiding one, at travel 0
    at_zero = across(slide, slide.a, two.rel[slide.b], 0.0, paper.mm)
    turn = at_zero.axis * one.rel[slide.a].axis.conjugate()
    g = two.rel[slide.b].axis * slide.guide.direction
    c0 = at_zero.origin + turn * (local1 - one.rel[slide.a].origin) - local2
    offset = cross(g, c0)  # of the pivot from the guide's parallel through the other pivot
    if abs(offset) > 1e-9 * abs(c0):
        offset = paper.instrument.compass(offset)
    span = abs(p1 - p2)
    size = max((abs(z) * paper.mm for link in paper.links.values() for z in link.points.values()), default=0.0) or 1.0
    gap = (span - abs(offset)) * (span + abs(offset)) / size**2
    poses = []
    roots: tuple[float, ...] = ()
    if gap >= 0.0 and span > 0.0:
        half = math.sqrt((span - abs(offset)) * (span + abs(offset)))
        roots = half, -half
    for root in roots:
        axis2 = unit((p1 - p2) / (g * complex(root, offset)))
        axis1 = unit(axis2 * turn)
        pose1, pose2 = Pose(p1 - axis1 * local1, axis1), Pose(p2 - axis2 * local2, axis2)
        poses.append({**one.placed(pose1), **two.placed(pose2)})

    def tell(k: int) -> Story:
        pivots = outer2.point, outer1.point
        if abs(offset) < 1e-9 * size:
            return (Step("line", "guide", strokes=(Bar(p2, p1, ""),), points=pivots, pairs=(slide.key,)),)
        # foot of the square from the pivot to the guide's parallel through the other pivot
        foot = p1 - unit((p1 - p2) / (g * complex(roots[k], offset))) * g * roots[k]
        strokes = CompassArc((p1 + p2) / 2, span / 2, foot), CompassArc(p2, abs(offset), foot), Bar(foot, p1, "")
        return (Step("line", "tangent", strokes=strokes, points=pivots, mm=abs(offset), pairs=(slide.key,)),)

    angle = roots[0] / span if roots and abs(offset) >= 1e-9 * size else 1.0  # a line through both pivots crosses none
    return Meeting(gap, math.sqrt(max(gap, 0.0)), tuple(poses), tell, angle)


def _prp(paper: PlacedLinks, dyad: Dyad, one: RigidBody, two: RigidBody) -> Meeting:
    slide1, slide2 = dyad.outer_first, dyad.outer_second
    letter, inner1, inner2 = inner_hinge(paper, dyad, one, two)
    (start1, step1), (start2, step2) = rail(paper, one, slide1), rail(paper, two, slide2)
    q1, q2 = start1.place(inner1), start2.place(inner2)

    def placed(q: complex) -> dict[str, Pose]:
        moved1 = Pose(start1.origin + (q - q1), start1.axis)
        moved2 = Pose(start2.origin + (q - q2), start2.axis)
        return {**one.placed(moved1), **two.placed(moved2)}

    step = Step("cross", "paths", point=letter, pairs=(slide1.key, slide2.key))
    return _two_lines((q1, step1), (q2, step2), placed, step)


def _rpp(paper: PlacedLinks, dyad: Dyad, one: RigidBody, two: RigidBody) -> Meeting:
    outer, inner, slide = dyad.outer_first, dyad.inner, dyad.outer_second
    p, local = hinge(paper, one, outer)
    start, step = rail(paper, two, slide)
    resting = two.placed(start)
    sliding_first = inner.a in one.rel
    mine, other = (inner.a, inner.b) if sliding_first else (inner.b, inner.a)
    at_zero = across(inner, mine, resting[other], 0.0, paper.mm)
    axis = unit(at_zero.axis * one.rel[mine].axis.conjugate())
    pose1 = Pose(p - axis * local, axis)
    guiding = resting if sliding_first else one.placed(pose1)
    along = unit(guiding[inner.b].axis * inner.guide.direction)
    # where the guiding side would have to be: the second body may shift by s * step, and along the guide
    want = one.placed(pose1)[mine].origin - at_zero.origin

    def placed(shift: complex) -> dict[str, Pose]:
        return {**one.placed(pose1), **two.placed(Pose(start.origin + shift, start.axis))}

    # shift = s * step = want - t * along
    sine = cross(step, along)
    if sine == 0.0:
        return Meeting(0.0, 0.0, (), _nothing)
    shift = step * (cross(want, along) / sine)
    base = p - want
    strokes = (Bar(base, base + shift, ""), Bar(base + shift, p, ""))
    told = Step("cross", "guide to point", strokes=strokes, point=outer.point, pairs=(slide.key, inner.key))
    return Meeting(sine, abs(sine), (placed(shift),), lambda _: (told,))


def _two_lines(
    one: tuple[complex, complex],
    two: tuple[complex, complex],
    placed: Callable[[complex], Mapping[str, Pose]],
    step: Step,
) -> Meeting:
    sine = cross(one[1], two[1])
    q = cross_lines(*one, *two)
    if q is None:
        return Meeting(0.0, 0.0, (), _nothing)
    told = replace(step, strokes=(Bar(one[0], q, ""), Bar(two[0], q, "")))
    return Meeting(sine, abs(sine), (placed(q),), lambda _: (told,))


# The one place in this room where the kinds of dyads are told apart.
_MEETINGS: Mapping[DyadKind, Callable[[PlacedLinks, Dyad, RigidBody, RigidBody], Meeting]] = {
    "RRR": _rrr,
    "RRP": _rrp,
    "RPR": _rpr,
    "PRP": _prp,
    "RPP": _rpp,
}


def meet(paper: PlacedLinks, dyad: Dyad) -> Meeting:
    """Draw the loci of a dyad and find where they meet."""
    return _MEETINGS[dyad.kind](paper, dyad, RigidBody(paper, dyad.first), RigidBody(paper, dyad.second))


def refuse(structure: Structure, element: Dyad, meeting: Meeting) -> None:
    """Raise Unsolvable where the loci of a dyad miss each other ("not assembled") or only touch ("dead point")."""
    names = named_with_contact(structure, element)
    if meeting.gap < -1e-14 and not element.is_two_lines:
        raise Unsolvable(
            "not assembled",
            Problem(
                names,
                Phrase("the two loci of the group do not", kind=element.kind),
                Phrase("choose a driver value at which the mechanism"),
            ),
        )
    if not meeting.poses or meeting.sine < DEAD:
        raise Unsolvable(
            "dead point",
            Problem(
                names,
                Phrase("the group stands at a dead point its", kind=element.kind),
                Phrase("move the driver off this position"),
            ),
        )


def meant(structure: Structure, paper: PlacedLinks, dyad: Dyad) -> Poses:
    """The assembly of a dyad that the scene means at its own position.

    Raises
    ------
    Unsolvable : as `refuse`
    SceneError : a sketch that fits none
    """
    meeting = meet(paper, dyad)
    refuse(structure, dyad, meeting)
    candidates = [paper.fresh(poses) for poses in meeting.poses]
    return meeting.poses[pick(structure.scene, dyad.links, candidates, 0).index]


Choose = Callable[[int, Dyad | LargerGroup], Poses | None]
"""Where the links of a group lie, by its place among the elements; None where they cannot be placed."""


def assemble(
    paper: PlacedLinks, elements: Sequence[Element], choose: Choose, rolled: Callable[[Rolled], float] | None = None
) -> Iterator[Element]:
    """Place links element by element, each of which is given once it stands; ends where one cannot be placed.

    Parameters
    ----------
    choose : which of the possible places the links of a group take
    rolled : how far what rolls has gone (rad, m), where the values on paper do not tell
    """
    for i, element in enumerate(elements):
        if isinstance(element, Driven):
            if rolled is not None and isinstance(element.driver, Rolled):
                paper.values = {**paper.values, element.driver.key: rolled(element.driver)}
            poses: Poses | None = {element.link: drive(paper, element)[0]}
        else:
            poses = choose(i, element)
        if poses is None:
            return
        paper.poses.update(poses)
        paper.settle(list(poses))
        yield element


def assembled(
    paper: PlacedLinks, elements: Sequence[Element], choose: Choose, rolled: Callable[[Rolled], float] | None = None
) -> bool:
    """Place the links of all elements, as `assemble`; whether they could be."""
    return len(list(assemble(paper, elements, choose, rolled))) == len(elements)
