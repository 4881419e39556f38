"""The forces of a group cut free: of a dyad, of a driven link, of a larger group.

Of a dyad one polygon is drawn.  Moments about the inner pin give the part of a turning pair's force that is square to
the bar; what slides on the other body is pushed along the guide by its own pin alone.  The polygon of the whole group,
closed by the directions that are left, gives the rest, and that of one body the force inside (Sun Huan, Mechanical
Principles, ch. 4; Artobolevsky, Theory of mechanisms and machines, ch. 13).  Where a driver acts, the link that is
driven last balances, and links that a driver holds together have a couple or a push between them.

Of a larger group one system is drawn: for each link two projections and the moments about one point, with arms measured
on the mechanism; then the polygon of each link, which closes.

Forces are complex numbers in N while they are found; each is taken off the polygon in which it was drawn.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from graphkin.construction.forces.force_sheet import ForceGroup, ForceVector, MomentEquation, MomentTerm
from graphkin.construction.forces.position import DrawnPosition
from graphkin.construction.instruments import Instrument
from graphkin.construction.steps import Direction, Part
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import added_up, cross, cross_lines, dot, unit
from graphkin.scene.symbol import Symbol
from graphkin.structure import Driven, DrivenJoint, Dyad, LargerGroup, Pair
from graphkin.words import Phrase

NORMAL, TANGENT = "n-n", "t-t"
"""The common normal and tangent of what touches, by name as a guide."""
PARALLEL = 1e-12
SINGULAR = 1e-13
"""Reciprocal condition of a drawn system that tells nothing."""


def _dead_point(links: Sequence[str]) -> Unsolvable:
    """What is said where the lines that should close a polygon are parallel."""
    return Unsolvable("dead point", Problem(Phrase("links", links=", ".join(links)),
                                            "the balance does no work in this position or",
                                            "move the driver off this position"))


Chain = list[ForceVector]
"""Vectors of a polygon laid head to tail, from the origin on."""


def _end_of(chain: Chain) -> complex:
    """Where the next vector of a polygon begins (mm)."""
    return chain[-1].tip if chain else 0j


@dataclass
class CutFree:
    """What is known of all links while their forces are found; the last group comes first.

    ``acting`` are the known forces and couples by link, ``pins`` the forces of pins on links, ``slides`` force and
    couple of each guiding link on its sliding one, ``done`` the links whose forces are known.
    """

    drawn: DrawnPosition
    hand: Instrument
    per_mm: float
    acting: defaultdict[str, list[ForceVector]] = field(default_factory=lambda: defaultdict(list))
    pins: defaultdict[tuple[str, str], complex] = field(default_factory=lambda: defaultdict(complex))
    slides: dict[str, tuple[complex, float]] = field(default_factory=dict)
    balances: dict[Symbol, complex | float] = field(default_factory=dict)
    done: set[str] = field(default_factory=set)

    # -- what acts -----------------------------------------------------------------------------------------------------

    def push(self, *acting: ForceVector) -> None:
        """Forces and couples act on links; the frame bears what comes."""
        for one in acting:
            if one.link != self.drawn.structure.scene.frame.name:
                self.acting[one.link].append(one)

    def on(self, links: Iterable[str]) -> list[ForceVector]:
        """What is known to act on some links, of no size left out."""
        return [one for link in links for one in self.acting[link] if one.force or one.moment]

    def load_pins(self, members: Iterable[str]) -> None:
        """Links found before hang on pins of these: what they do there acts on the first that has the pin."""
        inside = set(members)
        for point, holders in self.drawn.structure.hinges.items():
            mine = [n for n in holders if n in inside]
            others = [n for n in holders if n not in inside]
            if not mine or not others or any(n not in self.done for n in others):
                continue
            carrier, at = mine[0], self.drawn.point(mine[0], point)
            hung = {self.drawn.of_pin(point, other).opposite: -self.pins[point, other] for other in others}
            if len(holders) > 2 and carrier != self.drawn.holders[point][0]:
                hung = {Symbol("F", link=point, other=carrier): added_up(hung.values(), 0j)}
            for symbol, force in hung.items():
                self.push(ForceVector(symbol, carrier, force, at))
                self.pins[point, carrier] += force

    def at_pair(self, pair: Pair, links: Sequence[str]) -> ForceVector:
        """The force of a pair on that of some links which it holds, of no size yet."""
        link, off = (pair.a, pair.b) if pair.a in links else (pair.b, pair.a)
        if pair.turns:
            symbol, at = self.drawn.of_pin(pair.point, pair.a), self.drawn.point(pair.a, pair.point)
        else:
            symbol, at = self.drawn.of_slide(pair), self.drawn.foot(pair)
            symbol = symbol if link == pair.a else symbol.opposite
        return ForceVector(symbol, link, at=at, by="closing", off=off)

    def set_slide(self, slide: Pair, force: ForceVector, couple: float, inside: Iterable[str]) -> None:
        """The force of a sliding pair on one of its links, with its couple; both load the other link, if that comes
        later."""
        forward, moment = force.on(slide.a), couple if force.link == slide.a else -couple
        self.slides[slide.key] = forward.force, moment
        turned = ForceVector(self.drawn.of_slide(slide, "M"), slide.a, moment=moment, off=slide.b)
        for one in (replace(forward, by="given", direction=None, part=""), turned):
            self.push(*(acting for acting in (one, one.back) if acting.link not in inside))

    # -- moments -------------------------------------------------------------------------------------------------------

    @property
    def size(self) -> float:
        """The mechanism, in mm on paper."""
        return self.drawn.sheet.scene.size * self.drawn.mm

    def term(self, one: ForceVector, about: complex) -> MomentTerm:
        """The moment of a force about a place, its arm measured on the mechanism; a couple is its own."""
        if not one.force:
            return MomentTerm(one.symbol, 0j, None, one.moment, turned=one.turned)
        mm = cross(one.at - about, unit(one.force))
        arm = self.hand.read_signed(mm) if abs(mm) >= 1e-12 * self.size else 0.0
        moment = abs(one.force) * arm / self.drawn.mm
        return MomentTerm(one.symbol, one.force, arm, moment, one.at, about, turned=one.turned)

    def terms(self, acting: Iterable[ForceVector], about: complex) -> tuple[MomentTerm, ...]:
        """The moments of forces, then couples."""
        return tuple(self.term(one, about) for one in sorted(acting, key=lambda one: not one.force))

    def by_moments(
        self, links: Sequence[str], about: complex, letter: str, unknown: ForceVector, more: Sequence[ForceVector] = ()
    ) -> MomentEquation:
        """The size of a force of known line from the moments of all that acts on some links.

        Parameters
        ----------
        about, letter : the place of the moments, and its name
        unknown : the force, of size 1
        more : forces found already that are not yet among the known
        """
        sought = self.term(unknown, about)
        assert sought.arm is not None
        if abs(sought.arm) <= PARALLEL * self.size:
            raise _dead_point(links)
        terms = self.terms([*self.on(links), *(m for m in more if m.force)], about)
        value = -added_up(t.moment for t in terms) / (sought.arm / self.drawn.mm)
        return MomentEquation(tuple(links), letter, terms, replace(sought, part=unknown.part), value)

    def couple(
        self, links: Sequence[str], about: complex, letter: str, symbol: Symbol, more: Sequence[ForceVector] = ()
    ) -> MomentEquation:
        """The couple that is left of the moments of all that acts on some links."""
        terms = self.terms([*self.on(links), *(m for m in more if m.force or m.moment)], about)
        value = -added_up(t.moment for t in terms)
        # what is left of terms that cancel is rounding
        if abs(value) <= 1e-13 * added_up(abs(t.moment) for t in terms):
            value = 0.0
        return MomentEquation(tuple(links), letter, terms, MomentTerm(symbol, 0j, None, 1.0), value)

    # -- polygons ------------------------------------------------------------------------------------------------------

    def lay(self, chain: Chain, *forces: ForceVector) -> complex:
        """Lay off forces head to tail; what they come to then in N."""
        begin = _end_of(chain)
        for one in forces:
            tail = tip = _end_of(chain)
            mm = abs(one.force) / self.per_mm
            if mm > 0.0:
                tip = self.hand.point(tail + self.hand.direction(unit(one.force)) * self.hand.length(mm))
            chain.append(one.between(tail, tip))
        return (_end_of(chain) - begin) * self.per_mm

    def lay_known(self, chain: Chain, links: Iterable[str]) -> None:
        """Lay off the known forces on some links."""
        self.lay(chain, *(one for one in self.on(links) if one.force))

    def closed(
        self, links: Sequence[str], chain: Chain, last: ForceVector, first: ForceVector | None = None
    ) -> complex:
        """Close a polygon: by one force, or by two of known directions, the one before its first vector and the other
        behind its last; returns where they meet (mm).

        Raises
        ------
        Unsolvable : "dead point": the two directions are parallel
        """
        end, corner = _end_of(chain), 0j
        if first is not None:
            d, e = self.hand.direction(last.force), self.hand.direction(first.force)
            met = cross_lines(end, d, 0j, e) if abs(cross(d, e)) >= PARALLEL else None
            if met is None:
                raise _dead_point(links)
            corner = self.hand.point(met)
            chain.insert(0, first.between(corner, 0j))
        chain.append(last.between(end, corner))
        return corner


def _across(pair: Pair) -> Direction:
    """The direction of a sliding pair's force: square to the guide; of what touches along the normal, or the tangent of
    pitch circles."""
    other = {NORMAL: TANGENT, TANGENT: NORMAL}.get(pair.guide.name.rstrip("'"))
    return Direction("along", (other,)) if other else Direction("square", _along(pair).names)


def _along(slide: Pair) -> Direction:
    """The direction of a guide, as it is written."""
    return Direction("along", (slide.guide.name or f"x{slide.b}",))


def _foot_name(slide: Pair) -> str:
    """The letter of the point where a sliding pair's force acts, or the link at whose origin it does."""
    return slide.pin or slide.a


