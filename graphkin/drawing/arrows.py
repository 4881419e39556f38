"""Vectors on paper: a line from tail to tip and a filled arrowhead."""

from __future__ import annotations

from dataclasses import dataclass

from graphkin.drawing import strokes
from graphkin.drawing.primitives import Circle, Group, Line, Polygon, Stroke

__all__ = ["COMPONENT", "POINTER", "RESULTANT", "ArrowKind", "arrow", "arrowhead", "head_size", "vector_group"]

# A vector shorter than this (mm) has no length a ruler could tell from none; it is drawn as a dot.
ZERO = 0.02
DOT_RADIUS = 0.55


@dataclass(frozen=True)
class ArrowKind:
    """Line and arrowhead (length x width, mm) of a kind of vector."""

    stroke: Stroke
    head_length: float
    head_width: float


RESULTANT = ArrowKind(strokes.RESULTANT, 3.0, 1.0)
COMPONENT = ArrowKind(strokes.RELATIVE, 2.5, 0.8)  # relative vectors, n, t, Coriolis and sliding parts
POINTER = ArrowKind(strokes.DIMENSION, 2.0, 0.65)  # dimensions, arcs with a sense, leaders to what lies off the sheet


def head_size(kind: ArrowKind, length: float) -> tuple[float, float]:
    """Length and width (mm) of the arrowhead on a vector of a length: at most three quarters of the vector long, and
    never so narrow that its own line hides it."""
    head = min(kind.head_length, 0.75 * length)
    width = max(kind.head_width * head / kind.head_length, min(kind.head_width, 1.4 * kind.stroke.width))
    return head, width


def arrowhead(tip: complex, along: complex, length: float, width: float, colour: str) -> Polygon:
    """A filled arrowhead of a length and width (mm) whose tip points along a direction."""
    e = along / abs(along)
    base, half = tip - length * e, 0.5j * width * e
    return Polygon((tip, base + half, base - half), fill=colour)


def arrow(
    tail: complex, tip: complex, kind: ArrowKind = RESULTANT, colour: str = strokes.BLACK
) -> tuple[Line, Polygon | Circle]:
    """The line of a vector, exactly from tail to tip, and after it the arrowhead, or a dot for a zero vector."""
    length = abs(tip - tail)
    stroke = kind.stroke.coloured(colour)
    if length < ZERO:
        return Line(tail, tip, stroke), Circle(tip, DOT_RADIUS, fill=colour)
    head, width = head_size(kind, length)
    return Line(tail, tip, stroke, covered=0.8 * head), arrowhead(tip, tip - tail, head, width, colour)


def vector_group(
    id: str,
    step: int | None,
    tail: complex,
    tip: complex,
    kind: ArrowKind = RESULTANT,
    colour: str = strokes.BLACK,
    title: str = "",
    classes: tuple[str, ...] = (),
) -> Group:
    """The group of one vector: its line first, then its arrowhead.

    Parameters
    ----------
    id : the symbol as an id (``Symbol.id``)
    step : number of the step that draws it, None where it is none
    tail, tip : page points (mm)
    title : the vector in words
    classes : further classes
    """
    stage = () if step is None else (f"step-{step:02d}",)
    return Group(arrow(tail, tip, kind, colour), id=id, classes=("vector", *stage, *classes), title=title)
