"""What a step of the construction finds, so that somebody may try it first: size, unit and direction, and how far an
answer may lie off.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

from graphkin.checking.uncertainty import COVERAGE
from graphkin.construction.polygon_acts import MeasuredRate, PlanDrawn
from graphkin.construction.sheet import Step
from graphkin.construction.strokes import Vector
from graphkin.drawing.force_stages import ForceStage, ForceStep
from graphkin.files import Json
from graphkin.papers.html import words_html
from graphkin.papers.lesson import Lesson

__all__ = ["force_found", "found_in", "tolerances"]

LEAST, MOST = 0.01, 0.08  # parts of a value: what is taken for right at least, and at most


def found_in(lesson: Lesson, step: Step) -> dict[str, Json]:
    """What a step finds: ``find`` with symbol, name, size in its unit, and direction (degrees) or sense; empty for a
    step that finds nothing."""
    sheet, act = lesson.sheet, step.act
    if isinstance(act, MeasuredRate) or (isinstance(act, PlanDrawn) and not act.known):
        omega = act.rate == "omega"
        rate = (sheet.omega if omega else sheet.alpha).get(act.link)
        if rate is None or not rate.value:
            return {}
        unit = "rad/s" if omega else "rad/s²"
        name = words_html(f"${'ω' if omega else 'α'}_{{{act.link}}}$")
        symbol, sense = f"{act.rate}_{act.link}", 1 if rate.value > 0 else -1
        return {"find": {"symbol": symbol, "name": name, "size": _short(abs(rate.value)), "unit": unit, "sense": sense}}
    vectors = [s for s in step.strokes if isinstance(s, Vector) and s.span]
    if not vectors:
        return {}
    last = vectors[-1]
    value = last.span * sheet.scales.of(step.diagram)
    return {"find": {
        "symbol": str(last.symbol), "name": words_html(f"${lesson.letters.vector(last.symbol)}$"),
        "size": _short(lesson.in_unit(last.symbol, abs(value))), "unit": lesson.unit(last.symbol),
        "angle": round(math.degrees(cmath.phase(value)), 1),
    }}  # fmt: skip


def force_found(lesson: Lesson, stage: ForceStage, step: ForceStep) -> dict[str, Json]:
    """What a step of the forces finds, where it finds one force or moment; as `found_in`."""
    if len(step.found) != 1 or lesson.forces is None:
        return {}
    (symbol,) = step.found
    name = words_html(f"${lesson.letters.vector(symbol)}$")
    back = replace(symbol, link=symbol.other, other=symbol.link) if symbol.other else symbol
    for one, sign in ((symbol, 1.0), (back, -1.0)):
        value = stage.state.moments.get(one)
        span = stage.state.vectors.get(one)
        if value:
            size, unit = _short(lesson.in_unit(symbol, abs(value))), lesson.unit(symbol)
            return {"find": {"symbol": str(symbol), "name": name, "size": size, "unit": unit,
                             "sense": 1 if sign * value > 0 else -1}}  # fmt: skip
        if span:
            size = _short(lesson.in_unit(symbol, abs(span) * lesson.forces.per_mm))
            return {"find": {"symbol": str(symbol), "name": name, "size": size, "unit": lesson.unit(symbol),
                             "angle": round(math.degrees(cmath.phase(sign * span)), 1)}}  # fmt: skip
    return {}


def _short(value: float) -> float:
    return float(f"{value:.5g}")


def tolerances(lesson: Lesson) -> dict[str, float]:
    """By symbol the part of a value within which an answer is taken for right: that of the key, within bounds."""
    found = {}
    for row in lesson.results:
        spread = lesson.tolerance.get(row.symbol)
        size = abs(row.true)
        if spread is not None and size:
            part = COVERAGE * spread.deviation / size
            found[str(row.symbol)] = round(min(max(part, LEAST), MOST), 4) if math.isfinite(part) else MOST
    return found
