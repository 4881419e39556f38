"""What the pages of a sweep share: headings, numbers with units, the axis of the driver."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from graphkin.drawing import Primitive, Text
from graphkin.drawing.chart import Axis, degree_axis, linear_axis
from graphkin.drawing.text import rich
from graphkin.scene.model import AngleDriver, Scene
from graphkin.study.course import Course
from graphkin.words import Phrase, say

__all__ = [
    "HEIGHT",
    "LEFT",
    "POINTS",
    "RIGHT",
    "WIDTH",
    "axis_offsets",
    "driver_axis",
    "driver_number",
    "first_offset",
    "heading",
    "number",
    "title_of",
    "unit_words",
    "with_unit",
]

Array = NDArray[np.float64]

WIDTH, HEIGHT = 210.0, 297.0
LEFT, RIGHT = 26.0, 14.0
POINTS = 721


def title_of(scene: Scene, language: str) -> str:
    """The scene's title as markup."""
    return scene.title_in(language).replace("$", "$$")


def heading(scene: Scene, title: str, facts: Sequence[str], language: str) -> tuple[Primitive, ...]:
    """Title (markup), title of the scene, facts, one under the other."""
    return (
        Text(complex(LEFT, 15.0), rich(title, 5.0, bold=True)),
        Text(complex(LEFT, 20.5), rich(title_of(scene, language), 3.5)),
        Text(complex(LEFT, 25.5), rich("; ".join(facts), 3.5)),
    )


def number(value: float, digits: int = 5) -> str:
    """A number to so many digits, with a minus sign."""
    return f"{value:.{digits}g}".replace("-", "−")


def unit_words(unit: str) -> str:
    """A unit as it is printed."""
    return {"deg": "°", "rad/s2": "rad/s²"}.get(unit, unit.replace("s2", "s²"))


def with_unit(value: float, unit: str, digits: int = 6) -> str:
    """A number with its unit."""
    return f"{number(value, digits)}{'' if unit == 'deg' else ' '}{unit_words(unit)}"


def driver_number(scene: Scene, value: float) -> float:
    """A value of the first driver in degrees or in the scene's unit."""
    return math.degrees(value) if isinstance(scene.drivers[0], AngleDriver) else value / scene.units.metres


def driver_axis(course: Course, language: str) -> Axis:
    """The driver's value from left to right as it moves."""
    scene, driver = course.scene, course.driver
    name = driver.key.split("/")[0]
    angle = isinstance(driver, AngleDriver)
    symbol = f"$φ_{{{name}}}$ (°)" if angle else f"$s_{{{name}}}$ ({scene.units.length})"
    title = say(Phrase("of the driver", (symbol,)), language)
    if course.full:
        low, high = 0.0, 360.0 * course.turns
    else:
        low, high = sorted(driver_number(scene, float(course.value(np.array(e)))) for e in course.ends)
    axis = degree_axis(low, high, title) if angle else linear_axis(low, high, title, most=12, margin=0.0)
    if course.sense > 0:
        return axis
    return Axis(axis.high, axis.low, axis.ticks, axis.title)


def axis_offsets(course: Course) -> Array:
    """Offsets in the order in which they are drawn, left to right; dense near the ends of a limited motion."""
    low, high = course.ends
    if not course.full:
        half = np.linspace(0, np.pi, POINTS)
        return np.asarray(low + (high - low) * np.sin(half / 2) ** 2)
    return np.asarray((np.linspace(0.0, high, POINTS) + first_offset(course)) % high)


def first_offset(course: Course) -> float:
    """The offset at which the axis begins: driver at 0 going up, or at whole turns going down."""
    high = course.ends[1]
    return float((-course.start[0] * course.sense) % high)
