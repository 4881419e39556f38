"""Forces where drivers act: at the link that is driven last, and between links that a driver holds together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from graphkin.construction.forces.cut_free import CutFree, HeadToTail
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
from graphkin.plane import dot
from graphkin.structure import Body, Driven, Slide, Turn

__all__ = ["at_driver", "between_welded"]


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