def _slide_found(
    cut: CutFree, group: ForceGroup, links: Sequence[str], slide: Pair, force: ForceVector, about: complex, letter: str,
    acting: Sequence[ForceVector], inside: Sequence[str],
) -> MomentEquation:  # fmt: skip
    """The couple of a sliding pair on links, from the moments about a place (mm), and where it puts the line of action
    of the pair's force.

    Parameters
    ----------
    acting : forces and couples found already that are not yet among the known, the pair's own among them
    inside : links that do not come later
    """
    found = cut.couple(links, about, letter, replace(force.symbol, kind="M"), acting)
    group.couples.append(found)
    _shift_line(cut, group, force, found.value)
    cut.set_slide(slide, force, found.value, inside)
    return found


def _shift_line(cut: CutFree, group: ForceGroup, force: ForceVector, couple: float) -> None:
    """Where a couple (N m) puts the line of action of its force."""
    if force.force:
        along, shift = unit(force.force), couple / abs(force.force)
        group.lines[force.symbol] = force.at - 1j * along * (shift * cut.drawn.mm), shift


# -- a dyad ------------------------------------------------------------------------------------------------------------


def of_dyad(cut: CutFree, dyad: Dyad, balances: Mapping[str, ForceVector]) -> ForceGroup:
    """The forces of a dyad: those of its outer pairs, then the force inside, then those between links that drivers
    hold together.

    Parameters
    ----------
    balances : what balances at each driver, by the driver's key

    Raises
    ------
    Unsolvable : "dead point": the lines that close the polygon are parallel
    """
    cut.load_pins(dyad.members)
    group, pairs = ForceGroup(dyad.links, dyad.kind), (dyad.outer_first, dyad.outer_second)
    one, two = (cut.at_pair(pair, body.links) for pair, body in zip(pairs, dyad.bodies, strict=True))
    (first, head), (second, tail) = _outer_parts(cut, dyad, one, two, group)
    chain = group.polygon
    laid = cut.lay(chain, *first)
    cut.lay_known(chain, dyad.first.links)
    own = list(chain)  # the polygon of the first body, but for the force inside
    cut.lay_known(chain, dyad.second.links)
    before = _end_of(chain)
    cut.lay(chain, *second)
    corner = cut.closed(dyad.links, chain, tail, head)
    if head is not None:
        own.insert(0, chain[0])
    outer = replace(one, force=laid - corner * cut.per_mm), replace(two, force=(corner - before) * cut.per_mm)
    for pair, force in zip(pairs, outer, strict=True):
        if pair.turns:
            cut.pins[pair.point, pair.a] += force.force
    inner = _inner_forces(cut, dyad, group, own, corner, outer[0])
    for pair, body, force, opposed in zip(pairs, dyad.bodies, outer, inner, strict=True):
        if pair.turns:
            continue
        at, letter, acting = force.at, _foot_name(pair), [force, opposed]
        if dyad.inner.turns:
            at, letter, acting = opposed.at, dyad.inner.point, [force]
        else:
            known = group.couples[-1]
            couple = ForceVector(known.unknown.symbol, inner[0].link, moment=known.value, off=opposed.link)
            acting.append(couple.back)
        _slide_found(cut, group, body.links, pair, force, at, letter, acting, dyad.members)
    for body, force, opposed in zip(dyad.bodies, outer, inner, strict=True):
        acting = [opposed, force]
        for slide in (pair for pair in dyad.pairs if not pair.turns):
            turned = cut.slides[slide.key][1]
            couple = ForceVector(cut.drawn.of_slide(slide, "M"), slide.a, moment=turned, off=slide.b)
            acting += [one for one in (couple, couple.back) if one.link in body.links]
        # links that drivers hold together, from the outermost on
        for joint in reversed(body.joints):
            on_leaf = [one for one in acting if one.link == joint.b]
            acting += _at_driven_joint(cut, group, joint, balances[joint.driver.key], on_leaf, body.links)
    cut.done |= set(dyad.members)
    return group


