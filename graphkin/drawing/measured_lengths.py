"""Lengths as they stand in sums on a sheet: what is given as it is given, what is measured with its millimetres, and
the unit and scale of each diagram.
"""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.board import EXACT
from graphkin.construction.polygon_acts import Carried, LaidOff, MeasuredRate, RateSeen
from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.construction.sizes import RateTimes
from graphkin.drawing.conventions import Letters
from graphkin.drawing.headings import number, slide_index, written
from graphkin.scene.model import AnyDriver, SlideDriver
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Units
from graphkin.words.written import LEAST, MOST, amount, on_paper, product

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
    long = next(given, None) or pushed_by_driver(sheet, bar)
    if long is None and sheet.instrument != EXACT.name and abs(mm) >= LEAST:
        return product(on_paper(mm), amount(sheet.scales.length / sheet.scene.units.rates.metres, 12))
    return amount((mm * sheet.scales.length if long is None else long) / sheet.scene.units.rates.metres, most)


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
        pushed = pushed_by_driver(sheet, (one, other))
        if pushed is not None:
            value = f"{number(pushed / sheet.scene.units.metres)} {sheet.scene.units.length}"
            driver = next(d for d in sheet.scene.drivers if _ends_of(sheet, d) == {one, other})
            yield (one, other), f"${letters.length((one, other))}$ = $s_{{{slide_index(sheet, driver.key)}}}$ = {value}"
            continue
        mm = abs(sheet.points[PointRef(one)] - sheet.points[PointRef(other)])
        yield (one, other), f"${letters.length((one, other))}$ = {times_scale(sheet, 'mechanism', mm)}"


def pushed_by_driver(sheet: Sheet, bar: tuple[str, str]) -> float | None:
    """The distance of two points (m), where a driver gives it as its travel; None for any other two."""
    driver = next((d for d in sheet.scene.drivers if _ends_of(sheet, d) == set(bar)), None)
    return None if driver is None else abs(sheet.drivers[driver.key])


def _ends_of(sheet: Sheet, driver: AnyDriver) -> set[str]:
    """The two points between which the travel of a driver counts: that of its guide's origin, and what slides; none
    where the guide does not begin in a point."""
    slide = next((s for s in sheet.structure.slides if s.key == driver.key), None)
    if not isinstance(driver, SlideDriver) or slide is None or slide.pin is None:
        return set()
    on = sheet.scene.by_name[slide.b].points
    least = 1e-9 * sheet.scene.size
    origin = next((p for p, z in on.items() if abs(z - slide.guide.through) < least), None)
    return set() if origin is None else {origin, slide.pin}


def is_given(sheet: Sheet, bar: tuple[str, str]) -> bool:
    """Whether one link holds both ends, or a place of one of them is not on the drawing."""
    if any(PointRef(name) not in sheet.points for name in bar):
        return True
    bodies = (sheet.scene.frame, *sheet.scene.links)
    return any(set(bar) <= set(body.points) for body in bodies)
