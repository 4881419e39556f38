"""What is written to repeat a construction, in its order: lengths measured, equations with products, angular rates."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from graphkin.account.arithmetic import (
    bound,
    factors_of,
    parts_by_rates,
    plan_sum,
    rate_sum,
    rule_sum,
)
from graphkin.account.group_lines import GroupLines
from graphkin.account.headings import number, term
from graphkin.account.measured_lengths import lengths_measured
from graphkin.account.notation import Letters
from graphkin.construction.mechanism_acts import HeldStill, PitchPoint, SpecialPoint, TrialPositions
from graphkin.construction.polygon_acts import (
    AddedRate,
    ByImage,
    ByRate,
    Carried,
    ImageSeen,
    LaidOff,
    MeasuredRate,
    PlanDrawn,
    RateSeen,
    SeenByRate,
    SeenFrom,
    Superposed,
)
from graphkin.construction.sheet import Equation, Rate, Sheet, Step
from graphkin.words import languages

__all__ = ["WrittenLine", "by_rates", "rule_alone", "written_lines"]

WrittenLine = Equation | str
"""A vector equation, or a rule on one line as words with symbols."""


def written_lines(sheet: Sheet, letters: Letters, language: str) -> list[WrittenLine]:
    """Everything that is written to repeat a construction, in its order: what is measured on the mechanism, each vector
    equation with its products in numbers, and the angular rates where they are known."""
    spoken = languages(language)[0]
    lines: list[WrittenLine] = []
    written: set[int] = set()
    lengths = [*lengths_measured(sheet, letters)]
    to_come = {s.act.point for s in sheet.steps if isinstance(s.act, SpecialPoint | PitchPoint)}
    group = GroupLines(sheet, letters, spoken)
    before: object = None
    for step in sheet.steps:
        if step.diagram != "mechanism":  # what is measured from the mechanism stands there by now
            ready = [one for one in lengths if to_come.isdisjoint(one[0])]
            lines += [bound(line) for _, line in ready]
            lengths = [one for one in lengths if one not in ready]
        elif isinstance(step.act, SpecialPoint | PitchPoint):
            to_come.discard(step.act.point)
        if step.equation is not None and step.equation not in written:
            written.add(step.equation)
            equation = sheet.equations[step.equation - 1]
            if step.diagram not in {one.diagram for one in lines if isinstance(one, Equation)}:
                lines += _shared_with_drivers(sheet, equation)
            if isinstance(step.act, SeenFrom):
                lines.append(group.seen_from(step.act))
            lines.append(equation)
            lines += _products(sheet, equation, letters)
        if isinstance(step.act, MeasuredRate):
            lines.append(_measured(sheet, step.act, letters, language))
        elif isinstance(step.act, AddedRate):
            lines.append(group.added(step.act))
        elif isinstance(step.act, RateSeen):
            lines.append(_seen(sheet, step.act, letters, language))
        elif isinstance(step.act, HeldStill) and step.act.gives in ("omega", "alpha"):
            lines.append(_held_still(step.act, language))
        elif isinstance(step.act, ByRate | SeenByRate):
            lines += by_rates(sheet, step, step.act, letters)
        elif isinstance(step.act, PlanDrawn) and not step.act.known:
            lines.append(_off_plan(step.act, language))
        elif isinstance(step.act, SpecialPoint):
            lines.append(group.special(step.act))
        elif isinstance(step.act, TrialPositions):
            lines.append(group.position(step, step.act))
        elif isinstance(step.act, Superposed):
            lines += group.trials(step, step.act)
        elif isinstance(step.act, LaidOff):
            said = group.carried_over(step, step.act)
            lines += [said] if said else []
        elif isinstance(step.act, ByImage | ImageSeen):
            said = group.image(step, step.act)
            last = isinstance(before, ByImage | ImageSeen) and lines and isinstance(lines[-1], str)
            lines = [*lines[:-1], f"{lines[-1]};  {said}"] if said and last else [*lines, *filter(None, [said])]
        before = step.act
    return lines


def _measured(sheet: Sheet, act: MeasuredRate, letters: Letters, language: str) -> str:
    """``ω_4 = ω_3 = v_A4 / l_AO4 = 0.74 rad/s, clockwise``."""
    rates = sheet.omega if act.rate == "omega" else sheet.alpha
    rate = rates[act.link]
    names = [act.link, *_alike(rates.values(), rate)]
    rule = f"${letters.vector(act.vector)}$ / ${letters.length(act.bar)}$"
    unit = "rad/s" if act.rate == "omega" else "rad/s²"
    way = "" if rate.value == 0.0 else f",  {term('clockwise' if rate.value < 0 else 'counter-clockwise', language)}"
    value = bound(rate_sum(sheet, act, units=False)) or f"{number(abs(rate.value), 5)} {unit}"
    return " =\u00a0".join((*(_rate_name(act.rate, n) for n in names), rule, value)) + way


def _seen(sheet: Sheet, act: RateSeen, letters: Letters, language: str) -> str:
    """``ω_42 = v_CC2 / l_BC = 0.65 rad/s, clockwise``, as a link is seen from a held one."""
    rule = f"${letters.vector(act.vector)}$ / ${letters.length(act.bar)}$"
    unit = "rad/s" if act.rate == "omega" else "rad/s²"
    way = "" if act.value == 0.0 else f",  {term('clockwise' if act.value < 0 else 'counter-clockwise', language)}"
    value = bound(rate_sum(sheet, act, units=False)) or f"{number(abs(act.value), 5)} {unit}"
    return " =\u00a0".join((_rate_name(act.rate, act.link + act.held), rule, value)) + way


def _held_still(act: HeldStill, language: str) -> str:
    """``ω_32 = 0.1437 rad/s, clockwise, drawn apart, with one link held still``."""
    unit, kind = ("rad/s", "omega") if act.gives == "omega" else ("rad/s²", "alpha")
    way = "" if act.value == 0.0 else f",  {term('clockwise' if act.value < 0 else 'counter-clockwise', language)}"
    name = _rate_name(kind, act.link + act.held)
    return f"{name} = {number(abs(act.value), 5)} {unit}{way},  {term('held still', language)}"


def by_rates(sheet: Sheet, step: Step, act: ByRate | SeenByRate, letters: Letters) -> Iterator[str]:
    """``v_CB = ω_3 l_CB = 1.4737 × 151.21 = 222.84 mm/s,  ⊥CB``: how an end point is laid off from another of its link
    whose rates are known."""
    for part in parts_by_rates(sheet, step.diagram, act):
        way = letters.direction(part.direction, sheet.scene.frame.name)
        rule = f"${letters.size(part.rule)}$ =\u00a0{bound(rule_sum(sheet, part.rule, step.diagram))}"
        yield f"${letters.vector(part.symbol)}$ =\u00a0{rule},  ${way}$"


def _off_plan(act: PlanDrawn, language: str) -> str:
    """``ω_3 = 30.00 mm × 0.25 (rad/s)/mm = 7.5 rad/s, clockwise``: read off the plan of a train."""
    if act.value == 0.0:
        return f"{_rate_name(act.rate, act.link)} = 0"
    way = term("clockwise" if act.value < 0 else "counter-clockwise", language)
    return f"{_rate_name(act.rate, act.link)} = {bound(plan_sum(act))},  {way}"


def _products(sheet: Sheet, equation: Equation, letters: Letters) -> list[str]:
    """``a^n_CB = 0.7396² × 383.14 = 209.58 mm/s²``: the sizes in an equation that follow from rates, in numbers, each
    once; that of an equation which is only a rule stands in it."""
    if rule_alone(sheet, equation):
        return []
    acts = [s.act for s in sheet.steps if s.equation == equation.number]
    laid_off = {a.symbol for a in acts if isinstance(a, Carried) or (isinstance(a, LaidOff) and not a.is_zero)}
    sums = {
        one.symbol: rule_sum(sheet, one.size, equation.diagram)
        for side in equation.sides
        for one in side
        if one.symbol in laid_off and "0" not in factors_of(sheet, one.size)
    }
    said = [f"${letters.vector(symbol)}$ =\u00a0{bound(text)}" for symbol, text in sums.items() if text]
    return [";  ".join(said)] if said else []


def _shared_with_drivers(sheet: Sheet, equation: Equation) -> Iterator[str]:
    """``ω_2 = ω_1``: links that slide on a driven one turn as it does."""
    kind = "omega" if equation.diagram == "velocity" else "alpha"
    rates = sheet.omega if kind == "omega" else sheet.alpha
    for rate in rates.values():
        if rate.vector is None and not rate.same_as and rate.value != 0.0:
            alike = _alike(rates.values(), rate)
            if alike:
                yield " = ".join(_rate_name(kind, name) for name in (*alike[::-1], rate.link))


def _alike(rates: Iterable[Rate], rate: Rate) -> list[str]:
    """Links that turn as another, blocks of pins left out."""
    return [
        other.link for other in rates if other.same_as == rate.link and other.value == rate.value
        and "/" not in other.link
    ]  # fmt: skip


def _rate_name(kind: str, link: str) -> str:
    return f"${'ω' if kind == 'omega' else 'α'}_{{{link}}}$"


def rule_alone(sheet: Sheet, equation: Equation) -> bool:
    """Whether an equation is nothing but the rule of one vector."""
    last = equation.sides[-1]
    known = len(last) == 1 and last[0].size_known and len(equation.sides) <= 2
    return known and last[0].symbol in sheet.vectors(equation.diagram)
