"""The forces of a group cut free: of a dyad, of a driven link, of a larger group.

Of a dyad one polygon is drawn.  Moments about the inner pin give the component of a turning pair's force square to the
bar; along the guide only its own pin pushes a link that slides on the other body.  The polygon of the whole group,
closed by the remaining directions, gives the rest, and that of one body the force inside (Sun Huan, Mechanical
Principles, ch. 4; Artobolevsky, Theory of mechanisms and machines, ch. 13).  Where a driver acts, the last driven link
balances, and links that a driver holds together have a couple or a push between them.

Of a larger group one system is drawn: for each link two projections and the moments about one point, with arms measured
on the mechanism; then the polygon of each link, which closes.

Forces are complex numbers in N while they are found; each is taken off the polygon in which it was drawn.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from graphkin.construction.board.instruments import PARALLEL, Instrument
from graphkin.construction.board.steps import NO_DIRECTION, Direction, Part, Reason, changed
from graphkin.construction.forces.position import DrawnPosition
from graphkin.construction.forces.steps import (
    APART,
    COUPLES,
    NO_GROUP,
    ZERO,
    ForceGroup,
    ForceStep,
    ForceVector,
    MomentStep,
    MomentTerm,
    Way,
    shifted_line,
)
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import added_up, cross, dot, unit
from graphkin.scene.pairs import Pair
from graphkin.scene.symbol import Symbol
from graphkin.structure import Driven, DrivenJoint, Dyad, LargerGroup
from graphkin.words import links_named

NORMAL, TANGENT = "n-n", "t-t"
"""The common normal and tangent of what touches, by name as a guide."""
SINGULAR = 1e-13
"""Reciprocal condition of a drawn system that tells nothing."""


def _dead_point(links: Sequence[str]) -> Unsolvable:
    """The error for moments without an arm, and for a system of forces, that tell nothing."""
    return Unsolvable("dead point", Problem(links_named(links),
                                            "the balance does no work in this position or",
                                            "move the driver off this position"))


ROUNDING = 1e-13
"""What is left of forces, or of moments, that cancel, as a part of all of them together."""

Chain = list[ForceVector]
"""Vectors of a polygon laid head to tail, from the origin on."""


def _gap(chain: Chain, end: complex, corner: complex) -> complex:
    """The vector between two places of a polygon (mm); 0 for vectors that close it within rounding."""
    rounding = abs(corner - end) <= ROUNDING * added_up(abs(vector.span) for vector in chain)
    return 0j if rounding else corner - end


def _end_of(chain: Chain) -> complex:
    """The beginning of a polygon's next vector (mm)."""
    return chain[-1].tip if chain else 0j


