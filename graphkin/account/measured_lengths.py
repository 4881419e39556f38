"""Lengths as they stand in sums on a sheet: what is given as it is given, what is measured with its millimetres, and
the unit and scale of each diagram.
"""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.account.headings import number, slide_index, written
from graphkin.account.notation import Letters
from graphkin.construction.instruments import EXACT
from graphkin.construction.links_on_paper import pushed_by_driver
from graphkin.construction.polygon_acts import Carried, LaidOff, MeasuredRate, RateSeen
from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.construction.sizes import RateTimes
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Units
from graphkin.words.written import LEAST, MOST, amount, as_given, on_paper, product

__all__ = ["arm_written", "is_given", "lengths_measured", "scale_of", "times_scale", "unit_of"]

_TAILS = {"mechanism": "", "velocity": "/s", "acceleration": "/s²"}


def unit_of(sheet: Sheet, diagram: DiagramName) -> str:
    """The unit of what a diagram shows."""
    return _units(sheet, diagram).length + _TAILS[diagram]


def scale_of(sheet: Sheet, diagram: DiagramName) -> float:
    """Scene units for one mm of paper."""
    return sheet.scales.of(diagram) / _units(sheet, diagram).metres


def _units(sheet: Sheet, diagram: DiagramName) -> Units:
    return sheet.scene.units if diagram == "mechanism" else sheet.scene.units.rates


def arm_written(sheet: Sheet, bar: tuple[str, str], mm: float, most: int = MOST) -> str:
    """A length in the unit of rates, with which it is multiplied or by which they are divided: given where one link has
    both ends, whatever a hand has made of it, else what so many mm on paper are."""
    held = (link.points for link in sheet.structure.links.values())
    given = (abs(p[bar[0]] - p[bar[1]]) for p in held if bar[0] in p and bar[1] in p and p[bar[0]] != p[bar[1]])
    pushed = pushed_by_driver(sheet.structure, sheet.drivers, bar)
    long = next(given, None) or (pushed and pushed[1])
    if long is None and sheet.instrument != EXACT.name and abs(mm) >= LEAST:
        return product(on_paper(mm), amount(sheet.scales.length / sheet.scene.units.rates.metres, 12))
    metres = sheet.scene.units.rates.metres
    return amount(mm * sheet.scales.length / metres, most) if long is None else as_given(long / metres, most + 1)


def times_scale(sheet: Sheet, diagram: DiagramName, mm: float) -> str:
    """``56.67 mm × 5 (mm/s)/mm = 283.35 mm/s (283.37)``: a length on paper, and, where exact hands have drawn it, what
    it is beyond the hundredth of a millimetre in brackets."""
    unit, per = unit_of(sheet, diagram), scale_of(sheet, diagram)
    length = on_paper(mm)
    value, finer = product(length, amount(per, 12)), amount(mm * per, MOST)
    more = "" if finer == value or sheet.instrument != EXACT.name else f" ({written(finer)})"
    shown = unit if diagram == "mechanism" else f"({unit})"
    return f"{written(length)} mm × {number(per)} {shown}/mm = {written(value)} {unit}{more}"


def lengths_measured(sheet: Sheet, letters: Letters) -> Iterator[tuple[tuple[str, str], str]]:
    """Each length that enters an equation and is not given, in the order of use, by its ends, with its millimetres:
    ``l_O4A = 38.31 mm × 10 mm/mm = 383.1 mm (383.14)``."""
    bars: dict[frozenset[str], tuple[str, str]] = {}
    for step in sheet.steps:
        act, bar = step.act, None
        if isinstance(act, MeasuredRate | RateSeen):
            bar = act.bar
        elif isinstance(act, LaidOff) and isinstance(act.size, RateTimes) and not isinstance(act.size.factor, Symbol):
            bar = act.size.factor
        elif isinstance(act, Carried):
            sizes = (t.size for e in sheet.equations for side in e.sides for t in side if t.symbol == act.symbol)
            bar = next((s.factor for s in sizes if isinstance(s, RateTimes) and isinstance(s.factor, tuple)), None)
        if bar is not None and not is_given(sheet, bar):
            bars.setdefault(frozenset(bar), bar)
    for one, other in bars.values():
        pushed = pushed_by_driver(sheet.structure, sheet.drivers, (one, other))
        if pushed is not None:
            driver, far = pushed
            value = f"{written(as_given(far / sheet.scene.units.metres))} {sheet.scene.units.length}"
            yield (one, other), f"${letters.length((one, other))}$ = $s_{{{slide_index(sheet, driver.key)}}}$ = {value}"
            continue
        mm = sheet.arm_mm((one, other)) or 0.0
        yield (one, other), f"${letters.length((one, other))}$ = {times_scale(sheet, 'mechanism', mm)}"


def is_given(sheet: Sheet, bar: tuple[str, str]) -> bool:
    """Whether one link holds both ends, or a place of one of them is not on the drawing."""
    if any(PointRef(name) not in sheet.points for name in bar):
        return True
    bodies = (sheet.scene.frame, *sheet.scene.links)
    return any(set(bar) <= set(body.points) for body in bodies)