OuterParts = tuple[list[ForceVector], ForceVector]
"""The parts of an outer force that are of known size, and that which closes the polygon, of size 1."""


def _outer_parts(
    cut: CutFree, dyad: Dyad, one: ForceVector, two: ForceVector, group: ForceGroup
) -> tuple[tuple[list[ForceVector], ForceVector | None], OuterParts]:
    """What is known of both outer forces before the polygon closes; None where nothing of the first is left open."""
    slide, outer = dyad.inner, dyad.outer_second
    if slide.turns:
        return (_by_inner_pin(cut, dyad.first.links, dyad.outer_first, one, slide, group),
                _by_inner_pin(cut, dyad.second.links, outer, two, slide, group))  # fmt: skip
    # body one slides on body two: what pushes it along the guide only its pin can hold
    along = cut.drawn.along(slide)
    laid: Chain = []
    cut.lay_known(laid, dyad.first.links)
    push = along * -dot(_end_of(laid), along) * cut.per_mm
    known = [replace(one, force=push, part="n", by="moments", direction=_along(slide))] if push else []
    mark: Part = "t" if known else ""
    square = replace(one, force=1j * along, part=mark, direction=_across(slide))
    if not outer.turns:
        return (known, square), ([], replace(two, force=1j * cut.drawn.along(outer), direction=_across(outer)))
    found = cut.by_moments(
        (*dyad.first.links, *dyad.second.links), two.at, outer.point, replace(square, part="t"), known
    )  # fmt: skip
    group.moments.append(found)
    return ([*known, replace(square, force=square.force * found.value, by="moments")], None), ([], two)


