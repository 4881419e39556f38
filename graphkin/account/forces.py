"""The account of the forces of a position: step by step with reasons, moment equations in numbers, the laying off and
closing of polygons, the readings.

Inertia forces come first, from the drawn accelerations, and springs; then group by group the links cut free, moments,
polygon, forces inside, couples; at last the lever.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from decimal import Decimal
from itertools import chain
from typing import Literal, TypeAlias

from graphkin.account.headings import number
from graphkin.account.notation import Notation, force_letters, pole, scale_statement
from graphkin.construction.board.scales import extent_of, fitting_scale, least_scale
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.forces.force_sheet import (
    ForceGroup,
    ForceState,
    ForceVector,
    Inertia,
    Lever,
    MomentEquation,
    MomentTerm,
)
from graphkin.scene.symbol import Symbol
from graphkin.words import Neutral, Phrase, Wording, about, in_all, languages, links_named, listed, rich_text
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
    to_lay_off,
)

ZERO = 1e-8  # mm: a shorter force is nothing but rounding
SAME = 1e-6  # mm
APART = 0.3  # mm: corners that are nearer bear one letter
SHORT = 0.3  # mm: a nearer end point of a lever is at its pole
LEVER_ROOM = 134.0, 130.0  # mm, width and height of a lever

Kind = Literal["inertia", "spring", "cut", "moments", "system", "lay", "close", "inside", "couples", "lever"]


@dataclass(frozen=True)
class ForceStep:
    """A step of the forces.

    Parameters
    ----------
    kind : its action
    why : its reason
    work : its sums
    found : the force that it finds
    part : the part of a force that it finds by moments; of a polygon inside a group the link
    number : its number, after the steps of the motion
    """

    kind: Kind
    why: Phrase
    work: Sequence[Wording] = ()
    found: Sequence[Symbol] = ()
    part: str = ""
    number: int = 0

    def words(self, language: str) -> tuple[tuple[str, RichText], ...]:
        """Each language of a paper, and the reason of the step."""
        return tuple((each, rich_text(self.why, each)) for each in languages(language))

    def lines(self, language: str) -> tuple[RichText, ...]:
        """The sums, in the languages of a paper."""
        return tuple(line for told in self.work for line in in_all(told, language))


@dataclass(frozen=True)
class ForceStage:
    """The steps of a group, of the inertia forces, or of a lever (whose ``group`` has no links).

    ``figure`` is their figure; ``again`` marks steps drawn with a load that begins or ends here.
    """

    figure: Literal["mechanism", "acceleration", "forces", "lever"]
    title: Phrase
    steps: tuple[ForceStep, ...]
    state: ForceState
    group: ForceGroup = field(default_factory=lambda: ForceGroup((), ""))
    again: bool = False

    def heading(self, language: str) -> tuple[tuple[str, RichText], ...]:
        """Each language of a paper, and the title."""
        return tuple((each, rich_text(self.title, each)) for each in languages(language))

    def told(self, *kinds: Kind) -> list[Wording]:
        """The reasons of steps of some kinds, each with its sums."""
        return [line for step in self.steps if step.kind in kinds for line in (step.why, *step.work)]

    def number_of(self, kind: Kind, symbol: Symbol | None = None, part: str = "") -> int | None:
        """The step of a kind that finds a symbol, or belongs to a part or link; None without it."""
        alike = [s for s in self.steps if s.kind == kind and s.part == part and (symbol is None or symbol in s.found)]
        return alike[-1].number if alike else None

    @property
    def known(self) -> int:
        """The step that shows known forces."""
        return self.steps[0].number

    @property
    def closing(self) -> int:
        """The step that closes the polygon."""
        return [s for s in self.steps if s.kind not in ("inside", "couples")][-1].number

    def on_links(self, vector: ForceVector) -> int:
        """The step that draws a force on the links cut free."""
        return self.known if vector.known else self.number_of("moments", vector.symbol, vector.part) or self.closing

    def in_polygon(self, vector: ForceVector, link: str) -> int:
        """The step that draws a force in the polygon of one link, or ("") of the group."""
        if link:
            return self.number_of("inside", None, link) or self.closing
        laid = vector.known or vector in laid_off(self.group)
        return self.number_of("lay") or self.known if laid else self.closing


@dataclass(frozen=True)
class ForceAccount:
    """Tells the forces drawn on a sheet, in the letters of one convention."""

    sheet: Sheet
    letters: Notation

    def per_mm(self, group: ForceGroup) -> str:
        """The scale of a group's polygons, as it is written in the file's unit of force."""
        return amount(group.per_mm / self.sheet.scene.units.newtons, 12)

    def name(self, symbol: Symbol, part: str = "") -> RichText:
        """A force or a moment as a symbol, or a part of it."""
        return force_letters(self.letters.convention, symbol, part)

    def stages(self) -> Iterator[ForceStage]:
        """All steps from the drawn accelerations to the balancing load, by their numbers."""
        last = self.sheet.steps[-1].number if self.sheet.steps else 0
        for stage in self._unnumbered():
            first, last = last + 1, last + len(stage.steps)
            yield replace(stage, steps=tuple(replace(s, number=n) for n, s in enumerate(stage.steps, first)))

    def _unnumbered(self) -> Iterator[ForceStage]:
        if not self.sheet.forces:
            return
        first, *others = self.sheet.forces
        inertia = tuple(
            ForceStep("inertia", _opposing(pushed), (self.inertia(pushed),),
                      (Symbol("Fi", link=link),))
            for link, pushed in self.sheet.inertias.items()
        )
        if inertia:
            yield ForceStage("acceleration", Phrase("force inertia"), inertia, first)
        pulls = tuple(ForceStep("spring", line) for line in self.springs())
        if pulls:
            yield ForceStage("mechanism", Phrase("force step springs"), pulls, first)
        shown = [(first, group, False) for group in first.groups]
        for state in others:
            pairs = zip(state.groups, first.groups, strict=True)
            shown += [(state, group, True) for group, before in pairs if group != before]
        for count, (state, group, again) in enumerate(shown, 1):
            yield ForceStage("forces", self.caption(group, count), (*self.of_group(state, group),), state, group, again)
        for k, state in enumerate(self.sheet.forces):
            for lever in state.levers:
                why = Phrase("lever reason", pole=pole(self.letters.convention, "velocity"))
                why = Phrase("two sentences", first=why, second=Phrase("lever virtual")) if lever.virtual else why
                total, balanced = self.lever(state, lever)
                steps = (ForceStep("lever", why), ForceStep("lever", Phrase("lever step forces")),
                         ForceStep("lever", total, (balanced,), (lever.unknown.symbol,)))  # fmt: skip
                yield ForceStage("lever", Phrase("lever"), steps, state, again=bool(k))

    def inertia(self, pushed: Inertia) -> RichText:
        """``F_I4 = -m_4 a_S4 = 22.4 kg x 2.11 m/s2 = 47.4 N; M_I4 = ...; h_4 = ...``."""
        units, link = self.sheet.scene.units, pushed.mass.link
        mass, push = amount(pushed.mass.mass / units.kilograms, MOST), amount(abs(pushed.push), MOST)
        size = product(mass, push, amount(units.kilograms / units.newtons, 12), carried=MOST)
        point = next((p for p, z in self.sheet.scene.by_name[link].points.items() if z == pushed.mass.at), f"S{link}")
        letter = "A" if self.letters.convention == "us" else "a"
        force, moment = (self.name(Symbol(kind, link=link)) for kind in ("Fi", "Mi"))
        in_numbers = f"{printed(mass)} {units.mass} × {printed(push)} m/s² = {printed(size)} {units.force}"
        said = [force + " = " + sign("m", link) + " " + sign(letter, point, meaning=("a", point)) + " = " + in_numbers]
        if pushed.mass.inertia:
            turned = f"{number(pushed.moment / units.newtons, MOST)} {units.force}·m"
            said.append(moment + " = −" + sign("J", link) + " " + rate("alpha", link) + f" = {turned}")
        if pushed.mass.inertia and pushed.h is not None:
            said.append(sign("h", link) + f" = {number(abs(pushed.h) / units.metres, MOST)} {units.length}")
        return spaced(";  ", said)

    def springs(self) -> Iterator[Phrase]:
        """The force of each spring from its measured length."""
        units = self.sheet.scene.units
        for spring in self.sheet.scene.loading.springs:
            name = Symbol("P", name=spring.name)
            pull_on, opposite = (load for load in self.sheet.forces[0].known if load.symbol == name)
            length = abs(opposite.at - pull_on.at) * self.sheet.scales.length
            force = spring.pull(length)
            start, rate = amount(spring.preload / units.newtons), amount(spring.rate * units.metres / units.newtons)
            free, pull = amount(spring.free / units.metres), amount(force / units.newtons, MOST)

            def as_written(measured: str, start: str = start, rate: str = rate, free: str = free) -> str:
                return amount(float(start) + float(rate) * (float(measured) - float(free)), MOST)

            tried = [amount(length / units.metres, carried) for carried in FINER]
            measured = next((text for text in tried if float(as_written(text)) == float(pull)), tried[0])
            preload = f"{printed(start)} + " if spring.preload else ""
            stretch = f"{printed(rate)} × ({printed(measured)} − {printed(free)})"
            total = Neutral(self.name(name), f" = {preload}{stretch} = {printed(pull)} {units.force}")
            key = "force spring" if force >= 0 else "force spring pushes"
            ends = self.letters.bar(spring.points)
            size = sign("l", ends, meaning=("length", " ".join(spring.points)))
            yield Phrase(key, length=size, ends=ends, sum=total, link=spring.links[0])

    # -- a group -------------------------------------------------------------------------------------------------------

    def caption(self, group: ForceGroup, count: int) -> Phrase:
        """``1. Links 5, 6 (RRP) cut free``, with the scale of their polygons if it is their own."""
        kind = {"driver": Phrase("force driver"), "drawn system": Phrase("force larger group")}
        gaps = {"number": str(count), "links": listed(group.links), "kind": kind.get(group.way, group.kind)}
        caption = Phrase(about("force group", group.links), **gaps)
        if group.per_mm == self.sheet.scales.force:
            return caption
        drawn = replace(self.sheet, scales=replace(self.sheet.scales, force=group.per_mm))
        return Phrase("force group scale", group=caption,
                      scale=Neutral(scale_statement(drawn, self.letters.convention, "force")))  # fmt: skip

    def of_group(self, state: ForceState, group: ForceGroup) -> Iterator[ForceStep]:
        """The steps by which the forces of a group are found."""
        links, drawn = links_named(group.links), group.polygon or chain(*group.inner.values())
        acting = [*(v for v in drawn if v.known and v.span), *group.couples_before]
        names = [self.name(symbol) for symbol in dict.fromkeys(load.symbol for load in acting)]
        bare = Phrase("force step cut bare", links=links)
        cut = Phrase("force step cut", links=links, forces=listed(names)) if names else bare
        yield ForceStep("cut", cut)
        yield from self._moments(group)
        read = self.read_off(state, group)

        def own(vectors: Iterable[ForceVector]) -> tuple[Symbol, ...]:
            return tuple(s for s in dict.fromkeys(v.symbol for v in vectors if not v.known) if s in read)

        if group.way == "drawn system":
            yield ForceStep("system", Phrase("force reason system", links=listed(group.links)))
        elif len(group.polygon) > 1:
            if laid_off(group):
                yield ForceStep("lay", Phrase("force step lay"), self._laid(group))
            why = Phrase("force polygon closes", links=links)
            by, found = self._closed_by(group), own(group.polygon)
            why = why if by is None else Phrase("two sentences", first=why, second=by)
            yield ForceStep("close", why, [read.pop(s) for s in found], found)
        for link, vectors in group.inner.items():
            if found := own(vectors):
                why = Phrase("force step inside", link=link, forces=listed([*map(self.name, found)]))
                yield ForceStep("inside", why, [read.pop(s) for s in found], found, link)
        yield from self._couples(group)

    def _moments(self, group: ForceGroup) -> Iterator[ForceStep]:
        """The moment equations that give parts of forces."""
        held = next((v for v in group.polygon if v.part == "n"), None) if group.kind in ("RPP", "RPR") else None
        if held is not None:
            said = Phrase("force reason along", link=held.link.split("/")[0], force=self.name(held.symbol, "n"))
            yield ForceStep("moments", said, (), (held.symbol,), "n")
        for equation in group.moments:
            symbol, part = equation.unknown.symbol, equation.unknown.acting.part
            links, point = _links(equation.links), self.letters.point(equation.about)
            if not equation.terms and group.way == "polygon" and group.kind != "RPR":
                said = Phrase("force two-force member", links=links, force=self.name(symbol), point=point)
                yield ForceStep("moments", said, (), (symbol,), part)
                continue
            # a part, where both stand in the polygon, or where it is nought and the force lies along the bar
            parts = sum(v.symbol == symbol and v.part != "" for v in group.polygon)
            name = self.name(symbol, part if parts > 1 or not balance(self.sheet, equation)[2] else "")
            key = "driver" if group.way == "driver" else "guide" if group.kind == "RPR" else "pin"
            said = Phrase(f"force reason {key}", point=point, links=links, force=name)
            yield ForceStep("moments", said, self._in_numbers(equation, name), (symbol,), part)

    def _couples(self, group: ForceGroup) -> Iterator[ForceStep]:
        """Couples of sliding pairs with the lines of their forces, and balancing moments."""
        units = self.sheet.scene.units
        for equation in group.couples:
            if not any(link in self.sheet.scene.by_name for link in equation.links):  # a pin in a slot has no couple
                continue
            symbol = equation.unknown.symbol
            name = self.name(symbol)
            if symbol.other and not equation.value:
                yield ForceStep("couples", Phrase("force no couple", moment=Neutral(name, " = 0")), (), (symbol,))
                continue
            work = self._in_numbers(equation, name)
            for force, (_, shifted) in group.lines.items():
                if (force.link, force.other) == (symbol.link, symbol.other):
                    distance = number(abs(shifted) / units.metres, MOST)
                    shift = Phrase("force line shifted", force=self.name(force), distance=distance, unit=units.length)
                    work.append(shift)
            key = "force reason couple" if symbol.other else "force reason balance"
            yield ForceStep("couples", Phrase(key, links=_links(equation.links), moment=name), work, (symbol,))

    def _in_numbers(self, equation: MomentEquation, name: RichText) -> list[Wording]:
        """The arms of a moment equation as measured on the mechanism, the forces without one, and the equation as
        ``ΣM_C = F_G5 x 0.0488 m ... = 0, F^t_R45 = -10.7 N``; ``name`` is the name of its unknown."""
        of = [*((self.name(t.symbol), t.arm) for t in with_moments(equation)), (name, equation.unknown.arm)]
        arms = [force + f" {printed(on_paper(abs(arm)))} mm" for force, arm in of if arm is not None]
        scale = Neutral(f"× {amount(self.sheet.scales.length, 12)} m/mm")
        told: list[Wording] = [Phrase("force arms", arms=Neutral(spaced(",  ", arms)), scale=scale)] if arms else []
        through = [self.name(t.symbol) for t in equation.terms if t not in with_moments(equation)]
        told += [Phrase("force no arm", forces=Neutral(spaced(",  ", through)))] if through else []
        scene, point = self.sheet.scene, equation.about
        point = f"({point})" if point in scene.by_name and point not in scene.holders else point
        terms, arm, total = balance(self.sheet, equation)
        sums = " ".join(f"{'−' if turn == '-' else '+'} {'·'.join(map(printed, factors))}" for turn, factors in terms)
        # the sense of a force is that in which it comes out positive; of a moment what acts may be the opposite
        turned = not arm and equation.unknown.acting.turned
        sums += f" {'−' if turned or (arm and total < 0) else '+'} "
        whole = sums.lstrip().removeprefix("+ ") + name + (f"·{printed(arm)}" if arm else "")
        value = number(float(abs(total) if arm else -total if turned else total), MOST) if total else "0"
        unit = scene.units.force + ("" if arm else "·m")
        return [*told, sign("ΣM", point) + " = " + whole + " = 0;  " + name + f" = {value} {unit}"]

    def read_off(self, state: ForceState, group: ForceGroup) -> dict[Symbol, RichText]:
        """``F_R45 = 43.33 mm x 200 N/mm = 8666.4 N``, for each force that was found here."""
        unit, per_mm, found = self.sheet.scene.units.force, self.per_mm(group), dict[Symbol, RichText]()
        for vector in chain(group.polygon, *group.inner.values()):
            symbol, back = vector.symbol, vector.symbol.opposite
            if vector.known or symbol in found or back in found:
                continue
            force = state.vectors.get(symbol, state.vectors.get(back))
            mm = abs(vector.span if force is None else force / group.per_mm)
            size = on_paper(mm)
            value = f"{printed(product(size, per_mm))} {unit}"
            sum_ = f"{printed(size)} mm × {printed(per_mm)} {unit}/mm = {value}"
            found[symbol] = self.name(symbol) + f" = {'0' if mm < ZERO else sum_}"
        return found

    def _laid(self, group: ForceGroup) -> list[RichText]:
        """``ab = P = 9000 N ÷ 100 N/mm = 90.00 mm, 180.0°`` for each known force of a polygon."""
        force, scale, lines = self.sheet.scene.units.force, self.per_mm(group), list[RichText]()
        per = group.per_mm / self.sheet.scene.units.newtons
        for v in laid_off(group):
            value, length = to_lay_off(abs(v.span) * per, per, abs(v.span))
            of = (m for m in group.moments
                  if m.unknown.symbol == v.symbol and v.part in (m.unknown.acting.part, ""))  # fmt: skip
            by_moments = next((m for m in of if abs(abs(m.value) / group.per_mm - abs(v.span)) < SAME), None)
            if by_moments is not None:
                # as their sum gave it
                value = amount(float(abs(balance(self.sheet, by_moments)[2])), MOST)
                length = length if is_quotient(length, value, scale) else on_paper(float(value) / per)
            begin, end = (corner_at(group, place) for place in (v.tail, v.tip))
            ends = sign(begin + end) + " = " if begin != end else ""  # "" where they bear one letter
            sum_ = f"{printed(value)} {force} ÷ {printed(scale)} {force}/mm = {printed(length)} mm"
            lines.append(ends + self.name(v.symbol, v.part) + f" = {sum_},  {pointing(v.span)}°")
        return lines

    def _closed_by(self, group: ForceGroup) -> Phrase | None:
        """The ends of the chain through which the lines of the unknown forces go; None where they do not."""
        known, unknown = laid_off(group), [v for v in group.polygon if v.by == "closing"]
        if not known or not unknown or len(unknown) > 2:
            return None

        def name(vector: ForceVector) -> RichText:
            return self.name(vector.symbol, vector.part)

        def corner(place: complex) -> RichText:
            return sign(corner_at(group, place))

        first, last = known[0], known[-1]
        chained = {"first": name(first), "last": name(last), "begin": corner(first.tail), "end": corner(last.tip)}
        if len(unknown) == 1:
            return Phrase("force closes", force=name(unknown[0]), **chained)
        behind = next((v for v in unknown if abs(v.tail - last.tip) < SAME), None)
        before = next((v for v in unknown if abs(v.tip - first.tail) < SAME and v is not behind), None)
        if behind is None or before is None:
            return None
        frame, sought = self.sheet.scene.frame.name, (behind, before)
        ways = [way for v in sought if (way := self.letters.direction(v.direction, frame))]
        if len(ways) < 2:
            return None
        line, other_line = ways
        return Phrase(
            "force lines meet", line=line, force=name(behind), other_line=other_line, other_force=name(before),
            corner=corner(behind.tip), **chained,
        )  # fmt: skip

    def lever(self, state: ForceState, lever: Lever) -> tuple[Phrase, Phrase]:
        """The sum of the moments on a lever in numbers, and its balancing load beside that of the polygons."""
        units, balances = self.sheet.scene.units, lever.unknown.symbol
        name, moment, (_, total, arm) = self.name(balances), balances.kind == "M", lever_sum(self.sheet, lever)
        if moment:
            values = lever.value, float(state.moments.get(balances) or 0.0)
        else:
            values = abs(lever.value), abs(state.vectors.get(balances, 0j))
        lead = "−" * (lever.unknown.moment < 0) + name + f"·{printed(arm)}"
        rest = f"{'+' if total >= 0 else '−'} {printed(amount(float(abs(total)), 12))}"
        unit = units.force + ("·m" if moment else "")
        by_lever, by_polygons = (f"{number(v / units.newtons, MOST)} {unit}" for v in values)
        return (
            Phrase("lever sum", sum=Neutral(lead, f" {rest} = 0")),
            Phrase("lever balance", lever=Neutral(name, f" = {by_lever}"), polygons=Neutral(by_polygons)),
        )


def _opposing(pushed: Inertia) -> Phrase:
    """The sense of an inertia force, and of its couple where the link has a moment of inertia."""
    alone = "" if pushed.mass.inertia else " alone"
    return Phrase(f"force step inertia{alone}", link=pushed.mass.link)


def _links(names: Sequence[str]) -> Phrase:
    """Links by name, without blocks of pins unless they are alone."""
    return links_named([name for name in names if "/" not in name] or names)


# -- polygons ----------------------------------------------------------------------------------------------------------


def laid_off(group: ForceGroup) -> tuple[ForceVector, ...]:
    """The forces of a polygon that are known before it is closed, given or by moments, in order."""
    turned = list(group.polygon)
    for _ in turned:  # from the first known one behind an unknown one
        if turned[0].by != "closing" and turned[-1].by == "closing":
            break
        turned.append(turned.pop(0))
    return tuple(v for v in turned if v.by != "closing" and abs(v.span) > ZERO)


def corners(group: ForceGroup) -> tuple[tuple[str, complex, ForceVector], ...]:
    """The corners of a polygon as they are drawn, lettered a, b, c …: each with its place (mm) and the force that ends
    there, the first with the force that begins there; coincident places have one letter."""
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
    """The letter of the corner at a place (mm)."""
    return min(corners(group), key=lambda corner: abs(corner[1] - place))[0]


Balance: TypeAlias = tuple[tuple[tuple[str, tuple[str, ...]], ...], str, Decimal]
"""A moment equation in numbers: its terms, each a sign and factors, force and arm (m) or a couple; the arm of the
unknown ("" where it is a couple), and what the others give for it (in the file's force, or that times m)."""


def with_moments(equation: MomentEquation) -> list[MomentTerm]:
    """The terms of a moment equation but for forces whose lines go through its point."""
    return [term for term in equation.terms if term.arm is None or abs(term.arm) > SAME]


def balance(sheet: Sheet, equation: MomentEquation) -> Balance:
    """The equation with the figures of its arms, at last of its forces, that it needs to give the drawn value; its
    result is true as written."""
    drawn = amount(abs(equation.value) / sheet.scene.units.newtons, MOST)
    tried = [_balance(sheet, equation, carried, of_forces) for of_forces in FINER for carried in FINER]
    return next((b for b in tried if amount(float(abs(b[2])), MOST) == drawn), tried[0])


def _balance(sheet: Sheet, equation: MomentEquation, carried: int, of_forces: int) -> Balance:
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


# -- the lever ---------------------------------------------------------------------------------------------------------


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
