"""A polygon as it stands on a page: its vectors and steps, and where the pole is.

The points of a polygon: end points of vectors, feet between components, the pole; each with its letter.
"""

from __future__ import annotations

from cmath import phase
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from graphkin.construction.sheet import DiagramName, Mark, Sheet, Step, Vector
from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters, pole
from graphkin.drawing.detail import Detail
from graphkin.drawing.headings import spoken_ref
from graphkin.drawing.layout import Name, Piece, joined
from graphkin.drawing.placing import Label
from graphkin.drawing.primitives import Circle, Group, Stroke, Text
from graphkin.drawing.strokes import link_of_vector
from graphkin.drawing.text import runs_width, symbol
from graphkin.scene.symbol import PointRef, Symbol

__all__ = ["SAME", "ZERO", "OnPage", "points", "same_place"]

SAME = 0.02  # mm: nearer end points fall together on paper
ZERO = 0.02  # mm: a shorter vector is drawn as a dot


@dataclass(frozen=True)
class OnPage:
    """A sheet's polygon with the letters of a convention and the words of a language."""

    sheet: Sheet
    diagram: DiagramName
    letters: Letters
    language: str
    panel: Box
    origin: complex
    enlarged: tuple[Detail, ...]

    def at(self, z: complex) -> complex:
        """The page point of a point of the polygon."""
        return self.origin + z.conjugate()

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        return tuple(step for step in self.sheet.steps if step.diagram == self.diagram)

    @cached_property
    def vectors(self) -> Mapping[Symbol, tuple[int, Vector]]:
        """Each vector, with the number of the step that drew it last."""
        return {s.symbol: (step.number, s) for step in self.steps for s in step.strokes if isinstance(s, Vector)}

    def in_order(self) -> list[tuple[int, Vector]]:
        """Long vectors first, so that short ones lie on top."""
        return sorted(self.vectors.values(), key=lambda sv: (-round(abs(sv[1].span), 6), sv[0]))

    def covered(self, a: complex, b: complex) -> bool:
        """Whether a drawn vector lies from a to b or back."""
        return any(
            (abs(v.tail - a) < SAME and abs(v.tip - b) < SAME) or (abs(v.tail - b) < SAME and abs(v.tip - a) < SAME)
            for _, v in self.vectors.values()
        )


def same_place(z: complex) -> complex:
    """A key that is the same for points that fall together."""
    return complex(round(z.real / SAME), round(z.imag / SAME))


POLE_RADIUS, END_RADIUS, FOOT_RADIUS, RING = 0.9, 0.5, 0.4, 0.45
MOST_AT_POLE = 24.0  # mm of names of points at rest beside the letter of the pole


@dataclass(frozen=True)
class _Spot:
    """A place of the polygon with the end points that fall together in it."""

    at: complex
    refs: list[PointRef]


def points(here: OnPage) -> Piece:
    """All points with what they are called."""
    spots = _spots(here)
    return joined((*_ends(here, spots), *_feet(here, spots), _pole(here, spots[0])))


def _spots(here: OnPage) -> list[_Spot]:
    """End points by place, in the order in which they were found; the pole first, with all points at rest."""
    fixed = [PointRef(p) for p in here.sheet.scene.frame.points]
    spots = [_Spot(0j, list(fixed))]
    seen: set[PointRef] = set(fixed)
    of_vectors = {symbol.of for symbol in here.vectors if symbol.to is None}
    for mark in (stroke for step in here.steps for stroke in step.strokes if isinstance(stroke, Mark)):
        if mark.ref in seen or mark.ref not in of_vectors:
            continue
        seen.add(mark.ref)
        spot = next((spot for spot in spots if abs(spot.at - mark.at) <= SAME), None)
        if spot:
            spot.refs.append(mark.ref)
        else:
            spots.append(_Spot(mark.at, [mark.ref]))
    return spots


