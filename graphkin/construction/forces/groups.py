"""The forces of a group with one polygon: parts of the outer forces by moments, the rest by closing the polygon.

Of a turning pair the part square to the bar follows from the moments about the inner pin of the dyad, of one on a
guide that slides the part along the guide from the body that slides; the polygon of the whole group, closed with the
directions that are left, gives the rest, and that of one body the force inside (Sun Huan, Mechanical Principles, ch. 4;
Artobolevsky, Theory of mechanisms and machines, ch. 13).  Where a driver acts, the link that is driven last balances,
and links that a driver holds together have a couple or a push between them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from graphkin.construction.forces.cut_free import CutFree, HeadToTail, across, guide_letters
from graphkin.construction.forces.force_sheet import (
    Acting,
    ForceGroup,
    ForceLine,
    ForceTerm,
    ForceVector,
    KnownMoment,
    MomentEquation,
    Part,
)
from graphkin.construction.forces.joints import BalanceForm, opposite
from graphkin.construction.sizes import Direction
from graphkin.plane import dot, unit
from graphkin.scene.symbol import Symbol
from graphkin.structure import Body, Driven, Dyad, DyadKind, Pair, Slide, Turn, links_of

__all__ = [
    "CutBody", "GroupFigure", "along_guide", "at_driver", "between_welded", "foot_name",
    "line_of_action", "of_dyad", "outer_couple", "slide_found",
]  # fmt: skip



def of_dyad(cut: CutFree, dyad: Dyad, balances: Mapping[str, BalanceForm]) -> ForceGroup:
    """The forces of a dyad: those of its outer pairs, then the force inside, then those between links that drivers
    hold together.

    Parameters
    ----------
    balances : what balances at each driver, by the driver's key
    """
    cut.load_pins(links_of(dyad))
    one, two = CutBody(cut, dyad.first, dyad.outer_first), CutBody(cut, dyad.second, dyad.outer_second)
    figure = GroupFigure()
    outer, inner = _KINDS[dyad.kind](cut, dyad, one, two, figure)
    slides = [pair for pair in (dyad.outer_first, dyad.inner, dyad.outer_second) if isinstance(pair, Slide)]
    for side in (one, two):
        if side.body.welds:
            between_welded(cut, side, inner[side.name], slides, figure, balances)
    cut.done |= set(links_of(dyad))
    return figure.group(dyad.links, dyad.kind, outer, False)


_Found = tuple[tuple[ForceVector, ...], Mapping[str, tuple[Acting, ...]]]


def _tangential(cut: CutFree, side: CutBody, hinge: complex, letter: str, figure: GroupFigure) -> Acting:
    """The part of an outer pin's force square to the bar, by moments about the inner pin."""
    square = 1j * unit(side.at - hinge)
    found = cut.by_moments(side.links, hinge, letter, side.outer_force(square), "t")
    figure.moments.append(found)
    return side.outer_force(square * found.value)


def _bar(side: CutBody, letter: str) -> tuple[str, str]:
    assert isinstance(side.outer, Turn)
    return side.outer.point, letter


def _pin(dyad: Dyad) -> Turn:
    assert isinstance(dyad.inner, Turn)
    return dyad.inner


def _inner_names(cut: CutFree, dyad: Dyad) -> tuple[str, str, complex]:
    """The links of both bodies at the inner turning pair, and its place."""
    point = _pin(dyad).point
    links = cut.names.structure.links
    holders = [next(n for n in body.links if point in links[n].points) for body in dyad.bodies]
    return holders[0], holders[1], cut.images.point(holders[0], point)


