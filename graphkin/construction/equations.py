"""Vector equations of relative motions: what is known of each term, and how a student knows it; and how they are drawn.

The known vectors of each side of an equation are laid off one after the other.  Where no size is unknown, the last one
ends in the end point sought; where one is, its vector is what is left between two end points that stand; where two are,
lines along them cross in the end point.  The angular rates follow from the vectors found.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Literal

from graphkin.construction.net import (
    ClosingVector,
    Edge,
    Joined,
    ParallelLegs,
    Turning,
    TwoUnknowns,
    contacts_of,
    joined_at_contacts,
    node,
)
from graphkin.construction.polygons import RATE, Polygons, letter
from graphkin.construction.sheet import Equation, Rate, Remark, Term
from graphkin.construction.sizes import (
    Component,
    Direction,
    Given,
    OffCurves,
    Order,
    RateTimes,
    RollingCurves,
    SquareOverRadius,
)
from graphkin.construction.steps import Step
from graphkin.construction.strokes import Aid, Bar, Mark, Ray, Vector
from graphkin.construction.touching import Touching
from graphkin.plane import added_up, cross, dot, unit
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Cluster, Driven, Dyad, Element, Pair, Weld

__all__ = [
    "at_contacts", "draw_equation", "draw_parallel_legs", "draw_relative", "first_ends", "known_turns", "links_alike",
    "parts_of", "same_turn", "share_rate", "spread", "symbol_of", "turned",
]  # fmt: skip

Side = list[tuple[Edge, list[Component]]]


# -- links that turn alike ---------------------------------------------------------------------------------------------


def links_alike(links: Iterable[str], pairs: Iterable[tuple[str, str, float]]) -> dict[str, set[str]]:
    """For each link all those with the same rotation but for given ones."""
    alike = {n: {n} for n in links}
    for a, b, _ in pairs:
        merged = alike.get(a, {a}) | alike.get(b, {b})
        for n in merged:
            alike[n] = merged
    return alike


def same_turn(plot: Polygons, group: Dyad | Cluster) -> dict[str, str]:
    """For each link of a group one link with the same rotation but for given ones: a known one if there is any, none of
    the blocks of contacts that are drawn themselves."""
    if plot.part_of is not None and isinstance(group, Cluster):
        # links of the group that are not of the contour turn as unknown as its own
        alike = links_alike(group.members, turned(plot, None, group))
        inside = set(group.members)
        return {n: plot.ground if plot.ground in alike[n] else min(alike[n] & inside) for n in group.members}
    without = {c.block for c in contacts_of(plot.structure, group)} if plot.at_contacts else set()
    names = group.members
    alike = links_alike(names, turned(plot, None, group))
    own = {n: min(alike[n].difference(without), default=n) for n in names}
    return {n: next((m for m in sorted(alike[n]) if m not in names), own[n]) for n in names}


def turned(plot: Polygons, order: Order | None, group: Dyad | Cluster) -> list[tuple[str, str, float]]:
    """Links a and b of a group that turn alike but for a given rate: (a, b, that of b from a); without an order only
    which."""
    whole = group if plot.part_of is None else plot.part_of
    pairs = _turned_alike(whole, order or "velocity", plot.given if order else {})
    for held, rest in plot.contours.get(group, ()) if isinstance(group, Cluster) else ():
        seen = plot.seen[held].rates[order] if order and held in plot.seen else {}
        pairs += [(held, n, seen[n].value if n in seen else 0.0) for n in rest.members if not order or n in seen]
    return pairs


def _turned_alike(
    group: Dyad | Cluster, order: Order, rates: Mapping[str, tuple[float, float]]
) -> list[tuple[str, str, float]]:
    """Links a and b of a group that turn alike but for a given rate: (a, b, that of b from a)."""
    which = 0 if order == "velocity" else 1
    if isinstance(group, Cluster):
        slides = [p for p in group.pairs if not p.turns]
        given = [
            (d.relative_to, d.link, rates[d.key][which] if rates else 0.0)
            for d in group.drivers if d.turns
        ]  # fmt: skip
        return [*((s.a, s.b, 0.0) for s in slides), *given]
    slides = [p for p in group.pairs if not p.turns]
    welds = [w for body in group.bodies for w in body.welds]
    held = [
        (w.a, w.b, _turn_sign(w) * rates[w.driver.key][which] if rates and w.pair.turns else 0.0)
        for w in welds
    ]
    return [*((s.a, s.b, 0.0) for s in slides), *held]


def known_turns(plot: Polygons, order: Order, group: Dyad | Cluster) -> None:
    """Links that share their rotation with one already known."""
    for name, other in same_turn(plot, group).items():
        if other in plot.rates[order] and name not in plot.rates[order]:
            spread(plot, order, other, group)


def share_rate(plot: Polygons, order: Order, known: str, name: str, add: float = 0.0) -> None:
    rate = plot.rates[order][known]
    plot.rates[order][name] = Rate(name, rate.value + add, rate.vector, rate.mm, rate.arm_mm, rate.same_as or known)


def spread(plot: Polygons, order: Order, start: str, group: Dyad | Cluster) -> None:
    """From one known rotation to those of all links that slide on each other or are held by drivers."""
    pairs = turned(plot, order, group)
    queue = [start]
    while queue:
        at = queue.pop(0)
        for a, b, add in pairs:
            for known, new, more in ((a, b, add), (b, a, -add)):
                if known == at and new not in plot.rates[order]:
                    share_rate(plot, order, at, new, more)
                    told = _told_apart(plot, order, a, b) if a in plot.seen else add != 0.0
                    if isinstance(group, Cluster) and at != plot.ground and told:
                        value = plot.rates[order][at].value
                        plot.board.do(Step("read", "sum of rates", order, kind=RATE[order], link=new, links=(at, b),
                                           value=value, other=add))  # fmt: skip
                    queue.append(new)


def _told_apart(plot: Polygons, order: Order, one: str, other: str) -> bool:
    """Whether it is told how a link turns as seen from another: it does not just turn as a third does."""
    rates = plot.seen[one].rates[order]
    if other not in rates:
        return False
    return not rates[other].same_as or rates[rates[other].same_as].value != rates[other].value


def first_ends(plot: Polygons, name: str, hinge: str) -> list[PointRef]:
    """With which points of a driven link a drawing begins: one of its own, else those under what slides on it."""
    own = [PointRef(p) for p in plot.links[name].points if p != hinge]
    under = [
        node(plot.links, s.pin, name)
        for s in plot.structure.slides
        if s.pin in plot.places and s.b == name and "/" not in name
    ]
    away = [n for n in (*own, *under) if abs(plot.places[n.point] - plot.places[hinge]) > plot.tiny]
    first = away[:1] if any(n in own for n in away) else away
    return list(dict.fromkeys(first))


def at_contacts(plot: Polygons, group: Dyad | Cluster, joined: Joined) -> Joined:
    """What joins a group, with its sliding contacts themselves where these are drawn."""
    contacts = contacts_of(plot.structure, group) if plot.at_contacts else ()
    return joined_at_contacts(joined, contacts) if contacts else joined


# -- equations drawn ---------------------------------------------------------------------------------------------------


def side_of(plot: Polygons, order: Order, path: Sequence[Edge]) -> Side:
    """The terms of each edge along one side of an equation."""
    return [(edge, [plot.slip.term(part) for part in parts_of(plot, order, edge)]) for edge in path]


def _parts(side: Side) -> list[Component]:
    return [part for _, parts in side for part in parts]


def _open(side: Side) -> list[Component]:
    """The terms of unknown size."""
    return [part for part in _parts(side) if part.span is None]


def written(part: Component) -> Term:
    """A component as a term of a written equation."""
    return Term(part.symbol, part.span is not None, True, part.size, part.written)


def _terms(plot: Polygons, order: Order, side: Side) -> tuple[Term, ...]:
    start = side[0][0].start
    first = () if plot.fixed(start) else (Term(Symbol(letter(order), plot.label(start)), True, True),)
    return (*first, *map(written, _parts(side)))


def draw_equation(
    plot: Polygons, order: Order, element: Element, equation: TwoUnknowns | ClosingVector
) -> None:
    """Write a vector equation with no, one or two unknown sizes, draw it, and measure the rates that follow.

    An equation that says no more of a vector than that it is itself is not written.
    """
    end = equation.end
    whole = Symbol(letter(order), plot.label(end))
    sides = [side_of(plot, order, path) for path in equation.sides]
    stands = isinstance(equation, ClosingVector) and (plot.fixed(end) or end in plot.ends[order])
    terms = [_terms(plot, order, side) for side in sides]
    alone = [side for side in terms if [term.symbol for term in side] == [whole]]
    number: int | None = None
    if len(sides) > 1 or not alone or (not stands and any(term.size for term in alone[0])):
        number = len(plot.board.equations) + 1
        others = [side for side in terms if side not in alone]
        heads = alone or [(Term(whole, stands, stands),)]
        plot.board.equations.append(Equation(number, order, (*heads, *others), element))
    if isinstance(equation, TwoUnknowns):
        _cross(plot, order, end, sides, number)
    else:
        _close(plot, order, end, sides[0], number)
    for side in sides:
        if len(_open(side)) == 1:  # of several along one line only the sum is known
            for edge, _ in side:
                _measure(plot, order, edge, element)


def _close(plot: Polygons, order: Order, end: PointRef, side: Side, equation: int | None) -> None:
    """Lay off the known vectors of a way; what is left to an end point that stands is its unknown one."""
    parts = _parts(side)
    at = plot.end(order, side[0][0].start)
    if not _open(side):
        for edge, known in side:
            for part in known:
                at = _lay_off(plot, order, part, at, equation)
            plot.reach(order, edge.end, at, equation)
        return
    open_at = parts.index(_open(side)[0])
    for part in parts[:open_at]:
        drawn = plot.drawn[order].get(part.symbol)
        at = drawn.tip if drawn is not None else _lay_off(plot, order, part, at, equation)
    after = added_up((part.span for part in parts[open_at + 1 :] if part.span is not None), 0j)
    _fill(plot, order, side, plot.end(order, end) - after, at, equation)


def _cross(plot: Polygons, order: Order, end: PointRef, sides: Sequence[Side], equation: int | None) -> None:
    """Draw both sides of an equation up to their unknowns, and let these meet.

    A side may have several unknowns along one direction, as those of a special point have: their sum is found.
    """
    starts, lines = [], []
    for side in sides:
        parts = _parts(side)
        open_at = parts.index(_open(side)[0])
        at = plot.end(order, side[0][0].start)
        for part in parts[:open_at]:
            at = _lay_off(plot, order, part, at, equation)
        # known terms behind the unknown one are added first, and put in their place afterwards
        behind = [part for part in parts[open_at + 1 :] if part.span is not None]
        at = _carry(plot, order, behind, at, equation)
        starts.append((at, added_up((part.span for part in behind if part.span), 0j)))
        lines.append((at, parts[open_at]))
    whole = Symbol(letter(order), plot.label(end))
    meeting = _lines_meet(plot, order, whole, 0j, lines, equation)
    mark = Mark(plot.label(end), meeting)
    plot.board.do(Step("cross", "lines", order, (mark,), equation, ref=mark.ref))
    for side, (start, carried) in zip(sides, starts, strict=True):
        if len(_open(side)) == 1:
            _fill(plot, order, side, meeting - carried, start - carried, equation)
    plot.reach(order, end, meeting, equation)


def _carry(plot: Polygons, order: Order, parts: Iterable[Component], at: complex, equation: int | None) -> complex:
    """Add known vectors before their turn; returns where they end."""
    for part in parts:
        if part.span is not None:
            bar = Bar(at, at + part.span, "")
            plot.board.do(Step("carry over", "before its turn", order, (bar,), equation, symbol=part.symbol))
            at += part.span
    return at


def _lines_meet(
    plot: Polygons, order: Order, symbol: Symbol, tail: complex, lines: Sequence[tuple[complex, Component]],
    equation: int | None,
) -> complex:  # fmt: skip
    """Lines along two vectors of unknown size, each through a point; where they cross the vector ``symbol`` from
    ``tail`` ends."""
    (p, left), (q, right) = ((at, plot.slip.line(part.symbol, part.along)) for at, part in lines)
    meeting = plot.slip.found(symbol, tail, plot.board.cross(order, p, left, q, right, str(symbol)))
    for through, part in lines:
        ray = Ray(through, part.along, meeting, part.written, part.symbol)
        step = Step("line", "direction", order, (ray,), equation, symbol=part.symbol, direction=part.written)
        plot.board.do(step)
    return meeting


def draw_relative(
    plot: Polygons, order: Order, group: Cluster, symbol: Symbol, paths: Sequence[Sequence[Edge]]
) -> complex:
    """The vector of one moving point relative to another, drawn from the pole by two ways that have no known start."""
    sides = [_parts(side_of(plot, order, path)) for path in paths]
    if not any(part.span for side in sides for part in side):
        return 0j  # exactly
    number = len(plot.board.equations) + 1
    terms = [tuple(map(written, side)) for side in sides]
    plot.board.equations.append(Equation(number, order, ((Term(symbol, False, False),), *terms), group))
    lines = []
    for side in sides:
        at = _carry(plot, order, (part for part in side if part.span), 0j, number)
        lines.append((at, next(part for part in side if part.span is None)))
    meeting = _lines_meet(plot, order, symbol, 0j, lines, number)
    found = Aid(symbol, 0j, meeting, plot.trial)
    plot.board.do(Step("read", "vector", order, (found,), number, symbol=symbol, mm=abs(meeting)))
    return meeting


def draw_parallel_legs(plot: Polygons, order: Order, group: Cluster, legs: ParallelLegs) -> None:
    """The rate of a link whose two legs are parallel: from one leg's known end square to the bar between the joints,
    from the other's along the direction that both leave free."""
    side = side_of(plot, order, legs.path)
    number = len(plot.board.equations) + 1
    head = Term(Symbol(letter(order), plot.label(legs.end)), True, True)
    plot.board.equations.append(Equation(number, order, ((head,), _terms(plot, order, side)), group))
    own = same_turn(plot, group).get(legs.link, legs.link)
    at, goal = plot.end(order, legs.path[0].start), plot.end(order, legs.end)
    start = _carry(plot, order, _parts(side), at, number)
    unknown = [(edge, part) for edge, parts in side for part in parts if part.span is None]
    edge, turning = next((e, p) for e, p in unknown if e.link == legs.link and e.unknown == Turning(own))
    free = [p for e, p in unknown if e is not edge][-1]  # both legs leave that free
    meeting = _lines_meet(plot, order, turning.symbol, start, [(start, turning), (goal, free)], number)
    found = Aid(turning.symbol, start, meeting, 0)
    mm = plot.found_mm(turning.symbol, meeting - start)
    plot.board.do(Step("read", "vector", order, (found,), number, symbol=turning.symbol, mm=mm))
    _rate(plot, order, edge, turning.symbol, meeting - start, group)


