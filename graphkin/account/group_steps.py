"""Steps of groups larger than a dyad as they are said on paper: what is measured in trial positions and in trial
polygons, how it is divided, and end points laid off by rates."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce

from graphkin.account.arithmetic import divisions, parts_by_rates
from graphkin.account.end_letters import EndLetters
from graphkin.account.headings import number
from graphkin.account.trial_words import moved_and_missed, numeral, told_in, two_digits, what_is_open
from graphkin.construction.mechanism_acts import TrialPositions, TrialTable
from graphkin.construction.polygon_acts import ByRate, SeenByRate, Superposed, TrialDrawn, end_of
from graphkin.construction.sheet import Sheet, Step
from graphkin.construction.steps import phrase_of
from graphkin.construction.strokes import Aid
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase, listed
from graphkin.words.written import on_paper, pointing, true_minus

__all__ = ["divided", "laid_off_by_rate", "tried", "tried_in_positions"]


def tried_in_positions(sheet: Sheet, act: TrialPositions) -> Phrase | None:
    """Trial positions with what is measured in each, and the division."""
    table = act.table
    if table is None:
        return None
    moved, missed = moved_and_missed(sheet, table)
    values, misses = zip(*(told_in(table, row) for row in table.trials), strict=True)
    if len(table.moved) > 1:
        told = Phrase("trial table several", (moved, _numbered(values), missed, _numbered(misses)))
        return Phrase("in turn", (phrase_of(act), _divided_by_parts(table, told)))
    unit = " mm" if not table.missed[0].angle else "°"
    told = Phrase("trial table", (moved, ", ".join(values), missed, "; ".join(misses).replace(unit, "") + unit))
    if table.divided:
        before = table.before
        between = tuple(f"{abs(table.trials[i][1][0]):.2f}" for i in (before - 1, before))
        first, *rest = (told_in(table, row) for row in table.divided)
        told = Phrase("trial division", (told, before, before + 1, *between, *first))
        if rest:
            told = Phrase("trial division again", (told, rest[-1][0]))
    return Phrase("in turn", (phrase_of(act), told))


def _divided_by_parts(table: TrialTable, told: Phrase) -> Phrase:
    """The divisions of trials in each of which another thing was moved."""
    for i, row in enumerate(table.divided):
        values, misses = told_in(table, row)
        if i:
            told = Phrase("trial parts again", (told, numeral(table.instead[i - 1]), values, misses))
        else:
            steps = ", ".join(numeral(k) for k in range(2, len(table.trials) + 1))
            told = Phrase("trial parts", (told, ", ".join(map(two_digits, table.parts)), steps, values, misses))
    return told


def _numbered(rows: Sequence[str]) -> str:
    return "; ".join(f"{numeral(i)} {row}" for i, row in enumerate(rows, 1))


def tried(sheet: Sheet, step: Step, act: TrialDrawn) -> Phrase:
    """A trial polygon: which steps draw it, and in the first one why it is drawn."""
    told = Phrase("trial lettered", (numeral(act.number), _rates(sheet, act.assumed), *_drawn_by(sheet, step)))
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


def divided(sheet: Sheet, step: Step, act: Superposed, lettered: EndLetters) -> Phrase:
    """What the trials leave open, measured from letter to letter, and the proportional division in numbers."""
    opened = [what_is_open(step, act, i, lettered) for i in range(len(act.ways))]
    where = listed(opened)
    rows = true_minus("; ".join(
        f"{numeral(i)} " + ", ".join(on_paper(mm) for mm in row) for i, row in enumerate(act.apart, 1)
    )) + " mm"  # fmt: skip
    found = _rates(sheet, act.found)
    sums = divisions(sheet, step, act)
    if len(sums) > 1:
        return Phrase("superposed several", (where, rows, ", ".join(one.part for one in sums), found))
    return Phrase("superposed one", (where, rows, sums[0].terms, found))


def laid_off_by_rate(sheet: Sheet, step: Step, act: ByRate | SeenByRate, lettered: EndLetters) -> Phrase | None:
    """An end point from another of its link: what the rates give, laid off from letter to letter; as seen from a held
    link, from the pole."""
    parts = parts_by_rates(sheet, step.diagram, act)
    if isinstance(act, SeenByRate):
        first = end_of(act.start)
    else:
        letters = [lettered.of(step.diagram, ref) for ref in (act.start, act.point)]
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


def _rates(sheet: Sheet, found: Sequence[tuple[Symbol, float]]) -> object:
    """Rates with their units, in a list."""
    length = sheet.scene.units.rates.length
    units = {"omega": "rad/s", "alpha": "rad/s²", "v": f"{length}/s", "ar": f"{length}/s²"}
    told = [Phrase("rate is", (s, true_minus(number(value, 5)), units[s.kind])) for s, value in found]
    return listed(told)
