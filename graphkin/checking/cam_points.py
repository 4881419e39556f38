"""A cam as it was drawn, held against its profile in closed form."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphkin.construction.cam_sheet import CamSheet
from graphkin.solver.cam_profile import cam_at

__all__ = ["CamPoints", "compare_cam"]

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