def _lay_off(plot: Polygons, order: Order, part: Component, at: complex, equation: int | None) -> complex:
    """Lay off a known vector."""
    assert part.span is not None
    size = abs(part.span)
    tip = at
    if size > 0.0:
        hand = plot.board.instrument
        tip = hand.point(at + hand.direction(part.span / size) * hand.length(size))
    vector = Vector(part.symbol, at, tip, part.role)
    plot.board.notice(order, Remark("zero vector", (part.symbol,), size))
    plot.record(vector, Step("lay off", part.role, order, (), equation, symbol=part.symbol, size=part.size, mm=size,
                             direction=part.written))  # fmt: skip
    return tip


def _fill(plot: Polygons, order: Order, side: Side, tip: complex, tail: complex, equation: int | None) -> None:
    """Draw the unknown vector of a side, now found, and the end points along the side."""
    at = plot.end(order, side[0][0].start)
    for edge, parts in side:
        for part in parts:
            if part.span is None:
                found = Vector(part.symbol, tail, plot.slip.found(part.symbol, tail, tip), part.role)
                plot.board.notice(order, Remark("zero vector", (part.symbol,), abs(found.span)))
                mm = plot.found_mm(part.symbol, found.span)
                plot.record(found, Step("read", "vector", order, (), equation, symbol=part.symbol, mm=mm))
                at = tip
            else:
                if part.symbol not in plot.drawn[order]:
                    moved = Vector(part.symbol, at, at + part.span, part.role)
                    plot.record(moved, Step("join", "put back", order, (), equation, symbol=part.symbol))
                at = plot.drawn[order][part.symbol].tip
        if edge is not side[-1][0]:
            plot.reach(order, edge.end, at, equation)


