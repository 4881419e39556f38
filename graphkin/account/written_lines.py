"""What is written to repeat a construction, in its order: lengths measured, equations with products, angular rates."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.account.arithmetic import bound, factors_of, rule_sum
from graphkin.account.measured_lengths import lengths_measured
from graphkin.account.notation import Letters
from graphkin.account.tell import Account
from graphkin.account.tell.polygon import alike, rate_name
from graphkin.construction.mechanism_acts import PitchPoint, SpecialPoint
from graphkin.construction.polygon_acts import Carried, LaidOff
from graphkin.construction.sheet import Equation, Sheet

__all__ = ["WrittenLine", "rule_alone", "written_lines"]

WrittenLine = Equation | str
"""A vector equation, or a rule on one line as words with symbols."""


def written_lines(sheet: Sheet, letters: Letters, language: str) -> list[WrittenLine]:
    """Everything that is written to repeat a construction, in its order: what is measured on the mechanism, each vector
    equation with its products in numbers, the angular rates where they are known, and what each step tells."""
    account = Account(sheet, letters)
    lines: list[WrittenLine] = []
    written: set[int] = set()
    lengths = [*lengths_measured(sheet, letters)]
    to_come = {s.act.point for s in sheet.steps if isinstance(s.act, SpecialPoint | PitchPoint)}
    shared = False  # whether the next step may go on in the line of the one before
    for step in sheet.steps:
        told = account.told(step)
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
            lines += told.above_equation(language)
            lines.append(equation)
            lines += _products(sheet, equation, letters)
        for line in told.lines(language):
            before = lines[-1] if lines else None
            if shared and told.shares_line and isinstance(before, str):
                lines[-1] = f"{before};  {line}"
            else:
                lines.append(line)
        shared = told.shares_line
    return lines


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
            others = alike(rates.values(), rate)
            if others:
                yield " = ".join(rate_name(kind, name) for name in (*others[::-1], rate.link))


def rule_alone(sheet: Sheet, equation: Equation) -> bool:
    """Whether an equation is nothing but the rule of one vector."""
    last = equation.sides[-1]
    known = len(last) == 1 and last[0].size_known and len(equation.sides) <= 2
    return known and last[0].symbol in sheet.vectors(equation.diagram)
