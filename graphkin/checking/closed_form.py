"""Tasks of one construction held against their closed form: the lengths of a synthesis, a cam point by point; and how
far readings off a drawn cam may lie off."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from graphkin.checking.uncertainty import COVERAGE
from graphkin.construction import EXACT, Instrument, nudged
from graphkin.construction.cam_sheet import CamSheet, division_by_hand
from graphkin.construction.synthesis import DesignSheet, construct
from graphkin.errors import Unsolvable
from graphkin.scene.designs import DesignTask
from graphkin.scene.scene_tables import Tools
from graphkin.solver.cams import cam_at

__all__ = ["CamPoints", "FoundLength", "compare_cam", "compare_lengths", "predict_cam", "predict_lengths"]

AGREES = 1e-9
"""Of the largest length, or of the base radius and in rad: so far may exact hands be off."""


@dataclass(frozen=True)
class FoundLength:
    """A length measured (mm on paper, and in the file's unit) beside the exact one; ``tolerance`` is what they may
    differ."""

    symbol: str
    on_paper: float
    measured: float
    exact: float
    tolerance: float
    unit: str = ""

    @property
    def error(self) -> float:
        return abs(self.measured - self.exact)

    @property
    def ok(self) -> bool:
        return self.error <= self.tolerance


def predict_lengths(task: DesignTask, scale: float, name: str, tools: Tools) -> dict[str, float]:
    """Standard deviation (mm on paper) of each length that is drawn with an instrument, "pencil" or "cad"; infinite
    where one act alone keeps it from being found."""
    still = nudged(name, tools)
    base = construct(task, scale, still).lengths
    squares = dict.fromkeys(base, 0.0)
    for act in range(1, still.acts + 1):
        try:
            wrong: Mapping[str, float] = construct(task, scale, nudged(name, tools, {act: 1.0})).lengths
        except Unsolvable:
            wrong = dict.fromkeys(base, math.inf)
        for key, value in base.items():
            squares[key] += (wrong[key] - value) ** 2
    return {key: math.sqrt(square) for key, square in squares.items()}


def compare_lengths(
    sheet: DesignSheet, exact: Mapping[str, float], instrument: Instrument = EXACT, tools: Tools | None = None
) -> tuple[FoundLength, ...]:
    """Hold what was measured against the exact lengths (in the task's unit), in their order."""
    expected: Mapping[str, float] = {}
    if instrument is not EXACT:
        expected = predict_lengths(sheet.task, sheet.scale, instrument.name, tools or Tools())
    least = AGREES * max(exact.values())
    rows = []
    for symbol, value in exact.items():
        mm = sheet.lengths[symbol]
        tolerance = max(least, COVERAGE * expected.get(symbol, 0.0) * sheet.scale)
        rows.append(FoundLength(symbol, mm, mm * sheet.scale, value, tolerance))
    return tuple(rows)


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
