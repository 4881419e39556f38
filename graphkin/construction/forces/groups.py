"""The forces of a group: of a dyad, of a driven link, of a larger group.

Of a dyad one polygon is drawn.  Moments about the inner pin give the part of a turning pair's force that is square to
the bar; what slides on the other body is pushed along the guide by its own pin alone.  The polygon of the whole group,
closed by the directions that are left, gives the rest, and that of one body the force inside (Sun Huan, Mechanical
Principles, ch. 4; Artobolevsky, Theory of mechanisms and machines, ch. 13).  Where a driver acts, the link that is
driven last balances, and links that a driver holds together have a couple or a push between them.

Of a larger group one system is drawn: for each link two projections and the moments about one point, with arms measured
on the mechanism; then the polygon of each link, which closes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from graphkin.construction.forces.cut_free import Chain, CutFree, across, dead_point, end_of, guide_letters
from graphkin.construction.forces.force_sheet import (
    Acting,
    ForceGroup,
    ForceLine,
    ForceVector,
    KnownMoment,
    MomentEquation,
    Way,
)
from graphkin.construction.forces.joints import BalanceForm, opposite
from graphkin.construction.steps import Direction, Part, Term
from graphkin.plane import added_up, cross, dot, unit
from graphkin.scene.symbol import Symbol
from graphkin.structure import Body, Driven, DrivenJoint, Dyad, LargerGroup, Pair

__all__ = ["at_driver", "of_dyad", "of_larger_group"]

SINGULAR = 1e-13
"""Reciprocal condition of a drawn system that tells nothing."""


# -- a body of a group, and what is drawn of the group as it grows -----------------------------------------------------


@dataclass(frozen=True)
class CutBody:
    """A body with its outer pair."""

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
        if not self.outer.turns:
            return self.cut.images.foot(self.outer)
        return self.cut.images.point(self.outer.a, self.outer.point)

    @property
    def symbol(self) -> Symbol:
        """The outer force on the body."""
        if self.outer.turns:
            return self.cut.names.of_pin(self.outer.point, self.outer.a)
        named = self.cut.names.of_slide(self.outer)
        return named if self.outer.a in self.body.links else opposite(named)

    def force(self, force: complex) -> Acting:
        """The outer force (N) on the body."""
        return Acting(self.symbol, self.name, force, self.at)

    def square(self) -> complex:
        """The direction square to the guide of the outer pair."""
        return 1j * self.cut.images.along(self.outer)


@dataclass
class GroupFigure:
    """What is drawn of a group, as it grows; fields as in `ForceGroup`."""

    moments: list[MomentEquation] = field(default_factory=list)
    terms: list[Term] = field(default_factory=list)
    chain: Chain = field(default_factory=list)
    inner: dict[str, tuple[ForceVector, ...]] = field(default_factory=dict)
    couples: list[MomentEquation] = field(default_factory=list)
    lines: list[ForceLine] = field(default_factory=list)

    def group(self, links: tuple[str, ...], kind: str, way: Way = "polygon") -> ForceGroup:
        return ForceGroup(
            links, kind, way, tuple(self.moments), tuple(self.terms), tuple(self.chain), self.inner,
            tuple(self.couples), tuple(self.lines),
        )  # fmt: skip

    def unknown(self, symbol: Symbol, part: Part, written: Direction | None, turned: bool = False) -> None:
        self.terms.append(Term(symbol, False, written is not None, None, written, part, turned))

    def knowns(self, cut: CutFree, links: Sequence[str]) -> None:
        self.terms += [Term(f.symbol, True, True, turned=f.turned) for f in cut.forces_on(links)]

    def line_of_action(self, cut: CutFree, force: Acting, couple: float) -> None:
        """Where a couple (N m) puts the line of action of its force."""
        if force.force:
            along, shift = unit(force.force), couple / abs(force.force)
            self.lines.append(ForceLine(force.symbol, force.at - 1j * along * (shift * cut.images.mm), along, shift))


def _along_guide(slide: Pair) -> Direction:
    return Direction("along", guide_letters(slide))


def _foot_name(slide: Pair) -> str:
    """The letter of the point where a sliding pair's force acts, or the link at whose origin it does."""
    return slide.pin or slide.a