@dataclass
class CutFree:
    """The known forces on all links during the construction, and the group under work; the last group comes first.

    Parameters
    ----------
    acting : the known forces and couples by link
    pins : the forces of pins on links
    slides : force and couple of each guiding link on its sliding one
    done : the links whose forces are known
    per_mm : N for one mm of the polygons under work
    hung : the pins on which links hang that were found before, each with the links of the group there, the first of
        which bears them, and with their forces
    group : the group under work
    """

    drawn: DrawnPosition
    hand: Instrument
    per_mm: float
    acting: defaultdict[str, list[ForceVector]] = field(default_factory=lambda: defaultdict(list))
    pins: defaultdict[tuple[str, str], complex] = field(default_factory=lambda: defaultdict(complex))
    slides: dict[str, tuple[ForceVector, ForceVector]] = field(default_factory=dict)
    balances: list[ForceVector] = field(default_factory=list)
    done: set[str] = field(default_factory=set)
    hung: list[tuple[str, list[str], list[ForceVector]]] = field(default_factory=list)
    group: ForceGroup = NO_GROUP

    # the group under work

    def begin(self, links: tuple[str, ...], kind: str, way: Way, members: Sequence[str]) -> None:
        """Cut a group free, with the known forces and couples on it."""
        self.hung = []
        self.load_pins(members)
        acting = tuple(sorted(self.on(members), key=lambda load: not load.force))
        self.group = ForceGroup(links, kind, way, self.per_mm)
        self.do(ForceStep("mark", "cut free", "force", links=links, acting=acting))

    def do(self, step: ForceStep) -> None:
        """Record a step of the group."""
        self.group = changed(self.group, steps=(*self.group.steps, step))

    def read_off(self, chain: Iterable[ForceVector]) -> tuple[Symbol, ...]:
        """Read the forces of a polygon that were not read before, all parts together."""
        before, spans = self.group.read, dict[Symbol, complex]()
        for symbol, span in ((vector.symbol, vector.span) for vector in chain if not vector.known):
            if symbol in spans:
                spans[symbol] += span
            elif symbol not in before and not {symbol.opposite} & (before.keys() | spans.keys()):
                spans[symbol] = span
        self.group = changed(self.group, read={**before, **{symbol: abs(span) for symbol, span in spans.items()}})
        return tuple(spans)

    def lettered(self, chain: Chain) -> None:
        """The polygon of a group, closed by its last vector, and by its first if that was not known either; with the
        letters of its corners, in the order in which the vectors are laid off and found."""
        order, corners = chain[1:] + chain[:1] if chain[0].by == "closing" else chain, list[complex]()
        places = dict.fromkeys(z for vector in order for z in (vector.tail, vector.tip))
        for place in places:
            if all(abs(place - corner) > APART for corner in corners):
                corners.append(place)
        letters = {place: chr(ord("a") + int(np.abs(np.array(corners) - place).argmin())) for place in places}
        polygon = tuple(changed(v, ends=(letters[v.tail], letters[v.tip])) for v in chain)
        known = tuple(v for v in polygon if v.by != "closing" and abs(v.span) > ZERO)
        closing = tuple(v for v in reversed(polygon) if v.by == "closing")
        self.group = changed(self.group, polygon=polygon)
        finds = self.read_off(chain)
        if known:
            self.do(ForceStep("lay off", "known forces", "force", known))
        if len(chain) > 1:
            done = ForceStep("join", "closed", "force", closing, links=self.group.links, finds=finds)
            self.do(done if len(closing) == 1 else changed(done, verb="cross", reason="closed by lines"))

    def inside(self, links: tuple[str, ...], chain: Chain) -> None:
        """The polygon of some links of a group, closed by the force inside."""
        self.group = changed(self.group, inner={**self.group.inner, links: tuple(chain)})

    def finished(self, members: Collection[str]) -> ForceGroup:
        """The group under work: polygons of parts of it close with the forces inside, and couples follow."""
        self.done |= set(members)
        self.close_pins()
        couples = self.group.moments(*COUPLES)
        inside = [
            ForceStep("join", "inside", "force", tuple(v for v in chain if v.symbol in finds), links=links, finds=finds)
            for links, chain in self.group.inner.items() if (finds := self.read_off(chain))
        ]
        steps = (step for step in self.group.steps if step.reason not in COUPLES)
        return changed(self.group, steps=(*steps, *inside, *couples))

    # what acts

    def push(self, *acting: ForceVector) -> None:
        """Forces and couples act on links, as known ones; the frame bears what comes."""
        for force in acting:
            if force.link != self.drawn.structure.scene.frame.name:
                self.acting[force.link].append(changed(force, by="given", direction=None, part=""))

    def on(self, links: Iterable[str]) -> list[ForceVector]:
        """The known actions on some links, without those of size zero."""
        return [load for link in links for load in self.acting[link] if load.force or load.moment]

    def load_pins(self, members: Iterable[str]) -> None:
        """Links found before hang on pins of these: what guests do there acts on their hosts, what the others do on the
        first that has the pin."""
        drawn, inside = self.drawn, set(members)
        for point, holders in drawn.structure.hinges.items():
            if inside.isdisjoint(holders):
                continue
            hosts, loaded = drawn.hosts[point], set[str]()
            for guest, host in hosts.items():
                hanging = drawn.with_guests(point, guest)
                if host in inside and self.done.issuperset(hanging):
                    loaded.update(hanging)
                    symbol = drawn.of_pin(point, guest, self.done).opposite
                    self._load_pin(point, host, symbol, -self.at_pin(point, guest))
            others = [n for n in holders if n not in inside and n not in loaded]
            if not others or not self.done.issuperset(others):
                continue
            heads = [n for n in others if hosts.get(n) not in others]
            mine = [n for n in holders if n in inside and hosts.get(n) not in inside]
            carrier = next((n for n in mine if n not in hosts), mine[0])
            hung = {drawn.of_pin(point, n, self.done).opposite: -self.at_pin(point, n) for n in heads}
            loads = [self._load_pin(point, carrier, symbol, force) for symbol, force in hung.items()]
            self.hung.append((point, [carrier, *(n for n in mine if n != carrier)], loads))

    def _load_pin(self, point: str, link: str, symbol: Symbol, force: complex) -> ForceVector:
        """A known force of a pin acts on a link."""
        load = ForceVector(symbol, link=link, force=force, at=self.drawn.point(link, point))
        self.push(load)
        self.pins[point, link] += force
        return load

    def close_pins(self) -> None:
        """Where the link that bears what hangs on a pin is paired with another link there, and no polygon gives the
        force of that pair, the polygon of the pin alone closes with it."""
        drawn = self.drawn
        for point, (carrier, *others), loads in self.hung:
            first = drawn.hosts[point].get(carrier, drawn.holders[point][0])
            symbol = drawn.between(carrier, first, point)
            there = {vector.symbol for polygon in self.group.polygons for vector in polygon}
            if carrier == first or carrier in drawn.structure.blocks or {symbol, symbol.opposite} & there:
                continue
            names = {n: drawn.of_pin(point, n, self.done).opposite for n in others} | {carrier: symbol}
            *inside, last = (
                replace(loads[0], symbol=name, link=n, force=-self.at_pin(point, n), by="closing")
                for n, name in names.items()
            )
            chain: Chain = []
            self.lay(chain, *loads, *inside)
            self.close(chain, last)
            self.inside((f"{point}/",), chain)

    def at_pin(self, point: str, link: str) -> complex:
        """The force (N) of a pin on a link and its guests together."""
        return added_up((self.pins[point, name] for name in self.drawn.with_guests(point, link)), 0j)

    def at_pair(self, pair: Pair, links: Sequence[str]) -> ForceVector:
        """The force of a pair on that of some links which it holds, of no size yet."""
        link, other = (pair.a, pair.b) if pair.a in links else (pair.b, pair.a)
        if pair.turns:
            symbol = self.drawn.of_pin(pair.point, pair.a, self.done)
            at = self.drawn.point(pair.a, pair.point)
        else:
            symbol, at = self.drawn.of_slide(pair), self.drawn.foot(pair)
            symbol = symbol if link == pair.a else symbol.opposite
        return ForceVector(symbol, link=link, at=at, by="closing", off=other)

    def hand_on(self, force: ForceVector, inside: Collection[str]) -> None:
        """Load with a force or a couple that of its two links which is still to come, not inside a group."""
        self.push(*(acting for acting in (force, force.back) if acting.link not in inside))

    def set_balance(self, balance: ForceVector, acting: ForceVector, inside: Collection[str]) -> None:
        """A balancing load, as found on one of its two links; it loads the other, if that comes later."""
        self.balances.append(acting.on(balance.link))
        self.hand_on(acting, inside)

    def set_slide(self, slide: Pair, force: ForceVector, couple: ForceVector, inside: Collection[str]) -> None:
        """The force and the couple of a sliding pair on one of its links; both load the other, if that comes later."""
        self.slides[slide.key] = force.on(slide.a), couple.on(slide.a)
        for acting in self.slides[slide.key]:
            self.hand_on(acting, inside)

    # moments

    def term(self, acting: ForceVector, about: complex) -> MomentTerm:
        """The moment of a force about a place, its arm measured on the mechanism; a couple is its own."""
        if not acting.force:
            return MomentTerm(acting, None, acting.moment)
        mm = cross(acting.at - about, unit(acting.force))
        arm = self.hand.read_signed(mm) if abs(mm) >= 1e-12 * self.drawn.size else 0.0
        return MomentTerm(acting, arm, abs(acting.force) * arm / self.drawn.mm, about)

    def moments(
        self, reason: Reason, links: Sequence[str], about: complex, letter: str, unknown: ForceVector,
        more: Iterable[ForceVector] = (),
    ) -> MomentStep:
        """The size of a force of known line, or of a couple, by the moments of all actions on some links.

        Parameters
        ----------
        about, letter : the place of the moments (mm), and its name
        unknown : the force or couple, of size 1
        more : forces and couples found already that are not yet among the known

        Raises
        ------
        Unsolvable : "dead point": the line goes through the place
        """
        sought = self.term(unknown, about)
        if sought.arm is not None and abs(sought.arm) <= PARALLEL * self.drawn.size:
            raise _dead_point(links)
        acting = [*self.on(links), *(load for load in more if load.force or load.moment)]
        terms = tuple(self.term(load, about) for load in sorted(acting, key=lambda load: not load.force))
        total = added_up(term.moment for term in terms)
        rounding = abs(total) <= ROUNDING * added_up(abs(term.moment) for term in terms)
        value = 0.0 if rounding else -total / sought.moment
        return MomentStep(
            "read", reason, "force", symbol=sought.symbol, links=tuple(links), finds=(sought.symbol,),
            part=unknown.part, about=letter, terms=terms, unknown=sought, value=value,
        )

    def shift(self, force: ForceVector, couple: float) -> float:
        """Shift the line of action of a pair's force by its couple (N m); the shift (m)."""
        if not force.force:
            return 0.0
        at, shift = shifted_line(force.force, force.at, couple, self.drawn.mm)
        self.group = changed(self.group, lines={**self.group.lines, force.symbol: at})
        return shift

    # polygons

    def lay(self, chain: Chain, *forces: ForceVector) -> None:
        """Lay off forces head to tail."""
        for force in forces:
            tail = _end_of(chain)
            chain.append(changed(force, tail=tail, tip=self.hand.laid_off(tail, force.force / self.per_mm)))

    def lay_known(self, chain: Chain, links: Iterable[str]) -> None:
        """Lay off the known forces on some links."""
        self.lay(chain, *(load for load in self.on(links) if load.force))

    def close(self, chain: Chain, last: ForceVector, first: ForceVector | None = None) -> None:
        """Close a polygon: by one force, or by two of known directions, the one before its first vector and the other
        behind its last.

        Raises
        ------
        Unsolvable : "dead point": the two directions are parallel
        """
        end, corner = _end_of(chain), chain[0].tail if chain else 0j
        if first is not None:
            d, e = self.hand.direction(last.force), self.hand.direction(first.force)
            start, corner = corner, self.hand.crossing(last.symbol, end, d, corner, e)
            chain.insert(0, changed(first, tail=start - _gap(chain, corner, start), tip=start))
            corner = chain[0].tail
        chain.append(changed(last, tail=end, tip=end + _gap(chain, end, corner)))

    def drawn_in(self, chain: Chain, force: ForceVector) -> ForceVector:
        """A force as it stands in a polygon, all its parts together (N)."""
        parts = (vector.span for vector in chain if vector.symbol == force.symbol)
        return changed(force, force=added_up(parts, 0j) * self.per_mm)


