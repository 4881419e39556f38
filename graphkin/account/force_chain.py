"""How a force polygon is laid off with a ruler: the known forces one behind the other, each with its length and
direction, and the lines that close it."""

from __future__ import annotations

import math
from decimal import Decimal
from typing import NamedTuple

from graphkin.account.headings import written
from graphkin.account.notation import Letters, force_letters
from graphkin.construction.forces.force_sheet import (
    Arm,
    ForceGroup,
    ForceSheet,
    ForceVector,
    MomentEquation,
)
from graphkin.construction.sheet import Sheet
from graphkin.construction.sizes import Term
from graphkin.words import Neutral, Phrase
from graphkin.words.written import FINER, amount, is_quotient, on_paper, pointing, to_lay_off

__all__ = ["DIGITS", "Balance", "arm_lines", "balance", "closed_by", "corners", "laid_lines", "laid_off"]

DIGITS = 5  # figures of a computed force, moment or arm
ZERO = 1e-8  # mm
SAME = 1e-6  # mm
APART = 0.3  # mm: corners that are nearer bear one letter


def laid_off(group: ForceGroup) -> tuple[ForceVector, ...]:
    """The forces of a polygon that are known before it is closed, given or by moments, one behind the other."""
    turned = list(group.polygon)
    for _ in turned:  # from the first known one behind an unknown one
        if _known(group, turned[0]) and not _known(group, turned[-1]):
            break
        turned.append(turned.pop(0))
    return tuple(v for v in turned if _known(group, v) and abs(v.span) > ZERO)


def corners(group: ForceGroup) -> tuple[tuple[str, complex, ForceVector], ...]:
    """The corners of a polygon as they are drawn, lettered a, b, c …: each with its place (mm) and the force that ends
    there, the first with the force that begins there; places that fall together bear one letter."""
    chain = laid_off(group)
    turned = list(group.polygon)
    while chain and turned[0] is not chain[0]:
        turned.append(turned.pop(0))
    if not turned:
        return ()
    found = [("a", turned[0].tail, turned[0])]
    for vector in turned:
        if all(abs(vector.tip - place) > APART for _, place, _ in found):
            found.append((chr(ord("a") + len(found)), vector.tip, vector))
    return tuple(found)


def corner_at(group: ForceGroup, place: complex) -> str:
    """The letter of a corner as markup."""
    letter, _, _ = min(corners(group), key=lambda corner: abs(corner[1] - place))
    return f"${letter}$"


def laid_lines(sheet: Sheet, forces: ForceSheet, group: ForceGroup, letters: Letters) -> list[str]:
    """``ab = P = 9000 N ÷ 100 N/mm = 90.00 mm, 180.0°`` for each of them."""
    units, lines = sheet.scene.units, []
    per = forces.per_mm / units.newtons
    scale = written(amount(per, 12))
    for v in laid_off(group):
        value, length = to_lay_off(abs(v.span) * per, per, abs(v.span))
        of = (m for m in group.moments if m.symbol == v.symbol and (m.part == v.part or not v.part))
        by_moments = next((m for m in of if abs(abs(m.value) / forces.per_mm - abs(v.span)) < SAME), None)
        if by_moments is not None:
            # as their sum gave it
            value = amount(float(abs(balance(sheet, by_moments).value)), DIGITS)
            length = length if is_quotient(length, value, amount(per, 12)) else on_paper(float(value) / per)
        lines.append(
            f"{_ends(group, v)}{_name(v, letters)} = {written(value)} {units.force} ÷ {scale} {units.force}/mm = "
            f"{written(length)} mm,  {pointing(v.span)}°"
        )
    return lines


