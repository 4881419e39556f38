"""Steps of groups larger than a dyad as they are told, so that they can be drawn again from the sheet alone: trial
positions with the way from point to point, special points, trial polygons with what is left open, how it is divided,
links seen from a held one."""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from typing import Any

from graphkin.account.arithmetic import bound, divisions, trials_of
from graphkin.account.headings import number, written
from graphkin.account.voice import Told
from graphkin.construction.mechanism_acts import (
    ArcOnPath,
    CompassArcs,
    GuideThrough,
    GuideTouching,
    LinkPoints,
    Missed,
    Moved,
    PathDrawn,
    PathsCross,
    SlidToMeet,
    SpecialPoint,
    TrialPositions,
    TrialRow,
    TrialTable,
)
from graphkin.construction.polygon_acts import SeenFrom, Superposed, TrialDrawn
from graphkin.construction.sheet import Sheet, phrase_of
from graphkin.construction.strokes import Aid
from graphkin.scene.symbol import Symbol
from graphkin.structure import Pair
from graphkin.words import Neutral, Phrase, languages, listed
from graphkin.words.rich_text import Markup
from graphkin.words.written import in_markup, on_paper, true_minus

__all__ = ["TOLD", "numeral"]

NUMERALS = "I", "II", "III", "IV", "V"
SEEN = 0.005  # mm on paper: less than that is not taken off
STRAIGHT = 1e-9  # rad


class _TrialPositions(Told[TrialPositions]):
    def lettered(self) -> Phrase | None:
        """Trial positions with what is measured in each, and the division."""
        act, sheet = self.act, self.sheet
        table = act.table
        if table is None:
            return None
        moved, missed = _moved_and_missed(sheet, table)
        values, misses = zip(*(_told_in(table, row) for row in table.trials), strict=True)
        if len(table.moved) > 1:
            told = Phrase("trial table several", (moved, _numbered(values), missed, _numbered(misses)))
            return Phrase("in turn", (phrase_of(act), _divided_by_parts(table, told)))
        unit = " mm" if not table.missed[0].angle else "°"
        told = Phrase("trial table", (moved, ", ".join(values), missed, "; ".join(misses).replace(unit, "") + unit))
        if table.divided:
            before = table.before
            between = tuple(f"{abs(table.trials[i][1][0]):.2f}" for i in (before - 1, before))
            first, *rest = (_told_in(table, row) for row in table.divided)
            told = Phrase("trial division", (told, before, before + 1, *between, *first))
            if rest:
                told = Phrase("trial division again", (told, rest[-1][0]))
        return Phrase("in turn", (phrase_of(act), told))

    def lines(self, language: str) -> Iterator[str]:
        """Trial positions: what is moved, how each point is found with it, what is missed, and where nothing is."""
        act = self.act
        out, moved, rolled = (", ".join(n) for n in (act.left_out, act.driven, act.rolling))
        told = Phrase("written trial rolling", (moved, rolled)) if rolled else Phrase("written trial", (out, moved))
        parts: list[Phrase] = [told]
        table = act.table
        if table is not None:
            moved_words, missed = _moved_and_missed(self.sheet, table)
            rows = [_told_in(table, row) for row in table.trials]
            if len(table.moved) > 1:
                numbered = ([Neutral(f"${numeral(i)}$ {row[k]}") for i, row in enumerate(rows, 1)] for k in (0, 1))
                values, misses = map(listed, numbered)
                parts += [Phrase("written tried", (moved_words, values)), Phrase("written missed", (missed, misses))]
            else:
                values = listed([row[0] for row in rows])
                parts.append(Phrase("written tried one", (moved_words, values, len(rows))))
                near = (table.before, table.before + 1)
                seen = listed([Phrase("written miss", (rows[i - 1][1], i)) for i in near])
                parts.append(Phrase("written missed", (missed, seen)))
            if table.divided:
                parts.append(Phrase("written fits", (_told_in(table, table.divided[-1])[0],)))
        route = [*self._route()]
        if route:
            parts.insert(2, Phrase("written route", (listed([*map(Neutral, route)]),)))
        told = reduce(lambda one, other: Phrase("in turn", (one, other)), parts)
        yield self.voice.say(told, languages(language)[0])

    def _route(self) -> Iterator[str]:
        """Each point with what it is found from: the link that it lies on, the centres of its arcs, its guide."""
        paths: dict[str, str] = {}
        arced: set[str] = set()
        for step in self.sheet.steps[self.sheet.steps.index(self.step) + 1 :]:
            act = step.act
            if isinstance(act, TrialPositions) or step.diagram != "mechanism":
                return
            if isinstance(act, PathDrawn):
                paths[act.point] = self._guide(act.pair)
            elif isinstance(act, CompassArcs | ArcOnPath | PathsCross):
                arced.add(act.point)
                yield self._from(act.point, *self._ways(act, paths))
            elif isinstance(act, LinkPoints):
                new = [name for name in act.points if name not in arced]
                if new:
                    yield f"{self._points(new)} ({act.link})"
            elif isinstance(act, GuideThrough | GuideTouching):
                yield f"{self._guide(act.pair)} ({self._points((act.pivot, act.through))})"
            elif isinstance(act, SlidToMeet):
                yield self._from(act.point, self._guide(act.along), self._guide(act.until))

    def _ways(self, act: CompassArcs | ArcOnPath | PathsCross, paths: dict[str, str]) -> tuple[str, ...]:
        if isinstance(act, CompassArcs):
            return tuple(self._points([name]) for name in act.about)
        if isinstance(act, ArcOnPath):
            return self._points([act.about]), paths.get(act.point, "")
        return tuple(map(self._guide, act.pairs))

    def _guide(self, pair: str) -> str:
        """The guide of a sliding pair by its name, or by its pair."""
        name = next((s.guide.name for s in self.sheet.structure.slides if s.key == pair), "")
        return f"${in_markup(name)}$" if name else pair

    def _from(self, point: str, *ways: str) -> str:
        return f"{self._points([point])} ({', '.join(filter(None, ways))})"

    def _points(self, names: Sequence[str]) -> str:
        return ", ".join(f"${self.voice.letters.point(name)}$" for name in names)