def _measure(plot: Polygons, order: Order, edge: Edge, group: Element) -> None:
    """The angular rate of a link from the vector just found between two points of it."""
    if not edge.link or not edge.unknown or edge.link in plot.rates[order]:
        return
    symbol = symbol_of(plot, "v" if order == "velocity" else "at", edge)
    _rate(plot, order, edge, symbol, plot.drawn[order][symbol].span, group)


def _rate(plot: Polygons, order: Order, edge: Edge, symbol: Symbol, span: complex, group: Element) -> None:
    """The angular rate of a link, measured from a vector between two points of it and the bar that joins these."""
    arm = plot.places[edge.end.point] - plot.places[edge.start.point]
    # in a trial the ends need not meet: only the part square to the bar turns it
    mm = abs(cross(arm, span) / abs(arm) if plot.trial else span)
    size, read = plot.rate_of(order, symbol, mm, arm, _bar(edge))
    value = size if cross(arm, span) >= 0 else -size
    rate = RATE[order]
    own = plot.slip.rate(Symbol(rate, link=edge.link), value)
    if own is not None:
        plot.believed.add((order, edge.link))
    source = symbol if symbol in plot.drawn[order] else None
    plot.rates[order][edge.link] = Rate(edge.link, value if own is None else own, source, read, abs(arm))
    plot.board.do(
        Step("read", "rate", order, kind=rate, link=edge.link, symbol=symbol, points=_bar(edge), value=value, mm=read)
    )
    assert not isinstance(group, Driven)
    spread(plot, order, edge.link, group)


