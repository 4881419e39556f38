"""Names in a crowd: where a name could only stand with its leader across vectors, its key stands there, as the number
of the step that drew the vector, and the name behind the key in a free place of the panel."""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from dataclasses import replace
from itertools import accumulate

from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import runs_width, text_box
from graphkin.drawing.free_room import free_boxes
from graphkin.drawing.label_positions import FoundPositions
from graphkin.drawing.labels import Label, Mark, Placed, place
from graphkin.drawing.obstacles import Obstacles
from graphkin.drawing.primitives import Primitive, Text

__all__ = ["named"]

BEHIND = 1.0  # mm between a key and the name behind it
ROUNDS = 2
DISPENSABLE = 4  # the rank from which labels may be missing
APART = 3.0, 1.0  # mm between columns and between lines of the list


def named(labels: Sequence[Label], panel: Box, obstacles: Obstacles, marks: Sequence[Mark]) -> tuple[Primitive, ...]:
    """Labels in their places with their leaders, parameters as for `labels.place`; those of a crowd listed by their
    keys."""
    found: FoundPositions = {}
    best = place(labels, panel, obstacles, marks, found)
    listed: tuple[Text, ...] = ()
    placed, keyed = best, frozenset[str]()
    for _ in range(ROUNDS):
        if not _crowded(labels, best):
            break
        if keyed:
            placed = place([_short(label, keyed) for label in labels], panel, obstacles, marks, found)
        keyed |= _crowded(labels, placed) & {label.text.id for label in labels if label.key is not None}
        tried = _eased(labels, placed, keyed, panel, obstacles, marks)
        if tried is not None and len(_crowded(labels, tried[0])) < len(_crowded(labels, best)):
            best, listed = tried
        if not keyed:
            break  # the next round would be this one
    written = (thing for one in best for thing in (one.leader, one.text) if thing is not None)
    return *written, *listed


def _crowded(labels: Sequence[Label], placed: Iterable[Placed]) -> frozenset[str]:
    """Which labels stand badly, or nowhere though they have keys, by their ids."""
    badly, well = set[str](), set[str]()
    for one in placed:
        (badly if one.tangled or not one.clear else well).add(one.text.id)
    missing = {one.text.id for one in labels if one.key is not None and one.rank < DISPENSABLE} - well
    return frozenset(badly | missing) - {""}


def _short(label: Label, keyed: Container[str]) -> Label:
    """The label as its key where it has one in a crowd."""
    if label.key is None or label.text.id not in keyed:
        return label
    return replace(label, text=replace(label.key, id=label.text.id, classes=("label", *label.key.classes)))


def _eased(
    labels: Sequence[Label], placed: Sequence[Placed], keyed: Container[str], panel: Box, obstacles: Obstacles,
    marks: Sequence[Mark],
) -> tuple[tuple[Placed, ...], tuple[Text, ...]] | None:  # fmt: skip
    """The labels of a crowd placed anew between the others, as their keys where they have some, and
    the list of what the keys stand for; None where that has no room."""
    crowded = _crowded(labels, placed)
    better: dict[str, Placed] = {}
    while True:
        anew = [_short(label, keyed) for label in labels if label.text.id in crowded]
        rest = [one for one in placed if one.text.id not in crowded]
        found = place(anew, panel, obstacles + _standing(rest), marks)
        better = {one.text.id: one for one in found if one.clear and not one.tangled}
        if len(better) == len(crowded):
            break
        crowded = frozenset(better)  # the others stay where they are, in the way of these
    again = (*(one for one in placed if one.text.id not in better), *better.values())
    standing = {one.text.id: one.text.runs for one in again}
    entries = [
        _entry(label.text, label.key) for label in labels
        if label.key is not None and standing.get(label.text.id) == label.key.runs
    ]  # fmt: skip
    listed = _list(entries, panel, obstacles + _standing(again))
    return (again, listed) if listed or not entries else None


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
