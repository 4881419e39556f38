"""The mechanisms of the benchmark, as scenes and by their numbers."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["MECHANISMS", "Case"]


@dataclass(frozen=True)
class Case:
    """``asked`` gives twelve columns: place, velocity and acceleration of two points, metres and seconds."""

    name: str
    text: str
    asked: tuple[str, ...]
    points: tuple[str, str]


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
points = { O2 = [0, 0.35], O4 = [0, 0] }
guides = { h = { through = [0, 0.57], angle = 0 } }
[links.2]
points = ["O2", "A"]
length = 0.09
[links.3]
points = ["A"]
on = "4"
[links.4]
points = ["O4", "B"]
length = 0.58
[links.5]
points = ["B", "C"]
length = 0.174
[links.6]
points = ["C"]
on = "0.h"
[driver]
link = "2"
angle = 30
omega = 10
[sketch]
C = [-0.15, 0.57]
"""

MECHANISMS = (
    Case("four-bar", FOUR_BAR, _asked("B", "C"), ("B", "C")),
    Case("slider-crank", SLIDER_CRANK, _asked("B", "C"), ("B", "C")),
    Case("shaper", SHAPER, _asked("B", "C"), ("B", "C")),
)
