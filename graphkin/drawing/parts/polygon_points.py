"""The points of a polygon: end points of vectors, feet between components, the pole; each with its letter; and what a
vector is told by in a crowd, the number of its step."""

from __future__ import annotations

from cmath import phase
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from graphkin.construction.mechanism_acts import SpecialPoint
from graphkin.construction.polygon_acts import Carried
from graphkin.construction.strokes import Aid, Bar, Mark
from graphkin.drawing.conventions import pole
from graphkin.drawing.font_widths import runs_width
from graphkin.drawing.headings import spoken_ref
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Stroke, Text
from graphkin.drawing.ink.strokes import link_of_vector
from graphkin.drawing.parts.polygon_on_page import SAME, ZERO, PolygonOnPage
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.piece import Piece, joined
from graphkin.drawing.text import SMALLEST, plain, symbol
from graphkin.plane import added_up
from graphkin.scene.symbol import PointRef, Symbol

__all__ = ["END_RADIUS", "NamedPoint", "named_points", "points", "step_number"]

POLE_RADIUS, END_RADIUS, FOOT_RADIUS, RING = 0.9, 0.5, 0.4, 0.45
KNOWN = {"an": "normal", "ak": "coriolis"}  # components whose size and direction are known
MOST_AT_POLE = 24.0  # mm of names of points at rest beside the letter of the pole


@dataclass(frozen=True)
class _Place:
    """A place of the polygon with the end points that fall together in it."""

    at: complex
    refs: list[PointRef]


@dataclass(frozen=True)
class NamedPoint:
    """A point of a polygon (mm from the pole) and its letter; ``ref`` is the point of the mechanism whose end it is,
    None of the pole and of the feet between components."""

    at: complex
    letter: str
    ref: PointRef | None = None


def named_points(here: PolygonOnPage) -> tuple[NamedPoint, ...]:
    """The points of a polygon that have letters, the pole first; where the convention names vectors, only that."""
    places = _spots(here)
    ends = [NamedPoint(place.at, here.letters.end(here.diagram, ref), ref) for place in places for ref in place.refs]
    feet = [NamedPoint(foot.at, letter) for foot, letter in _letters_of_feet(here, places)]
    return (NamedPoint(0j, pole(here.letters.convention, here.diagram)), *(p for p in (*ends, *feet) if p.letter))


def points(here: PolygonOnPage) -> Piece:
    """All points with what they are called."""
    places = _spots(here)
    return joined((*_ends(here, places), *_feet(here, places), _pole(here, places[0])))


def _spots(here: PolygonOnPage) -> list[_Place]:
    """End points by place, in the order in which they were found; the pole first, with all points at rest."""
    fixed = [PointRef(p) for p in here.sheet.scene.frame.points]
    places = [_Place(0j, list(fixed))]
    seen: set[PointRef] = set(fixed)
    of_vectors = {symbol.of for symbol in here.vectors if symbol.to is None} | set(_special(here))
    for mark in (stroke for step in here.steps for stroke in step.strokes if isinstance(stroke, Mark)):
        if mark.ref in seen or mark.ref not in of_vectors:
            continue
        seen.add(mark.ref)
        place = next((place for place in places if abs(place.at - mark.at) <= SAME), None)
        if place:
            place.refs.append(mark.ref)
        else:
            places.append(_Place(mark.at, [mark.ref]))
    return places


def _special(here: PolygonOnPage) -> Iterator[PointRef]:
    """End points of special points, those that lie on the panel."""
    points = {point for group in here.sheet.groups for point, _ in group.points}
    for mark in (stroke for step in here.steps for stroke in step.strokes if isinstance(stroke, Mark)):
        if mark.ref.point in points and here.panel.distance(here.at(mark.at)) == 0.0:
            yield mark.ref


def _ends(here: PolygonOnPage, places: Sequence[_Place]) -> Iterator[Piece]:
    fixed = set(here.sheet.scene.frame.points)
    for number, place in enumerate(places):
        moving = [ref for ref in place.refs if ref.link or ref.point not in fixed]
        for i, ref in enumerate(moving):
            id = f"{here.diagram}-{ref}".replace("@", "")
            dot = _dot(here.at(place.at), i + (number == 0))
            group = Group((dot,), id=id, classes=("end",), title=spoken_ref(ref, here.language))
            yield Piece({here.diagram: (group,)}, (), (here.at(place.at),))
        if number and moving:
            markup = ", ".join(filter(None, (here.letters.end(here.diagram, ref) for ref in moving)))
            yield Piece(labels=_named(here, markup, place.at, f"label-{here.diagram}-{moving[0]}", 0, place.at))


def _dot(at: complex, ring: int) -> Circle:
    """A dot for the first point of a place, rings round it for those that fall together with it."""
    if ring == 0:
        return Circle(at, END_RADIUS, fill=strokes.BLACK)
    return Circle(at, END_RADIUS + ring * RING, stroke=Stroke(0.18))


