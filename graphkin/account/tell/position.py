"""Steps of the mechanism in its position as they are told: each point with the lengths and the side by which a ruler
and a compass find it."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping
from functools import reduce
from typing import Any, TypeVar

from graphkin.account.headings import number
from graphkin.account.voice import Told
from graphkin.construction.mechanism_acts import (
    ArcOnPath,
    CompassArcs,
    FixedPoints,
    GuideThrough,
    GuideTouching,
    LaidOffAngle,
    LinkPoints,
    PathDrawn,
    PathsCross,
)
from graphkin.construction.sheet import Act, phrase_of
from graphkin.construction.strokes import Bar, CompassArc, Mark
from graphkin.plane import cross, dot, unit
from graphkin.scene.symbol import PointRef
from graphkin.words import Phrase
from graphkin.words.written import on_paper, true_minus

__all__ = ["TOLD"]

SAME = 1e-6  # mm
STRAIGHT = 1e-6  # of a length: so little beside a line a point lies on it
ActType = TypeVar("ActType", bound=Act)


class _InPosition(Told[ActType]):
    def at(self, point: str) -> complex | None:
        return self.sheet.points.get(PointRef(point))


class _Fixed(_InPosition[FixedPoints]):
    def lettered(self) -> Phrase | None:
        """Fixed points and guides by their places on paper."""
        places = [(p, self.at(p)) for p in self.act.points]
        told = [Phrase("place of a point", (p, *_coordinates(z))) for p, z in places if z is not None]
        for guide in self.sheet.scene.frame.guides.values():
            if guide.name:
                through = guide.through / self.sheet.scales.length
                angle = math.degrees(cmath.phase(guide.direction))
                told.append(Phrase("place of a guide", (guide.name, *_coordinates(through), _degrees(angle))))
        return Phrase("fixed on paper", (self.act.frame, reduce(_listed, told))) if told else None


class _Angle(_InPosition[LaidOffAngle]):
    def lettered(self) -> Phrase | None:
        act = self.act
        key = "lay off angle from link" if act.to else "lay off angle from x"
        return Phrase(key, (act.link, true_minus(f"{math.degrees(act.angle):.6g}"), act.hinge, act.to))


class _Link(_InPosition[LinkPoints]):
    def lettered(self) -> Phrase | None:
        """Each new point of a link from those that stand there already."""
        link, links = self.act.link, self.sheet.structure.links
        own = links[link].points if link in links else {}
        standing, found = self._before()
        known = [p for p in own if p in standing]
        told: list[Phrase] = []
        for name in sorted(self.act.points, key=lambda p: p not in found):
            said = self._joined(known, name) if name in found else self._marked(known, name)
            if said is None:
                return None
            told.append(said)
            known.append(name)
        return reduce(_in_turn, told) if told else None

    def _joined(self, known: list[str], name: str) -> Phrase:
        link = self.act.link
        return Phrase("place joined", (known[0], name, link)) if known else Phrase("place alone", (name, link))

    def _marked(self, known: list[str], name: str) -> Phrase | None:
        link, at = self.act.link, self.at(name)
        places = {p: z for p in known if (z := self.at(p)) is not None}
        if at is None:
            return None
        if not places:
            if link not in self.sheet.scene.by_name:  # what only stands for a pin in a slot
                return Phrase("pin by coordinates", (name, *_coordinates(at)))
            return Phrase("place by coordinates", (link, name, *_coordinates(at)))
        bars = [(p, q) for p in places for q in places if abs(places[p] - places[q]) > SAME]
        if bars:
            p, q = max(bars, key=lambda b: abs(places[b[0]] - places[b[1]]))
            return _from_two((p, places[p]), (q, places[q]), name, at)
        (pivot, start), *_ = places.items()
        through = self._guide_through(pivot)
        if through is not None:
            return _along((pivot, start), through, name, at)
        laid = any(isinstance(a, LaidOffAngle) and a.link == link for a in self._acts())
        span = at - start
        if abs(span) < SAME:
            return None
        own = self.sheet.structure.links[link].points
        if laid and abs(cmath.phase(own[name] - own[pivot])) < STRAIGHT:
            return Phrase("points at", (link, name, pivot + name, on_paper(abs(span))))
        return Phrase("place polar", (pivot, _degrees(math.degrees(cmath.phase(span))), pivot + name,
                                      on_paper(abs(span)), name))  # fmt: skip

    def _guide_through(self, pivot: str) -> tuple[str, complex] | None:
        """The pin that has directed a link's guide from its pivot."""
        for act in self._acts():
            if isinstance(act, GuideThrough) and act.pivot == pivot and self.act.link in act.pair.split("/"):
                at = self.at(act.through)
                return (act.through, at) if at is not None else None
        return None

    def _before(self) -> tuple[frozenset[str], frozenset[str]]:
        """Points that stand on the paper before the step, and those of them that were found but are on no link yet."""
        standing: set[str] = set()
        found: set[str] = set()
        for one in self.sheet.steps:
            if one is self.step:
                break
            if one.diagram == "mechanism":
                standing |= {s.ref.point for s in one.strokes if isinstance(s, Mark)}
                if isinstance(one.act, CompassArcs | ArcOnPath | PathsCross):
                    found.add(one.act.point)
        return frozenset(standing), frozenset(found - standing)

    def _acts(self) -> Iterator[object]:
        """What was done before the step, the last first."""
        before = self.sheet.steps[: self.sheet.steps.index(self.step)]
        return (one.act for one in reversed(before) if one.diagram == "mechanism")