def _ends(here: OnPage, spots: Sequence[_Spot]) -> Iterator[Piece]:
    fixed = set(here.sheet.scene.frame.points)
    for number, spot in enumerate(spots):
        moving = [ref for ref in spot.refs if ref.link or ref.point not in fixed]
        for i, ref in enumerate(moving):
            id = f"{here.diagram}-{ref}".replace("@", "")
            dot = _dot(here.at(spot.at), i + (number == 0))
            group = Group((dot,), id=id, classes=("end",), title=spoken_ref(ref, here.language))
            yield Piece({here.diagram: (group,)}, (), (here.at(spot.at),))
        if number and moving:
            markup = ", ".join(filter(None, (here.letters.end(here.diagram, ref) for ref in moving)))
            yield Piece(names=_named(here, markup, spot.at, f"label-{here.diagram}-{moving[0]}", 0, spot.at))


def _dot(at: complex, ring: int) -> Circle:
    """A dot for the first point of a place, rings round it for those that fall together with it."""
    if ring == 0:
        return Circle(at, END_RADIUS, fill=strokes.BLACK)
    return Circle(at, END_RADIUS + ring * RING, stroke=Stroke(0.18))


def _feet(here: OnPage, spots: Sequence[_Spot]) -> Iterator[Piece]:
    """Points between components: where one ends and no end point lies."""
    found = _between(here, spots)
    per_role = Counter(vector.role for vector in found)
    per_end: Counter[str] = Counter()
    used: set[str] = set()
    for vector in found:
        of, to = vector.symbol.of, vector.symbol.to
        assert of is not None
        # counted by the letter that is written: B and B@2 are one end point
        end = here.letters.end(here.diagram, of)
        per_end[end] += 1
        link = link_of_vector(here.sheet, vector.symbol) if per_role[vector.role] > 1 else ""
        markup = here.letters.foot(vector.role, of, per_end[end], link)
        if markup in used:
            index = here.letters.ref(of) + (here.letters.ref(to) if to else "")
            markup = here.letters.foot(vector.role, of, per_end[end], index)
        used.add(markup)
        at, id = here.at(vector.tip), f"foot-{vector.symbol.id}"
        dot = Group((Circle(at, FOOT_RADIUS, fill=strokes.BLACK),), id=id, classes=("foot",))
        yield Piece({here.diagram: (dot,)}, _named(here, markup, vector.tip, f"label-{id}", 1, vector.tip), (at,))


def _between(here: OnPage, spots: Sequence[_Spot]) -> list[Vector]:
    """Components that end where no end point lies and no other component has ended."""
    taken = [spot.at for spot in spots]
    found = []
    for _, vector in here.vectors.values():
        if vector.role in ("resultant", "relative") or abs(vector.span) < ZERO:
            continue
        if all(abs(vector.tip - z) > SAME for z in taken):
            taken.append(vector.tip)
            found.append(vector)
    return found


def _pole(here: OnPage, spot: _Spot) -> Piece:
    shown = ", ".join(filter(None, (here.letters.end(here.diagram, ref) for ref in spot.refs)))
    letter = pole(here.letters.convention, here.diagram)
    markup = f"{letter} ({shown})" if shown and runs_width(symbol(shown)) < MOST_AT_POLE else letter
    away = -sum((v.span for _, v in here.vectors.values() if abs(v.tail) < SAME), 0j)
    shape = Circle(here.at(0j), POLE_RADIUS, fill=strokes.WHITE, stroke=strokes.OUTLINE)
    dot = Circle(here.at(0j), 0.3, fill=strokes.BLACK)
    group = Group((shape, dot), id=f"pole-{here.diagram}", classes=("pole",))
    return Piece({here.diagram: (group,)}, _named(here, markup, 0j, f"label-pole-{here.diagram}", 0, away))


def _named(here: OnPage, markup: str, at: complex, id: str, rank: int, away: complex) -> tuple[Name, ...]:
    if not markup:
        return ()
    text = Text(0j, symbol(markup), "start", strokes.BLACK, id.replace("@", ""), ("label",))
    toward = (phase(away),) if abs(away) > SAME else ()
    return (Name(Label(text, here.at(at), toward), rank),)
