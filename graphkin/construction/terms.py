"""The terms of one relative motion in a vector equation: what is known of each, and how a student knows it."""

from __future__ import annotations

from typing import Literal

from graphkin.construction.net import Edge
from graphkin.construction.polygon_pair import Order, Plot, letter
from graphkin.construction.remarks import AtContact
from graphkin.construction.sizes import Direction, Given, OffCurves, RateTimes, RollingCurves, SquareOverRadius
from graphkin.construction.slip import Component
from graphkin.construction.touching import Touching
from graphkin.plane import dot, unit
from graphkin.scene.model import AngleDriver
from graphkin.scene.symbol import Symbol
from graphkin.structure import Slide, Weld

__all__ = ["bar", "parts_of", "symbol_of", "turn_sign"]


def parts_of(plot: Plot, order: Order, edge: Edge) -> list[Component]:
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


def symbol_of(plot: Plot, kind: str, edge: Edge) -> Symbol:
    start, end = plot.label(edge.labels[0]), plot.label(edge.labels[1])
    if kind in ("v", "a") and plot.fixed(edge.start):
        return Symbol(kind, plot.label(edge.end))
    return Symbol(kind, end, start)


def _rigid_parts(plot: Plot, order: Order, edge: Edge) -> list[Component]:
    arm = plot.places[edge.end.point] - plot.places[edge.start.point]
    if edge.link in plot.still:
        return []
    square = 1j * unit(arm)
    name = bar(edge)
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


def _tied_parts(plot: Plot, order: Order, edge: Edge) -> list[Component]:
    """The special point of one link relative to that of another, as its own polygon gave it: nothing where they move
    alike."""
    span = plot.ties[order, edge.end.point] * (1 if edge.forward else -1)
    if span == 0.0:
        return []
    return [Component(symbol_of(plot, letter(order), edge), "relative", unit(span), span, edge.direction)]


def _contour_parts(plot: Plot, order: Order, edge: Edge) -> list[Component]:
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


def _slip_read(plot: Plot, edge: Edge) -> tuple[complex, float]:
    """The relative velocity of an edge's ends as drawn (mm), and its size as read (m/s)."""
    slip = plot.end("velocity", edge.end) - plot.end("velocity", edge.start)
    return slip, plot.slip_mm(symbol_of(plot, "v", edge), slip) * plot.scales.velocity


def _slide_parts(plot: Plot, order: Order, edge: Edge, slide: Slide) -> list[Component]:
    sense = plot.frame.poses[slide.b].axis * slide.guide.direction * (1 if edge.forward else -1)
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


def _contact_parts(plot: Plot, order: Order, edge: Edge) -> list[Component]:
    """The material point of one body at a contact relative to that of the other: slip along the tangent; with the term
    of Coriolis, and along the normal what the curvatures of both outlines give."""
    one, two = (ref.link for ref in edge.labels)
    contact, place, normal = plot.contact(edge.contact)
    touching = Touching(plot.structure.scene, plot.frame.mm, plot.frame.poses)
    plot.board.notice(order, AtContact(contact.name))
    tangent = -1j * normal
    fixed = plot.fixed(edge.start)
    role: Literal["resultant", "relative"] = "resultant" if fixed else "relative"
    if order == "velocity":
        return [Component(symbol_of(plot, "v", edge), role, tangent, None, edge.direction)]
    centres = dict(zip((d.link for d in contact.round), touching.centres(contact), strict=True))
    # 1/m, positive where the centre of curvature lies on the side of the normal
    bends = [plot.frame.mm / dot(centres[n] - place, normal) if n in centres else 0.0 for n in (one, two)]
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


def _rolling_parts(plot: Plot, order: Order, edge: Edge) -> list[Component]:
    """The material point of one link where it rolls relative to that of the other: they have one velocity, and their
    accelerations differ along the normal alone, by what the curvatures give."""
    if order == "velocity":
        return []
    one, two = (ref.link for ref in edge.labels)
    mm = plot.frame.mm
    place, normal, centres = Touching(plot.structure.scene, mm, plot.frame.poses).rolling_centres(edge.rolling)
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


def _bent_parts(plot: Plot, edge: Edge, slide: Slide, sense: complex) -> list[Component]:
    """The normal part that a curved guide adds: the square of the sliding velocity over the radius of curvature,
    towards the centre of curvature of the guide; against the guide's motion it is turned round."""
    bends = slide.guide.curvature
    if bends == 0.0:
        return []
    _, speed = _slip_read(plot, edge)
    inward = 1j * sense * (1 if bends > 0.0 else -1)
    span = inward * (speed**2 * abs(bends) / plot.scales.acceleration)
    size = SquareOverRadius(symbol_of(plot, "v", edge), 1.0 / abs(bends))
    plot.board.notice("acceleration", AtContact(edge.start.point, True))
    way = Direction("turned", edge.direction.names)
    return [Component(symbol_of(plot, "an", edge), "normal", inward, span, way, size)]


def _given(plot: Plot, key: str, order: Order) -> float | None:
    """Rate of a driven slide, or of one that is moved at a trial speed."""
    if (order, key) in plot.tried:
        return plot.tried[order, key]
    rates = plot.given.get(key)
    return None if rates is None else rates[0 if order == "velocity" else 1]


def _weld_parts(plot: Plot, order: Order, edge: Edge, weld: Weld) -> list[Component]:
    """A point of a link that a driver turns about a hinge of another link, relative to that link."""
    hinge = weld.pair.point  # type: ignore[union-attr]
    arm = plot.places[edge.end.point] - plot.places[hinge]
    way = 1 if edge.forward else -1
    speed, rate = plot.given[weld.driver.key]
    omega, alpha = way * turn_sign(weld) * speed, way * turn_sign(weld) * rate
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


def bar(edge: Edge) -> tuple[str, str]:
    return edge.start.point, edge.end.point


def _given_size(span: complex | None) -> Given | None:
    return None if span is None else Given()


def turn_sign(weld: Weld) -> int:
    """+1 where the driver's angle is that of b from a."""
    assert isinstance(weld.driver, AngleDriver)
    return 1 if weld.driver.link == weld.b else -1