def _slide_found(
    cut: CutFree, side: CutBody, force: Acting, about: complex, letter: str, figure: GroupFigure,
    inside: tuple[str, ...], more: Sequence[Acting] = (), turning: Sequence[KnownMoment] = (),
) -> None:  # fmt: skip
    """The couple of an outer sliding pair, from the moments about a place (mm), and the line of action of its force."""
    slide = side.outer
    found = cut.couple(side.links, about, letter, replace(side.symbol, kind="M"), (force, *more), turning)
    figure.couples.append(found)
    figure.line_of_action(cut, force, found.value)
    sign = 1.0 if slide.a in side.links else -1.0
    cut.set_slide(slide, sign * force.force, sign * found.value, inside)


# -- a dyad ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class OuterParts:
    """An outer force of a dyad before its polygon closes.

    known : its parts of known size, each with its mark, and its direction as it is written
    along : the direction of the part that closes the polygon; 0: any; None: there is no such part
    mark, written : of that part
    """

    known: tuple[tuple[Acting, Part, Direction], ...]
    along: complex | None
    mark: Part = ""
    written: Direction | None = None

    def terms(self, symbol: Symbol) -> list[Term]:
        """The part that closes the polygon, then those of known size."""
        known = [Term(symbol, True, True, None, written, mark) for _, mark, written in self.known]
        if self.along is None:
            return known
        return [Term(symbol, False, self.written is not None, None, self.written, self.mark), *known]


def of_dyad(cut: CutFree, dyad: Dyad, balances: Mapping[str, BalanceForm]) -> ForceGroup:
    """The forces of a dyad: those of its outer pairs, then the force inside, then those between links that drivers
    hold together.

    Parameters
    ----------
    balances : what balances at each driver, by the driver's key

    Raises
    ------
    Unsolvable : "dead point": the lines that close the polygon are parallel
    """
    inside = dyad.members
    cut.load_pins(inside)
    one, two = CutBody(cut, dyad.first, dyad.outer_first), CutBody(cut, dyad.second, dyad.outer_second)
    figure = GroupFigure()
    first, second = _outer_parts(cut, dyad, one, two, figure)
    figure.terms += first.terms(one.symbol)
    figure.knowns(cut, (*one.links, *two.links))
    figure.terms += second.terms(two.symbol)[::-1]

    def lay(parts: OuterParts) -> complex:
        return added_up((cut.lay(chain, force, mark, False) for force, mark, _ in parts.known), 0j)

    chain = figure.chain
    laid = lay(first)
    cut.lay_known(chain, one.links)
    own = list(chain)  # the polygon of the first body, but for the force inside
    cut.lay_known(chain, two.links)
    before = end_of(chain)
    lay(second)
    end, start = end_of(chain), 0j
    if first.along is not None:
        assert second.along is not None
        start = cut.closing(dyad.links, end, second.along, 0j, first.along)
        head = cut.drawn(one.symbol, one.name, one.at, start, 0j, first.mark)
        chain.insert(0, head)
        own.insert(0, head)
    chain.append(cut.drawn(two.symbol, two.name, two.at, end, start, second.mark))
    outer = one.force(laid - start * cut.per_mm), two.force((start - before) * cut.per_mm)
    for side, force in zip((one, two), outer, strict=True):
        if side.outer.turns:
            cut.set_pin(side.outer.point, side.outer.a, force.force)
    inner = _inner_forces(cut, dyad, figure, own, start, one, outer[0])
    for side, force, opposed in zip((one, two), outer, inner, strict=True):
        if side.outer.turns:
            continue
        if dyad.inner.turns:
            at = cut.images.point(*_at_inner_pin(cut, dyad)[0])
            _slide_found(cut, side, force, at, dyad.inner.point, figure, inside)
        else:
            known = figure.couples[-1]
            back = KnownMoment(opposite(known.symbol), opposed.link, -known.value)
            letter = _foot_name(side.outer)
            _slide_found(cut, side, force, side.at, letter, figure, inside, (opposed,), (back,))
    slides = [pair for pair in dyad.pairs if not pair.turns]
    for side, force, opposed in zip((one, two), outer, inner, strict=True):
        if side.body.joints:
            _between_driven(cut, side, (opposed, force), slides, figure, balances)
    cut.done |= set(inside)
    return figure.group(dyad.links, dyad.kind)


