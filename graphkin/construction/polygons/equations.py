"""Vector equations of relative motions: the known parts of each term, with their reasons; and their drawing.

The known vectors of each side of an equation are laid off in order.  With no unknown size, the last vector ends in the
wanted end point; with one, its vector joins two drawn end points; with two, lines along them cross in the end point.
The angular rates follow from the found vectors (sources: see `polygons`).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Literal

from graphkin.construction.board.sheet import Equation, Rate
from graphkin.construction.board.steps import (
    GIVEN,
    ORDERS,
    PARTS,
    Bar,
    Direction,
    Mark,
    Order,
    Ray,
    Size,
    Step,
    Term,
    Vector,
    changed,
)
from graphkin.construction.polygons.polygons import RATE, Polygons, letter
from graphkin.construction.polygons.vector_graph import (
    RelativeMotion,
    VectorChain,
    contacts_of,
    links_alike,
    node,
)
from graphkin.plane import added_up, cross, dot, unit
from graphkin.scene.pairs import Pair
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Driven, DrivenJoint, Dyad, Element, LargerGroup
from graphkin.words.written import MOST

Side = list[tuple[RelativeMotion, list[Term]]]


# links that turn alike


def same_turn(plot: Polygons, group: Dyad | LargerGroup) -> dict[str, str]:
    """For each link of a group a link with the same rotation up to given ones: a known link if there is any, no block
    of a contact that is drawn itself."""
    names, alike = group.members, links_alike(group.members, turned(plot, None, group))
    without = {c.block for c in contacts_of(plot.structure, group)} if plot.at_contacts else set()
    # links of the group that are not of a contour turn as unknown as its own
    known = {plot.ground} if plot.held else set().union(*alike.values()).difference(names)
    return {n: min(alike[n] & known or alike[n].intersection(names) - without, default=n) for n in names}


def turned(plot: Polygons, order: Order | None, group: Dyad | LargerGroup) -> list[tuple[str, str, float]]:
    """Links a and b of a group that turn alike up to a given rate: (a, b, the rate of b from a); without an order only
    the links."""
    whole = plot.part_of or group
    pairs = [(p.a, p.b, 0.0) for p in whole.all_pairs if not p.turns]
    for d in whole.drivers:
        if d.turns:
            pairs.append((d.relative_to, d.link, plot.given[order, d.key] if order else 0.0))
    for held, rest in plot.contours.get(group, ()) if isinstance(group, LargerGroup) else ():
        seen = plot.seen[held].rates[order] if order and held in plot.seen else {}
        pairs += [(held, n, seen[n].value if n in seen else 0.0) for n in rest.members if not order or n in seen]
    return pairs


def known_turns(plot: Polygons, order: Order, group: Dyad | LargerGroup) -> None:
    """Links that share their rotation with a known link."""
    for name, other in same_turn(plot, group).items():
        if other in plot.rates[order] and name not in plot.rates[order]:
            spread(plot, order, other, group)


def share_rate(plot: Polygons, order: Order, known: str, name: str, add: float = 0.0) -> None:
    """The rate of a link that turns as a known one does, or faster by ``add`` (rad/s, rad/s2)."""
    rate = plot.rates[order][known]
    plot.rates[order][name] = changed(rate, link=name, value=rate.value + add, same_as=rate.same_as or known)


def add_rates(plot: Polygons, order: Order, link: str, links: tuple[str, str], known: float, add: float) -> None:
    """Find the rate of a link from that of a ``known`` link and the rate ``add`` between the two (rad/s, rad/s2),
    omega_2 = omega_1 + omega_21; relative to a link that stands still it needs no finding.  ``links`` are the known
    link, and that of the two which turns relative to the other."""
    if links[0] != plot.ground:
        step = Step("read", "sum of rates", order, kind=RATE[order], link=link, links=links, value=known, other=add)
        plot.do(step)


def spread(plot: Polygons, order: Order, start: str, group: Dyad | LargerGroup) -> None:
    """Carry a known rotation to all links that slide on each other or are held by drivers."""
    pairs = turned(plot, order, group)
    queue = [start]
    while queue:
        at = queue.pop(0)
        for a, b, add in pairs:
            for known, new, more in ((a, b, add), (b, a, -add)):
                if known == at and new not in plot.rates[order]:
                    share_rate(plot, order, at, new, more)
                    is_told = add != 0.0
                    if a in plot.seen and b in plot.seen[a].rates[order]:  # not where it just turns as a third does
                        seen = plot.seen[a].rates[order]
                        is_told = not seen[b].same_as or seen[seen[b].same_as].value != seen[b].value
                    if is_told:
                        add_rates(plot, order, new, (at, b), plot.rates[order][at].value, add)
                    queue.append(new)


# equations drawn


def _side_of(plot: Polygons, order: Order, path: Sequence[RelativeMotion]) -> Side:
    """The terms of each edge along one side of an equation."""
    return [(edge, [plot.own_values.term(part) for part in parts_of(plot, order, edge)]) for edge in path]


def _parts(side: Side) -> list[Term]:
    return [part for _, parts in side for part in parts]


def _open(side: Side) -> list[Term]:
    """The terms of unknown size."""
    return [part for part in _parts(side) if part.span is None]


def _written(side: Side) -> tuple[Term, ...]:
    return tuple(replace(part, along=0j, span=None) for part in _parts(side))


def _from_pole(plot: Polygons, order: Order, side: Side) -> tuple[Term, ...]:
    """A written side, with the vector from the pole to its start."""
    start = side[0][0].start
    first = () if plot.fixed(start) else (Term(plot.symbol(letter(order), start), True, True),)
    return (*first, *_written(side))


def _write(plot: Polygons, order: Order, element: Element, *sides: tuple[Term, ...]) -> int:
    """Write an equation; returns its number."""
    number = len(plot.board.equations) + 1
    plot.board.equations.append(Equation(number, order, sides, plot.part_of or element))
    return number


def draw_equation(plot: Polygons, order: Order, element: Element, equation: VectorChain) -> None:
    """Write a vector equation with no, one or two unknown sizes, draw it, and measure its rates.

    An identity of a single vector is not written.
    """
    if equation.base or (equation.link and not equation.is_special):
        assert isinstance(element, LargerGroup)
        _draw_vector(plot, order, element, equation)
        return
    end = equation.end
    whole = plot.symbol(letter(order), end)
    sides = [_side_of(plot, order, path) for path in equation.sides]
    stands = len(sides) == 1 and (plot.fixed(end) or end in plot.ends[order])
    terms = [_from_pole(plot, order, side) for side in sides]
    alone = [side for side in terms if [term.symbol for term in side] == [whole]]
    number: int | None = None
    if len(sides) > 1 or not alone or (not stands and any(term.size for term in alone[0])):
        heads = alone or [(Term(whole, stands, stands),)]
        number = _write(plot, order, element, *heads, *(side for side in terms if side not in alone))
    if len(sides) == 2:
        _cross(plot, order, end, sides, number)
    else:
        _close(plot, order, end, sides[0], number)
    for side in sides:
        if len(_open(side)) == 1:  # of several along one line only the sum is known
            for edge in (edge for edge, _ in side if edge.link and edge.unknown):
                if edge.link not in plot.rates[order]:
                    symbol = symbol_of(plot, "v" if order == "velocity" else "at", edge)
                    _rate(plot, order, edge, plot.drawn[order][symbol], element)


def turn_about(plot: Polygons, order: Order, element: Element, name: str, hinge: str) -> None:
    """Lay off the first points of a link that turns at a known rate about a hinge, if they are not drawn yet: one of
    its own, else those under sliding links on it."""
    points = [PointRef(p) for p in plot.links[name].points if p != hinge]
    slides = [s for s in plot.structure.slides if s.b == name and "/" not in name]
    under = [node(plot.links, s.pin, name) for s in slides if s.pin in plot.places]
    away = [n for n in (*points, *under) if abs(plot.places[n.point] - plot.places[hinge]) > plot.tiny]
    for end in dict.fromkeys(away[:1] if any(n in points for n in away) else away):
        if end not in plot.ends[order]:
            arm = RelativeMotion.of_link(PointRef(hinge), end, name)
            draw_equation(plot, order, element, VectorChain.closing(arm))


def _close(plot: Polygons, order: Order, end: PointRef, side: Side, equation: int | None) -> None:
    """Lay off the known vectors of a path; its unknown vector joins their end to a drawn end point."""
    parts = _parts(side)
    at = plot.end(order, side[0][0].start)
    if not _open(side):
        for edge, known in side:
            at = _lay_off(plot, order, known, at, equation)
            plot.reach(order, edge.end, at, equation)
        return
    open_at = parts.index(_open(side)[0])
    for part in parts[:open_at]:
        drawn = plot.drawn[order].get(part.symbol)
        at = drawn.tip if drawn is not None else _lay_off(plot, order, [part], at, equation)
    after = added_up((part.span for part in parts[open_at + 1 :] if part.span is not None), 0j)
    _fill(plot, order, side, plot.end(order, end) - after, at, equation)


def _cross(plot: Polygons, order: Order, end: PointRef, sides: Sequence[Side], equation: int | None) -> None:
    """Draw both sides of an equation up to their unknowns, and let these meet.

    A side may have several unknowns along one direction, as at a special point: their sum is found.
    """
    lines, carried = [], []
    for side in sides:
        parts = _parts(side)
        open_at = parts.index(_open(side)[0])
        before = _lay_off(plot, order, parts[:open_at], plot.end(order, side[0][0].start), equation)
        # known terms behind the unknown one are added first, and put in their place afterwards
        at = _carry(plot, order, parts[open_at + 1 :], before, equation)
        lines.append((at, parts[open_at]))
        carried.append(at - before)
    whole = plot.symbol(letter(order), end)
    intersection = _lines_meet(plot, order, whole, 0j, lines, equation)
    mark = Mark(plot.label(end), intersection)
    plot.do(Step("cross", "lines", order, (mark,), equation, ref=mark.ref))
    for side, (start, _), behind in zip(sides, lines, carried, strict=True):
        if len(_open(side)) == 1:
            _fill(plot, order, side, intersection - behind, start - behind, equation)
    plot.reach(order, end, intersection, equation)


def _carry(plot: Polygons, order: Order, parts: Iterable[Term], at: complex, equation: int | None) -> complex:
    """Add known vectors before their turn; returns their end."""
    for part in parts:
        if part.span is not None:
            bar = Bar(at, at + part.span, "")
            plot.do(Step("carry over", "before its turn", order, (bar,), equation, symbol=part.symbol,
                         size=part.size, mm=abs(part.span), direction=part.direction))
            at += part.span
    return at


def _lines_meet(
    plot: Polygons, order: Order, symbol: Symbol, tail: complex, lines: Sequence[tuple[complex, Term]],
    equation: int | None,
) -> complex:
    """Draw lines along two vectors of unknown size, each through a point; the vector ``symbol`` from ``tail`` ends at
    their crossing."""
    (p, left), (q, right) = ((at, plot.own_values.line(part.symbol, part.along)) for at, part in lines)
    intersection = plot.own_values.found(symbol, tail, plot.board.cross(order, p, left, q, right, symbol))
    for through, part in lines:
        ray = Ray(through, part.along, intersection, part.direction, part.symbol)
        plot.do(Step("line", "direction", order, (ray,), equation, symbol=part.symbol, direction=part.direction))
    return intersection


def _draw_vector(plot: Polygons, order: Order, group: LargerGroup, equation: VectorChain) -> None:
    """Draw an equation of two unknowns that leads to no end point: all known terms of each side in order, then the
    lines of the unknown ones, which cross at the tip of the read vector.

    It is the vector of a moving point relative to another, by two paths from the pole, since neither has a known start.
    Or it is the vector between joints of a link with two parallel legs: from one leg's known end square to the bar
    between the joints, from the other's along the direction that both leave free; it gives the rate of the link.
    """
    sides = [_side_of(plot, order, path) for path in equation.sides]
    if equation.base:
        symbol = plot.symbol(letter(order), equation.end, PointRef(equation.end.point, equation.base))
        special, ref = plot.seen_from(equation.base).ends[order], PointRef(equation.end.point)
        special[ref] = 0j
        if not any(part.span for side in sides for part in _parts(side)):
            return  # exactly: nothing drives a leg
        written = ((Term(symbol, False, False),), *map(_written, sides))
        begun = [(0j, _parts(side), _open(side)[0]) for side in sides]
    else:
        (side,) = sides
        rate = "angle", same_turn(plot, group).get(equation.link, equation.link)
        open_ends = [(edge, part) for edge, parts in side for part in parts if part.span is None]
        bar, turning = next((e, p) for e, p in open_ends if e.link == equation.link and e.unknown == rate)
        free = [part for edge, part in open_ends if edge is not bar][-1]  # both legs leave that free
        symbol, end = turning.symbol, plot.end(order, equation.end)
        written = (Term(plot.symbol(letter(order), equation.end), True, True),), _from_pole(plot, order, side)
        begun = [(plot.end(order, side[0][0].start), _parts(side), turning), (end, [], free)]
    number = _write(plot, order, group, *written)
    lines = [(_carry(plot, order, (part for part in parts if part.span), at, number), unknown)
             for at, parts, unknown in begun]
    tail = 0j if equation.base else lines[0][0]
    at = _lines_meet(plot, order, symbol, tail, lines, number)
    vector = Vector(symbol, tail, at, aid=True, trial=plot.trial)
    mm = plot.found_mm(symbol, vector.span)
    plot.do(Step("read", "vector", order, (vector,), number, symbol=symbol, mm=mm))
    if equation.base:
        special[ref] = vector.span
    else:
        _rate(plot, order, bar, vector, group)


def _lay_off(plot: Polygons, order: Order, parts: Iterable[Term], at: complex, equation: int | None) -> complex:
    """Lay off known vectors, each from the tip of the one before; returns the last tip."""
    for part in parts:
        assert part.span is not None
        tail, mm = at, abs(part.span)
        at = plot.board.instrument.laid_off(tail, part.span)
        plot.board.notice(order, "zero vector", symbol=part.symbol, mm=mm)
        step = Step("lay off", part.role, order, (), equation, symbol=part.symbol, size=part.size, mm=mm,
                    direction=part.direction)
        plot.record(Vector(part.symbol, tail, at, part.role), step)
    return at


def _fill(plot: Polygons, order: Order, side: Side, tip: complex, tail: complex, equation: int | None) -> None:
    """Draw the found vector of a side, and the end points along the side."""
    at = plot.end(order, side[0][0].start)
    for edge, parts in side:
        for part in parts:
            if part.span is None:
                vector = Vector(part.symbol, tail, plot.own_values.found(part.symbol, tail, tip), part.role)
                span = vector.tip - tail
                plot.board.notice(order, "zero vector", symbol=part.symbol, mm=abs(span))
                mm = plot.found_mm(part.symbol, span)
                plot.record(vector, Step("read", "vector", order, (), equation, symbol=part.symbol, mm=mm))
                at = tip
            else:
                if part.symbol not in plot.drawn[order]:
                    moved = Vector(part.symbol, at, at + part.span, part.role)
                    plot.record(moved, Step("join", "put back", order, (), equation, symbol=part.symbol))
                at = plot.drawn[order][part.symbol].tip
        if edge is not side[-1][0]:
            plot.reach(order, edge.end, at, equation)


def _rate(plot: Polygons, order: Order, edge: RelativeMotion, vector: Vector, group: Element) -> None:
    """Measure the angular rate of a link from a vector between two of its points and the bar that joins them:
    omega = v / l, alpha = a_t / l (sources: see `polygons`)."""
    bar, symbol, span = edge.bar, vector.symbol, vector.span
    arm = plot.places[edge.end.point] - plot.places[edge.start.point]
    # in a trial the ends need not meet: only the part square to the bar turns it
    mm = abs(cross(arm, span) / abs(arm) if plot.trial else span)
    hand, rate = plot.board.instrument, RATE[order]
    read = abs(hand.read(mm) if plot.trial else plot.board.read(symbol, mm))
    size = hand.noted(read * plot.per[order] / plot.length(arm, bar), read, carried=MOST - 1)
    value = size if cross(arm, span) >= 0 else -size
    believed = plot.own_values.rate(Symbol(rate, link=edge.link), value)
    if believed is not None:
        plot.believed.add((order, edge.link))
    source = symbol if symbol in plot.drawn[order] else None
    length = abs(arm) * plot.scales.length
    plot.rates[order][edge.link] = Rate(edge.link, value if believed is None else believed, source, read, length)
    plot.do(Step("read", "rate", order, kind=rate, link=edge.link, symbol=symbol, points=bar, value=value, mm=read,
                 held=plot.held))
    assert not isinstance(group, Driven)
    spread(plot, order, edge.link, group)


# terms


def parts_of(plot: Polygons, order: Order, edge: RelativeMotion) -> list[Term]:
    """The terms of the motion of an edge's end relative to its start, in order; in acceleration with the velocities
    drawn.  A term of unknown size has no ``span``, those of others are in mm on paper.

    Raises
    ------
    Unsolvable : "not drawn": a length that is too short to be read
    """
    if edge.joint is not None:
        return _driven_joint_parts(plot, order, edge, edge.joint)
    if edge.contact:
        return _contact_parts(plot, order, edge)
    if edge.rolling:
        return _rolling_parts(plot, order, edge)
    if edge.special:
        # as a polygon of its own gave it: nothing where both special points move alike
        base, sense = (edge.labels[0].link, 1) if edge.forward else (edge.labels[1].link, -1)
        span = plot.seen[base].ends[order][PointRef(edge.end.point)] * sense
        return [_term(plot, edge, letter(order), unit(span), abs(span), edge.direction)] if span else []
    if edge.held:
        return _contour_parts(plot, order, edge)
    if edge.slide is not None:
        return _slide_parts(plot, order, edge, edge.slide)
    return _rigid_parts(plot, order, edge)


def symbol_of(plot: Polygons, kind: str, edge: RelativeMotion) -> Symbol:
    """The symbol of an edge's motion, of its end relative to its start, or of a part of it."""
    if kind in ("v", "a") and plot.fixed(edge.start):
        return plot.symbol(kind, edge.end)
    return plot.symbol(kind, edge.labels[1], edge.labels[0])