def _across(pair: Pair) -> Direction:
    """The direction of a sliding pair's force: square to the guide; of what touches along the normal, or the tangent of
    pitch circles."""
    other = {NORMAL: TANGENT, TANGENT: NORMAL}.get(pair.guide.name.rstrip("'"))
    return Direction("along", (other,)) if other else Direction("square", _along(pair).names)


def _along(slide: Pair) -> Direction:
    """The direction of a guide, as it is written."""
    return Direction("along", (slide.guide_name,))


def _slide_found(
    cut: CutFree, links: Sequence[str], slide: Pair, force: ForceVector, about: complex, letter: str,
    acting: Iterable[ForceVector], inside: Collection[str],
) -> ForceVector:
    """The couple of a sliding pair on links, from the moments about a place, and where it puts the line of action of
    the pair's force; ``about``, ``letter`` and ``acting``, with the pair's own, as in `CutFree.moments`, the links
    ``inside`` do not come later."""
    unknown = ForceVector(replace(force.symbol, kind="M"), link=force.link, moment=1.0, off=force.off)
    step = cut.moments("couple", links, about, letter, unknown, acting)
    shift = cut.shift(force, step.value)
    if any(link in cut.drawn.sheet.scene.by_name for link in links):  # a pin in a slot has no couple
        cut.do(changed(step, shifted=force.symbol, shift=shift) if step.value else changed(step, reason="no couple"))
    cut.set_slide(slide, force, step.found, inside)
    return step.found


