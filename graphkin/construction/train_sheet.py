"""What stands on the velocity plan of a train of wheels, and on that of its tangential accelerations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.construction.centre_lines import CentreLine

__all__ = ["PlanLine", "PlanScales", "PlanTrial", "TrainPlan"]


@dataclass(frozen=True)
class PlanScales:
    """What 1 mm of a plan is: m, m/s (m/s2), rad/s (rad/s2); and how far the pole stands from the rate scale (mm)."""

    length: float
    speed: float
    rate: float

    @property
    def pole(self) -> float:
        return self.speed / self.length / self.rate


@dataclass(frozen=True)
class PlanLine:
    """The line of a link over the line of centres ``on`` (its number).

    by : the names of the places that give it: two, or one and the rate (``rate_known``); of a link that slides along
        ``beside`` the line is parallel to that one's
    ends : its lowest and its highest place (mm; velocity to the right, height upwards)
    foot : what it marks off on the rate scale, as read (mm), counter-clockwise to the right
    rate : what that says (rad/s, rad/s2)
    """

    link: str
    on: int
    by: tuple[str, ...]
    rate_known: bool
    ends: tuple[complex, complex]
    foot: float
    rate: float
    beside: str = ""
    trial: bool = False


@dataclass(frozen=True)
class PlanTrial:
    """Rates that were assumed, by link: the values of each trial, what each left open (mm), and what follows."""

    links: tuple[str, ...]
    assumed: tuple[tuple[float, ...], ...]
    apart: tuple[tuple[float, ...], ...]
    found: tuple[float, ...]


@dataclass(frozen=True)
class TrainPlan:
    """A plan as drawn.  ``velocities`` (mm) are those of the places, by line of centres and place; ``travels`` of the
    racks (m/s, m/s2) by sliding pair, with the length read (mm)."""

    order: str
    scales: PlanScales
    on: tuple[CentreLine, ...]
    lines: tuple[PlanLine, ...]
    velocities: Mapping[tuple[int, str], float]
    travels: Mapping[str, tuple[float, float]]
    trial: PlanTrial | None = None

    def line(self, link: str) -> PlanLine | None:
        """The line of a link from which its rate is read, else its first."""
        own = [one for one in self.lines if one.link == link]
        return next((one for one in own if not one.rate_known), own[0] if own else None)