def _term(
    plot: Polygons, edge: RelativeMotion, kind: str, along: complex, mm: float | None, written: Direction,
    size: Size | None = None,
) -> Term:
    """A term of an edge.

    Parameters
    ----------
    kind : of its symbol: the whole velocity (v) or acceleration (a), or the part an, at, ak, ar
    along : unit vector along it
    mm : its size on paper; None: unknown
    written : its direction as it is written
    size : the rule of its size
    """
    role = PARTS.get(kind) or ("resultant" if plot.fixed(edge.start) else "relative")
    span = None if mm is None else along * mm
    pair = "" if edge.slide is None else edge.slide.key
    return Term(symbol_of(plot, kind, edge), mm is not None, True, size, written, role=role, link=edge.link, pair=pair,
                along=along, span=span)


def _by_rate(
    plot: Polygons, links: tuple[str, ...], factor: tuple[str, str] | Symbol, rate: Literal["omega", "alpha"] = "omega",
    square: bool = False, twice: bool = False,
) -> Size:
    """The size that a rate gives; with a link held still a single link's rate is relative to it."""
    links = (*links, plot.held) if plot.held and len(links) == 1 else links
    return Size("rate", links, factor, rate, square, twice)


def _coriolis(plot: Polygons, edge: RelativeMotion, link: str, along: complex, mm: float, written: Direction) -> Term:
    """The term of Coriolis, 2 omega v_r: twice the rate of the ``link`` in which the edge's end moves times the
    relative velocity of the edge, directed as that velocity turned by 90 degrees in the sense of omega."""
    size = _by_rate(plot, (link,), symbol_of(plot, "v", edge), twice=True)
    return _term(plot, edge, "ak", along, mm, written, size)