def _rrr(cut: CutFree, dyad: Dyad, one: CutBody, two: CutBody, figure: GroupFigure) -> _Found:
    letter = _pin(dyad).point
    hinge = _inner_names(cut, dyad)[2]
    t1, t2 = (_tangential(cut, side, hinge, letter, figure) for side in (one, two))
    along1 = figure.parted(t1, _bar(one, letter))
    figure.knowns(cut, (*one.links, *two.links))
    along2 = figure.parted(t2, _bar(two, letter), last=True)
    t1_found = cut.lay(figure.chain, t1, "t", False) if t1.force else 0j
    cut.lay_known(figure.chain, one.links)
    first = len(figure.chain.vectors)
    cut.lay_known(figure.chain, two.links)
    t2_tail = figure.chain.at
    if t2.force:
        cut.lay(figure.chain, t2, "t", False)
    end = figure.chain.at
    start = cut.closing(dyad.links, end, two.at - hinge, 0j, one.at - hinge)
    n2 = cut.drawn(t2.symbol, two.name, two.at, end, start, along2)
    n1 = cut.drawn(t1.symbol, one.name, one.at, start, 0j, along1)
    r1 = -start * cut.per_mm + t1_found
    r2 = (start - t2_tail) * cut.per_mm
    one.found(r1)
    two.found(r2)
    own = [n1, *figure.chain.vectors[:first]]
    figure.chain.vectors[:] = [n1, *figure.chain.vectors, n2]
    inner = _inner_force(cut, dyad, figure, own, start, one.links)
    return tuple(figure.chain.vectors), {
        one.name: (inner[0], one.outer_force(r1)), two.name: (inner[1], two.outer_force(r2))
    }  # fmt: skip


def _inner_force(
    cut: CutFree, dyad: Dyad, figure: GroupFigure, own: list[ForceVector], start: complex, links: tuple[str, ...]
) -> tuple[Acting, Acting]:
    """The force of the inner pin closes the polygon of the first body: on it, and on the second."""
    first, second, at = _inner_names(cut, dyad)
    point = _pin(dyad).point
    end = own[-1].tip if own else start
    force = (start - end) * cut.per_mm
    names = cut.names
    symbol = names.of_pin(point, second)
    if second == names.holders[point][0] and len(names.structure.hinges[point]) > 2:
        # the first link at a pin bears the sum of several: the force inside is called as the other link's is
        symbol = opposite(names.of_pin(point, first))
    cut.set_pin(point, first, force)
    cut.set_pin(point, second, -force)
    on_first = Acting(opposite(symbol), first, force, at)
    figure.inner[first] = (*own, cut.drawn(on_first.symbol, first, at, end, start))
    return on_first, Acting(symbol, second, -force, at)


def _rrp(cut: CutFree, dyad: Dyad, one: CutBody, two: CutBody, figure: GroupFigure) -> _Found:
    letter = _pin(dyad).point
    hinge = _inner_names(cut, dyad)[2]
    t1 = _tangential(cut, one, hinge, letter, figure)
    square = 1j * two.guide()
    along1 = figure.parted(t1, _bar(one, letter))
    figure.knowns(cut, (*one.links, *two.links))
    figure.unknown(two.outer_force(square), "", across(two.outer))
    t1_found = cut.lay(figure.chain, t1, "t", False) if t1.force else 0j
    cut.lay_known(figure.chain, one.links)
    first = len(figure.chain.vectors)
    cut.lay_known(figure.chain, two.links)
    end = figure.chain.at
    start = cut.closing(dyad.links, end, square, 0j, one.at - hinge)
    normal = cut.drawn(two.symbol, two.name, two.at, end, start)
    n1 = cut.drawn(t1.symbol, one.name, one.at, start, 0j, along1)
    r1, n2 = -start * cut.per_mm + t1_found, (start - end) * cut.per_mm
    one.found(r1)
    own = [n1, *figure.chain.vectors[:first]]
    figure.chain.vectors[:] = [n1, *figure.chain.vectors, normal]
    inner = _inner_force(cut, dyad, figure, own, start, one.links)
    on_two = two.outer_force(n2)
    couple = outer_couple(cut, two, on_two, hinge, letter, figure, ())
    slide_found(cut, two, n2, couple, links_of(dyad))
    return tuple(figure.chain.vectors), {
        one.name: (inner[0], one.outer_force(r1)), two.name: (inner[1], on_two)
    }  # fmt: skip