# -- terms -------------------------------------------------------------------------------------------------------------


def parts_of(plot: Polygons, order: Order, edge: Edge) -> list[Component]:
    """The terms of the motion of an edge's end relative to its start."""
    if edge.weld is not None:
        return _weld_parts(plot, order, edge, edge.weld)
    if edge.contact:
        return _contact_parts(plot, order, edge)
    if edge.rolling:
        return _rolling_parts(plot, order, edge)
    if edge.tied:
        return _tied_parts(plot, order, edge)
    if edge.held:
        return _contour_parts(plot, order, edge)
    if edge.slide is not None:
        return _slide_parts(plot, order, edge, edge.slide)
    return _rigid_parts(plot, order, edge)


def symbol_of(plot: Polygons, kind: str, edge: Edge) -> Symbol:
    start, end = plot.label(edge.labels[0]), plot.label(edge.labels[1])
    if kind in ("v", "a") and plot.fixed(edge.start):
        return Symbol(kind, plot.label(edge.end))
    return Symbol(kind, end, start)


def _rigid_parts(plot: Polygons, order: Order, edge: Edge) -> list[Component]:
    arm = plot.places[edge.end.point] - plot.places[edge.start.point]
    if edge.link in plot.still:
        return []
    square = 1j * unit(arm)
    name = _bar(edge)
    rate = None if edge.unknown else plot.rates[order].get(edge.link)
    role: Literal["resultant", "relative"] = "resultant" if plot.fixed(edge.start) else "relative"
    if order == "velocity":
        span = None if rate is None else square * (rate.value * plot.length(arm, name) / plot.scales.velocity)
        size = RateTimes("omega", (edge.link,), name) if span is not None else None
        return [Component(symbol_of(plot, "v", edge), role, square, span, edge.direction, size)]
    omega = plot.rates["velocity"][edge.link].value
    arm_m = plot.length(arm, name)
    inward = -unit(arm)
    normal = Component(
        symbol_of(plot, "an", edge),
        "normal",
        inward,
        inward * (omega**2 * arm_m / plot.scales.acceleration),
        Direction("towards", (edge.end.point, edge.start.point)),
        RateTimes("omega", (edge.link,), name, square=True),
    )
    if rate is not None and rate.value == 0.0:
        return [normal]
    span = None if rate is None else square * (rate.value * arm_m / plot.scales.acceleration)
    size = RateTimes("alpha", (edge.link,), name) if span is not None else None
    return [normal, Component(symbol_of(plot, "at", edge), "tangential", square, span, edge.direction, size)]


