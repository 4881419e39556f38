"""Dyads whose loci are straight lines."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from graphkin.drafting.dyads.frame import Frame
from graphkin.drafting.dyads.meeting import Meeting, Story
from graphkin.drafting.dyads.rigid import RigidBody, across, hinge, inner_hinge, rail
from graphkin.drafting.sheet import Bar, Pose
from graphkin.plane import cross, cross_lines, unit
from graphkin.structure import Dyad, Slide, Turn
from graphkin.words import Phrase

__all__ = ["prp", "rpp"]


def prp(frame: Frame, dyad: Dyad, one: RigidBody, two: RigidBody) -> Meeting:
    slide1, slide2 = dyad.outer_first, dyad.outer_second
    assert isinstance(slide1, Slide)
    assert isinstance(slide2, Slide)
    letter, inner1, inner2 = inner_hinge(frame, dyad, one, two)
    (start1, step1), (start2, step2) = rail(frame, one, slide1), rail(frame, two, slide2)
    q1, q2 = start1.origin + start1.axis * inner1, start2.origin + start2.axis * inner2

    def placed(q: complex) -> dict[str, Pose]:
        moved1 = Pose(start1.origin + (q - q1), start1.axis)
        moved2 = Pose(start2.origin + (q - q2), start2.axis)
        return {**one.placed(moved1), **two.placed(moved2)}

    return _two_lines((q1, step1), (q2, step2), placed, Phrase("paths", (letter, slide1.key, slide2.key)))


def rpp(frame: Frame, dyad: Dyad, one: RigidBody, two: RigidBody) -> Meeting:
    outer, inner, slide = dyad.outer_first, dyad.inner, dyad.outer_second
    assert isinstance(outer, Turn)
    assert isinstance(inner, Slide)
    assert isinstance(slide, Slide)
    p, local = hinge(frame, one, outer)
    start, step = rail(frame, two, slide)
    resting = two.placed(start)
    sliding_first = inner.a in one.rel
    mine, other = (inner.a, inner.b) if sliding_first else (inner.b, inner.a)
    at_zero = across(inner, mine, resting[other], 0.0, frame.mm)
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
        return Meeting(0.0, 0.0, (), (), True)
    shift = step * (cross(want, along) / sine)
    base = p - want
    strokes = (Bar(base, base + shift, ""), Bar(base + shift, p, ""))
    story: Story = ((Phrase("slide to meet", (outer.point, slide.key, inner.key)), strokes),)
    return Meeting(sine, abs(sine), (placed(shift),), (story,), True)


def _two_lines(
    one: tuple[complex, complex],
    two: tuple[complex, complex],
    placed: Callable[[complex], Mapping[str, Pose]],
    phrase: Phrase,
) -> Meeting:
    sine = cross(one[1], two[1])
    q = cross_lines(*one, *two)
    if q is None:
        return Meeting(0.0, 0.0, (), (), True)
    story: Story = ((phrase, (Bar(one[0], q, ""), Bar(two[0], q, ""))),)
    return Meeting(sine, abs(sine), (placed(q),), (story,), True)