def _rigid_parts(plot: Polygons, order: Order, edge: RelativeMotion) -> list[Term]:
    """Two points of one link at the distance l: v = omega l, square to the bar; a_n = omega^2 l towards the start, and
    a_t = alpha l, square to the bar."""
    if edge.link in plot.still:
        return []
    arm, per = plot.places[edge.end.point] - plot.places[edge.start.point], plot.per[order]
    along, bar = unit(arm), edge.bar
    square = 1j * along
    rate = None if edge.unknown else plot.rates[order].get(edge.link)
    rule = None if rate is None else _by_rate(plot, (edge.link,), bar, RATE[order])
    if order == "velocity":
        mm = None if rate is None else rate.value * plot.length(arm, bar) / per
        return [_term(plot, edge, "v", square, mm, edge.direction, rule)]
    squared = _by_rate(plot, (edge.link,), bar, square=True)
    omega, length = plot.rates["velocity"][edge.link].value, plot.length(arm, bar)
    normal = _term(plot, edge, "an", -along, omega**2 * length / per, Direction("towards", bar[::-1]), squared)
    if rate is not None and rate.value == 0.0:
        return [normal]
    mm = None if rate is None else rate.value * length / per
    return [normal, _term(plot, edge, "at", square, mm, edge.direction, rule)]