def _outer_parts(
    cut: CutFree, dyad: Dyad, one: CutBody, two: CutBody, figure: GroupFigure
) -> tuple[OuterParts, OuterParts]:
    """What is known of both outer forces before the polygon closes."""
    slide = dyad.inner
    if slide.turns:
        hinge = cut.images.point(*_at_inner_pin(cut, dyad)[0])
        return _by_inner_pin(cut, one, hinge, slide.point, figure), _by_inner_pin(cut, two, hinge, slide.point, figure)
    # body one slides on body two: what pushes it along the guide only its pin can hold
    along = cut.images.along(slide)
    held = one.force(along * -cut.projected(cut.forces_on(one.links), along))
    known: tuple[tuple[Acting, Part, Direction], ...] = ((held, "n", _along_guide(slide)),) if held.force else ()
    mark: Part = "t" if held.force else ""
    if not two.outer.turns:
        closing = OuterParts(known, 1j * along, mark, across(slide))
        return closing, OuterParts((), two.square(), "", across(two.outer))
    found = cut.by_moments(
        (*one.links, *two.links), two.at, two.outer.point, one.force(1j * along), "t", (held,)
    )  # fmt: skip
    figure.moments.append(found)
    square = one.force(1j * along * found.value)
    return OuterParts((*known, (square, mark, across(slide))), None), OuterParts((), 0j)


def _by_inner_pin(cut: CutFree, side: CutBody, hinge: complex, letter: str, figure: GroupFigure) -> OuterParts:
    """An outer force by the moments about the inner pin, which lies at ``hinge`` (mm)."""
    if not side.outer.turns:
        return OuterParts((), side.square(), "", across(side.outer))
    bar, along = (side.outer.point, letter), side.at - hinge
    square = 1j * unit(along)
    found = cut.by_moments(side.links, hinge, letter, side.force(square), "t")
    figure.moments.append(found)
    written = Direction("along", bar)
    if not found.value:  # nothing acts on the bar between its ends
        return OuterParts((), along, "", written)
    known = side.force(square * found.value), "t", Direction("square", bar)
    return OuterParts((known,), along, "n", written)  # type: ignore[arg-type]


def _at_inner_pin(cut: CutFree, dyad: Dyad) -> tuple[tuple[str, str], tuple[str, str]]:
    """The links of both bodies at the inner turning pair, each with its point."""
    point, links = dyad.inner.point, cut.names.structure.links
    first, second = (next(n for n in body.links if point in links[n].points) for body in dyad.bodies)
    return (first, point), (second, point)


def _inner_forces(
    cut: CutFree, dyad: Dyad, figure: GroupFigure, own: Chain, start: complex, one: CutBody, outer: Acting
) -> tuple[Acting, Acting]:
    """The force inside closes the polygon of the first body: on it, and on the second; of a sliding pair its couple
    the moments there, too.

    Parameters
    ----------
    own : the polygon of the first body, from ``start`` on (mm)
    outer : the outer force on the first body
    """
    end = own[-1].tip if own else start
    if dyad.inner.turns:
        names = cut.names
        (first, point), (second, _) = _at_inner_pin(cut, dyad)
        at, force = cut.images.point(first, point), (start - end) * cut.per_mm
        symbol = names.of_pin(point, second)
        if second == names.holders[point][0] and len(names.structure.hinges[point]) > 2:
            # the first link at a pin bears the sum of several: the force inside is called as the other link's is
            symbol = opposite(names.of_pin(point, first))
        cut.set_pin(point, first, force)
        cut.set_pin(point, second, -force)
        on_first, on_second = Acting(opposite(symbol), first, force, at), Acting(symbol, second, -force, at)
        figure.inner[first] = (*own, cut.drawn(on_first.symbol, first, at, end, start))
        return on_first, on_second
    slide = dyad.inner
    square = 1j * cut.images.along(slide)
    force = square * dot(start - end, square) * cut.per_mm
    at, symbol = cut.images.foot(slide), cut.names.of_slide(slide)
    mine = slide.a in one.links
    on_first = Acting(symbol if mine else opposite(symbol), slide.a if mine else slide.b, force, at)
    on_second = Acting(opposite(on_first.symbol), slide.b if mine else slide.a, -force, at)
    figure.inner[on_first.link] = (*own, cut.drawn(on_first.symbol, on_first.link, at, end, start))
    turned = replace(on_first.symbol, kind="M")
    found = cut.couple(one.links, one.at, one.outer.point, turned, (on_first, outer))
    figure.couples.append(found)
    figure.line_of_action(cut, on_first, found.value)
    sign = 1.0 if mine else -1.0
    cut.set_slide(slide, sign * force, sign * found.value, dyad.members)
    return on_first, on_second