def _tied_parts(plot: Polygons, order: Order, edge: Edge) -> list[Component]:
    """The special point of one link relative to that of another, as its own polygon gave it: nothing where they move
    alike."""
    span = plot.ties[order, edge.end.point] * (1 if edge.forward else -1)
    if span == 0.0:
        return []
    return [Component(symbol_of(plot, letter(order), edge), "relative", unit(span), span, edge.direction)]


def _contour_parts(plot: Polygons, order: Order, edge: Edge) -> list[Component]:
    """The point of one link of a contour relative to that of another, as a polygon with one of them held still gave it;
    with the term of Coriolis, for that one turns."""
    seen = plot.seen_from(edge.held)
    way = 1 if edge.forward else -1
    moving = edge.end if edge.forward else edge.start
    role: Literal["resultant", "relative"] = "resultant" if plot.fixed(edge.start) else "relative"
    slip = way * seen.end("velocity", moving)
    if order == "velocity":
        return [Component(symbol_of(plot, "v", edge), role, unit(slip or 1.0), slip, edge.direction)]
    held, turns = edge.labels[0].link, plot.rates["velocity"]
    # seen from a link that turns itself as seen from the held one, the rest has another share of Coriolis
    read = seen.slip_mm(Symbol("v", seen.label(moving)), slip)
    speed = unit(slip) * read * plot.scales.velocity / plot.scales.acceleration if slip else 0j
    more = 2j * (turns[edge.held].value - turns[held].value) * speed
    rest = way * seen.end("acceleration", moving) + more
    coriolis = 2j * turns[held].value * speed
    parts = [Component(symbol_of(plot, "ar", edge), "sliding", unit(rest or 1.0), rest, edge.direction)]
    if held not in plot.still:
        symbol = symbol_of(plot, "v", edge)
        size = RateTimes("omega", (held,), symbol, twice=True)
        parts.insert(0, Component(
            symbol_of(plot, "ak", edge), "coriolis", unit(coriolis or 1.0), coriolis, edge.direction, size
        ))  # fmt: skip
    return parts


