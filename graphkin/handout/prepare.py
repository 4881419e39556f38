"""From a scene to its lesson: readings held against the solver, positions for a screen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from graphkin import exact
from graphkin.checking import Report, compare, predict, read_off
from graphkin.drafting import Plan, execute, plan
from graphkin.drafting.centres import Centres, find_centres
from graphkin.drafting.sheet import Scales, Sheet
from graphkin.errors import Unsolvable
from graphkin.exact import Motion
from graphkin.handout.lesson import Lesson
from graphkin.handout.viewer import POSITIONS, View, common_scales
from graphkin.scene.model import Scene
from graphkin.scene.symbol import Symbol

__all__ = ["lesson_of", "positions", "views_of"]


def lesson_of(what: Plan, motion: Motion, language: str, convention: str) -> Lesson:
    """The lesson of a plan, with its check and with the tolerances of a pencil drawing."""

    def value(symbol: Symbol) -> complex | float:
        found = motion.value(symbol)[0]
        return complex(found) if symbol.is_vector else float(found.real)

    sheet = execute(what)
    report = compare(sheet, read_off(sheet), value, what.asked)
    tolerance = predict(what, "pencil", sheet.scene.sheet.tools)
    return Lesson(sheet, report, tolerance, language, convention, what.asked)


def positions(
    scene: Scene, values: Mapping[str, float] | None, count: int = POSITIONS
) -> tuple[list[dict[str, float]], int]:
    """Driver values (rad, m) spread over a turn or over what the motion reaches, and which of them is the given one."""
    keys = [d.key for d in scene.drivers]
    own = {d.key: d.values[0] for d in scene.drivers} | dict(values or {})
    motion = exact.solve(scene, at=values, sweep=count)
    rows = [dict(zip(keys, map(float, row), strict=True)) for row in motion.values]
    good = [bool(ok) for ok in motion.ok]
    if not all(good):
        # begin behind the gap, so that neighbours on the slider are neighbours in the motion
        cut = next(i for i in range(len(good)) if good[i] and not good[i - 1]) if any(good) else 0
        order = [*range(cut, len(good)), *range(cut)]
        rows = [rows[i] for i in order if good[i]]
    first = keys[0]
    at = next((i for i, row in enumerate(rows) if np.isclose(row[first], own[first], rtol=0, atol=1e-9)), None)
    if at is None:
        at = sum(row[first] < own[first] for row in rows)
        rows.insert(at, own)
    rows[at] = own
    return rows, at


def views_of(
    scene: Scene,
    values: Mapping[str, float] | None,
    asked: Sequence[Symbol],
    language: str,
    convention: str,
    paper: Scales,
    count: int = POSITIONS,
) -> tuple[list[View], int]:
    """The positions that the screen shows, each drawn and with its centres, and which of them is the given one.

    ``paper`` are the scales of the solution on paper, kept wherever the figures fit.  Positions in which the
    construction fails (dead points) are left out.
    """
    rows, start = positions(scene, values, count)
    plans: list[Plan] = []
    given = 0
    for i, row in enumerate(rows):
        try:
            found = plan(scene, row, asked)
            execute(found)
        except Unsolvable:
            if i == start:
                raise
            continue
        if i == start:
            given = len(plans)
        plans.append(found)
    views = []
    for what, scales in zip(plans, common_scales(plans, paper), strict=True):
        sheet = execute(replace(what, scales=scales))
        empty = Report(sheet.instrument, sheet.scales, ())
        views.append(View(Lesson(sheet, empty, {}, language, convention, tuple(asked)), _centres(scene, sheet)))
    return views, given


def _centres(scene: Scene, sheet: Sheet) -> Centres | None:
    try:
        return find_centres(scene, sheet.drivers, sheet=sheet)
    except Unsolvable:
        return None
