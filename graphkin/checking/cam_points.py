"""A cam as it was drawn, held against its profile in closed form; and how far readings off it may lie off."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

import numpy as np

from graphkin.construction import nudged
from graphkin.construction.cam_by_hand import division_by_hand
from graphkin.construction.cam_sheet import CamSheet
from graphkin.frozen import dataclass
from graphkin.scene.sheet_tables import Tools
from graphkin.solver.cam_profile import cam_at

__all__ = ["CamPoints", "CamUncertainty", "compare_cam", "predict_cam"]

AGREES = 1e-9
"""Of the base radius, and in rad."""


@dataclass(frozen=True)
class CamPoints:
    """How far the drawn points of a cam lie from the computed ones (m), the drawn normals and pressure angles (rad)."""

    pitch: float
    profile: float
    pressure: float
    ok: bool


def compare_cam(sheet: CamSheet) -> CamPoints:
    """Hold every division of a drawn cam against the law's own geometry."""
    exact = cam_at(sheet.cam, np.array([d.degree for d in sheet.divisions]))
    point = np.array([d.at.point for d in sheet.divisions]) * sheet.scale
    contact = np.array([d.at.contact for d in sheet.divisions]) * sheet.scale
    angle = np.array([d.pressure for d in sheet.divisions])
    off = float(np.abs(point - exact.pitch).max()), float(np.abs(contact - exact.profile).max())
    turned = float(np.abs(angle - exact.pressure).max())
    return CamPoints(*off, turned, max(*off) <= AGREES * sheet.cam.base and turned <= AGREES)


@dataclass(frozen=True)
class CamUncertainty:
    """Standard deviations of what is read at a division: lift (m, rad) and pressure angle (rad); infinite where one act
    alone keeps it from being drawn."""

    lift: float
    pressure: float


def predict_cam(sheet: CamSheet, name: str, tools: Tools) -> Sequence[CamUncertainty]:
    """How far lift and pressure angle of each division are read off, drawn with an instrument ("pencil" or "cad"): each
    act made wrong once by one standard deviation, the squares added up (as in `predict`)."""
    return [_division(sheet, d.degree, name, tools) for d in sheet.divisions]


def _division(sheet: CamSheet, degree: float, name: str, tools: Tools) -> CamUncertainty:
    mm, still = 1.0 / sheet.scale, nudged(name, tools)
    right = division_by_hand(sheet.cam, degree, mm, still)
    if right is None:
        return CamUncertainty(math.inf, math.inf)
    squares = [0.0, 0.0]
    for act in range(1, still.acts + 1):
        wrong = division_by_hand(sheet.cam, degree, mm, nudged(name, tools, {act: 1.0}))
        if wrong is None:
            return CamUncertainty(math.inf, math.inf)
        squares[0] += (wrong[0] - right[0]) ** 2
        squares[1] += (cmath.phase(cmath.exp(2j * (wrong[1] - right[1]))) / 2) ** 2
    return CamUncertainty(*map(math.sqrt, squares))
