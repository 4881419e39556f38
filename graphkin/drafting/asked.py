"""What a question needs: the elements on the way to it, and the vectors that only it asks for."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.drafting.chains import node
from graphkin.drafting.polygons import Order, Polygons
from graphkin.drafting.sheet import Vector
from graphkin.errors import CallError, Problem
from graphkin.plane import dot, unit
from graphkin.scene.model import AngleDriver
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Cluster, Driven, Element, Structure
from graphkin.words import Phrase

__all__ = ["needed", "show"]


def needed(structure: Structure, asked: Sequence[Symbol]) -> list[Element]:
    """The elements on the way to what is asked, in the order of solution; all of them if nothing is asked."""
    if not asked:
        return list(structure.elements)
    wanted: set[str] = set()
    for symbol in asked:
        wanted.update(_links_for(structure, symbol))
    kept: list[Element] = []
    for element in reversed(structure.elements):
        inside = _inside(element)
        if inside & wanted:
            kept.append(element)
            wanted |= _outside(element)
    return kept[::-1]


def _links_for(structure: Structure, symbol: Symbol) -> set[str]:
    if symbol.link:
        return {symbol.link}
    found: set[str] = set()
    for ref in (symbol.of, symbol.to):
        if ref is None:
            continue
        holders = [n for n, link in structure.links.items() if ref.point in link.points]
        if ref.link:
            found.add(ref.link)
        if not ref.link or ref.point not in structure.links[ref.link].points:
            # the pin itself must be placed too: by the first link of the order of solution that has it
            order = {n: i for i, e in enumerate(structure.elements) for n in _inside(e)}
            found.add(min(holders, key=lambda n: order.get(n, -1)))
    return found


def _inside(element: Element) -> set[str]:
    if isinstance(element, Driven):
        return {element.link}
    if isinstance(element, Cluster):
        return set(element.members)
    return {n for body in element.bodies for n in body.links}


def _outside(element: Element) -> set[str]:
    if isinstance(element, Driven):
        pairs, drivers = [element.pair], [element.driver]
    elif isinstance(element, Cluster):
        pairs, drivers = list(element.pairs), list(element.drivers)
    else:
        pairs, drivers = [element.outer_first, element.outer_second], []
    names = {n for pair in pairs for n in (pair.a, pair.b)}
    names |= {n for d in drivers if isinstance(d, AngleDriver) for n in (d.link, d.relative_to)}
    return names - _inside(element)


def show(polygons: Polygons, asked: Sequence[Symbol]) -> None:
    """Draw the vectors that are asked for and stand in no equation."""
    for symbol in asked:
        if symbol.is_vector:
            _show(polygons, symbol)


def _show(polygons: Polygons, symbol: Symbol) -> None:
    order: Order = "velocity" if symbol.kind == "v" else "acceleration"
    if symbol in polygons.drawn[order] or symbol.of is None:
        return
    of = _node(polygons, symbol.of)
    to = _node(polygons, symbol.to) if symbol.to else None
    if not _reachable(polygons, of) or (to and not _reachable(polygons, to)):
        return
    polygons.place(order, of)
    if to:
        polygons.place(order, to)
    ends = polygons.ends[order]
    tail, tip = (ends[to] if to else 0j), ends[of]
    if symbol.kind in ("v", "a"):
        _draw(polygons, order, Vector(symbol, tail, tip, "relative" if to else "resultant"))
    elif symbol.kind in ("an", "at"):
        _split(polygons, symbol, of, to)
    else:
        _coincident(polygons, symbol, of, to)


def _node(polygons: Polygons, ref: PointRef) -> PointRef:
    return node(polygons.links, ref.point, ref.link) if ref.link else ref


def _reachable(polygons: Polygons, ref: PointRef) -> bool:
    names = [ref.link] if ref.link else [n for n, k in polygons.links.items() if ref.point in k.points]
    return ref.point in polygons.places and any(n in polygons.rates["velocity"] for n in names)


def _draw(polygons: Polygons, order: Order, vector: Vector) -> None:
    polygons.drawn[order][vector.symbol] = vector
    polygons.board.do(order, Phrase("asked", (vector.symbol,)), vector)


def _split(polygons: Polygons, symbol: Symbol, of: PointRef, to: PointRef | None) -> None:
    """Normal and tangential part of a relative acceleration: along the bar and square to it."""
    if to is None:
        to = _pivot(polygons, of)
        polygons.place("acceleration", to)
    ends = polygons.ends["acceleration"]
    tail, tip = ends[to], ends[of]
    arm = polygons.places[of.point] - polygons.places[to.point]
    if abs(arm) <= polygons.tiny:
        raise CallError(
            Problem(
                str(symbol), "the two points coincide, no line joins them", "ask for ak and ar of coincident points"
            )
        )
    along = unit(arm)
    foot = tail + along * dot(tip - tail, along)
    if symbol.kind == "an":
        _draw(polygons, "acceleration", Vector(symbol, tail, foot, "normal"))
    else:
        _draw(polygons, "acceleration", Vector(symbol, foot, tip, "tangential"))


def _pivot(polygons: Polygons, of: PointRef) -> PointRef:
    names = [of.link] if of.link else [n for n, k in polygons.links.items() if of.point in k.points]
    ground = polygons.links[polygons.ground]
    for name in names:
        for point in polygons.links[name].points:
            if point in ground.points and point != of.point:
                return PointRef(point)
    raise CallError(
        Problem(
            f"{of}",
            "its link has no fixed pivot to which its normal points",
            "name the other point too, for example an_C/B",
        )
    )


def _coincident(polygons: Polygons, symbol: Symbol, of: PointRef, to: PointRef | None) -> None:
    """Coriolis and sliding part for two coincident points that stand in no equation."""
    assert to is not None
    pair = _pair(polygons, symbol)
    ends = polygons.ends["acceleration"]
    polygons.place("velocity", of)
    polygons.place("velocity", to)
    slip = polygons.ends["velocity"][of] - polygons.ends["velocity"][to]
    omega = polygons.rates["velocity"][pair].value
    corner = ends[to] + 2j * omega * slip * (polygons.scales.velocity / polygons.scales.acceleration)
    if symbol.kind == "ak":
        _draw(polygons, "acceleration", Vector(symbol, ends[to], corner, "coriolis"))
    else:
        _draw(polygons, "acceleration", Vector(symbol, corner, ends[of], "sliding"))


def _pair(polygons: Polygons, symbol: Symbol) -> str:
    """The guiding link of the sliding pair between two coincident points."""
    assert symbol.of is not None
    assert symbol.to is not None
    one = {symbol.of.link} if symbol.of.link else polygons_holders(polygons, symbol.of.point)
    two = {symbol.to.link} if symbol.to.link else polygons_holders(polygons, symbol.to.point)
    names = {polygons.block_of.get(n, n): n for n in polygons.links}
    for s in polygons.structure.slides:
        a, b = polygons.block_of.get(s.a, s.a), polygons.block_of.get(s.b, s.b)
        if symbol.of.point == symbol.to.point and ((a in one and b in two) or (b in one and a in two)):
            return names.get(s.b, s.b)
    raise CallError(
        Problem(
            str(symbol),
            "these two points do not lie on the two sides of a sliding pair",
            "known are " + ", ".join(s.key for s in polygons.structure.slides),
        )
    )


def polygons_holders(polygons: Polygons, point: str) -> set[str]:
    """Links that have a point, under the names in which they are written."""
    return {polygons.block_of.get(n, n) for n, k in polygons.links.items() if point in k.points}
