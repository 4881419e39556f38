"""Steps of groups larger than a dyad as they are told, so that they can be drawn again from the sheet alone: trial
positions with the way from point to point, special points, trial polygons with what is left open, how it is divided,
links seen from a held one."""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import reduce

from graphkin.account.arithmetic import bound, divisions, trials_of
from graphkin.account.headings import number, written
from graphkin.account.voice import Voice
from graphkin.construction.sheet import Sheet
from graphkin.construction.steps import (
    Missed,
    Moved,
    RateTrial,
    Reason,
    Step,
    Superposed,
    TrialPositions,
    TrialRow,
    TrialTable,
)
from graphkin.construction.strokes import Aid
from graphkin.scene.symbol import Symbol
from graphkin.structure import Pair
from graphkin.words import Neutral, Phrase, languages, listed
from graphkin.words.rich_text import Markup
from graphkin.words.written import in_markup, on_paper, true_minus

__all__ = ["LINES", "SENTENCES", "numeral"]

NUMERALS = "I", "II", "III", "IV", "V"
SEEN = 0.005  # mm on paper: less than that is not taken off
STRAIGHT = 1e-9  # rad


# -- trial positions ---------------------------------------------------------------------------------------------------


def _positions(voice: Voice, step: Step) -> Phrase | None:
    """Trial positions with what is measured in each, and the division."""
    assert isinstance(step.data, TrialPositions)
    sheet, table = voice.sheet, step.data.table
    if table is None:
        return None
    moved, missed = _moved_and_missed(sheet, table)
    values, misses = zip(*(_told_in(table, row) for row in table.trials), strict=True)
    if len(table.moved) > 1:
        told = Phrase("trial table several", (moved, _numbered(values), missed, _numbered(misses)))
        return Phrase("in turn", (step.phrase, _divided_by_parts(table, told)))
    unit = " mm" if not table.missed[0].angle else "°"
    told = Phrase("trial table", (moved, ", ".join(values), missed, "; ".join(misses).replace(unit, "") + unit))
    if table.divided:
        before = table.before
        between = tuple(f"{abs(table.trials[i][1][0]):.2f}" for i in (before - 1, before))
        first, *rest = (_told_in(table, row) for row in table.divided)
        told = Phrase("trial division", (told, before, before + 1, *between, *first))
        if rest:
            told = Phrase("trial division again", (told, rest[-1][0]))
    return Phrase("in turn", (step.phrase, told))


def _positions_lines(voice: Voice, step: Step, language: str) -> Iterator[str]:
    """Trial positions: what is moved, how each point is found with it, what is missed, and where nothing is."""
    trial, sheet = step.data, voice.sheet
    assert isinstance(trial, TrialPositions)
    out, moved, rolled = (", ".join(n) for n in (trial.left_out, trial.driven, trial.rolling))
    told = Phrase("written trial rolling", (moved, rolled)) if rolled else Phrase("written trial", (out, moved))
    parts: list[Phrase] = [told]
    table = trial.table
    if table is not None:
        moved_words, missed = _moved_and_missed(sheet, table)
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
    route = [*_route(voice, step)]
    if route:
        parts.insert(2, Phrase("written route", (listed([*map(Neutral, route)]),)))
    told = reduce(lambda one, other: Phrase("in turn", (one, other)), parts)
    yield voice.say(told, languages(language)[0])


def _route(voice: Voice, trial: Step) -> Iterator[str]:
    """Each point with what it is found from: the link that it lies on, the centres of its arcs, its guide."""
    paths: dict[str, str] = {}
    arced: set[str] = set()
    for step in voice.sheet.steps[trial.number :]:
        guides = [_guide(voice, pair) for pair in step.pairs]
        match step.reason:
            case _ if step.diagram != "mechanism" or step.verb == "trial":
                return
            case "path":
                paths[step.point] = guides[0]
            case "arcs" | "arc on path" | "paths":
                arced.add(step.point)
                ends = [_points(voice, [name]) for name in step.points]
                along = [paths.get(step.point, "")] if step.reason == "arc on path" else []
                yield _from(voice, step.point, *ends, *along, *guides)
            case "points" | "whole link":
                new = [name for name in step.points if name not in arced]
                if new:
                    yield f"{_points(voice, new)} ({step.link})"
            case "guide" | "tangent":
                yield f"{guides[0]} ({_points(voice, step.points)})"
            case "guide to point":
                yield _from(voice, step.point, *guides)


def _guide(voice: Voice, pair: str) -> str:
    """The guide of a sliding pair by its name, or by its pair."""
    name = next((s.guide.name for s in voice.sheet.structure.slides if s.key == pair), "")
    return f"${in_markup(name)}$" if name else pair


def _from(voice: Voice, point: str, *ways: str) -> str:
    return f"{_points(voice, [point])} ({', '.join(filter(None, ways))})"


def _points(voice: Voice, names: Sequence[str]) -> str:
    return ", ".join(f"${voice.letters.point(name)}$" for name in names)


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


# -- special points, trial polygons ------------------------------------------------------------------------------------


def _special_lines(voice: Voice, step: Step, language: str) -> Iterator[str]:
    """Where the special point lies."""
    joints = map(Markup, map(voice.letters.point, (step.point, *step.points)))
    key = "written relative special" if step.base and step.kind != "driven" else "written special"
    told = Phrase(key, (*joints, step.base, step.link))
    told = Phrase("written sliding leg", (told,)) if voice.sheet.structure.slides else told
    yield voice.say(told, languages(language)[0])


