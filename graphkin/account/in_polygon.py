"""Steps of a polygon as they are told: each from a lettered point, in a sense, to a lettered point; rates with the
quotients that give them; trial polygons with what is left open, and how it is divided."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial, reduce
from typing import get_args

from graphkin.account.arithmetic import (
    bound,
    divisions,
    laid_sum,
    parts_by_rates,
    plan_sum,
    rate_sum,
    rule_sum,
    scale_of,
    times_scale,
    trials_of,
    unit_of,
)
from graphkin.account.headings import number, term, written
from graphkin.account.in_mechanism import numeral
from graphkin.account.voice import SAME, Voice
from graphkin.construction.sheet import Rate, Sheet
from graphkin.construction.steps import (
    GIVEN,
    Aid,
    Arrow,
    Bar,
    Direction,
    RateTrial,
    Ray,
    Reason,
    Role,
    Size,
    Step,
    Superposed,
    Term,
    Vector,
    end_of,
)
from graphkin.plane import dot
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Markup, Neutral, Phrase, in_turn, languages, listed
from graphkin.words.written import MOST, amount, on_paper, pointing, quotient, true_minus

__all__ = ["LINES", "SENTENCES", "SUMS", "alike", "measured", "rate_name"]

SEEN = 0.005  # mm on paper: less than that is not taken off
RATE_UNITS = {"omega": "rad/s", "alpha": "rad/s²"}
ON_THE_POINT = 1e-9  # of a bar: so near to its end a point divides nothing


# -- the letters between which a step goes -----------------------------------------------------------------------------


def _drawn(step: Step) -> Vector | Aid | None:
    """The vector of a step; those of trial polygons bear no letters."""
    return next((s for s in step.strokes if isinstance(s, Vector) or (isinstance(s, Aid) and not s.trial)), None)


def _sides(sheet: Sheet, step: Step) -> tuple[tuple[Term, ...], ...]:
    """The sides of the equation of a step."""
    return sheet.equations[step.equation - 1].sides if step.equation is not None else ()


def _between(voice: Voice, step: Step, tail: complex, tip: complex) -> Markup | None:
    """A vector by the letters of its ends: ``pb``; None where the convention has no letters, and where it is so small
    that one letter stands for both."""
    ends = voice.end_at(step.diagram, tail), voice.end_at(step.diagram, tip)
    return None if None in ends or ends[0] == ends[1] else _joined(*ends)


def _start(voice: Voice, step: Step, at: complex) -> Phrase | None:
    """Where a vector begins: a letter, or the end of a vector."""
    letter = voice.end_at(step.diagram, at)
    if letter is not None:
        return Phrase("the pole" if abs(at) < SAME else "the point", (letter,))
    before = _before(voice.sheet, step, None, at)
    return Phrase("the end of", (before,)) if before else None


def _before(sheet: Sheet, step: Step, symbol: Symbol | None, at: complex) -> Symbol | None:
    """The vector that ends in a place: the one before it in the equation as written, else the one drawn last."""
    drawn: dict[Symbol, complex] = {}
    for one in sheet.before(step):
        for stroke in one.strokes if one.diagram == step.diagram else ():
            if isinstance(stroke, Bar) and one.reason == "before its turn":
                drawn[one.symbol] = stroke.b
            elif isinstance(stroke, Arrow):
                drawn[stroke.symbol] = stroke.tip
    there = [s for s, tip in drawn.items() if abs(tip - at) < SAME]
    for side in _sides(sheet, step) if symbol is not None else ():
        terms = [term.symbol for term in side]
        if symbol in terms[1:] and terms[terms.index(symbol) - 1] in there:
            return terms[terms.index(symbol) - 1]
    return there[-1] if there else None


# -- vectors -----------------------------------------------------------------------------------------------------------


def _laid_off(voice: Voice, step: Step) -> Phrase | None:
    vector = _drawn(step)
    if vector is None or step.mm == 0.0:
        return None
    key = {"normal": "as normal", "coriolis": "as Coriolis"}.get(step.reason, "as vector")
    rule = Phrase(key, (_rule(step.symbol, step.size),))
    told = _lay(voice, step, "lay off", rule, step.mm, step.direction, (vector.tail, vector.tip))
    why = _carried_over(voice.sheet, step)
    return told if why is None else Phrase("in turn", (told or step.phrase, why))


def _lay(
    voice: Voice, step: Step, verb: str, rule: object, mm: float, direction: Direction, ends: tuple[complex, complex]
) -> Phrase | None:
    """A vector of so many mm that is laid off or carried from a place to another, by their letters where they have
    some."""
    start = _start(voice, step, ends[0])
    if start is None:
        return None
    what = rule, on_paper(mm), _pointing(direction, ends[1] - ends[0])
    name = _between(voice, step, *ends)
    if name is None:
        return Phrase(f"{verb} from", (start, *what))
    return Phrase(f"{verb} lettered", (start, name, *what, voice.end_at(step.diagram, ends[1])))


def _carried_over(sheet: Sheet, step: Step) -> Phrase | None:
    """From what seen from a held link a vector between points of two links follows, which is laid off as it was found;
    an acceleration with the share of Coriolis that the turning of the other of them adds."""
    of, to = step.symbol.of, step.symbol.to
    if step.size is not None or step.mm == 0.0 or of is None or step.direction.names:
        return None
    before = sheet.before(step)
    held = {s.held for s in before if s.reason == "seen from"}
    kind = step.symbol.kind[0]
    gives = (s.symbol for s in reversed(before) if s.reason in ("vector", "pole to end") or (s.held and s.begins))
    seen = next((
        one for one in gives if one.kind == kind and one.of is not None and one.to is not None and one.to.link in held
        and one.of.point == one.to.point == of.point
    ), None)  # fmt: skip
    if seen is None or seen.to is None:
        return None
    against = of.link == seen.to.link
    told = Phrase("against", (seen,)) if against else seen
    if kind == "v" or to is None or not against:
        return Phrase("written carried over", (step.symbol, told))
    slip = next(s.symbol for s in before if s.verb == "lay off" and s.symbol.of == of and s.symbol.kind == "v")
    size = Size("rate", (seen.to.link, to.link), slip, twice=True)
    turning = sheet.omega[seen.to.link].value - sheet.omega[to.link].value
    key = "written carried over coriolis cw" if turning < 0.0 else "written carried over coriolis ccw"
    rule = Phrase("rule of size", (size, bound(rule_sum(sheet, size, "acceleration"))))
    return Phrase(key, (step.symbol, told, rule, slip))


def _laid_sums(voice: Voice, step: Step) -> Iterable[str]:
    vector = _drawn(step)
    return measured(voice, step) if step.mm == 0.0 or vector is None else _laid(voice, step, step.size, vector.span)


def _laid(voice: Voice, step: Step, size: Size | None, span: complex) -> tuple[str, str]:
    """The rule of a vector in numbers, and its length on paper."""
    computed, on_scale = laid_sum(voice.sheet, step.diagram, size, abs(span))
    return f"{voice.symbol(step.symbol)} = {computed}", on_scale


def measured(voice: Voice, step: Step) -> Iterator[str]:
    """Each vector of a step as it is measured."""
    for vector in (s for s in step.strokes if isinstance(s, Vector)):
        size = abs(vector.span)
        value = times_scale(voice.sheet, step.diagram, size) if size else "0"
        yield f"{voice.symbol(vector.symbol)} = {value}"


def _found(voice: Voice, step: Step) -> Phrase | None:
    vector = _drawn(step)
    name = _between(voice, step, vector.tail, vector.tip) if vector is not None and step.mm else None
    return Phrase("found lettered", (name, step.symbol, on_paper(step.mm))) if name else None


def _line(voice: Voice, step: Step) -> Phrase | None:
    ray = next((s for s in step.strokes if isinstance(s, Ray)), None)
    if ray is None:
        return None
    letter = voice.end_at(step.diagram, ray.through)
    # a vector, or the sum of those of its side whose sizes are unknown along it
    side = next((side for side in _sides(voice.sheet, step) if any(t.symbol == step.symbol for t in side)), ())
    along = next((t.direction for t in side if t.symbol == step.symbol), None)
    unknown: list[object] = [t.symbol for t in side if not t.size_known and t.direction == along]
    what = reduce(lambda one, other: Phrase("sum", (one, other)), unknown or [step.symbol])
    if abs(ray.through) < SAME:
        return Phrase("direction from pole", (what, step.direction, letter))
    before = _before(voice.sheet, step, step.symbol, ray.through)
    if letter is None:
        return Phrase("direction from end", (what, step.direction, before)) if before else None
    if before is None:
        return Phrase("direction from point", (what, step.direction, letter))
    return Phrase("direction from lettered end", (what, step.direction, before, letter))


def _end_point(key: str, voice: Voice, step: Step) -> Phrase | None:
    letter = voice.end_of(step.diagram, step.ref)
    return Phrase(key, (letter, step.ref)) if letter else None


def _join(key: str, voice: Voice, step: Step) -> Phrase | None:
    """A vector drawn from letter to letter."""
    vector = _drawn(step)
    name = _between(voice, step, vector.tail, vector.tip) if vector is not None else None
    if vector is None or name is None:
        return None
    ends = voice.end_at(step.diagram, vector.tail), voice.end_at(step.diagram, vector.tip)
    return Phrase(key, (*ends, name, step.symbol))


def _carried(voice: Voice, step: Step) -> Phrase | None:
    """A known term behind the unknown one, laid off before it."""
    bar = next((s for s in step.strokes if isinstance(s, Bar)), None)
    term = next((term for side in _sides(voice.sheet, step) for term in side if term.symbol == step.symbol), None)
    if bar is None or term is None or term.direction is None or _start(voice, step, bar.a) is None:
        return None
    length = abs(bar.b - bar.a)
    if length < SAME:
        return Phrase("zero vector", (step.symbol,))
    return _lay(voice, step, "carry", _rule(step.symbol, term.size), length, term.direction, (bar.a, bar.b))


def _carried_sums(voice: Voice, step: Step) -> Iterable[str]:
    if step.equation is None:
        return measured(voice, step)
    size = next((t.size for side in _sides(voice.sheet, step) for t in side if t.symbol == step.symbol), None)
    bar = next((s for s in step.strokes if isinstance(s, Bar) and s.b != s.a), None)
    return _laid(voice, step, size, bar.b - bar.a) if bar and size else ()


# -- images ------------------------------------------------------------------------------------------------------------


def _image(voice: Voice, step: Step) -> Phrase | None:
    """The division of a line, with its ratio, or the similar triangle."""
    if step.held:
        return None
    refs = (step.ref, *step.refs)
    places = [voice.sheet.points.get(PointRef(ref.point)) for ref in refs]
    ends = [voice.end_of(step.diagram, ref) for ref in refs]
    bars = [voice.letters.point(ref.point) for ref in refs]
    if step.reason == "similar":
        return None if None in ends else _triangle(step, places, ends, bars)
    at, a, b = places
    if at is None or a is None or b is None or abs(b - a) < SAME:
        return None
    along = dot(at - a, b - a) / abs(b - a) ** 2
    if abs(along) < ON_THE_POINT:
        return None
    where = "before" if along < 0.0 else "within" if along <= 1.0 else "beyond"
    unit = voice.sheet.scales.length / voice.sheet.scene.units.metres
    part, bar = (amount(abs(z - a) * unit, 4) for z in (at, b))
    numbers = (written(one) for one in (part, bar, quotient(part, bar, 4)))  # the ratio of what stands there
    whole = (Markup(bars[1] + bars[0]), Markup(bars[1] + bars[2]), *numbers)
    if None in ends or voice.end_point(step.diagram, step.ref) is None:
        return Phrase(f"division {where}", (*refs, step.link, *whole))
    names = (ends[0], _joined(*ends[1:]), _joined(ends[1], ends[0]), ends[1], ends[2])
    return Phrase(f"division lettered {where}", (*names, step.link, *whole))


def _triangle(
    step: Step, places: Sequence[complex | None], ends: Sequence[Markup | None], bars: Sequence[str]
) -> Phrase:
    """The similar triangle, with the ratios by which a compass finds its third corner."""
    names = (ends[0], _joined(*ends[1:], ends[0]), Markup("".join((*bars[1:], bars[0]))), step.link)
    at, a, b = places
    if at is None or a is None or b is None or abs(b - a) < SAME:
        return Phrase("image lettered", names)
    ratios = [number(abs(at - z) / abs(b - a), 4) for z in (a, b)]
    sides = _joined(ends[1], ends[0]), _joined(ends[2], ends[0]), _joined(*ends[1:])
    return Phrase("image with sides", (*names, *sides, *ratios))


def _image_lines(voice: Voice, step: Step, language: str) -> Iterator[str | Phrase]:
    """``△bce ∼ △BCE``, or ``pm : pd = AM : AD`` for a point between others; where a convention has no end points the
    vector with what is similar on the link, nothing for one that is not drawn."""
    on_line = step.reason == "division"
    if step.held:
        yield Phrase("written image seen", (step.symbol, step.link))
        return
    refs = (*step.refs, step.ref)
    ends = [voice.end_of(step.diagram, ref) for ref in refs]
    one, two, three = (voice.letters.point(ref.point) for ref in refs)
    if None in ends:
        vector = Symbol("v" if step.diagram == "velocity" else "a", step.ref)
        if voice.letters.convention == "us" and vector in voice.sheet.vectors(step.diagram):
            similar = f"${one}{three}$ : ${one}{two}$" if on_line else f"△${one}{two}{three}$"
            named = Phrase("written image named", (vector, step.link, Neutral(similar)))
            yield bound(voice.say(named, languages(language)[0]))
        return
    a, b, c = (str(end) for end in ends)
    if on_line:
        yield bound(f"${a}{c}$ : ${a}{b}$ = ${one}{three}$ : ${one}{two}$")
    else:
        yield bound(f"△${a}{b}{c}$ ∽ △${one}{two}{three}$")


def _by_rates(voice: Voice, step: Step) -> Phrase | None:
    """An end point from another of its link: what the rates give, laid off one behind the other."""
    letters = [voice.end_of(step.diagram, ref) for ref in (*step.refs, step.ref)]
    if not step.held and None in letters:
        return None
    start = end_of(step.begins[0]) if step.held else Phrase("the point", (letters[0],))
    laid = list[Phrase]()
    for part in parts_by_rates(voice.sheet, step):
        rule = Phrase("as normal" if part.rule.square else "as vector", (_rule(part.symbol, part.rule),))
        way = part.direction if part.rule.square else Phrase("pointing", (part.direction, pointing(part.span)))
        laid.append(Phrase("lay off from", (start, rule, on_paper(abs(part.span)), way)))
        start = Phrase("the end of", (part.symbol,))
    if not laid:
        return None
    told = in_turn(laid)
    return Phrase("ends seen", (told, step.symbol)) if step.held else Phrase("ends in", (told, letters[1]))


def _by_rates_sums(voice: Voice, step: Step) -> Iterator[str]:
    """The parts of a relative vector that follow from the rates of a link, each with its length and direction."""
    per, unit = scale_of(voice.sheet, step.diagram), unit_of(voice.sheet, step.diagram)
    parts = parts_by_rates(voice.sheet, step)
    for said, part in zip(_by_rates_lines(voice, step, "en"), parts, strict=True):
        yield said
        yield f"÷ {number(per)} ({unit})/mm = {written(on_paper(abs(part.span)))} mm,  {pointing(part.span)}°"
    yield from measured(voice, step)


def _by_rates_lines(voice: Voice, step: Step, language: str) -> Iterator[str]:
    """``v_CB = ω_3 l_CB = 1.4737 × 151.21 = 222.84 mm/s,  ⊥CB``."""
    letters = voice.letters
    for part in parts_by_rates(voice.sheet, step):
        way = letters.direction(part.direction, voice.sheet.scene.frame.name)
        rule = f"${letters.size(part.rule)}$ =\u00a0{bound(rule_sum(voice.sheet, part.rule, step.diagram))}"
        yield f"{voice.symbol(part.symbol)} =\u00a0{rule},  ${way}$"


# -- rates -------------------------------------------------------------------------------------------------------------


def _rates(sheet: Sheet, step: Step) -> Mapping[str, Rate]:
    return sheet.omega if step.kind == "omega" else sheet.alpha


def _turning_links(sheet: Sheet, step: Step) -> tuple[str, ...]:
    """The links that turn as a rate says, as indices of it."""
    if step.held:
        return (step.link + step.held,)
    rates = _rates(sheet, step)
    return (step.link, *alike(rates.values(), rates[step.link]))


def _rate_sums(voice: Voice, step: Step) -> Iterable[str]:
    value = rate_sum(voice.sheet, step) or f"{number(abs(step.value), MOST)} {RATE_UNITS[step.kind]}"
    return (f"{rate_name(step.kind, _turning_links(voice.sheet, step)[0])} = {value}",)


def _rate_lines(voice: Voice, step: Step, language: str) -> Iterator[str]:
    """``ω_4 = ω_3 = v_A4 / l_AO4 = 0.74 rad/s, clockwise``: the quotient of a vector and a bar."""
    value = step.value if step.held else _rates(voice.sheet, step)[step.link].value
    rule = f"{voice.symbol(step.symbol)} / ${voice.letters.length(step.points)}$"
    shown = bound(rate_sum(voice.sheet, step, units=False)) or f"{number(abs(value), 5)} {RATE_UNITS[step.kind]}"
    names = (rate_name(step.kind, name) for name in _turning_links(voice.sheet, step))
    yield " =\u00a0".join((*names, rule, shown)) + _turning(value, language)


def _held_still_lines(voice: Voice, step: Step, language: str) -> Iterator[str]:
    """``ω_32 = 0.1437 rad/s, clockwise, drawn apart, with one link held still``."""
    if step.kind in RATE_UNITS:
        value = f"{number(abs(step.value), 5)} {RATE_UNITS[step.kind]}{_turning(step.value, language)}"
        yield f"{rate_name(step.kind, step.link + step.held)} = {value},  {term('held still', language)}"


def _plan_lines(voice: Voice, step: Step, language: str) -> Iterator[str]:
    """``ω_3 = 30.00 mm × 0.25 (rad/s)/mm = 7.5 rad/s, clockwise``: read off the plan of a train."""
    value = f"{bound(plan_sum(step))}{_turning(step.value, language)}" if step.value else "0"
    yield f"{rate_name(step.kind, step.link)} = {value}"


def rate_name(kind: str, link: str) -> str:
    """The letter of an angular rate with its link."""
    return f"${'ω' if kind == 'omega' else 'α'}_{{{link}}}$"


def alike(rates: Iterable[Rate], rate: Rate) -> list[str]:
    """Links that turn as another, blocks of pins left out."""
    return [
        other.link for other in rates if other.same_as == rate.link and other.value == rate.value
        and "/" not in other.link
    ]  # fmt: skip


def _turning(value: float, language: str) -> str:
    return "" if value == 0.0 else f",  {term('clockwise' if value < 0 else 'counter-clockwise', language)}"


# -- trial polygons ----------------------------------------------------------------------------------------------------


def _trial(voice: Voice, step: Step) -> Phrase | None:
    """A trial polygon: which steps draw it, and in the first one why it is drawn."""
    trial, sheet = step.data, voice.sheet
    assert isinstance(trial, RateTrial)
    # the steps by which it is drawn like the true polygon
    aids = {s.symbol for s in step.strokes if isinstance(s, Aid)}
    later = [s for s in sheet.steps[step.number :] if s.diagram == step.diagram]
    first = next(s.number for s in later if s.reason == "open ends") + 1
    own = (s for s in later if s.number >= first and any(getattr(x, "symbol", None) in aids for x in s.strokes))
    last = max((s.number for s in own), default=first)
    told = Phrase("trial lettered", (numeral(trial.number), _assumed(sheet, trial.assumed), first, last))
    if trial.number > 1:
        return told
    if trial.far is None:
        return Phrase("superposed since none", (told,))
    angle = number(math.degrees(trial.far.crossing), 2)
    away = f"{trial.far.away / sheet.scales.length:.0f}"
    return Phrase("superposed since far", (told, *trial.far.links, angle, away))


def _superposed(voice: Voice, step: Step) -> Phrase | None:
    """What the trials leave open, measured from letter to letter, and the proportional division in numbers."""
    divided, sheet = step.data, voice.sheet
    assert isinstance(divided, Superposed)
    where = _left_open(voice, step, divided)
    rows = true_minus("; ".join(
        f"{numeral(i)} " + ", ".join(on_paper(mm) for mm in row) for i, row in enumerate(divided.apart, 1)
    )) + " mm"  # fmt: skip
    found, sums = _assumed(sheet, divided.found), divisions(sheet, step, divided)
    if len(sums) > 1:
        return Phrase("superposed several", (where, rows, ", ".join(one.part for one in sums), found))
    return Phrase("superposed one", (where, rows, sums[0].terms, found))


def _superposed_lines(voice: Voice, step: Step, language: str) -> Iterator[Phrase]:
    """What is measured, ``I: ω_3 = 0.2 rad/s; open 3.21 mm``, a line for each trial, and the proportional division."""
    divided, sheet = step.data, voice.sheet
    assert isinstance(divided, Superposed)
    trials = trials_of(sheet, step, divided)
    numerals = [Markup(numeral(trial.number)) for trial in trials]
    opened = _left_open(voice, step, divided)
    yield Phrase("written trials", (listed(numerals), ", ".join(divided.closing), opened))
    for trial, mark, row in zip(trials, numerals, divided.apart, strict=True):
        rates = ", ".join(f"{voice.symbol(s)} = {number(v, 5)} {_unit(sheet, s)}" for s, v in trial.assumed)
        apart = ", ".join(written(on_paper(mm)) for mm in row)
        yield Phrase("written trial polygon", (mark, Neutral(rates), apart))
    sums = divisions(sheet, step, divided)
    said = Neutral("; ".join(
        bound(f"{voice.symbol(s)} = {one.terms} = {one.value} {_unit(sheet, s)}")
        for (s, _), one in zip(divided.found, sums, strict=True)
    ))  # fmt: skip
    told = Phrase("written superposed", (said,))
    if len(sums) > 1:
        parts = ", ".join(one.part for one in sums)
        told = Phrase("written superposed several", (parts, Markup(numeral(1)), listed(numerals[1:]), said))
    yield told


def _left_open(voice: Voice, step: Step, divided: Superposed) -> object:
    """From which end points to which, and in which directions, something is left open."""
    told = []
    for way, (start, end), less in zip(divided.ways, divided.between, divided.less, strict=True):
        refs = start, end
        a, b = (voice.end_of(step.diagram, r) or Phrase("point on link", (r.point, r.link)) for r in refs)
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


def _assumed(sheet: Sheet, found: Sequence[tuple[Symbol, float]]) -> object:
    """Rates with their units, in a list."""
    return listed([Phrase("rate is", (s, true_minus(number(value, 5)), _unit(sheet, s))) for s, value in found])


# -- words -------------------------------------------------------------------------------------------------------------


def _rule(symbol: Symbol, size: Size | None) -> Symbol | Phrase:
    """A vector with the rule of its size, where that is not just given."""
    return symbol if size is None or size == GIVEN else Phrase("rule of size", (symbol, size))


def _pointing(direction: Direction, span: complex) -> Direction | Phrase:
    """A direction with its sense, where that does not lie in its name."""
    if direction.relation == "towards":
        return direction
    angle = pointing(span)
    return Phrase("pointing", (direction, angle)) if direction.names else Phrase("pointing only", (angle,))


def _joined(*letters: Markup | None) -> Markup:
    return Markup("".join(letter for letter in letters if letter))


ROLES: tuple[Role, ...] = get_args(Role)
SENTENCES: Mapping[Reason, Callable[[Voice, Step], Phrase | None]] = {
    **dict.fromkeys(ROLES, _laid_off), "vector": _found, "direction": _line, "lines": partial(_end_point, "meet in"),
    "letter": partial(_end_point, "name letter"), "pole to end": partial(_join, "join"),
    "asked": partial(_join, "asked lettered"), "before its turn": _carried, "similar": _image, "division": _image,
    "rates": _by_rates, "polygon": _trial, "open ends": _superposed,
}  # fmt: skip
"""The step as it is said with the letters of its points, by its reason; None where it has none."""
SUMS: Mapping[Reason, Callable[[Voice, Step], Iterable[str]]] = {
    **dict.fromkeys(ROLES, _laid_sums), "before its turn": _carried_sums, "rates": _by_rates_sums,
    "rate": _rate_sums,
    "plan": lambda voice, step: [f"{rate_name(step.kind, step.link)} = {plan_sum(step)}"],
}  # fmt: skip
"""What is computed in a step, where that is more than its vectors as they are `measured`."""
LINES: Mapping[Reason, Callable[[Voice, Step, str], Iterable[str | Phrase]]] = {
    **dict.fromkeys(ROLES, lambda voice, step, language: filter(None, [_carried_over(voice.sheet, step)])),
    "similar": _image_lines, "division": _image_lines,
    "rates": _by_rates_lines, "rate": _rate_lines,
    # a link whose turning relative to another is known, as soon as that one turns at a known rate:
    # ω_2 = ω_3 + ω_23 = −0.04162 + 0.08323 = 0.04161 rad/s
    "sum of rates": lambda voice, step, language: [bound(voice.say(step.phrase, languages(language)[0]))],
    "held still": _held_still_lines, "plan": _plan_lines, "open ends": _superposed_lines,
}  # fmt: skip
"""What is written of a step to repeat it, in a language."""