def _by_inner_pin(
    cut: CutFree, links: Sequence[str], outer: Pair, force: ForceVector, inner: Pair, group: ForceGroup
) -> OuterParts:
    """An outer force by the moments about the inner pin."""
    if not outer.turns:
        return [], replace(force, force=1j * cut.drawn.along(outer), direction=_across(outer))
    hinge = cut.drawn.point(inner.a, inner.point)
    bar, along = (outer.point, inner.point), force.at - hinge
    square = replace(force, force=1j * unit(along), part="t", direction=Direction("square", bar))
    found = cut.by_moments(links, hinge, inner.point, square)
    group.moments.append(found)
    closing = replace(force, force=along, direction=Direction("along", bar))
    if not found.value:  # nothing acts on the bar between its ends
        return [], closing
    return [replace(square, force=square.force * found.value, by="moments")], replace(closing, part="n")


def _inner_forces(
    cut: CutFree, dyad: Dyad, group: ForceGroup, own: Chain, corner: complex, outer: ForceVector
) -> tuple[ForceVector, ForceVector]:
    """The force inside closes the polygon of the first body: on it, and on the second; of a sliding pair its couple
    the moments there, too.

    Parameters
    ----------
    own : the polygon of the first body, from ``corner`` on (mm)
    outer : the outer force on the first body
    """
    end, slide, links = own[-1].tip if own else corner, dyad.inner, dyad.first.links
    force = (corner - end) * cut.per_mm
    if slide.turns:
        names, point, known = cut.drawn, slide.point, cut.drawn.structure.links
        first, second = (next(n for n in body.links if point in known[n].points) for body in dyad.bodies)
        symbol = names.of_pin(point, second).opposite
        if second == names.holders[point][0] and len(names.structure.hinges[point]) > 2:
            # the first link at a pin bears the sum of several: the force inside is called as the other link's is
            symbol = names.of_pin(point, first)
        cut.pins[point, first] += force
        cut.pins[point, second] -= force
        on_first = ForceVector(symbol, first, force, cut.drawn.point(first, point), by="closing", off=second)
        group.inner[first] = [*own, on_first.between(end, corner)]
        return on_first, on_first.back
    square = 1j * cut.drawn.along(slide)
    on_first = cut.at_pair(slide, links)
    on_first = replace(on_first, force=square * dot(force, square))
    group.inner[on_first.link] = [*own, on_first.between(end, corner)]
    _slide_found(
        cut, group, links, slide, on_first, outer.at, dyad.outer_first.point, (on_first, outer), dyad.members
    )  # fmt: skip
    return on_first, on_first.back