def _feet(here: PolygonOnPage, places: Sequence[_Place]) -> Iterator[Piece]:
    """Points between components: where one ends and no end point lies."""
    for foot, markup in _letters_of_feet(here, places):
        at, id = here.at(foot.at), f"foot-{foot.symbol.id}"
        if foot.aid and here.panel.distance(at) > 0.0:
            continue
        dot = Group((Circle(at, FOOT_RADIUS, fill=strokes.BLACK),), id=id, classes=("foot",))
        yield Piece({here.diagram: (dot,)}, _named(here, markup, foot.at, f"label-{id}", 1, foot.at), (at,))


def _letters_of_feet(here: PolygonOnPage, places: Sequence[_Place]) -> Iterator[tuple[_Foot, str]]:
    found = _between(here, places)
    special = {s.act.point: s.act.link for s in here.sheet.steps if isinstance(s.act, SpecialPoint)}
    per_role = Counter(foot.role for foot in found)
    per_end: Counter[str] = Counter()
    used: set[str] = set()
    for foot in found:
        of, to = foot.symbol.of, foot.symbol.to
        assert of is not None
        # counted by the letter that is written: B and B@2 are one end point
        end = here.letters.end(here.diagram, of)
        per_end[end] += 1
        link = next((special[r.point] for r in (of, to) if r and r.point in special), "")
        link = link or link_of_vector(here.sheet, foot.symbol)
        alone = per_role[foot.role] == 1
        markup = here.letters.foot(foot.role, of, per_end[end], link, alone)
        if markup in used:
            index = here.letters.ref(of) + (here.letters.ref(to) if to else "")
            markup = here.letters.foot(foot.role, of, per_end[end], index, alone=False)
        used.add(markup)
        yield foot, markup


@dataclass(frozen=True)
class _Foot:
    """The end of a component; ``aid`` of one that leads to a special point or is laid off before its turn."""

    symbol: Symbol
    role: str
    at: complex
    aid: bool = False


def _between(here: PolygonOnPage, places: Sequence[_Place]) -> list[_Foot]:
    """Components that end where no end point lies and no other component has ended."""
    taken = [place.at for place in places]
    found = []
    for foot in (*_components(here), *_aids(here)):
        if all(abs(foot.at - z) > SAME for z in taken):
            taken.append(foot.at)
            found.append(foot)
    return found


def _components(here: PolygonOnPage) -> Iterator[_Foot]:
    for _, vector in here.vectors.values():
        if vector.role not in ("resultant", "relative") and abs(vector.span) >= ZERO:
            yield _Foot(vector.symbol, vector.role, vector.tip)


def _aids(here: PolygonOnPage) -> Iterator[_Foot]:
    """Known components that lead to a special point, or are laid off before their turn."""
    seen = set(here.vectors)
    for step in here.steps:
        for stroke in step.strokes:
            if isinstance(stroke, Aid) and not stroke.trial:
                symbol, tail, tip = stroke.symbol, stroke.tail, stroke.tip
            elif isinstance(stroke, Bar) and isinstance(step.act, Carried):
                symbol, tail, tip = step.act.symbol, stroke.a, stroke.b
            else:
                continue
            if symbol.kind in KNOWN and symbol not in seen and abs(tip - tail) >= ZERO:
                seen.add(symbol)
                yield _Foot(symbol, KNOWN[symbol.kind], tip, aid=True)


def _pole(here: PolygonOnPage, place: _Place) -> Piece:
    shown = ", ".join(filter(None, (here.letters.end(here.diagram, ref) for ref in place.refs)))
    letter = pole(here.letters.convention, here.diagram)
    markup = f"{letter} ({shown})" if shown and runs_width(symbol(shown)) < MOST_AT_POLE else letter
    away = -added_up((v.span for _, v in here.vectors.values() if abs(v.tail) < SAME), 0j)
    shape = Circle(here.at(0j), POLE_RADIUS, fill=strokes.WHITE, stroke=strokes.OUTLINE)
    dot = Circle(here.at(0j), 0.3, fill=strokes.BLACK)
    group = Group((shape, dot), id=f"pole-{here.diagram}", classes=("pole",))
    names = _named(here, markup, 0j, f"label-pole-{here.diagram}", 0, away)
    if markup != letter:
        names = tuple(replace(name, key=Text(0j, symbol(letter))) for name in names)
    return Piece({here.diagram: (group,)}, names)


def _named(here: PolygonOnPage, markup: str, at: complex, id: str, rank: int, away: complex) -> tuple[Label, ...]:
    if not markup:
        return ()
    text = Text(0j, symbol(markup), "start", strokes.BLACK, id.replace("@", ""), ("label",))
    toward = (phase(away),) if abs(away) > SAME else ()
    return (Label(text, here.at(at), toward, rank),)


def step_number(step: int, colour: str = strokes.GREY) -> Text:
    """The number of a step in brackets."""
    return Text(0j, plain(f"({step})", SMALLEST), "start", colour, "", ("step-number",), step)
