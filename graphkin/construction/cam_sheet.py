"""A cam drawn on the board by inversion: the displacement diagram divided into parts, the follower's line turned back
by each, the lifts carried on to it, the profile, the normals and the pressure angles measured.

After Sun Huan, Mechanical Principles, ch. 9; Norton, Design of Machinery, ch. 8.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

from graphkin.construction.cam_outline import CamStation, outline, station
from graphkin.frozen import dataclass
from graphkin.scene.cams import LawCam, SlidingFollower
from graphkin.scene.follower_law import TURN
from graphkin.words import Phrase
from graphkin.words.written import amount

__all__ = ["CamDivision", "CamSheet", "cam_sheet"]

STEP = math.radians(15.0)
FEWEST, MOST = 4, 12


@dataclass(frozen=True)
class CamDivision:
    """A division of the displacement diagram: its number, the cam degree (rad), the lift (m, rad), the follower turned
    back about the cam (mm), and the pressure angle as it is measured there (rad)."""

    number: int
    degree: float
    lift: float
    at: CamStation
    pressure: float


@dataclass(frozen=True)
class CamSheet:
    """A cam on paper, at cam degree 0, about its axis, y up.

    scale : m for one mm of paper
    profile, pitch : closed curves (mm); the pitch curve is empty of a flat face
    base, offset, roller : radii of circles on paper (mm); offset 0 where there is none, or the follower swings
    """

    cam: LawCam
    scale: float
    divisions: tuple[CamDivision, ...]
    profile: tuple[complex, ...]
    pitch: tuple[complex, ...]
    base: float
    offset: float
    roller: float

    @property
    def steps(self) -> tuple[Phrase, ...]:
        """What is done, one after the other."""
        return tuple(_steps(self))


def cam_sheet(cam: LawCam, scale: float) -> CamSheet:
    """Draw a cam at a scale (m for one mm of paper)."""
    mm = 1.0 / scale
    divided = tuple(
        CamDivision(i, degree, cam.law.at(degree).lift, _on_paper(station(cam, degree), mm), _pressure(cam, degree))
        for i, degree in enumerate(_degrees(cam))
    )
    pitch = () if cam.flat else tuple(_pitch(cam, mm))
    offset = abs(cam.motion.offset) * mm if isinstance(cam.motion, SlidingFollower) else 0.0
    return CamSheet(
        cam, scale, divided, tuple(z * mm for z in outline(cam)), pitch, cam.base * mm, offset, cam.roller * mm
    )


def _degrees(cam: LawCam) -> Iterator[float]:
    """Angles of the divisions (rad): equal parts of each rise and fall, the ends of each dwell."""
    for piece in cam.law.pieces:
        width = piece.end - piece.start
        count = min(MOST, max(FEWEST, 2 * round(width / STEP / 2))) if piece.by else 1
        yield from (piece.start + width * k / count for k in range(count))


def _on_paper(at: CamStation, mm: float) -> CamStation:
    centre = None if at.centre is None else at.centre * mm
    return CamStation(at.line * mm, at.base * mm, at.point * mm, centre, at.normal, at.contact * mm, at.way)


def _pressure(cam: LawCam, degree: float) -> float:
    """The angle between normal and path, read with the protractor, in 0 .. pi/2."""
    at = station(cam, degree)
    angle = abs(cmath.phase(at.normal / at.way))
    return min(angle, math.pi - angle)


def _pitch(cam: LawCam, mm: float) -> Iterator[complex]:
    for part in cam.law.parts:
        count = max(2, math.ceil(180 * (part.end - part.start) / TURN))
        for k in range(count + 1):
            degree = part.start + (part.end - part.start) * k / count
            yield station(cam, degree, part.at(degree)).point * mm


def _steps(sheet: CamSheet) -> Iterator[Phrase]:
    cam = sheet.cam
    last = len(sheet.divisions)
    yield Phrase("cam step diagram", (str(last),))
    slides = isinstance(cam.motion, SlidingFollower)
    radius = amount(sheet.base, 4)
    if slides and sheet.offset > 1e-9:
        yield Phrase("cam step circles", (cam.point, radius, amount(sheet.offset, 4)))
    else:
        yield Phrase("cam step base", (cam.point, radius))
    if not slides:
        yield Phrase("cam step pivots", (cam.point, cam.motion.pivot, amount(abs(sheet.divisions[0].at.line), 4)))  # type: ignore[union-attr]
        yield Phrase("cam step swings", (cam.motion.pivot, cam.motion.tip))  # type: ignore[union-attr]
    else:
        yield Phrase("cam step tangents" if sheet.offset > 1e-9 else "cam step rays", (cam.point,))
        yield Phrase("cam step lifts")
    if cam.flat:
        yield Phrase("cam step faces")
    elif cam.roller:
        yield Phrase("cam step rollers", (amount(sheet.roller, 4),))
    else:
        yield Phrase("cam step edge")
    if not cam.flat:
        yield Phrase("cam step normals", (cam.point,))