# a dyad


def of_dyad(cut: CutFree, dyad: Dyad) -> ForceGroup:
    """The forces of a dyad: those of its outer pairs, then the force inside, then those between links that drivers
    hold together.

    Raises
    ------
    Unsolvable : "dead point": the lines that close the polygon are parallel
    """
    cut.begin(dyad.links or dyad.members, dyad.kind, "polygon", dyad.members)
    pairs = dyad.outer_first, dyad.outer_second
    at_first, at_second = (cut.at_pair(pair, body.links) for pair, body in zip(pairs, dyad.bodies, strict=True))
    (first, head), (second, tail) = _outer_parts(cut, dyad, at_first, at_second)
    chain: Chain = []
    cut.lay(chain, *first)
    cut.lay_known(chain, (*dyad.first.links, *dyad.second.links))
    cut.lay(chain, *second)
    cut.close(chain, tail, head)
    cut.lettered(chain)
    outer = cut.drawn_in(chain, at_first), cut.drawn_in(chain, at_second)
    for pair, force in zip(pairs, outer, strict=True):
        if pair.turns:
            cut.pins[pair.point, pair.a] += force.force
    inner, couples = _inner_force(cut, dyad, outer[0])
    for pair, body, force, opposed in zip(pairs, dyad.bodies, outer, (inner, inner.back), strict=True):
        if pair.turns:
            continue
        at, letter, acting = force.at, pair.pin or pair.a, [force, opposed, *(couple.back for couple in couples)]
        if dyad.inner.turns:
            at, letter, acting = opposed.at, dyad.inner.point, [force]
        couples.append(_slide_found(cut, body.links, pair, force, at, letter, acting, dyad.members))
    for body, force, opposed in zip(dyad.bodies, outer, (inner, inner.back), strict=True):
        turning = (load for couple in couples for load in (couple, couple.back) if load.link in body.links)
        acting = [opposed, force, *turning]
        # links that drivers hold together, from the outermost on
        for joint in reversed(body.joints):
            on_leaf = [load for load in acting if load.link == joint.b]
            acting += _at_driven_joint(cut, joint, on_leaf, body.links)
    return cut.finished(dyad.members)