def _driven_joint_parts(plot: Polygons, order: Order, edge: RelativeMotion, joint: DrivenJoint) -> list[Term]:
    """A point of a link that a driver turns about a hinge of another link, at the distance l from it, relative to that
    link: v_r = omega_r l; a_n = omega_r^2 l towards the hinge, a_t = alpha_r l, and 2 omega omega_r l of Coriolis
    towards the hinge, omega being the other link's."""
    hinge, per = joint.pair.point, plot.per[order]
    arm = plot.places[edge.end.point] - plot.places[hinge]
    # whether the driver turns the end from the start
    sense = 1 if (joint.driver.link == joint.b) == edge.forward else -1
    omega, alpha = (sense * plot.given[each, joint.driver.key] for each in ORDERS)
    name, both = (hinge, edge.end.point), (joint.b, joint.a)
    length, square = plot.length(arm, name), 1j * unit(arm)
    if order == "velocity":
        return [_term(plot, edge, "v", square, omega * length / per, edge.direction, _by_rate(plot, both, name))]
    base = joint.a if edge.forward else joint.b
    turn, inward = plot.rates["velocity"][base].value, -unit(arm)
    squared = _by_rate(plot, both, name, square=True)
    return [
        _term(plot, edge, "an", inward, omega**2 * length / per, Direction("towards", name[::-1]), squared),
        _term(plot, edge, "at", square, alpha * length / per, edge.direction, _by_rate(plot, both, name, "alpha")),
        _coriolis(plot, edge, base, inward, 2 * turn * omega * length / per, Direction("along", name)),
    ]