def _divided_by_parts(table: TrialTable, told: Phrase) -> Phrase:
    """The divisions of trials in each of which another thing was moved."""
    for i, row in enumerate(table.divided):
        values, misses = _told_in(table, row)
        if i:
            told = Phrase("trial parts again", (told, numeral(table.instead[i - 1]), values, misses))
        else:
            steps = ", ".join(numeral(k) for k in range(2, len(table.trials) + 1))
            told = Phrase("trial parts", (told, ", ".join(map(_two_digits, table.parts)), steps, values, misses))
    return told


def _numbered(rows: Sequence[str]) -> str:
    return "; ".join(f"{numeral(i)} {row}" for i, row in enumerate(rows, 1))


class _Special(Told[SpecialPoint]):
    def lines(self, language: str) -> Iterator[str]:
        """Where the special point lies."""
        act = self.act
        joints = map(Markup, map(self.voice.letters.point, (act.point, *act.joints)))
        key = "written relative special" if act.base and not act.driven else "written special"
        told = Phrase(key, (*joints, act.base, act.link))
        told = Phrase("written sliding leg", (told,)) if self.sheet.structure.slides else told
        yield self.voice.say(told, languages(language)[0])


class _Trial(Told[TrialDrawn]):
    def lettered(self) -> Phrase | None:
        """A trial polygon: which steps draw it, and in the first one why it is drawn."""
        act = self.act
        told = Phrase("trial lettered", (numeral(act.number), _rates(self.sheet, act.assumed), *self._drawn_by()))
        if act.number > 1:
            return told
        if act.far is None:
            return Phrase("superposed since none", (told,))
        angle = number(math.degrees(act.far.crossing), 2)
        away = f"{act.far.away / self.sheet.scales.length:.0f}"
        return Phrase("superposed since far", (told, *act.far.links, angle, away))

    def _drawn_by(self) -> tuple[int, int]:
        """The first and the last of the steps by which a trial is drawn like the true polygon."""
        aids = {s.symbol for s in self.step.strokes if isinstance(s, Aid)}
        later = [s for s in self.sheet.steps if s.diagram == self.step.diagram and s.number > self.step.number]
        first = next(s.number for s in later if isinstance(s.act, Superposed)) + 1
        own = (s for s in later if s.number >= first and any(getattr(x, "symbol", None) in aids for x in s.strokes))
        return first, max((s.number for s in own), default=first)