OuterParts = tuple[list[ForceVector], ForceVector]
"""The parts of an outer force that are of known size, and that which closes the polygon, of size 1."""


def _outer_parts(
    cut: CutFree, dyad: Dyad, at_first: ForceVector, at_second: ForceVector
) -> tuple[tuple[list[ForceVector], ForceVector | None], OuterParts]:
    """The known parts of both outer forces before the polygon closes; None where the first is known completely."""
    slide, outer = dyad.inner, dyad.outer_second
    if slide.turns:
        return (_by_inner_pin(cut, dyad.first.links, dyad.outer_first, at_first, slide),
                _by_inner_pin(cut, dyad.second.links, outer, at_second, slide))
    # body one slides on body two: what pushes it along the guide only its pin can hold
    along = cut.drawn.along(slide)
    laid: Chain = []
    cut.lay_known(laid, dyad.first.links)
    push = along * -dot(_end_of(laid), along) * cut.per_mm
    known = [changed(at_first, force=push, part="n", by="moments", direction=_along(slide))] if push else []
    if known:
        symbol, link = at_first.symbol, at_first.link.split("/")[0]
        cut.do(ForceStep("read", "along guide", "force", symbol=symbol, link=link, finds=(symbol,), part="n"))
    mark: Part = "t" if known else ""
    square = changed(at_first, force=1j * along, part=mark, direction=_across(slide))
    if not outer.turns:
        return (known, square), ([], changed(at_second, force=1j * cut.drawn.along(outer), direction=_across(outer)))
    step = cut.moments("about guide", dyad.members, at_second.at, outer.point, square, known)
    cut.do(step)
    return ([*known, step.found], None), ([], at_second)


