"""The account of the forces of a position: step by step with reasons, moment equations in numbers, the laying off and
closing of polygons, the readings.

Inertia forces come first, from the drawn accelerations, and springs; then group by group the links cut free, moments,
polygon, forces inside, couples; at last the lever.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from typing import ClassVar, Literal, TypeAlias

from graphkin.account.headings import number
from graphkin.account.notation import force_letters, pole, scale_statement
from graphkin.account.voice import Account, Telling
from graphkin.construction.board.scales import extent_of, fitting_scale, least_scale
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import Reason
from graphkin.construction.forces.steps import (
    BY_MOMENTS,
    CLOSED,
    NO_GROUP,
    ZERO,
    ForceGroup,
    ForceState,
    ForceStep,
    ForceVector,
    Lever,
    MomentStep,
    MomentTerm,
)
from graphkin.scene.model import SpringOn
from graphkin.scene.symbol import Symbol
from graphkin.words import Neutral, Phrase, Wording, bodies_named, gaps_of, in_all, joined, listed, rich_text
from graphkin.words.symbols import RichText, rate, sign, spaced
from graphkin.words.written import (
    FINER,
    MOST,
    amount,
    is_quotient,
    on_paper,
    pointing,
    printed,
    product,
    quotient,
    to_lay_off,
)

SAME = 1e-6  # mm
SHORT = 0.3  # mm: a nearer end point of a lever is at its pole
LEVER_ROOM = 134.0, 130.0  # mm, width and height of a lever


@dataclass(frozen=True, eq=False, repr=False)
class InForces(Telling):
    """A step of the forces: of loads from outside, of a group, or of a lever."""

    step: ForceStep
    group: ForceGroup = NO_GROUP
    lever: Lever | None = None

    def sentence(self, language: str) -> RichText:
        """Its sentence in a language."""
        return rich_text(self.said, language)

    @property
    def said(self) -> Phrase:
        """Its sentence, and what follows it."""
        said = Phrase(self.step.sentence, **{name: self.gap(name) for name in gaps_of(self.step.sentence)})
        more = Phrase("lever virtual") if self.step.reason == "lever" and self.lever and self.lever.virtual else None
        more = self._closed_by() if self.step.reason in CLOSED else more
        return said if more is None else Phrase("two sentences", first=said, second=more)

    def gap(self, name: str) -> object:
        """The value of a gap in its sentence."""
        step, reason, letters = self.step, self.step.reason, self.account.letters
        match name:
            case "links":
                return listed(step.links) if reason == "system" else bodies_named(step.links)
            case "forces":
                return listed([*map(self.name, step.finds or dict.fromkeys(load.symbol for load in step.acting))])
            case "force":
                return self.name(step.symbol, step.part)
            case "moment":
                moment = self.name(step.symbol)
                return Neutral(moment, " = 0") if reason == "no couple" else moment
            case "point" if isinstance(step, MomentStep):
                return letters.point(step.about)
            case "pole":
                return pole(letters.convention, "velocity")
            case "ends":
                return letters.bar(self.spring.points)
            case "length":
                points = self.spring.points
                return sign("l", letters.bar(points), meaning=("length", " ".join(points)))
            case "sum":
                return self._spring_sum() if reason == "spring" else self._lever_sum()
        return super().gap(name)

    def name(self, symbol: Symbol, part: str = "") -> RichText:
        """A force or a moment as a symbol, or a part of it."""
        return force_letters(self.account.letters.convention, symbol, part)

    @property
    def spring(self) -> SpringOn:
        """The spring that it measures."""
        name = self.step.acting[0].symbol.name
        return next(spring for spring in self.sheet.scene.loading.springs if spring.name == name)

    def _spring_sum(self) -> Neutral:
        units, spring, length = self.sheet.scene.units, self.spring, self.step.length
        start, rate = amount(spring.preload / units.newtons), amount(spring.rate * units.metres / units.newtons)
        free, pull = amount(spring.free / units.metres), amount(spring.pull(length) / units.newtons, MOST)

        def as_written(measured: str) -> str:
            return amount(float(start) + float(rate) * (float(measured) - float(free)), MOST)

        tried = [amount(length / units.metres, carried) for carried in FINER]
        measured = next((text for text in tried if float(as_written(text)) == float(pull)), tried[0])
        preload = f"{printed(start)} + " if spring.preload else ""
        stretch = f"{printed(rate)} × ({printed(measured)} − {printed(free)})"
        name = self.name(self.step.acting[0].symbol)
        return Neutral(name, f" = {preload}{stretch} = {printed(pull)} {units.force}")

    # sums

    def work_in(self, language: str) -> tuple[RichText, ...]:
        """Its sums, in the languages of a paper."""
        return tuple(line for wording in self.sums for line in in_all(wording, language))

    @property
    def sums(self) -> Sequence[Wording]:
        """Its sums."""
        sums = self.sums_of.get(self.step.reason)
        return [*sums(self)] if sums else []

    def _inertia(self) -> Iterator[RichText]:
        """``F_I4 = -m_4 a_S4 = 22.4 kg x 2.11 m/s2 = 47.4 N; M_I4 = ...; h_4 = ...``."""
        units, link = self.sheet.scene.units, self.step.link
        pushed = self.sheet.inertias[link]
        mass, push = amount(pushed.mass.mass / units.kilograms, MOST), amount(abs(pushed.push), MOST)
        per, divisor = amount(units.newtons / units.kilograms, 12), ""  # of the units of force and mass
        if per != "1":
            divisor = f" ÷ {printed(per)} ({units.mass}·m/s²)/{units.force}"
        size = quotient(product(mass, push), per, carried=MOST)
        point = next((p for p, z in self.sheet.scene.by_name[link].points.items() if z == pushed.mass.at), f"S{link}")
        letter = "A" if self.account.letters.convention == "us" else "a"
        force, moment = (self.name(Symbol(kind, link=link)) for kind in ("Fi", "Mi"))
        in_numbers = f"{printed(mass)} {units.mass} × {printed(push)} m/s²{divisor} = {printed(size)} {units.force}"
        said = [force + " = " + sign("m", link) + " " + sign(letter, point, meaning=("a", point)) + " = " + in_numbers]
        if pushed.mass.inertia:
            turned = f"{number(pushed.moment / units.newtons, MOST)} {units.force}·m"
            said.append(moment + " = −" + sign("J", link) + " " + rate("alpha", link) + f" = {turned}")
        if pushed.mass.inertia and pushed.h is not None:
            said.append(sign("h", link) + f" = {number(pushed.h / units.metres, MOST)} {units.length}")
        yield spaced(";  ", said)

    def _moments(self) -> Iterator[Wording]:
        """The arms of moments as measured on the mechanism, the forces without one, and the equation as ``ΣM_C = F_G5 x
        0.0488 m ... = 0, F^t_R45 = -10.7 N``; the shifted line of the force of a sliding pair."""
        equation, scene, units = self.step, self.sheet.scene, self.sheet.scene.units
        assert isinstance(equation, MomentStep)
        name = self.name(equation.symbol, equation.part)
        of = [*((self.name(t.symbol), t.arm) for t in with_moments(equation)), (name, equation.unknown.arm)]
        arms = [force + f" {printed(on_paper(abs(arm)))} mm" for force, arm in of if arm is not None]
        if arms:
            scale = Neutral(f"× {amount(self.sheet.scales.length, 12)} m/mm")
            yield Phrase("force arms", arms=joined("beside each other", map(Neutral, arms)), scale=scale)
        through = [self.name(t.symbol) for t in equation.terms if t not in with_moments(equation)]
        if through:
            yield Phrase("force no arm", forces=joined("beside each other", map(Neutral, through)))
        point = equation.about
        point = f"({point})" if point in scene.by_name and point not in scene.holders else point
        terms, arm, total = balance(self.sheet, equation)
        sums = " ".join(f"{'−' if turn == '-' else '+'} {'·'.join(map(printed, factors))}" for turn, factors in terms)
        # the sense of a force is that in which it comes out positive; of a moment what acts may be the opposite
        turned = not arm and equation.unknown.acting.turned
        sums += f" {'−' if turned or (arm and total < 0) else '+'} "
        whole = sums.lstrip().removeprefix("+ ") + name + (f"·{printed(arm)}" if arm else "")
        value = number(float(abs(total) if arm else -total if turned else total), MOST) if total else "0"
        unit = units.force + ("" if arm else "·m")
        yield sign("ΣM", point) + " = " + whole + " = 0;  " + name + f" = {value} {unit}"
        if equation.shift:
            force, distance = self.name(equation.shifted), number(abs(equation.shift) / units.metres, MOST)
            yield Phrase("force line shifted", force=force, distance=distance, unit=units.length)

    # polygons

    def _laid(self) -> Iterator[RichText]:
        """``ab = P = 9000 N ÷ 100 N/mm = 90.00 mm, 180.0°`` for each known force of a polygon."""
        units, by_moments = self.sheet.scene.units, {s.symbol: s for s in self.group.moments(*BY_MOMENTS)}
        scale, per = force_scale(self.sheet, self.group), self.group.per_mm / units.newtons
        for v in self.step.forces:
            value, length = to_lay_off(abs(v.span) * per, per, abs(v.span))
            equation = by_moments.get(v.symbol) if v.by == "moments" and v.part != "n" else None
            if equation is not None:  # as their sum gave it
                value = amount(float(abs(balance(self.sheet, equation)[2])), MOST)
                length = length if is_quotient(length, value, scale) else on_paper(float(value) / per)
            begin, end = v.ends
            ends = sign(begin + end) + " = " if begin != end else ""  # "" where they bear one letter
            sum_ = f"{printed(value)} {units.force} ÷ {printed(scale)} {units.force}/mm = {printed(length)} mm"
            yield ends + self.name(v.symbol, v.part) + f" = {sum_},  {pointing(v.span)}°"

    def _closed_by(self) -> Phrase | None:
        """The ends of the chain through which the lines of the unknown forces go; None where there is no chain, or no
        line."""
        known = [vector for step in self.group.by("known forces") for vector in step.forces]
        if not known:
            return None

        def name(vector: ForceVector) -> RichText:
            return self.name(vector.symbol, vector.part)

        first, last = known[0], known[-1]
        chained = {"first": name(first), "last": name(last), "begin": sign(first.ends[0]), "end": sign(last.ends[1])}
        behind, *others = self.step.forces
        if not others:
            return Phrase("force closes", force=name(behind), **chained)
        frame, (before,) = self.sheet.scene.frame.name, others
        line, other_line = (self.account.letters.direction(v.direction, frame) for v in (behind, before))
        if abs(behind.span) < SAME or not line or not other_line:
            return None
        return Phrase(
            "force lines meet", line=line, force=name(behind), other_line=other_line, other_force=name(before),
            corner=sign(behind.ends[1]), **chained,
        )

    # the lever

    def _lever_sum(self) -> Neutral:
        """The sum of the moments on a lever in numbers."""
        lever = self.lever
        assert lever is not None
        _, total, arm = lever_sum(self.sheet, lever)
        lead = "−" * (lever.unknown.moment < 0) + self.name(self.step.symbol) + f"·{printed(arm)}"
        return Neutral(lead, f" {'+' if total >= 0 else '−'} {printed(amount(float(abs(total)), 12))} = 0")

    def _balanced(self) -> Iterator[Phrase]:
        """The balancing load by the lever, beside that of the polygons."""
        lever = self.lever
        assert lever is not None
        units, moment = self.sheet.scene.units, self.step.symbol.kind == "M"
        values = lever.value if moment else abs(lever.value), lever.by_polygons
        unit = units.force + ("·m" if moment else "")
        by_lever, by_polygons = (f"{number(v / units.newtons, MOST)} {unit}" for v in values)
        balance = Neutral(self.name(self.step.symbol), f" = {by_lever}")
        yield Phrase("lever balance", lever=balance, polygons=Neutral(by_polygons))

    sums_of: ClassVar[Mapping[Reason, Callable[[InForces], Iterable[Wording]]]] = {
        "inertia": _inertia, "known forces": _laid, "all moments": _balanced,
        **dict.fromkeys(("about pin", "about guide", "about driver", "couple", "balance"), _moments),
        **dict.fromkeys((*CLOSED, "inside"), lambda told: read_off(told.account, told.group, told.step.finds)),
    }


def read_off(account: Account, group: ForceGroup, forces: Iterable[Symbol]) -> list[RichText]:
    """``F_R45 = 43.33 mm x 200 N/mm = 8666.4 N`` for forces that were read off the polygons of a group."""
    unit, per_mm = account.sheet.scene.units.force, force_scale(account.sheet, group)
    lines = list[RichText]()
    for symbol in forces:
        size = on_paper(mm := group.read[symbol])
        sum_ = f"{printed(size)} mm × {printed(per_mm)} {unit}/mm = {printed(product(size, per_mm))} {unit}"
        lines.append(account.letters.vector(symbol) + f" = {'0' if mm < ZERO else sum_}")
    return lines


def force_scale(sheet: Sheet, group: ForceGroup) -> str:
    """The scale of a group's polygons, as it is written in the file's unit of force."""
    return amount(group.per_mm / sheet.scene.units.newtons, 12)


# stages


@dataclass(frozen=True, eq=False, repr=False)
class ForceStage:
    """The steps of a group, of loads from outside, or of a lever, in words.

    ``figure`` is their figure; ``again`` marks steps drawn with a load that begins or ends here.
    """

    figure: Literal["mechanism", "acceleration", "forces", "lever"]
    title: Phrase
    steps: tuple[InForces, ...]
    state: ForceState
    group: ForceGroup = NO_GROUP
    again: bool = False

    def told(self, *reasons: Reason) -> list[Wording]:
        """The sentences of steps for some reasons, each with its sums."""
        return [line for force in self.steps if force.step.reason in reasons for line in (force.said, *force.sums)]


def force_stages(account: Account) -> Iterator[ForceStage]:
    """All steps from the drawn accelerations to the balancing load."""
    states = account.sheet.forces
    if not states:
        return
    first, *others = states
    if account.sheet.inertias:
        steps = told_of(account, account.sheet.inertias.values())
        yield ForceStage("acceleration", Phrase("force inertia"), steps, first)
    if account.sheet.springs:
        steps = told_of(account, account.sheet.springs)
        yield ForceStage("mechanism", Phrase("force step springs"), steps, first)
    shown = [(first, group) for group in first.groups]
    shown += [(state, group) for state in others for group in state.groups if group not in first.groups]
    for count, (state, group) in enumerate(shown, 1):
        steps = told_of(account, group.steps, group)
        yield ForceStage("forces", caption(account, group, count), steps, state, group, state is not first)
    for state in states:
        for lever in state.levers:
            steps = told_of(account, lever.steps, lever=lever)
            yield ForceStage("lever", Phrase("lever"), steps, state, again=state is not first)


def told_of(
    account: Account, steps: Iterable[ForceStep], group: ForceGroup = NO_GROUP, lever: Lever | None = None
) -> tuple[InForces, ...]:
    """Steps of the forces in words."""
    return tuple(InForces(account, step, group, lever) for step in steps)


def caption(account: Account, group: ForceGroup, count: int) -> Phrase:
    """``1. Links 5, 6 (RRP) cut free``, with the scale of their polygons if it is their own."""
    sheet, kind = account.sheet, {"driver": "force driver", "drawn system": "force larger group"}.get(group.way)
    said = group.told("force group", number=str(count), kind=Phrase(kind) if kind else group.kind)
    if group.per_mm == sheet.scales.force:
        return said
    drawn = replace(sheet, scales=replace(sheet.scales, force=group.per_mm))
    return Phrase(
        "force group scale", group=said, scale=Neutral(scale_statement(drawn, account.letters.convention, "force"))
    )


# moments in numbers


Balance: TypeAlias = tuple[tuple[tuple[str, tuple[str, ...]], ...], str, Decimal]
"""A moment equation in numbers: its terms, each a sign and factors, force and arm (m) or a couple; the arm of the
unknown ("" where it is a couple), and what the others give for it (in the file's force, or that times m)."""


def with_moments(equation: MomentStep) -> list[MomentTerm]:
    """The terms of a moment equation but for forces whose lines go through its point."""
    return [term for term in equation.terms if term.arm is None or abs(term.arm) > SAME]


def balance(sheet: Sheet, equation: MomentStep) -> Balance:
    """The equation with the figures of its arms, at last of its forces, that it needs to give the drawn value; its
    result is true as written."""
    drawn = amount(abs(equation.value) / sheet.scene.units.newtons, MOST)
    tried = [_balance(sheet, equation, carried, of_forces) for of_forces in FINER for carried in FINER]
    return next((b for b in tried if amount(float(abs(b[2])), MOST) == drawn), tried[0])


def _balance(sheet: Sheet, equation: MomentStep, carried: int, of_forces: int) -> Balance:
    def metres(term: MomentTerm) -> str:
        return "" if term.arm is None else amount(abs(term.arm) * sheet.scales.length, carried)

    terms = []
    for term in with_moments(equation):
        # a force has its sense from its arm, a couple from itself
        size = amount(abs(term.size) / sheet.scene.units.newtons, of_forces)
        turn = term.size if term.arm is None else term.arm
        terms.append(("-" if turn < 0 else "+", tuple(filter(None, (size, metres(term))))))
    total = -sum((Decimal(f"{sign}1") * math.prod(map(Decimal, factors)) for sign, factors in terms), Decimal(0))
    arm = metres(equation.unknown)
    return tuple(terms), arm, total / Decimal(arm) if arm else total


# the lever


def lever_scale(sheet: Sheet, lever: Lever) -> float:
    """The scale of a lever on a page (m/s for one mm): the sheet's own, unless the lever is virtual or too large."""
    extent, metres = extent_of(spots_of(lever, lever.per_mm), lever.per_mm), sheet.scene.units.rates.metres
    if not lever.virtual and least_scale(extent, LEVER_ROOM) <= lever.per_mm:
        return lever.per_mm
    return fitting_scale(extent, LEVER_ROOM, 1.0 / metres) * metres


LeverRow: TypeAlias = tuple[MomentTerm, str, str, str]
"""A force on a lever as it is written: its size (the file's unit), its arm (mm) and its moment."""
LeverSum: TypeAlias = tuple[tuple[LeverRow, ...], Decimal, str]
"""The forces on a lever, the sum of their moments, and the arm of the balancing load."""


def lever_sum(sheet: Sheet, lever: Lever) -> LeverSum:
    """The sum of the moments on a lever, with the figures that it needs to give the drawn load as it is written."""
    drawn = amount(abs(lever.value) / sheet.scene.units.newtons, MOST)
    tried = [_lever_sum(sheet, lever, carried) for carried in FINER]
    return next((s for s in tried if amount(float(abs(s[1]) / Decimal(s[2])), MOST) == drawn), tried[0])


def _lever_sum(sheet: Sheet, lever: Lever, carried: int) -> LeverSum:
    per_mm, rows = lever_scale(sheet, lever), list[LeverRow]()
    for row in (row for row in lever.rows if row.acting.force):
        mm = abs(row.arm or 0.0) / per_mm
        arm = on_paper(mm) if carried == MOST else amount(mm, carried)
        size = amount(abs(row.acting.force) / sheet.scene.units.newtons, carried)
        moment = product(size, arm, carried=carried) if row.arm else "0"
        rows.append((row, size, arm, "-" * (row.moment < 0) + moment))
    moments = [Decimal(moment) for *_, moment in rows if moment != "0"]
    places = max((int(moment.as_tuple().exponent) for moment in moments), default=0)  # of the row with the fewest
    total = sum(moments, Decimal(0)).quantize(Decimal(1).scaleb(places))
    return tuple(rows), total, amount(abs(lever.unknown.moment) / per_mm, carried)


def spots_of(lever: Lever, per_mm: float) -> list[complex]:
    """The pole, the end points and the places of the forces of a lever at a scale (mm)."""
    places = [0j, *(row.acting.at for row in lever.rows), *(z for row in lever.rows for z in row.pair or ())]
    return [z / per_mm for z in (*places, *(end for end in lever.ends.values() if abs(end) > SHORT * per_mm))]
