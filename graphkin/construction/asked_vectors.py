"""Vectors that are asked for and stand in no equation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from graphkin.construction.net import node
from graphkin.construction.polygons import Polygons
from graphkin.construction.sizes import Order
from graphkin.construction.steps import Step
from graphkin.construction.strokes import Vector
from graphkin.construction.touching import Touching
from graphkin.errors import CallError, Problem
from graphkin.plane import dot, unit
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase

if TYPE_CHECKING:
    pass

__all__ = ["show"]


def show(plot: Polygons, asked: Sequence[Symbol]) -> None:
    """Draw the vectors that are asked for and stand in no equation."""
    for symbol in asked:
        if symbol.is_vector:
            _show(plot, symbol)


def _show(plot: Polygons, symbol: Symbol) -> None:
    order: Order = "velocity" if symbol.kind == "v" else "acceleration"
    if symbol in plot.drawn[order] or symbol.of is None:
        return
    of = _node(plot, symbol.of)
    to = _node(plot, symbol.to) if symbol.to else None
    if not _reachable(plot, of) or (to and not _reachable(plot, to)):
        return
    tail, tip = (plot.end(order, to) if to else 0j), plot.end(order, of)
    if symbol.kind in ("v", "a"):
        _draw(plot, order, Vector(symbol, tail, tip, "relative" if to else "resultant"))
    elif symbol.kind in ("an", "at"):
        _split(plot, symbol, of, to)
    else:
        _coincident(plot, symbol, of, to)


def _node(plot: Polygons, ref: PointRef) -> PointRef:
    return node(plot.links, ref.point, ref.link) if ref.link else ref


def _reachable(plot: Polygons, ref: PointRef) -> bool:
    names = [ref.link] if ref.link else [n for n, k in plot.links.items() if ref.point in k.points]
    return ref.point in plot.places and any(n in plot.rates["velocity"] for n in names)


def _draw(plot: Polygons, order: Order, vector: Vector) -> None:
    plot.drawn[order][vector.symbol] = vector
    plot.board.do(Step("join", "asked", order, (vector,), symbol=vector.symbol))


def _split(plot: Polygons, symbol: Symbol, of: PointRef, to: PointRef | None) -> None:
    """Normal and tangential part of a relative acceleration: along the bar and square to it."""
    if to is None:
        to = _pivot(plot, of)
    tail, tip = plot.end("acceleration", to), plot.end("acceleration", of)
    arm = plot.places[of.point] - plot.places[to.point]
    if any(c.rolling and c.name == of.point == to.point for c in plot.structure.scene.contacts):
        arm = Touching(plot.structure.scene, plot.paper.mm, plot.paper.poses).rolling_centres(of.point)[1]
    elif abs(arm) <= plot.tiny:
        raise CallError(
            Problem(
                str(symbol),
                Phrase("the two points coincide no line joins them"),
                Phrase("ask for ak and ar of coincident points"),
            )
        )
    along = unit(arm)
    foot = tail + along * dot(tip - tail, along)
    if symbol.kind == "an":
        _draw(plot, "acceleration", Vector(symbol, tail, foot, "normal"))
    else:
        _draw(plot, "acceleration", Vector(symbol, foot, tip, "tangential"))


def _pivot(plot: Polygons, of: PointRef) -> PointRef:
    names = [of.link] if of.link else [n for n, k in plot.links.items() if of.point in k.points]
    ground = plot.links[plot.ground]
    for name in names:
        for point in plot.links[name].points:
            if point in ground.points and point != of.point:
                return PointRef(point)
    raise CallError(
        Problem(
            f"{of}",
            Phrase("its link has no fixed pivot to which"),
            Phrase("name the other point too for example an_c"),
        )
    )


def _coincident(plot: Polygons, symbol: Symbol, of: PointRef, to: PointRef | None) -> None:
    """Coriolis and sliding part for two coincident points that stand in no equation."""
    assert to is not None
    pair = _pair(plot, of, to, symbol)
    tail, tip = plot.end("acceleration", to), plot.end("acceleration", of)
    slip = plot.end("velocity", of) - plot.end("velocity", to)
    omega = plot.rates["velocity"][pair].value
    corner = tail + 2j * omega * slip * (plot.scales.velocity / plot.scales.acceleration)
    if symbol.kind == "ak":
        _draw(plot, "acceleration", Vector(symbol, tail, corner, "coriolis"))
    else:
        _draw(plot, "acceleration", Vector(symbol, corner, tip, "sliding"))


def _pair(plot: Polygons, of: PointRef, to: PointRef, symbol: Symbol) -> str:
    """The guide of the sliding pair between two coincident points; of links of a group the one it is seen from."""
    for s in plot.structure.slides:
        sides = {node(plot.links, of.point, s.a), node(plot.links, of.point, s.b)}
        if sides == {of, to}:
            return s.b
    seen = {ref.link for ref in (symbol.of, symbol.to) if ref}
    if symbol.to and any(seen <= {*group.members} for group in plot.structure.larger_groups):
        return symbol.to.link  # links of a group that are drawn as one, seen from one of them
    known = ", ".join(s.key for s in plot.structure.slides)
    raise CallError(
        Problem(
            str(symbol),
            Phrase("these two points do not lie on the"),
            Phrase("known are", names=known) if known else Phrase("this mechanism has none"),
        )
    )