def closed_by(group: ForceGroup, letters: Letters, frame: str) -> Phrase | None:
    """Through which ends of the chain the lines of the unknown forces go; None where that is not so."""
    chain, unknown = laid_off(group), [v for v in group.polygon if not _known(group, v)]
    if not chain or not unknown or len(unknown) > 2:
        return None
    first, last = chain[0], chain[-1]
    if len(unknown) == 1:
        (one,) = unknown
        joined = [_name(v, letters) for v in (last, first, one)]
        lettered = [corner_at(group, place) for place in (last.tip, first.tail)]
        return Phrase("force closes", (*joined, *lettered))
    behind = next((v for v in unknown if abs(v.tail - last.tip) < SAME), None)
    before = next((v for v in unknown if abs(v.tip - first.tail) < SAME and v is not behind), None)
    if behind is None or before is None:
        return None
    ways = [_way(group, v, letters, frame) for v in (behind, before)]
    if not all(ways):
        return None
    ends = (_name(last, letters), ways[0], _name(behind, letters))
    corner = [corner_at(group, place) for place in (last.tip, first.tail, behind.tip)]
    names = (*ends, _name(first, letters), ways[1], _name(before, letters))
    return Phrase("force lines meet", (*names, *corner))


def _ends(group: ForceGroup, vector: ForceVector) -> str:
    """``ab = ``: the corners between which a force stands; "" where they bear one letter."""
    one, two = (corner_at(group, place).strip("$") for place in (vector.tail, vector.tip))
    return f"${one}{two}$ = " if one != two else ""


class Balance(NamedTuple):
    """A moment equation in numbers: its terms, each a sign and factors, force and arm (m) or a couple; the arm of the
    unknown ("" where it is a couple), and what the others give for it (in the file's force, or that times m)."""

    terms: tuple[tuple[str, tuple[str, ...]], ...]
    arm: str
    value: Decimal


def balance(sheet: Sheet, one: MomentEquation) -> Balance:
    """The equation with as many figures of its arms, at last of its forces, as it wants to give what is drawn; what it
    gives is true as it is written."""
    drawn = amount(abs(one.value) / sheet.scene.units.newtons, DIGITS)
    tried = [_balance(sheet, one, carried, of_forces) for of_forces in FINER for carried in FINER]
    return next((b for b in tried if amount(float(abs(b.value)), DIGITS) == drawn), tried[0])


def _balance(sheet: Sheet, one: MomentEquation, carried: int, of_forces: int) -> Balance:
    def metres(arm: Arm | None) -> str:
        return "" if arm is None else amount(abs(arm.mm) * sheet.scales.length, carried)

    terms = []
    for term in one.terms:
        # a force has its sense from its arm, a couple from itself
        size = amount(abs(term.size) / sheet.scene.units.newtons, of_forces)
        turn = term.arm.mm if term.arm else term.size
        terms.append(("-" if turn < 0 else "+", (size, metres(term.arm)) if term.arm else (size,)))
    total = -sum((Decimal(f"{sign}1") * math.prod(map(Decimal, factors)) for sign, factors in terms), Decimal(0))
    arm = metres(one.arm)
    return Balance(tuple(terms), arm, total / Decimal(arm) if arm else total)


def arm_lines(sheet: Sheet, one: MomentEquation, letters: Letters, name: str) -> list[Phrase]:
    """The arms of a moment equation as the ruler gives them on the mechanism; ``name`` is that of its unknown."""
    of = [(f"${force_letters(letters.convention, t.symbol, t.part)}$", t.arm) for t in one.terms]
    arms = [f"{force} {written(on_paper(abs(arm.mm)))} mm" for force, arm in (*of, (name, one.arm)) if arm is not None]
    scale = Neutral(f"× {amount(sheet.scales.length, 12)} m/mm")
    return [Phrase("force arms", arms=Neutral(",  ".join(arms)), scale=scale)] if arms else []


def _known(group: ForceGroup, vector: ForceVector) -> bool:
    term = _term(group, vector)
    return vector.known or (term is not None and term.size_known and term.direction_known)


def _term(group: ForceGroup, vector: ForceVector) -> Term | None:
    return next((t for t in group.equation if (t.symbol, t.part) == (vector.symbol, vector.part)), None)


def _way(group: ForceGroup, vector: ForceVector, letters: Letters, frame: str) -> str:
    term = _term(group, vector)
    way = letters.direction(term.direction, frame) if term is not None else ""
    return f"${way}$" if way else ""


def _name(vector: ForceVector, letters: Letters) -> str:
    return f"${force_letters(letters.convention, vector.symbol, vector.part)}$"