def _contour_parts(plot: Polygons, order: Order, edge: RelativeMotion) -> list[Term]:
    """The point of one link of a contour relative to that of another, as a polygon with one of them held still gave it;
    with the Coriolis term of the held link's turning: a = a_r + 2 omega v_r.  Seen from another link the relative
    acceleration is a_r + 2 (omega_held - omega) v_r."""
    seen = plot.seen_from(edge.held)
    sense, moving = (1, edge.end) if edge.forward else (-1, edge.start)
    slip = sense * seen.end("velocity", moving)
    if order == "velocity":
        return [_term(plot, edge, "v", unit(slip or 1.0), abs(slip), edge.direction)]
    held, turns = edge.labels[0].link, plot.rates["velocity"]
    # seen from a link that turns itself as seen from the held one, the rest has another share of Coriolis
    read = seen.slip_mm(seen.symbol("v", moving), slip)
    speed = unit(slip) * read * plot.scales.velocity / plot.scales.acceleration if slip else 0j
    rest = sense * seen.end("acceleration", moving) + 2j * (turns[edge.held].value - turns[held].value) * speed
    coriolis = 2j * turns[held].value * speed
    parts = [_term(plot, edge, "ar", unit(rest or 1.0), abs(rest), edge.direction)]
    if held not in plot.still:
        parts.insert(0, _coriolis(plot, edge, held, unit(coriolis or 1.0), abs(coriolis), edge.direction))
    return parts