def _slip_read(plot: Polygons, edge: Edge) -> tuple[complex, float]:
    """The relative velocity of an edge's ends as drawn (mm), and its size as read (m/s)."""
    slip = plot.end("velocity", edge.end) - plot.end("velocity", edge.start)
    return slip, plot.slip_mm(symbol_of(plot, "v", edge), slip) * plot.scales.velocity


def _slide_parts(plot: Polygons, order: Order, edge: Edge, slide: Pair) -> list[Component]:
    sense = plot.paper.poses[slide.b].axis * slide.guide.direction * (1 if edge.forward else -1)
    given = _given(plot, slide.key, order)
    fixed = plot.fixed(edge.start)
    role: Literal["resultant", "relative"] = "resultant" if fixed else "relative"
    if order == "velocity":
        span = None if given is None else sense * (given / plot.scales.velocity)
        return [Component(symbol_of(plot, "v", edge), role, sense, span, edge.direction, _given_size(span))]
    span = None if given is None else sense * (given / plot.scales.acceleration)
    bent = _bent_parts(plot, edge, slide, sense)
    if (slide.b in plot.still or slide.a in plot.still) and not bent:
        # no rotation, no Coriolis: the sliding part is all there is
        symbol = symbol_of(plot, "a", edge) if fixed else symbol_of(plot, "ar", edge)
        return [
            Component(symbol, "resultant" if fixed else "sliding", sense, span, edge.direction, _given_size(span))
        ]
    omega = plot.rates["velocity"][slide.b].value
    slip, speed = _slip_read(plot, edge)
    size = 2 * omega * (speed if dot(slip, sense) >= 0 else -speed) / plot.scales.acceleration
    coriolis = Component(
        symbol_of(plot, "ak", edge),
        "coriolis",
        1j * sense,
        1j * sense * size,
        Direction("turned", edge.direction.names),
        RateTimes("omega", (slide.b,), symbol_of(plot, "v", edge), twice=True),
    )
    sliding = Component(symbol_of(plot, "ar", edge), "sliding", sense, span, edge.direction, _given_size(span))
    return [coriolis, *bent, sliding]