class _Superposed(Told[Superposed]):
    def lettered(self) -> Phrase | None:
        """What the trials leave open, measured from letter to letter, and the proportional division in numbers."""
        act = self.act
        where = listed([self._open(i) for i in range(len(act.ways))])
        rows = true_minus("; ".join(
            f"{numeral(i)} " + ", ".join(on_paper(mm) for mm in row) for i, row in enumerate(act.apart, 1)
        )) + " mm"  # fmt: skip
        found, sums = _rates(self.sheet, act.found), divisions(self.sheet, self.step, act)
        if len(sums) > 1:
            return Phrase("superposed several", (where, rows, ", ".join(one.part for one in sums), found))
        return Phrase("superposed one", (where, rows, sums[0].terms, found))

    def lines(self, language: str) -> Iterator[str]:
        """What is measured, ``I: ω_3 = 0.2 rad/s; open 3.21 mm``, a line for each trial, and the proportional
        division."""
        act, spoken = self.act, languages(language)[0]
        trials = trials_of(self.sheet, self.step, act)
        opened = listed([self._open(i) for i in range(len(act.ways))])
        numerals = [Markup(numeral(trial.number)) for trial in trials]
        yield self.voice.say(Phrase("written trials", (listed(numerals), ", ".join(act.closing), opened)), spoken)
        for trial, mark, row in zip(trials, numerals, act.apart, strict=True):
            rates = ", ".join(f"{self.voice.symbol(s)} = {number(v, 5)} {self._unit(s)}" for s, v in trial.assumed)
            apart = ", ".join(written(on_paper(mm)) for mm in row)
            yield self.voice.say(Phrase("written trial polygon", (mark, Neutral(rates), apart)), spoken)
        sums = divisions(self.sheet, self.step, act)
        said = Neutral("; ".join(
            bound(f"{self.voice.symbol(s)} = {one.terms} = {one.value} {self._unit(s)}")
            for (s, _), one in zip(act.found, sums, strict=True)
        ))  # fmt: skip
        told = Phrase("written superposed", (said,))
        if len(sums) > 1:
            parts = ", ".join(one.part for one in sums)
            told = Phrase("written superposed several", (parts, Markup(numeral(1)), listed(numerals[1:]), said))
        yield self.voice.say(told, spoken)

    def _unit(self, symbol: Symbol) -> str:
        length = self.sheet.scene.units.rates.length
        return {"omega": "rad/s", "alpha": "rad/s²", "v": f"{length}/s"}.get(symbol.kind, f"{length}/s²")

    def _open(self, i: int) -> Phrase:
        """From which end point to which, and in which direction, something is left open."""
        act, way, (start, end) = self.act, self.act.ways[i], self.act.between[i]
        letter = self.voice.ends.of
        a, b = (letter(self.step.diagram, r) or Phrase("point on link", (r.point, r.link)) for r in (start, end))
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


class _SeenFrom(Told[SeenFrom]):
    def above_equation(self, language: str) -> Iterator[str]:
        """What the mark of vectors means that are seen from a held link."""
        yield self.voice.say(Phrase("written seen", (self.act.held,)), languages(language)[0])


def _rates(sheet: Sheet, found: Sequence[tuple[Symbol, float]]) -> object:
    """Rates with their units, in a list."""
    length = sheet.scene.units.rates.length
    units = {"omega": "rad/s", "alpha": "rad/s²", "v": f"{length}/s", "ar": f"{length}/s²"}
    told = [Phrase("rate is", (s, true_minus(number(value, 5)), units[s.kind])) for s, value in found]
    return listed(told)


# -- trials in words ---------------------------------------------------------------------------------------------------


def _moved_and_missed(sheet: Sheet, table: TrialTable) -> tuple[Phrase, Phrase]:
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


def _along_guide(slide: Pair, points: Mapping[str, complex]) -> str:
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


def _told_in(table: TrialTable, row: TrialRow) -> tuple[str, str]:
    """The values of a trial, and what it misses, each with its unit."""
    values = (_value(v, "°" if one.turned else " mm") for v, one in zip(row[0], table.moved, strict=True))
    misses = (_two_digits(m) + ("°" if one.angle else " mm") for m, one in zip(row[1], table.missed, strict=True))
    return ", ".join(values), ", ".join(misses)


def _value(value: float, unit: str) -> str:
    if unit == "°":
        value = 180.0 - (180.0 - value) % 360.0  # from -180 to 180
    return _two_digits(value) + unit


def _two_digits(value: float) -> str:
    """With two digits behind the point, without the sign of a nought."""
    return true_minus(f"{round(value, 2) + 0.0:.2f}")


def numeral(number_of: int) -> str:
    """The numeral of a trial."""
    return NUMERALS[(number_of - 1) % len(NUMERALS)]


TOLD: Mapping[type, type[Told[Any]]] = {
    TrialPositions: _TrialPositions, SpecialPoint: _Special, TrialDrawn: _Trial, Superposed: _Superposed,
    SeenFrom: _SeenFrom,
}  # fmt: skip
