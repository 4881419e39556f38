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


def step_of(thing: Primitive) -> int | None:
    """The number of the step that draws a primitive; None without a step, and for a part of a group."""
    if not isinstance(thing, Group | Text):
        return None
    return thing.since if thing.step is None else thing.step


def stepped(children: Iterable[Primitive]) -> tuple[Primitive, ...]:
    """The figure with the step of every primitive as a class, by which pages show and hide it."""

    def change(thing: Primitive) -> Primitive:
        return thing._replace(step=step_of(thing)) if isinstance(thing, Group | Text) else thing

    return tied(map_tree(children, change))


def unstepped(children: Iterable[Primitive]) -> tuple[Primitive, ...]:
    """The figure without its steps, beside another whose steps are counted."""
    return map_tree(children, lambda one: one._replace(step=None) if isinstance(one, Group | Text) else one)


def tied(children: Iterable[Primitive]) -> tuple[Primitive, ...]:
    """The figure with every leader in a group of the step of its name."""

    def change(thing: Primitive) -> Primitive:
        if not isinstance(thing, Group):
            return thing
        held = thing.children
        inside = tuple(
            Group((part,), classes=("leader",), step=after.step)
            if isinstance(part, Line) and isinstance(after, Text) and "label" in after.classes else part
            for part, after in zip(held, (*held[1:], None), strict=False)
        )
        return thing._replace(children=inside)

    return map_tree(children, change)


def so_far(children: Iterable[Primitive], first: int, last: int) -> tuple[Primitive, ...]:
    """The parts up to step ``last``, parts before step ``first`` faded, new ones on a pale band."""
    found: list[Primitive] = []
    for thing in children:
        step = step_of(thing)
        if step is not None and step > last:
            continue
        if step is None and isinstance(thing, Group):
            inside = so_far(thing.children, first, last)
            found += [thing._replace(children=inside)] if inside else []
        elif step is not None and step < first:
            found += strokes.pale((thing,), FADED, FADED + 0.2)
        else:
            if step is not None and isinstance(thing, Group) and not {"inset", "ring"} & set(thing.classes):
                halo = tuple(band for child in thing.children for band in _band(child))
                found += [Group(halo, classes=("new",))] if halo else []
            found.append(thing)
    return tuple(found)


def _band(thing: Primitive) -> list[Primitive]:
    """The pale band under a stroke; none under areas and words."""
    if isinstance(thing, Line) and thing.start != thing.end:
        return [Line(thing.start, thing.end, strokes.HALO)]
    if isinstance(thing, Polyline | Arc) or (isinstance(thing, Polygon) and thing.stroke and not thing.fill):
        return [thing._replace(stroke=strokes.HALO)]
    if isinstance(thing, Circle):
        return [Circle(thing.centre, thing.radius + strokes.HALO.width / 2, strokes.HALO.colour)]
    return []