def _rpr(cut: CutFree, dyad: Dyad, one: CutBody, two: CutBody, figure: GroupFigure) -> _Found:
    slide = dyad.inner
    assert isinstance(slide, Slide)
    assert isinstance(two.outer, Turn)
    along = cut.images.along(slide)
    # body one slides on body two: what pushes it along the guide only its pin can hold
    held = -cut.projected(cut.forces_on(one.links), along)
    r_along = one.outer_force(along * held)
    both = (*one.links, *two.links)
    by = cut.by_moments(both, two.at, two.outer.point, one.outer_force(1j * along), "t", (r_along,))
    figure.moments.append(by)
    r_square = one.outer_force(1j * along * by.value)
    guide = along_guide(slide), across(slide)
    if held:
        figure.terms.append(ForceTerm(one.symbol, "n", True, True, guide[0]))
    figure.terms.append(ForceTerm(one.symbol, "t" if held else "", True, True, guide[1]))
    figure.knowns(cut, both)
    figure.unknown(two.outer_force(0j), "", None)
    r1 = cut.lay(figure.chain, r_along, "n", False) if held else 0j
    r1 += cut.lay(figure.chain, r_square, "t" if held else "", False)
    cut.lay_known(figure.chain, one.links)
    first = len(figure.chain.vectors)
    cut.lay_known(figure.chain, two.links)
    end = figure.chain.at
    r2 = -end * cut.per_mm
    own = list(figure.chain.vectors[:first])
    figure.chain.vectors.append(cut.drawn(two.symbol, two.name, two.at, end, 0j))
    one.found(r1)
    two.found(r2)
    inner = _inner_slide(cut, dyad, slide, figure, own, 0j, one, one.outer_force(r1))
    polygon = tuple(figure.chain.vectors)
    return polygon, {one.name: (*inner[0], one.outer_force(r1)), two.name: (*inner[1], two.outer_force(r2))}


def _inner_slide(
    cut: CutFree, dyad: Dyad, slide: Slide, figure: GroupFigure, own: list[ForceVector], start: complex, one: CutBody,
    outer: Acting,
) -> tuple[tuple[Acting, ...], tuple[Acting, ...]]:  # fmt: skip
    """The force of the inner sliding pair closes the polygon of the first body, its couple the moments there."""
    end = own[-1].tip if own else start
    square = 1j * cut.images.along(slide)
    force = square * dot(start - end, square) * cut.per_mm
    at, symbol = cut.images.foot(slide), cut.names.of_slide(slide)
    mine = slide.a in one.links
    on_one = Acting(symbol if mine else opposite(symbol), slide.a if mine else slide.b, force, at)
    on_two = Acting(opposite(on_one.symbol), slide.b if mine else slide.a, -force, at)
    figure.inner[on_one.link] = (*own, cut.drawn(on_one.symbol, on_one.link, at, end, start))
    assert isinstance(one.outer, Turn)
    turned = replace(on_one.symbol, kind="M")
    found = cut.couple(one.links, one.at, one.outer.point, turned, (on_one, outer))
    figure.couples.append(found)
    line_of_action(cut, figure, on_one, found.value)
    sign = 1.0 if mine else -1.0
    cut.set_slide(slide, sign * force, sign * found.value, links_of(dyad))
    return (on_one,), (on_two,)