def _by_inner_pin(
    cut: CutFree, links: Sequence[str], outer: Pair, force: ForceVector, inner: Pair
) -> OuterParts:
    """An outer force by the moments about the inner pin."""
    if not outer.turns:
        return [], changed(force, force=1j * cut.drawn.along(outer), direction=_across(outer))
    hinge = cut.drawn.point(inner.a, inner.point)
    bar, along = (outer.point, inner.point), force.at - hinge
    square = changed(force, force=1j * unit(along), part="t", direction=Direction("square", bar))
    step = cut.moments("about pin", links, hinge, inner.point, square)
    cut.do(step if step.terms else changed(step, reason="two-force member", part=""))
    closing = changed(force, force=along, direction=Direction("along", bar))
    # where it is nought nothing acts on the bar between its ends
    return ([step.found], changed(closing, part="n")) if step.value else ([], closing)


def _inner_force(
    cut: CutFree, dyad: Dyad, outer: ForceVector
) -> tuple[ForceVector, list[ForceVector]]:
    """The force inside closes the polygon of the first body, on which the ``outer`` force acts; the couple of a sliding
    pair closes the moments."""
    pair, links = dyad.inner, dyad.first.links
    chain = [vector for vector in cut.group.polygon if vector.link in links]
    force = _gap(chain, _end_of(chain), chain[0].tail) * cut.per_mm
    if pair.turns:
        names, point, known = cut.drawn, pair.point, cut.drawn.structure.links
        first, second = (next(n for n in body.links if point in known[n].points) for body in dyad.bodies)
        # at a pin of several links the first of both bears what was there before: the force is called as the other's is
        hosts, holders = names.hosts[point], names.structure.hinges[point]
        bearing = min((first, second), key=lambda link: (link in hosts, holders.index(link)))
        on_other = names.of_pin(point, first if bearing == second else second, cut.done)
        symbol = on_other if bearing == second else on_other.opposite
        cut.pins[point, first] += force
        cut.pins[point, second] -= force
        at = cut.drawn.point(first, point)
        on_first = ForceVector(symbol, link=first, force=force, at=at, by="closing", off=second)
    else:
        square = 1j * cut.drawn.along(pair)
        on_first = changed(cut.at_pair(pair, links), force=square * dot(force, square))
    cut.close(chain, on_first)
    chain[-1] = changed(chain[-1], ends=(chain[-2].ends[1], chain[0].ends[0]))
    cut.inside(links, chain)
    if pair.turns:
        return on_first, []
    about, letter = outer.at, dyad.outer_first.point
    return on_first, [
        _slide_found(cut, links, pair, on_first, about, letter, (on_first, outer), dyad.members)
    ]


# where drivers act


def _close_driven(
    cut: CutFree, chain: Chain, pair: Pair, on: ForceVector, push: ForceVector,
    more: Iterable[ForceVector], inside: Collection[str],
) -> list[ForceVector]:
    """Close the polygon of a link at a driven pair: the force of the pair on it, then the moment or the force that
    drives it there, then the couple of a sliding pair.

    Parameters
    ----------
    chain : its polygon, as far as it is known
    on, push : the force and what drives, of size 1 or of unknown direction
    more, inside : as in `CutFree.moments`, and links that do not come later
    """
    links = (on.link,)
    if pair.turns:
        cut.close(chain, on)
        on = cut.drawn_in(chain, on)
        if not push.moment:
            return [on, push]
        step = cut.moments("balance", links, on.at, pair.point, changed(push, moment=1.0), more)
        cut.do(step)
        return [on, step.found]
    on = changed(on, force=1j * cut.drawn.along(pair), direction=_across(pair))
    aside = abs(cross(push.force, cut.drawn.along(pair))) > PARALLEL  # as the scene says
    push = changed(push, by="closing", direction=NO_DIRECTION if aside else _along(pair))
    cut.close(chain, on, push)
    on, push = cut.drawn_in(chain, on), cut.drawn_in(chain, push)
    return [on, push, _slide_found(cut, links, pair, on, on.at, pair.pin or pair.a, (*more, on, push), inside)]


