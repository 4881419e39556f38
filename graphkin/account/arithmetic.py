"""Sums as a student writes them: measured lengths with their millimetres, and rules with numbers in place of symbols.

Every product and quotient is computed from the numbers written before it, so that a reader who does the sum gets the
same; its figures are those that the drawing carries.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from graphkin.account.given import slide_index
from graphkin.account.headings import number
from graphkin.account.notation import Notation, unit_of
from graphkin.construction.board.instruments import EXACT
from graphkin.construction.board.sheet import Sheet, either_way
from graphkin.construction.board.steps import DiagramName, Size, Step
from graphkin.construction.position.links_on_paper import pushed_by_driver
from graphkin.plane import added_up
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words.symbols import RichText, Words, sign
from graphkin.words.written import (
    FINER,
    LEAST,
    MOST,
    amount,
    as_given,
    computed,
    difference,
    figures,
    increased,
    is_quotient,
    on_paper,
    printed,
    product,
    quotient,
)

SAME_RATE = 1e-12  # of rates: what rounding leaves of the difference of two that are the same


def scale_of(sheet: Sheet, diagram: DiagramName) -> float:
    """Scene units for one mm of paper."""
    return sheet.scales.of(diagram) / unit_of(sheet, diagram).si


def arm_written(sheet: Sheet, bar: tuple[str, str], mm: float, most: int) -> str:
    """A length in the unit of rates, for their products and quotients: the given length where a link has both ends,
    however a hand has drawn it, else the value of its mm on paper."""
    held = (link.points for link in sheet.structure.links.values())
    given = (abs(p[bar[0]] - p[bar[1]]) for p in held if bar[0] in p and bar[1] in p and p[bar[0]] != p[bar[1]])
    pushed = pushed_by_driver(sheet.structure, sheet.drivers, bar)
    long = next(given, None) or (pushed and pushed[1])
    if long is None and sheet.instrument != EXACT.name and abs(mm) >= LEAST:
        return product(on_paper(mm), amount(sheet.scales.length / sheet.scene.units.rates.metres, 12))
    metres = sheet.scene.units.rates.metres
    return amount(mm * sheet.scales.length / metres, most) if long is None else as_given(long / metres, most + 1)


def times_scale(sheet: Sheet, diagram: DiagramName, mm: float) -> str:
    """``56.67 mm × 5 (mm/s)/mm = 283.35 mm/s (283.37)``: a length on paper, and in brackets the
    value of an exact drawing, beyond the hundredth of a millimetre."""
    unit, per = unit_of(sheet, diagram).written, scale_of(sheet, diagram)
    length = on_paper(mm)
    value, finer = product(length, amount(per, 12)), amount(mm * per, MOST)
    more = "" if finer == value or sheet.instrument != EXACT.name else f" ({printed(finer)})"
    shown = unit if diagram == "mechanism" else f"({unit})"
    return f"{printed(length)} mm × {number(per)} {shown}/mm = {printed(value)} {unit}{more}"


def lengths_measured(
    sheet: Sheet, letters: Notation, images: bool = False
) -> Iterator[tuple[int, tuple[str, str], RichText]]:
    """Each length that enters a sum and is not given, in the order of use: the number of the first step that uses it,
    its ends, and its millimetres: ``l_O4A = 38.31 mm × 10 mm/mm = 383.1 mm (383.14)``.

    ``images`` tells whether ratios of images are sums too.
    """
    bars: dict[frozenset[str], tuple[int, tuple[str, str]]] = {}
    for step in sheet.steps:
        for bar in _bars_of(step, images):
            if not is_given(sheet, bar):
                bars.setdefault(frozenset(bar), (step.number, bar))
    for step_number, bar in bars.values():
        pushed = pushed_by_driver(sheet.structure, sheet.drivers, bar)
        if pushed is not None:
            driver, far = pushed
            value = f"{printed(as_given(far / sheet.scene.units.metres))} {sheet.scene.units.length}"
            length = sign("s", slide_index(sheet, driver.key)) + f" = {value}"
        else:
            length = RichText(times_scale(sheet, "mechanism", sheet.arm_mm(bar) or 0.0))
        yield step_number, bar, letters.length(bar) + " = " + length


def _bars_of(step: Step, images: bool) -> Iterator[tuple[str, str]]:
    """The bars by whose lengths a step multiplies or divides."""
    if step.reason == "rate":
        yield step.points[0], step.points[1]
    if images and step.reason == "division" and not step.held:
        start, end = (ref.point for ref in step.refs)
        yield from ((start, step.ref.point), (start, end))
    for size in (step.size, *(term.size for term in step.by_rates)):
        if size is not None and size.rule == "rate" and not isinstance(size.factor, Symbol):
            yield size.factor


def is_given(sheet: Sheet, bar: tuple[str, str]) -> bool:
    """Whether a link holds both ends, or one of them is not on the drawing."""
    if any(PointRef(name) not in sheet.points for name in bar):
        return True
    bodies = (sheet.scene.frame, *sheet.scene.links)
    return any(set(bar) <= set(body.points) for body in bodies)


# rates


def rate_sum(sheet: Sheet, step: Step, units: bool = True) -> str:
    """``283.37 mm/s / 383.14 mm = 0.7396 rad/s``, or without units before the result; "" where there is no quotient."""
    divided = _divided(sheet, step)
    if divided is None:
        return ""
    size, arm, value = (printed(text) for text in divided)
    unit = unit_of(sheet, step.diagram).written
    of, over = (f" {unit}", f" {sheet.scene.units.rates.length}") if units else ("", "")
    return f"{size}{of} / {arm}{over} = {value} {step.unit}"


def _divided(sheet: Sheet, step: Step) -> tuple[str, str, str] | None:
    """The numbers of a measured rate as they are written: size, length and quotient; None without them."""
    diagram = step.diagram
    if step.held:
        drawn = (abs(vector.span) for vector in sheet.vectors_seen(step.diagram) if vector.symbol == step.symbol)
        mm, arm_mm, rate = _as_read(sheet, step.symbol, next(drawn, 0.0)), sheet.arm_mm(step.points), step.value
    else:
        turning = sheet.rates[step.kind][step.link]
        arm_mm = sheet.readings.get(frozenset(step.points), turning.arm / sheet.scales.length)
        mm, rate = turning.mm, turning.value
    if mm == 0.0 or not arm_mm:
        return None
    carried = figures(on_paper(mm))
    shown = computed(abs(rate), min(MOST - 1, carried))
    bar = step.points[0], step.points[1]
    tried = [
        (_carried(sheet, diagram, mm, carried, most), arm_written(sheet, bar, arm_mm, most))
        for most in FINER
    ]
    size, arm = next((t for t in tried if quotient(*t, min(MOST - 1, carried)) == shown), tried[0])
    if sheet.instrument != EXACT.name:
        return size, arm, shown  # as it was written down: a tie is broken once
    return size, arm, quotient(size, arm, min(MOST - 1, carried))


def plan_sum(step: Step) -> str:
    """``30.00 mm × 0.25 (rad/s)/mm = 7.5 rad/s``: a rate read from the plan of a train."""
    length, scale = on_paper(step.mm), amount(step.per_mm, 12)
    return f"{length} mm × {scale} ({step.unit})/mm = {product(length, scale)} {step.unit}"


@dataclass(frozen=True)
class Division:
    """A rate found from trial polygons: ``9 + 15.14 / 5.24 × 1``, its value, and the ``part`` of the step."""

    terms: str
    value: str
    part: str


def trials_of(sheet: Sheet, divided: Step) -> list[Step]:
    """The trial polygons whose gaps a step divides."""
    return [step for step in sheet.before(divided) if step.reason == "polygon"][-len(divided.apart) :]


def divisions(sheet: Sheet, divided: Step) -> list[Division]:
    """The division that gives each rate from its first assumed value and the step to its other trial: by the gaps of
    the two trials for a single assumed rate, else by the parts of the steps that close all gaps."""
    trials = trials_of(sheet, divided)
    quotients = []
    for i, (_, rate) in enumerate(divided.rates):
        low = trials[0].rates[i][1]
        more = trials[i + 1].rates[i][1] - low
        start, size = amount(low, MOST), amount(abs(more), MOST)
        if len(divided.rates) == 1:
            first, second = (on_paper(row[0]) for row in divided.apart)
            over, under = on_paper(abs(divided.apart[0][0])), on_paper(float(difference(first, second)))
            less, most = (printed(mm) for mm in sorted((first.lstrip("-"), second.lstrip("-")), key=float))
            whole = f"({less} + {most})" if first.startswith("-") != second.startswith("-") else f"({most} − {less})"
            if under == "0":  # the trials differ by less than a ruler shows
                under = amount(abs(divided.apart[0][0] - divided.apart[1][0]), 3)
                whole = printed(under)
            added = quotient(product(over, size), under, figures(over, under))
            part = f"{printed(over)} / {whole}"
        else:
            share = amount(abs((rate - low) / more), 4)
            added, part = product(share, size, carried=figures(share)), printed(share)
        falls = rate < low
        finer = computed(rate, MOST)
        by_hand = sheet.instrument != EXACT.name  # who has written it down already
        value = finer if by_hand else increased(start, f"-{added}" if falls else added)
        exact = "" if finer == value else f" ({printed(finer)})"
        terms = f"{printed(start)} {'−' if falls else '+'} {part} × {printed(size)}"
        quotients.append(Division(terms, printed(value) + exact, ("" if falls == (more < 0.0) else "−") + part))
    return quotients


def _carried(sheet: Sheet, diagram: DiagramName, mm: float, carried: int, most: int) -> str:
    """The value of a length on paper: of an exact drawing with one figure more than paper shows, or with more."""
    if sheet.instrument != EXACT.name:
        return product(on_paper(mm), amount(scale_of(sheet, diagram), 12))
    return amount(mm * scale_of(sheet, diagram), min(MOST, carried + 1) + most - MOST)


def factors_of(sheet: Sheet, rule: Size | None, most: int = MOST) -> tuple[str, ...]:
    """The numbers whose product is a size, to ``most`` figures, measured ones as on the sheet; none without a rule."""
    if rule is None:
        return ()
    if rule.rule == "rolling curves":
        turning = amount(abs(_turning(sheet, "omega", rule.links)), most)
        return turning, turning, amount(rule.radius / sheet.scene.units.metres, most)
    if rule.rule != "rate":
        return ()
    by = rule.factor
    mm = _span(sheet, by) if isinstance(by, Symbol) else sheet.arm_mm(by)
    if mm is None:
        return ()
    if not isinstance(by, Symbol):
        factor = arm_written(sheet, by, mm, most)
    elif most == MOST and sheet.instrument != EXACT.name:
        factor = product(on_paper(mm), amount(scale_of(sheet, "velocity"), 12))
    else:
        factor = amount(mm * scale_of(sheet, "velocity"), most)
    read = _rate_read(sheet, rule) if most == MOST else ""
    rate = read or amount(abs(_turning(sheet, rule.rate, rule.links)), most)
    return (*("2",) * rule.twice, *(rate,) * (1 + rule.square), factor)


def carried_by(sheet: Sheet, rule: Size | None) -> int:
    """The figures of a product: the least of its measured numbers."""
    if sheet.instrument == EXACT.name or rule is None or rule.rule != "rate":
        return MOST
    read = [_rate_read(sheet, rule)]
    if isinstance(rule.factor, Symbol):
        read.append(on_paper(_span(sheet, rule.factor) or 0.0))
    elif not is_given(sheet, rule.factor):
        read.append(on_paper(sheet.arm_mm(rule.factor) or 0.0))
    return min((figures(text) for text in read if text and text != "0"), default=MOST)


def _rate_read(sheet: Sheet, rule: Size) -> str:
    """The measured rate of a link, the quotient on the sheet; "" for another."""
    if sheet.instrument == EXACT.name or len(rule.links) > 1:
        return ""
    rate = sheet.rates[rule.rate][rule.links[0]]
    link = rate.same_as or rate.link
    read = (s for s in sheet.steps if s.reason == "rate" and not s.held)
    measured = next((step for step in read if (step.kind, step.link) == (rule.rate, link)), None)
    divided = None if measured is None or abs(measured.value) != abs(rate.value) else _divided(sheet, measured)
    return "" if divided is None else divided[2]


def _turning(sheet: Sheet, rate: Literal["omega", "alpha"], links: Sequence[str]) -> float:
    """The rate of a link (rad/s, rad/s2), or of the first of two as seen from the second."""
    rates = [sheet.rates[rate][name].value for name in links]
    turning = rates[0] - added_up(rates[1:])
    return turning if abs(turning) > SAME_RATE * max(map(abs, rates)) else 0.0


def substituted(rule: Size | None, factors: tuple[str, ...]) -> str:
    """A rule of a size with numbers in place of its symbols: ``2 × 2.819 × 575.4`` for 2ω v."""
    shown = [printed(factor) for factor in factors]
    if rule is not None and (rule.square or rule.rule == "rolling curves"):
        del shown[-2]
        shown[-2] = f"({shown[-2]})²" if "·" in shown[-2] else f"{shown[-2]}²"
    return " × ".join(shown)


def rule_sum(sheet: Sheet, rule: Size | None, diagram: DiagramName) -> str:
    """``0.7396² × 383.14 = 209.58 mm/s²``; "" where no numbers are known."""
    factors = factors_of(sheet, rule)
    if not factors:
        return ""
    value = printed(product(*factors, carried=carried_by(sheet, rule)))
    return f"{substituted(rule, factors)} = {value} {unit_of(sheet, diagram).written}"


def _span(sheet: Sheet, symbol: Symbol) -> float | None:
    """The length of a drawn velocity (mm), as read by a finite instrument."""
    drawn = sheet.vectors["velocity"].get(symbol)
    if drawn is None:
        drawn = next((vector for vector in sheet.vectors_seen("velocity") if vector.symbol == symbol), None)
    return None if drawn is None else _as_read(sheet, symbol, abs(drawn.span))


def _as_read(sheet: Sheet, symbol: Symbol, mm: float) -> float:
    return abs(sheet.readings.get(either_way(symbol), mm)) if mm else 0.0


def laid_sum(sheet: Sheet, diagram: DiagramName, rule: Size | None, mm: float) -> tuple[str, str]:
    """``0.7396² × 383.14 = 209.58 mm/s²`` (without a rule the value alone), and its quotient ``÷ 10 (mm/s²)/mm = 20.96
    mm``, for a vector of a length on paper: with the figures that make both true as written."""
    per, unit = scale_of(sheet, diagram), unit_of(sheet, diagram).written
    length, scale, least = on_paper(mm), amount(per, 12), carried_by(sheet, rule)
    tried = [
        (factors, product(*factors, carried=least + most - MOST) if factors else amount(mm * per, most))
        for most in FINER for factors in (factors_of(sheet, rule, most),)
    ]
    factors, value = next((t for t in tried if is_quotient(length, t[1], scale)), tried[0])
    middle = f"{substituted(rule, factors)} = " if factors else ""
    shown = f"{printed(value)} {unit}"
    return f"{middle}{shown}", f"{shown} ÷ {number(per)} ({unit})/mm = {printed(length)} mm"


def bound(text: Words) -> RichText:
    """A sum that breaks only before the sign of equality."""
    return RichText(text).with_words(
        lambda words: words.replace(" ", "\u00a0").replace("\u00a0=\u00a0", " =\u00a0")
    )