def _prp(cut: CutFree, dyad: Dyad, one: CutBody, two: CutBody, figure: GroupFigure) -> _Found:
    letter = _pin(dyad).point
    hinge = _inner_names(cut, dyad)[2]
    n1, n2 = one.outer_force(1j * one.guide()), two.outer_force(1j * two.guide())
    figure.unknown(n1, "", across(one.outer))
    figure.knowns(cut, (*one.links, *two.links))
    figure.unknown(n2, "", across(two.outer))
    cut.lay_known(figure.chain, one.links)
    first = len(figure.chain.vectors)
    cut.lay_known(figure.chain, two.links)
    end = figure.chain.at
    start = cut.closing(dyad.links, end, n2.force, 0j, n1.force)
    drawn1 = cut.drawn(n1.symbol, one.name, one.at, start, 0j)
    drawn2 = cut.drawn(n2.symbol, two.name, two.at, end, start)
    own = [drawn1, *figure.chain.vectors[:first]]
    figure.chain.vectors[:] = [drawn1, *figure.chain.vectors, drawn2]
    inner = _inner_force(cut, dyad, figure, own, start, one.links)
    found1, found2 = one.outer_force(-start * cut.per_mm), two.outer_force((start - end) * cut.per_mm)
    for side, force in ((one, found1), (two, found2)):
        couple = outer_couple(cut, side, force, hinge, letter, figure, ())
        slide_found(cut, side, force.force, couple, links_of(dyad))
    return tuple(figure.chain.vectors), {one.name: (inner[0], found1), two.name: (inner[1], found2)}


def _rpp(cut: CutFree, dyad: Dyad, one: CutBody, two: CutBody, figure: GroupFigure) -> _Found:
    slide = dyad.inner
    assert isinstance(slide, Slide)
    along = cut.images.along(slide)
    held = -cut.projected(cut.forces_on(one.links), along)
    r_along = one.outer_force(along * held)
    square = 1j * two.guide()
    guide = along_guide(slide), across(slide)
    figure.unknown(one.outer_force(1j * along), "t" if held else "", guide[1])
    if held:
        figure.terms.append(ForceTerm(one.symbol, "n", True, True, guide[0]))
    figure.knowns(cut, (*one.links, *two.links))
    figure.unknown(two.outer_force(square), "", across(two.outer))
    r1 = cut.lay(figure.chain, r_along, "n", False) if held else 0j
    cut.lay_known(figure.chain, one.links)
    first = len(figure.chain.vectors)
    cut.lay_known(figure.chain, two.links)
    end = figure.chain.at
    start = cut.closing(dyad.links, end, square, 0j, 1j * along)
    crossing = cut.drawn(one.symbol, one.name, one.at, start, 0j, "t" if held else "")
    normal = cut.drawn(two.symbol, two.name, two.at, end, start)
    own = [crossing, *figure.chain.vectors[:first]]
    figure.chain.vectors[:] = [crossing, *figure.chain.vectors, normal]
    r1 += -start * cut.per_mm
    n2 = (start - end) * cut.per_mm
    one.found(r1)
    inner = _inner_slide(cut, dyad, slide, figure, own, start, one, one.outer_force(r1))
    on_two = two.outer_force(n2)
    known = figure.couples[-1]
    back = KnownMoment(opposite(known.symbol), inner[1][0].link, -known.value)
    couple = outer_couple(cut, two, on_two, two.at, foot_name(two.outer), figure, inner[1], (back,))
    slide_found(cut, two, n2, couple, links_of(dyad))
    return tuple(figure.chain.vectors), {one.name: (*inner[0], one.outer_force(r1)), two.name: (*inner[1], on_two)}


_KINDS: Mapping[DyadKind, Callable[[CutFree, Dyad, CutBody, CutBody, GroupFigure], _Found]] = {
    "RRR": _rrr,
    "RRP": _rrp,
    "RPR": _rpr,
    "PRP": _prp,
    "RPP": _rpp,
}


# -- a body of a group, and what is drawn of the group as it grows -----------------------------------------------------


