"""Where links stand that roll, read off paper: angles and travels, and how far they have gone since elsewhere."""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

from graphkin.construction.rigid import PlacedLinks, Poses
from graphkin.plane import dot
from graphkin.structure import Rolled, Structure
from graphkin.structure.model import Coordinate

__all__ = ["coordinate_on_paper", "rolled_near"]

TURNS = 3
"""Turns that what something rolls on may have made since the position from which it is followed."""


def rolled_near(structure: Structure, frame: PlacedLinks, driver: Rolled, start: Poses, guess: Poses) -> float:
    """The value of what rolls (rad, m) in a position that is being placed, by how far what it rolls on has gone since
    a position ``start`` within some turns; nearest to where it is expected."""
    before, near = (replace(frame, poses=dict(poses)) for poses in (start, guess))
    value, turns = coordinate_on_paper(structure, before, driver.coordinate), [0.0]
    for coordinate, factor in driver.factors:
        here, there = (coordinate_on_paper(structure, placed, coordinate) for placed in (frame, before))
        value += factor * (here - there)
        if coordinate[0] == "angle":
            turns = [more + k * math.tau * factor for more in turns for k in range(-TURNS, TURNS + 1)]
    wanted = coordinate_on_paper(structure, near, driver.coordinate)

    def off(whole: float) -> float:
        far = value + whole - wanted
        return abs(math.remainder(far, math.tau) if driver.turns else far)

    # of several that fit as well the one with the fewest turns
    return value + min(turns, key=lambda whole: (round(off(whole), 9), abs(whole)))


def coordinate_on_paper(structure: Structure, frame: PlacedLinks, coordinate: Coordinate) -> float:
    """An angle within a turn (rad), or a travel (m)."""
    kind, name = coordinate
    if kind == "angle":
        return cmath.phase(frame.poses[name].axis)
    slide = structure.slide(name)
    along = frame.poses[slide.b].axis * slide.guide.direction
    return dot(frame.poses[slide.a].origin - frame.place(slide.b, slide.guide.through), along) / frame.mm
