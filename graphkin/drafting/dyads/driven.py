"""A driven link: the angle or the travel is laid off."""

from __future__ import annotations

import math

from graphkin.drafting.dyads.frame import Frame
from graphkin.drafting.dyads.meeting import Story
from graphkin.drafting.dyads.rigid import across
from graphkin.drafting.sheet import Bar, Pose
from graphkin.plane import direction, unit
from graphkin.scene.model import AngleDriver
from graphkin.structure import Driven, Slide, Turn
from graphkin.words import Phrase

__all__ = ["drive"]


def drive(frame: Frame, element: Driven) -> tuple[Pose, Story]:
    """Place a driven link: the angle or the travel is laid off."""
    name, driver, pair = element.link, element.driver, element.pair
    value = frame.values[driver.key]
    if isinstance(driver, AngleDriver):
        own = driver.link == name
        other = driver.relative_to if own else driver.link
        axis = unit(frame.poses[other].axis * frame.instrument.angle(direction(math.degrees(value if own else -value))))
        assert isinstance(pair, Turn)
        hinge = frame.point(pair.b, pair.point)
        pose = Pose(hinge - axis * (frame.links[name].points[pair.point] * frame.mm), axis)
        angle = f"{math.degrees(value):.6g}"
        return pose, ((Phrase("lay off angle", (name, angle, pair.point)), ()),)
    assert isinstance(pair, Slide)
    known = pair.b if name == pair.a else pair.a
    pose = across(pair, name, frame.poses[known], frame.instrument.length(value * frame.mm), frame.mm)
    start = frame.place(pair.b, pair.guide.through) if name == pair.a else pose.origin
    end = pose.origin if name == pair.a else frame.poses[known].origin
    return pose, ((Phrase("lay off travel", (pair.key, f"{abs(value) * frame.mm:.2f}")), (Bar(start, end, name),)),)
