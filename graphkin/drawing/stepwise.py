"""A figure up to a step: later parts left out, new ones emphasised.

Lines of a step have its number; names, points, links and senses have the number of the step from which they are shown.
"""

from __future__ import annotations

from collections.abc import Iterable

from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import (
    Arc,
    Circle,
    Group,
    Line,
    Polygon,
    Polyline,
    Primitive,
    Text,
    map_tree,
)

FADED = 0.42  # of its colour is left to what was drawn before


def step_of(part: Primitive) -> int | None:
    """The number of the step that draws a primitive; None without a step, and for a part of a group."""
    if not isinstance(part, Group | Text):
        return None
    return part.since if part.step is None else part.step


def stepped(children: Iterable[Primitive]) -> tuple[Primitive, ...]:
    """The figure with the step of every primitive as a class, by which pages show and hide it."""

    def change(part: Primitive) -> Primitive:
        return part._replace(step=step_of(part)) if isinstance(part, Group | Text) else part

    return tied(map_tree(children, change))


def unstepped(children: Iterable[Primitive]) -> tuple[Primitive, ...]:
    """The figure without its steps, beside another whose steps are counted."""
    return map_tree(children, lambda part: part._replace(step=None) if isinstance(part, Group | Text) else part)


def tied(children: Iterable[Primitive]) -> tuple[Primitive, ...]:
    """The figure with every leader in a group of the step of its name."""

    def change(group: Primitive) -> Primitive:
        if not isinstance(group, Group):
            return group
        held = group.children
        inside = tuple(
            Group((part,), classes=("leader",), step=after.step)
            if isinstance(part, Line) and isinstance(after, Text) and "label" in after.classes else part
            for part, after in zip(held, (*held[1:], None), strict=False)
        )
        return group._replace(children=inside)

    return map_tree(children, change)


def so_far(children: Iterable[Primitive], first: int, last: int) -> tuple[Primitive, ...]:
    """The parts up to step ``last``, parts before step ``first`` faded, new ones on a pale band."""
    parts: list[Primitive] = []
    for part in children:
        step = step_of(part)
        if step is not None and step > last:
            continue
        if step is None and isinstance(part, Group):
            inside = so_far(part.children, first, last)
            parts += [part._replace(children=inside)] if inside else []
        elif step is not None and step < first:
            parts += strokes.pale((part,), FADED, FADED + 0.2)
        else:
            if step is not None and isinstance(part, Group) and not {"inset", "ring"} & set(part.classes):
                halo = tuple(band for child in part.children for band in _band(child))
                parts += [Group(halo, classes=("new",))] if halo else []
            parts.append(part)
    return tuple(parts)


def _band(part: Primitive) -> list[Primitive]:
    """The pale band under a stroke; none under areas and words."""
    if isinstance(part, Line) and part.start != part.end:
        return [Line(part.start, part.end, strokes.HALO)]
    if isinstance(part, Polyline | Arc) or (isinstance(part, Polygon) and part.stroke and not part.fill):
        return [part._replace(stroke=strokes.HALO)]
    if isinstance(part, Circle):
        return [Circle(part.centre, part.radius + strokes.HALO.width / 2, strokes.HALO.colour)]
    return []
