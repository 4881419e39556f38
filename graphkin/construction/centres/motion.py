"""Position and motion of every link on paper, by the polygons, or by trial and superposition where they stop.

The motion of a link is measured on the velocity polygon; where two links have one velocity is their centre.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

from graphkin.construction.board import EXACT, Instrument
from graphkin.construction.centres.pairs import LinkPair, Place, ProjectiveChart
from graphkin.construction.plan import draft
from graphkin.construction.reduced_mechanism import RemovedConstraint
from graphkin.construction.rigid import LinkMotion, Poses
from graphkin.construction.sheet import Sheet
from graphkin.construction.trial import Known, trial_position
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import AngleDriver, AnyDriver, Mechanism
from graphkin.scene.symbol import PointRef
from graphkin.structure import Structure, analyse

__all__ = ["Way", "Worked", "measured", "relative_centre", "work"]

AT_REST = 1e-9
"""Two links whose relative motion is smaller than this part of the largest do not move relative to each other."""


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


def relative_centre(motions: Mapping[str, LinkMotion], pair: LinkPair, chart: ProjectiveChart) -> Place | None:
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


Way = Literal["velocity polygon", "superposition"]


@dataclass(frozen=True)
class Worked:
    """A position drawn, the motion of every link measured, and the way in which it was found.

    ``kept`` names what two superposed motions let fit: the bars, blocks or drivers left out of the trial drawings.
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
    """Draw everything of a scene and measure how it moves.

    Parameters and exceptions are those of `draft`; a group larger than a dyad is drawn by trial, with ``near``, the
    whole scene on paper at other driver values, from there.
    """
    structure = analyse(of)
    scene = structure.scene
    sheet = draft(structure, at, (), instrument)
    if sheet.stopped is None:
        return Worked(sheet, measured(sheet))
    values = {d.key: d.values[0] for d in scene.drivers} | dict(at or {})
    trial = trial_position(scene, values, _known(near) if near is not None else None)
    dyads = trial.scene
    for removed, key in trial.removed:
        dyads = _at_speed(dyads, key, _true_speed(dyads, removed, key, structure))
    drawn = draft(dyads, None, (), instrument)
    motions, poses = measured(drawn), dict(drawn.poses)
    mm = 1.0 / drawn.scales.length
    for removed, _ in reversed(trial.removed):
        pose = removed.placed(structure.links, poses, mm)
        if pose is not None:
            motions[removed.left_out] = removed.moving(structure.links, poses, motions, mm)
            poses[removed.left_out] = pose
    kept = tuple(r.left_out or (r.driver.key if r.driver else "") for r, _ in trial.removed)
    return Worked(_whole(drawn, scene, structure, values, poses), motions, "superposition", kept)


def _known(sheet: Sheet) -> Known:
    """A sheet as a position to start from."""
    size = sheet.scales.length / sheet.scene.size
    poses = {name: pose.scaled(size) for name, pose in sheet.poses.items()}
    return sheet.drivers, poses


def _true_speed(scene: Mechanism, removed: RemovedConstraint, key: str, structure: Structure) -> float:
    """The trial driver's speed by proportional division of what two trial drawings leave open."""
    driver = next(d for d in scene.drivers if d.key == key)
    base = max((abs(d.values[1]) for d in scene.drivers if isinstance(d, AngleDriver)), default=0.0) or 1.0
    once = base if isinstance(driver, AngleDriver) else base * scene.size
    open_: list[float] = []
    for speed in (0.0, once):
        sheet = draft(_at_speed(scene, key, speed), None, ())
        open_.append(removed.rate(structure.links, sheet.poses, measured(sheet), 1.0 / sheet.scales.length))
    if open_[0] == open_[1]:
        names = ", ".join(removed.links)
        raise Unsolvable("dead point", Problem(f"links {names}", "the speed of every trial drawing fits alike here"))
    return once * open_[0] / (open_[0] - open_[1])


def _at_speed(scene: Mechanism, key: str, speed: float) -> Mechanism:
    def faster(driver: AnyDriver) -> AnyDriver:
        if driver.key != key:
            return driver
        return replace(driver, omega=speed) if isinstance(driver, AngleDriver) else replace(driver, velocity=speed)

    return replace(scene, drivers=tuple(faster(d) for d in scene.drivers))


def _whole(
    drawn: Sheet, scene: Mechanism, structure: Structure, values: Mapping[str, float], poses: Poses
) -> Sheet:
    """The sheet of the reduced mechanism as one of the scene itself: links left out put back."""
    mm = 1.0 / drawn.scales.length
    places = {
        p: poses[n].origin + poses[n].axis * z * mm
        for n, link in structure.links.items() if n in poses for p, z in link.points.items()
    }  # fmt: skip
    points = {**{PointRef(p): z for p, z in places.items()}, **drawn.points}
    return replace(drawn, scene=scene, structure=structure, drivers=values, poses=poses, points=points)
