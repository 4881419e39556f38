"""The axis of the driver, and what else the pages of a turn share: headings, numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from graphkin.construction.scales import next_of_series
from graphkin.drawing import Primitive, Text
from graphkin.drawing.chart import degree_step
from graphkin.drawing.text import rich
from graphkin.scene.model import Mechanism
from graphkin.solver import DriverRange, Motion
from graphkin.words import Phrase, say
from graphkin.words.written import in_markup, true_minus

__all__ = [
    "HEIGHT",
    "LEFT",
    "RIGHT",
    "WIDTH",
    "DriverAxis",
    "driver_axis",
    "heading",
    "number",
    "title_of",
]

Array = NDArray[np.float64]

WIDTH, HEIGHT = 210.0, 297.0
LEFT, RIGHT = 26.0, 14.0
POINTS = 721
BESIDE = 1e-3
"""Of the driver's range: so far beside a place that may be a dead point."""


def title_of(scene: Mechanism, language: str) -> str:
    """The scene's title as markup."""
    return in_markup(scene.title_in(language))


def heading(scene: Mechanism, title: str, facts: Sequence[str], language: str) -> tuple[Primitive, ...]:
    """Title (markup), title of the scene, facts, one under the other."""
    return (
        Text(complex(LEFT, 15.0), rich(title, 5.0, bold=True)),
        Text(complex(LEFT, 20.5), rich(title_of(scene, language), 3.5)),
        Text(complex(LEFT, 25.5), rich("; ".join(facts), 3.5)),
    )


def number(value: float, digits: int = 5) -> str:
    """A number to so many digits, with a minus sign."""
    return true_minus(f"{value:.{digits}g}")


@dataclass(frozen=True)
class DriverAxis:
    """The driver's value from left to right as it moves: degrees, or the scene's unit of length.

    left, right : values at the ends; an axis of a whole turn begins at 0, going up or down
    step : of the ticks
    first : the offset of the driver's range at the left end
    """

    reach: DriverRange
    left: float
    right: float
    step: float
    first: float
    title: str
    _asked: dict[bytes, Motion] = field(default_factory=dict, compare=False, repr=False)

    @cached_property
    def offsets(self) -> Array:
        """Offsets of the range in the order in which they are drawn; dense near the ends of a limited motion."""
        low, high = self.reach.ends
        if not self.reach.full:
            half = np.linspace(0, np.pi, POINTS)
            return np.asarray(low + (high - low) * np.sin(half / 2) ** 2)
        return np.asarray((np.linspace(0.0, high, POINTS) + self.first) % high)

    def motion_at(self, offsets: Array) -> Motion:
        """The motion at offsets of dots, which many panels share."""
        key = offsets.tobytes()
        if key not in self._asked:
            self._asked[key] = self.reach.motion(offsets, fine=False)
        return self._asked[key]

    @cached_property
    def motion(self) -> Motion:
        """The motion at its offsets, for all curves that are drawn over it."""
        return self.reach.motion(self.offsets, fine=False)

    @cached_property
    def beside_ends(self) -> Motion:
        """The motion beside the start and the end of a whole range, and beside the left end of the axis."""
        high = self.reach.ends[1]
        beside = np.array([BESIDE * high, high - BESIDE * high, self.first + BESIDE * high])
        return self.reach.motion(beside, fine=False)

    @property
    def ticks(self) -> Array:
        low, high = sorted((self.left, self.right))
        first, last = math.ceil(low / self.step - 1e-9), math.floor(high / self.step + 1e-9)
        return np.asarray(self.step * np.arange(first, last + 1))

    def at(self, offset: Array) -> Array:
        """Where offsets lie on the axis."""
        reach, scene = self.reach, self.reach.scene
        if not reach.full:
            return np.asarray(scene.unit_of(reach.driver).of(reach.value(offset)))
        high = reach.ends[1]
        along = (np.asarray(offset) - self.first) % high
        along = np.where(along > high * (1 - 1e-12), 0.0, along)
        return np.asarray(np.degrees(along if reach.sense > 0 else high - along))


def driver_axis(reach: DriverRange, language: str) -> DriverAxis:
    """The axis for the whole way of the driver."""
    scene, driver = reach.scene, reach.driver
    name = driver.key.split("/")[0]
    angle = driver.turns
    symbol = f"$φ_{{{name}}}$ (°)" if angle else f"$s_{{{name}}}$ ({scene.units.length})"
    if reach.full:
        low, high = 0.0, 360.0 * reach.turns
    else:
        low, high = sorted(float(scene.unit_of(driver).of(reach.value(np.array(e)))) for e in reach.ends)
    wide = high - low or scene.size / scene.units.metres  # a slide that its own place alone lets stand has no way
    step = degree_step(high - low) if angle else next_of_series(wide / 12)
    first = float((-reach.start[0] * reach.sense) % reach.ends[1]) if reach.full else reach.ends[0]
    left, right = (low, high) if reach.sense > 0 else (high, low)
    return DriverAxis(reach, left, right, step, first, say(Phrase("of the driver", (symbol,)), language))
