"""What is written beside the forces of a group: why each step is taken, moment equations in numbers, the vector
equation, and what was read off."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from graphkin.account.force_chain import DIGITS, arm_lines, balance
from graphkin.account.headings import number, written
from graphkin.account.notation import Letters, force_letters
from graphkin.construction.forces.force_sheet import (
    ForceGroup,
    ForceSheet,
    ForceState,
    Inertia,
    Lever,
    MomentEquation,
)
from graphkin.construction.sheet import Sheet
from graphkin.plane import added_up
from graphkin.scene.symbol import Symbol
from graphkin.words import Neutral, Phrase, Wording, about, listed
from graphkin.words.written import amount, on_paper, product

__all__ = [
    "ForceSentence", "couple_sentences", "group_caption", "inertia_line", "lever_sum", "moment_sentences",
    "read_off",
]  # fmt: skip

ZERO = 1e-8  # mm: a shorter force is nothing but rounding


def group_caption(group: ForceGroup, count: int) -> Phrase:
    """``1. Links 5, 6 (RRP) cut free``."""
    kind = {"driver": Phrase("force driver"), "drawn system": Phrase("force larger group")}.get(group.way, group.kind)
    return Phrase(about("force group", group.links), (str(count), listed(group.links), kind))


def inertia_line(sheet: Sheet, one: Inertia, letters: Letters) -> str:
    """``F_I4 = -m_4 a_S4 = 22.4 kg x 2.11 m/s2 = 47.4 N; M_I4 = ...; h_4 = ...``."""
    units, c = sheet.scene.units, letters.convention
    mass, push = amount(one.mass / units.kilograms, DIGITS), amount(abs(one.push), DIGITS)
    size = product(mass, push, amount(units.kilograms / units.newtons, 12), carried=DIGITS)
    mass_of = next(m for m in sheet.scene.loading.masses if m.link == one.link)
    point = next((p for p, z in sheet.scene.by_name[one.link].points.items() if z == mass_of.at), f"S{one.link}")
    letter = "A" if c == "us" else "a"
    said = f"${force_letters(c, Symbol('Fi', link=one.link))}$ = $m_{{{one.link}}}$ ${letter}_{{{point}}}$ = "
    said += f"{written(mass)} {units.mass} × {written(push)} m/s² = {written(size)} {units.force}"
    if one.inertia:
        turned = f"{number(one.moment / units.newtons, DIGITS)} {units.force}·m"
        name = force_letters(c, Symbol("Mi", link=one.link))
        said += f";  ${name}$ = −$J_{{{one.link}}}$ $α_{{{one.link}}}$ = {turned}"
        if one.h is not None:
            shift = number(abs(one.h) / units.metres, DIGITS)
            said += f";  $h_{{{one.link}}}$ = {shift} {units.length}"
    return said


class ForceSentence(NamedTuple):
    """A step in words with symbols: why it is taken, what is computed, and what it finds (``part`` of it)."""

    reason: Phrase
    work: tuple[Wording, ...] = ()
    symbol: Symbol | None = None
    part: str = ""

    @property
    def lines(self) -> tuple[Wording, ...]:
        return self.reason, *self.work


def moment_sentences(sheet: Sheet, group: ForceGroup, letters: Letters) -> list[ForceSentence]:
    """The moment equations that give parts of forces, each with its reason."""
    lines = list[ForceSentence]()
    held = next((v for v in group.polygon if v.part == "n"), None) if group.kind in ("RPP", "RPR") else None
    if held is not None:
        name = f"${force_letters(letters.convention, held.symbol, 'n')}$"
        said = Phrase("force reason along", (held.link.split("/")[0], name))
        lines.append(ForceSentence(said, (), held.symbol, "n"))
    for one in group.moments:
        links = _links(one.links)
        if not one.terms and group.way == "polygon" and group.kind != "RPR":
            name = f"${force_letters(letters.convention, one.symbol)}$"
            args = links, name, f"${letters.point(one.about)}$"
            lines.append(ForceSentence(Phrase("force two-force member", args), (), one.symbol, one.part))
            continue
        name = f"${force_letters(letters.convention, one.symbol, one.part if _parted(sheet, group, one) else '')}$"
        key = "force reason driver" if group.way == "driver" else "force reason guide" if group.kind == "RPR" else (
            "force reason pin"
        )  # fmt: skip
        about = f"${letters.point(one.about)}$"
        said = Phrase(key, (about, links, name))
        work: tuple[Wording, ...] = (*arm_lines(sheet, one, letters, name), _equation(sheet, one, letters, name))
        lines.append(ForceSentence(said, work, one.symbol, one.part))
    return lines


def _links(names: Sequence[str]) -> object:
    """Links by name, blocks of pins left out where they are not alone."""
    return listed([name for name in names if "/" not in name] or names)


def _parted(sheet: Sheet, group: ForceGroup, one: MomentEquation) -> bool:
    """Whether what the moments give is a part of the force: both parts stand in the polygon, or this part is nought and
    the force lies along the bar."""
    return sum(v.symbol == one.symbol and v.part != "" for v in group.polygon) > 1 or not balance(sheet, one).value


def couple_sentences(sheet: Sheet, group: ForceGroup, letters: Letters) -> list[ForceSentence]:
    """Couples of sliding pairs with the lines of their forces, and moments that balance."""
    lines = list[ForceSentence]()
    units = sheet.scene.units
    for one in group.couples:
        if not any(link in sheet.scene.by_name for link in one.links):  # a pin in a slot has no couple
            continue
        name = f"${force_letters(letters.convention, one.symbol)}$"
        if one.symbol.other and not one.value:
            lines.append(ForceSentence(Phrase("force no couple", (Neutral(f"{name} = 0"),)), (), one.symbol))
            continue
        key = "force reason couple" if one.symbol.other else "force reason balance"
        work: list[Wording] = [*arm_lines(sheet, one, letters, name), _equation(sheet, one, letters, name)]
        for line in group.lines:
            if line.symbol.link == one.symbol.link and line.symbol.other == one.symbol.other:
                force = f"${force_letters(letters.convention, line.symbol)}$"
                shift = number(abs(line.shifted) / units.metres, DIGITS)
                work.append(Phrase("force line shifted", (force, shift, units.length)))
        lines.append(ForceSentence(Phrase(key, (_links(one.links), name)), tuple(work), one.symbol))
    return lines


def _equation(sheet: Sheet, one: MomentEquation, letters: Letters, name: str) -> str:
    """``ΣM_C = 0: F_G5 x 0.0488 m ... = 0, F^t_R45 = -10.7 N``."""
    units = sheet.scene.units
    scene = sheet.scene
    about = f"({one.about})" if one.about in scene.by_name and one.about not in scene.holders else one.about
    terms, arm, total = balance(sheet, one)
    whole = " ".join(f"{'−' if sign == '-' else '+'} {'·'.join(map(written, factors))}" for sign, factors in terms)
    unit = f"{units.force}·m"
    if not arm:
        whole += f" + {name}"
    else:
        # its sense is that in which it comes out positive
        whole += f" {'−' if total < 0 else '+'} {name}·{written(arm)}"
        total = abs(total)
        unit = units.force
    value = number(float(total), DIGITS) if total else "0"
    shown = whole.strip().removeprefix("+ ")
    return f"$ΣM_{{{about}}}$ = {shown} = 0;  {name} = {value} {unit}"


def lever_sum(sheet: Sheet, state: ForceState, lever: Lever, letters: Letters) -> tuple[Phrase, Phrase]:
    """The sum of the moments on a lever in numbers, and what balances by it beside the value of the polygons."""
    units = sheet.scene.units
    name = f"${force_letters(letters.convention, lever.balance)}$"
    moment = lever.balance.kind == "M"
    total = added_up(row.moment for row in lever.rows) / units.newtons
    if moment:
        values = lever.value, float(state.moments.get(lever.balance) or 0.0)
    else:
        values = abs(lever.value), abs(state.vectors.get(lever.balance, 0j)) * sheet.scales.force
    lead = f"{'−' if lever.unknown.moment < 0 else ''}{name}·{number(abs(lever.unknown.moment), DIGITS)}"
    rest = f"{'+' if total >= 0 else '−'} {number(abs(total), DIGITS)}"
    unit = f"{units.force}·m" if moment else units.force
    by_lever, by_polygons = (f"{number(v / units.newtons, DIGITS)} {unit}" for v in values)
    return (
        Phrase("lever sum", (Neutral(f"{lead} {rest} = 0"),)),
        Phrase("lever balance", (Neutral(f"{name} = {by_lever}"), Neutral(by_polygons))),
    )


def read_off(
    sheet: Sheet, forces: ForceSheet, state: ForceState, group: ForceGroup, letters: Letters
) -> dict[Symbol, str]:
    """``F_R45 = 43.33 mm x 200 N/mm = 8666.4 N``, for each force that was found here."""
    units = sheet.scene.units
    per = amount(forces.per_mm / units.newtons, 12)
    found = dict[Symbol, str]()
    seen: set[Symbol] = set()
    vectors = [*group.polygon, *(v for polygon in group.inner.values() for v in polygon)]
    for vector in vectors:
        back = Symbol(vector.symbol.kind, vector.symbol.of, link=vector.symbol.other, other=vector.symbol.link)
        if vector.known or vector.symbol in seen or (vector.symbol.other and back in seen):
            continue
        seen.add(vector.symbol)
        span = state.vectors.get(vector.symbol, state.vectors.get(back))
        if span is None:
            span = vector.span
        size = abs(span)
        name = f"${force_letters(letters.convention, vector.symbol)}$"
        if size < ZERO:
            found[vector.symbol] = f"{name} = 0"
            continue
        value = written(product(on_paper(size), per))
        sum_ = f"{written(on_paper(size))} mm × {written(per)} {units.force}/mm"
        found[vector.symbol] = f"{name} = {sum_} = {value} {units.force}"
    return found
