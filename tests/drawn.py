"""Scenes that come along, drawn once for all tests that look at them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache

from graphkin.checking.readings import report_on
from graphkin.checking.report import Report
from graphkin.construction import Sheet, execute, plan
from graphkin.drawing import Drawing
from graphkin.drawing.boxes import FigurePage
from graphkin.drawing.figures.diagrams import diagram_figures
from graphkin.drawing.figures.sheet import sheet_page
from graphkin.drawing.sheet_plan import sheet_room
from graphkin.scene import mechanism_of
from graphkin.scene.model import Mechanism
from graphkin.solver import solve

__all__ = ["drafted", "drafts", "drawn", "figures"]


@cache
def drafted(name: str) -> tuple[Sheet, Sheet]:
    """The construction for single figures, and for the sheet."""
    return drafts(mechanism_of(name))


def drafts(scene: Mechanism, at: Mapping[str, float] | None = None) -> tuple[Sheet, Sheet]:
    """The construction for single figures, and for the sheet, at driver values (rad, m): one plan at two scales."""
    planned = plan(scene, at)
    return execute(planned), execute(replace(planned, scales=planned.exact.scales_for(sheet_room(scene))))


def drawn(name: str, language: str = "en", convention: str = "chinese") -> dict[str, Drawing]:
    """Its figures; the sheet with its check."""
    return _drawn(name, language, convention)


@cache  # which tells calls with and without the defaults apart
def _drawn(name: str, language: str, convention: str) -> dict[str, Drawing]:
    own, on_sheet = drafted(name)
    return figures(own, on_sheet, report_on(on_sheet, solve(on_sheet.scene)), language, convention)


def figures(
    own: Sheet, on_sheet: Sheet, report: Report, language: str | None = None, convention: str | None = None
) -> dict[str, Drawing]:
    """The single figures of a construction, and the pages of that for the sheet, with its check."""
    whole = sheet_page(FigurePage.of(on_sheet, "sheet", language, convention), report)
    pages = {"sheet": whole, **{f"sheet-{number}": page for number, page in enumerate(whole.further, 2)}}
    return diagram_figures(FigurePage.of(own, "", language, convention)) | pages