class _Arcs(_InPosition[CompassArcs]):
    def lettered(self) -> Phrase | None:
        act = self.act
        one, other, at = (self.at(p) for p in (*act.about, act.point))
        if one is None or other is None or at is None or abs(other - one) < SAME:
            return None
        return _from_arcs(act.about, act.radii, act.point, cross(other - one, at - one))


class _ArcOnPath(_InPosition[ArcOnPath]):
    def lettered(self) -> Phrase | None:
        """Which of the crossings of an arc with a straight path is meant, as it is seen on the paper."""
        centre, at = self.at(self.act.about), self.at(self.act.point)
        path = next((bar for bar in self._path()), None)
        if centre is None or at is None or path is None:
            return None
        half = dot(at - centre, path) * path  # from the middle between the crossings
        if abs(half) < SAME:
            return None
        upright = abs(half.imag) > abs(half.real)
        side = ("upper" if half.imag > 0 else "lower") if upright else ("right" if half.real > 0 else "left")
        return Phrase(f"crossing {side}", (phrase_of(self.act),))

    def _path(self) -> Iterator[complex]:
        """The direction of the straight path of the point."""
        for step in self.sheet.steps:
            if isinstance(step.act, PathDrawn) and step.act.point == self.act.point:
                yield from (unit(s.b - s.a) for s in step.strokes if isinstance(s, Bar) and abs(s.b - s.a) > SAME)


class _Touching(_InPosition[GuideTouching]):
    def lettered(self) -> Phrase | None:
        """Which of the two tangents: the side of the crossing of its circles."""
        arcs = [s for s in self.step.strokes if isinstance(s, CompassArc)]
        one, other = self.at(self.act.pivot), self.at(self.act.through)
        if one is None or other is None or not arcs:
            return None
        side = "left" if cross(other - one, arcs[0].at - one) > 0 else "right"
        return Phrase(f"tangent {side}", (phrase_of(self.act), self.act.pivot, self.act.through))


def _from_two(p: tuple[str, complex], q: tuple[str, complex], name: str, at: complex) -> Phrase:
    """A point from two others: on their line, or by arcs about both."""
    (one, a), (two, b) = p, q
    if abs(cross(b - a, at - a)) < STRAIGHT * abs(b - a) ** 2:
        return _on_line(p, q, name, at)
    return _from_arcs((one, two), (abs(at - a), abs(at - b)), name, cross(b - a, at - a))


def _from_arcs(about: tuple[str, str], radii: tuple[float, float], name: str, side: float) -> Phrase:
    """A point where two arcs meet, ``side`` positive to the left of the line between their centres."""
    one, two = map(on_paper, radii)
    return Phrase(f"place by arcs {'left' if side > 0 else 'right'}", (about[0], one, about[1], two, name))


def _along(p: tuple[str, complex], q: tuple[str, complex], name: str, at: complex) -> Phrase:
    """A point of a bar whose direction is that of a line through its pivot: on it, or at an angle to it."""
    (one, a), (_, b) = p, q
    if abs(at - a) < SAME or abs(cross(b - a, at - a)) < STRAIGHT * abs(b - a) * abs(at - a):
        return _on_line(p, q, name, at)
    turn = math.degrees(cmath.phase((at - a) / (b - a)))
    sense = "ccw" if turn > 0 else "cw"
    return Phrase(f"place turned {sense}", (one, number(abs(turn), 4), one + q[0], one + name,
                                            on_paper(abs(at - a)), name))  # fmt: skip


def _on_line(p: tuple[str, complex], q: tuple[str, complex], name: str, at: complex) -> Phrase:
    (one, a), (two, b) = p, q
    along = dot(at - a, b - a) / abs(b - a) ** 2
    if 0.0 <= along <= 1.0:
        return Phrase("place within", (one + two, name, one + name, on_paper(abs(at - a))))
    return Phrase("place beyond", (one + two, name, one + name, on_paper(abs(at - a)), one if along < 0.0 else two))


def _listed(one: Phrase, other: Phrase) -> Phrase:
    return Phrase("listed", (one, other))


def _in_turn(one: Phrase, other: Phrase) -> Phrase:
    return Phrase("in turn", (one, other))


def _coordinates(z: complex) -> tuple[str, str]:
    return true_minus(on_paper(_clean(z.real))), true_minus(on_paper(_clean(z.imag)))


def _clean(mm: float) -> float:
    return 0.0 if abs(mm) < SAME else mm


def _degrees(angle: float) -> str:
    return true_minus(number(round(angle, 2) + 0.0))


TOLD: Mapping[type, type[Told[Any]]] = {
    FixedPoints: _Fixed, LaidOffAngle: _Angle, LinkPoints: _Link, CompassArcs: _Arcs, ArcOnPath: _ArcOnPath,
    GuideTouching: _Touching,
}  # fmt: skip
