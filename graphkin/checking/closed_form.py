"""Single constructions compared with their closed form: the lengths of a synthesis, a cam point by point; and the
predicted errors of readings from a drawn cam."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial

import numpy as np

from graphkin.checking.report import COVERAGE
from graphkin.checking.uncertainty import deviations
from graphkin.construction import Instrument, Sheet
from graphkin.construction.board.instruments import EXACT_NAME
from graphkin.construction.cam_sheet import division, divisions
from graphkin.construction.synthesis import construct
from graphkin.construction.tasks import measured
from graphkin.construction.touching import CamStation
from graphkin.errors import Unsolvable
from graphkin.scene.designs import DesignTask
from graphkin.scene.pairs import LawCam
from graphkin.scene.scene_tables import Tools
from graphkin.solver.cams import cam_at

AGREES = 1e-9
"""Of the largest length, or of the base radius and in rad: so far may exact hands be off."""


@dataclass(frozen=True)
class FoundLength:
    """A length measured (mm on paper; file's unit) beside the exact one; ``tolerance`` is their allowed difference."""

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
    where the error of a single act makes the construction impossible."""

    def read(hand: Instrument) -> Mapping[str, float] | None:
        with suppress(Unsolvable):
            return measured(construct(task, scale, hand))
        return None

    return deviations(read, name, tools)


def compare_lengths(
    task: DesignTask, sheet: Sheet, exact: Mapping[str, float], tools: Tools | None = None
) -> tuple[FoundLength, ...]:
    """Compare the measured lengths with the exact ones (in the task's unit), in their order."""
    expected: Mapping[str, float] = {}
    lengths, scale = measured(sheet), sheet.scales.length
    if sheet.instrument != EXACT_NAME:
        expected = predict_lengths(task, scale, sheet.instrument, tools or Tools())
    least = AGREES * max(exact.values())
    rows = []
    for symbol, value in exact.items():
        mm = lengths[symbol]
        tolerance = max(least, COVERAGE * expected.get(symbol, 0.0) * scale)
        rows.append(FoundLength(symbol, mm, mm * scale, value, tolerance))
    return tuple(rows)


@dataclass(frozen=True)
class CamPoints:
    """The differences between drawn and computed points of a cam (m), its pressure angles (rad), and its lifts as read
    (m, of a swinging follower rad)."""

    pitch: float
    profile: float
    pressure: float
    lift: float
    ok: bool


def compare_cam(cam: LawCam, sheet: Sheet) -> CamPoints:
    """Compare every division of a drawn cam with the law's own geometry."""
    drawn, per_mm = divisions(sheet), sheet.scales.length
    exact = cam_at(cam, np.array([d.degree for d in drawn]))
    point = np.array([d.point for d in drawn]) * per_mm
    contact = np.array([d.contact for d in drawn]) * per_mm
    angle = np.array([d.pressure for d in drawn])
    deviations = float(np.abs(point - exact.pitch).max()), float(np.abs(contact - exact.profile).max())
    turned = float(np.abs(angle - exact.pressure).max())
    lift = max(abs(d.lift - cam.law.at(d.degree).lift) for d in drawn)
    agrees = max(*deviations) <= AGREES * cam.base and turned <= AGREES
    return CamPoints(*deviations, turned, lift, agrees and lift <= AGREES * (1.0 if cam.turns else cam.base))


def predict_cam(cam: LawCam, sheet: Sheet, name: str, tools: Tools) -> Sequence[Mapping[str, float]]:
    """Standard deviations of the "lift" (m, rad) and the "pressure" angle (rad) read at each division, drawn with an
    instrument ("pencil" or "cad"); infinite where the error of a single act makes a division impossible."""

    def read(drawn: CamStation, hand: Instrument) -> Mapping[str, float] | None:
        drawn_anew = division(cam, drawn.degree, 1.0 / sheet.scales.length, hand)
        if drawn_anew is None:
            return None
        # a normal has no sense
        return {"lift": drawn_anew.lift, "pressure": math.remainder(drawn_anew.leaning - drawn.pressure, math.pi)}

    spreads = (deviations(partial(read, drawn), name, tools) for drawn in divisions(sheet))
    return [spread or {"lift": math.inf, "pressure": math.inf} for spread in spreads]