@dataclass
class CutBody:
    """A body of a dyad with its outer pair."""

    cut: CutFree
    body: Body
    outer: Pair

    @property
    def links(self) -> tuple[str, ...]:
        return self.body.links

    @property
    def name(self) -> str:
        """The link of the body that the outer pair holds."""
        return self.outer.a if self.outer.a in self.body.links else self.outer.b

    @property
    def at(self) -> complex:
        """Where the outer force acts (mm)."""
        if isinstance(self.outer, Slide):
            return self.cut.images.foot(self.outer)
        return self.cut.images.point(self.outer.a, self.outer.point)

    @property
    def symbol(self) -> Symbol:
        """The outer force on the body."""
        if isinstance(self.outer, Turn):
            return self.cut.names.of_pin(self.outer.point, self.outer.a)
        named = self.cut.names.of_slide(self.outer)
        return named if self.outer.a in self.body.links else opposite(named)

    def outer_force(self, force: complex) -> Acting:
        return Acting(self.symbol, self.name, force, self.at)

    def guide(self) -> complex:
        """Direction of the guide of the outer pair."""
        assert isinstance(self.outer, Slide)
        return self.cut.images.along(self.outer)

    def found(self, force: complex) -> None:
        """The outer force on the body is known (of a slide: with its couple later)."""
        if isinstance(self.outer, Turn):
            self.cut.set_pin(self.outer.point, self.outer.a, force)


@dataclass
class GroupFigure:
    """What is drawn of a group, as it grows."""

    moments: list[MomentEquation] = field(default_factory=list)
    terms: list[ForceTerm] = field(default_factory=list)
    chain: HeadToTail = field(default_factory=HeadToTail)
    inner: dict[str, tuple[ForceVector, ...]] = field(default_factory=dict)
    couples: list[MomentEquation] = field(default_factory=list)
    lines: list[ForceLine] = field(default_factory=list)

    def group(self, links: tuple[str, ...], kind: str, polygon: tuple[ForceVector, ...], driver: bool) -> ForceGroup:
        return ForceGroup(
            links, kind, "driver" if driver else "polygon", tuple(self.moments), tuple(self.terms), polygon,
            self.inner, tuple(self.couples), tuple(self.lines),
        )  # fmt: skip

    def unknown(self, one: Acting, part: Part, way: Direction | None) -> None:
        self.terms.append(ForceTerm(one.symbol, part, False, way is not None, way, one.turned))

    def parted(self, one: Acting, bar: tuple[str, str], last: bool = False) -> Part:
        """A force of which moments gave the part square to a bar: its other part is unknown; how that is marked."""
        if not one.force:  # nothing acts on the bar between its ends
            self.unknown(one, "", Direction("along", bar))
            return ""
        square = ForceTerm(one.symbol, "t", True, True, Direction("square", bar))
        self.terms += [square] if last else []
        self.unknown(one, "n", Direction("along", bar))
        self.terms += [] if last else [square]
        return "n"

    def knowns(self, cut: CutFree, links: tuple[str, ...]) -> None:
        self.terms += [ForceTerm(f.symbol, "", True, True, None, f.turned) for f in cut.forces_on(links)]


def along_guide(pair: Pair) -> Direction:
    """The direction of the guide of a sliding pair."""
    assert isinstance(pair, Slide)
    return Direction("along", guide_letters(pair))


def foot_name(pair: Pair) -> str:
    """The letter of the point where a sliding pair's force acts, or the link at whose origin it does."""
    assert isinstance(pair, Slide)
    return pair.pin or pair.a


def outer_couple(
    cut: CutFree, side: CutBody, force: Acting, about: complex, letter: str, figure: GroupFigure,
    more: tuple[Acting, ...], turning: tuple[KnownMoment, ...] = (),
) -> float:  # fmt: skip
    """The couple of an outer sliding pair on the body, and the line of action of its force."""
    symbol = replace(side.symbol, kind="M")
    found = cut.couple(side.links, about, letter, symbol, (force, *more), turning)
    figure.couples.append(found)
    line_of_action(cut, figure, force, found.value)
    return found.value


def line_of_action(cut: CutFree, figure: GroupFigure, force: Acting, couple: float) -> None:
    """Where a couple puts the line of action of its force."""
    if not force.force:
        return
    shift = couple / abs(force.force)
    at = force.at - 1j * unit(force.force) * (shift * cut.images.mm)
    figure.lines.append(ForceLine(force.symbol, at, unit(force.force), shift))