# -- where drivers act -------------------------------------------------------------------------------------------------


def _at_driven_joint(
    cut: CutFree, group: ForceGroup, joint: DrivenJoint, balance: ForceVector, extra: Sequence[ForceVector],
    inside: tuple[str, ...],
) -> list[ForceVector]:  # fmt: skip
    """The force and the moment of a driven pair on the link that hangs on it; returns what acts on the other link.

    Parameters
    ----------
    extra : forces and couples on the link, besides what is known from outside
    """
    leaf, other, pair = joint.b, joint.a, joint.pair
    chain: Chain = []
    cut.lay_known(chain, (leaf,))
    cut.lay(chain, *(replace(one, by="given") for one in extra if one.symbol.is_vector))
    end, push = _end_of(chain), balance.on(leaf)
    force, sign = -end * cut.per_mm, 1.0 if push is balance else -1.0
    if pair.turns:
        symbol = cut.drawn.of_pin(pair.point, leaf)
        if leaf == cut.drawn.holders.get(pair.point, ("",))[0]:
            symbol = cut.drawn.between(other, leaf, pair.point)
        on = ForceVector(symbol, leaf, force, cut.drawn.point(leaf, pair.point), by="closing", off=other)
        equation = cut.couple((leaf,), on.at, pair.point, balance.symbol, extra)
        group.couples.append(equation)
        cut.balances[balance.symbol] = sign * equation.value
        cut.pins[pair.point, leaf] += force
        cut.pins[pair.point, other] -= force
        group.inner[leaf] = [*chain, on.between(end, 0j)]
        return [on.back, replace(push, moment=equation.value).back]
    along = cut.drawn.along(pair)
    on = cut.at_pair(pair, (leaf,))
    on = replace(on, force=1j * along * dot(force, 1j * along))
    push = replace(push, at=on.at, force=along * dot(force, along), by="closing")
    corner = end + push.force / cut.per_mm
    group.inner[leaf] = [*chain, push.between(end, corner), on.between(corner, 0j)]
    cut.balances[balance.symbol] = sign * push.force
    couple = _slide_found(
        cut, group, (leaf,), pair, on, on.at, _foot_name(pair), (*extra, on, push), inside
    )  # fmt: skip
    turned = ForceVector(couple.unknown.symbol, leaf, moment=couple.value, off=other)
    return [on.back, push.back, turned.back]


