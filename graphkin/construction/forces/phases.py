"""Which loads act at a position, and which begin or end exactly there, by what is drawn."""

from __future__ import annotations

import math

from graphkin.construction.forces.images import Images
from graphkin.construction.rigid import Poses
from graphkin.construction.sheet import Sheet
from graphkin.plane import dot
from graphkin.scene.loads import Phase
from graphkin.scene.model import AngleDriver
from graphkin.scene.symbol import Symbol
from graphkin.structure import Slide, Structure

__all__ = ["acting_loads", "against", "strokes_of_loads"]

EDGE = 1e-9
"""Of the stroke or the turn: a load that begins or ends within this of a position does so exactly there."""
STILL = 1e-11
"""Of the greatest speed: what slides more slowly rests."""


def strokes_of_loads(structure: Structure) -> tuple[Symbol, ...]:
    """The strokes on parts of which loads act."""
    keys = dict.fromkeys(load.phase.stroke for load in structure.scene.loading.loads if load.phase is not None)
    found = []
    for key in keys:
        if key:
            sliding, _, guiding = key.partition("/")
            found.append(Symbol("stroke", link=sliding, other=guiding))
    return tuple(found)


def acting_loads(sheet: Sheet, growing: Sheet) -> dict[str, bool | None]:
    """For each load whether it acts; None where it begins or ends exactly here.

    Parameters
    ----------
    sheet : the position, with the limit positions of the strokes of loads
    growing : the same with velocities, those of the driver's growing value where the mechanism rests
    """
    return {load.name: _acts(sheet, growing, load.phase) for load in sheet.scene.loading.loads}


def _acts(sheet: Sheet, growing: Sheet, phase: Phase | None) -> bool | None:
    if phase is None:
        return True
    if phase.stroke:
        return _on_stroke(sheet, growing, phase)
    driver = sheet.scene.drivers[0]
    value = sheet.drivers[driver.key]
    if not isinstance(driver, AngleDriver):
        edge = EDGE * (phase.end - phase.start)
        if min(abs(value - phase.start), abs(value - phase.end)) < edge:
            return None
        return phase.start < value < phase.end
    turn, span = math.tau, phase.end - phase.start
    if span >= turn * (1 - EDGE):
        return True
    since = (value - phase.start) % turn
    if min(since, turn - since, abs(since - span)) < EDGE * turn:
        return None
    return since < span


def _on_stroke(sheet: Sheet, growing: Sheet, phase: Phase) -> bool | None:
    slide = sheet.structure.slide(phase.stroke)
    limits = sheet.limits[phase.stroke]
    here, low, high = (_travel(slide, poses) for poses in (sheet.poses, limits.low.poses, limits.high.poses))
    part = (here - low) / (high - low) if high > low else 0.0
    if phase.sense < 0:
        part = 1.0 - part
    slip, most = Images(growing).slip(slide)
    running = abs(slip) > STILL * most and (slip > 0) == (phase.sense > 0)
    for edge in (phase.start, phase.end):
        # where the slide turns back both senses meet
        if abs(part - edge) < EDGE and (running or edge < EDGE or edge > 1.0 - EDGE):
            return None
    return running and phase.start < part < phase.end


def _travel(slide: Slide, poses: Poses) -> float:
    guide = poses[slide.b]
    return dot(poses[slide.a].origin - guide.origin, guide.axis * slide.guide.direction)


def against(growing: Sheet, pair: str) -> tuple[complex, float]:
    """The direction of a guide, and the sense (1, -1, or 0 at rest) in which the pair slides along it."""
    images, slide = Images(growing), growing.structure.slide(pair)
    slip, most = images.slip(slide)
    return images.along(slide), 0.0 if abs(slip) <= STILL * most else math.copysign(1.0, slip)
