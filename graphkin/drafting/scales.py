"""The scales of a sheet: the scene's own, or those of the 1-2-2.5-5 series that fill the paper."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from graphkin.drafting.polygons import Polygons
from graphkin.drafting.sheet import Scales

__all__ = ["Room", "chosen_scales"]

SERIES = (1.0, 2.0, 2.5, 5.0)


@dataclass(frozen=True)
class Room:
    """Width and height (mm) that the mechanism and each polygon may fill; ``larger`` are rooms that the mechanism has
    instead where it can be drawn twice as large in them, the first such."""

    mechanism: tuple[float, float] = (150.0, 150.0)
    polygon: tuple[float, float] = (140.0, 140.0)
    larger: tuple[tuple[float, float], ...] = ()


def chosen_scales(polygons: Polygons, room: Room | None) -> Scales:
    """The scene's own scales, and for those it does not give the finest of the series that fit the room."""
    scene, trial = polygons.structure.scene, polygons.scales
    wishes, unit = scene.sheet, scene.units.metres
    space = room or Room()
    tips = {
        order: [0j, *(z for v in polygons.drawn[order].values() for z in (v.tail, v.tip))]
        for order in ("velocity", "acceleration")
    }
    spots = list(polygons.places.values())
    rooms = (space.mechanism, *space.larger)
    lengths = [_fit(spots, room_of_it, trial.length * 1e3) * 1e-3 for room_of_it in rooms]
    length = next((finer for finer in lengths if 2.0 * finer <= lengths[0] * (1 + 1e-9)), lengths[0])
    velocity = _fit(tips["velocity"], space.polygon, 1.0 / unit) * unit
    acceleration = _fit(tips["acceleration"], space.polygon, 1.0 / unit) * unit
    if room is None:
        length = wishes.length_scale * 1e-3 if wishes.length_scale else length
        velocity = wishes.velocity_scale * unit if wishes.velocity_scale else velocity
        acceleration = wishes.acceleration_scale * unit if wishes.acceleration_scale else acceleration
    return Scales(length, velocity, acceleration)


def _fit(points: Sequence[complex], room: tuple[float, float], per_mm: float) -> float:
    """The finest scale of the series at which points given at ``per_mm`` fit the room; 1 if they span nothing."""
    if not points:
        return 1.0
    width = max(z.real for z in points) - min(z.real for z in points)
    height = max(z.imag for z in points) - min(z.imag for z in points)
    least = max(width / room[0], height / room[1]) * per_mm
    if not math.isfinite(least) or least <= 0.0:
        return 1.0
    decade = 10.0 ** math.floor(math.log10(least))
    for step in (*SERIES, 10.0):
        if step * decade >= least * (1 - 1e-12):
            return float(f"{step * decade:.12g}")
    return 10.0 * decade
