"""The tree of primitives: one walk that changes it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from graphkin.drawing.ink.primitives import (
    Arc,
    Circle,
    Group,
    Line,
    Polygon,
    Polyline,
    Scan,
    Stroke,
    Text,
    Travel,
    map_tree,
    moved,
    walk,
)
from graphkin.drawing.ink.strokes import pale
from graphkin.drawing.text import plain

PEN = Stroke(0.5, (2.0, 1.0), "#204060")
LEAVES = {
    "line": (Line(1 + 2j, 4 + 6j, PEN, 1.0), Line(11 + 22j, 14 + 26j, PEN, 1.0)),
    "polyline": (Polyline((1 + 0j, 2j), PEN), Polyline((11 + 20j, 10 + 22j), PEN)),
    "polygon": (Polygon((0j, 1j, 1 + 0j), "#ffffff", PEN), Polygon((10 + 20j, 10 + 21j, 11 + 20j), "#ffffff", PEN)),
    "circle": (Circle(1j, 2.0, "", PEN), Circle(10 + 21j, 2.0, "", PEN)),
    "arc": (Arc(1j, 2.0, 0.0, 1.0, PEN), Arc(10 + 21j, 2.0, 0.0, 1.0, PEN)),
    "text": (Text(1j, plain("B"), "middle", "#000000", "b", ("c",), 3),
             Text(10 + 21j, plain("B"), "middle", "#000000", "b", ("c",), 3)),
    "scan": (Scan(0j, 1 + 0j, 2, 2, "image/png", b"", (0j, 2 + 2j)),
             Scan(10 + 20j, 1 + 0j, 2, 2, "image/png", b"", (10 + 20j, 12 + 22j))),
}


@pytest.mark.parametrize(("before", "after"), LEAVES.values(), ids=LEAVES)
def test_what_is_moved_stands_elsewhere_and_is_else_the_same(before, after):
    assert (Group((after,), "g", ("k",), "layer", "title", 7),) == moved(
        (Group((before,), "g", ("k",), "layer", "title", 7),), 10 + 20j
    )


def test_a_moved_group_turns_about_the_moved_point():
    travel = Travel((0j, 1 + 1j), (0.0, 90.0), 3 + 4j, 2.0)
    (group,) = moved((Group((), motion=travel),), 10 + 20j)
    assert replace(travel, about=13 + 24j) == group.motion


def test_a_tree_is_changed_from_the_leaves_up_and_loses_what_is_none():
    inner = Group((Circle(0j, 1.0), Text(0j, plain("B"))), id="inner")
    seen = []

    def change(thing):
        seen.append(type(thing).__name__)
        return None if isinstance(thing, Circle) else thing

    (outer,) = map_tree((Group((inner,), id="outer"),), change)
    assert ["Circle", "Text", "Group", "Group"] == seen
    assert ["outer", "inner", ""] == [thing.id for thing in walk((outer,))]


def test_pale_strokes_and_fills_are_thinned_and_words_only_where_asked():
    things = (Polygon((0j,), "", PEN), Circle(0j, 1.0, "#000000", PEN), Text(0j, plain("B")))
    thin = PEN.coloured("#90a0b0")
    circle = Circle(0j, 1.0, "#808080", thin)
    assert (Polygon((0j,), "", thin), circle, things[2]) == pale(things, 0.5)
    assert "#808080" == pale(things, 0.5, 0.5)[2].colour