def at_driver(cut: CutFree, element: Driven, balance: ForceVector) -> ForceGroup:
    """The forces of a link that is driven from links still to come, and what balances it there.

    Raises
    ------
    Unsolvable : "dead point": the balance does no work
    """
    link, pair = element.link, element.pair
    cut.load_pins((link,))
    group = ForceGroup((link,) if link not in cut.drawn.blocks else (), "driver", "driver")
    chain, on = group.polygon, cut.at_pair(pair, (link,))
    push = replace(balance.on(link), by="closing")
    if pair.turns:
        if balance.moment:
            equation = cut.couple((link,), on.at, pair.point, balance.symbol)
            group.couples.append(equation)
            push = replace(push, moment=equation.value)
        else:
            equation = cut.by_moments((link,), on.at, pair.point, push)
            group.moments.append(equation)
            push = replace(push, by="moments", force=push.force * equation.value)
            push = replace(push, force=cut.lay(chain, push))
        cut.lay_known(chain, (link,))
        cut.pins[pair.point, pair.a] -= _end_of(chain) * cut.per_mm
        cut.closed((link,), chain, on)
    else:
        on, push = (replace(on, force=1j * cut.drawn.along(pair), direction=_across(pair)),
                    replace(push, direction=_along(pair)))  # fmt: skip
        cut.lay_known(chain, (link,))
        end = _end_of(chain)
        corner = cut.closed((link,), chain, on, push)
        on, push = replace(on, force=(corner - end) * cut.per_mm), replace(push, force=-corner * cut.per_mm)
        _slide_found(cut, group, (link,), pair, on, on.at, _foot_name(pair), (on, push), (link,))
    whole = push.moment if balance.moment else push.force
    cut.balances[balance.symbol] = whole if link == balance.link else -whole
    # what drives a link from another one loads that one
    cut.push(replace(push.back, by="given", direction=None))
    cut.done.add(link)
    return group


# -- a larger group ----------------------------------------------------------------------------------------------------


Unknown = tuple[ForceVector, str, Pair | None]
"""A force along the direction of a vector, or a couple where that has none, on its link, its opposite on the other; and
the point of its pin, or its sliding pair."""


def of_larger_group(cut: CutFree, group: LargerGroup, balances: Sequence[ForceVector]) -> ForceGroup:
    """The forces of a group larger than a dyad, or of one that a balance holds otherwise than by a driven link.

    Raises
    ------
    Unsolvable : "dead point": the drawn system tells nothing
    """
    cut.load_pins(group.members)
    unknowns = _unknown_forces(cut, group.members, balances)
    values = _solved(cut, group.members, unknowns)
    made = ForceGroup(group.links, group.kind, "drawn system")
    _carry_over(cut, made, group.members, unknowns, values)
    cut.done |= set(group.members)
    return made