def _at_driven_joint(
    cut: CutFree, joint: DrivenJoint, extra: Sequence[ForceVector], inside: Collection[str]
) -> list[ForceVector]:
    """The force and the moment of a driven pair on the link that hangs on it, under ``extra`` loads besides the known;
    returns what acts on the other link."""
    leaf, other, pair = joint.b, joint.a, joint.pair
    balance = cut.drawn.balance(joint.driver)
    chain: Chain = []
    cut.lay_known(chain, (leaf,))
    cut.lay(chain, *(changed(load, by="given") for load in extra if load.symbol.is_vector))
    on = cut.at_pair(pair, (leaf,))
    if pair.turns:
        symbol = cut.drawn.of_pin(pair.point, leaf, cut.done)
        if leaf == cut.drawn.holders.get(pair.point, ("",))[0]:
            symbol = cut.drawn.between(other, leaf, pair.point)
        on = ForceVector(symbol, link=leaf, at=cut.drawn.point(leaf, pair.point), by="closing", off=other)
    on_leaf = on, push, *_ = _close_driven(cut, chain, pair, on, balance.on(leaf), extra, inside)
    cut.inside((leaf,), chain)
    cut.set_balance(balance, push, inside)
    if pair.turns:
        cut.pins[pair.point, leaf] += on.force
        cut.pins[pair.point, other] -= on.force
    return [acting.back for acting in on_leaf]


def at_driver(cut: CutFree, element: Driven) -> ForceGroup:
    """The forces of a link that is driven from links still to come, and what balances it there.

    Raises
    ------
    Unsolvable : "dead point": the balance does no work
    """
    link, pair = element.link, element.pair
    (driver,) = element.drivers
    balance = cut.drawn.balance(driver)
    cut.begin(element.links, "driver", "driver", (link,))
    chain, on, push = list[ForceVector](), cut.at_pair(pair, (link,)), balance.on(link)
    if pair.turns and push.force:
        step = cut.moments("about driver", (link,), on.at, pair.point, push)
        cut.do(step)
        cut.lay(chain, step.found)
        push = cut.drawn_in(chain, step.found)
    cut.lay_known(chain, (link,))
    on, push, *_ = _close_driven(cut, chain, pair, on, push, (), (link,))
    cut.lettered(chain)
    if pair.turns:
        cut.pins[pair.point, pair.a] += on.force
    cut.set_balance(balance, push, (link,))
    return cut.finished((link,))


# a larger group


