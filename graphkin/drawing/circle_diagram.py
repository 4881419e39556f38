"""The circle diagram: links as points on a circle, centres as the lines between them, numbered as they were found."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence

from graphkin.drafting.centres import Centre, Centres
from graphkin.drawing import strokes
from graphkin.drawing.colours import colour_of_link
from graphkin.drawing.metrics import text_box
from graphkin.drawing.primitives import Arc, Circle, Group, Line, Primitive, Stroke, Text
from graphkin.drawing.typeset import plain
from graphkin.plane import cross

__all__ = ["circle_diagram", "stroke_of"]

HALF = 1.9  # mm of a line left out to either side of its number
LEAST = 1.55  # mm from a number's middle to anything else
PERMANENT, FOUND, OTHERWISE = Stroke(0.5), Stroke(0.25), Stroke(0.35, (2.4, 0.9))


def stroke_of(centre: Centre) -> Stroke | None:
    """How the line of a centre is drawn; None where it is not determined."""
    if centre.place is None:
        return None
    return PERMANENT if centre.kind == "permanent" else OTHERWISE if centre.way else FOUND


def circle_diagram(centres: Centres, middle: complex, radius: float) -> tuple[Primitive, ...]:
    """Draw the diagram about a page point.

    Links stand clockwise in the order of counting, the first at the top; a line found bears its number where along it
    there is most room, none where there is too little.
    """
    names = sorted(centres.links.names, key=lambda n: (not n.isdigit(), int(n) if n.isdigit() else 0, n))
    ways = {n: cmath.rect(1.0, 2 * math.pi * k / len(names)) * -1j for k, n in enumerate(names)}
    sides = [(c, middle + radius * ways[c.pair[0]], middle + radius * ways[c.pair[1]]) for c in centres.found]
    lines: list[Primitive] = []
    numbers: list[Primitive] = []
    taken: list[complex] = []
    for centre, a, b in sides:
        stroke = stroke_of(centre)
        if stroke is None:
            continue
        name = "-".join(sorted(centre.pair))
        at = None if not centre.number else _free(
            a, b, [(p, q) for _, p, q in sides if (p, q) != (a, b)], taken, middle, radius)
        parts: tuple[Line, ...] = (Line(a, b, stroke),)
        if at is not None:
            taken.append(at)
            gap = HALF * (b - a) / abs(b - a)
            parts = Line(a, at - gap, stroke), Line(at + gap, b, stroke)
            runs = plain(str(centre.number), 2.3)
            numbers.append(Text(at + 0.75j, runs, "middle", id=f"label-side-{name}", classes=("label",)))
        lines.append(Group(parts, id=f"side-{name}", classes=("side", centre.kind)))
    thin = Stroke(0.18, (), strokes.GREY)
    outline = (Arc(middle, radius, 0.0, math.pi, thin), Arc(middle, radius, math.pi, 2 * math.pi, thin))
    whole = (*outline, *lines, *numbers, *_knots(centres, names, ways, middle, radius))
    return (Group(whole, id="circle-diagram", classes=("circle-diagram",)),)


def _free(
    a: complex, b: complex, others: Sequence[tuple[complex, complex]], taken: Sequence[complex],
    middle: complex, radius: float,
) -> complex | None:  # fmt: skip
    """The place on a side that lies furthest from all other sides, from the circle and from numbers that stand already;
    None where a number would touch one of them."""

    def room(z: complex) -> float:
        sides = min((_distance(z, p, q) for p, q in others), default=9.0)
        return min(sides, radius - abs(z - middle), min((abs(z - w) - HALF for w in taken), default=9.0))

    places = [a + (b - a) * (0.1 + 0.01 * k) for k in range(81)]
    best = max(places, key=lambda z: (min(room(z), 3.0), -abs(z - (a + b) / 2)))
    return best if room(best) > LEAST else None


def _distance(z: complex, a: complex, b: complex) -> float:
    return abs(cross(z - a, b - a)) / abs(b - a)


def _knots(
    centres: Centres, names: Sequence[str], ways: Mapping[str, complex], middle: complex, radius: float
) -> list[Primitive]:
    """The links as points on the circle with their numbers."""
    drawn: list[Primitive] = []
    for name in names:
        at, colour = middle + radius * ways[name], colour_of_link(centres.links.scene, name)
        drawn.append(Circle(at, 1.1, colour))
        runs = plain(name, 3.5, bold=True)
        box = text_box(Text(0j, runs, "middle", colour))
        there = middle + (radius + 2.2 + max(box.width, box.height) / 2) * ways[name]
        foot = there - 1j * (box.top + box.bottom) / 2
        drawn.append(Text(foot, runs, "middle", colour, f"label-circle-{name}", ("label",)))
    return drawn
