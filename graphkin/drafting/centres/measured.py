"""The motion of each link as measured on the velocity polygon, and the centre of two links from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.drafting.centres.chart import Chart, Place
from graphkin.drafting.centres.pairs import Pair
from graphkin.drafting.sheet import Sheet
from graphkin.scene.symbol import PointRef

__all__ = ["Motion", "measured", "relative_centre"]

AT_REST = 1e-9
"""Two links whose relative motion is smaller than this part of the largest do not move relative to each other."""


@dataclass(frozen=True)
class Motion:
    """A link moves so that its point ``at`` (mm) has ``velocity`` (mm/s on paper), and turns at ``omega`` (rad/s)."""

    at: complex
    velocity: complex
    omega: float

    def of(self, z: complex) -> complex:
        """Velocity (mm/s on paper) of the point of the link that lies at z (mm)."""
        return self.velocity + 1j * self.omega * (z - self.at)


def measured(sheet: Sheet) -> dict[str, Motion]:
    """Every link in the velocity polygon: one end point of it, and its angular velocity."""
    per_mm = sheet.scales.velocity / sheet.scales.length
    ends = sheet.ends["velocity"]
    ground = sheet.scene.frame.name
    found = {ground: Motion(0j, 0j, 0.0)}
    for name, rate in sheet.omega.items():
        points = sheet.structure.links[name].points
        for ref, end in ends.items():
            if name != ground and (ref.link == name or (not ref.link and ref.point in points)):
                found[name] = Motion(sheet.points[PointRef(ref.point)], end * per_mm, rate.value)
                break
    return found


def relative_centre(motions: Mapping[str, Motion], pair: Pair, chart: Chart) -> Place | None:
    """Where two links have the same velocity; None where they do not move relative to each other.

    Raises
    ------
    KeyError : the motion of one of the two was not measured
    """
    one, two = motions[pair[0]], motions[pair[1]]
    at = chart.middle
    place, strength = chart.pole(at, one.of(at) - two.of(at), one.omega - two.omega)
    largest = max((abs(chart.pole(at, m.of(at), m.omega)[1]) for m in motions.values()), default=0.0)
    return None if abs(strength) <= AT_REST * largest else place
