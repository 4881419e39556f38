"""The acts of a construction: typed, with the sentence that each makes.

An act says what is done and to what; the strokes that it leaves on the paper stand in its `Step`.  ``mm`` are lengths
on paper, the only thing of an act that a scale changes (`scaled`).  Those of the mechanism are in
`graphkin.construction.mechanism_acts`, those of a polygon in `graphkin.construction.polygon_acts`; who wants to know
more than the sentence looks at the type and the fields.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeVar

from graphkin.construction.mechanism_acts import (
    ArcOnPath,
    CompassArcs,
    FixedPoints,
    GuideThrough,
    GuideTouching,
    LaidOffAngle,
    LaidOffTravel,
    LinkPoints,
    OnMechanism,
    PathDrawn,
    PathsCross,
    SlidToMeet,
    TrialPositions,
    mechanism_phrase,
)
from graphkin.construction.polygon_acts import (
    FoundVector,
    InPolygon,
    LaidOff,
    MeasuredRate,
    RateSeen,
    Superposed,
    polygon_phrase,
)
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase

__all__ = ["Act", "Cause", "Placing", "ReadOff", "links_drawn", "phrase_of", "scaled"]

Act = OnMechanism | InPolygon

# -- causes of uncertainty besides the acts ----------------------------------------------------------------------------


@dataclass(frozen=True)
class Placing:
    """The pricking and placing of links."""

    links: tuple[str, ...]


@dataclass(frozen=True)
class ReadOff:
    """The reading itself."""

    symbol: Symbol


Cause = Act | Placing | ReadOff


_WITH_LENGTH = (LaidOffTravel, ArcOnPath, GuideTouching, LaidOff, FoundVector, MeasuredRate, RateSeen)
_Scalable = TypeVar("_Scalable", bound=Act)


def scaled(thing: _Scalable, times: float) -> _Scalable:
    """The same act with its lengths so many times as large."""
    if isinstance(thing, CompassArcs):
        return replace(thing, radii=(thing.radii[0] * times, thing.radii[1] * times))
    if isinstance(thing, TrialPositions):
        return replace(thing, table=thing.table.scaled(times) if thing.table is not None else None)
    if isinstance(thing, Superposed):
        apart = tuple(tuple(mm * times for mm in row) for row in thing.apart)
        less = tuple(tuple(replace(one, mm=one.mm * times) for one in row) for row in thing.less)
        return replace(thing, apart=apart, less=less)
    return replace(thing, mm=thing.mm * times) if isinstance(thing, _WITH_LENGTH) else thing


def links_drawn(act: Act) -> tuple[str, ...]:
    """The links that an act places or draws."""
    match act:
        case FixedPoints():
            return (act.frame,)
        case LaidOffAngle() | LinkPoints():
            return (act.link,)
        case LaidOffTravel() | PathDrawn() | GuideThrough() | GuideTouching():
            pairs: tuple[str, ...] = (act.pair,)
        case PathsCross():
            pairs = act.pairs
        case SlidToMeet():
            pairs = act.along, act.until
        case TrialPositions():
            return act.links
        case _:
            pairs = ()
    return tuple(name for pair in pairs for name in pair.split("/"))


def phrase_of(thing: Cause) -> Phrase:
    """An act, or another cause of uncertainty, as a sentence to be."""
    match thing:
        case Placing(links):
            return Phrase("placing", (", ".join(links),))
        case ReadOff(symbol):
            return Phrase("reading", (symbol,))
    return mechanism_phrase(thing) if isinstance(thing, OnMechanism) else polygon_phrase(thing)