def slide_found(cut: CutFree, side: CutBody, force: complex, couple: float, inside: tuple[str, ...]) -> None:
    """Force and couple of an outer sliding pair as they act on the body."""
    assert isinstance(side.outer, Slide)
    sign = 1.0 if side.outer.a in side.body.links else -1.0
    cut.set_slide(side.outer, sign * force, sign * couple, inside)


# -- where drivers act -------------------------------------------------------------------------------------------------


def between_welded(
    cut: CutFree, side: CutBody, found: tuple[Acting, ...], slides: Sequence[Slide], figure: GroupFigure,
    balances: Mapping[str, BalanceForm],
) -> None:  # fmt: skip
    """The forces between links of a body that drivers hold together, from the outermost link on, with what balances
    there.

    Parameters
    ----------
    found : the forces of the dyad's pairs on this body
    slides : the sliding pairs of the dyad, whose couples act on this body too
    """
    extra: dict[str, list[Acting]] = {}
    turning: dict[str, list[KnownMoment]] = {}
    for one in found:
        extra.setdefault(one.link, []).append(one)
    for slide in slides:
        symbol, couple = cut.names.of_slide(slide, "M"), cut.slides[slide.key][1]
        for moment in (KnownMoment(symbol, slide.a, couple), KnownMoment(opposite(symbol), slide.b, -couple)):
            if couple and moment.link in side.links:
                turning.setdefault(moment.link, []).append(moment)
    for weld in reversed(side.body.welds):
        leaf, other = weld.b, weld.a
        balance = balances[weld.driver.key]
        acting = [*cut.forces_on((leaf,)), *extra.get(leaf, ())]
        turns = turning.get(leaf, [])
        pair = weld.pair
        chain = HeadToTail()
        for one in acting:
            cut.lay(chain, one)
        force = -chain.at * cut.per_mm
        if isinstance(pair, Turn):
            at = cut.images.point(leaf, pair.point)
            symbol = cut.names.of_pin(pair.point, leaf)
            if leaf == cut.names.holders.get(pair.point, ("",))[0]:
                symbol = cut.names.between(other, leaf, pair.point)
            on = Acting(symbol, leaf, force, at)
            named = balance.symbol
            turned = balance.link != leaf
            equation = cut.couple((leaf,), at, pair.point, named, tuple(extra.get(leaf, ())), tuple(turns))
            value = -equation.value if turned else equation.value
            figure.couples.append(equation)
            cut.balances[named] = value
            cut.set_pin(pair.point, leaf, force)
            cut.set_pin(pair.point, other, -force)
            extra.setdefault(other, []).append(Acting(opposite(symbol), other, -force, at))
            turning.setdefault(other, []).append(KnownMoment(named, other, -equation.value, not turned))
            figure.inner[leaf] = (*chain.vectors, cut.drawn(symbol, leaf, at, chain.at, 0j))
            continue
        at, along = cut.images.foot(pair), cut.images.along(pair)
        mine = pair.a == leaf
        symbol = cut.names.of_slide(pair) if mine else opposite(cut.names.of_slide(pair))
        push, square = along * dot(force, along), 1j * along * dot(force, 1j * along)
        on = Acting(symbol, leaf, square, at)
        driving = Acting(balance.symbol, leaf, push, at, not mine)
        corner = chain.at + push / cut.per_mm
        figure.inner[leaf] = (
            *chain.vectors, replace(cut.drawn(balance.symbol, leaf, at, chain.at, corner), turned=not mine),
            cut.drawn(symbol, leaf, at, corner, 0j),
        )  # fmt: skip
        known = (*extra.get(leaf, ()), on, driving)
        equation = cut.couple((leaf,), at, foot_name(pair), replace(symbol, kind="M"), known, tuple(turns))
        figure.couples.append(equation)
        line_of_action(cut, figure, on, equation.value)
        sign = 1.0 if mine else -1.0
        cut.balances[balance.symbol] = sign * push
        cut.set_slide(pair, sign * square, sign * equation.value, side.body.links)
        extra.setdefault(other, []).extend([
            Acting(opposite(symbol), other, -square, at), Acting(balance.symbol, other, -push, at, mine),
        ])  # fmt: skip
        turning.setdefault(other, []).append(KnownMoment(opposite(equation.symbol), other, -equation.value))


