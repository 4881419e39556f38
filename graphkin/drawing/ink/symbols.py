"""Symbols: the arrow of a vector, and the kinematic symbols of ISO 3952 and GB/T 4460, in mm for a mechanism drawn
100 to 160 mm wide.

Each function returns primitives at a place, in the order of drawing.  Directions ``angle`` are radians,
counter-clockwise as seen on the page; points are page points (y down).
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Polygon, Polyline, Stroke, on_page, page_direction
from graphkin.plane import cross, unit

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
    wider than its line."""
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
    id: str, step: int | None, tail: complex, tip: complex, kind: ArrowKind = RESULTANT, colour: str = strokes.BLACK,
    title: str = "", classes: tuple[str, ...] = (),
) -> Group:
    """The group of one vector: its line first, then its arrowhead.

    Parameters
    ----------
    id : the symbol as an id (``Symbol.id``)
    step : number of the step that draws it, None without a step
    tail, tip : page points (mm)
    title : the vector in words
    classes : further classes
    """
    return Group(arrow(tail, tip, kind, colour), id=id, classes=("vector", *classes), title=title, step=step)


JOINT_RADIUS = 1.3
PIN_RADIUS = 0.8
BLOCK_LENGTH, BLOCK_WIDTH = 8.0, 4.6
FOOT_WIDTH, FOOT_HEIGHT = 6.4, 4.4
HATCH_PITCH, HATCH_DEPTH = 1.3, 1.6
SLOT_WIDTH = 2.6
SPRING_WIDTH = 3.6
Shape = Line | Polyline | Polygon | Circle | Arc


def turning_pair(at: complex, radius: float = JOINT_RADIUS) -> tuple[Circle, ...]:
    """Open circle, white inside so that bars end at it."""
    return (Circle(at, radius, fill=strokes.WHITE, stroke=strokes.OUTLINE),)


def pin(at: complex, colour: str = strokes.BLACK) -> tuple[Circle, ...]:
    """Filled circle: a pin that runs in a slot, or a point of a link."""
    return (Circle(at, PIN_RADIUS, fill=colour),)


def hatched_line(start: complex, end: complex) -> tuple[Line, ...]:
    """The edge of the frame from start to end, hatched on its right in this sense on the page."""
    length = abs(end - start)
    along = (end - start) / length
    right = along * 1j
    count = max(2, round(length / HATCH_PITCH))
    feet = (start + along * length * (i + 0.75) / count for i in range(count))
    lean = (right - along * 0.8) * HATCH_DEPTH / abs(right)
    return Line(start, end, strokes.FRAME), *(Line(foot, foot + lean, strokes.HATCHING) for foot in feet)


def fixed_pivot(at: complex, angle: float = -math.pi / 2) -> tuple[Shape, ...]:
    """Turning pair on a hatched foot; the foot points along ``angle``, by default downwards."""
    down = page_direction(angle)
    right = down * -1j
    left_foot, right_foot = (at + FOOT_HEIGHT * down + side * FOOT_WIDTH / 2 * right for side in (-1, 1))
    inner = 0.62  # the legs stand inside the edge of the frame
    corners = (at + FOOT_HEIGHT * down + side * inner * FOOT_WIDTH / 2 * right for side in (-1, 1))
    legs = Polygon((at, *corners), strokes.WHITE, strokes.OUTLINE)
    return legs, *hatched_line(left_foot, right_foot), *turning_pair(at)


def guide(at: complex, angle: float, length: float, width: float = BLOCK_WIDTH) -> tuple[Line, ...]:
    """Frame guide for a block at a place: hatched edges beside its path, ``length`` (mm) long, the left one first."""
    along = page_direction(angle)
    side = along * 1j * width / 2
    half = along * length / 2
    left = hatched_line(at + half - side, at - half - side)
    right = hatched_line(at - half + side, at + half + side)
    return *left, *right


def block(
    at: complex, angle: float, colour: str = strokes.BLACK, length: float = BLOCK_LENGTH, width: float = BLOCK_WIDTH
) -> tuple[Polygon, ...]:
    """Sliding block, white inside, its long side along ``angle``."""
    return (Polygon(_rectangle(at, angle, length, width), strokes.WHITE, strokes.OUTLINE.coloured(colour)),)


def slot(start: complex, end: complex, colour: str = strokes.BLACK, width: float = SLOT_WIDTH) -> tuple[Shape, ...]:
    """Slot in a link between the centres of its round ends."""
    along = (end - start) / abs(end - start)
    side = along * 1j * width / 2
    bearing = cmath.phase(on_page(along))
    stroke = strokes.OUTLINE.coloured(colour)
    return (
        Polygon((start + side, end + side, end - side, start - side), fill=strokes.WHITE),
        Circle(start, width / 2, fill=strokes.WHITE),
        Circle(end, width / 2, fill=strokes.WHITE),
        Line(start + side, end + side, stroke),
        Line(end - side, start - side, stroke),
        Arc(end, width / 2, bearing - math.pi / 2, bearing + math.pi / 2, stroke),
        Arc(start, width / 2, bearing + math.pi / 2, bearing + 3 * math.pi / 2, stroke),
    )