def _slip_read(plot: Polygons, edge: RelativeMotion, sense: complex) -> tuple[float, float]:
    """The relative velocity of an edge's ends as read (m/s): its size, and its component along a sense."""
    slip = plot.end("velocity", edge.end) - plot.end("velocity", edge.start)
    speed = plot.slip_mm(symbol_of(plot, "v", edge), slip) * plot.scales.velocity
    return speed, speed if dot(slip, sense) >= 0 else -speed


def _slide_parts(plot: Polygons, order: Order, edge: RelativeMotion, slide: Pair) -> list[Term]:
    """Both sides of a sliding pair: v_r and a_r along the guide, of given or unknown size, and 2 omega v_r of Coriolis
    square to it, omega being the guide's; a curved guide adds v_r^2 / rho towards its centre of curvature."""
    sense = slide.along(plot.paper.poses) * (1 if edge.forward else -1)
    given, per = plot.given.get((order, slide.key)), plot.per[order]
    mm, size = (None, None) if given is None else (given / per, GIVEN)
    if order == "velocity":
        return [_term(plot, edge, "v", sense, mm, edge.direction, size)]
    bends = slide.guide.curvature
    if {slide.a, slide.b} & plot.still and not bends:  # no rotation, no Coriolis
        return [_term(plot, edge, "a" if plot.fixed(edge.start) else "ar", sense, mm, edge.direction, size)]
    speed, signed = _slip_read(plot, edge, sense)
    turned = Direction("turned", edge.direction.names)
    omega = plot.rates["velocity"][slide.b].value
    parts = [_coriolis(plot, edge, slide.b, 1j * sense, 2 * omega * signed / per, turned)]
    if bends:  # against the guide's motion it is turned round
        rule = Size("over radius", factor=symbol_of(plot, "v", edge), radius=1.0 / abs(bends))
        inward = 1j * sense * (1 if bends > 0.0 else -1)
        parts.append(_term(plot, edge, "an", inward, speed**2 * abs(bends) / per, turned, rule))
        plot.board.notice("acceleration", "at pitch curve", point=edge.start.point)
    return [*parts, _term(plot, edge, "ar", sense, mm, edge.direction, size)]


