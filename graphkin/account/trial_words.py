"""Trials of groups larger than a dyad in words: what is moved and what is missed in trial positions, what is left open
in trial polygons."""

from __future__ import annotations

from cmath import phase
from collections.abc import Mapping
from functools import reduce

from graphkin.account.end_letters import EndLetters
from graphkin.construction.mechanism_acts import Missed, Moved, TrialRow, TrialTable
from graphkin.construction.polygon_acts import Superposed
from graphkin.construction.sheet import Sheet, Step
from graphkin.structure import Slide
from graphkin.words import Phrase
from graphkin.words.written import on_paper, true_minus

__all__ = ["moved_and_missed", "numeral", "told_in", "two_digits", "what_is_open"]

NUMERALS = "I", "II", "III", "IV", "V"
SEEN = 0.005  # mm on paper: less than that is not taken off
STRAIGHT = 1e-9  # rad


def moved_and_missed(sheet: Sheet, table: TrialTable) -> tuple[Phrase, Phrase]:
    """All that is moved in trial positions, and all that is missed."""
    moved = reduce(lambda a, b: Phrase("moved too", (a, b)), [_moved(sheet, one) for one in table.moved])
    return moved, reduce(lambda a, b: Phrase("missed too", (a, b)), [_missed(sheet, one) for one in table.missed])


def _missed(sheet: Sheet, missed: Missed) -> Phrase:
    """What is measured: between the ends of a bar, off a guide, or of a list."""
    if missed.kind == "guide":
        *points, key = missed.names
        slide = sheet.structure.slide(key)
        name = _along_guide(slide, sheet.structure.links[slide.b].points)
        off = (", ".join(points), slide.b)
        return Phrase("missed guide", (*off, name)) if name else Phrase("missed guide of link", off)
    named = "".join(missed.names) if missed.kind == "bar" else ", ".join(missed.names)
    return Phrase(f"missed {missed.kind}", (named, on_paper(missed.length)))


def _along_guide(slide: Slide, points: Mapping[str, complex]) -> str:
    """The outermost points on a guide, in its sense, else its name; "" where it has neither."""
    guide = slide.guide
    off = {p: (z - guide.through) * guide.direction.conjugate() for p, z in points.items()}
    size = max(map(abs, off.values()), default=0.0)
    on = sorted((along.real, p) for p, along in off.items() if abs(along.imag) <= STRAIGHT * size)
    return on[0][1] + on[-1][1] if len(on) > 1 else guide.name


def _moved(sheet: Sheet, moved: Moved) -> Phrase:
    if not moved.turned:
        return Phrase("trial travel", (moved.name,))
    if not moved.base:
        bar = _along_axis(sheet.structure.links[moved.name].points)
        return Phrase("trial angle of bar", (moved.name, bar)) if bar else Phrase("trial angle", (moved.name,))
    one, other = (sheet.structure.links[name] for name in (moved.base, moved.name))
    hinge = next((p for p in one.points if p in other.points), "")
    if len(one.bar) < 2 or len(other.bar) < 2 or not hinge:
        return Phrase("trial turn", (moved.name, moved.base))
    return Phrase("trial turn of bars", (moved.name, "".join(other.bar[:2]), "".join(one.bar[:2]), hinge))


def _along_axis(points: Mapping[str, complex]) -> str:
    """A bar of a link that lies along its axis, in its sense; "" where none does."""
    pairs = ((p, q, w - z) for p, z in points.items() for q, w in points.items() if z != w)
    return next((p + q for p, q, span in pairs if abs(phase(span)) < STRAIGHT), "")


def told_in(table: TrialTable, row: TrialRow) -> tuple[str, str]:
    """The values of a trial, and what it misses, each with its unit."""
    values = (_value(v, "°" if one.turned else " mm") for v, one in zip(row[0], table.moved, strict=True))
    misses = (two_digits(m) + ("°" if one.angle else " mm") for m, one in zip(row[1], table.missed, strict=True))
    return ", ".join(values), ", ".join(misses)


def _value(value: float, unit: str) -> str:
    if unit == "°":
        value = 180.0 - (180.0 - value) % 360.0  # from -180 to 180
    return two_digits(value) + unit


def two_digits(value: float) -> str:
    """With two digits behind the point, without the sign of a nought."""
    return true_minus(f"{round(value, 2) + 0.0:.2f}")


def numeral(number_of: int) -> str:
    """The numeral of a trial."""
    return NUMERALS[(number_of - 1) % len(NUMERALS)]


def what_is_open(step: Step, act: Superposed, i: int, letters: EndLetters) -> Phrase:
    """From which end point to which, and in which direction, something is left open."""
    way, (start, end) = act.ways[i], act.between[i]
    a, b = (letters.of(step.diagram, ref) or Phrase("point on link", (ref.point, ref.link)) for ref in (start, end))
    across = "square" if way.relation == "square" else "along"
    if way.names == (start.point, end.point) and start.link == end.link == "":
        told = Phrase(f"open {across} bar", (a, b, *way.names))
    elif start.point != end.point:
        told = Phrase(f"open {across} bar", (a, b, start.point, end.point))
    else:
        told = Phrase(f"open {across} guide", (a, b, "".join(way.names)))
    for one in (one for one in act.less[i] if abs(one.mm) >= SEEN):
        rule = one.symbol if one.size is None else Phrase("rule of size", (one.symbol, one.size))
        told = Phrase("open less", (told, rule, true_minus(on_paper(one.mm))))
    return told
