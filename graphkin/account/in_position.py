"""Steps of the mechanism in its position as they are told: each point with the lengths and the side by which a ruler
and a compass find it."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import reduce

from graphkin.account.headings import number
from graphkin.account.voice import Voice
from graphkin.construction.sheet import Sheet
from graphkin.construction.steps import FINDS_A_POINT, Reason, Step
from graphkin.construction.strokes import Bar, CompassArc, Mark
from graphkin.plane import cross, dot, unit
from graphkin.scene.symbol import PointRef
from graphkin.words import Phrase
from graphkin.words.written import on_paper, true_minus

__all__ = ["SENTENCES"]

SAME = 1e-6  # mm
STRAIGHT = 1e-6  # of a length: so little beside a line a point lies on it


def _at(sheet: Sheet, point: str) -> complex | None:
    return sheet.points.get(PointRef(point))


def _fixed(voice: Voice, step: Step) -> Phrase | None:
    """Fixed points and guides by their places on paper."""
    sheet = voice.sheet
    places = [(p, _at(sheet, p)) for p in step.points]
    told = [Phrase("place of a point", (p, *_coordinates(z))) for p, z in places if z is not None]
    for guide in sheet.scene.frame.guides.values():
        if guide.name:
            through = guide.through / sheet.scales.length
            angle = math.degrees(cmath.phase(guide.direction))
            told.append(Phrase("place of a guide", (guide.name, *_coordinates(through), _degrees(angle))))
    return Phrase("fixed on paper", (step.link, reduce(_listed, told))) if told else None


def _angle(voice: Voice, step: Step) -> Phrase:
    key = "lay off angle from link" if step.base else "lay off angle from x"
    return Phrase(key, (step.link, true_minus(f"{math.degrees(step.value):.6g}"), step.point, step.base))


# -- the points of a link ----------------------------------------------------------------------------------------------


def _link_points(voice: Voice, step: Step) -> Phrase | None:
    """Each new point of a link from those that stand there already."""
    sheet, link = voice.sheet, step.link
    own = sheet.structure.links[link].points if link in sheet.structure.links else {}
    standing, found = _points_before(sheet, step)
    known = [p for p in own if p in standing]
    told: list[Phrase] = []
    for name in sorted(step.points, key=lambda p: p not in found):
        if name not in found:
            said = _marked(sheet, step, known, name)
        else:
            said = Phrase("place joined", (known[0], name, link)) if known else Phrase("place alone", (name, link))
        if said is None:
            return None
        told.append(said)
        known.append(name)
    return reduce(_in_turn, told) if told else None


def _marked(sheet: Sheet, step: Step, known: list[str], name: str) -> Phrase | None:
    """A new point of a link by its known points, as far as there are some."""
    link, at = step.link, _at(sheet, name)
    places = {p: z for p in known if (z := _at(sheet, p)) is not None}
    if at is None:
        return None
    if not places:
        if link not in sheet.scene.by_name:  # what only stands for a pin in a slot
            return Phrase("pin by coordinates", (name, *_coordinates(at)))
        return Phrase("place by coordinates", (link, name, *_coordinates(at)))
    bars = [(p, q) for p in places for q in places if abs(places[p] - places[q]) > SAME]
    if bars:
        p, q = max(bars, key=lambda b: abs(places[b[0]] - places[b[1]]))
        return _from_two((p, places[p]), (q, places[q]), name, at)
    (pivot, start), *_ = places.items()
    through = _guide_through(sheet, step, pivot)
    if through is not None:
        return _along((pivot, start), through, name, at)
    laid = any(s.reason == "angle" and s.link == link for s in sheet.before(step))
    span = at - start
    if abs(span) < SAME:
        return None
    own = sheet.structure.links[link].points
    if laid and abs(cmath.phase(own[name] - own[pivot])) < STRAIGHT:
        return Phrase("points at", (link, name, pivot + name, on_paper(abs(span))))
    angle = _degrees(math.degrees(cmath.phase(span)))
    return Phrase("place polar", (pivot, angle, pivot + name, on_paper(abs(span)), name))


def _guide_through(sheet: Sheet, step: Step, pivot: str) -> tuple[str, complex] | None:
    """The pin that has directed a link's guide from its pivot."""
    for s in reversed(sheet.before(step)):
        if s.reason == "guide" and s.points[0] == pivot and step.link in s.pairs[0].split("/"):
            at = _at(sheet, s.points[1])
            return (s.points[1], at) if at is not None else None
    return None


