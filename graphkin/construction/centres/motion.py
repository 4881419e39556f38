"""Position and motion of every link on paper, by the polygons.

The motion of a link is measured on the velocity polygon; where two links have one velocity is their centre.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from graphkin.construction.board import EXACT, Instrument
from graphkin.construction.centres.pairs import LinkPair, Place, ProjectiveChart
from graphkin.construction.plan import draft
from graphkin.construction.rigid import LinkMotion
from graphkin.construction.sheet import Sheet
from graphkin.frozen import dataclass
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef
from graphkin.structure import Structure

__all__ = ["Way", "Worked", "measured", "relative_centre", "work", "worked"]

AT_REST = 1e-9
"""Two links whose relative motion is smaller than this part of the largest do not move relative to each other."""


MEASURED = 1e-15  # so far off a measured centre may be (on the unit sphere)
SLOW = 1e-3  # part of the largest motion below which a relative one is measured worse than that


def measured(sheet: Sheet) -> dict[str, LinkMotion]:
    """Every link in the velocity polygon: one end point of it, and its angular velocity."""
    per_mm = sheet.scales.velocity / sheet.scales.length
    ends = sheet.ends["velocity"]
    ground = sheet.scene.frame.name
    found = {ground: LinkMotion(0j, 0j, 0.0)}
    for name, rate in sheet.omega.items():
        points = sheet.structure.links[name].points
        for ref, end in ends.items():
            if name != ground and (ref.link == name or (not ref.link and ref.point in points)):
                found[name] = LinkMotion(sheet.points[PointRef(ref.point)], end * per_mm, rate.value)
                break
    return found


def relative_centre(
    motions: Mapping[str, LinkMotion], pair: LinkPair, chart: ProjectiveChart
) -> tuple[Place, float] | None:
    """Where two links have the same velocity, and how far the place may be off on the unit sphere; None where they do
    not move relative to each other.

    Raises
    ------
    KeyError : the motion of one of the two was not measured
    """
    one, two = motions[pair[0]], motions[pair[1]]
    at = chart.middle
    place, strength = chart.pole(at, one.of(at) - two.of(at), one.omega - two.omega)
    largest = max((abs(chart.pole(at, m.of(at), m.omega)[1]) for m in motions.values()), default=0.0)
    return None if abs(strength) <= AT_REST * largest else (place, MEASURED * max(1.0, SLOW * largest / abs(strength)))


Way = Literal["velocity polygon", "superposition"]


@dataclass(frozen=True)
class Worked:
    """A position drawn, the motion of every link measured, and the way in which it was found.

    ``kept`` names what superposed motions let fit: the bars or sliding pairs that the trial polygons leave open.
    """

    sheet: Sheet
    motions: Mapping[str, LinkMotion]
    way: Way = "velocity polygon"
    kept: tuple[str, ...] = ()


def work(
    of: Mechanism | Structure,
    at: Mapping[str, float] | None = None,
    instrument: Instrument = EXACT,
    near: Sheet | None = None,
) -> Worked:
    """Draw everything of a scene and measure how it moves; parameters and exceptions are those of `draft`."""
    return worked(draft(of, at, (), instrument, near=near))


def worked(sheet: Sheet) -> Worked:
    """How everything on a sheet moves."""
    trial = [group for group in sheet.groups if group.way == "superposition"]
    kept = tuple(name for group in trial for name in group.closing)
    return Worked(sheet, measured(sheet), "superposition" if trial else "velocity polygon", kept)