def at_driver(cut: CutFree, element: Driven, balance: BalanceForm) -> ForceGroup:
    """The forces of a link that is driven from links still to come, and what balances it there."""
    link = element.link
    cut.load_pins((link,))
    figure, pair = GroupFigure(), element.pair
    side = CutBody(cut, Body((link,)), pair)
    chain = figure.chain
    if isinstance(pair, Turn):
        polygon = _at_crank(cut, side, balance, figure)
    else:
        balancing = _balancing(cut, balance, link)
        square = side.outer_force(1j * side.guide())
        figure.unknown(balancing, "", along_guide(pair))
        figure.knowns(cut, (link,))
        figure.unknown(square, "", across(pair))
        cut.lay_known(chain, (link,))
        end = chain.at
        start = cut.closing((link,), end, square.force, 0j, balancing.force)
        found = -start * cut.per_mm
        cut.balances[balance.symbol] = -found if balancing.turned else found
        on = side.outer_force((start - end) * cut.per_mm)
        push = replace(balancing, force=found)
        about = cut.images.foot(pair)
        letter = foot_name(pair)
        couple = outer_couple(cut, side, on, about, letter, figure, (push,))
        slide_found(cut, side, on.force, couple, (link,))
        drawn = replace(cut.drawn(balance.symbol, link, push.at, start, 0j), turned=push.turned)
        polygon = (drawn, *chain.vectors, cut.drawn(on.symbol, link, on.at, end, start))
        _react(cut, balance, link, push)
    cut.done.add(link)
    return figure.group((link,) if link not in cut.names.blocks else (), "driver", polygon, True)


def _balancing(cut: CutFree, balance: BalanceForm, link: str) -> Acting:
    """A balancing force of unit size on a link."""
    along, at = cut.images.of_balance(balance)
    mine = balance.link == link
    return Acting(balance.symbol, link, along if mine else -along, at, not mine)


def _at_crank(cut: CutFree, side: CutBody, balance: BalanceForm, figure: GroupFigure) -> tuple[ForceVector, ...]:
    assert isinstance(side.outer, Turn)
    link, letter, chain = side.links[0], side.outer.point, figure.chain
    if balance.is_moment:
        mine = balance.link == link
        equation = cut.couple((link,), side.at, letter, balance.symbol)
        figure.couples.append(equation)
        cut.balances[balance.symbol] = equation.value if mine else -equation.value
        other = balance.other if mine else balance.link
        if other != cut.names.structure.scene.frame.name:
            cut.turn(KnownMoment(balance.symbol, other, -equation.value, mine))
    else:
        push = _balancing(cut, balance, link)
        equation = cut.by_moments((link,), side.at, letter, push, "")
        figure.moments.append(equation)
        found = replace(push, force=push.force * equation.value)
        figure.terms.append(ForceTerm(balance.symbol, "", True, True, None, push.turned))
        cut.balances[balance.symbol] = cut.lay(chain, found, "", False)
    figure.knowns(cut, (link,))
    figure.unknown(side.outer_force(0j), "", None)
    cut.lay_known(chain, (link,))
    side.found(-chain.at * cut.per_mm)
    return (*chain.vectors, cut.drawn(side.symbol, link, side.at, chain.at, 0j))


def _react(cut: CutFree, balance: BalanceForm, link: str, push: Acting) -> None:
    """What drives a link from another one loads that one."""
    other = balance.other if balance.link == link else balance.link
    if other != cut.names.structure.scene.frame.name:
        cut.push(Acting(push.symbol, other, -push.force, push.at, not push.turned))