# -- where drivers act -------------------------------------------------------------------------------------------------


def _between_driven(
    cut: CutFree, side: CutBody, found: tuple[Acting, ...], slides: Sequence[Pair], figure: GroupFigure,
    balances: Mapping[str, BalanceForm],
) -> None:  # fmt: skip
    """The forces between links of a body that drivers hold together, from the outermost link on, with what balances
    there.

    Parameters
    ----------
    found : the forces of the dyad's pairs on this body
    slides : the sliding pairs of the dyad, whose couples act on this body too
    """
    extra: dict[str, list[Acting]] = {name: [] for name in side.links}
    turning: dict[str, list[KnownMoment]] = {name: [] for name in side.links}
    for force in found:
        extra[force.link].append(force)
    for slide in slides:
        symbol, couple = cut.names.of_slide(slide, "M"), cut.slides[slide.key][1]
        for moment in (KnownMoment(symbol, slide.a, couple), KnownMoment(opposite(symbol), slide.b, -couple)):
            if couple and moment.link in side.links:
                turning[moment.link].append(moment)
    for joint in reversed(side.body.joints):
        balance = balances[joint.driver.key]
        forces, moments = _at_driven_joint(cut, joint, balance, extra[joint.b], turning[joint.b], figure, side.links)
        extra[joint.a] += forces
        turning[joint.a].append(moments)


def _at_driven_joint(
    cut: CutFree, joint: DrivenJoint, balance: BalanceForm, extra: Sequence[Acting], turning: Sequence[KnownMoment],
    figure: GroupFigure, inside: tuple[str, ...],
) -> tuple[list[Acting], KnownMoment]:  # fmt: skip
    """The force and the moment of a driven pair on the link that hangs on it; returns what acts on the other link.

    Parameters
    ----------
    extra, turning : forces and moments on the link, besides what is known from outside
    """
    leaf, other, pair = joint.b, joint.a, joint.pair
    chain: Chain = []
    for known in (*cut.forces_on((leaf,)), *extra):
        cut.lay(chain, known)
    end = end_of(chain)
    force = -end * cut.per_mm
    if pair.turns:
        at = cut.images.point(leaf, pair.point)
        symbol = cut.names.of_pin(pair.point, leaf)
        if leaf == cut.names.holders.get(pair.point, ("",))[0]:
            symbol = cut.names.between(other, leaf, pair.point)
        mine = balance.link == leaf
        equation = cut.couple((leaf,), at, pair.point, balance.symbol, extra, turning)
        figure.couples.append(equation)
        cut.balances[balance.symbol] = equation.value if mine else -equation.value
        cut.set_pin(pair.point, leaf, force)
        cut.set_pin(pair.point, other, -force)
        figure.inner[leaf] = (*chain, cut.drawn(symbol, leaf, at, end, 0j))
        back = KnownMoment(balance.symbol, other, -equation.value, mine)
        return [Acting(opposite(symbol), other, -force, at)], back
    at, along = cut.images.foot(pair), cut.images.along(pair)
    mine = pair.a == leaf
    symbol = cut.names.of_slide(pair) if mine else opposite(cut.names.of_slide(pair))
    push, square = along * dot(force, along), 1j * along * dot(force, 1j * along)
    on, driving = Acting(symbol, leaf, square, at), Acting(balance.symbol, leaf, push, at, not mine)
    corner = end + push / cut.per_mm
    figure.inner[leaf] = (
        *chain, replace(cut.drawn(balance.symbol, leaf, at, end, corner), turned=not mine),
        cut.drawn(symbol, leaf, at, corner, 0j),
    )  # fmt: skip
    equation = cut.couple((leaf,), at, _foot_name(pair), replace(symbol, kind="M"), (*extra, on, driving), turning)
    figure.couples.append(equation)
    figure.line_of_action(cut, on, equation.value)
    sign = 1.0 if mine else -1.0
    cut.balances[balance.symbol] = sign * push
    cut.set_slide(pair, sign * square, sign * equation.value, inside)
    forces = [Acting(opposite(symbol), other, -square, at), Acting(balance.symbol, other, -push, at, mine)]
    return forces, KnownMoment(opposite(equation.symbol), other, -equation.value)


