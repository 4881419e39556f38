"""What is written beside the forces of a group: why each step is taken, moment equations in numbers, how a polygon is
laid off with a ruler and closed, what was read off; and what a mechanism weighs and carries, as it is given.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from decimal import Decimal
from functools import reduce
from typing import NamedTuple

from graphkin.account.headings import number, written
from graphkin.account.notation import Letters, force_letters
from graphkin.construction.forces.force_sheet import (
    ForceGroup,
    ForceSheet,
    ForceState,
    ForceVector,
    Inertia,
    Lever,
    MomentEquation,
    MomentTerm,
    opposite,
)
from graphkin.construction.forces.joints import balance_of
from graphkin.construction.sheet import Sheet
from graphkin.plane import added_up
from graphkin.scene.model import LoadOn, Mechanism, Phase, SpringOn
from graphkin.scene.symbol import Symbol
from graphkin.words import Neutral, Phrase, Wording, about, listed
from graphkin.words.written import FINER, MOST, amount, is_quotient, on_paper, pointing, product, to_lay_off

__all__ = [
    "Balance", "ForceSentence", "balance", "closed_by", "corner_at", "corners", "couple_sentences", "given_loads",
    "group_caption", "inertia_line", "laid_lines", "laid_off", "lever_sum", "moment_sentences", "read_off",
    "spring_lines",
]  # fmt: skip

DIGITS = 5  # figures of a computed force, moment or arm
ZERO = 1e-8  # mm: a shorter force is nothing but rounding
SAME = 1e-6  # mm
APART = 0.3  # mm: corners that are nearer bear one letter


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
        links, symbol, part = _links(one.links), one.unknown.symbol, one.unknown.part
        if not one.terms and group.way == "polygon" and group.kind != "RPR":
            name = f"${force_letters(letters.convention, symbol)}$"
            args = links, name, f"${letters.point(one.about)}$"
            lines.append(ForceSentence(Phrase("force two-force member", args), (), symbol, part))
            continue
        name = f"${force_letters(letters.convention, symbol, part if _parted(sheet, group, one) else '')}$"
        key = "force reason driver" if group.way == "driver" else "force reason guide" if group.kind == "RPR" else (
            "force reason pin"
        )  # fmt: skip
        about = f"${letters.point(one.about)}$"
        said = Phrase(key, (about, links, name))
        work: tuple[Wording, ...] = (*arm_lines(sheet, one, letters, name), _equation(sheet, one, letters, name))
        lines.append(ForceSentence(said, work, symbol, part))
    return lines


def _links(names: Sequence[str]) -> object:
    """Links by name, blocks of pins left out where they are not alone."""
    return listed([name for name in names if "/" not in name] or names)


def _parted(sheet: Sheet, group: ForceGroup, one: MomentEquation) -> bool:
    """Whether what the moments give is a part of the force: both parts stand in the polygon, or this part is nought and
    the force lies along the bar."""
    parts = sum(v.symbol == one.unknown.symbol and v.part != "" for v in group.polygon)
    return parts > 1 or not balance(sheet, one).value


def couple_sentences(sheet: Sheet, group: ForceGroup, letters: Letters) -> list[ForceSentence]:
    """Couples of sliding pairs with the lines of their forces, and moments that balance."""
    lines = list[ForceSentence]()
    units = sheet.scene.units
    for one in group.couples:
        if not any(link in sheet.scene.by_name for link in one.links):  # a pin in a slot has no couple
            continue
        symbol = one.unknown.symbol
        name = f"${force_letters(letters.convention, symbol)}$"
        if symbol.other and not one.value:
            lines.append(ForceSentence(Phrase("force no couple", (Neutral(f"{name} = 0"),)), (), symbol))
            continue
        key = "force reason couple" if symbol.other else "force reason balance"
        work: list[Wording] = [*arm_lines(sheet, one, letters, name), _equation(sheet, one, letters, name)]
        for force, (_, shifted) in group.lines.items():
            if (force.link, force.other) == (symbol.link, symbol.other):
                shift = number(abs(shifted) / units.metres, DIGITS)
                name_of = f"${force_letters(letters.convention, force)}$"
                work.append(Phrase("force line shifted", (name_of, shift, units.length)))
        lines.append(ForceSentence(Phrase(key, (_links(one.links), name)), tuple(work), symbol))
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
    balance = lever.unknown.symbol
    name = f"${force_letters(letters.convention, balance)}$"
    moment = balance.kind == "M"
    total = added_up(row.moment for row in lever.rows) / units.newtons
    if moment:
        values = lever.value, float(state.moments.get(balance) or 0.0)
    else:
        values = abs(lever.value), abs(state.vectors.get(balance, 0j)) * sheet.scales.force
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
        back = opposite(vector.symbol)
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


# -- polygons ----------------------------------------------------------------------------------------------------------


def laid_off(group: ForceGroup) -> tuple[ForceVector, ...]:
    """The forces of a polygon that are known before it is closed, given or by moments, one behind the other."""
    turned = list(group.polygon)
    for _ in turned:  # from the first known one behind an unknown one
        if turned[0].by != "closing" and turned[-1].by == "closing":
            break
        turned.append(turned.pop(0))
    return tuple(v for v in turned if v.by != "closing" and abs(v.span) > ZERO)


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
        of = (m for m in group.moments if m.unknown.symbol == v.symbol and (m.unknown.part == v.part or not v.part))
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
    chain, unknown = laid_off(group), [v for v in group.polygon if v.by == "closing"]
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
    ways = [f"${way}$" for v in (behind, before) if (way := letters.direction(v.direction, frame))]
    if len(ways) < 2:
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
    def metres(term: MomentTerm) -> str:
        return "" if term.arm is None else amount(abs(term.arm) * sheet.scales.length, carried)

    terms = []
    for term in one.terms:
        # a force has its sense from its arm, a couple from itself
        size = amount(abs(term.size) / sheet.scene.units.newtons, of_forces)
        turn = term.size if term.arm is None else term.arm
        terms.append(("-" if turn < 0 else "+", tuple(filter(None, (size, metres(term))))))
    total = -sum((Decimal(f"{sign}1") * math.prod(map(Decimal, factors)) for sign, factors in terms), Decimal(0))
    arm = metres(one.unknown)
    return Balance(tuple(terms), arm, total / Decimal(arm) if arm else total)


def arm_lines(sheet: Sheet, one: MomentEquation, letters: Letters, name: str) -> list[Phrase]:
    """The arms of a moment equation as the ruler gives them on the mechanism; ``name`` is that of its unknown."""
    of = [(f"${force_letters(letters.convention, t.symbol)}$", t.arm) for t in one.terms]
    of.append((name, one.unknown.arm))
    arms = [f"{force} {written(on_paper(abs(arm)))} mm" for force, arm in of if arm is not None]
    scale = Neutral(f"× {amount(sheet.scales.length, 12)} m/mm")
    return [Phrase("force arms", arms=Neutral(",  ".join(arms)), scale=scale)] if arms else []


def _name(vector: ForceVector, letters: Letters) -> str:
    return f"${force_letters(letters.convention, vector.symbol, vector.part)}$"


# -- loads as they are given ------------------------------------------------------------------------------------------


def given_loads(sheet: Sheet, letters: Letters) -> list[Phrase]:
    """Masses, weights, inertias, loads, springs and what balances, a line for each kind."""
    scene, loading = sheet.scene, sheet.scene.loading
    masses = list(_masses(scene, letters))
    balances = dict.fromkeys(balance_of(sheet.structure, driver).symbol for driver in scene.drivers)
    return [
        *([reduce(lambda one, other: Phrase("given masses", (one, other)), masses)] if masses else []),
        *(_load(scene, load, letters) for load in loading.loads),
        *(_spring_given(scene, spring, letters) for spring in loading.springs),
        Phrase("given balance", (", ".join(f"${force_letters(letters.convention, one)}$" for one in balances),)),
    ]


def _masses(scene: Mechanism, letters: Letters) -> Iterator[Phrase]:
    units, loading = scene.units, scene.loading
    for mass in loading.masses:
        point = next((p for p, z in scene.by_name[mass.link].points.items() if z == mass.at), "")
        where = f"${letters.point(point)}$" if point else (
            f"({number(mass.at.real / units.metres)}, {number(mass.at.imag / units.metres)}) {units.length}"
        )  # fmt: skip
        said = f"$m_{{{mass.link}}}$ = {number(mass.mass / units.kilograms, 5)} {units.mass}"
        if loading.gravity:
            weight = mass.mass * abs(loading.gravity) / units.newtons
            name = force_letters(letters.convention, Symbol("G", link=mass.link))
            said += f", ${name}$ = {number(weight, 5)} {units.force}"
        if mass.inertia:
            square = "ft²" if units.mass == "lb" else "m²"
            said += f", $J_{{{mass.link}}}$ = {number(mass.inertia / units.inertias, 5)} {units.mass}·{square}"
        yield Phrase("given mass", (Neutral(said), where))


def _load(scene: Mechanism, load: LoadOn, letters: Letters) -> Phrase:
    units = scene.units
    name = f"${force_letters(letters.convention, Symbol('P', name=load.name, turning=not load.is_force))}$"
    size = Neutral(f"{name} = {number(load.size / units.newtons)} {units.force}" + ("" if load.is_force else "·m"))
    if not load.is_force:
        said = Phrase("given moment", (size, load.link))
    elif load.against:
        said = Phrase("given against", (size, load.link, load.against))
    else:
        angle = number(math.degrees(math.atan2(load.turn.imag, load.turn.real)), 5)
        key = "given following" if load.follows else "given force"
        said = Phrase(key, (size, load.link, angle, load.follows))
    return said if load.phase is None else Phrase("given while", (said, _phase(scene, load.phase)))


def _phase(scene: Mechanism, phase: Phase) -> Phrase:
    if phase.stroke:
        key = "given on stroke" if phase.sense > 0 else "given on stroke back"
        return Phrase(key, (phase.stroke, number(phase.start), number(phase.end)))
    driver = scene.drivers[0]
    if driver.turns:
        ends = (number(math.degrees(phase.start)) + "°", number(math.degrees(phase.end)) + "°")
    else:
        metres, unit = scene.units.metres, scene.units.length
        ends = (number(phase.start / metres), f"{number(phase.end / metres)} {unit}")
    return Phrase("given while driver", ends)


def _spring_given(scene: Mechanism, spring: SpringOn, letters: Letters) -> Phrase:
    """What is given of a spring, in words with symbols."""
    units = scene.units
    one, two = (f"${letters.point(point)}$" for point in spring.points)
    rate = Neutral(f"{number(spring.rate * units.metres / units.newtons)} {units.force}/{units.length}")
    free = Neutral(f"{number(spring.free / units.metres)} {units.length}")
    preload = Neutral(f"{number(spring.preload / units.newtons)} {units.force}")
    name = f"${force_letters(letters.convention, Symbol('P', name=spring.name))}$"
    told = (spring.name, one, spring.links[0], two, spring.links[1], rate, free, preload, name)
    return Phrase("given spring", told)


def _pull(start: str, rate: str, length: str, free: str) -> float:
    """What the numbers come to as they are written, to as many figures as computed numbers have."""
    return float(amount(float(start) + float(rate) * (float(length) - float(free)), MOST))


def spring_lines(sheet: Sheet, forces: ForceSheet, letters: Letters) -> Iterator[Phrase]:
    """The force of each spring from its length as it was measured."""
    units = sheet.scene.units
    for spring in sheet.scene.loading.springs:
        name = Symbol("P", name=spring.name)
        own, other = (one for one in forces.states[0].known if one.symbol == name)
        length = abs(other.at - own.at) * sheet.scales.length
        force = spring.preload + spring.rate * (length - spring.free)
        start, rate = amount(spring.preload / units.newtons), amount(spring.rate * units.metres / units.newtons)
        free, pull = amount(spring.free / units.metres), amount(force / units.newtons, MOST)
        tried = [amount(length / units.metres, carried) for carried in FINER]
        told_length = next((one for one in tried if _pull(start, rate, one, free) == float(pull)), tried[0])
        preload = f"{written(start)} + " if spring.preload else ""
        stretch, rate = f"({written(told_length)} − {written(free)})", written(rate)
        size = f"{written(pull)} {units.force}"
        markup = force_letters(letters.convention, name)
        ends = "".join(letters.point(p) for p in spring.points)
        total = Neutral(f"${markup}$ = {preload}{rate} × {stretch} = {size}")
        key = "force spring" if force >= 0 else "force spring pushes"
        yield Phrase(key, ends=ends, sum=total, link=spring.links[0])
