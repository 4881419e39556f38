"""Scales of a round series: those that fit a room, and those of a mechanism and its polygons, the scene's own or those
of the 1-2-2.5-5 series that fill the paper."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from graphkin.scene.model import Mechanism
from graphkin.scene.scene_tables import DIAGRAMS, Diagram

SERIES = (1.0, 2.0, 2.5, 5.0)
UNMET = 40.0  # what a wish that a room does not hold costs, as `Room.cost`


def next_of_series(least: float) -> float:
    """The next number of the series 1, 2, 2.5, 5 times a power of ten, the series of scales and divisions.

    >>> next_of_series(0.21), next_of_series(60.0), next_of_series(2.0)
    (0.25, 100.0, 2.0)
    """
    decade = 10.0 ** math.floor(math.log10(least))
    fit = (step * decade for step in (*SERIES, 10.0) if step * decade >= least * (1 - 1e-9))
    return float(f"{next(fit, 10.0 * decade):.12g}")


Rectangle = tuple[float, float]
"""Width and height: of a figure's content (m, m/s, m/s2), or of a room on paper (mm)."""


def extent_of(points: Iterable[complex], per_mm: float) -> Rectangle:
    """The extent of points on paper (mm) at a scale (units for one mm); empty without points."""
    spots = list(points) or [0j]
    x, y = [z.real for z in spots], [z.imag for z in spots]
    return (max(x) - min(x)) * per_mm, (max(y) - min(y)) * per_mm


def least_scale(extent: Rectangle, room: Rectangle) -> float:
    """The scale at which an extent (m, m/s, m/s2, N) just fits a room (mm): the value of one mm of paper."""
    return max(extent[0] / room[0], extent[1] / room[1])


def fitting_scale(extent: Rectangle, room: Rectangle, units: float) -> float:
    """The finest scale of the series at which an extent fits the room, as in `least_scale`, in the unit of which
    ``units`` are one SI unit; 1 if it has no size."""
    least = least_scale(extent, room) * units
    return next_of_series(least) if math.isfinite(least) and least > 0.0 else 1.0


@dataclass(frozen=True)
class Scales:
    """Scale factors: m, m/s, m/s2 and N for one mm of paper; ``force`` is 0 where no forces are drawn."""

    length: float
    velocity: float
    acceleration: float
    force: float = 0.0

    def of(self, diagram: Diagram | Literal["force"]) -> float:
        """The scale of a diagram (m, m/s, m/s2 or N for one mm)."""
        return self.length if diagram == "mechanism" else getattr(self, diagram)

    def shown(self, metres: float, newtons: float) -> dict[str, float]:
        """The value of one mm of paper: of lengths in mm, of rates in a unit of so many metres by second and second
        squared, of forces in one of so many newtons."""
        scales = {"length": self.length * 1e3, "velocity": self.velocity / metres,
                  "acceleration": self.acceleration / metres, "force": self.force / newtons}
        # without the noise of units
        return {name: float(f"{scale:.12g}") for name, scale in scales.items() if name != "force" or scale}


@dataclass(frozen=True, eq=False, repr=False)
class Room:
    """The room that a mechanism and its polygons may fill.

    Parameters
    ----------
    mechanism, polygon : width and height (mm) for the mechanism and for each polygon
    others : rooms that may be taken instead, if their scales are finer by more than their cost
    cost : of taking it, in powers of ten of the scales of all three figures together
    keeps_wishes : whether scales that the scene wishes for are kept in a room that holds them
    """

    mechanism: Rectangle = (150.0, 150.0)
    polygon: Rectangle = (140.0, 140.0)
    others: tuple[Room, ...] = ()
    cost: float = 0.0
    keeps_wishes: bool = False


def chosen_scales(scene: Mechanism, extents: Mapping[Diagram, Rectangle], room: Room | None) -> Scales:
    """The scene's own scales, and for those it does not give the finest of the series that fit the room."""
    fast = scene.units.rates.metres
    sheet = scene.question.sheet
    wanted = sheet.length_scale, sheet.velocity_scale, sheet.acceleration_scale
    wishes = [wish * per if wish else None for wish, per in zip(wanted, (1e-3, fast, fast), strict=True)]
    space = room or Room()
    choices: list[tuple[float, list[float]]] = []
    for part in (space, *space.others):
        cost, scales = part.cost, []
        for name, wish in zip(DIAGRAMS, wishes, strict=True):
            most, unit = (part.mechanism, scene.units.metres) if name == "mechanism" else (part.polygon, fast)
            if wish is not None and (room is None or space.keeps_wishes):
                if room is None or wish * (1 + 1e-9) >= least_scale(extents[name], most):
                    scales.append(wish)
                    continue
                cost += UNMET
            scales.append(fitting_scale(extents[name], most, 1.0 / unit) * unit)
            cost += math.log10(scales[-1])
        choices.append((cost, scales))
    least = min(cost for cost, _ in choices)
    return Scales(*next(scales for cost, scales in choices if cost <= least + 1e-9))