def circular_slot(
    centre: complex, radius: float, start: float, end: float, colour: str = strokes.BLACK
) -> tuple[Arc, ...]:
    """Slot along a circle between two angles (rad, as of `Arc`), where its round ends have their centres."""
    stroke, half = strokes.OUTLINE.coloured(colour), SLOT_WIDTH / 2
    inside = Arc(centre, radius, start, end, Stroke(SLOT_WIDTH, colour=strokes.WHITE))
    edges = (Arc(centre, radius + side * half, start, end, stroke) for side in (1, -1))
    ends = (start, -math.pi), (end, math.pi)
    caps = (Arc(inside.at(angle), half, angle, angle + turn, stroke) for angle, turn in ends)
    return inside, *edges, *caps


WELD = 3.2  # mm of the bars


def weld(at: complex, first: complex, second: complex, colour: str) -> Polygon:
    """Filled corner between two bars of one link that meet at a point, towards a point on each: they turn together."""
    ends = (at + WELD * unit(end - at) for end in (first, second))
    return Polygon((at, *ends), colour)


def sense_arc(
    at: complex, radius: float, middle: float, sense: int, span: float = math.radians(70), colour: str = strokes.BLACK,
    heads: int = 1,
) -> tuple[Shape, ...]:
    """Arc with an arrowhead: the sense of an angular velocity (one head) or acceleration (two heads) about a point.

    Parameters
    ----------
    middle : direction (rad) of the middle of the arc from ``at``
    sense : +1 counter-clockwise, -1 clockwise
    span : angle of the arc (rad), enlarged where the arrowheads would fill it
    """
    kind = POINTER
    span = max(span, 2.2 * heads * kind.head_length / radius)
    start, end = middle - sense * span / 2, middle + sense * span / 2
    stroke = Stroke(0.25, (), colour)
    shapes: list[Shape] = []
    turn = kind.head_length / radius
    for head in range(heads):
        tip = end - sense * head * 1.1 * turn
        # A straight head on a bent line looks right along the chord of the arc under it.
        chord = at + radius * page_direction(tip) - (at + radius * page_direction(tip - sense * turn))
        shapes.append(arrowhead(at + radius * page_direction(tip), chord, kind.head_length, 1.0, colour))
    return Arc(at, radius, start, end - sense * 0.7 * turn, stroke), *shapes


BARREL, BORE = 0.6, 5.0  # of the length of a cylinder, and its width (mm)


def cylinder(pivot: complex, rod_end: complex, colour: str) -> tuple[Shape, ...]:
    """Hydraulic cylinder between the pivot of its barrel and the end of its rod: the drive of a sliding pair."""
    length = abs(rod_end - pivot)
    along = (rod_end - pivot) / length
    near, far = pivot + min(4.0, 0.15 * length) * along, pivot + BARREL * length * along
    side = along * 1j * BORE / 2
    stroke = strokes.OUTLINE.coloured(colour)
    bar = strokes.LINK.coloured(colour)
    piston = near + 0.55 * (far - near)
    return (
        Line(pivot, near, bar),
        Polygon((near + side, far + side, far - side, near - side), strokes.WHITE, stroke),
        Line(piston, rod_end, bar),
        Polygon(_rectangle(piston, cmath.phase(on_page(along)), 1.6, 0.88 * BORE), colour),
    )


def spring(start: complex, end: complex) -> tuple[Shape, ...]:
    """A helical spring between two points as a zigzag with straight ends (ISO 2162-1, simplified)."""
    axis = end - start
    length = abs(axis)
    if length < 1e-9:
        return ()
    along, lead = axis / length, min(6.0, 0.2 * length)
    turns = max(3, min(10, round((length - 2 * lead) / 4.0)))
    step, half = (length - 2 * lead) / (2 * turns), min(SPRING_WIDTH, 0.3 * length) / 2
    tops = [lead + step * (k + 0.5) + (half if k % 2 else -half) * 1j for k in range(2 * turns)]
    places = (0j, lead + 0j, *tops, length - lead + 0j, length + 0j)
    return (Polyline(tuple(start + along * z for z in places), strokes.OUTLINE),)


PULLING = {"spring": spring}
"""The symbol of each kind that pulls two points together."""


def _rectangle(at: complex, angle: float, length: float, width: float) -> tuple[complex, ...]:
    along = page_direction(angle) * length / 2
    side = page_direction(angle + math.pi / 2) * width / 2
    return at - along - side, at + along - side, at + along + side, at - along + side


def hull(points: tuple[complex, ...]) -> tuple[complex, ...]:
    """Convex hull, counter-clockwise where y points up, without points on its edges.

    Andrew, Another efficient algorithm for convex hulls (1979).
    """
    ordered = sorted(set(points), key=lambda z: (z.real, z.imag))
    halves: list[complex] = []
    for chain in (ordered, ordered[::-1]):
        half: list[complex] = []
        for point in chain:
            while len(half) > 1:
                edge, chord = half[-1] - half[-2], point - half[-2]
                if cross(edge, chord) > 1e-6 * max(abs(edge), abs(chord)) ** 2:  # a millionth of the square is straight
                    break
                half.pop()
            half.append(point)
        halves += half[:-1]
    return tuple(halves)