def _trial(voice: Voice, step: Step) -> Phrase | None:
    """A trial polygon: which steps draw it, and in the first one why it is drawn."""
    trial, sheet = step.data, voice.sheet
    assert isinstance(trial, RateTrial)
    told = Phrase("trial lettered", (numeral(trial.number), _rates(sheet, trial.assumed), *_drawn_by(sheet, step)))
    if trial.number > 1:
        return told
    if trial.far is None:
        return Phrase("superposed since none", (told,))
    angle = number(math.degrees(trial.far.crossing), 2)
    away = f"{trial.far.away / sheet.scales.length:.0f}"
    return Phrase("superposed since far", (told, *trial.far.links, angle, away))


def _drawn_by(sheet: Sheet, step: Step) -> tuple[int, int]:
    """The first and the last of the steps by which a trial is drawn like the true polygon."""
    aids = {s.symbol for s in step.strokes if isinstance(s, Aid)}
    later = [s for s in sheet.steps[step.number :] if s.diagram == step.diagram]
    first = next(s.number for s in later if s.reason == "open ends") + 1
    own = (s for s in later if s.number >= first and any(getattr(x, "symbol", None) in aids for x in s.strokes))
    return first, max((s.number for s in own), default=first)


def _superposed(voice: Voice, step: Step) -> Phrase | None:
    """What the trials leave open, measured from letter to letter, and the proportional division in numbers."""
    divided, sheet = step.data, voice.sheet
    assert isinstance(divided, Superposed)
    where = _left_open(voice, step, divided)
    rows = true_minus("; ".join(
        f"{numeral(i)} " + ", ".join(on_paper(mm) for mm in row) for i, row in enumerate(divided.apart, 1)
    )) + " mm"  # fmt: skip
    found, sums = _rates(sheet, divided.found), divisions(sheet, step, divided)
    if len(sums) > 1:
        return Phrase("superposed several", (where, rows, ", ".join(one.part for one in sums), found))
    return Phrase("superposed one", (where, rows, sums[0].terms, found))


def _superposed_lines(voice: Voice, step: Step, language: str) -> Iterator[str]:
    """What is measured, ``I: ω_3 = 0.2 rad/s; open 3.21 mm``, a line for each trial, and the proportional division."""
    divided, sheet, spoken = step.data, voice.sheet, languages(language)[0]
    assert isinstance(divided, Superposed)
    trials = trials_of(sheet, step, divided)
    numerals = [Markup(numeral(trial.number)) for trial in trials]
    opened = _left_open(voice, step, divided)
    yield voice.say(Phrase("written trials", (listed(numerals), ", ".join(divided.closing), opened)), spoken)
    for trial, mark, row in zip(trials, numerals, divided.apart, strict=True):
        rates = ", ".join(f"{voice.symbol(s)} = {number(v, 5)} {_unit(sheet, s)}" for s, v in trial.assumed)
        apart = ", ".join(written(on_paper(mm)) for mm in row)
        yield voice.say(Phrase("written trial polygon", (mark, Neutral(rates), apart)), spoken)
    sums = divisions(sheet, step, divided)
    said = Neutral("; ".join(
        bound(f"{voice.symbol(s)} = {one.terms} = {one.value} {_unit(sheet, s)}")
        for (s, _), one in zip(divided.found, sums, strict=True)
    ))  # fmt: skip
    told = Phrase("written superposed", (said,))
    if len(sums) > 1:
        parts = ", ".join(one.part for one in sums)
        told = Phrase("written superposed several", (parts, Markup(numeral(1)), listed(numerals[1:]), said))
    yield voice.say(told, spoken)


def _left_open(voice: Voice, step: Step, divided: Superposed) -> object:
    """From which end points to which, and in which directions, something is left open."""
    told = []
    for way, (start, end), less in zip(divided.ways, divided.between, divided.less, strict=True):
        refs = start, end
        a, b = (voice.ends.of(step.diagram, r) or Phrase("point on link", (r.point, r.link)) for r in refs)
        across = "square" if way.relation == "square" else "along"
        if way.names == (start.point, end.point) and start.link == end.link == "":
            said = Phrase(f"open {across} bar", (a, b, *way.names))
        elif start.point != end.point:
            said = Phrase(f"open {across} bar", (a, b, start.point, end.point))
        else:
            said = Phrase(f"open {across} guide", (a, b, "".join(way.names)))
        for one in (one for one in less if abs(one.mm) >= SEEN):
            rule = one.symbol if one.size is None else Phrase("rule of size", (one.symbol, one.size))
            said = Phrase("open less", (said, rule, true_minus(on_paper(one.mm))))
        told.append(said)
    return listed(told)


def _unit(sheet: Sheet, symbol: Symbol) -> str:
    length = sheet.scene.units.rates.length
    return {"omega": "rad/s", "alpha": "rad/s²", "v": f"{length}/s"}.get(symbol.kind, f"{length}/s²")


def _rates(sheet: Sheet, found: Sequence[tuple[Symbol, float]]) -> object:
    """Rates with their units, in a list."""
    return listed([Phrase("rate is", (s, true_minus(number(value, 5)), _unit(sheet, s))) for s, value in found])


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


SENTENCES: Mapping[Reason, Callable[[Voice, Step], Phrase | None]] = {
    "positions": _positions, "polygon": _trial, "open ends": _superposed,
}  # fmt: skip
"""The step as it is said with what is measured in it, by its reason."""
LINES: Mapping[Reason, Callable[[Voice, Step, str], Iterable[str]]] = {
    "positions": _positions_lines, "special point": _special_lines, "open ends": _superposed_lines,
}  # fmt: skip
"""What is written of a step to repeat it, in a language."""
