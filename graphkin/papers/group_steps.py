"""Steps of groups larger than a dyad as they are said on paper: what is measured in trial positions and in trial
polygons, how it is divided, and end points laid off by rates."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import reduce

from graphkin.construction.mechanism_acts import Missed, Moved, TrialPositions, TrialRow, TrialTable
from graphkin.construction.polygon_acts import ByRate, SeenByRate, Superposed, TrialDrawn, end_of
from graphkin.construction.sheet import DiagramName, Sheet, Step
from graphkin.construction.steps import phrase_of
from graphkin.construction.strokes import Aid
from graphkin.drawing.group_aids import NUMERALS
from graphkin.drawing.headings import number
from graphkin.drawing.sums import divisions, parts_by_rates
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, listed
from graphkin.words.written import on_paper, pointing, true_minus

__all__ = ["divided", "laid_off_by_rate", "tried", "tried_in_positions"]

SEEN = 0.005  # mm on paper: less than that is not taken off

Lettered = Callable[[DiagramName, PointRef], str | None]  # the letter of an end point in a polygon


def tried_in_positions(sheet: Sheet, act: TrialPositions) -> Phrase | None:
    """Trial positions with what is measured in each, and the division."""
    table = act.table
    if table is None:
        return None
    moved = reduce(lambda a, b: Phrase("moved too", (a, b)), [_moved(sheet, one) for one in table.moved])
    missed = reduce(lambda a, b: Phrase("missed too", (a, b)), [_missed(one) for one in table.missed])
    values, misses = zip(*(_told(table, row) for row in table.trials), strict=True)
    if len(table.moved) > 1:
        told = Phrase("trial table several", (moved, _numbered(values), missed, _numbered(misses)))
        return Phrase("in turn", (phrase_of(act), _divided_by_parts(table, told)))
    unit = " mm" if not table.missed[0].angle else "°"
    told = Phrase("trial table", (moved, ", ".join(values), missed, "; ".join(misses).replace(unit, "") + unit))
    if table.divided:
        before = table.before
        between = tuple(f"{abs(table.trials[i][1][0]):.2f}" for i in (before - 1, before))
        first, *rest = (_told(table, row) for row in table.divided)
        told = Phrase("trial division", (told, before, before + 1, *between, *first))
        if rest:
            told = Phrase("trial division again", (told, rest[-1][0]))
    return Phrase("in turn", (phrase_of(act), told))


def _divided_by_parts(table: TrialTable, told: Phrase) -> Phrase:
    """The divisions of trials in each of which another thing was moved."""
    for i, row in enumerate(table.divided):
        values, misses = _told(table, row)
        if i:
            told = Phrase("trial parts again", (told, _numeral(table.instead[i - 1]), values, misses))
        else:
            steps = ", ".join(_numeral(k) for k in range(2, len(table.trials) + 1))
            told = Phrase("trial parts", (told, ", ".join(map(_two, table.parts)), steps, values, misses))
    return told


def _told(table: TrialTable, row: TrialRow) -> tuple[str, str]:
    """The values of a trial, and what it misses, each with its unit."""
    values = (_value(v, "°" if one.turned else " mm") for v, one in zip(row[0], table.moved, strict=True))
    misses = (_two(m) + ("°" if one.angle else " mm") for m, one in zip(row[1], table.missed, strict=True))
    return ", ".join(values), ", ".join(misses)


def _numbered(rows: Sequence[str]) -> str:
    return "; ".join(f"{_numeral(i)} {row}" for i, row in enumerate(rows, 1))


def _missed(missed: Missed) -> Phrase:
    """What is measured: between the ends of a bar, or of a list."""
    named = "".join(missed.names) if missed.kind == "bar" else ", ".join(missed.names)
    return Phrase(f"missed {missed.kind}", (named, on_paper(missed.length)))


def _moved(sheet: Sheet, moved: Moved) -> Phrase:
    if not moved.turned:
        return Phrase("trial travel", (moved.name,))
    if not moved.base:
        return Phrase("trial angle", (moved.name,))
    one, other = (sheet.structure.links[name] for name in (moved.base, moved.name))
    hinge = next((p for p in one.points if p in other.points), "")
    if len(one.bar) < 2 or len(other.bar) < 2 or not hinge:
        return Phrase("trial turn", (moved.name, moved.base))
    return Phrase("trial turn of bars", (moved.name, "".join(other.bar[:2]), "".join(one.bar[:2]), hinge))


def _value(value: float, unit: str) -> str:
    if unit == "°":
        value = 180.0 - (180.0 - value) % 360.0  # from -180 to 180
    return _two(value) + unit


def _two(value: float) -> str:
    """With two digits behind the point, without the sign of a nought."""
    return true_minus(f"{round(value, 2) + 0.0:.2f}")


def tried(sheet: Sheet, step: Step, act: TrialDrawn) -> Phrase:
    """A trial polygon: which steps draw it, and in the first one why it is drawn."""
    told = Phrase("trial lettered", (_numeral(act.number), _rates(sheet, act.assumed), *_drawn_by(sheet, step)))
    if act.number > 1:
        return told
    if act.far is None:
        return Phrase("superposed since none", (told,))
    angle = number(math.degrees(act.far.crossing), 2)
    return Phrase("superposed since far", (told, *act.far.links, angle, f"{act.far.away / sheet.scales.length:.0f}"))


def _drawn_by(sheet: Sheet, step: Step) -> tuple[int, int]:
    """The first and the last of the steps by which a trial is drawn like the true polygon."""
    aids = {s.symbol for s in step.strokes if isinstance(s, Aid)}
    later = [s for s in sheet.steps if s.diagram == step.diagram and s.number > step.number]
    first = next(s.number for s in later if isinstance(s.act, Superposed)) + 1
    own = [s.number for s in later if s.number >= first and any(getattr(x, "symbol", None) in aids for x in s.strokes)]
    return first, max(own, default=first)


def divided(sheet: Sheet, step: Step, act: Superposed, lettered: Lettered) -> Phrase:
    """What the trials leave open, measured from letter to letter, and the proportional division in numbers."""
    opened = [_opened(step, act, i, lettered) for i in range(len(act.ways))]
    where = listed(opened)
    rows = true_minus("; ".join(
        f"{_numeral(i)} " + ", ".join(on_paper(mm) for mm in row) for i, row in enumerate(act.apart, 1)
    )) + " mm"  # fmt: skip
    found = _rates(sheet, act.found)
    sums = divisions(sheet, step, act)
    if len(sums) > 1:
        return Phrase("superposed several", (where, rows, ", ".join(one.part for one in sums), found))
    return Phrase("superposed one", (where, rows, sums[0].terms, found))


def _opened(step: Step, act: Superposed, i: int, lettered: Lettered) -> Phrase:
    """From which end point to which, and in which direction, something is left open."""
    way, (start, end) = act.ways[i], act.between[i]
    a, b = (lettered(step.diagram, ref) or Phrase("point on link", (ref.point, ref.link)) for ref in (start, end))
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


def laid_off_by_rate(sheet: Sheet, step: Step, act: ByRate | SeenByRate, lettered: Lettered) -> Phrase | None:
    """An end point from another of its link: what the rates give, laid off from letter to letter; as seen from a held
    link, from the pole."""
    parts = parts_by_rates(sheet, step.diagram, act)
    if isinstance(act, SeenByRate):
        first = end_of(act.start)
    else:
        letters = [lettered(step.diagram, ref) for ref in (act.start, act.point)]
        if None in letters:
            return None
        first = Phrase("the point", (letters[0],))
    start, laid = first, list[Phrase]()
    for part in parts:
        key = "as normal" if part.rule.square else "as vector"
        way = part.direction if part.rule.square else Phrase("pointing", (part.direction, pointing(part.span)))
        rule = Phrase(key, (Phrase("rule of size", (part.symbol, part.rule)),))
        laid.append(Phrase("lay off from", (start, rule, on_paper(abs(part.span)), way)))
        start = Phrase("the end of", (part.symbol,))
    if not laid:
        return None
    told = reduce(lambda one, other: Phrase("in turn", (one, other)), laid)
    if isinstance(act, SeenByRate):
        return Phrase("ends seen", (told, act.vector))
    return Phrase("ends in", (told, letters[1]))


def _numeral(number_of: int) -> str:
    return NUMERALS[(number_of - 1) % len(NUMERALS)]


def _rates(sheet: Sheet, found: Sequence[tuple[Symbol, float]]) -> object:
    """Rates with their units, in a list."""
    length = sheet.scene.units.rates.length
    units = {"omega": "rad/s", "alpha": "rad/s²", "v": f"{length}/s", "ar": f"{length}/s²"}
    told = [Phrase("rate is", (s, true_minus(number(value, 5)), units[s.kind])) for s, value in found]
    return listed(told)