def _contact_parts(plot: Polygons, order: Order, edge: RelativeMotion) -> list[Term]:
    """The material point of one body at a contact relative to that of the other: the slip v_r along the tangent, and
    a_r; with 2 omega_1 v_r of Coriolis, and along the normal the term by the curvatures k of both outlines.

    With w = omega_2 - omega_1 that is w v_r - (w - k_1 v_r) (w - k_2 v_r) / (k_1 - k_2): the contact runs along the
    outlines at rates that differ by the slip, their tangents turn by w relative to each other, and its acceleration is
    the same seen from either body.
    """
    link, other_link = (ref.link for ref in edge.labels)
    touch = plot.touch(edge.contact)
    plot.board.notice(order, "at contact", contact=touch.name)
    normal, tangent, per = touch.normal, -1j * touch.normal, plot.per[order]
    if order == "velocity":
        return [_term(plot, edge, "v", tangent, None, edge.direction)]
    bends = touch.curvatures((link, other_link), plot.paper.mm)
    omega, other = (plot.rates["velocity"][n].value for n in (link, other_link))
    _, speed = _slip_read(plot, edge, tangent)
    turning = other - omega
    difference = turning * speed - (turning - bends[0] * speed) * (turning - bends[1] * speed) / (bends[0] - bends[1])
    if link in touch.centres:
        curves = (link, other_link) if other_link in touch.centres else (link,)
        size = Size("slip on curves", (other_link, link), symbol_of(plot, "v", edge), curves=curves)
    else:
        size = _by_rate(plot, (other_link, link), (touch.centres[other_link][0], touch.name), square=True)
    turned = Direction("turned", edge.direction.names)
    parts = [
        _coriolis(plot, edge, link, normal, 2 * omega * speed / per, turned),
        _term(plot, edge, "an", normal, difference / per, Direction("along", ("n-n",)), size),
        _term(plot, edge, "ar", tangent, None, edge.direction),
    ]
    return parts[1:] if link in plot.still else parts


def _rolling_parts(plot: Polygons, order: Order, edge: RelativeMotion) -> list[Term]:
    """The material point of one link at the rolling contact relative to that of the other: they have the same velocity,
    and their accelerations differ along the normal alone, by w^2 / (k_2 - k_1) with the relative rate w and the
    curvatures k of both outlines: w times the velocity with which the pole moves (Bottema and Roth, Theoretical
    Kinematics, ch. VIII).
    """
    if order == "velocity":
        return []
    link, other_link = (ref.link for ref in edge.labels)
    touch = plot.touch(edge.rolling)
    bends = touch.curvatures((link, other_link), plot.paper.mm)
    turning = plot.rates["velocity"][other_link].value - plot.rates["velocity"][link].value
    length = turning**2 / (bends[1] - bends[0]) / plot.scales.acceleration
    along = touch.normal if length >= 0.0 else -touch.normal
    links = tuple(n for n in (other_link, link) if n not in plot.still) or (other_link,)
    if len(touch.centres) == 1:
        ((letter, centre),) = touch.centres.values()
        names = letter, edge.start.point
        size = _by_rate(plot, links, names, square=True)
        written = Direction("towards", names if length * dot(touch.normal, touch.at - centre) > 0 else names[::-1])
    else:
        inside = bends[0] * bends[1] > 0.0
        pair = (link, other_link) if not inside or abs(bends[0]) > abs(bends[1]) else (other_link, link)
        radius = abs(1.0 / (bends[1] - bends[0]))
        size, written = Size("rolling curves", links, curves=pair, hollow=inside, radius=radius), edge.direction
    return [_term(plot, edge, "a" if plot.fixed(edge.start) else "an", along, abs(length), written, size)]