def _points_before(sheet: Sheet, step: Step) -> tuple[frozenset[str], frozenset[str]]:
    """Points that stand on the paper before a step, and those of them that were found but are on no link yet."""
    before = [one for one in sheet.before(step) if one.diagram == "mechanism"]
    standing = {s.ref.point for one in before for s in one.strokes if isinstance(s, Mark)}
    found = {one.point for one in before if one.reason in FINDS_A_POINT}
    return frozenset(standing), frozenset(found - standing)


# -- points that are found ---------------------------------------------------------------------------------------------


def _arcs(voice: Voice, step: Step) -> Phrase | None:
    one, other, at = (_at(voice.sheet, p) for p in (*step.points, step.point))
    if one is None or other is None or at is None or abs(other - one) < SAME:
        return None
    return _from_arcs(step.points, step.radii, step.point, cross(other - one, at - one))


def _arc_on_path(voice: Voice, step: Step) -> Phrase | None:
    """Which of the crossings of an arc with a straight path is meant, as it is seen on the paper."""
    centre, at = (_at(voice.sheet, p) for p in (*step.points, step.point))
    path = next(_path(voice.sheet, step), None)
    if centre is None or at is None or path is None:
        return None
    half = dot(at - centre, path) * path  # from the middle between the crossings
    if abs(half) < SAME:
        return None
    upright = abs(half.imag) > abs(half.real)
    side = ("upper" if half.imag > 0 else "lower") if upright else ("right" if half.real > 0 else "left")
    return Phrase(f"crossing {side}", (step.phrase,))


def _path(sheet: Sheet, step: Step) -> Iterator[complex]:
    """The direction of the straight path of the point of a step."""
    for one in sheet.steps:
        if one.reason == "path" and one.point == step.point:
            yield from (unit(s.b - s.a) for s in one.strokes if isinstance(s, Bar) and abs(s.b - s.a) > SAME)


def _tangent(voice: Voice, step: Step) -> Phrase | None:
    """Which of the two tangents: the side of the crossing of its circles."""
    arcs = [s for s in step.strokes if isinstance(s, CompassArc)]
    one, other = (_at(voice.sheet, p) for p in step.points)
    if one is None or other is None or not arcs:
        return None
    side = "left" if cross(other - one, arcs[0].at - one) > 0 else "right"
    return Phrase(f"tangent {side}", (step.phrase, *step.points))


def _from_two(p: tuple[str, complex], q: tuple[str, complex], name: str, at: complex) -> Phrase:
    """A point from two others: on their line, or by arcs about both."""
    (one, a), (two, b) = p, q
    if abs(cross(b - a, at - a)) < STRAIGHT * abs(b - a) ** 2:
        return _on_line(p, q, name, at)
    return _from_arcs((one, two), (abs(at - a), abs(at - b)), name, cross(b - a, at - a))


def _from_arcs(about: Sequence[str], radii: Sequence[float], name: str, side: float) -> Phrase:
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


SENTENCES: Mapping[Reason, Callable[[Voice, Step], Phrase | None]] = {
    "frame": _fixed, "angle": _angle, "points": _link_points, "whole link": _link_points, "arcs": _arcs,
    "arc on path": _arc_on_path, "tangent": _tangent,
}  # fmt: skip
"""The step as it is said with the lengths and sides of the paper, by its reason."""