def at_driver(cut: CutFree, element: Driven, balance: BalanceForm) -> ForceGroup:
    """The forces of a link that is driven from links still to come, and what balances it there.

    Raises
    ------
    Unsolvable : "dead point": the balance does no work
    """
    link, pair = element.link, element.pair
    cut.load_pins((link,))
    figure, side = GroupFigure(), CutBody(cut, Body((link,)), pair)
    chain = figure.chain
    if pair.turns:
        _at_crank(cut, side, balance, figure)
    else:
        balancing, square = _balancing(cut, balance, link), side.square()
        figure.unknown(balancing.symbol, "", _along_guide(pair), balancing.turned)
        figure.knowns(cut, (link,))
        figure.unknown(side.symbol, "", across(pair))
        cut.lay_known(chain, (link,))
        end = end_of(chain)
        start = cut.closing((link,), end, square, 0j, balancing.force)
        push, on = replace(balancing, force=-start * cut.per_mm), side.force((start - end) * cut.per_mm)
        cut.balances[balance.symbol] = -push.force if push.turned else push.force
        _slide_found(cut, side, on, side.at, _foot_name(pair), figure, (link,), (push,))
        chain.insert(0, replace(cut.drawn(balance.symbol, link, push.at, start, 0j), turned=push.turned))
        chain.append(cut.drawn(on.symbol, link, on.at, end, start))
        other = balance.other if balance.link == link else balance.link
        if other != cut.names.structure.scene.frame.name:  # what drives a link from another one loads that one
            cut.push(Acting(push.symbol, other, -push.force, push.at, not push.turned))
    cut.done.add(link)
    return figure.group((link,) if link not in cut.names.blocks else (), "driver", "driver")


def _balancing(cut: CutFree, balance: BalanceForm, link: str) -> Acting:
    """A balancing force of unit size on a link."""
    along, at = cut.images.of_balance(balance)
    mine = balance.link == link
    return Acting(balance.symbol, link, along if mine else -along, at, not mine)


def _at_crank(cut: CutFree, side: CutBody, balance: BalanceForm, figure: GroupFigure) -> None:
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
        figure.terms.append(Term(balance.symbol, True, True, turned=push.turned))
        cut.balances[balance.symbol] = cut.lay(chain, replace(push, force=push.force * equation.value), "", False)
    figure.knowns(cut, (link,))
    figure.unknown(side.symbol, "", None)
    cut.lay_known(chain, (link,))
    end = end_of(chain)
    cut.set_pin(side.outer.point, side.outer.a, -end * cut.per_mm)
    chain.append(cut.drawn(side.symbol, link, side.at, end, 0j))


# -- a larger group ----------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class UnknownForce:
    """A force along ``along`` at a place (mm), or a couple (``along`` 0), on link ``on``, its opposite on ``off``."""

    symbol: Symbol
    on: str
    off: str
    at: complex
    along: complex
    point: str = ""
    slide: Pair | None = None

    @property
    def sides(self) -> tuple[tuple[str, float], tuple[str, float]]:
        """Both links, each with the sign with which it acts there."""
        return (self.on, 1.0), (self.off, -1.0)


def of_larger_group(cut: CutFree, group: LargerGroup, balances: Sequence[BalanceForm]) -> ForceGroup:
    """The forces of a group larger than a dyad, or of one that a balance holds otherwise than by a driven link.

    Raises
    ------
    Unsolvable : "dead point": the drawn system tells nothing
    """
    cut.load_pins(group.members)
    unknowns = _unknown_forces(cut, group.members, balances)
    values = _solved(cut, group.members, unknowns)
    figure = _carried_over(cut, group.members, unknowns, values)
    cut.done |= set(group.members)
    return figure.group(group.links, group.kind, "drawn system")


def _unknown_forces(cut: CutFree, members: Sequence[str], balances: Sequence[BalanceForm]) -> list[UnknownForce]:
    found, inside, structure = [], set(members), cut.names.structure
    for point, holders in structure.hinges.items():
        mine = [n for n in holders if n in inside]
        if not mine:
            continue
        held = any(n not in inside and n not in cut.done for n in holders)
        at = cut.images.point(mine[0], point)
        for link in mine if held else mine[1:]:
            symbol, off = cut.names.of_pin(point, link), "" if held else mine[0]
            found += [UnknownForce(symbol, link, off, at, way, point) for way in (1 + 0j, 1j)]
    for slide in structure.slides:
        if slide.key not in cut.slides and {slide.a, slide.b} & inside:
            at, square = cut.images.foot(slide), 1j * cut.images.along(slide)
            found += [UnknownForce(cut.names.of_slide(slide, kind), slide.a, slide.b, at, along, slide=slide)
                      for kind, along in (("F", square), ("M", 0j))]  # fmt: skip
    for balance in balances:
        along, at = (0j, 0j) if balance.is_moment else cut.images.of_balance(balance)
        found.append(UnknownForce(balance.symbol, balance.link, balance.other, at, along))
    return found