def _contact_parts(plot: Polygons, order: Order, edge: Edge) -> list[Component]:
    """The material point of one body at a contact relative to that of the other: slip along the tangent; with the term
    of Coriolis, and along the normal what the curvatures of both outlines give."""
    one, two = (ref.link for ref in edge.labels)
    contact, place, normal = plot.contact(edge.contact)
    touching = Touching(plot.structure.scene, plot.paper.mm, plot.paper.poses)
    plot.board.notice(order, Remark("at contact", (contact.name,)))
    tangent = -1j * normal
    fixed = plot.fixed(edge.start)
    role: Literal["resultant", "relative"] = "resultant" if fixed else "relative"
    if order == "velocity":
        return [Component(symbol_of(plot, "v", edge), role, tangent, None, edge.direction)]
    centres = dict(zip((d.link for d in contact.round), touching.centres(contact), strict=True))
    # 1/m, positive where the centre of curvature lies on the side of the normal
    bends = [plot.paper.mm / dot(centres[n] - place, normal) if n in centres else 0.0 for n in (one, two)]
    omega, other = (plot.rates["velocity"][n].value for n in (one, two))
    slip, speed = _slip_read(plot, edge)
    speed = speed if dot(slip, tangent) >= 0 else -speed
    turning = other - omega
    off = turning * speed - (turning - bends[0] * speed) * (turning - bends[1] * speed) / (bends[0] - bends[1])
    velocity = symbol_of(plot, "v", edge)
    if one in centres:
        size: RateTimes | OffCurves = OffCurves(velocity, (two, one), two in centres)
    else:
        size = RateTimes("omega", (two, one), (contact.round[0].centre, contact.name), square=True)
    way, square = Direction("turned", edge.direction.names), Direction("along", ("n-n",))
    per = plot.scales.acceleration
    coriolis = Component(
        symbol_of(plot, "ak", edge), "coriolis", normal, normal * (2 * omega * speed / per), way,
        RateTimes("omega", (one,), velocity, twice=True),
    )  # fmt: skip
    curved = Component(symbol_of(plot, "an", edge), "normal", normal, normal * (off / per), square, size)
    sliding = Component(symbol_of(plot, "ar", edge), "sliding", tangent, None, edge.direction)
    return [*([] if one in plot.still else [coriolis]), curved, sliding]


def _rolling_parts(plot: Polygons, order: Order, edge: Edge) -> list[Component]:
    """The material point of one link where it rolls relative to that of the other: they have one velocity, and their
    accelerations differ along the normal alone, by what the curvatures give."""
    if order == "velocity":
        return []
    one, two = (ref.link for ref in edge.labels)
    mm = plot.paper.mm
    place, normal, centres = Touching(plot.structure.scene, mm, plot.paper.poses).rolling_centres(edge.rolling)
    bends = [mm / dot(centres[n] - place, normal) if n in centres else 0.0 for n in (one, two)]
    turning = plot.rates["velocity"][two].value - plot.rates["velocity"][one].value
    span = normal * (turning**2 / (bends[1] - bends[0]) / plot.scales.acceleration)
    links = tuple(n for n in (two, one) if n not in plot.still) or (two,)
    letter = edge.start.point
    if len(centres) == 1:
        ((link, centre),) = centres.items()
        names = plot.centre_letter(edge.rolling, link), letter
        size: RateTimes | RollingCurves = RateTimes("omega", links, names, square=True)
        way = Direction("towards", names if dot(span, place - centre) > 0 else names[::-1])
    else:
        inside = bends[0] * bends[1] > 0.0
        pair = (one, two) if not inside or abs(bends[0]) > abs(bends[1]) else (two, one)
        size, way = RollingCurves(links, pair, inside, abs(1.0 / (bends[1] - bends[0]))), edge.direction
    if plot.fixed(edge.start):
        return [Component(symbol_of(plot, "a", edge), "resultant", unit(span or normal), span, way, size)]
    return [Component(symbol_of(plot, "an", edge), "normal", unit(span or normal), span, way, size)]


