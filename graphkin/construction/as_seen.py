"""What is drawn with a link held still, in the polygons of the whole mechanism: vectors as they are seen from there.

A point's own velocity, seen from the link, is that relative to the coincident point of it; others bear its name.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from graphkin.construction.mechanism_acts import SpecialPoint
from graphkin.construction.polygon_acts import (
    ByImage,
    ByRate,
    Carried,
    DirectionLine,
    FoundVector,
    ImageSeen,
    LaidOff,
    MeasuredRate,
    PutBack,
    RateSeen,
    Resultant,
    SamePlace,
    SeenByRate,
    SeenFrom,
    Translated,
)
from graphkin.construction.polygon_pair import Plot, letter
from graphkin.construction.sheet import DiagramName, Equation, Sheet, Step, Term
from graphkin.construction.sizes import OffCurves, RateTimes, Size, SquareOverRadius
from graphkin.construction.steps import Act
from graphkin.construction.strokes import Aid, Bar, Ray, Stroke, Vector
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Cluster

__all__ = ["equations_seen", "seen", "steps_seen", "vectors_seen"]


def seen(symbol: Symbol, held: str) -> Symbol:
    """A vector as it is seen from a held link."""
    if symbol.of is None:
        return symbol
    if symbol.kind in ("v", "a") and symbol.to is None:
        return Symbol(symbol.kind, symbol.of, PointRef(symbol.of.point, held))
    return replace(symbol, seen=held)


def vectors_seen(sheet: Sheet, diagram: DiagramName) -> Iterator[Aid]:
    """The vectors of a diagram that are seen from held links; those that lead to special points left out."""
    held = {step.act.held for step in sheet.steps if isinstance(step.act, SeenFrom)}
    special = {step.act.point for step in sheet.steps if isinstance(step.act, SpecialPoint)}
    for step in sheet.steps if held else ():
        for stroke in step.strokes if step.diagram == diagram else ():
            if isinstance(stroke, Aid) and stroke.symbol.to is not None:
                of, to = stroke.symbol.of, stroke.symbol.to
                if {stroke.symbol.seen, to.link} & held and not special & {to.point, of.point if of else ""}:
                    yield stroke


def equations_seen(plot: Plot, begun: int, held: str, group: Cluster, further: int) -> list[Equation]:
    """The equations of polygons with a link held still after so many, their numbers raised."""
    found = []
    for one in plot.board.equations[begun:]:
        sides = tuple(tuple(_term(term, held) for term in side) for side in one.sides)
        found.append(Equation(one.number + further, one.diagram, sides, group))
    return found


def _term(term: Term, held: str) -> Term:
    return replace(term, symbol=seen(term.symbol, held), size=_size(term.size, held))


def _size(size: Size | None, held: str) -> Size | None:
    if isinstance(size, RateTimes):
        factor = seen(size.factor, held) if isinstance(size.factor, Symbol) else size.factor
        return replace(size, links=(*size.links, held) if len(size.links) == 1 else size.links, factor=factor)
    return replace(size, velocity=seen(size.velocity, held)) if isinstance(size, SquareOverRadius | OffCurves) else size


def steps_seen(plot: Plot, begun: int, held: str, further: int) -> Iterator[tuple[Act, tuple[Stroke, ...], int | None]]:
    """The steps of polygons with a link held still after so many, each with the raised number of its equation."""
    for step in plot.board.steps[begun:]:
        act = _act(plot, step, held)
        if act is not None and step.diagram != "mechanism":
            yield act, tuple(_strokes(step, held)), None if step.equation is None else step.equation + further


def _strokes(step: Step, held: str) -> Iterator[Stroke]:
    for stroke in step.strokes:
        if isinstance(stroke, Vector | Aid):
            yield Aid(seen(stroke.symbol, held), stroke.tail, stroke.tip, 0)
        elif isinstance(stroke, Ray):
            yield replace(stroke, symbol=seen(stroke.symbol, held))
        elif isinstance(stroke, Bar) and isinstance(step.act, Carried):
            yield stroke


def _act(plot: Plot, step: Step, held: str) -> Act | None:
    """An act as it is said of what is seen from a link; None for end points that get a letter in the polygon itself."""
    act, kind = step.act, letter("velocity" if step.diagram == "velocity" else "acceleration")

    def to(ref: PointRef) -> Symbol | None:
        return None if plot.fixed(ref) else seen(Symbol(kind, ref), held)

    match act:
        case LaidOff():
            return replace(act, symbol=seen(act.symbol, held), size=_size(act.size, held))
        case FoundVector() | DirectionLine() | Carried() | PutBack() | Resultant():
            return replace(act, symbol=seen(act.symbol, held))
        case MeasuredRate(rate, link, vector, bar, value, mm):
            return RateSeen(rate, link, held, seen(vector, held), bar, value, mm)
        case ByImage(point, (one, other), link, on_line):
            corners = one.point, other.point, point.point
            return ImageSeen(seen(Symbol(kind, point), held), (to(one), to(other)), corners, link, on_line)
        case ByRate(point, start, link):
            return SeenByRate(seen(Symbol(kind, point), held), start, to(start), link, held)
        case SamePlace() | Translated():
            vectors = (s for s in step.strokes if isinstance(s, Vector | Aid))
            return next((Resultant(seen(v.symbol, held)) for v in vectors), None)
    return None
