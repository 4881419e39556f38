"""The force polygon of a group: forces head to tail at their scale, those that were known thin, those found thick; the
force inside closes the part of one link."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from graphkin.account.force_chain import corner_at, corners
from graphkin.account.notation import Letters
from graphkin.construction.forces.force_sheet import ForceGroup, ForceVector
from graphkin.construction.sheet import Sheet
from graphkin.construction.strokes import Vector
from graphkin.drawing.box import Box
from graphkin.drawing.force_stages import ForceStage
from graphkin.drawing.free_body import colour_of_force, letters_of_force
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Primitive, Text
from graphkin.drawing.ink.symbols import COMPONENT, RESULTANT, vector_group
from graphkin.drawing.parts.polygon_on_page import side_by_side
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, moved_piece
from graphkin.drawing.text import symbol
from graphkin.scene.symbol import Symbol

__all__ = ["drawn_polygon", "extent_of", "polygons_of"]

SHORT = 0.02  # mm: a shorter force is a dot
AROUND = 10.0  # mm of room for names


def polygons_of(group: ForceGroup) -> list[tuple[str, tuple[ForceVector, ...], tuple[ForceVector, ...]]]:
    """The polygons of a group that are drawn apart: the link it is of ("" for the whole group), its vectors, and forces
    inside that close part of it."""
    closing, own = [], []
    drawn = {frozenset((v.symbol.link, v.symbol.other)): {v.tail, v.tip} for v in group.polygon if v.symbol.other}
    for link, vectors in group.inner.items():
        body = vectors[:-1]
        if group.polygon and body == group.polygon[: len(body)]:
            last = vectors[-1]  # of a pin in a slot it is the force of the slot
            there = drawn.get(frozenset((last.symbol.link, last.symbol.other)))
            closing += [] if there == {last.tail, last.tip} else [last]
        else:
            own.append((link, vectors, ()))
    whole = [("", group.polygon, tuple(v for v in closing if abs(v.span) > SHORT))] if group.polygon else []
    return [*whole, *(one for one in own if any(abs(v.span) > SHORT for v in one[1]))]


def extent_of(vectors: Sequence[ForceVector]) -> Box:
    """The box around a polygon as on a page (mm, y down)."""
    return Box.around([z.conjugate() for v in vectors for z in (v.tail, v.tip)] or [0j])


def drawn_polygon(
    sheet: Sheet, stage: ForceStage, link: str, vectors: Sequence[ForceVector], inside: Sequence[ForceVector],
    letters: Letters, panel: Box, names: Counter[str], suffix: str,
) -> Piece:  # fmt: skip
    """A polygon in the middle of a panel at its true scale; ``link`` as in `polygons_of`."""
    arrows: list[Primitive] = []
    labels: list[Label] = []
    thin: list[Primitive] = []
    shifts = side_by_side(_as_drawn(v) for v in (*vectors, *inside))
    for vector in (*vectors, *inside):
        if abs(vector.span) <= SHORT:
            continue
        shift = shifts.get(_key(vector), 0j)
        tail, tip = (vector.tail + shift).conjugate(), (vector.tip + shift).conjugate()
        step = stage.in_polygon(vector, vector.link if vector in inside else link)
        if shift:
            aside = (Line(z.conjugate(), w, strokes.CONSTRUCTION) for z, w in ((vector.tail, tail), (vector.tip, tip)))
            thin.append(Group(tuple(aside), step=step))
        colour = colour_of_force(sheet, vector)
        kind = COMPONENT if vector.known or vector.part else RESULTANT
        name = _unique(vector, names, suffix)
        arrows.append(vector_group(name, step, tail, tip, kind, colour, classes=("force",)))
        markup, own = letters_of_force(letters, vector), f"label-{name}"
        text = Text(0j, symbol(markup, 3.2), "start", colour, own, ("label",), step)
        rank = 0 if not vector.known or abs(vector.span) > 3.0 else 2
        labels.append(Label(text, (tail, tip), rank=rank, between=_between(stage, link, vector)))
    for whole, tail, tip in _wholes(vectors):
        name = _unique(whole, names, suffix)
        colour = colour_of_force(sheet, whole)
        ends = tail.conjugate(), tip.conjugate()
        step = stage.in_polygon(whole, link)
        arrows.append(vector_group(name, step, *ends, RESULTANT, colour, classes=("force",)))
        markup, own = letters_of_force(letters, whole), f"label-{name}"
        text = Text(0j, symbol(markup, 3.2), "start", colour, own, ("label",), step)
        labels.append(Label(text, ends, rank=0, between=_between(stage, link, whole)))
    for letter, place, vector in corners(stage.group) if stage.group is not None and not link else ():
        names[f"corner-{letter}"] += 1
        own = f"label-corner-{letter}-{names[f'corner-{letter}']}{suffix}"
        text = Text(0j, symbol(letter, 3.0), "start", classes=("label",), id=own, step=stage.in_polygon(vector, link))
        labels.append(Label(text, (place + shifts.get(_key(vector), 0j)).conjugate(), rank=1))
    zero = [v for v in vectors if abs(v.span) <= SHORT and not v.known]
    for vector in zero:
        thin.append(Circle(vector.tip.conjugate(), 0.4, fill=strokes.BLACK))
    for vector in (v for v in vectors if not v.known):
        thin += _direction(vector, stage.in_polygon(vector, link))
    piece = Piece({"construction": tuple(thin), "forces": tuple(arrows)}, tuple(labels))
    return with_labels(moved_piece(piece, panel.centre - extent_of(vectors).centre), panel)


def _between(stage: ForceStage, link: str, vector: ForceVector) -> str:
    """The letters of the corners between which a force stands, of a polygon that has them."""
    if stage.group is None or link:
        return ""
    ends = [corner_at(stage.group, place).strip("$") for place in (vector.tail, vector.tip)]
    return "→".join(ends) if all(ends) and ends[0] != ends[1] else ""


def _key(vector: ForceVector) -> Symbol:
    """A symbol that tells the parts of a force apart."""
    return replace(vector.symbol, at=vector.part)


def _as_drawn(vector: ForceVector) -> Vector:
    return Vector(_key(vector), vector.tail, vector.tip, "relative")


def _direction(vector: ForceVector, step: int) -> Iterator[Primitive]:
    """The line along which a force was drawn, a little past its ends."""
    if vector.part == "t" or abs(vector.span) <= SHORT:
        return
    e = vector.span / abs(vector.span)
    for z, w in ((vector.tail, vector.tail - 6.0 * e), (vector.tip, vector.tip + 6.0 * e)):
        yield Group((Line(z.conjugate(), w.conjugate(), strokes.DIRECTION),), classes=("direction",), step=step)


def _wholes(vectors: Sequence[ForceVector]) -> Iterator[tuple[ForceVector, complex, complex]]:
    """Forces of which both parts stand in a polygon, whole."""
    for one, two in zip(vectors, (*vectors[1:], *vectors[:1]), strict=True):
        if one.symbol == two.symbol and {one.part, two.part} == {"t", "n"} and abs(one.tip - two.tail) < SHORT:
            whole = ForceVector(one.symbol, "", one.link, one.at, one.tail, two.tip, False, one.turned)
            if abs(whole.span) > SHORT and abs(one.span) > SHORT and abs(two.span) > SHORT:
                yield whole, one.tail, two.tip


def _unique(vector: ForceVector, names: Counter[str], suffix: str) -> str:
    """Its symbol as an id, counted where it is drawn again."""
    name = vector.symbol.id + (f"-{vector.part}" if vector.part else "") + suffix
    names[name] += 1
    return name if names[name] == 1 else f"{name}-again{names[name] - 1}"