def _unknown_forces(cut: CutFree, members: Sequence[str], balances: Sequence[ForceVector]) -> list[Unknown]:
    found, inside, structure = list[Unknown](), set(members), cut.drawn.structure
    for point, holders in structure.hinges.items():
        mine = [n for n in holders if n in inside]
        if not mine:
            continue
        held = any(n not in inside and n not in cut.done for n in holders)
        at, off = cut.drawn.point(mine[0], point), "" if held else mine[0]
        for link in mine if held else mine[1:]:
            one = ForceVector(cut.drawn.of_pin(point, link), link, at=at, off=off)
            found += [(replace(one, force=along), point, None) for along in (1 + 0j, 1j)]
    for slide in structure.slides:
        if slide.key not in cut.slides and {slide.a, slide.b} & inside:
            at, square = cut.drawn.foot(slide), 1j * cut.drawn.along(slide)
            found += [(ForceVector(cut.drawn.of_slide(slide, kind), slide.a, along, at, off=slide.b), "", slide)
                      for kind, along in (("F", square), ("M", 0j))]  # fmt: skip
    return found + [(balance, "", None) for balance in balances]


def _solved(cut: CutFree, members: Sequence[str], unknowns: Sequence[Unknown]) -> list[float]:
    """Sizes of the unknowns, N and N m."""
    mm, size = cut.drawn.mm, cut.drawn.sheet.scene.size
    row = {name: 3 * i for i, name in enumerate(members)}
    about = {name: cut.drawn.sheet.poses[name].origin for name in members}

    def parts(one: ForceVector, link: str) -> tuple[float, float, float]:
        """Both projections of a force, and its moment about a link's origin over the mechanism's size."""
        arm = cross(one.at - about[link], one.force) / mm / size
        return one.force.real, one.force.imag, arm + one.moment / size

    left, right = np.zeros((3 * len(members), len(unknowns))), np.zeros(3 * len(members))
    for k, (one, _, _) in enumerate(unknowns):
        couple = replace(one, moment=0.0 if one.force else size)
        for link, sign in ((one.link, 1.0), (one.off, -1.0)):
            if link in row:
                left[row[link] : row[link] + 3, k] += sign * np.array(parts(couple, link))
    for link, i in row.items():
        for one in cut.on((link,)):
            right[i : i + 3] -= parts(one, link)
    if left.shape[0] != left.shape[1] or not np.isfinite(left).all() or np.linalg.cond(left) > 1.0 / SINGULAR:
        raise _dead_point(members)
    found = np.linalg.solve(left, right)
    found += np.linalg.solve(left, right - left @ found)  # a second pass takes back the rounding of the first
    return [float(v * (1.0 if one.force else size)) for v, (one, _, _) in zip(found, unknowns, strict=True)]


def _carry_over(
    cut: CutFree, group: ForceGroup, members: Sequence[str], unknowns: Sequence[Unknown], values: Sequence[float]
) -> None:
    """Put what was found (N, N m) to the pairs, and draw the polygon of each link."""
    forces: dict[tuple[Symbol, str, str], Unknown] = {}
    couples: dict[str, float] = {}
    for (one, point, slide), value in zip(unknowns, values, strict=True):
        if one.force:
            key = one.symbol, one.link, one.off
            so_far = forces[key][0].force if key in forces else 0j
            forces[key] = replace(one, force=so_far + value * one.force), point, slide
        elif slide is not None:
            couples[slide.key] = value
        else:
            cut.balances[one.symbol] = value
            couple = replace(one, moment=value)  # what drives a link of the group from one still to come loads that
            cut.push(*(c for c in (couple, couple.back) if c.link not in members))
    polygons: dict[str, Chain] = {name: [] for name in members}
    for name in members:
        cut.lay_known(polygons[name], (name,))
    for one, point, slide in forces.values():
        if point:
            cut.pins[point, one.link] += one.force
            if one.off:
                cut.pins[point, one.off] -= one.force
        elif slide is not None:
            cut.set_slide(slide, one, couples[slide.key], members)
            _shift_line(cut, group, one, couples[slide.key])
        else:
            cut.balances[one.symbol] = one.force
            cut.push(*(f for f in (one, one.back) if f.link not in members))
        for force in (one, one.back):
            if force.link in polygons:
                cut.lay(polygons[force.link], replace(force, by="closing"))
    group.inner |= {name: chain for name, chain in polygons.items() if name not in cut.drawn.blocks}
