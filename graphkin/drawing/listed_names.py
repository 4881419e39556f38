"""Names in a crowd: where a name could only stand with its leader across vectors, its key stands there, as the number
of the step that drew the vector, and the name behind the key in a free place of the panel."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import accumulate

from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import runs_width, text_box
from graphkin.drawing.free_room import free_boxes
from graphkin.drawing.labels import Label, Mark, Placed, Placement
from graphkin.drawing.obstacles import Obstacles
from graphkin.drawing.primitives import Primitive, Text

__all__ = ["named"]

BEHIND = 1.0  # mm between a key and the name behind it
APART = 3.0, 1.0  # mm between columns and between lines of the list


def named(labels: Sequence[Label], panel: Box, obstacles: Obstacles, marks: Sequence[Mark]) -> tuple[Primitive, ...]:
    """Labels in their places with their leaders, parameters as for `labels.place`; those of a crowd listed by their
    keys."""
    placement = Placement(labels, panel, obstacles, marks)
    placed, crowded = placement.placed, len(placement.crowded)
    listed: tuple[Text, ...] = ()
    if crowded:
        placement.shorten()
        shorter = placement.placed
        keyed = {one.text.id for one in shorter if one.keyed}
        entries = [_entry(label.text, label.key) for label in labels if label.key and label.text.id in keyed]
        list_of_names = _list(entries, panel, obstacles + _standing(shorter))
        if len(placement.crowded) < crowded and (list_of_names or not entries):
            placed, listed = shorter, list_of_names
    written = (thing for one in placed for thing in (one.leader, one.text) if thing is not None)
    return *written, *listed


def _standing(placed: Iterable[Placed]) -> Obstacles:
    """Labels that stand, as obstacles for others."""
    boxes = tuple(one.box for one in placed)
    leaders = tuple((one.leader.start, one.leader.end) for one in placed if one.leader is not None)
    return Obstacles(solid=leaders, areas=boxes, writing=boxes)


def _entry(name: Text, key: Text) -> Text:
    """A key with what it stands for; only the name where this begins with the key."""
    runs = name.runs
    if not name.string.startswith(key.string.rstrip("… ")):
        by = runs_width(key.runs) + BEHIND
        runs = *key.runs, *(run._replace(x=run.x + by) for run in name.runs)
    return Text(0j, runs, "start", name.colour, f"listed-{name.id}", (*name.classes, "listed"))


def _list(entries: Sequence[Text], panel: Box, around: Obstacles) -> tuple[Text, ...]:
    """The entries in columns in a free place of the panel; empty where there is none."""
    boxes = [text_box(entry) for entry in entries]
    for lines in range(len(entries), 0, -1):
        columns = [range(k, min(k + lines, len(entries))) for k in range(0, len(entries), lines)]
        widths = [max(boxes[i].right for i in column) for column in columns]
        heights = [max(boxes[i].height for i in range(k, len(entries), lines)) for k in range(lines)]
        lefts = accumulate((width + APART[0] for width in widths[:-1]), initial=0.0)
        tops = list(accumulate((height + APART[1] for height in heights), initial=0.0))
        size = sum(widths) + APART[0] * (len(widths) - 1), tops[-1] - APART[1]
        for room in free_boxes(1, size, panel, around):
            corner = complex(room.left, room.top)
            return tuple(
                replace(entries[i], at=corner + complex(left, tops[k] - boxes[i].top))
                for left, column in zip(lefts, columns, strict=True) for k, i in enumerate(column)
            )  # fmt: skip
    return ()