def of_larger_group(cut: CutFree, group: LargerGroup) -> ForceGroup:
    """The forces of a group larger than a dyad, or of one that a balance holds otherwise than by a driven link.

    Raises
    ------
    Unsolvable : "dead point": the drawn system tells nothing
    """
    cut.begin(group.links, group.kind, "drawn system", group.members)
    cut.do(ForceStep("read", "system", "force", links=group.links))
    drawn, inside = cut.drawn, {*group.members}
    pins = [*_pin_forces(cut, inside)]
    slides = [s for s in drawn.structure.slides if s.key not in cut.slides and {s.a, s.b} & inside]
    balances = [drawn.balance(driver) for driver in group.drivers]
    # along both axes at each pin, one square to the guide and a couple at each sliding pair, and what balances
    unknowns = [changed(force, force=along) for _, force in pins for along in (1 + 0j, 1j)]
    for slide in slides:
        at, square = drawn.foot(slide), 1j * drawn.along(slide)
        force = ForceVector(drawn.of_slide(slide), link=slide.a, force=square, at=at, off=slide.b)
        unknowns += [force, changed(force, symbol=drawn.of_slide(slide, "M"), force=0j, moment=1.0)]
    solution = iter(_solved(cut, group.members, [*unknowns, *balances]))
    forces = list[ForceVector]()
    for point, pin in pins:
        both = next(solution).force + next(solution).force
        forces.append(changed(pin, force=both))
        cut.pins[point, pin.link] += both
        if pin.off:
            cut.pins[point, pin.off] -= both
    for slide in slides:
        of_slide, couple = next(solution), next(solution)
        forces.append(of_slide)
        cut.set_slide(slide, of_slide, couple, inside)
        cut.shift(of_slide, couple.moment)
    for balance, acting in zip(balances, solution, strict=True):
        cut.set_balance(balance, acting, inside)
        if acting.symbol.is_vector:
            forces.append(acting)
    polygons: dict[str, Chain] = {name: [] for name in group.members}
    for name, chain in polygons.items():
        cut.lay_known(chain, (name,))
    for load in forces:
        for acting in (load, load.back):
            if acting.link in polygons:
                cut.lay(polygons[acting.link], changed(acting, by="closing"))
    for name, chain in polygons.items():
        if name not in drawn.structure.blocks:
            cut.inside((name,), chain)
    return cut.finished(group.members)


def _pin_forces(cut: CutFree, inside: Collection[str]) -> Iterator[tuple[str, ForceVector]]:
    """The forces of each pin on the links of a group ``inside``, of no size yet: on all where the frame or links still
    to come hold the pin, else on all but the first, on which the opposites act."""
    for point, holders in cut.drawn.structure.hinges.items():
        mine = [n for n in holders if n in inside]
        if not mine:
            continue
        held = any(n not in inside and n not in cut.done for n in holders)
        hosts = {guest: host for guest, host in cut.drawn.hosts[point].items() if host in inside}
        first = next(n for n in mine if n not in hosts)
        at, other = cut.drawn.point(first, point), "" if held else first
        for link in (n for n in mine if held or n != first):
            symbol = cut.drawn.of_pin(point, link, cut.done.union(inside))
            yield point, ForceVector(symbol, link=link, at=at, off=hosts.get(link, other))


def _solved(cut: CutFree, members: Sequence[str], unknowns: Sequence[ForceVector]) -> list[ForceVector]:
    """The unknown forces and couples, of size 1, with their sizes."""
    mm, size = cut.drawn.mm, cut.drawn.sheet.scene.size
    row = {name: 3 * i for i, name in enumerate(members)}
    about = {name: cut.drawn.sheet.poses[name].origin for name in members}

    def parts(load: ForceVector, link: str) -> tuple[float, float, float]:
        """Both projections of a force, and its moment about a link's origin over the mechanism's size."""
        arm = cross(load.at - about[link], load.force) / mm / size
        return load.force.real, load.force.imag, arm + load.moment / size

    left, right = np.zeros((3 * len(members), len(unknowns))), np.zeros(3 * len(members))
    columns = [changed(load, moment=load.moment * size) for load in unknowns]
    for k, load in enumerate(columns):
        for link, sign in ((load.link, 1.0), (load.off, -1.0)):
            if link in row:
                left[row[link] : row[link] + 3, k] += sign * np.array(parts(load, link))
    for link, i in row.items():
        for load in cut.on((link,)):
            right[i : i + 3] -= parts(load, link)
    if left.shape[0] != left.shape[1] or not np.isfinite(left).all() or np.linalg.cond(left) > 1.0 / SINGULAR:
        raise _dead_point(members)
    solution = np.linalg.solve(left, right)
    solution += np.linalg.solve(left, right - left @ solution)  # a second pass takes back the rounding of the first
    solution[abs(solution) <= ROUNDING * np.abs(solution).sum()] = 0.0
    return [changed(load, force=value * load.force, moment=value * load.moment)
            for value, load in zip(solution.tolist(), columns, strict=True)]
