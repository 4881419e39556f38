"""Dyads whose loci are arcs: arc and arc, arc and line, and the circle that a guide touches."""

from __future__ import annotations

import math

from graphkin.drafting.dyads.frame import Frame
from graphkin.drafting.dyads.meeting import Meeting, Story
from graphkin.drafting.dyads.rigid import RigidBody, across, hinge, inner_hinge, rail
from graphkin.drafting.sheet import Arc, Bar, Pose, Stroke
from graphkin.plane import cross, cross_arcs, cross_line_arc, dot, unit
from graphkin.structure import Dyad, Slide, Turn
from graphkin.words import Phrase

__all__ = ["rpr", "rrp", "rrr"]


def rrr(frame: Frame, dyad: Dyad, one: RigidBody, two: RigidBody) -> Meeting:
    outer1, outer2 = dyad.outer_first, dyad.outer_second
    assert isinstance(outer1, Turn)
    assert isinstance(outer2, Turn)
    (p1, local1), (p2, local2) = hinge(frame, one, outer1), hinge(frame, two, outer2)
    letter, inner1, inner2 = inner_hinge(frame, dyad, one, two)
    r1, r2 = frame.instrument.compass(abs(inner1 - local1)), frame.instrument.compass(abs(inner2 - local2))
    lo, mid, hi = sorted((r1, r2, abs(p2 - p1)))
    product = (hi + (mid + lo)) * (lo - (hi - mid)) * (lo + (hi - mid)) * (hi + (mid - lo))
    gap = product / (2 * r1 * r2) ** 2
    places = cross_arcs(p1, r1, p2, r2) or ()
    poses = [{**one.through((local1, inner1), (p1, q)), **two.through((local2, inner2), (p2, q))} for q in places]
    names = (outer1.point, outer2.point, letter, f"{r1:.2f}", f"{r2:.2f}")
    stories: list[Story] = [((Phrase("arcs", names), (Arc(p1, r1, q), Arc(p2, r2, q))),) for q in places]
    return Meeting(gap, math.sqrt(max(gap, 0.0)), tuple(poses), tuple(stories))


def rrp(frame: Frame, dyad: Dyad, one: RigidBody, two: RigidBody) -> Meeting:
    outer, slide = dyad.outer_first, dyad.outer_second
    assert isinstance(outer, Turn)
    assert isinstance(slide, Slide)
    p, local = hinge(frame, one, outer)
    letter, inner1, inner2 = inner_hinge(frame, dyad, one, two)
    start, step = rail(frame, two, slide)
    q0 = start.origin + start.axis * inner2
    radius = frame.instrument.compass(abs(inner1 - local))
    off = abs(cross(p - q0, step))
    gap = (radius - off) * (radius + off) / radius**2
    places = cross_line_arc(q0, step, p, radius) or ()
    poses = []
    stories: list[Story] = []
    for q in places:
        travel = dot(q - q0, step)
        moved = Pose(start.origin + travel * step, start.axis)
        poses.append({**one.through((local, inner1), (p, q)), **two.placed(moved)})
        stories.append(
            (
                (Phrase("path", (letter, slide.key)), (Bar(q0, q, ""),)),
                (Phrase("arc on path", (outer.point, letter, f"{radius:.2f}")), (Arc(p, radius, q),)),
            )
        )
    return Meeting(gap, math.sqrt(max(gap, 0.0)), tuple(poses), tuple(stories))


def rpr(frame: Frame, dyad: Dyad, one: RigidBody, two: RigidBody) -> Meeting:
    outer1, slide, outer2 = dyad.outer_first, dyad.inner, dyad.outer_second
    assert isinstance(outer1, Turn)
    assert isinstance(slide, Slide)
    assert isinstance(outer2, Turn)
    (p1, local1), (p2, local2) = hinge(frame, one, outer1), hinge(frame, two, outer2)
    # the sliding body as seen from the guiding one, at travel 0
    at_zero = across(slide, slide.a, two.rel[slide.b], 0.0, frame.mm)
    turn = at_zero.axis * one.rel[slide.a].axis.conjugate()
    g = two.rel[slide.b].axis * slide.guide.direction
    c0 = at_zero.origin + turn * (local1 - one.rel[slide.a].origin) - local2
    offset = cross(g, c0)  # of the pivot from the guide's parallel through the other pivot
    if abs(offset) > 1e-9 * abs(c0):
        offset = frame.instrument.compass(offset)
    span = abs(p1 - p2)
    size = max((abs(z) * frame.mm for link in frame.links.values() for z in link.points.values()), default=1.0)
    gap = (span - abs(offset)) * (span + abs(offset)) / size**2
    poses = []
    stories: list[Story] = []
    if gap >= 0.0 and span > 0.0:
        half = math.sqrt((span - abs(offset)) * (span + abs(offset)))
        for root in (half, -half):
            reach = g * complex(root, offset)
            axis2 = unit((p1 - p2) / reach)
            pose2 = Pose(p2 - axis2 * local2, axis2)
            axis1 = unit(axis2 * turn)
            pose1 = Pose(p1 - axis1 * local1, axis1)
            poses.append({**one.placed(pose1), **two.placed(pose2)})
            letters = (outer2.point, outer1.point)
            strokes: tuple[Stroke, ...]
            if abs(offset) < 1e-9 * size:
                strokes = (Bar(p2, p1, ""),)
                stories.append(((Phrase("line of guide", (*letters, slide.key)), strokes),))
            else:
                foot = p1 - axis2 * g * root  # foot of the square from the pivot to the guide's parallel through P1
                middle = (p1 + p2) / 2
                strokes = (Arc(middle, span / 2, foot), Arc(p2, abs(offset), foot), Bar(foot, p1, ""))
                stories.append(((Phrase("tangent", (*letters, f"{abs(offset):.2f}", slide.key)), strokes),))
    return Meeting(gap, math.sqrt(max(gap, 0.0)), tuple(poses), tuple(stories))