def _bent_parts(plot: Polygons, edge: Edge, slide: Pair, sense: complex) -> list[Component]:
    """The normal part that a curved guide adds: the square of the sliding velocity over the radius of curvature,
    towards the centre of curvature of the guide; against the guide's motion it is turned round."""
    bends = slide.guide.curvature
    if bends == 0.0:
        return []
    _, speed = _slip_read(plot, edge)
    inward = 1j * sense * (1 if bends > 0.0 else -1)
    span = inward * (speed**2 * abs(bends) / plot.scales.acceleration)
    size = SquareOverRadius(symbol_of(plot, "v", edge), 1.0 / abs(bends))
    plot.board.notice("acceleration", Remark("at pitch curve", (edge.start.point,)))
    way = Direction("turned", edge.direction.names)
    return [Component(symbol_of(plot, "an", edge), "normal", inward, span, way, size)]


def _given(plot: Polygons, key: str, order: Order) -> float | None:
    """Rate of a driven slide, or of one that is moved at a trial speed."""
    if (order, key) in plot.tried:
        return plot.tried[order, key]
    rates = plot.given.get(key)
    return None if rates is None else rates[0 if order == "velocity" else 1]


def _weld_parts(plot: Polygons, order: Order, edge: Edge, weld: Weld) -> list[Component]:
    """A point of a link that a driver turns about a hinge of another link, relative to that link."""
    hinge = weld.pair.point
    arm = plot.places[edge.end.point] - plot.places[hinge]
    way = 1 if edge.forward else -1
    speed, rate = plot.given[weld.driver.key]
    omega, alpha = way * _turn_sign(weld) * speed, way * _turn_sign(weld) * rate
    name = (hinge, edge.end.point)
    arm_m = plot.length(arm, name)
    square = 1j * unit(arm)
    if order == "velocity":
        span = square * (omega * arm_m / plot.scales.velocity)
        size = RateTimes("omega", (weld.b, weld.a), name)
        return [Component(symbol_of(plot, "v", edge), "relative", square, span, edge.direction, size)]
    base = weld.a if edge.forward else weld.b
    turn = plot.rates["velocity"][base].value
    per = arm_m / plot.scales.acceleration
    inward = -unit(arm)
    return [
        Component(
            symbol_of(plot, "an", edge),
            "normal",
            inward,
            inward * (omega**2 * per),
            Direction("towards", name[::-1]),
            RateTimes("omega", (weld.b, weld.a), name, square=True),
        ),
        Component(
            symbol_of(plot, "at", edge),
            "tangential",
            square,
            square * (alpha * per),
            edge.direction,
            RateTimes("alpha", (weld.b, weld.a), name),
        ),
        Component(
            symbol_of(plot, "ak", edge),
            "coriolis",
            inward,
            inward * (2 * turn * omega * per),
            Direction("along", name),
            RateTimes("omega", (base,), symbol_of(plot, "v", edge), twice=True),
        ),
    ]


def _bar(edge: Edge) -> tuple[str, str]:
    return edge.start.point, edge.end.point


def _given_size(span: complex | None) -> Given | None:
    return None if span is None else Given()


def _turn_sign(weld: Weld) -> int:
    """+1 where the driver's angle is that of b from a."""
    return 1 if weld.driver.link == weld.b else -1
