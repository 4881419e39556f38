"""The mechanisms of the benchmark, as scenes and by their numbers."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["MECHANISMS", "Case"]


@dataclass(frozen=True)
class Case:
    """``asked`` gives twelve columns: place, velocity and acceleration of two points, metres and seconds; ``sizes`` of
    a shaper are crank, height of its pivot, guide bar, rod and height of the guide."""

    name: str
    text: str
    asked: tuple[str, ...]
    points: tuple[str, str]
    sizes: tuple[float, ...] = ()


def _asked(one: str, two: str) -> tuple[str, ...]:
    return (one, two, f"v_{one}", f"v_{two}", f"a_{one}", f"a_{two}")


FOUR_BAR = """
[units]
length = "m"
[frame]
points = { A = [0, 0], D = [0.4, 0] }
[links.1]
points = ["A", "B"]
length = 0.15
[links.2]
points = ["B", "C"]
length = 0.5
[links.3]
points = ["D", "C"]
length = 0.3
[driver]
link = "1"
angle = 30
omega = 10
[sketch]
C = [0.5, 0.29]
"""

SLIDER_CRANK = """
[units]
length = "m"
[frame]
points = { A = [0, 0] }
guides = { h = { through = [0, 0.02], angle = 0 } }
[links.1]
points = ["A", "B"]
length = 0.05
[links.2]
points = ["B", "C"]
length = 0.15
[links.3]
points = ["C"]
on = "0.h"
[driver]
link = "1"
angle = 30
omega = 10
"""

SHAPER = """
[units]
length = "m"
[frame]
points = {{ O2 = [0, {1}], O4 = [0, 0] }}
guides = {{ h = {{ through = [0, {4}], angle = 0 }} }}
[links.2]
points = ["O2", "A"]
length = {0}
[links.3]
points = ["A"]
on = "4"
[links.4]
points = ["O4", "B"]
length = {2}
[links.5]
points = ["B", "C"]
length = {3}
[links.6]
points = ["C"]
on = "0.h"
[driver]
link = "2"
angle = 30
omega = 10
[sketch]
C = [{5}, {4}]
"""

OF_THE_LIBRARY = 0.09, 0.35, 0.58, 0.174, 0.57
WITH_A_LONG_CRANK = 1.0, 2.0, 5.0, 1.5, 4.9
"""Half as long as the distance of the pivots: a guide bar on which the block comes near to its pivot."""


def _shaper(name: str, sizes: tuple[float, ...]) -> Case:
    return Case(name, SHAPER.format(*sizes, -sizes[3]), _asked("B", "C"), ("B", "C"), sizes)

MECHANISMS = (
    Case("four-bar", FOUR_BAR, _asked("B", "C"), ("B", "C")),
    Case("slider-crank", SLIDER_CRANK, _asked("B", "C"), ("B", "C")),
    _shaper("shaper", OF_THE_LIBRARY),
    _shaper("long shaper", WITH_A_LONG_CRANK),
)
