"""What driven links and dyads add to the polygons."""

from __future__ import annotations

from graphkin.construction.equations import (
    at_contacts,
    draw_equation,
    first_ends,
    known_turns,
    same_turn,
    share_rate,
)
from graphkin.construction.net import ClosingVector, Edge, Joined, TwoUnknowns, equation_of, node
from graphkin.construction.polygons import Polygons
from graphkin.construction.sheet import Rate
from graphkin.construction.sizes import Direction, Order
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import dot
from graphkin.scene.cams import LawCam
from graphkin.scene.model import Driver
from graphkin.scene.symbol import PointRef
from graphkin.structure import Driven, Dyad, Pair, Rolled
from graphkin.words import Phrase

__all__ = ["draw_element"]


def draw_element(plot: Polygons, order: Order, element: Driven | Dyad) -> None:
    """Draw what a driven link or a dyad adds to a polygon."""
    if isinstance(element, Driven):
        _driven(plot, order, element)
    else:
        known_turns(plot, order, element)
        if element not in plot.chains:
            plot.chains[element] = _found(plot, element)
        draw_equation(plot, order, element, plot.chains[element])
    for name in element.members:
        plot.complete(order, name)


def _driven(plot: Polygons, order: Order, element: Driven) -> None:
    name, driver, pair = element.link, element.driver, element.pair
    mm = _roll(plot, order, driver) if driver.rolls else 0.0
    rate = plot.given[driver.key][0 if order == "velocity" else 1]
    if isinstance(driver, Driver) and driver.turns:
        other, sign = (driver.relative_to, 1) if driver.link == name else (driver.link, -1)
        base = plot.rates[order][other].value
        plot.rates[order][name] = Rate(name, base + sign * rate, mm=mm)
    elif pair.turns:
        plot.rates[order][name] = Rate(name, rate, mm=mm)
    if pair.turns and name in plot.rates[order]:
        pivot = PointRef(pair.point)
        for end in first_ends(plot, name, pair.point):
            way = Direction("square", (pivot.point, end.point))
            draw_equation(plot, order, element, ClosingVector((Edge(pivot, end, (pivot, end), way, link=name),)))
        return
    known = pair.b if name == pair.a else pair.a
    share_rate(plot, order, known, name)
    point = pair.pin or next(iter([*plot.links[name].points, *plot.places]), "")
    if point:
        edge = _slide_edge(plot, pair, point)
        draw_equation(plot, order, element, ClosingVector((edge if name == pair.a else edge.reversed(),)))


def _roll(plot: Polygons, order: Order, driver: Driver | LawCam | Rolled) -> float:
    """The rate of what rolls, read off a velocity plan, as the driver's; and the length read for it (mm)."""
    coordinate = "angle" if driver.turns else "travel", driver.key
    which = 0 if order == "velocity" else 1
    turns = [(s.a, s.b, 0.0) for s in plot.structure.slides]
    turns += [(*d.links, d.values[1 + which]) for d in plot.structure.scene.drivers if d.turns]
    known = {name: rate.value for name, rate in plot.rates[order].items()}
    before = plot.wheels
    plot.wheels, value, mm = before.found(
        order, coordinate, known, lambda key: _travel_rate(plot, order, key), turns, plot.board.instrument
    )
    for step in plot.wheels.steps(before, order):
        plot.board.do(step)
    had = plot.given.get(driver.key, (0.0, 0.0))
    plot.given[driver.key] = (value, had[1]) if which == 0 else (had[0], value)
    return mm


def _travel_rate(plot: Polygons, order: Order, key: str) -> float | None:
    """How fast a sliding link goes along its guide (m/s, m/s2), where that is known: given, or read off the polygon
    as the part along it of its motion relative to the coincident point; that of Coriolis is square to it."""
    which = 0 if order == "velocity" else 1
    given = next((d for d in plot.structure.scene.drivers if d.key == key and not d.turns), None)
    if given is not None:
        return given.values[1 + which]
    slide = plot.structure.slide(key)
    if not {slide.a, slide.b} <= plot.rates[order].keys():
        return None
    point = slide.pin or next(iter(plot.links[slide.a].points), "")
    if not point:
        names = ", ".join((slide.a, slide.b))
        raise Unsolvable(
            "not drawn", Problem(Phrase("links", links=names), Phrase("no point of the sliding link is drawn"))
        )
    along = plot.paper.poses[slide.b].axis * slide.guide.direction
    slip = plot.end(order, node(plot.links, point, slide.a)) - plot.end(order, node(plot.links, point, slide.b))
    return dot(slip, along) * plot.scales.of(order)


def _slide_edge(plot: Polygons, slide: Pair, point: str) -> Edge:
    a, b = node(plot.links, point, slide.a), node(plot.links, point, slide.b)
    labels = (PointRef(point, slide.b), PointRef(point, slide.a))
    return Edge(b, a, labels, Direction("along", plot.guide_names(slide)), slide=slide)


def _found(plot: Polygons, dyad: Dyad) -> TwoUnknowns:
    welds = tuple(w for body in dyad.bodies for w in body.welds)
    pairs = (dyad.outer_first, dyad.inner, dyad.outer_second, *(w.pair for w in welds))
    slides = [p for p in pairs if not p.turns]
    joined = Joined(dyad.members, pairs, welds)
    chain = equation_of(
        plot.links,
        plot.ground,
        at_contacts(plot, dyad, joined),
        plot.places,
        {s.key: plot.guide_names(s) for s in slides},
        plot.ends["velocity"],
        same_turn(plot, dyad),
        plot.tiny,
    )
    if chain is None:
        # every dyad has an equation with two unknowns, but its points must be apart on the sheet
        names = ", ".join(dyad.links)
        raise Unsolvable(
            "not drawn",
            Problem(Phrase("links", links=names), Phrase("points of theirs fall together on any sheet")),
        )
    return chain