def _solved(cut: CutFree, members: Sequence[str], unknowns: Sequence[UnknownForce]) -> list[float]:
    """Sizes of the unknowns, N and N m."""
    mm, size = cut.images.mm, cut.images.sheet.scene.size
    row = {name: 3 * i for i, name in enumerate(members)}
    about = {name: cut.images.sheet.poses[name].origin for name in members}
    left, right = np.zeros((3 * len(members), len(unknowns))), np.zeros(3 * len(members))
    for k, unknown in enumerate(unknowns):
        for link, sign in unknown.sides:
            if link not in row:
                continue
            i = row[link]
            if unknown.along == 0:
                left[i + 2, k] += sign
                continue
            arm = cross(unknown.at - about[link], unknown.along) / mm / size
            left[i : i + 3, k] += [sign * unknown.along.real, sign * unknown.along.imag, sign * arm]
    for link, i in row.items():
        for force in cut.forces_on((link,)):
            arm = cross(force.at - about[link], force.force) / mm / size
            right[i : i + 3] -= [force.force.real, force.force.imag, arm]
        right[i + 2] -= added_up(m.moment for m in cut.moments_on((link,))) / size
    if left.shape[0] != left.shape[1] or not np.isfinite(left).all() or np.linalg.cond(left) > 1.0 / SINGULAR:
        raise dead_point(members)
    found = np.linalg.solve(left, right)
    found += np.linalg.solve(left, right - left @ found)  # a second pass takes back the rounding of the first
    return [float(v * (size if u.along == 0 else 1.0)) for v, u in zip(found, unknowns, strict=True)]


def _carried_over(
    cut: CutFree, members: Sequence[str], unknowns: Sequence[UnknownForce], values: Sequence[float]
) -> GroupFigure:
    """Put what was found (N, N m) to the pairs, and draw the polygon of each link."""
    forces: dict[tuple[Symbol, str, str], complex] = {}
    places: dict[tuple[Symbol, str, str], UnknownForce] = {}
    couples: dict[str, float] = {}
    within = (*members, cut.names.structure.scene.frame.name)
    for unknown, value in zip(unknowns, values, strict=True):
        if unknown.along != 0:
            key = unknown.symbol, unknown.on, unknown.off
            forces[key] = forces.get(key, 0j) + value * unknown.along
            places[key] = unknown
        elif unknown.slide is not None:
            couples[unknown.slide.key] = value
        else:
            cut.balances[unknown.symbol] = value
            for link, sign in unknown.sides:
                if link not in within:  # what drives a link of the group from one still to come loads that
                    cut.turn(KnownMoment(unknown.symbol, link, sign * value, sign < 0))
    polygons: dict[str, Chain] = {name: [] for name in members}
    figure = GroupFigure()
    for name in members:
        cut.lay_known(polygons[name], (name,))
        figure.knowns(cut, (name,))
    for key, force in forces.items():
        unknown = places[key]
        symbol, slide = unknown.symbol, unknown.slide
        if unknown.point:
            cut.set_pin(unknown.point, unknown.on, force)
            if unknown.off:
                cut.set_pin(unknown.point, unknown.off, -force)
        elif slide is not None:
            cut.set_slide(slide, force, couples[slide.key], members)
            figure.line_of_action(cut, Acting(symbol, unknown.on, force, unknown.at), couples[slide.key])
        else:
            cut.balances[symbol] = force
            for link, sign in unknown.sides:
                if link not in within:
                    cut.push(Acting(symbol, link, sign * force, unknown.at, sign < 0))
        if unknown.off not in members:  # a force from outside the group, whose sum closes
            figure.unknown(symbol, "", None if slide is None else across(slide))
        for link, sign in unknown.sides:
            if link in polygons:
                named = opposite(symbol) if sign < 0 and symbol.other else symbol
                acting = Acting(named, link, sign * force, unknown.at, sign < 0 and not symbol.other)
                cut.lay(polygons[link], acting, "", False)
    figure.inner |= {name: tuple(chain) for name, chain in polygons.items() if name not in cut.names.blocks}
    return figure
