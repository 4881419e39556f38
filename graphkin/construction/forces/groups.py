"""The forces of a group with one polygon: parts of the outer forces by moments, the rest by closing the polygon.

Of a turning pair the part square to the bar follows from the moments about the inner pin of the dyad, of one on a
guide that slides the part along the guide from the body that slides; the polygon of the whole group, closed with the
directions that are left, gives the rest, and that of one body the force inside (Sun Huan, Mechanical Principles, ch. 4;
Artobolevsky, Theory of mechanisms and machines, ch. 13).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from graphkin.construction.forces.at_drivers import between_welded
from graphkin.construction.forces.cut_free import CutFree
from graphkin.construction.forces.force_sheet import Acting, ForceGroup, ForceTerm, ForceVector, KnownMoment
from graphkin.construction.forces.group_figure import (
    CutBody,
    GroupFigure,
    across,
    along_guide,
    foot_name,
    line_of_action,
    outer_couple,
    slide_found,
)
from graphkin.construction.forces.joints import BalanceForm, opposite
from graphkin.plane import dot, unit
from graphkin.structure import Dyad, DyadKind, Slide, Turn, links_of

__all__ = ["of_dyad"]


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
